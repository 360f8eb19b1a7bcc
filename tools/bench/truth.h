/* SPDX-License-Identifier: MIT */
/* truth.h - pictures of many exact instants, kept on disk. */
#ifndef SMEAR_BENCH_TRUTH_H
#define SMEAR_BENCH_TRUTH_H

#include "tools/failure.h"
#include "tools/bench/take.h"
#include "tools/image/image.h"

#include <stdbool.h>

enum { TRUTH_INSTANTS = 1024 };

/* What blur alone is measured against: TRUTH_INSTANTS sharp frames of the library itself,
 * each posed and lit exactly, as `smear render --method accumulate --exact` draws them, of the scene,
 * frame and light of a take. The name changes when what the library draws does. */
bool truth_of_take(const struct take *take, const char *folder, struct float_image *out, struct failure *f);

/* Rounded to codes: what the command line writes. *out is allocated here. */
bool truth_round(const struct float_image *truth, struct image *out, struct failure *f);

/* Root mean square error of a picture in codes. */
double truth_rmse(const struct float_image *truth, const struct image *picture);

#endif
