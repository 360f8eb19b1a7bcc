/* SPDX-License-Identifier: MIT */
/* differences.c - see differences.h. */
#include "kernels/differences.h"


#if DIFFERENCES_ASM_ARMV6M
/* clang-format off */
/* Adds the squared difference of r2 and r3 to the sum. */
#define DIFFERENCE_ADD          \
    "uxtb r4, r2\n\t"           \
    "uxtb r5, r3\n\t"           \
    "subs r4, r4, r5\n\t"       \
    "muls r4, r4\n\t"           \
    "add %[sum], r4\n\t"        \
    "lsrs r2, r2, #8\n\t"       \
    "lsrs r3, r3, #8\n\t"       \
    "uxtb r4, r2\n\t"           \
    "uxtb r5, r3\n\t"           \
    "subs r4, r4, r5\n\t"       \
    "muls r4, r4\n\t"           \
    "add %[sum], r4\n\t"        \
    "lsrs r2, r2, #8\n\t"       \
    "lsrs r3, r3, #8\n\t"       \
    "uxtb r2, r2\n\t"           \
    "uxtb r3, r3\n\t"           \
    "subs r2, r2, r3\n\t"       \
    "muls r2, r2\n\t"           \
    "add %[sum], r2\n\t"

/* The depth there, to r5. */
#define DEPTH_THERE                     \
    "mov r5, %[there]\n\t"              \
    "asrs r5, r5, #1\n\t"               \
    "ldrh r5, [%[depth], r5]\n\t"

/* Goes to 3 where it, or the pixel there, is not as what is static; r4 is used up. */
#define MOVES_THERE(way)                        \
    "mov r4, %[deep_there]\n\t"                 \
    "ldrh r4, [%[depth], r4]\n\t"               \
    "cmp r4, r5\n\t"                            \
    "bne " way "\n\t"                           \
    "ldr r4, [%[walk], #4]\n\t"                 \
    "ldr r4, [%[color], r4]\n\t"                \
    "cmp r4, r3\n\t"                            \
    "bne " way "\n\t"

/* Bytes from a pixel's colour to what is behind it and to that there; from row to row, how much farther apart colours and what is
 * behind lie, and from the end of one to the next, of colours and depths; rows; bytes of a row's colours. */
struct difference_walk {
    uint32_t behind, behind_there, apart, color, depth, rows, row;
};

SMEAR_STATIC_ASSERT(offsetof(struct difference_walk, apart) == 8 && offsetof(struct difference_walk, rows) == 20,
                    "the assembly knows struct difference_walk");

/* Pixels of r2 and r3, of which the first moves at 2 and may do so at 4; the squared difference is added at 3. */
#define DIFFERENCE_TAKE \
    "2:\n\t" \
    "cmp r2, r3\n\t" \
    "beq 0b\n\t" \
    DEPTH_THERE \
    "cmp r5, r4\n\t" \
    "bls 3f\n\t" \
    MOVES_THERE("3f") \
    "b 0b\n" \
    "3:\n\t" \
    DIFFERENCE_ADD \
    "b 0b\n" \
    "4:\n\t" \
    "ldr r5, [%[walk]]\n\t" \
    "ldr r5, [%[color], r5]\n\t" \
    "cmp r5, r2\n\t" \
    "bne 2b\n\t" \
    "adds %[still], #1\n\t" \
    "cmp r2, r3\n\t" \
    "beq 0b\n\t" \
    DEPTH_THERE \
    "cmp r4, r5\n\t" \
    "bhi 0b\n\t" \
    MOVES_THERE("3b") \
    "b 0b\n"

/* The next row, if there is one. */
#define DIFFERENCE_NEXT_ROW \
    "8:\n\t" \
    "ldr r5, [%[walk], #20]\n\t" \
    "subs r5, #1\n\t" \
    "beq 9f\n\t" \
    "str r5, [%[walk], #20]\n\t" \
    "ldm %[walk]!, {r2, r3, r4}\n\t" \
    "adds r2, r2, r4\n\t" \
    "adds r3, r3, r4\n\t" \
    "asrs r4, r4, #1\n\t" \
    "add %[deep], r4\n\t" \
    "add %[deep_there], r4\n\t" \
    "ldm %[walk]!, {r4, r5}\n\t" \
    "adds %[color], %[color], r4\n\t" \
    "adds %[depth], %[depth], r5\n\t" \
    "subs %[walk], #20\n\t" \
    "str r2, [%[walk]]\n\t" \
    "str r3, [%[walk], #4]\n\t" \
    "ldr r2, [%[walk], #24]\n\t" \
    "adds r2, r2, %[color]\n\t" \
    "mov %[end], r2\n\t" \
    "b 1b\n"

uint32_t smear_difference_block_armv6m(const struct difference_block *b, uint32_t *moving)
{
    const struct difference_rows *const r = &b->first;
    const uint32_t *color = r->color;
    const uint16_t *depth = r->depth;
    struct difference_walk walk = { (uint32_t)r->behind - (uint32_t)color, (uint32_t)(r->behind + r->there_behind) - (uint32_t)color,
                                    (uint32_t)(4 * (b->pitch_behind - b->pitch)), (uint32_t)(4 * (b->pitch - b->n)),
                                    (uint32_t)(2 * (b->pitch - b->n)), (uint32_t)b->rows, (uint32_t)(4 * b->n) };
    uint32_t sum = 0, still = 0, deep = (uint32_t)r->deep - (uint32_t)depth, deep_there = deep + (uint32_t)(2 * r->there_behind);
    const uint32_t *end = color + b->n;
    __asm__ volatile(
        ".syntax unified\n\t"
        "b 1f\n"
        "0:\n\t"                       /* the next pixel */
        "adds %[depth], #2\n\t"
        "adds %[color], #4\n\t"
        "cmp %[color], %[end]\n\t"
        "beq 8f\n"
        "1:\n\t"
        "ldr r2, [%[color]]\n\t"
        "mov r3, %[there]\n\t"
        "ldr r3, [%[color], r3]\n\t"
        "ldrh r4, [%[depth]]\n\t"
        "mov r5, %[deep]\n\t"
        "ldrh r5, [%[depth], r5]\n\t"
        "cmp r4, r5\n\t"
        "beq 4f\n"
        DIFFERENCE_TAKE
        DIFFERENCE_NEXT_ROW
        "9:"
        : [color] "+&l"(color), [depth] "+&l"(depth), [still] "+&l"(still), [sum] "+&h"(sum), [end] "+&h"(end), [deep] "+&h"(deep),
          [deep_there] "+&h"(deep_there)
        : [walk] "l"(&walk), [there] "h"(4 * r->there)
        : "r2", "r3", "r4", "r5", "cc", "memory");
    *moving += (uint32_t)(b->n * b->rows) - still;
    return sum;
}
/* clang-format on */
#endif
