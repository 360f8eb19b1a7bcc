/* SPDX-License-Identifier: MIT */
/* timemask_cover.c - edges of a moving triangle in a block of pixels, and the runs they leave in a row. */
#include "timemask_cover.h"

enum {
    SLOT_Q = 14,                /* fraction bits of slots in planes */
    HALF = TIMEMASK_BLOCK / 2,
};

/* ------------------------------------------------------------------ edges */

/* An edge function at one end of the segment, q8 px^2 rounded down: exact in its sign. */
static struct timemask_plane edge_at(int32_t ax, int32_t ay, int32_t bx, int32_t by)
{
    int32_t dx = bx - ax, dy = by - ay;
    /* A centre on the edge counts for edges that go up and those that go right. */
    int32_t bias = dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
    int64_t here = (int64_t)dy * ax - (int64_t)dx * ay + bias;
    here >>= 8;
    /* Steps are below 2^22: far beyond 2^26 the sign is the same all over the block. Differences of two still fit. */
    const int32_t most = (1 << 30) - (1 << 28);
    int32_t at = here > most ? most : here < -most ? -most : (int32_t)here;
    return (struct timemask_plane){ at, -dy, dx };
}

/* The order in which everyone takes the vertices of an edge. */
static bool is_before(const struct timemask_pose *a, const struct timemask_pose *b, int i, int j)
{
    if (a->y[i] != a->y[j])
        return a->y[i] < a->y[j];
    if (a->x[i] != a->x[j])
        return a->x[i] < a->x[j];
    if (b->y[i] != b->y[j])
        return b->y[i] < b->y[j];
    return b->x[i] < b->x[j];
}

static inline int32_t plane_low(const struct timemask_plane *p, const struct timemask_cover *c)
{
    return p->at + (p->dx < 0 ? p->dx * (c->x1 - 1) : p->dx * c->x0)
                 + (p->dy < 0 ? p->dy * (c->y1 - 1) : p->dy * c->y0);
}

static inline int32_t plane_high(const struct timemask_plane *p, const struct timemask_cover *c)
{
    return p->at + (p->dx > 0 ? p->dx * (c->x1 - 1) : p->dx * c->x0)
                 + (p->dy > 0 ? p->dy * (c->y1 - 1) : p->dy * c->y0);
}

/* The other side of an edge: -e - 1, so that >= 0 is exactly what was < 0. */
static inline struct timemask_plane other_side(const struct timemask_plane *p)
{
    return (struct timemask_plane){ ~p->at, -p->dx, -p->dy };
}

/* a n / d in q14 for n = 2^slots_log2, to nearest: d = 2^(61 - zeros) / recip, its sign apart. */
static inline int32_t slots_over(int32_t a, uint32_t recip, int shift)
{
    return (int32_t)(((int64_t)a * (int32_t)recip + ((int64_t)1 << (shift - 1))) >> shift);
}

/* Twice what the middle lies off the mean of both ends; far off the block it does not matter. */
static struct timemask_plane bow_of(const struct timemask_plane *start, const struct timemask_plane *middle,
                                    const struct timemask_plane *end)
{
    const int64_t most = 1 << 28;
    int64_t at = 2 * (int64_t)middle->at - start->at - end->at;
    at = at > most ? most : at < -most ? -most : at;
    return (struct timemask_plane){ (int32_t)at, 2 * middle->dx - start->dx - end->dx,
                                    2 * middle->dy - start->dy - end->dy };
}

/* Largest magnitude in the block, or a bit more. */
static inline int32_t plane_size(const struct timemask_plane *p)
{
    return abs_i32(p->at + (p->dx + p->dy) * HALF) + (abs_i32(p->dx) + abs_i32(p->dy)) * HALF;
}

/* Adds edge i -> j to its kind. False: it is outside everywhere. */
static bool edge_add(struct timemask_cover *c, const struct timemask_pose *const pose[3], int i, int j)
{
    const struct timemask_pose *a = pose[0], *m = pose[1], *b = pose[2];
    bool reversed = !is_before(a, b, i, j);
    if (reversed) {
        int keep = i;
        i = j;
        j = keep;
    }
    struct timemask_plane start = edge_at(a->x[i], a->y[i], a->x[j], a->y[j]);
    struct timemask_plane middle = edge_at(m->x[i], m->y[i], m->x[j], m->y[j]);
    struct timemask_plane end = edge_at(b->x[i], b->y[i], b->x[j], b->y[j]);
    struct timemask_plane bow = bow_of(&start, &middle, &end);
    int32_t bows = plane_size(&bow);            /* in units of 1/2 */
    int32_t low = min_i32(plane_low(&start, c), plane_low(&end, c));
    int32_t high = max_i32(plane_high(&start, c), plane_high(&end, c));
    if (low - (bows >> 1) >= 0)
        return !reversed;       /* inside everywhere, or outside */
    if (high + (bows >> 1) < 0)
        return reversed;

    /* Twice the mean of both ends, and by how much they differ: `d` in the block's middle, `h` less or more at its
     * corners. The edge's length is about `length`, q8. */
    int32_t mx = start.dx + end.dx, my = start.dy + end.dy;
    int32_t ddx = start.dx - end.dx, ddy = start.dy - end.dy;
    int32_t d = start.at - end.at + (ddx + ddy) * HALF;
    int32_t h = (abs_i32(ddx) + abs_i32(ddy)) * HALF;
    int32_t size = abs_i32(d);
    int32_t length = (abs_i32(mx) + abs_i32(my)) >> 1;
    int32_t off = (h >> 1) + (bows >> 1);       /* what a plane of slots would be off, q8 px^2 */

    if (size + h + bows <= length >> 7) {       /* moves by less than 1/128 px */
        struct timemask_plane p = { (start.at + end.at) >> 1, mx >> 1, my >> 1 };
        c->still[c->stills++] = reversed ? other_side(&p) : p;
    } else if ((int64_t)off * off <= (int64_t)length * size >> c->edge && size >= length >> 7) {
        /* The crossing lies at n (1/2 + mean / difference), where the difference is taken as constant. That is off by
         * off / length: a part off / size of the contrast over size / length pixels. */
        int zeros = count_leading_zeros((uint32_t)size);
        uint32_t r = recip_norm_precise((uint32_t)size << zeros);
        int shift = 61 - zeros - (SLOT_Q - 1) - c->slots_log2;
        int32_t sign = d < 0 ? -1 : 1;
        struct timemask_plane p = {
            slots_over(sign * (start.at + end.at + 1), r, shift)
                + (1 << (SLOT_Q + c->slots_log2) >> 1) + (1 << (SLOT_Q - 1)),
            slots_over(sign * mx, r, shift), slots_over(sign * my, r, shift)
        };
        if ((d > 0) != reversed)
            c->leave[c->leaves++] = p;
        else
            c->enter[c->enters++] = p;
    } else {
        c->turn[c->turns].start = start;
        c->turn[c->turns].end = end;
        c->turn[c->turns].bow = bow;
        c->turn[c->turns++].reversed = reversed;
    }
    return true;
}

static int64_t area_of(const struct timemask_pose *p)
{
    return (int64_t)(p->x[1] - p->x[0]) * (p->y[2] - p->y[0]) - (int64_t)(p->x[2] - p->x[0]) * (p->y[1] - p->y[0]);
}

bool smear_timemask_cover(struct timemask_cover *c, const struct timemask_pose *const pose[3], int32_t width,
                          int32_t height, int32_t slots_log2, int32_t edge)
{
    int32_t left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            left = min_i32(left, pose[k]->x[i]);
            right = max_i32(right, pose[k]->x[i]);
            top = min_i32(top, pose[k]->y[i]);
            bottom = max_i32(bottom, pose[k]->y[i]);
        }
    c->x0 = max_i32((left + 255) >> 8, 0);
    c->y0 = max_i32((top + 255) >> 8, 0);
    c->x1 = min_i32((right >> 8) + 1, width);
    c->y1 = min_i32((bottom >> 8) + 1, height);
    if (c->x0 >= c->x1 || c->y0 >= c->y1
        || (area_of(pose[0]) <= 0 && area_of(pose[1]) <= 0 && area_of(pose[2]) <= 0))
        return false;
    c->slots_log2 = slots_log2;
    c->edge = edge;
    c->enters = c->leaves = c->stills = c->turns = 0;
    return edge_add(c, pose, 0, 1) && edge_add(c, pose, 1, 2) && edge_add(c, pose, 2, 0);
}

/* ------------------------------------------------------------------ rows */

/* Slots [0, n). */
static inline uint32_t below(int32_t n)
{
    return n >= 32 ? UINT32_MAX : (1u << n) - 1u;
}

/* Slots in which start + (end - start) u + 2 bow u (1 - u) >= 0, one after the other. */
static uint32_t mask_by_slots(int32_t start, int32_t end, int32_t bow, int32_t slots_log2)
{
    /* Brought to 18 bits: times 4 n^2 and a sum of four it fits. */
    uint32_t size = (uint32_t)abs_i32(start) | (uint32_t)abs_i32(end) | (uint32_t)abs_i32(bow) | 1u;
    int shift = count_leading_zeros(size) - 14;
    int32_t a = shift >= 0 ? shl_wrap(start, shift) : start >> -shift;
    int32_t b = shift >= 0 ? shl_wrap(end, shift) : end >> -shift;
    int32_t c = shift >= 0 ? shl_wrap(bow, shift) : bow >> -shift;
    int32_t n = 1 << slots_log2;
    uint32_t mask = 0;
    for (int32_t k = 0; k < n; k++) {
        int32_t u = 2 * k + 1, rest = 2 * n - u;
        int32_t e = a * rest * 2 * n + b * u * 2 * n + 2 * c * u * rest;
        mask |= (uint32_t)(e >= 0) << k;
    }
    return mask;
}

/* The same, for all cases. */
static uint32_t turn_mask(int32_t start, int32_t end, int32_t bow, int32_t slots_log2)
{
    int32_t d = start - end;
    if ((start ^ end) >= 0 || abs_i32(bow) > abs_i32(d) >> 2)
        return mask_by_slots(start, end, bow, slots_log2);
    /* It crosses once, at r = start / d + 2 bow / d r (1 - r). */
    bool from_inside = start >= 0;
    uint32_t a = 2u * (uint32_t)(from_inside ? start : ~start) + 1u, size = 2u * (uint32_t)abs_i32(d);     /* a < size */
    int zeros = count_leading_zeros(size);
    uint32_t recip = recip_norm(size << zeros);
    int32_t first = (int32_t)(mulh_u32(a << zeros, recip) >> 13);          /* q16 */
    int32_t curve = (int32_t)(mulh_u32((uint32_t)abs_i32(bow) << zeros, recip) >> 12);     /* 2 bow / d / 2, q16 */
    int32_t r = first;
    if ((bow < 0) == from_inside)
        curve = -curve;
    for (int i = 0; i < 3 && curve != 0; i++)
        r = clamp_i32(first + (curve * (r * (65536 - r) >> 17) >> 14), 0, 65536);
    uint32_t before = below((r + (1 << (15 - slots_log2))) >> (16 - slots_log2));
    return from_inside ? before : below(1 << slots_log2) & ~before;
}

/* Writes the runs of a mask. */
static int32_t put_runs(struct timemask_run *out, int32_t x, uint32_t mask)
{
    int32_t count = 0;
    while (mask != 0) {
        uint32_t low = mask & (0u - mask), rest = mask + low;      /* adding carries over the lowest run */
        int32_t from = 31 - count_leading_zeros(low);
        int32_t to = (rest & (0u - rest)) == 0 ? 32 : 31 - count_leading_zeros(rest & (0u - rest));
        out[count++] = (struct timemask_run){ (uint8_t)x, (uint8_t)from, (uint8_t)to };
        mask &= ~below(to);
    }
    return count;
}

static int32_t row_turning(const struct timemask_cover *c, int32_t y, struct timemask_run *out)
{
    int32_t slots = 1 << c->slots_log2, count = 0;
    for (int32_t x = c->x0; x < c->x1; x++) {
        int32_t from = 0, to = slots;
        for (int i = 0; i < c->stills; i++)
            if (timemask_plane_at(&c->still[i], x, y) < 0)
                to = 0;
        for (int i = 0; i < c->leaves; i++)
            to = min_i32(to, timemask_plane_at(&c->leave[i], x, y) >> SLOT_Q);
        for (int i = 0; i < c->enters; i++)
            from = max_i32(from, timemask_plane_at(&c->enter[i], x, y) >> SLOT_Q);
        if (from >= to)
            continue;
        uint32_t mask = below(to) & ~below(from);
        for (int i = 0; i < c->turns && mask != 0; i++) {
            int32_t start = timemask_plane_at(&c->turn[i].start, x, y), end = timemask_plane_at(&c->turn[i].end, x, y);
            int32_t bow = timemask_plane_at(&c->turn[i].bow, x, y);
            int32_t low = min_i32(start, end), high = max_i32(start, end);
            low += bow < 0 ? (bow - 1) >> 1 : 0;
            high += bow > 0 ? (bow + 1) >> 1 : 0;
            uint32_t inside = low >= 0 ? UINT32_MAX : high < 0 ? 0 : turn_mask(start, end, bow, c->slots_log2);
            mask &= c->turn[i].reversed ? ~inside : inside;
        }
        count += put_runs(out + count, x, mask);
    }
    return count;
}

/* A plane on its way along a row. */
struct walk {
    int32_t at, step;
};

static inline struct walk walk_start(const struct timemask_plane *p, const struct timemask_cover *c, int32_t y)
{
    return (struct walk){ timemask_plane_at(p, c->x0, y), p->dx };
}

/* Edges that do not turn: what is covered at some time is convex, so the first gap after it ends the row. Runs shorter than
 * a slot may hold the middle of none. */
SMEAR_INLINE int32_t row_plain(const struct timemask_cover *c, int32_t y, struct timemask_run *out, int enters, int leaves,
                               int stills)
{
    const int32_t slots = 1 << c->slots_log2;
    struct walk enter[3], leave[3], still[3];
    int32_t count = 0;
    for (int i = 0; i < enters; i++)
        enter[i] = walk_start(&c->enter[i], c, y);
    for (int i = 0; i < leaves; i++)
        leave[i] = walk_start(&c->leave[i], c, y);
    for (int i = 0; i < stills; i++)
        still[i] = walk_start(&c->still[i], c, y);
    for (int32_t x = c->x0; x < c->x1; x++) {
        int32_t from = 0, to = slots << SLOT_Q, outside = 0;
        for (int i = 0; i < stills; i++) {
            outside |= still[i].at;
            still[i].at = add_wrap(still[i].at, still[i].step);
        }
        for (int i = 0; i < leaves; i++) {
            to = min_i32(to, leave[i].at);
            leave[i].at = add_wrap(leave[i].at, leave[i].step);
        }
        for (int i = 0; i < enters; i++) {
            from = max_i32(from, enter[i].at);
            enter[i].at = add_wrap(enter[i].at, enter[i].step);
        }
        if (from >> SLOT_Q < to >> SLOT_Q && outside >= 0)
            out[count++] = (struct timemask_run){ (uint8_t)x, (uint8_t)(from >> SLOT_Q), (uint8_t)(to >> SLOT_Q) };
        else if (count != 0 && (from >= to || outside < 0))
            break;
    }
    return count;
}

int32_t smear_timemask_row(const struct timemask_cover *c, int32_t y, struct timemask_run *out)
{
    if (c->turns != 0)
        return row_turning(c, y, out);
    switch (c->enters << 4 | c->leaves << 2 | c->stills) {
    case 0x00: return row_plain(c, y, out, 0, 0, 0);
    case 0x04: return row_plain(c, y, out, 0, 1, 0);
    case 0x10: return row_plain(c, y, out, 1, 0, 0);
    case 0x14: return row_plain(c, y, out, 1, 1, 0);
    case 0x18: return row_plain(c, y, out, 1, 2, 0);
    case 0x24: return row_plain(c, y, out, 2, 1, 0);
    default:   return row_plain(c, y, out, c->enters, c->leaves, c->stills);
    }
}
