/* SPDX-License-Identifier: MIT */
/* assemble.h - from a draw to the triangles of the frame: transform, cull, clip, shade, bin. */
#ifndef SMEAR_ASSEMBLE_H
#define SMEAR_ASSEMBLE_H

#include "geometry.h"
#include "light.h"
#include "transform.h"

/* A transformed vertex, remembered under its index: direct mapped. */
struct smear_cached_vertex {
    uint32_t tag;                   /* draw serial << 16 | vertex index */
    uint32_t stored;                /* its record in the pool: word + 1, or 0 */
    struct smear_homogeneous now;
    struct smear_screen screen;
    int32_t outcode;
};

struct smear_assembler {
    struct smear_viewport viewport;
    struct smear_geometry *geometry;
    struct smear_cached_vertex *cache;
    uint32_t cache_mask;
    uint32_t serial;                /* of the draw within the context's life; tags of older draws never match */
    bool keep_motion;               /* the method reads velocities */
    uint32_t triangles_drawn, triangles_dropped;
};

/* One draw with everything that does not change from triangle to triangle. */
struct smear_assembly {
    const smear_mesh *mesh;
    const smear_material *material;     /* never null */
    uint16_t draw;                      /* its index, for the raster */
    uint8_t moves;                      /* as smear_segment.moves */
    bool mirrored;                      /* negative determinant: the winding flips */
    struct smear_projection now, pose[2];
    const int16_t *position, *pose_position[2];
    int extra_count;                    /* further terms of the sum that is the present place: instants */
    struct smear_projection extra[2];   /* between poses of a mesh that deforms (smear_projection_weigh) */
    const int16_t *extra_position[2];
    struct smear_shading shading;
};

/* Before the draws of a frame, or of a part of it. */
void smear_assembler_reset(struct smear_assembler *a);

/* Adds the draw's triangles to the geometry. Returns false when the store is full: what was added stays, and the
 * caller draws the frame in parts. With `drop`, triangles that find no room are counted and left out instead. */
bool smear_assemble(struct smear_assembler *a, const struct smear_assembly *draw, bool drop);

#endif
