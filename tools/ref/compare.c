/* SPDX-License-Identifier: MIT */
/* ref_compare.c - how far a picture is from the reference, edges told apart from interiors. */
#include "tools/ref/ref.h"

#include <math.h>
#include <string.h>

static size_t pixel(const struct ref_frame *frame, int x, int y)
{
    return (size_t)y * (size_t)frame->width + (size_t)x;
}

/* True when `plane` has one value in the 3x3 around a pixel, as far as it lies in the frame. */
static bool is_alike(const struct ref_frame *frame, const int32_t *plane, int x, int y)
{
    int32_t here = plane[pixel(frame, x, y)];
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < frame->height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < frame->width; u++)
            if (plane[pixel(frame, u, v)] != here)
                return false;
    return true;
}

bool ref_is_edge(const struct ref_frame *frame, int x, int y)
{
    return !is_alike(frame, frame->triangle, x, y);
}

/* Which triangle the other picture shows; where it gives no ids, the reference's own if there is
 * any. */
static int32_t other_triangle(const struct ref_frame *frame, const struct ref_planes *planes,
                              size_t at)
{
    if (planes->id_rgb != NULL)
        return ref_id_from_rgb(planes->id_rgb + 3 * at);
    if (planes->depth == NULL)
        return frame->triangle[at];
    if (isinf(planes->depth[at]))
        return -1;
    return frame->triangle[at] >= 0 ? frame->triangle[at] : 0;
}

static void note_max(double value, double *max, int x, int y, int *max_x, int *max_y)
{
    if (value > *max || *max_x < 0) {
        *max = value;
        *max_x = x;
        *max_y = y;
    }
}

static void compare_depth(const struct ref_frame *frame, const struct ref_planes *planes, int x,
                          int y, struct ref_difference *out)
{
    size_t at = pixel(frame, x, y);
    double want = frame->depth[at], error = fabs((double)planes->depth[at] - want) / want;
    note_max(isnan(error) ? INFINITY : error, &out->depth_max, x, y, &out->depth_x, &out->depth_y);
}

static void compare_velocity(const struct ref_frame *frame, const struct ref_planes *planes, int x,
                             int y, struct ref_difference *out)
{
    size_t at = pixel(frame, x, y);
    double error[2];
    for (size_t i = 0; i < 2; i++) {
        if (isnan(frame->velocity[2 * at + i]))
            return;
        error[i] = (double)planes->velocity[2 * at + i] - frame->velocity[2 * at + i];
    }
    double length = sqrt(error[0] * error[0] + error[1] * error[1]);
    out->velocity_pixels++;
    out->velocity_rms += length * length;       /* the sum, until the end */
    note_max(isnan(length) ? INFINITY : length, &out->velocity_max, x, y, &out->velocity_x,
             &out->velocity_y);
}

static void compare_color(const struct ref_frame *frame, const struct ref_planes *planes, int x,
                          int y, struct ref_difference *out)
{
    size_t at = pixel(frame, x, y);
    for (size_t i = 0; i < 3; i++) {
        double value = frame->color[3 * at + i];
        double code = 255.0 * (frame->encoded ? value : ref_srgb_encode(value));
        double error = fabs(planes->rgb[3 * at + i] - code);
        out->color_rms += error * error;        /* the sum, until the end */
        note_max(error, &out->color_max, x, y, &out->color_x, &out->color_y);
    }
}

void ref_compare(const struct ref_frame *frame, const struct ref_planes *planes,
                 struct ref_difference *out)
{
    int colored = 0;
    memset(out, 0, sizeof *out);
    out->off_edge_x = out->off_edge_y = out->depth_x = out->depth_y = -1;
    out->velocity_x = out->velocity_y = out->color_x = out->color_y = -1;
    if (planes->width != frame->width || planes->height != frame->height) {
        out->pixels = out->coverage = out->triangle = out->off_edge = frame->width * frame->height;
        out->depth_max = out->velocity_rms = out->velocity_max = INFINITY;
        out->color_rms = out->color_max = INFINITY;
        return;
    }
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            size_t at = pixel(frame, x, y);
            int32_t want = frame->triangle[at], got = other_triangle(frame, planes, at);
            out->pixels++;
            if (got != want) {
                out->triangle++;
                out->coverage += (got < 0) != (want < 0);
                if (!ref_is_edge(frame, x, y) && out->off_edge++ == 0) {
                    out->off_edge_x = x;
                    out->off_edge_y = y;
                }
                continue;
            }
            if (planes->rgb != NULL) {
                colored++;
                compare_color(frame, planes, x, y, out);
            }
            if (want < 0)
                continue;
            out->same++;
            if (planes->depth != NULL)
                compare_depth(frame, planes, x, y, out);
            if (planes->velocity != NULL && is_alike(frame, frame->draw, x, y))
                compare_velocity(frame, planes, x, y, out);
        }
    }
    if (out->velocity_pixels > 0)
        out->velocity_rms = sqrt(out->velocity_rms / out->velocity_pixels);
    if (colored > 0)
        out->color_rms = sqrt(out->color_rms / (3.0 * colored));
}
