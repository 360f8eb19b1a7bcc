/* SPDX-License-Identifier: MIT */
/* draws.h - from submitted draws to the lists of triangles that tile rows are drawn from. */
#ifndef SMEAR_DRAWS_H
#define SMEAR_DRAWS_H

#include "context.h"
#include "display/points.h"

/* Finds out whether anything of the frame moves along a curve; then all past poses become those at times of the exposure.
 * Before all others. */
void smear_draws_find_curves(struct smear_context *c);

/* Looks at all draws of the frame: what moves, what is blended, whose velocity comes from where. */
void smear_draws_prepare(struct smear_context *c);

/* Finds where points are seen in a part of the exposure, from -65536 at shutter open to 65536 at close. */
void smear_draws_place_points(struct smear_context *c, int32_t from, int32_t to);

static inline void draws_place_points(struct smear_context *c, int32_t from, int32_t to)
{
    if (rows_have_points(&c->rows))
        smear_draws_place_points(c, from, to);
}

/* Finds which draws are blurred as layers, and how they move. */
void smear_draws_find_layers(struct smear_context *c, const struct smear_instant *middle);

/* Find out which of what is kept is not what the frame wants: of a temporal method, and of sharp frames alone. */
#if SMEAR_WITH_DAMAGE
void smear_draws_find_damage(struct smear_context *c);
void smear_draws_find_changes(struct smear_context *c);

/* Before and after all of that: a method that knows nothing of what is shown forgets it. `result` of the frame's rows. */
void smear_draws_begin_damage(struct smear_context *c);
void smear_draws_end_damage(struct smear_context *c, int result);
#else
#define smear_draws_find_damage(c) ((void)0)
#define smear_draws_find_changes(c) ((void)0)
#define smear_draws_begin_damage(c) ((void)0)
#define smear_draws_end_damage(c, result) ((void)0)
#endif

/* Assembles as many tile rows of [first, end) as find room, at an instant; returns their end. Rows from `top` on, above
 * `first`, are included for what is finished a row late. When a single row is too much, rows.refill is `refill`, by which
 * the method draws it from several fills of the store. */
int smear_draws_assemble(struct smear_context *c, int top, int first, int end, const struct smear_instant *instant,
                         struct smear_refill *refill);

#endif
