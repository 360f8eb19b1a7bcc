/* SPDX-License-Identifier: MIT */
/* kernels.h - inner loops that have more than one form, how to add one, and what other rooms hand to them by value.
 *
 * Every loop that has a vector or assembly form stands in this room. Kernels take pointers, strides, counts
 * and small structs, never a context, a target or a window; they know nothing of the stages that call them.
 *
 * A kernel NAME consists of
 *   - its contract, the comment above it: shapes, ranges, alignment, what may overlap, rounding;
 *   - NAME_reference, a short scalar loop that defines the result bit for bit: here where some build draws by it, else beside its
 *     test in tests/kernels/FAMILY.c;
 *   - its variants: NAME_lanes or NAME_vector where SMEAR_VECTORS is set, NAME_armv6m where
 *     SMEAR_ASM_ARMV6M is, NAME_armv7em where SMEAR_ASM_ARMV7EM is, NAME_arm where SMEAR_ASM_ARM is, NAME_unrolled
 *     where plain C that compilers turn into better code pays on every core;
 *   - NAME itself, which the library calls: the best variant of this build, else the reference. bind.h says which that is.
 *
 * How to add one
 *   1. src/kernels/FAMILY.h holds related kernels as `static inline` functions (SMEAR_INLINE where callers pass
 *      constants). What is long or called from several files is declared there with the prefix smear_ and defined
 *      in src/kernels/FAMILY.c; what a build does not call, its linker leaves out (--gc-sections).
 *   2. tests/kernels/FAMILY.c describes each kernel for check_kernels (tests/kernels/kernels.h): the planes of pixels it
 *      takes, what makes random data fit its contract, and a call of each form. The Makefile finds the file.
 *   3. `make check-kernels` compares every variant of this machine with its reference, in all lengths up to two
 *      vectors and three, at all alignments, on random and extreme data with guarded outputs, and prints
 *      nanoseconds a pixel of each form. `make TARGET=cortex-m0plus target-test` does the comparison for that
 *      core, and so does every other target that runs unit tests.
 *   4. A variant stays only if a whole frame gains 2 % by it: ledger.md says how much. */
#ifndef SMEAR_KERNELS_H
#define SMEAR_KERNELS_H

#include "base/pixel.h"

/* Where a triangle's row begins and ends. */
struct span_side {
    int32_t left, right;        /* as the frame shows them; there may be none */
    int32_t edge;               /* right, wherever that is */
};

/* One plane of pixels of which some rows exist, in a ring: the target's row `y0` is row `ring_row` of the
 * memory, and after row `ring - 1` comes row 0. Column x is at x - x0. */
struct smear_plane_rows {
    int32_t stride;         /* pixels */
    int32_t ring_row, ring, x0;
};

/* smear.h, smear_depth_units */
enum depth_slope {
    SLOPE_FAR,              /* code = units */
    SLOPE_NEAR,             /* code = 32768 + (units - 32768) / 16 */
    SLOPE_BOTH
};

#define SLOPE_BREAK (32768 << 11)       /* q11 units */

/* Depth code in 16.16, rounding included, of units in q11. */
static inline uint32_t code_from_units(int32_t units, enum depth_slope slope)
{
    return slope == SLOPE_FAR ? ((uint32_t)units << 5) + 0x8000u
                              : ((uint32_t)units << 1) + (0x80000000u - 0x08000000u + 0x8000u);
}

/* Returns the depth code of units (smear_depth_units), rounded down. */
static inline uint16_t depth_code_of(uint32_t units)
{
    return (uint16_t)(units < 32768u ? units : min_u32(32768u + ((units - 32768u) >> 4), 65535u));
}

/* The longest blocks of colours. Those of texture coordinates may be longer where they hardly bend. */
enum { COLOR_BLOCK_MAX = 16, BLOCK_LONG = 32, BLOCK_LONGEST = 64 };

/* Coordinates u and v count turns: 2^32 are the texture's width or height. They change from pixel to pixel by du and dv,
 * and these by ddu and ddv. */

/* Two coordinates in one word: v above u. */
static inline uint64_t packed_uv(uint32_t u, uint32_t v) { return (uint64_t)v << 32 | u; }

/* Two changes in one word: u has a sign of its own, which it borrows from v. */
static inline uint64_t packed_step(uint32_t du, uint32_t dv)
{
    return ((uint64_t)dv << 32) + (uint64_t)(int64_t)(int32_t)du;
}

/* A polynomial of x and y, modulo 2^32. */
struct curve {
    int32_t at, dx, dy, dxx, dxy, dyy;
};

/* What becomes of a colour's channel: that of v[1] and of v[2] less that of v[0], 16 bits each, and that of v[0], q14, with what
 * rounds codes (tiny_channels). */
struct tiny_channel {
    int32_t to1, to2;
    uint32_t base;
};

/* A box of columns x rows > 0 pixels, which lie in rows of `stride` pixels; `depth` and `pixels` are those of the first. Its edge
 * functions e1 and e2 are the weights of v[1] and v[2], the third is sum - e1 - e2; all stay within 31 bits in the box and one
 * column and row beyond. */
struct tiny_box {
    int32_t e1, e2, down1, down2; /* at the first pixel, one row further down */
    int32_t columns, stride;
    uint16_t *depth;
    int32_t rows;
    int32_t up; /* weights: tiny_scale */
    uint32_t recip;
    uint32_t units; /* units of v[0], with what makes them codes by a shift: tiny_codes */
    int32_t code_shift;
#if SMEAR_ASM_ARMV7EM
    int32_t twice1, twice2; /* units of v[1] and of v[2] less those of v[0], below 2^30, times two */
    uint32_t to_pixel;      /* for assembly: pixels - depth, or where pixels are wide - 2 depth */
#else
    int32_t to1_low, to1_high, to2_low, to2_high; /* units of v[1] and of v[2] less those of v[0]: 16 bits each */
#endif
    uint32_t color;                               /* where it is not shaded */
    struct tiny_channel channel[3];               /* red, blue, green */
    int32_t right1, right2, sum;                  /* one column further right */
    uint32_t round;                               /* for assembly: of red and blue, rgb565_nearest */
    void *pixels;
    bool shaded, narrow;
    smear_transfer transfer;
};

#endif
