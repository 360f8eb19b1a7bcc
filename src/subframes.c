/* SPDX-License-Identifier: MIT */
/* subframes.c - a tile's own moving triangles drawn again at several instants.
 *
 * Where no mover is at an instant, the tile looks as it does without movers: that picture (still surfaces, still blended
 * draws over them) is made once, and weighs for all instants that say nothing else. At each instant only the box
 * around the movers is drawn, summed and made still again. */
#include "subframes.h"

#include "fixmath.h"
#include "pixel.h"
#include "raster.h"
#include "shutter.h"
#include "transform.h"

enum {
    LISTED = 128,           /* triangles of the tile that are remembered; others are looked for at each instant */
    PACKED_MAX = 257,       /* instants whose codes add up in 16 bits */
    RECORD_WORDS = VERTEX_BASE_WORDS + 3        /* without the path, which comes last */
};

/* Pixels [x0, x1) x [y0, y1). */
struct box {
    int32_t x0, y0, x1, y1;
};

static const struct box no_box = { INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN };

static inline void box_add(struct box *b, const struct box *add)
{
    b->x0 = min_i32(b->x0, add->x0);
    b->y0 = min_i32(b->y0, add->y0);
    b->x1 = max_i32(b->x1, add->x1);
    b->y1 = max_i32(b->y1, add->y1);
}

static inline bool box_is_empty(const struct box *b)
{
    return b->x0 >= b->x1 || b->y0 >= b->y1;
}

/* sum / n to nearest: (sum + n / 2) times 2^(27 + log) / n, rounded up. Exact for sums below 2^27. */
struct mean {
    uint32_t n, half, factor;
    int shift;
};

struct subframes {
    const struct smear_moving_tile *t;
    struct smear_raster_target work;    /* the tile at an instant: finished pixels, depth of its own */
    uint32_t *sum;              /* packed: red and blue, green and times. Else: red, green, blue */
    uint16_t *times;            /* instants in the sum */
    bool packed;
    bool blends;                /* blended draws change what is still, too */
    struct mean mean;

    /* What may be seen in the tile. Those beyond are found by walking on from here. */
    uint32_t *listed;           /* movers, then blended triangles */
    uint32_t movers_listed, all_listed;
    uint32_t mover_rest, blend_rest;
    uint32_t lowest;            /* smallest depth code of what is still */
};

size_t smear_subframes_work(int32_t tile)
{
    return (size_t)(tile * tile) * (3 * sizeof(uint32_t) + 2 * sizeof(uint16_t)) + LISTED * sizeof(uint32_t);
}

static struct mean mean_make(uint32_t n)
{
    int log = n > 1 ? 32 - count_leading_zeros(n - 1) : 0;
    uint32_t whole = (1u << 27) / n, rest = (1u << 27) % n;     /* rest 2^log < 2^20 */
    uint32_t factor = (whole << log) + ((rest << log) + n - 1) / n;
    return (struct mean){ n, n >> 1, factor << 4, log + 4 };
}

static inline uint32_t mean_of(const struct mean *m, uint32_t sum)
{
    return mulh_u32((sum + m->half) << 5, m->factor) >> m->shift;
}

/* ------------------------------------------------------------------ what is still */

static inline int32_t still_row(const struct smear_raster_target *s, const struct smear_plane_rows *rows, int32_t y)
{
    int32_t slot = rows->slot0 + (y - s->y0);
    return (slot >= rows->ring ? slot - rows->ring : slot) * rows->stride - rows->x0;
}

/* Index of the first of the box's pixels in row y of the work planes. */
static inline int32_t work_row(const struct subframes *f, const struct box *b, int32_t y)
{
    return (y - f->t->still.y0) * f->t->tile + (b->x0 - f->t->still.x0);
}

static void restore_depth(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    for (int32_t y = b->y0; y < b->y1; y++)
        __builtin_memcpy(f->work.depth + work_row(f, b, y), s->depth + still_row(s, &s->window_rows, y) + b->x0,
                         (size_t)(b->x1 - b->x0) * sizeof *s->depth);
}

static void copy_color(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    for (int32_t y = b->y0; y < b->y1; y++)
        __builtin_memcpy(f->work.color + work_row(f, b, y), s->color + still_row(s, &s->color_rows, y) + b->x0,
                         (size_t)(b->x1 - b->x0) * sizeof *s->color);
}

static uint32_t lowest_depth(const struct smear_raster_target *s)
{
    uint32_t low = UINT16_MAX;
    for (int32_t y = s->y0; y < s->y1; y++) {
        const uint16_t *depth = s->depth + still_row(s, &s->window_rows, y);
        for (int32_t x = s->x0; x < s->x1; x++)
            low = min_u32(low, depth[x]);
    }
    return low;
}

/* ------------------------------------------------------------------ triangles at an instant */

/* A triangle with its vertices at an instant. */
struct posed {
    const struct smear_segment *segment;
    uint32_t color;
    const int32_t *v[3];
    struct box box;             /* within the tile */
    int32_t record[3][RECORD_WORDS];
};

struct range {
    int32_t low, high;
};

static inline struct range range_of(int32_t a, int32_t b, int32_t c)
{
    return (struct range){ min_i32(a, min_i32(b, c)), max_i32(a, max_i32(b, c)) };
}

/* Pixels of [low, high) whose centres may lie in a range of q8. */
static inline struct range pixels_of(struct range r, int32_t low, int32_t high)
{
    return (struct range){ max_i32((r.low + 127) >> 8, low), min_i32((r.high + 127) >> 8, high) };
}

/* Coordinate VERTEX_X or VERTEX_Y of all three. Between places within the guard band a parabola may leave it. */
static inline struct range place(struct posed *p, int axis, int32_t u, int32_t middle)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    const int open = p->segment->motion + axis;
    for (int i = 0; i < 3; i++)
        p->record[i][axis] = path_coordinate(p->v[i][open], p->v[i][axis], p->v[i][open + PATH_POSE_WORDS], u);
    struct range r = range_of(p->record[0][axis], p->record[1][axis], p->record[2][axis]);
    if (r.low < middle - guard || r.high > middle + guard)
        for (int i = 0; i < 3; i++)
            p->record[i][axis] = clamp_i32(p->record[i][axis], middle - guard, middle + guard);
    return r;
}

/* False where the triangle is not seen in the tile at this time: elsewhere, or turned away. */
static bool pose(struct posed *p, const struct subframes *f, uint32_t triangle, int32_t time)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const struct smear_triangle *t = geometry_triangle(frame->geometry, triangle);
    const struct smear_segment *s = &frame->geometry->segment[t->segment];
    const struct smear_raster_target *tile = &f->t->still;
    p->segment = s;
    p->color = t->color;
    if (s->path && !path_piece_time(&time, geometry_bounds(frame->geometry, triangle)->piece))
        return false;
    for (int i = 0; i < 3; i++)
        p->v[i] = geometry_vertex(frame->geometry, s, t->vertex[i]);
    const int32_t u = path_phase(time);
    struct range x = s->path ? place(p, VERTEX_X, u, frame->width << 7)
                             : range_of(p->v[0][VERTEX_X], p->v[1][VERTEX_X], p->v[2][VERTEX_X]);
    x = pixels_of(x, tile->x0, tile->x1);
    if (x.low >= x.high)
        return false;
    struct range y = s->path ? place(p, VERTEX_Y, u, frame->height << 7)
                             : range_of(p->v[0][VERTEX_Y], p->v[1][VERTEX_Y], p->v[2][VERTEX_Y]);
    y = pixels_of(y, tile->y0, tile->y1);
    if (y.low >= y.high)
        return false;
    p->box = (struct box){ x.low, y.low, x.high, y.high };
    if (!s->path)
        return true;
    int32_t *a = p->record[0], *b = p->record[1], *c = p->record[2];
    if ((int64_t)(b[VERTEX_X] - a[VERTEX_X]) * (c[VERTEX_Y] - a[VERTEX_Y])
        <= (int64_t)(c[VERTEX_X] - a[VERTEX_X]) * (b[VERTEX_Y] - a[VERTEX_Y]))
        return false;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = p->v[i], *open = v + s->motion, *close = open + PATH_POSE_WORDS;
        int32_t depth = path_depth(open[PATH_DEPTH], v[VERTEX_DEPTH], close[PATH_DEPTH], u);
        p->record[i][VERTEX_DEPTH] = clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
        for (int k = VERTEX_BASE_WORDS; k < s->motion; k++)
            p->record[i][k] = v[k];
        p->v[i] = p->record[i];
    }
    return true;
}

static inline void draw(const struct posed *p, const struct subframes *f, const struct smear_raster_target *target)
{
    smear_raster_triangle(f->t->frame, target, p->segment, p->color, p->v);
}

/* ------------------------------------------------------------------ lists of the tile */

static inline bool is_seen(const struct subframes *f, const struct smear_mover *m)
{
    return mover_is_in(m, f->t->column) && m->nearest > f->lowest;
}

/* The triangle may touch the tile at some time. */
static bool touches(const struct subframes *f, uint32_t triangle)
{
    const struct smear_geometry *g = f->t->frame->geometry;
    const struct smear_raster_target *tile = &f->t->still;
    if (!g->segment[geometry_triangle(g, triangle)->segment].path) {
        struct posed p;
        return pose(&p, f, triangle, 0);
    }
    const struct smear_path_bounds *b = geometry_bounds(g, triangle);
    return b->x0 < tile->x1 && b->x1 > tile->x0 && b->y0 < tile->y1 && b->y1 > tile->y0;
}

/* Lists what may be seen. True when something moves. */
static bool list(struct subframes *f)
{
    const struct smear_moving_tile *t = f->t;
    const struct smear_geometry *g = t->frame->geometry;
    uint32_t n = 0;
    bool moves = false;
    f->lowest = t->mover_count != 0 ? lowest_depth(&t->still) : 0;
    for (f->mover_rest = 0; f->mover_rest < t->mover_count && n < LISTED; f->mover_rest++)
        if (is_seen(f, &t->mover[f->mover_rest]))
            f->listed[n++] = t->mover[f->mover_rest].triangle;
    moves = n != 0;
    f->movers_listed = n;
    f->blends = t->blend != SMEAR_NO_TRIANGLE && n == LISTED;
    for (f->blend_rest = t->blend; f->blend_rest != SMEAR_NO_TRIANGLE && n < LISTED;) {
        const struct smear_triangle *b = geometry_triangle(g, f->blend_rest);
        if (touches(f, f->blend_rest)) {
            f->listed[n++] = f->blend_rest;
            f->blends = true;
            moves = moves || g->segment[b->segment].path;
        }
        f->blend_rest = b->next;
    }
    f->all_listed = n;
    return moves || f->blend_rest != SMEAR_NO_TRIANGLE;
}

/* ------------------------------------------------------------------ instants */

static void draw_mover(const struct subframes *f, uint32_t triangle, int32_t time, struct box *all)
{
    struct posed p;
    if (pose(&p, f, triangle, time)) {
        draw(&p, f, &f->work);
        box_add(all, &p.box);
    }
}

static void draw_movers(const struct subframes *f, int32_t time, struct box *all)
{
    for (uint32_t i = 0; i < f->movers_listed; i++)
        draw_mover(f, f->listed[i], time, all);
    for (uint32_t i = f->mover_rest; i < f->t->mover_count; i++)
        if (is_seen(f, &f->t->mover[i]))
            draw_mover(f, f->t->mover[i].triangle, time, all);
}

enum blend_pass {
    BLEND_BOX,          /* finds where moving ones are */
    BLEND_ALL,          /* draws */
    BLEND_STILL         /* draws what is still */
};

static void blend_one(const struct subframes *f, uint32_t triangle, int32_t time, enum blend_pass pass,
                      const struct smear_raster_target *target, struct box *all)
{
    const struct smear_geometry *g = f->t->frame->geometry;
    bool moves = g->segment[geometry_triangle(g, triangle)->segment].path;
    struct posed p;
    if ((pass == BLEND_BOX && !moves) || (pass == BLEND_STILL && moves) || !pose(&p, f, triangle, time))
        return;
    if (pass == BLEND_BOX)
        box_add(all, &p.box);
    else
        draw(&p, f, target);
}

static void blend(const struct subframes *f, int32_t time, enum blend_pass pass,
                  const struct smear_raster_target *target, struct box *all)
{
    for (uint32_t i = f->movers_listed; i < f->all_listed; i++)
        blend_one(f, f->listed[i], time, pass, target, all);
    for (uint32_t i = f->blend_rest; i != SMEAR_NO_TRIANGLE; i = geometry_triangle(f->t->frame->geometry, i)->next)
        blend_one(f, i, time, pass, target, all);
}

/* The work planes within a box. */
static struct smear_raster_target within(const struct subframes *f, const struct box *b)
{
    struct smear_raster_target t = f->work;
    t.color_rows.slot0 = t.window_rows.slot0 = b->y0 - t.y0;
    t.x0 = b->x0;
    t.y0 = b->y0;
    t.x1 = b->x1;
    t.y1 = b->y1;
    return t;
}

/* Draws everything that moves, and what is blended over it; returns where. */
static struct box draw_instant(const struct subframes *f, int32_t time)
{
    struct box all = no_box;
    draw_movers(f, time, &all);
    if (!f->blends)
        return all;
    blend(f, time, BLEND_BOX, NULL, &all);
    if (!box_is_empty(&all)) {
        struct smear_raster_target target = within(f, &all);
        blend(f, time, BLEND_ALL, &target, NULL);
    }
    return all;
}

/* ------------------------------------------------------------------ sums */

static inline uint32_t value_of(uint32_t code, bool linear)
{
    return linear ? smear_srgb_decode[code] : code;
}

/* Adds the box and makes it still again. What looks still need not be counted: it is what the rest of the mean is made
 * of. */
static void add_packed(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    const uint32_t all = f->blends;
    for (int32_t y = b->y0; y < b->y1; y++) {
        int32_t at = work_row(f, b, y), n = b->x1 - b->x0;
        const uint32_t *still = s->color + still_row(s, &s->color_rows, y) + b->x0;
        uint32_t *p = f->work.color + at, *sum = f->sum + 2 * at;
        for (int32_t i = 0; i < n; i++, sum += 2) {
            uint32_t c = p[i], behind = still[i];
            if (((c ^ behind) | all) != 0) {
                sum[0] += c & 0xff00ffu;
                sum[1] += (c >> 8 & 0xffu) + 0x10000u;
                p[i] = behind;
            }
        }
    }
}

static void add(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    const bool linear = frame_is_linear(f->t->frame);
    const uint32_t all = f->blends;
    for (int32_t y = b->y0; y < b->y1; y++) {
        int32_t at = work_row(f, b, y), n = b->x1 - b->x0;
        const uint32_t *still = s->color + still_row(s, &s->color_rows, y) + b->x0;
        uint32_t *p = f->work.color + at, *sum = f->sum + 3 * at;
        uint16_t *times = f->times + at;
        for (int32_t i = 0; i < n; i++, sum += 3) {
            uint32_t c = p[i], behind = still[i];
            if (((c ^ behind) | all) != 0) {
                sum[0] += value_of(pixel_red(c), linear);
                sum[1] += value_of(pixel_green(c), linear);
                sum[2] += value_of(pixel_blue(c), linear);
                times[i]++;
                p[i] = behind;
            }
        }
    }
}

static uint32_t mixed(const struct subframes *f, int32_t at, uint32_t still)
{
    const struct mean *m = &f->mean;
    if (f->packed) {
        uint32_t rest = m->n - (f->sum[2 * at + 1] >> 16);
        uint32_t rb = f->sum[2 * at] + (still & 0xff00ffu) * rest;
        uint32_t g = (f->sum[2 * at + 1] & 0xffffu) + pixel_green(still) * rest;
        return pixel_make(0, mean_of(m, rb >> 16), mean_of(m, g), mean_of(m, rb & 0xffffu));
    }
    bool linear = frame_is_linear(f->t->frame);
    const uint32_t *sum = f->sum + 3 * at;
    uint32_t rest = m->n - f->times[at];
    uint32_t r = mean_of(m, sum[0] + value_of(pixel_red(still), linear) * rest);
    uint32_t g = mean_of(m, sum[1] + value_of(pixel_green(still), linear) * rest);
    uint32_t b = mean_of(m, sum[2] + value_of(pixel_blue(still), linear) * rest);
    return linear ? pixel_make(0, smear_srgb_encode[r >> 4], smear_srgb_encode[g >> 4], smear_srgb_encode[b >> 4])
                  : pixel_make(0, r, g, b);
}

static void average(const struct subframes *f, const struct box *b)
{
    for (int32_t y = b->y0; y < b->y1; y++) {
        int32_t at = work_row(f, b, y), end = at + (b->x1 - b->x0);
        for (; at < end; at++)
            if (f->packed ? f->sum[2 * at + 1] >= 0x10000u : f->times[at] != 0)
                f->work.color[at] = mixed(f, at, f->work.color[at]);
    }
}

uint32_t smear_subframes_tile(const struct smear_moving_tile *t, int32_t instants)
{
    const struct smear_raster_target *s = &t->still;
    const struct box whole = { s->x0, s->y0, s->x1, s->y1 };
    int32_t pixels = t->tile * t->tile;
    struct subframes f = { .t = t, .packed = !frame_is_linear(t->frame) && instants <= PACKED_MAX };
    f.sum = (uint32_t *)t->work;
    f.listed = f.sum + 3 * pixels;
    f.times = (uint16_t *)(void *)(f.listed + LISTED);
    f.work = *s;
    f.work.velocity8 = NULL;
    f.work.velocity16 = NULL;
    f.work.inspect = NULL;
    f.work.moving = NULL;
    f.work.color = t->out;
    f.work.depth = f.times + pixels;
    f.work.color_rows = f.work.window_rows = (struct smear_plane_rows){ t->tile, 0, t->tile, s->x0 };

    copy_color(&f, &whole);
    restore_depth(&f, &whole);
    uint32_t samples = 0;
    struct box all = no_box;
    if (list(&f)) {
        f.mean = mean_make((uint32_t)instants);
        __builtin_memset(f.sum, 0, (size_t)pixels * (f.packed ? 2 : 3) * sizeof *f.sum);
        if (!f.packed)
            __builtin_memset(f.times, 0, (size_t)pixels * sizeof *f.times);
        for (int32_t k = 0; k < instants; k++) {
            struct box box = draw_instant(&f, smear_shutter_instant(t->shutter, k, instants));
            if (box_is_empty(&box))
                continue;
            if (f.packed)
                add_packed(&f, &box);
            else
                add(&f, &box);
            restore_depth(&f, &box);
            samples += (uint32_t)((box.x1 - box.x0) * (box.y1 - box.y0));
            box_add(&all, &box);
        }
    }
    if (f.blends)
        blend(&f, 0, BLEND_STILL, &f.work, NULL);
    if (samples != 0)
        average(&f, &all);
    return samples;
}
