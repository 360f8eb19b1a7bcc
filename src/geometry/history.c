/* SPDX-License-Identifier: MIT */
/* history.c - see history.h. */
#include "geometry/history.h"

void smear_history_lay_out(struct smear_history *h, struct smear_arena *a, uint32_t max_draws)
{
    h->room = SMEAR_WITH_IDS ? max_draws : 0;
    h->kept = SMEAR_WITH_IDS ? arena_take(a, max_draws, sizeof *h->kept) : NULL;
}

void smear_history_clear(struct smear_history *h)
{
    for (uint32_t i = 0; SMEAR_WITH_IDS && i < h->room; i++)
        h->kept[i].id = 0;
}

/* Returns the place of an id: its own, else a free one, else one not seen in the last frame; or -1. */
static int32_t find(const struct smear_history *h, uint32_t id)
{
    int32_t spare = -1;
    uint32_t at = id % h->room;
    for (uint32_t i = 0; i < h->room; i++, at = at + 1 == h->room ? 0 : at + 1) {
        const struct smear_kept_pose *k = &h->kept[at];
        if (k->id == id)
            return (int32_t)at;
        if (k->id == 0)
            return spare >= 0 ? spare : (int32_t)at;
        if (spare < 0 && h->frame - k->frame > 1u)
            spare = (int32_t)at;
    }
    return spare;
}

bool smear_history_has(const struct smear_history *h, uint32_t id, bool *knows)
{
    *knows = true;
    if (!SMEAR_WITH_IDS || id == 0)
        return false;
    const int32_t at = find(h, id);
    *knows = at >= 0;
    return at >= 0 && h->kept[at].id == id && h->kept[at].frame == h->frame;
}

bool smear_history_keep(struct smear_history *h, uint32_t id, const smear_transform *pose, smear_transform *last)
{
    const int32_t at = SMEAR_WITH_IDS && id != 0 ? find(h, id) : -1;
    if (at < 0)
        return false;
    struct smear_kept_pose *k = &h->kept[at];
    const bool known = k->id == id && k->frame + 1u == h->frame;
    if (known)
        *last = k->pose;
    k->id = id;
    k->frame = h->frame;
    k->pose = *pose;
    return known;
}
