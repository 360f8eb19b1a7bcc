/* SPDX-License-Identifier: MIT */
/* path_places.c - how check_kernels calls geometry/path_places.h: meshes under random projections at three instants, of which most
 * vertices lie before the camera and some do not; and one vertex after the other, which is what defines the result. Each call
 * makes many from one number. */
#include "geometry/path_places.h"

#include "tests/kernels/eights.h"
#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { MESHES = 8, VERTICES = 8 * PATH_EIGHTS * 2 + 5, SEED = 0 };

struct scene {
    struct smear_assembler assembler;
    struct smear_assembly draw;
    smear_mesh mesh;
    int16_t position[KEYS][3 * VERTICES];
};

static void make_placement(struct smear_placement *at, const int16_t *position, uint32_t *seed)
{
    const int near_bits = eight_between(seed, 0, 20), row_bits = eight_between(seed, 10, 28);
    int32_t (*const m)[4] = at->now.m;
    at->position = position;
    for (int r = 0; r < 3; r++)
        for (int j = 0; j < 4; j++)
            m[r][j] = eight_between(seed, -(1 << (r < 2 ? 28 : row_bits)), 1 << (r < 2 ? 28 : row_bits)) & ~3;
    m[2][3] = eight_between(seed, 0, 1 << 22);
    at->now.depths = (struct smear_depths){ 1 + eight_between(seed, 0, 1 << near_bits),
                                            (eight_next(seed) & 1u) != 0 ? INT32_MAX : 1 << 22, 0x2aaaaaaa,
                                            (int16_t)eight_between(seed, -26, 5), false, 0 };
}

static void make(struct scene *s, uint32_t *seed)
{
    s->mesh = (smear_mesh){ .vertex_count = (uint16_t)eight_between(seed, 1, VERTICES) };
    s->assembler.viewport = (struct smear_viewport){ eight_between(seed, 1, 4096), eight_between(seed, 1, 4096) };
    s->draw.mesh = &s->mesh;
    for (int key = 0; key < KEYS; key++) {
        struct smear_placement *const at = key == MIDDLE ? &s->draw.at : &s->draw.motion.key[key];
        make_placement(at, s->position[key], seed);
        for (int i = 0; i < 3 * VERTICES; i++)
            s->position[key][i] = (int16_t)eight_between(seed, -32768, 32767);
    }
}

static uint32_t add(uint32_t sum, uint32_t a) { return (sum ^ a) * 0x01000193u; }

/* Places before the near plane are undefined. */
static uint32_t add_vertex(uint32_t sum, const struct path_vertex *v)
{
    sum = add(sum, v->outcodes);
    for (int key = 0; key < KEYS; key++)
        if ((v->outcodes >> 8 * key & OUT_NEAR) == 0)
            sum = add(add(add(sum, (uint32_t)v->screen[key].x), (uint32_t)v->screen[key].y), (uint32_t)v->screen[key].depth);
    return sum;
}

static void find_alone(struct path_vertex *v, const struct scene *s, uint32_t index)
{
    struct smear_homogeneous h;
    v->outcodes = 0;
    for (int key = 0; key < KEYS; key++) {
        const struct smear_placement *const at = key == MIDDLE ? &s->draw.at : &s->draw.motion.key[key];
        v->outcodes |= (uint32_t)placement_project(&v->screen[key], &h, at, index, &s->assembler.viewport) << 8 * key;
    }
}

static uint32_t sum_one_by_one(const struct scene *s, const uint16_t order[VERTICES])
{
    struct path_vertex v;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < VERTICES; i++) {
        find_alone(&v, s, order[i]);
        sum = add_vertex(sum, &v);
    }
    return sum;
}

static uint32_t sum_by_eights(const struct scene *s, const uint16_t order[VERTICES])
{
    struct path_places places;
    struct path_vertex v;
    uint32_t sum = 0;
    path_places_open(&places, &s->assembler, &s->draw);
    for (uint32_t i = 0; i < VERTICES; i++) {
        if (!path_places_take(&v, &places, 1u << 16 | order[i]))
            find_alone(&v, s, order[i]);
        sum = add_vertex(sum, &v);
    }
    return sum;
}

static void many(struct kernel_call *c, uint32_t (*find)(const struct scene *, const uint16_t order[VERTICES]))
{
    static struct scene scene;
    uint16_t order[VERTICES];
    uint32_t seed = c->word[SEED], sum = 0;
    for (int i = 0; i < MESHES; i++) {
        make(&scene, &seed);
        for (uint32_t k = 0; k < VERTICES; k++)
            order[k] = (uint16_t)((k + (uint32_t)eight_between(&seed, 0, 9)) % scene.mesh.vertex_count);
        sum = add(sum, find(&scene, order));
    }
    c->word[1] = sum;
}

static void reference(struct kernel_call *c) { many(c, sum_one_by_one); }
static void by_eights(struct kernel_call *c) { many(c, sum_by_eights); }
#endif

extern const struct kernel kernels_path_places[];
const struct kernel kernels_path_places[] = {
#if SMEAR_AVX2
    /* Each length is another call, whose data are other meshes. */
    { .name = "path_places (made, found, summed up)", .least = 300, .most = 320, .size = { 1 },
      .timed = 320, .form = { { "one by one", reference }, { "eights", by_eights } } },
#endif
    { .name = NULL }
};
