/* SPDX-License-Identifier: MIT */
/* builtin.c - finds a built-in scene in the catalog that is linked. */
#include "tools/scenes/scene.h"

#include <string.h>

bool scene_builtin(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < scene_catalog_count; i++)
        if (strcmp(scene_catalog[i].name, name) == 0)
            return scene_catalog[i].make(name, out, f);
    return fail(f, "there is no built-in scene of this name");
}
