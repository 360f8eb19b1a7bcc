/* SPDX-License-Identifier: MIT */
/* chart_plot.c - the pictures of a chart: panels, titles, axes. */
#include "tools/bench/chart_panel.h"

static const char cost_axis[] = "cost: instructions per frame, relative to the sharp frame";
static const char error_axis[] = "error: RMSE in codes of 1/255";

static const struct svg_font title_font = { .size = 19, .color = PANEL_INK, .bold = true };
static const struct svg_font axis_font = { .size = 14, .color = PANEL_INK };
static const struct svg_font note_font = { .size = 12.5, .color = PANEL_PALE };

/* What all who look at a picture have to know. */
static void draw_notes(struct svg *svg, double x, double y)
{
    svg_text(svg, x, y, ANCHOR_START, note_font,
             "Dashed: the frontier, on which marks are filled; in the shaded area something else "
             "is both cheaper and more accurate.");
    svg_text(svg, x, y + 16, ANCHOR_START, note_font,
             "Error against 1024 exact instants; shutter 180\u00b0; one thread; both scales are "
             "logarithmic.");
}

static bool draw_set(const struct chart *chart, enum chart_set set, const char *path,
                     const char *title, const char *what, struct failure *f)
{
    enum { WIDTH = 800, HEIGHT = 600, LEFT = 66, TOP = 66, RIGHT = 18, BOTTOM = 86 };
    struct panel p = { .box = { LEFT, TOP, WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM },
                       .mark = 5.0, .tick_size = 13.0, .name_size = 13.5 };
    struct svg svg;
    p.points = chart_points_of_set(chart, CHART_MAIN, set, p.point);
    if (p.points == 0)
        return true;
    chart_panel_fit(&p, 1);
    if (!svg_begin(&svg, WIDTH, HEIGHT, title, f))
        return false;
    svg_text(&svg, LEFT, 26, ANCHOR_START, title_font, title);
    svg_text(&svg, LEFT, 50, ANCHOR_START, (struct svg_font){ .size = 13.5, .color = PANEL_PALE },
             what);
    bool ok = chart_panel_draw(&svg, &p, f);
    svg_text(&svg, LEFT + p.box.width / 2.0, HEIGHT - BOTTOM + 40, ANCHOR_MIDDLE, axis_font,
             cost_axis);
    svg_text_up(&svg, 20, TOP + p.box.height / 2.0, axis_font, error_axis);
    draw_notes(&svg, LEFT, HEIGHT - 24);
    return svg_end(&svg, path, f) && ok;
}

static bool draw_both(const struct chart *chart, const char *path, struct failure *f)
{
    enum { WIDTH = 800, HEIGHT = 560, LEFT = 58, TOP = 70, GAP = 46, RIGHT = 10, BOTTOM = 86,
           PLOT = (WIDTH - LEFT - GAP - RIGHT) / 2 };
    static const char title[] = "Motion blur on a CPU: accuracy and its price";
    static const struct {
        enum chart_set set;
        const char *what;
    } half[2] = { { SET_OBJECT, "12 scenes with moving objects" },
                  { SET_CAMERA, "7 scenes with a moving camera" } };
    struct panel panel[2];
    struct svg svg;
    bool ok = true;
    for (int i = 0; i < 2; i++) {
        panel[i] = (struct panel){
            .box = { LEFT + i * (PLOT + GAP), TOP, PLOT, HEIGHT - TOP - BOTTOM }, .mark = 4.2,
            .tick_size = 12.5, .name_size = 13.0, .short_names = true };
        panel[i].points = chart_points_of_set(chart, CHART_MAIN, half[i].set, panel[i].point);
        if (panel[i].points == 0)
            return true;
    }
    chart_panel_fit(panel, 2);
    if (!svg_begin(&svg, WIDTH, HEIGHT, title, f))
        return false;
    svg_text(&svg, LEFT, 26, ANCHOR_START, title_font, title);
    for (int i = 0; i < 2; i++) {
        ok = ok && chart_panel_draw(&svg, &panel[i], f);
        svg_text(&svg, panel[i].box.x, TOP - 10, ANCHOR_START,
                 (struct svg_font){ .size = 14.5, .color = PANEL_INK, .bold = true },
                 half[i].what);
    }
    svg_text(&svg, LEFT + PLOT + GAP / 2.0, HEIGHT - BOTTOM + 40, ANCHOR_MIDDLE, axis_font,
             cost_axis);
    svg_text_up(&svg, 18, TOP + panel[0].box.height / 2.0, axis_font, error_axis);
    draw_notes(&svg, LEFT, HEIGHT - 24);
    return svg_end(&svg, path, f) && ok;
}

/* ------------------------------------------------------------------ scene by scene */

static void draw_legend(struct svg *svg, double left, double right, double y)
{
    const struct svg_font font = { .size = 12.5, .color = PANEL_INK };
    double x = left;
    for (int c = 0; c < chart_curve_count; c++) {
        double width = svg_text_width(font, chart_curves[c].name) + 34.0;
        if (x + width > right) {
            x = left;
            y += 18.0;
        }
        svg_mark(svg, chart_curves[c].mark, x + 6.0, y - 4.0, 4.5, chart_curves[c].color, true);
        svg_text(svg, x + 16.0, y, ANCHOR_START, font, chart_curves[c].name);
        x += width;
    }
}

/* All scenes on planes of one scale. */
static bool draw_scenes(const struct chart *chart, const char *path, struct failure *f)
{
    enum { COLUMNS = 4, WIDTH = 800, LEFT = 52, TOP = 104, CELL_W = 186, CELL_H = 176,
           PLOT_W = 158, PLOT_H = 134, FOOT = 28 };
    static struct panel panel[KINDS];
    static int kind[KINDS];
    static const char title[] = "Scene by scene: accuracy of motion blur and its price";
    struct svg svg;
    int n = 0;
    for (int k = 0; k < KINDS; k++) {
        struct panel *p = &panel[n];
        if (kinds[k].group == GROUP_STILL)
            continue;
        *p = (struct panel){ .box = { LEFT + n % COLUMNS * CELL_W, TOP + n / COLUMNS * CELL_H,
                                      PLOT_W, PLOT_H }, .mark = 2.6, .tick_size = 11.0 };
        p->points = chart_points_of_kind(chart, CHART_MAIN, k, p->point);
        kind[n] = k;
        n += p->points > 0;
    }
    int rows = (n + COLUMNS - 1) / COLUMNS, height = TOP + rows * CELL_H + FOOT;
    if (n == 0)
        return true;
    chart_panel_fit(panel, n);
    if (!svg_begin(&svg, WIDTH, height, title, f))
        return false;
    svg_text(&svg, 20, 28, ANCHOR_START, title_font, title);
    draw_legend(&svg, 20, WIDTH - 8, 54);
    bool ok = true;
    for (int i = 0; i < n; i++) {
        ok = ok && chart_panel_draw(&svg, &panel[i], f);
        svg_text(&svg, panel[i].box.x, panel[i].box.y - 5.0, ANCHOR_START,
                 (struct svg_font){ .size = 13.0, .color = PANEL_INK, .bold = true },
                 kinds[kind[i]].name);
    }
    svg_text(&svg, WIDTH / 2.0, height - 12, ANCHOR_MIDDLE, axis_font, cost_axis);
    svg_text_up(&svg, 16, TOP + (rows * CELL_H - CELL_H + PLOT_H) / 2.0, axis_font, error_axis);
    return svg_end(&svg, path, f) && ok;
}

/* ------------------------------------------------------------------ all */

bool chart_write_pictures(const struct chart *chart, const char *folder, struct failure *f)
{
    static const struct {
        enum chart_set set;
        const char *file, *title, *what;
    } sets[] = {
        { SET_OBJECT, "object.svg", "Motion blur of moving objects: accuracy and its price",
          "Geometric means of 12 scenes, still camera. Left is cheaper, down is more accurate." },
        { SET_CAMERA, "camera.svg", "Motion blur under a moving camera: accuracy and its price",
          "Geometric means of 7 scenes. Left is cheaper, down is more accurate." },
        { SET_MOVING, "all.svg", "Motion blur on a CPU: accuracy and its price",
          "Geometric means of 19 scenes. Left is cheaper, down is more accurate." },
    };
    char path[512];
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, sets[i].file);
        if (!draw_set(chart, sets[i].set, path, sets[i].title, sets[i].what, f))
            return false;
    }
    snprintf(path, sizeof path, "%s/both.svg", folder);
    if (!draw_both(chart, path, f))
        return false;
    snprintf(path, sizeof path, "%s/scenes.svg", folder);
    return draw_scenes(chart, path, f);
}
