/* SPDX-License-Identifier: MIT */
/* smooth.c - fits a field of motion to the movers of a tile, and blurs by it. */
#include "smooth.h"

#include "fixmath.h"
#include "pixel.h"

/* ------------------------------------------------------------------ where movers are seen */

/* A place in the middle of the exposure, q8 px from the tile's middle, with its displacement and bend. */
struct sample {
    int32_t x, y;
    int32_t dx, dy;             /* open to close, q8 px */
    int32_t bx, by;             /* open + close - 2 middle, q8 px */
};

/* A triangle whose ways are looked at within a box around the tile. */
struct way {
    const int32_t *record[3];
    const struct smear_segment *segment;
    int32_t ox, oy;             /* the tile's middle, q8 px */
    int32_t ratio[2][3];        /* how much farther a vertex is at open and close, q16, at most 16 */
};

static struct sample vertex_sample(const struct way *w, int i)
{
    const int32_t *v = w->record[i], *open = v + w->segment->motion, *close = open + PATH_POSE_WORDS;
    return (struct sample){ v[VERTEX_X] - w->ox, v[VERTEX_Y] - w->oy,
                            close[PATH_X] - open[PATH_X], close[PATH_Y] - open[PATH_Y],
                            open[PATH_X] + close[PATH_X] - 2 * v[VERTEX_X],
                            open[PATH_Y] + close[PATH_Y] - 2 * v[VERTEX_Y] };
}

/* Corners of a triangle cut by a box. */
enum { CORNERS_MAX = 7 };

struct corner {
    int32_t x, y;               /* q8 px from the tile's middle */
    int32_t weight[3];          /* of the vertices on the screen, q16 */
};

static struct corner corner_between(const struct corner *a, const struct corner *b, int32_t t)
{
    struct corner c;
    c.x = a->x + (int32_t)((int64_t)(b->x - a->x) * t >> 16);
    c.y = a->y + (int32_t)((int64_t)(b->y - a->y) * t >> 16);
    for (int i = 0; i < 3; i++)
        c.weight[i] = a->weight[i] + (int32_t)((int64_t)(b->weight[i] - a->weight[i]) * t >> 16);
    return c;
}

/* Keeps what is at most `limit` in direction sign x (or sign y). */
static int cut_corners(struct corner c[CORNERS_MAX], int count, bool vertical, int32_t sign, int32_t limit)
{
    struct corner in[CORNERS_MAX];
    int32_t far[CORNERS_MAX];
    int result = 0, outside = 0;
    for (int i = 0; i < count; i++) {
        in[i] = c[i];
        far[i] = sign * (vertical ? c[i].y : c[i].x) - limit;
        outside += far[i] > 0;
    }
    if (outside == 0)
        return count;
    for (int i = 0; i < count; i++) {
        int next = i + 1 == count ? 0 : i + 1;
        if (far[i] <= 0 && result < CORNERS_MAX)
            c[result++] = in[i];
        if ((far[i] <= 0) == (far[next] <= 0) || result == CORNERS_MAX)
            continue;
        int32_t a = abs_i32(far[i]), b = abs_i32(far[next]);
        c[result++] = corner_between(&in[i], &in[next], ratio_q30(a, (int64_t)a + b) >> 14);
    }
    return result;
}

static int32_t depth_ratio(int32_t middle, int32_t pose)
{
    uint32_t d = (uint32_t)max_i32(pose, 1);
    int zeros = count_leading_zeros(d);
    int32_t ratio = (int32_t)mulh_u32((uint32_t)max_i32(middle, 1), recip_norm(d << zeros));     /* q(29 - zeros) */
    return min_i32(scale_sat(ratio, zeros - 13), 16 << 16);
}

/* a / b for b > 0 and |a| < 2^43, b < 2^24, saturated. */
static int32_t quotient(int64_t a, int64_t b)
{
    uint64_t size = (uint64_t)(a < 0 ? -a : a);
    int zeros = count_leading_zeros_64((uint64_t)b);                            /* 40 .. 63 */
    uint32_t r = recip_norm((uint32_t)((uint64_t)b << zeros >> 32));            /* 2^(93 - zeros) / b */
    uint64_t q = (size >> 12) * r >> (81 - zeros);
    const uint64_t most = 1 << 22;
    int32_t result = (int32_t)(q < most ? q : most);
    return a < 0 ? -result : result;
}

/* Where the point of the surface at a corner is in a pose, less where it is, q8 px: in perspective. Places in a pose are
 * linear in space, so times the ratio of depths they are linear on the screen. */
static void corner_moves(int32_t out[2], const struct way *w, const struct corner *c, int pose)
{
    int64_t sum = 0, x = 0, y = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = w->record[i], *p = v + w->segment->motion + pose * PATH_POSE_WORDS;
        int64_t share = (int64_t)c->weight[i] * w->ratio[pose][i] >> 16;
        sum += share;
        x += share * (p[PATH_X] - w->ox - c->x);
        y += share * (p[PATH_Y] - w->oy - c->y);
    }
    sum = sum < 1 ? 1 : sum;
    out[0] = quotient(x, sum);
    out[1] = quotient(y, sum);
}

static struct sample corner_sample(const struct way *w, const struct corner *c)
{
    int32_t open[2], close[2];
    corner_moves(open, w, c, 0);
    corner_moves(close, w, c, 1);
    return (struct sample){ c->x, c->y, close[0] - open[0], close[1] - open[1], open[0] + close[0], open[1] + close[1] };
}

/* Depths change alike at all vertices: displacements are linear on the screen, too. */
static bool is_affine(const struct way *w)
{
    if (w->segment->flat_depth)
        return true;
    for (int pose = 0; pose < 2; pose++) {
        int32_t low = min_i32(w->ratio[pose][0], min_i32(w->ratio[pose][1], w->ratio[pose][2]));
        int32_t high = max_i32(w->ratio[pose][0], max_i32(w->ratio[pose][1], w->ratio[pose][2]));
        if (high - low > 512)           /* off by 1/512 of a triangle's size at most */
            return false;
    }
    return true;
}

static struct sample mixed_sample(const struct sample vertex[3], const struct corner *c)
{
    struct sample s = { c->x, c->y, 0, 0, 0, 0 };
    int32_t weight[3];
    for (int i = 0; i < 3; i++) {
        weight[i] = c->weight[i] >> 6;      /* q10: displacements have 21 bits */
        s.dx += (int32_t)((int64_t)vertex[i].dx * weight[i] >> 10);
        s.dy += (int32_t)((int64_t)vertex[i].dy * weight[i] >> 10);
        s.bx += (int32_t)((int64_t)vertex[i].bx * weight[i] >> 10);
        s.by += (int32_t)((int64_t)vertex[i].by * weight[i] >> 10);
    }
    return s;
}

/* Samples of a triangle within `half` of the tile's middle: its corners there. */
static int find_samples(struct sample out[CORNERS_MAX], struct way *w, int32_t half)
{
    struct corner c[CORNERS_MAX];
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        out[i] = vertex_sample(w, i);
        inside = inside && abs_i32(out[i].x) <= half && abs_i32(out[i].y) <= half;
        c[i] = (struct corner){ out[i].x, out[i].y, { i == 0 ? 65536 : 0, i == 1 ? 65536 : 0, i == 2 ? 65536 : 0 } };
    }
    if (inside)
        return 3;
    int count = cut_corners(c, 3, false, 1, half);
    count = cut_corners(c, count, false, -1, half);
    count = cut_corners(c, count, true, 1, half);
    count = cut_corners(c, count, true, -1, half);
    for (int pose = 0; pose < 2 && count != 0; pose++)
        for (int i = 0; i < 3; i++)
            w->ratio[pose][i] = w->segment->flat_depth ? 65536
                : depth_ratio(w->record[i][VERTEX_DEPTH],
                              w->record[i][w->segment->motion + pose * PATH_POSE_WORDS + PATH_DEPTH]);
    if (count != 0 && is_affine(w)) {
        struct sample vertex[3] = { out[0], out[1], out[2] };
        for (int i = 0; i < count; i++)
            out[i] = mixed_sample(vertex, &c[i]);
        return count;
    }
    for (int i = 0; i < count; i++)
        out[i] = corner_sample(w, &c[i]);
    return count;
}

/* ------------------------------------------------------------------ the fit */

/* Sums over samples; places in quarter pixels, displacements in q8 px. */
struct sums {
    int64_t n, x, y, xx, xy, yy;
    int64_t dx, dy, x_dx, y_dx, x_dy, y_dy, bx, by;
};

static void sums_add(struct sums *s, const struct sample *p)
{
    int32_t x = p->x >> 6, y = p->y >> 6;
    s->n++;
    s->x += x;
    s->y += y;
    s->xx += x * x;
    s->xy += x * y;
    s->yy += y * y;
    s->dx += p->dx;
    s->dy += p->dy;
    s->x_dx += (int64_t)x * p->dx;
    s->y_dx += (int64_t)y * p->dx;
    s->x_dy += (int64_t)x * p->dy;
    s->y_dy += (int64_t)y * p->dy;
    s->bx += p->bx;
    s->by += p->by;
}

/* Signed a / b for b > 0 in q`shift`, saturated to 31 bits; both are brought to fewer bits first. */
static int32_t ratio_q(int64_t a, int64_t b, int shift)
{
    uint64_t size = (uint64_t)(a < 0 ? -a : a);
    if (size == 0)
        return 0;
    int za = count_leading_zeros_64(size), zb = count_leading_zeros_64((uint64_t)b);
    uint32_t an = (uint32_t)(size << za >> 32), bn = (uint32_t)((uint64_t)b << zb >> 32);
    uint32_t q = mulh_u32(an, recip_norm(bn));          /* a / b 2^(29 + za - zb) */
    int down = 29 + za - zb - shift;
    int32_t result = down >= 32 ? 0 : down >= 0 ? (int32_t)(q >> down) : scale_sat((int32_t)q, -down);
    return a < 0 ? -result : result;
}

/* Least squares. */
static void solve(struct smear_smooth_field *f, const struct sums *s)
{
    /* n times the covariances. */
    int64_t xx = s->n * s->xx - s->x * s->x, xy = s->n * s->xy - s->x * s->y, yy = s->n * s->yy - s->y * s->y;
    int64_t xdx = s->n * s->x_dx - s->x * s->dx, ydx = s->n * s->y_dx - s->y * s->dx;
    int64_t xdy = s->n * s->x_dy - s->x * s->dy, ydy = s->n * s->y_dy - s->y * s->dy;
    int64_t most = xx + yy;
    int down = 0;
    while (most >> down >= 1 << 20)     /* products of two stay within 63 bits: displacements have 22 bits at most */
        down++;
    xx >>= down;
    xy >>= down;
    yy >>= down;
    xdx >>= down;
    ydx >>= down;
    xdy >>= down;
    ydy >>= down;
    int64_t det = xx * yy - xy * xy;
    *f = (struct smear_smooth_field){ 0 };
    if (det > (xx + yy) * (xx + yy) >> 12) {            /* places are not on a line */
        /* q8 px per quarter pixel to q16 px per pixel. */
        f->xx = ratio_q(xdx * yy - ydx * xy, det, 10);
        f->xy = ratio_q(ydx * xx - xdx * xy, det, 10);
        f->yx = ratio_q(xdy * yy - ydy * xy, det, 10);
        f->yy = ratio_q(ydy * xx - xdy * xy, det, 10);
    }
    int32_t mx = ratio_q(s->x, s->n, 6), my = ratio_q(s->y, s->n, 6);      /* q8 px */
    f->x = ratio_q(s->dx, s->n, 0) - (int32_t)(((int64_t)f->xx * mx + (int64_t)f->xy * my) >> 16);
    f->y = ratio_q(s->dy, s->n, 0) - (int32_t)(((int64_t)f->yx * mx + (int64_t)f->yy * my) >> 16);
    /* c = J v - b, with b = 2 (open + close - 2 middle). */
    f->bend_x = (int32_t)(((int64_t)f->xx * f->x + (int64_t)f->xy * f->y) >> 16) - ratio_q(2 * s->bx, s->n, 0);
    f->bend_y = (int32_t)(((int64_t)f->yx * f->x + (int64_t)f->yy * f->y) >> 16) - ratio_q(2 * s->by, s->n, 0);
}

static int32_t departure(const struct smear_smooth_field *f, const struct sample *p)
{
    int32_t x = f->x + (int32_t)(((int64_t)f->xx * p->x + (int64_t)f->xy * p->y) >> 16);
    int32_t y = f->y + (int32_t)(((int64_t)f->yx * p->x + (int64_t)f->yy * p->y) >> 16);
    return max_i32(abs_i32(x - p->dx), abs_i32(y - p->dy));
}

/* How far taps go from pixels of the tile, px, rounded up. */
static void find_reach(struct smear_smooth_field *f, int32_t tile)
{
    int32_t half = tile << 7;           /* q8 px */
    int32_t x = abs_i32(f->x) + (int32_t)(((int64_t)(abs_i32(f->xx) + abs_i32(f->xy)) * half) >> 16);
    int32_t y = abs_i32(f->y) + (int32_t)(((int64_t)(abs_i32(f->yx) + abs_i32(f->yy)) * half) >> 16);
    /* A line of pixels strays by up to one from the way it stands for, and takes a share of the pixel beyond its end. */
    int32_t more_x = f->y != 0 || f->x != 0, more_y = f->y != 0;
    f->reach_x = (((x >> 1) + (abs_i32(f->bend_x) >> 2) + 255) >> 8) + more_x;
    f->reach_y = (((y >> 1) + (abs_i32(f->bend_y) >> 2) + 255) >> 8) + more_y;
}

/* The depth code that all of a triangle exceeds, or has. */
static uint32_t farthest_of(const struct way *w)
{
    int32_t depth = INT32_MAX;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = w->record[i], *open = v + w->segment->motion, *close = open + PATH_POSE_WORDS;
        depth = min_i32(depth, min_i32(v[VERTEX_DEPTH], min_i32(open[PATH_DEPTH], close[PATH_DEPTH])));
    }
    uint32_t units = (uint32_t)depth >> 11;
    return units < 32768u ? units : 32768u + ((units - 32768u) >> 4);
}

static void way_of(struct way *w, const struct smear_geometry *g, const struct smear_mover *m)
{
    const struct smear_triangle *t = geometry_triangle(g, m->triangle);
    w->segment = &g->segment[t->segment];
    for (int i = 0; i < 3; i++)
        w->record[i] = geometry_vertex(g, w->segment, t->vertex[i]);
}

bool smear_smooth_fit(struct smear_smooth_field *field, const struct smear_smooth_area *area,
                      const struct smear_geometry *geometry, const struct smear_smooth_list *list, int lists,
                      int32_t travel, int32_t tolerance, void *work, uint32_t work_bytes)
{
    struct way w = { .ox = area->x0 * 256 + area->tile * 128, .oy = area->y0 * 256 + area->tile * 128 };
    struct sums sums = { 0 };
    struct sample *sample = (struct sample *)work;
    const uint32_t limit = work_bytes / sizeof *sample;
    const int32_t half = area->tile * 128 + (travel >> 1) + 256;    /* what is farther in the middle does not come here */
    const int32_t left = max_i32(w.ox - half, 0) >> 8 >> area->tile_shift, right = (w.ox + half) >> 8 >> area->tile_shift;
    uint32_t n = 0, farthest = UINT16_MAX;
    for (int k = 0; k < lists; k++) {
        for (uint32_t i = 0; i < list[k].count; i++) {
            const struct smear_mover *m = &list[k].mover[i];
            if (m->last < left || m->first > right)
                continue;
            const struct smear_path_bounds *b = geometry_bounds(geometry, m->triangle);
            if (k != 0 && b->y0 < area->y0 + area->tile && b->y1 > area->y0)
                continue;       /* it is in the tile's own row, too */
            if (n + CORNERS_MAX > limit || b->piece != 0)
                return false;
            way_of(&w, geometry, m);
            int found = find_samples(sample + n, &w, half);
            if (found == 0)
                continue;
            farthest = min_u32(farthest, farthest_of(&w));
            for (; found > 0; found--)
                sums_add(&sums, &sample[n++]);
        }
    }
    if (n == 0)
        return false;
    solve(field, &sums);
    for (uint32_t i = 0; i < n; i++)
        if (departure(field, &sample[i]) > tolerance)
            return false;
    field->farthest = (uint16_t)farthest;
    find_reach(field, area->tile);
    return true;
}

/* ------------------------------------------------------------------ the mean */

/* A tap: s and what the bend adds at s, q16 px. */
struct tap {
    int32_t s;                  /* q16, 0 .. 1/2 */
    int32_t bend_x, bend_y;
};

enum { TAPS_MAX = 64 };

static void taps_place(struct tap tap[TAPS_MAX / 2], const struct smear_smooth_field *f, int32_t taps)
{
    for (int32_t i = 0; i < taps / 2; i++) {
        int32_t s = (2 * i + 1) * 65536 / (2 * taps), square = s * (s >> 2) >> 14;      /* q16; s < 2^15 */
        tap[i] = (struct tap){ s, (int32_t)((int64_t)f->bend_x * square >> 8), (int32_t)((int64_t)f->bend_y * square >> 8) };
    }
}

/* ------------------------------------------------------------------ what is seen */

struct channels {
    uint32_t r, g, b;           /* codes, or linear light */
};

SMEAR_INLINE struct channels channels_of(uint32_t p, bool linear)
{
    if (linear)
        return (struct channels){ smear_srgb_decode[pixel_red(p)], smear_srgb_decode[pixel_green(p)],
                                  smear_srgb_decode[pixel_blue(p)] };
    return (struct channels){ pixel_red(p), pixel_green(p), pixel_blue(p) };
}

/* Index of the movers' pixel (x, y). */
SMEAR_INLINE uint32_t mover_index(const struct smear_smooth_source *s, int32_t x, int32_t y)
{
    return s->offset[y - s->first] + (uint32_t)x;
}

/* ------------------------------------------------------------------ taps */

/* Encoded: `all` and `red_blue` hold red and blue, the first also green, 256 times. */
struct tap_sums {
    struct channels c;
    uint32_t all, red_blue, count;
};

SMEAR_INLINE void add_tap(struct tap_sums *t, const struct smear_smooth_source *s, uint32_t at, uint32_t still_depth,
                          bool linear)
{
    if (s->depth[at] <= still_depth)
        return;
    uint32_t p = s->color[at];
    t->count++;
    if (linear) {
        struct channels c = channels_of(p, true);
        t->c.r += c.r;
        t->c.g += c.g;
        t->c.b += c.b;
    } else {
        t->all += p;
        t->red_blue += p & 0xff00ffu;
    }
}

/* `over` is 2^24 / n, rounded up: equal values keep their mean. */
SMEAR_INLINE uint32_t mean_of_taps(const struct tap_sums *t, uint32_t still, uint32_t n, uint32_t over, bool linear)
{
    struct channels c = t->c, rest = { 0, 0, 0 };
    if (t->count != n)
        rest = channels_of(still, linear);
    uint32_t k = n - t->count;
    if (linear)
        return pixel_make(0, smear_srgb_encode[mulh_u32((c.r + k * rest.r) << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32((c.g + k * rest.g) << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32((c.b + k * rest.b) << 8, over) >> 4]);
    uint32_t q16 = over >> 8;
    c.r = (t->red_blue >> 16) + k * rest.r;
    c.g = ((t->all - t->red_blue) >> 8 & 0xffffu) + k * rest.g;
    c.b = (t->red_blue & 0xffffu) + k * rest.b;
    return pixel_make(0, (c.r * q16 + 0x8000u) >> 16, (c.g * q16 + 0x8000u) >> 16, (c.b * q16 + 0x8000u) >> 16);
}

SMEAR_INLINE uint32_t mean_along(const struct smear_smooth_source *source, const struct tap *tap, int32_t taps,
                                 int32_t x, int32_t y, int32_t vx, int32_t vy, uint32_t over, uint32_t still,
                                 uint32_t still_depth, bool linear)
{
    struct tap_sums sums = { { 0, 0, 0 }, 0, 0, 0 };
    x = (x << 16) + 0x8000;
    y = (y << 16) + 0x8000;
    for (int32_t i = 0; i < taps / 2; i++) {
        int32_t dx = vx * (tap[i].s >> 4) >> 4, dy = vy * (tap[i].s >> 4) >> 4;     /* q8 x q12 to q16 */
        int32_t mx = x + tap[i].bend_x, my = y + tap[i].bend_y;
        add_tap(&sums, source, mover_index(source, (mx - dx) >> 16, (my - dy) >> 16), still_depth, linear);
        add_tap(&sums, source, mover_index(source, (mx + dx) >> 16, (my + dy) >> 16), still_depth, linear);
    }
    return mean_of_taps(&sums, still, (uint32_t)taps, over, linear);
}

static uint32_t mean_by_taps(uint32_t *out, const struct smear_smooth_source *source,
                             const struct smear_smooth_field *field, const struct smear_smooth_area *a, int32_t taps,
                             bool linear)
{
    struct tap tap[TAPS_MAX / 2];
    taps = clamp_i32(taps + 1, 2, TAPS_MAX) & ~1;
    taps_place(tap, field, taps);
    uint32_t over = ((1u << 24) + (uint32_t)taps - 1u) / (uint32_t)taps;
    const uint32_t *still = source->still;
    const uint16_t *depth = source->still_depth;
    for (int32_t y = a->y0; y < a->y1; y++, out += a->tile, still += source->stride, depth += source->stride) {
        /* Displacement at the row's first pixel, q16 px: places from the tile's middle are odd halves of pixels. */
        int32_t rx = 1 - a->tile, ry = 2 * (y - a->y0) + 1 - a->tile;
        int32_t vx = field->x * 256 + ((field->xx * rx + field->xy * ry) >> 1);
        int32_t vy = field->y * 256 + ((field->yx * rx + field->yy * ry) >> 1);
        for (int32_t x = a->x0, i = 0; x < a->x1; x++, i++, vx += field->xx, vy += field->yx)
            out[i] = linear ? mean_along(source, tap, taps, x, y, vx >> 8, vy >> 8, over, still[i], depth[i], true)
                            : mean_along(source, tap, taps, x, y, vx >> 8, vy >> 8, over, still[i], depth[i], false);
    }
    return (uint32_t)(taps * (a->x1 - a->x0) * (a->y1 - a->y0));
}

/* ------------------------------------------------------------------ the box */

/* All pixels of the tile have one way, and no still surface lies before a mover: lines along the way, with a pixel per
 * step of its longer axis, the same for all pixels on them. A sum that slides along a line gives the mean of each. */
struct line {
    bool upright;               /* steps go down, not right */
    int32_t slope;              /* of the other axis, q16, within -1 .. 1 */
    int32_t half;               /* whole pixels on both sides of the middle one */
    uint32_t rest;              /* share of the ones beyond, q8 */
    uint32_t length;            /* q8 px */
    uint32_t over;              /* 2^30 / length, rounded up */
};

static struct line line_make(const struct smear_smooth_field *f)
{
    struct line l = { .upright = abs_i32(f->y) > abs_i32(f->x) };
    int32_t major = l.upright ? f->y : f->x, minor = l.upright ? f->x : f->y;
    int32_t length = max_i32(abs_i32(major), 256);
    l.slope = ratio_q(major < 0 ? -(int64_t)minor : minor, length, 16);
    l.half = (length - 256) >> 9;
    l.rest = (uint32_t)(length - 256 - (l.half << 9)) >> 1;
    l.length = 256u + ((uint32_t)l.half << 9) + 2u * l.rest;
    l.over = ((1u << 30) + l.length - 1u) / l.length;
    return l;
}

/* How far the line has strayed at step i from the tile's first pixel. */
static inline int32_t stray(const struct line *l, int32_t i)
{
    return (l->slope * i + 0x8000) >> 16;
}

static inline uint32_t line_index(const struct smear_smooth_source *s, const struct smear_smooth_area *a,
                                  const struct line *l, int32_t along, int32_t across)
{
    across += stray(l, along);
    return mover_index(s, a->x0 + (l->upright ? across : along), a->y0 + (l->upright ? along : across));
}

struct box_sums {
    struct channels c;
    uint32_t count;
};

/* Where there is no mover the colour is 0. */
SMEAR_INLINE void box_add(struct box_sums *b, const struct smear_smooth_source *s, uint32_t at, bool linear)
{
    struct channels c = channels_of(s->color[at], linear);
    b->c.r += c.r;
    b->c.g += c.g;
    b->c.b += c.b;
    b->count += s->depth[at] != 0;
}

SMEAR_INLINE void box_drop(struct box_sums *b, const struct smear_smooth_source *s, uint32_t at, bool linear)
{
    struct channels c = channels_of(s->color[at], linear);
    b->c.r -= c.r;
    b->c.g -= c.g;
    b->c.b -= c.b;
    b->count -= s->depth[at] != 0;
}

/* (256 sum + rest ends + (length - covered) still) / length, to nearest. Linear: 16-bit values of up to 129 px, whose sum
 * has 31 bits in q7. */
SMEAR_INLINE uint32_t box_mean(uint32_t sum, uint32_t ends, uint32_t still, uint32_t uncovered, const struct line *l,
                               bool linear)
{
    if (linear) {
        uint32_t q7 = sum * 128u + (ends * l->rest >> 1) + (still * uncovered >> 1);
        return smear_srgb_encode[min_u32(mulh_u32(q7, l->over) >> 1, 4095u)];
    }
    uint32_t q8 = sum * 256u + ends * l->rest + still * uncovered;      /* below 2^23 */
    return min_u32(mulh_u32((q8 << 2) + (l->length << 1), l->over), 255u);
}

SMEAR_INLINE uint32_t box_pixel(const struct box_sums *s, const struct box_sums *ends, uint32_t still,
                                const struct line *l, bool linear)
{
    uint32_t uncovered = l->length - (s->count << 8) - ends->count * l->rest;
    struct channels rest = { 0, 0, 0 };
    if (uncovered == l->length)
        return still;
    if (uncovered != 0)
        rest = channels_of(still, linear);
    return pixel_make(0, box_mean(s->c.r, ends->c.r, rest.r, uncovered, l, linear),
                      box_mean(s->c.g, ends->c.g, rest.g, uncovered, l, linear),
                      box_mean(s->c.b, ends->c.b, rest.b, uncovered, l, linear));
}

SMEAR_INLINE void box_line(uint32_t *out, const struct smear_smooth_source *source, const struct smear_smooth_area *a,
                           const struct line *l, int32_t across, bool linear)
{
    int32_t length = l->upright ? a->y1 - a->y0 : a->x1 - a->x0, width = l->upright ? a->x1 - a->x0 : a->y1 - a->y0;
    int32_t first = 0, end = length;
    while (first < end && (uint32_t)(across + stray(l, first)) >= (uint32_t)width)
        first++;
    while (end > first && (uint32_t)(across + stray(l, end - 1)) >= (uint32_t)width)
        end--;
    if (first == end)
        return;
    struct box_sums sums = { { 0, 0, 0 }, 0 };
    for (int32_t i = first - l->half; i <= first + l->half; i++)
        box_add(&sums, source, line_index(source, a, l, i, across), linear);
    for (int32_t i = first; i < end; i++) {
        struct box_sums ends = { { 0, 0, 0 }, 0 };
        uint32_t after = line_index(source, a, l, i + l->half + 1, across);
        box_add(&ends, source, line_index(source, a, l, i - l->half - 1, across), linear);
        box_add(&ends, source, after, linear);
        int32_t side = across + stray(l, i), x = l->upright ? side : i, y = l->upright ? i : side;
        out[y * a->tile + x] = box_pixel(&sums, &ends, source->still[y * source->stride + x], l, linear);
        box_add(&sums, source, after, linear);
        box_drop(&sums, source, line_index(source, a, l, i - l->half, across), linear);
    }
}

static void mean_by_box(uint32_t *out, const struct smear_smooth_source *source, const struct smear_smooth_field *field,
                        const struct smear_smooth_area *a, bool linear)
{
    struct line l = line_make(field);
    int32_t length = l.upright ? a->y1 - a->y0 : a->x1 - a->x0, width = l.upright ? a->x1 - a->x0 : a->y1 - a->y0;
    int32_t shift = stray(&l, length - 1);
    for (int32_t across = -max_i32(shift, 0); across < width - min_i32(shift, 0); across++) {
        if (linear)
            box_line(out, source, a, &l, across, true);
        else
            box_line(out, source, a, &l, across, false);
    }
}

/* Ways of the tile's pixels differ by no more than 3/8 px at their ends. */
static bool has_one_way(const struct smear_smooth_field *f, int32_t tile)
{
    int32_t x = (abs_i32(f->xx) + abs_i32(f->xy)) * tile >> 2, y = (abs_i32(f->yx) + abs_i32(f->yy)) * tile >> 2;
    return max_i32(x, y) <= 3 << 13 && max_i32(abs_i32(f->bend_x), abs_i32(f->bend_y)) <= 384
        && max_i32(abs_i32(f->x), abs_i32(f->y)) <= 127 * 256;
}

static bool is_before_all(const struct smear_smooth_source *s, const struct smear_smooth_field *f,
                          const struct smear_smooth_area *a)
{
    const uint16_t *depth = s->still_depth;
    for (int32_t y = a->y0; y < a->y1; y++, depth += s->stride)
        for (int32_t i = 0; i < a->x1 - a->x0; i++)
            if (depth[i] >= f->farthest)
                return false;
    return true;
}

uint32_t smear_smooth_tile(uint32_t *out, const struct smear_smooth_source *source,
                           const struct smear_smooth_field *field, const struct smear_smooth_area *area, int32_t taps,
                           bool linear)
{
    if (!has_one_way(field, area->tile) || !is_before_all(source, field, area))
        return mean_by_taps(out, source, field, area, taps, linear);
    mean_by_box(out, source, field, area, linear);
    return (uint32_t)((area->x1 - area->x0) * (area->y1 - area->y0));
}
