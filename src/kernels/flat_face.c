/* SPDX-License-Identifier: MIT */
/* flat_face.c - see flat_face.h: the ends of eight rows at once, then sixteen pixels of a row. */
#include "kernels/flat_face.h"

#include "kernels/edge_lanes.h"

#if SMEAR_AVX2

/* All ones in lanes below n, from face_masks + 32 - n on, and in lanes from n on, from face_masks + 16 - n on. */
static const uint16_t face_masks[48] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
};

/* Rows from the first one on. What is made of eight at once reaches beyond the last. */
struct face_rows {
    int32_t left[FLAT_FACE_ROWS + 16], right[FLAT_FACE_ROWS + 16];      /* where their pixels begin and end; then how many they are */
    int32_t at[FLAT_FACE_ROWS + 16];    /* places of the first ones */
    uint32_t z[FLAT_FACE_ROWS + 16];    /* their depth codes */
    int32_t few[FLAT_FACE_ROWS + 16];   /* pixels, less one: 0 .. 14 of what is drawn in one go, any other number of what is not */
};

/* What pixels have in common: depth steps of pixels 0 2 .. 14 and 1 3 .. 15; the colour. */
struct face_lanes {
    __m256i steps, steps1, color;
};

SMEAR_AVX2_INLINE __m256i face_load(const void *p) { return _mm256_loadu_si256((const __m256i *)p); }
SMEAR_AVX2_INLINE void face_store(void *p, __m256i a) { _mm256_storeu_si256((__m256i *)p, a); }

/* Sixteen pixels, z being the depth code of the first in all lanes, of which those of the mask are drawn. */
SMEAR_AVX2_INLINE void face_draw_16(const struct face_lanes *k, void *pixels, uint16_t *depth, __m256i z, __m256i mask, bool narrow)
{
    const __m256i even = _mm256_add_epi32(z, k->steps), odd = _mm256_add_epi32(z, k->steps1);
    const __m256i code = _mm256_and_si256(_mm256_blend_epi16(_mm256_srli_epi32(even, 16), odd, 0xaa), mask);
    const __m256i old = face_load(depth), most = _mm256_max_epu16(code, old), stays = _mm256_cmpeq_epi16(most, old);
    face_store(depth, most);
    if (narrow) {
        face_store(pixels, _mm256_blendv_epi8(k->color, face_load(pixels), stays));
        return;
    }
    uint32_t *const first = (uint32_t *)pixels, *const last = first + 8;
    const __m256i stays0 = _mm256_cvtepi16_epi32(_mm256_castsi256_si128(stays));
    const __m256i stays1 = _mm256_cvtepi16_epi32(_mm256_extracti128_si256(stays, 1));
    face_store(first, _mm256_blendv_epi8(k->color, face_load(first), stays0));
    face_store(last, _mm256_blendv_epi8(k->color, face_load(last), stays1));
}

/* Cuts n rows from `row` on at the area's columns, and finds their places and depths. */
SMEAR_AVX2_INLINE void face_cut(struct face_rows *r, const struct flat_area *a, const struct flat_face *f, int32_t row, int32_t n)
{
    const lanes8i x0 = lanes8i_all(a->x0), x1 = lanes8i_all(a->x1), x_most = lanes8i_all(a->x1 - 16);
    const lanes8 dz = lanes8_all(f->dz), z_down = lanes8_all(8 * f->dz_down), down = lanes8_all((uint32_t)(8 * a->stride));
    lanes8 z = lanes8_ramp(f->z + f->dz_down * (uint32_t)row, f->dz_down, lanes8_numbers());
    lanes8 at = lanes8_ramp((uint32_t)(row * a->stride), (uint32_t)a->stride, lanes8_numbers());
    for (int32_t i = 0; i < n; i += 8, z += z_down, at += down) {
        const lanes8i left = lanes8i_max(lanes8i_load(r->left + i), x0), right = lanes8i_min(lanes8i_load(r->right + i), x1);
        lanes8i_store(r->left + i, left);
        const lanes8i pixels = (lanes8i)((lanes8)right - (lanes8)left);     /* of rows beyond the last: anything */
        lanes8i_store(r->right + i, pixels);
        lanes8_store(r->at + i, at + (lanes8)left);
        lanes8_store(r->z + i, z + dz * (lanes8)left);
        lanes8i_store(r->few + i, (lanes8i)((lanes8)pixels - 1) | (left > x_most));
    }
}

/* Pixels of row i, any number. */
SMEAR_AVX2_INLINE void face_row(const struct face_rows *r, int32_t i, const struct flat_area *a, const struct flat_face *f,
                                const struct face_lanes *k, bool narrow)
{
    const int32_t x_most = a->x1 - 16;
    int32_t x = r->left[i], rest = r->right[i], at = r->at[i];
    uint32_t z = r->z[i];
    for (; rest >= 16; rest -= 16, x += 16, at += 16, z += 16 * f->dz)
        face_draw_16(k, pixel_after(a->pixels, at, narrow), a->depth + at, (__m256i)lanes8_all(z), _mm256_set1_epi32(-1), narrow);
    if (rest <= 0)
        return;
    __m256i mask = face_load(face_masks + 32 - rest);
    if (x > x_most) {               /* the area's last sixteen columns, of which some come before x */
        const int32_t before = x - x_most;
        mask = _mm256_and_si256(face_load(face_masks + 32 - (before + rest)), face_load(face_masks + 16 - before));
        at -= before;
        z -= f->dz * (uint32_t)before;
    }
    face_draw_16(k, pixel_after(a->pixels, at, narrow), a->depth + at, (__m256i)lanes8_all(z), mask, narrow);
}

SMEAR_AVX2_INLINE void face_fill(const struct face_rows *r, const struct flat_area *a, const struct flat_face *f, int32_t n, bool narrow)
{
    const lanes8 evens = lanes8_numbers() * 2;
    const struct face_lanes k = { (__m256i)lanes8_ramp(0, f->dz, evens), (__m256i)lanes8_ramp(f->dz, f->dz, evens),
                                  narrow ? _mm256_set1_epi16((int16_t)f->color) : _mm256_set1_epi32((int32_t)f->color) };
    void *const pixels = a->pixels;
    uint16_t *const depth = a->depth;
    for (int32_t i = 0; i < n; i++) {
        const uint32_t few = (uint32_t)r->few[i];
        if (few >= 15) {
            face_row(r, i, a, f, &k, narrow);
            continue;
        }
        const int32_t at = r->at[i];
        const __m256i z = _mm256_set1_epi32((int32_t)r->z[i]);
        face_draw_16(&k, pixel_after(pixels, at, narrow), depth + at, z, face_load(face_masks + 31 - few), narrow);
    }
}

/* A third of the instructions of the loops that call flat_run. */
SMEAR_AVX2_FUNCTION void smear_flat_face_avx2(const struct flat_area *a, const struct flat_face *f)
{
    struct corners c;
    struct face_rows r;
    corners_find(&c, f->corner, a->y0, a->y1);
    const int32_t n = c.end - c.first, row = c.first - a->y0;
    if (n <= 0)
        return;
    corners_sides(r.left, r.right, &c, c.first, n);
    face_cut(&r, a, f, row, n);
    if (a->narrow)
        face_fill(&r, a, f, n, true);
    else
        face_fill(&r, a, f, n, false);
}
#endif
