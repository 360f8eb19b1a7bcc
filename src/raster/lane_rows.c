/* SPDX-License-Identifier: MIT */
/* lane_rows.c - texels in rows of a triangle, copied or lit, by vectors of eight and sixteen pixels. */
#include "raster/texture_rows.h"

#include "kernels/texel_rows.h"

#if SMEAR_LANE_ROWS

static void texel_rows_start(struct texel_rows *t, const struct setup *s, const struct span_rows *r)
{
    const struct smear_raster_target *target = s->target;
    const struct smear_sampler *m = &s->draw->sampler;
    t->texels = m->texels;
    t->lights = NULL;
    t->log2_width = m->log2_width;
    t->log2_height = m->log2_height;
    t->narrow = target_is_direct(target);
    t->color = t->narrow ? (void *)(target->direct + r->at) : target->color + r->at;
    t->depth = target->depth + r->at;
    t->stride = target->window_rows.stride;
    t->x0 = target->x0;
    t->x1 = target->x1;
}

static struct texel_plane plane_from(const struct plane *p, int32_t y)
{
    return (struct texel_plane){ plane_at(p, 0, y), p->dx, p->dy };
}

/* A light that is the same throughout the triangle: codes, or linear light. */
static void even_lights(struct texel_lights *l, uint32_t color)
{
    for (int i = 0; i < 3; i++) {
        const uint32_t code = color >> (16 - 8 * i) & 255u;
        l->c[i] = (struct texel_plane){ (int32_t)(l->linear ? (uint32_t)smear_srgb_decode[code] << 8 : code << 16), 0, 0 };
    }
    l->plain = (color & 0xffffffu) == 0xffffffu;
}

/* As struct texel_light has it, and as span.c lights texels. */
static void lights_start(struct texel_lights *l, const struct setup *s, int32_t y)
{
    const struct smear_sampler *m = &s->draw->sampler;
    l->palette = m->palette;
    l->format = m->format;
    l->linear = frame_is_linear(s->frame);
    if (!segment_gouraud(s->segment)) {
        even_lights(l, s->segment->shade == SHADE_FLAT ? s->color : 0xffffffu);
        return;
    }
    l->plain = false;
    for (int i = 0; i < 3; i++)
        l->c[i] = s->even_color ? (struct texel_plane){ s->channel[i].at, 0, 0 } : plane_from(&s->channel[i], y);
}

typedef void draw_spans(const struct texel_rows *t, const struct texel_spans *spans, const void *coordinates);

/* All rows where they are whole. */
SMEAR_INLINE void whole_spans(struct texel_spans *spans, const struct setup *s, const struct span_rows *r)
{
    const uint32_t down = (uint32_t)step_from_units(s->depth.dy, s->slope), dz = (uint32_t)step_from_units(s->depth.dx, s->slope);
    uint32_t z = code_from_units(plane_at(&s->depth, 0, r->y), s->slope);
    const int32_t rows = r->count;
    int32_t i = 0;
    for (int32_t row = 0; row < rows; row++, z += down) {
        const int32_t left = r->side[row].left, right = r->side[row].right;
        spans->row[i] = row;
        spans->left[i] = spans->a[i] = left;
        spans->right[i] = spans->b[i] = right;
        spans->z[i] = z;
        spans->dz[i] = dz;
        i += left < right;
    }
    spans->count = i;
}

/* Draws all rows, in one go as a rule. */
SMEAR_INLINE void draw_rows(const struct setup *s, const struct span_rows *r, const void *coordinates, draw_spans *draw, bool lit)
{
    struct texel_rows t;
    struct texel_spans spans;
    struct texel_lights lights;
    struct row_run p;
    texel_rows_start(&t, s, r);
    if (lit) {
        lights_start(&lights, s, r->y);
        t.lights = &lights;
    }
    if (rows_are_whole(s, r)) {
        whole_spans(&spans, s, r);
        draw(&t, &spans, coordinates);
        return;
    }
    spans.count = 0;
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t left = r->side[row].left, right = r->side[row].right;
        if (left >= right)
            continue;
        for (p.b = left; smear_row_run_next(&p, s, r, row, p.b);) {
            if (spans.count == TEXEL_SPANS) {
                draw(&t, &spans, coordinates);
                spans.count = 0;
            }
            const int32_t i = spans.count++;
            spans.row[i] = row;
            spans.left[i] = left;
            spans.right[i] = right;
            spans.a[i] = p.a;
            spans.b[i] = p.b;
            spans.z[i] = p.z;
            spans.dz[i] = p.dz;
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

SMEAR_INLINE void places_draw(const struct setup *s, const struct span_rows *r, bool lit)
{
    const struct texture_setup *t = &s->texture;
    const struct texel_planes p = { plane_from(&t->q, r->y), plane_from(&t->uv[0], r->y), plane_from(&t->uv[1], r->y),
                                    t->slope, t->block, t->up, t->mode == TEXTURE_DIVIDED, t->parabolic };
    draw_rows(s, r, &p, draw_places, lit);
}

static struct texel_curve curve_from(const struct curve *c)
{
    return (struct texel_curve){ (uint32_t)c->at, (uint32_t)c->dx, (uint32_t)c->dy,
                                 (uint32_t)c->dxx, (uint32_t)c->dxy, (uint32_t)c->dyy };
}

/* Draws whole rows by columns. */
SMEAR_INLINE void draw_columns(const struct setup *s, const struct span_rows *r, const struct texel_curves *p, bool lit)
{
    const struct texel_sides sides = {
        r->side, r->count, code_from_units(plane_at(&s->depth, 0, r->y), s->slope),
        (uint32_t)step_from_units(s->depth.dx, s->slope), (uint32_t)step_from_units(s->depth.dy, s->slope)
    };
    struct texel_rows t;
    struct texel_lights lights;
    texel_rows_start(&t, s, r);
    if (lit) {
        lights_start(&lights, s, r->y);
        t.lights = &lights;
    }
    smear_texel_columns_avx2(&t, &sides, p);
}

SMEAR_INLINE void curves_draw(const struct setup *s, const struct span_rows *r, bool lit)
{
    const struct texture_setup *t = &s->texture;
    const struct texel_curves p = { t->x0, t->y0 - r->y, curve_from(&t->curve[0]), curve_from(&t->curve[1]) };
    if (rows_are_whole(s, r))
        draw_columns(s, r, &p, lit);
    else
        draw_rows(s, r, &p, draw_curves, lit);
}

static void lane_places(const struct setup *s, const struct span_rows *r) { places_draw(s, r, false); }
static void lane_curves(const struct setup *s, const struct span_rows *r) { curves_draw(s, r, false); }
static void lane_places_lit(const struct setup *s, const struct span_rows *r) { places_draw(s, r, true); }
static void lane_curves_lit(const struct setup *s, const struct span_rows *r) { curves_draw(s, r, true); }

smear_rows_fn *smear_lane_rows_choose(const struct setup *s, bool lit)
{
    if (fog_of(s) != FOG_NONE || s->target->x1 - s->target->x0 < TEXEL_ROWS_LEAST || !smear_has_avx2()
        || (lit && segment_gouraud(s->segment) && s->perspective_color && !s->even_color))
        return NULL;
    if (s->texture.mode == TEXTURE_CURVED)
        return lit ? lane_curves_lit : lane_curves;
    return lit ? lane_places_lit : lane_places;
}
#endif
