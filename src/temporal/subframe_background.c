/* SPDX-License-Identifier: MIT */
/* subframe_background.c - what does not move in some tiles, as it is copied into their work planes. */
#include "temporal/subframe_background.h"

void smear_subframe_restore_depth(const struct subframes *f, const struct subframe_box *b)
{
    const struct smear_raster_target *s = &f->t->background;
    struct subframe_box wide = *b;
    wide.x0 -= (wide.x0 - s->x0) & 1;
    wide.x1 = min_i32(wide.x1 + ((wide.x1 - s->x0) & 1), s->x1);
    for (int32_t y = wide.y0; y < wide.y1; y++)
        __builtin_memcpy(f->work.depth + work_row(f, &wide, y),
                         s->depth + target_row(&s->window_rows, s, y) + wide.x0,
                         (size_t)(wide.x1 - wide.x0) * sizeof *s->depth);
}

void smear_subframe_take_background(const struct subframes *f)
{
    const struct smear_raster_target *s = &f->t->background;
    const struct subframe_box all = { s->x0, s->y0, s->x1, s->y1 };
    for (int32_t y = s->y0; y < s->y1; y++)
        __builtin_memcpy(f->work.color + work_row(f, &all, y), s->color + target_row(&s->color_rows, s, y) + s->x0,
                         (size_t)(s->x1 - s->x0) * sizeof *s->color);
    smear_subframe_restore_depth(f, &all);
}

struct depth_range smear_subframe_depths(const struct subframes *f, const struct subframe_box *b, int32_t margin)
{
    const struct smear_raster_target *s = &f->t->background;
    const struct subframe_box near = { max_i32(b->x0 - margin, s->x0), max_i32(b->y0 - margin, s->y0),
                                       min_i32(b->x1 + margin, s->x1), min_i32(b->y1 + margin, s->y1) };
    return depth_range(f->work.depth + work_row(f, &near, near.y0), f->t->pitch, near.x1 - near.x0,
                       near.y1 - near.y0);
}
