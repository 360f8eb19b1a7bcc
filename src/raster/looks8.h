/* SPDX-License-Identifier: MIT */
/* looks8.h - what eight triangles at an instant look like: planes of colours and of texture coordinates, that setup.c finds for
 * one, to the same bits. */
#ifndef SMEAR_LOOKS8_H
#define SMEAR_LOOKS8_H

#include "kernels/planes8.h"
#include "raster/setup.h"

#if SMEAR_AVX2

/* A plane of each, as in struct plane. */
struct plane8 {
    int32_t at[8], dx[8], dy[8];
};

/* As in struct curve. */
struct curve8 {
    int32_t term[6][8];
};

/* Bit k of a mask is that of triangle k. Members are those of struct setup and struct texture_setup; undefined where a
 * triangle's kind has none. */
struct looks8 {
    uint32_t flat;                  /* one colour, opaque; they have nothing but `color` */
    uint32_t even, perspective;     /* of colours */
    uint32_t color[8];
    int32_t color_block[8];
    struct plane8 channel[4];
    uint32_t curved, affine;        /* modes of texture coordinates: curved, or else affine; or else divided */
    struct curve8 curve[2];
    struct plane8 texture[3];       /* u, v and q */
    uint32_t worst[8], change[8];   /* smear_setup_blocks */
    int32_t width[8];
};

/* Makes those of triangles of `wanted`, which are seen; the others' are undefined. There is no fog, and textures have one
 * level. */
void smear_looks8_avx2(struct looks8 *out, const struct smear_raster_frame *frame, const struct smear_segment *segment,
                       const struct poses *p, const struct planes8 *planes, uint32_t wanted);

/* Takes those of triangle k, all else but its rows is known. */
void smear_looks8_take(struct setup *s, const struct looks8 *looks, int k);

#endif
#endif
