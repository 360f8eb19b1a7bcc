/* SPDX-License-Identifier: MIT */
/* tiny8.c - how check_kernels calls kernels/tiny8.h: lists of random triangles drawn as the raster does, and one by one, which
 * is what defines the result. Each call makes and draws many lists from one number. */
#include "kernels/tiny8.h"
#include "raster/raster.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { WIDTH = 40, HEIGHT = 24, PIXELS = WIDTH * HEIGHT, LISTS = 12, TRIANGLES = 29, SEED = 0, STRIDE = 6, TEXELS = 1024 };

struct lists {
    union {
        uint32_t word[3 * TRIANGLES * STRIDE + 4 * TRIANGLES];
        struct smear_triangle last;
    } pool;
    struct smear_segment segment[2];
    struct smear_bins bins;
    struct smear_raster_draw draw[2];
    struct smear_raster_frame frame;
    struct smear_raster_target target;
    uint32_t texel[TEXELS], palette[256];
    uint16_t depth[PIXELS], direct[PIXELS];
    uint32_t color[PIXELS];
};

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8 ^ *seed << 24;
}

/* A number of few bits more often than one of many. */
static int32_t any(uint32_t *seed, uint32_t most_bits)
{
    const uint32_t bits = next(seed) % most_bits + 1u;
    return (int32_t)(next(seed) & ((1u << bits) - 1u));
}

static void make_segment(struct lists *a, int i, uint32_t *seed)
{
    const uint32_t flags = next(seed) >> 6;
    struct smear_segment *const s = &a->segment[i];
    const bool textured = (flags & 1u) != 0;
    *s = (struct smear_segment){ .draw = (uint16_t)i, .stride = STRIDE, .uv = textured ? VERTEX_BASE_WORDS : 0 };
    s->shade = flags >> 1 & 1u ? SHADE_GOURAUD : textured && (flags >> 2 & 1u) ? SHADE_NONE : SHADE_FLAT;
    s->color = s->shade == SHADE_GOURAUD ? VERTEX_BASE_WORDS + textured : 0;
    s->flat_depth = (flags & 0x18u) == 0;
    s->flat = flags >> 5 & 1u;
    a->draw[i] = (struct smear_raster_draw){ .alpha = flags >> 6 & 15u ? SMEAR_OPAQUE : SMEAR_CUTOUT, .cutoff = 128 };
    const smear_texture texture = { .texels = a->texel, .palette = a->palette, .width = (uint16_t)(1u << (next(seed) >> 4) % 6u),
                                    .height = (uint16_t)(1u << (next(seed) >> 4) % 6u),
                                    .format = (uint8_t)((next(seed) >> 4) % 3u), .wrap_u = SMEAR_REPEAT,
                                    .wrap_v = SMEAR_REPEAT };
    smear_sampler_make(&a->draw[i].sampler, &texture, 10 + (int)((next(seed) >> 4) % 6u), false, a->frame.linear);
}

/* Three records. False where the triangle would be seen from behind, or edge on. */
static bool make_vertices(int32_t *v, const struct smear_segment *s, uint32_t *seed)
{
    const uint32_t size = 7u + (next(seed) >> 4) % 5u, color_bits = next(seed) >> 4 & 1u ? 16u : 12u;
    const bool white = (next(seed) & 0x800u) != 0;
    const int32_t coarse = next(seed) >> 5 & 1u ? ~127 : ~0, x = any(seed, 14) - 2048, y = any(seed, 13) - 1024;
    const int32_t depth = (any(seed, 17) + 64) << 12, mask = 0x3fffffff, change = depth >> next(seed) % 8u;
    const int32_t u = any(seed, 16), w = any(seed, 16), color = any(seed, 16), bright = next(seed) & 0x400 ? 0x7f00 : 0;
    const uint32_t travel = 8u + next(seed) % 9u;
    for (int i = 0; i < 3; i++, v += STRIDE) {
        v[VERTEX_X] = (x + any(seed, size)) & coarse;
        v[VERTEX_Y] = (y + any(seed, size)) & coarse;
        v[VERTEX_DEPTH] = depth + (int32_t)((next(seed) & (uint32_t)mask) % (uint32_t)change);
        v[VERTEX_BASE_WORDS] = (int32_t)(((uint32_t)(u + any(seed, travel)) & 0xffffu) | (uint32_t)(w + any(seed, travel)) << 16);
        for (int c = 0; s->color != 0 && c < 2; c++) {
            const uint32_t low = (uint32_t)min_i32(color + bright + any(seed, color_bits), 0xff00);
            const uint32_t other = (uint32_t)min_i32(bright + any(seed, color_bits), 0xff00);
            v[s->color + c] = (int32_t)(low | (white ? low : other) << 16);
        }
    }
    const int32_t *const a = v - 3 * STRIDE, *const b = v - 2 * STRIDE, *const c = v - STRIDE;
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > 0;
}

static void make_target(struct lists *a, uint32_t *seed)
{
    const uint32_t flags = next(seed) >> 4;
    for (int i = 0; i < PIXELS; i++) {
        a->depth[i] = (uint16_t)(flags & 4u ? next(seed) >> 6 : 0);
        a->direct[i] = 0;
        a->color[i] = 0;
    }
    for (int i = 0; i < TEXELS; i++)
        a->texel[i] = a->palette[i & 255] = next(seed);
    const int32_t cut = flags >> 3 & 1u ? 16 : 0;
    a->frame = (struct smear_raster_frame){ .bins = &a->bins, .draw = a->draw, .linear = flags & 1u, .width = WIDTH,
                                            .height = HEIGHT };
    a->target = (struct smear_raster_target){ .x0 = cut, .y0 = cut / 4, .x1 = WIDTH - cut / 2, .y1 = HEIGHT - cut / 4,
                                              .color = a->color, .direct = flags & 2u ? a->direct : NULL, .depth = a->depth };
    a->target.color_rows = a->target.window_rows = (struct smear_plane_rows){ WIDTH, cut / 4, HEIGHT, 0 };
}

static void make(struct lists *a, uint32_t *seed)
{
    make_target(a, seed);
    make_segment(a, 0, seed);
    make_segment(a, 1, seed);
    a->bins = (struct smear_bins){ .pool = a->pool.word, .pool_words = sizeof a->pool.word / 4, .segment = a->segment,
                                   .segment_count = 2 };
    uint32_t from = 0;
    for (int i = 0; i < TRIANGLES; i++) {
        const uint16_t segment = next(seed) % 20u == 0;
        while (!make_vertices((int32_t *)a->pool.word + from, &a->segment[segment], seed))
            ;
        struct smear_triangle *t = bins_triangle(&a->bins, (uint32_t)i);
        *t = (struct smear_triangle){ { (uint16_t)from, (uint16_t)(from + STRIDE), (uint16_t)(from + 2 * STRIDE) }, segment,
                                      i + 1 < TRIANGLES ? (uint32_t)i + 1u : SMEAR_NO_TRIANGLE, next(seed) };
        from += 3 * STRIDE;
    }
}

static uint32_t sum_up(uint32_t sum, const struct lists *a)
{
    for (int i = 0; i < PIXELS; i++)
        sum = ((sum * 31u + a->depth[i]) * 31u + a->direct[i]) * 31u + a->color[i];
    return sum;
}

static void draw_one_by_one(const struct lists *a)
{
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        const struct smear_triangle *t = bins_triangle(&a->bins, i);
        const struct smear_segment *s = &a->segment[t->segment];
        const int32_t *v[3];
        for (int k = 0; k < 3; k++)
            v[k] = bins_vertex(&a->bins, s, t->vertex[k]);
        smear_raster_triangle(&a->frame, &a->target, s, t->color, v, NULL);
    }
}

static void draw_list(const struct lists *a) { smear_raster_list(&a->frame, &a->target, 0); }

static void many(struct kernel_call *c, void (*draw)(const struct lists *))
{
    struct lists a;
    uint32_t seed = c->word[SEED], sum = 0;
    for (int i = 0; i < LISTS; i++) {
        make(&a, &seed);
        draw(&a);
        sum = sum_up(sum, &a);
    }
    c->word[1] = sum;
}

static void reference(struct kernel_call *c) { many(c, draw_one_by_one); }
static void list(struct kernel_call *c) { many(c, draw_list); }
#endif

extern const struct kernel kernels_tiny8[];
const struct kernel kernels_tiny8[] = {
#if SMEAR_AVX2
    /* Each length is another call, whose data are other lists. */
    { .name = "tiny8 (made, drawn, summed up)", .least = PIXELS - 60, .most = PIXELS, .size = { 1 }, .timed = PIXELS,
      .form = { { "one by one", reference }, { "list", list } } },
#endif
    { .name = NULL }
};
