/* SPDX-License-Identifier: MIT */
/* points.c - see points.h. Lengths along and across a streak are in radii of its dot, q13; weights in q15 and q16,
 * those of pixels at most one. */
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

enum { RADIUS = 1 << SMEAR_POINT_RADIUS };

/* A point while a part of a row is drawn. */
struct brush {
    uint32_t light[3];        /* of its colour, linear */
    uint32_t red_blue, green; /* codes: two as in a pixel, one alone */
    uint16_t depth;
    bool blends, linear;
};

/* Returns 15/16 of the integral of a dot's light from its middle to v along a chord, q15 radii, for |v| less than a radius.
 * `c2`: of half the chord, squared, and `c4` its square; `half`: the integral to the chord's end. Beyond it the polynomial
 * still grows, so a bound will do. */
static inline int32_t chord_light(int32_t v, int32_t c2, int32_t c4, int32_t half)
{
    const int32_t w = v * 4, w2 = w * w >> 15;
    const int32_t light = w * (c4 - (c4 >> 4) - (w2 * ((10 * c2 - 3 * w2) >> 4) >> 15)) >> 15;
    return clamp_i32(light, -half, half);
}

/* Does so for a streak of less than two radii, which a pixel sees both ends of. */
static SMEAR_NOINLINE int32_t other_chord(int32_t v, int32_t c2, int32_t c4, int32_t half)
{
    return chord_light(v, c2, c4, half);
}

/* Returns the light of a dot at v along a chord, q30. */
static inline uint32_t dot_light(int32_t v, int32_t c2)
{
    const int32_t q = max_i32(c2 - (v * v >> 11), 0);
    return (uint32_t)q * (uint32_t)q;
}

/* Returns what the point's gain makes a pixel's share of the light. `u`: along the streak from its start, of a short one from
 * its middle; `d`: across, less than a radius. Over a short one, two places tell the mean (Gauss), and better than a
 * difference of chords. */
static inline uint32_t light_of(int32_t length, int32_t u, int32_t d)
{
    const int32_t c2 = (RADIUS * RADIUS - 1 - d * d) >> 11;
    if (length < SMEAR_POINT_SHORT)
        return (dot_light(u - length, c2) + dot_light(u + length, c2)) >> 16;
    const int32_t c4 = c2 * c2 >> 15, whole = c4 * smear_sqrt_q3[c2 >> 5] >> 8, half = whole >> 1;
    const int32_t near = min_i32(u, length - u), far = length - near; /* from the ends */
    if (near >= RADIUS)
        return (uint32_t)whole;
    if (near <= -RADIUS)
        return 0;
    const int32_t light = chord_light(near, c2, c4, half) + (far >= RADIUS ? half : other_chord(far, c2, c4, half));
    return (uint32_t)max_i32(light, 0);
}

static inline uint32_t lit_linear(uint32_t code, uint32_t light, uint32_t weight, bool blends)
{
    const uint32_t was = smear_srgb_decode[code];
    const uint32_t now = was + (uint32_t)((int32_t)(light - (blends ? was : 0)) * (int32_t)weight >> 15);
    return smear_srgb_encode[min_u32(now, 65535u) >> 4];
}

/* Two channels at once: fields of eight bits with eight of room above each. */
static inline uint32_t lit_codes(uint32_t pixel, const struct brush *b, uint32_t weight)
{
    enum { TWO = 0xff00ff,
           HALVES = 0x800080,
           BEYOND = 0x1000100 };
    const uint32_t part = min_u32((weight + 64) >> 7, 256), old = b->blends ? 256 - part : 256;
    uint32_t rb = pixel & TWO, g = pixel >> 8 & 255;
    if (b->blends) {
        rb = (rb * old + b->red_blue * part + HALVES) >> 8 & TWO;
        return rb | ((g * old + b->green * part + 128) & 0xff00);
    }
    rb += (b->red_blue * part + HALVES) >> 8 & TWO;
    g += (b->green * part + 128) >> 8;
    if (((rb | g) & BEYOND) == 0)
        return rb | g << 8;
    rb |= (rb & BEYOND) - ((rb & BEYOND) >> 8);
    return (rb & TWO) | min_u32(g, 255) << 8;
}

static inline uint32_t lit(uint32_t pixel, const struct brush *b, uint32_t weight)
{
    if (SMEAR_WITH_LINEAR && b->linear)
        return pixel_make(0, lit_linear(pixel_red(pixel), b->light[0], weight, b->blends),
                          lit_linear(pixel_green(pixel), b->light[1], weight, b->blends),
                          lit_linear(pixel_blue(pixel), b->light[2], weight, b->blends));
    return lit_codes(pixel, b, weight);
}

/* Draws over n pixels of row y, from x on, which are within the point's box. */
static void draw_row(const smear_point_place *p, const struct brush *b, uint32_t *out, const uint16_t *depth, int32_t n, int32_t x,
                     int32_t y)
{
    enum { INSIDE = 2 * RADIUS - 1 };
    const int32_t dx = x * 256 + 128 - p->x, dy = y * 256 + 128 - p->y, along = p->along_x, step = p->along_y;
    const int32_t length = p->length;
    const uint32_t gain = p->gain, *const end = out + n;
    int32_t u = add_wrap(mul_wrap(dx, along), mul_wrap(dy, step)) >> 8;
    int32_t d = sub_wrap(mul_wrap(dy, along), mul_wrap(dx, step)) >> 8;
    if (d >= RADIUS ? step > 0 : d <= -RADIUS && step < 0) /* the row reaches the streak further on */
        for (; out < end && (uint32_t)(d + RADIUS - 1) >= INSIDE; out++, depth++, u += along)
            d -= step;
    for (; out < end && (uint32_t)(d + RADIUS - 1) < INSIDE; out++, depth++, u += along, d -= step) {
        if (*depth > b->depth)
            continue;
        const uint32_t weight = light_of(length, u, d) * gain >> 16;
        if (weight != 0)
            *out = lit(*out, b, weight);
    }
}

void smear_points_draw(const struct smear_rows *rows, uint32_t *out, const uint16_t *depth, int32_t x0, int32_t x1, int32_t y)
{
    struct brush b;
    b.linear = frame_is_linear(&rows->raster);
    for (uint32_t i = rows->points; i != SMEAR_NO_POINT;) {
        const smear_point *point = &rows->overlay->points->point[i];
        const smear_point_place *p = &point->place;
        i = p->next;
        if (y < p->y0 || y >= p->y1)
            continue;
        const int32_t first = max_i32(x0, p->x0), n = min_i32(x1, p->x1) - first;
        if (n <= 0)
            continue;
        b.depth = p->depth;
        b.blends = point->mode != SMEAR_POINT_ADD;
        b.red_blue = (uint32_t)point->color[0] << 16 | point->color[2];
        b.green = point->color[1];
        for (int k = 0; SMEAR_WITH_LINEAR && k < 3; k++)
            b.light[k] = b.linear ? smear_srgb_decode[point->color[k]] : 0;
        draw_row(p, &b, out + (first - x0), depth + (first - x0), n, first, y);
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
