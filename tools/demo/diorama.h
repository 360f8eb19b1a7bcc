/* SPDX-License-Identifier: MIT */
/* diorama.h - scenes of several model files, placed and moved by code before a set made in code.
 *
 * A diorama is a stage (stage.h: ground, sky, shadows, camera) and a cast: model files, each in any
 * number of places. Like every scene it is a pure function of time. */
#ifndef SMEAR_TOOLS_DEMO_DIORAMA_H
#define SMEAR_TOOLS_DEMO_DIORAMA_H

#include "tools/failure.h"
#include "tools/scenes/scene.h"
#include "tools/scenes/stage.h"

#include <stdbool.h>

struct diorama_file {
    const char *path;           /* inside the folder of assets */
    const char *clip;           /* by name; null: it does not move by itself */
};

/* Where an actor is at an instant. Starts as the identity, at time 0 of its clip. */
struct diorama_place {
    struct xform world;
    double clip_time;           /* seconds; clips loop */
    double rolled;              /* nodes called "wheel..." turn as after so many units along the
                                 * file's +z, */
    double steer;               /* those called "wheel-front..." by so many radians to the left */
    int epoch;                  /* differs between two instants: cut in between */
};

struct diorama_kind {
    const struct stage_kind *stage;     /* builds and moves the set and the camera */
    const struct diorama_file *file;
    int file_count;
    int cast_count;
    int (*file_of)(int actor);          /* index of the file each actor is made of */
    void (*place)(double time, struct diorama_place *place);    /* all actors */
};

/* Loads what the cast needs. On failure the text begins with the file's name, if it is about a
 * file. The kind must outlive the scene. */
bool diorama_open(const struct diorama_kind *kind, const char *assets, struct scene *out,
                  struct failure *f);

#endif
