/* SPDX-License-Identifier: MIT */
/* test_fog.c - fog against what each pixel's own depth gives; what is cut is fog all over; the same picture from any method
 * where nothing moves, with any number of workers and in parts; what is refused. Host only. */
#include "tests/rig.h"
#include "tools/player/crew.h"

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT, FOG = 0xa0b4c8, ALL_METHODS = (1 << SMEAR_METHOD_COUNT) - 2 };

static const double fog_near = 2.5, fog_far = 6.5;

static smear_fog fog_between(double begin, double end)
{
    return (smear_fog){ .color = FOG, .near_plane = q16(begin), .far_plane = q16(end) };
}

static smear_desc desc_of(uint32_t methods)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = SMEAR_XRGB8888, .tile = 8, .reach = 6,
                         .methods = (uint16_t)(methods & ~(1u << SMEAR_DEFAULT_METHOD)) };
}

/* ------------------------------------------------------------------ against every pixel's own depth */

static double distance_of(const smear_camera *camera, uint16_t code)
{
    const double near_plane = camera->near_plane, units = smear_depth_units(code);
    if (code == 0)
        return INFINITY;
    if (camera->half_height > 0)
        return (camera->far_plane - (camera->far_plane - near_plane) * units / SMEAR_DEPTH_NEAR) / 65536.0;
    return near_plane * SMEAR_DEPTH_NEAR / units / 65536.0;
}

/* A picture without fog, and its depths. */
struct seen {
    uint32_t color[PIXELS];
    uint16_t depth[PIXELS];
    smear_camera camera;
};

/* The scene without its glass, whose depth is not kept, and with a road that reaches from under the camera to far away, with
 * kerbs without a texture. */
static int make_road(struct scene *s, smear_mesh *road, int method, bool flat_depth)
{
    static const int16_t place[] = { -3, -2, 2,  3, -2, 2,  3, -2, -60,  -3, -2, -60,  -9, -2, 2,  -9, 3, -60 };
    static const uint16_t side[] = { 0, 1, 2, 0, 2, 3, 4, 0, 3, 4, 3, 5 };
    static const uint8_t color[] = { 30, 30, 40, 255, 200, 40, 30, 255, 10, 200, 60, 255,
                                     250, 250, 250, 255, 0, 0, 0, 255, 90, 20, 160, 255 };
    make_scene(s, 0, method);
    *road = (smear_mesh){ .position = place, .index = side, .color = color, .vertex_count = 6, .triangle_count = 4 };
    s->draw[3].mesh = road;
    s->draw[3].material = NULL;
    s->draw[3].now = NULL;
    s->material[4].double_sided = 1;
    if (flat_depth) {
        s->camera.focal = 0;
        s->camera.half_height = q16(2.5);
        s->camera.far_plane = q16(20);
    }
    s->frame.clear = FOG;
    return SCENE_DRAWS;
}

static bool see(struct seen *out, bool linear, bool flat_depth)
{
    const smear_desc desc = desc_of(SMEAR_SET(SMEAR_RECONSTRUCT));
    struct scene s;
    smear_mesh road;
    const int count = make_road(&s, &road, SMEAR_RECONSTRUCT, flat_depth);
    s.frame.light_space = linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED;
    RIG(r, &desc, true);
    const bool ok = CHECK_EQ(rig_frame(&r, &s.frame, s.draw, count), SMEAR_OK);
    memcpy(out->color, r.color, sizeof out->color);
    memcpy(out->depth, r.depth, sizeof out->depth);
    out->camera = s.camera;
    return ok;
}

/* The code of a channel in fog. */
static double code_in_fog(uint32_t color, int shift, double part, bool linear)
{
    const double a = color >> shift & 255u, b = FOG >> shift & 255;
    return linear ? code_of(light_of(a) * (1 - part) + light_of(b) * part) : a * (1 - part) + b * part;
}

/* How far a picture is off, in codes: pixels off by more than four, as at borders of texels may be what shows the neighbour;
 * root of the mean square of the others. */
static void compare(const uint32_t *got, const struct seen *seen, bool linear, double *rms, int *beyond)
{
    double sum = 0;
    *beyond = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double part = fmin(fmax((distance_of(&seen->camera, seen->depth[i]) - fog_near) / (fog_far - fog_near), 0), 1);
        double most = 0, here = 0;
        for (int shift = 0; shift < 24; shift += 8) {
            const double off = fabs(code_in_fog(seen->color[i], shift, part, linear) - (got[i] >> shift & 255u));
            most = fmax(most, off);
            here += off * off;
        }
        *beyond += most > 4.0;
        sum += most > 4.0 ? 0 : here;
        if (seen->depth[i] == 0 || part >= 1)       /* nothing shows through what was cut */
            CHECK(most < 4.0);
    }
    *rms = sqrt(sum / (3.0 * PIXELS));
}

static void check_accuracy(int method, bool linear, bool flat_depth, const struct seen *seen)
{
    struct scene s;
    smear_mesh road;
    const smear_desc desc = desc_of(ALL_METHODS);
    const smear_fog fog = fog_between(fog_near, fog_far);
    const int count = make_road(&s, &road, method, flat_depth);
    s.frame.light_space = linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED;
    s.frame.clear = 0xff00ff;           /* counts for nothing */
    s.frame.fog = &fog;
    RIG(r, &desc, false);
    CHECK_EQ(rig_frame(&r, &s.frame, s.draw, count), SMEAR_OK);
    double rms;
    int beyond;
    compare((const uint32_t *)(const void *)r.picture, seen, linear, &rms, &beyond);
    CHECK(rms < 1.0);
    CHECK(beyond <= PIXELS / 400);
    CHECK(guards_intact(&r));
}

static void test_each_pixel_has_the_fog_of_its_depth(void)
{
    static struct seen seen;
    for (int linear = 0; linear < 2; linear++)
        for (int flat_depth = 0; flat_depth < 2; flat_depth++) {
            if (!see(&seen, linear != 0, flat_depth != 0))
                continue;
            for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++)
                check_accuracy(method, linear != 0, flat_depth != 0, &seen);
        }
}

/* ------------------------------------------------------------------ what is cut */

static void test_what_lies_beyond_is_left_out(void)
{
    struct rig r;
    const smear_desc desc = desc_of(ALL_METHODS);
    for (int k = 0; k < 4 && rig_begin(&r, &desc, false); k++) {
        struct scene s;
        smear_stats stats;
        const smear_fog fog = fog_between(0.2, k < 3 ? 3.0 : 100.0);
        smear_mesh known = cube;
        make_scene(&s, 0, k == 1 ? SMEAR_AUTO : SMEAR_NONE);
        smear_mesh_find_bounds(&known);
        for (int i = 1; i < 3; i++)
            s.draw[i].mesh = k == 2 ? &known : &cube;
        s.frame.fog = &fog;
        CHECK_EQ(rig_frame(&r, &s.frame, s.draw + 1, 2), SMEAR_OK);
        smear_get_stats(r.ctx, &stats);
        CHECK_EQ(stats.draws_beside, k == 2 ? 2 : 0);
        CHECK((stats.triangles_drawn != 0) == (k == 3));
        const uint32_t *picture = (const uint32_t *)(const void *)r.picture;
        int other = 0;
        for (int i = 0; i < PIXELS; i++)
            other += picture[i] != FOG;
        CHECK((other != 0) == (k == 3));
        rig_end(&r);
    }
}

/* Fog that begins behind everything changes nothing. */
static void test_what_is_nearer_than_fog_stays_as_it_is(void)
{
    const smear_desc desc = desc_of(ALL_METHODS);
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++) {
        struct rig r;
        uint8_t *without = NULL;
        const smear_fog fog = fog_between(200, 300);
        for (int k = 0; k < 2 && rig_begin(&r, &desc, false); k++) {
            struct scene s;
            CHECK_EQ(render_scene(&r, 0.1, method), SMEAR_OK);
            make_scene(&s, 0.2, method);
            s.frame.fog = k == 1 ? &fog : NULL;
            s.frame.clear = FOG;
            uint8_t *picture = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
            if (k == 1)
                CHECK(without != NULL && picture != NULL && memcmp(without, picture, PIXELS * 4) == 0);
            free(without);
            without = k == 0 ? picture : NULL;
            if (k == 1)
                free(picture);
            rig_end(&r);
        }
    }
}

/* ------------------------------------------------------------------ the same bits */

enum { TINY = 1500 };

/* Triangles of a pixel or two. */
static smear_mesh tiny_triangles(void)
{
    static int16_t place[TINY * 9];
    static uint16_t index[TINY * 3];
    random_state = 71;
    for (int i = 0; i < TINY * 3; i++)
        for (int k = 0; k < 3; k++) {
            const int size = k == 2 ? 20 : 26, at = k == 2 ? between(-1500, -800) : between(-700, 700);
            place[3 * i + k] = (int16_t)(i % 3 == 0 ? at : place[3 * (i - i % 3) + k] + between(-size, size));
            index[i] = (uint16_t)i;
        }
    return (smear_mesh){ .position = place, .index = index, .vertex_count = TINY * 3, .triangle_count = TINY, .shift = STEP };
}

/* White texels in grey light and grey fog are grey, and as triangles without a texture. */
static void test_tiny_triangles_with_texels_have_their_fog(void)
{
    static int16_t uv[TINY * 6];
    static uint8_t grey[TINY * 12];
    static const uint32_t white = 0xffffffffu;
    static const smear_texture texture = { .texels = &white, .width = 1, .height = 1 };
    uint8_t *picture = NULL;
    smear_mesh mesh = tiny_triangles();
    for (int i = 0; i < TINY * 3; i++)
        memset(grey + 4 * i, 40 + i * 7 % 160, 4), grey[4 * i + 3] = 255;
    mesh.color = grey;
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_fog fog = { .color = 0x808080, .near_plane = q16(fog_near), .far_plane = q16(fog_far) };
    for (int k = 0; k < 4; k++) {
        const smear_desc desc = desc_of(SMEAR_SET(SMEAR_NONE));
        const smear_material material = { .texture = k % 2 == 1 ? &texture : NULL, .double_sided = 1, .unlit = 1 };
        const smear_draw draw = { .mesh = &mesh, .material = &material };
        const smear_frame frame = { .camera = &camera, .method = SMEAR_NONE, .fog = &fog,
                                    .light_space = (uint8_t)(k < 2 ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED) };
        mesh.uv = k % 2 == 1 ? uv : NULL;
        RIG(r, &desc, false);
        CHECK_EQ(rig_frame(&r, &frame, &draw, 1), SMEAR_OK);
        int colored = 0, other = 0;
        for (int i = 0; i < PIXELS; i++) {
            const uint8_t *p = r.picture + 4 * i;
            colored += p[0] != p[1] || p[1] != p[2];
            other += k % 2 == 1 && picture != NULL && abs(p[0] - picture[4 * i]) > 4;
        }
        CHECK_EQ(colored, 0);
        CHECK(other <= 2);                  /* of one depth, another one may be in front */
        free(picture);
        picture = malloc(PIXELS * 4);
        if (CHECK(picture != NULL))
            memcpy(picture, r.picture, PIXELS * 4);
    }
    free(picture);
}

/* Walls along the view, of few columns each, within which fog changes much: of one colour, with colours at the vertices, with a
 * texture, with one that is cut out. */
static void test_walls_that_recede_have_their_fog(void)
{
    enum { WALLS = 8, SHIFT = 8 };
    static struct seen seen;
    static int16_t place[WALLS * 12], uv[WALLS * 8];
    static uint16_t index[WALLS * 6];
    static uint8_t color[WALLS * 16];
    static const uint32_t black[4] = { 0xff000000u, 0xff000000u, 0xff000000u, 0xff000000u };
    static const smear_texture texture = { .texels = black, .width = 2, .height = 2 };
    for (int i = 0; i < WALLS * 4; i++) {
        const int wall = i / 4, corner = i % 4;
        place[3 * i] = (int16_t)((wall * 2 - WALLS + 1) * 60);
        place[3 * i + 1] = (int16_t)(corner < 2 ? -150 : 150);
        place[3 * i + 2] = (int16_t)(-1200 + 60 * wall - (corner == 0 || corner == 3 ? 0 : 60));
        color[4 * i + corner % 3] = 20;
        color[4 * i + 3] = 255;
    }
    for (int i = 0; i < WALLS * 6; i++)
        index[i] = (uint16_t)(i / 6 * 4 + (int[]){ 0, 1, 2, 0, 2, 3 }[i % 6]);
    const smear_camera camera = camera_at(0, 0, 0, 0);
    const smear_fog fog = fog_between(fog_near, fog_far);
    for (int k = 0; k < 8; k++) {
        const smear_mesh mesh = { .position = place, .index = index, .uv = k / 2 >= 2 ? uv : NULL, .color = k / 2 == 1 ? color : NULL,
                                  .vertex_count = WALLS * 4, .triangle_count = WALLS * 2, .shift = SHIFT };
        const uint8_t shade = k / 2 == 1 ? 255 : 0;
        const smear_material material = { .texture = k / 2 >= 2 ? &texture : NULL, .color = { shade, shade, shade, 255 }, .double_sided = 1,
                                          .unlit = 1, .alpha = k / 2 == 3 ? SMEAR_CUTOUT : SMEAR_OPAQUE };
        const smear_draw draw = { .mesh = &mesh, .material = &material };
        for (int in_fog = 0; in_fog < 2; in_fog++) {
            const smear_desc desc = desc_of(SMEAR_SET(SMEAR_NONE) | SMEAR_SET(SMEAR_RECONSTRUCT));
            const smear_frame frame = { .camera = &camera, .method = in_fog ? SMEAR_NONE : SMEAR_RECONSTRUCT, .clear = FOG,
                                        .fog = in_fog ? &fog : NULL,
                                        .light_space = (uint8_t)(k % 2 ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED) };
            RIG(r, &desc, true);
            CHECK_EQ(rig_frame(&r, &frame, &draw, 1), SMEAR_OK);
            if (in_fog) {
                double rms;
                int beyond;
                compare((const uint32_t *)(const void *)r.picture, &seen, k % 2 != 0, &rms, &beyond);
                CHECK(rms < 1.0);
                CHECK(beyond <= (k < 4 ? 0 : 20));      /* rows of up to four texels have one part */
            } else {
                memcpy(seen.color, r.color, sizeof seen.color);
                memcpy(seen.depth, r.depth, sizeof seen.depth);
                seen.camera = camera;
            }
        }
    }
}

#include "build/suites/fog.h"
