/* SPDX-License-Identifier: MIT */
/* debug.h - what else there is to see of a frame than its picture. */
#ifndef SMEAR_TOOLS_VIEW_DEBUG_H
#define SMEAR_TOOLS_VIEW_DEBUG_H

#include "tools/player/planes.h"
#include "tools/view/lane.h"

#include <stdint.h>

enum debug_kind {
    DEBUG_PICTURE,
    DEBUG_VELOCITY,             /* colour: direction; brightness: length */
    DEBUG_DEPTH,
    DEBUG_TILES,                /* how what each tile shows moves */
    DEBUG_METHODS,              /* what each tile got */
    DEBUG_SAMPLES,              /* and how many samples per pixel: brightness, by powers of two */
    DEBUG_BANDS,                /* what is handed to the display at once */
    DEBUG_KINDS
};

extern const char *const debug_names[];         /* null ends them */
extern const char *const debug_legends[];       /* what colours mean; or null */

struct debug {
    struct planes planes;
    int width, height;          /* of the planes; 0: not open */
};

void debug_close(struct debug *debug);

/* Turns the lane's picture (codes, without gaps) of the frame it has just drawn into another. */
bool debug_draw(struct debug *debug, enum debug_kind kind, const struct lane *lane,
                struct presenter *presenter, const struct instant *instant, uint32_t *picture,
                struct failure *f);

#endif
