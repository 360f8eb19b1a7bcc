/* SPDX-License-Identifier: MIT */
/* demo_bake.h - light of what stands still, found when the demo is made. */
#ifndef SMEAR_DEMO_BAKE_H
#define SMEAR_DEMO_BAKE_H

#include <smear.h>
#include <stdbool.h>

enum { BAKE_FACES = 256, BAKE_TEXELS = 1024 };

/* A mesh and its material, in the default light. */
struct demo_baked {
    smear_mesh mesh;
    smear_material material;
    smear_texture texture;
    uint8_t face_color[4 * BAKE_FACES];
    uint32_t texel[BAKE_TEXELS];
};

/* Makes a draw unlit whose pose turns nothing: the colours of its faces, or its texels, become those that the library would find
 * in each frame. Normals, where there are some, are alike throughout a face; with texels, throughout the mesh, which has no
 * colours then. False where it cannot be done. */
bool demo_bake(struct demo_baked *out, smear_draw *draw);

#endif
