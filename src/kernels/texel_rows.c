/* SPDX-License-Identifier: MIT */
/* texel_rows.c - places of eight blocks at once, then sixteen pixels of a block, or eight. */
#include "kernels/texel_lanes.h"

#if SMEAR_AVX2

/* ------------------------------------------------------------------ references */

static void pixel_reference(const struct texel_rows *t, int32_t row, int32_t x, uint32_t z, uint64_t uv, const uint32_t light[3])
{
    const ptrdiff_t at = row * t->stride + x;
    void *const color = t->narrow ? (void *)((uint16_t *)t->color + at) : (uint32_t *)t->color + at;
    if (t->lights == NULL) {
        texel_pixel(color, t->depth + at, z, t->texels, NULL, uv, t->log2_width, t->log2_height,
                    t->narrow ? TEXELS_NARROW : TEXELS_WIDE);
    } else if (z >> 16 > t->depth[at]) {
        const uint32_t index = packed_index(uv, t->log2_width, t->log2_height);
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
    for (; x < b; x++) {
        if (x >= a && t->lights != NULL)
            light_planes_at(light, &t->lights->planes, s->left[i], s->right[i], single ? 1 : t->lights->planes.block, x, s->row[i]);
        if (x >= a)
            pixel_reference(t, s->row[i], x, s->z[i] + s->dz[i] * (uint32_t)x, packed_uv(c.u, c.v), light);
        c.u += c.du;
        c.v += c.dv;
        c.du -= c.curvature_u;
        c.dv -= c.curvature_v;
    }
}

static struct place place_reference(const struct texel_planes *p, int32_t x, int32_t row)
{
    const int32_t q = texel_plane_at(&p->q, x, row), u = texel_plane_at(&p->u, x, row), v = texel_plane_at(&p->v, x, row);
    return p->divided ? place_divided(q, u, v, p->slope, p->parabolic) : (struct place){ u, v, 0 };
}

void smear_texel_rows_places_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p)
{
    for (int32_t i = 0; i < s->count; i++) {
        const int32_t left = s->left[i], last = s->right[i] - 1, row = s->row[i];
        if (p->block == 1 || last - left < SHORT_SPAN) {
            for (int32_t x = s->a[i]; x < s->b[i]; x++) {
                const struct place here = place_reference(p, x, row);
                const struct texcoord c = { (uint32_t)here.u << p->up, (uint32_t)here.v << p->up, 0, 0, 0, 0 };
                draw_reference(t, s, i, c, x, x, x + 1, true);
            }
            continue;
        }
        for (int32_t x = block_start(left, last, s->a[i], p->block), n; x < last; x += n) {
            n = block_next(p->block, last - x);
            const struct texcoord c = places_between(place_reference(p, x, row), place_reference(p, x + n, row), n, p->up,
                                                     p->parabolic, true);
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

void smear_texel_rows_curves_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p)
{
    for (int32_t i = 0; i < s->count; i++)
        draw_reference(t, s, i, curve_reference(p, s->a[i], s->row[i]), s->a[i], s->a[i], s->b[i], false);
}

/* ------------------------------------------------------------------ pixels */

/* Coordinates of a block's pixel 0, and how they change. */
struct block_lanes {
    int32_t u[8], v[8], du[8], dv[8], ddu[8], ddv[8];
};

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
    if (look == LOOK_NARROW)
        r->evens = _mm256_mullo_epi32(evens_of_16(), dz);
}

/* Begins the blocks of light, if there are any. */
SMEAR_AVX2_INLINE void texels_row_light(const struct texel_lanes *k, const struct texel_spans *s, int32_t i, int32_t block, enum look look)
{
    if (look == LOOK_LIT && k->lit.blocks != NULL)
        light_row(k->lit.blocks, s->left[i], s->right[i], block, s->row[i]);
}

/* a + i da + i (i - 1) / 2 dda. */
SMEAR_AVX2_INLINE __m256i lanes_at(int32_t a, int32_t da, int32_t dda, __m256i i, __m256i pairs)
{
    return _mm256_add_epi32(_mm256_add_epi32(_mm256_set1_epi32(a), _mm256_mullo_epi32(i, _mm256_set1_epi32(da))),
                            _mm256_mullo_epi32(pairs, _mm256_set1_epi32(dda)));
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
SMEAR_AVX2_INLINE bool test_16(const struct row_lanes *r, int32_t x, const uint16_t *mask, __m256i *hidden, enum look look)
{
    __m256i_u *const depth = (__m256i_u *)(r->depth + x);
    const __m256i dz = _mm256_set1_epi32((int32_t)r->dz);
    const __m256i evens = look == LOOK_NARROW ? r->evens : _mm256_mullo_epi32(evens_of_16(), dz);
    const __m256i even = _mm256_add_epi32(_mm256_set1_epi32((int32_t)(r->z + r->dz * (uint32_t)x)), evens);
    __m256i code = _mm256_blend_epi16(_mm256_srli_epi32(even, 16), _mm256_add_epi32(even, dz), 0xaa);
    if (mask != NULL)
        code = _mm256_and_si256(code, _mm256_loadu_si256((const __m256i_u *)mask));
    const __m256i old = _mm256_loadu_si256(depth), most = _mm256_max_epu16(code, old);
    *hidden = _mm256_cmpeq_epi16(most, old);
    if (_mm256_movemask_epi8(*hidden) == -1)
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
    if (!test_16(r, x, mask, &hidden, LOOK_NARROW))
        return;
    __m256i lane = evens_of_16(), pairs = _mm256_setr_epi32(0, 1, 6, 15, 28, 45, 66, 91);
    if (i != 0) {
        lane = _mm256_add_epi32(lane, _mm256_set1_epi32(i));
        pairs = pairs_of(lane);
    }
    const __m256i u = lanes_at(c->u[block], c->du[block], c->ddu[block], lane, pairs);
    const __m256i v = lanes_at(c->v[block], c->dv[block], c->ddv[block], lane, pairs);
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
    __m128i code = lower_halves(_mm256_srli_epi32(_mm256_add_epi32(z, r->eight), 16));
    code = _mm_and_si128(code, _mm_loadu_si128((const __m128i_u *)mask));
    const __m128i old = _mm_loadu_si128(depth), most = _mm_max_epu16(code, old);
    *hidden = _mm_cmpeq_epi16(most, old);
    if (_mm_movemask_epi8(*hidden) == 0xffff)
        return false;
    _mm_storeu_si128(depth, most);
    return true;
}

/* Writes eight pixels from x on, pixel x being number i of its block, where they are not hidden. */
SMEAR_AVX2_INLINE void put_block_8(const struct texel_lanes *k, const struct row_lanes *r, const struct block_lanes *c, int32_t block,
                                   int32_t x, int32_t i, __m128i hidden, enum look look)
{
    __m256i lane = first_8(), pairs = _mm256_setr_epi32(0, 0, 1, 3, 6, 10, 15, 21);
    if (i != 0) {
        lane = _mm256_add_epi32(lane, _mm256_set1_epi32(i));
        pairs = pairs_of(lane);
    }
    put_8(k, r, x, lanes_at(c->u[block], c->du[block], c->ddu[block], lane, pairs),
          lanes_at(c->v[block], c->dv[block], c->ddv[block], lane, pairs), hidden, look);
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
    if (!test_16(r, x, mask, &hidden, look))
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
    if (!eights) {
        for (; b - a >= 16; a += 16)
            draw_16(k, r, c, block, a, a - start, NULL, look);
        if (b - a > 8 && a <= k->x_most) {
            draw_16(k, r, c, block, a, a - start, lane_masks + 32 - (b - a), look);
            return;
        }
    }
    for (; a < b; a += 8) {
        const uint16_t *mask;
        const int32_t x = eight_from(k, a, b, &mask);
        draw_8(k, r, c, block, x, x - start, mask, look);
    }
}

/* ------------------------------------------------------------------ places */

struct plane_lanes {
    __m256i at, dx, dy;
};

struct place_lanes {
    __m256i u, v, nearness;
};

/* What places of a triangle have in common. */
struct planes_lanes {
    struct plane_lanes q, u, v;
    __m256i slope;
    __m128i up;
    bool divided, parabolic;
    __m256i least_q, first_up, exponent, seed, half, low, one, turns, center;       /* numbers of recip_norm and others */
};

SMEAR_AVX2_INLINE struct plane_lanes plane_start(const struct texel_plane *p)
{
    return (struct plane_lanes){ _mm256_set1_epi32(p->at), _mm256_set1_epi32(p->dx), _mm256_set1_epi32(p->dy) };
}

SMEAR_AVX2_INLINE void planes_start(struct planes_lanes *k, const struct texel_planes *p)
{
    k->q = plane_start(&p->q);
    k->u = plane_start(&p->u);
    k->v = plane_start(&p->v);
    k->slope = _mm256_set1_epi32(p->slope);
    k->up = _mm_cvtsi32_si128(p->up);
    k->divided = p->divided;
    k->parabolic = p->parabolic;
    k->least_q = texels_all(1 << 11);
    k->exponent = texels_all(158);
    k->first_up = texels_all(157);
    k->seed = texels_all(255);
    k->half = texels_all(16);
    k->low = texels_all(0xffff);
    k->one = texels_all(INT32_MIN);
    k->turns = texels_all(~255);
    k->center = texels_all(128);
}

SMEAR_AVX2_INLINE __m256i plane_lanes_at(const struct plane_lanes *p, __m256i x, __m256i row)
{
    return _mm256_add_epi32(p->at, _mm256_add_epi32(_mm256_mullo_epi32(p->dx, x), _mm256_mullo_epi32(p->dy, row)));
}

/* As mulh_i32. */
SMEAR_AVX2_INLINE __m256i mulh_lanes(__m256i a, __m256i b)
{
    const __m256i even = _mm256_mul_epi32(a, b), odd = _mm256_mul_epi32(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(b, 32));
    return _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}

/* As part_by. */
SMEAR_AVX2_INLINE __m256i part_lanes(__m256i a, __m256i part)
{
    const __m256i even = _mm256_mul_epi32(a, part);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(part, 32));
    return _mm256_blend_epi32(_mm256_srli_epi64(even, 16), _mm256_slli_epi64(odd, 16), 0xaa);
}

/* 158 less count_leading_zeros: a float's exponent, of a number without what would round it up to a power of two. */
SMEAR_AVX2_INLINE __m256i exponent_lanes(__m256i a)
{
    const __m256i cut = _mm256_andnot_si256(_mm256_srli_epi32(a, 8), a);
    return _mm256_srli_epi32(_mm256_castps_si256(_mm256_cvtepi32_ps(cut)), 23);
}

/* As recip_norm. Seeds are gathered in pairs. */
SMEAR_AVX2_INLINE __m256i recip_lanes(const struct planes_lanes *k, __m256i m)
{
    const __m256i index = _mm256_and_si256(_mm256_srli_epi32(m, 23), k->seed);
    const __m256i second = _mm256_and_si256(_mm256_srli_epi32(m, 18), k->half);
    const __m256i pair = _mm256_i32gather_epi32((const int *)(const void *)smear_recip_seed, index, 4);
    const __m256i r = _mm256_and_si256(_mm256_srlv_epi32(pair, second), k->low);
    const __m256i error = _mm256_sub_epi32(k->one, _mm256_mullo_epi32(_mm256_srli_epi32(m, 11), r));
    return _mm256_add_epi32(_mm256_slli_epi32(r, 19),
                            _mm256_srai_epi32(_mm256_mullo_epi32(r, _mm256_srai_epi32(error, 4)), 8));
}

SMEAR_AVX2_INLINE struct place_lanes places_at(const struct planes_lanes *k, __m256i x, __m256i row)
{
    struct place_lanes p = { plane_lanes_at(&k->u, x, row), plane_lanes_at(&k->v, x, row), _mm256_setzero_si256() };
    if (!k->divided)
        return p;
    const __m256i d = _mm256_max_epi32(plane_lanes_at(&k->q, x, row), k->least_q), exponent = exponent_lanes(d);
    const __m256i r = recip_lanes(k, _mm256_sllv_epi32(d, _mm256_sub_epi32(k->exponent, exponent)));
    const __m256i up = _mm256_sub_epi32(k->first_up, exponent);
    p.u = mulh_lanes(_mm256_sllv_epi32(_mm256_srai_epi32(p.u, 1), up), r);
    p.v = mulh_lanes(_mm256_sllv_epi32(_mm256_srai_epi32(p.v, 1), up), r);
    if (k->parabolic)
        p.nearness = _mm256_srav_epi32(mulh_lanes(k->slope, r), _mm256_sub_epi32(exponent, _mm256_set1_epi32(138)));
    return p;
}

/* Takes the last lane of `before`, then seven of a. */
SMEAR_AVX2_INLINE __m256i lanes_before(__m256i before, __m256i a)
{
    return _mm256_alignr_epi8(a, _mm256_permute2x128_si256(before, a, 0x21), 12);
}

/* 2^16 / n for n up to 16, 32 and 64, which come next. */
static const int32_t lane_inverse[19] = {
    0, 65536, 32768, 21845, 16384, 13107, 10923, 9362, 8192, 7282, 6554, 5958, 5461, 5041, 4681, 4369, 4096, 2048, 1024
};

SMEAR_AVX2_INLINE void store_lanes(int32_t *out, __m256i a) { _mm256_storeu_si256((__m256i_u *)out, a); }

/* As places_between, of one coordinate. */
SMEAR_AVX2_INLINE void between_lanes(const struct planes_lanes *k, __m256i from, __m256i to, __m256i n, __m256i part, __m256i rate,
                                     __m256i mask, int32_t *step, int32_t *change)
{
    __m256i d = part_lanes(_mm256_sub_epi32(to, from), part);
    if (k->parabolic) {
        const __m256i b = _mm256_srai_epi32(_mm256_mullo_epi32(_mm256_srai_epi32(d, 10), rate), 5);
        const __m256i more = _mm256_mullo_epi32(b, _mm256_sub_epi32(n, _mm256_set1_epi32(1)));
        d = _mm256_add_epi32(d, _mm256_srai_epi32(more, 1));
        store_lanes(change, _mm256_sub_epi32(_mm256_setzero_si256(), _mm256_and_si256(_mm256_sll_epi32(b, k->up), mask)));
    }
    store_lanes(step, _mm256_and_si256(_mm256_sll_epi32(d, k->up), mask));
}

/* The coordinates of eight blocks that end at `ends`, n pixels long; the places where they begin and end. */
SMEAR_AVX2_INLINE void blocks_make(struct block_lanes *c, const struct planes_lanes *k, __m256i n, struct place_lanes before,
                                   struct place_lanes to)
{
    const struct place_lanes from = { lanes_before(before.u, to.u), lanes_before(before.v, to.v),
                                      lanes_before(before.nearness, to.nearness) };
    const __m256i number = _mm256_min_epi32(n, _mm256_add_epi32(_mm256_srli_epi32(n, 5), k->half));
    const __m256i part = _mm256_i32gather_epi32((const int *)lane_inverse, number, 4);
    const __m256i nearness = _mm256_add_epi32(from.nearness, to.nearness);
    const __m256i rate = _mm256_srai_epi32(_mm256_add_epi32(nearness, _mm256_set1_epi32(2)), 1);
    between_lanes(k, from.u, to.u, n, part, rate, _mm256_set1_epi32(-1), c->du, c->ddu);
    between_lanes(k, from.v, to.v, n, part, rate, k->turns, c->dv, c->ddv);
    store_lanes(c->u, _mm256_sll_epi32(from.u, k->up));
    store_lanes(c->v, _mm256_or_si256(_mm256_and_si256(_mm256_sll_epi32(from.v, k->up), k->turns), k->center));
}

/* A place for each pixel. */
SMEAR_AVX2_INLINE void row_of_places(const struct texel_lanes *k, const struct row_lanes *r, const struct planes_lanes *planes,
                                     int32_t row, int32_t a, int32_t b, enum look look)
{
    for (; a < b; a += 8) {
        const uint16_t *mask;
        const int32_t x = eight_from(k, a, b, &mask);
        __m128i hidden;
        if (!test_8(r, x, mask, &hidden))
            continue;
        const struct place_lanes p = places_at(planes, _mm256_add_epi32(_mm256_set1_epi32(x), first_8()), _mm256_set1_epi32(row));
        put_8(k, r, x, _mm256_sll_epi32(p.u, planes->up), _mm256_sll_epi32(p.v, planes->up), hidden, look);
    }
}

/* Where eight blocks end, the first of them at x if `first`. Returns where the last one does. */
SMEAR_AVX2_INLINE int32_t ends_make(int32_t end[8], int32_t x, int32_t last, int32_t block, bool first)
{
    if (block <= COLOR_BLOCK_MAX) {
        const __m256i number = _mm256_add_epi32(first_8(), _mm256_set1_epi32(!first));
        const __m256i all = _mm256_add_epi32(_mm256_set1_epi32(x), _mm256_mullo_epi32(number, _mm256_set1_epi32(block)));
        store_lanes(end, _mm256_min_epi32(all, _mm256_set1_epi32(last)));
        return end[7];
    }
    for (int i = 0; i < 8; i++) {
        if (i != 0 || !first)
            x += block_next(block, last - x);
        end[i] = x;
    }
    return x;
}

/* Blocks from that of pixel a on. */
SMEAR_AVX2_INLINE void row_of_blocks(const struct texel_lanes *k, const struct row_lanes *r, const struct planes_lanes *planes,
                                     struct block_lanes *c, const struct texel_spans *s, int32_t i, int32_t block, enum look look)
{
    const int32_t last = s->right[i] - 1, a = s->a[i], b = s->b[i];
    const __m256i row = _mm256_set1_epi32(s->row[i]), zero = _mm256_setzero_si256();
    int32_t end[9], x = block_start(s->left[i], last, a, block);
    struct place_lanes before = { zero, zero, zero };
    end[0] = x;
    for (int j = 1;; j = 0) {
        x = ends_make(end + 1, x, last, block, j == 1);
        const __m256i ends = _mm256_loadu_si256((const __m256i_u *)(end + 1));
        const __m256i n = _mm256_sub_epi32(ends, _mm256_loadu_si256((const __m256i_u *)end));
        const struct place_lanes places = places_at(planes, ends, row);
        blocks_make(c, planes, n, before, places);
        before = places;
        for (; j < 8; j++) {
            const int32_t stop = end[j + 1] + (end[j + 1] == last);
            draw_block(k, r, c, j, end[j], max_i32(end[j], a), min_i32(stop, b), look, false);
            if (stop >= b)
                return;
        }
        end[0] = x;
    }
}

SMEAR_AVX2_INLINE void rows_of_places(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p, enum look look)
{
    struct texel_lanes k;
    struct light_lanes blocks;
    struct planes_lanes planes;
    struct block_lanes c;
    lanes_start(&k, t, &blocks, look);
    planes_start(&planes, p);
    store_lanes(c.ddu, _mm256_setzero_si256());
    store_lanes(c.ddv, _mm256_setzero_si256());
    for (int32_t i = 0; i < s->count; i++) {
        struct row_lanes r;
        const bool single = p->block == 1 || s->right[i] - s->left[i] <= SHORT_SPAN;
        row_start(&r, &k, s, i, look);
        texels_row_light(&k, s, i, single ? 1 : p->block, look);
        if (single)
            row_of_places(&k, &r, &planes, s->row[i], s->a[i], s->b[i], look);
        else
            row_of_blocks(&k, &r, &planes, &c, s, i, p->block, look);
    }
}

SMEAR_AVX2_FUNCTION void smear_texel_rows_places_avx2(const struct texel_rows *t, const struct texel_spans *s,
                                                      const struct texel_planes *p)
{
    if (t->lights != NULL)
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
SMEAR_AVX2_INLINE void curve_at(const struct curve_lanes *k, __m256i x, __m256i y, int32_t *value, int32_t *step)
{
    const __m256i along = _mm256_mullo_epi32(k->dxx, x), dx = _mm256_add_epi32(k->dx, _mm256_mullo_epi32(k->dxy, y));
    const __m256i down = _mm256_mullo_epi32(_mm256_add_epi32(k->dy, _mm256_mullo_epi32(k->dyy, y)), y);
    const __m256i right = _mm256_mullo_epi32(_mm256_add_epi32(dx, along), x);
    store_lanes(value, _mm256_add_epi32(k->at, _mm256_add_epi32(down, right)));
    store_lanes(step, _mm256_add_epi32(dx, _mm256_add_epi32(_mm256_add_epi32(along, along), k->dxx)));
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
    store_lanes(c.ddu, _mm256_add_epi32(u.dxx, u.dxx));
    store_lanes(c.ddv, _mm256_add_epi32(v.dxx, v.dxx));
    for (int32_t i = 0; i < s->count; i += 8) {
        const __m256i x = _mm256_sub_epi32(_mm256_loadu_si256((const __m256i_u *)(s->a + i)), _mm256_set1_epi32(p->x0));
        const __m256i y = _mm256_sub_epi32(_mm256_loadu_si256((const __m256i_u *)(s->row + i)), _mm256_set1_epi32(p->y0));
        curve_at(&u, x, y, c.u, c.du);
        curve_at(&v, x, y, c.v, c.dv);
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

SMEAR_AVX2_FUNCTION void smear_texel_rows_curves_avx2(const struct texel_rows *t, const struct texel_spans *s,
                                                      const struct texel_curves *p)
{
    if (t->lights != NULL)
        rows_of_curves(t, s, p, LOOK_LIT);
    else if (t->narrow)
        rows_of_curves(t, s, p, LOOK_NARROW);
    else
        rows_of_curves(t, s, p, LOOK_WIDE);
}
#endif
