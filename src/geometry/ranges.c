/* SPDX-License-Identifier: MIT */
/* ranges.c - see ranges.h. */
#include "geometry/ranges.h"

#include "geometry/assemble.h"
#include "geometry/places.h"

enum { BESIDE_LEAST = SMEAR_CHECKED ? 1 : 256,      /* triangles of a draw in which those beside the view are looked for */
       BESIDE_STEP = 4 };           /* runs, at most, of which one is looked at */

uint32_t smear_ranges_seen(const struct smear_assembler *a, const struct smear_assembly *d, struct smear_tile_box filled, uint32_t *first)
{
    const uint32_t end = ranges_next(a, filled, first, d->end);
    if (SMEAR_SMALL_CODE || d->end < BESIDE_LEAST)
        return end;
    for (uint32_t i = *first, runs = 1; i < end;) {
        const uint32_t next = min_u32(i + PLACES_BLOCK, end);
        if (!smear_vertex_run_is_beside(d, &a->viewport, i, next)) {
            i += runs * PLACES_BLOCK;
            runs = min_u32(2 * runs, BESIDE_STEP);          /* where runs are in the view, fewer are looked at */
            continue;
        }
        if (i != *first)
            return i;
        *first = i = next;
    }
    return end;
}

/* Adds pixels to a box, which is as large as the frame at most. */
static void add_pixels(struct smear_tile_box *box, const struct smear_assembler *a, int32_t x0, int32_t x1, int32_t y0, int32_t y1)
{
    const struct smear_damaged_tiles tiles = { .shift = RANGE_BOX_SHIFT };
    tile_box_add(box, tile_box_of(&tiles, max_i32(x0, 0), min_i32(x1, a->viewport.width), max_i32(y0, 0),
                                  min_i32(y1, a->viewport.height)));
}

/* Adds triangle number i, which has no path. */
static void add_still(struct smear_tile_box *all, const struct smear_assembler *a, uint32_t i)
{
    const struct smear_bins *g = a->bins;
    const struct smear_triangle *t = bins_triangle(g, i);
    if (t->segment == SMEAR_POINT) {
        add_pixels(all, a, t->vertex[POINT_X], t->vertex[POINT_X] + 1, t->vertex[POINT_Y], t->vertex[POINT_Y] + 1);
        return;
    }
    const int32_t *v[3];
    struct box box;
    for (int k = 0; k < 3; k++)
        v[k] = bins_vertex(g, &g->segment[t->segment], t->vertex[k]);
    box_span(&box.x0, &box.x1, v[0][VERTEX_X], v[1][VERTEX_X], v[2][VERTEX_X]);
    box_span(&box.y0, &box.y1, v[0][VERTEX_Y], v[1][VERTEX_Y], v[2][VERTEX_Y]);
    box_widen(&box, a);
    add_pixels(all, a, box.x0, box.x1, box.y0, box.y1);
}

static void add_stored(struct smear_tile_box *all, const struct smear_assembler *a, bool path)
{
    const struct smear_bins *g = a->bins;
    for (uint32_t i = 0; i < g->triangle_count; i += path ? 2 : 1) {
        if (!path) {
            add_still(all, a, i);
            continue;
        }
        const struct smear_path_bounds *b = bins_bounds(g, i + 1);
        add_pixels(all, a, b->x0, b->x1, b->y0, b->y1);
    }
}

/* Assembles what is left of a range, from a->resume on, into the empty store. False where it does not find room. */
static bool assemble(struct smear_assembler *a, struct smear_assembly *d)
{
    const struct smear_resume resume = a->resume;
    smear_bins_reset(a->bins, 0, a->bins->row_count);
    smear_assembler_reset(a);
    a->resume = resume;
    return assembly_has_path(d) ? smear_assemble_path(a, d) : smear_assemble(a, d);
}

void smear_ranges_find(struct smear_assembler *a, struct smear_assembly *d, struct smear_tile_box *box)
{
    const uint32_t end = d->end;
    d->shading.lit = false;
    d->shading.white = true;
    const struct smear_resume begin = { 0, 0 };
    for (uint32_t first = 0; first < end; first = d->end, box++) {
        d->first = first;
        d->end = min_u32(first + (1u << a->bins->range_shift), end);
        *box = tile_box_none();
        a->resume = begin;
        bool done = false;
        do {
            done = assemble(a, d);
            add_stored(box, a, assembly_has_path(d));
        } while (!done);
    }
}

