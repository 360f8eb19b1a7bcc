/* SPDX-License-Identifier: MIT */
/* texel_rows.c - how check_kernels calls kernels/texel_rows.h: three spans, one over the other, of rows that reach beyond
 * the columns which may be written; textures of 16 x 8 texels, or of 2 x 2 to 9 x 9 that wrap. */
#include "kernels/texel_rows.h"

#include "tests/kernels/kernels.h"

enum { LOG2_WIDTH = 4, LOG2_HEIGHT = 3, TEXELS = 1 << (LOG2_WIDTH + LOG2_HEIGHT), SPANS = 11, FIRST = 100 };
enum { Q, DQ, U, V, DU, DV, SLOPE, Z, DZ, SHAPE, SEED };        /* words */
enum { COLOR, DEPTH, TEXTURE, PALETTE };                        /* planes */

/* Texels of 32 or 16 bits, copied; or lit ones, of any format, to pixels of 32 or 16, which may wrap. */
enum texels { WIDE, NARROW, LIT, LIT_NARROW, WRAPPED, WRAPPED_NARROW };

extern const struct kernel kernels_texel_rows[];

#if SMEAR_AVX2
static const int formats[4] = { SMEAR_TEXEL_8888, SMEAR_TEXEL_565, SMEAR_TEXEL_PALETTE8, SMEAR_TEXEL_565 };

/* Sizes and wraps of all kinds, by the shape. */
static void wraps_make(struct texel_wraps *w, const struct kernel_call *c)
{
    const uint32_t shape = c->word[SHAPE] >> 10;
    for (int i = 0; i < 2; i++) {
        const uint32_t part = shape >> 10 * i;
        w->size[i] = 2 + (int32_t)(part & 7u);
        w->wrap[i] = (int)((part >> 3 & 63u) % 3u);
        w->scale[i] = w->size[i] << (w->size[i] < 4 ? 28 : w->size[i] < 8 ? 27 : 26);
        w->shift[i] = (int)(part >> 5 & 15u) - 12;
    }
}

/* Planes as triangles have them, mostly. */
static void prepare(struct kernel_call *c)
{
    c->word[SEED] = kernel_random();
    c->bytes[TEXTURE] = TEXELS * 4;
    c->bytes[PALETTE] = 256 * 4;
    if (kernel_random() % 4u == 0)
        return;
    c->word[Q] = c->word[Q] >> 1 | 1u << 24;
    c->word[DQ] = (uint32_t)((int32_t)c->word[DQ] >> 12);
    c->word[DU] = (uint32_t)((int32_t)c->word[DU] >> 10);
    c->word[DV] = (uint32_t)((int32_t)c->word[DV] >> 10);
    c->word[SLOPE] = c->word[DQ] << 7;
}

/* Nothing lies behind the last texel. */
static void prepare_wrapped(struct kernel_call *c)
{
    struct texel_wraps w;
    prepare(c);
    wraps_make(&w, c);
    const int format = formats[c->word[SEED] >> 26 & 3u];
    c->bytes[TEXTURE] = w.size[0] * w.size[1] * (format == SMEAR_TEXEL_8888 ? 4 : format == SMEAR_TEXEL_565 ? 2 : 1);
}

/* Spans of n columns, of which some are drawn; numbers from a seed, so that every form has the same. */
static void spans_make(struct texel_spans *s, const struct kernel_call *c)
{
    uint32_t seed = c->word[SEED];
    s->count = SPANS;
    for (int i = 0; i < SPANS; i++) {
        seed = seed * 1664525u + 1013904223u;
        const int32_t left = FIRST - 40 + (int32_t)(seed >> 8) % (40 + c->n), most = FIRST + c->n;
        const int32_t wide = 1 + (int32_t)(seed >> 16) % ((seed >> 20 & 3u) != 0 ? 20 : 100), right = left + wide;
        const int32_t first = max_i32(left, FIRST), end = min_i32(right, most);
        s->row[i] = i;
        s->left[i] = left;
        s->right[i] = first < end ? right : FIRST + c->n;
        s->a[i] = first < end ? first + (int32_t)(seed >> 4 & 15u) % (end - first) : max_i32(left, FIRST);
        s->b[i] = min_i32(s->right[i], most);
        s->z[i] = c->word[Z] + seed;
        s->dz[i] = c->word[DZ];
    }
}

/* Light of all kinds: white or not, even or not; with blocks of so many pixels, or none. */
static void lights_make(struct texel_lights *l, const struct kernel_call *c, int32_t block)
{
    const uint32_t seed = c->word[SEED];
    const bool white = (seed >> 24 & 1u) != 0, even = (seed >> 25 & 1u) != 0;
    *l = (struct texel_lights){ .palette = (const uint32_t *)c->plane[PALETTE], .format = formats[seed >> 26 & 3u],
                                .linear = (seed >> 28 & 1u) != 0, .plain = seed >> 29 == 0 };
    if ((c->word[SHAPE] >> 16 & 1u) != 0) {
        l->planes.block = block;
        l->planes.q = (struct texel_plane){ (int32_t)c->word[Q], (int32_t)c->word[DQ], 5 };
    }
    for (int i = 0; i < 3; i++) {
        const uint32_t word = white ? seed : seed * (uint32_t)(i + 3), step = word * 69069u;
        l->planes.c[i] = (struct texel_plane){ (int32_t)(word >> 6 & 0xffffffu), 0, 0 };
        if (!even) {
            l->planes.c[i].dx = (int32_t)step >> 12;
            l->planes.c[i].dy = (int32_t)(step << 8) >> 10;
        }
    }
}

/* What rows may point to. */
struct look {
    struct texel_lights lights;
    struct texel_wraps wraps;
};

/* Rows all lie in the same memory. */
static void rows_make(struct texel_rows *t, const struct kernel_call *c, enum texels texels, int32_t block, struct look *look)
{
    const bool narrow = texels == NARROW || texels == LIT_NARROW || texels == WRAPPED_NARROW;
    lights_make(&look->lights, c, block);
    wraps_make(&look->wraps, c);
    *t = (struct texel_rows){
        .texels = c->plane[TEXTURE], .lights = texels >= LIT ? &look->lights : NULL,
        .wraps = texels >= WRAPPED ? &look->wraps : NULL,
        .log2_width = LOG2_WIDTH, .log2_height = LOG2_HEIGHT, .x0 = FIRST, .x1 = FIRST + c->n,
        .depth = (uint16_t *)c->plane[DEPTH] - FIRST, .narrow = narrow,
        .color = narrow ? (void *)((uint16_t *)c->plane[COLOR] - FIRST) : (uint32_t *)c->plane[COLOR] - FIRST
    };
}

static void call_places(struct kernel_call *c, enum texels texels,
                        void draw(const struct texel_rows *, const struct texel_spans *, const struct texel_planes *))
{
    static const int32_t blocks[8] = { 1, 4, 8, 16, 16, 16, 32, 64 };
    const uint32_t shape = c->word[SHAPE];
    const bool divided = (shape & 7u) != 0;
    const struct texel_planes p = {
        { (int32_t)c->word[Q], (int32_t)c->word[DQ], 5 }, { (int32_t)c->word[U], (int32_t)c->word[DU], -77777 },
        { (int32_t)c->word[V], (int32_t)c->word[DV], 1234567 }, (int32_t)c->word[SLOPE], blocks[shape >> 3 & 7u],
        texels >= WRAPPED ? 0 : (int)(shape >> 6 & 7u), divided, divided && (shape >> 9 & 1u) != 0
    };
    struct texel_rows t;
    struct look look;
    struct texel_spans s;
    rows_make(&t, c, texels, p.block <= COLOR_BLOCK_MAX ? p.block : 0, &look);
    spans_make(&s, c);
    draw(&t, &s, &p);
}

static void call_curves(struct kernel_call *c, enum texels texels,
                        void draw(const struct texel_rows *, const struct texel_spans *, const struct texel_curves *))
{
    const struct texel_curves p = {
        (int32_t)(c->word[SHAPE] & 255u), 3,
        { c->word[U], c->word[DU], c->word[Q], c->word[DQ], c->word[SLOPE], c->word[SEED] },
        { c->word[V] | 8u, c->word[DV] & ~15u, c->word[U] & ~15u, c->word[SEED] & ~15u, c->word[DU] & ~15u, c->word[Q] & ~15u },
        4 << c->word[SEED] % 3u
    };
    struct texel_rows t;
    struct look look;
    struct texel_spans s;
    rows_make(&t, c, texels, p.block, &look);
    spans_make(&s, c);
    draw(&t, &s, &p);
}

/* Rows of the same memory once more: those of a triangle lie in columns that may be written. */
static void call_columns(struct kernel_call *c, enum texels texels,
                         void draw(const struct texel_rows *, const struct texel_sides *, const struct texel_curves *))
{
    struct span_side side[(SPANS + 15) & -16];
    const struct texel_curves p = {
        (int32_t)(c->word[SHAPE] & 255u), 3,
        { c->word[U], c->word[DU], c->word[Q], c->word[DQ], c->word[SLOPE], c->word[SEED] },
        { c->word[V] | 8u, c->word[DV] & ~15u, c->word[U] & ~15u, c->word[SEED] & ~15u, c->word[DU] & ~15u, c->word[Q] & ~15u },
        0
    };
    const struct texel_sides sides = { side, SPANS, c->word[Z], c->word[DZ], c->word[SLOPE] };
    struct texel_rows t;
    struct look look;
    struct texel_spans s;
    rows_make(&t, c, texels, 0, &look);
    spans_make(&s, c);
    for (int i = 0; i < SPANS; i++)     /* some have none */
        side[i] = (struct span_side){ s.a[i], (s.z[i] & 7u) == 0 ? s.a[i] - 20 : s.b[i], s.right[i] };
    draw(&t, &sides, &p);
}

#define CALLS(FORM, PLACES, CURVES, COLUMNS) \
    static void wide_columns_##FORM(struct kernel_call *c) { call_columns(c, WIDE, COLUMNS); } \
    static void narrow_columns_##FORM(struct kernel_call *c) { call_columns(c, NARROW, COLUMNS); } \
    static void lit_columns_##FORM(struct kernel_call *c) { call_columns(c, LIT, COLUMNS); } \
    static void lit_narrow_columns_##FORM(struct kernel_call *c) { call_columns(c, LIT_NARROW, COLUMNS); } \
    static void wrapped_places_##FORM(struct kernel_call *c) { call_places(c, WRAPPED, PLACES); } \
    static void wrapped_narrow_places_##FORM(struct kernel_call *c) { call_places(c, WRAPPED_NARROW, PLACES); } \
    static void wrapped_curves_##FORM(struct kernel_call *c) { call_curves(c, WRAPPED, CURVES); } \
    static void wrapped_narrow_curves_##FORM(struct kernel_call *c) { call_curves(c, WRAPPED_NARROW, CURVES); } \
    static void wide_places_##FORM(struct kernel_call *c) { call_places(c, WIDE, PLACES); } \
    static void narrow_places_##FORM(struct kernel_call *c) { call_places(c, NARROW, PLACES); } \
    static void lit_places_##FORM(struct kernel_call *c) { call_places(c, LIT, PLACES); } \
    static void lit_narrow_places_##FORM(struct kernel_call *c) { call_places(c, LIT_NARROW, PLACES); } \
    static void wide_curves_##FORM(struct kernel_call *c) { call_curves(c, WIDE, CURVES); } \
    static void narrow_curves_##FORM(struct kernel_call *c) { call_curves(c, NARROW, CURVES); } \
    static void lit_curves_##FORM(struct kernel_call *c) { call_curves(c, LIT, CURVES); } \
    static void lit_narrow_curves_##FORM(struct kernel_call *c) { call_curves(c, LIT_NARROW, CURVES); }

/* On processors that lack them both are the reference. */
static void places(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p)
{
    (smear_has_avx2() ? smear_texel_rows_places_avx2 : smear_texel_rows_places_reference)(t, s, p);
}

static void curves(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p)
{
    (smear_has_avx2() ? smear_texel_rows_curves_avx2 : smear_texel_rows_curves_reference)(t, s, p);
}

static void columns(const struct texel_rows *t, const struct texel_sides *s, const struct texel_curves *p)
{
    (smear_has_avx2() ? smear_texel_columns_avx2 : smear_texel_columns_reference)(t, s, p);
}

CALLS(reference, smear_texel_rows_places_reference, smear_texel_rows_curves_reference, smear_texel_columns_reference)
CALLS(avx2, places, curves, columns)

#define KERNEL(NAME, CALL, SIZE, PREPARE) \
    { .name = NAME, .least = TEXEL_ROWS_LEAST, .most = 67, .size = { SIZE, 2, 4, 4 }, .prepare = PREPARE, .timed = 240, \
      .form = { { "reference", CALL##_reference }, { "avx2", CALL##_avx2 } } }
#else
#define KERNEL(NAME, CALL, SIZE, PREPARE) { .name = NULL }
#endif

const struct kernel kernels_texel_rows[] = {
    KERNEL("texel_rows_places", wide_places, 4, prepare),
    KERNEL("texel_rows_places (narrow)", narrow_places, 2, prepare),
    KERNEL("texel_rows_places (lit)", lit_places, 4, prepare),
    KERNEL("texel_rows_places (lit, narrow)", lit_narrow_places, 2, prepare),
    KERNEL("texel_rows_curves", wide_curves, 4, prepare),
    KERNEL("texel_rows_curves (narrow)", narrow_curves, 2, prepare),
    KERNEL("texel_rows_curves (lit)", lit_curves, 4, prepare),
    KERNEL("texel_rows_curves (lit, narrow)", lit_narrow_curves, 2, prepare),
    KERNEL("texel_rows_places (wrapped)", wrapped_places, 4, prepare_wrapped),
    KERNEL("texel_rows_places (wrapped, narrow)", wrapped_narrow_places, 2, prepare_wrapped),
    KERNEL("texel_rows_curves (wrapped)", wrapped_curves, 4, prepare_wrapped),
    KERNEL("texel_rows_curves (wrapped, narrow)", wrapped_narrow_curves, 2, prepare_wrapped),
    KERNEL("texel_columns", wide_columns, 4, prepare),
    KERNEL("texel_columns (narrow)", narrow_columns, 2, prepare),
    KERNEL("texel_columns (lit)", lit_columns, 4, prepare),
    KERNEL("texel_columns (lit, narrow)", lit_narrow_columns, 2, prepare),
    { .name = NULL }
};
