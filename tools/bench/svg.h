/* SPDX-License-Identifier: MIT */
/* svg.h - just enough SVG for charts: lines, marks, text of known width. Lengths are in pixels,
 * y grows downwards. Text is in the reader's Helvetica or Arial; widths are those of Arial. */
#ifndef SMEAR_BENCH_SVG_H
#define SMEAR_BENCH_SVG_H

#include "tools/bench/chart.h"
#include "tools/failure.h"

#include <stdbool.h>
#include <stdio.h>

enum { SVG_STYLE = 240 };

struct svg {
    FILE *out;
    char *text;
    size_t size;
    char style[SVG_STYLE];      /* of the path or text that is being written: those of one style, one after the other, are one element */
    bool is_text;
};

/* On a white ground. `title` is for those who cannot see it. */
bool svg_begin(struct svg *svg, int width, int height, const char *title, struct failure *f);

/* Writes the file, and frees everything in any case. */
bool svg_end(struct svg *svg, const char *path, struct failure *f);

struct svg_style {
    const char *color;
    double width;
    const char *dash;           /* null: none */
    double opacity;             /* 0: 1 */
};

void svg_line(struct svg *svg, double x0, double y0, double x1, double y1, struct svg_style style);
void svg_polyline(struct svg *svg, const double *x, const double *y, int count,
                  struct svg_style style);
void svg_area(struct svg *svg, const double *x, const double *y, int count, const char *fill);
void svg_rectangle(struct svg *svg, double x, double y, double width, double height,
                   const char *fill, const char *stroke);

/* Hollow ones are white inside. `size` is about half the width. */
void svg_mark(struct svg *svg, enum chart_mark mark, double x, double y, double size,
              const char *color, bool filled);

enum svg_anchor { ANCHOR_START, ANCHOR_MIDDLE, ANCHOR_END };

struct svg_font {
    double size;
    const char *color;
    bool bold, italic;
    bool halo;                  /* a white rim, so that it can be read on lines */
};

void svg_text(struct svg *svg, double x, double y, enum svg_anchor anchor, struct svg_font font,
              const char *text);
/* Upwards, centred. */
void svg_text_up(struct svg *svg, double x, double y, struct svg_font font, const char *text);
double svg_text_width(struct svg_font font, const char *text);

/* ------------------------------------------------------------------ labels */

/* Finds room for labels beside what they belong to. */

struct box {
    double x, y, width, height;
};

enum { LABEL_ANCHORS = 32 };

struct label {
    double width, height;
    int anchors;                /* points it may stand beside; the first is the best */
    double anchor_x[LABEL_ANCHORS], anchor_y[LABEL_ANCHORS];
    double gap;                 /* to keep from the anchor */
    double x, y;                /* top left corner; set here */
    int anchor;                 /* the one it stands beside; set here */
    double distance;            /* of its nearest edge from that; set here */
};

/* Something that should not be covered. */
struct obstacle {
    struct box box;
    double weight;              /* per square pixel covered; other labels count 4 */
};

/* Places all labels within `bounds`: where they cover least and stand nearest. */
void labels_place(struct label *label, int count, const struct obstacle *obstacle, int obstacles,
                  struct box bounds);

#endif
