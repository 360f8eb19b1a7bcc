/* SPDX-License-Identifier: MIT */
/* methods.c - what blur costs and how far it is from the truth, on the 20 scenes of the suite.
 *
 * Cost is instructions per frame relative to the sharp frame of the same scene by the same build,
 * drawn in bands as high as the filter's tiles in a context without a window. Encoded light, poses
 * at shutter open and close, XRGB8888, reach of 5 % of the height, 180 degrees. Error is the RMSE
 * in codes against 256 exact instants. "object" is the geometric mean over the scenes in which
 * things move before a still camera, "camera" over those in which the camera moves. */
#include "tools/bench/groups.h"
#include "tools/bench/kinds.h"
#include "tools/bench/sheet.h"
#include "tools/bench/take.h"
#include "tools/bench/truth.h"

#include <inttypes.h>
#include <string.h>

#define ALL_BUT_DIRECTION (SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX | SMEAR_UNIFORM)

static const struct setting {
    const char *name;
    smear_method method;
    int samples, reconstruct;
} settings[] = {
    { "none", SMEAR_NONE, 1, 0 },
    { "accumulate 2", SMEAR_ACCUMULATE, 2, 0 },
    { "accumulate 4", SMEAR_ACCUMULATE, 4, 0 },
    { "accumulate 8", SMEAR_ACCUMULATE, 8, 0 },
    { "accumulate 16", SMEAR_ACCUMULATE, 16, 0 },
    { "reconstruct 8", SMEAR_RECONSTRUCT, 8, 0 },
    { "  fence", SMEAR_RECONSTRUCT, 8, SMEAR_FENCE },
    { "  corner", SMEAR_RECONSTRUCT, 8, SMEAR_CORNER },
    { "  box", SMEAR_RECONSTRUCT, 8, SMEAR_BOX },
    { "  uniform", SMEAR_RECONSTRUCT, 8, SMEAR_UNIFORM },
    { "  fence corner", SMEAR_RECONSTRUCT, 8, SMEAR_FENCE | SMEAR_CORNER },
    { "  fence uniform", SMEAR_RECONSTRUCT, 8, SMEAR_FENCE | SMEAR_UNIFORM },
    { "  corner uniform", SMEAR_RECONSTRUCT, 8, SMEAR_CORNER | SMEAR_UNIFORM },
    { "  box uniform", SMEAR_RECONSTRUCT, 8, SMEAR_BOX | SMEAR_UNIFORM },
    { "  fence corner box", SMEAR_RECONSTRUCT, 8, SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX },
    { "  fence corner uniform", SMEAR_RECONSTRUCT, 8,
      SMEAR_FENCE | SMEAR_CORNER | SMEAR_UNIFORM },
    { "  corner box uniform", SMEAR_RECONSTRUCT, 8, SMEAR_CORNER | SMEAR_BOX | SMEAR_UNIFORM },
    { "  all four", SMEAR_RECONSTRUCT, 8, ALL_BUT_DIRECTION },
};
enum { SETTINGS = sizeof settings / sizeof *settings };

/* Of reconstruct 8 with its best options. */
static const double bar[GROUPS] = { 6.2, 8.7, 0.0 };

struct measured {
    double instructions, rmse;
};

bool methods_take(int index, struct take *out)
{
    int scene = index / SETTINGS;
    const struct setting *s = &settings[index % SETTINGS];
    if (scene >= KINDS)
        return false;
    *out = (struct take){
        .scene = kinds[scene].scene, .frame = -1, .windowed = s->method == SMEAR_RECONSTRUCT,
        .format = SMEAR_XRGB8888,
        .method = s->method, .samples = s->samples, .reconstruct = s->reconstruct,
        .shutter_poses = true
    };
    return true;
}

/* ------------------------------------------------------------------ measuring */

static bool measure_errors(int scene, const char *folder, struct measured out[SETTINGS],
                           struct failure *f)
{
    struct float_image truth;
    bool ok = truth_reference(kinds[scene].scene, folder, &truth, f);
    if (!ok)
        return false;
    for (int i = 0; i < SETTINGS && ok; i++) {
        struct take take;
        struct rig rig;
        struct image picture;
        methods_take(scene * SETTINGS + i, &take);
        ok = rig_open(&rig, &take, f);
        if (!ok)
            break;
        ok = rig_picture(&rig, CLEAR_OF_SCENE, &picture, f);
        if (ok) {
            out[i].rmse = truth_rmse(&truth, &picture);
            image_free(&picture);
        }
        rig_close(&rig);
    }
    float_image_free(&truth);
    return ok;
}

static bool measure_scene(const struct sheet *sheet, int scene, struct measured out[SETTINGS],
                          struct failure *f)
{
    uint64_t each[SETTINGS];
    if (!measure_errors(scene, sheet->folder, out, f)
        || !count_takes(&sheet->counter, "methods", scene * SETTINGS, SETTINGS, &count_frame, each,
                        f))
        return false;
    for (int i = 0; i < SETTINGS; i++)
        out[i].instructions = (double)each[i];
    return true;
}

/* ------------------------------------------------------------------ tables */

/* Over the scenes of a kind: cost against `none`, or error. A perfect picture counts as an error of
 * 0.01, so that means stay finite. */
static double mean_cost(struct measured all[KINDS][SETTINGS], int setting, enum kind_group group)
{
    double ratio[KINDS];
    int n = 0;
    for (int s = 0; s < KINDS; s++)
        if (kinds[s].group == group)
            ratio[n++] = all[s][setting].instructions / all[s][0].instructions;
    return geometric_mean(ratio, n);
}

static double mean_error(struct measured all[KINDS][SETTINGS], int setting, enum kind_group group)
{
    double error[KINDS];
    int n = 0;
    for (int s = 0; s < KINDS; s++)
        if (kinds[s].group == group)
            error[n++] = all[s][setting].rmse > 0.01 ? all[s][setting].rmse : 0.01;
    return geometric_mean(error, n);
}

/* The options with the least error over a kind. */
static int best_options(struct measured all[KINDS][SETTINGS], enum kind_group group)
{
    int best = -1;
    for (int i = 0; i < SETTINGS; i++)
        if (settings[i].method == SMEAR_RECONSTRUCT
            && (best < 0 || mean_error(all, i, group) < mean_error(all, best, group)))
            best = i;
    return best;
}

static void print_means(struct measured all[KINDS][SETTINGS])
{
    printf("\nsetting                  object: cost   RMSE    camera: cost   RMSE    still: cost"
           "   worst RMSE\n");
    for (int i = 0; i < SETTINGS; i++) {
        double worst = 0.0;
        for (int s = 0; s < KINDS; s++)
            worst = all[s][i].rmse > worst ? all[s][i].rmse : worst;
        printf("%-24s %12.2f %6.2f  %13.2f %6.2f  %12.2f  %11.1f\n", settings[i].name,
               mean_cost(all, i, GROUP_OBJECT), mean_error(all, i, GROUP_OBJECT),
               mean_cost(all, i, GROUP_CAMERA), mean_error(all, i, GROUP_CAMERA),
               mean_cost(all, i, GROUP_STILL), worst);
    }
}

static void print_scenes(struct measured all[KINDS][SETTINGS], int best[GROUPS])
{
    printf("\nscene            none: M  /pixel   RMSE   best options: cost   RMSE   "
           "accumulate 4: cost   RMSE\n");
    for (int s = 0; s < KINDS; s++) {
        struct take take;
        struct rig rig;
        struct failure ignored = { "" };
        methods_take(s * SETTINGS, &take);
        double pixels = 0.0;
        if (rig_open(&rig, &take, &ignored)) {
            pixels = (double)rig.take.width * rig.take.height;
            rig_close(&rig);
        }
        const struct measured *m = all[s];
        enum kind_group group = kinds[s].group == GROUP_STILL ? GROUP_OBJECT : kinds[s].group;
        const struct measured *b = &m[best[group]];
        printf("%-15s %8.2f  %6.1f  %5.2f  %19.2f  %5.2f  %19.2f  %5.2f\n", kinds[s].scene,
               m[0].instructions / 1e6, m[0].instructions / pixels, m[0].rmse,
               b->instructions / m[0].instructions, b->rmse, m[2].instructions / m[0].instructions,
               m[2].rmse);
    }
}

static bool write_csv(const char *folder, struct measured all[KINDS][SETTINGS],
                      struct failure *f)
{
    static char text[1 << 16];
    char path[512];
    size_t at = (size_t)snprintf(text, sizeof text, "scene,setting,instructions,cost,rmse\n");
    for (int s = 0; s < KINDS; s++)
        for (int i = 0; i < SETTINGS && at < sizeof text; i++)
            at += (size_t)snprintf(text + at, sizeof text - at, "%s,%s,%.0f,%.4f,%.4f\n",
                                   kinds[s].scene,
                                   settings[i].name + strspn(settings[i].name, " "),
                                   all[s][i].instructions,
                                   all[s][i].instructions / all[s][0].instructions,
                                   all[s][i].rmse);
    if (at >= sizeof text)
        return fail(f, "the table is too long");
    snprintf(path, sizeof path, "%s/methods.csv", folder);
    return file_write(path, (const uint8_t *)text, at, f);
}

bool methods_report(struct sheet *sheet, struct failure *f)
{
    static struct measured all[KINDS][SETTINGS];
    int best[GROUPS];
    printf("== cost and error of blur on the suite: instructions against the sharp frame (of a\n"
           "   sharp context in bands of a tile), RMSE in codes against %d exact instants;\n"
           "   encoded light, shutter poses, XRGB8888; geometric means of 12 object and 7 camera\n"
           "   scenes\n", (int)TRUTH_INSTANTS);
    fflush(stdout);
    for (int s = 0; s < KINDS; s++)
        if (!measure_scene(sheet, s, all[s], f))
            return false;
    print_means(all);
    for (int group = GROUP_OBJECT; group <= GROUP_CAMERA; group++)
        best[group] = best_options(all, (enum kind_group)group);
    print_scenes(all, best);
    printf("\n");
    for (int group = GROUP_OBJECT; group <= GROUP_CAMERA; group++) {
        double cost = mean_cost(all, best[group], (enum kind_group)group);
        printf("reconstruct 8 with its best options, %s (%s): %.2f of the sharp frame, "
               "bar %.1f %s\n", kind_group_name[group],
               settings[best[group]].name + strspn(settings[best[group]].name, " "), cost,
               bar[group], sheet_most(sheet, cost, bar[group]));
    }
    return write_csv(sheet->folder, all, f);
}
