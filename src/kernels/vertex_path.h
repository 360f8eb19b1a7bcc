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

/* A vertex at an instant: x, y and depth, and up to three words more. */
struct path_record {
    int32_t word[6];
};

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

/* The product of r3 and the part, over 2^16, in r3; r4 is used up. Of both halves rounded down each, which is that of all. */
#define PATH_TIMES_HIGH                 \
    "uxth r4, r3\n\t"                   \
    "muls r4, r7\n\t"                   \
    "asrs r4, r4, #16\n\t"              \
    "asrs r3, r3, #16\n\t"              \
    "muls r3, r7\n\t"                   \
    "adds r3, r3, r4\n\t"

/* A coordinate of the vertex at r1, whose places are at r2, which is stored and added to the range in LOW and HIGH. As a product of 32
 * bits holds the curvature's, and shifts one after the other are one. */
#define PATH_NEAR(at, close, LOW, HIGH) \
    "ldr r3, [r2, #" #at "]\n\t"        \
    "ldr r6, [r2, #" #close "]\n\t"     \
    "ldr r5, [r1, #" #at "]\n\t"        \
    "adds r4, r3, r6\n\t"               \
    "subs r6, r6, r3\n\t"               \
    "lsls r6, r6, #6\n\t"               \
    "subs r3, r4, r5\n\t"               \
    "subs r3, r3, r5\n\t"               \
    "muls r3, r7\n\t"                   \
    "asrs r3, r3, #9\n\t"               \
    "adds r3, r3, r6\n\t"               \
    PATH_TIMES_HIGH                     \
    "adds r3, #32\n\t"                  \
    "asrs r3, r3, #6\n\t"               \
    "adds r3, r3, r5\n\t"               \
    "str r3, [r0, #" #at "]\n\t"        \
    "cmp r3, " LOW "\n\t"               \
    "bge 2f\n\t"                        \
    "mov " LOW ", r3\n"                 \
    "2: cmp r3, " HIGH "\n\t"           \
    "ble 3f\n\t"                        \
    "mov " HIGH ", r3\n"                \
    "3: "

/* Its depth likewise: path_depth. */
#define PATH_DEPTH_THERE \
    "ldr r3, [r2, #8]\n\t" \
    "ldr r6, [r2, #20]\n\t" \
    "ldr r5, [r1, #8]\n\t" \
    "adds r4, r3, r6\n\t" \
    "lsrs r4, r4, #1\n\t" \
    "subs r6, r6, r3\n\t" \
    "asrs r6, r6, #3\n\t" \
    "subs r3, r4, r5\n\t" \
    PATH_TIMES_HIGH \
    "asrs r3, r3, #1\n\t" \
    "adds r3, r3, r6\n\t" \
    "lsls r3, r3, #2\n\t" \
    PATH_TIMES_HIGH \
    "asrs r3, r3, #1\n\t" \
    "lsls r3, r3, #2\n\t" \
    "adds r3, r3, r5\n\t" \
    "str r3, [r0, #8]\n\t"

/* Three vertices, of which `vertex` has the first words from `base` on, like vertex_path_armv6m, and the box of their x and y: the
 * least of both, and the largest. Curvatures, open + close - 2 middle, are less than 2^16. Half of the instructions of compilers. */
static inline void triangle_path_armv6m(int32_t box[4], struct path_record out[3], const int32_t *base, const uint16_t vertex[3],
                                        int motion, int32_t part)
{
    register struct path_record *r0 __asm__("r0") = out;
    register const uint16_t *r1 __asm__("r1") = vertex;
    register const int32_t *r2 __asm__("r2") = base;
    register int r3 __asm__("r3") = 4 * motion;
    register int32_t *r4 __asm__("r4") = box;
    register int32_t r7 __asm__("r7") = part;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r2, r4}\n\t"
        "mov r12, r1\n\t"
        "mov lr, r3\n\t"
        "movs r3, #1\n\t"
        "lsls r3, r3, #31\n\t"
        "mov r10, r3\n\t"
        "mov r11, r3\n\t"
        "mvns r3, r3\n\t"
        "mov r8, r3\n\t"
        "mov r9, r3\n\t"
        "movs r3, r0\n\t"
        "adds r3, #72\n\t"
        "push {r3}\n"
        "1: mov r3, r12\n\t"
        "ldrh r1, [r3]\n\t"
        "adds r3, #2\n\t"
        "mov r12, r3\n\t"
        "ldr r2, [sp, #4]\n\t"
        "lsls r1, r1, #2\n\t"
        "adds r1, r1, r2\n\t"
        "mov r2, lr\n\t"
        "adds r2, r2, r1\n\t"
        PATH_NEAR(0, 12, "r8", "r10")
        PATH_NEAR(4, 16, "r9", "r11")
        PATH_DEPTH_THERE
        "adds r0, #24\n\t"
        "ldr r3, [sp]\n\t"
        "cmp r0, r3\n\t"
        "bne 1b\n\t"
        "pop {r3}\n\t"
        "pop {r2, r4}\n\t"
        "mov r0, r8\n\t"
        "mov r1, r9\n\t"
        "mov r2, r10\n\t"
        "mov r3, r11\n\t"
        "stm r4!, {r0, r1, r2, r3}"
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4)
        : "r"(r7)
        : "r5", "r6", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
/* clang-format on */
#endif

#endif
