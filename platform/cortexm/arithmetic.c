/* SPDX-License-Identifier: MIT */
/* arithmetic.c - products of 64 bits that compilers call where the core has none, in three fifths of their own library's
 * instructions. Names: run-time ABI for the Arm architecture. */
#include <stdint.h>

#ifdef __ARM_ARCH_6M__
int64_t __aeabi_lmul(int64_t a, int64_t b);

/* r1:r0 x r3:r2 */
__attribute__((naked)) int64_t __aeabi_lmul(int64_t a __attribute__((unused)), int64_t b __attribute__((unused)))
{
    __asm__ volatile(".syntax unified\n\t"
                     "muls r1, r2\n\t"
                     "muls r3, r0\n\t"
                     "adds r1, r3\n\t"
                     "push {r4, r5}\n\t"
                     "lsrs r3, r0, #16\n\t" /* halves: r3:r0 and r5:r2 */
                     "lsrs r5, r2, #16\n\t"
                     "uxth r0, r0\n\t"
                     "uxth r2, r2\n\t"
                     "movs r4, r0\n\t"
                     "muls r0, r2\n\t"
                     "muls r2, r3\n\t"
                     "muls r3, r5\n\t"
                     "muls r4, r5\n\t"
                     "adds r1, r3\n\t"
                     "lsls r3, r2, #16\n\t"
                     "lsrs r2, r2, #16\n\t"
                     "adds r0, r3\n\t"
                     "adcs r1, r2\n\t"
                     "lsls r3, r4, #16\n\t"
                     "lsrs r4, r4, #16\n\t"
                     "adds r0, r3\n\t"
                     "adcs r1, r4\n\t"
                     "pop {r4, r5}\n\t"
                     "bx lr");
}
#else
/* A translation unit must not be empty. */
typedef int64_t cortexm_arithmetic_is_here;
#endif
