/* SPDX-License-Identifier: MIT */
/* view.h - everything `smear view` holds, and the order of its parts. Start reading in viewer.c.
 *
 *     viewer.c    time, events, drawing, showing: the loop
 *     control.c   what keys and the pointer do
 *     overlay.c   what is written over the picture
 *     debug.c     what else can be seen of a frame than its picture
 *     film.c      screenshots, and the comparison with the truth
 *     script.c    input in files
 *     golden.c    CRCs, printed or checked
 *     lane.c      a scene drawn with one set of options, as `render` does it
 *     panel.c     the device's pixels on a surface
 *     screen*.c   windows, terminals, framebuffers */
#ifndef SMEAR_TOOLS_VIEW_VIEW_H
#define SMEAR_TOOLS_VIEW_VIEW_H

#include "tools/view/board.h"
#include "tools/view/cost.h"
#include "tools/view/debug.h"
#include "tools/view/golden.h"
#include "tools/view/lane.h"
#include "tools/view/orbit.h"
#include "tools/view/panel.h"
#include "tools/view/screen.h"
#include "tools/view/script.h"

#include <stdbool.h>
#include <stdint.h>

enum { VIEW_OUTPUTS = 4 };
enum { VIEW_UNITS = 64 };           /* of time per frame: time runs in 64ths of frames */

/* How time goes on from picture to picture. */
enum pace {
    PACE_TIME,                      /* as the clock does: frames that come too late are left out */
    PACE_EVERY,                     /* every frame */
    PACE_BOARD                      /* as many frames as the board would need for one */
};

/* The command line of view alone. */
struct view_options {
    const char *out;                /* back end; null: what is there */
    const char *board;
    struct panel_look look;
    struct bus bus;
    const struct cost_core *core;   /* null: no estimate */
    double cpu_hz;
    enum pace pace;
    long first, frames;             /* frames 0: until the user ends it */
    double spin;                    /* radians per second of a turntable to begin with; 0: none */
    bool crc, update, times, paused, no_shared_memory, figures;
    int colors;
    const char *check, *record, *play;
    struct apart_output output[VIEW_OUTPUTS];   /* where it writes */
    bool has_split;
    smear_method split;             /* method of the left part of a split screen */
    enum debug_kind debug;
};

/* Sums over all pictures, for --times. */
struct view_times {
    long pictures;
    double draw_us, compose_us, event_us;
    double *draw, *transfer;        /* of each of the first pictures, for medians */
    int count;
    long frames;                    /* drawn, for the means of the estimates */
    double board_us, wire_us;
};

struct view {
    struct view_options wish;
    struct source *source;          /* its scene points into it */
    struct orbit orbit;
    struct presenter *presenter;
    struct lane main, left;         /* left: the other half of a split screen */
    struct render_options good;     /* of the main lane, when it last drew a frame */
    struct render_options good_left;
    bool is_split;
    int divider;                    /* thousandths of the panel's width */
    smear_method blurred;           /* what `b` goes back to */
    smear_edges edges;              /* where settings allow smooth ones */

    int64_t at;                     /* 64ths of frames */
    int frames_apart;               /* frames from the picture before */
    int speed;                      /* 64ths of frames per frame of the clock */
    bool is_paused, is_dirty, quits;
    long tick;                      /* pictures shown so far */
    double next_us;                 /* when the next one is due */
    const char *trouble;            /* what ended the loop: a file, a screen; or null */
    struct failure why;

    struct screen *screen;
    char screen_what[sizeof ((struct screen *)0)->what];        /* when it was closed */
    struct panel_look look;
    struct panel_place place;
    /* codes of the panel: as shown, of the whole frame, and of the frame before */
    uint32_t *picture, *whole, *before;
    int width, height;              /* of them */
    uint32_t *panel;                /* v->picture as a doubled panel shows it */
    int panel_width, panel_height;
    struct debug debug;
    enum debug_kind debug_kind;
    bool has_overlay, has_error, told_dropped;
    int help_page;                  /* 0: no help */
    struct image_distance error;    /* of the frame shown, when has_error */
    double board_us, wire_us;       /* estimates for the frame shown */
    double shown_fps, last_shown_us;
    char message[TEXT_COLUMNS + 1];
    double message_until_us;

    struct golden golden;
    struct script script;
    struct view_times times;
};

/* Shows `source` until the user or --frames ends it. Returns a status. */
int view_run(struct view *view, const struct render_options *options);

/* Opens the scene again, perhaps with another clip or camera; on failure the old one stays, and the
 * user is told. */
bool view_load(struct view *view, const struct source_view *seen);

/* A line for the user, for a few seconds. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void view_say(struct view *view, const char *format, ...);

/* Says why nothing is seen on the picture that has been drawn, or most of it is turned away, if that is so. */
void view_notice(struct view *view);

/* Of long work: shows what stands, and a line that says what is done. */
void view_busy(struct view *view, const char *what);

/* The instant of a position in time. */
struct instant view_instant(const struct view *view, int64_t at);
double view_fps(const struct view *view);

#endif
