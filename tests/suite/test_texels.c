/* SPDX-License-Identifier: MIT */
/* test_texels.c - textures of few large texels have them where the same ones enlarged have theirs, up to the eye, at rest and blurred. */
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
    v->camera.half_height = i % 7 == 6 ? q16(size) : 0;
    v->camera.far_plane = v->camera.half_height > 0 ? q16(size * 8) : 0;
    v->open = v->camera;
    v->open.pose.origin[0] += i % 2 ? q16(size / 20) : 0;
    v->place = smear_compose(smear_rotate_y(random_u32()), smear_rotate_x(SMEAR_DEGREES(-90)));
    v->material = (smear_material){ .color = { 220, 200, 160, 255 }, .texture = i % 3 ? &checker_texture : NULL, .double_sided = 1 };
    v->frame = (smear_frame){ .camera = &v->camera, .open = &v->open, .close = &v->open, .clear = 0x204060,
                              .method = (uint8_t)(i % 4 == 3 ? SMEAR_AUTO : SMEAR_NONE), .light_space = SMEAR_LIGHT_ENCODED };
    v->draw = (smear_draw){ .material = &v->material, .now = &v->place };
}

/* Of two by two texels. */
static void test_large_texels_have_straight_edges(void)
{
    static uint16_t few[2 * 2] = { 0xffff, 0x0000, 0x2222, 0xeeee }, many[256 * 256];
    const smear_texture small = { .texels = few, .width = 2, .height = 2, .format = SMEAR_TEXEL_565 };
    smear_texture large = { .texels = many, .width = 256, .height = 256, .format = SMEAR_TEXEL_565 };
    double worst = 0, sum = 0;
    for (int i = 0; i < 256 * 256; i++)
        many[i] = few[i / 256 / 128 * 2 + i % 256 / 128];
    smear_desc desc = { .width = SIDE, .height = SIDE, .flush = place_band, .methods = SMEAR_SET(SMEAR_AUTO) };
    RIG(few_texels, &desc, false);
    RIG(many_texels, &desc, false);
    for (int i = 0; i < CASES; i++) {
        struct made m;
        struct view v;
        make(&m, i % 4 == 0, 1000 + random_below(10000), 1 + random_below(4));
        for (int k = 0; k < 2 * CORNERS; k++)
            m.uv[k] = (int16_t)(m.uv[k] * 1024 + 300);
        m.mesh.shift = 12;
        m.mesh.uv_shift = 11;
        random_view(&v, i, 2);
        v.camera.near_plane = 1000;
        v.draw.mesh = &m.mesh;
        v.material.texture = &small;
        CHECK_EQ(rig_frame(&few_texels, &v.frame, &v.draw, 1), SMEAR_OK);
        v.material.texture = &large;
        CHECK_EQ(rig_frame(&many_texels, &v.frame, &v.draw, 1), SMEAR_OK);
        int off = 0;
        for (int p = 0; p < SIDE * SIDE; p++)
            off += abs(few_texels.picture[4 * p] - many_texels.picture[4 * p]) > 16;
        worst = fmax(worst, off);
        sum += (double)off / CASES;
        if (getenv("SMEAR_SHOW") != NULL && off > 50)
            printf("case %d: %d pixels\n", i, off);
    }
    if (!CHECK(worst < 100 && sum < 2) || getenv("SMEAR_SHOW") != NULL)
        printf("texels: %.0f pixels, %.3f in the mean\n", worst, sum);
}

#include "build/suites/texels.h"
