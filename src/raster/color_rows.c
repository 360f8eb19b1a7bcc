/* SPDX-License-Identifier: MIT */
/* color_rows.c - colours between vertices: interpolated, opaque, without a texture. The same pixels as those of
 * span.c, whose blocks begin and end here, too; where two meet, colours are found once. */
#include "raster/fog.h"
#include "raster/span.h"

#include "kernels/flat_run.h"
#include "kernels/shade_run.h"
#include "raster/texcoord.h"

#if SMEAR_WITH_GOURAUD || SMEAR_WITH_FOG

static SMEAR_NOINLINE void shade_codes(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                       const struct shade *k)
{
    shade_run(pixels, depth, n, z, dz, k, false, false);
}

static SMEAR_NOINLINE void shade_other(const struct setup *s, void *pixels, uint16_t *depth, int32_t n, uint32_t z,
                                       uint32_t dz, const struct shade *k)
{
    if (!target_is_direct(s->target))
        shade_run(pixels, depth, n, z, dz, k, true, false);
    else if (frame_is_linear(s->frame))
        shade_run(pixels, depth, n, z, dz, k, true, true);
    else
        shade_run(pixels, depth, n, z, dz, k, false, true);
}

/* n pixels from index `at` on, of a colour as the target has it. */
static void draw_flat(const struct setup *s, uint32_t z, uint32_t dz, int32_t at, int32_t n, uint32_t color)
{
    const struct smear_raster_target *t = s->target;
    if (target_is_direct(t))
        flat_run(t->direct + at, t->depth + at, n, z, dz, color, true);
    else
        flat_run(t->color + at, t->depth + at, n, z, dz, color, false);
}

/* Pixels [a, b) of a row whose column 0 is at index `at`. */
SMEAR_INLINE void draw(const struct setup *s, const struct row_run *p, int32_t at, int32_t a, int32_t b,
                       const struct shade *k)
{
    const struct smear_raster_target *t = s->target;
    const uint32_t z = p->z + p->dz * (uint32_t)a;
    if (SMEAR_WITH_FOG && fog_of(s) != FOG_NONE && (k->d[0] | k->d[1] | k->d[2]) == 0) {
        draw_flat(s, z, p->dz, at + a, b - a,
                  shade_pixel(k->c[0], k->c[1], k->c[2], frame_is_linear(s->frame), target_is_direct(t)));
        return;
    }
    if (!target_is_direct(t) && !frame_is_linear(s->frame))
        shade_codes(t->color + (at + a), t->depth + (at + a), b - a, z, p->dz, k);
    else
        shade_other(s, target_is_direct(t) ? (void *)(t->direct + (at + a)) : t->color + (at + a), t->depth + (at + a),
                    b - a, z, p->dz, k);
}

/* Colours in fog, or those whose planes are value / w, at pixel (x, y). */
static void colors_at(int32_t out[3], const struct setup *s, int32_t x, int32_t y)
{
    if (SMEAR_WITH_FOG && fog_of(s) != FOG_NONE) {
        smear_fog_channels(out, s, x, y);
        return;
    }
    const uint32_t q = (uint32_t)max_i32(plane_at(&s->depth, x, y), 1);
    const int zeros = count_leading_zeros(q);
    const int32_t recip = (int32_t)recip_norm(q << zeros);
    for (int i = 0; i < 3; i++)
        out[i] = channel_over_w(plane_at(&s->channel[i], x, y), zeros, recip);
}

/* Begins a block of n pixels so many pixels on, and makes `from` what the next one begins with. `fog`: the steps in fog, or null. */
SMEAR_INLINE void block_begin(struct shade *k, int32_t from[3], const int32_t to[3], int32_t n, int32_t on, const int32_t *fog)
{
    for (int i = 0; i < 3; i++) {
        const int32_t end = to[i], at = from[i], step = fog != NULL ? fog[i] : part_of(end - at, n);
        from[i] = end;
        k->c[i] = (uint32_t)(at + step * on);
        k->d[i] = (uint32_t)step;
    }
}

/* Pixels [p->a, p->b) of a row of blocks from `left` to `right`. */
static SMEAR_RARE void draw_blocks(const struct setup *s, const struct row_run *p, int32_t at, int32_t y,
                                   int32_t left, int32_t right)
{
    const int32_t last = right - 1;
    int32_t x = block_start(left, last, p->a, s->color_block), from[3], to[3] = { 0, 0, 0 };
    colors_at(from, s, x, y);
    for (;;) {
        const int32_t n = block_next(s->color_block, last - x), end = x + n + (x + n == last);
        const int32_t a = max_i32(x, p->a);
        struct shade k;
        if (n > 0)
            colors_at(to, s, x + n, y);
        if (!SMEAR_WITH_FOG || fog_of(s) == FOG_NONE) {
            block_begin(&k, from, to, n, a - x, NULL);
        } else {
            int32_t step[3] = { 0, 0, 0 };      /* there may be none */
            if (n > 0)
                smear_fog_steps(step, from, to, n, s->frame);
            block_begin(&k, from, to, n, a - x, step);
        }
        if (end > a)            /* what is left of a long block is in parts */
            draw(s, p, at, a, min_i32(end, p->b), &k);
        if (end >= p->b)
            return;
        x += n;
    }
}

/* Pixels [p->a, p->b). */
static void draw_run(const struct setup *s, const struct row_run *p, int32_t at, int32_t y, const struct span_side *side)
{
    struct shade k;
    if (s->perspective_color || fog_of(s) != FOG_NONE) {
        if (SMEAR_WITH_FOG && fog_row_is_even(s, side->left, side->right))
            draw_flat(s, p->z + p->dz * (uint32_t)p->a, p->dz, at + p->a, p->b - p->a,
                      target_pixel(s->target, smear_fog_row_color(s, side->left, side->right, y)));
        else
            draw_blocks(s, p, at, y, side->left, side->right);
        return;
    }
    for (int i = 0; i < 3; i++) {
        k.c[i] = (uint32_t)plane_at(&s->channel[i], p->a, y);
        k.d[i] = (uint32_t)s->channel[i].dx;
    }
    draw(s, p, at, p->a, p->b, &k);
}

void smear_rows_shade(const struct setup *s, const struct span_rows *r)
{
    const bool whole = rows_are_whole(s, r);
    int32_t at = r->at;
    for (int32_t row = 0; row < r->count; row++, at += s->target->window_rows.stride) {
        const struct span_side *side = &r->side[row];
        const int32_t y = r->y + row;
        struct row_run p = { side->left, side->right, side->left, 0, 0 };
        if (p.a >= p.b)
            continue;
        if (whole) {
            p.z = code_from_units(plane_at(&s->depth, 0, y), r->slope);
            p.dz = (uint32_t)step_from_units(s->depth.dx, r->slope);
            if (smear_row_run_seen(&p, s->target->depth + at))      /* rows that are hidden need no colours */
                draw_run(s, &p, at, y, side);
            continue;
        }
        while (row_run_next(&p, s, r, row))
            draw_run(s, &p, at, y, side);
    }
}
#endif
