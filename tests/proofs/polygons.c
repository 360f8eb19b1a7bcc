/* SPDX-License-Identifier: MIT */
/* polygons.c - which corners a cut keeps, makes and frees depends on their number and on the set of those outside alone:
 * all such sets of all polygons there may be, of which some corners are the triangle's own or none, 2,032 cuts. Each leaves at most
 * SMEAR_CLIP_MAX corners, none of them outside and each a vertex of its own, so that any cut may follow it, and the triangle's
 * vertices as they were. A place out of bounds stops the program. */
#include "geometry/clip.c"
#include "geometry/matrix.c"

#include <stdio.h>

enum { NEAR = 1 << 20 };

/* Whether every corner is a vertex of its own, and the triangle's are where they were. */
static bool names_each_once(const struct smear_clip_polygon *p)
{
    uint32_t named = 0;
    bool good = true;
    for (int i = 0; i < p->count; i++) {
        good = good && p->order[i] < SMEAR_CLIP_ROOM && (named >> p->order[i] & 1u) == 0;
        named |= 1u << p->order[i];
    }
    for (int i = 0; i < 3; i++)
        good = good && p->vertex[i].now.x == i;
    return good;
}

/* How many edges of the polygon cross the plane. */
static int crossings(int count, uint32_t outside)
{
    int crossed = 0;
    for (int i = 0; i < count; i++)
        crossed += (outside >> i & 1u) != (outside >> (i + 1) % count & 1u);
    return crossed;
}

/* Cuts `count` corners, of which the first is vertex `first` and those in `outside` lie behind the plane. Returns whether all is as
 * it should be. */
static bool cuts_well(int count, int first, uint32_t outside)
{
    static const struct smear_depths depths = { .near_distance = NEAR, .far_distance = INT32_MAX };
    struct smear_clip_polygon p = { 0 };
    smear_clip_start(&p, CLIP_POSES, true);
    p.count = count;
    int inside = count;
    for (int i = 0; i < SMEAR_CLIP_ROOM; i++) {
        const int corner = i - first;
        const bool is_corner = corner >= 0 && corner < count;
        const int32_t w = is_corner && (outside >> corner & 1u) ? NEAR - 1000 - i : NEAR + 1000 + i;
        p.vertex[i].now = (struct smear_homogeneous){ i, -i, w, w };
        inside -= w < NEAR;
        if (is_corner)
            p.order[corner] = (uint8_t)i;
    }
    clip_plane(&p, &depths, PLANE_NEAR);
    const int full = inside + crossings(count, outside), most = full < SMEAR_CLIP_MAX ? full : SMEAR_CLIP_MAX;
    bool good = names_each_once(&p) && p.count <= most && p.count >= (inside < 3 ? 0 : inside);
    if (crossings(count, outside) <= 2 && full <= SMEAR_CLIP_MAX)   /* a convex polygon loses nothing */
        good = good && p.count == (full < 3 ? 0 : full);
    for (int i = 0; i < p.count; i++)
        good = good && !is_outside(clip_corner(&p, i), &depths, PLANE_NEAR);
    return good;
}

int main(void)
{
    int tried = 0;
    for (int count = 3; count <= SMEAR_CLIP_MAX; count++)
        for (uint32_t outside = 0; outside < 1u << count; outside++)
            for (int first = 0; first <= 3; first += 3, tried++)
                if (!cuts_well(count, first, outside)) {
                    fprintf(stderr, "polygons: %d corners from %d on, outside %#lx: not cut as stated\n", count, first,
                            (unsigned long)outside);
                    return 1;
                }
    printf("cuts of %d polygons: no place out of bounds, none of too many corners\n", tried);
    return 0;
}
