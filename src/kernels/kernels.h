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
 *   - NAME itself, which the library calls: the best variant of this build, else the reference. bind.h says which that is.
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

#endif
