/* SPDX-License-Identifier: MIT */
/* tilemax.c - how check_kernels calls the tile maximum: a tile of a window of three by three, still, of few velocities or of
 * any; and the neighbour maximum: a row of three of such tiles. */
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

enum { ROWS = 3, COLUMNS_MOST = 19 };

/* Vectors of them are shorter than 64 px. Of 100 and 101, 1.01 times one is the other. */
static int16_t component(uint32_t shape)
{
    static const int16_t few[] = { 0, 0, 100, 101, -100, 40 };
    const int32_t most = (shape & 1u) != 0 ? 10 : 360;
    return (int16_t)((shape & 2u) != 0 ? few[kernel_random() % 6u] : kernel_between(-most, most));
}

static void prepare_row(struct kernel_call *c)
{
    struct smear_tile_motion *const motion = c->plane[0];
    struct smear_tile_neighborhood *const around = c->plane[1];
    for (int32_t i = 0; i < ROWS * c->n; i++) {
        const bool still = (c->word[SHAPE] & 4u) != 0 && kernel_random() % 8u != 0;
        const int16_t x = still ? 0 : component(c->word[SHAPE]), y = still ? 0 : component(c->word[SHAPE]);
        const int16_t wide = still || (c->word[SHAPE] & 8u) != 0 ? 0 : (int16_t)kernel_between(0, 12);
        motion[i] = (struct smear_tile_motion){ x, y, (int16_t)(x - wide), x, y, (int16_t)(y + wide) };
        around[i].rough = (uint8_t)(kernel_random() >> ((c->word[SHAPE] & 16u) != 0 ? 5 : 0) & 255u) >> (c->word[SHAPE] >> 5 & 3u);
    }
}

typedef void neighbors_fn(const struct smear_window *w, int32_t row, int32_t known);

static void neighbors(struct kernel_call *c, neighbors_fn *find)
{
    const struct smear_window w = { .columns = c->n, .rows = ROWS, .lag = 1, .motion = c->plane[0], .around = c->plane[1] };
    const int32_t row = (int32_t)(c->word[SHAPE] >> 8) % ROWS;
    find(&w, row, min_i32(row + (int32_t)(c->word[SHAPE] >> 16 & 1u), ROWS - 1));
}

static void neighbors_reference(struct kernel_call *c) { neighbors(c, smear_neighbormax_row_reference); }

static void neighbors_eight(struct kernel_call *c)
{
    neighbors(c, smear_has_avx2() ? smear_neighbormax_row_avx2 : smear_neighbormax_row_reference);
}
#endif

extern const struct kernel kernels_tilemax[];
const struct kernel kernels_tilemax[] = {
#if SMEAR_AVX2
    { .name = "tilemax", .most = 13 * WIDTH, .size = { 4 }, .prepare = prepare, .timed = TILE * WIDTH,
      .form = { { "reference", reference }, { "avx2", eight } } },
    { .name = "neighbormax", .least = 1, .most = COLUMNS_MOST,
      .size = { ROWS * sizeof(struct smear_tile_motion), ROWS * sizeof(struct smear_tile_neighborhood) }, .align = { 4, 2 },
      .prepare = prepare_row, .timed = COLUMNS_MOST, .form = { { "reference", neighbors_reference }, { "avx2", neighbors_eight } } },
#endif
    { .name = NULL }
};
