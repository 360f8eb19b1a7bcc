/* SPDX-License-Identifier: MIT */
/* depth_range.h - least and greatest depth code of a box of pixels. */
#ifndef SMEAR_KERNELS_DEPTH_RANGE_H
#define SMEAR_KERNELS_DEPTH_RANGE_H

#include "kernels/kernels.h"

struct depth_range {
    uint32_t least, most;       /* codes, 0 .. 65535 */
};

/* The range of `height` rows of `width` codes, whose starts lie `pitch` codes apart; reads no other codes.
 * An empty box has the range 65535 .. 0. */
static inline struct depth_range depth_range_reference(const uint16_t *depth, int32_t pitch, int32_t width,
                                                       int32_t height)
{
    struct depth_range r = { UINT16_MAX, 0 };
    for (int32_t y = 0; y < height; y++, depth += pitch) {
        for (int32_t x = 0; x < width; x++) {
            r.least = min_u32(r.least, depth[x]);
            r.most = max_u32(r.most, depth[x]);
        }
    }
    return r;
}

#if !defined(__OPTIMIZE_SIZE__)
static inline void range_add(uint32_t *least, uint32_t *most, uint32_t code)
{
    *least = min_u32(*least, code);
    *most = max_u32(*most, code);
}

/* A round of the loops below. */
static inline void range_add4(uint32_t *least, uint32_t *most, const uint16_t *code)
{
    const uint32_t a = code[0], b = code[1], c = code[2], d = code[3];
    range_add(least, most, a);
    range_add(least, most, b);
    range_add(least, most, c);
    range_add(least, most, d);
}
#endif

#if !defined(__OPTIMIZE_SIZE__) && defined(__ARM_ARCH_6M__)
/* Four codes a round: 6 instructions a code of a Cortex-M0+ in place of 9, or 2 where they are the same as those before. */
static inline struct depth_range depth_range_unrolled(const uint16_t *depth, int32_t pitch, int32_t width, int32_t height)
{
    const bool any = width > 0 && height > 0;
    uint32_t least = any ? *depth : UINT16_MAX, most = any ? *depth : 0, before = least * 0x10001u;     /* two codes */
    for (int32_t y = 0; y < height; y++, depth += pitch) {
        const uint16_t *code = depth;
        int32_t left = width;
        if (((uintptr_t)code & 3u) != 0 && left > 0) {
            range_add(&least, &most, *code++);
            left--;
        }
        for (; left >= 4; left -= 4, code += 4) {
            uint32_t word[2];
            __builtin_memcpy(word, __builtin_assume_aligned(code, 4), sizeof word);
            if (((word[0] ^ before) | (word[1] ^ before)) == 0)
                continue;
            before = word[1];
            range_add4(&least, &most, code);
        }
        for (; left > 0; left--, code++)
            range_add(&least, &most, *code);
    }
    return (struct depth_range){ least, most };
}
#elif !defined(__OPTIMIZE_SIZE__)
/* Four codes a round. */
static inline struct depth_range depth_range_unrolled(const uint16_t *depth, int32_t pitch, int32_t width, int32_t height)
{
    uint32_t least = UINT16_MAX, most = 0;
    for (int32_t y = 0; y < height; y++, depth += pitch) {
        const uint16_t *code = depth;
        for (int32_t left = width; left >= 4; left -= 4, code += 4)
            range_add4(&least, &most, code);
        for (int32_t left = width & 3; left > 0; left--, code++)
            range_add(&least, &most, *code);
    }
    return (struct depth_range){ least, most };
}
#endif

static inline struct depth_range depth_range(const uint16_t *depth, int32_t pitch, int32_t width, int32_t height)
{
#if !defined(__OPTIMIZE_SIZE__)
    return depth_range_unrolled(depth, pitch, width, height);
#else
    return depth_range_reference(depth, pitch, width, height);
#endif
}

#endif
