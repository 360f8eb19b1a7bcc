/* SPDX-License-Identifier: MIT */
/* test_clip.c - cuts at the near and far plane and at the guard band: the same bits from both sides of an edge, nothing left
 * outside, never too many corners. Needs neither libc nor floating point. */
#include "geometry/clip.h"

#include "tests/random.h"
#include "tests/test.h"

enum { NEAR_AT = 1 << 12, FAR_AT = 1 << 22 };

static struct smear_depths lens(bool orthographic)
{
    return (struct smear_depths){
        .near_distance = NEAR_AT, .far_distance = FAR_AT, .orthographic = orthographic
    };
}

/* X and Y of a unit that is so many pixels, 2^coarse: the guard band is that many fewer of them. */
static struct smear_depths coarse_lens(int coarse)
{
    struct smear_depths p = lens(false);
    p.coarse = (uint8_t)coarse;
    return p;
}

/* A vertex at (x, y) in homogeneous units and distance w, everything else random. */
static struct smear_clip_vertex vertex_at(int32_t x, int32_t y, int32_t w, bool orthographic)
{
    struct smear_clip_vertex v;
    v.now = (struct smear_homogeneous){ x, y, orthographic ? 1 << 10 : w, w };
    for (int pose = 0; pose < 2; pose++)
        v.pose[pose] = (struct smear_homogeneous){
            between(-(1 << 29), 1 << 29), between(-(1 << 29), 1 << 29), between(-(1 << 29), 1 << 29),
            between(-(1 << 29), 1 << 29)
        };
    for (int i = 0; i < 2; i++)
        v.uv[i] = (int16_t)between(-32768, 32767);
    for (int i = 0; i < 4; i++)
        v.color[i] = (uint16_t)between(0, 65535);
    return v;
}

/* Anywhere: behind the eye, far beyond every plane, in view. */
static struct smear_clip_vertex random_vertex(bool orthographic)
{
    int32_t reach = 1 << between(8, 29), depth = 1 << between(8, 29);
    int32_t x = between(-reach, reach), y = between(-reach, reach);
    return vertex_at(x, y, between(-depth, depth), orthographic);
}

/* At distance w, up to `spread` times as far from the axis. */
static struct smear_clip_vertex vertex_within(int32_t w, int32_t spread, bool orthographic)
{
    int32_t x = between(-w, w) * spread, y = between(-w, w) * spread;
    return vertex_at(x, y, w, orthographic);
}

/* Codes as the assembler sets them, of the one vertex, without the sides. */
static int codes_of(const struct smear_clip_vertex *v, const struct smear_depths *p)
{
    if (v->now.distance < p->near_distance)
        return OUT_NEAR;
    int code = v->now.distance > p->far_distance ? OUT_FAR : 0;
    int64_t guard = (int64_t)v->now.w * (SMEAR_GUARD_PX >> p->coarse);
    if (v->now.x > guard || v->now.x < -guard || v->now.y > guard || v->now.y < -guard)
        code |= OUT_GUARD;
    return code;
}

/* Clips the triangle of v[0 .. 2]; returns how many corners it has then. */
static int clip(struct smear_clip_vertex v[SMEAR_CLIP_MAX], const struct smear_depths *p, int codes)
{
    struct smear_clip_polygon polygon;
    for (int i = 0; i < 3; i++)
        polygon.vertex[i] = v[i];
    smear_clip_start(&polygon, CLIP_POSES, true);
    smear_clip_polygon(&polygon, p, codes);
    for (int i = 0; i < polygon.count && i < SMEAR_CLIP_MAX; i++)
        v[i] = *clip_corner(&polygon, i);
    return polygon.count;
}

static bool same_homogeneous(const struct smear_homogeneous *a, const struct smear_homogeneous *b)
{
    return a->x == b->x && a->y == b->y && a->w == b->w && a->distance == b->distance;
}

/* All but the alpha channel, which the tests use as a mark. */
static bool same_vertex(const struct smear_clip_vertex *a, const struct smear_clip_vertex *b)
{
    bool same = same_homogeneous(&a->now, &b->now) && same_homogeneous(&a->pose[0], &b->pose[0])
             && same_homogeneous(&a->pose[1], &b->pose[1]);
    for (int i = 0; i < 2; i++)
        same = same && a->uv[i] == b->uv[i];
    for (int i = 0; i < 3; i++)
        same = same && a->color[i] == b->color[i];
    return same;
}

/* ------------------------------------------------------------------ */

static bool comes_after(const struct smear_homogeneous *a, const struct smear_homogeneous *b)
{
    return a->x != b->x ? a->x > b->x : a->y != b->y ? a->y > b->y : a->w > b->w;
}

/* The vertices of the clipped polygon that lie on the edge a b: those without any of c, which alone
 * has a distance in its closing pose. Sorted, so that two lists can be compared. */
static int on_edge(struct smear_clip_vertex out[SMEAR_CLIP_MAX], struct smear_clip_vertex a,
                   struct smear_clip_vertex b, struct smear_clip_vertex c, int turn,
                   const struct smear_depths *p)
{
    struct smear_clip_vertex v[SMEAR_CLIP_MAX];
    a.pose[1].distance = b.pose[1].distance = 0;
    c.pose[1].distance = 1 << 30;
    const struct smear_clip_vertex *corner[3] = { &a, &b, &c };
    for (int i = 0; i < 3; i++)
        v[i] = *corner[(turn < 3 ? i + turn : 2 * i + turn) % 3];
    int codes = codes_of(&a, p) | codes_of(&b, p) | codes_of(&c, p);
    int count = clip(v, p, codes), found = 0;
    CHECK(count == 0 || (count >= 3 && count <= SMEAR_CLIP_MAX));
    for (int i = 0; i < count; i++) {
        if (v[i].pose[1].distance != 0)
            continue;
        int at = found++;
        while (at > 0 && comes_after(&out[at - 1].now, &v[i].now)) {
            out[at] = out[at - 1];
            at--;
        }
        out[at] = v[i];
    }
    return found;
}

static void test_both_triangles_at_an_edge_get_the_same_new_vertices(void)
{
    random_state = 7;
    int compared = 0, differ = 0;
    for (int n = 0; n < 400; n++) {
        struct smear_depths p = n % 5 == 4 ? lens(true) : coarse_lens(n % 5 == 3 ? between(1, 11) : 0);
        struct smear_clip_vertex a = random_vertex(p.orthographic), b = random_vertex(p.orthographic);
        struct smear_clip_vertex c = random_vertex(p.orthographic), d = random_vertex(p.orthographic);
        if (n & 1) {        /* mostly in view: one end of the edge */
            int32_t w = between(NEAR_AT, FAR_AT);
            a.now = vertex_within(w, 300, p.orthographic).now;
            c.now = vertex_within(w, 50, p.orthographic).now;
            d.now = vertex_within(w, 50, p.orthographic).now;
        }
        /* From the one side and the other, walked from each corner in both directions. */
        struct smear_clip_vertex first[SMEAR_CLIP_MAX], other[SMEAR_CLIP_MAX];
        int count = on_edge(first, a, b, c, 0, &p);
        for (int turn = 1; turn < 12; turn++) {
            bool swap = turn & 1;
            int found = on_edge(other, swap ? b : a, swap ? a : b, turn < 6 ? c : d, turn % 6, &p);
            if (turn >= 6 && (found == 2) != (count == 2))
                differ++;       /* one vertex alone is a new one so near the edge that its mark is 0 */
            if (turn < 6 && !CHECK_EQ(found, count))
                return;
            for (int i = 0; i < count && found == count; i++)
                REQUIRE(same_vertex(&first[i], &other[i]));
            compared += found == count && count == 2 && turn >= 6;
        }
    }
    CHECK_EQ(differ, 0);
    CHECK(compared > 60);
}

static void test_nothing_is_left_outside(void)
{
    random_state = 8;
    int most = 0;
    for (int n = 0; n < 3000; n++) {
        struct smear_depths p = n % 4 == 3 ? lens(true) : coarse_lens(n % 4 == 2 ? between(1, 11) : 0);
        struct smear_clip_vertex v[SMEAR_CLIP_MAX];
        int codes = 0;
        for (int i = 0; i < 3; i++) {
            v[i] = random_vertex(p.orthographic);
            codes |= codes_of(&v[i], &p);
        }
        int count = clip(v, &p, codes);
        REQUIRE(count == 0 || (count >= 3 && count <= SMEAR_CLIP_MAX));
        most = count > most ? count : most;
        for (int i = 0; i < count; i++) {
            const struct smear_homogeneous *h = &v[i].now;
            /* Cutting at a side rounds what was cut at the planes before by a step. */
            const int64_t sides = SMEAR_GUARD_PX >> p.coarse, slack = 2 + sides * 2;
            const int64_t guard = (int64_t)h->w * sides + slack;
            if (!CHECK(h->w > 0) || !CHECK(h->distance >= NEAR_AT - 2) || !CHECK(h->distance <= FAR_AT + 64)
                || !CHECK(h->x <= guard && h->x >= -guard && h->y <= guard && h->y >= -guard))
                return;
        }
    }
    CHECK(most >= 6);
}

/* A polygon that has as many corners as there is room for, in and out by turns as no convex one is: no plane leaves more,
 * every corner has a vertex of its own, and those of the triangle stay as they are. */
static void test_a_full_polygon_never_outgrows_its_room(void)
{
    random_state = 17;
    for (int n = 0; n < 4000; n++) {
        const struct smear_depths p = lens(false);
        struct smear_clip_polygon polygon;
        struct smear_clip_vertex own[3];
        smear_clip_start(&polygon, CLIP_POSES, true);
        polygon.count = between(3, SMEAR_CLIP_MAX);
        for (int i = 0; i < SMEAR_CLIP_MAX; i++) {
            polygon.order[i] = (uint8_t)i;
            polygon.vertex[i] = vertex_within(chance(3) ? NEAR_AT - between(1, 1000) : between(NEAR_AT, FAR_AT), 1, false);
        }
        for (int i = 0; i < 3; i++)
            own[i] = polygon.vertex[i];
        smear_clip_polygon(&polygon, &p, OUT_NEAR);
        REQUIRE(polygon.count <= SMEAR_CLIP_MAX);
        uint32_t seen = 0;
        for (int i = 0; i < polygon.count; i++)
            if (!CHECK(polygon.order[i] < SMEAR_CLIP_ROOM) || !CHECK((seen >> polygon.order[i] & 1u) == 0))
                return;
            else
                seen |= 1u << polygon.order[i];
        for (int i = 0; i < 3; i++)
            REQUIRE(same_vertex(&own[i], &polygon.vertex[i]));
        for (int i = 0; i < polygon.count; i++)
            REQUIRE(clip_corner(&polygon, i)->now.distance >= NEAR_AT);
    }
}

#include "build/suites/clip.h"
