/* SPDX-License-Identifier: MIT */
/* accuracy.h - what the tests of accuracy share: subjects to draw, pictures the library has drawn
 * of them with all that lies under the picture, and tables of figures.
 *
 * Used by test_accuracy.c (rasterizer on scenes and model files, accumulation), test_blur.c (filters) and others. Host only. */
#ifndef SMEAR_TESTS_ACCURACY_H
#define SMEAR_TESTS_ACCURACY_H

#include "tools/ref/ref.h"

#include "tools/model/model.h"
#include "tools/scenes/present.h"

#include <stdbool.h>
#include <stdint.h>

/* ------------------------------------------------------------------ subjects */

/* A built-in scene or a model file, ready to be handed to the library. */
struct subject {
    char name[80];              /* "suite/pan", or the file's name without its folders */
    int width, height;          /* as the scene wants it; may be changed before use */
    double time, fps;           /* the frame that stands for it */
    bool is_file;
    struct model model;         /* of a file */
    struct scene scene;
    struct presenter *presenter;
};

/* A built-in name. A failed check ends the test; on success, free with subject_close. */
bool subject_open(struct subject *s, const char *name);
/* A file, first clip (looped, in its middle), first camera or the automatic one. */
bool subject_open_file(struct subject *s, const char *path, int width, int height);
void subject_close(struct subject *s);

/* From now on the camera circles the middle between its planes, about the vertical: everything
 * moves. At the subject's time it is where it was. False when out of memory: the subject is as
 * before. */
bool subject_circle(struct subject *s, double radians_per_second);

/* From now on nothing moves: every instant is that of the subject's time. */
bool subject_hold(struct subject *s);

/* The kinds of the suite: 12 with moving objects, 7 with a moving camera, and `still`. */
enum { OBJECT_KINDS = 12, CAMERA_KINDS = 7, SUITE_KINDS = OBJECT_KINDS + CAMERA_KINDS + 1 };
extern const char *const suite_kind[SUITE_KINDS];

enum { TRIAL_KINDS = 9 };
extern const char *const trial_kind[TRIAL_KINDS];

/* Folder of model files: the environment's SMEAR_ASSETS, else the one beside the repository; null
 * when there is none. */
const char *asset_folder(void);

/* Paths of all model files in it, sorted; the list ends with null. Null when out of memory or
 * unreadable. */
char **asset_list(const char *folder);
void asset_list_free(char **list);

/* ------------------------------------------------------------------ pictures */

struct shot_options {
    int width, height;          /* 0: the subject's */
    int reach, tile;            /* 0: the library's choice */
    int workers;                /* 0: one */
    int triangles;              /* room for as many; 0: for all */
    bool scatter;               /* the reach may exceed the tile */
    bool look;                  /* keep what lies under the picture, too */
};

/* What the library drew. `rgb` is what was flushed; the planes below it (`look`, SMEAR_RECONSTRUCT)
 * are what the filter read. */
struct shot {
    int width, height;
    uint8_t *rgb;               /* 3 per pixel */
    uint8_t *sharp;             /* 3 per pixel, before the blur */
    uint16_t *depth;            /* codes */
    float *distance;            /* scene units along the view; INFINITY: background */
    float *velocity;            /* 2 per pixel, px per frame */
    int16_t *packed;            /* 2 per pixel, half exposure in 1/8 px, as the window keeps it */
    bool orthographic;
    double near_plane, far_plane;       /* as the library got them */
    smear_stats stats;
};

/* Draws the subject at its time; or what was made of that. */
bool shot_take(struct subject *s, const struct present_options *present, const struct shot_options *options, struct shot *out);
bool shot_draw(struct subject *s, const struct presented *presented, const struct shot_options *options, struct shot *out);
void shot_free(struct shot *shot);

/* Options that hold for a subject: its rate and clear colour, half a frame open. */
struct present_options subject_options(const struct subject *s);

/* The same frame by the reference: `present` decides on light and on the poses that velocities are
 * measured between. */
bool reference_take(struct subject *s, const struct present_options *present, int width, int height,
                    struct ref_frame *out);

/* Root mean square difference in codes; the truth is not rounded. */
double rmse_to_truth(const uint8_t *rgb, const struct ref_truth *truth);
/* Largest difference of two pictures, and in how many pixels they differ. */
int picture_difference(const uint8_t *a, const uint8_t *b, int pixels, int *differing);

/* The exposure of `present` by the reference, cached for the run: the same question is answered
 * once. Null on failure. Freed by truth_forget. */
const struct ref_truth *truth_of(struct subject *s, const struct present_options *present,
                                 int instants);
void truth_forget(void);

/* ------------------------------------------------------------------ figures */

/* printf to where tests print. */
void say(const char *format, ...);

/* A check with its figures: prints file, line, subject and both numbers when `got` is above `bar`
 * or not a number. */
bool check_bar(double got, double bar, const char *subject, const char *what, const char *file,
               int line);
#define CHECK_BAR(got, bar, subject) \
    check_bar((got), (bar), (subject), #got, __FILE__, __LINE__)

/* Seconds of processor time since the start of the process. */
double cpu_seconds(void);

/* True when the environment asks for the long version of every test (SMEAR_THOROUGH=1). */
bool is_thorough(void);

#endif
