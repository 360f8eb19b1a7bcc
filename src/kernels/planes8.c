/* SPDX-License-Identifier: MIT */
/* planes8.c - see planes8.h. */
#include "kernels/planes8.h"

#include "kernels/wide8.h"

#if SMEAR_AVX2

/* A plane so steep has no exact pixels, its triangle is a sliver. */
enum { STEEP = 1 << 28 };

/* Thirty instructions a triangle, where one alone takes 300. */
SMEAR_AVX2_FUNCTION void smear_planes8_avx2(struct planes8 *out, const struct poses *p, int32_t depth_break)
{
    const struct corner8 v0 = corner8_of(p, 0), v1 = corner8_of(p, 1), v2 = corner8_of(p, 2);
    const lanes8i x = v0.x, y = v0.y, q = v0.depth;
    const lanes8i x1 = v1.x - x, y1 = v1.y - y, x2 = v2.x - x, y2 = v2.y - y;
    const struct wide8 twice = wide8_cross(x1, y2, x2, y1);
    const struct halves8 area = halves8_of(twice.even, twice.odd);
    /* The next bit behind those of `top`; numbers without an upper half have none. */
    const lanes8 next = lanes8_right(area.low, 32 - area.zeros) & (lanes8)area.has_high & 1u;
    const lanes8 recip = recip_precise8(area.top << 1 | next);
    const lanes8i d1 = v1.depth - q, d2 = v2.depth - q;
    lanes8i dx = gradient8(wide8_cross(d1, y2, d2, y1), (lanes8i)recip, area.zeros);
    lanes8i dy = gradient8(wide8_cross(d2, x1, d1, x2), (lanes8i)recip, area.zeros);
    const lanes8i steep = lanes8i_all(STEEP);
    const lanes8i gentle = ~((lanes8i_abs(dx) > steep) | (lanes8i_abs(dy) > steep));
    dx &= gentle;
    dy &= gentle;
    const lanes8 here = (lanes8)q + (lanes8)part8(dx, 128 - (x & 255)) + (lanes8)part8(dy, 128 - (y & 255));
    out->far = lanes8i_signs(lanes8i_max3(q, v1.depth, v2.depth) < depth_break);
    out->near = lanes8i_signs(lanes8i_min3(q, v1.depth, v2.depth) >= depth_break);
    lanes8i_store(out->x1, x1);
    lanes8i_store(out->y1, y1);
    lanes8i_store(out->x2, x2);
    lanes8i_store(out->y2, y2);
    lanes8_store(out->area_recip, recip);
    lanes8i_store(out->area_zeros, area.zeros);
    lanes8_store(out->at, here - ((lanes8)dx * (lanes8)(x >> 8) + (lanes8)dy * (lanes8)(y >> 8)));
    lanes8i_store(out->dx, dx);
    lanes8i_store(out->dy, dy);
}

/* Twenty instructions a plane, where one alone takes 110. */
SMEAR_AVX2_FUNCTION void smear_plane_eight_avx2(struct plane_eight *out, const struct plane_triangle *t, const struct plane_values *v)
{
    const lanes8i first = lanes8i_load(v->of[0]), steep = lanes8i_all(STEEP);
    const lanes8i d1 = (lanes8i)((lanes8)lanes8i_load(v->of[1]) - (lanes8)first);
    const lanes8i d2 = (lanes8i)((lanes8)lanes8i_load(v->of[2]) - (lanes8)first);
    const lanes8i recip = lanes8i_all((int32_t)t->area_recip), zeros = lanes8i_all(t->area_zeros);
    lanes8i dx = gradient8(wide8_cross(d1, lanes8i_all(t->y2), d2, lanes8i_all(t->y1)), recip, zeros);
    lanes8i dy = gradient8(wide8_cross(d2, lanes8i_all(t->x1), d1, lanes8i_all(t->x2)), recip, zeros);
    const lanes8i gentle = ~((lanes8i_abs(dx) > steep) | (lanes8i_abs(dy) > steep));
    dx &= gentle;
    dy &= gentle;
    const lanes8 right = (lanes8)part8(dx, lanes8i_all(128 - (t->x & 255))), down = (lanes8)part8(dy, lanes8i_all(128 - (t->y & 255)));
    const lanes8 here = (lanes8)first + right + down;
    lanes8_store(out->at, here - ((lanes8)dx * (uint32_t)(t->x >> 8) + (lanes8)dy * (uint32_t)(t->y >> 8)));
    lanes8i_store(out->dx, dx);
    lanes8i_store(out->dy, dy);
}
#endif
