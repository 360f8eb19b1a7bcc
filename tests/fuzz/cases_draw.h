/* SPDX-License-Identifier: MIT */
/* cases_draw.h - draws a case, and ends the program where anything about it is not as it should be. */
#ifndef SMEAR_FUZZ_CASES_DRAW_H
#define SMEAR_FUZZ_CASES_DRAW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* As the program `frames` has them (frames.c). */
enum mode { MODE_VALID,
            MODE_WILD,
            MODE_SUMS,
            MODE_THREADS,
            MODE_MANY,
            MODE_PARTS };

struct counts {
    uint64_t cases, frames, refused, compared, parts, errors;
};

extern char now_at[80]; /* the case and its frame */
extern bool talks;

/* Returns a sum of the case's pictures. */
uint32_t run_case(struct counts *counts, uint64_t number, enum mode mode);

/* The case that the bytes tell. */
void run_bytes(const uint8_t *bytes, size_t size, enum mode mode);

#endif
