/* SPDX-License-Identifier: MIT */
/* few_draw.c - see few_draw.h.
 *
 * A pixel's weights of v[1] and v[2] are planes: their slopes are the edges over the area, of which 15 bits after the point suffice
 * for so few pixels. What changes by d1 and d2 to these vertices has the slopes d1 g1 + d2 g2. All planes count in 32 bits that wrap,
 * from v[0] on: where a triangle is cut makes no difference.
 *
 * Perspective: where 1/w changes by a part c of that at v[0], planes put what lies within n pixels c n / 4 pixels off at most, and t texels
 * c t / 4. Up to 1/16 of either they do; else they are divided by 1/w, which is a plane, too. Light is off by half a code at most, a
 * quarter of its range times c. */
#include "raster/few_draw.h"

#include "geometry/tiny.h"
#include "kernels/few_lanes.h"
#include "raster/fog.h"
#include "raster/span.h"

/* Loops of their own for copied texels: not where size counts. */
enum { FEW_COPIES = !SMEAR_SMALL_FILE };

enum light_kind {
    LIGHT_NONE,
    LIGHT_WHITE,            /* red, green and blue alike */
    LIGHT_COLORED
};

/* The changes from v[0] to v[1] and to v[2]. */
struct beyond {
    int32_t to1, to2;
};

static inline uint64_t few_edges_word(int32_t e0, int32_t e1, int32_t e2)
{
    if (SMEAR_ON_64)
        return (uint64_t)(int64_t)e0 + ((uint64_t)(int64_t)e1 << 21) + ((uint64_t)(int64_t)e2 << 43);
    const uint32_t high = (uint32_t)(e1 >> 11) + ((uint32_t)e2 << 11);
    return (uint64_t)(int64_t)e0 + ((uint64_t)high << 32 | (uint32_t)e1 << 21);
}

/* Where the box lies. */
struct few_place {
    int32_t cx, cy;                 /* from v[0] to the centre of its first pixel, q8 */
    int32_t rows, fits;             /* fits: so many before the ring's first one */
    uint32_t across;                /* columns or rows, the more, before any are cut off */
    bool cut;                       /* columns on the right are off the target */
};

struct few {
    const struct few_look *look;
    const struct smear_raster_target *target;
    const struct setup *setup;      /* or null */
    struct few_box box;
    struct few_place place;
    int32_t u0, v0;                 /* bent: u and v are changes from these, of mesh units q15, over w */
    bool bent;
    enum light_kind light_kind;     /* white: planes of red and green are not set */
};

/* The weights of v[1] and v[2], q15: at the box's first pixel, and their slopes. */
struct few_weights {
    int32_t at1, right1, down1, at2, right2, down2;
};

/* Planes of light from the first one that a triangle has, and before the last. */
SMEAR_INLINE int few_light_first(const struct few *k, enum few_kind kind)
{
    if (kind == FEW_WHITE || kind == FEW_LINEAR)
        return 2;
    return kind != FEW_ANY || k->light_kind == LIGHT_NONE ? 4 : k->light_kind == LIGHT_WHITE ? 2 : 0;
}

SMEAR_INLINE int few_light_end(const struct few *k, enum few_kind kind) { return kind != FEW_ANY || draw_is_opaque(k->look->draw) ? 3 : 4; }

static inline uint32_t beyond_range(struct beyond b)
{
    return (uint32_t)max_i32(max_i32(b.to1, b.to2), 0) - (uint32_t)min_i32(min_i32(b.to1, b.to2), 0);
}

static inline int32_t weigh(struct beyond b, int32_t w1, int32_t w2)
{
    return add_wrap(mul_wrap(b.to1, w1), mul_wrap(b.to2, w2));
}

static inline void few_plane_set(struct few *k, int plane, int32_t at, int32_t right, int32_t down)
{
    k->box.at.plane[plane] = at;
    k->box.right.plane[plane] = right;
    k->box.down.plane[plane] = down;
}

/* `up`: the plane's, of which 15 bits after the point are made. */
static inline void few_plane_make(struct few *k, int plane, const struct few_weights *w, int32_t value, struct beyond b, int up)
{
    few_plane_set(k, plane, shl_wrap(add_wrap(shl_wrap(value, 15), weigh(b, w->at1, w->at2)), up),
                  shl_wrap(weigh(b, w->right1, w->right2), up), shl_wrap(weigh(b, w->down1, w->down2), up));
}

/* The plane of channel r, g, b or a of light. */
static inline int light_plane(int c) { return c < 2 ? FEW_RED + c : FEW_BLUE + (c - 2); }

/* ------------------------------------------------------------------ weights */

/* (cx, cy): from v[0] to the centre of the box's first pixel, q8. False for slivers, whose weights' slopes are steeper than 4 per pixel:
 * products fit 32 bits. */
static inline bool few_weights_make(struct few_weights *w, int32_t x1, int32_t y1, int32_t x2, int32_t y2, int32_t area, int32_t cx,
                                    int32_t cy)
{
    if (area < (FEW_PX + 1) * 256 * 64) {        /* larger ones are no slivers */
        const uint32_t across = max_u32(max_u32(magnitude_i32(x1), magnitude_i32(y1)), max_u32(magnitude_i32(x2), magnitude_i32(y2)));
        if (across * 64 > (uint32_t)area || area < 256)
            return false;
    }
    const int up = count_leading_zeros((uint32_t)area), down = 24 - up;
    const int32_t recip = (int32_t)(recip_norm((uint32_t)area << up) >> 14);
    w->right1 = y2 * recip >> down;
    w->right2 = -y1 * recip >> down;
    w->down1 = -x2 * recip >> down;
    w->down2 = x1 * recip >> down;
    w->at1 = (w->right1 * cx + w->down1 * cy) >> 8;
    w->at2 = (w->right2 * cx + w->down2 * cy) >> 8;
    return true;
}

/* Whether a sliver has no pixel, as most have none. */
static SMEAR_RARE bool few_is_empty(const struct few_box *box, int32_t columns, int32_t rows)
{
    uint64_t first = box->at.edges;
    for (int32_t y = 0; y != rows; y++, first += box->down.edges) {
        uint64_t edges = first;
        for (int32_t x = 0; x != columns; x++, edges += box->right.edges)
            if (!few_outside(edges))
                return false;
    }
    return true;
}

/* ------------------------------------------------------------------ planes */

/* False where codes lie on both sides of their break. */
static inline bool few_depth_make(struct few *k, const struct few_weights *w, int32_t q0, struct beyond q)
{
    const int32_t low = q0 + min_i32(min_i32(q.to1, q.to2), 0), high = q0 + max_i32(max_i32(q.to1, q.to2), 0);
    const bool far = high < SLOPE_BREAK - 65536;        /* slopes are rounded */
    if (!far && low < SLOPE_BREAK + 65536)
        return false;
    const int down = far ? 10 : 14, half = 1 << (down - 1);     /* to codes q1 */
    const struct beyond codes = { (q.to1 + half) >> down, (q.to2 + half) >> down };
    few_plane_set(k, FEW_DEPTH, add_wrap((int32_t)code_from_units(q0, far ? SLOPE_FAR : SLOPE_NEAR), weigh(codes, w->at1, w->at2)),
                  weigh(codes, w->right1, w->right2), weigh(codes, w->down1, w->down2));
    return true;
}

static inline struct beyond few_beyond(int32_t a, int32_t b, int32_t c) { return (struct beyond){ b - a, c - a }; }

/* What perspective makes of coordinates: planes; or, with 1/w = (1 + e) / w0, something over 1 + e that may be multiplied by 1 - e + e^2
 * instead, which is off by c^3 t, 1/16 texel at most; or more. */
enum few_bend { FEW_STRAIGHT, FEW_BENT, FEW_CURLED };

static inline enum few_bend few_bend_of(const struct few_look *l, int32_t q0, struct beyond q, struct beyond u, struct beyond v,
                                        uint32_t across)
{
    const uint32_t change = (beyond_range(q) >> 12) + 1u, whole = (uint32_t)q0 >> 12;       /* c = change / whole */
    if (change * across * 4u <= whole)
        return FEW_STRAIGHT;
    const uint32_t travel = max_u32(beyond_range(u) * l->width, beyond_range(v) * l->height);   /* mesh units */
    const uint32_t texels = min_u32((travel >> l->draw->sampler.uv_shift) + 1u, 1023u);
    if (change * (4u * texels) <= whole)        /* c t / 4 */
        return FEW_STRAIGHT;
    if (change > whole >> 3)
        return FEW_CURLED;
    return (change * texels >> 10) * (change >> 4) <= (whole >> 7) * (whole >> 8) ? FEW_BENT : FEW_CURLED;      /* c^2 t at most 1/2 */
}

static inline enum few_bend few_coordinates_make(struct few *k, const struct few_weights *w, const int32_t *const r[3], struct beyond q,
                                                 uint32_t across)
{
    const struct few_look *const l = k->look;
    const int at = l->segment->uv;
    const int32_t a = r[0][at], b = r[1][at], c = r[2][at], q0 = r[0][VERTEX_DEPTH];
    struct beyond u = few_beyond((int16_t)(a & 0xffff), (int16_t)(b & 0xffff), (int16_t)(c & 0xffff));
    struct beyond v = few_beyond(a >> 16, b >> 16, c >> 16);
    const enum few_bend bend = segment_flat_depth(l->segment) ? FEW_STRAIGHT : few_bend_of(l, q0, q, u, v, across);
    if (bend == FEW_CURLED)
        return FEW_CURLED;
    if (bend == FEW_BENT) {
        const int up = count_leading_zeros((uint32_t)q0) - 1;
        const int32_t recip = (int32_t)recip_norm((uint32_t)q0 << 1 << up);     /* 1/q0 = recip 2^(up - 60) */
        const struct beyond e = { mulh_i32(shl_wrap(q.to1, up), recip) >> 13, mulh_i32(shl_wrap(q.to2, up), recip) >> 13 };
        few_plane_make(k, FEW_BEND, w, 0, e, 0);
        u = (struct beyond){ u.to1 + (u.to1 * e.to1 >> 15), u.to2 + (u.to2 * e.to2 >> 15) };
        v = (struct beyond){ v.to1 + (v.to1 * e.to1 >> 15), v.to2 + (v.to2 * e.to2 >> 15) };
        few_plane_make(k, FEW_U, w, 0, u, 0);
        few_plane_make(k, FEW_V, w, 0, v, 0);
        k->u0 = shl_wrap((int16_t)(a & 0xffff), 15);
        k->v0 = shl_wrap(a >> 16, 15);
        return FEW_BENT;
    }
    few_plane_make(k, FEW_U, w, (int16_t)(a & 0xffff), u, l->up);
    few_plane_make(k, FEW_V, w, a >> 16, v, l->up);
    k->box.at.plane[FEW_U] = add_wrap(k->box.at.plane[FEW_U], FEW_TURN);
    k->box.at.plane[FEW_V] = add_wrap(k->box.at.plane[FEW_V], FEW_TURN);
    return FEW_STRAIGHT;
}

/* ------------------------------------------------------------------ light */

static void few_flat_light(struct few *k, uint32_t color, bool linear)
{
    for (int c = 0; c < 4; c++) {
        const uint32_t code = c < 3 ? color >> (16 - 8 * c) & 255u : pixel_alpha(color);
        few_plane_set(k, light_plane(c), (int32_t)(linear && c < 3 ? smear_srgb_decode[code] : code << 8) * 32768, 0, 0);
    }
    k->light_kind = pixel_red(color) == pixel_green(color) && pixel_red(color) == pixel_blue(color) ? LIGHT_WHITE : LIGHT_COLORED;
}

/* False where light needs perspective. */
static bool few_light_make(struct few *k, const struct few_weights *w, const int32_t *const r[3], struct beyond q)
{
    const struct few_look *const l = k->look;
    const bool linear = frame_is_linear(l->frame);
    const int32_t *const c0 = r[0] + l->segment->color, *const c1 = r[1] + l->segment->color, *const c2 = r[2] + l->segment->color;
    const uint32_t change = beyond_range(q) >> 12;
    k->light_kind = few_is_white(c0) && few_is_white(c1) && few_is_white(c2) ? LIGHT_WHITE : LIGHT_COLORED;
    for (int c = few_light_first(k, FEW_ANY); c < few_light_end(k, FEW_ANY); c++) {
        const int32_t value = few_light_value(c0, c, linear);
        const struct beyond b = few_beyond(value, few_light_value(c1, c, linear), few_light_value(c2, c, linear));
        if (!segment_flat_depth(l->segment) && (beyond_range(b) >> 9) * change > (uint32_t)r[0][VERTEX_DEPTH] >> 12)
            return false;
        few_plane_make(k, light_plane(c), w, value, b, 0);
    }
    return true;
}

/* ------------------------------------------------------------------ pixels */

struct few_pixel {
    uint32_t u, v;
    uint32_t light[4];      /* 16 bits q15 */
};

/* A pixel that is nearer than what was there, in any look. False where it is cut out. */
static SMEAR_NOINLINE bool few_put(const struct few *k, int32_t at, uint32_t index, const struct few_pixel *p)
{
    const struct few_look *const l = k->look;
    const struct smear_sampler *const m = &l->draw->sampler;
    uint32_t t;
    if (!SMEAR_SMALL_CODE && l->turns)
        t = texel_fetch(m->texels, m->palette, index, m->format);
    else
        t = smear_sample_at(m, smear_sampler_texel(m, 0, (int32_t)p->u >> 1), smear_sampler_texel(m, 1, (int32_t)p->v >> 1));
    if (draw_is_cutout(l->draw)) {
        const uint32_t alpha = k->light_kind == LIGHT_NONE ? pixel_alpha(t) : code_times(pixel_alpha(t), p->light[3] >> 23);
        if (alpha < l->draw->cutoff)
            return false;
    }
    uint32_t pixel = t;
    if (k->light_kind != LIGHT_NONE)
        pixel = shaded_pixel(t, p->light[0] >> 7, p->light[1] >> 7, p->light[2] >> 7, k->light_kind == LIGHT_WHITE,
                             frame_is_linear(l->frame));
    if (k->setup != NULL) {
        if (SMEAR_WITH_FOG && fog_of(k->setup) != FOG_NONE)
            pixel = fog_pixel(l->frame, pixel, fog_even_part(k->setup));
        if (setup_writes_velocity(k->setup))
            smear_velocity_still(k->target, at, k->setup->velocity_unknown);
    }
    target_put(k->target, at, pixel);
    return true;
}

static inline void few_put_white(void *to, uint32_t pixel, bool narrow)
{
    if (narrow)
        *(uint16_t *)to = (uint16_t)rgb565_nearest(pixel);
    else
        *(uint32_t *)to = pixel & 0xffffffu;
}

/* Returns a plane's value right of and below its first pixel. */
static inline int32_t few_plane_at(const struct few *k, int plane, int32_t x, int32_t y)
{
    return add_wrap(add_wrap(k->box.at.plane[plane], mul_wrap(k->box.right.plane[plane], x)), mul_wrap(k->box.down.plane[plane], y));
}

/* Draws n > 0 pixels of a row from its column `skip` on, which is pixel `at`. */
SMEAR_INLINE void few_row(const struct few *k, int32_t at, int32_t skip, int32_t row, int32_t n, enum few_kind kind, bool bent)
{
    const struct few_look *const l = k->look;
    const bool linear = frame_is_linear(l->frame), narrow = target_is_direct(k->target);
    uint16_t *depth = k->target->depth + at;
    const uint16_t *const end = depth + n;
    const bool halves = kind == FEW_NARROW || (kind == FEW_WHITE && narrow);
    void *pixel = kind == FEW_ANY ? NULL : halves ? (void *)(k->target->direct + at) : k->target->color + at;
    const int32_t *const step = k->box.right.plane, dz = step[FEW_DEPTH], du = step[FEW_U], dv = step[FEW_V];
    uint32_t z = (uint32_t)few_plane_at(k, FEW_DEPTH, skip, row);
    const int32_t turn = bent ? 0 : FEW_TURN;
    int32_t u = add_wrap(few_plane_at(k, FEW_U, skip, row), turn), v = add_wrap(few_plane_at(k, FEW_V, skip, row), turn);
    int32_t e = bent ? few_plane_at(k, FEW_BEND, skip, row) : 0;
    struct few_pixel p = { 0, 0, { 0, 0, 0, 0 } };
    const int first = few_light_first(k, kind), end_light = few_light_end(k, kind);
    for (int c = first; c < end_light; c++)
        p.light[c] = (uint32_t)few_plane_at(k, light_plane(c), skip, row);
    do {
        if (z >> 16 > *depth) {
            p.u = (uint32_t)u;
            p.v = (uint32_t)v;
            if (bent) {
                const int32_t q = e >> 15, less = q - (q * q >> 15);
                p.u = (uint32_t)add_wrap(k->u0, sub_wrap(u, mul_wrap(u >> 15, less))) << l->up;
                p.v = (uint32_t)add_wrap(k->v0, sub_wrap(v, mul_wrap(v >> 15, less))) << l->up;
            }
            const uint32_t index = (p.v >> l->from_v & l->mask_v) | p.u >> l->from_u;       /* without turns, of no use */
            if (kind == FEW_WHITE)
                few_put_white(pixel, shaded_pixel(texel_fetch(l->texels, l->draw->sampler.palette, index, l->draw->sampler.format), 0, 0,
                                                  p.light[2] >> 7, true, linear), narrow);
            else
                few_pixel_draw(pixel, 0, l->texels, index, p.light[2], kind);
            if (kind != FEW_ANY || few_put(k, (int32_t)(depth - k->target->depth), index, &p))
                *depth = (uint16_t)(z >> 16);
        }
        z += (uint32_t)dz;
        u = add_wrap(u, du);
        v = add_wrap(v, dv);
        if (bent)
            e = add_wrap(e, step[FEW_BEND]);
        for (int c = first; c < end_light; c++)
            p.light[c] += (uint32_t)step[light_plane(c)];
        if (kind != FEW_ANY)
            pixel = pixel_after(pixel, 1, halves);
    } while (++depth != end);
}

/* Draws the rows. What they need stays in memory: compilers that keep it at hand take longer for that than rows of one or two pixels do. */
SMEAR_INLINE void few_rows(const struct few *k, enum few_kind kind, bool bent)
{
    const struct smear_plane_rows *const w = &k->target->window_rows;
    uint64_t first = k->box.at.edges;
    int32_t at = (int32_t)(k->box.depth - k->target->depth);
    for (int32_t y = 0; y != k->place.rows; y++) {
        const struct few *row = k;
        SMEAR_KEEP_VALUE(row);
        const uint64_t right = row->box.right.edges;
        uint64_t edges = first;
        int32_t columns = (int32_t)row->box.columns, left = columns, n = 0;
        while (few_outside(edges) && --left != 0)
            edges += right;
        for (; n != left && !few_outside(edges); n++)
            edges += right;
        if (n != 0)
            few_row(row, at + (columns - left), columns - left, y, n, kind, bent);
        first += row->box.down.edges;
        at += w->stride;
        if (y + 1 == row->place.fits)
            at -= w->ring * w->stride;
    }
}

SMEAR_INLINE void few_rows_of(const struct few *k, enum few_kind kind)
{
    if (k->bent)
        few_rows(k, kind, true);
    else
        few_rows(k, kind, false);
}

static SMEAR_NOINLINE void few_narrow(const struct few *k) { few_rows_of(k, FEW_NARROW); }
static SMEAR_NOINLINE void few_wide(const struct few *k) { few_rows_of(k, FEW_WIDE); }
static SMEAR_NOINLINE void few_linear(const struct few *k) { few_rows_of(k, FEW_LINEAR); }
static SMEAR_NOINLINE void few_white(const struct few *k) { few_rows_of(k, FEW_WHITE); }
static SMEAR_NOINLINE void few_any(const struct few *k) { few_rows(k, FEW_ANY, k->bent); }

static inline void few_texels_take(struct few_look *l, const struct smear_raster_target *t)
{
    const uint32_t depth = (uint32_t)(uintptr_t)t->depth, middle = l->height / 2 * l->width + l->width / 2;
    const bool narrow = l->kind == FEW_NARROW || l->kind == FEW_NARROW_LIT;
    void *const pixels = narrow ? (void *)t->direct : (void *)t->color;
    l->rows = (struct few_texels){ .width = l->width, .height = l->height,
                                   .middle = (uint32_t)(uintptr_t)l->texels + middle * (narrow ? 2u : 4u), .texels = l->texels,
                                   .depth = t->depth, .pixels = pixels, .up = l->up, .uv_shift = l->draw->sampler.uv_shift,
                                   .color = segment_gouraud(l->segment) ? l->segment->color : (uint8_t)0,
                                   .lit = l->segment->shade != SHADE_NONE, .linear = frame_is_linear(l->frame),
                                   .flat_depth = segment_flat_depth(l->segment) };
    few_words_take(&l->rows, (uint32_t)(uintptr_t)pixels - (narrow ? depth + 2u : 2u * depth + 4u), l->kind);
}

static inline void few_rows_any(const struct few *k)
{
    const enum few_kind kind = k->look->kind;
    if (FEW_COPIES && kind == FEW_NARROW)
        few_narrow(k);
    else if (FEW_COPIES && kind == FEW_WIDE)
        few_wide(k);
    else if (FEW_COPIES && (kind == FEW_WHITE || kind == FEW_NARROW_LIT) && k->light_kind == LIGHT_WHITE)
        few_white(k);
    else if (FEW_COPIES && kind == FEW_LINEAR && k->light_kind == LIGHT_WHITE)
        few_linear(k);
    else
        few_any(k);
}

/* ------------------------------------------------------------------ triangles */

bool smear_few_take(struct few_look *l, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                    const struct smear_segment *segment, const struct smear_raster_draw *draw)
{
    const struct smear_sampler *const m = &draw->sampler;
    if (!segment_textured(segment) || segment_moves(segment) != 0 || draw_is_blended(draw))
        return false;
    l->frame = frame;
    l->segment = segment;
    l->draw = draw;
    l->texels = m->texels;
    l->from_u = l->from_v = l->up = 0;
    l->mask_v = 0;
    l->width = (uint32_t)m->width;
    l->height = (uint32_t)m->height;
    l->turns = !SMEAR_SMALL_CODE && m->turns && m->log2_width != 0 && m->log2_height != 0;
    l->kind = FEW_ANY;
    if (!l->turns)
        return true;
    l->up = (uint8_t)(17 - m->uv_shift);
    l->from_u = (uint8_t)(32 - m->log2_width);
    l->from_v = (uint8_t)(l->from_u - m->log2_height);
    l->mask_v = ((1u << m->log2_height) - 1u) << m->log2_width;
    if (!draw_is_opaque(draw) || target_has_velocity(t) || frame_has_fog(frame))
        return true;
    if (segment->shade != SHADE_NONE)
        l->kind = frame_is_linear(frame) && !target_is_direct(t) && m->format == SMEAR_TEXEL_8888 ? FEW_LINEAR
                : !frame_is_linear(frame) && target_is_direct(t) && m->format == SMEAR_TEXEL_565 ? FEW_NARROW_LIT : FEW_WHITE;
    else if (m->format == (target_is_direct(t) ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888))
        l->kind = target_is_direct(t) ? FEW_NARROW : FEW_WIDE;
    if (FEW_ROWS_LOOP || SMEAR_VECTORS)
        few_texels_take(l, t);
    return true;
}

/* Finds the box of pixels and where its rows lie: FEW_LEFT, but FEW_OTHER where it is too large, and FEW_DONE where nothing is left. */
FEW_APART enum few_answer few_place_make(struct few_place *p, struct few_box *box, const struct smear_raster_target *t,
                                         const int32_t *const v[3])
{
    const struct smear_plane_rows *const w = &t->window_rows;
    const int32_t x = v[0][VERTEX_X], y = v[0][VERTEX_Y];
    int32_t left, right, top, bottom;
    box_span(&left, &right, x, v[1][VERTEX_X], v[2][VERTEX_X]);
    box_span(&top, &bottom, y, v[1][VERTEX_Y], v[2][VERTEX_Y]);
    if (right - left > FEW_PX || bottom - top > FEW_PX)
        return FEW_OTHER;
    p->across = (uint32_t)max_i32(right - left, bottom - top);
    p->cut = right > t->x1;
    left = max_i32(left, t->x0);
    top = max_i32(top, t->y0);
    const int32_t columns = min_i32(right, t->x1) - left, rows = min_i32(bottom, t->y1) - top;
    if (columns <= 0 || rows <= 0)
        return FEW_DONE;
    int32_t ring_row = w->ring_row + (top - t->y0);
    ring_row -= ring_row >= w->ring ? w->ring : 0;
    p->cx = left * 256 + 128 - x;
    p->cy = top * 256 + 128 - y;
    p->rows = rows;
    p->fits = w->ring - ring_row;
    box->columns = (uint32_t)columns;
    box->depth = t->depth + (ring_row * w->stride - w->x0 + left);
    box->depth_bytes = (uint32_t)w->stride * 2u;
    box->depth_end = box->depth + min_i32(rows, p->fits) * w->stride;
    return FEW_LEFT;
}

static inline bool few_draw(const struct few_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color,
                            const struct setup *setup)
{
    struct few k;
    struct few_weights w;
    struct few_place p;
    const enum few_answer answer = few_place_make(&p, &k.box, t, v);
    if (answer != FEW_LEFT)
        return answer == FEW_DONE;
    const int32_t x = v[0][VERTEX_X], x1 = v[1][VERTEX_X] - x, x2 = v[2][VERTEX_X] - x;
    const int32_t y = v[0][VERTEX_Y], y1 = v[1][VERTEX_Y] - y, y2 = v[2][VERTEX_Y] - y;
    const int32_t cx = p.cx, cy = p.cy, area = x1 * y2 - x2 * y1;
    const int32_t bias1 = tiny_bias(-x2, -y2), bias2 = tiny_bias(x1, y1);
    const int32_t e1 = y2 * cx - x2 * cy + bias1, e2 = x1 * cy - y1 * cx + bias2;
    const int32_t e0 = area + bias1 + bias2 + tiny_bias(x2 - x1, y2 - y1) - e1 - e2;
    k.box.at.edges = few_edges_word(e0 >> 8, e1 >> 8, e2 >> 8);
    k.box.right.edges = few_edges_word(y1 - y2, y2, -y1);
    k.box.down.edges = few_edges_word(x2 - x1, -x2, x1);
    if (!few_weights_make(&w, x1, y1, x2, y2, area, cx, cy))
        return few_is_empty(&k.box, (int32_t)k.box.columns, p.rows);
    const int32_t q0 = v[0][VERTEX_DEPTH];
    const struct beyond q = few_beyond(q0, v[1][VERTEX_DEPTH], v[2][VERTEX_DEPTH]);
    k.look = l;
    k.light_kind = LIGHT_NONE;
    const enum few_bend bend = few_depth_make(&k, &w, q0, q) ? few_coordinates_make(&k, &w, v, q, p.across) : FEW_CURLED;
    enum few_kind last = FEW_WIDE;      /* that has a loop */
    if (bend == FEW_CURLED)
        return false;
    if (l->segment->shade != SHADE_NONE) {
        if (!segment_gouraud(l->segment))
            few_flat_light(&k, color, frame_is_linear(l->frame));
        else if (!few_light_make(&k, &w, v, q))
            return false;
        last = FEW_LIGHT_LOOP && k.light_kind == LIGHT_WHITE ? FEW_NARROW_LIT : FEW_WIDE;
    }
    if (FEW_ROWS_LOOP && bend == FEW_STRAIGHT && !p.cut && l->kind <= last) {
        few_rows_loop(&k.box, &l->rows, l->kind);
        if (p.rows <= p.fits)
            return true;
        k.box.depth = k.box.depth_end - t->window_rows.ring * t->window_rows.stride;        /* the ring's first row */
        k.box.depth_end = k.box.depth + (p.rows - p.fits) * t->window_rows.stride;
        few_rows_loop(&k.box, &l->rows, l->kind);
        return true;
    }
    k.bent = bend == FEW_BENT;
    k.target = t;
    k.setup = setup;
    k.place = p;
    few_rows_any(&k);
    return true;
}

bool smear_few_draw(const struct few_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color,
                    const struct setup *setup)
{
    if (!SMEAR_VECTORS || l->kind > FEW_NARROW_LIT)
        return few_draw(l, t, v, color, setup);
    const enum few_answer answer = few_lanes_draw(&l->rows, &t->window_rows, &t->x0, v, color, l->kind);
    return answer == FEW_LEFT ? few_draw(l, t, v, color, setup) : answer == FEW_DONE;
}
