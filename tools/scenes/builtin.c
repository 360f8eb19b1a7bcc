/* SPDX-License-Identifier: MIT */
/* builtin.c - finds a built-in scene in the catalog that is linked. */
#include "tools/guess.h"
#include "tools/scenes/scene.h"

#include <string.h>

/* Those of the group that was asked for, before its slash, or a name of each group. */
static bool say_what_there_is(const char *name, struct failure *f)
{
    struct guess guess = { .word = name };
    char list[150] = "";
    size_t group = strcspn(name, "/"), used = 0;
    bool is_group = false;
    for (int i = 0; i < scene_catalog_count; i++)
        is_group = is_group || (strncmp(scene_catalog[i].name, name, group) == 0 && scene_catalog[i].name[group] == '/');
    for (int i = 0; i < scene_catalog_count; i++) {
        const char *other = scene_catalog[i].name, *before = i > 0 ? scene_catalog[i - 1].name : "";
        size_t length = strlen(other), own = strcspn(other, "/") + 1;
        if ((is_group ? strncmp(other, name, group) != 0 || other[group] != '/' : strncmp(other, before, own) == 0)
            || used + length + 3 > sizeof list)
            continue;
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used > 0 ? ", " : "", other);
    }
    for (int i = 0; i < scene_catalog_count; i++)
        guess_try(&guess, scene_catalog[i].name);
    if (guess.best != NULL)
        return fail(f, "no such built-in scene; did you mean builtin:%s? (smear info builtin:)", guess.best);
    return fail(f, "no such built-in scene: %s... (smear info builtin:)", list);
}

bool scene_builtin(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < scene_catalog_count; i++)
        if (strcmp(scene_catalog[i].name, name) == 0)
            return scene_catalog[i].make(name, out, f);
    return say_what_there_is(name, f);
}
