/* SPDX-License-Identifier: MIT */
/* few_lanes.h - small textured triangles whose corners, edge functions and planes lie in vectors. The form that defines what they become
 * is few_draw of raster/few_draw.c, which draws what is left to it. */
#ifndef SMEAR_KERNELS_FEW_LANES_H
#define SMEAR_KERNELS_FEW_LANES_H

#include "base/fixmath.h"
#include "kernels/few_loops.h"

enum few_answer { FEW_OTHER, FEW_DONE, FEW_LEFT };      /* it is no small triangle, is drawn, or left to the form that defines it */

#if SMEAR_VECTORS
/* Edge functions are those opposite v[1], v[0] and v[2] (geometry/tiny.h), and how many columns there are to the right. Weights of v[1]
 * and v[2], q15, lie in elements 0 and 2; planes are u, v, depth and light. Of each: at the first pixel, by how much it changes to the
 * right and down. */
struct few_lanes {
    const int32_t *const *v;
    smear_v4i v0, to1, to2;         /* x, y, 1/w and coordinates of v[0]; v[1] and v[2] less these */
    smear_v4i x, y;                 /* from v[0] to the centre of the first pixel, q8 */
    smear_v4i edges, edges_right, edges_down, weights, weights_right, weights_down;
    smear_v4u plane, plane_right, plane_down;
    int32_t across;                 /* columns or rows, the more, before any are cut off */
    int32_t left, top, columns, rows;       /* columns and rows: less one */
    int32_t area;
};

static inline smear_v8i v8i_turned(smear_v8i a) { return (smear_v8i)v4i_turned((smear_v4i)a); }

/* Sums and differences that wrap: elements that are not used hold texture coordinates, and anything. */
static inline smear_v4i v4i_plus(smear_v4i a, smear_v4i b) { return (smear_v4i)((smear_v4u)a + (smear_v4u)b); }
static inline smear_v4i v4i_minus(smear_v4i a, smear_v4i b) { return (smear_v4i)((smear_v4u)a - (smear_v4u)b); }
static inline smear_v8i v8i_minus(smear_v8i a, smear_v8i b) { return (smear_v8i)((smear_v8u)a - (smear_v8u)b); }

/* Finds the pixels between `sides`: left, top, right and bottom. */
SMEAR_INLINE enum few_answer few_lanes_box(struct few_lanes *k, const int32_t *sides)
{
    k->v0 = v4i_load(k->v[0]);
    k->to1 = v4i_minus(v4i_load(k->v[1]), k->v0);
    k->to2 = v4i_minus(v4i_load(k->v[2]), k->v0);
    const smear_v8i zero = v8i_all(0), to = v4i_narrow(k->to1, k->to2), low = v8i_min(to, zero), high = v8i_max(to, zero);
    const smear_v4i at = v4i_plus(k->v0, v4i_all(127)), sides4 = v4i_load(sides);
    const smear_v4i first = v4i_plus(at, v4i_twice_low(v8i_min(low, v8i_turned(low))) >> 16) >> 8;
    const smear_v4i end = v4i_plus(at, v4i_twice_low(v8i_max(high, v8i_turned(high))) >> 16) >> 8, size = end - first;
    k->across = max_i32(size[0], size[1]);
    if (k->across > FEW_PX)
        return FEW_OTHER;
    const smear_v8i limit = v4i_narrow(sides4, sides4), whole = v4i_narrow(v4i_low_pairs(first, end), first);
    const smear_v8i box = v8i_max(whole, limit);
    const smear_v8i less = v8i_minus(v8i_minus((smear_v8i)((smear_v2u)v8i_min(whole, limit) >> 32), box), v8i_all(1));
    const uint32_t corner = ((smear_v4u)box)[0], size_less = ((smear_v4u)less)[0];
    if ((size_less & 0x80008000u) != 0)
        return FEW_DONE;
    k->left = (int32_t)(corner & 0xffffu);
    k->top = (int32_t)(corner >> 16);
    k->columns = (int32_t)(size_less & 0xffffu);
    k->rows = (int32_t)(size_less >> 16);
    const smear_v4i centre = v4i_minus((smear_v4i)(((smear_v4u)(v4i_twice_low(box) >> 16) << 8) + 128u), k->v0);
    k->x = v4i_spread(centre, 0);
    k->y = v4i_spread(centre, 1);
    return FEW_LEFT;
}

SMEAR_INLINE void few_lanes_edges(struct few_lanes *k)
{
    const smear_v4i back = v4i_low(v4i_minus(v4i_all(0), k->to1), (smear_v4i){ 0, -1, 0, 0 });
    const smear_v4i ahead = v4i_low(k->to2, v4i_minus(k->to1, k->to2));
    const smear_v4i right = v4i_high_pairs(ahead, back), down = v4i_minus(v4i_all(0), v4i_low_pairs(ahead, back));
    const smear_v4i outer = v4i_plus(v4i_even(right, k->x), v4i_even(down, k->y)), parts = v4i_even(down, v4i_turned(right));
    const smear_v4i middle = v4i_minus(v4i_turned(v4i_minus(parts, outer)), v4i_plus(parts, outer));
    const smear_v4i columns = { 256 * (k->columns + 1), 0, 0, 0 };
    const smear_v4i all = v4i_low_pairs(v4i_low(outer, middle), v4i_low(v4i_turned(outer), columns));
    k->area = parts[2] - parts[0];
    k->edges = v4i_plus(all, (smear_v4i)(v4i_plus((smear_v4i)((smear_v4u)right << 16), down) < 1)) >> 8;
    k->edges_right = right;
    k->edges_down = down;
}

/* False for slivers (few_weights_make). */
SMEAR_INLINE bool few_lanes_weights(struct few_lanes *k)
{
    const int32_t area = k->area;
    if (area < (FEW_PX + 1) * 256 * 64) {
        const smear_v8i to = v4i_narrow(k->to1, k->to2), steep = v8i_max(to, v8i_minus(v8i_all(0), to)) > v8i_all((int16_t)(area >> 6));
        if (area < 256 || v4u_any((smear_v4u)steep & (smear_v4u){ ~0u, 0, ~0u, 0 }))
            return false;
    }
    const int up = count_leading_zeros((uint32_t)area), down = 24 - up;
    const smear_v4i recip = v4i_all((int32_t)(recip_norm((uint32_t)area << up) >> 14));
    k->weights_right = v4i_even(k->edges_right, recip) >> down;
    k->weights_down = v4i_even(k->edges_down, recip) >> down;
    k->weights = v4i_plus(v4i_even(k->weights_right, k->x), v4i_even(k->weights_down, k->y)) >> 8;
    return true;
}

/* What planes change by to v[1] and to v[2], in elements 0 and 2: u and v; depth and light. */
struct few_changes {
    smear_v4i uv1, uv2, look1, look2;
};

SMEAR_INLINE smear_v4u few_lanes_plane(const struct few_changes *d, smear_v4i weights, int up)
{
    const smear_v4i w1 = v4i_spread(weights, 0), w2 = v4i_spread(weights, 2);
    const smear_v4u uv = (smear_v4u)v4i_plus(v4i_even(d->uv1, w1), v4i_even(d->uv2, w2)) << up;
    return (smear_v4u)v4i_evens((smear_v4i)uv, v4i_plus(v4i_even(d->look1, w1), v4i_even(d->look2, w2)));
}

/* u and v of a vertex. */
SMEAR_INLINE smear_v4i few_lanes_uv(smear_v4i vertex)
{
    const smear_v4i twice = v4i_twice_high((smear_v8i)vertex) >> 16;
    return (smear_v4i){ twice[2], twice[2], twice[3], twice[3] };
}

/* Whether perspective may be left out: few_bend_of. `range`: of 1/w. */
SMEAR_INLINE bool few_lanes_straight(const struct few_lanes *k, const struct few_texels *t, const struct few_changes *d, uint32_t range)
{
    const uint32_t change = (range >> 12) + 1u, whole = (uint32_t)k->v[0][2] >> 12;
    if (change * (uint32_t)k->across * 4u <= whole)
        return true;
    const smear_v4i zero = v4i_all(0), both = v4i_max(v4i_max(d->uv1, d->uv2), zero) - v4i_min(v4i_min(d->uv1, d->uv2), zero);
    const uint32_t travel = max_u32((uint32_t)both[0] * t->width, (uint32_t)both[2] * t->height);
    return change * (4u * min_u32((travel >> t->uv_shift) + 1u, 1023u)) <= whole;
}

/* Takes light as few_flat_light and few_light_make do. False where that is not white, or needs perspective. */
SMEAR_INLINE bool few_lanes_light(struct few_changes *d, int32_t *light, const struct few_lanes *k, const struct few_texels *t,
                                  uint32_t color, uint32_t range)
{
    int32_t to1 = 0, to2 = 0;
    bool white = ((color ^ color >> 8) & 0xffffu) == 0;
    if (t->color == 0) {
        *light = (int32_t)(t->linear ? smear_srgb_decode[color & 255u] : (color & 255u) << 8);
    } else {
        const int32_t *const c0 = k->v[0] + t->color, *const c1 = k->v[1] + t->color, *const c2 = k->v[2] + t->color;
        *light = few_light_value(c0, 2, t->linear);
        to1 = few_light_value(c1, 2, t->linear) - *light;
        to2 = few_light_value(c2, 2, t->linear) - *light;
        white = few_is_white(c0) && few_is_white(c1) && few_is_white(c2);
    }
    const uint32_t most = (uint32_t)max_i32(max_i32(to1, to2), 0) - (uint32_t)min_i32(min_i32(to1, to2), 0);
    d->look1 = v4i_low_pairs(d->look1, (smear_v4i){ to1, 0, 0, 0 });
    d->look2 = v4i_low_pairs(d->look2, (smear_v4i){ to2, 0, 0, 0 });
    return white && (t->flat_depth || (most >> 9) * (range >> 12) <= (uint32_t)k->v[0][2] >> 12);
}

SMEAR_INLINE enum few_answer few_lanes_planes(struct few_lanes *k, const struct few_texels *t, uint32_t color)
{
    const int32_t q0 = k->v[0][2], q1 = k->v[1][2], q2 = k->v[2][2];
    const int32_t low = min_i32(min_i32(q0, q1), q2), high = max_i32(max_i32(q0, q1), q2);
    const bool far = high < SLOPE_BREAK - 65536;
    const smear_v4i uv = few_lanes_uv(k->v0), half = v4i_all(far ? 512 : 8192);
    const smear_v4i look1 = v4i_plus(k->to1, half) >> (far ? 10 : 14), look2 = v4i_plus(k->to2, half) >> (far ? 10 : 14);
    struct few_changes d = { few_lanes_uv(v4i_load(k->v[1])) - uv, few_lanes_uv(v4i_load(k->v[2])) - uv, v4i_turned(look1),
                             v4i_turned(look2) };
    int32_t light = 0;
    if (!far && low < SLOPE_BREAK + 65536)
        return FEW_OTHER;
    if ((!t->flat_depth && !few_lanes_straight(k, t, &d, (uint32_t)(high - low)))
        || (t->lit && !few_lanes_light(&d, &light, k, t, color, (uint32_t)(high - low))))
        return FEW_LEFT;
    const int32_t code = (int32_t)code_from_units(q0, far ? SLOPE_FAR : SLOPE_NEAR);
    k->plane_right = few_lanes_plane(&d, k->weights_right, t->up);
    k->plane_down = few_lanes_plane(&d, k->weights_down, t->up);
    const smear_v4i first = v4i_evens((smear_v4i)((smear_v4u)uv << (15 + t->up)), (smear_v4i){ code, 0, light << 15, 0 });
    k->plane = few_lanes_plane(&d, k->weights, t->up) + (smear_v4u)first;
    return FEW_DONE;
}

/* Draws the rows, which lie in a ring: that of y0 is w->ring_row. */
SMEAR_INLINE void few_lanes_rows(const struct few_lanes *k, const struct few_texels *t, const struct smear_plane_rows *w, int32_t y0,
                                 enum few_kind kind)
{
    const smear_v4u turns = v4u_all(t->width | t->height << 16), number = v4u_all(1u | t->width << 16);
    const smear_v4i edges_right = k->edges_right, edges_down = k->edges_down;
    const smear_v4u plane_right = k->plane_right, plane_down = k->plane_down;
    const ptrdiff_t stride = w->stride;
    const void *const texels = t->texels;
    void *const pixels = t->pixels;
    uint16_t *const depth = t->depth;
    int32_t ring_row = w->ring_row + (k->top - y0);
    ring_row -= ring_row >= w->ring ? w->ring : 0;
    int32_t fits = w->ring - ring_row, left = k->rows;
    ptrdiff_t row = ring_row * stride + k->left - w->x0;
    smear_v4i edges_first = k->edges;
    for (smear_v4u plane_first = k->plane;; plane_first += plane_down, edges_first += edges_down, row += stride) {
        smear_v4i edges = edges_first;
        smear_v4u plane = plane_first;
        ptrdiff_t i = row;
        uint32_t outside = v4i_signs(edges);
        for (; outside - 1u < 7u; outside = v4i_signs(edges), plane += plane_right, i++)
            edges += edges_right;
        for (; outside == 0; outside = v4i_signs(edges), plane += plane_right, i++) {
            const uint32_t code = ((smear_v8u)plane)[5];
            edges += edges_right;
            if (code > depth[i]) {
                const smear_v4u texel = v4u_mulh16((smear_v4u)v8i_uppers((smear_v8i)plane), turns);
                depth[i] = (uint16_t)code;
                few_pixel_draw(pixels, (size_t)i, texels, (uint32_t)v8i_dot((smear_v8i)texel, (smear_v8i)number)[0], plane[3], kind);
            }
        }
        if (--left < 0)
            break;
        if (--fits == 0)
            row -= w->ring * stride;
    }
}

/* Whether a sliver has no pixel, as most have none. */
static SMEAR_RARE bool few_lanes_empty(smear_v4i first, smear_v4i right, smear_v4i down, int32_t rows)
{
    for (; rows >= 0; rows--, first += down)
        for (smear_v4i edges = first; edges[3] >= 0; edges += right)
            if (v4i_signs(edges) == 0)
                return false;
    return true;
}

/* Draws a triangle of texels in rows w between `sides`. */
SMEAR_INLINE enum few_answer few_lanes_draw(const struct few_texels *t, const struct smear_plane_rows *w, const int32_t *sides,
                                            const int32_t *const v[3], uint32_t color, enum few_kind kind)
{
    struct few_lanes k = { .v = v };
    enum few_answer answer = few_lanes_box(&k, sides);
    if (answer != FEW_LEFT)
        return answer;
    few_lanes_edges(&k);
    if (!few_lanes_weights(&k))
        return few_lanes_empty(k.edges, k.edges_right, k.edges_down, k.rows) ? FEW_DONE : FEW_OTHER;
    answer = few_lanes_planes(&k, t, color);
    if (answer != FEW_DONE)
        return answer;
    if (kind == FEW_NARROW)
        few_lanes_rows(&k, t, w, sides[1], FEW_NARROW);
    else if (kind == FEW_WIDE)
        few_lanes_rows(&k, t, w, sides[1], FEW_WIDE);
    else if (kind == FEW_LINEAR)
        few_lanes_rows(&k, t, w, sides[1], FEW_LINEAR);
    else
        few_lanes_rows(&k, t, w, sides[1], FEW_NARROW_LIT);
    return FEW_DONE;
}
#else
enum few_answer few_lanes_draw(const struct few_texels *t, const struct smear_plane_rows *w, const int32_t *sides,
                               const int32_t *const v[3], uint32_t color, enum few_kind kind);      /* nowhere, and not called */
#endif

#endif
