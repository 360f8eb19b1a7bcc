/* SPDX-License-Identifier: MIT */
/* demo_props.c - host program that writes what the demo firmware shows: meshes, materials and
 * textures as C source.
 *
 *     demo_props OUT.c
 *
 * The output holds one tape (platform/play.h) per level of detail, named as in levels[]; its only
 * frame has one draw per prop, in the order of demo_scene.h. Metres; x is the way the car drives,
 * y up, z to its right. */
#include "platform/demo_bake.h"
#include "platform/demo_scene.h"
#include "platform/demo_weld.h"

#include "tools/scenes/build.h"
#include "tools/scenes/present.h"
#include "tools/scenes/tape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static const double road_left = -4.0, road_right = 2.6, kerb = 0.6, road_end = 110;

static const struct level {
    const char *name;
    int wheel_sides, hull_rings, ball_sides, ball_rings, trees, tree_sides, boards, hills;
    bool is_night;                  /* for displays of few greys: light things before black */
    bool is_rich;                   /* pods, trunks, both faces of the wheels, grass with a picture */
} levels[] = {
    { "small", 6, 4, 4, 2, 4, 4, 5, 6, false, false },
    { "night", 6, 4, 4, 2, 4, 4, 5, 6, true, false },
    { "large", 12, 6, 7, 3, 7, 6, 9, 10, false, true },
};

/* The level that is being built: stages have no room for it. */
static const struct level *level;

/* A colour by day, and the grey that stands for it at night. */
static uint32_t paint(uint32_t day, uint32_t night)
{
    return level->is_night ? night * 0x10101u : day;
}

/* ------------------------------------------------------------------ pictures */

/* A number in 0..1 that looks random. */
static double noise(int x, int y)
{
    uint32_t h = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u;
    h = (h ^ h >> 13) * 1274126177u;
    return (double)((h ^ h >> 16) & 0xffff) / 65536.0;
}

static uint32_t mix(uint32_t a, uint32_t b, double t)
{
    uint32_t out = 0;
    for (int shift = 0; shift <= 16; shift += 8) {
        double x = (double)(a >> shift & 255), y = (double)(b >> shift & 255);
        out |= (uint32_t)(x + (y - x) * t + 0.5) << shift;
    }
    return out;
}

/* u along the road, v across it: dashes, rubber on the racing line, worn asphalt. */
static const struct image *road_image(struct stage *stage)
{
    enum { W = 32, H = 32 };
    struct image *image = stage_image(stage, W, H);
    for (int y = 0; image != NULL && y < H; y++)
        for (int x = 0; x < W; x++) {
            uint32_t c = mix(paint(0x4d525c, 0x28), paint(0x686d78, 0x44), noise(x / 2, y));
            if (y >= 17 && y <= 20)
                c = mix(c, paint(0x3a3d46, 0x18), 0.7);
            if (y == 1 || y == H - 2 || (y >= 10 && y <= 11 && x < 14))
                c = 0xe9e6dc;
            stage_texel(image, x, y, c);
        }
    return image;
}

static const struct image *kerb_image(struct stage *stage)
{
    struct image *image = stage_image(stage, 8, 2);
    for (int y = 0; image != NULL && y < 2; y++)
        for (int x = 0; x < 8; x++)
            stage_texel(image, x, y, x < 4 ? paint(0xcc3630, 0x30) : paint(0xf2eee4, 0xe0));
    return image;
}

/* Mown in stripes across the road. */
static const struct image *grass_image(struct stage *stage)
{
    enum { W = 16, H = 16 };
    struct image *image = stage_image(stage, W, H);
    for (int y = 0; image != NULL && y < H; y++)
        for (int x = 0; x < W; x++)
            stage_texel(image, x, y, mix(x < W / 2 ? 0x79b04c : 0x8abf58, 0x5f9440,
                                         0.4 * noise(x, y)));
    return image;
}

/* The letters of the hoardings, seven rows of five pixels, left pixel in bit 4. */
static const struct glyph { char letter; uint8_t row[7]; } glyphs[] = {
    { 'A', { 14, 17, 17, 31, 17, 17, 17 } }, { 'E', { 31, 16, 16, 30, 16, 16, 31 } },
    { 'M', { 17, 27, 21, 21, 17, 17, 17 } }, { 'R', { 30, 17, 17, 30, 20, 18, 17 } },
    { 'S', { 15, 16, 16, 14, 1, 1, 30 } },
};

static bool in_glyph(char letter, int x, int y)
{
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (glyphs[i].letter == letter && x >= 0 && x < 5 && y >= 0 && y < 7)
            return glyphs[i].row[y] >> (4 - x) & 1;
    return false;
}

/* A word above arrows. */
static const struct image *board_image(struct stage *stage)
{
    enum { W = 32, H = 16 };
    static const char word[] = "SMEAR";
    struct image *image = stage_image(stage, W, H);
    for (int y = 0; image != NULL && y < H; y++)
        for (int x = 0; x < W; x++) {
            uint32_t c = paint(0x1d3f78, 0x20);
            if (y < 9) {
                int at = (x - 1) / 6;
                if (x >= 1 && at < 5 && in_glyph(word[at], (x - 1) % 6, y - 1))
                    c = 0xfdf6e3;
            } else {
                c = (x + abs(y - 12)) % 8 < 4 ? paint(0x1f2430, 0x18) : paint(0xf5c02e, 0x90);
            }
            stage_texel(image, x, y, c);
        }
    return image;
}

/* ------------------------------------------------------------------ land */

/* Flat ground from z0 < z1 along the whole road, the picture `times` times along it. */
static void strip(struct build *b, double z0, double z1, double times, double across)
{
    struct vec3 up = vec3(0, 1, 0);
    uint32_t v = build_vertex(b, vec3(-road_end, 0, z0), up, 0, 0);
    build_vertex(b, vec3(-road_end, 0, z1), up, 0, across);
    build_vertex(b, vec3(road_end, 0, z1), up, times, across);
    build_vertex(b, vec3(road_end, 0, z0), up, times, 0);
    build_triangle(b, v, v + 1, v + 2);
    build_triangle(b, v, v + 2, v + 3);
}

static struct scene_surface *textured(struct build *b, const struct image *image)
{
    struct scene_surface *s = build_finish(b);
    if (s != NULL)
        s->material.image = image;
    return s;
}

/* A line painted on the road. */
static void line(struct build *b, double x0, double x1, double z)
{
    build_quad(b, vec3(x0, 0.012, z + 0.09), vec3(x1, 0.012, z + 0.09), vec3(x1, 0.012, z - 0.09),
               vec3(x0, 0.012, z - 0.09));
}

static struct scene_surface *road(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_NORMAL | (level->is_rich ? BUILD_UV : BUILD_FACE_COLOR));
    build_color(&b, paint(0x565b65, 0x30));
    strip(&b, road_left, road_right, 50, 1);
    if (level->is_rich)
        return textured(&b, road_image(stage));
    build_color(&b, paint(0xe9e6dc, 0xe0));
    line(&b, -road_end, road_end, road_left + 0.3);
    line(&b, -road_end, road_end, road_right - 0.3);
    for (int i = -3; i < 3; i++)
        line(&b, 4.6 * i, 4.6 * i + 2, -1.8);
    return build_finish(&b);
}

static struct scene_surface *kerbs(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    strip(&b, road_left - kerb, road_left, 120, 1);
    strip(&b, road_right, road_right + kerb, 120, 1);
    return textured(&b, kerb_image(stage));
}

static struct scene_surface *grass(struct stage *stage)
{
    bool has_picture = level->is_rich;
    struct build b = build_begin(stage, BUILD_NORMAL | (has_picture ? BUILD_UV : BUILD_FACE_COLOR));
    build_color(&b, paint(0x7db350, 0x3c));
    strip(&b, -30, road_left - kerb, 40, 4);
    strip(&b, road_right + kerb, 20, 40, 2);
    return textured(&b, has_picture ? grass_image(stage) : NULL);
}

static struct scene_surface *boards(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    double z = road_left - 2.4, slot = 5.2;
    for (int i = 0; i < level->boards; i++) {
        double x0 = slot * (i - level->boards / 2.0), x1 = x0 + slot - 0.9;
        struct vec3 corner[4] = { vec3(x0, 0.10, z), vec3(x1, 0.10, z), vec3(x1, 1.45, z - 0.2),
                                  vec3(x0, 1.45, z - 0.2) };
        uint32_t v[4];
        for (int k = 0; k < 4; k++)
            v[k] = build_vertex(&b, corner[k], vec3(0, 0.2, 1), k == 1 || k == 2, k < 2);
        build_triangle(&b, v[0], v[1], v[2]);
        build_triangle(&b, v[0], v[2], v[3]);
    }
    return textured(&b, board_image(stage));
}

static struct scene_surface *trees(struct stage *stage)
{
    static const uint32_t leaves[] = { 0x3f8f55, 0x2f7a52, 0x58a04e, 0xe2a23b, 0x4a9a58 };
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    for (int i = 0; i < level->trees; i++) {
        double x = 38.0 * ((i + 0.3 + 0.4 * noise(i, 1)) / level->trees - 0.5);
        double z = road_left - 5.5 - 6.0 * noise(i, 2), size = 0.9 + 0.6 * noise(i, 3);
        uint32_t c = paint(leaves[i % 5], 0x58);
        b.at = xform_mul(xform_move(x, 0, z), xform_scale(size, size, size));
        double trunk[4] = { 0.16, 0, 0.14, 0.9 }, high[4] = { 0.78, 1.75, 0, 3.5 };
        double low[4] = { 1.05, level->is_rich ? 0.7 : 0, 0, 2.5 };
        build_color(&b, paint(0x6a4a30, 0x30));
        if (level->is_rich)
            build_lathe(&b, trunk, 2, 3);
        build_color(&b, c);
        build_lathe(&b, low, 2, level->tree_sides);
        build_color(&b, mix(c, 0xffffff, 0.12));
        b.at = xform_mul(b.at, xform_turn_y(0.4));
        build_lathe(&b, high, 2, level->tree_sides);
    }
    return build_finish(&b);
}

/* Hills around the eye, as far as the cameras turn; they move with it. */
static struct scene_surface *hills(struct stage *stage)
{
    struct build b = build_begin(stage, level->is_rich ? BUILD_COLOR : BUILD_FACE_COLOR);
    int steps = level->hills;
    for (int i = 0; i <= steps; i++) {
        double a = PI * (0.70 + 0.90 * i / steps), wave = sin(3 * a + 1) + 0.7 * sin(5 * a);
        build_color(&b, paint(0xb4d6c4, 0x10));
        build_vertex(&b, vec3(90 * sin(a), -4, 90 * cos(a)), vec3(0, 1, 0), 0, 0);
        build_color(&b, paint(0x7fae92, 0x38));
        build_vertex(&b, vec3(90 * sin(a), 10 + 3.5 * wave, 90 * cos(a)), vec3(0, 1, 0), 0, 0);
    }
    build_color(&b, paint(0x90bfa4, 0x24));
    for (uint32_t i = 0; i < (uint32_t)steps; i++) {
        build_triangle(&b, 2 * i, 2 * i + 1, 2 * i + 3);
        build_triangle(&b, 2 * i, 2 * i + 3, 2 * i + 2);
    }
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = true;
    return s;
}

/* ------------------------------------------------------------------ car */

/* A cross section of the hull at x: half width, bottom, shoulder and top; the top is `roof` as
 * wide. */
static void section(struct vec3 *ring, double x, double half, double low, double shoulder,
                    double high, double roof)
{
    ring[0] = vec3(x, low, half * 0.8);
    ring[1] = vec3(x, low, -half * 0.8);
    ring[2] = vec3(x, shoulder, -half);
    ring[3] = vec3(x, high, -half * roof);
    ring[4] = vec3(x, high, half * roof);
    ring[5] = vec3(x, shoulder, half);
}

static void hull(struct build *b)
{
    static const struct { double x, half, low, shoulder, high, roof; } rib[6] = {
        { -1.75, 0.24, 0.34, 0.46, 0.58, 0.6 }, { -0.50, 0.60, 0.15, 0.48, 0.84, 0.4 },
        { -0.42, 0.60, 0.15, 0.48, 0.64, 0.6 }, { 0.62, 0.52, 0.16, 0.44, 0.62, 0.6 },
        { 1.40, 0.28, 0.22, 0.40, 0.50, 0.7 },  { 2.25, 0.10, 0.26, 0.32, 0.36, 0.7 },
    };
    static const int few[4] = { 0, 1, 3, 5 };
    struct vec3 ring[6 * 6];
    for (int i = 0; i < level->hull_rings; i++) {
        int r = level->hull_rings == 4 ? few[i] : i;
        section(ring + 6 * i, rib[r].x, rib[r].half, rib[r].low, rib[r].shoulder, rib[r].high,
                rib[r].roof);
    }
    build_color(b, paint(0xd8362c, 0xd0));
    build_loft(b, ring, level->hull_rings, 6);
}

static struct scene_surface *car(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    hull(&b);
    if (level->is_rich) {
        build_color(&b, 0xa8242a);
        for (int side = -1; side <= 1; side += 2)
            build_box(&b, vec3(-1.1, 0.16, side * 0.62 - 0.16), vec3(0.3, 0.52, side * 0.62 + 0.16));
        build_color(&b, 0x2a2d36);
        build_box(&b, vec3(-1.32, 0.34, -0.84), vec3(-1.22, 0.42, 0.84));
        build_box(&b, vec3(1.28, 0.34, -0.84), vec3(1.38, 0.42, 0.84));
        build_box(&b, vec3(-1.92, 0.50, -0.10), vec3(-1.76, 0.98, 0.10));
        build_color(&b, 0xf6ecd2);
        build_box(&b, vec3(-2.14, 0.6, 0.80), vec3(-1.62, 1.16, 0.86));
        build_box(&b, vec3(-2.14, 0.6, -0.86), vec3(-1.62, 1.16, -0.80));
    }
    build_color(&b, paint(0xf6ecd2, 0xf8));
    build_box(&b, vec3(1.80, 0.14, -0.98), vec3(2.28, 0.20, 0.98));
    build_box(&b, vec3(-2.12, 0.98, -0.84), vec3(-1.66, 1.06, 0.84));
    build_color(&b, paint(0xf2c230, 0x40));
    b.at = xform_move(-0.12, 0.84, 0);
    build_ball(&b, 0.24, level->ball_sides, level->ball_rings);
    return build_finish(&b);
}

/* One face of the wheel: three light sectors between dark ones. */
static void wheel_face(struct build *b, double r, int sides)
{
    for (int i = 0; i < sides; i++) {
        double a0 = 2 * PI * i / sides, a1 = 2 * PI * (i + 1) / sides;
        build_color(b, i % (sides / 3) == 0 ? paint(0xf4e9c8, 0xff) : paint(0x30323a, 0x28));
        uint32_t v = build_vertex(b, vec3(0, 0.17, 0), vec3(0, 1, 0), 0, 0);
        build_vertex(b, vec3(r * sin(a0), 0.17, r * cos(a0)), vec3(0, 1, 0), 0, 0);
        build_vertex(b, vec3(r * sin(a1), 0.17, r * cos(a1)), vec3(0, 1, 0), 0, 0);
        build_triangle(b, v, v + 1, v + 2);
    }
}

/* Lies along y; stands up when placed, its face outwards. */
static struct scene_surface *wheel(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    double r = 0.45, tread[4] = { r, -0.17, r, 0.17 };
    build_color(&b, paint(0x26262b, 0x50));
    build_lathe(&b, tread, 2, level->wheel_sides);
    wheel_face(&b, r, level->wheel_sides);
    if (level->is_rich) {
        b.at = xform_turn_x(PI);
        wheel_face(&b, r, level->wheel_sides);
    }
    return build_finish(&b);
}

static struct scene_surface *shadow(struct stage *stage)
{
    static const double corner[7][2] = {
        { 2.25, 0.9 }, { 2.25, -1.0 }, { 1.5, -1.25 }, { -2.4, -1.4 }, { -2.5, 0.3 },
        { -1.9, 0.95 }, { 1.6, 1.0 },
    };
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    build_color(&b, paint(0x33363f, 0x08));
    for (int i = 0; i < 7; i++)
        build_vertex(&b, vec3(corner[i][0], 0, corner[i][1]), vec3(0, 1, 0), 0, 0);
    for (uint32_t i = 1; i + 1 < 7; i++)
        build_triangle(&b, 0, i, i + 1);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.unlit = true;
    return s;
}

/* ------------------------------------------------------------------ drone */

static struct scene_surface *drone(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    build_color(&b, paint(0xf4f6f8, 0xd8));
    build_box(&b, vec3(-0.40, -0.10, -0.19), vec3(0.42, 0.10, 0.19));
    build_color(&b, paint(0x39424f, 0x70));
    for (int i = 0; i < 2; i++) {
        b.at = xform_turn_y(PI / 4 + PI / 2 * i);
        if (level->is_rich) {
            build_box(&b, vec3(-0.74, 0.00, -0.05), vec3(0.74, 0.07, 0.05));
            continue;
        }
        build_quad(&b, vec3(-0.74, 0.08, 0.06), vec3(0.74, 0.08, 0.06), vec3(0.74, 0.08, -0.06),
                   vec3(-0.74, 0.08, -0.06));
        build_quad(&b, vec3(-0.74, 0.08, -0.06), vec3(0.74, 0.08, -0.06), vec3(0.74, 0.08, 0.06),
                   vec3(-0.74, 0.08, 0.06));
    }
    return build_finish(&b);
}

/* Two flat blades that are seen from both sides, with bright tips. */
static struct scene_surface *rotor(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    for (int blade = 0; blade < 2; blade++) {
        double root = level->is_rich ? 0.36 : 0.02;
        b.at = xform_turn_y(PI * blade);
        build_color(&b, paint(0x222831, 0x80));
        if (level->is_rich)
            build_quad(&b, vec3(0.02, 0, 0.03), vec3(0.36, 0, 0.075), vec3(0.36, 0, -0.075),
                       vec3(0.02, 0, -0.03));
        build_color(&b, paint(0xf08a24, 0xf0));
        build_quad(&b, vec3(root, 0, 0.06), vec3(0.48, 0, 0.06), vec3(0.48, 0, -0.06),
                   vec3(root, 0, -0.06));
    }
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.double_sided = true;
    return s;
}

/* ------------------------------------------------------------------ writing */

static void build_props(struct stage *stage)
{
    static struct scene_surface *(*const make[PROP_COUNT])(struct stage *stage) = {
        [PROP_HILLS] = hills, [PROP_GRASS] = grass,   [PROP_ROAD] = road,   [PROP_KERBS] = kerbs,
        [PROP_TREES] = trees, [PROP_BOARDS] = boards, [PROP_CAR] = car,     [PROP_WHEEL] = wheel,
        [PROP_SHADOW] = shadow, [PROP_DRONE] = drone, [PROP_ROTOR] = rotor,
    };
    for (int i = 0; i < PROP_COUNT; i++)
        stage_add(stage, make[i](stage));
}

/* Where everything is matters not, as long as the library's unit becomes a metre: it does for a
 * near plane of one. */
static void place_props(double time, struct scene_instant *out)
{
    (void)time;
    stage_camera(out, xform_move(0, 0, 8), 60);
    out->camera.znear = 1;
    out->camera.zfar = 0;
}

/* Adds a frame, what stands still as it looks in its light, vertices that are alike as one. */
static bool add_baked(struct tape_writer *writer, const struct presented *frame, struct failure *f)
{
    static const uint8_t still[] = { PROP_GRASS, PROP_ROAD, PROP_KERBS, PROP_TREES, PROP_BOARDS };
    static struct demo_baked baked[sizeof still];
    static struct demo_welded welded[PROP_COUNT];
    struct presented with = *frame;
    smear_draw draw[PROP_COUNT];
    memcpy(draw, frame->draw, sizeof draw);
    with.draw = draw;
    for (size_t i = 0; i < sizeof still; i++)
        if (!demo_bake(&baked[i], &draw[still[i]]))
            return fail(f, "prop %d cannot be lit in advance", still[i]);
    for (int i = 0; i < PROP_COUNT; i++)
        if (!demo_weld(&welded[i], &draw[i]))
            return fail(f, "prop %d is too large", i);
    return tape_add(writer, &with, NULL, f);
}

static bool add_level(struct tape_writer *writer, struct failure *f)
{
    const struct stage_kind kind = { level->name, 8, 8, 0, 0, build_props, place_props };
    const struct present_options options = { .fps = 30, .method = SMEAR_NONE,
                                             .instant_only = true };
    struct scene scene = { 0 };
    if (!stage_open(&kind, 1, kind.name, &scene, f))
        return false;
    struct presenter *presenter = presenter_new(&scene, f);
    const struct presented *frame =
        presenter != NULL ? presenter_frame(presenter, 0, &options, f) : NULL;
    bool ok = frame != NULL;
    if (ok && (frame->draw_count != PROP_COUNT || frame->world_scale != 1.0))
        ok = fail(f, "%d props of scale %g", frame->draw_count, frame->world_scale);
    if (ok) {
        smear_desc desc = presented_desc(frame, 8, 8);
        ok = tape_begin(writer, level->name, &desc, f) && add_baked(writer, frame, f);
    }
    presenter_free(presenter);
    scene_free(&scene);
    return ok;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    if (argc != 2) {
        fprintf(stderr, "usage: demo_props OUT.c\n");
        return 2;
    }
    struct tape_writer *writer = tape_writer_new(&f);
    bool ok = writer != NULL;
    for (size_t i = 0; i < sizeof levels / sizeof *levels && ok; i++) {
        level = &levels[i];
        ok = add_level(writer, &f);
    }
    ok = ok && tape_write(writer, argv[1], "demo_props", &f);
    tape_writer_free(writer);
    if (!ok)
        fprintf(stderr, "demo_props: %s: %s\n", argv[1], f.text);
    return ok ? 0 : 1;
}
