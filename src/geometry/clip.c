/* SPDX-License-Identifier: MIT */
/* clip.c - Sutherland-Hodgman against up to six planes. */
#include "geometry/clip.h"

#include "base/fixmath.h"

enum { GUARD_LOG2 = 11 };
SMEAR_STATIC_ASSERT(SMEAR_GUARD_PX == 1 << GUARD_LOG2, "the guard band, px");

enum plane { PLANE_NEAR, PLANE_FAR, PLANE_LEFT, PLANE_RIGHT, PLANE_TOP, PLANE_BOTTOM, PLANES };

/* Returns the signed distance from a plane: negative outside, below 2^43. */
static int64_t distance_to(const struct smear_clip_vertex *v, const struct smear_depths *depths, enum plane plane)
{
    const struct smear_homogeneous *h = &v->now;
    if (plane == PLANE_NEAR)
        return (int64_t)h->distance - depths->near_distance;
    if (plane == PLANE_FAR)
        return (int64_t)depths->far_distance - h->distance;
    const int32_t at = plane >= PLANE_TOP ? h->y : h->x;
    return (int64_t)h->w * (SMEAR_GUARD_PX >> depths->coarse) + (plane == PLANE_LEFT || plane == PLANE_TOP ? at : -at);
}

/* Tells the sign of the distance: a < -2048 w where floor(a / 2048) < -w. */
static bool is_outside(const struct smear_clip_vertex *v, const struct smear_depths *depths, enum plane plane)
{
    if (SMEAR_ONE_COPY || plane <= PLANE_FAR)
        return distance_to(v, depths, plane) < 0;
    const int32_t a = plane >= PLANE_TOP ? v->now.y : v->now.x;
    return (plane == PLANE_LEFT || plane == PLANE_TOP ? a : -a) >> (GUARD_LOG2 - depths->coarse) < -v->now.w;
}

/* Returns a + (b - a) t to nearest, t in q30. */
static int32_t mix(int32_t a, int32_t b, int32_t t)
{
    if (SMEAR_HAS_MUL64)
        return (int32_t)(((int64_t)a * ((1 << 30) - t) + (int64_t)b * t + (1 << 29)) >> 30);
    return (int32_t)(a + ((((int64_t)b - a) * t + (1 << 29)) >> 30));
}

/* Brings a new vertex onto its plane: rounding may leave it a step outside, and W must be positive to divide by it. */
static void settle(struct smear_homogeneous *h, const struct smear_depths *depths, enum plane plane)
{
    if (plane <= PLANE_FAR) {
        h->distance = plane == PLANE_NEAR ? depths->near_distance : depths->far_distance;
        if (!depths_are_even(depths))
            h->w = h->distance;
    } else if (h->w < 1) {
        h->w = 1;
    }
}

/* Finds the vertex where the edge from `in` to `out` meets the plane. */
static void cut(const struct smear_clip_polygon *polygon, struct smear_clip_vertex *result,
                const struct smear_clip_vertex *in, const struct smear_clip_vertex *out,
                const struct smear_depths *depths, enum plane plane)
{
    int64_t d = distance_to(in, depths, plane);
    int32_t t = ratio_q30(d, d - distance_to(out, depths, plane));
    const int32_t *const a = (const int32_t *)(const void *)in, *const b = (const int32_t *)(const void *)out;
    int32_t *const between = (int32_t *)(void *)result;
    for (int i = 0; i < polygon->words; i++)
        between[i] = mix(a[i], b[i], t);
    settle(&result->now, depths, plane);
}

static void clip_plane(struct smear_clip_polygon *polygon, const struct smear_depths *depths, enum plane plane)
{
    const int count = polygon->count;
    uint32_t outside = 0, used = 7;     /* a bit per corner; per vertex */
    int fresh = SMEAR_CLIP_MAX - count; /* where edges were moved by rounding, a new corner may find no room */
    for (int i = 0; i < count; i++) {
        const bool is_out = is_outside(clip_corner(polygon, i), depths, plane);
        outside |= (uint32_t)is_out << i;
        used |= 1u << polygon->order[i];
        fresh += is_out;
    }
    if (outside == 0)
        return;
    uint8_t order[SMEAR_CLIP_MAX];
    int result = 0, vertex = 3;
    for (int i = 0; i < count; i++) {
        const int next = i + 1 == count ? 0 : i + 1;
        const bool is_out = outside >> i & 1u;
        if (!is_out)
            order[result++] = polygon->order[i];
        if (is_out == (outside >> next & 1u) || fresh == 0)
            continue;
        while ((used >> vertex & 1u) != 0)
            vertex++;
        if (vertex == SMEAR_CLIP_ROOM)
            continue;
        cut(polygon, &polygon->vertex[vertex], clip_corner(polygon, is_out ? next : i),
            clip_corner(polygon, is_out ? i : next), depths, plane);
        fresh--;
        order[result++] = (uint8_t)vertex++;
    }
    for (int i = 0; i < result; i++)
        polygon->order[i] = order[i];
    polygon->count = result < 3 ? 0 : result;
}

void smear_clip_start(struct smear_clip_polygon *p, int poses, bool colored)
{
    p->count = 3;
    p->words = (uint8_t)(poses != 0 ? sizeof(struct smear_clip_vertex) / 4 : colored ? 6 + CLIP_COLORS : 6);
    SMEAR_STATIC_ASSERT(CLIP_COLORS == 0 || sizeof(struct smear_clip_vertex) == 4 * (6 + CLIP_COLORS + 4 * CLIP_ROOM(CLIP_POSES)), "words");
    for (int i = 0; i < 3; i++)
        p->order[i] = (uint8_t)i;
}

void smear_clip_polygon(struct smear_clip_polygon *p, const struct smear_depths *depths, int codes)
{
    if (codes & OUT_NEAR)
        clip_plane(p, depths, PLANE_NEAR);
    if (codes & OUT_FAR)
        clip_plane(p, depths, PLANE_FAR);
    /* A vertex behind the near plane had no side: after the cut any side may need one. */
    if (codes & (OUT_NEAR | OUT_GUARD))
        for (int plane = PLANE_LEFT; plane < PLANES; plane++)
            clip_plane(p, depths, (enum plane)plane);
}
