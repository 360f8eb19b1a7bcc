/* SPDX-License-Identifier: MIT */
/* polygons.c - which corners a cut keeps, makes and frees depends on their number and on the set of those outside alone:
 * all such sets of all polygons there may be, 8,184 cuts. Each leaves at most SMEAR_CLIP_MAX corners, none of them outside,
 * and an order that names every vertex once, so that any cut may follow it. A place out of bounds stops the program. */
#include "geometry/clip.c"

#include <stdio.h>

enum { NEAR = 1 << 20 };

static bool names_all_once(const struct smear_clip_polygon *p)
{
    uint32_t named = 0;
    for (int i = 0; i < SMEAR_CLIP_ROOM; i++)
        named |= 1u << p->order[i];
    return named == (1u << SMEAR_CLIP_ROOM) - 1;
}

/* How many edges of the polygon cross the plane. */
static int crossings(int count, uint32_t outside)
{
    int crossed = 0;
    for (int i = 0; i < count; i++)
        crossed += (outside >> i & 1u) != (outside >> (i + 1) % count & 1u);
    return crossed;
}

/* Cuts `count` corners of which those in `outside` lie behind the plane. Returns whether all is as it should be. */
static bool cuts_well(int count, uint32_t outside)
{
    static const struct smear_depths depths = { .near_distance = NEAR, .far_distance = INT32_MAX };
    struct smear_clip_polygon p = { 0 };
    smear_clip_start(&p, CLIP_POSES, true, true);
    p.count = count;
    int inside = count;
    for (int i = 0; i < SMEAR_CLIP_ROOM; i++) {
        const int32_t w = i < count && (outside >> i & 1u) ? NEAR - 1000 - i : NEAR + 1000 + i;
        p.vertex[i].now = (struct smear_homogeneous){ i, -i, w, w };
        inside -= i < count && w < NEAR;
    }
    clip_plane(&p, &depths, PLANE_NEAR);
    const int full = inside + crossings(count, outside), most = full < SMEAR_CLIP_MAX ? full : SMEAR_CLIP_MAX;
    bool good = names_all_once(&p) && p.count <= most && p.count >= (inside < 3 ? 0 : inside);
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
        for (uint32_t outside = 0; outside < 1u << count; outside++, tried++)
            if (!cuts_well(count, outside)) {
                fprintf(stderr, "polygons: %d corners, outside %#lx: not cut as stated\n", count, (unsigned long)outside);
                return 1;
            }
    printf("cuts of %d polygons: no place out of bounds, none of too many corners\n", tried);
    return 0;
}
