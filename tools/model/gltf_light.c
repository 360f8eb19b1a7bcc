/* SPDX-License-Identifier: MIT */
/* gltf_light.c - KHR_lights_punctual: the lights of a file, and which of them a frame has: the first two directional ones and the first
 * point or spot of the nodes that are drawn. All are checked; what is left out is named. */
#include "tools/model/gltf.h"
#include "tools/model/matrix.h"
#include "tools/model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char extension[] = "KHR_lights_punctual";

enum kind { DIRECTIONAL, POINT, SPOT, UNKNOWN };

struct light {
    enum kind kind;
    const char *name, *type;
    double color[3];            /* linear, times the intensity: lux or candela */
    double range;               /* 0: none given */
};

/* Names with commas, and how many found no room. */
struct names {
    char text[300];
    int left_out;
};

static void add_name(struct names *names, const struct light *light)
{
    const size_t used = strlen(names->text), room = sizeof names->text - used;
    const bool has_name = light->name[0] != '\0';
    const int length = snprintf(names->text + used, room, "%s%.40s%s%.40s", used > 0 ? ", " : "", light->name, has_name ? " " : "",
                                light->type);
    if (length < 0 || (size_t)length >= room) {
        names->text[used] = '\0';
        names->left_out++;
    }
}

static void warn_of(struct gltf *g, const char *before, const struct names *names, const char *behind)
{
    if (names->text[0] != '\0' && names->left_out > 0)
        model_warn(g->model, "%s %s and %d more%s", before, names->text, names->left_out, behind);
    else if (names->text[0] != '\0')
        model_warn(g->model, "%s %s%s", before, names->text, behind);
}

/* A spot's cone is looked at for being numbers. */
static bool check_spot(struct gltf *g, int object)
{
    const double right = 1.5707963267948966;
    double inner = 0, outer = right / 2;
    int spot;
    if (!json_get_object(&g->json, object, "spot", &spot, g->f))
        return false;
    if (spot < 0)
        return json_fail(&g->json, object, "spot", g->f, "a spot light has a cone");
    return json_get_number(&g->json, spot, "innerConeAngle", &inner, g->f)
        && json_get_number(&g->json, spot, "outerConeAngle", &outer, g->f)
        && ((inner >= 0 && inner <= outer && outer <= right + 1e-6)
            || json_fail(&g->json, spot, NULL, g->f, "angles from %g to %g are no cone", inner, outer));
}

static bool read_light(struct gltf *g, int object, struct light *out)
{
    static const char *const kinds[UNKNOWN] = { "directional", "point", "spot" };
    double intensity = 1;
    bool has_range = json_member(&g->json, object, "range") >= 0;
    *out = (struct light){ .name = "", .color = { 1, 1, 1 } };
    if (!json_get_string(&g->json, object, "name", &out->name, g->f) || !json_get_string(&g->json, object, "type", &out->type, g->f)
        || !json_get_numbers(&g->json, object, "color", 3, out->color, NULL, g->f)
        || !json_get_number(&g->json, object, "intensity", &intensity, g->f)
        || !json_get_number(&g->json, object, "range", &out->range, g->f))
        return false;
    if (out->type == NULL)
        return json_fail(&g->json, object, "type", g->f, "a light has a type");
    for (int i = 0; i < 3; i++) {
        if (!(out->color[i] >= 0 && out->color[i] <= 1e6))
            return json_fail(&g->json, object, "color", g->f, "%g is no part of a colour", out->color[i]);
        out->color[i] *= intensity;
    }
    if (!(intensity >= 0 && intensity <= 1e12))
        return json_fail(&g->json, object, "intensity", g->f, "%g is no intensity", intensity);
    if (has_range && !(out->range > 0))
        return json_fail(&g->json, object, "range", g->f, "%g is no distance", out->range);
    while (out->kind < UNKNOWN && strcmp(out->type, kinds[out->kind]) != 0)
        out->kind++;
    return out->kind != SPOT || check_spot(g, object);
}

static bool read_lights(struct gltf *g, struct light **out, int *count)
{
    const int object = gltf_extension(g, 0, extension);
    int array, read = 0;
    if (object >= 0 && g->json.value[object].type != JSON_OBJECT)
        return json_fail(&g->json, object, NULL, g->f, "expected an object");
    if (!gltf_list(g, object, "lights", &array, count) || (*out = gltf_alloc(g, (size_t)*count, sizeof **out)) == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i))
        if (!read_light(g, i, &(*out)[read++]))
            return false;
    return true;
}

/* Gives a node's light to the first of what it may be that there is not yet; names what finds none. */
static void take_light(struct gltf *g, int node, const struct light *light, struct names *spots, struct names *others)
{
    struct model_light *const to = g->model->light;
    const int use = light->kind == UNKNOWN ? MODEL_LIGHTS : light->kind != DIRECTIONAL ? MODEL_LAMP
                  : to[MODEL_SUN].is_there                                             ? MODEL_SECOND : MODEL_SUN;
    if (use == MODEL_LIGHTS || to[use].is_there) {
        add_name(others, light);
        return;
    }
    to[use] = (struct model_light){ .is_there = true, .node = node, .range = light->range };
    memcpy(to[use].color, light->color, sizeof to[use].color);
    if (light->kind == SPOT)
        add_name(spots, light);
}

bool gltf_read_lights(struct gltf *g)
{
    struct names spots = { "", 0 }, others = spots, kinds = spots;
    struct light *light = NULL;
    int array, count, node = 0;
    bool ok = read_lights(g, &light, &count) && gltf_list(g, 0, "nodes", &array, &node);
    node = 0;
    for (int i = ok ? json_first(&g->json, array) : -1; ok && i >= 0; i = json_after(&g->json, i), node++) {
        const int object = gltf_extension(g, i, extension);
        int index = -1;
        if (object < 0)
            continue;
        if (g->json.value[object].type != JSON_OBJECT)
            ok = json_fail(&g->json, object, NULL, g->f, "expected an object");
        else if (json_member(&g->json, object, "light") < 0)
            ok = json_fail(&g->json, object, "light", g->f, "a node's light has an index");
        else
            ok = json_get_index(&g->json, object, "light", count, "light", &index, g->f);
        if (ok && g->model->in_scene[node])
            take_light(g, node, &light[index], &spots, light[index].kind == UNKNOWN ? &kinds : &others);
    }
    warn_of(g, "drawn as a point:", &spots, "");
    warn_of(g, "drawn without lights of unknown kinds:", &kinds, "");
    warn_of(g, "drawn without lights beyond two directional ones and a point:", &others, "");
    free(light);
    return ok;
}

/* ------------------------------------------------------------------ lights of a scene */

/* The lights of a file as a frame has them. Files say lux and candela, and nothing of an exposure. So light is dimmed until the
 * brightest, in the middle of the model at rest, is one (of a lamp that is nearer to it than half of the model: as far away as that);
 * what is fainter stays as it is. A point of I candela is as bright as a directional light of I / d^2 lux at a distance of d. The
 * library's lamp has all of its colour at a quarter of its reach: that is where the point has come down to one. */

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
