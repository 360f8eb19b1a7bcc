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
    f->reach_x = ((x >> 1) + (abs_i32(f->bend_x) >> 2) + 255) >> 8;
    f->reach_y = ((y >> 1) + (abs_i32(f->bend_y) >> 2) + 255) >> 8;
}

static void way_of(struct way *w, const struct smear_geometry *g, const struct smear_mover *m)
{
    const struct smear_triangle *t = geometry_triangle(g, m->triangle);
    w->segment = &g->segment[t->segment];
    for (int i = 0; i < 3; i++)
        w->record[i] = geometry_vertex(g, w->segment, t->vertex[i]);
}

bool smear_smooth_fit(struct smear_smooth_field *field, const struct smear_geometry *geometry,
                      const struct smear_mover *mover, uint32_t count, int32_t column, int32_t x0, int32_t y0,
                      int32_t tile, int32_t travel, int32_t tolerance)
{
    struct way w = { .ox = x0 * 256 + tile * 128, .oy = y0 * 256 + tile * 128 };
    struct sums sums = { 0 };
    struct sample sample[CORNERS_MAX];
    const int32_t half = tile * 128 + (travel >> 1) + 256;      /* what is farther in the middle does not come here */
    for (uint32_t i = 0; i < count; i++) {
        if (!mover_is_in(&mover[i], column))
            continue;
        if (geometry_bounds(geometry, mover[i].triangle)->piece != 0)
            return false;
        way_of(&w, geometry, &mover[i]);
        int n = find_samples(sample, &w, half);
        for (int k = 0; k < n; k++)
            sums_add(&sums, &sample[k]);
    }
    if (sums.n == 0)
        return false;
    solve(field, &sums);
    for (uint32_t i = 0; i < count; i++) {
        if (!mover_is_in(&mover[i], column))
            continue;
        way_of(&w, geometry, &mover[i]);
        int n = find_samples(sample, &w, half);
        for (int k = 0; k < n; k++)
            if (departure(field, &sample[k]) > tolerance)
                return false;
    }
    find_reach(field, tile);
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

/* Encoded: both sums hold red and blue; the difference is green, 256 times. */
struct color_sums {
    uint32_t r, g, b, all, red_blue;
};

SMEAR_INLINE void add_pixel(struct color_sums *s, uint32_t p, bool linear)
{
    if (linear) {
        s->r += smear_srgb_decode[pixel_red(p)];
        s->g += smear_srgb_decode[pixel_green(p)];
        s->b += smear_srgb_decode[pixel_blue(p)];
    } else {
        s->all += p;
        s->red_blue += p & 0xff00ffu;
    }
}

/* `over` is 2^24 / n, rounded up: equal values keep their mean. */
SMEAR_INLINE uint32_t mean_of(const struct color_sums *s, uint32_t over, bool linear)
{
    if (linear)
        return pixel_make(0, smear_srgb_encode[mulh_u32(s->r << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(s->g << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(s->b << 8, over) >> 4]);
    uint32_t q16 = over >> 8, g = (s->all - s->red_blue) >> 8 & 0xffffu;
    return pixel_make(0, ((s->red_blue >> 16) * q16 + 0x8000u) >> 16, (g * q16 + 0x8000u) >> 16,
                      ((s->red_blue & 0xffffu) * q16 + 0x8000u) >> 16);
}

SMEAR_INLINE uint32_t mean_along(const struct smear_smooth_source *source, const struct tap *tap, int32_t taps,
                                 int32_t x, int32_t y, int32_t vx, int32_t vy, uint32_t over, bool linear)
{
    struct color_sums sums = { 0, 0, 0, 0, 0 };
    const uint32_t *offset = source->offset - source->first;
    x = (x << 16) + 0x8000;
    y = (y << 16) + 0x8000;
    for (int32_t i = 0; i < taps / 2; i++) {
        int32_t dx = vx * (tap[i].s >> 4) >> 4, dy = vy * (tap[i].s >> 4) >> 4;     /* q8 x q12 to q16 */
        int32_t mx = x + tap[i].bend_x, my = y + tap[i].bend_y;
        add_pixel(&sums, source->color[offset[(my - dy) >> 16] + (uint32_t)((mx - dx) >> 16)], linear);
        add_pixel(&sums, source->color[offset[(my + dy) >> 16] + (uint32_t)((mx + dx) >> 16)], linear);
    }
    return mean_of(&sums, over, linear);
}

uint32_t smear_smooth_tile(uint32_t *out, int32_t stride, const struct smear_smooth_source *source,
                           const struct smear_smooth_field *field, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
                           int32_t tile, int32_t taps, bool linear)
{
    struct tap tap[TAPS_MAX / 2];
    taps = clamp_i32(taps + 1, 2, TAPS_MAX) & ~1;
    taps_place(tap, field, taps);
    uint32_t over = ((1u << 24) + (uint32_t)taps - 1u) / (uint32_t)taps;
    for (int32_t y = y0; y < y1; y++, out += stride) {
        /* Displacement at the row's first pixel, q16 px: places from the tile's middle are odd halves of pixels. */
        int32_t rx = 1 - tile, ry = 2 * (y - y0) + 1 - tile;
        int32_t vx = field->x * 256 + ((field->xx * rx + field->xy * ry) >> 1);
        int32_t vy = field->y * 256 + ((field->yx * rx + field->yy * ry) >> 1);
        for (int32_t x = x0; x < x1; x++, vx += field->xx, vy += field->yx)
            out[x - x0] = linear ? mean_along(source, tap, taps, x, y, vx >> 8, vy >> 8, over, true)
                                 : mean_along(source, tap, taps, x, y, vx >> 8, vy >> 8, over, false);
    }
    return (uint32_t)(taps * (x1 - x0) * (y1 - y0));
}
