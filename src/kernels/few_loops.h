/* SPDX-License-Identifier: MIT */
/* few_loops.h - loops for rows of textured triangles of few pixels, with all planes in registers that compilers do not have. The loop that
 * defines their results is few_rows of raster/few_draw.c. */
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

/* Puts down what assembly takes of constants, in its order. */
static inline void few_words_take(struct few_texels *t, uint32_t to_pixels, enum few_kind kind)
{
    uint32_t *const word = t->word;
    int n = 0;
    if (SMEAR_ASM_ARMV6M) {
        const int log2_width = 31 - count_leading_zeros(t->width), log2_height = 31 - count_leading_zeros(t->height);
        word[n++] = (uint32_t)((32 - log2_height) | log2_width << 8 | (32 - log2_width) << 16);
        word[n++] = (uint32_t)(uintptr_t)t->texels;
        to_pixels += kind == FEW_NARROW ? 2u : 4u;
    } else if (kind == FEW_NARROW_LIT) {
        word[n++] = 2108;               /* 5 bits become 8, two in a word */
        word[n++] = 0x5c005c;
        word[n++] = 543262232;          /* 255 / 63, of bits from 5 on */
        word[n++] = 0x800080;
        word[n++] = 16843009;           /* 1 / 255 */
        word[n++] = 1061109567;         /* 63 / 255 */
    } else if (kind == FEW_LINEAR) {
        word[n++] = (uint32_t)(uintptr_t)smear_srgb_decode;
        word[n++] = (uint32_t)(uintptr_t)smear_srgb_encode;
    }
    word[n] = to_pixels;
}

static inline bool few_is_white(const int32_t *color)
{
    return (uint32_t)color[0] == ((uint32_t)color[1] & 0xffffu) * 0x10001u;
}

/* Channel c of a vertex, 16 bits, with a margin from 0 and 65536 that errors of slopes do not cross; codes are rounded. */
static inline int32_t few_light_value(const int32_t *color, int c, bool linear)
{
    const int32_t value = (int32_t)((uint32_t)color[c >> 1] >> (c << 4 & 16) & 0xffffu);
    return linear && c < 3 ? value - (value >> 9) + 64 : min_i32(value, 0xff00) + 0x80;
}

#if SMEAR_ASM_ARMV7EM || SMEAR_ASM_ARMV6M
SMEAR_STATIC_ASSERT(sizeof(struct few_values) == 40 && offsetof(struct few_box, columns) == 120
                        && offsetof(struct few_box, depth_end) == 132 && offsetof(struct few_texels, word) == 12,
                    "the assembly knows them");
#define FEW_REGISTERS \
    : "+r"(r0), "+r"(r1) : : "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory"
#endif

#if SMEAR_ASM_ARMV7EM
/* The texel at r4 and r5, turned by half a turn, so that products with sign tell texels from the middle on, which are at r11. */
#define FEW_TEXEL(LOAD)                       \
    "ldrd r12, lr, [sp, #4]\n\t"              \
    "smmul lr, r5, lr\n\tmul lr, lr, r12\n\t" \
    "smmla r12, r4, r12, lr\n\tldr lr, [sp, #12]\n\t" LOAD
#define FEW_PIXEL_NARROW                          \
    FEW_TEXEL("ldrh r12, [r11, r12, lsl #1]\n\t") \
    "strh r12, [lr, r0]\n"
#define FEW_PIXEL_WIDE                           \
    FEW_TEXEL("ldr r12, [r11, r12, lsl #2]\n\t") \
    "bic r12, r12, #0xff000000\n\t"              \
    "str r12, [lr, r0, lsl #1]\n"

/* In the light r11: what struct few_texels has first comes at once. */
#define FEW_TEXEL_LIT(LOAD)                                     \
    "ldr lr, [sp, #24]\n\tldm lr!, {r6, r7, r8, r9, r10, r12}\n\t"                   \
    "smmul r7, r5, r7\n\tmul r7, r7, r6\n\t"                    \
    "smmla r6, r4, r6, r7\n\t" LOAD

/* shaded_pixel. */
#define FEW_PIXEL_LINEAR                                        \
    FEW_TEXEL_LIT("ldr r6, [r8, r6, lsl #2]\n\t")               \
    "ubfx r7, r11, #15, #16\n\tadd r7, r7, r11, lsr #30\n\t"    \
    "ubfx r8, r6, #8, #8\n\tubfx lr, r6, #16, #8\n\t"           \
    "uxtb r6, r6\n\t"                                           \
    "ldrh r8, [r9, r8, lsl #1]\n\tldrh lr, [r9, lr, lsl #1]\n\t" \
    "ldrh r6, [r9, r6, lsl #1]\n\t"                             \
    "mul r8, r8, r7\n\tmul lr, lr, r7\n\t"                      \
    "mul r6, r6, r7\n\t"                                        \
    "lsr r8, r8, #20\n\tlsr lr, lr, #20\n\t"                    \
    "lsr r6, r6, #20\n\t"                                       \
    "ldrb r8, [r10, r8]\n\tldrb lr, [r10, lr]\n\t"              \
    "ldrb r6, [r10, r6]\n\t"                                    \
    "orr r6, r6, r8, lsl #8\n\torr r6, r6, lr, lsl #16\n\t"     \
    "str r6, [r12, r0, lsl #1]\n\t"                             \
    "ldm sp, {r6, r7, r8, r9, r10}\n"

/* Red and blue lie in the halves of r7, green in r6, of which products are rounded: texel_fetch, shaded_pixel and rgb565_nearest, whose
 * 1014 may be 1024. */
#define FEW_PIXEL_NARROW_LIT                                    \
    FEW_TEXEL_LIT("ldrh r6, [r8, r6, lsl #1]\n\t")              \
    "lsr r7, r6, #11\n\tbfi r7, r6, #16, #5\n\t"                \
    "mla r7, r7, r9, r10\n\tuxtb16 r7, r7, ror #8\n\t"          \
    "and r6, r6, #0x7e0\n\tsmmulr r6, r6, r12\n\t"              \
    "ubfx r8, r11, #23, #8\n\tldm lr, {r9, r10, r12, lr}\n\t"   \
    "mla r7, r7, r8, r9\n\tuxtab16 r7, r7, r7, ror #8\n\t"      \
    "uxtb16 r7, r7, ror #8\n\t"                                 \
    "mul r6, r6, r8\n\tsmmulr r6, r6, r10\n\t"                  \
    "smmulr r6, r6, r12\n\t"                                    \
    "mov r8, #249\n\tmul r7, r7, r8\n\t"                        \
    "add r7, r7, #0x4000400\n\t"                                \
    "bfi r7, r6, #5, #6\n\t"                                    \
    "lsr r6, r7, #27\n\tbfi r7, r6, #0, #5\n\t"                 \
    "strh r7, [lr, r0]\n\t"                                     \
    "ldm sp, {r6, r7, r8, r9, r10}\n"

/* What is done for light alone, or without it. */
#define FEW_LEFT_OUT(...)
#define FEW_DONE(...) __VA_ARGS__

/* Tells as the sign whether a pixel is outside: few_outside. */
#define FEW_OUTSIDE_ARMV7EM(REGISTER)                            \
    "orr " REGISTER ", r2, r1, lsl #11\n\t"                      \
    "orrs " REGISTER ", " REGISTER ", r2, lsl #22\n\t"
#define FEW_RIGHT_ARMV7EM                                        \
    "adds r1, r1, r6\n\tadc r2, r2, r7\n\t"                      \
    FEW_OUTSIDE_ARMV7EM("lr")

/* At r0, struct few_box; at r1, struct few_texels. In rows: edge functions in r1 and r2, their steps in r6 and r7; depth, u and v in r3
 * to r5, theirs in r8 to r10; the address of a depth in r0; in r11 that of the texture's middle or, of pixels in light, light. From
 * sp on lie the box's address, width, height, to_pixels, columns; of pixels in light r6 to r10, the addresses of box and texels, columns,
 * the step of light. Two pixels behind a row are outside. */
#define FEW_ROWS_ARMV7EM(PIXEL, LIT, UNLIT, BOX, COLUMNS)                        \
    __asm__ volatile(                                                            \
        ".syntax unified\n\t"                                                    \
        "ldr r4, [r0, #120]\n\t"                                                 \
        UNLIT("ldr r3, [r1, #12]\n\tldm r1, {r1, r2, r11}\n\t"                   \
              "push {r0, r1, r2, r3, r4}\n")                                     \
        LIT("ldr r5, [r0, #100]\n\tpush {r0, r1, r4, r5}\n\t"                    \
            "add r12, r0, #80\n\tldm r12, {r6, r7, r8, r9, r10}\n\t"             \
            "push {r6, r7, r8, r9, r10}\n")                                      \
        "1: ldm r0, {r1, r2, r3, r4, r5" LIT(", r11") "}\n\t"                    \
        "add r12, r0, #40\n\t"                                                   \
        "ldm r12, {r6, r7, r8, r9, r10" LIT(", lr") "}\n\t"                      \
        "adds r6, r6, r1\n\tadc r7, r7, r2\n\t"                                  \
        "add r8, r8, r3\n\tadd r9, r9, r4\n\t"                                   \
        "add r10, r10, r5\n\t"                                                   \
        LIT("add lr, lr, r11\n\t")                                               \
        "stm r0, {r6, r7, r8, r9, r10" LIT(", lr") "}\n\t"                       \
        UNLIT("add r12, r0, #80\n\tldm r12, {r6, r7, r8, r9, r10}\n\t")          \
        LIT("ldm sp, {r6, r7, r8, r9, r10}\n\t")                                 \
        "ldrd r12, r0, [r0, #120]\n\t"                                           \
        FEW_OUTSIDE_ARMV7EM("lr")                                                \
        "bpl 4f\n"                                                               \
        "2: " FEW_RIGHT_ARMV7EM "bpl 31f\n\t"                                    \
        FEW_RIGHT_ARMV7EM "bpl 32f\n\t"                                          \
        "subs r12, r12, #2\n\tbgt 2b\n\t"                                        \
        "b 6f\n"                                                                 \
        "32: subs r12, r12, #1\n"                                                \
        "31: ldr lr, [sp, #" COLUMNS "]\n\t"                                     \
        "sub lr, lr, r12\n\tadd lr, lr, #1\n\t"                                  \
        "mla r3, r8, lr, r3\n\tmla r4, r9, lr, r4\n\t"                           \
        "mla r5, r10, lr, r5\n\t"                                                \
        LIT("ldr r12, [sp, #32]\n\t"                                             \
            "mla r11, r12, lr, r11\n\t")                                         \
        "add r0, r0, lr, lsl #1\n"                                               \
        "4: ldrh r12, [r0], #2\n\t"                                              \
        "cmp r12, r3, lsr #16\n\tbhs 5f\n\t"                                     \
        "lsr r12, r3, #16\n\tstrh r12, [r0, #-2]\n\t"                            \
        PIXEL                                                                    \
        "5: add r3, r3, r8\n\tadd r4, r4, r9\n\t"                                \
        "add r5, r5, r10\n\t"                                                    \
        LIT("ldr r12, [sp, #32]\n\t"                                             \
            "add r11, r11, r12\n\t")                                             \
        FEW_RIGHT_ARMV7EM                                                        \
        "bpl 4b\n"                                                               \
        "6: ldr r0, [sp, #" BOX "]\n\t"                                          \
        "ldrd r1, r2, [r0, #124]\n\t"                                            \
        "ldr r3, [r0, #132]\n\t"                                                 \
        "add r1, r1, r2\n\tstr r1, [r0, #124]\n\t"                               \
        "cmp r1, r3\n\tbne 1b\n\t"                                               \
        UNLIT("add sp, #20") LIT("add sp, #36")                                  \
            FEW_REGISTERS)

/* Draws one row or more: 21 instructions for a pixel that is seen, of light 39, encoded 40; compilers take 30, 70 and 97. */
SMEAR_CALLED void few_rows_loop(struct few_box *rows, const struct few_texels *texels, enum few_kind kind)
{
    register struct few_box *r0 __asm__("r0") = rows;
    register const struct few_texels *r1 __asm__("r1") = texels;
    if (kind == FEW_NARROW)
        FEW_ROWS_ARMV7EM(FEW_PIXEL_NARROW, FEW_LEFT_OUT, FEW_DONE, "0", "16");
    else if (kind == FEW_WIDE)
        FEW_ROWS_ARMV7EM(FEW_PIXEL_WIDE, FEW_LEFT_OUT, FEW_DONE, "0", "16");
    else if (kind == FEW_NARROW_LIT)
        FEW_ROWS_ARMV7EM(FEW_PIXEL_NARROW_LIT, FEW_DONE, FEW_LEFT_OUT, "20", "28");
    else
        FEW_ROWS_ARMV7EM(FEW_PIXEL_LINEAR, FEW_DONE, FEW_LEFT_OUT, "20", "28");
}
#endif

#if SMEAR_ASM_ARMV6M && FEW_ROWS_LOOP
/* Branches by whether the pixel of r1 and r2 is outside: few_outside. Takes r4 and r7. */
#define FEW_OUTSIDE_ARMV6M(BRANCH)                       \
    "lsls r4, r2, #22\n\tlsls r7, r1, #11\n\t"           \
    "orrs r4, r7\n\torrs r4, r2\n\t" BRANCH "\n"
#define FEW_RIGHT_ARMV6M(BRANCH) "adds r1, r1, r5\n\tadcs r2, r6\n\t" FEW_OUTSIDE_ARMV6M(BRANCH)
#define FEW_MORE_ARMV6M(TO, STEP) "mov r6, " STEP "\n\tmuls r6, r4\n\tadds " TO ", " TO ", r6\n\t"

/* At r0, struct few_box; at r1, struct few_texels. The box's address and to_pixels lie on the stack, of a row depth, u and v, too. Edge
 * functions lie in r1 and r2, their steps in r5 and r6, columns that are left in r3. Then, in a row: depth, u and v in r1 to r3, their
 * steps in r8 to r10, addresses of a depth in r0, of a pixel in r4, behind the row's last depth in lr; shifts in r11, texels in r12. */
#define FEW_ROWS_ARMV6M(PLACE, SIZE, LOAD, STORE)                                                                  \
    __asm__ volatile(                                                                                              \
        ".syntax unified\n\t"                                                                                      \
        "adds r1, #12\n\tldm r1!, {r2, r3, r4}\n\tmov r11, r2\n\tmov r12, r3\n\tpush {r0, r4}\n\t"                 \
        "adds r0, #88\n\tldm r0!, {r1, r2, r3}\n\tmov r8, r1\n\tmov r9, r2\n\tmov r10, r3\n"                       \
        "1: ldr r0, [sp]\n\tldm r0!, {r1, r2, r3, r4, r5}\n\tpush {r3, r4, r5}\n\t"                                \
        "ldr r6, [r0, #28]\n\tadds r3, r3, r6\n\tldr r6, [r0, #32]\n\tadds r4, r4, r6\n\t"                         \
        "ldr r6, [r0, #36]\n\tadds r5, r5, r6\n\tldr r6, [r0, #20]\n\tldr r7, [r0, #24]\n\t"                       \
        "adds r6, r6, r1\n\tadcs r7, r2\n\t"                                                                       \
        "subs r0, #12\n\tstm r0!, {r3, r4, r5}\n\tsubs r0, #20\n\tstm r0!, {r6, r7}\n\t"                           \
        "ldr r5, [r0, #72]\n\tldr r6, [r0, #76]\n\tldr r3, [r0, #112]\n\t"                                         \
        FEW_OUTSIDE_ARMV6M("bpl 3f")                                                                               \
        "2: subs r3, #1\n\tbeq 7f\n\t" FEW_RIGHT_ARMV6M("bmi 2b")                                                  \
        "3: mov lr, r3\n"                                                                                          \
        "31: subs r3, #1\n\t" FEW_RIGHT_ARMV6M("bpl 31b")                                                          \
        "mov r4, lr\n\tsubs r5, r4, r3\n\tldr r6, [r0, #112]\n\tsubs r4, r6, r4\n\t"                               \
        "ldr r0, [r0, #116]\n\tadds r0, r0, r4\n\tadds r0, r0, r4\n\t"                                             \
        "adds r5, r5, r5\n\tadds r5, r5, r0\n\tmov lr, r5\n\tpop {r1, r2, r3}\n\t"                                 \
        FEW_MORE_ARMV6M("r1", "r8") FEW_MORE_ARMV6M("r2", "r9") FEW_MORE_ARMV6M("r3", "r10")                       \
        "ldr r4, [sp, #4]\n\t" PLACE                                                                               \
        "4: ldrh r5, [r0]\n\tlsrs r6, r1, #16\n\tcmp r5, r6\n\tbhs 5f\n\tstrh r6, [r0]\n\t"                        \
        "mov r7, r11\n\tmovs r6, r3\n\tlsrs r6, r7\n\tlsrs r7, r7, #8\n\tlsls r6, r7\n\t"                          \
        "lsrs r7, r7, #8\n\tmovs r5, r2\n\tlsrs r5, r7\n\torrs r6, r5\n\t"                                         \
        "lsls r6, r6, #" SIZE "\n\tadd r6, r12\n\t" LOAD STORE                                                     \
        "5: adds r0, #2\n\tadds r4, #1 << " SIZE "\n\tadd r1, r8\n\tadd r2, r9\n\tadd r3, r10\n\t"                 \
        "cmp r0, lr\n\tbne 4b\n"                                                                                   \
        "6: ldr r0, [sp]\n\tadds r0, #124\n\tldm r0!, {r1, r2, r3}\n\t"                                            \
        "adds r1, r1, r2\n\tsubs r0, #12\n\tstr r1, [r0]\n\tcmp r1, r3\n\tbeq 8f\n\tb 1b\n"                        \
        "7: add sp, #12\n\tb 6b\n"                                                                                 \
        "8: add sp, #8"                                                                                            \
        FEW_REGISTERS)

/* Draws one row or more: 35 instructions for a pixel that is seen; compilers take 46. */
SMEAR_CALLED void few_rows_loop(struct few_box *rows, const struct few_texels *texels, enum few_kind kind)
{
    register struct few_box *r0 __asm__("r0") = rows;
    register const struct few_texels *r1 __asm__("r1") = texels;
    if (kind == FEW_NARROW)
        FEW_ROWS_ARMV6M("adds r4, r4, r0\n", "1", "ldrh r6, [r6]\n\t", "strh r6, [r4]\n");
    else
        FEW_ROWS_ARMV6M("adds r4, r4, r0\n\tadds r4, r4, r0\n", "2", "ldr r6, [r6]\n\tlsls r6, r6, #8\n\tlsrs r6, r6, #8\n\t",
                        "str r6, [r4]\n");
}
#endif

#if !FEW_ROWS_LOOP
void few_rows_loop(struct few_box *rows, const struct few_texels *texels, enum few_kind kind);      /* nowhere, and not called */
#endif

#endif
