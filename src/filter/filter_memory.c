/* SPDX-License-Identifier: MIT */
/* filter_memory.c - what filters need of a context's memory, and what a frame says of them. */
#include "context.h"
#include "filter/filtered.h"
#include "filter/probe.h"
#include "base/compiled.h"
#include "others.h"
#include "smear_memory.h"
#include "validate.h"

#if SMEAR_WITH_RECONSTRUCT

SMEAR_STATIC_ASSERT(sizeof(struct smear_filtered) <= SMEAR_FILTERING_BYTES, "SMEAR_FILTERING_BYTES");

/* Velocities of `pixels` pixels, in as many bits as the reach takes. */
void smear_velocity_lay_out(int8_t **velocity8, int16_t **velocity16, struct smear_arena *a, size_t pixels,
                            int32_t reach)
{
    *velocity8 = reach <= 15 ? arena_take(a, pixels, 2) : NULL;
    *velocity16 = reach <= 15 ? NULL : arena_take(a, pixels, 4);
}

static void lay_out_motion(struct smear_window *w, struct smear_arena *a)
{
    const size_t tiles = (size_t)w->columns * (size_t)(2 * w->lag + 1);
    w->motion = arena_take(a, tiles, sizeof *w->motion);
    w->around = arena_take(a, tiles, sizeof *w->around);
}

/* A window of half the size of `full`. */
static void lay_out_half(struct smear_window *w, struct smear_arena *a, const struct smear_window *full)
{
    *w = (struct smear_window){ .width = (full->width + 1) / 2, .height = (full->height + 1) / 2,
                                .tile = full->tile / 2, .tile_shift = full->tile_shift - 1,
                                .reach = (full->reach + 1) / 2, .columns = full->columns,
                                .rows = full->rows, .lag = 1 };
    w->ring = 2 * w->tile + w->reach;
    w->color = arena_take(a, window_plane(w), 4);
    w->depth = arena_take(a, window_plane(w), 2);
    smear_velocity_lay_out(&w->velocity8, &w->velocity16, a, window_plane(w), w->reach);
    lay_out_motion(w, a);
}

void smear_filtered_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_window spare, *w = &c->rows.window;
    struct smear_filtered measured, *f = arena_take(a, 1, sizeof *f);
    c->filtered = f;
    if (f == NULL)          /* only measured */
        f = &measured;
    *f = (struct smear_filtered){ 0 };
    smear_velocity_lay_out(&w->velocity8, &w->velocity16, a, window_plane(w), d->reach);
    lay_out_motion(w, a);
    f->row_offset = arena_take(a, (size_t)(d->tile + 2 * d->reach), sizeof *f->row_offset);
    for (int i = 0; SMEAR_WITH_FILTERS && i + 1 < d->filter.passes; i++)
        f->pass_plane[i] = arena_take(a, window_plane(w), 4);
    if (SMEAR_WITH_DEBUG && d->debug.inspect != NULL)
        c->rows.inspect = arena_take(a, window_plane(w), 8);
    if (!has_half(d))
        return;
    f->half = arena_take(a, 1, sizeof *f->half);
    lay_out_half(f->half != NULL ? f->half : &spare, a, w);
    f->half_scratch = arena_take(a, (size_t)d->workers * (size_t)(d->tile / 2) * (size_t)(d->tile / 2), 4);
}

int smear_filter_resolve(smear_frame *f, const smear_desc *d)
{
    smear_filter *filter = &f->filter;
    smear_pingpong *p = &filter->pingpong;
    if (!SMEAR_FILTER_KINDS) {      /* nor the means, nor velocities from depth */
        filter->kind = SMEAR_FILTER_RECONSTRUCT;
        filter->flags |= SMEAR_PUBLISHED;
        return SMEAR_OK;
    }
    if (filter->camera_step == 0 && (f->method == SMEAR_CAMERA || (f->method == SMEAR_RECONSTRUCT && !(filter->flags & SMEAR_PUBLISHED))))
        filter->camera_step = 4;
    if (filter->camera_step == 3)
        return FAULT(FRAME_STEP);
    if (f->method == SMEAR_RECONSTRUCT || (f->method == SMEAR_HALF && filter->kind == SMEAR_FILTER_DEFAULT))
        filter->kind = SMEAR_FILTER_RECONSTRUCT;
    else if (f->method == SMEAR_PINGPONG)
        filter->kind = SMEAR_FILTER_PINGPONG;
    else if (filter->kind == SMEAR_FILTER_DEFAULT)
        filter->kind = SMEAR_FILTER_MEAN;
    if (p->base == 0)
        p->base = p->taps;
    if (p->bias == 0)
        p->bias = p->spread ? 16 : 255;     /* what is nearest to the truth over the suite */
    if (p->base < 2)
        return FAULT(FRAME_BASE);
    if (!smear_method_is_filter(f->method) || filter->kind != SMEAR_FILTER_PINGPONG)
        return SMEAR_OK;
    if (!wants(d, SMEAR_SET(SMEAR_PINGPONG)))
        return FAULT(FRAME_KIND);
    return p->passes > d->filter.passes ? FAULT(FRAME_PASSES) : SMEAR_OK;
}

#endif

struct smear_probe smear_probe(const smear_context *c)
{
    return (struct smear_probe){ &c->rows, c->filtered, &c->temporal, c->frame.method, c->frame.samples, c->shot.half_exposure,
                                 c->direct };
}
