/* SPDX-License-Identifier: MIT */
/* lane_rows.c - texels in rows of a triangle, copied or lit, by vectors of eight and sixteen pixels. */
#include "raster/texture_rows.h"

#include "kernels/row_sides.h"
#include "raster/lane_carried.h"
#include "raster/lane_spans.h"

#if SMEAR_LANE_ROWS

static inline void texel_rows_start(struct texel_rows *t, const struct smear_raster_target *target, const struct smear_sampler *m,
                                    int32_t at)
{
    SMEAR_ASSERT(target->x1 - target->x0 >= TEXEL_ROWS_LEAST);
    t->texels = m->texels;
    t->lights = NULL;
    t->wraps = NULL;
    t->log2_width = m->log2_width;
    t->log2_height = m->log2_height;
    t->narrow = target_is_direct(target);
    t->color = t->narrow ? (void *)(target->direct + at) : target->color + at;
    t->depth = target->depth + at;
    t->stride = target->window_rows.stride;
    t->x0 = target->x0;
    t->x1 = target->x1;
}

static void wraps_start(struct texel_wraps *w, const struct smear_sampler *m)
{
    *w = (struct texel_wraps){ { m->width, m->height }, { m->scale[0], m->scale[1] }, { m->wrap_u, m->wrap_v },
                               { m->shift[0], m->shift[1] } };
}

/* A light that is the same throughout the triangle: codes, or linear light. */
static void even_lights(struct texel_lights *l, uint32_t color)
{
    for (int i = 0; i < 3; i++) {
        const uint32_t code = color >> (16 - 8 * i) & 255u;
        l->planes.c[i] = (struct texel_plane){ (int32_t)(l->linear ? (uint32_t)smear_srgb_decode[code] << 8 : code << 16), 0, 0 };
    }
    l->plain = (color & 0xffffffu) == 0xffffffu;
}

/* Whether light is exact where blocks meet, and follows chords between. */
static inline bool lights_have_blocks(const struct setup *s)
{
    return segment_gouraud(s->segment) && s->perspective_color && !s->even_color;
}

/* As struct texel_light has it, and as span.c lights texels. */
static void lights_start(struct texel_lights *l, const struct setup *s, int32_t y)
{
    const struct smear_sampler *m = &s->draw->sampler;
    l->palette = m->palette;
    l->format = m->format;
    l->linear = frame_is_linear(s->frame);
    l->planes.block = 0;
    if (!segment_gouraud(s->segment)) {
        even_lights(l, s->segment->shade == SHADE_FLAT ? s->color : 0xffffffu);
        return;
    }
    l->plain = false;
    if (lights_have_blocks(s)) {
        l->planes.block = s->texture.block;
        l->planes.q = plane_from(&s->depth, y);
    }
    for (int i = 0; i < 3; i++)
        l->planes.c[i] = s->even_color ? (struct texel_plane){ s->channel[i].at, 0, 0 } : plane_from(&s->channel[i], y);
}

typedef void draw_spans(const struct texel_rows *t, const struct texel_spans *spans, const void *coordinates);

/* What texels become: they are copied, lit, or wrapped and lit. */
enum rows_look { ROWS_COPIED, ROWS_LIT, ROWS_WRAPPED };

/* Draws all rows, in one go as a rule. */
SMEAR_INLINE void draw_rows(const struct setup *s, const struct span_rows *r, const void *coordinates, draw_spans *draw,
                            enum rows_look look)
{
    struct texel_rows t;
    struct texel_spans spans;
    struct texel_lights lights;
    struct texel_wraps wraps;
    struct row_run p;
    texel_rows_start(&t, s->target, &s->draw->sampler, r->at);
    if (look != ROWS_COPIED) {
        lights_start(&lights, s, r->y);
        t.lights = &lights;
    }
    if (look == ROWS_WRAPPED) {
        wraps_start(&wraps, &s->draw->sampler);
        t.wraps = &wraps;
    }
    if (rows_are_plain(s)) {
        spans_of_rows(&spans, s, r);
        draw(&t, &spans, coordinates);
        return;
    }
    spans.count = 0;
    for (int32_t row = 0; row < r->count; row++) {
        p.b = r->side[row].left;
        while (p.b < r->side[row].right && smear_row_run_next(&p, s, r, row, p.b)) {
            if (spans.count == TEXEL_SPANS) {
                draw(&t, &spans, coordinates);
                spans.count = 0;
            }
            spans_add(&spans, r, row, &p);
        }
    }
    draw(&t, &spans, coordinates);
}

static void draw_places(const struct texel_rows *t, const struct texel_spans *spans, const void *coordinates)
{
    smear_texel_rows_places_avx2(t, spans, (const struct texel_planes *)coordinates);
}

static void draw_curves(const struct texel_rows *t, const struct texel_spans *spans, const void *coordinates)
{
    smear_texel_rows_curves_avx2(t, spans, (const struct texel_curves *)coordinates);
}

static inline struct texel_planes planes_from(const struct texture_setup *t, int32_t y)
{
    return (struct texel_planes){ plane_from(&t->q, y), plane_from(&t->uv[0], y), plane_from(&t->uv[1], y),
                                  t->slope, t->block, t->up, t->mode == TEXTURE_DIVIDED, t->parabolic };
}

SMEAR_INLINE void places_draw(const struct setup *s, const struct span_rows *r, enum rows_look look)
{
    const struct texel_planes p = planes_from(&s->texture, r->y);
    draw_rows(s, r, &p, draw_places, look);
}

SMEAR_STATIC_ASSERT(sizeof(struct curve) == sizeof(struct texel_curve) && offsetof(struct curve, dyy) == offsetof(struct texel_curve, dyy)
                        && offsetof(struct texel_curves, v) == offsetof(struct texel_curves, u) + sizeof(struct curve),
                    "curves are copied");

SMEAR_INLINE void curves_from(struct texel_curves *p, const struct texture_setup *t, int32_t y)
{
    p->x0 = t->x0;
    p->y0 = t->y0 - y;
    p->block = t->block;
    __builtin_memcpy(&p->u, t->curve, sizeof t->curve);
}

SMEAR_STATIC_ASSERT((int)SPAN_ROWS == (int)TEXEL_SIDES, "rows are columns' sides");

/* Draws whole rows by columns. */
SMEAR_INLINE void draw_columns(const struct setup *s, const struct span_rows *r, const struct texel_curves *p, bool lit)
{
    const struct texel_sides sides = {
        r->side, r->count, code_from_units(plane_at(&s->depth, 0, r->y), s->slope),
        (uint32_t)step_from_units(s->depth.dx, s->slope), (uint32_t)step_from_units(s->depth.dy, s->slope)
    };
    struct texel_rows t;
    struct texel_lights lights;
    texel_rows_start(&t, s->target, &s->draw->sampler, r->at);
    if (lit) {
        lights_start(&lights, s, r->y);
        t.lights = &lights;
    }
    smear_texel_columns_avx2(&t, &sides, p);
}

SMEAR_INLINE void curves_draw(const struct setup *s, const struct span_rows *r, enum rows_look look)
{
    struct texel_curves p;
    curves_from(&p, &s->texture, r->y);
    if (look != ROWS_WRAPPED && rows_are_whole(s, r) && !(look == ROWS_LIT && lights_have_blocks(s)))
        draw_columns(s, r, &p, look == ROWS_LIT);
    else
        draw_rows(s, r, &p, draw_curves, look);
}

static void lane_places(const struct setup *s, const struct span_rows *r) { places_draw(s, r, ROWS_COPIED); }
static void lane_curves(const struct setup *s, const struct span_rows *r) { curves_draw(s, r, ROWS_COPIED); }
static void lane_places_lit(const struct setup *s, const struct span_rows *r) { places_draw(s, r, ROWS_LIT); }
static void lane_curves_lit(const struct setup *s, const struct span_rows *r) { curves_draw(s, r, ROWS_LIT); }
static void lane_places_wrapped(const struct setup *s, const struct span_rows *r) { places_draw(s, r, ROWS_WRAPPED); }
static void lane_curves_wrapped(const struct setup *s, const struct span_rows *r) { curves_draw(s, r, ROWS_WRAPPED); }

/* Kernels read what lies beside halves and bytes. */
static bool sampler_wraps(const struct smear_sampler *m) { return !m->turns && !m->bilinear && m->width * m->height >= 4; }

/* Whether texels are what the target has. */
static bool texels_are_copied(const struct setup *s)
{
    return s->segment->shade == SHADE_NONE
        && s->draw->sampler.format == (target_is_direct(s->target) ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888);
}

smear_rows_fn *smear_lane_rows_choose(const struct setup *s)
{
    const struct smear_sampler *m = &s->draw->sampler;
    if (!draw_is_opaque(s->draw) || fog_of(s) != FOG_NONE || s->target->x1 - s->target->x0 < TEXEL_ROWS_LEAST || !smear_has_avx2())
        return NULL;
    if (sampler_wraps(m))
        return s->texture.mode == TEXTURE_CURVED ? lane_curves_wrapped : lane_places_wrapped;
    if (!m->turns || m->log2_width == 0 || m->log2_height == 0)
        return NULL;
    if (s->texture.mode == TEXTURE_CURVED)
        return texels_are_copied(s) ? lane_curves : lane_curves_lit;
    return texels_are_copied(s) ? lane_places : lane_places_lit;
}

/* ------------------------------------------------------------------ rows of a triangle that goes on */

bool smear_lane_carries(const struct setup *s, bool cut)
{
    return rows_are_plain(s) && (s->rows == lane_places || (s->rows == lane_curves && !cut));
}

bool smear_lane_carry(struct texel_carried *c, const struct setup *s, int32_t y)
{
    const bool curved = s->rows == lane_curves;
    smear_sides_carry_avx2(&c->sides, s->v, y);
    c->z = code_from_units(plane_at(&s->depth, 0, y), s->slope);
    c->dz = (uint32_t)step_from_units(s->depth.dx, s->slope);
    c->dz_down = (uint32_t)step_from_units(s->depth.dy, s->slope);
    if (curved)
        curves_from(&c->at.curves, &s->texture, y);
    else
        c->at.planes = planes_from(&s->texture, y);
    return curved;
}

static inline void plane_go(struct texel_plane *p, int32_t rows) { p->at = add_wrap(p->at, mul_wrap(p->dy, rows)); }

/* Goes on to row y. */
SMEAR_INLINE void carried_go(struct texel_carried *c, int32_t y, bool curved)
{
    const int32_t rows = y - c->sides.y;
    carried_sides_go(&c->sides, rows);
    c->z += c->dz_down * (uint32_t)rows;
    if (curved) {
        c->at.curves.y0 -= rows;
        return;
    }
    plane_go(&c->at.planes.q, rows);
    plane_go(&c->at.planes.u, rows);
    plane_go(&c->at.planes.v, rows);
}

SMEAR_INLINE void carried_draw(struct texel_carried *c, const struct smear_raster_target *target, const struct smear_sampler *m,
                               int32_t y, int32_t end, int32_t width, bool curved)
{
    const struct smear_plane_rows *const w = &target->window_rows;
    struct span_side side[SPAN_ROWS];
    struct texel_spans spans;
    struct texel_rows t;
    for (int32_t n; y < end; y += n) {
        const int32_t ring_row = w->ring_row + (y - target->y0), turned = ring_row >= w->ring ? ring_row - w->ring : ring_row;
        n = min_i32(min_i32(end - y, SPAN_ROWS), w->ring - turned);
        carried_go(c, y, curved);
        texel_rows_start(&t, target, m, turned * w->stride - w->x0);
        smear_row_sides_carried_avx2(side, &c->sides, n, width);
        if (curved) {
            const struct texel_sides sides = { side, n, c->z, c->dz, c->dz_down };
            smear_texel_columns_avx2(&t, &sides, &c->at.curves);
        } else {
            spans_of_sides(&spans, side, n, target, c->z, c->dz, c->dz_down);
            smear_texel_rows_places_avx2(&t, &spans, &c->at.planes);
        }
    }
}

void smear_lane_curves_on(struct texel_carried *c, const struct smear_raster_target *target, const struct smear_sampler *m, int32_t y,
                          int32_t end, int32_t width)
{
    carried_draw(c, target, m, y, end, width, true);
}

void smear_lane_places_on(struct texel_carried *c, const struct smear_raster_target *target, const struct smear_sampler *m, int32_t y,
                          int32_t end, int32_t width)
{
    carried_draw(c, target, m, y, end, width, false);
}
#endif
