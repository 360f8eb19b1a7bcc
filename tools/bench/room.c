/* SPDX-License-Identifier: MIT */
/* room.c - what frames cost of many more triangles than the context has room for, beside the same frames with room for all.
 * The context is the library's own, with max_triangles of 1024, which is its default; light is encoded, 320x240, RGB565. */
#include "tools/bench/groups.h"
#include "tools/bench/sheet.h"

enum { METHODS = 2, ROOMS = 2, FRAME = 3, TIGHT = 1024 };

static const struct crowded_scene {
    const char *scene, *name;
} scenes[] = {
    { "peer/A", "A" },          /* 70,000 triangles with colours at vertices, in one mesh or two */
    { "peer/D", "D" },          /* 51,200 of one colour each */
    { "peer/G", "G" },          /* 169 towers of 360 textured ones */
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static const struct {
    smear_method method;
    const char *name;
    double bar;                 /* of the price with room for all */
} by[METHODS] = { { SMEAR_NONE, "sharp", 3.0 }, { SMEAR_AUTO, "blurred", 4.0 } };

bool room_take(int index, struct take *out)
{
    const int tight = index % ROOMS, method = index / ROOMS % METHODS, scene = index / (ROOMS * METHODS);
    if (index < 0 || scene >= SCENES)
        return false;
    *out = (struct take){
        .scene = scenes[scene].scene, .frame = FRAME, .width = 320, .height = 240, .format = SMEAR_RGB565, .plain_context = true,
        .method = by[method].method, .texels_565 = true, .fit_grid = true, .room = tight ? TIGHT : 0
    };
    return true;
}

bool room_report(struct sheet *sheet, struct failure *f)
{
    printf("== frames of many triangles in room for %d of them, beside the same with room for all: million instructions per frame of\n"
           "   320x240, encoded light, the library's own context\n\n"
           "scene             all room for %d   times at most\n", (int)TIGHT, (int)TIGHT);
    for (int i = 0; i < SCENES * METHODS; i++) {
        uint64_t count[ROOMS];
        if (!count_takes(&sheet->counter, "room", i * ROOMS, ROOMS, &count_frame, count, f))
            return false;
        const double times = (double)count[1] / (double)count[0], bar = by[i % METHODS].bar;
        printf("%-4s %-8s %8.1f %13.1f   %5.2f %4.0f   %s\n", scenes[i / METHODS].name, by[i % METHODS].name, (double)count[0] / 1e6,
               (double)count[1] / 1e6, times, bar, sheet_most(sheet, times, bar));
        fflush(stdout);
    }
    return true;
}
