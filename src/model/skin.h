/* SPDX-License-Identifier: MIT */
/* skin.h - posed vertices: morph targets and skins, in steps of the mesh. It belongs to the optional animation
 * (anim.c). */
#ifndef SMEAR_SKIN_H
#define SMEAR_SKIN_H

#include "smear_model.h"

#include "base/fixed.h"

/* The matrix from steps of the mesh at rest to steps of the posed mesh. Each row has its basis, Q14 with
 * |entry| <= SMEAR_JOINT_LIMIT so that it times a vertex stays below 2^31, then its origin in 1/16 step, +-2^22. */
struct smear_joint_matrix {
    int32_t row[3][4];
};

#define SMEAR_JOINT_LIMIT 21845
#define SMEAR_JOINT_ORIGIN_LIMIT (1 << 22)

/* The joints of `count` vertices, as smear_model_draw.influence_first has them; `per_vertex` is 1..4. */
struct smear_influences {
    const uint8_t *at;
    uint32_t per_vertex;
    uint32_t count;
};

/* Poses positions, which are clamped to int16; `out` may be `in`. It takes 12 products per vertex and joint, none of
 * them wide. */
void smear_skin_positions(int16_t *out, const int16_t *in, const struct smear_influences *influences,
                          const struct smear_joint_matrix *joint);

/* Poses normals, which come out with length 127 (0 stays 0); exact for joints that turn, move and scale evenly. */
void smear_skin_normals(int8_t *out, const int8_t *in, const struct smear_influences *influences,
                        const struct smear_joint_matrix *joint);

/* Add weight (q14) x the target's deltas. */
void smear_morph_positions(int16_t *position, const smear_model_target *target,
                           const smear_model_delta *delta, int16_t weight);
void smear_morph_normals(int8_t *normal, const smear_model_target *target, const smear_model_delta *delta,
                         const int8_t *delta_normal, int16_t weight);

/* Brings normals back to length 127. */
void smear_unit_normals(int8_t *normal, uint32_t count);

#endif
