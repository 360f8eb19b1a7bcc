/* SPDX-License-Identifier: MIT */
/* transform.c - the perspective division, with 32-bit products only. */
#include "transform.h"

#include "fixmath.h"

/* a r 2^shift with r = 2^61 / m in [2^29, 2^30]: the high product first, so nothing is lost but the last bits. */
static inline int32_t times_recip(int32_t a, uint32_t r, int shift)
{
    int32_t high = mulh_i32(a, (int32_t)r);
    if (shift < 0 && shift > -32)
        return (high + (1 << (-shift - 1))) >> -shift;      /* |high| < 2^30: no overflow */
    return scale_sat(high, clamp_i32(shift, -31, 31));
}

void smear_project(struct smear_screen *out, const struct smear_projection *p,
                   const struct smear_homogeneous *in, const struct smear_viewport *viewport)
{
    SMEAR_ASSERT(in->w > 0);
    int zeros = count_leading_zeros((uint32_t)in->w);
    uint32_t r = recip_norm((uint32_t)in->w << zeros);      /* 1/w = r 2^(zeros - 61) */

    /* x r / 2^32 = x/w 2^(29 - zeros); q8 wants 2^8. Clamped so that sums stay in range. */
    const int32_t far_out = 1 << 24;
    out->x = (viewport->width << 7) + clamp_i32(times_recip(in->x, r, zeros - 21), -far_out, far_out);
    out->y = (viewport->height << 7) + clamp_i32(times_recip(in->y, r, zeros - 21), -far_out, far_out);

    int32_t depth;
    if (p->orthographic) {
        int32_t left = sub_wrap(p->far_distance, in->distance);
        int log2 = p->depth_shift;
        depth = times_recip(left, (uint32_t)p->depth_mantissa, log2);
    } else {
        depth = times_recip(p->depth_mantissa, r, p->depth_shift + zeros);
    }
    out->depth = clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}
