/* SPDX-License-Identifier: MIT */
/* defaults.c - what a sharp frame costs a program that says nothing, beside the same frame with everything in favour.
 *
 * Fitted: encoded light, one band, a cache for all vertices, textures of the display's format, meshes on grids that fit
 * them, no dither, no light on surfaces, as peers.c has it. Default: the library's own tile, bands and cache, linear
 * light, textures of 8 bits a channel, ordered dither. Lit: fitted, but for light at vertices and linear light. Models
 * are posed by their files, seen by the automatic camera. */
#include "tools/bench/groups.h"
#include "tools/bench/remade.h"
#include "tools/bench/sheet.h"

#include <inttypes.h>
#include <string.h>

enum { FRAMES = 4 };
enum shot { FITTED, DEFAULT, LIT, SHOTS };

static const double default_bar = 1.25, lit_bar = 1.3;

static const struct field_scene {
    const char *scene, *name, *clip;
    int first, step;            /* frames */
    double bar;                 /* million instructions, fitted; 0: peers.c has it */
    const char *lit;            /* the scene with light, which is the same for files and the demo; null: none */
} scenes[] = {
    { "peer/A", "A", NULL, 0, 2, 0.0, NULL },
    { "peer/B64", "B64", NULL, 0, 2, 0.0, NULL },
    { "peer/B256", "B256", NULL, 0, 2, 0.0, NULL },
    { "peer/C", "C", NULL, 0, 2, 0.0, NULL },
    { "peer/D", "D", NULL, 0, 2, 0.0, NULL },
    { "peer/E", "E", NULL, 0, 2, 0.0, NULL },
    { "peer/F", "F", NULL, 0, 2, 0.0, "peer/F-lit" },
    { "peer/G", "G", NULL, 0, 2, 0.0, "peer/G-lit" },
    { "khronos/Fox.glb", "fox", "Run", 0, 4, 0.9, "khronos/Fox.glb" },
    { "kenney-space/alien.glb", "alien", NULL, 0, 4, 0.6, "kenney-space/alien.glb" },
    { "quaternius/RobotExpressive.glb", "robot", "Running", 0, 4, 2.6, "quaternius/RobotExpressive.glb" },
    { "demo/race", "race", NULL, 4, 12, 5.5, "demo/race" },
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static void leave_unlit(struct scene_surface *surface)
{
    surface->material.unlit = true;
}

static bool unlit_scene(struct scene *scene, struct scene *out, struct failure *f)
{
    return remade_scene(scene, leave_unlit, out, f);
}

bool defaults_take(int index, struct take *out)
{
    const int frame = index % FRAMES, shot = index / FRAMES % SHOTS, scene = index / (FRAMES * SHOTS);
    if (index < 0 || scene >= SCENES)
        return false;
    const struct field_scene *s = &scenes[scene];
    *out = (struct take){
        .scene = shot == LIT ? s->lit : s->scene, .clip = s->clip, .frame = s->first + frame * s->step, .width = 320, .height = 240,
        .format = SMEAR_RGB565, .method = SMEAR_NONE, .instant_only = true, .linear = shot != FITTED,
        .change = shot == LIT ? NULL : unlit_scene, .plain_context = shot == DEFAULT, .dithered = shot == DEFAULT,
        .band_rows = shot == DEFAULT ? 0 : take_whole(240), .texels_565 = shot != DEFAULT, .fit_grid = shot != DEFAULT
    };
    return true;
}

static bool count_mean(const struct sheet *sheet, int scene, enum shot shot, double *millions, struct failure *f)
{
    uint64_t each[FRAMES], sum = 0;
    if (!count_takes(&sheet->counter, "defaults", (scene * SHOTS + (int)shot) * FRAMES, FRAMES, &count_frame, each, f))
        return false;
    for (int i = 0; i < FRAMES; i++)
        sum += each[i];
    *millions = (double)sum / FRAMES / 1e6;
    return true;
}

static bool report_scene(struct sheet *sheet, int scene, struct failure *f)
{
    const struct field_scene *s = &scenes[scene];
    double fitted, plain, lit;
    if (!count_mean(sheet, scene, FITTED, &fitted, f) || !count_mean(sheet, scene, DEFAULT, &plain, f))
        return false;
    printf("%-6s %8.2f  ", s->name, fitted);
    if (s->bar > 0.0)
        printf("%4.1f %-7s", s->bar, sheet_most(sheet, fitted, s->bar));
    else
        printf("%4s %-7s", "", "-");
    printf("  %8.2f  %5.2f %-7s", plain, plain / fitted, sheet_most(sheet, plain / fitted, default_bar));
    if (s->lit != NULL) {
        if (!count_mean(sheet, scene, LIT, &lit, f))
            return false;
        printf("  %8.2f  %5.2f %-7s", lit, lit / fitted, sheet_most(sheet, lit / fitted, lit_bar));
    }
    printf("\n");
    fflush(stdout);
    return true;
}

bool defaults_report(struct sheet *sheet, struct failure *f)
{
    printf("== sharp frames as a program gets them that says nothing, 320x240, RGB565, million instructions\n"
           "   (mean of 4 frames; default: at most %.2f of fitted; lit: in linear light, at most %.1f of fitted)\n\n"
           "scene    fitted  bar            default  /fitted            lit  /fitted\n", default_bar, lit_bar);
    for (int i = 0; i < SCENES; i++) {
        if (!take_is_there(scenes[i].scene)) {
            printf("%-6s not here: SMEAR_ASSETS names the folder of models\n", scenes[i].name);
            continue;
        }
        if (!report_scene(sheet, i, f))
            return false;
    }
    return true;
}
