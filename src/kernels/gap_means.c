/* SPDX-License-Identifier: MIT */
/* gap_means.c - packed sums over the gap between one instant and the next, and their means. */
#include "kernels/gap_means.h"

static inline uint32_t weight_of(const struct gap_taps *taps, int32_t pair)
{
    return pair + 1 == taps->pairs ? taps->last : 1u << taps->unit_log2;
}

/* The sum of one pixel's taps, as the contract says. */
static inline struct packed_sum sum_seen(const struct gap_planes *p, int32_t at, const struct gap_taps *taps)
{
    const struct packed_sum here = packed_sum_at(&p->sums, at);
    const uint32_t depth = p->depth[at], times = here.gn >> 16, unit = 1u << taps->unit_log2;
    struct packed_sum all = { here.rb << taps->unit_log2, here.gn << taps->unit_log2 };
    bool hides = depth > p->nearest;
    for (int32_t i = 0; i < taps->pairs && !hides; i++) {
        struct packed_sum pair = { 0, 0 };
        for (int side = 0; side < 2; side++) {
            const int32_t tap = side ? at + taps->offset[i] : at - taps->offset[i];
            const uint32_t depth_there = p->depth[tap];
            struct packed_sum there = packed_sum_at(&p->sums, tap);
            if (depth_there > depth && (depth_there > p->nearest || (there.gn >> 16) + 1 < times))
                there = here;
            else if (depth_there < depth && times + 1 < there.gn >> 16)
                hides = true;
            pair.rb += there.rb;
            pair.gn += there.gn;
        }
        all.rb += pair.rb * weight_of(taps, i);
        all.gn += pair.gn * weight_of(taps, i);
    }
    if (hides) {
        const uint32_t whole = taps->pairs == 0 ? unit
                                                : unit * (2 * (uint32_t)taps->pairs - 1) + 2 * taps->last;
        all = (struct packed_sum){ here.rb * whole, here.gn * whole };
    }
    return all;
}

void smear_gap_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                               enum gap_cover cover)
{
    (void)cover;
    for (int32_t i = at; i < at + n; i++) {
        const struct packed_sum sum = sum_seen(p, i, taps);
        if (sum.gn >> 16 != 0)
            p->color[i] = packed_mean_of(taps->mean, sum, p->color[i]);
    }
}

/* ------------------------------------------------------------------ in two passes */

/* The sums of n pixels whose taps all count what is there: first those of one weight, then the last pair. */
static void sums_uncovered(struct packed_sum *out, const struct packed_sums *sums, int32_t at, int32_t n,
                           const struct gap_taps *taps)
{
    const int32_t *offset = taps->offset;
    const int32_t pairs = taps->pairs;
    const int unit_log2 = taps->unit_log2;
    if (pairs <= 1)
        for (int32_t i = 0; i < n; i++) {
            const struct packed_sum here = packed_sum_at(sums, at + i);
            out[i] = (struct packed_sum){ here.rb << unit_log2, here.gn << unit_log2 };
        }
    else
        for (int32_t i = 0; i < n; i++) {
            struct packed_sum all = packed_sum_at(sums, at + i);
            for (int32_t k = 0; k < pairs - 1; k++) {
                const struct packed_sum a = packed_sum_at(sums, at + i - offset[k]),
                                        b = packed_sum_at(sums, at + i + offset[k]);
                all.rb += a.rb + b.rb;
                all.gn += a.gn + b.gn;
            }
            out[i] = (struct packed_sum){ all.rb << unit_log2, all.gn << unit_log2 };
        }
    if (pairs == 0)
        return;
    const uint32_t weight = taps->last;
    for (int32_t i = 0, p = at - offset[pairs - 1], q = at + offset[pairs - 1]; i < n; i++) {
        const struct packed_sum a = packed_sum_at(sums, p + i), b = packed_sum_at(sums, q + i);
        out[i].rb += (a.rb + b.rb) * weight;
        out[i].gn += (a.gn + b.gn) * weight;
    }
}

/* Sums of some pixels, then their means: each loop alone needs few registers. */
void smear_gap_means_two_passes(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                                enum gap_cover cover)
{
    struct packed_sum sums[16];
    while (n > 0) {
        const int32_t count = min_i32(n, 16);
        if (cover == COVER_NONE)
            sums_uncovered(sums, &p->sums, at, count, taps);
        else
            for (int32_t i = 0; i < count; i++)
                sums[i] = sum_seen(p, at + i, taps);
        smear_packed_means(p->color + at, sums, count, taps->mean);
        at += count;
        n -= count;
    }
}

/* ------------------------------------------------------------------ four pixels at once */

#if SMEAR_VECTORS
static inline smear_v4u weighted4(smear_v4u sum, uint32_t weight)
{
    return v4u_mul16(sum, (smear_v4u){ 0, 0, 0, 0 } + weight * 0x10001u);
}

static inline void mean4(uint32_t *color, smear_v4u rb, smear_v4u gn, const struct packed_mean *m)
{
    const smear_v4u zero = { 0, 0, 0, 0 }, half = zero + m->halves, factor = zero + m->factor * 0x10001u;
    const smear_v4u background = v4u_load(color), rest = (zero + m->n) - (gn >> 16);
    rb += v4u_mul16(background & 0xff00ffu, rest | rest << 16);
    const smear_v4u g = (gn & 0xffffu) + v4u_mul16(background >> 8 & 0xffu, rest);
    const smear_v4u rb_mean = v4u_mulh16(rb + half, factor), g_mean = v4u_mulh16(g + (half & 0xffffu), factor);
    v4u_store(color, (rb_mean >> m->shift & 0xff00ffu) | g_mean >> m->shift << 8);
}

/* Pixels whose taps all count what is there. */
static inline void uncovered4(uint32_t *color, const uint32_t *rb, const uint32_t *gn, const struct gap_taps *taps)
{
    smear_v4u a = v4u_load(rb), b = v4u_load(gn);
    const int32_t *offset = taps->offset;
    for (int32_t i = 1; i < taps->pairs; i++, offset++) {
        a += v4u_load(rb + *offset) + v4u_load(rb - *offset);
        b += v4u_load(gn + *offset) + v4u_load(gn - *offset);
    }
    a <<= taps->unit_log2;
    b <<= taps->unit_log2;
    if (taps->pairs > 0) {
        a += weighted4(v4u_load(rb + *offset) + v4u_load(rb - *offset), taps->last);
        b += weighted4(v4u_load(gn + *offset) + v4u_load(gn - *offset), taps->last);
    }
    mean4(color, a, b, taps->mean);
}

/* Whether the background is beyond `nearest` at one of four pixels or at their taps. */
static inline bool is_hidden4(const struct gap_planes *p, int32_t at, const struct gap_taps *taps)
{
    const uint16_t *depth = p->depth + at;
    const smear_v8i sign = v8i_all(INT16_MIN), limit = v8i_all((int16_t)(p->nearest ^ 0x8000u));
    smear_v8i most = v4_of_8i_load(depth) ^ sign;      /* in the order of signed numbers */
    for (int32_t i = 0; i < taps->pairs; i++)
        most = v8i_max(most, v8i_max(v4_of_8i_load(depth - taps->offset[i]) ^ sign,
                                     v4_of_8i_load(depth + taps->offset[i]) ^ sign));
    return v4u_any((smear_v4u)(v8i_max(most, limit) ^ limit));
}

/* How often what moves is seen at four pixels and at their taps. */
enum seen {
    SEEN_NOWHERE,
    SEEN_EVENLY,
    SEEN_UNEVENLY       /* somewhere at two instants more than elsewhere */
};

static inline enum seen seen4(const uint32_t *gn, const struct gap_taps *taps)
{
    smear_v8i least = (smear_v8i)v4u_load(gn), most = least;
    for (int32_t i = 0; i < taps->pairs; i++) {
        const smear_v8i a = (smear_v8i)v4u_load(gn - taps->offset[i]), b = (smear_v8i)v4u_load(gn + taps->offset[i]);
        least = v8i_min(least, v8i_min(a, b));
        most = v8i_max(most, v8i_max(a, b));
    }
    if (!v4u_any((smear_v4u)most >> 16))
        return SEEN_NOWHERE;
    return v4u_any((((smear_v4u)most >> 16) - ((smear_v4u)least >> 16)) & ~1u) ? SEEN_UNEVENLY : SEEN_EVENLY;
}

/* The sums that a tap of four pixels counts. */
struct tap4 {
    smear_v4u rb, gn;
};

/* Four pixels: their own sums, and which of them have found that the background hides what moves. */
struct covered4 {
    struct tap4 own;
    smear_v4i depth, times, nearest;
    smear_v4i hides;
};

static inline struct tap4 tap4_at(struct covered4 *c, const struct gap_planes *p, int32_t at)
{
    const struct tap4 there = { v4u_load(p->sums.rb + at), v4u_load(p->sums.gn + at) };
    const smear_v4i depth = v4i_of_u16(p->depth + at), times = (smear_v4i)(there.gn >> 16);
    const smear_v4i covers = (smear_v4i)(depth > c->depth)
                           & ((smear_v4i)(depth > c->nearest) | (smear_v4i)(c->times > times + 1));
    c->hides |= (smear_v4i)(c->depth > depth) & (smear_v4i)(times > c->times + 1);
    return (struct tap4){ v4u_choose(covers, c->own.rb, there.rb), v4u_choose(covers, c->own.gn, there.gn) };
}

/* Pixels whose taps count as the contract says. */
static void covered_means4(const struct gap_planes *p, int32_t at, const struct gap_taps *taps)
{
    const smear_v4i zero = { 0, 0, 0, 0 };
    struct covered4 c = { .own = { v4u_load(p->sums.rb + at), v4u_load(p->sums.gn + at) },
                          .depth = v4i_of_u16(p->depth + at), .nearest = zero + (int32_t)p->nearest };
    c.times = (smear_v4i)(c.own.gn >> 16);
    c.hides = (smear_v4i)(c.depth > c.nearest);
    uint32_t all = 1u << taps->unit_log2;
    smear_v4u rb = weighted4(c.own.rb, all), gn = weighted4(c.own.gn, all);
    for (int32_t i = 0; i < taps->pairs; i++) {
        const uint32_t weight = weight_of(taps, i);
        const struct tap4 before = tap4_at(&c, p, at - taps->offset[i]), after = tap4_at(&c, p, at + taps->offset[i]);
        rb += weighted4(before.rb + after.rb, weight);
        gn += weighted4(before.gn + after.gn, weight);
        all += 2 * weight;
    }
    rb = v4u_choose(c.hides, weighted4(c.own.rb, all), rb);
    gn = v4u_choose(c.hides, weighted4(c.own.gn, all), gn);
    mean4(p->color + at, rb, gn, taps->mean);
}

/* Where pixels and taps are seen evenly and nothing is beyond `nearest`, no depth matters. */
void smear_gap_means_vector(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                            enum gap_cover cover)
{
    const int32_t end = at + n;
    for (; at + 4 <= end; at += 4) {
        if (cover != COVER_NONE) {
            const enum seen seen = seen4(p->sums.gn + at, taps);
            if (seen == SEEN_NOWHERE)
                continue;
            if (seen == SEEN_UNEVENLY || (cover == COVER_ALL && is_hidden4(p, at, taps))) {
                covered_means4(p, at, taps);
                continue;
            }
        }
        uncovered4(p->color + at, p->sums.rb + at, p->sums.gn + at, taps);
    }
    smear_gap_means_two_passes(p, at, end - at, taps, cover);
}
#endif
