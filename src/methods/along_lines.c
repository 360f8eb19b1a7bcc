/* SPDX-License-Identifier: MIT */
/* along_lines.c - tile rows of a frame whose camera moves (temporal/lines.h).
 *
 *     for each row:
 *         pictures    of what stands still, mixed in the window
 *     for the row above, whose lines meet what is drawn now:
 *         blur        along lines, into a row of its own
 *         movers      over it, blurred along lines of their own
 *         finish      what is drawn at instants over both, as of any temporal method (temporal.c) */
#include "methods/temporal.h"

#include "kernels/line_means.h"

#if SMEAR_WITH_LINES

enum { LEFT = SMEAR_SKETCH - 65 };  /* the coarsest target of what is left of a frame whose lines give way: above it errs already */
enum { WAIT = 16 };         /* frames by instants, until it is seen again whether lines do */

static void lines_job(void *argument, int job, int worker)
{
    const struct smear_finish *f = (const struct smear_finish *)argument;
    const struct smear_rows *rows = f->row.rows;
    const int32_t top = row_top(rows, f->row.row), bottom = row_bottom(rows, f->row.row);
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(rows, job, &x0, &x1);
    smear_lines_blur(f->self->lines, &rows->window, x0, x1, top, bottom);
    smear_lines_copy_depth(f->self->lines, &rows->window, x0, x1, top, bottom, false);
}

/* Draws over a picture what is behind all of them, or movers over what lines have blurred. */
static void over_job(void *argument, int job, int worker)
{
    const struct smear_finish *f = (const struct smear_finish *)argument;
    const struct smear_rows *rows = f->row.rows;
    const struct smear_lines *lines = f->self->lines;
    struct smear_raster_target t = f->background;
    (void)worker;
    t.over = true;
    SMEAR_ASSERT(target_is_opaque(&t));
    if ((f->row.steps & ROW_DRAW) != 0 && smear_job_area(rows, job, &t))
        smear_raster_list(&rows->raster, &t,
                          lines->list[lines->picture == LINE_BEHIND ? line_list(LINE_BEHIND) : line_movers_list(lines->picture)]);
}

/* Draws a picture of what moves by itself over what lines have blurred, and finds where it is. */
static void draw_mover_picture(struct smear_temporal *self, struct smear_finish *f)
{
    struct smear_rows *rows = f->row.rows;
    struct smear_lines *lines = self->lines;
    const int32_t row = f->row.row, top = row_top(rows, row), bottom = row_bottom(rows, row);
    const uint32_t *list = &lines->list[line_movers_list(lines->picture)];
    smear_row_run(rows, over_job, &f->row, FILL_MOVING);
    for (bool any = smear_row_fill(rows, row, FILL_MOVING); any; any = smear_row_fill_next(rows))
        smear_movers_find(lines, &rows->bins, &rows->window, *list, top, bottom);
}

/* Draws what moves by itself over what lines have blurred, and blurs both: of two pictures the mean. */
static SMEAR_RARE void draw_movers(struct smear_temporal *self, struct smear_finish *f)
{
    struct smear_rows *rows = f->row.rows;
    struct smear_lines *lines = self->lines;
    struct smear_window *w = &rows->window;
    const int32_t row = f->row.row, top = row_top(rows, row), bottom = row_bottom(rows, row);
    const int pictures = line_mover_pictures(lines);
    bool any = rows->refill != NULL;
    for (int k = 0; k < pictures && rows->refill == NULL; k++) {
        temporal_advance(self, rows, line_movers_list(k), row);
        any = any || lines->list[line_movers_list(k)] != SMEAR_NO_TRIANGLE;
    }
    if (!any)
        return;
    smear_movers_begin(lines, w);
    if (pictures > 1)
        __builtin_memcpy(lines->over, lines->row, (size_t)(w->width * w->tile) * sizeof *lines->over);
    draw_mover_picture(self, f);
    if (pictures > 1) {
        smear_lines_copy_depth(lines, w, 0, w->width, top, bottom, false);
        smear_movers_next(lines, w);
        lines->picture = 1;
        f->background.color = lines->over;
        draw_mover_picture(self, f);
        lines->picture = 0;
        f->background.color = lines->row;
        smear_line_mix(lines->row, lines->over, NULL, w->width * (bottom - top), 1, lines->transfer);
    }
    smear_movers_blur(lines, w, top, bottom);
}

/* Blurs a row whose tiles are listed along lines, as far as it stands still, and finishes it. */
static SMEAR_RARE int finish_along_lines(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    const struct smear_window *w = &rows->window;
    const struct smear_damage_run all = { 0, (int)w->columns };
    struct smear_finish finish = { .row = { .rows = rows, .row = row }, .self = self };
    smear_row_target(rows, row, &finish.background);
    const uint32_t start = stage_start(rows);
    smear_jobs_run(&rows->jobs, lines_job, &finish, rows->jobs.workers);
    stage_end(rows, &rows->stats->time.blur, start);
    finish.background.color = self->lines->row;
    finish.background.depth = self->lines->depth;
    finish.background.color_rows = finish.background.window_rows = (struct smear_plane_rows){ w->width, 0, w->tile, 0 };
    if (self->lines->movers != 0)
        draw_movers(self, &finish);
    return smear_finish_run(self, &finish, &all);
}

/* Mixes a picture of a row with that before it, or both with those before them. */
static void mix_job(void *argument, int job, int worker)
{
    const struct smear_finish *f = (const struct smear_finish *)argument;
    const struct smear_rows *rows = f->row.rows;
    const struct smear_lines *lines = f->self->lines;
    const struct smear_window *w = &rows->window;
    const int32_t top = row_top(rows, f->row.row), bottom = row_bottom(rows, f->row.row);
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(rows, job, &x0, &x1);
    for (int32_t y = top, at = x0; x0 < x1 && y < bottom; y++, at += w->width)
        smear_line_mix(w->color + window_ring_row(w, y) * w->width + x0, lines->row + at, lines->over + at, x1 - x0, lines->picture,
                       lines->transfer);
}

/* Looks at a picture of a row. That in the middle has the depth before which movers are seen; of the first one, what is drawn behind it
 * takes a copy. */
static void look_job(void *argument, int job, int worker)
{
    const struct smear_finish *f = (const struct smear_finish *)argument;
    const struct smear_rows *rows = f->row.rows;
    const struct smear_lines *lines = f->self->lines;
    const int32_t top = row_top(rows, f->row.row), bottom = row_bottom(rows, f->row.row);
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(rows, job, &x0, &x1);
    smear_lines_look(lines, &rows->window, x0, x1, top, bottom);
    if (lines->picture + 1 == lines->pictures)
        smear_lines_displace(lines, &rows->window, x0, x1, top, bottom);
    if (lines->picture == 0 ? lines->behind != 0 : lines->picture == lines->pictures / 2 && lines->movers != 0)
        smear_lines_copy_depth(lines, &rows->window, x0, x1, top, bottom, lines->picture != 0);
}

/* Draws what stands still far behind a picture of a row into it. The depth in the window stays what it is. */
static void draw_behind(struct smear_temporal *self, struct smear_finish *f)
{
    struct smear_rows *rows = f->row.rows;
    struct smear_lines *lines = self->lines;
    const struct smear_window *w = &rows->window;
    const uint8_t picture = lines->picture;
    if (rows->refill == NULL && picture == 0)
        temporal_advance(self, rows, line_list(LINE_BEHIND), f->row.row);
    lines->picture = LINE_BEHIND;
    smear_row_run(rows, over_job, &f->row, FILL_MOVING);
    lines->picture = picture;
    if (picture == 0)
        smear_lines_copy_depth(lines, w, 0, w->width, row_top(rows, f->row.row), row_bottom(rows, f->row.row), true);
}

/* Draws a further picture of a row. */
static void draw_further(struct smear_temporal *self, struct smear_finish *f)
{
    struct smear_rows *rows = f->row.rows;
    struct smear_lines *lines = self->lines;
    const uint32_t start = stage_start(rows), first = rows->opaque;
    f->background.color = lines->picture > 1 && lines->picture + 1 == lines->pictures ? lines->over : lines->row;
    f->background.depth = lines->depth;
    f->background.color_rows = f->background.window_rows = (struct smear_plane_rows){ rows->window.width, 0, rows->window.tile, 0 };
    if (rows->refill == NULL) {
        temporal_advance(self, rows, line_list(lines->picture), f->row.row);
        rows->opaque = lines->list[line_list(lines->picture)];
    }
    smear_row_run(rows, smear_background_job, &f->row, FILL_STATIC | FILL_MOVING);
    rows->opaque = first;
    f->row.sky_too = NULL;
    stage_end(rows, &rows->stats->time.raster, start);
}

/* Draws a row's pictures. Not part of what calls it: what it keeps is gone before the row above is finished. */
static SMEAR_RARE void draw_pictures(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    struct smear_finish finish = { .row = { .rows = rows, .row = row }, .self = self };
    struct smear_lines *lines = self->lines;
    if (rows->refill == NULL)
        rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, row);
    finish.row.sky_too = lines->pictures > 1 ? lines->row : NULL;
    smear_draw_run(self, &finish);
    for (int k = 0; k < lines->pictures; k++) {
        lines->picture = (uint8_t)k;
        if (k > 0)
            draw_further(self, &finish);
        smear_jobs_run(&rows->jobs, look_job, &finish, rows->jobs.workers);
        if (lines->behind != 0)
            draw_behind(self, &finish);
        if (k > 0 && (lines->pictures - k) % 2 != 0)    /* of three or four the last two at once */
            smear_jobs_run(&rows->jobs, mix_job, &finish, rows->jobs.workers);
    }
    lines->picture = 0;
    lines->drawn = row_bottom(rows, row);
}

/* Finishes the rows from the first on that is not up to `last`. */
static int finish_rows(struct smear_temporal *self, struct smear_rows *rows, int last)
{
    for (; self->lines->finished <= last; self->lines->finished++) {
        smear_temporal_begin_row(self, rows, self->lines->finished);
        const int result = finish_along_lines(self, rows, self->lines->finished);
        if (result != SMEAR_OK)
            return result;
        smear_temporal_end_row(self, rows);
    }
    return SMEAR_OK;
}

/* From here on there are so many pictures, or none, and instants: what is known of where the first one has triangles holds no more. */
static SMEAR_RARE void go_on_with(struct smear_temporal *self, struct smear_rows *rows, int pictures)
{
    rows->bins.kept_words = 0;
    if (pictures <= self->lines->most) {
        smear_lines_take(self->lines, rows->bins.shot, pictures);
        return;
    }
    self->lines->on = false;
    lines_forget(self->lines);
    self->lines->wait = WAIT;
    self->target = min_i32(self->target, LEFT);
}

int smear_draw_along_lines(struct smear_temporal *self, struct smear_rows *rows, int row, int *end)
{
    struct smear_lines *lines = self->lines;
    draw_pictures(self, rows, row);
    const int needed = smear_lines_needed(lines, &rows->window, row_top(rows, row), row_bottom(rows, row), self->chooser.target);
    const bool again = needed > lines->pictures;
    const int result = finish_rows(self, rows, row == rows->window.rows - 1 && !again ? row : row - 1);
    if (again) {
        go_on_with(self, rows, needed);
        *end = row;
    }
    return result;
}

#endif
