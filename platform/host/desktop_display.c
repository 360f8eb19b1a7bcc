/* SPDX-License-Identifier: MIT */
/* desktop_display.c - platform/display.h on a desktop: what firmware draws is seen in a window, in
 * the terminal, or kept and checked without anybody looking. Environment variables stand for the
 * options of `smear view`:
 *
 *     SMEAR_OUT      x11, term, fb, drm or null; unset: what is there, and null where SMEAR_FRAMES are
 *                    checked or printed
 *     SMEAR_ZOOM     1..8; unset: the largest that fits
 *     SMEAR_ROTATE   0, 90, 180 or 270
 *     SMEAR_FPS      frames per second at most; unset: 60; 0: as fast as it goes
 *     SMEAR_FRAMES   the program ends after so many
 *     SMEAR_CRC      1: prints the CRC-32 of each
 *     SMEAR_CHECK    a file of CRCs; exit status 1 unless they are these
 *     SMEAR_UPDATE   1: writes that file, and the accepted pictures beside it
 *     SMEAR_RECORD, SMEAR_PLAY   files of keys
 *
 * Arrow keys are themselves; a, x and space are A, Enter is start; q, escape and closing the
 * window end the program. */
#include "platform/display.h"

#include "tools/view/clock.h"
#include "tools/view/golden.h"
#include "tools/view/guard.h"
#include "tools/view/panel.h"
#include "tools/view/screen.h"
#include "tools/view/script.h"

#include "tools/player/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WISHED_WIDTH = 640, WISHED_HEIGHT = 480, MAX_EDGE = 2048, EVENTS_AT_ONCE = 100 };

static struct {
    struct screen *screen;
    smear_context *ctx;
    smear_format format;
    bool has_two_bands;
    int width, height;
    size_t stride, size;        /* bytes of a row, or of a page; of the frame */
    uint8_t *pixels;            /* the frame as the display has it, and keeps it */
    bool has_frame;             /* something has been flushed */
    uint32_t *codes;
    struct panel_codes decoder;
    struct panel_look look;
    struct golden golden;
    struct script script;
    long frame, frames;         /* shown; to be shown, 0: no end */
    double period_us, next_us, opened_us;
    bool repeats;               /* what is recorded, played again or checked goes by frames of 1/30 s, not by the clock */
    unsigned pressed;           /* since display_keys was asked last */
} display;

/* ------------------------------------------------------------------ end */

static void say(const char *what, const struct failure *f)
{
    fprintf(stderr, "smear: %s: %s\n", what, f->text);
}

/* Ends the program, after what is to be written has been written. */
static void end(const char *what, const struct failure *why)
{
    struct failure f = { "" };
    int status = why != NULL;
    display.screen->kind->close(display.screen);
    if (why != NULL) {
        say(what, why);
    } else if (!script_end(&display.script, &f)) {
        say("SMEAR_RECORD", &f);
        status = 1;
    } else if (!golden_end(&display.golden, &f)) {
        say(display.golden.path, &f);
        status = 1;
    }
    script_close(&display.script);
    golden_close(&display.golden);
    exit(status);
}

/* ------------------------------------------------------------------ bands */

static int take_band(void *user, const smear_band *band)
{
    (void)user;
    picture_put_band(display.pixels, display.stride, display.format, band);
    display.has_frame = true;
    if (display.has_two_bands)
        smear_band_done(display.ctx);
    return 0;
}

/* ------------------------------------------------------------------ opening */

static long number_of(const char *name, long low, long high, long otherwise)
{
    const char *text = getenv(name);
    char *rest;
    if (text == NULL || text[0] == '\0')
        return otherwise;
    long value = strtol(text, &rest, 10);
    if (*rest == '\0' && value >= low && value <= high)
        return value;
    fprintf(stderr, "smear: %s: needs a number from %ld to %ld (\"%s\")\n", name, low, high, text);
    exit(2);
}

static int turns_of(const char *name)
{
    const long degrees = number_of(name, 0, 270, 0);
    if (degrees % 90 == 0)
        return (int)(degrees / 90);
    fprintf(stderr, "smear: %s: needs 0, 90, 180 or 270 (\"%ld\")\n", name, degrees);
    exit(2);
}

static const char *text_of(const char *name)
{
    const char *text = getenv(name);
    return text != NULL && text[0] != '\0' ? text : NULL;
}

static bool open_files(struct failure *f, const char **what)
{
    const char *check = text_of("SMEAR_CHECK"), *play = text_of("SMEAR_PLAY");
    const char *record = text_of("SMEAR_RECORD");
    *what = check;
    if (!golden_open(&display.golden, check, number_of("SMEAR_CRC", 0, 1, 0) == 1,
                     number_of("SMEAR_UPDATE", 0, 1, 0) == 1, f))
        return false;
    *what = play;
    if (play != NULL && !script_play(&display.script, play, f))
        return false;
    *what = record;
    return record == NULL || script_record(&display.script, record, f);
}

static bool open_screen(struct failure *f)
{
    const char *out = text_of("SMEAR_OUT");
    int zoom = display.look.zoom, known = out == NULL;
    int w = display.look.turns & 1 ? display.height : display.width;
    int h = display.look.turns & 1 ? display.width : display.height;
    for (int i = 0; out != NULL && screen_names[i] != NULL; i++)
        known = known || strcmp(screen_names[i], out) == 0;
    if (!known)
        return fail(f, "there is no SMEAR_OUT=%s", out);
    if (out == NULL && display.frames > 0
        && (text_of("SMEAR_CHECK") != NULL || number_of("SMEAR_CRC", 0, 1, 0) == 1))
        out = screen_null.name;         /* nobody looks */
    for (zoom = zoom > 0 ? zoom : 8; display.look.zoom == 0 && zoom > 1; zoom--)
        if (w * zoom <= WISHED_WIDTH && h * zoom <= WISHED_HEIGHT)
            break;
    struct screen_wish wish = { .title = "smear", .width = w * zoom, .height = h * zoom };
    guard_set(NULL);
    display.screen = screen_open(out, &wish, f);
    return display.screen != NULL;
}

bool display_open(smear_desc *desc)
{
    struct failure f = { "" };
    const char *what = "display";
    display.width = desc->width;
    display.height = desc->height;
    display.format = (smear_format)desc->format;
    display.look.zoom = (int)number_of("SMEAR_ZOOM", 1, 8, 0);
    display.look.turns = turns_of("SMEAR_ROTATE");
    display.frames = number_of("SMEAR_FRAMES", 1, 999999999, 0);
    long fps = number_of("SMEAR_FPS", 0, 100000, 60);
    display.period_us = fps > 0 ? 1e6 / (double)fps : 0.0;
    if (desc->width < 1 || desc->height < 1 || desc->width > MAX_EDGE || desc->height > MAX_EDGE)
        return false;
    display.stride = picture_row_bytes(desc->width, display.format);
    display.size = display.stride * (size_t)(display.format == SMEAR_L1_PAGES ? (desc->height + 7) / 8 : desc->height);
    display.pixels = calloc(1, display.size);
    display.codes = calloc((size_t)desc->width * (size_t)desc->height, sizeof *display.codes);
    if (display.pixels == NULL || display.codes == NULL || !panel_codes_open(&display.decoder, display.format, &f) ||
        !open_files(&f, &what)) {
        say(what, &f);
        return false;
    }
    if (!open_screen(&f)) {
        say("no display", &f);
        return false;
    }
    display.next_us = display.opened_us = clock_us();
    display.repeats = display.frames > 0 || text_of("SMEAR_CHECK") != NULL || text_of("SMEAR_PLAY") != NULL
                   || text_of("SMEAR_RECORD") != NULL;
    display.has_two_bands = desc->bands == 2;
    if (desc->reuse.buffer_age != 0)
        desc->reuse.buffer_age = 1;
    desc->flush = take_band;
    return true;
}

void display_attach(smear_context *ctx)
{
    display.ctx = ctx;
}

/* ------------------------------------------------------------------ keys */

static void press(const struct event *e)
{
    static const struct {
        int key;
        unsigned bit;
    } keys[] = {
        { SCREEN_UP, KEY_UP },   { SCREEN_DOWN, KEY_DOWN }, { SCREEN_LEFT, KEY_LEFT },
        { SCREEN_RIGHT, KEY_RIGHT }, { 'a', KEY_A },        { 'x', KEY_A },
        { ' ', KEY_A },          { SCREEN_ENTER, KEY_START },
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (e->kind == EVENT_KEY && keys[i].key == e->key)
            display.pressed |= keys[i].bit;
}

static void take(struct event *e)
{
    bool is_end = e->kind == EVENT_CLOSE ||
                  (e->kind == EVENT_KEY && (e->key == 'q' || e->key == SCREEN_ESCAPE));
    if (e->kind == EVENT_LOST)
        end(display.screen->kind->name, &display.screen->lost);
    if (is_end)
        end(NULL, NULL);
    script_note(&display.script, display.frame, e);
    press(e);
}

/* Takes events for as long; at least those that have come. */
static void wait_us(double left_us)
{
    double until = clock_us() + left_us;
    for (int i = 0; i < EVENTS_AT_ONCE; i++) {
        struct event e;
        double left = until - clock_us();
        bool came = display.screen->kind->event(display.screen,
                                                left > 0.0 ? (int)ceil(left / 1000.0) : 0, &e);
        if (guard_is_asked())
            end(NULL, NULL);
        if (came)
            take(&e);
        else if (clock_us() >= until)
            return;
    }
}

unsigned display_keys(void)
{
    struct event e;
    wait_us(0.0);
    while (script_event(&display.script, display.frame, &e))
        press(&e);
    unsigned pressed = display.pressed;
    display.pressed = 0;
    return pressed;
}

/* Before the first frame one is due. */
uint32_t display_time(void)
{
    return (uint32_t)(display.repeats ? ((double)display.frame + 1.5) * 1000.0 / 30.0 : (clock_us() - display.opened_us) / 1000.0 + 34.0);
}

bool display_wait(void)
{
    bool is_seen = display.screen->kind != &screen_null;
    if (is_seen)
        wait_us(display.period_us > 0.0 ? display.period_us : 1000.0);
    return is_seen;
}

/* ------------------------------------------------------------------ frames */

static void add_golden(struct failure *f)
{
    struct image picture = { 0 };
    bool ok = true;
    if (golden_wants_pictures(&display.golden)) {
        ok = image_alloc(&picture, display.width, display.height, f);
        if (ok)
            picture_expand(&picture, display.pixels, display.stride, display.format);
    }
    ok = ok && golden_add(&display.golden, display.frame,
                          picture_crc(display.pixels, display.size, display.format), &picture, f);
    image_free(&picture);
    if (!ok)
        end("SMEAR_CHECK", f);
}

static void put(struct failure *f)
{
    struct surface s;
    const struct screen_kind *kind = display.screen->kind;
    bool ok = panel_decode(&display.decoder, display.pixels, display.stride, display.width,
                           display.height, display.codes, f) &&
              kind->surface(display.screen, &s, f);
    if (ok) {
        struct panel_place place = panel_place_on(&display.look, display.width, display.height, &s);
        panel_show(&display.look, &place, display.codes, display.width, display.height, &s);
        ok = kind->show(display.screen, NULL, f);
    }
    if (!ok)
        end(kind->name, f);
}

void display_show(void)
{
    struct failure f = { "" };
    double now = clock_us();
    if (!display.has_frame)
        return;                         /* nothing has been flushed yet */
    add_golden(&f);
    put(&f);
    display.frame++;
    if (display.frames > 0 && display.frame >= display.frames)
        end(NULL, NULL);
    display.next_us = fmax(display.next_us + display.period_us, now);
    bool is_seen = display.screen->kind != &screen_null;
    wait_us(is_seen ? display.next_us - clock_us() : 0.0);
}
