/* SPDX-License-Identifier: MIT */
/* texture_rows.c - texels: nearest, opaque, sizes powers of two, repeated. Unlit ones in the target's own pixels are
 * copied; others become pixels where they change, in a light that is the same for the whole triangle. Rows of
 * a triangle are drawn together, a block of pixels after the other. */
#include "raster/span.h"

#include "kernels/texel_blocks_armv7em.h"
#include "kernels/texel_curve_rows.h"
#include "kernels/texels_draw.h"
#include "raster/fog.h"
#include "raster/texcoord.h"

/* On Cortex-M0+ a pointer of its own: members lie too far from the setup's start for its loads. */
static inline const struct texture_setup *texture_of(const struct setup *s)
{
    const struct texture_setup *t = &s->texture;
    if (SMEAR_ON_ARMV6M)
        SMEAR_KEEP_VALUE(t);
    return t;
}

/* Goes on by n pixels, at most a block, where no places are divided. */
SMEAR_INLINE void track_go(struct texel_track *k, const struct texture_setup *t, int32_t n)
{
    const struct place from = k->place;
    k->u = add_wrap(k->u, mul_wrap(t->uv[0].dx, n));
    k->v = add_wrap(k->v, mul_wrap(t->uv[1].dx, n));
    k->place = (struct place){ k->u, k->v, 0 };
    texcoord_run(&k->run, texcoord_between(t, from, k->place, n, true));
}

/* Finds the coordinates of the next n pixels. */
TRACK_FUNCTION void track_next(struct texel_track *k, const struct texture_setup *t, int32_t n)
{
    if (t->mode == TEXTURE_DIVIDED)
        texel_track_part(k, n);
    else
        track_go(k, t, n);
}

/* A whole block where places are quotients, and n of its pixels. */
TRACK_BLOCK void track_block(struct texel_track *k) { texel_track_next(k); }
TRACK_BLOCK void track_part(struct texel_track *k, int32_t n) { texel_track_part(k, n); }

/* What a triangle's tracks have in common. */
SMEAR_INLINE void track_prepare(struct texel_track *k, const struct texture_setup *t)
{
    texel_track_length(k, 31 - count_leading_zeros(t->block));
    k->dq = shl_wrap(t->q.dx, k->log2);
    k->du = shl_wrap(t->uv[0].dx, k->log2);
    k->dv = shl_wrap(t->uv[1].dx, k->log2);
    k->qx = t->q.dx;
    k->ux = t->uv[0].dx;
    k->vx = t->uv[1].dx;
    k->up = t->up;
    k->slope = t->slope;
    k->seed = smear_recip_seed;
    k->parabolic = t->parabolic;
    texcoord_run(&k->run, (struct texcoord){ 0, 0, 0, 0, 0, 0 });
}

/* At pixel (x, y). */
TRACK_FUNCTION void track_start(struct texel_track *k, const struct texture_setup *t, int32_t x, int32_t y)
{
    k->q = plane_at(&t->q, x, y);
    k->u = plane_at(&t->uv[0], x, y);
    k->v = plane_at(&t->uv[1], x, y);
    k->place = place_at(t, t->mode, NULL, k->q, k->u, k->v, true);
}

/* ------------------------------------------------------------------ runs */

/* A channel of the triangle's light. */
static inline uint32_t channel_of(const struct setup *s, int i)
{
    return segment_gouraud(s->segment) ? (uint32_t)s->channel[i].at
                                       : channel_of_code(s->color >> (16 - 8 * i) & 255u, frame_transfer(s->frame));
}

/* The light is even: see smear_rows_choose. */
static SMEAR_NOINLINE void light_start(struct texel_light *l, const struct setup *s)
{
    const struct smear_sampler *m = &s->draw->sampler;
    texel_light_start(l, m->texels, m->palette, m->format, m->log2_width, m->log2_height,
                      target_is_direct(s->target), frame_transfer(s->frame));
    if (segment_gouraud(s->segment) || s->segment->shade == SHADE_FLAT) {
        l->red = texel_light_of(l, channel_of(s, 0));
        l->green = texel_light_of(l, channel_of(s, 1));
        l->blue = texel_light_of(l, channel_of(s, 2));
    }
    if (SMEAR_WITH_FOG && fog_of(s) != FOG_NONE) {
        l->fog = frame_fog(s->frame)->color;
        if (fog_is_even(s))
            texel_light_fog(l, fog_even_part(s));
    }
}

/* The light of n pixels that begin at x, or of a row, in fog that varies. */
static SMEAR_NOINLINE void light_in_fog(struct texel_light *l, const struct setup *s, const struct span_side *side, int32_t x,
                                        int32_t n, int32_t y)
{
    texel_light_fog(l, smear_fog_run_part(s, side->left, side->right, x, n, y));
}

/* Of polynomials, how many of a row's last `rest` pixels have one part of fog; brings their light. They are a block of span.c. */
static SMEAR_NOINLINE int32_t part_in_fog(struct texel_light *l, const struct setup *s, const struct span_side *side, int32_t rest,
                                          int32_t y)
{
    const int32_t n = block_next(s->texture.block, rest - 1);
    light_in_fog(l, s, side, side->right - rest, n, y);
    return fog_is_by_rows(s) ? rest : n + (n == rest - 1);
}

SMEAR_INLINE bool light_is_in_fog(const struct texel_light *l, const struct setup *s)
{
    return SMEAR_WITH_FOG && l != NULL && fog_varies(s);
}

/* Whether there are no rows for a triangle's fog. */
static bool fog_has_no_rows(const struct setup *s)
{
    return fog_varies(s) && !fog_is_by_rows(s) && s->texture.block == 1;
}

/* ------------------------------------------------------------------ runs of a row */

/* Depths are linear: what hides the nearer one of both ends hides all. */
bool smear_row_run_seen(struct row_run *p, const uint16_t *depth)
{
    const uint16_t *a = depth + p->a, *b = depth + p->b;
    uint32_t first = p->z + p->dz * (uint32_t)p->a, last = p->z + p->dz * (uint32_t)(p->b - 1);
    const uint32_t nearest = max_u32(first, last) >> 16;
    if (first >> 16 > a[0] && last >> 16 > b[-1])
        return true;
    while (b - a >= 4 && a[0] >= nearest && a[1] >= nearest && a[2] >= nearest && a[3] >= nearest)
        a += 4;
    first += p->dz * (uint32_t)(a - depth - p->a);
    for (; a != b && first >> 16 <= *a; a++)
        first += p->dz;
    p->a = (int32_t)(a - depth);
    while (b - a >= 4 && b[-1] >= nearest && b[-2] >= nearest && b[-3] >= nearest && b[-4] >= nearest)
        b -= 4;
    last -= p->dz * (uint32_t)(p->b - (b - depth));
    for (; a != b && last >> 16 <= b[-1]; b--)
        last -= p->dz;
    p->b = (int32_t)(b - depth);
    return a != b;
}

SMEAR_NOINLINE bool smear_row_run_next(struct row_run *p, const struct setup *s, const struct span_rows *r, int32_t row)
{
    const int32_t y = r->y + row, units = plane_at(&s->depth, 0, y), dx = s->depth.dx, at = r->at + row * s->target->window_rows.stride;
    do {
        enum depth_slope slope = r->slope;
        p->a = max_i32(p->next, s->target->x0);
        p->b = min_i32(r->side[row].right, s->target->x1);
        if (p->a >= p->b)
            return false;
        if (slope == SLOPE_BOTH) {
            int32_t here = add_wrap(units, mul_wrap(dx, p->a)), last = add_wrap(units, mul_wrap(dx, p->b - 1));
            slope = here < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
            if ((last < SLOPE_BREAK) != (here < SLOPE_BREAK))
                p->b = p->a + pixels_to_break(here, dx, p->b - p->a);
        }
        p->next = p->b;
        p->z = code_from_units(units, slope);
        p->dz = (uint32_t)step_from_units(dx, slope);
        if (setup_writes_velocity(s)) {
            const struct span span = { .a = p->a, .b = p->b, .right = r->side[row].edge, .y = y, .depth = s->target->depth + (at + p->a),
                                       .at = at + p->a, .z = p->z + p->dz * (uint32_t)p->a, .dz = (int32_t)p->dz };
            smear_span_velocity(s, &span);
        }
    } while (!smear_row_run_seen(p, s->target->depth + at));
    return true;
}

/* How texels become pixels where there is no loop for each way: lit where `light` is not null. */
static inline enum texel_kind texels_of(const struct setup *s, const struct texel_light *light)
{
    const bool narrow = target_is_direct(s->target);
    return light != NULL ? (narrow ? TEXELS_LIT_NARROW : TEXELS_LIT) : narrow ? TEXELS_NARROW : TEXELS_WIDE;
}

static SMEAR_NOINLINE void run_skip(struct texel_run *r, int32_t n, bool narrow)
{
    texel_run_advance(r, n, narrow);
    texel_run_skip(r, (uint32_t)n);
    r->z += r->dz * (uint32_t)n;
}

/* Pixels [first, end) of a block whose run has come to pixel i. */
static void draw_part(const struct setup *s, struct texel_run *r, int32_t i, int32_t first, int32_t end)
{
    const enum texel_kind kind = texels_of(s, r->light);
    const struct smear_sampler *m = &s->draw->sampler;
    if (i < first) {
        run_skip(r, min_i32(first, end) - i, texels_are_narrow(kind));
        i = min_i32(first, end);
    }
    for (; i < end; i++, r->z += r->dz) {
        texel_pixel(r->color, r->depth, r->z, m->texels, r->light, texel_run_uv(r), m->log2_width, m->log2_height, kind);
        texel_run_advance(r, 1, texels_are_narrow(kind));
        texel_run_step(r);
    }
}

/* Draws pixels [from, end) of a row, which are a block; some may lie outside the run `p`, which then goes
 * on to the next. False when no more are to be drawn. */
static SMEAR_NOINLINE bool draw_row_runs(const struct setup *s, const struct span_rows *r, int32_t row,
                                         struct texel_run *run, struct row_run *p, int32_t from, int32_t end)
{
    for (int32_t x = from;; x = p->a) {
        draw_part(s, run, x - from, p->a - from, min_i32(p->b, end) - from);
        if (p->b >= end)
            return true;
        if (!row_run_next(p, s, r, row))
            return false;
        run->dz = p->dz;
        run->z = p->z + p->dz * (uint32_t)p->a;
    }
}

/* ------------------------------------------------------------------ rows */

/* Numbers of rows. */
struct row_list {
    int32_t count;
    uint8_t row[SPAN_ROWS];
};

/* Rows whose blocks would be single pixels: a place for each. */
static SMEAR_NOINLINE void draw_places(const struct setup *s, const struct span_rows *r,
                                       const struct row_list *list, struct texel_light *light)
{
    const enum texture_mode mode = s->texture.mode == TEXTURE_DIVIDED ? TEXTURE_DIVIDED : TEXTURE_AFFINE;
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = texture_of(s);
    const struct smear_sampler *m = &s->draw->sampler;
    const enum texel_kind kind = texels_of(s, light);
    const bool narrow = texels_are_narrow(kind), whole = rows_are_whole(s, r);
    const int up = t->up, log2_width = m->log2_width, log2_height = m->log2_height;
    const void *const texels = m->texels;
    struct row_run p;
    p.dz = (uint32_t)step_from_units(s->depth.dx, r->slope);
    for (int32_t i = 0; i < list->count; i++) {
        const int32_t row = list->row[i], y = r->y + row, at = r->at + row * target->window_rows.stride;
        if (!row_run_first(&p, s, r, row, whole))
            continue;
        if (SMEAR_WITH_FOG && light != NULL && fog_varies(s))
            light_in_fog(light, s, &r->side[row], p.a, 0, y);
        do {
            int32_t q = plane_at(&t->q, p.a, y), u = plane_at(&t->uv[0], p.a, y),
                    v = plane_at(&t->uv[1], p.a, y);
            uint32_t z = p.z + p.dz * (uint32_t)p.a;
            uint16_t *depth = target->depth + (at + p.a), *const end = target->depth + (at + p.b);
            void *color = narrow ? (void *)(target->direct + (at + p.a)) : target->color + (at + p.a);
            for (; depth < end; depth++, color = pixel_after(color, 1, narrow)) {
                if (z >> 16 > *depth) {
                    const struct place place = place_at(t, mode, NULL, q, u, v, true);
                    *depth = (uint16_t)(z >> 16);
                    texel_put(color, 0, texels, light,
                              (uint32_t)place.v << up >> (32 - log2_height) << log2_width
                                  | (uint32_t)place.u << up >> (32 - log2_width), kind);
                }
                z += p.dz;
                q = add_wrap(q, t->q.dx);
                u = add_wrap(u, t->uv[0].dx);
                v = add_wrap(v, t->uv[1].dx);
            }
        } while (!whole && row_run_next(&p, s, r, row));
    }
}

/* A block goes on behind the end of a row's run, of which `count` pixels were drawn: `more` pixels, of which those of the next run that
 * are seen are the next `count`. False when no more of the row are to be drawn. */
static SMEAR_NOINLINE bool run_goes_on(struct texel_run *run, int32_t *count, int32_t *more, const struct setup *s,
                                       const struct span_rows *r, int32_t row, struct row_run *p)
{
    const int32_t from = p->b, end = from + *more;
    if (!row_run_next(p, s, r, row))
        return false;
    const int32_t first = min_i32(p->a, end) - from;
    texel_run_skip(run, (uint32_t)(*count + first));
    texel_run_advance(run, first, target_is_direct(s->target));
    run->dz = p->dz;
    run->z = p->z + p->dz * (uint32_t)(from + first);
    *more = max_i32(end - p->b, 0);
    *count = end - (from + first) - *more;
    return true;
}

/* Blocks of copied texels of a run, of which `rest` pixels and the last are to come: all where the row ends in it, else whole ones of
 * which no less than `least` come behind. Returns the rest. */
SMEAR_INLINE int32_t draw_run_blocks(struct texel_track *k, int32_t rest, int32_t least, bool is_last, int log2_width, int log2_height,
                                     enum texel_kind kind)
{
    const int32_t blocks = (rest - least) >> k->log2, behind = rest - (blocks << k->log2);
    if (blocks > 0 || is_last)
        texel_blocks(k, blocks, is_last ? behind : 0, log2_width, log2_height, kind);
    return is_last ? 0 : behind;
}

/* A row's run and track from pixel x on. */
SMEAR_INLINE void row_start(struct texel_track *k, const struct setup *s, const struct span_rows *r, int32_t row,
                            const struct row_run *p, int32_t x, bool narrow)
{
    const struct smear_raster_target *target = s->target;
    const int32_t at = r->at + row * target->window_rows.stride + x;
    k->run.depth = target->depth + at;
    k->run.color = narrow ? (void *)(target->direct + at) : target->color + at;
    k->run.dz = p->dz;
    k->run.z = p->z + p->dz * (uint32_t)x;
    track_start(k, texture_of(s), x, r->y + row);
}

/* Rows of one run whose places are quotients have a loop of their own; on a page size counts. */
enum { DIVIDED_ROWS = !SMEAR_ON_WASM };

/* Draws such a row from its first pixel on, where the track and its run have come to: `rest` pixels and the last. */
SMEAR_INLINE void draw_divided_row(struct texel_track *k, int32_t rest, int log2_width, int log2_height, enum texel_kind kind)
{
    const int32_t block = 1 << k->log2;
    if (TEXEL_BLOCKS && !texels_are_lit(kind) && SMEAR_IS_CONSTANT(log2_width)) {
        const int32_t blocks = (rest - 1) >> k->log2;
        texel_blocks(k, blocks, rest - (blocks << k->log2), log2_width, log2_height, kind);
        return;
    }
    if (TEXELS_LANES && !texels_are_lit(kind) && rest >= 7 && block >= 8 && texels_fit_lanes(log2_width, log2_height)) {
        texels_row_lanes(k, rest, log2_width, log2_height, kind);
        return;
    }
    for (int32_t n = block; rest > 0;) {
        if (rest > block) {
            track_block(k);
        } else {
            n = block_next(block, rest);
            track_part(k, n);
        }
        rest -= n;
        texels_draw(&k->run, n + (rest == 0), log2_width, log2_height, kind);
    }
}

/* Any row, of which the first run is known. */
SMEAR_INLINE void draw_row_blocks(struct texel_track *k, const struct setup *s, const struct span_rows *r, int32_t row,
                                  struct row_run *p, struct texel_light *light, int log2_width, int log2_height,
                                  enum texel_kind kind)
{
    const bool narrow = texels_are_narrow(kind), in_fog = light_is_in_fog(light, s);
    const struct texture_setup *t = texture_of(s);
    const bool divided = t->mode == TEXTURE_DIVIDED && !in_fog;
    const int32_t block = t->block, right = r->side[row].right;
    const int32_t x = block_start(r->side[row].left, right - 1, p->a, block);
    row_start(k, s, r, row, p, x, narrow);
    int32_t rest = right - 1 - x;                       /* behind the block, but for the last pixel */
    int32_t least = divided ? max_i32(right - 1 - p->b, 1) : INT32_MAX - BLOCK_LONGEST;
    do {
        const bool is_in_run = p->a <= right - 1 - rest;
        int32_t count = block, more = 0;
        if (TEXEL_BLOCKS && !texels_are_lit(kind) && SMEAR_IS_CONSTANT(log2_width) && is_in_run && rest >= least) {
            const int32_t before = rest;
            rest = draw_run_blocks(k, rest, least, p->b == right, log2_width, log2_height, kind);
            if (rest != before)
                continue;
        }
        if (is_in_run && rest - block >= least) {       /* as most are: whole, in the run, and not the last */
            track_block(k);
            rest -= block;
        } else {
            const int32_t n = block_next(block, rest);
            track_next(k, t, n);
            if (in_fog)
                light_in_fog(light, s, &r->side[row], right - 1 - rest, n, r->y + row);
            rest -= n;
            const int32_t last = rest == 0, end = right - 1 - rest + last;
            count = n + last;
            const int32_t first = clamp_i32(p->a - (end - count), 0, count);
            if (first != 0)
                run_skip(&k->run, first, narrow);
            more = max_i32(end - p->b, 0);
            count -= first + more;
        }
        for (;;) {
            if (count != 0)
                texels_draw(&k->run, count, log2_width, log2_height, kind);
            if (more == 0)
                break;
            if (!run_goes_on(&k->run, &count, &more, s, r, row, p))
                return;
            least = divided ? max_i32(right - 1 - p->b, 1) : least;
        }
    } while (rest > 0);
}

/* Lists the others in `quotients`. */
SMEAR_INLINE void draw_blocks(const struct setup *s, const struct span_rows *r, struct row_list *quotients,
                              struct texel_light *light, int log2_width, int log2_height, enum texel_kind kind)
{
    const struct texture_setup *t = texture_of(s);
    const int32_t shortest = t->block > 1 ? (int32_t)SHORT_SPAN : INT32_MAX;        /* block_of */
    const bool whole = rows_are_whole(s, r), divided = DIVIDED_ROWS && t->mode == TEXTURE_DIVIDED && !light_is_in_fog(light, s);
    struct texel_track k;
    struct row_run p;
    uint8_t *next_quotient = quotients->row;
    k.run.texels = s->draw->sampler.texels;
    k.run.light = light;
    texel_run_start(&k.run, log2_width, log2_height);
    track_prepare(&k, t);
    p.dz = (uint32_t)step_from_units(s->depth.dx, r->slope);
    const int32_t rows = r->count;
    for (int32_t row = 0; row < rows; row++) {
        const int32_t left = r->side[row].left, right = r->side[row].right;
        if (right - left <= shortest) {
            *next_quotient = (uint8_t)row;
            next_quotient += left < right;
            continue;
        }
        p.a = p.next = left;
        p.b = right;
        if (whole)
            p.z = code_from_units(plane_at(&s->depth, 0, r->y + row), r->slope);
        else if (!row_run_next(&p, s, r, row))
            continue;
        if (divided && p.a == left && p.b == right) {
            row_start(&k, s, r, row, &p, left, texels_are_narrow(kind));
            draw_divided_row(&k, right - 1 - left, log2_width, log2_height, kind);
        } else {
            draw_row_blocks(&k, s, r, row, &p, light, log2_width, log2_height, kind);
        }
    }
    quotients->count = (int32_t)(next_quotient - quotients->row);
}

/* ------------------------------------------------------------------ polynomials */

/* Whole rows of copied texels. */
SMEAR_INLINE void draw_whole_curves(const struct setup *s, const struct span_rows *r, int log2_width, int log2_height, enum texel_kind kind)
{
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = &s->texture;
    struct texel_curve_rows rows = {
        .side = r->side, .count = r->count, .y = r->y - t->y0, .z = code_from_units(plane_at(&s->depth, 0, r->y), r->slope),
        .depth = target->depth + r->at, .x0 = t->x0, .dz_down = (uint32_t)step_from_units(s->depth.dy, r->slope),
        .stride = 2 * target->window_rows.stride, .u = t->curve[0], .v = t->curve[1],
        .dz = (uint32_t)step_from_units(s->depth.dx, r->slope),
        .to_pixels = kind == TEXELS_NARROW ? (intptr_t)((uintptr_t)target->direct - (uintptr_t)target->depth)
                                           : (intptr_t)((uintptr_t)target->color - 2 * (uintptr_t)target->depth),
        .texels = s->draw->sampler.texels
    };
    rows.ddu = 2 * (uint32_t)rows.u.dxx;
    rows.ddv = 2 * (uint32_t)rows.v.dxx;
    texel_curve_rows_draw(&rows, log2_width, log2_height, kind);
}

/* A row in fog, in pieces of one light. p: its first run, where that is not all of it; else null. */
static SMEAR_RARE void draw_curve_in_fog(const struct setup *s, const struct span_rows *r, int32_t row, struct texel_run *run,
                                         struct row_run *p, int log2_width, int log2_height, enum texel_kind kind)
{
    const struct span_side *side = &r->side[row];
    for (int32_t rest = side->right - side->left; rest > 0;) {
        const int32_t n = part_in_fog(run->light, s, side, rest, r->y + row);
        if (p == NULL) {
            texels_draw(run, n, log2_width, log2_height, kind);
            texel_run_skip(run, (uint32_t)n);
        } else if (!draw_row_runs(s, r, row, run, p, side->right - rest, side->right - rest + n)) {
            return;
        }
        rest -= n;
    }
}

/* texcoord_curved */
SMEAR_INLINE void draw_curves(const struct setup *s, const struct span_rows *r, struct texel_light *light,
                              int log2_width, int log2_height, enum texel_kind kind)
{
    const bool narrow = texels_are_narrow(kind);
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = texture_of(s);
    const bool whole = rows_are_whole(s, r), in_fog = light_is_in_fog(light, s);
    const uint32_t dz = (uint32_t)step_from_units(s->depth.dx, r->slope), dz_down = (uint32_t)step_from_units(s->depth.dy, r->slope);
    const uintptr_t to_color = narrow ? (uintptr_t)target->direct - (uintptr_t)target->depth
                                      : (uintptr_t)target->color - 2 * (uintptr_t)target->depth;
    const int32_t x0 = t->x0, y = r->y - t->y0, stride = target->window_rows.stride;
    uint32_t z = code_from_units(plane_at(&s->depth, 0, r->y), r->slope);
    uint16_t *depth = target->depth + r->at;
    struct curves curves;
    struct texel_run run;
    run.texels = s->draw->sampler.texels;
    run.light = light;
    texel_run_start(&run, log2_width, log2_height);
    curves_start(&curves, &t->curve[0], &t->curve[1], &run);
    const int32_t rows = r->count;
    const struct span_side *side = r->side;
    for (int32_t row = 0; row < rows; row++, side++, depth += stride, z += dz_down) {
        const int32_t left = side->left, n = side->right - left;
        struct row_run p = { left, left + n, left, z, dz };
        if (n <= 0 || !(whole || row_run_next(&p, s, r, row)))
            continue;
        do {
            const int32_t from = in_fog ? left : p.a;
            curves_run(&curves, from - x0, y + row, &run);
            run.depth = depth + from;
            run.color = (void *)((narrow ? 1u : 2u) * (uintptr_t)run.depth + to_color);
            run.dz = p.dz;
            run.z = p.z + p.dz * (uint32_t)from;
            if (!in_fog)
                texels_draw(&run, p.b - p.a, log2_width, log2_height, kind);
            else
                draw_curve_in_fog(s, r, row, &run, p.a != left || p.b != left + n ? &p : NULL, log2_width, log2_height, kind);
        } while (!whole && !in_fog && row_run_next(&p, s, r, row));
    }
}

#define BLOCK_ROWS(NAME, LOG2_WIDTH, LOG2_HEIGHT, KIND) \
    static void rows_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        struct row_list list; \
        draw_blocks(s, r, &list, NULL, LOG2_WIDTH, LOG2_HEIGHT, KIND); \
        if (list.count != 0) \
            draw_places(s, r, &list, NULL); \
    }
#define ROWS(NAME, LOG2_WIDTH, LOG2_HEIGHT, KIND) \
    BLOCK_ROWS(NAME, LOG2_WIDTH, LOG2_HEIGHT, KIND) \
    static void curves_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        draw_curves(s, r, NULL, LOG2_WIDTH, LOG2_HEIGHT, KIND); \
    }
#define LIT_ROWS(NAME, KIND) \
    static void rows_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        struct row_list list; \
        struct texel_light light; \
        light_start(&light, s); \
        draw_blocks(s, r, &list, &light, ANY_WIDTH, ANY_HEIGHT, KIND); \
        if (list.count != 0) \
            draw_places(s, r, &list, &light); \
    } \
    static void curves_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        struct texel_light light; \
        light_start(&light, s); \
        draw_curves(s, r, &light, ANY_WIDTH, ANY_HEIGHT, KIND); \
    }
#define ANY_WIDTH  s->draw->sampler.log2_width
#define ANY_HEIGHT s->draw->sampler.log2_height

ROWS(wide_any, ANY_WIDTH, ANY_HEIGHT, TEXELS_WIDE)
LIT_ROWS(lit, TEXELS_LIT)
ROWS(narrow_any, ANY_WIDTH, ANY_HEIGHT, TEXELS_NARROW)
/* Of whole rows there may be a kernel; others are few then. */
#define SIZE_ROWS(NAME, ANY, LOG2_SIZE, KIND) \
    BLOCK_ROWS(NAME, LOG2_SIZE, LOG2_SIZE, KIND) \
    static void curves_##NAME(const struct setup *s, const struct span_rows *r) \
    { \
        if (!TEXEL_CURVE_ROWS) \
            draw_curves(s, r, NULL, LOG2_SIZE, LOG2_SIZE, KIND); \
        else if (rows_are_whole(s, r)) \
            draw_whole_curves(s, r, LOG2_SIZE, LOG2_SIZE, KIND); \
        else \
            ANY(s, r); \
    }
SIZE_ROWS(narrow_64, curves_narrow_any, 6, TEXELS_NARROW)
SIZE_ROWS(narrow_128, curves_narrow_any, 7, TEXELS_NARROW)
SIZE_ROWS(narrow_256, curves_narrow_any, 8, TEXELS_NARROW)
SIZE_ROWS(wide_64, curves_wide_any, 6, TEXELS_WIDE)
SIZE_ROWS(wide_128, curves_wide_any, 7, TEXELS_WIDE)
SIZE_ROWS(wide_256, curves_wide_any, 8, TEXELS_WIDE)
LIT_ROWS(lit_narrow, TEXELS_LIT_NARROW)

#define CHOOSE(KIND, T) ((T)->width != (T)->height ? KIND##_any : (T)->width == 64 ? KIND##_64 \
                         : (T)->width == 128 ? KIND##_128 : (T)->width == 256 ? KIND##_256 : KIND##_any)

#define choose_untextured(S) (draw_is_opaque((S)->draw) && !(S)->flat && setup_is_shaded(S) ? smear_rows_shade : NULL)

smear_rows_fn *smear_rows_choose(const struct setup *s)
{
    const struct smear_sampler *t = &s->draw->sampler;
    const bool narrow = target_is_direct(s->target), is_curved = s->texture.mode == TEXTURE_CURVED;
    if (!SMEAR_SPAN_ROWS)
        return NULL;
    if (s->segment->uv == 0)
        return choose_untextured(s);
    if (s->draw->alpha != SMEAR_OPAQUE || !t->turns || t->log2_width == 0
        || t->log2_height == 0 || fog_has_no_rows(s))
        return NULL;
    const bool copied = s->segment->shade == SHADE_NONE && t->format == (narrow ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888);
    if (!copied || fog_of(s) != FOG_NONE) {
        if (segment_gouraud(s->segment) && !s->even_color)
            return NULL;
        if (SMEAR_DIRECT && narrow)
            return is_curved ? curves_lit_narrow : rows_lit_narrow;
        return is_curved ? curves_lit : rows_lit;
    }
    if (SMEAR_DIRECT && narrow)
        return is_curved ? CHOOSE(curves_narrow, t) : CHOOSE(rows_narrow, t);
    return is_curved ? CHOOSE(curves_wide, t) : CHOOSE(rows_wide, t);
}
