/* SPDX-License-Identifier: MIT */
/* test_model.c - models: what glTF and OBJ files mean, what is refused and why, and poses against
 * values worked out by hand. Most files are made here, from accessors given as plain numbers; the
 * few that must lie on disk are in tests/fuzz/corpus/model. Models of other programs are
 * looked at by the suite assets. */
#include "tests/host.h"
#include "tests/ref/glb.h"

#include "tools/model/model.h"
#include "tools/model/obj.h"

#include <time.h>

#define PI 3.14159265358979323846
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const char corpus[] = "tests/fuzz/corpus/model/";

/* --- making files --- */

enum { I8 = 5120, U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };

/* A glTF file in the making: its BIN chunk, and the JSON of its views and accessors. */
struct source {
    uint8_t bin[8192];
    size_t size;
    char views[4096], accessors[4096];
    int view_count, accessor_count;
};

static void put(struct source *s, int component, double value)
{
    int64_t whole = component == F32 ? 0 : (int64_t)value;
    uint32_t word = (uint32_t)(uint64_t)whole;
    float number = (float)value;
    bool byte = component == I8 || component == U8, half = component == I16 || component == U16;
    int size = byte ? 1 : half ? 2 : 4;
    if (component == F32)
        memcpy(&word, &number, sizeof word);
    for (int i = 0; i < size && s->size < sizeof s->bin; i++)
        s->bin[s->size++] = (uint8_t)(word >> 8 * i);
}

/* A view of n numbers, from a multiple of 4 on. `extra` is JSON text that begins with a comma. */
static int add_view(struct source *s, int component, const char *extra, const double *values, int n)
{
    while (s->size % 4 != 0)
        s->size++;
    size_t start = s->size;
    for (int i = 0; i < n; i++)
        put(s, component, values[i]);
    append(s->views, sizeof s->views, "%s{'buffer':0,'byteOffset':%zu,'byteLength':%zu%s}",
           s->view_count == 0 ? "" : ",", start, s->size - start, extra);
    return s->view_count++;
}

/* An accessor of whatever view, or none, `extra` speaks of. */
static int add_accessor(struct source *s, int component, const char *type, int count,
                        const char *extra)
{
    append(s->accessors, sizeof s->accessors,
           "%s{'componentType':%d,'type':'%s','count':%d%s}", s->accessor_count == 0 ? "" : ",",
           component, type, count, extra);
    return s->accessor_count++;
}

/* A view and the accessor of all of it. */
static int add(struct source *s, int component, const char *type, int count, const char *extra,
               const double *values, int n)
{
    char text[200];
    snprintf(text, sizeof text, ",'bufferView':%d%s", add_view(s, component, "", values, n), extra);
    return add_accessor(s, component, type, count, text);
}

#define ADD(source, component, type, count, extra, ...) \
    add((source), (component), (type), (count), (extra), (const double[]){ __VA_ARGS__ }, \
        (int)COUNT(((const double[]){ __VA_ARGS__ })))

/* The GLB of the source and of `body`, the rest of the JSON, in a block of exactly its size. Single
 * quotes stand for double ones. */
static uint8_t *make_glb(const struct source *s, const char *body, size_t *size)
{
    static char text[32768];
    text[0] = '\0';
    append(text, sizeof text, "{'asset':{'version':'2.0'},");
    if (s->size > 0)
        append(text, sizeof text, "'buffers':[{'byteLength':%zu}],'bufferViews':[%s],", s->size,
               s->views);
    if (s->accessor_count > 0)
        append(text, sizeof text, "'accessors':[%s],", s->accessors);
    append(text, sizeof text, "%s}", body);
    return glb_make(text, s->bin, s->size, size);
}

static bool load(const struct source *s, const char *body, struct model *m, struct failure *f)
{
    size_t size;
    uint8_t *glb = make_glb(s, body, &size);
    *f = (struct failure){ 0 };
    bool ok = model_parse(glb, size, NULL, m, f);
    free(glb);
    return ok;
}

static bool say_no(const char *text)
{
    test_print("  ");
    test_print(text);
    test_print("\n");
    return false;
}

/* Loads, and shows the reason when that fails. */
static bool loads(const struct source *s, const char *body, struct model *m)
{
    struct failure f;
    if (load(s, body, m, &f))
        return true;
    return say_no(f.text);
}

static bool parses(const char *text, struct model *m)
{
    struct failure f = { 0 };
    if (model_parse((const uint8_t *)text, strlen(text), NULL, m, &f))
        return true;
    return say_no(f.text);
}

/* Every number within slack; prints the first that is not. */
static bool same_floats(const float *got, const double *want, int n, double slack)
{
    for (int i = 0; i < n; i++) {
        double value = (double)got[i];
        if (value >= want[i] - slack && value <= want[i] + slack)
            continue;
        char text[100];
        snprintf(text, sizeof text, "  number %d is %.9g, not %.9g\n", i, value, want[i]);
        test_print(text);
        return false;
    }
    return true;
}

#define SAME_FLOATS(got, slack, ...) \
    same_floats((got), (const double[]){ __VA_ARGS__ }, \
                (int)COUNT(((const double[]){ __VA_ARGS__ })), (slack))

/* A source that begins with accessor 0: the positions of a triangle. */
static struct source triangle(void)
{
    struct source s = { 0 };
    ADD(&s, F32, "VEC3", 3, "", 0, 0, 0, 1, 0, 0, 0, 1, 0);
    return s;
}

#define ONE_NODE "'nodes':[{'mesh':0}],"
#define ONE_MESH "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]"

/* Column `column` of a draw's world matrix. */
static bool world_column(const struct model_pose *pose, int draw, int column, double x, double y,
                         double z)
{
    const double *at = pose->draw[draw].world + 4 * column;
    const float got[3] = { (float)at[0], (float)at[1], (float)at[2] };
    return SAME_FLOATS(got, 1e-6, x, y, z);
}

static bool poses(const struct model *m, int clip, double time, bool looped,
                  struct model_pose *pose)
{
    struct failure f = { 0 };
    if (model_pose(m, clip, time, looped, pose, &f))
        return true;
    return say_no(f.text);
}

/* --- accessors --- */

static void test_every_component_type_is_read_and_normalised(void)
{
    static const struct { int component; double a, b, scale; } types[] = {
        { I8, -128, 127, 127 }, { U8, 0, 255, 255 }, { I16, -32768, 32767, 32767 },
        { U16, 1, 65535, 65535 }
    };
    for (size_t i = 0; i < COUNT(types); i++) {
        struct source s = triangle();
        const double uv[] = { types[i].a, types[i].b, types[i].b, types[i].a, 3, 4 };
        add(&s, types[i].component, "VEC2", 3, ",'normalized':true", uv, 6);
        add(&s, types[i].component, "VEC2", 3, "", uv, 6);
        struct model m OWNED(model_free) = { 0 };
        if (!CHECK(loads(&s, ONE_NODE "'meshes':[{'primitives':["
                         "{'attributes':{'POSITION':0,'TEXCOORD_0':1}},"
                         "{'attributes':{'POSITION':0,'TEXCOORD_0':2}}]}]", &m)))
            continue;
        double low = fmax(types[i].a / types[i].scale, -1), k = types[i].scale;
        CHECK(SAME_FLOATS(m.mesh[0].primitive[0].uv, 1e-7, low, 1, 1, low, 3 / k, 4 / k));
        CHECK(SAME_FLOATS(m.mesh[0].primitive[1].uv, 0, types[i].a, types[i].b, types[i].b,
                          types[i].a, 3, 4));
    }
}

static void test_integer_positions_are_read_for_quantized_meshes(void)
{
    struct source s = { 0 };
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, I16, "VEC3", 3, "", -300, 0, 7, 1000, 2, 3, 0, 32767, -32768);
    ADD(&s, I8, "VEC3", 3, ",'normalized':true", 127, 0, 0, 0, -127, 0, 0, 0, 127);
    REQUIRE(loads(&s, "'extensionsRequired':['KHR_mesh_quantization']," ONE_NODE
                  "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}]", &m));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].position, 0, -300, 0, 7, 1000, 2, 3, 0, 32767,
                      -32768));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].normal, 0, 1, 0, 0, 0, -1, 0, 0, 0, 1));
}

static void test_interleaved_accessors_follow_stride_and_offset(void)
{
    struct source s = { 0 };
    struct model m OWNED(model_free) = { 0 };
    const double vertices[] = { 9, 1, 2, 3, 0.5, 0.25, 9, 4, 5, 6, 0.75, 1,
                                9, 7, 8, 10, 0, 2 };
    add_view(&s, F32, ",'byteStride':24", vertices, 18);
    add_accessor(&s, F32, "VEC3", 3, ",'bufferView':0,'byteOffset':4");
    add_accessor(&s, F32, "VEC2", 3, ",'bufferView':0,'byteOffset':16");
    REQUIRE(loads(&s, ONE_NODE "'meshes':[{'primitives':["
                  "{'attributes':{'POSITION':0,'TEXCOORD_0':1}}]}]", &m));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].position, 0, 1, 2, 3, 4, 5, 6, 7, 8, 10));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].uv, 0, 0.5, 0.25, 0.75, 1, 0, 2));
}

static void test_sparse_accessors_replace_elements_of_a_view_or_of_zeros(void)
{
    static const int index_types[] = { U8, U16, U32 };
    for (size_t i = 0; i < COUNT(index_types); i++) {
        struct source s = triangle();
        struct model m OWNED(model_free) = { 0 };
        char extra[300];
        int indices = add_view(&s, index_types[i], "", (const double[]){ 0, 2 }, 2);
        int values = add_view(&s, F32, "", (const double[]){ 5, 6, 7, -1, -2, -3 }, 6);
        snprintf(extra, sizeof extra, ",'bufferView':0,'sparse':{'count':2,'indices':"
                 "{'bufferView':%d,'componentType':%d},'values':{'bufferView':%d}}", indices,
                 index_types[i], values);
        int over_view = add_accessor(&s, F32, "VEC3", 3, extra);
        int over_zeros = add_accessor(&s, F32, "VEC3", 3, strchr(extra + 1, ','));
        snprintf(extra, sizeof extra, ONE_NODE "'meshes':[{'primitives':[{'attributes':"
                 "{'POSITION':%d,'NORMAL':%d}}]}]", over_view, over_zeros);
        if (!CHECK(loads(&s, extra, &m)))
            continue;
        CHECK(SAME_FLOATS(m.mesh[0].primitive[0].position, 0, 5, 6, 7, 1, 0, 0, -1, -2, -3));
        CHECK(SAME_FLOATS(m.mesh[0].primitive[0].normal, 0, 5, 6, 7, 0, 0, 0, -1, -2, -3));
    }
}

static void test_sparse_indices_and_dropped_vertices_work_together(void)
{
    /* Six vertices of which 1, 3 and 4 are used; the sparse part replaces 0, 3 and 5. */
    struct source s = { 0 };
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, F32, "VEC3", 6, "", 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5);
    int indices = ADD(&s, U16, "SCALAR", 3, "", 4, 1, 3);
    add_view(&s, U8, "", (const double[]){ 0, 3, 5 }, 3);
    add_view(&s, F32, "", (const double[]){ 10, 10, 10, 13, 13, 13, 15, 15, 15 }, 9);
    add_accessor(&s, F32, "VEC3", 6, ",'bufferView':0,'sparse':{'count':3,'indices':"
                 "{'bufferView':2,'componentType':5121},'values':{'bufferView':3}}");
    CHECK_EQ(indices, 1);
    REQUIRE(loads(&s, ONE_NODE "'meshes':[{'primitives':[{'attributes':{'POSITION':2},"
                  "'indices':1}]}]", &m));
    const struct model_primitive *p = &m.mesh[0].primitive[0];
    CHECK_EQ(p->vertex_count, 3);
    CHECK(SAME_FLOATS(p->position, 0, 1, 1, 1, 13, 13, 13, 4, 4, 4));
    CHECK(p->index[0] == 2 && p->index[1] == 0 && p->index[2] == 1);
}

static void test_indices_may_be_sparse_too(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    /* A list of three zeros whose number 1 becomes 2. */
    add_view(&s, U8, "", (const double[]){ 1, 0 }, 2);
    add_view(&s, U16, "", (const double[]){ 2 }, 1);
    add_accessor(&s, U16, "SCALAR", 3, ",'sparse':{'count':1,'indices':{'bufferView':1,"
                 "'componentType':5121},'values':{'bufferView':2}}");
    REQUIRE(loads(&s, ONE_NODE "'meshes':[{'primitives':[{'attributes':{'POSITION':0},"
                  "'indices':1}]}]", &m));
    const struct model_primitive *p = &m.mesh[0].primitive[0];
    CHECK_EQ(p->vertex_count, 2);
    CHECK(p->index[0] == 0 && p->index[1] == 1 && p->index[2] == 0);
    CHECK(SAME_FLOATS(p->position, 0, 0, 0, 0, 0, 1, 0));
}

static void test_an_accessor_without_a_view_is_zeros(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    add_accessor(&s, F32, "VEC3", 3, "");
    REQUIRE(loads(&s, ONE_NODE "'meshes':[{'primitives':[{'attributes':"
                  "{'POSITION':0,'NORMAL':1}}]}]", &m));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].normal, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
}

/* --- containers --- */

#define TRIANGLE_BASE64 "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
#define EMBEDDED_AT(length, offset, uri) "{\"asset\":{\"version\":\"2.1\"},\"buffers\":[{" \
    "\"byteLength\":" length ",\"uri\":\"" uri "\"}],\"bufferViews\":[{\"buffer\":0," \
    "\"byteOffset\":" offset ",\"byteLength\":36}]," \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}]," \
    "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]}"
#define EMBEDDED(uri) EMBEDDED_AT("36", "0", uri)

static void test_buffers_come_from_data_uris(void)
{
    struct model m;
    struct failure f = { 0 };
    const char *bad = EMBEDDED("data:;base64,AAAA!AAA");
    const char *plain = EMBEDDED("data:application/octet-stream,AAAA");
    if (CHECK(parses("\n \t" EMBEDDED("data:application/octet-stream;base64," TRIANGLE_BASE64),
                     &m))) {
        CHECK(SAME_FLOATS(m.mesh[0].primitive[0].position, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0));
        model_free(&m);
    }
    if (CHECK(parses(EMBEDDED("data:;base64," TRIANGLE_BASE64 "AA=="), &m)))
        model_free(&m);
    if (CHECK(parses(EMBEDDED("data:;base64," TRIANGLE_BASE64 "AA"), &m)))
        model_free(&m);
    /* The last number ends in the last, incomplete group of characters: 37 and 38 bytes. */
    static const char *const incomplete[] = {
        EMBEDDED_AT("37", "1", "data:;base64,AQAAgD8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA0A9JQA=="),
        EMBEDDED_AT("38", "2", "data:;base64,AQIAAIA/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAANAPSUA=")
    };
    for (int i = 0; i < 2; i++) {
        if (!CHECK(parses(incomplete[i], &m)))
            continue;
        CHECK(SAME_FLOATS(m.mesh[0].primitive[0].position, 1e-6, 1, 0, 0, 0, 0, 0, 0, 0, 3.14159));
        model_free(&m);
    }
    CHECK(!model_parse((const uint8_t *)bad, strlen(bad), NULL, &m, &f));
    CHECK(same_text(f.text, "bad base64 (buffers[0].uri)"));
    f = (struct failure){ 0 };
    CHECK(!model_parse((const uint8_t *)plain, strlen(plain), NULL, &m, &f));
    CHECK(same_text(f.text, "a data URI that is not base64 (buffers[0].uri)"));
}

static void test_external_files_are_looked_up_beside_the_model(void)
{
    struct model m;
    struct failure f = { 0 };
    char path[200];
    snprintf(path, sizeof path, "%soutside.gltf", corpus);
    REQUIRE(model_load(path, &m, &f));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].position, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0));
    CHECK_EQ(m.image_count, 1);
    CHECK_EQ(m.image[0].width, 2);
    CHECK_EQ(m.image[0].height, 1);
    CHECK(m.image[0].rgba[0] == 255 && m.image[0].rgba[5] == 128 && m.image[0].rgba[6] == 255);
    CHECK(m.mesh[0].primitive[0].uv != NULL);
    model_free(&m);
    snprintf(path, sizeof path, "%smissing.gltf", corpus);
    CHECK(!model_load(path, &m, &f));
    CHECK(f.text[0] != '\0');
}

static void test_names_that_leave_for_elsewhere_are_refused(void)
{
    static const struct { const char *text, *message; } cases[] = {
        { EMBEDDED("/etc/data.bin"), "/etc/data.bin is no relative path (buffers[0].uri)" },
        { EMBEDDED("%2fetc/data.bin"), "/etc/data.bin is no relative path (buffers[0].uri)" },
        { EMBEDDED("http://host/a"), "http://host/a is no relative path (buffers[0].uri)" },
        { EMBEDDED("file:a"), "file:a is no relative path (buffers[0].uri)" },
        { EMBEDDED("C:/a"), "C:/a is no relative path (buffers[0].uri)" },
        { EMBEDDED("a%00b"), "bad file name (buffers[0].uri)" },
        { EMBEDDED(""), "a file name is empty (buffers[0].uri)" },
        { EMBEDDED("a.bin"),
          "needs the file a.bin, which cannot be looked up from here (buffers[0].uri)" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct model m;
        struct failure f = { 0 };
        CHECK(!model_parse((const uint8_t *)cases[i].text, strlen(cases[i].text), NULL, &m, &f));
        CHECK(same_text(f.text, cases[i].message));
    }
}

static void test_what_is_no_model_is_refused(void)
{
    static const struct { const char *text; size_t size; const char *message; } cases[] = {
        { "", 0, "the file is empty" },
        { "glTF\1\0\0\0\24\0\0\0\0\0\0\0JSON", 20, "GLB version 1, not 2" },
        { "glTF\2\0\0\0\24\0\0\0\0\0\0\0JSON", 20, "text ends too early (line 1, column 1)" },
        { "glTF\2\0\0\0\24\0\0\0\0\0\0\0BIN\0", 20, "the first GLB chunk is not JSON" },
        { "glTF\2\0\0\0\24\0\0\0\1\0\0\0JSON", 20,
          "GLB chunk 0 of 1 bytes reaches past the end" },
        { "glTF\2\0\0\0\14\0\0\0\0\0\0\0JSON", 20, "GLB has no JSON chunk" },
        { "glTF\2\0\0\0\25\0\0\0\0\0\0\0JSON", 20, "GLB is cut off: 20 of 21 bytes" },
        { "glTF", 4, "GLB is cut off in its header" },
        { "{}", 2, "not glTF: no version (asset.version)" },
        { "{\"asset\":{\"version\":\"1.0\"}}", 27, "glTF version 1.0, not 2 (asset.version)" },
        { "{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}", 46,
          "needs glTF version 2.1 (asset.minVersion)" },
        { "\xef\xbb\xbf\n{\"asset\":{\"version\":\"3.0\"}}", 31,
          "glTF version 3.0, not 2 (asset.version)" },
        { "{\"asset\":7}", 11, "expected an object, found a number (asset)" },
        { "SMR1\1\0\0\0", 8, "a converted model, for firmware only: give the file it was made from" },
        { "\x89PNG\r\n\x1a\n\0\0", 10, "neither glTF nor text" },
        { "Dear reader,\n", 13, "holds no faces (if it is an OBJ file at all)" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct model m;
        struct failure f = { 0 };
        CHECK(!model_parse((const uint8_t *)cases[i].text, cases[i].size, NULL, &m, &f));
        CHECK(same_text(f.text, cases[i].message));
        CHECK(m.node == NULL && m.mesh == NULL);
    }
}

static void test_required_extensions_are_known_or_refused_by_name(void)
{
    struct source s = triangle();
    struct model m;
    struct failure f;
    CHECK(!load(&s, "'extensionsRequired':['KHR_texture_transform','KHR_draco_mesh_compression'],"
                ONE_NODE ONE_MESH, &m, &f));
    CHECK(same_text(f.text, "its triangles are packed by KHR_draco_mesh_compression, which is not read; "
                    "`gltf-transform cp IN.glb OUT.glb` unpacks them (extensionsRequired[1])"));
    if (CHECK(loads(&s, "'extensionsUsed':['KHR_draco_mesh_compression'],'extensionsRequired':"
                    "['KHR_materials_unlit','KHR_texture_transform','KHR_mesh_quantization'],"
                    ONE_NODE ONE_MESH, &m)))
        model_free(&m);
}

/* --- meshes --- */

static void test_strips_and_fans_become_triangles_and_lines_are_counted(void)
{
    struct source s = { 0 };
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, F32, "VEC3", 5, "", 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0);
    REQUIRE(loads(&s, ONE_NODE "'meshes':[{'primitives':["
                  "{'attributes':{'POSITION':0},'mode':5},"
                  "{'attributes':{'POSITION':0},'mode':1},"
                  "{'attributes':{'POSITION':0},'mode':6},"
                  "{'attributes':{'POSITION':0},'mode':0},"
                  "{'attributes':{'POSITION':0}},{'attributes':{}}]}]", &m));
    static const uint32_t strip[] = { 0, 1, 2, 1, 3, 2, 2, 3, 4 };
    static const uint32_t fan[] = { 1, 2, 0, 2, 3, 0, 3, 4, 0 };
    CHECK_EQ(m.mesh[0].primitive_count, 3);
    CHECK_EQ(m.skipped_primitives, 3);
    CHECK(same_text(m.warning, "3 primitives hold no triangles and are left out"));
    CHECK_EQ(m.mesh[0].primitive[0].triangle_count, 3);
    CHECK(memcmp(m.mesh[0].primitive[0].index, strip, sizeof strip) == 0);
    CHECK_EQ(m.mesh[0].primitive[1].triangle_count, 3);
    CHECK(memcmp(m.mesh[0].primitive[1].index, fan, sizeof fan) == 0);
    /* Five vertices make one triangle; the two left over are dropped. */
    CHECK_EQ(m.mesh[0].primitive[2].triangle_count, 1);
    CHECK_EQ(m.mesh[0].primitive[2].vertex_count, 3);
}

static void test_colors_are_normalised_and_get_an_alpha(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, U8, "VEC4", 3, ",'normalized':true", 255, 0, 51, 102, 0, 0, 0, 0, 255, 255, 255, 255);
    ADD(&s, U16, "VEC3", 3, ",'normalized':true", 65535, 0, 13107, 0, 0, 0, 1, 2, 3);
    ADD(&s, F32, "VEC3", 3, "", 0.25, 0.5, 0.75, 1, 2, 3, 0, 0, 0);
    REQUIRE(loads(&s, ONE_NODE "'meshes':[{'primitives':["
                  "{'attributes':{'POSITION':0,'COLOR_0':1}},"
                  "{'attributes':{'POSITION':0,'COLOR_0':2}},"
                  "{'attributes':{'POSITION':0,'COLOR_0':3}}]}]", &m));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].color, 1e-7, 1, 0, 0.2, 0.4, 0, 0, 0, 0, 1, 1, 1, 1));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[1].color, 1e-7, 1, 0, 0.2, 1, 0, 0, 0, 1));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[2].color, 0, 0.25, 0.5, 0.75, 1, 1, 2, 3, 1));
}

/* Two pixels: red, and a blue of 0, 128, 255. */
#define PNG_BASE64 "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP4z8DA0PAf" \
    "AAgAAn8lPvwJAAAAAElFTkSuQmCC"
#define PICTURE "'images':[{'uri':'data:image/png;base64," PNG_BASE64 "'}]," \
    "'textures':[{'source':0}],"

static void test_materials_carry_all_that_is_shown(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, F32, "VEC2", 3, "", 0, 0, 1, 0, 0, 1);
    REQUIRE(loads(&s, "'images':[{'uri':'data:image/png;base64," PNG_BASE64 "'}],"
                  "'samplers':[{'wrapS':33071,'wrapT':33648},{'wrapS':10497}],"
                  "'textures':[{'source':0,'sampler':0},{'source':0,'sampler':1}],"
                  "'materials':[{'name':'leaf','alphaMode':'MASK','alphaCutoff':0.25,"
                  "'doubleSided':true,'extensions':{'KHR_materials_unlit':{}},"
                  "'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,0.75],"
                  "'baseColorTexture':{'index':0}}},{'alphaMode':'BLEND',"
                  "'pbrMetallicRoughness':{'baseColorTexture':{'index':1}}},{}]," ONE_NODE
                  "'meshes':[{'primitives':["
                  "{'attributes':{'POSITION':0,'TEXCOORD_0':1},'material':0},"
                  "{'attributes':{'POSITION':0},'material':1},"
                  "{'attributes':{'POSITION':0},'material':2},"
                  "{'attributes':{'POSITION':0}}]}]", &m));
    CHECK_EQ(m.material_count, 4);
    const struct model_material *a = &m.material[0], *b = &m.material[1], *d = &m.material[3];
    CHECK(same_text(a->name, "leaf"));
    CHECK(SAME_FLOATS(a->base, 0, 0.5, 0.25, 1, 0.75));
    CHECK(a->alpha == MODEL_ALPHA_MASK && a->double_sided && a->unlit);
    CHECK_CLOSE((double)a->alpha_cutoff, 0.25, 0);
    CHECK(a->wrap_u == MODEL_WRAP_CLAMP && a->wrap_v == MODEL_WRAP_MIRROR);
    CHECK(b->alpha == MODEL_ALPHA_BLEND && !b->double_sided && !b->unlit);
    CHECK(b->wrap_u == MODEL_WRAP_REPEAT && b->wrap_v == MODEL_WRAP_REPEAT);
    CHECK_EQ(m.image_count, 1);         /* one picture, shared */
    CHECK(a->image == 0 && b->image == 0 && m.material[2].image == -1);
    CHECK_EQ(m.image[0].width, 2);
    CHECK_EQ(m.mesh[0].primitive[3].material, 3);
    CHECK(SAME_FLOATS(d->base, 0, 1, 1, 1, 1));
    CHECK(d->image == -1 && d->alpha == MODEL_ALPHA_OPAQUE && d->name[0] == '\0');
    CHECK_CLOSE((double)d->alpha_cutoff, 0.5, 0);
    /* A textured primitive always has texture coordinates. */
    CHECK(SAME_FLOATS(m.mesh[0].primitive[1].uv, 0, 0, 0, 0, 0, 0, 0));
    CHECK(m.mesh[0].primitive[2].uv == NULL);
}

static void test_texture_transforms_scale_turn_and_shift_in_that_order(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, F32, "VEC2", 3, "", 9, 9, 9, 9, 9, 9);
    ADD(&s, F32, "VEC2", 3, "", 0, 0, 1, 0, 0, 1);
    /* The extension's own example, the lower left quadrant of the picture, turned by a quarter;
     * then each side's scale told apart, without and with the turn. */
    REQUIRE(loads(&s, PICTURE "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':"
                  "{'index':0,'texCoord':1,'extensions':{'KHR_texture_transform':"
                  "{'offset':[0,1],'rotation':1.57079632679,'scale':[0.5,0.5]}}}}},"
                  "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,'texCoord':0,"
                  "'extensions':{'KHR_texture_transform':{'offset':[0.5,0.25],'scale':[2,-3],"
                  "'texCoord':1}}}}},{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,"
                  "'texCoord':1,'extensions':{'KHR_texture_transform':"
                  "{'rotation':1.57079632679,'scale':[2,3]}}}}}]," ONE_NODE
                  "'meshes':[{'primitives':["
                  "{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_1':2},'material':0},"
                  "{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_1':2},'material':1},"
                  "{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_1':2},'material':2}]}]",
                  &m));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].uv, 1e-7, 0, 1, 0, 0.5, 0.5, 1));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[1].uv, 1e-7, 0.5, 0.25, 2.5, 0.25, 0.5, -2.75));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[2].uv, 1e-7, 0, 0, 0, -2, 3, 0));
}

/* A grey of 200, 8 x 8. */
#define JPEG_BASE64 "/9j/2wBDAAEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEB" \
    "AQH/wAALCAAIAAgBAREA/8QAFAABAAAAAAAAAAAAAAAAAAAACv/EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAIAQEAAD8ASA//2Q=="

static void test_jpeg_pictures_are_read_as_png_is(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(loads(&s, "'images':[{'uri':'data:image/jpeg;base64," JPEG_BASE64 "'}],'textures':[{'source':0}],"
                  "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]," ONE_NODE
                  "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]", &m));
    CHECK_EQ(m.image_count, 1);
    CHECK(m.image[0].width == 8 && m.image[0].height == 8 && m.material[0].image == 0);
    for (int i = 0; i < 8 * 8 * 4; i++)
        CHECK_EQ(m.image[0].rgba[i], i % 4 == 3 ? 255 : 200);
}

static void test_pictures_of_other_formats_are_refused_by_name(void)
{
    static const struct { const char *base64, *message; } cases[] = {
        { "/9j/4AAQSkZJRgABAQ==", "file ends early (in segment 0xE0) (images[0])" },
        { "AAAADGpQICANCocK", "a JPEG 2000 picture; PNG and JPEG are read (images[0])" },
        { "/wo=", "a JPEG XL picture; PNG and JPEG are read (images[0])" },
        { "AAAADEpYTCANCocK", "a JPEG XL picture; PNG and JPEG are read (images[0])" },
        { "AAAAIGZ0eXBhdmlm", "an AVIF picture; PNG and JPEG are read (images[0])" },
        { "UklGRhIAAABXRUJQVlA4TA==", "a WebP picture; PNG and JPEG are read (images[0])" },
        { "q0tUWCAyMLsNChoK", "a KTX picture; PNG and JPEG are read (images[0])" },
        { "R0lGODlhAQABAA==", "a GIF picture; PNG and JPEG are read (images[0])" },
        { "aGVsbG8gd29ybGQ=", "a picture of an unknown format; PNG and JPEG are read (images[0])" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct source s = triangle();
        struct model m;
        struct failure f;
        char body[800];
        snprintf(body, sizeof body, "'images':[{'uri':'data:;base64,%s'}],"
                 "'textures':[{'source':0}],'materials':[{'pbrMetallicRoughness':"
                 "{'baseColorTexture':{'index':0}}}]," ONE_NODE
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]",
                 cases[i].base64);
        CHECK(!load(&s, body, &m, &f));
        CHECK(same_text(f.text, cases[i].message));
        /* Not looked at when nothing drawn uses it. */
        char *used = strstr(body, ",'material':0");
        memset(used, ' ', strlen(",'material':0"));
        if (CHECK(loads(&s, body, &m)))
            model_free(&m);
    }
}

/* A texture may have its picture in an extension, and PNG or JPEG beside it for those who do not read that. */
static void test_textures_of_other_formats_alone_are_refused_by_name(void)
{
    static const struct { const char *texture, *message; } cases[] = {
        { "", "no source (textures[0])" },
        { "'extensions':{'KHR_texture_basisu':{'source':0}}", "a KTX picture alone; PNG and JPEG are read (textures[0])" },
        { "'extensions':{'EXT_texture_webp':{'source':0}}", "a WebP picture alone; PNG and JPEG are read (textures[0])" },
        { "'extensions':{'EXT_texture_avif':{'source':0}}", "an AVIF picture alone; PNG and JPEG are read (textures[0])" },
        { "'extensions':{'MSFT_texture_dds':{'source':0}}", "a DDS picture alone; PNG and JPEG are read (textures[0])" },
        { "'source':1,'extensions':{'EXT_texture_webp':{'source':0}}", NULL },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct source s = triangle();
        struct model m;
        struct failure f;
        char body[1000];
        snprintf(body, sizeof body, "'images':[{'uri':'data:;base64,UklGRhIAAABXRUJQVlA4TA=='},{'uri':'data:;base64," JPEG_BASE64 "'}],"
                 "'textures':[{%s}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]," ONE_NODE
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]", cases[i].texture);
        const bool ok = load(&s, body, &m, &f);
        CHECK(ok == (cases[i].message == NULL) && (ok || same_text(f.text, cases[i].message)));
        if (ok)
            model_free(&m);
    }
}

/* --- nodes --- */

static void test_transforms_multiply_down_the_tree(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    /* Children before parents in the file; above a matrix, a quarter turn about z
     * whose quaternion is too short. */
    REQUIRE(loads(&s, "'nodes':[{'mesh':0,'matrix':[0,2,0,0,-2,0,0,0,0,0,2,0,5,6,7,1]},"
                  "{'mesh':0,'translation':[1,2,3],'scale':[1,-1,2]},"
                  "{'name':'top','children':[0,1],'rotation':[0,0,0.5,0.5],"
                  "'translation':[10,0,0]}]," ONE_MESH, &m));
    CHECK_EQ(m.order[0], 2);
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose))) {
        CHECK_EQ(pose.draw_count, 2);
        CHECK(!pose.draw[0].deformed && pose.draw[0].position == m.mesh[0].primitive[0].position);
        CHECK(world_column(&pose, 0, 0, -2, 0, 0));
        CHECK(world_column(&pose, 0, 1, 0, -2, 0));
        CHECK(world_column(&pose, 0, 2, 0, 0, 2));
        CHECK(world_column(&pose, 0, 3, 4, 5, 7));
        CHECK(world_column(&pose, 1, 0, 0, 1, 0));
        CHECK(world_column(&pose, 1, 1, 1, 0, 0));
        CHECK(world_column(&pose, 1, 2, 0, 0, 2));
        CHECK(world_column(&pose, 1, 3, 8, 1, 3));
        double min[3], max[3];
        CHECK(model_pose_bounds(&pose, min, max));
        CHECK_CLOSE(min[0], 2, 1e-6);
        CHECK_CLOSE(max[0], 9, 1e-6);
        CHECK_CLOSE(min[1], 1, 1e-6);
        CHECK_CLOSE(max[1], 5, 1e-6);
        CHECK_CLOSE(max[2], 7, 1e-6);
    }
    CHECK_EQ(model_find_node(&m, "top"), 2);
    CHECK_EQ(model_find_node(&m, ""), -1);
    CHECK(model_node_is_under(&m, 1, 2) && model_node_is_under(&m, 2, 2));
    CHECK(!model_node_is_under(&m, 2, 1));
}

static void test_the_default_scene_else_the_first_else_everything_is_drawn(void)
{
    static const struct { const char *scenes; int drawn[4]; int count; } cases[] = {
        { "'scene':1,'scenes':[{'nodes':[0]},{'nodes':[1]}],", { 1, 2 }, 2 },
        { "'scenes':[{'nodes':[3,0]},{'nodes':[1]}],", { 0, 3 }, 2 },
        { "", { 0, 1, 2, 3 }, 4 },
        { "'scenes':[{}],", { 0 }, 0 },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct source s = triangle();
        struct model m OWNED(model_free) = { 0 };
        struct model_pose pose OWNED(model_pose_free) = { 0 };
        char body[500];
        double min[3], max[3];
        snprintf(body, sizeof body, "%s'nodes':[{'mesh':0},{'mesh':0,'children':[2]},{'mesh':0},"
                 "{'mesh':0}]," ONE_MESH, cases[i].scenes);
        if (!CHECK(loads(&s, body, &m)))
            continue;
        if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose)) &&
            CHECK_EQ(pose.draw_count, cases[i].count)) {
            for (int k = 0; k < pose.draw_count; k++)
                CHECK_EQ(pose.draw[k].node, cases[i].drawn[k]);
            CHECK_EQ(model_pose_bounds(&pose, min, max), cases[i].count > 0);
        }
    }
}

static void test_cameras_of_the_scene_are_listed_in_node_order(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(loads(&s, "'scenes':[{'nodes':[0,1,3]}],'nodes':[{'camera':1,'name':'eye'},"
                  "{'camera':0},{'camera':0},{'camera':1}],'cameras':["
                  "{'type':'perspective','name':'wide','perspective':{'yfov':1,'znear':0.1}},"
                  "{'type':'orthographic','orthographic':"
                  "{'xmag':-4,'ymag':3,'znear':0,'zfar':9}}]," ONE_MESH, &m));
    CHECK_EQ(m.camera_count, 3);
    CHECK(m.camera[0].orthographic && m.camera[0].node == 0);
    CHECK(same_text(m.camera[0].name, "eye"));
    CHECK_CLOSE(m.camera[0].xmag, 4, 0);
    CHECK_CLOSE(m.camera[0].zfar, 9, 0);
    CHECK(!m.camera[1].orthographic && m.camera[1].node == 1);
    CHECK(same_text(m.camera[1].name, "wide"));
    CHECK_CLOSE(m.camera[1].yfov, 1, 0);
    CHECK_CLOSE(m.camera[1].zfar, 0, 0);
    CHECK_EQ(m.camera[2].node, 3);
    CHECK_EQ(model_find_camera(&m, "wide"), 1);
    CHECK_EQ(model_find_camera(&m, "2"), 2);
    CHECK_EQ(model_find_camera(&m, "3"), -1);
    CHECK_EQ(model_find_camera(&m, "-1"), -1);
    CHECK_EQ(model_find_camera(&m, ""), -1);
    CHECK_EQ(model_find_camera(&m, "99999999999999999999"), -1);
}

/* --- animation --- */

/* One node whose `path` has keys at 0, 1 and 3 seconds. */
static bool load_channel(const char *path, const char *interpolation, const char *type,
                         const double *values, int n, struct model *m)
{
    struct source s = triangle();
    char body[600];
    int per_key = strcmp(interpolation, "CUBICSPLINE") == 0 ? 3 : 1;
    ADD(&s, F32, "SCALAR", 3, "", 0, 1, 3);
    add(&s, F32, type, 3 * per_key, "", values, n);
    snprintf(body, sizeof body, "'animations':[{'name':'go','channels':[{'sampler':0,'target':"
             "{'node':0,'path':'%s'}}],'samplers':[{'input':1,'output':2,'interpolation':'%s'}]}],"
             ONE_NODE ONE_MESH, path, interpolation);
    return loads(&s, body, m);
}

/* The translation at each time. */
static void check_translations(const struct model *m, bool looped, const double (*cases)[4], int n)
{
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    for (int i = 0; i < n; i++) {
        if (CHECK(poses(m, 0, cases[i][0], looped, &pose)))
            CHECK(world_column(&pose, 0, 3, cases[i][1], cases[i][2], cases[i][3]));
    }
}

static void test_step_holds_each_key_until_the_next(void)
{
    static const double values[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9 };
    static const double cases[][4] = { { -1, 1, 2, 3 }, { 0, 1, 2, 3 }, { 0.999, 1, 2, 3 },
                                       { 1, 4, 5, 6 }, { 2.999, 4, 5, 6 }, { 3, 7, 8, 9 },
                                       { 100, 7, 8, 9 } };
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(load_channel("translation", "STEP", "VEC3", values, 9, &m));
    check_translations(&m, false, cases, (int)COUNT(cases));
    CHECK_CLOSE(m.clip[0].duration, 3, 0);
    CHECK_EQ(model_find_clip(&m, "go"), 0);
    CHECK_EQ(model_find_clip(&m, "0"), 0);
    CHECK_EQ(model_find_clip(&m, "1"), -1);
    CHECK_EQ(model_find_clip(&m, "stop"), -1);
}

static void test_linear_runs_straight_between_keys_and_clamps_or_loops(void)
{
    static const double values[] = { 0, 0, 0, 4, 8, -4, 0, 0, 12 };
    static const double clamped[][4] = { { -5, 0, 0, 0 }, { 0.25, 1, 2, -1 }, { 1, 4, 8, -4 },
                                         { 1.5, 3, 6, 0 }, { 3.5, 0, 0, 12 } };
    static const double looped[][4] = { { 0.25, 1, 2, -1 }, { 3.25, 1, 2, -1 },
                                        { 301.5, 3, 6, 0 }, { -1.5, 3, 6, 0 }, { 3, 0, 0, 0 } };
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(load_channel("translation", "LINEAR", "VEC3", values, 9, &m));
    check_translations(&m, false, clamped, (int)COUNT(clamped));
    check_translations(&m, true, looped, (int)COUNT(looped));
}

static void test_cubic_splines_follow_the_hermite_form(void)
{
    /* In-tangent, value, out-tangent of each key. From 1 s to 3 s, at u = 1/4 of 2 s:
     * (27 v + 5 w) / 32 + 2 (9 b - 3 a) / 64 with v = 1, b = 3, w = 5, a = -2 is 85/32. */
    static const double values[] = { 0, 0, 0, 0, 0, 0, 0, 0, 0,   0, 0, 0, 1, 1, 0, 3, 0, 8,
                                     -2, 0, 8, 5, 5, 0, 0, 0, 0 };
    static const double cases[][4] = { { 0, 0, 0, 0 }, { 0.5, 0.5, 0.5, 0 }, { 1, 1, 1, 0 },
                                       { 1.5, 2.65625, 1.625, 1.5 }, { 2, 4.25, 3, 0 },
                                       { 3, 5, 5, 0 }, { 4, 5, 5, 0 } };
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(load_channel("translation", "CUBICSPLINE", "VEC3", values, 27, &m));
    check_translations(&m, false, cases, (int)COUNT(cases));
}

/* Degrees about z, from the first column of the world matrix. */
static double angle_about_z(const struct model_pose *pose)
{
    return atan2(pose->draw[0].world[1], pose->draw[0].world[0]) * 180 / PI;
}

static void test_rotations_take_the_short_way_at_even_speed(void)
{
    /* 0, 120 and -120 degrees about z; the middle key is negated, which is the same rotation;
     * between the last two the short way leads through 180. Lengths other than 1 do not matter. */
    const double c = cos(PI / 3), d = sin(PI / 3);
    const double values[] = { 0, 0, 0, 1, 0, 0, -2 * d, -2 * c, 0, 0, -d, c };
    static const double cases[][2] = { { 0, 0 }, { 0.25, 30 }, { 0.5, 60 }, { 1, 120 },
                                       { 1.5, 150 }, { 2.25, -165 }, { 3, -120 } };
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    REQUIRE(load_channel("rotation", "LINEAR", "VEC4", values, 12, &m));
    for (size_t i = 0; i < COUNT(cases); i++) {
        if (CHECK(poses(&m, 0, cases[i][0], false, &pose)))
            CHECK_CLOSE(angle_about_z(&pose), cases[i][1], 1e-4);
    }
}

static void test_cubic_rotations_are_made_unit_length(void)
{
    const double h = sqrt(0.5);
    const double values[] = { 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,
                              0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0,
                              0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0 };
    static const double cases[][2] = { { 0, 0 }, { 0.5, 45 }, { 1, 90 }, { 2, 135 }, { 3, 180 } };
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    REQUIRE(load_channel("rotation", "CUBICSPLINE", "VEC4", values, 36, &m));
    for (size_t i = 0; i < COUNT(cases); i++) {
        if (!CHECK(poses(&m, 0, cases[i][0], false, &pose)))
            continue;
        const double *x = pose.draw[0].world;
        CHECK_CLOSE(fabs(angle_about_z(&pose)), cases[i][1], 1e-4);
        CHECK_CLOSE(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], 1, 1e-12);
    }
}

static void test_a_single_key_holds_forever_looped_or_not(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    ADD(&s, F32, "SCALAR", 1, "", 0);
    ADD(&s, F32, "VEC3", 1, "", 4, 5, 6);
    REQUIRE(loads(&s, "'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':"
                  "'translation'}}],'samplers':[{'input':1,'output':2}]}]," ONE_NODE ONE_MESH,
                  &m));
    static const double cases[][4] = { { -1, 4, 5, 6 }, { 0, 4, 5, 6 }, { 7.5, 4, 5, 6 } };
    check_translations(&m, false, cases, (int)COUNT(cases));
    check_translations(&m, true, cases, (int)COUNT(cases));
}

static void test_quantized_rotation_keys_are_normalised(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    ADD(&s, F32, "SCALAR", 2, "", 0, 1);
    ADD(&s, I16, "VEC4", 2, ",'normalized':true", 0, 0, 0, 32767, 0, 0, 23170, 23170);
    REQUIRE(loads(&s, "'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':"
                  "'rotation'}}],'samplers':[{'input':1,'output':2}]}]," ONE_NODE ONE_MESH, &m));
    if (CHECK(poses(&m, 0, 1, false, &pose)))
        CHECK_CLOSE(angle_about_z(&pose), 90, 1e-4);
    if (CHECK(poses(&m, 0, 0.5, false, &pose)))
        CHECK_CLOSE(angle_about_z(&pose), 45, 1e-4);
}

static void test_all_clips_together_let_the_later_win_and_share_the_longest_loop(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    ADD(&s, F32, "SCALAR", 2, "", 0, 1);
    ADD(&s, F32, "SCALAR", 2, "", 0, 4);
    ADD(&s, F32, "VEC3", 2, "", 0, 0, 0, 1, 0, 0);
    ADD(&s, F32, "VEC3", 2, "", 0, 0, 0, 0, 4, 0);
    ADD(&s, F32, "VEC3", 2, "", 1, 1, 1, 3, 1, 1);
    REQUIRE(loads(&s, "'animations':[{'channels':["
                  "{'sampler':0,'target':{'node':0,'path':'translation'}},"
                  "{'sampler':1,'target':{'node':0,'path':'scale'}}],"
                  "'samplers':[{'input':1,'output':3},{'input':1,'output':5}]},"
                  "{'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}},"
                  "{'sampler':0,'target':{'path':'pointer'}},"
                  "{'sampler':1,'target':{'node':1,'path':'scale'}}],"
                  "'samplers':[{'input':2,'output':4},{'input':1,'output':5}]}],"
                  "'nodes':[{'mesh':0},{}]," ONE_MESH, &m));
    CHECK_EQ(m.clip[1].channel_count, 2);       /* what has no node is some extension's */
    CHECK_CLOSE(m.clip[0].duration, 1, 0);
    CHECK_CLOSE(m.clip[1].duration, 4, 0);
    if (CHECK(poses(&m, 0, 0.5, false, &pose)))
        CHECK(world_column(&pose, 0, 3, 0.5, 0, 0) && world_column(&pose, 0, 0, 2, 0, 0));
    if (CHECK(poses(&m, 1, 0.5, false, &pose)))
        CHECK(world_column(&pose, 0, 3, 0, 0.5, 0) && world_column(&pose, 0, 0, 1, 0, 0));
    if (CHECK(poses(&m, MODEL_CLIP_ALL, 0.5, false, &pose)))
        CHECK(world_column(&pose, 0, 3, 0, 0.5, 0) && world_column(&pose, 0, 0, 2, 0, 0));
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0.5, false, &pose)))
        CHECK(world_column(&pose, 0, 3, 0, 0, 0) && world_column(&pose, 0, 0, 1, 0, 0));
    /* Looped together they wrap at 4 s, so that the short one rests at its end; alone at 1 s. */
    if (CHECK(poses(&m, MODEL_CLIP_ALL, 6.5, true, &pose)))
        CHECK(world_column(&pose, 0, 3, 0, 2.5, 0) && world_column(&pose, 0, 0, 3, 0, 0));
    if (CHECK(poses(&m, 0, 6.5, true, &pose)))
        CHECK(world_column(&pose, 0, 3, 0.5, 0, 0));
    struct failure f = { 0 };
    CHECK(!model_pose(&m, 2, 0, false, &pose, &f));
    CHECK(same_text(f.text, "there is no clip 2"));
    f = (struct failure){ 0 };
    CHECK(!model_pose(&m, 0, NAN, false, &pose, &f));
    CHECK(same_text(f.text, "the time of a pose is not finite"));
}

/* --- morphs and skins --- */

static void test_morph_targets_add_up_by_weight(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    ADD(&s, F32, "VEC3", 3, "", 0, 0, 1, 0, 0, 1, 0, 0, 1);                 /* 1 normals */
    ADD(&s, F32, "VEC3", 3, "", 2, 0, 0, 0, 4, 0, 0, 0, 8);                 /* 2 */
    ADD(&s, F32, "VEC3", 3, "", 1, 1, 1, 1, 1, 1, 1, 1, 1);                 /* 3 */
    ADD(&s, F32, "VEC3", 3, "", 0, 0, -2, 0, 0, 0, 1, 0, 0);                /* 4 normals */
    ADD(&s, F32, "SCALAR", 2, "", 0, 2);                                    /* 5 */
    ADD(&s, F32, "SCALAR", 4, "", 0, 1, 1, 3);                              /* 6 weights */
    REQUIRE(loads(&s, "'nodes':[{'mesh':0,'translation':[0,0,5]},{'mesh':0,'weights':[1,0]}],"
                  "'meshes':[{'weights':[0.5,0.25],'primitives':[{'attributes':"
                  "{'POSITION':0,'NORMAL':1},'targets':[{'POSITION':2,'NORMAL':4},"
                  "{'POSITION':3}]}]}],'animations':[{'channels':[{'sampler':0,'target':"
                  "{'node':0,'path':'weights'}}],'samplers':[{'input':5,'output':6}]}]", &m));
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose))) {
        CHECK(pose.draw[0].deformed && pose.draw[1].deformed);
        CHECK(SAME_FLOATS(pose.draw[0].position, 1e-7, 1.25, 0.25, 0.25, 1.25, 2.25, 0.25, 0.25,
                          1.25, 4.25));
        CHECK(SAME_FLOATS(pose.draw[0].normal, 1e-7, 0, 0, 0, 0, 0, 1, 0.5, 0, 1));
        CHECK(world_column(&pose, 0, 3, 0, 0, 5));
        CHECK(SAME_FLOATS(pose.draw[1].position, 1e-7, 2, 0, 0, 1, 4, 0, 0, 1, 8));
    }
    if (CHECK(poses(&m, 0, 1, false, &pose))) {         /* weights 0.5 and 2 */
        CHECK(SAME_FLOATS(pose.draw[0].position, 1e-7, 3, 2, 2, 3, 4, 2, 2, 3, 6));
        CHECK(SAME_FLOATS(pose.draw[1].position, 1e-7, 2, 0, 0, 1, 4, 0, 0, 1, 8));
    }
}

#define QUARTER "'rotation':[0,0,0.7071067811865476,0.7071067811865476]"

static void test_skins_blend_joint_matrices_and_ignore_their_node(void)
{
    struct source s = { 0 };
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    ADD(&s, F32, "VEC3", 3, "", 1, 1, 0, 2, 0, 0, 0, 0, 1);
    ADD(&s, F32, "VEC3", 3, "", 1, 0, 0, 1, 0, 0, 1, 1, 0);
    ADD(&s, U8, "VEC4", 3, "", 0, 1, 9, 0, 1, 0, 0, 0, 2, 0, 0, 0);
    ADD(&s, F32, "VEC4", 3, "", 0.5, 1.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);
    ADD(&s, F32, "MAT4", 3, "", 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1,
        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    /* Joint 0 moves by (1,0,0); joint 1 by (0,2,0) after a quarter turn about z and its inverse
     * bind matrix (0,-1,0); joint 2 scales x by -2. The mesh's node is far away, which must not
     * matter. */
    REQUIRE(loads(&s, "'nodes':[{'mesh':0,'skin':0,'translation':[100,0,0]},"
                  "{'translation':[1,0,0]},{'translation':[0,2,0]," QUARTER "},"
                  "{'scale':[-2,1,1]}],'skins':[{'joints':[1,2,3],'inverseBindMatrices':4}],"
                  "'meshes':[{'primitives':[{'attributes':"
                  "{'POSITION':0,'NORMAL':1,'JOINTS_0':2,'WEIGHTS_0':3}}]}]", &m));
    const struct model_primitive *p = &m.mesh[0].primitive[0];
    CHECK_EQ(p->influences, 4);
    CHECK(SAME_FLOATS(p->weight, 1e-7, 0.25, 0.75, 0, 0, 1, 0, 0, 0));
    CHECK_EQ(p->joint[2], 0);           /* 9 has no weight */
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose))) {
        const double n = sqrt(0.625), k = sqrt(1.25);
        CHECK(pose.draw[0].deformed);
        CHECK(world_column(&pose, 0, 3, 0, 0, 0));
        /* (2,1,0) / 4 + (0,3,0) 3/4; then joint 1 alone on (2,0,0); then (0,0,1). */
        CHECK(SAME_FLOATS(pose.draw[0].position, 1e-6, 0.5, 2.5, 0, 1, 4, 0, 0, 0, 1));
        /* The blend of rotations 1/4 and 3/4 is a rotation times sqrt(5/8); the mirror halves x. */
        CHECK(SAME_FLOATS(pose.draw[0].normal, 1e-6, 0.25 / n, 0.75 / n, 0, 0, 1, 0, -0.5 / k,
                          1 / k, 0));
    }
}

static void test_skins_default_to_identity_and_take_eight_influences(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    ADD(&s, U16, "VEC4", 3, "", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    ADD(&s, U8, "VEC4", 3, ",'normalized':true", 51, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0);
    ADD(&s, U8, "VEC4", 3, "", 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);
    ADD(&s, U16, "VEC4", 3, ",'normalized':true", 52428, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    REQUIRE(loads(&s, "'nodes':[{'mesh':0,'skin':0},{'translation':[10,0,0]},"
                  "{'translation':[0,10,0]}],'skins':[{'joints':[1,2]}],'meshes':[{'primitives':"
                  "[{'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2,'JOINTS_1':3,"
                  "'WEIGHTS_1':4}}]}]", &m));
    CHECK_EQ(m.mesh[0].primitive[0].influences, 8);
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose))) {
        /* Weights 1/5 and 4/5; all the first joint's; none at all, which means the first joint's.
         */
        CHECK(SAME_FLOATS(pose.draw[0].position, 1e-6, 2, 8, 0, 11, 0, 0, 10, 1, 0));
        CHECK(pose.draw[0].normal == NULL);
    }
}

static void test_morphs_come_before_skins(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    ADD(&s, F32, "VEC3", 3, "", 1, 0, 0, 1, 0, 0, 1, 0, 0);
    ADD(&s, U8, "VEC4", 3, "", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    ADD(&s, F32, "VEC4", 3, "", 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);
    REQUIRE(loads(&s, "'nodes':[{'mesh':0,'skin':0},{" QUARTER "}],'skins':[{'joints':[1]}],"
                  "'meshes':[{'weights':[2],'primitives':[{'targets':[{'POSITION':1}],"
                  "'attributes':{'POSITION':0,'JOINTS_0':2,'WEIGHTS_0':3}}]}]", &m));
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose)))
        CHECK(SAME_FLOATS(pose.draw[0].position, 1e-6, 0, 2, 0, 0, 3, 0, -1, 2, 0));
}

static void test_a_pose_is_reused_and_its_draws_keep_their_order(void)
{
    struct source s = triangle();
    struct model m OWNED(model_free) = { 0 }, other;
    struct model_pose pose = { 0 };
    ADD(&s, F32, "VEC3", 3, "", 1, 0, 0, 1, 0, 0, 1, 0, 0);
    REQUIRE(loads(&s, "'nodes':[{'mesh':1},{'mesh':0}],'meshes':[{'weights':[1],'primitives':"
                  "[{'targets':[{'POSITION':1}],'attributes':{'POSITION':0}}]},{'primitives':"
                  "[{'attributes':{'POSITION':0}},{'attributes':{'POSITION':1}}]}]", &m));
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose)) && CHECK_EQ(pose.draw_count, 3)) {
        const float *position = pose.draw[2].position;
        CHECK(pose.draw[0].node == 0 && pose.draw[0].primitive_of_mesh == 0);
        CHECK(pose.draw[1].node == 0 && pose.draw[1].primitive_of_mesh == 1);
        CHECK(pose.draw[2].node == 1 && pose.draw[2].primitive_of_mesh == 0);
        CHECK(poses(&m, MODEL_CLIP_NONE, 1, false, &pose));
        CHECK(pose.draw[2].position == position && position == pose.owned[0]);
    }
    if (CHECK(loads(&s, ONE_NODE ONE_MESH, &other))) {
        CHECK(poses(&other, MODEL_CLIP_NONE, 0, false, &pose) && pose.draw_count == 1);
        CHECK_EQ(pose.owned_count, 0);
        model_pose_free(&pose);
        model_free(&other);
    }
}

static void test_a_pose_out_of_range_is_refused(void)
{
    struct source s = { 0 };
    struct model m;
    struct model_pose pose = { 0 };
    struct failure f = { 0 };
    ADD(&s, F32, "VEC3", 3, "", 0, 0, 0, 3e38, 0, 0, 0, 3e38, 0);
    if (CHECK(loads(&s, "'nodes':[{'mesh':0,'scale':[1e200,1,1]}]," ONE_MESH, &m))) {
        CHECK(!model_pose(&m, MODEL_CLIP_NONE, 0, false, &pose, &f));
        CHECK(same_text(f.text, "the pose is out of range (nodes[0])"));
        model_pose_free(&pose);
        model_free(&m);
    }
    f = (struct failure){ 0 };
    if (CHECK(loads(&s, ONE_NODE "'meshes':[{'weights':[9],'primitives':[{'targets':"
                    "[{'POSITION':0}],'attributes':{'POSITION':0}}]}]", &m))) {
        CHECK(!model_pose(&m, MODEL_CLIP_NONE, 0, false, &pose, &f));
        CHECK(same_text(f.text, "a deformed vertex is out of range (nodes[0])"));
        model_pose_free(&pose);
        model_free(&m);
    }
}

/* --- refusals --- */

/* Accessors 1 to 10 of the source below, for use and abuse. */
static struct source parts(void)
{
    struct source s = triangle();
    ADD(&s, U8, "SCALAR", 3, "", 0, 1, 3);                                  /* 1 index too large */
    ADD(&s, F32, "SCALAR", 3, "", 0, 1, 1);                                 /* 2 times that rest */
    ADD(&s, F32, "SCALAR", 3, "", 0, 1, 2);                                 /* 3 times */
    ADD(&s, F32, "VEC3", 2, "", 0, 0, 0, 0, 0, 0);                          /* 4 too few */
    ADD(&s, F32, "VEC3", 3, "", 0, 0, 0, 0, (double)INFINITY, 0, 0, 0, 0);  /* 5 infinite */
    ADD(&s, F32, "VEC3", 3, "", (double)NAN, 0, 0, 0, 0, 0, 0, 0, 0);       /* 6 NaN */
    ADD(&s, U8, "VEC4", 3, "", 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);         /* 7 joint 4 */
    ADD(&s, F32, "VEC4", 3, "", 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);        /* 8 weights */
    ADD(&s, F32, "VEC4", 3, "", -1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);       /* 9 negative */
    ADD(&s, F32, "SCALAR", 3, "", -3e38, 0, 1);                             /* 10 times before the clip */
    return s;
}

#define SKINNED "'meshes':[{'primitives':[{'attributes':" \
    "{'POSITION':0,'JOINTS_0':7,'WEIGHTS_0':8}}]}],"
#define CLIP(target, sampler) ONE_NODE ONE_MESH ",'animations':[{'channels':[{'sampler':0," \
    "'target':" target "}],'samplers':[" sampler "]}]"

static void test_mistakes_are_refused_with_their_place(void)
{
    static const struct { const char *body, *message; } cases[] = {
        { "'nodes':[{'children':[1]},{'children':[2]},{'children':[1]}]",
          "node 1 has two parents, 0 and 2 (nodes[2].children[0])" },
        { "'nodes':[{},{'children':[2]},{'children':[3]},{'children':[1]},{}]",
          "a cycle: it is its own ancestor (nodes[2])" },
        { "'nodes':[{'children':[0]}]", "a cycle: it is its own ancestor (nodes[0])" },
        { "'nodes':[{'children':[1,1]},{}]",
          "node 1 has two parents, 0 and 0 (nodes[0].children[1])" },
        { "'nodes':[{'children':[7]}]", "there is no node 7 (nodes[0].children[0])" },
        { "'nodes':[{'children':[-1]}]", "-1 is not in 0 to 2147483647 (nodes[0].children[0])" },
        { "'nodes':[{'mesh':1}]," ONE_MESH, "there is no mesh 1 (nodes[0].mesh)" },
        { "'nodes':[{'skin':0}]", "there is no skin 0 (nodes[0].skin)" },
        { "'nodes':[{'camera':0}]", "there is no camera 0 (nodes[0].camera)" },
        { "'nodes':[{'matrix':[1,2,3]}]", "expected 16 numbers, found 3 (nodes[0].matrix)" },
        { "'nodes':[{'rotation':[0,0,0,0]}]", "no quaternion of length 1 (nodes[0].rotation)" },
        { "'nodes':[{'name':5}]", "expected a string, found a number (nodes[0].name)" },
        { "'nodes':[5]", "expected an object (nodes[0])" },
        { "'nodes':{}", "expected an array, found an object (nodes)" },
        { "'nodes':[{}],'scene':1,'scenes':[{}]", "there is no scene 1 (scene)" },
        { "'nodes':[{}],'scenes':[{'nodes':[1]}]", "there is no node 1 (scenes[0].nodes[0])" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}]",
          "index 3, but only 3 vertices (meshes[0].primitives[0].indices)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':3}]}]",
          "accessor 3 has component type 5126, which is not for this "
          "(meshes[0].primitives[0].indices)" },
        { "'meshes':[{},{'primitives':[{'attributes':{'POSITION':99}}]}]",
          "there is no accessor 99 (meshes[1].primitives[0].attributes.POSITION)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':3}}]}]",
          "accessor 3 is SCALAR, not VEC3 (meshes[0].primitives[0].attributes.POSITION)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':4}}]}]",
          "accessor 4 has 2 elements, not 3 (meshes[0].primitives[0].attributes.NORMAL)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':5}}]}]",
          "element 1 of accessor 5 is not finite (meshes[0].primitives[0].attributes.POSITION)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':6}}]}]",
          "element 0 of accessor 6 is not finite (meshes[0].primitives[0].attributes.POSITION)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'mode':7}]}]",
          "7 is not in 0 to 6 (meshes[0].primitives[0].mode)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]",
          "there is no material 0 (meshes[0].primitives[0].material)" },
        { "'meshes':[{'primitives':[{}]}]", "no attributes (meshes[0].primitives[0])" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'targets':[{'POSITION':4}]}]}]",
          "accessor 4 has 2 elements, not 3 (meshes[0].primitives[0].targets[0].POSITION)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'targets':[{}]},"
          "{'attributes':{'POSITION':0}}]}]",
          "its primitives differ in their number of morph targets (meshes[0])" },
        { "'meshes':[{'weights':[1,2],'primitives':[{'attributes':{'POSITION':0},"
          "'targets':[{}]}]}]", "2 weights for 1 morph targets (meshes[0].weights)" },
        { "'nodes':[{'mesh':0,'weights':[1]}]," ONE_MESH,
          "1 weights for 0 morph targets (nodes[0].weights)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':7}}]}]",
          "joints and weights need each other (meshes[0].primitives[0].attributes.WEIGHTS_0)" },
        { "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':7,'WEIGHTS_0':9}}]}]",
          "a weight is negative (meshes[0].primitives[0].attributes.WEIGHTS_0)" },
        { SKINNED "'nodes':[{'mesh':0,'skin':0}],'skins':[{'joints':[0]}]",
          "mesh 0 uses joint 4, skin 0 has 1 joints (nodes[0])" },
        { SKINNED "'nodes':[{'mesh':0,'skin':0}],'skins':[{'joints':[0,0,0,0]}]",
          "mesh 0 uses joint 4, skin 0 has 4 joints (nodes[0])" },
        { SKINNED "'nodes':[{}],'skins':[{'joints':[1]}]",
          "there is no node 1 (skins[0].joints[0])" },
        { SKINNED "'nodes':[{}],'skins':[{'joints':[]}]", "no joints (skins[0])" },
        { SKINNED "'nodes':[{}],'skins':[{'joints':[0],'inverseBindMatrices':0}]",
          "accessor 0 is VEC3, not MAT4 (skins[0].inverseBindMatrices)" },
        { "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]",
          "there is no texture 0 (materials[0].pbrMetallicRoughness.baseColorTexture.index)" },
        { "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[1,2,0,1]}}]",
          "2 is not in 0 to 1 (materials[0].pbrMetallicRoughness.baseColorFactor)" },
        { "'materials':[{'alphaMode':'GLOW'}]",
          "'GLOW' is no alpha mode (materials[0].alphaMode)" },
        { "'textures':[{'source':0}],'materials':[{'pbrMetallicRoughness':"
          "{'baseColorTexture':{'index':0}}}]", "there is no image 0 (textures[0].source)" },
        { "'nodes':[{'camera':0}],'cameras':[{'type':'fisheye','fisheye':{}}]",
          "neither perspective nor orthographic (cameras[0])" },
        { "'nodes':[{'camera':0}],'cameras':[{'type':'perspective','perspective':{'znear':1}}]",
          "0 is no field of view (cameras[0].perspective.yfov)" },
        { "'nodes':[{'camera':0}],'cameras':[{'type':'perspective','perspective':"
          "{'yfov':1,'znear':2,'zfar':1}}]",
          "1 is not beyond znear (cameras[0].perspective.zfar)" },
        { CLIP("{'node':0,'path':'translation'}", "{'input':2,'output':0}"),
          "time of key 2 does not increase (animations[0].samplers[0].input)" },
        { CLIP("{'node':0,'path':'translation'}", "{'input':10,'output':0}"),
          "time of key 0 is -3e+38 s, before the clip begins (animations[0].samplers[0].input)" },
        { CLIP("{'node':0,'path':'translation'}", "{'input':3,'output':4}"),
          "accessor 4 has 2 elements, not 3 (animations[0].samplers[0].output)" },
        { CLIP("{'node':0,'path':'rotation'}", "{'input':3,'output':0}"),
          "accessor 0 is VEC3, not VEC4 (animations[0].samplers[0].output)" },
        { CLIP("{'node':0,'path':'weights'}", "{'input':3,'output':3}"),
          "node 0 has no morph targets (animations[0].channels[0].target)" },
        { CLIP("{'node':0,'path':'colour'}", "{'input':3,'output':3}"),
          "'colour' cannot be animated (animations[0].channels[0].target.path)" },
        { CLIP("{'node':1,'path':'scale'}", "{'input':3,'output':0}"),
          "there is no node 1 (animations[0].channels[0].target.node)" },
        { CLIP("{'node':0,'path':'scale'}", ""),
          "there is no sampler 0 (animations[0].channels[0].sampler)" },
        { CLIP("{'node':0,'path':'scale'}", "{'input':3}"),
          "no input or no output (animations[0].samplers[0])" },
        { CLIP("{'node':0,'path':'scale'}", "{'input':3,'output':0,'interpolation':'ODD'}"),
          "'ODD' is not known (animations[0].samplers[0].interpolation)" },
        { "'nodes':[{'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],'animations':[{'channels':"
          "[{'sampler':0,'target':{'node':0,'path':'scale'}}],'samplers':[{}]}]",
          "node 0 is placed by a matrix, which cannot be animated "
          "(animations[0].channels[0].target)" },
    };
    struct source s = parts();
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct model m OWNED(model_free) = { 0 };
        struct failure f;
        if (!CHECK(!load(&s, cases[i].body, &m, &f))) {
            test_print(cases[i].message);
            test_print("\n");
            continue;
        }
        CHECK(same_text(f.text, cases[i].message));
        CHECK(m.node == NULL && m.mesh == NULL && m.clip == NULL);
    }
}

static void test_extents_that_lie_are_refused_before_memory_is_taken(void)
{
    static const struct { const char *accessor, *message; } cases[] = {
        { ",'bufferView':0", "1000000000 elements reach past buffer view 0 of 36 bytes "
          "(accessors[1].byteOffset)" },
        { "", "1000000000 zero elements in a file of " },
        { ",'bufferView':1", "there is no buffer view 1 (accessors[1].bufferView)" },
        { ",'bufferView':0,'byteOffset':9007199254740992", "1000000000 elements reach past buffer "
          "view 0 of 36 bytes (accessors[1].byteOffset)" },
        { ",'bufferView':0,'byteOffset':1e300",
          "1.0000000000000001e+300 is not in 0 to 9007199254740992 (accessors[1].byteOffset)" },
        { ",'bufferView':0,'byteOffset':36", "1000000000 elements reach past buffer view 0 of 36 "
          "bytes (accessors[1].byteOffset)" },
        { ",'bufferView':0,'byteOffset':25", "1000000000 elements reach past buffer view 0 of 36 "
          "bytes (accessors[1].byteOffset)" },
        { ",'bufferView':0,'byteOffset':-1",
          "-1 is not in 0 to 9007199254740992 (accessors[1].byteOffset)" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct source s = triangle();
        struct model m;
        struct failure f;
        add_accessor(&s, F32, "VEC3", 1000000000, cases[i].accessor);
        CHECK(!load(&s, ONE_NODE ONE_MESH, &m, &f));
        f.text[strlen(cases[i].message)] = '\0';
        CHECK(same_text(f.text, cases[i].message));
    }
    static const struct { const char *sparse, *message; } sparse[] = {
        { "{'count':4,'indices':{'bufferView':1,'componentType':5121},'values':{'bufferView':0}}",
          "4 is not in 1 to 3 (accessors[1].sparse.count)" },
        { "{'count':3,'indices':{'bufferView':1,'componentType':5123},'values':{'bufferView':0}}",
          "3 elements reach past buffer view 1 of 3 bytes "
          "(accessors[1].sparse.indices.byteOffset)" },
        { "{'count':3,'indices':{'bufferView':1,'componentType':5121},"
          "'values':{'bufferView':0,'byteOffset':4}}",
          "3 elements reach past buffer view 0 of 36 bytes "
          "(accessors[1].sparse.values.byteOffset)" },
        { "{'count':3,'indices':{'bufferView':1,'componentType':5121},'values':{'bufferView':0}}",
          "sparse index 5 is out of order or not below 3 (accessors[1].sparse.indices)" },
        { "{'count':2,'indices':{'bufferView':1,'componentType':5121,'byteOffset':1},"
          "'values':{'bufferView':0}}",
          "sparse index 5 is out of order or not below 3 (accessors[1].sparse.indices)" },
        { "{'count':2,'indices':{'bufferView':2,'componentType':5121},"
          "'values':{'bufferView':0}}",
          "sparse index 2 is out of order or not below 3 (accessors[1].sparse.indices)" },
        { "{'count':2,'indices':{'bufferView':2,'componentType':5121,'byteOffset':1},"
          "'values':{'bufferView':0}}",
          "sparse index 3 is out of order or not below 3 (accessors[1].sparse.indices)" },
        { "{'count':1,'indices':{'bufferView':1,'componentType':5121},"
          "'values':{'bufferView':0,'byteOffset':25}}",
          "1 elements reach past buffer view 0 of 36 bytes "
          "(accessors[1].sparse.values.byteOffset)" },
        { "{'count':3,'indices':{'bufferView':1,'componentType':5126},'values':{'bufferView':0}}",
          "5126 is no component type for this (accessors[1].sparse.indices.componentType)" },
        { "{'count':3}", "count, indices or values are missing (accessors[1].sparse)" },
    };
    for (size_t i = 0; i < COUNT(sparse); i++) {
        struct source s = triangle();
        struct model m;
        struct failure f;
        char extra[300];
        add_view(&s, U8, "", (const double[]){ 0, 2, 5 }, 3);
        add_view(&s, U8, "", (const double[]){ 2, 2, 3 }, 3);
        snprintf(extra, sizeof extra, ",'sparse':%s", sparse[i].sparse);
        add_accessor(&s, F32, "VEC3", 3, extra);
        CHECK(!load(&s, ONE_NODE ONE_MESH, &m, &f));
        CHECK(same_text(f.text, sparse[i].message));
    }
    static const struct { const char *text, *message; } files[] = {
        { "'buffers':[{'byteLength':9007199254740992,'uri':'data:;base64,AAAA'}]",
          "9007199254740992 bytes promised, 3 there (buffers[0].byteLength)" },
        { "'buffers':[{'byteLength':36}],'bufferViews':[{'buffer':0,'byteLength':36}],"
          "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}]",
          "its bytes are in a buffer that has neither a uri nor a BIN chunk (accessors[0].bufferView)" },
        { "'buffers':[{'byteLength':3,'uri':'data:;base64,AAAA'}],'bufferViews':[{'buffer':0,"
          "'byteOffset':2,'byteLength':2}]",
          "reaches past its buffer of 3 bytes (bufferViews[0])" },
        { "'buffers':[{'byteLength':3,'uri':'data:;base64,AAAA'}],'bufferViews':[{'buffer':0,"
          "'byteOffset':9007199254740992,'byteLength':9007199254740992}]",
          "reaches past its buffer of 3 bytes (bufferViews[0])" },
        { "'buffers':[{'byteLength':3,'uri':'data:;base64,AAAA'}],'bufferViews':[{'buffer':0,"
          "'byteLength':3,'byteStride':3}]", "3 is not in 4 to 252 (bufferViews[0].byteStride)" },
    };
    for (size_t i = 0; i < COUNT(files); i++) {
        char text[400];
        struct model m;
        struct failure f = { 0 };
        snprintf(text, sizeof text, "{'asset':{'version':'2.0'},%s}", files[i].text);
        for (char *p = text; *p != '\0'; p++)
            *p = *p == '\'' ? '"' : *p;
        CHECK(!model_parse((const uint8_t *)text, strlen(text), NULL, &m, &f));
        CHECK(same_text(f.text, files[i].message));
    }
}

static void test_one_mesh_in_very_many_nodes_is_refused(void)
{
    /* 2000 primitives in 2000 nodes are 4 million draws from 150 kB of text. */
    enum { N = 2000, ROOM = 200000 };
    char *text = calloc(1, ROOM);
    struct model m;
    struct failure f = { 0 };
    REQUIRE(text != NULL);
    char *at = text;
    at += sprintf(at, "{\"asset\":{\"version\":\"2.0\"},\"accessors\":[{\"componentType\":5126,"
                  "\"type\":\"VEC3\",\"count\":3}],\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < N; i++)
        at += sprintf(at, "%s{\"attributes\":{\"POSITION\":0}}", i == 0 ? "" : ",");
    at += sprintf(at, "]}],\"nodes\":[");
    for (int i = 0; i < N; i++)
        at += sprintf(at, "%s{\"mesh\":0}", i == 0 ? "" : ",");
    at += sprintf(at, "]}");
    CHECK(!model_parse((const uint8_t *)text, (size_t)(at - text), NULL, &m, &f));
    CHECK(same_text(f.text, "too many nodes use its meshes: above 65535 draws, 256 MB or "
                    "67108864 terms a pose"));
    free(text);
}

/* A file with something of everything. */
static uint8_t *rich_glb(size_t *size)
{
    struct source s = triangle();
    ADD(&s, U8, "VEC4", 3, "", 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0);         /* 1 joints */
    ADD(&s, F32, "VEC4", 3, "", 0.5, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);    /* 2 weights */
    ADD(&s, U16, "SCALAR", 3, "", 2, 1, 0);                                 /* 3 indices */
    ADD(&s, F32, "SCALAR", 2, "", 0, 1);                                    /* 4 times */
    ADD(&s, F32, "VEC4", 2, "", 0, 0, 0, 1, 0, 0, 1, 0);                    /* 5 rotations */
    ADD(&s, F32, "SCALAR", 2, "", 0, 1);                                    /* 6 weights */
    ADD(&s, F32, "VEC2", 3, "", 0, 0, 1, 0, 0, 1);                          /* 7 uv */
    add_view(&s, U8, "", (const double[]){ 1 }, 1);
    add_accessor(&s, F32, "VEC3", 3, ",'sparse':{'count':1,'indices':{'bufferView':8,"
                 "'componentType':5121},'values':{'bufferView':0}}");       /* 8 morph */
    return make_glb(&s, PICTURE "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':"
                    "{'index':0,'extensions':{'KHR_texture_transform':{'offset':[1,2]}}}}}],"
                    "'nodes':[{'mesh':0,'skin':0,'children':[1,2]},{'name':'a'},{'scale':[1,2,1]},"
                    "{'camera':0}],'skins':[{'joints':[1,2]}],'scenes':[{'nodes':[0,3]}],"
                    "'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':1}}],"
                    "'meshes':[{'primitives':[{'material':0,'indices':3,'targets':[{'POSITION':8}],"
                    "'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2,'TEXCOORD_0':7}}]}],"
                    "'animations':[{'samplers':[{'input':4,'output':5},{'input':4,'output':6}],"
                    "'channels':[{'sampler':0,'target':{'node':1,'path':'rotation'}},"
                    "{'sampler':1,'target':{'node':0,'path':'weights'}}]}]", size);
}

static void test_a_glb_cut_off_anywhere_is_refused(void)
{
    size_t size;
    uint8_t *glb = rich_glb(&size);
    struct model m;
    struct failure f = { 0 };
    if (CHECK(model_parse(glb, size, NULL, &m, &f)))
        model_free(&m);
    for (size_t n = 0; n < size; n++) {
        /* A block of exactly n bytes, so that a sanitizer sees any step beyond. */
        uint8_t *cut = malloc(n == 0 ? 1 : n);
        if (!CHECK(cut != NULL))
            break;
        memcpy(cut, glb, n);
        f = (struct failure){ 0 };
        CHECK(!model_parse(cut, n, NULL, &m, &f));
        CHECK(f.text[0] != '\0');
        /* The same with a header that agrees with the size. */
        if (n >= 12) {
            for (int i = 0; i < 4; i++)
                cut[8 + i] = (uint8_t)(n >> 8 * i);
            f = (struct failure){ 0 };
            CHECK(!model_parse(cut, n, NULL, &m, &f));
        }
        free(cut);
    }
    free(glb);
}

static void test_a_glb_with_any_byte_changed_is_read_or_refused(void)
{
    size_t size;
    uint8_t *glb = rich_glb(&size);
    int loaded = 0;
    for (size_t i = 0; i < size; i++) {
        static const uint8_t changes[] = { 0x01, 0x10, 0x80, 0xff };
        for (size_t k = 0; k < COUNT(changes); k++) {
            struct model m;
            struct model_pose pose = { 0 };
            struct failure f = { 0 };
            double min[3], max[3];
            glb[i] ^= changes[k];
            if (model_parse(glb, size, NULL, &m, &f)) {
                loaded++;
                if (model_pose(&m, MODEL_CLIP_ALL, 0.3, true, &pose, &f) &&
                    model_pose_bounds(&pose, min, max))
                    CHECK(min[0] <= max[0] && min[1] <= max[1] && min[2] <= max[2]);
                model_pose_free(&pose);
                model_free(&m);
            } else {
                CHECK(f.text[0] != '\0');
            }
            glb[i] ^= changes[k];
        }
    }
    CHECK(loaded > 100);
    free(glb);
}

/* --- OBJ --- */

static void test_obj_faces_of_every_form_become_triangles(void)
{
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(parses("# a quad, a triangle, a pentagon\r\n"
                   "v 0 0 0\r\nv 1 0 0 1.0\r\nv 1 1 0\r\nv 0 1 0\r\nv -1 0.5 0\r\n"
                   "vt 0.25 0.75\r\nvt 0 0\r\nvn 0 0 1\r\n"
                   "f 1 2 3 4\r\nf -5 -4 -3\r\nf 1 2 \\\r\n  3 4 5 # comment\r\n"
                   "f 1/1 2/2 3/-1\r\nf 1//1 2//1 3//-1\r\nf 1/1/1 2/2/1 3/1/1\r\n", &m));
    CHECK_EQ(m.node_count, 1);
    CHECK_EQ(m.mesh[0].primitive_count, 4);         /* four forms */
    const struct model_primitive *p = m.mesh[0].primitive;
    static const uint32_t index[] = { 0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 1, 2, 0, 2, 3, 0, 3, 4 };
    CHECK_EQ(p[0].triangle_count, 6);
    CHECK_EQ(p[0].vertex_count, 5);
    CHECK(memcmp(p[0].index, index, sizeof index) == 0);
    CHECK(p[0].uv == NULL && p[0].normal == NULL && p[0].color == NULL);
    CHECK(SAME_FLOATS(p[0].position + 12, 0, -1, 0.5, 0));
    CHECK(SAME_FLOATS(p[1].uv, 0, 0.25, 0.25, 0, 1, 0, 1));
    CHECK(p[1].normal == NULL && p[2].uv == NULL);
    CHECK(SAME_FLOATS(p[2].normal, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1));
    CHECK(p[3].uv != NULL && p[3].normal != NULL);
    CHECK_EQ(m.material_count, 1);
    CHECK(m.warning[0] == '\0');
}

static void test_obj_vertices_may_have_colors(void)
{
    struct model m OWNED(model_free) = { 0 };
    REQUIRE(parses("v 0 0 0 0.5 0.25 1\nv 1 0 0\nv 1 1 0 0 0 0\nf 1 2 3\n", &m));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].color, 0, 0.5, 0.25, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1));
}

static void test_obj_objects_and_groups_become_nodes(void)
{
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    REQUIRE(parses("v 0 0 0\nv 1 0 0\nv 1 1 0\ng loose\nf 1 2 3\no car\nf 1 2 3\n"
                   "g front wheel\nf 1 2 3\nusemtl red\nf 3 2 1\no hat\nf 1 2 3\n"
                   "o car\ng front wheel\nusemtl blue\nf 1 2 3\nl 1 2\np 1\n", &m));
    CHECK_EQ(m.node_count, 4);
    int loose = model_find_node(&m, "loose"), car = model_find_node(&m, "car");
    int wheel = model_find_node(&m, "front wheel"), hat = model_find_node(&m, "hat");
    CHECK(loose == 0 && car >= 0 && wheel >= 0 && hat >= 0);
    CHECK(model_node_is_under(&m, wheel, car) && !model_node_is_under(&m, hat, car));
    CHECK_EQ(m.mesh[m.node[wheel].mesh].primitive_count, 3);
    CHECK_EQ(m.material_count, 3);
    CHECK(same_text(m.material[m.mesh[m.node[wheel].mesh].primitive[1].material].name, "red"));
    CHECK_EQ(m.skipped_primitives, 2);
    CHECK(same_text(m.warning, "2 primitives hold no triangles and are left out"));
    if (CHECK(poses(&m, MODEL_CLIP_NONE, 0, false, &pose)))
        CHECK_EQ(pose.draw_count, 6);
}

static void test_obj_with_any_number_of_groups_has_each_under_its_object(void)
{
    for (int n = 1; n <= 70; n++) {
        char text[4000] = "v 0 0 0\nv 1 0 0\nv 1 1 0\no all\n";
        struct model m OWNED(model_free) = { 0 };
        for (int i = 0; i < n; i++)
            append(text, sizeof text, "g part%d\nusemtl m%d\nf 1 2 3\n", i, i);
        if (!CHECK(parses(text, &m)))
            continue;
        CHECK_EQ(m.node_count, n + 1);
        CHECK_EQ(m.material_count, n);
        for (int i = 0; i < n; i++) {
            char name[20];
            snprintf(name, sizeof name, "part%d", i);
            int node = model_find_node(&m, name);
            CHECK(node >= 0 && m.node[node].parent == model_find_node(&m, "all"));
            CHECK_EQ(m.mesh[m.node[node].mesh].primitive[0].material, i);
        }
    }
}

static void test_obj_materials_come_from_the_library_beside_it(void)
{
    struct model m OWNED(model_free) = { 0 };
    struct failure f = { 0 };
    char path[200];
    snprintf(path, sizeof path, "%squad.obj", corpus);
    REQUIRE(model_load(path, &m, &f));
    CHECK(same_text(m.warning, ""));
    CHECK_EQ(m.material_count, 3);
    CHECK_EQ(m.image_count, 1);
    const struct model_material *a = &m.material[0], *b = &m.material[1];
    CHECK(SAME_FLOATS(a->base, 0, 0.5, 0.25, 1, 1));
    CHECK(a->image == 0 && a->wrap_u == MODEL_WRAP_CLAMP && a->alpha == MODEL_ALPHA_OPAQUE);
    CHECK(b->image == -1 && b->alpha == MODEL_ALPHA_BLEND && b->unlit && !a->unlit);
    CHECK_CLOSE((double)b->base[3], 0.25, 0);
    /* Scaled by 2 and 3, shifted by 1/2, turned upside down. */
    CHECK(SAME_FLOATS(m.mesh[0].primitive[0].uv, 0, 0.5, 1, 2.5, 1, 2.5, -2, 0.5, -2));
    CHECK(SAME_FLOATS(m.mesh[0].primitive[1].uv, 0, 0, 0, 1, 0, 1, 1, 0, 1));
}

static void test_obj_without_its_library_is_loaded_with_a_warning(void)
{
    struct model m;
    if (CHECK(parses("mtllib gone.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", &m))) {
        CHECK(strstr(m.warning, "gone.mtl") != NULL);
        CHECK(SAME_FLOATS(m.material[0].base, 0, 1, 1, 1, 1));
        model_free(&m);
    }
}

static void test_mtl_options_are_understood_or_skipped(void)
{
    static const char text[] = "Kd 9 9 9\nnewmtl a\nKd 0.5\nTr 0.75\n"
        "map_Kd -blendu on -mm 0 1 -t 1 1 1 -o 0.25 -s 2 3 4 -texres 64 dir\\my pic.png\n"
        "newmtl b\nKd xyz 1 1 1\nd -halo 2\nKs 1 1 1\nillum 2\n"
        "newmtl c\nKd spectral file.rfl 1\nillum 0\nnewmtl a\nd 1\n";
    struct mtl_library library = { 0 };
    struct model m = { 0 };
    struct failure f = { 0 };
    if (CHECK(mtl_parse((const uint8_t *)text, strlen(text), &library, &m, &f)) &&
        CHECK_EQ(m.material_count, 3)) {
        /* The second `a` goes on where the first ended. */
        CHECK(SAME_FLOATS(m.material[0].base, 0, 0.5, 0.5, 0.5, 1));
        CHECK(m.material[0].alpha == MODEL_ALPHA_OPAQUE);
        CHECK(m.material[0].wrap_u == MODEL_WRAP_REPEAT);
        CHECK(same_text(library.material[0].map, "dir/my pic.png"));
        CHECK(SAME_FLOATS(library.material[0].scale, 0, 2, 3));
        CHECK(SAME_FLOATS(library.material[0].offset, 0, 0.25, 0));
        CHECK(SAME_FLOATS(m.material[1].base, 0, 1, 1, 1, 1));
        CHECK(m.material[2].unlit && !m.material[1].unlit);
    }
    mtl_library_free(&library);
    model_free(&m);
    static const struct { const char *text, *message; } bad[] = {
        { "newmtl a\nKd\n", "bad number after Kd (line 2)" },
        { "newmtl a\n\nKd 1 1 x\n", "bad number after Kd (line 3)" },
        { "newmtl a\nd one\n", "bad number after d (line 2)" },
    };
    for (size_t i = 0; i < COUNT(bad); i++) {
        f = (struct failure){ 0 };
        CHECK(!mtl_parse((const uint8_t *)bad[i].text, strlen(bad[i].text), &library, &m, &f));
        CHECK(same_text(f.text, bad[i].message));
        mtl_library_free(&library);
        model_free(&m);
    }
}

static void test_obj_pictures_that_are_missing_warn_and_others_fail(void)
{
    struct model m;
    struct failure f = { 0 };
    char path[200];
    snprintf(path, sizeof path, "%slost.obj", corpus);
    if (CHECK(model_load(path, &m, &f))) {
        CHECK(strstr(m.warning, "gone.mtl") != NULL);           /* the first of them */
        CHECK_EQ(m.image_count, 0);
        CHECK(m.material[0].image == -1 && m.material[1].image == -1);
        CHECK(SAME_FLOATS(m.material[0].base, 0, 1, 0, 0, 1));
        model_free(&m);
    }
    snprintf(path, sizeof path, "%sgrey.obj", corpus);
    if (CHECK(model_load(path, &m, &f))) {
        CHECK(m.image_count == 1 && m.image[0].width == 8 && m.image[0].rgba[0] == 200);
        model_free(&m);
    }
    snprintf(path, sizeof path, "%sphoto.obj", corpus);
    CHECK(!model_load(path, &m, &f));
    CHECK(same_text(f.text, "photo.jpg: file ends early (in segment 0xE0)"));
    f = (struct failure){ 0 };
    snprintf(path, sizeof path, "%stext.glb", corpus);
    CHECK(!model_load(path, &m, &f));
    CHECK(same_text(f.text, "not glTF: begins neither like a GLB nor like JSON"));
}

static void test_obj_mistakes_are_refused_with_their_line(void)
{
    static const struct { const char *text, *message; } cases[] = {
        { "v 0 0\n", "v needs 3 numbers (line 1)" },
        { "\n\nv 0 0 x\n", "bad number 'x' (line 3)" },
        { "v 0 0 nano\n", "bad number 'nano' (line 1)" },
        { "v 0 0 infinite\n", "bad number 'infinite' (line 1)" },
        { "v 0 0 nan\nv 0 0 -inf\nf 1 2 1\n", "holds no face of three corners that are numbers" },
        { "v 0 0 0\ncstype bezier\n", "holds no faces, only free-form curves and surfaces" },
        { "v 0 0 1e39\n", "bad number '1e39' (line 1)" },
        { "v 0 0 0x1\n", "bad number '0x1' (line 1)" },
        { "v 0 0 0\nv 0 0 0\nv \\\n0 0 0\nf 1 2 4\n", "face refers to 4 of 3 (line 5)" },
        { "v 0 0 0\nf 1 1 0\n", "face refers to 0 of 1 (line 2)" },
        { "v 0 0 0\nf 1 1 -2\n", "face refers to -2 of 1 (line 2)" },
        { "v 0 0 0\nf 1 1 99999999999999999999999\n", "face refers to " },
        { "v 0 0 0\nf 1/1 1/1 1/1\n", "face refers to 1 of 0 (line 2)" },
        { "v 0 0 0\nf 1 1\n", "holds no face of three corners that are numbers" },
        { "v 0 0 0\nf 1 1 /\n", "bad face '/' (line 2)" },
        { "v 0 0 0\nf 1 1 1/1/1/1\n", "face refers to 1 of 0 (line 2)" },
        { "v 0 0 0\nf 1 1 1a\n", "bad face '1a' (line 2)" },
        { "v 0 0 0\nf 1 1 -\n", "bad face '-' (line 2)" },
        { "v 0 0 0\n", "holds no faces (if it is an OBJ file at all)" },
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct model m;
        struct failure f = { 0 };
        CHECK(!model_parse((const uint8_t *)cases[i].text, strlen(cases[i].text), NULL, &m, &f));
        if (cases[i].message[strlen(cases[i].message) - 1] == ' ')
            f.text[strlen(cases[i].message)] = '\0';
        CHECK(same_text(f.text, cases[i].message));
        CHECK(m.node == NULL && m.material == NULL);
    }
}

static void test_obj_with_very_many_groups_stays_fast(void)
{
    enum { N = 50000, ROOM = 4000000 };
    char *text = malloc(ROOM), *at = text;
    struct model m;
    REQUIRE(text != NULL);
    at += sprintf(at, "v 0 0 0\nv 1 0 0\nv 1 1 0\n");
    for (int i = 0; i < N; i++)
        at += sprintf(at, "o thing%d\ng part%d\nusemtl m%d\nf 1 2 3\n", i, i % 7, i % 1000);
    clock_t start = clock();
    if (CHECK(parses(text, &m))) {
        CHECK_EQ(m.node_count, 2 * N);
        model_free(&m);
    }
    CHECK((double)(clock() - start) / CLOCKS_PER_SEC < 5);
    free(text);
}

#include "build/suites/model.h"
