/* SPDX-License-Identifier: MIT */
/* shade8.c - how check_kernels calls geometry/shade8.h: each call makes a mesh's normals and colours, a material and a light
 * from numbers, and shades some vertices, in front and behind, and points between them. */
#include "geometry/shade8.h"
#include "geometry/tiny.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { VERTICES = 40, STORED = 37, STRIDE = 6, POINTS = 75, CASES = 12, SEED = 0, SUM = 1 };

struct shaded {
    smear_mesh mesh;
    smear_material material;
    struct smear_sun sun;
    struct smear_assembly draw;
    struct smear_segment segment;
    struct smear_bins bins;
    int8_t normal[3 * VERTICES];
    uint8_t color[4 * VERTICES];
    uint16_t index[3];
    uint32_t pool[STRIDE * STORED + 2];
    struct smear_triangle point[POINTS];
};

static uint32_t next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8 ^ *seed << 24;
}

/* A byte, or the least or greatest one. */
static uint8_t extreme(uint32_t *seed)
{
    const uint32_t a = next(seed);
    return (uint8_t)((a & 3u) == 0 ? 0u - (a >> 2 & 1u) : a >> 8);
}

static void make_light(struct shaded *a, uint32_t *seed)
{
    const bool white = (next(seed) & 16u) != 0;
    smear_light light = { .direction = { 0, 0, 0 } };
    for (int i = 0; i < 3; i++) {
        light.direction[i] = (int16_t)(next(seed) >> 4);
        light.ambient[i] = white && i > 0 ? light.ambient[0] : (uint16_t)(next(seed) >> 8);
        light.diffuse[i] = white && i > 0 ? light.diffuse[0] : (uint16_t)(next(seed) >> 8);
    }
    smear_sun_make(&a->sun, &light);
}

/* False where this is no draw whose vertices are shaded so. */
static bool make(struct shaded *a, uint32_t *seed)
{
    const uint32_t flags = next(seed) >> 4;
    const smear_transform object = { .basis = { 65536, 0, 0, 0, 65536, 0, 0, 0, 65536 } };
    for (int i = 0; i < 3 * VERTICES; i++)
        a->normal[i] = (int8_t)(next(seed) & 8u ? 128u + extreme(seed) : extreme(seed));
    for (int i = 0; i < 4 * VERTICES; i++)
        a->color[i] = extreme(seed);
    for (int i = 0; i < 3; i++)
        a->index[i] = 0;
    a->mesh = (smear_mesh){ .vertex_count = VERTICES, .normal = flags & 1u ? NULL : a->normal, .color = flags & 2u ? NULL : a->color,
                            .index = a->index, .triangle_count = 1 };
    a->material = (smear_material){ .unlit = a->mesh.normal == NULL || (flags & 12u) == 0 };
    for (int i = 0; i < 4; i++)
        a->material.color[i] = flags & 16u ? extreme(seed) : 255;
    make_light(a, seed);
    a->draw.mesh = &a->mesh;
    a->draw.material = &a->material;
    a->draw.flat = false;
    smear_shading_make(&a->draw.shading, &object, &a->material, a->mesh.normal != NULL, flags >> 5 & 1u, &a->sun);
    a->segment = (struct smear_segment){ .stride = STRIDE, .color = VERTEX_BASE_WORDS + (flags >> 6 & 1u), .shade = SHADE_GOURAUD };
    a->bins = (struct smear_bins){ .pool = a->pool, .pool_words = sizeof a->pool / 4 };
    /* Codes that are copied are of others. */
    return shade8_serves(&a->draw, &a->segment) && (a->draw.shading.lit || a->draw.shading.linear || !a->draw.shading.white);
}

static uint32_t sum_up(uint32_t sum, const struct shaded *a)
{
    for (int i = 0; i < STRIDE * STORED; i++)
        sum = sum * 31u + a->pool[i];
    for (int i = 0; i < POINTS; i++)
        sum = sum * 31u + a->point[i].color;
    return sum;
}

static void make_point(struct smear_mixed *p, struct smear_triangle *point, uint32_t *seed)
{
    p->point = point;
    for (int k = 0; k < 3; k++)
        p->word[k] = next(seed) % STORED * STRIDE;
    p->w1 = next(seed) >> 4 & 0xffffu;
    p->w2 = (next(seed) >> 4 & 0xffffu) % (65537u - p->w1);
}

static void shade_one_by_one(struct shaded *a, uint32_t seed)
{
    for (uint32_t i = 0; i < STORED; i++) {
        const uint32_t index = next(&seed) % VERTICES;
        smear_vertex_store_color(a->pool + STRIDE * i + a->segment.color, &a->draw, index, 0, next(&seed) >> 7 & 1u);
    }
    for (int i = 0; i < POINTS; i++) {
        struct smear_mixed p;
        const uint32_t *const colors = a->pool + a->segment.color;
        make_point(&p, &a->point[i], &seed);
        p.point->color = tiny_color(colors + p.word[0], colors + p.word[1], colors + p.word[2], p.w1, p.w2,
                                    shading_is_linear(&a->draw.shading));
    }
}

SMEAR_AVX2_FUNCTION static void shade_by_eights(struct shaded *a, uint32_t seed)
{
    struct smear_shade8 s;
    shade8_start(&s, &a->draw, &a->segment, &a->bins);
    for (uint32_t i = 0; i < STORED; i++) {
        const uint32_t index = next(&seed) % VERTICES;
        shade8_add(&s, index, STRIDE * i, next(&seed) >> 7 & 1u);
    }
    for (int i = 0; i < POINTS; i++) {
        struct smear_mixed p;
        make_point(&p, &a->point[i], &seed);
        shade8_add_point(&s, &p);
    }
    smear_shade8_all(&s);
}

static void many(struct kernel_call *c, void (*shade)(struct shaded *, uint32_t))
{
    struct shaded a;
    uint32_t seed = c->word[SEED], sum = 0;
    __builtin_memset(&a, 0, sizeof a);
    for (int i = 0; i < CASES; i++)
        if (make(&a, &seed)) {
            shade(&a, next(&seed));
            sum = sum_up(sum, &a);
        }
    c->word[SUM] = sum;
}

static void reference(struct kernel_call *c) { many(c, shade_one_by_one); }

static void avx2(struct kernel_call *c) { many(c, smear_has_avx2() ? shade_by_eights : shade_one_by_one); }

extern const struct kernel kernels_shade8[];
const struct kernel kernels_shade8[] = {
    /* Each length is another call, whose data are others. */
    { .name = "shade8 (made, shaded)", .least = CASES * STORED - 60, .most = CASES * STORED, .size = { 1 }, .timed = CASES * STORED,
      .form = { { "reference", reference }, { "avx2", avx2 } } },
    { .name = NULL }
};
#else
extern const struct kernel kernels_shade8[];
const struct kernel kernels_shade8[] = { { .name = NULL } };
#endif
