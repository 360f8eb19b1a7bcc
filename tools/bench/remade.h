/* SPDX-License-Identifier: MIT */
/* remade.h - a scene as it is but for its surfaces: of glass, or without light. */
#ifndef SMEAR_BENCH_REMADE_H
#define SMEAR_BENCH_REMADE_H

#include "tools/failure.h"
#include "tools/scenes/scene.h"

/* Calls `remake` once for a copy of each surface that is seen. `scene` must outlive `out`, which is freed with scene_free. */
bool remade_scene(struct scene *scene, void (*remake)(struct scene_surface *surface), struct scene *out, struct failure *f);

#endif
