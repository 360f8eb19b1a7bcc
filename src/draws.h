/* SPDX-License-Identifier: MIT */
/* draws.h - from submitted draws to the lists of triangles that tile rows are drawn from. */
#ifndef SMEAR_DRAWS_H
#define SMEAR_DRAWS_H

#include "context.h"
#include "display/points.h"
#include "others.h"

/* Whether the frame has blurred layers. */
static inline bool frame_has_layers(const struct smear_context *c) { return SMEAR_WITH_LAYERS && c->has_groups; }

/* Whether a draw belongs to a group of one. */
static inline bool draw_is_grouped(const struct smear_context *c, uint32_t i)
{
    return frame_has_layers(c) && c->group_of[i] != SMEAR_NO_GROUP;
}

/* Finds the poses of draw `i`. */
static inline void poses_of(struct smear_draw_poses *p, const struct smear_context *c, uint32_t i)
{
    smear_draw_poses_make(p, &c->shot, &c->submitted[i].draw, frame_has_layers(c) ? smear_layers_camera(c, i) : NULL);
}

/* Finds out whether anything of the frame moves along a curve; then all past poses become those at times of the exposure.
 * Before all others. */
void smear_draws_find_curves(struct smear_context *c);

/* Finds out which draws move, and how. */
void smear_draws_classify(struct smear_context *c);

/* Looks at all draws of the frame: what moves, what is blended, whose velocity comes from where. */
void smear_draws_prepare(struct smear_context *c);

/* Finds where points are seen in a part of the exposure, from -65536 at shutter open to 65536 at close. */
void smear_draws_place_points(struct smear_context *c, int32_t from, int32_t to);

/* Begins a part of the exposure: where anything was seen in another one is forgotten. */
static inline void draws_begin_exposure(struct smear_context *c, int32_t from, int32_t to)
{
    if (SMEAR_RANGES) {
        c->rows.bins.kept_words = c->part_rows = 0;
        c->row_is_full = false;
    }
    if (rows_have_points(&c->rows))
        smear_draws_place_points(c, from, to);
}

/* A draw is static in a frame of a temporal method. */
static inline bool draw_is_static(const struct smear_context *c, uint32_t i)
{
    return !c->raster_draw[i].moves && c->raster_draw[i].alpha < SMEAR_BLEND;
}

/* Which draws are assembled; in order: all of them, and static ones only where they must be drawn. */
enum draws { DRAWS_ALL, DRAWS_IN_ORDER, DRAWS_MOVING, DRAWS_STATIC };

static inline bool draw_is_of_kind(const struct smear_context *c, uint32_t i, enum draws kind)
{
    return (kind <= DRAWS_IN_ORDER || draw_is_static(c, i) == (kind == DRAWS_STATIC))
        && !(static_is_cached(c->damage) && draw_is_static(c, i));
}

static inline void note_fill(smear_fill *fill, uint32_t used, uint32_t room)
{
    fill->used = max_u32(fill->used, used);
    fill->room = room;
}

/* Makes everything the assembler needs of draw `i` at an instant. False where nothing of it is in view. */
bool smear_draws_make_assembly(const struct smear_context *c, uint32_t i, const struct smear_instant *instant,
                               struct smear_assembly *a);

/* Assembles a draw; that which is drawn over what lines have blurred into a list of its own. */
bool smear_draws_assemble_one(const struct smear_context *c, struct smear_assembler *as, struct smear_assembly *a);

/* Finds where triangles of all draws are seen at an instant, unless that is known or there is no room for it: the store turned out
 * to be too small. */
void smear_draws_find_ranges(struct smear_context *c, const struct smear_instant *instant);

/* Whether a draw must be drawn, of a frame of which the display shows a part: the tiles in which it was seen say so, where all that are
 * damaged are known. *seen is the box of the static draw before, or null. */
bool smear_draws_is_damaged(struct smear_context *c, uint32_t i, bool known, struct smear_tile_box **seen);

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
