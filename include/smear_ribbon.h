/* SPDX-License-Identifier: MIT */
/* smear_ribbon.h - lines in the world, as a draw: what is nearer hides them, and every method blurs them, as all draws. Header
 * only; the library does not know of it.
 *
 *     static smear_segment edge[12];                      // ends now, and where they were one frame ago
 *     static int16_t position[SMEAR_RIBBON_POSITIONS(12)];
 *     static uint16_t index[SMEAR_RIBBON_INDICES(12)];
 *     static smear_ribbon ribbon;
 *
 *     ribbon.segment = edge, ribbon.count = 12, ribbon.width = SMEAR_Q16(0.05), ribbon.position = position, ribbon.index = index;
 *     smear_ribbon_place(&ribbon, &camera, &camera_a_frame_ago);
 *     smear_begin(ctx, &frame);
 *     ribbon.draw.material = &glow;                       // its colour; unlit
 *     smear_submit(ctx, &ribbon.draw);
 *
 * Each segment is two triangles that face the eye, and faced it a frame ago from where the eye was then. Where segments meet at an
 * angle, there is a notch. */
#ifndef SMEAR_RIBBON_H
#define SMEAR_RIBBON_H

#include "smear_math.h"

typedef struct smear_segment {
    int32_t now[2][3];          /* its ends, Q16.16 world units */
    int32_t before[2][3];       /* where they were one frame ago; of a new one, as `now` */
} smear_segment;

#define SMEAR_RIBBON_POSITIONS(segments) (24 * (segments))
#define SMEAR_RIBBON_INDICES(segments) (6 * (segments))

typedef struct smear_ribbon {
    const smear_segment *segment;
    uint16_t count;             /* at most 16383; one extent holds all of them: positions are in 32000ths of it, or finer */
    int32_t width;              /* Q16.16 world units, not negative */
    uint16_t pixels;            /* 256ths: lines are nowhere thinner than so many pixels of a frame of ... */
    uint16_t rows;              /* ... so many rows. 0: as thin as they are */
    int16_t *position;          /* SMEAR_RIBBON_POSITIONS: written by smear_ribbon_place, read until smear_render returns */
    uint16_t *index;            /* SMEAR_RIBBON_INDICES, likewise */
    smear_mesh mesh;            /* from here on smear_ribbon_place writes all but materials, colours, layers and motion */
    smear_transform place;
    smear_draw draw;
} smear_ribbon;

/* Names that begin with smear_ribbon_ and end with _ serve this header only. */

/* Returns half of how wide a line is at a place, as it is seen by a camera. */
static inline int32_t smear_ribbon_half_(const smear_ribbon *r, const smear_camera *camera, const int32_t end[3])
{
    const int32_t *eye = camera->pose.origin;
    const int32_t *b = camera->pose.basis;
    const int32_t back[3] = { b[2], b[5], b[8] };
    int32_t half = r->width / 2, one, away[3];
    if (r->rows != 0) {         /* half of a pixel: as far as it is seen at distance 1, Q8.24 */
        if (camera->half_height > 0) {
            one = smear_math_narrow((int64_t)(camera->half_height / r->rows) * r->pixels >> 8);
        } else {
            one = (int32_t)((((uint32_t)r->pixels << 16) / r->rows << 4) / ((uint32_t)camera->focal >> 4 | 1u) << 8);
            smear_math_difference(away, smear_vec(end[0], end[1], end[2]), smear_vec(eye[0], eye[1], eye[2]));
            one = smear_math_narrow(-smear_math_row(back, away[0], away[1], away[2]) * one >> 24);
        }
        half = half > one ? half : one;
    }
    return half;
}

/* Writes the four corners of a segment at one time: its ends and the eye's camera. Steps are 2^shift in Q16.16 from `center`. */
static inline void smear_ribbon_corners_(const smear_ribbon *r, int16_t *out, const int32_t end[2][3], const smear_camera *camera,
                                         int shift)
{
    const smear_vec3 eye = smear_vec(camera->pose.origin[0], camera->pose.origin[1], camera->pose.origin[2]);
    int32_t along[3];
    int e, k;
    smear_math_difference(along, smear_vec(end[1][0], end[1][1], end[1][2]), smear_vec(end[0][0], end[0][1], end[0][2]));
    for (e = 0; e < 2; e++) {
        int32_t away[3], view[3], side[3] = { 0, 0, 0 }, half;
        smear_math_difference(away, smear_vec(end[e][0], end[e][1], end[e][2]), eye);
        half = smear_ribbon_half_(r, camera, end[e]);
        for (k = 0; k < 3; k++)
            view[k] = camera->half_height > 0 ? -camera->pose.basis[3 * k + 2] : away[k];
        if (smear_math_normalize(view, 3))
            smear_math_right(side, smear_vec(along[0], along[1], along[2]), view);
        for (k = 0; k < 3; k++) {
            const int64_t at = (int64_t)end[e][k] - r->place.origin[k], wide = (int64_t)side[k] * half >> 30;
            const int64_t round = (int64_t)1 << shift >> 1;
            out[6 * e + k] = (int16_t)((at - wide + round) >> shift);
            out[6 * e + 3 + k] = (int16_t)((at + wide + round) >> shift);
        }
    }
}

/* Makes mesh and draw of where segments and camera are now and were one frame ago: those of the frame that smear_begin is called
 * with next and of that before it. */
static inline void smear_ribbon_place(smear_ribbon *r, const smear_camera *now, const smear_camera *before)
{
    int32_t least[3] = { INT32_MAX, INT32_MAX, INT32_MAX }, most[3] = { INT32_MIN, INT32_MIN, INT32_MIN };
    int64_t reach = 0;
    int i, e, k, half = 0, shift = 0;
    for (i = 0; i < r->count; i++)
        for (e = 0; e < 4; e++) {
            const int32_t *end = e < 2 ? r->segment[i].now[e] : r->segment[i].before[e - 2];
            for (k = 0; k < 3; k++) {
                least[k] = end[k] < least[k] ? end[k] : least[k];
                most[k] = end[k] > most[k] ? end[k] : most[k];
            }
            k = smear_ribbon_half_(r, e < 2 ? now : before, end);
            half = k > half ? k : half;
        }
    r->place = smear_move(0, 0, 0);
    for (k = 0; k < 3 && r->count != 0; k++) {
        const int64_t size = (int64_t)most[k] - least[k];
        r->place.origin[k] = (int32_t)(least[k] + (size >> 1));
        reach = size > reach ? size : reach;
    }
    reach = (reach >> 1) + half;
    while (reach >> shift > 32000)
        shift++;
    for (i = 0; i < r->count; i++) {
        static const uint8_t corner[6] = { 0, 2, 3, 0, 3, 1 };
        smear_ribbon_corners_(r, r->position + 12 * i, r->segment[i].now, now, shift);
        smear_ribbon_corners_(r, r->position + 12 * (r->count + i), r->segment[i].before, before, shift);
        for (k = 0; k < 6; k++)
            r->index[6 * i + k] = (uint16_t)(4 * i + corner[k]);
    }
    r->mesh.position = r->position;
    r->mesh.index = r->index;
    r->mesh.vertex_count = (uint16_t)(4 * r->count);
    r->mesh.triangle_count = 2u * r->count;
    r->mesh.shift = (int8_t)(16 - shift);
    r->draw.mesh = &r->mesh;
    r->draw.now = r->draw.open = &r->place;
    r->draw.open_position = r->position + 12 * r->count;
}

#endif
