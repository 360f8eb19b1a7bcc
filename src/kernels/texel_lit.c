/* SPDX-License-Identifier: MIT */
/* texel_lit.c - see texel_lit.h. */
#include "kernels/texel_lit.h"

#if SMEAR_AVX2

/* smear_srgb_decode of the codes that texel_fetch makes of levels. */
const struct lit_levels smear_lit_levels = {
    { 0,     159,   340,   637,   997,   1453,  2013,  2773,  3570,  4488,  5530,  6700,  8177,  9635,  11235, 12980,
      15122, 17187, 19407, 21787, 24658, 27386, 30282, 33350, 36591, 40449, 44069, 47871, 51858, 56567, 60955, 65535 },
    { 0,     80,    159,   241,   340,   458,   599,   761,   947,   1156,  1391,  1720,  2013,  2333,  2681,  3058,
      3464,  3900,  4366,  4864,  5392,  5953,  6547,  7174,  7834,  8528,  9258,  10022, 10822, 11658, 12530, 13440,
      14629, 15623, 16656, 17727, 18837, 19987, 21177, 22407, 23678, 24990, 26344, 27739, 29176, 30656, 32179, 33745,
      35355, 37008, 38706, 40449, 42236, 44534, 46423, 48359, 50341, 52369, 54445, 56567, 58737, 60955, 63221, 65535 }
};

#define EIGHT(a) { a, a, a, a, a, a, a, a }

const struct lit_numbers smear_lit_numbers = {
    .five = EIGHT(31), .six = EIGHT(63), .code = EIGHT(255), .half = EIGHT(0xffff),
    .by_rb = EIGHT(249 * 0x10001), .more_rb = EIGHT(1014 * 0x10001), .by_g = EIGHT(253), .more_g = EIGHT(505), .green = EIGHT(0x7e0),
    .red = EIGHT(31 << 16), .by_five = EIGHT(527 * 0x10001), .more_five = EIGHT(23 * 0x10001), .by_six = EIGHT(259), .more_six = EIGHT(33),
    .pair = EIGHT(0xff00ff), .round = EIGHT(128 * 0x10001)
};
#endif
