/* SPDX-License-Identifier: MIT */
/* cover_texels.c - textured triangles of a few pixels: coordinates, depth and light are weighed at each pixel by the edge
 * functions themselves, which costs less than their gradients.
 *
 * Perspective: with 1/w = (1 + e) / w0, where e is weighed like the rest, the weight of a vertex becomes a (1 + e_vertex) /
 * (1 + e), nearly a (1 + e_vertex - e). Where 1/w changes by a part c of that at v[0], and coordinates by t texels,
 * they are off by less than c^2 t / 3: c is at most 1/8 here, and c^2 t at most 1/8. Light is not corrected: it is off by half
 * a code at most, a quarter of its range times c. */
#include "raster/cover.h"

#include "geometry/tiny.h"
#include "kernels/texel_light.h"

#include "raster/fog.h"
#include "raster/span.h"

/* The changes from v[0] to v[1] and to v[2]. */
struct beyond {
    int32_t to1, to2;
};

static inline int32_t beyond_range(struct beyond b)
{
    return max_i32(max_i32(b.to1, b.to2), 0) - min_i32(min_i32(b.to1, b.to2), 0);
}

/* A sum of weights q15 adds up to at most one, so the result of 17-bit changes fits. */
static inline int32_t weigh(struct beyond b, int32_t w1, int32_t w2)
{
    return add_wrap(mul_wrap(b.to1, w1), mul_wrap(b.to2, w2));
}

enum light_kind {
    LIGHT_NONE,
    LIGHT_WHITE,            /* red, green and blue alike */
    LIGHT_COLORED
};

/* Coordinates of v[0] (q15 mesh units) and changes of them; depth, units q11; e, q15; light, 16 bits. */
struct few_texels {
    int32_t u, v, q;
    struct beyond to_u, to_v, to_q, e;
    /* With turns: index = v >> from_v & mask_v | u >> from_u & mask_u */
    int from_u, from_v;
    uint32_t mask_u, mask_v;
    enum light_kind kind;
    bool in_fog;                    /* one part of it */
    int32_t light[4];               /* r g b a; in white light those of r and g are not set */
    struct beyond to_light[4];
};

/* Texels that are copied into pixels of 16 or 32 bits; any. */
enum few_kind { FEW_NARROW, FEW_WIDE, FEW_ANY };

/* Loops of their own for copied texels: not where size counts, or flash has no room for them. */
enum { FEW_COPIES = !SMEAR_SMALL_FILE && !SMEAR_ON_ARMV6M };

/* ------------------------------------------------------------------ vertices */

/* Whether c^2 t is at most 1/8: at first for all the texels that coordinates of 16 bits can span. */
static inline bool is_near_enough(const struct few_texels *k, const struct smear_sampler *m)
{
    const uint32_t c = (uint32_t)beyond_range(k->e), square = c * c >> 15, size = (uint32_t)max_i32(m->width, m->height);
    if (square * ((size << 16 >> m->uv_shift) + 1u) <= 1u << 12)
        return true;
    const uint32_t travel = max_u32((uint32_t)beyond_range(k->to_u) * (uint32_t)m->width,
                                    (uint32_t)beyond_range(k->to_v) * (uint32_t)m->height);
    return square * ((travel >> m->uv_shift) + 1u) <= 1u << 12;
}

/* False where coordinates need more than is done here. */
static inline bool load_coordinates(struct few_texels *k, const struct setup *s)
{
    const struct smear_sampler *m = &s->draw->sampler;
    const int32_t u0 = setup_mesh_u(s, 0), v0 = setup_mesh_v(s, 0), q0 = s->v[0][VERTEX_DEPTH];
    k->u = u0 * 32768;
    k->v = v0 * 32768;
    k->q = q0;
    k->to_u = (struct beyond){ setup_mesh_u(s, 1) - u0, setup_mesh_u(s, 2) - u0 };
    k->to_v = (struct beyond){ setup_mesh_v(s, 1) - v0, setup_mesh_v(s, 2) - v0 };
    k->to_q = (struct beyond){ s->v[1][VERTEX_DEPTH] - q0, s->v[2][VERTEX_DEPTH] - q0 };
    k->e = (struct beyond){ 0, 0 };
    if (segment_flat_depth(s->segment))
        return true;
    /* |e| at most 1/8 at both vertices */
    const uint32_t most = (uint32_t)q0 >> 3;
    if ((uint32_t)k->to_q.to1 + most > 2u * most || (uint32_t)k->to_q.to2 + most > 2u * most)
        return false;
    const int up = count_leading_zeros((uint32_t)q0) - 1;
    const int32_t recip = (int32_t)recip_norm((uint32_t)q0 << 1 << up);     /* 1/q0 = recip 2^(up - 60) */
    k->e = (struct beyond){ mulh_i32(shl_wrap(k->to_q.to1, up), recip) >> 13,
                            mulh_i32(shl_wrap(k->to_q.to2, up), recip) >> 13 };
    return is_near_enough(k, m);
}

/* False where the texture's bits are not told by shifts of q15 mesh units. */
static inline bool load_turns(struct few_texels *k, const struct smear_sampler *m)
{
    if (!m->turns)
        return false;
    const int turn = 15 + m->uv_shift;      /* log2 */
    k->from_u = turn - m->log2_width;
    k->from_v = k->from_u - m->log2_height;
    k->mask_u = (1u << m->log2_width) - 1u;
    k->mask_v = ((1u << m->log2_height) - 1u) << m->log2_width;
    return k->from_v >= 0;
}

static inline bool is_white(const int32_t *color)
{
    const uint32_t word = (uint32_t)color[0];
    return (word & 0xffffu) == word >> 16 && (word & 0xffffu) == ((uint32_t)color[1] & 0xffffu);
}

static void load_flat_light(struct few_texels *k, uint32_t color, bool linear)
{
    for (int c = 0; c < 4; c++) {
        const uint32_t code = c < 3 ? color >> (16 - 8 * c) & 255u : pixel_alpha(color);
        k->light[c] = (int32_t)(linear && c < 3 ? smear_srgb_decode[code] : code << 8);
        k->to_light[c] = (struct beyond){ 0, 0 };
    }
    k->kind = pixel_red(color) == pixel_green(color) && pixel_red(color) == pixel_blue(color) ? LIGHT_WHITE : LIGHT_COLORED;
}

static inline int32_t light_of(const struct setup *s, int vertex, int c)
{
    const uint32_t word = (uint32_t)s->v[vertex][s->segment->color + (c >> 1)];
    return (int32_t)(c & 1 ? word >> 16 : word & 0xffffu);
}

/* False where light needs perspective. */
static bool load_light(struct few_texels *k, const struct setup *s)
{
    const int at = s->segment->color;
    const uint32_t change = (uint32_t)beyond_range(k->e);
    if (!segment_gouraud(s->segment)) {
        load_flat_light(k, s->color, frame_is_linear(s->frame));
        return true;
    }
    k->kind = is_white(s->v[0] + at) && is_white(s->v[1] + at) && is_white(s->v[2] + at) ? LIGHT_WHITE : LIGHT_COLORED;
    for (int c = k->kind == LIGHT_WHITE ? 2 : 0; c < (draw_is_opaque(s->draw) ? 3 : 4); c++) {
        k->light[c] = light_of(s, 0, c);
        k->to_light[c] = (struct beyond){ light_of(s, 1, c) - k->light[c], light_of(s, 2, c) - k->light[c] };
        if ((uint32_t)(beyond_range(k->to_light[c]) >> 8) * change > 2u << 15)
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------ pixels */

/* A channel of the light, 16 bits. */
static inline uint32_t light_at(const struct few_texels *k, int c, int32_t w1, int32_t w2)
{
    return (uint32_t)(k->light[c] + (weigh(k->to_light[c], w1, w2) >> 15));
}

static inline uint32_t code_at(const struct few_texels *k, int c, int32_t w1, int32_t w2)
{
    return (min_u32(light_at(k, c, w1, w2), 0xff00u) + 128u) >> 8;
}

/* A texel in the light at weights. */
SMEAR_INLINE uint32_t light_texel(const struct few_texels *k, uint32_t t, int32_t w1, int32_t w2, bool linear)
{
    if (linear) {
        const uint32_t blue = light_at(k, 2, w1, w2);
        const uint32_t red = k->kind == LIGHT_WHITE ? blue : light_at(k, 0, w1, w2);
        const uint32_t green = k->kind == LIGHT_WHITE ? blue : light_at(k, 1, w1, w2);
        return pixel_make(0, code_times_linear(pixel_red(t), red), code_times_linear(pixel_green(t), green),
                          code_times_linear(pixel_blue(t), blue));
    }
    const uint32_t blue = code_at(k, 2, w1, w2), pair = 0xff00ffu;
    if (k->kind == LIGHT_WHITE) {
        uint32_t rb = (t & pair) * blue + 0x800080u;
        rb = (rb + (rb >> 8 & pair)) >> 8 & pair;
        return rb | code_times(pixel_green(t), blue) << 8;
    }
    return pixel_make(0, code_times(pixel_red(t), code_at(k, 0, w1, w2)), code_times(pixel_green(t), code_at(k, 1, w1, w2)),
                      code_times(pixel_blue(t), blue));
}

/* The texel's place in memory, with turns. */
static inline uint32_t index_at(const struct few_texels *k, int32_t u, int32_t v)
{
    return ((uint32_t)(v >> k->from_v) & k->mask_v) | ((uint32_t)(u >> k->from_u) & k->mask_u);
}

/* The texel at coordinates, as 0xAARRGGBB. */
static inline uint32_t texel_at(const struct few_texels *k, const struct smear_sampler *m, int32_t u, int32_t v)
{
    if (!SMEAR_SMALL_CODE && k->from_v >= 0)
        return texel_fetch(m->texels, m->palette, index_at(k, u, v), m->format);
    return smear_sample_at(m, smear_sampler_texel(m, 0, u >> 1), smear_sampler_texel(m, 1, v >> 1));
}

/* A pixel at weights q15 that is nearer than what was there. */
SMEAR_INLINE void put_texel(const struct setup *s, const struct few_texels *k, int32_t at, uint32_t code, int32_t w1,
                            int32_t w2, enum few_kind kind)
{
    const struct smear_raster_target *t = s->target;
    const struct smear_sampler *m = &s->draw->sampler;
    const int32_t e = weigh(k->e, w1, w2) >> 15;
    const int32_t p1 = w1 + (w1 * (k->e.to1 - e) >> 15), p2 = w2 + (w2 * (k->e.to2 - e) >> 15);
    const int32_t u = add_wrap(k->u, weigh(k->to_u, p1, p2)), v = add_wrap(k->v, weigh(k->to_v, p1, p2));
    if (kind == FEW_NARROW) {
        t->direct[at] = ((const uint16_t *)m->texels)[index_at(k, u, v)];
    } else if (kind == FEW_WIDE) {
        t->color[at] = ((const uint32_t *)m->texels)[index_at(k, u, v)] & 0xffffffu;
    } else {
        const uint32_t p = texel_at(k, m, u, v);
        if (draw_is_cutout(s->draw)) {
            const uint32_t alpha = k->kind == LIGHT_NONE ? pixel_alpha(p)
                                                         : code_times(pixel_alpha(p), code_at(k, 3, w1, w2));
            if (alpha < s->draw->cutoff)
                return;
        }
        uint32_t pixel = k->kind == LIGHT_NONE ? p : light_texel(k, p, w1, w2, frame_is_linear(s->frame));
        if (SMEAR_WITH_FOG && k->in_fog)
            pixel = fog_pixel(s->frame, pixel, fog_even_part(s));
        target_put(t, at, pixel);
    }
    t->depth[at] = (uint16_t)code;
    if (setup_writes_velocity(s))
        smear_velocity_still(t, at, s->velocity_unknown);
}

SMEAR_INLINE void draw_few(const struct setup *s, const struct few_texels *k, int32_t area, const struct pixel_box *box,
                           enum few_kind kind)
{
    const struct smear_raster_target *t = s->target;
    const int32_t x0 = max_i32(box->left, t->x0), x1 = min_i32(box->right, t->x1), bottom = box->bottom;
    const struct tiny_scale scale = tiny_scale_make(area);
    struct tiny_edges e;
    tiny_start(&e, s->v[0][VERTEX_X], s->v[0][VERTEX_Y], s->x1, s->y1, s->x2, s->y2, area, x0, box->top);
    int32_t ring_row = t->window_rows.ring_row + (box->top - t->y0);
    for (int32_t y = box->top; y < bottom; y++, ring_row++, e.e0 += e.down0, e.e1 += e.down1, e.e2 += e.down2) {
        int32_t e0 = e.e0, e1 = e.e1, e2 = e.e2, x = x0;
        while ((e0 | e1 | e2) < 0 && ++x < x1) {
            e0 += e.right0;
            e1 += e.right1;
            e2 += e.right2;
        }
        if (x == x1)
            continue;
        if (ring_row >= t->window_rows.ring)
            ring_row -= t->window_rows.ring;
        int32_t at = ring_row * t->window_rows.stride + x - t->window_rows.x0;
        const int32_t end = at + (x1 - x);
        do {
            const int32_t w1 = (int32_t)(tiny_weight(scale, e1) >> 1), w2 = (int32_t)(tiny_weight(scale, e2) >> 1);
            const uint32_t code = tiny_code(k->q + tiny_part(k->to_q.to1, w1) + tiny_part(k->to_q.to2, w2));
            if (code > t->depth[at])
                put_texel(s, k, at, code, w1, w2, kind);
            e0 += e.right0;
            e1 += e.right1;
            e2 += e.right2;
        } while (++at < end && (e0 | e1 | e2) >= 0);
    }
}

bool smear_cover_texels(const struct setup *s, int32_t area, const struct pixel_box *box)
{
    const struct smear_sampler *m = &s->draw->sampler;
    struct few_texels k;
    if (!load_coordinates(&k, s))
        return false;
    k.kind = LIGHT_NONE;
    if (s->segment->shade != SHADE_NONE && !load_light(&k, s))
        return false;
    if (SMEAR_WITH_FOG && fog_varies(s))
        return false;
    k.in_fog = fog_of(s) != FOG_NONE;
    const bool turns = !SMEAR_SMALL_CODE && load_turns(&k, m);
    if (!SMEAR_SMALL_CODE && !turns)
        k.from_v = -1;
    const bool narrow = target_is_direct(s->target);
    if (FEW_COPIES && turns && k.kind == LIGHT_NONE && !k.in_fog && draw_is_opaque(s->draw)
        && m->format == (narrow ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888)) {
        if (narrow)
            draw_few(s, &k, area, box, FEW_NARROW);
        else
            draw_few(s, &k, area, box, FEW_WIDE);
        return true;
    }
    draw_few(s, &k, area, box, FEW_ANY);
    return true;
}
