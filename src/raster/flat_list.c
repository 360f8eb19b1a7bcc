/* SPDX-License-Identifier: MIT */
/* flat_list.c - triangles of one colour, from vertices to rows. */
#include "raster/cover.h"

#include "base/fixmath.h"
#include "kernels/flat_lines_bind.h"
#include "kernels/gradient.h"
#include "raster/kept.h"
#include "raster/span.h"

/* Columns of its box. */
struct columns {
    int32_t left, right;
};

static SMEAR_NOINLINE struct columns columns_of(const int32_t *const v[3], const struct bounds *given)
{
    struct columns c;
    if (given != NULL)
        return (struct columns){ (given->x0 + 127) >> 8, (given->x1 + 127) >> 8 };
    box_span(&c.left, &c.right, v[0][VERTEX_X], v[1][VERTEX_X], v[2][VERTEX_X]);
    return c;
}

/* How depths change, as smear_setup has it. */
struct depth_slopes {
    int32_t dx, dy;
};

static inline struct depth_slopes depth_slopes_of(const int32_t *const v0, const int32_t *const v1, const int32_t *const v2)
{
    const int32_t d1 = v1[VERTEX_DEPTH] - v0[VERTEX_DEPTH], d2 = v2[VERTEX_DEPTH] - v0[VERTEX_DEPTH];
    if ((d1 | d2) == 0)
        return (struct depth_slopes){ 0, 0 };
    const int32_t x1 = v1[VERTEX_X] - v0[VERTEX_X], y1 = v1[VERTEX_Y] - v0[VERTEX_Y];
    const int32_t x2 = v2[VERTEX_X] - v0[VERTEX_X], y2 = v2[VERTEX_Y] - v0[VERTEX_Y];
    const uint64_t area = (uint64_t)edges_area(x1, y1, x2, y2);
    const int zeros = count_leading_zeros_64(area);
    const uint32_t recip = recip_norm_precise((uint32_t)(area << zeros >> 32));
    const int32_t edges[] = { x1, y1, x2, y2 };
    const uint64_t both = gradients(edges, d1, d2, recip, zeros);
    const int32_t dx = (int32_t)(uint32_t)both, dy = (int32_t)(uint32_t)(both >> 32);
    if ((uint32_t)dx + PLANE_STEEP > 2u * PLANE_STEEP || (uint32_t)dy + PLANE_STEEP > 2u * PLANE_STEEP)
        return (struct depth_slopes){ 0, 0 };
    return (struct depth_slopes){ dx, dy };
}

/* Where depths lie: nearer than the break of their code, farther, or on both sides of it. */
static inline enum depth_slope depth_side(int32_t q0, int32_t q1, int32_t q2)
{
    const int32_t a = q0 - SLOPE_BREAK, b = q1 - SLOPE_BREAK, c = q2 - SLOPE_BREAK;        /* signs tell */
    return ((a ^ b) | (a ^ c)) < 0 ? SLOPE_BOTH : a >= 0 ? SLOPE_NEAR : SLOPE_FAR;
}

/* Codes from a row on, of which pixel 0 has these units. */
static inline void codes_make(struct flat_lines *l, enum depth_slope slope, int32_t units, int32_t dx, int32_t dy)
{
    l->breaks = slope == SLOPE_BOTH;
    l->z = l->breaks ? (uint32_t)units - FLAT_BREAK : code_from_units(units, slope);
    l->dz = (uint32_t)(l->breaks ? dx : step_from_units(dx, slope));
    l->dz_down = (uint32_t)(l->breaks ? dy : step_from_units(dy, slope));
}

static inline void depth_make(struct flat_lines *l, const int32_t *const v[3], int32_t y)
{
    const struct depth_slopes d = depth_slopes_of(v[0], v[1], v[2]);
    const int32_t vx = v[0][VERTEX_X], vy = v[0][VERTEX_Y], q0 = v[0][VERTEX_DEPTH];
    const int32_t here = add_wrap(q0, add_wrap(slope_part(d.dx, 128 - (vx & 255)), slope_part(d.dy, 128 - (vy & 255))));
    const int32_t units = add_wrap(here, sub_wrap(mul_wrap(d.dy, y - (vy >> 8)), mul_wrap(d.dx, vx >> 8)));
    codes_make(l, depth_side(q0, v[1][VERTEX_DEPTH], v[2][VERTEX_DEPTH]), units, d.dx, d.dy);
}

/* ------------------------------------------------------------------ rows */

static inline uintptr_t to_pixels_of(const struct smear_raster_target *t, bool narrow)
{
    return narrow ? (uintptr_t)t->direct - (uintptr_t)t->depth : (uintptr_t)t->color - 2 * (uintptr_t)t->depth;
}

static inline void lines_start(struct flat_lines *l, const struct smear_raster_target *t, uint32_t color)
{
    l->x0 = t->x0;
    l->x1 = t->x1;
    l->narrow = target_is_direct(t);
    l->shadow = false;
    l->color = target_pixel(t, color);
    if (l->narrow)
        l->color *= 0x10001u;
    l->depth_bytes = t->window_rows.stride * 2;
    l->to_pixels = to_pixels_of(t, l->narrow);
}

/* Darkens pixels of n rows, as flat_lines draws them, but for depths. */
static SMEAR_NOINLINE void darken_lines(struct flat_lines *l, int32_t n)
{
    const bool breaks = l->breaks;
    const uint32_t dz = l->dz;
    uint32_t last = l->last, dark = l->dark;
    struct edge_fine side[2];
    flat_lines_take_sides(l, side);
    for (; n > 0; n--) {
        const int32_t a = max_i32(edge_fine_pixel(&side[0]), l->x0), count = min_i32(edge_fine_pixel(&side[1]), l->x1) - a;
        const uint16_t *depth = l->depth + a;
        uint32_t *pixel = (uint32_t *)((uintptr_t)depth * 2u + l->to_pixels), z = l->z + dz * (uint32_t)a;
        for (const uint16_t *const end = depth + max_i32(count, 0); depth != end; depth++, pixel++, z += dz)
            if (flat_code(z, breaks) >> 16 > *depth) {
                if (*pixel != last)
                    last = *pixel, dark = smear_span_darkened(last, l->color, l->transfer);
                *pixel = dark;
            }
        flat_lines_go_down(l, side);
    }
    l->last = last;
    l->dark = dark;
    flat_lines_side(l, 0, &side[0]);
    flat_lines_side(l, 1, &side[1]);
}

static SMEAR_COPY void draw_lines(struct flat_lines *l, int32_t n)
{
    if (SMEAR_WITH_ALPHA && l->shadow)
        darken_lines(l, n);
    else
        flat_lines(l, n, SMEAR_DIRECT && l->narrow);
}

/* Draws n rows of which some lie behind the ring's last one: `left` rows lie before its end. */
static SMEAR_NOINLINE void draw_around(struct flat_lines *l, int32_t n, int32_t left, int32_t ring)
{
    if (left > 0) {
        draw_lines(l, left);
        n -= left;
    }
    l->depth = (uint16_t *)(void *)((uint8_t *)l->depth - ring * l->depth_bytes);
    draw_lines(l, n);
}

/* Draws rows [y, end), of which those before the knee lie at one short side. `on`: the sides are those of row y already, as rows above
 * have left them; but a side that begins with it is new. */
SMEAR_INLINE_COPY void draw_rows(const struct smear_raster_target *t, struct flat_lines *l, const struct corners *c, int32_t y,
                                 int32_t end, bool on)
{
    const struct smear_plane_rows *const w = &t->window_rows;
    const int whole = c->whole_is_left ? 0 : 1;
    int32_t left = w->ring - w->ring_row - (y - t->y0);     /* rows before the ring's end */
    if (left <= 0)
        left += w->ring;
    l->depth = t->depth + ((w->ring - left) * w->stride - w->x0);
    if (!on)
        flat_lines_start(l, whole, c->top, c->bottom, y - c->first);
    for (on = on && y != c->knee; y < end; on = false) {
        const bool upper = y < c->knee;
        const int32_t n = (upper ? min_i32(c->knee, end) : end) - y;
        if (!on && upper)
            flat_lines_start(l, 1 - whole, c->top, c->middle, y - c->first);
        else if (!on)
            flat_lines_start(l, 1 - whole, c->middle, c->bottom, y - c->knee);
        y += n;
        if (left >= n) {
            draw_lines(l, n);
        } else {
            draw_around(l, n, left, w->ring);
            left += w->ring;
        }
        left -= n;
    }
}

/* ------------------------------------------------------------------ triangles */

/* Of triangles of one colour that assembly draws in all of a row, the lines that it goes on from are kept. */
struct kept_flat {
    struct kept kept;
    struct flat_lines lines;    /* of the next row */
    int32_t row;                /* that row */
    int32_t knee;               /* struct corners */
    const int32_t *middle, *bottom;
    bool whole_is_left;
};
size_t smear_flat_kept_bytes(void) { return sizeof(struct kept_flat); }

/* In numbers of triangles that are kept: as a struct kept_flat. */
#define FLAT_KEPT 0x80000000u

/* The two places where a triangle may be kept. Where both are others' it is made ready again, which takes less than to look elsewhere
 * does for all. */
static inline struct kept_flat *flat_slot(const struct smear_raster_target *t, uint32_t number, bool second)
{
    const uint32_t n = t->cache.entries, at = (number * 40503u & 0xffffu) * n >> 16;
    return (struct kept_flat *)(void *)kept_at(&t->cache, second ? n - 1 - at : at);
}

bool smear_flat_go_on(const struct smear_raster_target *t, uint32_t number)
{
    struct kept_flat *k = flat_slot(t, number, false);
    if (k->kept.triangle != (number | FLAT_KEPT))
        k = flat_slot(t, number, true);
    if (k->kept.triangle != (number | FLAT_KEPT) || k->row != t->y0 || k->lines.narrow != target_is_direct(t))
        return false;
    k->lines.to_pixels = to_pixels_of(t, k->lines.narrow);      /* a band may have memory of its own */
    k->row = t->y1;
    const struct corners c = { NULL, k->middle, k->bottom, 0, k->knee, k->kept.end, k->whole_is_left };
    draw_rows(t, &k->lines, &c, t->y0, min_i32(c.end, t->y1), true);
    if (k->kept.end <= t->y1)
        k->kept.triangle = SMEAR_NO_TRIANGLE;
    return true;
}

/* Where the lines of one that goes on below are drawn, to be kept; null where others are. */
static inline struct flat_lines *keep_rows(const struct smear_raster_target *t, const struct corners *c, uint32_t number)
{
    struct kept_flat *k = flat_slot(t, number, false);
    if (!entry_is_free(&k->kept, t))
        k = flat_slot(t, number, true);
    if (!entry_is_free(&k->kept, t))
        return NULL;
    k->kept = (struct kept){ number | FLAT_KEPT, c->end };
    k->row = t->y1;
    k->knee = c->knee;
    k->middle = c->middle;
    k->bottom = c->bottom;
    k->whole_is_left = c->whole_is_left;
    return &k->lines;
}

bool smear_flat_triangle(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, const struct bounds *given,
                         bool whole, uint32_t number)
{
    struct corners c;
    struct flat_lines own, *l = &own;
    corners_sort(&c, v);
    const int32_t y = max_i32(c.first, t->y0), end = min_i32(c.end, t->y1);
    const bool low = c.end - c.first <= SMALL_PX;
    if (low || !whole) {
        const struct columns columns = columns_of(v, given);
        if (low && columns.right - columns.left <= SMALL_PX && (columns.right - columns.left) * (c.end - c.first) <= TINY_PIXELS)
            return false;
        if (!whole && max_i32(columns.left, t->x0) >= min_i32(columns.right, t->x1))
            return true;
    }
    if (y >= end)
        return true;
    if (SMEAR_RASTER_CACHE && number != SMEAR_NO_TRIANGLE && c.end > t->y1) {
        struct flat_lines *const kept = keep_rows(t, &c, number);
        l = kept != NULL ? kept : l;
    }
    lines_start(l, t, color);
    depth_make(l, v, y);
    draw_rows(t, l, &c, y, end, false);
    return true;
}

void smear_flat_shadow(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, smear_transfer transfer)
{
    struct flat_lines l;
    struct corners c;
    int32_t raised[3][3];           /* in front of what it lies on: setup_depth */
    const int32_t *const r[3] = { raised[0], raised[1], raised[2] };
    for (int i = 0; i < 3; i++) {
        raised[i][VERTEX_X] = v[i][VERTEX_X];
        raised[i][VERTEX_Y] = v[i][VERTEX_Y];
        raised[i][VERTEX_DEPTH] = v[i][VERTEX_DEPTH] + (v[i][VERTEX_DEPTH] >> 9);
    }
    corners_sort(&c, r);
    const int32_t y = max_i32(c.first, t->y0), end = min_i32(c.end, t->y1);
    if (y >= end)
        return;
    lines_start(&l, t, 0);
    l.shadow = true;
    l.color = color;
    l.transfer = transfer;
    l.last = l.dark = 0xff000000u;          /* as dark as can be */
    depth_make(&l, r, y);
    draw_rows(t, &l, &c, y, end, false);
}

void smear_flat_cover(const struct setup *s)
{
    const struct smear_raster_target *t = s->target;
    struct corners c;
    struct flat_lines l;
    corners_sort(&c, s->v);
    const int32_t y = max_i32(c.first, t->y0), end = min_i32(c.end, t->y1);
    if (y >= end)
        return;
    lines_start(&l, t, s->color);
    codes_make(&l, s->slope, plane_at(&s->depth, 0, y), s->depth.dx, s->depth.dy);
    draw_rows(t, &l, &c, y, end, false);
}
