/* SPDX-License-Identifier: MIT */
/* raster_poses.h - triangles of a segment at an instant, eight at once. */
#ifndef SMEAR_RASTER_POSES_H
#define SMEAR_RASTER_POSES_H

#include "kernels/flat_face.h"
#include "raster/raster.h"

#if SMEAR_AVX2

/* How triangles of a segment are drawn eight at once. */
struct raster_eights {
    const struct smear_raster_frame *frame;
    const struct smear_raster_target *target;
    const struct smear_segment *segment;
    struct tiny8_look look;
    struct flat_area area;          /* where those of one colour are drawn; without pixels where they are not by flat_face */
    bool has_look;
    bool suits;                     /* all but tiny ones are made ready eight at once */
    bool flat;                      /* and drawn by flat_face */
};

void smear_raster_eights_make(struct raster_eights *r, const struct smear_raster_frame *frame,
                              const struct smear_raster_target *target, const struct smear_segment *segment);

/* Draws triangles that are seen, in order, as smear_raster_triangle does. */
void smear_raster_poses(const struct raster_eights *r, const uint32_t color[8], struct poses *poses);
#endif

#endif
