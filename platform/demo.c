/* SPDX-License-Identifier: MIT */
/* demo.c - the demo on every machine: a racing car and a drone, blurred.
 *
 *     demo show [SCREEN [FRAME]]   the loop on the display; with FRAME, that frame, for ever
 *     demo check [SCREEN [STEP [stack]]]   the CRC of every frame of the loop, or of every STEPth;
 *                                          and how much stack was used; fails if it overflowed
 *     demo cost [SCREEN [BLUR [STEP [FOG|sky]]]]   what the loop's frames cost, in the units of platform.h's clock;
 *                                  of a way to blur of demo_player.c, or as the screen has it; of every
 *                                  STEPth frame, a divisor of the loop; in fog between two distances, 10-60,
 *                                  or before a sky
 *     demo memory                  bytes the library wants for each screen
 *
 * Without arguments it shows the loop on the target's own screen. Keys: A sharp or blurred; left
 * and right a shorter or longer shutter; start stops and goes on. */
#include "platform/demo_player.h"
#include "platform/display.h"
#include "platform/platform.h"

#include "platform/print.h"
#include "platform/words.h"

#include <smear_scene.h>
#include <stdbool.h>

#ifndef DEMO_SCREEN
#define DEMO_SCREEN "pico"
#endif

enum { COLUMN = 10 };

static struct demo_player player;

static int failed(const char *what, int result)
{
    platform_print("demo: ");
    platform_print(what);
    if (result != SMEAR_OK) {
        platform_print(" (");
        platform_print(smear_error_text(result));
        platform_print(")");
    }
    platform_print("\n");
    return 1;
}

/* Exactly as much memory as the library asks for, from the arena's start. */
static int start(const struct demo_screen *screen, const smear_desc *desc)
{
    size_t room, need = smear_memory_size(desc);
    void *arena = platform_arena(&room);
    if (need > room) {
        platform_print("demo: the context takes ");
        print_decimal((uint32_t)need);
        platform_print(" bytes of ");
        print_decimal((uint32_t)room);
        platform_print(" there are: fewer max_triangles, a smaller tile or strip (demo_player.c)\n");
        return SMEAR_ERR_MEMORY;
    }
    return demo_player_start(&player, screen, desc, arena, need);
}

/* ------------------------------------------------------------------ measuring */

static int swallow(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    smear_band_done(player.ctx);
    return 0;
}

static uint32_t read_clock(void *user)
{
    (void)user;
    return platform_clock();
}

static int check(const struct demo_screen *screen, uint32_t step, bool with_stack)
{
    smear_desc desc = screen->desc;
    smear_stats stats;
    desc.flush = swallow;
    desc.debug.crc = 1;
    desc.reuse.buffer_age = 0;       /* the CRC of all pixels */
    int result = start(screen, &desc);
    for (uint32_t i = 0; i < DEMO_LOOP && result == SMEAR_OK; i++) {
        result = demo_player_frame(&player, i, i % step == 0);
        if (result != SMEAR_OK || i % step != 0)
            continue;
        smear_get_stats(player.ctx, &stats);
        print_decimal(i);
        platform_print(" ");
        print_hex(stats.crc32);
        platform_print("\n");
    }
    if (result != SMEAR_OK)
        return failed("frame", result);
    if (platform_stack_used() == UINT32_MAX)
        return failed("the stack has overflown", 0);
    if (with_stack) {
        platform_print("stack ");
        print_decimal(platform_stack_used());
        platform_print("\n");
    }
    return 0;
}

/* A sum over frames, of which the mean fits 32 bits: whole ones and the rest, in 1/frames. */
struct sum {
    uint32_t mean, rest, frames;
};

static void add(struct sum *s, uint32_t count)
{
    s->mean += count / s->frames;
    s->rest += count % s->frames;
}

static void print_row(const char *name, struct sum s, uint32_t pixels)
{
    uint32_t per_frame = s.mean + (s.rest + s.frames / 2) / s.frames;
    platform_print(name);
    print_decimal(per_frame);
    platform_print(" per frame, ");
    print_decimal(per_frame / pixels);
    platform_print(".");
    print_decimal(per_frame % pixels * 10 / pixels);
    platform_print(" per pixel\n");
}

/* Frames in which more than half of the tiles move, as the camera does, or not. */
struct shot {
    uint32_t frames, thousands, moving, tiles;
};

static void add_frame(struct shot *s, uint32_t count, uint32_t moving, uint32_t tiles)
{
    s->frames++;
    s->thousands += (count + 500) / 1000;
    s->moving += moving;
    s->tiles += tiles;
}

static void print_shot(const char *name, const struct shot *s, uint32_t pixels)
{
    if (s->frames == 0)
        return;
    print_row(name, (struct sum){ s->thousands / s->frames * 1000, s->thousands % s->frames * 1000, s->frames }, pixels);
    platform_print("          in ");
    print_decimal(s->frames);
    platform_print(" frames, of whose tiles move ");
    print_decimal(s->moving * 100 / s->tiles);
    platform_print(" %\n");
}

/* Means over every stepth frame of the loop, from the middle of the first step on.
 * Where the display keeps what it is sent, frames before those are drawn, too, and not counted. */
static int cost(const struct demo_screen *screen, const struct demo_blur *way, uint32_t step, const smear_fog *fog,
                const smear_scene *extras)
{
    smear_desc desc = screen->desc;
    smear_stats stats;
    struct sum total = { 0, 0, DEMO_LOOP / step }, submit = total, raster = total, blur = total,
               convert = total;
    struct shot shot[2] = { { 0, 0, 0, 0 }, { 0, 0, 0, 0 } };
    uint32_t worst = 0;
    uint32_t moving = 0, kept = 0, tiles = 0, triangles = 0, drawn = 0, split = 0, dropped = 0;
    desc.flush = swallow;
    desc.debug.clock = read_clock;
    if (way != NULL)
        demo_blur_desc(way, screen, &desc);
    platform_clock_start();
    int result = start(screen, &desc);
    player.blur = way;
    player.fog = fog;
    player.extras = extras;
    for (uint32_t i = 0; i < DEMO_LOOP && result == SMEAR_OK; i++) {
        uint32_t before = platform_clock();
        const bool counts = i % step == step / 2;
        const bool leads = i % step < step / 2 && i % step + desc.reuse.buffer_age >= step / 2;
        result = demo_player_frame(&player, i, counts || leads);
        uint32_t count = platform_clock_count(platform_clock() - before);
        if (!counts)
            continue;
        smear_get_stats(player.ctx, &stats);
        add(&total, count);
        worst = count > worst ? count : worst;
        add(&submit, platform_clock_count(stats.time.submit));
        add(&raster, platform_clock_count(stats.time.raster));
        add(&blur, platform_clock_count(stats.time.blur) + platform_clock_count(stats.time.reduce));
        add(&convert, platform_clock_count(stats.time.convert));
        const uint32_t there = stats.tiles_uniform + stats.tiles_complex, all = stats.tiles_static + there;
        add_frame(&shot[2 * there > all], count, there, all);
        moving += there;
        kept += stats.tiles_kept;
        tiles += all;
        triangles = stats.triangles_in;
        drawn += stats.triangles_drawn;
        split += stats.parts_added;
        dropped += stats.triangles_dropped;
    }
    if (result != SMEAR_OK)
        return failed("frame", result);
    if (platform_stack_used() == UINT32_MAX)
        return failed("the stack has overflown", 0);
    uint32_t pixels = (uint32_t)desc.width * (uint32_t)desc.height;
    platform_print(screen->name);
    platform_print(": ");
    platform_print(platform_clock_unit);
    platform_print(", means over the loop\n");
    print_row("total    ", total, pixels);
    print_row(" submit  ", submit, pixels);
    print_row(" raster  ", raster, pixels);
    print_row(" blur    ", blur, pixels);
    print_row(" convert ", convert, pixels);
    print_shot("camera   ", &shot[1], pixels);
    print_shot("objects  ", &shot[0], pixels);
    platform_print("worst    ");
    print_decimal(worst);
    platform_print("\ntiles moving ");
    print_decimal(moving * 100 / tiles);
    platform_print(" %, kept by the display ");
    print_decimal(kept * 100 / tiles);
    platform_print(" %, triangles ");
    print_decimal(triangles);
    platform_print(", drawn ");
    print_decimal(drawn / total.frames);
    platform_print(", frames in parts ");
    print_decimal(split);
    platform_print(", dropped ");
    print_decimal(dropped);
    platform_print("\nmemory ");
    print_decimal((uint32_t)smear_memory_size(&desc));
    platform_print(", scene ");
    print_decimal(sizeof player);
    platform_print(", stack ");
    print_decimal(platform_stack_used());
    platform_print("\n");
    return 0;
}

/* Reads two distances in metres, as 10-60; false where they are none, or not in this order. */
static bool read_fog(smear_fog *fog, const char *text)
{
    const char *end = text;
    while (*end != '-' && *end != '\0')
        end++;
    const uint32_t begins = read_decimal(text), ends = *end == '-' ? read_decimal(end + 1) : 0;
    *fog = (smear_fog){ .color = 0xa0b4c8, .near_plane = (int32_t)(begins << 16), .far_plane = (int32_t)(ends << 16) };
    return begins < ends && ends < 1u << 15;
}

static int cost_of(const struct demo_screen *screen, const char *name, uint32_t step, const char *between)
{
    static smear_sky sky = SMEAR_SKY(0x4078c8, 0xb8d8f0, 0x8a9a78, 0x404838);
    const smear_scene extras = { .sky = &sky };
    const bool has_sky = between != NULL && is_word("sky", between);
    smear_fog fog;
    if (between != NULL && !has_sky && !read_fog(&fog, between))
        return failed("fog lies between two distances in metres, as 10-60", 0);
    const struct demo_blur *way = name != NULL ? demo_blur_find(name) : NULL;
    if (name != NULL && way == NULL)
        return failed("no such way to blur", 0);
    if (step == 0 || DEMO_LOOP % step != 0)
        return failed("the step must divide the loop", 0);
    return cost(screen, way, step, between != NULL && !has_sky ? &fog : NULL, has_sky ? &extras : NULL);
}

static int memory(void)
{
    for (int i = 0; i < demo_screen_count; i++) {
        smear_desc desc = demo_screens[i].desc;
        desc.flush = swallow;
        platform_print(demo_screens[i].name);
        platform_print(" ");
        print_decimal((uint32_t)smear_memory_size(&desc));
        platform_print("\n");
    }
    return 0;
}

/* ------------------------------------------------------------------ showing */

/* One frame, with the motion it has in the loop, and after those before it, of which the display keeps what
 * stands still; again whenever keys change it. */
static int hold(uint32_t frame, struct demo_controls *controls)
{
    enum { BEFORE = 3 };
    do {
        for (uint32_t i = frame + DEMO_LOOP - BEFORE; i <= frame + DEMO_LOOP; i++) {
            int result = demo_player_frame(&player, i % DEMO_LOOP, true);
            if (result != SMEAR_OK)
                return failed("frame", result);
            display_show();
        }
        platform_print("shown\n");
        do {
            if (!display_wait())
                return 0;
        } while (!demo_player_obey(&player, controls, display_keys()));
    } while (true);
}

static int show(const struct demo_screen *screen, const char *frame)
{
    smear_desc desc = screen->desc;
    if (!display_open(&desc))
        return failed("there is no display for this screen", 0);
    int result = start(screen, &desc);
    if (result != SMEAR_OK)
        return failed("start", result);
    display_attach(player.ctx);
    struct demo_controls controls = { .held = display_keys() };
    if (frame != NULL)
        return hold(read_decimal(frame) % DEMO_LOOP, &controls);
    for (uint32_t i = 0; result == SMEAR_OK; i = (i + !controls.is_paused) % DEMO_LOOP) {
        demo_player_obey(&player, &controls, display_keys());
        result = demo_player_frame(&player, i, true);
        if (result == SMEAR_OK)
            display_show();
    }
    return failed("frame", result);
}

int main(int argc, char **argv)
{
    const char *command = argc > 1 ? argv[1] : "show", *name = argc > 2 ? argv[2] : DEMO_SCREEN;
    uint32_t step = argc > 3 ? read_decimal(argv[3]) : 0;
    const struct demo_screen *screen = demo_screen_find(name);
    if (screen == NULL)
        return failed("no screen of this name", 0);
    if (is_word(command, "show"))
        return show(screen, argc > 3 ? argv[3] : NULL);
    if (is_word(command, "check"))
        return check(screen, step > 0 ? step : 1, argc > 4);
    if (is_word(command, "cost"))
        return cost_of(screen, argc > 3 ? argv[3] : NULL, argc > 4 ? read_decimal(argv[4]) : 1, argc > 5 ? argv[5] : NULL);
    if (is_word(command, "memory"))
        return memory();
    return failed("usage: demo [show | check | cost | memory [SCREEN [NUMBER]]]", 0);
}
