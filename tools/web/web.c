/* SPDX-License-Identifier: MIT */
/* web.c - what the page calls: the parts of `smear view`, `smear convert` and the GIF writer behind
 * a few functions of numbers. worker.js is their only caller.
 *
 * Texts go in through web_argument (a command line, word by word), pictures and texts come out as
 * addresses in the module's memory. Whatever goes wrong is printed on standard error, as the
 * program does it; functions return its exit status. */
#include "tools/web/libc/web_file.h"

#include "tools/cli/commands.h"
#include "tools/image/image.h"
#include "tools/options/arguments.h"
#include "tools/options/say.h"
#include "tools/player/crew.h"
#include "tools/scenes/builtin.h"
#include "tools/view/board.h"
#include "tools/view/cost.h"
#include "tools/view/lane.h"
#include "tools/view/orbit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The page is to be small: pictures come as PNG. */
bool ppm_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    (void)bytes;
    (void)size;
    (void)out;
    return fail(f, "PPM: the page reads PNG alone");
}

#define EXPORT(name) __attribute__((export_name(#name)))

enum { MAX_WORDS = 80, WORD_ROOM = 512, TEXT_ROOM = 8192 };

/* ------------------------------------------------------------------ words in, text out */

struct words {
    int count;
    char *text[MAX_WORDS + 1];
    char room[MAX_WORDS][WORD_ROOM];
};

/* Options point into their words: those of what is shown stay while others come in. */
static struct words words[2];
static int coming;
static char text[TEXT_ROOM];

EXPORT(web_begin) void web_begin(void)
{
    words[coming].count = 0;
}

/* Where the next word goes, NUL at its end; null when there is no room for it. */
EXPORT(web_word) char *web_word(size_t size)
{
    struct words *w = &words[coming];
    if (w->count == MAX_WORDS || size > WORD_ROOM)
        return NULL;
    w->text[w->count] = w->room[w->count];
    return w->text[w->count++];
}

EXPORT(web_text) const char *web_text(void)
{
    return text;
}

EXPORT(web_make) uint8_t *web_make(size_t size)
{
    return web_file_make(words[coming].room[0], size);
}

EXPORT(web_remove) void web_remove(void)
{
    remove(words[coming].room[0]);
}

/* The bytes of the file that has been named; web_size is how many. */
static size_t found_size;

EXPORT(web_find) const uint8_t *web_find(void)
{
    return web_file_data(words[coming].room[0], &found_size);
}

EXPORT(web_size) size_t web_size(void)
{
    return found_size;
}

EXPORT(web_clear) void web_clear(void)
{
    web_file_clear_texts();
}

/* ------------------------------------------------------------------ the device */

/* What a page's worker is to crew.h: nobody. */
struct crew *crew_start(int workers, struct failure *f)
{
    (void)workers;
    fail(f, "the page has one core");
    return NULL;
}

int crew_render(struct crew *crew, smear_context *ctx)
{
    (void)crew;
    return smear_render(ctx);
}

void crew_stop(struct crew *crew)
{
    (void)crew;
}

void crew_idle(void *user)
{
    (void)user;
}

int help_print(const char *command)
{
    printf("smear help %s\n", command);
    return STATUS_OK;
}

/* ------------------------------------------------------------------ what is shown */

struct shown {
    bool is_open;
    struct source *source;
    struct orbit *orbit;        /* the presenter's scene lies in it */
    struct presenter *presenter;
    struct lane main, left;     /* never move: devices point to them */
    const struct board *board;
    struct panel_look look;
    struct bus bus;
    const struct cost_core *core;
    double cpu_hz;
    uint32_t *rgba[2];          /* of main and left */
    int width, height;
};

static struct shown shown;

static void close_source(struct shown *s)
{
    if (!s->is_open)
        return;
    lane_close(&s->main);
    lane_close(&s->left);
    presenter_free(s->presenter);
    source_close(s->source);
    free(s->orbit);
    free(s->source);
    s->orbit = NULL;
    s->source = NULL;
    s->presenter = NULL;
    s->is_open = false;
}

/* Those options of a board that are no options of `render`. */
static void use_board(struct shown *s, const struct board *board)
{
    s->board = board;
    s->look = (struct panel_look){ .zoom = 1 };
    s->bus = (struct bus){ .hz = 0 };
    s->core = NULL;
    for (int i = 0; board != NULL && board->option[i] != NULL; i++) {
        const char *name = board->option[i], *value = board->option[i + 1];
        char word[64];
        if (strcmp(name, "--round") == 0)
            s->look.round = true;
        if (value == NULL)
            continue;
        size_t colon = strcspn(value, ":,");
        snprintf(word, sizeof word, "%.*s", (int)colon, value);
        if (strcmp(name, "--tint") == 0)
            s->look.has_tint = read_color(word, &s->look.dark)
                            && read_color(value + colon + 1, &s->look.lit);
        else if (strcmp(name, "--bus") == 0)
            read_number(value, 1.0, 1e12, &s->bus.hz);
        else if (strcmp(name, "--panel-hz") == 0)
            read_number(value, 0.1, 1000.0, &s->bus.panel_hz);
        else if (strcmp(name, "--cpu") == 0 && (s->core = cost_find(word)) != NULL)
            read_number(value + colon + 1, 1e3, 1e11, &s->cpu_hz);
    }
}

static bool fit_pictures(struct shown *s, struct failure *f)
{
    size_t pixels = (size_t)s->main.setup.width * (size_t)s->main.setup.height;
    if (s->width == s->main.setup.width && s->height == s->main.setup.height)
        return true;
    for (int i = 0; i < 2; i++) {
        free(s->rgba[i]);
        s->rgba[i] = calloc(pixels, sizeof *s->rgba[i]);
        if (s->rgba[i] == NULL)
            return fail(f, "out of memory");
    }
    s->width = s->main.setup.width;
    s->height = s->main.setup.height;
    return true;
}

/* Lanes of these options, the left one sharp. */
static int open_lanes(struct shown *s, const struct render_options *o)
{
    struct failure f = { "" };
    struct render_options left = *o;
    struct setup trial;
    int status = setup_open(o, s->source, &trial);      /* says itself what is wrong */
    setup_release(&trial);
    if (status != STATUS_OK)
        return status;
    left.method = SMEAR_NONE;
    left.reconstruct = 0;
    left.samples = 0;
    if (!lane_open(&s->main, o, s->source, &f) || !lane_open(&s->left, &left, s->source, &f)
        || !fit_pictures(s, &f))
        return say_bad_input(s->source->name, &f);
    return STATUS_OK;
}

static int read_words(struct render_options *o)
{
    bool wants_help;
    int status = options_read_seen(o, words[coming].count, words[coming].text, &wants_help);
    if (status == STATUS_OK && (wants_help || o->scene == NULL))
        status = say_bad_usage("page", "no scene");
    return status;
}

/* Opens what the words say, SCENE and options of `render`. On failure the old one stays. */
EXPORT(web_open) int web_open(int board)
{
    static struct render_options o;
    struct failure f = { "" };
    struct shown next = shown;
    memset(&o, 0, sizeof o);
    int status = read_words(&o);
    if (status != STATUS_OK)
        return status;
    next.is_open = true;
    next.main = next.left = (struct lane){ .is_open = false };
    next.source = calloc(1, sizeof *next.source);
    next.orbit = calloc(1, sizeof *next.orbit);
    next.presenter = NULL;
    if (next.source == NULL || next.orbit == NULL) {
        fail(&f, "out of memory");
        status = say_bad_input(o.scene, &f);
    } else {
        status = source_open(o.scene, &o.view, next.source);
    }
    if (status != STATUS_OK) {
        free(next.source);
        free(next.orbit);
        return status;
    }
    struct shown old = shown;
    shown = next;
    orbit_open(shown.orbit, &shown.source->scene);
    shown.presenter = presenter_new(&shown.orbit->scene, &f);
    status = shown.presenter != NULL ? open_lanes(&shown, &o) : say_bad_input(o.scene, &f);
    if (status != STATUS_OK) {
        close_source(&shown);
        next = old;
        next.rgba[0] = shown.rgba[0];
        next.rgba[1] = shown.rgba[1];
        next.width = shown.width;
        next.height = shown.height;
        shown = next;
        return status;
    }
    close_source(&old);
    use_board(&shown, board >= 0 ? &board_list[board] : NULL);
    coming = !coming;
    say_done();
    return STATUS_OK;
}

/* Other options for the scene that is open; those that choose what is seen of a file must not
 * differ. */
EXPORT(web_change) int web_change(int board)
{
    static struct render_options o;
    memset(&o, 0, sizeof o);
    int status = read_words(&o);
    if (status == STATUS_OK)
        status = open_lanes(&shown, &o);
    if (status == STATUS_OK) {
        use_board(&shown, board >= 0 ? &board_list[board] : NULL);
        coming = !coming;
    }
    return status;
}

/* ------------------------------------------------------------------ a frame */

static void to_rgba(struct shown *s, const struct lane *lane, uint32_t *out)
{
    struct surface surface = { .width = s->width, .height = s->height, .pitch = (size_t)s->width,
                               .pixel = out };
    struct panel_place place = panel_place_on(&s->look, s->width, s->height, &surface);
    panel_show(&s->look, &place, lane->picture, s->width, s->height, &surface);
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++) {
        uint32_t c = out[i];
        out[i] = 0xff000000u | (c & 0xff) << 16 | (c & 0xff00) | (c >> 16 & 0xff);
    }
}

static int draw(struct lane *lane, uint32_t *rgba, int frame)
{
    struct failure f = { "" };
    struct instant instant = { .time = (double)frame / shown.main.setup.present.fps,
                               .frame = frame, .frames_apart = 1 };
    if (!lane_draw(lane, shown.presenter, &instant, &f))
        return say_bad_input(shown.source->name, &f);
    to_rgba(&shown, lane, rgba);
    return STATUS_OK;
}

/* Draws frame `frame`, and the sharp one beside it when `both`. */
EXPORT(web_draw) int web_draw(int frame, int both)
{
    int status = shown.is_open ? draw(&shown.main, shown.rgba[0], frame) : STATUS_BAD_USAGE;
    if (status == STATUS_OK && both)
        status = draw(&shown.left, shown.rgba[1], frame);
    return status;
}

EXPORT(web_picture) const uint32_t *web_picture(int left)
{
    return shown.rgba[left != 0];
}

EXPORT(web_width) int web_width(void)
{
    return shown.width;
}

EXPORT(web_height) int web_height(void)
{
    return shown.height;
}

/* The last frame in numbers, as JSON in `text`. Times of boards are estimates. */
EXPORT(web_stats) void web_stats(void)
{
    const smear_stats *s = &shown.main.stats;
    double board_us = shown.core != NULL ? cost_us(shown.core, shown.cpu_hz, s) : 0.0;
    double sharp_us = shown.core != NULL && shown.left.stats.pixels > 0
                          ? cost_us(shown.core, shown.cpu_hz, &shown.left.stats) : 0.0;
    unsigned long filtered = 0;
    for (int m = 0; m < SMEAR_METHOD_COUNT; m++)
        filtered += smear_method_is_filter(m) ? s->tiles[m] : 0;
    snprintf(text, sizeof text,
             "{\"crc\":\"%08lx\",\"us\":%.1f,\"sharp_us\":%.1f,\"board_us\":%.0f,"
             "\"board_sharp_us\":%.0f,\"instructions\":%.0f,\"wire_us\":%.0f,\"in\":%lu,\"drawn\":%lu,\"dropped\":%lu,"
             "\"arena\":%lu,\"limit\":%zu,\"samples\":%lu,\"still\":%lu,"
             "\"subframes\":%lu,\"timemask\":%lu,\"filtered\":%lu,\"object\":%lu,\"layered\":%lu}",
             (unsigned long)s->crc32, shown.main.wall_us, shown.left.wall_us, board_us, sharp_us,
             shown.core != NULL ? cost_instructions(shown.core, s) : 0.0,
             bus_wire_us(&shown.bus, shown.main.device.size), (unsigned long)s->triangles_in,
             (unsigned long)s->triangles_drawn, (unsigned long)s->triangles_dropped,
             (unsigned long)s->arena_bytes, shown.main.options.arena, (unsigned long)s->samples,
             (unsigned long)s->tiles[SMEAR_NONE],
             (unsigned long)s->tiles[SMEAR_SUBFRAMES], (unsigned long)s->tiles[SMEAR_TIMEMASK],
             filtered,
             (unsigned long)s->tiles[SMEAR_OBJECT], (unsigned long)s->tiles[SMEAR_LAYERED]);
}

/* ------------------------------------------------------------------ what there is */

/* `room` holds what is left of `text`. */
static char *append(char *at, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    size_t room = (size_t)(text + sizeof text - at);
    int length = vsnprintf(at, room, format, args);
    va_end(args);
    return (size_t)length < room ? at + length : at;
}

/* A name as a JSON string; what is no plain ASCII becomes '?'. */
static char *append_name(char *at, const char *name)
{
    at = append(at, "\"");
    for (int i = 0; name[i] != '\0' && i < 60; i++) {
        unsigned char c = (unsigned char)name[i];
        at = append(at, "%s%c", c == '"' || c == '\\' ? "\\" : "", c < 32 || c > 126 ? '?' : c);
    }
    return append(at, "\"");
}

/* Boards and their options, as JSON in `text`. */
EXPORT(web_boards) void web_boards(void)
{
    char *at = append(text, "[");
    for (const struct board *b = board_list; b->name != NULL; b++) {
        at = append(at, "%s{\"name\":\"%s\",\"what\":\"%s\",\"options\":[",
                    b == board_list ? "" : ",", b->name, b->what);
        for (int i = 0; b->option[i] != NULL; i++)
            at = append(at, "%s\"%s\"", i > 0 ? "," : "", b->option[i]);
        at = append(at, "]}");
    }
    append(at, "]");
}

/* The scene, as JSON in `text`. */
EXPORT(web_scene) void web_scene(void)
{
    const struct model *m = &shown.source->model;
    double fps = shown.main.setup.present.fps;
    char *at = append(text, "{\"width\":%d,\"height\":%d,\"fps\":%g,\"period\":%ld,\"clips\":[",
                      shown.width, shown.height, fps,
                      source_period(shown.source, &shown.main.options.view, fps));
    bool is_file = shown.source->is_file;
    for (int i = 0; is_file && i < m->clip_count && i < 64; i++) {
        at = append(at, i > 0 ? "," : "");
        at = append_name(at, m->clip[i].name);
    }
    at = append(at, "],\"cameras\":%d,\"skipped\":%d}", is_file ? m->camera_count : 0,
                is_file ? m->skipped_primitives : 0);
}

/* ------------------------------------------------------------------ the camera */

static int find_focus(int frame)
{
    struct failure f = { "" };
    double fps = shown.main.setup.present.fps;
    if (shown.orbit->focus > 0.0 || orbit_find_focus(shown.orbit, (double)frame / fps, &f))
        return STATUS_OK;
    return say_bad_input(shown.source->name, &f);
}

/* spin: radians per second. */
EXPORT(web_turn) int web_turn(int frame, double yaw, double pitch, double factor, double spin)
{
    int status = shown.is_open ? find_focus(frame) : STATUS_BAD_USAGE;
    if (status == STATUS_OK) {
        orbit_turn(shown.orbit, yaw, pitch);
        orbit_move(shown.orbit, factor);
        shown.orbit->spin = spin;
    }
    return status;
}

EXPORT(web_straight) void web_straight(void)
{
    if (shown.is_open)
        orbit_reset(shown.orbit);
}

/* ------------------------------------------------------------------ files */

/* `smear convert` with the words as its arguments. */
EXPORT(web_convert) int web_convert(void)
{
    int status = command_convert(words[coming].count, words[coming].text);
    if (status == STATUS_OK)
        say_done();
    return status;
}

static struct animation_writer *film;
static const char film_name[] = "smear.gif";

EXPORT(web_film_begin) int web_film_begin(void)
{
    struct failure f = { "" };
    animation_cancel(film);
    film = gif_begin(film_name, shown.width, shown.height, &f);
    return film != NULL ? STATUS_OK : say_bad_input(film_name, &f);
}

/* The picture shown last. */
EXPORT(web_film_add) int web_film_add(int delay_ms)
{
    struct failure f = { "" };
    struct image frame = { .width = shown.width, .height = shown.height,
                           .rgba = (uint8_t *)shown.rgba[0] };
    if (film != NULL && animation_add(film, &frame, delay_ms, &f))
        return STATUS_OK;
    animation_cancel(film);
    film = NULL;
    return say_bad_input(film_name, &f);
}

EXPORT(web_film_end) int web_film_end(void)
{
    struct failure f = { "" };
    struct animation_writer *done = film;
    film = NULL;
    if (done != NULL && animation_end(done, &f))
        return STATUS_OK;
    return say_bad_input(film_name, &f);
}
