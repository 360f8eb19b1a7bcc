/* SPDX-License-Identifier: MIT */
/* points.c - see overlay.h. Lengths along and across a streak are in radii of its dot, q13; weights of pixels, at most one,
 * in q15. */
#include "overlay/overlay.h"

#include "base/fixmath.h"

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

bool smear_points_listed(const struct smear_rows *rows, int32_t *x0, int32_t *x1)
{
    int32_t left = *x1, right = *x0;
    for (uint32_t i = rows->points; i != SMEAR_NO_POINT; i = place_of(rows, i)->next) {
        const int32_t from = max_i32(place_of(rows, i)->x0, *x0), to = min_i32(place_of(rows, i)->x1, *x1);
        left = from < to ? min_i32(left, from) : left;
        right = from < to ? max_i32(right, to) : right;
    }
    *x0 = left;
    *x1 = right;
    return left < right;
}

/* ------------------------------------------------------------------ pixels */

enum {
    RADIUS = 1 << SMEAR_POINT_RADIUS,
    WEIGHTS = 128, /* pixels that are weighed at once, and rows of them */
    RUNS = 16
};

/* Pixels of a row that a streak is seen in. */
struct run {
    int16_t x, count;
};

/* A part of a point's box while it is drawn: what pixels weigh, and what is made of that. */
struct brush {
    int32_t u, d;                /* of the next row's first pixel: along the streak from its middle, and across */
    int32_t along, step;         /* from pixel to pixel: u goes on, and d back, the side of which is chosen so */
    int32_t row_along, row_step; /* from row to row both go on */
    int32_t radius;              /* of a dot: one */
    int32_t length, reach;       /* of the streak's half; how far from its middle line something is seen */
    uint32_t gain;
    int32_t columns, rows; /* of the part; rows are left */
    uint32_t *out;         /* the next row's pixels and depths, and from row to row */
    const uint16_t *depth;
    int32_t pitch, depth_pitch;
    uint32_t light[3];        /* of its colour, linear */
    uint32_t red_blue, green; /* codes: two as in a pixel, one alone */
    uint32_t nearest;         /* depth code */
    bool blends, linear;
    struct run run[RUNS];
    uint16_t weight[WEIGHTS]; /* of all runs, q15 */
};

/* Whether there is room for another run. */
static inline bool has_room(const struct brush *b, const struct run *run, const uint16_t *weight)
{
    return run < b->run + RUNS && weight + b->columns <= b->weight + WEIGHTS;
}

/* Returns the pixels that are left of n when those beyond the reach of the streak are left out. */
static inline int32_t skip_to_streak(int32_t n, int32_t d, int32_t reach, int32_t step)
{
    if (d >= reach && step == 0)
        return 0;
    for (; d >= reach && n > 0; n--)
        d -= step;
    return d > -reach ? n : 0;
}

/* Returns what a pixel that sees both ends of a streak gets of a chord's light, less the gain. */
static SMEAR_RARE uint32_t between_ends(uint32_t chord, int32_t near, int32_t far)
{
    const int32_t per_chord = (int32_t)(chord >> 16);
    const int32_t k = ((near >> 4) * per_chord >> 10) + 128, m = ((far >> 4) * per_chord >> 10) + 128;
    const int32_t from = m > 255 ? 0 : 65536 - smear_streak_end[m], to = k < 0 ? 0 : k > 255 ? 65536
                                                                                             : smear_streak_end[k];
    return (chord & 0xffff) * (uint32_t)max_i32(to - from, 0) >> 16;
}

/* What weights of a row depend on: as in struct brush. */
struct stroke {
    int32_t along, step, length, reach, radius;
    uint32_t gain;
};

/* Finds weights of n pixels of a row of a long streak, from (u, d) on: all of the light that a dot has on a chord is there
 * between the ends, and near an end the part that depends on how many halves of the chord the end is away. Returns where
 * they end. */
SMEAR_INLINE uint16_t *weigh_row_long(const struct stroke *k, uint16_t *weight, int32_t n, int32_t u, int32_t d)
{
    const uint16_t *const end = weight + n;
    while (weight != end) {
        const int32_t across = abs_i32(d), away = abs_i32(u), near = k->length - away;
        if (across >= k->reach)
            break;
        const uint32_t chord = smear_streak_across[across >> (SMEAR_POINT_RADIUS - 7)];
        uint32_t light = chord & 0xffff;
        if (near < k->radius) {
            const uint32_t part = (uint32_t)(((near >> 4) * (int32_t)(chord >> 16) >> 10) + 128);
            if (k->length < k->radius)
                light = between_ends(chord, near, k->length + away);
            else if (part <= 255)
                light = light * smear_streak_end[part] >> 16;
            else if ((int32_t)part < 0)
                light = 0;
        }
        *weight++ = (uint16_t)min_u32(light * k->gain >> 16, 32768);
        u += k->along;
        d -= k->step;
    }
    return weight;
}

/* Returns the light of a dot at v along a chord, q30. */
static inline uint32_t dot_light(int32_t v, int32_t c2)
{
    const int32_t q = max_i32(c2 - (mul_wrap(v, v) >> 11), 0);
    return (uint32_t)q * (uint32_t)q;
}

/* The same of a short one, over which two places tell the mean (Gauss), and better than a difference. */
SMEAR_INLINE uint16_t *weigh_row_short(const struct stroke *k, uint16_t *weight, int32_t n, int32_t u, int32_t d)
{
    const uint16_t *const end = weight + n;
    while (weight != end) {
        const int32_t square = RADIUS * RADIUS - 1 - d * d, c2 = square >> 11;
        if (square < 0)
            break;
        *weight++ = (uint16_t)(((dot_light(u - k->length, c2) + dot_light(u + k->length, c2)) >> 16) * k->gain >> 16);
        u += k->along;
        d -= k->step;
    }
    return weight;
}

/* Finds weights of the next rows' pixels that a streak is seen in. Returns the number of runs. */
SMEAR_INLINE int32_t weigh(struct brush *b, bool is_long)
{
    const struct stroke k = { b->along, b->step, b->length, is_long ? b->reach : RADIUS, b->radius, b->gain };
    const int32_t columns = b->columns;
    const int32_t row_along = b->row_along, row_step = b->row_step;
    struct run *run = b->run;
    uint16_t *weight = b->weight;
    int32_t row_u = b->u, row_d = b->d, rows = b->rows;
    do {
        const int32_t n = skip_to_streak(columns, row_d, k.reach, k.step), x = columns - n;
        const int32_t u = row_u + x * k.along, d = row_d - x * k.step;
        uint16_t *const first = weight;
        weight = is_long ? weigh_row_long(&k, first, n, u, d) : weigh_row_short(&k, first, n, u, d);
        *run++ = (struct run){ (int16_t)x, (int16_t)(weight - first) };
        row_u += row_along;
        row_d += row_step;
    } while (--rows > 0 && has_room(b, run, weight));
    b->u = row_u;
    b->d = row_d;
    b->rows = rows;
    return (int32_t)(run - b->run);
}

static SMEAR_RARE int32_t weigh_long(struct brush *b) { return weigh(b, true); }

static SMEAR_RARE int32_t weigh_short(struct brush *b) { return weigh(b, false); }

static inline uint32_t lit_linear(uint32_t code, uint32_t light, uint32_t weight, bool blends)
{
    const uint32_t was = smear_srgb_decode[code];
    const uint32_t now = was + (uint32_t)((int32_t)(light - (blends ? was : 0)) * (int32_t)weight >> 15);
    return smear_srgb_encode[min_u32(now, 65535u) >> 4];
}

/* Codes are added and blended two channels at once: fields of eight bits with eight of room above each. */
enum { TWO = 0xff00ff,
       HALVES = 0x800080,
       BEYOND = 0x1010100 };

/* Returns a pixel with light added. What is beyond a channel's most shows in the bit above it. */
SMEAR_INLINE uint32_t added(uint32_t was, uint32_t red_blue, uint32_t green, uint32_t part)
{
    const uint32_t more = ((red_blue * part + HALVES) >> 8 & TWO) | ((green * part + 128) & 0xff00), sum = was + more;
    const uint32_t over = (was ^ more ^ sum) & BEYOND;
    return over != 0 ? (sum - over) | (over - (over >> 8)) : sum;
}

SMEAR_INLINE uint32_t blended(uint32_t was, uint32_t red_blue, uint32_t green, uint32_t part)
{
    const uint32_t old = 256 - part;
    return (((was & TWO) * old + red_blue * part + HALVES) >> 8 & TWO) | (((was >> 8 & 255) * old + green * part + 128) & 0xff00);
}

enum way { ADDS, BLENDS, LIGHTS };

/* Draws runs of weighed pixels over what is not nearer. */
SMEAR_INLINE void draw_runs(const struct brush *b, int32_t runs, enum way way)
{
    const uint32_t red_blue = b->red_blue, green = b->green, nearest = b->nearest;
    const uint16_t *weight = b->weight, *row_depth = b->depth;
    uint32_t *row = b->out;
    for (const struct run *run = b->run, *const last = run + runs; run < last; run++, row += b->pitch, row_depth += b->depth_pitch) {
        const uint16_t *depth = row_depth + run->x;
        uint32_t *out = row + run->x;
        for (const uint16_t *const end = weight + run->count; weight != end; out++, depth++) {
            const uint32_t full = *weight++, part = way == LIGHTS ? full : (full + 64) >> 7;
            if (part == 0 || *depth > nearest)
                continue;
            const uint32_t was = *out;
            *out = way == ADDS     ? added(was, red_blue, green, part)
                 : way == BLENDS ? blended(was, red_blue, green, part)
                                 : pixel_make(0, lit_linear(pixel_red(was), b->light[0], part, b->blends),
                                              lit_linear(pixel_green(was), b->light[1], part, b->blends),
                                              lit_linear(pixel_blue(was), b->light[2], part, b->blends));
        }
    }
}

static SMEAR_NOINLINE void add_runs(const struct brush *b, int32_t runs) { draw_runs(b, runs, ADDS); }

static SMEAR_NOINLINE void blend_runs(const struct brush *b, int32_t runs) { draw_runs(b, runs, BLENDS); }

static SMEAR_NOINLINE void light_runs(const struct brush *b, int32_t runs) { draw_runs(b, runs, LIGHTS); }

static void draw_part(struct brush *b)
{
    do {
        const int32_t runs = b->length >= SMEAR_POINT_SHORT ? weigh_long(b) : weigh_short(b);
        if (SMEAR_WITH_LINEAR && b->linear)
            light_runs(b, runs);
        else if (b->blends)
            blend_runs(b, runs);
        else
            add_runs(b, runs);
        b->out += runs * b->pitch;
        b->depth += runs * b->depth_pitch;
    } while (b->rows > 0);
}

/* How far across a long streak something is seen in codes, in 1/128 radii, of a gain below 2^8 and more. */
static const uint8_t seen_across[10] = { 63, 84, 96, 105, 111, 115, 118, 121, 123, 124 };

static void make_brush(struct brush *b, const smear_point *point, bool linear)
{
    const smear_point_place *p = &point->place;
    b->along = p->along_x;
    b->row_along = p->along_y;
    b->step = abs_i32(p->along_y);
    b->row_step = p->along_y < 0 ? -p->along_x : p->along_x;
    b->length = p->length;
    b->gain = p->gain;
    b->reach = b->radius = RADIUS;
    b->linear = linear;
    b->nearest = p->depth;
    b->blends = point->mode != SMEAR_POINT_ADD;
    b->red_blue = (uint32_t)point->color[0] << 16 | point->color[2];
    b->green = point->color[1];
    for (int k = 0; SMEAR_WITH_LINEAR && linear && k < 3; k++)
        b->light[k] = smear_srgb_decode[point->color[k]];
    if (!linear && p->length >= SMEAR_POINT_SHORT) {
        const int size = 24 - count_leading_zeros(p->gain | 1);
        if (size < 10)
            b->reach = size < 0 ? 0 : seen_across[size] << (SMEAR_POINT_RADIUS - 7);
    }
}

/* Returns how many rows of a plane lie one after the other from row y on. */
static inline int32_t rows_from(const struct smear_plane_rows *rows, const struct smear_raster_target *t, int32_t y)
{
    const int32_t row = rows->ring_row + (y - t->y0);
    return rows->ring - (row >= rows->ring ? row - rows->ring : row);
}

/* Draws a point over pixels of a box. */
static void draw_point(struct brush *b, const smear_point_place *p, const struct smear_raster_target *t,
                       const struct overlay_box *box)
{
    for (int32_t y = box->y0, rows; y < box->y1; y += rows) {
        rows = min_i32(box->y1 - y, min_i32(rows_from(&t->color_rows, t, y), rows_from(&t->window_rows, t, y)));
        for (int32_t x = box->x0; x < box->x1; x += WEIGHTS) {
            const int32_t dx = x * 256 + 128 - p->x, dy = y * 256 + 128 - p->y;
            b->u = add_wrap(mul_wrap(dx, b->along), mul_wrap(dy, b->row_along)) >> 8;
            b->d = sub_wrap(mul_wrap(dy, b->row_step), mul_wrap(dx, b->step)) >> 8;
            b->columns = min_i32(box->x1 - x, WEIGHTS);
            b->rows = rows;
            b->out = t->color + target_row(&t->color_rows, t, y) + x;
            b->depth = t->depth + target_row(&t->window_rows, t, y) + x;
            draw_part(b);
        }
    }
}

void smear_points_draw(const struct smear_rows *rows, const struct smear_raster_target *t, const struct overlay_box *area)
{
    struct brush b;
    b.pitch = t->color_rows.stride;
    b.depth_pitch = t->window_rows.stride;
    for (uint32_t i = rows->points; i != SMEAR_NO_POINT;) {
        const smear_point *point = &rows->overlay->points->point[i];
        const smear_point_place *p = &point->place;
        const struct overlay_box box = { max_i32(area->x0, p->x0), max_i32(area->y0, p->y0), min_i32(area->x1, p->x1),
                                         min_i32(area->y1, p->y1) };
        i = p->next;
        if (box.x0 >= box.x1 || box.y0 >= box.y1)
            continue;
        make_brush(&b, point, frame_is_linear(&rows->raster));
        draw_point(&b, p, t, &box);
    }
}

void smear_points_draw_window(struct smear_rows *rows, int row)
{
    struct smear_raster_target t;
    smear_row_target(rows, row, &t);
    const struct overlay_box area = { 0, t.y0, t.x1, t.y1 };
    smear_points_list(rows, t.y0, t.y1);
    smear_points_draw(rows, &t, &area);
}

#endif
