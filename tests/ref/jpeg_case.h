/* SPDX-License-Identifier: MIT */
/* jpeg_case.h - JPEG files at random, of all that a reader has to know, and what they show, by the definitions. */
#ifndef SMEAR_TESTS_REF_JPEG_CASE_H
#define SMEAR_TESTS_REF_JPEG_CASE_H

#include "tools/image/buffer.h"

enum { CASE_COMPONENTS = 3 };

struct jpeg_case {
    int width, height, count;           /* components: 1 or 3 */
    int h[CASE_COMPONENTS], v[CASE_COMPONENTS], h_most, v_most;
    bool is_progressive, is_rgb;
    int colors;                         /* how the file tells what its components are */
    int columns[CASE_COMPONENTS], rows[CASE_COMPONENTS];        /* blocks, of whole MCUs */
    int table[CASE_COMPONENTS];
    uint16_t quantum[4][64];            /* as coefficients, in the order of the file */
    int16_t *coefficient[CASE_COMPONENTS];
};

/* A picture of edges up to `largest`, by random_state. */
void jpeg_case_make(struct jpeg_case *c, int largest);
void jpeg_case_free(struct jpeg_case *c);

/* A file that holds it, one of many that do; at times it lacks its last marker. All that counts lies before *end. */
struct buffer jpeg_case_write(const struct jpeg_case *c, size_t *end);

/* The picture without any rounding, 3 values a pixel. */
void jpeg_case_show(const struct jpeg_case *c, double *rgb);

#endif
