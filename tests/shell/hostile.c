/* SPDX-License-Identifier: MIT */
/* hostile.c - files that ask for as much memory and time as their size allows, one way each: what strangers.sh gives to
 * every command.
 *
 *     hostile KIND BYTES > FILE        about so many bytes
 *     hostile                          the kinds, a line each, with the ending of its files
 */
#include "tools/image/png.h"

static void put_float(struct buffer *b, float value)
{
    uint32_t word;
    memcpy(&word, &value, 4);
    buffer_le32(b, word);
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
    struct buffer json, bin;
    size_t limit;
    unsigned count;     /* how often what is repeated first came */
};

static void write_glb(struct glb *g, FILE *to)
{
    struct buffer out = { 0 };
    while (g->json.size % 4 != 0)
        buffer_byte(&g->json, ' ');
    while (g->bin.size % 4 != 0)
        buffer_byte(&g->bin, 0);
    buffer_append(&out, "glTF", 4);
    buffer_le32(&out, 2);
    buffer_le32(&out, (uint32_t)(12 + 8 + g->json.size + (g->bin.size > 0 ? 8 + g->bin.size : 0)));
    buffer_le32(&out, (uint32_t)g->json.size);
    buffer_le32(&out, 0x4e4f534a);
    buffer_append(&out, g->json.data, g->json.size);
    if (g->bin.size > 0) {
        buffer_le32(&out, (uint32_t)g->bin.size);
        buffer_le32(&out, 0x004e4942);
        buffer_append(&out, g->bin.data, g->bin.size);
    }
    fwrite(out.data, 1, out.size, to);
}

/* Corners of triangles at random, and their numbers: accessors 0 and 1. */
static void triangles(struct glb *g, unsigned vertices, unsigned corners)
{
    for (unsigned i = 0; i < vertices * 3; i++)
        put_float(&g->bin, any_place());
    for (unsigned i = 0; i < corners; i++)
        buffer_le32(&g->bin, i < vertices ? i : any(vertices));
}

/* Accessors 0 (positions) and 1 (indices) of triangles() and the views 0 and 1 behind them. */
static void end(struct glb *g, unsigned vertices, unsigned corners)
{
    buffer_print(&g->json, ",'accessors':[{'bufferView':0,'componentType':5126,'count':%u,'type':'VEC3'},"
        "{'bufferView':1,'componentType':5125,'count':%u,'type':'SCALAR'}]", vertices, corners);
    buffer_print(&g->json, ",'bufferViews':[{'buffer':0,'byteLength':%u},{'buffer':0,'byteOffset':%u,'byteLength':%u}],"
        "'buffers':[{'byteLength':%zu}]}", vertices * 12, vertices * 12, corners * 4, g->bin.size);
}

/* ------------------------------------------------------------------ text that is repeated */

/* Whether text number i may come once more: each letter of `how` says up to when.
 *
 *     f           the file has room for the rest         1 to 9      the text is below so many twelfths of the file
 *     o p q       there is room for 40, 60, 100 bytes    n           as many as in the first repetition
 *     j           a sixtieth of the limit, or 60,000 */
static bool goes_on(const struct glb *g, const char *how, unsigned i)
{
    bool ok = true;
    for (; *how != '|'; how++)
        switch (*how) {
        case 'f': ok = ok && g->json.size + g->bin.size + 2000 < g->limit; break;
        case 'n': ok = ok && i <= g->count; break;
        case 'j': ok = ok && i < g->limit / 60 && i < 60000; break;
        case 'o': ok = ok && g->json.size + 40 < g->limit; break;
        case 'p': ok = ok && g->json.size + 60 < g->limit; break;
        case 'q': ok = ok && g->json.size + 100 < g->limit; break;
        default: ok = ok && g->json.size < g->limit * (size_t)(*how - '0') / 12; break;
        }
    return ok;
}

/* Text of which `<HOW|TEXT>` is repeated. In there \1 stands for its number, from 1, \2 for the next and \3 for the one before, in
 * hexadecimal where % follows; \4 and \5 for 0 to 9 and 1 to 3 at random. */
static void tell(struct glb *g, const char *text)
{
    bool first = g->count == 0;
    for (; *text != '\0'; text++) {
        if (*text != '<') {
            buffer_append(&g->json, text, 1);
            continue;
        }
        const char *how = text + 1, *from = strchr(text, '|') + 1;
        unsigned i = 1;
        for (text = strchr(from, '>'); goes_on(g, how, i); i++)
            for (const char *c = from; c < text; c++) {
                if (*c > 5)
                    buffer_append(&g->json, c, 1);
                else if (*c >= 4)
                    buffer_print(&g->json, "%u", *c == 4 ? any(10) : 1 + any(3));
                else
                    buffer_print(&g->json, text[1] == '%' ? "%x" : "%u", *c == 1 ? i : *c == 2 ? i + 1 : i - 1);
            }
        text += text[1] == '%';
        if (first)
            g->count = i - 1;
        first = false;
    }
}

#define BEGIN "{'asset':{'version':'2.0'}"
#define POINTS "{'attributes':{'POSITION':0},'indices':1"
#define MESH ",'meshes':[{'primitives':[" POINTS "}]}]"
#define ONE_SCENE ",'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}]"
#define SHARES ",{'mesh':0}>]"

/* One skin of many joints, and many nodes that wear it. */
static void skins(struct glb *g)
{
    const float corner[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    for (int i = 0; i < 9; i++)
        put_float(&g->bin, corner[i]);
    for (unsigned i = 0; i < 3; i++)
        buffer_le32(&g->bin, i);
    for (unsigned i = 0; i < 12; i++)           /* joints of three vertices, and their weights */
        buffer_append(&g->bin, i % 4 == 0 ? "\1\0" : "\0\0", 2);
    for (unsigned i = 0; i < 12; i++)
        put_float(&g->bin, 0.25f);
    tell(g, BEGIN ",'scene':0,'nodes':[{}<f6|,{'mesh':0,'skin':0}>],'scenes':[{'nodes':[0<n9|,\1>]}],'skins':[{'joints':[0<njf|,\1>]}],"
         "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':2,'WEIGHTS_0':3},'indices':1}]}]");
    buffer_print(&g->json, ",'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
        "{'bufferView':0,'byteOffset':36,'componentType':5125,'count':3,'type':'SCALAR'},"
        "{'bufferView':0,'byteOffset':48,'componentType':5123,'count':3,'type':'VEC4'},"
        "{'bufferView':0,'byteOffset':72,'componentType':5126,'count':3,'type':'VEC4'}],"
        "'bufferViews':[{'buffer':0,'byteLength':%zu}],'buffers':[{'byteLength':%zu}]}", g->bin.size, g->bin.size);
}

static void clip(struct glb *g, unsigned keys, const char *text)
{
    triangles(g, 3, 3);
    for (unsigned i = 0; i < keys; i++)
        put_float(&g->bin, (float)i / 64.0f);
    for (unsigned i = 0; i < keys * 3; i++)
        put_float(&g->bin, any_place());
    buffer_print(&g->json, BEGIN ",'scene':0" MESH ",'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
        "{'bufferView':0,'byteOffset':36,'componentType':5125,'count':3,'type':'SCALAR'},"
        "{'bufferView':0,'byteOffset':48,'componentType':5126,'count':%u,'type':'SCALAR'},"
        "{'bufferView':0,'byteOffset':%u,'componentType':5126,'count':%u,'type':'VEC3'}],"
        "'bufferViews':[{'buffer':0,'byteLength':%zu}],'buffers':[{'byteLength':%zu}]", keys, 48 + keys * 4, keys,
                 g->bin.size, g->bin.size);
    tell(g, text);
}

#define CLIP "'samplers':[{'input':2,'output':3}],'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}"

static void keys(struct glb *g)
{
    clip(g, (unsigned)(g->limit / 17), ONE_SCENE ",'animations':[{" CLIP "]}]}");
}

/* Channels that share their keys. */
static void channels(struct glb *g)
{
    clip(g, 1000, ",'nodes':[{'mesh':0}<3|" SHARES ",'scenes':[{'nodes':[0<n6|,\1>]}],'animations':[{" CLIP
         "<nf|,{'sampler':0,'target':{'node':\1,'path':'translation'}}>]}]}");
}

static void clips(struct glb *g)
{
    clip(g, 100, ONE_SCENE ",'animations':[{'samplers':[],'channels':[]}<f|,{" CLIP "]}>]}");
}

/* Triangles each of which covers the whole picture. */
static void layers(struct glb *g)
{
    unsigned corners = (unsigned)(g->limit / 5) / 3 * 3;
    const float far[9] = { -99, -99, 0, 99, -99, 0, 0, 99, 0 };
    for (int i = 0; i < 9; i++)
        put_float(&g->bin, far[i]);
    for (unsigned i = 0; i < corners; i++)
        buffer_le32(&g->bin, i % 3);
    buffer_print(&g->json, BEGIN ",'scene':0,'scenes':[{'nodes':[0,1]}],'nodes':[{'mesh':0},{'camera':0,'translation':[0,0,3]}],"
        "'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':0.1}}],'materials':[{'doubleSided':true,"
        "'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}}]"
        ",'meshes':[{'primitives':[" POINTS ",'material':0}]}]");
    end(g, 3, corners);
}

/* Brackets within brackets. */
static void json_deep(struct glb *g)
{
    buffer_print(&g->json, BEGIN ",'extras':");
    for (size_t i = 0; i < g->limit / 2; i++)
        buffer_byte(&g->json, '[');
    for (size_t i = 0; i < g->limit / 2; i++)
        buffer_byte(&g->json, ']');
    buffer_byte(&g->json, '}');
}

/* ------------------------------------------------------------------ pictures */

/* Bits of deflate, the lowest first. */
struct bits {
    struct buffer *to;
    uint32_t held;
    int count;
};

static void put_bits(struct bits *b, uint32_t value, int count)
{
    b->held |= value << b->count;
    for (b->count += count; b->count >= 8; b->count -= 8, b->held >>= 8)
        buffer_byte(b->to, b->held & 255);
}

/* `size` zeros in about a thousandth: a literal and matches of 258 by a code whose two symbols take a bit each. */
static void zeros(struct buffer *out, size_t size)
{
    static const uint8_t order[19] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    struct bits b = { .to = out };
    uint32_t sum = 1, high = 0;
    buffer_append(out, "\x78\x01", 2);
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
    buffer_be32(out, high << 16 | sum);
}

static void begin_png(struct buffer *out, uint32_t width, uint32_t height, const char *kind)
{
    struct buffer head = { 0 };
    buffer_be32(&head, width);
    buffer_be32(&head, height);
    buffer_append(&head, kind, 5);
    buffer_append(out, png_signature, 8);
    png_chunk(out, "IHDR", head.data, head.size);
}

static void end_png(struct buffer *out, const struct buffer *data)
{
    png_chunk(out, "IDAT", data->data, data->size);
    png_chunk(out, "IEND", NULL, 0);
}

static void picture_bomb(struct glb *g)
{
    struct buffer data = { 0 };
    const uint32_t edge = g->limit < 8000000 ? 4096 : 16384;
    begin_png(&g->json, edge, edge, "\x10\x06\0\0\0");
    zeros(&data, ((size_t)edge * 8 + 1) * edge);
    end_png(&g->json, &data);
}

/* The largest that is compared. */
static void picture_large(struct glb *g)
{
    struct buffer data = { 0 };
    begin_png(&g->json, 4096, 2048, "\x08\x02\0\0\0");
    zeros(&data, ((size_t)4096 * 3 + 1) * 2048);
    end_png(&g->json, &data);
}

static void picture_chunks(struct glb *g)
{
    begin_png(&g->json, 64, 64, "\x08\x02\0\0\0");
    while (g->json.size + 100 < g->limit)
        png_chunk(&g->json, "IDAT", NULL, 0);
    png_chunk(&g->json, "IEND", NULL, 0);
}

/* A model whose pictures are all one file. */
static void pictures_of(struct glb *g, const struct buffer *file)
{
    triangles(g, 3, 3);
    size_t at = g->bin.size;
    buffer_append(&g->bin, file->data, file->size);
    const unsigned n = (unsigned)((g->limit - file->size) / 300);
    g->count = (n > 20000 ? 20000 : n) - 1;
    tell(g, BEGIN ",'scene':0" ONE_SCENE ",'images':[{'bufferView':2}<n|,{'bufferView':2}>],'textures':[{'source':0}<n|,{'source':\1}>],"
         "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}<n|,{'pbrMetallicRoughness':{'baseColorTexture':"
         "{'index':\1}}}>],'meshes':[{'primitives':[" POINTS ",'material':0}<n|," POINTS ",'material':\1}>]}]");
    buffer_print(&g->json, ",'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
        "{'bufferView':1,'componentType':5125,'count':3,'type':'SCALAR'}],'bufferViews':[{'buffer':0,"
        "'byteLength':36},{'buffer':0,'byteOffset':36,'byteLength':12},{'buffer':0,'byteOffset':%zu,"
        "'byteLength':%zu}],'buffers':[{'byteLength':%zu}]}", at, file->size, g->bin.size);
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
    struct buffer b = { 0 }, data = { 0 };
    begin_png(&b, 1, 1, "\x08\x02\0\0\0");
    zeros(&data, 4);
    while (b.size + 200 < g->limit / 2)
        png_chunk(&b, "IDAT", NULL, 0);
    end_png(&b, &data);
    pictures_of(g, &b);
}

/* ------------------------------------------------------------------ JPEG */

/* Quantisation and the frame of three components; codes of a bit: a mean that does not change, and a run of blocks. */
static void begin_jpeg(struct buffer *b, unsigned edge)
{
    const uint8_t frame[] = { 0xff, 0xc2, 0, 17, 8, (uint8_t)(edge >> 8), (uint8_t)edge, (uint8_t)(edge >> 8), (uint8_t)edge, 3,
                              1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0 };
    buffer_append(b, "\xff\xd8\xff\xdb\0\x43\0", 7);
    for (int i = 0; i < 64; i++)
        buffer_append(b, "\1", 1);
    buffer_append(b, frame, sizeof frame);
    buffer_append(b, "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 22);
    buffer_append(b, "\xff\xc4\0\x14\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\xe0", 22);
}

/* The bits `low` of some coefficients, all of them zero: runs of 32,767 blocks, by a bit and 14 more. */
static void jpeg_band(struct buffer *b, unsigned component, unsigned first, unsigned last, unsigned high, unsigned low, unsigned blocks)
{
    const uint8_t scan[] = { 0xff, 0xda, 0, 8, 1, (uint8_t)component, 0, (uint8_t)first, (uint8_t)last, (uint8_t)(high << 4 | low) };
    uint32_t held = 0;
    int count = 0;
    buffer_append(b, scan, sizeof scan);
    for (unsigned told = 0; told < blocks; told += 32767)
        for (int i = 0; i < 15; i++) {
            held = held << 1 | (i > 0);
            if (++count % 8 == 0) {
                buffer_byte(b, held & 255);
                if ((held & 255) == 255)
                    buffer_byte(b, 0);
            }
        }
    buffer_append(b, "\x7f", count % 8 != 0);
}

/* As large and as often gone over as a picture may be: all details of each component, bit by bit. */
static void jpeg_scans(struct glb *g)
{
    enum { EDGE = 4096, BLOCKS = EDGE / 8 * (EDGE / 8) };
    struct buffer b = { 0 };
    begin_jpeg(&b, EDGE);
    buffer_append(&b, "\xff\xda\0\x0c\3\1\0\2\0\3\0\0\0\0", 14);
    for (int i = 0; i < BLOCKS * 3 / 8; i++)
        buffer_byte(&b, 0);
    for (unsigned i = 0; i < 3 * 14; i++) {
        const unsigned low = 13 - i % 14;
        jpeg_band(&b, 1 + i / 14, 1, 63, low < 13 ? low + 1 : 0, low, BLOCKS);
    }
    buffer_append(&b, "\xff\xd9", 2);
    pictures_of(g, &b);
}

/* Tables upon tables, half of the file, for a picture of a block. */
static void jpeg_tables(struct glb *g)
{
    struct buffer b = { 0 };
    begin_jpeg(&b, 8);
    while (b.size + 100 < g->limit / 2)
        buffer_append(&b, "\xff\xc4\0\x14\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 22);
    buffer_append(&b, "\xff\xda\0\x0c\3\1\0\2\0\3\0\0\0\0\x1f\xff\xd9", 17);
    pictures_of(g, &b);
}

static void picture_text(struct glb *g)
{
    unsigned edge = 1;
    while ((size_t)(edge + 1) * (edge + 1) * 6 + 100 < g->limit)
        edge++;
    buffer_print(&g->json, "P3\n%u %u\n9\n", edge, edge);
    for (size_t i = 0; i < (size_t)edge * edge * 3; i++)
        buffer_print(&g->json, "%u ", any(10));
}

/* ------------------------------------------------------------------ kinds */

#define CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define FACE "f 1 2 3\n"

/* What is written by a function, or a text; that of a GLB begins with its brace and stands before a triangle, or as many vertices and
 * corners as the limit has so many bytes. */
static const struct kind {
    const char *name, *ending;
    void (*write)(struct glb *g);
    const char *text;
    unsigned per_vertex, per_corner;
} kinds[] = {
    { "json-deep", "gltf", json_deep, NULL, 0, 0 },
    { "json-wide", "gltf", NULL, BEGIN ",'extras':[0<f|,0>]}", 0, 0 },
    { "json-keys", "gltf", NULL, BEGIN ",'scene':0<f|,'\3':0>%}", 0, 0 },
    { "json-escapes", "gltf", NULL, BEGIN ",'extras':'<f|\\ud83d\\ude00>'}", 0, 0 },
    /* Many nodes that show one triangle; one below the other. */
    { "nodes-flat", "glb", NULL, ",'nodes':[{}<f8|" SHARES ",'scenes':[{'nodes':[0<nf|,\1>]}]" MESH, 0, 0 },
    { "nodes-deep", "glb", NULL,
      ",'scenes':[{'nodes':[0]}],'nodes':[{'children':[1]}<f|,{'mesh':0,'children':[\2]}>,{'mesh':0}]" MESH, 0, 0 },
    { "primitives-small", "glb", NULL, ONE_SCENE ",'meshes':[{'primitives':[" POINTS "}<f|," POINTS "}>]}]", 0, 0 },
    { "primitives-large", "glb", NULL, ONE_SCENE ",'meshes':[{'primitives':[" POINTS "}<f|," POINTS "}>]}]", 60, 40 },
    { "primitives-of-materials", "glb", NULL,
      ONE_SCENE ",'meshes':[{'primitives':[" POINTS ",'material':0}<f6|," POINTS ",'material':\3}>]}],'materials':[{}<n|,"
                "{'pbrMetallicRoughness':{'baseColorFactor':[0.\1,0,0,1]}}>]", 0, 0 },
    { "meshes", "glb", NULL,
      ",'meshes':[{'primitives':[" POINTS "}]}<f8|,{'primitives':[" POINTS "}]}>],'nodes':[{'mesh':0}<n9|,{'mesh':\1}>],"
      "'scenes':[{'nodes':[0<nf|,\1>]}]", 0, 0 },
    /* As many triangles as there is room for; more: a strip makes one of each corner. */
    { "triangles", "glb", NULL, ONE_SCENE MESH, 40, 6 },
    { "strip", "glb", NULL, ONE_SCENE ",'meshes':[{'primitives':[{'mode':5,'attributes':{'POSITION':0},'indices':1}]}]", 80, 5 },
    { "layers", "glb", layers, NULL, 0, 0 },
    /* Shapes that are mixed: targets that are all the same. */
    { "targets", "glb", NULL,
      ONE_SCENE ",'meshes':[{'primitives':[" POINTS ",'targets':[{'POSITION':0}<f|,{'POSITION':0}>]}]}]", 48, 48 },
    { "targets-small", "glb", NULL,
      ONE_SCENE ",'meshes':[{'primitives':[" POINTS ",'targets':[{'POSITION':0}<f|,{'POSITION':0}>]}]}]", 0, 0 },
    { "skins", "glb", skins, NULL, 0, 0 },
    { "keys", "glb", keys, NULL, 0, 0 },
    { "channels", "glb", channels, NULL, 0, 0 },
    { "clips", "glb", clips, NULL, 0, 0 },
    { "pictures", "glb", pictures, NULL, 0, 0 },
    { "pictures-chunks", "glb", pictures_chunks, NULL, 0, 0 },
    { "jpeg-scans", "glb", jpeg_scans, NULL, 0, 0 },
    { "jpeg-tables", "glb", jpeg_tables, NULL, 0, 0 },
    { "obj-vertices", "obj", NULL, "<o|v \4 \4 1\n>" FACE, 0, 0 },
    { "obj-faces", "obj", NULL, CORNERS "<o|" FACE ">", 0, 0 },
    { "obj-polygon", "obj", NULL, CORNERS "f<o| \5>\n", 0, 0 },
    { "obj-groups", "obj", NULL, CORNERS "<o|g \3\n" FACE ">%", 0, 0 },
    { "obj-objects", "obj", NULL, CORNERS "<o|o \3\ng \3\n" FACE ">%", 0, 0 },
    { "obj-materials", "obj", NULL, CORNERS "<o|usemtl \3\n" FACE ">%", 0, 0 },
    { "obj-libraries", "obj", NULL, CORNERS "<p|mtllib obj-libraries.obj\n>" FACE, 0, 0 },    /* the file itself again and again */
    { "obj-lines", "obj", NULL, CORNERS "<p|\\\n#>\n" FACE, 0, 0 },
    { "picture-bomb", "png", picture_bomb, NULL, 0, 0 },
    { "picture-large", "png", picture_large, NULL, 0, 0 },
    { "picture-chunks", "png", picture_chunks, NULL, 0, 0 },
    { "picture-text", "ppm", picture_text, NULL, 0, 0 },
    { "input-lines", "play", NULL, "<q|0 key b\n>", 0, 0 },
    { "list-lines", "check", NULL, "<q|frame=0 crc32=0\n>", 0, 0 },
};

static void write_kind(const struct kind *k, struct glb *g)
{
    const bool is_glb = strcmp(k->ending, "glb") == 0;
    const unsigned vertices = k->per_vertex ? (unsigned)g->limit / k->per_vertex : 3,
                   corners = k->per_corner ? (unsigned)g->limit / k->per_corner / 3 * 3 : 3;
    if (k->write != NULL) {
        k->write(g);
    } else if (is_glb) {
        triangles(g, vertices, corners);
        tell(g, BEGIN ",'scene':0");
        tell(g, k->text);
        end(g, vertices, corners);
    } else {
        tell(g, k->text);
    }
    for (size_t i = 0; (is_glb || strcmp(k->ending, "gltf") == 0) && i < g->json.size; i++)
        g->json.data[i] = g->json.data[i] == '\'' ? '"' : g->json.data[i];
    if (is_glb)
        write_glb(g, stdout);
    else
        fwrite(g->json.data, 1, g->json.size, stdout);
}

int main(int argc, char **argv)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct glb g = { .limit = argc > 2 ? strtoul(argv[2], NULL, 10) : 0 };
        if (argc < 3) {
            printf("%s.%s\n", kinds[i].name, kinds[i].ending);
        } else if (strcmp(argv[1], kinds[i].name) == 0) {
            write_kind(&kinds[i], &g);
            return fflush(stdout) != 0 || g.json.failed || g.bin.failed;
        }
    }
    return argc >= 3;
}
