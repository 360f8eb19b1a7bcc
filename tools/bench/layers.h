/* SPDX-License-Identifier: MIT */
/* layers.h - counts how often each pixel is drawn.
 *
 * A layer scene is a scene in which every triangle is black glass that lets four fifths of the
 * light through, on white, with nothing opaque: no triangle hides another, so a pixel's code tells
 * how many triangles covered it. Where neighbours share an edge, a pixel too dark was drawn twice
 * and one too light was missed. Glass takes the general path of the raster; that opaque triangles
 * cover the same pixels is for its unit tests to say. */
#ifndef SMEAR_BENCH_LAYERS_H
#define SMEAR_BENCH_LAYERS_H

#include "tools/failure.h"
#include "tools/scenes/scene.h"

/* `scene` must outlive `out`, which is freed with scene_free. */
bool layers_scene(struct scene *scene, struct scene *out, struct failure *f);

/* How many layers leave this code (0..255). Exact for up to LAYER_LIMIT layers, also of a renderer
 * that rounds each time; deeper ones count as LAYER_LIMIT + 1. */
enum { LAYER_LIMIT = 12 };
int layers_from_code(double code);

#endif
