/* SPDX-License-Identifier: MIT */
/* row_lists.c - see row_lists.h. */
#include "temporal/row_lists.h"

#include "base/fixmath.h"
#include "geometry/transform.h"
#include "raster/kept.h"
#include "temporal/row_blocks.h"

struct smear_closing smear_closing_of(int32_t x, int32_t y, int32_t unlike)
{
    enum {
        LEFT = 13,              /* q8: of the squared error where all goes alike: instants are sharp, pixels square */
        WON = 65536 / 4,        /* q16: by closing; so it pays for instants two thirds of a pixel apart or farther */
        UNLIKE_LOG2 = 6,        /* the rest goes with the square of what is unlike, q8 */
        ROUNDED = 10066330,     /* q24: 0.6 of what an instant per pixel of the path leaves */
        FLOOR = 1677722         /* q24: 0.1 of that: ends of edges' ways are rounded */
    };
    const uint32_t square = (uint32_t)(x * x + y * y) + 1u, apart = (uint32_t)min_i32(unlike, 32767) * (uint32_t)min_i32(unlike, 32767);
    struct smear_closing c = { 256, 0, 0, 0, unlike };
    if (apart >> 1 >= 2 * square || unlike == INT16_MAX)
        return c;
    c.left = min_u32(LEFT + apart / max_u32(square >> UNLIKE_LOG2, 1), 256);
    c.rounded = min_u32(ROUNDED / square, 65536);
    c.floor = min_u32((FLOOR + (c.left - LEFT) * 4 * 65536) / square, 65536);
    c.last = closed_instants(WON, max_u32(c.floor, 1));
    return c;
}

struct smear_closing smear_block_closing(const struct smear_row_blocks *b, int32_t column, int32_t row, int32_t rows)
{
    enum { SPARSE = BLOCK_PX * BLOCK_PX * 3 / 8 };      /* pixels: there is more to be seen of what lies behind */
    static const int8_t beside[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    const struct smear_block *here = block_at(b, column, row);
    /* Instants of a curve go on along its chord in the middle alone. */
    int32_t unlike = block_curvature(here);
    for (int i = 0; i < 4; i++) {
        const int32_t c = column + beside[i][0], r = row + beside[i][1];
        if (c < 0 || c >= b->columns || r < 0 || r >= rows)
            continue;
        const struct smear_block *there = block_at(b, c, r);
        if (there->depth != 0)
            unlike = max_i32(unlike, max_i32(abs_i32(here->x - there->x), abs_i32(here->y - there->y)));
    }
    if (here->last != 0 && here->last < SPARSE && 2 * unlike > max_i32(abs_i32(here->x), abs_i32(here->y)))
        return (struct smear_closing){ 256, 0, 0, 0, unlike };
    return smear_closing_of(here->x, here->y, unlike);
}

struct range {
    int32_t low, high;              /* [low, high) */
};

static inline bool range_has(struct range r, int32_t at) { return at >= r.low && at < r.high; }

/* The displacements of a moving triangle from open to close, 1/16 px: the least and the largest of its vertices. For a
 * large one whose vertices differ, the rest tells the displacement from place to place: weights of the vertices in the
 * middle of the exposure give weights at its ends. */
struct displacements {
    int32_t x0, x1, y0, y1, curvature;
    bool large;
    int32_t x[3], y[3];             /* vertices in the middle of the exposure, px */
    struct {
        int32_t x[3], y[3];         /* at open and close, 1/8 px */
        int32_t weight[3];          /* how much farther away than in the middle, q8 */
    } pose[2];
};

enum {
    ALIKE = 8 * 16,                 /* displacements need not be told apart */
    WEIGHT_BITS = 14,
    MEAN_MAX = 2000 * 16             /* longer displacements count as this one in a mean */
};

/* Returns a / b, two depths, in q8 within 1/16 .. 16. */
static int32_t depth_ratio(int32_t a, int32_t b)
{
    const uint32_t depth = (uint32_t)b | 1u;
    const int zeros = count_leading_zeros(depth);
    const uint32_t ratio = mulh_u32((uint32_t)a, recip_norm(depth << zeros));      /* 2^(29 - zeros) a / b */
    return clamp_i32((int32_t)(zeros <= 21 ? min_u32(ratio >> (21 - zeros), 4096)
                                           : min_u32(ratio, 4096u) << (zeros - 21)),
                     16, 4096);
}

/* Vertices in the middle of the exposure, px; displacements, 1/16 px; and depths. */
struct corners {
    int32_t x[3], y[3], dx[3], dy[3], depth[3];
};

static SMEAR_NOINLINE void corners_of(struct corners *c, const struct smear_bins *g, uint32_t triangle)
{
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    for (int i = 0; i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]), *open = v + s->motion, *close = open + PATH_POSE_WORDS;
        c->x[i] = v[VERTEX_X] >> 8;
        c->y[i] = v[VERTEX_Y] >> 8;
        c->dx[i] = (close[PATH_X] - open[PATH_X]) >> 4;
        c->dy[i] = (close[PATH_Y] - open[PATH_Y]) >> 4;
        c->depth[i] = v[VERTEX_DEPTH] >> 14;
    }
}

static SMEAR_NOINLINE void displacements_of(struct displacements *w, const struct smear_bins *g, uint32_t triangle, const struct corners *c)
{
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    w->x0 = min_i32(c->dx[0], min_i32(c->dx[1], c->dx[2]));
    w->x1 = max_i32(c->dx[0], max_i32(c->dx[1], c->dx[2]));
    w->y0 = min_i32(c->dy[0], min_i32(c->dy[1], c->dy[2]));
    w->y1 = max_i32(c->dy[0], max_i32(c->dy[1], c->dy[2]));
    w->curvature = b->curvature;
    w->large = (b->flags & PATH_LARGE) != 0
            && (w->x1 - w->x0 > ALIKE || w->y1 - w->y0 > ALIKE);
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    for (int i = 0; w->large && i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]);
        w->x[i] = c->x[i];
        w->y[i] = c->y[i];
        for (int k = 0; k < 2; k++) {
            const int32_t *pose = v + s->motion + k * PATH_POSE_WORDS;
            w->pose[k].x[i] = pose[PATH_X] >> 5;
            w->pose[k].y[i] = pose[PATH_Y] >> 5;
            w->pose[k].weight[i] = depth_ratio(v[VERTEX_DEPTH], pose[PATH_DEPTH]);
        }
    }
}

static int shift_to(int32_t largest)
{
    return max_i32(32 - count_leading_zeros((uint32_t)largest | 1u) - WEIGHT_BITS, 0);
}

/* Finds the weights of the vertices at a pixel. Beside the triangle they are those of the nearest place on the side that
 * the pixel is farthest beyond; `at` becomes that place. */
static void weigh(int32_t e[3], const struct displacements *w, int32_t at[2])
{
    const int32_t x = at[0], y = at[1];
    static const int next[3] = { 1, 2, 0 }, last[3] = { 2, 0, 1 };
    int beyond = 0;
    for (int i = 0; i < 3; i++) {
        const int j = next[i], k = last[i];
        e[i] = (w->x[j] - x) * (w->y[k] - y) - (w->x[k] - x) * (w->y[j] - y);
        beyond = e[i] < e[beyond] ? i : beyond;
    }
    if (e[beyond] >= 0)
        return;
    const int j = next[beyond], k = last[beyond];
    const int32_t dx = w->x[k] - w->x[j], dy = w->y[k] - w->y[j], square = max_i32(dx * dx + dy * dy, 1);
    e[beyond] = 0;
    e[k] = clamp_i32((x - w->x[j]) * dx + (y - w->y[j]) * dy, 0, square);
    e[j] = square - e[k];
    at[0] = w->x[j] + dx * (e[k] >> 8) / max_i32(square >> 8, 1);
    at[1] = w->y[j] + dy * (e[k] >> 8) / max_i32(square >> 8, 1);
}

/* A displacement, and how far the path's middle lies off the chord, 1/16 px: eight times as far, as paths beside the one
 * looked at may be more curved, but no farther than at a vertex. */
struct displacement {
    int32_t x, y, curvature;
};

/* Returns the displacement at a pixel of the triangle, or near one. It may leave the range of the vertices: where a
 * camera turns, what is straight ahead goes less far than what is aside. */
static struct displacement displacement_at(const struct displacements *w, int32_t x, int32_t y)
{
    int32_t e[3], at[2][2], middle[2] = { x, y };
    weigh(e, w, middle);
    int shift = shift_to(max_i32(e[0], max_i32(e[1], e[2])));
    for (int k = 0; k < 2; k++) {
        int32_t m[3];
        for (int i = 0; i < 3; i++)
            m[i] = (e[i] >> shift) * w->pose[k].weight[i];
        int down = shift_to(max_i32(m[0], max_i32(m[1], m[2])));
        int32_t sum = max_i32((m[0] >> down) + (m[1] >> down) + (m[2] >> down), 1);
        at[k][0] = at[k][1] = 0;
        for (int i = 0; i < 3; i++) {
            at[k][0] += (m[i] >> down) * w->pose[k].x[i];
            at[k][1] += (m[i] >> down) * w->pose[k].y[i];
        }
        at[k][0] /= sum;
        at[k][1] /= sum;
    }
    const int32_t curvature = max_i32(abs_i32(at[0][0] + at[1][0] - 16 * middle[0]),
                                      abs_i32(at[0][1] + at[1][1] - 16 * middle[1]));
    return (struct displacement){ 2 * (at[1][0] - at[0][0]), 2 * (at[1][1] - at[0][1]),
                                  min_i32(8 * curvature, w->curvature) };
}

/* Adds displacements from (x0, y0) to (x1, y1) to those of a tile. */
static void add_displacement(struct smear_tile_travel *tile, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                             int32_t curvature)
{
    const int32_t x = clamp_i32((x0 + x1) >> 1, -MEAN_MAX, MEAN_MAX), y = clamp_i32((y0 + y1) >> 1, -MEAN_MAX, MEAN_MAX);
    const int32_t weight = (max_i32(abs_i32(x), abs_i32(y)) >> 4) + 1, sum = tile->weight + weight;
    const int32_t part = (weight << 15) / sum;
    tile->x = (int16_t)(tile->x + (((x - tile->x) * part + (1 << 14)) >> 15));
    tile->y = (int16_t)(tile->y + (((y - tile->y) * part + (1 << 14)) >> 15));
    tile->weight = (uint16_t)min_i32(sum, UINT16_MAX);
    tile->curvature = (uint16_t)max_i32(tile->curvature, curvature);
    tile->x0 = (int16_t)clamp_i32(x0, INT16_MIN, tile->x0);
    tile->x1 = (int16_t)clamp_i32(x1, tile->x1, INT16_MAX);
    tile->y0 = (int16_t)clamp_i32(y0, INT16_MIN, tile->y0);
    tile->y1 = (int16_t)clamp_i32(y1, tile->y1, INT16_MAX);
}

/* Displacements at the left side of a column of tiles: x where the row begins and where it ends, y likewise, and the
 * larger curvature. */
enum { SIDE_VALUES = 5 };

static void displacement_at_side(int32_t out[SIDE_VALUES], const struct displacements *w, int32_t column, int32_t top, int shift)
{
    const struct displacement upper = displacement_at(w, column << shift, top),
                              lower = displacement_at(w, column << shift, top + (1 << shift));
    out[0] = upper.x;
    out[1] = lower.x;
    out[2] = upper.y;
    out[3] = lower.y;
    out[4] = max_i32(upper.curvature, lower.curvature);
}

/* Adds the displacements of a large triangle to those columns of tiles that are wanted: found at some of the sides of all, in
 * a line between. */
static void add_along_columns(struct smear_row_moving *r, int32_t first, int32_t last, const struct displacements *w,
                              int32_t top, int shift, struct range wanted)
{
    enum { APART_PX = 64 };
    const int32_t apart = max_i32(APART_PX >> shift, 2);
    int32_t left[SIDE_VALUES], right[SIDE_VALUES];
    bool known = false;
    for (int32_t column = first, n; column <= last; column += n) {
        n = min_i32(last + 1 - column, apart);
        if (column + n <= wanted.low || column >= wanted.high)
            continue;
        const int32_t part = 256 / n;
        int32_t from[SIDE_VALUES], to[SIDE_VALUES], step[SIDE_VALUES];
        if (!known)
            displacement_at_side(left, w, column, top, shift);
        known = true;
        displacement_at_side(right, w, column + n, top, shift);
        for (int i = 0; i < SIDE_VALUES; i++) {
            from[i] = left[i];
            step[i] = (right[i] - left[i]) * part;
        }
        for (int32_t k = 1; k <= n; k++) {
            for (int i = 0; i < SIDE_VALUES; i++)
                to[i] = left[i] + (step[i] * k >> 8);
            if (range_has(wanted, column + k - 1))
                add_displacement(&r->travel[column + k - 1], min_i32(min_i32(from[0], from[1]), min_i32(to[0], to[1])),
                                 max_i32(max_i32(from[0], from[1]), max_i32(to[0], to[1])),
                                 min_i32(min_i32(from[2], from[3]), min_i32(to[2], to[3])),
                                 max_i32(max_i32(from[2], from[3]), max_i32(to[2], to[3])), max_i32(from[4], to[4]));
            for (int i = 0; i < SIDE_VALUES; i++)
                from[i] = to[i];
        }
        for (int i = 0; i < SIDE_VALUES; i++)
            left[i] = right[i];
    }
}

/* Returns the columns of pixels in which a large triangle may be seen in the row at some time, about: those of its sides
 * between rows that lie as much farther up and down as it goes. Displacements beyond them would be those of other
 * rows. */
static struct range columns_of(const struct displacements *w, const struct smear_path_bounds *b, int32_t top,
                               int32_t tile)
{
    const int32_t reach_x = max_i32(w->x1, -w->x0) >> 5, reach_y = max_i32(w->y1, -w->y0) >> 5;
    const int32_t high = top - reach_y - 1, low = top + tile + reach_y + 1;
    struct range r = { INT32_MAX, INT32_MIN };
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1;
        const int upper = w->y[i] < w->y[j] ? i : j, lower = i + j - upper;
        if (w->y[lower] < high || w->y[upper] > low)
            continue;
        const int32_t dx = w->x[lower] - w->x[upper], dy = max_i32(w->y[lower] - w->y[upper], 1);
        const int32_t from = w->x[upper] + dx * max_i32(high - w->y[upper], 0) / dy;
        const int32_t to = w->x[upper] + dx * min_i32(low - w->y[upper], dy) / dy;
        r.low = min_i32(r.low, min_i32(from, to));
        r.high = max_i32(r.high, max_i32(from, to));
    }
    return (struct range){ max_i32(r.low - reach_x - 1, b->x0), min_i32(r.high + reach_x + 2, b->x1) };
}

/* Adds what columns [x0, x1) of pixels hold to those of their tiles that are wanted: flags, and with bounds a moving
 * triangle. */
static void add_to_tiles(const struct smear_window *window, struct smear_row_moving *r, int32_t x0, int32_t x1,
                         const struct smear_path_bounds *b, const struct displacements *w, uint16_t flags, int32_t top,
                         struct range wanted)
{
    const int shift = window->tile_shift;
    const int32_t first = max_i32(max_i32(x0, 0) >> shift, wanted.low),
                  last = min_i32((min_i32(x1, window->width) - 1) >> shift, wanted.high - 1);
    for (int32_t column = first; column <= last; column++) {
        struct smear_tile_travel *tile = &r->travel[column];
        tile->flags |= flags;
        if (b == NULL)
            continue;
        tile->flags |= (uint16_t)(b->flags | TILE_MOVES);
        if (r->measures && b->space == 0 && !w->large)
            add_displacement(tile, w->x0, w->x1, w->y0, w->y1, w->curvature);
    }
    if (b == NULL || !r->measures || b->space != 0 || !w->large)
        return;
    const struct range seen = columns_of(w, b, top, window->tile);
    if (seen.low < seen.high)
        add_along_columns(r, seen.low >> shift, (seen.high - 1) >> shift, w, top, shift, wanted);
}

/* Finds the columns of pixels that a static triangle may cover. */
static void static_columns(const struct smear_bins *g, const struct smear_triangle *t, int32_t *x0, int32_t *x1)
{
    *x0 = INT32_MAX;
    *x1 = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        int32_t x = bins_vertex(g, &g->segment[t->segment], t->vertex[i])[VERTEX_X];
        *x0 = min_i32(*x0, x >> 8);
        *x1 = max_i32(*x1, (x >> 8) + 1);
    }
}

void smear_list_blended(struct smear_row_moving *r, const struct smear_bins *g, const struct smear_window *w,
                        uint32_t head, int32_t top)
{
    const struct range all = { 0, w->columns };
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_triangle *t = bins_triangle(g, i);
        int32_t x0, x1;
        if (g->segment[t->segment].path) {
            const struct smear_path_bounds *b = bins_bounds(g, i);
            struct corners c;
            struct displacements d;
            if (r->measures && b->space == 0) {
                corners_of(&c, g, i);
                displacements_of(&d, g, i, &c);
            }
            add_to_tiles(w, r, b->x0, b->x1, b, &d, TILE_BLENDED, top, all);
        } else {
            static_columns(g, t, &x0, &x1);
            add_to_tiles(w, r, x0, x1, NULL, NULL, TILE_BLENDED, top, all);
        }
    }
}

/* ------------------------------------------------------------------ blocks */

static inline uint16_t nearness(int32_t depth) { return (uint16_t)clamp_i32(depth, 1, UINT16_MAX); }

static void put_block(struct smear_block *b, int32_t x, int32_t y, int32_t curvature, uint16_t near)
{
    *b = (struct smear_block){ (int16_t)clamp_i32(x, -MEAN_MAX, MEAN_MAX), (int16_t)clamp_i32(y, -MEAN_MAX, MEAN_MAX), near,
                               block_curvature_of(curvature), 0 };
    if (max_i32(abs_i32(x), abs_i32(y)) > MEAN_MAX)     /* its direction is not that which is kept */
        b->curvature = CURVATURE_MAX;
}

/* Twice the areas between a place and a triangle's sides, and how they change from block to block. */
struct sides {
    int32_t e[3], right[3], down[3];
};

static void sides_at(struct sides *s, const struct corners *c, int32_t x, int32_t y)
{
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        s->e[i] = (c->x[j] - x) * (c->y[k] - y) - (c->x[k] - x) * (c->y[j] - y);
        s->right[i] = BLOCK_PX * (c->y[j] - c->y[k]);
        s->down[i] = BLOCK_PX * (c->x[k] - c->x[j]);
    }
}

/* Puts a triangle into a block whose middle (x, y) it covers: e, none below 0. */
static void put_covering(struct smear_block *b, const struct corners *c, const struct displacements *w, int32_t x, int32_t y,
                         const int32_t e[3])
{
    const int shift = shift_to(max_i32(e[0], max_i32(e[1], e[2])));
    int32_t sum = 0, dx = 0, dy = 0, depth = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t part = e[i] >> shift;
        sum += part;
        dx += part * c->dx[i];
        dy += part * c->dy[i];
        depth += part * (c->depth[i] >> 1);
    }
    if (sum == 0)
        return;
    const uint16_t near = nearness(depth / sum << 1);
    if (near <= b->depth)       /* before a displacement is found, which takes long */
        return;
    if (w->large) {
        const struct displacement d = displacement_at(w, x, y);
        put_block(b, d.x, d.y, d.curvature, near);
    } else {
        put_block(b, dx / sum, dy / sum, w->curvature, near);
    }
}

/* Puts a triangle of about so many pixels into the block in which it lies. */
static inline void put_small(struct smear_block *b, const struct displacements *w, uint16_t near, int32_t area)
{
    const int32_t pixels = b->last;
    if (near > b->depth)
        put_block(b, (w->x0 + w->x1) >> 1, (w->y0 + w->y1) >> 1, w->curvature, near);
    else if (pixels == 0)
        return;
    b->last = (uint8_t)min_i32(pixels + area, UINT8_MAX);
}

/* Puts a triangle that faces the eye into the wanted blocks whose middle it covers in the middle of the exposure; a small one
 * into that in which it lies. */
static void add_to_blocks(const struct smear_row_moving *r, const struct corners *c, const struct displacements *w,
                          const struct smear_window *window, int32_t top, struct range wanted)
{
    if ((c->x[1] - c->x[0]) * (c->y[2] - c->y[0]) < (c->x[2] - c->x[0]) * (c->y[1] - c->y[0]))
        return;
    const int32_t x0 = min_i32(c->x[0], min_i32(c->x[1], c->x[2])), x1 = max_i32(c->x[0], max_i32(c->x[1], c->x[2])),
                  y0 = min_i32(c->y[0], min_i32(c->y[1], c->y[2])), y1 = max_i32(c->y[0], max_i32(c->y[1], c->y[2]));
    const int32_t rows = window->tile >> BLOCK_SHIFT;
    if (x1 - x0 < BLOCK_PX && y1 - y0 < BLOCK_PX) {
        const int32_t x = (x0 + x1) >> (1 + BLOCK_SHIFT), y = (((y0 + y1) >> 1) - top) >> BLOCK_SHIFT;
        if (range_has(wanted, x) && y >= 0 && y < rows)
            put_small(block_at(&r->blocks, x, y), w, nearness(c->depth[0]), ((x1 - x0 + 1) * (y1 - y0 + 1) + 1) >> 1);
        return;
    }
    const int32_t left = max_i32(x0 >> BLOCK_SHIFT, wanted.low), right = min_i32(x1 >> BLOCK_SHIFT, wanted.high - 1);
    const int32_t upper = max_i32((y0 - top) >> BLOCK_SHIFT, 0), lower = min_i32((y1 - top) >> BLOCK_SHIFT, rows - 1);
    struct sides s;
    sides_at(&s, c, (left << BLOCK_SHIFT) + BLOCK_PX / 2, top + (upper << BLOCK_SHIFT) + BLOCK_PX / 2);
    for (int32_t y = upper; y <= lower; y++) {
        int32_t e[3] = { s.e[0], s.e[1], s.e[2] };
        bool found = false;
        for (int32_t x = left; x <= right; x++) {
            const bool covers = (e[0] | e[1] | e[2]) >= 0;
            if (covers)
                put_covering(block_at(&r->blocks, x, y), c, w, (x << BLOCK_SHIFT) + BLOCK_PX / 2,
                             top + (y << BLOCK_SHIFT) + BLOCK_PX / 2, e);
            else if (found)
                break;              /* what it covers of a row is in one piece */
            found = covers;
            for (int i = 0; i < 3; i++)
                e[i] += s.right[i];
        }
        for (int i = 0; i < 3; i++)
            s.e[i] += s.down[i];
    }
}

/* Puts a triangle that has a path in space into the wanted blocks whose middle it covers in the middle of the exposure, and adds
 * what it does there to their tiles. */
static SMEAR_NOINLINE void add_in_space(const struct smear_row_moving *r, const struct smear_bins *g, uint32_t triangle,
                                        const struct smear_window *window, int32_t top, struct range wanted)
{
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    const int32_t *const record[3] = { bins_vertex(g, s, t->vertex[0]), bins_vertex(g, s, t->vertex[1]), bins_vertex(g, s, t->vertex[2]) };
    const int32_t left = max_i32(b->x0 >> BLOCK_SHIFT, wanted.low), right = min_i32((b->x1 - 1) >> BLOCK_SHIFT, wanted.high - 1);
    const int32_t upper = max_i32((b->y0 - top) >> BLOCK_SHIFT, 0),
                  lower = min_i32((b->y1 - 1 - top) >> BLOCK_SHIFT, (window->tile >> BLOCK_SHIFT) - 1);
    struct smear_space space;
    struct smear_plane_motion row;
    smear_space_make(&space, g, s, window->width, window->height);
    if (left > right || upper > lower
        || !smear_plane_motion_make(&row, &space, record, (left << BLOCK_SHIFT) + BLOCK_PX / 2,
                                    top + (upper << BLOCK_SHIFT) + BLOCK_PX / 2, BLOCK_PX))
        return;
    for (int32_t y = upper; y <= lower; y++, smear_plane_motion_go(&row, true)) {
        struct smear_plane_motion here = row;
        for (int32_t x = left; x <= right; x++, smear_plane_motion_go(&here, false)) {
            struct smear_block *const block = block_at(&r->blocks, x, y);
            struct smear_place_motion d;
            if (!smear_plane_motion_at(&d, &here, (x << BLOCK_SHIFT) + BLOCK_PX / 2, top + (y << BLOCK_SHIFT) + BLOCK_PX / 2))
                continue;
            if (d.bend != PLACE_UNKNOWN)
                add_displacement(&r->travel[x >> (window->tile_shift - BLOCK_SHIFT)], d.x, d.x, d.y, d.y, 4 * d.bend);
            if (d.depth > block->depth)
                put_block(block, d.x, d.y, 4 * d.bend, d.depth);
        }
    }
}

/* ------------------------------------------------------------------ lists */

void smear_list_begin(struct smear_row_moving *r, const struct smear_window *w)
{
    for (int32_t i = 0; i < w->columns; i++)
        r->travel[i] = (struct smear_tile_travel){
            .x0 = INT16_MAX, .x1 = INT16_MIN, .y0 = INT16_MAX, .y1 = INT16_MIN
        };
    if (r->blocks.columns != 0)
        __builtin_memset(r->blocks.block, 0,
                         (size_t)(r->blocks.columns * (w->tile >> BLOCK_SHIFT)) * sizeof *r->blocks.block);
}

void smear_list_columns(struct smear_row_moving *r, const struct smear_bins *g, const struct smear_window *w,
                        uint32_t head, int32_t top, int32_t first, int32_t end)
{
    enum { BESIDE = BLOCK_PX };     /* a block may lie so far beside the pixels whose centres are covered */
    const int shift = w->tile_shift;
    const struct range columns = { first, end },
                       blocks = { first << shift >> BLOCK_SHIFT, min_i32(end << shift >> BLOCK_SHIFT, r->blocks.columns) };
    const int32_t left = (first << shift) - BESIDE, right = (end << shift) + BESIDE;
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_path_bounds *b = bins_bounds(g, i);
        if (b->x1 <= left || b->x0 >= right)
            continue;
        struct corners c;
        struct displacements d;
        if (!r->measures || b->space != 0) {
            add_to_tiles(w, r, b->x0, b->x1, b, NULL, 0, top, columns);
            if (r->blocks.columns != 0)
                add_in_space(r, g, i, w, top, blocks);
            continue;
        }
        corners_of(&c, g, i);
        displacements_of(&d, g, i, &c);
        add_to_tiles(w, r, b->x0, b->x1, b, &d, 0, top, columns);
        if (r->blocks.columns != 0)
            add_to_blocks(r, &c, &d, w, top, blocks);
    }
}

void smear_list_moving(struct smear_row_moving *r, const struct smear_bins *g, const struct smear_window *w, uint32_t head)
{
    const int shift = w->tile_shift;
    r->count = 0;
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_path_bounds *b = bins_bounds(g, i);
        r->moving[r->count++] = (struct smear_moving_triangle){ i, (uint8_t)(b->x0 >> shift),
                                                                (uint8_t)((b->x1 - 1) >> shift), b->nearest };
    }
}

/* ------------------------------------------------------------------ order */

enum { STEEP = 1 << 24 };
/* Returns 256 |a| / |c|, cut; STEEP for all that is steeper. */
static int64_t slope_of(int64_t a, int64_t c)
{
    const int64_t part = a < 0 ? -a : a;
    int64_t whole = c < 0 ? -c : c;
    int up = 0;
    for (; part >= whole && up < 16; up++)
        whole <<= 1;
    return part >= whole ? STEEP : (int64_t)ratio_q30(part, whole) << up >> 22;
}

/* Narrows the range of a triangle's depths in the middle of the exposure to where its plane meets a box of places, q8 px. */
static void narrow_range(struct front_range *r, const int32_t *const v[3], const int32_t box[4])
{
    const int32_t a[3] = { v[1][VERTEX_X] - v[0][VERTEX_X], v[1][VERTEX_Y] - v[0][VERTEX_Y], v[1][VERTEX_DEPTH] - v[0][VERTEX_DEPTH] },
                  b[3] = { v[2][VERTEX_X] - v[0][VERTEX_X], v[2][VERTEX_Y] - v[0][VERTEX_Y], v[2][VERTEX_DEPTH] - v[0][VERTEX_DEPTH] };
    const int64_t area = cross_wide(a[VERTEX_X], a[VERTEX_Y], b[VERTEX_X], b[VERTEX_Y]);
    int64_t middle = (int64_t)v[0][VERTEX_DEPTH] << 9, off = 4 * SMEAR_GUARD_PX << 9;       /* slopes are cut, to a unit per pixel */
    for (int i = 0; i < 2; i++) {
        const int32_t low = max_i32(min_i32(min_i32(a[i], b[i]), 0), box[i] - v[0][i]),
                      high = min_i32(max_i32(max_i32(a[i], b[i]), 0), box[2 + i] - v[0][i]);
        const int64_t rise = cross_wide(a[VERTEX_DEPTH], a[1 - i], b[VERTEX_DEPTH], b[1 - i]), steep = slope_of(rise, area);
        if (low > high || steep >= STEEP)
            return;
        middle += ((rise < 0) != (area < 0)) == (i == 0) ? -steep * (low + high) : steep * (low + high);
        off += steep * (high - low);
    }
    const int64_t farthest = (middle - off) >> 9, nearest = (middle + off) >> 9;
    if (farthest > r->farthest && farthest < r->nearest)
        r->farthest = (int32_t)farthest;
    if (nearest < r->nearest && nearest > r->farthest)
        r->nearest = (int32_t)nearest;
}

/* Finds the columns of a moving triangle, and its depths in a tile row at any time: no place of it goes farther from where it is in the
 * middle of the exposure than its vertices do, nor nearer or farther away. */
static void moving_range(struct front_range *r, const struct smear_bins *g, uint32_t triangle, const struct smear_window *w, int32_t top)
{
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    *r = (struct front_range){ b->x0 << 8, b->x1 << 8, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX };
    if (b->space != 0)
        return;
    const int32_t *const v[3] = { bins_vertex(g, s, t->vertex[0]), bins_vertex(g, s, t->vertex[1]), bins_vertex(g, s, t->vertex[2]) };
    struct front_range in = { 0, 0, SMEAR_DEPTH_MAX, SMEAR_DEPTH_MIN };
    int32_t off = 0;
    for (int i = 0; i < 3; i++) {
        const int32_t depth = v[i][VERTEX_DEPTH], *const open = v[i] + s->motion, *const close = open + PATH_POSE_WORDS;
        off = max_i32(off, 64 + max_i32(abs_i32(open[PATH_DEPTH] - depth), abs_i32(close[PATH_DEPTH] - depth)));    /* paths are rounded */
        in.farthest = min_i32(in.farthest, depth);
        in.nearest = max_i32(in.nearest, depth);
    }
    const int32_t reach = ((b->travel + b->curvature) << 3) + ((bins_margin(g) + 1) << 8);
    const int32_t box[4] = { -reach, (top << 8) - reach, (w->width << 8) + reach, ((top + w->tile) << 8) + reach };
    if (in.nearest - in.farthest > in.nearest >> 3 && max_i32(b->travel, b->curvature) < (int32_t)UINT16_MAX)
        narrow_range(&in, v, box);
    r->farthest = max_i32(in.farthest - off, SMEAR_DEPTH_MIN);
    r->nearest = off < SMEAR_DEPTH_MAX - in.nearest ? in.nearest + off : SMEAR_DEPTH_MAX;
}

void smear_list_order(struct smear_row_moving *r, const struct smear_bins *g, const struct smear_window *w, int32_t top)
{
    enum { LARGE = 256 };       /* pixels of the box around a path, in the mean, of which three must lie over each other */
    const uint32_t count = r->count, enough = max_u32(3u * (uint32_t)(w->tile * w->width), LARGE * count);
    struct smear_moving_triangle *const listed = r->moving + count;
    uint8_t *const level = (uint8_t *)(listed + count);
    uint16_t place[FRONT_LEVELS] = { 0 };
    struct front_taken taken;
    uint32_t pixels = 0;
    for (uint32_t i = 0; i < count && pixels < enough; i++) {
        const struct smear_path_bounds *b = bins_bounds(g, r->moving[i].triangle);
        pixels += (uint32_t)((b->x1 - b->x0) * max_i32(min_i32(b->y1, top + w->tile) - max_i32(b->y0, top), 0));
    }
    if (pixels < enough || count > min_u32(r->room / 3, UINT16_MAX))
        return;
    __builtin_memset(&taken, UINT8_MAX, sizeof taken);
    for (uint32_t i = 0; i < count; i++) {
        struct front_range range;
        moving_range(&range, g, r->moving[i].triangle, w, top);
        level[i] = (uint8_t)smear_front_level(&taken, &range, 0, w->width);
        place[level[i]]++;
    }
    front_places(place);
    __builtin_memcpy(listed, r->moving, count * sizeof *listed);
    for (uint32_t i = 0; i < count; i++)
        r->moving[place[level[i]]++] = listed[i];
}

/* ------------------------------------------------------------------ areas */

/* Returns the pixels of a moving triangle in the middle of the exposure: at least 1 and no more than the box of its path
 * has; where it has a path in space, as many as that. */
static uint32_t moving_area(const struct smear_bins *g, uint32_t triangle)
{
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    const int32_t *v0 = bins_vertex(g, s, t->vertex[0]), *v1 = bins_vertex(g, s, t->vertex[1]),
                  *v2 = bins_vertex(g, s, t->vertex[2]);
    /* q4, of edges within the guard band */
    const int32_t x1 = (v1[VERTEX_X] - v0[VERTEX_X]) >> 4, y1 = (v1[VERTEX_Y] - v0[VERTEX_Y]) >> 4,
                  x2 = (v2[VERTEX_X] - v0[VERTEX_X]) >> 4, y2 = (v2[VERTEX_Y] - v0[VERTEX_Y]) >> 4;
    const int64_t twice = cross_wide(x1, y1, x2, y2);
    const uint64_t area = (uint64_t)(twice < 0 ? -twice : twice) >> 9;
    const uint32_t box = (uint32_t)((b->x1 - b->x0) * (b->y1 - b->y0));
    if (b->space != 0)
        return box;
    return area < box ? (uint32_t)area + 1 : box;
}

void smear_add_areas(struct smear_travel_areas *areas, const struct smear_bins *g, uint32_t head, uint32_t last)
{
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_path_bounds *b = bins_bounds(g, i);
        const int32_t length = min_i32((b->travel + b->curvature) >> TRAVEL_CLASS_SHIFT, TRAVEL_CLASSES - 1);
        uint32_t *sum = &areas->area[length], area = moving_area(g, i);
        *sum = min_u32(*sum, UINT32_MAX - area) + area;
        if (i == last)
            return;
    }
}
