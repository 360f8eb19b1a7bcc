/* SPDX-License-Identifier: MIT */
/* texel_curve_rows.h - rows of copied texels one below the other, whose coordinates are polynomials. */
#ifndef SMEAR_KERNELS_TEXEL_CURVE_ROWS_H
#define SMEAR_KERNELS_TEXEL_CURVE_ROWS_H

#include "kernels/kernels.h"
#include "kernels/texel_run.h"
#include "kernels/texels_draw.h"
#include "kernels/texels_draw_armv7em.h"

/* Rows one below the other, and coordinates of their pixels. */
struct texel_curve_rows {
    const struct span_side *side;
    int32_t count;              /* of rows; at least one */
    int32_t y;                  /* polynomials are of x - x0 and of y, y + 1 and so on */
    uint32_t z;                 /* depth code 16.16 at column 0 of the first row */
    uint16_t *depth;            /* of that pixel, which may lie outside the memory */
    int32_t x0;
    uint32_t dz_down;           /* how z changes from row to row */
    int32_t stride;             /* bytes */
    struct curve u, v;
    uint32_t dz, ddu, ddv;      /* ddu is 2 dxx of u */
    intptr_t to_pixels;         /* bytes from a depth to its pixel; where they are wide, of an address twice the depth's */
    const void *texels;
};

#if TEXEL_CURVE_ROWS
SMEAR_STATIC_ASSERT(offsetof(struct texel_curve_rows, u) == 32 && offsetof(struct texel_curve_rows, dz) == 80
                        && sizeof(struct curve) == 24 && sizeof(struct span_side) == 12
                        && offsetof(struct span_side, right) == 4,
                    "the assembly knows struct texel_curve_rows and struct span_side");
#endif

/* Assembly begins each row by going on to the next one. */
static inline void texel_curve_rows_before(struct texel_curve_rows *r)
{
    r->y--;
    r->z -= r->dz_down;
    r->depth = (uint16_t *)((uintptr_t)r->depth - (uintptr_t)r->stride);
}

/* Draws rows from left to before right, where there are such pixels, as texels_draw does. Afterwards the rows are anything. Texels are
 * narrow or wide. */
#if SMEAR_ASM_ARMV6M

/* Of a polynomial at r7, of x in r10 and y in r6: the value into r4, the first change into r3. Takes r0 to r5. */
#define ARMV6M_POLYNOMIAL \
        "ldm r7!, {r0, r1, r2, r3, r4, r5}\n\t" \
        "muls r4, r6\n\t" \
        "adds r1, r1, r4\n\t" \
        "muls r5, r6\n\t" \
        "adds r2, r2, r5\n\t" \
        "muls r2, r6\n\t" \
        "adds r0, r0, r2\n\t" \
        "mov r5, r10\n\t" \
        "movs r4, r3\n\t" \
        "muls r4, r5\n\t" \
        "adds r1, r1, r4\n\t" \
        "adds r3, r3, r1\n\t" \
        "adds r3, r3, r4\n\t" \
        "muls r1, r5\n\t" \
        "adds r4, r0, r1\n\t"

/* The rows' members come to the next row and go to registers: -n into r1, where it has n > 0 pixels, y into r2, z into r3, depths into
 * r4, x0 into r5 and the left side into r6. Else goes on at 40, or 42 behind the last row. */
#define ARMV6M_NEXT_ROW \
        "40: ldr r7, [sp]\n\t" \
        "ldm r7!, {r0, r1, r2, r3, r4, r5, r6}\n\t" \
        "subs r1, r1, #1\n\t" \
        "bpl 41f\n\t" \
        "b 42f\n" \
        "41: adds r2, r2, #1\n\t" \
        "adds r3, r3, r6\n\t" \
        "ldr r6, [r7]\n\t" \
        "adds r4, r4, r6\n\t" \
        "subs r7, #28\n\t" \
        "adds r0, #12\n\t" \
        "stm r7!, {r0, r1, r2, r3, r4}\n\t" \
        "ldm r0, {r0, r6}\n\t" \
        "subs r1, r0, r6\n\t" \
        "bge 40b\n\t"

/* Rounds have eight pixels; the first begins so many before the row's that its last are the row's. Their number goes to the stack, with
 * depth and z at the row's first pixel, and space for u; where rounds end goes to lr, y to r6, x to r10. */
#define ARMV6M_ROW_PLACE \
        "movs r6, r2\n\t" \
        "lsls r2, r0, #1\n\t" \
        "adds r4, r4, r2\n\t" \
        "lsls r2, r1, #1\n\t" \
        "subs r2, r4, r2\n\t" \
        "mov lr, r2\n\t" \
        "subs r5, r0, r5\n\t" \
        "mov r10, r5\n\t" \
        "mov r5, r8\n\t" \
        "muls r5, r0\n\t" \
        "adds r5, r5, r3\n\t" \
        "movs r0, #7\n\t" \
        "ands r0, r1\n\t" \
        "subs r4, r4, r0\n\t" \
        "subs r4, r4, r0\n\t" \
        "push {r0, r4, r5, r6}\n\t"

/* On the stack lie the rows, whose members have come to the row before. PLACE makes a pixel's address of that of its depth, a
 * pixel's code has so many BYTES. */
#define ARMV6M_CURVE_ROWS(LOAD, STORE, SIZE, BYTES, PLACE) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "push {r0}\n\t" \
        "adds r0, #80\n\t" \
        "ldm r0!, {r1, r2, r3}\n\t" \
        "mov r8, r1\n\t" \
        "mov r11, r2\n\t" \
        "mov r12, r3\n" \
        ARMV6M_NEXT_ROW \
            ARMV6M_ROW_PLACE \
        "adds r7, #12\n\t" \
        ARMV6M_POLYNOMIAL \
        "str r4, [sp, #12]\n\t" \
        "mov r9, r3\n\t" \
        ARMV6M_POLYNOMIAL \
        "mov r10, r3\n\t" \
        "ldr r6, [r7, #12]\n\t" \
        "ldr r5, [r7, #16]\n\t" \
        "pop {r0, r1, r2, r3}\n\t" \
        "movs r7, #" BYTES "\n\t" \
        "muls r7, r0\n\t" \
        PLACE \
        "add pc, r7\n\t" \
        "nop\n" \
        "31:\n\t" \
        ARMV6M_FOUR(LOAD, STORE, SIZE, "0", ARMV6M_BEND) \
        ARMV6M_FOUR(LOAD, STORE, SIZE, "4", ARMV6M_BEND) \
        "adds r0, #8<<" SIZE "\n\t" \
        "adds r1, #16\n\t" \
        "cmp r1, lr\n\t" \
        "beq 9f\n\t" \
        "b 31b\n" \
        "9: b 40b\n" \
        "42: add sp, #4" \
        : "+r"(r0) \
        : [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width + (kind == TEXELS_NARROW ? 1 : 2)), [from_u] "i"(32 - log2_width) \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

static inline __attribute__((always_inline)) void texel_curve_rows_armv6m(struct texel_curve_rows *rows, int log2_width, int log2_height,
                                                                          enum texel_kind kind)
{
    rows->side = (const struct span_side *)((uintptr_t)rows->side - sizeof(struct span_side));
    texel_curve_rows_before(rows);
    register struct texel_curve_rows *r0 __asm__("r0") = rows;
    if (kind == TEXELS_NARROW)
        ARMV6M_CURVE_ROWS("ldrh", "strh", "1", "34", "adds r0, r1, r6\n\t");
    else
        ARMV6M_CURVE_ROWS("ldr", ARMV6M_STORE_WIDE, "2", "38", "adds r0, r1, r1\n\tadds r0, r0, r6\n\t");
}
#define texel_curve_rows_draw texel_curve_rows_armv6m
#endif

#if SMEAR_ASM_ARMV7EM

/* Of a polynomial at, dx, dy, dxx, dxy and dyy are in registers, x in r12 and y in r3: VALUE becomes the value, STEP the first change. */
#define ARMV7EM_POLYNOMIAL(AT, DX, DY, DXX, DXY, DYY, VALUE, STEP) \
        "mla " DX ", " DXY ", r3, " DX "\n\t" \
        "mla " DY ", " DYY ", r3, " DY "\n\t" \
        "mla " AT ", " DY ", r3, " AT "\n\t" \
        "mla " DYY ", " DXX ", r12, " DX "\n\t" \
        "mla " DX ", " DXX ", r12, " DYY "\n\t" \
        "mla " VALUE ", " DYY ", r12, " AT "\n\t" \
        "add " STEP ", " DX ", " DXX "\n\t"

/* On the stack lie the rows, whose members have come to the row before. PLACE makes of a depth's address what r7 and r8 point to. */
#define ARMV7EM_CURVE_ROWS(KIND, PLACE) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "push {r0}\n" \
        "40: ldr r0, [sp]\n" \
        "41: ldm r0, {r1, r2, r3, r4, r5, r6, r7, r8}\n\t" \
        "subs r2, r2, #1\n\t" \
        "blt 42f\n\t" \
        "ldrd r9, r10, [r1], #12\n\t" \
        "adds r3, r3, #1\n\t" \
        "add r4, r4, r7\n\t" \
        "add r5, r5, r8\n\t" \
        "stm r0, {r1, r2, r3, r4, r5}\n\t" \
        "subs lr, r10, r9\n\t" \
        "ble 41b\n\t" \
        "add r7, r5, r9, lsl #1\n\t" \
        "sub r12, r9, r6\n\t" \
        "ldr r1, [r0, #80]\n\t" \
        "mla r9, r1, r9, r4\n\t" \
        "adds r0, #32\n\t" \
        "ldm r0!, {r1, r2, r6, r8, r10, r11}\n\t" \
        ARMV7EM_POLYNOMIAL("r1", "r2", "r6", "r8", "r10", "r11", "r10", "r2") \
        "ldm r0!, {r1, r4, r5, r6, r8, r11}\n\t" \
        ARMV7EM_POLYNOMIAL("r1", "r4", "r5", "r6", "r8", "r11", "r11", "r3") \
        "ldm r0, {r1, r4, r5, r8, r12}\n\t" \
        PLACE \
        ARMV7EM_BENT(KIND, "40b") \
        "42: add sp, #4" \
        : "+r"(r0) \
        : ARMV7EM_SIZES \
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

static inline __attribute__((always_inline)) void texel_curve_rows_armv7em(struct texel_curve_rows *rows, int log2_width, int log2_height,
                                                                           enum texel_kind kind)
{
    texel_curve_rows_before(rows);
    register struct texel_curve_rows *r0 __asm__("r0") = rows;
    if (kind == TEXELS_NARROW)
        ARMV7EM_CURVE_ROWS(NARROW, "add r7, r7, r8\n\trsb r8, r8, #0\n\t");
    else
        ARMV7EM_CURVE_ROWS(WIDE, "add r8, r8, r7, lsl #1\n\t");
}
#define texel_curve_rows_draw texel_curve_rows_armv7em
#endif

#if !TEXEL_CURVE_ROWS
/* Nowhere, and not called. */
void texel_curve_rows_draw(struct texel_curve_rows *rows, int log2_width, int log2_height, enum texel_kind kind);
#endif

#endif
