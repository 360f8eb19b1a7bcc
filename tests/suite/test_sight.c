/* SPDX-License-Identifier: MIT */
/* test_sight.c - why nothing of a scene is seen (tools/scenes/sight.h, tools/player/unseen.h): triangles are put before a camera, behind
 * it, beside what it sees and so on, and each must be counted for what it is. SIGHT_SCENES=n makes n scenes. */
#include "tests/host.h"

#include "tools/scenes/sight.h"
#include "tools/scenes/xform.h"

enum place { TRANSPARENT, NEAR, FAR, BESIDE, BACK, FACING, PLACES };
enum { MOST = 24 };

static struct {
    struct scene_surface surface[MOST];
    struct scene_draw draw[MOST];
    float position[MOST][9];
    uint32_t index[MOST][3];
    int count[PLACES];
} made;

static struct xform random_turn(void)
{
    return xform_mul(xform_turn_x(uniform(-3, 3)), xform_mul(xform_turn_y(uniform(-3, 3)), xform_turn_z(uniform(-3, 3))));
}

static struct xform inverse_rigid(struct xform a)
{
    struct vec3 x = vec3(a.m[0], a.m[4], a.m[8]), y = vec3(a.m[1], a.m[5], a.m[9]), z = vec3(a.m[2], a.m[6], a.m[10]);
    struct xform r = xform_axes(x, y, z, vec3(0, 0, 0));
    struct vec3 o = xform_direction(r, vec3(-a.m[12], -a.m[13], -a.m[14]));
    r.m[12] = o.x;
    r.m[13] = o.y;
    r.m[14] = o.z;
    return r;
}

/* The middle of a small triangle in the camera's space, where the view is `half` high at distance 1, or everywhere. */
static struct vec3 middle_of(enum place place, const struct scene_camera *c, double aspect)
{
    double near = c->znear, far = c->zfar, away = uniform(near + 1, far - 1);
    double reach = c->orthographic ? c->half_height : away * tan(c->yfov / 2);
    struct vec3 at = vec3(uniform(-0.8, 0.8) * reach * aspect, uniform(-0.8, 0.8) * reach, -away);
    if (place == NEAR)
        at = vec3(at.x, at.y, -near + uniform(0.6, 30));
    if (place == FAR)
        at = vec3(at.x, at.y, -far - uniform(0.6, 30));
    if (place == BESIDE && chance(2))
        at.x = (chance(2) ? -1 : 1) * (reach * aspect * 2 + 2);
    else if (place == BESIDE)
        at.y = (chance(2) ? -1 : 1) * (reach * 2 + 2);
    return at;
}

/* A triangle whose front is, or is not, turned to the camera, about the middle. */
static void corners_about(struct vec3 at, bool faces, bool orthographic, struct vec3 out[3])
{
    double size = uniform(0.05, 0.25), turn = uniform(0, 6);
    struct vec3 towards = orthographic ? vec3(0, 0, 1) : vec3_unit(vec3_scale(at, -1));
    struct vec3 x = vec3_unit(vec3_cross(vec3(0.3, 1, 0.2), towards)), y = vec3_cross(towards, x);
    for (int i = 0; i < 3; i++) {
        double angle = turn + (faces ? 1 : -1) * i * 2.0944;
        out[i] = vec3_add(at, vec3_add(vec3_scale(x, size * cos(angle)), vec3_scale(y, size * sin(angle))));
    }
}

static void add_triangle(int i, enum place place, const struct scene_camera *c, double aspect)
{
    struct scene_surface *s = &made.surface[i];
    struct scene_draw *d = &made.draw[i];
    bool is_mirrored = chance(2), is_double = place == FACING && chance(3);
    struct xform world = xform_mul(xform_move(uniform(-9, 9), uniform(-9, 9), uniform(-9, 9)), random_turn()), camera;
    struct xform back = inverse_rigid(world);
    struct vec3 corner[3];
    memcpy(camera.m, c->pose, sizeof camera.m);
    corners_about(middle_of(place, c, aspect), is_double ? chance(2) : place != BACK, c->orthographic, corner);
    *s = (struct scene_surface){ .vertex_count = 3, .triangle_count = 1, .position = made.position[i], .index = made.index[i],
                                 .material = { .base = { 1, 1, 1, 1 }, .double_sided = is_double } };
    if (place == TRANSPARENT) {
        s->material.alpha = chance(2) ? MODEL_ALPHA_BLEND : MODEL_ALPHA_MASK;
        s->material.base[3] = s->material.alpha == MODEL_ALPHA_BLEND ? 0 : 0.25f;
        s->material.alpha_cutoff = 0.5f;
    }
    *d = (struct scene_draw){ .surface = s, .position = made.position[i] };
    for (int k = 0; k < 3; k++) {
        struct vec3 p = xform_point(back, xform_point(camera, corner[k]));
        made.position[i][3 * k] = (float)(is_mirrored ? -p.x : p.x);
        made.position[i][3 * k + 1] = (float)p.y;
        made.position[i][3 * k + 2] = (float)p.z;
        /* In a mirrored world the winding of fronts is the other one. */
        made.index[i][k] = (uint32_t)(is_mirrored ? 2 - k : k);
    }
    if (is_mirrored)
        world = xform_mul(world, xform_scale(-1, 1, 1));
    memcpy(d->world, world.m, sizeof d->world);
}

static void test_triangles_are_counted_by_what_hides_them(void)
{
    const int scenes = (int)number_from("SIGHT_SCENES", 2000);
    random_state = 1;
    for (int n = 0; n < scenes; n++) {
        struct xform pose = xform_mul(xform_move(uniform(-20, 20), uniform(-20, 20), uniform(-20, 20)), random_turn());
        struct scene_instant instant = { .camera = { .orthographic = chance(3), .yfov = uniform(0.5, 1.5), .half_height = uniform(2, 9),
                                                     .znear = uniform(0.5, 3), .zfar = uniform(20, 60) },
                                         .draw = made.draw, .draw_count = between(1, MOST) };
        double aspect = uniform(0.5, 2);
        int count[PLACES] = { 0 }, hidden = 0;
        struct sight sight;
        memcpy(instant.camera.pose, pose.m, sizeof instant.camera.pose);
        for (int i = 0; i < instant.draw_count; i++) {
            enum place place = (enum place)between(0, PLACES - 1);
            add_triangle(i, place, &instant.camera, aspect);
            made.draw[i].hidden = chance(8);
            hidden += made.draw[i].hidden;
            count[place] += !made.draw[i].hidden;
        }
        sight_find(&instant, aspect, &sight);
        CHECK_EQ(sight.triangles, instant.draw_count - hidden);
        CHECK_EQ(sight.transparent, count[TRANSPARENT]);
        CHECK_EQ(sight.near, count[NEAR]);
        CHECK_EQ(sight.far, count[FAR]);
        CHECK_EQ(sight.beside, count[BESIDE]);
        CHECK_EQ(sight.backs, count[BACK]);
        CHECK_EQ(sight.facing, count[FACING]);
        CHECK(sight.back_pixels == 0 || count[BACK] > 0);
        CHECK(sight.back_pixels <= sight.pixels && (sight.pixels == 0 || count[BACK] + count[FACING] > 0));
    }
}

/* A cube, seen from outside, with faces wound outwards or inwards. */
static void test_a_cube_is_all_front_or_all_back(void)
{
    static const float corner[8][3] = { { -1, -1, -1 }, { 1, -1, -1 }, { -1, 1, -1 }, { 1, 1, -1 },
                                        { -1, -1, 1 }, { 1, -1, 1 }, { -1, 1, 1 }, { 1, 1, 1 } };
    static const uint32_t out[36] = { 4, 5, 7, 4, 7, 6, 1, 0, 2, 1, 2, 3, 5, 1, 3, 5, 3, 7,
                                      0, 4, 6, 0, 6, 2, 6, 7, 3, 6, 3, 2, 0, 1, 5, 0, 5, 4 };
    random_state = 2;
    for (int n = 0; n < 200; n++) {
        bool inwards = chance(2);
        uint32_t index[36];
        for (int i = 0; i < 36; i++)
            index[i] = out[inwards ? i / 3 * 3 + 2 - i % 3 : i];
        const struct scene_surface surface = { .vertex_count = 8, .triangle_count = 12, .position = corner[0], .index = index,
                                               .material = { .base = { 1, 1, 1, 1 } } };
        struct scene_draw draw = { .surface = &surface, .position = corner[0] };
        struct xform none = xform_identity(), pose = xform_mul(random_turn(), xform_move(0, 0, uniform(4, 9)));
        struct scene_instant instant = { .camera = { .yfov = 0.8, .znear = 0.1, .zfar = 50 }, .draw = &draw, .draw_count = 1 };
        struct sight sight;
        memcpy(draw.world, none.m, sizeof draw.world);
        memcpy(instant.camera.pose, pose.m, sizeof instant.camera.pose);
        sight_find(&instant, 4.0 / 3, &sight);
        CHECK(sight.pixels > 100);
        CHECK_EQ(sight.back_pixels, inwards ? sight.pixels : 0);
    }
}

#include "build/suites/sight.h"
