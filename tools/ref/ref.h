/* SPDX-License-Identifier: MIT */
/* ref.h - the second opinion: a renderer in double precision that shares nothing with the library
 * but its written conventions. It draws what tools/scenes/scene.h describes; tests compare the
 * library with it.
 *
 *   ref_draw      one sharp instant with depth, velocity and the triangle of every pixel
 *   ref_truth     the mean of many sharp instants over an exposure: what a blur should look like
 *   ref_id_scene  a scene in which every triangle has a colour of its own, so that any renderer's
 *                 picture tells which triangle it drew
 *   ref_compare   how far a picture is from ref_draw, edges told apart from interiors
 *
 * Conventions. World as in glTF; the camera looks along its -Z; screen origin top left, pixel
 * centres at +0.5; a pixel belongs to a triangle when its centre is inside by the top-left rule.
 * Depth is the distance along -Z. Nearer wins; within one part in 10^12 the first submitted wins. A
 * triangle is cut at znear and, when given, zfar. Normals go by the inverse transpose of the world
 * matrix. A texture without texture coordinates is left out. Colours are clamped to 0..1 at the
 * vertices, after light. */
#ifndef SMEAR_REF_H
#define SMEAR_REF_H

#include "tools/failure.h"
#include "tools/image/image.h"
#include "tools/scenes/color.h"
#include "tools/scenes/scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* sRGB transfer function; clamps its argument to 0..1. */
static inline double ref_srgb_encode(double linear) { return color_encode(fmin(fmax(linear, 0.0), 1.0)); }
static inline double ref_srgb_decode(double encoded) { return color_decode(fmin(fmax(encoded, 0.0), 1.0)); }

/* ------------------------------------------------------------------ one sharp instant */

/* Row by row from the top. */
struct ref_frame {
    int width, height;
    bool encoded;           /* what `color` holds: linear light, or sRGB-encoded working values */
    double *color;          /* 3 per pixel, 1 is white */
    double *depth;          /* distance along -Z; INFINITY: background */
    double *velocity;       /* 2 per pixel, px per frame, x right, y down; NaN where the surface
                             * point is behind the eye at `open` or `close`: off any screen */
    int32_t *triangle;      /* id of the triangle drawn, -1: background; blended ones leave none */
    int32_t *draw;          /* index of the draw it belongs to, -1: background */
};

/* The id of a triangle is a running index over all draws of the instant, hidden ones included, and
 * their triangles: it is the same at every instant. */

struct ref_options {
    int width, height;      /* 1..16384 */
    bool encoded;           /* light: products and sums on sRGB-encoded values */
    uint32_t clear;         /* 0xRRGGBB, sRGB-encoded */
    double velocity_scale;  /* times close minus open; 0 means 1. Shutter poses: 360 / degrees */
    const uint8_t *motion;  /* enum scene_motion of each draw; null: full */
    int motion_count;       /* draws beyond it are full */
};

/* Draws `now`. Velocity is the screen position at `close` minus that at `open` of the surface point
 * seen at the pixel: with poses one frame apart `open` is the instant before and `close` is `now`
 * itself. Both null: velocity is zero. A draw that is absent, hidden or of another epoch at `open`
 * or `close` has no motion of its own, only the camera's; a camera of another epoch leaves all
 * velocities zero. `out` is overwritten, not freed; it is empty on failure. Free with
 * ref_frame_free. */
bool ref_draw(const struct scene_instant *now, const struct scene_instant *open,
              const struct scene_instant *close, const struct ref_options *options,
              struct ref_frame *out, struct failure *f);
void ref_frame_free(struct ref_frame *frame);

/* ------------------------------------------------------------------ the mean of many */

enum ref_exposure { REF_CENTRED, REF_TRAILING, REF_LEADING };

struct ref_truth_options {
    int width, height;          /* 0: the scene's */
    double time;                /* seconds: the t of the frame */
    double fps;                 /* 0: the scene's */
    double shutter_degrees;     /* 0: one instant at t */
    enum ref_exposure exposure;
    int instants;               /* 1..65536, at (k + 0.5) / instants of the exposure */
    bool encoded;               /* average, and draw, encoded values */
    int threads;                /* 1 or 2; the result does not depend on it */
};

struct ref_truth {
    int width, height;
    double *code;               /* 3 per pixel, 0..255, sRGB-encoded, not rounded */
    struct image image;         /* the same rounded to nearest */
};

/* Every instant is posed, lit and drawn exactly. Uses scene->clear. `out` is empty on failure. */
bool ref_truth(struct scene *scene, const struct ref_truth_options *options, struct ref_truth *out,
               struct failure *f);
void ref_truth_free(struct ref_truth *truth);

/* ------------------------------------------------------------------ which triangle is it */

enum { REF_ID_LIMIT = 1 << 18 };        /* ids below it have a colour */

/* Six bits of id + 1 per channel, red on top, each k as code 4k + 2 (0 for k = 0): a renderer may
 * be off by one code and still be understood. Black is the background. */
void ref_id_to_rgb(int32_t id, uint8_t rgb[3]);
int32_t ref_id_from_rgb(const uint8_t rgb[3]);

/* The same scene with every triangle in its own flat, unlit colour on black; cut-outs keep their
 * holes, blended draws are hidden. `scene` must outlive `out`, which is freed with scene_free. */
bool ref_id_scene(struct scene *scene, struct scene *out, struct failure *f);

/* ------------------------------------------------------------------ how far is it */

/* Somebody else's picture of the same instant. Any plane may be null: then it is not compared. */
struct ref_planes {
    int width, height;
    const uint8_t *rgb;         /* 3 per pixel, sRGB codes */
    const float *depth;         /* INFINITY: background */
    const float *velocity;      /* 2 per pixel, px per frame */
    const uint8_t *id_rgb;      /* 3 per pixel: picture of ref_id_scene; null: ids count as equal
                                 * where both depths are finite */
};

struct ref_difference {
    int pixels;
    int coverage;               /* pixels drawn by one and background in the other */
    int triangle;               /* pixels with different triangles, coverage included */
    int off_edge;               /* those where ref_is_edge does not hold */
    int off_edge_x, off_edge_y; /* the first such pixel, or -1 */
    int same;                   /* pixels with the same triangle in both */
    double depth_max;           /* largest relative depth error where same */
    int depth_x, depth_y;
    int velocity_pixels;        /* same, with nothing but the same draw in the 3x3 */
    double velocity_rms, velocity_max;  /* px per frame, over those; length of the error vector */
    int velocity_x, velocity_y;
    double color_rms, color_max;        /* codes, per channel, over `same` and background in both */
    int color_x, color_y;
};

/* A picture of another size differs in every pixel, without limit. */
void ref_compare(const struct ref_frame *frame, const struct ref_planes *planes,
                 struct ref_difference *out);

/* True when a neighbour (3x3, inside the frame) of the pixel shows another triangle. */
bool ref_is_edge(const struct ref_frame *frame, int x, int y);

#endif
