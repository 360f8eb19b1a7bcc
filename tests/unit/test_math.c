/* SPDX-License-Identifier: MIT */
/* test_math.c - what is exact in smear_math.h: identities, edge cases, and the same bits on every core. Needs neither
 * libc nor floating point; test_math_error.c holds errors against double precision. */

/* As a core without a wide multiply computes, whatever the target: the first test compares the product itself. */
#define SMEAR_HAS_MUL64 0
#include <smear_matcap.h>
#include <smear_math.h>

#include "tests/random.h"
#include "tests/test.h"

enum { ONE = SMEAR_BASIS_ONE };

/* Of all magnitudes. */
static int32_t random_i32(void)
{
    const int32_t x = (int32_t)random_u32();
    return x >> random_u32() % 31u;
}

static smear_vec3 random_vec(void)
{
    const int32_t x = random_i32(), y = random_i32(), z = random_i32();
    return smear_vec(x, y, z);
}

static int32_t distance(int32_t a, int32_t b)
{
    return a < b ? b - a : a - b;
}

/* Largest difference of two bases. */
static int32_t basis_distance(const smear_transform *a, const smear_transform *b)
{
    int32_t largest = 0;
    for (int i = 0; i < 9; i++)
        if (distance(a->basis[i], b->basis[i]) > largest)
            largest = distance(a->basis[i], b->basis[i]);
    return largest;
}

static bool has_basis(smear_transform t, const int32_t basis[9])
{
    smear_transform want = SMEAR_IDENTITY;
    for (int i = 0; i < 9; i++)
        want.basis[i] = basis[i];
    return CHECK_EQ(basis_distance(&t, &want), 0);
}

static const int32_t identity[9] = { ONE, 0, 0, 0, ONE, 0, 0, 0, ONE };

/* Products of rows and of columns, from 0 or 1 by at most 2.5 steps of q24; and no reflection. */
static bool is_rotation(const smear_transform *t)
{
    const int32_t *m = t->basis;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int32_t *a = m + 3 * i, *b = m + 3 * j;
            const int64_t want = i == j ? (int64_t)1 << 48 : 0, slack = 5 << 23;
            if (!CHECK_NEAR((int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2], want, slack)
                || !CHECK_NEAR((int64_t)m[i] * m[j] + (int64_t)m[3 + i] * m[3 + j] + (int64_t)m[6 + i] * m[6 + j], want, slack))
                return false;
        }
    const int64_t cross = ((int64_t)m[0] * m[4] - (int64_t)m[1] * m[3]) >> 24;
    return CHECK_NEAR(cross, m[8], 4);
}

static uint32_t wide(uint32_t a, uint32_t b)
{
    return (uint32_t)(((uint64_t)a * b + 0x80000000u) >> 32);
}

static void test_products_are_rounded_alike_with_and_without_a_wide_multiply(void)
{
    static const uint32_t extreme[] = { 0, 1, 0x7fff, 0x8000, 0xffff, 0x10000, 0x7fffffff, 0x80000000, 0xffff8000, 0xffffffff };
    for (int i = 0; i < 10; i++)
        for (int j = 0; j < 10; j++)
            CHECK_EQ(smear_math_mulh(extreme[i], extreme[j]), wide(extreme[i], extreme[j]));
    for (int i = 0; i < 20000; i++) {
        const uint32_t a = random_u32(), b = random_u32();
        if (!CHECK_EQ(smear_math_mulh(a, b), wide(a, b))
            || !CHECK_EQ(smear_math_product((int32_t)a, (int32_t)b), ((int64_t)(int32_t)a * (int32_t)b + 0x80000000) >> 32))
            return;
    }
}

static void test_constants_are_rounded_to_nearest_and_may_initialise_what_is_static(void)
{
    static const int32_t lengths[] = { SMEAR_Q16(1.5), SMEAR_Q16(-1.5), SMEAR_Q16(3), SMEAR_Q16(0.1), SMEAR_Q16(-0.1) };
    static const int32_t factors[] = { SMEAR_Q24(1), SMEAR_Q24(-2.5), SMEAR_Q24(1.0 / 3) };
    static const uint32_t angles[] = { SMEAR_TURNS(0.25), SMEAR_TURNS(-0.25), SMEAR_TURNS(3), SMEAR_DEGREES(90), SMEAR_DEGREES(-450) };
    CHECK_EQ(lengths[0], 98304);
    CHECK_EQ(lengths[1], -98304);
    CHECK_EQ(lengths[2], 196608);
    CHECK_EQ(lengths[3], 6554);
    CHECK_EQ(lengths[4], -6554);
    CHECK_EQ(factors[0], ONE);
    CHECK_EQ(factors[1], -5 * ONE / 2);
    CHECK_EQ(factors[2], 5592405);
    CHECK_EQ(angles[0], 0x40000000u);
    CHECK_EQ(angles[1], 0xc0000000u);
    CHECK_EQ(angles[2], 0u);
    CHECK_EQ(angles[3], 0x40000000u);
    CHECK_EQ(angles[4], 0xc0000000u);
}

static void test_sines_are_exact_where_they_are_whole_or_a_half(void)
{
    static const int32_t quarter[5] = { 0, ONE, 0, -ONE, 0 };
    for (uint32_t i = 0; i < 4; i++) {
        CHECK_EQ(smear_sin(i << 30), quarter[i]);
        CHECK_EQ(smear_cos(i << 30), quarter[i + 1]);
    }
    CHECK_EQ(smear_sin(SMEAR_DEGREES(30)), ONE / 2);
    CHECK_EQ(smear_sin(SMEAR_DEGREES(210)), -ONE / 2);
    CHECK_EQ(smear_cos(SMEAR_DEGREES(60)), ONE / 2);
    CHECK_EQ(smear_cos(SMEAR_DEGREES(-120)), -ONE / 2);
}

static void test_sines_are_odd_and_cosines_even_and_neither_turns_back(void)
{
    int32_t last = -1;
    for (uint32_t angle = 0; angle <= 1u << 30; angle += 65521u) {
        const int32_t s = smear_sin(angle), c = smear_cos(angle);
        if (!CHECK(s >= last) || !CHECK_NEAR(smear_sin(0u - angle), -s, 1) || !CHECK_EQ(smear_sin(0x80000000u - angle), s)
            || !CHECK_EQ(smear_cos(0u - angle), c) || !CHECK_EQ(smear_sin(0x40000000u - angle), c)
            || !CHECK_NEAR((int64_t)s * s + (int64_t)c * c, (int64_t)1 << 48, 3 << 23))
            return;
        last = s;
    }
}

static void test_rotations_are_orthonormal(void)
{
    for (int i = 0; i < 4000; i++) {
        const uint32_t angle = random_u32();
        const smear_vec3 v = random_vec(), target = random_vec(), up = random_vec();
        const smear_transform turns[] = {
            smear_rotate_x(angle), smear_rotate_y(angle), smear_rotate_z(angle), smear_rotate_axis(v, angle),
            smear_from_euler(angle, random_u32(), random_u32()), smear_from_quaternion(v.x, v.y, v.z, random_i32()),
            smear_look_at(v, target, up)
        };
        for (int k = 0; k < 7; k++)
            END_UNLESS(is_rotation(&turns[k]));
    }
}

static void test_rotations_turn_counter_clockwise(void)
{
    static const int32_t x[9] = { ONE, 0, 0, 0, 0, -ONE, 0, ONE, 0 };
    static const int32_t y[9] = { 0, 0, ONE, 0, ONE, 0, -ONE, 0, 0 };
    static const int32_t z[9] = { 0, -ONE, 0, ONE, 0, 0, 0, 0, ONE };
    const uint32_t right = SMEAR_DEGREES(90);
    has_basis(smear_rotate_x(right), x);
    has_basis(smear_rotate_y(right), y);
    has_basis(smear_rotate_z(right), z);
    has_basis(smear_rotate_axis(smear_vec(7, 0, 0), right), x);
    has_basis(smear_rotate_axis(smear_vec(0, INT32_MAX, 0), right), y);
    has_basis(smear_rotate_axis(smear_vec(0, 0, INT32_MIN), 0u - right), z);
    has_basis(smear_from_euler(0, right, 0), x);
    has_basis(smear_from_euler(right, 0, 0), y);
    has_basis(smear_from_euler(0, 0, right), z);
    has_basis(smear_from_quaternion(23170, 0, 0, 23170), x);
    has_basis(smear_from_quaternion(0, -5, 0, -5), y);
    has_basis(smear_from_quaternion(0, 0, 1, 1), z);
}

static void test_an_axis_or_quaternion_of_nothing_turns_nothing(void)
{
    for (uint32_t i = 0; i < 8; i++)
        has_basis(smear_rotate_axis(smear_vec(0, 0, 0), i << 29 | i), identity);
    for (int i = 0; i < 1000; i++)
        has_basis(smear_rotate_axis(random_vec(), 0), identity);
    has_basis(smear_from_quaternion(0, 0, 0, 0), identity);
    has_basis(smear_from_quaternion(0, 0, 0, INT32_MIN), identity);
    has_basis(smear_from_euler(0, 0, 0), identity);
}

static void test_the_length_of_an_axis_or_quaternion_does_not_matter(void)
{
    for (int i = 0; i < 2000; i++) {
        const int32_t x = random_i32() >> 16, y = random_i32() >> 16, z = random_i32() >> 16, w = random_i32() >> 16;
        const int32_t by = 1 << random_u32() % 15u;
        const uint32_t angle = random_u32();
        const smear_transform a = smear_rotate_axis(smear_vec(x, y, z), angle);
        const smear_transform b = smear_rotate_axis(smear_vec(x * by, y * by, z * by), angle);
        const smear_transform c = smear_from_quaternion(x, y, z, w);
        const smear_transform d = smear_from_quaternion(-x * by, -y * by, -z * by, -w * by);
        if (!CHECK_EQ(basis_distance(&a, &b), 0) || !CHECK_EQ(basis_distance(&c, &d), 0))
            return;
    }
}

static void test_euler_angles_are_yaw_after_pitch_after_roll(void)
{
    for (int i = 0; i < 2000; i++) {
        const uint32_t yaw = random_u32(), pitch = random_u32(), roll = random_u32();
        const smear_transform got = smear_from_euler(yaw, pitch, roll);
        const smear_transform want = smear_compose(smear_rotate_y(yaw), smear_compose(smear_rotate_x(pitch), smear_rotate_z(roll)));
        REQUIRE(basis_distance(&got, &want) <= 3);
    }
}

static void test_compose_does_first_the_second_then_the_first(void)
{
    const smear_transform move = smear_move(SMEAR_Q16(1), SMEAR_Q16(2), SMEAR_Q16(-3));
    const smear_transform turn = smear_rotate_z(SMEAR_DEGREES(90)), scale = smear_scale(SMEAR_Q24(2), SMEAR_Q24(-1), SMEAR_Q24(0.5));
    const smear_vec3 p = smear_vec(SMEAR_Q16(10), SMEAR_Q16(20), SMEAR_Q16(30));
    const smear_vec3 q = smear_apply(smear_compose(move, smear_compose(turn, scale)), p);
    CHECK_EQ(q.x, SMEAR_Q16(1 + 20));
    CHECK_EQ(q.y, SMEAR_Q16(2 + 20));
    CHECK_EQ(q.z, SMEAR_Q16(-3 + 15));
    for (int i = 0; i < 2000; i++) {
        const smear_vec3 place = random_vec(), by = random_vec();
        const smear_transform t = smear_compose(smear_move(place.x, place.y, place.z), smear_from_euler(random_u32(), random_u32(), 0));
        const smear_transform same = SMEAR_IDENTITY, a = smear_compose(same, t), b = smear_compose(t, same);
        const smear_transform moved = smear_compose(smear_move(by.x >> 1, by.y >> 1, by.z >> 1),
                                                    smear_move(place.x >> 1, place.y >> 1, place.z >> 1));
        if (!CHECK_EQ(basis_distance(&a, &t), 0) || !CHECK_EQ(basis_distance(&b, &t), 0) || !CHECK_EQ(a.origin[0], place.x)
            || !CHECK_EQ(b.origin[2], place.z) || !CHECK_EQ(moved.origin[1], (by.y >> 1) + (place.y >> 1)))
            return;
    }
}

static void test_what_does_not_fit_is_clamped(void)
{
    const int32_t most = INT32_MAX, least = INT32_MIN;
    smear_transform wild = { { least, least, least, most, most, most, least, most, least }, { least, most, least } };
    const smear_transform square = smear_compose(wild, wild);
    CHECK_EQ(square.basis[0], most);
    CHECK_EQ(square.basis[3], -most);
    CHECK_EQ(square.origin[0], most);
    CHECK_EQ(smear_apply(wild, smear_vec(most, most, most)).x, -most);
    CHECK_EQ(smear_compose(smear_move(most, least, 5), smear_move(most, least, 5)).origin[0], most);
    CHECK_EQ(smear_compose(smear_move(most, least, 5), smear_move(most, least, 5)).origin[1], -most);
    CHECK_EQ(smear_inverse_rigid(smear_move(least, most, 0)).origin[0], most);
}

static void test_an_inverse_undoes_a_rigid_transform(void)
{
    for (int i = 0; i < 2000; i++) {
        const smear_vec3 place = smear_vec(random_i32() >> 2, random_i32() >> 2, random_i32() >> 2);
        const smear_transform t = smear_compose(smear_move(place.x, place.y, place.z),
                                                smear_rotate_axis(random_vec(), random_u32()));
        const smear_transform one = smear_compose(smear_inverse_rigid(t), t);
        const smear_transform none = SMEAR_IDENTITY;
        REQUIRE(basis_distance(&one, &none) <= 3);
        /* The origins are up to 2^29 x sqrt(3), and the basis off by 2.5 / 2^24: 140 steps. */
        for (int k = 0; k < 3; k++)
            REQUIRE_NEAR(one.origin[k], 0, 140);
    }
}

static void test_cameras_look_at_their_target(void)
{
    static const int32_t down[9] = { ONE, 0, 0, 0, 0, ONE, 0, -ONE, 0 };
    static const int32_t up[9] = { -ONE, 0, 0, 0, 0, -ONE, 0, -ONE, 0 };
    static const int32_t left[9] = { 0, 0, ONE, 0, ONE, 0, -ONE, 0, 0 };
    const smear_vec3 zero = smear_vec(0, 0, 0), y = smear_vec(0, 1, 0), z = smear_vec(0, 0, -9);
    const int32_t far = INT32_MAX;
    has_basis(smear_look_at(smear_vec(0, 0, 5), zero, y), identity);
    has_basis(smear_look_at(smear_vec(5, 0, 0), zero, y), left);
    has_basis(smear_look_at(smear_vec(0, 1, 0), zero, smear_vec(0, 0, -1)), down);
    has_basis(smear_look_at(smear_vec(0, 0, far), smear_vec(0, 0, -far), y), identity);
    /* Without a direction: along -Z. Without an up, or with one along the view: -Z, or +Y. */
    has_basis(smear_look_at(smear_vec(3, 4, 5), smear_vec(3, 4, 5), y), identity);
    has_basis(smear_look_at(zero, zero, zero), identity);
    has_basis(smear_look_at(zero, zero, z), identity);
    has_basis(smear_look_at(smear_vec(0, far, 0), zero, y), down);
    has_basis(smear_look_at(smear_vec(0, far, 0), zero, zero), down);
    has_basis(smear_look_at(smear_vec(0, -far, 0), zero, y), up);
    has_basis(smear_look_at(smear_vec(0, 0, far), zero, zero), identity);
    CHECK_EQ(smear_look_at(smear_vec(3, 4, 5), zero, y).origin[1], 4);
    for (int i = 0; i < 2000; i++) {
        const smear_vec3 eye = random_vec(), target = random_vec();
        const smear_transform t = smear_look_at(eye, target, y);
        if (!CHECK_NEAR(t.basis[3], 0, 16) || !CHECK(t.basis[4] >= -16))     /* no roll, and not upside down */
            return;
    }
}

static void test_focal_lengths_are_exact_or_clamped(void)
{
    CHECK_EQ(smear_focal_from_fov(SMEAR_DEGREES(90)), 65536);
    CHECK_EQ(smear_focal_from_fov(SMEAR_DEGREES(60)), 113512);
    CHECK_NEAR(smear_focal_from_fov(SMEAR_DEGREES(1)), 7509682, 1);
    CHECK_EQ(smear_focal_from_fov(0), INT32_MAX);
    CHECK_EQ(smear_focal_from_fov(1), INT32_MAX);
    CHECK_EQ(smear_focal_from_fov(SMEAR_TURNS(0.5) - 1), 1);
    CHECK_EQ(smear_focal_from_fov(SMEAR_TURNS(0.5)), 1);
    CHECK_EQ(smear_focal_from_fov(UINT32_MAX), 1);
    int32_t last = INT32_MAX;
    for (uint32_t fov = 0; fov < 0xff000000u; fov += 1u << 17) {
        const int32_t focal = smear_focal_from_fov(fov);
        if (!CHECK(focal <= last) || !CHECK(focal > 0))
            return;
        last = focal;
    }
    const smear_camera camera = smear_perspective(SMEAR_DEGREES(90), 7, 9);
    CHECK(camera.focal == 65536 && camera.near_plane == 7 && camera.far_plane == 9 && camera.half_height == 0);
    has_basis(camera.pose, identity);
}

static uint32_t mixed(uint32_t hash, const smear_transform *t)
{
    for (int i = 0; i < 9; i++)
        hash = (hash ^ (uint32_t)t->basis[i]) * 16777619u;
    for (int i = 0; i < 3; i++)
        hash = (hash ^ (uint32_t)t->origin[i]) * 16777619u;
    return hash;
}

static void test_all_machines_have_the_same_bits(void)
{
    uint32_t hash = 2166136261u;
    random_state = 1;
    for (int i = 0; i < 1000; i++) {
        const uint32_t yaw = random_u32(), pitch = random_u32();
        const smear_vec3 a = random_vec(), b = random_vec();
        const smear_transform look = smear_look_at(a, b, smear_vec(0, 1, 0)), euler = smear_from_euler(yaw, pitch, yaw - pitch);
        const smear_transform axis = smear_rotate_axis(b, pitch), quaternion = smear_from_quaternion(a.x, b.x, a.y, b.y);
        const smear_transform all = smear_compose(smear_compose(look, euler), smear_inverse_rigid(smear_compose(axis, quaternion)));
        hash = mixed(mixed(mixed(hash, &look), &euler), &all);
        hash = (hash ^ (uint32_t)smear_focal_from_fov(yaw)) * 16777619u;
    }
    CHECK_EQ(hash, 2698374490u);
}

/* Poses of any size, mirrored ones and those that are scaled unevenly among them. */
static void test_matcaps_have_the_same_bits(void)
{
    uint32_t hash = 2166136261u;
    random_state = 2;
    for (int i = 0; i < 1000; i++) {
        int8_t normal[3];
        int16_t uv[2] = { 0, 0 };
        const smear_mesh mesh = { .normal = normal, .vertex_count = 1 };
        smear_camera camera = smear_perspective(SMEAR_DEGREES(60), 1, 0);
        uint32_t angle[6];              /* in an order that compilers do not choose */
        for (int k = 0; k < 6; k++)
            angle[k] = random_u32();
        camera.pose = smear_from_euler(angle[0], angle[1], angle[2]);
        camera.half_height = i % 5 == 4 ? 65536 : 0;
        smear_transform place = smear_from_euler(angle[3], angle[4], angle[5]);
        for (int k = 0; k < 3; k++) {
            normal[k] = (int8_t)(random_u32() % 147 - 73);
            place.origin[k] = (int32_t)random_u32() >> 8;
            for (int j = 0; i % 3 == 1 && j < 3; j++)
                place.basis[3 * k + j] = (place.basis[3 * k + j] >> (j + i % 7)) * (j == i % 4 ? -1 : 1);
        }
        smear_matcap_uv(uv, &mesh, &place, &camera);
        hash = (hash ^ (uint16_t)uv[0]) * 16777619u;
        hash = (hash ^ (uint16_t)uv[1]) * 16777619u;
    }
    CHECK_EQ(hash, 1027009600u);
}

#include "build/suites/math.h"
