/* SPDX-License-Identifier: MIT */
/* target_screen.c - host program: what a frame of the demo looks like on a screen, and whether a
 * screenshot of an emulated machine shows exactly that.
 *
 *     target_screen crcs SCREEN STEP
 *     target_screen kept SCREEN
 *     target_screen keys SCREEN FRAMES FRAME:MASK,...
 *     target_screen picture SCREEN FRAME SHUTTER OUT.png
 *     target_screen compare SCREEN FRAME SHUTTER SHOT.ppm ZOOM
 *
 * `crcs` prints what `demo check` must print. `kept` plays the loop twice on a display that keeps what it is sent, and
 * says whether it shows every frame as one that is sent all. `keys` prints the CRCs of the first FRAMES frames that `demo show`
 * shows while the keys of each mask (enum display_key) are held from its frame on. SHUTTER in degrees, 0 is sharp. A pixel of the
 * screen is ZOOM x ZOOM pixels of the screenshot,
 * all of one colour; what a larger screenshot has around the picture is of one colour, too.
 * Every code of the display's format must come back, to the bit. */
#include "platform/demo_player.h"
#include "tests/target/panel.h"
#include "tools/player/picture.h"

#include <inttypes.h>
#include <stdlib.h>

enum { DEFAULT_SHUTTER = 180 };

struct screen {
    const smear_desc *desc;
    uint8_t *pixels;                /* in the display's format */
};

static size_t row_bytes(const smear_desc *desc)
{
    return picture_row_bytes(desc->width, desc->format);
}

static size_t screen_bytes(const smear_desc *desc)
{
    return row_bytes(desc) * (size_t)desc->height;
}

static int take_band(void *user, const smear_band *band)
{
    const struct screen *screen = user;
    picture_put_band(screen->pixels, row_bytes(screen->desc), screen->desc->format, band);
    return 0;
}

/* The colour of a pixel, 0xRRGGBB. */
static uint32_t shown(const struct screen *screen, int x, int y)
{
    const uint8_t format = screen->desc->format;
    return panel_color(panel_code(screen->pixels + (size_t)y * row_bytes(screen->desc), x, format), format);
}

/* Starts the library in memory that the caller frees; null on failure. */
static void *start(struct demo_player *player, const struct demo_screen *which, smear_desc desc,
                   struct failure *f)
{
    size_t bytes = smear_memory_size(&desc);
    void *memory = malloc(bytes);
    if (memory == NULL) {
        fail(f, "out of memory");
        return NULL;
    }
    int result = demo_player_start(player, which, &desc, memory, bytes);
    if (result == SMEAR_OK)
        return memory;
    fail(f, "the library does not start: %s", smear_error_text(result));
    free(memory);
    return NULL;
}

static bool draw(struct screen *screen, const struct demo_screen *which, uint32_t frame,
                 uint16_t shutter, struct failure *f)
{
    struct demo_player player;
    smear_desc desc = which->desc;
    desc.bands = 1;
    desc.reuse.buffer_age = 0;
    desc.flush = take_band;
    desc.user = screen;
    screen->desc = &which->desc;
    screen->pixels = calloc(1, screen_bytes(&desc));
    void *memory = screen->pixels != NULL ? start(&player, which, desc, f) : NULL;
    if (memory == NULL)
        return false;
    player.shutter_degrees = shutter;
    int result = SMEAR_OK;
    for (uint32_t before = 3; before-- > 0 && result == SMEAR_OK;)      /* poses of two frames ago tell the curves */
        result = demo_player_frame(&player, (frame + DEMO_LOOP - before) % DEMO_LOOP, before == 0);
    free(memory);
    return result == SMEAR_OK || fail(f, "the library refused the frame: %s", smear_error_text(result));
}

/* A player for a display that is sent all, or keeps what it is sent; its memory is never given back. */
static bool start_kept(struct demo_player *player, const struct demo_screen *which, struct screen *screen, int buffers,
                       struct failure *f)
{
    smear_desc desc = which->desc;
    desc.bands = 1;
    desc.reuse.buffer_age = (uint8_t)buffers;
    desc.flush = take_band;
    desc.user = screen;
    screen->desc = &which->desc;
    return start(player, which, desc, f) != NULL;
}

/* Frames depend on those before them: as `demo check`, one player goes through the loop. */
static bool crcs(const struct demo_screen *which, uint32_t step, struct failure *f)
{
    static struct demo_player player;
    struct screen screen = { .pixels = calloc(1, screen_bytes(&which->desc)) };
    if (screen.pixels == NULL || !start_kept(&player, which, &screen, 0, f))
        return false;
    for (uint32_t i = 0; i < DEMO_LOOP; i++) {
        if (demo_player_frame(&player, i, i % step == 0) != SMEAR_OK)
            return fail(f, "the library refused frame %u", i);
        if (i % step == 0)
            printf("%" PRIu32 " %08" PRIx32 "\n", i, picture_crc(screen.pixels, screen_bytes(&which->desc), which->desc.format));
    }
    free(screen.pixels);
    return true;
}

/* Of as many buffers as the screen has, or one, which are shown in turn. */
static bool kept(const struct demo_screen *which, struct failure *f)
{
    static struct demo_player keeps, all;
    const size_t bytes = screen_bytes(&which->desc);
    const int buffers = which->desc.reuse.buffer_age;
    uint8_t *pixels = calloc((size_t)buffers + 1, bytes);
    struct screen shown = { .pixels = pixels }, want = { .pixels = pixels != NULL ? pixels + bytes * (size_t)buffers : NULL };
    uint32_t tiles = 0;
    if (pixels == NULL || buffers == 0)
        return fail(f, pixels == NULL ? "out of memory" : "keeps nothing");
    if (!start_kept(&keeps, which, &shown, buffers, f) || !start_kept(&all, which, &want, 0, f))
        return false;
    for (uint32_t i = 0; i < 2 * DEMO_LOOP; i++) {
        smear_stats stats;
        shown.pixels = pixels + bytes * (i % (uint32_t)buffers);
        if (demo_player_frame(&keeps, i, true) != SMEAR_OK || demo_player_frame(&all, i, true) != SMEAR_OK)
            return fail(f, "the library refused frame %u", i);
        if (memcmp(shown.pixels, want.pixels, bytes) != 0)
            return fail(f, "frame %u is another", i);
        smear_get_stats(keeps.ctx, &stats);
        tiles += stats.tiles_kept;
    }
    free(pixels);
    if (tiles == 0)
        return fail(f, "all tiles were sent in all frames");
    printf("%s: %u tiles kept in %d frames\n", which->name, tiles, 2 * DEMO_LOOP);
    return true;
}

/* The keys that are held from `frame` on, if the list has it. */
static void hold(const char *list, uint32_t frame, unsigned *held)
{
    while (*list != '\0') {
        char *end;
        const unsigned long from = strtoul(list, &end, 10);
        const unsigned long mask = *end == ':' ? strtoul(end + 1, &end, 10) : 0;
        if (from == frame)
            *held = (unsigned)mask;
        list = *end == ',' ? end + 1 : "";
    }
}

static bool with_keys(const struct demo_screen *which, uint32_t frames, const char *list, struct failure *f)
{
    struct demo_player player;
    struct demo_controls controls = { .held = 0 };
    struct screen screen = { .pixels = calloc(1, screen_bytes(&which->desc)) };
    unsigned held = 0;
    uint32_t shown = 0;
    if (screen.pixels == NULL)
        return fail(f, "out of memory");
    if (!start_kept(&player, which, &screen, 0, f))
        return false;
    hold(list, 0, &controls.held);
    for (uint32_t i = 0; i < frames; i++) {
        hold(list, i, &held);
        demo_player_obey(&player, &controls, held);
        if (demo_player_frame(&player, shown, true) != SMEAR_OK)
            return fail(f, "the library refused frame %u", i);
        printf("%" PRIu32 " %08" PRIx32 "\n", i, picture_crc(screen.pixels, screen_bytes(&which->desc), which->desc.format));
        shown = (shown + !controls.is_paused) % DEMO_LOOP;
    }
    free(screen.pixels);
    return true;
}

static bool save(const struct screen *screen, const char *path, struct failure *f)
{
    struct image image;
    if (!image_alloc(&image, screen->desc->width, screen->desc->height, f))
        return false;
    for (int i = 0; i < image.width * image.height; i++) {
        const uint32_t color = shown(screen, i % image.width, i / image.width);
        image.rgba[4 * i] = (uint8_t)(color >> 16);
        image.rgba[4 * i + 1] = (uint8_t)(color >> 8);
        image.rgba[4 * i + 2] = (uint8_t)color;
    }
    bool ok = png_save(path, &image, f);
    image_free(&image);
    return ok;
}

static uint32_t color_at(const uint8_t *rgba)
{
    return (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2];
}

static bool compare(const struct screen *screen, const char *path, int zoom, struct failure *f)
{
    struct image shot;
    int width = screen->desc->width, height = screen->desc->height, wrong = 0;
    if (!image_load(path, &shot, f))
        return false;
    int left = (shot.width - width * zoom) / 2, top = (shot.height - height * zoom) / 2;
    if (shot.width < width * zoom || shot.height < height * zoom) {
        fail(f, "is %dx%d, less than %d times %dx%d", shot.width, shot.height, zoom, width, height);
        image_free(&shot);
        return false;
    }
    uint32_t border = color_at(shot.rgba);
    int all = shot.width * shot.height;
    for (int y = 0; y < shot.height; y++)
        for (int x = 0; x < shot.width; x++) {
            const uint8_t *p = shot.rgba + 4 * ((size_t)y * (size_t)shot.width + (size_t)x);
            bool is_inside = x >= left && x < left + width * zoom && y >= top && y < top + height * zoom;
            uint32_t want = border;
            if (is_inside)
                want = shown(screen, (x - left) / zoom, (y - top) / zoom);
            if (color_at(p) != want)
                wrong++;
        }
    image_free(&shot);
    if (wrong > 0)
        return fail(f, "%d of %d pixels differ from the host's frame", wrong, all);
    printf("%s: %dx%d pixels as drawn by the host\n", path, width, height);
    return true;
}

static const char usage[] = "usage: target_screen crcs SCREEN STEP\n"
                            "       target_screen kept SCREEN\n"
                            "       target_screen keys SCREEN FRAMES FRAME:MASK,...\n"
                            "       target_screen picture SCREEN FRAME SHUTTER OUT.png\n"
                            "       target_screen compare SCREEN FRAME SHUTTER SHOT.ppm ZOOM\n";

int main(int argc, char **argv)
{
    struct failure f = { "" };
    struct screen screen = { .pixels = NULL };
    const struct demo_screen *which = argc > 2 ? demo_screen_find(argv[2]) : NULL;
    bool ok;
    if (which == NULL) {
        fputs(usage, stderr);
        return 2;
    }
    uint32_t number = argc > 3 ? (uint32_t)atoi(argv[3]) : 0;
    uint16_t shutter = argc > 4 ? (uint16_t)atoi(argv[4]) : 0;
    if (argc == 4 && strcmp(argv[1], "crcs") == 0 && number > 0) {
        ok = crcs(which, number, &f);
    } else if (argc == 3 && strcmp(argv[1], "kept") == 0) {
        ok = kept(which, &f);
    } else if (argc == 5 && strcmp(argv[1], "keys") == 0) {
        ok = with_keys(which, number, argv[4], &f);
    } else if (argc == 6 && strcmp(argv[1], "picture") == 0) {
        ok = draw(&screen, which, number % DEMO_LOOP, shutter, &f) && save(&screen, argv[5], &f);
    } else if (argc == 7 && strcmp(argv[1], "compare") == 0) {
        ok = draw(&screen, which, number % DEMO_LOOP, shutter, &f) &&
             compare(&screen, argv[5], atoi(argv[6]), &f);
    } else {
        fputs(usage, stderr);
        return 2;
    }
    if (!ok)
        fprintf(stderr, "target_screen: %s: %s\n", argv[argc > 5 ? 5 : 2], f.text);
    free(screen.pixels);
    return ok ? 0 : 1;
}
