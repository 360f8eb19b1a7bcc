/* SPDX-License-Identifier: MIT */
/* track.h - clips at an instant, as tools/model/pose.c has them, but with the same bits on every host. */
#ifndef SMEAR_TOOLS_CONVERT_TRACK_H
#define SMEAR_TOOLS_CONVERT_TRACK_H

#include "tools/model/model.h"

/* The channel's values at `time`; rotations have length 1. */
void track_sample(const struct model_channel *channel, double time, double *out);

/* A pose of all nodes. */
struct track_pose {
    double (*translation)[3], (*rotation)[4], (*scale)[3];
    double (*world)[16];        /* x root */
    double *weight;             /* node after node: weight_at */
    int *weight_at;
};

bool track_pose_alloc(struct track_pose *pose, const struct model *model, struct failure *f);
void track_pose_free(struct track_pose *pose);

/* Of a node's mesh: morph targets. */
int track_weight_count(const struct model *model, int node);

/* `clip` -1: at rest. */
void track_pose_set(struct track_pose *pose, const struct model *model, int clip, double time,
                    const double root[16]);

/* The node's own matrix in the pose. */
void track_local(const struct track_pose *pose, const struct model *model, int node, double out[16]);

#endif
