/* SPDX-License-Identifier: MIT */
/* test_blur.c - the reconstruction filter against its port in double precision on the same inputs,
 * and against the truth; what must not change a bit: still scenes, more workers, a list drawn in
 * parts. Every figure is printed, and held to a bar. */
#include "tests/ref/accuracy.h"

#include "tests/ref/filter_ref.h"
#include "tests/host.h"

void suite_blur(void);

/* ------------------------------------------------------------------ what the filter reads */

/* Packed velocities against those of the reference, packed by the definition: away from edges of
 * draws. */
static void check_packed(struct subject *s, int reach)
{
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    struct shot shot;
    struct present_options present = subject_options(s);
    int compared = 0, off = 0, worst = 0, worst_x = -1, worst_y = -1;
    present.method = SMEAR_RECONSTRUCT;
    present.reconstruct = SMEAR_PUBLISHED;
    present.shutter_poses = true;
    END_UNLESS(reference_take(s, &present, s->width, s->height, &frame));
    if (shot_take(s, &present, &(struct shot_options){.reach = reach, .look = true}, &shot)) {
        for (int y = 1; y < s->height - 1; y++)
            for (int x = 1; x < s->width - 1; x++) {
                int at = y * s->width + x, d[2];
                int16_t want[2];
                bool alike = frame.triangle[at] >= 0 && !isnan(frame.velocity[2 * at])
                          && !isnan(frame.velocity[2 * at + 1]);
                /* Nor where the two disagree on which face of a draw is in front. */
                double deeper = (double)shot.distance[at] / frame.depth[at] - 1.0;
                alike = alike && fabs(deeper) < 1.0 / 512.0;
                for (int k = 0; k < 9 && alike; k++)
                    alike = frame.draw[at + (k / 3 - 1) * s->width + k % 3 - 1] == frame.draw[at];
                if (!alike)
                    continue;
                filter_ref_pack(frame.velocity + 2 * at, 180.0, reach, 0.125, want);
                for (int k = 0; k < 2; k++)
                    d[k] = abs(shot.packed[2 * at + k] - want[k]);
                int most = d[0] > d[1] ? d[0] : d[1];
                compared++;
                off += most > 0;
                if (most > worst) {
                    worst = most;
                    worst_x = x;
                    worst_y = y;
                }
            }
        say("    %-16s reach %2d  %6d pixels, %5.2f %% another step, at most %d at %d,%d\n", s->name,
            reach, compared, 100.0 * off / (compared > 0 ? compared : 1), worst, worst_x, worst_y);
        CHECK(compared > 0);
        /* Vectors are shortened to the reach every 8 px and linear between: a bend in there costs. */
        CHECK_BAR((double)worst, 4.0, s->name);
        CHECK_BAR((double)off / compared, 0.1, s->name);
        shot_free(&shot);
    }
}

static void test_packed_velocities_are_half_of_the_exposure(void)
{
    static const char *const scene[] = {"suite/translate", "suite/propeller", "suite/near",
                                        "suite/long", "suite/pan", "suite/roll", "suite/fence_fg",
                                        "test/floor256", "test/terrain", "test/ortho"};
    for (size_t i = 0; i < sizeof scene / sizeof *scene; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, scene[i]))
            continue;
        check_packed(&s, 12);
        check_packed(&s, 15);
        check_packed(&s, 40);
    }
}

/* ------------------------------------------------------------------ the filter and its port */

static const double port_rmse_bar = 1.5;        /* codes */
static const double port_far_bar = 0.001;       /* of all pixels: more than FAR_CODES off */
enum { FAR_CODES = 12 };

struct distance {
    double rmse, far, worst;    /* codes; share of pixels; codes */
    int x, y;                   /* the worst pixel */
    int changed;                /* pixels that the filter changes */
};

static void measure(const struct shot *shot, const double *code, struct distance *out)
{
    double sum = 0.0;
    *out = (struct distance){.x = -1, .y = -1};
    int pixels = shot->width * shot->height, far = 0;
    for (int i = 0; i < pixels; i++) {
        double here = 0.0;
        for (int k = 0; k < 3; k++) {
            double d = fabs(shot->rgb[3 * i + k] - code[3 * i + k]);
            sum += d * d;
            here = fmax(here, d);
        }
        far += here > FAR_CODES;
        out->changed += memcmp(shot->rgb + 3 * i, shot->sharp + 3 * i, 3) != 0;
        if (here > out->worst) {
            out->worst = here;
            out->x = i % shot->width;
            out->y = i / shot->width;
        }
    }
    out->rmse = sqrt(sum / (3.0 * pixels));
    out->far = (double)far / pixels;
}

/* The port on what the library's filter read. */
static bool run_port(const struct shot *shot, const struct present_options *present, int tile,
                     double **code)
{
    struct failure f = {{0}};
    struct filter_ref_input in = {
        .width = shot->width, .height = shot->height, .rgb = shot->sharp, .depth = shot->depth,
        .velocity = shot->packed, .near_plane = shot->near_plane, .far_plane = shot->far_plane,
        .orthographic = shot->orthographic, .tile = tile, .samples = present->samples,
        .encoded = present->light == SMEAR_LIGHT_ENCODED, .window = true,
        .flags = (unsigned)present->reconstruct,
    };
    *code = malloc(3 * (size_t)shot->width * (size_t)shot->height * sizeof **code);
    return CHECK(*code != NULL) && CHECK(filter_ref(&in, *code, &f));
}

/* As smear_init chooses it. */
static int tile_of(int reach)
{
    return reach <= 8 ? 8 : reach <= 16 ? 16 : reach <= 32 ? 32 : 64;
}

static void flag_names(int flags, char out[40])
{
    snprintf(out, 40, "%s%s%s%s%s%s", flags == 0 ? "plain" : "",
             flags & SMEAR_FENCE ? "fence " : "", flags & SMEAR_CORNER ? "corner " : "",
             flags & SMEAR_BOX ? "box " : "", flags & SMEAR_DIRECTION ? "dir " : "",
             flags & SMEAR_PUBLISHED ? "published" : "");
}

struct port_case {
    int flags, reach, tile;
    smear_light_space light;
    int samples;
};

/* Adds to `worst` what is worse; the place is that of the largest share of far pixels. */
static void compare_port(struct subject *s, const struct port_case *c, struct distance *worst)
{
    struct shot shot OWNED(shot_free) = { 0 };
    struct distance d;
    struct present_options present = subject_options(s);
    int reach = c->reach != 0 ? c->reach : s->height * 5 / 100;
    double *code = NULL;
    present.method = SMEAR_RECONSTRUCT;
    present.shutter_poses = true;
    present.samples = c->samples != 0 ? c->samples : 8;
    present.light = c->light;
    present.reconstruct = c->flags | SMEAR_PUBLISHED;
    struct shot_options options = {.reach = c->reach, .tile = c->tile, .look = true};
    END_UNLESS(shot_take(s, &present, &options, &shot));
    if (run_port(&shot, &present, c->tile != 0 ? c->tile : tile_of(reach), &code)) {
        char names[40], what[240];
        measure(&shot, code, &d);
        flag_names(c->flags, names);
        snprintf(what, sizeof what, "%s, %s, %s, reach %d, worst at %d,%d", s->name, names,
                 c->light == SMEAR_LIGHT_LINEAR ? "linear" : "encoded", reach, d.x, d.y);
        CHECK_BAR(d.rmse, port_rmse_bar, what);
        CHECK_BAR(d.far, port_far_bar, what);
        worst->rmse = fmax(worst->rmse, d.rmse);
        worst->far = fmax(worst->far, d.far);
        worst->worst = fmax(worst->worst, d.worst);
        worst->changed = d.changed > worst->changed ? d.changed : worst->changed;
    }
    free(code);
}

static void say_distance(const struct distance *d)
{
    say("  %5.2f %6.3f %5.0f", d->rmse, 100.0 * d->far, d->worst);
}

static const char *const port_scene[] = {
    "suite/translate", "suite/propeller", "suite/cross", "suite/fence_obj", "suite/near",
    "suite/swarm", "suite/skin", "suite/pan", "suite/roll", "suite/fence_fg", "suite/textured",
    "suite/arena", "test/room", "test/boxes", "test/ortho",
};
enum { PORT_SCENES = sizeof port_scene / sizeof *port_scene };

static void test_filter_is_its_port_with_every_option(void)
{
    static const int flags[] = {0, SMEAR_FENCE, SMEAR_CORNER, SMEAR_BOX, SMEAR_DIRECTION,
                                 SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_DIRECTION};
    say("    %-16s", "8 taps, encoded:");
    for (size_t k = 0; k < sizeof flags / sizeof *flags; k++) {
        char names[40];
        flag_names(flags[k], names);
        say("  %-18.18s", names);
    }
    say("\n    %-16s", "");
    for (size_t k = 0; k < sizeof flags / sizeof *flags; k++)
        say("  %5s %6s %5s", "rmse", ">12 %", "max");
    say("\n");
    for (int i = 0; i < PORT_SCENES; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, port_scene[i]))
            continue;
        struct distance d[sizeof flags / sizeof *flags] = {{0}};
        for (size_t k = 0; k < sizeof flags / sizeof *flags; k++)
            compare_port(&s, &(struct port_case){.flags = flags[k], .light = SMEAR_LIGHT_ENCODED},
                         &d[k]);
        say("    %-16s", s.name);
        for (size_t k = 0; k < sizeof flags / sizeof *flags; k++) {
            say_distance(&d[k]);
            CHECK(d[k].changed > 0);
        }
        say("\n");
    }
}

/* Linear light; and tiles of every size, with reaches that want velocities of 8 and of 16 bits. */
static void test_filter_is_its_port_at_every_size(void)
{
    static const struct { const char *what; struct port_case c; } cases[] = {
        {"linear", {0, 0, 0, SMEAR_LIGHT_LINEAR, 8}},
        {"linear, all", {15, 0, 0, SMEAR_LIGHT_LINEAR, 8}},
        {"tile 4, reach 4", {0, 4, 4, SMEAR_LIGHT_ENCODED, 8}},
        {"tile 8, reach 8", {0, 8, 8, SMEAR_LIGHT_ENCODED, 8}},
        {"tile 32, reach 12", {0, 12, 32, SMEAR_LIGHT_ENCODED, 8}},
        {"tile 32, reach 24", {0, 24, 32, SMEAR_LIGHT_ENCODED, 8}},
        {"tile 16, reach 16", {15, 16, 16, SMEAR_LIGHT_LINEAR, 8}},
        {"tile 64, reach 64", {0, 64, 64, SMEAR_LIGHT_LINEAR, 16}},
        {"2 taps", {0, 0, 0, SMEAR_LIGHT_ENCODED, 2}},
        {"32 taps, reach 40", {15, 40, 64, SMEAR_LIGHT_ENCODED, 32}},
    };
    static const char *const scene[] = {
        "suite/cross", "suite/swarm", "suite/long", "suite/pan", "suite/fence_fg", "suite/arena",
        "test/ortho",
    };
    say("    %-20s", "port, worst of:");
    for (size_t i = 0; i < sizeof scene / sizeof *scene; i++)
        say(" %s", scene[i]);
    say("\n    %-20s  %5s %6s %5s\n", "", "rmse", ">12 %", "max");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct distance d = {0};
        for (size_t i = 0; i < sizeof scene / sizeof *scene; i++) {
            struct subject s OWNED(subject_close) = { 0 };
            if (!subject_open(&s, scene[i]))
                continue;
            compare_port(&s, &cases[k].c, &d);
        }
        say("    %-20s", cases[k].what);
        say_distance(&d);
        say("\n");
        CHECK(d.changed > 0);
    }
}

/* ------------------------------------------------------------------ not a bit else */

static struct present_options method_options(const struct subject *s, smear_method method,
                                             int flags, smear_light_space light)
{
    struct present_options present = subject_options(s);
    present.method = method;
    present.reconstruct = flags;
    present.light = light;
    present.samples = method == SMEAR_ACCUMULATE ? 4 : 8;
    present.shutter_poses = true;
    return present;
}

/* Draws the subject by the method; checks that not one pixel differs from `want`. */
static void check_same(struct subject *s, const struct present_options *present,
                       const struct shot_options *options, const struct shot *want,
                       const char *what)
{
    struct shot shot OWNED(shot_free) = { 0 };
    int differing;
    END_UNLESS(shot_take(s, present, options, &shot));
    int worst = picture_difference(shot.rgb, want->rgb, shot.width * shot.height, &differing);
    if (!CHECK(differing == 0))
        say("    %s, %s: %d pixels differ, by up to %d codes\n", s->name, what, differing, worst);
    CHECK_EQ(shot.stats.crc32, want->stats.crc32);
}

static void check_still(struct subject *s, smear_light_space light)
{
    struct shot none OWNED(shot_free) = { 0 };
    struct present_options present = method_options(s, SMEAR_NONE, 0, light);
    const struct shot_options plain = {0}, wide = {.reach = 24};
    END_UNLESS(shot_take(s, &present, &plain, &none));
    for (int flags = 0; flags < 32; flags++) {
        char names[40];
        flag_names(flags, names);
        present = method_options(s, SMEAR_RECONSTRUCT, flags, light);
        present.shutter_poses = flags & 1;
        check_same(s, &present, flags & 2 ? &wide : &plain, &none, names);
    }
    present = method_options(s, SMEAR_ACCUMULATE, 0, light);
    for (int samples = 1; samples <= 64; samples *= 2) {
        present.samples = samples;
        present.shutter_poses = samples & 1;
        check_same(s, &present, &plain, &none, "accumulate");
    }
    present.samples = 7;
    check_same(s, &present, &plain, &none, "accumulate 7");
}

static void test_still_scenes_stay_as_they_are_by_any_method(void)
{
    static const char *const still[] = {"suite/still", "test/boxes", "test/room", "test/leaves"};
    for (size_t i = 0; i < sizeof still / sizeof *still; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, still[i]))
            continue;
        CHECK(subject_hold(&s));
        check_still(&s, SMEAR_LIGHT_LINEAR);
        check_still(&s, SMEAR_LIGHT_ENCODED);
    }
}

/* ------------------------------------------------------------------ the filter and the truth */

enum { TRUTH_INSTANTS = 256 };

/* What a filter of eight taps reached in the study that picked it, geometric means. */
static const double object_bar = 5.8, camera_bar = 8.1;

struct quality_case {
    const char *name;
    smear_method method;
    int flags;
};

static const struct quality_case quality_cases[] = {
    {"none", SMEAR_NONE, 0},
    {"plain", SMEAR_RECONSTRUCT, 0},
    {"publ", SMEAR_RECONSTRUCT, SMEAR_PUBLISHED},
    {"fence", SMEAR_RECONSTRUCT, SMEAR_FENCE},
    {"corner", SMEAR_RECONSTRUCT, SMEAR_CORNER},
    {"box", SMEAR_RECONSTRUCT, SMEAR_BOX},
    {"dir", SMEAR_RECONSTRUCT, SMEAR_DIRECTION},
    {"f+c", SMEAR_RECONSTRUCT, SMEAR_FENCE | SMEAR_CORNER},
    {"c+b", SMEAR_RECONSTRUCT, SMEAR_CORNER | SMEAR_BOX},
    {"f+b", SMEAR_RECONSTRUCT, SMEAR_FENCE | SMEAR_BOX},
    {"f+c+b", SMEAR_RECONSTRUCT, SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX},
    {"fcb+p", SMEAR_RECONSTRUCT, SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_PUBLISHED},
    {"fcbd", SMEAR_RECONSTRUCT, SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_DIRECTION},
    {"all", SMEAR_RECONSTRUCT, SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_DIRECTION
                               | SMEAR_PUBLISHED},
};
enum { QUALITY_CASES = sizeof quality_cases / sizeof *quality_cases };

static double quality_of(struct subject *s, const struct quality_case *c)
{
    struct shot shot OWNED(shot_free) = { 0 };
    struct present_options present = method_options(s, c->method, c->flags, SMEAR_LIGHT_ENCODED);
    const struct ref_truth *truth = truth_of(s, &present, TRUTH_INSTANTS);
    if (truth == NULL || !shot_take(s, &present, &(struct shot_options){0}, &shot))
        return INFINITY;
    double error = rmse_to_truth(shot.rgb, truth);
    return error;
}

static void say_means(const char *name, const double *log_sum, int kinds)
{
    say("    %-16s", name);
    for (int k = 0; k < QUALITY_CASES; k++)
        say(" %5.2f", exp(log_sum[k] / kinds));
    say("\n");
}

static double best_of(const double *log_sum, int kinds)
{
    double best = INFINITY;
    for (int k = 1; k < QUALITY_CASES; k++)
        best = fmin(best, exp(log_sum[k] / kinds));
    return best;
}

static void test_filter_is_as_close_to_the_truth_as_the_study(void)
{
    double object[QUALITY_CASES] = {0}, camera[QUALITY_CASES] = {0};
    say("    %-16s", "8 taps, RMSE");
    for (int k = 0; k < QUALITY_CASES; k++)
        say(" %5s", quality_cases[k].name);
    say("\n");
    for (int i = 0; i < SUITE_KINDS; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, suite_kind[i]))
            continue;
        say("    %-16s", s.name);
        for (int k = 0; k < QUALITY_CASES; k++) {
            double error = quality_of(&s, &quality_cases[k]);
            say(" %5.2f", error);
            if (i < OBJECT_KINDS)
                object[k] += log(error);
            else if (i < OBJECT_KINDS + CAMERA_KINDS)
                camera[k] += log(error);
        }
        say("\n");
    }
    say_means("object, mean", object, OBJECT_KINDS);
    say_means("camera, mean", camera, CAMERA_KINDS);
    CHECK_BAR(best_of(object, OBJECT_KINDS), object_bar, "objects");
    CHECK_BAR(best_of(camera, CAMERA_KINDS), camera_bar, "cameras");
}

void suite_blur(void)
{
    RUN(test_packed_velocities_are_half_of_the_exposure);
    RUN(test_filter_is_its_port_with_every_option);
    RUN(test_filter_is_its_port_at_every_size);
    RUN(test_still_scenes_stay_as_they_are_by_any_method);
    RUN(test_filter_is_as_close_to_the_truth_as_the_study);
    truth_forget();
}
