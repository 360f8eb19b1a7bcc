/* SPDX-License-Identifier: MIT */
/* draws_prepare.c - what the frame's draws are, before any is assembled: which of them move, and how they look. */
#include "draws.h"

#include "base/compiled.h"

/* Finds, where velocities come from depth, whether a draw has one of its own, or stays where it is before the camera. */
static void find_own_motion(struct smear_raster_draw *r, const struct smear_draw_poses *p, uint8_t motion)
{
    bool own = false, attached = true;
    for (int i = 1; i < 3; i++) {
        const bool deforms = p->position[i] != p->position[0];
        own = own || deforms || !smear_transform_is_same(p->object[i], p->object[0]);
        attached = attached && !deforms
                && smear_pose_is_attached(p->object[i], p->camera[i], p->object[0], p->camera[0]);
    }
    r->fixed = motion == SMEAR_MOTION_NONE || (own && attached);
    r->moves = own && !attached;
}

/* Whether a draw is drawn at several instants over what lines blur: it moves by itself, moves not at all before a camera that
 * does, or is blended. */
static bool moves_over_lines(const struct smear_draw_poses *p, const smear_draw *draw, bool blended)
{
    bool own = draw->motion == SMEAR_MOTION_NONE;
    for (int i = 1; i < 3; i++)
        own = own || p->position[i] != p->position[0] || !smear_transform_is_same(p->object[i], p->object[0]);
    return own || (blended && poses_differ(p));
}

/* Finds where a draw's velocity comes from: its own vertices, its depth, or nowhere. */
static void classify_draw(struct smear_context *c, uint32_t i)
{
    struct smear_raster_draw *r = &c->raster_draw[i];
    struct smear_draw_poses p;
    poses_of(&p, c, i);
    r->moves = poses_differ(&p);
    r->fixed = false;
    if (frame_has_depth_velocity(&c->rows.raster))
        find_own_motion(r, &p, c->submitted[i].draw.motion);
    c->has_fixed = c->has_fixed || r->fixed;
    if (c->frame.method == SMEAR_CAMERA)
        r->moves = false;
    if (frame_has_lines(c)) {
        const smear_draw *draw = &c->submitted[i].draw;
        const bool blended = draw->material != NULL && draw->material->alpha == SMEAR_BLEND;
        c->temporal.lines->kind[i] = LINE_GOES_ALONG;
        r->moves = moves_over_lines(&p, draw, blended)
                && (blended || !smear_movers_take(c->temporal.lines, &p, &c->shot, &c->rows.window, draw->mesh, i));
    }
    c->stats.draws_moved += r->moves || draw_is_mover(c, i);
}

static void look_up_material(struct smear_context *c, uint32_t i)
{
    const smear_draw *d = &c->submitted[i].draw;
    const smear_material *m = d->material;
    struct smear_raster_draw *r = &c->raster_draw[i];
    const smear_texture *texture = SMEAR_TEXTURE_MOST && m != NULL ? m->texture : NULL;
    r->alpha = m != NULL ? m->alpha : (uint8_t)SMEAR_OPAQUE;
    r->cutoff = m != NULL && m->cutoff != 0 ? m->cutoff : 128;
    if (texture != NULL)
        smear_sampler_make(&r->sampler, texture, d->mesh->uv_shift != 0 ? d->mesh->uv_shift : 15, m->bilinear,
                           frame_is_linear(&c->rows.raster));
    c->rows.blends = c->rows.blends || draw_is_blended(r);
    /* Texels that must be rounded are rounded once at the end, not wherever they are drawn. */
    c->direct = c->direct && !c->rows.blends && (texture == NULL || texture->format == SMEAR_TEXEL_565);
}

void smear_draws_prepare(struct smear_context *c)
{
    c->rows.blends = false;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        classify_draw(c, i);
        look_up_material(c, i);
        c->stats.triangles_in += c->submitted[i].draw.mesh->triangle_count;
    }
    draws_begin_exposure(c, -65536, 65536);
}

#if SMEAR_WITH_OVERLAY
void smear_draws_place_points(struct smear_context *c, int32_t from, int32_t to)
{
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    const bool still = c->frame.method == SMEAR_NONE;
    const struct smear_instant open = still ? smear_instant_now : smear_instant_at(&c->shot, from);
    const struct smear_instant close = still ? smear_instant_now : smear_instant_at(&c->shot, to);
    smear_points_place(&c->rows, &c->shot, &open, &close);
}
#endif
