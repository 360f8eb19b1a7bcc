/* SPDX-License-Identifier: MIT */
/* smear_stats.h - what a frame took, and what tests, tools and tuning may look at. Included by smear.h. */
#include "smear.h"      /* which includes this file where it needs it */
#ifndef SMEAR_STATS_H
#define SMEAR_STATS_H

struct smear_context;

/* Shows a drawn row before the blur. depth: codes, see smear_depth_units(). velocity: x y of each pixel in 1/256 px per
 * frame, before any clamp or packing. */
typedef void smear_inspect_fn(void *user, int y, const uint32_t *color, const uint16_t *depth, const int32_t *velocity);

/* desc.debug */
typedef struct smear_debug {
    uint8_t crc;                /* 1: statistics give the CRC of each frame; 0: no time is spent on it */
    smear_inspect_fn *inspect;  /* null: none; with a window; costs 8 bytes per pixel of it */
    uint32_t (*clock)(void *user);      /* null: no times in the statistics */
} smear_debug;

/* How full a list was, at most, and how much finds room in it. */
typedef struct smear_fill {
    uint32_t used, room;
} smear_fill;

typedef struct smear_stats {
    /* submitted; covering a pixel; left out for a bad index. In a frame drawn in parts the second counts a triangle
     * once per part, and the third may. */
    uint32_t triangles_in, triangles_drawn, triangles_dropped;
    uint32_t parts_added;               /* times a list was full: a part of the frame was halved, or a tile row's
                                         * triangles were gone through in turns */
    uint32_t draws_moved;               /* whose velocity came from their vertices: they moved, deformed, or (but with
                                         * camera_step) the camera did */
    uint32_t draws_beside;              /* left out, as their bounds lie beyond a side of the view; of a frame drawn in
                                         * parts, once per part at most */
    uint32_t pixels;                    /* of the frame */
    uint32_t samples;                   /* filter taps taken, or instants drawn x pixels */
    uint32_t tiles[SMEAR_METHOD_COUNT]; /* by the method each tile got: SMEAR_NONE where nothing moves, or all is of one
                                         * instant of a shutter without a curve (which adds no samples); SMEAR_AUTO's
                                         * tiles count as SMEAR_SUBFRAMES, those that only lines of a sketch blur as
                                         * SMEAR_CAMERA; layers count where they reach into a tile */
    uint32_t tiles_static, tiles_uniform, tiles_complex;        /* by the kind of motion in them; tiles of lines alone are uniform */
    uint32_t tiles_kept;                /* neither drawn nor sent: the display has them (desc.reuse.buffer_age) */
    uint8_t static_cached;              /* 1: what is static was not drawn, and is not among triangles_drawn */
    uint32_t target;                    /* SMEAR_AUTO: smear_frame.target, or what the budget allowed; of a frame drawn
                                         * in parts, each of which has its share, the coarsest */
    uint32_t work;                      /* with a budget: areas of moving triangles x instants, saturated */
    uint32_t crc32;                     /* of the bytes of all bands in their order, as in zlib (XRGB8888: R, G, B); 0
                                         * without desc.debug.crc */
    uint32_t arena_bytes;               /* memory in use */
    struct {                            /* ticks of desc.debug.clock */
        uint32_t submit, raster, reduce, blur, convert, total;
    } time;
    struct {                            /* triangles and vertices in bytes; draws of one layout of vertices; draws */
        smear_fill geometry, segments, draws;
    } fill;
} smear_stats;

/* Copies the statistics of the last frame that was rendered; of one that is being drawn they are not complete. */
void smear_get_stats(const struct smear_context *ctx, smear_stats *stats);

/* 16-bit depth grows towards the eye in two slopes: 0 is the background, 65535 the near plane. A perspective distance
 * is near_plane x SMEAR_DEPTH_NEAR / units; relative step at most 1/2048 for distances up to 256 near planes, 1/557 at
 * 1000. Orthographic: far - (far - near) x units / SMEAR_DEPTH_NEAR. */
#define SMEAR_DEPTH_NEAR 557040u

static inline uint32_t smear_depth_units(uint16_t code)
{
    return code < 32768u ? code : 32768u + (uint32_t)(code - 32768u) * 16u;
}

#endif
