/* SPDX-License-Identifier: MIT */
/* matrix.h - from a draw's transform and a camera to the integer rows that project its vertices.
 *
 * This is done once per draw and pose, so 64-bit arithmetic is fine here; the rows need none. */
#ifndef SMEAR_MATRIX_H
#define SMEAR_MATRIX_H

#include "smear.h"

#include "base/fixmath.h"

/* What clipping and the division know of a projection: its near and far plane, and what makes depths of distances. */
struct smear_depths {
    int32_t near_distance, far_distance;    /* in the units of `distance`; far INT32_MAX: none */
    int32_t depth_mantissa;     /* depth units q11 = mulh(mantissa, 1/distance)
                                 * 2^depth_shift, see matrix.c */
    int16_t depth_shift;
    bool orthographic;
    uint8_t coarse;             /* X / W and Y / W are in units of 2^coarse pixels, up to 2^11 */
    int32_t up;                 /* vertices are 2^up times what the mesh has: smear_shot.reach */
};

/* Whether the camera is orthographic: depths go with distances, not with 1/distance. */
static inline bool depths_are_even(const struct smear_depths *d)
{
    return SMEAR_WITH_VIEWS && d->orthographic;
}

/* Positions of one draw, from mesh steps to the screen. For a vertex v (int16 each):
 *
 *     row r = floor(sum v_j m[r][j] / 2^16) + m[r][3],      |row| < 2^30 for every v, however wild the input
 *
 * The factors m[r][0..2] are multiples of 4, which lets cores without a wide multiply find the same floor.
 * Rows 0, 1, 2 are X, Y, W in one scale of 2^scale: X / W and Y / W are pixels (or some) right of and
 * below the frame's centre. `distance` is W for perspective; an orthographic camera has W
 * constant and distance in row 3, in steps of its own. */
struct smear_projection {
    int32_t m[4][4];
    struct smear_depths depths;
    int16_t scale;              /* log2 of X, Y, W per pixel or unit; negative for huge scenes */
    int16_t distance_scale;     /* log2 of `distance` per unit */
};

static inline bool is_orthographic(const struct smear_projection *p) { return depths_are_even(&p->depths); }

/* A draw's transform and its mesh's scale, seen from a camera: mantissas with one exponent. */
struct smear_view {
    int32_t basis[3][3];        /* one mesh step is basis 2^basis_exp along the camera's x, y, z */
    int64_t origin[3];          /* q32 world units */
    int basis_exp;
};

/* Returns the units of X / W with which X, Y and W have about as many bits: a frame's height is one or two of them. Where
 * triangles are cut, near the eye, distances must be more exact than vertices are that have W in units of a pixel's X. */
static inline int projection_coarse(int32_t height_px, bool orthographic)
{
    return orthographic ? 0 : 31 - count_leading_zeros((uint32_t)height_px);
}

/* Fills in the near and far plane and the factor of depth units of a camera, where `distance` has 2^scale per unit. */
void smear_depths_make(struct smear_depths *depths, const smear_camera *camera, int scale);

/* Returns how many bits the largest of some numbers has; 15 where it has 13. */
int smear_mesh_bits(const int16_t *number, uint32_t count);

void smear_view_compose(struct smear_view *view, const smear_transform *object, const smear_mesh *mesh, const smear_transform *camera);

/* Makes the projection of a view for frames of height_px rows. `coarse`: as struct smear_depths has it, projection_coarse or 0. */
void smear_projection_make(struct smear_projection *projection, const struct smear_view *view,
                           const smear_camera *camera, int height_px, int coarse);

/* Makes the terms of a pose between known ones: the sum of weight[i] x in[i], which is linear in clip space. The `count`
 * projections are of one draw; weights in q24 add up to one. Those whose out[i] is out[0] are of the same vertices: they are added up,
 * and rounded once, so that where nothing turns the sum is as a pose's own. All get one scale, with room for the sum, and the
 * distances of out[0] hold for it. in[i] may be out[i], unless others go there. */
void smear_projection_weigh(struct smear_projection *const out[], const struct smear_projection *const in[], const int32_t weight[],
                            int count, const smear_camera *camera);

#endif
