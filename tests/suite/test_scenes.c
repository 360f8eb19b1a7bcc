/* SPDX-License-Identifier: MIT */
/* test_scenes.c - built-in scenes are what their names promise, and files become the scenes of the
 * command-line contract. Pictures come from the reference renderer. */
#include "tests/host.h"

#include "tools/ref/ref.h"

#include "tools/model/model.h"
#include "tools/scenes/build.h"
#include "tools/scenes/color.h"
#include "tools/scenes/scene.h"
#include "tools/scenes/stage.h"

#define PI 3.14159265358979323846

/* ------------------------------------------------------------------ scenes at hand */

/* A built-in scene with room for two instants. */
struct shown {
    struct scene scene;
    struct scene_instant now, before;
    struct failure f;
};

static bool open_scene(struct shown *s, const char *name)
{
    *s = (struct shown){0};
    return CHECK(scene_builtin(name, &s->scene, &s->f));
}

static void close_scene(struct shown *s)
{
    scene_instant_free(&s->scene, &s->now);
    scene_instant_free(&s->scene, &s->before);
    scene_free(&s->scene);
}

static bool is_in(const char *name, const char *family)
{
    return strncmp(name, family, strlen(family)) == 0;
}

static struct vec3 read3(const float *from, uint32_t i)
{
    return vec3((double)from[3 * i], (double)from[3 * i + 1], (double)from[3 * i + 2]);
}

static struct xform world_of(const struct scene_draw *draw)
{
    struct xform world;
    memcpy(world.m, draw->world, sizeof world.m);
    return world;
}

/* ------------------------------------------------------------------ catalogue */

static void surface_is_sound(const struct scene_surface *s)
{
    int wild = 0, odd = 0;
    for (int i = 0; i < 3 * s->triangle_count; i++)
        wild += s->index[i] >= (uint32_t)s->vertex_count;
    for (int i = 0; i < 3 * s->vertex_count; i++)
        odd += !isfinite(s->position[i]) || fabsf(s->position[i]) > 1000;
    CHECK_EQ(wild, 0);
    CHECK_EQ(odd, 0);
    CHECK(s->vertex_count <= 65535);
    CHECK(s->material.image == NULL || s->uv != NULL);
    CHECK(s->color == NULL || s->face_color == NULL);
}

static void test_every_scene_of_the_catalogue_can_be_posed_at_any_time(void)
{
    static const double times[] = {0.5, 0, -3.7, 0.4667, 812.31};
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!open_scene(&s, scene_catalog[i].name))
            continue;
        CHECK(strcmp(s.scene.name, scene_catalog[i].name) == 0);
        int least = is_in(s.scene.name, "fail/") ? 16 : 240;
        CHECK(s.scene.width >= least && s.scene.height >= least && s.scene.fps == 30);
        int draws = 0;
        for (size_t k = 0; k < sizeof times / sizeof *times; k++) {
            CHECK(scene_pose(&s.scene, times[k], &s.now, &s.f));
            CHECK(k == 0 || s.now.draw_count == draws);
            draws = s.now.draw_count;
            CHECK(s.now.camera.znear > 0 && s.now.camera.zfar > s.now.camera.znear);
            for (int d = 0; d < draws; d++)
                CHECK(isfinite(s.now.draw[d].world[12]) && isfinite(s.now.draw[d].world[0]));
        }
        for (int d = 0; d < draws; d++)
            surface_is_sound(s.now.draw[d].surface);
        CHECK(!scene_pose(&s.scene, NAN, &s.now, &s.f));
        CHECK(!scene_pose(&s.scene, 1e9, &s.now, &s.f));
        close_scene(&s);
    }
}

static void test_names_are_unique_and_unknown_ones_are_refused(void)
{
    for (int i = 0; i < scene_catalog_count; i++)
        for (int k = 0; k < i; k++)
            CHECK(strcmp(scene_catalog[i].name, scene_catalog[k].name) != 0);
    struct scene scene;
    struct failure f = {0};
    CHECK(!scene_builtin("suite/nothing", &scene, &f));
    CHECK(f.text[0] != '\0');
}

/* Posing at other times in between leaves no trace. */
static void test_a_pose_depends_on_nothing_but_time(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!open_scene(&s, scene_catalog[i].name))
            continue;
        CHECK(scene_pose(&s.scene, 0.31, &s.before, &s.f));
        CHECK(scene_pose(&s.scene, 7.7, &s.now, &s.f));
        CHECK(scene_pose(&s.scene, 0.31, &s.now, &s.f));
        CHECK(memcmp(s.now.camera.pose, s.before.camera.pose, sizeof s.now.camera.pose) == 0);
        for (int d = 0; d < s.now.draw_count; d++) {
            const struct scene_draw *a = &s.now.draw[d], *b = &s.before.draw[d];
            CHECK(memcmp(a->world, b->world, sizeof a->world) == 0 && a->epoch == b->epoch);
            size_t bytes = (size_t)a->surface->vertex_count * 3 * sizeof(float);
            CHECK(memcmp(a->position, b->position, bytes) == 0);
            CHECK(a->normal == NULL || memcmp(a->normal, b->normal, bytes) == 0);
        }
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ shapes */

enum { SHAPES = 5 };

/* Closed solids of known volume, up to how well flat facets fill a round one. */
static void shapes_build(struct stage *stage)
{
    for (int i = 0; i < SHAPES; i++) {
        struct build b = build_begin(stage, i == 1 || i == 2 ? BUILD_NORMAL : 0);
        const struct vec3 wedge[6] = {
            vec3(0, 0, 0), vec3(2, 0, 0), vec3(0, 2, 0),
            vec3(0, 0, 3), vec3(2, 0, 3), vec3(0, 2, 3),
        };
        const double cone[6] = {0, 0, 1, 0, 0, 2};
        switch (i) {
        case 0: build_box(&b, vec3(-1, -2, 0), vec3(1, 1, 3)); break;
        case 1: build_ball(&b, 2, 64, 64); break;
        case 2: build_drum(&b, 1, 0.5, -1, 1, 64); break;
        case 3: build_loft(&b, wedge, 2, 3); break;
        default: build_lathe(&b, cone, 3, 64); break;
        }
        stage_add(stage, build_finish(&b));
    }
}

static void shapes_move(const struct stage *stage, double time, struct scene_instant *out)
{
    (void)stage;
    (void)time;
    (void)out;
}

static void test_shapes_are_closed_and_face_outward(void)
{
    static const struct stage_kind kind = {"shapes", 64, 64, 0, 0, shapes_build, shapes_move};
    const double volume[SHAPES] = {18, 32.0 / 3 * PI, 3.5 / 3 * PI, 6, 2.0 / 3 * PI};
    struct shown s = {0};
    REQUIRE(stage_open(&kind, 1, "shapes", &s.scene, &s.f));
    CHECK(scene_pose(&s.scene, 0, &s.now, &s.f));
    for (int i = 0; i < SHAPES; i++) {
        const struct scene_surface *surface = s.now.draw[i].surface;
        double six = 0;
        struct vec3 area = vec3(0, 0, 0);
        for (int t = 0; t < surface->triangle_count; t++) {
            const uint32_t *v = surface->index + 3 * t;
            struct vec3 a = read3(surface->position, v[0]), b = read3(surface->position, v[1]);
            struct vec3 c = read3(surface->position, v[2]);
            struct vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
            six += vec3_dot(a, vec3_cross(b, c));
            area = vec3_add(area, n);
            if (surface->normal != NULL)
                CHECK(vec3_dot(n, read3(surface->normal, v[0])) >= 0);
        }
        CHECK_CLOSE(six / 6 / volume[i], 0.995, 0.0051);
        CHECK(vec3_length(area) < 1e-3);
    }
    close_scene(&s);
}

/* ------------------------------------------------------------------ peers */

/* Triangles, then pixels at 320x240, of the peers' common list: mean of frames 0..7. */
static const struct peer_counts {
    const char *name;
    double outside, back, front, touching, fragments, passed;
} peer_counts[] = {
    {"peer/A", 0, 47668, 22332, 13055, 29203, 28588},
    {"peer/B64", 254, 472, 785, 772, 174330, 160077},
    {"peer/C", 0, 0, 40, 40, 1536000, 1536000},
    {"peer/D", 566, 0, 50634, 46113, 71775, 71775},
    {"peer/E", 2, 697, 581, 577, 132104, 89961},
    {"peer/F", 0, 7162, 3338, 2915, 29118, 28502},
    {"peer/G", 34166, 12871, 13803, 11800, 63761, 60492},
};

enum { PEER_WIDTH = 320, PEER_HEIGHT = 240 };

struct point {
    double x, y, w;             /* pixels; 1 / distance */
};

struct corner {
    double x, y, w;             /* clip space; w is the distance */
};

/* 320x240, 60 degrees, camera at the origin along -z: true of all peers. */
static struct corner peer_corner(struct xform world, struct vec3 position)
{
    struct vec3 p = xform_point(world, position);
    double focal = 1 / tan(PI / 6);
    return (struct corner){p.x * focal * PEER_HEIGHT / PEER_WIDTH, p.y * focal, -p.z};
}

static bool is_outside(const struct corner c[3])
{
    int beyond[6] = {0};
    for (int k = 0; k < 3; k++) {
        beyond[0] += c[k].x > c[k].w;
        beyond[1] += -c[k].x > c[k].w;
        beyond[2] += c[k].y > c[k].w;
        beyond[3] += -c[k].y > c[k].w;
        beyond[4] += c[k].w < 0.25;
        beyond[5] += c[k].w > 64;
    }
    for (int i = 0; i < 6; i++)
        if (beyond[i] == 3)
            return true;
    return false;
}

/* Sutherland and Hodgman against the near plane: up to four points. */
static int cut_near(const struct corner in[3], struct point out[4])
{
    int count = 0;
    for (int i = 0; i < 3; i++) {
        struct corner a = in[i], b = in[(i + 1) % 3], kept[2];
        int keep = 0;
        double t = (a.w - 0.25) / (a.w - b.w);
        if (a.w >= 0.25)
            kept[keep++] = a;
        if ((a.w >= 0.25) != (b.w >= 0.25))
            kept[keep++] = (struct corner){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, 0.25};
        for (int k = 0; k < keep; k++)
            out[count++] = (struct point){(1 + kept[k].x / kept[k].w) / 2 * PEER_WIDTH,
                                           (1 - kept[k].y / kept[k].w) / 2 * PEER_HEIGHT,
                                          1 / kept[k].w};
    }
    return count;
}

static double edge(struct point a, struct point b, double x, double y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/* Counter-clockwise with y down: inside is negative; an edge through a pixel centre owns it when
 * it is a top or a left one. Adds to `counts`, returns the pixels. */
static int count_triangle(const struct point t[3], double *nearest, struct peer_counts *counts)
{
    double x0 = fmin(t[0].x, fmin(t[1].x, t[2].x)), x1 = fmax(t[0].x, fmax(t[1].x, t[2].x));
    double y0 = fmin(t[0].y, fmin(t[1].y, t[2].y)), y1 = fmax(t[0].y, fmax(t[1].y, t[2].y));
    int left = (int)fmax(0, ceil(x0 - 0.5)), right = (int)fmin(PEER_WIDTH - 1, floor(x1 - 0.5));
    int top = (int)fmax(0, ceil(y0 - 0.5)), bottom = (int)fmin(PEER_HEIGHT - 1, floor(y1 - 0.5));
    int pixels = 0;
    for (int y = top; y <= bottom; y++)
        for (int x = left; x <= right; x++) {
            double sum = 0, w = 0;
            bool inside = true;
            for (int k = 0; k < 3 && inside; k++) {
                struct point a = t[(k + 1) % 3], b = t[(k + 2) % 3];
                double e = edge(a, b, x + 0.5, y + 0.5);
                inside = e < 0 || (e == 0 && ((a.y == b.y && b.x < a.x) || b.y > a.y));
                sum += e;
                w += e * t[k].w;
            }
            if (!inside)
                continue;
            pixels++;
            if (w / sum > nearest[y * PEER_WIDTH + x]) {
                nearest[y * PEER_WIDTH + x] = w / sum;
                counts->passed++;
            }
        }
    counts->fragments += pixels;
    return pixels;
}

static void count_draw(const struct scene_draw *draw, double *nearest, struct peer_counts *counts)
{
    const struct scene_surface *s = draw->surface;
    struct xform world = world_of(draw);
    for (int t = 0; t < s->triangle_count; t++) {
        struct corner c[3];
        struct point part[4];
        for (int k = 0; k < 3; k++)
            c[k] = peer_corner(world, read3(s->position, s->index[3 * t + k]));
        double turn = c[0].x * (c[1].y * c[2].w - c[2].y * c[1].w) -
                      c[1].x * (c[0].y * c[2].w - c[2].y * c[0].w) +
                      c[2].x * (c[0].y * c[1].w - c[1].y * c[0].w);
        if (is_outside(c)) {
            counts->outside++;
            continue;
        }
        if (turn <= 0) {
            counts->back++;
            continue;
        }
        counts->front++;
        int corners = cut_near(c, part), pixels = 0;
        for (int k = 1; k + 1 < corners; k++)
            pixels += count_triangle((struct point[3]){part[0], part[k], part[k + 1]}, nearest,
                                     counts);
        counts->touching += pixels > 0;
    }
}

static void count_frame(const struct scene_instant *instant, struct peer_counts *counts)
{
    double *nearest = calloc(PEER_WIDTH * PEER_HEIGHT, sizeof *nearest);
    if (CHECK(nearest != NULL))
        for (int i = 0; i < instant->draw_count; i++)
            count_draw(&instant->draw[i], nearest, counts);
    free(nearest);
}

static void test_peer_scenes_give_the_counts_that_every_peer_was_measured_with(void)
{
    for (size_t i = 0; i < sizeof peer_counts / sizeof *peer_counts; i++) {
        const struct peer_counts *want = &peer_counts[i];
        struct peer_counts got = {0};
        struct shown s;
        if (!open_scene(&s, want->name))
            continue;
        for (int k = 0; k < 8; k++) {
            CHECK(scene_pose(&s.scene, k / 30.0, &s.now, &s.f));
            CHECK_CLOSE(s.now.camera.yfov, PI / 3, 1e-12);
            count_frame(&s.now, &got);
        }
        CHECK_CLOSE(got.outside / 8, want->outside, 0.51);
        CHECK_CLOSE(got.back / 8, want->back, 0.51);
        CHECK_CLOSE(got.front / 8, want->front, 0.51);
        CHECK_CLOSE(got.touching / 8, want->touching, 0.51);
        CHECK_CLOSE(got.fragments / 8, want->fragments, 0.51);
        CHECK_CLOSE(got.passed / 8, want->passed, 0.51);
        close_scene(&s);
    }
}

static void test_peer_colors_are_whole_display_codes(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!is_in(scene_catalog[i].name, "peer/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        CHECK(scene_pose(&s.scene, 0, &s.now, &s.f));
        CHECK_EQ(s.scene.clear, 0x101830);
        const struct scene_surface *surface = s.now.draw[0].surface;
        const float *color = surface->face_color != NULL ? surface->face_color : surface->color;
        int count = surface->face_color != NULL ? surface->triangle_count : surface->vertex_count;
        double worst = 0;
        for (int k = 0; color != NULL && k < 4 * count; k++)
            if (k % 4 != 3) {
                double code = 255 * color_encode((double)color[k]);
                worst = fmax(worst, fabs(code - floor(code + 0.5)));
            }
        CHECK(worst < 1e-3);
        CHECK(surface->material.unlit == (surface->normal == NULL));
        CHECK((color != NULL) == (surface->material.image == NULL));
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ pictures */

static bool draw_at(struct shown *s, double time, double earlier, struct ref_frame *out)
{
    struct ref_options options = {.width = s->scene.width, .height = s->scene.height,
                                  .encoded = true, .clear = s->scene.clear};
    return CHECK(scene_pose(&s->scene, time, &s->now, &s->f)) &&
           CHECK(scene_pose(&s->scene, earlier, &s->before, &s->f)) &&
           CHECK(ref_draw(&s->now, &s->before, &s->now, &options, out, &s->f));
}

static double speed_at(const struct ref_frame *frame, int pixel)
{
    return hypot(frame->velocity[2 * pixel], frame->velocity[2 * pixel + 1]);
}

static double fastest(const struct ref_frame *frame)
{
    double most = 0;
    for (int i = 0; i < frame->width * frame->height; i++)
        most = fmax(most, speed_at(frame, i));
    return most;
}

/* RMSE of the sharp frame against the blurred one, in codes of encoded light. */
static double error_of_none(struct shown *s)
{
    struct ref_truth_options options = {.time = s->scene.time, .shutter_degrees = 180,
                                        .instants = 24, .encoded = true, .threads = 2};
    struct ref_truth truth = {0};
    struct ref_frame sharp OWNED(ref_frame_free) = {0};
    double sum = -1;
    if (draw_at(s, s->scene.time, s->scene.time, &sharp) &&
        CHECK(ref_truth(&s->scene, &options, &truth, &s->f))) {
        int values = 3 * sharp.width * sharp.height;
        sum = 0;
        for (int i = 0; i < values; i++)
            sum += pow(255 * sharp.color[i] - truth.code[i], 2) / values;
    }
    ref_truth_free(&truth);
    return sqrt(sum);
}

/* RMSE of the study whose scenes the suite's are named after. */
static const struct { const char *name; double error; } study[] = {
    {"suite/translate", 9.01}, {"suite/propeller", 13.27}, {"suite/pan", 19.72},
    {"suite/dolly", 11.82}, {"suite/roll", 24.67}, {"suite/cross", 13.87},
    {"suite/fence_fg", 30.60}, {"suite/fence_obj", 11.47}, {"suite/enter", 10.90},
    {"suite/near", 9.71}, {"suite/long", 17.26}, {"suite/subpixel", 1.41}, {"suite/skin", 6.78},
    {"suite/swarm", 17.43}, {"suite/still", 0}, {"suite/teleport", 3.06},
    {"suite/textured", 27.83}, {"suite/morph", 3.91}, {"suite/cubic", 5.29}, {"suite/arena", 11.10},
};

static void test_suite_scenes_are_as_hard_as_those_of_the_study(void)
{
    int suite = 0;
    for (int i = 0; i < scene_catalog_count; i++)
        suite += is_in(scene_catalog[i].name, "suite/");
    CHECK_EQ(suite, 20);
    for (size_t i = 0; i < sizeof study / sizeof *study; i++) {
        struct shown s;
        if (!open_scene(&s, study[i].name))
            continue;
        CHECK_CLOSE(error_of_none(&s), study[i].error, 0.2 * study[i].error + 1e-9);
        close_scene(&s);
    }
}

/* Pixels per exposure of 180 degrees, where a draw's origin is on screen. */
static double streak(struct shown *s, int draw)
{
    double at[2][2], t = s->scene.time;
    for (int i = 0; i < 2; i++) {
        CHECK(scene_pose(&s->scene, t + (i - 0.5) / 60, &s->now, &s->f));
        const double *m = s->now.camera.pose;
        const double *world = s->now.draw[draw].world;
        struct vec3 d = vec3(world[12] - m[12], world[13] - m[13], world[14] - m[14]);
        double scale = s->scene.height / 2.0 / tan(s->now.camera.yfov / 2);
        double away = -vec3_dot(d, vec3(m[8], m[9], m[10]));
        at[i][0] = scale * vec3_dot(d, vec3(m[0], m[1], m[2])) / away;
        at[i][1] = scale * vec3_dot(d, vec3(m[4], m[5], m[6])) / away;
    }
    return hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
}

static void test_long_has_streaks_of_72_and_92_pixels(void)
{
    struct shown s;
    END_UNLESS(open_scene(&s, "suite/long"));
    CHECK_CLOSE(streak(&s, 1), 92, 2);
    CHECK_CLOSE(streak(&s, 2), 72, 2);
    close_scene(&s);
}

static void test_subpixel_moves_by_about_half_a_pixel_everywhere(void)
{
    struct shown s;
    struct ref_frame frame = {0};
    END_UNLESS(open_scene(&s, "suite/subpixel"));
    if (draw_at(&s, s.scene.time + 1.0 / 120, s.scene.time - 1.0 / 120, &frame)) {
        int odd = 0;
        for (int i = 0; i < frame.width * frame.height; i++)
            if (frame.draw[i] >= 0)
                odd += !(speed_at(&frame, i) >= 0.39 && speed_at(&frame, i) <= 0.70);
        CHECK_EQ(odd, 0);
    }
    ref_frame_free(&frame);
    close_scene(&s);
}

static void test_only_the_named_side_moves(void)
{
    static const char *const objects[] = {
        "translate", "propeller", "cross", "fence_obj", "enter", "near", "long", "skin", "swarm",
        "teleport", "morph", "cubic", "still",
    };
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        bool is_object = false;
        if (!is_in(scene_catalog[i].name, "suite/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        for (size_t k = 0; k < sizeof objects / sizeof *objects; k++)
            is_object = is_object || strcmp(scene_catalog[i].name + 6, objects[k]) == 0;
        double t = s.scene.time;
        CHECK(scene_pose(&s.scene, t - 1.0 / 120, &s.before, &s.f));
        CHECK(scene_pose(&s.scene, t + 1.0 / 120, &s.now, &s.f));
        size_t bytes = sizeof s.now.camera.pose;
        CHECK_EQ(memcmp(s.now.camera.pose, s.before.camera.pose, bytes) == 0, is_object);
        CHECK_EQ(s.now.camera.epoch, s.before.camera.epoch);
        for (int d = 0; d < s.now.draw_count; d++)
            CHECK_EQ(s.now.draw[d].epoch, s.before.draw[d].epoch);
        close_scene(&s);
    }
}

static void test_teleport_cuts_between_the_last_frame_and_the_exposure(void)
{
    struct shown s;
    END_UNLESS(open_scene(&s, "suite/teleport"));
    double t = s.scene.time, trailing = t - 1.0 / 60;
    CHECK(scene_pose(&s.scene, t - 1 / 30.0, &s.before, &s.f));
    CHECK(scene_pose(&s.scene, t, &s.now, &s.f));
    CHECK(s.now.draw[1].epoch != s.before.draw[1].epoch);
    CHECK(fabs(s.now.draw[1].world[12] - s.before.draw[1].world[12]) > 1);
    CHECK(scene_pose(&s.scene, trailing, &s.before, &s.f));
    CHECK_EQ(s.now.draw[1].epoch, s.before.draw[1].epoch);
    close_scene(&s);
}

static void test_trials_move_fast_but_not_beyond_64_pixels(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        struct ref_frame frame = {0};
        if (!is_in(scene_catalog[i].name, "test/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        if (draw_at(&s, s.scene.time, s.scene.time - 1 / 30.0, &frame))
            CHECK_CLOSE(fastest(&frame), 40, 24);
        ref_frame_free(&frame);
        close_scene(&s);
    }
}

static void test_terrain_and_near_are_cut_by_the_near_plane(void)
{
    static const char *const names[] = {"test/terrain", "suite/near", "peer/N"};
    for (int i = 0; i < 3; i++) {
        struct shown s;
        int across = 0;
        if (!open_scene(&s, names[i]))
            continue;
        CHECK(scene_pose(&s.scene, s.scene.time, &s.now, &s.f));
        const double *m = s.now.camera.pose;
        const struct scene_draw *draw = &s.now.draw[s.now.draw_count - 1];
        for (int t = 0; t < draw->surface->triangle_count; t++) {
            int before = 0;
            for (int k = 0; k < 3; k++) {
                struct vec3 p = xform_point(world_of(draw),
                                            read3(draw->position, draw->surface->index[3 * t + k]));
                struct vec3 d = vec3_sub(p, vec3(m[12], m[13], m[14]));
                before += -vec3_dot(d, vec3(m[8], m[9], m[10])) < s.now.camera.znear;
            }
            across += before == 1 || before == 2;
        }
        CHECK(across > 0);
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ demo */

static void test_demos_repeat_after_60_frames(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        if (!is_in(scene_catalog[i].name, "demo/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        for (int k = 0; k < 60; k += 19) {
            struct ref_frame first OWNED(ref_frame_free) = {0}, second = {0};
            if (draw_at(&s, k / 30.0, (k - 1) / 30.0, &first) &&
                draw_at(&s, (k + 60) / 30.0, (k + 59) / 30.0, &second)) {
                int picture = 0, motion = 0;
                for (int p = 0; p < first.width * first.height; p++) {
                    for (int c = 3 * p; c < 3 * p + 3; c++)
                        picture += fabs(first.color[c] - second.color[c]) > 0.5 / 255;
                    motion += fabs(speed_at(&first, p) - speed_at(&second, p)) > 0.01;
                }
                /* Rounding may move a pixel centre over an edge. */
                CHECK_NEAR(picture, 0, 24);
                CHECK_NEAR(motion, 0, 8);
            }
            ref_frame_free(&second);
        }
        close_scene(&s);
    }
}

static void test_demos_are_worth_looking_at(void)
{
    for (int i = 0; i < scene_catalog_count; i++) {
        struct shown s;
        struct ref_frame frame = {0};
        int triangles = 0, textured = 0, fast = 0;
        if (!is_in(scene_catalog[i].name, "demo/") || !open_scene(&s, scene_catalog[i].name))
            continue;
        if (draw_at(&s, s.scene.time, s.scene.time - 1 / 30.0, &frame)) {
            for (int d = 0; d < s.now.draw_count; d++) {
                triangles += s.now.draw[d].surface->triangle_count;
                textured += s.now.draw[d].surface->material.image != NULL;
            }
            /* Streaks of 8 px and more at 180 degrees. */
            for (int p = 0; p < frame.width * frame.height; p++)
                fast += speed_at(&frame, p) >= 16;
            CHECK(triangles >= 500);
            CHECK(textured > 0);
            CHECK(fast > frame.width * frame.height / 10);
            CHECK(fastest(&frame) < 80);
        }
        ref_frame_free(&frame);
        close_scene(&s);
    }
}

/* ------------------------------------------------------------------ files */

/* Bounds (1, 2, 3) to (3, 3, 4): centre (2, 2.5, 3.5), half diagonal sqrt(6) / 2. */
static const char obj_text[] =
    "v 1 2 3\nv 3 2 3\nv 3 3 3\nv 1 3 4\nf 1 2 3\nf 1 3 4\n";

/* A triangle; a perspective camera on a node of uneven scale, turned by 90 degrees about y, and an
 * orthographic one that sees from its own plane on. */
static const char gltf_text[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],"
    "\"nodes\":[{\"mesh\":0},"
    "{\"camera\":0,\"translation\":[7,0.5,0],\"rotation\":[0,0.70710678,0,0.70710678],"
    "\"scale\":[2,3,0.25]},{\"camera\":1,\"translation\":[0,0,4]}],"
    "\"cameras\":[{\"name\":\"side\",\"type\":\"perspective\","
    "\"perspective\":{\"yfov\":0.8,\"znear\":0.5}},"
    "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":3,\"ymag\":2,\"znear\":0,\"zfar\":9}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

struct filed {
    struct model model;
    struct scene scene;
    struct scene_instant now;
    struct failure f;
};

static bool open_file(struct filed *s, const char *text, const struct scene_view *view)
{
    *s = (struct filed){0};
    return CHECK(model_parse((const uint8_t *)text, strlen(text), NULL, &s->model, &s->f)) &&
           CHECK(scene_from_model(&s->model, view, &s->scene, &s->f)) &&
           CHECK(scene_pose(&s->scene, 0, &s->now, &s->f));
}

static void close_file(struct filed *s)
{
    scene_instant_free(&s->scene, &s->now);
    scene_free(&s->scene);
    model_free(&s->model);
}

static bool is_rotation(const double m[16])
{
    struct vec3 x = vec3(m[0], m[1], m[2]), y = vec3(m[4], m[5], m[6]), z = vec3(m[8], m[9], m[10]);
    return fabs(vec3_length(x) - 1) < 1e-9 && fabs(vec3_dot(x, y)) < 1e-9 &&
           vec3_length(vec3_sub(vec3_cross(x, y), z)) < 1e-9 && m[15] == 1;
}

static void test_the_automatic_camera_is_that_of_the_contract(void)
{
    static const double aspects[] = {4.0 / 3, 0.5};
    for (int i = 0; i < 2; i++) {
        struct filed s OWNED(close_file);
        struct scene_view view = {.clip = MODEL_CLIP_NONE, .camera = -1, .aspect = aspects[i]};
        if (open_file(&s, obj_text, &view)) {
            double r = sqrt(6) / 2, y = PI / 4, x = 2 * atan(aspects[i] * tan(y / 2));
            double d = r / sin((i == 0 ? y : x) / 2), unit = sqrt(0.25 + 0.1225 + 1);
            const struct scene_camera *c = &s.now.camera;
            CHECK_CLOSE(c->yfov, y, 1e-12);
            CHECK_CLOSE(c->pose[12], 2 + d * 0.5 / unit, 1e-6);
            CHECK_CLOSE(c->pose[13], 2.5 + d * 0.35 / unit, 1e-6);
            CHECK_CLOSE(c->pose[14], 3.5 + d / unit, 1e-6);
            CHECK_CLOSE(c->pose[8], 0.5 / unit, 1e-9);
            CHECK_CLOSE(c->pose[4 + 1], sqrt(1 - 0.1225 / unit / unit), 1e-9);
            CHECK(is_rotation(c->pose));
            CHECK_CLOSE(c->znear, fmax(d - 2 * r, d / 100), 1e-6);
            CHECK_CLOSE(c->zfar, d + 2 * r, 1e-6);
            CHECK_EQ(s.now.draw_count, 1);
            CHECK_EQ(s.now.draw[0].surface->triangle_count, 2);
            CHECK(s.now.draw[0].node >= 0 && !s.now.draw[0].deformed);
        }
    }
}

static void test_a_given_eye_looks_where_it_is_told_and_sees_the_scene(void)
{
    struct filed s;
    struct scene_view view = {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true,
                              .eye = {2, 12.5, 3.5}, .look = {2, 0, 3.5}, .fov_degrees = 70};
    if (open_file(&s, obj_text, &view)) {
        const struct scene_camera *c = &s.now.camera;
        CHECK(is_rotation(c->pose));
        CHECK_CLOSE(c->pose[9], 1, 1e-12);      /* straight down */
        CHECK_CLOSE(c->yfov, 70 * PI / 180, 1e-12);
        CHECK(c->znear > 0 && c->znear < 9.5 && c->zfar > 10.5);
    }
    close_file(&s);

    /* Amid the scene. */
    view.eye[1] = 2.5;
    if (open_file(&s, obj_text, &view))
        CHECK(s.now.camera.znear > 0 && s.now.camera.znear < 0.1 && s.now.camera.zfar > 1.2);
    close_file(&s);
}

static void test_cameras_of_the_file_lose_their_scale_but_not_their_view(void)
{
    struct filed s;
    struct scene_view view = {.clip = MODEL_CLIP_ALL, .camera = 0};
    if (open_file(&s, gltf_text, &view)) {
        const struct scene_camera *c = &s.now.camera;
        CHECK(is_rotation(c->pose) && !c->orthographic);
        CHECK_CLOSE(c->pose[8], 1, 1e-6);       /* looks along -x */
        CHECK_CLOSE(c->pose[12], 7, 1e-9);
        CHECK_CLOSE(c->yfov, 0.8, 1e-6);
        CHECK(c->zfar == 0);
    }
    close_file(&s);
    view.camera = 1;
    if (open_file(&s, gltf_text, &view)) {
        CHECK(s.now.camera.orthographic);
        CHECK_CLOSE(s.now.camera.half_height, 2, 1e-9);
        CHECK(s.now.camera.znear > 0 && s.now.camera.znear < 0.01);
    }
    close_file(&s);
}

static void test_impossible_views_are_refused(void)
{
    static const struct scene_view bad[] = {
        {.clip = MODEL_CLIP_NONE, .camera = 2},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .fov_degrees = 45},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .eye = {1, 1, 1}},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .eye = {1, 1, 1},
         .fov_degrees = 180},
        {.clip = MODEL_CLIP_NONE, .camera = -1, .has_eye = true, .eye = {NAN, 1, 1},
         .fov_degrees = 45},
    };
    struct model model OWNED(model_free) = { 0 };
    struct failure parse = {0};
    REQUIRE(model_parse((const uint8_t *)gltf_text, strlen(gltf_text), NULL, &model, &parse));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct scene scene;
        struct failure f = {0};
        CHECK(!scene_from_model(&model, &bad[i], &scene, &f));
        CHECK(f.text[0] != '\0');
    }
}

#include "build/suites/scenes.h"
