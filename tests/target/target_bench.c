/* SPDX-License-Identifier: MIT */
/* target_bench.c - what frames cost on a target: for every tape of the bench the mean over its
 * frames of instructions (microseconds on a host), in all and by stage, and what that makes per
 * pixel. Submission is part of it; starting the library is not. With arguments, only the tapes
 * whose names begin with one of them. */
#include "platform/platform.h"
#include "platform/play.h"
#include "platform/print.h"

#include <stdbool.h>

enum { COLUMN = 12 };

static uint32_t read_clock(void *user)
{
    (void)user;
    return platform_clock();
}

/* Right-aligned in `width`. */
static void print_column(uint32_t value, int width)
{
    uint32_t scale = 1;
    int digits = 1;
    for (; digits < 10 && value / scale >= 10; digits++)
        scale *= 10;
    for (int i = digits; i < width; i++)
        platform_print(" ");
    print_decimal(value);
}

/* value / unit with one decimal place, rounded down. */
static void print_ratio(uint32_t value, uint32_t unit, int width)
{
    print_column(value / unit, width - 2);
    platform_print(".");
    print_decimal(value % unit * 10 / unit);
}

static void print_name(const char *name)
{
    int length = 0;
    platform_print(name);
    while (name[length] != '\0')
        length++;
    for (; length < 14; length++)
        platform_print(" ");
}

static bool begins_with(const char *text, const char *start)
{
    while (*start != '\0' && *text == *start)
        text++, start++;
    return *start == '\0';
}

static bool is_wanted(const struct tape *tape, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (begins_with(tape->name, argv[i]))
            return true;
    return argc <= 1;
}

static bool bench(const struct tape *tape)
{
    struct player player;
    smear_stats stats;
    size_t room, need = play_memory(tape);
    void *arena = platform_arena(&room);
    uint32_t total = 0, submit = 0, raster = 0, blur = 0, convert = 0;
    print_name(tape->name);
    if (need > room) {
        platform_print(" skipped: needs ");
        print_decimal((uint32_t)need);
        platform_print(" bytes\n");
        return true;
    }
    int result = need == 0 ? SMEAR_ERR_ARG : play_start(&player, tape, arena, need, read_clock);
    for (int i = 0; i < tape->frame_count && result == SMEAR_OK; i++) {
        uint32_t before = platform_clock();
        result = play_frame(&player, i, &stats);
        total += platform_clock_count(platform_clock() - before);
        submit += platform_clock_count(stats.time.submit);
        raster += platform_clock_count(stats.time.raster);
        blur += platform_clock_count(stats.time.blur) + platform_clock_count(stats.time.reduce);
        convert += platform_clock_count(stats.time.convert);
    }
    if (result != SMEAR_OK) {
        platform_print(" ERROR ");
        print_signed(result);
        platform_print("\n");
        return false;
    }
    uint32_t frames = (uint32_t)tape->frame_count;
    uint32_t pixels = (uint32_t)tape->desc->width * (uint32_t)tape->desc->height;
    print_column(total / frames, COLUMN);
    print_ratio(total / frames, pixels, COLUMN);
    print_column(submit / frames, COLUMN);
    print_column(raster / frames, COLUMN);
    print_column(blur / frames, COLUMN);
    print_column(convert / frames, COLUMN);
    print_column(stats.triangles_drawn, COLUMN);
    print_column(stats.parts_added, COLUMN);
    print_column((uint32_t)need, COLUMN);
    platform_print("\n");
    return true;
}

int main(int argc, char **argv)
{
    bool ok = true;
    platform_clock_start();
    platform_print(platform_clock_unit);
    platform_print(" per frame; triangles of the last frame\n");
    platform_print("                     total   per pixel      submit      raster        blur"
                   "     convert   triangles      splits      memory\n");
    for (int i = 0; i < tape_count; i++)
        if (is_wanted(tape_list[i], argc, argv))
            ok = bench(tape_list[i]) && ok;
    return ok ? 0 : 1;
}
