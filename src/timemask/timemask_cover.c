/* SPDX-License-Identifier: MIT */
/* timemask_cover.c - edges of a moving triangle in a block of pixels, and the runs they leave in a row. */
#include "timemask/timemask_cover.h"

enum {
    SAMPLE_Q = 14,              /* fraction bits of samples in planes */
    CURVED_Q = 12               /* after a multiplication with curvatures */
};

/* ------------------------------------------------------------------ edges */

/* An edge function at one time, q8 px^2 rounded down: exact in its sign. */
SMEAR_INLINE struct timemask_plane edge_at(const struct timemask_pose *p, int i, int j)
{
    int32_t ax = p->x[i], ay = p->y[i], dx = p->x[j] - ax, dy = p->y[j] - ay;
    /* A centre on the edge counts (0, else -1) for edges that go up and those that go right. */
    int64_t bias = ~(((int64_t)dy * (1 << 24) - dx) >> 63);
    int64_t here = (cross_wide(dy, dx, ay, ax) + bias) >> 8;
    /* Steps are below 2^22: far beyond 2^26 the sign is the same all
     * over the block. Differences of two fit, too. */
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

/* Twice the value in the middle of the pixels that may be
 * covered; more or less by `reach` at their corners. */
SMEAR_INLINE int32_t plane_middle(const struct timemask_plane *p, const struct timemask_cover *c,
                                  int32_t *reach)
{
    *reach = abs_i32(p->dx) * (c->x1 - 1 - c->x0) + abs_i32(p->dy) * (c->y1 - 1 - c->y0);
    return 2 * p->at + p->dx * (c->x0 + c->x1 - 1) + p->dy * (c->y0 + c->y1 - 1);
}

/* The other side of an edge: -e - 1, so that >= 0 is exactly what was < 0. */
static inline struct timemask_plane other_side(const struct timemask_plane *p)
{
    return (struct timemask_plane){ ~p->at, -p->dx, -p->dy };
}

/* a n / d in q14 for n = 2^samples_log2, to nearest: d = 2^(61 - zeros) / recip, its sign apart. */
static inline int32_t samples_over(int32_t a, uint32_t recip, int shift)
{
    return (int32_t)((mul_wide(a, (int32_t)recip) + ((int64_t)1 << (shift - 1))) >> shift);
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
static inline int32_t plane_size(const struct timemask_plane *p, const struct timemask_cover *c)
{
    return abs_i32(p->at + p->dx * c->middle_x + p->dy * c->middle_y) + abs_i32(p->dx) * c->middle_x
         + abs_i32(p->dy) * c->middle_y;
}

/* How an edge's functions at start and end differ over the block: `d` in
 * its middle, `h` more or less at its corners. */
struct sweep {
    struct timemask_plane start, end, bow;
    int32_t d, h, bows;         /* bows: twice the largest bow */
    int32_t length;             /* of the edge, about, q8 px */
    bool reversed;
};

/* What an edge that crosses may be off: where it moves by p px and is off by e px, a part e / p
 * of its contrast is wrong over p pixels. The squares of that add up to e^2 / p, which is held
 * below 2^-edge px. `off` is e x length in q8. */
static inline bool is_near(const struct sweep *w, int32_t off, int32_t edge)
{
    return mul_wide(off, off) <= mul_wide(w->length, abs_i32(w->d)) >> edge;
}

/* The crossing lies at n (1/2 + mean / difference). Taken with the difference of the
 * block's middle it is off by up to h / 2 and the bow; multiplied with 1 - (what the
 * difference is more) / difference, by h^2 / (2 d). */
static bool crossing_add(struct timemask_cover *c, const struct sweep *w, int32_t edge)
{
    int32_t size = abs_i32(w->d);
    if (size == 0 || size < w->length >> 7 || w->h > size >> 1)
        return false;
    int zeros = count_leading_zeros((uint32_t)size);
    uint32_t r = recip_norm_precise((uint32_t)size << zeros);
    enum timemask_form form = COVER_EVEN;
    int32_t part = 0;
    if (!is_near(w, (w->h >> 1) + (w->bows >> 1), edge)) {
        part = (int32_t)(mulh_u32((uint32_t)w->h << zeros, r) >> 14);           /* h / d, q15 */
        int32_t off = mul_shift(w->h, part, 16);
        form = is_near(w, off + (w->bows >> 1), edge) ? COVER_CURVED : COVER_BOWED;
        if (form == COVER_BOWED && (w->bows > size >> 3 || !is_near(w, off, edge)))
            return false;
    }
    bool leaves = (w->d > 0) != w->reversed;
    struct timemask_crossing *x = leaves ? &c->leave[c->leaves++] : &c->enter[c->enters++];
    int shift = 61 - zeros - (SAMPLE_Q - 1) - c->samples_log2;
    int32_t sign = w->d < 0 ? -1 : 1;
    x->mean = (struct timemask_plane){ samples_over(sign * (w->start.at + w->end.at + 1), r, shift),
                                       samples_over(sign * (w->start.dx + w->end.dx), r, shift),
                                       samples_over(sign * (w->start.dy + w->end.dy), r, shift) };
    x->curvature = (struct timemask_plane){ 1 << 30, 0, 0 };
    x->bow = 0;
    c->form = form > c->form ? form : c->form;
    if (form != COVER_EVEN) {
        int down = 31 - zeros;          /* |differences| < d < 2^(32 - zeros) */
        x->curvature.dx = (int32_t)(mul_wide(-sign * (w->start.dx - w->end.dx), (int32_t)r) >> down);
        x->curvature.dy = (int32_t)(mul_wide(-sign * (w->start.dy - w->end.dy), (int32_t)r) >> down);
        x->curvature.at = (1 << 30) - x->curvature.dx * c->middle_x - x->curvature.dy * c->middle_y;
    }
    if (form == COVER_BOWED) {
        int32_t bow = w->bow.at + w->bow.dx * c->middle_x + w->bow.dy * c->middle_y;
        x->bow = (int32_t)(mul_wide(sign * bow, (int32_t)r) >> (61 - zeros - 15));     /* 2 bow / d */
    }
    return true;
}

/* Adds edge i -> j to its kind. False: it is outside everywhere. */
static bool edge_add(struct timemask_cover *c, const struct timemask_pose *const pose[3], int i, int j,
                     int32_t edge)
{
    const struct timemask_pose *a = pose[0], *m = pose[1], *b = pose[2];
    struct sweep w;
    w.reversed = !is_before(a, b, i, j);
    if (w.reversed) {
        int keep = i;
        i = j;
        j = keep;
    }
    w.start = edge_at(a, i, j);
    w.end = edge_at(b, i, j);
    struct timemask_plane middle = edge_at(m, i, j);
    w.bow = bow_of(&w.start, &middle, &w.end);
    w.bows = plane_size(&w.bow, c);
    int32_t reach_start, reach_end;
    int32_t start = plane_middle(&w.start, c, &reach_start), end = plane_middle(&w.end, c, &reach_end);
    if (min_i32(start - reach_start, end - reach_end) >= w.bows)
        return !w.reversed;     /* inside everywhere, or outside */
    if (max_i32(start + reach_start, end + reach_end) < -w.bows)
        return w.reversed;

    int32_t mx = w.start.dx + w.end.dx, my = w.start.dy + w.end.dy;
    int32_t ddx = w.start.dx - w.end.dx, ddy = w.start.dy - w.end.dy;
    w.d = w.start.at - w.end.at + ddx * c->middle_x + ddy * c->middle_y;
    w.h = abs_i32(ddx) * c->middle_x + abs_i32(ddy) * c->middle_y;
    w.length = (abs_i32(mx) + abs_i32(my)) >> 1;
    int32_t moves = abs_i32(w.d) + w.h + w.bows;
    if (moves > w.length >> 7 && crossing_add(c, &w, edge))
        return true;
    if (moves > w.length >> 7) {
        c->turn[c->turns++] = (struct timemask_turning){ w.start, w.end, w.bow, w.reversed };
        return true;
    }
    /* It moves by less than 1/128 px. */
    const struct timemask_plane p = { (w.start.at + w.end.at) >> 1, mx >> 1, my >> 1 };
    c->stay[c->stays++] = w.reversed ? other_side(&p) : p;
    return true;
}

static int64_t area_of(const struct timemask_pose *p)
{
    return cross_wide(p->x[1] - p->x[0], p->y[1] - p->y[0], p->x[2] - p->x[0], p->y[2] - p->y[0]);
}

bool smear_timemask_cover(struct timemask_cover *c, const struct timemask_pose *const pose[3], int32_t width,
                          int32_t height, int32_t samples_log2, int32_t edge)
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
    c->samples_log2 = samples_log2;
    c->middle_x = (width + 1) >> 1;
    c->middle_y = (height + 1) >> 1;
    c->enters = c->leaves = c->stays = c->turns = 0;
    c->form = COVER_EVEN;
    return edge_add(c, pose, 0, 1, edge) && edge_add(c, pose, 1, 2, edge) && edge_add(c, pose, 2, 0, edge);
}

/* ------------------------------------------------------------------ edges that may do anything */

/* e(u) = start + (end - start) u + 2 bow u (1 - u), brought to 18 bits and times 4 n^2, which fits. */
struct parabola {
    int32_t start, end, bow;    /* 2 n start, 2 n end, 2 bow */
    int32_t samples;
};

/* Returns its value in the middle of a sample. */
static inline int32_t parabola_at(const struct parabola *p, int32_t sample)
{
    int32_t u = 2 * sample + 1, rest = 2 * p->samples - u;
    return rest * (p->start + p->bow * u) + p->end * u;
}

/* The first sample of (low, high] whose sign is that of `high`; that of `low` is the other one. */
static int32_t sign_change(const struct parabola *p, int32_t low, int32_t high)
{
    int32_t sign = high < p->samples ? parabola_at(p, high) : p->end;
    while (high - low > 1) {
        int32_t middle = (low + high) >> 1;
        if ((parabola_at(p, middle) ^ sign) >= 0)
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* Slots in which e >= 0. */
static uint32_t turn_mask(int32_t start, int32_t end, int32_t bow, int32_t samples_log2)
{
    const int32_t samples = 1 << samples_log2;
    uint32_t size = (uint32_t)abs_i32(start) | (uint32_t)abs_i32(end) | (uint32_t)abs_i32(bow) | 1u;
    int shift = count_leading_zeros(size) - 14, up = max_i32(shift, 0), down = max_i32(-shift, 0);
    struct parabola p = { (shl_wrap(start, up) >> down) * 2 * samples, (shl_wrap(end, up) >> down) * 2 * samples,
                          (shl_wrap(bow, up) >> down) * 2, samples };
    if ((start ^ end) < 0) {    /* it crosses once */
        uint32_t before = timemask_below(sign_change(&p, -1, samples));
        return start >= 0 ? before : ~before;
    }
    /* Not at all, or twice: around u = 1/2 + (end - start) / (4 bow), where it is farthest off. */
    if (p.bow == 0)
        return start >= 0 ? UINT32_MAX : 0;
    int32_t top = clamp_i32((samples >> 1) + (p.end - p.start) / (4 * p.bow), 0, samples - 1);
    if ((parabola_at(&p, top) ^ start) >= 0)
        return start >= 0 ? UINT32_MAX : 0;
    uint32_t away = timemask_below(sign_change(&p, top, samples)) & ~timemask_below(sign_change(&p, -1, top));
    return start >= 0 ? ~away : away;
}

/* Writes the runs of a mask. */
static int32_t put_runs(uint32_t *out, int32_t x, uint32_t mask)
{
    int32_t count = 0;
    while (mask != 0) {
        uint32_t low = mask & (0u - mask), rest = mask + low;      /* adding carries over the lowest run */
        int32_t from = 31 - count_leading_zeros(low);
        int32_t to = rest == 0 ? 32 : 31 - count_leading_zeros(rest & (0u - rest));
        out[count++] = timemask_run(x, from, to);
        mask &= ~timemask_below(to);
    }
    return count;
}

/* Returns the slots of pixel (x, y) that edges which may do anything leave. */
static uint32_t turns_leave(const struct timemask_cover *c, int32_t x, int32_t y)
{
    uint32_t mask = UINT32_MAX;
    for (int i = 0; i < c->turns; i++) {
        const struct timemask_turning *t = &c->turn[i];
        const int32_t start = timemask_plane_at(&t->start, x, y), end = timemask_plane_at(&t->end, x, y);
        const int32_t bow = timemask_plane_at(&t->bow, x, y);
        const int32_t low = min_i32(start, end) + (bow < 0 ? (bow - 1) >> 1 : 0);
        const int32_t high = max_i32(start, end) + (bow > 0 ? (bow + 1) >> 1 : 0);
        const uint32_t inside = low >= 0 ? UINT32_MAX : high < 0 ? 0 : turn_mask(start, end, bow, c->samples_log2);
        mask &= t->reversed ? ~inside : inside;
    }
    return mask;
}

/* ------------------------------------------------------------------ rows */

/* Returns the sample in which pixel (x, y) is crossed, rounded: q14 where crossings are even, else q12. */
static int32_t crossed_at(const struct timemask_cover *c, const struct timemask_crossing *p, int32_t x, int32_t y)
{
    int32_t sample = timemask_plane_at(&p->mean, x, y);
    if (c->form != COVER_EVEN)
        sample = mulh_i32(sample, timemask_plane_at(&p->curvature, x, y));
    if (c->form == COVER_BOWED) {
        const int32_t most = 1 << (CURVED_Q + c->samples_log2);
        sample = clamp_i32(sample + (most >> 1), 0, most);
        sample += ((sample >> 3) * ((most - sample) >> 3) >> (6 + c->samples_log2)) * p->bow >> 14;
    }
    return sample;
}

int32_t smear_timemask_row(const struct timemask_cover *c, int32_t y, uint32_t *out)
{
    const int q = c->form == COVER_EVEN ? SAMPLE_Q : CURVED_Q;
    const int32_t samples = 1 << c->samples_log2;
    /* Slots count from the segment's middle, but for bows. */
    const int32_t half = (c->form == COVER_BOWED ? 0 : samples << q >> 1) + (1 << (q - 1));
    int32_t count = 0;
    for (int32_t x = c->x0; x < c->x1; x++) {
        int32_t from = -half, to = (samples << q) - half, outside = 0;
        for (int i = 0; i < c->leaves; i++)
            to = min_i32(to, crossed_at(c, &c->leave[i], x, y));
        for (int i = 0; i < c->enters; i++)
            from = max_i32(from, crossed_at(c, &c->enter[i], x, y));
        to = (to + half) >> q;
        from = (from + half) >> q;
        for (int i = 0; i < c->stays; i++)
            outside |= timemask_plane_at(&c->stay[i], x, y);
        if (from < to && outside >= 0)
            count += put_runs(out + count, x, turns_leave(c, x, y) & timemask_below(to) & ~timemask_below(from));
    }
    return count;
}
