/* SPDX-License-Identifier: MIT */
/* channel.h - a channel's value at an instant, and as a blur may join it with the value at another. Host only. */
#ifndef SMEAR_TOOLS_CHANNEL_H
#define SMEAR_TOOLS_CHANNEL_H

#include "tools/model/model.h"

/* The last key at or before t, or the first. */
int channel_find_key(const struct model_channel *c, double t);

/* Whether the value jumps between a key and the next: held keys do, and two that are less than half a millisecond apart and
 * far from the keys beside them. */
bool channel_jumps(const struct model_channel *c, int key);

/* From the instant `now` of a clip to the instant `time`, seconds within the clip. */
struct channel_way {
    double time, now;
    double along;               /* `time` counted from the start that `now` is counted from: the clip may start again between */
    double end;                 /* the clip's, where it starts again */
    bool starts_again;          /* on this way */
};

/* The channel's `width` values at `time` that a path may join with those at `now`; rotations come out with length 1. Where the
 * channel jumps on the way, the far side of the jump is left out: held values are those of now, and others go on from the near
 * side as they do there. */
void channel_join(const struct model_channel *c, const struct channel_way *way, double *out);

#endif
