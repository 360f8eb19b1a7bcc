/* SPDX-License-Identifier: MIT */
/* projection.h - a random projection, under which most vertices lie before the camera: for kernels that find vertices. */
#ifndef SMEAR_TESTS_KERNELS_PROJECTION_H
#define SMEAR_TESTS_KERNELS_PROJECTION_H

#include "tests/kernels/kernels.h"

#include "kernels/places.h"

enum { SHIFT = 9, NEAR, FAR, CLOSE = 6 };       /* words of a call: of the first nine are the rows */

/* Brings a call's words into range. The depth's shift is below `shifts`. */
static inline void projection_prepare(struct kernel_call *c, uint32_t shifts)
{
    const uint32_t bits = 8 + random_u32() % 13u;
    for (int i = 0; i < 9; i++)         /* sums of three products and an offset stay below 2^30 */
        c->word[i] = (uint32_t)((int32_t)c->word[i] >> (i < 6 ? 3 : (int)(31 - bits)));
    c->word[SHIFT] = c->word[SHIFT] % shifts;
    c->word[NEAR] = 1 + c->word[NEAR] % 4096u;
    c->word[FAR] = (c->word[FAR] & 1u) != 0 ? INT32_MAX : 1u << 21;
}

/* Makes the setup, of which `m` are the rows. `shift`: taken off the depth's; x, y: the frame's centre, q8 px. */
static inline struct place_setup projection_setup(int32_t m[3][4], const struct kernel_call *c, int32_t shift, int32_t x, int32_t y)
{
    for (int r = 0; r < 3; r++) {
        for (int j = 0; j < 3; j++)
            m[r][j] = (int32_t)c->word[3 * r + j] & ~3;
        m[r][3] = r < 2 ? m[r][0] >> 2 : (int32_t)(c->word[CLOSE] >> 7 | 1u << 21);
    }
    if ((c->word[CLOSE] & 3u) == 0) {       /* as close as may be, all of them */
        m[2][0] = m[2][1] = m[2][2] = 0;
        m[2][3] = (int32_t)(c->word[CLOSE] >> 2 & 1u ? c->word[NEAR] : 1u + (c->word[CLOSE] >> 3) % 8192u);
    }
    return (struct place_setup){ (const int32_t(*)[4])m, (int32_t)c->word[NEAR], (int32_t)c->word[FAR], 0x2aaaaaaa,
                                 (int32_t)c->word[SHIFT] - shift, 4096, 0x43ff8000, x, y };
}

#endif
