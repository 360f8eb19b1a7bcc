/* SPDX-License-Identifier: MIT */
/* timemask_samples.c - entries of pixels: taken, lost, merged, averaged. */
#include "timemask/timemask_samples.h"

/* ------------------------------------------------------------------ merging */

static inline uint32_t distance(uint32_t a, uint32_t b) { return a > b ? a - b : b - a; }

/* Returns twice the depth code of an entry in the middle of the exposure. */
static inline uint32_t middle_of(const struct timemask_entry *e) { return (uint32_t)e->start + e->end; }

/* Returns the mean of two colours by the samples that they are seen in: equal codes keep theirs. */
static uint32_t mean_of_two(uint32_t a, uint32_t wa, uint32_t b, uint32_t wb, smear_transfer transfer)
{
    const uint32_t n = wa + wb;
    uint32_t out = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        const uint32_t x = value_of_code(a >> shift & 255u, transfer), y = value_of_code(b >> shift & 255u, transfer);
        out |= code_of_value((x * wa + y * wb + n / 2) / n, transfer) << shift;
    }
    return out;
}

/* Makes two entries one, in the course of the longer. */
static struct timemask_entry join(const struct timemask_entry *a, const struct timemask_entry *b, smear_transfer transfer)
{
    const uint32_t wa = timemask_count(a->held), wb = timemask_count(b->held);
    struct timemask_entry e = wa < wb ? *b : *a;
    e.held = a->held | b->held;
    e.color = mean_of_two(a->color, wa, b->color, wb, transfer);
    return e;
}

/* Returns how much it matters that two entries become one: by depth and colour. */
static uint32_t apart(const struct timemask_entry *a, const struct timemask_entry *b)
{
    const uint32_t color = distance(pixel_red(a->color), pixel_red(b->color)) + distance(pixel_green(a->color), pixel_green(b->color))
                         + distance(pixel_blue(a->color), pixel_blue(b->color));
    return (distance(middle_of(a), middle_of(b)) / 2 + 16u) * (color + 16u);
}

/* Puts one more entry where all are taken: the two that are most alike share one. */
static void merge(struct timemask_pixel *p, const struct timemask_entry *fresh, smear_transfer transfer)
{
    struct timemask_entry all[TIMEMASK_ENTRIES + 1];
    int first = 0, second = 1;
    __builtin_memcpy(all, p->entry, sizeof p->entry);
    all[TIMEMASK_ENTRIES] = *fresh;
    for (int i = 0; i < TIMEMASK_ENTRIES; i++)
        for (int k = i + 1; k <= TIMEMASK_ENTRIES; k++)
            if (apart(&all[i], &all[k]) < apart(&all[first], &all[second])) {
                first = i;
                second = k;
            }
    all[first] = join(&all[first], &all[second], transfer);
    all[second] = *fresh;
    __builtin_memcpy(p->entry, all, sizeof p->entry);
}

/* ------------------------------------------------------------------ depth in time */

/* Returns the samples of `both` in which a is nearer than b. */
static uint32_t nearer(const struct timemask_entry *a, const struct timemask_entry *b, uint32_t both, int32_t last)
{
    const int32_t start = a->start - b->start, end = a->end - b->end;
    uint32_t out = 0;
    for (int32_t i = 0; i <= last; i++)
        if (start * (last - i) + end * i > 0)
            out |= 1u << i;
    return out & both;
}

/* Whether two entries are of one colour and, as far as that matters, one surface. */
static bool is_same(const struct timemask_entry *a, const struct timemask_entry *b)
{
    return a->color == b->color && distance(a->start, b->start) <= b->start >> 6 && distance(a->end, b->end) <= b->end >> 6;
}

void smear_timemask_add(struct timemask_pixel *p, struct timemask_entry fresh, int32_t last, smear_transfer transfer)
{
    for (uint32_t i = 0; i < p->count;) {
        struct timemask_entry *e = &p->entry[i];
        const uint32_t both = e->held & fresh.held, taken = both != 0 ? nearer(&fresh, e, both, last) : 0;
        fresh.held &= ~both | taken;
        e->held &= ~taken;
        if (e->held == 0)       /* the last one takes its place */
            *e = p->entry[--p->count];
        else
            i++;
    }
    if (fresh.held == 0)
        return;
    for (uint32_t i = 0; i < p->count; i++)
        if (is_same(&p->entry[i], &fresh)) {
            p->entry[i] = join(&p->entry[i], &fresh, transfer);
            return;
        }
    if (p->count == TIMEMASK_ENTRIES)
        merge(p, &fresh, transfer);
    else
        p->entry[p->count++] = fresh;
}

/* ------------------------------------------------------------------ means */

uint32_t smear_timemask_mean(const struct timemask_pixel *p, uint32_t background, int samples_log2, smear_transfer transfer)
{
    uint32_t rest = 1u << samples_log2, sum[3] = { rest >> 1, rest >> 1, rest >> 1 }, out = 0;
    for (uint32_t i = 0; i <= p->count; i++) {
        const uint32_t n = i < p->count ? timemask_count(p->entry[i].held) : rest, color = i < p->count ? p->entry[i].color : background;
        rest -= n;
        for (int k = 0; k < 3; k++)
            sum[k] += n * value_of_code(color >> 8 * k & 255u, transfer);
    }
    for (int k = 0; k < 3; k++)
        out |= code_of_value(sum[k] >> samples_log2, transfer) << 8 * k;
    return out;
}
