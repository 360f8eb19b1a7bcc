/* SPDX-License-Identifier: MIT */
/* history.h - the poses that ids had: the library remembers where everything was in the frame before. */
#ifndef SMEAR_HISTORY_H
#define SMEAR_HISTORY_H

#include "base/arena.h"
#include "smear.h"

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

#endif
