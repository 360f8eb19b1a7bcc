/* SPDX-License-Identifier: MIT */
/* tape.c - writes presented frames as C source.
 *
 * Every object of the source is first written into a text of its own. Equal texts are the same
 * object, so whatever two frames share is found without looking at what it is: a frame's text names
 * its cameras, a draw's text its mesh, a mesh's text its arrays. */
#include "tools/scenes/tape.h"

#include "tools/image/buffer.h"
#include "tools/model/intern.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_WIDTH = 96 };

struct tape_writer {
    struct text_table objects;      /* number N is `TYPE=VALUE`, for `static const TYPE oN = VALUE;`; of arrays `[TYPE=VALUE` */
    /* the tape being written */
    bool is_open;
    char name[64];
    int desc, frame_count, crc_count;
    struct buffer frames, crcs;
    /* the tapes written */
    int tape_count;
    struct buffer list;
};

/* ------------------------------------------------------------------ text */

/* Adds an element of an array, breaking lines at LINE_WIDTH. */
static void add_element(struct buffer *text, const char *element)
{
    size_t line = 0;
    while (line < text->size && text->data[text->size - 1 - line] != '\n')
        line++;
    if (line + strlen(element) > LINE_WIDTH)
        buffer_print(text, "\n    ");
    buffer_print(text, "%s", element);
}

static void add_number(struct buffer *text, int64_t value)
{
    char element[32];
    /* INT32_MIN has no literal of its own type */
    snprintf(element, sizeof element, value == INT32_MIN ? "%" PRId64 " - 1," : "%" PRId64 ",",
             value == INT32_MIN ? value + 1 : value);
    add_element(text, element);
}

/* ------------------------------------------------------------------ objects */

/* The object with this text, new or known; takes the text. -1 when out of memory. */
static int object(struct tape_writer *w, const char *type, bool is_array, struct buffer *value)
{
    struct buffer key = { .failed = value->failed };
    buffer_print(&key, "%s%s=", is_array ? "[" : "", type);
    buffer_append(&key, value->data, value->size);
    buffer_byte(&key, '\0');
    const int found = key.failed ? -1 : text_intern(&w->objects, (const char *)key.data);
    buffer_free(&key);
    buffer_free(value);
    return found;
}

/* `.name = &oN, ` (`oN` for arrays); nothing for a null pointer. -1 stands for out of memory. */
enum { NO_OBJECT = -2 };

static void add_reference(struct buffer *text, const struct tape_writer *w, const char *name,
                          int object_index)
{
    if (object_index == -1)
        text->failed = true;
    if (object_index < 0)
        return;
    buffer_print(text, ".%s = %so%d, ", name, w->objects.text[object_index][0] == '[' ? "" : "&", object_index);
}

static void add_field(struct buffer *text, const char *name, int64_t value)
{
    if (value != 0)
        buffer_print(text, ".%s = %" PRId64 ", ", name, value);
}

/* A field by its name, and all of a list that are not zero. */
struct field {
    const char *name;
    int64_t value;
};

#define F(of, member) { #member, (of).member }
#define ADD_FIELDS(text, ...) add_fields((text), (const struct field[]){ __VA_ARGS__, { NULL, 0 } })

static void add_fields(struct buffer *text, const struct field *list)
{
    for (; list->name != NULL; list++)
        add_field(text, list->name, list->value);
}

enum element { INT8, UINT8, INT16, UINT16, UINT32 };

static int array(struct tape_writer *w, enum element kind, const void *data, size_t count)
{
    static const char *const type[] = { "int8_t", "uint8_t", "int16_t", "uint16_t", "uint32_t" };
    struct buffer text = { 0 };
    if (data == NULL)
        return NO_OBJECT;
    buffer_print(&text, "{\n    ");
    for (size_t i = 0; i < count; i++) {
        char element[16];
        switch (kind) {
        case INT8: add_number(&text, ((const int8_t *)data)[i]); break;
        case UINT8: add_number(&text, ((const uint8_t *)data)[i]); break;
        case INT16: add_number(&text, ((const int16_t *)data)[i]); break;
        case UINT16: add_number(&text, ((const uint16_t *)data)[i]); break;
        case UINT32:
            snprintf(element, sizeof element, "0x%" PRIx32 ",", ((const uint32_t *)data)[i]);
            add_element(&text, element);
            break;
        }
    }
    buffer_print(&text, "\n}");
    return object(w, type[kind], true, &text);
}

static void add_int32s(struct buffer *text, const char *name, const int32_t *value, int count)
{
    buffer_print(text, ".%s = { ", name);
    for (int i = 0; i < count; i++)
        add_number(text, value[i]);
    buffer_print(text, " }, ");
}

static int transform(struct tape_writer *w, const smear_transform *t)
{
    struct buffer text = { 0 };
    if (t == NULL)
        return NO_OBJECT;
    buffer_print(&text, "{ ");
    add_int32s(&text, "basis", t->basis, 9);
    add_int32s(&text, "origin", t->origin, 3);
    buffer_print(&text, "}");
    return object(w, "smear_transform", false, &text);
}

static int camera(struct tape_writer *w, const smear_camera *c)
{
    struct buffer text = { 0 };
    if (c == NULL)
        return NO_OBJECT;
    buffer_print(&text, "{ .pose = { ");
    add_int32s(&text, "basis", c->pose.basis, 9);
    add_int32s(&text, "origin", c->pose.origin, 3);
    buffer_print(&text, "},\n    ");
    ADD_FIELDS(&text, F(*c, focal), F(*c, half_height), F(*c, near_plane), F(*c, far_plane));
    buffer_print(&text, "}");
    return object(w, "smear_camera", false, &text);
}

static int texture(struct tape_writer *w, const smear_texture *t)
{
    struct buffer text = { 0 };
    if (t == NULL)
        return NO_OBJECT;
    size_t count = (size_t)t->width * t->height;
    enum element kind = t->format == SMEAR_TEXEL_8888  ? UINT32
                      : t->format == SMEAR_TEXEL_565 ? UINT16
                                                      : UINT8;
    int texels = array(w, kind, t->texels, count);
    int palette = t->format == SMEAR_TEXEL_PALETTE8 ? array(w, UINT32, t->palette, 256) : NO_OBJECT;
    buffer_print(&text, "{ ");
    add_reference(&text, w, "texels", texels);
    add_reference(&text, w, "palette", palette);
    ADD_FIELDS(&text, F(*t, width), F(*t, height), F(*t, format), F(*t, wrap_u), F(*t, wrap_v));
    buffer_print(&text, "}");
    return object(w, "smear_texture", false, &text);
}

static int material(struct tape_writer *w, const smear_material *m)
{
    struct buffer text = { 0 };
    if (m == NULL)
        return NO_OBJECT;
    int image = texture(w, m->texture);
    buffer_print(&text, "{ ");
    add_reference(&text, w, "texture", image);
    buffer_print(&text, ".color = { %d, %d, %d, %d }, ", m->color[0], m->color[1], m->color[2], m->color[3]);
    ADD_FIELDS(&text, F(*m, alpha), F(*m, cutoff), F(*m, unlit), F(*m, double_sided), F(*m, bilinear));
    buffer_print(&text, "}");
    return object(w, "smear_material", false, &text);
}

static int mesh(struct tape_writer *w, const smear_mesh *m)
{
    struct buffer text = { 0 };
    size_t vertices = m->vertex_count, triangles = m->triangle_count;
    int position = array(w, INT16, m->position, vertices * 3);
    int normal = array(w, INT8, m->normal, vertices * 3);
    int uv = array(w, INT16, m->uv, vertices * 2);
    int color = array(w, UINT8, m->color, vertices * 4);
    int face_color = array(w, UINT8, m->face_color, triangles * 4);
    int index = array(w, UINT16, m->index, triangles * 3);
    buffer_print(&text, "{ ");
    add_reference(&text, w, "position", position);
    add_reference(&text, w, "normal", normal);
    add_reference(&text, w, "uv", uv);
    add_reference(&text, w, "color", color);
    add_reference(&text, w, "face_color", face_color);
    add_reference(&text, w, "index", index);
    buffer_print(&text, "\n    ");
    ADD_FIELDS(&text, F(*m, triangle_count), F(*m, vertex_count), F(*m, shift), F(*m, uv_shift), F(*m, scale));
    if (m->offset[0] != 0 || m->offset[1] != 0 || m->offset[2] != 0)
        add_int32s(&text, "offset", m->offset, 3);
    smear_mesh bounded = *m;
    smear_mesh_find_bounds(&bounded);
    int32_t bounds[6];
    for (int i = 0; i < 6; i++)
        bounds[i] = bounded.bounds[i];
    add_int32s(&text, "bounds", bounds, 6);
    buffer_print(&text, "}");
    return object(w, "smear_mesh", false, &text);
}

/* An element of the array of draws. */
static void add_draw(struct buffer *text, struct tape_writer *w, const smear_draw *d)
{
    size_t coordinates = (size_t)d->mesh->vertex_count * 3;
    int mesh_object = mesh(w, d->mesh), material_object = material(w, d->material);
    int now = transform(w, d->now), open = transform(w, d->open), close = transform(w, d->close);
    int open_position = array(w, INT16, d->open_position, coordinates);
    int close_position = array(w, INT16, d->close_position, coordinates);
    buffer_print(text, "    { ");
    add_field(text, "id", d->id);
    add_reference(text, w, "mesh", mesh_object);
    add_reference(text, w, "material", material_object);
    add_reference(text, w, "now", now);
    add_reference(text, w, "open", open);
    add_reference(text, w, "close", close);
    add_reference(text, w, "open_position", open_position);
    add_reference(text, w, "close_position", close_position);
    ADD_FIELDS(text, F(*d, motion), F(*d, cut), F(*d, billboard), F(*d, path), F(*d, open_count), F(*d, close_count),
               F(*d, layers));
    buffer_print(text, "},\n");
}

/* Of layers without cameras. */
static int layers(struct tape_writer *w, const smear_layer *layer, int count)
{
    struct buffer text = { 0 };
    if (layer == NULL)
        return NO_OBJECT;
    buffer_print(&text, "{");
    for (int i = 0; i < count; i++) {
        buffer_print(&text, "{ ");
        add_field(&text, "mask", layer[i].mask);
        add_field(&text, "method", layer[i].method);
        add_field(&text, "over", layer[i].over);
        add_field(&text, "two_camera", layer[i].two_camera);
        add_field(&text, "shutter_degrees", layer[i].shutter_degrees);
        buffer_print(&text, "}, ");
    }
    buffer_print(&text, "}");
    return object(w, "smear_layer", true, &text);
}

static int frame_object(struct tape_writer *w, const smear_frame *frame)
{
    struct buffer text = { 0 };
    int now = camera(w, frame->camera), open = camera(w, frame->open);
    int close = camera(w, frame->close);
    int curve = array(w, UINT8, frame->shutter.curve, SMEAR_SHUTTER_POINTS);
    int layer = layers(w, frame->layer, frame->layer_count);
    buffer_print(&text, "{ ");
    add_reference(&text, w, "camera", now);
    add_reference(&text, w, "open", open);
    add_reference(&text, w, "close", close);
    ADD_FIELDS(&text, F(*frame, method), F(*frame, light_space), F(*frame, cut), F(*frame, samples), F(*frame, target),
               F(*frame, clear), F(*frame, shutter.degrees), F(*frame, shutter.exposure), F(*frame, shutter.poses),
               F(*frame, shutter.mode), F(*frame, shutter.path), F(*frame, shutter.reference_hz), F(*frame, shutter.frame_us),
               F(*frame, shutter.us));
    add_reference(&text, w, "shutter.curve", curve);
    ADD_FIELDS(&text, F(*frame, filter.kind), F(*frame, filter.flags), F(*frame, filter.weights), F(*frame, filter.camera_step),
               F(*frame, filter.pingpong.passes), F(*frame, filter.pingpong.taps), F(*frame, filter.pingpong.base),
               F(*frame, filter.pingpong.jitter), F(*frame, filter.pingpong.bias), F(*frame, filter.pingpong.spread),
               F(*frame, scale.rotation), F(*frame, scale.translation), F(*frame, scale.object));
    add_reference(&text, w, "layer", layer);
    add_field(&text, "layer_count", frame->layer_count);
    buffer_print(&text, "}");
    return object(w, "smear_frame", false, &text);
}

static int desc_object(struct tape_writer *w, const smear_desc *given)
{
    struct buffer text = { 0 };
    smear_desc d = *given;
    present_tiles(&d, false);
    buffer_print(&text, "{ ");
    ADD_FIELDS(&text, F(d, width), F(d, height), F(d, max_triangles), F(d, max_draws), F(d, methods), F(d, tile), F(d, reach),
               F(d, strip), F(d, band_rows), F(d, bands), F(d, format), F(d, workers), F(d, vertex_cache), F(d, filter.passes),
               F(d, filter.scatter), F(d, display.dither), F(d, debug.crc));
    buffer_print(&text, "}");
    return object(w, "smear_desc", false, &text);
}

/* ------------------------------------------------------------------ tapes */

static bool out_of_room(struct failure *f)
{
    return fail(f, "out of memory");
}

/* Turns what was collected since tape_begin into one struct tape of the list. */
static bool close_tape(struct tape_writer *w, struct failure *f)
{
    struct buffer value = { 0 };
    if (!w->is_open)
        return true;
    w->is_open = false;
    buffer_print(&w->frames, "}");
    buffer_print(&w->crcs, "\n}");
    bool all_crcs = w->crc_count == w->frame_count && w->frame_count > 0;
    int frames = object(w, "struct tape_frame", true, &w->frames);
    int crcs = NO_OBJECT;
    if (all_crcs)
        crcs = object(w, "uint32_t", true, &w->crcs);
    buffer_free(&w->crcs);
    buffer_print(&value, "{ .name = \"%s\", ", w->name);
    add_reference(&value, w, "desc", w->desc);
    add_reference(&value, w, "frame", frames);
    add_field(&value, "frame_count", w->frame_count);
    add_reference(&value, w, "crc", crcs);
    buffer_print(&value, "}");
    int tape = object(w, "struct tape", false, &value);
    if (tape < 0)
        return out_of_room(f);
    buffer_print(&w->list, "    &o%d,\n", tape);
    w->tape_count++;
    return !w->list.failed || out_of_room(f);
}

bool tape_begin(struct tape_writer *w, const char *name, const smear_desc *desc, struct failure *f)
{
    if (!close_tape(w, f))
        return false;
    if (strlen(name) >= sizeof w->name || strpbrk(name, "\"\\\n") != NULL)
        return fail(f, "a tape cannot have this name");
    memcpy(w->name, name, strlen(name) + 1);
    w->desc = desc_object(w, desc);
    w->is_open = true;
    w->frame_count = w->crc_count = 0;
    buffer_print(&w->frames, "{\n");
    buffer_print(&w->crcs, "{\n    ");
    return w->desc >= 0 || out_of_room(f);
}

bool tape_add(struct tape_writer *w, const struct presented *frame, const uint32_t *crc,
              struct failure *f)
{
    struct buffer draws = { 0 };
    int draw_object = NO_OBJECT;
    if (!w->is_open)
        return fail(f, "no tape was begun");
    int frame_index = frame_object(w, &frame->frame);
    if (frame->draw_count > 0) {
        buffer_print(&draws, "{\n");
        for (int i = 0; i < frame->draw_count; i++)
            add_draw(&draws, w, &frame->draw[i]);
        buffer_print(&draws, "}");
        draw_object = object(w, "smear_draw", true, &draws);
    }
    buffer_print(&w->frames, "    { ");
    add_reference(&w->frames, w, "frame", frame_index);
    add_reference(&w->frames, w, "draw", draw_object);
    add_field(&w->frames, "draw_count", frame->draw_count);
    buffer_print(&w->frames, "},\n");
    w->frame_count++;
    if (crc != NULL) {
        char element[16];
        snprintf(element, sizeof element, "0x%" PRIx32 ",", *crc);
        add_element(&w->crcs, element);
        w->crc_count++;
    }
    return (!w->frames.failed && !w->crcs.failed) || out_of_room(f);
}

bool tape_write(struct tape_writer *w, const char *path, const char *command, struct failure *f)
{
    struct buffer out = { 0 };
    if (!close_tape(w, f))
        return false;
    if (w->tape_count == 0)
        return fail(f, "no tape was begun");
    buffer_print(&out, "/* Written by %s; do not edit. */\n#include \"platform/play.h\"\n\n", command);
    for (int i = 0; i < w->objects.count; i++) {
        const char *text = w->objects.text[i], *type = text + (*text == '['), *value = strchr(text, '=');
        buffer_print(&out, "static const %.*s o%d%s = ", (int)(value - type), type, i, type > text ? "[]" : "");
        buffer_append(&out, value + 1, strlen(value + 1));
        buffer_print(&out, ";\n");
    }
    buffer_print(&out, "\nconst struct tape *const tape_list[] = {\n");
    buffer_append(&out, w->list.data, w->list.size);
    buffer_print(&out, "};\nconst int tape_count = %d;\n", w->tape_count);
    bool ok = !out.failed ? file_write(path, out.data, out.size, f)
                          : out_of_room(f);
    buffer_free(&out);
    return ok;
}

struct tape_writer *tape_writer_new(struct failure *f)
{
    struct tape_writer *w = calloc(1, sizeof *w);
    if (w == NULL)
        out_of_room(f);
    return w;
}

void tape_writer_free(struct tape_writer *w)
{
    if (w == NULL)
        return;
    text_table_free(&w->objects);
    buffer_free(&w->frames);
    buffer_free(&w->crcs);
    buffer_free(&w->list);
    free(w);
}
