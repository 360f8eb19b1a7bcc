/* SPDX-License-Identifier: MIT */
/* present_surface.h - surfaces in the library's formats. The first half of present.c's work: what
 * does not depend on the frame. See present.h for the rules. */
#ifndef SMEAR_TOOLS_PRESENT_SURFACE_H
#define SMEAR_TOOLS_PRESENT_SURFACE_H

#include "tools/failure.h"
#include "tools/scenes/scene.h"

#include <smear.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct bounds {
    double min[3], max[3];          /* min > max: empty */
};

/* Where int16 positions lie: object = (position + offset) x step + fold. */
struct grid {
    double step;
    double fold[3];                 /* goes into the transform where offset has no room for it */
    int32_t offset[3];
};

/* A mesh of at most 65535 vertices. */
struct part {
    int vertex_count, triangle_count;
    uint32_t *source;               /* the surface's vertex of each of ours */
    int16_t *position;
    int8_t *normal;
    int16_t *uv;
    uint8_t *color;
    uint8_t *face_color;
    uint16_t *index;
    int first_triangle;             /* of the surface: parts take its triangles in order */
    int uv_shift;
    int16_t bounds[6];              /* smear_mesh.bounds of `position` */
};

struct converted {
    const struct scene_surface *surface;
    struct bounds bounds;           /* at rest, object units */
    struct grid grid;               /* at rest */
    smear_material material;
    bool invisible;                 /* its material lets nothing through */
    int part_count;
    struct part *part;
};

/* Textures in use, each converted once. */
struct texture_store {
    int count, room;
    struct stored_texture **texture;
    bool narrow;                    /* those without alpha become RGB565 */
};

extern const struct bounds empty_bounds;
void add_bounds(struct bounds *b, const struct bounds *other);
/* False where a coordinate is not a finite number. */
bool add_positions(struct bounds *b, const float *position, int count);

struct grid grid_over(const struct bounds *b);

/* The mesh's scale for a step: mantissa in [2^29, 2^30] and shift, step = scale / 2^shift. The
 * mantissa is rounded up, so that bounds never grow beyond the range. */
void split_step(double step, int32_t *scale, int *shift);

void quantise_positions(int16_t *out, const float *position, const struct part *part,
                        const struct grid *grid);
void quantise_normals(int8_t *out, const float *normal, const struct part *part);

/* Converts c->surface; c->bounds and c->grid are set. What was converted before a failure is freed
 * by converted_free as well. */
bool convert_surface(struct converted *c, struct texture_store *store, struct failure *f);
void converted_free(struct converted *c);
void texture_store_free(struct texture_store *store);

/* Room for `want` elements; doubles, so that growing one by one stays cheap. New room is zeroed. */
bool grow(void **array, int *room, int want, size_t size, struct failure *f);
bool out_of_memory(struct failure *f);

uint8_t present_byte(double x);     /* 0..1 to 0..255, rounded to nearest */

#endif
