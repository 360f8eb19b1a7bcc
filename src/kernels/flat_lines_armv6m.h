/* SPDX-License-Identifier: MIT */
/* flat_lines_armv6m.h - flat_lines in assembly for Cortex-M0 and M0+: what rows take is loaded and stored many at once, and pixels have
 * all they need in low registers. Less than half of the compiler's instructions of a row, and four fifths of those of a pixel. */
#ifndef SMEAR_KERNELS_FLAT_LINES_ARMV6M_H
#define SMEAR_KERNELS_FLAT_LINES_ARMV6M_H

#include "kernels/flat_lines.h"

/* The pixel AT bytes of depth and PLACE bytes of colours further on. LABEL is behind it. */
#define FLAT_ROW_PUT(STORE, AT, PLACE, LABEL) \
    "ldrh r5, [r1, #" AT "]\n\t"              \
    "adds r0, r0, r3\n\t"                     \
    "cmp r5, r4\n\t"                          \
    "bhs " LABEL "f\n\t"                      \
    "strh r4, [r1, #" AT "]\n\t" STORE " r7, [r2, #" PLACE "]\n" LABEL ": "
#define FLAT_ROW_PIXEL(STORE, AT, PLACE, LABEL) \
    "lsrs r4, r0, #16\n\t" FLAT_ROW_PUT(STORE, AT, PLACE, LABEL)

/* Pixels from r5 to before r6, where r7 points to columns, what changes from row to row, z, depth, and what pixels take; then goes on at
 * 1 with the next of so many rows as r9 says. In a row: z r0, depth r1, pixels r2, dz r3, how many r6, the colour r7. DOUBLE is an
 * instruction where pixels are wide; of them SINGLE, TWICE, THRICE and FOUR are bytes. AGAIN goes on at 1 unless there are none. */
#define FLAT_ROW_ARMV6M(AGAIN, PIXEL, STORE, DOUBLE, SINGLE, TWICE, THRICE, FOUR) \
    "ldm r7!, {r0, r1, r2, r3}\n\t" \
    "cmp r5, r0\n\t" \
    "bge 4f\n\t" \
    "movs r5, r0\n" \
    "4: cmp r6, r1\n\t" \
    "ble 5f\n\t" \
    "movs r6, r1\n" \
    "5: ldr r0, [r7]\n\t" \
    "ldr r1, [r7, #4]\n\t" \
    "adds r2, r2, r0\n\t" \
    "adds r3, r3, r1\n\t" \
    "stm r7!, {r2, r3}\n\t" \
    "subs r6, r6, r5\n\t" \
    "ble 9f\n\t" \
    "ldm r7, {r2, r3, r7}\n\t" \
    "movs r4, r3\n\t" \
    "muls r4, r5\n\t" \
    "adds r0, r0, r4\n\t" \
    "lsls r5, r5, #1\n\t" \
    "adds r1, r1, r5\n\t" DOUBLE "adds r2, r2, r1\n\t" \
    "subs r6, #4\n\t" \
    "blt 7f\n" \
    "6: " PIXEL(STORE, "0", "0", "2") PIXEL(STORE, "2", SINGLE, "3") \
    PIXEL(STORE, "4", TWICE, "4") PIXEL(STORE, "6", THRICE, "5") \
    "adds r2, #" FOUR "\n\t" \
    "adds r1, #8\n\t" \
    "subs r6, #4\n\t" \
    "bge 6b\n" \
    "7: lsrs r6, r6, #1\n\t" \
    "bcc 8f\n\t" PIXEL(STORE, "0", "0", "2") \
    "adds r2, #" SINGLE "\n\t" \
    "adds r1, #2\n" \
    "8: lsrs r6, r6, #1\n\t" \
    "bcc 9f\n\t" PIXEL(STORE, "0", "0", "2") PIXEL(STORE, "2", SINGLE, "3") \
    "9: mov r4, r9\n\t" \
    "subs r4, #1\n\t" \
    "mov r9, r4\n\t" \
    AGAIN "\n"

#if SMEAR_ASM_ARMV6M

SMEAR_STATIC_ASSERT(offsetof(struct flat_lines, x) == 16 && offsetof(struct flat_lines, x0) == 32 && offsetof(struct flat_lines, z) == 48
                        && offsetof(struct flat_lines, to_pixels) == 56 && offsetof(struct flat_lines, color) == 64,
                    "the assembly knows struct flat_lines");

/* A pixel where codes break: what flat_code adds is in r12. */
#define FLAT_LINES_ACROSS(STORE, AT, PLACE, LABEL) \
    "lsls r4, r0, #1\n\t"                          \
    "bcc " LABEL "f\n\t"                           \
    "lsls r4, r0, #5\n"                            \
    LABEL ": add r4, r12\n\t"                      \
    "lsrs r4, r4, #16\n\t" FLAT_ROW_PUT(STORE, AT, PLACE, LABEL)

/* struct flat_lines from x on in r8, rows in r9, steps of sides on the stack; the rest is of flat_row_armv6m.h. */
#define FLAT_LINES_ARMV6M(AGAIN, PIXEL, STORE, DOUBLE, SINGLE, TWICE, THRICE, FOUR)                                            \
    __asm__ volatile(".syntax unified\n\t"                                                                              \
                     "mov r9, r1\n\t"                                                                                   \
                     "ldm r0!, {r4, r5, r6, r7}\n\t"                                                                    \
                     "push {r4, r5, r6, r7}\n\t"                                                                        \
                     "mov r8, r0\n\t"                                                                                   \
                     "movs r4, #128\n\t"                                                                                \
                     "lsls r4, r4, #8\n\t"                                                                              \
                     "lsls r5, r4, #16\n\t"                                                                             \
                     "orrs r4, r5\n\t"                                                                                  \
                     "mov r12, r4\n"                                                                                    \
                     "1: mov r7, r8\n\t"                                                                                \
                     "ldm r7!, {r0, r1, r2, r3}\n\t"                                                                    \
                     "asrs r5, r1, #10\n\t"                                                                             \
                     "asrs r6, r3, #10\n\t"                                                                             \
                     "ldr r4, [sp]\n\t"                                                                                 \
                     "adds r0, r0, r4\n\t"                                                                              \
                     "ldr r4, [sp, #4]\n\t"                                                                             \
                     "adcs r1, r4\n\t"                                                                                  \
                     "ldr r4, [sp, #8]\n\t"                                                                             \
                     "adds r2, r2, r4\n\t"                                                                              \
                     "ldr r4, [sp, #12]\n\t"                                                                            \
                     "adcs r3, r4\n\t"                                                                                  \
                     "subs r7, #16\n\t"                                                                                 \
                     "stm r7!, {r0, r1, r2, r3}\n\t"                                                                    \
                     FLAT_ROW_ARMV6M(AGAIN, PIXEL, STORE, DOUBLE, SINGLE, TWICE, THRICE, FOUR) \
                     "2: add sp, #16"                                                                                   \
                     : "+r"(r0), "+r"(r1)                                                                               \
                     :                                                                                                  \
                     : "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r12", "cc", "memory")

/* Zeros before the number in r1, counted in r2, of which BITS more may be there. */
#define FLAT_LINES_ZEROS(BITS, LABEL)    \
    "lsrs r0, r1, #32 - " BITS "\n\t"    \
    "bne " LABEL "f\n\t"                 \
    "adds r2, #" BITS "\n\t"             \
    "lsls r1, r1, #" BITS "\n" LABEL ": "

/* Starting a side: a lies in r12, and where the side is stored in lr. Brings down r4, dx r5, dy r6; on to 8 where it is flat or long. */
#define FLAT_LINES_WAY \
    "mov lr, r0\n\t"        \
    "mov r12, r1\n\t"       \
    "ldm r2!, {r5, r6}\n\t" \
    "ldm r1!, {r4, r7}\n\t" \
    "subs r5, r5, r4\n\t"   \
    "subs r6, r6, r7\n\t"   \
    "movs r4, #128\n\t"     \
    "subs r4, r4, r7\n\t"   \
    "uxtb r4, r4\n\t"       \
    "lsrs r1, r6, #15\n\t"  \
    "bne 8f\n\t"            \
    "cmp r6, #128\n\t"      \
    "blt 8f\n\t"            \
    "asrs r1, r5, #31\n\t"  \
    "adds r2, r5, r1\n\t"   \
    "eors r2, r1\n\t"       \
    "lsrs r1, r2, #15\n\t"  \
    "bne 8f\n\t"            \
    "lsls r1, r6, #5\n\t"   \
    "cmp r2, r1\n\t"        \
    "bge 8f\n\t"

/* The reciprocal r1 of dy, of 15 bits, and its zeros r2. */
#define FLAT_LINES_RECIP \
    "movs r2, #17\n\t"         \
    "lsls r1, r6, #17\n\t"     \
    FLAT_LINES_ZEROS("4", "1") \
    FLAT_LINES_ZEROS("2", "2") \
    FLAT_LINES_ZEROS("1", "3") \
    "lsls r7, r1, #1\n\t"      \
    "lsrs r7, r7, #23\n\t"     \
    "lsls r7, r7, #1\n\t"      \
    "ldrh r7, [r3, r7]\n\t"    \
    "lsrs r1, r1, #11\n\t"     \
    "muls r1, r7\n\t"          \
    "rsbs r1, r1, #0\n\t"      \
    "lsls r1, r1, #1\n\t"      \
    "asrs r1, r1, #5\n\t"      \
    "muls r1, r7\n\t"          \
    "asrs r1, r1, #23\n\t"     \
    "lsls r7, r7, #4\n\t"      \
    "adds r1, r1, r7\n\t"

/* The step in r6 and r7: whole, and parts of 16 bits twice, r3 and r5. */
#define FLAT_LINES_STEP \
    "movs r0, #36\n\t"     \
    "subs r0, r0, r2\n\t"  \
    "movs r7, r5\n\t"      \
    "muls r7, r1\n\t"      \
    "asrs r7, r0\n\t"      \
    "lsls r5, r5, #10\n\t" \
    "movs r3, r7\n\t"      \
    "muls r3, r6\n\t"      \
    "subs r5, r5, r3\n\t"  \
    "movs r3, r5\n\t"      \
    "muls r3, r1\n\t"      \
    "subs r0, #6\n\t"      \
    "asrs r3, r0\n\t"      \
    "lsls r5, r5, #16\n\t" \
    "muls r6, r3\n\t"      \
    "subs r5, r5, r6\n\t"  \
    "lsrs r1, r1, #4\n\t"  \
    "muls r5, r1\n\t"      \
    "subs r0, #4\n\t"      \
    "asrs r5, r0\n\t"      \
    "lsls r6, r3, #16\n\t" \
    "asrs r3, r3, #16\n\t" \
    "asrs r1, r5, #31\n\t" \
    "adds r6, r6, r5\n\t"  \
    "adcs r3, r1\n\t"      \
    "adds r7, r7, r3\n\t"

/* The place in r2 and r3. Both are stored. */
#define FLAT_LINES_PLACE \
    "movs r3, r7\n\t"       \
    "muls r3, r4\n\t"       \
    "lsrs r2, r6, #8\n\t"   \
    "muls r2, r4\n\t"       \
    "mov r5, r12\n\t"       \
    "ldr r5, [r5]\n\t"      \
    "adds r5, #128\n\t"     \
    "lsls r5, r5, #2\n\t"   \
    "lsls r1, r3, #24\n\t"  \
    "asrs r3, r3, #8\n\t"   \
    "adds r2, r2, r1\n\t"   \
    "adcs r3, r5\n\t"       \
    "movs r0, #1\n\t"       \
    "lsls r1, r0, #18\n\t"  \
    "movs r5, #0\n\t"       \
    "subs r2, r2, r1\n\t"   \
    "sbcs r3, r5\n\t"       \
    "mov r5, lr\n\t"        \
    "str r6, [r5]\n\t"      \
    "str r7, [r5, #4]\n\t"  \
    "str r2, [r5, #16]\n\t" \
    "str r3, [r5, #20]\n\t"

/* Starts a side at its first row, like edge_fine_near. False where it is flat or long. Half of the compiler's instructions. */
static inline bool flat_lines_side_armv6m(struct flat_lines *l, int side, const int32_t *a, const int32_t *b)
{
    register uint32_t r0 __asm__("r0") = (uint32_t)(uintptr_t)l->step[side];
    register const int32_t *r1 __asm__("r1") = a;
    register const int32_t *r2 __asm__("r2") = b;
    register const uint16_t *r3 __asm__("r3") = smear_recip_seed;
    __asm__ volatile(".syntax unified\n\t" FLAT_LINES_WAY FLAT_LINES_RECIP FLAT_LINES_STEP FLAT_LINES_PLACE
                     "b 9f\n"
                     "8: movs r0, #0\n"
                     "9:"
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
                     :
                     : "r4", "r5", "r6", "r7", "r12", "lr", "cc", "memory");
    return r0 != 0;
}

/* Like flat_lines. */
static inline void flat_lines_armv6m(struct flat_lines *l, int32_t n)
{
    register struct flat_lines *r0 __asm__("r0") = l;
    register int32_t r1 __asm__("r1") = n;
    if (l->breaks) {
        if (l->narrow)
            FLAT_LINES_ARMV6M("beq 2f\n\tb 1b", FLAT_LINES_ACROSS, "strh", "", "2", "4", "6", "8");
        else
            FLAT_LINES_ARMV6M("beq 2f\n\tb 1b", FLAT_LINES_ACROSS, "str", "adds r2, r2, r1\n\t", "4", "8", "12", "16");
    } else if (l->narrow) {
        FLAT_LINES_ARMV6M("bne 1b", FLAT_ROW_PIXEL, "strh", "", "2", "4", "6", "8");
    } else {
        FLAT_LINES_ARMV6M("bne 1b", FLAT_ROW_PIXEL, "str", "adds r2, r2, r1\n\t", "4", "8", "12", "16");
    }
}

#endif

#endif
