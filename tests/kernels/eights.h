/* SPDX-License-Identifier: MIT */
/* eights.h - eights of random triangles at an instant, many from one number. */
#ifndef EIGHTS_TEST_H
#define EIGHTS_TEST_H

#include "geometry/transform.h"
#include "kernels/poses.h"
#include "raster/setup.h"

#if SMEAR_AVX2

static inline uint32_t eight_next(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8 ^ *seed << 24;
}

static inline int32_t eight_between(uint32_t *seed, int32_t low, int32_t high)
{
    return low + (int32_t)(eight_next(seed) % (uint32_t)(high - low + 1));
}

static inline uint64_t eight_area(int32_t (*const v)[POSES_RECORD])
{
    return (uint64_t)((int64_t)(v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (int64_t)(v[2][0] - v[0][0]) * (v[1][1] - v[0][1]));
}

/* Takes words and bounds from the records. */
static inline void eight_take(struct poses *p)
{
    for (int k = 0; k < 8; k++) {
        for (int i = 0; i < 3; i++)
            for (int word = 0; word < POSES_WORDS; word++)
                p->word[i][word][k] = p->record[k][i][word];
        for (int axis = 0; axis < 2; axis++) {
            const int32_t v[3] = { p->record[k][0][axis], p->record[k][1][axis], p->record[k][2][axis] };
            p->bounds[axis][k] = min_i32(v[0], min_i32(v[1], v[2]));
            p->bounds[axis + 2][k] = max_i32(v[0], max_i32(v[1], v[2]));
        }
    }
    p->has_records = true;
}

/* Triangles of any size within the guard band, many of them slivers; depths near the break of their code, or any. */
static inline void eight_make(struct poses *p, uint32_t *seed)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    p->seen = 0;
    __builtin_memset(p->record, 0, sizeof p->record);
    for (int k = 0; k < 8; k++) {
        const int32_t reach = 1 << eight_between(seed, 2, 19), step = 1 << eight_between(seed, 0, 25);
        const int32_t middle = (eight_next(seed) & 1u) != 0 ? SLOPE_BREAK : eight_between(seed, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
        for (int i = 0; i < 3; i++)
            for (int axis = 0; axis < 3; axis++) {
                int32_t *const out = &p->record[k][i][axis];
                if (axis == 2) {
                    *out = clamp_i32(middle + eight_between(seed, -step, step), SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
                } else {
                    const int32_t from = i == 0 ? eight_between(seed, -3000, 90000) : p->record[k][0][axis];
                    *out = clamp_i32(from + eight_between(seed, -reach, reach), -guard, guard);
                }
            }
        p->seen |= (uint32_t)((int64_t)eight_area(p->record[k]) > 0) << k;
    }
    eight_take(p);
}

#endif
#endif
