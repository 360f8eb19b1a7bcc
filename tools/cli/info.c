/* SPDX-License-Identifier: MIT */
/* info.c - `smear info`: what is in a scene. */
#include "tools/cli/commands.h"

#include "tools/cli/desc.h"
#include "tools/options/arguments.h"
#include "tools/player/memory.h"
#include "tools/options/say.h"
#include "tools/options/source.h"
#include "tools/view/board.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The board whose memory is compared with what the frame takes; null: none. */
static const struct board *info_board;

static const char *read_board(void *to, const char *value)
{
    (void)to;
    return view_read_board(value, &info_board);
}

/* What --desc says; without a width it was not given. */
static smear_desc info_desc;

static const char *read_desc(void *to, const char *value)
{
    (void)to;
    const char *wrong = desc_read(&info_desc, value);
    return wrong == NULL && info_desc.width == 0 ? "needs a width" : wrong;
}

static const struct option table[] = {
    { "--outside", OPTION_FLAG, OPTION_AT(struct source_view, files) },
    { "--board", OPTION_READ, .read = read_board },
    { "--desc", OPTION_READ, .read = read_desc },
    { .name = NULL },
};

/* ------------------------------------------------------------------ a model's parts */

/* In quotes, without anything that would leave the line. */
static void print_name(const char *name)
{
    putchar('"');
    for (; *name != '\0'; name++)
        putchar((unsigned char)*name < 32 || *name == 127 ? '?' : *name);
    putchar('"');
}

static void print_item(int index, const char *name)
{
    printf("  %d ", index);
    print_name(name);
}

/* Instances stand behind all other nodes, in the order of those; they are counted, not listed. */
static void print_nodes(const struct model *model)
{
    int listed = 0, instance;
    while (listed < model->node_count && !model->node[listed].is_instance)
        listed++;
    instance = listed;
    printf("nodes: %d\n", listed);
    for (int i = 0; i < listed; i++) {
        const struct model_node *node = &model->node[i];
        int first = instance, mesh = node->mesh;
        for (; instance < model->node_count && model->node[instance].parent == i; instance++)
            mesh = model->node[instance].mesh;
        print_item(i, node->name);
        if (node->parent >= 0)
            printf(" under %d", node->parent);
        if (mesh >= 0)
            printf(", mesh %d", mesh);
        if (instance > first)
            printf(", %d instances", instance - first);
        if (node->skin >= 0)
            printf(", skin %d", node->skin);
        printf("%s\n", model->in_scene[i] ? "" : ", not in the scene");
    }
}

static void print_clips(const struct model *model)
{
    printf("clips: %d\n", model->clip_count);
    for (int i = 0; i < model->clip_count; i++) {
        const struct model_clip *clip = &model->clip[i];
        print_item(i, clip->name);
        printf(" %.6g s, %d channels\n", clip->duration, clip->channel_count);
    }
}

static void print_cameras(const struct model *model)
{
    const double degrees = 57.29577951308232;
    printf("cameras: %d\n", model->camera_count);
    for (int i = 0; i < model->camera_count; i++) {
        const struct model_camera *camera = &model->camera[i];
        print_item(i, camera->name);
        if (camera->orthographic)
            printf(" orthographic, half height %.6g", camera->ymag);
        else
            printf(" perspective, yfov %.6g", camera->yfov * degrees);
        printf(", near %.6g", camera->znear);
        if (camera->zfar > 0.0)
            printf(", far %.6g", camera->zfar);
        printf(", node %d\n", camera->node);
    }
}

static void print_materials(const struct model *model)
{
    static const char *const alpha[] = { "opaque", "cutout", "blended" };
    printf("materials: %d\n", model->material_count);
    for (int i = 0; i < model->material_count; i++) {
        const struct model_material *m = &model->material[i];
        print_item(i, m->name);
        printf(" %s, colour %.4g %.4g %.4g %.4g", alpha[m->alpha], (double)m->base[0],
               (double)m->base[1], (double)m->base[2], (double)m->base[3]);
        if (m->image >= 0)
            printf(", texture %d", m->image);
        printf("%s%s\n", m->double_sided ? ", double-sided" : "", m->unlit ? ", unlit" : "");
    }
}

static void print_textures(const struct model *model)
{
    printf("textures: %d\n", model->image_count);
    for (int i = 0; i < model->image_count; i++)
        printf("  %d %dx%d\n", i, model->image[i].width, model->image[i].height);
}

static void print_meshes(const struct model *model)
{
    printf("meshes: %d\n", model->mesh_count);
    for (int i = 0; i < model->mesh_count; i++) {
        const struct model_mesh *mesh = &model->mesh[i];
        print_item(i, mesh->name);
        printf(" %d primitives\n", mesh->primitive_count);
        for (int k = 0; k < mesh->primitive_count; k++) {
            const struct model_primitive *p = &mesh->primitive[k];
            printf("    %d triangles, %d vertices, material %d%s%s%s%s", p->triangle_count,
                   p->vertex_count, p->material, p->normal != NULL ? ", normals" : "",
                   p->uv != NULL ? ", uv" : "", p->color != NULL ? ", colours" : "",
                   p->influences > 0 ? ", skinned" : "");
            if (p->target_count > 0)
                printf(", %d morph targets", p->target_count);
            printf("\n");
        }
    }
}

static void print_skins(const struct model *model)
{
    printf("skins: %d\n", model->skin_count);
    for (int i = 0; i < model->skin_count; i++) {
        print_item(i, model->skin[i].name);
        printf(" %d joints\n", model->skin[i].joint_count);
    }
}

static void print_model(const struct model *model)
{
    print_nodes(model);
    print_clips(model);
    print_cameras(model);
    print_materials(model);
    print_textures(model);
    print_meshes(model);
    print_skins(model);
    printf("skipped primitives: %d\n", model->skipped_primitives);
    if (model->warning[0] != '\0') {
        printf("warning: ");
        print_name(model->warning);
        printf("\n");
    }
}

/* ------------------------------------------------------------------ any scene */

/* World bounds of what is drawn; false when nothing is. */
static bool find_bounds(const struct scene_instant *instant, double low[3], double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = INFINITY;
        high[axis] = -INFINITY;
    }
    for (int i = 0; i < instant->draw_count; i++) {
        const struct scene_draw *draw = &instant->draw[i];
        for (int v = 0; v < draw->surface->vertex_count && !draw->hidden; v++) {
            const float *p = draw->position + 3 * (size_t)v;
            const double *m = draw->world;
            for (int axis = 0; axis < 3; axis++) {
                double at = m[axis] * (double)p[0] + m[4 + axis] * (double)p[1] +
                            m[8 + axis] * (double)p[2] + m[12 + axis];
                low[axis] = fmin(low[axis], at);
                high[axis] = fmax(high[axis], at);
            }
        }
    }
    return low[0] <= high[0];
}

/* No device draws more. */
enum { MAX_MEASURED = 32768 };

static void print_memory(const struct presented *presented, int width, int height, double *work)
{
    static const char *const names[MEMORY_SETUPS] = { "auto", "auto, no window", "reconstruct",
                                                      "none" };
    /* What a firmware gets that says nothing comes first. */
    static const enum memory_setup order[MEMORY_SETUPS] = { MEMORY_AUTO_SHARP, MEMORY_AUTO, MEMORY_RECONSTRUCT, MEMORY_NONE };
    for (int i = 0; i < MEMORY_SETUPS; i++) {
        const enum memory_setup setup = order[i];
        struct memory_need need;
        struct failure why = { "" };
        if (presented->triangle_count > MAX_MEASURED) {
            printf("memory at %dx%d: not measured for more than %d triangles\n", width, height, MAX_MEASURED);
            return;
        }
        if (!memory_measure(presented, width, height, setup, &need, work, &why)) {
            printf("memory at %dx%d: %s\n", width, height, why.text);
            return;
        }
        if (i == 0)
            printf("memory at %dx%d (rgb565, reach %d, tile %d, %u draws):\n", width, height,
                   need.reach, need.tile, (unsigned)need.draws);
        printf("  %-16s %zu bytes: window %zu, bands %zu, draws %zu, %u triangles %zu, rest %zu%s\n",
               names[setup], need.total, need.window, need.bands, need.draw_bytes,
               (unsigned)need.triangles, need.triangle_bytes, need.rest,
               setup == MEMORY_AUTO_SHARP ? "; what a smear_desc has that says no methods"
               : setup == MEMORY_AUTO ? "; with SMEAR_SET_SKETCH, as this program draws drafts" : "");
    }
}

/* What the board's method takes of the arena that firmware has there. */
static void print_board(const struct presented *presented, const struct board *board, double *work)
{
    struct memory_need need;
    struct failure why = { "" };
    const char *arena = board_option(board, "--arena"), *size = board_option(board, "--size");
    int width, height;
    if (sscanf(size, "%dx%d", &width, &height) != 2)
        return;
    printf("board %s: %s\n", board->name, board->what);
    if (presented->triangle_count > MAX_MEASURED)
        printf("  not measured for more than %d triangles\n", MAX_MEASURED);
    else if (!memory_measure(presented, width, height, MEMORY_AUTO_SHARP, &need, work, &why))
        printf("  %s\n", why.text);
    else
        printf("  auto at %s takes %zu bytes of %s%s\n", size, need.total, arena,
               need.total <= strtoul(arena, NULL, 10) ? "" : ": frames like this one are drawn in parts");
}

static int print_frame(struct source *source, double time)
{
    static const int size[2][2] = { { 320, 240 }, { 240, 240 } };
    const struct present_options options = { .fps = 30.0, .shutter_degrees = 180.0 };
    struct failure f = { "" };
    struct scene_instant instant = { 0 };
    double low[3], high[3], work = 0.0;
    bool ok = scene_pose(&source->scene, time, &instant, &f);
    if (ok && find_bounds(&instant, low, high))
        printf("bounds at %.6g s: %.6g %.6g %.6g to %.6g %.6g %.6g\n", time, low[0], low[1], low[2],
               high[0], high[1], high[2]);
    else if (ok)
        printf("bounds at %.6g s: nothing is drawn\n", time);
    scene_instant_free(&source->scene, &instant);

    struct presenter *presenter = ok ? presenter_new(&source->scene, &f) : NULL;
    const struct presented *presented =
        presenter != NULL ? presenter_frame(presenter, time, &options, &f) : NULL;
    if (presented != NULL)
        printf("draws: %d\ntriangles: %u\n", presented->draw_count,
               (unsigned)presented->triangle_count);
    ok = presented != NULL;
    for (int i = 0; i < 2 && ok; i++)
        print_memory(presented, size[i][0], size[i][1], &work);
    if (ok && info_board != NULL)
        print_board(presented, info_board, &work);
    presenter_free(presenter);
    return ok ? STATUS_OK : say_bad_input(source->name, &f);
}

static int list_builtin(void)
{
    for (int i = 0; i < scene_catalog_count; i++)
        printf("builtin:%-16s %s\n", scene_catalog[i].name, scene_catalog[i].what);
    return STATUS_OK;
}

int command_info(int count, char **text)
{
    static struct source source;        /* large */
    struct source_view view = { .aspect = 4.0 / 3.0, .fov_degrees = 45.0 };
    const char *name;
    bool wants_help;
    info_board = NULL;
    info_desc = (smear_desc){ 0 };
    int status = arguments_read(count, text, table, &view, &name, 1, &wants_help);
    if (status == STATUS_OK && wants_help)
        return help_print("info");
    if (status == STATUS_OK && info_desc.width != 0 && name == NULL) {
        const char *wrong = desc_print_memory(&info_desc);
        return wrong == NULL ? STATUS_OK : say_bad_usage("--desc", "%s", wrong);
    }
    if (status == STATUS_OK && (name == NULL || info_desc.width != 0))
        status = say_bad_usage("info", "needs a scene or --desc (smear help info)");
    if (status == STATUS_OK && strcmp(name, "builtin:") == 0)
        return list_builtin();
    if (status == STATUS_OK)
        status = source_open(name, &view, &source);
    if (status != STATUS_OK)
        return status;
    if (source.is_file)
        print_model(&source.model);
    else
        printf("size: %dx%d\nfps: %.6g\n", source.scene.width, source.scene.height,
               source.scene.fps);
    status = print_frame(&source, source.is_file ? 0.0 : source.scene.time);
    source_close(&source);
    return status;
}
