/* SPDX-License-Identifier: MIT */
/* reconstruct.c - how check_kernels calls the reconstruction filter's forms: on tiles of small windows, of which each call
 * makes one from numbers: still and moving pixels of some depths, or of any. */
#include "filter/reconstruct.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2
enum { TILE = 16, REACH = 13, COLUMNS = 4, ROWS = 3, WIDTH = COLUMNS * TILE - 5, RING = ROWS * TILE };
enum { SEED, SHAPE, FLAGS, SAMPLES, TAPS };     /* words */

struct picture {
    uint32_t color[WIDTH * RING];
    uint16_t depth[WIDTH * RING];
    int16_t velocity[2 * WIDTH * RING];
    uint32_t offset[TILE + 2 * REACH];
    struct smear_tile_neighborhood around[3 * COLUMNS];
    struct smear_window window;
};

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* A velocity within the reach, by each axis at most 9 px. */
static int32_t velocity_of(uint32_t *seed, uint32_t shape)
{
    const int32_t most = (shape & 1u) != 0 ? 72 : 30;
    return (shape & 2u) != 0 && next(seed) % 3u == 0 ? 0 : (int32_t)(next(seed) % (uint32_t)(2 * most + 1)) - most;
}

static void make_planes(struct picture *p, uint32_t *seed, uint32_t shape)
{
    int32_t x = 0, y = 0;
    uint32_t depth = 0;
    for (int32_t i = 0; i < WIDTH * RING; i++) {
        if (next(seed) % ((shape & 4u) != 0 ? 2u : 9u) == 0) {
            x = velocity_of(seed, shape);
            y = velocity_of(seed, shape);
            depth = (shape & 8u) != 0 ? next(seed) & 65535u : 2000u + next(seed) % 5u * 60u + (shape >> 8 & 1u) * 40000u;
        }
        p->color[i] = next(seed) & 0xffffffu;
        p->depth[i] = (uint16_t)depth;
        if ((shape & 16u) != 0) {
            ((int8_t *)p->velocity)[2 * i] = (int8_t)x;
            ((int8_t *)p->velocity)[2 * i + 1] = (int8_t)y;
        } else {
            p->velocity[2 * i] = (int16_t)x;
            p->velocity[2 * i + 1] = (int16_t)y;
        }
    }
    for (int32_t i = 0; i < 3 * COLUMNS; i++) {
        if (i == 0 || (shape & 32u) != 0) {
            x = velocity_of(seed, shape) * 32;
            y = velocity_of(seed, shape) * 32;
        }
        p->around[i] = (struct smear_tile_neighborhood){ (int16_t)x, (int16_t)y, TILE_COMPLEX, 255 };
    }
}

typedef uint32_t reconstruct_fn(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows, int32_t row,
                                int32_t column, const struct smear_blur_settings *settings);

static void tile(struct kernel_call *c, reconstruct_fn *filter)
{
    static struct picture p;
    static uint32_t made_seed, made_shape;
    const uint32_t shape = c->word[SHAPE];
    uint32_t seed = c->word[SEED];
    if (seed != made_seed || shape != made_shape) {      /* it is timed without */
        made_seed = seed;
        made_shape = shape;
        make_planes(&p, &seed, shape);
    }
    p.window = (struct smear_window){
        .width = WIDTH, .height = RING, .tile = TILE, .tile_shift = 4, .reach = REACH, .columns = COLUMNS, .rows = ROWS, .ring = RING,
        .lag = 1, .color = p.color, .depth = p.depth, .velocity8 = (shape & 16u) != 0 ? (int8_t *)p.velocity : NULL,
        .velocity16 = (shape & 16u) != 0 ? NULL : p.velocity, .around = p.around
    };
    const int32_t row = (int32_t)(shape >> 16) % ROWS, column = (int32_t)(shape >> 20) % COLUMNS, y0 = row * TILE;
    for (int32_t i = 0; i < TILE + 2 * REACH; i++)
        p.offset[i] = (uint32_t)(clamp_i32(y0 - REACH + i, 0, RING - 1) * WIDTH);
    const struct smear_row_table rows = { p.offset, y0 - REACH, y0, y0 + c->n / TILE };
    const struct smear_blur_settings settings = {
        .linear = (shape & 64u) != 0, .samples = (int32_t)(c->word[SAMPLES] % 40u),
        .flags = (uint8_t)(c->word[FLAGS] & (SMEAR_FENCE | SMEAR_BOX))
    };
    c->word[TAPS] = filter(c->plane[0], &p.window, &rows, row, column, &settings);
}

static void reference(struct kernel_call *c)
{
    tile(c, smear_blur_reconstruct_reference);
}

static void eight(struct kernel_call *c)
{
    if (smear_has_avx2())
        tile(c, smear_blur_reconstruct);
    else
        reference(c);
}
#endif

extern const struct kernel kernels_reconstruct[];
const struct kernel kernels_reconstruct[] = {
#if SMEAR_AVX2
    { .name = "reconstruct (made, filtered)", .most = TILE * TILE, .size = { 4 }, .timed = TILE * TILE,
      .form = { { "reference", reference }, { "avx2", eight } } },
#endif
    { .name = NULL }
};
