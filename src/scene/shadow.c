/* SPDX-License-Identifier: MIT */
/* shadow.c - what shadows look like, and a round one for whatever moves. Programs that name none have none. */
#include "smear_scene.h"

#include "raster/texcoord.h"
#include "raster/span.h"

enum { SIDE = 32, UV_SHIFT = 14, HALF = 1 << UV_SHIFT, OPACITY_LOG2 = 7, PIECE_LEAST = 16, PIECE_MOST = 128 };

/* The disc: 31 (1 - r^2)^1.5 at a distance of r from its middle. */
static const uint8_t blob_texels[SIDE * SIDE] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 2, 3, 4, 4, 5, 5, 5, 5, 4, 4, 3, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 7, 8, 8, 7, 7, 6, 5, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 1, 3, 4, 6, 7, 8, 9, 10, 10, 10, 10, 10, 10, 9, 8, 7, 6, 4, 3, 1, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 2, 3, 5, 6, 8, 9, 11, 12, 12, 13, 13, 13, 13, 12, 12, 11, 9, 8, 6, 5, 3, 2, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 1, 3, 5, 7, 9, 10, 12, 13, 14, 15, 16, 16, 16, 16, 15, 14, 13, 12, 10, 9, 7, 5, 3, 1, 0, 0, 0, 0,
    0, 0, 0, 1, 3, 5, 7, 9, 11, 13, 14, 16, 17, 18, 19, 19, 19, 19, 18, 17, 16, 14, 13, 11, 9, 7, 5, 3, 1, 0, 0, 0,
    0, 0, 1, 2, 4, 6, 9, 11, 13, 15, 17, 18, 19, 20, 21, 21, 21, 21, 20, 19, 18, 17, 15, 13, 11, 9, 6, 4, 2, 1, 0, 0,
    0, 0, 1, 3, 6, 8, 10, 13, 15, 17, 19, 20, 22, 23, 23, 24, 24, 23, 23, 22, 20, 19, 17, 15, 13, 10, 8, 6, 3, 1, 0, 0,
    0, 0, 2, 4, 7, 9, 12, 14, 17, 19, 21, 22, 24, 25, 25, 26, 26, 25, 25, 24, 22, 21, 19, 17, 14, 12, 9, 7, 4, 2, 0, 0,
    0, 1, 3, 5, 8, 11, 13, 16, 18, 20, 22, 24, 25, 26, 27, 27, 27, 27, 26, 25, 24, 22, 20, 18, 16, 13, 11, 8, 5, 3, 1, 0,
    0, 1, 4, 6, 9, 12, 14, 17, 19, 22, 24, 25, 27, 28, 28, 29, 29, 28, 28, 27, 25, 24, 22, 19, 17, 14, 12, 9, 6, 4, 1, 0,
    0, 2, 4, 7, 10, 12, 15, 18, 20, 23, 25, 26, 28, 29, 29, 30, 30, 29, 29, 28, 26, 25, 23, 20, 18, 15, 12, 10, 7, 4, 2, 0,
    0, 2, 5, 7, 10, 13, 16, 19, 21, 23, 25, 27, 28, 29, 30, 31, 31, 30, 29, 28, 27, 25, 23, 21, 19, 16, 13, 10, 7, 5, 2, 0,
    0, 2, 5, 8, 10, 13, 16, 19, 21, 24, 26, 27, 29, 30, 31, 31, 31, 31, 30, 29, 27, 26, 24, 21, 19, 16, 13, 10, 8, 5, 2, 0,
    0, 2, 5, 8, 10, 13, 16, 19, 21, 24, 26, 27, 29, 30, 31, 31, 31, 31, 30, 29, 27, 26, 24, 21, 19, 16, 13, 10, 8, 5, 2, 0,
    0, 2, 5, 7, 10, 13, 16, 19, 21, 23, 25, 27, 28, 29, 30, 31, 31, 30, 29, 28, 27, 25, 23, 21, 19, 16, 13, 10, 7, 5, 2, 0,
    0, 2, 4, 7, 10, 12, 15, 18, 20, 23, 25, 26, 28, 29, 29, 30, 30, 29, 29, 28, 26, 25, 23, 20, 18, 15, 12, 10, 7, 4, 2, 0,
    0, 1, 4, 6, 9, 12, 14, 17, 19, 22, 24, 25, 27, 28, 28, 29, 29, 28, 28, 27, 25, 24, 22, 19, 17, 14, 12, 9, 6, 4, 1, 0,
    0, 1, 3, 5, 8, 11, 13, 16, 18, 20, 22, 24, 25, 26, 27, 27, 27, 27, 26, 25, 24, 22, 20, 18, 16, 13, 11, 8, 5, 3, 1, 0,
    0, 0, 2, 4, 7, 9, 12, 14, 17, 19, 21, 22, 24, 25, 25, 26, 26, 25, 25, 24, 22, 21, 19, 17, 14, 12, 9, 7, 4, 2, 0, 0,
    0, 0, 1, 3, 6, 8, 10, 13, 15, 17, 19, 20, 22, 23, 23, 24, 24, 23, 23, 22, 20, 19, 17, 15, 13, 10, 8, 6, 3, 1, 0, 0,
    0, 0, 1, 2, 4, 6, 9, 11, 13, 15, 17, 18, 19, 20, 21, 21, 21, 21, 20, 19, 18, 17, 15, 13, 11, 9, 6, 4, 2, 1, 0, 0,
    0, 0, 0, 1, 3, 5, 7, 9, 11, 13, 14, 16, 17, 18, 19, 19, 19, 19, 18, 17, 16, 14, 13, 11, 9, 7, 5, 3, 1, 0, 0, 0,
    0, 0, 0, 0, 1, 3, 5, 7, 9, 10, 12, 13, 14, 15, 16, 16, 16, 16, 15, 14, 13, 12, 10, 9, 7, 5, 3, 1, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 2, 3, 5, 6, 8, 9, 11, 12, 12, 13, 13, 13, 13, 12, 12, 11, 9, 8, 6, 5, 3, 2, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 1, 3, 4, 6, 7, 8, 9, 10, 10, 10, 10, 10, 10, 9, 8, 7, 6, 4, 3, 1, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 7, 8, 8, 7, 7, 6, 5, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 2, 3, 4, 4, 5, 5, 5, 5, 4, 4, 3, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0
};

/* ------------------------------------------------------------------ its pixels */

/* What it leaves of 256 parts of light, by the square of the distance from the middle. */
static const uint16_t blob_left[1 << OPACITY_LOG2] = {
    142, 143, 144, 146, 147, 148, 150, 151, 152, 154, 155, 156, 157, 159, 160, 161, 163, 164, 165, 166, 167, 169, 170, 171, 172, 174,
    175, 176, 177, 178, 180, 181, 182, 183, 184, 185, 186, 188, 189, 190, 191, 192, 193, 194, 195, 196, 198, 199, 200, 201, 202, 203,
    204, 205, 206, 207, 208, 209, 210, 211, 212, 213, 214, 215, 216, 217, 218, 219, 220, 220, 221, 222, 223, 224, 225, 226, 227, 228,
    228, 229, 230, 231, 232, 232, 233, 234, 235, 236, 236, 237, 238, 238, 239, 240, 241, 241, 242, 243, 243, 244, 245, 245, 246, 246,
    247, 248, 248, 249, 249, 250, 250, 251, 251, 252, 252, 252, 253, 253, 254, 254, 254, 255, 255, 255, 255, 256, 256, 256
};

/* A coordinate along a row: q30 turns at column x0, how it changes there, and by how much that does. */
struct track {
    int32_t at, dx, dxx, x0;
    int32_t down, change, dx_down;      /* by how much it is more in the next row, how that changes, and the slope */
};

/* In row y. A coordinate of one is not that of zero, as it is where turns have 32 bits. */
static struct track track_of(const struct setup *s, int axis, int32_t y)
{
    const struct curve *c = &s->texture.curve[axis];
    const int32_t corner = (axis == 0 ? setup_mesh_u(s, 0) : setup_mesh_v(s, 0)) << (30 - UV_SHIFT);
    const int32_t at = corner + (sub_wrap(c->at, shl_wrap(corner, 2)) >> 2);
    const int32_t dyy = c->dyy >> 2, dxy = c->dxy >> 2;
    y -= s->texture.y0;
    const int32_t dy = add_wrap(c->dy >> 2, mul_wrap(dyy, y));
    return (struct track){ add_wrap(at, mul_wrap(dy, y)), add_wrap(c->dx >> 2, mul_wrap(dxy, y)), c->dxx >> 2, s->texture.x0,
                           add_wrap(dy, mul_wrap(dyy, y + 1)), shl_wrap(dyy, 1), dxy };
}

static inline void track_next(struct track *t)
{
    t->at = add_wrap(t->at, t->down);
    t->down = add_wrap(t->down, t->change);
    t->dx = add_wrap(t->dx, t->dx_down);
}

/* How far a column is from the middle, where the radius is 2^14, and by how much more the next one is. */
static int32_t way_from_middle(const struct track *t, int32_t x, int32_t *step)
{
    x -= t->x0;
    const int32_t along = mul_wrap(t->dxx, x);
    *step = (add_wrap(t->dx, 2 * along) + 0x4000) >> 15;
    return (add_wrap(t->at, mul_wrap(add_wrap(t->dx, along), x)) - (1 << 29)) >> 15;
}

/* The same of two columns of a row whose coordinates are quotients: the ways of the first, and by how much more those are of each next. */
static void divided_ways(int32_t way[2], int32_t step[2], const struct setup *s, int32_t left, int32_t right, int32_t y)
{
    const struct texture_setup *t = &s->texture;
    const int32_t n = right - left, log = 31 - count_leading_zeros((uint32_t)n), far = n <= 16 ? n : 1 << log;
    struct place at[2];
    for (int i = 0; i < 2; i++) {
        const int32_t x = i == 0 ? left : left + far;
        at[i] = place_at(t, TEXTURE_DIVIDED, NULL, plane_at(&t->q, x, y), plane_at(&t->uv[0], x, y), plane_at(&t->uv[1], x, y), true);
        at[i].u = (at[i].u - (1 << (31 - t->shift))) >> (17 - t->shift);
        at[i].v = (at[i].v - (1 << (31 - t->shift))) >> (17 - t->shift);
    }
    way[0] = at[0].u;
    way[1] = at[0].v;
    step[0] = n <= 16 ? part_of(at[1].u - at[0].u, n) : (at[1].u - at[0].u) >> log;
    step[1] = n <= 16 ? part_of(at[1].v - at[0].v, n) : (at[1].v - at[0].v) >> log;
}

/* Columns in which coordinates are taken for planes: as many as leaves them within a 500th of the radius. */
static int32_t piece_of(const struct setup *s)
{
    if (s->texture.mode == TEXTURE_DIVIDED) {
        const int32_t least = min_i32(s->v[0][VERTEX_DEPTH], min_i32(s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH])) >> 8;
        const bool level = magnitude_i32(s->depth.dx) < (1u << 23) && abs_i32(s->depth.dx) * PIECE_MOST <= least;
        return level ? PIECE_MOST : PIECE_LEAST;
    }
    const uint32_t bend = magnitude_i32(s->texture.curve[0].dxx) + magnitude_i32(s->texture.curve[1].dxx);
    int32_t piece = PIECE_LEAST;
    while (piece < PIECE_MOST && bend < 1u << 18 && bend * (uint32_t)(piece * piece) < 1u << 22)
        piece *= 2;
    return piece;
}

/* Finds what is left of n pixels from one on whose square of the way from the middle, q28, this is; by how much the next one's is more, and
 * that. Returns how many there are behind `*first` ones that have none. */
static SMEAR_NOINLINE int32_t find_left(uint16_t *out, int32_t *first, int32_t n, uint32_t square, uint32_t step, uint32_t change)
{
    uint16_t *const begin = out;
    int32_t i = 0;
    for (; i < n && square >> 28 != 0; i++, step += change)
        square += step;
    *first = i;
    for (uint16_t *const end = out + (n - i); out != end && square >> 28 == 0; step += change) {
        *out++ = blob_left[square >> (28 - OPACITY_LOG2)];
        square += step;
    }
    return (int32_t)(out - begin);
}

/* Where a row's pixels lie, and the depth code 16.16 of the first. */
struct shade_run {
    uint32_t *color;
    const uint16_t *depth;
    uint32_t z, dz;
};

/* Darkens n pixels that lie behind, but for those that have a shadow, or all, as codes cannot: returns the first such one, or n. */
static SMEAR_NOINLINE int32_t darken_codes(const struct shade_run *r, const uint16_t *left, int32_t n)
{
    uint32_t *color = r->color, z = r->z, pair = 0xff00ffu, round = 0x800080u, round_green = 0x8000u;
    const uint16_t *depth = r->depth, *const begin = left, *const end = left + n;
    const uint32_t dz = r->dz;
    SMEAR_KEEP_VALUE(pair);
    SMEAR_KEEP_VALUE(round);
    SMEAR_KEEP_VALUE(round_green);
    for (; left != end; left++, color++, depth++, z += dz) {
        if (z >> 16 <= *depth)
            continue;
        const uint32_t p = *color, part = *left, two = p & pair, green = p ^ two;
        if (p >> 24 != 0)
            break;
        *color = (((two * part + round) >> 8 & pair) | ((green * part + round_green) >> 8 & ~pair)) - (part << 24);
    }
    return (int32_t)(left - begin);
}

/* Likewise what that leaves. */
static SMEAR_NOINLINE void darken_any(const struct shade_run *r, const uint16_t *left, int32_t i, int32_t n, smear_transfer transfer)
{
    for (; i < n; i++)
        if ((r->z + r->dz * (uint32_t)i) >> 16 > r->depth[i])
            r->color[i] = blended_pixel(r->color[i], (256u - left[i]) << 24, true, transfer);
}

/* Darkens columns [a, b) of a row, of which a piece, or what of it lies in the triangle, is told by its middle. */
static inline void darken_row(const struct setup *s, struct shade_run r, const struct track track[2], const struct span_side *side,
                              int32_t piece, int32_t a, int32_t b, int32_t y)
{
    uint16_t left_of[PIECE_MOST];
    for (int32_t end; a < b; a = end) {
        const int32_t left = max_i32(a & -piece, side->left), right = min_i32((a & -piece) + piece, side->right);
        const int32_t from = s->texture.mode == TEXTURE_CURVED ? (left + right) >> 1 : left;
        uint32_t square = 0, step = 0, change = 0;
        int32_t first, ways[2], steps[2];
        if (s->texture.mode == TEXTURE_DIVIDED)
            divided_ways(ways, steps, s, left, right, y);
        for (int axis = 0; axis < 2; axis++) {
            if (s->texture.mode == TEXTURE_CURVED)
                ways[axis] = way_from_middle(&track[axis], from, &steps[axis]);
            const int32_t d = steps[axis], way = ways[axis] + d * (a - from);
            square += (uint32_t)(way * way);
            step += (uint32_t)((2 * way + d) * d);
            change += 2u * (uint32_t)(d * d);
        }
        end = min_i32(b, right);
        const int32_t n = find_left(left_of, &first, end - a, square, step, change);
        const struct shade_run seen = { r.color + a + first, r.depth + a + first, r.z + r.dz * (uint32_t)(a + first), r.dz };
        const smear_transfer transfer = frame_transfer(s->frame);
        const int32_t done = transfer_is_linear(transfer) ? 0 : darken_codes(&seen, left_of, n);
        if (done != n)
            darken_any(&seen, left_of, done, n, transfer);
    }
}

/* Finds the next run of a row from a pixel on, as smear_row_run_next does. */
static inline bool run_next(struct row_run *p, const struct setup *s, const struct span_rows *r, int32_t row, int32_t x)
{
    if (!rows_are_whole(s, r))
        return smear_row_run_next(p, s, r, row, x);
    *p = (struct row_run){ x, r->side[row].right, code_from_units(plane_at(&s->depth, 0, r->y + row), s->slope),
                           (uint32_t)step_from_units(s->depth.dx, s->slope) };
    return x < p->b;
}

static void darken_rows(const struct setup *s, const struct span_rows *r)
{
    const struct smear_raster_target *t = s->target;
    const int32_t piece = piece_of(s);
    struct track track[2] = { track_of(s, 0, r->y), track_of(s, 1, r->y) };
    for (int32_t row = 0; row < r->count; row++, track_next(&track[0]), track_next(&track[1])) {
        struct row_run p;
        for (int32_t x = r->side[row].left; run_next(&p, s, r, row, x); x = p.b) {
            const int32_t y = r->y + row;
            const struct shade_run run = { t->color + target_row(&t->color_rows, t, y), t->depth + target_row(&t->window_rows, t, y),
                                           p.z, p.dz };
            darken_row(s, run, track, &r->side[row], piece, p.a, p.b, y);
        }
    }
}

/* In fog, without perspective, or in a light of its own, texels do. */
static smear_rows_fn *choose(const struct setup *s)
{
    const bool fits = s->texture.mode == TEXTURE_CURVED || (s->texture.mode == TEXTURE_DIVIDED && s->texture.shift < 17);
    if (!fits || s->segment->shade != SHADE_NONE || fog_of(s) != FOG_NONE || !draw_is_shadow(s->draw))
        return NULL;
    return darken_rows;
}

/* ------------------------------------------------------------------ what is drawn */

static const struct smear_own_texels blob_texels_own = {
    .palette = {
        0x00000000, 0x04000000, 0x07000000, 0x0b000000, 0x0f000000, 0x13000000, 0x16000000, 0x1a000000,
        0x1e000000, 0x21000000, 0x25000000, 0x29000000, 0x2d000000, 0x30000000, 0x34000000, 0x38000000,
        0x3b000000, 0x3f000000, 0x43000000, 0x46000000, 0x4a000000, 0x4e000000, 0x52000000, 0x55000000,
        0x59000000, 0x5d000000, 0x60000000, 0x64000000, 0x68000000, 0x6c000000, 0x6f000000, 0x73000000
    },
    .choose = choose
};

static const smear_texture blob_texture = {
    .texels = blob_texels, .palette = blob_texels_own.palette, .width = SIDE, .height = SIDE, .format = SMEAR_TEXEL_OWN
};

static const int16_t blob_position[] = { -HALF, 0, -HALF, -HALF, 0, HALF, HALF, 0, HALF, HALF, 0, -HALF };
static const int16_t blob_uv[] = { 0, 0, 0, HALF, HALF, HALF, HALF, 0 };
static const uint16_t blob_index[] = { 0, 1, 2, 0, 2, 3 };

const smear_mesh smear_blob = { .position = blob_position, .uv = blob_uv, .index = blob_index, .triangle_count = 2, .vertex_count = 4,
                                .shift = 14, .uv_shift = UV_SHIFT, .bounds = { -HALF, 0, -HALF, HALF, 0, HALF } };
const smear_material smear_blob_material = { .texture = &blob_texture, .alpha = SMEAR_SHADOW, .unlit = 1 };
const smear_material smear_shadow_material = { .color = { 0, 0, 0, 115 }, .alpha = SMEAR_SHADOW, .unlit = 1 };
