/* SPDX-License-Identifier: MIT */
/* edges.c - see edges.h. */
#include "smooth/edges.h"

#include "base/fixmath.h"
#include "kernels/fill.h"
#include "kernels/pixel_steps.h"
#include "raster/raster.h"

#if SMEAR_EDGES

/* Codes: neighbours that differ by no more have no edge between them, places that do not are no other colour. */
enum { LEAST_STEP = 16, LEAST_CHANGE = 4 };

/* ------------------------------------------------------------------ where */

/* Whether some of n pixels of two rows differ. */
static inline bool differs(const uint32_t *a, const uint32_t *b, int32_t n) { return next_step(a, b, 0, n, LEAST_STEP) < n; }

/* Whether there is an edge within or at the border of pixels [x0, x1) of row y, or to the row above it in the target. */
static inline bool row_has_edge(const struct smear_raster_target *t, int32_t y, int32_t x0, int32_t x1, int32_t width)
{
    const uint32_t *row = t->color + target_row(&t->color_rows, t, y);
    const int32_t first = x0 > 0 ? x0 - 1 : 0, end = x1 < width ? x1 : width - 1;
    return differs(row + first, row + first + 1, end - first)
        || (y > t->y0 && differs(row + x0, t->color + target_row(&t->color_rows, t, y - 1) + x0, x1 - x0));
}

/* Finds edges in a unit, a bit for each band. */
static uint32_t unit_bands(const struct smear_raster_target *t, int32_t x0, int32_t x1, int32_t width)
{
    const int32_t band = 1 << EDGE_BAND_LOG2;
    uint32_t bands = 0;
    for (int32_t y0 = t->y0; y0 < t->y1; y0 += band) {
        const int32_t y1 = min_i32(y0 + band, t->y1);
        bool found = false;
        for (int32_t y = y0; y < y1 && !found; y++)
            found = row_has_edge(t, y, x0, x1, width);
        if (!found && y1 < t->y1)
            found = differs(t->color + target_row(&t->color_rows, t, y1 - 1) + x0,
                            t->color + target_row(&t->color_rows, t, y1) + x0, x1 - x0);
        bands |= (uint32_t)found << ((y0 - t->y0) >> EDGE_BAND_LOG2);
    }
    return bands;
}

void smear_edges_find(struct smear_edge_units *e, const struct smear_raster_target *t, const uint32_t *below, int32_t width)
{
    const int32_t unit = 1 << EDGE_UNIT_LOG2, last = (t->y1 - 1 - t->y0) >> EDGE_BAND_LOG2;
    const uint32_t *row = t->color + target_row(&t->color_rows, t, t->y1 - 1);
    bool from_above = false;
    for (int32_t x0 = t->x0; x0 < t->x1; x0 += unit) {
        const int32_t x1 = min_i32(x0 + unit, t->x1), column = x0 >> t->tile_shift;
        uint32_t bands = unit_bands(t, x0, x1, width);
        if (x0 == column << t->tile_shift) {
            from_above = t->y0 > 0 && t->moving[column] != 0;
            t->moving[column] = 0;
        }
        if (from_above)
            bands |= 1u;
        if (below != NULL && differs(row + x0, below + (x0 - t->x0), x1 - x0)) {
            bands |= 1u << last;
            t->moving[column] = 1;
        }
        e->bands[x0 >> EDGE_UNIT_LOG2] = (uint8_t)bands;
    }
}

bool smear_edges_any(const struct smear_edge_units *e, int32_t x0, int32_t x1)
{
    uint32_t any = 0;
    for (int32_t i = x0 >> EDGE_UNIT_LOG2; i << EDGE_UNIT_LOG2 < x1; i++)
        any |= e->bands[i];
    return any != 0;
}

/* A run of units of a band that have edges, in pixels. */
struct run {
    int32_t x0, x1;
};

/* Finds the next run of a band before column x1, in units that begin at column r->x1 or later. */
static inline bool next_run(const struct smear_edge_units *e, struct run *r, int band, int32_t x1)
{
    int32_t i = (r->x1 + (1 << EDGE_UNIT_LOG2) - 1) >> EDGE_UNIT_LOG2;
    while (i << EDGE_UNIT_LOG2 < x1 && (e->bands[i] >> band & 1u) == 0)
        i++;
    r->x0 = i << EDGE_UNIT_LOG2;
    while (i << EDGE_UNIT_LOG2 < x1 && (e->bands[i] >> band & 1u) != 0)
        i++;
    r->x1 = min_i32(i << EDGE_UNIT_LOG2, x1);
    return r->x0 < x1;
}

/* ------------------------------------------------------------------ places */

/* q8 px. */
static const int8_t place[EDGE_PLACES][2] = { { 26, -102 }, { 77, 77 }, { -102, 26 } };

struct smear_raster_target smear_edges_target(const struct smear_raster_target *t, const struct smear_edge_planes *planes, int k)
{
    const struct smear_plane_rows rows = { t->x1 - t->x0, 0, t->y1 - t->y0, t->x0 };
    return (struct smear_raster_target){ .x0 = t->x0, .y0 = t->y0, .x1 = t->x1, .y1 = t->y1, .color = planes->color[k],
                                         .color_rows = rows, .depth = planes->depth, .window_rows = rows,
                                         .tile_shift = t->tile_shift };
}

/* The target's rows [y0, y1) and columns [x0, x1). */
static inline struct smear_raster_target part_of(const struct smear_raster_target *t, int32_t x0, int32_t x1, int32_t y0,
                                                 int32_t y1)
{
    struct smear_raster_target part = *t;
    part.color_rows.ring_row = part.window_rows.ring_row = y0 - t->y0;
    part.x0 = x0;
    part.x1 = x1;
    part.y0 = y0;
    part.y1 = y1;
    return part;
}

void smear_edges_clear(const struct smear_edge_units *e, const struct smear_raster_target *t, uint32_t color)
{
#if SMEAR_CHECK
    /* Triangles pass between runs, too, where no mean looks: a memory sanitizer must not take that for a fault. */
    __builtin_memset(t->depth, 0x5a, (size_t)((t->x1 - t->x0) * (t->y1 - t->y0)) * sizeof *t->depth);
#endif
    for (int32_t y = t->y0; y < t->y1; y++) {
        const int32_t row = target_row(&t->window_rows, t, y);
        for (struct run r = { 0, t->x0 }; next_run(e, &r, (y - t->y0) >> EDGE_BAND_LOG2, t->x1);) {
            pixels_fill(t->color + row + r.x0, color, r.x1 - r.x0);
            __builtin_memset(t->depth + row + r.x0, 0, (size_t)(r.x1 - r.x0) * sizeof *t->depth);
        }
    }
}

/* A triangle at another place. */
struct moved {
    const struct smear_segment *segment;
    uint32_t color;
    const int32_t *v[3];
    int32_t record[3][VERTEX_BASE_WORDS + 3];       /* without a path, which comes last */
    struct bounds bounds;
};

static inline void move(struct moved *m, const struct smear_bins *g, const struct smear_triangle *t, int k)
{
    const struct smear_segment *s = m->segment = &g->segment[t->segment];
    const int words = s->path ? s->motion : s->stride;
    m->color = t->color;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]);
        for (int word = VERTEX_DEPTH; word < words; word++)
            m->record[i][word] = v[word];
        m->record[i][VERTEX_X] = v[VERTEX_X] + place[k][0];
        m->record[i][VERTEX_Y] = v[VERTEX_Y] + place[k][1];
        m->v[i] = m->record[i];
    }
}

static inline bool find_bounds(struct bounds *b, const struct smear_bins *g, const struct smear_triangle *t, int k)
{
    const struct smear_segment *s = &g->segment[t->segment];
    const struct bounds own = bounds_of(bins_vertex(g, s, t->vertex[0]), bins_vertex(g, s, t->vertex[1]), bins_vertex(g, s, t->vertex[2]));
    *b = (struct bounds){ own.x0 + place[k][0], own.y0 + place[k][1], own.x1 + place[k][0], own.y1 + place[k][1] };
    return ((b->x0 + 127) >> 8) < ((b->x1 + 127) >> 8) && ((b->y0 + 127) >> 8) < ((b->y1 + 127) >> 8);
}

/* Draws a triangle, whose bounds are known, into the box of units with edges that it touches. */
static void draw(const struct smear_edge_units *e, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                 const struct smear_triangle *triangle, const struct bounds *b, int k)
{
    const int32_t x0 = max_i32((b->x0 + 127) >> 8, t->x0), x1 = min_i32((b->x1 + 127) >> 8, t->x1);
    const int32_t y0 = max_i32((b->y0 + 127) >> 8, t->y0), y1 = min_i32((b->y1 + 127) >> 8, t->y1);
    if (x0 >= x1 || y0 >= y1)
        return;
    const int first_band = (y0 - t->y0) >> EDGE_BAND_LOG2, last_band = (y1 - 1 - t->y0) >> EDGE_BAND_LOG2;
    const uint32_t bands = ((2u << last_band) - 1u) & ~((1u << first_band) - 1u);
    const int32_t unit = x0 >> EDGE_UNIT_LOG2, units = ((x1 - 1) >> EDGE_UNIT_LOG2) + 1 - unit;
    uint32_t any = 0;
    int32_t first = INT32_MAX, end = 0;
    for (int32_t i = unit; i < unit + units; i++)
        if ((e->bands[i] & bands) != 0) {
            any |= e->bands[i] & bands;
            first = min_i32(first, i);
            end = i + 1;
        }
    if (any == 0)
        return;
    struct moved m;
    move(&m, frame->bins, triangle, k);
    m.bounds = *b;
    const int32_t left = max_i32(first << EDGE_UNIT_LOG2, t->x0), right = min_i32(end << EDGE_UNIT_LOG2, t->x1);
    const int low = 31 - count_leading_zeros(any & (~any + 1u)), high = 31 - count_leading_zeros(any);
    const struct smear_raster_target part = part_of(t, left, right, t->y0 + (low << EDGE_BAND_LOG2),
                                                    min_i32(t->y0 + ((high + 1) << EDGE_BAND_LOG2), t->y1));
    struct smear_raster_pass pass;
    smear_raster_begin(&pass, frame, &part);
    smear_raster_triangle(&pass, m.segment, m.color, m.v, &m.bounds);
}

void smear_edges_draw(const struct smear_edge_units *e, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                      uint32_t head, int k)
{
    while (head != SMEAR_NO_TRIANGLE) {
        const struct smear_triangle *triangle = bins_triangle(frame->bins, head);
        struct bounds bounds;
        head = triangle->next;
        if (triangle->segment != SMEAR_POINT && find_bounds(&bounds, frame->bins, triangle, k))
            draw(e, frame, t, triangle, &bounds, k);
    }
}

/* ------------------------------------------------------------------ means */

/* Takes the mean of pixels of a row, of which other places begin at `at` of their planes. */
static inline void mean_row(uint32_t *row, int32_t n, const struct smear_edge_planes *planes, int32_t at,
                            smear_transfer transfer)
{
    const uint32_t *other[3];
    int32_t next[3];
    for (int i = 0; i < 3; i++) {
        other[i] = planes->color[i] + at;
        next[i] = next_step(row, other[i], 0, n, LEAST_CHANGE);
    }
    for (int32_t x; (x = min_i32(next[0], min_i32(next[1], next[2]))) < n;) {
        for (int i = 0; i < 3; i++)         /* of pixels that are not taken yet */
            if (next[i] == x)
                next[i] = next_step(row, other[i], x + 1, n, LEAST_CHANGE);
        row[x] = pixel_mean(row[x], other[0][x], other[1][x], other[2][x], transfer);
    }
}

void smear_edges_mean(const struct smear_edge_units *e, const struct smear_raster_target *t, const struct smear_edge_planes *planes,
                      smear_transfer transfer)
{
    for (int32_t y = t->y0; y < t->y1; y++) {
        uint32_t *row = t->color + target_row(&t->color_rows, t, y);
        const int32_t at = (y - t->y0) * (t->x1 - t->x0) - t->x0;
        for (struct run r = { 0, t->x0 }; next_run(e, &r, (y - t->y0) >> EDGE_BAND_LOG2, t->x1);)
            mean_row(row + r.x0, r.x1 - r.x0, planes, at + r.x0, transfer);
    }
}

#endif
