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

/* x and y: of eight pixels, from where the polynomial counts. */
SMEAR_AVX2_INLINE void down_start(struct down_lanes *d, const struct texel_curve *c, lanes8 x, lanes8 y)
{
    const lanes8 mixed = lanes8_all(c->dxy), bend = lanes8_all(c->dyy), down = y * bend;
    const lanes8 along = lanes8_all(c->dx) + mixed * y + lanes8_all(c->dxx) * x;
    d->at = (__m256i)(lanes8_all(c->at) + y * (lanes8_all(c->dy) + down) + along * x);
    d->step = (__m256i)(lanes8_all(c->dy + c->dyy) + down + down + mixed * x);
    d->change = (__m256i)(bend + bend);
}

SMEAR_AVX2_INLINE void down_step(struct down_lanes *d)
{
    d->at = _mm256_add_epi32(d->at, d->step);
    d->step = _mm256_add_epi32(d->step, d->change);
}

/* Where rows begin and end, by sixteens: those behind the last begin far to the right and end far to the left. */
struct column_rows {
    int16_t left[TEXEL_SIDES], right[TEXEL_SIDES];
    int32_t sixteens;
    int32_t x, end;                     /* all rows lie in columns [x, end) */
};

SMEAR_AVX2_INLINE __m256i sides_load(const struct span_side *side, int i)
{
    return _mm256_loadu_si256((const __m256i *)(const void *)side + i);
}

/* The left sides of eight rows, and the right ones. */
SMEAR_AVX2_INLINE __m256i eight_left(const struct span_side *side)
{
    const __m256i mixed = _mm256_blend_epi32(_mm256_blend_epi32(sides_load(side, 0), sides_load(side, 1), 0x92), sides_load(side, 2), 0x24);
    return _mm256_permutevar8x32_epi32(mixed, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
}

SMEAR_AVX2_INLINE __m256i eight_right(const struct span_side *side)
{
    const __m256i mixed = _mm256_blend_epi32(_mm256_blend_epi32(sides_load(side, 0), sides_load(side, 1), 0x24), sides_load(side, 2), 0x49);
    return _mm256_permutevar8x32_epi32(mixed, _mm256_setr_epi32(1, 4, 7, 2, 5, 0, 3, 6));
}

/* Sixteen numbers as halves, the nearest there are. */
SMEAR_AVX2_INLINE __m256i sixteen_halves(__m256i low, __m256i high)
{
    return _mm256_permute4x64_epi64(_mm256_packs_epi32(low, high), 0xd8);
}

/* The least of sixteen halves without a sign. */
SMEAR_AVX2_INLINE int32_t least_half(__m256i a)
{
    const __m128i least = _mm_min_epu16(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
    return _mm_cvtsi128_si32(_mm_minpos_epu16(least)) & 0xffff;
}

SMEAR_AVX2_INLINE void column_rows_find(struct column_rows *r, const struct texel_sides *s)
{
    const __m256i numbers = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m256i far_right = _mm256_set1_epi16(INT16_MAX), far_left = _mm256_set1_epi16(INT16_MIN);
    __m256i least = far_right, most = _mm256_setzero_si256();
    for (int32_t i = 0; i < s->count; i += 16) {
        const struct span_side *const side = s->side + i;
        const __m256i drawn = _mm256_cmpgt_epi16(_mm256_set1_epi16((int16_t)(s->count - i)), numbers);
        const __m256i left = _mm256_blendv_epi8(far_right, sixteen_halves(eight_left(side), eight_left(side + 8)), drawn);
        const __m256i right = _mm256_blendv_epi8(far_left, sixteen_halves(eight_right(side), eight_right(side + 8)), drawn);
        _mm256_storeu_si256((__m256i_u *)(r->left + i), left);
        _mm256_storeu_si256((__m256i_u *)(r->right + i), right);
        least = _mm256_min_epi16(least, left);
        most = _mm256_max_epi16(most, right);
    }
    r->sixteens = (s->count + 15) >> 4;
    r->x = least_half(least);
    r->end = 0xffff - least_half(_mm256_xor_si256(most, _mm256_set1_epi16(-1)));
}

/* Which of sixteen rows have pixels among columns x to x + 7: two bits each. */
SMEAR_AVX2_INLINE uint32_t column_rows_in(const struct column_rows *r, int32_t sixteen, __m256i x, __m256i behind)
{
    const __m256i left = _mm256_loadu_si256((const __m256i_u *)(r->left + 16 * sixteen));
    const __m256i right = _mm256_loadu_si256((const __m256i_u *)(r->right + 16 * sixteen));
    return (uint32_t)_mm256_movemask_epi8(_mm256_and_si256(_mm256_cmpgt_epi16(behind, left), _mm256_cmpgt_epi16(right, x)));
}

/* The first row that has, and behind the last one; false if none has. */
SMEAR_AVX2_INLINE bool column_rows_ends(const struct column_rows *r, int32_t x, int32_t *first, int32_t *end)
{
    const __m256i at = _mm256_set1_epi16((int16_t)x), behind = _mm256_set1_epi16((int16_t)(x + 8));
    int32_t low = 0, high = r->sixteens - 1;
    uint32_t in = column_rows_in(r, low, at, behind);
    while (in == 0) {
        if (low == high)
            return false;
        in = column_rows_in(r, ++low, at, behind);
    }
    *first = 16 * low + (int32_t)(_tzcnt_u32(in) >> 1);
    if (low != high)
        while ((in = column_rows_in(r, high, at, behind)) == 0)
            high--;
    *end = 16 * high + 16 - (int32_t)(_lzcnt_u32(in) >> 1);
    return true;
}

/* Rows [i, end) of columns x to x + 7. */
SMEAR_AVX2_INLINE void draw_column(const struct texel_lanes *k, const struct texel_sides *s, const struct column_rows *rows,
                                   const struct texel_curves *p, int32_t x, int32_t i, int32_t end, enum look look)
{
    const __m256i column = _mm256_add_epi32(first_8(), _mm256_set1_epi32(x)), dz_down = _mm256_set1_epi32((int32_t)s->dz_down);
    const __m128i number = _mm_add_epi16(_mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7), _mm_set1_epi16((int16_t)x));
    const __m256i first_z = _mm256_set1_epi32((int32_t)(s->z + s->dz_down * (uint32_t)i));
    __m256i z = _mm256_add_epi32(first_z, _mm256_mullo_epi32(column, _mm256_set1_epi32((int32_t)s->dz)));
    struct down_lanes u, v;
    struct lit_down light;
    struct row_lanes r;
    const bool narrow = look_is_narrow(k, look);
    const ptrdiff_t stride = k->stride;
    ptrdiff_t at = i * stride;
    r.row = i;
    const lanes8 x_from = (lanes8)column - lanes8_all((uint32_t)p->x0), y_from = lanes8_all((uint32_t)(i - p->y0));
    down_start(&u, &p->u, x_from, y_from);
    down_start(&v, &p->v, x_from, y_from);
    if (look == LOOK_LIT_USUAL)
        lit_down_start(&light, &k->lit, x, i);
    const int16_t *const left = rows->left + end, *const right = rows->right + end;
    for (ptrdiff_t row = i - end; row < 0; row++) {
        const __m128i before = _mm_cmpgt_epi16(_mm_set1_epi16(left[row]), number);
        const __m128i inside = _mm_andnot_si128(before, _mm_cmpgt_epi16(_mm_set1_epi16(right[row]), number));
        const __m128i code = _mm_and_si128(upper_halves(z), inside);
        __m128i_u *const depth = (__m128i_u *)(k->depth + x + at);
        const __m128i old = _mm_loadu_si128(depth), most = _mm_max_epu16(code, old);
        const __m128i hidden = _mm_cmpeq_epi16(most, old);
        if (!all_hidden(hidden)) {
            _mm_storeu_si128(depth, most);
            r.color = narrow ? (void *)((uint16_t *)k->color + at) : (uint32_t *)k->color + at;
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
        at += stride;
        r.row++;
    }
}

SMEAR_AVX2_INLINE void columns_of(const struct texel_rows *t, const struct texel_sides *s, const struct texel_curves *p,
                                  enum look look)
{
    struct texel_lanes k;
    struct light_lanes blocks;
    struct column_rows rows;
    column_rows_find(&rows, s);
    lanes_start(&k, t, &blocks, look);
    for (int32_t x = rows.x; x < rows.end; x += 8) {
        const int32_t first = min_i32(x, k.x_most8);        /* what is drawn again is hidden by itself */
        int32_t i, end;
        if (column_rows_ends(&rows, first, &i, &end))
            draw_column(&k, s, &rows, p, first, i, end, look);
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
