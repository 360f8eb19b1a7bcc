/* SPDX-License-Identifier: MIT */
/* test_accuracy.c - the rasterizer and accumulation against the reference in double precision,
 * which draws the scene's own floats: what fixed point costs from the model file to the pixel.
 * Every figure is printed, and held to a bar. */
#include "tests/ref/accuracy.h"

#include "tests/host.h"

void suite_accuracy(void);

/* ------------------------------------------------------------------ the rasterizer */

/* Bars of one picture. */
static const double coverage_bar = 0.001; /* of all pixels: drawn by one, background in the other */
static const double triangle_bar = 0.003;       /* of all pixels: another triangle */
static const double depth_over_bar = 0.0025;    /* of all pixels: depth beyond its bar, on edges: of cutouts, too, as those whose velocity
                                                 * is asked for beside their depth lose other texels than those that show triangles */
static const double velocity_rms_bar = 1.0 / 8.0, velocity_max_bar = 0.5;   /* px per frame */
static const double color_bar = 2.0;            /* codes */

/* Pixels with another triangle where all of the reference's 3x3 shows one. A triangle thinner than
 * a pixel is drawn by a pixel here and there, so its neighbours say nothing. */
static int inside_bar(const char *name)
{
    return strcmp(name, "test/slivers") == 0 ? 4 : 0;
}

/* Depth is kept in steps that grow with distance. */
static double depth_bar(const struct scene_camera *camera)
{
    return !camera->orthographic && camera->zfar > 256.0 * camera->znear ? 1.0 / 128.0
                                                                         : 1.0 / 512.0;
}

/* The picture of the same subject in which colours name triangles. */
static bool take_ids(struct subject *s, const struct present_options *present, int width,
                     int height, struct shot *out)
{
    struct failure f = {{0}};
    struct scene ids;
    if (!CHECK(ref_id_scene(&s->scene, &ids, &f)))
        return false;
    struct subject other = *s;
    other.scene = ids;
    other.presenter = presenter_new(&other.scene, &f);
    struct present_options options = *present;
    options.clear = 0;
    options.method = SMEAR_NONE;
    options.light = SMEAR_LIGHT_ENCODED;
    bool ok = CHECK(other.presenter != NULL)
           && shot_take(&other, &options, &(struct shot_options){.width = width, .height = height},
                        out);
    presenter_free(other.presenter);
    scene_free(&other.scene);
    return ok;
}

/* Colours come from the sharp picture itself (blended surfaces included), the rest from under the
 * blurred one. */
static bool take_planes(struct subject *s, const struct present_options *present, int width,
                        int height, struct shot shot[3])
{
    struct present_options sharp = *present;
    sharp.method = SMEAR_NONE;
    return shot_take(s, present,
                     &(struct shot_options){.width = width, .height = height, .look = true},
                     &shot[0])
        && shot_take(s, &sharp, &(struct shot_options){.width = width, .height = height},
                     &shot[1])
        && take_ids(s, present, width, height, &shot[2]);
}

/* What struct ref_difference does not tell. */
struct detail {
    int inside; /* pixels inside a triangle that show another one, at another depth */
    int inside_x, inside_y;     /* the first, or -1 */
    double depth_inside;        /* largest depth error inside triangles */
    int depth_x, depth_y;
    int depth_over; /* pixels of all with the same triangle and a depth beyond the bar */
};

/* Two triangles in one place are no mistake (faces of a model may coincide), and neither is the
 * depth of a surface seen edge-on, which changes by more than the bar within 1/256 px: such pixels
 * lie on edges, where there are neighbours. */
static void look_closer(const struct ref_frame *frame, const struct ref_planes *planes, double bar,
                        struct detail *out)
{
    *out = (struct detail){.inside_x = -1, .inside_y = -1};
    for (int y = 0; y < frame->height; y++)
        for (int x = 0; x < frame->width; x++) {
            size_t at = (size_t)y * (size_t)frame->width + (size_t)x;
            double want = frame->depth[at], got = (double)planes->depth[at];
            double error = isinf(want) && isinf(got) ? 0.0 : fabs(got - want) / want;
            bool same = ref_id_from_rgb(planes->id_rgb + 3 * at) == frame->triangle[at];
            bool edge = ref_is_edge(frame, x, y);
            if (!same && !edge && !(error <= bar) && out->inside++ == 0) {
                out->inside_x = x;
                out->inside_y = y;
            }
            out->depth_over += same && !(error <= bar);
            if (same && !edge && !(error <= out->depth_inside)) {
                out->depth_inside = error;
                out->depth_x = x;
                out->depth_y = y;
            }
        }
}

static bool compare(struct subject *s, const struct present_options *present, int width, int height,
                    struct ref_difference *d, struct detail *detail, double *bar)
{
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    struct shot shot[3] = {{0}};
    struct scene_instant now;
    struct failure f = {{0}};
    memset(&now, 0, sizeof now);
    bool ok = CHECK(scene_pose(&s->scene, s->time, &now, &f));
    *bar = ok ? depth_bar(&now.camera) : 0.0;
    scene_instant_free(&s->scene, &now);
    if (!ok || !reference_take(s, present, width, height, &frame))
        return false;
    ok = take_planes(s, present, width, height, shot);
    if (ok) {
        struct ref_planes planes = {.width = width, .height = height, .rgb = shot[1].rgb,
                                    .depth = shot[0].distance, .velocity = shot[0].velocity,
                                    .id_rgb = shot[2].rgb};
        ref_compare(&frame, &planes, d);
        look_closer(&frame, &planes, *bar, detail);
    }
    for (int i = 0; i < 3; i++)
        shot_free(&shot[i]);
    return ok;
}

static void raster_heading(void)
{
    say("    %-22s %-9s %-8s %-7s %6s %6s %3s  %-7s %6s  %6s %6s  %5s %6s %5s\n", "rasterizer",
        "size", "poses", "light", "cover%", "tri%", "in", "depth", "over%", "v rms", "v max",
        "c rms", "c max", "ms");
}

static double inverse(double value)
{
    return value > 0.0 ? 1.0 / value : INFINITY;
}

static void check_raster(struct subject *s, int width, int height, bool shutter_poses, bool encoded)
{
    struct ref_difference d;
    struct detail detail;
    struct present_options present = subject_options(s);
    double bar, start = cpu_seconds();
    present.method = SMEAR_RECONSTRUCT;
    present.reconstruct = SMEAR_PUBLISHED;  /* velocities of vertices */
    present.shutter_poses = shutter_poses;
    present.path = SMEAR_PATH_LINE;         /* the reference's velocities are now less a frame ago */
    present.light = encoded ? SMEAR_LIGHT_ENCODED : SMEAR_LIGHT_LINEAR;
    END_UNLESS(compare(s, &present, width, height, &d, &detail, &bar));
    double coverage = (double)d.coverage / d.pixels, triangle = (double)d.triangle / d.pixels;
    double over = (double)detail.depth_over / d.pixels;
    say("    %-22s %4dx%-4d %-8s %-7s %6.3f %6.3f %3d  1/%-5.0f %6.3f  %6.3f %6.3f  %5.2f %6.1f "
        "%5.1f\n",
        s->name, width, height, shutter_poses ? "shutter" : "previous",
        encoded ? "encoded" : "linear", 100 * coverage, 100 * triangle, detail.inside,
        inverse(detail.depth_inside), 100 * over, d.velocity_rms, d.velocity_max, d.color_rms,
        d.color_max, 1000 * (cpu_seconds() - start));
    CHECK_BAR(coverage, coverage_bar, s->name);
    CHECK_BAR(triangle, triangle_bar, s->name);
    if (!CHECK_BAR(detail.inside, inside_bar(s->name), s->name))
        say("      first at %d,%d\n", detail.inside_x, detail.inside_y);
    if (!CHECK_BAR(detail.depth_inside, bar, s->name))
        say("      at %d,%d\n", detail.depth_x, detail.depth_y);
    CHECK_BAR(over, depth_over_bar, s->name);
    CHECK_BAR(d.velocity_rms, velocity_rms_bar, s->name);
    if (!CHECK_BAR(d.velocity_max, velocity_max_bar, s->name))
        say("      at %d,%d\n", d.velocity_x, d.velocity_y);
    if (!CHECK_BAR(d.color_rms, color_bar, s->name))
        say("      at %d,%d\n", d.color_x, d.color_y);
}

static void test_rasterizer_is_the_reference_on_trials(void)
{
    raster_heading();
    for (int i = 0; i < TRIAL_KINDS; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, trial_kind[i]))
            continue;
        for (int k = 0; k < 4; k++)
            check_raster(&s, s.width, s.height, k & 1, k & 2);
    }
}

/* Frames that no tile fits, and the smallest ones. */
static void test_rasterizer_is_the_reference_at_odd_sizes(void)
{
    static const struct { const char *name; int width, height; } odd[] = {
        {"test/room", 240, 240}, {"test/boxes", 201, 149}, {"test/ortho", 97, 240},
        {"test/soup", 641, 481}, {"test/terrain", 240, 240}, {"test/leaves", 63, 31},
        {"suite/arena", 333, 217}, {"suite/near", 240, 240}, {"suite/skin", 160, 128},
    };
    raster_heading();
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, odd[i].name))
            continue;
        check_raster(&s, odd[i].width, odd[i].height, i & 1, i & 2);
    }
}

/* As the files are, and with a camera that circles them, so that all of them move; by all kinds of light and poses in turn. */
static void test_rasterizer_is_the_reference_on_models(void)
{
    const char *folder = asset_folder();
    if (folder == NULL) {
        say("    no folder of models: set SMEAR_ASSETS\n");
        return;
    }
    char **list = asset_list(folder);
    REQUIRE(list != NULL);
    raster_heading();
    int count = 0;
    for (char **path = list; *path != NULL; path++)
        for (int circling = 0; circling < 2; circling++, count++) {
            struct subject s OWNED(subject_close) = { 0 };
            const int width = count & 4 ? 240 : 320;
            if (!subject_open_file(&s, *path, width, 240))
                continue;
            if (!circling || CHECK(subject_circle(&s, 6.0)))
                check_raster(&s, width, 240, count & 1, count & 2);
        }
    CHECK(count > 0);
    asset_list_free(list);
}

/* ------------------------------------------------------------------ accumulation */

/* Motion that is linear in clip space, so that the poses of a frame say all about it: movers and
 * cameras that neither turn nor bend, nor change their light. `teleport` is cut between its poses
 * when they are a frame apart. */
static bool is_linear(const char *name, bool shutter_poses)
{
    static const char *const linear[] = {
        "suite/translate", "suite/cross", "suite/fence_obj", "suite/enter", "suite/near",
        "suite/long", "suite/dolly", "suite/still",
    };
    for (size_t i = 0; i < sizeof linear / sizeof *linear; i++)
        if (strcmp(name, linear[i]) == 0)
            return true;
    return shutter_poses && strcmp(name, "suite/teleport") == 0;
}

static const double accumulate_bar = 1.0;       /* codes */
enum { TRUTH_INSTANTS = 256 };

static double accumulate_error(struct subject *s, bool shutter_poses, smear_light_space light)
{
    struct shot shot OWNED(shot_free) = { 0 };
    struct present_options present = subject_options(s);
    present.method = SMEAR_ACCUMULATE;
    present.samples = 64;
    present.shutter_poses = shutter_poses;
    present.light = light;
    const struct ref_truth *truth = truth_of(s, &present, TRUTH_INSTANTS);
    if (truth == NULL || !shot_take(s, &present, &(struct shot_options){0}, &shot))
        return INFINITY;
    double error = rmse_to_truth(shot.rgb, truth);
    return error;
}

static void test_accumulation_of_linear_motion_is_the_truth(void)
{
    say("    %-18s %8s %8s %8s %8s\n", "accumulate, 64", "previous", "shutter", "linear:p",
        "linear:s");
    for (int i = 0; i < SUITE_KINDS; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        double error[4] = {0};
        if (!subject_open(&s, suite_kind[i]))
            continue;
        /* Linear light has another truth, which takes its time: a few kinds say it. */
        int cases = is_linear(s.name, false) && (i % 3 == 0 || is_thorough()) ? 4 : 2;
        say("    %-18s", s.name);
        for (int k = 0; k < cases; k++) {
            error[k] =
                accumulate_error(&s, k & 1, k < 2 ? SMEAR_LIGHT_ENCODED : SMEAR_LIGHT_LINEAR);
            say(" %8.2f", error[k]);
        }
        say("%s\n", is_linear(s.name, true) ? "" : "   (curved or lit anew)");
        /* Poses at shutter open, now and at shutter close make a parabola: enough for all kinds. */
        for (int k = 0; k < cases; k++)
            if ((k & 1) || is_linear(s.name, false))
                CHECK_BAR(error[k], accumulate_bar, s.name);
    }
}

void suite_accuracy(void)
{
    RUN(test_rasterizer_is_the_reference_on_trials);
    RUN(test_rasterizer_is_the_reference_at_odd_sizes);
    RUN(test_rasterizer_is_the_reference_on_models);
    RUN(test_accumulation_of_linear_motion_is_the_truth);
    truth_forget();
}
