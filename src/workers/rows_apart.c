/* SPDX-License-Identifier: MIT */
/* rows_apart.c - rows of sharp frames, each drawn by one of several cores: see methods/sharp.h. */
#include "base/base.h"
#include "display/band.h"
#include "display/pixel_format.h"
#include "methods/sharp.h"

#if SMEAR_POOL_PARTS

/* Whether there is anything to gain, and nothing that needs rows one after the other. */
static bool may_be_apart(const struct smear_rows *rows, int first, int end)
{
    return end - first > rows->jobs.workers && rows->refill == NULL && !rows->blends && !rows_have_overlay(rows)
        && rows->inspect == NULL && !rows->keeps_motion && rows->desc->band_rows == rows->bins.row_px;
}

enum {
    BUFFERS_MOST = 8,
    APART_PIXELS = 8            /* of a row for each triangle that finds room at least */
};

/* What one core has for itself. */
struct apart_window {
    uint32_t *color;            /* null: the frame's window */
    uint16_t *depth;
    uint32_t *number;           /* triangles of its row */
};

struct apart {
    struct smear_rows *rows;
    int first, count;           /* tile rows */
    int whole;                  /* of them drawn by one core each; of the others, each half is a job */
    uint32_t most;              /* triangles of a row of which numbers find room */
    uint32_t handed;            /* bands that had been handed out before */
    int result;
    /* Where finished rows lie, in turn. The first are the bands' own, in which the last rows lie: they may still be sent when
     * the memory here is used again. */
    uint8_t *buffer[BUFFERS_MOST];
    int buffers;
    /* Words that cores share. */
    unsigned listed;            /* jobs whose triangles have been listed; written by the next one */
    unsigned flushed;           /* rows that core 0 has handed out */
    unsigned failed;            /* it could not */
    unsigned ready[BUFFERS_MOST][2];    /* 1 + the number of the row whose upper and lower half lies finished there */
    struct apart_window window[SMEAR_WORKERS_MAX];
};

static void wait_apart(const struct smear_rows *rows)
{
    if (rows->desc->idle != NULL)
        rows->desc->idle(rows->desc->user);
}

/* Returns which buffer row number i has. */
static int buffer_of(const struct apart *a, int i)
{
    return (i + a->rows->desc->bands + a->count * (a->buffers - 1)) % a->buffers;
}

/* Returns how many rows have been sent; less than 0 where some of the last frame have not. */
static int rows_sent(const struct apart *a)
{
    return a->rows->desc->bands == 2 ? (int)(word_read(&a->rows->bands.sent) - a->handed) : (int)word_read(&a->flushed);
}

static bool buffer_is_free(const struct apart *a, int i)
{
    return (i < a->buffers && buffer_of(a, i) >= a->rows->desc->bands) || rows_sent(a) >= max_i32(i + 1 - a->buffers, 0);
}

/* Core 0 hands out what is finished, in order, and never a third band. */
static void flush_ready(void *apart)
{
    struct apart *const a = (struct apart *)apart;
    for (int i; (i = (int)word_own(&a->flushed)) < a->count && word_own(&a->failed) == 0;) {
        const int at = buffer_of(a, i);
        if (word_read(&a->ready[at][0]) != (unsigned)i + 1u || word_read(&a->ready[at][1]) != (unsigned)i + 1u
            || i - rows_sent(a) >= a->rows->desc->bands)
            return;
        const struct row_job job = { .rows = a->rows, .row = a->first + i, .band = a->buffer[at] };
        a->result = smear_band_flush(&job);
        word_write(a->result == SMEAR_OK ? &a->flushed : &a->failed, (unsigned)i + 1u);
    }
}

/* A job: row number `row`, pixel rows [y0, y1). */
struct apart_place {
    int row;
    int32_t y0, y1;
    bool upper, lower;
};

static struct apart_place place_of(const struct apart *a, int job)
{
    const struct smear_rows *rows = a->rows;
    const int beyond = max_i32(job - a->whole, 0), row = min_i32(job, a->whole) + beyond / 2;
    const int32_t top = row_top(rows, a->first + row), bottom = row_bottom(rows, a->first + row),
                  middle = min_i32(top + rows->bins.row_px / 2, bottom);
    const bool upper = job < a->whole || beyond % 2 == 0, lower = job < a->whole || beyond % 2 != 0;
    return (struct apart_place){ row, upper ? top : middle, lower ? bottom : middle, upper, lower };
}

/* Lists the triangles of a job's row, after those before; returns how many there are. UINT32_MAX where they find no room: the row's list
 * is this job's until it is given on. */
static uint32_t list_apart(struct apart *a, int job, const struct apart_place *p, int worker, uint32_t *number)
{
    struct smear_rows *rows = a->rows;
    uint32_t n = 0, at;
    while (word_read(&a->listed) != (unsigned)job) {
        if (worker == 0)
            flush_ready(a);
        wait_apart(rows);
    }
    if (p->upper)
        rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, a->first + p->row);
    for (at = rows->opaque; at != SMEAR_NO_TRIANGLE && n < a->most; at = bins_triangle(&rows->bins, at)->next)
        number[n++] = at;
    if (at != SMEAR_NO_TRIANGLE)
        return UINT32_MAX;
    word_write(&a->listed, (unsigned)job + 1u);
    return n;
}

static void draw_apart(struct apart *a, int job, const struct apart_place *p, int worker, struct smear_raster_target *t)
{
    const struct smear_rows *rows = a->rows;
    const struct apart_window *w = &a->window[worker];
    const struct smear_between flush = { flush_ready, a };
    const uint32_t count = list_apart(a, job, p, worker, w->number);
    smear_window_target(rows, p->y0, p->y1, t);
    if (w->color != NULL) {
        t->color = w->color;
        t->depth = w->depth;
        t->color_rows = t->window_rows = (struct smear_plane_rows){ rows->window.width, 0, rows->bins.row_px, 0 };
    }
    t->cache = smear_raster_cache_of(&rows->cache, worker);
    smear_row_clear(rows, t, 0, NULL);
    if (count != UINT32_MAX) {
        smear_raster_numbers(&rows->raster, t, w->number, count, worker == 0 ? &flush : NULL);
        return;
    }
    smear_raster_list(&rows->raster, t, rows->opaque);
    word_write(&a->listed, (unsigned)job + 1u);
}

static void convert_apart(struct apart *a, const struct apart_place *p, const struct smear_raster_target *t)
{
    const struct smear_rows *rows = a->rows;
    const smear_format format = drawn_format(rows->desc);
    const int at = buffer_of(a, p->row), row = a->first + p->row;
    struct row_job job = { .rows = a->rows, .row = row, .band = a->buffer[at], .y0 = p->y0, .y1 = p->y1 };
    if (format == SMEAR_L1_PAGES)       /* whole rows */
        __builtin_memset(job.band, 0, rows->bands.bytes);
    else
        job.band += (size_t)(p->y0 - row_top(rows, row)) * smear_format_stride(rows->window.width, format);
    if (p->y0 < p->y1)
        smear_band_convert_rows(&job, t, 0, rows->window.width);
    if (p->upper)
        word_write(&a->ready[at][0], (unsigned)p->row + 1u);
    if (p->lower)
        word_write(&a->ready[at][1], (unsigned)p->row + 1u);
}

/* Jobs behind the rows, one for each core, last until all rows have been handed out. */
static void apart_job(void *argument, int job, int worker)
{
    struct apart *a = (struct apart *)argument;
    const struct apart_place p = place_of(a, job);
    const bool is_row = p.row < a->count;
    struct smear_raster_target t;
    if (is_row)
        draw_apart(a, job, &p, worker, &t);
    while (word_read(&a->failed) == 0 && (is_row ? !buffer_is_free(a, p.row) : (int)word_read(&a->flushed) < a->count)) {
        if (worker == 0)
            flush_ready(a);
        wait_apart(a->rows);
    }
    if (!is_row || word_read(&a->failed) != 0)
        return;
    convert_apart(a, &p, &t);
    if (worker == 0)
        flush_ready(a);
}

/* Takes the buffers of the bands, and more where half of the memory that is left has room for them. */
static void cut_buffers(struct apart *a, struct smear_arena *arena, size_t bytes)
{
    const struct smear_rows *rows = a->rows;
    const int bands = a->buffers = rows->desc->bands;
    const size_t end = arena->used + (bytes - arena->used) / 2;
    for (int i = 0; i < bands; i++)
        a->buffer[i] = rows->bands.buffer[bands == 2 ? (a->handed + (uint32_t)(a->count + i)) & 1u : 0];
    while (a->buffers < BUFFERS_MOST && end - arena->used >= rows->bands.bytes + 8u)
        a->buffer[a->buffers++] = arena_take(arena, rows->bands.bytes, 1);
}

size_t smear_workers_rows_bytes(size_t workers, size_t pixels)
{
    const size_t numbers = pixels / APART_PIXELS * sizeof(uint32_t) + 8;
    return sizeof(struct apart) + 8 + workers * numbers + (workers - 1) * (pixels * 6 + 16);
}

/* Cuts the memory of the rows or what is left of triangles'; what is left of that keeps setups, where it kept them before. Null where it
 * is too small. */
static struct apart *cut_apart(struct smear_rows *rows, int count)
{
    const size_t n = (size_t)rows->jobs.workers, pixels = (size_t)rows->window.width * (size_t)rows->bins.row_px;
    const size_t own = rows->scratch_end != NULL ? (size_t)(rows->scratch_end - (uint8_t *)rows->scratch) : 0,
                 least = smear_workers_rows_bytes(n, pixels);
    size_t bytes;
    uint8_t *const rest = bins_rest(&rows->bins, &bytes);
    struct smear_arena arena = { bytes < own ? (uint8_t *)rows->scratch : rest, 0 };
    bytes = bytes < own ? own : bytes;
    const uintptr_t from = (uintptr_t)arena.memory, to = from + bytes, cache = (uintptr_t)rows->cache.entry;
    if (bytes < least)
        return NULL;
    const uint32_t most = (uint32_t)(pixels / APART_PIXELS + (bytes - least) / (8 * n));
    struct apart *a = arena_take(&arena, 1, sizeof *a);
    *a = (struct apart){ .rows = rows, .count = count, .most = min_u32(most, bins_listed(&rows->bins)), .handed = rows->bands.handed };
    for (size_t i = 0; i < n; i++) {
        a->window[i].number = arena_take(&arena, a->most, sizeof *a->window[i].number);
        a->window[i].color = i != 0 ? arena_take(&arena, pixels, sizeof *a->window[i].color) : NULL;
        a->window[i].depth = i != 0 ? arena_take(&arena, pixels, sizeof *a->window[i].depth) : NULL;
    }
    cut_buffers(a, &arena, bytes);
    if (SMEAR_RASTER_CACHE && cache >= from && cache < to)
        rows->cache = smear_raster_cache_make(arena.memory + arena.used, bytes - arena.used, (int)n, &rows->bins);
    return a;
}

bool smear_workers_rows(struct smear_rows *rows, int first, int end, int *result)
{
    enum { ROWS_LEAST = 16 };
    const uint32_t start = stage_start(rows);
    struct apart *a = may_be_apart(rows, first, end) ? cut_apart(rows, end - first) : NULL;
    if (a == NULL)
        return false;
    const bool halves = rows->bins.row_px >= ROWS_LEAST && drawn_format(rows->desc) != SMEAR_L1_PAGES;
    a->first = first;
    a->whole = halves ? a->count - rows->jobs.workers : a->count;
    smear_jobs_run(&rows->jobs, apart_job, a, a->whole + 2 * (a->count - a->whole) + rows->jobs.workers);
    *result = a->result;
    stage_end(rows, &rows->stats->time.raster, start);
    return true;
}

#endif
