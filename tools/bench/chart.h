/* SPDX-License-Identifier: MIT */
/* chart.h - speed against accuracy: every setting of every method on every scene of the suite.
 *
 *     chart_settings.c   what is measured, one line per setting
 *     chart_measure.c    measures it
 *     chart_csv.c        chart.csv, written and read
 *     chart_means.c      means over groups of scenes; which points lie on the frontier
 *     chart_bars.c       the bars, met or missed
 *     chart_tables.c     tables for the terminal
 *     chart_plot.c       pictures, made of panels (svg.c draws, and finds room for labels)
 *     chart_command.c    options and progress
 *
 *     chart_peer.c       what another rasterizer needs for some of the scenes
 *
 * Cost is instructions per frame, relative to the sharp frame (`none`) of the same scene under the
 * same condition: one thread, nothing kept between frames. Error is measured against 1024 exact
 * instants (truth.h) in the same light; flicker is the RMS of E(t + 1/8 frame) - E(t), where
 * E = picture - truth. Shutter 180 degrees, centred, 320x240.
 *
 * Under the first condition a frame is what a program gets that says nothing: linear light, the poses
 * of this frame and of two before it, RGB565 with ordered dither, tiles and caches of the library's own
 * choice. Its errors are those of 8 bits per channel, as the display's steps add the same to every
 * method. Under the second one, that of the study, poses are exact and light is encoded. */
#ifndef SMEAR_BENCH_CHART_H
#define SMEAR_BENCH_CHART_H

#include "tools/bench/count.h"
#include "tools/bench/take.h"
#include "tools/failure.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* ------------------------------------------------------------------ kinds of scenes */

/* The 20 scenes of the suite, frames of the demo and real models, and the groups their figures are averaged in. */

/* Things move before a still camera; the camera or what is behind a still foreground moves; nothing
 * does; whole frames of the demo; models from files. */
enum kind_group { GROUP_OBJECT, GROUP_CAMERA, GROUP_STILL, GROUP_DEMO, GROUP_MODEL, GROUPS };

/* The suite comes first. */
enum { KINDS = 20, ALL_KINDS = KINDS + 7 };

struct kind {
    const char *scene;          /* "suite/pan", or a model's file below the folder of models */
    const char *name;           /* "pan" */
    enum kind_group group;
    int frame;                  /* -1: the one that stands for the scene */
    const char *clip;           /* of a model */
};

extern const struct kind kinds[ALL_KINDS];
extern const char *const kind_group_name[GROUPS];

/* -1 when there is none. */
int kind_find(const char *name);

/* ------------------------------------------------------------------ what is measured */

/* Those for everywhere, those that pictures show as well, all. */
enum chart_share { SHARE_FEW, SHARE_SHOWN, SHARE_ALL };

struct chart_condition {
    const char *light, *poses;  /* as options of the command line */
    bool linear, previous;
    bool display;               /* cost is that of a display's dithered format, in a context by default */
    enum chart_share share;     /* of the settings that are measured */
    const char *what;
};

/* As users get it; as in studies, where the bars are; and what light alone changes. */
enum { CHART_CONDITIONS = 3, CHART_DEFAULT = 0, CHART_MAIN = 1 };
extern const struct chart_condition chart_conditions[CHART_CONDITIONS];

/* Settings of one method that differ in one number are joined by a line. */
enum chart_mark { MARK_CIRCLE, MARK_SQUARE, MARK_TRIANGLE, MARK_DIAMOND, MARK_CROSS, MARK_STAR };

struct chart_curve {
    const char *name;           /* as a stranger should read it */
    const char *method;         /* where there is little room */
    const char *plain;          /* to one who knows no methods; null: such a picture leaves it out */
    const char *color;
    enum chart_mark mark;
    bool bold;
};

extern const struct chart_curve chart_curves[];
extern const int chart_curve_count;

struct chart_setting {
    int curve;                  /* index, see chart_settings.c */
    const char *name;           /* starts with the method's name */
    const char *label;          /* beside its mark; null: small, and shown of bold curves alone */
    smear_method method;
    int samples, reconstruct, target;
    bool everywhere;            /* under all conditions */
    smear_filter_kind filter;        /* as in smear_frame */
    smear_weights weights;
    bool spread;
    bool plain;                 /* SMEAR_OBJECT as two cameras do it */
};

enum { CHART_MAX_SETTINGS = 64 };
extern const struct chart_setting chart_settings[];
extern const int chart_setting_count;
extern const int chart_none;    /* the setting that cost is relative to */

/* Whether pictures have a mark for it; tables have all. */
bool chart_is_shown(int setting);

/* Whether the picture of the README has one: what `auto` is told by name, and what an application can do itself. */
bool chart_is_plain(int setting);

/* -1 when there is none. */
int chart_find_setting(const char *name);
int chart_find_condition(const char *light, const char *poses);

/* The number of a take in the group "chart", and the other way round. */
int chart_index(int condition, int kind, int setting);
bool chart_take(int index, struct take *out);

/* The same, in the format whose errors are measured. */
bool chart_error_take(int index, struct take *out);

/* ------------------------------------------------------------------ what came out */

struct chart_value {
    bool known;
    double pixels, instructions;
    double rmse, flip, ssim;    /* against the truth rounded to 8 bits, as `smear compare` says */
    double rmse_mean;           /* against the truth as it is */
    double flicker;             /* likewise, codes */
    double ms, cpu_ms;          /* on the wall, and of the processor; 0: not measured */
    uint32_t crc;               /* of the picture */
    double arena;               /* bytes of the context */
};

struct chart {
    struct chart_value value[CHART_CONDITIONS][ALL_KINDS][CHART_MAX_SETTINGS];
};

/* ------------------------------------------------------------------ measuring */

struct chart_choice {
    bool condition[CHART_CONDITIONS], kind[ALL_KINDS], setting[CHART_MAX_SETTINGS];
};

/* Measured under its conditions, and chosen. */
bool chart_is_wanted(const struct chart_choice *choice, int condition, int kind, int setting);

struct chart_measuring {
    struct counter counter;
    const char *folder;         /* of truths */
    int jobs;                   /* processes at a time */
    bool time;                  /* the clock on the wall, too */
    /* Called after each scene, never twice at once; false ends the run. */
    bool (*progress)(void *user, int done, int all, const char *what, struct failure *f);
    void *user;
};

/* Fills in what is chosen and not known yet. */
bool chart_measure(struct chart *chart, const struct chart_choice *choice,
                   const struct chart_measuring *how, struct failure *f);

/* ------------------------------------------------------------------ files */

/* `program` is a number that stands for the program that measured. With it, reading skips lines of
 * other programs and what it does not understand, and a file that is not there is empty. */
bool chart_write_csv(const struct chart *chart, const struct chart_choice *choice,
                     uint32_t program, const char *path, struct failure *f);
bool chart_read_csv(struct chart *chart, const uint32_t *program, const char *path,
                    struct failure *f);

/* ------------------------------------------------------------------ means and frontiers */

/* Scenes over which means are taken: of the suite those with moving objects, those with a moving
 * camera, and both; of the demo; of the demo and of models; those that a peer has drawn, too. Geometric;
 * errors below 0.01 count as 0.01. */
enum chart_set { SET_OBJECT, SET_CAMERA, SET_MOVING, SET_DEMO, SET_FIELD, SET_PEER, SET_STILL, CHART_SETS };

struct chart_mean {
    bool known;                 /* on every scene of the set */
    int scenes;
    double cost, rmse, rmse_mean, flicker;
    double instructions;        /* millions */
    double cpu;                 /* relative to `none`; 0: not measured */
};

bool chart_set_has(enum chart_set set, int kind);
struct chart_mean chart_mean_of(const struct chart *chart, int condition, enum chart_set set,
                                int setting);

/* Relative to `none`; 0 when either is not known. */
double chart_cost(const struct chart *chart, int condition, int kind, int setting);
double chart_time(const struct chart *chart, int condition, int kind, int setting);
double chart_cpu(const struct chart *chart, int condition, int kind, int setting);

/* ------------------------------------------------------------------ a peer */

/* TGX (github.com/vindar/tgx), rendering in floating point, with the means of N of its frames. */
enum { PEER_SHARP, PEER_4, PEER_8, PEER_16, PEER_SETTINGS };

struct chart_peer {
    const char *kind;           /* of the table of kinds */
    double instructions[PEER_SETTINGS];             /* millions */
    double rmse[PEER_SETTINGS]; /* codes */
};

enum { PEER_FRAMES = 6 };
extern const struct chart_peer chart_peer[PEER_FRAMES];
extern const char *const chart_peer_name[PEER_SETTINGS];

/* Null where it has not drawn the scene. */
const struct chart_peer *chart_peer_of(int kind);

/* Means over the frames of a set that the peer has drawn: what it needs in parts of our sharp frame,
 * and its error. False where there are none, or ours are not known. */
bool chart_peer_mean(const struct chart *chart, int condition, enum chart_set set, int setting, double *cost,
                     double *rmse);

/* A point of a plane of cost and error; `setting` is its setting. */
struct chart_point {
    int setting;
    double cost, error;
    bool on_frontier;           /* none is as cheap and as good, and better in one of both */
};

void chart_mark_frontier(struct chart_point *point, int count);

/* All that is known of one scene, or of the means of a set; returns how many. */
int chart_points_of_kind(const struct chart *chart, int condition, int kind,
                         struct chart_point out[CHART_MAX_SETTINGS]);
int chart_points_of_set(const struct chart *chart, int condition, enum chart_set set,
                        struct chart_point out[CHART_MAX_SETTINGS]);

/* ------------------------------------------------------------------ reports */

struct chart_verdict {
    int met, missed, unknown;
};

void chart_print_means(FILE *out, const struct chart *chart, int condition);
/* Instructions per pixel of the sharp frame, on all scenes together. */
void chart_print_none(FILE *out, const struct chart *chart, int condition);
void chart_print_scene(FILE *out, const struct chart *chart, int condition, int kind);
/* `all`: with those that were not measured. */
void chart_print_bars(FILE *out, const struct chart *chart, bool all, struct chart_verdict *verdict);

/* marks.svg: what is plain, in two planes. chart.svg: four planes of means as users get it. One for which nothing is known is left
 * out. */
bool chart_write_pictures(const struct chart *chart, const char *folder, struct failure *f);

/* The command `chart`, arguments behind its name. */
int chart_command(const char *program, int count, char **text);

#endif
