/* SPDX-License-Identifier: MIT */
/* test_api.c - the library through its public interface: arguments, order, memory, capacities, poses kept from frame
 * to frame, bands, workers and the filter alone. Host only: threads and floating point. */
#include "tests/rig.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

/* ------------------------------------------------------------------ memory */

static void test_memory_must_exist_and_be_aligned(void)
{
    smear_desc desc = small_desc(16, 16);
    desc.flush = take_band;
    size_t bytes = smear_memory_size(&desc);
    uint64_t *memory = malloc(bytes + 16);
    smear_context *ctx = NULL;
    CHECK_EQ(smear_init(&ctx, &desc, NULL, bytes), -(int)bytes);
    for (int shift = 1; shift < 8; shift++)
        CHECK_EQ(smear_init(&ctx, &desc, (uint8_t *)memory + shift, bytes + 8), -(int)bytes);
    CHECK_EQ(smear_init(&ctx, &desc, memory, 0), -(int)bytes);
    CHECK(ctx == NULL);
    CHECK_EQ(smear_init(&ctx, &desc, memory, bytes + 16), SMEAR_OK);
    CHECK(ctx != NULL);
    smear_stats stats;
    smear_get_stats(ctx, &stats);
    CHECK_EQ(stats.arena_bytes, (int64_t)bytes);
    free(memory);
}

/* ------------------------------------------------------------------ arguments */

static void test_zero_fields_of_a_desc_mean_the_documented_defaults(void)
{
    smear_desc given = { .width = 100, .height = 80, .methods = SMEAR_SET(SMEAR_AUTO), .reach = 4, .tile = 8,
                         .strip = 64, .band_rows = 8, .format = SMEAR_XRGB8888,
                         .display.dither = SMEAR_DITHER_ORDERED, .bands = 1, .workers = 1, .max_draws = 16,
                         .max_triangles = 1024, .vertex_cache = 128 };
    smear_desc zero = { .width = 100, .height = 80 };
    RIG(a, &given, false);
    RIG(b, &zero, false);
    CHECK(a.bytes == b.bytes);
    for (int k = 0; k < 3; k++) {
        struct scene s;
        make_scene(&s, 0.3 * k, SMEAR_AUTO);
        s.frame.target = SMEAR_BALANCED;
        s.frame.shutter.degrees = 180;
        uint8_t *picture = rig_copy(&a, &s.frame, s.draw, SCENE_DRAWS);
        CHECK_EQ(render_scene(&b, 0.3 * k, 0), SMEAR_OK);
        same_picture(&b, picture);
        free(picture);
    }
}

static void test_a_frame_begun_again_is_forgotten(void)
{
    smear_desc desc = small_desc(32, 32);
    RIG(r, &desc, false);
    struct scene s;
    make_scene(&s, 0, SMEAR_NONE);
    uint8_t *picture = rig_copy(&r, &s.frame, &s.draw[1], 1);
    CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
    for (int i = 0; i < SCENE_DRAWS; i++)
        CHECK_EQ(smear_submit(r.ctx, &s.draw[i]), SMEAR_OK);
    CHECK_EQ(rig_frame(&r, &s.frame, &s.draw[1], 1), SMEAR_OK);
    same_picture(&r, picture);
    free(picture);
}

static void test_what_is_submitted_may_change_before_it_is_drawn(void)
{
    static const uint8_t method[] = { SMEAR_NONE, SMEAR_RECONSTRUCT, SMEAR_ACCUMULATE, SMEAR_SUBFRAMES, SMEAR_AUTO, SMEAR_OBJECT };
    smear_desc desc = small_desc(64, 48);
    desc.methods |= SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS;
    RIG(r, &desc, false);
    for (int m = 0; m < 6; m++) {
        struct scene s, before, after;
        make_scene(&s, 0.2, method[m]);
        make_scene(&before, 0.0, method[m]);
        make_scene(&after, 0.4, method[m]);
        s.frame.shutter.poses = 1;
        for (int i = 0; i < SCENE_DRAWS; i++) {
            s.draw[i].id = 0;
            s.draw[i].open = &before.pose[i];
            s.draw[i].close = &after.pose[i];
        }
        uint8_t *picture = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
        rig_forget_output(&r);
        CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
        for (int i = 0; i < SCENE_DRAWS; i++) {
            smear_draw d = s.draw[i];
            smear_transform pose[3] = { *d.now, *d.open, *d.close };
            d.now = &pose[0];
            d.open = &pose[1];
            d.close = &pose[2];
            CHECK_EQ(smear_submit(r.ctx, &d), SMEAR_OK);
            memset(pose, 0x5a, sizeof pose);
            memset(&d, 0x5a, sizeof d);
        }
        memset(&s.camera, 0x5a, sizeof s.camera);
        CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
        CHECK(picture != NULL && same_picture(&r, picture));
        free(picture);
    }
}

static bool is_within(const smear_fill *fill)
{
    return fill->used > 0 && fill->used <= fill->room;
}

static void test_statistics_say_how_full_each_list_was(void)
{
    static const uint8_t method[] = { SMEAR_NONE, SMEAR_RECONSTRUCT, SMEAR_AUTO };
    smear_desc desc = small_desc(64, 48);
    desc.methods |= SMEAR_SET_TEMPORAL;
    desc.max_draws = 9;
    RIG(r, &desc, false);
    for (int m = 0; m < 3; m++) {
        smear_stats few, all;
        struct scene s;
        make_scene(&s, 0.2, method[m]);
        CHECK_EQ(rig_frame(&r, &s.frame, &s.draw[1], 1), SMEAR_OK);
        smear_get_stats(r.ctx, &few);
        CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        smear_get_stats(r.ctx, &all);
        CHECK(is_within(&few.fill.geometry) && is_within(&few.fill.segments) && is_within(&few.fill.draws));
        CHECK(is_within(&all.fill.geometry) && is_within(&all.fill.segments) && is_within(&all.fill.draws));
        CHECK_EQ(few.fill.draws.used, 1);
        CHECK_EQ(all.fill.draws.used, SCENE_DRAWS);
        CHECK_EQ(all.fill.draws.room, 9);
        CHECK(all.fill.geometry.used > few.fill.geometry.used && all.fill.segments.used > few.fill.segments.used);
        CHECK(all.fill.geometry.room == few.fill.geometry.room);
    }
    desc.max_triangles = 8;
    RIG(small, &desc, false);
    smear_stats stats;
    CHECK_EQ(render_scene(&small, 0.2, SMEAR_NONE), SMEAR_OK);
    smear_get_stats(small.ctx, &stats);
    CHECK(stats.parts_added > 0 && is_within(&stats.fill.geometry));
    CHECK(stats.fill.geometry.used > stats.fill.geometry.room / 2);
}

static void test_draws_beyond_the_limit_are_refused_and_not_drawn(void)
{
    smear_desc desc = small_desc(48, 32);
    desc.max_draws = 2;
    RIG(r, &desc, false);
    struct scene s;
    make_scene(&s, 0, SMEAR_NONE);
    uint8_t *picture = rig_copy(&r, &s.frame, &s.draw[1], 2);
    rig_forget_output(&r);
    CHECK_EQ(smear_begin(r.ctx, &s.frame), SMEAR_OK);
    CHECK_EQ(smear_submit(r.ctx, &s.draw[1]), SMEAR_OK);
    CHECK_EQ(smear_submit(r.ctx, &s.draw[2]), SMEAR_OK);
    CHECK_EQ(smear_submit(r.ctx, &s.draw[0]), SMEAR_ERR_FULL);
    CHECK_EQ(smear_submit(r.ctx, &s.draw[3]), SMEAR_ERR_FULL);
    CHECK_EQ(smear_render(r.ctx), SMEAR_OK);
    same_picture(&r, picture);
    free(picture);
}

/* ------------------------------------------------------------------ wild input */

static void test_an_index_out_of_range_drops_its_triangle_only(void)
{
    static const uint16_t index[] = { 0, 1, 4, 0, 1, 2, 65535, 0, 1, 0, 2, 3 };
    smear_desc desc = small_desc(48, 48);
    RIG(r, &desc, false);
    struct scene s;
    make_scene(&s, 0, SMEAR_NONE);
    smear_mesh mesh = square;
    uint8_t *picture = rig_copy(&r, &s.frame, &s.draw[4], 1);
    mesh.index = index;
    mesh.triangle_count = 4;
    s.draw[4].mesh = &mesh;
    CHECK_EQ(rig_frame(&r, &s.frame, &s.draw[4], 1), SMEAR_OK);
    same_picture(&r, picture);
    smear_stats stats;
    smear_get_stats(r.ctx, &stats);
    CHECK_EQ(stats.triangles_dropped, 2);
    CHECK_EQ(stats.triangles_in, 4);
    free(picture);
}

static void test_meshes_without_triangles_or_vertices_draw_nothing(void)
{
    smear_desc desc = small_desc(16, 16);
    RIG(r, &desc, false);
    struct scene s;
    make_scene(&s, 0, 0);
    smear_mesh empty = square, no_vertex = square;
    empty.triangle_count = 0;
    empty.index = NULL;
    no_vertex.vertex_count = 0;
    smear_draw d[2] = { { .mesh = &empty }, { .mesh = &no_vertex } };
    CHECK_EQ(rig_frame(&r, &s.frame, d, 2), SMEAR_OK);
    for (size_t i = 0; i < 16 * 16; i++)
        CHECK_EQ(((const uint32_t *)(const void *)r.picture)[i], 0x203040);
}

/* ------------------------------------------------------------------ flush */

/* A display that takes its time: a thread that frees the oldest band after a while. */
struct slow_display {
    struct rig *rig;
    atomic_int handed, sent;
    atomic_bool over;
    const uint8_t *held[2];
    size_t held_size[2];
    bool overwritten;
    uint8_t copy[2][64 * 8 * 4];
};

static struct slow_display display;

static void *send_slowly(void *unused)
{
    (void)unused;
    for (;;) {
        int sent = atomic_load(&display.sent);
        if (sent == atomic_load(&display.handed)) {
            if (atomic_load(&display.over))
                return NULL;
            sched_yield();
            continue;
        }
        for (int i = 0; i < 20; i++)
            sched_yield();
        /* What was handed over must not have changed while it was being sent. */
        int slot = sent & 1;
        if (memcmp(display.held[slot], display.copy[slot], display.held_size[slot]) != 0)
            display.overwritten = true;
        atomic_store(&display.sent, sent + 1);
        smear_band_done(display.rig->ctx);
    }
}

static int hand_to_slow_display(void *user, const smear_band *band)
{
    int slot = atomic_load(&display.handed) & 1;
    display.held[slot] = band->pixels;
    display.held_size[slot] = band->size;
    memcpy(display.copy[slot], band->pixels, band->size);
    int result = take_band(user, band);
    atomic_fetch_add(&display.handed, 1);
    return result;
}

static void test_two_bands_are_sent_by_another_thread_while_drawing_goes_on(void)
{
    static const uint8_t method[] = { SMEAR_NONE, SMEAR_RECONSTRUCT, SMEAR_SUBFRAMES, SMEAR_AUTO };
    smear_desc desc = small_desc(64, 50);
    desc.methods |= SMEAR_SET_TEMPORAL;
    smear_desc twice = desc;
    twice.bands = 2;
    twice.flush = hand_to_slow_display;
    RIG(one, &desc, false);
    RIG(two, &twice, false);
    memset(&display, 0, sizeof display);
    display.rig = &two;
    pthread_t thread;
    if (CHECK_EQ(pthread_create(&thread, NULL, send_slowly, NULL), 0)) {
        for (int k = 0; k < 8; k++) {
            CHECK_EQ(render_scene(&one, 0.1 * k, method[k & 3]), SMEAR_OK);
            CHECK_EQ(render_scene(&two, 0.1 * k, method[k & 3]), SMEAR_OK);
            same_picture(&one, two.picture);
        }
        atomic_store(&display.over, true);
        pthread_join(thread, NULL);
        CHECK(!display.overwritten);
        CHECK_EQ(atomic_load(&display.sent), 8 * 7);
    }
}

/* ------------------------------------------------------------------ motion */

/* A rig with one square in front of a still camera, whose velocity is read where it is drawn. */
enum { MOTION_W = 64, MOTION_H = 64, STEPS = 2 };      /* velocities may be off by 2/256 px */

static smear_camera motion_camera;
static const smear_material motion_material = { .unlit = 1 };

static bool motion_open(struct rig *r)
{
    smear_desc desc = small_desc(MOTION_W, MOTION_H);
    /* focal 1: 32 px per unit at distance 1; the square lies at distance 4, 8 px per unit. */
    motion_camera = camera_at(0, 0, 0, 0);
    return rig_begin(r, &desc, true);
}

/* The square at (x, y); z is -4 unless a test moves it. */
static smear_transform motion_pose(double x, double y)
{
    return pose_at(x, y, -4, 0, 0);
}

/* Draws one frame of draws and returns the velocity at the pixel, 1/256 px per frame. */
static void motion_frame(struct rig *r, const smear_frame *frame, const smear_draw *draw, int count, int px, int py,
                         int32_t velocity[2])
{
    CHECK_EQ(rig_frame(r, frame, draw, count), SMEAR_OK);
    size_t at = (size_t)py * MOTION_W + (size_t)px;
    velocity[0] = r->velocity[2 * at];
    velocity[1] = r->velocity[2 * at + 1];
}

static bool all_still(const struct rig *r)
{
    for (int i = 0; i < 2 * MOTION_W * MOTION_H; i++)
        if (r->velocity[i] != 0)
            return false;
    return true;
}

/* Frame `k` of a square that moves 0.25 units right and 0.125 up: 2 px right, 1 px up. */
static void moving_square(struct rig *r, int k, const smear_draw *like, smear_frame frame, int32_t velocity[2])
{
    smear_transform now = motion_pose(0.25 * k, 0.125 * k);
    smear_draw d = *like;
    d.mesh = &square;
    d.material = &motion_material;
    d.now = &now;
    frame.camera = &motion_camera;
    motion_frame(r, &frame, &d, 1, 32 + 2 * k, 31 - k, velocity);
}

static void test_a_known_draw_moves_and_unknown_ones_stand_still(void)
{
    struct rig r;
    if (motion_open(&r)) {
        const smear_frame plain = { .camera = NULL };
        const smear_draw known = { .id = 5 }, anonymous = { .id = 0 };
        smear_draw cut = { .id = 5, .cut = 1 };
        int32_t v[2];
        moving_square(&r, 0, &known, plain, v);         /* first frame */
        CHECK(all_still(&r));
        moving_square(&r, 1, &known, plain, v);
        CHECK_NEAR(v[0], 512, STEPS);
        CHECK_NEAR(v[1], -256, STEPS);
        moving_square(&r, 2, &cut, plain, v);           /* teleported */
        CHECK(all_still(&r));
        moving_square(&r, 3, &known, plain, v);         /* and on from there */
        CHECK_NEAR(v[0], 512, STEPS);
        moving_square(&r, 3, &known, plain, v);         /* stopped: no blur is left over */
        CHECK(all_still(&r));
        moving_square(&r, 4, &anonymous, plain, v);     /* without identity: and id 5 is away */
        CHECK(all_still(&r));
        moving_square(&r, 5, &known, plain, v);         /* back again: its earlier pose is unknown */
        CHECK(all_still(&r));
        moving_square(&r, 6, &known, plain, v);
        CHECK_NEAR(v[0], 512, STEPS);
        const smear_draw other = { .id = 6 };
        moving_square(&r, 7, &other, plain, v);         /* first sight of this id */
        CHECK(all_still(&r));
    }
    rig_end(&r);
}

static void test_a_cut_of_the_camera_stops_everything_for_one_frame(void)
{
    struct rig r;
    if (motion_open(&r)) {
        const smear_draw known = { .id = 5 };
        int32_t v[2];
        moving_square(&r, 0, &known, (smear_frame){ .cut = 0 }, v);
        moving_square(&r, 1, &known, (smear_frame){ .cut = 1 }, v);
        CHECK(all_still(&r));
        moving_square(&r, 2, &known, (smear_frame){ .cut = 0 }, v);
        CHECK_NEAR(v[0], 512, STEPS);
        /* The picture of a cut is the sharp one. */
        uint8_t *sharp = NULL;
        for (int k = 0; k < 2; k++) {
            struct scene s;
            make_scene(&s, 0.3, k == 0 ? SMEAR_NONE : SMEAR_RECONSTRUCT);
            s.frame.cut = 1;
            if (k == 0)
                sharp = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
            else
                CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        }
        same_picture(&r, sharp);
        free(sharp);
    }
    rig_end(&r);
}

static void test_given_poses_win_over_kept_ones(void)
{
    struct rig r;
    if (motion_open(&r)) {
        smear_transform now = motion_pose(0, 0), before = motion_pose(-0.5, 0);
        smear_draw d = { .id = 1, .mesh = &square, .now = &now, .open = &before };
        smear_frame f = { .camera = &motion_camera };
        int32_t v[2];
        motion_frame(&r, &f, &d, 1, 32, 32, v);         /* in the very first frame */
        CHECK_NEAR(v[0], 1024, STEPS);
        motion_frame(&r, &f, &d, 1, 32, 32, v);
        CHECK_NEAR(v[0], 1024, STEPS);
        smear_camera earlier = camera_at(-0.25, 0, 0, 0);
        f.open = &earlier;
        motion_frame(&r, &f, &d, 1, 32, 32, v);         /* camera 2 px right as well */
        CHECK_NEAR(v[0], 512, STEPS);
        d.open = NULL;
        d.cut = 1;
        motion_frame(&r, &f, &d, 1, 32, 32, v);
        CHECK_NEAR(v[0], -512, STEPS);
    }
    rig_end(&r);
}

static void test_shutter_poses_are_scaled_to_a_frame(void)
{
    struct rig r;
    if (motion_open(&r)) {
        smear_transform now = motion_pose(0, 0), open = motion_pose(-0.25, 0), close = motion_pose(0.25, 0);
        smear_draw d = { .id = 1, .mesh = &square, .now = &now, .open = &open, .close = &close };
        int32_t v[2];
        /* 4 px between the poses: in half a frame, in a frame, in two. */
        static const int degrees[] = { 180, 360, 720 };
        for (int i = 0; i < 3; i++) {
            smear_frame f = { .camera = &motion_camera, .open = &motion_camera, .close = &motion_camera,
                              .shutter.poses = 1, .shutter.degrees = (uint16_t)degrees[i] };
            motion_frame(&r, &f, &d, 1, 32, 32, v);
            CHECK_NEAR(v[0], 4 * 256 * 360 / degrees[i], 2);
        }
        /* Without poses of its own a draw stands still, kept ones or not. */
        smear_frame f = { .camera = &motion_camera, .shutter.poses = 1 };
        for (int k = 0; k < 2; k++) {
            smear_transform place = motion_pose(0.25 * k, 0);
            smear_draw plain = { .id = 1, .mesh = &square, .now = &place };
            CHECK_EQ(rig_frame(&r, &f, &plain, 1), SMEAR_OK);
            CHECK(all_still(&r));
        }
    }
    rig_end(&r);
}

static void test_deformed_meshes_move_vertex_by_vertex(void)
{
    struct rig r;
    if (motion_open(&r)) {
        int16_t before[12];
        memcpy(before, square_position, sizeof before);
        for (int i = 0; i < 4; i++)
            before[3 * i] = (int16_t)(before[3 * i] - (before[3 * i + 1] > 0 ? 128 : 0));    /* the top leans right */
        smear_transform now = motion_pose(0, 0);
        smear_draw d = { .id = 1, .mesh = &square, .now = &now, .open_position = before };
        smear_frame f = { .camera = &motion_camera };
        int32_t v[2];
        motion_frame(&r, &f, &d, 1, 32, 25, v);
        CHECK_NEAR(v[0], 1024 * 29 / 32, 8);
        motion_frame(&r, &f, &d, 1, 32, 38, v);
        CHECK_NEAR(v[0], 1024 * 3 / 32, 8);
        d.motion = SMEAR_MOTION_CAMERA;
        motion_frame(&r, &f, &d, 1, 32, 25, v);
        CHECK_EQ(v[0], 0);
    }
    rig_end(&r);
}

/* ------------------------------------------------------------------ methods */

/* CRC-32 bit by bit. */
static uint32_t plain_crc(const uint8_t *bytes, size_t n)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < n; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
    }
    return ~crc;
}

static void test_statistics_add_up(void)
{
    static const uint8_t method[] = { SMEAR_NONE, SMEAR_RECONSTRUCT, SMEAR_ACCUMULATE };
    for (int format = 0; format <= SMEAR_L1_PAGES; format++) {
        smear_desc desc = small_desc(70, 50);
        desc.format = (uint8_t)format;
        desc.debug.crc = 1;
        desc.methods |= SMEAR_SET(SMEAR_ACCUMULATE);
        RIG(r, &desc, false);
        for (int k = 0; k < 6; k++) {
            smear_stats s;
            CHECK_EQ(render_scene(&r, 0.3 * k, method[k % 3]), SMEAR_OK);
            smear_get_stats(r.ctx, &s);
            size_t bytes = r.picture_size;
            if (format == SMEAR_XRGB8888) {         /* of 32-bit pixels, the bytes R G B */
                uint8_t *rgb = malloc(bytes);
                const uint32_t *pixel = (const uint32_t *)(const void *)r.picture;
                for (size_t i = 0; i < bytes / 4; i++) {
                    rgb[3 * i] = (uint8_t)(pixel[i] >> 16);
                    rgb[3 * i + 1] = (uint8_t)(pixel[i] >> 8);
                    rgb[3 * i + 2] = (uint8_t)pixel[i];
                }
                CHECK_EQ(s.crc32, plain_crc(rgb, bytes / 4 * 3));
                free(rgb);
            } else {
                CHECK_EQ(s.crc32, plain_crc(r.picture, bytes));
            }
            CHECK_EQ(s.pixels, 70 * 50);
            uint32_t tiles = 9 * 7;
            CHECK_EQ(s.tiles_static + s.tiles_uniform + s.tiles_complex, tiles);
            CHECK_EQ(s.tiles[SMEAR_NONE] + s.tiles[SMEAR_ACCUMULATE] + s.tiles[SMEAR_RECONSTRUCT], tiles);
            CHECK_EQ(s.triangles_in, 2 + 12 + 12 + 2 + 2);
            CHECK(s.triangles_drawn > 8);
            CHECK_EQ(s.triangles_dropped, 0);
            CHECK_EQ(s.arena_bytes, (int64_t)r.bytes);
            CHECK_EQ(s.time.total, 0);              /* no clock */
            if (method[k % 3] == SMEAR_ACCUMULATE)
                CHECK_EQ(s.samples, 8 * 70 * 50);
        }
    }
}

static uint32_t ticking(void *user)
{
    static uint32_t ticks;
    (void)user;
    return ticks++;
}

static void test_a_clock_times_the_stages_and_changes_no_pixel(void)
{
    smear_desc desc = small_desc(64, 48), clocked = desc;
    clocked.debug.clock = ticking;
    RIG(timed, &clocked, false);
    RIG(plain, &desc, false);
    for (int k = 0; k < 3; k++) {
        CHECK_EQ(render_scene(&timed, 0.2 * k, 0), SMEAR_OK);
        CHECK_EQ(render_scene(&plain, 0.2 * k, 0), SMEAR_OK);
        same_picture(&timed, plain.picture);
        smear_stats s;
        smear_get_stats(timed.ctx, &s);
        CHECK(s.time.submit > 0 && s.time.raster > 0 && s.time.reduce > 0 && s.time.blur > 0);
        CHECK(s.time.total >= s.time.submit + s.time.raster + s.time.reduce + s.time.blur + s.time.convert);
        CHECK_EQ(s.crc32, 0);                       /* not asked for */
    }
}

/* ------------------------------------------------------------------ instants */

static void test_the_sharp_picture_under_a_filter_lies_at_the_middle_of_the_exposure(void)
{
    struct rig r;
    if (motion_open(&r)) {
        static const struct { uint8_t exposure; int shift; } middle[] = {       /* 4 px a frame, all of it open */
            { SMEAR_CENTRED, 0 }, { SMEAR_TRAILING, -2 }, { SMEAR_LEADING, 2 }
        };
        for (int i = 0; i < 3; i++) {
            smear_transform now = motion_pose(0, 0), before = motion_pose(-0.5, 0);
            smear_draw d = { .mesh = &square, .material = &motion_material, .now = &now, .open = &before };
            smear_frame f = { .camera = &motion_camera, .shutter.degrees = 360, .shutter.exposure = middle[i].exposure };
            CHECK_EQ(rig_frame(&r, &f, &d, 1), SMEAR_OK);
            for (int x = 0; x < MOTION_W; x++)          /* 16 px wide around the centre */
                CHECK_EQ(r.depth[32 * MOTION_W + x] != 0, x >= 24 + middle[i].shift && x < 40 + middle[i].shift);
            CHECK_NEAR(r.velocity[2 * (32 * MOTION_W + 32)], 1024, STEPS);
        }
    }
    rig_end(&r);
}

static void test_a_teleport_without_a_cut_streaks_for_one_frame_only(void)
{
    smear_desc desc = small_desc(96, 72);
    RIG(r, &desc, true);
    smear_camera camera = camera_at(0, 0, 0, 0);
    smear_transform pose[2] = { pose_at(-2, 0, -4, 0, 0), pose_at(2, 0, -4, 0, 0) };
    smear_draw d = { .id = 3, .mesh = &square, .now = &pose[1] };
    smear_frame f = { .camera = &camera, .method = SMEAR_NONE };
    uint8_t *sharp = rig_copy(&r, &f, &d, 1);
    f.method = SMEAR_RECONSTRUCT;
    d.now = &pose[0];
    CHECK_EQ(rig_frame(&r, &f, &d, 1), SMEAR_OK);
    d.now = &pose[1];
    CHECK_EQ(rig_frame(&r, &f, &d, 1), SMEAR_OK);
    CHECK_NEAR(r.velocity[2 * (36 * 96 + 66)], 36 * 256, 4 * STEPS);     /* 4 units of 9 px */
    CHECK(memcmp(sharp, r.picture, r.picture_size) != 0);
    CHECK_EQ(rig_frame(&r, &f, &d, 1), SMEAR_OK);
    same_picture(&r, sharp);
    free(sharp);
}

/* ------------------------------------------------------------------ what is drawn */

/* A square that fills the frame, a texel per pixel: all sizes that have loops of their own, and some that have not. */
static void test_textures_of_every_size_show_their_texels(void)
{
    static const uint16_t size[] = { 1, 2, 16, 32, 64, 128, 256, 512, 37, 100, 200 };
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++)
        for (int variant = 0; variant < 3; variant++) {
            int width = size[i], height = variant == 0 ? width : variant == 1 ? 64 : size[(i + 3) % 11];
            uint32_t *texels = malloc((size_t)width * (size_t)height * 4);
            for (int k = 0; k < width * height; k++)
                texels[k] = 0xff000000u | (uint32_t)(k / width) << 12 | (uint32_t)(k % width);
            smear_desc desc = small_desc(width, height);
            desc.methods = SMEAR_SET(SMEAR_NONE);
            RIG(r, &desc, false);
            smear_texture texture = { .texels = texels, .width = (uint16_t)width, .height = (uint16_t)height };
            smear_material material = { .texture = &texture, .unlit = 1 };
            /* Orthographic: one unit is half the height. */
            smear_camera camera = camera_at(0, 0, 0, 0);
            camera.half_height = 65536;
            smear_transform pose = pose_at(0, 0, -4, 0, 0);
            pose.basis[0] = (int32_t)((int64_t)SMEAR_BASIS_ONE * width / height);
            int16_t uv[8];
            for (int k = 0; k < 8; k++)             /* a whole turn: 2^14 mesh units */
                uv[k] = square_uv[k] != 0 ? 16384 : 0;
            smear_mesh mesh = square;
            mesh.uv = uv;
            mesh.uv_shift = 14;
            smear_draw d = { .mesh = &mesh, .material = &material, .now = &pose };
            smear_frame f = { .camera = &camera, .method = SMEAR_NONE };
            CHECK_EQ(rig_frame(&r, &f, &d, 1), SMEAR_OK);
            const uint32_t *pixel = (const uint32_t *)(const void *)r.picture;
            for (int k = 0; k < width * height; k++)
                if (!CHECK_EQ(pixel[k], texels[k] & 0xffffffu)) {
                    CHECK_EQ(width * 1000 + height, -1);
                    break;
                }
            free(texels);
        }
}

static void test_the_largest_textures_are_taken(void)
{
    smear_desc desc = small_desc(16, 16);
    RIG(r, &desc, false);
    uint8_t *texels = calloc(4096, 1);
    static const uint32_t palette[256] = { 0xff305070u };
    smear_texture texture = { .texels = texels, .palette = palette, .width = 1, .height = 4096,
                              .format = SMEAR_TEXEL_PALETTE8 };
    smear_material material = { .texture = &texture, .unlit = 1 };
    smear_transform pose = pose_at(0, 0, -1.5, 0, 0);
    smear_camera camera = camera_at(0, 0, 0, 0);
    smear_draw d = { .mesh = &square, .material = &material, .now = &pose };
    smear_frame f = { .camera = &camera };
    for (int turn = 0; turn < 2; turn++) {
        CHECK_EQ(rig_frame(&r, &f, &d, 1), SMEAR_OK);
        CHECK_EQ(((const uint32_t *)(const void *)r.picture)[8 * 16 + 8], 0x305070);
        texture.width = 4096;
        texture.height = 1;
    }
    free(texels);
}

/* ------------------------------------------------------------------ the filter alone */

/* A distance whose depth code is `code`, for near plane one: the middle of the code's step. */
static uint32_t distance_for(uint16_t code)
{
    if (code == 0)
        return 0;
    double units = code < 32768 ? code + 0.5 : 32768 + (code - 32768) * 16.0;
    return (uint32_t)(65536.0 * SMEAR_DEPTH_NEAR / units);
}

static void test_the_filter_gives_the_bits_of_rendering_the_same_content(void)
{
    static const uint8_t flags[] = { 0, SMEAR_FENCE, SMEAR_CORNER, SMEAR_BOX, SMEAR_DIRECTION, SMEAR_PUBLISHED, 31 };
    for (int variant = 0; variant < 14; variant++) {
        smear_desc desc = small_desc(variant & 1 ? 100 : 64, 70);
        desc.reach = (int16_t)(variant & 2 ? 20 : 12);
        desc.methods |= SMEAR_SET(SMEAR_CAMERA);
        RIG(r, &desc, true);
        RIG(alone, &desc, false);
        smear_camera camera = camera_at(0, 0, 0, 0);
        camera.near_plane = 65536;
        uint8_t *picture = NULL;
        smear_frame f = { .camera = &camera, .filter.flags = flags[variant % 7], .clear = 0x556677,
                          .shutter.degrees = 360, .samples = (uint16_t)(4 + 3 * variant),
                          .light_space = (uint8_t)(variant / 7) };
        for (int k = 0; k < 2; k++) {
            /* Upright squares at powers of two, moving by whole sixteenths of a pixel: depth and velocity pass
             * the filter's formats unchanged. */
            smear_transform pose[4];
            smear_draw d[4];
            smear_material m[4];
            for (int i = 0; i < 4; i++) {
                double px = (double)desc.height / 2 / (2 << i);     /* per unit */
                static const int step[4][2] = { { -6, 0 }, { 0, 3 }, { 5, -4 }, { 0, 0 } };      /* px per frame */
                pose[i] = pose_at((i * 6 - 8 + k * step[i][0]) / px, (8 - 5 * i + k * step[i][1]) / px, -(2 << i),
                                  0, 0);
                m[i] = (smear_material){ .texture = &checker_texture, .unlit = 1 };
                d[i] = (smear_draw){ .id = (uint32_t)i + 1, .mesh = &square, .material = &m[i], .now = &pose[i] };
                for (int e = 0; e < 9; e++)
                    pose[i].basis[e] *= i + 1;
            }
            make_checker();
            free(picture);
            picture = rig_copy(&r, &f, d, 4);
        }
        smear_frame before = f;                 /* of which nothing stays: it is blurred along lines */
        before.method = SMEAR_CAMERA;
        for (int k = 0; k < 2; k++) {
            smear_camera turned = camera_at(0, 0, 0, 0.1 * k);
            before.camera = &turned;
            CHECK_EQ(rig_frame(&alone, &before, NULL, 0), SMEAR_OK);
        }
        rig_forget_output(&alone);
        CHECK_EQ(smear_filter_begin(alone.ctx, &f), SMEAR_OK);
        int moving = 0, left_out = 0;
        for (int y = 0; y < desc.height; y++) {
            uint32_t depth[128];
            int16_t velocity[256];
            for (int x = 0; x < desc.width; x++) {
                int at = y * desc.width + x;
                depth[x] = distance_for(r.depth[at]);
                for (int axis = 0; axis < 2; axis++) {
                    int32_t v = r.velocity[2 * at + axis];
                    velocity[2 * x + axis] = (int16_t)(v >= 0 ? (v + 8) / 16 : -((8 - v) / 16));
                    moving += v != 0;
                    left_out += abs(velocity[2 * x + axis] * 16 - v) > 7;
                }
            }
            CHECK_EQ(smear_filter_row(alone.ctx, r.color + y * desc.width, depth, velocity), SMEAR_OK);
        }
        CHECK(moving > 1000);
        CHECK_EQ(left_out, 0);
        CHECK(alone.bands_in_order && alone.next_row == desc.height);
        if (!same_picture(&alone, picture))
            CHECK_EQ(variant, -1);
        smear_stats rendered, filtered;
        smear_get_stats(r.ctx, &rendered);
        smear_get_stats(alone.ctx, &filtered);
        CHECK_EQ(rendered.samples, filtered.samples);
        CHECK_EQ(rendered.tiles_complex, filtered.tiles_complex);
        free(picture);
    }
}

static void test_the_filter_refuses_what_it_cannot_do(void)
{
    smear_desc desc = small_desc(16, 16);
    desc.methods |= SMEAR_SET(SMEAR_ACCUMULATE);
    RIG(r, &desc, false);
    smear_camera camera = { .near_plane = 65536 };      /* all that is looked at */
    smear_frame f = { .camera = &camera, .method = SMEAR_RECONSTRUCT };
    static const uint32_t words[16];
    static const int16_t halves[32];
    CHECK_EQ(smear_filter_begin(r.ctx, &f), SMEAR_OK);
    CHECK_EQ(smear_error_kind(smear_filter_row(r.ctx, NULL, words, halves)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_filter_row(r.ctx, words, NULL, halves)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_filter_row(r.ctx, words, words, NULL)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_filter_row(NULL, words, words, halves)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_filter_begin(r.ctx, NULL)), SMEAR_ERR_ARG);
    CHECK_EQ(smear_error_kind(smear_filter_begin(NULL, &f)), SMEAR_ERR_ARG);
    f.method = SMEAR_NONE;
    CHECK_EQ(smear_error_kind(smear_filter_begin(r.ctx, &f)), SMEAR_ERR_ARG);
    f.method = SMEAR_ACCUMULATE;
    CHECK_EQ(smear_error_kind(smear_filter_begin(r.ctx, &f)), SMEAR_ERR_ARG);
    f.method = SMEAR_RECONSTRUCT;
    camera.near_plane = 0;
    CHECK_EQ(smear_error_kind(smear_filter_begin(r.ctx, &f)), SMEAR_ERR_ARG);
    f.camera = NULL;
    CHECK_EQ(smear_error_kind(smear_filter_begin(r.ctx, &f)), SMEAR_ERR_ARG);
}

#include "build/suites/api.h"
