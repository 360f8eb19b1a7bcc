/* SPDX-License-Identifier: MIT */
/* scene.c - what a frame's scene may have. */
#include "others.h"
#include "smear_scene.h"
#include "validate.h"

#if SMEAR_WITH_SKY || SMEAR_WITH_LIGHTS

int smear_scene_check(const smear_scene *scene)
{
    const bool missing = (!SMEAR_WITH_SKY && scene->sky != NULL) || (!SMEAR_WITH_LIGHTS && scene->lights != NULL);
    const bool unkind = SMEAR_WITH_SKY && scene->sky != NULL && scene->sky->kind == NULL;
    if (SMEAR_WITH_LIGHTS && scene->lights != NULL && (scene->lights->shader == NULL || scene->lights->reach < 0))
        return FAULT(FRAME_LIGHTS);
    return missing || unkind ? FAULT(FRAME_SCENE) : SMEAR_OK;
}

#endif
