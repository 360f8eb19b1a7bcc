/* SPDX-License-Identifier: MIT */
/* bind.h - names the machine of this build once: the only file outside of kernels that asks for a CPU, or whether size counts. Others
 * ask by a plain `if` for the constants below, each 0 or 1, and call kernels by names that are bound here to their form. It lies below
 * all rooms and includes the configuration alone; the kernel that base needs stands at its end. */
#ifndef SMEAR_KERNELS_BIND_H
#define SMEAR_KERNELS_BIND_H

#include <stdint.h>

#include "smear_config.h"

/* ------------------------------------------------------------------ the compiler */

/* 1 where the compiler has the builtins, attributes and inline assembly of GCC and Clang. 0 is plain C99, with the same
 * bits: what other compilers lack is written out in base.h under the same names. */
#ifndef SMEAR_GNU
#ifdef __GNUC__
#define SMEAR_GNU 1
#else
#define SMEAR_GNU 0
#endif
#endif

/* 1 where the first byte of a word is its highest. Compilers that do not tell are taken to be little-endian. */
#ifndef SMEAR_BIG_ENDIAN
#if defined(__BYTE_ORDER__) && defined(__ORDER_BIG_ENDIAN__)
#define SMEAR_BIG_ENDIAN (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
#else
#define SMEAR_BIG_ENDIAN 0
#endif
#endif

/* ------------------------------------------------------------------ the core */

/* Four words or eight halves at once. */
#ifndef SMEAR_VECTORS
#if SMEAR_GNU && !SMEAR_BIG_ENDIAN && (defined(__SSE2__) || defined(__ARM_NEON) || defined(__wasm_simd128__))
#define SMEAR_VECTORS 1
#else
#define SMEAR_VECTORS 0
#endif
#endif

/* Assembly for ARMv6-M (Cortex-M0 and M0+), whose eight general registers compilers use badly. It keeps all of
 * them busy, frame pointers included: builds without optimization need those, and Clang sets r7 aside for them. */
#ifndef SMEAR_ASM_ARMV6M
#if SMEAR_GNU && !defined(__clang__) && defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__)
#define SMEAR_ASM_ARMV6M 1
#else
#define SMEAR_ASM_ARMV6M 0
#endif
#endif

/* Assembly for ARMv7E-M (Cortex-M4, M7), whose products of halves and of words compilers use badly. Not for Clang, which sets r7
 * aside, nor where size counts. */
#ifndef SMEAR_ASM_ARMV7EM
#if SMEAR_GNU && !defined(__clang__) && defined(__ARM_ARCH_7EM__) && defined(__thumb2__) && defined(__ARM_FEATURE_DSP) \
    && defined(__ARM_FEATURE_UNALIGNED) && !defined(__ARM_BIG_ENDIAN) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#define SMEAR_ASM_ARMV7EM 1
#else
#define SMEAR_ASM_ARMV7EM 0
#endif
#endif

/* Assembly in ARM code for ARM7TDMI and what else runs it without vectors. Not for Clang, which knows another syntax. */
#ifndef SMEAR_ASM_ARM
#if SMEAR_GNU && !defined(__clang__) && defined(__arm__) && !defined(__thumb__) && defined(__OPTIMIZE__) && !SMEAR_VECTORS \
    && !SMEAR_BIG_ENDIAN
#define SMEAR_ASM_ARM 1
#else
#define SMEAR_ASM_ARM 0
#endif
#endif

/* ARMv6-M: no wide products, eight registers, constants and offsets of few bits. Its flash has no room for a loop of each kind. */
#ifdef __ARM_ARCH_6M__
#define SMEAR_ON_ARMV6M 1
#else
#define SMEAR_ON_ARMV6M 0
#endif

/* ARM7TDMI: fast memory of a few kB. */
#ifdef __ARM_ARCH_4T__
#define SMEAR_ON_ARMV4T 1
#else
#define SMEAR_ON_ARMV4T 0
#endif

/* A page, which is loaded before it is seen. */
#ifdef __wasm__
#define SMEAR_ON_WASM 1
#else
#define SMEAR_ON_WASM 0
#endif

/* Triangles are looked at by fours, whose vertices lie in an array. */
#ifndef SMEAR_PLACES
#define SMEAR_PLACES (SMEAR_VECTORS && !SMEAR_FAST_STACK)
#endif

/* 1 where words of 64 bits are those of the core. */
#define SMEAR_ON_64 (UINTPTR_MAX > 0xffffffffu)

/* Clang would call functions that are nowhere for atomic words of ARMv6-M (jobs.h). */
#if SMEAR_GNU && defined(__clang__) && defined(__ARM_ARCH_6M__) && !defined(SMEAR_BARRIER)
#define SMEAR_BARRIER __asm__ volatile ("dmb" : : : "memory")
#endif

/* Cores can add to a word that they share: not where nobody but the program knows whether they watch each other's exclusive
 * accesses (ARMv7-M and later). */
#ifndef SMEAR_CLAIMS
#if SMEAR_GNU && defined(__GCC_ATOMIC_INT_LOCK_FREE) && __GCC_ATOMIC_INT_LOCK_FREE == 2 \
    && !(defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M')
#define SMEAR_CLAIMS 1
#else
#define SMEAR_CLAIMS 0
#endif
#endif

/* ------------------------------------------------------------------ size */

/* 1 where this file is compiled to be small. */
#ifdef __OPTIMIZE_SIZE__
#define SMEAR_SMALL_FILE 1
#else
#define SMEAR_SMALL_FILE 0
#endif

/* All files of a build agree on what is left out for size. */
#ifndef SMEAR_SMALL_CODE
#define SMEAR_SMALL_CODE SMEAR_SMALL_FILE
#endif

/* Setups of triangles are kept from row to row, where there is memory: 0.2 kB of code. */
#ifndef SMEAR_RASTER_CACHE
#define SMEAR_RASTER_CACHE (!SMEAR_SMALL_FILE)
#endif

/* Sharp frames without dither are drawn as the display's pixels, where that pays: 0.9 kB. */
#ifndef SMEAR_DIRECT
#define SMEAR_DIRECT (!SMEAR_SMALL_FILE)
#endif

/* Flat colours and copied texels have rows of their own: twice to four times as fast, of the same bits, and 3.4 kB larger. */
#ifndef SMEAR_SPAN_ROWS
#define SMEAR_SPAN_ROWS (!SMEAR_SMALL_FILE)
#endif

/* Textured triangles are drawn from the front (kept.h): not in a page or in the GBA's fast memory. */
#define SMEAR_FRONT_ORDER (SMEAR_RASTER_CACHE && SMEAR_WITH_TEXTURE && !SMEAR_ON_WASM && !SMEAR_ON_ARMV4T)

/* Inner loops that take constants are inlined, so that each call becomes a loop of its own, unless size counts. Builds that
 * look for faults do without: what a compiler adds for them to hundreds of such loops takes it minutes. */
#ifndef SMEAR_INLINE_FORCED
#if SMEAR_CHECK || !defined(__OPTIMIZE__)
#define SMEAR_INLINE_FORCED 0
#else
#define SMEAR_INLINE_FORCED 1
#endif
#endif
#if SMEAR_GNU && SMEAR_INLINE_FORCED
#define SMEAR_INLINE_ALWAYS static inline __attribute__((always_inline))
#else
#define SMEAR_INLINE_ALWAYS static inline
#endif
#if SMEAR_GNU
#define SMEAR_NOINLINE __attribute__((noinline))
#define SMEAR_CALLED static __attribute__((noinline, unused))       /* of a header, which some files call */
#else
#define SMEAR_NOINLINE
#define SMEAR_CALLED static inline
#endif

/* SMEAR_RARE: a function of its own unless size counts: what is rarely called, or once and would keep on the stack what others need. */
#if SMEAR_SMALL_FILE
#define SMEAR_INLINE static inline
#define SMEAR_RARE
#else
#define SMEAR_INLINE SMEAR_INLINE_ALWAYS
#define SMEAR_RARE SMEAR_NOINLINE
#endif

/* Helpers of fixed.h and fixmath.h take many instructions on cores without wide products: where size counts, fixmath.c
 * has one copy of each; else they are inlined. */
#if SMEAR_SMALL_FILE && !SMEAR_HAS_MUL64
#define SMEAR_ONE_COPY 1
#define SMEAR_SHARED
#define mulh_i32 smear_mulh_i32
#define mulh_u32 smear_mulh_u32
#define scale_sat smear_scale_sat
#define narrow_sat smear_narrow_sat
#define mul_wide smear_mul_wide
#define cross_wide smear_cross_wide
#define dot_wide smear_dot_wide
#define count_leading_zeros smear_count_leading_zeros
#define count_leading_zeros_64 smear_count_leading_zeros_64
#define recip_norm smear_recip_norm
#define recip_norm_precise smear_recip_norm_precise
#define ratio_q30 smear_ratio_q30
#define sqrt_floor_64 smear_sqrt_floor_64
#define sqrt_q3 smear_sqrt_of_q3
#define transform_vertex smear_transform_vertex
#define project smear_project
#define outcode_sides smear_outcode_sides
#define placement_project smear_placement_project
#define placement_project_any smear_placement_project
#else
#define SMEAR_ONE_COPY 0
#define SMEAR_SHARED static inline
#define transform_vertex transform_inline
#define project project_inline
#define outcode_sides outcode_sides_inline
#define placement_project placement_project_inline
#define placement_project_any placement_project_any_inline
#endif
#define SMEAR_COPY_ELSEWHERE (SMEAR_ONE_COPY && !SMEAR_COPY_IS_HERE)

/* Functions of several products of 64 bits, which are calls where those take many instructions. */
#if SMEAR_HAS_MUL64
#define SMEAR_PRODUCT_CALL inline
#else
#define SMEAR_PRODUCT_CALL SMEAR_NOINLINE
#endif

/* ------------------------------------------------------------------ what pays on this core */

/* A face's light takes longer than asking whether the face before has the same, and roots of 64 bits take twice as long as those of
 * 48. */
#define SMEAR_LIGHT_IS_DEAR (!SMEAR_SMALL_FILE && (SMEAR_ON_ARMV6M || SMEAR_ON_ARMV4T))

/* Rows of pixels are converted several at once: not where a row's pixels take longer than what there is around them. */
#define SMEAR_ROWS_AT_ONCE \
    (!SMEAR_VECTORS && !SMEAR_SMALL_FILE && !SMEAR_ON_WASM && (SMEAR_WITH_RGB || SMEAR_WITH_RGB565))

/* Of sharp rows, only what was drawn is converted and cleared: not where assembly takes all of several rows at once. */
#define SMEAR_STAYS_CLEAR (!SMEAR_SMALL_CODE && !SMEAR_ASM_ARMV6M && !SMEAR_ASM_ARMV7EM && !SMEAR_ASM_ARM)

/* Functions that have one copy where fast memory has no room for more. */
#if SMEAR_ASM_ARM
#define SMEAR_COPY SMEAR_NOINLINE
#define SMEAR_INLINE_COPY static SMEAR_NOINLINE
#else
#define SMEAR_COPY inline
#define SMEAR_INLINE_COPY SMEAR_INLINE
#endif

/* ------------------------------------------------------------------ kernels */

#if SMEAR_ON_ARMV6M && SMEAR_GNU
#define mulh_i32_narrow mulh_i32_armv6m
#define mulh_u32_narrow mulh_u32_armv6m
#else
#define mulh_i32_narrow mulh_i32_reference
#define mulh_u32_narrow mulh_u32_reference
#endif

/* TEXEL_BLOCKS: several blocks of copied texels along a row are one. */
#define TEXEL_BLOCKS SMEAR_ASM_ARMV7EM

/* TEXEL_CURVE_ROWS where rows of copied texels whose places are polynomials, one below the other, are a kernel: compilers have no
 * registers for what rows have in common. */
#define TEXEL_CURVE_ROWS (SMEAR_ASM_ARMV6M || SMEAR_ASM_ARMV7EM)

/* ------------------------------------------------------------------ high words of products, from products of 16 bits */

/* Returns the high word of the signed product: a = ah 2^16 + al, likewise b. |ah bl| <= 2^15 (2^16 - 1): what is added to it has 16 bits
 * and fits. */
static inline int32_t mulh_i32_reference(int32_t a, int32_t b)
{
    const int32_t ah = a >> 16, bh = b >> 16;
    const uint32_t al = (uint32_t)a & 0xffffu, bl = (uint32_t)b & 0xffffu;
    const int32_t middle = ah * (int32_t)bl + (int32_t)(al * bl >> 16);
    const int32_t other = (int32_t)al * bh + (int32_t)((uint32_t)middle & 0xffffu);
    return ah * bh + (middle >> 16) + (other >> 16);
}

/* Returns the high word of the unsigned product. */
static inline uint32_t mulh_u32_reference(uint32_t a, uint32_t b)
{
    const uint32_t ah = a >> 16, bh = b >> 16, al = a & 0xffffu, bl = b & 0xffffu;
    const uint32_t middle = ah * bl + (al * bl >> 16), other = al * bh + (middle & 0xffffu);
    return ah * bh + (middle >> 16) + (other >> 16);
}

/* The high word of a product on ARMv6-M, where ASR and LSR take upper halves of signed and unsigned words: 17 instructions, of
 * which compilers make 20 to 26. Takes a and b apart, and three registers more. */
#if SMEAR_ON_ARMV6M && SMEAR_GNU
#define MULH_ARMV6M(SHIFT, A, B, LOW_A, LOW_B, MIDDLE) \
    __asm__(".syntax unified\n\t" \
            "uxth %[al], %[a]\n\t" \
            SHIFT " %[a], %[a], #16\n\t" \
            "uxth %[bl], %[b]\n\t" \
            SHIFT " %[b], %[b], #16\n\t" \
            "movs %[m], %[al]\n\t" \
            "muls %[m], %[bl]\n\t" \
            "lsrs %[m], %[m], #16\n\t" \
            "muls %[bl], %[a]\n\t" \
            "adds %[m], %[m], %[bl]\n\t" \
            "muls %[al], %[b]\n\t" \
            "uxth %[bl], %[m]\n\t" \
            "adds %[al], %[al], %[bl]\n\t" \
            SHIFT " %[al], %[al], #16\n\t" \
            "muls %[a], %[b]\n\t" \
            SHIFT " %[m], %[m], #16\n\t" \
            "adds %[a], %[a], %[m]\n\t" \
            "adds %[a], %[a], %[al]" \
            : [a] "+l"(A), [b] "+l"(B), [al] "=&l"(LOW_A), [bl] "=&l"(LOW_B), [m] "=&l"(MIDDLE) : : "cc")

SMEAR_INLINE_ALWAYS int32_t mulh_i32_armv6m(int32_t a, int32_t b)
{
    uint32_t low_a, low_b, middle;
    MULH_ARMV6M("asrs", a, b, low_a, low_b, middle);
    return a;
}

SMEAR_INLINE_ALWAYS uint32_t mulh_u32_armv6m(uint32_t a, uint32_t b)
{
    uint32_t low_a, low_b, middle;
    MULH_ARMV6M("lsrs", a, b, low_a, low_b, middle);
    return a;
}
#endif

#endif
