/* SPDX-License-Identifier: MIT */
/* front_cover_armv6m.h - front_cover in assembly for Cortex-M0 and M0+, for triangles whose corners and area a scan knows. */
#ifndef SMEAR_KERNELS_FRONT_COVER_ARMV6M_H
#define SMEAR_KERNELS_FRONT_COVER_ARMV6M_H

#include "kernels/front_cover.h"

#if TINY_COVER_ARMV6M

/* The first pixel that lies between A, B and C into A, how many there are into B. */
#define ARMV6M_FRONT_ORDER(A, B, C, KEEP, FETCH) \
    TINY_SPAN_ORDER(A, B, C, KEEP, FETCH)        \
    TINY_SPAN_PIXELS(A, B)                       \
    "subs " B ", " B ", " A "\n\t"

/* The box of the vertices r4, r7 and r5 point to, whose places lie 8 bytes further: its first pixel into r0 and r1, its size into r2
 * and r3. Goes to EMPTY where it is empty, to LARGE where it is large. */
#define ARMV6M_FRONT_BOX(EMPTY, LARGE)      \
    "ldr r0, [r4, #8]\n\t"    \
    "ldr r2, [r7, #8]\n\t"    \
    "ldr r3, [r5, #8]\n\t"    \
    ARMV6M_FRONT_ORDER("r0", "r2", "r3", "movs r6, r0\n\t", "movs r2, r6\n") \
    "beq " EMPTY "\n\t"              \
    "ldr r1, [r4, #12]\n\t"   \
    "ldr r3, [r7, #12]\n\t"   \
    "ldr r6, [r5, #12]\n\t"   \
    ARMV6M_FRONT_ORDER("r1", "r3", "r6", "mov r9, r1\n\t", "mov r3, r9\n") \
    "beq " EMPTY "\n\t"              \
    "cmp r2, #2\n\t"          \
    "bhi " LARGE "\n\t"              \
    "cmp r3, #2\n\t"          \
    "bhi " LARGE "\n\t"

/* Edge functions at the box's first centre into r0, r2 and r3, of the area in r8; x1, x2, y1 and y2 into r4 to r7. The box is kept on
 * the stack. */
#define ARMV6M_FRONT_EDGES        \
    "push {r0, r1, r2, r3}\n\t"   \
    "lsls r0, r0, #8\n\t"         \
    "lsls r1, r1, #8\n\t"         \
    "adds r0, #128\n\t"           \
    "adds r1, #128\n\t"           \
    "ldr r2, [r4, #8]\n\t"        \
    "ldr r3, [r4, #12]\n\t"       \
    "subs r0, r0, r2\n\t"         \
    "subs r1, r1, r3\n\t"         \
    "ldr r4, [r7, #8]\n\t"        \
    "ldr r6, [r7, #12]\n\t"       \
    "subs r4, r4, r2\n\t"         \
    "subs r6, r6, r3\n\t"         \
    "ldr r7, [r5, #12]\n\t"       \
    "ldr r5, [r5, #8]\n\t"        \
    "subs r7, r7, r3\n\t"         \
    "subs r5, r5, r2\n\t"         \
    "movs r2, r7\n\t"             \
    "muls r2, r0\n\t"             \
    "movs r3, r5\n\t"             \
    "muls r3, r1\n\t"             \
    "subs r2, r2, r3\n\t"         \
    "muls r1, r4\n\t"             \
    "muls r0, r6\n\t"             \
    "subs r3, r1, r0\n\t"         \
    "mov r0, r8\n\t"              \
    "subs r0, r0, r2\n\t"         \
    "subs r0, r0, r3\n\t"

/* With what decides centres on edges. */
#define ARMV6M_FRONT_BIASES  \
    "lsls r1, r7, #16\n\t"   \
    "subs r1, r1, r5\n\t"    \
    "subs r1, #1\n\t"        \
    "asrs r1, r1, #31\n\t"   \
    "adds r2, r2, r1\n\t"    \
    "lsls r1, r6, #16\n\t"   \
    "subs r1, r4, r1\n\t"    \
    "subs r1, #1\n\t"        \
    "asrs r1, r1, #31\n\t"   \
    "adds r3, r3, r1\n\t"    \
    "subs r1, r7, r6\n\t"    \
    "lsls r1, r1, #16\n\t"   \
    "subs r1, r1, r5\n\t"    \
    "adds r1, r1, r4\n\t"    \
    "mvns r1, r1\n\t"        \
    "asrs r1, r1, #31\n\t"   \
    "adds r0, r0, r1\n\t"

/* Their steps to the right into r12, r8 and r9; x1 and x2 onto the stack. Edge functions into r0, r5 and r6, the first pixel into r2
 * and r3, where pixels go into r1: 8 bytes into what lr points to. */
#define ARMV6M_FRONT_START   \
    "lsls r7, r7, #8\n\t"    \
    "mov r8, r7\n\t"         \
    "lsls r6, r6, #8\n\t"    \
    "subs r7, r6, r7\n\t"    \
    "mov r12, r7\n\t"        \
    "negs r6, r6\n\t"        \
    "mov r9, r6\n\t"         \
    "push {r4, r5}\n\t"      \
    "movs r5, r2\n\t"        \
    "movs r6, r3\n\t"        \
    "ldr r2, [sp, #8]\n\t"   \
    "ldr r3, [sp, #12]\n\t"  \
    "mov r1, lr\n\t"         \
    "adds r1, #8\n\t"

/* Keeps the pixel if no edge function is negative. */
#define ARMV6M_FRONT_TEST(LABEL) \
    "movs r7, r0\n\t"            \
    "orrs r7, r5\n\t"            \
    "orrs r7, r6\n\t"            \
    "bmi " LABEL "f\n\t"         \
    "stm r1!, {r2, r3, r5, r6}\n" LABEL ": "

#define ARMV6M_FRONT_RIGHT \
    "add r0, r12\n\t"      \
    "add r5, r8\n\t"       \
    "add r6, r9\n\t"       \
    "adds r2, #1\n\t"

/* How many pixels are covered into r6; `eq` where there are none. */
#define ARMV6M_FRONT_PIXELS ARMV6M_FRONT_TEST("1") \
    "ldr r4, [sp, #16]\n\t" \
    "cmp r4, #1\n\t" \
    "beq 3f\n\t" \
    "push {r0, r5, r6}\n\t" ARMV6M_FRONT_RIGHT ARMV6M_FRONT_TEST("2") \
    "subs r2, #1\n\t" \
    "pop {r0, r5, r6}\n" \
    "3: ldr r7, [sp, #20]\n\t" \
    "cmp r7, #1\n\t" \
    "beq 5f\n\t" \
    "ldr r7, [sp]\n\t" \
    "lsls r7, r7, #8\n\t" \
    "adds r6, r6, r7\n\t" \
    "subs r0, r0, r7\n\t" \
    "ldr r7, [sp, #4]\n\t" \
    "lsls r7, r7, #8\n\t" \
    "subs r5, r5, r7\n\t" \
    "adds r0, r0, r7\n\t" \
    "adds r3, #1\n\t" ARMV6M_FRONT_TEST("4") \
    "cmp r4, #1\n\t" \
    "beq 5f\n\t" ARMV6M_FRONT_RIGHT ARMV6M_FRONT_TEST("5") \
    "add sp, #8\n\t" \
    "mov r0, lr\n\t" \
    "subs r1, r1, r0\n\t" \
    "subs r1, #8\n\t" \
    "lsrs r6, r1, #4\n\t"

/* Keeps the box in r0 to r3 as a pair of pairs. */
#define ARMV6M_FRONT_KEEP    \
    "adds r2, r2, r0\n\t"    \
    "adds r3, r3, r1\n\t"    \
    "lsls r1, r1, #16\n\t"   \
    "orrs r0, r1\n\t"        \
    "lsls r3, r3, #16\n\t"   \
    "orrs r2, r3\n\t"        \
    "mov r1, lr\n\t"         \
    "str r0, [r1, #72]\n\t"  \
    "str r2, [r1, #76]\n\t"

#endif

#endif
