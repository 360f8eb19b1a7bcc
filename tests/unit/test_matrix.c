/* SPDX-License-Identifier: MIT */
/* test_matrix.c - the rows of a projection: bounded for any input whatever, planes at their
 * distances, and sums of poses against the same sums in double precision. Host only. */
#include "geometry/matrix.h"

#include "geometry/transform.h"
#include "tests/rig.h"

static int32_t wild(void)
{
    static const int32_t value[] = { INT32_MAX, INT32_MIN, 1, -1, 0, 1 << 24, -(1 << 24), 65536 };
    uint32_t kind = random_u32() % 3u, kind_shift = random_u32() % 32u;
    return kind == 0 ? value[random_u32() & 7u] : kind == 1 ? between(INT32_MIN, INT32_MAX)
                                                            : (int32_t)random_u32() >> kind_shift;
}

static int32_t wild_positive(void)
{
    int32_t v = wild();
    return v == INT32_MIN ? INT32_MAX : v < 0 ? -v : v == 0 ? 1 : v;
}

/* A camera as smear_begin lets it through, otherwise wild. */
static smear_camera wild_camera(void)
{
    smear_camera c = { .focal = wild_positive(), .near_plane = wild_positive() };
    for (int i = 0; i < 9; i++)
        c.pose.basis[i] = between(-2 * SMEAR_BASIS_ONE, 2 * SMEAR_BASIS_ONE);
    for (int i = 0; i < 3; i++)
        c.pose.origin[i] = wild();
    if (c.near_plane == INT32_MAX)
        c.near_plane--;
    c.far_plane = random_u32() & 1u ? 0 : between(c.near_plane + 1, INT32_MAX);
    if (random_u32() % 3u == 0) {
        c.half_height = wild_positive();
        c.far_plane = between(c.near_plane + 1, INT32_MAX);
    }
    return c;
}

/* The largest |row| over all int16 vertices: each term is floored on its own. */
static int64_t row_bound(const int32_t m[4])
{
    int64_t sum = m[3] < 0 ? -(int64_t)m[3] : m[3];
    for (int j = 0; j < 3; j++)
        sum += ((m[j] < 0 ? -(int64_t)m[j] : m[j]) * 32768 >> 16) + 1;
    return sum;
}

static void test_planes_lie_at_their_distances(void)
{
    random_state = 3;
    for (int n = 0; n < 500; n++) {
        smear_transform object = SMEAR_IDENTITY;
        smear_mesh mesh = { .shift = 8 };
        smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = between(655, 65536) };
        object.origin[2] = -between(65536, 50 * 65536);
        camera.far_plane = between(2 * 65536, 1000 * 65536);
        camera.half_height = n & 1 ? 65536 : 0;
        struct smear_view view;
        struct smear_projection p;
        smear_view_compose(&view, &object, &mesh, &camera.pose);
        smear_projection_make(&p, &view, &camera, 240, 0);
        double unit = ldexp(1, p.distance_scale);
        CHECK_CLOSE(p.depths.near_distance, camera.near_plane / 65536.0 * unit, 1);
        double far = camera.far_plane / 65536.0 * unit;
        CHECK_CLOSE(p.depths.far_distance, fmin(far, INT32_MAX), 1);
        /* The object's origin, in the same units. */
        const int16_t zero[3] = { 0, 0, 0 };
        struct smear_homogeneous h;
        smear_transform_vertex(&h, &p, zero);
        CHECK_CLOSE(h.distance, -object.origin[2] / 65536.0 * unit, 2);
    }
    smear_camera open_end = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 65536 };
    smear_transform object = SMEAR_IDENTITY;
    smear_mesh mesh = { .shift = 8 };
    struct smear_view view;
    struct smear_projection p;
    smear_view_compose(&view, &object, &mesh, &open_end.pose);
    smear_projection_make(&p, &view, &open_end, 240, 0);
    CHECK_EQ(p.depths.far_distance, INT32_MAX);
}

/* ------------------------------------------------------------------ sums of poses */

/* Clip position: x and y in pixels x w, w, and the distance. */
static void clip_exactly(double out[4], const smear_mesh *mesh, const smear_transform *object,
                         const smear_camera *camera, int height, const int16_t v[3])
{
    double view[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        double world = object->origin[i] / 65536.0 - camera->pose.origin[i] / 65536.0;
        for (int j = 0; j < 3; j++)
            world += object->basis[3 * i + j] / 16777216.0 * ldexp(v[j], -mesh->shift);
        for (int j = 0; j < 3; j++)
            view[j] += camera->pose.basis[3 * i + j] / 16777216.0 * world;
    }
    double pixels = camera->half_height > 0 ? height / (2 * (camera->half_height / 65536.0))
                                            : camera->focal / 65536.0 * height / 2;
    out[0] = view[0] * pixels;
    out[1] = -view[1] * pixels;
    out[2] = camera->half_height > 0 ? 1 : -view[2];
    out[3] = -view[2];
}

/* Weighs projections in their places: those of the first one's vertices are added to it. */
static void weigh(struct smear_projection p[], const int32_t weight[], const int16_t *const position[], int count,
                  const smear_camera *camera)
{
    const struct smear_projection copy[3] = { p[0], p[1], p[count - 1] }, *const in[3] = { &copy[0], &copy[1], &copy[2] };
    struct smear_projection *out[3] = { NULL, NULL, NULL };
    for (int k = 0; k < count; k++)
        out[k] = position != NULL && position[k] == position[0] ? &p[0] : &p[k];
    smear_projection_weigh(out, in, weight, count, camera);
    for (int k = 1; k < count; k++)
        p[k] = *out[k];
}

/* Instants between and beyond poses. `apart`: each pose has vertices of its own. */
static double worst_sum(bool orthographic, bool apart)
{
    double worst = 0;
    for (int n = 0; n < 600; n++) {
        const int count = between(2, 3), coarse = n % 3 == 2 ? projection_coarse(240, orthographic) : 0;
        static const int16_t here[3], there[2][3];
        const int16_t *const position[3] = { here, apart ? there[0] : here, apart ? there[1] : here };
        smear_mesh mesh = { .shift = 14 };
        smear_camera camera[3];
        smear_transform object[3];
        struct smear_projection p[3];
        for (int k = 0; k < count; k++) {
            camera[k] = (smear_camera){ .pose = SMEAR_IDENTITY, .focal = 100000, .near_plane = 6554,
                                        .far_plane = 100 * 65536, .half_height = orthographic ? 4 * 65536 : 0 };
            random_rotation(object[k].basis, 1);
            if (k > 0)
                for (int i = 0; i < 9; i++)         /* neighbouring poses: a tenth of the way to anywhere */
                    object[k].basis[i] = object[0].basis[i] + (object[k].basis[i] - object[0].basis[i]) / 10;
            for (int i = 0; i < 2; i++) {
                object[k].origin[i] = between(-65536, 65536);
                camera[k].pose.origin[i] = between(-20000, 20000);
            }
            object[k].origin[2] = between(-10 * 65536, -8 * 65536);
            struct smear_view view;
            smear_view_compose(&view, &object[k], &mesh, &camera[k].pose);
            smear_projection_make(&p[k], &view, &camera[k], 240, coarse);
        }
        /* Up to five frames away, as a shutter of 3600 degrees; they add up to one. */
        int32_t weight[3] = { 0 }, rest = 1 << 24;
        for (int k = 1; k < count; k++) {
            weight[k] = between(-(1 << 24), 1 << 24) * (n & 1 ? 1 : 4) / (count == 2 ? 1 : 4);
            rest -= weight[k];
        }
        weight[0] = rest;
        weigh(p, weight, apart && n % 5 == 0 ? NULL : position, count, &camera[0]);
        for (int k = 1; k < count; k++)
            CHECK_EQ(p[k].scale, p[0].scale);
        for (int vertex = 0; vertex < 6; vertex++) {
            int16_t v[3][3];
            double sum[4] = { 0, 0, 0, 0 };
            struct smear_homogeneous h = { 0, 0, 0, 0 };
            for (int k = 0; k < count; k++) {
                for (int i = 0; i < 3; i++)
                    v[k][i] = k == 0 ? (int16_t)between(-30000, 30000)
                                     : (int16_t)(v[0][i] + (apart ? between(-2000, 2000) : 0));
                double clip[4];
                clip_exactly(clip, &mesh, &object[k], &camera[k], 240, v[k]);
                for (int i = 0; i < 4; i++)
                    sum[i] += clip[i] * weight[k] / 16777216.0;
                if (k == 0 || apart) {
                    struct smear_homogeneous term;
                    smear_transform_vertex(&term, &p[k], v[k]);
                    h.x += term.x;
                    h.y += term.y;
                    h.w += term.w;
                    h.distance += term.distance;
                }
            }
            if (!CHECK_CLOSE(h.distance, sum[3] * ldexp(1, p[0].distance_scale), 40))
                return INFINITY;
            if (sum[2] < 0.5 || fabs(sum[0] / sum[2]) > 240 || fabs(sum[1] / sum[2]) > 240)
                continue;
            worst = fmax(worst, fmax(fabs(ldexp((double)h.x / h.w, coarse) - sum[0] / sum[2]),
                                     fabs(ldexp((double)h.y / h.w, coarse) - sum[1] / sum[2])));
        }
    }
    return worst;
}

static void test_instants_between_and_beyond_poses_are_within_a_hundredth_of_a_pixel(void)
{
    random_state = 4;
    for (int orthographic = 0; orthographic < 2; orthographic++)
        for (int apart = 0; apart < 2; apart++) {
            double worst = worst_sum(orthographic, apart);
            if (!CHECK_CLOSE(worst, 0, 0.01))
                CHECK_EQ(orthographic * 2 + apart, (int64_t)(worst * 1e6));
        }
}

static void test_sums_of_wild_poses_do_not_overflow(void)
{
    random_state = 5;
    for (int n = 0; n < 4000; n++) {
        bool orthographic = n & 1;
        const int count = between(2, 3), coarse = n % 3 == 2 ? projection_coarse(240, orthographic) : 0;
        static const int16_t here[3];
        const int16_t *const position[3] = { here, here, here };
        smear_mesh mesh = { .scale = wild_positive(), .shift = (int8_t)between(-32, 62) };
        smear_camera camera[3];
        struct smear_projection p[3], whole[3];
        for (int k = 0; k < count; k++) {
            smear_transform object;
            for (int i = 0; i < 9; i++)
                object.basis[i] = wild();
            for (int i = 0; i < 3; i++)
                object.origin[i] = wild();
            do
                camera[k] = wild_camera();
            while ((camera[k].half_height > 0) != orthographic);
            struct smear_view view;
            smear_view_compose(&view, &object, &mesh, &camera[k].pose);
            smear_projection_make(&p[k], &view, &camera[k], 240, coarse);
        }
        /* The largest weights there are: ten frames back (3600 degrees, trailing), or parabolas. */
        int32_t weight[3];
        weight[1] = count == 2 ? between(-10, 10) * (1 << 24) : between(0, 1 << 24);
        weight[2] = count == 2 ? 0 : between(-(1 << 22), 1 << 24);
        if (count == 3 && n % 5 == 0) {         /* one of them, where deformation is scaled by 8 */
            int32_t back = between(-10, 10) * (1 << 24);
            weight[1] = 8 * back;
            weight[2] = -7 * back;
        }
        weight[0] = (1 << 24) - weight[1] - weight[2];
        for (int k = 0; k < count; k++)
            whole[k] = p[k];
        weigh(p, weight, NULL, count, &camera[0]);
        weigh(whole, weight, position, count, &camera[0]);
        for (int row = 0; row < (orthographic ? 4 : 3); row++) {
            int64_t sum = 0;
            for (int k = 0; k < count; k++)
                sum += row_bound(p[k].m[row]);
            if (!CHECK(sum < INT32_MAX) || !CHECK(row_bound(whole[0].m[row]) < INT32_MAX))
                return;
        }
        const int16_t v[3] = { -32768, 32767, -32768 };
        struct smear_homogeneous h;
        smear_transform_vertex(&h, &whole[0], v);
        CHECK(p[0].depths.near_distance >= 1 && p[0].depths.far_distance > p[0].depths.near_distance);
        REQUIRE(!orthographic || h.w >= 1);
    }
}

#include "build/suites/matrix.h"
