/* SPDX-License-Identifier: MIT */
/* failures_time.c - rows of the failure catalogue that take several frames or exposures: what has
 * no past, what stops, what flickers, and how streaks follow the shutter. */
#include "tests/suite/failures.h"

#include "tests/host.h"

#define GREY 0x303848u
#define CREAM 0xffe9b0u

/* ------------------------------------------------------------------ the library's own memory */

/* The same frames by the method and sharp. */
struct pair {
    struct reel blurred, sharp;
};

static bool pair_open(struct pair *p, const char *scene)
{
    memset(p, 0, sizeof *p);
    return reel_open(&p->blurred, scene) && reel_open(&p->sharp, scene);
}

static void pair_close(struct pair *p)
{
    reel_close(&p->blurred);
    reel_close(&p->sharp);
}

static bool pair_frame(struct pair *p, const struct fail_method *method, int frame)
{
    return reel_frame(&p->blurred, method, frame)
        && reel_frame(&p->sharp, &fail_method[NONE], frame);
}

static int pair_difference(const struct pair *p, struct area area)
{
    return fail_difference(&p->sharp.subject, p->blurred.rgb, p->sharp.rgb, area);
}

/* Draws frames 0 to `last`; difference[i] is that of frame i within the area. */
static bool differences(const char *scene, const struct fail_method *method, int last,
                        struct area area, int difference[])
{
    struct pair p;
    bool ok = pair_open(&p, scene);
    for (int i = 0; i <= last && ok; i++) {
        ok = pair_frame(&p, method, i);
        difference[i] = ok ? pair_difference(&p, area) : 0;
    }
    pair_close(&p);
    return ok;
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

/* ------------------------------------------------------------------ 12 cut, teleport */

/* How far beyond the square there is red, in pixels; everything else is grey. */
static double reach_of_jump(const struct reel *reel)
{
    const struct subject *s = &reel->subject;
    double farthest = 0.0;
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            const uint8_t *p = reel->rgb + 3 * ((size_t)y * (size_t)s->width + (size_t)x);
            double away = fmax(fabs(fail_x(s, x) - 64), fabs(fail_y(s, y))) - FAIL_JUMP_HALF;
            if (abs(p[0] - p[1]) > 2 && away > farthest)
                farthest = away;
        }
    return farthest;
}

static void jump(const struct fail_method *method, double number[])
{
    enum { LAST = FAIL_JUMP_FRAME + 2 };
    const struct area all = {0, 0, 192, 80};
    int told[2][LAST + 1], after = 0;
    struct pair p;
    if (!differences("fail/teleport", method, LAST, all, told[0])
        || !differences("fail/cut", method, LAST, all, told[1]))
        return;
    number[0] = 0.0;
    for (int i = 0; i <= LAST; i++)
        number[0] = fmax(number[0], larger(told[0][i], told[1][i]));
    bool ok = pair_open(&p, "fail/jump");
    double reach = 0.0;
    for (int i = 0; i <= LAST && ok; i++) {
        ok = pair_frame(&p, method, i);
        if (ok && i == FAIL_JUMP_FRAME)
            reach = reach_of_jump(&p.blurred);
        else if (ok)
            after = larger(after, pair_difference(&p, all));
    }
    pair_close(&p);
    if (!ok)
        return;
    number[1] = after;
    number[2] = fmax(reach - FAIL_REACH, 0.0);
}

/* ------------------------------------------------------------------ 13 first frame, new object */

static void spawn(const struct fail_method *method, double number[])
{
    enum { LAST = FAIL_SPAWN_AGAIN + 1 };
    int whole[LAST + 1], upper[LAST + 1];
    if (!differences("fail/spawn", method, LAST, (struct area){0, 0, 192, 160}, whole)
        || !differences("fail/spawn", method, LAST, (struct area){0, 0, 192, 80}, upper))
        return;
    number[0] = larger(whole[0], larger(upper[FAIL_SPAWN_FRAME], upper[FAIL_SPAWN_AGAIN]));
    /* The frames after it show that there was something to see. */
    bool blurs = method->method != SMEAR_NONE && method->method != SMEAR_CAMERA;
    CHECK_EQ(upper[FAIL_SPAWN_FRAME + 1] > 8, blurs);
    CHECK_EQ(upper[FAIL_SPAWN_AGAIN + 1] > 8, blurs);
    CHECK_EQ(whole[1] > 8, blurs);
}

/* ------------------------------------------------------------------ 19 seams */

enum { SEAM_INSTANTS = 16 };            /* 3 px */

/* How much a picture depends on where borders of tiles are: its change when everything moves by
 * half a tile, followed. Away from the frame's edges. */
static double change_half_a_tile_aside(const char *scene, const struct fail_method *method)
{
    enum { HALF = FAIL_TILE / 2, MARGIN = 24 };
    struct subject s OWNED(subject_close) = { 0 };
    double sum = 0.0;
    int count = 0;
    if (!subject_open(&s, scene))
        return NAN;
    struct present_options present = fail_options(&s, method);
    uint8_t *here = fail_take(&s, &present, 0, 0);
    uint8_t *aside = fail_take_aside(&s, &present, HALF, HALF);
    for (int y = MARGIN; y < s.height - MARGIN && here != NULL && aside != NULL; y++)
        for (int x = MARGIN; x < s.width - MARGIN; x++)
            for (int k = 0; k < 3; k++) {
                sum += pow(here[3 * (y * s.width + x) + k]
                           - aside[3 * ((y + HALF) * s.width + x + HALF) + k], 2);
                count++;
            }
    bool ok = here != NULL && aside != NULL;
    free(here);
    free(aside);
    return ok ? sqrt(sum / count) : NAN;
}

static void seams(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    struct seams got = {0}, want = {0};
    double change[3] = {
        change_half_a_tile_aside("fail/rotation", method),
        change_half_a_tile_aside("fail/opposite", method),
        change_half_a_tile_aside("fail/fence", method),
    };
    number[1] = change[0] + change[1] + change[2];      /* NAN when one is */
    if (!isnan(number[1]))
        number[1] = fmax(change[0], fmax(change[1], change[2]));
    bool ok = subject_open(&s, "fail/seams");
    if (!ok)
        return;
    for (int i = 0; i < FAIL_SEAMS_FRAMES && ok; i++) {
        struct present_options present = fail_options(&s, method);
        s.time = FAIL_TIME + i / FAIL_FPS;
        uint8_t *rgb = fail_take(&s, &present, 0, 0);
        const struct ref_truth *truth = truth_of(&s, &present, SEAM_INSTANTS);
        ok = rgb != NULL && truth != NULL;
        if (ok)
            fail_seams(&s, rgb, truth, fail_whole(&s), &got, &want);
        free(rgb);
    }
    if (ok)
        number[0] = fail_seam_ratio(&got, &want);
}

/* ------------------------------------------------------------------ 20 jitter */

enum { JITTER_FRAMES = 6, JITTER_INSTANTS = 64, JITTER_HALF = 4 };

/* What varies along columns near the disc's middle, where the truth hardly does: mean square. */
static double column_noise(const struct subject *s, const uint8_t *rgb,
                           const struct ref_truth *truth)
{
    struct area area = fail_around(s, 0, 0, s->width / 2, JITTER_HALF);
    int n = area.y1 - area.y0, moving = 0;
    double sum = 0.0;
    for (int x = area.x0; x < area.x1; x++) {
        double mean = 0.0, square = 0.0;
        for (int y = area.y0; y < area.y1; y++) {
            int at = 3 * (y * s->width + x) + 1;
            double d = rgb[at] - truth->code[at];
            mean += d / n;
            square += d * d / n;
        }
        if (fabs(truth->code[3 * (s->height / 2 * s->width + x) + 1] - 0x38) < 0.01)
            continue;           /* background */
        sum += square - mean * mean;
        moving++;
    }
    return sum / moving;
}

static void jitter(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    bool ok = subject_open(&s, "fail/jitter");
    if (!ok)
        return;
    size_t values = 3 * (size_t)s.width * (size_t)s.height;
    double *before = malloc(values * sizeof *before), noise = 0.0, flicker = 0.0;
    for (int i = 0; i < JITTER_FRAMES && ok; i++) {
        struct present_options present = fail_options(&s, method);
        s.time = FAIL_TIME + i / FAIL_FPS;
        uint8_t *rgb = fail_take(&s, &present, 0, 0);
        const struct ref_truth *truth = truth_of(&s, &present, JITTER_INSTANTS);
        ok = rgb != NULL && truth != NULL && CHECK(before != NULL);
        if (ok)
            noise += column_noise(&s, rgb, truth) / JITTER_FRAMES;
        for (size_t k = 0; k < values && ok; k++) {
            double error = rgb[k] - truth->code[k];
            if (i > 0)
                flicker += pow(error - before[k], 2) / (double)values / (JITTER_FRAMES - 1);
            before[k] = error;
        }
        free(rgb);
    }
    if (ok) {
        number[0] = sqrt(noise);
        number[1] = sqrt(flicker);
    }
    free(before);
}

/* ------------------------------------------------------------------ 21 rate, 22 strobe */

/* Alpha of the bar along the rows in the middle. */
enum { BAR_COLUMNS = 192 };

static bool bar_profile(struct subject *s, const struct present_options *present,
                        double column[BAR_COLUMNS])
{
    double alpha[BAR_COLUMNS * 16];
    struct area area = fail_around(s, 0, 0, s->width / 2, 8);
    uint8_t *rgb = fail_take(s, present, 0, 0);
    if (rgb == NULL)
        return false;
    fail_alpha(s, rgb, area, CREAM, GREY, false, alpha);
    fail_columns(alpha, area, column);
    free(rgb);
    return true;
}

/* A shutter that is open for a sixtieth of a second, whatever the frame rate: the application
 * scales shutter_degrees. Of 10 frames per second, and of 3 : 1 : 3 : 1 sixtieths. */
static void rate(const struct fail_method *method, double number[])
{
    static const double rates[] = {144, 60, 30, 20, 10};
    const double exposure = 1.0 / 60, want = FAIL_RATE_SPEED * exposure;
    struct subject s OWNED(subject_close) = { 0 };
    double column[BAR_COLUMNS], worst = 0.0;
    END_UNLESS(subject_open(&s, "fail/rate"));
    bool ok = true;
    for (size_t i = 0; i < sizeof rates / sizeof *rates && ok; i++) {
        struct present_options present = fail_options(&s, method);
        present.fps = rates[i];
        present.shutter_degrees = 360 * exposure * rates[i];
        present.shutter_poses = false;
        ok = bar_profile(&s, &present, column);
        if (ok)
            worst = fmax(worst, fabs(fail_half_length(column, s.width) / want - 1));
    }
    if (ok)
        number[0] = 100 * worst;
}

enum { STROBE_FRAMES = 4 };

/* The part of the path that no frame shows, in percent; and how much the sum of all frames varies
 * along it, largest less smallest over the mean. */
static bool strobe_at(struct subject *s, const struct fail_method *method, double degrees,
                      double *gaps, double *ripple)
{
    double column[BAR_COLUMNS], most[BAR_COLUMNS] = {0}, sum[BAR_COLUMNS] = {0};
    for (int i = 0; i < STROBE_FRAMES; i++) {
        struct present_options present = fail_options(s, method);
        present.shutter_degrees = degrees;
        s->time = FAIL_TIME + i / FAIL_FPS;
        if (!bar_profile(s, &present, column))
            return false;
        for (int x = 0; x < s->width; x++) {
            most[x] = fmax(most[x], column[x]);
            sum[x] += column[x];
        }
    }
    int first = s->width / 2, last = first + FAIL_STROBE_STEP * (STROBE_FRAMES - 1), open = 0;
    double low = INFINITY, high = 0.0, mean = 0.0;
    for (int x = first; x < last; x++) {
        open += most[x] < 0.03;
        low = fmin(low, sum[x]);
        high = fmax(high, sum[x]);
        mean += sum[x] / (last - first);
    }
    *gaps = 100.0 * open / (last - first);
    *ripple = 100.0 * (high - low) / mean;
    return true;
}

static void strobe(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    double gaps[3], ripple[3];
    END_UNLESS(subject_open(&s, "fail/strobe"));
    bool ok = strobe_at(&s, method, 90, &gaps[0], &ripple[0])
           && strobe_at(&s, method, 180, &gaps[1], &ripple[1])
           && strobe_at(&s, method, 360, &gaps[2], &ripple[2]);
    if (ok) {
        /* A shutter that is closed half the time must leave gaps. */
        number[0] = gaps[2] + (gaps[0] > 0 ? 0 : 100) + (gaps[1] > 0 ? 0 : 100);
        number[1] = ripple[2];
    }
}

/* ------------------------------------------------------------------ 23 sub-pixel motion */

enum { SWEEP_STEPS = 40, SWEEP_INSTANTS = 32 };

/* From 0 to 4 px in steps of a tenth. `pop`: the largest change from step to step that the truth
 * does not have; `fall`: the most by which the error gets smaller again. */
static bool sweep(const char *scene, const struct fail_method *method, double *pop, double *fall)
{
    struct subject s OWNED(subject_close) = { 0 };
    if (!subject_open(&s, scene))
        return false;
    size_t values = 3 * (size_t)s.width * (size_t)s.height;
    double *before = malloc(values * sizeof *before), highest = 0.0;
    bool ok = CHECK(before != NULL);
    for (int k = 0; k <= SWEEP_STEPS && ok; k++) {
        struct present_options present = fail_options(&s, method);
        present.shutter_degrees = 360.0 * k / SWEEP_STEPS;
        uint8_t *rgb = fail_take(&s, &present, 0, 0);
        const struct ref_truth *truth = truth_of(&s, &present, SWEEP_INSTANTS);
        double step = 0.0, error = 0.0;
        ok = rgb != NULL && truth != NULL;
        for (size_t i = 0; i < values && ok; i++) {
            double here = rgb[i] - truth->code[i];
            error += here * here / (double)values;
            if (k > 0)
                step += pow(here - before[i], 2) / (double)values;
            before[i] = here;
        }
        *pop = fmax(*pop, sqrt(step));
        *fall = fmax(*fall, highest - sqrt(error));
        highest = fmax(highest, sqrt(error));
        free(rgb);
    }
    free(before);
    return ok;
}

static void subpixel(const struct fail_method *method, double number[])
{
    double pop = 0.0, fall = 0.0;
    if (!sweep("fail/subpixel", method, &pop, &fall) || !sweep("fail/subpan", method, &pop, &fall))
        return;
    number[0] = pop;
    number[1] = fall;
}

/* ------------------------------------------------------------------ 30 attached, 31 stop */

static void attached(const struct fail_method *method, double number[])
{
    enum { LAST = FAIL_STOP_FRAME + 2 };
    int difference[LAST + 1], worst = 0;
    END_UNLESS(differences("fail/attached", method, LAST, (struct area){0, 0, 128, 96}, difference));
    for (int i = 0; i <= LAST; i++)
        worst = larger(worst, difference[i]);
    number[0] = worst;
}

static void stop(const struct fail_method *method, double number[])
{
    enum { LAST = FAIL_STOP_FRAME + 2 };
    int difference[LAST + 1];
    END_UNLESS(differences("fail/stop", method, LAST, (struct area){0, 0, 192, 64}, difference));
    number[0] = larger(difference[LAST - 1], difference[LAST]);
    CHECK_EQ(difference[FAIL_STOP_FRAME - 1] > 8,
             method->method != SMEAR_NONE && method->method != SMEAR_CAMERA);
}

/* ------------------------------------------------------------------ 35 ghosts */

/* The largest step of the ramp from pixel to pixel, 1 from black to white. */
static double largest_step(struct subject *s, const struct present_options *present)
{
    double alpha[128 * 16], worst = 0.0;
    struct area area = fail_around(s, 0, 0, 40, 8);
    int width = area.x1 - area.x0;
    uint8_t *rgb = fail_take(s, present, 0, 0);
    if (rgb == NULL)
        return NAN;
    fail_alpha(s, rgb, area, 0xffffff, 0x000000, true, alpha);
    for (int i = 0; i < width * 16; i++)
        if (i % width != 0)
            worst = fmax(worst, fabs(alpha[i] - alpha[i - 1]));
    free(rgb);
    return worst;
}

static void ghosts(const struct fail_method *method, double number[])
{
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "fail/ghosts"));
    struct present_options present = fail_options(&s, method);
    present.light = SMEAR_LIGHT_ENCODED;
    number[0] = 31 * largest_step(&s, &present);
    if (method->method == SMEAR_ACCUMULATE) {
        double worst = 0.0;
        for (int k = 4; k <= 32; k *= 2) {
            present.samples = k;
            worst = fmax(worst, k * (largest_step(&s, &present) - 1.0 / 255));
        }
        number[1] = worst;
    }
}

/* ------------------------------------------------------------------ rows */

const struct fail_row fail_time_rows[] = {
    {12, "camera cut, teleport", jump, {
        {"told: from the sharp frames", "codes", 0.0, .hard = true},
        {"not told: all frames but one", "codes", 0.0, .hard = true},
        {"not told: beyond the reach", "px", 0.0,
         .only = REACHING | ONLY(NONE), .otherwise = "no reach: a streak is as long as the motion"},
    }, NULL},
    {13, "first frame, new object, back again", spawn, {
        {"from the sharp frames", "codes", 0.0, .hard = true},
    }, NULL},
    {19, "tile seams", seams, {
        {"second difference at borders", "x", 1.1, .hard = true},
        {"change when tiles lie half a tile aside", "codes", 1.5,
         .known = {[PLAIN] = 13, [MENDED] = 14, [AUTO] = 4.1}, .hard = true},
    }, "truth of 16 instants for 3 px"},
    {20, "jitter noise", jitter, {
        {"deviation in flat columns", "codes", 1.0, .known = {[PLAIN] = 7.3, [MENDED] = 7.6, [AUTO] = 1.7}},
        {"change of the error from frame to frame", "codes", 2.0,
         .known = {[NONE] = 29, [PLAIN] = 8, [MENDED] = 5.2}},
    }, "truth of 64 instants for 16 px"},
    {21, "low or varying frame rate", rate, {
        {"length of a streak of 1/60 s", "%", 5.0,
         .known = {[NONE] = 37, [PLAIN] = 27, [MENDED] = 7.2}},
    }, "the application scales shutter_degrees here; suite motion has the modes of the library"},
    {22, "strobing", strobe, {
        {"gaps at 360, none at 90 and 180 degrees", "%", 0.0, .known = {[NONE] = 88}},
        {"ripple of the sum of frames", "%", 10.0,
         .known = {[NONE] = 550, [ACCUMULATE] = 18, [PLAIN] = 180, [MENDED] = 140,
         [SUBFRAMES] = 18, [TIMEMASK] = 18, [AUTO] = 55}},
    }, NULL},
    {23, "sub-pixel motion", subpixel, {
        {"largest pop, 0 to 4 px", "codes", 1.0,
         .known = {[PLAIN] = 2.4, [MENDED] = 2.7, [SUBFRAMES] = 3.6, [AUTO] = 2.4}, .hard = true},
        {"error gets smaller again by", "codes", 1.0,
         .known = {[MENDED] = 1.3, [SUBFRAMES] = 1.7, [AUTO] = 1.2}, .hard = true},
    }, "truth of 32 instants for up to 4 px"},
    {30, "attached to the camera", attached, {
        {"from the sharp frames", "codes", 0.0,
         .known = {[SUBFRAMES] = 190, [TIMEMASK] = 190, [AUTO] = 190, [FINE] = 190}},
    }, NULL},
    {31, "blur after a stop", stop, {
        {"from the sharp frames", "codes", 0.0, .known = {0}},
    }, NULL},
    {35, "accumulation ghosts", ghosts, {
        {"largest step of the ramp, of 5 bits", "codes", 1.0,
         .known = {[NONE] = 35, [PLAIN] = 6.9, [MENDED] = 4.9, [AUTO] = 1.1, [FINE] = 1.1}},
        {"largest step times instants, 4 to 32", "", 1.0,
         .only = ONLY(ACCUMULATE), .otherwise = "not a number of instants"},
    }, "encoded light, so that steps are even"},
};

const int fail_time_count = sizeof fail_time_rows / sizeof *fail_time_rows;
