/* SPDX-License-Identifier: MIT */
/* drm.h - the few records and calls of the kernel's mode setting that are used here, written down
 * from its stable interface: distributions keep those headers in a package of their own. */
#ifndef SMEAR_TOOLS_VIEW_DRM_H
#define SMEAR_TOOLS_VIEW_DRM_H

#include <stdint.h>
#include <sys/ioctl.h>

struct drm_mode {
    uint32_t clock;
    uint16_t hdisplay, hsync_start, hsync_end, htotal, hskew;
    uint16_t vdisplay, vsync_start, vsync_end, vtotal, vscan;
    uint32_t vrefresh, flags, type;
    char name[32];
};

struct drm_resources {
    uint64_t fb_ids, crtc_ids, connector_ids, encoder_ids;      /* addresses */
    uint32_t count_fbs, count_crtcs, count_connectors, count_encoders;
    uint32_t min_width, max_width, min_height, max_height;
};

struct drm_crtc {
    uint64_t connector_ids;     /* an address */
    uint32_t count_connectors, crtc_id, fb_id, x, y, gamma_size, mode_valid;
    struct drm_mode mode;
};

struct drm_encoder {
    uint32_t encoder_id, encoder_type, crtc_id, possible_crtcs, possible_clones;
};

struct drm_connector {
    uint64_t encoder_ids, modes, prop_ids, prop_values;         /* addresses */
    uint32_t count_modes, count_props, count_encoders;
    uint32_t encoder_id;        /* in use; 0: none */
    uint32_t connector_id, connector_type, connector_type_id;
    uint32_t connection;        /* 1: something is plugged in */
    uint32_t width_mm, height_mm, subpixel, pad;
};

struct drm_framebuffer {
    uint32_t fb_id, width, height, pitch, bpp, depth, handle;
};

struct drm_dirty {
    uint32_t fb_id, flags, color, num_clips;
    uint64_t clips;             /* an address */
};

struct drm_page_flip {
    uint32_t crtc_id, fb_id, flags, reserved;
    uint64_t user_data;
};

struct drm_create_dumb {
    uint32_t height, width, bpp, flags, handle, pitch;
    uint64_t size;
};

struct drm_map_dumb {
    uint32_t handle, pad;
    uint64_t offset;
};

enum { DRM_CONNECTED = 1, DRM_PAGE_FLIP_EVENT = 1, DRM_EVENT_FLIP_COMPLETE = 2 };

#define DRM_GET_RESOURCES _IOWR('d', 0xa0, struct drm_resources)
#define DRM_GET_CRTC _IOWR('d', 0xa1, struct drm_crtc)
#define DRM_SET_CRTC _IOWR('d', 0xa2, struct drm_crtc)
#define DRM_GET_ENCODER _IOWR('d', 0xa6, struct drm_encoder)
#define DRM_GET_CONNECTOR _IOWR('d', 0xa7, struct drm_connector)
#define DRM_ADD_FB _IOWR('d', 0xae, struct drm_framebuffer)
#define DRM_REMOVE_FB _IOWR('d', 0xaf, unsigned int)
#define DRM_PAGE_FLIP _IOWR('d', 0xb0, struct drm_page_flip)
#define DRM_DIRTY _IOWR('d', 0xb1, struct drm_dirty)
#define DRM_CREATE_DUMB _IOWR('d', 0xb2, struct drm_create_dumb)
#define DRM_MAP_DUMB _IOWR('d', 0xb3, struct drm_map_dumb)

_Static_assert(sizeof(struct drm_mode) == 68 && sizeof(struct drm_resources) == 64 &&
               sizeof(struct drm_crtc) == 104 && sizeof(struct drm_connector) == 80 &&
               sizeof(struct drm_create_dumb) == 32, "records are the kernel's");

#endif
