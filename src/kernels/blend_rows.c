/* SPDX-License-Identifier: MIT */
/* blend_rows.c - see blend_rows.h. */
#include "kernels/blend_rows.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* What the colour adds to every pixel, and how much of these is left, of 256. Codes: of red and blue, and of green, with 1/2.
 * Linear: the light of red, green and blue, with 8 bits more. */
struct blend_lanes {
    lanes8 add[3], left;
};

SMEAR_AVX2_INLINE void blend_start(struct blend_lanes *k, uint32_t over, bool linear)
{
    const uint32_t a = pixel_alpha(over) + (over >> 31);
    k->left = lanes8_all(256u - a);
    if (linear) {
        for (int i = 0; i < 3; i++)
            k->add[i] = lanes8_all(smear_srgb_decode[over >> (16 - 8 * i) & 255u] * a);
        return;
    }
    k->add[0] = lanes8_all((over & 0xff00ffu) * a + 0x800080u);
    k->add[1] = lanes8_all(pixel_green(over) * a + 0x80u);
}

SMEAR_AVX2_INLINE lanes8 blended_light(lanes8 code, lanes8 add, lanes8 left)
{
    return (lanes8_decode(code) * left + add) >> 12;
}

SMEAR_AVX2_INLINE lanes8 blended_pixels(const struct blend_lanes *k, lanes8 under, bool linear)
{
    if (linear)
        return lanes8_encode_pixels(blended_light(under >> 16 & 255u, k->add[0], k->left),
                                    blended_light(under >> 8 & 255u, k->add[1], k->left),
                                    blended_light(under & 255u, k->add[2], k->left));
    const lanes8 rb = (lanes8_mul16(under & 0xff00ffu, k->left | k->left << 16) + k->add[0]) >> 8 & 0xff00ffu;
    return rb | ((lanes8_mul16(under >> 8 & 255u, k->left) + k->add[1]) & 0xff00u);
}

/* Pixels [a, b) of a row. `solid`: they become the colour. */
SMEAR_AVX2_INLINE void blend_row(const struct blend_rows *t, const struct blend_lanes *k, const struct texel_spans *s, int32_t i,
                                 bool linear, bool solid)
{
    const lanes8 numbers = lanes8_numbers();
    const int32_t b = s->b[i], x_most = t->x1 - 8;
    const uint32_t dz = s->dz[i];
    const lanes8 steps = lanes8_all(dz) * numbers;
    uint32_t *const color = blend_rows_color(t, s->row[i]);
    const uint16_t *const depth = t->depth + s->row[i] * t->depth_stride;
    for (int32_t next = s->a[i]; next < b; next += 8) {
        const int32_t x = min_i32(next, x_most);        /* columns before `next` are drawn already, or not at all */
        const lanes8i column = lanes8i_all(x) + (lanes8i)numbers;
        const lanes8i inside = (lanes8i_all(b) > column) & (column > lanes8i_all(next - 1));
        const lanes8i code = (lanes8i)((lanes8_all(s->z[i] + dz * (uint32_t)x) + steps) >> 16) & inside;
        const lanes8i seen = code > lanes8i_load_halves(depth + x);
        if (!lanes8i_any(seen))
            continue;
        const lanes8 under = lanes8_load(color + x);
        lanes8_store(color + x, lanes8_choose(seen, solid ? lanes8_all(t->over & 0xffffffu) : blended_pixels(k, under, linear), under));
    }
}

SMEAR_AVX2_INLINE void blend_rows_of(const struct blend_rows *t, const struct texel_spans *s, bool linear, bool solid)
{
    struct blend_lanes k;
    blend_start(&k, t->over, linear);
    for (int32_t i = 0; i < s->count; i++)
        blend_row(t, &k, s, i, linear, solid);
}

SMEAR_AVX2_FUNCTION void smear_blend_rows_avx2(const struct blend_rows *t, const struct texel_spans *s)
{
    if (pixel_alpha(t->over) == 255u)
        blend_rows_of(t, s, false, true);
    else if (!t->linear)
        blend_rows_of(t, s, false, false);
    else if (pixel_alpha(t->over) != 0)         /* else pixels stay as they are */
        blend_rows_of(t, s, true, false);
}
#endif
