/* SPDX-License-Identifier: MIT */
/* night.h - a scene of built-in models for small displays of few greys. */
#ifndef SMEAR_TOOLS_DEMO_NIGHT_H
#define SMEAR_TOOLS_DEMO_NIGHT_H

#include "tools/failure.h"
#include "tools/scenes/scene.h"

enum { NIGHT_LOOP_FRAMES = 48 };

bool night_open(struct scene *out, struct failure *f);

#endif
