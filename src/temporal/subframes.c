/* SPDX-License-Identifier: MIT */
/* subframes.c - the moving triangles of some tiles drawn again at several instants.
 *
 * Where no moving triangle is at an instant, a tile looks as it does without moving triangles: that picture (still surfaces,
 * still blended draws over them) is made once, and weighs for all instants that say nothing else. At each
 * instant only the box around the moving triangles is drawn, summed and made still again.
 *
 * A sum of N instants is the comb of N teeth where the truth is a box. Where all moving triangles go alike, a
 * tooth is as far from the next at all pixels, and the sum's own mean over that distance closes the
 * comb: shifted in space is shifted in time. Only what moves is meant: what is still lies beneath,
 * with the weight of the instants that are left. */
#include "temporal/subframes.h"

#include "base/fixmath.h"
#include "base/pixel.h"
#include "raster/raster.h"
#include "geometry/shutter.h"
#include "geometry/transform.h"
#include "base/vector.h"
#include "kernels/depth_range.h"

enum {
    LISTED = 128,           /* triangles of the tile that are remembered;
                             * others are looked for at each instant */
    PACKED_MAX = SMEAR_PACKED_INSTANTS,     /* weights of codes that add up in 16
                                             * bits, with half of themselves */
    SUM_PLANES = SMEAR_WITH_LINEAR ? 4 : 2,     /* of codes alone all sums are packed */
    PAIRS_MAX = 8,          /* of taps of a gap */
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

/* The same in 16 bits, for sums of n codes, 2 <= n <= PACKED_MAX: times 2^(16 + shift) / n, rounded up: a
 * mean that is whole stays so, and others go up from 1/2 - 1/128 on. */
struct narrow_mean {
    uint32_t n, halves, factor;     /* halves: n / 2 in 16 bits, twice */
    int shift;
    uint32_t factor24;              /* the factor times 2^(8 - shift): the mean is in a product's top byte */
};

/* Packed sums of a pixel: red and blue, in 16 bits each; green, and how many. */
struct sums {
    uint32_t rb, gn;
};

struct subframes {
    const struct smear_moving_tile *t;
    struct smear_raster_target work;    /* the tile at an instant: finished pixels, depth of its own */
    /* Planes of sums of what is not still: red, green, blue. Packed, as in struct sums: two planes where there
     * are vectors, else one of pairs. */
    uint32_t *sum[3];
    uint32_t *times;            /* how many */
    bool packed;
    bool blends;                /* blended draws change what is still, too */
    uint32_t instants;

    /* What may be seen in the tile. Those beyond are found by walking on from here. */
    uint32_t *listed;           /* moving triangles, then blended triangles */
    uint32_t moving_listed, all_listed;
    uint32_t moving_rest, blend_rest;
    uint32_t lowest, highest;   /* depth codes of what is still */
    uint32_t nearest;           /* nothing that is not still comes nearer */
    struct box area;            /* and nothing of it is seen elsewhere */
};

size_t smear_subframes_work(int32_t width, int32_t height)
{
    return (size_t)(width * height) * (SUM_PLANES * sizeof(uint32_t) + sizeof(uint16_t))
         + LISTED * sizeof(uint32_t);
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

static struct narrow_mean narrow_mean_make(uint32_t n)
{
    int shift = 31 - count_leading_zeros(n - 1);
    uint32_t factor = ((1u << (16 + shift)) + n - 1) / n;
    return (struct narrow_mean){ n, (n >> 1) * 0x10001u, factor, shift, factor << (8 - shift) };
}

/* ------------------------------------------------------------------ what is still */

static inline int32_t still_row(const struct smear_raster_target *s, const struct smear_plane_rows *rows,
                                int32_t y)
{
    int32_t slot = rows->slot0 + (y - s->y0);
    return (slot >= rows->ring ? slot - rows->ring : slot) * rows->stride - rows->x0;
}

/* Index of the first of the box's pixels in row y of the work planes. */
static inline int32_t work_row(const struct subframes *f, const struct box *b, int32_t y)
{
    return (y - f->t->still.y0) * f->t->pitch + (b->x0 - f->t->still.x0);
}

/* In whole words, where tiles begin with them. */
static void restore_depth(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    struct box wide = *b;
    wide.x0 -= (wide.x0 - s->x0) & 1;
    wide.x1 = min_i32(wide.x1 + ((wide.x1 - s->x0) & 1), s->x1);
    for (int32_t y = wide.y0; y < wide.y1; y++)
        __builtin_memcpy(f->work.depth + work_row(f, &wide, y),
                         s->depth + still_row(s, &s->window_rows, y) + wide.x0,
                         (size_t)(wide.x1 - wide.x0) * sizeof *s->depth);
}

static void copy_color(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    for (int32_t y = b->y0; y < b->y1; y++)
        __builtin_memcpy(f->work.color + work_row(f, b, y),
                         s->color + still_row(s, &s->color_rows, y) + b->x0,
                         (size_t)(b->x1 - b->x0) * sizeof *s->color);
}

/* Least and greatest of a plane of depth codes. */
static void find_depths(const uint16_t *depth, int32_t pitch, int32_t width, int32_t height, uint32_t *low,
                        uint32_t *high)
{
    const struct depth_range r = depth_range(depth, pitch, width, height);
    *low = r.least;
    *high = r.most;
}

/* ------------------------------------------------------------------ triangles at an instant */

/* A triangle with its vertices at an instant. */
struct posed {
    const struct smear_segment *segment;
    uint32_t color;
    const int32_t *v[3];
    struct bounds bounds;       /* of the vertices */
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

/* Coordinate VERTEX_X or VERTEX_Y of all three. Between places
 * within the guard band a parabola may leave it. */
static inline struct range place(struct posed *p, int axis, int32_t u, int32_t middle)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    const int open = p->segment->motion + axis;
    for (int i = 0; i < 3; i++)
        p->record[i][axis] = path_coordinate(p->v[i][open], p->v[i][axis], p->v[i][open + PATH_POSE_WORDS],
                                             u);
    struct range r = range_of(p->record[0][axis], p->record[1][axis], p->record[2][axis]);
    if (r.low >= middle - guard && r.high <= middle + guard)
        return r;
    for (int i = 0; i < 3; i++)
        p->record[i][axis] = clamp_i32(p->record[i][axis], middle - guard, middle + guard);
    return range_of(p->record[0][axis], p->record[1][axis], p->record[2][axis]);
}

static inline bool is_turned_away(const int32_t *a, const int32_t *b, const int32_t *c)
{
    const int32_t x1 = b[VERTEX_X] - a[VERTEX_X], y1 = b[VERTEX_Y] - a[VERTEX_Y];
    const int32_t x2 = c[VERTEX_X] - a[VERTEX_X], y2 = c[VERTEX_Y] - a[VERTEX_Y];
#if !SMEAR_HAS_MUL64
    const uint32_t small = 1 << 15;
    if ((((uint32_t)x1 + small) | ((uint32_t)y1 + small) | ((uint32_t)x2 + small) | ((uint32_t)y2 + small))
        < 2 * small)
        return x1 * y2 <= x2 * y1;
#endif
    return (int64_t)x1 * y2 <= (int64_t)x2 * y1;
}

/* False where the triangle is not seen in the tile at this time: elsewhere, or turned away. */
static bool pose(struct posed *p, const struct subframes *f, uint32_t triangle, int32_t time)
{
    const struct smear_raster_frame *frame = f->t->frame;
    const struct smear_triangle *t = bins_triangle(frame->bins, triangle);
    const struct smear_segment *s = &frame->bins->segment[t->segment];
    const struct smear_raster_target *tile = &f->t->still;
    p->segment = s;
    p->color = t->color;
    if (s->path && !path_interval_time(&time, bins_bounds(frame->bins, triangle)->interval))
        return false;
    for (int i = 0; i < 3; i++)
        p->v[i] = bins_vertex(frame->bins, s, t->vertex[i]);
    const int32_t u = path_phase(time);
    const struct range x = s->path ? place(p, VERTEX_X, u, frame->width << 7)
                                   : range_of(p->v[0][VERTEX_X], p->v[1][VERTEX_X], p->v[2][VERTEX_X]);
    const struct range columns = pixels_of(x, tile->x0, tile->x1);
    if (columns.low >= columns.high)
        return false;
    const struct range y = s->path ? place(p, VERTEX_Y, u, frame->height << 7)
                                   : range_of(p->v[0][VERTEX_Y], p->v[1][VERTEX_Y], p->v[2][VERTEX_Y]);
    const struct range rows = pixels_of(y, tile->y0, tile->y1);
    if (rows.low >= rows.high)
        return false;
    p->bounds = (struct bounds){ x.low, y.low, x.high, y.high };
    p->box = (struct box){ columns.low, rows.low, columns.high, rows.high };
    if (!s->path)
        return true;
    if (is_turned_away(p->record[0], p->record[1], p->record[2]))
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

static inline void draw(const struct posed *p, const struct subframes *f,
                        const struct smear_raster_target *target)
{
    smear_raster_triangle(f->t->frame, target, p->segment, p->color, p->v, &p->bounds);
}

/* ------------------------------------------------------------------ lists of the tile */

static inline bool is_seen(const struct subframes *f, const struct smear_moving_triangle *m)
{
    return moving_is_in(m, f->t) && m->nearest > f->lowest;
}

/* The triangle may touch the tile at some time. */
static bool touches(const struct subframes *f, uint32_t triangle)
{
    const struct smear_bins *g = f->t->frame->bins;
    const struct smear_raster_target *tile = &f->t->still;
    if (!g->segment[bins_triangle(g, triangle)->segment].path) {
        struct posed p;
        return pose(&p, f, triangle, 0);
    }
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    return b->x0 < tile->x1 && b->x1 > tile->x0 && b->y0 < tile->y1 && b->y1 > tile->y0;
}

static void note(struct subframes *f, const struct smear_moving_triangle *m)
{
    const struct smear_path_bounds *b = bins_bounds(f->t->frame->bins, m->triangle);
    f->nearest = max_u32(f->nearest, m->nearest);
    const struct box way = { b->x0, b->y0, b->x1, b->y1 };
    box_add(&f->area, &way);
}

/* Lists what may be seen. True when something moves. */
static SMEAR_NOINLINE bool list(struct subframes *f)
{
    const struct smear_moving_tile *t = f->t;
    const struct smear_bins *g = t->frame->bins;
    uint32_t n = 0;
    bool moves = false;
    find_depths(f->work.depth, t->pitch, t->still.x1 - t->still.x0, t->still.y1 - t->still.y0, &f->lowest,
                &f->highest);
    f->nearest = 0;
    f->area = no_box;
    for (f->moving_rest = 0; f->moving_rest < t->moving_count && n < LISTED; f->moving_rest++) {
        const struct smear_moving_triangle *m = &t->moving[f->moving_rest];
        if (is_seen(f, m)) {
            f->listed[n++] = m->triangle;
            note(f, m);
        }
    }
    for (uint32_t i = f->moving_rest; i < t->moving_count; i++)
        if (is_seen(f, &t->moving[i]))
            note(f, &t->moving[i]);
    moves = n != 0;
    f->moving_listed = n;
    f->blends = t->blend != SMEAR_NO_TRIANGLE && n == LISTED;
    for (f->blend_rest = t->blend; f->blend_rest != SMEAR_NO_TRIANGLE && n < LISTED;) {
        const struct smear_triangle *b = bins_triangle(g, f->blend_rest);
        if (touches(f, f->blend_rest)) {
            f->listed[n++] = f->blend_rest;
            f->blends = true;
            moves = moves || g->segment[b->segment].path;
        }
        f->blend_rest = b->next;
    }
    f->all_listed = n;
    if (f->blends) {
        f->nearest = UINT16_MAX;
        f->area = (struct box){ t->still.x0, t->still.y0, t->still.x1, t->still.y1 };
    }
    return moves || f->blend_rest != SMEAR_NO_TRIANGLE;
}

/* ------------------------------------------------------------------ instants */

static void draw_moving_triangle(const struct subframes *f, uint32_t triangle, int32_t time, struct box *all)
{
    struct posed p;
    if (pose(&p, f, triangle, time)) {
        draw(&p, f, &f->work);
        box_add(all, &p.box);
    }
}

static void draw_moving(const struct subframes *f, int32_t time, struct box *all)
{
    for (uint32_t i = 0; i < f->moving_listed; i++)
        draw_moving_triangle(f, f->listed[i], time, all);
    for (uint32_t i = f->moving_rest; i < f->t->moving_count; i++)
        if (is_seen(f, &f->t->moving[i]))
            draw_moving_triangle(f, f->t->moving[i].triangle, time, all);
}

enum blend_pass {
    BLEND_BOX,          /* finds where moving ones are */
    BLEND_ALL,          /* draws */
    BLEND_STILL         /* draws what is still */
};

static void blend_one(const struct subframes *f, uint32_t triangle, int32_t time, enum blend_pass pass,
                      const struct smear_raster_target *target, struct box *all)
{
    const struct smear_bins *g = f->t->frame->bins;
    bool moves = g->segment[bins_triangle(g, triangle)->segment].path;
    struct posed p;
    if ((pass == BLEND_BOX && !moves) || (pass == BLEND_STILL && moves) || !pose(&p, f, triangle, time))
        return;
    if (pass == BLEND_BOX)
        box_add(all, &p.box);
    else
        draw(&p, f, target);
}

static SMEAR_RARE void blend(const struct subframes *f, int32_t time, enum blend_pass pass,
                  const struct smear_raster_target *target, struct box *all)
{
    for (uint32_t i = f->moving_listed; i < f->all_listed; i++)
        blend_one(f, f->listed[i], time, pass, target, all);
    for (uint32_t i = f->blend_rest; i != SMEAR_NO_TRIANGLE;
         i = bins_triangle(f->t->frame->bins, i)->next)
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
    draw_moving(f, time, &all);
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

/* Compilers keep half of what these loops need on the stack: 17 instructions a pixel, not 24. */
#if defined(__ARM_ARCH_6M__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#define SUMS_BY_HAND 1
#else
#define SUMS_BY_HAND 0
#endif

/* Sums are set at first, not emptied before: a gain where memory is slow. */
#define SETS_PACKED (!SMEAR_VECTORS && !SUMS_BY_HAND)

#if SMEAR_VECTORS
static inline struct sums sums_at(const struct subframes *f, int32_t at)
{
    return (struct sums){ f->sum[0][at], f->sum[1][at] };
}
#else
static inline struct sums *pair_at(const struct subframes *f, int32_t at)
{
    return (struct sums *)(void *)f->sum[0] + at;
}

static inline struct sums sums_at(const struct subframes *f, int32_t at)
{
    return *pair_at(f, at);
}
#endif

/* Adds n pixels and makes them still again. What looks still need not be counted: it is what the rest of the
 * mean is made of. `all`: everything counts. */
#if SMEAR_VECTORS
static void add_packed(uint32_t *color, const uint32_t *still, uint32_t *rb, uint32_t *gn, int32_t n,
                       bool all)
{
    int32_t i = 0;
    const smear_v4u every = { 0u - all, 0u - all, 0u - all, 0u - all };
    for (; i + 4 <= n; i += 4) {
        smear_v4u c = v4u_load(color + i), behind = v4u_load(still + i),
                  counts = (smear_v4u)(c != behind) | every;
        v4u_store(color + i, behind);
        c &= counts;
        v4u_store(rb + i, v4u_load(rb + i) + (c & 0xff00ffu));
        v4u_store(gn + i, v4u_load(gn + i) + ((c >> 8 & 0xffu) | (counts & 0x10000u)));
    }
    for (; i < n; i++) {
        const uint32_t c = color[i], behind = still[i];
        if (c != behind || all) {
            color[i] = behind;
            rb[i] += c & 0xff00ffu;
            gn[i] += (c >> 8 & 0xffu) + 0x10000u;
        }
    }
}
#else
static SMEAR_NOINLINE void add_packed(uint32_t *color, const uint32_t *still, struct sums *sums, int32_t n, bool all)
{
#if SUMS_BY_HAND
    if (!all) {
        const uint32_t *end = still + n;
        __asm__ volatile(
            ".syntax unified\n\t"
            "movs r4, #255\n\t"
            "lsls r5, r4, #16\n\t"
            "orrs r4, r5\n\t"
            "mov r8, r4\n\t"
            "movs r4, #1\n\t"
            "lsls r4, r4, #16\n\t"
            "mov r9, r4\n"
            "1:\n\t"
            "ldr r4, [%[color]]\n\t"
            "ldm %[still]!, {r5}\n\t"
            "stm %[color]!, {r5}\n\t"
            "cmp r4, r5\n\t"
            "beq 2f\n\t"
            "mov r5, r8\n\t"
            "ands r5, r4\n\t"
            "lsrs r4, r4, #8\n\t"
            "uxtb r4, r4\n\t"
            "ldr r6, [%[sums]]\n\t"
            "ldr r7, [%[sums], #4]\n\t"
            "adds r6, r6, r5\n\t"
            "adds r7, r7, r4\n\t"
            "add r7, r9\n\t"
            "stm %[sums]!, {r6, r7}\n\t"
            "cmp %[still], %[end]\n\t"
            "bne 1b\n\t"
            "b 3f\n"
            "2:\n\t"
            "adds %[sums], #8\n\t"
            "cmp %[still], %[end]\n\t"
            "bne 1b\n"
            "3:"
            : [color] "+l"(color), [still] "+l"(still), [sums] "+l"(sums)
            : [end] "r"(end)
            : "r4", "r5", "r6", "r7", "r8", "r9", "cc", "memory");
        return;
    }
#endif
    const uint32_t mask = all ? UINT32_MAX : 0;
    for (const uint32_t *end = still + n; still != end; color++, sums++) {
        const uint32_t c = *color, behind = *still++;
        if (((c ^ behind) | mask) != 0) {
            __asm__ volatile ("");      /* nothing of this in advance */
            struct sums s = *sums;
            *color = behind;
            s.rb += c & 0xff00ffu;
            s.gn += (c >> 8 & 0xffu) + 0x10000u;
            *sums = s;
        }
    }
}
#endif

#if SETS_PACKED
/* The same where the sums are not yet begun. */
static SMEAR_NOINLINE void set_packed(uint32_t *color, const uint32_t *still, struct sums *sums, int32_t n)
{
    for (const uint32_t *end = still + n; still != end; color++, sums++) {
        const uint32_t c = *color, behind = *still++;
        struct sums s = { 0, 0 };
        if (c != behind) {
            *color = behind;
            s = (struct sums){ c & 0xff00ffu, (c >> 8 & 0xffu) + 0x10000u };
        }
        *sums = s;
    }
}
#endif

static SMEAR_RARE void add_wide(const struct subframes *f, int32_t at, const uint32_t *still, int32_t n)
{
    const bool linear = frame_is_linear(f->t->frame);
    const uint32_t all = f->blends;
    uint32_t *p = f->work.color + at, *r = f->sum[0] + at, *g = f->sum[1] + at, *b = f->sum[2] + at;
    uint32_t *times = f->times + at;
    for (int32_t i = 0; i < n; i++) {
        uint32_t c = p[i], behind = still[i];
        if (((c ^ behind) | all) != 0) {
            r[i] += value_of(pixel_red(c), linear);
            g[i] += value_of(pixel_green(c), linear);
            b[i] += value_of(pixel_blue(c), linear);
            times[i]++;
            p[i] = behind;
        }
    }
}

static void clear_row(const struct subframes *f, int32_t at, int32_t n)
{
    const size_t bytes = (size_t)n * sizeof *f->times;
    if (f->packed && !SMEAR_VECTORS) {
        __builtin_memset(f->sum[0] + 2 * at, 0, 2 * bytes);
        return;
    }
    for (int i = 0; i < (f->packed ? 2 : 3); i++)
        __builtin_memset(f->sum[i] + at, 0, bytes);
    if (!f->packed)
        __builtin_memset(f->times + at, 0, bytes);
}

/* Empties the sums where they will be read, but for what is `drawn`: a gap's mean is taken PAIRS_MAX
 * beyond what was drawn, and reads as far beyond that. */
static SMEAR_NOINLINE void clear_around(const struct subframes *f, const struct box *drawn)
{
    const struct smear_raster_target *s = &f->t->still;
    const int32_t reach = 2 * PAIRS_MAX;
    const struct box b = { max_i32(f->area.x0 - reach, s->x0), max_i32(f->area.y0 - reach, s->y0),
                           min_i32(f->area.x1 + reach, s->x1), min_i32(f->area.y1 + reach, s->y1) };
    for (int32_t y = b.y0; y < b.y1; y++) {
        const int32_t at = work_row(f, &b, y);
        if (y < drawn->y0 || y >= drawn->y1) {
            clear_row(f, at, b.x1 - b.x0);
            continue;
        }
        if (drawn->x0 > b.x0)
            clear_row(f, at, drawn->x0 - b.x0);
        if (drawn->x1 < b.x1)
            clear_row(f, at + drawn->x1 - b.x0, b.x1 - drawn->x1);
    }
}

/* `first`: the sums begin here, which were not emptied. */
static void add(const struct subframes *f, const struct box *b, bool first)
{
    const struct smear_raster_target *s = &f->t->still;
    for (int32_t y = b->y0; y < b->y1; y++) {
        const uint32_t *still = s->color + still_row(s, &s->color_rows, y) + b->x0;
        int32_t at = work_row(f, b, y), n = b->x1 - b->x0;
#if SETS_PACKED
        if (first) {
            set_packed(f->work.color + at, still, pair_at(f, at), n);
            continue;
        }
#else
        (void)first;
#endif
        if (f->packed)
#if SMEAR_VECTORS
            add_packed(f->work.color + at, still, f->sum[0] + at, f->sum[1] + at, n, f->blends);
#else
            add_packed(f->work.color + at, still, pair_at(f, at), n, f->blends);
#endif
        else
            add_wide(f, at, still, n);
    }
}

/* ------------------------------------------------------------------ means */

/* The comb's gap, centred on a pixel: weights in `unit` of a pixel, of which the ends get what
 * is left. Taps are in pairs, which count only together: where one lies outside the tiles the
 * gap is closed by less, but nothing is shifted. */
struct gap {
    int32_t pairs;
    int8_t x[PAIRS_MAX], y[PAIRS_MAX];
    int32_t offset[PAIRS_MAX];              /* the same in the planes */
    uint32_t unit, last;                    /* weights: of all taps (1 .. 16, a power of
                                             * two), but the last pair's */
    int unit_log2;
    uint32_t weight[PAIRS_MAX + 1];         /* of all instants, by pairs that count */
    struct narrow_mean mean[PAIRS_MAX + 1]; /* made where they are needed: n is 0 before */
};

/* Of part / over along an axis; where that is a whole number, no division. */
static int32_t nearest_pixel(int32_t part, int32_t over, int32_t times)
{
    if (part == 0 || part == over)
        return part == 0 ? 0 : times;
    if (part == -over)
        return -times;
    const int32_t numerator = part * times;
    return (2 * numerator + (numerator < 0 ? -over : over)) / (2 * over);
}

static SMEAR_NOINLINE void gap_make(struct gap *gap, const struct subframes *f, const struct smear_step *step)
{
    const int32_t x = step->x, y = step->y;
    /* 1/16 px */
    const uint32_t length = (uint32_t)min_i32(max_i32(abs_i32(x), abs_i32(y)), 16 * (2 * PAIRS_MAX + 1));
    uint32_t whole;
    for (gap->unit = 16;; gap->unit >>= 1) {
        /* what is left is the same on both sides */
        whole = max_u32((length * gap->unit + 16) >> 5 << 1, gap->unit);
        if (gap->unit == 1)
            whole |= 1u;
        if (gap->unit == 1 || !f->packed || whole * f->instants <= PACKED_MAX)
            break;
    }
    if (f->packed && whole * f->instants > PACKED_MAX)
        whole = gap->unit;
    const uint32_t side = (whole - gap->unit) >> 1;
    gap->pairs = (int32_t)((side + gap->unit - 1) / gap->unit);
    gap->last = side - (uint32_t)(gap->pairs - 1) * gap->unit;
    for (int32_t i = 0; i < gap->pairs; i++) {
        gap->x[i] = (int8_t)nearest_pixel(x, (int32_t)length, i + 1);
        gap->y[i] = (int8_t)nearest_pixel(y, (int32_t)length, i + 1);
        gap->offset[i] = gap->y[i] * f->t->pitch + gap->x[i];
    }
    if (gap->pairs == 0)
        gap->unit = f->instants == 1 ? 2 : 1;
    gap->unit_log2 = 31 - count_leading_zeros(gap->unit);
    for (int32_t pairs = 0; pairs <= gap->pairs; pairs++) {
        gap->weight[pairs] = f->instants
                           * (pairs == gap->pairs && pairs != 0 ? whole
                                                                : gap->unit * (2 * (uint32_t)pairs + 1));
        gap->mean[pairs].n = 0;
    }
}

/* Pairs of which both lie within `near` of a pixel. */
static inline int32_t pairs_within(int32_t pairs, const int8_t *offset, int32_t near)
{
    while (pairs > 0 && abs_i32(offset[pairs - 1]) > near)
        pairs--;
    return pairs;
}

/* Pixels of a row from index `at` on, all with the same pairs. */
struct stretch {
    int32_t at, n, pairs;
};

static inline uint32_t pair_weight(const struct gap *gap, int32_t i)
{
    return i + 1 == gap->pairs ? gap->last : gap->unit;
}

/* What is still hides all moving triangles there. */
static inline bool stays_still(const struct subframes *f, int32_t at)
{
    return f->work.depth[at] > f->nearest && f->times[at] == 0;
}

/* The pixels of a gap's taps, in pairs. Where moving triangles are hidden is not where they are not: there
 * they go on as at the pixel. Where the pixel itself hides some, others do not spread over it.
 * What is at a pixel at n instants is half a gap away, or less, at n - 1 of them: where it is not
 * and what is still is nearer, that hides it. */
static void find_taps(int32_t *tap, const struct subframes *f, int32_t at, const struct gap *gap,
                      int32_t pairs)
{
    const uint32_t depth = f->work.depth[at], times = f->times[at];
    bool hides = depth > f->nearest;
    for (int32_t i = 0; i < 2 * pairs; i++) {
        const int32_t p = i & 1 ? at + gap->offset[i >> 1] : at - gap->offset[i >> 1];
        const uint32_t depth_there = f->work.depth[p];
        tap[i] = p;
        if (depth_there > depth && (depth_there > f->nearest || f->times[p] + 1 < times))
            tap[i] = at;
        else if (depth_there < depth && times + 1 < f->times[p])
            hides = true;
    }
    for (int32_t i = 0; hides && i < 2 * pairs; i++)
        tap[i] = at;
}

/* Sum of a plane over the gap at pixel `at`. `tap`: where its taps are; null: nothing hides moving triangles there. */
static inline uint32_t gap_sum(const uint32_t *sum, int32_t at, const struct gap *gap, int32_t pairs,
                               const int32_t *tap)
{
    uint32_t all = sum[at] * gap->unit;
    for (int32_t i = 0; i < pairs; i++)
        all += (tap != NULL ? sum[tap[2 * i]] + sum[tap[2 * i + 1]]
                            : sum[at - gap->offset[i]] + sum[at + gap->offset[i]])
             * pair_weight(gap, i);
    return all;
}

/* Packed sums over the gaps of n pixels from `at` on. Nothing hides moving triangles there. */
static void gap_sums(struct sums *out, const struct subframes *f, int32_t at, int32_t n, const struct gap *gap,
                     int32_t pairs)
{
    const int32_t *offset = gap->offset;
    const int unit_log2 = gap->unit_log2;
    if (pairs <= 1)
        for (int32_t i = 0; i < n; i++) {
            const struct sums here = sums_at(f, at + i);
            out[i] = (struct sums){ here.rb << unit_log2, here.gn << unit_log2 };
        }
    else
        for (int32_t i = 0; i < n; i++) {
            struct sums all = sums_at(f, at + i);
            for (int32_t k = 0; k < pairs - 1; k++) {
                const struct sums a = sums_at(f, at + i - offset[k]), b = sums_at(f, at + i + offset[k]);
                all.rb += a.rb + b.rb;
                all.gn += a.gn + b.gn;
            }
            out[i] = (struct sums){ all.rb << unit_log2, all.gn << unit_log2 };
        }
    if (pairs == 0)
        return;
    const uint32_t weight = pair_weight(gap, pairs - 1);
    for (int32_t i = 0, p = at - offset[pairs - 1], q = at + offset[pairs - 1]; i < n; i++) {
        const struct sums a = sums_at(f, p + i), b = sums_at(f, q + i);
        out[i].rb += (a.rb + b.rb) * weight;
        out[i].gn += (a.gn + b.gn) * weight;
    }
}

/* The same of one pixel, as find_taps says. */
static inline struct sums gap_sums_seen(const struct subframes *f, int32_t at, const struct gap *gap, int32_t pairs)
{
    const struct sums here = sums_at(f, at);
    const uint32_t depth = f->work.depth[at], times = here.gn >> 16;
    struct sums all = { here.rb * gap->unit, here.gn * gap->unit };
    bool hides = depth > f->nearest;
    for (int32_t i = 0; i < pairs && !hides; i++) {
        struct sums pair = { 0, 0 };
        for (int side = 0; side < 2; side++) {
            const int32_t p = side ? at + gap->offset[i] : at - gap->offset[i];
            const uint32_t depth_there = f->work.depth[p];
            struct sums there = sums_at(f, p);
            if (depth_there > depth && (depth_there > f->nearest || (there.gn >> 16) + 1 < times))
                there = here;
            else if (depth_there < depth && times + 1 < there.gn >> 16)
                hides = true;
            pair.rb += there.rb;
            pair.gn += there.gn;
        }
        all.rb += pair.rb * pair_weight(gap, i);
        all.gn += pair.gn * pair_weight(gap, i);
    }
    if (hides) {    /* none where what is still stays so */
        const uint32_t whole = gap->weight[pairs] / f->instants;
        all = (struct sums){ here.rb * whole, here.gn * whole };
    }
    return all;
}

/* Means of n pixels, in place of what is still, which gets the weight of the instants that are left. */
static SMEAR_NOINLINE void mix_packed(uint32_t *color, const struct sums *sums, int32_t n, const struct narrow_mean *m)
{
    const struct sums *end = sums + n;
#if SUMS_BY_HAND
    __asm__ volatile(
        ".syntax unified\n\t"
        "movs r4, #255\n\t"
        "lsls r5, r4, #16\n\t"
        "orrs r4, r5\n\t"
        "mov r8, r4\n"
        "1:\n\t"
        "ldm %[sums]!, {r4, r5}\n\t"
        "lsrs r6, r5, #16\n\t"
        "beq 2f\n\t"
        "ldr r3, [%[color]]\n\t"
        "rsbs r6, r6, #0\n\t"
        "add r6, %[n]\n\t"
        "mov r7, r8\n\t"
        "ands r7, r3\n\t"
        "muls r7, r6\n\t"
        "adds r4, r4, r7\n\t"
        "add r4, %[halves]\n\t"
        "lsrs r3, r3, #8\n\t"
        "uxtb r3, r3\n\t"
        "muls r3, r6\n\t"
        "adds r5, r5, r3\n\t"
        "add r5, %[halves]\n\t"
        "uxth r5, r5\n\t"
        "mov r6, %[factor]\n\t"
        "muls r5, r6\n\t"
        "lsrs r5, r5, #24\n\t"
        "lsls r5, r5, #8\n\t"
        "uxth r7, r4\n\t"
        "muls r7, r6\n\t"
        "lsrs r7, r7, #24\n\t"
        "orrs r5, r7\n\t"
        "lsrs r4, r4, #16\n\t"
        "muls r4, r6\n\t"
        "lsrs r4, r4, #24\n\t"
        "lsls r4, r4, #16\n\t"
        "orrs r5, r4\n\t"
        "str r5, [%[color]]\n"
        "2:\n\t"
        "adds %[color], #4\n\t"
        "cmp %[sums], %[end]\n\t"
        "bne 1b"
        : [color] "+l"(color), [sums] "+l"(sums)
        : [end] "r"(end), [n] "r"(m->n), [halves] "r"(m->halves), [factor] "r"(m->factor24)
        : "r3", "r4", "r5", "r6", "r7", "r8", "cc", "memory");
#else
    const struct narrow_mean mean = *m;
    for (; sums != end; sums++, color++) {
        const uint32_t times = sums->gn >> 16;
        if (times == 0)
            continue;
        const uint32_t still = *color, rest = mean.n - times;
        const uint32_t rb = sums->rb + (still & 0xff00ffu) * rest + mean.halves;
        const uint32_t g = (uint16_t)(sums->gn + pixel_green(still) * rest + mean.halves);
        *color = (rb >> 16) * mean.factor24 >> 24 << 16 | g * mean.factor24 >> 24 << 8
               | (uint16_t)rb * mean.factor24 >> 24;
    }
#endif
}

#if SMEAR_VECTORS
/* Of both packed planes. */
static inline void gap_sum4(smear_v4u out[2], const uint32_t *rb, const uint32_t *gn, const struct gap *gap,
                            int32_t pairs)
{
    smear_v4u a = v4u_load(rb), b = v4u_load(gn);
    const int32_t *offset = gap->offset;
    for (int32_t i = 1; i < pairs; i++, offset++) {
        a += v4u_load(rb + *offset) + v4u_load(rb - *offset);
        b += v4u_load(gn + *offset) + v4u_load(gn - *offset);
    }
    a <<= gap->unit_log2;
    b <<= gap->unit_log2;
    if (pairs > 0) {
        const smear_v4u end_a = v4u_load(rb + *offset) + v4u_load(rb - *offset);
        const smear_v4u end_b = v4u_load(gn + *offset) + v4u_load(gn - *offset);
        const uint32_t last = pair_weight(gap, pairs - 1);
        a += v4u_mul16(end_a, (smear_v4u){ 0, 0, 0, 0 } + last * 0x10001u);
        b += v4u_mul16(end_b, (smear_v4u){ 0, 0, 0, 0 } + last * 0x10001u);
    }
    out[0] = a;
    out[1] = b;
}

static inline smear_v4u mixed4(smear_v4u rb, smear_v4u gn, const struct narrow_mean *m, smear_v4u still)
{
    const smear_v4u zero = { 0, 0, 0, 0 }, half = zero + m->halves,
                    factor = zero + m->factor * 0x10001u;
    const smear_v4u rest = (zero + m->n) - (gn >> 16);
    rb += v4u_mul16(still & 0xff00ffu, rest | rest << 16);
    const smear_v4u g = (gn & 0xffffu) + v4u_mul16(still >> 8 & 0xffu, rest);
    const smear_v4u rb_mean = v4u_mulh16(rb + half, factor),
                    g_mean = v4u_mulh16(g + (half & 0xffffu), factor);
    return (rb_mean >> m->shift & 0xff00ffu) | g_mean >> m->shift << 8;
}
#endif

/* What hides moving triangles somewhere near a stretch. */
enum cover {
    COVER_NONE,         /* nothing does */
    COVER_FEW,          /* perhaps still surfaces that moving triangles pass before, too, in places */
    COVER_ALL           /* some that are nearer than all moving triangles */
};

#if SMEAR_VECTORS
/* Whether something nearer than all moving triangles lies at one of four pixels or at their taps. */
static inline bool is_hidden4(const struct subframes *f, int32_t at, const struct gap *gap, int32_t pairs)
{
    const uint16_t *depth = f->work.depth + at;
    const smear_v8i sign = v8i_all(INT16_MIN), limit = v8i_all((int16_t)(f->nearest ^ 0x8000u));
    smear_v8i most = v4_of_8i_load(depth) ^ sign;      /* in the order of signed numbers */
    for (int32_t i = 0; i < pairs; i++)
        most = v8i_max(most, v8i_max(v4_of_8i_load(depth - gap->offset[i]) ^ sign,
                                     v4_of_8i_load(depth + gap->offset[i]) ^ sign));
    const smear_v4u beyond = (smear_v4u)(v8i_max(most, limit) ^ limit);
    return v4u_any(beyond);
}

/* How often moving triangles are seen at four pixels and at their taps. */
enum seen {
    SEEN_NOWHERE,
    SEEN_EVENLY,
    SEEN_UNEVENLY       /* somewhere at two instants more than elsewhere */
};

static inline enum seen seen4(const uint32_t *gn, const struct gap *gap, int32_t pairs)
{
    smear_v8i least = (smear_v8i)v4u_load(gn), most = least;
    for (int32_t i = 0; i < pairs; i++) {
        const smear_v8i a = (smear_v8i)v4u_load(gn - gap->offset[i]),
                        b = (smear_v8i)v4u_load(gn + gap->offset[i]);
        least = v8i_min(least, v8i_min(a, b));
        most = v8i_max(most, v8i_max(a, b));
    }
    if (!v4u_any((smear_v4u)most >> 16))
        return SEEN_NOWHERE;
    return v4u_any((((smear_v4u)most >> 16) - ((smear_v4u)least >> 16)) & ~1u) ? SEEN_UNEVENLY : SEEN_EVENLY;
}

/* What counts of a tap, for four pixels: what is there, or at the pixel (find_taps). */
struct tap4 {
    smear_v4u rb, gn;
};

struct covered4 {
    struct tap4 own;
    smear_v4i depth, times, nearest;
    smear_v4i hides;
};

static inline struct tap4 tap4_at(struct covered4 *c, const struct subframes *f, int32_t p)
{
    const struct tap4 there = { v4u_load(f->sum[0] + p), v4u_load(f->sum[1] + p) };
    const smear_v4i depth = v4i_of_u16(f->work.depth + p), times = (smear_v4i)(there.gn >> 16);
    const smear_v4i covers = (smear_v4i)(depth > c->depth)
                           & ((smear_v4i)(depth > c->nearest) | (smear_v4i)(c->times > times + 1));
    c->hides |= (smear_v4i)(c->depth > depth) & (smear_v4i)(times > c->times + 1);
    return (struct tap4){ v4u_choose(covers, c->own.rb, there.rb), v4u_choose(covers, c->own.gn, there.gn) };
}

static inline smear_v4u weighted(smear_v4u sum, uint32_t weight)
{
    return v4u_mul16(sum, (smear_v4u){ 0, 0, 0, 0 } + weight * 0x10001u);
}

/* gap_sums_seen of four pixels, and their means: those that stay still have sums of 0. */
static void average_seen4(const struct subframes *f, int32_t at, const struct gap *gap, int32_t pairs)
{
    const smear_v4i zero = { 0, 0, 0, 0 };
    struct covered4 c = { .own = { v4u_load(f->sum[0] + at), v4u_load(f->sum[1] + at) },
                          .depth = v4i_of_u16(f->work.depth + at), .nearest = zero + (int32_t)f->nearest };
    c.times = (smear_v4i)(c.own.gn >> 16);
    c.hides = (smear_v4i)(c.depth > c.nearest);
    smear_v4u rb = weighted(c.own.rb, gap->unit), gn = weighted(c.own.gn, gap->unit);
    uint32_t all = gap->unit;
    for (int32_t i = 0; i < pairs; i++) {
        const uint32_t weight = pair_weight(gap, i);
        const struct tap4 before = tap4_at(&c, f, at - gap->offset[i]), after = tap4_at(&c, f, at + gap->offset[i]);
        rb += weighted(before.rb + after.rb, weight);
        gn += weighted(before.gn + after.gn, weight);
        all += 2 * weight;
    }
    rb = v4u_choose(c.hides, weighted(c.own.rb, all), rb);
    gn = v4u_choose(c.hides, weighted(c.own.gn, all), gn);
    uint32_t *out = &f->work.color[at];
    v4u_store(out, mixed4(rb, gn, &gap->mean[pairs], v4u_load(out)));
}
#endif

/* Means of n pixels one by one: their gaps first, as there are few registers. */
static SMEAR_NOINLINE void average_some(const struct subframes *f, int32_t at, int32_t n, const struct gap *gap,
                                        int32_t pairs, enum cover cover)
{
    struct sums sums[16];
    while (n > 0) {
        const int32_t count = min_i32(n, 16);
        if (cover == COVER_NONE)
            gap_sums(sums, f, at, count, gap, pairs);
        else
            for (int32_t i = 0; i < count; i++)
                sums[i] = gap_sums_seen(f, at + i, gap, pairs);
        mix_packed(f->work.color + at, sums, count, &gap->mean[pairs]);
        at += count;
        n -= count;
    }
}

static void average_packed(const struct subframes *f, const struct stretch *s, const struct gap *gap,
                           enum cover cover)
{
    int32_t i = s->at;
    const int32_t end = s->at + s->n;
#if SMEAR_VECTORS
    const struct narrow_mean *m = &gap->mean[s->pairs];
    uint32_t *out = f->work.color;
    const uint32_t *rb = f->sum[0], *gn = f->sum[1];
    for (; i + 4 <= end; i += 4) {
        if (cover != COVER_NONE) {
            const enum seen seen = seen4(gn + i, gap, s->pairs);
            if (seen == SEEN_NOWHERE)
                continue;
            if (seen == SEEN_UNEVENLY || (cover == COVER_ALL && is_hidden4(f, i, gap, s->pairs))) {
                average_seen4(f, i, gap, s->pairs);
                continue;
            }
        }
        smear_v4u sum[2];
        gap_sum4(sum, rb + i, gn + i, gap, s->pairs);
        v4u_store(out + i, mixed4(sum[0], sum[1], m, v4u_load(out + i)));
    }
#endif
    average_some(f, i, end - i, gap, s->pairs, cover);
}

static SMEAR_RARE void average_wide(const struct subframes *f, const struct stretch *s, const struct gap *gap,
                         enum cover cover)
{
    const struct mean m = mean_make(gap->weight[s->pairs]);
    const bool linear = frame_is_linear(f->t->frame);
    int32_t tap[2 * PAIRS_MAX];
    const int32_t *taps = cover != COVER_NONE ? tap : NULL;
    for (int32_t at = s->at; at < s->at + s->n; at++) {
        if (cover != COVER_NONE) {
            if (stays_still(f, at))
                continue;
            find_taps(tap, f, at, gap, s->pairs);
        }
        uint32_t mean[3], *out = &f->work.color[at], times = gap_sum(f->times, at, gap, s->pairs, taps);
        if (times == 0)
            continue;
        for (int i = 0; i < 3; i++)
            mean[i] = mean_of(&m, gap_sum(f->sum[i], at, gap, s->pairs, taps)
                              + value_of(*out >> (16 - 8 * i) & 0xffu, linear) * (m.n - times));
        *out = linear ? pixel_make(0, smear_srgb_encode[mean[0] >> 4], smear_srgb_encode[mean[1] >> 4],
                                   smear_srgb_encode[mean[2] >> 4])
                      : pixel_make(0, mean[0], mean[1], mean[2]);
    }
}

/* Whether what is still hides all moving triangles somewhere in or near the box. */
static bool hides(const struct subframes *f, const struct box *b)
{
    const struct smear_raster_target *s = &f->t->still;
    struct box near = { max_i32(b->x0 - PAIRS_MAX, s->x0), max_i32(b->y0 - PAIRS_MAX, s->y0),
                        min_i32(b->x1 + PAIRS_MAX, s->x1), min_i32(b->y1 + PAIRS_MAX, s->y1) };
    uint32_t low, high;
    find_depths(f->work.depth + work_row(f, &near, near.y0), f->t->pitch, near.x1 - near.x0,
                near.y1 - near.y0, &low, &high);
    return high > f->nearest;
}

/* Columns [x0, x1) of the box, which lie in one tile: rows, cut where fewer pairs count. */
static void average_tile(const struct subframes *f, const struct box *b, struct gap *gap)
{
    const struct smear_raster_target *s = &f->t->still;
    const enum cover cover = f->highest == f->lowest ? COVER_NONE
                           : f->highest > f->nearest && hides(f, b) ? COVER_ALL : COVER_FEW;
    for (int32_t y = b->y0; y < b->y1; y++) {
        const int32_t row_pairs = pairs_within(gap->pairs, gap->y, min_i32(y - s->y0, s->y1 - 1 - y));
        const int32_t reach = row_pairs > 0 ? abs_i32(gap->x[row_pairs - 1]) : 0;
        struct stretch stretch = { work_row(f, b, y), 0, 0 };
        for (int32_t x = b->x0; x < b->x1; x += stretch.n, stretch.at += stretch.n) {
            const int32_t near = min_i32(x - s->x0, s->x1 - 1 - x);
            stretch.n = near < reach ? 1 : min_i32(b->x1, s->x1 - reach) - x;
            stretch.pairs = pairs_within(row_pairs, gap->x, near);
            if (!f->packed) {
                average_wide(f, &stretch, gap, cover);
                continue;
            }
            if (gap->mean[stretch.pairs].n == 0)
                gap->mean[stretch.pairs] = narrow_mean_make(gap->weight[stretch.pairs]);
            average_packed(f, &stretch, gap, cover);
        }
    }
}

/* `all`: where anything has been summed. */
static void average(const struct subframes *f, const struct box *all, const struct smear_step *step)
{
    static const struct smear_step none = { 0, 0 };
    const struct smear_moving_tile *t = f->t;
    const struct smear_raster_target *s = &t->still;
    for (int32_t x = t->x0; x < t->x1; x += t->tile) {
        struct gap gap;
        gap_make(&gap, f, step != NULL && !f->blends ? &step[(x - t->x0) / t->tile] : &none);
        const int32_t wide = gap.pairs;
        const struct box b = { max_i32(x, all->x0 - wide), max_i32(s->y0, all->y0 - wide),
                               min_i32(min_i32(x + t->tile, t->x1), all->x1 + wide),
                               min_i32(s->y1, all->y1 + wide) };
        if (!box_is_empty(&b))
            average_tile(f, &b, &gap);
    }
}

uint32_t smear_subframes_tiles(const struct smear_moving_tile *t, int32_t instants,
                               const struct smear_step *step)
{
    const struct smear_raster_target *s = &t->still;
    const struct box whole = { s->x0, s->y0, s->x1, s->y1 };
    const int32_t pixels = t->pitch * (s->y1 - s->y0);
    struct subframes f = {
        .t = t, .packed = !SMEAR_WITH_LINEAR || (!frame_is_linear(t->frame) && instants <= PACKED_MAX),
        .instants = (uint32_t)instants
    };
    f.listed = (uint32_t *)t->work;
    for (int i = 0; i < min_i32(SUM_PLANES, 3); i++)
        f.sum[i] = f.listed + LISTED + i * pixels;
    f.times = SMEAR_WITH_LINEAR ? f.sum[2] + pixels : NULL;
    f.work = *s;
    f.work.velocity8 = NULL;
    f.work.velocity16 = NULL;
    f.work.inspect = NULL;
    f.work.moving = NULL;
    f.work.color = t->out;
    f.work.depth = (uint16_t *)(void *)(f.listed + LISTED + SUM_PLANES * pixels);
    f.work.color_rows = f.work.window_rows = (struct smear_plane_rows){ t->pitch, 0, s->y1 - s->y0, s->x0 };

    copy_color(&f, &whole);
    restore_depth(&f, &whole);
    uint32_t samples = 0;
    struct box all = no_box;
    if (list(&f)) {
        for (int32_t k = 0; k < instants; k++) {
            struct box box = draw_instant(&f, smear_shutter_instant(t->shutter, k, instants));
            if (box_is_empty(&box))
                continue;
            const bool first = samples == 0, sets = SETS_PACKED && f.packed && !f.blends;
            if (first)
                clear_around(&f, sets ? &box : &no_box);
            add(&f, &box, first && sets);
            restore_depth(&f, &box);
            samples += (uint32_t)((box.x1 - box.x0) * (box.y1 - box.y0));
            box_add(&all, &box);
        }
    }
    if (f.blends)
        blend(&f, 0, BLEND_STILL, &f.work, NULL);
    if (samples != 0)
        average(&f, &all, step);
    return samples;
}
