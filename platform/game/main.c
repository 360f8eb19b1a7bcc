/* SPDX-License-Identifier: MIT */
/* main.c - a race over three laps.
 *
 *     game [show]                  plays it on the display
 *     game check [SCREEN [STEP]]   drives the recorded race and prints the CRC of every STEPth frame, the times, and a
 *                                  checksum of what is heard
 *     game cost [SCREEN [STEP]]    what frames of it cost, in the units of platform.h's clock
 *     game drive [SCREEN [FROM [COUNT]]]   shows COUNT frames of the recorded race from FROM on, as fast as they come: frames per
 *                                          second of the display's clock
 *
 * Keys: left and right steer, down brakes, start begins again, A shows the picture blurred, one half of it sharp, sharp. Who
 * presses none for a while sees the recorded race. */
#include "platform/game/engine.h"
#include "platform/game/game.h"
#include "platform/game/lap.h"
#include "platform/game/screen.h"

#include "platform/display.h"
#include "platform/platform.h"
#include "platform/print.h"
#include "platform/words.h"

#include <stdbool.h>
#include <string.h>

#ifndef GAME_SCREEN
#define GAME_SCREEN "pico"
#endif

static struct {
    smear_context *ctx;
    smear_desc desc;
    struct view_way way;
    struct race race;
    struct lap lap;
    smear_flush_fn *flush;          /* the display's */
    void *user;
    uint8_t *half;                  /* room for the right half of a picture, or null */
    enum { BLURRED, SPLIT, SHARP } shows;
    enum { PASS, KEEP, JOIN } bands;        /* what happens to them on their way to the display */
} game;

static int failed(const char *what)
{
    platform_print("game: ");
    platform_print(what);
    platform_print("\n");
    return 1;
}

static uint32_t pixel_bytes(void)
{
    return game.desc.format == SMEAR_XRGB8888 ? 4 : 2;
}

static size_t half_bytes(void)
{
    return (size_t)(game.desc.width / 2) * (size_t)game.desc.height * pixel_bytes();
}

static int start(const struct screen *screen, const smear_desc *desc)
{
    size_t room;
    uint8_t *arena = platform_arena(&room);
    const size_t size = (smear_memory_size(desc) + 7) & ~(size_t)7;
    game.desc = *desc;
    game.way = screen->way;
    game.lap = (struct lap){ 0 };
    course_make(desc->height);
    view_make();
    race_begin(&game.race);
    game.half = size + half_bytes() <= room ? arena + size : NULL;
    return size > room ? SMEAR_ERR_MEMORY : smear_init(&game.ctx, desc, arena, size);
}

/* `frames` after the one before. */
static int draw_frame(uint32_t frames)
{
    const int result = view_submit(game.ctx, &game.race, &game.desc, &game.way, frames);
    return result == SMEAR_OK ? smear_render(game.ctx) : result;
}

/* The frame is drawn twice: blurred, of which the right half is kept, and sharp, into which it is put. Bands are whole rows. */
static int take_band(void *user, const smear_band *band)
{
    const uint32_t bytes = (uint32_t)(game.desc.width / 2) * pixel_bytes();
    uint8_t *at = (uint8_t *)(uintptr_t)band->pixels + (uint32_t)game.desc.width * pixel_bytes() - bytes;
    uint8_t *kept = game.half + (uint32_t)band->y * bytes;
    (void)user;
    for (int y = 0; game.bands != PASS && y < band->height; y++, at += band->stride, kept += bytes)
        memcpy(game.bands == KEEP ? kept : at, game.bands == KEEP ? at : kept, bytes);
    if (game.bands != KEEP)
        return game.flush(game.user, band);
    if (game.desc.bands == 2)
        smear_band_done(game.ctx);
    return 0;
}

static int draw_shown(uint32_t frames)
{
    int result = SMEAR_OK;
    game.way.method = game.shows == SHARP ? SMEAR_NONE : SMEAR_AUTO;
    game.way.split = game.shows == SPLIT;
    game.bands = game.shows == SPLIT ? KEEP : PASS;
    if (game.shows == SPLIT)
        result = draw_frame(frames);
    if (result == SMEAR_OK && game.shows == SPLIT) {
        game.way.method = SMEAR_NONE;
        game.bands = JOIN;
    }
    return result == SMEAR_OK ? draw_frame(frames) : result;
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

/* Returns the checksum with those of a frame. */
static uint32_t add_samples(uint32_t sum, struct sound_voice *voice)
{
    static int16_t sample[SOUND_FRAME];
    const struct sound_tone tone = engine_tone(&game.race);
    sound_samples(voice, &tone, sample, SOUND_FRAME);
    for (int i = 0; i < SOUND_FRAME; i++)
        sum = (sum ^ (uint16_t)sample[i]) * 16777619u;
    return sum;
}

/* Drives it to the end, and draws every stepth frame and those that the board would have shown before it, the first of which begins
 * after a cut: as a sketch may depend on the frame before, costs are of the fourth. */
static int replay(const struct screen *screen, uint32_t step, bool costs)
{
    smear_desc desc = screen->desc;
    smear_stats stats;
    uint32_t sum = 0, worst = 0, frames = 0;
    desc.flush = swallow;
    desc.debug.crc = !costs;
    desc.debug.clock = costs ? read_clock : NULL;
    platform_clock_start();
    int result = start(screen, &desc);
    const uint32_t most = costs ? 3 : 1;
    struct sound_voice voice = { 0 };
    uint32_t heard = 0;
    uint32_t left = most;           /* frames until the one that counts, of those that are drawn */
    while (result == SMEAR_OK && game.race.finished == 0 && game.race.frame < 10000) {
        race_step(&game.race, lap_held(&game.lap), true);
        heard = costs ? 0 : add_samples(heard, &voice);
        if ((game.race.frame + left * screen->frames) % step != 0)
            continue;
        const uint32_t before = platform_clock();
        result = draw_frame(left == most ? 0 : screen->frames);
        left = left > 0 ? left - 1 : most;
        if (left != most || result != SMEAR_OK)
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
    platform_print(costs ? platform_clock_unit : ", sound ");
    if (!costs)
        print_hex(heard);
    platform_print("\n");
    return game.race.finished == 0;
}

/* ------------------------------------------------------------------ somebody plays */

enum { MOST = 6 };                  /* frames of the race in a turn: after a pause it does not jump */

static struct {
    uint32_t gone, skipped;         /* frames so far: that the race went on by, and that it did not wait for */
    uint32_t idle;                  /* frames without a key */
    unsigned before;                /* keys of the turn before */
    bool plays_itself;
    uint32_t counted_since, counted;
} turn;

/* Returns how many frames of 1/30 s the race goes on by, so that it takes as long on any machine: where one is drawn more slowly
 * some are not drawn. 0: it is too early for the next. */
static uint32_t frames_due(void)
{
    const uint32_t due = display_time() * 3 / 100 - turn.gone - turn.skipped;
    if (due <= MOST)
        return due;
    turn.skipped += due - MOST;
    return MOST;
}

int game_open(const char *name)
{
    const struct screen *screen = screen_find(name != NULL ? name : GAME_SCREEN);
    smear_desc desc = { 0 };
    if (screen != NULL)
        desc = screen->desc;
    if (screen == NULL || !display_open(&desc))
        return failed("there is no display for this screen");
    game.flush = desc.flush;
    game.user = desc.user;
    desc.flush = take_band;
    desc.reuse.buffer_age = 0;      /* the camera moves */
    const int result = start(screen, &desc);
    if (result != SMEAR_OK)
        return failed(smear_error_text(result));
    display_attach(game.ctx);
    return 0;
}

/* Goes on by so many frames, draws the last one and shows it. */
static int go_on(uint32_t frames, unsigned keys)
{
    for (uint32_t i = 0; i < frames; i++) {
        race_step(&game.race, turn.plays_itself ? lap_held(&game.lap) : keys, i == 0);
        const struct sound_tone tone = engine_tone(&game.race);
        sound_play(&tone);
    }
    const int result = draw_shown(frames);
    if (result == SMEAR_OK)
        display_show();
    return result;
}

/* Frames per second, counted for a second. */
static void count_frame(void)
{
    const uint32_t gone = display_time() - turn.counted_since;
    turn.counted++;
    if (gone < 1000)
        return;
    game.way.rate = (uint16_t)((turn.counted * 1000 + gone / 2) / gone);
    turn.counted_since += gone;
    turn.counted = 0;
}

int game_turn(void)
{
    enum { PATIENCE = 300 };
    uint32_t due = frames_due();
    if (due == 0 && display_wait())
        return SMEAR_OK;
    const unsigned keys = display_keys(), pressed = keys & ~turn.before;
    const bool drives = (keys & ~(unsigned)KEY_A) != 0;
    due = due != 0 ? due : 1;
    turn.before = keys;
    turn.gone += due;
    turn.idle = drives ? 0 : turn.idle + due;
    const bool again = (pressed & KEY_START) != 0 || (turn.plays_itself && drives) || (!turn.plays_itself && turn.idle >= PATIENCE)
                    || (turn.plays_itself && game.race.finished != 0 && game.race.frame > game.race.finished + 90);
    if (again) {
        turn.plays_itself = turn.idle >= PATIENCE;
        game.lap = (struct lap){ 0 };
        race_begin(&game.race);
    }
    if ((pressed & KEY_A) != 0)
        game.shows = game.shows == SHARP ? BLURRED : game.shows == BLURRED && game.half != NULL ? SPLIT : SHARP;
    game.way.waits = turn.plays_itself;
    count_frame();
    return go_on(due, keys);
}

/* A first frame, of which the others' poses come, is not counted. */
static int drive(const char *name, uint32_t from, uint32_t count)
{
    int result = game_open(name);
    if (result != 0)
        return result;
    while (game.race.frame + 1 < from)
        race_step(&game.race, lap_held(&game.lap), true);
    turn.plays_itself = true;
    uint32_t began = 0, before = 0;
    for (uint32_t i = 0; i <= count && result == SMEAR_OK; i++) {
        const uint32_t now = display_time(), due = (now - before) * 3 / 100;
        before = due > 0 ? before + due * 100 / 3 : now;
        began = i == 1 ? now : began;
        result = go_on(due < 1 || i == 0 ? 1 : due > MOST ? MOST : due, 0);
    }
    if (result != SMEAR_OK)
        return failed(smear_error_text(result));
    const uint32_t tenths = count * 10000 / (display_time() - began);
    platform_print("frames ");
    print_decimal(from);
    platform_print(" to ");
    print_decimal(game.race.frame);
    platform_print(": ");
    print_decimal(tenths / 10);
    platform_print(".");
    print_decimal(tenths % 10);
    platform_print(" per second\n");
    return 0;
}

int main(int argc, char **argv)
{
    const char *command = argc > 1 ? argv[1] : "show";
    const struct screen *screen = screen_find(argc > 2 ? argv[2] : GAME_SCREEN);
    const uint32_t step = argc > 3 ? read_decimal(argv[3]) : 10;
    if (screen == NULL || step <= 3u * screen->frames)
        return failed("usage: game [show | check | cost | drive [SCREEN [STEP]]], SCREEN of screen.c, STEP 10 or more");
    if (is_word(command, "show")) {
        int result = game_open(screen->name);
        if (result != 0)
            return result;
        while (result == SMEAR_OK)
            result = game_turn();
        return failed(smear_error_text(result));
    }
    if (is_word(command, "drive"))
        return drive(screen->name, argc > 3 ? step : 60, argc > 4 ? read_decimal(argv[4]) : 30);
    if (is_word(command, "check") || is_word(command, "cost"))
        return replay(screen, step, is_word(command, "cost"));
    return failed("show, check, cost or drive");
}
