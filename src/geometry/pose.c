/* SPDX-License-Identifier: MIT */
/* pose.c - see pose.h. */
#include "geometry/pose.h"

#include "base/fixmath.h"
#include "geometry/arc.h"

/* ------------------------------------------------------------------ poses */

bool smear_transform_is_mirrored(const smear_transform *t)
{
    uint32_t all = 1u << 14;
    int32_t e[9];
    int64_t d = 0;
    for (int i = 0; i < 9; i++) {
        e[i] = t->basis[i] >> 11;
        all |= (uint32_t)(e[i] ^ e[i] >> 31);
    }
    const int down = 17 - count_leading_zeros(all);     /* products have 32 bits: all is told where scales are below 4 */
    for (int i = 0; i < 9; i++)
        e[i] >>= down;
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        d += (int64_t)e[i] * (e[3 + j] * e[6 + k] - e[3 + k] * e[6 + j]);
    }
    return d < 0;
}

bool smear_transform_is_same(const smear_transform *a, const smear_transform *b)
{
    if (a == b)
        return true;
    for (int i = 0; i < 9; i++)
        if (a->basis[i] != b->basis[i])
            return false;
    return a->origin[0] == b->origin[0] && a->origin[1] == b->origin[1] && a->origin[2] == b->origin[2];
}

bool smear_camera_is_same(const smear_camera *a, const smear_camera *b)
{
    return a == b || (smear_transform_is_same(&a->pose, &b->pose) && a->focal == b->focal && a->half_height == b->half_height);
}

/* ------------------------------------------------------------------ attached objects */

bool smear_pose_is_attached(const smear_transform *object, const smear_camera *camera,
                            const smear_transform *other_object, const smear_camera *other_camera)
{
    /* Both in camera space, to within the rounding of their entries. */
    const smear_transform *o[2] = { object, other_object };
    const smear_camera *c[2] = { camera, other_camera };
    if (camera->focal != other_camera->focal || camera->half_height != other_camera->half_height)
        return false;
    for (int i = 0; i < 3; i++) {
        int64_t offset[2] = { 0, 0 };
        for (int j = 0; j < 3; j++) {
            int64_t turn[2];
            for (int side = 0; side < 2; side++) {
                const int32_t *b = c[side]->pose.basis;
                turn[side] = dot_wide(b + i, 3, o[side]->basis + j, 3);
                offset[side] += (int64_t)b[3 * j + i] * ((int64_t)o[side]->origin[j] - c[side]->pose.origin[j]);
            }
            if (magnitude(turn[0] - turn[1]) > (uint64_t)1 << 30)        /* 2^-18 */
                return false;
        }
        if (magnitude(offset[0] - offset[1]) > (uint64_t)4 << 24)              /* 4 / 65536 units */
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------ other poses */

/* Deformation is not scaled further: weights of ten frames by it have eight bits. */
enum { DEFORM_MOST = 8 << 8 };

/* Brings the other poses nearer to that of now, or farther: smear_frame.scale.object. */
static void scale_object(struct smear_draw_poses *p, uint32_t scale, bool curved)
{
    for (int i = 1; i < 3; i++) {
        const smear_transform *other = p->object[i], *now = p->object[0];
        smear_transform *made = &p->made[i];
        for (int k = 0; k < 9; k++)
            made->basis[k] = smear_arc_scaled(now->basis[k], other->basis[k], scale);
        for (int k = 0; k < 3; k++)
            made->origin[k] = smear_arc_scaled(now->origin[k], other->origin[k], scale);
        if (!curved)        /* poses on curves are scaled by their times */
            p->object[i] = made;
        if (scale == 0)
            p->position[i] = p->position[0];
    }
    p->deform = min_i32((int32_t)scale, DEFORM_MOST);
}

/* The camera's x axis, without its y, as a rotation about the world's y. Looking straight up or down it stays as it is. */
static void upright_basis(int32_t turn[9], const int32_t camera[9])
{
    const uint32_t length = sqrt_floor_64((uint64_t)(mul_wide(camera[0], camera[0]) + mul_wide(camera[6], camera[6])));
    int32_t x = 1 << 24, z = 0;
    if (length > 1u << 16) {
        x = ratio_q30((int64_t)min_u32(magnitude_i32(camera[0]), length), length) >> 6;
        z = ratio_q30((int64_t)min_u32(magnitude_i32(camera[6]), length), length) >> 6;
        x = camera[0] < 0 ? -x : x;
        z = camera[6] < 0 ? -z : z;
    }
    const int32_t about_y[9] = { x, 0, -z, 0, 1 << 24, 0, z, 0, x };
    for (int i = 0; i < 9; i++)
        turn[i] = about_y[i];
}

/* Turns a billboard with the camera of each pose. */
static void turn_billboard(struct smear_draw_poses *p, bool upright)
{
    for (int pose = 0; pose < 3; pose++) {
        const int32_t *camera = p->camera[pose]->pose.basis;
        int32_t turn[9], made[9];
        for (int i = 0; i < 9; i++)
            turn[i] = camera[i];
        if (upright)
            upright_basis(turn, camera);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                made[3 * i + j] = narrow_sat(dot_wide(turn + 3 * i, 1, p->object[pose]->basis + j, 3) >> 24);
        for (int i = 0; i < 3; i++)
            p->made[pose].origin[i] = p->object[pose]->origin[i];
        for (int i = 0; i < 9; i++)
            p->made[pose].basis[i] = made[i];
        p->object[pose] = &p->made[pose];
    }
}

/* Poses of the object alone. */
static void object_poses(struct smear_draw_poses *p, const struct smear_shot *shot, const smear_draw *d)
{
    if (shot->cut || d->cut || d->motion != SMEAR_MOTION_FULL)
        return;
    if (d->open_position != NULL && (d->open_count == 0 || d->open_count == d->mesh->vertex_count))
        p->position[1] = d->open_position;
    if (d->open != NULL)
        p->object[1] = d->open;
    if (shot_spans_exposure(shot) && d->close != NULL)
        p->object[2] = d->close;
    if (shot_spans_exposure(shot) && d->close_position != NULL && (d->close_count == 0 || d->close_count == d->mesh->vertex_count))
        p->position[2] = d->close_position;
    if (SMEAR_WITH_SCALES && shot->object_scale != 256)
        scale_object(p, shot->object_scale, shot_is_curved(shot));
}

void smear_draw_poses_make(struct smear_draw_poses *p, const struct smear_shot *shot, const smear_draw *d, const smear_camera *camera)
{
    const bool moves = !shot->cut && d->motion != SMEAR_MOTION_NONE && (camera != NULL || shot->camera_moves);
    if (camera == NULL)
        camera = shot->camera;
    for (int i = 0; i < (SMEAR_BLURS ? 3 : 1); i++) {
        p->object[i] = d->now;
        p->camera[i] = camera;
        p->position[i] = d->mesh->position;
        p->projected[i] = false;
    }
    p->coarse = 0;
    p->deform = 256;
    if (SMEAR_BLURS && moves) {
        p->camera[1] = &camera[1];
        if (shot_spans_exposure(shot))
            p->camera[2] = &camera[2];
    }
    if (SMEAR_BLURS)
        object_poses(p, shot, d);
    if (SMEAR_WITH_VIEWS && d->billboard != SMEAR_BILLBOARD_NONE)
        turn_billboard(p, d->billboard == SMEAR_BILLBOARD_UPRIGHT);
}

/* ------------------------------------------------------------------ places */

/* Returns a pose's projection, computed on first use. */
static const struct smear_projection *project_pose(struct smear_draw_poses *p, const struct smear_shot *shot, int i,
                                                   const smear_mesh *mesh)
{
    struct smear_projection *const projection = &p->projection[i];
    if (!p->projected[i]) {
        struct smear_view view;
        smear_view_compose(&view, p->object[i], mesh, &p->camera[i]->pose);
        const int up = max_i32(0, 15 - mesh->shift - shot->reach);
        view.basis_exp -= up;
        smear_projection_make(projection, &view, p->camera[i], shot->height, p->coarse);
        projection->depths.up = up;
        p->projected[i] = true;
    }
    return projection;
}

static bool deformation_is_scaled(const struct smear_draw_poses *p, int k)
{
    return SMEAR_WITH_SCALES && SMEAR_WITH_DEFORM && p->deform != 256 && p->position[k] != p->position[0];
}

/* Whether vertices move in the mesh while the pose follows a curve: straight from where they were a frame ago, or along the
 * parabola through a third place. */
static bool deforms_on_curve(const struct smear_draw_poses *p, const struct smear_shot *shot)
{
    return SMEAR_WITH_CURVES && SMEAR_WITH_DEFORM && shot_is_curved(shot) && p->position[1] != p->position[0];
}

/* Returns how much of the vertices' displacement since a frame ago is undone at a time, q24. */
static int32_t part_at(const struct smear_draw_poses *p, int32_t time)
{
    return mul_shift(-time, p->deform, 8);
}

/* Shares a placement between the mesh's vertices and those of frames ago. */
static void place_deformed(struct smear_placement *out, const struct smear_draw_poses *p, int32_t time)
{
    const struct smear_projection now = out->now, *const in[3] = { &now, &now, &now };
    struct smear_projection *const term[3] = { &out->now, &out->extra[0], &out->extra[SMEAR_WITH_DEFORM] };
    /* The parabola's share of each: 1, -2, 1 times t (t + 1) / 2. */
    const bool bends = p->position[2] != p->position[0];
    const int32_t bend = bends ? mul_shift(time, time + (1 << 24), 25) : 0;
    const int32_t older = part_at(p, -bend), last = part_at(p, time) - 2 * older;
    const int32_t weight[3] = { (1 << 24) - last - older, last, older };
    out->extra_count = bends ? 2 : 1;
    smear_projection_weigh(term, in, weight, out->extra_count + 1, p->camera[0]);
    for (int i = 0; i < out->extra_count; i++)
        out->extra_position[i] = p->position[i + 1];
}

void smear_draw_poses_place(struct smear_placement *out, struct smear_draw_poses *p, const struct smear_shot *shot,
                            const smear_mesh *mesh, const struct smear_instant *instant)
{
    enum { TERMS = SMEAR_WITH_SCALES && SMEAR_WITH_DEFORM ? 5 : 3 };
    const struct smear_projection *in[TERMS];
    struct smear_projection *term[TERMS];
    const int16_t *position[TERMS];
    int32_t weight[TERMS];
    int count = 0;
    out->extra_count = 0;
    if (!SMEAR_BLURS) {
        out->now = *project_pose(p, shot, 0, mesh);
        out->position = p->position[0];
        return;
    }
    for (int k = 0; k < 3; k++) {
        if (instant->weight[k] == 0)
            continue;
        in[count] = project_pose(p, shot, k, mesh);
        position[count] = p->position[shot_is_curved(shot) ? 0 : k];
        weight[count++] = instant->weight[k];
        if (!shot_is_curved(shot) && deformation_is_scaled(p, k)) {      /* part of the displacement from the mesh's own vertices */
            in[count] = in[count - 1];
            position[count] = p->position[0];
            weight[count - 1] = mul_shift(instant->weight[k], p->deform, 8);
            weight[count] = instant->weight[k] - weight[count - 1];
            count++;
        }
    }
    out->position = position[0];
    for (int k = 0; k < count; k++) {
        term[k] = &out->now;
        if (!SMEAR_WITH_DEFORM || position[k] == position[0])
            continue;
        SMEAR_ASSERT(out->extra_count < 2);             /* that of now is the first, or there is one more */
        term[k] = &out->extra[out->extra_count];
        out->extra_position[out->extra_count++] = position[k];
    }
    if (count > 1)
        smear_projection_weigh(term, in, weight, count, p->camera[0]);
    else
        out->now = *in[0];
    if (deforms_on_curve(p, shot) && instant->time != 0)
        place_deformed(out, p, instant->time);
}

void smear_draw_poses_add(struct smear_assembly *a, struct smear_draw_poses *p, const struct smear_shot *shot, int k)
{
    const bool curves = deforms_on_curve(p, shot);
    const int i = a->moves++;
    struct smear_measured_poses *m = &a->motion.measured;
    m->pose[i] = *project_pose(p, shot, k, a->mesh);
    m->position[i] = p->position[curves ? 1 : k];
    if (!SMEAR_PARTS_OF_DEFORMS || (!curves && p->deform == 256))
        return;
    const struct smear_projection whole = m->pose[i], *const in[2] = { &whole, &whole };
    struct smear_projection *const both[2] = { &m->pose[i], &m->rest[i] };
    const int32_t part = curves ? part_at(p, smear_shot_time(shot, k)) : (deformation_is_scaled(p, k) ? p->deform : 256) * 65536;
    const int32_t weight[2] = { part, (1 << 24) - part };
    a->has_rest = a->has_rest || weight[1] != 0;
    smear_projection_weigh(both, in, weight, 2, p->camera[0]);
}

/* ------------------------------------------------------------------ history */

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

int smear_history_keep(struct smear_history *h, int32_t at, uint32_t id, const smear_transform *pose, bool cut, smear_transform past[2])
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
