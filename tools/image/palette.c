/* SPDX-License-Identifier: MIT */
/* palette.c - colour quantisation for GIF.
 *
 * Colours are compared in luma and two colour differences, all linear in sRGB codes, so that a
 * mixture of two colours lies on the line between them. The palette is a variance-based median cut
 * of the frame's histogram, refined by k-means. */
#include "tools/image/palette.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXACT_SLOTS = 1024,         /* hash table for up to 257 colours */
    MAX_POINTS = 16384,         /* of the histogram that the palette is chosen from */
    CELLS = 32768,              /* hash table of the histogram */
    REFINEMENTS = 8,            /* rounds of k-means at most */
    CACHE_SLOTS = 1 << 16       /* pairs of entries found for recent colours */
};

static const float CHROMA_WEIGHT = 0.6f;        /* of colour differences against luma */
static const float POPULATION_POWER = 0.85f;     /* below 1: more for rare colours */
static const float NOISE_WEIGHT = 0.15f;        /* of dots against error of their mean */

struct point {
    float v[3];                 /* luma, weighted blue and red differences */
    float weight;
};

/* A colour of the palette in the making. */
struct center {
    float v[3];
};

static struct point to_point(float r, float g, float b)
{
    float y = 0.299f * r + 0.587f * g + 0.114f * b;
    return (struct point){{y, CHROMA_WEIGHT * (b - y), CHROMA_WEIGHT * (r - y)}, 0};
}

static void to_rgb(const float v[3], uint8_t rgb[3])
{
    float b = v[0] + v[1] / CHROMA_WEIGHT, r = v[0] + v[2] / CHROMA_WEIGHT;
    float g = (v[0] - 0.299f * r - 0.114f * b) / 0.587f;
    float channel[3] = {r, g, b};
    for (int k = 0; k < 3; k++)
        rgb[k] = (uint8_t)(channel[k] <= 0 ? 0 : channel[k] >= 255 ? 255 : channel[k] + 0.5f);
}

static size_t pixel_count(const struct marked_image *from)
{
    return (size_t)from->image->width * (size_t)from->image->height;
}

/* --- exact --- */

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

/* --- choosing --- */

/* Pixels whose colours agree in the upper bits. */
struct cell {
    uint32_t key;               /* those bits + 1; 0: free */
    uint32_t count;
    uint64_t sum[3];
};

/* The pixels as points of mean colour, after dropping the low `shift` bits of each channel; returns
 * how many, or 0 when there are more than MAX_POINTS or no pixels. */
static int histogram(const struct marked_image *from, unsigned shift, struct cell *cells,
                     struct point *points)
{
    int used = 0, count = 0;
    const uint8_t *p = from->image->rgba;
    memset(cells, 0, CELLS * sizeof *cells);
    for (size_t i = 0, n = pixel_count(from); i < n; i++, p += 4) {
        if (!from->mark[i])
            continue;
        uint32_t key = (uint32_t)(p[0] >> shift) << 16 | (uint32_t)(p[1] >> shift) << 8 |
                       (uint32_t)(p[2] >> shift);
        uint32_t at = key * 2654435761u >> 17;
        while (cells[at].key != 0 && cells[at].key != key + 1)
            at = (at + 1) % CELLS;
        struct cell *c = cells + at;
        if (c->key == 0 && ++used > MAX_POINTS)
            return 0;
        c->key = key + 1;
        c->count++;
        for (int k = 0; k < 3; k++)
            c->sum[k] += p[k];
    }
    for (size_t i = 0; i < CELLS; i++) {
        const struct cell *c = cells + i;
        if (c->key == 0)
            continue;
        float n = (float)c->count;
        points[count] = to_point((float)c->sum[0] / n, (float)c->sum[1] / n, (float)c->sum[2] / n);
        points[count++].weight = powf(n, POPULATION_POWER);
    }
    return count;
}

/* Points begin .. end - 1; their summed squared distance from the mean, and the axis it is largest
 * on. */
struct box {
    int begin, end, axis;
    float mean[3];
    double spread;
};

static void measure_box(struct box *b, const struct point *points)
{
    double weight = 0, sum[3] = {0}, squares[3] = {0};
    for (int i = b->begin; i < b->end; i++) {
        double w = points[i].weight;
        weight += w;
        for (int k = 0; k < 3; k++) {
            sum[k] += w * points[i].v[k];
            squares[k] += w * points[i].v[k] * points[i].v[k];
        }
    }
    double largest = -1;
    b->spread = 0;
    for (int k = 0; k < 3; k++) {
        double spread = squares[k] - sum[k] * sum[k] / weight;
        b->mean[k] = (float)(sum[k] / weight);
        b->spread += spread;
        if (spread > largest) {
            largest = spread;
            b->axis = k;
        }
    }
    if (b->end - b->begin < 2)
        b->spread = 0;
}

/* Points below the mean of the longest axis to the front; the first of the others. */
static int split_box(const struct box *b, struct point *points)
{
    int low = b->begin, high = b->end;
    while (low < high) {
        if (points[low].v[b->axis] < b->mean[b->axis]) {
            low++;
        } else {
            struct point swap = points[low];
            points[low] = points[--high];
            points[high] = swap;
        }
    }
    return low;
}

/* Splits the box of the largest spread until there are `limit` of them; returns how many there are. */
static int median_cut(struct point *points, int count, int limit, struct center *center)
{
    struct box box[256];
    int boxes = 1;
    box[0] = (struct box){.begin = 0, .end = count};
    measure_box(&box[0], points);
    while (boxes < limit) {
        int widest = 0;
        for (int i = 1; i < boxes; i++)
            if (box[i].spread > box[widest].spread)
                widest = i;
        struct box *b = &box[widest];
        int middle = b->spread > 0 ? split_box(b, points) : b->begin;
        if (middle == b->begin || middle == b->end) {
            if (b->spread <= 0)
                break;
            b->spread = 0;              /* all points equal but for rounding */
            continue;
        }
        box[boxes] = (struct box){.begin = middle, .end = b->end};
        b->end = middle;
        measure_box(b, points);
        measure_box(&box[boxes++], points);
    }
    for (int i = 0; i < boxes; i++)
        memcpy(center[i].v, box[i].mean, sizeof box[i].mean);
    return boxes;
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

/* One round of k-means; returns the weighted error before it. A center that serves no point moves
 * to the point that is served worst. */
static double refine(const struct point *points, int count, struct center *center, int centers)
{
    double sum[256][4] = {{0}}, error = 0;
    float worst = -1;
    int worst_point = 0;
    for (int i = 0; i < count; i++) {
        float distance;
        int c = nearest_center(points[i].v, center, centers, &distance);
        float w = points[i].weight;
        error += (double)(w * distance);
        if (w * distance > worst) {
            worst = w * distance;
            worst_point = i;
        }
        for (int k = 0; k < 3; k++)
            sum[c][k] += (double)(w * points[i].v[k]);
        sum[c][3] += (double)w;
    }
    for (int c = 0; c < centers; c++) {
        bool used = sum[c][3] > 0;
        for (int k = 0; k < 3; k++)
            center[c].v[k] = used ? (float)(sum[c][k] / sum[c][3]) : points[worst_point].v[k];
    }
    return error;
}

bool palette_choose(const struct marked_image *from, int limit, struct palette *out)
{
    struct cell *cells = malloc(CELLS * sizeof *cells);
    struct point *points = malloc(MAX_POINTS * sizeof *points);
    memset(out, 0, sizeof *out);
    if (cells == NULL || points == NULL) {
        free(cells);
        free(points);
        return false;
    }
    int count = 0;
    for (unsigned shift = 0; shift <= 4 && count == 0; shift++)     /* 4: never above MAX_POINTS */
        count = histogram(from, shift, cells, points);
    if (count > 0) {
        struct center center[256] = {{{0}}};
        int centers = median_cut(points, count, limit, center);
        double last = DBL_MAX;
        for (int round = 0; round < REFINEMENTS; round++) {
            double error = refine(points, count, center, centers);
            if (error > last * 0.995)
                break;
            last = error;
        }
        out->count = centers;
        for (int i = 0; i < centers; i++)
            to_rgb(center[i].v, out->rgb[i]);
    }
    free(cells);
    free(points);
    return true;
}

/* --- mapping --- */

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
    for (int i = 0; i < palette->count; i++) {
        const uint8_t *rgb = palette->rgb[i];
        memcpy(center[i].v, to_point(rgb[0], rgb[1], rgb[2]).v, sizeof center[i].v);
    }
    const uint8_t *p = from->image->rgba;
    size_t i = 0;
    for (int y = 0; y < from->image->height; y++) {
        for (int x = 0; x < from->image->width; x++, i++, p += 4) {
            if (!from->mark[i])
                continue;
            uint32_t color = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
            struct mixture *m = &cache[color * 2654435761u >> 16];
            if (m->color != color + 1) {
                *m = find_mixture(to_point(p[0], p[1], p[2]).v, center, palette->count);
                m->color = color + 1;
            }
            index[i] = pattern[y & 7][x & 7] < m->bright_dots ? m->bright : m->dark;
        }
    }
    free(cache);
    return true;
}
