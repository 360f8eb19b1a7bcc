/* SPDX-License-Identifier: MIT */
/* math.h - what the browser's processor has, as instructions; the rest in math.c. */
#ifndef SMEAR_WEB_MATH_H
#define SMEAR_WEB_MATH_H

#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
#define HUGE_VAL __builtin_inf()
#define isfinite(x) __builtin_isfinite(x)
#define isnan(x) __builtin_isnan(x)
#define isinf(x) __builtin_isinf(x)
#define signbit(x) __builtin_signbit(x)

#define fabs __builtin_fabs
#define fabsf __builtin_fabsf
#define floor __builtin_floor
#define floorf __builtin_floorf
#define ceil __builtin_ceil
#define ceilf __builtin_ceilf
#define trunc __builtin_trunc
#define rint __builtin_rint
#define sqrt __builtin_sqrt
#define sqrtf __builtin_sqrtf
#define copysign __builtin_copysign

static inline double fmin(double a, double b)
{
    return a < b || b != b ? a : b;
}

static inline double fmax(double a, double b)
{
    return a > b || b != b ? a : b;
}

double sin(double x);
double cos(double x);
double tan(double x);
double atan(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double pow(double x, double y);
float powf(float x, float y);
double fmod(double x, double y);
double remainder(double x, double y);
double frexp(double x, int *exponent);
double ldexp(double x, int exponent);
int ilogb(double x);
long lround(double x);
long long llround(double x);

#endif
