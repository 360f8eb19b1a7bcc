/* SPDX-License-Identifier: MIT */
/* test_matcap.c - smear_matcap.h against double precision: texture coordinates under rotations, scales, mirrors and shears, by both
 * kinds of cameras; a polished ball against a ray through each pixel. Host only. */
#include "smear_matcap.h"

#include "tests/rig.h"

enum { NORMALS = 64, TURNS = 3000 };

/* ------------------------------------------------------------------ coordinates */

/* The axes of one who sees a place. */
static void axes_to(double x[3], double y[3], const smear_transform *place, const smear_camera *camera)
{
    double z[3], up[3];
    for (int i = 0; i < 3; i++) {
        z[i] = camera->half_height > 0 ? camera->pose.basis[3 * i + 2] : (double)camera->pose.origin[i] - place->origin[i];
        up[i] = camera->pose.basis[3 * i + 1];
    }
    unit3(z);
    cross3(x, up, z);
    unit3(x);
    cross3(y, z, x);
}

/* Where a normal of the world lies on the ball, in 1/2^15 of the texture. */
static void want_of(double uv[2], const int8_t n[3], const smear_transform *place, const smear_camera *camera)
{
    double x[3], y[3], column[3][3], cofactor[3], world[3] = { 0, 0, 0 };
    axes_to(x, y, place, camera);
    for (int i = 0; i < 9; i++)
        column[i % 3][i / 3] = place->basis[i];
    cross3(cofactor, column[1], column[2]);
    const double way = dot3(cofactor, column[0]) < 0 ? -1 : 1;
    for (int j = 0; j < 3; j++) {
        cross3(cofactor, column[(j + 1) % 3], column[(j + 2) % 3]);
        for (int i = 0; i < 3; i++)
            world[i] += way * cofactor[i] * n[j];
    }
    unit3(world);
    uv[0] = 16384 + 16256 * dot3(world, x);
    uv[1] = 16384 - 16256 * dot3(world, y);
}

static void random_normals(int8_t n[3 * NORMALS])
{
    for (int i = 0; i < NORMALS; i++) {
        double v[3];
        for (int k = 0; k < 3; k++)
            v[k] = (double)random_u32() - 2147483648.0;
        unit3(v);
        for (int k = 0; k < 3; k++)
            n[3 * i + k] = (int8_t)lrint(127 * v[k]);
    }
}

/* A turn; scaled alike or, `uneven`, by up to 8 along the axes of the mesh; every fourth mirrored. */
static smear_transform random_place(int turn, bool uneven)
{
    smear_transform place = smear_from_euler(random_u32(), random_u32(), random_u32());
    const double size = pow(2, (int)(random_u32() % 14) - 10), more[3] = { 1, uneven ? 2.5 : 1, uneven ? 8 : 1 };
    for (int i = 0; i < 9; i++)
        place.basis[i] = (int32_t)(place.basis[i] * size * more[i % 3] * (turn % 4 == 3 && i % 3 == 0 ? -1 : 1));
    for (int i = 0; i < 3; i++)
        place.origin[i] = (int32_t)(random_u32() % (40u << 16)) - (20 << 16);
    return place;
}

static void test_coordinates_are_those_of_double_precision(void)
{
    int8_t normal[3 * NORMALS];
    int16_t uv[2 * NORMALS];
    const smear_mesh mesh = { .normal = normal, .vertex_count = NORMALS };
    double worst[2] = { 0, 0 };
    for (int turn = 0; turn < TURNS; turn++) {
        const bool uneven = turn % 2;
        const smear_transform place = random_place(turn, uneven);
        smear_camera camera = smear_perspective(SMEAR_DEGREES(40), SMEAR_Q16(0.1), 0);
        camera.pose = smear_from_euler(random_u32(), random_u32(), random_u32());
        for (int i = 0; i < 3; i++)
            camera.pose.origin[i] = (int32_t)(random_u32() % (60u << 16)) - (30 << 16);
        camera.half_height = turn % 6 == 5 ? 1 << 16 : 0;
        random_normals(normal);
        smear_matcap_uv(uv, &mesh, &place, &camera);
        for (int i = 0; i < NORMALS; i++) {
            double want[2];
            want_of(want, normal + 3 * i, &place, &camera);
            for (int k = 0; k < 2; k++)
                worst[uneven] = fmax(worst[uneven], fabs(uv[2 * i + k] - want[k]));
        }
    }
    /* Normals of int8 have lengths of 126 to 128, which nothing makes alike where all is scaled alike. */
    if (!CHECK(worst[0] < 32768 / 300.0 && worst[1] < 32768 / 400.0) || getenv("SMEAR_SHOW") != NULL)
        printf("matcap: off by %.1f, uneven %.1f of 32768\n", worst[0], worst[1]);
}

/* ------------------------------------------------------------------ a picture */

enum { SIDE = 160, TEXELS = 128, RINGS = 24, SLICES = 48, VERTICES = (RINGS + 1) * (SLICES + 1) };

/* What the polished stuff looks like, in codes: a light above, another one from the side, a dark rim. */
static void stuff(double code[3], double u, double v)
{
    const double x = 2 * u - 1, y = 1 - 2 * v, rr = fmin(1, x * x + y * y);
    code[0] = 200 * (1 - 0.7 * rr) + 30 * y;
    code[1] = 120 + 80 * y * (1 - rr) + 30 * x;
    code[2] = 90 + 100 * x * x + 40 * y;
}

static uint32_t pixel_of(const double code[3])
{
    return (uint32_t)lrint(code[0]) << 16 | (uint32_t)lrint(code[1]) << 8 | (uint32_t)lrint(code[2]) | 0xff000000u;
}

struct ball {
    int16_t position[3 * VERTICES], uv[2 * VERTICES];
    int8_t normal[3 * VERTICES];
    uint16_t index[6 * RINGS * SLICES];
    uint32_t texel[TEXELS * TEXELS];
    smear_mesh mesh;
    smear_texture texture;
    smear_material material;
};

static void make_ball(struct ball *b)
{
    int at = 0;
    for (int i = 0; i < VERTICES; i++) {
        const double up = acos(-1.0) * (i / (SLICES + 1)) / RINGS, round = 2 * acos(-1.0) * (i % (SLICES + 1)) / SLICES;
        const double n[3] = { sin(up) * cos(round), cos(up), -sin(up) * sin(round) };
        for (int k = 0; k < 3; k++) {
            b->position[3 * i + k] = (int16_t)lrint(16384 * n[k]);
            b->normal[3 * i + k] = (int8_t)lrint(127 * n[k]);
        }
    }
    for (int i = 0; i < RINGS * SLICES; i++) {
        const int a = i / SLICES * (SLICES + 1) + i % SLICES, below = a + SLICES + 1;
        const int corner[6] = { a, below, a + 1, a + 1, below, below + 1 };
        for (int k = 0; k < 6; k++)
            b->index[at++] = (uint16_t)corner[k];
    }
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        double code[3];
        stuff(code, (i % TEXELS + 0.5) / TEXELS, (i / TEXELS + 0.5) / TEXELS);
        b->texel[i] = pixel_of(code);
    }
    b->mesh = (smear_mesh){ .position = b->position, .normal = b->normal, .uv = b->uv, .uv_shift = 15, .index = b->index,
                            .vertex_count = VERTICES, .triangle_count = 2 * RINGS * SLICES, .shift = 14 };
    b->texture = (smear_texture){ .texels = b->texel, .width = TEXELS, .height = TEXELS };
    b->material = (smear_material){ .texture = &b->texture, .unlit = 1, .bilinear = 1 };
}

/* Finds what a ray from the eye at 0, down -z, sees of a ball of radius 1. Returns false beside it and at its rim. */
static bool ray_sees(double code[3], const smear_transform *place, const smear_camera *camera, int px, int py)
{
    const double k = 65536.0 / camera->focal;
    double way[3] = { (2 * px + 1.0 - SIDE) / SIDE * k, (SIDE - 2 * py - 1.0) / SIDE * k, -1 }, middle[3], n[3], x[3], y[3];
    for (int i = 0; i < 3; i++)
        middle[i] = place->origin[i] / 65536.0;
    unit3(way);
    const double along = dot3(way, middle), left = along * along - dot3(middle, middle) + 1;
    if (left < 0.09)            /* 17 degrees before the rim, where a picture of triangles has its own */
        return false;
    for (int i = 0; i < 3; i++)
        n[i] = way[i] * (along - sqrt(left)) - middle[i];
    axes_to(x, y, place, camera);
    stuff(code, 0.5 + 0.49609375 * dot3(n, x), 0.5 - 0.49609375 * dot3(n, y));
    return true;
}

static void test_a_polished_ball_is_that_of_rays(void)
{
    static struct ball b;
    make_ball(&b);
    for (int i = 0; i < 3; i++) {
        smear_camera camera = smear_perspective(SMEAR_DEGREES(60), SMEAR_Q16(0.1), 0);
        smear_transform place = smear_from_euler(SMEAR_DEGREES(40 * i), SMEAR_DEGREES(25 * i), 0);
        place.origin[0] = SMEAR_Q16(0.9) * (i - 1), place.origin[2] = SMEAR_Q16(-4);
        const smear_frame frame = { .camera = &camera, .light_space = SMEAR_LIGHT_ENCODED };
        const smear_draw draw = { .mesh = &b.mesh, .material = &b.material, .now = &place };
        smear_desc desc = { .width = SIDE, .height = SIDE, .flush = place_band };
        RIG(rig, &desc, false);
        double squares = 0;
        int count = 0;
        smear_matcap_uv(b.uv, &b.mesh, &place, &camera);
        CHECK_EQ(rig_frame(&rig, &frame, &draw, 1), SMEAR_OK);
        for (int p = 0; p < SIDE * SIDE; p++) {
            const uint32_t got = ((const uint32_t *)(const void *)rig.picture)[p];
            double want[3];
            if (!ray_sees(want, &place, &camera, p % SIDE, p / SIDE))
                continue;
            for (int c = 0; c < 3; c++, count++)
                squares += pow((int)(got >> (16 - 8 * c) & 255) - want[c], 2);
        }
        const double error = sqrt(squares / count);
        if (!CHECK(count > 3 * 1500 && error < 1.5) || getenv("SMEAR_SHOW") != NULL)
            printf("matcap: %.2f codes, %d pixels\n", error, count / 3);
    }
}

#include "build/suites/matcap.h"
