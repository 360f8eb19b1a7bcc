/* SPDX-License-Identifier: MIT */
/* texels_draw_armv6m.h - texels_draw in assembly for Cortex-M0 and M0+: eight registers do everything and six only add.
 * Compilers keep half of the values on the stack there, which doubles the instructions. */
#ifndef SMEAR_KERNELS_TEXELS_DRAW_ARMV6M_H
#define SMEAR_KERNELS_TEXELS_DRAW_ARMV6M_H

#include "kernels/texel_run.h"

#if SMEAR_ASM_ARMV6M

/* Where registers are loaded from, and what is stored at the end. */
SMEAR_STATIC_ASSERT(offsetof(struct texel_run, count) == 20 && offsetof(struct texel_run, color) == 24
                        && offsetof(struct texel_run, depth) == 28 && offsetof(struct texel_run, z) == 32
                        && offsetof(struct texel_run, texels) == 44 && offsetof(struct texel_run, light) == 48,
                    "the assembly knows struct texel_run");
SMEAR_STATIC_ASSERT(offsetof(struct texel_light, pixel) == 0 && offsetof(struct texel_light, near) == 4
                        && offsetof(struct texel_light, at_u) == 8 && offsetof(struct texel_light, at_v) == 12
                        && offsetof(struct texel_light, cell) == 16 && offsetof(struct texel_light, from_v) == 20
                        && offsetof(struct texel_light, mask_v) == 24 && offsetof(struct texel_light, from_u) == 28,
                    "the assembly knows struct texel_light");

/* Goes on to LABEL where pixel I of a round is hidden; else its depth is written. */
#define ARMV6M_SEEN(I, LABEL) \
        "lsrs r6, r2, #16\n\t" \
        "ldrh r7, [r1, #2*(" I ")]\n\t" \
        "add r2, r8\n\t" \
        "cmp r7, r6\n\t" \
        "bhs " LABEL "f\n\t" \
        "strh r6, [r1, #2*(" I ")]\n\t"

/* Stores a wide pixel without its texel's upper byte. */
#define ARMV6M_STORE_WIDE "lsls r6, r6, #8\n\tlsrs r6, r6, #8\n\tstr"

/* Pixel I of a round, whose colour has 2^SIZE bytes; LABEL is behind it. r0 points to colours,
 * r1 to depths; z is in r2, u in r3, v in r4, r5 points to texels; dz in r8, du in r9, dv in r10, ddu in r11, ddv in r12. */
#define ARMV6M_PIXEL(LOAD, STORE, SIZE, I, LABEL) \
        ARMV6M_SEEN(I, LABEL) \
        "lsrs r6, r4, %[from_v]\n\t" \
        "lsls r6, r6, %[to_v]\n\t" \
        "lsrs r7, r3, %[from_u]\n\t" \
        "lsls r7, r7, #" SIZE "\n\t" \
        "orrs r6, r7\n\t" \
        LOAD " r6, [r5, r6]\n\t" \
        STORE " r6, [r0, #(" I ")<<" SIZE "]\n" \
        LABEL ": "

#define ARMV6M_STEP \
        "add r3, r9\n\t" \
        "add r4, r10\n\t"

#define ARMV6M_BEND \
        "add r9, r11\n\t" \
        "add r10, r12\n\t"

/* Keeps the run, at r0, and loads the registers of its changes; its count into r6. */
#define ARMV6M_LOAD_STEPS \
        ".syntax unified\n\t" \
        "push {r0}\n\t" \
        "ldm r0!, {r1, r2, r3, r4, r5, r6}\n\t" \
        "mov r8, r1\n\t" \
        "mov r9, r2\n\t" \
        "mov r10, r3\n\t" \
        "mov r11, r4\n\t" \
        "mov r12, r5\n\t"

/* Goes to the last pixels of a round of four where r6, the count, is no multiple of four: to the labels 32, 33 and 34 of its second,
 * third and fourth. Takes r6 and r7. */
#define ARMV6M_ENTER(SIZE) \
        "movs r7, #3\n\t" \
        "ands r7, r6\n\t" \
        "beq 31f\n\t" \
        "subs r7, #4\n\t" \
        "lsls r6, r7, #" SIZE "\n\t" \
        "adds r0, r6\n\t" \
        "lsls r6, r7, #1\n\t" \
        "adds r1, r6\n\t" \
        "adds r7, #2\n\t" \
        "bmi 34f\n\t" \
        "beq 33f\n\t" \
        "b 32f\n"

/* Colours, depth and z of the next pixel go into the run. */
#define ARMV6M_STORE_RUN \
        "pop {r7}\n\t" \
        "str r0, [r7, #24]\n\t" \
        "str r1, [r7, #28]\n\t" \
        "str r2, [r7, #32]"

/* Four pixels of a round, of which FIRST is the first. */
#define ARMV6M_FOUR(LOAD, STORE, SIZE, FIRST, BEND) \
        ARMV6M_PIXEL(LOAD, STORE, SIZE, FIRST, "2") ARMV6M_STEP BEND \
        "32: " ARMV6M_PIXEL(LOAD, STORE, SIZE, FIRST "+1", "3") ARMV6M_STEP BEND \
        "33: " ARMV6M_PIXEL(LOAD, STORE, SIZE, FIRST "+2", "4") ARMV6M_STEP BEND \
        "34: " ARMV6M_PIXEL(LOAD, STORE, SIZE, FIRST "+3", "5") ARMV6M_STEP BEND

/* LOAD and STORE are instructions for a texel and a pixel, which have 2^SIZE bytes; BEND is ARMV6M_BEND
 * or nothing. */
#define ARMV6M_COPY(LOAD, STORE, SIZE, BEND) \
    __asm__ volatile( \
        ARMV6M_LOAD_STEPS \
        "ldm r0, {r0, r1, r2, r3, r4, r5}\n\t" \
        "lsls r7, r6, #1\n\t" \
        "add r7, r1\n\t" \
        "mov lr, r7\n\t" \
        ARMV6M_ENTER(SIZE) \
        "31:\n\t" \
        ARMV6M_FOUR(LOAD, STORE, SIZE, "0", BEND) \
        "adds r0, #4<<" SIZE "\n\t" \
        "adds r1, #8\n\t" \
        "cmp r1, lr\n\t" \
        "bne 31b\n\t" \
        ARMV6M_STORE_RUN \
        : "+r"(r0) \
        : [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width + (kind == TEXELS_NARROW ? 1 : 2)), \
          [from_u] "i"(32 - log2_width) \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* Copied texels: 16 instructions a pixel, 18 where the changes of coordinates change, two more of wide ones. The sizes are constants. */
static inline __attribute__((always_inline)) void texels_copy_armv6m(struct texel_run *p, int log2_width,
                                                                     int log2_height, enum texel_kind kind)
{
    const bool bends = (p->ddu | p->ddv) != 0;
    register struct texel_run *r0 __asm__("r0") = p;
    if (kind == TEXELS_NARROW) {
        if (bends)
            ARMV6M_COPY("ldrh", "strh", "1", ARMV6M_BEND);
        else
            ARMV6M_COPY("ldrh", "strh", "1", "");
    } else {
        if (bends)
            ARMV6M_COPY("ldr", ARMV6M_STORE_WIDE, "2", ARMV6M_BEND);
        else
            ARMV6M_COPY("ldr", ARMV6M_STORE_WIDE, "2", "");
    }
}

/* As ARMV6M_PIXEL, of any size. On the stack from sp + 4 on lie how far v goes down to a texel's row, the mask of that, how far u
 * goes down, and a pointer to texels. ROW brings the row into r6, COLUMN the column into r7. */
#define ARMV6M_ANY_PIXEL(LOAD, STORE, SIZE, I, LABEL, ROW, COLUMN) \
        ARMV6M_SEEN(I, LABEL) \
        ROW COLUMN \
        "lsls r7, r7, #" SIZE "\n\t" \
        "orrs r6, r7\n\t" \
        "ldr r7, [sp, #16]\n\t" \
        LOAD " r6, [r7, r6]\n\t" \
        STORE " r6, [r0, #(" I ")<<" SIZE "]\n" \
        LABEL ": "

/* Where changes are the same all along, u is in r11 and v in r12, and r3, r4 and r5 say how far both go down, and the mask. */
#define ARMV6M_EVEN_START "mov r11, r3\n\t" "mov r12, r4\n\t" "ldr r3, [sp, #12]\n\t" "ldr r4, [sp, #4]\n\t" "ldr r5, [sp, #8]\n\t"
#define ARMV6M_EVEN_ROW "mov r6, r12\n\t" "lsrs r6, r4\n\t" "ands r6, r5\n\t"
#define ARMV6M_EVEN_COLUMN "mov r7, r11\n\t" "lsrs r7, r3\n\t"
#define ARMV6M_EVEN_STEP "add r11, r9\n\t" "add r12, r10\n\t"

/* Else r5 says how far u goes down. */
#define ARMV6M_BENT_START "ldr r5, [sp, #12]\n\t"
#define ARMV6M_BENT_ROW \
        "ldr r7, [sp, #4]\n\t" \
        "movs r6, r4\n\t" \
        "lsrs r6, r7\n\t" \
        "ldr r7, [sp, #8]\n\t" \
        "ands r6, r7\n\t"
#define ARMV6M_BENT_COLUMN "movs r7, r3\n\t" "lsrs r7, r5\n\t"
#define ARMV6M_BENT_STEP ARMV6M_STEP ARMV6M_BEND

/* As ARMV6M_COPY, by fours; WAY is EVEN or BENT. */
#define ARMV6M_COPY_ANY(LOAD, STORE, SIZE, WAY) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "ldr r4, [r0, #44]\n\t" \
        "push {r1, r2, r3, r4}\n\t" \
        ARMV6M_LOAD_STEPS \
        "ldm r0, {r0, r1, r2, r3, r4}\n\t" \
        ARMV6M_##WAY##_START \
        "lsls r7, r6, #1\n\t" \
        "add r7, r1\n\t" \
        "mov lr, r7\n\t" \
        ARMV6M_ENTER(SIZE) \
        "31:\n\t" \
        ARMV6M_ANY_PIXEL(LOAD, STORE, SIZE, "0", "2", ARMV6M_##WAY##_ROW, ARMV6M_##WAY##_COLUMN) ARMV6M_##WAY##_STEP \
        "32: " ARMV6M_ANY_PIXEL(LOAD, STORE, SIZE, "1", "3", ARMV6M_##WAY##_ROW, ARMV6M_##WAY##_COLUMN) ARMV6M_##WAY##_STEP \
        "33: " ARMV6M_ANY_PIXEL(LOAD, STORE, SIZE, "2", "4", ARMV6M_##WAY##_ROW, ARMV6M_##WAY##_COLUMN) ARMV6M_##WAY##_STEP \
        "34: " ARMV6M_ANY_PIXEL(LOAD, STORE, SIZE, "3", "5", ARMV6M_##WAY##_ROW, ARMV6M_##WAY##_COLUMN) ARMV6M_##WAY##_STEP \
        "adds r0, #4<<" SIZE "\n\t" \
        "adds r1, #8\n\t" \
        "cmp r1, lr\n\t" \
        "bne 31b\n\t" \
        ARMV6M_STORE_RUN "\n\t" \
        "add sp, #16" \
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3) \
        : \
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* Copied texels of any size: 19 1/2 instructions a pixel, 23 1/2 where the changes of coordinates change, two more of wide ones. */
SMEAR_INLINE void texels_copy_any_armv6m(struct texel_run *p, int log2_width, int log2_height, enum texel_kind kind)
{
    const bool bends = (p->ddu | p->ddv) != 0;
    const int to_v = log2_width + (kind == TEXELS_NARROW ? 1 : 2);
    register struct texel_run *r0 __asm__("r0") = p;
    register int32_t r1 __asm__("r1") = 32 - log2_height - to_v;
    register int32_t r2 __asm__("r2") = ((1 << log2_height) - 1) << to_v;
    register int32_t r3 __asm__("r3") = 32 - log2_width;
    if (kind == TEXELS_NARROW) {
        if (bends)
            ARMV6M_COPY_ANY("ldrh", "strh", "1", BENT);
        else
            ARMV6M_COPY_ANY("ldrh", "strh", "1", EVEN);
    } else {
        if (bends)
            ARMV6M_COPY_ANY("ldr", ARMV6M_STORE_WIDE, "2", BENT);
        else
            ARMV6M_COPY_ANY("ldr", ARMV6M_STORE_WIDE, "2", EVEN);
    }
}

/* As ARMV6M_PIXEL, for lit texels of any size. u in r3 and v in r4 count from the cell of the last pixel drawn, which is in lr;
 * r5 is the cell's size. Beyond it the code at 8 makes another, whose texel is found. */
#define ARMV6M_LIT_PIXEL(STORE, AT, PLACE, LABEL, KNOWN) \
        "lsrs r6, r2, #16\n\t" \
        "ldrh r7, [r1, #" AT "]\n\t" \
        "add r2, r8\n\t" \
        "cmp r7, r6\n\t" \
        "bhs " LABEL "f\n\t" \
        "strh r6, [r1, #" AT "]\n\t" \
        "movs r6, r3\n\t" \
        "orrs r6, r4\n\t" \
        "cmp r6, r5\n\t" \
        "blo " KNOWN "f\n\t" \
        "bl 8f\n" \
        KNOWN ": mov r6, lr\n\t" \
        STORE " r6, [r0, #" PLACE "]\n" \
        LABEL ": "

/* On the stack from sp on lie the run's end, pointers to the light and to the run. As ARMV6M_COPY, by fours. */
#define ARMV6M_LIT_FOURS(STORE, SIZE, AT1, AT2, AT3, AT4, BEND) \
    __asm__ volatile( \
        ARMV6M_LOAD_STEPS \
        "ldr r1, [r0, #4]\n\t" \
        "lsls r2, r6, #1\n\t" \
        "adds r2, r1\n\t" \
        "ldr r7, [r0, #24]\n\t" \
        "push {r2, r7}\n\t" \
        "ldm r7!, {r1, r5}\n\t" \
        "mov lr, r1\n\t" \
        "ldm r0, {r0, r1, r2, r3, r4}\n\t" \
        "ldr r7, [sp, #4]\n\t" \
        "ldr r7, [r7, #8]\n\t" \
        "subs r3, r3, r7\n\t" \
        "ldr r7, [sp, #4]\n\t" \
        "ldr r7, [r7, #12]\n\t" \
        "subs r4, r4, r7\n\t" \
        ARMV6M_ENTER(SIZE) \
        "31:\n\t" \
        ARMV6M_LIT_PIXEL(STORE, "0", "0", "2", "12") \
        ARMV6M_STEP BEND \
        "32:\n\t" \
        ARMV6M_LIT_PIXEL(STORE, "2", AT1, "3", "13") \
        ARMV6M_STEP BEND \
        "33:\n\t" \
        ARMV6M_LIT_PIXEL(STORE, "4", AT2, "4", "14") \
        ARMV6M_STEP BEND \
        "34:\n\t" \
        ARMV6M_LIT_PIXEL(STORE, "6", AT3, "5", "15") \
        ARMV6M_STEP BEND \
        "adds r0, #" AT4 "\n\t" \
        "adds r1, #8\n\t" \
        "ldr r7, [sp]\n\t" \
        "cmp r1, r7\n\t" \
        "bne 31b\n\t" \
        "b 9f\n" \
        "8: push {r0, r1, r2, lr}\n\t" \
        "mov r6, r12\n\t" \
        "push {r6}\n\t" \
        "ldr r0, [sp, #24]\n\t" \
        "ldr r5, [r0, #8]\n\t" \
        "adds r1, r5, r3\n\t" \
        "ldr r5, [r0, #12]\n\t" \
        "adds r2, r5, r4\n\t" \
        "ldr r5, [r0, #16]\n\t" \
        "subs r6, r5, #1\n\t" \
        "movs r3, r1\n\t" \
        "ands r3, r6\n\t" \
        "movs r4, r2\n\t" \
        "ands r4, r6\n\t" \
        "subs r6, r1, r3\n\t" \
        "str r6, [r0, #8]\n\t" \
        "subs r6, r2, r4\n\t" \
        "str r6, [r0, #12]\n\t" \
        "ldr r6, [r0, #20]\n\t" \
        "lsrs r2, r6\n\t" \
        "ldr r6, [r0, #24]\n\t" \
        "ands r2, r6\n\t" \
        "ldr r6, [r0, #28]\n\t" \
        "lsrs r1, r6\n\t" \
        "orrs r1, r2\n\t" \
        "movs r6, r3\n\t" \
        "movs r7, r0\n\t" \
        "bl %c[find]\n\t" \
        "str r5, [r7, #4]\n\t" \
        "movs r3, r6\n\t" \
        "movs r6, r0\n\t" \
        "pop {r7}\n\t" \
        "mov r12, r7\n\t" \
        "pop {r0, r1, r2, r7}\n\t" \
        "mov lr, r6\n\t" \
        "bx r7\n" \
        "9: add sp, #8\n\t" \
        ARMV6M_STORE_RUN \
        : "+r"(r0) \
        : [find] "i"(smear_texel_light_find) \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* Lit texels: 17 instructions a pixel, 15 where the changes of coordinates don't change. */
SMEAR_INLINE void texels_light_armv6m(struct texel_run *p, enum texel_kind kind)
{
    const bool bends = (p->ddu | p->ddv) != 0;
    register struct texel_run *r0 __asm__("r0") = p;
    if (texels_are_narrow(kind)) {
        if (bends)
            ARMV6M_LIT_FOURS("strh", "1", "2", "4", "6", "8", ARMV6M_BEND);
        else
            ARMV6M_LIT_FOURS("strh", "1", "2", "4", "6", "8", "");
    } else {
        if (bends)
            ARMV6M_LIT_FOURS("str", "2", "4", "8", "12", "16", ARMV6M_BEND);
        else
            ARMV6M_LIT_FOURS("str", "2", "4", "8", "12", "16", "");
    }
}

#endif

#endif
