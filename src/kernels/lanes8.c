/* SPDX-License-Identifier: MIT */
/* lanes8.c - constants of lanes8.h. */
#include "kernels/lanes8.h"

#if SMEAR_AVX2
#define ALL8(a) { a, a, a, a, a, a, a, a }

/* In the order of their names; C++ knows no other. */
const uint32_t smear_lanes8_words[LANES8_WORDS][8] = {
    ALL8(1), ALL8(8), ALL8(15), ALL8(16), ALL8(17), ALL8(24), ALL8(31), ALL8(53), ALL8(64), ALL8(127), ALL8(128), ALL8(135), ALL8(255),
    ALL8(256), ALL8(511), ALL8(1023), ALL8(4095), ALL8(4096), ALL8(4915), ALL8(32768), ALL8(35822), ALL8(65535), ALL8(65536), ALL8(~1u),
    ALL8(0xff00ffu), ALL8(1u << 19), ALL8(1u << 22), ALL8(1u << 31), ALL8(15u * 32768u)
};
#endif
