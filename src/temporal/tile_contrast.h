/* SPDX-License-Identifier: MIT */
/* tile_contrast.h - what is drawn along the paths of a run of tiles, as its first instant shows it.
 *
 * An edge of contrast c that passes a pixel is there at one of N instants or at the next: the mean is off by up to c / 2N
 * to either side, its square by c^2 / 12 N^2. How many pixels an edge passes is how far it goes. So a block's squared
 * error comes of squared differences of pixels that lie behind one another on their path, times its length. */
#ifndef SMEAR_TILE_CONTRAST_H
#define SMEAR_TILE_CONTRAST_H

#include "temporal/row_blocks.h"
#include "temporal/subframe_tile.h"

struct smear_tile_plan;

/* Blocks of which gaps are closed for up to so many instants are summed together: class (instants + 1) / 2. */
enum { CLOSING_CLASSES = (BLOCK_INSTANTS_MAX + 1) / 2 + 1 };

/* Squared differences times lengths, in codes^2 px, summed over red, green and blue, and over the blocks of a run: those
 * that gaps leave, what closed gaps leave of them, and the parts of that, as in struct smear_closing. */
struct smear_contrast {
    uint32_t blocks; /* of the run */
    uint32_t moving; /* pixels that move, of four */
    uint32_t plain[CLOSING_CLASSES], closed[CLOSING_CLASSES], rounded[CLOSING_CLASSES], floor[CLOSING_CLASSES];
    uint32_t unseen; /* the same of what passes at other times, about */
    int32_t last; /* the most instants for which gaps are closed in one */
    uint32_t changed; /* and by more than that, as instants show */
};

/* Adds a triangle with a path that may be seen in the tiles to f->passing; opaque ones in their order. */
void smear_note_passing(struct subframes *f, uint32_t triangle, bool blended);

/* Adds to f->changes by how much the work planes show something else than at the last instant that was noted, unless this is the
 * first one. */
void smear_note_changes(const struct subframes *f, bool is_first);

/* Adds to what is unseen those changes that the middle of the exposure does not tell, after all instants but that one. */
void smear_add_changes(struct smear_contrast *contrast, const struct subframes *f, const struct subframe_changes *changes);

/* Measures the run in the work planes, where its first instant was drawn within the box, and notes for each block up to
 * how many instants gaps are closed. */
void smear_tile_contrast(struct smear_contrast *contrast, const struct subframes *f, const struct smear_tile_plan *plan,
                         const struct subframe_box *box);

#endif
