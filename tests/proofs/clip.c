/* SPDX-License-Identifier: MIT */
/* clip.c - the arithmetic of a cut, for any two vertices on both sides of any plane: Frama-C's Eva follows all values at once
 * (`make proofs`). Which corners stay and which are free is what polygons.c tries, case by case. */
#include "base/fixed.h"

/*@ assigns \result \from a, c;
    ensures 0 <= \result <= 1073741824; */
static inline int32_t ratio_q30(int64_t a, int64_t c);

#include "geometry/clip.c"

volatile int32_t any_int;
volatile int seen;

/* A transformed vertex: what transform_row returns, but for the least number, whose opposite is no number. */
static int32_t any_coordinate(void)
{
    const int32_t a = any_int;
    return a > INT32_MIN ? a : 0;
}

static void any_vertex(struct smear_clip_vertex *v)
{
    const struct smear_homogeneous h = { any_coordinate(), any_coordinate(), any_coordinate(), any_coordinate() };
    v->now = h;
    for (int i = 0; i < CLIP_ROOM(CLIP_POSES); i++) {
        const struct smear_homogeneous pose = { any_coordinate(), any_coordinate(), any_coordinate(), any_coordinate() };
        v->pose[i] = pose;
    }
    for (int i = 0; i < 2; i++)
        v->uv[i] = (int16_t)any_int;
    for (int i = 0; i < CLIP_ROOM(CLIP_COLORS); i++)
        v->color[i] = (uint16_t)any_int;
}

int main(void)
{
    struct smear_clip_polygon polygon;
    smear_clip_start(&polygon, CLIP_POSES, true);
    for (int plane = PLANE_NEAR; plane < PLANES; plane++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            struct smear_depths p = { .near_distance = any_coordinate(), .far_distance = any_coordinate(),
                                      .orthographic = orthographic != 0 };
            const int coarse = any_int;
            p.coarse = (uint8_t)(coarse >= 0 && coarse <= GUARD_LOG2 ? coarse : 0);
            struct smear_clip_vertex in, out, between;
            any_vertex(&in);
            any_vertex(&out);
            seen = is_outside(&in, &p, (enum plane)plane);
            const int64_t inner = distance_to(&in, &p, (enum plane)plane), outer = distance_to(&out, &p, (enum plane)plane);
            /*@ assert -(1 << 43) < inner < (1 << 43); */
            if (inner >= 0 && outer < 0)
                cut(&polygon, &between, &in, &out, &p, (enum plane)plane);
        }
    return 0;
}
