/* SPDX-License-Identifier: MIT */
/* poses.h - eight triangles at instants, their vertices along their paths: geometry/path.h for eight at once. What all instants have
 * in common is made once. */
#ifndef SMEAR_KERNELS_POSES_H
#define SMEAR_KERNELS_POSES_H

#include "kernels/avx2.h"

#if SMEAR_AVX2

enum {
    POSES_WORDS = 6,            /* of a vertex: x, y (q8 px), depth (q11), up to three words more */
    POSES_RECORD = 8            /* and from one record to the next */
};

/* A coordinate of eight vertices on its path: in the middle, and what path.h multiplies by the phase, and by that again. */
struct poses_course {
    int32_t middle[8], slope[8], curvature[8];
};

/* Eight triangles' vertices: x, y and depth. */
struct poses_courses {
    struct poses_course of[3][3];
    int32_t more[3][POSES_WORDS - 3][8];        /* words behind, also where records have fewer */
};

struct poses_setup {
    const int32_t *vertex;          /* records: up to POSES_WORDS; then, behind `motion` words in all, x, y and depth at open and
                                     * those at close, which end the record */
    int motion;
    int words;                      /* of a record without the path that are looked at: up to POSES_WORDS, `motion` at most */
    int32_t phase;                  /* path_phase */
    int32_t low[2], high[2];        /* the guard band, q8 px: x, y */
    int32_t depth_least, depth_most;
    int32_t x0, y0, x1, y1;         /* the pixels looked at */
    int32_t tiny;                   /* a box is tiny up to this width and height, px, */
    int32_t tiny_box;               /* and this many pixels */
};

struct poses {
    uint32_t seen;                  /* bit k: triangle k faces the eye and its box has pixels that are looked at. The others' words
                                     * and bounds are undefined */
    uint32_t tiny;                  /* bit k: so it is, and its box is tiny, all of it */
    int32_t box[4];                 /* the pixels of all that are seen: x0, y0, x1, y1; undefined where none is */
    int32_t bounds[4][8];           /* of the vertices: least x and y, largest x and y */
    int32_t word[3][POSES_WORDS][8];        /* words of the first vertices, of the second and the third ones, as many as are looked
                                             * at */
    bool has_records;
    int32_t record[8][3][POSES_RECORD];     /* the same as records, once they have been made */
};

/* Places of vertices in words, the fourth of each is not looked at; all eight must be there. Of the setup, `vertex` and `motion` are
 * looked at. */
void smear_poses_courses_avx2(struct poses_courses *out, const struct poses_setup *s, const uint16_t vertex[8][4]);

/* `count` triangles are looked at. */
void smear_poses_avx2(struct poses *out, const struct poses_setup *s, const struct poses_courses *courses, int count);

/* Makes records of the words. */
void smear_poses_records_avx2(struct poses *p);

#endif
#endif
