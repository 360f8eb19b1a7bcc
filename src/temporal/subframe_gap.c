/* SPDX-License-Identifier: MIT */
/* subframe_gap.c - means of some tiles' sums: the comb of instants is closed.
 *
 * A sum of N instants is a comb of N teeth where the truth is a box. Where all moving triangles go alike, a tooth is as
 * far from the next at all pixels, and the sum's own mean over that distance closes the comb: shifted in space is shifted
 * in time. Only what moves is meant: the background lies beneath, with the weight of the instants that are left. */
#include "temporal/subframe_tile.h"

#include "base/fixmath.h"
#include "kernels/gap_means.h"
#include "kernels/light_sums.h"
#include "temporal/tile_method.h"

union gap_mean {
    struct packed_mean packed;
    struct light_mean light;
};

/* A tile's gap, centred on a pixel: weights in `unit` of a pixel, of which the ends get what is left. Taps are in
 * pairs, which count only together: where one lies outside the tiles the gap is closed by less, but nothing is
 * shifted. */
struct gap {
    int32_t pairs;
    bool stops;                                 /* at edges that stand still */
    int8_t x[GAP_PAIRS_MAX], y[GAP_PAIRS_MAX];
    int32_t offset[GAP_PAIRS_MAX];              /* the same in the planes */
    uint32_t unit, last;                        /* weights: of the pixel and all pairs (1 .. 16, a power of two), but
                                                 * the last pair's */
    int unit_log2;
    uint32_t weight[GAP_PAIRS_MAX + 1];         /* of all taps at all instants, by pairs that count */
    union gap_mean mean[GAP_PAIRS_MAX + 1];     /* made where they are needed: */
    uint32_t made;                              /* a bit for each that is */
    uint32_t full, down, up;                    /* what instants that show what moves add up to beside green; bits that light lost, won */
    uint32_t recip;                             /* floor((2^32 - 1) / instants) */
};

/* ------------------------------------------------------------------ gap */

/* times part / over to nearest; no division where that is plain. */
static int32_t nearest_pixel(int32_t part, int32_t over, int32_t times)
{
    if (part == 0 || part == over)
        return part == 0 ? 0 : times;
    if (part == -over)
        return -times;
    const int32_t numerator = part * times;
    return (2 * numerator + (numerator < 0 ? -over : over)) / (2 * over);
}

static SMEAR_NOINLINE void gap_make(struct gap *gap, const struct subframes *f, const struct smear_step *step)
{
    const int32_t x = step->x, y = step->y, long_side = max_i32(abs_i32(x), abs_i32(y));    /* 1/16 px */
    const uint32_t length = (uint32_t)min_i32(long_side, 16 * (2 * GAP_PAIRS_MAX + 1));
    const uint32_t most = sums_light(f) ? UINT32_MAX : (uint32_t)PACKED_INSTANTS_MAX;
    uint32_t whole;
    for (gap->unit = 16;; gap->unit >>= 1) {
        /* what is left is the same on both sides */
        whole = max_u32((length * gap->unit + 16) >> 5 << 1, gap->unit);
        if (gap->unit == 1)
            whole = min_u32(whole | 1u, 2 * GAP_PAIRS_MAX + 1);
        if (gap->unit == 1 || whole * f->instants <= most)
            break;
    }
    int32_t over = long_side;
    if (whole * f->instants > most) {       /* fewer taps, farther apart than a pixel */
        whole = (max_u32(most / f->instants, 1) - 1) | 1u;
        over = 16 * (int32_t)whole;
    }
    const uint32_t side = (whole - gap->unit) >> 1;
    gap->pairs = (int32_t)((side + gap->unit - 1) / gap->unit);
    SMEAR_ASSERT(gap->pairs <= GAP_PAIRS_MAX);
    gap->last = side - (uint32_t)(gap->pairs - 1) * gap->unit;
    for (int32_t i = 0; i < gap->pairs; i++) {
        gap->x[i] = (int8_t)nearest_pixel(x, over, i + 1);
        gap->y[i] = (int8_t)nearest_pixel(y, over, i + 1);
        gap->offset[i] = gap->y[i] * f->t->pitch + gap->x[i];
    }
    if (gap->pairs == 0)
        gap->unit = f->instants == 1 ? 2 : 1;
    gap->unit_log2 = 31 - count_leading_zeros(gap->unit);
    for (int32_t pairs = 0; pairs <= gap->pairs; pairs++) {
        gap->weight[pairs] = f->instants
                           * (pairs == gap->pairs && pairs != 0 ? whole
                                                                : gap->unit * (2 * (uint32_t)pairs + 1));
    }
    gap->made = 0;
}

/* Pairs of which both lie within `near` of a pixel. */
static inline int32_t pairs_within(int32_t pairs, const int8_t *offset, int32_t near)
{
    while (pairs > 0 && abs_i32(offset[pairs - 1]) > near)
        pairs--;
    return pairs;
}

/* Pairs of which both lie in the rows of the tiles, for pixels of row y. */
static inline int32_t pairs_of_row(const struct gap *gap, const struct smear_raster_target *s, int32_t y)
{
    return pairs_within(gap->pairs, gap->y, min_i32(y - s->y0, s->y1 - 1 - y));
}

static inline uint32_t pair_weight(const struct gap *gap, int32_t i)
{
    return i + 1 == gap->pairs ? gap->last : gap->unit;
}

/* ------------------------------------------------------------------ tiles */

static enum gap_cover cover_of(const struct subframes *f, const struct subframe_box *b)
{
    if (f->highest == f->lowest)
        return COVER_NONE;
    if (!SMEAR_VECTORS || f->highest <= f->nearest)         /* one pixel after the other is not told apart further */
        return COVER_FEW;
    return smear_subframe_depths(f, b, GAP_PAIRS_MAX).most > f->nearest ? COVER_ALL : COVER_FEW;
}

/* The taps of pixels that have so many pairs, and the mean of them. */
struct gap_part {
    const union gap_mean *mean;
    struct gap_taps taps;
};

static inline void part_make(struct gap_part *part, struct gap *gap, const struct subframes *f, int32_t pairs)
{
    union gap_mean *const mean = &gap->mean[pairs];
    const uint32_t last = pair_weight(gap, pairs - 1);
    if ((gap->made >> pairs & 1u) == 0 && sums_light(f))
        mean->light = smear_light_mean(smear_light_full(f->instants), pairs, gap->unit, last, frame_transfer(f->t->frame));
    else if ((gap->made >> pairs & 1u) == 0)
        mean->packed = smear_packed_mean(gap->weight[pairs]);
    gap->made |= 1u << pairs;
    part->mean = mean;
    part->taps = (struct gap_taps){ { gap->offset, pairs, sums_light(f) ? smear_light_most(f->instants) : 1 }, gap->unit_log2, last,
                                    &mean->packed };
}

/* Whether a sum is that of one code at all instants: of light nearly, of which some bits were rounded away by thresholds that leave up
 * to 2.25 units of the sum (of 255 instants; light_sums.h). */
static inline bool is_of_one(const struct subframes *f, const struct gap *gap, uint32_t sum)
{
    const bool linear = frame_is_linear(f->t->frame);
    const uint32_t all = sum << gap->down >> gap->up, mean = mulh_u32(all + f->instants / 2, gap->recip);
    const uint32_t one = (sums_light(f) ? light_of_code(code_of_light(mean, linear), linear) : mean) * f->instants;
    return max_u32(one, all) - min_u32(one, all) <= (gap->down != 0 ? 9u << gap->down >> 2 : 0);
}

/* Whether a pixel shows the same at all instants, as its sums tell. */
static inline bool is_steady(const struct subframes *f, const struct gap *gap, struct packed_sum sum)
{
    const uint32_t shown = sum.gn >> 16;
    return (shown == 0 || shown == gap->full) && is_of_one(f, gap, sum.gn & 0xffffu) && is_of_one(f, gap, sum.rb & 0xffffu)
        && is_of_one(f, gap, sum.rb >> 16);
}

/* Returns the pairs of taps up to an edge that stands still between them and a pixel, as one along the motion does. */
static inline int32_t pairs_before_edge(const struct subframes *f, const struct gap *gap, int32_t at, int32_t pairs)
{
    const struct packed_sum here = packed_sum_at(&f->sums, at);
    bool is_known = false;      /* to be steady */
    for (int32_t i = 0; i < pairs; i++) {
        const struct packed_sum a = packed_sum_at(&f->sums, at - gap->offset[i]), b = packed_sum_at(&f->sums, at + gap->offset[i]);
        const bool before = ((a.rb ^ here.rb) | (a.gn ^ here.gn)) != 0, behind = ((b.rb ^ here.rb) | (b.gn ^ here.gn)) != 0;
        if (!before && !behind)
            continue;
        if (!is_known && !is_steady(f, gap, here))
            return pairs;
        is_known = true;
        if ((before && is_steady(f, gap, a)) || (behind && is_steady(f, gap, b)))
            return i;
    }
    return pairs;
}

/* Averages a box that has one gap: rows, cut where fewer pairs count. */
static void average_tile(const struct subframes *f, const struct subframe_box *b, struct gap *gap)
{
    const struct smear_raster_target *s = &f->t->background;
    const enum gap_cover cover = cover_of(f, b);
    const struct gap_planes planes = { f->work.color, f->work.depth, f->sums, f->nearest };
    struct gap_part part;
    part.taps.at.pairs = -1;
    struct gap_rows r = { .pitch = f->t->pitch };
    for (int32_t y = b->y0; y < b->y1; y += r.rows) {
        const int32_t row_pairs = pairs_of_row(gap, s, y), reach = row_pairs > 0 ? abs_i32(gap->x[row_pairs - 1]) : 0;
        for (r.rows = 1; GAP_ROWS && !gap->stops && y + r.rows < b->y1 && pairs_of_row(gap, s, y + r.rows) == row_pairs;)
            r.rows++;
        r.at = work_row(f, b, y);
        for (int32_t x = b->x0; x < b->x1; x += r.n, r.at += r.n) {
            const int32_t near = min_i32(x - s->x0, s->x1 - 1 - x);
            int32_t pairs = row_pairs;
            r.n = min_i32(b->x1, s->x1 - reach) - x;
            if (near < reach) {
                r.n = 1;
                pairs = pairs_within(row_pairs, gap->x, near);
            }
            if (gap->stops && pairs != 0) {
                const int32_t most = r.n, all = pairs;
                for (r.n = 0; r.n < most; r.n++) {
                    const int32_t own = pairs_before_edge(f, gap, r.at + r.n, all);
                    if (own != pairs && r.n != 0)
                        break;
                    pairs = own;
                }
            }
            if (pairs != part.taps.at.pairs)
                part_make(&part, gap, f, pairs);
            if (!sums_light(f))
                smear_gap_means(&planes, &r, &part.taps, cover);
            else
                for (int32_t k = 0; k < (GAP_ROWS ? r.rows : 1); k++)
                    smear_light_means(&planes, r.at + k * r.pitch, r.n, &part.taps.at, &part.mean->light, cover);
        }
    }
}

static const struct smear_tile_travel *tile_at(const struct smear_tile_run *t, const struct smear_tile_plan *plan, int32_t x)
{
    return &plan->travel[(x - t->x0) / t->tile];
}

/* Returns a step as gaps are closed for it: two pixels at least, of which a quarter, half and a quarter is the mean. Instants less than
 * a pixel apart are as far from pixels on the one side as pixels beside them on the other. */
static struct smear_step widened(int32_t x, int32_t y)
{
    enum { LEAST = 2 * 16 };
    const int32_t longer = max_i32(abs_i32(x), abs_i32(y));
    if (longer == 0 || longer >= LEAST)
        return (struct smear_step){ (int16_t)x, (int16_t)y };
    return (struct smear_step){ (int16_t)(2 * abs_i32(x) < longer ? 0 : x < 0 ? -LEAST : LEAST),
                                (int16_t)(2 * abs_i32(y) < longer ? 0 : y < 0 ? -LEAST : LEAST) };
}

/* Returns how what is seen in the block at a pixel goes on from one instant to the next, if gaps are closed there. */
static struct smear_step step_at(const struct subframes *f, const struct smear_tile_plan *plan, int32_t x, int32_t y)
{
    const struct smear_tile_run *t = f->t;
    const int32_t instants = (int32_t)f->instants;
    if (plan == NULL)
        return (struct smear_step){ 0, 0 };
    const struct smear_block *b = block_at(plan->blocks, x >> BLOCK_SHIFT, (y - t->background.y0) >> BLOCK_SHIFT);
    if (instants > b->last)
        return (struct smear_step){ 0, 0 };
    const struct smear_tile_travel *tile = tile_at(t, plan, x);
    return b->depth != 0 ? widened(b->x / instants, b->y / instants) : widened(tile->x / instants, tile->y / instants);
}

static inline bool is_alike(struct smear_step a, struct smear_step b) { return a.x == b.x && a.y == b.y; }

void smear_subframe_average(const struct subframes *f, const struct subframe_box *all, const struct smear_tile_plan *plan)
{
    const struct smear_tile_run *t = f->t;
    const struct smear_raster_target *s = &t->background;
    const int32_t wide = plan != NULL ? BLOCK_PX : t->x1 - t->x0, high = plan != NULL ? BLOCK_PX : s->y1 - s->y0;
    struct smear_step last = { 0, 0 };
    struct gap gap;
    gap_make(&gap, f, &last);
    gap.full = sums_light(f) ? smear_light_full(f->instants) : f->instants;
    gap.recip = UINT32_MAX / f->instants;
    gap.down = sums_light(f) ? (uint32_t)smear_light_instant(0, f->instants, false).down : 0;
    gap.up = sums_light(f) ? (uint32_t)smear_light_instant(0, f->instants, false).up : 0;
    for (int32_t y = s->y0; y < s->y1; y += high) {
        struct smear_step step = step_at(f, plan, t->x0, y);
        for (int32_t x = t->x0, end; x < t->x1; x = end) {
            if (!is_alike(step, last))
                gap_make(&gap, f, &step);
            last = step;
            for (end = x + wide; end < t->x1; end += wide)      /* blocks beside each other that have the same step */
                if (!is_alike(step = step_at(f, plan, end, y), last))
                    break;
            const struct subframe_box b = { max_i32(x, all->x0 - gap.pairs), max_i32(y, all->y0 - gap.pairs),
                                            min_i32(min_i32(end, t->x1), all->x1 + gap.pairs),
                                            min_i32(min_i32(y + high, s->y1), all->y1 + gap.pairs) };
            gap.stops = false;
            for (int32_t at = x; f->passing.in_space && at < end; at += wide)
                gap.stops = gap.stops || (tile_at(t, plan, at)->flags & PATH_SPACE) != 0;
            if (!subframe_box_is_empty(&b))
                average_tile(f, &b, &gap);
        }
    }
}
