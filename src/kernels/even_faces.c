/* SPDX-License-Identifier: MIT */
/* even_faces.c - see even_faces.h. */
#include "kernels/even_faces.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* Of 24 corners in three vectors. */
struct even_corners {
    lanes8i a, b, c;
};

/* What differs between a corner and the next one of its face. */
SMEAR_AVX2_INLINE lanes8 even_change(lanes8 from, lanes8 on, lanes8 within)
{
    const lanes8i turned = { 1, 2, 3, 4, 5, 6, 7, 0 };
    const __m256i next = _mm256_blend_epi32((__m256i)from, (__m256i)on, 1);
    return (from ^ (lanes8)lanes8i_permute((lanes8i)next, turned)) & within;
}

SMEAR_AVX2_INLINE lanes8 even_changes(const struct even_corners *v)
{
    const uint32_t all = UINT32_MAX;
    const lanes8 a = (lanes8)v->a, b = (lanes8)v->b, c = (lanes8)v->c;
    return even_change(a, b, (lanes8){ all, all, 0, all, all, 0, all, all })
         | even_change(b, c, (lanes8){ 0, all, all, 0, all, all, 0, all })
         | even_change(c, c, (lanes8){ all, 0, all, all, 0, all, all, 0 });
}

/* Normals of three bytes; they are read with the byte before, that of vertex 0 with the one that follows. */
SMEAR_AVX2_INLINE lanes8i even_normals(const uint8_t *normal, lanes8i vertex)
{
    const lanes8i at = vertex * 3, from = lanes8i_max(at - 1, lanes8i_all(0));
    const lanes8 word = (lanes8)_mm256_i32gather_epi32((const int *)(const void *)normal, (__m256i)from, 1);
    return (lanes8i)(lanes8_right(word, (at - from) << 3) & 0xffffffu);
}

SMEAR_AVX2_FUNCTION bool smear_even_faces_avx2(const struct even_faces *f)
{
    const lanes8i most = lanes8i_all((int32_t)f->vertices - 1);
    struct even_faces rest = *f;
    /* A gather of the only normal would reach beyond it. */
    for (; rest.triangles >= 8 && rest.vertices >= 2; rest.triangles -= 8, rest.index += 24) {
        const struct even_corners v = { lanes8i_load_halves(rest.index), lanes8i_load_halves(rest.index + 8),
                                        lanes8i_load_halves(rest.index + 16) };
        if (lanes8i_any(lanes8i_max3(v.a, v.b, v.c) > most))
            return false;
        lanes8 change = (lanes8)lanes8i_all(0);
        if (f->color != NULL) {
            const struct even_corners color = { (lanes8i)lanes8_gather(f->color, v.a), (lanes8i)lanes8_gather(f->color, v.b),
                                                (lanes8i)lanes8_gather(f->color, v.c) };
            change = even_changes(&color);
        }
        if (f->normal != NULL) {
            const struct even_corners normal = { even_normals(f->normal, v.a), even_normals(f->normal, v.b), even_normals(f->normal, v.c) };
            change |= even_changes(&normal);
        }
        if (lanes8_any(change))
            return false;
    }
    return even_faces_reference(&rest);
}
#endif
