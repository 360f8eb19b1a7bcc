/* SPDX-License-Identifier: MIT */
/* matrix.h - the few 4x4 matrices that poses need: column major, double, columns act on column
 * vectors. */
#ifndef SMEAR_TOOLS_MATRIX_H
#define SMEAR_TOOLS_MATRIX_H

#include <string.h>

static inline void matrix_identity(double out[16])
{
    memset(out, 0, 16 * sizeof *out);
    out[0] = out[5] = out[10] = out[15] = 1;
}

/* out = a b, first b then a; out may be neither. */
static inline void matrix_multiply(double out[16], const double a[16], const double b[16])
{
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
    }
}

/* Translation x rotation x scale; the quaternion x y z w has length 1. */
static inline void matrix_from_trs(double out[16], const double t[3], const double q[4],
                                   const double s[3])
{
    double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rotation[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)
    };
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            out[4 * column + row] = rotation[3 * column + row] * s[column];
        out[4 * column + 3] = 0;
    }
    out[12] = t[0];
    out[13] = t[1];
    out[14] = t[2];
    out[15] = 1;
}

static inline void matrix_point(double out[3], const double m[16], const float p[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = m[row] * (double)p[0] + m[4 + row] * (double)p[1] + m[8 + row] * (double)p[2] +
                   m[12 + row];
}

#endif
