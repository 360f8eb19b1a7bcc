/* SPDX-License-Identifier: MIT */
/* hostile.c - files that ask for as much memory and time as their size allows, one way each: what strangers.sh gives to
 * every command.
 *
 *     hostile KIND BYTES > FILE        about so many bytes
 *     hostile                          the kinds, a line each, with the ending of its files
 */
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bytes {
    uint8_t *at;
    size_t size, room;
};

static void put(struct bytes *b, const void *from, size_t size)
{
    if (b->size + size > b->room) {
        b->room = (b->size + size) * 2;
        b->at = realloc(b->at, b->room);
        if (b->at == NULL)
            exit(1);
    }
    memcpy(b->at + b->size, from, size);
    b->size += size;
}

__attribute__((format(printf, 2, 3))) static void say(struct bytes *b, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    int length = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    put(b, text, (size_t)length);
}

static void put32(struct bytes *b, uint32_t value)
{
    const uint8_t four[4] = { (uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16), (uint8_t)(value >> 24) };
    put(b, four, 4);
}

static void put_float(struct bytes *b, float value)
{
    uint32_t word;
    memcpy(&word, &value, 4);
    put32(b, word);
}

static uint32_t state = 1;

static uint32_t any(uint32_t below)
{
    state = state * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)state * below >> 32);
}

static float any_place(void)
{
    return (float)any(20000) / 10000.0f - 1.0f;
}

/* ------------------------------------------------------------------ GLB: JSON and bytes */

/* A file of nodes, meshes and the like: `more` says what stands in it besides. Views are of the whole of `bin` from
 * their offset on. */
struct glb {
    struct bytes json, bin;
    size_t limit;
};

static void write_glb(struct glb *g, FILE *to)
{
    struct bytes out = { 0 };
    while (g->json.size % 4 != 0)
        put(&g->json, " ", 1);
    while (g->bin.size % 4 != 0)
        put(&g->bin, "", 1);
    put(&out, "glTF", 4);
    put32(&out, 2);
    put32(&out, (uint32_t)(12 + 8 + g->json.size + (g->bin.size > 0 ? 8 + g->bin.size : 0)));
    put32(&out, (uint32_t)g->json.size);
    put32(&out, 0x4e4f534a);
    put(&out, g->json.at, g->json.size);
    if (g->bin.size > 0) {
        put32(&out, (uint32_t)g->bin.size);
        put32(&out, 0x004e4942);
        put(&out, g->bin.at, g->bin.size);
    }
    fwrite(out.at, 1, out.size, to);
}

/* Corners of `n` triangles at random, and their numbers: accessors 0 and 1. */
static void triangles(struct glb *g, unsigned vertices, unsigned corners)
{
    for (unsigned i = 0; i < vertices * 3; i++)
        put_float(&g->bin, any_place());
    for (unsigned i = 0; i < corners; i++)
        put32(&g->bin, i < vertices ? i : any(vertices));
}

static void begin(struct glb *g)
{
    say(&g->json, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0");
}

/* Accessors 0 (positions) and 1 (indices) of triangles() and the views 0 and 1 behind them. */
static void end(struct glb *g, unsigned vertices, unsigned corners, const char *more)
{
    say(&g->json, ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}%s]", vertices, corners, more);
    say(&g->json, ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":%u},{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}],"
        "\"buffers\":[{\"byteLength\":%zu}]}", vertices * 12, vertices * 12, corners * 4, g->bin.size);
}

static bool fits(const struct glb *g)
{
    return g->json.size + g->bin.size + 2000 < g->limit;
}

static void one_scene(struct glb *g)
{
    say(&g->json, ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]");
}

static void json_deep(struct glb *g)
{
    say(&g->json, "{\"asset\":{\"version\":\"2.0\"},\"extras\":");
    for (size_t i = 0; i < g->limit / 2; i++)
        put(&g->json, "[", 1);
    for (size_t i = 0; i < g->limit / 2; i++)
        put(&g->json, "]", 1);
    put(&g->json, "}", 1);
}

static void json_wide(struct glb *g)
{
    say(&g->json, "{\"asset\":{\"version\":\"2.0\"},\"extras\":[0");
    while (fits(g))
        put(&g->json, ",0", 2);
    put(&g->json, "]}", 2);
}

static void json_keys(struct glb *g)
{
    begin(g);
    for (unsigned i = 0; fits(g); i++)
        say(&g->json, ",\"%x\":0", i);
    put(&g->json, "}", 1);
}

static void json_escapes(struct glb *g)
{
    say(&g->json, "{\"asset\":{\"version\":\"2.0\"},\"extras\":\"");
    while (fits(g))
        say(&g->json, "\\ud83d\\ude00");
    put(&g->json, "\"}", 2);
}

/* Many nodes that show one triangle. */
static void nodes_flat(struct glb *g)
{
    unsigned n = 0;
    triangles(g, 3, 3);
    begin(g);
    say(&g->json, ",\"nodes\":[{}");
    for (; fits(g) && g->json.size < g->limit * 2 / 3; n++)
        say(&g->json, ",{\"mesh\":0}");
    say(&g->json, "],\"scenes\":[{\"nodes\":[0");
    for (unsigned i = 1; i <= n && fits(g); i++)
        say(&g->json, ",%u", i);
    say(&g->json, "]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]");
    end(g, 3, 3, "");
}

/* One below the other. */
static void nodes_deep(struct glb *g)
{
    unsigned n = 0;
    triangles(g, 3, 3);
    begin(g);
    say(&g->json, ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1]}");
    for (n = 1; fits(g); n++)
        say(&g->json, ",{\"mesh\":0,\"children\":[%u]}", n + 1);
    say(&g->json, ",{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]");
    end(g, 3, 3, "");
}

static void primitives(struct glb *g, unsigned vertices, unsigned corners)
{
    triangles(g, vertices, corners);
    begin(g);
    one_scene(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}");
    while (fits(g))
        say(&g->json, ",{\"attributes\":{\"POSITION\":0},\"indices\":1}");
    say(&g->json, "]}]");
    end(g, vertices, corners, "");
}

static void primitives_small(struct glb *g)
{
    primitives(g, 3, 3);
}

static void primitives_large(struct glb *g)
{
    primitives(g, (unsigned)(g->limit / 60), (unsigned)(g->limit / 40));
}

static void primitives_of_materials(struct glb *g)
{
    unsigned n = 0;
    triangles(g, 3, 3);
    begin(g);
    one_scene(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}");
    for (; fits(g) && g->json.size < g->limit / 2; n++)
        say(&g->json, ",{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":%u}", n);
    say(&g->json, "]}],\"materials\":[{}");
    for (unsigned i = 1; i <= n; i++)
        say(&g->json, ",{\"pbrMetallicRoughness\":{\"baseColorFactor\":[%u.%u,0,0,1]}}", 0u, i);
    say(&g->json, "]");
    end(g, 3, 3, "");
}

static void meshes(struct glb *g)
{
    unsigned n = 0;
    triangles(g, 3, 3);
    begin(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}");
    for (; fits(g) && g->json.size < g->limit * 2 / 3; n++)
        say(&g->json, ",{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}");
    say(&g->json, "],\"nodes\":[{\"mesh\":0}");
    for (unsigned i = 1; i <= n && g->json.size < g->limit * 9 / 10; i++)
        say(&g->json, ",{\"mesh\":%u}", i);
    say(&g->json, "],\"scenes\":[{\"nodes\":[0");
    for (unsigned i = 1; i <= n && fits(g); i++)
        say(&g->json, ",%u", i);
    say(&g->json, "]}]");
    end(g, 3, 3, "");
}

/* As many triangles as there is room for. */
static void many_triangles(struct glb *g)
{
    unsigned corners = (unsigned)(g->limit / 6) / 3 * 3, vertices = (unsigned)(g->limit / 40);
    triangles(g, vertices, corners);
    begin(g);
    one_scene(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]");
    end(g, vertices, corners, "");
}

/* More: a strip makes one of each corner. */
static void strip(struct glb *g)
{
    unsigned corners = (unsigned)(g->limit / 5), vertices = (unsigned)(g->limit / 80);
    triangles(g, vertices, corners);
    begin(g);
    one_scene(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0},\"indices\":1}]}]");
    end(g, vertices, corners, "");
}

/* Triangles each of which covers the whole picture. */
static void layers(struct glb *g)
{
    unsigned corners = (unsigned)(g->limit / 5) / 3 * 3;
    const float far[9] = { -99, -99, 0, 99, -99, 0, 0, 99, 0 };
    for (int i = 0; i < 9; i++)
        put_float(&g->bin, far[i]);
    for (unsigned i = 0; i < corners; i++)
        put32(&g->bin, i % 3);
    begin(g);
    say(&g->json, ",\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},{\"camera\":0,\"translation\":[0,0,3]}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}}],\"materials\":[{\"doubleSided\":true,"
        "\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.5]}}]");
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}]");
    end(g, 3, corners, "");
}

/* Shapes that are mixed: targets that are all the same. */
static void targets(struct glb *g)
{
    unsigned n = 0, vertices = (unsigned)(g->limit / 48);
    triangles(g, vertices, vertices / 3 * 3);
    begin(g);
    one_scene(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"targets\":[{\"POSITION\":0}");
    for (; fits(g); n++)
        say(&g->json, ",{\"POSITION\":0}");
    say(&g->json, "]}]}]");
    end(g, vertices, vertices / 3 * 3, "");
}

static void targets_small(struct glb *g)
{
    triangles(g, 3, 3);
    begin(g);
    one_scene(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"targets\":[{\"POSITION\":0}");
    while (fits(g))
        say(&g->json, ",{\"POSITION\":0}");
    say(&g->json, "]}]}]");
    end(g, 3, 3, "");
}

/* One skin of many joints, and many nodes that wear it. */
static void skins(struct glb *g)
{
    unsigned n = 0, joints = (unsigned)(g->limit / 60);
    const float corner[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    for (int i = 0; i < 9; i++)
        put_float(&g->bin, corner[i]);
    for (unsigned i = 0; i < 3; i++)
        put32(&g->bin, i);
    for (unsigned i = 0; i < 12; i++)           /* joints of three vertices, and their weights */
        put(&g->bin, i % 4 == 0 ? "\1\0" : "\0\0", 2);
    for (unsigned i = 0; i < 12; i++)
        put_float(&g->bin, 0.25f);
    begin(g);
    say(&g->json, ",\"nodes\":[{}");
    for (n = 1; fits(g) && g->json.size < g->limit / 2; n++)
        say(&g->json, ",{\"mesh\":0,\"skin\":0}");
    say(&g->json, "],\"scenes\":[{\"nodes\":[0");
    for (unsigned i = 1; i < n && g->json.size < g->limit * 3 / 4; i++)
        say(&g->json, ",%u", i);
    say(&g->json, "]}],\"skins\":[{\"joints\":[0");
    for (unsigned i = 1; i < n && i < joints && i < 60000 && fits(g); i++)
        say(&g->json, ",%u", i);
    say(&g->json, "]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,\"WEIGHTS_0\":3},"
        "\"indices\":1}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5125,\"count\":3,\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5123,\"count\":3,\"type\":\"VEC4\"},"
        "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu}]}", g->bin.size, g->bin.size);
}

static void clip_head(struct glb *g, unsigned keys)
{
    triangles(g, 3, 3);
    for (unsigned i = 0; i < keys; i++)
        put_float(&g->bin, (float)i / 64.0f);
    for (unsigned i = 0; i < keys * 3; i++)
        put_float(&g->bin, any_place());
    begin(g);
    say(&g->json, ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"
        ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5125,\"count\":3,\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5126,\"count\":%u,\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":%u,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu}]", keys, 48 + keys * 4, keys,
        g->bin.size, g->bin.size);
}

static void keys(struct glb *g)
{
    clip_head(g, (unsigned)(g->limit / 17));
    one_scene(g);
    say(&g->json, ",\"animations\":[{\"samplers\":[{\"input\":2,\"output\":3}],\"channels\":[{\"sampler\":0,\"target\":"
        "{\"node\":0,\"path\":\"translation\"}}]}]}");
}

/* Channels that share their keys. */
static void channels(struct glb *g)
{
    unsigned n = 0;
    clip_head(g, 1000);
    say(&g->json, ",\"nodes\":[{\"mesh\":0}");
    for (; g->json.size < g->limit / 4; n++)
        say(&g->json, ",{\"mesh\":0}");
    say(&g->json, "],\"scenes\":[{\"nodes\":[0");
    for (unsigned i = 1; i <= n && g->json.size < g->limit / 2; i++)
        say(&g->json, ",%u", i);
    say(&g->json, "]}],\"animations\":[{\"samplers\":[{\"input\":2,\"output\":3}],\"channels\":[{\"sampler\":0,\"target\":"
        "{\"node\":0,\"path\":\"translation\"}}");
    for (unsigned i = 1; i <= n && fits(g); i++)
        say(&g->json, ",{\"sampler\":0,\"target\":{\"node\":%u,\"path\":\"translation\"}}", i);
    say(&g->json, "]}]}");
}

static void clips(struct glb *g)
{
    clip_head(g, 100);
    one_scene(g);
    say(&g->json, ",\"animations\":[{\"samplers\":[],\"channels\":[]}");
    while (fits(g))
        say(&g->json, ",{\"samplers\":[{\"input\":2,\"output\":3}],\"channels\":[{\"sampler\":0,\"target\":"
            "{\"node\":0,\"path\":\"translation\"}}]}");
    say(&g->json, "]}");
}

/* ------------------------------------------------------------------ OBJ */

static const char corners[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

static void obj_vertices(struct glb *g)
{
    while (g->json.size + 40 < g->limit)
        say(&g->json, "v %u %u 1\n", any(10), any(10));
    say(&g->json, "f 1 2 3\n");
}

static void obj_faces(struct glb *g)
{
    say(&g->json, corners);
    while (g->json.size + 40 < g->limit)
        say(&g->json, "f 1 2 3\n");
}

static void obj_polygon(struct glb *g)
{
    say(&g->json, "%sf", corners);
    while (g->json.size + 40 < g->limit)
        say(&g->json, " %u", 1 + any(3));
    say(&g->json, "\n");
}

static void obj_groups(struct glb *g)
{
    say(&g->json, corners);
    for (unsigned i = 0; g->json.size + 40 < g->limit; i++)
        say(&g->json, "g %x\nf 1 2 3\n", i);
}

static void obj_objects(struct glb *g)
{
    say(&g->json, corners);
    for (unsigned i = 0; g->json.size + 40 < g->limit; i++)
        say(&g->json, "o %x\ng %x\nf 1 2 3\n", i, i);
}

static void obj_materials(struct glb *g)
{
    say(&g->json, corners);
    for (unsigned i = 0; g->json.size + 40 < g->limit; i++)
        say(&g->json, "usemtl %x\nf 1 2 3\n", i);
}

/* The file itself again and again. */
static void obj_libraries(struct glb *g)
{
    say(&g->json, corners);
    while (g->json.size + 60 < g->limit)
        say(&g->json, "mtllib obj-libraries.obj\n");
    say(&g->json, "f 1 2 3\n");
}

static void obj_lines(struct glb *g)
{
    say(&g->json, corners);
    while (g->json.size + 60 < g->limit)
        say(&g->json, "\\\n#");
    say(&g->json, "\nf 1 2 3\n");
}

/* ------------------------------------------------------------------ pictures */

static uint32_t crc(uint32_t c, const uint8_t *at, size_t size)
{
    c = ~c;
    for (; size > 0; size--) {
        c ^= *at++;
        for (int i = 0; i < 8; i++)
            c = c >> 1 ^ (c & 1 ? 0xedb88320u : 0);
    }
    return ~c;
}

static void put_high(struct bytes *b, uint32_t value)
{
    const uint8_t four[4] = { (uint8_t)(value >> 24), (uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value };
    put(b, four, 4);
}

static void chunk(struct bytes *out, const char *name, const struct bytes *data)
{
    struct bytes all = { 0 };
    put(&all, name, 4);
    put(&all, data->at, data->size);
    put_high(out, (uint32_t)data->size);
    put(out, all.at, all.size);
    put_high(out, crc(0, all.at, all.size));
    free(all.at);
}

/* Bits of deflate, the lowest first. */
struct bits {
    struct bytes *to;
    uint32_t held;
    int count;
};

static void put_bits(struct bits *b, uint32_t value, int count)
{
    b->held |= value << b->count;
    for (b->count += count; b->count >= 8; b->count -= 8, b->held >>= 8) {
        const uint8_t byte = (uint8_t)b->held;
        put(b->to, &byte, 1);
    }
}

/* `size` zeros in about a thousandth: a literal and matches of 258 by a code whose two symbols take a bit each. */
static void zeros(struct bytes *out, size_t size)
{
    static const uint8_t order[19] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    struct bits b = { .to = out };
    uint32_t sum = 1, high = 0;
    put(out, "\x78\x01", 2);
    put_bits(&b, 5, 3);                         /* the last block, codes of its own */
    put_bits(&b, 286 - 257, 5);
    put_bits(&b, 0, 5);
    put_bits(&b, 14, 4);                        /* 18 lengths of lengths: 18, 1 and 2 have codes */
    for (int i = 0; i < 18; i++)
        put_bits(&b, order[i] == 18 ? 1 : order[i] == 1 || order[i] == 2 ? 2 : 0, 3);
    /* codes: 18 is 0; 1 is 10, 2 is 11, whose bits come the first one first */
    put_bits(&b, 3, 2);                         /* literal 0: 2 bits */
    put_bits(&b, 0, 1), put_bits(&b, 127, 7);   /* 138 zeros */
    put_bits(&b, 0, 1), put_bits(&b, 117 - 11, 7);      /* 117: up to 255 */
    put_bits(&b, 3, 2);                         /* 256, the end: 2 bits */
    put_bits(&b, 0, 1), put_bits(&b, 28 - 11, 7);       /* up to 284 */
    put_bits(&b, 1, 2);                         /* 285, a match of 258: 1 bit */
    put_bits(&b, 1, 2);                         /* distance 1: 1 bit */
    /* codes: 285 is 0, literal 0 is 10, the end is 11 */
    put_bits(&b, 1, 2);
    size_t left = size - 1;
    for (; left >= 258; left -= 258)
        put_bits(&b, 0, 2);
    for (; left > 0; left--)
        put_bits(&b, 1, 2);
    put_bits(&b, 3, 2);
    put_bits(&b, 0, 7);
    high = (uint32_t)(size % 65521);
    put_high(out, high << 16 | sum);
}

static void picture_bomb(struct glb *g)
{
    struct bytes head = { 0 }, data = { 0 }, none = { 0 };
    const uint32_t edge = g->limit < 8000000 ? 4096 : 16384;
    put_high(&head, edge);
    put_high(&head, edge);
    put(&head, "\x10\x06\0\0\0", 5);
    zeros(&data, ((size_t)edge * 8 + 1) * edge);
    put(&g->json, "\x89PNG\r\n\x1a\n", 8);
    chunk(&g->json, "IHDR", &head);
    chunk(&g->json, "IDAT", &data);
    chunk(&g->json, "IEND", &none);
}

/* The largest that is compared. */
static void picture_large(struct glb *g)
{
    struct bytes head = { 0 }, data = { 0 }, none = { 0 };
    put_high(&head, 4096);
    put_high(&head, 2048);
    put(&head, "\x08\x02\0\0\0", 5);
    zeros(&data, ((size_t)4096 * 3 + 1) * 2048);
    put(&g->json, "\x89PNG\r\n\x1a\n", 8);
    chunk(&g->json, "IHDR", &head);
    chunk(&g->json, "IDAT", &data);
    chunk(&g->json, "IEND", &none);
}

static void picture_chunks(struct glb *g)
{
    struct bytes head = { 0 }, none = { 0 };
    put_high(&head, 64);
    put_high(&head, 64);
    put(&head, "\x08\x02\0\0\0", 5);
    put(&g->json, "\x89PNG\r\n\x1a\n", 8);
    chunk(&g->json, "IHDR", &head);
    while (g->json.size + 100 < g->limit)
        chunk(&g->json, "IDAT", &none);
    chunk(&g->json, "IEND", &none);
}

/* A model whose pictures are all one file. */
static void pictures_of(struct glb *g, const struct bytes *file)
{
    triangles(g, 3, 3);
    size_t at = g->bin.size;
    put(&g->bin, file->at, file->size);
    begin(g);
    one_scene(g);
    unsigned n = (unsigned)((g->limit - file->size) / 300);
    n = n > 20000 ? 20000 : n;
    say(&g->json, ",\"images\":[{\"bufferView\":2}");
    for (unsigned i = 1; i < n; i++)
        say(&g->json, ",{\"bufferView\":2}");
    say(&g->json, "],\"textures\":[{\"source\":0}");
    for (unsigned i = 1; i < n; i++)
        say(&g->json, ",{\"source\":%u}", i);
    say(&g->json, "],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}");
    for (unsigned i = 1; i < n; i++)
        say(&g->json, ",{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":%u}}}", i);
    say(&g->json, "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}");
    for (unsigned i = 1; i < n; i++)
        say(&g->json, ",{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":%u}", i);
    say(&g->json, "]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5125,\"count\":3,\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":%zu,"
        "\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu}]}", at, file->size, g->bin.size);
}

static void pictures(struct glb *g)
{
    struct glb bomb = { .limit = 1 };
    picture_bomb(&bomb);
    pictures_of(g, &bomb.json);
}

/* Of one pixel each, behind half of the file. */
static void pictures_chunks(struct glb *g)
{
    struct bytes b = { 0 }, head = { 0 }, data = { 0 }, none = { 0 };
    put_high(&head, 1);
    put_high(&head, 1);
    put(&head, "\x08\x02\0\0\0", 5);
    zeros(&data, 4);
    put(&b, "\x89PNG\r\n\x1a\n", 8);
    chunk(&b, "IHDR", &head);
    while (b.size + 200 < g->limit / 2)
        chunk(&b, "IDAT", &none);
    chunk(&b, "IDAT", &data);
    chunk(&b, "IEND", &none);
    pictures_of(g, &b);
}

/* ------------------------------------------------------------------ JPEG */

/* Quantisation and the frame of three components; codes of a bit: a mean that does not change, and a run of blocks. */
static void begin_jpeg(struct bytes *b, unsigned edge)
{
    const uint8_t frame[] = { 0xff, 0xc2, 0, 17, 8, (uint8_t)(edge >> 8), (uint8_t)edge, (uint8_t)(edge >> 8), (uint8_t)edge, 3,
                              1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0 };
    put(b, "\xff\xd8\xff\xdb\0\x43\0", 7);
    for (int i = 0; i < 64; i++)
        put(b, "\1", 1);
    put(b, frame, sizeof frame);
    put(b, "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 22);
    put(b, "\xff\xc4\0\x14\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xe0", 22);
}

/* The bits `low` of some coefficients, all of them zero: runs of 32,767 blocks, by a bit and 14 more. */
static void jpeg_band(struct bytes *b, unsigned component, unsigned first, unsigned last, unsigned high, unsigned low, unsigned blocks)
{
    const uint8_t scan[] = { 0xff, 0xda, 0, 8, 1, (uint8_t)component, 0, (uint8_t)first, (uint8_t)last, (uint8_t)(high << 4 | low) };
    uint32_t held = 0;
    int count = 0;
    put(b, scan, sizeof scan);
    for (unsigned told = 0; told < blocks; told += 32767)
        for (int i = 0; i < 15; i++) {
            held = held << 1 | (i > 0);
            if (++count % 8 == 0) {
                const uint8_t byte = (uint8_t)held;
                put(b, &byte, 1);
                if (byte == 255)
                    put(b, "", 1);
            }
        }
    put(b, "\x7f", count % 8 != 0);
}

/* As large and as often gone over as a picture may be: all details of each component, bit by bit. */
static void jpeg_scans(struct glb *g)
{
    enum { EDGE = 4096, BLOCKS = EDGE / 8 * (EDGE / 8) };
    struct bytes b = { 0 };
    begin_jpeg(&b, EDGE);
    put(&b, "\xff\xda\0\x0c\3\1\0\2\0\3\0\0\0\0", 14);
    for (int i = 0; i < BLOCKS * 3 / 8; i++)
        put(&b, "", 1);
    for (unsigned i = 0; i < 3 * 14; i++) {
        const unsigned low = 13 - i % 14;
        jpeg_band(&b, 1 + i / 14, 1, 63, low < 13 ? low + 1 : 0, low, BLOCKS);
    }
    put(&b, "\xff\xd9", 2);
    pictures_of(g, &b);
}

/* Tables upon tables, half of the file, for a picture of a block. */
static void jpeg_tables(struct glb *g)
{
    struct bytes b = { 0 };
    begin_jpeg(&b, 8);
    while (b.size + 100 < g->limit / 2)
        put(&b, "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 22);
    put(&b, "\xff\xda\0\x0c\3\1\0\2\0\3\0\0\0\0\x1f\xff\xd9", 17);
    pictures_of(g, &b);
}

static void picture_text(struct glb *g)
{
    unsigned edge = 1;
    while ((size_t)(edge + 1) * (edge + 1) * 6 + 100 < g->limit)
        edge++;
    say(&g->json, "P3\n%u %u\n9\n", edge, edge);
    for (size_t i = 0; i < (size_t)edge * edge * 3; i++)
        say(&g->json, "%u ", any(10));
}

/* ------------------------------------------------------------------ lines */

static void input_lines(struct glb *g)
{
    while (g->json.size + 100 < g->limit)
        say(&g->json, "0 key b\n");
}

static void list_lines(struct glb *g)
{
    while (g->json.size + 100 < g->limit)
        say(&g->json, "frame=0 crc32=0\n");
}

static const struct kind {
    const char *name, *ending;
    void (*write)(struct glb *g);
} kinds[] = {
    { "json-deep", "gltf", json_deep }, { "json-wide", "gltf", json_wide }, { "json-keys", "gltf", json_keys },
    { "json-escapes", "gltf", json_escapes }, { "nodes-flat", "glb", nodes_flat }, { "nodes-deep", "glb", nodes_deep },
    { "primitives-small", "glb", primitives_small }, { "primitives-large", "glb", primitives_large },
    { "primitives-of-materials", "glb", primitives_of_materials }, { "meshes", "glb", meshes },
    { "triangles", "glb", many_triangles }, { "strip", "glb", strip }, { "layers", "glb", layers },
    { "targets", "glb", targets }, { "targets-small", "glb", targets_small }, { "skins", "glb", skins }, { "keys", "glb", keys },
    { "channels", "glb", channels }, { "clips", "glb", clips }, { "pictures", "glb", pictures },
    { "pictures-chunks", "glb", pictures_chunks }, { "jpeg-scans", "glb", jpeg_scans }, { "jpeg-tables", "glb", jpeg_tables },
    { "obj-vertices", "obj", obj_vertices }, { "obj-faces", "obj", obj_faces }, { "obj-polygon", "obj", obj_polygon },
    { "obj-groups", "obj", obj_groups }, { "obj-objects", "obj", obj_objects }, { "obj-materials", "obj", obj_materials },
    { "obj-libraries", "obj", obj_libraries }, { "obj-lines", "obj", obj_lines }, { "picture-bomb", "png", picture_bomb },
    { "picture-large", "png", picture_large }, { "picture-chunks", "png", picture_chunks }, { "picture-text", "ppm", picture_text },
    { "input-lines", "play", input_lines }, { "list-lines", "check", list_lines },
};

int main(int argc, char **argv)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct glb g = { .limit = argc > 2 ? strtoul(argv[2], NULL, 10) : 0 };
        if (argc < 3) {
            printf("%s.%s\n", kinds[i].name, kinds[i].ending);
        } else if (strcmp(argv[1], kinds[i].name) == 0) {
            kinds[i].write(&g);
            if (strcmp(kinds[i].ending, "glb") == 0)
                write_glb(&g, stdout);
            else
                fwrite(g.json.at, 1, g.json.size, stdout);
            return fflush(stdout) != 0;
        }
    }
    return argc >= 3;
}
