/* SPDX-License-Identifier: MIT */
/* vertex_path.h - a vertex on its path: geometry/path.h in assembly. */
#ifndef SMEAR_KERNELS_VERTEX_PATH_H
#define SMEAR_KERNELS_VERTEX_PATH_H

#include "kernels/kernels.h"

#ifdef __OPTIMIZE_SIZE__
#define PATH_ASM_ARMV6M 0
#else
#define PATH_ASM_ARMV6M SMEAR_ASM_ARMV6M
#endif

#if PATH_ASM_ARMV6M
/* clang-format off */
/* phase_times of r3, the product in r3; r4 is used up. */
#define PATH_TIMES_PART                 \
    "uxth r4, r3\n\t"                   \
    "muls r4, %[part]\n\t"              \
    "asrs r4, r4, #16\n\t"              \
    "asrs r3, r3, #16\n\t"              \
    "muls r3, %[part]\n\t"              \
    "adds r3, r3, r4\n\t"               \
    "asrs r3, r3, #1\n\t"

/* path_coordinate of the words at `at`, which are at `close` behind those of `open`. */
#define PATH_COORDINATE(at, close)              \
    "ldr r3, [%[open], #" #at "]\n\t"           \
    "ldr r6, [%[open], #" #close "]\n\t"        \
    "ldr r5, [%[middle], #" #at "]\n\t"         \
    "adds r4, r3, r6\n\t"                       \
    "subs r6, r6, r3\n\t"                       \
    "lsls r6, r6, #6\n\t"                       \
    "subs r3, r4, r5\n\t"                       \
    "subs r3, r3, r5\n\t"                       \
    "lsls r3, r3, #8\n\t"                       \
    PATH_TIMES_PART                             \
    "adds r3, r3, r6\n\t"                       \
    "lsls r3, r3, #3\n\t"                       \
    PATH_TIMES_PART                             \
    "adds r3, #128\n\t"                         \
    "asrs r3, r3, #8\n\t"                       \
    "adds r3, r3, r5\n\t"                       \
    "str r3, [%[out], #" #at "]\n\t"

/* x, y and depth of a vertex, whose places in the middle, at open and, behind those, at close are three words each, at
 * u >> 15 = `part`, -32768 .. 32768. Compilers take half as many instructions again. */
static inline void vertex_path_armv6m(int32_t *out, const int32_t *middle, const int32_t *open, int32_t part)
{
    __asm__ volatile(
        ".syntax unified\n\t"
        PATH_COORDINATE(0, 12)
        PATH_COORDINATE(4, 16)
        "ldr r3, [%[open], #8]\n\t"
        "ldr r6, [%[open], #20]\n\t"
        "ldr r5, [%[middle], #8]\n\t"
        "adds r4, r3, r6\n\t"
        "lsrs r4, r4, #1\n\t"
        "subs r6, r6, r3\n\t"
        "asrs r6, r6, #3\n\t"
        "subs r3, r4, r5\n\t"
        PATH_TIMES_PART
        "adds r3, r3, r6\n\t"
        "lsls r3, r3, #2\n\t"
        PATH_TIMES_PART
        "lsls r3, r3, #2\n\t"
        "adds r3, r3, r5\n\t"
        "str r3, [%[out], #8]\n\t"
        :
        : [out] "l"(out), [middle] "l"(middle), [open] "l"(open), [part] "l"(part)
        : "r3", "r4", "r5", "r6", "cc", "memory");
}
/* clang-format on */
#endif

#endif
