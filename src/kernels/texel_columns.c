/* SPDX-License-Identifier: MIT */
/* texel_columns.c - columns of eight pixels, from row to row. */
#include "kernels/texel_lanes.h"

#if SMEAR_AVX2

void smear_texel_columns_reference(const struct texel_rows *t, const struct texel_sides *s, const struct texel_curves *p)
{
    struct texel_spans span = { .count = 1, .dz = { s->dz } };
    for (int32_t i = 0; i < s->count; i++) {
        span.row[0] = i;
        span.a[0] = s->side[i].left;
        span.b[0] = s->side[i].right;
        span.z[0] = s->z + s->dz_down * (uint32_t)i;
        if (span.a[0] < span.b[0])
            smear_texel_rows_curves_reference(t, &span, p);
    }
}

/* A coordinate at eight places of a row, how far it is from those below, and how that changes. */
struct down_lanes {
    __m256i at, step, change;
};

SMEAR_AVX2_INLINE void down_start(struct down_lanes *d, const struct texel_curve *c, __m256i x, uint32_t y)
{
    const __m256i along = _mm256_add_epi32(_mm256_set1_epi32((int32_t)(c->dx + c->dxy * y)),
                                           _mm256_mullo_epi32(_mm256_set1_epi32((int32_t)c->dxx), x));
    d->at = _mm256_add_epi32(_mm256_set1_epi32((int32_t)(c->at + y * (c->dy + c->dyy * y))), _mm256_mullo_epi32(along, x));
    d->step = _mm256_add_epi32(_mm256_set1_epi32((int32_t)(c->dy + c->dyy * (2 * y + 1))),
                               _mm256_mullo_epi32(_mm256_set1_epi32((int32_t)c->dxy), x));
    d->change = _mm256_set1_epi32((int32_t)(2 * c->dyy));
}

SMEAR_AVX2_INLINE void down_step(struct down_lanes *d)
{
    d->at = _mm256_add_epi32(d->at, d->step);
    d->step = _mm256_add_epi32(d->step, d->change);
}

/* Rows [i, end) of columns x to x + 7. */
SMEAR_AVX2_INLINE void draw_column(const struct texel_lanes *k, const struct texel_sides *s, const struct texel_curves *p, int32_t x,
                                   int32_t i, int32_t end, enum look look)
{
    const __m256i column = _mm256_add_epi32(first_8(), _mm256_set1_epi32(x)), dz_down = _mm256_set1_epi32((int32_t)s->dz_down);
    const __m128i number = _mm_add_epi16(_mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7), _mm_set1_epi16((int16_t)x));
    const __m256i first_z = _mm256_set1_epi32((int32_t)(s->z + s->dz_down * (uint32_t)i));
    __m256i z = _mm256_add_epi32(first_z, _mm256_mullo_epi32(column, _mm256_set1_epi32((int32_t)s->dz)));
    struct down_lanes u, v;
    struct lit_down light;
    struct row_lanes r;
    const ptrdiff_t at = i * k->stride;
    uint16_t *depth = k->depth + at + x;
    const bool narrow = look_is_narrow(k, look);
    r.row = i;
    r.color = narrow ? (void *)((uint16_t *)k->color + at) : (uint32_t *)k->color + at;
    down_start(&u, &p->u, _mm256_sub_epi32(column, _mm256_set1_epi32(p->x0)), (uint32_t)(i - p->y0));
    down_start(&v, &p->v, _mm256_sub_epi32(column, _mm256_set1_epi32(p->x0)), (uint32_t)(i - p->y0));
    if (look == LOOK_LIT_USUAL)
        lit_down_start(&light, &k->lit, x, i);
    for (const struct span_side *side = s->side + i, *const stop = s->side + end; side < stop; side++) {
        const __m128i before = _mm_cmpgt_epi16(_mm_set1_epi16((int16_t)side->left), number);
        const __m128i inside = _mm_andnot_si128(before, _mm_cmpgt_epi16(_mm_set1_epi16((int16_t)side->right), number));
        const __m128i code = _mm_and_si128(lower_halves(_mm256_srli_epi32(z, 16)), inside);
        const __m128i old = _mm_loadu_si128((const __m128i_u *)depth), most = _mm_max_epu16(code, old);
        const __m128i hidden = _mm_cmpeq_epi16(most, old);
        if (_mm_movemask_epi8(hidden) != 0xffff) {
            _mm_storeu_si128((__m128i_u *)depth, most);
            if (look == LOOK_LIT_USUAL)
                put_usual_8(k, &r, x, u.at, v.at, hidden, lit_down_light(&light, &k->lit));
            else
                put_8(k, &r, x, u.at, v.at, hidden, look);
        }
        if (look == LOOK_LIT_USUAL)
            lit_down_step(&light, &k->lit);
        down_step(&u);
        down_step(&v);
        z = _mm256_add_epi32(z, dz_down);
        depth += k->stride;
        r.row++;
        r.color = narrow ? (void *)((uint16_t *)r.color + k->stride) : (uint32_t *)r.color + k->stride;
    }
}

SMEAR_AVX2_INLINE void columns_of(const struct texel_rows *t, const struct texel_sides *s, const struct texel_curves *p,
                                  enum look look)
{
    struct texel_lanes k;
    struct light_lanes blocks;
    int32_t x = INT32_MAX, right = INT32_MIN;
    for (int32_t i = 0; i < s->count; i++) {
        x = min_i32(x, s->side[i].left);
        right = max_i32(right, s->side[i].right);
    }
    lanes_start(&k, t, &blocks, look);
    for (; x < right; x += 8) {
        const int32_t first = min_i32(x, k.x_most8);        /* what is drawn again is hidden by itself */
        int32_t i = 0, end = s->count;
        while (i < end && (s->side[i].left >= first + 8 || s->side[i].right <= first))
            i++;
        while (i < end && (s->side[end - 1].left >= first + 8 || s->side[end - 1].right <= first))
            end--;
        if (i < end)
            draw_column(&k, s, p, first, i, end, look);
    }
}

SMEAR_AVX2_FUNCTION void smear_texel_columns_avx2(const struct texel_rows *t, const struct texel_sides *s,
                                                  const struct texel_curves *p)
{
    if (t->lights != NULL && t->narrow && lights_are_usual(t->lights))
        columns_of(t, s, p, LOOK_LIT_USUAL);
    else if (t->lights != NULL)
        columns_of(t, s, p, LOOK_LIT);
    else if (t->narrow)
        columns_of(t, s, p, LOOK_NARROW);
    else
        columns_of(t, s, p, LOOK_WIDE);
}
#endif
