/* SPDX-License-Identifier: MIT */
/* peers.c - the scenes by which other software rasterizers were measured: instructions and
 * time per frame, whole and in bands of 16 rows.
 *
 * Same conditions as theirs: frames 0, 2, 4, 6 of 8, RGB565, depth and clears included, set-up
 * excluded. Ours: undithered, textures of the display's format as theirs,
 * encoded light (codes in, codes out, as theirs), one worker, 4096
 * vertices in the cache (peers keep all), room for every triangle so that no frame is drawn in
 * parts. "Whole" is one band of the frame's height. The figure beside ours is the best peer that
 * tests depth and, in B and C, corrects perspective. */
#include "tools/bench/sheet.h"
#include "tools/bench/take.h"

#include <inttypes.h>
#include <string.h>

enum { SCENES = 10, SIZES = 2, LAYOUTS = 2, FRAMES = 4, FRAME_STEP = 2, ROUNDS = 9 };

struct peer_scene {
    const char *name;
    double best[SIZES];         /* million instructions of the best peer; 0: not measured */
    const char *peer[SIZES];
    double bar[SIZES];          /* 0: none */
    double band_bar;            /* 16-row bands against the whole frame */
};

static const struct peer_scene scenes[SCENES] = {
    { "A", { 26.8, 33.6 }, { "TGX", "TGX" }, { 12.0, 22.0 }, 1.3 },
    { "B64", { 8.36, 27.3 }, { "TGX", "TGX" }, { 5.5, 15.0 }, 1.15 },
    { "B256", { 0.0, 0.0 }, { "", "" }, { 0.0, 0.0 }, 1.15 },
    { "C", { 53.1, 211.0 }, { "TGX", "TGX" }, { 30.0, 115.0 }, 1.3 },
    { "D", { 50.4, 65.8 }, { "small3dlib", "TGX" }, { 24.0, 40.0 }, 1.3 },
    { "E", { 3.29, 8.00 }, { "TinyGL jserv", "TinyGL jserv" }, { 1.8, 4.2 }, 1.15 },
    { "F", { 5.45, 0.0 }, { "TGX", "" }, { 4.5, 0.0 }, 1.3 },
    { "F-lit", { 7.32, 0.0 }, { "TGX", "" }, { 6.5, 0.0 }, 1.3 },
    { "G", { 19.4, 0.0 }, { "TGX", "" }, { 16.0, 0.0 }, 1.3 },
    { "G-lit", { 25.5, 0.0 }, { "TGX", "" }, { 22.0, 0.0 }, 1.3 },
};

static const int size[SIZES][2] = { { 320, 240 }, { 640, 480 } };

bool peers_take(int index, struct take *out)
{
    static char name[SCENES][16];
    int frame = index % FRAMES, layout = index / FRAMES % LAYOUTS;
    int at = index / (FRAMES * LAYOUTS) % SIZES, scene = index / (FRAMES * LAYOUTS * SIZES);
    if (index < 0 || scene >= SCENES)
        return false;
    snprintf(name[scene], sizeof name[scene], "peer/%s", scenes[scene].name);
    *out = (struct take){
        .scene = name[scene], .frame = frame * FRAME_STEP, .width = size[at][0],
        .height = size[at][1], .band_rows = layout == 0 ? take_whole(size[at][1]) : 16,
        .format = SMEAR_RGB565, .texels_565 = true, .method = SMEAR_NONE
    };
    return true;
}

static int index_of(int scene, int at, int layout)
{
    return ((scene * SIZES + at) * LAYOUTS + layout) * FRAMES;
}

/* Mean over the frames, in millions. */
static bool count_mean(const struct sheet *sheet, int index, double *millions, struct failure *f)
{
    uint64_t each[FRAMES], sum = 0;
    if (!count_takes(&sheet->counter, "peers", index, FRAMES, each, f))
        return false;
    for (int i = 0; i < FRAMES; i++)
        sum += each[i];
    *millions = (double)sum / FRAMES / 1e6;
    return true;
}

/* ------------------------------------------------------------------ time */

struct timing {
    double whole_ms, triangles, drawn, split, memory_kb;
};

/* CPU time per frame, median over rounds that visit all scenes in turn. */
static bool time_all(int at, struct timing timing[SCENES], struct failure *f)
{
    struct rig rig[SCENES];
    double ms[SCENES][ROUNDS];
    int open = 0;
    bool ok = true;
    for (; open < SCENES && ok; open++) {
        struct take take;
        peers_take(index_of(open, at, 0), &take);
        ok = rig_open(&rig[open], &take, f);
        if (!ok)
            break;
    }
    for (int round = 0; round < ROUNDS && ok; round++)
        for (int s = 0; s < SCENES && ok; s++) {
            double sum = 0.0;
            for (int i = 0; i < FRAMES && ok; i++) {
                ok = rig_seek(&rig[s], i * FRAME_STEP, f);
                double start = process_seconds();
                ok = ok && rig_draw(&rig[s], f);
                sum += process_seconds() - start;
            }
            ms[s][round] = 1e3 * sum / FRAMES;
        }
    for (int s = 0; s < open; s++) {
        if (ok)
            timing[s] = (struct timing){
                median(ms[s], ROUNDS), rig[s].stats.triangles_in, rig[s].stats.triangles_drawn,
                rig[s].stats.parts_added, rig[s].stats.arena_bytes / 1024.0
            };
        rig_close(&rig[s]);
    }
    return ok;
}

/* ------------------------------------------------------------------ the table */

static bool report_size(struct sheet *sheet, int at, struct failure *f)
{
    struct timing timing[SCENES];
    double pixels = (double)size[at][0] * size[at][1];
    if (!time_all(at, timing, f))
        return false;
    printf("\n%dx%d, million instructions per frame\n", size[at][0], size[at][1]);
    printf("scene   whole   bands  ratio  bar       best peer              ours/peer  "
           "bar        /pixel  /triangle   CPU ms\n");
    for (int s = 0; s < SCENES; s++) {
        const struct peer_scene *p = &scenes[s];
        double whole, bands;
        if (!count_mean(sheet, index_of(s, at, 0), &whole, f)
            || !count_mean(sheet, index_of(s, at, 1), &bands, f))
            return false;
        if (timing[s].split != 0.0)
            return fail(f, "the frame was drawn in parts (peer/%s)", p->name);
        printf("%-5s %7.2f %7.2f  %5.2f  %-8s", p->name, whole, bands, bands / whole,
               sheet_most(sheet, bands / whole, p->band_bar));
        if (p->best[at] > 0.0)
            printf("  %6.2f %-14s  %9.2f", p->best[at], p->peer[at], whole / p->best[at]);
        else
            printf("  %6s %-14s  %9s", "-", "", "-");
        if (p->bar[at] > 0.0)
            printf("  %-9s", sheet_most(sheet, whole, p->bar[at]));
        else
            printf("  %-9s", "-");
        printf("  %6.1f  %9.0f  %7.2f\n", whole * 1e6 / pixels, whole * 1e6 / timing[s].triangles,
               timing[s].whole_ms);
        fflush(stdout);
    }
    return true;
}

bool peers_report(struct sheet *sheet, struct failure *f)
{
    printf("== sharp frames of the peers' scenes: RGB565 undithered, encoded light, one worker\n"
           "   (mean of frames 0 2 4 6; bands of 16 rows; /pixel of the screen, /triangle\n"
           "   submitted; CPU time is the median of %d rounds on this machine as it is now)\n",
           (int)ROUNDS);
    for (int at = 0; at < SIZES; at++)
        if (!report_size(sheet, at, f))
            return false;
    return true;
}
