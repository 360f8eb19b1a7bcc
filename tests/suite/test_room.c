/* SPDX-License-Identifier: MIT */
/* test_room.c - frames of many more triangles than a context has room for take not much more work. (That pictures are the same is
 * what the generator of frames finds: tests/fuzz.) What is counted is how often the store is filled: the library looks at the
 * application's clock when a fill begins and when it ends. */
#include "smear_math.h"

#include "geometry/assemble.h"
#include "geometry/ranges.h"
#include "geometry/shot.h"
#include "tests/rig.h"

enum { WIDTH = 96, HEIGHT = 64, MOST = 20000 };

/* A mesh of its own, of up to MOST triangles. */
struct shape {
    int16_t position[3 * 16384];
    uint16_t index[3 * MOST];
    uint8_t color[4 * MOST];
    smear_mesh mesh;
};

/* ------------------------------------------------------------------ meshes */

static void place(struct shape *s, int at, double x, double y, double z)
{
    s->position[3 * at] = (int16_t)x;
    s->position[3 * at + 1] = (int16_t)y;
    s->position[3 * at + 2] = (int16_t)z;
}

/* A grid of n x n squares: hills, or a ball, that are 512 steps wide. Its triangles may come in any order. */
static void make_grid(struct shape *s, int n, bool ball, bool shuffled)
{
    int triangles = 0;
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            const uint32_t along = (uint32_t)((uint64_t)i * UINT32_MAX / (uint32_t)n),
                           up = (uint32_t)(((uint64_t)j * UINT32_MAX / (uint32_t)n) >> 1) - 0x40000000u;
            if (ball)
                place(s, j * (n + 1) + i, 256.0 * smear_cos(along) / 16777216 * smear_cos(up) / 16777216,
                      256.0 * smear_sin(up) / 16777216, 256.0 * smear_sin(along) / 16777216 * smear_cos(up) / 16777216);
            else
                place(s, j * (n + 1) + i, 512.0 * i / n - 256, between(-6, 6) + 20.0 * smear_sin(along * 3 + up) / 16777216,
                      512.0 * j / n - 256);
        }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int at = j * (n + 1) + i;
            const int corner[6] = { at, at + n + 1, at + 1, at + 1, at + n + 1, at + n + 2 };
            for (int k = 0; k < 6; k++)
                s->index[3 * triangles + k] = (uint16_t)corner[k];
            triangles += 2;
        }
    for (int k = triangles - 1; shuffled && k > 0; k--) {
        const int other = between(0, k);
        for (int e = 0; e < 3; e++) {
            const uint16_t kept = s->index[3 * k + e];
            s->index[3 * k + e] = s->index[3 * other + e];
            s->index[3 * other + e] = kept;
        }
    }
    for (int k = 0; k < 4 * triangles; k++)
        s->color[k] = (uint8_t)between(60, 255);
    s->mesh = (smear_mesh){ .position = s->position, .index = s->index, .face_color = s->color, .shift = STEP,
                            .vertex_count = (uint16_t)((n + 1) * (n + 1)), .triangle_count = (uint32_t)triangles };
    smear_mesh_find_bounds(&s->mesh);
}

/* ------------------------------------------------------------------ frames */

static uint32_t looks;          /* at the clock */

static uint32_t look_at_clock(void *user)
{
    (void)user;
    return looks++;
}

/* Tiles of a ball that fills the picture have more than four times as many triangles as there is room for. They were assembled
 * again for each instant: 1478 looks. */
static void test_the_store_is_not_filled_for_each_instant(void)
{
    struct shape *s = calloc(1, sizeof *s);
    smear_stats few, all;
    random_state = 3;
    make_grid(s, 90, true, false);
    const smear_transform now = pose_at(0, 0.1, 0, 0, 0), open = pose_at(0, -0.1, 0, 0, 0);
    const smear_camera camera = camera_at(0, 0, 3.2, 0);
    const smear_draw draw = { .mesh = &s->mesh, .now = &now, .open = &open };
    const smear_frame frame = { .camera = &camera, .open = &camera, .method = SMEAR_AUTO };
    smear_desc desc = small_desc(320, 240);
    desc.methods = SMEAR_SET(SMEAR_AUTO);
    desc.debug.clock = look_at_clock;
    desc.max_triangles = 3 * s->mesh.triangle_count;
    RIG(ample, &desc, false);
    desc.max_triangles = 256;
    RIG(tight, &desc, false);
    for (int k = 0; k < 2; k++) {       /* what is not seen for the first time may move */
        CHECK_EQ(rig_frame(&ample, &frame, &draw, 1), SMEAR_OK);
        looks = 0;
        CHECK_EQ(rig_frame(&tight, &frame, &draw, 1), SMEAR_OK);
    }
    same_picture(&ample, tight.picture);
    smear_get_stats(ample.ctx, &all);
    smear_get_stats(tight.ctx, &few);
    CHECK(all.parts_added == 0 && few.parts_added > 0 && all.triangles_drawn > 4 * 256);
    if (!CHECK(looks <= 600))
        CHECK_EQ(looks, 0);
    free(s);
}

/* Frames of few triangles, which one core fills the store with in turn, before such of many, of which it has room for what is seen. */
static void test_what_is_filled_in_turn_is_nothing_to_cores_later(void)
{
    struct shape *s = calloc(2, sizeof *s);
    const smear_camera camera = camera_at(0, 0, 1.8, 0);
    uint32_t filled = 0;
    random_state = 5;
    make_grid(&s[0], 11, true, false);
    make_grid(&s[1], 40, true, false);
    smear_desc desc = small_desc(96, 16);
    desc.methods = SMEAR_SET(SMEAR_NONE) | SMEAR_SET(SMEAR_AUTO);
    desc.tile = 16;
    desc.max_triangles = 20000;
    RIG(ample, &desc, false);
    for (desc.workers = 2; desc.workers <= 4; desc.workers++)
        for (desc.max_triangles = 16; desc.max_triangles <= 416; desc.max_triangles += 40) {
            RIG(tight, &desc, false);
            for (int k = 0; k < 8; k++) {
                smear_stats stats;
                const smear_transform now = pose_at(k % 2 == 0 ? 0 : -2.2 + 0.1 * k, 0, k % 2 == 0 ? 0 : -1, 0.2 * k, 0);
                const smear_transform open = pose_at(0, 0.3, 0, 0, 0);
                const smear_draw draw = { .mesh = &s[k % 2].mesh, .now = &now, .open = k % 2 == 0 ? &open : NULL };
                const smear_frame frame = { .camera = &camera, .method = k % 2 == 0 ? SMEAR_AUTO : SMEAR_NONE };
                uint8_t *want = rig_copy(&ample, &frame, &draw, 1);
                CHECK_EQ(rig_frame(&tight, &frame, &draw, 1), SMEAR_OK);
                CHECK(want != NULL && same_picture(&tight, want));
                smear_get_stats(tight.ctx, &stats);
                filled += k % 2 == 0 ? stats.parts_added : 0;
                free(want);
            }
        }
    CHECK(filled > 0);
    free(s);
}

/* ------------------------------------------------------------------ ranges */

enum { ROW_PX = 16, ROWS = HEIGHT / ROW_PX, POOL_WORDS = 1 << 19, SEGMENTS = 64, CACHE = 256 };

/* An assembler with room for all triangles of a shape. */
struct hall {
    uint32_t pool[POOL_WORDS];
    struct smear_segment segment[SEGMENTS];
    struct smear_cached_vertex cache[CACHE];
    uint32_t opaque[ROWS], blend[ROWS], moving[ROWS];
    struct smear_bins bins;
    struct smear_assembler assembler;
    struct smear_assembly assembly;
    smear_material material;
    smear_transform object[3];          /* at open, close and the instant that is drawn */
    struct smear_shot shot;
};

/* Places the shape as it is at one of these. */
static void hall_place_at(struct smear_placement *at, const struct smear_assembly *a, int key, int coarse)
{
    const struct hall *h = (const struct hall *)a->place_of;
    struct smear_view view;
    at->position = a->mesh->position;
    at->extra_count = 0;
    smear_view_compose(&view, &h->object[key], a->mesh, &h->shot.camera[0].pose);
    smear_projection_make(&at->now, &view, &h->shot.camera[0], HEIGHT, coarse);
}

static void hall_open(struct hall *h, const struct shape *s, bool path)
{
    h->bins = (struct smear_bins){ .pool = h->pool, .pool_words = POOL_WORDS, .range_shift = (uint8_t)between(2, 7),
                                   .segment = h->segment, .segment_limit = SEGMENTS, .opaque_last = h->opaque,
                                   .blend_last = h->blend, .moving_last = h->moving, .row_px = ROW_PX, .row_count = ROWS,
                                   .shot = &h->shot };
    h->assembler = (struct smear_assembler){ .viewport = { WIDTH, HEIGHT }, .bins = &h->bins, .cache = h->cache,
                                             .cache_mask = CACHE - 1, .keep_paths = path, .path_limit = UINT32_MAX };
    h->material = (smear_material){ .double_sided = (uint8_t)chance(3), .alpha = (uint8_t)(chance(4) ? SMEAR_BLEND : SMEAR_OPAQUE) };
    h->assembly = (struct smear_assembly){ .mesh = &s->mesh, .material = &h->material, .end = s->mesh.triangle_count, .path = path,
                                           .place_fine = hall_place_at, .place_of = h, .shading = { .white = true } };
    h->shot.camera[0] = camera_at(0, 0, 0, 0);
}

/* Places the shape before the camera, near to it now and then, at one moment. */
static void hall_place(struct hall *h, int key, double x, double y, double z, double yaw)
{
    h->object[key] = pose_at(x, y, z, yaw, 0.3);
    hall_place_at(key == 2 ? &h->assembly.at : &h->assembly.motion.key[key], &h->assembly, key, 0);
}

/* Fills the store with a tile row. Returns the triangles that find their way there. */
static uint32_t fill_row(struct hall *h, int row)
{
    smear_bins_reset(&h->bins, row, row + 1);
    smear_assembler_reset(&h->assembler);
    CHECK(h->assembly.path ? smear_assemble_path(&h->assembler, &h->assembly) : smear_assemble(&h->assembler, &h->assembly));
    return h->bins.triangle_count;
}

/* Returns how many triangles are looked at for that. */
static uint32_t looked_at(const struct hall *h)
{
    const struct smear_tile_box filled = ranges_filled(&h->assembler, h->assembly.path && h->material.alpha != SMEAR_BLEND);
    uint32_t sum = 0;
    for (uint32_t first = 0, end = 0; end < h->assembly.end; first = end) {
        end = ranges_next(&h->assembler, filled, &first, h->assembly.end);
        sum += end - first;
    }
    return sum;
}

/* Compares the rows with those of all triangles. Returns how many are looked at in all rows. */
static uint32_t check_rows(struct hall *h, int columns)
{
    struct smear_tile_box *const box = (struct smear_tile_box *)(void *)h->pool;
    uint32_t want[ROWS], sum = 0;
    h->assembler.path_x1 = INT16_MAX;
    h->assembler.path_x0 = 0;
    h->bins.kept_words = ranges_of(&h->bins, h->assembly.end);
    const struct smear_shading shading = h->assembly.shading;
    smear_ranges_find(&h->assembler, &h->assembly, box);
    h->assembly.first = 0;
    h->assembly.shading = shading;
    h->assembler.path_x0 = (int16_t)(columns * 8);
    h->assembler.path_x1 = (int16_t)(columns != 0 ? columns * 8 + 16 : INT16_MAX);
    for (int row = 0; row < ROWS; row++)
        want[row] = fill_row(h, row);
    h->assembler.ranges = box;
    for (int row = 0; row < ROWS; row++) {
        CHECK_EQ(fill_row(h, row), want[row]);
        sum += looked_at(h);
    }
    h->assembler.ranges = NULL;
    return sum;
}

static void test_ranges_leave_out_nothing_that_is_seen(void)
{
    struct shape *s = calloc(1, sizeof *s);
    struct hall *h = calloc(1, sizeof *h);
    random_state = 50;
    for (int i = 0; i < 1000; i++) {
        if (i % 10 == 0)
            make_grid(s, between(2, 40), chance(2), chance(4));
        const double x = uniform(-2, 2), y = uniform(-1.5, 1.5), z = uniform(-4, 1), yaw = uniform(-3, 3);
        hall_open(h, s, chance(2));
        hall_place(h, 2, x, y, z, yaw);
        for (int key = 0; key < 2; key++)
            hall_place(h, key, x + uniform(-0.2, 0.2), y + uniform(-0.2, 0.2), z + uniform(-0.3, 0.3),
                       yaw + uniform(-0.3, 0.3));
        check_rows(h, chance(2) ? between(1, WIDTH / 8 - 2) : 0);
    }
    free(h);
    free(s);
}

/* Rows of hills and of a ball, whose triangles follow each other: most are looked at for one row or two. */
static void test_ranges_leave_out_most_that_is_not(void)
{
    struct shape *s = calloc(1, sizeof *s);
    struct hall *h = calloc(1, sizeof *h);
    random_state = 51;
    for (int i = 0; i < 40; i++) {
        make_grid(s, 60, i % 2 != 0, false);
        hall_open(h, s, i % 4 >= 2);
        h->bins.range_shift = 5;
        hall_place(h, 2, 0, 0, -3, 0.1 * i);
        for (int key = 0; key < 2; key++)
            hall_place(h, key, 0.03 * key, 0, -3, 0.1 * i);
        CHECK(check_rows(h, 0) <= 2 * s->mesh.triangle_count);
    }
    free(h);
    free(s);
}

#include "build/suites/room.h"
