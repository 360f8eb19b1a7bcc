/* SPDX-License-Identifier: MIT */
/* obj.c - Wavefront OBJ: polygons of `v`, `vt`, `vn`, in named objects and groups.
 *
 * An `o` becomes a node; a `g` under it a child node with a mesh of its own (without any `o`, a
 * root), so both names can be asked for. Faces of a node that share a material and a form (with
 * or without texture coordinates and normals) make a primitive. Polygons become fans of
 * triangles. */
#include "tools/model/obj.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A growing array of floats, `width` per entry. */
struct floats {
    float *value;
    int width, count, capacity;
};

/* One corner of a triangle: positions in the lists, -1 for none; NO_NUMBER for a normal that is none. */
struct corner { int v, vt, vn; };
enum { NO_NUMBER = -2 };

enum { HAS_UV = 1, HAS_NORMAL = 2 };

struct reader {
    struct obj_text text;
    struct external *files;
    struct model *model;
    struct failure *f;
    struct floats v, vt, vn, color;     /* colour: one per v as soon as one has it */
    bool has_color;
    struct corner *polygon;             /* the face at hand */
    int polygon_capacity;
    struct corner *corner;              /* 3 per triangle */
    int *part;                          /* per triangle: its part */
    int triangle_count, triangle_capacity;
    struct text_table names;            /* of objects and groups; 0 is "" */
    struct triple_table nodes;          /* object name, group name, 0 */
    struct triple_table parts;          /* node, material, form */
    struct mtl_library library;
    int object, group, material;        /* in force; -1 material: default */
    int missing;                        /* files and materials that are named and not there */
    struct {                            /* what is left out, or read as something else */
        int vertices, uvs, normals;     /* that are no numbers */
        int short_faces, broken_faces;  /* of fewer than three corners; with a corner that is no number */
        int uneven_faces;               /* that lack at one corner what they have at another */
        int freeform;                   /* statements of curves and surfaces */
    } fault;
};

static bool grow(struct reader *r, void **array, int *capacity, int count, int more, size_t size)
{
    if (count <= *capacity - more)
        return true;
    if (count > INT_MAX / 8 - more)
        return fail(r->f, "too large (line %d)", r->text.line);
    int wanted = *capacity == 0 ? 64 : *capacity;
    while (wanted < count + more)
        wanted *= 2;
    void *grown = realloc(*array, (size_t)wanted * size);
    if (grown == NULL)
        return fail(r->f, "out of memory (line %d)", r->text.line);
    *array = grown;
    *capacity = wanted;
    return true;
}

static float *add_floats(struct reader *r, struct floats *list)
{
    void *value = list->value;
    if (!grow(r, &value, &list->capacity, list->count, 1, (size_t)list->width * sizeof(float)))
        return NULL;
    list->value = value;
    return list->value + (size_t)list->count++ * (size_t)list->width;
}

/* Up to `most` numbers, NaN for those that are not finite; *n tells how many there are. */
static bool read_numbers(struct reader *r, const char *keyword, char *rest, int least, int most,
                         float *out, int *n)
{
    char *word;
    *n = 0;
    while (*n < most && (word = obj_word(&rest)) != NULL) {
        if (obj_is_not_finite(word))
            out[*n] = NAN;
        else if (!obj_number(word, &out[*n]))
            return fail(r->f, "bad number '%.20s' (line %d)", word, r->text.line);
        ++*n;
    }
    return *n >= least || fail(r->f, "%s needs %d numbers (line %d)", keyword, least, r->text.line);
}

static bool has_nan(const float *number, int n)
{
    for (int i = 0; i < n; i++) {
        if (isnan(number[i]))
            return true;
    }
    return false;
}

/* v x y z, with a weight of no meaning here, or with r g b [a]. */
static bool read_position(struct reader *r, char *rest)
{
    float number[7];
    int n;
    if (!read_numbers(r, "v", rest, 3, 7, number, &n))
        return false;
    float *v = add_floats(r, &r->v), *color = v == NULL ? NULL : add_floats(r, &r->color);
    if (color == NULL)
        return false;
    memcpy(v, number, 3 * sizeof *v);
    if (has_nan(number, 3)) {
        v[0] = NAN;
        r->fault.vertices++;
    }
    for (int i = 0; i < 3; i++)
        color[i] = n >= 6 && !isnan(number[3 + i]) ? number[3 + i] : 1;
    color[3] = n == 7 && !isnan(number[6]) ? number[6] : 1;
    r->has_color = r->has_color || n >= 6;
    return true;
}

static bool read_uv(struct reader *r, char *rest)
{
    float number[2] = { 0, 0 };
    int n;
    if (!read_numbers(r, "vt", rest, 1, 2, number, &n))
        return false;
    if (has_nan(number, 2)) {
        number[0] = number[1] = 0;
        r->fault.uvs++;
    }
    float *uv = add_floats(r, &r->vt);
    if (uv != NULL)
        memcpy(uv, number, sizeof number);
    return uv != NULL;
}

static bool read_normal(struct reader *r, char *rest)
{
    float number[3];
    int n;
    if (!read_numbers(r, "vn", rest, 3, 3, number, &n))
        return false;
    if (has_nan(number, 3)) {
        number[0] = NAN;
        r->fault.normals++;
    }
    float *normal = add_floats(r, &r->vn);
    if (normal != NULL)
        memcpy(normal, number, sizeof number);
    return normal != NULL;
}

/* A reference at *text: from 1, or from -1 backwards; *out counts from 0 and stays -1 when the
 * field is empty. Moves *text to the '/' or the end. */
static bool read_reference(struct reader *r, const char **text, int count, int *out)
{
    const char *p = *text;
    bool back = *p == '-';
    int64_t value = 0;
    *out = -1;
    if (*p == '-' || *p == '+')
        p++;
    const char *digits = p;
    for (; *p >= '0' && *p <= '9'; p++)
        value = value > INT_MAX ? value : value * 10 + (*p - '0');
    if ((*p != '\0' && *p != '/') || (p == digits && p != *text))
        return fail(r->f, "bad face '%.20s' (line %d)", *text, r->text.line);
    if (p == digits)
        return true;
    int64_t index = back ? count - value : value - 1;
    if (index < 0 || index >= count)
        return fail(r->f, "face refers to %s%lld of %d (line %d)", back ? "-" : "",
                    (long long)value, count, r->text.line);
    *out = (int)index;
    *text = p;
    return true;
}

/* v, v/vt, v//vn or v/vt/vn, and more behind a further slash, which other programs know. */
static bool read_corner(struct reader *r, const char *word, struct corner *out)
{
    const char *at = word;
    *out = (struct corner){ -1, -1, -1 };
    if (!read_reference(r, &at, r->v.count, &out->v))
        return false;
    if (*at == '/') {
        at++;
        if (!read_reference(r, &at, r->vt.count, &out->vt))
            return false;
    }
    if (*at == '/') {
        at++;
        if (!read_reference(r, &at, r->vn.count, &out->vn))
            return false;
        if (out->vn >= 0 && isnan(r->vn.value[3 * (size_t)out->vn]))
            out->vn = NO_NUMBER;
    }
    if (out->v < 0)
        return fail(r->f, "bad face '%.20s' (line %d)", word, r->text.line);
    return true;
}

/* The node for the object and group in force; -1 when out of memory. An object comes before its
 * groups, so that parents come before children. */
static int current_node(struct reader *r)
{
    const int object[3] = { r->object, 0, 0 }, group[3] = { r->object, r->group, 0 };
    if (r->object != 0 && r->group != 0 && triple_intern(&r->nodes, object) < 0)
        return -1;
    return triple_intern(&r->nodes, group);
}

static bool add_triangle(struct reader *r, const struct corner *a, const struct corner *b,
                         const struct corner *c, int part)
{
    void *corner = r->corner, *parts = r->part;
    int capacity = r->triangle_capacity;
    if (!grow(r, &parts, &capacity, r->triangle_count, 1, sizeof *r->part))
        return false;
    r->part = parts;
    capacity = r->triangle_capacity;
    if (!grow(r, &corner, &capacity, r->triangle_count, 1, 3 * sizeof *r->corner))
        return false;
    r->corner = corner;
    r->triangle_capacity = capacity;
    struct corner *to = r->corner + 3 * (size_t)r->triangle_count;
    to[0] = *a;
    to[1] = *b;
    to[2] = *c;
    r->part[r->triangle_count++] = part;
    return true;
}

/* Corners keep what all of them have; returns the form. A normal that is no number is none: the face is then flat. */
static int even_out(struct reader *r, int n)
{
    int uvs = 0, normals = 0, given = 0;
    for (int i = 0; i < n; i++) {
        uvs += r->polygon[i].vt >= 0;
        normals += r->polygon[i].vn >= 0;
        given += r->polygon[i].vn != -1;
    }
    r->fault.uneven_faces += uvs % n != 0 || given % n != 0;
    for (int i = 0; i < n; i++) {
        r->polygon[i].vt = uvs == n ? r->polygon[i].vt : -1;
        r->polygon[i].vn = normals == n ? r->polygon[i].vn : -1;
    }
    return (uvs == n ? HAS_UV : 0) | (normals == n ? HAS_NORMAL : 0);
}

/* Reads the corners of a face into r->polygon. */
static bool read_corners(struct reader *r, char *rest, int *n, bool *is_whole)
{
    char *word;
    *n = 0;
    *is_whole = true;
    while ((word = obj_word(&rest)) != NULL) {
        void *polygon = r->polygon;
        if (!grow(r, &polygon, &r->polygon_capacity, *n, 1, sizeof *r->polygon))
            return false;
        r->polygon = polygon;
        struct corner *c = &r->polygon[(*n)++];
        if (!read_corner(r, word, c))
            return false;
        *is_whole = *is_whole && !isnan(r->v.value[3 * (size_t)c->v]);
    }
    return true;
}

static bool read_face(struct reader *r, char *rest)
{
    int n;
    bool is_whole;
    if (!read_corners(r, rest, &n, &is_whole))
        return false;
    if (n < 3 || !is_whole) {
        *(n < 3 ? &r->fault.short_faces : &r->fault.broken_faces) += 1;
        return true;
    }
    int form = even_out(r, n), node = current_node(r);
    const int key[3] = { node, r->material, form };
    int part = node < 0 ? -1 : triple_intern(&r->parts, key);
    if (part < 0)
        return fail(r->f, "out of memory (line %d)", r->text.line);
    for (int i = 1; i + 1 < n; i++) {
        if (!add_triangle(r, &r->polygon[0], &r->polygon[i], &r->polygon[i + 1], part))
            return false;
    }
    return true;
}

/* Of several things that are missing, the first is told. */
static void warn(struct reader *r, const char *text)
{
    if (r->missing++ == 0)
        model_warn(r->model, "%s", text);
}

/* Reads one .mtl file; *found tells whether it is there. */
static bool read_library(struct reader *r, const char *name, struct failure *why, bool *found)
{
    uint8_t *bytes;
    size_t size;
    *found = external_read(r->files, name, &bytes, &size, why);
    if (!*found)
        return true;
    struct failure inner = { 0 };
    bool ok = size == 0 || mtl_parse(bytes, size, &r->library, r->model, &inner);
    free(bytes);
    return ok || fail(r->f, "%.80s: %s", name, inner.text);
}

/* The rest of the line is one name, or several without blanks in them. */
static bool read_libraries(struct reader *r, char *rest)
{
    struct failure why = { 0 };
    bool found;
    for (char *p = rest; *p != '\0'; p++)
        *p = *p == '\\' ? '/' : *p;
    if (!read_library(r, rest, &why, &found))
        return false;
    if (found)
        return true;
    bool several = strpbrk(rest, " \t") != NULL;
    char *word;
    while (several && (word = obj_word(&rest)) != NULL) {
        why = (struct failure){ 0 };
        if (!read_library(r, word, &why, &found))
            return false;
        if (!found)
            warn(r, why.text);
    }
    if (!several)
        warn(r, why.text);
    return true;
}

static bool use_material(struct reader *r, const char *name)
{
    int known = r->library.names.count;
    r->material = mtl_find(&r->library, r->model, name);
    if (r->material >= known && r->files->folder != NULL) {
        char text[120];
        snprintf(text, sizeof text, "material %.60s is not defined (line %d)", name, r->text.line);
        warn(r, text);
    }
    return r->material >= 0 || fail(r->f, "out of memory (a material)");
}

static bool name_in_force(struct reader *r, const char *name, int *out)
{
    *out = text_intern(&r->names, name);
    return *out >= 0 || fail(r->f, "out of memory (a name)");
}

static bool read_statement(struct reader *r, const char *word, char *rest)
{
    static const char *const freeform[] = { "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",
                                            "hole", "scrv", "sp", "end", "con" };
    if (strcmp(word, "v") == 0)
        return read_position(r, rest);
    if (strcmp(word, "vt") == 0)
        return read_uv(r, rest);
    if (strcmp(word, "vn") == 0)
        return read_normal(r, rest);
    if (strcmp(word, "f") == 0 || strcmp(word, "fo") == 0)
        return read_face(r, rest);
    if (strcmp(word, "o") == 0)
        return name_in_force(r, "", &r->group) && name_in_force(r, rest, &r->object);
    if (strcmp(word, "g") == 0)
        return name_in_force(r, rest, &r->group);
    if (strcmp(word, "usemtl") == 0)
        return use_material(r, rest);
    if (strcmp(word, "mtllib") == 0)
        return read_libraries(r, rest);
    r->model->skipped_primitives += strcmp(word, "p") == 0 || strcmp(word, "l") == 0;
    for (size_t i = 0; i < sizeof freeform / sizeof freeform[0]; i++)
        r->fault.freeform += strcmp(word, freeform[i]) == 0;
    return true;
}

/* --- from triangles to primitives --- */

static float *float_array(struct reader *r, int count, int width)
{
    float *array = malloc((size_t)count * (size_t)width * sizeof *array);
    if (array == NULL)
        fail(r->f, "out of memory (%d vertices)", count);
    return array;
}

static bool copy_attribute(struct reader *r, const struct triple_table *vertices, int field,
                           const struct floats *from, float **out)
{
    *out = float_array(r, vertices->count, from->width);
    if (*out == NULL)
        return false;
    size_t width = (size_t)from->width;
    for (int i = 0; i < vertices->count; i++)
        memcpy(*out + (size_t)i * width, from->value + (size_t)vertices->key[i][field] * width,
               width * sizeof **out);
    return true;
}

/* The material's scale and offset, then v from up to down. A textured part whose faces give no
 * texture coordinates has them all at the origin. */
static bool set_uv(struct reader *r, const struct triple_table *vertices, int form,
                   struct model_primitive *out)
{
    const struct mtl_material *m = &r->library.material[out->material];
    if ((form & HAS_UV) != 0) {
        if (!copy_attribute(r, vertices, 1, &r->vt, &out->uv))
            return false;
    } else if (m->map != NULL) {
        out->uv = calloc((size_t)vertices->count * 2, sizeof *out->uv);
        if (out->uv == NULL)
            return fail(r->f, "out of memory (%d vertices)", vertices->count);
    } else {
        return true;
    }
    for (int i = 0; i < vertices->count; i++) {
        float *uv = out->uv + 2 * (size_t)i;
        double u = (double)uv[0] * (double)m->scale[0] + (double)m->offset[0];
        double v = 1 - ((double)uv[1] * (double)m->scale[1] + (double)m->offset[1]);
        if (!(u >= -1e30 && u <= 1e30 && v >= -1e30 && v <= 1e30))
            return fail(r->f, "texture coordinates are out of range");
        uv[0] = (float)u;
        uv[1] = (float)v;
    }
    return true;
}

/* Triangles list[0..n) of this part. */
static bool build_primitive(struct reader *r, int part, const int *list, int n,
                            struct model_primitive *out)
{
    struct triple_table vertices = { 0 };
    int form = r->parts.key[part][2];
    out->material = r->parts.key[part][1];
    out->triangle_count = n;
    out->index = malloc((size_t)n * 3 * sizeof *out->index);
    bool ok = out->index != NULL || fail(r->f, "out of memory (%d triangles)", n);
    for (int i = 0; ok && i < 3 * n; i++) {
        const struct corner *c = &r->corner[3 * (size_t)list[i / 3] + (size_t)(i % 3)];
        const int key[3] = { c->v, c->vt, c->vn };
        int vertex = triple_intern(&vertices, key);
        ok = vertex >= 0 || fail(r->f, "out of memory (%d triangles)", n);
        out->index[i] = (uint32_t)vertex;
    }
    out->vertex_count = vertices.count;
    ok = ok && copy_attribute(r, &vertices, 0, &r->v, &out->position) &&
         ((form & HAS_NORMAL) == 0 || copy_attribute(r, &vertices, 2, &r->vn, &out->normal)) &&
         (!r->has_color || copy_attribute(r, &vertices, 0, &r->color, &out->color)) &&
         set_uv(r, &vertices, form, out);
    triple_table_free(&vertices);
    return ok;
}

/* Faces without a material get one that nothing else can name. */
static bool settle_materials(struct reader *r)
{
    int plain = -1;
    for (int i = 0; i < r->parts.count; i++) {
        if (r->parts.key[i][1] >= 0)
            continue;
        if (plain < 0)
            plain = mtl_find(&r->library, r->model, "");
        if (plain < 0)
            return fail(r->f, "out of memory (a material)");
        r->parts.key[i][1] = plain;
    }
    return true;
}

/* order[first[p] .. first[p + 1]) are the triangles of part p, in file order. */
static bool sort_by_part(struct reader *r, int **order, int **first)
{
    *order = malloc((size_t)r->triangle_count * sizeof **order);
    *first = calloc((size_t)r->parts.count + 2, sizeof **first);
    if (*order == NULL || *first == NULL)
        return fail(r->f, "out of memory (%d triangles)", r->triangle_count);
    int *begin = *first + 1;            /* ends up shifted into place */
    for (int i = 0; i < r->triangle_count; i++)
        begin[r->part[i] + 1]++;
    for (int p = 0; p < r->parts.count; p++)
        begin[p + 1] += begin[p];
    for (int i = 0; i < r->triangle_count; i++)
        (*order)[begin[r->part[i]]++] = i;
    return true;
}

static bool copy_name(struct reader *r, const char *name, char **out)
{
    size_t size = strlen(name) + 1;
    *out = malloc(size);
    if (*out == NULL)
        return fail(r->f, "out of memory (a name)");
    memcpy(*out, name, size);
    return true;
}

static bool make_node(struct reader *r, int index)
{
    struct model_node *node = &r->model->node[index];
    int object = r->nodes.key[index][0], group = r->nodes.key[index][1];
    const int parent[3] = { object, 0, 0 };
    *node = (struct model_node){ .parent = -1, .rotation = { 0, 0, 0, 1 }, .scale = { 1, 1, 1 },
                                 .mesh = index, .skin = -1, .camera = -1 };
    for (int i = 0; i < 16; i += 5)
        node->matrix[i] = 1;
    if (object != 0 && group != 0)
        node->parent = triple_intern(&r->nodes, parent);
    r->model->order[index] = index;
    r->model->in_scene[index] = true;
    const char *name = r->names.text[group != 0 ? group : object];
    return copy_name(r, name, &node->name) && copy_name(r, name, &r->model->mesh[index].name);
}

/* Every node has the mesh of its own number, if only an empty one. */
static bool make_nodes(struct reader *r)
{
    struct model *model = r->model;
    size_t n = (size_t)r->nodes.count;
    model->node = calloc(n, sizeof *model->node);
    model->mesh = calloc(n, sizeof *model->mesh);
    model->order = calloc(n, sizeof *model->order);
    model->in_scene = calloc(n, sizeof *model->in_scene);
    if (model->node == NULL || model->mesh == NULL || model->order == NULL ||
        model->in_scene == NULL)
        return fail(r->f, "out of memory (%d groups)", r->nodes.count);
    model->node_count = model->mesh_count = r->nodes.count;
    for (int i = 0; i < r->nodes.count; i++) {
        if (!make_node(r, i))
            return false;
    }
    int *part_count = calloc(n, sizeof *part_count);
    if (part_count == NULL)
        return fail(r->f, "out of memory (%d groups)", r->nodes.count);
    for (int i = 0; i < r->parts.count; i++)
        part_count[r->parts.key[i][0]]++;
    bool ok = true;
    for (size_t i = 0; i < n && ok; i++) {
        if (part_count[i] == 0)
            model->node[i].mesh = -1;
        struct model_primitive **primitive = &model->mesh[i].primitive;
        *primitive = calloc(part_count[i] == 0 ? 1 : (size_t)part_count[i], sizeof **primitive);
        ok = *primitive != NULL || fail(r->f, "out of memory (a group)");
    }
    free(part_count);
    return ok;
}

static bool build_model(struct reader *r)
{
    int *order = NULL, *first = NULL;
    if (r->triangle_count == 0 && r->fault.short_faces + r->fault.broken_faces > 0)
        return fail(r->f, "holds no face of three corners that are numbers");
    if (r->triangle_count == 0 && r->fault.freeform > 0)
        return fail(r->f, "holds no faces, only free-form curves and surfaces");
    if (r->triangle_count == 0)
        return fail(r->f, "holds no faces (if it is an OBJ file at all)");
    bool ok = settle_materials(r) && make_nodes(r) && sort_by_part(r, &order, &first);
    for (int p = 0; ok && p < r->parts.count; p++) {
        struct model_mesh *mesh = &r->model->mesh[r->parts.key[p][0]];
        ok = build_primitive(r, p, order + first[p], first[p + 1] - first[p],
                             &mesh->primitive[mesh->primitive_count++]);
    }
    free(order);
    free(first);
    return ok;
}

/* --- pictures --- */

/* Materials that name the same file share its picture. A file that is not there leaves the material
 * without, one that cannot be read is an error. */
static bool load_picture(struct reader *r, const char *name, struct text_table *names,
                         int *image_of_name, int *out)
{
    struct failure why = { 0 };
    uint8_t *bytes;
    size_t size;
    int known = names->count, number = text_intern(names, name);
    if (number < 0)
        return fail(r->f, "out of memory (a name)");
    if (number < known) {
        *out = image_of_name[number];
        return true;
    }
    image_of_name[number] = *out = -1;
    if (!external_read(r->files, name, &bytes, &size, &why)) {
        warn(r, why.text);
        return true;
    }
    bool ok = picture_decode(bytes, size, &r->model->image[r->model->image_count], &why);
    free(bytes);
    if (!ok)
        return fail(r->f, "%.80s: %s", name, why.text);
    image_of_name[number] = *out = r->model->image_count++;
    return true;
}

static bool load_pictures(struct reader *r)
{
    struct model *model = r->model;
    struct text_table names = { 0 };
    size_t n = (size_t)model->material_count;
    int *image_of_name = calloc(n, sizeof *image_of_name);
    model->image = calloc(n, sizeof *model->image);
    bool ok = (image_of_name != NULL && model->image != NULL) ||
              fail(r->f, "out of memory (%d materials)", model->material_count);
    for (int p = 0; ok && p < r->parts.count; p++)
        r->library.material[r->parts.key[p][1]].is_drawn = true;
    for (int i = 0; ok && i < model->material_count; i++) {
        if (r->library.material[i].is_drawn && r->library.material[i].map != NULL)
            ok = load_picture(r, r->library.material[i].map, &names, image_of_name,
                              &model->material[i].image);
    }
    free(image_of_name);
    text_table_free(&names);
    return ok;
}

/* --- what became of it --- */

static void tell(struct reader *r, int count, const char *one, const char *several)
{
    if (count > 0)
        model_warn(r->model, "%d %s", count, count == 1 ? one : several);
}

static void tell_faults(struct reader *r)
{
    if (r->missing > 1)
        model_warn(r->model, "%d more that are named are missing", r->missing - 1);
    tell(r, r->fault.vertices, "vertex is no number", "vertices are no numbers");
    tell(r, r->fault.broken_faces, "face with such a corner is left out", "faces with such corners are left out");
    tell(r, r->fault.short_faces, "face of fewer than three corners is left out",
         "faces of fewer than three corners are left out");
    tell(r, r->fault.normals, "normal is no number: faces with it are flat", "normals are no numbers: faces with them are flat");
    tell(r, r->fault.uvs, "texture coordinate is no number: taken for 0", "texture coordinates are no numbers: taken for 0");
    tell(r, r->fault.uneven_faces, "face has texture coordinates or normals at some corners only: drawn without",
         "faces have texture coordinates or normals at some corners only: drawn without");
    tell(r, r->fault.freeform, "statement of free-form curves and surfaces is left out",
         "statements of free-form curves and surfaces are left out");
}

bool obj_parse(const uint8_t *bytes, size_t size, struct external *files, struct model *model, struct failure *f)
{
    struct reader r = { .files = files, .model = model, .f = f, .material = -1,
                        .v.width = 3, .vt.width = 2, .vn.width = 3, .color.width = 4 };
    char *word, *rest;
    bool ok = obj_text_open(bytes, size, &r.text, f) && name_in_force(&r, "", &r.object);
    while (ok && obj_text_next(&r.text, &word, &rest))
        ok = read_statement(&r, word, rest);
    ok = ok && build_model(&r) && load_pictures(&r);
    mtl_settle(&r.library, model);
    tell_faults(&r);
    obj_text_close(&r.text);
    free(r.v.value);
    free(r.vt.value);
    free(r.vn.value);
    free(r.color.value);
    free(r.polygon);
    free(r.corner);
    free(r.part);
    text_table_free(&r.names);
    triple_table_free(&r.nodes);
    triple_table_free(&r.parts);
    mtl_library_free(&r.library);
    return ok;
}
