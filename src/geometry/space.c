/* SPDX-License-Identifier: MIT */
/* space.c - see space.h. */
#include "geometry/space.h"

#include "base/fixmath.h"
#include "geometry/arc.h"
#include "geometry/shot.h"
#include "geometry/vertex.h"

/* Coordinates of places lie within 2^29, so that sums of four fit: along(). */
enum { PLACE_MOST = 1 << 29 };

void smear_space_make(struct smear_space *space, const struct smear_bins *g, const struct smear_segment *s, int32_t width,
                      int32_t height)
{
    space->segment = s;
    space->turn = g->shot->turn;
    space->phase = INT32_MIN;
    space->viewport = (struct smear_viewport){ width, height };
    smear_depths_make(&space->depths, &g->shot->camera[0], s->scale);
    space->depths.coarse = (uint8_t)projection_coarse(height, segment_flat_depth(s));
}

/* A scene may be so large that a pixel is less than a step of its places: those are cut off far beyond the frame. */
void smear_space_scale(struct smear_homogeneous *h, int up, int distance_up)
{
    h->x = clamp_i32(scale_sat(h->x, up), -PLACE_MOST, PLACE_MOST);
    h->y = clamp_i32(scale_sat(h->y, up), -PLACE_MOST, PLACE_MOST);
    h->w = scale_sat(h->w, up);
    h->distance = scale_sat(h->distance, distance_up);
}

static void store(uint32_t *record, const struct smear_segment *s, const struct smear_homogeneous *h)
{
    SMEAR_ASSERT(abs_i32(h->x) <= PLACE_MOST && abs_i32(h->y) <= PLACE_MOST && abs_i32(h->distance) <= PLACE_MOST);
    record[VERTEX_X] = (uint32_t)h->x;
    record[VERTEX_Y] = (uint32_t)h->y;
    record[VERTEX_DEPTH] = (uint32_t)(segment_flat_depth(s) ? h->distance : h->w);
}

void smear_space_store(uint32_t *record, const struct smear_segment *s, const struct smear_homogeneous *open,
                       const struct smear_homogeneous *middle, const struct smear_homogeneous *close)
{
    store(record, s, middle);
    store(record + s->motion, s, open);
    store(record + s->motion + PATH_POSE_WORDS, s, close);
}

static inline bool space_turns(const struct smear_space *space) { return SMEAR_WITH_CURVES && space->turn != 0; }

/* Finds the shares of (close - open) and of (open + close - 2 middle) at a phase: on the parabola, or on the arc. Being those of all
 * places, they leave what stands still on the screen where it is. */
static SMEAR_RARE void find_phase(struct smear_space *space, int32_t phase)
{
    const int32_t one = 1 << 30, p = phase >> 15;       /* |p| <= 2^15 */
    space->phase = phase;
    space->along = p;
    space->bent = (p * p + (1 << 14)) >> 15;
    if (!space_turns(space))
        return;
    int32_t cosine, sine, whole_cosine, whole_sine;
    smear_turn_cosine_sine((uint32_t)((int64_t)space->turn * phase >> 30), &cosine, &sine);
    smear_turn_cosine_sine(space->turn, &whole_cosine, &whole_sine);
    const int32_t part = ratio_q30(min_i32(abs_i32(sine), whole_sine), whole_sine) >> 15;
    space->along = sine < 0 ? -part : part;
    space->bent = ratio_q30(clamp_i32(one - cosine, 0, one - whole_cosine), one - whole_cosine) >> 15;       /* it is rounded */
}

/* Returns a coordinate on the path from open over middle to close, rounded once to nearest: a floor would move all
 * edges, and at its ends it is what they are. */
static inline int32_t along(int32_t open, int32_t middle, int32_t close, const struct smear_space *space)
{
    const int32_t way = sub_wrap(close, open), bend = add_wrap(add_wrap(open, close), mul_wrap(middle, -2));
    const int32_t high = add_wrap(mul_wrap(way >> 15, space->along), mul_wrap(bend >> 15, space->bent));
    const int32_t low = ((way & 0x7fff) * space->along >> 1) + ((bend & 0x7fff) * space->bent >> 1);
    return add_wrap(middle, add_wrap(high >> 1, (((high & 1) << 14) + low + 0x4000) >> 15));
}

int32_t smear_space_bulge(const struct smear_space *space)
{
    int32_t cosine = 1 << 30, sine;
    if (space_turns(space))
        smear_turn_cosine_sine(space->turn, &cosine, &sine);
    return (1 << 28) / (cosine >> 16);
}

void smear_space_at(struct smear_homogeneous *h, struct smear_space *space, const int32_t *record, int32_t phase)
{
    const int32_t *const open = record + space->segment->motion, *const close = open + PATH_POSE_WORDS;
    if (space->phase != phase)
        find_phase(space, phase);
    h->x = along(open[PATH_X], record[VERTEX_X], close[PATH_X], space);
    h->y = along(open[PATH_Y], record[VERTEX_Y], close[PATH_Y], space);
    h->distance = along(open[PATH_DEPTH], record[VERTEX_DEPTH], close[PATH_DEPTH], space);
    h->w = depths_are_even(&space->depths) ? 1 << (space->segment->flat_depth - 1) : h->distance;
}

/* Projects a place; returns its outcode. One behind the near plane is not projected. */
static int project_place(struct smear_screen *screen, const struct smear_space *space, const struct smear_homogeneous *h)
{
    if (h->distance < space->depths.near_distance)
        return OUT_NEAR;
    smear_project(screen, &space->depths, h, &space->viewport);
    return outcode_sides(screen, &space->viewport) | (h->distance > space->depths.far_distance ? OUT_FAR : 0);
}

static void take_screen(struct path_record *out, const struct smear_screen *screen)
{
    out->word[VERTEX_X] = screen->x;
    out->word[VERTEX_Y] = screen->y;
    out->word[VERTEX_DEPTH] = screen->depth;
}

/* Cuts the triangle as the sharp frame does, in the mesh's order: then the fan has the same triangles. */
static SMEAR_NOINLINE int cut(struct path_record out[SMEAR_CLIP_MAX], const struct smear_screen corner[3],
                              const struct smear_homogeneous place[3], const struct smear_space *space, const int32_t *const record[3],
                              int codes, bool reversed)
{
    const struct smear_screen *own[3];
    struct smear_clip_polygon p;
    struct smear_screen screen[SMEAR_CLIP_MAX];
    for (int i = 0; i < 3; i++) {
        const int k = reversed && i != 0 ? 3 - i : i;
        p.vertex[i].now = place[k];
        own[i] = &corner[k];
        smear_vertex_take_clipped(&p.vertex[i], space->segment, record[k]);
    }
    smear_clip_start(&p, 0, segment_colored(space->segment));
    smear_clip_polygon(&p, &space->depths, codes);
    clip_project(screen, &p, own, &space->depths, &space->viewport);
    for (int i = 0; i < p.count; i++) {
        struct path_record *const to = &out[reversed && i != 0 ? p.count - i : i];
        take_screen(to, &screen[i]);
        smear_vertex_store_clipped((uint32_t *)(void *)to->word, space->segment, clip_corner(&p, i));
    }
    return p.count;
}

/* Finds where a vertex with a path on the screen is. */
static void place_on_screen(struct smear_screen *screen, const struct smear_space *space, const int32_t *record, int32_t phase,
                            const int32_t shift[2])
{
    const int32_t *const middle = record + space->segment->stride, *const open = middle + PATH_POSE_WORDS;
    int32_t at[PATH_POSE_WORDS];
    path_place(at, middle, open, phase);
    *screen = (struct smear_screen){ at[PATH_X], at[PATH_Y], clamp_i32(at[PATH_DEPTH], SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX) };
    if (SMEAR_EDGES && path_is_shifted(open, PATH_X))
        screen->x += shift[PATH_X];
    if (SMEAR_EDGES && path_is_shifted(open, PATH_Y))
        screen->y += shift[PATH_Y];
    screen_clamp(screen, &space->viewport);
}

int smear_space_pose(struct path_record out[SMEAR_CLIP_MAX], struct smear_space *space, const int32_t *const record[3],
                     unsigned in_space, int32_t phase, const int32_t shift[2])
{
    struct smear_homogeneous place[3];
    struct smear_screen corner[3];
    int codes = 0, shared = OUT_REJECT;
    for (int i = 0; i < 3; i++) {
        smear_space_at(&place[i], space, record[i], phase);
        int code = project_place(&corner[i], space, &place[i]);
        if ((in_space >> i & 1u) == 0) {
            place_on_screen(&corner[i], space, record[i], phase, shift);
            code &= ~OUT_GUARD;
        }
        codes |= code;
        shared &= code;
    }
    if (shared != 0)
        return 0;
    if ((codes & OUT_CLIP) != 0)
        return cut(out, corner, place, space, record, codes, (in_space & PATH_REVERSED) != 0);
    for (int i = 0; i < 3; i++) {
        take_screen(&out[i], &corner[i]);
        for (int k = VERTEX_BASE_WORDS; k < space->segment->motion; k++)
            out[i].word[k] = record[i][k];
    }
    return 3;
}
