/* SPDX-License-Identifier: MIT */
/* subframe_sums.c - see subframe_tile.h. */
#include "kernels/light_sums.h"
#include "temporal/subframe_tile.h"

/* A gap's mean is taken up to GAP_PAIRS_MAX pixels beyond what was drawn, and reads as far beyond that. */
static struct subframe_box read_box(const struct subframes *f)
{
    const struct smear_raster_target *s = &f->t->background;
    const int32_t reach = 2 * GAP_PAIRS_MAX;
    return (struct subframe_box){ max_i32(f->area.x0 - reach, s->x0), max_i32(f->area.y0 - reach, s->y0),
                                  min_i32(f->area.x1 + reach, s->x1), min_i32(f->area.y1 + reach, s->y1) };
}

SMEAR_NOINLINE void smear_subframe_sums_clear(const struct subframes *f)
{
    const struct subframe_box b = read_box(f);
    for (int32_t y = b.y0; y < b.y1; y++)
        packed_sums_clear(&f->sums, work_row(f, &b, y), b.x1 - b.x0);
}

/* Vectors take whole rounds: beside a box is nothing. */
static struct subframe_box whole_rounds(const struct subframes *f, const struct subframe_box *box)
{
    enum { ROUND = 8 };
    const struct smear_raster_target *s = &f->t->background;
    struct subframe_box b = *box;
    if (SMEAR_VECTORS && !f->blends) {
        b.x0 -= (b.x0 - s->x0) & (ROUND - 1);
        b.x1 = min_i32(b.x1 + ((s->x0 - b.x1) & (ROUND - 1)), s->x1);
    }
    return b;
}

void smear_subframe_sums_add(const struct subframes *f, const struct subframe_box *box, uint32_t k)
{
    const struct smear_raster_target *s = &f->t->background;
    const struct subframe_box bounds = whole_rounds(f, box), *b = &bounds;
    const int32_t n = b->x1 - b->x0;
    struct light_instant light;
    if (sums_light(f))
        light = smear_light_instant(k, f->instants, frame_transfer(f->t->frame));
    for (int32_t y = b->y0; y < b->y1; y++) {
        const uint32_t *background = f->blends ? s->color + target_row(&s->color_rows, s, y) + b->x0 : NULL;
        const int32_t at = work_row(f, b, y);
        uint32_t *color = f->work.color + at;
        const struct packed_sums sums = packed_sums_from(f->sums, at);
        if (sums_light(f))
            smear_light_add(color, background, sums, n, &light);
        else
            smear_packed_add(color, background, sums, n);
    }
}

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

void smear_tile_run_take_background(const struct smear_tile_run *t, uint32_t *color, bool nothing)
{
    const struct smear_raster_target *s = &t->background;
    const size_t bytes = (size_t)(s->x1 - s->x0) * sizeof *s->color;
    for (int32_t y = s->y0; y < s->y1; y++, color += t->pitch)
        if (nothing)
            __builtin_memset(color, (int)(PACKED_NOTHING & 255u), bytes);
        else
            __builtin_memcpy(color, s->color + target_row(&s->color_rows, s, y) + s->x0, bytes);
}

void smear_subframe_lay_over(const struct subframes *f)
{
    const struct smear_raster_target *s = &f->t->background;
    uint32_t *color = f->work.color;
    for (int32_t y = s->y0; y < s->y1; y++, color += f->t->pitch) {
        const uint32_t *behind = s->color + target_row(&s->color_rows, s, y) + s->x0;
        for (int32_t x = 0; x < s->x1 - s->x0; x++)
            if (color[x] == PACKED_NOTHING)
                color[x] = behind[x];
    }
}

struct depth_range smear_subframe_depths(const struct subframes *f, const struct subframe_box *b, int32_t margin)
{
    const struct smear_raster_target *s = &f->t->background;
    const struct subframe_box near = { max_i32(b->x0 - margin, s->x0), max_i32(b->y0 - margin, s->y0),
                                       min_i32(b->x1 + margin, s->x1), min_i32(b->y1 + margin, s->y1) };
    return depth_range(f->work.depth + work_row(f, &near, near.y0), f->t->pitch, near.x1 - near.x0, near.y1 - near.y0);
}
