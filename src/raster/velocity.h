/* SPDX-License-Identifier: MIT */
/* velocity.h - what is kept of a pixel's velocity. */
#ifndef SMEAR_VELOCITY_H
#define SMEAR_VELOCITY_H

#include "base/fixed.h"

/* Both components of a velocity that is still to be told from depth: in
 * 8 or in 16 bits it lies beyond every reach. */
#define SMEAR_VELOCITY_UNKNOWN8 ((int8_t)-128)
#define SMEAR_VELOCITY_UNKNOWN16 ((int16_t)-32640)     /* the same byte twice */

/* A displacement between two poses, q8 px, times `scale` (q16) is half the exposure's, q16 px. It is brought within the
 * reach: the direction is kept. */
void smear_velocity_store(const int32_t displacement[2], int32_t scale, int32_t reach_q3, int32_t out[2]);

#endif
