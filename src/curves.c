/* SPDX-License-Identifier: MIT */
/* curves.c - which draws and cameras of a frame move along curves: their poses at the shutter take the place of past ones. */
#include "context.h"
#include "draws.h"

/* Makes the track of a draw. Returns false where it has no motion of its own. */
static bool find_track(struct smear_track *track, const struct smear_context *c, struct smear_submitted *s)
{
    const smear_draw *d = &s->draw;
    *track = (struct smear_track){ { &s->pose[0], &s->pose[1], &s->pose[2] }, d->close != NULL,
                                   d->path != SMEAR_PATH_DEFAULT ? d->path : c->shot.path, c->shot.object_scale };
    return d->open != NULL && !d->cut && d->motion == SMEAR_MOTION_FULL;
}

/* Whether layers of the frame may have cameras of their own. */
static bool has_cameras(const struct smear_context *c)
{
    return SMEAR_WITH_LAYERS && smear_method_has_layers(c->frame.method);
}

static bool frame_is_curved(struct smear_context *c)
{
    struct smear_track track;
    bool curved = c->shot.camera_moves && smear_cameras_are_curved(&c->shot, c->shot.camera, c->shot.has_older);
    for (uint32_t i = 0; i < c->draw_count && !curved; i++)
        curved = (find_track(&track, c, &c->submitted[i]) && smear_track_is_curved(&track))
              || (SMEAR_WITH_DEFORM && smear_draw_bends(&c->submitted[i].draw, &c->shot));
    return curved || (has_cameras(c) && smear_layers_are_curved(c));
}

/* What stays where it is before the camera does so at every moment, whatever the curves of both are. */
static void find_attached(struct smear_context *c)
{
    struct smear_submitted *s = c->submitted;
    struct smear_track track;
    for (uint32_t i = 0; c->shot.camera_moves && i < c->draw_count; i++, s++)
        if (find_track(&track, c, s) && s->draw.open_position == NULL && track.scale == 256
            && smear_pose_is_attached(&s->pose[1], &c->shot.camera[1], &s->pose[0], &c->shot.camera[0]))
            s->draw.motion = SMEAR_MOTION_NONE;
}

void smear_draws_find_curves(struct smear_context *c)
{
    struct smear_track track;
    if (!SMEAR_WITH_CURVES || c->frame.method == SMEAR_NONE || c->shot.shutter_poses || c->shot.cut || !frame_is_curved(c))
        return;
    c->shot.curved = true;
    find_attached(c);
    if (c->shot.camera_moves)
        smear_cameras_bend(&c->shot, c->shot.camera, c->shot.has_older);
    if (has_cameras(c))
        smear_layers_bend(c);
    for (uint32_t i = 0; i < c->draw_count; i++) {
        struct smear_submitted *s = &c->submitted[i];
        if (!SMEAR_WITH_DEFORM || !smear_draw_bends(&s->draw, &c->shot))
            s->draw.close_position = NULL;
        if (!find_track(&track, c, s))
            continue;
        smear_track_bend(&track, &c->shot);
        s->draw.close = &s->pose[2];
    }
}
