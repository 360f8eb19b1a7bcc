/* SPDX-License-Identifier: MIT */
/* demo.c - the scenes shown when there is no model at hand: demo/race and demo/drone.
 *
 * Both last LOOP_FRAMES frames at 30 per second and then show the same pictures again. The car
 * really drives along x, so positions grow by LOOP_LENGTH per loop. */
#include "tools/scenes/builtin.h"

#include "tools/scenes/demo.h"

#include <math.h>

#define PI 3.14159265358979323846

#define LOOP_FRAMES 60
#define LOOP_SECONDS (LOOP_FRAMES / 30.0)
/* Twelve turns of the wheels; the track repeats after as much: 17 m/s, 0.57 m per frame. */
#define LOOP_LENGTH (12 * 2 * PI * CAR_WHEEL_RADIUS)

struct demo {
    int backdrop, track, car, drone;
};

struct scene_surface *demo_shadow(struct build *b, float opacity)
{
    struct scene_surface *s = build_finish(b);
    if (s != NULL) {
        s->material.unlit = true;
        s->material.alpha = MODEL_ALPHA_BLEND;
        for (int k = 0; k < 3; k++)
            s->material.base[k] = 0.012f;
        s->material.base[3] = opacity;
    }
    return s;
}

static void build_all(struct stage *stage)
{
    struct demo *d = stage_alloc(stage, sizeof *d);
    if (d == NULL)
        return;
    stage->extra = d;
    d->backdrop = demo_backdrop(stage);
    d->track = demo_track(stage, LOOP_LENGTH);
    d->car = demo_car(stage);
    d->drone = demo_drone(stage);
}

/* The camera drives ahead of the car on its right and looks back; the drone chases the car. */
static void race_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct demo *d = stage->extra;
    double phase = 2 * PI * time / LOOP_SECONDS, x = LOOP_LENGTH * time / LOOP_SECONDS;
    struct vec3 eye = vec3(x + 3.7 + 0.12 * sin(phase), 1.50 + 0.05 * sin(2 * phase), 4.6);
    struct vec3 look = vec3(x - 0.62, 1.24, -0.2);
    stage_camera(out, xform_look(eye, look, vec3(0, 1, 0)), 44);
    out->camera.znear = 0.4;
    out->camera.zfar = 140;

    stage_place(out, d->backdrop, xform_move(eye.x, 0, eye.z));
    demo_track_place(out, d->track, LOOP_LENGTH, x, 98);

    double sway = 0.12 * sin(phase), yaw = 0.035 * cos(phase);
    struct xform car = xform_mul(xform_move(x + 0.10 * sin(2 * phase), 0, -0.2 - sway),
                                 xform_turn_y(yaw));
    demo_car_place(out, d->car, car, x, 1.6 * yaw);

    struct xform drone = xform_move(x - 1.9 + 0.30 * cos(phase), 2.72 + 0.16 * sin(2 * phase),
                                    0.3 + 0.65 * sin(phase));
    drone = xform_mul(drone, xform_turn_x(0.30 + 0.24 * cos(phase)));
    drone = xform_mul(drone, xform_turn_z(-0.38));
    /* 72 degrees per frame: twelve whole turns per loop. */
    demo_drone_place(out, d->drone, drone, 12 * phase);
}

/* A still camera beside the track: the drone swings to and fro, the car rushes by once per loop. */
static void drone_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct demo *d = stage->extra;
    double loops = time / LOOP_SECONDS, phase = 2 * PI * loops;
    struct vec3 eye = vec3(1.2, 1.7, 5.2);
    stage_camera(out, xform_look(eye, vec3(-0.6, 1.92, -0.8), vec3(0, 1, 0)), 46);
    out->camera.znear = 0.4;
    out->camera.zfar = 140;
    stage_place(out, d->backdrop, xform_move(eye.x, 0, eye.z));
    demo_track_place(out, d->track, LOOP_LENGTH, 0, 2.5 * LOOP_LENGTH);

    double lap = floor(loops + 0.5), x = LOOP_LENGTH * (loops - lap);
    demo_car_place(out, d->car, xform_move(x, 0, -1.9), x, 0);
    for (int i = 0; i < CAR_PROPS; i++)
        out->draw[d->car + i].epoch = (int)fmod(lap, 1000);

    double swing = sin(2 * phase), speed = cos(2 * phase);
    struct xform drone = xform_move(-0.25 + 1.25 * swing, 2.75 + 0.22 * sin(4 * phase),
                                    0.6 - 0.45 * speed);
    drone = xform_mul(drone, xform_mul(xform_turn_x(0.42), xform_turn_z(0.30 * swing)));
    demo_drone_place(out, d->drone, drone, 12 * phase);
}

static const struct stage_kind demo_kinds[] = {
    {"demo/race", 320, 240, 10 / 30.0, 0x9fd0ee, build_all, race_move},
    {"demo/drone", 240, 240, 1 / 30.0, 0x9fd0ee, build_all, drone_move},
};

bool demo_make(const char *name, struct scene *out, struct failure *f)
{
    if (!stage_open(demo_kinds, sizeof demo_kinds / sizeof *demo_kinds, name, out, f))
        return false;
    out->loop = LOOP_SECONDS;
    return true;
}
