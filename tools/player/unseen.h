/* SPDX-License-Identifier: MIT */
/* unseen.h - pictures on which nothing is drawn although the scene has triangles: that they say why. */
#ifndef SMEAR_TOOLS_CLI_UNSEEN_H
#define SMEAR_TOOLS_CLI_UNSEEN_H

#include "tools/player/device.h"
#include "tools/scenes/scene.h"

/* Over all frames of a command. Begins zeroed. */
struct unseen {
    long frames, empty, first;          /* looked at; on which nothing is seen; the first of those */
    char why[400];                      /* nothing is seen on that one */
    bool is_inside_out;                 /* most of what was nearest in the first frame is backs */
};

/* A frame that has been drawn. */
struct unseen_frame {
    struct scene *scene;
    struct presenter *presenter;
    const struct present_options *options;
    double time;
    long number;
    int width, height;                  /* it was drawn with */
    const struct image *picture;
    bool is_covered;                    /* some triangle covered a pixel, or may have: something was kept from a frame before */
    bool has_sides;                     /* the scene's format says which faces are seen from both sides */
};

/* Looks at a frame. May pose the scene and ask the presenter for another frame: what it gave before is gone then. False where
 * that fails. */
bool unseen_look(struct unseen *unseen, const struct unseen_frame *frame, struct failure *f);

/* The warning, one line; false: there is none. */
bool unseen_tell(const struct unseen *unseen, char *text, size_t size);

#endif
