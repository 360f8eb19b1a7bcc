/* SPDX-License-Identifier: MIT */
/* smear_memory.h - the memory of a context as a constant, from the values that its desc has.
 *
 *     #define SCREEN 240, 240, 600, 8         // width, height, triangles, draws
 *     static uint64_t memory[SMEAR_MEMORY_WORDS(SCREEN)];
 *     smear_desc desc = SMEAR_DESC(SCREEN);
 *
 * Both take the first values of a smear_desc in their order; what is left out is 0, the default:
 *
 *     width, height, max_triangles, max_draws, methods, tile, reach, strip, band_rows, bands, format, workers,
 *     vertex_cache, reuse.cache_static, reuse.buffer_age, filter.passes, filter.scatter, reuse.one_pose, display.dither,
 *     display.doubled
 *
 * Format, band_rows and display set the size of a band: give them here rather than later, as SMEAR_XRGB8888 is both the
 * default and the largest. desc.debug.inspect takes memory that SMEAR_MEMORY does not know of.
 *
 * SMEAR_MEMORY is never less than smear_memory_size(), and where nothing was left out (smear_config.h) more by 64 bytes at most. */
#ifndef SMEAR_MEMORY_H
#define SMEAR_MEMORY_H

#include "smear.h"

/* Bytes, and words of 8 bytes: constants. */
#define SMEAR_MEMORY(...) SMEAR_MEMORY_OF_(__VA_ARGS__, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)
#define SMEAR_MEMORY_WORDS(...) ((SMEAR_MEMORY(__VA_ARGS__) + 7u) / 8u)

/* A desc of the same values: without format and callbacks it is all default. */
#define SMEAR_DESC(...) SMEAR_DESC_OF_(__VA_ARGS__, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)

/* Bytes of one of each thing, at most, with pointers of 4 bytes and of 8. */
#define SMEAR_BY_POINTER_(narrow, wide) (sizeof(void *) < 8 ? (narrow) : (wide))
#define SMEAR_CONTEXT_BYTES SMEAR_BY_POINTER_(1448u, 1752u)     /* the context itself */
#define SMEAR_FILTERING_BYTES SMEAR_BY_POINTER_(304u, 328u)     /* what filters keep beside a window */
#define SMEAR_SUMMING_BYTES SMEAR_BY_POINTER_(16u, 16u)         /* what SMEAR_ACCUMULATE keeps beside its sums */
#define SMEAR_DAMAGE_BYTES SMEAR_BY_POINTER_(40u, 64u)  /* what is kept beside the window's rows or the display's tiles */
#define SMEAR_DAMAGED_DRAW_BYTES 16u        /* what is kept of a draw where the display keeps tiles of sharp frames */
#define SMEAR_SUBMITTED_BYTES SMEAR_BY_POINTER_(188u, 224u)     /* a draw with its transforms */
#define SMEAR_SAMPLER_BYTES SMEAR_BY_POINTER_(44u, 56u) /* its texture's sampler */
#define SMEAR_KEPT_BYTES 56u                /* its id's last pose */
#define SMEAR_OLDER_BYTES 52u               /* the pose of an id before that: not with reuse.one_pose */
#define SMEAR_OLDER_CAMERA_BYTES SMEAR_BY_POINTER_(72u, 80u)
#define SMEAR_TRIANGLE_BYTES 36u            /* list entry (16) and its share of vertices: 12 bytes each, 4 more with a
                                             * texture, 8 with vertex colours or normals, 12 or 24 when moving */
#define SMEAR_TEMPORAL_TRIANGLE_BYTES 64u   /* with temporal methods: list entry (32), places at three instants: 36 bytes
                                             * per vertex */
#define SMEAR_CACHE_BYTES 40u               /* a transformed vertex in the cache */
#define SMEAR_SEGMENT_BYTES 16u             /* vertices of one draw, or of 64 kilowords */
#define SMEAR_GROUP_BYTES 56u               /* draws that are blurred together */
#define SMEAR_LAYER_BYTES SMEAR_BY_POINTER_(220u, 232u) /* a layer with its cameras */
#define SMEAR_LAYERS_BYTES SMEAR_BY_POINTER_(120u, 208u)
#define SMEAR_WINDOW_BYTES SMEAR_BY_POINTER_(64u, 96u)  /* what is known of rows in memory */
#define SMEAR_MASK_BYTES 7696u              /* time samples and lists of a worker */
#define SMEAR_STRIP 128                     /* strips this wide and wider take 16 columns more */

/* ------------------------------------------------------------------ in detail */

/* NAME_ is for this file only. Defaults first, then the sum with every value resolved: w h width and height, t triangles,
 * d draws, m methods, T tile, r reach, s strip, b band_rows, n bands, f format, k workers, v vertex_cache, c cache_static,
 * a buffer_age, p passes, x scatter, o one_pose. */
#define SMEAR_UP8_(bytes) (((size_t)(bytes) + 7u) & ~(size_t)7u)
#define SMEAR_PARTS_(whole, part) (((size_t)(whole) + (size_t)(part) - 1u) / (size_t)(part))
#define SMEAR_MIN_(a, b) ((a) < (b) ? (a) : (b))
#define SMEAR_MAX_(a, b) ((a) > (b) ? (a) : (b))
#define SMEAR_OR_(value, otherwise) ((value) != 0 ? (value) : (otherwise))

#define SMEAR_SET_OF_(m) SMEAR_OR_(m, SMEAR_SET_DEFAULT)
#define SMEAR_HAS_WINDOW_(m) (((m) & SMEAR_SET_FILTERS) != 0)
#define SMEAR_HAS_TEMPORAL_(m) (((m) & SMEAR_SET_TEMPORAL) != 0)
#define SMEAR_HAS_LAYERS_(m) (((m) & SMEAR_SET_LAYERS) != 0)
#define SMEAR_HAS_REACH_(m) (((m) & (SMEAR_SET_FILTERS | SMEAR_SET_LAYERS)) != 0)
#define SMEAR_HAS_TILES_(m, a) (((m) & (SMEAR_SET_FILTERS | SMEAR_SET_LAYERS | SMEAR_SET_TEMPORAL)) != 0 || (a) != 0)

#define SMEAR_REACH_OF_(m, h, r) \
    (SMEAR_HAS_REACH_(m) ? SMEAR_OR_(r, (h) < 40 ? 1 : (h) > 1299 ? 64 : (h) * 5 / 100) : 0)
/* Without a reach at least a twentieth of the width. */
#define SMEAR_TILE_OF_(m, w, r, T) \
    SMEAR_OR_(T, SMEAR_TILE_ABOVE_(SMEAR_HAS_REACH_(m) ? (r) : ((w) + 19) / 20, SMEAR_HAS_REACH_(m) ? 64 : 32))
#define SMEAR_TILE_ABOVE_(px, most) ((px) <= 8 ? 8 : (px) <= 16 ? 16 : (px) <= 32 ? 32 : (most))
#define SMEAR_STRIP_OF_(m, w, T, s) \
    SMEAR_MIN_(SMEAR_HAS_TEMPORAL_(m) ? SMEAR_OR_((size_t)(s), SMEAR_MAX_((size_t)(T), SMEAR_MIN_((size_t)(T) * 8u, SMEAR_STRIP))) \
                                      : (size_t)(T), \
               SMEAR_PARTS_(w, T) * (size_t)(T))

/* Bands of sharp frames whose tile is the default, too. */
#define SMEAR_BAND_ROWS_(m, w, h, r, T, a) \
    ((T) != 0 || SMEAR_HAS_TILES_(m, a) || sizeof(void *) < 8 ? 0u : SMEAR_HIGH_BAND_(h, SMEAR_TILE_OF_(m, w, r, T)))
#define SMEAR_HIGH_BAND_(h, T) SMEAR_MIN_(SMEAR_PARTS_(h, 4 * (T)) * (size_t)(T), 64u)

#define SMEAR_MEMORY_OF_(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, x, o, q, z, ...) \
    SMEAR_STEP_1_(w, h, SMEAR_OR_(t, 1024u), SMEAR_OR_(d, 16u), SMEAR_SET_OF_(m), T, \
                  SMEAR_REACH_OF_(SMEAR_SET_OF_(m), h, r), s, b, SMEAR_OR_(n, 1u), f, SMEAR_OR_(k, 1u), \
                  SMEAR_OR_(v, 64u), c, a, p, o, q, z)
#define SMEAR_MEMORY_1_(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, o, q, z) \
    SMEAR_STEP_2_(w, h, t, d, m, SMEAR_TILE_OF_(m, w, r, T), r, s, \
                  SMEAR_OR_((size_t)(b), SMEAR_BAND_ROWS_(m, w, h, r, T, a)), n, f, k, v, c, a, p, o, q, z)
#define SMEAR_MEMORY_2_(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, o, q, z) \
    SMEAR_STEP_3_(w, h, t, d, m, T, r, SMEAR_STRIP_OF_(m, w, T, s), SMEAR_OR_(b, (size_t)(T)), n, f, k, v, c, a, p, o, q, z)
#define SMEAR_MEMORY_3_(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, o, q, z) \
    (SMEAR_UP8_(SMEAR_CONTEXT_BYTES) + SMEAR_ROWS_(w, m, r, SMEAR_RING_(w, h, m, T, r, b, c, a), SMEAR_PARTS_(w, T), p) \
     + SMEAR_WINDOW_(m, T, r, SMEAR_PARTS_(w, T)) + SMEAR_HALF_(m, w, T, r, k) \
     + SMEAR_SCRATCH_(m, T, SMEAR_COLUMNS_(m, w, T, s), b, k) \
     + SMEAR_TEMPORAL_(m, w, t, T, SMEAR_COLUMNS_(m, w, T, s), k, SMEAR_PARTS_(w, T)) \
     + SMEAR_DAMAGE_(d, m, c, a, SMEAR_PARTS_(w, T), SMEAR_PARTS_(h, T)) + SMEAR_LAYERS_(w, h, m, T, r, d, k) \
     + SMEAR_SUMS_(w, h, m, SMEAR_ROW_PX_(m, a, T, b)) + SMEAR_BANDS_(w, b, n, f, q, z) \
     + SMEAR_UP8_((size_t)(d) * SMEAR_SUBMITTED_BYTES) + (size_t)(d) * SMEAR_KEPT_BYTES \
     + SMEAR_UP8_((size_t)(d) * SMEAR_SAMPLER_BYTES) + SMEAR_OLDER_(d, o) + SMEAR_STORE_(t, d, m) \
     + SMEAR_RINGS_(m, SMEAR_PARTS_(h, SMEAR_ROW_PX_(m, a, T, b))) + SMEAR_UP8_((size_t)(v) * SMEAR_CACHE_BYTES))
/* The last triangle of each row: opaque, blended, moving. */
#define SMEAR_RINGS_(m, rows) \
    (2u * SMEAR_UP8_((rows) * 4u) + (SMEAR_HAS_TEMPORAL_(m) || SMEAR_HAS_LAYERS_(m) \
                                         ? SMEAR_UP8_(((rows) + (SMEAR_HAS_LAYERS_(m) ? 2u : 0u)) * 4u) : 0u))

/* Rows that are drawn at once, and rows that are kept. */
#define SMEAR_ROW_PX_(m, a, T, b) (SMEAR_HAS_TILES_(m, a) ? (size_t)(T) : (size_t)(b))
#define SMEAR_RING_(w, h, m, T, r, b, c, a) \
    SMEAR_MAX_((c) ? (size_t)(h) : 0u, \
               SMEAR_HAS_WINDOW_(m) ? (SMEAR_PARTS_(r, T) + 1u) * (size_t)(T) + (size_t)(r) \
                                    : SMEAR_MIN_(SMEAR_ROW_PX_(m, a, T, b), (size_t)(h)))
/* Colour and depth of the rows, velocity, what passes leave; which tiles move. */
#define SMEAR_ROWS_(w, m, r, ring, columns, p) \
    (SMEAR_UP8_((size_t)(w) * (ring) * 4u) * (1u + SMEAR_PASSES_(m, p)) + SMEAR_UP8_((size_t)(w) * (ring) * 2u) \
     + (SMEAR_HAS_WINDOW_(m) ? SMEAR_UP8_((size_t)(w) * (ring) * SMEAR_VELOCITY_BYTES_(r)) : 0u) + SMEAR_UP8_(columns))
#define SMEAR_PASSES_(m, p) \
    ((p) > 1 ? (size_t)(p) - 1u : (p) == 0 && ((m) & SMEAR_SET(SMEAR_PINGPONG)) != 0 ? 1u : 0u)
#define SMEAR_VELOCITY_BYTES_(r) ((r) <= 15 ? 2u : 4u)
/* Motion of tiles and of their neighbourhoods; offsets of rows. */
#define SMEAR_WINDOW_(m, T, r, columns) \
    (SMEAR_HAS_WINDOW_(m) ? SMEAR_FILTERING_BYTES + SMEAR_UP8_((columns) * (2u * SMEAR_PARTS_(r, T) + 1u) * 12u) \
                                + SMEAR_UP8_((columns) * (2u * SMEAR_PARTS_(r, T) + 1u) * 6u) \
                                + SMEAR_UP8_(((size_t)(T) + 2u * (size_t)(r)) * 4u) \
                          : 0u)
/* A window of half the size, and a tile of it per worker. */
#define SMEAR_HALF_(m, w, T, r, k) \
    (((m) & SMEAR_SET(SMEAR_HALF)) == 0 ? 0u \
         : SMEAR_WINDOW_BYTES + SMEAR_UP8_(SMEAR_PARTS_(w, 2) * ((size_t)(T) + SMEAR_PARTS_(r, 2)) * 4u) \
               + SMEAR_UP8_(SMEAR_PARTS_(w, 2) * ((size_t)(T) + SMEAR_PARTS_(r, 2)) * 2u) \
               + SMEAR_UP8_(SMEAR_PARTS_(w, 2) * ((size_t)(T) + SMEAR_PARTS_(r, 2)) * ((r) <= 30 ? 2u : 4u)) \
               + SMEAR_UP8_(SMEAR_PARTS_(w, T) * 36u) + SMEAR_UP8_(SMEAR_PARTS_(w, T) * 18u) \
                                            + SMEAR_UP8_((size_t)(k) * (size_t)(T) * (size_t)(T)))
/* Finished pixels of a worker: a tile, or a strip with what is drawn beyond its sides. */
#define SMEAR_COLUMNS_(m, w, T, s) \
    (SMEAR_HAS_TEMPORAL_(m) ? (s) + ((s) >= SMEAR_STRIP && (s) < (size_t)(w) ? 16u : 0u) : (s))
#define SMEAR_SCRATCH_(m, T, columns, b, k) \
    (SMEAR_HAS_WINDOW_(m) || SMEAR_HAS_TEMPORAL_(m) ? SMEAR_UP8_((size_t)(k) * (size_t)(b) * (columns) * 4u) : 0u)
#define SMEAR_BLOCKS_(m, w, T) \
    ((m) & SMEAR_SET(SMEAR_AUTO) ? (((size_t)(w) + 7u) / 8u) * (((size_t)(T) + 7u) / 8u) * 8u : 0u)
/* Moving triangles, tiles and blocks of 8 x 8 pixels of a row; sums and depths of instants, or time samples and lists, of a worker. */
#define SMEAR_TEMPORAL_(m, w, t, T, columns, k, tiles) \
    (SMEAR_HAS_TEMPORAL_(m) ? SMEAR_UP8_((size_t)(t) * 8u) + SMEAR_UP8_((tiles) * ((k) > 1 ? 40u : 20u)) \
                                  + SMEAR_BLOCKS_(m, w, T) * ((k) > 1 ? 2u : 1u) \
                                  + (size_t)(k) * SMEAR_MAX_(SMEAR_UP8_((columns) * (size_t)(T) * 10u) + 512u, \
                                                             (m) & SMEAR_SET(SMEAR_TIMEMASK) ? SMEAR_MASK_BYTES : 0u) \
                            : 0u)
#define SMEAR_DAMAGE_(d, m, c, a, columns, rows) \
    ((c) || (a) ? SMEAR_DAMAGE_BYTES + ((a) ? SMEAR_UP8_((size_t)(d) * (SMEAR_HAS_TEMPORAL_(m) ? 4u : 0u)) \
                                            + ((m) & SMEAR_SET(SMEAR_NONE) && !(c) ? (size_t)(d) * SMEAR_DAMAGED_DRAW_BYTES : 0u) \
                                            + SMEAR_UP8_((columns) * (rows)) \
                                            + (SMEAR_WITH_OVERLAY ? SMEAR_UP8_((columns) * (rows) * 4u) : 0u) : 0u) : 0u)
/* Rows of a layer with their margins; what groups leave for others they pass through; sums; groups. */
#define SMEAR_LAYERS_(w, h, m, T, r, d, k) \
    (SMEAR_HAS_LAYERS_(m) \
         ? SMEAR_UP8_(SMEAR_LAYER_PX_(w, T, r) * 4u) + SMEAR_UP8_(SMEAR_LAYER_PX_(w, T, r) * 2u) \
               + SMEAR_UP8_(SMEAR_LAYER_PX_(w, T, r) * SMEAR_VELOCITY_BYTES_(r)) \
               + SMEAR_UP8_((size_t)(w) * (size_t)(T) * 4u) + SMEAR_UP8_((size_t)(w) * (size_t)(T) * 2u) \
               + SMEAR_UP8_((SMEAR_LAYER_WIDTH_(w, r) / (size_t)(T) + 1u) * 12u) \
               + 2u * SMEAR_UP8_(SMEAR_LAYER_ROWS_(T, r) * 2u) + (size_t)(d) * SMEAR_GROUP_BYTES + 3u * SMEAR_UP8_((size_t)(d) * 2u) \
               + SMEAR_UP8_(d) + (size_t)(k) * ((size_t)(T) * 560u + 5120u) + SMEAR_LAYERS_BYTES \
               + SMEAR_UP8_(SMEAR_LAYERS_MAX * SMEAR_LAYER_BYTES) \
         : 0u)
#define SMEAR_LAYER_WIDTH_(w, r) ((size_t)(w) + 2u * (((size_t)(r) + 3u) & ~(size_t)3u))
#define SMEAR_LAYER_ROWS_(T, r) ((size_t)(T) + 2u * (size_t)(r))
#define SMEAR_LAYER_PX_(w, T, r) (SMEAR_LAYER_WIDTH_(w, r) * SMEAR_LAYER_ROWS_(T, r))
/* Poses and a camera of two frames ago. */
#define SMEAR_OLDER_(d, o) \
    (SMEAR_WITH_CURVES && !(o) ? SMEAR_UP8_((size_t)(d) * SMEAR_OLDER_BYTES) + SMEAR_OLDER_CAMERA_BYTES : 0u)
/* SMEAR_ACCUMULATE: r g b of the frame's pixels, or of a band's. */
#define SMEAR_SUMS_(w, h, m, rows) \
    (((m) & SMEAR_SET(SMEAR_ACCUMULATE)) != 0 ? SMEAR_SUMMING_BYTES + SMEAR_UP8_((size_t)(w) * (size_t)(h) * SMEAR_SUM_BYTES_) \
     : ((m) & SMEAR_SET_ACCUMULATE_BANDS) != 0 ? SMEAR_SUMMING_BYTES + SMEAR_UP8_((size_t)(w) * (rows) * SMEAR_SUM_BYTES_) : 0u)
#define SMEAR_SUM_BYTES_ (SMEAR_WITH_LINEAR ? 12u : 6u)
/* Bands as they are sent, or in 8-bit greys before that, and what a row of these leaves to the next. */
#define SMEAR_BANDS_(w, b, n, f, q, z) \
    ((size_t)(n) * SMEAR_UP8_(SMEAR_MAX_(SMEAR_BAND_BYTES_((size_t)(w) << ((z) & 1), (size_t)(b) << ((z) >> 1), f), \
                                         (q) == SMEAR_DITHER_DIFFUSE ? (size_t)(w) * (size_t)(b) : 0u)) \
     + ((q) == SMEAR_DITHER_DIFFUSE ? SMEAR_UP8_((size_t)(w) * 3u + 4u) : 0u))
#define SMEAR_BAND_BYTES_(w, b, f) \
    ((f) == SMEAR_XRGB8888 ? (size_t)(w) * (size_t)(b) * 4u \
     : (f) == SMEAR_RGB565 || (f) == SMEAR_RGB565_SWAPPED || (f) == SMEAR_RGB555 ? (size_t)(w) * (size_t)(b) * 2u \
     : (f) == SMEAR_L4 ? SMEAR_PARTS_(w, 2) * (size_t)(b) \
     : (f) == SMEAR_L1 ? SMEAR_PARTS_(w, 8) * (size_t)(b) \
     : (f) == SMEAR_L1_PAGES ? (size_t)(w) * SMEAR_PARTS_(b, 8) : (size_t)(w) * (size_t)(b))
/* Triangles and vertices; segments. */
#define SMEAR_STORE_WORDS_(t, m) \
    SMEAR_MAX_((size_t)(t) * ((SMEAR_HAS_TEMPORAL_(m) ? SMEAR_TEMPORAL_TRIANGLE_BYTES : SMEAR_TRIANGLE_BYTES) / 4u), 64u)
#define SMEAR_STORE_(t, d, m) \
    (SMEAR_UP8_(SMEAR_STORE_WORDS_(t, m) * 4u) \
     + SMEAR_MIN_((size_t)(d) + 2u + SMEAR_STORE_WORDS_(t, m) / 50000u, 65536u) * SMEAR_SEGMENT_BYTES)

/* Each step is a function where the language has functions that are constants, so that compilers read it once; else its text
 * lies in that of the next, which takes a compiler of C++ seconds. */
#if defined(__cplusplus) && __cplusplus >= 201103L
#define SMEAR_STEP_1_ smear_memory_1_
#define SMEAR_STEP_2_ smear_memory_2_
#define SMEAR_STEP_3_ smear_memory_3_
#define SMEAR_STEP_OF_(name, step) \
    static inline constexpr size_t name(size_t w, size_t h, size_t t, size_t d, size_t m, size_t T, size_t r, size_t s, size_t b, \
                                        size_t n, size_t f, size_t k, size_t v, size_t c, size_t a, size_t p, size_t o, size_t q, \
                                        size_t z) \
    { \
        return step(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, o, q, z); \
    }
SMEAR_STEP_OF_(smear_memory_3_, SMEAR_MEMORY_3_)
SMEAR_STEP_OF_(smear_memory_2_, SMEAR_MEMORY_2_)
SMEAR_STEP_OF_(smear_memory_1_, SMEAR_MEMORY_1_)
#undef SMEAR_STEP_OF_
#else
#define SMEAR_STEP_1_ SMEAR_MEMORY_1_
#define SMEAR_STEP_2_ SMEAR_MEMORY_2_
#define SMEAR_STEP_3_ SMEAR_MEMORY_3_
#endif

/* What SMEAR_DESC calls. */
#define SMEAR_DESC_OF_(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, x, o, q, z, ...) \
    smear_desc_of(w, h, t, d, m, T, r, s, b, n, f, k, v, c, a, p, x, o, q, z)

static inline smear_desc smear_desc_of(int16_t width, int16_t height, uint32_t max_triangles, uint16_t max_draws,
                                       uint16_t methods, int16_t tile, int16_t reach, int16_t strip, int16_t band_rows,
                                       uint8_t bands, uint8_t format, uint8_t workers, uint16_t vertex_cache,
                                       uint8_t cache_static, uint8_t buffer_age, uint8_t passes, uint8_t scatter,
                                       uint8_t one_pose, uint8_t dither, uint8_t doubled)
{
    static const smear_desc none = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, { 0, 0, 0 }, { 0, 0 }, { 0, 0 }, 0, 0, 0, { 0, 0, 0 } };
    smear_desc desc = none;
    desc.width = width;
    desc.height = height;
    desc.max_triangles = max_triangles;
    desc.max_draws = max_draws;
    desc.methods = methods;
    desc.tile = tile;
    desc.reach = reach;
    desc.strip = strip;
    desc.band_rows = band_rows;
    desc.bands = bands;
    desc.format = format;
    desc.workers = workers;
    desc.vertex_cache = vertex_cache;
    desc.reuse.cache_static = cache_static;
    desc.reuse.buffer_age = buffer_age;
    desc.filter.passes = passes;
    desc.filter.scatter = scatter;
    desc.reuse.one_pose = one_pose;
    desc.display.dither = dither;
    desc.display.doubled = doubled;
    return desc;
}

#endif
