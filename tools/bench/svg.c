/* SPDX-License-Identifier: MIT */
/* svg.c - writes SVG into memory, then into a file. */
#include "tools/bench/svg.h"

#include "tools/image/image.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static void put_escaped(FILE *out, const char *text)
{
    for (; *text != '\0'; text++) {
        if (*text == '&')
            fputs("&amp;", out);
        else if (*text == '<')
            fputs("&lt;", out);
        else if (*text == '>')
            fputs("&gt;", out);
        else
            fputc(*text, out);
    }
}

/* Ends the path or text that is being written, if there is one. */
static void end_element(struct svg *svg)
{
    if (svg->style[0] != '\0')
        fprintf(svg->out, svg->is_text ? "</text>\n" : "\"%s/>\n", svg->style);
    svg->style[0] = '\0';
}

/* Whether what comes next, of this style, begins an element; else it is added to the one that is being written. */
static bool begins(struct svg *svg, bool is_text, const char *style)
{
    if (svg->is_text == is_text && strcmp(svg->style, style) == 0)
        return false;
    end_element(svg);
    svg->is_text = is_text;
    snprintf(svg->style, sizeof svg->style, "%s", style);
    return true;
}

bool svg_begin(struct svg *svg, int width, int height, const char *title, struct failure *f)
{
    *svg = (struct svg){ .out = NULL };
    svg->out = open_memstream(&svg->text, &svg->size);
    if (svg->out == NULL)
        return fail(f, "out of memory");
    fprintf(svg->out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
            "viewBox=\"0 0 %d %d\" role=\"img\" font-family=\"Helvetica, Arial, 'Liberation "
            "Sans', sans-serif\">\n<title>", width, height, width, height);
    put_escaped(svg->out, title);
    fprintf(svg->out, "</title>\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", width,
            height);
    return true;
}

bool svg_end(struct svg *svg, const char *path, struct failure *f)
{
    end_element(svg);
    fprintf(svg->out, "</svg>\n");
    bool ok = fclose(svg->out) == 0 || fail(f, "out of memory");
    ok = ok && file_write(path, (const uint8_t *)svg->text, svg->size, f);
    free(svg->text);
    return ok;
}

/* ------------------------------------------------------------------ lines */

static void put_path(struct svg *svg, const char *style, const double *x, const double *y, int count, bool closed)
{
    fputs(begins(svg, false, style) ? "<path d=\"" : "", svg->out);
    for (int i = 0; i < count; i++)
        fprintf(svg->out, "%c%.1f,%.1f", i == 0 ? 'M' : i == 1 ? 'L' : ' ', x[i], y[i]);
    fputs(closed ? "Z" : "", svg->out);
}

void svg_line(struct svg *svg, double x0, double y0, double x1, double y1, struct svg_style style)
{
    const double x[] = { x0, x1 }, y[] = { y0, y1 };
    svg_polyline(svg, x, y, 2, style);
}

void svg_polyline(struct svg *svg, const double *x, const double *y, int count, struct svg_style style)
{
    char text[sizeof svg->style], dash[40] = "", opacity[40] = "";
    if (style.dash != NULL)
        snprintf(dash, sizeof dash, " stroke-dasharray=\"%s\"", style.dash);
    if (style.opacity > 0.0)
        snprintf(opacity, sizeof opacity, " stroke-opacity=\"%.4g\"", style.opacity);
    snprintf(text, sizeof text, " stroke-linejoin=\"round\" stroke-linecap=\"round\" fill=\"none\" stroke=\"%s\" stroke-width=\"%.4g\"%s%s",
             style.color, style.width, dash, opacity);
    put_path(svg, text, x, y, count, false);
}

void svg_area(struct svg *svg, const double *x, const double *y, int count, const char *fill)
{
    char text[sizeof svg->style];
    snprintf(text, sizeof text, " fill=\"%s\"", fill);
    put_path(svg, text, x, y, count, true);
}

void svg_rectangle(struct svg *svg, double x, double y, double width, double height,
                   const char *fill, const char *stroke)
{
    end_element(svg);
    fprintf(svg->out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" "
            "stroke=\"%s\"/>\n", x, y, width, height, fill, stroke);
}

/* ------------------------------------------------------------------ marks */

enum { MOST_CORNERS = 10 };

static const double turn = 6.283185307179586;

/* Corners on a circle; every second one of a star lies further in. */
static int corners(enum chart_mark mark, double x, double y, double size, double *px, double *py)
{
    int count = mark == MARK_TRIANGLE ? 3 : mark == MARK_STAR ? 10 : 4;
    double radius = size * (mark == MARK_TRIANGLE ? 1.25 : mark == MARK_STAR ? 1.45 : 1.3);
    double start = mark == MARK_SQUARE ? turn / 8.0 : turn / 4.0;
    for (int i = 0; i < count; i++) {
        double angle = start + turn * i / count;
        double r = mark == MARK_STAR && i % 2 == 1 ? 0.5 * radius : radius;
        px[i] = x + r * cos(angle);
        py[i] = y - r * sin(angle);
    }
    return count;
}

void svg_mark(struct svg *svg, enum chart_mark mark, double x, double y, double size,
              const char *color, bool filled)
{
    double px[MOST_CORNERS], py[MOST_CORNERS];
    const char *fill = filled ? color : "#ffffff";
    if (mark == MARK_CIRCLE) {
        end_element(svg);
        fprintf(svg->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.2f\" fill=\"%s\" stroke=\"%s\" "
                "stroke-width=\"1.6\"/>\n", x, y, size, fill, color);
        return;
    }
    int count = corners(mark == MARK_CROSS ? MARK_SQUARE : mark, x, y, size, px, py);
    if (mark == MARK_CROSS) {
        const struct svg_style style = { color, 2.4, NULL, 0.0 };
        svg_line(svg, px[0], py[0], px[2], py[2], style);
        svg_line(svg, px[1], py[1], px[3], py[3], style);
        return;
    }
    char text[sizeof svg->style];
    snprintf(text, sizeof text, " fill=\"%s\" stroke=\"%s\" stroke-width=\"1.6\" stroke-linejoin=\"round\"", fill, color);
    put_path(svg, text, px, py, count, true);
}

/* ------------------------------------------------------------------ text */

/* Thousandths of the size, from space on. */
static const unsigned short advance[95] = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584
};

double svg_text_width(struct svg_font font, const char *text)
{
    double sum = 0.0;
    for (const unsigned char *p = (const unsigned char *)text; *p != '\0'; p++) {
        if (*p >= 32 && *p < 127)
            sum += advance[*p - 32];
        else if (*p >= 192)     /* first byte of a longer character */
            sum += 584;
    }
    return sum * font.size / 1000.0 * (font.bold ? 1.08 : 1.0);
}

static void make_font(char out[SVG_STYLE], struct svg_font font, const char *anchor)
{
    snprintf(out, SVG_STYLE, " text-anchor=\"%s\" font-size=\"%.4g\" fill=\"%s\"%s%s%s", anchor, font.size,
             font.color, font.bold ? " font-weight=\"bold\"" : "", font.italic ? " font-style=\"italic\"" : "",
             font.halo ? " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"" : "");
}

void svg_text(struct svg *svg, double x, double y, enum svg_anchor anchor, struct svg_font font,
              const char *text)
{
    static const char *const anchors[] = { "start", "middle", "end" };
    char style[sizeof svg->style];
    make_font(style, font, anchors[anchor]);
    if (begins(svg, true, style))
        fprintf(svg->out, "<text%s>", style);
    fprintf(svg->out, "<tspan x=\"%.1f\" y=\"%.1f\">", x, y);
    put_escaped(svg->out, text);
    fprintf(svg->out, "</tspan>");
}

void svg_text_up(struct svg *svg, double x, double y, struct svg_font font, const char *text)
{
    char style[sizeof svg->style];
    make_font(style, font, "middle");
    end_element(svg);
    fprintf(svg->out, "<text transform=\"translate(%.1f,%.1f) rotate(-90)\"%s>", x, y, style);
    put_escaped(svg->out, text);
    fprintf(svg->out, "</text>\n");
}

/* ------------------------------------------------------------------ labels */

/* Tries places around each anchor, nearest first, one label after the other; then once more, as those placed later may have left better
 * ones. */

enum { DIRECTIONS = 16, RINGS = 10, ROUNDS = 6 };

/* Per square pixel; and for labels that touch at all. */
static const double label_weight = 4.0, outside_weight = 20.0, touch = 400.0;

static double overlap(struct box a, struct box b)
{
    double w = fmin(a.x + a.width, b.x + b.width) - fmax(a.x, b.x);
    double h = fmin(a.y + a.height, b.y + b.height) - fmax(a.y, b.y);
    return w > 0.0 && h > 0.0 ? w * h : 0.0;
}

static struct box box_of(const struct label *label)
{
    return (struct box){ label->x, label->y, label->width, label->height };
}

struct field {
    struct label *label;
    int count, placed;          /* labels below `placed` have a place */
    const struct obstacle *obstacle;
    int obstacles;
    struct box bounds;
};

static double penalty(const struct field *field, int index, struct box box)
{
    double area = box.width * box.height;
    double sum = outside_weight * (area - overlap(box, field->bounds));
    for (int i = 0; i < field->obstacles; i++)
        sum += field->obstacle[i].weight * overlap(box, field->obstacle[i].box);
    for (int i = 0; i < field->placed; i++) {
        double area_shared = i != index ? overlap(box, box_of(&field->label[i])) : 0.0;
        sum += label_weight * area_shared + (area_shared > 0.0 ? touch : 0.0);
    }
    return sum;
}

/* The box whose edge is nearest to the anchor lies in this direction, `away` from it. */
static struct box beside(const struct label *label, int anchor, int direction, double away)
{
    double angle = 6.283185307179586 * direction / DIRECTIONS;
    double c = cos(angle), s = sin(angle);
    double x = label->anchor_x[anchor] + away * c, y = label->anchor_y[anchor] + away * s;
    /* Straight to the side or up and down it is centred; in between it slides. */
    return (struct box){ x + label->width * (c - 1.0) / 2.0, y + label->height * (s - 1.0) / 2.0,
                         label->width, label->height };
}

static void place(const struct field *field, int index)
{
    struct label *label = &field->label[index];
    double best = INFINITY;
    for (int anchor = 0; anchor < label->anchors; anchor++)
        for (int ring = 0; ring < RINGS; ring++)
            for (int direction = 0; direction < DIRECTIONS; direction++) {
                double away = label->gap + 5.0 * ring;
                struct box box = beside(label, anchor, direction, away);
                double cost = penalty(field, index, box) + 3.0 * ring * ring + 0.5 * anchor
                            + (direction % 4 == 0 ? 0.0 : 2.0);
                if (cost < best) {
                    best = cost;
                    label->x = box.x;
                    label->y = box.y;
                    label->anchor = anchor;
                    label->distance = away;
                }
            }
}

void labels_place(struct label *label, int count, const struct obstacle *obstacle, int obstacles,
                  struct box bounds)
{
    struct field field = { label, count, 0, obstacle, obstacles, bounds };
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < count; i++) {
            place(&field, i);
            if (round == 0)
                field.placed = i + 1;
        }
}
