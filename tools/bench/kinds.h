/* SPDX-License-Identifier: MIT */
/* kinds.h - the 20 scenes of the suite and the groups their figures are averaged in. */
#ifndef SMEAR_BENCH_KINDS_H
#define SMEAR_BENCH_KINDS_H

/* Things move before a still camera; the camera or what is behind a still foreground moves; nothing
 * does. */
enum kind_group { GROUP_OBJECT, GROUP_CAMERA, GROUP_STILL, GROUPS };

enum { KINDS = 20 };

struct kind {
    const char *scene;          /* "suite/pan" */
    const char *name;           /* "pan" */
    enum kind_group group;
};

extern const struct kind kinds[KINDS];
extern const char *const kind_group_name[GROUPS];

/* -1 when there is none. */
int kind_find(const char *name);

#endif
