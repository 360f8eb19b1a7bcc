/* SPDX-License-Identifier: MIT */
/* transform.c - the perspective division, with 32-bit products only. */
#include "geometry/transform.h"

void smear_transform_vertex(struct smear_homogeneous *out, const struct smear_projection *p, const int16_t v[3])
{
    transform_inline(out, p, v);
}

void smear_project(struct smear_screen *out, const struct smear_depths *d, const struct smear_homogeneous *in,
                   const struct smear_viewport *viewport)
{
    SMEAR_ASSERT(in->w > 0);
    int zeros = count_leading_zeros((uint32_t)in->w);
    uint32_t r = recip_norm((uint32_t)in->w << zeros);      /* 1/w = r 2^(zeros - 61) */

    /* x r / 2^32 = x/w 2^(29 - zeros); q8 wants 2^8. */
    int32_t x = mulh_i32(in->x, (int32_t)r), y = mulh_i32(in->y, (int32_t)r);
    int down = 21 - zeros - d->coarse;
    if (down > 0) {
        int32_t half = 1 << (down - 1);
        x = (x + half) >> down;
        y = (y + half) >> down;
    } else {
        const int32_t far_out = 1 << 24;
        x = clamp_i32(scale_sat(x, -down), -far_out, far_out);
        y = clamp_i32(scale_sat(y, -down), -far_out, far_out);
    }
    out->x = (viewport->width << 7) + x;
    out->y = (viewport->height << 7) + y;

    const int32_t depth = depths_are_even(d) ? depth_even(d, in->distance)
                                             : times_recip(d->depth_mantissa, r, d->depth_shift + zeros);
    out->depth = clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}

int smear_outcode_behind(const struct smear_homogeneous *h, const struct smear_viewport *viewport)
{
    int64_t x = (int64_t)h->x * 2, y = (int64_t)h->y * 2;
    int64_t right = (int64_t)h->w * viewport->width, bottom = (int64_t)h->w * viewport->height;
    return (x < -right ? OUT_LEFT : 0) | (x > right ? OUT_RIGHT : 0) | (y < -bottom ? OUT_TOP : 0)
         | (y > bottom ? OUT_BOTTOM : 0);
}
