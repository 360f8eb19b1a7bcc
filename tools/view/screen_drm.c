/* SPDX-License-Identifier: MIT */
/* screen_drm.c - a display through the kernel's mode setting: the first connector that has
 * something plugged in, in the mode that it prefers, two buffers, flipped at the refresh. */
#include "tools/view/screen.h"

#ifdef __linux__

#include "tools/view/console.h"
#include "tools/view/drm.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { MAX_CARDS = 8, MAX_IDS = 32, MAX_MODES = 128, FLIP_WAIT_MS = 1000 };

/* The format of 32 bits and depth 24, low byte first on every machine. */
static const struct layout xrgb8888 = { .bytes = 4, .shift = { 16, 8, 0 }, .bits = { 8, 8, 8 } };

struct buffer {
    uint32_t fb_id;
    size_t pitch, size;         /* bytes */
    uint8_t *memory;
};

struct display {
    struct screen screen;
    int file;
    uint32_t connector, crtc;
    struct drm_mode mode;
    struct drm_crtc before;     /* what was shown before we came */
    struct buffer buffer[2];
    int next;                   /* the one that is drawn into */
    bool is_set, flips;         /* our mode is on; the device can flip */
    uint32_t *pixel;            /* what is drawn: buffers may be slow to read */
};

/* ------------------------------------------------------------------ connectors */

/* What drives the connector: the controller in use, or the first that could. */
static bool find_crtc(struct display *d, const struct drm_connector *c, const uint32_t *encoders,
                      const struct drm_resources *all, const uint32_t *crtcs)
{
    struct drm_encoder used = { .encoder_id = c->encoder_id };
    if (c->encoder_id != 0 && ioctl(d->file, DRM_GET_ENCODER, &used) == 0 && used.crtc_id != 0) {
        d->crtc = used.crtc_id;
        return true;
    }
    for (uint32_t i = 0; i < c->count_encoders && i < MAX_IDS; i++) {
        struct drm_encoder e = { .encoder_id = encoders[i] };
        if (ioctl(d->file, DRM_GET_ENCODER, &e) != 0)
            continue;
        for (uint32_t k = 0; k < all->count_crtcs && k < MAX_IDS; k++)
            if (e.possible_crtcs >> k & 1) {
                d->crtc = crtcs[k];
                return true;
            }
    }
    return false;
}

static bool use_connector(struct display *d, uint32_t id, const struct drm_resources *all,
                          const uint32_t *crtcs)
{
    static struct drm_mode modes[MAX_MODES];
    uint32_t encoders[MAX_IDS] = { 0 };
    struct drm_connector c = { .connector_id = id };
    if (ioctl(d->file, DRM_GET_CONNECTOR, &c) != 0 || c.connection != DRM_CONNECTED ||
        c.count_modes == 0 || c.count_modes > MAX_MODES || c.count_encoders > MAX_IDS)
        return false;
    c.modes = (uintptr_t)modes;
    c.encoder_ids = (uintptr_t)encoders;
    c.count_props = 0;
    if (ioctl(d->file, DRM_GET_CONNECTOR, &c) != 0 || c.count_modes == 0 ||
        c.count_modes > MAX_MODES)
        return false;
    d->connector = id;
    d->mode = modes[0];         /* preferred modes come first */
    return find_crtc(d, &c, encoders, all, crtcs);
}

static bool find_connector(struct display *d, struct failure *f)
{
    uint32_t connectors[MAX_IDS] = { 0 }, crtcs[MAX_IDS] = { 0 };
    struct drm_resources all = { .connector_ids = (uintptr_t)connectors,
                                 .crtc_ids = (uintptr_t)crtcs, .count_connectors = MAX_IDS,
                                 .count_crtcs = MAX_IDS };
    if (ioctl(d->file, DRM_GET_RESOURCES, &all) != 0)
        return fail(f, "the card sets no modes");
    for (uint32_t i = 0; i < all.count_connectors && i < MAX_IDS; i++)
        if (use_connector(d, connectors[i], &all, crtcs))
            return true;
    return fail(f, "nothing is connected to the card");
}

/* ------------------------------------------------------------------ buffers */

static bool make_buffer(struct display *d, struct buffer *b, struct failure *f)
{
    struct drm_create_dumb create = { .width = d->mode.hdisplay, .height = d->mode.vdisplay,
                                      .bpp = 32 };
    if (ioctl(d->file, DRM_CREATE_DUMB, &create) != 0)
        return fail(f, "the card has no plain buffers (%s)", strerror(errno));
    struct drm_framebuffer fb = { .width = create.width, .height = create.height,
                                  .pitch = create.pitch, .bpp = 32, .depth = 24,
                                  .handle = create.handle };
    struct drm_map_dumb map = { .handle = create.handle };
    if (ioctl(d->file, DRM_ADD_FB, &fb) != 0 || ioctl(d->file, DRM_MAP_DUMB, &map) != 0)
        return fail(f, "the card does not take a buffer (%s)", strerror(errno));
    void *memory = mmap(NULL, create.size, PROT_READ | PROT_WRITE, MAP_SHARED, d->file,
                        (off_t)map.offset);
    if (memory == MAP_FAILED)
        return fail(f, "a buffer cannot be mapped (%s)", strerror(errno));
    *b = (struct buffer){ .fb_id = fb.fb_id, .pitch = create.pitch, .size = create.size,
                          .memory = memory };
    return true;
}

static bool set_mode(struct display *d, const struct buffer *b)
{
    struct drm_crtc crtc = { .connector_ids = (uintptr_t)&d->connector, .count_connectors = 1,
                             .crtc_id = d->crtc, .fb_id = b->fb_id, .mode_valid = 1,
                             .mode = d->mode };
    return ioctl(d->file, DRM_SET_CRTC, &crtc) == 0;
}

/* ------------------------------------------------------------------ showing */

static bool wait_for_flip(struct display *d)
{
    char events[1024];
    struct pollfd ready = { .fd = d->file, .events = POLLIN };
    if (poll(&ready, 1, FLIP_WAIT_MS) <= 0)
        return false;
    return read(d->file, events, sizeof events) > 0;
}

static bool display_surface(struct screen *screen, struct surface *out, struct failure *f)
{
    struct display *d = (struct display *)screen;
    (void)f;
    *out = (struct surface){ screen->width, screen->height, (size_t)screen->width, d->pixel };
    return true;
}

static bool display_show(struct screen *screen, const struct text *text, struct failure *f)
{
    struct display *d = (struct display *)screen;
    struct buffer *b = &d->buffer[d->next];
    (void)text;
    for (int y = 0; y < screen->height; y++)
        layout_pack(&xrgb8888, b->memory + (size_t)y * b->pitch,
                    d->pixel + (size_t)y * (size_t)screen->width, screen->width);
    struct drm_dirty dirty = { .fb_id = b->fb_id };
    struct drm_page_flip flip = { .crtc_id = d->crtc, .fb_id = b->fb_id,
                                  .flags = DRM_PAGE_FLIP_EVENT };
    if (d->flips && ioctl(d->file, DRM_PAGE_FLIP, &flip) == 0) {
        wait_for_flip(d);
    } else {
        d->flips = false;       /* or not any more: somebody else has the display */
        if (!set_mode(d, b) && errno == EACCES)
            return fail(f, "the display is taken by another program");
    }
    ioctl(d->file, DRM_DIRTY, &dirty);          /* cards that copy want to be told */
    d->next = !d->next;
    return true;
}

/* ------------------------------------------------------------------ life */

static void display_close(struct screen *screen)
{
    struct display *d = (struct display *)screen;
    if (d->is_set && d->before.fb_id != 0) {
        d->before.connector_ids = (uintptr_t)&d->connector;
        d->before.count_connectors = 1;
        ioctl(d->file, DRM_SET_CRTC, &d->before);
    }
    if (d->is_set)
        console_close();
    for (int i = 0; i < 2; i++)
        if (d->buffer[i].memory != NULL) {
            munmap(d->buffer[i].memory, d->buffer[i].size);
            ioctl(d->file, DRM_REMOVE_FB, &d->buffer[i].fb_id);
        }
    if (d->file >= 0)
        close(d->file);
    free(d->pixel);
    free(d);
}

static bool open_card(struct display *d, int number, struct failure *f)
{
    char path[32];
    snprintf(path, sizeof path, "/dev/dri/card%d", number);
    d->file = open(path, O_RDWR | O_CLOEXEC);
    if (d->file < 0)
        return fail(f, "%s: %s", path, strerror(errno));
    if (!find_connector(d, f) || !make_buffer(d, &d->buffer[0], f) ||
        !make_buffer(d, &d->buffer[1], f))
        return false;
    d->screen.width = d->mode.hdisplay;
    d->screen.height = d->mode.vdisplay;
    d->pixel = calloc((size_t)d->screen.width * (size_t)d->screen.height, sizeof *d->pixel);
    if (d->pixel == NULL)
        return fail(f, "out of memory");
    d->before.crtc_id = d->crtc;
    if (ioctl(d->file, DRM_GET_CRTC, &d->before) != 0)
        d->before.fb_id = 0;
    if (!set_mode(d, &d->buffer[0]))
        return fail(f, "%s: the mode cannot be set, another program has the display (%s)", path,
                    strerror(errno));
    d->next = 1;
    d->is_set = d->flips = true;
    snprintf(d->screen.what, sizeof d->screen.what, "%s, %dx%d at %u Hz", path, d->screen.width,
             d->screen.height, d->mode.vrefresh);
    return true;
}

static struct screen *display_open(const struct screen_wish *wish, struct failure *f)
{
    (void)wish;
    for (int card = 0; card < MAX_CARDS; card++) {
        struct failure why = { "" };
        struct display *d = calloc(1, sizeof *d);
        if (d == NULL) {
            fail(f, "out of memory");
            return NULL;
        }
        d->file = -1;
        if (open_card(d, card, &why)) {
            d->screen.kind = &screen_drm;
            console_open(NULL);
            return &d->screen;
        }
        bool is_there = d->file >= 0;
        display_close(&d->screen);
        if (is_there || card == 0)
            fail(f, "%s", why.text);    /* the first reason is kept */
        if (!is_there && card > 0)
            break;
    }
    return NULL;
}

const struct screen_kind screen_drm = { "drm", display_open, display_surface, display_show,
                                        console_event, display_close };

#else

static struct screen *no_drm(const struct screen_wish *wish, struct failure *f)
{
    (void)wish;
    fail(f, "there is none but on Linux");
    return NULL;
}

const struct screen_kind screen_drm = { .name = "drm", .open = no_drm };

#endif
