/* SPDX-License-Identifier: MIT */
/* test_shader.c - smear_scene.lights make the same bits on every machine: a sum of colours under lights, at places and of materials of
 * chance, of vertices and of faces. Against double precision they are held by tests/suite/test_lights.c. */
#include "smear_math.h"
#include "smear_scene.h"

#include "base/base.h"
#include "geometry/vertex.h"
#include "tests/random.h"
#include "tests/test.h"

#if SMEAR_WITH_LIGHTS && SMEAR_WITH_GOURAUD

enum { LOOKS = 2000 };

struct look {
    int16_t position[9];
    int8_t normal[9];
    smear_mesh mesh;
    smear_material material;
    smear_transform pose;
    smear_light light;
    smear_lights lights;
    smear_camera camera;
};

static void make_look(struct look *c)
{
    static const uint16_t index[3] = { 0, 1, 2 };
    *c = (struct look){ .mesh = { .index = index, .vertex_count = 3, .triangle_count = 1, .shift = (int8_t)between(4, 12) } };
    const uint32_t yaw = random_u32(), pitch = random_u32();
    c->lights.shader = &smear_lights_shader;
    c->lights.reach = between(1 << 12, 1 << 20);
    c->pose = smear_from_euler(yaw, pitch, 0);
    c->camera.pose = smear_from_euler(random_u32(), 0, 0);
    if (chance(3))
        c->pose = smear_compose(c->pose, smear_scale(SMEAR_BASIS_ONE / 2, SMEAR_BASIS_ONE * 2, SMEAR_BASIS_ONE));
    const bool is_white = chance(2);
    for (int i = 0; i < 9; i++) {
        c->position[i] = (int16_t)between(-9000, 9000);
        c->normal[i] = (int8_t)between(-73, 73);
    }
    for (int i = 0; i < 3; i++) {
        c->pose.origin[i] = between(-(1 << 18), 1 << 18);
        c->light.direction[i] = between(-65536, 65536);
        c->light.ambient[i] = (uint16_t)(is_white ? 6000 : between(0, 10000));
        c->light.diffuse[i] = (uint16_t)(is_white ? 30000 : between(0, 40000));
        c->lights.direction[i] = between(-65536, 65536);
        c->lights.diffuse[i] = (uint16_t)(is_white ? 15000 : between(0, 40000));
        c->lights.lamp_diffuse[i] = (uint16_t)(is_white ? 60000 : between(0, 65535));
        c->lights.lamp[i] = c->pose.origin[i] + between(-(1 << 17), 1 << 17);
        c->material.color[i] = (uint8_t)between(0, 255);
    }
    c->material.color[3] = 255;
    c->material.gloss = (uint8_t)(chance(2) ? between(0, 255) : 0);
    c->material.shine = (uint8_t)between(0, 12);
    c->mesh.position = c->position;
    c->mesh.normal = chance(3) ? NULL : c->normal;
}

static void test_colors_under_lights_are_the_same_bits_everywhere(void)
{
    static struct look c;
    static struct smear_assembly d;
    uint32_t sum = 0;
    random_state = 43;
    for (int n = 0; n < LOOKS; n++) {
        struct smear_lights_used used;
        struct smear_sun sun;
        make_look(&c);
        smear_sun_make(&sun, &c.light);
        smear_lights_shader.begin(&used, &c.lights, &sun, &c.camera);
        d = (struct smear_assembly){ .mesh = &c.mesh, .material = &c.material, .at.position = c.position };
        smear_shading_make(&d.shading, &c.pose, &c.material, c.mesh.normal != NULL, TRANSFER_CODES, &sun);
        if (!smear_lights_shader.draw(&d.lights, &used, &d, &c.pose))
            continue;
        d.shading.lit = 2;
        for (int back = 0; back < 2; back++) {
            struct smear_color color;
            const struct smear_face face = smear_face_of(&d, 0, back != 0);
            if (c.mesh.normal != NULL)
                d.lights.vertex(&color, &d, (uint32_t)n % 3, &face);
            else
                smear_lights_shader.face(&color, &d, &face);
            for (int i = 0; i < 4; i++) {
                const uint8_t bytes[2] = { (uint8_t)color.channel[i], (uint8_t)(color.channel[i] >> 8) };
                sum = smear_crc32(sum, bytes, 2);
            }
        }
    }
    CHECK_EQ(sum, 0xad5e603fu);
}

#else

static void test_colors_under_lights_are_the_same_bits_everywhere(void)
{
    CHECK(true);
}

#endif

#include "build/suites/shader.h"
