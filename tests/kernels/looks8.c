/* SPDX-License-Identifier: MIT */
/* looks8.c - how check_kernels calls raster/looks8.h: eights of random triangles of segments of all kinds, and one after the other
 * by raster/setup.h, which is what defines the result. Each call makes many from one number. */
#include "raster/looks8.h"

#include "raster/cover.h"
#include "tests/kernels/eights.h"
#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { EIGHTS = 40, SEED = 0, COLOR = 3, UV = 5 };

/* An eight, and what its triangles have in common. */
struct scene {
    struct smear_raster_frame frame;
    struct smear_raster_draw draw;
    struct smear_segment segment;
    struct poses poses;
};

static void make_texture(struct scene *s, uint32_t *seed)
{
    const bool powers = (eight_next(seed) & 3u) != 0;
    const smear_texture texture = {
        .width = (uint16_t)(powers ? 1 << eight_between(seed, 0, 12) : eight_between(seed, 1, 4096)),
        .height = (uint16_t)(powers ? 1 << eight_between(seed, 0, 12) : eight_between(seed, 1, 4096)),
        .format = SMEAR_TEXEL_8888, .wrap_u = powers ? SMEAR_REPEAT : SMEAR_CLAMP, .wrap_v = SMEAR_REPEAT
    };
    s->segment.uv = UV;
    smear_sampler_make(&s->draw.sampler, &texture, eight_between(seed, 1, 15), (eight_next(seed) & 7u) == 0, s->frame.linear);
}

/* Colours and coordinates near each other or anywhere, of some all the same. */
static void make_vertices(struct poses *p, uint32_t *seed)
{
    for (int k = 0; k < 8; k++) {
        const uint32_t reach = (1u << eight_between(seed, 0, 16)) - 1u, kind = eight_next(seed) & 3u;
        const int32_t step = 1 << eight_between(seed, 0, 15), middle = eight_between(seed, -32768, 32767);
        for (int i = 0; i < 3; i++) {
            int32_t *const r = p->record[k][i];
            for (int word = COLOR; word < UV; word++) {
                const uint32_t low = eight_next(seed) & reach, high = eight_next(seed) & reach;
                r[word] = kind == 0 && i > 0 ? p->record[k][0][word] : (int32_t)(low | high << 16);
            }
            const int32_t u = clamp_i32(middle + eight_between(seed, -step, step), -32768, 32767);
            const int32_t v = clamp_i32(eight_between(seed, -step, step), -32768, 32767);
            r[UV] = (int32_t)(((uint32_t)u & 0xffffu) | (uint32_t)v << 16);
        }
    }
    eight_take(p);
}

static void make(struct scene *s, uint32_t *seed)
{
    *s = (struct scene){ .frame = { .width = 320, .height = 240, .draw = &s->draw } };
    s->frame.linear = (eight_next(seed) & 1u) != 0;
    s->draw.alpha = (uint8_t)((eight_next(seed) & 3u) == 0 ? SMEAR_CUTOUT : SMEAR_OPAQUE);
    s->segment.flat_depth = (eight_next(seed) & 7u) == 0;
    s->segment.color = COLOR;
    s->segment.shade = (eight_next(seed) & 3u) != 0 ? SHADE_GOURAUD : SHADE_FLAT;
    if ((eight_next(seed) & 3u) != 0)
        make_texture(s, seed);
    eight_make(&s->poses, seed);
    make_vertices(&s->poses, seed);
}

/* Whether textured triangle k is so small that it is drawn otherwise. */
static bool is_small(const struct scene *s, int k)
{
    const int32_t (*const b)[8] = s->poses.bounds;
    const int32_t width = ((b[2][k] + 127) >> 8) - ((b[0][k] + 127) >> 8), height = ((b[3][k] + 127) >> 8) - ((b[1][k] + 127) >> 8);
    return segment_textured(&s->segment) && max_i32(width, height) <= SMALL_TEXTURED_PX;
}

static void setup_start(struct setup *s, const struct scene *scene, int k)
{
    const int32_t (*const b)[8] = scene->poses.bounds;
    *s = (struct setup){ .frame = &scene->frame, .segment = &scene->segment, .draw = &scene->draw, .color = 0x123456 };
    for (int i = 0; i < 3; i++)
        s->v[i] = scene->poses.record[k][i];
    s->bounds = (struct bounds){ b[0][k], b[1][k], b[2][k], b[3][k] };
}

/* ------------------------------------------------------------------ the sum */

static uint32_t add(uint32_t sum, uint32_t a) { return (sum ^ a) * 0x01000193u; }

static uint32_t add_plane(uint32_t sum, const struct plane *p)
{
    return add(add(add(sum, (uint32_t)p->at), (uint32_t)p->dx), (uint32_t)p->dy);
}

static uint32_t add_texture(uint32_t sum, const struct texture_setup *t)
{
    sum = add(add(add(sum, t->mode), t->turns), t->block);
    if (t->mode == TEXTURE_CURVED) {
        sum = add(add(sum, (uint32_t)t->x0), (uint32_t)t->y0);
        for (int i = 0; i < 2; i++) {
            const struct curve *const c = &t->curve[i];
            sum = add(add(add(sum, (uint32_t)c->at), (uint32_t)c->dx), (uint32_t)c->dy);
            sum = add(add(add(sum, (uint32_t)c->dxx), (uint32_t)c->dxy), (uint32_t)c->dyy);
        }
        return sum;
    }
    sum = add(add(add(sum, t->parabolic), t->up), (uint32_t)t->shift);
    sum = add_plane(add_plane(add_plane(sum, &t->q), &t->uv[0]), &t->uv[1]);
    return t->mode == TEXTURE_DIVIDED ? add(sum, (uint32_t)t->slope) : sum;
}

static uint32_t add_setup(uint32_t sum, const struct setup *s)
{
    sum = add(add(sum, s->flat), s->color);
    if (s->flat)
        return sum;
    sum = add(add(add(sum, s->even_color), s->perspective_color), s->color_block);
    for (int c = 0; c < 4; c++)
        sum = add_plane(sum, &s->channel[c]);
    return segment_textured(s->segment) ? add_texture(sum, &s->texture) : sum;
}

/* ------------------------------------------------------------------ both */

static uint32_t sum_one_by_one(uint32_t sum, const struct scene *scene, uint32_t wanted)
{
    struct setup s;
    for (int k = 0; k < 8; k++) {
        if ((wanted >> k & 1u) == 0)
            continue;
        setup_start(&s, scene, k);
        smear_setup(&s, setup_edges(&s));
        sum = add_setup(sum, &s);
    }
    return sum;
}

static uint32_t sum_by_eight(uint32_t sum, const struct scene *scene, uint32_t wanted)
{
    struct setup s;
    struct planes8 planes;
    struct looks8 looks;
    smear_planes8_avx2(&planes, &scene->poses, SLOPE_BREAK);
    smear_looks8_avx2(&looks, &scene->frame, &scene->segment, &scene->poses, &planes, wanted);
    for (int k = 0; k < 8; k++) {
        if ((wanted >> k & 1u) == 0)
            continue;
        setup_start(&s, scene, k);
        smear_looks8_take(&s, &looks, k);
        sum = add_setup(sum, &s);
    }
    return sum;
}

static void many(struct kernel_call *c, uint32_t (*find)(uint32_t sum, const struct scene *, uint32_t wanted))
{
    struct scene scene;
    uint32_t seed = c->word[SEED], sum = 0;
    for (int i = 0; i < EIGHTS; i++) {
        uint32_t wanted = 0;
        make(&scene, &seed);
        for (int k = 0; k < 8; k++)
            wanted |= (uint32_t)!is_small(&scene, k) << k;
        wanted &= scene.poses.seen;
        if (wanted != 0)
            sum = find(sum, &scene, wanted);
    }
    c->word[1] = sum;
}

static void reference(struct kernel_call *c) { many(c, sum_one_by_one); }
static void by_eights(struct kernel_call *c) { many(c, smear_has_avx2() ? sum_by_eight : sum_one_by_one); }
#endif

extern const struct kernel kernels_looks8[];
const struct kernel kernels_looks8[] = {
#if SMEAR_AVX2
    /* Each length is another call, whose data are other triangles. */
    { .name = "looks8 (made, found, summed up)", .least = 8 * EIGHTS - 60, .most = 8 * EIGHTS, .size = { 1 }, .timed = 8 * EIGHTS,
      .form = { { "one by one", reference }, { "eights", by_eights } } },
#endif
    { .name = NULL }
};
