/* SPDX-License-Identifier: MIT */
/* flat_face.c - see flat_face.h: what corners tell, of eight faces at once; then the ends of eight rows at once, and sixteen
 * pixels of a row. */
#include "kernels/flat_face.h"

#include "kernels/edge_lanes.h"
#include "kernels/wide8.h"

#if SMEAR_AVX2

SMEAR_AVX2_INLINE __m256i face_load(const void *p) { return _mm256_loadu_si256((const __m256i *)p); }
SMEAR_AVX2_INLINE void face_store(void *p, __m256i a) { _mm256_storeu_si256((__m256i *)p, a); }

/* ------------------------------------------------------------------ sides */

/* The long side, and those above and below the middle corner. Where all rows lie on one side of that, there is no side below, and
 * what is called above may be either. */
enum { FACE_LONG, FACE_ABOVE, FACE_BELOW, FACE_SIDES };

struct face_sides {
    uint64_t x[FACE_SIDES], step[FACE_SIDES];       /* in the first row: px q42, as in struct edge_walk */
    int32_t row, n;             /* the first row, from the area's on, and how many there are: n > 0 */
    int32_t knee;               /* those before this one, from the first one on, lie above the middle corner; any number */
};

SMEAR_AVX2_INLINE bool face_is_bent(const struct face_sides *s) { return s->knee > 0 && s->knee < s->n; }

/* A side as edge_start makes it, but that steps may lack as much where they are positive. x: of its upper end, half a pixel to the
 * right; down: from there to the centres of the row below it, both q8 px; rows: from that one to the first. */
SMEAR_AVX2_INLINE void side_make(uint64_t *at, uint64_t *along, int32_t x, int32_t dx, int32_t dy, int32_t down, int32_t rows)
{
    const int64_t step = dx * ((int64_t)1 << 42) / dy - 1, first = x * ((int64_t)1 << 34) + (step >> 8) * down - 1;
    *at = (uint64_t)first + (uint64_t)step * (uint64_t)(int64_t)rows;
    *along = (uint64_t)step;
}

SMEAR_AVX2_INLINE void face_side(struct face_sides *s, int side, int32_t x, int32_t dx, int32_t dy, int32_t down, int32_t rows)
{
    side_make(&s->x[side], &s->step[side], x, dx, dy, down, rows);
}

SMEAR_AVX2_INLINE struct edge_lanes face_walk_start(const struct face_sides *s, int side)
{
    return edge_lanes_start(s->x[side], s->step[side]);
}

/* ------------------------------------------------------------------ rows */

/* Depths of pixel 0 of a face's first row, and their steps; the colour as the target has it. */
struct face_look {
    uint32_t z, dz, dz_down, color;
};

/* The area, and in all lanes: its columns, the first of the last sixteen; places of eight rows, and from those to the next. */
struct face_area {
    void *pixels;
    uint16_t *depth;
    lanes8i x0, x1, x_most;
    lanes8 rows, rows_down;
    int32_t stride, beyond;         /* beyond: the first of the last sixteen columns */
    bool narrow;
};

SMEAR_AVX2_INLINE struct face_area face_area_of(const struct flat_area *a)
{
    const lanes8 stride = lanes8_all((uint32_t)a->stride);
    return (struct face_area){ a->pixels, a->depth, lanes8i_all(a->x0), lanes8i_all(a->x1), lanes8i_all(a->x1 - 16),
                               stride * lanes8_numbers(), stride << 3, a->stride, a->x1 - 16, a->narrow };
}

/* Bit i is that of row i, which has pixels within the area's columns: one, or up to sixteen, of which the first lies among the last
 * sixteen columns or before them; or more. */
struct face_kinds {
    uint64_t one, few, last, many;
};

/* What is made of eight rows at once reaches beyond the last. */
struct face_rows {
    int32_t at[FLAT_FACE_ROWS];         /* places of the pixel from which on sixteen are drawn: the first one, or that of the last
                                         * sixteen columns */
    uint32_t z[FLAT_FACE_ROWS];         /* its depth */
    int32_t before[FLAT_FACE_ROWS];     /* pixels that come before those of the row, less than none */
    int32_t end[FLAT_FACE_ROWS];        /* and up to the last one: less than none, too */
};

/* Eight rows on their way down: sides, places of column 0, and depths there; how far the middle corner lies below. */
struct face_eight_rows {
    struct edge_lanes whole, above, below;
    lanes8 at, z;
    lanes8i rest;
};

/* Finds eight rows from row i on, whose bits are the lowest; `few` are all that have pixels. Between the top and the bottom no side
 * crosses the other, so the lesser one is the left one. */
SMEAR_AVX2_INLINE struct face_kinds face_eight_find(struct face_rows *r, int32_t i, const struct face_eight_rows *e,
                                                    const struct face_area *a, lanes8 dz, bool bent)
{
    const lanes8i side = edge_lanes_pixels(&e->whole), up = edge_lanes_pixels(&e->above);
    const lanes8i part = bent ? lanes8i_choose(e->rest > 0, up, edge_lanes_pixels(&e->below)) : up;
    const lanes8i left = lanes8i_max(lanes8i_min(side, part), a->x0), right = lanes8i_min(lanes8i_max(side, part), a->x1);
    const lanes8i from = lanes8i_min(left, a->x_most), pixels = (lanes8i)((lanes8)right - (lanes8)from);
    lanes8_store(r->at + i, e->at + (lanes8)from);
    lanes8_store(r->z + i, e->z + dz * (lanes8)from);
    lanes8i_store(r->before + i, from - left);
    lanes8i_store(r->end + i, -pixels);
    return (struct face_kinds){ .one = lanes8i_signs(pixels == lanes8i_word(LANES8_1)), .few = lanes8i_signs(right > left),
                                .last = lanes8i_signs(left > a->x_most), .many = lanes8i_signs(pixels > lanes8i_word(LANES8_16)) };
}

SMEAR_AVX2_INLINE void face_eight_down(struct face_eight_rows *e, const struct face_area *a, uint32_t dz_down, bool bent)
{
    edge_lanes_next(&e->whole);
    edge_lanes_next(&e->above);
    if (bent)
        edge_lanes_next(&e->below);
    e->at += a->rows_down;
    e->z += lanes8_all(8 * dz_down);
    e->rest -= lanes8i_word(LANES8_8);
}

SMEAR_AVX2_INLINE struct face_kinds face_rows_find(struct face_rows *r, const struct face_sides *s, const struct face_area *a,
                                                   const struct face_look *look, bool bent)
{
    struct face_eight_rows e = { .whole = face_walk_start(s, FACE_LONG), .above = face_walk_start(s, FACE_ABOVE) };
    const lanes8 dz = lanes8_all(look->dz);
    e.z = lanes8_ramp(look->z, look->dz_down, lanes8_numbers());
    e.at = lanes8_all((uint32_t)(s->row * a->stride)) + a->rows;
    e.rest = lanes8i_all(s->knee) - lanes8i_numbers();
    e.below = bent ? face_walk_start(s, FACE_BELOW) : e.above;
    /* Few have more rows than eight, and the first ones need no shifts. */
    struct face_kinds all = face_eight_find(r, 0, &e, a, dz, bent);
    for (int32_t i = 8; i < s->n; i += 8) {
        face_eight_down(&e, a, look->dz_down, bent);
        const struct face_kinds m = face_eight_find(r, i, &e, a, dz, bent);
        all.one |= m.one << i;
        all.few |= m.few << i;
        all.last |= m.last << i;
        all.many |= m.many << i;
    }
    const uint64_t some = _bzhi_u64(all.few, (uint32_t)s->n);
    return (struct face_kinds){ .one = some & all.one & ~all.last, .few = some & ~(all.one | all.last | all.many),
                                .last = some & all.last, .many = some & all.many };
}

/* ------------------------------------------------------------------ pixels */

/* All ones in lanes below n, from face_first - n on, and in lanes from n on, from face_last - n on. */
static const uint16_t face_masks[48] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
};
#define face_first (face_masks + 32)
#define face_last (face_masks + 16)

/* How a face's pixels are drawn: steps of the depths of pixels 0 2 .. 14 and 1 3 .. 15; the colour. */
struct face_lanes {
    __m256i steps, steps1, color;
    bool narrow, breaks;
};

SMEAR_AVX2_INLINE __m256i face_codes(__m256i z, bool breaks)
{
    if (!breaks)
        return z;
    const __m256 near = _mm256_castsi256_ps(_mm256_add_epi32(z, z)), far = _mm256_castsi256_ps(_mm256_slli_epi32(z, 5));
    const __m256i above = _mm256_castps_si256(_mm256_blendv_ps(near, far, _mm256_castsi256_ps(z)));
    return _mm256_add_epi32(above, _mm256_set1_epi32((int32_t)FLAT_BREAK_CODE));
}

/* Sixteen pixels, z being the depth of the first in all lanes, of which those of the mask are drawn. */
SMEAR_AVX2_INLINE void face_draw_16(const struct face_lanes *k, void *pixels, uint16_t *depth, __m256i z, __m256i mask)
{
    const __m256i even = face_codes(_mm256_add_epi32(z, k->steps), k->breaks), odd = face_codes(_mm256_add_epi32(z, k->steps1), k->breaks);
    const __m256i code = _mm256_and_si256(_mm256_blend_epi16(_mm256_srli_epi32(even, 16), odd, 0xaa), mask);
    const __m256i old = face_load(depth), most = _mm256_max_epu16(code, old), stays = _mm256_cmpeq_epi16(most, old);
    face_store(depth, most);
    if (k->narrow) {
        face_store(pixels, _mm256_blendv_epi8(k->color, face_load(pixels), stays));
        return;
    }
    uint32_t *const first = (uint32_t *)pixels, *const last = first + 8;
    const __m256i stays0 = _mm256_cvtepi16_epi32(_mm256_castsi256_si128(stays));
    const __m256i stays1 = _mm256_cvtepi16_epi32(_mm256_extracti128_si256(stays, 1));
    face_store(first, _mm256_blendv_epi8(k->color, face_load(first), stays0));
    face_store(last, _mm256_blendv_epi8(k->color, face_load(last), stays1));
}

/* Pixels of a row, more than sixteen; `beyond`: columns from its first one to the last sixteen. */
SMEAR_AVX2_INLINE void face_row(const struct face_lanes *k, const struct face_rows *r, int i, const struct face_area *a, uint32_t dz,
                                int32_t beyond)
{
    const __m256i step = _mm256_set1_epi32((int32_t)(16 * dz));
    int32_t at = r->at[i], n = -r->end[i];
    __m256i z = _mm256_set1_epi32((int32_t)r->z[i]);
    for (; n >= 16; n -= 16, at += 16, beyond -= 16, z = _mm256_add_epi32(z, step))
        face_draw_16(k, pixel_after(a->pixels, at, k->narrow), a->depth + at, z, _mm256_set1_epi32(-1));
    if (n == 0)
        return;
    beyond = min_i32(beyond, 0);
    at += beyond;
    z = _mm256_add_epi32(z, _mm256_set1_epi32((int32_t)(dz * (uint32_t)beyond)));
    const __m256i mask = _mm256_and_si256(face_load(face_first - (n - beyond)), face_load(face_last + beyond));
    face_draw_16(k, pixel_after(a->pixels, at, k->narrow), a->depth + at, z, mask);
}

SMEAR_AVX2_INLINE void face_fill(const struct face_rows *r, const struct face_kinds *kinds, int32_t row, const struct face_area *a,
                                 const struct face_look *look, bool narrow, bool breaks)
{
    const lanes8 evens = lanes8_numbers() * 2;
    const struct face_lanes k = { (__m256i)lanes8_ramp(0, look->dz, evens), (__m256i)lanes8_ramp(look->dz, look->dz, evens),
                                  narrow ? _mm256_set1_epi16((int16_t)look->color) : _mm256_set1_epi32((int32_t)look->color),
                                  narrow, breaks };
    void *const pixels = a->pixels;
    uint16_t *const depth = a->depth;
    for (uint64_t one = kinds->one; one != 0; one &= one - 1) {
        const int i = __builtin_ctzll(one);
        flat_pixel(pixels, depth, r->at[i], flat_code(r->z[i], breaks), look->color, narrow);
    }
    for (uint64_t few = kinds->few; few != 0; few &= few - 1) {
        const int i = __builtin_ctzll(few);
        const int32_t at = r->at[i];
        const __m256i z = _mm256_set1_epi32((int32_t)r->z[i]);
        face_draw_16(&k, pixel_after(pixels, at, narrow), depth + at, z, face_load(face_first + r->end[i]));
    }
    for (uint64_t last = kinds->last; last != 0; last &= last - 1) {
        const int i = __builtin_ctzll(last);
        const int32_t at = r->at[i];
        const __m256i z = _mm256_set1_epi32((int32_t)r->z[i]);
        const __m256i mask = _mm256_and_si256(face_load(face_first + r->end[i]), face_load(face_last + r->before[i]));
        face_draw_16(&k, pixel_after(pixels, at, narrow), depth + at, z, mask);
    }
    for (uint64_t many = kinds->many; many != 0; many &= many - 1) {
        const int i = __builtin_ctzll(many);
        face_row(&k, r, i, a, look->dz, a->beyond + (row + i) * a->stride - r->at[i]);
    }
}

SMEAR_AVX2_INLINE void face_draw(const struct face_sides *s, const struct face_area *a, const struct face_look *look, bool breaks)
{
    struct face_rows r;
    struct face_kinds m;
    if (face_is_bent(s))
        m = face_rows_find(&r, s, a, look, true);
    else
        m = face_rows_find(&r, s, a, look, false);
    if (a->narrow && breaks)
        face_fill(&r, &m, s->row, a, look, true, true);
    else if (a->narrow)
        face_fill(&r, &m, s->row, a, look, true, false);
    else if (breaks)
        face_fill(&r, &m, s->row, a, look, false, true);
    else
        face_fill(&r, &m, s->row, a, look, false, false);
}

/* ------------------------------------------------------------------ one face */

/* A quarter of the instructions of the loops that call flat_run. */
SMEAR_AVX2_FUNCTION void smear_flat_face_avx2(const struct flat_area *a, const struct flat_face *f)
{
    struct corners c;
    corners_find(&c, f->corner, a->y0, a->y1);
    const int32_t first = (c.top[1] + 127) >> 8, knee = (c.middle[1] + 127) >> 8;
    struct face_sides s = { .row = c.first - a->y0, .n = c.end - c.first, .knee = knee - c.first };
    if (s.n <= 0)
        return;
    const int32_t down = first * 256 + 128 - c.top[1], down_middle = knee * 256 + 128 - c.middle[1];
    face_side(&s, FACE_LONG, c.top[0] + 128, c.bottom[0] - c.top[0], c.bottom[1] - c.top[1], down, c.first - first);
    if (s.knee > 0)
        face_side(&s, FACE_ABOVE, c.top[0] + 128, c.middle[0] - c.top[0], c.middle[1] - c.top[1], down, c.first - first);
    if (s.knee < s.n)
        face_side(&s, s.knee > 0 ? FACE_BELOW : FACE_ABOVE, c.middle[0] + 128, c.bottom[0] - c.middle[0], c.bottom[1] - c.middle[1],
                  down_middle, -s.knee);
    const struct face_look look = { f->z + f->dz_down * (uint32_t)s.row, f->dz, f->dz_down, f->color };
    const struct face_area area = face_area_of(a);
    face_draw(&s, &area, &look, f->breaks);
}

/* ------------------------------------------------------------------ a face that goes on */

SMEAR_AVX2_FUNCTION void smear_flat_carry_avx2(struct flat_carried *f, const int32_t *const corner[3], int32_t y)
{
    struct corners c;
    corners_find(&c, corner, y, INT16_MAX);
    const int32_t first = (c.top[1] + 127) >> 8, knee = (c.middle[1] + 127) >> 8, down = first * 256 + 128 - c.top[1];
    f->y = y;
    f->knee = knee;
    side_make(&f->x[FACE_LONG], &f->step[FACE_LONG], c.top[0] + 128, c.bottom[0] - c.top[0], c.bottom[1] - c.top[1], down, y - first);
    if (knee > y)
        side_make(&f->x[FACE_ABOVE], &f->step[FACE_ABOVE], c.top[0] + 128, c.middle[0] - c.top[0], c.middle[1] - c.top[1], down,
                  y - first);
    if (c.bottom[1] > c.middle[1])
        side_make(&f->x[FACE_BELOW], &f->step[FACE_BELOW], c.middle[0] + 128, c.bottom[0] - c.middle[0], c.bottom[1] - c.middle[1],
                  knee * 256 + 128 - c.middle[1], y - knee);
}

SMEAR_AVX2_FUNCTION void smear_flat_carried_avx2(const struct flat_area *a, const struct flat_carried *f, int32_t y, int32_t end)
{
    const uint64_t rows = (uint64_t)(int64_t)(y - f->y);
    struct face_sides s = { .row = y - a->y0, .n = end - y, .knee = f->knee - y };
    s.x[FACE_LONG] = f->x[FACE_LONG] + f->step[FACE_LONG] * rows;
    s.step[FACE_LONG] = f->step[FACE_LONG];
    const int above = s.knee > 0 ? FACE_ABOVE : FACE_BELOW;
    s.x[FACE_ABOVE] = f->x[above] + f->step[above] * rows;
    s.step[FACE_ABOVE] = f->step[above];
    if (face_is_bent(&s)) {
        s.x[FACE_BELOW] = f->x[FACE_BELOW] + f->step[FACE_BELOW] * rows;
        s.step[FACE_BELOW] = f->step[FACE_BELOW];
    }
    const struct face_look look = { f->z + f->dz_down * (uint32_t)rows, f->dz, f->dz_down, f->color };
    const struct face_area area = face_area_of(a);
    face_draw(&s, &area, &look, f->breaks);
}

/* ------------------------------------------------------------------ eight faces */

/* Puts the corner with the lesser y first. */
SMEAR_AVX2_INLINE void face_sort(lanes8i *ax, lanes8i *ay, lanes8i *bx, lanes8i *by)
{
    const lanes8i swap = *by < *ay, x = *ax, y = *ay;
    *ax = lanes8i_choose(swap, *bx, x);
    *bx = lanes8i_choose(swap, x, *bx);
    *ay = lanes8i_min(y, *by);
    *by = lanes8i_max(y, *by);
}

/* All ones in lane k where bit k is set. */
SMEAR_AVX2_INLINE lanes8i face_bits(uint32_t bits)
{
    const lanes8 bit = { 1, 2, 4, 8, 16, 32, 64, 128 };
    return (lanes8_all(bits) & bit) == bit;
}

/* Their depths, and in which way their codes are told. */
SMEAR_AVX2_INLINE void face_depths(struct flat_eight *e, const struct planes8 *p, lanes8i first)
{
    const lanes8i far = face_bits(p->far), near = face_bits(p->near), both = ~(far | near);
    const lanes8i shift = (far & 5) | (near & 1);
    const lanes8 dy = lanes8_load(p->dy);
    const lanes8 above = lanes8_load(p->at) + dy * (lanes8)first - FLAT_BREAK;
    lanes8_store(e->z, lanes8_left(above, shift) + (~(lanes8)both & FLAT_BREAK_CODE));
    lanes8_store(e->dz, lanes8_left(lanes8_load(p->dx), shift));
    lanes8_store(e->dz_down, lanes8_left(dy, shift));
    e->breaks = lanes8i_signs(both);
}

SMEAR_AVX2_FUNCTION void smear_flat_eight_make_avx2(struct flat_eight *e, const struct flat_area *a, const struct poses *poses,
                                                    const struct planes8 *planes, const uint32_t color[8])
{
    const struct corner8 v0 = corner8_of(poses, 0), v1 = corner8_of(poses, 1), v2 = corner8_of(poses, 2);
    lanes8i x0 = v0.x, y0 = v0.y, x1 = v1.x, y1 = v1.y, x2 = v2.x, y2 = v2.y;
    face_sort(&x0, &y0, &x1, &y1);
    face_sort(&x1, &y1, &x2, &y2);
    face_sort(&x0, &y0, &x1, &y1);
    const lanes8i below = (y0 + 127) >> 8, knee = (y1 + 127) >> 8, top = lanes8i_all(a->y0);
    const lanes8i first = lanes8i_max(below, top);
    lanes8i_store(e->row, first - top);
    lanes8i_store(e->n, lanes8i_min((y2 + 127) >> 8, lanes8i_all(a->y1)) - first);
    lanes8i_store(e->knee, knee - first);
    lanes8i_store(e->rows, first - below);
    lanes8i_store(e->x[0], x0 + 128);
    lanes8i_store(e->x[1], x1 + 128);
    lanes8i_store(e->down[0], (below << 8) + 128 - y0);
    lanes8i_store(e->down[1], (knee << 8) + 128 - y1);
    lanes8i_store(e->dx[FACE_LONG], x2 - x0);
    lanes8i_store(e->dy[FACE_LONG], y2 - y0);
    lanes8i_store(e->dx[FACE_ABOVE], x1 - x0);
    lanes8i_store(e->dy[FACE_ABOVE], y1 - y0);
    lanes8i_store(e->dx[FACE_BELOW], x2 - x1);
    lanes8i_store(e->dy[FACE_BELOW], y2 - y1);
    face_depths(e, planes, first);
    const lanes8 pixel = lanes8_load(color);
    lanes8_store(e->color, a->narrow ? lanes8_narrow(pixel) : pixel & 0xffffffu);
}

SMEAR_AVX2_FUNCTION void smear_flat_eight_draw_avx2(const struct flat_eight *e, const struct flat_area *a, uint32_t which)
{
    const struct face_area area = face_area_of(a);
    for (; which != 0; which &= which - 1) {
        const int k = __builtin_ctz(which);
        struct face_sides s;
        s.row = e->row[k];
        s.n = e->n[k];
        s.knee = e->knee[k];
        if (s.n <= 0)
            continue;
        face_side(&s, FACE_LONG, e->x[0][k], e->dx[FACE_LONG][k], e->dy[FACE_LONG][k], e->down[0][k], e->rows[k]);
        if (s.knee > 0)
            face_side(&s, FACE_ABOVE, e->x[0][k], e->dx[FACE_ABOVE][k], e->dy[FACE_ABOVE][k], e->down[0][k], e->rows[k]);
        if (s.knee < s.n)
            face_side(&s, s.knee > 0 ? FACE_BELOW : FACE_ABOVE, e->x[1][k], e->dx[FACE_BELOW][k], e->dy[FACE_BELOW][k], e->down[1][k],
                      -s.knee);
        const struct face_look look = { e->z[k], e->dz[k], e->dz_down[k], e->color[k] };
        face_draw(&s, &area, &look, (e->breaks >> k & 1u) != 0);
    }
}
#endif
