/* SPDX-License-Identifier: MIT */
/* motion_avx2.c - the words of MOTION_* of a vertex in two poses at once: x, y and w of one and of the other lie in lanes. Numbers
 * are those of batch_clip.c, which has what needs more than 32 bits. */
#include "geometry/batch.h"

#include "kernels/wide_lanes.h"

#if SMEAR_AVX2 && SMEAR_WITH_RECONSTRUCT

SMEAR_STATIC_ASSERT(MOTION_DX == 0 && MOTION_DY == 1 && MOTION_RATIO == 2 && MOTION_WORDS == 3, "lanes are words of a record");

/* Returns how far the coordinates of each pose may be shifted left. */
static inline SMEAR_AVX2_FUNCTION lanes8i room_of(lanes8i h)
{
    const lanes8i size = lanes8i_abs(h) | 1;
    return lanes8i_zeros(size | lanes8i_permute(size, (lanes8i){ 1, 2, 0, 4, 5, 3, 6, 7 })
                         | lanes8i_permute(size, (lanes8i){ 2, 0, 1, 5, 3, 4, 6, 7 })) - 1;
}

SMEAR_AVX2_FUNCTION bool smear_store_poses_avx2(uint32_t *out, const struct smear_assembly *d, const struct smear_homogeneous h[2],
                                                const struct smear_homogeneous *now, const struct smear_screen *screen,
                                                const struct smear_viewport *viewport)
{
    const int scale = d->at.now.scale, open = scale - d->motion.measured.pose[0].scale, close = scale - d->motion.measured.pose[1].scale;
    const int zeros = count_leading_zeros((uint32_t)now->w);
    const lanes8i r = lanes8i_all((int32_t)recip_norm((uint32_t)now->w << zeros));       /* 2^(61 - zeros) / w */
    const lanes8i there = { h[0].x, h[0].y, h[0].w, h[1].x, h[1].y, h[1].w, 0, 0 };
    const int32_t x = screen->x - viewport->width * 128, y = screen->y - viewport->height * 128;
    const lanes8i up = room_of(there), most = lanes8i_all(31), far_out = lanes8i_all((1 << 27) - 1);
    /* x' / w and y' / w in q8, w' / w in q20 */
    const lanes8i more = (lanes8i){ open, open, open, close, close, close, 0, 0 } + (lanes8i){ 8, 8, 20, 8, 8, 20, 0, 0 };
    const lanes8i shift = more + (zeros - 29) - up;
    lanes8i beyond = lanes8i_all(0);
    const lanes8i place = lanes8i_scale(lanes8i_mulh(lanes8i_left(there, up), r), lanes8i_max(lanes8i_min(shift, most), -most), &beyond);
    const lanes8i ratio = lanes8i_permute(place, (lanes8i){ 2, 2, 2, 5, 5, 5, 6, 7 });
    const lanes8i here = product8_without(product8_of(ratio, (lanes8i){ x, y, 0, x, y, 0, 0, 0 }), 20, &beyond);
    const lanes8i way = lanes8i_max(lanes8i_min(lanes8i_less(place, here, &beyond), far_out), -far_out);
    const lanes8i words = lanes8i_choose((lanes8i){ 0, 0, -1, 0, 0, -1, 0, 0 }, place, way);
    if ((lanes8i_signs(beyond) & 0x3fu) != 0)
        return false;
    lanes8_store_some(out, (lanes8)words, (lanes8)(lanes8i){ -1, -1, -1, -1, -1, -1, 0, 0 });
    return true;
}
#endif
