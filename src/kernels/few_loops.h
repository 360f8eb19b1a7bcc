/* SPDX-License-Identifier: MIT */
/* few_loops.h - loops for rows of textured triangles of few pixels, with all planes in a vector, or in registers that compilers do not
 * have. The loop that defines their results is few_rows of raster/few_draw.c. */
#ifndef SMEAR_KERNELS_FEW_LOOPS_H
#define SMEAR_KERNELS_FEW_LOOPS_H

#include "base/tables.h"
#include "kernels/few_rows.h"
#include "kernels/texel_light.h"
#include "kernels/vector.h"

/* Draws pixel i in the look of texel `index`, in light of 16 bits q15 where it is lit. */
SMEAR_INLINE void few_pixel_draw(void *pixels, size_t i, const void *texels, uint32_t index, uint32_t light, enum few_kind kind)
{
    const uint16_t *const narrow = (const uint16_t *)texels;
    const uint32_t *const wide = (const uint32_t *)texels;
    if (kind == FEW_NARROW)
        ((uint16_t *)pixels)[i] = narrow[index];
    else if (kind == FEW_WIDE)
        ((uint32_t *)pixels)[i] = wide[index] & 0xffffffu;
    else if (kind == FEW_LINEAR)
        ((uint32_t *)pixels)[i] = shaded_pixel(wide[index], 0, 0, light >> 7, true, true);
    else if (kind == FEW_NARROW_LIT)
        ((uint16_t *)pixels)[i] = (uint16_t)rgb565_nearest(shaded_pixel(texel_fetch(texels, NULL, index, SMEAR_TEXEL_565), 0, 0,
                                                                        light >> 7, true, false));
}

#if SMEAR_VECTORS
/* Draws one row or more. */
SMEAR_INLINE void few_rows_lanes(struct few_box *box, const struct few_texels *t, enum few_kind kind)
{
    const smear_v4u right = v4u_load((const uint32_t *)box->right.plane), down = v4u_load((const uint32_t *)box->down.plane);
    const smear_v4u turn = { 0, t->width << 16, t->height << 16, 0 };
    const uint64_t right_edges = box->right.edges, down_edges = box->down.edges;
    const uint32_t width = t->width, columns = box->columns;
    const void *const texels = t->texels;
    void *const pixels = t->pixels;
    uint16_t *const depth = t->depth;
    smear_v4u first = v4u_load((const uint32_t *)box->at.plane);
    uint64_t first_edges = box->at.edges;
    size_t row = (size_t)(box->depth - depth);
    const size_t end = (size_t)(box->depth_end - depth), stride = box->depth_bytes / 2u;
    for (; row != end; row += stride, first += down, first_edges += down_edges) {
        smear_v4u p = first;
        uint64_t edges = first_edges;
        uint32_t left = columns;
        for (; few_outside(edges) && --left != 0; p += right)
            edges += right_edges;
        if (left == 0)
            continue;
        size_t i = row + (columns - left);
        do {
            const uint32_t code = ((smear_v8u)p)[2 * FEW_DEPTH + 1];
            if (code > depth[i]) {
                const smear_v8u texel = (smear_v8u)v4u_mulh16(p, turn);
                depth[i] = (uint16_t)code;
                few_pixel_draw(pixels, i, texels, texel[2 * FEW_V + 1] * width + texel[2 * FEW_U + 1], p[FEW_BLUE], kind);
            }
            edges += right_edges;
            p += right;
            i++;
        } while (!few_outside(edges));
    }
    box->at.edges = first_edges;
    v4u_store((uint32_t *)box->at.plane, first);
}

SMEAR_CALLED void few_rows_narrow(struct few_box *box, const struct few_texels *t) { few_rows_lanes(box, t, FEW_NARROW); }
SMEAR_CALLED void few_rows_wide(struct few_box *box, const struct few_texels *t) { few_rows_lanes(box, t, FEW_WIDE); }
SMEAR_CALLED void few_rows_linear(struct few_box *box, const struct few_texels *t) { few_rows_lanes(box, t, FEW_LINEAR); }
SMEAR_CALLED void few_rows_narrow_lit(struct few_box *box, const struct few_texels *t) { few_rows_lanes(box, t, FEW_NARROW_LIT); }

static inline void few_rows_loop(struct few_box *box, const struct few_texels *t, enum few_kind kind)
{
    if (kind == FEW_NARROW)
        few_rows_narrow(box, t);
    else if (kind == FEW_WIDE)
        few_rows_wide(box, t);
    else if (kind == FEW_LINEAR)
        few_rows_linear(box, t);
    else
        few_rows_narrow_lit(box, t);
}
#endif

#if SMEAR_ASM_ARMV7EM
SMEAR_STATIC_ASSERT(sizeof(struct few_values) == 40 && offsetof(struct few_box, columns) == 120
                        && offsetof(struct few_box, depth_end) == 132 && offsetof(struct few_texels, texels) == 28,
                    "the assembly knows them");

/* The texel at r4 and r5, turned by half a turn, so that products with sign tell texels from the middle on: LOAD takes it from lr, r12. */
#define FEW_TEXEL(LOAD)                       \
    "ldrd r12, lr, [sp, #4]\n\t"              \
    "smmul lr, r5, lr\n\tmul lr, lr, r12\n\t" \
    "smmla r12, r4, r12, lr\n\t"              \
    "ldr lr, [sp, #12]\n\t"                   \
    LOAD
#define FEW_PIXEL_NARROW                         \
    FEW_TEXEL("ldrh r12, [lr, r12, lsl #1]\n\t") \
    "ldr lr, [sp, #16]\n\t"                      \
    "strh r12, [lr, r0]\n"
#define FEW_PIXEL_WIDE                          \
    FEW_TEXEL("ldr r12, [lr, r12, lsl #2]\n\t") \
    "ldr lr, [sp, #16]\n\t"                     \
    "bic r12, r12, #0xff000000\n\t"             \
    "str r12, [lr, r0, lsl #1]\n"

/* In the light r11: shaded_pixel. */
#define FEW_PIXEL_LINEAR                                         \
    FEW_TEXEL("ldr r12, [lr, r12, lsl #2]\n\t")                  \
    "ubfx r6, r11, #15, #16\n\tadd r6, r6, r11, lsr #30\n\t"     \
    "ldr r7, [sp, #24]\n\t"                                      \
    "ubfx lr, r12, #8, #8\n\tubfx r8, r12, #16, #8\n\t"          \
    "uxtb r12, r12\n\t"                                          \
    "ldrh lr, [r7, lr, lsl #1]\n\tldrh r8, [r7, r8, lsl #1]\n\t" \
    "ldrh r12, [r7, r12, lsl #1]\n\t"                            \
    "mul lr, lr, r6\n\tmul r8, r8, r6\n\t"                       \
    "mul r12, r12, r6\n\t"                                       \
    "ldr r7, [sp, #28]\n\t"                                      \
    "lsr lr, lr, #20\n\tlsr r8, r8, #20\n\t"                     \
    "lsr r12, r12, #20\n\t"                                      \
    "ldrb lr, [r7, lr]\n\tldrb r8, [r7, r8]\n\t"                 \
    "ldrb r12, [r7, r12]\n\t"                                    \
    "orr r12, r12, lr, lsl #8\n\torr r12, r12, r8, lsl #16\n\t"  \
    "ldr lr, [sp, #16]\n\t"                                      \
    "ldr r6, [sp]\n\t"                                           \
    "str r12, [lr, r0, lsl #1]\n\t"                              \
    "ldr r8, [r6, #88]\n\t"                                      \
    "ldrd r6, r7, [r6, #80]\n"

/* Red and blue lie in the halves of lr, green in r12: texel_fetch, shaded_pixel and rgb565_nearest, whose 1014 may be 1024. */
#define FEW_PIXEL_NARROW_LIT                                  \
    FEW_TEXEL("ldrh r12, [lr, r12, lsl #1]\n\t")              \
    "ubfx r6, r11, #23, #8\n\t"                               \
    "lsr lr, r12, #11\n\tbfi lr, r12, #16, #5\n\t"            \
    "movw r7, #2108\n\tmul lr, lr, r7\n\t"                    \
    "add lr, lr, #0x5c005c\n\tuxtb16 lr, lr, ror #8\n\t"      \
    "mul lr, lr, r6\n\tadd lr, lr, #0x800080\n\t"             \
    "uxtab16 lr, lr, lr, ror #8\n\tuxtb16 lr, lr, ror #8\n\t" \
    "mov r7, #249\n\tmul lr, lr, r7\n\t"                      \
    "add lr, lr, #0x4000400\n\t"                              \
    "ubfx r12, r12, #5, #6\n\t"                               \
    "movw r7, #259\n\tmul r12, r12, r7\n\t"                   \
    "add r12, r12, #33\n\tlsr r12, r12, #6\n\t"               \
    "mul r12, r12, r6\n\tadd r12, r12, #128\n\t"              \
    "add r12, r12, r12, lsr #8\n\tlsr r12, r12, #8\n\t"       \
    "mov r7, #253\n\tmul r12, r12, r7\n\t"                    \
    "addw r12, r12, #505\n\tlsr r12, r12, #10\n\t"            \
    "bfi lr, r12, #5, #6\n\t"                                 \
    "lsr r12, lr, #27\n\tbfi lr, r12, #0, #5\n\t"             \
    "ldr r12, [sp, #16]\n\t"                                  \
    "strh lr, [r12, r0]\n\t"                                  \
    "ldrd r6, r7, [sp, #36]\n"

/* What is done for light alone, or without it. */
#define FEW_LEFT_OUT(...)
#define FEW_DONE(...) __VA_ARGS__

/* At r0, struct few_box; at r1, struct few_texels, which then lies at sp + 4. In rows: edge functions in r1 and r2, their steps in r6 and
 * r7; depth, u and v in r3 to r5, theirs in r8 to r10; the address of a depth in r0; in r11 the mask that tells what is outside or, of
 * pixels in light, light. */
#define FEW_ROWS_ARMV7EM(PIXEL, LIT, UNLIT, MASK, ROW_MASK)                      \
    __asm__ volatile(                                                            \
        ".syntax unified\n\t"                                                    \
        "ldm r1, {r1, r2, r3, r4, r5, r6, r7}\n\t"                               \
        LIT("ldr r8, [r0, #100]\n\tldrd r9, r10, [r0, #80]\n\t")                 \
        "push {r0, r1, r2, r3, r4, r5, r6, r7, r8, r9" LIT(", r10, r11") "}\n\t" \
        "mov r11, r5\n"                                                          \
        "1: ldm r0, {r1, r2, r3, r4, r5" LIT(", r11") "}\n\t"                    \
        "add r12, r0, #40\n\t"                                                   \
        "ldm r12, {r6, r7, r8, r9, r10" LIT(", lr") "}\n\t"                      \
        "adds r6, r6, r1\n\tadc r7, r7, r2\n\t"                                  \
        "add r8, r8, r3\n\tadd r9, r9, r4\n\t"                                   \
        "add r10, r10, r5\n\t"                                                   \
        LIT("add lr, lr, r11\n\t")                                               \
        "stm r0, {r6, r7, r8, r9, r10" LIT(", lr") "}\n\t"                       \
        "add r12, r0, #80\n\tldm r12, {r6, r7, r8, r9, r10}\n\t"                 \
        UNLIT("ldrd r12, lr, [r0, #120]\n\t")                                    \
        LIT("ldr r12, [r0, #120]\n\tldr lr, [sp, #20]\n\t")                      \
        "orr r0, r2, r1, lsl #10\n\ttst r0, " ROW_MASK "\n\t"                    \
        "beq 3f\n"                                                               \
        "2: subs r12, #1\n\tbeq 6f\n\t"                                          \
        "adds r1, r1, r6\n\tadc r2, r2, r7\n\t"                                  \
        "orr r0, r2, r1, lsl #10\n\ttst r0, " ROW_MASK "\n\t"                    \
        "bne 2b\n"                                                               \
        "3: ldr r0, [sp]\n\t"                                                    \
        LIT("ldr lr, [r0, #124]\n\t")                                            \
        "ldr r0, [r0, #120]\n\tsub r0, r0, r12\n\t"                              \
        "mla r3, r8, r0, r3\n\tmla r4, r9, r0, r4\n\t"                           \
        "mla r5, r10, r0, r5\n\t"                                                \
        LIT("ldr r12, [sp, #32]\n\t"                                             \
            "mla r11, r12, r0, r11\n\t")                                         \
        "add r0, lr, r0, lsl #1\n"                                               \
        "4: ldrh r12, [r0], #2\n\t"                                              \
        "cmp r12, r3, lsr #16\n\tbhs 5f\n\t"                                     \
        "lsr r12, r3, #16\n\tstrh r12, [r0, #-2]\n\t"                            \
        PIXEL                                                                    \
        "5: adds r1, r1, r6\n\tadc r2, r2, r7\n\t"                               \
        "add r3, r3, r8\n\tadd r4, r4, r9\n\t"                                   \
        "add r5, r5, r10\n\t"                                                    \
        LIT("ldr r12, [sp, #32]\n\t"                                             \
            "add r11, r11, r12\n\t"                                              \
            "ldr r12, [sp, #20]\n\t")                                            \
        "orr lr, r2, r1, lsl #10\n\t"                                            \
        "tst lr, " MASK "\n\t"                                                   \
        "beq 4b\n"                                                               \
        "6: ldr r0, [sp]\n\t"                                                    \
        "ldrd r1, r2, [r0, #124]\n\t"                                            \
        "ldr r3, [r0, #132]\n\t"                                                 \
        "add r1, r1, r2\n\tstr r1, [r0, #124]\n\t"                               \
        "cmp r1, r3\n\tbne 1b\n\t"                                               \
        UNLIT("add sp, #40") LIT("add sp, #48")                                  \
        : "+r"(r0), "+r"(r1)                                                     \
        :                                                                        \
        : "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* Draws one row or more: 22 instructions for a pixel that is seen, of light 43, encoded 57; compilers take 30, 70 and 97. */
SMEAR_CALLED void few_rows_loop(struct few_box *rows, const struct few_texels *texels, enum few_kind kind)
{
    register struct few_box *r0 __asm__("r0") = rows;
    register const struct few_texels *r1 __asm__("r1") = texels;
    if (kind == FEW_NARROW)
        FEW_ROWS_ARMV7EM(FEW_PIXEL_NARROW, FEW_LEFT_OUT, FEW_DONE, "r11", "r11");
    else if (kind == FEW_WIDE)
        FEW_ROWS_ARMV7EM(FEW_PIXEL_WIDE, FEW_LEFT_OUT, FEW_DONE, "r11", "r11");
    else if (kind == FEW_NARROW_LIT)
        FEW_ROWS_ARMV7EM(FEW_PIXEL_NARROW_LIT, FEW_DONE, FEW_LEFT_OUT, "r12", "lr");
    else
        FEW_ROWS_ARMV7EM(FEW_PIXEL_LINEAR, FEW_DONE, FEW_LEFT_OUT, "r12", "lr");
}
#endif

#if !FEW_ROWS_LOOP
static inline void few_rows_loop(struct few_box *rows, const struct few_texels *texels, enum few_kind kind)
{
    (void)rows, (void)texels, (void)kind;
}
#endif

#endif
