/* SPDX-License-Identifier: MIT */
/* night.c - a scene for displays of few greys: windmills before a black sky. */
#include "tools/demo/night.h"

#include "tools/scenes/build.h"

#include <math.h>

#define PI 3.14159265358979323846

#define LOOP_SECONDS (NIGHT_LOOP_FRAMES / 30.0)
/* Whole turns, so that every blade comes back to its own place: 37.5 degrees a frame. */
#define TURNS_PER_LOOP 5

enum { MILLS = 2 };

static const struct { double x, z, size, phase; } mill[MILLS] = {
    { -1.05, 0, 1.0, 0.35 }, { 2.9, -4.6, 1.0, 1.1 },
};

struct night {
    int land, sail;             /* still; the first of MILLS */
};

/* Hub and blades turn about z; a mill of size 1 has its hub at 2.2. */
static const struct scene_surface *sails(struct stage *stage)
{
    enum { BLADES = 3 };
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < BLADES; i++) {
        b.at = xform_turn_z(2 * PI * i / BLADES);
        build_color(&b, 0xffffff);
        build_quad(&b, vec3(-0.10, 0.10, 0.02), vec3(0.06, 0.10, 0.02), vec3(0.30, 1.45, 0.02),
                   vec3(-0.10, 1.55, 0.02));
    }
    b.at = xform_turn_x(PI / 2);
    build_color(&b, 0x9a9a9a);
    build_drum(&b, 0.17, 0.11, -0.05, 0.14, 8);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = s->material.double_sided = true;
    return s;
}

static void tower(struct build *b, double x, double z, double size)
{
    b->at = xform_mul(xform_move(x, 0, z), xform_scale(size, size, size));
    static const double wall[8] = { 0.52, 0, 0.34, 1.5, 0.27, 2.15, 0.24, 2.15 };
    static const double cap[6] = { 0.31, 2.13, 0.25, 2.40, 0, 2.62 };
    b->at = xform_mul(b->at, xform_move(0, 0, -0.42));
    build_color(b, 0xb8b8b8);
    build_lathe(b, wall, 4, 9);
    build_color(b, 0x6a6a6a);
    build_lathe(b, cap, 3, 9);
    build_color(b, 0x101010);
    build_box(b, vec3(-0.13, 0, 0.40), vec3(0.13, 0.55, 0.55));
    b->at = xform_identity();
}

static void disc(struct build *b, double x, double y, double z, double radius, int sides)
{
    uint32_t centre = build_vertex(b, vec3(x, y, z), vec3(0, 0, 1), 0, 0);
    for (int i = 0; i < sides; i++) {
        double a = 2 * PI * i / sides;
        build_vertex(b, vec3(x + radius * cos(a), y + radius * sin(a), z), vec3(0, 0, 1), 0, 0);
    }
    for (uint32_t i = 0; i < (uint32_t)sides; i++)
        build_triangle(b, centre, centre + 1 + i, centre + 1 + (i + 1) % (uint32_t)sides);
}

/* Towers, ground, fence, moon and stars. */
static const struct scene_surface *land(struct stage *stage)
{
    static const double star[][2] = {
        { -37, 12 }, { -31, 23 }, { -4, 17 }, { 4, 26 },
        { 12, 12 },  { 36, 11 },  { 41, 24 }, { -47, 20 },
    };
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < MILLS; i++)
        tower(&b, mill[i].x, mill[i].z, mill[i].size);
    build_color(&b, 0x4c4c4c);
    build_field(&b, -60, -30, 60, 8, 1, 1, NULL);
    build_color(&b, 0x8c8c8c);
    for (int i = -3; i <= 12; i++)
        build_box(&b, vec3(0.35 + 0.55 * i, 0, 1.15), vec3(0.43 + 0.55 * i, 0.42, 1.2));
    build_color(&b, 0xd0d0d0);
    build_box(&b, vec3(-4, 0.26, 1.2), vec3(9, 0.32, 1.22));
    build_color(&b, 0xffffff);
    disc(&b, 26, 20.5, -60, 4.6, 24);
    build_color(&b, 0);
    disc(&b, 28.2, 21.9, -59.5, 3.9, 24);
    build_color(&b, 0xe0e0e0);
    for (size_t i = 0; i < sizeof star / sizeof *star; i++)
        disc(&b, star[i][0], star[i][1], -58, 0.42, 4);
    struct scene_surface *s = build_finish(&b);
    return s;
}

static void night_build(struct stage *stage)
{
    struct night *n = stage_alloc(stage, sizeof *n);
    if (n == NULL)
        return;
    stage->extra = n;
    n->land = stage_add(stage, land(stage));
    const struct scene_surface *s = sails(stage);
    n->sail = stage->prop_count;
    for (int i = 0; i < MILLS; i++)
        stage_add(stage, s);
}

static void night_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct night *n = stage->extra;
    double turn = 2 * PI * TURNS_PER_LOOP * time / LOOP_SECONDS;
    stage_camera(out, xform_look(vec3(0.55, 1.1, 5.6), vec3(0.55, 1.88, 0), vec3(0, 1, 0)), 42);
    out->camera.znear = 0.5;
    out->camera.zfar = 90;
    for (int i = 0; i < MILLS; i++) {
        struct xform hub = xform_move(mill[i].x, 2.2 * mill[i].size, mill[i].z);
        hub = xform_mul(hub, xform_turn_y(0.25 - 0.2 * i));
        hub = xform_mul(hub, xform_scale(mill[i].size, mill[i].size, mill[i].size));
        stage_place(out, n->sail + i, xform_mul(hub, xform_turn_z(mill[i].phase - turn)));
    }
}

static const struct stage_kind kind = { "night", 128, 64, 5 / 30.0, 0x000000, night_build,
                                        night_move };

bool night_open(struct scene *out, struct failure *f)
{
    return stage_open(&kind, 1, kind.name, out, f);
}
