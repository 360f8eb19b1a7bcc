/* SPDX-License-Identifier: MIT */
/* light_sums.c - sums of pixels' light over instants, and the means of them. */
#include "kernels/light_sums.h"

#include "base/fixmath.h"

enum { GOLDEN = (int)0x9e3779b9u };     /* 2^32 over the golden ratio: multiples of it fall evenly, whatever their number */

/* ------------------------------------------------------------------ sums */

/* The bits by which `instants` differ from 16, rounded up: above 0 for more. */
static int bits_above_16(uint32_t instants)
{
    return (instants > 1 ? 32 - count_leading_zeros(instants - 1) : 0) - 4;
}

struct light_instant smear_light_instant(uint32_t k, uint32_t instants, bool linear)
{
    const int down = max_i32(bits_above_16(instants), 0), up = max_i32(-bits_above_16(instants), 0);
    const uint32_t threshold = down != 0 ? k * (uint32_t)GOLDEN >> (32 - down) : 0;
    return (struct light_instant){ threshold, down, up, linear, ((LIGHT_WHITE + threshold) >> down) << up };
}

uint32_t smear_light_full(uint32_t instants)
{
    uint32_t full = 0;
    for (uint32_t k = 0; k < instants; k++)
        full += smear_light_instant(k, instants, false).white;
    return full;
}

uint32_t smear_light_most(uint32_t instants)
{
    const int above = bits_above_16(instants);
    return above > 0 ? (LIGHT_WHITE + 1u) >> above : (uint32_t)LIGHT_WHITE << -above;
}

static inline void add_pixel(const struct packed_sums *sums, int32_t at, uint32_t c, const struct light_instant *t)
{
    uint32_t light[3];
    for (int k = 0; k < 3; k++)
        light[k] = (light_of_code(c >> (16 - 8 * k) & 0xffu, t->linear) + t->threshold) >> t->down << t->up;
    struct packed_sum s = packed_sum_at(sums, at);
    s.rb += light[0] << 16 | light[2];
    s.gn += t->white << 16 | light[1];
    packed_sum_put(sums, at, s);
}

void smear_light_add_reference(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n,
                               const struct light_instant *instant)
{
    const struct light_instant t = *instant;
    for (int32_t i = 0; i < n; i++) {
        const uint32_t c = color[i];
        if (c == PACKED_NOTHING && background == NULL)
            continue;
        SMEAR_KEEP_BRANCH();
        color[i] = background != NULL ? background[i] : PACKED_NOTHING;
        add_pixel(&sums, i, c, &t);
    }
}

#if SMEAR_VECTORS
static inline smear_v4u v4u_all16(uint32_t a)
{
    return (smear_v4u){ 0, 0, 0, 0 } + a * 0x10001u;
}

/* Returns twice the light of eight codes, smear_srgb_light, or one more: the lesser of a cubic for dark codes and one for
 * others. */
static inline smear_v4u twice_light8(smear_v4u code)
{
    const smear_v4u square = v4u_mul16(code, code), far = code << 8;
    const smear_v4u high = v4u_mulh16(square, v4u_mulh16(far, v4u_all16(2501)) + v4u_all16(5742)) + v4u_all16(23);
    const smear_v4u low = v4u_mulh16(far, v4u_mulh16(square, v4u_all16(21035)) + v4u_all16(607));
    return (smear_v4u)v8i_min((smear_v8i)low, (smear_v8i)high);
}

static inline smear_v4u added_light8(smear_v4u code, const struct light_instant *t)
{
    return v4u_left16(v4u_right16(twice_light8(code) + v4u_all16(2 * t->threshold), t->down + 1), t->up);
}

/* Takes eight pixels, whose greens share a vector. Nothing is black that adds no white. */
SMEAR_INLINE void add8(uint32_t *color, const uint32_t *background, const struct packed_sums *sums, int32_t at,
                       const struct light_instant *t)
{
    const smear_v4u nothing = v4u_all(PACKED_NOTHING), white = v4u_all(t->white << 16);
    smear_v4u a = v4u_load(color + at), b = v4u_load(color + at + 4), white_a = white, white_b = white;
    if (background == NULL) {
        const smear_v4u none_a = (smear_v4u)(a == nothing), none_b = (smear_v4u)(b == nothing);
        if (v4u_all_set(none_a & none_b))
            return;
        a &= ~none_a;
        b &= ~none_b;
        white_a &= ~none_a;
        white_b &= ~none_b;
    }
    SMEAR_KEEP_VALUE(at);       /* one index for all planes */
    const smear_v4u green = added_light8((a >> 8 & 0xffu) | (b << 8 & 0xff0000u), t);
    uint32_t *rb = sums->rb + at, *gn = sums->gn + at;
    v4u_store(color + at, background != NULL ? v4u_load(background + at) : nothing);
    v4u_store(color + at + 4, background != NULL ? v4u_load(background + at + 4) : nothing);
    v4u_store(rb, v4u_load(rb) + added_light8(a & 0xff00ffu, t));
    v4u_store(rb + 4, v4u_load(rb + 4) + added_light8(b & 0xff00ffu, t));
    v4u_store(gn, v4u_load(gn) + ((green & 0xffffu) | white_a));
    v4u_store(gn + 4, v4u_load(gn + 4) + (green >> 16 | white_b));
}

/* The last round may take some pixels again: there is nothing by then. */
SMEAR_INLINE void add_linear(uint32_t *color, const uint32_t *background, const struct packed_sums *sums, int32_t n,
                             const struct light_instant *instant)
{
    const struct light_instant t = *instant;
    int32_t i = 0;
    for (; i + 8 <= n; i += 8)
        add8(color, background, sums, i, &t);
    if (i < n && n >= 8 && background == NULL)
        add8(color, NULL, sums, n - 8, &t);
    else if (i < n)
        smear_light_add_reference(color + i, background != NULL ? background + i : NULL, packed_sums_from(*sums, i), n - i, &t);
}

void smear_light_add_vector(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n,
                            const struct light_instant *instant)
{
    if (instant->linear && background != NULL)
        add_linear(color, background, &sums, n, instant);
    else if (instant->linear)
        add_linear(color, NULL, &sums, n, instant);
    else
        smear_light_add_reference(color, background, sums, n, instant);
}
#endif

/* ------------------------------------------------------------------ means */

/* Returns both halves of a word times a weight in q16. */
static inline uint32_t weighted(uint32_t halves, uint32_t weight)
{
    return ((halves >> 16) * weight & 0xffff0000u) | (halves & 0xffffu) * weight >> 16;
}

/* Returns the means of the halves of two words, rounded up. */
static inline uint32_t halves_mean(uint32_t a, uint32_t b)
{
    return (a | b) - ((a ^ b) >> 1 & 0x7fff7fffu);
}

struct light_mean smear_light_mean(uint32_t full, int32_t pairs, uint32_t unit, uint32_t last, bool linear)
{
    struct light_mean m = { .full = full, .linear = linear };
    if (pairs != 0) {
        const uint32_t whole = unit * (2 * (uint32_t)pairs - 1) + 2 * last;
        m.own = min_u32((unit << 16) / whole, 65535);
        m.pair = pairs > 1 ? (unit << 17) / whole : 0;
        m.last = (last << 17) / whole;
        m.full = weighted(full, m.own) + weighted(full, m.pair) * (uint32_t)(pairs - 1) + weighted(full, m.last);
    }
    m.factor = ((uint32_t)LIGHT_WHITE << 16) / m.full;
    m.half = (m.full + LIGHT_WHITE) / (2 * LIGHT_WHITE) + (pairs != 0 ? (uint32_t)(pairs + 1) / 2 : 0);
    return m;
}

/* Adds a word of sums of a pair of taps. */
static inline void add_pair(struct packed_sum *all, struct packed_sum a, struct packed_sum b, uint32_t weight)
{
    all->rb += weighted(halves_mean(a.rb, b.rb), weight);
    all->gn += weighted(halves_mean(a.gn, b.gn), weight);
}

static inline uint32_t pair_weight(const struct light_mean *m, const struct gap_pairs *taps, int32_t pair)
{
    return pair + 1 == taps->pairs ? m->last : m->pair;
}

/* Returns the weighted sum of one pixel's taps, which all count what is there. */
static inline struct packed_sum sum_uncovered(const struct gap_planes *p, int32_t at, const struct gap_pairs *taps,
                                              const struct light_mean *m)
{
    const struct packed_sum here = packed_sum_at(&p->sums, at);
    if (taps->pairs == 0)
        return here;
    struct packed_sum all = { weighted(here.rb, m->own), weighted(here.gn, m->own) };
    for (int32_t i = 0; i < taps->pairs; i++)
        add_pair(&all, packed_sum_at(&p->sums, at - taps->offset[i]), packed_sum_at(&p->sums, at + taps->offset[i]),
                 pair_weight(m, taps, i));
    return all;
}

/* Returns the weighted sum of one pixel's taps, which count as gap_pairs says. */
static SMEAR_RARE struct packed_sum sum_covered(const struct gap_planes *p, int32_t at, const struct gap_pairs *taps,
                                                const struct light_mean *m)
{
    const struct packed_sum here = packed_sum_at(&p->sums, at);
    if (taps->pairs == 0)
        return here;
    struct packed_sum all = { weighted(here.rb, m->own), weighted(here.gn, m->own) }, still = all;
    bool hides = p->depth[at] > p->nearest;
    for (int32_t i = 0; i < taps->pairs; i++) {
        add_pair(&all, gap_tap(p, at, at - taps->offset[i], taps->instant, &hides),
                 gap_tap(p, at, at + taps->offset[i], taps->instant, &hides), pair_weight(m, taps, i));
        add_pair(&still, here, here, pair_weight(m, taps, i));
    }
    return hides ? still : all;
}

static inline uint32_t mean_code(uint32_t sum, uint32_t background, uint32_t rest, const struct light_mean *m)
{
    const uint32_t all = sum + ((light_of_code(background, m->linear) << 4) * rest >> 16) + m->half;
    return code_of_light(all * m->factor >> 16, m->linear);
}

void smear_light_means_reference(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_pairs *taps,
                                 const struct light_mean *mean, enum gap_cover cover)
{
    const struct light_mean m = *mean;
    for (int32_t i = at; i < at + n; i++) {
        struct packed_sum sum = sum_uncovered(p, i, taps, &m);
        if (sum.gn >> 16 == 0)
            continue;
        if (cover != COVER_NONE && sum.gn >> 16 != m.full)
            sum = sum_covered(p, i, taps, &m);
        const uint32_t c = p->color[i], rest = m.full - (sum.gn >> 16);
        if (sum.gn >> 16 != 0)
            p->color[i] = mean_code(sum.rb >> 16, c >> 16 & 0xffu, rest, &m) << 16
                        | mean_code(sum.gn & 0xffffu, c >> 8 & 0xffu, rest, &m) << 8
                        | mean_code(sum.rb & 0xffffu, c & 0xffu, rest, &m);
    }
}

#if SMEAR_VECTORS
static inline smear_v4u background_light8(smear_v4u code)
{
    return (twice_light8(code) & v4u_all16(0xfffeu)) << 3;
}

static inline void mean4(uint32_t *color, const struct gap_sums4 *sum, const struct light_mean *m)
{
    const smear_v4u rest = ((smear_v4u){ 0, 0, 0, 0 } + m->full) - (sum->gn >> 16);
    smear_v4u rb = sum->rb + v4u_all16(m->half), g = (sum->gn & 0xffffu) + m->half;
    if (v4u_any(rest)) {
        const smear_v4u background = v4u_load(color);
        rb += v4u_mulh16(background_light8(background & 0xff00ffu), rest | rest << 16);
        g += v4u_mulh16(background_light8(background >> 8 & 0xffu), rest);
    }
    rb = v4u_mulh16(rb, v4u_all16(m->factor));
    g = v4u_mulh16(g, v4u_all16(m->factor));
    uint32_t red_blue[4], green[4];
    v4u_store(red_blue, rb);
    v4u_store(green, g);
    for (int i = 0; i < 4; i++)
        color[i] = (uint32_t)smear_srgb_encode[red_blue[i] >> 16] << 16 | (uint32_t)smear_srgb_encode[green[i]] << 8
                 | smear_srgb_encode[red_blue[i] & 0xffffu];
}

/* The sums of four pixels whose taps all count what is there. */
static inline struct gap_sums4 uncovered4(const uint32_t *rb, const uint32_t *gn, const struct gap_pairs *taps,
                                          const struct light_mean *m)
{
    struct gap_sums4 all = { v4u_load(rb), v4u_load(gn) };
    if (taps->pairs == 0)
        return all;
    const smear_v4u pair = v4u_all16(m->pair), last = v4u_all16(m->last), own = v4u_all16(m->own);
    const int32_t *offset = taps->offset;
    all.rb = v4u_mulh16(all.rb, own);
    all.gn = v4u_mulh16(all.gn, own);
    for (int32_t i = 1; i < taps->pairs; i++, offset++) {
        all.rb += v4u_mulh16(v4u_mean16(v4u_load(rb - *offset), v4u_load(rb + *offset)), pair);
        all.gn += v4u_mulh16(v4u_mean16(v4u_load(gn - *offset), v4u_load(gn + *offset)), pair);
    }
    all.rb += v4u_mulh16(v4u_mean16(v4u_load(rb - *offset), v4u_load(rb + *offset)), last);
    all.gn += v4u_mulh16(v4u_mean16(v4u_load(gn - *offset), v4u_load(gn + *offset)), last);
    return all;
}

/* The sums of four pixels whose taps count as gap_pairs says. */
static struct gap_sums4 covered4(const struct gap_planes *p, int32_t at, const struct gap_pairs *taps,
                                 const struct light_mean *m)
{
    struct gap_pixels4 c = gap_pixels4_at(p, at, taps->instant);
    if (taps->pairs == 0)
        return c.own;
    struct gap_sums4 all = { v4u_mulh16(c.own.rb, v4u_all16(m->own)), v4u_mulh16(c.own.gn, v4u_all16(m->own)) },
                     still = all;
    for (int32_t i = 0; i < taps->pairs; i++) {
        const smear_v4u weight = v4u_all16(i + 1 == taps->pairs ? m->last : m->pair);
        const struct gap_sums4 a = gap_tap4(&c, p, at - taps->offset[i]), b = gap_tap4(&c, p, at + taps->offset[i]);
        all.rb += v4u_mulh16(v4u_mean16(a.rb, b.rb), weight);
        all.gn += v4u_mulh16(v4u_mean16(a.gn, b.gn), weight);
        still.rb += v4u_mulh16(c.own.rb, weight);
        still.gn += v4u_mulh16(c.own.gn, weight);
    }
    return (struct gap_sums4){ v4u_choose(c.hides, still.rb, all.rb), v4u_choose(c.hides, still.gn, all.gn) };
}

static void means_linear(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_pairs *taps,
                         const struct light_mean *mean, enum gap_cover cover)
{
    const struct light_mean m = *mean;
    const int32_t end = at + n;
    for (; at + 4 <= end; at += 4) {
        struct gap_sums4 sum = uncovered4(p->sums.rb + at, p->sums.gn + at, taps, &m);
        if (!v4u_any(sum.gn >> 16))
            continue;
        if (cover != COVER_NONE && gap_may_hide4(p, at, taps, sum.gn >> 16, m.full, cover))
            sum = gap_choose4(sum, m.full, covered4(p, at, taps, &m));
        mean4(p->color + at, &sum, &m);
    }
    smear_light_means_reference(p, at, end - at, taps, &m, cover);
}

void smear_light_means_vector(const struct gap_planes *p, int32_t at, int32_t n, const struct gap_pairs *taps,
                              const struct light_mean *mean, enum gap_cover cover)
{
    if (mean->linear)
        means_linear(p, at, n, taps, mean, cover);
    else
        smear_light_means_reference(p, at, n, taps, mean, cover);
}
#endif

