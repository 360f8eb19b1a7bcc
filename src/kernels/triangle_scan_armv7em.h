/* SPDX-License-Identifier: MIT */
/* triangle_scan_armv7em.h - goes over a mesh's triangles on Cortex-M4: what they cover, points that they become, and
 * where others are stored. */
#ifndef SMEAR_KERNELS_TRIANGLE_SCAN_ARMV7EM_H
#define SMEAR_KERNELS_TRIANGLE_SCAN_ARMV7EM_H

#include "kernels/front_cover.h"
#include "kernels/tiny_points.h"
#include "kernels/vertices.h"

#if TINY_COVER_ARMV7EM
/* Tags of the triangle whose first index r0 points to into r2, r3 and r4, its entries into r5, r7 and r6. */
#define TRIANGLE_SCAN_ENTRIES            \
    "ldm r1, {r3, r4, r8, r9, r10}\n\t" \
    "ldrh r2, [r0]\n\t"                 \
    "ldrh r3, [r0, r3]\n\t"             \
    "ldrh r4, [r0, r4]\n\t"             \
    "orr r2, r2, r8\n\t"                \
    "orr r3, r3, r8\n\t"                \
    "orr r4, r4, r8\n\t"                \
    "and r5, r2, r9\n\t"                \
    "and r7, r3, r9\n\t"                \
    "and r6, r4, r9\n\t"                \
    "mla r5, r5, r12, r10\n\t"          \
    "mla r7, r7, r12, r10\n\t"          \
    "mla r6, r6, r12, r10\n\t"

/* Goes on where vertices are in the cache, and within the frame. At 31 only the third one is asked for, at 32 all are there. */
#define TRIANGLE_SCAN_TEST     \
    "ldr r8, [r5]\n\t"        \
    "cmp r8, r2\n\t"          \
    "bne 13f\n\t"             \
    "ldr r9, [r7]\n\t"        \
    "cmp r9, r3\n\t"          \
    "bne 14f\n"               \
    "31: ldr r10, [r6]\n\t"   \
    "cmp r10, r4\n\t"         \
    "bne 15f\n"               \
    "32: ldr r2, [r5, #20]\n\t" \
    "ldr r3, [r7, #20]\n\t"   \
    "ldr r4, [r6, #20]\n\t"   \
    "orr r8, r2, r3\n\t"      \
    "orrs r8, r8, r4\n\t"     \
    "bne 17f\n\t"

/* Twice the area into r2 and r3. */
#define TRIANGLE_SCAN_AREA          \
    "ldrd r2, r3, [r5, #8]\n\t"    \
    "ldrd r8, r9, [r7, #8]\n\t"    \
    "ldrd r10, r11, [r6, #8]\n\t"  \
    "sub r4, r2, r10\n\t"          \
    "sub r8, r8, r2\n\t"           \
    "sub r9, r9, r3\n\t"           \
    "sub r11, r11, r3\n\t"         \
    "smull r2, r3, r8, r11\n\t"    \
    "smlal r2, r3, r4, r9\n\t"

/* The entry and the tag of a vertex that is missing into r8 and r12, unless the entry is in use. */
#define TRIANGLE_SCAN_MISSING \
    "13: mov r12, r2\n\t"    \
    "mov r8, r5\n\t"         \
    "b 16f\n"                \
    "14: cmp r7, r5\n\t"     \
    "beq 25f\n\t"            \
    "mov r12, r3\n\t"        \
    "mov r8, r7\n\t"         \
    "b 16f\n"                \
    "15: cmp r6, r5\n\t"     \
    "it ne\n\t"              \
    "cmpne r6, r7\n\t"       \
    "beq 25f\n\t"            \
    "mov r12, r4\n\t"        \
    "mov r8, r6\n"

/* That vertex into the cache, then on behind where it was asked for, with what was in r0 to r7, and lr. Else at 1 and 27. */
#define TRIANGLE_SCAN_FIND                         \
    "16: uxth r9, r12\n\t"                        \
    "ldr r10, [r1, #28]\n\t"                      \
    "cmp r9, r10\n\t"                             \
    "bhs 25f\n\t"                                 \
    "push {r0, r1, r2, r3, r4, r5, r6, r7, lr}\n\t" \
    "mov lr, r8\n\t"                              \
    "ldrd r1, r3, [r1, #20]\n\t"                  \
    "add r0, r9, r9, lsl #1\n\t"                  \
    "add r0, r3, r0, lsl #1\n\t" ARMV7EM_VERTEX   \
    "mov r3, r12\n\t"                             \
    "movs r4, #0\n\t"                             \
    "mov r8, r4\n\t"                              \
    "mov r12, r11\n\t"                            \
    "stm lr, {r3, r4, r5, r6, r7, r8, r9, r10, r11, r12}\n\t" \
    "ldr r1, [sp, #4]\n\t"                        \
    "ldrd r3, r4, [r1, #32]\n\t"                  \
    "cmp r5, r3\n\t"                              \
    "bhi 27f\n\t"                                 \
    "cmp r6, r4\n\t"                              \
    "bhi 27f\n\t"                                 \
    "mov r8, lr\n\t"                              \
    "pop {r0, r1, r2, r3, r4, r5, r6, r7, lr}\n\t" \
    "mov r12, #40\n\t"                            \
    "cmp r8, r5\n\t"                              \
    "beq 12b\n\t"                                 \
    "cmp r8, r7\n\t"                              \
    "beq 31b\n\t"                                 \
    "b 32b\n" ARMV7EM_VERTEX_LIMIT

/* What becomes of triangles that are not wholly within the frame; 24, 21: those that may be seen. */
#define TRIANGLE_SCAN_SEEN         \
    "17: ands r2, r2, r3\n\t"     \
    "ands r2, r2, r4\n\t"         \
    "tst r2, #63\n\t"             \
    "bne 18b\n"                   \
    "24: movs r2, #2\n"           \
    "22: add r3, r1, #52\n\t"     \
    "stm r3, {r5, r6, r7}\n\t"    \
    "adds r0, #6\n\t"             \
    "b 29f\n"

/* What becomes of those that face the viewer. */
#define TRIANGLE_SCAN_FRONT         \
    "21: movs r2, #1\n\t"          \
    "ldr r8, [r1, #68]\n\t"        \
    "cmp r8, #0\n\t"               \
    "beq 22f\n\t"                  \
    "add r3, r1, #52\n\t"          \
    "stm r3, {r5, r6, r7}\n\t"     \
    "push {r0, r1, lr}\n\t"        \
    "mov r0, r8\n\t"               \
    "ldrd r8, r9, [r6, #8]\n\t"    \
    "ldrd r6, r7, [r7, #8]\n\t"    \
    "ldrd r4, r5, [r5, #8]\n\t" FRONT_COVER_ARMV7EM \
    "mov r2, r0\n\t"               \
    "pop {r0, r1, lr}\n\t"         \
    "mov r12, #40\n\t"             \
    "cmp r2, #0\n\t"               \
    "beq 18b\n\t"                  \
    "cmp r2, #2\n\t"               \
    "bhi 23f\n\t"                  \
    "ldr r3, [r1, #76]\n\t"        \
    "cbz r3, 23f\n\t"              \
    "ldr r4, [r1, #88]\n\t"        \
    "cbnz r4, 30f\n"               \
    "23: ldr r3, [r1, #104]\n\t"   \
    "cmp r2, r3\n\t"               \
    "blt 37f\n\t"                  \
    "ldr r4, [r1, #88]\n\t"        \
    "cmp r4, #0\n\t"               \
    "bne 38f\n"                    \
    "37: str r2, [r1, #72]\n\t"    \
    "movs r2, #1\n\t"              \
    "adds r0, #6\n\t"              \
    "b 29f\n"

/* Its pixels become points, by the rings in r3 while there is the room in r4. A triangle's colour lies two thirds as far from the first
 * as its indices do. */
#define TRIANGLE_SCAN_POINTS        \
    "30: ldrd r5, r6, [r1, #80]\n\t" \
    "cbnz r5, 36f\n\t"             \
    "b 33f\n"                       \
    "36: subs r4, #1\n\t"          \
    "str r4, [r1, #88]\n\t"        \
    "push {r0, r1, lr}\n\t"        \
    "subs r6, r0, r6\n\t"          \
    "movw r4, #0xaaab\n\t"         \
    "movt r4, #0xaaaa\n\t"         \
    "mul r6, r6, r4\n\t"           \
    "ldr r5, [r5, r6, lsl #1]\n\t" \
    "rev r5, r5\n\t"               \
    "ror r5, r5, #8\n\t"           \
    "mov r0, r3\n\t"               \
    "add r6, r1, #52\n\t"          \
    "ldr r1, [r1, #68]\n\t"        \
    "ldm r6, {r2, r4, r6}\n\t"     \
    "ldr r2, [r2, #16]\n\t"        \
    "ldr r3, [r6, #16]\n\t"        \
    "ldr r4, [r4, #16]\n\t" TINY_POINTS_ARMV7EM "\n\t" \
    "pop {r0, r1, lr}\n\t"         \
    "mov r12, #40\n\t"             \
    "b 18b\n"

/* The same of those whose colours are mixed, if their depths are nearly even: units of corners go into r8, r9 and r10. */
#define TRIANGLE_SCAN_EVEN               \
    "33: add r5, r1, #52\n\t"          \
    "ldm r5, {r5, r6, r7}\n\t"         \
    "ldr r8, [r5, #16]\n\t"            \
    "ldr r9, [r7, #16]\n\t"            \
    "ldr r10, [r6, #16]\n\t"           \
    "ldrb r5, [r1, #96]\n\t"           \
    "cbz r5, 34f\n\t"                  \
    "sub r5, r8, r9\n\t"               \
    "and r5, r5, r5, asr #31\n\t"      \
    "add r5, r5, r9\n\t"               \
    "sub r6, r5, r10\n\t"              \
    "and r6, r6, r6, asr #31\n\t"      \
    "add r6, r6, r10\n\t"              \
    "add r6, r6, r6, asr #5\n\t"       \
    "cmp r8, r6\n\t"                   \
    "itt le\n\t"                       \
    "cmple r9, r6\n\t"                 \
    "cmple r10, r6\n\t"                \
    "bgt 23b\n"                         \
    "34: subs r4, #1\n\t"              \
    "str r4, [r1, #88]\n\t"            \
    "push {r0, r1, lr}\n\t"            \
    "mov r0, r3\n\t"                   \
    "ldr r1, [r1, #68]\n\t"            \
    "mov r2, r8\n\t"                   \
    "mov r3, r9\n\t"                   \
    "mov r4, r10\n\t" TINY_POINTS_ARMV7EM "\n\t"

/* Codes of v[0] in r3, r4 and r5: red, green and blue; pairs of those of the others in r8, r10 and r9. */
#define TRIANGLE_SCAN_CODES              \
    "ldr r1, [sp, #4]\n\t"             \
    "add r2, r1, #52\n\t"              \
    "ldm r2, {r2, r3, r4}\n\t"         \
    "ldrd r5, r6, [r1, #92]\n\t"       \
    "ldrh r2, [r2]\n\t"                \
    "ldrh r3, [r3]\n\t"                \
    "ldrh r4, [r4]\n\t"                \
    "ldr r2, [r5, r2, lsl #2]\n\t"     \
    "ldr r3, [r5, r3, lsl #2]\n\t"     \
    "ldr r4, [r5, r4, lsl #2]\n\t"     \
    "uxtb16 r6, r4\n\t"                \
    "uxtb16 r7, r3\n\t"                \
    "pkhbt r8, r6, r7, lsl #16\n\t"    \
    "pkhtb r9, r7, r6, asr #16\n\t"    \
    "uxtb16 r6, r4, ror #8\n\t"        \
    "uxtb16 r7, r3, ror #8\n\t"        \
    "pkhbt r10, r6, r7, lsl #16\n\t"   \
    "uxtb r3, r2\n\t"                  \
    "ubfx r4, r2, #8, #8\n\t"          \
    "ubfx r5, r2, #16, #8\n\t"

/* Weights add up to 2^14, of which v[0] has the rest; 2^13 rounds. */
#define TRIANGLE_SCAN_MIX                \
    "ldr r6, [r1, #68]\n\t"            \
    "ldr r7, [r6, #4]\n\t"             \
    "ldr r11, [r0, #12]\n\t"           \
    "ldr r11, [r11]\n\t"               \
    "ldr r12, [r0]\n\t"                \
    "sub r11, r11, r7\n\t"             \
    "sub r12, r12, r11, lsl #4\n\t"    \
    "add r12, r12, #12\n\t"            \
    "add r6, r6, #16\n\t"              \
    "mov r11, #0x2000\n"                \
    "35: ldrd r0, r1, [r6], #16\n\t"   \
    "lsrs r0, r0, #2\n\t"              \
    "lsrs r1, r1, #2\n\t"              \
    "rsb r2, r0, #0x4000\n\t"          \
    "subs r2, r2, r1\n\t"              \
    "pkhbt r0, r0, r1, lsl #16\n\t"    \
    "smlad r1, r8, r0, r11\n\t"        \
    "mla r1, r3, r2, r1\n\t"           \
    "smlad lr, r9, r0, r11\n\t"        \
    "mla lr, r5, r2, lr\n\t"           \
    "smlad r0, r10, r0, r11\n\t"       \
    "mla r0, r4, r2, r0\n\t"           \
    "lsrs r1, r1, #14\n\t"             \
    "lsr lr, lr, #14\n\t"              \
    "lsrs r0, r0, #14\n\t"             \
    "orr r1, lr, r1, lsl #16\n\t"      \
    "orr r1, r1, r0, lsl #8\n\t"       \
    "str r1, [r12], #-16\n\t"          \
    "subs r7, #1\n\t"                  \
    "bne 35b\n\t"                      \
    "pop {r0, r1, lr}\n\t"             \
    "mov r12, #40\n\t"                 \
    "b 18b\n"

/* The vertex in V becomes how far its record lies from the segment's first. */
#define TRIANGLE_SCAN_OFFSET(V, LABEL) \
    "ldr r4, [" V ", #4]\n\t"        \
    "cmp r4, r9\n\t"                 \
    "bhs " LABEL "f\n\t"             \
    "mov r0, " V "\n\t"              \
    "bl 40f\n" LABEL ": sub " V ", r4, r9\n\t"

/* Those that cover enough are stored, while there is the room in r4: vertices into the pool, of the records in r3. */
#define TRIANGLE_SCAN_STORE            \
    "38: subs r4, #1\n\t"            \
    "str r4, [r1, #88]\n\t"          \
    "push {r0, r1, lr}\n\t"          \
    "add r5, r1, #52\n\t"            \
    "ldm r5, {r5, r6, r7}\n\t"       \
    "ldr r3, [r1, #100]\n\t"         \
    "ldrd r8, r9, [r3, #8]\n\t"      \
    "ldr r3, [r3, #4]\n\t"           \
    "ldr r10, [r8]\n\t" TRIANGLE_SCAN_OFFSET("r5", "1") TRIANGLE_SCAN_OFFSET("r7", "2") TRIANGLE_SCAN_OFFSET("r6", "3") \
    "str r10, [r8]\n\t"              \
    "pkhbt r5, r5, r7, lsl #16\n\t"  \
    "ldr r4, [r1, #100]\n\t"         \
    "ldr r4, [r4, #16]\n\t"          \
    "orrs r6, r6, r4\n\t"            \
    "ldrd r2, r3, [r1, #80]\n\t"     \
    "cbz r2, 4f\n\t"                 \
    "ldr r0, [sp]\n\t"               \
    "subs r3, r0, r3\n\t"            \
    "movw r4, #0xaaab\n\t"           \
    "movt r4, #0xaaaa\n\t"           \
    "mul r3, r3, r4\n\t"             \
    "ldr r2, [r2, r3, lsl #1]\n\t"   \
    "rev r2, r2\n\t"                 \
    "ror r2, r2, #8\n\t"             \
    "b 5f\n"                          \
    "4: subs r2, #1\n"

/* The entry, with offsets and segment in r5 and r6 and the colour in r2, into the ring of its row. */
#define TRIANGLE_SCAN_ENTRY            \
    "5: ldr r3, [r1, #100]\n\t"      \
    "ldr r3, [r3]\n\t"               \
    "ldr r4, [r1, #68]\n\t"          \
    "ldrh r4, [r4, #74]\n\t"         \
    "ldm r3, {r7, r8, r9, r10}\n\t"  \
    "mul r4, r4, r9\n\t"             \
    "lsrs r4, r4, #22\n\t"           \
    "add r8, r8, r4, lsl #2\n\t"     \
    "ldr r9, [r10]\n\t"              \
    "add r11, r9, #1\n\t"            \
    "str r11, [r10]\n\t"             \
    "ldr r11, [r8]\n\t"              \
    "str r9, [r8]\n\t"               \
    "sub r12, r7, r9, lsl #4\n\t"    \
    "strd r5, r6, [r12]\n\t"         \
    "mov r3, r9\n\t"                 \
    "cmn r11, #1\n\t"                \
    "beq 6f\n\t"                     \
    "sub r7, r7, r11, lsl #4\n\t"    \
    "ldr r3, [r7, #8]\n\t"           \
    "str r9, [r7, #8]\n"              \
    "6: strd r3, r2, [r12, #8]\n\t"  \
    "pop {r0, r1, lr}\n\t"           \
    "mov r12, #40\n\t"               \
    "b 18b\n"

/* The vertex in r0 into the pool in r3, at the word in r10; r4 is what it has stored. */
#define TRIANGLE_SCAN_RECORD           \
    "40: add r4, r3, r10, lsl #2\n\t" \
    "ldrd r2, r11, [r0, #8]\n\t"     \
    "ldr r12, [r0, #16]\n\t"         \
    "stm r4!, {r2, r11, r12}\n\t"    \
    "ldr r2, [r1, #100]\n\t"         \
    "ldr r2, [r2, #20]\n\t"          \
    "cbz r2, 4f\n\t"                 \
    "ldrh r11, [r0]\n\t"             \
    "ldr r2, [r2, r11, lsl #2]\n\t"  \
    "ubfx r12, r2, #8, #8\n\t"       \
    "uxtb r11, r2\n\t"               \
    "lsl r11, r11, #8\n\t"           \
    "orr r11, r11, r12, lsl #24\n\t" \
    "ubfx r12, r2, #16, #8\n\t"      \
    "lsrs r2, r2, #24\n\t"           \
    "add r2, r2, r2, lsl #8\n\t"     \
    "lsl r12, r12, #8\n\t"           \
    "orr r12, r12, r2, lsl #16\n\t"  \
    "stm r4!, {r11, r12}\n"           \
    "4: add r2, r10, #1\n\t"         \
    "str r2, [r0, #4]\n\t"           \
    "subs r4, r4, r3\n\t"            \
    "lsr r10, r4, #2\n\t"            \
    "mov r4, r2\n\t"                 \
    "bx lr\n"

/* Other reasons to stop. From 29 on it ends. */
#define TRIANGLE_SCAN_STOP      \
    "1: mov r3, r12\n\t"       \
    "movs r2, #0\n\t"          \
    "str r2, [lr]\n\t"         \
    "movs r2, #4\n\t"          \
    "b 28f\n"                  \
    "27: ldr r3, [lr]\n\t"     \
    "movs r2, #3\n"            \
    "28: ldrd r0, r1, [sp]\n\t" \
    "str r3, [r1, #64]\n\t"    \
    "str lr, [r1, #52]\n\t"    \
    "add sp, #36\n\t"          \
    "b 29f\n"                  \
    "25: movs r2, #5\n"        \
    "29: str r0, [r1, #40]"
#endif

#endif
