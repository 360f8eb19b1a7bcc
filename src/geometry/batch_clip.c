/* SPDX-License-Identifier: MIT */
/* batch_clip.c - triangles that reach beyond the near or far plane or the guard band, and where vertices are in other
 * poses. */
#include "geometry/batch.h"

#include "geometry/clip.h"
#include "base/fixmath.h"

bool smear_batch_is_damaged(const struct smear_damaged_tiles *d, const struct box *box)
{
    const struct smear_tile_box tiles = tile_box_of(d, box->x0, box->x1, box->y0, box->y1);
    if (d->seen != NULL)
        tile_box_add(d->seen, tiles);
    return !d->only || tile_box_is_damaged(d, tiles);
}

static SMEAR_PRODUCT_CALL uint32_t displaced(int32_t there, int32_t ratio, int32_t now)
{
    const int32_t far_out = (1 << 27) - 1;
    return (uint32_t)clamp_i32(narrow_sat(there - (mul_wide(ratio, now) >> 20)), -far_out, far_out);
}

static int32_t over_w(int32_t a, int32_t r, int shift) { return scale_sat(mulh_i32(a, r), clamp_i32(shift, -31, 31)); }

/* Stores the words of MOTION_*: the point of the surface that is at `screen`, as far away as w, is at `h` in another pose. */
static SMEAR_NOINLINE void store_pose(uint32_t *out, const struct smear_assembly *d, int pose, const struct smear_homogeneous *h,
                                      int32_t w, int w_scale, const struct smear_screen *screen, const struct smear_viewport *viewport)
{
    /* x' / w in q8 and w' / w in q20; the pose's rows have a scale of their own. */
    int scale = w_scale - d->motion.measured.pose[pose].scale;
    int zeros = count_leading_zeros((uint32_t)w);
    int32_t r = (int32_t)recip_norm((uint32_t)w << zeros);              /* 2^(61 - zeros) / w */
    /* Rows stay below 2^30; small meshes leave more room, which the high products need. */
    int up = count_leading_zeros((uint32_t)(abs_i32(h->x) | abs_i32(h->y) | abs_i32(h->w) | 1)) - 1;
    int shift = zeros - 29 + scale - up;
    int32_t x = over_w(shl_wrap(h->x, up), r, shift + 8), y = over_w(shl_wrap(h->y, up), r, shift + 8);
    int32_t ratio = over_w(shl_wrap(h->w, up), r, shift + 20);
    out[MOTION_DX] = displaced(x, ratio, screen->x - viewport->width * 128);
    out[MOTION_DY] = displaced(y, ratio, screen->y - viewport->height * 128);
    out[MOTION_RATIO] = (uint32_t)ratio;
}

void smear_batch_store_motion(uint32_t *out, const struct batch *b, uint32_t index, const struct smear_screen *screen)
{
    const struct smear_assembly *d = b->d;
    struct smear_homogeneous h, now;
    placement_transform(&now, &d->at, index);
    for (int pose = 0; pose < segment_moves(b->segment); pose++) {
        pose_transform(&h, d, pose, index);
        store_pose(out + pose * MOTION_WORDS, d, pose, &h, now.w, d->at.now.scale, screen, &b->a->viewport);
    }
}

/* What clipping leaves of a triangle. */
struct clipped {
    struct smear_clip_polygon polygon;
    struct smear_screen screen[SMEAR_CLIP_MAX];
    struct smear_face face;
    int64_t area;               /* twice the polygon's area, positive when it is clockwise on the screen */
};

/* Clips the triangle, its vertices shaded as those of c->face, and projects what is left. */
static void clip_and_project(struct clipped *c, const struct batch *b, const struct smear_cached_vertex *const corner[3])
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const int poses = SMEAR_WITH_RECONSTRUCT ? d->moves : 0;
    const struct smear_screen *own[3];
    for (int i = 0; i < 3; i++) {
        struct smear_clip_vertex *v = &c->polygon.vertex[i];
        const uint32_t index = index_of(corner[i]);
        placement_transform(&v->now, &b->fine, index);
        own[i] = (corner[i]->outcode & OUT_NEAR) != 0 ? NULL : &corner[i]->screen;
        for (int pose = 0; pose < poses; pose++)
            pose_transform(&v->pose[pose], d, pose, index);
        smear_vertex_for_clipping(v, d, s, index, &c->face);
    }
    smear_clip_start(&c->polygon, poses, segment_colored(s));
    smear_clip_polygon(&c->polygon, &b->fine.now.depths, corner[0]->outcode | corner[1]->outcode | corner[2]->outcode);
    clip_project(c->screen, &c->polygon, own, &b->fine.now.depths, &b->a->viewport);
    c->area = 0;
    for (int i = 2; i < c->polygon.count; i++)
        c->area += area_of(&c->screen[0], &c->screen[i - 1], &c->screen[i]);
}

/* Stores corner i of the polygon; returns the offset of its record in the segment. */
static uint16_t store_corner(const struct batch *b, struct clipped *c, int i)
{
    const struct smear_segment *s = b->segment;
    const struct smear_clip_vertex *v = clip_corner(&c->polygon, i);
    struct smear_bins *g = b->a->bins;
    const uint32_t word = g->vertex_words;
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    store_place(record, &c->screen[i]);
    smear_vertex_store_clipped(record, s, v);
    for (int pose = 0; pose < segment_moves(s); pose++)
        store_pose(record + s->motion + pose * MOTION_WORDS, b->d, pose, &v->pose[pose], v->now.w, b->fine.now.scale, &c->screen[i],
                   &b->a->viewport);
    return (uint16_t)(word - s->base);
}

/* Adds the triangle of corners 0, i - 1 and i, which clipping left of `triangle`. Returns false where there is no room. */
static bool add_fan(struct batch *b, struct clipped *c, int i, uint32_t triangle)
{
    const struct smear_screen *place[3] = { &c->screen[0], &c->screen[i - 1], &c->screen[i] };
    const int64_t area = area_of(place[0], place[1], place[2]);
    /* Rounding may turn over a sliver of the fan, which then covers nothing that its neighbours do not. */
    if (area == 0 || (area > 0) != (c->area > 0))
        return true;
    struct box box = box_of(place[0], place[1], place[2]);
    box_widen(&box, b->a);
    box_cut(&box, b->a);
    if (box_is_empty(&box) || !is_damaged(b->a, &box))
        return true;
    if (b->parts < parts_before(b->a, triangle)) {
        b->parts++;
        return true;
    }
    struct smear_segment *s = make_room(b->a, b->d, b->segment, 1, 0);
    if (s == NULL)
        return false;
    b->segment = s;
    b->parts++;
    const uint16_t first = store_corner(b, c, 0), second = store_corner(b, c, i - 1), third = store_corner(b, c, i);
    struct smear_bins *g = b->a->bins;
    b->a->triangles_drawn++;
    bins_add(g, b->last + bins_row(g, box.y0), first, c->area > 0 ? second : third, c->area > 0 ? third : second,
             (uint32_t)(s - g->segment), smear_face_color(b->d, s, &c->face));
    return true;
}

static SMEAR_NOINLINE bool add_clipped(struct batch *b, const struct smear_cached_vertex *const corner[3], uint32_t triangle)
{
    struct clipped c;
    const bool colored = segment_colored(b->segment);
    if (colored)
        c.face = smear_face_of(b->d, triangle, false);
    clip_and_project(&c, b, corner);
    const bool back = (c.area > 0) != b->d->mirrored;
    if (c.area == 0 || (back && !b->double_sided))
        return true;
    /* Which side is seen decides the light of vertices, and only the clipped polygon tells: the back is shaded and clipped again. */
    if (!colored || back)
        c.face = smear_face_of(b->d, triangle, back);
    if (colored && back)
        clip_and_project(&c, b, corner);
    for (int i = 2; i < c.polygon.count; i++)
        if (!add_fan(b, &c, i, triangle))
            return false;
    b->parts = 0;
    return true;
}

/* To make the placement takes as much stack as to clip. Where velocities are measured it is rounded as other poses are. */
bool smear_batch_add_clipped(struct batch *b, const struct smear_cached_vertex *const corner[3], uint32_t triangle)
{
    const struct smear_assembly *d = b->d;
    if (b->fine.position == NULL)
        d->place_fine(&b->fine, d, 2, d->moves != 0 ? 0 : projection_coarse(b->a->viewport.height, is_orthographic(&d->at.now)));
    return add_clipped(b, corner, triangle);
}
