/* SPDX-License-Identifier: MIT */
/* viewer.c - the loop of `smear view`: input, time, a frame, the screen. Start reading at
 * loop(). */
#include "tools/view/view.h"

#include "tools/view/clock.h"
#include "tools/view/control.h"
#include "tools/image/file.h"
#include "tools/view/film.h"
#include "tools/view/guard.h"
#include "tools/view/overlay.h"

#include "tools/options/say.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_LATE_FRAMES = 8, MAX_BOARD_FRAMES = 120, MAX_EVENTS = 1000, MEDIAN_PICTURES = 10000 };
enum { MESSAGE_US = 3000000, IDLE_MS = 200, MAX_WAIT_MS = 60000 };
enum { WISHED_WIDTH = 640, WISHED_HEIGHT = 480, MAX_ZOOM = 8 };

void view_say(struct view *v, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(v->message, sizeof v->message, format, args);
    va_end(args);
    v->message_until_us = clock_us() + MESSAGE_US;
    v->is_dirty = true;
}

/* Ends the loop; the line is printed when the screen is closed. */
static bool give_up(struct view *v, const char *what, const struct failure *why)
{
    v->trouble = what;
    v->why = *why;
    v->quits = true;
    return false;
}

/* ------------------------------------------------------------------ time */

double view_fps(const struct view *v)
{
    return v->main.setup.present.fps;
}

/* As `render` has it: frame i shows i / fps, and --time the instant itself. */
struct instant view_instant(const struct view *v, int64_t at)
{
    bool is_whole = at % VIEW_UNITS == 0;
    double frames = is_whole ? (double)(at / VIEW_UNITS) : (double)at / VIEW_UNITS;
    double time = frames / view_fps(v);
    if (v->main.options.has_time)
        time = v->main.options.time + time;
    return (struct instant){ .time = time, .frame = is_whole ? (long)(at / VIEW_UNITS) : -1,
                             .frames_apart = at == v->at ? v->frames_apart : 1 };
}

/* Without --loop and --frames, a clip that has ended is shown again. */
static void wrap(struct view *v)
{
    long period = source_period(v->source, &v->main.options.view, view_fps(v));
    if (v->source->is_file && v->wish.frames == 0 && !v->main.options.view.loop && !v->main.options.has_time
        && period > 0 && v->at >= (int64_t)period * VIEW_UNITS)
        v->at = 0;
}

static long board_frames(const struct view *v)
{
    double frames = ceil((v->board_us + v->wire_us) * view_fps(v) / 1e6 - 1e-6);
    return frames < 1.0 ? 1 : frames > MAX_BOARD_FRAMES ? MAX_BOARD_FRAMES : (long)frames;
}

/* Time goes on; sets when the next picture is due. */
static void advance(struct view *v)
{
    double period = 1e6 / view_fps(v), now = clock_us();
    bool is_board = v->wish.pace == PACE_BOARD && v->wish.core != NULL;
    long frames = is_board ? board_frames(v) : 1, late = 0;
    v->next_us += (double)frames * period;
    if (v->next_us < now) {
        late = (long)fmin((now - v->next_us) / period, MAX_LATE_FRAMES);
        v->next_us = now;
    }
    v->frames_apart = (int)frames;
    if (v->wish.pace == PACE_TIME && v->wish.frames == 0)
        frames += late;
    v->at += frames * v->speed;
    wrap(v);
}

/* ------------------------------------------------------------------ scenes */

static bool open_scene(struct view *v, const struct render_options *options, struct failure *f)
{
    orbit_open(&v->orbit, &v->source->scene);
    v->presenter = presenter_new(&v->orbit.scene, f);
    return v->presenter != NULL && lane_open(&v->main, options, v->source, f);
}

/* Opens a source; what it prints on standard error comes back as text. */
static bool open_quietly(const char *name, const struct source_view *seen, struct source *out,
                         char *said, size_t size)
{
    FILE *kept = tmpfile();
    int error = dup(STDERR_FILENO);
    said[0] = '\0';
    if (kept != NULL && error >= 0)
        dup2(fileno(kept), STDERR_FILENO);
    bool ok = source_open(name, seen, out) == STATUS_OK;
    if (kept != NULL && error >= 0) {
        fflush(stderr);
        dup2(error, STDERR_FILENO);
        rewind(kept);
        if (fgets(said, (int)size, kept) == NULL)
            said[0] = '\0';
        said[strcspn(said, "\n")] = '\0';
    }
    if (error >= 0)
        close(error);
    if (kept != NULL)
        fclose(kept);
    return ok;
}

bool view_load(struct view *v, const struct source_view *seen)
{
    struct failure f = { "" }, worse = { "" };
    char said[TEXT_COLUMNS];
    struct source *source = malloc(sizeof *source), *old_source = v->source;
    struct orbit turned = v->orbit;
    struct render_options options = v->main.options, left = v->left.options;
    if (source == NULL || !open_quietly(v->source->name, seen, source, said, sizeof said)) {
        view_say(v, "%s", source != NULL ? said : "out of memory");
        free(source);
        return false;
    }
    options.view = left.view = *seen;
    presenter_free(v->presenter);           /* while its scene is still there */
    v->source = source;
    bool ok = open_scene(v, &options, &f);
    if (!ok) {
        presenter_free(v->presenter);
        source_close(source);
        free(source);
        v->source = old_source;
        orbit_open(&v->orbit, &v->source->scene);
        v->presenter = presenter_new(&v->orbit.scene, &worse);
        if (v->presenter == NULL)
            return give_up(v, v->source->name, &worse);
        view_say(v, "%s", f.text);
    }
    v->orbit.yaw = turned.yaw;              /* the user's turn stays */
    v->orbit.pitch = turned.pitch;
    v->orbit.spin = turned.spin;
    v->orbit.distance = turned.distance;
    v->orbit.focus = turned.focus;
    v->is_dirty = true;
    if (!ok)
        return false;
    if (v->left.is_open && !lane_open(&v->left, &left, v->source, &f))
        lane_close(&v->left);
    source_close(old_source);
    free(old_source);
    if (source->is_file && source->model.warning[0] != '\0')
        view_say(v, "%s", source->model.warning);
    v->has_error = false;
    return true;
}

/* ------------------------------------------------------------------ a frame */

/* Draws one lane; when that fails, its last good settings come back. */
static bool draw_lane(struct view *v, struct lane *lane, struct render_options *good)
{
    struct failure f = { "" };
    struct instant instant = view_instant(v, v->at);
    if (lane_draw(lane, v->presenter, &instant, &f)) {
        *good = lane->options;
        return true;
    }
    view_say(v, "%s", f.text);
    v->why = f;
    if (v->tick == 0)
        return false;
    f.text[0] = '\0';
    if (lane_open(lane, good, v->source, &f) && lane_draw(lane, v->presenter, &instant, &f))
        return true;
    v->why = f;
    return false;
}

/* Room for pictures of the main lane's size. */
static bool fit_pictures(struct view *v, struct failure *f)
{
    size_t pixels = (size_t)v->main.setup.width * (size_t)v->main.setup.height;
    uint32_t **all[3] = { &v->picture, &v->whole, &v->before };
    const struct device *d = &v->main.device;
    if (v->panel_width != d->width || v->panel_height != d->height) {
        free(v->panel);
        v->panel = calloc((size_t)d->width * (size_t)d->height, sizeof *v->panel);
        if (v->panel == NULL)
            return fail(f, "out of memory");
        v->panel_width = d->width;
        v->panel_height = d->height;
    }
    if (v->width == v->main.setup.width && v->height == v->main.setup.height)
        return true;
    v->width = v->main.setup.width;
    v->height = v->main.setup.height;
    for (int i = 0; i < 3; i++) {
        free(*all[i]);
        *all[i] = calloc(pixels, sizeof **all[i]);
        if (*all[i] == NULL)
            return fail(f, "out of memory");
    }
    return true;
}

/* The left part of a split screen over the right one. */
static bool draw_left(struct view *v, const struct instant *instant, struct failure *f)
{
    int edge = (int)((int64_t)v->width * v->divider / 1000);
    if (!v->is_split || !v->left.is_open)
        return true;
    if (!draw_lane(v, &v->left, &v->good_left))
        return fail(f, "%s", v->why.text);
    if (!debug_draw(&v->debug, v->debug_kind, &v->left, v->presenter, instant, v->left.picture, f))
        return false;
    for (int y = 0; y < v->height; y++) {
        uint32_t *row = v->whole + (size_t)y * (size_t)v->width;
        memcpy(row, v->left.picture + (size_t)y * (size_t)v->width, (size_t)edge * sizeof *row);
        if (edge > 0 && edge < v->width)
            row[edge] = ~row[edge] & 0xffffffu;
    }
    return true;
}

/* What the bus makes of the frame: rows that the panel has read too early are those of the frame
 * before. A picture that stands is read again, and what is not the frame itself is no panel's. */
static void send(struct view *v)
{
    size_t row_bytes = (size_t)v->width * sizeof *v->picture;
    bool old_above;
    v->wire_us = bus_wire_us(&v->wish.bus, v->main.device.sent);
    v->board_us = 0.0;
    if (v->wish.core != NULL)
        v->board_us = cost_us(v->wish.core, v->wish.cpu_hz, &v->main.stats);
    v->times.frames++;
    v->times.board_us += v->board_us;
    v->times.wire_us += v->wire_us;
    double write_us = v->board_us + v->wire_us, frame_us = fmax(write_us, 1e6 / view_fps(v));
    int tear = bus_tear(&v->wish.bus, v->tick, frame_us, write_us, v->height, &old_above);
    bool is_whole = v->tick == 0 || v->is_paused || v->debug_kind != DEBUG_PICTURE;
    for (int y = 0; y < v->height; y++) {
        bool is_old = !is_whole && tear < v->height && (y < tear) == old_above;
        size_t at = (size_t)y * (size_t)v->width;
        memcpy(v->picture + at, (is_old ? v->before : v->whole) + at, row_bytes);
    }
    uint32_t *swap = v->before;
    v->before = v->whole;
    v->whole = swap;
}

static bool draw_frame(struct view *v)
{
    struct failure f = { "" };
    double start = clock_us();
    struct instant instant = view_instant(v, v->at);
    if (!draw_lane(v, &v->main, &v->good))
        return give_up(v, v->source->name, &v->why);
    if (v->main.stats.triangles_dropped > 0 && !v->told_dropped)
        view_say(v, "triangles with vertices that the mesh does not have are left out");
    v->told_dropped = v->main.stats.triangles_dropped > 0;
    double drawn_us = clock_us() - start;
    v->times.draw_us += drawn_us;
    if (v->times.count < MEDIAN_PICTURES)
        v->times.draw[v->times.count] = drawn_us;
    if (!fit_pictures(v, &f))
        return give_up(v, v->source->name, &f);
    memcpy(v->whole, v->main.picture, (size_t)v->width * (size_t)v->height * sizeof *v->whole);
    if (!debug_draw(&v->debug, v->debug_kind, &v->main, v->presenter, &instant, v->whole, &f) ||
        !draw_left(v, &instant, &f))
        view_say(v, "%s", f.text);
    send(v);
    v->times.compose_us += clock_us() - start - drawn_us;
    return true;
}

/* ------------------------------------------------------------------ the screen */

/* The picture as the panel has it. */
static const uint32_t *on_panel(struct view *v)
{
    const int columns = v->panel_width / v->width, rows = v->panel_height / v->height;
    if (columns == 1 && rows == 1)
        return v->picture;
    uint32_t *out = v->panel;
    for (int y = 0; y < v->panel_height; y++) {
        const uint32_t *row = v->picture + (size_t)(y / rows) * (size_t)v->width;
        for (int x = 0; x < v->panel_width; x++)
            *out++ = row[x / columns];
    }
    return v->panel;
}

/* The picture and what is written over it. */
static void compose(struct view *v, const struct surface *s, struct text *text)
{
    int columns = s->width, rows = s->height / 2;
    panel_show(&v->look, &v->place, on_panel(v), v->panel_width, v->panel_height, s);
    if (!v->screen->has_text)
        overlay_room(s, &columns, &rows);
    if (v->help_page < 0 || v->help_page > overlay_help_pages(columns, rows))
        v->help_page = 0;
    overlay_text(v, columns, rows, text);
    if (!v->screen->has_text)
        overlay_draw(s, text);
}

/* Waiting for a surface is part of the transfer. */
static void note_times(struct view *v, double compose_us, double transfer_us)
{
    double shown = clock_us();
    v->times.compose_us += compose_us;
    if (v->times.count < MEDIAN_PICTURES)
        v->times.transfer[v->times.count++] = transfer_us;
    v->times.pictures++;
    if (v->last_shown_us > 0.0 && shown > v->last_shown_us) {
        double fps = 1e6 / (shown - v->last_shown_us);
        v->shown_fps = v->shown_fps > 0.0 ? v->shown_fps * 0.9 + fps * 0.1 : fps;
    }
    v->last_shown_us = shown;
}

static bool show(struct view *v)
{
    struct failure f = { "" };
    struct surface s;
    struct text text;
    double start = clock_us();
    if (!v->screen->kind->surface(v->screen, &s, &f))
        return give_up(v, v->screen->kind->name, &f);
    double waited = clock_us();
    v->place = panel_place_on(&v->look, v->panel_width, v->panel_height, &s);
    compose(v, &s, &text);
    double composed = clock_us();
    if (!v->screen->kind->show(v->screen, &text, &f))
        return give_up(v, v->screen->kind->name, &f);
    note_times(v, composed - waited, waited - start + clock_us() - composed);
    return true;
}

/* Pointer movements become thousandths of the shorter side, so that a recording does not depend on
 * the window's size. */
static void normalise(const struct view *v, struct event *e)
{
    int side = v->screen->width < v->screen->height ? v->screen->width : v->screen->height;
    if (e->kind != EVENT_DRAG || side < 1)
        return;
    e->x = (int)lround(e->x * 1000.0 / side);
    e->y = (int)lround(e->y * 1000.0 / side);
}

static void take_event(struct view *v, struct event *e)
{
    switch (e->kind) {
    case EVENT_RESIZE:
    case EVENT_EXPOSE:
        v->is_dirty = true;
        break;
    case EVENT_CLOSE:
        v->quits = true;
        break;
    case EVENT_LOST:
        give_up(v, v->screen->kind->name, &v->screen->lost);
        break;
    default:
        normalise(v, e);
        script_note(&v->script, v->tick, e);
        control_event(v, e);
    }
}

void view_busy(struct view *v, const char *what)
{
    if (v->screen->kind == &screen_null || v->tick == 0)
        return;
    view_say(v, "%s", what);
    show(v);
}

static bool is_due(const struct view *v, double now)
{
    if (v->screen->kind == &screen_null || v->tick == 0 || v->quits || guard_is_asked())
        return true;
    return v->is_paused ? v->is_dirty : now >= v->next_us;
}

static int wait_ms(const struct view *v, double now)
{
    if (is_due(v, now))
        return 0;
    double wait = v->is_paused ? IDLE_MS : ceil((v->next_us - now) / 1000.0);
    return (int)fmin(wait, MAX_WAIT_MS);
}

/* Takes events until the next picture is due, and all that have come by then. */
static void take_events(struct view *v)
{
    for (int i = 0; i < MAX_EVENTS && !v->quits; i++) {
        struct event event;
        double now = clock_us();
        int wait = wait_ms(v, now);
        bool came = v->screen->kind->event(v->screen, wait, &event);
        double after = clock_us();
        if (came)
            take_event(v, &event);
        v->times.event_us += clock_us() - (wait == 0 ? now : after);
        if (v->message[0] != '\0' && after > v->message_until_us) {
            v->message[0] = '\0';
            v->is_dirty = true;
        }
        if (!came && is_due(v, after))
            return;
        if (wait > 0)
            i = 0;
    }
}

/* ------------------------------------------------------------------ the loop */

static bool add_golden(struct view *v)
{
    struct failure f = { "" };
    struct image picture = { 0 };
    bool ok = !golden_wants_pictures(&v->golden) || film_picture(v, &picture, &f);
    ok = ok && golden_add(&v->golden, view_instant(v, v->at).frame, v->main.stats.crc32, &picture,
                          &f);
    image_free(&picture);
    return ok || give_up(v, v->golden.path != NULL ? v->golden.path : "--crc", &f);
}

/* A picture after the other: what the user wants, the time it shows, the frame, the screen. */
static void loop(struct view *v)
{
    struct event event;
    v->next_us = clock_us();
    while (v->wish.frames == 0 || v->tick < v->wish.frames) {
        take_events(v);
        while (script_event(&v->script, v->tick, &event))
            control_event(v, &event);
        if (v->quits || guard_is_asked())
            return;
        if (v->tick > 0 && !v->is_paused)
            advance(v);
        else
            v->next_us = clock_us();
        v->is_dirty = false;
        if (!draw_frame(v) || !add_golden(v))
            return;
        if (v->tick == 0)
            view_notice(v);
        if (!show(v))
            return;
        if (v->tick++ == 0 && v->screen->kind == &screen_x11)
            say_done();             /* elsewhere warnings wait until text can be seen again */
    }
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Medians of the library's work and of the transfer, means of the rest. The window's share is what
 * transfer and events take of all. */
static void print_times(struct view *v)
{
    struct view_times *t = &v->times;
    if (t->count == 0)
        return;
    qsort(t->draw, (size_t)t->count, sizeof *t->draw, by_size);
    qsort(t->transfer, (size_t)t->count, sizeof *t->transfer, by_size);
    double draw = t->draw[t->count / 2], transfer = t->transfer[t->count / 2];
    double events = t->event_us / (double)t->pictures;
    double compose = t->compose_us / (double)t->pictures;
    printf("pictures=%ld draw_us=%.1f compose_us=%.1f transfer_us=%.1f events_us=%.1f "
           "window_percent=%.2f screen=%s\n",
           t->pictures, draw, compose, transfer, events,
           100.0 * (transfer + events) / (draw + compose + transfer + events), v->screen_what);
}

/* Means over all frames that were drawn. */
static void print_estimate(const struct view *v)
{
    const struct view_times *t = &v->times;
    if (v->wish.core == NULL || t->frames == 0)
        return;
    const double cpu_us = t->board_us / (double)t->frames, wire_us = t->wire_us / (double)t->frames;
    printf("ESTIMATE board=%s mhz=%.4g frames_per_second=%.1f cpu_ms=%.1f bus_ms=%.1f\n", v->wish.core->name, v->wish.cpu_hz / 1e6,
           1e6 / (cpu_us + wire_us), cpu_us / 1000.0, wire_us / 1000.0);
}

/* ------------------------------------------------------------------ beginning and end */

static void wish_size(const struct view *v, struct screen_wish *wish)
{
    int w = v->main.device.width, h = v->main.device.height, zoom = v->look.zoom;
    if (v->look.turns & 1) {
        w = v->main.device.height;
        h = v->main.device.width;
    }
    if (zoom == 0) {
        zoom = WISHED_WIDTH / w < WISHED_HEIGHT / h ? WISHED_WIDTH / w : WISHED_HEIGHT / h;
        zoom = zoom < 1 ? 1 : zoom > MAX_ZOOM ? MAX_ZOOM : zoom;
    }
    wish->width = w * zoom;
    wish->height = h * zoom;
}

static int open_files(struct view *v)
{
    const struct view_options *w = &v->wish;
    struct failure f = { "" };
    if (w->update)
        outputs_hold();             /* a list without its pictures would mislead */
    if (!golden_open(&v->golden, w->check, w->crc, w->update, &f))
        return say_bad_input(w->check, &f);
    if (w->play != NULL && !script_play(&v->script, w->play, &f))
        return say_bad_input(w->play, &f);
    if (w->record != NULL && !script_record(&v->script, w->record, &f))
        return say_bad_input(w->record, &f);
    v->times.draw = calloc(MEDIAN_PICTURES, sizeof *v->times.draw);
    v->times.transfer = calloc(MEDIAN_PICTURES, sizeof *v->times.transfer);
    if (v->times.draw == NULL || v->times.transfer == NULL) {
        fail(&f, "out of memory");
        return say_bad_input("view", &f);
    }
    return STATUS_OK;
}

static int open_lanes(struct view *v, const struct render_options *options)
{
    struct failure f = { "" };
    struct setup trial;
    int status = setup_open(options, v->source, &trial);   /* says itself what is wrong */
    setup_release(&trial);
    if (status != STATUS_OK)
        return status;
    if (!open_scene(v, options, &f))
        return say_bad_input(v->source->name, &f);
    if (v->wish.spin != 0.0) {
        const double *eye = options->view.eye, *look = options->view.look;
        if (options->view.has_eye)
            v->orbit.focus = hypot(hypot(eye[0] - look[0], eye[1] - look[1]), eye[2] - look[2]);
        else if (!orbit_find_focus(&v->orbit, 0.0, &f))
            return say_bad_input(v->source->name, &f);
        v->orbit.spin = v->wish.spin;
    }
    if (v->wish.has_split) {
        struct render_options left = *options;
        left.method = v->wish.split;
        left.reconstruct = 0;
        left.edges = control_edges(v, &left);
        v->is_split = true;
        if (!lane_open(&v->left, &left, v->source, &f))
            return say_bad_input(v->source->name, &f);
    }
    return STATUS_OK;
}

static int open_screen(struct view *v)
{
    struct failure f = { "" };
    struct screen_wish wish = { .title = "smear", .no_shared_memory = v->wish.no_shared_memory,
                                .colors = v->wish.colors };
    const char *out = v->wish.out;
    if (out == NULL && v->wish.frames > 0 && (v->wish.crc || v->wish.check != NULL))
        out = screen_null.name;         /* nobody looks */
    wish_size(v, &wish);
    guard_set(NULL);
    v->screen = screen_open(out, &wish, &f);
    if (v->screen == NULL)
        return say_bad_input(out != NULL ? out : "no display", &f);
    return STATUS_OK;
}

/* What is left to say and to write once the screen is closed. */
static int finish(struct view *v)
{
    struct failure f = { "" };
    if (v->trouble != NULL)
        return say_bad_input(v->trouble, &v->why);
    if (!golden_end(&v->golden, &f))
        return say_bad_input(v->wish.check, &f);
    if (!output_flush_standard(&f))
        return say_bad_input("standard output", &f);
    if (!script_end(&v->script, &f))
        return say_bad_input(v->wish.record, &f);
    const char *failed = NULL;
    return outputs_publish(&failed, &f) ? STATUS_OK : say_bad_input(failed, &f);
}

static void release(struct view *v)
{
    outputs_drop();
    golden_close(&v->golden);
    script_close(&v->script);
    debug_close(&v->debug);
    lane_close(&v->main);
    lane_close(&v->left);
    presenter_free(v->presenter);
    free(v->picture);
    free(v->panel);
    free(v->whole);
    free(v->before);
    free(v->times.draw);
    free(v->times.transfer);
    source_close(v->source);
    free(v->source);
}

int view_run(struct view *v, const struct render_options *options)
{
    v->blurred = options->method != SMEAR_NONE ? options->method : SMEAR_AUTO;
    v->edges = options->edges;
    v->look = v->wish.look;
    v->divider = 500;
    v->speed = VIEW_UNITS;
    v->frames_apart = 1;
    v->at = (int64_t)v->wish.first * VIEW_UNITS;
    v->is_paused = v->wish.paused;
    v->debug_kind = v->wish.debug;
    v->has_overlay = v->wish.figures;
    struct failure f = { "" };
    v->source = malloc(sizeof *v->source);
    if (v->source == NULL) {
        fail(&f, "out of memory");
        return say_bad_input("view", &f);
    }
    int status = source_open(options->scene, &options->view, v->source);
    if (status != STATUS_OK) {
        free(v->source);
        return status;
    }
    status = apart_check_inputs(v->wish.output, VIEW_OUTPUTS);
    if (status == STATUS_OK)
        status = open_files(v);
    if (status == STATUS_OK)
        status = open_lanes(v, options);
    if (status == STATUS_OK)
        status = open_screen(v);
    if (status == STATUS_OK) {
        view_say(v, "? lists the controls");
        loop(v);
        memcpy(v->screen_what, v->screen->what, sizeof v->screen_what);
        v->screen->kind->close(v->screen);
        status = finish(v);
        if (v->wish.times) {
            print_times(v);
            print_estimate(v);
        }
    }
    release(v);
    return status;
}
