/* SPDX-License-Identifier: MIT */
/* pose.h - where cameras and draws are at an instant of the exposure: sums of the poses that are known of them.
 *
 * Known are a pose now and one a frame ago, or those at shutter open, in the middle and at shutter close
 * (smear_shutter.poses). Index 0 is now, 1 open (or a frame ago), 2 close. */
#ifndef SMEAR_POSE_H
#define SMEAR_POSE_H

#include "smear.h"

#include "base/base.h"
#include "geometry/shot.h"
#include "geometry/vertex.h"

/* The pose an id had when it was last submitted. */
struct smear_kept_pose {
    uint32_t id;                    /* 0: free */
    uint32_t frame;
    smear_transform pose;
};

/* The pose it had before that, in frame `frame`. */
struct smear_older_pose {
    uint32_t frame;
    smear_transform pose;
};

/* What was two frames ago. */
struct smear_older {
    bool has_camera;
    smear_camera camera;
    struct smear_older_pose *pose;  /* beside those of smear_history.kept */
};

struct smear_history {
    struct smear_kept_pose *kept;   /* a hash table by id */
    struct smear_older *older;      /* null with desc.reuse.one_pose */
    uint32_t room;
    uint32_t frame;                 /* number of the frame that is submitted */
};

/* Takes room for as many ids as a frame has draws; nothing is kept yet. */
void smear_history_lay_out(struct smear_history *h, struct smear_arena *a, uint32_t max_draws, bool one_pose);
void smear_history_clear(struct smear_history *h);

/* The place of an id: its own, else a free one, else one not seen in the last frame; -1: there is none, and id 0 has none. */
int32_t smear_history_find(const struct smear_history *h, uint32_t id);

/* Whether the id, whose place is `at`, was submitted in this frame already. */
bool smear_history_has(const struct smear_history *h, int32_t at, uint32_t id);

/* Keeps the pose of an id at its place, and writes those it had in the last frame and in the one before to past[0] and
 * past[1]. Returns how many it had, without a frame left out: 0 to 2. `cut`: it jumped to the new one, from which no curve
 * leads back. pose null: the id alone is kept, as where no frame is blurred; then it is null always. */
int smear_history_keep(struct smear_history *h, int32_t at, uint32_t id, const smear_transform *pose, bool cut,
                       smear_transform past[2]);

/* Keeps the pose that an id had in the last frame, in which it found no place: that of one which was not in it. */
void smear_history_keep_late(struct smear_history *h, uint32_t id, const smear_transform *pose);

/* Where a draw is in each known pose; equal poses mean it does not move. */
struct smear_draw_poses {
    const smear_transform *object[3];
    const smear_camera *camera[3];
    const int16_t *position[3];
    int32_t deform;                 /* of the displacement between their vertices, q8 */
    int32_t coarse;                 /* as smear_projection_make has it */
    bool projected[3];              /* `projection` holds */
    struct smear_projection projection[3];
    /* poses that are not the application's */
    smear_transform made[SMEAR_WITH_SCALES || SMEAR_WITH_VIEWS ? 3 : 1];
};

/* Returns the least smear_shot.reach of a draw's mesh; of one that deforms, as if it had all bits. */
static inline int draw_reach(const smear_draw *d)
{
    const smear_mesh *m = d->mesh;
    const bool deforms = SMEAR_WITH_DEFORM && (d->open_position != NULL || d->close_position != NULL);
    const int bits = deforms ? 15 : smear_mesh_bits(m->position, 3u * m->vertex_count);
    return (SMEAR_WITH_BOUNDS ? max_i32(bits, smear_mesh_bits(m->bounds, 6)) : bits) - m->shift;
}

/* Finds the poses of a draw, whose `now` is given and whose `open`, if it is not null, is its earlier pose. `camera`: three
 * of its layer's own, or null for the shot's. */
void smear_draw_poses_make(struct smear_draw_poses *p, const struct smear_shot *shot, const smear_draw *draw,
                           const smear_camera *camera);

/* Whether the vertices of a draw that deforms move along the parabola through where they were two frames ago
 * (close_position): where a straight line foretells that to two fifths of their displacement. */
bool smear_draw_bends(const smear_draw *draw, const struct smear_shot *shot);

/* Whether the determinant is negative. */
bool smear_transform_is_mirrored(const smear_transform *t);

bool smear_transform_is_same(const smear_transform *a, const smear_transform *b);
bool smear_camera_is_same(const smear_camera *a, const smear_camera *b);

/* Whether an object with these two poses stays where it is in the view of the camera's two: attached to it. */
bool smear_pose_is_attached(const smear_transform *object, const smear_camera *camera,
                            const smear_transform *other_object, const smear_camera *other_camera);

/* Whether the draw is elsewhere, or of another shape, in pose i than now. */
static inline bool pose_differs(const struct smear_draw_poses *p, int i)
{
    return (SMEAR_WITH_DEFORM && p->position[i] != p->position[0])
        || !smear_transform_is_same(p->object[i], p->object[0]) || !smear_camera_is_same(p->camera[i], p->camera[0]);
}

static inline bool poses_differ(const struct smear_draw_poses *p)
{
    return SMEAR_BLURS && (pose_differs(p, 1) || pose_differs(p, 2));
}

/* Finds where the vertices are at an instant: a sum of poses, linear in clip space. */
void smear_draw_poses_place(struct smear_placement *out, struct smear_draw_poses *p, const struct smear_shot *shot,
                            const smear_mesh *mesh, const struct smear_instant *instant);

/* Adds pose k to those between which the assembly measures velocity. */
void smear_draw_poses_add(struct smear_assembly *a, struct smear_draw_poses *p, const struct smear_shot *shot, int k);

#endif
