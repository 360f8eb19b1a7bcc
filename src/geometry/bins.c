/* SPDX-License-Identifier: MIT */
/* bins.c - rings of triangles per tile row, and the list that rolls down the frame with the window. */
#include "geometry/bins.h"

void smear_bins_reset(struct smear_bins *g, int first, int end)
{
    g->vertex_words = bins_kept(g);
    g->triangle_count = 0;
    g->segment_count = 0;
    if (SMEAR_POOL_PARTS)
        g->parts_end = 0;
    g->row_recip = ((1u << 22) + (uint32_t)g->row_px - 1) / (uint32_t)g->row_px;
    g->row_first = first;
    g->row_end = end;
    for (int row = first; row < end; row++)
        g->opaque_last[row] = g->blend_last[row] = SMEAR_NO_TRIANGLE;
    for (int row = first; g->moving_last != NULL && row < end + g->moving_rows; row++)
        g->moving_last[row] = SMEAR_NO_TRIANGLE;
    for (int list = 0; list < g->more_lists; list++)
        for (int row = first; row < end; row++)
            bins_more(g, list)[row] = SMEAR_NO_TRIANGLE;
}

struct smear_segment *smear_bins_open(struct smear_bins *g)
{
    if (g->segment_count == min_u32(g->segment_limit, SMEAR_POINT))
        return NULL;
    struct smear_segment *s = &g->segment[g->segment_count++];
    s->base = g->vertex_words;
    return s;
}

/* What is asked of triangles of one segment after the other. */
struct reach {
    const int32_t *y;           /* of its vertices */
    uint32_t segment;
    bool path;
};

/* Whether the triangle covers a pixel centre at or below pixel row y. */
static inline bool reaches(const struct smear_bins *g, const struct smear_triangle *t, int32_t y, struct reach *r)
{
    if (t->segment != r->segment) {
        if (t->segment == SMEAR_POINT)
            return t->vertex[POINT_Y] >= y;
        const struct smear_segment *s = &g->segment[t->segment];
        *r = (struct reach){ bins_vertex(g, s, VERTEX_Y), t->segment, s->path != 0 };
    }
    if (r->path)
        return ((const struct smear_path_bounds *)(const void *)(t + 1))->y1 > y;
    const int32_t end = y * 256 + 128 - bins_margin(g) * 256;
    return r->y[t->vertex[0]] > end || r->y[t->vertex[1]] > end || r->y[t->vertex[2]] > end;
}

uint32_t smear_bins_merge(const struct smear_bins *g, const uint32_t *last, uint32_t head, int row, int32_t y)
{
    struct smear_triangle *const top = bins_triangle(g, 0);
    struct reach reach = { NULL, SMEAR_NO_TRIANGLE, false };
    uint32_t fresh = SMEAR_NO_TRIANGLE;
    if (last[row] != SMEAR_NO_TRIANGLE) {       /* open the ring: from here on it is a list */
        struct smear_triangle *t = top - last[row];
        fresh = t->next;
        t->next = SMEAR_NO_TRIANGLE;
    }
    uint32_t first = SMEAR_NO_TRIANGLE;
    uint32_t *link = &first;
    while (head != SMEAR_NO_TRIANGLE) {
        struct smear_triangle *t = top - head;
        const uint32_t after = t->next;
        if (reaches(g, t, y, &reach)) {
            while (fresh < head) {          /* none is the largest number */
                *link = fresh;
                link = &(top - fresh)->next;
                fresh = *link;
            }
            *link = head;
            link = &t->next;
        }
        head = after;
    }
    *link = fresh;
    return first;
}

uint32_t smear_bins_advance(const struct smear_bins *g, const uint32_t *last, uint32_t head, int row)
{
    return smear_bins_merge(g, last, head, row, row * g->row_px);
}
