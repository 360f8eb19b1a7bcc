/* SPDX-License-Identifier: MIT */
/* texels_draw.c - how check_kernels calls kernels/texels_draw.h: textures of 16 x 8 texels, whose sizes the compiler knows, and
 * those it doesn't, as of lit ones; and texel_curve_rows.h. */
#include "tests/kernels/kernels.h"
#include "tests/kernels/texels.h"

enum { LOG2_WIDTH = 4, LOG2_HEIGHT = 3, TEXELS = 1 << (LOG2_WIDTH + LOG2_HEIGHT), PALETTE = 256 };
enum { U, V, DU, DV, DDU, DDV, Z, DZ, LIGHT, FORMAT, COLOR_END, DEPTH_END };    /* words */
enum { COLOR, DEPTH, TEXTURE };                                                 /* planes */

static uint32_t palette[PALETTE];

/* Coordinates as textures have them, and the formats of texels in turn. */
static void prepare(struct kernel_call *c)
{
    static const int formats[] = { SMEAR_TEXEL_8888, SMEAR_TEXEL_565, SMEAR_TEXEL_PALETTE8 };
    c->word[V] = (c->word[V] & ~255u) | 128u;
    c->word[DV] &= ~255u;
    c->word[DDV] &= ~255u;
    c->word[FORMAT] = (uint32_t)formats[random_u32() % 3u];
    if (random_u32() % 4u != 0) {            /* textures that are magnified: most pixels show the same texel */
        c->word[DU] >>= 6;
        c->word[DV] = c->word[DV] >> 5 & ~255u;
        c->word[DDU] = c->word[DDV] = 0;
    }
    c->bytes[TEXTURE] = TEXELS * 4;
    for (int i = 0; i < PALETTE; i++)
        palette[i] = random_u32();
}

/* Any form, with sizes that are constants where `kind` is one whose texels are copied. */
SMEAR_INLINE void call(struct kernel_call *c, enum texel_kind kind, int log2_width, int log2_height,
                       void draw(struct texel_run *, int32_t, int, int, enum texel_kind))
{
    const bool is_linear = (c->word[LIGHT] >> 24 & 1u) != 0;
    struct texel_light light;
    struct texel_run run;
    texel_light_start(&light, c->plane[TEXTURE], palette, (int)c->word[FORMAT], log2_width, log2_height,
                      texels_are_narrow(kind), is_linear);
    light.red = pixel_red(c->word[LIGHT]) * (is_linear ? 257u : 1u);
    light.green = pixel_green(c->word[LIGHT]) * (is_linear ? 257u : 1u);
    light.blue = pixel_blue(c->word[LIGHT]) * (is_linear ? 257u : 1u);
    texel_run_start(&run, log2_width, log2_height);
#if TEXELS_PACKED
    run.uv = packed_uv(c->word[U], c->word[V]);
    run.duv = packed_step(c->word[DU], c->word[DV]);
    run.dduv = packed_step(c->word[DDU], c->word[DDV]);
#else
    run.u = c->word[U];
    run.v = c->word[V];
    run.du = c->word[DU];
    run.dv = c->word[DV];
    run.ddu = c->word[DDU];
    run.ddv = c->word[DDV];
#endif
    run.color = c->plane[COLOR];
    run.depth = c->plane[DEPTH];
    run.z = c->word[Z];
    run.dz = c->word[DZ];
    run.texels = c->plane[TEXTURE];
    run.light = &light;
    draw(&run, c->n, log2_width, log2_height, kind);
    c->word[U] = (uint32_t)(texel_run_uv(&run) >> 32);
    c->word[V] = (uint32_t)texel_run_uv(&run);
    c->word[Z] = run.z;
    c->word[COLOR_END] = (uint32_t)((uint8_t *)run.color - (uint8_t *)c->plane[COLOR]);
    c->word[DEPTH_END] = (uint32_t)((uint8_t *)run.depth - (uint8_t *)c->plane[DEPTH]);
    c->word[LIGHT] = light.pixel;
    c->word[FORMAT] = light.index;
}

/* Sizes that the compiler doesn't know. */
static int unknown(int value)
{
    SMEAR_KEEP_VALUE(value);
    return value;
}

#define CALL(NAME, FORM, ...) \
    static void NAME##_##FORM(struct kernel_call *c) { call(c, __VA_ARGS__, texels_draw_##FORM); }
#define CALLS(FORM)                                                                     \
    CALL(wide, FORM, TEXELS_WIDE, LOG2_WIDTH, LOG2_HEIGHT)                              \
    CALL(narrow, FORM, TEXELS_NARROW, LOG2_WIDTH, LOG2_HEIGHT)                          \
    CALL(wide_any, FORM, TEXELS_WIDE, unknown(LOG2_WIDTH), unknown(LOG2_HEIGHT))        \
    CALL(narrow_any, FORM, TEXELS_NARROW, unknown(LOG2_WIDTH), unknown(LOG2_HEIGHT))    \
    CALL(lit, FORM, TEXELS_LIT, unknown(LOG2_WIDTH), unknown(LOG2_HEIGHT))              \
    CALL(lit_narrow, FORM, TEXELS_LIT_NARROW, unknown(LOG2_WIDTH), unknown(LOG2_HEIGHT))

CALLS(reference)
CALLS(unrolled)
#if TEXELS_LANES
#define texels_draw_best texels_draw
CALLS(best)
#define BEST(CALL) , { "best", CALL }
#else
#define BEST(CALL)
#endif
#if SMEAR_ASM_ARMV6M
CALLS(armv6m)
#define ARMV6M(CALL) , { "armv6m", CALL }
#else
#define ARMV6M(CALL)
#endif

#if SMEAR_ASM_ARMV7EM
#define ARMV7EM(CALL) , { "armv7em", CALL }
#else
#define ARMV7EM(CALL)
#endif

#if TEXEL_CURVE_ROWS
enum { STRIDE = 35 };

static struct span_side sides[4];
static struct curve polynomials[2];

/* Rows of pixels within the stride, some of none. */
static void curves_prepare(struct kernel_call *c)
{
    c->bytes[TEXTURE] = TEXELS * 4;
    for (int i = 0; i < 4; i++) {
        const int32_t left = between(0, STRIDE - 1);
        sides[i] = (struct span_side){ left, between(i == 0 ? left - 2 : left, STRIDE), 0 };
    }
    for (int i = 0; i < 2; i++)
        polynomials[i] = (struct curve){ (int32_t)random_u32(), (int32_t)random_u32(), (int32_t)random_u32(),
                                         (int32_t)(random_u32() >> 12), (int32_t)random_u32(), (int32_t)random_u32() };
}

SMEAR_INLINE void curves_by(struct kernel_call *c, void draw(struct texel_curve_rows *, int, int, enum texel_kind), enum texel_kind kind)
{
    struct texel_curve_rows rows = { sides, c->n / STRIDE, (int32_t)c->word[V], c->word[Z], c->plane[DEPTH], (int32_t)c->word[U],
                                     c->word[DU], STRIDE * 2, polynomials[0], polynomials[1], c->word[DZ], c->word[DDU],
                                     c->word[DDV], (intptr_t)c->plane[COLOR] - (intptr_t)c->plane[DEPTH] * (kind == TEXELS_NARROW ? 1 : 2),
                                     c->plane[TEXTURE] };
    draw(&rows, LOG2_WIDTH, LOG2_HEIGHT, kind);
}

#define CURVES(NAME, FORM) \
    static void NAME(struct kernel_call *c) { curves_by(c, texel_curve_rows_##FORM, TEXELS_NARROW); } \
    static void wide_##NAME(struct kernel_call *c) { curves_by(c, texel_curve_rows_##FORM, TEXELS_WIDE); }
CURVES(curves_reference, reference)
#if SMEAR_ASM_ARMV6M
CURVES(curves_armv6m, armv6m)
#else
CURVES(curves_armv7em, armv7em)
#endif
#endif

#define KERNEL(NAME, KIND, SIZE) \
    { .name = NAME, .least = 1, .most = 19, .size = { SIZE, 2, 4 }, .prepare = prepare, .timed = 240, \
      .form = { { "reference", KIND##_reference }, { "unrolled", KIND##_unrolled } BEST(KIND##_best) ARMV6M(KIND##_armv6m) } }

KERNELS(texels_draw) = {
    KERNEL("texels_draw", wide, 4),
    KERNEL("texels_draw (narrow)", narrow, 2),
    KERNEL("texels_draw (any size)", wide_any, 4),
    KERNEL("texels_draw (any size, narrow)", narrow_any, 2),
    KERNEL("texels_draw (lit)", lit, 4),
    KERNEL("texels_draw (lit, narrow)", lit_narrow, 2),
#if TEXEL_CURVE_ROWS
    { .name = "texel_curve_rows", .least = STRIDE, .most = 4 * STRIDE, .size = { 2, 2, 4 }, .prepare = curves_prepare,
      .form = { { "reference", curves_reference } ARMV6M(curves_armv6m) ARMV7EM(curves_armv7em) } },
    { .name = "texel_curve_rows of wide texels", .least = STRIDE, .most = 4 * STRIDE, .size = { 4, 2, 4 }, .prepare = curves_prepare,
      .form = { { "reference", wide_curves_reference } ARMV6M(wide_curves_armv6m) ARMV7EM(wide_curves_armv7em) } },
#endif
    { .name = NULL }
};
