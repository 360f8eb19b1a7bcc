/* SPDX-License-Identifier: MIT */
/* xform.h - points and affine transforms in double precision, passed by value; and a number held within bounds. */
#ifndef SMEAR_TOOLS_SCENES_XFORM_H
#define SMEAR_TOOLS_SCENES_XFORM_H

#include <math.h>

struct vec3 {
    double x, y, z;
};

/* Column major, columns are the images of the axes and the origin; the last row is 0 0 0 1. */
struct xform {
    double m[16];
};

static inline double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

static inline struct vec3 vec3(double x, double y, double z)
{
    return (struct vec3){x, y, z};
}

static inline struct vec3 vec3_add(struct vec3 a, struct vec3 b)
{
    return vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline struct vec3 vec3_sub(struct vec3 a, struct vec3 b)
{
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline struct vec3 vec3_scale(struct vec3 a, double s)
{
    return vec3(a.x * s, a.y * s, a.z * s);
}

static inline double vec3_dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct vec3 vec3_cross(struct vec3 a, struct vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double vec3_length(struct vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

/* Of length one; the null vector stays null. */
static inline struct vec3 vec3_unit(struct vec3 a)
{
    double length = vec3_length(a);
    return length > 0 ? vec3_scale(a, 1 / length) : a;
}

static inline struct xform xform_identity(void)
{
    return (struct xform){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

/* First b, then a. */
static inline struct xform xform_mul(struct xform a, struct xform b)
{
    struct xform r;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a.m[k * 4 + row] * b.m[column * 4 + k];
            r.m[column * 4 + row] = sum;
        }
    return r;
}

static inline struct xform xform_move(double x, double y, double z)
{
    return (struct xform){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1}};
}

static inline struct xform xform_scale(double x, double y, double z)
{
    return (struct xform){{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}};
}

/* Turns by radians, counter-clockwise seen from the axis' tip. */
static inline struct xform xform_turn_x(double angle)
{
    double c = cos(angle), s = sin(angle);
    return (struct xform){{1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, 0, 0, 1}};
}

static inline struct xform xform_turn_y(double angle)
{
    double c = cos(angle), s = sin(angle);
    return (struct xform){{c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1}};
}

static inline struct xform xform_turn_z(double angle)
{
    double c = cos(angle), s = sin(angle);
    return (struct xform){{c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

/* The axes x, y, z and the origin. */
static inline struct xform xform_axes(struct vec3 x, struct vec3 y, struct vec3 z, struct vec3 o)
{
    return (struct xform){{x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, o.x, o.y, o.z, 1}};
}

static inline struct vec3 xform_point(struct xform a, struct vec3 p)
{
    return vec3(a.m[0] * p.x + a.m[4] * p.y + a.m[8] * p.z + a.m[12],
                a.m[1] * p.x + a.m[5] * p.y + a.m[9] * p.z + a.m[13],
                a.m[2] * p.x + a.m[6] * p.y + a.m[10] * p.z + a.m[14]);
}

static inline struct vec3 xform_direction(struct xform a, struct vec3 d)
{
    return vec3(a.m[0] * d.x + a.m[4] * d.y + a.m[8] * d.z,
                a.m[1] * d.x + a.m[5] * d.y + a.m[9] * d.z,
                a.m[2] * d.x + a.m[6] * d.y + a.m[10] * d.z);
}

/* Normals go with the cofactors, so that they stay upright under uneven scale. Not of length
 * one. */
static inline struct vec3 xform_normal(struct xform a, struct vec3 n)
{
    struct vec3 x = vec3(a.m[0], a.m[1], a.m[2]), y = vec3(a.m[4], a.m[5], a.m[6]);
    struct vec3 z = vec3(a.m[8], a.m[9], a.m[10]);
    return vec3_add(vec3_add(vec3_scale(vec3_cross(y, z), n.x), vec3_scale(vec3_cross(z, x), n.y)),
                    vec3_scale(vec3_cross(x, y), n.z));
}

/* Camera to world: at `eye`, its -z towards `look`, its y as near to `up` as can be. When up is
 * along the view, the world's -z is up instead. eye and look must differ. */
static inline struct xform xform_look(struct vec3 eye, struct vec3 look, struct vec3 up)
{
    struct vec3 z = vec3_unit(vec3_sub(eye, look));
    struct vec3 x = vec3_cross(up, z);
    if (vec3_length(x) < 1e-9 * vec3_length(up))
        x = vec3_cross(vec3(0, 0, -1), z);
    x = vec3_unit(x);
    return xform_axes(x, vec3_cross(z, x), z, eye);
}

#endif
