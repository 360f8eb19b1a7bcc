/* SPDX-License-Identifier: MIT */
/* subframe_gap.c - means of some tiles' sums: the comb of instants is closed.
 *
 * A sum of N instants is a comb of N teeth where the truth is a box. Where all moving triangles go alike, a tooth is as
 * far from the next at all pixels, and the sum's own mean over that distance closes the comb: shifted in space is shifted
 * in time. Only what moves is meant: the background lies beneath, with the weight of the instants that are left. */
#include "temporal/subframe_gap.h"

#include "base/fixmath.h"
#include "kernels/gap_means.h"
#include "temporal/subframe_background.h"

/* Instants of light, 16 bits each, whose mean a word per channel allows: wide_mean_of. */
enum { WIDE_INSTANTS_MAX = 2048 };

/* A tile's gap, centred on a pixel: weights in `unit` of a pixel, of which the ends get what is left. Taps are in
 * pairs, which count only together: where one lies outside the tiles the gap is closed by less, but nothing is
 * shifted. */
struct gap {
    int32_t pairs;
    int8_t x[GAP_PAIRS_MAX], y[GAP_PAIRS_MAX];
    int32_t offset[GAP_PAIRS_MAX];              /* the same in the planes */
    uint32_t unit, last;                        /* weights: of the pixel and all pairs (1 .. 16, a power of two), but
                                                 * the last pair's */
    int unit_log2;
    uint32_t weight[GAP_PAIRS_MAX + 1];         /* of all taps at all instants, by pairs that count */
    struct packed_mean mean[GAP_PAIRS_MAX + 1]; /* made where they are needed: n is 0 before */
};

/* ------------------------------------------------------------------ gap */

/* times part / over to nearest; no division where that is plain. */
static int32_t nearest_pixel(int32_t part, int32_t over, int32_t times)
{
    if (part == 0 || part == over)
        return part == 0 ? 0 : times;
    if (part == -over)
        return -times;
    const int32_t numerator = part * times;
    return (2 * numerator + (numerator < 0 ? -over : over)) / (2 * over);
}

static SMEAR_NOINLINE void gap_make(struct gap *gap, const struct subframes *f, const struct smear_step *step)
{
    const int32_t x = step->x, y = step->y;     /* 1/16 px */
    const uint32_t length = (uint32_t)min_i32(max_i32(abs_i32(x), abs_i32(y)), 16 * (2 * GAP_PAIRS_MAX + 1));
    const uint32_t most = is_packed(f) ? (uint32_t)PACKED_INSTANTS_MAX : (uint32_t)WIDE_INSTANTS_MAX;
    uint32_t whole;
    for (gap->unit = 16;; gap->unit >>= 1) {
        /* what is left is the same on both sides */
        whole = max_u32((length * gap->unit + 16) >> 5 << 1, gap->unit);
        if (gap->unit == 1)
            whole |= 1u;
        if (gap->unit == 1 || whole * f->instants <= most)
            break;
    }
    if (is_packed(f) && whole * f->instants > PACKED_INSTANTS_MAX)
        whole = gap->unit;
    const uint32_t side = (whole - gap->unit) >> 1;
    gap->pairs = (int32_t)((side + gap->unit - 1) / gap->unit);
    gap->last = side - (uint32_t)(gap->pairs - 1) * gap->unit;
    for (int32_t i = 0; i < gap->pairs; i++) {
        gap->x[i] = (int8_t)nearest_pixel(x, (int32_t)length, i + 1);
        gap->y[i] = (int8_t)nearest_pixel(y, (int32_t)length, i + 1);
        gap->offset[i] = gap->y[i] * f->t->pitch + gap->x[i];
    }
    if (gap->pairs == 0)
        gap->unit = f->instants == 1 ? 2 : 1;
    gap->unit_log2 = 31 - count_leading_zeros(gap->unit);
    for (int32_t pairs = 0; pairs <= gap->pairs; pairs++) {
        gap->weight[pairs] = f->instants
                           * (pairs == gap->pairs && pairs != 0 ? whole
                                                                : gap->unit * (2 * (uint32_t)pairs + 1));
        gap->mean[pairs].n = 0;
    }
}

/* Pairs of which both lie within `near` of a pixel. */
static inline int32_t pairs_within(int32_t pairs, const int8_t *offset, int32_t near)
{
    while (pairs > 0 && abs_i32(offset[pairs - 1]) > near)
        pairs--;
    return pairs;
}

/* Pixels of a row from index `at` on, all with the same pairs. */
struct stretch {
    int32_t at, n, pairs;
};

static inline uint32_t pair_weight(const struct gap *gap, int32_t i)
{
    return i + 1 == gap->pairs ? gap->last : gap->unit;
}

/* ------------------------------------------------------------------ a word per channel */

/* Divides by n to nearest: (sum + n / 2) times 2^(27 + log) / n, rounded up. Exact for sums below 2^27. */
struct wide_mean {
    uint32_t n, half, factor;
    int shift;
};

static struct wide_mean wide_mean_make(uint32_t n)
{
    int log = n > 1 ? 32 - count_leading_zeros(n - 1) : 0;
    uint32_t whole = (1u << 27) / n, rest = (1u << 27) % n;     /* rest 2^log < 2^20 */
    uint32_t factor = (whole << log) + ((rest << log) + n - 1) / n;
    return (struct wide_mean){ n, n >> 1, factor << 4, log + 4 };
}

static inline uint32_t wide_mean_of(const struct wide_mean *m, uint32_t sum)
{
    return mulh_u32((sum + m->half) << 5, m->factor) >> m->shift;
}

/* The background hides whatever moves there. */
static inline bool stays_hidden(const struct subframes *f, int32_t at)
{
    return f->work.depth[at] > f->nearest && f->times[at] == 0;
}

/* The pixels whose sums a gap's taps count, in pairs, as smear_gap_means says. Where moving triangles are hidden is not
 * where they are not: there they go on as at the pixel. Where the pixel itself hides some, others do not spread over
 * it. */
static void find_taps(int32_t *tap, const struct subframes *f, int32_t at, const struct gap *gap,
                      int32_t pairs)
{
    const uint32_t depth = f->work.depth[at], times = f->times[at];
    bool hides = depth > f->nearest;
    for (int32_t i = 0; i < 2 * pairs; i++) {
        const int32_t p = i & 1 ? at + gap->offset[i >> 1] : at - gap->offset[i >> 1];
        const uint32_t depth_there = f->work.depth[p];
        tap[i] = p;
        if (depth_there > depth && (depth_there > f->nearest || f->times[p] + 1 < times))
            tap[i] = at;
        else if (depth_there < depth && times + 1 < f->times[p])
            hides = true;
    }
    for (int32_t i = 0; hides && i < 2 * pairs; i++)
        tap[i] = at;
}

/* The sum of a plane over the gap at pixel `at`. `tap`: the pixels its taps count; null: nothing hides what moves. */
static inline uint32_t gap_sum(const uint32_t *sum, int32_t at, const struct gap *gap, int32_t pairs,
                               const int32_t *tap)
{
    uint32_t all = sum[at] * gap->unit;
    for (int32_t i = 0; i < pairs; i++)
        all += (tap != NULL ? sum[tap[2 * i]] + sum[tap[2 * i + 1]]
                            : sum[at - gap->offset[i]] + sum[at + gap->offset[i]])
             * pair_weight(gap, i);
    return all;
}

static SMEAR_RARE void average_wide(const struct subframes *f, const struct stretch *s, const struct gap *gap,
                                    enum gap_cover cover)
{
    const struct wide_mean m = wide_mean_make(gap->weight[s->pairs]);
    const bool linear = frame_is_linear(f->t->frame);
    int32_t tap[2 * GAP_PAIRS_MAX];
    const int32_t *taps = cover != COVER_NONE ? tap : NULL;
    for (int32_t at = s->at; at < s->at + s->n; at++) {
        if (cover != COVER_NONE) {
            if (stays_hidden(f, at))
                continue;
            find_taps(tap, f, at, gap, s->pairs);
        }
        uint32_t mean[3], *out = &f->work.color[at], times = gap_sum(f->times, at, gap, s->pairs, taps);
        if (times == 0)
            continue;
        for (int i = 0; i < 3; i++)
            mean[i] = wide_mean_of(&m, gap_sum(f->sum[i], at, gap, s->pairs, taps)
                                           + light_of_code(*out >> (16 - 8 * i) & 0xffu, linear) * (m.n - times));
        *out = linear ? pixel_make(0, smear_srgb_encode[mean[0] >> 4], smear_srgb_encode[mean[1] >> 4],
                                   smear_srgb_encode[mean[2] >> 4])
                      : pixel_make(0, mean[0], mean[1], mean[2]);
    }
}

/* ------------------------------------------------------------------ tiles */

static enum gap_cover cover_of(const struct subframes *f, const struct subframe_box *b)
{
    if (f->highest == f->lowest)
        return COVER_NONE;
    if (f->highest <= f->nearest)
        return COVER_FEW;
    return smear_subframe_depths(f, b, GAP_PAIRS_MAX).most > f->nearest ? COVER_ALL : COVER_FEW;
}

static void average_packed(const struct gap_planes *planes, const struct stretch *s, struct gap *gap,
                           enum gap_cover cover)
{
    struct packed_mean *mean = &gap->mean[s->pairs];
    if (mean->n == 0)
        *mean = smear_packed_mean(gap->weight[s->pairs]);
    const struct gap_taps taps = {
        gap->offset, s->pairs, gap->unit_log2, pair_weight(gap, s->pairs - 1), mean
    };
    smear_gap_means(planes, s->at, s->n, &taps, cover);
}

/* Averages a box, which lies in one tile: rows, cut where fewer pairs count. */
static void average_tile(const struct subframes *f, const struct subframe_box *b, struct gap *gap)
{
    const struct smear_raster_target *s = &f->t->background;
    const enum gap_cover cover = cover_of(f, b);
    const struct gap_planes planes = { f->work.color, f->work.depth, f->sums, f->nearest };
    for (int32_t y = b->y0; y < b->y1; y++) {
        const int32_t row_pairs = pairs_within(gap->pairs, gap->y, min_i32(y - s->y0, s->y1 - 1 - y));
        const int32_t reach = row_pairs > 0 ? abs_i32(gap->x[row_pairs - 1]) : 0;
        struct stretch stretch = { work_row(f, b, y), 0, 0 };
        for (int32_t x = b->x0; x < b->x1; x += stretch.n, stretch.at += stretch.n) {
            const int32_t near = min_i32(x - s->x0, s->x1 - 1 - x);
            stretch.n = near < reach ? 1 : min_i32(b->x1, s->x1 - reach) - x;
            stretch.pairs = pairs_within(row_pairs, gap->x, near);
            if (is_packed(f))
                average_packed(&planes, &stretch, gap, cover);
            else
                average_wide(f, &stretch, gap, cover);
        }
    }
}

void smear_subframe_average(const struct subframes *f, const struct subframe_box *all, const struct smear_step *step)
{
    static const struct smear_step none = { 0, 0 };
    const struct smear_tile_run *t = f->t;
    const struct smear_raster_target *s = &t->background;
    for (int32_t x = t->x0; x < t->x1; x += t->tile) {
        struct gap gap;
        gap_make(&gap, f, step != NULL && !f->blends ? &step[(x - t->x0) / t->tile] : &none);
        const int32_t wide = gap.pairs;
        const struct subframe_box b = { max_i32(x, all->x0 - wide), max_i32(s->y0, all->y0 - wide),
                                        min_i32(min_i32(x + t->tile, t->x1), all->x1 + wide),
                                        min_i32(s->y1, all->y1 + wide) };
        if (!subframe_box_is_empty(&b))
            average_tile(f, &b, &gap);
    }
}
