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
};

const int scene_catalog_count = sizeof scene_catalog / sizeof *scene_catalog;

bool scene_builtin(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < scene_catalog_count; i++)
        if (strcmp(scene_catalog[i].name, name) == 0)
            return scene_catalog[i].make(name, out, f);
    return fail(f, "there is no built-in scene of this name");
}
