/* SPDX-License-Identifier: MIT */
/* shade8.c - see shade8.h. */
#include "geometry/shade8.h"

#include "geometry/tiny.h"
#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* As times_lin of light.c. */
SMEAR_AVX2_INLINE lanes8 shade8_times(lanes8 a, lanes8 b) { return a * (b + (b >> 15)) >> 16; }

/* As smear_light_normal, where normals keep their length. */
SMEAR_AVX2_INLINE lanes8 shade8_cosine(const struct smear_shade8 *s, lanes8 index, lanes8i back)
{
    const lanes8i at = (lanes8i)(index * 3u), within = lanes8i_min(at, lanes8i_all((int32_t)s->last_normal));
    const __m256i bytes = _mm256_i32gather_epi32((const int *)(const void *)s->normal, (__m256i)within, 1);
    const lanes8 n = lanes8_right((lanes8)bytes, (at - within) << 3);
    lanes8i axis[3] = { (lanes8i)(n << 24) >> 24, (lanes8i)(n << 16) >> 24, (lanes8i)(n << 8) >> 24 };
    if (lanes8i_any(back))
        for (int i = 0; i < 3; i++)
            axis[i] = lanes8i_choose(back, -lanes8i_max(axis[i], lanes8i_all(-127)), axis[i]);
    const int32_t *const d = s->shading->direction;
    const lanes8i sum = axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2];
    return (lanes8)lanes8i_max(lanes8i_min(sum >> 7, lanes8i_all(65536)), lanes8i_all(0));
}

/* As light_of of light.c. */
SMEAR_AVX2_INLINE lanes8 shade8_light(const struct smear_sun *sun, int channel, lanes8 cosine)
{
    const lanes8 diffuse = cosine * (uint32_t)sun->diffuse[channel] >> 16;
    return (lanes8)lanes8i_min((lanes8i)(diffuse + (uint32_t)sun->ambient[channel]), lanes8i_all(65536));
}

/* Stores pairs of words at eight places of `to`. */
SMEAR_AVX2_INLINE void shade8_store(uint32_t *to, const uint32_t word[8], lanes8 first, lanes8 second)
{
    const __m256i low = _mm256_unpacklo_epi32((__m256i)first, (__m256i)second);
    const __m256i high = _mm256_unpackhi_epi32((__m256i)first, (__m256i)second);
    const __m128i part[4] = { _mm256_castsi256_si128(low), _mm256_castsi256_si128(high), _mm256_extracti128_si256(low, 1),
                              _mm256_extracti128_si256(high, 1) };
    for (int i = 0; i < 4; i++) {
        _mm_storel_epi64((__m128i *)(void *)(to + word[2 * i]), part[i]);
        _mm_storel_epi64((__m128i *)(void *)(to + word[2 * i + 1]), _mm_unpackhi_epi64(part[i], part[i]));
    }
}

/* Shades eight vertices, as smear_shade does, and stores their colours. */
SMEAR_AVX2_INLINE void shade8_store_colors(const struct smear_shade8 *s)
{
    const struct smear_shading *const shading = s->shading;
    const lanes8 index = lanes8_load(s->index);
    const lanes8 code = s->color != NULL ? lanes8_gather(s->color, (lanes8i)index) : lanes8_all(0);
    lanes8 cosine = lanes8_all(0), light = lanes8_all(65536), channel[4];
    if (s->normal != NULL) {
        cosine = shade8_cosine(s, index, lanes8i_load(s->back));
        light = shade8_light(shading->sun, 0, cosine);
    }
    for (int i = 0; i < 3; i++) {
        lanes8 c = lanes8_all(shading->base[i]);
        if (s->normal != NULL && !shading->sun->white)
            light = shade8_light(shading->sun, i, cosine);
        if (s->color != NULL)
            c = shade8_times(c, lanes8_decode(code >> 8 * i & 255u));
        c = c * light >> 16;
        channel[i] = shading_is_linear(shading) ? c : lanes8_encode(c >> 4) << 8;
    }
    channel[3] = lanes8_all(shading->base[3]);
    if (s->color != NULL)
        channel[3] = shade8_times(channel[3], (code >> 24) * 257u);
    shade8_store(s->colors, s->word, channel[0] | channel[1] << 16, channel[2] | channel[3] << 16);
}

SMEAR_AVX2_FUNCTION void smear_shade8_vertices(struct smear_shade8 *s)
{
    if (s->vertices == 0)
        return;
    for (uint32_t i = s->vertices; i < SHADE8_VERTICES; i++) {      /* those that are not there are the first one */
        s->index[i] = s->index[0];
        s->back[i] = s->back[0];
        s->word[i] = s->word[0];
    }
    s->vertices = 0;
    shade8_store_colors(s);
}

/* Channel i of eight colours of 16 bits, which lie in pairs. */
SMEAR_AVX2_INLINE lanes8 shade8_channel(const lanes8 pair[2], int i) { return i & 1 ? pair[i >> 1] >> 16 : pair[i >> 1] & 0xffffu; }

/* As tiny_color, at points i to i + 7. */
SMEAR_AVX2_INLINE lanes8 shade8_mixed(const struct smear_shade8 *s, uint32_t i)
{
    const lanes8 w1 = lanes8_load(s->w1 + i) >> 2, w2 = lanes8_load(s->w2 + i) >> 2;
    lanes8 pair[3][2], pixel = lanes8_all(0);
    for (int k = 0; k < 3; k++) {
        const lanes8i word = lanes8i_load(s->corner[k] + i);
        pair[k][0] = lanes8_gather(s->colors, word);
        pair[k][1] = lanes8_gather(s->colors + 1, word);
    }
    for (int c = 0; c < 3; c++) {
        const lanes8 first = shade8_channel(pair[0], c);
        const lanes8 mixed = (first << 14) + (shade8_channel(pair[1], c) - first) * w1 + (shade8_channel(pair[2], c) - first) * w2;
        pixel = pixel << 8 | (shading_is_linear(s->shading) ? lanes8_encode(mixed >> 18) : (mixed + (1u << 21)) >> 22);
    }
    return pixel;
}

SMEAR_AVX2_FUNCTION void smear_shade8_all(struct smear_shade8 *s)
{
    smear_shade8_vertices(s);
    const uint32_t n = s->points, first = s->corner[0][0];
    if (n == 0)
        return;
    for (uint32_t i = n; (i & 7u) != 0; i++) {
        s->corner[0][i] = s->corner[1][i] = s->corner[2][i] = first;
        s->w1[i] = s->w2[i] = 0;
    }
    for (uint32_t i = 0; i < n; i += 8) {
        uint32_t pixel[8];
        lanes8_store(pixel, shade8_mixed(s, i));
        for (uint32_t k = 0; k < min_u32(n - i, 8); k++)
            s->point[i + k]->color = pixel[k];
    }
    s->points = 0;
}
#endif
