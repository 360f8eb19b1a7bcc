/* SPDX-License-Identifier: MIT */
/* filters.c - what the camera's velocity costs per pixel, whatever the scene; passes
 * against direct taps; the other filters on the scenes they are for. Linear light, poses at
 * shutter open and close, XRGB8888, 180 degrees. */
#include "tools/bench/groups.h"
#include "tools/bench/kinds.h"
#include "tools/bench/sheet.h"
#include "tools/bench/take.h"
#include "tools/bench/truth.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------ takes */

static const char *const camera_scenes[] = { "suite/pan", "suite/dolly", "suite/roll", "suite/textured",
                                             "suite/arena", "demo/race" };
enum { CAMERA_SCENES = sizeof camera_scenes / sizeof *camera_scenes, STEPS = 3 };

static const struct pan {
    const char *name;
    smear_pingpong passes;
    int direct;                 /* the line it is compared with */
} pans[] = {
    { "64 taps", { .passes = 1, .taps = 64 }, 0 },
    { "8 and 8", { 0 }, 0 },
    { "4, 4 and 4", { .passes = 3, .taps = 4 }, 0 },
    { "7 and 7, base 4 (the original)", { .taps = 7, .base = 4 }, 0 },
    { "8 and 8, jitter", { .jitter = 64 }, 0 },
    { "64 taps, what is nearer left out", { .passes = 1, .taps = 64, .bias = 16 }, 5 },
    { "8 and 8, what is nearer left out", { .bias = 16 }, 5 },
};
enum { PANS = sizeof pans / sizeof *pans, LIGHTS = 2 };

#define MEND (SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_UNIFORM)

static const struct filter {
    const char *name;
    smear_method method;
    smear_filter_kind filter;
    int camera_step, reconstruct, samples;
    smear_weights weights;
    smear_pingpong pingpong;
} filters[] = {
    { "none", SMEAR_NONE, 0, 0, 0, 0, 0, { 0 } },
    { "reconstruct 8", SMEAR_RECONSTRUCT, 0, 0, 0, 8, 0, { 0 } },
    { "reconstruct 8 mended", SMEAR_RECONSTRUCT, 0, 0, MEND, 8, 0, { 0 } },
    { "  velocity from depth", SMEAR_RECONSTRUCT, 0, 1, MEND, 8, 0, { 0 } },
    { "  McGuire 2012", SMEAR_RECONSTRUCT, 0, 0, 0, 8, SMEAR_WEIGHTS_MCGUIRE, { 0 } },
    { "  Guertin 2014", SMEAR_RECONSTRUCT, 0, 0, 0, 8, SMEAR_WEIGHTS_GUERTIN, { 0 } },
    { "  Jimenez 2014", SMEAR_RECONSTRUCT, 0, 0, 0, 8, SMEAR_WEIGHTS_JIMENEZ, { 0 } },
    { "camera", SMEAR_CAMERA, 0, 1, 0, 8, 0, { 0 } },
    { "camera, 2 x 2", SMEAR_CAMERA, 0, 2, 0, 8, 0, { 0 } },
    { "camera, 4 x 4", SMEAR_CAMERA, 0, 4, 0, 8, 0, { 0 } },
    { "pingpong", SMEAR_PINGPONG, 0, 0, 0, 0, 0, { 0 } },
    { "  what is nearer left out", SMEAR_PINGPONG, 0, 0, 0, 0, 0, { .bias = 16 } },
    { "  spread", SMEAR_PINGPONG, 0, 0, 0, 0, 0, { .spread = 1 } },
    { "half", SMEAR_HALF, 0, 0, 0, 8, 0, { 0 } },
    { "half, mended", SMEAR_HALF, 0, 0, MEND, 8, 0, { 0 } },
    { "half, mean, from depth", SMEAR_HALF, SMEAR_FILTER_MEAN, 1, 0, 8, 0, { 0 } },
};
enum { FILTERS = sizeof filters / sizeof *filters, GROUP_KINDS = 2 };

/* In turn: camera scenes by steps; pans by light; filters by kind. */
bool filters_take(int index, struct take *out)
{
    *out = (struct take){ .frame = -1, .windowed = true, .shutter_poses = true, .linear = true,
                          .format = SMEAR_XRGB8888, .reach = 32 };
    if (index < 0)
        return false;
    if (index < CAMERA_SCENES * STEPS) {
        out->scene = camera_scenes[index / STEPS];
        out->method = SMEAR_CAMERA;
        out->camera_step = 1 << index % STEPS;
        return true;
    }
    index -= CAMERA_SCENES * STEPS;
    if (index < PANS * LIGHTS) {
        out->scene = "suite/pan";
        out->method = SMEAR_CAMERA;
        out->filter = SMEAR_FILTER_PINGPONG;
        out->camera_step = 1;
        out->pingpong = pans[index / LIGHTS].passes;
        out->linear = index % LIGHTS == 0;
        return true;
    }
    index -= PANS * LIGHTS;
    if (index >= KINDS * FILTERS)
        return false;
    const struct filter *s = &filters[index % FILTERS];
    out->scene = kinds[index / FILTERS].scene;
    out->reach = 0;
    out->windowed = s->method != SMEAR_NONE;
    out->method = s->method;
    out->filter = s->filter;
    out->camera_step = s->camera_step;
    out->reconstruct = s->reconstruct;
    out->samples = s->samples;
    out->weights = s->weights;
    out->pingpong = s->pingpong;
    return true;
}

/* ------------------------------------------------------------------ measuring */

static bool picture_of(int index, struct image *out, smear_stats *stats, struct failure *f)
{
    struct take take;
    struct rig rig;
    filters_take(index, &take);
    if (!rig_open(&rig, &take, f))
        return false;
    bool ok = rig_picture(&rig, CLEAR_OF_SCENE, out, f);
    if (stats != NULL)
        *stats = rig.stats;
    rig_close(&rig);
    return ok;
}

static double distance(const struct image *a, const struct image *b)
{
    double sum = 0.0;
    size_t pixels = (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < pixels * 4; i++)
        if (i % 4 != 3)
            sum += (double)(a->rgba[i] - b->rgba[i]) * (a->rgba[i] - b->rgba[i]);
    return sqrt(sum / (double)(3 * pixels));
}

static const struct count_toggles velocity_only = { 1, { "smear_camera_velocity" } };
static const struct count_toggles passes_only = { 1, { "smear_pingpong_pass" } };

static bool report_camera(struct sheet *sheet, struct failure *f)
{
    uint64_t each[CAMERA_SCENES * STEPS] = { 0 };
    double low[STEPS] = { INFINITY, INFINITY, INFINITY }, high[STEPS] = { 0, 0, 0 };
    printf("== camera velocity from depth: instructions per pixel of the frame\n\n"
           "scene             triangles    each pixel   2 x 2   4 x 4\n");
    if (!count_takes(&sheet->counter, "filters", 0, CAMERA_SCENES * STEPS, &velocity_only, each, f))
        return false;
    for (int i = 0; i < CAMERA_SCENES; i++) {
        struct image picture;
        smear_stats stats;
        if (!picture_of(i * STEPS, &picture, &stats, f))
            return false;
        image_free(&picture);
        printf("%-16s %10u  ", camera_scenes[i], (unsigned)stats.triangles_drawn);
        for (int k = 0; k < STEPS; k++) {
            double cost = (double)each[i * STEPS + k] / stats.pixels;
            low[k] = fmin(low[k], cost);
            high[k] = fmax(high[k], cost);
            printf(k == 0 ? "  %10.1f" : "  %6.1f", cost);
        }
        printf("\n");
    }
    printf("\neach pixel, dearest scene over cheapest: %.3f, bar 1.15 (%s)\n\n", high[0] / low[0],
           sheet_most(sheet, high[0] / low[0], 1.15));
    return true;
}

static bool report_passes(struct sheet *sheet, struct failure *f)
{
    const int first = CAMERA_SCENES * STEPS;
    uint64_t each[PANS * LIGHTS];
    static struct image picture[PANS * LIGHTS];
    bool ok = count_takes(&sheet->counter, "filters", first, PANS * LIGHTS, &passes_only, each, f);
    printf("== passes on suite/pan, camera velocity: against 64 direct taps\n"
           "   (RMSE in codes; cost: instructions of the passes alone)\n\n"
           "%-34s linear: RMSE   cost    encoded: RMSE   cost\n", "");
    for (int i = 0; i < PANS * LIGHTS && ok; i++)
        ok = picture_of(first + i, &picture[i], NULL, f);
    for (int i = 0; i < PANS && ok; i++) {
        double rmse[LIGHTS], cost[LIGHTS];
        for (int k = 0; k < LIGHTS; k++) {
            int own = i * LIGHTS + k, direct = pans[i].direct * LIGHTS + k;
            rmse[k] = distance(&picture[own], &picture[direct]);
            cost[k] = (double)each[own] / (double)each[direct];
        }
        printf("%-34s %12.2f  %5.3f  %14.2f  %5.3f\n", pans[i].name, rmse[0], cost[0], rmse[1], cost[1]);
        for (int k = 0; k < LIGHTS && i == 1; k++)
            printf("  bars, %s: RMSE at most 1.5 (%s), cost at most 0.333 (%s)\n",
                   k == 0 ? "linear light" : "encoded", sheet_most(sheet, rmse[k], 1.5),
                   sheet_most(sheet, cost[k], 1.0 / 3));
    }
    for (int i = 0; i < PANS * LIGHTS; i++)
        image_free(&picture[i]);
    printf("\n");
    return ok;
}

static bool measure_kind(const struct sheet *sheet, int kind, double cost[FILTERS], double rmse[FILTERS],
                         struct failure *f)
{
    const int first = CAMERA_SCENES * STEPS + PANS * LIGHTS + kind * FILTERS;
    struct float_image truth;
    uint64_t each[FILTERS];
    if (!truth_exact(kinds[kind].scene, true, 0.0, sheet->folder, &truth, f))
        return false;
    bool ok = count_takes(&sheet->counter, "filters", first, FILTERS, &count_frame, each, f);
    for (int i = 0; i < FILTERS && ok; i++) {
        struct image picture;
        ok = picture_of(first + i, &picture, NULL, f);
        if (!ok)
            break;
        rmse[i] = fmax(truth_rmse(&truth, &picture), 0.01);
        cost[i] = (double)each[i] / (double)each[0];
        image_free(&picture);
    }
    float_image_free(&truth);
    return ok;
}

static bool report_filters(struct sheet *sheet, struct failure *f)
{
    static double cost[GROUP_KINDS][FILTERS][KINDS], rmse[GROUP_KINDS][FILTERS][KINDS];
    int count[GROUP_KINDS] = { 0, 0 };
    for (int kind = 0; kind < KINDS; kind++) {
        double c[FILTERS], e[FILTERS];
        if (kinds[kind].group == GROUP_STILL)
            continue;
        if (!measure_kind(sheet, kind, c, e, f))
            return false;
        int group = kinds[kind].group == GROUP_CAMERA, n = count[group]++;
        for (int i = 0; i < FILTERS; i++) {
            cost[group][i][n] = c[i];
            rmse[group][i][n] = e[i];
        }
    }
    printf("== filters on the suite, reach of 5 %%: geometric means of cost against none, and of RMSE\n\n"
           "%-26s object: cost   RMSE    camera: cost   RMSE\n", "");
    for (int i = 0; i < FILTERS; i++)
        printf("%-26s %12.2f  %5.2f  %14.2f  %5.2f\n", filters[i].name, geometric_mean(cost[0][i], count[0]),
               geometric_mean(rmse[0][i], count[0]), geometric_mean(cost[1][i], count[1]),
               geometric_mean(rmse[1][i], count[1]));
    return true;
}

bool filters_report(struct sheet *sheet, struct failure *f)
{
    return report_camera(sheet, f) && report_passes(sheet, f) && report_filters(sheet, f);
}
