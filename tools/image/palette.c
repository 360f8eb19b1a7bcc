/* SPDX-License-Identifier: MIT */
/* palette.c - colour quantisation for GIF and for textures: a variance-based median cut of the colours, refined by k-means. In integers,
 * so that the same picture gives the same colours on every host.
 *
 * Where pixels show mixtures of two entries, colours are compared in luma and two colour differences, all linear in sRGB codes, so that a
 * mixture of two colours lies on the line between them. */
#include "tools/image/palette.h"

#include <float.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXACT_SLOTS = 1024,         /* hash table for up to 257 colours */
    GIF_DISTINCT = 16384,       /* colours that a palette is chosen from */
    GIF_REFINEMENTS = 8,        /* rounds of k-means at most */
    CACHE_SLOTS = 1 << 16       /* pairs of entries found for recent colours */
};

/* ------------------------------------------------------------------ choosing */

struct swatch {
    uint32_t argb, count;
    uint64_t key;               /* what it is sorted by */
};

int color_channel(uint32_t argb, int k)
{
    return (int)(argb >> (24 - 8 * k) & 255);
}

static const int channel_weight[4] = { 6, 3, 6, 2 };

static int color_distance(uint32_t a, uint32_t b)
{
    const int alpha = color_channel(a, 0) - color_channel(b, 0), red = color_channel(a, 1) - color_channel(b, 1);
    const int green = color_channel(a, 2) - color_channel(b, 2), blue = color_channel(a, 3) - color_channel(b, 3);
    return channel_weight[0] * alpha * alpha + channel_weight[1] * red * red + channel_weight[2] * green * green
         + channel_weight[3] * blue * blue;
}

static int by_color(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

static int by_key(const void *a, const void *b)
{
    uint64_t x = ((const struct swatch *)a)->key, y = ((const struct swatch *)b)->key;
    return x < y ? -1 : x > y;
}

/* Swatches begin .. end - 1: their summed squared distance from the
 * mean along the channel where it is largest. */
struct box {
    int begin, end, channel;
    uint64_t spread;
};

static void measure_box(struct box *b, const struct swatch *swatch)
{
    b->spread = 0;
    b->channel = 1;
    for (int k = 0; k < 4; k++) {
        uint64_t n = 0, sum = 0, squares = 0;
        for (int i = b->begin; i < b->end; i++) {
            uint64_t v = (uint64_t)color_channel(swatch[i].argb, k);
            n += swatch[i].count;
            sum += v * swatch[i].count;
            squares += v * v * swatch[i].count;
        }
        uint64_t spread = (squares - sum * sum / n) * (uint64_t)channel_weight[k];
        if (spread > b->spread) {
            b->spread = spread;
            b->channel = k;
        }
    }
}

/* Cuts the box with the largest spread at its mean until there are `limit`; returns how many. */
static int cut_boxes(struct box *box, int limit, struct swatch *swatch, int count)
{
    int boxes = 1;
    box[0] = (struct box){ .begin = 0, .end = count };
    measure_box(&box[0], swatch);
    while (boxes < limit) {
        int widest = 0;
        for (int i = 1; i < boxes; i++)
            if (box[i].spread > box[widest].spread)
                widest = i;
        struct box *b = &box[widest];
        if (b->spread == 0)
            break;
        for (int i = b->begin; i < b->end; i++)
            swatch[i].key = (uint64_t)color_channel(swatch[i].argb, b->channel) << 32 | swatch[i].argb;
        qsort(swatch + b->begin, (size_t)(b->end - b->begin), sizeof *swatch, by_key);
        uint64_t n = 0, sum = 0;
        for (int i = b->begin; i < b->end; i++) {
            n += swatch[i].count;
            sum += (uint64_t)color_channel(swatch[i].argb, b->channel) * swatch[i].count;
        }
        int cut = b->begin + 1;
        while (cut < b->end - 1 && (uint64_t)color_channel(swatch[cut].argb, b->channel) * n <= sum)
            cut++;
        box[boxes] = (struct box){ .begin = cut, .end = b->end };
        b->end = cut;
        measure_box(b, swatch);
        measure_box(&box[boxes++], swatch);
    }
    return boxes;
}

int palette_nearest(uint32_t argb, const uint32_t *palette, int count)
{
    int best = 0, best_distance = INT_MAX;
    for (int i = 0; i < count; i++) {
        const int d = color_distance(argb, palette[i]);
        if (d < best_distance) {
            best = i;
            best_distance = d;
        }
    }
    return best;
}

/* Every entry becomes the mean of the swatches that are nearest to it. Returns whether any changed. */
static bool refine_palette(uint32_t *palette, int count, struct swatch *swatch, int swatches)
{
    uint64_t sum[256][5] = { { 0 } };
    bool changed = false;
    for (int i = 0; i < swatches; i++) {
        uint64_t *s = sum[palette_nearest(swatch[i].argb, palette, count)];
        for (int k = 0; k < 4; k++)
            s[k] += (uint64_t)color_channel(swatch[i].argb, k) * swatch[i].count;
        s[4] += swatch[i].count;
    }
    for (int i = 0; i < count; i++) {
        uint32_t mean = 0;
        for (int k = 0; k < 4; k++)
            mean = mean << 8 | (uint32_t)(sum[i][4] > 0 ? (sum[i][k] + sum[i][4] / 2) / sum[i][4]
                                                        : (uint64_t)color_channel(palette[i], k));
        changed = changed || mean != palette[i];
        palette[i] = mean;
    }
    return changed;
}

/* Distinct ones of sorted colours; 0 when there are more than room. */
static int list_swatches(const uint32_t *sorted, size_t count, struct swatch *out, int room)
{
    int swatches = 0;
    for (size_t i = 0; i < count; i++) {
        if (swatches > 0 && out[swatches - 1].argb == sorted[i]) {
            out[swatches - 1].count++;
            continue;
        }
        if (swatches == room)
            return 0;
        out[swatches++] = (struct swatch){ .argb = sorted[i], .count = 1 };
    }
    return swatches;
}

int palette_of(uint32_t *argb, size_t count, int limit, int distinct, int refinements, uint32_t palette[256])
{
    struct swatch *swatch = malloc((size_t)distinct * sizeof *swatch);
    struct box box[256];
    int swatches = 0, boxes = 0;
    if (swatch == NULL)
        return 0;
    for (int dropped = 0; swatches == 0; dropped++) {      /* bits of each colour, in whose middle it goes on; alpha stays */
        for (size_t i = 0; i < count; i++)
            argb[i] = (argb[i] & (0xff000000u | 0x010101u * (255u << dropped & 255u))) | 0x010101u * ((1u << dropped) >> 1);
        qsort(argb, count, sizeof *argb, by_color);
        swatches = list_swatches(argb, count, swatch, distinct);
    }
    if (swatches <= limit) {
        for (; boxes < swatches; boxes++)
            palette[boxes] = swatch[boxes].argb;
    } else {
        boxes = cut_boxes(box, limit, swatch, swatches);
        for (int i = 0; i < boxes; i++)
            palette[i] = swatch[(box[i].begin + box[i].end) / 2].argb;
        for (int i = 0; i < refinements && refine_palette(palette, boxes, swatch, swatches); i++)
            ;
        qsort(palette, (size_t)boxes, sizeof *palette, by_color);
    }
    free(swatch);
    return boxes;
}

/* ------------------------------------------------------------------ marked pictures */

static size_t pixel_count(const struct marked_image *from)
{
    return (size_t)from->image->width * (size_t)from->image->height;
}

bool palette_exact(const struct marked_image *from, int limit, struct palette *out)
{
    uint32_t slot[EXACT_SLOTS];                 /* colour + 1; 0: free */
    const uint8_t *p = from->image->rgba;
    uint32_t last = UINT32_MAX;
    memset(slot, 0, sizeof slot);
    memset(out, 0, sizeof *out);
    for (size_t i = 0, n = pixel_count(from); i < n; i++, p += 4) {
        uint32_t color = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
        if ((from->mark != NULL && !from->mark[i]) || color == last)
            continue;
        last = color;
        uint32_t at = color * 2654435761u >> 22;
        while (slot[at] != 0 && slot[at] != color + 1)
            at = (at + 1) % EXACT_SLOTS;
        if (slot[at] != 0)
            continue;
        if (out->count == limit)
            return false;
        slot[at] = color + 1;
        memcpy(out->rgb[out->count++], p, 3);
    }
    return true;
}

bool palette_choose(const struct marked_image *from, int limit, struct palette *out)
{
    const size_t n = pixel_count(from);
    uint32_t *argb = malloc(n * sizeof *argb), chosen[256];
    size_t count = 0;
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < n && argb != NULL; i++)
        if (from->mark[i])
            argb[count++] = color_of(from->image->rgba + 4 * i) | 0xff000000u;
    if (count > 0)
        out->count = palette_of(argb, count, limit, GIF_DISTINCT, GIF_REFINEMENTS, chosen);
    for (int i = 0; i < out->count; i++)
        for (int k = 0; k < 3; k++)
            out->rgb[i][k] = (uint8_t)color_channel(chosen[i], k + 1);
    const bool ok = argb != NULL && (count == 0 || out->count > 0);
    free(argb);
    return ok;
}

/* ------------------------------------------------------------------ mapping */

static const float CHROMA_WEIGHT = 0.6f;        /* of colour differences against luma */
static const float NOISE_WEIGHT = 0.15f;        /* of dots against error of their mean */

/* Luma, weighted blue and red differences of a colour. */
struct center {
    float v[3];
};

static struct center to_center(const uint8_t rgb[3])
{
    const float r = rgb[0], g = rgb[1], b = rgb[2], y = 0.299f * r + 0.587f * g + 0.114f * b;
    return (struct center){{y, CHROMA_WEIGHT * (b - y), CHROMA_WEIGHT * (r - y)}};
}

static float square_distance(const float a[3], const float b[3])
{
    float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

static int nearest_center(const float v[3], const struct center *center, int count, float *distance)
{
    int best = 0;
    *distance = FLT_MAX;
    for (int i = 0; i < count; i++) {
        float d = square_distance(v, center[i].v);
        if (d < *distance) {
            *distance = d;
            best = i;
        }
    }
    return best;
}

/* Two entries, the darker one first, and of 64 dots how many show the brighter one. */
struct mixture {
    uint32_t color;             /* that it stands for, + 1; 0: slot is free */
    uint8_t dark, bright, bright_dots;
};

/* Thresholds 0..63 of ordered dither (Bayer 1973). */
static const uint8_t pattern[8][8] = {
    {0, 32, 8, 40, 2, 34, 10, 42}, {48, 16, 56, 24, 50, 18, 58, 26},
    {12, 44, 4, 36, 14, 46, 6, 38}, {60, 28, 52, 20, 62, 30, 54, 22},
    {3, 35, 11, 43, 1, 33, 9, 41}, {51, 19, 59, 27, 49, 17, 57, 25},
    {15, 47, 7, 39, 13, 45, 5, 37}, {63, 31, 55, 23, 61, 29, 53, 21},
};

/* The nearest entry n and the partner p that minimise
 *     |c - ((1 - t) n + t p)|^2 + q t (1 - t) |p - n|^2,
 * error of the mean plus q times the variance of the dots. With e = c - n and d = p - n the best
 * share is t = (e.d / d.d - q/2) / (1 - q), and it gains (2 e.d - q d.d)^2 / (4 (1 - q) d.d). */
static struct mixture find_mixture(const float v[3], const struct center *center, int count)
{
    float distance;
    int nearest = nearest_center(v, center, count, &distance), partner = nearest;
    float best_gain = 0, share = 0;
    const float *n = center[nearest].v;
    float e[3] = {v[0] - n[0], v[1] - n[1], v[2] - n[2]};
    for (int i = 0; i < count; i++) {
        float d[3] = {center[i].v[0] - n[0], center[i].v[1] - n[1], center[i].v[2] - n[2]};
        float dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        float ed = e[0] * d[0] + e[1] * d[1] + e[2] * d[2];
        float excess = 2 * ed - NOISE_WEIGHT * dd;
        if (excess > 0 && excess * excess > best_gain * dd) {
            best_gain = excess * excess / dd;
            partner = i;
            share = excess / (2 * (1 - NOISE_WEIGHT) * dd);
        }
    }
    unsigned dots = (unsigned)(share * 64 + 0.5f);
    dots = dots > 64 ? 64 : dots;
    uint8_t entry = (uint8_t)nearest, other = (uint8_t)partner;
    /* Always counting the brighter entry keeps the pattern when nearest and partner change places. */
    if (center[partner].v[0] > n[0])
        return (struct mixture){0, entry, other, (uint8_t)dots};
    return (struct mixture){0, other, entry, (uint8_t)(64 - dots)};
}

bool palette_map(const struct marked_image *from, const struct palette *palette, uint8_t *index)
{
    struct mixture *cache = calloc(CACHE_SLOTS, sizeof *cache);
    struct center center[256] = {{{0}}};
    if (cache == NULL)
        return false;
    for (int i = 0; i < palette->count; i++)
        center[i] = to_center(palette->rgb[i]);
    const uint8_t *p = from->image->rgba;
    size_t i = 0;
    for (int y = 0; y < from->image->height; y++) {
        for (int x = 0; x < from->image->width; x++, i++, p += 4) {
            if (!from->mark[i])
                continue;
            uint32_t color = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
            struct mixture *m = &cache[color * 2654435761u >> 16];
            if (m->color != color + 1) {
                *m = find_mixture(to_center(p).v, center, palette->count);
                m->color = color + 1;
            }
            index[i] = pattern[y & 7][x & 7] < m->bright_dots ? m->bright : m->dark;
        }
    }
    free(cache);
    return true;
}
