/* SPDX-License-Identifier: MIT */
/* gltf_animation.c - clips: one channel per node and property, with keys of its own. */
#include "tools/model/gltf.h"

#include <stdlib.h>
#include <string.h>

static bool read_path(struct gltf *g, int target, enum model_path *out)
{
    static const struct { const char *name; enum model_path path; } paths[] = {
        { "translation", MODEL_TRANSLATION }, { "rotation", MODEL_ROTATION },
        { "scale", MODEL_SCALE }, { "weights", MODEL_WEIGHTS }
    };
    const char *name = "";
    if (!json_get_string(&g->json, target, "path", &name, g->f))
        return false;
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        if (strcmp(name, paths[i].name) == 0) {
            *out = paths[i].path;
            return true;
        }
    }
    return json_fail(&g->json, target, "path", g->f, "'%.20s' cannot be animated", name);
}

static bool read_interpolation(struct gltf *g, int sampler, enum model_interpolation *out)
{
    const char *name = "LINEAR";
    if (!json_get_string(&g->json, sampler, "interpolation", &name, g->f))
        return false;
    if (strcmp(name, "STEP") == 0)
        *out = MODEL_STEP;
    else if (strcmp(name, "LINEAR") == 0)
        *out = MODEL_LINEAR;
    else if (strcmp(name, "CUBICSPLINE") == 0)
        *out = MODEL_CUBICSPLINE;
    else
        return json_fail(&g->json, sampler, "interpolation", g->f, "'%.20s' is not known", name);
    return true;
}

static bool read_times(struct gltf *g, int sampler, int accessor, struct model_channel *channel)
{
    if (!gltf_expect(g, accessor, GLTF_SCALAR, GLTF_FLOAT, -1, sampler, "input"))
        return false;
    int n = g->accessor[accessor].count;
    channel->time = gltf_alloc(g, (size_t)n, sizeof *channel->time);
    if (channel->time == NULL ||
        !gltf_floats(g, accessor, NULL, n, false, channel->time, sampler, "input"))
        return false;
    channel->key_count = n;
    if (n > 0 && channel->time[0] < 0)
        return json_fail(&g->json, sampler, "input", g->f, "time of key 0 is %g s, before the clip begins",
                         (double)channel->time[0]);
    for (int i = 1; i < n; i++) {
        if (channel->time[i] <= channel->time[i - 1])
            return json_fail(&g->json, sampler, "input", g->f, "time of key %d does not increase",
                             i);
    }
    return true;
}

static bool read_values(struct gltf *g, int sampler, int accessor, struct model_channel *channel)
{
    bool weights = channel->path == MODEL_WEIGHTS;
    int64_t per_key = channel->interpolation == MODEL_CUBICSPLINE ? 3 : 1;
    if (weights)
        per_key *= channel->width;
    int64_t count = per_key * channel->key_count;
    if (count > INT32_MAX)
        return json_fail(&g->json, sampler, NULL, g->f, "too many keys");
    enum gltf_shape shape = weights ? GLTF_SCALAR :
                            channel->path == MODEL_ROTATION ? GLTF_VEC4 : GLTF_VEC3;
    if (!gltf_expect(g, accessor, shape, GLTF_FLOAT | GLTF_BYTE_OR_SHORT, (int)count, sampler,
                     "output"))
        return false;
    size_t numbers = (size_t)count * (size_t)g->accessor[accessor].width;
    channel->value = gltf_alloc(g, numbers, sizeof *channel->value);
    return channel->value != NULL &&
           gltf_floats(g, accessor, NULL, (int)count, false, channel->value, sampler, "output");
}

/* How many values a key of this channel has. */
static bool channel_width(struct gltf *g, int target, struct model_channel *channel)
{
    const struct model_node *node = &g->model->node[channel->node];
    if (channel->path == MODEL_WEIGHTS) {
        channel->width = node->mesh < 0 ? 0 : g->model->mesh[node->mesh].weight_count;
        if (channel->width == 0)
            return json_fail(&g->json, target, NULL, g->f, "node %d has no morph targets",
                             channel->node);
        return true;
    }
    if (node->has_matrix)
        return json_fail(&g->json, target, NULL, g->f,
                         "node %d is placed by a matrix, which cannot be animated", channel->node);
    channel->width = channel->path == MODEL_ROTATION ? 4 : 3;
    return true;
}

static bool read_channel(struct gltf *g, int object, const int *sampler, int sampler_count,
                         struct model_clip *clip)
{
    int target, which = -1, node = -1, input, output;
    if (!json_get_object(&g->json, object, "target", &target, g->f) ||
        !json_get_index(&g->json, object, "sampler", sampler_count, "sampler", &which, g->f) ||
        !json_get_index(&g->json, target, "node", g->model->node_count, "node", &node, g->f))
        return false;
    if (node < 0)
        return true;            /* what it animates is some extension's */
    if (which < 0)
        return json_fail(&g->json, object, NULL, g->f, "no sampler");
    /* Counted while it is read, so that what a failure leaves behind is freed. */
    struct model_channel *channel = &clip->channel[clip->channel_count++];
    channel->node = node;
    if (!read_path(g, target, &channel->path) || !channel_width(g, target, channel) ||
        !read_interpolation(g, sampler[which], &channel->interpolation) ||
        !gltf_get_accessor(g, sampler[which], "input", &input) ||
        !gltf_get_accessor(g, sampler[which], "output", &output))
        return false;
    if (input < 0 || output < 0)
        return json_fail(&g->json, sampler[which], NULL, g->f, "no input or no output");
    if (!read_times(g, sampler[which], input, channel) ||
        !read_values(g, sampler[which], output, channel))
        return false;
    double last = (double)channel->time[channel->key_count - 1];
    if (last > clip->duration)
        clip->duration = last;
    return true;
}

static bool read_clip(struct gltf *g, int object, struct model_clip *clip)
{
    int channels, channel_count, samplers, sampler_count, n = 0;
    clip->name = gltf_name(g, object);
    if (clip->name == NULL || !gltf_list(g, object, "channels", &channels, &channel_count) ||
        !gltf_list(g, object, "samplers", &samplers, &sampler_count))
        return false;
    clip->channel = gltf_alloc(g, (size_t)channel_count, sizeof *clip->channel);
    int *sampler = gltf_alloc(g, (size_t)sampler_count, sizeof *sampler);
    bool ok = clip->channel != NULL && sampler != NULL;
    for (int i = json_first(&g->json, samplers); ok && i >= 0; i = json_after(&g->json, i))
        sampler[n++] = i;
    for (int i = json_first(&g->json, channels); ok && i >= 0; i = json_after(&g->json, i))
        ok = read_channel(g, i, sampler, sampler_count, clip);
    free(sampler);
    return ok;
}

bool gltf_read_animations(struct gltf *g)
{
    int array, count;
    if (!gltf_list(g, 0, "animations", &array, &count))
        return false;
    g->model->clip = gltf_alloc(g, (size_t)count, sizeof *g->model->clip);
    if (g->model->clip == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        if (!read_clip(g, i, &g->model->clip[g->model->clip_count++]))
            return false;
    }
    return true;
}
