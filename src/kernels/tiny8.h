/* SPDX-License-Identifier: MIT */
/* tiny8.h - the pixels of eight tiny triangles at once. They are made ready in lanes, a triangle each; then the covered
 * centres of each box are found, a pixel in each lane, and lined up; then depth and colours of what is lined up, eight pixels at
 * once, whichever triangles they are of. The bits are those of cover_tiny.h and cover_texels.c, which draw what is not taken. */
#ifndef SMEAR_KERNELS_TINY8_H
#define SMEAR_KERNELS_TINY8_H

#include "smear.h"

#include "kernels/avx2.h"

#if SMEAR_AVX2

enum tiny8_kind {
    TINY8_FLAT,             /* a colour for each triangle */
    TINY8_SHADED,           /* colours of vertices */
    TINY8_COPIED,           /* texels as they are */
    TINY8_LIT               /* texels in the light of vertices, a triangle or of none */
};

/* What triangles have in common. */
struct tiny8_look {
    enum tiny8_kind kind;
    const int32_t *vertex;          /* records: x, y (q8 px), depth units q11, uv (mesh units) */
    int color;                      /* in a record: the first of two words of colour; 0: none */
    bool perspective;               /* depth is 1/w */
    bool even;                      /* colours came from vertices: depths must be nearly even */
    bool linear;                    /* light */
    bool narrow;                    /* pixels are RGB565, else 0x00RRGGBB */
    bool white;                     /* texels without a light */
    int32_t most;                   /* width and height of a box, px: up to 16 */
    int32_t x0, y0, x1, y1;         /* what is drawn of the frame; nothing is below 0 */
    int32_t at, stride;             /* place (x, y) is at + x + y stride; stride below 2^15 */
    const void *texels;
    const uint32_t *palette;
    int format;                     /* smear_texel_format */
    int from_u, from_v;             /* index = v >> from_v & mask_v | u >> from_u & mask_u, of q15 mesh units */
    uint32_t mask_u, mask_v;
    uint32_t width, height, span;   /* texels; and those that coordinates of 16 bits span, plus one */
    int uv_shift;
};

/* Boxes of at most this many pixels are tiny. */
enum { TINY8_BOX = 32 };

/* Pixels of the triangles that are taken, in the order of triangles, not tested by depth. */
struct tiny8_pixels {
    uint32_t taken;                 /* bit k: triangle k; another one is not drawn here */
    int32_t end[8];                 /* its pixels begin where those before it end */
    int32_t at[8 * TINY8_BOX + 8];
    uint32_t code[8 * TINY8_BOX + 8];       /* depth */
    uint32_t pixel[8 * TINY8_BOX + 8];
};

/* Eight triangles: places of vertices in words, the fourth of each is not looked at; and colours. */
void smear_tiny8_avx2(struct tiny8_pixels *out, const struct tiny8_look *l, const uint16_t vertex[8][4], const uint32_t color[8]);

#endif
#endif
