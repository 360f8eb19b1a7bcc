/* SPDX-License-Identifier: MIT */
/* tiny_cover.c - how check_kernels calls kernels/tiny_points.h. */
#include "kernels/tiny_points.h"

#include "tests/kernels/kernels.h"

enum { PLACE, CORNER, UNITS = CORNER + 3, RING = UNITS + 3, COLOR };       /* words */
enum { RINGS = 4, ENTRIES = 8 };

struct tiny {
    int32_t v[3][3];                /* x, y, units; clockwise */
    int32_t box[4];
    struct tiny_cover cover;
};

/* A triangle of up to 4 px around a box anywhere, sides of which may go through centres. False where it has no area. */
static bool make(struct tiny *t, const struct kernel_call *c)
{
    const uint32_t place = c->word[PLACE];
    const int32_t x = (int32_t)(place & 0x7ffu), y = (int32_t)(place >> 11 & 0x3ffu), step = (place >> 31) != 0 ? ~127 : ~0;
    for (int i = 0; i < 3; i++) {
        const uint32_t corner = c->word[CORNER + i];
        t->v[i][0] = x * 256 + ((int32_t)(corner & 1023u) & step) - 256;
        t->v[i][1] = y * 256 + ((int32_t)(corner >> 10 & 1023u) & step) - 256;
        t->v[i][2] = (int32_t)(4096 + c->word[UNITS + i] % ((1u << 27) - 4096u));
    }
    const int32_t area = (t->v[1][0] - t->v[0][0]) * (t->v[2][1] - t->v[0][1]) - (t->v[2][0] - t->v[0][0]) * (t->v[1][1] - t->v[0][1]);
    for (int i = 0; area < 0 && i < 3; i++) {
        const int32_t swapped = t->v[1][i];
        t->v[1][i] = t->v[2][i];
        t->v[2][i] = swapped;
    }
    t->box[0] = x;
    t->box[1] = y;
    t->box[2] = x + 1 + (int32_t)(place >> 29 & 1u);
    t->box[3] = y + 1 + (int32_t)(place >> 30 & 1u);
    t->cover = (struct tiny_cover){ .area = 0 };
    return area != 0;
}

/* Rings are empty or have entry 0 alone. */
static void points_by(struct kernel_call *c, bool best)
{
    struct tiny t;
    uint32_t last[RINGS], count = 1 + (c->word[RING] >> 8 & 1u);
    struct point_entry *const entry = c->plane[0];
    const struct points_rings r = { entry + (ENTRIES - 1), last, (1u << 22) / 512u, &count, smear_recip_seed };
    if (c->n < ENTRIES || !make(&t, c))
        return;
    for (int i = 0; i < RINGS; i++)
        last[i] = (c->word[RING] >> i & 1u) != 0 ? 0 : UINT32_MAX;
    tiny_cover_reference(&t.cover, t.box, t.v[0], t.v[1], t.v[2]);
    if (t.cover.count == 0 || t.cover.count > 2)
        return;
    if (best)
        tiny_make_points(&r, &t.cover, &t.v[0][2], &t.v[1][2], &t.v[2][2], c->word[COLOR]);
    else
        tiny_points_reference(&r, &t.cover, &t.v[0][2], &t.v[1][2], &t.v[2][2], c->word[COLOR]);
    c->word[0] = count;
    for (int i = 0; i < RINGS; i++)
        c->word[1 + i] = last[i];
    for (int i = 0; i < t.cover.count; i++)
        c->word[5 + i] = (uint32_t)t.cover.covered[i].e1 << 16 ^ (uint32_t)t.cover.covered[i].e2;
}

static void points_reference(struct kernel_call *c) { points_by(c, false); }
static void points_best(struct kernel_call *c) { points_by(c, true); }

extern const struct kernel kernels_tiny_cover[];
const struct kernel kernels_tiny_cover[] = {
    { .name = "tiny_points", .most = 40, .size = { sizeof(struct point_entry) }, .align = { 4 }, .timed = 40,
      .form = { { "reference", points_reference }, { "best", points_best } } },
    { .name = NULL }
};
