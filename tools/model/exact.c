/* SPDX-License-Identifier: MIT */
/* exact.c - see exact.h. */
#include "tools/model/exact.h"

#include "base/tables.h"

#include <math.h>
#include <string.h>

double exact_sin(double x)
{
    const double pi = 3.14159265358979323846;
    double sign = 1;
    if (x < 0) {
        x = -x;
        sign = -1;
    }
    while (x > pi) {
        x -= pi;
        sign = -sign;
    }
    if (x > pi / 2)
        x = pi - x;
    double term = x, sum = x;
    for (int i = 3; i < 24; i += 2) {
        term = -term * x * x / (i * (i - 1.0));
        sum += term;
    }
    return sign * sum;
}

double exact_cos(double x)
{
    return exact_sin((x < 0 ? -x : x) + 3.14159265358979323846 / 2);
}

double exact_asin(double s)
{
    double x = s;
    for (int i = 0; i < 8; i++)
        x -= (exact_sin(x) - s) / exact_cos(x);
    return x;
}

void exact_normalize4(double q[4])
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0)) {
        q[0] = q[1] = q[2] = 0;
        q[3] = length = 1;
    }
    for (int i = 0; i < 4; i++)
        q[i] /= length;
}

void exact_slerp(double out[4], const double a[4], const double b[4], double t)
{
    double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    double sign = dot < 0 ? -1 : 1, chord = 0;
    for (int i = 0; i < 4; i++)
        chord += (a[i] - sign * b[i]) * (a[i] - sign * b[i]);
    double angle = 2 * exact_asin(sqrt(chord) / 2), from = 1 - t, to = t;
    if (angle > 1e-9) {
        from = exact_sin((1 - t) * angle) / exact_sin(angle);
        to = exact_sin(t * angle) / exact_sin(angle);
    }
    for (int i = 0; i < 4; i++)
        out[i] = from * a[i] + sign * to * b[i];
    exact_normalize4(out);
}

uint8_t exact_byte(double x)
{
    if (!(x > 0))
        return 0;
    return x >= 1 ? 255 : (uint8_t)floor(x * 255.0 + 0.5);
}

/* ((code + 1/2) / 255 + 0.055) / 1.055 to the power of 12/5: the
 * square times the fifth root of the square. */
static double threshold_above(int code)
{
    double x = (code + 0.5) / 255.0;
    if (x <= 0.04045)
        return x / 12.92;
    double y = (x + 0.055) / 1.055, square = y * y, root = 1;
    for (int i = 0; i < 40; i++) {
        double r4 = root * root * root * root;
        root = (4 * root + square / r4) / 5;
    }
    return square * root;
}

uint8_t exact_srgb_encode(double linear)
{
    static double threshold[255];
    int low = 0, high = 255;
    if (threshold[0] == 0)
        for (int i = 0; i < 255; i++)
            threshold[i] = threshold_above(i);
    while (low < high) {                /* the first code whose threshold is above */
        int middle = (low + high) / 2;
        if (linear >= threshold[middle])
            low = middle + 1;
        else
            high = middle;
    }
    return (uint8_t)low;
}

uint8_t exact_srgb_code(uint32_t linear)
{
    int low = 0, high = 255;
    while (low < high) {
        int middle = (low + high) / 2;
        if (2 * linear >= (uint32_t)smear_srgb_decode[middle] + smear_srgb_decode[middle + 1])
            low = middle + 1;
        else
            high = middle;
    }
    return (uint8_t)low;
}

int exact_exponent(double x)
{
    int exponent;
    return frexp(x, &exponent) == 0.5 ? exponent - 1 : exponent;
}
