/* SPDX-License-Identifier: MIT */
/* test_raster.c - coverage, depth, colour, texels and velocity of triangles, against exact integer
 * arithmetic; and that cutting the frame into columns and bands never shows. Needs neither libc nor
 * floating point. */
#include "../src/raster.h"

#include "../src/pixel.h"
#include "../src/transform.h"
#include "test.h"

void suite_raster(void);

enum { W = 64, H = 40, POOL_WORDS = 3600, SEGMENTS = 8 };

/* What a list is drawn into. */
struct planes {
    uint32_t color[W * H];
    uint16_t depth[W * H];
    int8_t velocity[W * H * 2];
    int32_t inspect[W * H * 2];
};

static struct planes full, cut;

static uint32_t pool[POOL_WORDS];
static struct smear_segment segment[SEGMENTS];
static struct smear_raster_draw draw[SEGMENTS];
static struct smear_geometry geometry;
static struct smear_raster_frame frame;
static uint8_t moving[W / 8];
static uint32_t list_last;

/* ------------------------------------------------------------------ random numbers */

static uint32_t random_state;

static uint32_t random_u32(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    uint32_t x = random_state;
    x ^= x >> 15;
    x *= 0x2c1b3c6du;
    return x ^ x >> 13;
}

/* low .. high, both included */
static int32_t between(int32_t low, int32_t high)
{
    return low + (int32_t)(random_u32() % (uint32_t)(high - low + 1));
}

static bool chance(int one_in)
{
    return random_u32() % (uint32_t)one_in == 0;
}

/* ------------------------------------------------------------------ lists made by hand */

/* Empties the pool; segment i belongs to draw i and is flat, opaque and still unless a test says
 * otherwise (set_layout). All share one base, so offsets mean the same in each. */
static void list_begin(void)
{
    geometry = (struct smear_geometry){
        .pool = pool, .pool_words = POOL_WORDS, .segment = segment, .segment_count = SEGMENTS,
        .segment_limit = SEGMENTS
    };
    for (int i = 0; i < SEGMENTS; i++) {
        segment[i] = (struct smear_segment){
            .draw = (uint16_t)i, .stride = VERTEX_BASE_WORDS, .shade = SHADE_FLAT
        };
        draw[i] = (struct smear_raster_draw){ .alpha = SMEAR_OPAQUE, .cutoff = 128 };
    }
    frame = (struct smear_raster_frame){
        .geometry = &geometry, .draw = draw, .velocity_scale = 32768, .inspect_scale = 65536,
        .reach_q3 = 15 * 8
    };
    list_last = SMEAR_NO_TRIANGLE;
}

/* Lays out the vertices of a segment: what they carry. */
static void set_layout(int at, bool uv, bool color, int moves, enum smear_shade_mode shade)
{
    struct smear_segment *s = &segment[at];
    int words = VERTEX_BASE_WORDS;
    s->uv = s->color = s->motion = 0;
    if (uv)
        s->uv = (uint8_t)words++;
    if (color) {
        s->color = (uint8_t)words;
        words += 2;
    }
    if (moves != 0) {
        s->motion = (uint8_t)words;
        words += moves * MOTION_WORDS;
    }
    s->moves = (uint8_t)moves;
    s->shade = (uint8_t)shade;
    s->stride = (uint8_t)words;
}

/* A new vertex; returns its offset. The words beyond the place are the caller's to fill. */
static uint16_t add_vertex(int at, int32_t x, int32_t y, int32_t depth)
{
    uint32_t word = geometry.vertex_words;
    geometry.vertex_words += segment[at].stride;
    for (uint32_t i = word; i < geometry.vertex_words; i++)
        pool[i] = 0;
    pool[word + VERTEX_X] = (uint32_t)x;
    pool[word + VERTEX_Y] = (uint32_t)y;
    pool[word + VERTEX_DEPTH] = (uint32_t)depth;
    return (uint16_t)word;
}

static uint32_t add_triangle(int at, uint16_t a, uint16_t b, uint16_t c, uint32_t color)
{
    uint32_t i = geometry.triangle_count++;
    struct smear_triangle *t = geometry_triangle(&geometry, i);
    *t = (struct smear_triangle){
        .vertex = { a, b, c }, .segment = (uint16_t)at, .next = SMEAR_NO_TRIANGLE, .color = color
    };
    if (list_last != SMEAR_NO_TRIANGLE)
        geometry_triangle(&geometry, list_last)->next = i;
    list_last = i;
    return i;
}

static bool list_has_room(void)
{
    return geometry_has_room(&geometry, 3 * 16, 1) && geometry.vertex_words < 65000u;
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

/* ------------------------------------------------------------------ exact coverage */

/* e > 0 on the inner side of the edge a -> b of a triangle that is clockwise on the screen. */
static int64_t edge_value(const int32_t a[2], const int32_t b[2], int32_t x, int32_t y)
{
    return (int64_t)(b[0] - a[0]) * (y - a[1]) - (int64_t)(b[1] - a[1]) * (x - a[0]);
}

static int64_t area_of(int32_t p[3][2])
{
    return edge_value(p[0], p[1], p[2][0], p[2][1]);
}

/* The top-left rule for the centre of pixel (px, py). */
static bool covers(int32_t p[3][2], int32_t px, int32_t py)
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
static bool draw_and_check(int32_t p[3][2])
{
    if (area_of(p) == 0)
        return true;            /* never reaches the raster */
    list_begin();
    uint16_t v[3];
    for (int i = 0; i < 3; i++)
        v[i] = add_vertex(0, p[i][0], p[i][1], SMEAR_DEPTH_MAX / 2);
    add_triangle(0, v[0], v[1], v[2], 0xffffffffu);
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

static void test_both_windings_cover_the_same_pixels(void)
{
    random_state = 1;
    for (int n = 0; n < 60; n++) {
        int32_t p[3][2];
        for (int i = 0; i < 3; i++) {
            p[i][0] = between(-600, W * 256 + 600);
            p[i][1] = between(-600, H * 256 + 600);
        }
        count_clear();
        for (int turn = 0; turn < 6; turn++) {      /* all orders of the corners */
            if (!draw_and_check(p))
                return;
            int swap = turn & 1;
            for (int axis = 0; axis < 2; axis++) {
                int32_t keep = p[swap][axis];
                p[swap][axis] = p[swap + 1][axis];
                p[swap + 1][axis] = keep;
            }
        }
        for (int i = 0; i < W * H; i++)
            if (!CHECK(count[i] == 0 || count[i] == 6))
                return;
    }
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
        if (!draw_and_check(p))
            return;
    }
}

static void test_boxes_around_the_limit_of_the_small_path_cover_exactly_their_centres(void)
{
    random_state = 3;
    for (int n = 0; n < 300; n++) {
        /* The box of pixel centres is 7, 8 or 9 wide and high; corners move by a fraction. */
        int32_t w = between(7, 9) * 256, h = between(7, 9) * 256, p[3][2];
        int32_t x = between(0, 20) * 256 + between(0, 255), y = between(0, 20) * 256 + between(0, 255);
        p[0][0] = x;
        p[0][1] = y + between(0, h);
        p[1][0] = x + w + between(-1, 1);
        p[1][1] = y;
        p[2][0] = x + between(0, w);
        p[2][1] = y + h + between(-1, 1);
        if (!draw_and_check(p))
            return;
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
        if (!draw_and_check(p))
            return;
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
        if (!draw_and_check(p))
            return;
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
            flip_edge(between(0, mesh_count - 1), between(0, 2));
    }
}

static void test_random_meshes_cover_every_pixel_once(void)
{
    random_state = 5;
    for (int n = 0; n < 12; n++) {
        int32_t x0 = between(-300, 1500), y0 = between(-300, 1500);
        int32_t x1 = between(9000, W * 256 + 300), y1 = between(6000, H * 256 + 300);
        if (n & 1) {
            x0 = (x0 & ~255) + 128;
            y1 = (y1 & ~255) + 128;
        }
        mesh_rectangle(x0, y0, x1, y1);
        grow_mesh(40 + 10 * n);
        CHECK(mesh_count > 30);
        if (!mesh_draw_all() || !check_counts(x0, y0, x1, y1))
            return;
    }
}

static void test_meshes_of_slivers_cover_every_pixel_once(void)
{
    /* All points within half a pixel of one slanted line. */
    random_state = 6;
    for (int n = 0; n < 6; n++) {
        mesh_rectangle(100, 100, W * 256 - 100, H * 256 - 100);
        int32_t slope = between(-100, 100);
        for (int tries = 0; tries < 900 && mesh_count < 90; tries++) {
            int32_t x = between(1000, W * 256 - 1000);
            int32_t y = H * 128 + (x - W * 128) * slope / 300 + between(-64, 64);
            for (int t = 0; t < mesh_count; t++)
                if (split_face(t, x, y))
                    break;
            flip_edge(between(0, mesh_count - 1), between(0, 2));
        }
        CHECK(mesh_count > 60);
        if (!mesh_draw_all() || !check_counts(100, 100, W * 256 - 100, H * 256 - 100))
            return;
    }
}

static void test_meshes_finer_than_a_step_of_a_pixel_cover_every_pixel_once(void)
{
    /* A grid whose cells are 1/256 px wide, around the centre of pixel (10, 10). */
    const int32_t x = 10 * 256 + 128, y = 10 * 256 + 128;
    for (int shift = -3; shift <= 0; shift++) {
        count_clear();
        for (int32_t j = -3; j < 3; j++)
            for (int32_t i = -3; i < 3; i++) {
                int32_t x0 = x + i + (shift & 1), y0 = y + j + (shift & 2) / 2, x1 = x0 + 1, y1 = y0 + 1;
                int32_t a[3][2] = { { x0, y0 }, { x1, y0 }, { x1, y1 } };
                int32_t b[3][2] = { { x0, y0 }, { x1, y1 }, { x0, y1 } };
                if (!draw_and_check(a) || !draw_and_check(b))
                    return;
            }
        for (int i = 0; i < W * H; i++)
            if (!CHECK_EQ(count[i], i == 10 * W + 10))
                return;
    }
}

static void test_fans_to_the_guard_band_cover_every_pixel_once(void)
{
    /* Twenty-four spokes from a centre, on a pixel's centre or not, to the rim of what may be drawn:
     * the frame lies inside, so every pixel belongs to one blade. */
    const int32_t guard = SMEAR_GUARD_PX << 8, cx = W << 7, cy = H << 7;
    random_state = 7;
    for (int n = 0; n < 4; n++) {
        int32_t hub[2] = { between(500, W * 256 - 500), between(500, H * 256 - 500) };
        if (n & 1)
            for (int axis = 0; axis < 2; axis++)
                hub[axis] = (hub[axis] & ~255) + 128;
        int32_t rim[24][2];
        for (int i = 0; i < 24; i++) {              /* around the square's border, clockwise */
            int32_t along = -guard + (i % 6) * (guard / 3) + (i % 6 != 0 ? between(-900, 900) : 0);
            int side = i / 6;
            rim[i][0] = cx + (side == 0 ? along : side == 1 ? guard : side == 2 ? -along : -guard);
            rim[i][1] = cy + (side == 0 ? -guard : side == 1 ? along : side == 2 ? guard : -along);
        }
        count_clear();
        for (int i = 0; i < 24; i++) {
            const int32_t *b = rim[i], *c = rim[(i + 1) % 24];
            int32_t p[3][2] = { { hub[0], hub[1] }, { b[0], b[1] }, { c[0], c[1] } };
            if (!draw_and_check(p))
                return;
        }
        if (!check_counts(0, 0, W * 256, H * 256))
            return;
    }
}

void suite_raster(void)
{
    RUN(test_corners_on_pixel_centres_follow_the_top_left_rule);
    RUN(test_both_windings_cover_the_same_pixels);
    RUN(test_random_triangles_of_every_size_cover_exactly_their_centres);
    RUN(test_boxes_around_the_limit_of_the_small_path_cover_exactly_their_centres);
    RUN(test_triangles_that_reach_the_guard_band_cover_exactly_their_centres);
    RUN(test_random_meshes_cover_every_pixel_once);
    RUN(test_meshes_of_slivers_cover_every_pixel_once);
    RUN(test_meshes_finer_than_a_step_of_a_pixel_cover_every_pixel_once);
    RUN(test_fans_to_the_guard_band_cover_every_pixel_once);
}
