/* SPDX-License-Identifier: MIT */
/* kinds.c - the table of kinds.h. */
#include "tools/bench/kinds.h"

#include <string.h>

#define KIND(name, group) { "suite/" name, name, group }

const struct kind kinds[KINDS] = {
    KIND("translate", GROUP_OBJECT), KIND("propeller", GROUP_OBJECT), KIND("cross", GROUP_OBJECT),
    KIND("fence_obj", GROUP_OBJECT), KIND("enter", GROUP_OBJECT),     KIND("near", GROUP_OBJECT),
    KIND("long", GROUP_OBJECT),      KIND("skin", GROUP_OBJECT),      KIND("swarm", GROUP_OBJECT),
    KIND("teleport", GROUP_OBJECT),  KIND("morph", GROUP_OBJECT),     KIND("cubic", GROUP_OBJECT),
    KIND("pan", GROUP_CAMERA),       KIND("dolly", GROUP_CAMERA),     KIND("roll", GROUP_CAMERA),
    KIND("fence_fg", GROUP_CAMERA),  KIND("textured", GROUP_CAMERA),  KIND("arena", GROUP_CAMERA),
    KIND("subpixel", GROUP_CAMERA),  KIND("still", GROUP_STILL),
};

const char *const kind_group_name[GROUPS] = { "object", "camera", "still" };

int kind_find(const char *name)
{
    for (int i = 0; i < KINDS; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return i;
    return -1;
}
