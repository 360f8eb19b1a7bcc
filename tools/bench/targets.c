/* SPDX-License-Identifier: MIT */
/* targets.c - reads what target_bench printed on a Cortex-M (instructions per frame of the peers'
 * scenes at 320x240), and puts it beside the peers' figures on the same core. */
#include "tools/bench/sheet.h"

#include <stdlib.h>
#include <string.h>

enum { SCENES = 5, LINE_LIMIT = 512 };

static const char *const scenes[SCENES] = { "A", "B64", "C", "D", "E" };
static const double band_bar[SCENES] = { 1.3, 1.15, 1.3, 1.3, 1.15 };  /* bands of 16 rows against the whole frame */

static const struct target {
    const char *name;           /* of the file, without folder and ending */
    const char *what;
    double bar[SCENES];         /* million instructions */
    double peer[SCENES];        /* best comparable peer */
} targets[] = {
    { "cortex-m0plus", "no multiply beyond 32 bits; peers: small3dlib",
      { 26.0, 9.0, 45.0, 34.0, 2.8 }, { 118.0, 34.2, 176.7, 131.0, 14.4 } },
    { "cortex-m4", "without its FPU; peers use it: TGX, small3dlib in D",
      { 14.0, 5.5, 28.0, 20.0, 1.9 }, { 24.9, 8.78, 60.6, 47.6, 3.70 } },
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

bool targets_report(struct sheet *sheet, const char *path, struct failure *f)
{
    const struct target *target = find_target(path);
    if (target == NULL)
        return fail(f, "no target is called like this file (%s)", path);
    printf("== %s (%s):\n   million instructions per frame, 320x240, RGB565\n\n", target->name,
           target->what);
    printf("scene   whole   bands  ratio  bar       bar              best peer  ours/peer  /pixel\n");
    for (int s = 0; s < SCENES; s++) {
        double whole, bands;
        if (!read_tape(path, scenes[s], "whole", &whole, f)
            || !read_tape(path, scenes[s], "bands", &bands, f))
            return false;
        printf("%-5s %7.2f %7.2f  %5.2f  %-8s  %5.1f  %-7s  %13.2f  %9.2f  %6.1f\n", scenes[s],
               whole, bands, bands / whole, sheet_most(sheet, bands / whole, band_bar[s]),
               target->bar[s], sheet_most(sheet, whole, target->bar[s]), target->peer[s],
               whole / target->peer[s], whole * 1e6 / (320.0 * 240.0));
    }
    return true;
}
