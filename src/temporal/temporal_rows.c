/* SPDX-License-Identifier: MIT */
/* temporal_rows.c - tile rows by methods that look at several instants.
 *
 *     list        moving triangles of the row, and what they mean for its tiles
 *     for each run of tiles that must be drawn (one, unless the display keeps some):
 *         still       triangles that do not move, into the row's pixels
 *         finish      tiles by their method (tile_method.h): a copy, subframes of tiles beside each other, or a
 *                     time mask; then flush
 */
#include "temporal/temporal_rows.h"

#include "base/fixmath.h"
#include "base/pixel.h"
#include "kernels/fill.h"
#include "display/damage.h"

/* ------------------------------------------------------------------ lists */

struct range {
    int32_t low, high;              /* [low, high) */
};

/* How a moving triangle goes from open to close, 1/16 px: least and most of its vertices. Of a large one
 * whose vertices go unlike ways also what tells the way from place to place: weights in the
 * middle of the exposure give weights at its ends. */
struct way {
    int32_t x0, x1, y0, y1, curvature;
    bool large;
    int32_t x[3], y[3];             /* vertices in the middle of the exposure, px */
    struct {
        int32_t x[3], y[3];         /* at open and close, 1/8 px */
        int32_t weight[3];          /* how much farther away than in the middle, q8 */
    } pose[2];
};

enum {
    WAY_PX = 24,                    /* smaller triangles lie in few tiles */
    WAY_ALIKE = 8 * 16,             /* ways that need not be told apart */
    WAY_BITS = 14,                  /* of weights */
    MEAN_MAX = 512 * 16             /* longer ways count as this one in a mean */
};

/* Of two depths, q8, within 1/16 .. 16. */
static int32_t depth_ratio(int32_t a, int32_t b)
{
    const uint32_t depth = (uint32_t)b | 1u;
    const int zeros = count_leading_zeros(depth);
    const uint32_t ratio = mulh_u32((uint32_t)a, recip_norm(depth << zeros));      /* 2^(29 - zeros) a / b */
    return clamp_i32((int32_t)(zeros <= 21 ? min_u32(ratio >> (21 - zeros), 4096)
                                           : min_u32(ratio, 4096u) << (zeros - 21)),
                     16, 4096);
}

static struct way way_of(const struct smear_bins *g, uint32_t triangle)
{
    const struct smear_triangle *t = bins_triangle(g, triangle);
    const struct smear_segment *s = &g->segment[t->segment];
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    struct way w = { .x0 = INT32_MAX, .x1 = INT32_MIN, .y0 = INT32_MAX, .y1 = INT32_MIN, .curvature = b->curvature };
    const int32_t *v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = bins_vertex(g, s, t->vertex[i]);
        const int32_t *open = v[i] + s->motion, *close = open + PATH_POSE_WORDS;
        int32_t x = (close[PATH_X] - open[PATH_X]) >> 4, y = (close[PATH_Y] - open[PATH_Y]) >> 4;
        w.x0 = min_i32(w.x0, x);
        w.x1 = max_i32(w.x1, x);
        w.y0 = min_i32(w.y0, y);
        w.y1 = max_i32(w.y1, y);
    }
    w.large = (b->x1 - b->x0 > WAY_PX || b->y1 - b->y0 > WAY_PX)
           && (w.x1 - w.x0 > WAY_ALIKE || w.y1 - w.y0 > WAY_ALIKE);
    for (int i = 0; w.large && i < 3; i++) {
        w.x[i] = v[i][VERTEX_X] >> 8;
        w.y[i] = v[i][VERTEX_Y] >> 8;
        for (int k = 0; k < 2; k++) {
            const int32_t *pose = v[i] + s->motion + k * PATH_POSE_WORDS;
            w.pose[k].x[i] = pose[PATH_X] >> 5;
            w.pose[k].y[i] = pose[PATH_Y] >> 5;
            w.pose[k].weight[i] = depth_ratio(v[i][VERTEX_DEPTH], pose[PATH_DEPTH]);
        }
    }
    return w;
}

static int shift_to(int32_t largest)
{
    return max_i32(32 - count_leading_zeros((uint32_t)largest | 1u) - WAY_BITS, 0);
}

/* Weights of the vertices at a pixel; of one beside the triangle, at the nearest place of the
 * side it is beyond of most, which is then `at`. */
static void weigh(int32_t e[3], const struct way *w, int32_t at[2])
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

/* Where a way leads, and how far its middle lies off the chord, 1/16 px: eight times, as places beside the
 * one looked at curvature more, but no more than a vertex. */
struct local_way {
    int32_t x, y, curvature;
};

/* At a pixel of the triangle, or near one. Beyond those of the vertices, too: where a camera turns, what is
 * straight ahead goes less far than what is aside. */
static struct local_way way_at(const struct way *w, int32_t x, int32_t y)
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
    return (struct local_way){ 2 * (at[1][0] - at[0][0]), 2 * (at[1][1] - at[0][1]), min_i32(8 * curvature, w->curvature) };
}

static void load_way(struct smear_tile_load *load, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                     int32_t curvature)
{
    const int32_t x = clamp_i32((x0 + x1) >> 1, -MEAN_MAX, MEAN_MAX), y = clamp_i32((y0 + y1) >> 1, -MEAN_MAX, MEAN_MAX);
    const int32_t weight = (max_i32(abs_i32(x), abs_i32(y)) >> 4) + 1, sum = load->weight + weight;
    const int32_t part = (weight << 15) / sum;
    load->x = (int16_t)(load->x + (((x - load->x) * part + (1 << 14)) >> 15));
    load->y = (int16_t)(load->y + (((y - load->y) * part + (1 << 14)) >> 15));
    load->weight = (uint16_t)min_i32(sum, UINT16_MAX);
    load->curvature = (uint16_t)max_i32(load->curvature, curvature);
    load->x0 = (int16_t)clamp_i32(x0, INT16_MIN, load->x0);
    load->x1 = (int16_t)clamp_i32(x1, load->x1, INT16_MAX);
    load->y0 = (int16_t)clamp_i32(y0, INT16_MIN, load->y0);
    load->y1 = (int16_t)clamp_i32(y1, load->y1, INT16_MAX);
}

/* Ways at the left side of a column of tiles: x and y where the
 * row begins, where it ends, the larger curvature. */
enum { SIDE_VALUES = 5 };

static void way_at_side(int32_t out[SIDE_VALUES], const struct way *w, int32_t column, int32_t top, int shift)
{
    const struct local_way upper = way_at(w, column << shift, top),
                           lower = way_at(w, column << shift, top + (1 << shift));
    out[0] = upper.x;
    out[1] = lower.x;
    out[2] = upper.y;
    out[3] = lower.y;
    out[4] = max_i32(upper.curvature, lower.curvature);
}

/* Ways of a large triangle in columns of tiles: found at some of their sides, in a line between. */
static void load_ways(struct smear_row_moving *r, int32_t first, int32_t last, const struct way *way,
                      int32_t top, int shift)
{
    enum { APART_PX = 64 };
    const int32_t apart = max_i32(APART_PX >> shift, 2);
    int32_t left[SIDE_VALUES], right[SIDE_VALUES];
    way_at_side(left, way, first, top, shift);
    for (int32_t column = first; column <= last;) {
        const int32_t n = min_i32(last + 1 - column, apart), part = 256 / n;
        int32_t from[SIDE_VALUES], to[SIDE_VALUES], step[SIDE_VALUES];
        way_at_side(right, way, column + n, top, shift);
        for (int i = 0; i < SIDE_VALUES; i++) {
            from[i] = left[i];
            step[i] = (right[i] - left[i]) * part;
        }
        for (int32_t k = 1; k <= n; k++) {
            for (int i = 0; i < SIDE_VALUES; i++)
                to[i] = left[i] + (step[i] * k >> 8);
            load_way(&r->load[column + k - 1], min_i32(min_i32(from[0], from[1]), min_i32(to[0], to[1])),
                     max_i32(max_i32(from[0], from[1]), max_i32(to[0], to[1])),
                     min_i32(min_i32(from[2], from[3]), min_i32(to[2], to[3])),
                     max_i32(max_i32(from[2], from[3]), max_i32(to[2], to[3])), max_i32(from[4], to[4]));
            for (int i = 0; i < SIDE_VALUES; i++)
                from[i] = to[i];
        }
        for (int i = 0; i < SIDE_VALUES; i++)
            left[i] = right[i];
        column += n;
    }
}

/* Columns of pixels in which a large triangle may be seen in the row at some time,
 * about: those of its sides between rows that lie as much farther up and down as it
 * goes. Ways beyond them would be those of other rows. */
static struct range columns_of(const struct way *w, const struct smear_path_bounds *b, int32_t top,
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

/* What columns [x0, x1) of pixels hold; with bounds and a way, of one moving triangle. */
static void load_tiles(const struct smear_context *c, struct smear_row_moving *r, int32_t x0, int32_t x1,
                       const struct smear_path_bounds *b, const struct way *way, uint16_t flags, int32_t top)
{
    const struct smear_window *w = &c->window;
    int32_t first = max_i32(x0, 0) >> w->tile_shift, last = (min_i32(x1, w->width) - 1) >> w->tile_shift;
    for (int32_t column = first; column <= last; column++) {
        struct smear_tile_load *load = &r->load[column];
        load->flags |= flags;
        if (b == NULL)
            continue;
        load->flags |= (uint16_t)(b->flags | TILE_MOVES);
        if (b->interval != 0)
            continue;
        if (!way->large)
            load_way(load, way->x0, way->x1, way->y0, way->y1, way->curvature);
    }
    if (b == NULL || b->interval != 0 || !way->large)
        return;
    const struct range seen = columns_of(way, b, top, w->tile);
    if (seen.low < seen.high)
        load_ways(r, seen.low >> w->tile_shift, (seen.high - 1) >> w->tile_shift, way, top, w->tile_shift);
}

/* Columns of pixels that a still triangle may cover. */
static void still_columns(const struct smear_bins *g, const struct smear_triangle *t, int32_t *x0,
                          int32_t *x1)
{
    *x0 = INT32_MAX;
    *x1 = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        int32_t x = bins_vertex(g, &g->segment[t->segment], t->vertex[i])[VERTEX_X];
        *x0 = min_i32(*x0, x >> 8);
        *x1 = max_i32(*x1, (x >> 8) + 1);
    }
}

/* Marks the tiles of blended draws. */
static void load_list(const struct smear_context *c, struct smear_row_moving *r, uint32_t head, int32_t top)
{
    const struct smear_bins *g = &c->bins;
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_triangle *t = bins_triangle(g, i);
        int32_t x0, x1;
        if (g->segment[t->segment].path) {
            const struct smear_path_bounds *b = bins_bounds(g, i);
            const struct way way = way_of(g, i);
            load_tiles(c, r, b->x0, b->x1, b, &way, TILE_BLENDED, top);
        } else {
            still_columns(g, t, &x0, &x1);
            load_tiles(c, r, x0, x1, NULL, NULL, TILE_BLENDED, top);
        }
    }
}

static void list_moving(struct smear_context *c, int row)
{
    const struct smear_bins *g = &c->bins;
    struct smear_row_moving *r = &c->row_moving;
    int shift = c->window.tile_shift;
    for (int32_t i = 0; i < c->window.columns; i++)
        r->load[i] = (struct smear_tile_load){ .x0 = INT16_MAX, .x1 = INT16_MIN, .y0 = INT16_MAX,
                                               .y1 = INT16_MIN };
    r->count = 0;
    c->moving = smear_bins_advance(g, g->moving_last, c->moving, row);
    for (uint32_t i = c->moving; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_path_bounds *b = bins_bounds(g, i);
        r->moving[r->count++] = (struct smear_moving_triangle){ i, (uint8_t)(b->x0 >> shift),
                                                     (uint8_t)((b->x1 - 1) >> shift), b->nearest };
        const struct way way = way_of(g, i);
        load_tiles(c, r, b->x0, b->x1, b, &way, 0, row_top(c, row));
    }
}

/* Blended draws of the row that is finished. */
static void list_blended(struct smear_context *c, int row)
{
    if (!c->blends)
        return;
    c->blend = smear_bins_advance(&c->bins, c->bins.blend_last, c->blend, row);
    load_list(c, &c->row_moving, c->blend, row_top(c, row));
}

/* ------------------------------------------------------------------ drawing */

static void clear(const struct smear_raster_target *t, uint32_t color)
{
    int32_t n = t->x1 - t->x0;
    for (int32_t y = t->y0; y < t->y1; y++) {
        int32_t slot = t->window_rows.slot0 + (y - t->y0);
        if (slot >= t->window_rows.ring)
            slot -= t->window_rows.ring;
        pixels_fill(t->color + slot * t->window_rows.stride + t->x0, color, n);
        __builtin_memset(t->depth + slot * t->window_rows.stride + t->x0, 0, (size_t)n * 2);
    }
}

static void still_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(r->c, r->row, &t);
    smear_job_columns(r->c, job, &t.x0, &t.x1);
    t.x0 = max_i32(t.x0, job_left(r));
    t.x1 = min_i32(t.x1, job_right(r));
    if (t.x0 >= t.x1)
        return;
    clear(&t, r->c->frame.clear & 0xffffffu);
    t.cache = smear_raster_cache_of(&r->c->cache, job);
    smear_raster_list(&r->c->raster, &t, r->c->opaque);
}

/* ------------------------------------------------------------------ tiles */

/* A row to be finished. */
struct finish {
    struct row_job row;
    struct smear_raster_target still;
};

static bool is_still(const struct smear_tile_load *load)
{
    return (load->flags & (TILE_MOVES | PATH_WITHOUT_MASK)) == 0;
}

/* Blended draws over a tile without moving triangles. */
static void blend_still(const struct smear_moving_tile *t, const struct smear_context *c)
{
    const struct smear_raster_target *s = &t->still;
    for (int32_t y = s->y0; y < s->y1; y++) {
        const uint32_t *in = s->color + target_row(&s->color_rows, s, y) + s->x0;
        for (int32_t i = 0; i < s->x1 - s->x0; i++)
            t->out[(y - s->y0) * t->pitch + i] = in[i];
    }
    struct smear_raster_target over = *s;
    over.color = t->out;
    over.color_rows = (struct smear_plane_rows){ t->pitch, 0, s->y1 - s->y0, s->x0 };
    smear_raster_list(&c->raster, &over, t->blend);
}

/* Tiles [first, end) of the row, for a method. */
static struct smear_moving_tile tiles_of(const struct finish *f, int first, int end, int worker)
{
    struct smear_context *c = f->row.c;
    const struct smear_window *w = &c->window;
    const struct smear_row_moving *m = &c->row_moving;
    const int32_t pitch = strip_columns(c);
    struct smear_moving_tile t = {
        .frame = &c->raster, .shutter = &c->shutter, .still = f->still,
        .moving = m->moving, .moving_count = m->count,
        .column = first, .last_column = end - 1, .blend = c->blend,
        .out = c->scratch + worker * pitch * w->tile, .pitch = pitch, .tile = w->tile,
        .work = c->work + (uint32_t)worker * c->work_bytes, .work_bytes = c->work_bytes
    };
    t.x0 = t.still.x0 = tile_left(c, first);
    t.x1 = t.still.x1 = tile_right(c, end - 1);
    return t;
}

static void hand_on(const struct finish *f, const struct smear_moving_tile *t)
{
    struct smear_raster_target out = t->still;
    out.color = t->out;
    out.color_rows = (struct smear_plane_rows){ t->pitch, 0, out.y1 - out.y0, out.x0 };
    smear_band_convert_rows(&f->row, &out, t->x0, t->x1);
}

static int finish_still(const struct finish *f, int first, int end)
{
    struct smear_context *c = f->row.c;
    int next = first;
    while (next < end && is_still(&c->row_moving.load[next]))
        next++;
    smear_band_convert_rows(&f->row, &f->still, tile_left(c, first), tile_right(c, next - 1));
    return next;
}

/* Columns beyond a strip's border in which its moving triangles are drawn, too, so that gaps of its last tile, which
 * moving triangles go on from by `step`, close with what is there. `neighbour`: the tile beyond, or null. */
static int32_t margin_of(const struct smear_context *c, const struct smear_step *step,
                         const struct smear_tile_load *neighbour)
{
    enum { GAP_SEEN = 2 * 16 };
    const int32_t most = (strip_columns(c) - c->strip) / 2;
    const int32_t gap = abs_i32(step->x);       /* 1/16 px */
    return neighbour == NULL || neighbour->weight == 0 || gap <= GAP_SEEN ? 0 : min_i32((gap + 31) >> 5, most);
}

static void widen(struct smear_moving_tile *t, const struct smear_context *c, const struct smear_step *step)
{
    const struct smear_tile_load *load = c->row_moving.load;
    const int first = t->column, last = t->last_column;
    t->still.x0 -= margin_of(c, &step[0], first > 0 ? &load[first - 1] : NULL);
    t->still.x1 += margin_of(c, &step[last - first], last + 1 < c->window.columns ? &load[last + 1] : NULL);
    t->still.x1 = min_i32(t->still.x1, c->window.width);
    t->column -= t->still.x0 < t->x0;
    t->last_column += t->still.x1 > t->x1;
}

/* Tiles beside each other share instants: as many as the one that needs most. */
static int finish_subframes(const struct finish *f, int first, int end, int32_t instants, int worker)
{
    struct smear_context *c = f->row.c;
    struct smear_tile_load *load = c->row_moving.load;
    struct smear_step step[STRIP_TILES_MAX];
    struct smear_tile_choice choice;
    int next = first + 1;
    load_set_method(&load[first], TILE_SUBFRAMES);
    for (; next < end && !is_still(&load[next]); next++) {
        smear_tile_method_choose(&choice, &c->chooser, &load[next]);
        if (choice.method != TILE_SUBFRAMES)
            break;
        load_set_method(&load[next], TILE_SUBFRAMES);
        instants = max_i32(instants, choice.instants);
    }
    for (int i = first; i < next; i++)
        smear_tile_method_step(&step[i - first], &c->chooser, &load[i], instants);
    struct smear_moving_tile t = tiles_of(f, first, next, worker);
    const bool fills = smear_shutter_is_box(&c->shutter);
    if (fills)
        widen(&t, c, step);
    c->worker_samples[worker] += smear_subframes_tiles(&t, instants, fills ? step : NULL);
    hand_on(f, &t);
    return next;
}

static void finish_tile(const struct finish *f, int column, const struct smear_tile_choice *choice,
                        int worker)
{
    struct smear_context *c = f->row.c;
    struct smear_tile_load *load = &c->row_moving.load[column];
    struct smear_moving_tile t = tiles_of(f, column, column + 1, worker);
    if (SMEAR_WITH_TIMEMASK && choice->method == TILE_TIMEMASK) {
        bool is_smooth;
        c->worker_samples[worker] += smear_timemask_tile(&t, &choice->timemask, &is_smooth);
        load_set_method(load, is_smooth ? TILE_SMOOTH : TILE_TIMEMASK);
    } else {
        blend_still(&t, c);
    }
    hand_on(f, &t);
}

/* Tiles of the run in as many strips as the frame has. */
static void finish_job(void *argument, int strip, int worker)
{
    const struct finish *f = (const struct finish *)argument;
    struct smear_context *c = f->row.c;
    const int tiles = c->strip >> c->window.tile_shift,
              end = min_i32((strip + 1) * tiles, (job_right(&f->row) + c->window.tile - 1) >> c->window.tile_shift);
    for (int column = max_i32(strip * tiles, job_left(&f->row) >> c->window.tile_shift); column < end;) {
        const struct smear_tile_load *load = &c->row_moving.load[column];
        struct smear_tile_choice choice;
        if (is_still(load)) {
            column = finish_still(f, column, end);
            continue;
        }
        smear_tile_method_choose(&choice, &c->chooser, load);
        if (choice.method == TILE_SUBFRAMES)
            column = finish_subframes(f, column, end, choice.instants, worker);
        else
            finish_tile(f, column++, &choice, worker);
    }
}

/* ------------------------------------------------------------------ rows */

static void count_tiles(struct smear_context *c)
{
    const struct smear_tile_load *load = c->row_moving.load;
    smear_stats *s = &c->stats;
    for (int32_t i = 0; i < c->window.columns; i++) {
        const enum smear_tile_method method = load_method(&load[i]);
        s->tiles_still += method == TILE_COPY;
        s->tiles_none += method == TILE_COPY;
        s->tiles_uniform += method == TILE_SMOOTH;
        s->tiles_smooth += method == TILE_SMOOTH;
        s->tiles_complex += method == TILE_TIMEMASK || method == TILE_SUBFRAMES;
        s->tiles_timemask += method == TILE_TIMEMASK;
        s->tiles_subframes += method == TILE_SUBFRAMES;
    }
}

static bool run_is_still(const struct smear_context *c, const struct smear_damage_run *run)
{
    for (int i = run->first; i < run->end; i++)
        if (!is_still(&c->row_moving.load[i]))
            return false;
    return true;
}

/* The next tiles to be drawn: all, but for those that the display keeps. */
static bool next_run(const struct smear_context *c, int row, struct smear_damage_run *run)
{
    if (SMEAR_WITH_DAMAGE)
        return smear_damage_next_run(c, row, run);
    run->first = run->end;
    run->end = (int)c->window.columns;
    return run->first < run->end;
}

/* Draws, finishes and hands out tiles beside each other. */
static int finish_run(struct smear_context *c, int row, const struct smear_damage_run *run)
{
    uint32_t start = stage_start(c);
    struct finish finish = { .row = { .c = c, .row = row } };
    finish.row.x0 = tile_left(c, run->first);
    finish.row.x1 = tile_right(c, run->end - 1);
    if (!static_is_cached(c))
        smear_jobs_run(&c->jobs, still_job, &finish.row, c->jobs.workers);
    stage_end(c, &c->stats.time_raster, start);

    start = stage_start(c);
    finish.row.band = smear_band_begin(c);
    smear_row_target(c, row, &finish.still);
    if (c->jobs.workers == 1 && run_is_still(c, run))
        finish_still(&finish, run->first, run->end);
    else
        smear_jobs_run(&c->jobs, finish_job, &finish, (c->window.width + c->strip - 1) / c->strip);
    stage_end(c, &c->stats.time_blur, start);
    return smear_band_flush_part(&finish.row);
}

static int draw_row(struct smear_context *c, int row)
{
    uint32_t start = stage_start(c);
    c->opaque = smear_bins_advance(&c->bins, c->bins.opaque_last, c->opaque, row);
    list_moving(c, row);
    list_blended(c, row);
    stage_end(c, &c->stats.time_raster, start);
    struct smear_damage_run run = { 0, 0 };
    while (next_run(c, row, &run)) {
        int result = finish_run(c, row, &run);
        if (result != SMEAR_OK)
            return result;
    }
    count_tiles(c);
    if (SMEAR_WITH_DAMAGE)
        smear_damage_row_sent(c, row);
    return SMEAR_OK;
}

/* Pixels of a moving triangle in the middle of the exposure, at least 1 and no more than the box of its way has. */
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
    const int64_t twice = (int64_t)x1 * y2 - (int64_t)x2 * y1;
    const uint64_t area = (uint64_t)(twice < 0 ? -twice : twice) >> 9;
    const uint32_t box = (uint32_t)((b->x1 - b->x0) * (b->y1 - b->y0));
    return area < box ? (uint32_t)area + 1 : box;
}

/* Adds a ring of moving triangles, before it is opened. */
static void add_areas(struct smear_way_areas *areas, const struct smear_bins *g, uint32_t last)
{
    for (uint32_t i = last; i != SMEAR_NO_TRIANGLE;) {
        i = bins_triangle(g, i)->next;
        const struct smear_path_bounds *b = bins_bounds(g, i);
        const int32_t way = min_i32((b->travel + b->curvature) >> WAY_CLASS_SHIFT, WAY_CLASSES - 1);
        uint32_t *sum = b->interval != 0 ? &areas->interval_area : &areas->area[way], area = moving_area(g, i);
        if (b->interval != 0)      /* which is there for one of so many parts of the exposure */
            area = (area + PATH_INTERVALS - 1) / PATH_INTERVALS;
        *sum = min_u32(*sum, UINT32_MAX - area) + area;
        if (i == last)
            return;
    }
}

/* The error that tile rows [first, end) may have, for their share of the frame's budget. */
static int32_t target_within_budget(struct smear_context *c, int first, int end)
{
    const uint32_t rows = (uint32_t)(end - first), all = (uint32_t)c->window.rows, budget = c->frame.budget;
    struct smear_way_areas areas = { .interval_area = 0 };
    for (int row = first; row < end; row++)
        add_areas(&areas, &c->bins, c->bins.moving_last[row]);
    uint32_t work;
    const int32_t target = smear_tile_method_target(&c->chooser, &areas, budget / all * rows + budget % all * rows / all, &work);
    c->stats.work = min_u32(c->stats.work, UINT32_MAX - work) + work;
    return target;
}

int smear_temporal_rows(struct smear_context *c, int first, int end)
{
    if (c->frame.method == SMEAR_AUTO) {
        c->chooser.target = c->frame.target;        /* the part before may have had another */
        if (c->frame.budget != 0)
            c->chooser.target = target_within_budget(c, first, end);
        c->stats.target = max_u32(c->stats.target, (uint32_t)c->chooser.target);
    }
    for (int row = first; row < end; row++) {
        int result = draw_row(c, row);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}
