/* SPDX-License-Identifier: MIT */
/* test_rooms.c - rooms of a few large textured squares around a camera that goes in a circle, falls or turns, or goes fast around them
 * outside: the default method is near the mean of exact instants, and lines take as many pictures as a coarser target asks for, or give
 * way. SMEAR_CASES=1000 draws as many; SMEAR_FIRST=17 begins with that one, and names those far off. */
#include "tests/ref/sweep.h"

enum { WIDTH = 120, ROWS = 90, BYTES = WIDTH * ROWS * 4, SIDES = 6, TEXELS = 32 };

enum kind { ORBIT, FALL, TURN, INSIDE, OUTSIDE = INSIDE, KINDS };

static const char *const kind_name[KINDS] = { "orbit", "fall", "turn", "outside" };

/* A case: lengths in units, angles in radians, speed in units or radians in the whole exposure. */
struct visit {
    enum kind kind;
    double speed, yaw, pitch, radius, x, y, z;
    int repeats;
};

static uint32_t texels[TEXELS * TEXELS];

static struct visit random_visit(bool outside)
{
    struct visit v = { .kind = outside ? OUTSIDE : (enum kind)(random_u32() % INSIDE) };
    v.repeats = outside ? between(0, 1) : between(1, 4);
    v.yaw = uniform(-3.1, 3.1);
    v.radius = uniform(1, 4);
    v.pitch = v.kind == FALL ? uniform(-1.4, -0.6) : uniform(-0.5, 0.2);
    v.speed = v.kind == FALL ? uniform(0.05, 1) : uniform(0.01, 0.3);
    v.x = uniform(-3, 3);
    v.y = uniform(0.5, 3.5);
    v.z = uniform(-3, 3);
    if (outside) {
        v.radius = uniform(10, 40);
        v.pitch = uniform(-0.5, -0.1);
        v.speed = exp(uniform(-3, 0.6));
    }
    const int block = 1 << between(1, 3);
    for (int i = 0; i < TEXELS; i++)
        for (int j = 0; j < TEXELS; j++)
            texels[TEXELS * i + j] = i % block == 0 && j % block == 0 ? 0xff000000u | random_u32()
                                                                      : texels[TEXELS * (i - i % block) + j - j % block];
    return v;
}

/* The camera where `part` of the exposure's way is behind it: -0.5 at open, 0.5 at close. */
static smear_camera camera_of(const struct visit *v, double part)
{
    const double way = v->speed * part, yaw = v->yaw + (v->kind == FALL ? 0 : way);
    double x = v->x, y = v->y, z = v->z;
    if (v->kind == ORBIT || v->kind == OUTSIDE) {       /* around the middle of the room, towards which it looks */
        x = sin(yaw) * v->radius;
        y = v->kind == ORBIT ? y : 2 - v->radius * tan(v->pitch);
        z = cos(yaw) * v->radius;
    } else if (v->kind == FALL) {
        y -= way + way * way / 4;
    }
    smear_camera c = { .pose = pose_at(x, y, z, yaw, v->pitch), .focal = 65536 * 5 / 4, .near_plane = 6554, .far_plane = 100 * 65536 };
    return c;
}

static bool draw(struct rig *r, const void *scene, uint8_t method, uint16_t target, double part)
{
    /* Floor, ceiling and walls of a room of 10 x 4 x 10 units, a 256th of one a step. */
    static const int16_t corner[8][3] = { { -1280, 0, -1280 }, { 1280, 0, -1280 }, { 1280, 0, 1280 }, { -1280, 0, 1280 },
                                          { -1280, 1024, -1280 }, { 1280, 1024, -1280 }, { 1280, 1024, 1280 }, { -1280, 1024, 1280 } };
    static const uint8_t side[SIDES][4] = { { 0, 1, 2, 3 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 },
                                            { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 } };
    static const smear_texture texture = { .texels = texels, .width = TEXELS, .height = TEXELS };
    static const smear_transform still = SMEAR_IDENTITY;
    const smear_material material = { .texture = &texture, .unlit = 1, .double_sided = 1 };
    const struct visit *v = scene;
    int16_t position[SIDES][12], uv[SIDES][8];
    smear_mesh mesh[SIDES];
    smear_draw draws[SIDES];
    for (int s = 0; s < SIDES; s++) {
        for (int k = 0; k < 4; k++) {
            for (int j = 0; j < 3; j++)
                position[s][3 * k + j] = corner[side[s][k]][j];
            uv[s][2 * k] = (int16_t)(v->repeats == 0 ? s * 1024 / SIDES : k == 1 || k == 2 ? v->repeats * 1024 : 0);    /* or one texel */
            uv[s][2 * k + 1] = (int16_t)(k >= 2 ? v->repeats * 1024 : 0);
        }
        mesh[s] = (smear_mesh){ .position = position[s], .uv = uv[s], .vertex_count = 4, .index = square_index, .triangle_count = 2,
                                .shift = 8, .uv_shift = 10 };
        draws[s] = (smear_draw){ .id = 1 + (uint32_t)s, .mesh = &mesh[s], .material = &material, .now = &still };
    }
    const bool sharp = method == SMEAR_NONE;
    const smear_camera now = camera_of(v, sharp ? part : 0), open = camera_of(v, -0.5), close = camera_of(v, 0.5);
    const smear_frame frame = { .camera = &now, .open = sharp ? NULL : &open, .close = sharp ? NULL : &close, .method = method,
                                .light_space = SMEAR_LIGHT_ENCODED, .cut = sharp, .shutter = { .poses = 1 }, .target = target };
    return CHECK_EQ(rig_frame(r, &frame, draws, SIDES), SMEAR_OK);
}

/* Finds by how many codes the blurred picture is off the exact mean, and the sharp one of the middle. */
static bool measure(double *error, double *unblurred, struct rig *r, const struct visit *v, uint16_t target)
{
    static double mean[BYTES];
    if (!sweep_mean(mean, r, draw, v, 256, false) || !draw(r, v, SMEAR_NONE, 0, 0))     /* means of 64 are half a code off themselves */
        return false;
    *unblurred = sweep_error(r, mean);
    if (!draw(r, v, SMEAR_AUTO, target, 0))
        return false;
    *error = sweep_error(r, mean);
    return true;
}

/* Checks how far nine of ten rooms of a target are from the exact mean, and all, none farther than a sharp frame and a code; they are
 * drawn without lines before and after. */
static void check_target(bool outside, uint16_t target, uint16_t methods, double most_of_nine, double most)
{
    static double error[SWEEP_MOST];
    double sharp = 0, farther = 0;
    const struct sweep sweep = sweep_of(100, 1000);
    smear_desc desc = small_desc(WIDTH, ROWS);
    desc.methods = SMEAR_SET(SMEAR_AUTO) | methods;
    RIG(r, &desc, false);
    for (uint32_t i = 0; i < sweep.count; i++) {
        sweep_seed(sweep.first + i);
        const struct visit v = random_visit(outside);
        END_UNLESS(measure(&error[i], &sharp, &r, &v, target));
        farther = fmax(farther, error[i] - sharp);
        if (sweep.tells && (error[i] > most * 0.8 || error[i] > sharp + 1))
            printf("  %.2f codes, sharp %.2f: case %u: %s speed %.3f yaw %.2f pitch %.2f radius %.1f at %.1f %.1f %.1f repeats %d\n",
                   error[i], sharp, (unsigned)(sweep.first + i), kind_name[v.kind], v.speed, v.yaw, v.pitch, v.radius, v.x, v.y, v.z,
                   v.repeats);
    }
    sweep_check(error, sweep.count, "textured rooms off the exact mean", most_of_nine, most);
    printf("    farther off than sharp ones: %.2f\n", farther);
    CHECK(farther <= 1);
}

static void test_nine_of_ten_textured_rooms_are_near_the_exact_mean(void)
{
    check_target(false, SMEAR_BALANCED, 0, 1.9, 3);
}

/* Hard texels of a pixel or two, as these rooms have, are what lines show worst. */
static void test_drafts_and_sketches_of_them_have_as_many_pictures_as_they_need(void)
{
    check_target(false, SMEAR_DRAFT, SMEAR_SET_SKETCH, 7, 12);
    check_target(false, SMEAR_SKETCH, SMEAR_SET_SKETCH, 16, 24);
}

static void test_drafts_and_sketches_of_what_a_camera_goes_around_are_no_farther_off_than_sharp(void)
{
    check_target(true, SMEAR_DRAFT, SMEAR_SET_SKETCH, 5, 12);
    check_target(true, SMEAR_SKETCH, SMEAR_SET_SKETCH, 8, 18);
}

#include "build/suites/rooms.h"
