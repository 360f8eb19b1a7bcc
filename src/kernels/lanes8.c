/* SPDX-License-Identifier: MIT */
/* lanes8.c - constants of lanes8.h. */
#include "kernels/lanes8.h"

#if SMEAR_AVX2
#define ALL8(a) { a, a, a, a, a, a, a, a }

const uint32_t smear_lanes8_words[LANES8_WORDS][8] = {
    [LANES8_1] = ALL8(1), [LANES8_15] = ALL8(15), [LANES8_16] = ALL8(16), [LANES8_17] = ALL8(17), [LANES8_24] = ALL8(24),
    [LANES8_31] = ALL8(31), [LANES8_53] = ALL8(53), [LANES8_64] = ALL8(64), [LANES8_127] = ALL8(127),
    [LANES8_128] = ALL8(128), [LANES8_135] = ALL8(135), [LANES8_255] = ALL8(255), [LANES8_256] = ALL8(256),
    [LANES8_511] = ALL8(511), [LANES8_1023] = ALL8(1023), [LANES8_4096] = ALL8(4096), [LANES8_4915] = ALL8(4915),
    [LANES8_32768] = ALL8(32768), [LANES8_35822] = ALL8(35822), [LANES8_65535] = ALL8(65535), [LANES8_LESS_2] = ALL8(~1u),
    [LANES8_RED_BLUE] = ALL8(0xff00ffu), [LANES8_2_19] = ALL8(1u << 19), [LANES8_2_22] = ALL8(1u << 22),
    [LANES8_2_31] = ALL8(1u << 31), [LANES8_BREAK_15] = ALL8(15u * 32768u)
};
#endif
