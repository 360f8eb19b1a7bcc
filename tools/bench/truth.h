/* SPDX-License-Identifier: MIT */
/* truth.h - what a blurred frame should look like: 256 exact instants of the exposure averaged by
 * the reference renderer. Drawn once, then kept as PFM. */
#ifndef SMEAR_BENCH_TRUTH_H
#define SMEAR_BENCH_TRUTH_H

#include "../failure.h"
#include "../image/image.h"

#include <stdbool.h>

enum { TRUTH_INSTANTS = 256 };

/* The frame that stands for a built-in scene at its own size, shutter 180 degrees and centred,
 * encoded light; values are code / 255, not rounded. Kept in `folder` under a name that changes
 * when the scene does. *out is allocated here. */
bool truth_of(const char *scene, const char *folder, struct float_image *out, struct failure *f);

/* Root mean square error of a picture in codes. */
double truth_rmse(const struct float_image *truth, const struct image *picture);

#endif
