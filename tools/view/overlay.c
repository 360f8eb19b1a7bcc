/* SPDX-License-Identifier: MIT */
/* overlay.c - see overlay.h. */
#include "tools/view/overlay.h"

#include "tools/scenes/methods.h"
#include "tools/view/clock.h"
#include "tools/view/control.h"
#include "tools/view/font.h"

#include <stdarg.h>
#include <string.h>

enum { MARGIN = 4, HELP_KEYS = 11, HELP_COLUMN = 48, FEWEST_ROWS = 3 };

/* ------------------------------------------------------------------ lines */

struct page {
    struct text *text;
    int columns, rows;
};

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void add(struct page *p, const char *format, ...)
{
    if (p->text->rows >= p->rows || p->text->rows >= TEXT_ROWS)
        return;
    char *line = p->text->line[p->text->rows++];
    va_list args;
    va_start(args, format);
    vsnprintf(line, TEXT_COLUMNS + 1, format, args);
    va_end(args);
    if (p->columns < TEXT_COLUMNS)
        line[p->columns > 0 ? p->columns : 0] = '\0';
}

/* ------------------------------------------------------------------ figures */

static double ms(uint32_t ticks)
{
    return ticks / (DEVICE_TICKS_PER_US * 1000.0);
}

static void add_settings(struct page *p, const struct view *v)
{
    const struct render_options *o = &v->main.options;
    char samples[24] = "";
    if (o->samples > 0)
        snprintf(samples, sizeof samples, " %d", o->samples);
    if (v->is_split && v->left.is_open)
        add(p, "%s | %s%s  shutter %d", control_method_name(v->left.options.method),
            control_method_name(o->method), samples, o->shutter_degrees);
    else
        add(p, "%s%s  shutter %d", control_method_name(o->method), samples, o->shutter_degrees);
    add(p, "%dx%d %s  %s light%s", v->main.setup.width, v->main.setup.height,
        options_format_name(o->format), o->light == SMEAR_LIGHT_LINEAR ? "linear" : "encoded",
        o->edges == SMEAR_EDGES_HARD ? "" : "  smooth edges");
}

static void add_time(struct page *p, const struct view *v)
{
    struct instant now = view_instant(v, v->at);
    if (now.frame >= 0)
        add(p, "frame %ld  %.3f s%s", now.frame, now.time, v->is_paused ? "  paused" : "");
    else
        add(p, "between frames  %.3f s%s", now.time, v->is_paused ? "  paused" : "");
}

static void add_stages(struct page *p, const struct view *v)
{
    const smear_stats *s = &v->main.stats;
    add(p, "%.1f shown per second, of %.4g  x%g", v->shown_fps, view_fps(v),
        (double)v->speed / VIEW_UNITS);
    add(p, "drawn in %.2f ms: submit %.2f raster %.2f", v->main.wall_us / 1000.0,
        ms(s->time.submit), ms(s->time.raster));
    add(p, "  reduce %.2f blur %.2f convert %.2f", ms(s->time.reduce), ms(s->time.blur),
        ms(s->time.convert));
}

/* Tiles by the methods that they got. */
static void add_methods(struct page *p, const smear_stats *s)
{
    char line[TEXT_COLUMNS + 1] = " ";
    for (int i = 0; i < method_count; i++)
        if (s->tiles[method_list[i].method] > 0)
            snprintf(line + strlen(line), sizeof line - strlen(line), " %s %lu", method_list[i].name,
                     (unsigned long)s->tiles[method_list[i].method]);
    add(p, "%s", line);
}

static void add_counts(struct page *p, const struct view *v)
{
    const smear_stats *s = &v->main.stats;
    add(p, "triangles %lu in %lu drawn %lu dropped", (unsigned long)s->triangles_in,
        (unsigned long)s->triangles_drawn, (unsigned long)s->triangles_dropped);
    if (s->parts_added > 0)
        add(p, "  drawn in parts: split %lu times", (unsigned long)s->parts_added);
    add(p, "tiles %lu still %lu uniform %lu complex", (unsigned long)s->tiles_static,
        (unsigned long)s->tiles_uniform, (unsigned long)s->tiles_complex);
    add_methods(p, s);
    add(p, "samples %lu, %.1f per pixel", (unsigned long)s->samples,
        (double)s->samples / s->pixels);
    if (v->main.options.arena > 0)
        add(p, "arena %lu of %lu bytes", (unsigned long)s->arena_bytes,
            (unsigned long)v->main.options.arena);
    else
        add(p, "arena %lu bytes", (unsigned long)s->arena_bytes);
    add(p, "crc32 %08lx", (unsigned long)s->crc32);
}

static void add_board(struct page *p, const struct view *v)
{
    const struct bus *bus = &v->wish.bus;
    if (v->wish.core != NULL) {
        add(p, "ESTIMATE for %s at %.4g MHz:", v->wish.core->name, v->wish.cpu_hz / 1e6);
        add(p, "  %.1f frames/s: cpu %.1f ms, bus %.1f ms", 1e6 / (v->board_us + v->wire_us),
            v->board_us / 1000.0, v->wire_us / 1000.0);
    } else if (bus->hz > 0.0) {
        add(p, "bus %.1f ms at %.4g MHz", v->wire_us / 1000.0, bus->hz / 1e6);
    }
}

/* What matters most comes first: of a small picture, figures cover half at most. */
static void add_figures(struct page *p, const struct view *v)
{
    const int rows = p->rows;
    if (!v->screen->has_text && p->rows > FEWEST_ROWS)
        p->rows = p->rows / 2 > FEWEST_ROWS ? p->rows / 2 : FEWEST_ROWS;
    add_settings(p, v);
    if (v->debug_kind != DEBUG_PICTURE)
        add(p, "seen: %s", debug_names[v->debug_kind]);
    if (debug_legends[v->debug_kind] != NULL)
        add(p, "  %s", debug_legends[v->debug_kind]);
    if (v->has_error)
        add(p, "error: rmse %.2f ssim %.4f flip %.4f", v->error.rmse, v->error.ssim, v->error.flip);
    add_board(p, v);
    add_time(p, v);
    add_stages(p, v);
    add_counts(p, v);
    add(p, "%s", v->screen->what);
    p->rows = rows;
}

/* ------------------------------------------------------------------ help */

static int control_count(void)
{
    int count = 0;
    while (control_list[count].keys != NULL)
        count++;
    return count;
}

/* Columns of text side by side, and lines in each. */
static void help_grid(int columns, int rows, int *across, int *down)
{
    *across = columns / HELP_COLUMN > 1 ? columns / HELP_COLUMN : 1;
    *down = rows > 2 ? rows - 1 : 1;
}

int overlay_help_pages(int columns, int rows)
{
    int across, down;
    help_grid(columns, rows, &across, &down);
    return (control_count() + across * down - 1) / (across * down);
}

static void add_help(struct page *p, int page)
{
    int across, down, count = control_count();
    help_grid(p->columns, p->rows, &across, &down);
    int pages = overlay_help_pages(p->columns, p->rows);
    int first = (page - 1) * across * down;
    int here = count - first < across * down ? count - first : across * down;
    int lines = (here + across - 1) / across;
    for (int row = 0; row < lines; row++) {
        char line[TEXT_COLUMNS + 1] = "";
        for (int column = 0; column < across; column++) {
            int i = first + column * lines + row;
            if (column * lines + row >= here)
                break;
            size_t used = strlen(line);
            snprintf(line + used, sizeof line - used, "%-*s%-*s", HELP_KEYS, control_list[i].keys,
                     HELP_COLUMN - HELP_KEYS, control_list[i].what);
        }
        add(p, "%s", line);
    }
    if (pages > 1)
        add(p, "page %d of %d: ? goes on, escape closes", page, pages);
}

/* Bytes of the line that text begins with: up to a blank, where there is one. */
static int line_length(const char *text, int columns)
{
    int length = (int)strlen(text), end = columns;
    if (length <= columns)
        return length;
    while (end > 0 && text[end] != ' ')
        end--;
    return end > 0 ? end : columns;
}

/* In as many lines as it takes, over the last ones where there is no room. */
static void add_message(struct page *p, const char *text)
{
    int lines = 0, length;
    if (p->columns < 1)
        return;
    for (const char *t = text; *t != '\0'; t += length + (t[length] == ' '), lines++)
        length = line_length(t, p->columns);
    if (p->text->rows > p->rows - lines)
        p->text->rows = p->rows > lines ? p->rows - lines : 0;
    for (const char *t = text; *t != '\0'; t += length + (t[length] == ' ')) {
        length = line_length(t, p->columns);
        add(p, "%.*s", length, t);
    }
}

void overlay_text(const struct view *v, int columns, int rows, struct text *out)
{
    struct page page = { out, columns < TEXT_COLUMNS ? columns : TEXT_COLUMNS, rows };
    *out = (struct text){ .rows = 0 };
    if (v->help_page > 0)
        add_help(&page, v->help_page);
    else if (v->has_overlay)
        add_figures(&page, v);
    if (v->message[0] != '\0' && clock_us() < v->message_until_us)
        add_message(&page, v->message);
}

/* ------------------------------------------------------------------ letters on surfaces */

static int letter_zoom(const struct surface *s)
{
    int zoom = s->width / 640;
    return zoom > 1 ? zoom : 1;
}

void overlay_room(const struct surface *s, int *columns, int *rows)
{
    int zoom = letter_zoom(s);
    *columns = (s->width - 2 * MARGIN) / (FONT_WIDTH * zoom);
    *rows = (s->height - 2 * MARGIN) / (FONT_HEIGHT * zoom);
}

void overlay_draw(const struct surface *s, const struct text *text)
{
    int zoom = letter_zoom(s);
    for (int i = 0; i < text->rows; i++)
        font_draw(s, MARGIN, MARGIN + i * FONT_HEIGHT * zoom, zoom, text->line[i]);
}
