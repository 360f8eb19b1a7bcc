/* SPDX-License-Identifier: MIT */
/* threads.c - how much of a frame two cores can share: the peers' scene C at 1280x720, and
 * scenes with more triangles.
 *
 * Counted: instructions on core 0 outside the jobs that cores take, against all instructions of
 * both cores; waiting is left out. Timed: one worker and two, in turn, on this machine as it is
 * now. */
#include "tools/bench/groups.h"
#include "tools/bench/sheet.h"
#include "tools/bench/take.h"

#include <inttypes.h>

enum { PAIRS = 11 };

static const struct shared_scene {
    const char *name, *what;
    smear_method method;
    double bar;                 /* per cent outside the jobs; 0: none */
    int width, height;
} scenes[] = {
    { "peer/C", "sharp", SMEAR_NONE, 15.0, 1280, 720 },
    { "peer/B64", "sharp", SMEAR_NONE, 0.0, 1280, 720 },
    { "peer/A", "sharp", SMEAR_NONE, 15.0, 640, 480 },
    { "peer/D", "sharp", SMEAR_NONE, 0.0, 640, 480 },
    { "suite/arena", "blurred", SMEAR_RECONSTRUCT, 0.0, 1280, 720 },
};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* Two takes per scene: one worker, two workers. */
bool threads_take(int index, struct take *out)
{
    if (index < 0 || index / 2 >= SCENES)
        return false;
    const struct shared_scene *s = &scenes[index / 2];
    bool blurred = s->method == SMEAR_RECONSTRUCT;
    *out = (struct take){ .scene = s->name, .width = s->width, .height = s->height, .band_rows = 64,
                          .windowed = blurred, .shutter_poses = blurred, .format = SMEAR_RGB565,
                          .method = s->method, .workers = index % 2 + 1 };
    return true;
}

/* What cores share are the jobs of draws.c and of methods. Entering one turns collecting on where it is off and
 * off where it is on. */
static const struct count_toggles everything = { 3, { "bench_frame", "bench_worker",
                                                      "bench_idle" } };
static const struct count_toggles jobs_only = { 11, { "assemble_job", "direct_job", "draw_job", "background_job",
                                                      "blend_job", "convert_job", "finish_job", "merge_job", "half_job",
                                                      "reduce_job", "tile_job" } };

static bool time_pairs(int scene, double ms[2], struct failure *f)
{
    double each[2][PAIRS];
    struct rig rig[2];
    int open = 0;
    bool ok = true;
    for (; open < 2; open++) {
        struct take take;
        threads_take(2 * scene + open, &take);
        ok = rig_open(&rig[open], &take, f);
        if (!ok)
            break;
    }
    for (int pair = 0; pair < PAIRS && ok; pair++)
        for (int i = 0; i < 2 && ok; i++) {
            double start = wall_seconds();
            ok = rig_draw(&rig[i], f);
            each[i][pair] = 1e3 * (wall_seconds() - start);
        }
    for (int i = 0; i < open; i++)
        rig_close(&rig[i]);
    for (int i = 0; i < 2 && ok; i++)
        ms[i] = median(each[i], PAIRS);
    return ok;
}

bool threads_report(struct sheet *sheet, struct failure *f)
{
    printf("== two workers at 1280x720 and 640x480, RGB565, encoded light; sharp frames in bands of 64 rows\n"
           "   (M instructions; outside: on core 0, not in jobs that cores share; wall time is\n"
           "   the median of %d pairs, on this machine as it is now)\n\n", (int)PAIRS);
    printf("scene               wide  one worker  two workers  outside %%  bar        "
           "one ms  two ms  ratio\n");
    for (int s = 0; s < SCENES; s++) {
        uint64_t total, jobs, alone;
        double ms[2];
        if (!time_pairs(s, ms, f)
            || !count_takes(&sheet->counter, "threads", 2 * s, 1, &count_frame, &alone, f)
            || !count_takes(&sheet->counter, "threads", 2 * s + 1, 1, &everything, &total, f)
            || !count_takes(&sheet->counter, "threads", 2 * s + 1, 1, &jobs_only, &jobs, f))
            return false;
        double outside = 100.0 * (double)(total - jobs) / (double)total;
        printf("%-12s %-7s %4d  %11.2f  %11.2f  %9.2f  ", scenes[s].name, scenes[s].what, scenes[s].width,
               (double)alone / 1e6, (double)total / 1e6, outside);
        if (scenes[s].bar > 0.0)
            printf("%2.0f %-6s", scenes[s].bar, sheet_most(sheet, outside, scenes[s].bar));
        else
            printf("%2s %-6s", "-", "");
        printf("  %6.2f  %6.2f  %5.2f\n", ms[0], ms[1], ms[0] / ms[1]);
        fflush(stdout);
    }
    return true;
}
