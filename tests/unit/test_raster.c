/* SPDX-License-Identifier: MIT */
/* test_raster.c - coverage of triangles against exact integer arithmetic; which pixel wins; and that drawing from the
 * front never shows. Golden frames hold what pixels have. Needs neither libc nor floating point. */
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

/* ------------------------------------------------------------------ exact attributes */

static uint32_t *words_at(uint16_t vertex, int offset)
{
    return pool + vertex + offset;
}

static void set_uv(int at, uint16_t vertex, int32_t u, int32_t v)
{
    *words_at(vertex, segment[at].uv) = ((uint32_t)u & 0xffffu) | (uint32_t)v << 16;
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

/* Texels that say where they are: u in the low byte and a half, v above. */
enum { TEXELS = 64 * 64 };
static uint32_t texels[TEXELS];

/* A textured triangle. */
struct textured {
    int32_t p[3][2], q[3], uv[3][2];
    int32_t width, height;
    int wrap_u, wrap_v, uv_shift;
};

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
    geometry.row_px = H;        /* a row, of which bands are parts */
    geometry.row_count = 1;
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

#include "build/suites/raster.h"
