/* SPDX-License-Identifier: MIT */
/* overlay_cost.c - what lies over a frame costs: a line of 20 letters, a needle 100 px long, a sprite of 32x32 that is turned, and 1, 50
 * and 200 points that move 10 px and are 2 px wide. Prints, in the units of platform.h's clock, a frame of 240x240 without them, RGB565
 * in two bands, over a clear and over a shaded square that fills it, and by how much it takes longer with them. */
#include "tests/target/cost.h"

#include "smear_overlay.h"

enum { POINTS = 200, STREAK = 10, DOT = 2 };

/* What is drawn, and over what. */
struct way {
    const char *name;
    smear_method method;
    smear_light_space light;
    bool drawn;                 /* the square */
};

static const struct way ways[] = {
    { "sharp, clear          ", SMEAR_NONE, SMEAR_LIGHT_ENCODED, false },
    { "sharp, drawn          ", SMEAR_NONE, SMEAR_LIGHT_ENCODED, true },
    { "auto, clear           ", SMEAR_AUTO, SMEAR_LIGHT_ENCODED, false },
    { "auto, drawn           ", SMEAR_AUTO, SMEAR_LIGHT_ENCODED, true },
    { "auto, drawn, linear   ", SMEAR_AUTO, SMEAR_LIGHT_LINEAR, true },
};

static const int16_t corner[] = { -200, -200, 0, 200, -200, 0, 200, 200, 0, -200, 200, 0 };
static const uint16_t side[] = { 0, 1, 2, 0, 2, 3 };
static const uint8_t color[] = { 20, 40, 90, 255, 120, 30, 20, 255, 40, 140, 60, 255, 200, 160, 90, 255 };
static const smear_mesh square = { .position = corner, .index = side, .color = color, .vertex_count = 4, .triangle_count = 2 };
static const smear_material unlit = { .unlit = 1 };
static const smear_overlay_item line = { .x = 8, .y = 8, .font = &smear_font_8x8, .text = "LAP 3  01:23.45  2ND" };
static const uint8_t bits[4 * 32] = { 0xff, 0xff, 0xff, 0xff, 0x0f, 0xf0, 0x0f, 0xf0 };
static const smear_image image = { bits, NULL, 32, 32, 1, SMEAR_IMAGE_MASK1 };
static const smear_overlay_item needle = { .x = 60, .y = 120, .shape = &smear_shape_line, .to_x = 1385, .to_y = -800, .width = 32 },
                                sprite = { .x = 100, .y = 100, .shape = &smear_shape_turned, .image = &image, .turn = 5000 };

static smear_point point[POINTS];

/* Returns the next of a row of numbers below `end`, the same on every machine. */
static int32_t random_below(uint32_t *seed, uint32_t end)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (int32_t)((*seed >> 8) % end);
}

/* q16 parts of a distance; both may be large. */
static int32_t part(int32_t distance, int32_t of)
{
    return (int32_t)((int64_t)distance * of >> 16);
}

/* Points all over the picture, 4 to 16 units away, each its own way. The picture is as wide as what lies between -z and z. */
static void make_points(void)
{
    static const int16_t way[8][2] = { { 256, 0 }, { 181, 181 }, { 0, 256 }, { -98, 237 }, { -237, 98 }, { -256, 0 }, { 50, -251 },
                                       { 213, -142 } };        /* as long as 256 */
    uint32_t seed = 7;
    for (int i = 0; i < POINTS; i++) {
        const int32_t z = 4 * ONE + random_below(&seed, 12 * ONE), pixel = z / (WIDTH / 2);
        const int32_t x = random_below(&seed, 2 * ONE) - ONE, y = random_below(&seed, 2 * ONE) - ONE;
        const int32_t now[3] = { part(x, z), part(y, z), -z };
        point[i] = (smear_point){ .size = DOT * pixel, .color = { 255, (uint8_t)(90 + i / 2), 40 },
                                  .mode = i % 3 == 0 ? SMEAR_POINT_BLEND : SMEAR_POINT_ADD };
        for (int k = 0; k < 3; k++) {               /* half a frame is exposed */
            point[i].now[k] = now[k];
            point[i].before[k] = now[k] - (k < 2 ? 2 * STREAK * pixel / 256 * way[i & 7][k] : 0);
        }
    }
}

/* Returns what a frame takes with `overlay`, which may be null; 0 where it fails. */
static uint32_t cost(const struct way *w, const smear_overlay *overlay)
{
    const smear_desc desc = {
        .width = WIDTH, .height = WIDTH, .reach = 12, .format = SMEAR_RGB565, .bands = 2,
        .methods = (uint16_t)SMEAR_SET(w->method), .tile = 16, .strip = w->method == SMEAR_NONE ? 0 : WIDTH,
        .max_draws = 4, .max_triangles = 64, .flush = swallow
    };
    const smear_camera eye = { .pose = SMEAR_IDENTITY, .focal = ONE, .near_plane = ONE / 2, .far_plane = 100 * ONE };
    const smear_frame frame = {
        .camera = &eye, .method = (uint8_t)w->method, .clear = 0x203040, .overlay = overlay,
        .light_space = (uint8_t)w->light, .target = SMEAR_DRAFT, .shutter = { .degrees = 180 }
    };
    smear_transform pose = SMEAR_IDENTITY;
    pose.origin[2] = -20 * ONE;
    for (int k = 0; k < 9; k += 4)
        pose.basis[k] = 2 << 20;
    const smear_draw draw = { .id = 1, .mesh = &square, .material = &unlit, .now = &pose };
    uint32_t count = begin_context(&desc);
    for (int i = 0; i < FRAMES && count != 0; i++)
        count = draw_frame(&frame, &draw, w->drawn);
    return count;
}

static bool report(const struct way *w)
{
    static const uint16_t counts[] = { 1, 50, POINTS };
    const smear_overlay text = { &line, 1, NULL }, shapes[2] = { { &needle, 1, NULL }, { &sprite, 1, NULL } };
    const uint32_t bare = cost(w, NULL), lettered = cost(w, &text);
    bool done = bare != 0 && lettered != 0;
    platform_print(w->name);
    print_decimal(bare);
    platform_print("; 20 letters +");
    print_decimal(lettered - bare);
    for (int i = 0; i < 2; i++) {
        const uint32_t all = cost(w, &shapes[i]);
        done = done && all != 0;
        platform_print(i == 0 ? "; needle +" : "; sprite +");
        print_decimal(all - bare);
    }
    platform_print("; points");
    for (int i = 0; i < 3; i++) {
        const smear_points points = { point, counts[i] };
        const smear_overlay overlay = { NULL, 0, &points };
        const uint32_t all = cost(w, &overlay);
        done = done && all != 0;
        platform_print(i == 0 ? " " : ", ");
        print_decimal(counts[i]);
        platform_print(": +");
        print_decimal(all - bare);
    }
    platform_print("\n");
    return done;
}

int main(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    bool done = true;
    make_points();
    begin_report(" per frame of 240x240, and by how much more with what lies over it\n");
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        done = report(&ways[i]) && done;
    return done ? 0 : 1;
}
