/* SPDX-License-Identifier: MIT */
/* base.h - the few words that every file uses. It is the bottom room and includes only the configuration. */
#ifndef SMEAR_BASE_H
#define SMEAR_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/bind.h"

#if !SMEAR_GNU
#include <string.h>
#define __builtin_memcpy memcpy
#define __builtin_memset memset
#define __builtin_assume_aligned(pointer, bytes) (pointer)
#define __builtin_ctz(x) smear_plain_ctz(x)
#define __builtin_clz(x) smear_plain_clz(x)
#define __builtin_bswap16(x) ((uint16_t)((x) >> 8 | (x) << 8))
#define __builtin_trap() smear_plain_trap()

/* Counts the zeros below the lowest bit set of x > 0. */
static inline int smear_plain_ctz(uint32_t x)
{
    int n = 0;
    for (; (x & 1u) == 0; x >>= 1)
        n++;
    return n;
}

static inline int smear_plain_clz(uint32_t x)
{
    int n = 0;
    for (; x < 0x80000000u; x <<= 1)
        n++;
    return n;
}

/* Without an instruction that traps, a program stays where its promise was broken. */
static inline void smear_plain_trap(void)
{
    for (volatile int stopped = 1; stopped != 0;)
        continue;
}
#endif

/* Stops at once where a promise of the library itself, never of the caller, is broken; costs nothing when checks are
 * off. */
#if SMEAR_CHECK
#define SMEAR_ASSERT(condition) ((condition) ? (void)0 : __builtin_trap())
#define SMEAR_CHECKED 1
#else
#define SMEAR_ASSERT(condition) ((void)0)
#define SMEAR_CHECKED 0
#endif

/* Hints to the optimizer without an instruction of their own. What stands behind SMEAR_KEEP_BRANCH stays there: it is
 * neither computed in advance nor made of conditional stores. SMEAR_KEEP_VALUE has x computed as it is
 * written, in a register: the compiler doesn't know afterwards where its value came from. */
#if SMEAR_GNU
#define SMEAR_KEEP_BRANCH() __asm__ volatile ("")
#define SMEAR_KEEP_VALUE(x) __asm__("" : "+r"(x))
#define SMEAR_IS_CONSTANT(x) __builtin_constant_p(x)
#else
#define SMEAR_KEEP_BRANCH() ((void)0)
#define SMEAR_KEEP_VALUE(x) ((void)(x))
#define SMEAR_IS_CONSTANT(x) 0
#endif

#if defined(__cplusplus)
#define SMEAR_STATIC_ASSERT(condition, text) static_assert(condition, text)
#elif __STDC_VERSION__ >= 201112L
#define SMEAR_STATIC_ASSERT(condition, text) _Static_assert(condition, text)
#else
#define SMEAR_STATIC_ASSERT(condition, text) void smear_static_assert(int holds[(condition) ? 1 : -1])
#endif

/* Some method looks at more than the sharp instant: draws and cameras have other poses than that of now. */
#define SMEAR_BLURS (SMEAR_WITH_ACCUMULATE || SMEAR_WITH_RECONSTRUCT || SMEAR_WITH_SUBFRAMES)

SMEAR_STATIC_ASSERT((-1 >> 1) == -1, "right shift of a negative number must keep its sign");
SMEAR_STATIC_ASSERT(sizeof(int) == 4, "int products of 16-bit values must be 32 bits wide");

static inline int32_t min_i32(int32_t a, int32_t b) { return a < b ? a : b; }
static inline int32_t max_i32(int32_t a, int32_t b) { return a > b ? a : b; }
static inline uint32_t min_u32(uint32_t a, uint32_t b) { return a < b ? a : b; }
static inline uint32_t max_u32(uint32_t a, uint32_t b) { return a > b ? a : b; }
static inline int32_t abs_i32(int32_t a) { return a < 0 ? -a : a; }      /* not INT32_MIN */
static inline uint32_t magnitude_i32(int32_t a) { return a < 0 ? 0u - (uint32_t)a : (uint32_t)a; }

static inline int32_t clamp_i32(int32_t a, int32_t low, int32_t high)
{
    return a < low ? low : a > high ? high : a;
}

struct smear_arena {
    uint8_t *memory;            /* 8-byte aligned, or null to measure */
    size_t used;
};

/* Takes the next `count` x `size` bytes, 8-byte aligned; returns null while measuring. */
static inline void *arena_take(struct smear_arena *a, size_t count, size_t size)
{
    void *block = a->memory != NULL ? a->memory + a->used : NULL;
    a->used += (count * size + 7u) & ~(size_t)7u;
    return block;
}

/* Returns the CRC-32 of PNG and zlib of the bytes before, whose CRC is `crc` (0: there are none), and these (crc32.c). */
uint32_t smear_crc32(uint32_t crc, const uint8_t *bytes, uint32_t size);

#endif
