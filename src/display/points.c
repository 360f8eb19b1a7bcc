/* SPDX-License-Identifier: MIT */
/* points.c - see points.h. Lengths along and across a streak are in radii of its dot, q13; weights in q15 and q16. */
#include "display/points.h"

#if SMEAR_WITH_OVERLAY

/* ------------------------------------------------------------------ lists */

static inline smear_point_place *place_of(const struct smear_rows *rows, uint32_t i)
{
    return &rows->overlay->points->point[i].place;
}

void smear_points_hide(const struct smear_rows *rows)
{
    for (uint32_t i = 0; i < rows->overlay->points->count; i++)
        place_of(rows, i)->y1 = INT16_MIN;
}

void smear_points_list(struct smear_rows *rows, int32_t y0, int32_t y1)
{
    rows->points = SMEAR_NO_POINT;
    for (uint32_t i = rows->overlay->points->count; i-- > 0;) {
        smear_point_place *p = place_of(rows, i);
        if (p->y0 >= y1 || p->y1 <= y0)
            continue;
        p->next = rows->points;
        rows->points = (uint16_t)i;
    }
}

bool smear_points_touch(const struct smear_rows *rows, int32_t y0, int32_t y1)
{
    for (uint32_t i = 0; rows_have_points(rows) && i < rows->overlay->points->count; i++)
        if (place_of(rows, i)->y0 < y1 && place_of(rows, i)->y1 > y0)
            return true;
    return false;
}

struct overlay_box smear_points_box(const struct smear_rows *rows, const struct overlay_box *area)
{
    struct overlay_box all = { area->x1, area->y1, area->x0, area->y0 };
    for (uint32_t i = rows->points; i != SMEAR_NO_POINT;) {
        const smear_point_place *p = place_of(rows, i);
        i = p->next;
        if (p->x0 >= area->x1 || p->x1 <= area->x0 || p->y0 >= area->y1 || p->y1 <= area->y0)
            continue;
        all.x0 = min_i32(all.x0, max_i32(p->x0, area->x0));
        all.x1 = max_i32(all.x1, min_i32(p->x1, area->x1));
        all.y0 = min_i32(all.y0, max_i32(p->y0, area->y0));
        all.y1 = max_i32(all.y1, min_i32(p->y1, area->y1));
    }
    return all;
}

/* ------------------------------------------------------------------ pixels */

enum { RADIUS = 1 << SMEAR_POINT_RADIUS, ONE = 1 << 15 };

/* A point while a part of a row is drawn. */
struct brush {
    uint32_t light[3];          /* of its colour: linear, or codes */
    uint16_t depth;
    bool blends, linear;
};

/* Returns the integral of a dot's light from its middle to v along a chord, q15 radii. `c2`: of half the chord, squared;
 * `half`: the integral to the chord's end. Beyond it the polynomial still grows, so a bound will do. */
static SMEAR_NOINLINE int32_t chord_light(int32_t v, int32_t c2, int32_t half)
{
    if (v >= RADIUS || v <= -RADIUS)
        return v > 0 ? half : -half;
    const int32_t w = v * 4, w2 = w * w >> 15;
    const int32_t light = w * ((c2 * c2 >> 15) - (w2 * ((c2 * 21845 >> 15) - (w2 * 6554 >> 15)) >> 15)) >> 15;
    return clamp_i32(light, -half, half);
}

/* Returns the light of a dot at v along a chord, q30. */
static inline uint32_t dot_light(int32_t v, int32_t c2)
{
    const int32_t q = max_i32(c2 - (v * v >> 11), 0);
    return (uint32_t)q * (uint32_t)q;
}

/* Returns a pixel's share of the light, q15. `u`: along the streak from its start, of a short one from its middle; `d`:
 * across, less than a radius. Over a short one, two places tell the mean (Gauss), and better than a difference of chords. */
static inline uint32_t weight_of(const smear_point_place *p, int32_t u, int32_t d)
{
    const int32_t c2 = (RADIUS * RADIUS - d * d) >> 11;
    int32_t light;
    if (p->length < SMEAR_POINT_SHORT) {
        light = (int32_t)((dot_light(u - p->length, c2) + dot_light(u + p->length, c2)) >> 16);
    } else {
        const int32_t half = ((c2 * c2 >> 15) * smear_sqrt_q3[c2 < ONE ? c2 >> 5 : 1023] >> 8) * 17476 >> 15;
        light = u >= RADIUS && u <= p->length - RADIUS ? 2 * half
                                                       : chord_light(u, c2, half) - chord_light(u - p->length, c2, half);
    }
    return light > 0 ? (uint32_t)light * p->gain >> 16 : 0;
}

static inline uint32_t lit_linear(uint32_t code, uint32_t light, uint32_t weight, bool blends)
{
    const uint32_t was = smear_srgb_decode[code];
    const uint32_t now = was + (uint32_t)((int32_t)(light - (blends ? was : 0)) * (int32_t)weight >> 15);
    return smear_srgb_encode[min_u32(now, 65535u) >> 4];
}

static inline uint32_t lit_code(uint32_t code, uint32_t light, uint32_t weight, bool blends)
{
    const int32_t change = (int32_t)(light - (blends ? code : 0)) * (int32_t)weight;
    return min_u32(code + (uint32_t)((change + (ONE >> 1)) >> 15), 255u);
}

static SMEAR_NOINLINE uint32_t lit(uint32_t pixel, const struct brush *b, uint32_t weight)
{
    const uint32_t r = pixel_red(pixel), g = pixel_green(pixel), bl = pixel_blue(pixel);
    if (SMEAR_WITH_LINEAR && b->linear)
        return pixel_make(0, lit_linear(r, b->light[0], weight, b->blends), lit_linear(g, b->light[1], weight, b->blends),
                          lit_linear(bl, b->light[2], weight, b->blends));
    return pixel_make(0, lit_code(r, b->light[0], weight, b->blends), lit_code(g, b->light[1], weight, b->blends),
                      lit_code(bl, b->light[2], weight, b->blends));
}

/* Draws over pixels [x0, x1) of row y, which are within the point's box; `out` and `depth` are those of column 0. */
static void draw_row(const smear_point_place *p, const struct brush *b, uint32_t *out, const uint16_t *depth, int32_t x0,
                     int32_t x1, int32_t y)
{
    const int32_t dx = x0 * 256 + 128 - p->x, dy = y * 256 + 128 - p->y, step = -p->along_y;
    int32_t u = add_wrap(mul_wrap(dx, p->along_x), mul_wrap(dy, p->along_y)) >> 8;
    int32_t d = sub_wrap(mul_wrap(dy, p->along_x), mul_wrap(dx, p->along_y)) >> 8;
    int32_t x = x0;
    if (d >= RADIUS ? step < 0 : d <= -RADIUS && step > 0)          /* the row reaches the streak further on */
        for (; x < x1 && (d >= RADIUS || d <= -RADIUS); x++, u += p->along_x)
            d += step;
    for (; x < x1 && d < RADIUS && d > -RADIUS; x++, u += p->along_x, d += step) {
        const uint32_t weight = depth[x] <= b->depth ? weight_of(p, u, d) : 0;
        if (weight != 0)
            out[x] = lit(out[x], b, weight);
    }
}

void smear_points_draw(const struct smear_rows *rows, uint32_t *out, const uint16_t *depth, int32_t x0, int32_t x1, int32_t y)
{
    const bool linear = frame_is_linear(&rows->raster);
    for (uint32_t i = rows->points; i != SMEAR_NO_POINT;) {
        const smear_point *point = &rows->overlay->points->point[i];
        const smear_point_place *p = &point->place;
        const int32_t first = max_i32(x0, p->x0), end = min_i32(x1, p->x1);
        i = p->next;
        if (first >= end || y < p->y0 || y >= p->y1)
            continue;
        struct brush b = { .depth = p->depth, .blends = point->mode != SMEAR_POINT_ADD, .linear = linear };
        for (int k = 0; k < 3; k++)
            b.light[k] = SMEAR_WITH_LINEAR && linear ? smear_srgb_decode[point->color[k]] : point->color[k];
        draw_row(p, &b, out - x0, depth - x0, first, end, y);
    }
}

void smear_points_draw_window(struct smear_rows *rows, int row)
{
    struct smear_raster_target t;
    smear_row_target(rows, row, &t);
    smear_points_list(rows, t.y0, t.y1);
    for (int32_t y = t.y0; y < t.y1 && rows->points != SMEAR_NO_POINT; y++) {
        const int32_t at = target_row(&t.window_rows, &t, y);
        smear_points_draw(rows, t.color + at, t.depth + at, 0, t.x1, y);
    }
}

#endif
