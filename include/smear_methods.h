/* SPDX-License-Identifier: MIT */
/* smear_methods.h - the methods of other systems, for comparison and for what they do better, and all that is theirs in
 * smear_desc and smear_frame. Included by smear.h.
 *
 * Methods are of three families. Temporal ones (SMEAR_SUBFRAMES, SMEAR_TIMEMASK, SMEAR_AUTO) look at several instants
 * of what moves. Filters (SMEAR_RECONSTRUCT, SMEAR_CAMERA, SMEAR_PINGPONG, SMEAR_HALF) keep a window of rows and blur
 * it by the velocities of pixels. Layers (SMEAR_OBJECT, SMEAR_LAYERED) blur what moves and merge it over the static
 * scene. Filters and layers have a reach, and draw SMEAR_BLEND sharp after the blur; all else blurs it.
 *
 *     SMEAR_ACCUMULATE   mean of `samples` sharp instants of the whole frame
 *     SMEAR_RECONSTRUCT  tile-maximum reconstruction filter
 *     SMEAR_TIMEMASK     the time each moving triangle covers each pixel, in `samples` time samples (8, 16 or 32); more
 *                        triangles in a tile than there is room for end the frame with SMEAR_ERR_ROOM
 *     SMEAR_CAMERA       `filter.kind` along the camera's motion alone, told from depth: nothing is done per vertex
 *     SMEAR_PINGPONG     few taps, two or three times over: see smear_pingpong
 *     SMEAR_HALF         `filter.kind` at half the size, over the whole frame by amount of motion
 *     SMEAR_OBJECT       each moving object along its one displacement, over the static scene, by sums whose cost does
 *                        not grow with its length; those without one displacement as in SMEAR_LAYERED
 *     SMEAR_LAYERED      each blurred layer by velocities of its pixels, over the static scene
 *
 * desc.reach is the longest blur radius of a filter or layer in pixels, 1..64; of a sketch how far its lines reach up and
 * down, while along x they reach as far as they go; 0 means 5 % of the height, 64 at most.
 * desc.tile must not be below it (but with scatter), and may be 4 with filters but SMEAR_HALF and scatter. With a
 * window and without temporal methods, layers and SMEAR_HALF desc.band_rows may divide the tile. SMEAR_ACCUMULATE takes
 * 12 bytes per pixel of the frame. */
#include "smear.h"      /* which includes this file where it needs it */
#ifndef SMEAR_METHODS_H
#define SMEAR_METHODS_H

struct smear_context;
struct smear_frame;

#define SMEAR_SET_TEMPORAL (SMEAR_SET(SMEAR_SUBFRAMES) | SMEAR_SET(SMEAR_TIMEMASK) | SMEAR_SET(SMEAR_AUTO))
#define SMEAR_SET_LAYERS (SMEAR_SET(SMEAR_OBJECT) | SMEAR_SET(SMEAR_LAYERED))
#define SMEAR_SET_FILTERS \
    (SMEAR_SET(SMEAR_RECONSTRUCT) | SMEAR_SET(SMEAR_CAMERA) | SMEAR_SET(SMEAR_PINGPONG) | SMEAR_SET(SMEAR_HALF))
/* What 0 means: SMEAR_AUTO, or what there is without SMEAR_WITH_SUBFRAMES. */
#define SMEAR_SET_DEFAULT \
    (SMEAR_WITH_SUBFRAMES ? SMEAR_SET(SMEAR_AUTO) \
     : SMEAR_WITH_RECONSTRUCT ? SMEAR_SET(SMEAR_RECONSTRUCT) : SMEAR_SET(SMEAR_NONE))
/* Stands for SMEAR_ACCUMULATE with 12 bytes per pixel of a band, not of the frame: rows are assembled anew at every
 * instant. Small and slow. */
#define SMEAR_SET_ACCUMULATE_BANDS (1u << 15)

/* Beside SMEAR_AUTO, which it needs: room for lines, which targets from SMEAR_DRAFT (256) on take while the camera moves. It is a
 * window of a few tile rows (desc.reach and desc.tile are as with a filter) and one more for what lines have blurred:
 * SMEAR_MEMORY_SKETCH. What stands still is drawn into one to four pictures at even instants, whose mean is blurred along the line
 * to the next: each 8 x 8 pixels by 2 to 8 taps on the way that depth and two cameras tell. What pixels beside each other differ by
 * tells how many pictures the target takes: as many as the frame before was good with, else one from 7 codes (448) on and two
 * below, and more from the tile row on where that is too few; where four are, instants. What moves by itself is drawn over it once or
 * twice, and blurred along lines, too, within its tile row; or, where it turns by more than some ten degrees, deforms or is blended,
 * and with smooth edges, at one instant more than there are pictures. Lines need a shutter without a curve, and for targets below 7
 * codes hard edges; without, in a cut, and before a camera that stands still there are none. Frames of other targets and methods are
 * the same as without it, but that tiles may be larger. */
#define SMEAR_SET_SKETCH (1u << 14)

static inline uint8_t smear_method_is_temporal(int method)
{
    return method >= SMEAR_SUBFRAMES && method <= SMEAR_AUTO;
}

static inline uint8_t smear_method_is_filter(int method)
{
    return method == SMEAR_RECONSTRUCT || (method >= SMEAR_CAMERA && method <= SMEAR_HALF);
}

static inline uint8_t smear_method_has_layers(int method)
{
    return method == SMEAR_OBJECT || method == SMEAR_LAYERED;
}

/* ------------------------------------------------------------------ filters */

/* desc.filter: room beyond the usual for methods that filter. */
typedef struct smear_filter_room {
    uint8_t passes;             /* 2 or 3: passes of SMEAR_PINGPONG: 4 bytes per pixel of the window for each but the
                                 * last; 0 means 2 where desc.methods has SMEAR_PINGPONG. One may be had with any
                                 * window */
    uint8_t scatter;            /* 1: the reach may exceed the tile: motion of a tile is told to all tiles on its way,
                                 * and as many tile rows more are kept. Not with temporal methods, SMEAR_PINGPONG or
                                 * SMEAR_HALF */
} smear_filter_room;

/* What blurs within SMEAR_CAMERA and SMEAR_HALF. */
typedef enum smear_filter_kind {
    SMEAR_FILTER_DEFAULT,       /* MEAN in SMEAR_CAMERA, RECONSTRUCT in SMEAR_HALF */
    SMEAR_FILTER_MEAN,          /* `samples` taps, all alike, along each pixel's own velocity; in SMEAR_CAMERA along that
                                 * of 8 x 8 pixels (4, 8 or 16 taps) where nothing stays before the moving camera */
    SMEAR_FILTER_RECONSTRUCT,   /* as SMEAR_RECONSTRUCT, with its options */
    SMEAR_FILTER_PINGPONG       /* as SMEAR_PINGPONG, which desc.methods must have */
} smear_filter_kind;

/* How SMEAR_RECONSTRUCT departs from the Post Processing Stack v2 filter, or-ed together. */
enum {
    SMEAR_FENCE     = 1,    /* a static pixel takes nothing from behind: keeps the edges of static foreground */
    SMEAR_CORNER    = 2,    /* a diagonal neighbour counts only if its motion points here */
    SMEAR_BOX       = 4,    /* box shutter instead of the tent */
    SMEAR_DIRECTION = 8,    /* second direction as in Guertin 2014 */
    SMEAR_PUBLISHED = 16    /* nothing of ours: else the camera's motion is told from depth, what stands still with
                             * nothing in front stays sharp, and where all motion in reach is alike or changes
                             * without a step, the mean has no weights. Always so without SMEAR_WITH_FILTERS */
};

/* Whose weights SMEAR_RECONSTRUCT gives to what it gathers. FENCE, BOX and DIRECTION are departures of the first. */
typedef enum smear_weights {
    SMEAR_WEIGHTS_STACK,        /* Post Processing Stack v2 */
    SMEAR_WEIGHTS_MCGUIRE,      /* McGuire, Hennessy, Bukowski, Osman 2012 */
    SMEAR_WEIGHTS_GUERTIN,      /* Guertin, McGuire, Nowrouzezahrai 2014 */
    SMEAR_WEIGHTS_JIMENEZ       /* Jimenez 2014: the weights are an alpha, hidden sides are mirrored */
} smear_weights;

/* A blur in passes: each takes few taps of what the one before it left, `base` times closer, so that 8 and 8 taps weigh
 * like 64. */
typedef struct smear_pingpong {
    uint8_t passes;             /* 1..3, not above desc.filter.passes; 0 means 2. One is a direct blur */
    uint8_t taps;               /* of a pass, 2..64; 0 means 8 */
    uint8_t base;               /* 2..64; 0 means `taps`: all positions weigh alike. The comb of the original: 7 taps,
                                 * base 4 */
    uint8_t jitter;             /* how far taps are moved from pixel to pixel, in 1/128 of their spacing to either
                                 * side */
    uint8_t bias;               /* a tap nearer than its pixel by more than so many 1/256 of the distance is left out.
                                 * 255: none is. 0 means 255, with `spread` 16 */
    uint8_t spread;             /* 1: moving things spread over what is static: tile maxima tell a pixel what may come
                                 * over it */
} smear_pingpong;

/* frame.filter: what methods that filter do, and SMEAR_LAYERED as far as it says so. */
typedef struct smear_filter {
    uint8_t kind;               /* smear_filter_kind, of SMEAR_CAMERA and SMEAR_HALF */
    uint8_t flags;              /* SMEAR_FENCE | ...; 0: none */
    uint8_t weights;            /* smear_weights, of SMEAR_RECONSTRUCT and where it is the kind */
    uint8_t camera_step;        /* 1, 2 or 4: draws that do not move themselves get their velocity from depth and the
                                 * two cameras, at each pixel or each 2 x 2 or 4 x 4; the background too. 0: as 4 in
                                 * SMEAR_RECONSTRUCT and SMEAR_CAMERA; in others, and with SMEAR_PUBLISHED, from their
                                 * vertices, the background none. Not looked at along lines of SMEAR_FILTER_MEAN */
    smear_pingpong pingpong;
} smear_filter;

/* ------------------------------------------------------------------ layers */

/* frame.layer, up to SMEAR_LAYERS_MAX, copied with their cameras; null: one layer of all that moves. A layer is a set
 * of draws that is blurred on its own and merged over what is static, for SMEAR_OBJECT and SMEAR_LAYERED. A draw is in
 * the first of the frame's layers whose mask shares a bit with smear_draw.layers; in none, it is as SMEAR_NONE draws
 * it, bit for bit where no streak passes over it. So is what does not move. */
typedef struct smear_layer {
    uint8_t mask;               /* bits of smear_draw.layers; required */
    uint8_t method;             /* SMEAR_OBJECT, SMEAR_LAYERED, or SMEAR_NONE: sharp; 0: the frame's */
    uint8_t over;               /* 1: over all before it in the frame's list and all that is static, whatever the depths
                                 * are */
    uint8_t two_camera;         /* 1: SMEAR_OBJECT as two cameras do it: what moves along one velocity, that of the
                                 * layer's first draw, in `samples` taps (up to 64), over all that is static */
    uint16_t shutter_degrees;   /* 1..3600; 0: the frame's */
    const smear_camera *camera; /* its own: a cockpit, a weapon, a display in the view; implies `over`. Null: the
                                 * frame's */
    const smear_camera *open, *close;   /* as in smear_frame; null: `camera` does not move */
} smear_layer;

enum { SMEAR_LAYERS_MAX = 8 };

/* ------------------------------------------------------------------ the filter alone */

/* Blurs a frame that another renderer drew: begin, then every row from top to bottom, each once. Finished bands come
 * through flush as the window moves. Uses the context's desc (width, height, reach, tile, format; one worker) and of
 * `frame` the method (a filter, but not SMEAR_CAMERA) with its options, light, exposure, samples and shutter; camera
 * needs only near_plane. Errors are those of smear_begin and smear_render; smear_filter_row without smear_filter_begin
 * is SMEAR_ERR_ORDER. An error of flush ends the frame.
 *
 *     color     width pixels 0x00RRGGBB, sRGB-encoded
 *     depth     width distances along the view in Q16.16 units, 0 for background
 *     velocity  x y of each pixel in 1/16 px per frame, x right, y down */
int smear_filter_begin(struct smear_context *ctx, const struct smear_frame *frame);
int smear_filter_row(struct smear_context *ctx, const uint32_t *color, const uint32_t *depth, const int16_t *velocity);

#endif
