/* SPDX-License-Identifier: MIT */
/* packed_sums.c - sums of pixels over instants, and the means of them. */
#include "kernels/packed_sums.h"

#include "base/fixmath.h"
#include "kernels/vector.h"

/* ------------------------------------------------------------------ sums */

/* Reads and writes the sums of those pixels only that add to them: the barrier keeps compilers from reading ahead. */
SMEAR_INLINE void packed_add_pixels(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        const uint32_t c = color[i];
        if (c == PACKED_NOTHING && background == NULL)
            continue;
        SMEAR_KEEP_BRANCH();
        struct packed_sum s = packed_sum_at(&sums, i);
        color[i] = background != NULL ? background[i] : PACKED_NOTHING;
        s.rb += c & 0xff00ffu;
        s.gn += (c >> 8 & 0xffu) + 0x10000u;
        packed_sum_put(&sums, i, s);
    }
}

void smear_packed_add_reference(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n)
{
    if (background == NULL)
        packed_add_pixels(color, NULL, sums, n);
    else
        packed_add_pixels(color, background, sums, n);
}

#if SMEAR_VECTORS
/* Takes four pixels without a branch. */
SMEAR_INLINE void add4(uint32_t *color, const uint32_t *background, uint32_t *rb, uint32_t *gn)
{
    const smear_v4u nothing = v4u_all(PACKED_NOTHING);
    smear_v4u c = v4u_load(color);
    const smear_v4u none = background == NULL ? (smear_v4u)(c == nothing) : v4u_all(0);
    v4u_store(color, background != NULL ? v4u_load(background) : nothing);
    c = ((c & 0xffffffu) | 0x1000000u) & ~none;
    v4u_store(rb, v4u_load(rb) + (c & 0xff00ffu));
    v4u_store(gn, v4u_load(gn) + v4u_right16(c, 8));
}

/* The last round may take some pixels again: there is nothing by then. */
void smear_packed_add(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n)
{
    int32_t i = 0;
    if (background != NULL) {
        for (; i + 4 <= n; i += 4)
            add4(color + i, background + i, sums.rb + i, sums.gn + i);
    } else {
        for (; i + 8 <= n; i += 8) {        /* what most have */
            add4(color + i, NULL, sums.rb + i, sums.gn + i);
            add4(color + i + 4, NULL, sums.rb + i + 4, sums.gn + i + 4);
        }
        for (; i + 4 <= n; i += 4)
            add4(color + i, NULL, sums.rb + i, sums.gn + i);
        if (i < n && n >= 4) {
            add4(color + n - 4, NULL, sums.rb + n - 4, sums.gn + n - 4);
            return;
        }
    }
    smear_packed_add_reference(color + i, background != NULL ? background + i : NULL, packed_sums_from(sums, i), n - i);
}

#elif PACKED_ASM_ARMV6M
/* clang-format off */
/* A pixel; where nothing moves, the way to `next`. */
#define PACKED_ADD(next)                \
    "ldr r4, [%[color]]\n\t"            \
    "stm %[color]!, {%[nothing]}\n\t"   \
    "cmp r4, %[nothing]\n\t"            \
    "beq " #next "f\n\t"                \
    "mov r5, r8\n\t"                    \
    "ands r5, r4\n\t"                   \
    "lsrs r4, r4, #8\n\t"               \
    "uxtb r4, r4\n\t"                   \
    "ldr r6, [%[sum]]\n\t"              \
    "ldr r7, [%[sum], #4]\n\t"          \
    "adds r6, r6, r5\n\t"               \
    "adds r7, r7, r4\n\t"               \
    "add r7, r9\n\t"                    \
    "stm %[sum]!, {r6, r7}\n"

/* 14 instructions a pixel, 6 where nothing moves, and 2 for each two; compilers, which keep half of what the loop needs on the
 * stack, take 24. */
static void add_armv6m(uint32_t *color, struct packed_sum *sum, int32_t n)
{
    const uint32_t *end = color + n;
    __asm__ volatile(
        ".syntax unified\n\t"
        "movs r4, #255\n\t"
        "lsls r5, r4, #16\n\t"
        "orrs r4, r5\n\t"
        "mov r8, r4\n\t"                /* 0xff00ff */
        "movs r4, #1\n\t"
        "lsls r4, r4, #16\n\t"
        "mov r9, r4\n\t"                /* an instant */
        "lsrs r4, %[n], #1\n\t"         /* the carry is set where they are odd */
        "bcs 2f\n"
        "1:\n\t"
        PACKED_ADD(3)
        "2:\n\t"
        PACKED_ADD(4)
        "cmp %[color], %[end]\n\t"
        "bne 1b\n\t"
        "b 5f\n"
        "3:\n\t"
        "adds %[sum], #8\n\t"
        "b 2b\n"
        "4:\n\t"
        "adds %[sum], #8\n\t"
        "cmp %[color], %[end]\n\t"
        "bne 1b\n"
        "5:"
        : [color] "+&l"(color), [sum] "+&l"(sum)
        : [end] "h"(end), [n] "l"(n), [nothing] "l"(PACKED_NOTHING)
        : "r4", "r5", "r6", "r7", "r8", "r9", "cc", "memory");
}
/* clang-format on */

void smear_packed_add(uint32_t *color, const uint32_t *background, struct packed_sums sums, int32_t n)
{
    if (background != NULL)
        smear_packed_add_reference(color, background, sums, n);
    else
        add_armv6m(color, sums.pair, n);
}
#endif

/* ------------------------------------------------------------------ means */

struct packed_mean smear_packed_mean(uint32_t n)
{
    int shift = 31 - count_leading_zeros(n - 1);
    uint32_t factor = ((1u << (16 + shift)) + n - 1) / n;
    return (struct packed_mean){ n, (n >> 1) * 0x10001u, factor, shift, factor << (8 - shift) };
}

void smear_packed_means_reference(uint32_t *color, const struct packed_sum *sum, int32_t n, const struct packed_mean *m)
{
    const struct packed_mean mean = *m;
    for (const struct packed_sum *end = sum + n; sum != end; sum++, color++)
        if (sum->gn >> 16 != 0)
            *color = packed_mean_of(&mean, *sum, *color);
}

#if PACKED_ASM_ARMV6M
/* 29 instructions a pixel; 20 of one that has all instants, which the background adds nothing to. */
void smear_packed_means(uint32_t *color, const struct packed_sum *sum, int32_t n, const struct packed_mean *m)
{
    const struct packed_sum *end = sum + n;
    __asm__ volatile(
        ".syntax unified\n\t"
        "movs r4, #255\n\t"
        "lsls r5, r4, #16\n\t"
        "orrs r4, r5\n\t"
        "mov r8, r4\n"                  /* 0xff00ff */
        "1:\n\t"
        "ldm %[sum]!, {r4, r5}\n\t"
        "lsrs r6, r5, #16\n\t"
        "beq 2f\n\t"
        "cmp r6, %[n]\n\t"
        "beq 3f\n\t"
        "ldr r3, [%[color]]\n\t"
        "rsbs r6, r6, #0\n\t"           /* rest = n - instants */
        "add r6, %[n]\n\t"
        "mov r7, r8\n\t"
        "ands r7, r3\n\t"
        "muls r7, r6\n\t"
        "adds r4, r4, r7\n\t"            /* rb + (c & 0xff00ff) rest */
        "lsrs r3, r3, #8\n\t"
        "uxtb r3, r3\n\t"
        "muls r3, r6\n\t"
        "adds r5, r5, r3\n"             /* g + (c >> 8 & 0xff) rest */
        "3:\n\t"
        "add r4, %[halves]\n\t"
        "add r5, %[halves]\n\t"
        "uxth r5, r5\n\t"
        "mov r6, %[factor]\n\t"
        "muls r5, r6\n\t"
        "lsrs r5, r5, #24\n\t"
        "lsls r5, r5, #8\n\t"
        "uxth r7, r4\n\t"
        "muls r7, r6\n\t"
        "lsrs r7, r7, #24\n\t"
        "orrs r5, r7\n\t"
        "lsrs r4, r4, #16\n\t"
        "muls r4, r6\n\t"
        "lsrs r4, r4, #24\n\t"
        "lsls r4, r4, #16\n\t"
        "orrs r5, r4\n\t"
        "stm %[color]!, {r5}\n\t"
        "cmp %[sum], %[end]\n\t"
        "bne 1b\n\t"
        "b 4f\n"
        "2:\n\t"
        "adds %[color], #4\n\t"
        "cmp %[sum], %[end]\n\t"
        "bne 1b\n"
        "4:"
        : [color] "+l"(color), [sum] "+l"(sum)
        : [end] "r"(end), [n] "r"(m->n), [halves] "r"(m->halves), [factor] "r"(m->factor24)
        : "r3", "r4", "r5", "r6", "r7", "r8", "cc", "memory");
}
#endif
