/* SPDX-License-Identifier: MIT */
/* poses.c - see poses.h. */
#include "kernels/poses.h"

#if SMEAR_AVX2

#define POSES_INLINE SMEAR_AVX2_INLINE

/* Four words of each triangle. */
struct poses_words {
    __m256i word[4];
};

/* One vertex of each triangle, at the instant. */
struct poses_corner {
    __m256i x, y, depth;
};

POSES_INLINE __m256i poses_all(int32_t a) { return _mm256_set1_epi32(a); }
POSES_INLINE __m256i poses_add(__m256i a, __m256i b) { return _mm256_add_epi32(a, b); }
POSES_INLINE __m256i poses_less(__m256i a, __m256i b) { return _mm256_sub_epi32(a, b); }
POSES_INLINE __m256i poses_min(__m256i a, __m256i b) { return _mm256_min_epi32(a, b); }
POSES_INLINE __m256i poses_max(__m256i a, __m256i b) { return _mm256_max_epi32(a, b); }

POSES_INLINE __m256i poses_two(const int32_t *a, const int32_t *b)
{
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128((const __m128i *)(const void *)a)),
                                   _mm_loadu_si128((const __m128i *)(const void *)b), 1);
}

/* Turns rows of four words into columns, or back. */
POSES_INLINE struct poses_words poses_turned(__m256i a, __m256i b, __m256i c, __m256i d)
{
    const __m256i ab = _mm256_unpacklo_epi32(a, b), cd = _mm256_unpacklo_epi32(c, d);
    const __m256i ab2 = _mm256_unpackhi_epi32(a, b), cd2 = _mm256_unpackhi_epi32(c, d);
    return (struct poses_words){ { _mm256_unpacklo_epi64(ab, cd), _mm256_unpackhi_epi64(ab, cd), _mm256_unpacklo_epi64(ab2, cd2),
                                   _mm256_unpackhi_epi64(ab2, cd2) } };
}

POSES_INLINE struct poses_words poses_load(const int32_t *record, const uint16_t vertex[8][4], int i)
{
    return poses_turned(poses_two(record + vertex[0][i], record + vertex[4][i]), poses_two(record + vertex[1][i], record + vertex[5][i]),
                        poses_two(record + vertex[2][i], record + vertex[6][i]), poses_two(record + vertex[3][i], record + vertex[7][i]));
}

/* Stores four words to each triangle, `apart` words from one to the next. */
POSES_INLINE void poses_store(int32_t *out, int apart, const struct poses_words *w)
{
    const struct poses_words t = poses_turned(w->word[0], w->word[1], w->word[2], w->word[3]);
    for (int k = 0; k < 4; k++) {
        _mm_storeu_si128((__m128i *)(void *)(out + k * apart), _mm256_castsi256_si128(t.word[k]));
        _mm_storeu_si128((__m128i *)(void *)(out + (k + 4) * apart), _mm256_extracti128_si256(t.word[k], 1));
    }
}

/* Returns floor(a u / 2^32), where all of u are the same. */
POSES_INLINE __m256i poses_times(__m256i a, __m256i u)
{
    const __m256i even = _mm256_mul_epi32(a, u), odd = _mm256_mul_epi32(_mm256_srli_epi64(a, 32), u);
    return _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}

POSES_INLINE __m256i poses_read(const int32_t *p) { return _mm256_loadu_si256((const __m256i *)(const void *)p); }
POSES_INLINE void poses_write(int32_t *p, __m256i a) { _mm256_storeu_si256((__m256i *)(void *)p, a); }

/* path_coordinate, within the guard band. */
POSES_INLINE __m256i poses_coordinate(const struct poses_course *c, __m256i u, int32_t low, int32_t high)
{
    const __m256i along = poses_add(poses_read(c->slope), poses_times(poses_read(c->curvature), u));
    const __m256i way = poses_add(poses_times(_mm256_slli_epi32(along, 3), u), poses_all(128));
    return poses_max(poses_min(poses_add(poses_read(c->middle), _mm256_srai_epi32(way, 8)), poses_all(high)), poses_all(low));
}

/* path_depth, within the range of depths. */
POSES_INLINE __m256i poses_depth(const struct poses_course *c, __m256i u, const struct poses_setup *s)
{
    const __m256i along = poses_add(poses_read(c->slope), poses_times(poses_read(c->curvature), u));
    const __m256i depth = poses_add(poses_read(c->middle), _mm256_slli_epi32(poses_times(_mm256_slli_epi32(along, 2), u), 2));
    return poses_max(poses_min(depth, poses_all(s->depth_most)), poses_all(s->depth_least));
}

POSES_INLINE struct poses_corner poses_corner_at(const struct poses_setup *s, const struct poses_courses *c, int i)
{
    const __m256i u = poses_all(s->phase);
    return (struct poses_corner){ poses_coordinate(&c->of[i][0], u, s->low[0], s->high[0]),
                                  poses_coordinate(&c->of[i][1], u, s->low[1], s->high[1]), poses_depth(&c->of[i][2], u, s) };
}

/* Which turn clockwise: x1 y2 > x2 y1, in 64 bits. */
POSES_INLINE __m256i poses_facing(const struct poses_corner c[3])
{
    const __m256i x1 = poses_less(c[1].x, c[0].x), y1 = poses_less(c[1].y, c[0].y);
    const __m256i x2 = poses_less(c[2].x, c[0].x), y2 = poses_less(c[2].y, c[0].y);
    const __m256i even = _mm256_sub_epi64(_mm256_mul_epi32(x2, y1), _mm256_mul_epi32(x1, y2));
    const __m256i odd = _mm256_sub_epi64(_mm256_mul_epi32(_mm256_srli_epi64(x2, 32), _mm256_srli_epi64(y1, 32)),
                                         _mm256_mul_epi32(_mm256_srli_epi64(x1, 32), _mm256_srli_epi64(y2, 32)));
    return _mm256_srai_epi32(_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa), 31);
}

POSES_INLINE uint32_t poses_bits(__m256i mask) { return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(mask)); }
POSES_INLINE __m256i poses_pixel(__m256i a) { return _mm256_srai_epi32(poses_add(a, poses_all(127)), 8); }

/* Finds what is seen, and in which pixels. */
POSES_INLINE void poses_find_boxes(struct poses *out, const struct poses_setup *s, const struct poses_words *bounds, __m256i facing,
                                   int count)
{
    const __m256i left = poses_pixel(bounds->word[0]), top = poses_pixel(bounds->word[1]), right = poses_pixel(bounds->word[2]),
                  bottom = poses_pixel(bounds->word[3]);
    const __m256i x0 = poses_max(left, poses_all(s->x0)), y0 = poses_max(top, poses_all(s->y0)),
                  x1 = poses_min(right, poses_all(s->x1)), y1 = poses_min(bottom, poses_all(s->y1));
    __m256i seen = _mm256_and_si256(_mm256_and_si256(_mm256_cmpgt_epi32(x1, x0), _mm256_cmpgt_epi32(y1, y0)), facing);
    seen = _mm256_and_si256(seen, _mm256_cmpgt_epi32(poses_all(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)));
    const __m256i width = poses_less(right, left), height = poses_less(bottom, top);
    const __m256i large = _mm256_or_si256(_mm256_cmpgt_epi32(poses_max(width, height), poses_all(s->tiny)),
                                          _mm256_cmpgt_epi32(_mm256_mullo_epi32(width, height), poses_all(s->tiny_box)));
    out->seen = poses_bits(seen);
    out->tiny = out->seen & ~poses_bits(large);
    const __m256i none = poses_all(INT32_MAX), zero = _mm256_setzero_si256();
    const struct poses_words box = poses_turned(_mm256_blendv_epi8(none, x0, seen), _mm256_blendv_epi8(none, y0, seen),
                                                _mm256_blendv_epi8(none, poses_less(zero, x1), seen),
                                                _mm256_blendv_epi8(none, poses_less(zero, y1), seen));
    const __m256i all = poses_min(poses_min(box.word[0], box.word[1]), poses_min(box.word[2], box.word[3]));
    const __m128i least = _mm_min_epi32(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1));
    _mm_storeu_si128((__m128i *)(void *)out->box, _mm_sign_epi32(least, _mm_setr_epi32(1, 1, -1, -1)));
}

POSES_INLINE void poses_course_of(struct poses_course *out, __m256i open, __m256i middle, __m256i close)
{
    poses_write(out->middle, middle);
    poses_write(out->slope, _mm256_slli_epi32(poses_less(close, open), 6));
    poses_write(out->curvature, _mm256_slli_epi32(poses_less(poses_add(open, close), _mm256_slli_epi32(middle, 1)), 8));
}

POSES_INLINE void poses_course_of_depth(struct poses_course *out, __m256i open, __m256i middle, __m256i close)
{
    poses_write(out->middle, middle);
    poses_write(out->slope, _mm256_srai_epi32(poses_less(close, open), 3));
    poses_write(out->curvature, poses_less(_mm256_srli_epi32(poses_add(open, close), 1), middle));
}

SMEAR_AVX2_FUNCTION void smear_poses_courses_avx2(struct poses_courses *out, const struct poses_setup *s, const uint16_t vertex[8][4])
{
    for (int i = 0; i < 3; i++) {
        /* Loads of four words: the second one ends in close x, the third one begins with the depth at open. */
        const struct poses_words now = poses_load(s->vertex, vertex, i), open = poses_load(s->vertex + s->motion, vertex, i),
                                 close = poses_load(s->vertex + s->motion + 2, vertex, i);
        poses_course_of(&out->of[i][0], open.word[0], now.word[0], close.word[1]);
        poses_course_of(&out->of[i][1], open.word[1], now.word[1], close.word[2]);
        poses_course_of_depth(&out->of[i][2], open.word[2], now.word[2], close.word[3]);
        const struct poses_words more = poses_load(s->vertex + 3, vertex, i);
        for (int word = 0; word < POSES_WORDS - 3; word++)
            poses_write(out->more[i][word], more.word[word]);
    }
}

/* A triangle takes 50 instructions, where it takes 500 alone. */
SMEAR_AVX2_FUNCTION void smear_poses_avx2(struct poses *out, const struct poses_setup *s, const struct poses_courses *courses, int count)
{
    const struct poses_corner c[3] = { poses_corner_at(s, courses, 0), poses_corner_at(s, courses, 1), poses_corner_at(s, courses, 2) };
    const struct poses_words bounds = { { poses_min(c[0].x, poses_min(c[1].x, c[2].x)), poses_min(c[0].y, poses_min(c[1].y, c[2].y)),
                                          poses_max(c[0].x, poses_max(c[1].x, c[2].x)),
                                          poses_max(c[0].y, poses_max(c[1].y, c[2].y)) } };
    poses_find_boxes(out, s, &bounds, poses_facing(c), count);
    out->has_records = false;
    if (out->seen == 0)
        return;
    for (int i = 0; i < 4; i++)
        poses_write(out->bounds[i], bounds.word[i]);
    for (int i = 0; i < 3; i++) {
        poses_write(out->word[i][0], c[i].x);
        poses_write(out->word[i][1], c[i].y);
        poses_write(out->word[i][2], c[i].depth);
    }
    if (s->words <= 3)
        return;
    for (int i = 0; i < 3; i++)
        for (int word = 3; word < POSES_WORDS; word++)
            poses_write(out->word[i][word], poses_read(courses->more[i][word - 3]));
}

SMEAR_AVX2_FUNCTION void smear_poses_records_avx2(struct poses *p)
{
    for (int i = 0; i < 3; i++) {
        const struct poses_words first = { { poses_read(p->word[i][0]), poses_read(p->word[i][1]), poses_read(p->word[i][2]),
                                             poses_read(p->word[i][3]) } };
        const __m256i fourth = poses_read(p->word[i][4]), fifth = poses_read(p->word[i][5]);
        const struct poses_words more = { { fourth, fifth, fourth, fifth } };
        poses_store(p->record[0][i], 3 * POSES_RECORD, &first);
        poses_store(p->record[0][i] + 4, 3 * POSES_RECORD, &more);
    }
    p->has_records = true;
}
#endif
