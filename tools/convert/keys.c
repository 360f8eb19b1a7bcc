/* SPDX-License-Identifier: MIT */
/* keys.c - clips as keys that the device mixes linearly.
 *
 * A channel of the file (held, linear, spherical or cubic) is looked at where it has keys, between them, and
 * where it bends; then as few of those instants as will do become keys: each segment is made as long as the
 * mixture stays within the tolerance at all instants in it. Errors are in world units, by how far the node's
 * vertices reach; what skins and chains of nodes make of them together is measured afterwards (measure.c). */
#include "tools/convert/build.h"

#include "tools/model/exact.h"
#include "tools/convert/track.h"
#include "tools/model/channel.h"

#include <math.h>
#include <string.h>

enum { DEPTH = 6 };             /* of the search for bends: 64 parts of a key's interval */

/* How far a vertex may get when a channel's values are off. */
struct metric {
    int path, width;
    double size;                /* world units per unit of error (rotation: per radian) */
    const double *each;         /* weights: of each target */
};

static double metric_error(const struct metric *m, const double *a, const double *b)
{
    double sum = 0, dot = 0;
    if (m->path == MODEL_WEIGHTS) {
        for (int i = 0; i < m->width; i++)
            sum += fabs(a[i] - b[i]) * m->each[i];
        return sum;
    }
    for (int i = 0; i < m->width; i++)
        dot += a[i] * b[i];
    for (int i = 0; i < m->width; i++) {
        double d = a[i] - (m->path == MODEL_ROTATION && dot < 0 ? -b[i] : b[i]);
        sum += d * d;
    }
    return sqrt(sum) * (m->path == MODEL_ROTATION ? 2 : 1) * m->size;
}

/* Largest column of what is above a node, at rest: what a step of it is in the world. */
static double world_size_above(const struct converter *c, int node)
{
    struct track_pose pose;
    double size = largest_column(c->root);
    int parent = c->model->node[node].parent;
    if (parent >= 0 && track_pose_alloc(&pose, c->model, c->f)) {
        track_pose_set(&pose, c->model, -1, 0, c->root);
        size = largest_column(pose.world[parent]);
        track_pose_free(&pose);
    }
    return size;
}

static double rest_scale(const struct model_node *node)
{
    return fmax(fabs(node->scale[0]), fmax(fabs(node->scale[1]), fabs(node->scale[2])));
}

static double largest_scale(const struct converter *c, const struct model_channel *channel)
{
    double largest = rest_scale(&c->model->node[channel->node]), value[3];
    for (int key = 0; key < channel->key_count; key++) {
        track_sample(channel, (double)channel->time[key], value);
        for (int k = 0; k < 3; k++)
            largest = fmax(largest, fabs(value[k]));
    }
    return largest;
}

/* Room for as many values as any channel has: `each` of weights. */
static struct metric metric_of(const struct converter *c, const struct model_channel *channel, double *each)
{
    struct metric m = { .path = (int)channel->path, .width = channel->width, .each = each };
    double reach = c->reach[channel->node];
    if (channel->path == MODEL_TRANSLATION)
        m.size = world_size_above(c, channel->node);
    else if (channel->path == MODEL_ROTATION)
        m.size = reach;
    else if (channel->path == MODEL_SCALE)
        m.size = reach / fmax(largest_scale(c, channel), 1e-30);
    if (channel->path != MODEL_WEIGHTS)
        return m;
    const struct model_mesh *mesh = &c->model->mesh[c->model->node[channel->node].mesh];
    double world = world_size_above(c, channel->node) * rest_scale(&c->model->node[channel->node]);
    for (int t = 0; t < channel->width; t++) {
        each[t] = 0;
        for (int k = 0; k < mesh->primitive_count; k++) {
            const struct model_primitive *p = &mesh->primitive[k];
            for (int v = 0; p->target_position[t] != NULL && v < p->vertex_count; v++) {
                const float *d = p->target_position[t] + 3 * v;
                double length = sqrt((double)d[0] * (double)d[0] + (double)d[1] * (double)d[1]
                                     + (double)d[2] * (double)d[2]);
                each[t] = fmax(each[t], length * world);
            }
        }
    }
    return m;
}

/* ------------------------------------------------------------------ instants of a channel */

/* Instants in order: time and `width` values each. */
struct instants {
    struct list time, value;
    int width;
};

static bool add_instant(struct instants *all, const struct model_channel *channel, double time,
                        struct failure *f)
{
    double *t = list_add(&all->time, 1, f), *v = list_add(&all->value, all->width, f);
    if (t == NULL || v == NULL)
        return false;
    *t = time;
    track_sample(channel, time, v);
    return true;
}

static void mix(const struct metric *m, const double *a, const double *b, double t, double *out)
{
    double dot = 0;
    for (int i = 0; i < m->width; i++)
        dot += a[i] * b[i];
    double sign = m->path == MODEL_ROTATION && dot < 0 ? -1 : 1;
    for (int i = 0; i < m->width; i++)
        out[i] = (1 - t) * a[i] + t * sign * b[i];
    if (m->path == MODEL_ROTATION)
        exact_normalize4(out);
}

/* Whether the channel between two instants is more than a mixture of them. */
static bool bends(const struct model_channel *channel, const struct metric *m, double from, double to,
                  double tolerance, double *scratch)
{
    double *a = scratch, *b = a + m->width, *exact = b + m->width, *mixed = exact + m->width;
    track_sample(channel, from, a);
    track_sample(channel, to, b);
    for (int i = 1; i < 4; i++) {
        track_sample(channel, from + (to - from) * i / 4, exact);
        mix(m, a, b, i / 4.0, mixed);
        if (metric_error(m, exact, mixed) > tolerance)
            return true;
    }
    return false;
}

/* The instants behind `from` up to `to`. */
static bool add_between(struct instants *all, const struct model_channel *channel, const struct metric *m,
                        double from, double to, int depth, double tolerance, double *scratch,
                        struct failure *f)
{
    double middle = from + (to - from) / 2;
    if (depth > 0 && bends(channel, m, from, to, tolerance, scratch))
        return add_between(all, channel, m, from, middle, depth - 1, tolerance, scratch, f)
            && add_between(all, channel, m, middle, to, depth - 1, tolerance, scratch, f);
    return add_instant(all, channel, middle, f) && add_instant(all, channel, to, f);
}

static bool find_instants(struct converter *c, const struct model_channel *channel, const struct metric *m,
                          struct instants *all, double *scratch)
{
    if (!add_instant(all, channel, (double)channel->time[0], c->f))
        return false;
    for (int key = 1; key < channel->key_count; key++) {
        double from = (double)channel->time[key - 1], to = (double)channel->time[key];
        bool ok = channel_jumps(channel, key - 1)
                    ? add_instant(all, channel, to, c->f)
                    : add_between(all, channel, m, from, to, DEPTH, c->tolerance / 4, scratch, c->f);
        if (!ok)
            return false;
    }
    return true;
}

bool channel_moves(const struct converter *c, const struct model_channel *channel)
{
    const struct model_node *node = &c->model->node[channel->node];
    const double *rest = channel->path == MODEL_TRANSLATION ? node->translation
                       : channel->path == MODEL_ROTATION    ? node->rotation : node->scale;
    struct metric m = metric_of(c, channel, NULL);
    for (int key = 0; key < channel->key_count; key++)
        for (int part = 0; part < 4; part++) {
            double value[4], time = (double)channel->time[key];
            if (key + 1 < channel->key_count)
                time += part * ((double)channel->time[key + 1] - time) / 4;
            track_sample(channel, time, value);
            if (metric_error(&m, value, rest) > c->tolerance / 4)
                return true;
        }
    return false;
}

/* ------------------------------------------------------------------ keys */

/* Whether the instants between `first` and `last` are mixtures of the two. */
static bool is_mixture(const struct instants *all, const struct metric *m, int first, int last,
                       double tolerance, double *mixed)
{
    const double *time = all->time.data, *value = all->value.data;
    for (int i = first + 1; i < last; i++) {
        double t = (time[i] - time[first]) / (time[last] - time[first]);
        mix(m, value + (size_t)first * (size_t)m->width, value + (size_t)last * (size_t)m->width, t, mixed);
        if (metric_error(m, value + (size_t)i * (size_t)m->width, mixed) > tolerance)
            return false;
    }
    return true;
}

static bool is_constant(const struct instants *all, const struct metric *m, double tolerance)
{
    const double *value = all->value.data;
    for (int i = 1; i < all->time.count; i++)
        if (metric_error(m, value, value + (size_t)i * (size_t)m->width) > tolerance)
            return false;
    return true;
}

/* Marks the instants that become keys. */
static void choose_keys(const struct converter *c, const struct instants *all, const struct metric *m,
                        bool steps, bool *chosen, double *scratch)
{
    const double *value = all->value.data;
    int count = all->time.count;
    chosen[0] = true;
    if (is_constant(all, m, c->tolerance / 4))
        return;
    for (int first = 0; first < count - 1;) {
        int last = first + 1;
        if (steps)
            while (last < count && metric_error(m, value + (size_t)first * (size_t)m->width,
                                                value + (size_t)last * (size_t)m->width) <= c->tolerance / 16)
                last++;
        else
            while (last + 1 < count && is_mixture(all, m, first, last + 1, c->tolerance, scratch))
                last++;
        if (last < count)
            chosen[last] = true;
        first = last;
    }
}

/* ------------------------------------------------------------------ records */

static bool same_times(const struct converter *c, int first, int count, uint32_t *found)
{
    const smear_model_channel *channel = c->channel.data;
    const uint16_t *time = c->key_time.data;
    for (int i = 0; i < c->channel.count; i++)
        if (channel[i].key_count == count
            && memcmp(time + channel[i].time_first, time + first, (size_t)count * sizeof *time) == 0) {
            *found = channel[i].time_first;
            return true;
        }
    return false;
}

/* Step and offsets for values in fixed point, and the keys. */
static bool quantise_keys(struct converter *c, smear_model_channel *out, const double *value, double limit)
{
    int width = out->width, count = out->key_count;
    bool each = out->path != SMEAR_PATH_WEIGHTS;
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY },
           range = 0;
    int16_t *key = list_add(&c->key_value, width * count, c->f);
    if (key == NULL)
        return false;
    for (int i = 0; i < width * count; i++) {
        int axis = each ? i % width : 0;
        low[axis] = fmin(low[axis], value[i]);
        high[axis] = fmax(high[axis], value[i]);
    }
    for (int axis = 0; axis < (each ? 3 : 1); axis++) {
        if (!to_fixed(&out->offset[axis], (low[axis] + high[axis]) / 2, 0, limit, c->f))
            return false;
        if (fabs(low[axis]) > limit || fabs(high[axis]) > limit)
            return fail(c->f, "an animation is out of range");
        range = fmax(range, high[axis] - low[axis]);
    }
    /* value = key x factor x 2^(shift - 18) + offset */
    double step = range / 65532;
    int exponent = step > 0 ? exact_exponent(step) : -64;
    if (exponent - 12 >= -31) {
        out->shift = exponent - 12;
        out->factor = (int32_t)floor(ldexp(step, 30 - exponent) + 0.5);
    }
    for (int i = 0; i < width * count && out->factor != 0; i++) {
        double k = floor((value[i] - out->offset[each ? i % width : 0]) / step + 0.5);
        key[i] = (int16_t)fmax(-32767, fmin(32767, k));
    }
    return true;
}

static bool quantise_rotations(struct converter *c, const smear_model_channel *out, double *value)
{
    int16_t *key = list_add(&c->key_value, 4 * out->key_count, c->f);
    if (key == NULL)
        return false;
    for (int i = 0; i < out->key_count; i++) {
        double dot = 0;
        for (int k = 0; k < 4 && i > 0; k++)
            dot += value[4 * i + k] * value[4 * i - 4 + k];
        for (int k = 0; k < 4; k++) {
            if (dot < 0)
                value[4 * i + k] = -value[4 * i + k];
            key[4 * i + k] = (int16_t)fmax(-32767, fmin(32767, floor(value[4 * i + k] * 32767 + 0.5)));
        }
    }
    return true;
}

/* What the device's values are in, against the file's. */
static double unit_of(const struct converter *c, const struct model_channel *channel, int component,
                      double *limit)
{
    *limit = ldexp(2047, 16);
    if (channel->path == MODEL_WEIGHTS) {
        int first = c->weight_first[channel->node];
        return ldexp(1 / ((double *)c->weight_factor.data)[first + component], 14);
    }
    const struct out_node *n = &c->node[c->node_of[channel->node]];
    int above = n->parent != NO_NODE ? c->node[n->parent].exponent : 0;
    if (channel->path == MODEL_TRANSLATION)
        return ldexp(1, 16 + above - c->unit_exponent);
    *limit = ldexp(7.9, 24);
    return ldexp(1, 24 + above - n->exponent);
}

/* Whether the channel jumps behind the key at this instant, if there is one; and whether it has jumped to it. */
static bool is_before_jump(const struct model_channel *channel, double instant)
{
    const int key = channel_find_key(channel, instant);
    return (double)channel->time[key] == instant && key + 1 < channel->key_count && channel_jumps(channel, key);
}

static bool is_behind_jump(const struct model_channel *channel, double instant)
{
    const int key = channel_find_key(channel, instant);
    return (double)channel->time[key] == instant && key > 0 && channel_jumps(channel, key - 1);
}

static bool write_keys(struct converter *c, const struct model_channel *channel, const struct instants *all,
                       const bool *chosen, uint32_t tick_shift, smear_model_channel *out)
{
    struct list values = { .size = sizeof(double) };
    const smear_model_clip *clip = (const smear_model_clip *)c->clip.data + c->clip.count - 1;
    const uint32_t end = clip->duration >> tick_shift;
    int first_time = c->key_time.count, width = channel->width;
    double limit = 0;
    bool ok = true;
    out->value_first = (uint32_t)c->key_value.count;
    for (int i = 0; i < all->time.count && ok; i++) {
        if (!chosen[i])
            continue;
        const double instant = ((const double *)all->time.data)[i];
        const bool ends_jump = !out->step && i > 0 && chosen[i - 1] && is_behind_jump(channel, instant);
        double tick = fmin(floor(ldexp(instant, 16 - (int)tick_shift) + 0.5), end);         /* or it is never reached */
        if (ends_jump && out->key_count > 0)
            tick = ((const uint16_t *)c->key_time.data)[c->key_time.count - 1];
        else if (out->key_count > 0 && tick <= ((const uint16_t *)c->key_time.data)[c->key_time.count - 1])
            continue;
        uint16_t *time = list_add(&c->key_time, 1, c->f);
        double *value = list_add(&values, width, c->f);
        ok = time != NULL && value != NULL
          && (out->key_count < 65535 || fail(c->f, "a channel has more than 65535 keys"));
        if (!ok)
            break;
        *time = (uint16_t)tick;
        out->key_count++;
        /* the curve at the tick itself, but where it is not what it is at the instant: held values change at the key, those on
         * both sides of a jump are the file's, and ends are, so that a loop's meet */
        if (out->step || ends_jump || is_before_jump(channel, instant) || i == 0 || i + 1 == all->time.count)
            memcpy(value, (const double *)all->value.data + (size_t)i * (size_t)width,
                   (size_t)width * sizeof *value);
        else
            track_sample(channel, ldexp(tick, (int)tick_shift - 16), value);
        for (int k = 0; k < width && channel->path != MODEL_ROTATION; k++)
            value[k] *= unit_of(c, channel, k, &limit);
    }
    ok = ok && (channel->path == MODEL_ROTATION ? quantise_rotations(c, out, values.data)
                                                : quantise_keys(c, out, values.data, limit));
    list_free(&values);
    if (ok && same_times(c, first_time, out->key_count, &out->time_first))
        c->key_time.count = first_time;
    else
        out->time_first = (uint32_t)first_time;
    return ok;
}

static bool write_channel(struct converter *c, const struct model_channel *channel, uint32_t tick_shift)
{
    static const uint8_t paths[] = { SMEAR_PATH_TRANSLATION, SMEAR_PATH_ROTATION, SMEAR_PATH_SCALE,
                                     SMEAR_PATH_WEIGHTS };
    struct instants all = { .time = { .size = sizeof(double) }, .value = { .size = sizeof(double) },
                            .width = channel->width };
    bool weights = channel->path == MODEL_WEIGHTS;
    double *scratch = pile_alloc(c->pile, 5 * (size_t)channel->width, sizeof *scratch, c->f);
    smear_model_channel out = {
        .target = (uint16_t)(weights ? c->weight_first[channel->node] : c->node_of[channel->node]),
        .path = paths[channel->path], .step = channel->interpolation == MODEL_STEP,
        .width = (uint16_t)channel->width
    };
    if (scratch == NULL)
        return false;
    struct metric m = metric_of(c, channel, scratch);
    bool ok = find_instants(c, channel, &m, &all, scratch + channel->width);
    bool *chosen = ok ? pile_alloc(c->pile, (size_t)all.time.count, sizeof *chosen, c->f) : NULL;
    if (chosen != NULL) {
        choose_keys(c, &all, &m, out.step, chosen, scratch + channel->width);
        ok = write_keys(c, channel, &all, chosen, tick_shift, &out);
        smear_model_channel *record = ok ? list_add(&c->channel, 1, c->f) : NULL;
        ok = record != NULL;
        if (ok)
            *record = out;
    }
    list_free(&all.time);
    list_free(&all.value);
    return ok && chosen != NULL;
}

/* The channel of a clip that sets this path of a node: the last one in the file. */
static const struct model_channel *find_channel(const struct model_clip *clip, int node, enum model_path path)
{
    const struct model_channel *found = NULL;
    for (int i = 0; i < clip->channel_count; i++)
        if (clip->channel[i].node == node && clip->channel[i].path == path)
            found = &clip->channel[i];
    return found;
}

static bool write_moves(struct converter *c, const struct model_clip *clip, uint32_t tick_shift,
                        int *keys_in_file)
{
    static const enum model_path paths[] = { MODEL_TRANSLATION, MODEL_ROTATION, MODEL_SCALE };
    for (int n = 0; n < c->node_count; n++)
        for (int k = 0; k < 3 && c->node[n].moves; k++) {
            const struct model_channel *channel = find_channel(clip, c->node[n].source, paths[k]);
            if (channel == NULL)
                continue;
            *keys_in_file += channel->key_count;
            if (channel_moves(c, channel) && !write_channel(c, channel, tick_shift))
                return false;
        }
    return true;
}

static bool write_weight_channels(struct converter *c, const struct model_clip *clip, uint32_t tick_shift,
                                  int *keys_in_file)
{
    for (int n = 0; n < c->model->node_count; n++) {
        const struct model_channel *channel = find_channel(clip, n, MODEL_WEIGHTS);
        if (channel == NULL || channel->width == 0 || c->weight_first[n] < 0)
            continue;
        *keys_in_file += channel->key_count;
        if (!write_channel(c, channel, tick_shift))
            return false;
    }
    return true;
}

static int count_jumps(const struct converter *c, const smear_model_channel *channel)
{
    const uint16_t *time = (const uint16_t *)c->key_time.data + channel->time_first;
    int jumps = 0;
    for (int k = 1; k < channel->key_count; k++)
        jumps += channel->step || time[k] == time[k - 1];
    return jumps;
}

static bool write_weights_at_rest(struct converter *c)
{
    const struct model *m = c->model;
    int16_t *table = pile_alloc(c->pile, (size_t)c->weight_count, sizeof *table, c->f);
    for (int n = 0; table != NULL && n < m->node_count; n++) {
        const struct model_node *node = &m->node[n];
        const float *rest = node->weight != NULL ? node->weight
                          : node->mesh >= 0      ? m->mesh[node->mesh].weight
                                                 : NULL;
        int first = c->weight_first[n];
        for (int k = 0; first >= 0 && rest != NULL && k < track_weight_count(m, n); k++) {
            double steps = (double)rest[k] / ((double *)c->weight_factor.data)[first + k] * 16384;
            table[first + k] = (int16_t)fmax(-32767, fmin(32767, floor(steps + 0.5)));
        }
    }
    c->out->model.weight = table;
    c->out->model.weight_count = (uint16_t)c->weight_count;
    return table != NULL;
}

bool write_clips(struct converter *c)
{
    int count = c->options->clip_count;
    struct convert_clip_report *report = pile_alloc(c->pile, (size_t)count, sizeof *report, c->f);
    if (report == NULL || !write_weights_at_rest(c))
        return false;
    c->out->clip_report = report;
    for (int i = 0; i < count; i++) {
        const struct model_clip *clip = &c->model->clip[c->options->clip[i]];
        smear_model_clip *out = list_add(&c->clip, 1, c->f);
        size_t letters = strlen(clip->name) + 1;
        char *name = letters < 10000 ? list_add(&c->text, (int)letters, c->f) : NULL;
        if (out == NULL || name == NULL)
            return fail(c->f, "a clip's name is too long");
        memcpy(name, clip->name, letters);
        if (!(clip->duration < 32767))
            return fail(c->f, "a clip is longer than 32767 seconds (\"%.60s\")", clip->name);
        *out = (smear_model_clip){ .name = (uint32_t)(c->text.count - (int)letters),
                                   .duration = (uint32_t)floor(clip->duration * 65536 + 0.5),
                                   .channel_first = (uint16_t)c->channel.count };
        while (out->duration >> out->tick_shift > 65535)
            out->tick_shift++;
        uint32_t tick_shift = out->tick_shift;
        int channels = c->channel.count;
        if (!write_moves(c, clip, tick_shift, &report[i].keys_in_file)
            || !write_weight_channels(c, clip, tick_shift, &report[i].keys_in_file))
            return false;
        if (c->channel.count >= (int)SMEAR_MODEL_NONE)
            return fail(c->f, "has more than 65534 channels");
        ((smear_model_clip *)c->clip.data)[i].channel_count = (uint16_t)(c->channel.count - channels);
        for (int k = channels; k < c->channel.count; k++) {
            const smear_model_channel *channel = (const smear_model_channel *)c->channel.data + k;
            report[i].keys += channel->key_count;
            report[i].jumps += count_jumps(c, channel);
        }
    }
    return true;
}
