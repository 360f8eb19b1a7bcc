/* SPDX-License-Identifier: MIT */
/* catalog.c - every built-in scene by name. */
#include "builtin.h"

#include <string.h>

const struct scene_entry scene_catalog[] = {
    {"demo/race", "racing car chased by a drone, loops after 60 frames", demo_make},
    {"demo/drone", "drone and passing car before a still camera, loops after 60 frames", demo_make},
    {"peer/A", "70,000 Gouraud triangles of a pixel", peer_make},
    {"peer/B64", "room with pillars, 64x64 texture", peer_make},
    {"peer/B256", "room with pillars, 256x256 texture", peer_make},
    {"peer/C", "twenty textured layers over the whole screen", peer_make},
    {"peer/D", "51,200 flat triangles of a pixel or two", peer_make},
    {"peer/E", "64 flat icosahedra", peer_make},
    {"peer/N", "textured floor that passes behind the camera", peer_make},
    {"suite/translate", "an aeroplane flies along a line", suite_make},
    {"suite/propeller", "blades turn", suite_make},
    {"suite/pan", "the camera turns about y", suite_make},
    {"suite/dolly", "the camera drives between columns", suite_make},
    {"suite/roll", "the camera turns about its line of sight", suite_make},
    {"suite/cross", "two movers whose paths cross", suite_make},
    {"suite/fence_fg", "a still fence before a background that pans", suite_make},
    {"suite/fence_obj", "a ball rolls behind a fence", suite_make},
    {"suite/enter", "movers come into the frame", suite_make},
    {"suite/near", "a lorry passes through the near plane", suite_make},
    {"suite/long", "streaks of 72 and 92 pixels", suite_make},
    {"suite/subpixel", "motion of about half a pixel", suite_make},
    {"suite/skin", "a figure of bending limbs", suite_make},
    {"suite/swarm", "64 small balls", suite_make},
    {"suite/still", "nothing moves", suite_make},
    {"suite/teleport", "a car is put elsewhere just before the exposure", suite_make},
    {"suite/textured", "texels everywhere, camera and crate move", suite_make},
    {"suite/morph", "from one shape to another", suite_make},
    {"suite/cubic", "a ball on a curve", suite_make},
    {"suite/arena", "a frame of a game: cars, a boom, a slow camera", suite_make},
    {"test/floor256", "panels close behind each other, far plane at 256 near planes", trial_make},
    {"test/floor1000", "the same at 1000 near planes", trial_make},
    {"test/soup", "360 triangles at random, Gouraud", trial_make},
    {"test/room", "textured walls in perspective, all wrap modes", trial_make},
    {"test/slivers", "triangles thinner than a pixel", trial_make},
    {"test/boxes", "boxes that stick in each other", trial_make},
    {"test/leaves", "cutouts and panes of glass", trial_make},
    {"test/terrain", "hills that cross the near plane", trial_make},
    {"test/ortho", "orthographic, mirrored and double-sided", trial_make},
};

const int scene_catalog_count = sizeof scene_catalog / sizeof *scene_catalog;

bool scene_builtin(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < scene_catalog_count; i++)
        if (strcmp(scene_catalog[i].name, name) == 0)
            return scene_catalog[i].make(name, out, f);
    return fail(f, "there is no built-in scene of this name");
}
