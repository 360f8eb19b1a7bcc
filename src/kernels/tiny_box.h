/* SPDX-License-Identifier: MIT */
/* tiny_box.h - the pixels of a tiny triangle: its edge functions say which are covered, and are the weights of the corners, which
 * become depth codes and colours. */
#ifndef SMEAR_KERNELS_TINY_BOX_H
#define SMEAR_KERNELS_TINY_BOX_H

#include "base/pixel.h"
#include "kernels/kernels.h"
#include "kernels/tiny_weights.h"

/* One loop of C does for all kinds where size counts: in a page and in the GBA's fast memory, too. */
#ifdef __wasm__
#define TINY_ONE_LOOP 1
#else
#define TINY_ONE_LOOP (SMEAR_SMALL_CODE || SMEAR_ASM_ARM)
#endif

/* Makes what turns units into codes: (units + bias) >> shift where all of a triangle's are on one side of the codes' break, no shift
 * where they are on both, or size counts. Weights are rounded down: what they weigh is up to 2 less than its least corner. */
static inline void tiny_codes(struct tiny_box *b, int32_t q0, int32_t low, int32_t high)
{
    const bool far = !SMEAR_SMALL_CODE && high < 32768 << 11, near = !SMEAR_SMALL_CODE && low - 2 >= 32768 << 11;
    b->units = (uint32_t)q0 + (far ? 0x400u : near ? ((32768u - 2048u) << 15) + 0x4000u : 0);
    b->code_shift = far ? 11 : near ? 15 : 0;
}

static inline void tiny_units(struct tiny_box *b, int32_t to1, int32_t to2)
{
#if SMEAR_ASM_ARMV7EM
    b->twice1 = shl_wrap(to1, 1);
    b->twice2 = shl_wrap(to2, 1);
#else
    b->to1_high = to1 >> 16;
    b->to1_low = to1 & 0xffff;
    b->to2_high = to2 >> 16;
    b->to2_low = to2 & 0xffff;
#endif
}

/* Returns units at weights w1 and w2. */
static inline uint32_t tiny_units_at(const struct tiny_box *b, uint32_t w1, uint32_t w2)
{
#if SMEAR_ASM_ARMV7EM
    return b->units + (uint32_t)tiny_times(b->twice1 >> 1, w1) + (uint32_t)tiny_times(b->twice2 >> 1, w2);
#else
    const uint32_t low = ((uint32_t)b->to1_low * w1 >> 16) + ((uint32_t)b->to2_low * w2 >> 16);
    const uint32_t high = (uint32_t)(b->to1_high * (int32_t)w1) + (uint32_t)(b->to2_high * (int32_t)w2);
    return b->units + low + high;
#endif
}

/* Pixel (e1, e2), where it is nearer. `across`: of codes on both sides of their break. */
SMEAR_INLINE void tiny_box_pixel(const struct tiny_box *b, uint16_t *depth, void *pixel, int32_t e1, int32_t e2, bool shaded,
                                 bool linear, bool narrow, bool across)
{
    const struct tiny_scale scale = { b->recip, b->up };
    const uint32_t w1 = tiny_weight(scale, e1), w2 = tiny_weight(scale, e2);
    const uint32_t units = tiny_units_at(b, w1, w2), code = across ? tiny_code((int32_t)units) : units >> b->code_shift;
    if (code > *depth) {
        uint32_t color = b->color;
        *depth = (uint16_t)code;
        if (shaded) {
            color = tiny_color(b->channel, w1, w2, linear);
            color = narrow ? rgb565_nearest(color) : color;
        }
        if (narrow)
            *(uint16_t *)pixel = (uint16_t)color;
        else
            *(uint32_t *)pixel = color;
    }
}

/* Draws covered pixels that are nearer than what is there. b->e1 and b->e2 are used up. */
static inline void tiny_box_reference(struct tiny_box *b)
{
    for (int32_t y = 0; y < b->rows; y++)
        for (int32_t x = 0; x < b->columns; x++) {
            const int32_t e1 = b->e1 + b->right1 * x + b->down1 * y, e2 = b->e2 + b->right2 * x + b->down2 * y;
            const int32_t at = y * b->stride + x;
            if (((b->sum - e1 - e2) | e1 | e2) >= 0)
                tiny_box_pixel(b, b->depth + at, pixel_after(b->pixels, at, b->narrow), e1, e2, b->shaded,
                               transfer_is_linear(b->transfer), b->narrow, b->code_shift == 0);
        }
}

/* A loop for each kind. What pixels need stays in the box: compilers that keep it at hand before each row take longer for that than
 * rows of one or two pixels do. */
SMEAR_INLINE void tiny_box_rows(struct tiny_box *b, bool shaded, bool linear, bool narrow, bool across)
{
    const int32_t right1 = b->right1, right2 = b->right2;
    uint16_t *row = b->depth;
    void *pixels = b->pixels;
    for (int32_t rows = b->rows; rows > 0; rows--) {
        int32_t e1 = b->e1, e2 = b->e2, e0 = b->sum - e1 - e2;
        uint16_t *depth = row, *const end = row + b->columns;
        void *pixel = pixels;
        do {
            if ((e0 | e1 | e2) >= 0) {
                const struct tiny_box *box = b;
                SMEAR_KEEP_VALUE(box);
                tiny_box_pixel(box, depth, pixel, e1, e2, shaded, linear, narrow, across);
            }
            e0 -= right1 + right2;
            e1 += right1;
            e2 += right2;
            pixel = pixel_after(pixel, 1, narrow);
        } while (++depth != end);
        b->e1 += b->down1;
        b->e2 += b->down2;
        row += b->stride;
        pixels = pixel_after(pixels, b->stride, narrow);
    }
}

static inline void tiny_box_unrolled(struct tiny_box *b)
{
    if (!b->shaded && b->narrow)
        tiny_box_rows(b, false, false, true, false);
    else if (!b->shaded)
        tiny_box_rows(b, false, false, false, false);
    else if (!transfer_is_linear(b->transfer) && b->narrow)
        tiny_box_rows(b, true, false, true, false);
    else if (!transfer_is_linear(b->transfer))
        tiny_box_rows(b, true, false, false, false);
    else
        tiny_box_rows(b, true, true, b->narrow, false);
}

#if SMEAR_ASM_ARMV7EM
SMEAR_STATIC_ASSERT(offsetof(struct tiny_box, stride) == 20 && offsetof(struct tiny_box, rows) == 28
                        && offsetof(struct tiny_box, up) == 32 && offsetof(struct tiny_box, units) == 40
                        && offsetof(struct tiny_box, twice1) == 48 && offsetof(struct tiny_box, to_pixel) == 56
                        && offsetof(struct tiny_box, channel) == 64 && offsetof(struct tiny_box, right1) == 100
                        && offsetof(struct tiny_box, round) == 112 && sizeof(struct tiny_channel) == 12,
                    "the assembly knows struct tiny_box");

/* Parts of corners, q15 in r10 and r11, become red in r4, blue in r5 and green in r7. */
#define TINY_BOX_SHADE             \
    "lsr r10, r10, #17\n\t"        \
    "lsr r11, r11, #17\n\t"        \
    "add r12, r3, #64\n\t"         \
    "ldm r12!, {r4, r5, r7}\n\t"   \
    "mla r4, r4, r10, r7\n\t"      \
    "mla r4, r5, r11, r4\n\t"      \
    "ldm r12!, {r5, r7, r8}\n\t"   \
    "mla r5, r5, r10, r8\n\t"      \
    "mla r5, r7, r11, r5\n\t"      \
    "ldm r12, {r7, r8, r9}\n\t"    \
    "mla r7, r7, r10, r9\n\t"      \
    "mla r7, r8, r11, r7\n\t"      \
    "lsrs r4, r4, #22\n\t"         \
    "lsrs r5, r5, #22\n\t"         \
    "lsrs r7, r7, #22\n\t"         \
    "orr r5, r5, r4, lsl #16\n\t"

/* rgb565_nearest, into r7. */
#define TINY_BOX_SHADE_NARROW      \
    TINY_BOX_SHADE                 \
    "ldr r8, [r3, #112]\n\t"       \
    "movs r4, #249\n\t"            \
    "mla r4, r5, r4, r8\n\t"       \
    "rsb r5, r7, r7, lsl #8\n\t"   \
    "sub r7, r5, r7, lsl #1\n\t"   \
    "addw r7, r7, #505\n\t"        \
    "lsrs r7, r7, #10\n\t"         \
    "ubfx r5, r4, #11, #5\n\t"     \
    "lsrs r4, r4, #27\n\t"         \
    "orr r5, r5, r7, lsl #5\n\t"   \
    "orr r7, r5, r4, lsl #11\n\t"  \
    "ldrd r4, r5, [r3, #100]\n\t"  \
    "ldr r8, [r3, #56]\n\t"
#define TINY_BOX_SHADE_WIDE        \
    TINY_BOX_SHADE                 \
    "orr r7, r5, r7, lsl #8\n\t"   \
    "ldrd r4, r5, [r3, #100]\n\t"  \
    "ldr r8, [r3, #56]\n\t"
#define TINY_BOX_FLAT \
    "ldrd r8, r7, [r3, #56]\n\t"
#define TINY_BOX_STORE_NARROW \
    "strh r7, [r0, r8]\n"
#define TINY_BOX_STORE_WIDE \
    "add r8, r8, r0\n\t"    \
    "str r7, [r0, r8]\n"

/* `mi` where the pixel in r0 is not covered. */
#define TINY_BOX_TEST       \
    "orr r7, r1, r2\n\t"    \
    "orrs r7, r7, r6\n\t"

/* One pixel further right; `ne` unless the row is at its end. */
#define TINY_BOX_STEP       \
    "adds r1, r1, r4\n\t"   \
    "adds r2, r2, r5\n\t"   \
    "subs r6, r6, r4\n\t"   \
    "subs r6, r6, r5\n\t"   \
    "adds r0, #2\n\t"       \
    "cmp r0, lr\n\t"

/* Weights of corners, times 2^15, into r10 and r11, the code into r12. */
#define TINY_BOX_CODE              \
    "ldrd r7, r8, [r3, #32]\n\t"   \
    "lsl r10, r1, r7\n\t"          \
    "lsl r11, r2, r7\n\t"          \
    "lsr r10, r10, #16\n\t"        \
    "lsr r11, r11, #16\n\t"        \
    "mul r10, r10, r8\n\t"         \
    "mul r11, r11, r8\n\t"         \
    "bfc r10, #0, #15\n\t"         \
    "bfc r11, #0, #15\n\t"         \
    "ldrd r7, r8, [r3, #48]\n\t"   \
    "ldrd r12, r9, [r3, #40]\n\t"  \
    "smmla r12, r7, r10, r12\n\t"  \
    "smmla r12, r8, r11, r12\n\t"  \
    "lsr r12, r12, r9\n\t"

/* r0 points to depths, r3 to the box; e1 in r1, e2 in r2, their steps in r4 and r5, the third function in r6, the row's end in lr. Two
 * thirds of the instructions that compilers take. */
#define TINY_BOX_ARMV7EM(COLOR, STORE)  \
    __asm__ volatile(                   \
        ".syntax unified\n\t"           \
        "ldrd r4, r5, [r3, #100]\n"     \
        "1: ldr r0, [r3, #24]\n\t"      \
        "ldr r6, [r3, #16]\n\t"         \
        "add lr, r0, r6, lsl #1\n\t"    \
        "ldm r3, {r1, r2, r7, r8}\n\t"  \
        "add r7, r7, r1\n\t"            \
        "add r8, r8, r2\n\t"            \
        "strd r7, r8, [r3]\n\t"         \
        "ldr r6, [r3, #108]\n\t"        \
        "subs r6, r6, r1\n\t"           \
        "subs r6, r6, r2\n"             \
        "2: " TINY_BOX_TEST             \
        "bpl 3f\n\t" TINY_BOX_STEP      \
        "bne 2b\n\t"                    \
        "b 5f\n"                        \
        "3: " TINY_BOX_CODE             \
        "ldrh r7, [r0]\n\t"             \
        "cmp r7, r12\n\t"               \
        "bhs 4f\n\t"                    \
        "strh r12, [r0]\n\t" COLOR STORE \
        "4: " TINY_BOX_STEP             \
        "beq 5f\n\t" TINY_BOX_TEST      \
        "bpl 3b\n"                      \
        "5: ldrd r7, r8, [r3, #20]\n\t" \
        "add r8, r8, r7, lsl #1\n\t"    \
        "str r8, [r3, #24]\n\t"         \
        "ldr r7, [r3, #28]\n\t"         \
        "subs r7, #1\n\t"               \
        "str r7, [r3, #28]\n\t"         \
        "bne 1b"                        \
        : "+r"(r3)                      \
        :                               \
        : "r0", "r1", "r2", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

static SMEAR_NOINLINE void tiny_box_armv7em(struct tiny_box *b)
{
    register struct tiny_box *r3 __asm__("r3") = b;
    b->round = 0x03f603f6u;
    b->to_pixel = (uint32_t)(uintptr_t)b->pixels - (uint32_t)(uintptr_t)b->depth * (b->narrow ? 1u : 2u);
    if (b->shaded && b->narrow)
        TINY_BOX_ARMV7EM(TINY_BOX_SHADE_NARROW, TINY_BOX_STORE_NARROW);
    else if (b->shaded)
        TINY_BOX_ARMV7EM(TINY_BOX_SHADE_WIDE, TINY_BOX_STORE_WIDE);
    else if (b->narrow)
        TINY_BOX_ARMV7EM(TINY_BOX_FLAT, TINY_BOX_STORE_NARROW);
    else
        TINY_BOX_ARMV7EM(TINY_BOX_FLAT, TINY_BOX_STORE_WIDE);
}
#endif

static SMEAR_RARE void tiny_box_across(struct tiny_box *b) { tiny_box_reference(b); }

/* `narrow`: b->narrow, where that may be. */
static inline void tiny_box(struct tiny_box *b, bool narrow)
{
    if (TINY_ONE_LOOP) {
        tiny_box_rows(b, SMEAR_WITH_GOURAUD && b->shaded, transfer_is_linear(b->transfer), narrow, SMEAR_SMALL_CODE || b->code_shift == 0);
        return;
    }
    if (b->code_shift == 0) {
        tiny_box_across(b);
        return;
    }
#if SMEAR_ASM_ARMV7EM
    if (!b->shaded || !transfer_is_linear(b->transfer)) {
        tiny_box_armv7em(b);
        return;
    }
#endif
    tiny_box_unrolled(b);
}

#endif
