/* SPDX-License-Identifier: MIT */
/* targets.c - reads what target_bench printed on a Cortex-M (instructions per frame of the peers'
 * scenes at 320x240), and puts it beside the peers' figures on the same core. */
#include "tools/bench/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCENES = 7, LINE_LIMIT = 512, PATH_LIMIT = 512 };

static const char *const scenes[SCENES] = { "A", "B64", "C", "D", "E", "F", "F-lit" };
static const bool has_user[SCENES] = { false, true, false, false, true, true, true };       /* drawn as a user gets them, too */
static const double band_bar[SCENES] = { 1.3, 1.15, 1.3, 1.3, 1.15, 1.3, 1.3 };     /* bands of 16 rows against the whole frame */

/* Million instructions; 0: none. */
static const struct target {
    const char *name;           /* of the file, without folder and ending */
    const char *what;
    double bar[SCENES];
    double user[SCENES];        /* bars of what a user gets who asks for nothing */
    double peer[SCENES];        /* best comparable peer */
    const char *base;           /* the target without what this one has, and the bar of what it takes of that: a mean; or null */
    double base_bar;
} targets[] = {
    { "cortex-m0plus", "no multiply beyond 32 bits; peers: small3dlib",
      .bar = { 26.0, 9.0, 45.0, 34.0, 2.8, 0.0, 0.0 }, .user = { 0.0, 9.5, 0.0, 0.0, 3.0, 10.5, 0.0 },
      .peer = { 118.0, 34.2, 176.7, 131.0, 14.4, 27.3, 0.0 } },
    { "cortex-m4", "without its FPU; peers use it: TGX, small3dlib in D",
      .bar = { 14.0, 5.5, 28.0, 20.0, 1.9, 5.0, 6.5 }, .user = { 0.0, 6.3, 0.0, 0.0, 2.3, 6.2, 7.8 },
      .peer = { 24.9, 8.78, 60.6, 47.6, 3.70, 5.18, 6.54 } },
    { "cortex-m7", "without its FPU; peers use it: TGX",
      .user = { 0.0, 0.0, 0.0, 0.0, 0.0, 5.5, 0.0 }, .peer = { 0.0, 0.0, 0.0, 0.0, 0.0, 4.58, 0.0 } },
    { .name = "cortex-m33", .what = "without its FPU and DSP instructions" },
    { "cortex-m33-dsp", "with its DSP instructions, as a Pico 2 has the library", .base = "cortex-m33", .base_bar = 0.85 },
};

static const struct target *find_target(const char *path)
{
    const char *slash = strrchr(path, '/'), *leaf = slash != NULL ? slash + 1 : path;
    size_t length = strcspn(leaf, ".");
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
        if (strlen(targets[i].name) == length && strncmp(targets[i].name, leaf, length) == 0)
            return &targets[i];
    return NULL;
}

/* Instructions of the tape called "SCENE LAYOUT" in what target_bench printed: the first number
 * after the name. */
static bool read_tape(const char *path, const char *scene, const char *layout, double *millions,
                      struct failure *f)
{
    char name[64], line[LINE_LIMIT];
    bool found = false;
    size_t length = (size_t)snprintf(name, sizeof name, "%s %s ", scene, layout);
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return fail(f, "cannot be read (%s)", path);
    while (!found && fgets(line, sizeof line, file) != NULL) {
        char *end;
        if (strncmp(line, name, length) != 0)
            continue;
        *millions = strtod(line + length, &end) / 1e6;
        found = end != line + length;
    }
    fclose(file);
    return found || fail(f, "has no figure for %s%s (%s)", name, layout, path);
}

/* What the frames take of those of the target's base, whose file lies beside `path`: by scene, and the geometric mean. */
static bool report_base(struct sheet *sheet, const struct target *target, const char *path, struct failure *f)
{
    const char *slash = strrchr(path, '/');
    char base[PATH_LIMIT];
    double product = 1.0;
    if (snprintf(base, sizeof base, "%.*s%s.txt", slash != NULL ? (int)(slash + 1 - path) : 0, path, target->base) >= PATH_LIMIT)
        return fail(f, "the path is too long");
    printf("\nof %s:", target->base);
    for (int s = 0; s < SCENES; s++) {
        double with, without;
        if (!read_tape(path, scenes[s], "whole", &with, f) || !read_tape(base, scenes[s], "whole", &without, f))
            return false;
        printf(" %s %.2f,", scenes[s], with / without);
        product *= with / without;
    }
    const double mean = pow(product, 1.0 / SCENES);
    printf(" mean %.2f; bar %.2f %s\n", mean, target->base_bar, sheet_most(sheet, mean, target->base_bar));
    return true;
}

bool targets_report(struct sheet *sheet, const char *path, struct failure *f)
{
    const struct target *target = find_target(path);
    if (target == NULL)
        return fail(f, "no target is called like this file (%s)", path);
    printf("== %s (%s):\n   million instructions per frame, 320x240, RGB565\n\n", target->name,
           target->what);
    printf("scene   whole   bands  ratio  bar       bar              best peer  ours/peer  /pixel    user  bar\n");
    for (int s = 0; s < SCENES; s++) {
        double whole, bands, user;
        if (!read_tape(path, scenes[s], "whole", &whole, f)
            || !read_tape(path, scenes[s], "bands", &bands, f))
            return false;
        printf("%-5s %7.2f %7.2f  %5.2f  %-8s", scenes[s], whole, bands, bands / whole,
               sheet_most(sheet, bands / whole, band_bar[s]));
        if (target->bar[s] > 0.0)
            printf("  %5.1f  %-7s", target->bar[s], sheet_most(sheet, whole, target->bar[s]));
        else
            printf("  %5s  %-7s", "-", "");
        if (target->peer[s] > 0.0)
            printf("  %13.2f  %9.2f", target->peer[s], whole / target->peer[s]);
        else
            printf("  %13s  %9s", "-", "-");
        printf("  %6.1f", whole * 1e6 / (320.0 * 240.0));
        if (has_user[s]) {
            if (!read_tape(path, scenes[s], "user", &user, f))
                return false;
            printf("  %6.2f", user);
            if (target->user[s] > 0.0)
                printf("  %.1f %s", target->user[s], sheet_most(sheet, user, target->user[s]));
        }
        printf("\n");
    }
    return target->base == NULL || report_base(sheet, target, path, f);
}
