/* SPDX-License-Identifier: MIT */
/* timemask.c - a tile in blocks of pixels: each of its moving triangles is drawn in the middle of every time sample of the exposure, which
 * tells in which samples it is seen in a pixel, and in which colour in the mean; then the mean of all that is seen. */
#include "temporal/subframe_tile.h"

#include "raster/raster.h"
#include "timemask/timemask_samples.h"

enum { BLOCK_WIDTH = 16, BLOCK_HEIGHT = 8, BLOCK_PIXELS = BLOCK_WIDTH * BLOCK_HEIGHT };

/* What is seen of the triangle in work. */
struct course {
    uint64_t sum;               /* of its colours: three channels, 21 bits each */
    uint32_t mask;              /* samples */
    uint16_t first, last;       /* depth codes in the first of these samples and in the last */
};

/* A block of pixels; its planes have rows of BLOCK_WIDTH. */
struct timemask_block {
    struct course course[BLOCK_PIXELS];
    struct timemask_pixel pixel[BLOCK_PIXELS];
    uint32_t color[BLOCK_PIXELS];
    uint16_t depth[BLOCK_PIXELS];       /* of the background, but while a triangle is drawn */
};

struct job {
    struct subframes f;         /* what poses triangles: its work planes are those of the block */
    struct timemask_block *block;
    int32_t samples;
    smear_transfer transfer;
    uint32_t fragments;
};

size_t smear_timemask_work(void)
{
    return sizeof(struct timemask_block);
}

/* ------------------------------------------------------------------ triangles */

/* Returns the background's depths in row y of the frame, from the block's first column on. */
static const uint16_t *depths_behind(const struct job *j, int32_t y)
{
    const struct smear_raster_target *s = &j->f.t->background;
    return s->depth + target_row(&s->window_rows, s, y) + j->f.work.x0;
}

/* Returns a pixel's channels, as many bits of a sum apart as samples of light take. */
static inline uint64_t spread_channels(uint32_t pixel, smear_transfer transfer)
{
    return (uint64_t)value_of_code(pixel_red(pixel), transfer) << 42 | (uint64_t)value_of_code(pixel_green(pixel), transfer) << 21
         | value_of_code(pixel_blue(pixel), transfer);
}

/* Takes what was drawn in a box in sample k, and puts the background's depths back. */
static void take_sample(const struct job *j, const struct subframe_box *box, int32_t k)
{
    const struct smear_raster_target *w = &j->f.work;
    const smear_transfer transfer = j->transfer;
    for (int32_t y = box->y0; y < box->y1; y++) {
        const uint16_t *behind = depths_behind(j, y) - w->x0;
        struct timemask_block *row = j->block;
        for (int32_t x = box->x0, at = (y - w->y0) * BLOCK_WIDTH + x - w->x0; x < box->x1; x++, at++) {
            const uint16_t depth = row->depth[at];
            if (depth == behind[x])
                continue;
            struct course *c = &row->course[at];
            c->sum += spread_channels(row->color[at], transfer);
            c->first = c->mask == 0 ? depth : c->first;
            c->last = depth;
            c->mask |= 1u << k;
            row->depth[at] = behind[x];
        }
    }
}

/* Makes an entry of a course: the mean of its colours, and its depths on a line through the first and the last. A line that would leave
 * their range becomes one depth. */
static struct timemask_entry entry_of(const struct job *j, const struct course *c)
{
    const int32_t from = 31 - count_leading_zeros(c->mask & (0u - c->mask)), to = 31 - count_leading_zeros(c->mask);
    const int32_t change = c->last - c->first, between = max_i32(to - from, 1);
    const int32_t start = c->first - change * from / between, end = c->last + change * (j->samples - 1 - to) / between;
    const bool within = (start | end) >= 0 && max_i32(start, end) <= 65535;
    struct timemask_entry e = { c->mask, 0, (uint16_t)(within ? start : c->first), (uint16_t)(within ? end : c->first) };
    const uint32_t n = timemask_count(c->mask);
    for (int i = 0; i < 3; i++)
        e.color |= code_of_value(((uint32_t)(c->sum >> 21 * i & 0x1fffffu) + n / 2) / n, j->transfer) << 8 * i;
    return e;
}

/* Adds what was seen of a triangle to the pixels of a box, and forgets it. */
static void add_courses(struct job *j, const struct subframe_box *box)
{
    for (int32_t y = box->y0 - j->f.work.y0; y < box->y1 - j->f.work.y0; y++)
        for (int32_t x = box->x0 - j->f.work.x0; x < box->x1 - j->f.work.x0; x++) {
            struct course *c = &j->block->course[y * BLOCK_WIDTH + x];
            if (c->mask == 0)
                continue;
            smear_timemask_add(&j->block->pixel[y * BLOCK_WIDTH + x], entry_of(j, c), j->samples - 1, j->transfer);
            *c = (struct course){ 0, 0, 0, 0 };
            j->fragments++;
        }
}

static void draw_in_samples(struct job *j, struct smear_raster_pass *pass, uint32_t triangle)
{
    const struct smear_path_bounds *b = bins_bounds(j->f.t->frame->bins, triangle);
    const struct smear_raster_target *w = &j->f.work;
    struct subframe_box all = no_box;
    if (b->x0 >= w->x1 || b->x1 <= w->x0 || b->y0 >= w->y1 || b->y1 <= w->y0)
        return;
    for (int32_t k = 0; k < j->samples; k++) {
        struct posed p;
        const int32_t time = smear_shutter_instant(j->f.t->shutter, k, j->samples);
        for (bool seen = smear_subframe_pose(&p, &j->f, triangle, time); seen; seen = smear_subframe_pose_next(&p, &j->f)) {
            smear_raster_triangle(pass, p.segment, p.color, p.v, &p.bounds);
            take_sample(j, &p.box, k);
            box_add(&all, &p.box);
        }
    }
    if (!subframe_box_is_empty(&all))
        add_courses(j, &all);
}

/* ------------------------------------------------------------------ blocks */

static void begin_block(struct job *j)
{
    const struct smear_raster_target *w = &j->f.work;
    __builtin_memset(j->block, 0, sizeof *j->block);
    for (int32_t y = w->y0; y < w->y1; y++)
        __builtin_memcpy(w->depth + (y - w->y0) * BLOCK_WIDTH, depths_behind(j, y), (size_t)(w->x1 - w->x0) * sizeof *w->depth);
}

static void finish_block(const struct job *j)
{
    const struct smear_tile_run *t = j->f.t;
    const struct smear_raster_target *s = &t->background, *w = &j->f.work;
    const int log2 = 31 - count_leading_zeros((uint32_t)j->samples);
    for (int32_t y = w->y0; y < w->y1; y++) {
        const uint32_t *color = s->color + target_row(&s->color_rows, s, y);
        uint32_t *out = t->out + (y - s->y0) * t->pitch - s->x0;
        const struct timemask_pixel *p = j->block->pixel + (y - w->y0) * BLOCK_WIDTH;
        for (int32_t x = w->x0; x < w->x1; x++, p++)
            out[x] = p->count == 0 ? color[x] : smear_timemask_mean(p, color[x], log2, j->transfer);
    }
}

static void draw_block(struct job *j)
{
    const struct smear_tile_run *t = j->f.t;
    struct smear_raster_pass pass;
    begin_block(j);
    smear_raster_begin(&pass, t->frame, &j->f.work);
    for (uint32_t i = 0; i < t->moving_count; i++)
        if (moving_is_in(&t->moving[i], t))
            draw_in_samples(j, &pass, t->moving[i].triangle);
    finish_block(j);
}

uint32_t smear_timemask_tile(const struct smear_tile_run *t, int32_t samples)
{
    const struct smear_raster_target *s = &t->background;
    struct smear_space space = { .segment = NULL };
    struct job j = { .f = { .t = t, .space = &space }, .block = (struct timemask_block *)t->work, .samples = samples,
                     .transfer = frame_transfer(t->frame) };
    struct smear_raster_target *w = &j.f.work;
    *w = (struct smear_raster_target){ .color = j.block->color, .depth = j.block->depth, .tile_shift = s->tile_shift };
    for (w->y0 = s->y0; w->y0 < s->y1; w->y0 = w->y1)
        for (w->x0 = s->x0, w->y1 = min_i32(w->y0 + BLOCK_HEIGHT, s->y1); w->x0 < s->x1; w->x0 = w->x1) {
            w->x1 = min_i32(w->x0 + BLOCK_WIDTH, s->x1);
            w->color_rows = w->window_rows = (struct smear_plane_rows){ BLOCK_WIDTH, 0, BLOCK_HEIGHT, w->x0 };
            draw_block(&j);
        }
    return j.fragments;
}
