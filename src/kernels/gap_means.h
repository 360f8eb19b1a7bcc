/* SPDX-License-Identifier: MIT */
/* gap_means.h - packed sums over the gap between one instant and the next, and their means. */
#ifndef SMEAR_KERNELS_GAP_MEANS_H
#define SMEAR_KERNELS_GAP_MEANS_H

#include "kernels/packed_sums.h"
#include "kernels/vector.h"

/* A sum of N instants is a comb of N teeth where the truth is a box. What moves alike leaves the same gap from tooth to
 * tooth at all pixels: the sum's own mean over that gap, centred on each pixel, closes the comb. */

enum { GAP_PAIRS_MAX = 8 };

/* Planes that share their indices. */
struct gap_planes {
    uint32_t *color;            /* the background, and then the means */
    const uint16_t *depth;      /* depth codes of the background: larger is nearer */
    struct packed_sums sums;    /* of what moves before it */
    uint32_t nearest;           /* no depth code of what moves is larger */
};

/* What is known of the background at n pixels and at their taps. */
enum gap_cover {
    COVER_NONE,         /* its depth codes are all alike, and none is larger than `nearest` */
    COVER_FEW,          /* none is larger than `nearest` */
    COVER_ALL           /* nothing: it may hide what moves */
};

/* Pairs of taps, one before and one after a pixel. A tap counts what is there, but
 *   - as the pixel itself where the background there is nearer than at the pixel and hides what moves: beyond
 *     `nearest`, or with two instants less than the pixel has, as what is at a pixel at n instants is half a gap away,
 *     or less, at n - 1 of them;
 *   - all taps as the pixel itself where the background at the pixel hides what moves: beyond `nearest`, or nearer than
 *     at a tap that has two instants more;
 * unless all taps together, as they are, have all instants: then nothing hides what moves. */
struct gap_pairs {
    const int32_t *offset;      /* of each pair, in indices */
    int32_t pairs;              /* 0 .. GAP_PAIRS_MAX */
    uint32_t instant;           /* what one instant adds, at most, to the upper half of gn: two add more */
};

/* Returns the sum that the tap `there` of pixel `at` counts; sets *hides where the background at the pixel hides what
 * moves. */
static inline struct packed_sum gap_tap(const struct gap_planes *p, int32_t at, int32_t there, uint32_t instant,
                                        bool *hides)
{
    const struct packed_sum here = packed_sum_at(&p->sums, at), sum = packed_sum_at(&p->sums, there);
    const uint32_t depth = p->depth[at], depth_there = p->depth[there], times = here.gn >> 16;
    if (depth_there > depth && (depth_there > p->nearest || (sum.gn >> 16) + instant < times))
        return here;
    if (depth_there < depth && times + instant < sum.gn >> 16)
        *hides = true;
    return sum;
}

/* ------------------------------------------------------------------ four pixels at once */

#if SMEAR_VECTORS
/* Whether the background is beyond `nearest` at one of four pixels or at their taps. */
static inline bool gap_is_hidden4(const struct gap_planes *p, int32_t at, const struct gap_pairs *taps)
{
    const uint16_t *depth = p->depth + at;
    const smear_v8i sign = v8i_all(INT16_MIN), limit = v8i_all((int16_t)(p->nearest ^ 0x8000u));
    smear_v8i most = v4_of_8i_load(depth) ^ sign;      /* in the order of signed numbers */
    for (int32_t i = 0; i < taps->pairs; i++)
        most = v8i_max(most, v8i_max(v4_of_8i_load(depth - taps->offset[i]) ^ sign,
                                     v4_of_8i_load(depth + taps->offset[i]) ^ sign));
    return v4u_any((smear_v4u)(v8i_max(most, limit) ^ limit));
}

/* Whether what moves is seen at four pixels or at their taps at two instants more than elsewhere. */
static inline bool gap_is_uneven4(const uint32_t *gn, const struct gap_pairs *taps)
{
    const smear_v8i sign = v8i_all(INT16_MIN);
    smear_v8i least = (smear_v8i)v4u_load(gn) ^ sign, most = least;
    for (int32_t i = 0; i < taps->pairs; i++) {
        const smear_v8i a = (smear_v8i)v4u_load(gn - taps->offset[i]) ^ sign,
                        b = (smear_v8i)v4u_load(gn + taps->offset[i]) ^ sign;
        least = v8i_min(least, v8i_min(a, b));
        most = v8i_max(most, v8i_max(a, b));
    }
    const smear_v4i low = (smear_v4i)((smear_v4u)(least ^ sign) >> 16), high = (smear_v4i)((smear_v4u)(most ^ sign) >> 16);
    return v4u_any((smear_v4u)(high - low > v4i_all((int32_t)taps->instant)));
}

/* Whether the background may hide what moves at four pixels or at their taps. `times`: how often all taps together show it,
 * weighted, of `full`: where that is always, nothing hides it. Else no depth matters where it is seen evenly and nothing
 * is beyond `nearest`. */
static inline bool gap_may_hide4(const struct gap_planes *p, int32_t at, const struct gap_pairs *taps, smear_v4u times,
                                 uint32_t full, enum gap_cover cover)
{
    return v4u_any(times ^ v4u_all(full))
        && ((cover == COVER_ALL && gap_is_hidden4(p, at, taps)) || gap_is_uneven4(p->sums.gn + at, taps));
}

/* Sums of four pixels, or of a tap of each. */
struct gap_sums4 {
    smear_v4u rb, gn;
};

/* Four pixels: their own sums, and which of them have found that the background hides what moves. */
struct gap_pixels4 {
    struct gap_sums4 own;
    smear_v4i depth, times, nearest, instant;
    smear_v4i hides;
};

/* Returns the sums of pixels whose taps, as they are, have all instants, and what was found for others. */
static inline struct gap_sums4 gap_choose4(struct gap_sums4 there, uint32_t full, struct gap_sums4 found)
{
    const smear_v4i is_full = (smear_v4i)(there.gn >> 16 == v4u_all(full));
    return (struct gap_sums4){ v4u_choose(is_full, there.rb, found.rb), v4u_choose(is_full, there.gn, found.gn) };
}

static inline struct gap_pixels4 gap_pixels4_at(const struct gap_planes *p, int32_t at, uint32_t instant)
{
    const smear_v4i zero = { 0, 0, 0, 0 };
    struct gap_pixels4 c = { .own = { v4u_load(p->sums.rb + at), v4u_load(p->sums.gn + at) },
                             .depth = v4i_of_u16(p->depth + at), .nearest = zero + (int32_t)p->nearest,
                             .instant = zero + (int32_t)instant };
    c.times = (smear_v4i)(c.own.gn >> 16);
    c.hides = (smear_v4i)(c.depth > c.nearest);
    return c;
}

static inline struct gap_sums4 gap_tap4(struct gap_pixels4 *c, const struct gap_planes *p, int32_t at)
{
    const struct gap_sums4 there = { v4u_load(p->sums.rb + at), v4u_load(p->sums.gn + at) };
    const smear_v4i depth = v4i_of_u16(p->depth + at), times = (smear_v4i)(there.gn >> 16);
    const smear_v4i covers = (smear_v4i)(depth > c->depth)
                           & ((smear_v4i)(depth > c->nearest) | (smear_v4i)(c->times > times + c->instant));
    c->hides |= (smear_v4i)(c->depth > depth) & (smear_v4i)(times > c->times + c->instant);
    return (struct gap_sums4){ v4u_choose(covers, c->own.rb, there.rb), v4u_choose(covers, c->own.gn, there.gn) };
}
#endif

/* ------------------------------------------------------------------ eight pixels at once */

/* A gap's taps and their weights: the pixel and all pairs but the last have 2^unit_log2. */
struct gap_taps {
    struct gap_pairs at;        /* an instant adds 1 */
    int unit_log2;
    uint32_t last;              /* of the last pair, 0 .. 2^unit_log2 */
    const struct packed_mean *mean;     /* of the instants, as often as all taps weigh together */
};

/* Rows are taken together where it is not size that counts. */
#ifdef __OPTIMIZE_SIZE__
#define GAP_ROWS 0
#else
#define GAP_ROWS 1
#endif

/* Rows of n >= 0 pixels each, the first of which begins at index `at`; one without GAP_ROWS. */
struct gap_rows {
    int32_t at, n, rows, pitch;
};

/* Puts the means of n >= 0 pixels from index `at` on in place of the background. A pixel stays as it is where the
 * weighted sum has no instant. */
void smear_gap_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                               enum gap_cover cover);
void smear_gap_means_two_passes(const struct gap_planes *p, const struct gap_rows *rows, const struct gap_taps *taps,
                                enum gap_cover cover);
#if SMEAR_VECTORS
void smear_gap_means_vector(const struct gap_planes *p, const struct gap_rows *rows, const struct gap_taps *taps, enum gap_cover cover);
#define smear_gap_means smear_gap_means_vector
#else
#define smear_gap_means smear_gap_means_two_passes
#endif

#endif
