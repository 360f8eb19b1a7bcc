/* SPDX-License-Identifier: MIT */
/* smear_scene.h - what a scene may have beyond meshes and one light, each at no cost where it is null: skies, lights, shadows.
 *
 *     smear_sky sky = SMEAR_SKY(0x3060b0, 0xc0d8f0, 0x708060, 0x303820);
 *     smear_scene scene = { 0 };
 *     scene.sky = &sky;
 *     frame.scene = &scene;               // and smear_begin, smear_submit, smear_render as ever
 *
 * Lights are copied by smear_begin; a sky is read, and its `own` written, until smear_render returns. Colours are 0xRRGGBB,
 * sRGB-encoded; light is linear, 65535 is one. */
#ifndef SMEAR_SCENE_H
#define SMEAR_SCENE_H

#include "smear.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Lights beside frame.light, and highlights. What faces a light has all of it, diffuse x max(0, n.l); a surface shows base x (the sum
 * of all lights, not above one). Vertices with normals are lit one by one, faces without them by their middle.
 *
 * A lamp's light falls off smoothly: with t = distance / reach, what faces it has lamp_diffuse x 6.69 t (1 - t^2)^8:
 * all of it at a quarter of the reach, half at two fifths, none from the reach on; and less again close by, as of a lamp of some size.
 *
 * A material's highlight is added to that: frame.light's diffuse x gloss/255 x max(0, n.h)^(2^shine), where h lies between the light
 * and the camera's axis: as for an eye that is far away. A texture colours it as it does all light. */
typedef struct smear_lights {
    const struct smear_shader *shader;  /* &smear_lights_shader; required: what names it nowhere is not linked with it */
    int32_t direction[3];       /* towards a second light, in world space; any length */
    uint16_t diffuse[3];        /* its r g b, linear; 0: none */
    uint16_t lamp_diffuse[3];   /* the lamp's */
    int32_t lamp[3];            /* Q16.16: where it is in the world */
    int32_t reach;              /* Q16.16 world units; 0: no lamp */
} smear_lights;

extern const struct smear_shader smear_lights_shader;

typedef struct smear_sky_kind smear_sky_kind;

/* What is seen where nothing is drawn, as far up as the camera looks there. Codes change evenly with the sine of the elevation, from
 * the horizon to straight up and from it to straight down. Where both halves differ at the horizon, the border is one pixel
 * soft. It turns and is blurred with the camera, in every method. SMEAR_SKY makes one; two contexts take one each. */
typedef struct smear_sky {
    uint32_t zenith, horizon;           /* straight up, and above the horizon */
    uint32_t ground, nadir;             /* below the horizon, and straight down */
    int32_t own[22];                    /* the library's, from smear_begin to the end of the frame */
    const smear_sky_kind *kind;         /* &smear_sky_gradient; required: programs that do not name it do not have it */
} smear_sky;

extern const smear_sky_kind smear_sky_gradient;

#define SMEAR_SKY(zenith, horizon, ground, nadir) \
    { zenith, horizon, ground, nadir, { 0 }, &smear_sky_gradient }

struct smear_scene {
    smear_sky *sky;                     /* in place of frame.clear; null: none. SMEAR_WITH_SKY */
    const smear_lights *lights;         /* beside frame.light; null: none. SMEAR_WITH_LIGHTS */
};

/* ------------------------------------------------------------------ shadows */

/* A shadow is a draw of its own, submitted after what it falls on, with a material whose alpha is SMEAR_SHADOW: dark, unlit, and as
 * opaque as it shall be. However many triangles and shadows cover a pixel, it is as dark as the darkest of them makes it, and
 * none lies in what it falls on: it is in front of that by a 512th of the distance. All methods blur it by its own poses:
 *
 *     const smear_transform fall = smear_shadow_on(smear_vec(0, 0, 0), smear_vec(0, 1, 0), towards_light);
 *     const smear_transform place = smear_compose(fall, now);         // and likewise of earlier poses
 *     smear_draw shadow = { .id = 101, .mesh = draw.mesh, .material = &smear_shadow_material, .now = &place,
 *                           .path = SMEAR_PATH_LINE };
 *
 * flattens a mesh onto a plane; smear_blob and smear_blob_under make a round one under anything (smear_math.h). */

/* Black, a bit less than half opaque, for closed meshes; others are double_sided. A copy of a mesh without colours, normals and uv is
 * the same shadow, faster. */
extern const smear_material smear_shadow_material;

/* A disc of radius 1 about (0, 0, 0) that faces +Y, with a soft edge, as dark in the middle. */
extern const smear_mesh smear_blob;
extern const smear_material smear_blob_material;

#ifdef __cplusplus
}
#endif

#endif
