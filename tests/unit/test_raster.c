/* SPDX-License-Identifier: MIT */
/* test_raster.c - coverage, depth, colour, texels and velocity of triangles, against exact integer
 * arithmetic; and that cutting the frame into columns and bands never shows. Needs neither libc nor
 * floating point. */
#include "raster/front_order.h"
#include "raster/kept.h"
#include "raster/raster.h"

#include "base/pixel.h"
#include "geometry/transform.h"
#include "tests/random.h"
#include "tests/test.h"
#include "tests/unit/store.h"

enum { W = 64, H = 40, POOL_WORDS = 3600, SEGMENTS = 8 };

/* What a list is drawn into. */
struct planes {
    uint32_t color[W * H];
    uint16_t depth[W * H];
    int8_t velocity[W * H * 2];
    int32_t inspect[W * H * 2];
};

static struct planes full, cut;

static uint32_t store[POOL_WORDS];
static uint8_t moving[W / 8];
static uint32_t list_last;

/* ------------------------------------------------------------------ lists made by hand */

static void list_begin(void)
{
    store_begin(store, POOL_WORDS, SEGMENTS, W, H, false);
    list_last = SMEAR_NO_TRIANGLE;
}

/* A new vertex; returns its offset. The words beyond the place are the caller's to fill. */
static uint16_t add_vertex(int at, int32_t x, int32_t y, int32_t depth)
{
    uint16_t word = store_vertex(at);
    pool[word + VERTEX_X] = (uint32_t)x;
    pool[word + VERTEX_Y] = (uint32_t)y;
    pool[word + VERTEX_DEPTH] = (uint32_t)depth;
    return word;
}

/* Corners in any order: the raster wants them clockwise on the screen, and gets them so. */
static uint32_t add_triangle(int at, uint16_t a, uint16_t b, uint16_t c, uint32_t color)
{
    const int32_t *pa = (const int32_t *)pool + a, *pb = (const int32_t *)pool + b;
    const int32_t *pc = (const int32_t *)pool + c;
    if ((int64_t)(pb[VERTEX_X] - pa[VERTEX_X]) * (pc[VERTEX_Y] - pa[VERTEX_Y])
        < (int64_t)(pc[VERTEX_X] - pa[VERTEX_X]) * (pb[VERTEX_Y] - pa[VERTEX_Y])) {
        uint16_t swap = b;
        b = c;
        c = swap;
    }
    uint32_t i = geometry.triangle_count++;
    struct smear_triangle *t = bins_triangle(&geometry, i);
    *t = (struct smear_triangle){
        .vertex = { a, b, c }, .segment = (uint16_t)at, .next = SMEAR_NO_TRIANGLE, .color = color
    };
    if (list_last != SMEAR_NO_TRIANGLE)
        bins_triangle(&geometry, list_last)->next = i;
    list_last = i;
    return i;
}

static bool list_has_room(void)
{
    return bins_has_room(&geometry, 3 * 16, 1) && geometry.vertex_words < 65000u;
}

static void planes_clear(struct planes *p)
{
    for (int i = 0; i < W * H; i++) {
        p->color[i] = 0x123456u;
        p->depth[i] = 0;
        for (int axis = 0; axis < 2; axis++) {
            p->velocity[2 * i + axis] = 0;
            p->inspect[2 * i + axis] = 0;
        }
    }
}

static struct smear_raster_target target_of(struct planes *p)
{
    const struct smear_plane_rows rows = { W, 0, H, 0 };
    return (struct smear_raster_target){
        .x0 = 0, .y0 = 0, .x1 = W, .y1 = H, .color = p->color, .color_rows = rows,
        .depth = p->depth, .window_rows = rows, .velocity8 = p->velocity, .inspect = p->inspect,
        .moving = moving, .tile_shift = 3
    };
}

static void draw_list(struct planes *p)
{
    struct smear_raster_target t = target_of(p);
    smear_raster_list(&frame, &t, 0);
}

/* Draws a triangle of segment 0, and nothing else. */
static void draw_alone(const uint16_t v[3])
{
    add_triangle(0, v[0], v[1], v[2], 0xffffffffu);
    planes_clear(&full);
    draw_list(&full);
}

/* ------------------------------------------------------------------ exact coverage */

static int64_t area_of(int32_t (*p)[2])
{
    return edge_value(p[0], p[1], p[2][0], p[2][1]);
}

/* The top-left rule for the centre of pixel (px, py). */
static bool covers(int32_t (*p)[2], int32_t px, int32_t py)
{
    int32_t x = px * 256 + 128, y = py * 256 + 128;
    bool clockwise = area_of(p) > 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *a = p[i], *b = p[i == 2 ? 0 : i + 1];
        const int32_t *from = clockwise ? a : b, *to = clockwise ? b : a;
        int64_t e = edge_value(from, to, x, y);
        bool left = to[1] < from[1], top = to[1] == from[1] && to[0] > from[0];
        if (e < 0 || (e == 0 && !left && !top))
            return false;
    }
    return true;
}

static uint8_t count[W * H];

/* Draws the triangle alone, checks every pixel against the rule, and adds it to `count`. */
static bool draw_and_check(int32_t (*p)[2])
{
    if (area_of(p) == 0)
        return true;            /* never reaches the raster */
    list_begin();
    uint16_t v[3];
    for (int i = 0; i < 3; i++)
        v[i] = add_vertex(0, p[i][0], p[i][1], SMEAR_DEPTH_MAX / 2);
    int second = area_of(p) > 0 ? 1 : 2;        /* the list holds clockwise triangles */
    add_triangle(0, v[0], v[second], v[3 - second], 0xffffffffu);
    for (int i = 0; i < W * H; i++)
        full.depth[i] = 0;
    draw_list(&full);
    bool ok = true;
    for (int32_t y = 0; y < H && ok; y++) {
        for (int32_t x = 0; x < W && ok; x++) {
            bool drawn = full.depth[y * W + x] != 0;
            count[y * W + x] = (uint8_t)(count[y * W + x] + drawn);
            ok = drawn == covers(p, x, y);
            if (!ok) {
                CHECK_EQ(drawn, !drawn);
                CHECK_EQ(x, -1);
                CHECK_EQ(y, -1);
                for (int i = 0; i < 3; i++) {
                    CHECK_EQ(p[i][0], INT32_MIN);
                    CHECK_EQ(p[i][1], INT32_MIN);
                }
            }
        }
    }
    return ok;
}

static void count_clear(void)
{
    for (int i = 0; i < W * H; i++)
        count[i] = 0;
}

/* Every pixel whose centre lies in the rectangle [x0, x1) x [y0, y1) was drawn once, all others
 * never. */
static bool check_counts(int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++) {
            int32_t cx = x * 256 + 128, cy = y * 256 + 128;
            int want = cx >= x0 && cx < x1 && cy >= y0 && cy < y1;
            if (!CHECK_EQ(count[y * W + x], want))
                return false;
        }
    return true;
}

/* ------------------------------------------------------------------ coverage */

static void test_corners_on_pixel_centres_follow_the_top_left_rule(void)
{
    /* A square from centre (1, 1) to centre (4, 3) holds the columns 1 2 3 and the rows 1 2. */
    const int32_t left = 384, top = 384, right = 1152, bottom = 896;
    int32_t a[3][2] = { { left, top }, { right, top }, { right, bottom } };
    int32_t b[3][2] = { { left, top }, { right, bottom }, { left, bottom } };
    count_clear();
    draw_and_check(a);
    draw_and_check(b);
    for (int y = 0; y < 6; y++)
        for (int x = 0; x < 6; x++)
            CHECK_EQ(count[y * W + x], x >= 1 && x <= 3 && y >= 1 && y <= 2);
}

static void test_random_triangles_of_every_size_cover_exactly_their_centres(void)
{
    random_state = 2;
    for (int n = 0; n < 400; n++) {
        int32_t size = 16 << (n % 11);          /* 1/16 px to 64 px */
        int32_t x = between(0, W * 256), y = between(0, H * 256), p[3][2];
        for (int i = 0; i < 3; i++) {
            p[i][0] = x + between(-size, size);
            p[i][1] = y + between(-size, size);
            if (chance(4)) {                    /* on a pixel's centre or border */
                p[i][0] = (p[i][0] & ~127);
                p[i][1] = (p[i][1] & ~127);
            }
        }
        END_UNLESS(draw_and_check(p));
    }
}

static void test_triangles_that_reach_the_guard_band_cover_exactly_their_centres(void)
{
    /* All that the assembler lets through: 2048 px from the frame's centre, edges of 4096 px. */
    const int32_t guard = SMEAR_GUARD_PX << 8, cx = W << 7, cy = H << 7;
    random_state = 4;
    for (int n = 0; n < 150; n++) {
        int32_t p[3][2];
        for (int i = 0; i < 3; i++) {
            bool near = chance(3);
            int32_t reach = near ? 40 << 8 : guard;
            p[i][0] = cx + (chance(3) && !near ? (chance(2) ? -guard : guard) : between(-reach, reach));
            p[i][1] = cy + (chance(3) && !near ? (chance(2) ? -guard : guard) : between(-reach, reach));
        }
        END_UNLESS(draw_and_check(p));
    }
    /* Slivers whose long edges all but coincide. */
    for (int n = 0; n < 60; n++) {
        int32_t p[3][2] = { { cx - guard, cy + between(-5000, 5000) },
                            { cx + guard, cy + between(-5000, 5000) }, { 0, 0 } };
        p[2][0] = chance(2) ? p[0][0] : p[1][0];
        p[2][1] = (chance(2) ? p[0][1] : p[1][1]) + between(-3, 3);
        if (n & 1)
            for (int i = 0; i < 3; i++) {
                int32_t keep = p[i][0] - cx;
                p[i][0] = p[i][1] - cy + cx;
                p[i][1] = keep + cy;
            }
        END_UNLESS(draw_and_check(p));
    }
}

/* A triangulation of a rectangle: grown by splitting, so that it has no T junctions. Corners are
 * clockwise on the screen; adjacent[i] lies across the edge from corner i to the next. */
enum { MESH_MAX = 160 };
static struct { int16_t corner[3], adjacent[3]; } mesh[MESH_MAX];
static int32_t point[MESH_MAX][2];
static int mesh_count, point_count;

static int64_t orient(int a, int b, int c)
{
    return edge_value(point[a], point[b], point[c][0], point[c][1]);
}

static void relink(int triangle, int old, int fresh)
{
    if (triangle < 0)
        return;
    for (int i = 0; i < 3; i++)
        if (mesh[triangle].adjacent[i] == old)
            mesh[triangle].adjacent[i] = (int16_t)fresh;
}

static void set_triangle(int t, int a, int b, int c, int ab, int bc, int ca)
{
    mesh[t].corner[0] = (int16_t)a;
    mesh[t].corner[1] = (int16_t)b;
    mesh[t].corner[2] = (int16_t)c;
    mesh[t].adjacent[0] = (int16_t)ab;
    mesh[t].adjacent[1] = (int16_t)bc;
    mesh[t].adjacent[2] = (int16_t)ca;
}

static void mesh_rectangle(int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    const int32_t corner[4][2] = { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
    for (int i = 0; i < 4; i++)
        for (int axis = 0; axis < 2; axis++)
            point[i][axis] = corner[i][axis];
    point_count = 4;
    mesh_count = 2;
    set_triangle(0, 0, 1, 2, -1, -1, 1);
    set_triangle(1, 0, 2, 3, 0, -1, -1);
}

/* Puts a point strictly inside triangle t; false when there is none at the chosen place. */
static bool split_face(int t, int32_t x, int32_t y)
{
    int a = mesh[t].corner[0], b = mesh[t].corner[1], c = mesh[t].corner[2], p = point_count;
    if (mesh_count + 2 > MESH_MAX || point_count == MESH_MAX)
        return false;
    point[p][0] = x;
    point[p][1] = y;
    if (orient(a, b, p) <= 0 || orient(b, c, p) <= 0 || orient(c, a, p) <= 0)
        return false;
    int ab = mesh[t].adjacent[0], bc = mesh[t].adjacent[1], ca = mesh[t].adjacent[2];
    int u = mesh_count, v = mesh_count + 1;
    point_count++;
    mesh_count += 2;
    set_triangle(t, a, b, p, ab, u, v);
    set_triangle(u, b, c, p, bc, v, t);
    set_triangle(v, c, a, p, ca, t, u);
    relink(bc, t, u);
    relink(ca, t, v);
    return true;
}

/* Turns the diagonal between triangle t and the one across its edge i, where that stays a mesh. */
static bool flip_edge(int t, int i)
{
    int o = mesh[t].adjacent[i];
    if (o < 0)
        return false;
    int j = 0;
    while (mesh[o].adjacent[j] != t)
        j++;
    int a = mesh[t].corner[i], b = mesh[t].corner[(i + 1) % 3], c = mesh[t].corner[(i + 2) % 3];
    int d = mesh[o].corner[(j + 2) % 3];
    if (orient(a, d, c) <= 0 || orient(d, b, c) <= 0)
        return false;
    int bc = mesh[t].adjacent[(i + 1) % 3], ca = mesh[t].adjacent[(i + 2) % 3];
    int ad = mesh[o].adjacent[(j + 1) % 3], db = mesh[o].adjacent[(j + 2) % 3];
    set_triangle(t, a, d, c, ad, o, ca);
    set_triangle(o, d, b, c, db, bc, t);
    relink(ad, o, t);
    relink(bc, t, o);
    return true;
}

static void flip_any_edge(void)
{
    int t = between(0, mesh_count - 1);
    flip_edge(t, between(0, 2));
}

static bool mesh_draw_all(void)
{
    count_clear();
    for (int t = 0; t < mesh_count; t++) {
        int32_t p[3][2];
        for (int i = 0; i < 3; i++)
            for (int axis = 0; axis < 2; axis++)
                p[i][axis] = point[mesh[t].corner[i]][axis];
        if (!draw_and_check(p))
            return false;
    }
    return true;
}

/* A place inside triangle t: near a corner, near an edge or anywhere; perhaps on a pixel centre. */
static void place_in(int t, int32_t out[2])
{
    int32_t weight[3];
    int style = between(0, 3);
    for (int i = 0; i < 3; i++)
        weight[i] = style == 0 ? between(1, 1000) : style == 1 ? between(1, 3) : 300;
    if (style >= 2)
        weight[between(0, 2)] = style == 2 ? 1 : 30000;
    int32_t sum = weight[0] + weight[1] + weight[2];
    for (int axis = 0; axis < 2; axis++) {
        int64_t total = 0;
        for (int i = 0; i < 3; i++)
            total += (int64_t)point[mesh[t].corner[i]][axis] * weight[i];
        out[axis] = (int32_t)(total / sum);
        if (style == 1)
            out[axis] = (out[axis] & ~255) + 128;
    }
}

static void grow_mesh(int triangles)
{
    for (int tries = 0; mesh_count + 2 <= triangles && tries < 4 * triangles; tries++) {
        int t = between(0, mesh_count - 1);
        int32_t place[2];
        place_in(t, place);
        split_face(t, place[0], place[1]);
        for (int i = 0; i < 3; i++)
            flip_any_edge();
    }
}

/* ------------------------------------------------------------------ exact attributes */

static uint32_t *words_at(uint16_t vertex, int offset)
{
    return pool + vertex + offset;
}

static void set_uv(int at, uint16_t vertex, int32_t u, int32_t v)
{
    *words_at(vertex, segment[at].uv) = ((uint32_t)u & 0xffffu) | (uint32_t)v << 16;
}

static void set_color(int at, uint16_t vertex, const uint16_t channel[4])
{
    words_at(vertex, segment[at].color)[0] = channel[0] | (uint32_t)channel[1] << 16;
    words_at(vertex, segment[at].color)[1] = channel[2] | (uint32_t)channel[3] << 16;
}

static void set_motion(int at, uint16_t vertex, int pose, int32_t dx, int32_t dy, int32_t ratio)
{
    uint32_t *motion = words_at(vertex, segment[at].motion + pose * MOTION_WORDS);
    motion[MOTION_DX] = (uint32_t)dx;
    motion[MOTION_DY] = (uint32_t)dy;
    motion[MOTION_RATIO] = (uint32_t)ratio;
}

/* Weights of the corners at a pixel's centre; they add up to the area, which is positive. */
static void weights_at(int32_t (*p)[2], int32_t px, int32_t py, int64_t *weight)
{
    int32_t centre[2] = { px * 256 + 128, py * 256 + 128 };
    bool clockwise = area_of(p) > 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        int64_t e = edge_value(a, b, centre[0], centre[1]);
        weight[i] = clockwise ? e : -e;
    }
}

static int64_t floor_divide(int64_t a, int64_t b)
{
    int64_t q = a / b;
    return a % b < 0 ? q - 1 : q;
}

/* sum weight value / sum weight, exact, for values below 2^31 and weights below 2^42. */
static int64_t weighted(const int64_t weight[3], const int32_t value[3])
{
    int64_t high = 0, low = 0, area = weight[0] + weight[1] + weight[2];
    for (int i = 0; i < 3; i++) {
        high += weight[i] * (value[i] >> 15);
        low += weight[i] * (value[i] & 0x7fff);
    }
    int64_t whole = floor_divide(high, area);
    return whole * 32768 + floor_divide((high - whole * area) * 32768 + low, area);
}

/* Random corners of a triangle of at least `pixels` square pixels; false when luck is out. */
static bool fat_triangle(int32_t (*p)[2], int32_t pixels, int32_t low, int32_t high_x, int32_t high_y)
{
    for (int tries = 0; tries < 50; tries++) {
        for (int i = 0; i < 3; i++) {
            p[i][0] = between(low, high_x);
            p[i][1] = between(low, high_y);
        }
        int64_t area = area_of(p);
        if (area > (int64_t)pixels << 17 || area < -((int64_t)pixels << 17))
            return true;
    }
    return false;
}

/* Code of exact depth units in q11, rounded as smear_depth_units undoes it. */
static int32_t code_of(int64_t units_q11)
{
    int64_t units = (units_q11 + 1024) >> 11;
    return (int32_t)(units < 32768 ? units : 32768 + ((units_q11 - (32768 << 11) + (8 << 11)) >> 15));
}

/* Corners within `size` of a place in the frame, of at least so much area; false when luck is out. */
static bool small_triangle(int32_t (*p)[2], int32_t size, int64_t least)
{
    int32_t x = between(600, 12000), y = between(600, 8000);
    for (int i = 0; i < 3; i++) {
        p[i][0] = x + between(-size, size);
        p[i][1] = y + between(-size, size);
    }
    return area_of(p) >= least || area_of(p) <= -least;
}

static void draw_depths(int32_t (*p)[2], const int32_t q[3])
{
    uint16_t v[3];
    list_begin();
    for (int i = 0; i < 3; i++)
        v[i] = add_vertex(0, p[i][0], p[i][1], q[i]);
    draw_alone(v);
}

/* The depth of a pixel is what its weights make of the corners'. */
static bool check_depth(int32_t (*p)[2], const int32_t q[3], int32_t x, int32_t y, int32_t slack)
{
    int64_t weight[3];
    weights_at(p, x, y, weight);
    return CHECK_NEAR(full.depth[y * W + x], code_of(weighted(weight, q)), slack);
}

static bool check_depths(int32_t (*p)[2], const int32_t q[3], int32_t slack)
{
    draw_depths(p, q);
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++)
            if (covers(p, x, y) && !check_depth(p, q, x, y, slack))
                return false;
    return true;
}

static void test_depth_is_the_plane_through_the_corners(void)
{
    random_state = 11;
    for (int n = 0; n < 320; n++) {
        const int32_t guard = SMEAR_GUARD_PX << 8;
        int32_t p[3][2], q[3];
        const bool tiny = n >= 120, large = !tiny && n % 4 == 3;
        if (tiny ? !small_triangle(p, 300 << n % 3, 30000)
                 : !fat_triangle(p, 64, large ? -guard : -1000, large ? guard : W * 256, large ? guard : H * 256))
            continue;
        /* Everywhere from the far end to the near plane; a third of them reaches over its break. */
        int32_t level = between(0, 13);
        for (int i = 0; i < 3; i++)
            q[i] = tiny        ? (1 << 20 << n % 9) + between(0, 1 << 18 << n % 9)
                 : n % 3 == 0  ? between(SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX)
                 : n % 3 == 1  ? (32768 << 11) + between(-(1 << 24), 1 << 24)
                              : SMEAR_DEPTH_MIN + between(0, SMEAR_DEPTH_MAX - SMEAR_DEPTH_MIN) / (1 << level);
        /* Gradients are rounded to 1/2 step of q11 per pixel: 1/32 unit over 64 px, two over 4096. */
        END_UNLESS(check_depths(p, q, large ? 3 : 1));
    }
}

static void test_depth_codes_grow_over_the_break(void)
{
    /* A row in which units run from 16384 to 65536: every pixel is drawn, codes never fall. */
    list_begin();
    uint16_t a = add_vertex(0, 0, 0, 16384 << 11), b = add_vertex(0, W * 256, 0, 65536 << 11);
    uint16_t c = add_vertex(0, W * 256, H * 256, 65536 << 11), d = add_vertex(0, 0, H * 256, 16384 << 11);
    add_triangle(0, a, b, c, 0xffffffffu);
    add_triangle(0, a, c, d, 0xffffffffu);
    planes_clear(&full);
    draw_list(&full);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            int32_t units = 16384 + (2 * x + 1) * 49152 / (2 * W);
            CHECK_NEAR((int32_t)smear_depth_units(full.depth[y * W + x]), units, units < 32768 ? 2 : 17);
            if (x > 0 && !CHECK(full.depth[y * W + x] > full.depth[y * W + x - 1]))
                return;
        }
    CHECK_EQ(smear_depth_units(32767), 32767);
    CHECK_EQ(smear_depth_units(32768), 32768);
    CHECK_EQ(smear_depth_units(32769), 32784);
    CHECK_EQ(smear_depth_units(65535), SMEAR_DEPTH_NEAR);
    CHECK_EQ(code_of((int64_t)SMEAR_DEPTH_NEAR << 11), 65535);
}

/* Channel c of a working pixel. */
static int32_t code_in(uint32_t pixel, int c)
{
    return (int32_t)(pixel >> (16 - 8 * c) & 255u);
}

/* A triangle with random colours; checks each pixel against the exact mean of its corners' values. */
static bool check_colors(int32_t (*p)[2], const int32_t q[3], bool flat_depth, bool linear, int32_t slack)
{
    list_begin();
    set_layout(0, false, true, 0, SHADE_GOURAUD);
    segment[0].flat_depth = flat_depth;
    frame.linear = linear;
    uint16_t v[3], channel[3][4];
    for (int i = 0; i < 3; i++) {
        for (int c = 0; c < 4; c++)
            channel[i][c] = (uint16_t)(chance(4) ? chance(2) ? 0 : 65535 : between(0, 65535));
        if (!linear)
            for (int c = 0; c < 3; c++)
                channel[i][c] = (uint16_t)(channel[i][c] & 0xff00);
        v[i] = add_vertex(0, p[i][0], p[i][1], q[i]);
        set_color(0, v[i], channel[i]);
    }
    draw_alone(v);
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++) {
            if (!covers(p, x, y))
                continue;
            int64_t weight[3], sum = 0;
            weights_at(p, x, y, weight);
            if (!check_depth(p, q, x, y, 1))
                return false;
            for (int i = 0; i < 3; i++) {
                weight[i] = flat_depth ? weight[i] : (weight[i] >> 8) * (q[i] >> 14);
                sum += weight[i];
            }
            for (int c = 0; c < 3; c++) {
                int64_t total = 0;
                for (int i = 0; i < 3; i++)
                    total += weight[i] * (channel[i][c] >> 4);
                int64_t mean = total / sum;             /* 12 bits */
                int32_t want = linear ? smear_srgb_encode[mean > 4095 ? 4095 : mean] : (int32_t)((mean + 8) >> 4);
                if (!CHECK_NEAR(code_in(full.color[y * W + x], c), want, slack))
                    return false;
            }
        }
    return true;
}

/* Texels that say where they are: u in the low byte and a half, v above. */
enum { TEXELS = 64 * 64 };
static uint32_t texels[TEXELS];

static void set_texture(int at, int32_t width, int32_t height, int wrap_u, int wrap_v, int uv_shift)
{
    for (int32_t v = 0; v < height; v++)
        for (int32_t u = 0; u < width; u++)
            texels[v * width + u] = 0xff000000u | (uint32_t)v << 12 | (uint32_t)u;
    const smear_texture texture = {
        .texels = texels, .width = (uint16_t)width, .height = (uint16_t)height,
        .wrap_u = (uint8_t)wrap_u, .wrap_v = (uint8_t)wrap_v
    };
    smear_sampler_make(&draw[at].sampler, &texture, uv_shift, false, false);
}

/* The texel that a wrap mode shows at integer coordinate i. */
static int32_t wrapped(int64_t i, int32_t size, int mode)
{
    if (mode == SMEAR_CLAMP)
        return (int32_t)(i < 0 ? 0 : i >= size ? size - 1 : i);
    int32_t period = mode == SMEAR_MIRROR ? 2 * size : size, at = (int32_t)(i % period);
    at = at < 0 ? at + period : at;
    return at < size ? at : period - 1 - at;
}

/* True when `got` is a texel that a coordinate (q8) moved by at most `slack` would show. */
static bool is_near_texel(int32_t got, int64_t coordinate, int64_t slack, int32_t size, int mode)
{
    for (int64_t move = -slack; move < slack; move += 64)
        if (wrapped(floor_divide(coordinate + move, 256), size, mode) == got)
            return true;
    return wrapped(floor_divide(coordinate + slack, 256), size, mode) == got;
}

/* A textured triangle. */
struct textured {
    int32_t p[3][2], q[3], uv[3][2];
    int32_t width, height;
    int wrap_u, wrap_v, uv_shift;
};

/* Exact texel coordinates at a pixel, q8. False where the point is behind the eye: beyond the triangle. */
static bool texel_exactly(struct textured *t, int32_t x, int32_t y, int64_t out[2])
{
    int64_t weight[3], sum = 0;
    weights_at(t->p, x, y, weight);
    for (int i = 0; i < 3; i++) {           /* at most 2^29 x 2^12 */
        weight[i] *= t->q[i] >> 18;
        sum += weight[i];
    }
    for (int axis = 0; axis < 2 && sum > 0; axis++) {
        int64_t total = 0;
        for (int i = 0; i < 3; i++)
            total += weight[i] * t->uv[i][axis];
        int64_t ratio = floor_divide(total * 32, sum);          /* q5 mesh units */
        out[axis] = floor_divide(ratio * (axis == 0 ? t->width : t->height) * 8, (int64_t)1 << t->uv_shift);
    }
    return sum > 0;
}

static int64_t distance_of(int64_t a, int64_t b)
{
    return a > b ? a - b : b - a;
}

/* Texels are those of the exact coordinate, moved by at most half a texel or half a pixel on the screen. */
static bool check_texel_at(struct textured *t, int32_t x, int32_t y, uint32_t got)
{
    int64_t exact[2], there[2], per_pixel[2] = { 0, 0 };
    texel_exactly(t, x, y, exact);
    for (int side = 0; side < 4; side++) {
        if (!texel_exactly(t, x + (side == 0) - (side == 1), y + (side == 2) - (side == 3), there))
            continue;
        for (int axis = 0; axis < 2; axis++)
            if (distance_of(there[axis], exact[axis]) > per_pixel[axis])
                per_pixel[axis] = distance_of(there[axis], exact[axis]);
    }
    for (int axis = 0; axis < 2; axis++) {
        int64_t slack = per_pixel[axis] / 2 > 128 ? per_pixel[axis] / 2 : 128;
        int32_t texel = (int32_t)(got >> 12 * axis & 4095u);
        if (!CHECK(is_near_texel(texel, exact[axis], slack, axis == 0 ? t->width : t->height,
                                 axis == 0 ? t->wrap_u : t->wrap_v))) {
            CHECK_EQ(x * 1000 + y, -1);
            CHECK_EQ(texel * 256, exact[axis]);
            return false;
        }
    }
    return true;
}

static bool check_texels(struct textured *t)
{
    list_begin();
    set_layout(0, true, false, 0, SHADE_NONE);
    set_texture(0, t->width, t->height, t->wrap_u, t->wrap_v, t->uv_shift);
    uint16_t v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = add_vertex(0, t->p[i][0], t->p[i][1], t->q[i]);
        set_uv(0, v[i], t->uv[i][0], t->uv[i][1]);
    }
    draw_alone(v);
    int32_t (*p)[2] = t->p;
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++) {
            if (!covers(p, x, y))
                continue;
            if (!check_depth(p, t->q, x, y, 1)
                || !check_texel_at(t, x, y, full.color[y * W + x] & 0xffffffu))
                return false;
        }
    return true;
}

/* ------------------------------------------------------------------ velocity */

/* A moving triangle against the exact quotient; `slack` in 1/256 px. */
static bool check_velocity(int32_t (*p)[2], int poses, int32_t motion[2][3][3], int32_t slack)
{
    list_begin();
    set_layout(0, false, false, poses, SHADE_FLAT);
    uint16_t v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = add_vertex(0, p[i][0], p[i][1], 1 << 28);
        for (int pose = 0; pose < poses; pose++)
            set_motion(0, v[i], pose, motion[pose][i][0], motion[pose][i][1], motion[pose][i][2]);
    }
    draw_alone(v);
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++) {
            if (!covers(p, x, y)) {
                if (!CHECK_EQ(full.inspect[2 * (y * W + x)], 0))
                    return false;
                continue;
            }
            int64_t weight[3];
            int32_t want[2] = { 0, 0 };
            weights_at(p, x, y, weight);
            for (int pose = 0; pose < poses; pose++)
                for (int axis = 0; axis < 2; axis++) {
                    int64_t top = 0, ratio = 0;
                    for (int i = 0; i < 3; i++) {       /* 2^22 x (2^12 x 2^15 + 2^27) */
                        int64_t b = weight[i] >> 8, r = motion[pose][i][2] >> 8;
                        top += b * (r * p[i][axis] + motion[pose][i][axis] * 4096);
                        ratio += b * r;
                    }
                    int32_t there = (int32_t)floor_divide(top, ratio) - ((axis == 0 ? x : y) * 256 + 128);
                    want[axis] += pose == 0 ? -there : there;
                }
            for (int axis = 0; axis < 2; axis++) {
                int32_t got = full.inspect[2 * (y * W + x) + axis];
                if (!CHECK_NEAR(got, want[axis], slack))
                    return false;
                /* The packed one: half of it (the shutter is open all the time), in 1/8 px, no longer than the reach. */
                int64_t length = (int64_t)want[0] * want[0] + (int64_t)want[1] * want[1];
                int64_t reach = 2 * 15 * 256;
                int32_t packed = full.velocity[2 * (y * W + x) + axis];
                if (length < (reach - 256) * (reach - 256) && !CHECK_NEAR(packed * 64, want[axis], slack + 40))
                    return false;
            }
            int32_t vx = full.velocity[2 * (y * W + x)], vy = full.velocity[2 * (y * W + x) + 1];
            if (!CHECK(vx * vx + vy * vy <= (15 * 8 + 1) * (15 * 8 + 1)))
                return false;
        }
    return true;
}

/* ------------------------------------------------------------------ which pixel wins */

static void test_the_nearest_wins_in_any_order_and_the_first_of_equals(void)
{
    random_state = 21;
    enum { N = 24 };
    int32_t p[N][3][2];
    for (int equal = 0; equal < 2; equal++) {
        for (int i = 0; i < N; i++)
            fat_triangle(p[i], 64, -500, W * 256, H * 256);
        for (int turn = 0; turn < 3; turn++) {
            list_begin();
            for (int k = 0; k < N; k++) {
                int i = equal || turn == 0 ? k : turn == 1 ? N - 1 - k : k * 7 % N;
                uint16_t v[3];
                for (int c = 0; c < 3; c++)
                    v[c] = add_vertex(0, p[i][c][0], p[i][c][1], equal ? 1 << 27 : (i * 5 % N + 10) << 22);
                add_triangle(0, v[0], v[1], v[2], 0xff000000u | (uint32_t)(i + 1));
            }
            planes_clear(&full);
            draw_list(&full);
            for (int32_t y = 0; y < H; y++)
                for (int32_t x = 0; x < W; x++) {
                    uint32_t want = 0x123456u;
                    int best = -1;
                    for (int i = 0; i < N; i++)
                        if (covers(p[i], x, y) && (best < 0 || (!equal && i * 5 % N > best * 5 % N)))
                            best = i;
                    if (best >= 0)
                        want = (uint32_t)best + 1;
                    REQUIRE_EQ(full.color[y * W + x], want);
                }
        }
    }
}

/* ------------------------------------------------------------------ cuts of the frame */

/* Three corners around a place, no farther from it than `size` along x and y; false where they lie in a line. */
static bool random_corners(int32_t (*p)[2], int32_t x, int32_t y, int32_t size)
{
    for (int i = 0; i < 3; i++) {
        p[i][0] = x + between(-size, size);
        p[i][1] = y + between(-size, size);
    }
    return area_of(p) != 0;
}

/* A list of everything there is: all kinds of vertices, poses, textures, alpha; large, small and huge. */
static void random_list(void)
{
    list_begin();
    frame.linear = chance(2);
    set_texture(0, 32, 16, SMEAR_REPEAT, SMEAR_REPEAT, 15);
    for (int i = 0; i < SEGMENTS; i++) {
        bool uv = i & 1, color = i & 2;
        int moves = between(0, 2);
        set_layout(i, uv, color, moves, color ? SHADE_GOURAUD : uv && chance(2) ? SHADE_NONE : SHADE_FLAT);
        segment[i].flat_depth = chance(4);
        draw[i].alpha = (uint8_t)(chance(2) ? SMEAR_OPAQUE : chance(2) ? SMEAR_CUTOUT : SMEAR_BLEND);
        if (draw[i].alpha == SMEAR_BLEND)
            set_layout(i, uv, color, 0, (enum smear_shade_mode)segment[i].shade);
        int wrap_u = between(0, 2), wrap_v = between(0, 2);
        const smear_texture texture = {
            .texels = texels, .width = chance(2) ? 32 : 23, .height = 16,
            .wrap_u = (uint8_t)wrap_u, .wrap_v = (uint8_t)wrap_v
        };
        int uv_shift = between(12, 15);
        smear_sampler_make(&draw[i].sampler, &texture, uv_shift, chance(4), frame.linear);
    }
    for (uint32_t i = 0; i < 32 * 16; i++)
        texels[i] = random_u32();
    /* One of the plainest textured kind, which has a loop of its own. */
    set_layout(1, true, false, between(0, 1), SHADE_NONE);
    draw[1].alpha = SMEAR_OPAQUE;
    const smear_texture plain = { .texels = texels, .width = 32, .height = 16 };
    smear_sampler_make(&draw[1].sampler, &plain, 13, false, frame.linear);
    for (int n = 0; n < 40 && list_has_room(); n++) {
        int at = between(0, SEGMENTS - 1);
        int32_t size = chance(4) ? SMEAR_GUARD_PX << 8 : 256 << between(0, 6), p[3][2];
        int32_t x = size > 1 << 16 ? W << 7 : between(0, W * 256), y = size > 1 << 16 ? H << 7 : between(0, H * 256);
        int32_t level = between(0, 8);
        uint16_t v[3];
        if (!random_corners(p, x, y, size))
            continue;
        for (int i = 0; i < 3; i++) {
            int32_t depth = SMEAR_DEPTH_MIN + between(0, SMEAR_DEPTH_MAX - SMEAR_DEPTH_MIN) / (1 << level);
            v[i] = add_vertex(at, p[i][0], p[i][1], depth);
            if (segment[at].uv != 0) {
                int32_t s = between(-32768, 32767), t = between(-32768, 32767);
                set_uv(at, v[i], s, t);
            }
            if (segment[at].color != 0) {
                uint16_t channel[4];
                for (int c = 0; c < 4; c++)
                    channel[c] = (uint16_t)random_u32();
                set_color(at, v[i], channel);
            }
            for (int pose = 0; pose < segment[at].moves; pose++) {
                int32_t reach = 16 << between(0, 12);
                int32_t dx = between(-reach, reach), dy = between(-reach, reach);
                set_motion(at, v[i], pose, dx, dy, n & 1 ? 1 << 20 : between(1 << 14, 1 << 22));
            }
        }
        add_triangle(at, v[0], v[1], v[2], random_u32());
    }
}

static bool same_planes(const struct planes *a, const struct planes *b)
{
    for (int i = 0; i < W * H; i++) {
        bool same = a->color[i] == b->color[i] && a->depth[i] == b->depth[i];
        for (int axis = 0; axis < 2; axis++)
            same = same && a->velocity[2 * i + axis] == b->velocity[2 * i + axis]
                && a->inspect[2 * i + axis] == b->inspect[2 * i + axis];
        if (!same) {
            CHECK_EQ(i % W, -1);
            CHECK_EQ(i / W, -1);
            CHECK_EQ(a->color[i], b->color[i]);
            CHECK_EQ(a->depth[i], b->depth[i]);
            CHECK_EQ(a->velocity[2 * i], b->velocity[2 * i]);
            return CHECK_EQ(a->inspect[2 * i], b->inspect[2 * i]);
        }
    }
    return true;
}

static void test_cutting_the_frame_into_columns_and_bands_changes_nothing(void)
{
    random_state = 22;
    for (int n = 0; n < 60; n++) {
        random_list();
        planes_clear(&full);
        draw_list(&full);
        planes_clear(&cut);
        int32_t column = 16 * between(1, 4), band = chance(3) ? 8 : between(1, H);
        for (int32_t y = 0; y < H; y += band)
            for (int32_t x = 0; x < W; x += column) {
                struct smear_raster_target t = target_of(&cut);
                t.x0 = x;
                t.x1 = x + column < W ? x + column : W;
                t.y0 = y;
                t.y1 = y + band < H ? y + band : H;
                t.color_rows.ring_row = t.window_rows.ring_row = y;
                smear_raster_list(&frame, &t, 0);
            }
        END_UNLESS(same_planes(&full, &cut));
    }
}

#if SMEAR_FRONT_ORDER
/* Textured triangles in two planes, in which many lie at the same depth; a few codes before each other; and of all distances. */
static void random_planes(void)
{
    list_begin();
    geometry.segment_count = 2;
    for (int i = 0; i < 2; i++) {
        const smear_texture texture = { .texels = texels, .width = 32, .height = chance(2) ? 32 : 16 };
        set_layout(i, true, false, 0, SHADE_NONE);
        draw[i].alpha = (uint8_t)(i == 0 ? SMEAR_OPAQUE : SMEAR_CUTOUT);
        smear_sampler_make(&draw[i].sampler, &texture, 13, false, false);
    }
    const int32_t nearest = 1 << between(23, 29), most = between(20, 200);
    const int32_t code = nearest < 32768 << 11 ? 1 << 11 : 1 << 15;
    int32_t right[2], down[2];
    for (int i = 0; i < 2; i++) {
        right[i] = between(-nearest / (4 * W), nearest / (4 * W)) / (i + 1);
        down[i] = between(-nearest / (4 * H), nearest / (4 * H)) / (i + 1);
    }
    for (int32_t n = 0; n < most && list_has_room(); n++) {
        const int32_t size = between(1, 32), x = between(0, W), y = between(0, H), before = nearest + between(-2, 2) * code;
        const int at = chance(4), i = between(0, 3);
        int32_t p[3][2];
        uint16_t v[3];
        for (int k = 0; k < 3; k++) {
            p[k][0] = (x + between(-size, size)) * 256 + 128;
            p[k][1] = (y + between(-size, size)) * 256 + 128;
        }
        if (area_of(p) == 0)
            continue;
        for (int k = 0; k < 3; k++) {
            const int32_t s = between(-32768, 32767), t = between(-32768, 32767);
            int32_t depth = i == 3 ? between(nearest >> 3, nearest) : before;
            if (i < 2)
                depth = nearest + right[i] * (p[k][0] >> 8) + down[i] * (p[k][1] >> 8);
            v[k] = add_vertex(at, p[k][0], p[k][1], clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX));
            set_uv(at, v[k], s, t);
        }
        add_triangle(at, v[0], v[1], v[2], 0xffffffffu);
    }
}

/* Draws the list in bands of so many rows; if `order`, with memory for its order. Returns how many triangles it puts elsewhere. */
static int32_t draw_bands(struct planes *p, int32_t band, bool order)
{
    static uint64_t memory[1024];
    struct smear_raster_cache cache = { NULL, 0, 0 };
    int32_t moved = 0;
    if (order)
        cache = smear_raster_cache_make(memory, sizeof memory, 1, &geometry);
    uint16_t *const number = front_order_of(&cache);
    planes_clear(p);
    for (int32_t y = 0; y < H; y += band) {
        struct smear_raster_target t = target_of(p);
        t.velocity8 = NULL;
        t.inspect = NULL;
        t.cache = cache;
        t.y0 = y;
        t.y1 = min_i32(y + band, H);
        t.color_rows.ring_row = t.window_rows.ring_row = y;
        for (uint32_t i = 0; number != NULL && i < geometry.triangle_count; i++)
            number[i] = (uint16_t)i;
        smear_raster_list(&frame, &t, 0);
        for (uint32_t i = 0; number != NULL && i < geometry.triangle_count; i++)
            moved += number[i] != i;
    }
    return moved;
}

static void test_drawing_from_the_front_changes_nothing(void)
{
    int32_t moved = 0;
    random_state = 61;
    for (uint32_t i = 0; i < TEXELS; i++)
        texels[i] = random_u32();
    for (int n = 0; n < 120; n++) {
        random_planes();
        draw_bands(&full, H, false);
        moved += draw_bands(&cut, chance(2) ? H : between(8, 24), true);
        END_UNLESS(same_planes(&full, &cut));
    }
    CHECK(moved > 1000);
}
#endif

/* Triangles with loops of their own, of any size and near any break of the depth code. */
static void random_kind(int level, int far)
{
    const uint16_t light[4] = { (uint16_t)random_u32(), (uint16_t)random_u32(), (uint16_t)random_u32(), 0xffffu };
    for (int k = 0; k < 6 && list_has_room(); k++) {
        int32_t extent = 256 << between(2, 7), x = between(0, W * 256), y = between(0, H * 256), p[3][2];
        uint16_t v[3];
        if (!random_corners(p, x, y, extent))
            continue;
        for (int i = 0; i < 3; i++) {
            int32_t depth = SMEAR_DEPTH_MAX >> far;
            v[i] = add_vertex(0, p[i][0], p[i][1], max_i32(SMEAR_DEPTH_MIN, depth - between(0, depth >> level)));
            if (segment[0].uv != 0) {
                int32_t s = between(-32768, 32767), t = between(-32768, 32767);
                set_uv(0, v[i], s, t);
            }
            if (segment[0].color != 0) {
                uint16_t other[4] = { (uint16_t)random_u32(), (uint16_t)random_u32(), (uint16_t)random_u32(), 0xffffu };
                set_color(0, v[i], segment[0].uv != 0 ? light : other);
            }
            for (int pose = 0; pose < segment[0].moves; pose++) {
                int32_t dx = between(-4096, 4096), dy = between(-4096, 4096);
                set_motion(0, v[i], pose, dx, dy, between(1 << 19, 1 << 21));
            }
        }
        add_triangle(0, v[0], v[1], v[2], random_u32() | 0xff000000u);
    }
}

static uint16_t direct[2][W * H];

/* Draws the list as what is opaque and as what is cut out nowhere, which is
 * the general loop's: into working pixels, and into finished ones. */
static bool check_general(void)
{
    planes_clear(&full);
    draw_list(&full);
    draw[0].alpha = SMEAR_CUTOUT;
    draw[0].cutoff = 0;
    planes_clear(&cut);
    draw_list(&cut);
    if (!same_planes(&full, &cut))
        return false;
    if (!SMEAR_DIRECT)
        return true;
    bool same = true;
    for (int i = 0; i < 2; i++) {
        struct planes *p = i == 0 ? &full : &cut;
        planes_clear(p);
        struct smear_raster_target t = target_of(p);
        t.direct = direct[i];
        t.velocity8 = NULL;
        t.inspect = NULL;
        for (int k = 0; k < W * H; k++)
            direct[i][k] = 0;
        draw[0].alpha = i == 0 ? SMEAR_OPAQUE : SMEAR_CUTOUT;
        smear_raster_list(&frame, &t, 0);
    }
    for (int k = 0; k < W * H; k++)
        same = same && direct[0][k] == direct[1][k] && full.depth[k] == cut.depth[k];
    return CHECK(same);
}

/* Texels have loops of their own, which must say what the general one says. Formats, lights, sizes with loops of their
 * own and others, velocities, breaks of the depth code, all blocks. */
static void test_texels_in_rows_are_those_of_the_general_loop(void)
{
    static const uint8_t size[][2] = { { 64, 64 }, { 32, 32 }, { 64, 32 }, { 2, 64 } };
    static const enum smear_shade_mode shade[] = { SHADE_NONE, SHADE_FLAT, SHADE_GOURAUD };
    random_state = 47;
    for (uint32_t i = 0; i < TEXELS; i++)
        texels[i] = random_u32() & 0xffffffu;     /* working pixels need no alpha */
    for (int n = 0; n < 270; n++) {
        const enum smear_shade_mode mode = shade[n / 3 % 3];
        list_begin();
        set_layout(0, true, mode == SHADE_GOURAUD, n % 3, mode);
        const smear_texture texture = { .texels = texels, .palette = texels, .width = size[n % 4][0],
                                        .height = size[n % 4][1], .format = (uint8_t)(n / 9 % 3) };
        smear_sampler_make(&draw[0].sampler, &texture, between(9, 15), false, false);
        random_kind(between(0, 8), between(0, 3) * 4);
        END_UNLESS(check_general());
    }
}

/* And so have colours between vertices. */
static void test_colors_in_rows_are_those_of_the_general_loop(void)
{
    random_state = 53;
    for (int n = 0; n < 160; n++) {
        list_begin();
        set_layout(0, false, true, 1 + n % 2, SHADE_GOURAUD);      /* what moves is never tiny */
        frame.linear = SMEAR_WITH_LINEAR && n / 2 % 2 == 1;
        random_kind(between(0, 8), between(0, 3) * 4);
        END_UNLESS(check_general());
    }
}

#include "build/suites/raster.h"
