/* SPDX-License-Identifier: MIT */
/* others.h - what the core asks of the methods of other systems. Their rooms lie above it, and it knows nothing else of them: each
 * call stands behind its room's switch, and a context keeps their state in structs that the core has no look into, null where the
 * desc has no such method. What rooms below are asked for stands there: `timemask/` by temporal/subframes.h, `smooth/` by
 * methods/temporal.h, `curves/` by geometry/shot.h and pose.h, `fog/` by raster/fog.h, `workers/` by base/jobs.h and methods/sharp.h,
 * `damage/` by draws.h, too, `screen/` by display/band.h, `overlay/` by display/points.h and damage.h, and rows of triangles for
 * velocities by raster/span.h. */
#ifndef SMEAR_OTHERS_H
#define SMEAR_OTHERS_H

#include "smear.h"

#include "base/base.h"

struct smear_assembly;
struct smear_context;
struct smear_instant;

/* Lay out what the method needs of a context's memory: layout.c. */
void smear_accumulate_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d);
void smear_filtered_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d);
void smear_damage_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d);
void smear_layers_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d);

/* Draw what was prepared and hand it to flush: frame.c. */
int smear_accumulate_render(struct smear_context *c);
int smear_filtered_render(struct smear_context *c);
int smear_layers_render(struct smear_context *c);

/* ------------------------------------------------------------------ workers/ */

/* Assembles all draws for the tile rows [first, end) in as many parts as there are workers, more than one. False where that does not pay,
 * or a part finds no room. */
bool smear_workers_assemble(struct smear_context *c, int first, int end, const struct smear_instant *instant);

/* ------------------------------------------------------------------ scene/ */

/* Returns SMEAR_OK or the number of what is wrong. */
int smear_scene_check(const smear_scene *scene);

/* ------------------------------------------------------------------ filter/ */

/* Fills in what zeros of frame.filter mean. Returns SMEAR_OK or what is wrong with it. */
int smear_filter_resolve(smear_frame *f, const smear_desc *d);

/* Begins a frame, of this method or another. `by_depth`: velocities may come from depth. */
void smear_filtered_begin(struct smear_context *c, bool by_depth);

/* ------------------------------------------------------------------ layers/ */

/* Copies the frame's layers, or makes the one it has without. */
void smear_layers_keep(struct smear_context *c, const smear_frame *f);

/* Tell whether a layer's own camera moves along a curve; and put its poses at the shutter in place of past ones. */
bool smear_layers_are_curved(struct smear_context *c);
void smear_layers_bend(struct smear_context *c);

/* Returns the three cameras of the layer of draw `i`, or null where it has none of its own. */
const smear_camera *smear_layers_camera(const struct smear_context *c, uint32_t i);

/* Gets the assembler ready for draw `i`; returns the instant at which it is assembled. */
const struct smear_instant *smear_layers_instant(struct smear_context *c, uint32_t i, const struct smear_instant *instant);

/* Assembles a draw of a group. Returns false where there is no room. */
bool smear_layers_assemble(struct smear_context *c, const struct smear_assembly *a);

#endif
