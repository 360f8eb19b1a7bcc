/* SPDX-License-Identifier: MIT */
/* lights_cost.c - what lights cost per vertex: in the units of platform.h's clock, a frame of 240x240 of a waving ground of 289
 * vertices with normals, all of them seen, and by how much each of them takes longer under further lights; and what its place on a
 * matcap takes. */
#include "tests/target/cost.h"

#include "smear_matcap.h"
#include "smear_scene.h"
#include "smear_stats.h"

enum { SIDE = 17, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static int16_t position[3 * VERTICES];
static int8_t normal[3 * VERTICES];
static uint16_t face[3 * TRIANGLES];

static uint32_t read_clock(void *user)
{
    (void)user;
    return platform_clock();
}

/* Normals of 127 about +z, one of four patterns after the other. */
static void make_ground(void)
{
    static const int8_t way[4][3] = { { 0, 0, 127 }, { 60, 0, 112 }, { -36, 48, 112 }, { 0, -76, 102 } };
    for (int i = 0; i < VERTICES; i++) {
        position[3 * i] = (int16_t)((i % SIDE - SIDE / 2) * 1000);
        position[3 * i + 1] = (int16_t)((i / SIDE - SIDE / 2) * 1000);
        for (int k = 0; k < 3; k++)
            normal[3 * i + k] = way[i & 3][k];
    }
    uint16_t *f = face;
    for (int i = 0; i < VERTICES - SIDE; i++)
        if (i % SIDE != SIDE - 1) {
            const int corner[6] = { i, i + 1, i + SIDE + 1, i, i + SIDE + 1, i + SIDE };
            for (int k = 0; k < 6; k++)
                *f++ = (uint16_t)corner[k];
        }
}

/* Returns what triangles of a frame take until they are drawn, with `scene`, which may be null; 0 where it fails. */
static uint32_t cost(smear_light_space light, const smear_scene *scene, uint8_t gloss)
{
    const smear_desc desc = { .width = WIDTH, .height = WIDTH, .format = SMEAR_RGB565, .bands = 2, .methods = SMEAR_SET(SMEAR_NONE),
                              .tile = 16, .max_draws = 1, .max_triangles = TRIANGLES, .flush = swallow,
                              .debug.clock = read_clock };
    const smear_camera eye = { .pose = SMEAR_IDENTITY, .focal = ONE, .near_plane = ONE / 2 };
    const smear_frame frame = { .camera = &eye, .method = SMEAR_NONE, .clear = 0x203040, .light_space = (uint8_t)light, .scene = scene };
    const smear_mesh ground = { .position = position, .normal = normal, .index = face, .triangle_count = TRIANGLES,
                                .vertex_count = VERTICES, .shift = 13 };
    const smear_material paint = { .color = { 200, 160, 120, 255 }, .gloss = gloss };
    smear_transform pose = SMEAR_IDENTITY;
    pose.origin[2] = -ONE;
    const smear_draw draw = { .id = 1, .mesh = &ground, .material = &paint, .now = &pose };
    uint32_t count = begin_context(&desc);
    for (int i = 0; i < FRAMES && count != 0; i++) {
        smear_stats stats;
        count = draw_frame(&frame, &draw, 1);
        smear_get_stats(context, &stats);
        count = count != 0 ? platform_clock_count(stats.time.submit) : 0;
    }
    return count;
}

static void print_tenths(uint32_t tenths)
{
    print_decimal(tenths / 10);
    platform_print(".");
    print_decimal(tenths % 10);
}

/* Prints what smear_matcap_uv takes per vertex where the basis scales alike, and where it does not. */
static void report_matcap(void)
{
    static int16_t uv[2 * VERTICES];
    const smear_mesh ground = { .position = position, .normal = normal, .vertex_count = VERTICES };
    const smear_camera eye = { .pose = SMEAR_IDENTITY, .focal = ONE, .near_plane = ONE / 2 };
    platform_print("matcap, uneven    ");
    for (int uneven = 0; uneven < 2; uneven++) {
        smear_transform pose = smear_move(0, 0, -ONE);
        pose.basis[0] >>= uneven;
        const uint32_t before = platform_clock();
        smear_matcap_uv(uv, &ground, &pose, &eye);
        print_tenths(platform_clock_count(platform_clock() - before) * 10 / VERTICES);
        platform_print(uneven ? "\n" : ", ");
    }
}

/* Prints what a vertex takes more than one under the sun alone. */
static bool report(const char *name, smear_light_space light, const smear_lights *lights, uint8_t gloss)
{
    const smear_scene scene = { .lights = lights };
    const uint32_t bare = cost(light, NULL, 0), lit = cost(light, &scene, gloss);
    platform_print(name);
    const uint32_t tenths = (lit < bare ? bare - lit : lit - bare) * 10 / VERTICES;
    platform_print(lit < bare ? "-" : "");
    print_tenths(tenths);
    platform_print(" of ");
    print_decimal(bare);
    platform_print("\n");
    return bare != 0 && lit != 0;
}

int main(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    bool done = true;
    const smear_lights second = { .shader = &smear_lights_shader, .direction = { -ONE, ONE, ONE }, .diffuse = { 20000, 20000, 20000 } };
    const smear_lights lamp = { .shader = &smear_lights_shader, .lamp = { 0, 0, -ONE / 4 }, .reach = 3 * ONE,
                                .lamp_diffuse = { 40000, 40000, 40000 } };
    smear_lights both = lamp;
    for (int k = 0; k < 3; k++) {
        both.direction[k] = second.direction[k];
        both.diffuse[k] = second.diffuse[k];
    }
    make_ground();
    begin_report(" per vertex beyond the sun's, of a frame of 240x240\n");
    for (int light = 0; light < 2; light++) {
        done = report("second light      ", (smear_light_space)!light, &second, 0) && done;
        done = report("lamp              ", (smear_light_space)!light, &lamp, 0) && done;
        done = report("both              ", (smear_light_space)!light, &both, 0) && done;
        done = report("both, highlights  ", (smear_light_space)!light, &both, 200) && done;
    }
    report_matcap();
    return done ? 0 : 1;
}
