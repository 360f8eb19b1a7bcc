/* SPDX-License-Identifier: MIT */
/* kinds.h - the 20 scenes of the suite, frames of the demo and real models, and the groups their figures
 * are averaged in. */
#ifndef SMEAR_BENCH_KINDS_H
#define SMEAR_BENCH_KINDS_H

/* Things move before a still camera; the camera or what is behind a still foreground moves; nothing
 * does; whole frames of the demo; models from files. */
enum kind_group { GROUP_OBJECT, GROUP_CAMERA, GROUP_STILL, GROUP_DEMO, GROUP_MODEL, GROUPS };

/* The suite comes first. */
enum { KINDS = 20, ALL_KINDS = KINDS + 7 };

struct kind {
    const char *scene;          /* "suite/pan", or a model's file below the folder of models */
    const char *name;           /* "pan" */
    enum kind_group group;
    int frame;                  /* -1: the one that stands for the scene */
    const char *clip;           /* of a model */
};

extern const struct kind kinds[ALL_KINDS];
extern const char *const kind_group_name[GROUPS];

/* -1 when there is none. */
int kind_find(const char *name);

#endif
