/* SPDX-License-Identifier: MIT */
/* blur.c - what a program that says nothing gets of motion blur, beside bars: the poses of frames ago, what
 * SMEAR_AUTO costs beside the mean of 8 whole frames and beside a peer's sharp frame, what linear light and the
 * filter add, steps at the borders of tiles. 320x240, 180 degrees; errors in codes against exact instants
 * in the same light.
 *
 * Other reports have the rest: `promise` whether a target is an error that is had, and what it costs beside plain
 * instants; `chart` means, and flicker. */
#include "tools/bench/chart.h"
#include "tools/bench/groups.h"
#include "tools/bench/sheet.h"
#include "tools/bench/truth.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------ takes */

/* What is drawn of a scene. Those of SHOT_DEFAULT_ are a program's that says nothing but the target: linear light,
 * poses of frames ago, dithered RGB565, the library's tiles; of the others poses are exact, without dither. */
enum shot {
    SHOT_DEFAULT_WHOLE,         /* the mean of 8 whole frames */
    SHOT_DEFAULT_DRAFT, SHOT_DEFAULT_BALANCED,
    SHOT_LINEAR,                /* balanced */
    SHOT_ENCODED,               /* balanced */
    SHOT_SHARP,                 /* encoded */
    SHOT_FILTER,                /* encoded, reconstruct 8 */
    SHOT_POSES,                 /* 64 instants of poses of frames ago, linear */
    SHOTS
};

static const struct {
    smear_method method;
    int samples, target;
    bool is_default, linear, previous;
} shots[SHOTS] = {
    [SHOT_DEFAULT_WHOLE] = { SMEAR_ACCUMULATE, 8, 0, true, true, true },
    [SHOT_DEFAULT_DRAFT] = { SMEAR_AUTO, 0, SMEAR_DRAFT, true, true, true },
    [SHOT_DEFAULT_BALANCED] = { SMEAR_AUTO, 0, SMEAR_BALANCED, true, true, true },
    [SHOT_LINEAR] = { SMEAR_AUTO, 0, SMEAR_BALANCED, false, true, false },
    [SHOT_ENCODED] = { SMEAR_AUTO, 0, SMEAR_BALANCED, false, false, false },
    [SHOT_SHARP] = { SMEAR_NONE, 0, 0, false, false, false },
    [SHOT_FILTER] = { SMEAR_RECONSTRUCT, 8, 0, false, false, false },
    [SHOT_POSES] = { SMEAR_SUBFRAMES, 64, 0, false, true, true },
};

bool blur_take(int index, struct take *out)
{
    const int kind = index / SHOTS, shot = index % SHOTS;
    if (index < 0 || kind >= ALL_KINDS)
        return false;
    *out = (struct take){
        .scene = kinds[kind].scene, .clip = kinds[kind].clip, .frame = kinds[kind].frame, .width = 320, .height = 240,
        .method = shots[shot].method, .samples = shots[shot].samples, .target = shots[shot].target,
        .format = shots[shot].is_default ? SMEAR_RGB565 : SMEAR_XRGB8888, .dithered = shots[shot].is_default,
        .plain_context = shots[shot].is_default, .linear = shots[shot].linear, .shutter_poses = !shots[shot].previous
    };
    return true;
}

/* ------------------------------------------------------------------ measuring */

/* Millions of instructions, kept for the next report that asks: callgrind starts once for shots of a scene that are asked
 * for together. */
static bool prices(const struct sheet *sheet, int kind, const enum shot *shot, int count, double *out, struct failure *f)
{
    static double known[ALL_KINDS][SHOTS];
    int index[SHOTS], missing = 0;
    uint64_t instructions[SHOTS];
    for (int i = 0; i < count; i++)
        if (known[kind][shot[i]] == 0.0)
            index[missing++] = kind * SHOTS + (int)shot[i];
    if (missing > 0 && !count_list(&sheet->counter, "blur", index, missing, &count_frame, instructions, f))
        return false;
    for (int i = 0; i < missing; i++)
        known[kind][index[i] % SHOTS] = (double)instructions[i] / 1e6;
    for (int i = 0; i < count; i++)
        out[i] = known[kind][shot[i]];
    return true;
}

struct pictures {
    struct image picture;
    struct float_image truth;
    int tile;
};

/* The edge of the tiles of which there were so many. */
static int tile_of(const smear_stats *stats)
{
    uint32_t count = 0;
    for (int i = 0; i < SMEAR_METHOD_COUNT; i++)
        count += stats->tiles[i];
    for (int tile = 8; tile <= 64; tile *= 2)
        if ((uint32_t)((320 + tile - 1) / tile * ((240 + tile - 1) / tile)) == count)
            return tile;
    return 0;
}

static bool open_pictures(const struct sheet *sheet, int kind, enum shot shot, struct pictures *out, struct failure *f)
{
    struct take take;
    struct rig rig;
    blur_take(kind * SHOTS + (int)shot, &take);
    take.format = SMEAR_XRGB8888;
    take.dithered = false;
    if (!truth_of_take(&take, sheet->folder, &out->truth, f))
        return false;
    bool ok = rig_open(&rig, &take, f);
    if (ok) {
        ok = rig_picture(&rig, CLEAR_OF_SCENE, &out->picture, f);
        out->tile = tile_of(&rig.stats);
        rig_close(&rig);
    }
    if (!ok)
        float_image_free(&out->truth);
    return ok;
}

static void close_pictures(struct pictures *p)
{
    image_free(&p->picture);
    float_image_free(&p->truth);
}

static bool error(const struct sheet *sheet, int kind, enum shot shot, double *out, struct failure *f)
{
    struct pictures p;
    if (!open_pictures(sheet, kind, shot, &p, f))
        return false;
    *out = truth_rmse(&p.truth, &p.picture);
    close_pictures(&p);
    return true;
}

/* ------------------------------------------------------------------ poses of frames ago */

static bool report_poses(struct sheet *sheet, struct failure *f)
{
    static const struct {
        const char *name;
        double bar;
    } scenes[] = { { "propeller", 0.8 }, { "pan", 0.8 }, { "roll", 0.8 },
                   { "race-4", 1.5 }, { "race-20", 1.5 }, { "race-40", 1.5 } };
    printf("poses of frames ago, 64 instants, linear light: error\n");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        double codes;
        if (!error(sheet, kind_find(scenes[i].name), SHOT_POSES, &codes, f))
            return false;
        printf("  %-12s %6.2f codes   at most %.1f  %s\n", scenes[i].name, codes, scenes[i].bar,
               sheet_most(sheet, codes, scenes[i].bar));
        fflush(stdout);
    }
    return true;
}

/* ------------------------------------------------------------------ frames of the demo */

static bool report_demo(struct sheet *sheet, struct failure *f)
{
    double draft[ALL_KINDS];
    int n = 0;
    printf("\ndefault options, frames of the demo: balanced, at most 2.5 codes at half the price of 8 whole frames\n"
           "  %-9s %8s %8s %8s %8s   %-6s %-14s\n", "", "draft M", "balanced", "8 whole", "codes", "error", "price / whole");
    for (int k = 0; k < ALL_KINDS; k++) {
        static const enum shot shot[] = { SHOT_DEFAULT_DRAFT, SHOT_DEFAULT_BALANCED, SHOT_DEFAULT_WHOLE };
        double each[3], codes, whole_codes;
        if (kinds[k].group != GROUP_DEMO)
            continue;
        if (!prices(sheet, k, shot, 3, each, f) || !error(sheet, k, SHOT_DEFAULT_BALANCED, &codes, f)
            || !error(sheet, k, SHOT_DEFAULT_WHOLE, &whole_codes, f))
            return false;
        const double d = each[0], b = each[1], whole = each[2];
        printf("  %-9s %8.1f %8.1f %8.1f %8.2f   %-6s %.2f %-6s (whole: %.2f codes)\n", kinds[k].name, d, b, whole, codes,
               sheet_most(sheet, codes, 2.5), b / whole, sheet_most(sheet, b / whole, 0.5), whole_codes);
        fflush(stdout);
        draft[n++] = d / b;
    }
    double mean = geometric_mean(draft, n);
    printf("  draft against balanced, price: %.2f in the mean  at most 0.6  %s\n", mean, sheet_most(sheet, mean, 0.6));
    return true;
}

/* ------------------------------------------------------------------ a peer's sharp frame */

static bool report_peer(struct sheet *sheet, struct failure *f)
{
    static const double bar[PEER_FRAMES] = { 1.2, 1.2, 2.0, 2.0, 2.0, 3.5 };
    printf("\nencoded light, exact poses, XRGB8888: balanced against TGX's sharp frame, instructions\n");
    for (int i = 0; i < PEER_FRAMES; i++) {
        const int kind = kind_find(chart_peer[i].kind);
        const enum shot shot = SHOT_ENCODED;
        double balanced, codes;
        if (!prices(sheet, kind, &shot, 1, &balanced, f) || !error(sheet, kind, SHOT_ENCODED, &codes, f))
            return false;
        const double ratio = balanced / chart_peer[i].instructions[PEER_SHARP];
        printf("  %-12s %6.1f M %6.2fx at %.2f codes   at most %.1fx  %s\n", chart_peer[i].kind, balanced, ratio, codes,
               bar[i], sheet_most(sheet, ratio, bar[i]));
    }
    return true;
}

/* ------------------------------------------------------------------ light, the filter */

static bool report_light(struct sheet *sheet, struct failure *f)
{
    static const struct {
        enum kind_group group;
        const char *what;
    } groups[] = { { GROUP_OBJECT, "objects" }, { GROUP_CAMERA, "camera" }, { GROUP_DEMO, "demo" } };
    printf("\nexact poses, balanced: price of linear light in parts of encoded\n");
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
        double ratio[ALL_KINDS];
        int n = 0;
        for (int k = 0; k < ALL_KINDS; k++) {
            static const enum shot shot[] = { SHOT_LINEAR, SHOT_ENCODED };
            double each[2];
            if (kinds[k].group != groups[i].group)
                continue;
            if (!prices(sheet, k, shot, 2, each, f))
                return false;
            ratio[n++] = each[0] / each[1];
        }
        const double mean = geometric_mean(ratio, n);
        printf("  %-12s %.2fx in the mean of %d  at most 1.2x  %s\n", groups[i].what, mean, n, sheet_most(sheet, mean, 1.2));
        fflush(stdout);
    }
    return true;
}

static bool report_filter(struct sheet *sheet, struct failure *f)
{
    static const struct {
        const char *name;
        double bar;
    } scenes[] = { { "translate", 8.0 }, { "pan", 26.0 }, { "arena", 15.0 } };
    printf("\nencoded light, exact poses: reconstruct 8 less the sharp frame\n");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        static const enum shot shot[] = { SHOT_FILTER, SHOT_SHARP };
        double each[2];
        if (!prices(sheet, kind_find(scenes[i].name), shot, 2, each, f))
            return false;
        printf("  %-12s %6.1f M  at most %.0f M  %s\n", scenes[i].name, each[0] - each[1], scenes[i].bar,
               sheet_most(sheet, each[0] - each[1], scenes[i].bar));
        fflush(stdout);
    }
    return true;
}

/* ------------------------------------------------------------------ steps at the borders of tiles */

/* Of the grey of the picture, in codes. */
static double error_at(const struct pictures *p, int x, int y)
{
    const size_t at = (size_t)y * (size_t)p->picture.width + (size_t)x;
    double sum = 0.0;
    for (size_t c = 0; c < 3; c++)
        sum += p->picture.rgba[4 * at + c] - 255.0 * (double)p->truth.value[3 * at + c];
    return sum / 3.0;
}

/* How the error steps from one side of an edge of `length` pixels to the other, beyond how it goes on at both sides,
 * in the mean along the edge: second differences. The edge is left of, or above, (x, y). */
static double step_at(const struct pictures *p, int x, int y, bool is_row, int length)
{
    double sum = 0.0;
    for (int i = 0; i < length; i++) {
        double e[4];
        for (int k = 0; k < 4; k++)
            e[k] = is_row ? error_at(p, x + i, y + k - 2) : error_at(p, x + k - 2, y + i);
        sum += (e[2] - e[1]) - ((e[1] - e[0]) + (e[3] - e[2])) / 2.0;
    }
    return fabs(sum / length);
}

struct steps {
    double mean, worst;
    int x, y;                   /* where the worst begins */
};

/* At all edges as long as a tile that lie `aside` of its borders. */
static struct steps steps_of(const struct pictures *p, int aside)
{
    const int tile = p->tile, width = p->picture.width, height = p->picture.height;
    struct steps out = { 0.0, 0.0, 0, 0 };
    int n = 0;
    for (int y = 0; y + tile <= height; y += tile)
        for (int x = 0; x + tile <= width; x += tile)
            for (int is_row = 0; is_row < 2; is_row++) {
                const int at = (is_row ? y : x) + aside;
                if (at < 2 || at + 2 > (is_row ? height : width))
                    continue;
                const int edge_x = is_row ? x : at, edge_y = is_row ? at : y;
                const double step = step_at(p, edge_x, edge_y, is_row != 0, tile);
                out.mean += step;
                if (step > out.worst) {
                    out.worst = step;
                    out.x = edge_x;
                    out.y = edge_y;
                }
                n++;
            }
    out.mean /= n;
    return out;
}

/* The largest step on any line between borders: those half a tile aside are a sample of few. */
static double largest_inside(const struct pictures *p)
{
    double largest = 0.0;
    for (int aside = 1; aside < p->tile; aside++)
        largest = fmax(largest, steps_of(p, aside).worst);
    return largest;
}

static bool report_steps(struct sheet *sheet, struct failure *f)
{
    double most = 0.0, most_worst = 0.0, most_all = -DBL_MAX;
    const char *where = "", *where_worst = "", *where_all = "";
    printf("\ndefault options, balanced: steps of the error at the borders of tiles, codes, and those that lie half a tile\n"
           "beside them, in the mean of edges and the largest; the largest on all lines between borders\n");
    for (int k = 0; k < ALL_KINDS; k++) {
        struct pictures p;
        if (kinds[k].group == GROUP_STILL || !take_is_there(kinds[k].scene))
            continue;
        if (!open_pictures(sheet, k, SHOT_DEFAULT_BALANCED, &p, f))
            return false;
        const struct steps border = steps_of(&p, 0), inside = steps_of(&p, p.tile / 2);
        const double all = largest_inside(&p);
        close_pictures(&p);
        printf("  %-10s %5.2f %5.2f   largest %6.2f at %d, %d; %.2f; %.2f\n", kinds[k].name, border.mean, inside.mean, border.worst,
               border.x, border.y, inside.worst, all);
        fflush(stdout);
        if (border.mean - inside.mean > most) {
            most = border.mean - inside.mean;
            where = kinds[k].name;
        }
        if (border.worst - inside.worst > most_worst) {
            most_worst = border.worst - inside.worst;
            where_worst = kinds[k].name;
        }
        if (border.worst - all > most_all) {
            most_all = border.worst - all;
            where_all = kinds[k].name;
        }
    }
    printf("  what borders add to the mean, largest: %.2f (%s)  at most 1  %s\n", most, where, sheet_most(sheet, most, 1.0));
    printf("  what they add to the largest step: %.2f (%s)  at most 1  %s\n", most_worst, where_worst,
           sheet_most(sheet, most_worst, 1.0));
    printf("  and to the largest of all lines: %.2f (%s); below 0 there is a larger step between borders in every scene\n", most_all,
           where_all);
    return true;
}

/* ------------------------------------------------------------------ all */

bool blur_report(struct sheet *sheet, struct failure *f)
{
    printf("== motion blur beside bars: 320x240, 180 degrees; errors in codes against %d exact instants in the same\n"
           "   light, prices in millions of instructions per frame. Targets had, and auto against plain instants: promise;\n"
           "   means in the study's conditions, and flicker: chart\n\n", (int)TRUTH_EXACT_INSTANTS);
    return report_poses(sheet, f) && report_demo(sheet, f) && report_peer(sheet, f) && report_light(sheet, f)
        && report_filter(sheet, f) && report_steps(sheet, f);
}
