/* SPDX-License-Identifier: MIT */
/* test_shadow.c - shadows against rays in doubles: from each pixel to the ground, and from there to the light; a round one against
 * the opacity of its mesh there. No pixel is darkened twice. All methods draw them, and blur them. Host only. */
#include <smear_math.h>
#include <smear_scene.h>

#include "tests/rig.h"

enum { WIDTH = 240, HEIGHT = 180, PIXELS = WIDTH * HEIGHT, ALL_METHODS = (1 << SMEAR_METHOD_COUNT) - 2, DRAWS = 4 };

static const uint8_t ground_color[3] = { 200, 180, 120 }, thing_color[3] = { 40, 60, 220 };

/* ------------------------------------------------------------------ a scene */

/* A cube above a ground, its shadow, and that of another one, which is not seen, or a round one. */
struct shaded {
    smear_mesh ground_mesh;
    smear_material ground, thing;
    smear_transform cube[2], shadow[2], open[2], close[2], cube_open, cube_close;
    smear_camera camera;
    smear_draw draw[DRAWS];
    smear_frame frame;
    int count;
};

static const smear_vec3 light = { 30000, 60000, 20000 };

static smear_transform cube_at(int i, double t)
{
    const smear_transform place = smear_move(q16(i * 0.7 + t), q16(1.6 + 0.5 * i), q16(-0.3 * i));
    const smear_transform turn = smear_compose(smear_rotate_y(SMEAR_DEGREES(30 + 40 * i)), smear_rotate_x(SMEAR_DEGREES(20)));
    return smear_compose(place, smear_compose(turn, smear_scale(q24(0.6), q24(0.6), q24(0.6))));
}

static smear_transform shadow_at(int i, double t, bool round)
{
    if (round)
        return smear_blob_under(smear_vec(q16(i * 0.7 + t), q16(1), q16(-0.3 * i)), 0, q16(1.2));
    return smear_compose(smear_shadow_on(smear_vec(0, 0, 0), smear_vec(0, 1 << 16, 0), light), cube_at(i, t));
}

static void make_shaded(struct shaded *s, int method, bool linear, bool round, double step)
{
    static const int16_t place[] = { -128, 0, -128, -128, 0, 128, 128, 0, 128, 128, 0, -128 };
    memset(s, 0, sizeof *s);
    s->ground_mesh = (smear_mesh){ .position = place, .index = square_index, .vertex_count = 4, .triangle_count = 2, .shift = 3 };
    s->ground = (smear_material){ .color = { ground_color[0], ground_color[1], ground_color[2], 255 }, .unlit = 1 };
    s->thing = (smear_material){ .color = { thing_color[0], thing_color[1], thing_color[2], 255 }, .unlit = 1 };
    s->camera = smear_perspective(SMEAR_DEGREES(50), SMEAR_Q16(0.1), 0);
    s->camera.pose = smear_look_at(smear_vec(q16(0.5), q16(3), q16(6)), smear_vec(0, q16(0.5), 0), smear_vec(0, 1 << 16, 0));
    s->draw[s->count++] = (smear_draw){ .id = 1, .mesh = &s->ground_mesh, .material = &s->ground };
    s->cube[0] = cube_at(0, 0);
    s->cube_open = cube_at(0, -step);
    s->cube_close = cube_at(0, step);
    s->draw[s->count++] = (smear_draw){ .id = 2, .mesh = &cube, .material = &s->thing, .now = &s->cube[0], .open = &s->cube_open,
                                        .close = &s->cube_close };
    for (int i = 0; i < 2; i++) {
        s->cube[i] = cube_at(i, 0);
        s->shadow[i] = shadow_at(i, 0, round);
        s->open[i] = shadow_at(i, -step, round);
        s->close[i] = shadow_at(i, step, round);
        s->draw[s->count++] = (smear_draw){ .id = (uint32_t)(3 + i), .mesh = round ? &smear_blob : &cube, .now = &s->shadow[i],
                                            .open = &s->open[i], .close = &s->close[i],
                                            .material = round ? &smear_blob_material : &smear_shadow_material };
    }
    s->frame = (smear_frame){ .camera = &s->camera, .method = (uint8_t)method, .shutter.poses = 1, .clear = 0x406080,
                              .samples = method == SMEAR_ACCUMULATE ? 64 : 0,
                              .light_space = (uint8_t)(linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED) };
}

static bool see(uint32_t *out, const struct shaded *s)
{
    const smear_desc desc = { .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .reach = 12, .methods = ALL_METHODS };
    RIG(r, &desc, false);
    const bool ok = CHECK_EQ(rig_frame(&r, &s->frame, s->draw, s->count), SMEAR_OK);
    memcpy(out, r.picture, PIXELS * 4);
    return ok;
}

/* ------------------------------------------------------------------ in doubles */

/* Brings a place or, without `moves`, a way into the space of what has this transform, a scaled rotation. */
static void into(double out[3], const smear_transform *t, const double in[3], bool moves)
{
    double length = 0;
    for (int i = 0; i < 3; i++)
        length += pow(t->basis[3 * i] / 16777216.0, 2);
    for (int j = 0; j < 3; j++) {
        out[j] = 0;
        for (int i = 0; i < 3; i++)
            out[j] += t->basis[3 * i + j] / 16777216.0 * (in[i] - (moves ? t->origin[i] / 65536.0 : 0)) / length;
    }
}

/* Whether a ray meets a cube. */
static bool meets(const smear_transform *t, const double from[3], const double way[3])
{
    double a[3], d[3], low = 0, high = 1e9;
    into(a, t, from, true);
    into(d, t, way, false);
    for (int i = 0; i < 3; i++) {
        const double edge = cube_position[0] < 0 ? -cube_position[0] / 256.0 : cube_position[0] / 256.0;
        const double p = (-edge - a[i]) / d[i], q = (edge - a[i]) / d[i];
        low = fmax(low, fmin(p, q));
        high = fmin(high, fmax(p, q));
    }
    return low < high;
}

/* The opacity of the round one, 0 to 255. */
static double blob_at(double x, double z)
{
    const double rr = x * x + z * z;
    return rr < 1 ? 255 * pow(1 - rr, 1.5) : 0;
}

/* The colour of a pixel. False where something else is seen. */
static bool shade(double out[3], const struct shaded *s, bool linear, bool round, int x, int y)
{
    const double k = tan(25 * acos(-1.0) / 180);
    const double view[3] = { (2 * x + 1.0 - WIDTH) / HEIGHT * k, (HEIGHT - 2 * y - 1.0) / HEIGHT * k, -1 };
    double way[3], eye[3], ground[3], alpha = 0;
    for (int i = 0; i < 3; i++) {
        eye[i] = s->camera.pose.origin[i] / 65536.0;
        way[i] = 0;
        for (int j = 0; j < 3; j++)
            way[i] += s->camera.pose.basis[3 * i + j] / 16777216.0 * view[j];
    }
    if (way[1] >= 0 || meets(&s->cube[0], eye, way))
        return false;
    for (int i = 0; i < 3; i++)
        ground[i] = eye[i] - way[i] * eye[1] / way[1];
    if (fabs(ground[0]) > 15.9 || fabs(ground[2]) > 15.9)
        return false;
    const double to_light[3] = { light.x, light.y, light.z };
    for (int i = 0; i < 2; i++)
        if (round)
            alpha = fmax(alpha, blob_at((ground[0] - s->shadow[i].origin[0] / 65536.0) / 1.2,
                                        (ground[2] - s->shadow[i].origin[2] / 65536.0) / 1.2));
        else if (meets(&s->cube[i], ground, to_light))
            alpha = 255;
    alpha *= smear_shadow_material.color[3] / (255.0 * 255.0);
    for (int c = 0; c < 3; c++)
        out[c] = linear ? code_of(light_of(ground_color[c]) * (1 - alpha)) : ground_color[c] * (1 - alpha);
    return true;
}

static void test_shadows_lie_where_no_light_comes(void)
{
    static uint32_t got[PIXELS];
    for (int k = 0; k < 8; k++) {
        struct shaded s;
        const bool linear = k % 2 == 1, round = k >= 2;
        double sum = 0;
        int count = 0, dark = 0;
        make_shaded(&s, SMEAR_NONE, linear, round, 0);
        if (k >= 4)         /* seen from close by, and askew */
            s.camera.pose = smear_look_at(smear_vec(q16(0.3), q16(k < 6 ? 1.1 : 2.5), q16(k < 6 ? 2.4 : 3)), smear_vec(0, 0, q16(-0.3)),
                                          smear_vec(q16(k < 6 ? 0 : 0.7), 1 << 16, 0));
        if (!see(got, &s))
            continue;
        for (int i = 0; i < PIXELS; i++) {
            double want[3];
            if (!shade(want, &s, linear, round, i % WIDTH, i / WIDTH))
                continue;
            count++;
            dark += want[0] < ground_color[0] - 20;
            for (int c = 0; c < 3; c++)
                sum += pow(want[c] - (double)(got[i] >> (16 - 8 * c) & 255u), 2);
        }
        const double error = sqrt(sum / (3.0 * count));
        CHECK(dark > PIXELS / 50);
        if (!CHECK(error < 1.5) || getenv("SMEAR_SHOW") != NULL)
            printf("  %d %s %s: %.3f, dark %d\n", k, round ? "round" : "planar", linear ? "linear" : "encoded", error, dark);
    }
}

/* As far as each is asked to go: the mean of 64 instants is what methods that follow paths come near to. */
static void test_every_method_draws_and_blurs_them(void)
{
    static uint32_t truth[PIXELS], got[PIXELS];
    for (int round = 0; round < 2; round++) {
        struct shaded s;
        make_shaded(&s, SMEAR_ACCUMULATE, true, round != 0, 0.25);
        if (!see(truth, &s))
            return;
        for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++) {
            const bool follows = method == SMEAR_SUBFRAMES || method == SMEAR_AUTO || method == SMEAR_TIMEMASK;
            make_shaded(&s, method, true, round != 0, 0.25);
            if (method == SMEAR_ACCUMULATE || !see(got, &s))
                continue;
            const double error = rms_of(truth, got, PIXELS);
            if (!CHECK(error < (follows ? 1.5 : 12)) || getenv("SMEAR_SHOW") != NULL)
                printf("  %s method %d: %.3f\n", round ? "round" : "planar", method, error);
        }
    }
}

/* A ground of texels with this upper byte, which opaque draws do not look at, as it lies there or moves. Some are as PACKED_NOTHING
 * but for that byte. */
static bool see_over_texels(uint32_t *out, int method, bool round, bool moves, int width, uint32_t upper)
{
    static uint32_t texels[64 * 64];
    static const int16_t uv[] = { 0, 0, 0, 32767, 32767, 32767, 32767, 0 };
    const int height = width == 32 ? 16 : width;
    for (int i = 0; i < width * height; i++)
        texels[i] = upper << 24 | (i % 3 == 0 ? 0x010101u : (uint32_t)i * 2654435761u >> 8);
    const smear_texture texture = { .texels = texels, .width = (uint16_t)width, .height = (uint16_t)height };
    const smear_transform open = smear_move(q16(-0.2), 0, 0), close = smear_move(q16(0.2), 0, 0);
    struct shaded s;
    make_shaded(&s, method, false, round, 0.25);
    s.ground_mesh.uv = uv;
    s.ground = (smear_material){ .texture = &texture, .unlit = 1 };
    if (moves)
        s.draw[0].open = &open, s.draw[0].close = &close;
    return see(out, &s);
}

static void test_upper_bytes_of_opaque_texels_make_no_difference(void)
{
    static const uint8_t upper[] = { 1, 0x80, 0xff }, width[] = { 8, 32, 64 };
    static uint32_t want[PIXELS], got[PIXELS];
    for (int k = 0; k < 24; k++) {
        const int method = k & 1 ? SMEAR_AUTO : SMEAR_NONE, size = width[k >> 3];
        const bool round = k >> 1 & 1, moves = k >> 2 & 1;
        if (!see_over_texels(want, method, round, moves, size, 0))
            return;
        for (int i = 0; i < 3; i++)
            if (see_over_texels(got, method, round, moves, size, upper[i]) && !CHECK(memcmp(want, got, sizeof want) == 0))
                printf("  %s method %d, %d texels, upper byte %d%s: %.3f\n", round ? "round" : "planar", method, size, upper[i],
                       moves ? ", moving" : "", rms_of(want, got, PIXELS));
    }
}

#include "build/suites/shadow.h"
