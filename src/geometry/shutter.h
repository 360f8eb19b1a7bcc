/* SPDX-License-Identifier: MIT */
/* shutter.h - how much light a shutter lets through over the exposure, as time samples of equal weight. */
#ifndef SMEAR_SHUTTER_H
#define SMEAR_SHUTTER_H

#include "geometry/path.h"

/* Makes the samples of a shutter whose openness is given at SMEAR_SHUTTER_POINTS even steps over the exposure, with
 * straight lines between; null is a box. Returns false where it is closed throughout. */
bool smear_shutter_make(struct smear_shutter_times *shutter, const uint8_t *openness);

/* Returns the middle of instant i of n of equal weight, q16 of the exposure. */
int32_t smear_shutter_instant(const struct smear_shutter_times *shutter, int32_t i, int32_t n);

/* Whether all samples have one length. */
bool smear_shutter_is_box(const struct smear_shutter_times *shutter);

#endif
