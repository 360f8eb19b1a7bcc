/* SPDX-License-Identifier: MIT */
/* history.c - see history.h. */
#include "geometry/history.h"

void smear_history_lay_out(struct smear_history *h, struct smear_arena *a, uint32_t max_draws, bool one_pose)
{
    const bool two = SMEAR_WITH_CURVES && !one_pose;
    h->room = SMEAR_BLURS ? max_draws : 0;
    h->kept = SMEAR_BLURS ? arena_take(a, max_draws, sizeof *h->kept) : NULL;
    h->older = two ? arena_take(a, 1, sizeof *h->older) : NULL;
    struct smear_older_pose *pose = two ? arena_take(a, max_draws, sizeof *pose) : NULL;
    if (h->older != NULL)
        h->older->pose = pose;
}

void smear_history_clear(struct smear_history *h)
{
    for (uint32_t i = 0; SMEAR_BLURS && i < h->room; i++)
        h->kept[i].id = 0;
    if (SMEAR_BLURS && h->older != NULL)
        h->older->has_camera = false;
}

int32_t smear_history_find(const struct smear_history *h, uint32_t id)
{
    int32_t spare = -1;
    if (!SMEAR_BLURS || id == 0)
        return -1;
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

bool smear_history_has(const struct smear_history *h, int32_t at, uint32_t id)
{
    return SMEAR_BLURS && h->kept[at].id == id && h->kept[at].frame == h->frame;
}

int smear_history_keep(struct smear_history *h, int32_t at, uint32_t id, const smear_transform *pose, bool cut,
                       smear_transform past[2])
{
    struct smear_kept_pose *k = &h->kept[at];
    int count = k->id == id && k->frame + 1u == h->frame;
    const uint32_t before = k->frame;
    k->id = id;
    k->frame = h->frame;
    if (pose == NULL)
        return 0;
    if (count != 0)
        past[0] = k->pose;
    if (SMEAR_WITH_CURVES && h->older != NULL) {
        struct smear_older_pose *o = &h->older->pose[at];
        if (count != 0 && o->frame + 2u == h->frame) {
            past[1] = o->pose;
            count = 2;
        }
        o->frame = count != 0 && !cut ? before : h->frame;          /* that of no frame to come is its own */
        o->pose = k->pose;
    }
    k->pose = *pose;
    return count;
}

void smear_history_keep_late(struct smear_history *h, uint32_t id, const smear_transform *pose)
{
    smear_transform unused[2];
    const int32_t at = smear_history_find(h, id);
    if (at < 0 || h->kept[at].id == id)
        return;
    smear_history_keep(h, at, id, pose, false, unused);
    h->kept[at].frame--;
}
