/* SPDX-License-Identifier: MIT */
/* test_motion.c - where velocities come from: motion modes, deformation, billboards, zooms; what is still to the eye; scales;
 * the frame-rate modes of the shutter. */
#include "tests/rig.h"

#include "filter/probe.h"

void say(const char *format, ...);      /* accuracy.h, whose scenes are others */

/* ------------------------------------------------------------------ a small stage */

/* A square before a wide wall, seen by a camera that may move; through the public interface. */
enum { WIDTH = 96, HEIGHT = 64 };

struct stage {
    smear_transform wall, wall_before, square, square_before;
    smear_camera camera, before;
    smear_material material[2];
    smear_draw draw[2];
    smear_frame frame;
};

/* The wall and the square take velocities of their vertices; or of depth, where they do not move themselves. */
enum { VERTICES, DEPTH, SOURCES };

static void stage_make(struct stage *s, int method, int source)
{
    memset(s, 0, sizeof *s);
    s->wall = s->wall_before = pose_at(0, 0, -20, 0, 0);
    for (int i = 0; i < 9; i++)
        s->wall.basis[i] = s->wall_before.basis[i] *= 30;
    s->square = s->square_before = pose_at(0, 0, -4, 0, 0);
    s->camera = s->before = camera_at(0, 0, 0, 0);
    s->material[0] = (smear_material){ .color = { 60, 90, 40, 255 }, .unlit = 1 };
    s->material[1] = (smear_material){ .color = { 200, 220, 255, 255 }, .unlit = 1, .double_sided = 1 };
    s->draw[0] = (smear_draw){ .mesh = &square, .material = &s->material[0], .now = &s->wall, .open = &s->wall_before };
    s->draw[1] = (smear_draw){ .mesh = &square, .material = &s->material[1], .now = &s->square,
                               .open = &s->square_before };
    s->frame = (smear_frame){ .camera = &s->camera, .open = &s->before, .method = (uint8_t)method, .filter.camera_step = source == DEPTH,
                               .filter.flags = source == DEPTH ? 0 : SMEAR_PUBLISHED };
}

/* A stage, and a rig that looks at it. */
#define STAGE(r, s) \
    struct stage s; \
    smear_desc s##_desc = small_desc(WIDTH, HEIGHT); \
    s##_desc.methods = SMEAR_SET_FILTERS; \
    RIG(r, &s##_desc, true)

static bool stage_draw(struct rig *r, const struct stage *s)
{
    return CHECK_EQ(rig_frame(r, &s->frame, s->draw, 2), SMEAR_OK);
}

/* Velocity at a pixel, 1/256 px per frame. */
static const int32_t *velocity_at(const struct rig *r, int x, int y)
{
    return r->velocity + 2 * (y * WIDTH + x);
}

/* The square's middle and a place on the wall. */
static const int32_t *of_square(const struct rig *r) { return velocity_at(r, WIDTH / 2, HEIGHT / 2); }
static const int32_t *of_wall(const struct rig *r) { return velocity_at(r, 6, 6); }

/* ------------------------------------------------------------------ motion modes */

static void test_motion_none_writes_zero_over_what_moves_behind(void)
{
    STAGE(r, s);
    for (int source = 0; source < SOURCES; source++) {
        stage_make(&s, SMEAR_RECONSTRUCT, source);
        s.before = camera_at(0.3, 0, 0, 0.05);
        s.wall_before.origin[0] += q16(1.0);
        s.square_before.origin[0] -= q16(0.5);
        s.draw[1].motion = SMEAR_MOTION_NONE;
        if (!stage_draw(&r, &s))
            break;
        CHECK(of_wall(&r)[0] < -256 || of_wall(&r)[0] > 256);
        for (int y = 28; y < 36; y++)
            for (int x = 44; x < 52; x++)
                CHECK(velocity_at(&r, x, y)[0] == 0 && velocity_at(&r, x, y)[1] == 0);
        CHECK_EQ(r.inspected, HEIGHT);
    }
}

static void test_motion_camera_leaves_the_objects_own_motion_out(void)
{
    STAGE(r, s);
    for (int source = 0; source < SOURCES; source++) {
        int32_t still[2], moved[2];
        stage_make(&s, SMEAR_RECONSTRUCT, source);
        s.before = camera_at(0.1, 0, 0, 0);
        stage_draw(&r, &s);
        memcpy(still, of_square(&r), sizeof still);
        s.square_before.origin[1] += q16(0.4);
        stage_draw(&r, &s);
        memcpy(moved, of_square(&r), sizeof moved);
        s.draw[1].motion = SMEAR_MOTION_CAMERA;
        stage_draw(&r, &s);
        CHECK_NEAR(still[0], of_square(&r)[0], 1);
        CHECK_NEAR(still[1], of_square(&r)[1], 1);
        CHECK(moved[1] > still[1] + 256 && still[0] > 128);
        /* 0.1 units at a distance of 4, 32 pixels per unit of tangent. */
        CHECK_NEAR(still[0], 256 * 32 / 40, 6);
    }
}

static void test_only_draws_that_move_themselves_have_velocities_of_vertices(void)
{
    STAGE(r, s);
    smear_stats stats;
    static int16_t bent[12];
    memcpy(bent, square_position, sizeof bent);
    bent[1] += 20;
    /* what moves: nothing, the camera, the square, it bends, it is opted out, it is cut */
    static const uint8_t wanted[6][SOURCES] = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 2, 1 }, { 1, 0 }, { 2, 0 } };
    for (int what = 0; what < 6; what++)
        for (int source = 0; source < SOURCES; source++) {
            stage_make(&s, SMEAR_RECONSTRUCT, source);
            if (what > 0)
                s.before = camera_at(0.1, 0, 0, 0);
            if (what >= 2 && what != 3)
                s.square_before.origin[0] += 6000;
            if (what == 3)
                s.draw[1].open_position = bent;
            s.draw[1].motion = what == 4 ? SMEAR_MOTION_NONE : SMEAR_MOTION_FULL;
            s.draw[1].cut = what == 5;
            stage_draw(&r, &s);
            smear_get_stats(r.ctx, &stats);
            if (!CHECK_EQ(stats.draws_moved, wanted[what][source]))
                CHECK_EQ(what, -1);
            s.frame.method = SMEAR_CAMERA;
            stage_draw(&r, &s);
            smear_get_stats(r.ctx, &stats);
            CHECK_EQ(stats.draws_moved, 0);
        }
}

static void test_a_cutout_cuts_velocity_and_a_blended_draw_writes_none(void)
{
    STAGE(r, s);
    static uint32_t texel[16];
    static const smear_texture holes = { .texels = texel, .width = 4, .height = 4 };
    for (uint32_t i = 0; i < 16; i++)
        texel[i] = (i ^ i >> 2) & 1u ? 0xffffffffu : 0x00ffffffu;
    for (int source = 0; source < SOURCES; source++)
        for (int alpha = SMEAR_CUTOUT; alpha <= SMEAR_BLEND; alpha++) {
            int own = 0, behind = 0;
            stage_make(&s, SMEAR_RECONSTRUCT, source);
            s.before = camera_at(0.2, 0, 0, 0);
            s.square_before.origin[0] = q16(-0.6);
            s.material[1].texture = &holes;
            s.material[1].alpha = (uint8_t)alpha;
            stage_draw(&r, &s);
            int32_t wall = of_wall(&r)[0];
            for (int y = 25; y < 39; y++)
                for (int x = 41; x < 55; x++) {
                    int32_t v = velocity_at(&r, x, y)[0];
                    bool is_hole = r.color[y * WIDTH + x] == r.color[6 * WIDTH + 6];
                    CHECK_NEAR(v, is_hole ? wall : 256 * 32 * 8 / 40, 24);
                    behind += is_hole;
                    own += !is_hole;
                }
            CHECK_EQ(own != 0, alpha == SMEAR_CUTOUT);
            CHECK(behind > 60);
        }
}

static void test_a_zoom_moves_all_but_the_middle(void)
{
    STAGE(r, s);
    for (int source = 0; source < SOURCES; source++) {
        stage_make(&s, SMEAR_RECONSTRUCT, source);
        s.before.focal = s.camera.focal * 10 / 11;
        stage_draw(&r, &s);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                /* Now minus a frame ago: x (1 - 10/11). */
                double dx = (x + 0.5 - WIDTH / 2) / 11 * 256, dy = (y + 0.5 - HEIGHT / 2) / 11 * 256;
                CHECK_CLOSE((double)velocity_at(&r, x, y)[0], dx, 3.0);
                CHECK_CLOSE((double)velocity_at(&r, x, y)[1], dy, 3.0);
            }
    }
}

static void test_vertex_animation_takes_previous_positions_and_another_count_is_rigid(void)
{
    STAGE(r, s);
    static int16_t before[12];
    for (int i = 0; i < 12; i++)
        before[i] = (int16_t)(square_position[i] - (i % 3 == 1 ? 32 : 0));      /* 1/8 unit below */
    for (int source = 0; source < SOURCES; source++)
        for (int method = SMEAR_RECONSTRUCT; method <= SMEAR_PINGPONG; method += SMEAR_PINGPONG - SMEAR_RECONSTRUCT) {
            stage_make(&s, method, source);
            s.square_before.origin[0] = q16(-0.25);
            s.draw[1].open_position = before;
            stage_draw(&r, &s);
            CHECK_NEAR(of_square(&r)[0], 512, 4);
            CHECK_NEAR(of_square(&r)[1], -256, 4);
            s.draw[1].open_count = 4;
            stage_draw(&r, &s);
            CHECK_NEAR(of_square(&r)[1], -256, 4);
            s.draw[1].open_count = 3;                   /* nothing is read of it */
            s.draw[1].open_position = (const int16_t *)8;
            stage_draw(&r, &s);
            CHECK_NEAR(of_square(&r)[0], 512, 4);
            CHECK_NEAR(of_square(&r)[1], 0, 1);
        }
}

static void test_billboards_turn_with_the_camera_of_each_pose(void)
{
    STAGE(r, s);
    for (int upright = 0; upright < 2; upright++)
        for (int source = 0; source < SOURCES; source++) {
            int32_t *told = malloc(sizeof *told * 2 * WIDTH * HEIGHT);
            if (!CHECK(told != NULL))
                continue;
            /* The camera circles the square by 10 degrees. Told by hand: the basis of each pose. */
            stage_make(&s, SMEAR_RECONSTRUCT, source);
            double angle = 10 * 3.14159265 / 180, turn = 0.3;
            s.camera = camera_at(4 * sin(turn), 0, -4 + 4 * cos(turn), turn);
            s.before = camera_at(4 * sin(turn - angle), 0, -4 + 4 * cos(turn - angle), turn - angle);
            s.draw[0].motion = SMEAR_MOTION_CAMERA;
            s.square = pose_at(0, 0, -4, turn, 0);
            s.square_before = pose_at(0, 0, -4, turn - angle, 0);
            stage_draw(&r, &s);
            memcpy(told, r.velocity, sizeof *told * 2 * WIDTH * HEIGHT);
            CHECK(told[2 * (20 * WIDTH + 90)] > 512);
            /* At its middle it stays where it is, and so does all of it. */
            CHECK_NEAR(of_square(&r)[0], 0, 8);
            s.square = s.square_before = pose_at(0, 0, -4, 0, 0);
            s.draw[1].billboard = (uint8_t)(upright ? SMEAR_BILLBOARD_UPRIGHT : SMEAR_BILLBOARD_FACING);
            stage_draw(&r, &s);
            for (int i = 0; i < 2 * WIDTH * HEIGHT; i++)
                /* Told, it stays where it is before the camera; the camera of two poses goes straight, not round. */
                if (!CHECK_NEAR(r.velocity[i], told[i], 40)) {
                    CHECK_EQ(i, -1);
                    break;
                }
            s.draw[1].billboard = SMEAR_BILLBOARD_UPRIGHT + 1;
            CHECK_EQ(smear_error_kind(rig_frame(&r, &s.frame, s.draw, 2)), SMEAR_ERR_ARG);
            free(told);
        }
}

/* Looking down, an upright board keeps standing, a facing one lies down. */
static void test_upright_billboards_stay_upright(void)
{
    STAGE(r, s);
    int rows[2] = { 0, 0 };
    for (int upright = 0; upright < 2; upright++) {
        stage_make(&s, SMEAR_RECONSTRUCT, VERTICES);
        s.camera.pose = s.before.pose = pose_at(0, 3, -1, 0, -0.8);
        s.draw[1].billboard = (uint8_t)(upright ? SMEAR_BILLBOARD_UPRIGHT : SMEAR_BILLBOARD_FACING);
        stage_draw(&r, &s);
        for (int y = 0; y < HEIGHT; y++)
            rows[upright] += r.color[y * WIDTH + WIDTH / 2] == 0xc8dcff;
    }
    CHECK(rows[0] > rows[1] + 3 && rows[1] > 4);
}

/* ------------------------------------------------------------------ still to the eye */

/* Every filter, by vertices and by depth. */
struct way {
    uint8_t method, filter, step, reconstruct;
};

static const struct way ways[] = {
    { SMEAR_RECONSTRUCT, 0, 0, SMEAR_FENCE | SMEAR_PUBLISHED }, { SMEAR_RECONSTRUCT, 0, 1, SMEAR_FENCE },
    { SMEAR_RECONSTRUCT, 0, 1, SMEAR_FENCE | SMEAR_PUBLISHED }, { SMEAR_RECONSTRUCT, 0, 0, SMEAR_FENCE },
    { SMEAR_CAMERA, SMEAR_FILTER_MEAN, 1, 0 }, { SMEAR_CAMERA, SMEAR_FILTER_MEAN, 4, 0 },
    { SMEAR_CAMERA, SMEAR_FILTER_PINGPONG, 2, 0 }, { SMEAR_CAMERA, SMEAR_FILTER_RECONSTRUCT, 1, SMEAR_FENCE },
    { SMEAR_PINGPONG, 0, 0, 0 }, { SMEAR_PINGPONG, 0, 1, 0 }, { SMEAR_HALF, 0, 0, SMEAR_FENCE },
    { SMEAR_HALF, SMEAR_FILTER_MEAN, 1, 0 }, { SMEAR_HALF, SMEAR_FILTER_PINGPONG, 2, 0 }
};
enum { WAYS = sizeof ways / sizeof *ways };

static void stage_way(struct stage *s, const struct way *w)
{
    s->frame.method = w->method;
    s->frame.filter.kind = w->filter;
    s->frame.filter.camera_step = w->step;
    s->frame.filter.flags = w->reconstruct;
    s->frame.samples = 16;
    s->frame.shutter.degrees = 1440;
}

/* Pixels of the square that differ from the sharp frame's; and elsewhere. */
static bool differences(struct rig *r, const struct stage *s, int count[2])
{
    struct stage sharp = *s;
    count[0] = count[1] = 0;
    sharp.frame.camera = &sharp.camera;
    sharp.frame.open = &sharp.before;
    sharp.frame.method = SMEAR_NONE;
    uint8_t *picture = rig_copy(r, &sharp.frame, sharp.draw, 2);
    bool ok = picture != NULL && stage_draw(r, s);
    const uint32_t *a = (const uint32_t *)(const void *)r->picture, *b = (const uint32_t *)(const void *)picture;
    for (int i = 0; i < WIDTH * HEIGHT && ok; i++)
        count[b[i] != 0xc8dcff] += a[i] != b[i];
    free(picture);
    return ok;
}

static void test_what_is_still_to_the_eye_is_the_sharp_frames_bit_for_bit(void)
{
    STAGE(r, s);
    make_checker();
    for (int w = 0; w < WAYS; w++)
        for (int frame = 0; frame < 6; frame++) {
            int count[2];
            double turn = 0.06 * frame, way = 0.2 * frame;
            stage_make(&s, SMEAR_NONE, VERTICES);
            s.material[0].texture = &checker_texture;
            stage_way(&s, &ways[w]);
            /* Attached to the camera, which moves and turns; not opted out. */
            s.camera = camera_at(way, 0, 0, turn);
            s.before = camera_at(way - 0.2, 0, 0, turn - 0.06);
            s.square = pose_at(way - 4 * sin(turn), 0, -4 * cos(turn), turn, 0);
            s.square_before = pose_at(way - 0.2 - 4 * sin(turn - 0.06), 0, -4 * cos(turn - 0.06), turn - 0.06, 0);
            if (!differences(&r, &s, count) || !CHECK_EQ(count[0], 0) || !CHECK(count[1] > 200))
                say("      attached: way %d, frame %d\n", w, frame);
            /* Opted out, wherever it goes. */
            s.square_before.origin[0] += q16(0.3);
            s.draw[1].motion = SMEAR_MOTION_NONE;
            if (!differences(&r, &s, count) || !CHECK_EQ(count[0], 0) || !CHECK(count[1] > 200))
                say("      opted out: way %d, frame %d\n", w, frame);
            /* A camera cut. */
            s.frame.cut = 1;
            if (!differences(&r, &s, count) || !CHECK_EQ(count[0] + count[1], 0))
                say("      cut: way %d, frame %d\n", w, frame);
        }
}

/* Through ids: the library keeps the poses. */
static void test_the_blur_ends_in_the_frame_in_which_motion_ends(void)
{
    for (int w = 0; w < WAYS; w++) {
        STAGE(r, s);
        for (int frame = 0; frame < 8; frame++) {
            bool object = ways[w].method != SMEAR_CAMERA;
            double at = 0.4 * (frame < 5 ? frame : 4);
            stage_make(&s, SMEAR_NONE, VERTICES);
            stage_way(&s, &ways[w]);
            s.material[0].texture = &checker_texture;
            s.frame.open = NULL;
            for (int i = 0; i < 2; i++) {
                s.draw[i].id = (uint32_t)i + 1;
                s.draw[i].open = NULL;
            }
            if (object)
                s.square.origin[0] = q16(at);
            else
                s.camera = camera_at(at, 0, 0, 0);
            uint8_t *blurred = rig_copy(&r, &s.frame, s.draw, 2);
            s.frame.method = SMEAR_NONE;
            s.frame.cut = 1;
            RIG(sharp, &s_desc, true);
            uint8_t *picture = rig_copy(&sharp, &s.frame, s.draw, 2);
            bool same = blurred != NULL && picture != NULL && memcmp(picture, blurred, WIDTH * HEIGHT * 4) == 0;
            if (!CHECK_EQ(same, frame == 0 || frame >= 5))
                say("      way %d, frame %d\n", w, frame);
            free(picture);
            free(blurred);
        }
    }
}

/* ------------------------------------------------------------------ scales */

static void test_rotation_translation_and_objects_scale_apart(void)
{
    STAGE(r, s);
    for (int source = 0; source < SOURCES; source++) {
        int32_t part[3][2];             /* of the square: the camera turns, it goes, the square moves */
        for (int i = 0; i < 3; i++) {
            stage_make(&s, SMEAR_RECONSTRUCT, source);
            s.before = camera_at(i == 1 ? 0.15 : 0, 0, 0, i == 0 ? 0.04 : 0);
            s.square_before.origin[1] = i == 2 ? q16(0.25) : 0;
            stage_draw(&r, &s);
            memcpy(part[i], of_square(&r), sizeof part[i]);
        }
        CHECK(part[0][0] < -256 && part[1][0] > 256 && part[2][1] > 256);
        static const uint16_t scale[] = { SMEAR_SCALE_NONE, 64, 0, 256, 512 };
        static const double factor[] = { 0, 0.25, 1, 1, 2 };
        for (int i = 0; i < 125; i++) {
            int k[3] = { i % 5, i / 5 % 5, i / 25 };
            stage_make(&s, SMEAR_RECONSTRUCT, source);
            s.before = camera_at(0.15, 0, 0, 0.04);
            s.square_before.origin[1] = q16(0.25);
            s.frame.scale.rotation = scale[k[0]];
            s.frame.scale.translation = scale[k[1]];
            s.frame.scale.object = scale[k[2]];
            stage_draw(&r, &s);
            for (int axis = 0; axis < 2; axis++) {
                double want = 0;
                for (int j = 0; j < 3; j++)
                    want += factor[k[j]] * part[j][axis];
                /* Velocities of vertices are measured over half a frame, and doubled. */
                CHECK_CLOSE((double)of_square(&r)[axis], want, 45 + 0.03 * fabs(want));
            }
            if (k[0] == 0 && k[1] == 0) {
                CHECK_EQ(of_wall(&r)[0], 0);
                CHECK_EQ(of_wall(&r)[1], 0);
            }
        }
        s.frame.scale.rotation = 16129;
        CHECK_EQ(smear_error_kind(rig_frame(&r, &s.frame, s.draw, 2)), SMEAR_ERR_ARG);
    }
}

/* Scaled by k, a vertex that was d away was k d away; velocities, and pictures of all methods that take poses. */
static void test_deformation_scales_with_objects(void)
{
    static const uint8_t methods[] = { SMEAR_RECONSTRUCT, SMEAR_PINGPONG, SMEAR_ACCUMULATE, SMEAR_SUBFRAMES, SMEAR_TIMEMASK,
                                       SMEAR_OBJECT, SMEAR_LAYERED };
    static const uint16_t scale[] = { 64, 128, 384, 1024, 4096 };       /* the last: as 2048 */
    static int16_t bent[2][12], told[2][12];
    smear_desc desc = small_desc(WIDTH, HEIGHT);
    desc.methods = SMEAR_SET_FILTERS | SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS;
    RIG(r, &desc, true);
    for (int m = 0; m < 7; m++)
        for (int i = 0; i < 5; i++)
            for (int poses = 0; poses < 2; poses++) {
                struct stage s;
                const int by = scale[i] > 2048 ? 2048 : scale[i];
                for (int k = 0; k < 12; k++) {          /* the upper edge goes */
                    int way = k >= 6 && k % 3 != 2 ? 96 + 64 * (k % 3) : 0;
                    bent[0][k] = (int16_t)(square_position[k] - way);
                    bent[1][k] = (int16_t)(square_position[k] + 2 * way);
                    told[0][k] = (int16_t)(square_position[k] - way * by / 256);
                    told[1][k] = (int16_t)(square_position[k] + 2 * way * by / 256);
                }
                stage_make(&s, methods[m], VERTICES);
                s.frame.samples = 16;
                s.frame.shutter.poses = (uint8_t)poses;
                s.draw[1].close = poses ? &s.square : NULL;
                s.draw[1].open_position = bent[0];
                s.draw[1].close_position = poses ? bent[1] : NULL;
                s.frame.scale.object = scale[i];
                stage_draw(&r, &s);
                int32_t velocity[2] = { velocity_at(&r, 54, 26)[0], velocity_at(&r, 54, 26)[1] };
                uint8_t *scaled = rig_copy(&r, &s.frame, s.draw, 2);
                s.frame.scale.object = 0;
                s.draw[1].open_position = told[0];
                s.draw[1].close_position = poses ? told[1] : NULL;
                stage_draw(&r, &s);
                int worst = 0, different = 0;
                for (int k = 0; k < 2 && (methods[m] == SMEAR_RECONSTRUCT || methods[m] == SMEAR_PINGPONG); k++)
                    CHECK_NEAR(velocity[k], velocity_at(&r, 54, 26)[k], 2);
                for (int k = 0; k < WIDTH * HEIGHT * 4 && scaled != NULL; k++) {
                    int d = abs(scaled[k] - r.picture[k]);
                    worst = d > worst ? d : worst;
                    different += d > 2;
                }
                if (!CHECK(scaled != NULL && different <= 8))
                    say("      method %d, scale %d, poses %d: %d bytes differ, by up to %d\n", methods[m], scale[i], poses,
                        different, worst);
                s.draw[1].open_position = bent[0];
                s.draw[1].close_position = poses ? bent[1] : NULL;
                stage_draw(&r, &s);
                if (methods[m] != SMEAR_RECONSTRUCT)        /* which leaves short ways sharp */
                    CHECK(scaled == NULL || memcmp(scaled, r.picture, WIDTH * HEIGHT * 4) != 0);
                free(scaled);
            }
}

/* The square's upper edge at a time in frames, falling: positions of one and two frames ago tell where it is while the shutter
 * is open, as those of that moment do. */
static void bend_square(int16_t position[12], double time)
{
    for (int k = 0; k < 12; k++)
        position[k] = (int16_t)(square_position[k] + (k < 6 || k % 3 == 2 ? 0.0 : (k % 3 == 0 ? 32.0 : 16.0) * time * (8.0 + time)));
}

static void test_vertices_follow_the_curve_of_three_poses(void)
{
    static const uint8_t methods[] = { SMEAR_ACCUMULATE, SMEAR_SUBFRAMES, SMEAR_AUTO, SMEAR_TIMEMASK };
    static const double time[2][2] = { { -1, -2 }, { -0.25, 0.25 } };
    static int16_t bent[2][2][12];
    smear_desc desc = small_desc(WIDTH, HEIGHT);
    desc.methods = SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL;
    for (int i = 0; i < 4; i++)
        bend_square(bent[i / 2][i % 2], time[i / 2][i % 2]);
    for (int m = 0; m < 4; m++) {
        RIG(r, &desc, false);
        uint8_t *picture[2];
        for (int poses = 0; poses < 2; poses++) {
            struct stage s;
            stage_make(&s, methods[m], VERTICES);
            s.frame.samples = 16;
            s.frame.shutter.poses = (uint8_t)poses;
            s.draw[1].close = &s.square;
            s.draw[1].open_position = bent[poses][0];
            s.draw[1].close_position = bent[poses][1];
            picture[poses] = rig_copy(&r, &s.frame, s.draw, 2);
        }
        int different = 0;
        const bool have_both = CHECK(picture[0] != NULL && picture[1] != NULL);
        for (int k = 0; k < WIDTH * HEIGHT * 4 && have_both; k++)
            different += abs(picture[0][k] - picture[1][k]) > 2;
        if (!CHECK(different <= 8))
            say("      method %d: %d bytes differ\n", methods[m], different);
        free(picture[0]);
        free(picture[1]);
    }
}

/* ------------------------------------------------------------------ the shutter and the frame time */

/* Length of the motion from the square's streak in its middle row: the square, 16 px wide, covers the pixels between the
 * first and the last that it covers for an eighth of the exposure or longer; the ramps go on for an eighth of the way. */
static double streak_of(const struct rig *r)
{
    enum { EIGHTH = 99 };               /* sRGB code of 1/8 */
    const uint32_t *row = (const uint32_t *)(const void *)r->picture + HEIGHT / 2 * WIDTH;
    int first = -1, last = -1;
    for (int x = 0; x < WIDTH; x++)
        if ((row[x] & 255u) >= EIGHTH) {
            first = first < 0 ? x : first;
            last = x;
        }
    return (last - first + 1 - 16) / 0.75;
}

static void test_fixed_shutters_keep_the_length_of_streaks(void)
{
    static const uint32_t rate[] = { 144, 120, 60, 50, 30, 25, 24, 10 };
    static const uint8_t methods[] = { SMEAR_ACCUMULATE, SMEAR_SUBFRAMES, SMEAR_TIMEMASK, SMEAR_AUTO };
    struct stage s;
    smear_desc desc = small_desc(WIDTH, HEIGHT);
    desc.methods |= SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL;
    RIG(r, &desc, false);
    for (int m = 0; m < 4; m++)
        for (int mode = 0; mode < 4; mode++)
            for (int i = 0; i < 8; i++) {
                /* 1200 px per second: 20 px in the half of a frame at 30 Hz. */
                double way = 1200.0 / rate[i] / 8;
                stage_make(&s, methods[m], VERTICES);
                s.square_before.origin[0] = q16(-way);
                s.frame.samples = methods[m] == SMEAR_ACCUMULATE ? 128 : 32;
                s.frame.target = SMEAR_FINE;
                s.frame.clear = 0;
                s.frame.shutter.frame_us = (1000000 + rate[i] / 2) / rate[i];
                s.frame.shutter.mode = (uint8_t)(mode % 3);
                if (mode == 3)
                    s.frame.shutter.us = 16667;
                double want = mode == SMEAR_SHUTTER_FIXED || mode == 3 || (mode == SMEAR_SHUTTER_CAPPED && rate[i] < 30)
                            ? 20.0 : 600.0 / rate[i];
                /* Half of what it does in a frame at most: the square stays in sight. */
                s.square.origin[0] = 0;
                if (want > 36)
                    continue;
                CHECK_EQ(rig_frame(&r, &s.frame, &s.draw[1], 1), SMEAR_OK);
                if (!CHECK_CLOSE(streak_of(&r), want, 1.0 / 0.75 + 0.05 * want))
                    say("      method %d, mode %d, %u Hz: %g, not %g\n", methods[m], mode, (unsigned)rate[i],
                        streak_of(&r), want);
            }
    s.frame.shutter.frame_us = 0;               /* nobody knows */
    CHECK_EQ(smear_error_kind(rig_frame(&r, &s.frame, &s.draw[1], 1)), SMEAR_ERR_ARG);
    s.frame.shutter.us = 0;
    s.frame.shutter.mode = SMEAR_SHUTTER_FIXED + 1;
    CHECK_EQ(smear_error_kind(rig_frame(&r, &s.frame, &s.draw[1], 1)), SMEAR_ERR_ARG);
}

static void test_the_exposure_of_a_fixed_shutter_is_exact(void)
{
    static const uint32_t rate[] = { 144, 60, 30, 10, 7 };
    STAGE(r, s);
    for (int i = 0; i < 5; i++)
        for (int degrees = 5; degrees <= 360; degrees += 71) {
            stage_make(&s, SMEAR_RECONSTRUCT, VERTICES);
            s.square_before.origin[0] = q16(-600.0 / rate[i] / 8);
            s.frame.shutter.frame_us = 1000000 / rate[i];
            s.frame.shutter.mode = SMEAR_SHUTTER_FIXED;
            s.frame.shutter.degrees = (uint16_t)degrees;
            stage_draw(&r, &s);
            CHECK(of_square(&r)[0] > 0);
            CHECK_CLOSE(smear_probe(r.ctx).half_exposure / 16777216.0 * 2 / rate[i], degrees / 360.0 / 30, 1e-6 + degrees * 1e-7);
        }
}

/* Its x goes from 1 to -1, past 0 in the middle: it is in front of the wall all the time, though faces are wound the other way then. */
static void test_what_turns_inside_out_is_seen_before_and_after(void)
{
    static const struct { uint8_t method, samples; } by[] = {
        { SMEAR_ACCUMULATE, 32 }, { SMEAR_SUBFRAMES, 32 }, { SMEAR_TIMEMASK, 32 }, { SMEAR_AUTO, 0 }
    };
    smear_desc desc = small_desc(WIDTH, HEIGHT);
    desc.methods = SMEAR_SET(SMEAR_ACCUMULATE) | SMEAR_SET_TEMPORAL;
    RIG(r, &desc, false);
    for (int i = 0; i < (int)(sizeof by / sizeof *by); i++) {
        struct stage s;
        stage_make(&s, by[i].method, VERTICES);
        smear_transform close = s.square;
        s.material[1].double_sided = 0;
        s.square.basis[0] = 1 << 18;
        close.basis[0] = -close.basis[0];
        s.draw[1].close = &close;
        s.frame.samples = by[i].samples;
        s.frame.light_space = SMEAR_LIGHT_ENCODED;
        s.frame.shutter.poses = 1;
        REQUIRE(rig_frame(&r, &s.frame, s.draw, 2) == SMEAR_OK);
        const uint8_t red = r.picture[(HEIGHT / 2 * WIDTH + WIDTH / 2) * 4 + 2];
        if (!CHECK(red > 170)) /* of 200; the wall has 60 */
            say("      method %d: %d\n", by[i].method, red);
        rig_forget_output(&r);
    }
}

#include "build/suites/motion.h"
