/* SPDX-License-Identifier: MIT */
/* race.h - the rules: cars, laps, sparks. What happens depends on the keys of each frame alone, so that a race can be played
 * again on any machine. A frame is 1/30 s. */
#ifndef GAME_RACE_H
#define GAME_RACE_H

#include "platform/game/course.h"

#include <stdbool.h>

enum { RACE_CARS = 4, RACE_LAPS = 3, RACE_SPARKS = 6, RACE_START = 45 /* frames */ };

struct race_car {
    int32_t along;                  /* segments since the start line, q16; below 0 before it */
    int32_t right, speed;           /* metres q16; segments per frame q16 */
    int32_t slide;                  /* metres per frame to the right, q16 */
};

struct race_spark {
    smear_vec3 at, before, step;    /* metres: now and when it was drawn last; metres per frame */
    int age;                        /* frames; 0: none */
};

struct race {
    struct race_car car[RACE_CARS]; /* car 0 is the player's */
    struct race_spark spark[RACE_SPARKS];
    uint32_t frame, noise;
    int lap;                        /* of the player: 0 before the line, 1 ... */
    uint32_t lap_began, best, finished;         /* frames; 0: not yet */
    bool struck;                    /* the player's car touched something in this frame */
    int place;                      /* 1 is the first; kept once the race is over */
};

void race_begin(struct race *r);

/* Goes on by a frame. `keys`: display_key; `seen`: the frame so far has been drawn. */
void race_step(struct race *r, unsigned keys, bool seen);

/* The greatest speed, segments per frame in q16. */
int32_t race_top_speed(void);

#endif
