/* SPDX-License-Identifier: MIT */
/* line_means.c - see line_means.h.
 *
 * Of 8 taps at most, red and blue add up beside each other in a word, and so do all three channels: what these have more is
 * green, 256 times. */
#include "kernels/line_means.h"

#include "base/fixmath.h"
#include "base/pixel.h"
#include "base/tables.h"
#include "kernels/packed_sums.h"
#include "kernels/vector.h"

#if PACKED_ASM_ARMV6M

/* clang-format off */
/* A tap of two pixels. */
#define LINE_TAP_ARMV6M(at)                                                             \
    "ldr r0, [r2, #" #at "]\n\t" "add r0, r8\n\t" "ldm r0, {r0, r1}\n\t"                \
    "adds r4, r4, r0\n\t" "ands r0, r3\n\t" "adds r5, r5, r0\n\t"                       \
    "adds r6, r6, r1\n\t" "ands r1, r3\n\t" "adds r7, r7, r1\n\t"
/* Makes RED_BLUE the mean of its sums and of ALL, which is lost; of 2^LOG taps, HIGH is 8 + LOG. */
#define LINE_MEAN_ARMV6M(ALL, RED_BLUE, LOG, HIGH)                                      \
    "subs " ALL ", " ALL ", " RED_BLUE "\n\t" "add " ALL ", r9\n\t"                     \
    "lsrs " ALL ", " ALL ", #" #HIGH "\n\t" "uxtb " ALL ", " ALL "\n\t"                 \
    "lsls " ALL ", " ALL ", #8\n\t"                                                     \
    "add " RED_BLUE ", r10\n\t" "lsrs " RED_BLUE ", " RED_BLUE ", #" #LOG "\n\t"        \
    "ands " RED_BLUE ", r3\n\t" "orrs " RED_BLUE ", " ALL "\n\t"

/* Writes n means of 2^LOG taps, n even and not 0; offsets in bytes. 49 instructions a pixel of eight, where compilers take 65. */
#define LINE_MEANS_ARMV6M(NAME, LOG, HIGH, HALF, TAPS)                                                          \
    static inline void NAME(uint32_t *out, const uint32_t *in, const int32_t *offset, int32_t n)                \
    {                                                                                                           \
        register const uint32_t *r0 __asm__("r0") = in;                                                         \
        register const uint32_t *r1 __asm__("r1") = in + n;                                                     \
        register const int32_t *r2 __asm__("r2") = offset;                                                      \
        register uint32_t *r11 __asm__("r11") = out;                                                            \
        __asm__ volatile(                                                                                       \
            ".syntax unified\n\t"                                                                               \
            "mov r8, r0\n\t" "mov r12, r1\n\t"                                                                  \
            "movs r3, #255\n\t" "lsls r4, r3, #16\n\t" "orrs r3, r4\n\t"                                        \
            "movs r4, #" #HALF "\n\t" "lsls r5, r4, #8\n\t" "mov r9, r5\n\t"        /* of green, 256 times */   \
            "lsls r5, r4, #16\n\t" "orrs r5, r4\n\t" "mov r10, r5\n"                /* of red and blue */       \
            "1:\n\t"                                                                                            \
            "movs r4, #0\n\t" "movs r5, #0\n\t" "movs r6, #0\n\t" "movs r7, #0\n\t"                             \
            TAPS LINE_MEAN_ARMV6M("r4", "r5", LOG, HIGH) LINE_MEAN_ARMV6M("r6", "r7", LOG, HIGH)                \
            "mov r0, r11\n\t" "stm r0!, {r5, r7}\n\t" "mov r11, r0\n\t"                                         \
            "mov r0, r8\n\t" "adds r0, #8\n\t" "mov r8, r0\n\t"                                                 \
            "cmp r0, r12\n\t" "bne 1b"                                                                          \
            : "+r"(r0), "+r"(r1), "+r"(r11)                                                                     \
            : "r"(r2)                                                                                           \
            : "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r12", "cc", "memory");                          \
    }
#define LINE_FOUR_ARMV6M LINE_TAP_ARMV6M(0) LINE_TAP_ARMV6M(4) LINE_TAP_ARMV6M(8) LINE_TAP_ARMV6M(12)
LINE_MEANS_ARMV6M(line_means4_armv6m, 2, 10, 2, LINE_FOUR_ARMV6M)
LINE_MEANS_ARMV6M(line_means8_armv6m, 3, 11, 4,
                  LINE_FOUR_ARMV6M LINE_TAP_ARMV6M(16) LINE_TAP_ARMV6M(20) LINE_TAP_ARMV6M(24) LINE_TAP_ARMV6M(28))

/* A tap of one pixel. */
#define LINE_SINGLE_ARMV6M(at)              \
    "ldr r0, [r2, #" #at "]\n\t" "ldr r0, [r1, r0]\n\t" "adds r4, r4, r0\n\t" "ands r0, r3\n\t" "adds r5, r5, r0\n\t"
#define LINE_SINGLE_MEAN_ARMV6M             \
    "movs r4, #0\n\t" "movs r5, #0\n\t"                                                                      \
    LINE_SINGLE_ARMV6M(0) LINE_SINGLE_ARMV6M(4) LINE_SINGLE_ARMV6M(8) LINE_SINGLE_ARMV6M(12)                \
    LINE_SINGLE_ARMV6M(16) LINE_SINGLE_ARMV6M(20) LINE_SINGLE_ARMV6M(24) LINE_SINGLE_ARMV6M(28)             \
    LINE_MEAN_ARMV6M("r4", "r5", 3, 11)
/* Makes OUT what lies between A and B, of which r0 has A | B and DIFFERS A ^ B; the mask is in r1. */
#define LINE_BETWEEN_ARMV6M(OUT, DIFFERS) \
    "lsrs " DIFFERS ", " DIFFERS ", #1\n\t" "ands " DIFFERS ", r1\n\t" "subs " OUT ", r0, " DIFFERS "\n\t"

/* Writes n pixels, a multiple of four and not 0, of which every fourth is a mean. 21 instructions a pixel. */
static inline void line_means_sparse_armv6m(uint32_t *out, const uint32_t *in, const int32_t offset[8], int32_t n)
{
    register const uint32_t *r1 __asm__("r1") = in;
    register const int32_t *r2 __asm__("r2") = offset;
    register uint32_t *r7 __asm__("r7") = out;
    register uint32_t *r12 __asm__("r12") = out + n;
    __asm__ volatile(
        ".syntax unified\n\t"
        "movs r3, #127\n\t" "lsls r4, r3, #16\n\t" "orrs r3, r4\n\t"
        "lsls r4, r3, #8\n\t" "orrs r4, r3\n\t" "mov r8, r4\n\t"                            /* 0x7f7f7f7f */
        "lsls r3, r3, #1\n\t" "movs r4, #1\n\t" "lsls r5, r4, #16\n\t" "orrs r5, r4\n\t"
        "orrs r3, r5\n\t"                                                                   /* 0x00ff00ff */
        "lsls r5, r5, #2\n\t" "mov r10, r5\n\t" "lsls r4, r4, #10\n\t" "mov r9, r4\n\t"
        LINE_SINGLE_MEAN_ARMV6M
        "movs r6, r5\n\t" "adds r1, #16\n"
        "1:\n\t"
        LINE_SINGLE_MEAN_ARMV6M
        "mov r11, r1\n\t" "mov r1, r8\n\t"
        "movs r4, r6\n\t" "movs r0, r6\n\t" "eors r4, r5\n\t" "orrs r0, r5\n\t" LINE_BETWEEN_ARMV6M("r4", "r4")
        "str r6, [r7]\n\t" "str r4, [r7, #8]\n\t"
        "movs r0, r6\n\t" "eors r6, r4\n\t" "orrs r0, r4\n\t" LINE_BETWEEN_ARMV6M("r0", "r6")
        "str r0, [r7, #4]\n\t"
        "movs r0, r5\n\t" "movs r6, r5\n\t"         /* the next one's first */
        "orrs r0, r4\n\t" "eors r4, r5\n\t" LINE_BETWEEN_ARMV6M("r0", "r4")
        "str r0, [r7, #12]\n\t"
        "adds r7, #16\n\t" "mov r1, r11\n\t" "adds r1, #16\n\t"
        "cmp r7, r12\n\t" "bne 1b"
        : "+r"(r1), "+r"(r7)
        : "r"(r2), "r"(r12)
        : "r0", "r3", "r4", "r5", "r6", "r8", "r9", "r10", "r11", "cc", "memory");
}
/* Two pixels each, which come to FIRST and SECOND where these differ. */
#define LINE_ALIKE_ARMV6M(FIRST, SECOND) \
    "ldm r0!, {r3, r4}\n\t" "ldm r1!, {r5, r6}\n\t" "cmp r3, r5\n\t" "bne " FIRST "f\n\t" "cmp r4, r6\n\t" "bne " SECOND "f\n\t"

/* Goes on to the last pixel before one that differs, of four at least, or before the last three. 3.5 instructions a pixel, where compilers
 * take 8. */
SMEAR_INLINE void pass_alike_armv6m(uint32_t **a, const uint32_t **b, const uint32_t *last)
{
    register uint32_t *r0 __asm__("r0") = *a;
    register const uint32_t *r1 __asm__("r1") = *b;
    register const uint32_t *r2 __asm__("r2") = last;
    __asm__(".syntax unified\n"
            "1: " LINE_ALIKE_ARMV6M("2", "3") LINE_ALIKE_ARMV6M("2", "3") "cmp r0, r2\n\t" "bls 1b\n\t" "b 4f\n"
            "2: subs r0, #4\n\t" "subs r1, #4\n"
            "3: subs r0, #4\n\t" "subs r1, #4\n"
            "4: subs r0, #4\n\t" "subs r1, #4"
            : "+r"(r0), "+r"(r1) : "r"(r2) : "r3", "r4", "r5", "r6", "cc", "memory");
    *a = r0;
    *b = r1;
}

/* Writes the means of three, n not 0, of words that differ: 36 instructions a pixel and 7 where they are alike, compilers 53 and 10. */
static inline void line_mix_three_armv6m(uint32_t *mean, const uint32_t *more, const uint32_t *last, int32_t n)
{
    register uint32_t *r0 __asm__("r0") = mean;
    register const uint32_t *r1 __asm__("r1") = more, *r2 __asm__("r2") = last, *r12 __asm__("r12") = mean + n;
    __asm__ volatile(
        ".syntax unified\n\t" "movs r3, #255\n\t" "lsls r4, r3, #16\n\t" "orrs r3, r4\n\t" "mov r8, r3\n\t"     /* 0x00ff00ff */
        "movs r3, #128\n\t" "lsls r4, r3, #16\n\t" "orrs r3, r4\n\t" "mov r9, r3\n"                              /* halves */
        "1: ldr r3, [r0]\n\t" "ldm r1!, {r4}\n\t" "ldm r2!, {r5}\n\t" "cmp r3, r4\n\t" "bne 2f\n\t" "cmp r3, r5\n\t" "beq 3f\n"
        "2: adds r6, r3, r4\n\t" "adds r6, r6, r5\n\t" "mov r7, r8\n\t" "ands r3, r7\n\t" "ands r4, r7\n\t" "ands r5, r7\n\t"
        "adds r3, r3, r4\n\t" "adds r3, r3, r5\n\t" "subs r6, r6, r3\n\t" "lsrs r6, r6, #8\n\t" "movs r5, #85\n\t"
        "lsrs r4, r3, #2\n\t" "ands r4, r7\n\t" "muls r3, r5\n\t" "adds r3, r3, r4\n\t" "add r3, r9\n\t" "lsrs r3, r3, #8\n\t"
        "ands r3, r7\n\t" "lsrs r4, r6, #2\n\t" "uxtb r4, r4\n\t" "muls r6, r5\n\t" "adds r6, r6, r4\n\t" "adds r6, #128\n\t"
        "lsrs r6, r6, #8\n\t" "uxtb r6, r6\n\t" "lsls r6, r6, #8\n\t" "orrs r3, r6\n\t" "stm r0!, {r3}\n\t"
        "cmp r0, r12\n\t" "bne 1b\n\t" "b 7f\n"
        "3: adds r0, #4\n\t" "mov r7, r12\n\t" "subs r7, #8\n\t" "cmp r0, r7\n\t" "bhi 6f\n"
        "4: " LINE_ALIKE_ARMV6M("5", "5") "ldm r2!, {r5, r6}\n\t" "cmp r3, r5\n\t" "bne 8f\n\t" "cmp r4, r6\n\t" "bne 8f\n\t"
        "cmp r0, r7\n\t" "bls 4b\n\t" "b 6f\n" "8: subs r2, #8\n" "5: subs r0, #8\n\t" "subs r1, #8\n\t" "b 1b\n"
        "6: cmp r0, r12\n\t" "bne 1b\n" "7:"
        : "+r"(r0), "+r"(r1), "+r"(r2) : "r"(r12) : "r3", "r4", "r5", "r6", "r7", "r8", "r9", "cc", "memory");
}
/* clang-format on */

static inline void find_bytes(int32_t *bytes, const struct line_block *b, int32_t log)
{
    for (int k = 0; k < 1 << log; k++)
        bytes[k] = b->offset[k] * 4;
}
#endif

/* Rounds sums of 2^log codes. */
SMEAR_INLINE uint32_t mean_of(uint32_t all, uint32_t red_blue, int32_t log)
{
    const uint32_t half = (1u << log) >> 1, green = ((all - red_blue) >> 8) + half;
    return ((red_blue + half * 0x10001u) >> log & 0xff00ffu) | (green >> log & 0xffu) << 8;
}

SMEAR_INLINE uint32_t code_mean(const uint32_t *in, const int32_t *offset, int32_t log)
{
    uint32_t all = 0, red_blue = 0;
    for (int k = 0; k < 1 << log; k++) {
        const uint32_t c = in[offset[k]];
        all += c;
        red_blue += c & 0xff00ffu;
    }
    return mean_of(all, red_blue, log);
}

/* Returns the root of a square of codes, to the nearest code but for one at most; of squares exactly. */
SMEAR_INLINE uint32_t root_of(uint32_t square)
{
    return square < 3 ? square != 0 : square < 4092 ? (smear_sqrt_q3[(square + 1) >> 2] + 2u) >> 2
                                                    : smear_sqrt_q3[min_u32((square + 32) >> 6, 1023)];
}

/* Light is told by the squares of codes: products are cheaper than tables, and it is within what sketches err by. */
static uint32_t light_mean(const uint32_t *in, const int32_t *offset, int32_t log)
{
    const uint32_t first = in[offset[0]];
    uint32_t r = 0, g = 0, b = 0, differs = 0;
    for (int k = 1; k < 1 << log; k++)
        differs |= in[offset[k]] ^ first;
    if (differs == 0)                   /* as most pixels of a line are */
        return first & 0xffffffu;
    for (int k = 0; k < 1 << log; k++) {
        const uint32_t c = in[offset[k]];
        r += pixel_red(c) * pixel_red(c);
        g += pixel_green(c) * pixel_green(c);
        b += pixel_blue(c) * pixel_blue(c);
    }
    return pixel_make(0, root_of(r >> log), root_of(g >> log), root_of(b >> log));
}

static inline uint32_t mean_at(const struct line_block *b, const uint32_t *in, bool linear)
{
    return SMEAR_WITH_LINEAR && linear ? light_mean(in, b->offset, b->log) : code_mean(in, b->offset, b->log);
}

/* Writes a mean and the three between it and the next. */
static inline void write_between(uint32_t out[LINE_SPARSE], uint32_t mean, uint32_t next)
{
    out[0] = mean;
    out[2] = line_between(mean, next);
    out[1] = line_between(mean, out[2]);
    out[3] = line_between(out[2], next);
}

void smear_line_means_reference(const struct line_block *b, bool linear)
{
    for (int32_t y = 0; y < b->rows; y++) {
        const uint32_t *in = b->in + y * b->in_stride;
        uint32_t *out = b->out + y * b->out_stride, next = b->sparse ? mean_at(b, in, linear) : 0;
        for (int32_t x = 0; x < b->columns; x += b->sparse ? (int32_t)LINE_SPARSE : 1) {
            const uint32_t mean = b->sparse ? next : mean_at(b, in + x, linear);
            if (b->sparse)
                write_between(out + x, mean, next = mean_at(b, in + x + LINE_SPARSE, linear));
            else
                out[x] = mean;
        }
    }
}

#if SMEAR_VECTORS
/* Loads a tap of four pixels, so far apart. */
SMEAR_INLINE smear_v4u tap4(const uint32_t *in, int second, int third, int last)
{
    return second == 1 ? v4u_load(in) : (smear_v4u){ in[0], in[second], in[third], in[last] };
}

/* Adds four taps: not in a loop, which compilers would keep. */
SMEAR_INLINE void add_taps(smear_v4u *all, smear_v4u *red_blue, const uint32_t *in, const int32_t *offset, int second, int third, int last)
{
    const smear_v4u a = tap4(in + offset[0], second, third, last), b = tap4(in + offset[1], second, third, last);
    const smear_v4u c = tap4(in + offset[2], second, third, last), d = tap4(in + offset[3], second, third, last);
    *all += a + b + c + d;
    *red_blue += (a & 0xff00ffu) + (b & 0xff00ffu) + (c & 0xff00ffu) + (d & 0xff00ffu);
}

/* Returns the means of 2^log taps, four or eight. */
SMEAR_INLINE smear_v4u code_means(const uint32_t *in, const int32_t *offset, int32_t log, int second, int third, int last)
{
    const uint32_t half = (1u << log) >> 1;
    smear_v4u all = { 0, 0, 0, 0 }, red_blue = all;
    add_taps(&all, &red_blue, in, offset, second, third, last);
    if (log == 3)
        add_taps(&all, &red_blue, in, offset + 4, second, third, last);
    const smear_v4u green = ((all - red_blue) >> 8) + half;
    return ((red_blue + half * 0x10001u) >> log & 0xff00ffu) | (green >> log & 0xffu) << 8;
}

/* Writes four means and what lies between each and its next one. */
SMEAR_INLINE void write_between4(uint32_t *out, smear_v4u mean, smear_v4u next)
{
    const smear_v4u middle = v4u_mean8(mean, next);
    v4i_store_columns((int32_t *)out, (smear_v4i)mean, (smear_v4i)v4u_mean8(mean, middle), (smear_v4i)middle,
                      (smear_v4i)v4u_mean8(middle, next));
}

/* Means of the light of four pixels, so far apart. */
SMEAR_INLINE smear_v4u light_means4(const uint32_t *in, const int32_t *offset, int32_t log, int second, int third, int last)
{
    const uint32_t *first = in + offset[0];
    const smear_v4u same = { first[0], first[second], first[third], first[last] };
    smear_v4u differs = { 0, 0, 0, 0 }, sum[3] = { differs, differs, differs };
    for (int k = 1; k < 1 << log; k++) {
        const uint32_t *tap = in + offset[k];
        differs |= (smear_v4u){ tap[0], tap[second], tap[third], tap[last] } ^ same;
    }
    if (!v4u_any(differs))
        return same & 0xffffffu;
    for (int k = 0; k < 1 << log; k++) {        /* the square of a code has 16 bits */
        const uint32_t *tap = in + offset[k];
        const smear_v4u c = { tap[0], tap[second], tap[third], tap[last] };
        const smear_v4u red_blue = c & 0xff00ffu, green = c >> 8 & 0xffu, squares = v4u_mul16(red_blue, red_blue);
        sum[0] += squares & 0xffffu;
        sum[1] += v4u_mul16(green, green);
        sum[2] += squares >> 16;
    }
    smear_v4u mean;
    for (int i = 0; i < 4; i++)
        mean[i] = pixel_make(0, root_of(sum[2][i] >> log), root_of(sum[1][i] >> log), root_of(sum[0][i] >> log));
    return mean;
}

static void light_means(const struct line_block *b)
{
    for (int32_t y = 0; y < b->rows; y++) {
        const uint32_t *in = b->in + y * b->in_stride, *const end = in + b->columns;
        uint32_t *out = b->out + y * b->out_stride;
        for (; end - in >= 4; in += 4, out += 4)
            v4u_store(out, light_means4(in, b->offset, b->log, 1, 2, 3));
        for (; in != end; in++, out++)
            *out = light_mean(in, b->offset, b->log);
    }
}

/* Eight taps of every fourth pixel. */
SMEAR_INLINE void sparse_means8(const struct line_block *b, bool linear)
{
    enum { TWO = 2 * LINE_SPARSE, FOUR = 4 * LINE_SPARSE, LOG = LINE_TAPS_LOG_MAX };
    for (int32_t y = 0; y < b->rows; y++) {
        const uint32_t *in = b->in + y * b->in_stride;
        uint32_t *out = b->out + y * b->out_stride;
        int32_t left = b->columns;
        for (; left >= FOUR; left -= FOUR, in += FOUR, out += FOUR) {
            const smear_v4u mean = linear ? light_means4(in, b->offset, LOG, LINE_SPARSE, TWO, 3 * LINE_SPARSE)
                                          : code_means(in, b->offset, LOG, LINE_SPARSE, TWO, 3 * LINE_SPARSE);
            const uint32_t end = linear ? light_mean(in + FOUR, b->offset, LOG) : code_mean(in + FOUR, b->offset, LOG);
            write_between4(out, mean, (smear_v4u){ mean[1], mean[2], mean[3], end });
        }
        if (left >= TWO) {
            const smear_v4u mean = linear ? light_means4(in, b->offset, LOG, LINE_SPARSE, TWO, TWO)
                                          : code_means(in, b->offset, LOG, LINE_SPARSE, TWO, TWO);
            write_between(out, mean[0], mean[1]);
            write_between(out + LINE_SPARSE, mean[1], mean[2]);
            left -= TWO, in += TWO, out += TWO;
        }
        if (left > 0)
            write_between(out, mean_at(b, in, linear), mean_at(b, in + LINE_SPARSE, linear));
    }
}

static void sparse_code_means(const struct line_block *b) { sparse_means8(b, false); }
static void sparse_light_means(const struct line_block *b) { sparse_means8(b, true); }
#else
static void sparse_code_means(const struct line_block *b)
{
#if PACKED_ASM_ARMV6M
    int32_t bytes[LINE_TAPS_MAX];
    find_bytes(bytes, b, LINE_TAPS_LOG_MAX);
    for (int32_t y = 0; y < b->rows; y++)
        line_means_sparse_armv6m(b->out + y * b->out_stride, b->in + y * b->in_stride, bytes, b->columns);
#else
    for (int32_t y = 0; y < b->rows; y++) {
        const uint32_t *in = b->in + y * b->in_stride, *const end = in + b->columns;
        uint32_t *out = b->out + y * b->out_stride, next = code_mean(in, b->offset, LINE_TAPS_LOG_MAX);
        for (; in != end; in += LINE_SPARSE, out += LINE_SPARSE) {
            const uint32_t mean = next;
            write_between(out, mean, next = code_mean(in + LINE_SPARSE, b->offset, LINE_TAPS_LOG_MAX));
        }
    }
#endif
}
static void light_means(const struct line_block *b) { smear_line_means_reference(b, true); }
static void sparse_light_means(const struct line_block *b) { smear_line_means_reference(b, true); }
#endif

/* Codes of a number of taps that is known. */
SMEAR_INLINE void code_means_of(const struct line_block *b, int32_t log)
{
    const uint32_t *in = b->in;
    uint32_t *out = b->out;
#if PACKED_ASM_ARMV6M
    int32_t bytes[LINE_TAPS_MAX];
    find_bytes(bytes, b, log);
#endif
    for (int32_t y = 0; y < b->rows; y++, in += b->in_stride, out += b->out_stride) {
        int32_t x = 0;
#if SMEAR_VECTORS
        for (; x + 4 <= b->columns; x += 4)
            v4u_store(out + x, code_means(in + x, b->offset, log, 1, 2, 3));
#elif PACKED_ASM_ARMV6M
        x = b->columns & ~1;
        if (x != 0)
            (log == 2 ? line_means4_armv6m : line_means8_armv6m)(out, in, bytes, x);
#endif
        for (; x < b->columns; x++)
            out[x] = code_mean(in + x, b->offset, log);
    }
}

/* Of one tap. */
static void copy_rows(const struct line_block *b)
{
    for (int32_t y = 0; y < b->rows; y++)
        __builtin_memcpy(b->out + y * b->out_stride, b->in + y * b->in_stride + b->offset[0], (size_t)b->columns * sizeof *b->out);
}

void smear_line_means(const struct line_block *b, bool linear)
{
    if (b->log == 0)
        copy_rows(b);
    else if (b->sparse && SMEAR_WITH_LINEAR && linear)
        sparse_light_means(b);
    else if (b->sparse)
        sparse_code_means(b);
    else if (SMEAR_WITH_LINEAR && linear)
        light_means(b);
    else if (b->log == 3)
        code_means_of(b, 3);
    else if (b->log == 2)
        code_means_of(b, 2);
    else
        smear_line_means_reference(b, false);       /* of two taps, which lines do not have */
}

/* ------------------------------------------------------------------ means of pictures */

/* The mean of three, of pixels or of vectors of them: a third is 85 and a quarter, in 16 bits: 256 / 3 = 85.33. */
#define LINE_SUM(a, b, c) (((a) & 0xff00ffu) + ((b) & 0xff00ffu) + ((c) & 0xff00ffu))
#define LINE_THIRD(s) (((s) * 85u + ((s) >> 2 & 0xff00ffu) + 0x800080u) >> 8 & 0xff00ffu)
#define LINE_MEAN3(a, b, c) (LINE_THIRD(LINE_SUM(a, b, c)) | (LINE_THIRD(LINE_SUM((a) >> 8, (b) >> 8, (c) >> 8)) & 0xffu) << 8)

/* Returns the code of the mean of their light. */
static uint32_t mixed_light(uint32_t a, uint32_t b, uint32_t c, bool three)
{
    const uint32_t part = three ? 65536 / 3 : 65536 / 2;
    uint32_t out = 0;
    for (int i = 0; i < 24; i += 8) {
        const uint32_t light = smear_srgb_light[a >> i & 255u] + smear_srgb_light[b >> i & 255u];
        out |= (uint32_t)smear_srgb_encode[((light + (three ? smear_srgb_light[c >> i & 255u] : 0u)) * part + 32768) >> 16] << i;
    }
    return out;
}

/* What is not 0 where a channel differs by 16 or more, about: light of such codes is mixed as codes, which are off by less than one but
 * in the dark. Halves of codes are told apart, by 8. */
#define LINE_FAR(a, b) ((((((a) >> 1 & 0x7f7f7fu) | 0x808080u) - ((b) >> 1 & 0x7f7f7fu) + 0x080808u) & 0xf0f0f0u) ^ 0x808080u)

/* Writes the mean of two, or of three. */
SMEAR_INLINE void mix(uint32_t *mean, const uint32_t *more, const uint32_t *last, int32_t n, bool three, bool linear)
{
    for (const uint32_t *const end = mean + n; mean != end; mean++, more++) {
        const uint32_t a = *mean, b = *more, c = three ? *last++ : b;
#if PACKED_ASM_ARMV6M
        if (!three && a == b && end - mean >= 4)
            pass_alike_armv6m(&mean, &more, end - 4);
#endif
        if (a == b && a == c)
            continue;
        if (SMEAR_WITH_LINEAR && linear && (LINE_FAR(a, b) | LINE_FAR(a, c)) != 0)
            *mean = mixed_light(a, b, c, three);
        else
            *mean = three ? LINE_MEAN3(a, b, c) : line_between(a, b);
    }
}

/* Of four, `mean` has that of two already. */
void smear_line_mix_reference(uint32_t *mean, uint32_t *more, const uint32_t *last, int32_t n, int32_t k, bool linear)
{
    if (k == 3)
        mix(more, last, NULL, n, false, linear);
    mix(mean, more, last, n, k == 2, linear);
}

/* Does so in rounds of vectors. */
SMEAR_INLINE void mix_rounds(uint32_t *mean, const uint32_t *more, const uint32_t *last, int32_t n, bool three, bool linear)
{
#if SMEAR_VECTORS
    for (; n >= 4; n -= 4, mean += 4, more += 4, last += 4) {
        const smear_v4u a = v4u_load(mean), b = v4u_load(more), c = three ? v4u_load(last) : b;
        if (!v4u_any((a ^ b) | (a ^ c)))
            continue;
        if (SMEAR_WITH_LINEAR && linear && v4u_any(LINE_FAR(a, b) | LINE_FAR(a, c)))
            mix(mean, more, last, 4, three, true);
        else
            v4u_store(mean, three ? LINE_MEAN3(a, b, c) : v4u_mean8(a, b));
    }
#endif
#if PACKED_ASM_ARMV6M
    if (three && !(SMEAR_WITH_LINEAR && linear))
        line_mix_three_armv6m(mean, more, last, n);
    else
#endif
        mix(mean, more, last, n, three, linear);
}

void smear_line_mix(uint32_t *mean, uint32_t *more, const uint32_t *last, int32_t n, int32_t k, bool linear)
{
    if (k == 2)
        mix_rounds(mean, more, last, n, true, linear);
    for (int32_t two = k == 3 ? 2 : k == 1; two > 0; two--)
        mix_rounds(two == 2 ? more : mean, two == 2 ? last : more, more, n, false, linear);
}
