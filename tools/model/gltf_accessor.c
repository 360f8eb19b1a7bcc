/* SPDX-License-Identifier: MIT */
/* gltf_accessor.c - typed arrays over buffer views: strided, normalised, sparse. Every accessor
 * of the file is checked against the real bytes before anything is decoded, so that reading
 * cannot fail for its extent. Little-endian bytes are put together one by one: any host, any
 * alignment. */
#include "tools/model/gltf.h"

#include <math.h>
#include <string.h>

static const struct { const char *name; enum gltf_shape shape; int rows, columns; } shapes[] = {
    { "SCALAR", GLTF_SCALAR, 1, 1 }, { "VEC2", GLTF_VEC2, 2, 1 }, { "VEC3", GLTF_VEC3, 3, 1 },
    { "VEC4", GLTF_VEC4, 4, 1 }, { "MAT2", GLTF_MAT2, 2, 2 }, { "MAT3", GLTF_MAT3, 3, 3 },
    { "MAT4", GLTF_MAT4, 4, 4 }
};

static int component_size(enum gltf_component c)
{
    return c == GLTF_I8 || c == GLTF_U8 ? 1 : c == GLTF_I16 || c == GLTF_U16 ? 2 : 4;
}

static int shape_index(enum gltf_shape shape)
{
    int i = 0;
    while (shapes[i].shape != shape)
        i++;
    return i;
}

/* Columns of a matrix start at multiples of 4 bytes. */
static int column_size(const struct gltf_accessor *a)
{
    int s = shape_index(a->shape);
    int size = shapes[s].rows * component_size(a->component);
    return shapes[s].columns > 1 ? (size + 3) / 4 * 4 : size;
}

static int element_size(const struct gltf_accessor *a)
{
    return column_size(a) * shapes[shape_index(a->shape)].columns;
}

static double read_component(const uint8_t *p, enum gltf_component c)
{
    uint32_t word;
    float number;
    switch (c) {
    case GLTF_I8:
        return p[0] < 128 ? p[0] : p[0] - 256;
    case GLTF_U8:
        return p[0];
    case GLTF_U16:
        return p[0] | p[1] << 8;
    case GLTF_I16:
        return (p[0] | p[1] << 8) - (p[1] < 128 ? 0 : 65536);
    default:
        word = (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
        if (c == GLTF_U32)
            return word;
        memcpy(&number, &word, sizeof number);
        return (double)number;
    }
}

/* glTF 2.0, 3.6.2.2: signed values map to [-1, 1], both -128 and -127 to -1. */
static double normalized(double value, enum gltf_component c)
{
    switch (c) {
    case GLTF_I8:
        return fmax(value / 127, -1);
    case GLTF_U8:
        return value / 255;
    case GLTF_I16:
        return fmax(value / 32767, -1);
    case GLTF_U16:
        return value / 65535;
    default:
        return value;
    }
}

static bool read_component_type(struct gltf *g, int object, const char *key, bool index_only,
                                enum gltf_component *out)
{
    int64_t type = 0;
    if (!json_get_integer(&g->json, object, key, 0, INT32_MAX, &type, g->f))
        return false;
    bool unsigned_type = type == GLTF_U8 || type == GLTF_U16 || type == GLTF_U32;
    if (!unsigned_type &&
        (index_only || (type != GLTF_I8 && type != GLTF_I16 && type != GLTF_F32)))
        return json_fail(&g->json, object, key, g->f, "%d is no component type for this",
                         (int)type);
    *out = (enum gltf_component)type;
    return true;
}

/* Points *bytes at `count` elements of `size` bytes every `stride` bytes, or fails. */
static bool slice(struct gltf *g, int object, int view, int64_t offset, size_t size, size_t stride,
                  int count, const uint8_t **bytes)
{
    const struct gltf_view *v = &g->view[view];
    if (!gltf_has_bytes(g, view, object))
        return false;
    if ((uint64_t)offset > v->size || v->size - (size_t)offset < size ||
        (v->size - (size_t)offset - size) / stride < (size_t)count - 1)
        return json_fail(&g->json, object, "byteOffset", g->f,
                         "%d elements reach past buffer view %d of %zu bytes", count, view,
                         v->size);
    *bytes = v->bytes + offset;
    return true;
}

static bool read_sparse(struct gltf *g, int accessor_object, struct gltf_accessor *a)
{
    int sparse, indices, values, index_view = -1, value_view = -1;
    int64_t count = 0, index_offset = 0, value_offset = 0;
    if (!json_get_object(&g->json, accessor_object, "sparse", &sparse, g->f))
        return false;
    if (sparse < 0)
        return true;
    if (!json_get_integer(&g->json, sparse, "count", 1, a->count, &count, g->f) ||
        !json_get_object(&g->json, sparse, "indices", &indices, g->f) ||
        !json_get_object(&g->json, sparse, "values", &values, g->f) ||
        !json_get_index(&g->json, indices, "bufferView", g->view_count, "buffer view", &index_view,
                        g->f) ||
        !json_get_index(&g->json, values, "bufferView", g->view_count, "buffer view", &value_view,
                        g->f) ||
        !json_get_integer(&g->json, indices, "byteOffset", 0, INT32_MAX, &index_offset, g->f) ||
        !json_get_integer(&g->json, values, "byteOffset", 0, INT32_MAX, &value_offset, g->f))
        return false;
    if (count == 0 || index_view < 0 || value_view < 0)
        return json_fail(&g->json, sparse, NULL, g->f, "count, indices or values are missing");
    if (!read_component_type(g, indices, "componentType", true, &a->sparse_component))
        return false;
    size_t index_size = (size_t)component_size(a->sparse_component);
    size_t value_size = (size_t)element_size(a);
    if (!slice(g, indices, index_view, index_offset, index_size, index_size, (int)count,
               &a->sparse_index) ||
        !slice(g, values, value_view, value_offset, value_size, value_size, (int)count,
                  &a->sparse_value))
        return false;
    double last = -1;
    for (int i = 0; i < (int)count; i++) {
        double index = read_component(a->sparse_index + (size_t)i * index_size,
                                      a->sparse_component);
        if (index <= last || index >= a->count)
            return json_fail(&g->json, indices, NULL, g->f, "sparse index %.0f is out of order or "
                             "not below %d", index, a->count);
        last = index;
    }
    a->sparse_count = (int)count;
    return true;
}

static bool read_accessor(struct gltf *g, int index, int object)
{
    struct gltf_accessor *a = &g->accessor[index];
    int view = -1;
    int64_t offset = 0, count = 0;
    const char *type = "";
    if (!json_get_index(&g->json, object, "bufferView", g->view_count, "buffer view", &view,
                        g->f) ||
        !json_get_integer(&g->json, object, "byteOffset", 0, (int64_t)1 << 53, &offset, g->f) ||
        !json_get_integer(&g->json, object, "count", 1, INT32_MAX, &count, g->f) ||
        !json_get_bool(&g->json, object, "normalized", &a->normalized, g->f) ||
        !json_get_string(&g->json, object, "type", &type, g->f) ||
        !read_component_type(g, object, "componentType", false, &a->component))
        return false;
    if (count == 0)
        return json_fail(&g->json, object, NULL, g->f, "no count");
    size_t s = 0;
    while (s < sizeof shapes / sizeof shapes[0] && strcmp(type, shapes[s].name) != 0)
        s++;
    if (s == sizeof shapes / sizeof shapes[0])
        return json_fail(&g->json, object, "type", g->f, "'%.20s' is no accessor type", type);
    a->shape = shapes[s].shape;
    a->width = shapes[s].rows * shapes[s].columns;
    a->count = (int)count;
    if (view >= 0) {
        size_t size = (size_t)element_size(a);
        a->stride = g->view[view].stride == 0 ? size : g->view[view].stride;
        if (a->stride < size)
            return json_fail(&g->json, object, NULL, g->f,
                             "elements of %zu bytes overlap at a stride of %zu", size, a->stride);
        if (!slice(g, object, view, offset, size, a->stride, a->count, &a->bytes))
            return false;
    } else if ((size_t)a->count > g->source_bytes) {
        /* Zeros take no bytes in the file, but a mesh made of nothing else is of no use. */
        return json_fail(&g->json, object, "count", g->f, "%d zero elements in a file of %zu bytes",
                         a->count, g->source_bytes);
    }
    return read_sparse(g, object, a);
}

bool gltf_read_accessors(struct gltf *g)
{
    int array, count, index = 0;
    if (!gltf_list(g, 0, "accessors", &array, &count))
        return false;
    g->accessor = gltf_alloc(g, (size_t)count, sizeof *g->accessor);
    if (g->accessor == NULL)
        return false;
    g->accessor_count = count;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        if (!read_accessor(g, index++, i))
            return false;
    }
    return true;
}

bool gltf_get_accessor(struct gltf *g, int object, const char *key, int *out)
{
    *out = -1;
    return json_get_index(&g->json, object, key, g->accessor_count, "accessor", out, g->f);
}

bool gltf_expect(struct gltf *g, int accessor, enum gltf_shape shape, int components, int count,
                 int object, const char *key)
{
    const struct gltf_accessor *a = &g->accessor[accessor];
    bool is_unsigned = a->component == GLTF_U8 || a->component == GLTF_U16;
    bool is_small = component_size(a->component) < 4;
    bool ok = ((components & GLTF_FLOAT) != 0 && a->component == GLTF_F32) ||
              ((components & GLTF_WORD) != 0 && a->component == GLTF_U32) ||
              ((components & GLTF_UNSIGNED) != 0 && is_unsigned) ||
              ((components & GLTF_BYTE_OR_SHORT) != 0 && is_small);
    if (a->shape != shape)
        return json_fail(&g->json, object, key, g->f, "accessor %d is %s, not %s", accessor,
                         shapes[shape_index(a->shape)].name, shapes[shape_index(shape)].name);
    if (!ok)
        return json_fail(&g->json, object, key, g->f,
                         "accessor %d has component type %d, which is not for this", accessor,
                         (int)a->component);
    if (count >= 0 && a->count != count)
        return json_fail(&g->json, object, key, g->f, "accessor %d has %d elements, not %d",
                         accessor, a->count, count);
    return true;
}

static void read_element(const struct gltf_accessor *a, const uint8_t *bytes, bool normalize,
                         float *out)
{
    int s = shape_index(a->shape), rows = shapes[s].rows, size = component_size(a->component);
    int column_bytes = column_size(a);
    for (int k = 0; k < a->width; k++) {
        double value = read_component(bytes + k / rows * column_bytes + k % rows * size,
                                      a->component);
        out[k] = (float)(normalize ? normalized(value, a->component) : value);
    }
}

static uint32_t sparse_index(const struct gltf_accessor *a, int i)
{
    return (uint32_t)read_component(a->sparse_index + i * component_size(a->sparse_component),
                                    a->sparse_component);
}

bool gltf_floats(struct gltf *g, int accessor, const uint32_t *rows, int n, bool normalize,
                 float *out, int object, const char *key)
{
    const struct gltf_accessor *a = &g->accessor[accessor];
    normalize = normalize || a->normalized;
    int sparse = 0;
    for (int i = 0; i < n; i++) {
        uint32_t row = rows == NULL ? (uint32_t)i : rows[i];
        float *element = out + (size_t)i * (size_t)a->width;
        while (sparse < a->sparse_count && sparse_index(a, sparse) < row)
            sparse++;
        if (sparse < a->sparse_count && sparse_index(a, sparse) == row)
            read_element(a, a->sparse_value + (size_t)sparse * (size_t)element_size(a), normalize,
                         element);
        else if (a->bytes != NULL)
            read_element(a, a->bytes + row * a->stride, normalize, element);
        else
            memset(element, 0, (size_t)a->width * sizeof *element);
        for (int k = 0; k < a->width; k++) {
            if (!isfinite(element[k]))
                return json_fail(&g->json, object, key, g->f,
                                 "element %u of accessor %d is not finite", (unsigned)row,
                                 accessor);
        }
    }
    return true;
}

void gltf_indices(struct gltf *g, int accessor, uint32_t *out)
{
    const struct gltf_accessor *a = &g->accessor[accessor];
    for (int i = 0; i < a->count; i++)
        out[i] = a->bytes == NULL ? 0 :
                 (uint32_t)read_component(a->bytes + (size_t)i * a->stride, a->component);
    for (int i = 0; i < a->sparse_count; i++)
        out[sparse_index(a, i)] = (uint32_t)read_component(
            a->sparse_value + i * component_size(a->component), a->component);
}
