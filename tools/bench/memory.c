/* SPDX-License-Identifier: MIT */
/* memory.c - the arena of two small displays, meshes excluded: smear_memory_size() of this
 * machine (pointers are twice as wide here as on a microcontroller: context and draws are
 * a little larger) and the macro's constant. */
#include "tools/bench/sheet.h"

#include <smear.h>
#include <stdio.h>

static int no_flush(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

static const struct display {
    const char *what;
    smear_desc desc;
    double bar_encoded, bar_linear;     /* kB of 1024 bytes; 0: none */
} displays[] = {
    { "240x240 RGB565, reach 12, 600 triangles",
      { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .reach = 12,
        .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = SMEAR_RGB565 },
      0.0, 0.0 },
    { "  in bands of 4 rows, 32 vertices cached",
      { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .reach = 12,
        .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = SMEAR_RGB565, .band_rows = 4, .vertex_cache = 32 },
      112.0, 136.0 },
    { "128x64 L4, reach 4, 200 triangles",
      { .width = 128, .height = 64, .max_triangles = 200, .max_draws = 4, .reach = 4,
        .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = SMEAR_L4 },
      0.0, 0.0 },
    { "  tiles of 4, in bands of 2 rows",
      { .width = 128, .height = 64, .max_triangles = 200, .max_draws = 4, .reach = 4,
        .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .format = SMEAR_L4,
        .tile = 4, .band_rows = 2 },
      28.0, 34.0 },
    { "240x240 RGB565, sharp only, 600 triangles",
      { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .format = SMEAR_RGB565,
        .methods = SMEAR_SET(SMEAR_NONE) },
      0.0, 0.0 },
    { "240x240 RGB565, auto, 600 triangles",
      { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .format = SMEAR_RGB565,
        .tile = 8, .strip = 8, .vertex_cache = 16 },
      72.0, 0.0 },
    { "128x64 L4, auto, 200 triangles",
      { .width = 128, .height = 64, .max_triangles = 200, .max_draws = 4, .format = SMEAR_L4,
        .tile = 8, .strip = 8, .vertex_cache = 16 },
      20.0, 0.0 },
};

bool memory_report(struct sheet *sheet, struct failure *f)
{
    (void)f;
    printf("\nArena in kB, one band, one worker; the same in linear and encoded light\n\n");
    printf("%-44s %8s  %-18s %s\n", "display", "kB", "encoded", "linear");
    for (size_t i = 0; i < sizeof displays / sizeof *displays; i++) {
        const struct display *d = &displays[i];
        smear_desc desc = d->desc;
        desc.flush = no_flush;
        double size = (double)smear_memory_size(&desc) / 1024.0;
        if (d->bar_encoded > 0.0) {
            printf("%-44s %8.1f  <= %5.1f %-9s", d->what, size, d->bar_encoded,
                   sheet_most(sheet, size, d->bar_encoded));
            if (d->bar_linear > 0.0)
                printf(" <= %5.1f %s", d->bar_linear, sheet_most(sheet, size, d->bar_linear));
            printf("\n");
        } else {
            printf("%-44s %8.1f\n", d->what, size);
        }
    }
    return true;
}
