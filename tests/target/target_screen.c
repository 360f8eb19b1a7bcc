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
#include "tools/image/image.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_SHUTTER = 180 };

struct screen {
    const smear_desc *desc;
    uint32_t *code;                 /* of each pixel, in the display's format */
};

/* Codes of a band, pixel by pixel. */
static int take_band(void *user, const smear_band *band)
{
    struct screen *screen = user;
    const uint8_t *row = band->pixels;
    for (int y = 0; y < band->height; y++, row += band->stride) {
        uint32_t *to = screen->code + (size_t)(band->y + y) * (size_t)screen->desc->width + band->x;
        for (int x = 0; x < band->width; x++) {
            uint32_t word;
            switch (screen->desc->format) {
            case SMEAR_L4:
                *to++ = row[x / 2] >> (x % 2 == 0 ? 4 : 0) & 15u;
                break;
            case SMEAR_RGB565_SWAPPED:
                *to++ = (uint32_t)row[2 * x] << 8 | row[2 * x + 1];
                break;
            case SMEAR_RGB565:
            case SMEAR_RGB555:
                *to++ = (uint32_t)row[2 * x + 1] << 8 | row[2 * x];
                break;
            default:                /* XRGB8888 */
                memcpy(&word, row + 4 * x, sizeof word);
                *to++ = word;
            }
        }
    }
    return 0;
}

static uint32_t widen(uint32_t code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

/* The colour that a display shows for a code, 0xRRGGBB. */
static uint32_t shown(uint32_t code, uint8_t format)
{
    switch (format) {
    case SMEAR_L4:
        return code * 0x111111u;
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
        return widen(code >> 11, 5) << 16 | widen(code >> 5 & 63, 6) << 8 | widen(code & 31, 5);
    case SMEAR_RGB555:
        return widen(code & 31, 5) << 16 | widen(code >> 5 & 31, 5) << 8 | widen(code >> 10, 5);
    default:
        return code;
    }
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
    screen->code = calloc((size_t)desc.width * (size_t)desc.height, sizeof *screen->code);
    void *memory = screen->code != NULL ? start(&player, which, desc, f) : NULL;
    if (memory == NULL)
        return false;
    player.shutter_degrees = shutter;
    int result = SMEAR_OK;
    for (uint32_t before = 3; before-- > 0 && result == SMEAR_OK;)      /* poses of two frames ago tell the curves */
        result = demo_player_frame(&player, (frame + DEMO_LOOP - before) % DEMO_LOOP, before == 0);
    free(memory);
    return result == SMEAR_OK || fail(f, "the library refused the frame: %s", smear_error_text(result));
}

/* Of what arrives, by the rule of smear_stats.crc32: 32-bit pixels count as R, G, B. */
static uint32_t crc_of(const struct screen *screen)
{
    uint32_t crc = 0;
    int pixels = screen->desc->width * screen->desc->height;
    for (int i = 0; i < pixels; i++) {
        uint32_t c = screen->code[i];
        uint8_t bytes[3] = { (uint8_t)(c >> 16), (uint8_t)(c >> 8), (uint8_t)c };
        switch (screen->desc->format) {
        case SMEAR_L4:
            if (i % 2 == 0)
                bytes[0] = (uint8_t)(c << 4 | screen->code[i + 1]);
            crc = crc32_update(crc, bytes, i % 2 == 0);
            break;
        case SMEAR_RGB565_SWAPPED:
            crc = crc32_update(crc, bytes + 1, 2);
            break;
        case SMEAR_RGB565:
        case SMEAR_RGB555:
            bytes[0] = bytes[2];
            crc = crc32_update(crc, bytes, 2);
            break;
        default:
            crc = crc32_update(crc, bytes, 3);
        }
    }
    return crc;
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
    struct screen screen = { .code = calloc((size_t)which->desc.width * (size_t)which->desc.height, sizeof *screen.code) };
    if (screen.code == NULL || !start_kept(&player, which, &screen, 0, f))
        return false;
    for (uint32_t i = 0; i < DEMO_LOOP; i++) {
        if (demo_player_frame(&player, i, i % step == 0) != SMEAR_OK)
            return fail(f, "the library refused frame %u", i);
        if (i % step == 0)
            printf("%" PRIu32 " %08" PRIx32 "\n", i, crc_of(&screen));
    }
    free(screen.code);
    return true;
}

/* Of as many buffers as the screen has, or one, which are shown in turn. */
static bool kept(const struct demo_screen *which, struct failure *f)
{
    static struct demo_player keeps, all;
    const size_t pixels = (size_t)which->desc.width * (size_t)which->desc.height;
    const int buffers = which->desc.reuse.buffer_age;
    uint32_t *code = calloc(pixels * ((size_t)buffers + 1), sizeof *code);
    struct screen shown = { .code = code }, want = { .code = code != NULL ? code + pixels * (size_t)buffers : NULL };
    uint32_t tiles = 0;
    if (code == NULL || buffers == 0)
        return fail(f, code == NULL ? "out of memory" : "keeps nothing");
    if (!start_kept(&keeps, which, &shown, buffers, f) || !start_kept(&all, which, &want, 0, f))
        return false;
    for (uint32_t i = 0; i < 2 * DEMO_LOOP; i++) {
        smear_stats stats;
        shown.code = code + pixels * (i % (uint32_t)buffers);
        if (demo_player_frame(&keeps, i, true) != SMEAR_OK || demo_player_frame(&all, i, true) != SMEAR_OK)
            return fail(f, "the library refused frame %u", i);
        if (memcmp(shown.code, want.code, pixels * sizeof *code) != 0)
            return fail(f, "frame %u is another", i);
        smear_get_stats(keeps.ctx, &stats);
        tiles += stats.tiles_kept;
    }
    free(code);
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
    struct screen screen = { .code = calloc((size_t)which->desc.width * (size_t)which->desc.height, sizeof *screen.code) };
    unsigned held = 0;
    uint32_t shown = 0;
    if (screen.code == NULL)
        return fail(f, "out of memory");
    if (!start_kept(&player, which, &screen, 0, f))
        return false;
    hold(list, 0, &controls.held);
    for (uint32_t i = 0; i < frames; i++) {
        hold(list, i, &held);
        demo_player_obey(&player, &controls, held);
        if (demo_player_frame(&player, shown, true) != SMEAR_OK)
            return fail(f, "the library refused frame %u", i);
        printf("%" PRIu32 " %08" PRIx32 "\n", i, crc_of(&screen));
        shown = (shown + !controls.is_paused) % DEMO_LOOP;
    }
    free(screen.code);
    return true;
}

static bool save(const struct screen *screen, const char *path, struct failure *f)
{
    struct image image;
    if (!image_alloc(&image, screen->desc->width, screen->desc->height, f))
        return false;
    for (int i = 0; i < image.width * image.height; i++) {
        uint32_t color = shown(screen->code[i], screen->desc->format);
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
                want = shown(screen->code[(y - top) / zoom * width + (x - left) / zoom],
                             screen->desc->format);
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
    struct screen screen = { .code = NULL };
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
    free(screen.code);
    return ok ? 0 : 1;
}
