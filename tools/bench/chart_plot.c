/* SPDX-License-Identifier: MIT */
/* chart_plot.c - the pictures of a chart: panels, titles, axes. */
#include "tools/bench/chart_panel.h"

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof *(array)))

static const char cost_axis[] = "cost of a frame in parts of the sharp one; above: millions of instructions";
static const char error_axis[] = "error: RMSE in codes of 1/255";
static const char plain_cost_axis[] = "cost: instructions of a frame, in parts of the sharp one";
static const char plain_error_axis[] = "error: of 255 steps of a colour";
static const char *const plain_notes[] = {
    "Left is cheaper, down is closer to the truth, the mean of 1,024 exact instants. Grey: an application's own mean of N sharp",
    "frames; what mixing them takes is not counted. Geometric means over scenes of 320x240, one thread, smear's defaults.",
};

static const struct svg_font title_font = { .size = 19, .color = PANEL_INK, .bold = true };
static const struct svg_font what_font = { .size = 13.5, .color = PANEL_PALE };
static const struct svg_font axis_font = { .size = 14, .color = PANEL_INK };
static const struct svg_font note_font = { .size = 12, .color = PANEL_PALE };

static const char *const notes[] = {
    "Left is cheaper, down is more accurate. Dashed: the frontier, on which marks are filled; in the shaded area",
    "something else is both. Geometric means; error against 1024 exact instants in the same light; shutter 180\u00b0;",
    "320x240, one thread. TGX, dotted: a peer in floating point; its sharp frame and the mean of 4, 8 and 16, on those of",
    "the scenes that it has drawn, always in encoded light, 8 bits per channel, exact poses, lit beforehand.",
};

/* What all who look at a picture have to know. */
static void draw_notes(struct svg *svg, double x, double y, const char *const *lines, int count)
{
    for (int i = 0; i < count; i++)
        svg_text(svg, x, y + 15.5 * i, ANCHOR_START, note_font, lines[i]);
}

/* ------------------------------------------------------------------ means */

static const struct part {
    enum chart_set set;
    const char *title;
} parts[] = {
    { SET_OBJECT, "12 scenes with moving objects" },
    { SET_CAMERA, "7 scenes with a moving camera" },
    { SET_FIELD, "4 frames of the demo, 3 models" },
    { SET_PEER, "6 frames that a peer draws, too" },
};
enum { PARTS = sizeof parts / sizeof *parts, PLAIN_PARTS = 2 };

static const struct plot {
    bool plain;
    const char *name, *title, *what;
} plots[] = {
    { true, "marks", "What motion blur costs, and how far it is from the truth", NULL },
    { false, "chart", "Motion blur on a CPU: accuracy and its price",
      "As it comes: linear light, poses of frames ago, RGB565 with dither" },
};
enum { PLOTS = sizeof plots / sizeof *plots };

/* Where there are no models, the demo alone. */
static struct part shown_part(const struct chart *chart, int i)
{
    struct part part = parts[i];
    if (part.set == SET_FIELD && !chart_mean_of(chart, CHART_DEFAULT, SET_FIELD, chart_none).known)
        part = (struct part){ SET_DEMO, "4 frames of the demo" };
    return part;
}

/* Leaves out what has no mark, and sees to it that the frontier is that of the others. */
static int keep_shown(struct chart_point *point, int count, bool plain)
{
    int n = 0;
    for (int i = 0; i < count; i++)
        if (plain ? chart_is_plain(point[i].setting) : chart_is_shown(point[i].setting))
            point[n++] = point[i];
    chart_mark_frontier(point, n);
    return n;
}

/* An application's own mean is drawn at what its sharp frames cost: what mixing takes depends on how it is done. */
static void leave_out_mixing(struct chart_point *point, int count)
{
    for (int i = 0; i < count; i++)
        if (chart_settings[point[i].setting].method == SMEAR_ACCUMULATE)
            point[i].cost = chart_settings[point[i].setting].samples;
}

static void fill_panel(struct panel *p, const struct chart *chart, const struct plot *plot, enum chart_set set)
{
    p->plain = plot->plain;
    p->points = chart_points_of_set(chart, CHART_DEFAULT, set, p->point);
    if (plot->plain)
        leave_out_mixing(p->point, p->points);
    p->points = keep_shown(p->point, p->points, plot->plain);
    p->none = plot->plain ? 0.0 : chart_mean_of(chart, CHART_DEFAULT, set, chart_none).instructions;
    p->peer_errors = set == SET_PEER;
    for (int s = 0; s < PEER_SETTINGS && !plot->plain && set != SET_FIELD && set != SET_DEMO; s++) {    /* one frame is no mean */
        struct chart_point *peer = &p->peer[p->peers];
        peer->setting = s;
        p->peers += chart_peer_mean(chart, CHART_DEFAULT, set, s, &peer->cost, &peer->error);
    }
}

/* All parts on planes of one scale. */
static bool draw_all_parts(const struct chart *chart, const struct plot *plot, const char *path, struct failure *f)
{
    enum { COLUMNS = 2, WIDTH = 800, LEFT = 58, GAP = 40, RIGHT = 8, PLOT_W = (WIDTH - LEFT - GAP - RIGHT) / 2 };
    const int parts_of = plot->plain ? PLAIN_PARTS : PARTS, rows = (parts_of + COLUMNS - 1) / COLUMNS;
    const int top = plot->plain ? 76 : 108, tall = plot->plain ? 270 : 350, step = tall + 76;
    const int bottom = top + (rows - 1) * step + tall;
    static struct panel panel[PARTS];
    struct part part[PARTS];
    struct svg svg;
    int n = 0;
    for (int i = 0; i < parts_of; i++) {
        struct panel *p = &panel[n];
        part[n] = shown_part(chart, i);
        *p = (struct panel){ .box = { LEFT + n % COLUMNS * (PLOT_W + GAP), top + n / COLUMNS * step, PLOT_W, tall },
                             .mark = 4.2, .tick_size = 12.5, .name_size = 13.0 };
        fill_panel(p, chart, plot, part[n].set);
        n += p->points > 0;
    }
    if (n == 0)
        return true;
    chart_panel_fit(panel, n);
    if (!svg_begin(&svg, WIDTH, bottom + (plot->plain ? 84 : 116), plot->title, f))
        return false;
    svg_text(&svg, LEFT, 26, ANCHOR_START, title_font, plot->title);
    if (plot->what != NULL)
        svg_text(&svg, LEFT, 48, ANCHOR_START, what_font, plot->what);
    bool ok = true;
    for (int i = 0; i < n; i++) {
        ok = ok && chart_panel_draw(&svg, &panel[i], f);
        svg_text(&svg, panel[i].box.x, panel[i].box.y - (plot->plain ? 10.0 : 26.0), ANCHOR_START,
                 (struct svg_font){ .size = 14.5, .color = PANEL_INK, .bold = true }, part[i].title);
    }
    svg_text(&svg, LEFT + PLOT_W + GAP / 2.0, bottom + 38, ANCHOR_MIDDLE, axis_font, plot->plain ? plain_cost_axis : cost_axis);
    svg_text_up(&svg, 18, (top + bottom) / 2.0, axis_font, plot->plain ? plain_error_axis : error_axis);
    draw_notes(&svg, LEFT, bottom + 60, plot->plain ? plain_notes : notes, plot->plain ? COUNT_OF(plain_notes) : COUNT_OF(notes));
    return svg_end(&svg, path, f) && ok;
}

/* ------------------------------------------------------------------ all */

bool chart_write_pictures(const struct chart *chart, const char *folder, struct failure *f)
{
    char path[512];
    bool ok = true;
    for (int k = 0; k < PLOTS && ok; k++) {
        snprintf(path, sizeof path, "%s/%s.svg", folder, plots[k].name);
        ok = draw_all_parts(chart, &plots[k], path, f);
    }
    return ok;
}
