/* SPDX-License-Identifier: MIT */
/* tile_contrast.c - see tile_contrast.h. */
#include "temporal/tile_contrast.h"

#include "kernels/differences.h"
#include "temporal/tile_method.h"

/* A block [x, x1) x [y, y1) of pixels of a tile, its displacement, and the same to the next pixels that are looked at: 2 px. */
struct look {
    const struct smear_tile_travel *tile;
    int32_t x, y, x1, y1;
    int32_t first; /* row: every other one is looked at from there on */
    int32_t way_x, way_y; /* 1/16 px */
    int32_t dx, dy;
    bool at_border; /* the tiles end above or below */
    bool spreads; /* displacements go apart by more than a pixel or two */
};

/* Squared differences of pixels behind one another on their path, and of those beside each other. */
struct look_sums {
    uint32_t along, beside, moving;
};

#if SMEAR_AVX2 || DIFFERENCES_ASM_ARMV6M
/* Returns 1 where rows of the tiles have the pixels that lie dy farther, -1 where those as much nearer, 0 where neither. */
static inline int32_t way_to(const struct smear_raster_target *s, int32_t y, int32_t dy)
{
    return y + dy >= s->y0 && y + dy < s->y1 ? 1 : y - dy >= s->y0 && y - dy < s->y1 ? -1 : 0;
}

/* Returns the differences of every other row's pixels to those that lie (dx, dy) farther, or nearer where those are not in
 * the tiles. All rows left are looked at together whose pixels lie in the same direction, unless those of what is static go round. */
static uint32_t look_along(const struct subframes *f, const struct look *l, int32_t dx, int32_t dy, uint32_t *moving)
{
    const struct smear_raster_target *s = &f->t->background;
    const struct smear_plane_rows *c = &s->color_rows;
    const int32_t pitch = f->t->pitch, last = l->first + ((l->y1 - 1 - l->first) & ~1);
    const bool round = c->ring_row + (s->y1 - s->y0) > c->ring;
    uint32_t sum = 0;
    for (int32_t y = l->first, end; y < l->y1; y = end) {
        const int32_t way = way_to(s, y, dy), x = way * dx, down = way * dy;
        end = !round && way_to(s, last, dy) == way ? last + 2 : y + 2;
        const int32_t first = max_i32(l->x, s->x0 - x), n = min_i32(l->x1, s->x1 - x) - first;
        if (way == 0 || n <= 0)
            continue;
        const int32_t at = (y - s->y0) * pitch - s->x0 + first, row = target_row(c, s, y), behind = row + first;
        const struct difference_block block = { { f->work.color + at, s->color + behind, f->work.depth + at, s->depth + behind,
                                                  down * pitch + x, target_row(c, s, y + down) - row + x },
                                                2 * pitch, 2 * c->stride, (end - y) >> 1, n };
        sum += difference_block(&block, moving);
    }
    return sum;
}
#else
/* Returns the differences of every other row's pixels to those that lie (dx, dy) farther, or nearer where those are not in
 * the tiles. */
static uint32_t look_along(const struct subframes *f, const struct look *l, int32_t dx, int32_t dy, uint32_t *moving)
{
    const struct smear_raster_target *s = &f->t->background;
    const int32_t pitch = f->t->pitch;
    uint32_t sum = 0;
    for (int32_t y = l->first; y < l->y1; y += 2) {
        int32_t x = dx, down = dy;
        if (y + down < s->y0 || y + down >= s->y1) {
            x = -x;
            down = -down;
            if (y + down < s->y0 || y + down >= s->y1)
                continue;
        }
        const int32_t first = max_i32(l->x, s->x0 - x), n = min_i32(l->x1, s->x1 - x) - first;
        const int32_t at = (y - s->y0) * pitch - s->x0 + first, behind = target_row(&s->color_rows, s, y) + first;
        if (n <= 0)
            continue;
        const struct difference_rows rows = { f->work.color + at, s->color + behind, f->work.depth + at, s->depth + behind,
                                              down * pitch + x,
                                              target_row(&s->color_rows, s, y + down) + first + x - behind };
        sum += differences_reference(&rows, n, moving);
    }
    return sum;
}
#endif

static bool is_slant(const struct look *l) { return l->dx != 0 && l->dy != 0 && abs_i32(l->dx) != abs_i32(l->dy); }

static struct look_sums sums_of_look(const struct subframes *f, const struct look *l)
{
    struct look_sums d = { 0, 0, 0 };
    uint32_t ignored = 0;
    d.along = look_along(f, l, l->dx, l->dy, &d.moving);
    if (is_slant(l) || l->spreads)
        d.beside = look_along(f, l, -l->dy, l->dx, &ignored);
    return d;
}

/* Returns a coordinate of the next pixel on a path, of which the longer coordinate is `longest`: 2.5 way / longest to
 * nearest, at most 2. */
static int32_t next_on_path(int32_t way, int32_t longest)
{
    const int32_t length = 5 * abs_i32(way), next = (length >= longest) + (length >= 3 * longest);
    return way < 0 ? -next : next;
}

static uint32_t add_saturated(uint32_t a, uint32_t b) { return a + min_u32(b, UINT32_MAX - a); }

/* Adds what closed gaps leave of a block where the tiles end above or below: where a gap goes more than a pixel down or up,
 * taps of the last row would lie beyond it, and that row, an eighth of the block, stays as it is. It is seen as a line
 * beside what is closed: it weighs twice. */
static void add_border(struct smear_contrast *c, uint32_t plain, int32_t down, int32_t last)
{
    const int at = (min_i32(last, down >> 4) + 1) >> 1;
    c->closed[at] = add_saturated(c->closed[at], plain >> 2);
}

/* Adds a block's differences times its displacement to those of the run. Returns up to how many instants gaps are closed
 * there. */
static int32_t add_block(struct smear_contrast *c, const struct look *l, const struct look_sums *d,
                         const struct smear_closing *closing)
{
    enum { MOST = 1 << 22,
           FLAT = 4000 };
    const int32_t x = abs_i32(l->way_x), y = abs_i32(l->way_y), longer = max_i32(max_i32(x, y), 1), shorter = min_i32(x, y);
    const uint32_t whole = (d->along >> 6) * (uint32_t)longer >> 4, plain = min_u32(whole, MOST);
    /* Taps lie on whole pixels: what lies beside the path is mixed in by as much as they are off it. */
    const uint32_t off = (uint32_t)(512 * min_i32(shorter, longer - shorter) / longer);
    const uint32_t floor = ((plain >> 7) * closing->floor >> 9) + ((d->beside >> 5) * off >> 11);
    int32_t last = closing->last;
    if (last != 0 && d->along + d->beside >= FLAT)
        last = closed_instants(plain * (256 - closing->left) >> 8, max_u32(floor, 1));
    const int at = (last + 1) >> 1;
    c->plain[at] = add_saturated(c->plain[at], whole);
    /* Where displacements go apart, taps of a gap leave the path for what lies beside it. */
    const uint32_t beside = l->spreads ? min_u32((d->beside >> 6) * (uint32_t)min_i32(closing->unlike, 1024) >> 7, MOST) : 0;
    c->closed[at] = add_saturated(c->closed[at], (plain * closing->left >> 8) + beside);
    c->floor[at] = add_saturated(c->floor[at], floor);
    if (l->at_border && last != 0)
        add_border(c, plain, y, last);
    return last;
}

static void look_at_block(struct smear_contrast *c, const struct subframes *f, const struct smear_tile_plan *plan,
                          struct look *l, bool drawn)
{
    const struct smear_tile_run *t = f->t;
    const struct smear_tile_travel *tile = l->tile;
    const int32_t y0 = t->background.y0, rows = (t->background.y1 - y0 + BLOCK_PX - 1) >> BLOCK_SHIFT,
                  column = l->x >> BLOCK_SHIFT, row = (l->y - y0) >> BLOCK_SHIFT;
    struct smear_block *b = block_at(plan->blocks, column, row);
    struct smear_closing closing = { 256, 0, 0, 0 };
    const bool has_surface = b->depth != 0;
    if (!f->blends && smear_tile_may_close(plan->chooser, tile))
        closing = has_surface ? smear_block_closing(plan->blocks, column, row, rows) : smear_tile_closing(tile);
    l->way_x = has_surface ? b->x : tile->x;
    l->way_y = has_surface ? b->y : tile->y;
    b->last = (uint8_t)closing.last;
    if (!drawn)
        return;
    const int32_t longest = max_i32(max_i32(abs_i32(l->way_x), abs_i32(l->way_y)), 1);
    l->dx = next_on_path(l->way_x, longest);
    l->dy = next_on_path(l->way_y, longest);
    l->spreads = closing.last != 0 && closing.unlike >= 32;
    const struct look_sums d = sums_of_look(f, l);
    c->moving += d.moving;
    if (d.moving != 0)
        b->last = (uint8_t)add_block(c, l, &d, &closing);
}

/* Returns the first row of a block that is looked at: of the rows that end the tiles, above or below, none is left out, as an edge
 * may reach just one of them. Blocks that are all of a tile's height take turns. */
static int32_t first_row(const struct look *l, int32_t y0, int32_t y1)
{
    const bool is_last = l->y1 == y1 && (l->y != y0 || (l->x & BLOCK_PX) != 0);
    return l->y + (is_last ? (y1 - 1 - l->y) & 1 : 0);
}

void smear_tile_contrast(struct smear_contrast *c, const struct subframes *f, const struct smear_tile_plan *plan,
                         const struct subframe_box *box)
{
    const struct smear_tile_run *t = f->t;
    const int32_t y0 = t->background.y0, y1 = t->background.y1;
    struct look look;
    __builtin_memset(c, 0, sizeof *c);
    for (look.y = y0; look.y < y1; look.y = look.y1) {
        look.y1 = min_i32(look.y + BLOCK_PX, y1);
        look.at_border = look.y == y0 || look.y1 == y1;
        look.tile = plan->travel;
        for (look.x = t->x0; look.x < t->x1; look.x = look.x1) {
            look.x1 = min_i32(look.x + BLOCK_PX, t->x1);
            look.first = first_row(&look, y0, y1);
            c->blocks++;
            look_at_block(c, f, plan, &look,
                          look.x < box->x1 && look.x1 > box->x0 && look.y < box->y1 && look.y1 > box->y0);
            look.tile += ((look.x1 - t->x0) & (t->tile - 1)) == 0;
        }
    }
}
