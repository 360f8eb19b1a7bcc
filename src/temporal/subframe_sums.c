/* SPDX-License-Identifier: MIT */
/* subframe_sums.c - sums of some tiles over instants. Linear light and many instants take a word per channel. */
#include "temporal/subframe_sums.h"

#include "kernels/gap_means.h"

static SMEAR_RARE void add_wide(const struct subframes *f, int32_t at, const uint32_t *background, int32_t n)
{
    const bool linear = frame_is_linear(f->t->frame);
    const uint32_t all = f->blends;
    uint32_t *p = f->work.color + at, *r = f->sum[0] + at, *g = f->sum[1] + at, *b = f->sum[2] + at;
    uint32_t *times = f->times + at;
    for (int32_t i = 0; i < n; i++) {
        uint32_t c = p[i], behind = background[i];
        if (((c ^ behind) | all) != 0) {
            r[i] += light_of_code(pixel_red(c), linear);
            g[i] += light_of_code(pixel_green(c), linear);
            b[i] += light_of_code(pixel_blue(c), linear);
            times[i]++;
            p[i] = behind;
        }
    }
}

static void clear_row(const struct subframes *f, int32_t at, int32_t n)
{
    if (is_packed(f)) {
        packed_sums_clear(&f->sums, at, n);
        return;
    }
    const size_t bytes = (size_t)n * sizeof *f->times;
    for (int i = 0; i < 3; i++)
        __builtin_memset(f->sum[i] + at, 0, bytes);
    __builtin_memset(f->times + at, 0, bytes);
}

/* A gap's mean is taken up to GAP_PAIRS_MAX pixels beyond what was drawn, and reads as far beyond that. */
SMEAR_NOINLINE void smear_subframe_sums_clear(const struct subframes *f, const struct subframe_box *set)
{
    const struct smear_raster_target *s = &f->t->background;
    const int32_t reach = 2 * GAP_PAIRS_MAX;
    const struct subframe_box b = { max_i32(f->area.x0 - reach, s->x0), max_i32(f->area.y0 - reach, s->y0),
                                    min_i32(f->area.x1 + reach, s->x1), min_i32(f->area.y1 + reach, s->y1) };
    for (int32_t y = b.y0; y < b.y1; y++) {
        const int32_t at = work_row(f, &b, y);
        if (y < set->y0 || y >= set->y1) {
            clear_row(f, at, b.x1 - b.x0);
            continue;
        }
        if (set->x0 > b.x0)
            clear_row(f, at, set->x0 - b.x0);
        if (set->x1 < b.x1)
            clear_row(f, at + set->x1 - b.x0, b.x1 - set->x1);
    }
}

void smear_subframe_sums_add(const struct subframes *f, const struct subframe_box *b, bool sets)
{
    const struct smear_raster_target *s = &f->t->background;
    const int32_t n = b->x1 - b->x0;
    for (int32_t y = b->y0; y < b->y1; y++) {
        const uint32_t *background = s->color + target_row(&s->color_rows, s, y) + b->x0;
        const int32_t at = work_row(f, b, y);
        uint32_t *color = f->work.color + at;
#if PACKED_SETS
        if (sets) {
            smear_packed_set(color, background, packed_sums_from(f->sums, at), n);
            continue;
        }
#else
        (void)sets;
#endif
        if (is_packed(f))
            smear_packed_add(color, background, packed_sums_from(f->sums, at), n, f->blends);
        else
            add_wide(f, at, background, n);
    }
}
