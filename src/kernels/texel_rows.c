/* SPDX-License-Identifier: MIT */
/* texel_rows.c - places of eight blocks at once, then sixteen pixels of a block, or eight. */
#include "kernels/place_list.h"
#include "kernels/wrapped_run.h"

#if SMEAR_AVX2

/* ------------------------------------------------------------------ references */

/* Of coordinates in texels q16. */
static uint32_t wrapped_texel_index(const struct texel_wraps *w, uint64_t uv)
{
    return (uint32_t)(wrapped_index((int32_t)(uv >> 32) >> 16, w->size[1], w->wrap[1]) * w->size[0]
                      + wrapped_index((int32_t)uv >> 16, w->size[0], w->wrap[0]));
}

/* The texels q16 of a ratio q29 across (axis 0) or down. */
static int32_t wrapped_texel(const struct texel_wraps *w, int axis, int32_t ratio)
{
    const int32_t texels = mulh_i32(ratio, w->scale[axis]), shift = w->shift[axis];
    return shift >= 0 ? shl_wrap(texels, shift) : texels >> -shift;
}

static void pixel_reference(const struct texel_rows *t, int32_t row, int32_t x, uint32_t z, uint64_t uv, const uint32_t light[3])
{
    const ptrdiff_t at = row * t->stride + x;
    void *const color = t->narrow ? (void *)((uint16_t *)t->color + at) : (uint32_t *)t->color + at;
    if (t->lights == NULL) {
        texel_pixel(color, t->depth + at, z, t->texels, NULL, uv, t->log2_width, t->log2_height,
                    t->narrow ? TEXELS_NARROW : TEXELS_WIDE);
    } else if (z >> 16 > t->depth[at]) {
        const uint32_t index = t->wraps != NULL ? wrapped_texel_index(t->wraps, uv) : packed_index(uv, t->log2_width, t->log2_height);
        const uint32_t pixel = lit_texel_reference(
            t->lights, texel_fetch(t->texels, t->lights->palette, index, t->lights->format), light);
        t->depth[at] = (uint16_t)(z >> 16);
        if (t->narrow)
            *(uint16_t *)color = (uint16_t)rgb565_nearest(pixel);
        else
            *(uint32_t *)color = pixel;
    }
}

/* Pixels [a, b) of a row, of which `c` are the coordinates of pixel x; `single`: the row has no blocks. */
static void draw_reference(const struct texel_rows *t, const struct texel_spans *s, int32_t i, struct texcoord c, int32_t x,
                           int32_t a, int32_t b, bool single)
{
    uint32_t light[3] = { 0, 0, 0 };
    uint64_t uv = packed_uv(c.u, c.v), step = packed_step(c.du, c.dv);
    for (; x < b; x++) {
        if (x >= a && t->lights != NULL)
            light_planes_at(light, &t->lights->planes, s->left[i], s->right[i], single ? 1 : t->lights->planes.block, x, s->row[i]);
        if (x >= a)
            pixel_reference(t, s->row[i], x, s->z[i] + s->dz[i] * (uint32_t)x, t->wraps != NULL ? uv : packed_uv(c.u, c.v), light);
        uv += step;
        step -= packed_step(c.curvature_u, c.curvature_v);
        c.u += c.du;
        c.v += c.dv;
        c.du -= c.curvature_u;
        c.dv -= c.curvature_v;
    }
}

static struct place place_reference(const struct texel_rows *t, const struct texel_planes *p, int32_t x, int32_t row)
{
    const int32_t q = texel_plane_at(&p->q, x, row), u = texel_plane_at(&p->u, x, row), v = texel_plane_at(&p->v, x, row);
    if (!p->divided)
        return (struct place){ u, v, 0 };
    struct place here = place_divided(q, u, v, p->slope, p->parabolic);
    if (t->wraps != NULL) {
        here.u = wrapped_texel(t->wraps, 0, shl_wrap(here.u, 2));
        here.v = wrapped_texel(t->wraps, 1, shl_wrap(here.v, 2));
    }
    return here;
}

void smear_texel_rows_places_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p)
{
    for (int32_t i = 0; i < s->count; i++) {
        const int32_t left = s->left[i], last = s->right[i] - 1, row = s->row[i];
        if (p->block == 1 || last - left < SHORT_SPAN) {
            for (int32_t x = s->a[i]; x < s->b[i]; x++) {
                const struct place here = place_reference(t, p, x, row);
                const struct texcoord c = { (uint32_t)here.u << p->up, (uint32_t)here.v << p->up, 0, 0, 0, 0 };
                draw_reference(t, s, i, c, x, x, x + 1, true);
            }
            continue;
        }
        for (int32_t x = block_start(left, last, s->a[i], p->block), n; x < last; x += n) {
            n = block_next(p->block, last - x);
            const struct texcoord c = places_between(place_reference(t, p, x, row), place_reference(t, p, x + n, row), n, p->up,
                                                     p->parabolic, t->wraps == NULL);
            draw_reference(t, s, i, c, x, s->a[i], min_i32(x + n + (x + n == last), s->b[i]), false);
        }
    }
}

static struct texcoord curve_reference(const struct texel_curves *p, int32_t column, int32_t row)
{
    const uint32_t x = (uint32_t)(column - p->x0), y = (uint32_t)(row - p->y0);
    const struct texel_curve *u = &p->u, *v = &p->v;
    return (struct texcoord){
        u->at + y * (u->dy + u->dyy * y) + x * (u->dx + u->dxy * y + u->dxx * x),
        v->at + y * (v->dy + v->dyy * y) + x * (v->dx + v->dxy * y + v->dxx * x),
        u->dx + u->dxy * y + u->dxx * (2 * x + 1), v->dx + v->dxy * y + v->dxx * (2 * x + 1), 0u - 2 * u->dxx, 0u - 2 * v->dxx
    };
}

/* In texels. */
static struct texcoord wrapped_curve_reference(const struct texel_wraps *w, const struct texel_curves *p, int32_t column, int32_t row)
{
    const struct texcoord c = curve_reference(p, column, row);
    return (struct texcoord){
        (uint32_t)wrapped_texel(w, 0, (int32_t)c.u), (uint32_t)wrapped_texel(w, 1, (int32_t)c.v),
        (uint32_t)wrapped_texel(w, 0, (int32_t)c.du), (uint32_t)wrapped_texel(w, 1, (int32_t)c.dv),
        (uint32_t)wrapped_texel(w, 0, (int32_t)c.curvature_u), (uint32_t)wrapped_texel(w, 1, (int32_t)c.curvature_v)
    };
}

static void wrapped_curves_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p)
{
    for (int32_t i = 0; i < s->count; i++) {
        const int32_t left = s->left[i], last = s->right[i] - 1, row = s->row[i];
        for (int32_t x = block_start(left, last, s->a[i], p->block), end; x < s->b[i]; x = end) {
            end = x + block_next(p->block, last - x);
            end += end == last;
            draw_reference(t, s, i, wrapped_curve_reference(t->wraps, p, x, row), x, s->a[i], min_i32(end, s->b[i]), false);
        }
    }
}

void smear_texel_rows_curves_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p)
{
    if (t->wraps != NULL) {
        wrapped_curves_reference(t, s, p);
        return;
    }
    for (int32_t i = 0; i < s->count; i++)
        draw_reference(t, s, i, curve_reference(p, s->a[i], s->row[i]), s->a[i], s->a[i], s->b[i], false);
}

/* ------------------------------------------------------------------ pixels */

SMEAR_AVX2_INLINE __m256i evens_of_16(void) { return _mm256_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14); }
SMEAR_AVX2_INLINE void row_start(struct row_lanes *r, const struct texel_lanes *k, const struct texel_spans *s, int32_t i,
                                 enum look look)
{
    const ptrdiff_t at = s->row[i] * k->stride;
    const __m256i dz = _mm256_set1_epi32((int32_t)s->dz[i]);
    r->row = s->row[i];
    r->color = look_is_narrow(k, look) ? (void *)((uint16_t *)k->color + at) : (uint32_t *)k->color + at;
    r->depth = k->depth + at;
    r->z = s->z[i];
    r->dz = s->dz[i];
    r->eight = _mm256_mullo_epi32(first_8(), dz);
    r->evens = _mm256_mullo_epi32(evens_of_16(), dz);
}

/* Begins the blocks of light, if there are any. */
SMEAR_AVX2_INLINE void texels_row_light(const struct texel_lanes *k, const struct texel_spans *s, int32_t i, int32_t block, enum look look)
{
    if (look_is_lit(look) && k->lit.blocks != NULL)
        light_row(k->lit.blocks, s, i, block);
}

SMEAR_AVX2_INLINE __m256i lanes_at(int32_t a, int32_t da, __m256i i)
{
    return _mm256_add_epi32(_mm256_set1_epi32(a), _mm256_mullo_epi32(i, _mm256_set1_epi32(da)));
}

/* a + i da + i (i - 1) / 2 dda. */
SMEAR_AVX2_INLINE __m256i lanes_bent_at(int32_t a, int32_t da, int32_t dda, __m256i i, __m256i pairs)
{
    return _mm256_add_epi32(lanes_at(a, da, i), _mm256_mullo_epi32(pairs, _mm256_set1_epi32(dda)));
}

/* How far that is from the value at i + 1. */
SMEAR_AVX2_INLINE __m256i lanes_step(int32_t da, int32_t dda, __m256i i)
{
    return _mm256_add_epi32(_mm256_set1_epi32(da), _mm256_mullo_epi32(i, _mm256_set1_epi32(dda)));
}

SMEAR_AVX2_INLINE __m256i pairs_of(__m256i i)
{
    return _mm256_srli_epi32(_mm256_mullo_epi32(i, _mm256_sub_epi32(i, _mm256_set1_epi32(1))), 1);
}

/* All ones in lanes below n, from lane_masks + 32 - n on, and in lanes from n on, from lane_masks + 16 - n on. */
static const uint16_t lane_masks[48] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
};

/* Tests sixteen depths from x on, of which those of a mask are drawn if there is one. Which are hidden; false if all. */
SMEAR_AVX2_INLINE bool test_16(const struct row_lanes *r, int32_t x, const uint16_t *mask, __m256i *hidden)
{
    __m256i_u *const depth = (__m256i_u *)(r->depth + x);
    const __m256i dz = _mm256_set1_epi32((int32_t)r->dz);
    const __m256i even = _mm256_add_epi32(_mm256_set1_epi32((int32_t)(r->z + r->dz * (uint32_t)x)), r->evens);
    __m256i code = _mm256_blend_epi16(_mm256_srli_epi32(even, 16), _mm256_add_epi32(even, dz), 0xaa);
    if (mask != NULL)
        code = _mm256_and_si256(code, _mm256_loadu_si256((const __m256i_u *)mask));
    const __m256i old = _mm256_loadu_si256(depth), most = _mm256_max_epu16(code, old);
    *hidden = _mm256_cmpeq_epi16(most, old);
    if (_mm256_testc_si256(*hidden, _mm256_set1_epi16(-1)) != 0)
        return false;
    _mm256_storeu_si256(depth, most);
    return true;
}

/* Sixteen narrow pixels from x on, of which those of the mask are drawn if there is one; pixel x is number i of its block. */
SMEAR_AVX2_INLINE void draw_narrow_16(const struct texel_lanes *k, const struct row_lanes *r, const struct block_lanes *c, int32_t block,
                                      int32_t x, int32_t i, const uint16_t *mask)
{
    __m256i_u *const color = (__m256i_u *)((uint16_t *)r->color + x);
    __m256i hidden;
    if (!test_16(r, x, mask, &hidden))
        return;
    __m256i lane = evens_of_16(), pairs = _mm256_setr_epi32(0, 1, 6, 15, 28, 45, 66, 91);
    if (i != 0) {
        lane = _mm256_add_epi32(lane, _mm256_set1_epi32(i));
        pairs = pairs_of(lane);
    }
    const __m256i u = lanes_bent_at(c->u[block], c->du[block], c->ddu[block], lane, pairs);
    const __m256i v = lanes_bent_at(c->v[block], c->dv[block], c->ddv[block], lane, pairs);
    const __m256i u1 = _mm256_add_epi32(u, lanes_step(c->du[block], c->ddu[block], lane));
    const __m256i v1 = _mm256_add_epi32(v, lanes_step(c->dv[block], c->ddv[block], lane));
    const __m256i even = _mm256_srlv_epi32(lanes_gather(k, lanes_index(k, u, v)),
                                           _mm256_and_si256(_mm256_srlv_epi32(u, k->odd_down), k->half));
    const __m256i odd = _mm256_sllv_epi32(lanes_gather(k, lanes_index(k, u1, v1)),
                                          _mm256_andnot_si256(_mm256_srlv_epi32(u1, k->odd_down), k->half));
    const __m256i texels = _mm256_blend_epi16(even, odd, 0xaa);
    _mm256_storeu_si256(color, _mm256_blendv_epi8(texels, _mm256_loadu_si256(color), hidden));
}

/* Tests eight depths from x on, of which those of a mask are drawn. Which are hidden; false if all. */
SMEAR_AVX2_INLINE bool test_8(const struct row_lanes *r, int32_t x, const uint16_t *mask, __m128i *hidden)
{
    __m128i_u *const depth = (__m128i_u *)(r->depth + x);
    const __m256i z = _mm256_set1_epi32((int32_t)(r->z + r->dz * (uint32_t)x));
    __m128i code = upper_halves(_mm256_add_epi32(z, r->eight));
    code = _mm_and_si128(code, _mm_loadu_si128((const __m128i_u *)mask));
    const __m128i old = _mm_loadu_si128(depth), most = _mm_max_epu16(code, old);
    *hidden = _mm_cmpeq_epi16(most, old);
    if (all_hidden(*hidden))
        return false;
    _mm_storeu_si128(depth, most);
    return true;
}

/* Coordinates u and v of eight pixels that are stepped together, as packed_uv and packed_step have them, from pixel i of a block
 * on. Pixels 0 1 4 5 of these are found first. */
SMEAR_AVX2_INLINE void lanes_together(const struct block_lanes *c, int32_t block, int32_t i, __m256i *u, __m256i *v)
{
    const uint64_t change = packed_step((uint32_t)c->ddu[block], (uint32_t)c->ddv[block]), number = (uint64_t)(int64_t)i;
    uint64_t step = packed_step((uint32_t)c->du[block], (uint32_t)c->dv[block]);
    uint64_t at = packed_uv((uint32_t)c->u[block], (uint32_t)c->v[block]);
    if (i != 0) {
        at += step * number + change * (number * (number - 1) >> 1);
        step += change * number;
    }
    const uint64_t two = 2 * step + change, four = at + 2 * two + 4 * change;
    const __m256i first = _mm256_setr_epi64x((int64_t)at, (int64_t)(at + step), (int64_t)four, (int64_t)(four + step + 4 * change));
    const __m256i on = _mm256_setr_epi64x((int64_t)two, (int64_t)(two + 2 * change), (int64_t)(two + 8 * change),
                                          (int64_t)(two + 10 * change));
    const __m256 a = _mm256_castsi256_ps(first), b = _mm256_castsi256_ps(_mm256_add_epi64(first, on));
    *u = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88));
    *v = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd));
}

/* Writes eight pixels from x on, pixel x being number i of its block, where they are not hidden. */
SMEAR_AVX2_INLINE void put_block_8(const struct texel_lanes *k, const struct row_lanes *r, const struct block_lanes *c, int32_t block,
                                   int32_t x, int32_t i, __m128i hidden, enum look look)
{
    __m256i u, v;
    if (look == LOOK_WRAPPED) {
        lanes_together(c, block, i, &u, &v);
    } else {
        const __m256i lane = i == 0 ? first_8() : _mm256_add_epi32(first_8(), _mm256_set1_epi32(i));
        u = lanes_at(c->u[block], c->du[block], lane);
        v = lanes_at(c->v[block], c->dv[block], lane);
        if (c->bent) {
            const __m256i pairs = i == 0 ? _mm256_setr_epi32(0, 0, 1, 3, 6, 10, 15, 21) : pairs_of(lane);
            u = _mm256_add_epi32(u, _mm256_mullo_epi32(pairs, _mm256_set1_epi32(c->ddu[block])));
            v = _mm256_add_epi32(v, _mm256_mullo_epi32(pairs, _mm256_set1_epi32(c->ddv[block])));
        }
    }
    put_8(k, r, x, u, v, hidden, look);
}

/* Eight pixels, as draw_narrow_16. */
SMEAR_AVX2_INLINE void draw_8(const struct texel_lanes *k, const struct row_lanes *r, const struct block_lanes *c, int32_t block,
                              int32_t x, int32_t i, const uint16_t *mask, enum look look)
{
    __m128i hidden;
    if (test_8(r, x, mask, &hidden))
        put_block_8(k, r, c, block, x, i, hidden, look);
}

/* Sixteen pixels, which are narrow if texels are copied as such, else two eights. */
SMEAR_AVX2_INLINE void draw_16(const struct texel_lanes *k, const struct row_lanes *r, const struct block_lanes *c, int32_t block,
                               int32_t x, int32_t i, const uint16_t *mask, enum look look)
{
    if (look == LOOK_NARROW) {
        draw_narrow_16(k, r, c, block, x, i, mask);
        return;
    }
    __m256i hidden;
    if (!test_16(r, x, mask, &hidden))
        return;
    put_block_8(k, r, c, block, x, i, _mm256_castsi256_si128(hidden), look);
    put_block_8(k, r, c, block, x + 8, i + 8, _mm256_extracti128_si256(hidden, 1), look);
}

/* Where eight pixels begin among which are those from a on, up to b, and the mask of these. */
SMEAR_AVX2_INLINE int32_t eight_from(const struct texel_lanes *k, int32_t a, int32_t b, const uint16_t **mask)
{
    if (a <= k->x_most8) {
        *mask = lane_masks + 32 - min_i32(b - a, 8);
        return a;
    }
    *mask = lane_masks + 16 - (a - (b - 8));
    return b - 8;
}

/* Pixels [a, b) of a block that begins at `start`; by eights alone where there may be sixteen, but seldom are. */
SMEAR_AVX2_INLINE void draw_block(const struct texel_lanes *k, const struct row_lanes *r, const struct block_lanes *c, int32_t block,
                                  int32_t start, int32_t a, int32_t b, enum look look, bool eights)
{
    if (!look_is_lit(look) && !eights) {    /* of lit ones a copy would be large */
        for (; b - a >= 16; a += 16)
            draw_16(k, r, c, block, a, a - start, NULL, look);
    }
    for (; !eights && b - a > 8 && a <= k->x_most; a += 16)
        draw_16(k, r, c, block, a, a - start, lane_masks + 32 - min_i32(b - a, 16), look);
    for (; a < b; a += 8) {
        const uint16_t *mask;
        const int32_t x = eight_from(k, a, b, &mask);
        draw_8(k, r, c, block, x, x - start, mask, look);
    }
}

/* ------------------------------------------------------------------ places */

/* A place for each pixel. */
SMEAR_AVX2_INLINE void row_of_places(const struct texel_lanes *k, const struct planes_lanes *planes, const struct texel_spans *s,
                                     int32_t i, enum look look)
{
    const __m256i row = _mm256_set1_epi32(s->row[i]);
    struct row_lanes r;
    row_start(&r, k, s, i, look);
    texels_row_light(k, s, i, 1, look);
    for (int32_t a = s->a[i], b = s->b[i]; a < b; a += 8) {
        const uint16_t *mask;
        const int32_t x = eight_from(k, a, b, &mask);
        __m128i hidden;
        if (!test_8(&r, x, mask, &hidden))
            continue;
        const struct place_lanes p = places_of(k, planes, _mm256_add_epi32(_mm256_set1_epi32(x), first_8()), row, look);
        put_8(k, &r, x, _mm256_sll_epi32(p.u, planes->up), _mm256_sll_epi32(p.v, planes->up), hidden, look);
    }
}

/* Blocks of a list. */
SMEAR_AVX2_INLINE void rows_of_list(struct place_list *l, struct block_lanes *c, const struct texel_lanes *k,
                                    const struct planes_lanes *planes, const struct texel_spans *s, int32_t block, enum look look)
{
    list_between(c, l, k, planes, look);
    for (const struct listed_run *run = l->run, *const end = run + l->runs; run < end; run++) {
        const int32_t i = run->span, a = s->a[i], b = s->b[i], last = s->right[i] - 1, at = PLACES_BEFORE + run->at;
        struct row_lanes r;
        row_start(&r, k, s, i, look);
        texels_row_light(k, s, i, block, look);
        for (int32_t j = at + 1, x = l->x[at]; j < at + run->count; j++) {
            const int32_t stop = l->x[j];
            draw_block(k, &r, c, j, x, max_i32(x, a), min_i32(stop + (stop == last), b), look, false);
            x = stop;
        }
    }
}

SMEAR_AVX2_INLINE void rows_of_places(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p, enum look look)
{
    struct texel_lanes k;
    struct light_lanes blocks;
    struct planes_lanes planes;
    struct block_lanes c;
    struct place_list list;
    lanes_start(&k, t, &blocks, look);
    planes_start(&planes, p);
    c.bent = p->parabolic;
    bool goes_on = false;
    for (int32_t i = 0, x = 0; i < s->count;) {
        list_start(&list);
        for (; i < s->count; i++) {
            const int32_t left = s->left[i], right = s->right[i];
            if (p->block == 1 || right - left <= SHORT_SPAN) {
                row_of_places(&k, &planes, s, i, look);
                continue;
            }
            if (!goes_on)
                x = block_start(left, right - 1, s->a[i], p->block);
            goes_on = !list_blocks(&list, s, i, p->block, &x);
            if (goes_on)
                break;
        }
        rows_of_list(&list, &c, &k, &planes, s, p->block, look);
    }
}

SMEAR_AVX2_FUNCTION void smear_texel_rows_places_avx2(const struct texel_rows *t, const struct texel_spans *s,
                                                      const struct texel_planes *p)
{
    if (t->wraps != NULL)
        rows_of_places(t, s, p, LOOK_WRAPPED);
    else if (t->lights != NULL)
        rows_of_places(t, s, p, LOOK_LIT);
    else if (t->narrow)
        rows_of_places(t, s, p, LOOK_NARROW);
    else
        rows_of_places(t, s, p, LOOK_WIDE);
}

/* ------------------------------------------------------------------ curves */

struct curve_lanes {
    __m256i at, dx, dy, dxx, dxy, dyy;
};

SMEAR_AVX2_INLINE void curve_start(struct curve_lanes *k, const struct texel_curve *c)
{
    k->at = _mm256_set1_epi32((int32_t)c->at);
    k->dx = _mm256_set1_epi32((int32_t)c->dx);
    k->dy = _mm256_set1_epi32((int32_t)c->dy);
    k->dxx = _mm256_set1_epi32((int32_t)c->dxx);
    k->dxy = _mm256_set1_epi32((int32_t)c->dxy);
    k->dyy = _mm256_set1_epi32((int32_t)c->dyy);
}

/* Values at eight places, and steps to the right of them. */
SMEAR_AVX2_INLINE void curve_at(const struct curve_lanes *k, __m256i x, __m256i y, __m256i *value, __m256i *step)
{
    const __m256i along = _mm256_mullo_epi32(k->dxx, x), dx = _mm256_add_epi32(k->dx, _mm256_mullo_epi32(k->dxy, y));
    const __m256i down = _mm256_mullo_epi32(_mm256_add_epi32(k->dy, _mm256_mullo_epi32(k->dyy, y)), y);
    const __m256i right = _mm256_mullo_epi32(_mm256_add_epi32(dx, along), x);
    *value = _mm256_add_epi32(k->at, _mm256_add_epi32(down, right));
    *step = _mm256_add_epi32(dx, _mm256_add_epi32(_mm256_add_epi32(along, along), k->dxx));
}

SMEAR_AVX2_INLINE void rows_of_curves(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p, enum look look)
{
    struct texel_lanes k;
    struct light_lanes blocks;
    struct curve_lanes u, v;
    struct block_lanes c;
    lanes_start(&k, t, &blocks, look);
    curve_start(&u, &p->u);
    curve_start(&v, &p->v);
    c.bent = true;
    store_lanes(c.ddu, _mm256_add_epi32(u.dxx, u.dxx));
    store_lanes(c.ddv, _mm256_add_epi32(v.dxx, v.dxx));
    for (int32_t i = 0; i < s->count; i += 8) {
        const __m256i x = _mm256_sub_epi32(_mm256_loadu_si256((const __m256i_u *)(s->a + i)), _mm256_set1_epi32(p->x0));
        const __m256i y = _mm256_sub_epi32(_mm256_loadu_si256((const __m256i_u *)(s->row + i)), _mm256_set1_epi32(p->y0));
        __m256i at, step;
        curve_at(&u, x, y, &at, &step);
        store_lanes(c.u, at);
        store_lanes(c.du, step);
        curve_at(&v, x, y, &at, &step);
        store_lanes(c.v, at);
        store_lanes(c.dv, step);
        const int32_t count = min_i32(s->count - i, 8);
        for (int32_t j = 0; j < count; j++) {
            struct row_lanes r;
            row_start(&r, &k, s, i + j, look);
            if (look == LOOK_LIT)
                texels_row_light(&k, s, i + j, t->lights->planes.block, look);
            draw_block(&k, &r, &c, j, s->a[i + j], s->a[i + j], s->b[i + j], look, look != LOOK_NARROW);
        }
    }
}

/* Blocks of a row, from that of pixel a on. */
SMEAR_AVX2_INLINE void row_of_wrapped_curves(const struct texel_lanes *k, const struct row_lanes *r, const struct curve_lanes of[2],
                                             struct block_lanes *c, const struct texel_spans *s, int32_t i, const struct texel_curves *p)
{
    const int32_t last = s->right[i] - 1, a = s->a[i], b = s->b[i], block = p->block;
    const __m256i numbers = _mm256_mullo_epi32(first_8(), _mm256_set1_epi32(block)), y = _mm256_set1_epi32(s->row[i] - p->y0);
    for (int32_t start = block_start(s->left[i], last, a, block), j = 8;; start += block, j++) {
        if (j == 8) {
            const __m256i x = _mm256_add_epi32(_mm256_set1_epi32(start - p->x0), numbers);
            __m256i at, step;
            curve_at(&of[0], x, y, &at, &step);
            store_lanes(c->u, ratio_texels(&k->wrap.u, at));
            store_lanes(c->du, ratio_texels(&k->wrap.u, step));
            curve_at(&of[1], x, y, &at, &step);
            store_lanes(c->v, ratio_texels(&k->wrap.v, at));
            store_lanes(c->dv, ratio_texels(&k->wrap.v, step));
            j = 0;
        }
        int32_t stop = start + block_next(block, last - start);
        stop += stop == last;
        draw_block(k, r, c, j, start, max_i32(start, a), min_i32(stop, b), LOOK_WRAPPED, false);
        if (stop >= b)
            return;
    }
}

SMEAR_AVX2_INLINE void rows_of_wrapped_curves(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p)
{
    struct texel_lanes k;
    struct light_lanes blocks;
    struct curve_lanes of[2];
    struct block_lanes c;
    const __m256i zero = _mm256_setzero_si256();
    lanes_start(&k, t, &blocks, LOOK_WRAPPED);
    curve_start(&of[0], &p->u);
    curve_start(&of[1], &p->v);
    store_lanes(c.ddu, _mm256_sub_epi32(zero, ratio_texels(&k.wrap.u, _mm256_slli_epi32(_mm256_sub_epi32(zero, of[0].dxx), 1))));
    store_lanes(c.ddv, _mm256_sub_epi32(zero, ratio_texels(&k.wrap.v, _mm256_slli_epi32(_mm256_sub_epi32(zero, of[1].dxx), 1))));
    for (int32_t i = 0; i < s->count; i++) {
        struct row_lanes r;
        row_start(&r, &k, s, i, LOOK_WRAPPED);
        texels_row_light(&k, s, i, t->lights->planes.block, LOOK_WRAPPED);
        row_of_wrapped_curves(&k, &r, of, &c, s, i, p);
    }
}

SMEAR_AVX2_FUNCTION void smear_texel_rows_curves_avx2(const struct texel_rows *t, const struct texel_spans *s,
                                                      const struct texel_curves *p)
{
    if (t->wraps != NULL)
        rows_of_wrapped_curves(t, s, p);
    else if (t->lights != NULL)
        rows_of_curves(t, s, p, LOOK_LIT);
    else if (t->narrow)
        rows_of_curves(t, s, p, LOOK_NARROW);
    else
        rows_of_curves(t, s, p, LOOK_WIDE);
}
#endif
