/* SPDX-License-Identifier: MIT */
/* lane_spans.h - rows of a triangle as kernels for AVX2 take them. */
#ifndef SMEAR_LANE_SPANS_H
#define SMEAR_LANE_SPANS_H

#include "kernels/texel_rows.h"
#include "raster/texture_rows.h"

#if SMEAR_AVX2
static inline struct texel_plane plane_from(const struct plane *p, int32_t y)
{
    return (struct texel_plane){ plane_at(p, 0, y), p->dx, p->dy };
}

/* Whether spans_of_rows() finds all spans: rows lie in one slope of the depth code, and velocities are not written. */
static inline bool rows_are_plain(const struct setup *s) { return s->slope != SLOPE_BOTH && !s->writes_velocity; }

/* All rows of plain ones, from pixel 0 of the first of which depth codes are z. */
static inline void spans_of_sides(struct texel_spans *spans, const struct span_side *side, int32_t rows,
                                  const struct smear_raster_target *t, uint32_t z, uint32_t dz, uint32_t down)
{
    const int32_t x0 = t->x0, x1 = t->x1;
    int32_t i = 0;
    for (int32_t row = 0; row < rows; row++, z += down) {
        const int32_t left = side[row].left, right = side[row].right;
        spans->row[i] = row;
        spans->left[i] = left;
        spans->right[i] = right;
        spans->a[i] = max_i32(left, x0);
        spans->b[i] = min_i32(right, x1);
        spans->z[i] = z;
        spans->dz[i] = dz;
        i += spans->a[i] < spans->b[i];
    }
    spans->count = i;
}

static inline void spans_of_rows(struct texel_spans *spans, const struct setup *s, const struct span_rows *r)
{
    spans_of_sides(spans, r->side, r->count, s->target, code_from_units(plane_at(&s->depth, 0, r->y), s->slope),
                   (uint32_t)step_from_units(s->depth.dx, s->slope), (uint32_t)step_from_units(s->depth.dy, s->slope));
}

/* Adds a run of a row; there is room. */
static inline void spans_add(struct texel_spans *spans, const struct span_rows *r, int32_t row, const struct row_run *p)
{
    const int32_t i = spans->count++;
    spans->row[i] = row;
    spans->left[i] = r->side[row].left;
    spans->right[i] = r->side[row].right;
    spans->a[i] = p->a;
    spans->b[i] = p->b;
    spans->z[i] = p->z;
    spans->dz[i] = p->dz;
}
#endif

#endif
