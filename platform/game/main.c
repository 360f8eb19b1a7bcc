/* SPDX-License-Identifier: MIT */
/* main.c - a race over three laps.
 *
 *     game [show]                  plays it on the display
 *     game check [SCREEN [STEP]]   drives the recorded race and prints the CRC of every STEPth frame, and the times
 *     game cost [SCREEN [STEP]]    what frames of it cost, in the units of platform.h's clock
 *
 * Keys: left and right steer, down brakes, start begins again. Who presses none for a while sees the recorded race. */
#include "platform/game/game.h"
#include "platform/game/lap.h"
#include "platform/game/view.h"

#include "platform/display.h"
#include "platform/platform.h"
#include "platform/print.h"
#include "platform/words.h"

#include <stdbool.h>

#ifndef GAME_SCREEN
#define GAME_SCREEN "pico"
#endif

/* Names are those of the demo's screens (platform/demo_player.c); "pico" is a panel of 128x128. Triangle lists have room for
 * what is in view at once. Slow boards draw sketches. */
#define SCREEN(name, w, h, pixels, buffers, px, columns, triangles, also)                                               \
    { name, { .width = w, .height = h, .format = pixels, .bands = buffers, .tile = px, .strip = columns,                \
              .max_triangles = triangles, .max_draws = VIEW_DRAWS, .reuse.one_pose = 1,                                 \
              .methods = SMEAR_SET(SMEAR_AUTO) | (also) } }

static const struct screen {
    const char *name;
    smear_desc desc;
} screens[] = {
    SCREEN("pico", 128, 128, SMEAR_RGB565_SWAPPED, 2, 16, 64, 420, SMEAR_SET_SKETCH),
    SCREEN("pico-128", 128, 128, SMEAR_RGB565_SWAPPED, 2, 16, 64, 420, SMEAR_SET_SKETCH),
    SCREEN("pico-240", 240, 240, SMEAR_RGB565_SWAPPED, 2, 16, 96, 480, SMEAR_SET_SKETCH),
    SCREEN("pico-320", 320, 240, SMEAR_RGB565_SWAPPED, 2, 16, 48, 480, SMEAR_SET_SKETCH),
    SCREEN("gba", 120, 80, SMEAR_RGB555, 1, 16, 0, 420, SMEAR_SET_SKETCH),
    SCREEN("pi-320", 320, 240, SMEAR_RGB565, 1, 32, 320, 800, 0),
    SCREEN("pi-640", 640, 480, SMEAR_RGB565, 1, 32, 640, 800, 0),
    SCREEN("linux", 640, 480, SMEAR_XRGB8888, 1, 0, 0, 800, 0),
    SCREEN("window", 640, 480, SMEAR_XRGB8888, 1, 0, 0, 800, 0),
    SCREEN("page", 320, 240, SMEAR_XRGB8888, 1, 0, 0, 800, 0)
};

static struct {
    smear_context *ctx;
    smear_desc desc;
    struct race race;
    int event, left;                /* of the recorded race: its next keys, and frames that the last ones are still held */
} game;

static int failed(const char *what)
{
    platform_print("game: ");
    platform_print(what);
    platform_print("\n");
    return 1;
}

static const struct screen *find_screen(const char *name)
{
    for (unsigned i = 0; i < sizeof screens / sizeof *screens; i++)
        if (is_word(screens[i].name, name))
            return &screens[i];
    return NULL;
}

static int start(const smear_desc *desc)
{
    size_t room;
    void *arena = platform_arena(&room);
    game.desc = *desc;
    game.event = game.left = 0;
    course_make();
    view_make();
    race_begin(&game.race);
    return smear_memory_size(desc) > room ? SMEAR_ERR_MEMORY : smear_init(&game.ctx, desc, arena, smear_memory_size(desc));
}

/* Returns what is held in the next frame of the recorded race. */
static unsigned recorded_keys(void)
{
    while (game.left == 0 && game.event < lap_keys_count)
        game.left = lap_keys[game.event++].frames;
    if (game.left == 0)
        return 0;
    game.left--;
    return lap_keys[game.event - 1].keys;
}

static int draw_frame(void)
{
    const int result = view_submit(game.ctx, &game.race, &game.desc);
    return result == SMEAR_OK ? smear_render(game.ctx) : result;
}

/* ------------------------------------------------------------------ the recorded race */

static int swallow(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    smear_band_done(game.ctx);
    return 0;
}

static uint32_t read_clock(void *user)
{
    (void)user;
    return platform_clock();
}

/* Drives it to the end, and draws every stepth frame and the one before it. */
static int replay(const struct screen *screen, uint32_t step, bool costs)
{
    smear_desc desc = screen->desc;
    smear_stats stats;
    uint32_t sum = 0, worst = 0, frames = 0;
    desc.flush = swallow;
    desc.debug.crc = !costs;
    desc.debug.clock = costs ? read_clock : NULL;
    platform_clock_start();
    int result = start(&desc);
    while (result == SMEAR_OK && game.race.finished == 0 && game.race.frame < 10000) {
        race_step(&game.race, recorded_keys(), true);
        const uint32_t since = game.race.frame % step;
        if (since != 0 && since != step - 1)
            continue;
        const uint32_t before = platform_clock();
        result = draw_frame();
        if (since != 0 || result != SMEAR_OK)
            continue;
        const uint32_t cost = platform_clock_count(platform_clock() - before);
        smear_get_stats(game.ctx, &stats);
        frames++;
        sum += cost / 16;
        worst = cost > worst ? cost : worst;
        if (costs)
            continue;
        print_decimal(game.race.frame);
        platform_print(" ");
        print_hex(stats.crc32);
        platform_print("\n");
    }
    if (result != SMEAR_OK)
        return failed(smear_error_text(result));
    platform_print(costs ? "mean " : "place ");
    print_decimal(costs ? sum / frames * 16 : (uint32_t)game.race.place);
    platform_print(costs ? ", worst " : ", frames ");
    print_decimal(costs ? worst : game.race.finished);
    platform_print(costs ? ", " : ", best lap ");
    if (!costs)
        print_decimal(game.race.best);
    platform_print(costs ? platform_clock_unit : "");
    platform_print("\n");
    return game.race.finished == 0;
}

/* ------------------------------------------------------------------ somebody plays */

static struct {
    uint32_t gone, skipped;         /* frames so far: that the race went on by, and that it did not wait for */
    uint32_t idle;                  /* frames without a key */
    unsigned before;                /* keys of the turn before */
    bool plays_itself;
} turn;

/* Returns how many frames of 1/30 s the race goes on by, so that it takes as long on any machine: where one is drawn more slowly
 * some are not drawn. 0: it is too early for the next. */
static uint32_t frames_due(void)
{
    enum { MOST = 6 };      /* after a pause the race does not jump */
    const uint32_t due = display_time() * 3 / 100 - turn.gone - turn.skipped;
    if (due <= MOST)
        return due;
    turn.skipped += due - MOST;
    return MOST;
}

int game_open(const char *name)
{
    const struct screen *screen = find_screen(name != NULL ? name : GAME_SCREEN);
    smear_desc desc = { 0 };
    if (screen != NULL)
        desc = screen->desc;
    if (screen == NULL || !display_open(&desc))
        return failed("there is no display for this screen");
    const int result = start(&desc);
    if (result != SMEAR_OK)
        return failed(smear_error_text(result));
    display_attach(game.ctx);
    return 0;
}

int game_turn(void)
{
    enum { PATIENCE = 300 };
    uint32_t due = frames_due();
    if (due == 0 && display_wait())
        return SMEAR_OK;
    const unsigned keys = display_keys(), pressed = keys & ~turn.before;
    due = due != 0 ? due : 1;
    turn.before = keys;
    turn.gone += due;
    turn.idle = keys != 0 ? 0 : turn.idle + due;
    const bool again = (pressed & KEY_START) != 0 || (turn.plays_itself && keys != 0) || (!turn.plays_itself && turn.idle >= PATIENCE)
                    || (turn.plays_itself && game.race.finished != 0 && game.race.frame > game.race.finished + 90);
    if (again) {
        turn.plays_itself = turn.idle >= PATIENCE;
        game.event = game.left = 0;
        race_begin(&game.race);
    }
    for (uint32_t i = 0; i < due; i++)
        race_step(&game.race, turn.plays_itself ? recorded_keys() : keys, i == 0);
    const int result = draw_frame();
    if (result == SMEAR_OK)
        display_show();
    return result;
}

int main(int argc, char **argv)
{
    const char *command = argc > 1 ? argv[1] : "show";
    const struct screen *screen = find_screen(argc > 2 ? argv[2] : GAME_SCREEN);
    const uint32_t step = argc > 3 ? read_decimal(argv[3]) : 10;
    if (screen == NULL || step < 2)
        return failed("usage: game [show | check | cost [SCREEN [STEP]]], SCREEN pico, gba, linux ... (main.c), STEP at least 2");
    if (is_word(command, "show")) {
        int result = game_open(screen->name);
        if (result != 0)
            return result;
        while (result == SMEAR_OK)
            result = game_turn();
        return failed(smear_error_text(result));
    }
    if (is_word(command, "check") || is_word(command, "cost"))
        return replay(screen, step, is_word(command, "cost"));
    return failed("show, check or cost");
}
