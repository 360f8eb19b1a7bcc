/* SPDX-License-Identifier: MIT */
/* front_order.c - see kept.h.
 *
 * Two triangles may change places where no pixel of one has the same depth code as one of the other, or none lies in the same
 * columns: then the nearer one is seen, whichever comes first. Depths are counted in levels, columns in strips. A triangle's
 * place is the level of its farthest vertex; but behind that of each one before it in the list which lies in its strips and
 * reaches its levels, so that those two stay in order. */
#include "raster/kept.h"

#include "base/fixmath.h"
#include "kernels/hidden_box.h"

enum {
    OCTAVE = 4,                     /* levels of depths up to twice as near */
    ORDER_LEAST = 16, ORDER_MOST = 2048,    /* triangles of a list */
    ORDER_PIXELS = 8, BEGUN_PIXELS = 32     /* of the target for each, and for each that begins in it: smaller ones hide little */
};

size_t smear_front_order_bytes(const struct smear_bins *bins)
{
    if (bins_listed(bins) < ORDER_LEAST || bins_end(bins) > UINT16_MAX)
        return 0;
    for (uint32_t i = 0; i < bins->segment_count; i++)      /* between those of several parts some are of none */
        if (bins->segment[i].stride != 0 && (!segment_textured(&bins->segment[i]) || bins->segment[i].path != 0))
            return 0;
    return (min_u32(bins_listed(bins), ORDER_MOST) * 3u + 3u) & ~(size_t)3u;
}

/* What depths of pixels may be beyond those of vertices, and half a step of a code more: planes are rounded, to a unit per
 * pixel or a part of what they change by. */
static inline int32_t depth_margin(int32_t nearest) { return 8192 + (nearest >> 8); }

static inline int32_t level_of(int32_t units)
{
    const uint32_t u = (uint32_t)max_i32(units, 1);
    const int zeros = count_leading_zeros(u);       /* 1 at least */
    return max_i32(((int32_t)FRONT_LEVELS / OCTAVE - zeros) * OCTAVE + (int32_t)(u << zeros >> 29 & 3u), 0);
}

static inline void range_add(struct front_range *r, const int32_t *v)
{
    const int32_t x = v[VERTEX_X], depth = v[VERTEX_DEPTH];
    r->x0 = min_i32(r->x0, x);
    r->x1 = max_i32(r->x1, x);
    r->farthest = min_i32(r->farthest, depth);
    r->nearest = max_i32(r->nearest, depth);
}

static inline struct front_range range_of(const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    struct front_range r = { v0[VERTEX_X], v0[VERTEX_X], v0[VERTEX_DEPTH], v0[VERTEX_DEPTH] };
    range_add(&r, v1);
    range_add(&r, v2);
    return r;
}

uint32_t smear_front_level(struct front_taken *taken, const struct front_range *r, int32_t left, int32_t right)
{
    int shift = 8;
    while ((right - left) << 8 > FRONT_STRIPS << shift)
        shift++;
    const int32_t margin = depth_margin(r->nearest), x = left << 8;
    const int32_t first = max_i32(r->x0 - x, 0) >> shift, last = min_i32(r->x1 - x, ((right - left) << 8) - 1) >> shift;
    const int32_t far = level_of(r->farthest - margin), near = level_of(r->nearest + margin);
    uint32_t level = (uint32_t)far;
    for (int32_t strip = first; strip <= last; strip++)
        level = min_u32(level, taken->back[strip][far]);
    for (int32_t strip = first; strip <= last; strip++)
        for (int32_t i = near; i >= 0 && taken->back[strip][i] > level; i--)
            taken->back[strip][i] = (uint8_t)level;
    return level;
}

/* Returns twice a triangle's area, in whole pixels. */
static inline uint32_t area_twice(const struct smear_bins *bins, const struct smear_triangle *t)
{
    const struct smear_segment *const segment = &bins->segment[t->segment];
    const int32_t *const v0 = bins_vertex(bins, segment, t->vertex[0]), *const v1 = bins_vertex(bins, segment, t->vertex[1]),
                  *const v2 = bins_vertex(bins, segment, t->vertex[2]);
    const int32_t x = v0[VERTEX_X], y = v0[VERTEX_Y], x1 = (v1[VERTEX_X] - x) >> 8, y1 = (v1[VERTEX_Y] - y) >> 8;
    return magnitude_i32(x1 * ((v2[VERTEX_Y] - y) >> 8) - ((v2[VERTEX_X] - x) >> 8) * y1);
}

/* Whether a list's order is worth finding: where triangles together are twice as large as its rows, and not small. */
static bool is_worth_it(const struct smear_raster_frame *frame, const struct smear_raster_target *target, struct smear_list list)
{
    const struct front_memory *const memory = (const struct front_memory *)target->cache.entry - 1;
    const struct smear_bins *const bins = frame->bins;
    const uint32_t pixels = (uint32_t)((target->x1 - target->x0) * bins->row_px), enough = 4 * pixels;
    const uint32_t most = min_u32(front_order_most(memory), pixels / ORDER_PIXELS);
    uint32_t count = 0, twice = 0;
    if (bins_listed(bins) > pixels / BEGUN_PIXELS * (uint32_t)bins->row_count)
        return false;
    for (uint32_t i; count <= most && (i = list_first(&list)) != SMEAR_NO_TRIANGLE; count++) {
        const struct smear_triangle *const t = bins_triangle(bins, i);
        list_next(&list, t);
        if (t->segment == SMEAR_POINT)
            return false;
        if (twice < enough)
            twice += area_twice(bins, t);
    }
    return count >= ORDER_LEAST && count <= most && twice >= enough;
}

/* Finds levels of a list's triangles, and how many have each. Returns how many there are in all; 0 where they are too many, or one
 * is a point or blended. */
static uint32_t find_levels(uint16_t count[FRONT_LEVELS], uint8_t *level, const struct smear_raster_frame *frame,
                            const struct smear_raster_target *target, struct smear_list list)
{
    const struct smear_bins *const bins = frame->bins;
    struct front_taken taken;
    uint32_t n = 0;
    __builtin_memset(&taken, 255, sizeof taken);
    for (uint32_t i; (i = list_first(&list)) != SMEAR_NO_TRIANGLE;) {
        const struct smear_triangle *t = bins_triangle(bins, i);
        list_next(&list, t);
        if (t->segment == SMEAR_POINT)
            return 0;
        const struct smear_segment *segment = &bins->segment[t->segment];
        if (draw_is_blended(&frame->draw[segment->draw]))
            return 0;
        const int32_t *const v0 = bins_vertex(bins, segment, t->vertex[0]), *const v1 = bins_vertex(bins, segment, t->vertex[1]),
                      *const v2 = bins_vertex(bins, segment, t->vertex[2]);
        const struct front_range r = range_of(v0, v1, v2);
        level[n] = (uint8_t)smear_front_level(&taken, &r, target->x0, target->x1);
        count[level[n++]]++;
    }
    return n;
}

uint32_t smear_front_order(const struct smear_raster_frame *frame, const struct smear_raster_target *target, struct smear_list list)
{
    const struct smear_plane_rows *const rows = &target->window_rows;
    uint16_t *const order = front_order_of(&target->cache), place[FRONT_LEVELS] = { 0 };
    if (order == NULL || target_has_velocity(target) || frame_has_fog(frame)
        || rows->ring_row + (target->y1 - target->y0) > rows->ring || ((uintptr_t)target->depth & 3u) != 0 || (rows->stride & 1) != 0)
        return 0;
    if (!is_worth_it(frame, target, list))
        return 0;
    uint8_t *const level = (uint8_t *)(order + front_order_most((const struct front_memory *)target->cache.entry - 1));
    const uint32_t n = find_levels(place, level, frame, target, list);
    front_places(place);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t number = list_first(&list);
        order[place[level[i]]++] = (uint16_t)number;
        list_next(&list, bins_triangle(frame->bins, number));
    }
    return n;
}

/* Whether depths of columns [left, right) of some rows are 2 half at least. */
static bool hides_columns(const uint16_t *depth, int32_t stride, int32_t left, int32_t right, int32_t rows, uint32_t half)
{
    const uint16_t *const even = (const uint16_t *)((uintptr_t)(depth + left) & ~(uintptr_t)3u);
    return hidden_box((const pixel_word *)(const void *)even, stride >> 1, (int32_t)(depth + right + 1 - even) >> 1, rows, half);
}

/* Whether blocks of columns are hidden in all of the target's rows. Notes how near they are found to be. */
static bool hides_blocks(uint16_t *least, const uint16_t *depth, const struct smear_raster_target *t, int32_t left, int32_t right,
                         bool looks, uint32_t half)
{
    for (int32_t x = t->x0 + ((left - t->x0) & -FRONT_BLOCK); x < right; x += FRONT_BLOCK) {
        uint16_t *const found = least + (x - t->x0) / FRONT_BLOCK;
        if (*found >= half)
            continue;
        if (!looks || !hides_columns(depth, t->window_rows.stride, x, min_i32(x + FRONT_BLOCK, t->x1), t->y1 - t->y0, half))
            return false;
        *found = (uint16_t)half;
    }
    return true;
}

bool smear_front_hides(const struct smear_raster_frame *frame, const struct smear_raster_target *target, const struct smear_triangle *t,
                       uint16_t least[FRONT_BLOCKS])
{
    const struct smear_segment *segment = &frame->bins->segment[t->segment];
    const int32_t *const v0 = bins_vertex(frame->bins, segment, t->vertex[0]), *const v1 = bins_vertex(frame->bins, segment, t->vertex[1]),
                  *const v2 = bins_vertex(frame->bins, segment, t->vertex[2]);
    const struct front_range r = range_of(v0, v1, v2);
    const int32_t y0 = min_i32(v0[VERTEX_Y], min_i32(v1[VERTEX_Y], v2[VERTEX_Y])),
                  y1 = max_i32(v0[VERTEX_Y], max_i32(v1[VERTEX_Y], v2[VERTEX_Y]));
    const int32_t left = max_i32((r.x0 + 127) >> 8, target->x0), right = min_i32((r.x1 + 127) >> 8, target->x1),
                  top = max_i32((y0 + 127) >> 8, target->y0), bottom = min_i32((y1 + 127) >> 8, target->y1);
    if (left >= right || top >= bottom)
        return true;
    const struct smear_plane_rows *const rows = &target->window_rows;
    const uint32_t units = ((uint32_t)(r.nearest + depth_margin(r.nearest)) >> 11) + 1u;
    const uint32_t half = (units < 32768u ? units : min_u32(32768u + ((units - 32768u) >> 4) + 1u, 65534u)) / 2u + 1u;
    const uint16_t *const depth = target->depth + target_row(rows, target, target->y0);
    const uint16_t *const first = depth + (top - target->y0) * rows->stride;
    const bool looks = 2 * (bottom - top) >= target->y1 - target->y0;       /* at what is not known of blocks yet */
    if (half > 0x7fffu || first[((bottom - top) >> 1) * rows->stride + ((left + right) >> 1)] >> 1 < half)     /* as most that are seen */
        return false;
    return hides_blocks(least, depth, target, left, right, looks, half)
        || hides_columns(first, rows->stride, left, right, bottom - top, half);
}
