/* SPDX-License-Identifier: MIT */
/* flat_eight.c - how check_kernels calls flat_eight of kernels/flat_face.h: eights of random triangles, and one after the other by
 * flat_face, which is what defines the result. Each call makes many from one number. */
#include "kernels/flat_face.h"

#include "tests/kernels/eights.h"
#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { EIGHTS = 20, SEED = 0, COLUMNS = 48, ROWS = 20 };

struct canvas {
    uint32_t pixel[COLUMNS * ROWS];
    uint16_t depth[COLUMNS * ROWS];
};

static void one_by_one(const struct flat_area *a, const struct poses *p, const struct planes8 *planes, const uint32_t color[8],
                       uint32_t which)
{
    for (int k = 0; k < 8; k++) {
        const bool far = (planes->far >> k & 1u) != 0, near = (planes->near >> k & 1u) != 0;
        const enum depth_slope slope = far ? SLOPE_FAR : SLOPE_NEAR;
        const int32_t units = (int32_t)((uint32_t)planes->at[k] + (uint32_t)planes->dy[k] * (uint32_t)a->y0);
        struct flat_face f = { { p->record[k][0], p->record[k][1], p->record[k][2] }, (uint32_t)units - FLAT_BREAK,
                               (uint32_t)planes->dx[k], (uint32_t)planes->dy[k],
                               a->narrow ? rgb565_nearest(color[k]) : color[k] & 0xffffffu, !far && !near };
        if (!f.breaks) {
            f.z = code_from_units(units, slope);
            f.dz = (uint32_t)step_from_units(planes->dx[k], slope);
            f.dz_down = (uint32_t)step_from_units(planes->dy[k], slope);
        }
        if ((which >> k & 1u) != 0)
            flat_face_reference(a, &f);
    }
}

static void by_eight(const struct flat_area *a, const struct poses *p, const struct planes8 *planes, const uint32_t color[8],
                     uint32_t which)
{
    struct flat_eight e;
    smear_flat_eight_make_avx2(&e, a, p, planes, color);
    smear_flat_eight_draw_avx2(&e, a, which);
}

typedef void draw_eight(const struct flat_area *a, const struct poses *p, const struct planes8 *planes, const uint32_t color[8],
                        uint32_t which);

/* Puts every other triangle where the canvas is. */
static void move_there(struct poses *p, int32_t x, int32_t y, uint32_t *seed)
{
    for (int k = 0; k < 8; k += 2) {
        const int32_t right = (x << 8) - p->record[k][0][0] + eight_between(seed, 0, COLUMNS << 8);
        const int32_t down = (y << 8) - p->record[k][0][1] + eight_between(seed, 0, ROWS << 8);
        const int32_t guard = SMEAR_GUARD_PX << 8;
        for (int i = 0; i < 3; i++) {
            p->record[k][i][0] = clamp_i32(p->record[k][i][0] + right, -guard, guard);
            p->record[k][i][1] = clamp_i32(p->record[k][i][1] + down, -guard, guard);
        }
    }
    p->seen = 0;
    for (int k = 0; k < 8; k++)
        p->seen |= (uint32_t)((int64_t)eight_area(p->record[k]) > 0) << k;
    eight_take(p);
}

static void many(struct kernel_call *c, draw_eight *draw)
{
    struct canvas canvas = { .pixel = { 0 } };
    struct poses poses;
    struct planes8 planes;
    uint32_t seed = c->word[SEED], sum = 0, color[8];
    const bool narrow = (seed & 1u) != 0;
    for (int i = 0; i < EIGHTS; i++) {
        const int32_t x = eight_between(&seed, 0, 300), y = eight_between(&seed, 0, 200), x0 = eight_between(&seed, 0, 30);
        eight_make(&poses, &seed);
        move_there(&poses, x, y, &seed);
        smear_planes8_avx2(&planes, &poses, SLOPE_BREAK);
        for (int k = 0; k < 8; k++)
            color[k] = eight_next(&seed);
        const int32_t x1 = eight_between(&seed, x0 + FLAT_FACE_LEAST, COLUMNS), rows = eight_between(&seed, 1, ROWS);
        const struct flat_area area = { (uint8_t *)canvas.pixel - (narrow ? 2 : 4) * x, canvas.depth - x, COLUMNS, x + x0, x + x1,
                                        y, y + rows, narrow };
        draw(&area, &poses, &planes, color, poses.seen);
    }
    for (int i = 0; i < COLUMNS * ROWS; i++)
        sum = (sum * 31u + canvas.pixel[i]) * 31u + canvas.depth[i];
    c->word[1] = sum;
}

static void reference(struct kernel_call *c) { many(c, one_by_one); }
static void by_eights(struct kernel_call *c) { many(c, smear_has_avx2() ? by_eight : one_by_one); }
#endif

extern const struct kernel kernels_flat_eight[];
const struct kernel kernels_flat_eight[] = {
#if SMEAR_AVX2
    /* Each length is another call, whose data are other triangles. */
    { .name = "flat_eight (made, drawn, summed up)", .least = 8 * EIGHTS - 60, .most = 8 * EIGHTS, .size = { 1 }, .timed = 8 * EIGHTS,
      .form = { { "one by one", reference }, { "eights", by_eights } } },
#endif
    { .name = NULL }
};
