/* SPDX-License-Identifier: MIT */
/* exr.h - frames as OpenEXR files, for looking at them in other programs and for frames that come
 * from them.
 *
 * One part of scan lines, zip compression, 32-bit float channels R, G, B (linear light), Z
 * (distance), velocity.X and velocity.Y (px per frame, x right, y down). Needs OpenEXRCore; nothing
 * but tests uses it. */
#ifndef SMEAR_TESTS_EXR_H
#define SMEAR_TESTS_EXR_H

#include "tools/failure.h"

#include <stdbool.h>

enum exr_plane { EXR_R, EXR_G, EXR_B, EXR_Z, EXR_VELOCITY_X, EXR_VELOCITY_Y, EXR_PLANES };

struct exr_frame {
    int width, height;
    float *plane[EXR_PLANES];   /* width x height each, top row first; malloc'ed */
};

/* All zeros. */
bool exr_frame_alloc(struct exr_frame *frame, int width, int height, struct failure *f);
void exr_frame_free(struct exr_frame *frame);

/* Writes beside `path` and renames, so that no partial file is seen. Every bit of every float is
 * kept. */
bool exr_save(const char *path, const struct exr_frame *frame, struct failure *f);

/* Reads the six channels, whatever others there are; fails when one is missing or not a 32-bit
 * float, when the first part is not of scan lines, and when the header claims more than the file
 * can hold. `out` is empty on failure. */
bool exr_load(const char *path, struct exr_frame *out, struct failure *f);

#endif
