/* SPDX-License-Identifier: MIT */
/* fuzz_gltf.c - libFuzzer target: any bytes are decisions by which a glTF file is written that is right but for a few
 * of them. So mutations reach what lies behind the parser: strips, sparse and strided accessors, skins, targets, clips,
 * pictures, and all of `smear convert` (check_model.h). */
#include "tests/fuzz/check_model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* ------------------------------------------------------------------ decisions */

static const uint8_t *next, *last;

static unsigned any(unsigned below)
{
    return next < last && below > 0 ? *next++ % below : 0;
}

/* Mostly below `count`; now and then a number that it should not be. */
static long index_below(unsigned count)
{
    static const long wild[] = { -1, 255, 65536, 2147483647, 4294967296L };
    unsigned i = any(count + 1 + (count < 200 ? 24 : 0));
    return i < count ? (long)i : i == count ? wild[any(5)] : (long)(i % (count > 0 ? count : 1));
}

static const char *between(int i)
{
    return i > 0 ? "," : "";
}

/* ------------------------------------------------------------------ the file */

enum { BIN = 1024, VIEWS = 6, ACCESSORS = 12, MESHES = 3, NODES = 6, SKINS = 2, MATERIALS = 3, CLIPS = 2 };

static void say_views(void)
{
    say(",\"buffers\":[{\"byteLength\":%d}],\"bufferViews\":[", BIN);
    for (int i = 0; i < VIEWS; i++) {
        unsigned offset = any(16) * 4, stride = any(4);
        say("%s{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u", between(i), offset, any(12) == 0 ? 4 : BIN - offset);
        if (stride > 0)
            say(",\"byteStride\":%u", 8 + stride * 8);
        say("}");
    }
    say("]");
}

/* Accessors 0 to 3 suit corners, indices, times and joints; the others are anything. */
static void say_accessors(void)
{
    static const char *const shapes[] = { "VEC3", "SCALAR", "SCALAR", "VEC4", "VEC2", "VEC3", "VEC4", "MAT4", "MAT2", "SCALAR" };
    static const int types[] = { 5126, 5121, 5126, 5123, 5126, 5120, 5122, 5125 };
    say(",\"accessors\":[");
    for (int i = 0; i < ACCESSORS; i++) {
        unsigned count = i == 1 ? 3 + any(30) : i == 2 ? 2 + any(4) : i < 4 ? 12 : any(8) == 0 ? any(40) : 12;
        unsigned shape = i < 4 ? (unsigned)i : any(10), type = i < 4 ? (unsigned)i : any(8);
        say("%s{\"count\":%u,\"type\":\"%s\",\"componentType\":%d", between(i), count, shapes[shape], types[type]);
        if (any(10) > 0)
            say(",\"bufferView\":%ld,\"byteOffset\":%u", index_below(VIEWS), any(8) * 4);
        if (any(4) == 0)
            say(",\"normalized\":true");
        if (any(6) == 0)
            say(",\"sparse\":{\"count\":%u,\"indices\":{\"bufferView\":%ld,\"componentType\":%d},\"values\":{\"bufferView\":%ld}}",
                any(4), index_below(VIEWS), types[any(8)], index_below(VIEWS));
        say("}");
    }
    say("]");
}

static long accessor(int usual)
{
    return any(4) > 0 ? usual : index_below(ACCESSORS);
}

static void say_meshes(void)
{
    say(",\"meshes\":[");
    for (int i = 0; i < MESHES; i++) {
        unsigned primitives = 1 + any(2);
        say("%s{\"name\":\"m%d\",\"primitives\":[", between(i), i);
        for (unsigned k = 0; k < primitives; k++) {
            say("%s{\"attributes\":{\"POSITION\":%ld", between((int)k), accessor(0));
            if (any(2) == 0)
                say(",\"NORMAL\":%ld", accessor(0));
            if (any(2) == 0)
                say(",\"TEXCOORD_0\":%ld", index_below(ACCESSORS));
            if (any(3) == 0)
                say(",\"COLOR_0\":%ld", accessor(0));
            if (any(2) == 0)
                say(",\"JOINTS_0\":%ld,\"WEIGHTS_0\":%ld", accessor(3), accessor(3));
            say("},\"material\":%ld", index_below(MATERIALS));
            if (any(3) > 0)
                say(",\"indices\":%ld", accessor(1));
            if (any(3) == 0)
                say(",\"mode\":%u", any(8));
            if (any(3) == 0)
                say(",\"targets\":[{\"POSITION\":%ld},{\"POSITION\":%ld}]", accessor(0), accessor(0));
            say("}");
        }
        say("]%s}", any(3) == 0 ? ",\"weights\":[0.5,0.25]" : "");
    }
    say("]");
}

static void say_nodes(void)
{
    say(",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[");
    for (int i = 0; i < NODES; i++) {
        say("%s{\"name\":\"n%d\"", between(i), i);
        if (i + 1 < NODES && any(8) > 0)
            say(",\"children\":[%ld]", any(6) > 0 ? (long)i + 1 : index_below(NODES));
        if (any(4) > 0)
            say(",\"mesh\":%ld", index_below(MESHES));
        if (any(2) == 0)
            say(",\"skin\":%ld", index_below(SKINS));
        if (any(4) == 0)
            say(",\"camera\":0");
        if (any(3) == 0)
            say(",\"translation\":[%d,0,%d]", (int)any(9) - 4, (int)any(9) - 4);
        if (any(4) == 0)
            say(",\"scale\":[%u,1,-1]", any(3));
        else if (any(6) == 0)
            say(",\"matrix\":[1,0,0,0,0,%u,0,0,0,0,1,0,2,0,0,1]", any(3));
        say("}");
    }
    say("],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.%u,\"znear\":0.%u}}],\"skins\":[", 1 + any(9), any(10));
    for (int i = 0; i < SKINS; i++)
        say("%s{\"joints\":[%ld,%ld,%ld]%s}", between(i), index_below(NODES), index_below(NODES), index_below(NODES),
            any(4) == 0 ? ",\"inverseBindMatrices\":7" : "");
    say("]");
}

static void say_materials(void)
{
    static const char *const alpha[] = { "OPAQUE", "MASK", "BLEND" };
    say(",\"images\":[{\"bufferView\":%ld,\"mimeType\":\"image/png\"}],\"samplers\":[{\"wrapS\":33071}],"
        "\"textures\":[{\"source\":0,\"sampler\":0}],\"materials\":[", index_below(VIEWS));
    for (int i = 0; i < MATERIALS; i++) {
        say("%s{\"alphaMode\":\"%s\",\"doubleSided\":%s,\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.%u,0,0.%u]", between(i),
            alpha[any(3)], any(2) ? "true" : "false", any(10), any(10));
        if (any(4) == 0)
            say(",\"baseColorTexture\":{\"index\":%ld}", index_below(1));
        say("}}");
    }
    say("]");
}

static void say_clips(void)
{
    static const char *const path[] = { "translation", "rotation", "scale", "weights" };
    static const char *const how[] = { "LINEAR", "STEP", "CUBICSPLINE" };
    say(",\"animations\":[");
    for (int i = 0; i < CLIPS; i++)
        say("%s{\"name\":\"c%d\",\"samplers\":[{\"input\":%ld,\"output\":%ld,\"interpolation\":\"%s\"}],\"channels\":[{\"sampler\":%ld,"
            "\"target\":{\"node\":%ld,\"path\":\"%s\"}}]}", between(i), i, accessor(2), index_below(ACCESSORS), how[any(3)],
            index_below(1), index_below(NODES), path[any(4)]);
    say("]");
}

/* Times that grow, then what is left of the data. */
static void fill_bin(uint8_t bin[BIN])
{
    for (size_t i = 0; i < BIN; i++)
        bin[i] = next < last ? *next++ : (uint8_t)(i * 7);
    for (int i = 0; i < 16; i++) {
        float value = (float)i / 8;
        memcpy(bin + 4 * i, &value, 4);
    }
}

static void write_text(void)
{
    say("{\"asset\":{\"version\":\"2.0\"}");
    say_views();
    say_accessors();
    say_meshes();
    say_nodes();
    say_materials();
    if (any(3) > 0)
        say_clips();
    say("}");
    while (text.size % 4 != 0)
        say(" ");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t bin[BIN];
    next = data;
    last = data + size;
    text.size = 0;
    const unsigned choice = any(256) * 257;
    write_text();
    fill_bin(bin);
    uint8_t *glb = glb_of(text.data, text.size, bin, BIN, &size);
    check_file(glb, size, choice);
    free(glb);
    return 0;
}
