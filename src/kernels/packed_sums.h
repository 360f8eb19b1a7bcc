/* SPDX-License-Identifier: MIT */
/* packed_sums.h - sums of pixels over instants, and the means of them.
 *
 * A sum is packed into two words: red and blue in 16 bits each, and green beside the number of instants it has. So it
 * holds PACKED_INSTANTS_MAX codes and, while a mean is made, half as many more. Instants in which nothing moves are
 * not added: the mean gives the background the weight of those that are left. */
#ifndef SMEAR_KERNELS_PACKED_SUMS_H
#define SMEAR_KERNELS_PACKED_SUMS_H

#include "kernels/vector.h"
#include "kernels/kernels.h"

enum { PACKED_INSTANTS_MAX = 256 };

/* What pixels of an instant are where nothing moves: others have no upper byte then. Its bytes are alike, so memset writes it. */
#define PACKED_NOTHING 0x01010101u

/* The assembly needs Thumb's high registers, which GCC keeps to itself where size counts. */
#ifdef __OPTIMIZE_SIZE__
#define PACKED_ASM_ARMV6M 0
#else
#define PACKED_ASM_ARMV6M SMEAR_ASM_ARMV6M
#endif

struct packed_sum {
    uint32_t rb;                /* red << 16 | blue */
    uint32_t gn;                /* instants << 16 | green */
};

/* The sums of a plane of pixels: two planes of words where there are vectors, else one of pairs of words. */
struct packed_sums {
#if SMEAR_VECTORS
    uint32_t *rb, *gn;
#else
    struct packed_sum *pair;
#endif
};

/* The sums of `pixels` pixels in 2 `pixels` words of memory. */
static inline struct packed_sums packed_sums_in(uint32_t *memory, int32_t pixels)
{
#if SMEAR_VECTORS
    return (struct packed_sums){ memory, memory + pixels };
#else
    (void)pixels;
    return (struct packed_sums){ (struct packed_sum *)(void *)memory };
#endif
}

SMEAR_INLINE struct packed_sum packed_sum_at(const struct packed_sums *s, int32_t at)
{
#if SMEAR_VECTORS
    return (struct packed_sum){ s->rb[at], s->gn[at] };
#else
    return s->pair[at];
#endif
}

static inline void packed_sum_put(const struct packed_sums *s, int32_t at, struct packed_sum sum)
{
#if SMEAR_VECTORS
    s->rb[at] = sum.rb;
    s->gn[at] = sum.gn;
#else
    s->pair[at] = sum;
#endif
}

/* Empties the sums of the pixels [at, at + n). */
static inline void packed_sums_clear(const struct packed_sums *s, int32_t at, int32_t n)
{
#if SMEAR_VECTORS
    __builtin_memset(s->rb + at, 0, (size_t)n * sizeof *s->rb);
    __builtin_memset(s->gn + at, 0, (size_t)n * sizeof *s->gn);
#else
    __builtin_memset(s->pair + at, 0, (size_t)n * sizeof *s->pair);
#endif
}

/* The sums from index `at` on. */
static inline struct packed_sums packed_sums_from(struct packed_sums s, int32_t at)
{
#if SMEAR_VECTORS
    return (struct packed_sums){ s.rb + at, s.gn + at };
#else
    return (struct packed_sums){ s.pair + at };
#endif
}

/* Adds n >= 1 pixels to their sums: those that are not PACKED_NOTHING, which they become, or, where `background` is not null, all of
 * them, which become that again. The two do not overlap. */
void smear_packed_add_reference(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n);
#if SMEAR_VECTORS || PACKED_ASM_ARMV6M
void smear_packed_add(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n);
#else
#define smear_packed_add smear_packed_add_reference
#endif

/* Divides by n, 2 .. PACKED_INSTANTS_MAX, in 16 bits: (sum + n / 2) times 2^(16 + shift) / n, rounded up. A mean that is
 * whole stays so, and others go up from 1/2 - 1/128 on. */
struct packed_mean {
    uint32_t n, halves, factor; /* halves: n / 2 in 16 bits, twice */
    int shift;
    uint32_t factor24;          /* the factor times 2^(8 - shift): the mean is in a product's top byte */
};

struct packed_mean smear_packed_mean(uint32_t n);

/* The mean of m->n codes, of which `background` has those that the sum has not. The sum has an instant at least and
 * m->n at most. */
static inline uint32_t packed_mean_of(const struct packed_mean *m, struct packed_sum sum, uint32_t background)
{
    const uint32_t rest = m->n - (sum.gn >> 16);
    const uint32_t rb = sum.rb + (background & 0xff00ffu) * rest + m->halves;
    const uint32_t g = (uint16_t)(sum.gn + (background >> 8 & 0xffu) * rest + m->halves);
    return (rb >> 16) * m->factor24 >> 24 << 16 | g * m->factor24 >> 24 << 8 | (uint16_t)rb * m->factor24 >> 24;
}

/* Puts the means of n >= 1 sums in place of the background in `color`, where they have an instant. */
void smear_packed_means_reference(uint32_t *color, const struct packed_sum *sum, int32_t n, const struct packed_mean *m);
#if PACKED_ASM_ARMV6M
void smear_packed_means(uint32_t *color, const struct packed_sum *sum, int32_t n, const struct packed_mean *m);
#else
#define smear_packed_means smear_packed_means_reference
#endif

#endif
