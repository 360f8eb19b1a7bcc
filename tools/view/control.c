/* SPDX-License-Identifier: MIT */
/* control.c - see control.h. */
#include "tools/view/control.h"

#include "tools/scenes/methods.h"
#include "tools/view/film.h"

#include <string.h>

#define PI 3.14159265358979323846

enum { SHUTTER_STEP = 15, SHUTTER_MAX = 360, DIVIDER_STEP = 25, MAX_ZOOM = 8 };
#define TURN_STEP (PI / 36.0)       /* a key's 5 degrees */
#define MOVE_STEP 1.1

const char *const pace_names[] = { "time", "every", "board", NULL };

/* ------------------------------------------------------------------ settings of lanes */

const char *control_method_name(smear_method method)
{
    const struct method *found = method_of(method);
    return found != NULL ? found->name : "?";
}

static smear_method other_method(smear_method now, int way)
{
    const struct method *found = method_of(now);
    const int at = found != NULL ? (int)(found - method_list) : 0;
    return method_list[(at + way + method_count) % method_count].method;
}

smear_edges control_edges(const struct view *v, const struct render_options *o)
{
    const bool has_smooth = method_smooths_edges(o->method) && (!o->keep_display || o->cache_static);
    return has_smooth ? v->edges : SMEAR_EDGES_HARD;
}

/* What the method does not have must not keep it from being chosen. Slots of timemask are 8, 16 or 32. */
static void fit_method(const struct view *v, struct render_options *o)
{
    if (o->method == SMEAR_TIMEMASK && o->samples != 8 && o->samples != 16)
        o->samples = 0;
    if (o->method != SMEAR_RECONSTRUCT)
        o->reconstruct = 0;
    if (o->method != SMEAR_CAMERA && o->method != SMEAR_HALF)
        o->filter = SMEAR_FILTER_DEFAULT;
    o->edges = control_edges(v, o);
}

/* Other options for one lane; told when they do not work. */
static void apply(struct view *v, struct lane *lane, const struct render_options *options)
{
    struct failure f = { "" };
    if (!lane_open(lane, options, v->source, &f))
        view_say(v, "%s", f.text);
    v->is_dirty = true;
}

/* Settings that are not the method hold for both halves of a split screen. */
static void apply_both(struct view *v, const struct render_options *main)
{
    apply(v, &v->main, main);
    if (v->left.is_open) {
        struct render_options left = *main;
        left.method = v->left.options.method;
        left.samples = v->left.options.samples;
        left.reconstruct = v->left.options.reconstruct;
        left.edges = control_edges(v, &left);
        apply(v, &v->left, &left);
    }
}

static void do_blur(struct view *v, int way)
{
    struct render_options o = v->main.options;
    (void)way;
    if (o.method != SMEAR_NONE)
        v->blurred = o.method;
    o.method = o.method != SMEAR_NONE ? SMEAR_NONE : v->blurred;
    fit_method(v, &o);
    apply(v, &v->main, &o);
    view_say(v, "blur %s", o.method == SMEAR_NONE ? "off" : "on");
}

static void do_method(struct view *v, int way)
{
    struct render_options o = v->main.options;
    o.method = other_method(o.method, way);
    fit_method(v, &o);
    apply(v, &v->main, &o);
    view_say(v, "method %s", control_method_name(o.method));
}

static void do_quality(struct view *v, int way)
{
    enum { COUNT = 4 };
    static const int targets[COUNT] = { SMEAR_SKETCH, SMEAR_DRAFT, SMEAR_BALANCED, SMEAR_FINE };
    static const char *const names[COUNT] = { "sketch", "draft", "balanced", "fine" };
    struct render_options o = v->main.options;
    const int target = o.target != 0 ? o.target : SMEAR_BALANCED;
    int at = 0;
    while (at < COUNT - 1 && target < targets[at])
        at++;
    at = (at + way + COUNT) % COUNT;
    o.target = targets[at];
    apply_both(v, &o);
    view_say(v, "quality %s (auto)", names[at]);
}

static void do_shutter(struct view *v, int way)
{
    struct render_options o = v->main.options;
    int degrees = o.shutter_degrees / SHUTTER_STEP * SHUTTER_STEP + way * SHUTTER_STEP;
    if (way < 0 && o.shutter_degrees % SHUTTER_STEP != 0)
        degrees += SHUTTER_STEP;
    o.shutter_degrees = degrees < 0 ? 0 : degrees > SHUTTER_MAX ? SHUTTER_MAX : degrees;
    apply_both(v, &o);
    view_say(v, "shutter %d degrees", o.shutter_degrees);
}

static void do_samples(struct view *v, int way)
{
    static const int taps[] = { 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64 };
    static const int slots[] = { 8, 16, 32 };
    struct render_options o = v->main.options;
    const bool is_slots = o.method == SMEAR_TIMEMASK;
    const int *list = is_slots ? slots : taps;
    int count = is_slots ? 3 : (int)(sizeof taps / sizeof *taps), at = 0;
    int now = o.samples > 0 ? o.samples : smear_method_is_temporal(o.method) ? 32 : 8;
    while (at < count - 1 && list[at] < now)
        at++;
    at += way;
    o.samples = list[at < 0 ? 0 : at >= count ? count - 1 : at];
    apply(v, &v->main, &o);
    view_say(v, "%d samples", o.samples);
}

static void do_light(struct view *v, int way)
{
    struct render_options o = v->main.options;
    (void)way;
    o.light = o.light == SMEAR_LIGHT_LINEAR ? SMEAR_LIGHT_ENCODED : SMEAR_LIGHT_LINEAR;
    apply_both(v, &o);
    view_say(v, "%s light", o.light == SMEAR_LIGHT_LINEAR ? "linear" : "encoded");
}

static bool can_diffuse(const struct render_options *o)
{
    return o->format >= SMEAR_L4 && !o->keep_display;
}

static void do_format(struct view *v, int way)
{
    enum { FORMATS = SMEAR_L1_PAGES + 1 };
    struct render_options o = v->main.options;
    o.format = (smear_format)(((int)o.format + way + FORMATS) % FORMATS);
    if (o.dither == SMEAR_DITHER_DIFFUSE && !can_diffuse(&o))
        o.dither = SMEAR_DITHER_ORDERED;
    apply_both(v, &o);
    view_say(v, "format %s", options_format_name(o.format));
}

static void do_dither(struct view *v, int way)
{
    static const char *const names[] = { "ordered", "none", "blue", "diffuse" };
    struct render_options o = v->main.options;
    const int count = can_diffuse(&o) ? 4 : 3;
    o.dither = (smear_dither)(((int)o.dither + way + count) % count);
    apply_both(v, &o);
    view_say(v, "dither %s", names[o.dither]);
}

static void do_edges(struct view *v, int way)
{
    struct render_options o = v->main.options;
    (void)way;
    v->edges = v->edges == SMEAR_EDGES_HARD ? SMEAR_EDGES_SMOOTH : SMEAR_EDGES_HARD;
    o.edges = control_edges(v, &o);
    apply_both(v, &o);
    view_say(v, "edges %s%s", v->edges == SMEAR_EDGES_HARD ? "hard" : "smooth",
             o.edges == v->edges ? "" : ", where settings allow it");
}

/* ------------------------------------------------------------------ time */

static void do_pause(struct view *v, int way)
{
    (void)way;
    v->is_paused = !v->is_paused;
    v->is_dirty = true;
}

static void do_step(struct view *v, int way)
{
    v->is_paused = true;
    v->at += way * VIEW_UNITS;
    v->at = v->at / VIEW_UNITS * VIEW_UNITS;
    if (v->at < 0)
        v->at = 0;
    v->frames_apart = 1;
    v->is_dirty = true;
}

static void do_start(struct view *v, int way)
{
    (void)way;
    v->at = (int64_t)v->wish.first * VIEW_UNITS;
    v->is_dirty = true;
}

static void do_speed(struct view *v, int way)
{
    if (way > 0 ? v->speed < 8 * VIEW_UNITS : v->speed > 1)
        v->speed = way > 0 ? v->speed * 2 : v->speed / 2;
    view_say(v, "time x %g", (double)v->speed / VIEW_UNITS);
}

static void do_pace(struct view *v, int way)
{
    int count = v->wish.core != NULL ? 3 : 2;
    v->wish.pace = (enum pace)(((int)v->wish.pace + way + count) % count);
    view_say(v, "pace %s", pace_names[v->wish.pace]);
}

/* ------------------------------------------------------------------ looks */

static void do_split(struct view *v, int way)
{
    struct render_options o = v->main.options;
    (void)way;
    v->is_split = !v->is_split;
    v->is_dirty = true;
    if (!v->is_split || v->left.is_open)
        return;
    o.method = SMEAR_NONE;
    fit_method(v, &o);
    apply(v, &v->left, &o);
}

static void do_left(struct view *v, int way)
{
    if (!v->is_split) {
        do_split(v, 1);
        return;
    }
    struct render_options o = v->left.options;
    o.method = other_method(o.method, way);
    o.samples = v->main.options.samples;
    fit_method(v, &o);
    apply(v, &v->left, &o);
    view_say(v, "left %s", control_method_name(o.method));
}

static void move_divider(struct view *v, int by)
{
    v->divider += by;
    v->divider = v->divider < 0 ? 0 : v->divider > 1000 ? 1000 : v->divider;
    v->is_dirty = true;
}

static void do_divider(struct view *v, int way)
{
    move_divider(v, way * DIVIDER_STEP);
}

static void do_debug(struct view *v, int way)
{
    v->debug_kind = (enum debug_kind)(((int)v->debug_kind + way + DEBUG_KINDS) % DEBUG_KINDS);
    v->is_dirty = true;
    const char *legend = debug_legends[v->debug_kind];
    view_say(v, "%s%s%s", debug_names[v->debug_kind], legend != NULL ? ": " : "",
             legend != NULL ? legend : "");
}

static void do_overlay(struct view *v, int way)
{
    (void)way;
    v->has_overlay = !v->has_overlay;
    v->is_dirty = true;
}

static void do_zoom(struct view *v, int way)
{
    int zoom = v->look.zoom + way;
    v->look.zoom = zoom < 0 ? MAX_ZOOM : zoom > MAX_ZOOM ? 0 : zoom;
    v->is_dirty = true;
    if (v->look.zoom == 0)
        view_say(v, "zoom to fit");
    else
        view_say(v, "zoom %d", v->look.zoom);
}

static void do_turn_panel(struct view *v, int way)
{
    v->look.turns = (v->look.turns + way) & 3;
    v->is_dirty = true;
}

static void do_round(struct view *v, int way)
{
    (void)way;
    v->look.round = !v->look.round;
    v->is_dirty = true;
}

static void do_sync(struct view *v, int way)
{
    (void)way;
    v->wish.bus.synced = !v->wish.bus.synced;
    v->is_dirty = true;
    view_say(v, "panel %s", v->wish.bus.synced ? "in step" : "not in step");
}

static void do_error(struct view *v, int way)
{
    (void)way;
    film_measure(v);
}

static void do_help(struct view *v, int way)
{
    v->help_page += way;
    v->is_dirty = true;
}

/* ------------------------------------------------------------------ camera, clips */

static bool find_focus(struct view *v)
{
    struct failure f = { "" };
    v->is_dirty = true;
    if (v->orbit.focus > 0.0 || orbit_find_focus(&v->orbit, view_instant(v, v->at).time, &f))
        return true;
    view_say(v, "%s", f.text);
    return false;
}

static void do_yaw(struct view *v, int way)
{
    if (find_focus(v))
        orbit_turn(&v->orbit, way * TURN_STEP, 0.0);
}

static void do_pitch(struct view *v, int way)
{
    if (find_focus(v))
        orbit_turn(&v->orbit, 0.0, way * TURN_STEP);
}

static void do_move(struct view *v, int way)
{
    if (find_focus(v))
        orbit_move(&v->orbit, way > 0 ? 1.0 / MOVE_STEP : MOVE_STEP);
}

/* A round in two seconds, so that what stands still is seen to move. */
static void do_spin(struct view *v, int way)
{
    if (!find_focus(v))
        return;
    v->orbit.spin = v->orbit.spin == 0.0 ? way * PI : 0.0;
    view_say(v, "turntable %s", v->orbit.spin != 0.0 ? "on" : "off");
}

static void do_reset(struct view *v, int way)
{
    (void)way;
    orbit_reset(&v->orbit);
    v->is_dirty = true;
}

/* A number as text that stays until the next but one. */
struct number_text {
    char text[2][16];
    int turn;
};

static const char *text_of(struct number_text *t, int number)
{
    t->turn = !t->turn;
    snprintf(t->text[t->turn], sizeof t->text[t->turn], "%d", number);
    return t->text[t->turn];
}

static void do_clip(struct view *v, int way)
{
    static struct number_text text;
    const struct model *m = &v->source->model;
    struct source_view seen = v->main.options.view;
    if (!v->source->is_file || m->clip_count == 0) {
        view_say(v, "no clips");
        return;
    }
    int now = seen.clip == NULL ? 0 : model_find_clip(m, seen.clip);
    now = now < 0 ? m->clip_count : now;            /* none, and all */
    now = (now + way + m->clip_count + 1) % (m->clip_count + 1);
    bool is_all = now == m->clip_count;
    seen.clip = is_all ? "all" : text_of(&text, now);
    if (view_load(v, &seen))                        /* another model from here on */
        view_say(v, "clip %s", is_all ? "all" : v->source->model.clip[now].name);
}

static void do_camera(struct view *v, int way)
{
    static struct number_text text;
    const struct model *m = &v->source->model;
    struct source_view seen = v->main.options.view;
    if (!v->source->is_file || m->camera_count < 2) {
        view_say(v, "no other camera");
        return;
    }
    int now = seen.camera == NULL ? 0 : model_find_camera(m, seen.camera);
    now = (now + way + m->camera_count) % m->camera_count;
    seen.camera = text_of(&text, now);
    seen.has_eye = false;
    if (view_load(v, &seen))
        view_say(v, "camera %s", v->source->model.camera[now].name);
}

static void do_loop(struct view *v, int way)
{
    struct source_view seen = v->main.options.view;
    (void)way;
    seen.loop = !seen.loop;
    if (!v->source->is_file)
        view_say(v, "built-in scenes have their own time");
    else if (view_load(v, &seen))
        view_say(v, "clips %s", seen.loop ? "loop" : "end");
}

static void do_reload(struct view *v, int way)
{
    (void)way;
    if (view_load(v, &v->main.options.view))
        view_say(v, "loaded again");
}

/* ------------------------------------------------------------------ files, end */

static void do_screenshot(struct view *v, int way)
{
    (void)way;
    film_screenshot(v);
}

static void do_quit(struct view *v, int way)
{
    (void)way;
    if (v->help_page != 0) {
        v->help_page = 0;
        v->is_dirty = true;
    } else {
        v->quits = true;
    }
}

static void do_quit_now(struct view *v, int way)
{
    (void)way;
    v->quits = true;
}

/* ------------------------------------------------------------------ the list */

const struct control control_list[] = {
    { "?", { '?', 0 }, do_help, "this list" },
    { "q", { 'q', 0 }, do_quit_now, "quit" },
    { "escape", { SCREEN_ESCAPE, 0 }, do_quit, "close this list; quit" },
    { "space", { ' ', 0 }, do_pause, "pause, go on" },
    { ". ,", { '.', ',' }, do_step, "a frame forward, back" },
    { "home", { SCREEN_HOME, 0 }, do_start, "to the first frame" },
    { "t T", { 't', 'T' }, do_speed, "time x 2, x 1/2" },
    { "w", { 'w', 0 }, do_pace, "pace: clock, every frame, board" },
    { "b", { 'b', 0 }, do_blur, "blur on, off" },
    { "m M", { 'm', 'M' }, do_method, "method" },
    { "u U", { 'u', 'U' }, do_quality, "quality of auto" },
    { "] [", { ']', '[' }, do_shutter, "shutter, by 15 degrees" },
    { "n N", { 'n', 'N' }, do_samples, "more, fewer samples" },
    { "l", { 'l', 0 }, do_light, "light: linear, encoded" },
    { "f F", { 'f', 'F' }, do_format, "format of the panel" },
    { "d", { 'd', 0 }, do_dither, "dither" },
    { "h", { 'h', 0 }, do_edges, "edges: hard, smooth (auto, subframes)" },
    { "v", { 'v', 0 }, do_split, "split screen" },
    { "V", { 'V', 0 }, do_left, "method of its left half" },
    { "> <", { '>', '<' }, do_divider, "its divider (or drag, right button)" },
    { "tab", { SCREEN_TAB, '`' }, do_debug, "velocity, depth, tiles, methods ..." },
    { "o", { 'o', 0 }, do_overlay, "figures on, off" },
    { "e", { 'e', 0 }, do_error, "error against the truth" },
    { "z Z", { 'z', 'Z' }, do_zoom, "zoom" },
    { "r", { 'r', 0 }, do_turn_panel, "turn the panel" },
    { "R", { 'R', 0 }, do_round, "round glass" },
    { "y", { 'y', 0 }, do_sync, "bus in step with the panel, or not" },
    { "right left", { SCREEN_RIGHT, SCREEN_LEFT }, do_yaw, "orbit (or drag)" },
    { "down up", { SCREEN_DOWN, SCREEN_UP }, do_pitch, "orbit (or drag)" },
    { "pageup -dn", { SCREEN_PAGE_UP, SCREEN_PAGE_DOWN }, do_move, "closer, farther (or wheel)" },
    { "j", { 'j', 0 }, do_spin, "turntable" },
    { "x", { 'x', 0 }, do_reset, "the scene's own camera again" },
    { "c", { 'c', 'C' }, do_camera, "next camera of the file" },
    { "k K", { 'k', 'K' }, do_clip, "clip of the file" },
    { "L", { 'L', 0 }, do_loop, "clips loop, or end" },
    { "i", { 'i', 0 }, do_reload, "load the file again" },
    { "s", { 's', 0 }, do_screenshot, "screenshot (PNG)" },
    { NULL, { 0, 0 }, NULL, NULL },
};

static void press(struct view *v, int key)
{
    for (const struct control *c = control_list; c->keys != NULL; c++)
        for (int i = 0; i < 2; i++)
            if (c->key[i] == key && key != 0)
                c->act(v, i == 0 ? 1 : -1);
}

/* x and y are thousandths of the surface's shorter side. */
static void drag(struct view *v, const struct event *e)
{
    if (e->button == 3) {
        if (v->is_split)
            move_divider(v, e->x);
    } else if (find_focus(v)) {
        orbit_turn(&v->orbit, -e->x * PI / 1000.0, -e->y * PI / 1000.0);
    }
}

void control_event(struct view *v, const struct event *e)
{
    switch (e->kind) {
    case EVENT_KEY: press(v, e->key); break;
    case EVENT_DRAG: drag(v, e); break;
    case EVENT_WHEEL: do_move(v, e->y); break;
    default: break;
    }
}
