/* SPDX-License-Identifier: MIT */
/* avx2.h - eight words or sixteen halves at once on x86 processors that have AVX2 and BMI2, which a program finds out
 * where it runs: everybody's build draws by them, and still starts on a processor without.
 *
 * A variant NAME_avx2 is a function of its own, marked SMEAR_AVX2_FUNCTION: the compiler takes these instructions in it and
 * in what it inlines there, but inlines it nowhere else. So it stands for enough work to be called for: a
 * triangle's rows, not one pixel. NAME asks smear_has_avx2() first. Helpers of such functions are so marked, too: small
 * ones SMEAR_AVX2_INLINE, those that a compiler may leave alone `static inline SMEAR_AVX2_FUNCTION`. What they are written
 * in is lanes8.h. -DSMEAR_AVX2=0 leaves them all out, and so does -funsigned-char, by which GCC 12 takes every mask
 * of _mm256_blendv_epi8 for one that chooses nothing. */
#ifndef SMEAR_AVX2_H
#define SMEAR_AVX2_H

#include "kernels/vector.h"

#ifndef SMEAR_AVX2
#if SMEAR_VECTORS && defined(__x86_64__) && !defined(__OPTIMIZE_SIZE__) && !defined(__CHAR_UNSIGNED__)
#define SMEAR_AVX2 1
#else
#define SMEAR_AVX2 0
#endif
#endif

#if SMEAR_AVX2
#include <immintrin.h>

#define SMEAR_AVX2_FUNCTION __attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt")))
#if SMEAR_INLINE_FORCED
#define SMEAR_AVX2_INLINE static inline __attribute__((always_inline)) SMEAR_AVX2_FUNCTION
#else
#define SMEAR_AVX2_INLINE static inline SMEAR_AVX2_FUNCTION
#endif

/* Whether this processor has them; some instructions, no call. */
static inline bool smear_has_avx2(void)
{
#if defined(__AVX2__) && defined(__BMI2__)
    return true;
#else
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
#endif
}
#else
static inline bool smear_has_avx2(void) { return false; }
#endif

#endif
