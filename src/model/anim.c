/* SPDX-License-Identifier: MIT */
/* anim.c - actors: a model's clips at an instant, as transforms and positions that a frame's draws take. It is optional.
 *
 *     clip     keys -> translation, rotation, scale of each node that moves; weights of morph targets
 *     nodes    each by its parent: basis Q8.24, origin Q16.16 model units
 *     draws    rigid: place x node; deformed: morph, then skin (skin.c), in steps of the mesh
 *
 * Factors are kept within +-8 and places within +-2048, so that four bits
 * of head room are enough for high products. */
#include "smear_model.h"

#include "base/arena.h"
#include "base/compiled.h"
#include "base/fixmath.h"
#include "model/skin.h"

#if SMEAR_WITH_MODEL

enum { POSES = 3, FACTOR_LIMIT = (1 << 27) - 1 };

struct actor_pose {
    smear_transform *transform;         /* 0: where the model is placed */
    int16_t *position;                  /* of deformed draws */
};

struct smear_actor {
    const smear_model *model;
    smear_transform *world;             /* where each node is, in model units */
    struct smear_joint_matrix *joint;   /* of the skin being posed */
    int16_t *weight;
    smear_mesh *mesh;                   /* of deformed draws */
    int8_t *normal;                     /* of deformed draws, now */
    struct actor_pose pose[POSES];
    uint8_t pose_count;
    uint8_t known;                      /* bit p: pose p has been set */
};

SMEAR_STATIC_ASSERT(sizeof(struct smear_actor) <= SMEAR_ACTOR_HEAD_BYTES,
                    "SMEAR_ACTOR_HEAD_BYTES is too small");
SMEAR_STATIC_ASSERT(sizeof(struct smear_joint_matrix) == 48, "SMEAR_ACTOR_MEMORY counts 48 bytes");

/* ------------------------------------------------------------------ transforms */

static int32_t within_factor(int32_t a)
{
    return clamp_i32(a, -FACTOR_LIMIT, FACTOR_LIMIT);
}

/* Returns a b for a in Q8.24 within +-8, in the format of b: Q8.24 within +-8, or Q16.16. */
static int32_t times_factor(int32_t a, int32_t b)
{
    return mulh_i32(shl_wrap(a, 4), shl_wrap(b, 4));
}

static int32_t row_times(const int32_t row[3], int32_t x, int32_t y, int32_t z)
{
    return add_wrap(add_wrap(times_factor(row[0], x), times_factor(row[1], y)), times_factor(row[2], z));
}

/* Computes parent x local; `out` is neither. */
static void compose(smear_transform *out, const smear_transform *parent, const smear_transform *local)
{
    for (int i = 0; i < 3; i++) {
        const int32_t *row = parent->basis + 3 * i;
        for (int j = 0; j < 3; j++)
            out->basis[3 * i + j] = within_factor(row_times(row, local->basis[j], local->basis[3 + j],
                                                            local->basis[6 + j]));
        const int32_t offset = row_times(row, local->origin[0], local->origin[1], local->origin[2]);
        out->origin[i] = within_factor(add_wrap(parent->origin[i], offset));
    }
}

/* Makes the rotation matrix, Q2.29, of a quaternion in Q2.30 of length 1/2 to 1. It needs no root: its entries are
 * 1 - 2 (y^2 + z^2) / |q|^2 and so on. */
static void rotation_from(int32_t out[9], const int32_t q[4])
{
    int32_t xx = mulh_i32(q[0], q[0]), yy = mulh_i32(q[1], q[1]), zz = mulh_i32(q[2], q[2]);     /* q28 */
    int32_t xy = mulh_i32(q[0], q[1]), xz = mulh_i32(q[0], q[2]), yz = mulh_i32(q[1], q[2]);
    int32_t wx = mulh_i32(q[3], q[0]), wy = mulh_i32(q[3], q[1]), wz = mulh_i32(q[3], q[2]);
    uint32_t square = (uint32_t)(xx + yy + zz + mulh_i32(q[3], q[3]));
    if (square < 1u << 20) {            /* no rotation at all: keys of a blob that nobody made */
        xx = yy = zz = xy = xz = yz = wx = wy = wz = 0;
        square = 1u << 28;
    }
    int zeros = count_leading_zeros(square);
    int32_t r = (int32_t)recip_norm_precise(square << zeros);           /* 2^(61 - zeros) / |q|^2 */
    const int32_t sum[9] = { -(yy + zz), xy - wz, xz + wy, xy + wz, -(xx + zz), yz - wx, xz - wy, yz + wx,
                             -(xx + yy) };
    for (int i = 0; i < 9; i++)
        out[i] = shl_wrap(mulh_i32(sum[i], r), zeros + 1) + (i % 4 == 0 ? 1 << 29 : 0);
}

/* Makes a node's transform from translation, rotation and scale as smear_model_node.rest has them. */
static void transform_from(smear_transform *out, const int32_t trs[10])
{
    int32_t rotation[9];
    rotation_from(rotation, trs + 6);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            out->basis[3 * i + j] = (mulh_i32(rotation[3 * i + j], shl_wrap(trs[3 + j], 4)) + 1) >> 1;
        out->origin[i] = trs[i];
    }
}

/* ------------------------------------------------------------------ clips */

/* A time within a channel: `part` / 2^14 of the time from key `key` to key `key + 1`. */
struct between {
    uint32_t key;
    int32_t part;
};

static struct between find_keys(const uint16_t *time, uint32_t count, uint32_t now, uint32_t tick_shift)
{
    uint32_t low = 0, high = count - 1, tick = now >> tick_shift;
    if (tick >= time[high])
        return (struct between){ high, 0 };
    if (now <= (uint32_t)time[0] << tick_shift)
        return (struct between){ 0, 0 };
    while (high - low > 1) {            /* time[low] <= tick < time[high] */
        uint32_t middle = (low + high) >> 1;
        if (tick >= time[middle])
            low = middle;
        else
            high = middle;
    }
    uint32_t since = now - ((uint32_t)time[low] << tick_shift);
    uint32_t span = (uint32_t)(time[high] - time[low]) << tick_shift;
    int zeros = count_leading_zeros(span);
    uint32_t part = mulh_u32(since << zeros, recip_norm_precise(span << zeros));        /* q29 */
    return (struct between){ low, (int32_t)min_u32((part + (1u << 14)) >> 15, 1u << 14) };
}

/* Returns value k of the channel between two keys, in 2^-14 steps of a key: at most 2^29. */
static int32_t mix_keys(const int16_t *from, uint32_t width, uint32_t k, int32_t part)
{
    int32_t value = from[k] * (1 << 14);
    return part == 0 ? value : value + (from[width + k] - from[k]) * part;
}

/* Returns value k of a channel: rotations in Q2.30, others in the unit of the channel's path. */
static int32_t channel_value(const smear_model *m, const smear_model_channel *c, struct between b, uint32_t k)
{
    const int16_t *from = m->key_value + c->value_first + b.key * c->width;
    int32_t value = mix_keys(from, c->width, k, c->step ? 0 : b.part);
    if (c->path == SMEAR_PATH_ROTATION)
        return value * 2;
    return within_factor(within_factor(scale_sat(mulh_i32(value, c->factor), c->shift))
                         + c->offset[c->path == SMEAR_PATH_WEIGHTS ? 0 : k]);
}

/* Returns the time within the clip, Q16.16 seconds. */
static uint32_t time_in_clip(const smear_model_clip *clip, const smear_play *play)
{
    int32_t duration = (int32_t)clip->duration, rest = play->time;
    if (play->loop && duration > 0) {
        divide_floor(play->time, duration, &rest);
        return (uint32_t)rest;
    }
    return (uint32_t)clamp_i32(rest, 0, duration);
}

/* ------------------------------------------------------------------ nodes */

/* The clip's channels that have not been used yet, sorted by node. */
struct cursor {
    const smear_model_channel *channel, *end;
    uint32_t now, tick_shift;
};

static struct between find_in(const smear_model *m, const struct cursor *c)
{
    return find_keys(m->key_time + c->channel->time_first, c->channel->key_count, c->now, c->tick_shift);
}

static struct cursor start_clip(const smear_model *m, const smear_play *play)
{
    struct cursor c = { 0 };
    if (play->rest || m->clip_count == 0)
        return c;
    const smear_model_clip *clip = m->clip + play->clip;
    c.channel = m->channel + clip->channel_first;
    c.end = c.channel + clip->channel_count;
    c.now = time_in_clip(clip, play);
    c.tick_shift = clip->tick_shift;
    return c;
}

static void local_of(smear_transform *out, const smear_model *m, uint32_t index, struct cursor *c)
{
    const smear_model_node *n = m->node + index;
    int32_t trs[10];
    if (!n->moves) {
        for (int i = 0; i < 9; i++)
            out->basis[i] = n->rest[i];
        for (int i = 0; i < 3; i++)
            out->origin[i] = n->rest[9 + i];
        return;
    }
    for (int i = 0; i < 10; i++)
        trs[i] = n->rest[i];
    for (; c->channel != c->end && c->channel->target == index; c->channel++) {
        if (c->channel->path == SMEAR_PATH_WEIGHTS)
            break;
        static const uint8_t first[3] = { 0, 6, 3 };        /* of translation, rotation, scale */
        struct between b = find_in(m, c);
        for (uint32_t k = 0; k < c->channel->width; k++)
            trs[first[c->channel->path] + k] = channel_value(m, c->channel, b, k);
    }
    transform_from(out, trs);
}

/* Finds where all nodes are, and the weights of morph targets. */
static void pose_nodes(struct smear_actor *a, const smear_play *play)
{
    const smear_model *m = a->model;
    struct cursor c = start_clip(m, play);
    for (uint32_t i = 0; i < m->node_count; i++) {
        smear_transform local, moved, *world = a->world + i;
        uint16_t parent = m->node[i].parent;
        local_of(&local, m, i, &c);
        for (uint32_t k = 0; k < play->move_count; k++)
            if (play->move[k].node == i) {
                smear_transform by = play->move[k].local;
                for (int j = 0; j < 9; j++)
                    by.basis[j] = within_factor(by.basis[j]);
                for (int j = 0; j < 3; j++)
                    by.origin[j] = within_factor(by.origin[j]);
                compose(&moved, &local, &by);
                local = moved;
            }
        if (parent == SMEAR_MODEL_NONE)
            *world = local;
        else
            compose(world, a->world + parent, &local);
    }
    for (uint32_t i = 0; i < m->weight_count; i++)
        a->weight[i] = m->weight[i];
    for (; c.channel != c.end; c.channel++) {
        if (c.channel->path != SMEAR_PATH_WEIGHTS)
            continue;
        struct between b = find_in(m, &c);
        for (uint32_t k = 0; k < c.channel->width; k++)
            a->weight[c.channel->target + k] =
                (int16_t)clamp_i32(channel_value(m, c.channel, b, k), -32767, 32767);
    }
}

/* ------------------------------------------------------------------ draws */

/* Makes the transform of a node's draws: place x world, in world units. */
static void place_node(smear_transform *out, const smear_transform *place, const smear_transform *world,
                       int unit_shift)
{
    for (int i = 0; i < 3; i++) {
        const int32_t *row = place->basis + 3 * i;
        for (int j = 0; j < 3; j++)
            out->basis[3 * i + j] = row_times(row, world->basis[j], world->basis[3 + j], world->basis[6 + j]);
        int32_t along = row_times(row, world->origin[0], world->origin[1], world->origin[2]);
        out->origin[i] = narrow_sat((int64_t)place->origin[i] + scale_sat(along, unit_shift));
    }
}

static void pose_joints(struct smear_actor *a, const smear_model_skin *skin)
{
    const smear_model_joint *joint = a->model->joint + skin->joint_first;
    for (uint32_t i = 0; i < skin->joint_count; i++, joint++) {
        const smear_transform *w = a->world + joint->node;
        struct smear_joint_matrix *out = a->joint + i;
        for (int row = 0; row < 3; row++) {
            const int32_t *basis = w->basis + 3 * row, *origin = joint->origin;
            for (int k = 0; k < 3; k++)             /* q20 to q14 */
                out->row[row][k] = clamp_i32(
                    scale_sat(add_wrap(add_wrap(mulh_i32(shl_wrap(basis[0], 4), joint->basis[k]),
                                                mulh_i32(shl_wrap(basis[1], 4), joint->basis[3 + k])),
                                       mulh_i32(shl_wrap(basis[2], 4), joint->basis[6 + k])), -6),
                    -SMEAR_JOINT_LIMIT, SMEAR_JOINT_LIMIT);
            int32_t at = within_factor(add_wrap(w->origin[row],
                                                row_times(basis, origin[0], origin[1], origin[2])));
            int32_t step = scale_sat(mulh_i32(shl_wrap(at, 4), skin->steps), skin->shift);
            out->row[row][3] = clamp_i32(within_factor(step) - skin->offset[row], -SMEAR_JOINT_ORIGIN_LIMIT,
                                         SMEAR_JOINT_ORIGIN_LIMIT);
        }
    }
}

static void copy_positions(int16_t *out, const int16_t *in, uint32_t vertices)
{
    for (uint32_t i = 0; i < 3 * vertices; i++)
        out[i] = in[i];
}

static void pose_positions(struct smear_actor *a, const smear_model_draw *d, int16_t *out)
{
    const smear_model *m = a->model;
    const smear_mesh *mesh = m->mesh + d->mesh;
    const int16_t *in = mesh->position;
    if (d->target_count > 0) {
        copy_positions(out, in, mesh->vertex_count);
        in = out;
        for (uint32_t k = 0; k < d->target_count; k++)
            if (a->weight[d->weight_first + k] != 0)
                smear_morph_positions(out, m->target + d->target_first + k, m->delta,
                                      a->weight[d->weight_first + k]);
    }
    if (d->skin != SMEAR_MODEL_NONE) {
        struct smear_influences influences = { m->influence + d->influence_first, d->influences,
                                               mesh->vertex_count };
        smear_skin_positions(out, in, &influences, a->joint);
    }
}

static void pose_normals(struct smear_actor *a, const smear_model_draw *d, int8_t *out)
{
    const smear_model *m = a->model;
    const smear_mesh *mesh = m->mesh + d->mesh;
    const int8_t *in = mesh->normal;
    bool changed = false;
    if (d->target_count > 0 || d->skin == SMEAR_MODEL_NONE) {
        for (uint32_t i = 0; i < 3u * mesh->vertex_count; i++)
            out[i] = in[i];
        in = out;
    }
    for (uint32_t k = 0; k < d->target_count; k++) {
        const smear_model_target *target = m->target + d->target_first + k;
        int16_t weight = a->weight[d->weight_first + k];
        if (weight == 0 || target->normal_first == SMEAR_MODEL_NO_NORMALS)
            continue;
        smear_morph_normals(out, target, m->delta, m->delta_normal, weight);
        changed = true;
    }
    if (d->skin != SMEAR_MODEL_NONE) {
        struct smear_influences influences = { m->influence + d->influence_first, d->influences,
                                               mesh->vertex_count };
        smear_skin_normals(out, in, &influences, a->joint);
    } else if (changed) {
        smear_unit_normals(out, mesh->vertex_count);
    }
}

static void pose_draws(struct smear_actor *a, uint32_t which)
{
    const smear_model *m = a->model;
    struct actor_pose *pose = &a->pose[which];
    uint32_t skin = SMEAR_MODEL_NONE;
    for (uint32_t i = 0; i < m->draw_count; i++) {
        const smear_model_draw *d = m->draw + i;
        if (d->node != SMEAR_MODEL_NONE && d->transform != 0)
            place_node(&pose->transform[d->transform], &pose->transform[0], a->world + d->node,
                       m->unit_shift);
        if (d->deformed == SMEAR_MODEL_NONE)
            continue;
        if (d->skin != SMEAR_MODEL_NONE && d->skin != skin) {
            skin = d->skin;
            pose_joints(a, m->skin + skin);
        }
        pose_positions(a, d, pose->position + 3 * d->vertex_first);
        if (which == SMEAR_POSE_NOW && m->mesh[d->mesh].normal != NULL)
            pose_normals(a, d, a->normal + 3 * d->vertex_first);
    }
}

/* ------------------------------------------------------------------ actors */

static size_t lay_out_actor(struct smear_actor *actor, const smear_model *m, int poses, void *memory)
{
    struct smear_arena a = { (uint8_t *)memory, 0 };
    arena_take(&a, 1, SMEAR_ACTOR_HEAD_BYTES);
    actor->world = arena_take(&a, m->node_count, sizeof *actor->world);
    actor->joint = arena_take(&a, m->joint_count, sizeof *actor->joint);
    actor->weight = arena_take(&a, m->weight_count, sizeof *actor->weight);
    actor->mesh = arena_take(&a, m->deformed_count, sizeof *actor->mesh);
    actor->normal = arena_take(&a, m->normals ? m->deformed_vertices : 0, 3);
    for (int i = 0; i < poses; i++) {
        actor->pose[i].transform = arena_take(&a, m->transform_count, sizeof *actor->pose[i].transform);
        actor->pose[i].position = arena_take(&a, m->deformed_vertices, 6);
    }
    return a.used;
}

size_t smear_actor_memory(const smear_model *model, int poses)
{
    struct smear_actor measured;
    if (model == NULL || poses < 1 || poses > POSES)
        return 0;
    return lay_out_actor(&measured, model, poses, NULL);
}

int smear_actor_init(smear_actor **actor, const smear_model *model, int poses, void *memory, size_t bytes)
{
    if (actor == NULL || model == NULL || poses < 1 || poses > POSES)
        return SMEAR_ERR_ARG;
    *actor = NULL;
    if (memory == NULL || ((uintptr_t)memory & 7u) != 0 || bytes < smear_actor_memory(model, poses))
        return SMEAR_ERR_MEMORY;
    struct smear_actor *a = (struct smear_actor *)memory;
    *a = (struct smear_actor){ .model = model, .pose_count = (uint8_t)poses };
    lay_out_actor(a, model, poses, memory);
    for (uint32_t i = 0; i < model->draw_count; i++) {
        const smear_model_draw *d = model->draw + i;
        if (d->deformed == SMEAR_MODEL_NONE)
            continue;
        a->mesh[d->deformed] = model->mesh[d->mesh];
        if (model->mesh[d->mesh].normal != NULL)
            a->mesh[d->deformed].normal = a->normal + 3 * d->vertex_first;
    }
    *actor = a;
    return SMEAR_OK;
}

static bool can_play(const struct smear_actor *a, const smear_play *play)
{
    return a != NULL && play != NULL
        && (play->rest || play->clip < a->model->clip_count || a->model->clip_count == 0)
        && (play->move != NULL || play->move_count == 0);
}

int smear_actor_set(smear_actor *a, smear_pose pose, const smear_play *play)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    uint32_t which = (uint32_t)pose;
    if (!can_play(a, play) || which >= a->pose_count)
        return SMEAR_ERR_ARG;
    smear_transform *place = &a->pose[which].transform[0];
    *place = play->place != NULL ? *play->place : identity;
    for (int i = 0; i < 9; i++)
        place->basis[i] = within_factor(place->basis[i]);
    pose_nodes(a, play);
    pose_draws(a, which);
    a->known = (uint8_t)(a->known | 1u << which);
    return SMEAR_OK;
}

int smear_actor_advance(smear_actor *a, const smear_play *play)
{
    if (!can_play(a, play))
        return SMEAR_ERR_ARG;
    const struct actor_pose oldest = a->pose[a->pose_count - 1];
    for (int i = a->pose_count - 1; i > 0; i--)
        a->pose[i] = a->pose[i - 1];
    a->pose[SMEAR_POSE_NOW] = oldest;
    a->known = (uint8_t)(((unsigned)a->known << 1) & ((1u << a->pose_count) - 1u));
    return smear_actor_set(a, SMEAR_POSE_NOW, play);
}

void smear_actor_cut(smear_actor *a)
{
    a->known = (uint8_t)(a->known & 1u << SMEAR_POSE_NOW);
}

int smear_actor_draw(smear_actor *a, int index, smear_draw *draw)
{
    if (a == NULL || draw == NULL || index < 0 || index >= a->model->draw_count || (a->known & 1u) == 0)
        return SMEAR_ERR_ARG;
    const smear_model_draw *d = a->model->draw + index;
    bool has_open = a->known & 1u << SMEAR_POSE_OPEN, has_close = a->known & 1u << SMEAR_POSE_CLOSE;
    *draw = (smear_draw){ .mesh = a->model->mesh + d->mesh,
                          .now = a->pose[SMEAR_POSE_NOW].transform + d->transform };
    if (d->material != SMEAR_MODEL_NONE)
        draw->material = a->model->material + d->material;
    if (has_open)
        draw->open = a->pose[SMEAR_POSE_OPEN].transform + d->transform;
    if (has_close)
        draw->close = a->pose[SMEAR_POSE_CLOSE].transform + d->transform;
    draw->cut = !has_open && !has_close;
    if (d->deformed == SMEAR_MODEL_NONE)
        return SMEAR_OK;
    smear_mesh *mesh = a->mesh + d->deformed;
    mesh->position = a->pose[SMEAR_POSE_NOW].position + 3 * d->vertex_first;
    __builtin_memset(mesh->bounds, 0, sizeof mesh->bounds);
    draw->mesh = mesh;
    /* Where no other is known that of now: its vertices are not those of the last frame, in the same memory (damage.h). */
    if (has_open || SMEAR_DEFORM_MOST)
        draw->open_position = has_open ? a->pose[SMEAR_POSE_OPEN].position + 3 * d->vertex_first : mesh->position;
    if (has_close)
        draw->close_position = a->pose[SMEAR_POSE_CLOSE].position + 3 * d->vertex_first;
    return SMEAR_OK;
}

int smear_actor_submit(smear_actor *a, smear_context *ctx)
{
    int result = a != NULL && ctx != NULL ? SMEAR_OK : SMEAR_ERR_ARG;
    for (int i = 0; result == SMEAR_OK && i < a->model->draw_count; i++) {
        smear_draw draw;
        result = smear_actor_draw(a, i, &draw);
        if (result == SMEAR_OK)
            result = smear_submit(ctx, &draw);
    }
    return result;
}

#endif
