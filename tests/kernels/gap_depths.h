/* SPDX-License-Identifier: MIT */
/* gap_depths.h - depths beside gaps, for those that call kernels which close them. */
#ifndef KERNELS_TEST_GAP_DEPTHS_H
#define KERNELS_TEST_GAP_DEPTHS_H

#include "kernels/gap_means.h"
#include "tests/kernels/kernels.h"

/* Often equal, or around the nearest one, which is a word as what is covered is. */
static inline void gap_depths(struct kernel_call *c, uint16_t *depth, int32_t pixels, int cover, int nearest_word)
{
    const uint32_t nearest = c->word[nearest_word] & 0xffffu, level = random_u32() % (nearest + 1);
    for (int32_t i = 0; i < pixels; i++) {
        const uint32_t steps = random_u32() % 5u;
        if (c->word[cover] == COVER_NONE)
            depth[i] = (uint16_t)level;
        else if (steps < 4)
            depth[i] = (uint16_t)(nearest + steps - 2);
        if (c->word[cover] == COVER_FEW && depth[i] > nearest)
            depth[i] = (uint16_t)level;
    }
    c->word[nearest_word] = nearest;
}

#endif
