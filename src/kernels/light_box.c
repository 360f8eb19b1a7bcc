/* SPDX-License-Identifier: MIT */
/* light_box.c - the box of an instant, added to sums of light: sixteen columns of a row at once, or eight of two rows. */
#include "kernels/light_lanes.h"

#if SMEAR_AVX2

/* Eight pixels of the box, from which others are counted. */
struct box_eight {
    uint32_t *color;
    const uint32_t *background;
    struct packed_sums sums;
    uint16_t *depth;
    const uint16_t *deep;
};

/* Those so much farther on in the planes; compilers would make their places anew wherever they are used. */
SMEAR_AVX2_INLINE struct box_eight box_eight_from(const struct packed_box *b, int32_t at, int32_t behind)
{
    struct box_eight e = { b->color + at, b->background + behind, packed_sums_from(b->sums, at), b->depth + at, b->deep + behind };
    SMEAR_KEEP_VALUE(e.color);
    SMEAR_KEEP_VALUE(e.sums.rb);
    SMEAR_KEEP_VALUE(e.sums.gn);
    SMEAR_KEEP_VALUE(e.background);
    SMEAR_KEEP_VALUE(e.depth);
    SMEAR_KEEP_VALUE(e.deep);
    return e;
}

SMEAR_AVX2_INLINE void box_depths8(const struct box_eight *e, ptrdiff_t at, ptrdiff_t behind)
{
    _mm_storeu_si128((__m128i *)(void *)(e->depth + at), _mm_loadu_si128((const __m128i *)(const void *)(e->deep + behind)));
}

/* Two eights, whose greens share lanes; what looks like the background is black that adds no white. */
SMEAR_AVX2_INLINE void light_box16(const struct box_eight *a, const struct box_eight *b, ptrdiff_t at, ptrdiff_t behind,
                                   const struct instant_lanes *t, enum light_scale scale)
{
    const lanes8 back_a = lanes8_load(a->background + behind), back_b = lanes8_load(b->background + behind);
    lanes8 color_a = lanes8_load(a->color + at), color_b = lanes8_load(b->color + at);
    const lanes8 alike_a = (lanes8)(color_a == back_a), alike_b = (lanes8)(color_b == back_b);
    if (lanes8_all_set(alike_a & alike_b))
        return;
    lanes8_store(a->color + at, back_a);
    lanes8_store(b->color + at, back_b);
    color_a = lanes8_without(color_a, alike_a);
    color_b = lanes8_without(color_b, alike_b);
    const lanes8 greens = lanes8_halves_of(color_a, color_b << 16) & lanes8_load(smear_light_numbers.green);
    const lanes8 green = light_added16(greens, t, scale);
    light_sums_add8(&a->sums, at, light_added16(lanes8_left16(color_a, 8), t, scale),
                    lanes8_halves_of(green, lanes8_without(t->white, alike_a)));
    light_sums_add8(&b->sums, at, light_added16(lanes8_left16(color_b, 8), t, scale),
                    green >> 16 | lanes8_without(t->white, alike_b));
}

/* Sixteen columns from x on. */
SMEAR_AVX2_INLINE void light_box_wide(const struct packed_box *box, int32_t x, const struct instant_lanes *t, enum light_scale scale)
{
    const struct box_eight a = box_eight_from(box, x, x);
    const struct box_eight b = { a.color + 8, a.background + 8, packed_sums_from(a.sums, 8), NULL, NULL };
    const ptrdiff_t pitch = box->pitch, pitch_behind = box->pitch_behind;
    ptrdiff_t at = 0, behind = 0;
    for (int32_t rows = box->rows; rows > 0; rows--, at += pitch, behind += pitch_behind) {
        lanes8_store(a.depth + at, lanes8_load(a.deep + behind));
        light_box16(&a, &b, at, behind, t, scale);
    }
}

/* Eight columns from x on. The last row of an odd number is taken with the one before, which looks like the background by then. */
SMEAR_AVX2_INLINE void light_box_narrow(const struct packed_box *box, int32_t x, const struct instant_lanes *t,
                                        enum light_scale scale)
{
    const ptrdiff_t pitch = box->pitch, pitch_behind = box->pitch_behind;
    const struct box_eight a = box_eight_from(box, x, x), b = box_eight_from(box, x + box->pitch, x + box->pitch_behind);
    ptrdiff_t at = 0, behind = 0;
    for (int32_t rows = box->rows;;) {
        box_depths8(&a, at, behind);
        box_depths8(&b, at, behind);
        light_box16(&a, &b, at, behind, t, scale);
        rows -= 2;
        at += 2 * pitch;
        behind += 2 * pitch_behind;
        if (rows < 2) {
            if (rows == 0)
                return;
            rows = 2;
            at -= pitch;
            behind -= pitch_behind;
        }
    }
}

/* The last eight columns may be some again: they look like the background by then. */
SMEAR_AVX2_INLINE void light_box_of(const struct packed_box *b, const struct light_instant *instant, enum light_scale scale)
{
    const struct packed_box box = *b;
    const struct instant_lanes t = instant_lanes_of(instant);
    int32_t x = 0;
    for (; x + 16 <= box.n; x += 16)
        light_box_wide(&box, x, &t, scale);
    for (; x < box.n; x += 8)
        light_box_narrow(&box, min_i32(x, box.n - 8), &t, scale);
}

SMEAR_AVX2_FUNCTION void smear_light_box_avx2(const struct packed_box *b, const struct light_instant *instant)
{
    const enum light_scale scale = light_scale_of(instant);
    if (scale == LIGHT_ROUNDED)
        light_box_of(b, instant, LIGHT_ROUNDED);
    else if (scale == LIGHT_PLAIN)
        light_box_of(b, instant, LIGHT_PLAIN);
    else
        light_box_of(b, instant, LIGHT_RAISED);
}
#endif
