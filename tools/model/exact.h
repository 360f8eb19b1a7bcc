/* SPDX-License-Identifier: MIT */
/* exact.h - the functions of the maths library that clips and a conversion need, from sums, products, quotients
 * and square roots alone: IEEE 754 gives those the same bits on every host, and so to frames and files. */
#ifndef SMEAR_TOOLS_EXACT_H
#define SMEAR_TOOLS_EXACT_H

#include <stdint.h>

/* For |x| up to 2 pi, error below 1e-14. */
double exact_sin(double x);
double exact_cos(double x);

/* Of 0 to 1/sqrt(2): 0 to pi / 4. */
double exact_asin(double s);

/* The shorter way from a to b, both of length 1; `t` of -1 to 2. Comes out with length 1. */
void exact_slerp(double out[4], const double a[4], const double b[4], double t);

/* Length 1; (0, 0, 0, 1) instead of no direction. */
void exact_normalize4(double q[4]);

/* Linear 0..1 to the nearest sRGB code, and to the nearest of 0..255. */
uint8_t exact_srgb_encode(double linear);
uint8_t exact_byte(double x);

/* The code nearest to linear light of 0..65535. */
uint8_t exact_srgb_code(uint32_t linear);

/* log2 of the smallest power of two that is not below x > 0. */
int exact_exponent(double x);

#endif
