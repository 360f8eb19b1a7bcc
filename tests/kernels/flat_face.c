/* SPDX-License-Identifier: MIT */
/* flat_face.c - how check_kernels calls kernels/flat_face.h: triangles that reach beyond the rows and all columns, or lie
 * within. */
#include "kernels/flat_face.h"

#include "tests/kernels/kernels.h"

enum { Z, DZ, DZ_DOWN, COLOR, CORNERS, ALL = CORNERS + 6 };     /* words */
enum { STRIDE = 35 };

/* Corners of a triangle that is clockwise on the screen. */
static void prepare(struct kernel_call *c)
{
    const int32_t far = (kernel_random() & 3u) == 0 ? 100000 : 3000;
    int32_t *const at = (int32_t *)&c->word[CORNERS];
    for (int i = 0; i < 6; i++)
        at[i] = kernel_between(-far / 2, ((i & 1) != 0 ? c->n / STRIDE : STRIDE) * 256 + far / 2);
    if ((kernel_random() & 3u) == 0)        /* level edges */
        at[3] = at[1];
    const int64_t area = (int64_t)(at[2] - at[0]) * (at[5] - at[1]) - (int64_t)(at[4] - at[0]) * (at[3] - at[1]);
    if (area < 0)
        for (int i = 0; i < 2; i++) {
            const int32_t swap = at[2 + i];
            at[2 + i] = at[4 + i];
            at[4 + i] = swap;
        }
}

static void face_by(struct kernel_call *c, bool narrow, bool best)
{
    const int32_t *const at = (const int32_t *)&c->word[CORNERS];
    const int32_t columns = FLAT_FACE_LEAST + c->n % (STRIDE - FLAT_FACE_LEAST), x0 = c->n / 3 % (STRIDE - columns + 1), y0 = c->n % 7 - 3;
    const struct flat_area area = { c->plane[0], c->plane[1], STRIDE, x0, x0 + columns, y0, y0 + c->n / STRIDE, narrow };
    const struct flat_face face = { { at, at + 2, at + 4 }, c->word[Z], c->word[DZ], c->word[DZ_DOWN],
                                    narrow ? c->word[COLOR] & 0xffffu : c->word[COLOR], (c->word[COLOR] >> 24 & 1u) != 0 };
#if SMEAR_AVX2
    if (best && smear_has_avx2()) {
        smear_flat_face_avx2(&area, &face);
        return;
    }
#else
    (void)best;
#endif
    flat_face_reference(&area, &face);
}

/* The same, but made ready once, and drawn in parts of some rows. */
static void carried_by(struct kernel_call *c, bool narrow)
{
#if SMEAR_AVX2
    const int32_t *const at = (const int32_t *)&c->word[CORNERS], *const corner[3] = { at, at + 2, at + 4 };
    const int32_t columns = FLAT_FACE_LEAST + c->n % (STRIDE - FLAT_FACE_LEAST), x0 = c->n / 3 % (STRIDE - columns + 1), y0 = c->n % 7 - 3;
    const struct flat_area area = { c->plane[0], c->plane[1], STRIDE, x0, x0 + columns, y0, y0 + c->n / STRIDE, narrow };
    struct corners k;
    corners_find(&k, corner, y0, area.y1);
    if (smear_has_avx2()) {
        struct flat_carried f = { .z = c->word[Z] + c->word[DZ_DOWN] * (uint32_t)(k.first - y0), .dz = c->word[DZ],
                                  .dz_down = c->word[DZ_DOWN], .color = narrow ? c->word[COLOR] & 0xffffu : c->word[COLOR],
                                  .breaks = (c->word[COLOR] >> 24 & 1u) != 0 };
        if (k.first < k.end)
            smear_flat_carry_avx2(&f, corner, k.first);
        for (int32_t y = k.first, next; y < k.end; y = next) {
            next = min_i32(y + 1 + (y + c->n) % 4, k.end);
            smear_flat_carried_avx2(&area, &f, y, next);
        }
        return;
    }
#endif
    face_by(c, narrow, false);
}

static void wide_carried(struct kernel_call *c) { carried_by(c, false); }
static void narrow_carried(struct kernel_call *c) { carried_by(c, true); }
static void wide(struct kernel_call *c) { face_by(c, false, false); }
static void wide_best(struct kernel_call *c) { face_by(c, false, true); }
static void narrow(struct kernel_call *c) { face_by(c, true, false); }
static void narrow_best(struct kernel_call *c) { face_by(c, true, true); }

extern const struct kernel kernels_flat_face[];
const struct kernel kernels_flat_face[] = {
    { .name = "flat_face", .least = STRIDE, .most = 7 * STRIDE, .size = { 4, 2 }, .prepare = prepare, .timed = 7 * STRIDE,
      .form = { { "reference", wide }, { "best", wide_best }, { "carried", wide_carried } } },
    { .name = "flat_face (narrow)", .least = STRIDE, .most = 14 * STRIDE, .size = { 2, 2 }, .prepare = prepare, .timed = 14 * STRIDE,
      .form = { { "reference", narrow }, { "best", narrow_best }, { "carried", narrow_carried } } },
    { .name = NULL }
};
