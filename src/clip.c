/* SPDX-License-Identifier: MIT */
/* clip.c - Sutherland-Hodgman against up to six planes. Few triangles come here: 64-bit sums are fine. */
#include "clip.h"

#include "fixmath.h"

enum plane { PLANE_NEAR, PLANE_FAR, PLANE_LEFT, PLANE_RIGHT, PLANE_TOP, PLANE_BOTTOM, PLANES };

/* Signed distance, negative outside; |.| < 2^43. */
static int64_t distance_to(const struct smear_clip_vertex *v, const struct smear_projection *p,
                           enum plane plane)
{
    const struct smear_homogeneous *h = &v->now;
    switch (plane) {
    case PLANE_NEAR:   return (int64_t)h->distance - p->near_distance;
    case PLANE_FAR:    return (int64_t)p->far_distance - h->distance;
    case PLANE_LEFT:   return (int64_t)h->w * SMEAR_GUARD_PX + h->x;
    case PLANE_RIGHT:  return (int64_t)h->w * SMEAR_GUARD_PX - h->x;
    case PLANE_TOP:    return (int64_t)h->w * SMEAR_GUARD_PX + h->y;
    default:           return (int64_t)h->w * SMEAR_GUARD_PX - h->y;
    }
}

/* a + (b - a) t, t q30, to nearest. */
static int32_t mix(int32_t a, int32_t b, int32_t t)
{
    return (int32_t)(a + ((((int64_t)b - a) * t + (1 << 29)) >> 30));
}

static void mix_homogeneous(struct smear_homogeneous *out, const struct smear_homogeneous *a,
                            const struct smear_homogeneous *b, int32_t t)
{
    out->x = mix(a->x, b->x, t);
    out->y = mix(a->y, b->y, t);
    out->w = mix(a->w, b->w, t);
    out->distance = mix(a->distance, b->distance, t);
}

/* The point where the edge from `in` (distance d_in >= 0) to `out` (distance d_out < 0) meets the plane. */
static void cut(struct smear_clip_vertex *result, const struct smear_clip_vertex *in, int64_t d_in,
                const struct smear_clip_vertex *out, int64_t d_out, int poses)
{
    int32_t t = ratio_q30(d_in, d_in - d_out);
    mix_homogeneous(&result->now, &in->now, &out->now, t);
    for (int i = 0; i < poses; i++)
        mix_homogeneous(&result->pose[i], &in->pose[i], &out->pose[i], t);
    for (int i = 0; i < 2; i++)
        result->uv[i] = mix(in->uv[i], out->uv[i], t);
    for (int i = 0; i < CLIP_COLORS; i++)
        result->color[i] = mix(in->color[i], out->color[i], t);
}

/* Rounding may leave a new vertex a step outside, and W must be positive to divide by it. */
static void settle(struct smear_clip_vertex *v, const struct smear_projection *p, enum plane plane)
{
    if (plane == PLANE_NEAR) {
        v->now.distance = p->near_distance;
        if (!is_orthographic(p))
            v->now.w = p->near_distance;
    } else if (plane == PLANE_FAR) {
        v->now.distance = p->far_distance;
        if (!is_orthographic(p))
            v->now.w = p->far_distance;
    } else if (v->now.w < 1) {
        v->now.w = 1;
    }
}

static int clip_plane(struct smear_clip_vertex vertex[SMEAR_CLIP_MAX], int count,
                      const struct smear_projection *p, enum plane plane, int poses)
{
    struct smear_clip_vertex in[SMEAR_CLIP_MAX];
    int64_t distance[SMEAR_CLIP_MAX];
    int result = 0, outside = 0;
    for (int i = 0; i < count; i++) {
        distance[i] = distance_to(&vertex[i], p, plane);
        outside += distance[i] < 0;
    }
    if (outside == 0)
        return count;
    if (outside == count)
        return 0;
    for (int i = 0; i < count; i++)
        in[i] = vertex[i];
    for (int i = 0; i < count; i++) {
        int next = i + 1 == count ? 0 : i + 1;
        if (distance[i] >= 0)
            vertex[result++] = in[i];
        if ((distance[i] >= 0) == (distance[next] >= 0) || result == SMEAR_CLIP_MAX)
            continue;
        int inner = distance[i] >= 0 ? i : next, outer = distance[i] >= 0 ? next : i;
        cut(&vertex[result], &in[inner], distance[inner], &in[outer], distance[outer], poses);
        settle(&vertex[result++], p, plane);
    }
    return result < 3 ? 0 : result;
}

int smear_clip_polygon(struct smear_clip_vertex vertex[SMEAR_CLIP_MAX], int count,
                       const struct smear_projection *projection, int codes, int poses)
{
    if (count != 0 && codes & OUT_NEAR)
        count = clip_plane(vertex, count, projection, PLANE_NEAR, poses);
    if (count != 0 && codes & OUT_FAR)
        count = clip_plane(vertex, count, projection, PLANE_FAR, poses);
    /* A vertex behind the near plane had no side: after the cut any side may need one. */
    if (codes & (OUT_NEAR | OUT_GUARD))
        for (int plane = PLANE_LEFT; plane < PLANES && count != 0; plane++)
            count = clip_plane(vertex, count, projection, (enum plane)plane, poses);
    return count;
}
