/* SPDX-License-Identifier: MIT */
/* chart_panel.h - one plane of error against cost, both on logarithmic scales, with the
 * frontier. */
#ifndef SMEAR_BENCH_CHART_PANEL_H
#define SMEAR_BENCH_CHART_PANEL_H

#include "tools/bench/chart.h"
#include "tools/bench/labels.h"
#include "tools/bench/svg.h"

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

/* Gives some panels one scale, which shows all of their points. */
void chart_panel_fit(struct panel *panel, int panels);

bool chart_panel_draw(struct svg *svg, const struct panel *panel, struct failure *f);

#endif
