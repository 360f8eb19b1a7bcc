/* SPDX-License-Identifier: MIT */
/* texture_rows.h - rows of a triangle that are drawn together. */
#ifndef SMEAR_TEXTURE_ROWS_H
#define SMEAR_TEXTURE_ROWS_H

#include "raster/span.h"

#include "kernels/kernels.h"

/* Whole spans of rows one below the other, from row y on. */
enum { SPAN_ROWS = 32 };

struct span_rows {
    int32_t y, count;
    bool cut;                   /* the triangle may reach beyond the target's columns,
                                 * where there is more of the frame */
    int32_t at;                 /* index of column 0 of the first row in the
                                 * planes: colour and depth lie alike */
    struct span_side side[SPAN_ROWS];
};

/* Finds what draws rows at once. Null where there is no such loop for a triangle. */
smear_rows_fn *smear_rows_choose(const struct setup *s);

/* Interpolated colours without a texture, opaque: color_rows.c. */
smear_rows_fn smear_rows_shade;

/* Of a triangle whose texture's sizes are powers of two, repeated, texels nearest and opaque: shaded_rows.c. */
smear_rows_fn *smear_shaded_rows_choose(const struct setup *s);

/* Whole rows lie in the target and in one slope of the depth code, and have no velocities. */
static inline bool rows_are_whole(const struct setup *s, const struct span_rows *r)
{
    return s->slope != SLOPE_BOTH && !s->writes_velocity && !r->cut;
}

/* Pixels [a, b) of a row, and depth codes 16.16 from pixel 0 on. */
struct row_run {
    int32_t a, b;
    uint32_t z, dz;
};

/* Finds the next run of a row after pixel a: within the target's columns and one slope of the depth
 * code. False when there is none. Writes its velocities. */
bool smear_row_run_next(struct row_run *p, const struct setup *s, const struct span_rows *r, int32_t row,
                        int32_t a);

#endif
