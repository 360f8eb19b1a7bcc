/* SPDX-License-Identifier: MIT */
/* rig.h - a context (context_rig.h), and poses, meshes and a busy scene for it. Host only. */
#ifndef SMEAR_TESTS_RIG_H
#define SMEAR_TESTS_RIG_H

#include "tests/context_rig.h"

/* ------------------------------------------------------------------ poses and cameras */

int32_t q16(double v);
int32_t q24(double v);

/* Of chance, times `scale`. */
void random_rotation(int32_t basis[9], double scale);

/* Turned by `yaw` about y, then by `pitch` about x; then moved. */
smear_transform pose_at(double x, double y, double z, double yaw, double pitch);
smear_camera camera_at(double x, double y, double z, double yaw);

/* ------------------------------------------------------------------ meshes: one step is 1/256 unit */

enum { STEP = 8 };

/* A square of edge 2 in the plane z = 0, seen from +z. */
extern const smear_mesh square;
extern const int16_t square_position[12], square_uv[8];
extern const uint16_t square_index[6];
extern const smear_mesh cube;
extern const int16_t cube_position[24];
extern const uint16_t cube_index[36];

extern uint32_t checker[8 * 8];
extern const smear_texture checker_texture;
void make_checker(void);

/* A busy scene at time t: ground that passes under the camera, two cubes, a pane of glass, a cut-out. */
enum { SCENE_DRAWS = 5 };

struct scene {
    smear_transform pose[SCENE_DRAWS];
    smear_material material[SCENE_DRAWS];
    smear_draw draw[SCENE_DRAWS];
    smear_camera camera;
    smear_frame frame;
};

void make_scene(struct scene *s, double t, int method);
int render_scene(struct rig *r, double t, int method);

#endif
