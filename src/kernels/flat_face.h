/* SPDX-License-Identifier: MIT */
/* flat_face.h - depth-tested pixels of a triangle of one colour. */
#ifndef SMEAR_KERNELS_FLAT_FACE_H
#define SMEAR_KERNELS_FLAT_FACE_H

#include "kernels/corners.h"
#include "kernels/edge_walk.h"
#include "kernels/flat_run.h"
#include "kernels/planes8.h"

/* Where pixels lie: columns [x0, x1) of rows [y0, y1), which are FLAT_FACE_ROWS at most. */
enum { FLAT_FACE_ROWS = 64, FLAT_FACE_LEAST = 16 };
struct flat_area {
    void *pixels;                   /* pixel 0 of row y0, which may lie outside the memory */
    uint16_t *depth;
    int32_t stride;
    int32_t x0, x1, y0, y1;
    bool narrow;
};

struct flat_face {
    const int32_t *corner[3];       /* x and y, q8 px, clockwise */
    uint32_t z, dz, dz_down;        /* depth codes 16.16 at pixel 0 of row y0, and their steps */
    uint32_t color;
    bool breaks;                    /* the codes have their break in it: z is how far depths are above that, units q11 */
};

/* Where the depth code breaks, units q11: below it they have 32 times as many codes 16.16, from it on twice. And the code there, of
 * which the half for rounding is part. */
#define FLAT_BREAK (32768u << 11)
#define FLAT_BREAK_CODE 0x80008000u

/* The code 16.16 of a pixel. */
SMEAR_INLINE uint32_t flat_code(uint32_t z, bool breaks)
{
    return !breaks ? z : FLAT_BREAK_CODE + ((int32_t)z < 0 ? z << 5 : z << 1);
}

/* Draws the pixels whose centres lie in the triangle, like flat_run: those at its left and upper edges, too. */
static inline void flat_face_reference(const struct flat_area *a, const struct flat_face *f)
{
    struct corners c;
    corners_find(&c, f->corner, a->y0, a->y1);
    for (int32_t y = c.first; y < c.end; y++) {
        struct edge_walk whole, part;
        edge_start(&whole, c.top, c.bottom, y);
        edge_start(&part, y < c.knee ? c.top : c.middle, y < c.knee ? c.middle : c.bottom, y);
        const int32_t left = max_i32(edge_pixel(c.whole_is_left ? &whole : &part), a->x0);
        const int32_t right = min_i32(edge_pixel(c.whole_is_left ? &part : &whole), a->x1);
        const uint32_t z = f->z + f->dz_down * (uint32_t)(y - a->y0);
        const int32_t at = (y - a->y0) * a->stride;
        for (int32_t x = left; x < right; x++)
            flat_pixel(a->pixels, a->depth, at + x, flat_code(z + f->dz * (uint32_t)x, f->breaks), f->color, a->narrow);
    }
}

#if SMEAR_AVX2
/* The same where columns are FLAT_FACE_LEAST at least: they may be written as they are. */
void smear_flat_face_avx2(const struct flat_area *a, const struct flat_face *f);

/* A face from some row on, which has been made ready for that and those below: corners are not looked at again. */
struct flat_carried {
    uint64_t x[3], step[3];         /* sides in that row: px q42, as in struct edge_walk. The long one, and that above the middle
                                     * corner and below it; where no rows lie above, both are that below */
    int32_t y, knee;                /* the row, and the first one below the middle corner */
    uint32_t z, dz, dz_down, color; /* as above, in row y */
    bool breaks;
};

/* Makes its sides; row y lies below the top corner. Then draws it in rows [y, end) of the area, FLAT_FACE_ROWS at most, none above
 * row f->y or below the bottom corner. */
void smear_flat_carry_avx2(struct flat_carried *f, const int32_t *const corner[3], int32_t y);
void smear_flat_carried_avx2(const struct flat_area *a, const struct flat_carried *f, int32_t y, int32_t end);

/* Eight of them, of which corners tell what is here. Sides: from the top to the bottom, to the middle, and from there. */
struct flat_eight {
    int32_t row[8], n[8];           /* the first row, from y0 on, and how many there are, or less than none */
    int32_t knee[8], rows[8];       /* from the first row to the middle corner's, and from the top's to the first */
    int32_t x[2][8], down[2][8];    /* of the top and the middle: half a pixel right of it, and down to centres of pixels: q8 px */
    int32_t dx[3][8], dy[3][8];     /* sides; dy > 0 where they have rows */
    uint32_t z[8], dz[8], dz_down[8];       /* as above, but in the first row */
    uint32_t color[8];              /* as the target has it */
    uint32_t breaks;                /* bit k: of face k */
};

/* Makes those of triangles that are seen, which have these colours, 0x00RRGGBB; and draws some of them in their order. */
void smear_flat_eight_make_avx2(struct flat_eight *e, const struct flat_area *a, const struct poses *poses, const struct planes8 *planes,
                                const uint32_t color[8]);
void smear_flat_eight_draw_avx2(const struct flat_eight *e, const struct flat_area *a, uint32_t which);
#endif

#endif
