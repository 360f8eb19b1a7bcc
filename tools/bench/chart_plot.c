/* SPDX-License-Identifier: MIT */
/* chart_plot.c - the pictures of a chart: panels, titles, axes. */
#include "tools/bench/chart.h"
#include "tools/bench/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ panels */

/* One plane of error against cost, both on logarithmic scales, with the frontier. Drawn from the ground up: shade, grid, frontier,
 * curves, labels. */

#define PANEL_INK "#1f2937"
#define PANEL_PALE "#6b7280"

struct axis {
    double low, high;           /* values */
    double from, to;            /* pixels */
};

struct panel {
    struct box box;             /* of the plane itself */
    struct chart_point point[CHART_MAX_SETTINGS];
    int points;
    double none;                /* millions of instructions of cost 1, for the scale above; 0: there is none */
    struct chart_point peer[PEER_SETTINGS];         /* `setting` is one of the peer's */
    int peers;
    bool peer_errors;           /* marks, too; else lines at what it costs alone */
    struct axis x, y;
    double mark;                /* size of marks */
    double tick_size;           /* of fonts */
    double name_size;
    bool plain;                 /* names of curves are plain ones */
};

static const char grid[] = "#e5e7eb", shade[] = "#f6f7f9", edge[] = "#9ca3af";

/* ------------------------------------------------------------------ scales */

static double at(const struct axis *axis, double value)
{
    return axis->from + (axis->to - axis->from) * log(value / axis->low)
                      / log(axis->high / axis->low);
}

static const double ticks[] = { 0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50,
                                100, 200 };
enum { TICKS = sizeof ticks / sizeof *ticks };

/* Powers of ten, twos and fives always; the others where there is room. */
static bool is_labelled(const struct axis *axis, int tick, double room)
{
    double digit = ticks[tick] / pow(10.0, floor(log10(ticks[tick] * 1.001)));
    if (fabs(digit - 1.0) < 0.1 || fabs(digit - 2.0) < 0.1 || fabs(digit - 5.0) < 0.1)
        return true;
    double before = fabs(at(axis, ticks[tick]) - at(axis, ticks[tick - 1]));
    double after = fabs(at(axis, ticks[tick + 1]) - at(axis, ticks[tick]));
    return fmin(before, after) >= room;
}

static bool is_on(const struct axis *axis, double value)
{
    return value >= axis->low * 0.999 && value <= axis->high * 1.001;
}

static void include(double *low, double *high, double value)
{
    *low = fmin(*low, value);
    *high = fmax(*high, value);
}

/* Gives some panels one scale, which shows all of their points. */
static void chart_panel_fit(struct panel *panel, int panels)
{
    double x[2] = { INFINITY, 0.0 }, y[2] = { INFINITY, 0.0 };
    for (int i = 0; i < panels; i++)
        for (int k = 0; k < panel[i].points; k++) {
            include(&x[0], &x[1], panel[i].point[k].cost);
            include(&y[0], &y[1], panel[i].point[k].error);
        }
    for (int i = 0; i < panels; i++)
        for (int k = 0; k < panel[i].peers; k++)
            include(&x[0], &x[1], panel[i].peer[k].cost);
    for (int i = 0; i < panels; i++) {
        const struct box *box = &panel[i].box;
        panel[i].x = (struct axis){ x[0] / 1.12, x[1] * 1.15, box->x, box->x + box->width };
        panel[i].y = (struct axis){ y[0] / 1.25, y[1] * 1.25, box->y + box->height, box->y };
    }
}

static void draw_grid(struct svg *svg, const struct panel *p)
{
    const struct svg_style style = { grid, 1.0, NULL, 0.0 };
    const struct svg_font font = { .size = p->tick_size, .color = PANEL_INK };
    const struct box *b = &p->box;
    char text[32];
    for (int i = 0; i < TICKS; i++) {
        const double x = at(&p->x, ticks[i]), y = at(&p->y, ticks[i]);
        if (is_on(&p->x, ticks[i]))
            svg_line(svg, x, b->y, x, b->y + b->height, style);
        if (is_on(&p->y, ticks[i]))
            svg_line(svg, b->x, y, b->x + b->width, y, style);
    }
    for (int i = 0; i < TICKS; i++) {
        snprintf(text, sizeof text, "%g\u00d7", ticks[i]);
        if (is_on(&p->x, ticks[i]) && is_labelled(&p->x, i, 2.6 * p->tick_size))
            svg_text(svg, at(&p->x, ticks[i]), b->y + b->height + 1.3 * p->tick_size, ANCHOR_MIDDLE, font, text);
    }
    for (int i = 0; i < TICKS; i++) {
        snprintf(text, sizeof text, "%g", ticks[i]);
        if (is_on(&p->y, ticks[i]) && is_labelled(&p->y, i, 1.4 * p->tick_size))
            svg_text(svg, b->x - 6.0, at(&p->y, ticks[i]) + 0.35 * p->tick_size, ANCHOR_END, font, text);
    }
}

/* Above the plane: the cost in instructions. */
static void draw_scale_above(struct svg *svg, const struct panel *p)
{
    static const double millions[] = { 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000 };
    enum { COUNT = sizeof millions / sizeof *millions };
    const struct svg_font font = { .size = p->tick_size - 1.0, .color = PANEL_PALE };
    const struct svg_style style = { edge, 1.0, NULL, 0.0 };
    char text[32];
    for (size_t i = 0; i < 2 * COUNT && p->none > 0.0; i++) {       /* marks, then numbers */
        const double x = at(&p->x, millions[i % COUNT] / p->none);
        if (!is_on(&p->x, millions[i % COUNT] / p->none))
            continue;
        snprintf(text, sizeof text, "%g M", millions[i % COUNT]);
        if (i < COUNT)
            svg_line(svg, x, p->box.y - 4.0, x, p->box.y, style);
        else
            svg_text(svg, x, p->box.y - 7.0, ANCHOR_MIDDLE, font, text);
    }
}

/* ------------------------------------------------------------------ a peer */

static const char peer_color[] = "#334155";

/* What the peer costs, as lines from top to bottom. */
static void draw_peer_lines(struct svg *svg, const struct panel *p)
{
    for (int i = 0; i < p->peers; i++) {
        double x = at(&p->x, p->peer[i].cost);
        svg_line(svg, x, p->box.y, x, p->box.y + p->box.height, (struct svg_style){ peer_color, 1.0, "1.5,3", 0.75 });
    }
}

static double peer_y(const struct panel *p, int i)
{
    return p->peer_errors ? at(&p->y, p->peer[i].error) : p->box.y + p->box.height - 8.0;
}

static void draw_peer_marks(struct svg *svg, const struct panel *p)
{
    double x[PEER_SETTINGS], y[PEER_SETTINGS];
    for (int i = 0; i < p->peers; i++) {
        x[i] = at(&p->x, p->peer[i].cost);
        y[i] = peer_y(p, i);
    }
    if (!p->peer_errors)
        return;
    svg_polyline(svg, x, y, p->peers, (struct svg_style){ peer_color, 0.34 * p->mark, "6,3", 0.0 });
    for (int i = 0; i < p->peers; i++)
        svg_mark(svg, MARK_DIAMOND, x[i], y[i], p->mark, peer_color, true);
}

/* ------------------------------------------------------------------ frontier */

static int compare_cost(const void *a, const void *b)
{
    const struct chart_point *p = a, *q = b;
    return p->cost != q->cost ? (p->cost > q->cost) - (p->cost < q->cost)
                              : (p->error < q->error) - (p->error > q->error);
}

/* A staircase from the top edge to the right one; all above it is beaten. */
static int staircase(const struct panel *p, double *x, double *y)
{
    struct chart_point point[CHART_MAX_SETTINGS];
    int steps = 0, n = 0;
    for (int i = 0; i < p->points; i++)
        if (p->point[i].on_frontier)
            point[steps++] = p->point[i];
    qsort(point, (size_t)steps, sizeof *point, compare_cost);
    for (int i = 0; i < steps; i++) {
        x[n] = at(&p->x, point[i].cost);
        y[n] = i > 0 ? at(&p->y, point[i - 1].error) : p->box.y;
        n++;
        x[n] = at(&p->x, point[i].cost);
        y[n++] = at(&p->y, point[i].error);
    }
    x[n] = p->box.x + p->box.width;
    y[n] = y[n - 1];
    return n + 1;
}

static void draw_frontier(struct svg *svg, const struct panel *p, bool area)
{
    double x[2 * CHART_MAX_SETTINGS + 2], y[2 * CHART_MAX_SETTINGS + 2];
    int n = staircase(p, x, y);
    if (area) {
        x[n] = p->box.x + p->box.width;
        y[n] = p->box.y;
        svg_area(svg, x, y, n + 1, shade);
    } else {
        svg_polyline(svg, x, y, n, (struct svg_style){ edge, 1.6, "5,4", 0.0 });
    }
}

/* ------------------------------------------------------------------ curves */

/* The points of a curve, dearer ones last; pixels. */
static int curve_points(const struct panel *p, int curve, double *x, double *y)
{
    struct chart_point point[CHART_MAX_SETTINGS];
    int n = 0;
    for (int i = 0; i < p->points; i++)
        if (chart_settings[p->point[i].setting].curve == curve)
            point[n++] = p->point[i];
    qsort(point, (size_t)n, sizeof *point, compare_cost);
    for (int i = 0; i < n; i++) {
        x[i] = at(&p->x, point[i].cost);
        y[i] = at(&p->y, point[i].error);
    }
    return n;
}

static double mark_size(const struct panel *p, const struct chart_point *point)
{
    const struct chart_setting *setting = &chart_settings[point->setting];
    double size = setting->label != NULL ? p->mark : 0.45 * p->mark;
    return chart_curves[setting->curve].bold && setting->label != NULL ? 1.25 * size : size;
}

/* Bold curves last, so that they lie on top. */
static void draw_curves(struct svg *svg, const struct panel *p)
{
    double x[CHART_MAX_SETTINGS], y[CHART_MAX_SETTINGS];
    for (int bold = 0; bold < 2; bold++)
        for (int c = 0; c < chart_curve_count; c++) {
            const struct chart_curve *curve = &chart_curves[c];
            if (curve->bold != (bold == 1))
                continue;
            int n = curve_points(p, c, x, y);
            if (n > 1)
                svg_polyline(svg, x, y, n, (struct svg_style){
                    curve->color, (curve->bold ? 0.5 : 0.28) * p->mark, NULL, 0.0 });
            for (int i = 0; i < p->points; i++)
                if (chart_settings[p->point[i].setting].curve == c)
                    svg_mark(svg, curve->mark, at(&p->x, p->point[i].cost),
                             at(&p->y, p->point[i].error), mark_size(p, &p->point[i]),
                             curve->color, p->point[i].on_frontier
                                 || chart_settings[p->point[i].setting].label == NULL);
        }
}

/* ------------------------------------------------------------------ labels */

enum { MOST_OBSTACLES = 8192, MOST_LABELS = 2 * CHART_MAX_SETTINGS + PEER_SETTINGS };

struct lettering {
    struct obstacle obstacle[MOST_OBSTACLES];
    int obstacles;
    struct label label[MOST_LABELS];
    struct svg_font font[MOST_LABELS];
    const char *text[MOST_LABELS];
    int labels;
};

static void add_obstacle(struct lettering *l, double x, double y, double half, double weight)
{
    if (l->obstacles < MOST_OBSTACLES)
        l->obstacle[l->obstacles++] = (struct obstacle){
            { x - half, y - half, 2.0 * half, 2.0 * half }, weight };
}

/* Small squares along a line. */
static void add_line(struct lettering *l, const double *x, const double *y, int count,
                     double weight)
{
    const double step = 3.0;
    for (int i = 0; i + 1 < count; i++) {
        double length = hypot(x[i + 1] - x[i], y[i + 1] - y[i]);
        for (double d = 0.0; d < length; d += step)
            add_obstacle(l, x[i] + (x[i + 1] - x[i]) * d / length,
                         y[i] + (y[i + 1] - y[i]) * d / length, step / 2.0, weight);
    }
}

static void add_obstacles(struct lettering *l, const struct panel *p)
{
    double x[2 * CHART_MAX_SETTINGS + 2], y[2 * CHART_MAX_SETTINGS + 2];
    for (int c = 0; c < chart_curve_count; c++)
        add_line(l, x, y, curve_points(p, c, x, y), 3.0);
    add_line(l, x, y, staircase(p, x, y), 1.0);
    for (int i = 0; i < p->points; i++)
        add_obstacle(l, at(&p->x, p->point[i].cost), at(&p->y, p->point[i].error),
                     1.2 * mark_size(p, &p->point[i]), 4.0);
}

static struct label *add_label(struct lettering *l, struct svg_font font, double gap,
                               const char *text)
{
    int i = l->labels++;
    l->font[i] = font;
    l->text[i] = text;
    l->label[i] = (struct label){ .width = svg_text_width(font, text) + 4.0,
                                  .height = 1.15 * font.size, .gap = gap };
    return &l->label[i];
}

static void add_anchor(struct label *label, double x, double y)
{
    if (label->anchors < LABEL_ANCHORS) {
        label->anchor_x[label->anchors] = x;
        label->anchor_y[label->anchors++] = y;
    }
}

/* Beside any point of the curve or the middle of any of its lines, ends first. */
static void add_names(struct lettering *l, const struct panel *p)
{
    double x[CHART_MAX_SETTINGS], y[CHART_MAX_SETTINGS];
    for (int c = 0; c < chart_curve_count; c++) {
        int n = curve_points(p, c, x, y);
        if (n == 0)
            continue;
        struct label *label = add_label(l, (struct svg_font){
            .size = p->name_size + (chart_curves[c].bold ? 1.5 : 0.0),
            .color = chart_curves[c].color, .bold = true, .halo = true },
            1.8 * p->mark, p->plain ? chart_curves[c].plain : chart_curves[c].method);
        add_anchor(label, x[n - 1], y[n - 1]);
        add_anchor(label, x[0], y[0]);
        for (int i = 0; i + 1 < n; i++) {
            add_anchor(label, (x[i] + x[i + 1]) / 2.0, (y[i] + y[i + 1]) / 2.0);
            if (i > 0)
                add_anchor(label, x[i], y[i]);
        }
    }
}

static void add_point_labels(struct lettering *l, const struct panel *p)
{
    for (int i = 0; i < p->points; i++) {
        const struct chart_setting *s = &chart_settings[p->point[i].setting];
        const struct chart_curve *curve = &chart_curves[s->curve];
        if (s->label == NULL || s->label[0] == '\0')
            continue;
        struct label *label = add_label(l, (struct svg_font){
            .size = p->name_size - (curve->bold ? 0.0 : 1.0), .color = curve->color,
            .bold = curve->bold,
            .halo = true }, 1.4 * p->mark, s->label);
        add_anchor(label, at(&p->x, p->point[i].cost), at(&p->y, p->point[i].error));
    }
}

/* Names of the peer's lines stand in their lower ends. */
static void add_peer_labels(struct lettering *l, const struct panel *p)
{
    static const char *const text[PEER_SETTINGS] = { "TGX", "\u00d74", "\u00d78", "\u00d716" };
    for (int i = 0; i < p->peers; i++) {
        struct label *label = add_label(l, (struct svg_font){ .size = p->name_size - 1.0, .color = peer_color, .bold = true,
                                                              .halo = true }, p->peer_errors ? 1.4 * p->mark : 3.0,
                                        text[p->peer[i].setting]);
        add_anchor(label, at(&p->x, p->peer[i].cost), peer_y(p, i));
        if (p->peer_errors)
            add_obstacle(l, at(&p->x, p->peer[i].cost), peer_y(p, i), 1.2 * p->mark, 4.0);
    }
}

static bool draw_labels(struct svg *svg, const struct panel *p, struct failure *f)
{
    struct lettering *l = calloc(1, sizeof *l);
    const struct box *b = &p->box;
    if (l == NULL)
        return fail(f, "out of memory");
    add_obstacles(l, p);
    add_peer_labels(l, p);
    add_point_labels(l, p);
    add_names(l, p);
    struct box inside = { b->x + 3.0, b->y + 3.0, b->width - 6.0, b->height - 6.0 };
    labels_place(l->label, l->labels, l->obstacle, l->obstacles, inside);
    for (int i = 0; i < l->labels; i++) {
        const struct label *label = &l->label[i];
        double x = label->x + label->width / 2.0, y = label->y + label->height / 2.0;
        if (label->distance > label->gap + 9.0)
            svg_line(svg, label->anchor_x[label->anchor], label->anchor_y[label->anchor],
                     fmin(fmax(label->anchor_x[label->anchor], label->x), label->x + label->width),
                     fmin(fmax(label->anchor_y[label->anchor], label->y),
                          label->y + label->height),
                     (struct svg_style){ l->font[i].color, 0.8, NULL, 0.6 });
        svg_text(svg, x, y + 0.36 * l->font[i].size, ANCHOR_MIDDLE, l->font[i], l->text[i]);
    }
    free(l);
    return true;
}

static bool chart_panel_draw(struct svg *svg, const struct panel *p, struct failure *f)
{
    const struct box *b = &p->box;
    draw_frontier(svg, p, true);
    draw_grid(svg, p);
    draw_peer_lines(svg, p);
    draw_scale_above(svg, p);
    svg_rectangle(svg, b->x, b->y, b->width, b->height, "none", edge);
    draw_frontier(svg, p, false);
    draw_peer_marks(svg, p);
    draw_curves(svg, p);
    return draw_labels(svg, p, f);
}

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
