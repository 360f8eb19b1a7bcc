/* SPDX-License-Identifier: MIT */
/* rally.c - trucks and a motorcycle on a track through a forest, seen by a camera that drives along
 * (rally) and by one that stands beside the track (pass).
 *
 * Metres; the track runs along x, z to the right of those who drive. Vehicles and pieces of track
 * come along +z from their files. */
#include "tools/demo/dioramas.h"

#include "tools/scenes/build.h"
#include "tools/scenes/demo.h"

#include <math.h>

#define PI 3.14159265358979323846

enum { TRACK, FINISH, FOREST, RED, YELLOW, GREEN, PURPLE, BIKE, FILES };

static const struct diorama_file files[FILES] = {
    [TRACK] = { "kenney-racing/track-straight.glb", NULL },
    [FINISH] = { "kenney-racing/track-finish.glb", NULL },
    [FOREST] = { "kenney-racing/decoration-forest.glb", NULL },
    [RED] = { "kenney-racing/vehicle-truck-red.glb", NULL },
    [YELLOW] = { "kenney-racing/vehicle-truck-yellow.glb", NULL },
    [GREEN] = { "kenney-racing/vehicle-truck-green.glb", NULL },
    [PURPLE] = { "kenney-racing/vehicle-truck-purple.glb", NULL },
    [BIKE] = { "kenney-racing/vehicle-motorcycle.glb", NULL },
};

/* Tiles of 10 m; every fourth carries the arch, so the track repeats after four. Tile j lies in
 * slot j mod SLOTS until it falls behind, then it is laid anew at the far end: a cut, no motion. */
enum { SLOTS = 12, VEHICLES = 5 };
#define TILE 10.0
#define LOOP_LENGTH (4 * TILE)
#define LOOP_SECONDS (RALLY_LOOP_FRAMES / 30.0)

/* The wheels' outline is 1.885 m round; this many whole turns per loop are within 1 % of it. */
#define WHEEL_TURNS 21
#define WHEEL_RADIUS 0.3

enum { FIRST_FOREST = SLOTS, FIRST_VEHICLE = 3 * SLOTS, CAST = FIRST_VEHICLE + VEHICLES };

static int file_of(int actor)
{
    if (actor < FIRST_FOREST)
        return actor % 4 == 0 ? FINISH : TRACK;
    return actor < FIRST_VEHICLE ? FOREST : RED + actor - FIRST_VEHICLE;
}

struct drive {
    double x, z, yaw;           /* on the track; radians to the left */
    double rolled, steer;
    int epoch;
};

static double loops_of(double time)
{
    return time / LOOP_SECONDS;
}

/* ------------------------------------------------------------------ vehicles */

/* Driving together; each sways about its own place. */
static void drive_rally(double time, struct drive *drive)
{
    static const struct { double x, z, sway, phase; } lane[VEHICLES] = {
        { 0.0, 0.1, 0.10, 0.0 }, { -3.7, -1.55, 0.16, 1.9 }, { -8.2, 0.7, 0.20, 3.6 },
        { -11.5, -1.4, 0.20, 5.0 }, { -4.3, 1.15, 0.22, 2.7 },
    };
    double loops = loops_of(time), phase = 2 * PI * loops;
    for (int i = 0; i < VEHICLES; i++) {
        double p = phase + lane[i].phase, swing = lane[i].sway;
        double yaw = 0.30 * swing * cos(p);
        drive[i] = (struct drive){
            .x = LOOP_LENGTH * loops + lane[i].x + 0.9 * swing * sin(p + 1),
            .z = lane[i].z - swing * sin(p), .yaw = yaw, .steer = 2.0 * yaw,
            .rolled = loops * WHEEL_TURNS * 2 * PI * WHEEL_RADIUS,
        };
    }
}

/* Past the camera once per loop, one after the other, midway between two arches. */
#define PASS_X (LOOP_LENGTH / 2)

static void drive_past(double time, struct drive *drive)
{
    static const struct { double behind, z; } lane[VEHICLES] = {
        { 0.0, 0.5 }, { 4.4, -1.6 }, { 11.0, 0.6 }, { 16.0, -1.4 }, { -3.6, -1.5 },
    };
    double loops = loops_of(time);
    for (int i = 0; i < VEHICLES; i++) {
        double at = loops - lane[i].behind / LOOP_LENGTH, lap = floor(at + 0.5);
        drive[i] = (struct drive){ .x = PASS_X + LOOP_LENGTH * (at - lap), .z = lane[i].z,
                                   .rolled = loops * WHEEL_TURNS * 2 * PI * WHEEL_RADIUS,
                                   .epoch = (int)fmod(lap, 1000) };
    }
}

static struct xform on_track(const struct drive *drive, double y)
{
    return xform_mul(xform_move(drive->x, y, drive->z), xform_turn_y(PI / 2 + drive->yaw));
}

static void place_vehicles(const struct drive *drive, struct diorama_place *place)
{
    for (int i = 0; i < VEHICLES; i++)
        place[FIRST_VEHICLE + i] = (struct diorama_place){
            .world = on_track(&drive[i], 0), .rolled = drive[i].rolled, .steer = drive[i].steer,
            .epoch = drive[i].epoch,
        };
}

/* ------------------------------------------------------------------ the track */

/* Tiles from `behind` metres before x on. Forest tiles are turned by quarters, so that no two
 * neighbours look alike. */
static void place_track(double x, double behind, struct diorama_place *place)
{
    int64_t oldest = (int64_t)floor((x - behind) / TILE);
    for (int i = 0; i < SLOTS; i++) {
        int64_t j = oldest + i;
        int slot = (int)(((j % SLOTS) + SLOTS) % SLOTS), epoch = (int)(j - slot);
        double at = (double)j * TILE;
        place[slot] = (struct diorama_place){
            .world = xform_mul(xform_move(at, 0, 0), xform_turn_y(PI / 2)), .epoch = epoch };
        for (int row = 0; row < 2; row++) {
            static const int quarter[2][4] = { { 1, 0, 3, 2 }, { 2, 3, 0, 3 } };
            struct xform turn = xform_turn_y(PI / 2 * quarter[row][slot % 4]);
            place[FIRST_FOREST + SLOTS * row + slot] = (struct diorama_place){
                .world = xform_mul(xform_move(at, 0, -TILE * (row + 1)), turn), .epoch = epoch };
        }
    }
}

static void rally_place(double time, struct diorama_place *place)
{
    struct drive drive[VEHICLES];
    drive_rally(time, drive);
    place_vehicles(drive, place);
    place_track(LOOP_LENGTH * loops_of(time), 92, place);
}

static void pass_place(double time, struct diorama_place *place)
{
    struct drive drive[VEHICLES];
    drive_past(time, drive);
    place_vehicles(drive, place);
    place_track(0, 60, place);
}

/* ------------------------------------------------------------------ the set */

struct rally_set {
    int backdrop, meadow, shadow;
};

/* The dark patch below a vehicle; opaque, so that it is blurred like what throws it. */
static const struct scene_surface *shadow(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    static const double ring[8][2] = {
        { -0.72, 1.20 }, { 0.45, 1.28 }, { 0.55, 0.9 }, { 0.55, -1.25 },
        { 0.40, -1.45 }, { -0.85, -1.50 }, { -1.05, -1.30 }, { -1.05, 0.85 },
    };
    build_color(&b, 0x15161b);
    for (int i = 0; i < 8; i++)
        build_vertex(&b, vec3(ring[i][0], 0, ring[i][1]), vec3(0, 1, 0), 0, 0);
    for (uint32_t i = 1; i + 1 < 8; i++)
        build_triangle(&b, 0, i, i + 1);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = s->material.double_sided = true;
    return s;
}

static const struct scene_surface *meadow(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0x2c8a63);
    build_field(&b, -120, -120, 120, 60, 6, 6, NULL);
    return build_finish(&b);
}

static void build_set(struct stage *stage)
{
    struct rally_set *set = stage_alloc(stage, sizeof *set);
    if (set == NULL)
        return;
    stage->extra = set;
    set->backdrop = demo_backdrop(stage);
    set->meadow = stage_add(stage, meadow(stage));
    const struct scene_surface *dark = shadow(stage);
    set->shadow = stage->prop_count;
    for (int i = 0; i < VEHICLES; i++)
        stage_add(stage, dark);
}

static void move_set(const struct stage *stage, const struct drive *drive, struct vec3 eye,
                     struct scene_instant *out)
{
    const struct rally_set *set = stage->extra;
    double square = floor(eye.x / LOOP_LENGTH);
    stage_place(out, set->backdrop, xform_move(eye.x, 0, eye.z));
    stage_place(out, set->meadow, xform_move(square * LOOP_LENGTH, -0.12, 0));
    out->draw[set->meadow].epoch = (int)fmod(square, 1000);
    for (int i = 0; i < VEHICLES; i++) {
        stage_place(out, set->shadow + i, on_track(&drive[i], 0.02));
        out->draw[set->shadow + i].epoch = drive[i].epoch;
    }
}

static void camera(struct scene_instant *out, struct vec3 eye, struct vec3 look, double yfov)
{
    stage_camera(out, xform_look(eye, look, vec3(0, 1, 0)), yfov);
    out->camera.znear = 0.5;
    out->camera.zfar = 140;
}

static void rally_move(const struct stage *stage, double time, struct scene_instant *out)
{
    double phase = 2 * PI * loops_of(time), x = LOOP_LENGTH * loops_of(time);
    struct vec3 eye = vec3(x + 2.7 + 0.10 * sin(phase), 1.50 + 0.04 * sin(2 * phase), 4.3);
    struct drive drive[VEHICLES];
    drive_rally(time, drive);
    camera(out, eye, vec3(x - 1.5, 0.98, -0.4), 44);
    move_set(stage, drive, eye, out);
}

static void pass_move(const struct stage *stage, double time, struct scene_instant *out)
{
    struct vec3 eye = vec3(PASS_X + 1.8, 1.7, 6.6);
    struct drive drive[VEHICLES];
    drive_past(time, drive);
    camera(out, eye, vec3(PASS_X - 0.4, 1.2, 0), 46);
    move_set(stage, drive, eye, out);
}

static const struct stage_kind rally_stage = { "rally", 320, 240, 42 / 30.0, 0x9fd0ee, build_set,
                                               rally_move };
static const struct stage_kind pass_stage = { "pass", 320, 240, 1 / 30.0, 0x9fd0ee, build_set,
                                              pass_move };

const struct diorama_kind diorama_rally = { &rally_stage, files, FILES, CAST, file_of,
                                            rally_place };
const struct diorama_kind diorama_pass = { &pass_stage, files, FILES, CAST, file_of, pass_place };
