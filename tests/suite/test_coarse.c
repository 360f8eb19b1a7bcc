/* SPDX-License-Identifier: MIT */
/* test_coarse.c - meshes written by hand have few coarse steps: a floor from -8 to 8, texture coordinates of 0 and 1. They are where
 * the same mesh in fine steps is, and so are their textures: near the eye, where triangles are cut, at rest and blurred. Two that
 * share corners have no gap between them, whatever else they have. */
#include "tests/random.h"
#include <smear_math.h>

#include "tests/rig.h"

#include <math.h>

enum { SIDE = 96, CASES = 600, CORNERS = 8 };

/* A plane quad or a box, whose longest side has `steps` of them to either side of its middle. */
struct made {
    int16_t position[3 * CORNERS], uv[2 * CORNERS];
    uint16_t index[36];
    smear_mesh mesh;
};

static int random_below(uint32_t n) { return (int)(random_u32() % n); }

static void make(struct made *m, bool box, int steps, int repeats)
{
    static const uint16_t flat[6] = { 0, 1, 3, 0, 3, 2 },
                          round[36] = { 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5 };
    const int half[3] = { steps, 1 + random_below((uint32_t)steps), box ? 1 + random_below((uint32_t)steps) : 0 };
    for (int i = 0; i < CORNERS; i++) {
        for (int k = 0; k < 3; k++)
            m->position[3 * i + k] = (int16_t)(i >> k & 1 ? half[k] : -half[k]);
        m->uv[2 * i] = (int16_t)(i & 1 ? repeats : 0);
        m->uv[2 * i + 1] = (int16_t)(i >> 1 & 1 ? repeats : 0);
    }
    memcpy(m->index, box ? round : flat, box ? sizeof round : sizeof flat);
    m->mesh = (smear_mesh){ .position = m->position, .uv = m->uv, .index = m->index, .vertex_count = box ? 8 : 4,
                            .triangle_count = box ? 12 : 2, .uv_shift = 1 };
}

/* The same mesh in steps of which the longest side has 15 bits. */
static void make_fine(struct made *fine, const struct made *m, int steps, int repeats)
{
    int up = 0, uv_up = 0;
    *fine = *m;
    while (steps << (up + 1) <= INT16_MAX)
        up++;
    while (repeats << (uv_up + 1) <= INT16_MAX && uv_up < 13)
        uv_up++;
    for (int i = 0; i < 3 * CORNERS; i++)
        fine->position[i] = (int16_t)(m->position[i] * (1 << up));
    for (int i = 0; i < 2 * CORNERS; i++)
        fine->uv[i] = (int16_t)(m->uv[i] * (1 << uv_up));
    fine->mesh.position = fine->position;
    fine->mesh.uv = fine->uv;
    fine->mesh.index = fine->index;
    fine->mesh.shift = (int8_t)(m->mesh.shift + up);
    fine->mesh.uv_shift = (uint8_t)(m->mesh.uv_shift + uv_up);
}

struct view {
    smear_camera camera, open;
    smear_transform place;
    smear_material material;
    smear_frame frame;
    smear_draw draw;
};

/* An eye within a few sizes of the mesh, often a small part of one above it; a camera that moves in every second case. */
static void random_view(struct view *v, int i, double size)
{
    memset(v, 0, sizeof *v);
    v->camera = smear_perspective(SMEAR_DEGREES(60), q16(size / 32), 0);
    v->camera.pose = smear_look_at(smear_vec(q16(size * (random_below(200) - 100) / 80), q16(size * (2 + random_below(60)) / 40),
                                             q16(size * (random_below(200) - 100) / 80)),
                                   smear_vec(q16(size * (random_below(200) - 100) / 300), 0, q16(size * (random_below(200) - 100) / 300)),
                                   smear_vec(0, 1, 0));
    v->open = v->camera;
    v->open.pose.origin[0] += i % 2 ? q16(size / 20) : 0;
    v->place = smear_compose(smear_rotate_y(random_u32()), smear_rotate_x(SMEAR_DEGREES(-90)));
    v->material = (smear_material){ .color = { 220, 200, 160, 255 }, .texture = i % 3 ? &checker_texture : NULL, .double_sided = 1 };
    v->frame = (smear_frame){ .camera = &v->camera, .open = &v->open, .close = &v->open, .clear = 0x204060,
                              .method = (uint8_t)(i % 4 == 3 ? SMEAR_AUTO : SMEAR_NONE), .light_space = SMEAR_LIGHT_ENCODED };
    v->draw = (smear_draw){ .material = &v->material, .now = &v->place };
}

static void test_coarse_meshes_are_where_fine_ones_are(void)
{
    double worst = 0, sum = 0;
    make_checker();
    smear_desc desc = { .width = SIDE, .height = SIDE, .flush = place_band, .methods = SMEAR_SET(SMEAR_AUTO) };
    RIG(coarse, &desc, false);
    RIG(fine, &desc, false);
    for (int i = 0; i < CASES; i++) {
        const int steps = 1 + random_below(i % 5 == 0 ? 300u : 12u), repeats = 1 + random_below(8), shift = random_below(6);
        struct made m, same;
        struct view v;
        make(&m, i % 4 == 0, steps, repeats);
        m.mesh.shift = (int8_t)shift;
        make_fine(&same, &m, steps, repeats);
        random_view(&v, i, ldexp(steps, -shift));
        v.draw.mesh = &m.mesh;
        CHECK_EQ(rig_frame(&coarse, &v.frame, &v.draw, 1), SMEAR_OK);
        v.draw.mesh = &same.mesh;
        CHECK_EQ(rig_frame(&fine, &v.frame, &v.draw, 1), SMEAR_OK);
        double squares = 0;
        for (int p = 0; p < SIDE * SIDE * 4; p++)
            squares += pow(coarse.picture[p] - fine.picture[p], 2);
        const double error = sqrt(squares / (SIDE * SIDE * 3));
        worst = fmax(worst, error);
        sum += error / CASES;
        if (error > 8 && getenv("SMEAR_SHOW") != NULL)
            printf("coarse: case %d, %d steps, shift %d: %.1f codes\n", i, steps, shift, error);
    }
    if (!CHECK(worst < 3 && sum < 0.1) || getenv("SMEAR_SHOW") != NULL)
        printf("coarse: %.2f codes off, %.3f in the mean\n", worst, sum);
}

/* ------------------------------------------------------------------ neighbours */

enum { PAIRS = 2000, SHARED = 6 };

/* Two quads at either side of an edge, of which one may reach far: `whole` has both, `part` one each, the second in finer steps. */
struct pair {
    int16_t position[3][3 * SHARED];
    smear_mesh whole, part[2];
};

static void make_pair(struct pair *p, int steps, int reach, int finer)
{
    static const uint16_t index[12] = { 0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4 };
    const int x[3] = { -steps - random_below((uint32_t)steps), random_below(3) - 1, steps + random_below((uint32_t)reach) };
    for (int i = 0; i < SHARED; i++) {
        const int at[3] = { x[i / 2], i % 2 ? steps : -steps, i / 2 == 1 ? 0 : random_below(3) - 1 };
        for (int k = 0; k < 3; k++) {
            p->position[0][3 * i + k] = p->position[1][3 * i + k] = (int16_t)at[k];
            p->position[2][3 * i + k] = (int16_t)(at[k] * (1 << finer));
        }
    }
    p->whole = (smear_mesh){ .position = p->position[0], .index = index, .vertex_count = SHARED, .triangle_count = 4 };
    p->part[0] = p->part[1] = p->whole;
    p->part[0].triangle_count = p->part[1].triangle_count = 2;
    p->part[0].position = p->position[1];
    p->part[0].vertex_count = 4;
    p->part[1].position = p->position[2];
    p->part[1].index = index + 6;
    p->part[1].shift = (int8_t)finer;
}

/* Returns how many pixels of the background are seen between the two where none is in the whole; -1 where pictures of them in the
 * same steps are not the same bits. */
static int holes_of(struct rig *r, int i, int finer)
{
    struct pair p;
    struct view v;
    const int steps = 1 + random_below(i % 5 == 0 ? 100u : 12u), reach = i % 3 ? 1 + random_below((uint32_t)steps * 40u) : 1;
    make_pair(&p, steps, reach, finer);
    random_view(&v, i, steps);
    v.material.texture = NULL;
    v.draw.mesh = &p.whole;
    CHECK_EQ(rig_frame(r, &v.frame, &v.draw, 1), SMEAR_OK);
    static uint8_t whole[SIDE * SIDE * 4];
    memcpy(whole, r->picture, sizeof whole);
    smear_draw two[2] = { v.draw, v.draw };
    two[0].mesh = &p.part[0];
    two[1].mesh = &p.part[1];
    CHECK_EQ(rig_frame(r, &v.frame, two, 2), SMEAR_OK);
    int holes = finer == 0 && memcmp(r->picture, whole, sizeof whole) != 0 ? -1 : 0;
    for (int k = 0; k < SIDE * SIDE && finer != 0; k++)
        holes += memcmp(r->picture + 4 * k, whole + 4 * k, 3) != 0 && r->picture[4 * k] == 0x60 && r->picture[4 * k + 2] == 0x20;
    return holes;
}

static void test_neighbours_in_the_same_steps_share_their_bits(void)
{
    smear_desc desc = { .width = SIDE, .height = SIDE, .flush = place_band, .methods = SMEAR_SET(SMEAR_AUTO) };
    RIG(rig, &desc, false);
    for (int i = 0; i < PAIRS; i++)
        if (!CHECK_EQ(holes_of(&rig, i, 0), 0))
            printf("coarse: pair %d\n", i);
}

static void test_neighbours_in_other_steps_leave_hardly_a_hole(void)
{
    smear_desc desc = { .width = SIDE, .height = SIDE, .flush = place_band, .methods = SMEAR_SET(SMEAR_AUTO) };
    RIG(rig, &desc, false);
    int holes = 0;
    for (int i = 0; i < PAIRS; i++)
        holes += holes_of(&rig, i, 1 + random_below(3));
    if (!CHECK(holes < 20) || getenv("SMEAR_SHOW") != NULL)
        printf("coarse: %d holes\n", holes);
}

#include "build/suites/coarse.h"
