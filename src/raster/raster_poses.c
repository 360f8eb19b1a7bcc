/* SPDX-License-Identifier: MIT */
/* raster_poses.c - eight triangles at an instant: tiny ones together, edges and depth planes of the others together, too. */
#include "raster/raster_poses.h"

#include "raster/cover_tiny8.h"
#include "raster/looks8.h"

#if SMEAR_AVX2

/* False where the texture's bits are not told by shifts of mesh units. */
static inline bool find_look_of_texture(struct tiny8_look *l, const struct smear_sampler *m)
{
    if (!m->turns || m->levels != 0)
        return false;
    l->texels = m->texels;
    l->palette = m->palette;
    l->format = m->format;
    l->from_u = 15 + m->uv_shift - m->log2_width;
    l->from_v = l->from_u - m->log2_height;
    l->mask_u = (1u << m->log2_width) - 1u;
    l->mask_v = ((1u << m->log2_height) - 1u) << m->log2_width;
    l->width = (uint32_t)m->width;
    l->height = (uint32_t)m->height;
    l->span = ((uint32_t)max_i32(m->width, m->height) << 16 >> m->uv_shift) + 1u;
    l->uv_shift = m->uv_shift;
    return l->from_v >= 0;
}

/* Tells what triangles of a segment have in common. False where they are drawn one by one. */
static bool find_look(struct tiny8_look *l, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                      const struct smear_segment *segment)
{
    const struct smear_raster_draw *draw = &frame->draw[segment->draw];
    const struct smear_plane_rows *rows = &t->window_rows;
    if (!draw_is_opaque(draw) || segment_moves(segment) != 0)
        return false;
    l->vertex = bins_vertex(frame->bins, segment, 0);
    l->color = segment_gouraud(segment) ? segment->color : 0;
    l->perspective = !segment_flat_depth(segment);
    l->even = l->perspective && segment_by_vertices(segment);
    l->linear = frame_is_linear(frame);
    l->narrow = target_is_direct(t);
    l->x0 = t->x0;
    l->y0 = t->y0;
    l->x1 = t->x1;
    l->y1 = t->y1;
    l->at = target_row(rows, t, t->y0) - t->y0 * rows->stride;
    l->stride = rows->stride;
    l->most = SMALL_PX;
    l->kind = segment_gouraud(segment) ? TINY8_SHADED : TINY8_FLAT;
    if (!segment_textured(segment))
        return true;
    l->most = SMALL_TEXTURED_PX;
    l->white = segment->shade == SHADE_NONE;
    l->linear = l->linear && !l->white;
    l->kind = TINY8_LIT;
    if (l->white && draw->sampler.format == (l->narrow ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888))
        l->kind = TINY8_COPIED;
    return find_look_of_texture(l, &draw->sampler);
}

bool smear_raster_look(struct tiny8_look *look, const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                       const struct smear_segment *segment)
{
    return !frame_has_fog(frame) && tiny8_suit(target) && find_look(look, frame, target, segment);
}

/* Vertex i of triangle k. */
static inline const int32_t *record_of(struct poses *p, int k, int i)
{
    if (!p->has_records)
        smear_poses_records_avx2(p);
    return p->record[k][i];
}

static inline struct bounds bounds_of(const struct poses *p, int k)
{
    return (struct bounds){ p->bounds[0][k], p->bounds[1][k], p->bounds[2][k], p->bounds[3][k] };
}

/* Makes the pixels of tiny ones, of which there is one at least, in their order; where they are fewer than eight, the first
 * fills the rest. */
static void make_tiny(struct tiny8_pixels *pixels, const struct tiny8_look *look, const uint32_t color[8], struct poses *poses,
                      uint32_t tiny)
{
    struct tiny8_look l = *look;
    uint16_t vertex[8][4];
    uint32_t colors[8];
    const int first = __builtin_ctz(tiny);
    for (int n = 0; n < 8; n++, tiny &= tiny - 1) {
        const int k = tiny != 0 ? __builtin_ctz(tiny) : first;
        for (int i = 0; i < 3; i++)
            vertex[n][i] = (uint16_t)((3 * k + i) * POSES_RECORD);
        colors[n] = color[k];
    }
    l.vertex = record_of(poses, 0, 0);
    smear_tiny8_avx2(pixels, &l, (const uint16_t(*)[4])vertex, colors);
}

/* Eight triangles. */
struct eight {
    const struct raster_eights *common;
    struct poses *poses;
    const uint32_t *color;
    struct planes8 planes;
    struct looks8 looks;
    struct flat_eight faces;
    bool has_looks, has_faces;      /* they are made */
};

static inline enum depth_slope slope_of(const struct planes8 *p, int k)
{
    return (p->far >> k & 1u) != 0 ? SLOPE_FAR : (p->near >> k & 1u) != 0 ? SLOPE_NEAR : SLOPE_BOTH;
}

/* Draws triangles of these, which have one colour each. */
static inline void draw_flat(struct eight *e, uint32_t which, const uint32_t color[8])
{
    if (!e->has_faces)
        smear_flat_eight_make_avx2(&e->faces, &e->common->area, e->poses, &e->planes, color);
    e->has_faces = true;
    smear_flat_eight_draw_avx2(&e->faces, &e->common->area, which);
}

/* Draws triangle k of those that are `known`; false where its size has it drawn otherwise. */
static bool draw_known(struct eight *e, int k, uint32_t known)
{
    const struct smear_raster_frame *const frame = e->common->frame;
    const struct smear_raster_target *const target = e->common->target;
    const struct smear_segment *const segment = e->common->segment;
    const struct planes8 *const planes = &e->planes;
    const struct bounds b = bounds_of(e->poses, k);
    const struct pixel_box whole = { (b.x0 + 127) >> 8, (b.x1 + 127) >> 8, (b.y0 + 127) >> 8, (b.y1 + 127) >> 8 };
    const int32_t width = whole.right - whole.left, height = whole.bottom - whole.top;
    const bool textured = segment_textured(segment);
    const bool small = max_i32(width, height) <= (textured ? SMALL_TEXTURED_PX : SMALL_PX);
    if (small && (textured || width * height <= TINY_PIXELS))
        return false;
    if (!e->has_looks)
        smear_looks8_avx2(&e->looks, frame, segment, e->poses, planes, known);
    e->has_looks = true;
    if ((e->looks.flat >> k & 1u) != 0 && e->common->area.pixels != NULL) {
        draw_flat(e, 1u << k, segment_gouraud(segment) ? e->looks.color : e->color);
        return true;
    }
    struct setup s;
    s.frame = frame;
    s.target = target;
    s.segment = segment;
    s.draw = &frame->draw[segment->draw];
    for (int i = 0; i < 3; i++)
        s.v[i] = record_of(e->poses, k, i);
    s.bounds = b;
    s.x1 = planes->x1[k];
    s.y1 = planes->y1[k];
    s.x2 = planes->x2[k];
    s.y2 = planes->y2[k];
    s.area_recip = planes->area_recip[k];
    s.area_zeros = planes->area_zeros[k];
    s.slope = slope_of(planes, k);
    s.depth = (struct plane){ planes->at[k], planes->dx[k], planes->dy[k] };
    s.color = e->color[k];
    s.writes_velocity = s.velocity_unknown = false;
#if SMEAR_WITH_FOG
    s.fog = FOG_NONE;
#endif
    const struct pixel_box box = { whole.left, whole.right, max_i32(whole.top, target->y0), min_i32(whole.bottom, target->y1) };
    smear_looks8_take(&s, &e->looks, k);
    smear_cover_choose(&s, small);
    smear_cover(&s, &box, small);
    return true;
}

/* Where flat faces are drawn by a kernel: the target's rows lie one behind the other. */
static struct flat_area area_of(const struct smear_raster_target *target)
{
    const struct smear_plane_rows *const w = &target->window_rows;
    const int32_t rows = target->y1 - target->y0, at = w->ring_row * w->stride - w->x0;
    struct flat_area a = { .stride = w->stride, .x0 = target->x0, .x1 = target->x1, .y0 = target->y0, .y1 = target->y1,
                           .narrow = target_is_direct(target) };
    if (target->x1 - target->x0 >= FLAT_FACE_LEAST && rows <= FLAT_FACE_ROWS && w->ring_row + rows <= w->ring) {
        a.pixels = a.narrow ? (void *)(target->direct + at) : target->color + at;
        a.depth = target->depth + at;
    }
    return a;
}

/* Whether triangles of a segment may be drawn by draw_known. */
static bool suits(const struct smear_raster_frame *frame, const struct smear_raster_target *target, const struct smear_segment *segment)
{
    return !frame_has_fog(frame) && !target_has_velocity(target) && segment_moves(segment) == 0
        && !(SMEAR_WITH_BOUNDS && segment_textured(segment) && frame->draw[segment->draw].sampler.levels != 0);
}

void smear_raster_eights_make(struct raster_eights *r, const struct smear_raster_frame *frame,
                              const struct smear_raster_target *target, const struct smear_segment *segment)
{
    r->frame = frame;
    r->target = target;
    r->segment = segment;
    r->area = area_of(target);
    r->has_look = smear_raster_look(&r->look, frame, target, segment);
    r->suits = suits(frame, target, segment);
    r->flat = r->suits && r->has_look && r->look.kind == TINY8_FLAT && r->area.pixels != NULL;
}

/* Draws all that are seen, of one colour each. */
static SMEAR_NOINLINE void draw_all_flat(const struct raster_eights *r, const uint32_t color[8], const struct poses *poses)
{
    struct planes8 planes;
    struct flat_eight faces;
    smear_planes8_avx2(&planes, poses, SLOPE_BREAK);
    smear_flat_eight_make_avx2(&faces, &r->area, poses, &planes, color);
    smear_flat_eight_draw_avx2(&faces, &r->area, poses->seen);
}

/* Draws them by what they are. */
static SMEAR_NOINLINE void draw_each(const struct raster_eights *r, const uint32_t color[8], struct poses *poses)
{
    struct tiny8_pixels pixels;
    struct eight eight;
    const uint32_t tiny = r->has_look && (poses->tiny & (poses->tiny - 1)) != 0 ? poses->tiny : 0;    /* one costs less alone */
    const uint32_t alone = r->suits ? poses->tiny : poses->seen, flat = r->flat ? poses->seen & ~alone : 0;
    int32_t start = 0, n = 0;
    if (tiny != 0)
        make_tiny(&pixels, &r->look, color, poses, tiny);
    eight.common = r;
    eight.poses = poses;
    eight.color = color;
    eight.has_looks = eight.has_faces = false;
    if ((poses->seen & ~alone) != 0)
        smear_planes8_avx2(&eight.planes, poses, SLOPE_BREAK);
    for (uint32_t rest = poses->seen; rest != 0; rest &= rest - 1) {
        const uint32_t others = rest & ~flat, first = others & (0u - others);
        if ((rest & (first - 1u)) != 0)         /* flat ones that come before */
            draw_flat(&eight, rest & (first - 1u), color);
        rest &= ~(first - 1u);
        if (rest == 0)
            break;
        const int k = __builtin_ctz(rest);
        if ((tiny >> k & 1u) != 0) {
            const int32_t from = start, i = n++;
            start = pixels.end[i];
            if ((pixels.taken >> i & 1u) != 0) {
                tiny8_put(r->target, &r->look, &pixels, from, start);
                continue;
            }
        }
        if ((alone >> k & 1u) == 0 && draw_known(&eight, k, poses->seen & ~alone))
            continue;
        const int32_t *const v[3] = { record_of(poses, k, 0), record_of(poses, k, 1), record_of(poses, k, 2) };
        const struct bounds bounds = bounds_of(poses, k);
        smear_raster_triangle(r->frame, r->target, r->segment, color[k], v, &bounds);
    }
}

void smear_raster_poses(const struct raster_eights *r, const uint32_t color[8], struct poses *poses)
{
    if (r->flat && poses->tiny == 0)
        draw_all_flat(r, color, poses);
    else
        draw_each(r, color, poses);
}

#endif
