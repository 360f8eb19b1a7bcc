/* SPDX-License-Identifier: MIT */
/* context.h - all state of a context. Only smear.c (the public functions) and frame.c (the order of stages)
 * see it; stages get the plain structs they work on. */
#ifndef SMEAR_CONTEXT_H
#define SMEAR_CONTEXT_H

#include "smear.h"

#include "geometry/assemble.h"
#include "geometry/assemble_path.h"
#include "filter/filter.h"
#include "ports/camera_velocity.h"
#include "temporal/tile_method.h"
#include "geometry/bins.h"
#include "ports/half.h"
#include "base/jobs.h"
#include "layers/layer.h"
#include "ports/pingpong.h"
#include "raster/raster.h"
#include "geometry/shutter.h"
#include "temporal/subframes.h"
#include "raster/window.h"

static inline bool method_has_layers(uint8_t method)
{
    return method == SMEAR_OBJECT || method == SMEAR_LAYERED;
}

/* Sums of linear light or codes; of codes alone, 16 bits do. */
#if SMEAR_WITH_LINEAR
typedef uint32_t smear_sum;
enum { SUM_SAMPLES_MAX = 1024 };
#else
typedef uint16_t smear_sum;
enum { SUM_SAMPLES_MAX = 257 };
#endif

/* The pose a draw had, kept under its id. */
struct smear_kept_pose {
    uint32_t id;                    /* 0: free */
    uint32_t frame;                 /* in which it was last submitted */
    smear_transform now, before;    /* before: valid when it was also seen in the frame before */
    uint8_t has_before;
};

struct smear_submitted {
    smear_draw draw;
    int32_t kept;                   /* index of its kept pose, or -1 */
};

enum smear_state { STATE_IDLE, STATE_BEGUN, STATE_FILTER };

/* What moves in a tile row. */
struct smear_row_moving {
    struct smear_moving_triangle *moving;
    uint32_t count;
    struct smear_tile_load *load;               /* per tile */
};

/* What stands still from frame to frame, and what shows it: with desc.cache_static or desc.buffer_age. */
struct smear_damage {
    uint32_t scene[2];              /* hash of all that a picture of it depends on */
    bool keeps;                     /* desc.cache_static: the window has all rows of the frame */
    bool is_whole;                  /* all that the last frame drew of it is in the window, or on the display */
    bool is_same;                   /* and it is what this frame wants */
    /* desc.buffer_age, else null: */
    struct smear_damaged_tiles due;           /* in how many frames each tile must be drawn, this one included, or
                                     * TILE_DAMAGED_NOW */
    struct smear_tile_box *seen;    /* where each draw that stands still is seen, in their order */
};

/* What filters need beyond the window. */
struct smear_filtering {
    struct smear_reprojection reprojection;             /* where raster.velocity_from_depth */
    struct smear_pass pass[PINGPONG_PASSES_MAX];
    int passes;
    uint32_t *pass_plane[PINGPONG_PASSES_MAX - 1];      /* what each but the last leaves:
                                                         * planes like the window's */
    int32_t pass_end[PINGPONG_PASSES_MAX - 1];          /* rows done of this frame */
};

struct smear_context {
    smear_desc desc;                /* defaults filled in */
    enum smear_state state;

    /* the frame */
    smear_frame frame;
    smear_camera camera, camera_open, camera_close;
    int32_t half_exposure;          /* q24 frames */
    bool camera_moves;              /* the earlier camera is known, and another */
    smear_camera kept_camera;
    bool has_kept_camera;
    uint32_t frame_number;
    struct smear_submitted *submitted;
    struct smear_kept_pose *kept;
    struct smear_raster_draw *raster_draw;
    uint32_t draw_count;
    /* poses of the draw at hand that are not the application's: now, open, close */
    smear_transform made[SMEAR_WITH_SCALES || SMEAR_WITH_BILLBOARDS ? 3 : 1];

    /* stages */
    struct smear_bins bins;
    struct smear_assembler assembler;
    struct smear_window window;
    struct smear_window *half;              /* with desc.half */
    const struct smear_window *filtered;    /* which of the two a filter reads */
    struct smear_raster_frame raster;
    struct smear_blur_settings blur;
    struct smear_filtering *filtering;          /* with a window */
    struct smear_jobs jobs;
    struct smear_raster_cache cache;        /* of the first raster job */
    uint32_t opaque, blend;         /* lists of the rows being drawn and blended */
    uint32_t *row_offset;           /* of the window rows a blur may read */
    uint32_t *scratch;              /* one tile of finished pixels per worker */
    uint32_t *half_scratch;         /* the same at half the size */
    smear_sum *sums;                /* accumulate: r g b per pixel of the frame, or of a band */
    /* methods that look at several instants */
    struct smear_shutter shutter;
    struct smear_chooser chooser;
    struct smear_row_moving row_moving;     /* of the row being drawn */
    uint8_t *work;                  /* work_bytes per worker */
    uint32_t work_bytes;
    int32_t strip;                  /* tiles that share instants are so many pixels wide together, at most */
    uint32_t moving;                /* list of the row being drawn */
    struct smear_layers *layers;        /* null without desc.layers */
    struct smear_damage *still;          /* null without desc.cache_static and desc.buffer_age */

    int32_t *inspect;               /* wide velocities, a plane like the window's */
    bool blends;                    /* some draw is blended */
    bool direct;                    /* sharp rows are drawn as the display's pixels */
    int32_t sums_top;               /* first row of the sums */

    /* bands */
    uint8_t *band[2];
    uint32_t band_bytes;
    uint32_t bands_handed;
    unsigned bands_sent;

    int32_t filter_row;             /* rows taken by smear_filter_row */
    uint32_t worker_samples[SMEAR_WORKERS_MAX];
    smear_stats stats;
};

/* Columns that a strip takes with what is drawn beyond its sides: of one as wide as the frame, nothing. */
static inline int32_t strip_columns(const struct smear_context *c)
{
    return c->strip >= c->window.width ? c->strip : SMEAR_STRIP_COLUMNS(c->strip);
}

/* The frame has blurred layers. */
static inline bool has_layers(const struct smear_context *c)
{
    return SMEAR_WITH_LAYERS && c->layers != NULL && c->layers->on;
}

/* Draws that stand still need not be drawn: the window shows them. */
static inline bool static_is_cached(const struct smear_context *c)
{
    return SMEAR_WITH_DAMAGE && c->still != NULL && c->still->keeps && c->still->is_same;
}

static inline bool same_transform(const smear_transform *a, const smear_transform *b)
{
    if (a == b)
        return true;
    for (int i = 0; i < 9; i++)
        if (a->basis[i] != b->basis[i])
            return false;
    return a->origin[0] == b->origin[0] && a->origin[1] == b->origin[1] && a->origin[2] == b->origin[2];
}

extern const smear_transform smear_identity;      /* frame.c */

/* frame.c: draws what was submitted. */
int smear_frame_render(struct smear_context *c);

/* frame.c: the filter alone. */
void smear_frame_filter_begin(struct smear_context *c);
int smear_frame_filter_row(struct smear_context *c, const uint32_t *color, const uint32_t *depth,
                           const int16_t *velocity);

#endif
