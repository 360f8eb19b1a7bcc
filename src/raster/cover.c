/* SPDX-License-Identifier: MIT */
/* cover.c - which pixels a triangle covers, exactly.
 *
 * A pixel belongs to a triangle if its centre is inside, by the top-left rule. In row y an edge lies at
 * x(y) = x0 + (yc - y0) dx / dy, exactly (kernels/edge_walk.h); pixels from ceil(left) to ceil(right) - 1 are
 * covered. Both triangles at an edge see the same fraction, so no pixel is drawn twice
 * or missed. */
#include "raster/cover.h"

#include "kernels/edge_walk.h"
#include "kernels/kernels.h"
#include "raster/span.h"

/* ------------------------------------------------------------------ rows */

/* Where the pixels of a row lie, and depth at its pixel 0. */
struct row {
    int32_t y;
    int32_t color_ring_row, window_ring_row;
    int32_t color, window;          /* index of column 0 in the planes */
    int32_t units;
};

static void row_start(struct row *r, const struct setup *s, int32_t y)
{
    const struct smear_raster_target *t = s->target;
    const struct smear_plane_rows *c = &t->color_rows, *w = &t->window_rows;
    r->y = y;
    r->color_ring_row = c->ring_row + (y - t->y0);
    r->window_ring_row = w->ring_row + (y - t->y0);
    if (r->color_ring_row >= c->ring)
        r->color_ring_row -= c->ring;
    if (r->window_ring_row >= w->ring)
        r->window_ring_row -= w->ring;
    r->color = r->color_ring_row * c->stride - c->x0;
    r->window = r->window_ring_row * w->stride - w->x0;
    r->units = plane_at(&s->depth, 0, y);
}

static inline void row_next(struct row *r, const struct setup *s)
{
    const struct smear_raster_target *t = s->target;
    r->y++;
    r->color += t->color_rows.stride;
    r->window += t->window_rows.stride;
    if (++r->color_ring_row == t->color_rows.ring) {
        r->color_ring_row = 0;
        r->color = -t->color_rows.x0;
    }
    if (++r->window_ring_row == t->window_rows.ring) {
        r->window_ring_row = 0;
        r->window = -t->window_rows.x0;
    }
    r->units = add_wrap(r->units, s->depth.dy);
}

/* ------------------------------------------------------------------ spans */

/* A cutout's velocity goes where its texels were drawn: colours first, then velocities by their mask. */
static SMEAR_NOINLINE void draw_cutout(const struct setup *s, struct span *p, smear_span_fn *write)
{
    uint32_t mask[SPAN_MAX / 32 + 1];
    for (int32_t i = 0; i <= (p->b - p->a) >> 5; i++)
        mask[i] = 0;
    p->mask = mask;
    write(s, p);
    smear_span_velocity(s, p);
}

/* Pixels [p->a, p->b), which lie in one slope of the depth code and within the target's columns. */
static inline void draw_run(const struct setup *s, struct span *p, const struct row *r,
                            enum depth_slope slope, int32_t units, smear_span_fn *write)
{
    const struct smear_raster_target *t = s->target;
    p->at = r->window + p->a;
    p->color = target_is_direct(t) ? (void *)(t->direct + p->at) : t->color + (r->color + p->a);
    p->depth = t->depth + p->at;
    p->z = code_from_units(units, slope);
    p->dz = step_from_units(s->depth.dx, slope);
    p->mask = NULL;
    if (setup_writes_velocity(s)) {
        if (draw_is_cutout(s->draw)) {
            draw_cutout(s, p, write);
            return;
        }
        smear_span_velocity(s, p);
    }
    write(s, p);
}

/* The depth code's break lies within the span: draws up to the first pixel beyond it. Returns that pixel. */
static SMEAR_RARE int32_t draw_to_break(const struct setup *s, struct span *p, const struct row *r,
                                        int32_t units, smear_span_fn *write)
{
    enum depth_slope slope = units < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
    int32_t a = p->a, b = p->b;
    p->b = a + pixels_to_break(units, s->depth.dx, b - a);
    draw_run(s, p, r, slope, units, write);
    a = p->b;
    p->b = b;
    return a;
}

static inline void draw_span(const struct setup *s, const struct row *r, int32_t left, int32_t right,
                             smear_span_fn *write)
{
    const struct smear_raster_target *t = s->target;
    struct span p;
    p.a = max_i32(left, t->x0);
    p.b = min_i32(right, t->x1);
    if (p.a >= p.b)
        return;
    p.left = left;
    p.right = right;
    p.y = r->y;
    int32_t units = add_wrap(r->units, mul_wrap(s->depth.dx, p.a));
    enum depth_slope slope = s->slope;
    if (slope == SLOPE_BOTH) {
        int32_t last = add_wrap(units, mul_wrap(s->depth.dx, p.b - 1 - p.a));
        if ((last < SLOPE_BREAK) != (units < SLOPE_BREAK)) {
            p.a = draw_to_break(s, &p, r, units, write);
            units = add_wrap(r->units, mul_wrap(s->depth.dx, p.a));
        }
        slope = units < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
    }
    draw_run(s, &p, r, slope, units, write);
}

/* ------------------------------------------------------------------ sides */

/* A triangle's two sides on their way down. */
struct sides {
    struct corners c;
    struct edge_walk left, right;
};

static SMEAR_RARE void side_start(struct edge_walk *e, const int32_t *a, const int32_t *b, int32_t y) { edge_start(e, a, b, y); }

/* False when no row lies in the target. */
static bool sides_start(struct sides *d, const struct setup *s)
{
    struct corners *c = &d->c;
    corners_find(c, s->v, s->target->y0, s->target->y1);
    if (c->first >= c->end)
        return false;
    side_start(c->whole_is_left ? &d->left : &d->right, c->top, c->bottom, c->first);
    return true;
}

/* The short side of the rows that come now; returns the row in which it ends. */
static int32_t sides_part(struct sides *d, int32_t y)
{
    const struct corners *c = &d->c;
    const bool upper = y < c->knee;
    side_start(c->whole_is_left ? &d->right : &d->left, upper ? c->top : c->middle, upper ? c->middle : c->bottom, y);
    return upper ? c->knee : c->end;
}

static void cover_spans(const struct setup *s, smear_span_fn *write)
{
    struct sides d;
    struct row r;
    if (!sides_start(&d, s))
        return;
    row_start(&r, s, d.c.first);
    while (r.y < d.c.end) {
        int32_t stop = sides_part(&d, r.y);
        do {
            draw_span(s, &r, edge_pixel(&d.left), edge_pixel(&d.right), write);
            edge_step(&d.left);
            edge_step(&d.right);
            row_next(&r, s);
        } while (r.y < stop);
    }
}

/* Rows that are gathered before they are drawn together: those of one stretch of the ring. */
struct gather {
    struct span_rows rows;
    int32_t ring_row;           /* of the row that comes next */
};

static inline void gather_start(struct gather *g, const struct setup *s, int32_t y)
{
    const struct smear_raster_target *t = s->target;
    g->ring_row = t->window_rows.ring_row + (y - t->y0);
    if (g->ring_row >= t->window_rows.ring)
        g->ring_row -= t->window_rows.ring;
    g->rows.y = y;
    g->rows.count = 0;
}

/* In which slope a pixel's depth lies. */
static inline enum depth_slope slope_at(const struct setup *s, int32_t x, int32_t y)
{
    return plane_at(&s->depth, x, y) < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
}

/* In which slope rows lie whose sides are straight but where they meet the frame's border: the box of them tells. */
static SMEAR_NOINLINE enum depth_slope slope_of_rows(const struct setup *s, const struct span_rows *r)
{
    const struct span_side *const top = r->side, *const bottom = top + r->count - 1;
    const int32_t x0 = min_i32(top->left, bottom->left), x1 = max_i32(top->right, bottom->right), end = r->y + r->count - 1;
    const enum depth_slope slope = slope_at(s, x0, r->y);
    const bool same = slope == slope_at(s, x1, r->y) && slope == slope_at(s, x0, end) && slope == slope_at(s, x1, end);
    const uint32_t steep = magnitude_i32(s->depth.dx) | magnitude_i32(s->depth.dy);
    return same && steep < 1u << 18 ? slope : SLOPE_BOTH;       /* planes do not wrap in a frame */
}

static inline void gather_draw(struct gather *g, const struct setup *s, smear_rows_fn *draw)
{
    g->rows.slope = s->slope == SLOPE_BOTH ? slope_of_rows(s, &g->rows) : s->slope;
    g->rows.at = (g->ring_row - g->rows.count) * s->target->window_rows.stride - s->target->window_rows.x0;
    draw(s, &g->rows);
    g->rows.y += g->rows.count;
    g->rows.count = 0;
    if (g->ring_row == s->target->window_rows.ring)
        g->ring_row = 0;
}

static void cover_rows(const struct setup *s, smear_rows_fn *draw, bool cut)
{
    struct sides d;
    struct gather g;
    if (!sides_start(&d, s))
        return;
    gather_start(&g, s, d.c.first);
    g.rows.cut = cut;
    while (g.rows.y < d.c.end) {
        int32_t stop = sides_part(&d, g.rows.y);
        while (g.rows.y < stop) {
            int32_t n = min_i32(min_i32(stop - g.rows.y, SPAN_ROWS), s->target->window_rows.ring - g.ring_row);
            edge_left(g.rows.side, &d.left, n);
            edge_right(g.rows.side, &d.right, n, s->frame->width);
            g.rows.count = n;
            g.ring_row += n;
            gather_draw(&g, s, draw);
        }
    }
}

/* ------------------------------------------------------------------ any triangle */

void smear_cover_choose(struct setup *s, bool small)
{
    s->rows = !SMEAR_SPAN_ROWS || s->flat || (small && !segment_textured(s->segment)) ? NULL : smear_rows_choose(s);
}

void smear_cover(const struct setup *s, const struct pixel_box *box, bool small)
{
    if (HAS_FLAT_ROWS && s->flat && !s->writes_velocity && !small) {
        smear_flat_cover(s);
        return;
    }
    if (SMEAR_SPAN_ROWS && s->rows != NULL) {
        cover_rows(s, s->rows, max_i32(box->left, 0) < s->target->x0 || min_i32(box->right, s->frame->width) > s->target->x1);
        return;
    }
    smear_span_fn *write = ALWAYS_FLAT || s->flat ? smear_span_flat : smear_span_general;
    if (SMEAR_WITH_FOG && small && fog_varies(s) && s->color_block >= 16 && !setup_has_looks(s))
        write = smear_span_level;
    if (!SMEAR_SMALL_CODE && draw_is_shadow(s->draw) && !setup_is_shaded(s) && s->segment->uv != 0 && s->segment->shade == SHADE_NONE
        && s->texture.mode == TEXTURE_CURVED && s->texture.turns && s->draw->sampler.format == SMEAR_TEXEL_PALETTE8)
        write = smear_span_texels_shadow;
    cover_spans(s, write);
}
