/* SPDX-License-Identifier: MIT */
/* shadow.h - what the draws of a scene cast on the ground, as further draws behind them. Host only. */
#ifndef SMEAR_TOOLS_SCENES_SHADOW_H
#define SMEAR_TOOLS_SCENES_SHADOW_H

#include "tools/scenes/scene.h"

/* Surfaces of shadows: one for each surface of a scene, or a round one for all of them. */
struct shadow {
    struct scene_shadow wish;
    double ground;                      /* height of the plane */
    struct scene_surface *surface;
};

/* Makes shadows of `count` surfaces, which outlive them. The sun has to stand above the ground. */
bool shadow_open(struct shadow *shadow, const struct scene_shadow *wish, double ground, const struct scene_surface *surface, int count,
                 struct failure *f);
void shadow_close(struct shadow *shadow);

/* How many draws are cast by `count` of them, however they lie. */
int shadow_draws(const struct shadow *shadow, int count);

/* Adds them to an instant whose draws have `first` as the first of all surfaces; its list has room. */
void shadow_cast(const struct shadow *shadow, const struct scene_surface *first, struct scene_instant *instant);

#endif
