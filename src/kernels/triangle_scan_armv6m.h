/* SPDX-License-Identifier: MIT */
/* triangle_scan_armv6m.h - triangle_scan in assembly for Cortex-M0 and M0+. */
#ifndef SMEAR_KERNELS_TRIANGLE_SCAN_ARMV6M_H
#define SMEAR_KERNELS_TRIANGLE_SCAN_ARMV6M_H

#include "kernels/front_cover_armv6m.h"
#include "kernels/tiny_points.h"
#include "kernels/vertices.h"

#if TINY_COVER_ARMV6M

/* What does not change: the end into r8, `side` into r9 and twice that into lr, from the scan in r0. */
#define TRIANGLE_SCAN_LOAD  \
    "ldr r1, [r0, #44]\n\t" \
    "mov r8, r1\n\t"        \
    "ldr r1, [r0, #92]\n\t" \
    "mov r9, r1\n\t"        \
    "adds r1, r1, r1\n\t"   \
    "mov lr, r1\n\t"

/* Tags of the triangle whose first index r0 points to into r1, r2 and r3, its entries into r4, r7 and r5. */
#define TRIANGLE_SCAN_ENTRIES \
    "ldrh r1, [r0]\n\t"       \
    "mov r7, r11\n\t"         \
    "ldm r7!, {r3, r4}\n\t"   \
    "ldrh r2, [r0, r3]\n\t"   \
    "ldrh r3, [r0, r4]\n\t"   \
    "ldm r7!, {r4, r5, r6}\n\t" \
    "orrs r1, r4\n\t"         \
    "orrs r2, r4\n\t"         \
    "orrs r3, r4\n\t"         \
    "movs r0, #40\n\t"        \
    "movs r4, r1\n\t"         \
    "ands r4, r5\n\t"         \
    "muls r4, r0\n\t"         \
    "adds r4, r4, r6\n\t"     \
    "movs r7, r2\n\t"         \
    "ands r7, r5\n\t"         \
    "muls r7, r0\n\t"         \
    "adds r7, r7, r6\n\t"     \
    "ands r5, r3\n\t"         \
    "muls r5, r0\n\t"         \
    "adds r5, r5, r6\n\t"

/* Twice the area of a triangle within the frame into r1; on to 24 where it needs more than 32 bits. */
#define TRIANGLE_SCAN_AREA  \
    "ldr r0, [r4, #8]\n\t"  \
    "ldr r1, [r7, #8]\n\t"  \
    "ldr r2, [r5, #8]\n\t"  \
    "subs r1, r1, r0\n\t"   \
    "subs r2, r2, r0\n\t"   \
    "mov r3, r9\n\t"        \
    "adds r0, r1, r3\n\t"   \
    "adds r3, r3, r2\n\t"   \
    "orrs r0, r3\n\t"       \
    "cmp r0, lr\n\t"        \
    "bhs 24f\n\t"           \
    "ldr r0, [r4, #12]\n\t" \
    "ldr r3, [r7, #12]\n\t" \
    "ldr r6, [r5, #12]\n\t" \
    "subs r3, r3, r0\n\t"   \
    "subs r6, r6, r0\n\t"   \
    "muls r1, r6\n\t"       \
    "muls r2, r3\n\t"       \
    "subs r1, r1, r2\n\t"

/* The vertex of the tag in r0, for the entry in r6, into the cache; then on to 30, as entries for v[0] are found first. r1 to r7
 * are kept. */
#define TRIANGLE_SCAN_FIND                                     \
    "16: push {r0, r1, r2, r3, r4, r5, r6, r7}\n\t"            \
    "mov r12, r0\n\t"                                          \
    "mov r1, r11\n\t"                                          \
    "ldr r2, [r1, #28]\n\t"                                    \
    "uxth r0, r0\n\t"                                          \
    "cmp r0, r2\n\t"                                           \
    "bhs 26b\n\t"                                              \
    "ldr r2, [r1, #24]\n\t"                                    \
    "lsls r3, r0, #1\n\t"                                      \
    "adds r0, r0, r3\n\t"                                      \
    "lsls r0, r0, #1\n\t"                                      \
    "adds r0, r0, r2\n\t"                                      \
    "ldr r1, [r1, #20]\n\t" ARMV6M_VERTEX_ROWS                 \
    "ldr r3, [sp, #24]\n\t"                                    \
    "adds r3, #24\n\t" ARMV6M_VERTEX_NOW ARMV6M_VERTEX_FIND    \
    "ldr r7, [sp, #24]\n\t"                                    \
    "mov r2, r12\n\t"                                          \
    "movs r3, #0\n\t"                                          \
    "stm r7!, {r2, r3, r4, r5, r6}\n\t"                        \
    "str r3, [r7]\n\t"                                         \
    "mov r0, r11\n\t"                                          \
    "ldr r1, [r0, #32]\n\t"                                    \
    "cmp r4, r1\n\t"                                           \
    "bhi 27f\n\t"                                              \
    "ldr r1, [r0, #36]\n\t"                                    \
    "cmp r5, r1\n\t"                                           \
    "bhi 27f\n\t"                                              \
    "ldr r1, [r0, #44]\n\t"                                    \
    "mov r8, r1\n\t"                                           \
    "pop {r0, r1, r2, r3, r4, r5, r6, r7}\n\t"                 \
    "b 30b\n" ARMV6M_VERTEX_LIMIT

/* What becomes of triangles that are not wholly within the frame; 24: those that may be seen. */
#define TRIANGLE_SCAN_SEEN \
    "17: ands r0, r1\n\t" \
    "ands r0, r2\n\t" \
    "movs r1, #63\n\t" \
    "tst r0, r1\n\t" \
    "bne 18b\n" \
    "24: movs r0, #2\n\t" \
    "mov r1, r11\n\t" \
    "adds r1, #52\n\t" \
    "stm r1!, {r4, r5, r7}\n" \
    "22: mov r1, r10\n\t" \
    "adds r1, #6\n\t" \
    "mov r10, r1\n\t" \
    "b 29f\n" \
    "25: movs r0, #5\n\t" \
    "b 29f\n"

/* What becomes of those that face the viewer, of the area in r1. */
#define TRIANGLE_SCAN_FRONT                                            \
    "20: movs r0, #1\n\t"                                              \
    "b 22b\n"                                                          \
    "35: b 31f\n"                                                      \
    "36: movs r6, #5\n\t"                                              \
    "b 32f\n"                                                          \
    "21: mov r0, r11\n\t"                                              \
    "adds r0, #52\n\t"                                                 \
    "stm r0!, {r4, r5, r7}\n\t"                                        \
    "ldr r6, [r0, #4]\n\t"                                             \
    "cmp r6, #0\n\t"                                                   \
    "beq 20b\n\t"                                                      \
    "str r1, [r6]\n\t"                                                 \
    "mov lr, r6\n\t"                                                   \
    "mov r8, r1\n\t" ARMV6M_FRONT_BOX("35b", "36b") ARMV6M_FRONT_EDGES \
    ARMV6M_FRONT_BIASES ARMV6M_FRONT_START ARMV6M_FRONT_PIXELS          \
    "bne 34f\n\t"                                                      \
    "add sp, #16\n\t"                                                  \
    "b 31f\n"                                                          \
    "34: str r6, [r0, #4]\n\t"                                         \
    "cmp r6, #2\n\t"                                                   \
    "bls 37f\n"                                                        \
    "42: b 33f\n"

/* The colour of the triangle at r10, of the scan in r2 and its colours in r4, into r5; r3 is lost. It lies two thirds as far from the
 * first as the triangle's indices do, in bytes. */
#define TRIANGLE_SCAN_COLOR     \
    "mov r3, r10\n\t"           \
    "ldr r5, [r2, #84]\n\t"     \
    "subs r3, r3, r5\n\t"       \
    "ldr r5, 9f\n\t"            \
    "muls r3, r5\n\t"           \
    "lsls r3, r3, #1\n\t"       \
    "adds r4, r4, r3\n\t"       \
    "ldrb r5, [r4, #3]\n\t"     \
    "lsls r5, r5, #8\n\t"       \
    "ldrb r3, [r4]\n\t"         \
    "orrs r5, r3\n\t"           \
    "lsls r5, r5, #8\n\t"       \
    "ldrb r3, [r4, #1]\n\t"     \
    "orrs r5, r3\n\t"           \
    "lsls r5, r5, #8\n\t"       \
    "ldrb r3, [r4, #2]\n\t"     \
    "orrs r5, r3\n\t"

/* Stores the vertex that r7 points to, by the pool in r2 and its words at r3; colours in r9. Its `stored` into r1, r7 is lost. */
#define TRIANGLE_SCAN_VERTEX            \
    "39: push {r0, r4, r5, r6}\n\t"     \
    "ldr r1, [r3]\n\t"                  \
    "lsls r0, r1, #2\n\t"               \
    "adds r0, r0, r2\n\t"               \
    "adds r1, #1\n\t"                   \
    "str r1, [r7, #4]\n\t"              \
    "ldrh r6, [r7]\n\t"                 \
    "adds r7, #8\n\t"                   \
    "ldm r7, {r4, r5, r7}\n\t"          \
    "stm r0!, {r4, r5, r7}\n\t"         \
    "adds r4, r1, #2\n\t"               \
    "mov r7, r9\n\t"                    \
    "cmp r7, #0\n\t"                    \
    "beq 1f\n\t"                        \
    "lsls r6, r6, #2\n\t"               \
    "adds r7, r7, r6\n\t"               \
    "ldrb r5, [r7]\n\t"                 \
    "ldrb r6, [r7, #1]\n\t"             \
    "lsls r5, r5, #8\n\t"               \
    "lsls r6, r6, #24\n\t"              \
    "orrs r5, r6\n\t"                   \
    "ldrb r6, [r7, #3]\n\t"             \
    "ldrb r7, [r7, #2]\n\t"             \
    "lsls r4, r6, #8\n\t"               \
    "orrs r6, r4\n\t"                   \
    "lsls r6, r6, #16\n\t"              \
    "lsls r7, r7, #8\n\t"               \
    "orrs r6, r7\n\t"                   \
    "stm r0!, {r5, r6}\n\t"             \
    "adds r4, r1, #4\n"                 \
    "1: str r4, [r3]\n\t"               \
    "pop {r0, r4, r5, r6}\n\t"          \
    "bx lr\n"

/* Where vertex AT of the scan in r4 lies in the segment whose first word is in r5: into r1. */
#define TRIANGLE_SCAN_STORED(AT) \
    "ldr r7, [r4, #" AT "]\n\t"  \
    "ldr r1, [r7, #4]\n\t"       \
    "cmp r1, r5\n\t"             \
    "bhs 1f\n\t"                 \
    "bl 39b\n"                   \
    "1: subs r1, r1, r5\n\t"

/* Its pixels become points, by the rings while there is room. Then it goes on. */
#define TRIANGLE_SCAN_POINTS         \
    "37: mov r2, r11\n\t"            \
    "ldr r1, [r2, #76]\n\t"          \
    "cmp r1, #0\n\t"                 \
    "beq 42b\n\t"                    \
    "ldr r4, [r2, #88]\n\t"          \
    "subs r4, #1\n\t"                \
    "bmi 42b\n\t"                    \
    "str r4, [r2, #88]\n\t"          \
    "add sp, #16\n\t"                \
    "mov r3, r10\n\t"                \
    "push {r2, r3}\n\t"              \
    "ldr r4, [r2, #80]\n\t" TRIANGLE_SCAN_COLOR \
    "adds r2, #52\n\t"               \
    "ldm r2, {r2, r4, r6}\n\t"       \
    "ldr r2, [r2, #16]\n\t"          \
    "ldr r3, [r6, #16]\n\t"          \
    "ldr r4, [r4, #16]\n\t"          \
    "movs r6, r0\n\t"                \
    "movs r0, r1\n\t"                \
    "movs r1, r6\n\t" TINY_POINTS_ARMV6M("") \
    "pop {r0, r2}\n\t"               \
    "mov r11, r0\n\t"                \
    "mov r10, r2\n"                  \
    "31: mov r0, r11\n\t" TRIANGLE_SCAN_LOAD \
    "b 18b\n\t"                      \
    ".balign 4\n"                    \
    "9: .word 0xaaaaaaab\n"

/* A triangle of as many pixels as r6 says is stored while there is room; its box lies on the stack, from 32 on in r0 to r3. Then it goes
 * on. */
#define TRIANGLE_SCAN_STORE          \
    "33: pop {r0, r1, r2, r3}\n"     \
    "32: mov r4, r11\n\t"            \
    "ldr r5, [r4, #100]\n\t"         \
    "cmp r6, r5\n\t"                 \
    "bge 40f\n"                      \
    "38: " ARMV6M_FRONT_KEEP         \
    "mov r1, r11\n\t"                \
    "str r6, [r1, #72]\n\t"          \
    "b 20b\n"                        \
    "40: ldr r5, [r4, #88]\n\t"      \
    "subs r5, #1\n\t"                \
    "bmi 38b\n\t"                    \
    "str r5, [r4, #88]\n\t"          \
    "ldr r7, [r4, #96]\n\t"          \
    "ldm r7, {r0, r2, r3, r5, r6, r7}\n\t" \
    "mov r9, r7\n\t"                 \
    "mov r8, r0\n\t"                 \
    "ldr r7, [r0, #8]\n\t"           \
    "muls r7, r1\n\t"                \
    "lsrs r7, r7, #22\n\t"           \
    "lsls r7, r7, #2\n\t"            \
    "mov r12, r7\n\t"                \
    "adds r4, #52\n\t" TRIANGLE_SCAN_STORED("0") \
    "movs r0, r1\n\t" TRIANGLE_SCAN_STORED("8") \
    "lsls r1, r1, #16\n\t"           \
    "orrs r0, r1\n\t" TRIANGLE_SCAN_STORED("4") \
    "orrs r6, r1\n\t"                \
    "movs r5, #0\n\t"                \
    "mvns r5, r5\n\t"                \
    "mov r2, r11\n\t"                \
    "ldr r4, [r2, #80]\n\t"          \
    "cmp r4, #0\n\t"                 \
    "beq 2f\n\t" TRIANGLE_SCAN_COLOR \
    "2: mov r9, r5\n\t"              \
    "movs r5, r6\n\t" TINY_POINTS_LINK \
    "b 31b\n\t"                      \
    ".balign 4\n"                    \
    "9: .word 0xaaaaaaab\n"

/* Other reasons to stop. From 29 on it ends. */
#define TRIANGLE_SCAN_STOP \
    "26: add sp, #32\n\t" \
    "b 25b\n" TRIANGLE_SCAN_FIND \
    "1: ldr r3, [sp, #24]\n\t" \
    "movs r0, #0\n\t" \
    "str r0, [r3]\n\t" \
    "movs r0, #4\n\t" \
    "b 28f\n" \
    "27: movs r0, #3\n" \
    "28: mov r1, r11\n\t" \
    "mov r2, r12\n\t" \
    "ldr r3, [sp, #24]\n\t" \
    "str r2, [r1, #64]\n\t" \
    "str r3, [r1, #52]\n\t" \
    "add sp, #32\n" \
    "29: mov r1, r11\n\t" \
    "mov r2, r10\n\t" \
    "str r2, [r1, #40]"

/* Tells which vertex is missing, unless its entry is in use. */
#define TRIANGLE_SCAN_MISSING \
    "13: movs r0, r1\n\t" \
    "movs r6, r4\n\t" \
    "b 16f\n" \
    "14: cmp r7, r4\n\t" \
    "beq 25f\n\t" \
    "movs r0, r2\n\t" \
    "movs r6, r7\n\t" \
    "b 16f\n" \
    "15: cmp r5, r4\n\t" \
    "beq 25f\n\t" \
    "cmp r5, r7\n\t" \
    "beq 25f\n\t" \
    "movs r0, r3\n\t" \
    "movs r6, r5\n\t" \
    "b 16f\n"

/* From the scan in r0 to where it stopped. */
#define TRIANGLE_SCAN_ARMV6M \
    "mov r11, r0\n\t" TRIANGLE_SCAN_LOAD \
    "ldr r0, [r0, #40]\n\t" \
    "b 19f\n" \
    "11: " TRIANGLE_SCAN_ENTRIES \
    "ldr r6, [r4]\n\t" \
    "cmp r6, r1\n\t" \
    "bne 13f\n" \
    "30: ldr r6, [r7]\n\t" \
    "cmp r6, r2\n\t" \
    "bne 14f\n\t" \
    "ldr r6, [r5]\n\t" \
    "cmp r6, r3\n\t" \
    "bne 15f\n\t" \
    "ldr r0, [r4, #20]\n\t" \
    "ldr r1, [r7, #20]\n\t" \
    "ldr r2, [r5, #20]\n\t" \
    "movs r3, r0\n\t" \
    "orrs r3, r1\n\t" \
    "orrs r3, r2\n\t" \
    "bne 17f\n\t" TRIANGLE_SCAN_AREA \
    "bgt 21f\n\t" \
    "mov r0, r11\n\t" \
    "ldr r0, [r0, #48]\n\t" \
    "tst r0, r1\n\t" \
    "bne 24f\n" \
    "18: mov r0, r10\n\t" \
    "adds r0, #6\n" \
    "19: mov r10, r0\n\t" \
    "cmp r0, r8\n\t" \
    "bne 11b\n\t" \
    "movs r0, #0\n\t" \
    "b 29f\n" TRIANGLE_SCAN_MISSING TRIANGLE_SCAN_SEEN TRIANGLE_SCAN_FRONT TRIANGLE_SCAN_POINTS TRIANGLE_SCAN_VERTEX \
        TRIANGLE_SCAN_STORE TRIANGLE_SCAN_STOP

#endif

#endif
