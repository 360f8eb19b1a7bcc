/* SPDX-License-Identifier: MIT */
/* test_light.c - light on faces against double precision; frames are lit from where they say, in the colours they say. Golden frames
 * hold the rest. Host only. */
#include "geometry/light.h"

#include "base/tables.h"
#include "tests/rig.h"

/* What lights a frame that says nothing. */
static const struct smear_sun *default_sun(void)
{
    static struct smear_sun sun;
    smear_sun_make(&sun, NULL);
    return &sun;
}

static const smear_material plain = { 0 };

static void random_unit(double v[3])
{
    double length;
    do {
        length = 0;
        for (int i = 0; i < 3; i++) {
            v[i] = uniform(-1, 1);
            length += v[i] * v[i];
        }
    } while (length < 0.01 || length > 1);
    for (int i = 0; i < 3; i++)
        v[i] /= sqrt(length);
}

/* A random rotation times `scale`. */
static void random_turn(double m[9], double scale)
{
    double x[3], y[3], dot = 0, length = 0;
    random_unit(x);
    do {
        random_unit(y);
        dot = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    } while (fabs(dot) > 0.9);
    for (int i = 0; i < 3; i++) {
        y[i] -= dot * x[i];
        length += y[i] * y[i];
    }
    for (int i = 0; i < 3; i++)
        y[i] /= sqrt(length);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        m[3 * i] = x[i] * scale;
        m[3 * i + 1] = y[i] * scale;
        m[3 * i + 2] = (x[j] * y[k] - x[k] * y[j]) * scale;
    }
}

static smear_transform transform_of(const double m[9])
{
    smear_transform t = SMEAR_IDENTITY;
    for (int i = 0; i < 9; i++)
        t.basis[i] = (int32_t)lrint(m[i] * (1 << 24));
    return t;
}

static const double light[3] = { 0.36, 0.80, 0.48 };

/* The normal in the world: inverse transpose, not normalised. */
static void world_normal(const double m[9], const double n[3], double out[3])
{
    double cofactor[9], det = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor[3 * i + j] = m[3 * i1 + j1] * m[3 * i2 + j2] - m[3 * i1 + j2] * m[3 * i2 + j1];
        }
    for (int j = 0; j < 3; j++)
        det += m[j] * cofactor[j];
    for (int i = 0; i < 3; i++) {
        out[i] = 0;
        for (int j = 0; j < 3; j++)
            out[i] += cofactor[3 * i + j] * n[j] / det;
    }
}

static double cosine_exactly(const double m[9], const double n[3])
{
    double w[3], dot = 0, length = 0;
    world_normal(m, n, w);
    for (int i = 0; i < 3; i++) {
        dot += w[i] * light[i];
        length += w[i] * w[i];
    }
    return fmax(0, dot / sqrt(length));
}

static struct smear_shading shading_of(const double m[9])
{
    struct smear_shading s;
    const smear_transform t = transform_of(m);
    smear_shading_make(&s, &t, &plain, true, true, default_sun());
    return s;
}

/* ------------------------------------------------------------------ faces */

static void test_faces_are_lit_by_their_plane_within_a_hundredth(void)
{
    random_state = 4;
    for (int n = 0; n < 400; n++) {
        double m[9], u[3], v[3], normal[3];
        random_turn(m, 1);
        for (int i = 0; i < 3 && n % 2; i++)
            m[3 * i] *= n % 4 == 1 ? -1.5 : 0.4;
        struct smear_shading s = shading_of(m);
        int16_t p[3][3];
        int reach = 8 << n % 13;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                p[k][i] = (int16_t)between(-(reach > 32767 ? 32767 : reach), reach > 32767 ? 32767 : reach);
        for (int i = 0; i < 3; i++) {
            u[i] = p[1][i] - p[0][i];
            v[i] = p[2][i] - p[0][i];
        }
        double size = 0;
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            normal[i] = u[j] * v[k] - u[k] * v[j];
            size += normal[i] * normal[i];
        }
        if (size == 0)
            continue;
        double got = smear_light_face(&s, p[0], p[1], p[2]) / 65536.0;
        if (!CHECK_CLOSE(got, cosine_exactly(m, normal), 0.01)) {
            CHECK_EQ(n, -1);
            return;
        }
        /* Turned around, the other side is lit. */
        double back = smear_light_face(&s, p[0], p[2], p[1]) / 65536.0;
        REQUIRE(got == 0 || back == 0);
    }
}

/* ------------------------------------------------------------------ the light of a frame */

enum { EDGE = 16, LOOKS = 300 };

static uint32_t middle_of(struct rig *r, const smear_frame *frame, const smear_draw *draw)
{
    CHECK_EQ(rig_frame(r, frame, draw, 1), SMEAR_OK);
    return ((const uint32_t *)(const void *)r->picture)[EDGE / 2 * EDGE + EDGE / 2];
}

/* Within a hundredth of the light and a code and a half. */
static void check_lit(uint32_t pixel, int shift, double want)
{
    const double got = pixel >> shift & 255u;
    CHECK(got >= code_of(fmax(0, want - 0.01)) - 1.5 && got <= code_of(fmin(1, want + 0.01)) + 1.5);
}

static void test_a_frame_is_lit_from_where_it_says_in_the_colours_it_says(void)
{
    smear_desc desc = small_desc(EDGE, EDGE);
    const smear_camera camera = camera_at(0, 0, 0, 0);
    desc.format = SMEAR_XRGB8888;
    random_state = 5;
    RIG(r, &desc, false);
    for (int n = 0; n < LOOKS && test_state.failures_here == 0; n++) {
        const smear_transform pose = pose_at(0, 0, -2, uniform(-0.7, 0.7), uniform(-0.7, 0.7));
        const double size = pow(10, uniform(-2, 2));
        smear_light given;
        double towards[3], length = 0, cosine = 0;
        for (int i = 0; i < 3; i++) {
            towards[i] = uniform(-1, 1) + (i == 2);
            given.direction[i] = q16(towards[i] * size);
            given.ambient[i] = (uint16_t)between(0, 30000);
            given.diffuse[i] = (uint16_t)between(0, 65535);
        }
        for (int i = 0; i < 3; i++) {
            length += (double)given.direction[i] * given.direction[i];
            cosine += (double)given.direction[i] * pose.basis[3 * i + 2] / (1 << 24);
        }
        cosine = fmax(0, cosine / sqrt(length));
        const smear_material paint = { .color = { (uint8_t)between(20, 255), (uint8_t)between(20, 255),
                                                  (uint8_t)between(20, 255), 255 }, .double_sided = 1 };
        const smear_draw draw = { .mesh = &square, .material = &paint, .now = &pose };
        const smear_frame frame = { .camera = &camera, .method = SMEAR_NONE, .light = &given,
                                    .light_space = (uint8_t)(n & 1) };
        const uint32_t pixel = middle_of(&r, &frame, &draw);
        for (int i = 0; i < 3; i++)
            check_lit(pixel, 16 - 8 * i, fmin(1, light_of(paint.color[i])
                                                     * fmin(1, (given.ambient[i] + given.diffuse[i] * cosine) / 65535)));
    }
}

#include "build/suites/light.h"
