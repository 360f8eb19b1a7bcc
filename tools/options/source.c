/* SPDX-License-Identifier: MIT */
/* source.c - see source.h. */
#include "tools/options/source.h"

#include "tools/options/arguments.h"
#include "tools/options/say.h"

#include <math.h>
#include <string.h>

static const char builtin_prefix[] = "builtin:";

const char *source_builtin_name(const char *name)
{
    size_t length = sizeof builtin_prefix - 1;
    return strncmp(name, builtin_prefix, length) == 0 ? name + length : NULL;
}

static bool choose_clip(const struct model *model, const char *name, int *clip)
{
    *clip = model->clip_count > 0 ? 0 : MODEL_CLIP_NONE;
    if (name == NULL)
        return true;
    int found = model_find_clip(model, name);
    if (found >= 0)
        *clip = found;
    else if (strcmp(name, "none") == 0)
        *clip = MODEL_CLIP_NONE;
    else if (strcmp(name, "all") == 0)
        *clip = MODEL_CLIP_ALL;
    else
        return strcmp(name, "0") == 0;      /* the default, even where there is no clip */
    return true;
}

static int say_none(const char *option, const char *kind, const char *name, struct say_list *list)
{
    const char *there = say_list_end(list), *best = list->guess.best;
    return say_bad_usage(option, "the file has no %s \"%.80s\"; there is %s%s%.40s%s", kind, name, there,
                         best != NULL ? "; did you mean \"" : "", best != NULL ? best : "", best != NULL ? "\"?" : "");
}

int source_say_no_clip(const struct model *model, const char *name)
{
    struct say_list list = { .guess = { .word = name } };
    for (int i = 0; i < model->clip_count; i++)
        say_list_add(&list, model->clip[i].name);
    return say_none("--clip", "clip", name, &list);
}

int source_say_no_node(const struct model *model, const char *option, const char *name)
{
    struct say_list list = { .guess = { .word = name } };
    for (int i = 0; i < model->node_count; i++)
        say_list_add(&list, model->node[i].name);
    return say_none(option, "node", name, &list);
}

static int say_no_camera(const struct model *model, const char *name)
{
    struct say_list list = { .guess = { .word = name } };
    for (int i = 0; i < model->camera_count; i++)
        say_list_add(&list, model->camera[i].name);
    return say_none("--camera", "camera", name, &list);
}

/* Where the sun stands of which shadows are: that of the command line, of the file, or the library's. */
static bool find_sun(const struct model *model, double light[3], struct failure *f)
{
    static const double usual[3] = { 0.36, 0.80, 0.48 };
    struct model_lights of;
    if (light[0] != 0.0 || light[1] != 0.0 || light[2] != 0.0)
        return true;
    if (!model_find_lights(model, &of, f))
        return false;
    memcpy(light, of.has[MODEL_SUN] ? of.direction[MODEL_SUN] : usual, sizeof usual);
    return true;
}

static int open_file(const struct source_view *view, struct source *out)
{
    struct failure f = { "" };
    struct scene_view scene_view = { .loop = view->loop, .camera = -1, .has_eye = view->has_eye,
                                     .fov_degrees = view->fov_degrees, .bilinear = view->bilinear,
                                     .aspect = view->aspect, .shadow = view->shadow };
    memcpy(scene_view.eye, view->eye, sizeof scene_view.eye);
    memcpy(scene_view.look, view->look, sizeof scene_view.look);
    if (!model_load_from(out->name, view->files, &out->model, &f))
        return say_bad_input(out->name, &f);
    if (out->model.warning[0] != '\0')
        say_warning_when_done(out->name, out->model.warning);
    if (view->double_sided)
        model_show_both_sides(&out->model);

    int status = STATUS_OK;
    if (!choose_clip(&out->model, view->clip, &scene_view.clip))
        status = source_say_no_clip(&out->model, view->clip);
    else if (view->camera != NULL) {
        scene_view.camera = model_find_camera(&out->model, view->camera);
        if (scene_view.camera < 0)
            status = say_no_camera(&out->model, view->camera);
    } else if (!view->has_eye && out->model.camera_count > 0) {
        scene_view.camera = 0;
    }
    if (status == STATUS_OK && !find_sun(&out->model, scene_view.shadow.light, &f))
        status = say_bad_input(out->name, &f);
    if (status == STATUS_OK && !scene_from_model(&out->model, &scene_view, &out->scene, &f))
        status = say_bad_input(out->name, &f);
    if (status != STATUS_OK)
        model_free(&out->model);
    return status;
}

int source_open(const char *name, const struct source_view *view, struct source *out)
{
    struct failure f = { "" };
    const char *builtin = source_builtin_name(name);
    *out = (struct source){ .name = name, .is_file = builtin == NULL };
    if (builtin == NULL)
        return open_file(view, out);
    if (!scene_builtin(builtin, &out->scene, &f))
        return say_bad_input(name, &f);
    return STATUS_OK;
}

void source_close(struct source *source)
{
    scene_free(&source->scene);
    if (source->is_file)
        model_free(&source->model);
}

static unsigned encoded(const double color[3])
{
    return (unsigned)present_srgb_encode(color[0]) << 16 | (unsigned)present_srgb_encode(color[1]) << 8 | present_srgb_encode(color[2]);
}

int source_lights(const struct source *source, struct present_lights *lights)
{
    struct failure f = { "" };
    struct model_lights of;
    if (!source->is_file)
        return STATUS_OK;
    if (!model_find_lights(&source->model, &of, &f))
        return say_bad_input(source->name, &f);
    lights->are_of_file = true;
    lights->has_sun = of.has[MODEL_SUN];
    lights->has_second = of.has[MODEL_SECOND];
    lights->sun = encoded(of.color[MODEL_SUN]);
    lights->second = encoded(of.color[MODEL_SECOND]);
    lights->lamp = encoded(of.color[MODEL_LAMP]);
    lights->reach = of.reach;
    memcpy(lights->sun_direction, of.direction[MODEL_SUN], sizeof lights->sun_direction);
    memcpy(lights->direction, of.direction[MODEL_SECOND], sizeof lights->direction);
    memcpy(lights->place, of.place, sizeof lights->place);
    return STATUS_OK;
}

/* A node by its name, else by its index. */
static int find_node(const struct model *model, const char *option, const char *text, size_t length,
                     int *node)
{
    char name[256];
    long index;
    if (length == 0 || length >= sizeof name)
        return say_bad_usage(option, "needs the name or index of a node");
    memcpy(name, text, length);
    name[length] = '\0';
    *node = model_find_node(model, name);
    if (*node < 0 && read_integer(name, 0, model->node_count - 1, &index))
        *node = (int)index;
    if (*node < 0)
        return source_say_no_node(model, option, name);
    return STATUS_OK;
}

/* The node and the enum scene_motion of `NODE=MODE`. */
static int read_setting(const struct model *model, const char *setting, int *node, int *motion)
{
    static const char *const modes[] = { "full", "camera", "none", NULL };
    const char *equals = strrchr(setting, '=');
    size_t length = equals != NULL ? (size_t)(equals - setting) : 0;
    *motion = equals != NULL ? read_name(equals + 1, modes) : -1;
    if (*motion < 0 || length == 0 || length >= 256)
        return say_bad_usage("--motion", "needs NODE=full, NODE=camera or NODE=none (\"%s\")",
                             setting);
    return find_node(model, "--motion", setting, length, node);
}

int source_mask(const struct source *source, const char *nodes, const struct scene_instant *instant,
                uint8_t *layers)
{
    for (int i = 0; i < instant->draw_count; i++)
        layers[i] = SOURCE_UNMASKED;
    for (;;) {
        size_t length = strcspn(nodes, ",");
        int node, status = find_node(&source->model, "--mask", nodes, length, &node);
        if (status != STATUS_OK)
            return status;
        for (int i = 0; i < instant->draw_count; i++)
            if (model_node_is_under(&source->model, instant->draw[i].node, node))
                layers[i] = SOURCE_MASKED;
        if (nodes[length] == '\0')
            return STATUS_OK;
        nodes += length + 1;
    }
}

int source_motion(const struct source *source, const char *const *setting, int setting_count,
                  const struct scene_instant *instant, uint8_t *motion)
{
    for (int i = 0; i < instant->draw_count; i++)
        motion[i] = SCENE_MOTION_FULL;
    for (int s = 0; s < setting_count; s++) {
        int node, mode, status = read_setting(&source->model, setting[s], &node, &mode);
        if (status != STATUS_OK)
            return status;
        for (int i = 0; i < instant->draw_count; i++)
            if (model_node_is_under(&source->model, instant->draw[i].node, node))
                motion[i] = (uint8_t)mode;
    }
    return STATUS_OK;
}

bool source_stem(const char *name, char *out, size_t size)
{
    const char *builtin = source_builtin_name(name), *slash = strrchr(name, '/');
    const char *start = builtin != NULL ? builtin : slash != NULL ? slash + 1 : name;
    const char *dot = builtin != NULL ? NULL : strrchr(start, '.');
    size_t length = dot != NULL && dot > start ? (size_t)(dot - start) : strlen(start);
    if (length == 0 || length >= size)
        return false;
    for (size_t i = 0; i < length; i++)
        out[i] = start[i] == '/' ? '-' : start[i];
    out[length] = '\0';
    return true;
}

/* A clip that ends shows its last instant, too; one that loops shows it as its first. */
long source_period(const struct source *s, const struct source_view *view, double fps)
{
    const struct model *m = &s->model;
    double longest = 0.0, frames = s->scene.loop * fps;
    if (!s->is_file)
        return fabs(frames - (double)lround(frames)) < 1e-6 ? lround(frames) : 0;
    for (int i = 0; i < m->clip_count; i++)
        if (view->clip == NULL ? i == 0
                               : strcmp(view->clip, "all") == 0 || model_find_clip(m, view->clip) == i)
            longest = fmax(longest, m->clip[i].duration);
    frames = longest * fps;
    return frames > 0.0 && frames < 1e6 ? lround(frames) + !view->loop : 0;
}
