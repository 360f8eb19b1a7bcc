/* SPDX-License-Identifier: MIT */
/* test_foreign.c - files as other programs write them: extensions that smear has never heard of, instances, buffers of which
 * nothing is there, OBJ with numbers that are none. Each is drawn from a generator, which knows what has to become of it: it
 * is drawn, and what it is drawn without is named, or it is refused by name. FOREIGN_FILES=n draws n of each kind. */
#include "tests/host.h"
#include "tests/ref/glb.h"

#include "tools/image/buffer.h"
#include "tools/model/model.h"
#include "tools/model/obj.h"

static int files_of_each(void)
{
    return (int)number_from("FOREIGN_FILES", 1000);
}

/* ------------------------------------------------------------------ texts and files */

static struct buffer text, bin;
#define add(...) buffer_print(&text, __VA_ARGS__)

/* The text as a string. */
static const char *said(void)
{
    buffer_byte(&text, 0);
    text.size--;
    return (const char *)text.data;
}

static void put(uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        buffer_byte(&bin, value >> 8 * i & 255);
}

static void put_float(double value)
{
    float number = (float)value;
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    put(word, 4);
}

/* A GLB of the text, with ' for ", and of `bin`. */
static bool parse_glb(struct model *m, struct failure *f)
{
    size_t size;
    uint8_t *glb = glb_make(said(), bin.data, bin.size, &size);
    *f = (struct failure){ "" };
    bool ok = model_parse(glb, size, NULL, m, f);
    free(glb);
    return ok;
}

/* How often `name` stands in the list, where names end in no letter, digit or underscore. */
static int count_name(const char *list, const char *name)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    int count = 0;
    for (const char *at = strstr(list, name); at != NULL; at = strstr(at + 1, name)) {
        char behind = at[strlen(name)];
        bool begins = at == list || strchr(letters, at[-1]) == NULL;
        count += begins && (behind == '\0' || strchr(letters, behind) == NULL);
    }
    return count;
}

/* One triangle, as positions in view and accessor 0. */
static void begin_triangle(void)
{
    static const float corner[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    text.size = bin.size = 0;
    for (int i = 0; i < 9; i++)
        put_float((double)corner[i]);
}

/* ------------------------------------------------------------------ extensions */

enum fate { READ, NOTE, LOOK, REFUSED };

static const struct { const char *name; enum fate fate; } known[] = {
    { "KHR_materials_unlit", READ }, { "KHR_texture_transform", READ }, { "KHR_mesh_quantization", READ },
    { "EXT_mesh_gpu_instancing", READ }, { "KHR_materials_pbrSpecularGlossiness", READ },
    { "KHR_materials_transmission", LOOK }, { "KHR_materials_volume", LOOK }, { "KHR_materials_dispersion", LOOK },
    { "KHR_materials_diffuse_transmission", LOOK }, { "KHR_materials_anisotropy", LOOK }, { "KHR_materials_iridescence", LOOK },
    { "KHR_materials_ior", LOOK }, { "KHR_materials_specular", LOOK }, { "KHR_materials_sheen", LOOK },
    { "KHR_materials_clearcoat", LOOK }, { "KHR_materials_emissive_strength", LOOK }, { "KHR_lights_punctual", READ },
    { "VRM", LOOK }, { "VRMC_vrm", LOOK }, { "VRMC_materials_mtoon", LOOK }, { "CESIUM_primitive_outline", LOOK },
    { "EXT_lights_image_based", LOOK }, { "KHR_animation_pointer", LOOK },
    { "EXT_structural_metadata", NOTE }, { "EXT_mesh_features", NOTE }, { "EXT_instance_features", NOTE },
    { "KHR_materials_variants", NOTE }, { "KHR_xmp", NOTE }, { "KHR_xmp_json_ld", NOTE }, { "MSFT_lod", NOTE },
    { "KHR_audio_emitter", NOTE }, { "AGI_articulations", NOTE }, { "AGI_stk_metadata", NOTE },
    { "KHR_draco_mesh_compression", REFUSED }, { "EXT_meshopt_compression", REFUSED }, { "KHR_meshopt_compression", REFUSED },
    { "KHR_texture_basisu", REFUSED }, { "EXT_texture_webp", REFUSED }, { "EXT_texture_avif", REFUSED },
    { "MSFT_texture_dds", REFUSED },
};
enum { KNOWN = sizeof known / sizeof known[0], UNKNOWN = 5, NAMES = KNOWN + UNKNOWN };

/* Those that nobody has written yet can't be drawn where they are required, and change who knows what where not. */
static const char *const unknown[UNKNOWN] = { "KHR_material", "EXT_mesh_gpu_instancing2", "VRM2", "ACME_wobble", "x" };

static const char *name_of(int i)
{
    return i < KNOWN ? known[i].name : unknown[i - KNOWN];
}

/* A list of names, some of them twice, of which all in `must` are; *set has a bit for each name that is in it. */
static void add_names(const char *key, int count, uint64_t must, uint64_t *set, int *refused)
{
    *set = 0;
    *refused = -1;
    add("'%s':[", key);
    for (int i = 0; i < count; i++) {
        int n = between(0, NAMES - 1);
        if (must == 0 && chance(4) && i > 0)            /* required ones: refused ones are rare, or nothing else would be seen */
            n = between(0, KNOWN - 8);
        *set |= (uint64_t)1 << n;
        if (*refused < 0 && (n >= KNOWN || known[n].fate == REFUSED))
            *refused = n;
        add("%s'%s'", i > 0 ? "," : "", name_of(n));
    }
    for (int n = 0; n < NAMES; n++)
        if ((must >> n & 1) != 0 && (*set >> n & 1) == 0) {
            *set |= (uint64_t)1 << n;
            add("%s'%s'", text.data[text.size - 1] != '[' ? "," : "", name_of(n));
        }
    add("],");
}

static bool check_names(const struct model *m, uint64_t required, uint64_t used)
{
    for (int n = 0; n < NAMES; n++) {
        bool is_required = (required >> n & 1) != 0, is_used = (used >> n & 1) != 0;
        bool is_told = n >= KNOWN                ? is_used
                     : known[n].fate == LOOK ? is_required || is_used
                                             : known[n].fate == NOTE && is_required;
        if (count_name(m->warning, name_of(n)) != is_told)
            return false;
    }
    return true;
}

static void test_extensions_are_read_or_named_or_refused(void)
{
    int drawn = 0, refused_count = 0;
    random_state = 1;
    for (int i = 0; i < files_of_each(); i++) {
        uint64_t required = 0, used = 0;
        int refused = -1, ignored;
        struct model m;
        struct failure f;
        begin_triangle();
        add("{'asset':{'version':'2.0'},");
        if (!chance(4))
            add_names("extensionsRequired", chance(2) ? between(0, 2) : between(0, 8), 0, &required, &refused);
        if (!chance(8))
            add_names("extensionsUsed", between(0, 10), chance(4) ? 0 : required, &used, &ignored);
        add("'buffers':[{'byteLength':36}],'bufferViews':[{'buffer':0,'byteLength':36}],'accessors':[{'bufferView':0,"
            "'componentType':5126,'count':3,'type':'VEC3'}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
            "'nodes':[{'mesh':0}]}");
        if (parse_glb(&m, &f)) {
            drawn++;
            if (!CHECK(refused < 0 && m.mesh[0].primitive_count == 1 && check_names(&m, required, used)))
                test_print(m.warning);
            model_free(&m);
        } else {
            refused_count++;
            if (!CHECK(refused >= 0 && count_name(f.text, name_of(refused)) == 1))
                test_print(f.text);
        }
    }
    CHECK(drawn > files_of_each() / 8 && refused_count > files_of_each() / 8);
}

/* ------------------------------------------------------------------ bytes that are not there */

static void test_what_lies_in_an_extension_alone_is_refused_by_its_name(void)
{
    random_state = 2;
    for (int i = 0; i < files_of_each(); i++) {
        static const char *const packers[] = { NULL, "EXT_meshopt_compression", "KHR_meshopt_compression" };
        const char *packer = packers[between(0, 2)];
        int empty = between(0, 3), view_of = between(0, empty);
        bool is_draco = chance(3), has_view = !is_draco || chance(2);
        struct model m;
        struct failure f;
        begin_triangle();
        add("{'asset':{'version':'2.0'},'extensionsUsed':['KHR_draco_mesh_compression'],'buffers':[{'byteLength':36}");
        for (int k = 0; k < empty; k++)
            add(",{'byteLength':%d}", between(36, 1000));
        add("],'bufferViews':[{'buffer':%d,'byteLength':36", view_of);
        if (packer != NULL)
            add(",'extensions':{'%s':{'buffer':0,'byteLength':30,'byteStride':12,'mode':'ATTRIBUTES','count':3}}", packer);
        add("}],'accessors':[{%s'componentType':5126,'count':3,'type':'VEC3'}],'meshes':[{'primitives':[{'attributes':"
            "{'POSITION':0}%s}]}],'nodes':[{'mesh':0}]}", has_view ? "'bufferView':0," : "",
            is_draco ? ",'extensions':{'KHR_draco_mesh_compression':{'bufferView':0,'attributes':{'POSITION':0}}}" : "");
        bool ok = parse_glb(&m, &f);
        bool is_there = has_view && view_of == 0;
        if (!CHECK(ok == is_there))
            test_print(said());
        if (!ok && has_view && packer != NULL)
            CHECK(count_name(f.text, packer) == 1);
        else if (!ok && has_view)
            CHECK(strstr(f.text, "neither a uri nor a BIN chunk (accessors[0].bufferView)") != NULL);
        else if (!ok)
            CHECK(count_name(f.text, "KHR_draco_mesh_compression") == 1);
        if (ok)
            model_free(&m);
    }
}

/* ------------------------------------------------------------------ instances */

struct place {
    double t[3], q[4], s[3];
};

static void turn(const double q[4], const double v[3], double out[3])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double m[9] = { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                          2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                          2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) };
    for (int i = 0; i < 3; i++)
        out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

static void apply(const struct place *p, const double in[3], double out[3])
{
    const double scaled[3] = { in[0] * p->s[0], in[1] * p->s[1], in[2] * p->s[2] };
    turn(p->q, scaled, out);
    for (int i = 0; i < 3; i++)
        out[i] += p->t[i];
}

static void unit(double q[4])
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] /= length;
}

static struct place random_place(void)
{
    struct place p = { .q = { 0, 0, 0, 1 }, .s = { 1, 1, 1 } };
    for (int i = 0; i < 3; i++) {
        p.t[i] = uniform(-10, 10);
        p.s[i] = uniform(-2, 2);
    }
    do
        for (int i = 0; i < 4; i++)
            p.q[i] = uniform(-1, 1);
    while (fabs(p.q[0]) + fabs(p.q[1]) + fabs(p.q[2]) + fabs(p.q[3]) < 0.1);
    unit(p.q);
    return p;
}

/* A view and an accessor of `width` numbers per element. Integers are normalised, and value[] becomes what they stand for. */
static int add_accessor(int *count, int component, int width, int elements, double *value, size_t apart)
{
    const int bytes = component == 5126 ? 4 : component == 5120 ? 1 : 2, step = (bytes * width + 3) / 4 * 4;
    const double most = component == 5120 ? 127 : 32767;
    size_t first = bin.size;
    for (int i = 0; i < elements; i++) {
        double *v = value + (size_t)i * apart;
        for (int k = 0; k < width; k++) {
            if (component == 5126) {
                put_float(v[k]);
                v[k] = (double)(float)v[k];
            } else {
                int whole = (int)lround(v[k] * most);
                put((uint32_t)whole, bytes);
                v[k] = (double)(float)(whole / most);
            }
        }
        put(0, step - bytes * width);
    }
    add("%s{'buffer':0,'byteOffset':%zu,'byteLength':%d,'byteStride':%d}", *count > 0 ? "," : "", first, step * elements, step);
    return (*count)++;
}

struct instanced {
    struct place parent, node, at[40];
    int count, width[3], component[3];
    bool has[3], is_animated;
    double from[3], to[3];      /* of the node's translation, in one second */
};

static void make_instanced(struct instanced *w)
{
    static const int components[3] = { 5126, 5120, 5122 };
    *w = (struct instanced){ .parent = random_place(), .node = random_place(), .count = between(1, 40),
                             .is_animated = chance(2), .width = { 3, 4, 3 } };
    for (int k = 0; k < 3; k++) {
        w->has[k] = !chance(3);
        w->component[k] = k == 1 ? components[between(0, 2)] : 5126;
        w->from[k] = uniform(-5, 5);
        w->to[k] = uniform(-5, 5);
    }
    w->has[between(0, 2)] = true;
    for (int i = 0; i < w->count; i++) {
        struct place p = random_place(), none = { .q = { 0, 0, 0, 1 }, .s = { 1, 1, 1 } };
        w->at[i] = none;
        if (w->has[0])
            memcpy(w->at[i].t, p.t, sizeof p.t);
        if (w->has[1])
            memcpy(w->at[i].q, p.q, sizeof p.q);
        if (w->has[2])
            memcpy(w->at[i].s, p.s, sizeof p.s);
    }
}

static void add_place(const struct place *p, bool with_translation)
{
    if (with_translation)
        add("'translation':[%.17g,%.17g,%.17g],", p->t[0], p->t[1], p->t[2]);
    add("'rotation':[%.17g,%.17g,%.17g,%.17g],'scale':[%.17g,%.17g,%.17g]", p->q[0], p->q[1], p->q[2], p->q[3], p->s[0], p->s[1],
        p->s[2]);
}

static bool load_instanced(struct instanced *w, struct model *m)
{
    static const char *const keys[3] = { "TRANSLATION", "ROTATION", "SCALE" };
    static const char *const types[3] = { "VEC3", "VEC4", "VEC3" };
    double *value[3] = { w->at[0].t, w->at[0].q, w->at[0].s };
    double times[2] = { 0, 1 };
    int views = 1, first[3] = { 0 }, next = 1, input, output;
    struct failure f;
    begin_triangle();
    add("{'asset':{'version':'2.0'},'extensionsRequired':['EXT_mesh_gpu_instancing'],'bufferViews':"
        "[{'buffer':0,'byteOffset':0,'byteLength':36}");
    for (int k = 0; k < 3; k++)
        if (w->has[k])
            first[k] = add_accessor(&views, w->component[k], w->width[k], w->count, value[k], sizeof w->at[0] / sizeof(double));
    for (int i = 0; i < w->count; i++)
        unit(w->at[i].q);
    input = add_accessor(&views, 5126, 1, 2, times, 1);
    double way[6] = { w->from[0], w->from[1], w->from[2], w->to[0], w->to[1], w->to[2] };
    output = add_accessor(&views, 5126, 3, 2, way, 3);
    add("],'buffers':[{'byteLength':%zu}],'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}", bin.size);
    for (int k = 0; k < 3; k++)
        if (w->has[k]) {
            add(",{'bufferView':%d,'componentType':%d,'count':%d,'type':'%s'%s}", first[k], w->component[k], w->count, types[k],
                w->component[k] != 5126 ? ",'normalized':true" : "");
            first[k] = next++;
        }
    add(",{'bufferView':%d,'componentType':5126,'count':2,'type':'SCALAR'},{'bufferView':%d,'componentType':5126,'count':2,"
        "'type':'VEC3'}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'nodes':[{'children':[1],", input, output);
    add_place(&w->parent, true);
    add("},{'name':'flock','mesh':0,");
    add_place(&w->node, true);
    add(",'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'_ID':0");
    for (int k = 0; k < 3; k++)
        if (w->has[k])
            add(",'%s':%d", keys[k], first[k]);
    add("}}}},{'name':'one','mesh':0}]");
    if (w->is_animated)
        add(",'animations':[{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'node':1,"
            "'path':'translation'}}]}]", next, next + 1);
    add("}");
    bool ok = parse_glb(m, &f);
    if (!CHECK(ok))
        test_print(f.text);
    return ok;
}

/* The triangle's corners under the transforms of an instance, its node and that one's parent. */
static bool is_where_it_should(const struct instanced *w, int i, double time, const struct model_draw *d)
{
    struct place node = w->node;
    for (int k = 0; k < 3 && w->is_animated; k++)
        node.t[k] = (double)(float)w->from[k] * (1 - time) + (double)(float)w->to[k] * time;
    for (int v = 0; v < 3; v++) {
        const float *p = d->position + 3 * v;
        double at[3] = { (double)p[0], (double)p[1], (double)p[2] }, a[3], b[3], want[3];
        apply(&w->at[i], at, a);
        apply(&node, a, b);
        apply(&w->parent, b, want);
        for (int k = 0; k < 3; k++) {
            double got = d->world[k] * at[0] + d->world[4 + k] * at[1] + d->world[8 + k] * at[2] + d->world[12 + k];
            if (!(fabs(got - want[k]) < 1e-7))
                return false;
        }
    }
    return true;
}

static void test_each_instance_is_drawn_and_moves_with_its_node(void)
{
    static struct instanced w;
    random_state = 3;
    for (int n = 0; n < files_of_each(); n++) {
        struct model m OWNED(model_free) = { 0 };
        struct model_pose pose OWNED(model_pose_free) = { 0 };
        struct failure f = { "" };
        make_instanced(&w);
        END_UNLESS(load_instanced(&w, &m));
        double time = w.is_animated ? uniform(0, 1) : 0;
        int seen = 0, node = model_find_node(&m, "flock");
        if (CHECK(model_pose(&m, w.is_animated ? 0 : MODEL_CLIP_NONE, time, false, &pose, &f)))
            for (int i = 0; i < pose.draw_count; i++) {
                bool is_one = !model_node_is_under(&m, pose.draw[i].node, node);
                if (!is_one && !CHECK(seen < w.count && is_where_it_should(&w, seen, time, &pose.draw[i])))
                    break;
                seen += !is_one;
            }
        CHECK_EQ(seen, w.count);
        CHECK_EQ(pose.draw_count, w.count + 1);
        CHECK(m.warning[0] == '\0');
    }
}

static void test_instances_keep_the_morph_weights_of_their_mesh(void)
{
    static const float target[9] = { 0, 0, 8, 0, 0, 8, 0, 0, 8 }, weights[2] = { 0, 1 };
    struct model m OWNED(model_free) = { 0 };
    struct model_pose pose OWNED(model_pose_free) = { 0 };
    struct failure f = { "" };
    begin_triangle();
    for (int i = 0; i < 9; i++)
        put_float((double)target[i]);
    for (int i = 0; i < 2; i++)
        put_float((double)weights[i]);
    add("{'asset':{'version':'2.0'},'buffers':[{'byteLength':80}],'bufferViews':[{'buffer':0,'byteLength':36},"
        "{'buffer':0,'byteOffset':36,'byteLength':36},{'buffer':0,'byteOffset':72,'byteLength':8}],'accessors':["
        "{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},{'bufferView':1,'componentType':5126,'count':3,"
        "'type':'VEC3'},{'bufferView':2,'componentType':5126,'count':2,'type':'SCALAR'}],'meshes':[{'weights':[0.125],"
        "'primitives':[{'attributes':{'POSITION':0},'targets':[{'POSITION':1}]}]}],'nodes':[{'mesh':0,'weights':[0.5],"
        "'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':0}}}}],'animations':[{'samplers':"
        "[{'input':2,'output':2}],'channels':[{'sampler':0,'target':{'node':0,'path':'weights'}}]}]}");
    REQUIRE(parse_glb(&m, &f));
    for (int moves = 0; moves < 2; moves++) {
        double time = 0.75, weight = moves ? time : 0.5;
        if (!CHECK(model_pose(&m, moves ? 0 : MODEL_CLIP_NONE, time, false, &pose, &f)) || !CHECK_EQ(pose.draw_count, 3))
            break;
        for (int i = 0; i < 3; i++)
            CHECK_CLOSE((double)pose.draw[i].position[2], 8 * weight, 1e-6);
    }
}

static void test_the_diffuse_part_of_specular_and_glossiness_is_the_base_colour(void)
{
    struct model m OWNED(model_free) = { 0 };
    struct failure f = { "" };
    begin_triangle();
    add("{'asset':{'version':'2.0'},'extensionsRequired':['KHR_materials_pbrSpecularGlossiness'],'buffers':[{'byteLength':36}],"
        "'bufferViews':[{'buffer':0,'byteLength':36}],'accessors':[{'bufferView':0,'componentType':5126,'count':3,"
        "'type':'VEC3'}],'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[1,0,0,1]},'extensions':"
        "{'KHR_materials_pbrSpecularGlossiness':{'diffuseFactor':[0.25,0.5,0.75,1],'glossinessFactor':0.5}}}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}],'nodes':[{'mesh':0}]}");
    REQUIRE(parse_glb(&m, &f));
    CHECK_CLOSE((double)m.material[0].base[0], 0.25, 0);
    CHECK_CLOSE((double)m.material[0].base[2], 0.75, 0);
    CHECK(m.warning[0] == '\0');
}

/* ------------------------------------------------------------------ OBJ */

/* What a text of the generator has to give. */
struct expected {
    int triangles, vertices, short_faces, broken_faces, normals, uvs, uneven, freeform, others, flat;
};

static const char *no_number(void)
{
    static const char *const words[] = { "nan", "NaN", "-nan", "nan(ind)", "-nan(ind)", "inf", "-inf", "Infinity", "1.#IND",
                                         "-1.#IND", "1.#QNAN", "1.#INF" };
    return words[between(0, 11)];
}

enum { VERTICES = 30, BAD_VERTEX = 7, BAD_NORMAL = 3, NORMALS = 6 };

/* Vertices, of which one may be no number, then texture coordinates and normals, likewise. */
static void add_lists(struct expected *e, bool has_bad)
{
    for (int i = 1; i <= VERTICES; i++) {
        bool is_bad = has_bad && i == BAD_VERTEX;
        add("v %d %s 1", i, is_bad ? no_number() : "0.5");
        if (chance(8))              /* a weight, which means nothing */
            add(" %s", chance(2) ? no_number() : "1");
        add("\n");
        e->vertices += is_bad;
    }
    for (int i = 1; i <= 4; i++) {
        bool is_bad = chance(8);
        add("vt %d %s\n", i, is_bad ? no_number() : "0.25");
        e->uvs += is_bad;
    }
    for (int i = 1; i <= NORMALS; i++) {
        bool is_bad = has_bad && i == BAD_NORMAL;
        add("vn 0 %s 1\n", is_bad ? no_number() : "0");
        e->normals += is_bad;
    }
}

static void add_face(struct expected *e)
{
    int corners = chance(5) ? between(0, 2) : between(3, 6), form = between(0, 3), odd = chance(6) ? between(0, corners) : -1;
    bool is_broken = false, is_flat = false, is_uneven = false;
    add("f");
    for (int i = 0; i < corners; i++) {
        int v = between(1, VERTICES), n = between(1, NORMALS), mine = i == odd ? between(0, 3) : form;
        bool has_uv = mine == 1 || mine == 3, has_normal = mine >= 2;
        is_uneven = is_uneven || ((mine ^ form) != 0 && corners >= 3);
        is_broken = is_broken || (e->vertices > 0 && v == BAD_VERTEX);
        is_flat = is_flat || (has_normal && e->normals > 0 && n == BAD_NORMAL);
        add(" %d", chance(5) ? v - VERTICES - 1 : v);
        if (has_uv || has_normal)
            add(has_uv ? "/%d" : "/", between(1, 4));
        if (has_normal)
            add("/%d%s", n, chance(4) ? "/7" : "");
    }
    add("\n");
    e->short_faces += corners < 3;
    e->broken_faces += corners >= 3 && is_broken;
    if (corners < 3 || is_broken)
        return;
    e->triangles += corners - 2;
    e->uneven += is_uneven;
    e->flat += form >= 2 && is_flat ? corners - 2 : 0;
}

static void add_other(struct expected *e)
{
    static const char *const freeform[] = { "vp 0 0", "cstype rat bspline", "deg 3", "curv 0 1 1 2 3", "curv2 1 2", "surf 0 1 0 1 1",
                                            "parm u 0 1", "trim 0 1 1", "hole 0 1 1", "scrv 0 1 1", "sp 1", "end", "con 1 0 1 1 2 0 1 1",
                                            "bmat u 1 0 0 1", "step 1 1" };
    static const char *const lines[] = { "l 1 2 3", "p 1" }, *const harmless[] = { "s off", "g a", "", "# comment", "bevel off" };
    int kind = between(0, 2);
    add("%s\n", kind == 0 ? freeform[between(0, 14)] : kind == 1 ? lines[between(0, 1)] : harmless[between(0, 4)]);
    e->freeform += kind == 0;
    e->others += kind == 1;
}

/* Whether `count` of it are told in the warning, or nothing where there are none. */
static bool tells(const char *warning, int count, const char *one, const char *several)
{
    char line[160];
    bool has_one = strstr(warning, one) != NULL, has_several = strstr(warning, several) != NULL;
    snprintf(line, sizeof line, "%d %s", count, count == 1 ? one : several);
    return count == 0 ? !has_one && !has_several : strstr(warning, line) != NULL;
}

static bool tells_all(const char *w, const struct expected *e)
{
    return tells(w, e->vertices, "vertex is no number", "vertices are no numbers") &&
           tells(w, e->broken_faces, "face with such a corner", "faces with such corners") &&
           tells(w, e->short_faces, "face of fewer", "faces of fewer") &&
           tells(w, e->normals, "normal is no number", "normals are no numbers") &&
           tells(w, e->uvs, "texture coordinate is no", "texture coordinates are no") &&
           tells(w, e->uneven, "face has texture", "faces have texture") &&
           tells(w, e->freeform, "statement of", "statements of") &&
           tells(w, e->others, "primitive holds no", "primitives hold no");
}

static int count_triangles(const struct model *m)
{
    int count = 0;
    for (int i = 0; i < m->mesh_count; i++)
        for (int k = 0; k < m->mesh[i].primitive_count; k++) {
            const struct model_primitive *p = &m->mesh[i].primitive[k];
            count += p->triangle_count;
            for (int n = 0; n < p->vertex_count * 3; n++)
                CHECK(isfinite(p->position[n]) && (p->normal == NULL || isfinite(p->normal[n])));
        }
    return count;
}

static void test_obj_is_drawn_but_for_what_is_no_face(void)
{
    int whole = 0;
    random_state = 4;
    for (int i = 0; i < files_of_each(); i++) {
        struct expected e = { 0 };
        struct model m OWNED(model_free) = { 0 };
        struct failure f = { "" };
        text.size = 0;
        add_lists(&e, chance(2));
        for (int n = between(1, 20); n > 0; n--) {
            if (chance(3))
                add_other(&e);
            else
                add_face(&e);
        }
        bool ok = model_parse(text.data, text.size, NULL, &m, &f);
        if (!CHECK(ok == (e.triangles > 0))) {
            test_print(f.text);
            test_print(said());
        }
        if (!ok)
            continue;
        whole += m.warning[0] == '\0';
        CHECK_EQ(count_triangles(&m), e.triangles);
        if (!CHECK(tells_all(m.warning, &e)))
            test_print(m.warning);
    }
    CHECK(whole > 0);
}

static void test_a_face_with_a_normal_that_is_none_is_flat(void)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn nan nan nan\nf 1//1 2//1 3//1\nf 1//1 2//2 3//1\n";
    struct model m OWNED(model_free) = { 0 };
    struct failure f = { "" };
    REQUIRE(model_parse((const uint8_t *)obj, sizeof obj - 1, NULL, &m, &f));
    CHECK_EQ(m.mesh[0].primitive_count, 2);
    CHECK(m.mesh[0].primitive[0].normal != NULL && m.mesh[0].primitive[1].normal == NULL);
}

/* d counts before Tr; what would be invisible is opaque, and is told. */
static void test_materials_mean_what_their_writers_meant(void)
{
    random_state = 5;
    for (int i = 0; i < files_of_each(); i++) {
        static const double steps[] = { 0, 0.25, 0.5, 1 };
        struct mtl_library library = { 0 };
        struct model m OWNED(model_free) = { 0 };
        struct failure f = { "" };
        double alpha = 1, color = 1;
        bool has_d = false, has_map = false;
        text.size = 0;
        add("newmtl m\n");
        for (int n = between(0, 5); n > 0; n--) {
            double value = steps[between(0, 3)];
            switch (between(0, 3)) {
            case 0:
                add("d %g\n", value);
                alpha = value;
                has_d = true;
                break;
            case 1:
                add("Tr %g\n", value);
                alpha = has_d ? alpha : 1 - value;
                break;
            case 2:
                add("Kd %g %g %g\n", value, value, value);
                color = value;
                break;
            default:
                add("map_Kd a.png\n");
                has_map = true;
            }
        }
        if (!CHECK(mtl_parse(text.data, text.size, &library, &m, &f)))
            break;
        library.material[0].is_drawn = true;
        mtl_settle(&library, &m);
        const struct model_material *got = &m.material[0];
        CHECK_CLOSE((double)got->base[3], alpha > 0 ? alpha : 1, 0);
        CHECK(got->alpha == (alpha > 0 && alpha < 1 ? MODEL_ALPHA_BLEND : MODEL_ALPHA_OPAQUE));
        CHECK((m.warning[0] != '\0') == !(alpha > 0));
        CHECK_CLOSE((double)got->base[0], has_map && !(color > 0) ? 1 : color, 0);
        mtl_library_free(&library);
    }
}

#include "build/suites/foreign.h"
