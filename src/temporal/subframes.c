/* SPDX-License-Identifier: MIT */
/* subframes.c - the moving triangles of some tiles drawn again at several instants.
 *
 * Where no moving triangle is at an instant, a tile looks as it does without moving triangles: that picture, the
 * background (what does not move, with its blended draws), is made once and weighs for all instants that show nothing
 * else. At each instant only the box around the moving triangles is drawn, summed and emptied again: before nothing, as
 * what moves may have the colours of the background. What is blended is drawn over the background. Few instants of which no gaps are
 * closed are drawn over the background, each apart, and mixed.
 *
 *     list        what may be seen in the tiles
 *     for each instant:
 *         draw    moving triangles, and what is blended over them (subframe_pose.c)
 *         add     their pixels to the sums (subframe_sums.c)
 *     average     sums over the gap between instants, and means over the background (subframe_gap.c); one alone is laid over it */
#include "temporal/subframes.h"

#include "display/row.h"
#include "geometry/path.h"
#include "kernels/line_means.h"
#include "raster/raster.h"
#include "temporal/subframe_tile.h"
#include "temporal/tile_method.h"

enum { SUM_WORDS = 2,           /* of a packed sum, or planes of instants */
       MIXED = 2 + SUM_WORDS };     /* instants at most */

size_t smear_subframes_work(int32_t width, int32_t height)
{
    return (size_t)(width * height) * (SUM_WORDS * sizeof(uint32_t) + sizeof(uint16_t));
}

/* ------------------------------------------------------------------ lists of the tile */

/* The triangle may touch the tile at some time. */
static bool touches(const struct subframes *f, uint32_t triangle)
{
    const struct smear_bins *g = f->t->frame->bins;
    const struct smear_raster_target *tile = &f->t->background;
    if (!g->segment[bins_triangle(g, triangle)->segment].path) {
        struct posed p;
        return smear_subframe_pose(&p, f, triangle, 0);
    }
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    return b->x0 < tile->x1 && b->x1 > tile->x0 && b->y0 < tile->y1 && b->y1 > tile->y0;
}

static void note(struct subframes *f, const struct smear_moving_triangle *m)
{
    const struct smear_path_bounds *b = bins_bounds(f->t->frame->bins, m->triangle);
    f->moving_seen++;
    f->nearest = max_u32(f->nearest, m->nearest);
    const struct subframe_box path = { b->x0, b->y0, b->x1, b->y1 };
    box_add(&f->area, &path);
    if (f->plans)
        smear_note_passing(f, m->triangle, false);
}

static void note_blended(struct subframes *f, uint32_t triangle, bool *moves)
{
    const struct smear_bins *g = f->t->frame->bins;
    const bool has_path = g->segment[bins_triangle(g, triangle)->segment].path;
    f->blends = true;
    *moves = *moves || has_path;
    if (f->plans && has_path)
        smear_note_passing(f, triangle, true);
}

/* ------------------------------------------------------------------ several fills */

/* Begins to go through triangles of the tiles, or goes on. */
static bool fill(struct subframes *f, int kinds, bool next)
{
    if (f->refilled == NULL)
        return !next;
    f->space->segment = NULL;           /* segments are others then */
    return f->refilled->fill(f->refilled, kinds, next);
}

/* ------------------------------------------------------------------ instants */

static void draw_moving_triangle(const struct subframes *f, struct smear_raster_pass *pass, uint32_t triangle, int32_t time,
                                 struct subframe_box *all)
{
    struct posed p;
    for (bool seen = smear_subframe_pose(&p, f, triangle, time); seen; seen = smear_subframe_pose_next(&p, f)) {
        smear_raster_triangle(pass, p.segment, p.color, p.v, &p.bounds);
        box_add(all, &p.box);
    }
}

/* Draws those that are there. What it keeps is gone before others are found: stack. */
static SMEAR_NOINLINE void draw_those(const struct subframes *f, int32_t time, struct subframe_box *all)
{
    struct smear_raster_pass pass;
    smear_raster_begin(&pass, f->t->frame, &f->work);
    for (uint32_t i = 0; i < f->t->moving_count; i++)
        if (subframes_see(f, &f->t->moving[i]))
            draw_moving_triangle(f, &pass, f->t->moving[i].triangle, time, all);
}

static void draw_moving(struct subframes *f, int32_t time, struct subframe_box *all)
{
    for (bool any = fill(f, FILL_MOVING, false); any; any = fill(f, FILL_MOVING, true))
        draw_those(f, time, all);
}

enum blend_step {
    BLEND_BOX,          /* finds where moving triangles are */
    BLEND_ALL,          /* draws all */
    BLEND_BACKGROUND    /* draws those that do not move */
};

static void blend_one(const struct subframes *f, struct smear_raster_pass *pass, uint32_t triangle, int32_t time,
                      enum blend_step step, struct subframe_box *all)
{
    const struct smear_bins *g = f->t->frame->bins;
    bool moves = g->segment[bins_triangle(g, triangle)->segment].path;
    struct posed p;
    if ((step == BLEND_BOX && !moves) || (step == BLEND_BACKGROUND && moves) || (moves && !touches(f, triangle)))
        return;
    for (bool seen = smear_subframe_pose(&p, f, triangle, time); seen; seen = smear_subframe_pose_next(&p, f))
        if (step == BLEND_BOX)
            box_add(all, &p.box);
        else
            smear_raster_triangle(pass, p.segment, p.color, p.v, &p.bounds);
}

/* Blends those that are there, likewise. */
static SMEAR_NOINLINE void blend_those(struct subframes *f, int32_t time, enum blend_step step, const struct smear_raster_target *target,
                                       struct subframe_box *all)
{
    struct smear_raster_pass pass;
    if (step != BLEND_BOX)
        smear_raster_begin(&pass, f->t->frame, target);
    for (uint32_t i = f->t->blend; i != SMEAR_NO_TRIANGLE; i = bins_triangle(f->t->frame->bins, i)->next)
        blend_one(f, &pass, i, time, step, all);
}

static SMEAR_RARE void blend(struct subframes *f, int32_t time, enum blend_step step, const struct smear_raster_target *target,
                             struct subframe_box *all)
{
    for (bool any = fill(f, FILL_BLENDED, false); any; any = fill(f, FILL_BLENDED, true))
        blend_those(f, time, step, target, all);
}

/* The work planes within a box. */
static struct smear_raster_target within(const struct subframes *f, const struct subframe_box *b)
{
    struct smear_raster_target t = f->work;
    t.color_rows.ring_row = t.window_rows.ring_row = b->y0 - t.y0;
    t.x0 = b->x0;
    t.y0 = b->y0;
    t.x1 = b->x1;
    t.y1 = b->y1;
    return t;
}

/* Draws what is blended over everything that moves, which is there; adds where. */
static SMEAR_RARE void blend_instant(struct subframes *f, int32_t time, struct subframe_box *all)
{
    blend(f, time, BLEND_BOX, NULL, all);
    if (!subframe_box_is_empty(all)) {
        struct smear_raster_target target = within(f, all);
        blend(f, time, BLEND_ALL, &target, NULL);
    }
}

/* Draws everything that moves, and what is blended over it; returns where. */
static struct subframe_box draw_instant(struct subframes *f, int32_t time)
{
    struct subframe_box all = no_box;
    draw_moving(f, time, &all);
    if (f->blends)
        blend_instant(f, time, &all);
    return all;
}

/* Finds what may be seen, fill by fill; true when something moves. */
static SMEAR_NOINLINE bool list(struct subframes *f)
{
    const struct smear_tile_run *t = f->t;
    const struct smear_bins *g = t->frame->bins;
    const struct subframe_box whole = { t->background.x0, t->background.y0, t->background.x1, t->background.y1 };
    const struct depth_range depths = f->closes && !t->is_bare ? smear_subframe_depths(f, &whole, 0) : (struct depth_range){ 0, 0 };
    bool moves = false;
    f->lowest = depths.least;
    f->highest = depths.most;
    do {
        for (uint32_t i = 0; i < t->moving_count; i++)
            if (subframes_see(f, &t->moving[i]))
                note(f, &t->moving[i]);
        for (uint32_t i = t->blend; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next)
            if (touches(f, i))
                note_blended(f, i, &moves);
        f->fills++;
    } while (fill(f, FILL_MOVING | FILL_BLENDED, true));
    if (f->blends) {
        f->nearest = UINT16_MAX;
        f->area = whole;
    }
    return moves || f->moving_seen != 0;
}

/* Adds the box of instant k to the sums and empties it. `samples`: taken before. Returns how many it
 * has. */
static uint32_t add_instant(const struct subframes *f, const struct subframe_box *box, int32_t k, uint32_t samples,
                            struct subframe_box *all)
{
    if (subframe_box_is_empty(box))
        return 0;
    if (samples == 0)
        smear_subframe_sums_clear(f);
    smear_subframe_sums_add(f, box, (uint32_t)k);
    smear_subframe_restore_depth(f, box);
    box_add(all, box);
    return (uint32_t)pixels_in(box);
}

/* Returns the least number from `part` of n, in 1/256, on that shares no divisor with n. */
static int32_t coprime(int32_t n, int32_t part)
{
    for (int32_t g = max_i32((n * part + 128) >> 8, 1);; g++) {
        int32_t a = g, b = n;
        while (b != 0) {
            const int32_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1)
            return g;
    }
}

/* Returns the place of instant k of n within the pixel along an axis, q8 px from its centre: each of n even steps once, those
 * before and after the middle opposite each other, `g` steps from one instant to the next. */
static int32_t shift_of(int32_t k, int32_t n, int32_t g)
{
    const int32_t steps = (2 * k + 1 - n) * g % (2 * n);       /* halves */
    return (steps >= n ? steps - 2 * n : steps < -n ? steps + 2 * n : steps) * 128 / n;
}

static bool has_shifts(const struct subframes *f) { return SMEAR_EDGES && bins_margin(f->t->frame->bins) != 0; }

/* Draws and sums all instants after `samples` have been taken, but those that have been: the middle one of every `drawn`; 0: none.
 * Returns how many samples have been taken then. */
static uint32_t draw_others(struct subframes *f, int32_t drawn, uint32_t samples, struct subframe_box *all)
{
    const bool smooths = has_shifts(f);
    const int32_t instants = (int32_t)f->instants;
    const int32_t step[2] = { smooths ? coprime(instants, 70) : 0, smooths ? coprime(instants, 98) : 0 };
    for (int32_t k = 0; k < instants; k++) {
        if (drawn != 0 && k % drawn == drawn / 2)
            continue;
        if (smooths) {
            f->shift[VERTEX_X] = shift_of(k, instants, step[VERTEX_X]);
            f->shift[VERTEX_Y] = shift_of(k, instants, step[VERTEX_Y]);
        }
        const struct subframe_box box = draw_instant(f, smear_shutter_instant(f->t->shutter, k, instants));
        if (f->changes != NULL)
            smear_note_changes(f, k == 0);
        samples += add_instant(f, &box, k, samples, all);
    }
    return samples;
}

/* Does so for tiles whose triangles come in several fills, and are not blended: by columns of pixels of which the store has all at
 * once, so that it is not filled again for each instant. Where it has not all of the narrowest it is, for ever more of what is left
 * of the tiles. */
static SMEAR_RARE uint32_t draw_others_apart(struct subframes *f, int32_t drawn, uint32_t samples, struct subframe_box *all)
{
    enum { COLUMN = 8 };        /* what rounds of vectors take */
    struct smear_tile_run *const run = f->refilled;
    const int32_t x0 = f->work.x0, x1 = f->work.x1, fill_x0 = run->fill_x0, fill_x1 = run->fill_x1;
    int32_t width = (x1 - x0) / f->fills & -COLUMN, refilled = width < COLUMN ? x1 - x0 : COLUMN;
    for (run->fill_x1 = x0; run->fill_x1 < x1;) {
        bool at_once = false;
        run->fill_x0 = run->fill_x1;
        for (; !at_once && width >= COLUMN; width = at_once ? width : width / 2 & -COLUMN) {
            run->fill_x1 = min_i32(run->fill_x0 + width, x1);
            at_once = fill(f, FILL_MOVING, false) && !fill(f, FILL_MOVING, true);
        }
        if (!at_once) {
            run->fill_x1 = min_i32(run->fill_x0 + refilled, x1);
            refilled *= 2;
            width = COLUMN;
        }
        f->work.x0 = run->fill_x0;
        f->work.x1 = run->fill_x1;
        f->refilled = at_once ? NULL : run;
        samples = draw_others(f, drawn, samples, all);
        f->refilled = run;
        f->work.x0 = x0;
        f->work.x1 = x1;
    }
    run->fill_x0 = fill_x0;
    run->fill_x1 = fill_x1;
    return samples;
}

static uint32_t draw_rest(struct subframes *f, int32_t drawn, uint32_t samples, struct subframe_box *all)
{
    return f->refilled != NULL && !f->blends ? draw_others_apart(f, drawn, samples, all) : draw_others(f, drawn, samples, all);
}

/* Draws few instants over what stands still, each in a plane of its own, and mixes them as pictures are: the last two of three or four at
 * once. */
static uint32_t mix_instants(struct subframes *f, const struct subframe_box *whole)
{
    const int32_t n = (int32_t)f->instants, pixels = f->t->pitch * (whole->y1 - whole->y0);
    uint32_t *const plane = (uint32_t *)f->t->work, samples = 0;
    struct subframe_box all = no_box;
    for (int32_t k = 0; k < n; k++) {
        f->work.color = k == 0 ? f->t->out : plane + (k > 1 && k + 1 == n ? pixels : 0);
        smear_tile_run_take_background(f->t, f->work.color, false);
        const struct subframe_box box = draw_instant(f, smear_shutter_instant(f->t->shutter, k, n));
        box_add(&all, &box);
        const int32_t drawn = pixels_in(&box);
        samples += (uint32_t)drawn;
        if (drawn != 0 && k + 1 != n)
            smear_subframe_restore_depth(f, &box);
        for (int32_t y = all.y0; k > 0 && (n - k) % 2 != 0 && y < all.y1; y++) {
            const int32_t at = work_row(f, &all, y);
            smear_line_mix(f->t->out + at, plane + at, plane + pixels + at, all.x1 - all.x0, k, frame_transfer(f->t->frame));
        }
    }
    return samples;
}

/* Draws and sums as many instants as the plan says, the middle one first. Where something passes the eye they show
 * what the middle does not: what changes from one to the next is planned for, too. Up to half as many more are done without. */
static uint32_t draw_planned(struct subframes *f, const struct smear_tile_plan *plan, struct subframe_box *all)
{
    enum { LOOKS = 5 };         /* at least, where something passes */
    const struct subframe_box middle = draw_instant(f, smear_shutter_instant(f->t->shutter, 0, 1));
    struct subframe_changes changes = { .sum = 0 };
    struct smear_contrast contrast;
    smear_tile_contrast(&contrast, f, plan, &middle);
    const int32_t planned = smear_tile_plan_instants(plan, f->t, &contrast, 1);
    const int32_t first = f->passing.in_space ? max_i32(planned, LOOKS) : planned;
    f->instants = (uint32_t)first;
    f->changes = f->passing.in_space ? &changes : NULL;
    if (first == 1 && contrast.last == 0 && !f->blends) {
        f->instants = 0;                            /* there is nothing to be averaged */
        return (uint32_t)pixels_in(&middle);
    }
    const uint32_t passing = f->space->seen;        /* draws that are somewhen in the tiles */
    f->space->seen = 0;
    const uint32_t samples = draw_rest(f, first, add_instant(f, &middle, first / 2, 0, all), all);
    if (f->changes == NULL)
        return samples;
    f->changes = NULL;
    smear_add_changes(&contrast, f, &changes);
    int32_t wanted = smear_tile_plan_instants(plan, f->t, &contrast, first);
    if (first == LOOKS && (wanted > first || (passing & ~f->space->seen) != 0))      /* so few see little of it */
        wanted = max_i32(wanted, 3 * first);
    if (2 * wanted <= 3 * first)
        return samples;
    const bool adds = wanted == 3 * first && !sums_light(f) && !has_shifts(f) && wanted <= PACKED_INSTANTS_MAX;
    f->instants = (uint32_t)wanted;
    return adds ? draw_rest(f, 3, samples, all) : draw_rest(f, 0, 0, all);
}

static inline void make(struct subframes *f, struct smear_space *space, const struct smear_tile_run *t, int32_t instants)
{
    const struct smear_raster_target *s = &t->background;
    const int32_t pixels = t->pitch * (s->y1 - s->y0);
    *f = (struct subframes){
        .t = t, .instants = (uint32_t)instants, .space = space, .area = no_box
    };
    space->segment = NULL;
    space->seen = 0;
    f->sums = packed_sums_in((uint32_t *)t->work, pixels);
    f->work = *s;
    f->work.velocity8 = NULL;
    f->work.velocity16 = NULL;
    f->work.inspect = NULL;
    f->work.moving = NULL;
    f->work.color = t->out;
    f->work.depth = (uint16_t *)(void *)((uint32_t *)t->work + SUM_WORDS * pixels);
    f->work.color_rows = f->work.window_rows = (struct smear_plane_rows){ t->pitch, 0, s->y1 - s->y0, s->x0 };
}

uint32_t smear_subframes_tiles(struct smear_tile_run *t, int32_t instants, const struct smear_tile_plan *plan)
{
    struct subframes f;
    struct smear_space space;
    struct subframe_box all = no_box;
    make(&f, &space, t, instants);
    const struct subframe_box whole = { f.work.x0, f.work.y0, f.work.x1, f.work.y1 };
    f.closes = plan != NULL;
    f.plans = f.closes && plan->chooser != NULL;
    if (t->fill != NULL)
        f.refilled = t;
    smear_subframe_restore_depth(&f, &whole);
    uint32_t samples = 0;
    const bool moves = list(&f);
    if (moves && t->mixes && !f.blends && !has_shifts(&f) && instants <= MIXED)
        return mix_instants(&f, &whole);
    smear_tile_run_take_background(t, t->out, !f.blends);
    if (moves)
        samples = f.plans ? draw_planned(&f, plan, &all) : draw_rest(&f, 0, 0, &all);
    if (f.blends)
        blend(&f, 0, BLEND_BACKGROUND, &f.work, NULL);
    else if (f.instants == 0)
        smear_subframe_lay_over(&f);
    else
        smear_tile_run_take_background(t, t->out, false);
    if (samples != 0 && f.instants != 0)
        smear_subframe_average(&f, &all, plan);
    return samples;
}

#if SMEAR_WITH_OVERLAY
uint16_t *smear_subframes_depth(const struct smear_tile_run *t, int32_t x0, int32_t x1)
{
    struct smear_tile_run part = *t;
    struct subframes f;
    struct smear_space space;
    struct subframe_box all = no_box;
    make(&f, &space, t, 1);
    const struct subframe_box box = { max_i32(x0 & ~15, f.work.x0), f.work.y0, min_i32((x1 + 15) & ~15, f.work.x1), f.work.y1 };
    f.work.color = (uint32_t *)t->work;       /* of no use to anybody */
    smear_subframe_restore_depth(&f, &box);
    f.work = within(&f, &box);
    part.background.x0 = box.x0;
    part.background.x1 = box.x1;
    f.t = &part;
    f.refilled = t->fill != NULL ? &part : NULL;
    draw_moving(&f, smear_shutter_instant(t->shutter, 0, 1), &all);
    return f.work.depth;
}
#endif
