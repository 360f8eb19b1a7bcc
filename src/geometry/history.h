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

struct smear_history {
    struct smear_kept_pose *kept;   /* a hash table by id */
    uint32_t room;
    uint32_t frame;                 /* number of the frame that is submitted */
};

/* Takes room for as many ids as a frame has draws; nothing is kept yet. */
void smear_history_lay_out(struct smear_history *h, struct smear_arena *a, uint32_t max_draws);
void smear_history_clear(struct smear_history *h);

/* Whether an id was submitted in this frame already, as far as there was room to keep it. *knows: there was. */
bool smear_history_has(const struct smear_history *h, uint32_t id, bool *knows);

/* Keeps the pose of an id, and writes the one it had in the frame before to `last`; false where it had none. */
bool smear_history_keep(struct smear_history *h, uint32_t id, const smear_transform *pose, smear_transform *last);

#endif
