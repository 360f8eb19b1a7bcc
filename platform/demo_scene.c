/* SPDX-License-Identifier: MIT */
/* demo_scene.c - see demo_scene.h. Two shots: the camera drives ahead of the car and looks back;
 * then it stands beside the road, where a drone hovers and the car rushes by. */
#include "platform/demo_scene.h"

#define METRES(x) ((int32_t)((x) * 65536.0))    /* of constants only */
#define DEGREES(x) ((int32_t)((x) * 65536.0 / 360.0))

/* Angles: 1/65536 turn. */
enum {
    WHEEL_STEP = 13107,             /* per frame: a fifth of a turn */
    CAR_STEP = 37060,               /* per frame: as much of the wheel's girth, 2 pi 0.45 m */
    ROTOR_STEP = 14500,
    CHASE = 20, ROADSIDE = DEMO_LOOP - CHASE    /* frames of the two shots */
};

/* ------------------------------------------------------------------ angles */

/* floor(a b / 2^30) of unsigned factors. */
static uint32_t times_q30(uint32_t a, uint32_t b)
{
    return (uint32_t)((uint64_t)a * b >> 30);
}

/* Sine of an angle, q24. On the first quadrant x - x^3/3! + ... - x^11/11!, by Horner's rule in
 * q30; the error stays within two steps of q24. */
static int32_t sine(int32_t angle)
{
    static const uint32_t inverse[5] = {    /* q30: 1/(2*3), 1/(4*5), 1/(6*7), 1/(8*9), 1/(10*11) */
        178956971, 53687091, 25565282, 14913081, 9761289
    };
    uint32_t turn = (uint32_t)angle & 0xffffu, in = turn & 0x3fffu;
    if (turn & 0x4000u)
        in = 0x4000u - in;
    const uint32_t x = (uint32_t)((uint64_t)in * 421657428 >> 12);      /* pi/2 in q28 / 2^14, then q30 */
    const uint32_t square = times_q30(x, x);
    uint32_t sum = 1u << 30;
    for (int i = 4; i >= 0; i--)
        sum = (1u << 30) - times_q30(times_q30(square, inverse[i]), sum);
    const int32_t result = (int32_t)((times_q30(x, sum) + 32) >> 6);
    return turn & 0x8000u ? -result : result;
}

static int32_t cosine(int32_t angle)
{
    return sine(angle + 0x4000);
}

/* Sine and cosine of an angle: what is turned by it needs both. */
struct angle {
    int32_t sine, cosine;
};

static struct angle angle_of(int32_t angle)
{
    return (struct angle){ sine(angle), cosine(angle) };
}

static struct angle opposite(struct angle a)
{
    return (struct angle){ -a.sine, a.cosine };
}

/* A quarter of a turn farther. */
static struct angle quarter_after(struct angle a)
{
    return (struct angle){ a.cosine, -a.sine };
}

/* a x b, b in q24; |a| < 2^30, |b| < 2^25. */
static int32_t scaled(int32_t a, int32_t b)
{
#ifdef __ARM_ARCH_6M__          /* has no product of 64 bits: of halves of 16 */
    const int32_t a_high = a >> 16, a_low = a & 0xffff, b_high = b >> 16, b_low = b & 0xffff;
    const int32_t middle = a_high * b_low + a_low * b_high + (int32_t)((uint32_t)a_low * (uint32_t)b_low >> 16);
    return a_high * b_high * 256 + (middle >> 8);
#else
    return (int32_t)((int64_t)a * b >> 24);
#endif
}

/* ------------------------------------------------------------------ poses */

static const smear_transform identity = SMEAR_IDENTITY;

/* What `step` per frame comes to at a time. */
static int32_t along(int32_t time, int32_t step)
{
    return time * step / DEMO_TIME;
}

/* Goes on from the pose along its own axes. */
static void move(smear_transform *pose, int32_t x, int32_t y, int32_t z)
{
    for (int row = 0; row < 3; row++) {
        const int32_t *basis = pose->basis + 3 * row;
        pose->origin[row] += scaled(x, basis[0]) + scaled(y, basis[1]) + scaled(z, basis[2]);
    }
}

/* Turns the pose about its own axis x, y or z (0, 1, 2), counter-clockwise seen from its tip. */
static void turn(smear_transform *pose, int axis, struct angle by)
{
    const int first = axis == 2 ? 0 : axis + 1, second = axis == 0 ? 2 : axis - 1;
    for (int row = 0; row < 3; row++) {
        int32_t *basis = pose->basis + 3 * row, u = basis[first], v = basis[second];
        basis[first] = scaled(u, by.cosine) + scaled(v, by.sine);
        basis[second] = scaled(v, by.cosine) - scaled(u, by.sine);
    }
}

static smear_transform moved(int32_t x, int32_t y, int32_t z)
{
    smear_transform pose = identity;
    move(&pose, x, y, z);
    return pose;
}

/* ------------------------------------------------------------------ props */

static void add(struct demo_scene *out, enum demo_prop prop,
                const smear_transform *pose)
{
    int i = out->draw_count++;
    out->prop[i] = (uint8_t)prop;
    out->pose[i] = *pose;
}

static void add_car(struct demo_scene *out, const smear_transform *car,
                    int32_t time, struct angle steer)
{
    static const int32_t hub[4][2] = {
        { METRES(1.38), METRES(0.80) }, { METRES(1.38), METRES(-0.80) },
        { METRES(-1.32), METRES(0.80) }, { METRES(-1.32), METRES(-0.80) },
    };
    const struct angle spin = angle_of(-along(time, WHEEL_STEP)), outwards = angle_of(DEGREES(90));
    add(out, PROP_CAR, car);
    for (int i = 0; i < 4; i++) {
        smear_transform wheel = *car;
        move(&wheel, hub[i][0], METRES(0.45), hub[i][1]);
        if (i < 2)
            turn(&wheel, 1, steer);
        turn(&wheel, 2, spin);
        turn(&wheel, 0, hub[i][1] > 0 ? outwards : opposite(outwards));
        add(out, PROP_WHEEL, &wheel);
    }
    smear_transform shadow = *car;
    shadow.origin[1] = METRES(0.015);
    add(out, PROP_SHADOW, &shadow);
}

static void add_drone(struct demo_scene *out,
                      const smear_transform *drone, int32_t time)
{
    struct angle arm = angle_of(DEGREES(45)), spin = angle_of(along(time, ROTOR_STEP));
    add(out, PROP_DRONE, drone);
    for (int i = 0; i < 4; i++, arm = quarter_after(arm), spin = opposite(spin)) {
        smear_transform rotor = *drone;
        turn(&rotor, 1, arm);
        move(&rotor, METRES(0.70), METRES(0.10), 0);
        turn(&rotor, 1, spin);
        add(out, PROP_ROTOR, &rotor);
    }
}

/* What stands still; the hills stay around the eye. */
static void add_land(struct demo_scene *out)
{
    static const uint8_t land[] = { PROP_BOARDS, PROP_KERBS, PROP_ROAD, PROP_TREES, PROP_GRASS };
    for (unsigned i = 0; i < sizeof land / sizeof *land; i++)
        add(out, (enum demo_prop)land[i], &identity);
    smear_transform hills = moved(out->camera.pose.origin[0], 0, out->camera.pose.origin[2]);
    add(out, PROP_HILLS, &hills);
}

static void look(struct demo_scene *out, int32_t x, int32_t y, int32_t z, int32_t yaw,
                 int32_t pitch)
{
    out->camera = (smear_camera){ .pose = SMEAR_IDENTITY, .focal = METRES(2.4),
                                  .near_plane = METRES(0.3), .far_plane = METRES(150) };
    move(&out->camera.pose, x, y, z);
    turn(&out->camera.pose, 1, angle_of(yaw));
    turn(&out->camera.pose, 0, angle_of(pitch));
}

/* ------------------------------------------------------------------ shots */

static void chase(struct demo_scene *out, int32_t time)
{
    int32_t phase = time * (65536 / DEMO_TIME) / CHASE;
    int32_t x = METRES(-6) + along(time, CAR_STEP), sway = sine(phase), lead = cosine(phase);
    look(out, x + METRES(3.7) + scaled(METRES(0.12), sway), METRES(1.5), METRES(4.6), DEGREES(42),
         DEGREES(-2.5));

    int32_t yaw = scaled(DEGREES(2), lead);
    smear_transform car = moved(x, 0, METRES(-0.2) - scaled(METRES(0.12), sway));
    turn(&car, 1, angle_of(yaw));
    add_car(out, &car, time, angle_of(2 * yaw));

    smear_transform drone = moved(x - METRES(1.9) + scaled(METRES(0.3), lead),
                                  METRES(2.5) + scaled(METRES(0.16), sine(2 * phase)),
                                  METRES(0.3) + scaled(METRES(0.6), sway));
    turn(&drone, 0, angle_of(DEGREES(18)));
    turn(&drone, 2, angle_of(DEGREES(-20)));
    add_drone(out, &drone, time);
    add_land(out);
}

static void roadside(struct demo_scene *out, int32_t time)
{
    int32_t phase = time * (65536 / DEMO_TIME) / ROADSIDE, swing = sine(phase);
    look(out, METRES(1.2), METRES(1.6), METRES(5.2), DEGREES(16.7), DEGREES(2));

    smear_transform drone = moved(METRES(-0.25) + scaled(METRES(1.1), swing),
                                  METRES(2.6) + scaled(METRES(0.2), sine(2 * phase)),
                                  METRES(0.6) - scaled(METRES(0.4), cosine(phase)));
    turn(&drone, 0, angle_of(DEGREES(24)));
    turn(&drone, 2, angle_of(scaled(DEGREES(17), swing)));
    add_drone(out, &drone, time);

    smear_transform car = moved(along(time - ROADSIDE / 2 * DEMO_TIME, CAR_STEP), 0, METRES(-1.6));
    add_car(out, &car, time, angle_of(0));
    add_land(out);
}

void demo_scene_pose_at(struct demo_scene *out, int32_t time)
{
    const int32_t second = CHASE * DEMO_TIME;
    out->cut = time == 0 || time == second;
    out->draw_count = 0;
    if (time < second)
        chase(out, time);
    else
        roadside(out, time - second);
}

void demo_scene_pose(struct demo_scene *out, uint32_t frame)
{
    demo_scene_pose_at(out, (int32_t)(frame % DEMO_LOOP) * DEMO_TIME);
}

smear_draw demo_scene_draw(const struct demo_scene *scene, const smear_draw *props, int i)
{
    const smear_draw *prop = &props[scene->prop[i]];
    return (smear_draw){ .id = (uint32_t)i + 1, .mesh = prop->mesh, .material = prop->material, .now = &scene->pose[i] };
}
