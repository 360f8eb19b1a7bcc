/* SPDX-License-Identifier: MIT */
/* timemask_cover.c - edges of a moving triangle in a block of pixels, and the runs they leave in a row. */
#include "timemask_cover.h"

enum {
    SLOT_Q = 14,                /* fraction bits of slots in planes */
    HALF = TIMEMASK_BLOCK / 2
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

/* Adds edge i -> j to its kind. False: it is outside everywhere. */
static bool edge_add(struct timemask_cover *c, const struct timemask_pose *a, const struct timemask_pose *b,
                     int i, int j)
{
    bool reversed = !is_before(a, b, i, j);
    if (reversed) {
        int keep = i;
        i = j;
        j = keep;
    }
    struct timemask_plane start = edge_at(a->x[i], a->y[i], a->x[j], a->y[j]);
    struct timemask_plane end = edge_at(b->x[i], b->y[i], b->x[j], b->y[j]);
    int32_t low = min_i32(plane_low(&start, c), plane_low(&end, c));
    int32_t high = max_i32(plane_high(&start, c), plane_high(&end, c));
    if (low >= 0)
        return !reversed;       /* inside everywhere, or outside */
    if (high < 0)
        return reversed;

    /* Twice the mean of both ends, and by how much they differ: `d` in the block's middle, `h` less or more at its
     * corners. The edge's length is about `length`, q8. */
    int32_t mx = start.dx + end.dx, my = start.dy + end.dy;
    int32_t ddx = start.dx - end.dx, ddy = start.dy - end.dy;
    int32_t d = start.at - end.at + ddx * HALF + ddy * HALF;
    int32_t h = (abs_i32(ddx) + abs_i32(ddy)) * HALF;
    int32_t size = abs_i32(d);
    int32_t length = (abs_i32(mx) + abs_i32(my)) >> 1;

    if (size + h <= length >> 7) {      /* moves by less than 1/128 px */
        struct timemask_plane p = { (start.at + end.at) >> 1, mx >> 1, my >> 1 };
        c->still[c->stills++] = reversed ? other_side(&p) : p;
    } else if (h <= length >> 2 && h <= size >> 2 && size >= length >> 7) {
        /* The crossing lies at n (1/2 + mean / difference), and the difference is taken as constant: off by at most
         * h / (2 length), about 1/8 px. */
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
        c->turn[c->turns++].reversed = reversed;
    }
    return true;
}

static int64_t area_of(const struct timemask_pose *p)
{
    return (int64_t)(p->x[1] - p->x[0]) * (p->y[2] - p->y[0]) - (int64_t)(p->x[2] - p->x[0]) * (p->y[1] - p->y[0]);
}

bool smear_timemask_cover(struct timemask_cover *c, const struct timemask_pose *a, const struct timemask_pose *b,
                          int32_t width, int32_t height, int32_t slots_log2)
{
    int32_t left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        left = min_i32(left, min_i32(a->x[i], b->x[i]));
        right = max_i32(right, max_i32(a->x[i], b->x[i]));
        top = min_i32(top, min_i32(a->y[i], b->y[i]));
        bottom = max_i32(bottom, max_i32(a->y[i], b->y[i]));
    }
    c->x0 = max_i32((left + 255) >> 8, 0);
    c->y0 = max_i32((top + 255) >> 8, 0);
    c->x1 = min_i32((right >> 8) + 1, width);
    c->y1 = min_i32((bottom >> 8) + 1, height);
    if (c->x0 >= c->x1 || c->y0 >= c->y1 || (area_of(a) <= 0 && area_of(b) <= 0))
        return false;
    c->slots_log2 = slots_log2;
    c->enters = c->leaves = c->stills = c->turns = 0;
    return edge_add(c, a, b, 0, 1) && edge_add(c, a, b, 1, 2) && edge_add(c, a, b, 2, 0);
}

/* ------------------------------------------------------------------ rows */

/* The slot before which start >= 0 turns to end < 0 (or the other way round): n start / (start - end), to nearest. */
static int32_t crossing(int32_t start, int32_t end, int32_t slots_log2)
{
    if (start < 0) {
        start = ~start;
        end = ~end;
    }
    uint32_t a = 2u * (uint32_t)start + 1u, d = 2u * ((uint32_t)start - (uint32_t)end);    /* a < d */
    int zeros = count_leading_zeros(d);
    uint32_t ratio = mulh_u32(a << zeros, recip_norm(d << zeros));     /* q29 */
    return (int32_t)((ratio + (1u << (28 - slots_log2))) >> (29 - slots_log2));
}

int32_t smear_timemask_row(const struct timemask_cover *c, int32_t y, struct timemask_run *out)
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
        for (int i = 0; i < c->turns; i++) {
            int32_t start = timemask_plane_at(&c->turn[i].start, x, y), end = timemask_plane_at(&c->turn[i].end, x, y);
            bool at_start = (start >= 0) != c->turn[i].reversed;
            if ((start ^ end) >= 0) {
                if (!at_start)
                    to = 0;
                continue;
            }
            int32_t slot = crossing(start, end, c->slots_log2);
            if (at_start)
                to = min_i32(to, slot);
            else
                from = max_i32(from, slot);
        }
        if (from < to)
            out[count++] = (struct timemask_run){ (uint8_t)x, (uint8_t)from, (uint8_t)to };
    }
    return count;
}
