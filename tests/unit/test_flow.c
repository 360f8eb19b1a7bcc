/* SPDX-License-Identifier: MIT */
/* test_flow.c - how the camera's motion moves what stands still, of first order (geometry/reproject.h), against maps between cameras
 * in double precision. Host only. */
#include "geometry/reproject.h"
#include "geometry/shot.h"
#include "temporal/lines.h"
#include "tests/random.h"
#include "tests/test.h"

#include "smear_math.h"
#include "smear_stats.h"

#include <math.h>
#include <stdio.h>

/* ------------------------------------------------------------------ cameras */

static const int32_t now_only[3] = { 1 << 24, 0, 0 };

/* Cameras of now, open and close, and what the flow is made of. */
struct moves {
    smear_camera camera[3];
    const int32_t *weight;
    int32_t tilted[3]; /* weights of an instant that is not that of now */
    bool to_close;
    int32_t exposure; /* q16 */
    int32_t width, height;
};

static smear_transform pose_of(double x, double y, double z, double yaw, double pitch, double roll)
{
    const double cy = cos(yaw), sy = sin(yaw), cp = cos(pitch), sp = sin(pitch), cr = cos(roll), sr = sin(roll);
    const double m[9] = { cy * cr + sy * sp * sr, -cy * sr + sy * sp * cr, sy * cp,
                          cp * sr, cp * cr, -sp,
                          -sy * cr + cy * sp * sr, sy * sr + cy * sp * cr, cy * cp };
    smear_transform t;
    for (int i = 0; i < 9; i++)
        t.basis[i] = (int32_t)lround(m[i] * SMEAR_BASIS_ONE);
    t.origin[0] = (int32_t)lround(x * 65536.0);
    t.origin[1] = (int32_t)lround(y * 65536.0);
    t.origin[2] = (int32_t)lround(z * 65536.0);
    return t;
}

/* Numbers in a row, each within `most` of zero. */
static void some(double out[], int count, double most)
{
    for (int i = 0; i < count; i++)
        out[i] = uniform(-most, most);
}

/* Small: of few pixels and hundredths of the distance, as within an exposure. */
static void make_moves(struct moves *m, bool flat)
{
    double from[6], way[6];
    *m = (struct moves){ .weight = now_only, .exposure = 65536 };
    m->to_close = chance(2);
    m->width = between(8, 640);
    m->height = between(8, 480);
    some(from, 6, 3);
    const double amount = uniform(0, 0.02);
    const int32_t focal = between(40000, 200000), size = between(65536, 6 * 65536);
    const int32_t near_plane = between(3000, 20000);
    const bool zooms = chance(3);
    for (int i = 0; i < 3; i++) {
        smear_camera *c = &m->camera[i];
        const double step = i == 0 ? 0 : i * 2 * amount - 3 * amount, zoom = zooms ? 1 + step : 1;
        some(way, 6, step);
        for (int k = 0; k < 6; k++)
            way[k] += from[k];
        c->pose = pose_of(way[0], way[1], way[2], way[3], way[4], way[5]);
        c->focal = (int32_t)(focal * zoom);
        c->half_height = flat ? (int32_t)(size * zoom) : 0;
        c->near_plane = near_plane;
        c->far_plane = flat ? 20 * 65536 : 0;
    }
    if (m->to_close)
        return;
    const int32_t back = between(0, 1 << 23);
    m->tilted[0] = (1 << 24) - back;
    m->tilted[1] = back;
    m->weight = m->tilted;
    m->exposure = between(0, 65536);
}

/* ------------------------------------------------------------------ in double */

/* Finds where a camera sees the point q that the one of now sees: x right, y down and z into the screen. */
static void seen_by(double out[3], const smear_camera *now, const smear_camera *camera, const double q[3])
{
    double world[3];
    for (int k = 0; k < 3; k++) {
        const int32_t *axis = &now->pose.basis[3 * k];
        world[k] = now->pose.origin[k] / 65536.0 + (axis[0] * q[0] - axis[1] * q[1] - axis[2] * q[2]) / SMEAR_BASIS_ONE;
    }
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int k = 0; k < 3; k++)
            sum += camera->pose.basis[3 * k + i] * (world[k] - camera->pose.origin[k] / 65536.0) / SMEAR_BASIS_ONE;
        out[i] = i == 0 ? sum : -sum;
    }
    for (int i = 0; i < 2; i++)
        out[i] *= now->half_height > 0 ? (double)now->half_height / camera->half_height : (double)camera->focal / now->focal;
}

/* The drawn instant sees the sum of what the cameras see. */
static void seen_when_drawn(double out[3], const struct moves *m, const double q[3])
{
    double one[3];
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < 3; i++) {
        seen_by(one, &m->camera[0], &m->camera[i], q);
        for (int k = 0; k < 3; k++)
            out[k] += one[k] * m->weight[i] / 16777216.0;
    }
}

/* Finds the point that the drawn instant sees at `want`. */
static void point_at(double q[3], const struct moves *m, const double want[3])
{
    for (int k = 0; k < 3; k++)
        q[k] = want[k];
    for (int round = 0; round < 60; round++) { /* maps are near to the identity */
        double got[3];
        seen_when_drawn(got, m, q);
        for (int k = 0; k < 3; k++)
            q[k] += want[k] - got[k];
    }
}

/* What moves from one pose to another, px: exactly, and of first order; and how far the places of first order go. */
struct motion {
    double exact[2], first[2], way;
    double turn; /* by which part the distance changes at most */
};

static struct motion motion_of(const struct moves *m, double px, double py, uint32_t units)
{
    const smear_camera *now = &m->camera[0];
    const bool flat = now->half_height > 0;
    const double x = px - m->width / 2.0, y = py - m->height / 2.0, sign[2] = { -1, 1 };
    const double scale = flat ? m->height * 32768.0 / now->half_height : now->focal * m->height / 131072.0;

    const double distance = flat ? now->far_plane / 65536.0 - (now->far_plane - now->near_plane) / 65536.0 * units / SMEAR_DEPTH_NEAR
                                 : now->near_plane / 65536.0 * SMEAR_DEPTH_NEAR / units;
    const double across = flat ? 1 / scale : distance / scale, want[3] = { x * across, y * across, distance };
    const int pose[2] = { 1, m->to_close ? 2 : 0 };
    struct motion r = { .way = 0 };
    double q[3];
    point_at(q, m, want);
    for (int i = 0; i < 2; i++) {
        double p[3];
        seen_by(p, now, &m->camera[pose[i]], q);
        const double w = flat ? 1 : p[2] / distance, at[2] = { x, y };
        for (int k = 0; k < 2; k++) {
            const double of_first = p[k] / across - at[k] * w;
            r.exact[k] += sign[i] * of_first / w;
            r.first[k] += sign[i] * of_first;
            r.way += fabs(of_first);
        }
        r.turn = fmax(r.turn, fabs(w - 1));
    }
    return r;
}

/* ------------------------------------------------------------------ tests */

static void check_case(bool flat, int number)
{
    struct moves m;
    struct smear_reprojection r;
    struct smear_flow f;
    make_moves(&m, flat);
    smear_reproject_make(&r, &m.camera[0], &m.camera[1], &m.camera[2], m.weight, m.to_close, m.width, m.height);
    smear_flow_make(&f, &r, m.exposure);
    for (int i = 0; i < 24; i++) {
        const int32_t x = between(0, m.width - 1), y = between(0, m.height - 1);
        const uint32_t units = (uint32_t)between(1, i % 2 == 0 ? 20000 : (int32_t)SMEAR_DEPTH_NEAR);
        const struct motion want = motion_of(&m, x + 0.5, y + 0.5, units), middle = motion_of(&m, x, y, units);
        const double whole = m.exposure / 65536.0;
        int32_t flow[2], exact[2];
        smear_flow_at(&f, x, y, units, flow);
        smear_reproject(&r, 2 * x + 1, 2 * y + 1, units, exact);
        bool ok = true;
        for (int k = 0; k < 2; k++) {
            /* Blocks and vertices are told by their corner, which differs by half a pixel's motion. */
            const double slack = 0.1 + 0.003 * want.way + fabs(want.first[k] - middle.first[k]);
            ok = ok && fabs(exact[k] / 256.0 - want.exact[k]) <= 0.1 + 0.003 * want.way;
            ok = ok && fabs(flow[k] / 256.0 - whole * want.first[k]) <= slack;
            if (want.turn < 0.5)
                ok = ok && fabs(flow[k] / 256.0 - whole * want.exact[k]) <= slack + want.way * want.turn / (1 - want.turn);
        }
        if (!CHECK(ok)) {
            char text[200];
            snprintf(text, sizeof text, "    case %d, pixel %d %d of %d x %d, %u units: flow %.2f %.2f of %.2f %.2f\n", number,
                     (int)x, (int)y, (int)m.width, (int)m.height, (unsigned)units, flow[0] / 256.0, flow[1] / 256.0, whole * want.exact[0],
                     whole * want.exact[1]);
            test_print(text);
            return;
        }
    }
}

static void test_the_flow_is_the_first_order_of_what_cameras_say(void)
{
    random_state = 5;
    for (int i = 0; i < 3000; i++)
        check_case(false, i);
}

static void test_so_is_that_of_orthographic_cameras(void)
{
    random_state = 6;
    for (int i = 0; i < 3000; i++)
        check_case(true, i);
}

static void test_cameras_of_the_largest_numbers_turn_only_where_they_differ(void)
{
    const struct smear_shot shot = { .half_exposure = 1 << 23 };
    smear_transform least, most;
    for (int i = 0; i < 9; i++) {
        least.basis[i] = INT32_MIN;
        most.basis[i] = INT32_MAX;
    }
    CHECK(!smear_lines_turn(&shot, &least, &least, 1, 256));
    CHECK(!smear_lines_turn(&shot, &most, &most, 1, 256));
    CHECK(smear_lines_turn(&shot, &least, &most, 1, 1));
}

#include "build/suites/flow.h"
