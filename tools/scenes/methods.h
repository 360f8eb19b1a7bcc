/* SPDX-License-Identifier: MIT */
/* methods.h - the list of methods: what the command line and its help, the viewer, the page and tests know of each. */
#ifndef SMEAR_TOOLS_METHODS_H
#define SMEAR_TOOLS_METHODS_H

#include <smear.h>
#include <stdbool.h>
#include <stdint.h>

struct method {
    const char *name;           /* on the command line */
    smear_method method;
    const char *help;           /* of the command line, lines with \n between them */
    uint32_t tile_color;        /* of a tile that got it, in the viewer, 0xRRGGBB; auto's tiles get other methods */
    const char *label, *hint;   /* on the page */
    uint8_t samples[3];         /* there: of qualities draft, balanced, fine; 0: there are none to choose. Of
                                 * sketch they are those of draft */
    const char *curve, *color;  /* in the page's chart */
};

/* In the order in which they are shown and cycled through. */
extern const struct method method_list[];
extern const int method_count;

/* Null when there is none. */
const struct method *method_named(const char *name);
const struct method *method_of(smear_method method);

/* Whether frame.edges may be smooth. */
static inline bool method_smooths_edges(smear_method method)
{
    return method == SMEAR_AUTO || method == SMEAR_SUBFRAMES;
}

/* Whether a display may keep what it is sent. */
static inline bool method_keeps_display(smear_method method)
{
    return method == SMEAR_NONE || smear_method_is_temporal(method);
}

/* "NAME, NAME or NAME" of all, in a text that stays. */
const char *method_names(void);

#endif
