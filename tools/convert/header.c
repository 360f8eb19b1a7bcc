/* SPDX-License-Identifier: MIT */
/* header.c - a conversion as a C header: typed constant arrays and the
 * smear_model that points to them. C99 and C++. */
#include "tools/convert/build.h"

#include "tools/image/buffer.h"

#include <inttypes.h>
#include <string.h>

struct header_writer {
    struct buffer b;
    const struct conversion *c;
    const char *name;
    char upper[64];
};

/* ------------------------------------------------------------------ numbers */

static const char *type_of(char letter)
{
    return letter == 'B' ? "uint8_t" : letter == 'b' ? "int8_t" : letter == 'H' ? "uint16_t" : letter == 'h' ? "int16_t" : "uint32_t";
}

/* `static const TYPE NAME_what[count] = {...};`, nothing for no numbers. `index` -1: there is only one. */
static void put_numbers(struct header_writer *w, const char *what, int index, const void *data, size_t count,
                        char letter)
{
    const uint8_t *at = data;
    if (data == NULL || count == 0)
        return;
    buffer_print(&w->b, "static const %s %s_%s", type_of(letter), w->name, what);
    if (index >= 0)
        buffer_print(&w->b, "_%d", index);
    buffer_print(&w->b, "[%zu] = {", count);
    size_t line = 0;
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || w->b.size - line > 92) {
            buffer_print(&w->b, i > 0 ? ",\n    " : "\n    ");
            line = w->b.size - 4;
        } else {
            buffer_print(&w->b, ", ");
        }
        const int64_t number = record_number(letter, &at);
        buffer_print(&w->b, letter == 'I' ? "0x%08" PRIx64 "u" : "%" PRId64, number);
    }
    buffer_print(&w->b, "\n};\n\n");
}

static void put_words(struct header_writer *w, const int32_t *value, int count)
{
    for (int i = 0; i < count; i++)
        buffer_print(&w->b, value[i] == INT32_MIN ? "%s(-2147483647 - 1)" : "%s%" PRId32, i > 0 ? ", " : "", value[i]);
}

/* A pointer member: `NAME_what_index`, or 0 where there is nothing; then `after`. */
static void put_pointer(struct header_writer *w, const char *what, int index, bool is_there,
                        const char *after)
{
    if (!is_there)
        buffer_print(&w->b, "0%s", after);
    else if (index >= 0)
        buffer_print(&w->b, "%s_%s_%d%s", w->name, what, index, after);
    else
        buffer_print(&w->b, "%s_%s%s", w->name, what, after);
}

static void open_table(struct header_writer *w, const char *type, const char *what, int count)
{
    buffer_print(&w->b, "static const %s %s_%s[%d] = {\n", type, w->name, what, count);
}

static void close_table(struct header_writer *w)
{
    buffer_print(&w->b, "};\n\n");
}

/* ------------------------------------------------------------------ tables */

static int mesh_with_arrays(const smear_model *m, int index)
{
    int same = 0;
    while (m->mesh[same].position != m->mesh[index].position)
        same++;
    return same;
}

static void put_textures(struct header_writer *w)
{
    static const char *const format[] = { "SMEAR_TEXEL_8888", "SMEAR_TEXEL_565", "SMEAR_TEXEL_PALETTE8" };
    static const char *const wrap[] = { "SMEAR_REPEAT", "SMEAR_CLAMP", "SMEAR_MIRROR" };
    const struct conversion *c = w->c;
    for (int i = 0; i < c->texture_count; i++) {
        const smear_texture *t = &c->texture[i];
        if (c->same_texels[i] != i)
            continue;
        put_numbers(w, "texels", i, t->texels, convert_texel_count(t), "IHB"[t->format]);
        put_numbers(w, "palette", i, t->palette, (size_t)c->palette_count[i], 'I');
    }
    if (c->texture_count == 0)
        return;
    open_table(w, "smear_texture", "texture", c->texture_count);
    for (int i = 0; i < c->texture_count; i++) {
        const smear_texture *t = &c->texture[i];
        buffer_print(&w->b, "    { ");
        put_pointer(w, "texels", c->same_texels[i], true, ", ");
        put_pointer(w, "palette", c->same_texels[i], t->palette != NULL, ", ");
        buffer_print(&w->b, "%u, %u, %s, %s, %s, %u },\n", t->width, t->height, format[t->format], wrap[t->wrap_u], wrap[t->wrap_v],
                     t->levels);
    }
    close_table(w);
}

static void put_materials(struct header_writer *w)
{
    static const char *const alpha[] = { "SMEAR_OPAQUE", "SMEAR_CUTOUT", "SMEAR_BLEND" };
    const struct conversion *c = w->c;
    if (c->model.material_count == 0)
        return;
    open_table(w, "smear_material", "material", c->model.material_count);
    for (int i = 0; i < c->model.material_count; i++) {
        const smear_material *m = &c->model.material[i];
        if (m->texture != NULL)
            buffer_print(&w->b, "    { &%s_texture[%d], ", w->name, (int)(m->texture - c->texture));
        else
            buffer_print(&w->b, "    { 0, ");
        buffer_print(&w->b, "{ %u, %u, %u, %u }, %s, %u, %u, %u, %u, %u, %u },\n", m->color[0], m->color[1], m->color[2],
                     m->color[3], alpha[m->alpha], m->cutoff, m->unlit, m->double_sided, m->bilinear, m->gloss, m->shine);
    }
    close_table(w);
}

static void put_meshes(struct header_writer *w)
{
    const smear_model *m = &w->c->model;
    for (int i = 0; i < m->mesh_count; i++) {
        const smear_mesh *mesh = &m->mesh[i];
        size_t vertices = mesh->vertex_count, triangles = mesh->triangle_count;
        if (mesh_with_arrays(m, i) != i)
            continue;
        put_numbers(w, "position", i, mesh->position, 3 * vertices, 'h');
        put_numbers(w, "normal", i, mesh->normal, 3 * vertices, 'b');
        put_numbers(w, "uv", i, mesh->uv, 2 * vertices, 'h');
        put_numbers(w, "color", i, mesh->color, 4 * vertices, 'B');
        put_numbers(w, "face_color", i, mesh->face_color, 4 * triangles, 'B');
        put_numbers(w, "index", i, mesh->index, 3 * triangles, 'H');
    }
    if (m->mesh_count == 0)
        return;
    open_table(w, "smear_mesh", "mesh", m->mesh_count);
    for (int i = 0; i < m->mesh_count; i++) {
        const smear_mesh *mesh = &m->mesh[i];
        int arrays = mesh_with_arrays(m, i);
        buffer_print(&w->b, "    { ");
        put_pointer(w, "position", arrays, true, ", ");
        put_pointer(w, "normal", arrays, mesh->normal != NULL, ", ");
        put_pointer(w, "uv", arrays, mesh->uv != NULL, ", ");
        put_pointer(w, "color", arrays, mesh->color != NULL, ", ");
        put_pointer(w, "face_color", arrays, mesh->face_color != NULL, ", ");
        put_pointer(w, "index", arrays, true, ",\n      ");
        buffer_print(&w->b, "%" PRIu32 ", %u, %d, %u, %" PRId32 ", { ", mesh->triangle_count, mesh->vertex_count,
                     mesh->shift, mesh->uv_shift, mesh->scale);
        put_words(w, mesh->offset, 3);
        smear_mesh bounded = *mesh;
        smear_mesh_find_bounds(&bounded);
        const int16_t *b = bounded.bounds;
        buffer_print(&w->b, " }, { %d, %d, %d, %d, %d, %d } },\n", b[0], b[1], b[2], b[3], b[4], b[5]);
    }
    close_table(w);
}

/* Names as a string of C; each with its 0, the last one has the string's own. */
static void put_text(struct header_writer *w)
{
    const struct conversion *c = w->c;
    if (c->text_size == 0)
        return;
    buffer_print(&w->b, "static const char %s_text[] =\n    \"", w->name);
    for (int i = 0; i + 1 < c->text_size; i++) {
        unsigned letter = (unsigned char)c->model.text[i];
        bool plain = letter >= 32 && letter < 127 && strchr("\\\"?", (int)letter) == NULL;
        buffer_print(&w->b, plain ? "%c" : "\\%03o", letter);
        if (letter == 0)
            buffer_print(&w->b, "\"\n    \"");
    }
    buffer_print(&w->b, "\";\n\n");
}

/* One number of a record. */
static void put_field(struct header_writer *w, char letter, const uint8_t **data)
{
    static const char *const path[] = { "SMEAR_PATH_TRANSLATION", "SMEAR_PATH_ROTATION", "SMEAR_PATH_SCALE", "SMEAR_PATH_WEIGHTS" };
    const int64_t number = record_number(letter, data);
    const int32_t word = (int32_t)number;
    if (letter == 'p')
        buffer_print(&w->b, "%s", path[number]);
    else if (letter == 'i')
        put_words(w, &word, 1);
    else
        buffer_print(&w->b, letter == 'x' ? "0x%" PRIx64 : "%" PRId64, number);
}

static void put_record(struct header_writer *w, const char *fields, const uint8_t **data)
{
    bool is_first = true;
    buffer_print(&w->b, "{ ");
    for (; *fields != '\0'; fields++) {
        if (*fields == '}') {
            buffer_print(&w->b, " }");
            continue;
        }
        buffer_print(&w->b, is_first ? "" : ", ");
        is_first = *fields == '{';
        if (is_first)
            buffer_print(&w->b, "{ ");
        else
            put_field(w, *fields, data);
    }
    buffer_print(&w->b, " },");
}

static void put_records(struct header_writer *w, const struct record_table *t)
{
    const uint8_t *data = t->data;
    if (t->count == 0)
        return;
    open_table(w, t->type, t->name, t->count);
    for (int i = 0; i < t->count; i++) {
        buffer_print(&w->b, i % t->per_line == 0 ? "    " : " ");
        put_record(w, t->fields, &data);
        buffer_print(&w->b, (i + 1) % t->per_line == 0 || i + 1 == t->count ? "\n" : "");
    }
    close_table(w);
}

static void put_tables(struct header_writer *w)
{
    struct record_table tables[RECORD_TABLES];
    record_tables(w->c, tables);
    for (int i = 0; i < RECORD_TABLES; i++) {
        const struct record_table *t = &tables[i];
        if (t->fields[0] == 'c')
            put_text(w);
        else if (t->fields[1] == '\0')
            put_numbers(w, t->name, -1, t->data, (size_t)t->count, t->fields[0]);
        else
            put_records(w, t);
    }
}

static void put_model(struct header_writer *w)
{
    const struct conversion *c = w->c;
    const smear_model *m = &c->model;
    buffer_print(&w->b, "static const smear_model %s_model = {\n    ", w->name);
    put_pointer(w, "mesh", -1, m->mesh_count > 0, ", ");
    put_pointer(w, "material", -1, m->material_count > 0, ", ");
    put_pointer(w, "draw", -1, m->draw_count > 0, ", ");
    put_pointer(w, "node", -1, m->node_count > 0, ",\n    ");
    put_pointer(w, "joint", -1, c->joint_count > 0, ", ");
    put_pointer(w, "skin", -1, c->skin_count > 0, ", ");
    put_pointer(w, "influence", -1, c->influence_count > 0, ", ");
    put_pointer(w, "target", -1, c->target_count > 0, ",\n    ");
    put_pointer(w, "delta", -1, c->delta_count > 0, ", ");
    put_pointer(w, "delta_normal", -1, c->delta_normals > 0, ", ");
    put_pointer(w, "weight", -1, m->weight_count > 0, ", ");
    put_pointer(w, "clip", -1, m->clip_count > 0, ",\n    ");
    put_pointer(w, "channel", -1, c->channel_count > 0, ", ");
    put_pointer(w, "key_time", -1, c->key_times > 0, ", ");
    put_pointer(w, "key_value", -1, c->key_values > 0, ", ");
    put_pointer(w, "text", -1, c->text_size > 0, ",\n    ");
    buffer_print(&w->b, "%u, %u, %u, %u, %u, %u, %u, %u, %u, %u, %" PRIu32 ", %" PRId32 ",\n    { ", m->mesh_count,
                 m->material_count, m->draw_count, m->node_count, m->clip_count, m->weight_count, m->transform_count,
                 m->deformed_count, m->joint_count, m->normals, m->deformed_vertices, m->unit_shift);
    put_words(w, m->center, 3);
    buffer_print(&w->b, " }, %" PRId32 "\n};\n\n", m->radius);
}

static void put_channels(struct header_writer *w, const char *before, const uint16_t value[3])
{
    buffer_print(&w->b, "%s{ %u, %u, %u }", before, value[0], value[1], value[2]);
}

static void put_vector(struct header_writer *w, const char *before, const int32_t value[3])
{
    buffer_print(&w->b, "%s{ ", before);
    put_words(w, value, 3);
    buffer_print(&w->b, " }");
}

/* The file's lights: NAME_sun for smear_frame.light, NAME_lights for smear_scene.lights. */
static void put_lights(struct header_writer *w)
{
    const smear_light *sun = &w->c->sun;
    const smear_lights *l = &w->c->lights;
    if (w->c->has_sun) {
        buffer_print(&w->b, "static const smear_light %s_sun = { ", w->name);
        put_vector(w, "", sun->direction);
        put_channels(w, ", ", sun->ambient);
        put_channels(w, ", ", sun->diffuse);
        buffer_print(&w->b, " };\n\n");
    }
    if (!w->c->has_lights)
        return;
    buffer_print(&w->b, "static const smear_lights %s_lights = {\n    &smear_lights_shader", w->name);
    put_vector(w, ", ", l->direction);
    put_channels(w, ", ", l->diffuse);
    put_channels(w, ",\n    ", l->lamp_diffuse);
    put_vector(w, ", ", l->lamp);
    buffer_print(&w->b, ", %" PRId32 "\n};\n\n", l->reach);
}

/* ------------------------------------------------------------------ names */

/* Letters, digits and underscores, in capitals. */
static void put_capitals(struct header_writer *w, const char *text)
{
    for (; *text != '\0'; text++) {
        char c = *text;
        if (c >= 'a' && c <= 'z')
            c = (char)(c - 'a' + 'A');
        if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')))
            c = '_';
        buffer_byte(&w->b, (unsigned char)c);
    }
}

static bool same_capitals(const char *a, const char *b)
{
    for (;; a++, b++) {
        char x = *a, y = *b;
        x = x >= 'a' && x <= 'z' ? (char)(x - 'a' + 'A') : x;
        y = y >= 'a' && y <= 'z' ? (char)(y - 'a' + 'A') : y;
        bool plain_x = (x >= 'A' && x <= 'Z') || (x >= '0' && x <= '9');
        bool plain_y = (y >= 'A' && y <= 'Z') || (y >= '0' && y <= '9');
        if (x == '\0' || y == '\0' || (plain_x || plain_y ? x != y : false))
            return x == y;
    }
}

/* Constants NAME_kind_TEXT; a name that is there already, or empty, gets its index behind it. */
static void put_constants(struct header_writer *w, const char *kind, const char *const *text, int count)
{
    for (int i = 0; i < count; i++) {
        bool repeats = text[i][0] == '\0';
        for (int k = 0; k < i && !repeats; k++)
            repeats = same_capitals(text[i], text[k]);
        if (text[i][0] == '\0' && strcmp(kind, "NODE") == 0)
            continue;
        buffer_print(&w->b, "#define %s_%s_", w->upper, kind);
        put_capitals(w, text[i]);
        if (repeats)
            buffer_print(&w->b, text[i][0] == '\0' ? "%d" : "_%d", i);
        buffer_print(&w->b, " %d\n", i);
    }
}

static bool put_clip_constants(struct header_writer *w)
{
    const smear_model *m = &w->c->model;
    const char **name = calloc((size_t)m->clip_count + 1, sizeof *name);
    if (name == NULL)
        return false;
    for (int i = 0; i < m->clip_count; i++)
        name[i] = m->text + m->clip[i].name;
    put_constants(w, "CLIP", name, m->clip_count);
    free(name);
    return true;
}

static void put_top(struct header_writer *w, const char *from)
{
    const smear_model *m = &w->c->model;
    buffer_print(&w->b, "/* %s.h - ", w->name);
    buffer_comment(&w->b, from);
    buffer_print(&w->b, " for smear, written by smear convert.\n *\n"
           " * %d triangles, %d vertices, %u draws, %d textures, %u nodes, %u clips: "
           "%zu bytes of constant data.\n"
           " * Include it in one source file. */\n", w->c->triangles, w->c->vertices, m->draw_count,
                 w->c->texture_count, m->node_count, m->clip_count,
                 w->c->bytes.meshes + w->c->bytes.textures + w->c->bytes.animation);
    buffer_print(&w->b, "#ifndef %s_H\n#define %s_H\n\n#include \"smear_model.h\"\n%s\n"
           "#if SMEAR_MODEL_FORMAT != %d\n"
           "#error \"made for another version of smear: run smear convert again\"\n#endif\n\n",
                 w->upper, w->upper, w->c->has_lights ? "#include \"smear_scene.h\"\n" : "", SMEAR_MODEL_FORMAT);
    buffer_print(&w->b, "#define %s_TRIANGLES %d\n#define %s_DRAWS %u\n", w->upper, w->c->triangles, w->upper,
                 m->draw_count);
    buffer_print(&w->b,
        "#define %s_ACTOR_BYTES(poses) \\\n    SMEAR_ACTOR_MEMORY(%u, %u, %u, %u, %u, %" PRIu32
        ", %u, (poses))\n\n",
                 w->upper, m->node_count, m->joint_count, m->weight_count, m->transform_count, m->deformed_count,
                 m->deformed_vertices, m->normals);
}

bool convert_to_header(const struct conversion *c, const char *name, const char *from, uint8_t **bytes,
                       size_t *size, struct failure *f)
{
    struct header_writer w = { .c = c, .name = name };
    size_t length = strlen(name);
    if (length == 0 || length >= sizeof w.upper)
        return fail(f, "the name of a header needs 1 to 63 letters");
    for (size_t i = 0; i < length; i++)
        w.upper[i] = name[i] >= 'a' && name[i] <= 'z' ? (char)(name[i] - 'a' + 'A') : name[i];
    put_top(&w, from);
    w.b.failed = !put_clip_constants(&w) || w.b.failed;
    put_constants(&w, "NODE", c->node_name, c->model.node_count);
    buffer_print(&w.b, "\n");
    put_textures(&w);
    put_materials(&w);
    put_meshes(&w);
    put_tables(&w);
    put_model(&w);
    put_lights(&w);
    buffer_print(&w.b, "#endif\n");
    return buffer_give(&w.b, bytes, size) || fail(f, "out of memory");
}
