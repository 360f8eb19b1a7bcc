/* SPDX-License-Identifier: MIT */
/* draws_prepare.c - what the frame's draws are, before any is assembled: which of them move, and how they look. */
#include "base/compiled.h"
#include "context.h"
#include "draws.h"
#include "geometry/pose.h"
#include "geometry/ranges.h"

/* ------------------------------------------------------------------ curves */

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
        const bool blended = draw->material != NULL && draw->material->alpha >= SMEAR_BLEND;
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
    if (texture != NULL) {
        /* Coarse coordinates grow: where triangles are cut, they are rounded. */
        const smear_mesh *mesh = d->mesh;
        const int shift = mesh->uv_shift != 0 ? mesh->uv_shift : 15;
        const bool grows = shift < 9 && mesh->uv != NULL;
        const int up = grows ? 15 - max_i32(shift, smear_mesh_bits(mesh->uv, 2u * mesh->vertex_count)) : 0;
        r->sampler.uv_up = (uint8_t)up;
        smear_sampler_make(&r->sampler, texture, shift + up, m->bilinear, frame_transfer(&c->rows.raster));
    }
    c->rows.blends = c->rows.blends || draw_is_blended(r);
    /* Texels that must be rounded are rounded once at the end, not wherever they are drawn. */
    c->direct = c->direct && !c->rows.blends && (texture == NULL || texture->format == SMEAR_TEXEL_565);
}

void smear_draws_classify(struct smear_context *c)
{
    c->stats.draws_moved = 0;
    for (uint32_t i = 0; i < c->draw_count; i++)
        classify_draw(c, i);
}

void smear_draws_prepare(struct smear_context *c)
{
    c->rows.blends = false;
    c->shot.reach = INT8_MIN;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        look_up_material(c, i);
        const smear_draw *d = &c->submitted[i].draw;
        c->stats.triangles_in += d->mesh->triangle_count;
        c->shot.reach = max_i32(c->shot.reach, draw_reach(d));
    }
    smear_draws_classify(c);
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

/* ------------------------------------------------------------------ where triangles are seen, when the store is too small */

/* Makes ranges as short as it pays, and as a part of the pool has room for the boxes of. Returns how many there are; 0 where the
 * draws alone are too many. */
static uint32_t cut_ranges(const struct smear_context *c, struct smear_bins *g)
{
    enum { PATHS_SHIFT = 5, STILL_SHIFT = 7, POOL_PART = 8 };       /* triangles without a path cost less than to begin a range */
    const uint32_t most = (g->pool_words - POOL_WORDS_LEAST) / POOL_PART;
    uint32_t n = c->draw_count;
    for (g->range_shift = assembler_keeps_paths(&c->assembler) ? PATHS_SHIFT : STILL_SHIFT; c->draw_count <= most; g->range_shift++) {
        n = 0;
        for (uint32_t i = 0; i < c->draw_count; i++)
            n += ranges_of(g, c->submitted[i].draw.mesh->triangle_count);
        if (n <= most)
            return n;
    }
    return 0;
}

void smear_draws_find_ranges(struct smear_context *c, const struct smear_instant *instant)
{
    struct smear_assembler as = c->assembler;
    struct smear_bins *g = as.bins;
    if (!SMEAR_RANGES || bins_kept(g) != 0 || frame_has_layers(c) || frame_has_pictures(c))      /* of which each has others */
        return;
    g->kept_words = cut_ranges(c, g);
    struct smear_tile_box *box = ranges_all(g);
    if (box == NULL)
        return;
    uint32_t beside = 0;
    as.damaged = NULL;
    as.ranges = NULL;
    as.path_x0 = 0;
    as.path_x1 = INT16_MAX;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const uint32_t n = ranges_of(g, c->submitted[i].draw.mesh->triangle_count);
        struct smear_assembly a;
        for (uint32_t k = 0; k < n; k++)
            box[k] = tile_box_none();
        if (smear_draws_make_assembly(c, i, instant, &a))
            smear_ranges_find(&as, &a, box);
        else
            beside++;
        box += n;
    }
    c->stats.draws_beside += beside;
    c->assembler.triangles_dropped = as.triangles_dropped;
    c->assembler.serial = as.serial;
    c->assembler.cache_has_paths = as.cache_has_paths;
}
