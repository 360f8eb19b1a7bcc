/* SPDX-License-Identifier: MIT */
/* line_movers.c - see line_movers.h. */
#include "temporal/line_movers.h"

#include "geometry/arc.h"

/* ------------------------------------------------------------------ draws */

/* Whether a draw deforms, or turns by more than some nine degrees: what it shows goes many ways. */
static bool turns(const struct smear_draw_poses *p, const struct smear_shot *shot)
{
    const struct smear_shutter_order at = smear_shot_order(shot);
    return p->position[1] != p->position[0] || p->position[2] != p->position[0]
        || smear_lines_turn(shot, p->object[at.open], p->object[at.middle], 128, 1);
}

/* Finds where a camera is seen from an object, without its scales; false where its axes are askew. */
static bool see_from(smear_transform *out, const smear_transform *camera, const smear_transform *object)
{
    struct smear_axes axes = { { { 0 } }, false, false };
    smear_axes_find(&axes, object);
    for (int i = 0; i < 3; i++) {
        int64_t origin = 0;
        for (int j = 0; j < 3; j++) {
            out->basis[3 * i + j] = narrow_sat(dot_wide(axes.axis[i], 1, camera->basis + j, 3) >> 30);
            origin += ((int64_t)camera->origin[j] - object->origin[j]) * axes.axis[i][j] >> 14;
        }
        out->origin[i] = narrow_sat(origin >> 16);
    }
    return axes.are_square;
}

/* Whether something is farther than an eighth of all that a camera sees, or than 128 near planes where that has no end. */
static bool is_far(const smear_camera *c, uint32_t units)
{
    enum { NEAR_LOG2 = 19, PART_LOG2 = 3, ENDLESS_LOG2 = 7 };       /* units of the near plane */
    if (c->half_height > 0)
        return false;
    return c->far_plane == 0 ? units >> (NEAR_LOG2 - ENDLESS_LOG2) == 0
                             : (int64_t)units * c->far_plane <= (int64_t)c->near_plane << (NEAR_LOG2 + PART_LOG2);
}

/* Returns how a draw goes on the screen, as some of its vertices tell, and whether one picture of it does not do: it goes far, or it shows
 * something else every few pixels and goes less than the shortest line blurs. `passed`: pixels of its box times how far it goes, px; of all
 * the frame where it comes near the eye. */
static enum smear_line_kind kind_of(bool *twice, uint32_t *passed, const struct smear_flow *own, const struct smear_lines *lines,
                                    const struct smear_placement *place, const struct smear_window *w, const smear_mesh *mesh,
                                    const smear_camera *camera)
{
    enum { SAMPLES = 8, ALIKE = 384, STILL = 128, PARALLAX = 4 * 256, FAR = 8 * 256, SHORT = 384,     /* q8 px */
           FINE_LOG2 = 4,               /* px of its box per vertex */
           LONGEST = 1023 };            /* px */
    const struct smear_viewport viewport = { w->width, w->height };
    int32_t apart = 0, way = 0, x0 = INT32_MAX, y0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
    bool seen = false, behind = true, near = false;
    for (uint32_t i = 0; i < mesh->vertex_count; i += 1u + mesh->vertex_count / SAMPLES) {
        struct smear_screen s;
        int32_t a[2], b[2], c[2];
        const int out = placement_project(&s, place, i, &viewport);
        near = near || (out & OUT_NEAR) != 0;
        if ((out & (OUT_NEAR | OUT_GUARD)) != 0)
            continue;           /* what goes round the camera is seen in part */
        seen = true;
        x0 = min_i32(x0, s.x >> 8);
        x1 = max_i32(x1, s.x >> 8);
        y0 = min_i32(y0, s.y >> 8);
        y1 = max_i32(y1, s.y >> 8);
        smear_flow_at(own, s.x >> 8, s.y >> 8, (uint32_t)s.depth >> 11, a);
        smear_flow_at(&lines->flow, s.x >> 8, s.y >> 8, (uint32_t)s.depth >> 11, b);
        smear_flow_at(&lines->flow, s.x >> 8, s.y >> 8, 0, c);
        behind = behind && max_i32(abs_i32(c[0] - b[0]), abs_i32(c[1] - b[1])) <= PARALLAX && is_far(camera, (uint32_t)s.depth >> 11);
        apart = max_i32(apart, max_i32(abs_i32(a[0] - b[0]), abs_i32(a[1] - b[1])));
        way = max_i32(way, max_i32(abs_i32(a[0]), abs_i32(a[1])));
    }
    const int32_t columns = seen ? max_i32(min_i32(x1, w->width) - max_i32(x0, 0), 0) : 0,
                  rows = seen ? max_i32(min_i32(y1, w->height) - max_i32(y0, 0), 0) : 0;
    *passed = near ? UINT32_MAX : (uint32_t)(columns * rows) * min_u32((uint32_t)way >> 8, LONGEST);
    *twice = !seen || way > FAR || (way < SHORT && (uint32_t)((x1 - x0) * (y1 - y0)) >> FINE_LOG2 < mesh->vertex_count);
    return !seen ? LINE_MOVES : apart <= ALIKE ? LINE_GOES_ALONG : way > STILL ? LINE_MOVES : behind ? LINE_IS_BEHIND : LINE_IS_STILL;
}

bool smear_movers_take(struct smear_lines *lines, struct smear_draw_poses *p, const struct smear_shot *shot, const struct smear_window *w,
                       const smear_mesh *mesh, uint32_t draw)
{
    smear_camera camera[3];
    struct smear_placement place;
    if (turns(p, shot))
        return false;
    for (int i = 0; i < 3; i++) {
        camera[i] = *p->camera[i];
        if (!see_from(&camera[i].pose, &p->camera[i]->pose, p->object[i]))
            return false;
    }
    smear_lines_make_flow(&lines->own[draw], shot, w, camera);
    smear_draw_poses_place(&place, p, shot, mesh, &lines->mover_instant[0]);
    bool twice;
    uint32_t passed;
    const enum smear_line_kind kind = kind_of(&twice, &passed, &lines->own[draw], lines, &place, w, mesh, &shot->camera[0]);
    if (kind != LINE_GOES_ALONG && !lines->takes_movers)
        return false;
    if (kind == LINE_MOVES && passed > lines->room) {
        lines->measures = true;
        return false;
    }
    lines->room -= kind == LINE_MOVES ? passed : 0;
    lines->kind[draw] = (uint8_t)kind;
    lines->movers = (uint16_t)(lines->movers + (kind != LINE_GOES_ALONG));
    lines->behind = (uint16_t)(lines->behind + (kind == LINE_IS_BEHIND));
    if (kind == LINE_MOVES && twice && !lines->twice) {
        lines->twice = true;
        smear_lines_take(lines, shot, lines->pictures);
    }
    return true;
}

/* ------------------------------------------------------------------ blocks */

static struct smear_line_block *block_of(const struct smear_lines *lines, const struct smear_window *w, int32_t x, int32_t y)
{
    return &lines->block[((y & (w->tile - 1)) >> LINE_BLOCK_LOG2) * line_blocks(w->width) + (x >> LINE_BLOCK_LOG2)];
}

static int32_t blocks_in(const struct smear_window *w) { return line_blocks(w->width) * line_blocks(w->tile); }

void smear_movers_begin(const struct smear_lines *lines, const struct smear_window *w)
{
    __builtin_memset(lines->block, 0, (size_t)blocks_in(w) * sizeof *lines->block);
}

void smear_movers_next(const struct smear_lines *lines, const struct smear_window *w)
{
    for (int32_t i = 0; i < blocks_in(w); i++)
        lines->block[i].depth = lines->block[i].mover = 0;
}

/* Returns the depth of a block, as every other pixel tells it along x and y. */
static SMEAR_NOINLINE uint16_t look(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t y0, int32_t y1)
{
    const uint16_t *now = line_depth(lines, w, x0, y0);
    const int32_t columns = min_i32(w->width - x0, LINE_BLOCK);
    int32_t at = window_ring_row(w, y0);
    uint32_t nearest = 1;
    for (int32_t y = y0; y < min_i32(y0 + LINE_BLOCK, y1); y += 2, at += 2, now += 2 * w->width) {
        at -= at >= w->ring ? w->ring : 0;
        const uint16_t *const still = w->depth + at * w->width + x0;
        for (int32_t x = 0; x < columns; x += 2)
            if (now[x] != still[x])
                nearest = max_u32(nearest, now[x]);
    }
    return (uint16_t)nearest;
}

/* Makes a block's depth known. */
static inline struct smear_line_block *looked_at(struct smear_line_block *b, const struct smear_lines *lines, const struct smear_window *w,
                                                 int32_t x, int32_t y, int32_t y1)
{
    if (b->depth == 0)
        b->depth = look(lines, w, x, y, y1);
    return b;
}

/* A box of pixels and of depths, which are units. */
struct extent {
    int32_t low[3], high[3];
};

static void find_extent(struct extent *e, const struct smear_bins *g, const struct smear_segment *s, const struct smear_triangle *t)
{
    *e = (struct extent){ { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
    for (int i = 0; i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]);
        for (int axis = 0; axis < 3; axis++) {
            const int32_t at = v[axis] >> (axis == VERTEX_DEPTH ? 11 : 8);
            e->low[axis] = min_i32(e->low[axis], at);
            e->high[axis] = max_i32(e->high[axis], at);
        }
    }
}

/* Notes that a block goes so, and so do those before and behind it that it passes, if nothing else is seen there. */
static void mark(const struct smear_lines *lines, const struct smear_window *w, const int32_t d[2], int32_t x, int32_t y, int32_t y0,
                 int32_t y1)
{
    const int32_t steps = (max_i32(abs_i32(d[0]), abs_i32(d[1])) + 2 * LINE_BLOCK * 256 - 1) >> (LINE_BLOCK_LOG2 + 9);
    for (int32_t i = -steps; i <= steps; i++) {
        const int32_t left = x + ((steps > 1 ? d[0] * i / steps : d[0] * i) >> 9),
                      up = y + ((steps > 1 ? d[1] * i / steps : d[1] * i) >> 9);
        for (int32_t by = max_i32(up, y0) & -LINE_BLOCK; by < min_i32(up + LINE_BLOCK, y1); by += LINE_BLOCK)
            for (int32_t bx = max_i32(left, 0) & -LINE_BLOCK; bx < min_i32(left + LINE_BLOCK, w->width); bx += LINE_BLOCK) {
                struct smear_line_block *b = looked_at(block_of(lines, w, bx, by), lines, w, bx, by, y1);
                if ((bx == x && by == y) || b->depth <= 1)
                    b->x = (int16_t)(d[0] >> 8), b->y = (int16_t)(d[1] >> 8);
            }
    }
}

void smear_movers_find(const struct smear_lines *lines, const struct smear_bins *g, const struct smear_window *w, uint32_t head, int32_t y0,
                       int32_t y1)
{
    enum { ROUNDED = 17 };          /* by so many units at most */
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = bins_triangle(g, i)->next) {
        const struct smear_triangle *t = bins_triangle(g, i);
        const struct smear_segment *s = &g->segment[t->segment];
        struct extent e;
        if (lines->kind[s->draw] != LINE_MOVES)
            continue;
        find_extent(&e, g, s, t);
        const int32_t left = max_i32(e.low[0], 0) & -LINE_BLOCK, right = min_i32(e.high[0] + 1, w->width);
        for (int32_t y = max_i32(e.low[1], y0) & -LINE_BLOCK; y < min_i32(e.high[1] + 1, y1); y += LINE_BLOCK) {
            struct smear_line_block *b = block_of(lines, w, left, y);
            for (int32_t x = left; x < right; x += LINE_BLOCK, b++) {
                int32_t d[2];
                if (looked_at(b, lines, w, x, y, y1)->depth <= 1 || b->mover == s->draw + 1)
                    continue;
                const int32_t units = (int32_t)smear_depth_units(b->depth);
                if (units < e.low[2] - ROUNDED || units > e.high[2] + ROUNDED)
                    continue;
                smear_lines_displacement(d, line_mover_pictures(lines), &lines->own[s->draw], w, min_i32(x + LINE_BLOCK / 2, w->width - 1),
                                         min_i32(y + LINE_BLOCK / 2, y1 - 1), b->depth);
                mark(lines, w, d, x, y, y0, y1);
                b->mover = (uint16_t)(s->draw + 1);
            }
        }
    }
}

/* Copies what lines of blocks with movers may meet. */
static void copy_met(const struct smear_lines *lines, const struct smear_window *w, int32_t y0, int32_t y1)
{
    int32_t left = w->width, right = 0;
    for (int32_t y = y0; y < y1; y += LINE_BLOCK)
        for (int32_t x = 0; x < w->width; x += LINE_BLOCK) {
            const struct smear_line_block *const b = block_of(lines, w, x, y);
            if ((b->x | b->y) == 0)
                continue;
            left = min_i32(left, x - abs_i32(b->x));
            right = max_i32(right, x + LINE_BLOCK + abs_i32(b->x));
        }
    left = max_i32(left, 0);
    right = min_i32(right, w->width);
    for (int32_t at = (y0 & (w->tile - 1)) * w->width + left, y = y0; y < y1 && left < right; y++, at += w->width)
        __builtin_memcpy(lines->over + at, lines->row + at, (size_t)(right - left) * sizeof *lines->over);
}

void smear_movers_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t y0, int32_t y1)
{
    struct smear_window over = *w;
    copy_met(lines, w, y0, y1);
    over.color = lines->over;
    over.ring = w->tile;
    for (int32_t y = y0; y < y1; y += LINE_BLOCK)
        for (int32_t x = 0, right; x < w->width; x = right) {
            const struct smear_line_block b = *block_of(lines, w, x, y);
            const int32_t d[2] = { b.x * 256, b.y * 256 };
            for (right = x + LINE_BLOCK; right < w->width; right += LINE_BLOCK)
                if (block_of(lines, w, right, y)->x != b.x || block_of(lines, w, right, y)->y != b.y)
                    break;
            if ((b.x | b.y) != 0)
                smear_lines_blur_blocks(lines, &over, d, x, min_i32(right, w->width), y, min_i32(y + LINE_BLOCK, y1), y0, y1);
        }
}
