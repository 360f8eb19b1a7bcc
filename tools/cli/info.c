/* SPDX-License-Identifier: MIT */
/* info.c - `smear info`: what is in a scene. */
#include "tools/cli/commands.h"

#include "tools/options/arguments.h"
#include "tools/options/options.h"
#include "tools/options/say.h"
#include "tools/options/source.h"
#include "tools/player/device.h"
#include "tools/scenes/methods.h"
#include "tools/scenes/present.h"
#include "tools/view/board.h"

#include <math.h>
#include <smear.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ a desc */

/* The memory of a smear_desc, as `smear info --desc` prints it. Fields have the names that they have in smear_desc. */

/* A field, and the names of its values where they are no numbers. */
struct field {
    const char *name;
    uint8_t offset, size;
    const char *const *values;
};

#define FIELD(member, values) { #member, (uint8_t)offsetof(smear_desc, member), sizeof ((smear_desc *)0)->member, values }
static const struct field fields[] = {
    FIELD(width, NULL), FIELD(height, NULL), FIELD(max_triangles, NULL), FIELD(max_draws, NULL), FIELD(tile, NULL),
    FIELD(reach, NULL), FIELD(strip, NULL), FIELD(band_rows, NULL), FIELD(bands, NULL), FIELD(format, option_formats),
    FIELD(workers, NULL), FIELD(vertex_cache, NULL), FIELD(reuse.cache_static, NULL), FIELD(reuse.buffer_age, NULL),
    FIELD(reuse.one_pose, NULL), FIELD(filter.passes, NULL), FIELD(filter.scatter, NULL), FIELD(display.dither, option_dithers),
    FIELD(display.doubled, option_doubles)
};

/* What is read, and what is wrong with it. */
struct reading {
    smear_desc *desc;
    char wrong[280];
};

/* Adds methods joined by plus signs; accumulate_bands is the one whose memory differs from the method's of its name,
 * and sketch is SMEAR_SET_SKETCH. */
static bool read_methods(struct reading *r, char *value)
{
    for (char *name = strtok(value, "+"); name != NULL; name = strtok(NULL, "+")) {
        const struct method *method = method_named(name);
        const bool is_sketch = strcmp(name, "sketch") == 0;
        if (method == NULL && !is_sketch && strcmp(name, "accumulate_bands") != 0) {
            for (int i = 0; i < method_count; i++)
                read_near(name, method_list[i].name);
            snprintf(r->wrong, sizeof r->wrong, "methods: there is no %.40s, but %s, and accumulate_bands, and sketch, joined by +", name,
                     method_names());
            return false;
        }
        r->desc->methods = (uint16_t)(r->desc->methods | (method != NULL ? SMEAR_SET(method->method)
                                                          : is_sketch ? SMEAR_SET_SKETCH : SMEAR_SET_ACCUMULATE_BANDS));
    }
    return true;
}

static const struct field *find_field(const char *name)
{
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (strcmp(fields[i].name, name) == 0)
            return &fields[i];
    return NULL;
}

static bool say_no_field(struct reading *r, const char *name)
{
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        read_near(name, fields[i].name);
    read_near(name, "methods");
    snprintf(r->wrong, sizeof r->wrong, "%.40s is no field of smear_desc", name);
    return false;
}

static bool say_no_value(struct reading *r, const struct field *f, long most)
{
    int used = snprintf(r->wrong, sizeof r->wrong, "%s needs ", f->name);
    if (f->values == NULL)
        snprintf(r->wrong + used, sizeof r->wrong - (size_t)used, "a number from 0 to %ld", most);
    for (const char *const *name = f->values; name != NULL && *name != NULL; name++)
        used += snprintf(r->wrong + used, sizeof r->wrong - (size_t)used, "%s%s", name[0],
                         name[1] == NULL ? "" : name[2] == NULL ? " or " : ", ");
    return false;
}

static bool read_field(void *to, const char *name, const char *value)
{
    struct reading *r = to;
    char copy[LIST_PART];
    const bool is_methods = strcmp(name, "methods") == 0;
    const struct field *f = find_field(name);
    if (f == NULL && !is_methods)
        return say_no_field(r, name);
    if (value == NULL || *value == '\0') {
        snprintf(r->wrong, sizeof r->wrong, "%s needs %s value", name, value == NULL ? "an equals sign and a" : "a");
        return false;
    }
    if (is_methods) {
        snprintf(copy, sizeof copy, "%s", value);
        return read_methods(r, copy);
    }
    const long most = f->size == 1 ? UINT8_MAX : f->size == 2 ? INT16_MAX : INT32_MAX;
    long number = -1;
    if (f->values != NULL ? (number = read_name(value, f->values)) < 0 : !read_integer(value, 0, most, &number))
        return say_no_value(r, f, most);
    const uint8_t narrow = (uint8_t)number;
    const uint16_t middle = (uint16_t)number;
    const uint32_t wide = (uint32_t)number;
    memcpy((char *)r->desc + f->offset, f->size == 1 ? (const void *)&narrow : f->size == 2 ? (const void *)&middle : &wide, f->size);
    return true;
}

/* Reads fields as NAME=VALUE with commas. Returns null, or what is wrong with them. */
static const char *desc_read(smear_desc *desc, const char *text)
{
    static struct reading r;
    r = (struct reading){ .desc = desc };
    if (read_list(text, read_field, &r))
        return NULL;
    return r.wrong[0] != '\0' ? r.wrong : "needs fields of smear_desc, as width=240,height=240,methods=auto+none";
}

static int flush(void *user, const smear_band *band)
{
    (void)user, (void)band;
    return 0;
}

/* Prints the array that the desc takes. Returns null, or what is wrong with the desc. */
static const char *desc_print_memory(const smear_desc *desc)
{
    smear_context *ctx;
    smear_desc asked = *desc;
    asked.flush = flush;
    const int result = smear_init(&ctx, &asked, NULL, 0);
    const size_t bytes = smear_memory_needed(result);
    if (bytes == 0)
        return smear_error_text(result);
    printf("static uint64_t memory[%zu];    /* %zu bytes with pointers of %zu; where they have 4, boards need a little less */\n",
           (bytes + 7) / 8, bytes, sizeof(void *));
    return NULL;
}

/* ------------------------------------------------------------------ memory */

/* What a frame costs a device in bytes. */

/* How a device may be set up, in the order in which they are shown. */
enum memory_setup { MEMORY_AUTO, MEMORY_AUTO_SHARP, MEMORY_RECONSTRUCT, MEMORY_NONE, MEMORY_SETUPS };

struct memory_need {
    int reach, tile;            /* pixels */
    uint32_t draws, triangles;  /* room for them */
    uint32_t triangles_drawn;
    size_t total;               /* bytes, as smear_memory_size() */
    size_t window, bands, draw_bytes, triangle_bytes, rest;     /* parts of it */
};

/* What all searches of a command may draw: triangles and, for 16 of them, pixels. */
static const double max_work = 6e6;

/* Draws the frame with room for so many triangles; a method that has too little is not done in one either. */
static bool draws_in_one(struct device *device, const struct presented *presented,
                         uint32_t triangles, smear_stats *stats, double *work, struct failure *f)
{
    struct failure why = { "" };
    if (*work > max_work)
        return fail(f, "its frame takes too long to be measured");
    device->setup.max_triangles = triangles;
    if (!device_fit(device, presented, f))
        return false;
    if (!device_draw(device, presented, &why) && device->result != SMEAR_ERR_ROOM) {
        *f = why;
        return false;
    }
    smear_get_stats(device->ctx, stats);
    *work += (double)presented->triangle_count * (1 + stats->parts_added) + ((double)stats->pixels + stats->samples) / 16;
    stats->parts_added += device->result == SMEAR_ERR_ROOM;
    return true;
}

/* How many triangles' room a frame filled that was drawn with room for `triangles`. */
static uint32_t filled(const smear_stats *stats, uint32_t triangles)
{
    const smear_fill *fill = &stats->fill.geometry;
    return fill->room > 0 ? (uint32_t)(((uint64_t)fill->used * triangles + fill->room - 1) / fill->room) : 0;
}

/* Narrows the interval in which the smallest sufficient list lies, from what the frame filled, in growing steps. Begins with
 * room for all, as many parts take long. */
static bool find_smallest(struct device *device, const struct presented *presented, uint32_t *list,
                          uint32_t *drawn, double *work, struct failure *f)
{
    smear_stats stats;
    uint32_t low = DEVICE_MIN_TRIANGLES, all = 2 * presented->triangle_count, high = all > low ? all : low;
    for (;; high *= 2) {
        if (!draws_in_one(device, presented, high, &stats, work, f))
            return false;
        if (stats.parts_added == 0)
            break;
        low = high + 1;
        if (high > 4 * presented->triangle_count + 64)
            break;                      /* cannot be: clipping makes a few of one, not more */
    }
    *drawn = stats.triangles_drawn;
    uint32_t guess = filled(&stats, high), up = 0, down = 0;
    while (low < high) {
        const uint32_t middle = guess >= low && guess < high ? guess : low + (high - low) / 2;
        if (!draws_in_one(device, presented, middle, &stats, work, f))
            return false;
        if (stats.parts_added == 0) {
            high = middle;
            guess = high - 1 - down;
            down = 2 * down + 1;
        } else {
            low = middle + 1;
            guess = low + up;
            up = 2 * up + 1;
        }
    }
    *list = high;
    return true;
}

/* What the arena is made of. Of some parts: what twice as many would cost more. */
static void split_up(struct memory_need *need, const smear_desc *desc)
{
    smear_desc twice = *desc;
    need->total = smear_memory_size(desc);
    twice.max_triangles *= 2;
    need->triangle_bytes = smear_memory_size(&twice) - need->total;
    twice = *desc;
    twice.max_draws = (uint16_t)(desc->max_draws * 2);
    need->draw_bytes = smear_memory_size(&twice) - need->total;
    size_t row = (size_t)desc->width, bytes_per_pixel = need->reach <= 15 ? 8 : 10;
    const bool has_window = (desc->methods & SMEAR_SET_FILTERS) != 0;
    const bool holds_back = has_window && (desc->methods & SMEAR_SET_TEMPORAL) != 0;    /* a band waits for the row below */
    need->bands = row * 2 * (size_t)need->tile * (holds_back ? 2 : 1);
    if ((desc->methods & SMEAR_SET_SKETCH) != 0)        /* colour and depth, and those of the row that lines have blurred */
        need->window = row * (size_t)(3 * need->tile + need->reach) * 6;
    else
        need->window = has_window ? row * (size_t)(2 * need->tile + need->reach) * bytes_per_pixel
                                  : row * (size_t)need->tile * 6;
    need->rest = need->total - need->triangle_bytes - need->draw_bytes - need->bands - need->window;
}

/* For RGB565, one band, one core and the default reach: with the smallest list of triangles that
 * draws the frame in one part. `work`, 0 at first, adds up what is drawn for it: there is a limit to that of all
 * measurements of a command. */
static bool memory_measure(const struct presented *presented, int width, int height,
                           enum memory_setup which, struct memory_need *need, double *work, struct failure *f)
{
    static const struct {
        uint8_t method;
        unsigned set;
    } setups[MEMORY_SETUPS] = {
        [MEMORY_AUTO] = { SMEAR_AUTO, SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH },
        [MEMORY_AUTO_SHARP] = { SMEAR_AUTO, SMEAR_SET(SMEAR_AUTO) },
        [MEMORY_RECONSTRUCT] = { SMEAR_RECONSTRUCT, SMEAR_SET(SMEAR_RECONSTRUCT) },
        [MEMORY_NONE] = { SMEAR_NONE, SMEAR_SET(SMEAR_NONE) },
    };
    struct device device;
    struct device_setup setup = { .width = width, .height = height, .threads = 1,
                                  .format = SMEAR_RGB565 };
    struct presented drawn = *presented;
    drawn.frame.method = setups[which].method;
    setup.methods = setups[which].set;
    setup.reach = height / 20 > 0 ? height / 20 : 1;
    setup.tile = setup.reach <= 8 ? 8 : setup.reach <= 16 ? 16 : setup.reach <= 32 ? 32 : 64;
    *need = (struct memory_need){ .reach = setup.reach, .tile = setup.tile };
    bool ok = device_open(&device, &setup, f) &&
              find_smallest(&device, &drawn, &need->triangles, &need->triangles_drawn, work, f);
    if (ok) {
        smear_desc desc = device.desc;
        desc.max_triangles = need->triangles;
        desc.debug.crc = 0;
        need->draws = desc.max_draws;
        split_up(need, &desc);
    }
    device_close(&device);
    return ok;
}

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
