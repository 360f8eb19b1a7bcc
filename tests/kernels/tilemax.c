/* SPDX-License-Identifier: MIT */
/* tilemax.c - how check_kernels calls the tile maximum: a tile of a window of three by three, still, of few velocities or of
 * any. */
#include "filter/tilemax.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2
enum { TILE = 8, TILES = 2, WIDTH = TILES * TILE };
enum { SHAPE, MOTION };         /* words: the tile's motion from MOTION on */

static void prepare(struct kernel_call *c)
{
    int16_t *v = c->plane[0];
    const int32_t most = (c->word[SHAPE] & 1u) != 0 ? 2 : 500;
    for (int32_t i = 0; i < 2 * c->n; i++)
        if ((c->word[SHAPE] & 6u) != 0 || kernel_random() % 4u == 0)
            v[i] = (int16_t)kernel_between(-most, most);
}

static void tile(struct kernel_call *c, void (*reduce)(const struct smear_window *w, int32_t row, int32_t column))
{
    struct smear_tile_motion motion[3 * TILES] = { { 0, 0, 0, 0, 0, 0 } };
    struct smear_tile_neighborhood around[3 * TILES] = { { 0, 0, 0, 0 } };
    const bool narrow = (c->word[SHAPE] & 8u) != 0;
    const struct smear_window w = {
        .width = WIDTH, .height = c->n / WIDTH, .ring = c->n / WIDTH, .tile = TILE, .tile_shift = 3, .columns = TILES, .rows = 3,
        .lag = 1, .velocity8 = narrow ? c->plane[0] : NULL, .velocity16 = narrow ? NULL : c->plane[0], .motion = motion,
        .around = around
    };
    const int32_t row = w.height > TILE ? (int32_t)(c->word[SHAPE] >> 4 & 1u) : 0;
    const int32_t column = (int32_t)(c->word[SHAPE] >> 5 & 1u);
    if (w.height == 0)
        return;
    reduce(&w, row, column);
    const struct smear_tile_motion m = window_motion(&w, row)[column];
    const int32_t out[7] = { m.x, m.y, m.min_x, m.max_x, m.min_y, m.max_y, window_around(&w, row)[column].rough };
    for (int i = 0; i < 7; i++)
        c->word[MOTION + i] = (uint32_t)out[i];
}

static void reference(struct kernel_call *c)
{
    tile(c, smear_tilemax_reference);
}

static void eight(struct kernel_call *c)
{
    tile(c, smear_tilemax);
}
#endif

extern const struct kernel kernels_tilemax[];
const struct kernel kernels_tilemax[] = {
#if SMEAR_AVX2
    { .name = "tilemax", .most = 13 * WIDTH, .size = { 4 }, .prepare = prepare, .timed = TILE * WIDTH,
      .form = { { "reference", reference }, { "avx2", eight } } },
#endif
    { .name = NULL }
};
