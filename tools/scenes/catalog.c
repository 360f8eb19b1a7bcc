/* SPDX-License-Identifier: MIT */
/* catalog.c - every built-in scene by name. */
#include "builtin.h"
#include "failures.h"

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
    {"fail/rotation", "1: a wheel turns by 45 degrees", failure_make},
    {"fail/curve", "2: a square on a parabola", failure_make},
    {"fail/long", "3: a streak of 72 px", failure_make},
    {"fail/opposite", "4: two bars that cross", failure_make},
    {"fail/slow", "5: a disc rushes over small print", failure_make},
    {"fail/thin", "6: bars of 1.5 px", failure_make},
    {"fail/fence", "7: a still fence before a pan", failure_make},
    {"fail/edge", "8: a disc before a still background", failure_make},
    {"fail/sprites", "9: two sprites at one depth", failure_make},
    {"fail/enter", "10: a bar comes into the frame", failure_make},
    {"fail/enter_inside", "10: the same away from the edge", failure_make},
    {"fail/near", "11: a quad comes from behind the eye", failure_make},
    {"fail/pass", "11: a quad goes past the eye", failure_make},
    {"fail/teleport", "12: half a screen at once, told", failure_make},
    {"fail/jump", "12: the same, not told", failure_make},
    {"fail/cut", "12: camera cut", failure_make},
    {"fail/spawn", "13: things that appear", failure_make},
    {"fail/hidden", "14: a square uncovers fine texture", failure_make},
    {"fail/pane", "15: a pane of glass over a pan", failure_make},
    {"fail/leaf", "16: a leaf half of which is holes", failure_make},
    {"fail/billboard", "17: a billboard and a flag, the camera orbits", failure_make},
    {"fail/light", "18: nothing moves but the light", failure_make},
    {"fail/seams", "19: a slow disc over the borders of tiles", failure_make},
    {"fail/jitter", "20: a plain disc in steady motion", failure_make},
    {"fail/rate", "21: a bar at 720 px per second", failure_make},
    {"fail/strobe", "22: a bar of 4 px that goes 20 px per frame", failure_make},
    {"fail/subpixel", "23: a patch that goes up to 4 px", failure_make},
    {"fail/subpan", "23: a pan of up to 4 px", failure_make},
    {"fail/still", "24: nothing moves", failure_make},
    {"fail/sweep", "24: pans in all directions", failure_make},
    {"fail/ground", "25: a slanted ground, sideways", failure_make},
    {"fail/tiny", "26: for frames of a few pixels", failure_make},
    {"fail/roll", "27: the camera rolls by 20 degrees", failure_make},
    {"fail/zoom", "28: a wall comes nearer behind a still inset", failure_make},
    {"fail/sky", "29: ground, posts and stars, the camera turns", failure_make},
    {"fail/attached", "30: a car that the camera takes along", failure_make},
    {"fail/stop", "31: a square that stops", failure_make},
    {"fail/arm", "32: an arm bends, a ball is stretched", failure_make},
    {"fail/layers", "34: behind one bar and before another", failure_make},
    {"fail/ghosts", "35: white over black, 40 px", failure_make},
    {"fail/far", "36: a car and a camera that can be far away", failure_make},
};

const int scene_catalog_count = sizeof scene_catalog / sizeof *scene_catalog;

bool scene_builtin(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < scene_catalog_count; i++)
        if (strcmp(scene_catalog[i].name, name) == 0)
            return scene_catalog[i].make(name, out, f);
    return fail(f, "there is no built-in scene of this name");
}
