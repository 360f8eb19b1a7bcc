/* SPDX-License-Identifier: MIT */
/* light.c - the lights of a file as a frame has them.
 *
 * Files say lux and candela, and nothing of an exposure. So light is dimmed until the brightest, in the middle of the model at rest, is
 * one (of a lamp that is nearer to it than half of the model: as far away as that); what is fainter stays as it is. A point of I candela
 * is as bright as a directional light of I / d^2 lux at a distance of d. The library's lamp has all of its colour at a quarter of its
 * reach: that is where the point has come down to one. */
#include "tools/model/model.h"

#include "tools/model/matrix.h"

#include <math.h>

static double brightest_of(const struct model_light *light)
{
    return fmax(light->color[0], fmax(light->color[1], light->color[2]));
}

/* From a node to the world, at rest. */
static void place_node(const struct model *model, int node, double out[16])
{
    matrix_identity(out);
    for (; node >= 0; node = model->node[node].parent) {
        const struct model_node *n = &model->node[node];
        double local[16], inner[16];
        if (n->has_matrix)
            memcpy(local, n->matrix, sizeof local);
        else
            matrix_from_trs(local, n->translation, n->rotation, n->scale);
        memcpy(inner, out, sizeof inner);
        matrix_multiply(out, local, inner);
    }
}

/* Finds the square of the distance of a place from the middle of what is drawn, at rest, but of half of that at least: a light among
 * what is drawn is as far from most of it. 0: nothing is drawn. */
static bool find_distance(const struct model *model, const double place[3], double *square, struct failure *f)
{
    struct model_pose pose = { 0 };
    double low[3], high[3];
    const bool ok = model_pose(model, MODEL_CLIP_NONE, 0, false, &pose, f);
    double least = 0;
    *square = 0;
    if (ok && model_pose_bounds(&pose, low, high))
        for (int i = 0; i < 3; i++) {
            *square += (place[i] - (low[i] + high[i]) / 2) * (place[i] - (low[i] + high[i]) / 2);
            least += (high[i] - low[i]) * (high[i] - low[i]) / 4;
        }
    *square = fmax(*square, least);
    model_pose_free(&pose);
    return ok;
}

/* Returns how bright the brightest light is, at least one. */
static bool find_exposure(const struct model *model, const struct model_lights *lights, double *out, struct failure *f)
{
    double square = 0;
    *out = fmax(1, fmax(brightest_of(&model->light[MODEL_SUN]), brightest_of(&model->light[MODEL_SECOND])));
    if (!lights->has[MODEL_LAMP])
        return true;
    if (!find_distance(model, lights->place, &square, f))
        return false;
    if (square > 0)
        *out = fmax(*out, brightest_of(&model->light[MODEL_LAMP]) / square);
    return true;
}

bool model_find_lights(const struct model *model, struct model_lights *out, struct failure *f)
{
    double world[16], exposure;
    *out = (struct model_lights){ .reach = 0 };
    for (int i = 0; i < MODEL_LIGHTS; i++) {
        const struct model_light *light = &model->light[i];
        if (!light->is_there || !(brightest_of(light) > 0))
            continue;
        place_node(model, light->node, world);
        const double length = sqrt(world[8] * world[8] + world[9] * world[9] + world[10] * world[10]);
        const double *const at = i == MODEL_LAMP ? world + 12 : world + 8;
        for (int k = 0; k < 3; k++) {
            if (!(fabs(at[k]) <= 1e30))
                return fail(f, "a light is too far away (nodes[%d])", light->node);
            (i == MODEL_LAMP ? out->place : out->direction[i])[k] = i == MODEL_LAMP ? at[k] : at[k] / length;
        }
        if (i != MODEL_LAMP && !(length > 0))
            return fail(f, "a light's node has no direction (scale of zero, nodes[%d])", light->node);
        out->has[i] = true;
    }
    if (!find_exposure(model, out, &exposure, f))
        return false;
    for (int i = 0; i < MODEL_LIGHTS; i++)
        for (int k = 0; k < 3; k++)
            out->color[i][k] = out->has[i] ? model->light[i].color[k] / (i == MODEL_LAMP ? brightest_of(&model->light[i]) : exposure) : 0;
    if (out->has[MODEL_LAMP]) {
        const double range = model->light[MODEL_LAMP].range;
        out->reach = 4 * sqrt(brightest_of(&model->light[MODEL_LAMP]) / exposure);
        out->reach = range > 0 ? fmin(range, out->reach) : out->reach;
    }
    return true;
}
