/* SPDX-License-Identifier: MIT */
/* shaded_rows.c - texels in a light that changes along the row: opaque, nearest, sizes powers of two, repeated, coordinates
 * that are polynomials. The same pixels as those of span.c. */
#include "raster/span.h"

#include "kernels/texel_run.h"

/* Light of the next pixel, red, green and blue in q16 codes (or linear light >> 8), and its steps. Where it has no colour,
 * blue stands for all. */
struct shaded_light {
    uint32_t c[3], d[3];
};

/* Texels of a draw, and what they become. */
struct shaded_texels {
    const void *texels;
    const uint32_t *palette;
    int format, log2_width, log2_height;
    bool narrow;
};

/* Draws n > 0 pixels of a run, where they are nearer, in a light that changes from pixel to pixel: white where blue stands for all. */
SMEAR_INLINE void texels_shade(const struct shaded_texels *k, struct texel_run *run, const struct shaded_light *l, int32_t n, bool white,
                               bool linear)
{
    struct texel_run r = *run;
    uint32_t red = l->c[0], green = l->c[1], blue = l->c[2];
    const uint32_t red_step = l->d[0], green_step = l->d[1], blue_step = l->d[2];
    const int log2_width = k->log2_width, log2_height = k->log2_height, format = k->format;
    const bool narrow = k->narrow;
    for (; n > 0; n--) {
        const uint32_t code = r.z >> 16;
        if (code > *r.depth) {
            SMEAR_KEEP_BRANCH();
            const uint32_t t = texel_fetch(k->texels, k->palette, packed_index(texel_run_uv(&r), log2_width, log2_height),
                                           format);
            const uint32_t p = shaded_pixel(t, red, green, blue, white, linear);
            *r.depth = (uint16_t)code;
            if (narrow)
                *(uint16_t *)r.color = (uint16_t)rgb565_nearest(p);
            else
                *(uint32_t *)r.color = p;
        }
        texel_run_advance(&r, 1, narrow);
        texel_run_step(&r);
        r.z += r.dz;
        blue += blue_step;
        if (!white) {
            red += red_step;
            green += green_step;
        }
    }
}

static bool is_white(const struct setup *s)
{
    const struct plane *r = &s->channel[0], *g = &s->channel[1], *b = &s->channel[2];
    return r->at == g->at && r->dx == g->dx && r->dy == g->dy && r->at == b->at && r->dx == b->dx && r->dy == b->dy;
}

/* Pixels [p->a, p->b) of row y, whose column 0 is at index `at`. */
SMEAR_INLINE void shaded_row(const struct setup *s, const struct shaded_texels *k, const struct curves *curves, struct texel_run run,
                             const struct row_run *p, int32_t at, int32_t y, bool white, bool linear)
{
    const struct smear_raster_target *t = s->target;
    struct shaded_light l;
    curves_run(curves, p->a - s->texture.x0, y - s->texture.y0, &run);
    run.depth = t->depth + (at + p->a);
    run.color = k->narrow ? (void *)(t->direct + (at + p->a)) : t->color + (at + p->a);
    run.z = p->z + p->dz * (uint32_t)p->a;
    run.dz = p->dz;
    for (int i = white ? 2 : 0; i < 3; i++) {
        l.c[i] = (uint32_t)plane_at(&s->channel[i], p->a, y);
        l.d[i] = (uint32_t)s->channel[i].dx;
    }
    texels_shade(k, &run, &l, p->b - p->a, white, linear);
}

SMEAR_INLINE void shaded_rows(const struct setup *s, const struct span_rows *r, bool white, bool linear)
{
    const struct smear_sampler *m = &s->draw->sampler;
    const struct shaded_texels k = { m->texels, m->palette, m->format, m->log2_width, m->log2_height,
                                     target_is_direct(s->target) };
    const bool whole = rows_are_whole(s, r);
    int32_t at = r->at;
    struct curves curves;
    struct texel_run run;
    struct row_run p = { .dz = (uint32_t)step_from_units(s->depth.dx, r->slope) };
    curves_start(&curves, &s->texture.curve[0], &s->texture.curve[1], &run);
    for (int32_t row = 0; row < r->count; row++, at += s->target->window_rows.stride)
        for (bool any = row_run_first(&p, s, r, row, whole); any; any = !whole && row_run_next(&p, s, r, row))
            shaded_row(s, &k, &curves, run, &p, at, r->y + row, white, linear);
}

static SMEAR_NOINLINE void rows_white(const struct setup *s, const struct span_rows *r)
{
    shaded_rows(s, r, true, false);
}

static SMEAR_NOINLINE void rows_colored(const struct setup *s, const struct span_rows *r)
{
    shaded_rows(s, r, false, false);
}

static SMEAR_NOINLINE void rows_white_linear(const struct setup *s, const struct span_rows *r)
{
    shaded_rows(s, r, true, true);
}

static SMEAR_NOINLINE void rows_colored_linear(const struct setup *s, const struct span_rows *r)
{
    shaded_rows(s, r, false, true);
}

smear_rows_fn *smear_shaded_rows_choose(const struct setup *s)
{
    if (s->texture.mode != TEXTURE_CURVED || s->perspective_color)
        return NULL;
    if (frame_is_linear(s->frame))
        return is_white(s) ? rows_white_linear : rows_colored_linear;
    return is_white(s) ? rows_white : rows_colored;
}
