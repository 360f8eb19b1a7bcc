/* SPDX-License-Identifier: MIT */
/* figures.c - figures that move by their own clips: robot and fox run along the built-in track
 * (chase), the robot dances before fans (dance), fans turn in the wind (wind). */
#include "tools/demo/dioramas.h"

#include "tools/scenes/build.h"
#include "tools/scenes/demo.h"

#include <math.h>

#define PI 3.14159265358979323846

static int own_file(int actor)
{
    return actor;
}

static int first_file(int actor)
{
    (void)actor;
    return 0;
}

/* ------------------------------------------------------------------ chase */

enum { CHASE_FOX, CHASE_ROBOT, CHASE_FILES };

static const struct diorama_file chase_files[CHASE_FILES] = {
    [CHASE_FOX] = { "khronos/Fox.glb", "Run" },
    [CHASE_ROBOT] = { "quaternius/RobotExpressive.glb", "Running" },
};

/* Metres per second; the clips are played as much faster as feet need to keep up. */
#define CHASE_SPEED 12.0
#define CHASE_LENGTH 20.0       /* of a piece of track */
#define CHASE_LIFT 0.06         /* the paws reach this far below the fox's own ground */

static void chase_place(double time, struct diorama_place *place)
{
    double x = CHASE_SPEED * time;
    struct xform ahead = xform_turn_y(PI / 2);
    double fox = 1 / 66.0, robot = 0.50;
    struct xform at = xform_mul(xform_move(x + 1.15, CHASE_LIFT, 0.85), ahead);
    place[CHASE_FOX].world = xform_mul(at, xform_scale(fox, fox, fox));
    place[CHASE_FOX].clip_time = 2.1 * time;
    at = xform_mul(xform_move(x - 1.55, 0.05, -0.6), ahead);
    place[CHASE_ROBOT].world = xform_mul(at, xform_scale(robot, robot, robot));
    place[CHASE_ROBOT].clip_time = 1.7 * time;
}

struct chase_set {
    int backdrop, track, shadow;
};

static const struct scene_surface *blob(struct stage *stage, double along, double across,
                                        uint32_t color)
{
    enum { CORNERS = 14 };
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, color);
    build_vertex(&b, vec3(0, 0, 0), vec3(0, 1, 0), 0, 0);
    for (int i = 0; i < CORNERS; i++) {
        double a = 2 * PI * i / CORNERS;
        build_vertex(&b, vec3(along * sin(a), 0, across * cos(a)), vec3(0, 1, 0), 0, 0);
    }
    for (uint32_t i = 0; i < CORNERS; i++)
        build_triangle(&b, 0, 1 + i, 1 + (i + 1) % CORNERS);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = true;
    return s;
}

static void chase_build(struct stage *stage)
{
    struct chase_set *set = stage_alloc(stage, sizeof *set);
    if (set == NULL)
        return;
    stage->extra = set;
    set->backdrop = demo_backdrop(stage);
    set->track = demo_track(stage, CHASE_LENGTH);
    set->shadow = stage_add(stage, blob(stage, 1.1, 0.26, 0x3c4049));
    stage_add(stage, blob(stage, 0.75, 0.5, 0x3c4049));
}

static void chase_move(const struct stage *stage, double time, struct scene_instant *out)
{
    const struct chase_set *set = stage->extra;
    double x = CHASE_SPEED * time;
    struct vec3 eye = vec3(x + 1.2, 1.25, 5.6);
    stage_camera(out, xform_look(eye, vec3(x - 0.1, 1.12, 0), vec3(0, 1, 0)), 44);
    out->camera.znear = 0.4;
    out->camera.zfar = 140;
    stage_place(out, set->backdrop, xform_move(eye.x, 0, eye.z));
    demo_track_place(out, set->track, CHASE_LENGTH, x, 60);
    stage_place(out, set->shadow, xform_move(x + 1.15, 0.012, 0.55));
    stage_place(out, set->shadow + 1, xform_move(x - 1.45, 0.012, -0.75));
}

static const struct stage_kind chase_stage = { "chase", 320, 240, 0.7, 0x9fd0ee, chase_build,
                                               chase_move };
const struct diorama_kind diorama_chase = { &chase_stage, chase_files, CHASE_FILES,
                                            CHASE_FILES, own_file, chase_place };

/* ------------------------------------------------------------------ dance */

enum { DANCE_ROBOT, DANCE_FAN, DANCE_FILES };

static const struct diorama_file dance_files[DANCE_FILES] = {
    [DANCE_ROBOT] = { "quaternius/RobotExpressive.glb", "Dance" },
    [DANCE_FAN] = { "own/fan.glb", "spin" },
};
enum { DANCE_CAST = 3 };

static int dance_file_of(int actor)
{
    return actor == 0 ? DANCE_ROBOT : DANCE_FAN;
}

static void fan_at(struct diorama_place *place, double x, double z, double size, double heading,
                   double clip_time)
{
    struct xform stand = xform_mul(xform_move(x, 1.8 * size, z), xform_turn_y(heading));
    place->world = xform_mul(stand, xform_scale(size, size, size));
    place->clip_time = clip_time;
}

static void dance_place(double time, struct diorama_place *place)
{
    double size = 0.5;
    place[0].world = xform_mul(xform_turn_y(0.25), xform_scale(size, size, size));
    place[0].clip_time = 1.5 * time;
    fan_at(&place[1], -2.15, -0.9, 0.95, 0.45, 2.4 * time);
    fan_at(&place[2], 2.10, -1.1, 0.95, -0.30, 2.4 * time + 0.07);
}

struct floor_set {
    int backdrop, floor, meadow;
};

/* Light and dark squares of a metre. */
static const struct scene_surface *squares(struct stage *stage, int half)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int z = -half; z < half; z++)
        for (int x = -half; x < half; x++) {
            build_color(&b, (x + z) & 1 ? 0xe9e2d0 : 0x4f7f8c);
            build_field(&b, x, z, x + 1, z + 1, 1, 1, NULL);
        }
    return build_finish(&b);
}

static const struct scene_surface *meadow(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0x86bb58);
    build_field(&b, -110, -110, 110, 40, 6, 6, NULL);
    return build_finish(&b);
}

static void floor_build(struct stage *stage)
{
    struct floor_set *set = stage_alloc(stage, sizeof *set);
    if (set == NULL)
        return;
    stage->extra = set;
    set->backdrop = demo_backdrop(stage);
    set->meadow = stage_add(stage, meadow(stage));
    set->floor = stage_add(stage, squares(stage, 4));
}

static void floor_move(const struct stage *stage, double time, struct scene_instant *out)
{
    const struct floor_set *set = stage->extra;
    struct vec3 eye = vec3(0.9, 1.7, 5.6);
    (void)time;
    stage_camera(out, xform_look(eye, vec3(0, 1.35, 0), vec3(0, 1, 0)), 42);
    out->camera.znear = 0.5;
    out->camera.zfar = 140;
    stage_place(out, set->backdrop, xform_move(eye.x, 0, eye.z));
    stage_place(out, set->meadow, xform_move(0, -0.06, 0));
}

static const struct stage_kind dance_stage = { "dance", 320, 240, 0.54, 0x9fd0ee, floor_build,
                                               floor_move };
const struct diorama_kind diorama_dance = { &dance_stage, dance_files, DANCE_FILES, DANCE_CAST,
                                            dance_file_of, dance_place };

/* ------------------------------------------------------------------ wind */

enum { WIND_FANS = 5 };

static const struct diorama_file wind_files[1] = { { "own/fan.glb", "spin" } };

static void wind_place(double time, struct diorama_place *place)
{
    static const struct { double x, z, size, rate, start; } fan[WIND_FANS] = {
        { -0.75, 0.3, 1.0, 2.2, 0.00 }, { 1.75, -1.6, 1.0, 1.9, 0.03 },
        { -3.7, -3.0, 1.0, 2.4, 0.06 }, { 4.6, -6.0, 1.15, 2.0, 0.01 },
        { -0.1, -9.5, 1.15, 2.4, 0.04 },
    };
    for (int i = 0; i < WIND_FANS; i++)
        fan_at(&place[i], fan[i].x, fan[i].z, fan[i].size, 0.2,
               fan[i].rate * time + fan[i].start);
}

static void wind_build(struct stage *stage)
{
    struct floor_set *set = stage_alloc(stage, sizeof *set);
    if (set == NULL)
        return;
    stage->extra = set;
    set->backdrop = demo_backdrop(stage);
    set->meadow = stage_add(stage, meadow(stage));
}

static void wind_move(const struct stage *stage, double time, struct scene_instant *out)
{
    const struct floor_set *set = stage->extra;
    struct vec3 eye = vec3(0.8, 1.3, 4.9);
    (void)time;
    stage_camera(out, xform_look(eye, vec3(-0.05, 1.65, 0), vec3(0, 1, 0)), 44);
    out->camera.znear = 0.5;
    out->camera.zfar = 140;
    stage_place(out, set->backdrop, xform_move(eye.x, 0, eye.z));
}

static const struct stage_kind wind_stage = { "wind", 320, 240, 0.30, 0x9fd0ee, wind_build,
                                              wind_move };
const struct diorama_kind diorama_wind = { &wind_stage, wind_files, 1, WIND_FANS, first_file,
                                           wind_place };
