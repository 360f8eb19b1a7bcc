/* SPDX-License-Identifier: MIT */
/* edges.c - what smooth edges leave of the error, and what they cost. Linear light, exact poses, XRGB8888, 180 degrees, the
 * library's tiles, SMEAR_AUTO. Error is the RMSE in codes at 128x96 against the mean of 256 exact instants, each at 16 x 16
 * places within a pixel. Cost is instructions per frame of 320x240: where all moves, where the camera stands, and there with
 * what stands still kept from the frame before (desc.reuse.cache_static). */
#include "tools/bench/groups.h"
#include "tools/bench/kinds.h"
#include "tools/bench/sheet.h"
#include "tools/bench/truth.h"

#include <math.h>

enum { PLACES = 16, SMALL_WIDTH = 128, SMALL_HEIGHT = 96 };

enum shot { SHOT_HARD, SHOT_SMOOTH, SHOT_HARD_KEPT, SHOT_SMOOTH_KEPT, SHOTS };

bool edges_take(int index, struct take *out)
{
    const int kind = index / SHOTS, shot = index % SHOTS;
    if (index < 0 || kind >= KINDS)
        return false;
    *out = (struct take){
        .scene = kinds[kind].scene, .frame = kinds[kind].frame, .width = 320, .height = 240, .format = SMEAR_XRGB8888,
        .plain_context = true, .method = SMEAR_AUTO, .linear = true, .shutter_poses = true,
        .smooth = shot == SHOT_SMOOTH || shot == SHOT_SMOOTH_KEPT, .kept = shot >= SHOT_HARD_KEPT
    };
    return true;
}

/* ------------------------------------------------------------------ measuring */

struct measured {
    double error[2], price[SHOTS];      /* codes; instructions */
};

static bool measure_errors(const struct sheet *sheet, int kind, double error[2], struct failure *f)
{
    struct float_image truth;
    struct take take;
    edges_take(kind * SHOTS, &take);
    take.width = SMALL_WIDTH;
    take.height = SMALL_HEIGHT;
    if (!truth_of_pixels(&take, PLACES, sheet->folder, &truth, f))
        return false;
    bool ok = true;
    for (int i = 0; i < 2 && ok; i++) {
        struct rig rig;
        struct image picture;
        take.smooth = i != 0;
        ok = rig_open(&rig, &take, f);
        if (!ok)
            break;
        ok = rig_picture(&rig, CLEAR_OF_SCENE, &picture, f);
        if (ok) {
            error[i] = truth_rmse(&truth, &picture);
            image_free(&picture);
        }
        rig_close(&rig);
    }
    float_image_free(&truth);
    return ok;
}

static bool stands(int kind)
{
    return kinds[kind].group != GROUP_CAMERA;
}

/* What is kept is drawn twice: the first time all is new. */
static bool measure_prices(const struct sheet *sheet, int kind, double price[SHOTS], struct failure *f)
{
    static const enum shot shot[] = { SHOT_HARD, SHOT_SMOOTH, SHOT_HARD_KEPT, SHOT_HARD_KEPT, SHOT_SMOOTH_KEPT, SHOT_SMOOTH_KEPT };
    enum { MOST = sizeof shot / sizeof *shot };
    const int count = stands(kind) ? MOST : 2;
    uint64_t instructions[MOST];
    int index[MOST];
    for (int i = 0; i < count; i++)
        index[i] = kind * SHOTS + (int)shot[i];
    if (!count_list(&sheet->counter, "edges", index, count, &count_frame, instructions, f))
        return false;
    for (int i = 0; i < count; i++)
        price[shot[i]] = (double)instructions[i];
    return true;
}

/* ------------------------------------------------------------------ tables */

static void print_scene(struct sheet *sheet, int kind, const struct measured *m)
{
    const double *p = m->price, left = m->error[1] / fmax(m->error[0], 1e-9), bar = stands(kind) ? 1.6 : 1.15;
    const double price = p[SHOT_SMOOTH] / p[SHOT_HARD];
    printf("%-10s %6.2f %6.2f  %5.2f %-7s  %6.2f %6.2f  %-8s %5.2f  %4.2f %-7s", kinds[kind].name, m->error[0], m->error[1], left,
           sheet_most(sheet, left, 0.5), p[SHOT_HARD] / 1e6, p[SHOT_SMOOTH] / 1e6, stands(kind) ? "standing" : "moving", price,
           bar, sheet_most(sheet, price, bar));
    if (stands(kind)) {
        const double kept = p[SHOT_SMOOTH_KEPT] / p[SHOT_HARD_KEPT];
        printf("  %5.2f %s", kept, sheet_most(sheet, kept, 1.1));
    }
    printf("\n");
    fflush(stdout);
}

bool edges_report(struct sheet *sheet, struct failure *f)
{
    double left[KINDS];
    printf("== smooth edges beside hard ones: errors in codes at %dx%d against %d exact instants at %d x %d places within the\n"
           "   pixel; prices in millions of instructions per frame of 320x240, at most 1.15 where the camera moves, 1.6 where it\n"
           "   stands, 1.1 where what stands still is kept; linear light, exact poses\n\n"
           "scene        hard smooth   left at most .5    hard smooth  camera   price at most         kept at most 1.1\n",
           (int)SMALL_WIDTH, (int)SMALL_HEIGHT, (int)TRUTH_INSTANTS, (int)PLACES, (int)PLACES);
    for (int kind = 0; kind < KINDS; kind++) {
        struct measured m;
        if (!measure_errors(sheet, kind, m.error, f) || !measure_prices(sheet, kind, m.price, f))
            return false;
        print_scene(sheet, kind, &m);
        left[kind] = m.error[1] / fmax(m.error[0], 1e-9);
    }
    printf("\nwhat is left of the error, in the mean of %d scenes: %.2f\n", (int)KINDS, geometric_mean(left, KINDS));
    return true;
}
