/* SPDX-License-Identifier: MIT */
/* lights.h - what the core asks of scene/lights.c: where smear_scene.lights are given, they shade in place of light.c. Found by their
 * field `shader` alone: a program that names it nowhere has none of it. */
#ifndef SMEAR_LIGHTS_H
#define SMEAR_LIGHTS_H

#include "smear_scene.h"

#include "base/base.h"

struct smear_assembly;
struct smear_color;
struct smear_face;
struct smear_sun;

/* smear_lights as a frame has them, by word: of length one, q14, towards the second light, and where highlights lie; else q16. */
enum { LIGHTS_SECOND, LIGHTS_HALF = 3, LIGHTS_LAMP = 6, LIGHTS_REACH = 9, LIGHTS_DIFFUSE, LIGHTS_LAMP_DIFFUSE = 13, LIGHTS_WORDS = 16 };
struct smear_lights_used {
    const struct smear_shader *by;
    int32_t word[SMEAR_WITH_LIGHTS ? LIGHTS_WORDS : 1];
};

/* The lights seen by a draw: from its object space, where normals are those of vertices and the basis keeps their length, else from
 * the world. Ways to the lamp are in units of which its reach has 13 to 14 bits: from p (int16 each) lamp - (p << up >> down), in the
 * world lamp - (step p >> down), p in thirds of the mesh's steps. */
struct smear_lights_seen {
    const struct smear_lights_used *used;
#if SMEAR_WITH_LIGHTS
    bool even, has_second, has_lamp, near, is_white;
    uint8_t gloss, shine, up, down;
    int32_t lamp[3], reach;
    uint32_t square, share, gain;   /* of the reach; 2^44 / square; of lamp_light */
    int32_t white[6], ambient;      /* the sun and `second` times what they are, where all lights are white */
    const int8_t *normal;
    const int16_t *position;
    const uint8_t *color;
    int32_t second[3], half[3], step[9];        /* directions are q23 / 127; in the world q14 */
#endif
    void (*vertex)(struct smear_color *out, const struct smear_assembly *d, uint32_t index, const struct smear_face *face);
};

/* begin: makes those of a frame. draw: of a draw whose shading is made; false where it has none but the sun. face, and of a draw
 * vertex: shade as smear_shade does. */
struct smear_shader {
    const struct smear_lights_used *(*begin)(struct smear_lights_used *used, const smear_lights *lights, const struct smear_sun *sun,
                                             const smear_camera *camera);
    bool (*draw)(struct smear_lights_seen *seen, const struct smear_lights_used *used, const struct smear_assembly *d,
                 const smear_transform *object);
    void (*face)(struct smear_color *out, const struct smear_assembly *d, const struct smear_face *face);
};

#endif
