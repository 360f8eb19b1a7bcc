/* SPDX-License-Identifier: MIT */
/* demo_weld.h - vertices that are alike, made one when the demo is made: each is transformed once. */
#ifndef SMEAR_DEMO_WELD_H
#define SMEAR_DEMO_WELD_H

#include <smear.h>
#include <stdbool.h>

enum { WELD_VERTICES = 512, WELD_TRIANGLES = 512 };

/* A mesh with arrays of its own for what it has of each vertex. */
struct demo_welded {
    smear_mesh mesh;
    int16_t position[3 * WELD_VERTICES], uv[2 * WELD_VERTICES];
    int8_t normal[3 * WELD_VERTICES];
    uint8_t color[4 * WELD_VERTICES];
    uint16_t index[3 * WELD_TRIANGLES];
};

/* Gives a draw, which does not deform and whose indices are all of vertices that it has, a mesh that
 * looks the same. False where it is too large. */
bool demo_weld(struct demo_welded *out, smear_draw *draw);

#endif
