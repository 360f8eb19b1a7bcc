/* SPDX-License-Identifier: MIT */
/* pose.c - a model at an instant: channels to node transforms, transforms to the world, then morphs
 * and skins. Equations are those of glTF 2.0 (3.7 meshes and skins). */
#include "tools/model/channel.h"
#include "tools/model/matrix.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Beyond this a pose is refused: products of such numbers with positions stay finite. */
static const double max_world = 1e30;

struct trs {
    double translation[3], rotation[4], scale[3];
};

struct pose_scratch {
    struct trs *trs;            /* per node */
    int *weight_at;             /* per node: where its morph weights start */
    double *weight;
    double *joint;              /* 16 per joint of the skin at hand */
};

static int node_weight_count(const struct model *model, int node)
{
    int mesh = model->node[node].mesh;
    return mesh < 0 ? 0 : model->mesh[mesh].weight_count;
}

static bool is_skinned(const struct model_node *node, const struct model_primitive *p)
{
    return node->skin >= 0 && p->joint != NULL;
}

/* --- the pose's own memory --- */

static void free_scratch(struct pose_scratch *scratch)
{
    if (scratch == NULL)
        return;
    free(scratch->trs);
    free(scratch->weight_at);
    free(scratch->weight);
    free(scratch->joint);
    free(scratch);
}

void model_pose_free(struct model_pose *pose)
{
    for (int i = 0; i < pose->owned_count; i++)
        free(pose->owned[i]);
    free(pose->owned);
    free(pose->draw);
    free(pose->node_world);
    free_scratch(pose->scratch);
    *pose = (struct model_pose){ 0 };
}

static void *array(size_t count, size_t size)
{
    return calloc(count == 0 ? 1 : count, size);
}

static bool make_scratch(const struct model *model, struct model_pose *pose)
{
    size_t nodes = (size_t)model->node_count, weights = 0, joints = 0;
    for (int i = 0; i < model->skin_count; i++) {
        if ((size_t)model->skin[i].joint_count > joints)
            joints = (size_t)model->skin[i].joint_count;
    }
    struct pose_scratch *s = pose->scratch = calloc(1, sizeof *s);
    if (s == NULL || (s->weight_at = array(nodes, sizeof *s->weight_at)) == NULL)
        return false;
    for (int i = 0; i < model->node_count; i++) {
        s->weight_at[i] = (int)weights;
        weights += (size_t)node_weight_count(model, i);
    }
    s->trs = array(nodes, sizeof *s->trs);
    s->weight = array(weights, sizeof *s->weight);
    s->joint = array(joints * 16, sizeof *s->joint);
    return s->trs != NULL && s->weight != NULL && s->joint != NULL;
}

/* Gives draw `d` arrays of its own. */
static bool own_arrays(struct model_pose *pose, struct model_draw *d)
{
    size_t bytes = (size_t)d->primitive->vertex_count * 3 * sizeof(float);
    float *position = malloc(bytes), *normal = NULL;
    pose->owned[pose->owned_count++] = position;
    if (d->primitive->normal != NULL) {
        normal = malloc(bytes);
        pose->owned[pose->owned_count++] = normal;
    }
    d->deformed = true;
    d->position = position;
    d->normal = normal;
    return position != NULL && (normal != NULL || d->primitive->normal == NULL);
}

static bool make_draws(const struct model *model, struct model_pose *pose)
{
    size_t count = 0;
    for (int i = 0; i < model->node_count; i++) {
        if (model->in_scene[i] && model->node[i].mesh >= 0)
            count += (size_t)model->mesh[model->node[i].mesh].primitive_count;
    }
    pose->draw = array(count, sizeof *pose->draw);
    pose->owned = array(count * 2, sizeof *pose->owned);
    if (pose->draw == NULL || pose->owned == NULL)
        return false;
    for (int i = 0; i < model->node_count; i++) {
        const struct model_node *node = &model->node[i];
        if (!model->in_scene[i] || node->mesh < 0)
            continue;
        const struct model_mesh *mesh = &model->mesh[node->mesh];
        for (int k = 0; k < mesh->primitive_count; k++) {
            const struct model_primitive *p = &mesh->primitive[k];
            struct model_draw *d = &pose->draw[pose->draw_count++];
            *d = (struct model_draw){ .node = i, .primitive_of_mesh = k, .primitive = p,
                                      .position = p->position, .normal = p->normal };
            if ((p->target_count > 0 || is_skinned(node, p)) && !own_arrays(pose, d))
                return false;
        }
    }
    return true;
}

static bool prepare(const struct model *model, struct model_pose *pose, struct failure *f)
{
    if (pose->model == model)
        return true;
    model_pose_free(pose);
    pose->node_world = array((size_t)model->node_count * 16, sizeof *pose->node_world);
    if (pose->node_world == NULL || !make_scratch(model, pose) || !make_draws(model, pose)) {
        model_pose_free(pose);
        return fail(f, "out of memory (a pose of %d nodes)", model->node_count);
    }
    pose->model = model;
    return true;
}

/* --- channels --- */

static void set_rest(const struct model *model, struct pose_scratch *s)
{
    for (int i = 0; i < model->node_count; i++) {
        const struct model_node *node = &model->node[i];
        memcpy(s->trs[i].translation, node->translation, sizeof node->translation);
        memcpy(s->trs[i].rotation, node->rotation, sizeof node->rotation);
        memcpy(s->trs[i].scale, node->scale, sizeof node->scale);
        int count = node_weight_count(model, i);
        const float *weight = node->weight != NULL ? node->weight :
                              count > 0 ? model->mesh[node->mesh].weight : NULL;
        for (int k = 0; k < count; k++)
            s->weight[s->weight_at[i] + k] = (double)weight[k];
    }
}

static void apply_clip(const struct model_clip *clip, const struct channel_way *way, struct pose_scratch *s)
{
    for (int i = 0; i < clip->channel_count; i++) {
        const struct model_channel *c = &clip->channel[i];
        struct trs *trs = &s->trs[c->node];
        double *out = c->path == MODEL_TRANSLATION ? trs->translation :
                      c->path == MODEL_ROTATION ? trs->rotation :
                      c->path == MODEL_SCALE ? trs->scale : s->weight + s->weight_at[c->node];
        channel_join(c, way, out);
    }
}

/* The way from `now` to `time` in a clip that starts again after `duration` seconds, or, at 0, never does. */
static struct channel_way way_between(double time, double now, double duration)
{
    struct channel_way way = { .time = time, .now = now, .along = time, .end = duration };
    if (!(duration > 0))
        return way;
    way.time = fmod(time, duration);
    way.now = fmod(now, duration);
    way.time += way.time < 0 ? duration : 0;
    way.now += way.now < 0 ? duration : 0;
    const double laps = nearbyint(((now - way.now) - (time - way.time)) / duration);
    way.along = way.time - laps * duration;
    way.starts_again = laps != 0;
    return way;
}

static bool apply_clips(const struct model *model, int clip, double time, double now, bool loop,
                        struct pose_scratch *s, struct failure *f)
{
    int first = clip, last = clip;
    if (clip == MODEL_CLIP_NONE)
        return true;
    if (clip == MODEL_CLIP_ALL) {
        first = 0;
        last = model->clip_count - 1;
    } else if (clip < 0 || clip >= model->clip_count) {
        return fail(f, "there is no clip %d", clip);
    }
    double duration = 0;
    for (int i = first; i <= last; i++)
        duration = fmax(duration, model->clip[i].duration);
    const struct channel_way way = way_between(time, now, loop ? duration : 0);
    for (int i = first; i <= last; i++)
        apply_clip(&model->clip[i], &way, s);
    return true;
}

/* --- the hierarchy --- */

static bool place_nodes(const struct model *model, struct model_pose *pose, struct failure *f)
{
    for (int i = 0; i < model->node_count; i++) {
        int n = model->order[i];
        const struct model_node *node = &model->node[n];
        const struct trs *trs = &pose->scratch->trs[n];
        double local[16], *world = pose->node_world + 16 * (size_t)n;
        if (node->has_matrix)
            memcpy(local, node->matrix, sizeof local);
        else
            matrix_from_trs(local, trs->translation, trs->rotation, trs->scale);
        if (node->parent >= 0)
            matrix_multiply(world, pose->node_world + 16 * (size_t)node->parent, local);
        else
            memcpy(world, local, sizeof local);
        for (int k = 0; k < 16; k++) {
            if (!(fabs(world[k]) <= max_world))
                return fail(f, "the pose is out of range (nodes[%d])", n);
        }
    }
    return true;
}

/* --- deformation --- */

/* values + sum of weight x delta, over the targets that have deltas. */
static bool morph(const float *values, float *const *delta, const double *weight, int target_count,
                  size_t count, float *out)
{
    for (size_t i = 0; i < count; i++) {
        double sum = (double)values[i];
        for (int k = 0; k < target_count; k++) {
            if (delta[k] != NULL)
                sum += weight[k] * (double)delta[k][i];
        }
        if (!(fabs(sum) <= max_world))
            return false;
        out[i] = (float)sum;
    }
    return true;
}

/* The sum of a vertex's joint matrices by weight, as columns x, y, z, translation of three rows. */
static void blend_joints(const double *joint_matrix, const uint16_t *joint, const float *weight,
                         int influences, double out[12])
{
    for (int k = 0; k < 12; k++)
        out[k] = 0;
    for (int i = 0; i < influences; i++) {
        double w = (double)weight[i];
        if (w == 0)
            continue;
        const double *m = joint_matrix + 16 * (size_t)joint[i];
        for (int column = 0; column < 4; column++) {
            for (int row = 0; row < 3; row++)
                out[3 * column + row] += w * m[4 * column + row];
        }
    }
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The normal's direction under the inverse transpose of m's 3x3, which is its cofactor matrix
 * over its determinant: only the determinant's sign matters to a direction. Length 1, or 0 when m
 * flattens it. */
static void transform_normal(const double m[12], float n[3])
{
    double yz[3], zx[3], xy[3], out[3];
    cross(yz, m + 3, m + 6);
    cross(zx, m + 6, m);
    cross(xy, m, m + 3);
    double sign = m[0] * yz[0] + m[1] * yz[1] + m[2] * yz[2] < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++)
        out[i] = sign * ((double)n[0] * yz[i] + (double)n[1] * zx[i] + (double)n[2] * xy[i]);
    double length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    for (int i = 0; i < 3; i++)
        n[i] = length > 0 && isfinite(length) ? (float)(out[i] / length) : 0;
}

/* In place. */
static bool skin_vertices(const struct model_primitive *p, const double *joint_matrix,
                          float *position, float *normal)
{
    for (size_t v = 0; v < (size_t)p->vertex_count; v++) {
        double m[12], out[3];
        size_t first = v * (size_t)p->influences;
        blend_joints(joint_matrix, p->joint + first, p->weight + first, p->influences, m);
        float *at = position + 3 * v;
        for (int i = 0; i < 3; i++) {
            out[i] = m[i] * (double)at[0] + m[3 + i] * (double)at[1] + m[6 + i] * (double)at[2] +
                     m[9 + i];
            if (!(fabs(out[i]) <= max_world))
                return false;
        }
        for (int i = 0; i < 3; i++)
            at[i] = (float)out[i];
        if (normal != NULL)
            transform_normal(m, normal + 3 * v);
    }
    return true;
}

static void set_joint_matrices(const struct model_skin *skin, const double *node_world, double *out)
{
    for (size_t i = 0; i < (size_t)skin->joint_count; i++)
        matrix_multiply(out + 16 * i, node_world + 16 * (size_t)skin->joint[i],
                        skin->inverse_bind + 16 * i);
}

static bool deform(const struct model *model, struct model_pose *pose, const struct model_draw *d,
                   float *position, float *normal)
{
    const struct model_primitive *p = d->primitive;
    const struct model_node *node = &model->node[d->node];
    const double *weight = pose->scratch->weight + pose->scratch->weight_at[d->node];
    size_t count = (size_t)p->vertex_count * 3;
    if (!morph(p->position, p->target_position, weight, p->target_count, count, position) ||
        (normal != NULL &&
         !morph(p->normal, p->target_normal, weight, p->target_count, count, normal)))
        return false;
    if (!is_skinned(node, p))
        return true;
    set_joint_matrices(&model->skin[node->skin], pose->node_world, pose->scratch->joint);
    return skin_vertices(p, pose->scratch->joint, position, normal);
}

bool model_pose(const struct model *model, int clip, double time, bool loop,
                struct model_pose *pose, struct failure *f)
{
    return model_pose_joined(model, clip, time, time, loop, pose, f);
}

bool model_pose_joined(const struct model *model, int clip, double time, double now, bool loop,
                       struct model_pose *pose, struct failure *f)
{
    if (!isfinite(time) || !isfinite(now))
        return fail(f, "the time of a pose is not finite");
    if (!prepare(model, pose, f))
        return false;
    set_rest(model, pose->scratch);
    if (!apply_clips(model, clip, time, now, loop, pose->scratch, f) || !place_nodes(model, pose, f))
        return false;
    int owned = 0;
    for (int i = 0; i < pose->draw_count; i++) {
        struct model_draw *d = &pose->draw[i];
        if (is_skinned(&model->node[d->node], d->primitive))
            matrix_identity(d->world);
        else
            memcpy(d->world, pose->node_world + 16 * (size_t)d->node, sizeof d->world);
        if (!d->deformed)
            continue;
        float *position = pose->owned[owned++];
        float *normal = d->primitive->normal != NULL ? pose->owned[owned++] : NULL;
        if (!deform(model, pose, d, position, normal))
            return fail(f, "a deformed vertex is out of range (nodes[%d])", d->node);
    }
    return true;
}

bool model_pose_bounds(const struct model_pose *pose, double min[3], double max[3])
{
    for (int k = 0; k < 3; k++) {
        min[k] = DBL_MAX;
        max[k] = -DBL_MAX;
    }
    for (int i = 0; i < pose->draw_count; i++) {
        const struct model_draw *d = &pose->draw[i];
        for (size_t v = 0; v < (size_t)d->primitive->vertex_count; v++) {
            double at[3];
            matrix_point(at, d->world, d->position + 3 * v);
            for (int k = 0; k < 3; k++) {
                min[k] = fmin(min[k], at[k]);
                max[k] = fmax(max[k], at[k]);
            }
        }
    }
    return pose->draw_count > 0;
}
