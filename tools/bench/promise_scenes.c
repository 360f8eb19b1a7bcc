/* SPDX-License-Identifier: MIT */
/* promise_scenes.c - the table of promise.h. */
#include "tools/bench/promise.h"

#define SUITE(name) { "suite/" name, NULL, -1, PROMISE_SUITE, false }
#define SUITE_HELD(name) { "suite/" name, NULL, -1, PROMISE_SUITE, true }

const struct promise_scene promise_scenes[] = {
    SUITE("translate"), SUITE_HELD("propeller"), SUITE("cross"),    SUITE("fence_obj"), SUITE("enter"),
    SUITE("near"),      SUITE("long"),           SUITE("skin"),     SUITE_HELD("swarm"), SUITE("teleport"),
    SUITE("morph"),     SUITE_HELD("cubic"),     SUITE("pan"),      SUITE("dolly"),     SUITE("roll"),
    SUITE("fence_fg"),  SUITE_HELD("textured"),  SUITE_HELD("arena"), SUITE("subpixel"),
    { "demo/race", NULL, 4, PROMISE_HERO, false },
    { "demo/race", NULL, 20, PROMISE_HERO, true },
    { "demo/race", NULL, 40, PROMISE_HERO, false },
    { "demo/drone", NULL, 12, PROMISE_HERO, false },
    { "own/fan.glb", NULL, 3, PROMISE_MODEL, false },
    { "quaternius/RobotExpressive.glb", "Running", 7, PROMISE_MODEL, true },
    { "khronos/Fox.glb", "Run", 7, PROMISE_MODEL, false },
};
const int promise_scene_count = sizeof promise_scenes / sizeof *promise_scenes;
