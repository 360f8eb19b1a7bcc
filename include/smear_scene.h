/* SPDX-License-Identifier: MIT */
/* smear_scene.h - what a scene may have beyond meshes and one light, each at no cost where it is null.
 *
 *     smear_sky sky = { 0 };
 *     smear_scene scene = { 0 };
 *     scene.sky = &sky;
 *     frame.scene = &scene;               // and smear_begin, smear_submit, smear_render as ever
 *
 * All of it is copied by smear_begin. Colours are 0xRRGGBB, sRGB-encoded; light is linear, 65535 is one. */
#ifndef SMEAR_SCENE_H
#define SMEAR_SCENE_H

#include "smear.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct smear_sky smear_sky;
typedef struct smear_lights smear_lights;

struct smear_scene {
    const smear_sky *sky;               /* in place of frame.clear; null: none. SMEAR_WITH_SKY */
    const smear_lights *lights;         /* beside frame.light; null: none. SMEAR_WITH_LIGHTS */
};

#ifdef __cplusplus
}
#endif

#endif
