/* SPDX-License-Identifier: MIT */
/* main.c - a race over three laps.
 *
 *     game [show]                  plays it on the display
 *     game check [SCREEN [STEP]]   drives the recorded race and prints the CRC of every STEPth frame, and the times
 *     game cost [SCREEN [STEP]]    what frames of it cost, in the units of platform.h's clock
 *
 * Keys: left and right steer, down brakes, start begins again. Who presses none for a while sees the recorded race. */
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

/* Triangle lists have room for what is in view at once. */
static const struct screen {
    const char *name;
    smear_desc desc;
} screens[] = {
    { "pico", { .width = 128, .height = 128, .format = SMEAR_RGB565_SWAPPED, .bands = 2, .tile = 16, .strip = 64,
                .max_triangles = 420, .max_draws = VIEW_DRAWS, .reuse.one_pose = 1 } },
    { "window", { .width = 640, .height = 480, .format = SMEAR_XRGB8888, .bands = 1, .max_triangles = 800,
                  .max_draws = VIEW_DRAWS, .reuse.one_pose = 1 } }
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
    const int result = view_submit(game.ctx, &game.race, game.desc.width, game.desc.height);
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
        race_step(&game.race, recorded_keys());
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

static int show(const struct screen *screen)
{
    enum { PATIENCE = 300 };
    smear_desc desc = screen->desc;
    if (!display_open(&desc))
        return failed("there is no display for this screen");
    int result = start(&desc);
    if (result != SMEAR_OK)
        return failed(smear_error_text(result));
    display_attach(game.ctx);
    uint32_t idle = 0;
    bool plays_itself = false;
    for (unsigned before = 0; result == SMEAR_OK;) {
        const unsigned keys = display_keys(), pressed = keys & ~before;
        before = keys;
        idle = keys != 0 ? 0 : idle + 1;
        const bool again = (pressed & KEY_START) != 0 || (plays_itself && keys != 0) || (!plays_itself && idle == PATIENCE)
                        || (plays_itself && game.race.finished != 0 && game.race.frame > game.race.finished + 90);
        if (again) {
            plays_itself = idle >= PATIENCE;
            game.event = game.left = 0;
            race_begin(&game.race);
        }
        race_step(&game.race, plays_itself ? recorded_keys() : keys);
        result = draw_frame();
        if (result == SMEAR_OK)
            display_show();
    }
    return failed(smear_error_text(result));
}

int main(int argc, char **argv)
{
    const char *command = argc > 1 ? argv[1] : "show";
    const struct screen *screen = find_screen(argc > 2 ? argv[2] : GAME_SCREEN);
    const uint32_t step = argc > 3 ? read_decimal(argv[3]) : 10;
    if (screen == NULL || step < 2)
        return failed("usage: game [show | check | cost [pico | window [STEP]]], STEP at least 2");
    if (is_word(command, "show"))
        return show(screen);
    if (is_word(command, "check") || is_word(command, "cost"))
        return replay(screen, step, is_word(command, "cost"));
    return failed("show, check or cost");
}
