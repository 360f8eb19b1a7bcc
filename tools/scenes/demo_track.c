/* SPDX-License-Identifier: MIT */
/* demo_track.c - the land beside the racing car: road, kerbs, grass, hoardings, trees, far
 * hills. */
#include "tools/scenes/demo.h"

#include "tools/scenes/build.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

/* The road runs along x; z to the right of those who drive. */
static const double road_left = -4.2, road_right = 2.6, kerb = 0.62;

static uint32_t mix(uint32_t a, uint32_t b, double t)
{
    uint32_t out = 0;
    for (int shift = 0; shift <= 16; shift += 8) {
        double x = (double)(a >> shift & 255), y = (double)(b >> shift & 255);
        out |= (uint32_t)(x + (y - x) * t + 0.5) << shift;
    }
    return out;
}

/* A number in 0..1 that looks random. */
static double noise(int x, int y)
{
    uint32_t h = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u;
    h = (h ^ h >> 13) * 1274126177u;
    return (double)((h ^ h >> 16) & 0xffff) / 65536.0;
}

/* u along the road, v across it. */
static const struct image *road_image(struct stage *stage)
{
    enum { W = 64, H = 64 };
    struct image *image = stage_image(stage, W, H);
    for (int y = 0; image != NULL && y < H; y++)
        for (int x = 0; x < W; x++) {
            uint32_t c = mix(0x565b65, 0x727782, noise(x / 2, y));
            double lane = fabs((y + 0.5) / H - 0.40), other = fabs((y + 0.5) / H - 0.72);
            if (lane < 0.05 || other < 0.05)
                c = mix(c, 0x4c505a, 0.7);                      /* rubber on the racing line */
            if (x % 32 == 31 || (x > 36 && x < 50 && y > 26 && y < 40))
                c = mix(c, 0x41454e, 0.6);                      /* seams and a mended patch */
            if ((y >= 1 && y <= 2) || (y >= H - 3 && y <= H - 2))
                c = 0xe9e6dc;
            if ((y == 24 || y == 25) && x < 26)
                c = 0xd9d6cc;
            stage_texel(image, x, y, c);
        }
    return image;
}

static const struct image *kerb_image(struct stage *stage)
{
    struct image *image = stage_image(stage, 8, 2);
    for (int y = 0; image != NULL && y < 2; y++)
        for (int x = 0; x < 8; x++)
            stage_texel(image, x, y, x < 4 ? (y ? 0xd23a34 : 0xdf4840) : (y ? 0xe9e4d8 : 0xf6f2e8));
    return image;
}

/* Mown in stripes across the road. */
static const struct image *grass_image(struct stage *stage)
{
    enum { W = 32, H = 32 };
    struct image *image = stage_image(stage, W, H);
    for (int y = 0; image != NULL && y < H; y++)
        for (int x = 0; x < W; x++) {
            uint32_t c = (x + y / 8) % W < W / 2 ? 0x79b04c : 0x8abf58;
            stage_texel(image, x, y, mix(c, 0x5f9440, 0.45 * noise(x, y) * noise(y, x + 7)));
        }
    return image;
}

/* The letters of the hoardings, seven rows of five pixels, left pixel in bit 4. */
static const struct glyph { char letter; uint8_t row[7]; } glyphs[] = {
    {'A', {14, 17, 17, 31, 17, 17, 17}}, {'E', {31, 16, 16, 30, 16, 16, 31}},
    {'M', {17, 27, 21, 21, 17, 17, 17}}, {'R', {30, 17, 17, 30, 20, 18, 17}},
    {'S', {15, 16, 16, 14, 1, 1, 30}},
};

static bool in_glyph(char letter, int x, int y)
{
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (glyphs[i].letter == letter && x >= 0 && x < 5 && y >= 0 && y < 7)
            return glyphs[i].row[y] >> (4 - x) & 1;
    return false;
}

/* Three hoardings of 64 x 16 texels one below the other: a word, arrows, a chequered band. */
static const struct image *board_image(struct stage *stage)
{
    enum { W = 64, H = 48 };
    static const char word[] = "SMEAR";
    struct image *image = stage_image(stage, W, H);
    for (int y = 0; image != NULL && y < H; y++)
        for (int x = 0; x < W; x++) {
            int row = y % 16;
            uint32_t c;
            if (y < 16) {
                int at = (x - 3) / 12, in = (x - 3) % 12;
                bool ink = x >= 3 && at < 5 && row >= 1 && row < 15 &&
                           in_glyph(word[at], in / 2, (row - 1) / 2);
                c = ink ? 0xfdf6e3 : 0x1d3f78;
            } else if (y < 32) {
                int arrow = x + abs(row - 8);
                c = arrow % 16 < 7 ? 0x1f2430 : 0xf5c02e;
            } else {
                c = (x / 4 + row / 4) % 2 == 0 ? 0xf4f1ea : 0x23262e;
            }
            if (row == 0 || row == 15)
                c = y < 16 ? 0xf5c02e : 0xf4f1ea;
            stage_texel(image, x, y, c);
        }
    return image;
}

/* A strip of ground from x = 0 to `length`, z0 < z1, the picture `times` times along it and
 * v0..v1 across. */
static void strip(struct build *b, double length, double z0, double z1, double y0, double y1,
                  int pieces, double times, double across)
{
    struct vec3 up = vec3(0, 1, 0);
    uint32_t first = 0;
    for (int i = 0; i <= pieces; i++)
        for (int k = 0; k < 2; k++) {
            double x = length * i / pieces;
            uint32_t v = build_vertex(b, vec3(x, k ? y1 : y0, k ? z1 : z0), up, times * i / pieces,
                                      k ? across : 0);
            if (i == 0 && k == 0)
                first = v;
        }
    for (uint32_t i = 0; i < (uint32_t)pieces; i++) {
        uint32_t a = first + 2 * i;
        build_triangle(b, a, a + 1, a + 3);
        build_triangle(b, a, a + 3, a + 2);
    }
}

static void add_ground(struct stage *stage, double length)
{
    struct build b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    struct scene_surface *s;
    strip(&b, length, road_left, road_right, 0, 0, 6, 4, 1);
    if ((s = build_finish(&b)) != NULL)
        s->material.image = road_image(stage);
    stage_add(stage, s);

    strip(&b, length, road_left - kerb, road_left, 0.05, 0, 6, 24, 1);
    strip(&b, length, road_right, road_right + kerb, 0, 0.05, 6, 24, 1);
    if ((s = build_finish(&b)) != NULL)
        s->material.image = kerb_image(stage);
    stage_add(stage, s);

    strip(&b, length, -24, road_left - kerb, 0.05, 0.05, 3, 6, 3);
    strip(&b, length, road_right + kerb, 9, 0.05, 0.05, 3, 6, 1);
    if ((s = build_finish(&b)) != NULL)
        s->material.image = grass_image(stage);
    stage_add(stage, s);
}

static void add_boards(struct stage *stage, double length)
{
    struct build b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    int count = 5;
    double slot = length / count, z = road_left - 2.6;
    for (int i = 0; i < count; i++) {
        static const int kind[5] = {0, 1, 0, 2, 0};
        double x0 = slot * i + 0.3, x1 = slot * (i + 1) - 0.3;
        double v0 = kind[i] / 3.0, v1 = v0 + 1 / 3.0;
        struct vec3 corner[4] = {vec3(x0, 0.12, z), vec3(x1, 0.12, z), vec3(x1, 1.25, z - 0.25),
                                  vec3(x0, 1.25, z - 0.25)};
        uint32_t v[4];
        for (int k = 0; k < 4; k++)
            v[k] = build_vertex(&b, corner[k], vec3(0, 0.22, 1), k == 1 || k == 2 ? 1 : 0,
                                k < 2 ? v1 : v0);
        build_triangle(&b, v[0], v[1], v[2]);
        build_triangle(&b, v[0], v[2], v[3]);
    }
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.image = board_image(stage);
    stage_add(stage, s);
}

/* A trunk and two or three cones; a flat dark patch on the grass where its shadow falls. */
static void tree(struct build *b, double x, double z, double size, uint32_t leaves)
{
    b->at = xform_mul(xform_move(x, 0, z), xform_scale(size, size, size));
    build_color(b, 0x6a4a30);
    double trunk[4] = {0.16, 0, 0.12, 0.9};
    build_lathe(b, trunk, 2, 5);
    build_color(b, leaves);
    double low[4] = {1.05, 0.7, 0, 2.4}, high[4] = {0.78, 1.75, 0, 3.5};
    build_lathe(b, low, 2, 7);
    build_color(b, mix(leaves, 0xffffff, 0.10));
    b->at = xform_mul(b->at, xform_turn_y(0.4));
    build_lathe(b, high, 2, 7);
    b->at = xform_move(x - 0.9 * size, 0.07, z - 1.1 * size);
    build_color(b, 0x5a9142);
    build_vertex(b, vec3(0, 0, 0), vec3(0, 1, 0), 0, 0);
    uint32_t centre = (uint32_t)b->vertex_count - 1;
    for (int k = 0; k < 7; k++) {
        double a = 2 * PI * k / 7, r = 1.15 * size;
        build_vertex(b, vec3(r * sin(a), 0, r * cos(a)), vec3(0, 1, 0), 0, 0);
    }
    for (uint32_t k = 0; k < 7; k++)
        build_triangle(b, centre, centre + 1 + k, centre + 1 + (k + 1) % 7);
    b->at = xform_identity();
}

static void add_scenery(struct stage *stage, double length)
{
    static const struct { double x, z, size; uint32_t leaves; } plant[] = {
        {0.04, -10.5, 1.15, 0x3f8f55}, {0.13, -14.0, 1.45, 0x2f7a52}, {0.22, -11.0, 0.95, 0x58a04e},
        {0.30, -18.0, 1.70, 0x3f8f55}, {0.41, -12.5, 1.25, 0xe2a23b}, {0.50, -10.2, 0.85, 0x4a9a58},
        {0.58, -16.0, 1.55, 0x2f7a52}, {0.69, -11.5, 1.20, 0x3f8f55}, {0.78, -20.0, 1.80, 0x58a04e},
        {0.87, -13.0, 1.35, 0xd9772f}, {0.95, -17.0, 1.50, 0x2f7a52},
    };
    struct build b = build_begin(stage, BUILD_COLOR);
    for (size_t i = 0; i < sizeof plant / sizeof *plant; i++)
        tree(&b, plant[i].x * length, plant[i].z, plant[i].size, plant[i].leaves);

    /* Posts and a low rail in front of the hoardings. */
    double z = road_left - 2.2;
    build_color(&b, 0xc9ced6);
    build_box(&b, vec3(0, 0.14, z), vec3(length, 0.28, z + 0.05));
    for (int i = 0; i < 10; i++) {
        double x = length * (i + 0.5) / 10;
        build_color(&b, i % 2 ? 0xe6e2d8 : 0xd8463c);
        build_box(&b, vec3(x - 0.06, 0, z - 0.08), vec3(x + 0.06, 0.42, z));
    }
    /* A flag in front of the trees. */
    build_color(&b, 0xe8ecf0);
    build_box(&b, vec3(length * 0.46, 0, z - 1.4), vec3(length * 0.46 + 0.09, 4.2, z - 1.31));
    build_color(&b, 0x1fa6a0);
    build_box(&b, vec3(length * 0.46 - 1.3, 3.2, z - 1.38), vec3(length * 0.46, 4.15, z - 1.34));
    stage_add(stage, build_finish(&b));
}

int demo_track(struct stage *stage, double length)
{
    int first = stage->prop_count;
    add_ground(stage, length);
    add_boards(stage, length);
    add_scenery(stage, length);
    for (int piece = 1; piece < TRACK_PIECES; piece++)
        for (int part = 0; part < TRACK_PARTS; part++)
            stage_add(stage, stage->prop[first + part].surface);
    return first;
}

void demo_track_place(struct scene_instant *out, int first, double length, double x, double behind)
{
    /* Piece j covers [j, j + 1) lengths and belongs to slot j mod TRACK_PIECES, so that a slot
     * stays where it is until it falls behind; then it is laid anew at the far end, out of
     * sight: a cut, no motion. */
    int64_t oldest = (int64_t)floor((x - behind) / length);
    for (int i = 0; i < TRACK_PIECES; i++) {
        int64_t j = oldest + i, slot = j % TRACK_PIECES;
        if (slot < 0)
            slot += TRACK_PIECES;
        for (int part = 0; part < TRACK_PARTS; part++) {
            int draw = first + (int)slot * TRACK_PARTS + part;
            stage_place(out, draw, xform_move((double)j * length, 0, 0));
            out->draw[draw].epoch = (int)(j - slot);
        }
    }
}

/* Half a disc that faces -z: a third of a cloud. */
static void puff(struct build *b, double x, double radius, int layer)
{
    enum { STEPS = 8 };
    build_color(b, 0xd4e8f4);
    uint32_t middle = build_vertex(b, vec3(x, 0, -0.5 * layer), vec3(0, 0, -1), 0, 0);
    for (int i = 0; i <= STEPS; i++) {
        double a = PI * i / STEPS, rise = sin(a);
        build_color(b, mix(0xd4e8f4, 0xffffff, rise));
        build_vertex(b, vec3(x - radius * cos(a), 0.55 * radius * rise, -0.5 * layer),
                     vec3(0, 0, -1), 0, 0);
    }
    for (uint32_t i = 1; i <= STEPS; i++)
        build_triangle(b, middle, middle + i, middle + i + 1);
}

/* Two ranges of hills around the eye and the light sky above the horizon. */
int demo_backdrop(struct stage *stage)
{
    enum { STEPS = 40 };
    struct build b = build_begin(stage, BUILD_COLOR);
    static const struct {
        double radius, base, swell, first, second;
        uint32_t foot, top;
    } range[3] = {
        {118, 30, 0, 0, 0, 0xe9f4f6, 0x9fd0ee}, {114, 9, 4.0, 5, 11, 0xb9d7d6, 0x9cc4c4},
        {108, 4.4, 2.6, 7, 16, 0x9cc79c, 0x76ac82},
    };
    for (int r = 0; r < 3; r++) {
        uint32_t start = (uint32_t)b.vertex_count;
        for (int i = 0; i < STEPS; i++) {
            double a = 2 * PI * i / STEPS, s = sin(a), c = cos(a), radius = range[r].radius;
            double wave = 0.6 * sin(range[r].first * a + r);
            wave += 0.4 * sin(range[r].second * a + 2 * r);
            double top = range[r].base + range[r].swell * wave;
            build_color(&b, range[r].foot);
            build_vertex(&b, vec3(radius * s, -7, radius * c), vec3(0, 1, 0), 0, 0);
            build_color(&b, range[r].top);
            build_vertex(&b, vec3(radius * s, top, radius * c), vec3(0, 1, 0), 0, 0);
        }
        for (uint32_t i = 0; i < STEPS; i++) {
            uint32_t here = start + 2 * i, next = start + 2 * ((i + 1) % STEPS);
            build_triangle(&b, here, here + 1, next + 1);
            build_triangle(&b, here, next + 1, next);
        }
    }
    static const struct { double bearing, up, size; } cloud[4] = {
        {0.47, 27, 9}, {0.76, 33, 6}, {1.12, 15, 7}, {-0.12, 24, 8},
    };
    for (int i = 0; i < 4; i++) {
        b.at = xform_mul(xform_turn_y(PI + cloud[i].bearing), xform_move(0, cloud[i].up, 100));
        for (int k = 0; k < 3; k++) {
            static const double lump[3][2] = {{-0.75, 0.45}, {0, 0.72}, {0.70, 0.50}};
            puff(&b, lump[k][0] * cloud[i].size, lump[k][1] * cloud[i].size, k);
        }
    }
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = true;
    return stage_add(stage, s);
}
