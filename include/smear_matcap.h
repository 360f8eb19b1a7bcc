/* SPDX-License-Identifier: MIT */
/* smear_matcap.h - surfaces that look polished, for the price of a texture: each vertex takes the texel that a picture of a ball of
 * the same stuff has where the ball's surface faces the same way. The field calls such a picture a matcap. Header only; the library
 * does not know of it.
 *
 *     static int16_t uv[2 * VERTICES];                    // of this draw; read until smear_render returns
 *     smear_mesh polished = mesh;                         // a mesh with normals
 *     polished.uv = uv, polished.uv_shift = 15;
 *     material.texture = &chrome, material.unlit = 1;     // the ball fills the picture; row 0 is its top
 *     smear_matcap_uv(uv, &polished, &place, &camera);
 *
 * The ball is where the draw's origin is and is seen from the eye, so that what flies by the eye is not seen askew. All methods blur
 * such a draw as any other; what it mirrors is that of the pose it is given, as light is. Backs of double-sided materials show what
 * fronts do. With smear_desc.reuse, a frame whose uv has changed and whose draw stands still says so: smear_frame.refresh. */
#ifndef SMEAR_MATCAP_H
#define SMEAR_MATCAP_H

#include "smear_math.h"

/* Names that begin with smear_matcap_ and end with _ serve this header only. */

/* Finds what turns normals to the world: the cofactors of the basis, times any positive factor, q14 at most. Returns whether the
 * basis only turns and scales alike, to within a 64th: then lengths of normals stay alike, too. */
static inline int smear_matcap_turn_(int32_t turn[9], const smear_transform *place)
{
    int32_t b[9], dot[6], sign = 0, up = 0, down = 0;
    uint32_t all = 1;
    int i, j;
    for (i = 0; i < 9; i++)
        all |= place->basis[i] < 0 ? 0u - (uint32_t)place->basis[i] : (uint32_t)place->basis[i];
    while (all >> down >= 1u << 14)
        down++;
    while (all << up < 1u << 13)
        up++;
    for (i = 0; i < 9; i++)
        b[i] = (place->basis[i] >> down) * (1 << up);
    for (i = 0; i < 3; i++)
        for (j = 0; j < 3; j++) {
            const int i1 = 3 * ((i + 1) % 3), i2 = 3 * ((i + 2) % 3), j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            turn[3 * i + j] = (b[i1 + j1] * b[i2 + j2] - b[i1 + j2] * b[i2 + j1]) >> 15;
        }
    for (j = 0; j < 3; j++)     /* its determinant: a mirrored mesh has its normals the other way round */
        sign += (b[j] >> 1) * (turn[j] >> 1) / 2;
    for (i = 0; i < 9 && sign < 0; i++)
        turn[i] = -turn[i];
    for (i = 0; i < 3; i++) {
        const int k = (i + 1) % 3;
        dot[i] = b[i] * b[i] + b[3 + i] * b[3 + i] + b[6 + i] * b[6 + i];
        dot[3 + i] = b[i] * b[k] + b[3 + i] * b[3 + k] + b[6 + i] * b[6 + k];
    }
    for (i = 1; i < 6; i++) {
        const int32_t off = i < 3 ? dot[i] - dot[0] : dot[i];
        if (off > dot[0] >> 6 || off < -(dot[0] >> 6))
            return 0;
    }
    return 1;
}

/* Turns an axis of the world to the mesh's own space: q20, of length one. */
static inline void smear_matcap_axis_(int32_t axis[3], const int32_t turn[9], const smear_transform *seen, int column, int is_even)
{
    int i;
    for (i = 0; i < 3; i++)
        axis[i] = smear_math_narrow(((int64_t)turn[i] * seen->basis[column] + (int64_t)turn[3 + i] * seen->basis[3 + column]
                                     + (int64_t)turn[6 + i] * seen->basis[6 + column]) >> 14);
    if (is_even && smear_math_normalize(axis, 3))
        for (i = 0; i < 3; i++)
            axis[i] = (axis[i] + 512) >> 10;
}

/* Writes u and v of every vertex of a mesh with normals, in 1/2^15 of the texture: a ball that reaches to .496 from the middle, which
 * leaves half a texel of 128 at its rim. They err by less than 1/300 of the texture. Where the basis scales alike it takes some 64
 * instructions a vertex on a Cortex-M0+, else some 1,100. `place` and `camera` are those of the frame to come; null: the identity. */
static inline void smear_matcap_uv(int16_t *uv, const smear_mesh *mesh, const smear_transform *place, const smear_camera *camera)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    const smear_transform *at = place != 0 ? place : &identity, *pose = &camera->pose;
    smear_transform seen = *pose;
    int32_t turn[9], x[3], y[3], z[3];
    const int is_even = smear_matcap_turn_(turn, at);
    const int8_t *n = mesh->normal, *end = n + 3 * (size_t)mesh->vertex_count;
    if (camera->half_height == 0)
        seen = smear_look_at(smear_vec(pose->origin[0], pose->origin[1], pose->origin[2]),
                             smear_vec(at->origin[0], at->origin[1], at->origin[2]),
                             smear_vec(pose->basis[1], pose->basis[4], pose->basis[7]));
    smear_matcap_axis_(x, turn, &seen, 0, is_even);
    smear_matcap_axis_(y, turn, &seen, 1, is_even);
    smear_matcap_axis_(z, turn, &seen, 2, is_even);
    for (; n < end && is_even; n += 3, uv += 2) {       /* 127 x 128 of 2^15 from the middle */
        uv[0] = (int16_t)(16384 + ((n[0] * x[0] + n[1] * x[1] + n[2] * x[2]) >> 13));
        uv[1] = (int16_t)(16384 - ((n[0] * y[0] + n[1] * y[1] + n[2] * y[2]) >> 13));
    }
    for (; n < end; n += 3, uv += 2) {
        int32_t v[3];
        v[0] = smear_math_narrow(((int64_t)n[0] * x[0] + (int64_t)n[1] * x[1] + (int64_t)n[2] * x[2]) >> 9);
        v[1] = smear_math_narrow(((int64_t)n[0] * y[0] + (int64_t)n[1] * y[1] + (int64_t)n[2] * y[2]) >> 9);
        v[2] = smear_math_narrow(((int64_t)n[0] * z[0] + (int64_t)n[1] * z[1] + (int64_t)n[2] * z[2]) >> 9);
        smear_math_normalize(v, 3);
        uv[0] = (int16_t)(16384 + (int32_t)((int64_t)v[0] * 16256 >> 30));
        uv[1] = (int16_t)(16384 - (int32_t)((int64_t)v[1] * 16256 >> 30));
    }
}

#endif
