/* SPDX-License-Identifier: MIT */
/* parts.h - parts of what was submitted, each with a store of its own, assembled on several cores. */
#ifndef SMEAR_PARTS_H
#define SMEAR_PARTS_H

#include "base/jobs.h"
#include "geometry/vertex.h"

struct smear_part {
    struct smear_assembler as;
    struct smear_bins bins;
    struct smear_damaged_tiles tiles;   /* as.damaged, which tells draws apart */
    struct smear_tile_box rest;         /* where a static draw's triangles are seen that begins in a part before */
    struct smear_tile_box *rest_of;     /* that draw's box, or null */
    uint32_t first, end;                /* triangles, counted through all draws */
    uint32_t beside;
    uint32_t number, segment;           /* with which it begins, in a part of the pool */
    bool done;
};

/* Returns total k / n without a product of 64 bits; k <= n. */
static inline uint32_t part_share(uint32_t total, uint32_t k, uint32_t n) { return total / n * k + total % n * k / n; }

/* How what is submitted is cut into parts that take about as long: a draw as long as some triangles before its first one. */
struct smear_parts_cut {
    uint32_t parts, total;              /* weight of all draws */
    uint32_t weight, triangles, next;   /* of the draws before, and the part that begins next */
    uint32_t first[SMEAR_WORKERS_MAX + 1];       /* triangles, counted through all draws */
    uint32_t draws[SMEAR_WORKERS_MAX];   /* draws that begin before that */
};

/* Takes in draw number i: for all draws without `cuts`, to find their weight, then with it. */
void smear_parts_cut(struct smear_parts_cut *cut, uint32_t i, uint32_t triangles, bool cuts);

/* Returns how many draws the parts left out as nothing of them is in view. */
uint32_t smear_parts_beside(const struct smear_part *part, uint32_t n);

/* Returns how many segments parts of the pool have. */
uint32_t smear_parts_segments(const struct smear_part *part, uint32_t n);

/* Makes a part that adds to the store itself. */
void smear_part_within(struct smear_part *p, const struct smear_assembler *a);

/* Makes a part whose store, with its rings, segments and vertex cache, lies in memory of its own. False where that is too small. */
bool smear_part_apart(struct smear_part *p, const struct smear_assembler *a, void *memory, size_t bytes);

/* Makes part k of n, those before it have been made: its share of the pool behind `head` words, of segments from number
 * `segment` on and of triangles with a path. */
void smear_part_in_pool(struct smear_part *part, const struct smear_assembler *a, uint32_t k, uint32_t n, uint32_t head,
                        uint32_t segment);

/* Joins such parts; returns the words of the pool that are used. What is free of it becomes what is free in the part that has the most. */
uint32_t smear_parts_join_pool(struct smear_assembler *a, const struct smear_part *part, uint32_t n);

/* Gives back what smear_part_within() took, and adds what the others have. False where there is no room. */
bool smear_parts_join(struct smear_assembler *a, const struct smear_part *part, uint32_t n);

#endif
