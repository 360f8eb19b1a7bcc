/* SPDX-License-Identifier: MIT */
/* assemble_avx2.h - the loop over a draw's triangles by AVX2, and what it leaves to assemble.c. */
#ifndef SMEAR_ASSEMBLE_AVX2_H
#define SMEAR_ASSEMBLE_AVX2_H

#include "geometry/places.h"
#include "kernels/avx2.h"

#if SMEAR_PLACES && SMEAR_AVX2
/* Adds triangles of [first, end) by eights. Returns how far that goes: fewer than eight are left, or places are in the way;
 * UINT32_MAX where there is no room. The processor has AVX2. */
uint32_t smear_assemble_avx2(struct batch *b, const struct places *r, uint32_t first, uint32_t end);

/* Stores a vertex of any kind; returns the first word of its record. */
uint32_t smear_assemble_vertex(const struct batch *b, uint32_t index, const struct smear_screen *screen, uint32_t triangle, bool back);

/* Shades a triangle of one colour. */
uint32_t smear_assemble_face(const struct batch *b, uint32_t triangle, bool back);

/* Adds a triangle of long edges, or one that has to be clipped. False where there is no room. */
bool smear_assemble_far(struct batch *b, const struct places *r, const uint32_t index[3], uint32_t triangle);
#endif

#endif
