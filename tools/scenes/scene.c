/* SPDX-License-Identifier: MIT */
/* scene.c - the calls that every scene answers. */
#include "tools/scenes/scene.h"

#include <math.h>

bool scene_pose(struct scene *scene, double time, struct scene_instant *out, struct failure *f)
{
    return scene_pose_joined(scene, time, time, out, f);
}

bool scene_pose_joined(struct scene *scene, double time, double now, struct scene_instant *out, struct failure *f)
{
    if (!isfinite(time) || !isfinite(now))
        return fail(f, "time is not a finite number");
    out->time = time;
    out->now = now;
    return scene->pose(scene, time, out, f);
}

void scene_instant_free(struct scene *scene, struct scene_instant *instant)
{
    if (scene->instant_free != NULL)
        scene->instant_free(scene, instant);
    *instant = (struct scene_instant){0};
}

void scene_free(struct scene *scene)
{
    if (scene->destroy != NULL)
        scene->destroy(scene);
    *scene = (struct scene){0};
}
