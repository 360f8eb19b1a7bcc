/* SPDX-License-Identifier: MIT */
/* failures.h - what the tests of the failure catalogue share: rows, methods, pictures and the
 * measures taken on them.
 *
 * A row is a known failure of motion blur: a small scene (tools/scenes/failures.c), one or more
 * numbers that tell how badly it fails, smaller is better, and for each number the bar below which
 * it has not failed. Unless a row says otherwise the shutter is open for the whole frame, centred,
 * light is linear, the library is given the poses at shutter open, now and at shutter close, and
 * the truth is the mean of 256 exact instants drawn by the reference renderer in double precision.
 * Host only. */
#ifndef SMEAR_TESTS_FAILURES_H
#define SMEAR_TESTS_FAILURES_H

#include "tests/context_rig.h"
#include "tests/ref/accuracy.h"

#include "tools/scenes/failures.h"

#include <stdbool.h>
#include <stdint.h>

/* ------------------------------------------------------------------ methods and rows */

/* The columns, in the order of fail_method. */
enum { NONE, ACCUMULATE, PLAIN, MENDED, SUBFRAMES, TIMEMASK, AUTO, FINE, CAMERA, PINGPONG, HALF_SIZE, JIMENEZ, OBJECT, LAYERED, METHODS };

#define ONLY(method) (1u << (method))
#define FILTERS (ONLY(PLAIN) | ONLY(MENDED))
#define REACHING (FILTERS | ONLY(CAMERA) | ONLY(PINGPONG) | ONLY(HALF_SIZE) | ONLY(JIMENEZ))
#define NOBODY (1u << 31)

struct fail_method {
    const char *name;
    smear_method method;
    int samples, flags, target;
    smear_weights weights;
    bool spread;
};

extern const struct fail_method fail_method[METHODS];

/* Reach and tile of the filters: 5 % of 240 rows. The smaller frames here would get less. */
enum { FAIL_REACH = 12, FAIL_TILE = 16 };

struct fail_measure {
    const char *what, *unit;
    double bar;                 /* at most: passes */
    double known[METHODS];      /* at most: fails as it is known to; 0: must pass */
    unsigned only;              /* methods it is taken of, ONLY(...) or-ed; 0: all */
    const char *otherwise;      /* why it is not taken of the others */
    bool hard;                  /* SMEAR_AUTO has no known failure here when it is asked for SMEAR_FINE */
};

enum { FAIL_MEASURES = 3 };

struct fail_row {
    int number;                 /* in the catalogue; 0: beyond it */
    const char *name;
    /* Writes a number for each measure; stays without one (NAN) where a step failed. */
    void (*take)(const struct fail_method *method, double number[FAIL_MEASURES]);
    struct fail_measure measure[FAIL_MEASURES];
    const char *note;           /* what the table should say about it; or null */
};

/* At most what a method is known to fail measure `measure` of a row with; 0: must pass. */
double fail_known(const struct fail_row *row, int measure, int method);

extern const struct fail_row fail_picture_rows[], fail_time_rows[], fail_other_rows[];
extern const int fail_picture_count, fail_time_count, fail_other_count;

/* ------------------------------------------------------------------ pictures */

/* Whole frame, centred, linear light, poses of the shutter. */
struct present_options fail_options(const struct subject *s, const struct fail_method *method);

/* One picture, 3 bytes per pixel, freed by the caller; null after a failed check. Of the subject at
 * its time, width x height (0: the subject's). */
uint8_t *fail_take(struct subject *s, const struct present_options *present, int width, int height);

/* The sharp picture of the same instant. */
uint8_t *fail_sharp(struct subject *s, const struct present_options *present);

/* The same as fail_take with everything, camera included, moved by `offset` units of the library's
 * world. */
uint8_t *fail_take_away(struct subject *s, const struct present_options *present,
                        const int offset[3]);

/* Of a flat scene, so many pixels to the right and down of where it was. */
uint8_t *fail_take_aside(struct subject *s, const struct present_options *present, int x, int y);

/* What a filter reads. Free with shot_free. */
bool fail_look(struct subject *s, const struct present_options *present, struct shot *out);

enum { FAIL_INSTANTS = 256 };

/* Frames in turn through one context, used as firmware uses it: draws have ids, the library keeps
 * their poses. */
struct reel {
    struct subject subject;
    struct rig rig;
    uint8_t *rgb;               /* 3 per pixel, of the last frame */
};

bool reel_open(struct reel *reel, const char *scene);
void reel_close(struct reel *reel);

/* Draws the frame so many frames after the one that stands for the scene. */
bool reel_frame(struct reel *reel, const struct fail_method *method, double frame);

/* ------------------------------------------------------------------ measures */

/* Pixels [x0, x1) x [y0, y1). */
struct area {
    int x0, y0, x1, y1;
};

struct area fail_whole(const struct subject *s);

/* Around the middle of the frame, in its pixels, +y down. */
struct area fail_around(const struct subject *s, int x, int y, int half_width, int half_height);

double fail_rmse(const struct subject *s, const uint8_t *rgb, const struct ref_truth *truth,
                 struct area area);

/* Largest difference in codes, of pictures or from the truth. */
int fail_difference(const struct subject *s, const uint8_t *a, const uint8_t *b, struct area area);
double fail_error(const struct subject *s, const uint8_t *rgb, const struct ref_truth *truth,
                  struct area area);

/* How much of colour `fore` over `back` (0xRRGGBB) each pixel of the area shows, 0 to 1 in linear
 * light; `encoded` counts codes. Row after row. */
void fail_alpha(const struct subject *s, const uint8_t *rgb, struct area area, uint32_t fore,
                uint32_t back, bool encoded, double *alpha);
void fail_alpha_truth(const struct ref_truth *truth, struct area area, uint32_t fore,
                      uint32_t back, bool encoded, double *alpha);

/* The mean of each column. */
void fail_columns(const double *alpha, struct area area, double *column);

/* Length of a streak: where it rises above and falls below half of its peak. */
double fail_half_length(const double *column, int count);

/* Sums of absolute second differences along both axes, of those that lie on borders of tiles and of
 * those that do not, where the truth is not flat. */
struct seams {
    double border, inside;
    int64_t border_count, inside_count;
};

void fail_seams(const struct subject *s, const uint8_t *rgb, const struct ref_truth *truth,
                struct area area, struct seams *of_rgb, struct seams *of_truth);
double fail_seam_ratio(const struct seams *of_rgb, const struct seams *of_truth);

/* Place of a pixel's centre: pixels from the middle of the frame, +y up. */
static inline double fail_x(const struct subject *s, int x)
{
    return x + 0.5 - s->width / 2.0;
}

static inline double fail_y(const struct subject *s, int y)
{
    return s->height / 2.0 - y - 0.5;
}

#endif
