/* SPDX-License-Identifier: MIT */
/* color_rows.c - colours between vertices: interpolated, opaque, without a texture. The same pixels as those of
 * span.c, whose blocks begin and end here, too; where two meet, colours are found once. */
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

/* Pixels [p->a, p->b) of a row of blocks from `left` to `right`. */
static SMEAR_RARE void draw_blocks(const struct setup *s, const struct row_run *p, int32_t at, int32_t y,
                                   int32_t left, int32_t right)
{
    const int32_t last = right - 1;
    int32_t x = block_start(left, last, p->a, s->color_block), from[4], to[4];
    channels_of_pixel(from, s, 3, x, y);
    for (;;) {
        const int32_t n = block_next(s->color_block, last - x), end = x + n + (x + n == last);
        const int32_t a = max_i32(x, p->a);
        struct shade k;
        if (n > 0)
            channels_of_pixel(to, s, 3, x + n, y);
        int32_t step[4] = { 0, 0, 0, 0 };
        if (n > 0)
            channel_steps(step, from, to, 3, n, s);
        for (int i = 0; i < 3; i++) {
            k.c[i] = (uint32_t)(from[i] + step[i] * (a - x));
            k.d[i] = (uint32_t)step[i];
            from[i] = to[i];
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
    struct row_run p = { .dz = (uint32_t)step_from_units(s->depth.dx, r->slope) };
    for (int32_t row = 0; row < r->count; row++, at += s->target->window_rows.stride)
        for (bool any = row_run_first(&p, s, r, row, whole); any; any = !whole && row_run_next(&p, s, r, row))
            if (!whole || smear_row_run_seen(&p, s->target->depth + at))     /* rows that are hidden need no colours */
                draw_run(s, &p, at, r->y + row, &r->side[row]);
}
#endif
