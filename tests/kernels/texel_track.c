/* SPDX-License-Identifier: MIT */
/* texel_track.c - how check_kernels calls kernels/texel_track.h: blocks one after the other, along planes of which some are like those of
 * triangles and some are anything; and texel_blocks_armv7em.h. */
#include "tests/kernels/kernels.h"
#include "tests/kernels/texels.h"

enum { Q, U, V, DQ, DU, DV, SLOPE, KIND };      /* words */

static void prepare(struct kernel_call *c)
{
    c->bytes[0] = c->n * 48;
    if (random_u32() % 4u == 0)
        return;
    const uint32_t bits = random_u32() % 16u;
    c->word[Q] = c->word[Q] >> 2 >> bits;
    c->word[U] = c->word[Q] >> 1;
    c->word[V] = 0u - c->word[Q] / 3u;
    c->word[DQ] = (uint32_t)((int32_t)c->word[DQ] >> (12 + bits));
    c->word[DU] = (uint32_t)((int32_t)c->word[DU] >> (12 + bits));
    c->word[DV] = (uint32_t)((int32_t)c->word[DV] >> (12 + bits));
    c->word[SLOPE] = c->word[DQ] << 3;
}

/* Planes whose values at (x, row) are those of the words. */
static void set_planes(const struct kernel_call *c, int32_t *plane, int32_t x, int32_t row)
{
    for (int i = 0; i < 3; i++, plane += 3) {
        plane[1] = (int32_t)c->word[DQ + i] >> 4;
        plane[2] = (int32_t)c->word[DQ + (i + 1) % 3] >> 3;
        plane[0] = (int32_t)(c->word[Q + i] - (uint32_t)plane[1] * (uint32_t)x - (uint32_t)plane[2] * (uint32_t)row);
    }
}

/* What does not change along a row. */
static void set_track(const struct kernel_call *c, struct texel_track *k)
{
    k->dq = (int32_t)c->word[DQ];
    k->du = (int32_t)c->word[DU];
    k->dv = (int32_t)c->word[DV];
    k->log2 = 2 + (int32_t)(c->word[KIND] % 5u);
    k->up = (int32_t)(c->word[KIND] >> 8 & 15u);
    k->slope = (int32_t)c->word[SLOPE];
    k->seed = smear_recip_seed;
    k->parabolic = (c->word[KIND] >> 16 & 1u) != 0;
    k->qx = k->dq >> 4;
    k->ux = k->du >> 4;
    k->vx = k->dv >> 4;
}

/* A row's start: the planes' values at (x, row), and the place there. A plane is at, dx, dy; `plane` is q, u and v. */
static inline void texel_track_start(struct texel_track *k, const int32_t *plane, int32_t x, int32_t row)
{
    int32_t value[3];
    for (int i = 0; i < 3; i++)
        value[i] = add_wrap(plane[3 * i], add_wrap(mul_wrap(plane[3 * i + 1], x), mul_wrap(plane[3 * i + 2], row)));
    k->q = value[0];
    k->u = value[1];
    k->v = value[2];
    k->place = place_divided(k->q, k->u, k->v, k->slope, k->parabolic);
}

/* Whole blocks and others, in the order of the bits of a word. */
SMEAR_INLINE void call(struct kernel_call *c, void start(struct texel_track *, const int32_t *, int32_t, int32_t),
                       void next(struct texel_track *), void part(struct texel_track *, int32_t))
{
    struct texel_track k;
    uint32_t *out = c->plane[0];
    const int32_t x = (int32_t)(c->word[KIND] >> 20), row = (int32_t)(c->word[KIND] & 511u);
    int32_t plane[9];
    set_track(c, &k);
    set_planes(c, plane, x, row);
    start(&k, plane, x, row);
    texcoord_run(&k.run, (struct texcoord){ 0, 0, 0, 0, 0, 0 });
    for (int32_t i = 0; i < c->n; i++, out += 12) {
        const uint32_t kind = c->word[KIND] >> i;
        if ((kind & 1u) != 0)
            next(&k);
        else
            part(&k, (kind & 30u) == 0 ? BLOCK_LONG : (kind & 30u) == 2 ? BLOCK_LONGEST : 1 + (int32_t)(kind >> 1 & 15u));
        const uint32_t word[12] = {
            (uint32_t)texel_run_uv(&k.run), (uint32_t)(texel_run_uv(&k.run) >> 32), (uint32_t)k.place.u, (uint32_t)k.place.v,
            (uint32_t)k.place.nearness, (uint32_t)k.q, (uint32_t)k.u, (uint32_t)k.v,
#if TEXELS_PACKED
            (uint32_t)k.run.duv, (uint32_t)(k.run.duv >> 32), (uint32_t)k.run.dduv, (uint32_t)(k.run.dduv >> 32)
#else
            k.run.du, k.run.dv, k.run.ddu, k.run.ddv
#endif
        };
        for (int j = 0; j < 12; j++)
            out[j] = word[j];
    }
}

#define CALL(FORM) \
    static void FORM(struct kernel_call *c) \
    { \
        call(c, texel_track_start, texel_track_next_##FORM, texel_track_part_##FORM); \
    }

CALL(reference)
#if SMEAR_ASM_ARMV6M
CALL(armv6m)
#endif

#if SMEAR_ASM_ARMV7EM || TEXELS_LANES
enum { LOG2_WIDTH = 4, LOG2_HEIGHT = 3, Z = KIND + 1, DZ, COLOR_END, DEPTH_END };       /* words from Z on */
#endif

#if SMEAR_ASM_ARMV7EM
static void blocks_narrow_prepare(struct kernel_call *c)
{
    prepare(c);
    c->bytes[0] = c->n * 2;
    c->bytes[2] = 2 << (LOG2_WIDTH + LOG2_HEIGHT);
}

static void blocks_wide_prepare(struct kernel_call *c)
{
    prepare(c);
    c->bytes[0] = c->n * 4;
    c->bytes[1] = c->n * 2;
    c->bytes[2] = 4 << (LOG2_WIDTH + LOG2_HEIGHT);
}

/* Blocks of n pixels, or as many whole ones as these have. */
SMEAR_INLINE void blocks(struct kernel_call *c, void draw(struct texel_track *, int32_t, int32_t, int, int, enum texel_kind),
                         enum texel_kind kind)
{
    struct texel_track k;
    set_track(c, &k);
    k.log2 = 2 + k.log2 % 5;
    k.last = (1 << k.log2) - 1;
    k.counter = 256 - (1 << k.log2);
    k.q = (int32_t)c->word[Q];
    k.u = (int32_t)c->word[U];
    k.v = (int32_t)c->word[V];
    k.place = place_divided(k.q, k.u, k.v, k.slope, k.parabolic);
    texcoord_run(&k.run, (struct texcoord){ 0, 0, 0, 0, 0, 0 });
    k.run.color = c->plane[0];
    k.run.depth = c->plane[1];
    k.run.texels = c->plane[2];
    k.run.z = c->word[Z];
    k.run.dz = c->word[DZ];
    const int32_t count = (c->n - 2) >> k.log2, rest = c->n - 1 - (count << k.log2);
    draw(&k, count, (c->word[KIND] & 3u) != 0 ? rest : 0, LOG2_WIDTH, LOG2_HEIGHT, kind);
    c->word[Q] = (uint32_t)k.q;
    c->word[U] = (uint32_t)k.place.u;
    c->word[V] = (uint32_t)k.place.v;
    c->word[DU] = (uint32_t)k.place.nearness;
    c->word[Z] = k.run.z;
    c->word[COLOR_END] = (uint32_t)((uint8_t *)k.run.color - (uint8_t *)c->plane[0]);
    c->word[DEPTH_END] = (uint32_t)((uint8_t *)k.run.depth - (uint8_t *)c->plane[1]);
}

static void narrow_reference(struct kernel_call *c) { blocks(c, texel_blocks_reference, TEXELS_NARROW); }
static void narrow_armv7em(struct kernel_call *c) { blocks(c, texel_blocks_armv7em, TEXELS_NARROW); }
static void wide_reference(struct kernel_call *c) { blocks(c, texel_blocks_reference, TEXELS_WIDE); }
static void wide_armv7em(struct kernel_call *c) { blocks(c, texel_blocks_armv7em, TEXELS_WIDE); }
#endif

#if TEXELS_LANES
static void rows_prepare(struct kernel_call *c)
{
    prepare(c);
    c->bytes[0] = c->n * 4;
    c->bytes[1] = c->n * 2;
    c->bytes[2] = 4 << (2 * LOG2_WIDTH);
}

/* What texels_row_lanes does, a part after the other. */
SMEAR_INLINE void row_reference(struct texel_track *k, int32_t rest, int log2_width, int log2_height, enum texel_kind kind)
{
    while (rest > 0) {
        const int32_t n = block_next(1 << k->log2, rest);
        texel_track_part_reference(k, n);
        rest -= n;
        texels_draw_reference(&k->run, n + (rest == 0), log2_width, log2_height, kind);
    }
}

/* A row of n pixels. */
SMEAR_INLINE void row_by(struct kernel_call *c, enum texel_kind kind, int log2_height,
                         void draw(struct texel_track *, int32_t, int, int, enum texel_kind))
{
    struct texel_track k;
    set_track(c, &k);
    k.log2 = 3 + k.log2 % 4;
    k.q = (int32_t)c->word[Q];
    k.u = (int32_t)c->word[U];
    k.v = (int32_t)c->word[V];
    k.place = place_divided(k.q, k.u, k.v, k.slope, k.parabolic);
    texcoord_run(&k.run, (struct texcoord){ 0, 0, 0, 0, 0, 0 });
    texel_run_start(&k.run, LOG2_WIDTH, log2_height);
    k.run.color = c->plane[0];
    k.run.depth = c->plane[1];
    k.run.texels = c->plane[2];
    k.run.z = c->word[Z];
    k.run.dz = c->word[DZ];
    draw(&k, c->n - 1, LOG2_WIDTH, log2_height, kind);
    c->word[Q] = (uint32_t)k.q;
    c->word[U] = (uint32_t)k.place.u;
    c->word[V] = (uint32_t)k.place.v;
}

static void row_narrow(struct kernel_call *c) { row_by(c, TEXELS_NARROW, LOG2_HEIGHT, row_reference); }
static void row_narrow_lanes(struct kernel_call *c) { row_by(c, TEXELS_NARROW, LOG2_HEIGHT, texels_row_lanes); }
static void row_square(struct kernel_call *c) { row_by(c, TEXELS_WIDE, LOG2_WIDTH, row_reference); }
static void row_square_lanes(struct kernel_call *c) { row_by(c, TEXELS_WIDE, LOG2_WIDTH, texels_row_lanes); }
#endif

KERNELS(texel_track) = {
    { .name = "texel_track", .least = 1, .most = 19, .size = { 48 }, .align = { 4 }, .prepare = prepare, .timed = 20,
      .form = { { "reference", reference },
#if SMEAR_ASM_ARMV6M
                { "armv6m", armv6m },
#endif
      } },
#if SMEAR_ASM_ARMV7EM
    { .name = "texel_blocks (narrow)", .least = 3, .most = 140, .size = { 2, 2, 2 }, .prepare = blocks_narrow_prepare,
      .form = { { "reference", narrow_reference }, { "armv7em", narrow_armv7em } } },
    { .name = "texel_blocks (wide)", .least = 3, .most = 140, .size = { 4, 2, 4 }, .prepare = blocks_wide_prepare,
      .form = { { "reference", wide_reference }, { "armv7em", wide_armv7em } } },
#endif
#if TEXELS_LANES
    { .name = "texels_row (narrow)", .least = 8, .most = 140, .size = { 4, 2, 4 }, .prepare = rows_prepare,
      .form = { { "reference", row_narrow }, { "lanes", row_narrow_lanes } } },
    { .name = "texels_row (square)", .least = 8, .most = 140, .size = { 4, 2, 4 }, .prepare = rows_prepare,
      .form = { { "reference", row_square }, { "lanes", row_square_lanes } } },
#endif
    { .name = NULL }
};
