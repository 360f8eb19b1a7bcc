/* SPDX-License-Identifier: MIT */
/* tables.h - constants written by tools/gentables.c. */
#ifndef SMEAR_TABLES_H
#define SMEAR_TABLES_H

#include "kernels/bind.h"

extern const uint16_t smear_recip_seed[512];    /* fixmath.h */
extern const uint16_t smear_srgb_decode[256];   /* code to linear light, 65535 is one */
extern const uint8_t smear_srgb_encode[4096];   /* linear light >> 4 to code */
extern const uint16_t smear_srgb_light[256];    /* code to linear light, 4095 is one, nearly: light_sums.h */
extern const uint8_t smear_sqrt_q3[1024];       /* 8 sqrt(i), at most 255 */
extern const int8_t smear_sine[256];            /* 127 sin(i 2 pi / 256) */
extern const uint8_t smear_dither_ordered[64];  /* thresholds in 1/256, 8 x 8 */
extern const uint8_t smear_dither_blue[1024];   /* thresholds in 1/256, 32 x 32 */
extern const uint16_t smear_dither_steps[64];   /* of thresholds 4 k + 2: pixel_rows.c */
extern const uint32_t smear_dither_pairs[32];   /* those of smear_dither_ordered, two columns in a word */
extern const uint32_t smear_streak_across[128]; /* of a dot's chords: points.c */
extern const uint16_t smear_streak_end[256];    /* part of a chord's light up to a place */

#endif
