/* SPDX-License-Identifier: MIT */
/* smear_memory.h - the memory of a usual context as a constant. Included by smear.h.
 *
 *     static uint64_t memory[SMEAR_MEMORY(240, 240, 600, 8)];                 // width, height, triangles, draws
 *     static uint64_t less[SMEAR_MEMORY(240, 240, 600, 8, SMEAR_RGB565)];     // of one format
 *     static uint64_t more[SMEAR_MEMORY(240, 240, 600, 8) + SMEAR_MEMORY_BAND(240, 240, SMEAR_XRGB8888)];  // two bands
 *     static uint64_t fast[SMEAR_MEMORY_SKETCH(240, 240, 600, 8)];            // with SMEAR_SET_SKETCH
 *
 * It is enough for every smear_desc that says no more than width, height, max_triangles, max_draws, format, callbacks
 * and a dither other than SMEAR_DITHER_DIFFUSE, and at most a kilobyte and a fiftieth more than SMEAR_XRGB8888, the
 * largest format, takes, or the format that is named. 0 triangles and draws mean the defaults of the desc. For others
 * `smear info --desc` prints the constant, smear_memory_size() returns it, and smear_init returns it when there is too
 * little. */
#include "smear.h"      /* which includes this file when it has all that is used here */
#ifndef SMEAR_MEMORY_H
#define SMEAR_MEMORY_H

/* Words of 8 bytes: a constant. */
#define SMEAR_MEMORY(...) SMEAR_MEMORY_OF_(__VA_ARGS__, SMEAR_XRGB8888, 0)

/* In place of SMEAR_MEMORY where methods are SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH, also with SMEAR_NONE; tile, reach and
 * strip are the defaults. It is a whole, to which BAND and WORKER do not add: its tiles are others. */
#define SMEAR_MEMORY_SKETCH(...) SMEAR_SKETCH_OF_(__VA_ARGS__, SMEAR_XRGB8888, 0)

/* Words that the second of two bands takes, and each of desc.workers but the first. */
#define SMEAR_MEMORY_BAND(width, height, format) \
    ((SMEAR_BAND_BYTES_((size_t)(width), SMEAR_TILE_(width, height), SMEAR_PIXEL_BITS_(format)) + 7u) / 8u)
#define SMEAR_MEMORY_WORKER(width, height) \
    ((SMEAR_WORKER_BYTES_((size_t)(width), SMEAR_TILE_(width, height)) + 7u) / 8u)

/* Returns how many bytes smear_init asked for by its result; 0: it did not. */
static inline size_t smear_memory_needed(int result)
{
    return result <= SMEAR_ERR_NEEDS ? (size_t)0 - (size_t)result : 0;
}

/* ------------------------------------------------------------------ in detail */

/* Bytes of one of each thing, at most, with pointers of 4 bytes and of 8: layout.c compares. */
#define SMEAR_BY_POINTER_(narrow, wide) (sizeof(void *) < 8 ? (narrow) : (wide))
#define SMEAR_CONTEXT_BYTES (SMEAR_BY_POINTER_(1480u, 1816u) + (SMEAR_WITH_LIGHTS ? 64u : 0u))      /* the context itself */
#define SMEAR_FILTERING_BYTES SMEAR_BY_POINTER_(304u, 328u)     /* what filters keep beside a window */
#define SMEAR_SUBMITTED_BYTES SMEAR_BY_POINTER_(188u, 224u)     /* a draw with its transforms */
#define SMEAR_SAMPLER_BYTES SMEAR_BY_POINTER_(44u, 56u) /* its texture's sampler */
#define SMEAR_KEPT_BYTES 56u                /* its id's last pose */
#define SMEAR_OLDER_BYTES 52u               /* the pose of an id before that: not with reuse.one_pose */
#define SMEAR_OLDER_CAMERA_BYTES SMEAR_BY_POINTER_(72u, 80u)
#define SMEAR_SEGMENT_BYTES 16u             /* vertices of one draw, or of 64 kilowords */
#define SMEAR_TRIANGLE_BYTES 36u            /* list entry (16) and its share of vertices: 12 bytes each, 4 more with a
                                             * texture, 8 with vertex colours or normals, 12 or 24 when moving */
#define SMEAR_TEMPORAL_TRIANGLE_BYTES 64u   /* with temporal methods: list entry (32), places at three instants: 36
                                             * bytes per vertex */
#define SMEAR_FLOW_BYTES 61u                /* how it moves in sketches */
#define SMEAR_CACHE_BYTES 24u               /* a transformed vertex in the cache */
#define SMEAR_STRIP 128                     /* strips this wide and wider take 16 columns more */

/* NAME_ is for this file only: w h width and height, t triangles, d draws, f format, T tile. */
#define SMEAR_MEMORY_OF_(w, h, t, d, f, ...) \
    ((SMEAR_FIXED_BYTES_ + SMEAR_TRIANGLES_BYTES_((size_t)(t) != 0 ? (size_t)(t) : 1024u) \
      + ((size_t)(d) != 0 ? (size_t)(d) : 16u) * SMEAR_DRAW_BYTES_ \
      + SMEAR_ROWS_BYTES_((size_t)(w), (size_t)(h), SMEAR_TILE_(w, h), SMEAR_PIXEL_BITS_(f)) + 7u) / 8u)

#define SMEAR_MIN_(a, b) ((a) < (b) ? (a) : (b))
#define SMEAR_UP_(size, step) (((size) + (step) - 1u) / (step) * (step))
/* With alignment, and the least list of triangles. */
#define SMEAR_FIXED_BYTES_ (SMEAR_CONTEXT_BYTES + SMEAR_OLDER_CAMERA_BYTES + 128u * SMEAR_CACHE_BYTES + 448u)
#define SMEAR_DRAW_BYTES_ \
    (SMEAR_SUBMITTED_BYTES + SMEAR_SAMPLER_BYTES + SMEAR_KEPT_BYTES + SMEAR_SEGMENT_BYTES \
     + (SMEAR_WITH_CURVES ? SMEAR_OLDER_BYTES : 0u))
#define SMEAR_IS_(f, format) ((int)(f) == (int)(format))
#define SMEAR_PIXEL_BITS_(f) \
    (SMEAR_IS_(f, SMEAR_XRGB8888) ? 32u : SMEAR_IS_(f, SMEAR_RGB332) || SMEAR_IS_(f, SMEAR_L8) ? 8u \
     : SMEAR_IS_(f, SMEAR_L4) ? 4u : SMEAR_IS_(f, SMEAR_L1) || SMEAR_IS_(f, SMEAR_L1_PAGES) ? 1u : 16u)
#define SMEAR_BAND_BYTES_(w, T, bits) ((SMEAR_UP_(w, 8u) * (T) * (bits) + 7u) / 8u)

#if SMEAR_WITH_SUBFRAMES                    /* SMEAR_AUTO */
/* At least a twentieth of the width. */
#define SMEAR_TILE_(w, h) ((w) <= 160 ? 8u : (w) <= 320 ? 16u : 32u)
#define SMEAR_COLUMNS_(w) ((w) > 160u ? 144u : SMEAR_MIN_(SMEAR_UP_(w, 8u), 64u))
#define SMEAR_REACH_(h) ((h) < 40u ? 1u : (h) > 1299u ? 64u : (h) * 5u / 100u)
/* Entries, vertices, a place in a row's list; a segment for each 50000 words. */
#define SMEAR_TRIANGLES_BYTES_(t) ((t) * (SMEAR_TEMPORAL_TRIANGLE_BYTES + 8u) + (t) / 192u)
/* Instants, sums, depths and finished pixels of a strip; what is known of a row's tiles and blocks of 8 x 8 pixels. */
#define SMEAR_STRIP_BYTES_(T, columns) ((columns) * (T) * 14u)
#define SMEAR_TILES_BYTES_(w, T) (((w) + (T) - 1u) / (T) * 21u + SMEAR_UP_(w, 8u) * (T) / 8u)
#define SMEAR_WORKER_BYTES_(w, T) SMEAR_STRIP_BYTES_(T, SMEAR_COLUMNS_(w))
/* Colour and depth of a row of tiles; the band; the last triangles of each row. */
#define SMEAR_ROWS_BYTES_(w, h, T, bits) \
    (SMEAR_WORKER_BYTES_(w, T) + SMEAR_TILES_BYTES_(w, T) + (w) * SMEAR_MIN_(T, h) * 6u + SMEAR_BAND_BYTES_(w, T, bits) \
     + ((h) + (T) - 1u) / (T) * 12u)
/* Sketches: at least the reach; two tile rows and the reach of colour and depth, and one more that lines have blurred, and once more
 * its colours where sums have no room for them; what blocks of four rows show, and what moves by itself there. Draws have flows. */
#define SMEAR_SKETCH_TILE_(h) ((h) <= 179 ? 8u : (h) <= 339 ? 16u : (h) <= 659 ? 32u : 64u)
#define SMEAR_SKETCH_COLUMNS_(w, T) ((T) == 8u ? SMEAR_MIN_(SMEAR_UP_(w, 8u), 64u) : (w) > 128u ? 144u : SMEAR_UP_(w, T))
#define SMEAR_SKETCH_ROWS_(w, h, T, bits) \
    (SMEAR_STRIP_BYTES_(T, SMEAR_SKETCH_COLUMNS_(w, T)) + SMEAR_TILES_BYTES_(w, T) + (w) * (3u * (T) + SMEAR_REACH_(h)) * 6u \
     + (SMEAR_SKETCH_COLUMNS_(w, T) * (T) * 10u < (w) * (T) * 4u ? (w) * (T) * 4u : 0u) + SMEAR_UP_(w, 8u) * (T) * 5u / 8u \
     + SMEAR_BAND_BYTES_(w, T, bits) + ((h) + (T) - 1u) / (T) * 36u + 256u)
#define SMEAR_SKETCH_TWICE_(d) (SMEAR_MIN_(3u * (d), 65536u - (d)) * SMEAR_SEGMENT_BYTES + (d) * SMEAR_FLOW_BYTES)
#define SMEAR_SKETCH_OF_(w, h, t, d, f, ...) \
    ((SMEAR_FIXED_BYTES_ + SMEAR_TRIANGLES_BYTES_((size_t)(t) != 0 ? (size_t)(t) : 1024u) \
      + ((size_t)(d) != 0 ? (size_t)(d) : 16u) * SMEAR_DRAW_BYTES_ + SMEAR_SKETCH_TWICE_((size_t)(d) != 0 ? (size_t)(d) : 16u) \
      + SMEAR_SKETCH_ROWS_((size_t)(w), (size_t)(h), SMEAR_SKETCH_TILE_(h), SMEAR_PIXEL_BITS_(f)) + 7u) / 8u)
#elif SMEAR_WITH_RECONSTRUCT                /* SMEAR_RECONSTRUCT */
#define SMEAR_REACH_(h) ((h) < 40u ? 1u : (h) > 1299u ? 64u : (h) * 5u / 100u)
#define SMEAR_TILE_(w, h) ((h) <= 179 ? 8u : (h) <= 339 ? 16u : (h) <= 659 ? 32u : 64u)
#define SMEAR_TRIANGLES_BYTES_(t) ((t) * SMEAR_TRIANGLE_BYTES + (t) / 256u)
/* A finished tile. */
#define SMEAR_WORKER_BYTES_(w, T) ((T) * (T) * 4u + 0u * (w))
/* The window's colour, depth and velocity; motion of its tiles and offsets of its rows; the band. */
#define SMEAR_ROWS_BYTES_(w, h, T, bits) \
    (SMEAR_FILTERING_BYTES + (w) * (2u * (T) + SMEAR_REACH_(h)) * (SMEAR_REACH_(h) <= 15u ? 8u : 10u) \
     + ((w) + (T) - 1u) / (T) * 55u + ((T) + 2u * SMEAR_REACH_(h)) * 4u + SMEAR_WORKER_BYTES_(w, T) \
     + SMEAR_BAND_BYTES_(w, T, bits) + ((h) + (T) - 1u) / (T) * 8u)
#else                                       /* SMEAR_NONE */
#define SMEAR_TILE_(w, h) ((w) <= 160 ? 8u : (w) <= 320 ? 16u : 32u)
#define SMEAR_TRIANGLES_BYTES_(t) ((t) * SMEAR_TRIANGLE_BYTES + (t) / 256u)
/* Colour and depth of rows, and numbers of triangles. */
#define SMEAR_WORKER_BYTES_(w, T) ((w) * (sizeof(void *) < 8 ? (T) : 64u) * 7u + 1024u)
/* 64-bit machines draw a quarter of the height at once. */
#define SMEAR_HIGH_(h, T) \
    (sizeof(void *) < 8 ? (size_t)(T) : SMEAR_MIN_(((h) + 4u * (T) - 1u) / (4u * (T)) * (size_t)(T), 64u))
#define SMEAR_ROWS_BYTES_(w, h, T, bits) \
    ((w) * SMEAR_MIN_(SMEAR_HIGH_(h, T), h) * 6u + ((w) + (T) - 1u) / (T) \
     + SMEAR_BAND_BYTES_(w, SMEAR_HIGH_(h, T), bits) + ((h) + SMEAR_HIGH_(h, T) - 1u) / SMEAR_HIGH_(h, T) * 8u)
#endif

#endif
