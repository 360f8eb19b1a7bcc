/* SPDX-License-Identifier: MIT */
/* failures.h - scenes fail/..., each the smallest in which a kind of motion blur is known to go
 * wrong; tests/suite/test_failures.c measures what does. Host only.
 *
 * Flat scenes have one unit per pixel, the origin in the middle, +Y up. The frame that stands for
 * a scene is at FAIL_TIME, and `shutters` counts time from there in whole frames, so that with a
 * shutter of 360 degrees lengths below are those of streaks. */
#ifndef SMEAR_TOOLS_SCENES_FAILURES_H
#define SMEAR_TOOLS_SCENES_FAILURES_H

#include "tools/scenes/build.h"
#include "tools/scenes/stage.h"

bool failure_make(const char *name, struct scene *out, struct failure *f);

#define FAIL_TIME 0.5
#define FAIL_FPS 30.0

/* What tests measure along; pixels. */
enum {
    FAIL_WHEEL_RADIUS = 60,
    FAIL_LONG_RADIUS = 16, FAIL_LONG_STREAK = 72,
    FAIL_SLOW_RADIUS = 20, FAIL_SLOW_STREAK = 60,
    FAIL_PICKET = 8, FAIL_PICKET_PITCH = 24,
    FAIL_EDGE_RADIUS = 30,
    FAIL_SPRITE_HALF = 16,
    FAIL_ENTER_STREAK = 40, FAIL_ENTER_ASIDE = 80,
    FAIL_JUMP_HALF = 20, FAIL_JUMP_FRAME = 3,
    FAIL_SPAWN_FRAME = 5, FAIL_SPAWN_GONE = 8, FAIL_SPAWN_AGAIN = 10,
    FAIL_HIDDEN_HALF = 20, FAIL_HIDDEN_STREAK = 32,
    FAIL_PANE_HALF = 30, FAIL_PANE_STREAK = 20,
    FAIL_LEAF_HALF = 32,
    FAIL_SEAMS_FRAMES = 64,
    FAIL_STROBE_STEP = 20, FAIL_STROBE_WIDTH = 4,
    FAIL_SWEEP_LAPS = 24,
    FAIL_INSET_HALF = 24,
    FAIL_STOP_FRAME = 10,
    FAIL_LAYER_STREAK = 24, FAIL_LAYER_BAR = 16, FAIL_LAYER_BAR_X = 24,
    FAIL_GHOST_STREAK = 40,
    FAIL_FAN_RADIUS = 46, FAIL_FAN_ASIDE = 28,
    FAIL_ROTOR_RADIUS = 64,
    FAIL_ROLLING_RADIUS = 36
};

/* Pixels per second of fail/rate. */
#define FAIL_RATE_SPEED 720.0

/* Parts of the family. */
extern const struct stage_kind failure_flat_kinds[], failure_space_kinds[];
extern const int failure_flat_count, failure_space_count;

/* Frames since the one that stands for the scene. */
double fail_shutters(double time);

/* Value noise of two octaves, 32 and 8 texels wide, between two colours; 256 texels square, without
 * a seam. */
const struct image *fail_noise(struct stage *stage, uint32_t seed, uint32_t dark, uint32_t light);

/* An upright plane about the origin, `scale` units per texel of the repeated picture. */
int fail_plane(struct stage *stage, const struct image *image, double half_width,
               double half_height, double scale);

/* An unlit upright rectangle about the origin. */
int fail_rectangle(struct stage *stage, double half_width, double half_height, uint32_t rgb);

/* The surface, unlit. */
struct scene_surface *fail_unlit(struct build *b);

#endif
