/* SPDX-License-Identifier: MIT */
/* kinds.c - the table of kinds.h. */
#include "tools/bench/kinds.h"

#include <string.h>

#define KIND(name, group) { "suite/" name, name, group, -1, NULL }

const struct kind kinds[ALL_KINDS] = {
    KIND("translate", GROUP_OBJECT), KIND("propeller", GROUP_OBJECT), KIND("cross", GROUP_OBJECT),
    KIND("fence_obj", GROUP_OBJECT), KIND("enter", GROUP_OBJECT),     KIND("near", GROUP_OBJECT),
    KIND("long", GROUP_OBJECT),      KIND("skin", GROUP_OBJECT),      KIND("swarm", GROUP_OBJECT),
    KIND("teleport", GROUP_OBJECT),  KIND("morph", GROUP_OBJECT),     KIND("cubic", GROUP_OBJECT),
    KIND("pan", GROUP_CAMERA),       KIND("dolly", GROUP_CAMERA),     KIND("roll", GROUP_CAMERA),
    KIND("fence_fg", GROUP_CAMERA),  KIND("textured", GROUP_CAMERA),  KIND("arena", GROUP_CAMERA),
    KIND("subpixel", GROUP_CAMERA),  KIND("still", GROUP_STILL),
    { "demo/race", "race-4", GROUP_DEMO, 4, NULL },
    { "demo/race", "race-20", GROUP_DEMO, 20, NULL },
    { "demo/race", "race-40", GROUP_DEMO, 40, NULL },
    { "demo/drone", "drone", GROUP_DEMO, 12, NULL },
    { "own/fan.glb", "fan", GROUP_MODEL, 3, NULL },
    { "quaternius/RobotExpressive.glb", "robot", GROUP_MODEL, 7, "Running" },
    { "khronos/Fox.glb", "fox", GROUP_MODEL, 7, "Run" },
};

const char *const kind_group_name[GROUPS] = { "object", "camera", "still", "demo", "model" };

int kind_find(const char *name)
{
    for (int i = 0; i < ALL_KINDS; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return i;
    return -1;
}
