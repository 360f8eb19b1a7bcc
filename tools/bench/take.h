/* SPDX-License-Identifier: MIT */
/* take.h - one frame of a built-in scene, drawn by the library under stated settings. Everything
 * that the bench measures is a take.
 *
 * Converting the scene is set-up and is not measured. What is: smear_begin, every smear_submit and
 * smear_render with its clears and the conversion to the display's format, to a flush that does
 * nothing. */
#ifndef SMEAR_BENCH_TAKE_H
#define SMEAR_BENCH_TAKE_H

#include "tools/failure.h"
#include "tools/image/image.h"
#include "tools/scenes/present.h"
#include "tools/scenes/scene.h"

#include <smear.h>
#include <stdbool.h>

struct take {
    const char *scene;          /* of the catalog, or a model's file below the folder of models */
    const char *clip;           /* of a model; null: its first */
    int frame;                  /* at the scene's rate; -1: the frame that stands for the scene */
    double later;               /* frames after that */
    int width, height;          /* 0: the scene's */
    bool windowed;              /* room for SMEAR_RECONSTRUCT, whatever the method is */
    bool plain;                 /* SMEAR_OBJECT as two cameras do it */
    int band_rows;              /* of sharp contexts; 0: a tile, as with a window */
    smear_format format;
    bool dithered;              /* as a display gets it by default */
    bool plain_context;         /* tile, strip and vertex cache are the library's defaults */
    smear_method method;
    int samples;                /* 0: the library's default */
    int reconstruct;            /* SMEAR_FENCE | ... */
    int target;                 /* of SMEAR_AUTO */
    int reach;                  /* px; 0: the library's default */
    smear_filter_kind filter;        /* as in struct present_options */
    int camera_step;
    smear_pingpong pingpong;
    smear_weights weights;
    bool shutter_poses;
    bool linear;                /* light; else encoded */
    bool instant_only;          /* no other poses: nothing moves */
    bool texels_565;            /* textures as RGB565 */
    int workers;                /* 0: one */
};

/* A take that is ready to be drawn, any number of times. */
struct rig {
    struct take take;
    struct scene scene;
    struct model model;         /* of a scene from a file */
    bool is_file;
    struct presenter *presenter;
    const struct presented *frame;
    struct crew *crew;          /* of more workers than one */
    smear_context *ctx;
    void *memory;
    smear_stats stats;          /* of the last time it was drawn */
    uint8_t *display;           /* where flush copies to, rows without padding; null: nowhere */
};

enum { CLEAR_OF_SCENE = -1, TAKE_SHUTTER_DEGREES = 180 };

/* Whether a take's scene is a file. */
bool take_is_file(const char *scene);

/* Whether it can be drawn here: a model's file is looked for in the folder that SMEAR_ASSETS of the environment names. */
bool take_is_there(const char *scene);

/* The whole frame as one band: the height in rows of 8. */
int take_whole(int height);

/* On failure nothing is left to free. The shutter is open for 180 degrees and centred. */
bool rig_open(struct rig *rig, const struct take *take, struct failure *f);
void rig_close(struct rig *rig);

/* Goes on to another frame, or any instant, of the same scene with the same settings. */
bool rig_seek(struct rig *rig, int frame, struct failure *f);
bool rig_seek_time(struct rig *rig, double seconds, struct failure *f);

/* Draws. The work that is measured is in bench_frame and nowhere else: the counter looks for its name. */
bool rig_draw(struct rig *rig, struct failure *f);

/* Draws into a picture of 8-bit codes, on a colour 0xRRGGBB or CLEAR_OF_SCENE. *out is allocated here, and empty on failure. */
bool rig_picture(struct rig *rig, int32_t clear, struct image *out, struct failure *f);

/* ------------------------------------------------------------------ groups */

/* Every take has a number in a group, so that this program and its copy under callgrind speak of the same one. */

/* False when the group or the number does not exist. */
bool group_take(const char *group, int index, struct take *out);

/* Each group's own file. */
bool peers_take(int index, struct take *out);

#endif
