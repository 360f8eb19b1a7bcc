/* SPDX-License-Identifier: MIT */
/* catalog.c - the built-in scenes of the page: those that are to be looked at. In place of
 * tools/scenes/catalog.c. */
#include "tools/scenes/builtin.h"

const struct scene_entry scene_catalog[] = {
    {"demo/race", "racing car chased by a drone", demo_make},
    {"demo/drone", "drone and passing car before a still camera", demo_make},
};

const int scene_catalog_count = sizeof scene_catalog / sizeof *scene_catalog;
