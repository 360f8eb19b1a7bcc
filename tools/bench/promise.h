/* SPDX-License-Identifier: MIT */
/* promise.h - the scenes on which it is checked that a target is an error that is had. */
#ifndef SMEAR_BENCH_PROMISE_H
#define SMEAR_BENCH_PROMISE_H

#include "tools/bench/take.h"

enum promise_group { PROMISE_SUITE, PROMISE_HERO, PROMISE_MODEL, PROMISE_UNSEEN, PROMISE_GROUPS };

struct promise_scene {
    const char *scene;              /* of the catalog, or a file below the folder of models */
    const char *clip;
    int frame;                      /* -1: the one that stands for the scene */
    enum promise_group group;
    bool held;                      /* took no part in fitting the library's model */
};

extern const struct promise_scene promise_scenes[];
extern const int promise_scene_count;

/* The command `promise`, arguments behind its name. */
int promise_command(const char *program, int count, char **text);

bool promise_take(int index, struct take *out);

#endif
