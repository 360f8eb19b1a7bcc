/* SPDX-License-Identifier: MIT */
/* velocity.c - the screen velocity of a triangle's pixels, from where its vertices were (and will be).
 *
 * Where depths change between the poses a place is a quotient of two planes, taken every 8 pixels; elsewhere
 * displacement itself is a plane. */
#include "raster/cover.h"

#include "filter/filter.h"

/* d / ratio (q20 > 0) in q8, clamped. */
static int32_t over_ratio(int32_t d, int32_t ratio)
{
    int zeros = count_leading_zeros((uint32_t)ratio);
    int32_t r = (int32_t)recip_norm((uint32_t)ratio << zeros);          /* 2^(61 - zeros) / ratio */
    const int32_t far_out = 1 << 22;
    return clamp_i32(scale_sat(mulh_i32(d * 16, r), zeros - 13), -far_out, far_out);     /* |d| < 2^27 */
}

/* r X + displacement x r, in q8 x 2^9; ratio in q(20 - down), at most 2^16. */
static int32_t place_term(int32_t x, int32_t ratio, int32_t displaced, int down)
{
    int64_t n = (mul_wide(x, ratio) >> 7) + ((int64_t)displaced * 8192 >> down);
    const int64_t far_out = 1 << 30;
    return (int32_t)(n > far_out ? far_out : n < -far_out ? -far_out : n);
}

/* How far depths change between the poses: the least and the greatest ratio of them. Returns the triangle's size, q8. */
static uint32_t find_ratios(const struct setup *s, int32_t *low, int32_t *high)
{
    const struct smear_segment *g = s->segment;
    uint32_t size = 0;
    *low = INT32_MAX;
    *high = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        for (int pose = 0; pose < s->poses; pose++) {
            int32_t ratio = s->v[i][g->motion + pose * MOTION_WORDS + MOTION_RATIO];
            *low = min_i32(*low, ratio);
            *high = max_i32(*high, ratio);
        }
        size = max_u32(size, max_u32(magnitude_i32(s->v[i][VERTEX_X] - s->v[0][VERTEX_X]),
                                     magnitude_i32(s->v[i][VERTEX_Y] - s->v[0][VERTEX_Y])));
    }
    return size;
}

/* Finds the displacement close - open (or now - before) of each vertex, q8. Returns the longest, |dx| + |dy|. */
static uint32_t find_displacements(const struct setup *s, int32_t d[2][3])
{
    uint32_t longest = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t length = 0;
        for (int axis = 0; axis < 2; axis++) {
            const int32_t *m = s->v[i] + s->segment->motion;
            d[axis][i] = 0;
            for (int pose = 0; pose < s->poses; pose++, m += MOTION_WORDS) {
                const int32_t part = over_ratio(m[MOTION_DX + axis], m[MOTION_RATIO]);
                d[axis][i] += pose == 0 ? -part : part;
            }
            length += magnitude_i32(d[axis][i]);
        }
        longest = max_u32(longest, length);
    }
    return longest;
}

/* A surface point's place in a pose is sum(b n) / sum(b r): b screen weights, n = r X + displacement x r. Places are
 * counted from v[0]. Ratios, of which `largest` is the largest, are brought to 2^16, so that all values
 * stay in 31 bits. */
static void setup_poses(struct setup *s, uint32_t largest)
{
    int down = 4;
    while (largest >> down > 0xffff)
        down++;
    for (int pose = 0; pose < s->poses; pose++) {
        for (int axis = 0; axis <= 2; axis++) {
            int32_t value[3];
            for (int i = 0; i < 3; i++) {
                const int32_t *m = s->v[i] + s->segment->motion + pose * MOTION_WORDS;
                const int32_t ratio = m[MOTION_RATIO] >> down;
                value[i] = axis == 2 ? ratio * 8192             /* 29 bits */
                                     : place_term(s->v[i][VERTEX_X + axis] - s->v[0][VERTEX_X + axis], ratio, m[MOTION_DX + axis], down);
            }
            smear_plane_make(s, axis == 2 ? &s->ratio[pose] : &s->place[pose][axis], value[0], value[1], value[2]);
        }
    }
}

void smear_setup_velocity(struct setup *s)
{
    int32_t low, high, d[2][3];
    s->poses = s->segment->moves;
    if (s->poses == 0)
        return;
    const uint32_t size = find_ratios(s, &low, &high);
    const bool in_front = low > 1 << 10;
    const uint32_t longest = in_front ? find_displacements(s, d) : 0;
    /* Interpolating displacements on the screen is off by at most (size + displacement) x change / 4. */
    s->velocity_affine = in_front
                      && smear_times_over(size + longest, (uint32_t)(high - low), (uint32_t)low) >> 2 <= 8;   /* 1/32 px */
    if (!s->velocity_affine) {
        setup_poses(s, max_u32(magnitude_i32(low), magnitude_i32(high)));
        return;
    }
    const int32_t limit = (1 << 20) - 1;
    for (int axis = 0; axis < 2; axis++) {
        for (int i = 0; i < 3; i++)
            d[axis][i] = clamp_i32(d[axis][i], -limit, limit) * 1024;
        smear_plane_make(s, &s->displacement[axis], d[axis][0], d[axis][1], d[axis][2]);
    }
}

/* How far a pixel's point is displaced in a pose, q8: its place there less its place here, (n - d X) / d of
 * the planes above. A point that was at or behind the eye has no place; the least denominator sends it far
 * out, in the direction from which it crosses the plane of the eye. */
static void pose_displacement(const struct setup *s, int pose, int32_t x, int32_t y, int32_t out[2])
{
    int32_t ratio = plane_at(&s->ratio[pose], x, y);
    uint32_t d = (uint32_t)max_i32(ratio, 1 << 12);
    int zeros = count_leading_zeros(d);
    int32_t r = (int32_t)recip_norm(d << zeros);
    const int32_t here[2] = { x * 256 + 128 - s->v[0][VERTEX_X], y * 256 + 128 - s->v[0][VERTEX_Y] };
    for (int i = 0; i < 2; i++) {
        int32_t n = plane_at(&s->place[pose][i], x, y);
        n = narrow_sat((int64_t)n - mul_shift(ratio, here[i], 20));      /* 32 and 20 bits */
        /* n r / 2^32 = n / d 2^(29 - zeros), and q8 is 2^20 n / d. */
        out[i] = scale_sat(mulh_i32(n, r), zeros - 9);
    }
}

/* Brings a vector below 2^bits, direction kept. */
static void shorten(int32_t v[2], int bits)
{
    while ((magnitude_i32(v[0]) | magnitude_i32(v[1])) >> bits != 0) {
        v[0] /= 2;
        v[1] /= 2;
    }
}

/* Displacement between the poses at a pixel, q8 px. */
static void displacement_between(const struct setup *s, int32_t x, int32_t y, int32_t out[2])
{
    if (s->velocity_affine) {
        for (int i = 0; i < 2; i++)
            out[i] = (plane_at(&s->displacement[i], x, y) + 512) >> 10;
        return;
    }
    out[0] = out[1] = 0;
    for (int pose = 0; pose < s->poses; pose++) {
        int32_t d[2];
        pose_displacement(s, pose, x, y, d);
        shorten(d, 29);
        for (int i = 0; i < 2; i++)
            out[i] += pose == 0 ? -d[i] : d[i];
    }
    shorten(out, 22);
}

/* A displacement between two poses, q8 px, times `scale` (q16) is half the exposure's, q16 px. It is brought within the
 * reach: the direction is kept. */
static void velocity_make(const int32_t displacement[2], int32_t scale, int32_t reach_q3, int32_t out[2])
{
    for (int i = 0; i < 2; i++)
        out[i] = narrow_sat(mul_wide(displacement[i], scale) >> 8);
    /* 2048 px at most, then lengths in 1/16 px have 15 bits and squares fit. */
    shorten(out, 27);
    int32_t sx = out[0] >> 12, sy = out[1] >> 12;
    uint32_t square = (uint32_t)(sx * sx) + (uint32_t)(sy * sy);
    uint32_t reach = (uint32_t)reach_q3 * 2u;
    if (square > reach * reach) {
        uint32_t length = sqrt_floor_64((uint64_t)square << 8);     /* 1/256 px */
        int zeros = count_leading_zeros(length);
        uint32_t r = recip_norm(length << zeros);
        /* reach 2^16 r / 2^32 = reach / length 2^(45 - zeros), in 1/16 over 1/256 px; q16 is wanted. */
        int32_t factor = (int32_t)(mulh_u32(reach << 16, r) >> (25 - zeros));
        out[0] = mul_shift(out[0], factor, 16);
        out[1] = mul_shift(out[1], factor, 16);
    }
}

static void stored_velocity(const struct setup *s, const int32_t displacement[2], int32_t out[2])
{
    velocity_make(displacement, s->frame->velocity_scale, s->frame->reach_q3, out);
}

void smear_velocity_still(const struct smear_raster_target *t, int32_t at, bool unknown)
{
    int32_t still = !unknown ? 0 : t->velocity8 != NULL ? SMEAR_VELOCITY_UNKNOWN8 : SMEAR_VELOCITY_UNKNOWN16;
    velocity_store(t->velocity8, t->velocity16, at, still, still);
    if (target_is_inspected(t))
        t->inspect[2 * at] = t->inspect[2 * at + 1] = 0;
}

void smear_velocity_tiny(struct tiny_look *l, const struct setup *s, const struct pixel_box *box, const struct tiny_depths *depths)
{
    const struct smear_raster_target *t = s->target;
    const int32_t x0 = max_i32(box->left, t->x0), x1 = min_i32(box->right, t->x1);
    uint16_t before[TINY_PIXELS];
    for (int drawn = 0; drawn < 2; drawn++) {
        uint16_t *depth = before;
        if (drawn == 1)
            smear_tiny_box(l, t, s->v, s->color, box, depths, s);
        for (int32_t y = box->top; y < box->bottom; y++)
            for (int32_t at = target_row(&t->window_rows, t, y) + x0, end = at + x1 - x0; at < end; at++, depth++)
                if (drawn == 0)
                    *depth = t->depth[at];
                else if (*depth != t->depth[at])
                    smear_velocity_still(t, at, s->velocity_unknown);
    }
}

static inline bool is_drawn(const struct span *p, int32_t i, uint32_t z, const uint16_t *depth)
{
    return p->mask != NULL ? p->mask[i >> 5] >> (i & 31) & 1u : z >> 16 > depth[i];
}

void smear_span_velocity(const struct setup *s, const struct span *p)
{
    const struct smear_raster_target *t = s->target;
    const uint16_t *depth = p->depth;
    uint32_t z = p->z;
    if (s->poses == 0) {
        for (int32_t i = 0; i < p->b - p->a; i++, z += (uint32_t)p->dz)
            if (is_drawn(p, i, z, depth))
                smear_velocity_still(t, p->at + i, s->velocity_unknown);
        return;
    }
    span_mark_tiles(t, p);
    /* Exact at multiples of 8 and at the span's ends; linear between. */
    int32_t x = p->a, at = p->at;
    int32_t here[2], next[2], stored[2], stored_next[2];
    displacement_between(s, x, p->y, here);
    stored_velocity(s, here, stored);
    while (x < p->b) {
        int32_t end = min_i32((x & ~7) + 8, p->right - 1), n = end - x, step[2] = { 0, 0 },
                wide[2] = { 0, 0 };
        if (n > 0) {
            displacement_between(s, end, p->y, next);
            stored_velocity(s, next, stored_next);
            const int32_t inverse = n == 8 ? 8192 : 65536 / n;
            for (int i = 0; i < 2; i++) {
                int32_t change = stored_next[i] - stored[i];
                step[i] = n == 8 ? (change + 4) >> 3 : (mul_shift(change, inverse, 15) + 1) >> 1;
                if (target_is_inspected(t))
                    wide[i] = mul_shift(next[i] - here[i], inverse, 10);
            }
        }
        int32_t stop = min_i32(n > 0 ? end : x + 1, p->b);
        /* q16, q14 */
        int32_t vx = stored[0], vy = stored[1], ix = here[0] * 64 + 32, iy = here[1] * 64 + 32;
        for (; x < stop; x++, at++, z += (uint32_t)p->dz) {
            if (is_drawn(p, x - p->a, z, depth)) {
                velocity_store(t->velocity8, t->velocity16, at, (vx + 0x1000) >> 13, (vy + 0x1000) >> 13);
                if (target_is_inspected(t)) {
                    t->inspect[2 * at] = mul_shift(ix, s->frame->inspect_scale, 22);
                    t->inspect[2 * at + 1] = mul_shift(iy, s->frame->inspect_scale, 22);
                }
            }
            vx += step[0];
            vy += step[1];
            ix += wide[0];
            iy += wide[1];
        }
        for (int i = 0; i < 2 && n > 0; i++) {
            here[i] = next[i];
            stored[i] = stored_next[i];
        }
    }
}

/* ------------------------------------------------------------------ velocities of what a row's depth codes tell */

static inline bool is_unknown(const struct smear_window *w, int32_t at)
{
    return w->velocity8 != NULL ? w->velocity8[2 * at] == SMEAR_VELOCITY_UNKNOWN8
                                : w->velocity16[2 * at] == SMEAR_VELOCITY_UNKNOWN16;
}

/* A velocity as it is stored: in 1/8 px, and in 1/256 px per frame for who inspects it. */
struct kept {
    int32_t x, y, wide_x, wide_y;
};

static struct kept velocity_of(const struct smear_reprojection *r, const struct smear_camera_store *store,
                               int32_t x2, int32_t y2, uint32_t code)
{
    int32_t displacement[2], stored[2];
    smear_reproject(r, x2, y2, smear_depth_units((uint16_t)code), displacement);
    velocity_make(displacement, store->velocity_scale, store->reach_q3, stored);
    struct kept k = { (stored[0] + 0x1000) >> 13, (stored[1] + 0x1000) >> 13, 0, 0 };
    if (SMEAR_WITH_DEBUG && store->inspect != NULL) {
        k.wide_x = narrow_sat(mul_wide(displacement[0], store->inspect_scale) >> 16);
        k.wide_y = narrow_sat(mul_wide(displacement[1], store->inspect_scale) >> 16);
    }
    return k;
}

static inline void keep(const struct smear_window *w, const struct smear_camera_store *store, int32_t at,
                        struct kept k)
{
    window_velocity_store(w, at, k.x, k.y);
    if (SMEAR_WITH_DEBUG && store->inspect != NULL) {
        store->inspect[2 * at] = k.wide_x;
        store->inspect[2 * at + 1] = k.wide_y;
    }
}

/* The depth codes of a block's pixels whose velocity is not known, and how many these are. */
struct unknown {
    uint32_t nearest, farthest;
    int32_t count;
};

static struct unknown find_unknown(const struct smear_window *w, const int32_t at[4], int32_t x, int32_t columns, int32_t rows)
{
    const int8_t *const narrow = w->velocity8;
    struct unknown u = { 0, UINT16_MAX, 0 };
    for (int32_t j = 0; j < rows; j++)
        for (int32_t i = at[j] + x, end = i + columns; i < end; i++) {
            if (narrow != NULL ? narrow[2 * i] != SMEAR_VELOCITY_UNKNOWN8 : w->velocity16[2 * i] != SMEAR_VELOCITY_UNKNOWN16)
                continue;
            u.nearest = max_u32(u.nearest, w->depth[i]);
            u.farthest = min_u32(u.farthest, w->depth[i]);
            u.count++;
        }
    return u;
}

/* Stores one velocity in pixels [at, end). */
static void keep_all(const struct smear_window *w, int32_t at, int32_t end, struct kept k)
{
    const int8_t narrow[2] = { (int8_t)k.x, (int8_t)k.y };
    const int16_t wide[2] = { (int16_t)k.x, (int16_t)k.y };
    if (w->velocity8 == NULL)
        for (; at < end; at++)
            __builtin_memcpy(w->velocity16 + 2 * at, wide, sizeof wide);
    for (; at < end; at++)
        __builtin_memcpy(w->velocity8 + 2 * at, narrow, sizeof narrow);
}

/* Fills in the pixels of a block; at[j] is where row j of it begins in the window. Two velocities are enough: that of the nearest depth,
 * and that of the farthest for what is more than 1/16 farther away. */
static void fill_block(const struct smear_window *w, const struct smear_reprojection *r,
                       const struct smear_camera_store *store, const int32_t at[4], int32_t x, int32_t y,
                       int32_t columns, int32_t rows)
{
    const struct unknown u = find_unknown(w, at, x, columns, rows);
    if (u.count == 0)
        return;
    const uint32_t units = smear_depth_units((uint16_t)u.nearest), least = (uint32_t)depth_code_of(units - (units >> 4));
    const bool one = u.farthest >= least;
    const struct kept k = velocity_of(r, store, 2 * x + columns, 2 * y + rows, u.nearest);
    const struct kept far = one ? k : velocity_of(r, store, 2 * x + columns, 2 * y + rows, u.farthest);
    const bool all = one && u.count == columns * rows && store->inspect == NULL;
    for (int32_t j = 0; j < rows; j++) {
        const int32_t end = at[j] + x + columns;
        if (all)
            keep_all(w, end - columns, end, k);
        for (int32_t i = end - columns; !all && i < end; i++)
            if (is_unknown(w, i))
                keep(w, store, i, w->depth[i] < least ? far : k);
    }
    if ((k.x | k.y | far.x | far.y) != 0)
        w->moving[x >> w->tile_shift] = 1;
}

void smear_camera_velocity(const struct smear_window *w, const struct smear_reprojection *r,
                           const struct smear_camera_store *store, int32_t step, int32_t x0, int32_t x1,
                           int32_t y0, int32_t y1)
{
    for (int32_t y = y0; y < y1; y += step) {
        int32_t at[4], rows = min_i32(step, y1 - y);
        for (int32_t j = 0; j < rows; j++)
            at[j] = window_ring_row(w, y + j) * w->width;
        for (int32_t x = x0; x < x1; x += step)
            fill_block(w, r, store, at, x, y, min_i32(step, x1 - x), rows);
    }
}
