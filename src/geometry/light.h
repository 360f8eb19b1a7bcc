/* SPDX-License-Identifier: MIT */
/* light.h - colours of vertices and faces: factor x vertex colour x one directional light, per vertex. */
#ifndef SMEAR_LIGHT_H
#define SMEAR_LIGHT_H

#include "smear.h"

#include "base/pixel.h"
#include "geometry/lights.h"

/* smear_light as it is used. */
struct smear_sun {
    int32_t direction[3];           /* towards the light in the world, of length one, q14 */
    int32_t ambient[3], diffuse[3]; /* r g b, linear, q16 */
    bool white;                     /* r g b alike */
    const struct smear_lights_used *lights;     /* further ones, or null */
};

/* `light`: null for SMEAR_LIGHT_DEFAULT. */
void smear_sun_make(struct smear_sun *sun, const smear_light *light);

/* Brings a direction to length one, q14. */
void smear_unit_direction(int32_t out[3], const int32_t in[3]);

/* Finds the normal of a face with these edges, of 14 bits. */
void smear_face_normal(int32_t n[3], const int32_t u[3], const int32_t v[3]);

/* What was found of the face before: faces of a box, say, come in pairs with one normal and one colour. */
struct smear_lit {
    int32_t normal[3];              /* of any length; INT32_MAX first: none */
    uint32_t cosine;
    const uint8_t *color;           /* of the face whose colour is `packed`; null: none */
    uint32_t color_cosine, packed;
};

/* The light seen from a draw's object space. */
struct smear_shading {
    const struct smear_sun *sun;
    int32_t normal_matrix[3][3];    /* cofactors of the basis, 15 bits: world
                                     * normal = matrix x object normal */
    int32_t direction[3];           /* q23 / 127: I = sum n_j direction_j for int8 normals, where even */
    bool even;                      /* rotation and uniform scale only: normals keep their length */
    uint8_t lit;                    /* 2: by further lights, where the draw sees any */
    smear_transfer transfer;
    bool white;                     /* base is one throughout */
    u16lin base[4];                 /* material factor; base[3] is alpha */
    struct smear_lit *last;         /* or null */
};

/* Further lights than the sun shine on it. */
static inline bool shading_has_lights(const struct smear_shading *s) { return SMEAR_WITH_LIGHTS && s->lit > 1; }
static inline bool shading_is_linear(const struct smear_shading *s) { return transfer_is_linear(s->transfer); }

/* A colour ready for interpolation: r g b in working values (linear: 65535 is one; encoded: code x 256), alpha 65535 is one. */
struct smear_color {
    uint16_t channel[4];
};

/* Makes a draw's shading; with has_normals, smear_light_normal() may be asked. */
void smear_shading_make(struct smear_shading *s, const smear_transform *object,
                        const smear_material *material, bool has_normals, smear_transfer transfer, const struct smear_sun *sun);

/* Returns max(0, n.l), 0 .. 65536, for an object-space normal of length 127. */
uint32_t smear_light_normal(const struct smear_shading *s, const int8_t normal[3]);

/* Returns max(0, n.l) for the face of three vertices, counter-clockwise in front (in object space). */
uint32_t smear_light_face(const struct smear_shading *s, const int16_t a[3], const int16_t b[3],
                          const int16_t c[3]);

/* Shades: factor x color (sRGB r g b and alpha; null: white) x (ambient + diffuse x cosine), cosine 0 .. 65536. */
void smear_shade(struct smear_color *out, const struct smear_shading *s, const uint8_t color[4],
                 const uint8_t face_color[4], uint32_t cosine);

/* Returns a b, where 65535 is one. */
static inline uint32_t times_lin(uint32_t a, uint32_t b)
{
    return a * (b + (b >> 15)) >> 16;
}

/* Encodes linear light. Colours of vertices and faces alone do not want a table of 4 kB. */
static inline uint32_t light_encode(uint32_t light)
{
    return SMEAR_WITH_LINEAR ? smear_srgb_encode[light] : srgb_encode_searched(light);
}

/* Returns what a channel of material, vertex and face is together, 65535 is one; null: white. */
static inline uint32_t shading_channel(const struct smear_shading *s, int i, const uint8_t *color, const uint8_t *face_color)
{
    uint32_t c = s->base[i];
    if (color != NULL)
        c = times_lin(c, smear_srgb_decode[color[i]]);
    return face_color != NULL ? times_lin(c, smear_srgb_decode[face_color[i]]) : c;
}

static inline uint16_t shading_alpha(const struct smear_shading *s, const uint8_t *color, const uint8_t *face_color)
{
    uint32_t alpha = s->base[3];
    if (color != NULL)
        alpha = times_lin(alpha, color[3] * 257u);
    return (uint16_t)(face_color != NULL ? times_lin(alpha, face_color[3] * 257u) : alpha);
}

/* Returns a channel of linear light as a working value. */
static inline uint16_t shading_value(const struct smear_shading *s, uint32_t c)
{
    c = min_u32(c, 65535u);
    return shading_is_linear(s) ? (uint16_t)c : (uint16_t)(light_encode(c >> 4) * 256u);
}

/* Packs a colour into 0xAARRGGBB, r g b as sRGB codes. */
uint32_t smear_color_pack(const struct smear_color *color, smear_transfer transfer);

#endif
