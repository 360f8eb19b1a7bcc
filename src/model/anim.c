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

#include "base/base.h"
#include "base/compiled.h"
#include "base/fixmath.h"
#include "model/skin.h"

#if SMEAR_WITH_MODEL

enum { POSES = 3, FACTOR_LIMIT = (1 << 27) - 1, JUMP_HELD = 1, JUMP_MIXED = 2 };

struct actor_pose {
    smear_transform *transform;         /* 0: where the model is placed */
    int16_t *position;                  /* of deformed draws */
};

/* What of a play its clip is sampled by. */
struct clip_time {
    int32_t time;
    uint16_t clip;
    uint8_t rest, loop;
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
    uint8_t bent;                       /* bit p: and is not what its play alone would make of it, as the clip jumps up to now */
    uint8_t jumps;                      /* which channels of the model may: JUMP_HELD, JUMP_MIXED */
    struct clip_time when[POSES];
};

SMEAR_STATIC_ASSERT(sizeof(struct smear_actor) <= SMEAR_ACTOR_HEAD_BYTES,
                    "SMEAR_ACTOR_HEAD_BYTES is too small");
SMEAR_STATIC_ASSERT(sizeof(struct smear_joint_matrix) == 48, "SMEAR_ACTOR_MEMORY counts 48 bytes");

/* ------------------------------------------------------------------ transforms */

static SMEAR_NOINLINE int32_t within_factor(int32_t a) { return clamp_i32(a, -FACTOR_LIMIT, FACTOR_LIMIT); }

static SMEAR_NOINLINE void keep_within_factor(int32_t a[], int count)
{
    for (int i = 0; i < count; i++)
        a[i] = within_factor(a[i]);
}

/* Returns 1/16 of the product of a row in Q8.24 within +-8 and a vector, in its format. */
static SMEAR_NOINLINE int32_t row_times_high(const int32_t row[3], int32_t x, int32_t y, int32_t z)
{
    return add_wrap(add_wrap(mulh_i32(shl_wrap(row[0], 4), x), mulh_i32(shl_wrap(row[1], 4), y)), mulh_i32(shl_wrap(row[2], 4), z));
}

/* Returns the product where the vector is Q8.24 within +-8, or Q16.16. */
static int32_t row_times(const int32_t row[3], int32_t x, int32_t y, int32_t z)
{
    return row_times_high(row, shl_wrap(x, 4), shl_wrap(y, 4), shl_wrap(z, 4));
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
    if (now < (uint32_t)time[0] << tick_shift)
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

/* Where a channel is sampled. Reflected: as far from the value of key `about` as what is found there, on the other side. */
struct sampled {
    struct between at;
    uint32_t about;
    bool is_reflected;
};

/* Returns value k of a channel that is no rotation, in the unit of its path. */
static int32_t channel_value(const smear_model *m, const smear_model_channel *c, const struct sampled *s, uint32_t k)
{
    const int16_t *keys = m->key_value + c->value_first;
    int32_t value = mix_keys(keys + s->at.key * c->width, c->width, k, s->at.part);
    if (s->is_reflected)
        value = keys[s->about * c->width + k] * (1 << 15) - value;
    return within_factor(within_factor(scale_sat(mulh_i32(value, c->factor), c->shift))
                         + c->offset[c->path == SMEAR_PATH_WEIGHTS ? 0 : k]);
}

/* Finds the quaternion of a rotation, Q2.30; that on the other side of a is 2 (a b) a - b, and half of it does. Keys of a blob
 * that nobody made may wrap, but stay as small. */
static void channel_turn(const smear_model *m, const smear_model_channel *c, const struct sampled *s, int32_t out[4])
{
    const int16_t *keys = m->key_value + c->value_first, *about = keys + 4 * s->about;
    int32_t dot = 0;                    /* q28 */
    for (uint32_t k = 0; k < 4; k++)
        out[k] = mix_keys(keys + 4 * s->at.key, 4, k, s->at.part) * 2;
    if (!s->is_reflected)
        return;
    for (int k = 0; k < 4; k++)
        dot = add_wrap(dot, mulh_i32(about[k] * (1 << 15), out[k]));
    for (int k = 0; k < 4; k++)
        out[k] = clamp_i32(sub_wrap(shl_wrap(mulh_i32(shl_wrap(dot, 2), about[k] * (1 << 15)), 2), out[k] >> 1), -(1 << 30),
                           1 << 30);
}

/* ------------------------------------------------------------------ jumps */

/* The clip's channels that have not been used yet, sorted by node, and the way from the pose `now` to the pose that is made:
 * Q16.16 seconds within the clip. */
struct cursor {
    const smear_model_channel *channel, *end;
    uint32_t time, now, duration, tick_shift;
    int32_t along;              /* `time` counted from the start that `now` is counted from */
    bool starts_again;          /* the clip does, on this way */
};

/* Sets both times and what lies between. A program that counts time anew with each turn of the clip goes back by most of it. */
static void find_way(struct cursor *c, const struct clip_time *pose, const struct clip_time *now)
{
    const int32_t duration = (int32_t)c->duration, ahead = sub_wrap(pose->time, now->time);
    int32_t time = clamp_i32(pose->time, 0, duration), at = clamp_i32(now->time, 0, duration);
    c->along = time;
    if (now->loop && duration > 0) {
        divide_floor(now->time, duration, &at);
        divide_floor(pose->time, duration, &time);
        c->along = add_wrap(at, ahead);
    }
    if ((now->loop ? ahead : time - at) > duration >> 1)
        c->along = time - duration;
    c->time = (uint32_t)time;
    c->now = (uint32_t)at;
    c->starts_again = c->along != time;
}

static struct cursor start_clip(const smear_model *m, const struct clip_time *pose, const struct clip_time *now)
{
    struct cursor c = { 0 };
    if (now->rest || m->clip_count == 0)
        return c;
    const smear_model_clip *clip = m->clip + now->clip;
    c.channel = m->channel + clip->channel_first;
    c.end = c.channel + clip->channel_count;
    c.duration = clip->duration;
    c.tick_shift = clip->tick_shift;
    find_way(&c, pose->rest || pose->clip != now->clip ? now : pose, now);
    return c;
}

enum { NO_KEY = -1 };

static int32_t key_time(const uint16_t *time, int32_t key, uint32_t tick_shift)
{
    return (int32_t)((uint32_t)time[key] << tick_shift);
}

/* The first key on the way from key `from` towards `goal` behind which the channel jumps: to another key at the same time. */
static int32_t find_jump(const uint16_t *time, uint32_t count, uint32_t tick_shift, uint32_t from, int32_t goal)
{
    int32_t key = (int32_t)from;
    for (; key > 0 && key_time(time, key, tick_shift) > goal; key--)
        if (time[key] == time[key - 1])
            return key;
    for (; key + 1 < (int32_t)count && key_time(time, key, tick_shift) <= goal; key++)
        if (time[key] == time[key + 1])
            return key;
    return NO_KEY;
}

/* Whether the last key is the first one, to 1/1024 of what the keys range over. */
static bool ends_meet(const smear_model *m, const smear_model_channel *c)
{
    const int16_t *first = m->key_value + c->value_first, *last = first + (c->key_count - 1u) * c->width;
    int32_t apart = 0, opposed = 0;
    for (uint32_t k = 0; k < c->width; k++) {
        apart = max_i32(apart, abs_i32(last[k] - first[k]));
        opposed = max_i32(opposed, abs_i32(last[k] + first[k]));
    }
    return c->path == SMEAR_PATH_ROTATION ? min_i32(apart, opposed) <= 32 : apart <= 64;
}

/* What is so long before `at` (or behind it, where that is negative) beyond the key `about`, as if nothing jumped there. */
static struct sampled reflect(const smear_model *m, const struct cursor *c, uint32_t about, int32_t at, int32_t before)
{
    const uint16_t *time = m->key_time + c->channel->time_first;
    const uint32_t count = c->channel->key_count;
    const int32_t goal = at + clamp_i32(before, -at, (int32_t)c->duration - at);
    const int32_t next = find_jump(time, count, c->tick_shift, about, goal);
    return (struct sampled){ next != NO_KEY ? (struct between){ (uint32_t)next, 0 }
                                            : find_keys(time, count, (uint32_t)goal, c->tick_shift),
                             about, true };
}

/* Where a path starts that ends in the values of now: on their side of what jumps between. */
static struct sampled find_in(const smear_model *m, const struct cursor *c)
{
    const smear_model_channel *channel = c->channel;
    const uint16_t *time = m->key_time + channel->time_first;
    const uint32_t count = channel->key_count;
    const int32_t along = c->along;
    struct between now = find_keys(time, count, c->now, c->tick_shift);
    if (channel->step)
        now.part = 0;
    if (channel->step || along == (int32_t)c->now)
        return (struct sampled){ now, 0, false };
    int32_t near = find_jump(time, count, c->tick_shift, now.key, along), goal = along;
    if (near == NO_KEY && c->starts_again) {
        const bool is_past = along < (int32_t)c->now;
        if (!ends_meet(m, channel)) {
            const int32_t end = is_past ? 0 : (int32_t)c->duration;
            return reflect(m, c, is_past ? 0 : count - 1, end, sub_wrap(end, along));
        }
        goal = (int32_t)c->time;
        near = find_jump(time, count, c->tick_shift, is_past ? count - 1 : 0, goal);
    }
    if (near == NO_KEY)
        return (struct sampled){ find_keys(time, count, c->time, c->tick_shift), 0, false };
    const int32_t at = key_time(time, near, c->tick_shift);
    return reflect(m, c, (uint32_t)near, at, sub_wrap(at, goal));
}

/* Whether the actor's pose is another one for a path up to now than by itself. */
static bool jumps_up_to_now(const struct smear_actor *a, uint32_t which)
{
    const smear_model *m = a->model;
    const struct clip_time *pose = &a->when[which], *now = &a->when[SMEAR_POSE_NOW];
    if (pose->rest != now->rest || (!now->rest && pose->clip != now->clip))
        return true;
    struct cursor c = start_clip(m, pose, now);
    const uint8_t jumps = c.starts_again ? a->jumps | JUMP_MIXED : a->jumps;
    for (; jumps != 0 && c.channel != c.end; c.channel++) {
        if ((jumps & (c.channel->step ? JUMP_HELD : JUMP_MIXED)) == 0)
            continue;
        const struct sampled s = find_in(m, &c);
        if (s.is_reflected)
            return true;
        if (c.channel->step && s.at.key != find_keys(m->key_time + c.channel->time_first, c.channel->key_count, c.time,
                                                     c.tick_shift).key)
            return true;
    }
    return false;
}

/* Most models have no jumps but where clips start again: then nothing is looked for in between. */
static uint8_t find_jumps(const smear_model *m)
{
    unsigned jumps = 0;
    for (uint32_t i = 0; i < m->clip_count; i++)
        for (uint32_t k = 0; k < m->clip[i].channel_count; k++) {
            const smear_model_channel *c = m->channel + m->clip[i].channel_first + k;
            const uint16_t *time = m->key_time + c->time_first;
            if (c->step)
                jumps |= JUMP_HELD;
            for (uint32_t key = 1; !c->step && key < c->key_count; key++)
                if (time[key] == time[key - 1])
                    jumps |= JUMP_MIXED;
        }
    return (uint8_t)jumps;
}

/* ------------------------------------------------------------------ nodes */

static void local_of(smear_transform *out, const smear_model *m, uint32_t index, struct cursor *c)
{
    const smear_model_node *n = m->node + index;
    int32_t trs[10];
    if (!n->moves) {
        __builtin_memcpy(out->basis, n->rest, sizeof out->basis);
        __builtin_memcpy(out->origin, n->rest + 9, sizeof out->origin);
        return;
    }
    __builtin_memcpy(trs, n->rest, sizeof trs);
    for (; c->channel != c->end && c->channel->target == index; c->channel++) {
        if (c->channel->path == SMEAR_PATH_WEIGHTS)
            break;
        static const uint8_t first[3] = { 0, 6, 3 };        /* of translation, rotation, scale */
        const struct sampled s = find_in(m, c);
        int32_t *value = trs + first[c->channel->path];
        if (c->channel->path == SMEAR_PATH_ROTATION)
            channel_turn(m, c->channel, &s, value);
        else
            for (uint32_t k = 0; k < 3; k++)
                value[k] = channel_value(m, c->channel, &s, k);
    }
    transform_from(out, trs);
}

/* Finds where all nodes are, and the weights of morph targets. */
static void pose_nodes(struct smear_actor *a, const smear_play *play, struct cursor c)
{
    const smear_model *m = a->model;
    for (uint32_t i = 0; i < m->node_count; i++) {
        smear_transform local, moved, *world = a->world + i;
        uint16_t parent = m->node[i].parent;
        local_of(&local, m, i, &c);
        for (uint32_t k = 0; k < play->move_count; k++)
            if (play->move[k].node == i) {
                smear_transform by = play->move[k].local;
                keep_within_factor(by.basis, 9);
                keep_within_factor(by.origin, 3);
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
        const struct sampled s = find_in(m, &c);
        for (uint32_t k = 0; k < c.channel->width; k++)
            a->weight[c.channel->target + k] =
                (int16_t)clamp_i32(channel_value(m, c.channel, &s, k), -32767, 32767);
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
                    scale_sat(row_times_high(basis, joint->basis[k], joint->basis[3 + k], joint->basis[6 + k]), -6),
                    -SMEAR_JOINT_LIMIT, SMEAR_JOINT_LIMIT);
            int32_t at = within_factor(add_wrap(w->origin[row],
                                                row_times(basis, origin[0], origin[1], origin[2])));
            int32_t step = scale_sat(mulh_i32(shl_wrap(at, 4), skin->steps), skin->shift);
            out->row[row][3] = clamp_i32(within_factor(step) - skin->offset[row], -SMEAR_JOINT_ORIGIN_LIMIT,
                                         SMEAR_JOINT_ORIGIN_LIMIT);
        }
    }
}

static void pose_positions(struct smear_actor *a, const smear_model_draw *d, int16_t *out)
{
    const smear_model *m = a->model;
    const smear_mesh *mesh = m->mesh + d->mesh;
    const int16_t *in = mesh->position;
    if (d->target_count > 0) {
        __builtin_memcpy(out, in, 3u * mesh->vertex_count * sizeof *out);
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
        __builtin_memcpy(out, in, 3u * mesh->vertex_count);
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
    *a = (struct smear_actor){ .model = model, .pose_count = (uint8_t)poses, .jumps = find_jumps(model) };
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

/* Makes a pose, for a path up to now. Nodes that the program moves are where `play` has them. */
static void make_pose(struct smear_actor *a, uint32_t which, const smear_play *play)
{
    const unsigned bit = 1u << which;
    const bool is_bent = which != SMEAR_POSE_NOW && (a->known & 1u << SMEAR_POSE_NOW) != 0 && jumps_up_to_now(a, which);
    const struct clip_time *pose = &a->when[which];
    pose_nodes(a, play, start_clip(a->model, pose, is_bent ? &a->when[SMEAR_POSE_NOW] : pose));
    pose_draws(a, which);
    a->bent = (uint8_t)(is_bent ? a->bent | bit : a->bent & ~bit);
}

int smear_actor_set(smear_actor *a, smear_pose pose, const smear_play *play)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    uint32_t which = (uint32_t)pose;
    if (!can_play(a, play) || which >= a->pose_count)
        return SMEAR_ERR_ARG;
    smear_transform *place = &a->pose[which].transform[0];
    *place = play->place != NULL ? *play->place : identity;
    keep_within_factor(place->basis, 9);
    a->when[which] = (struct clip_time){ play->time, play->clip, play->rest, play->loop };
    a->known = (uint8_t)(a->known | 1u << which);
    make_pose(a, which, play);
    for (uint32_t p = SMEAR_POSE_OPEN; which == SMEAR_POSE_NOW && p < a->pose_count; p++)
        if ((a->known & 1u << p) != 0 && ((a->bent & 1u << p) != 0 || jumps_up_to_now(a, p)))
            make_pose(a, p, play);
    return SMEAR_OK;
}

int smear_actor_advance(smear_actor *a, const smear_play *play)
{
    if (!can_play(a, play))
        return SMEAR_ERR_ARG;
    const struct actor_pose oldest = a->pose[a->pose_count - 1];
    for (int i = a->pose_count - 1; i > 0; i--) {
        a->pose[i] = a->pose[i - 1];
        a->when[i] = a->when[i - 1];
    }
    a->pose[SMEAR_POSE_NOW] = oldest;
    a->known = (uint8_t)(((unsigned)a->known << 1) & ((1u << a->pose_count) - 1u));
    a->bent = (uint8_t)((unsigned)a->bent << 1);
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
