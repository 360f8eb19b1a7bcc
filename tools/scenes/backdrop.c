/* SPDX-License-Identifier: MIT */
/* backdrop.c - see backdrop.h. */
#include "tools/scenes/backdrop.h"

#include <math.h>

/* Vertices lie at these steps from the middle: the picture's upper edge is at PICTURE, the surface goes on beyond it, and it is as
 * wide as pictures of any aspect up to WIDTHS are. */
enum { PICTURE = 2048, BEYOND = 2560, WIDTHS = 12 };

/* What fixed point leaves room for, in world units. */
#define FARTHEST 32000.0

/* Rows but the first and the last, which lie outside of the picture, share its height evenly. Colours between two rows are mixed by
 * the library, in linear light by default; many rows make codes run evenly down the picture. */
static void fill_rows(struct backdrop *b, const struct backdrop_colors *colors)
{
    const int inner = BACKDROP_ROWS - 2;
    for (int row = 0; row < BACKDROP_ROWS; row++) {
        const int step = row == 0 ? 0 : row > inner ? inner - 1 : row - 1;
        const int y = row == 0 ? BEYOND : row > inner ? -BEYOND : PICTURE - 2 * PICTURE * step / (inner - 1);
        for (int side = 0; side < 2; side++) {
            int16_t *at = b->position + 3 * (2 * row + side);
            uint8_t *color = b->color + 4 * (2 * row + side);
            at[0] = (int16_t)(side == 0 ? -WIDTHS * PICTURE : WIDTHS * PICTURE - 1);
            at[1] = (int16_t)y;
            at[2] = 0;
            for (int k = 0; k < 3; k++) {
                const int top = (int)(colors->top >> (16 - 8 * k) & 255), bottom = (int)(colors->bottom >> (16 - 8 * k) & 255);
                color[k] = (uint8_t)(top + ((bottom - top) * step * 2 + (bottom > top ? inner - 1 : 1 - inner)) / (2 * (inner - 1)));
            }
            color[3] = 255;
        }
    }
    for (int row = 0; row + 1 < BACKDROP_ROWS; row++) {
        const int corner[6] = { 0, 2, 3, 0, 3, 1 };
        for (int k = 0; k < 6; k++)
            b->index[6 * row + k] = (uint16_t)(2 * row + corner[k]);
    }
}

/* The distance at which it stands: well behind all else, where the far plane lets it. */
static double distance_of(const smear_camera *camera, double farthest)
{
    const double near_plane = camera->near_plane / 65536.0, far_plane = camera->far_plane / 65536.0;
    const double behind = fmax(farthest, near_plane) * 1.5;
    if (far_plane <= 0.0)
        return behind;
    return fmin(behind, camera->half_height > 0 ? far_plane - (far_plane - near_plane) / 256.0 : far_plane * (255.0 / 256.0));
}

bool backdrop_place(struct backdrop *b, const struct backdrop_colors *colors, const smear_camera *camera, double farthest,
                    smear_draw *out, struct failure *f)
{
    const double distance = distance_of(camera, farthest);
    const double half = camera->half_height > 0 ? camera->half_height / 65536.0 : distance / (camera->focal / 65536.0);
    int exponent;
    if (!(distance + WIDTHS * half < FARTHEST))
        return fail(f, "a background of two colours would be too far away for fixed point");
    fill_rows(b, colors);
    /* half = PICTURE x scale / 2^shift, scale of 30 bits */
    const double scale = ldexp(frexp(half / PICTURE, &exponent), 30);
    b->mesh = (smear_mesh){ .position = b->position, .color = b->color, .index = b->index, .triangle_count = BACKDROP_TRIANGLES,
                            .vertex_count = 2 * BACKDROP_ROWS, .scale = (int32_t)scale, .shift = (int8_t)(30 - exponent) };
    b->material = (smear_material){ .color = { 255, 255, 255, 255 }, .unlit = 1 };
    b->pose = camera->pose;
    for (int axis = 0; axis < 3; axis++)
        b->pose.origin[axis] -= (int32_t)llround(camera->pose.basis[3 * axis + 2] * distance / 256.0);
    *out = (smear_draw){ .mesh = &b->mesh, .material = &b->material, .now = &b->pose, .motion = SMEAR_MOTION_NONE };
    return true;
}
