/* SPDX-License-Identifier: MIT */
/* kernels.h - inner loops that have more than one form, and how to add one.
 *
 * Every loop that has a vector or assembly form stands in this room. Kernels take pointers, strides, counts
 * and small structs, never a context, a target or a window; they know nothing of the stages that call them.
 *
 * A kernel NAME consists of
 *   - its contract, the comment above it: shapes, ranges, alignment, what may overlap, rounding;
 *   - NAME_reference, a short scalar loop that defines the result bit for bit;
 *   - its variants, beside the reference: NAME_lanes or NAME_vector where SMEAR_VECTORS is set, NAME_armv6m where
 *     SMEAR_ASM_ARMV6M is, NAME_armv7em where SMEAR_ASM_ARMV7EM is, NAME_arm where SMEAR_ASM_ARM is, NAME_unrolled
 *     where plain C that compilers turn into better code pays on every core;
 *   - NAME itself, which the library calls: the best variant of this build, else the reference.
 *
 * How to add one
 *   1. src/kernels/FAMILY.h holds related kernels as `static inline` functions (SMEAR_INLINE where callers pass
 *      constants). What is long or called from several files is declared there with the prefix smear_ and defined
 *      in src/kernels/FAMILY.c; what a build does not call, its linker leaves out (--gc-sections).
 *   2. tests/kernels/FAMILY.c describes each kernel for check_kernels (tests/kernels/kernels.h): the planes of pixels it
 *      takes, what makes random data fit its contract, and a call of each form. The Makefile finds the file.
 *   3. `make check-kernels` compares every variant of this machine with its reference, in all lengths up to two
 *      vectors and three, at all alignments, on random and extreme data with guarded outputs, and prints
 *      nanoseconds a pixel of each form. `make TARGET=cortex-m0plus target-test` does the comparison for that
 *      core, and so does every other target that runs unit tests.
 *   4. A variant stays only if a whole frame gains 2 % by it: ledger.md says how much. */
#ifndef SMEAR_KERNELS_H
#define SMEAR_KERNELS_H

#include "kernels/vector.h"

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

#endif
