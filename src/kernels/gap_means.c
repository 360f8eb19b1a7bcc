/* SPDX-License-Identifier: MIT */
/* gap_means.c - packed sums over the gap between one instant and the next, and their means. */
#include "kernels/gap_means.h"

static inline uint32_t weight_of(const struct gap_taps *taps, int32_t pair)
{
    return pair + 1 == taps->at.pairs ? taps->last : 1u << taps->unit_log2;
}

#if PACKED_ASM_ARMV6M
/* Adds the sums of two taps to those of n >= 1 pixels: 10 instructions each, of which compilers make 30. */
static void add_pair_armv6m(struct packed_sum *out, const struct packed_sum *in, const struct packed_sum *a,
                            const struct packed_sum *b, int32_t n)
{
    const struct packed_sum *end = in + n;
    __asm__ volatile(
        ".syntax unified\n"
        "1:\n\t"
        "ldm %[in]!, {r4, r5}\n\t"
        "ldm %[a]!, {r6, r7}\n\t"
        "adds r4, r4, r6\n\t"
        "adds r5, r5, r7\n\t"
        "ldm %[b]!, {r6, r7}\n\t"
        "adds r4, r4, r6\n\t"
        "adds r5, r5, r7\n\t"
        "stm %[out]!, {r4, r5}\n\t"
        "cmp %[in], %[end]\n\t"
        "bne 1b"
        : [out] "+l"(out), [in] "+l"(in), [a] "+l"(a), [b] "+l"(b)
        : [end] "h"(end)
        : "r4", "r5", "r6", "r7", "cc", "memory");
}

/* The last pair, of a weight of its own: all before it has that of a unit. 20 instructions a pixel. */
static void add_last_armv6m(struct packed_sum *out, const struct packed_sum *in, const struct packed_sum *a,
                            const struct packed_sum *b, int32_t n, int unit_log2, uint32_t weight)
{
    const struct packed_sum *end = in + n;
    __asm__ volatile(
        ".syntax unified\n"
        "1:\n\t"
        "ldm %[in]!, {r4, r5}\n\t"
        "mov r6, %[unit]\n\t"
        "lsls r4, r6\n\t"
        "lsls r5, r6\n\t"
        "ldr r6, [%[a]]\n\t"
        "ldr r7, [%[b]]\n\t"
        "adds r6, r6, r7\n\t"
        "mov r7, %[weight]\n\t"
        "muls r6, r7\n\t"
        "adds r4, r4, r6\n\t"
        "ldr r6, [%[a], #4]\n\t"
        "ldr r7, [%[b], #4]\n\t"
        "adds r6, r6, r7\n\t"
        "mov r7, %[weight]\n\t"
        "muls r6, r7\n\t"
        "adds r5, r5, r6\n\t"
        "stm %[out]!, {r4, r5}\n\t"
        "adds %[a], #8\n\t"
        "adds %[b], #8\n\t"
        "cmp %[in], %[end]\n\t"
        "bne 1b"
        : [out] "+l"(out), [in] "+l"(in), [a] "+l"(a), [b] "+l"(b)
        : [end] "h"(end), [unit] "h"(unit_log2), [weight] "h"(weight)
        : "r4", "r5", "r6", "r7", "cc", "memory");
}

static void sums_armv6m(struct packed_sum *out, const struct packed_sum *sums, int32_t n, const struct gap_taps *taps)
{
    const int32_t *offset = taps->at.offset;
    const struct packed_sum *in = sums;
    for (int32_t left = taps->at.pairs; left > 1; left--, offset++) {
        add_pair_armv6m(out, in, sums - *offset, sums + *offset, n);
        in = out;
    }
    add_last_armv6m(out, in, sums - *offset, sums + *offset, n, taps->unit_log2, taps->last);
}
#endif

/* The sums of n pixels whose taps all count what is there: first those of one weight, then the last pair. */
static void sums_uncovered(struct packed_sum *out, const struct packed_sums *sums, int32_t at, int32_t n,
                           const struct gap_taps *taps)
{
    const int32_t *offset = taps->at.offset;
    const int32_t pairs = taps->at.pairs;
    const int unit_log2 = taps->unit_log2;
    for (int32_t i = 0; i < n; i++) {
        struct packed_sum all = packed_sum_at(sums, at + i);
        for (int32_t k = 0; k < pairs - 1; k++) {
            const struct packed_sum a = packed_sum_at(sums, at + i - offset[k]), b = packed_sum_at(sums, at + i + offset[k]);
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

/* The sum of one pixel's taps, as the contract says. */
static inline struct packed_sum sum_seen(const struct gap_planes *p, int32_t at, const struct gap_taps *taps)
{
    const struct packed_sum here = packed_sum_at(&p->sums, at);
    const uint32_t unit = 1u << taps->unit_log2;
    struct packed_sum all = { here.rb << taps->unit_log2, here.gn << taps->unit_log2 };
    bool hides = p->depth[at] > p->nearest;
    for (int32_t i = 0; i < taps->at.pairs && !hides; i++) {
        const struct packed_sum a = gap_tap(p, at, at - taps->at.offset[i], 1, &hides),
                                b = gap_tap(p, at, at + taps->at.offset[i], 1, &hides);
        all.rb += (a.rb + b.rb) * weight_of(taps, i);
        all.gn += (a.gn + b.gn) * weight_of(taps, i);
    }
    if (hides) {
        const uint32_t whole = taps->at.pairs == 0 ? unit
                                                   : unit * (2 * (uint32_t)taps->at.pairs - 1) + 2 * taps->last;
        all = (struct packed_sum){ here.rb * whole, here.gn * whole };
    }
    return all;
}

void smear_gap_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_taps *taps,
                               enum gap_cover cover)
{
    (void)cover;
    for (int32_t i = at; i < at + n; i++) {
        struct packed_sum sum;
        sums_uncovered(&sum, &p->sums, i, 1, taps);
        if (sum.gn >> 16 != taps->mean->n)
            sum = sum_seen(p, i, taps);
        if (sum.gn >> 16 != 0)
            p->color[i] = packed_mean_of(taps->mean, sum, p->color[i]);
    }
}

/* ------------------------------------------------------------------ in two passes */

/* Sums of some pixels, then their means: each loop alone needs few registers. Where what moves is seen throughout, at all
 * taps, the background hides nothing, and where it is seen nowhere there is nothing to hide: no depth matters. */
void smear_gap_means_two_passes(const struct gap_planes *p, const struct gap_rows *r, const struct gap_taps *taps,
                                enum gap_cover cover)
{
    enum { ONCE = 16 };
    struct packed_sum sums[ONCE];
    const struct packed_mean *mean = taps->mean;
    int32_t at = r->at;
    for (int32_t row = GAP_ROWS ? r->rows : 1; row > 0; row--, at += r->pitch) {
#if !SMEAR_VECTORS
        if (taps->at.pairs == 0 && taps->unit_log2 == 0) {      /* a pixel's own sum, whatever hides */
            smear_packed_means(p->color + at, p->sums.pair + at, r->n, mean);
            continue;
        }
#endif
        for (int32_t done = 0, n; done < r->n; done += n) {
            n = min_i32(r->n - done, ONCE);
#if PACKED_ASM_ARMV6M
            if (taps->at.pairs > 0)
                sums_armv6m(sums, p->sums.pair + at + done, n, taps);
            else
#endif
                sums_uncovered(sums, &p->sums, at + done, n, taps);
            for (int32_t i = 0; i < n && cover != COVER_NONE; i++)
                if (sums[i].gn >> 16 != 0 && sums[i].gn >> 16 != mean->n)
                    sums[i] = sum_seen(p, at + done + i, taps);
            smear_packed_means(p->color + at + done, sums, n, mean);
        }
    }
}

/* ------------------------------------------------------------------ four pixels at once */

#if SMEAR_VECTORS
static inline smear_v4u weighted4(smear_v4u sum, uint32_t weight)
{
    return v4u_mul16(sum, (smear_v4u){ 0, 0, 0, 0 } + weight * 0x10001u);
}

/* Adds the background to the sums of four pixels, as often as they have not all instants. */
static inline struct gap_sums4 before4(struct gap_sums4 sum, smear_v4u background, const struct packed_mean *m)
{
    const smear_v4u rest = v4u_all(m->n) - (sum.gn >> 16);
    return (struct gap_sums4){ sum.rb + v4u_mul16(background & 0xff00ffu, rest | rest << 16),
                               sum.gn + v4u_mul16(background >> 8 & 0xffu, rest) };
}

static inline void mean4(uint32_t *color, struct gap_sums4 sum, const struct packed_mean *m)
{
    const smear_v4u half = v4u_all(m->halves), factor = v4u_all(m->factor * 0x10001u);
    const smear_v4u rb = v4u_mulh16(sum.rb + half, factor) >> m->shift, g = v4u_mulh16(sum.gn + half, factor) >> m->shift;
    v4u_store(color, (rb & 0xff00ffu) | (g & 0xffu) << 8);
}

/* The sums of four pixels whose taps all count what is there. */
static inline struct gap_sums4 uncovered4(const uint32_t *rb, const uint32_t *gn, const struct gap_taps *taps)
{
    smear_v4u a = v4u_load(rb), b = v4u_load(gn);
    const int32_t *offset = taps->at.offset;
    for (int32_t i = 1; i < taps->at.pairs; i++, offset++) {
        a += v4u_load(rb + *offset) + v4u_load(rb - *offset);
        b += v4u_load(gn + *offset) + v4u_load(gn - *offset);
    }
    a <<= taps->unit_log2;
    b <<= taps->unit_log2;
    if (taps->at.pairs > 0) {
        a += weighted4(v4u_load(rb + *offset) + v4u_load(rb - *offset), taps->last);
        b += weighted4(v4u_load(gn + *offset) + v4u_load(gn - *offset), taps->last);
    }
    return (struct gap_sums4){ a, b };
}

/* The sums of four pixels whose taps count as the contract says. */
static struct gap_sums4 covered4(const struct gap_planes *p, int32_t at, const struct gap_taps *taps)
{
    struct gap_pixels4 c = gap_pixels4_at(p, at, 1);
    uint32_t all = 1u << taps->unit_log2;
    smear_v4u rb = weighted4(c.own.rb, all), gn = weighted4(c.own.gn, all);
    for (int32_t i = 0; i < taps->at.pairs; i++) {
        const uint32_t weight = weight_of(taps, i);
        const struct gap_sums4 before = gap_tap4(&c, p, at - taps->at.offset[i]),
                               after = gap_tap4(&c, p, at + taps->at.offset[i]);
        rb += weighted4(before.rb + after.rb, weight);
        gn += weighted4(before.gn + after.gn, weight);
        all += 2 * weight;
    }
    return (struct gap_sums4){ v4u_choose(c.hides, weighted4(c.own.rb, all), rb),
                               v4u_choose(c.hides, weighted4(c.own.gn, all), gn) };
}

SMEAR_INLINE void means4(const struct gap_planes *p, int32_t at, const struct gap_taps *taps, const struct packed_mean *mean,
                         enum gap_cover cover)
{
    struct gap_sums4 sum = uncovered4(p->sums.rb + at, p->sums.gn + at, taps);
    const smear_v4u times = sum.gn >> 16;
    if (!v4u_all_set((smear_v4u)(times == v4u_all(mean->n)))) {
        if (cover != COVER_NONE && !v4u_any(times))
            return;
        if (cover != COVER_NONE && gap_may_hide4(p, at, &taps->at, times, mean->n, cover))
            sum = gap_choose4(sum, mean->n, covered4(p, at, taps));
        sum = before4(sum, v4u_load(p->color + at), mean);
    }
    mean4(p->color + at, sum, mean);
}

void smear_gap_means_vector(const struct gap_planes *p, const struct gap_rows *r, const struct gap_taps *taps, enum gap_cover cover)
{
    const struct gap_planes planes = *p;
    const struct packed_mean mean = *taps->mean;
    const struct gap_taps all = *taps, own = { { NULL, 0, 1 }, all.unit_log2, 0, &mean };
    const int32_t fours = r->n & ~3;
    for (int32_t row = 0, first = r->at; row < r->rows; row++, first += r->pitch) {
        if (all.at.pairs == 0)
            for (int32_t at = first; at < first + fours; at += 4)
                means4(&planes, at, &own, &mean, COVER_NONE);
        else
            for (int32_t at = first; at < first + fours; at += 4)
                means4(&planes, at, &all, &mean, cover);
    }
    const struct gap_rows rest = { r->at + fours, r->n - fours, r->rows, r->pitch };
    if (rest.n != 0)
        smear_gap_means_two_passes(p, &rest, taps, cover);
}
#endif
