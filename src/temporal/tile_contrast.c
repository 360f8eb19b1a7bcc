/* SPDX-License-Identifier: MIT */
/* tile_contrast.c - see tile_contrast.h. */
#include "temporal/tile_contrast.h"

#include "base/pixel.h"
#include "geometry/path.h"
#include "temporal/subframe_tile.h"
#include "temporal/tile_method.h"

/* Returns a pixel at an instant: where nothing moves, what is static there. */
static inline uint32_t pixel_shown(uint32_t color, const uint32_t *behind) { return color != PACKED_NOTHING ? color : *behind; }

enum { ACROSS = 4 };    /* pixels from one that is looked at to the next of its row */

/* Some rows of n pixels at an instant, what is static behind them, and depth codes of both: larger is nearer. */
struct difference_block {
    const uint32_t *color, *behind;
    const uint16_t *depth, *deep;
    int32_t there, there_behind;        /* where the pixels lie that they are compared with, in pixels from these: in color and
                                         * depth, and in behind and deep */
    int32_t pitch, pitch_behind, first, end, n; /* pitches: from one row to the next; first: its number, as rows may come one by one */
    uint32_t fours;                     /* of how many times four pixels it stands */
};

/* Returns the squared differences of some pixels, times half of those that each stands for, and adds to *moving how many of four are not
 * as what is static: of a row those that lie between those of the row before. An edge between two pixels counts where it moves: what
 * is static must lie behind, else it hides the edge: it is shown where nothing moves. Upper eight bits of pixels may be anything: they
 * tell pixels apart, but are no difference. */
static uint32_t differences(struct difference_block b, uint32_t *moving)
{
    uint32_t sum = 0, count = 0;
    for (; b.first < b.end; b.first++, b.color += b.pitch, b.depth += b.pitch, b.behind += b.pitch_behind, b.deep += b.pitch_behind)
        for (int32_t i = (b.first & 1) * (ACROSS >> 1); i < b.n; i += ACROSS) {
            const uint32_t here = b.color[i], next = b.color[b.there + i], depth = b.depth[i], depth_there = b.depth[b.there + i];
            const bool moves = depth != b.deep[i] || (here != PACKED_NOTHING && here != b.behind[i]);
            count += moves;
            if (here == next || (!moves && depth_there < depth))
                continue;
            if (depth_there + !moves > depth && depth_there == b.deep[b.there_behind + i]
                && (next == PACKED_NOTHING || next == b.behind[b.there_behind + i]))
                continue;
            sum += pixel_square_between(pixel_shown(here, b.behind + i), pixel_shown(next, b.behind + b.there_behind + i));
        }
    *moving += count * b.fours;
    return 2 * b.fours * sum;
}

/* A block [x, x1) x [y, y1) of pixels of a tile, its displacement, and the same to the next pixels that are looked at: 2 px. */
struct look {
    const struct smear_tile_travel *tile;
    int32_t x, y, x1, y1;
    int32_t first, down; /* rows: those are looked at that lie 2^down apart, from the first on */
    int32_t way_x, way_y; /* 1/16 px */
    int32_t dx, dy;
    bool at_border; /* the tiles end above or below */
    bool spreads; /* displacements go apart by more than a pixel or two */
    uint32_t shortness; /* of what goes FAR: shortness_of() */
};

/* Squared differences of pixels behind one another on their path, and of those beside each other. */
struct look_sums {
    uint32_t along, beside, moving;
};

/* Returns 1 where rows of the tiles have the pixels that lie dy farther, -1 where those as much nearer, 0 where neither. */
static inline int32_t way_to(const struct smear_raster_target *s, int32_t y, int32_t dy)
{
    return y + dy >= s->y0 && y + dy < s->y1 ? 1 : y - dy >= s->y0 && y - dy < s->y1 ? -1 : 0;
}

/* Returns the differences of some rows' pixels to those that lie (dx, dy) farther, or nearer where those are not in
 * the tiles. All rows left are looked at together whose pixels lie in the same direction, unless those of what is static go round. */
static uint32_t look_along(const struct subframes *f, const struct look *l, int32_t dx, int32_t dy, uint32_t *moving)
{
    const struct smear_raster_target *s = &f->t->background;
    const struct smear_plane_rows *c = &s->color_rows;
    const int32_t pitch = f->t->pitch, next = 1 << l->down, last = l->first + ((l->y1 - 1 - l->first) & -next);
    const bool round = c->ring_row + (s->y1 - s->y0) > c->ring;
    uint32_t sum = 0;
    for (int32_t y = l->first, end; y < l->y1; y = end) {
        const int32_t way = way_to(s, y, dy), x = way * dx, down = way * dy;
        end = !round && way_to(s, last, dy) == way ? last + next : y + next;
        const int32_t first = max_i32(l->x, s->x0 - x), n = min_i32(l->x1, s->x1 - x) - first;
        if (way == 0 || n <= 0)
            continue;
        const int32_t at = (y - s->y0) * pitch - s->x0 + first, row = target_row(c, s, y), behind = row + first;
        const struct difference_block block = { f->work.color + at, s->color + behind, f->work.depth + at, s->depth + behind,
                                                down * pitch + x, target_row(c, s, y + down) - row + x, pitch << l->down,
                                                c->stride << l->down, (y - l->first) >> l->down, (end - l->first) >> l->down, n,
                                                1u << l->down };
        sum += differences(block, moving);
    }
    return sum;
}

static bool is_slant(const struct look *l) { return l->dx != 0 && l->dy != 0 && abs_i32(l->dx) != abs_i32(l->dy); }

static struct look_sums sums_of_look(const struct subframes *f, const struct look *l)
{
    struct look_sums d = { 0, 0, 0 };
    uint32_t ignored = 0;
    d.along = look_along(f, l, l->dx, l->dy, &d.moving);
    if (l->down == 1 && (is_slant(l) || l->spreads))
        d.beside = look_along(f, l, -l->dy, l->dx, &ignored);
    return d;
}

/* Returns a coordinate of the next pixel on a path, of which the longer coordinate is `longest`: 2.5 way / longest to nearest, at most
 * 2. */
static int32_t next_on_path(int32_t way, int32_t longest)
{
    const int32_t length = 5 * abs_i32(way), next = (length >= longest) + (length >= 3 * longest);
    return way < 0 ? -next : next;
}

enum { FAR = 16 }; /* 1/16 px */

static uint32_t add_saturated(uint32_t a, uint32_t b) { return a + min_u32(b, UINT32_MAX - a); }

/* Adds what closed gaps leave of a block where the tiles end above or below: where a gap goes a pixel down or up, as that of a steep way
 * always does, taps of the last row would lie beyond it, and that row, an eighth of the block, stays as it is. It is seen as a line
 * beside what is closed: it weighs twice. */
static void add_border(struct smear_contrast *c, uint32_t plain, int32_t across, int32_t down, int32_t last)
{
    const int at = (min_i32(last, 2 * down >= across ? last : down >> 4) + 1) >> 1;
    c->closed[at] = add_saturated(c->closed[at], plain >> 2);
}

/* Adds a block's differences times its displacement to those of the run. Returns up to how many instants gaps are closed
 * there. */
static int32_t add_block(struct smear_contrast *c, const struct look *l, const struct look_sums *d,
                         const struct smear_closing *closing)
{
    enum { MOST = 1 << 22,
           FLAT = 4000,
           ASKEW = 512 / 3 };       /* edges along the way that pass a flat block at other times would be blurred across */
    const int32_t x = abs_i32(l->way_x), y = abs_i32(l->way_y), longer = max_i32(max_i32(x, y), 1), shorter = min_i32(x, y);
    const uint32_t shortness = longer >= FAR ? l->shortness : 16;
    const uint32_t whole = min_u32((d->along >> 6) * (uint32_t)longer >> 4, 2 * MOST - 1) * shortness >> 4;
    const uint32_t plain = min_u32(whole, MOST);
    /* Taps lie on whole pixels: what lies beside the path is mixed in by as much as they are off it. */
    const uint32_t off = (uint32_t)(512 * min_i32(shorter, longer - shorter) / longer);
    /* Where displacements go apart, taps of a gap leave the path for what lies beside it. */
    const uint32_t beside = l->spreads ? min_u32((d->beside >> 6) * (uint32_t)min_i32(closing->unlike, 1024) >> 7, MOST) : 0;
    const uint32_t floor = ((plain >> 7) * closing->floor >> 9) + ((d->beside >> 5) * off >> 11)
                         + beside / max_u32((uint32_t)(longer * longer) >> 10, 1);
    int32_t last = closing->last;
    if (last != 0 && (d->along + d->beside >= FLAT || off >= ASKEW))
        last = min_i32(closed_instants(plain >> 1, max_u32(floor, 1)), last);
    const int at = (last + 1) >> 1;
    c->plain[at] = add_saturated(c->plain[at], whole);
    c->closed[at] = add_saturated(c->closed[at], (plain * closing->left >> 8) + beside);
    c->rounded[at] = add_saturated(c->rounded[at], (plain >> 7) * closing->rounded >> 9);
    c->floor[at] = add_saturated(c->floor[at], floor);
    if (l->at_border && last != 0)
        add_border(c, plain, x, y, last);
    return last;
}

/* Returns how far goes what is seen of a block. */
static struct smear_step way_of(const struct subframes *f, const struct smear_tile_travel *tile, const struct smear_block *b)
{
    if (f->passing.sparks)      /* which have no place in blocks */
        return smear_tile_way(tile);
    if (b->depth != 0)
        return (struct smear_step){ b->x, b->y };
    /* A large surface moves there, or is not known; or a corner of what lies in another block. */
    return (tile->flags & (PATH_SPACE | PATH_LARGE)) != 0 ? (struct smear_step){ tile->x, tile->y } : smear_tile_way(tile);
}

static void look_at_block(struct smear_contrast *c, const struct subframes *f, const struct smear_tile_plan *plan,
                          struct look *l, bool drawn)
{
    enum { LEFT = 55,       /* q8: gaps are closed where that leaves a fifth of the squared error at most */
           SHORT = 8 * 16 };        /* 1/16 px: the ends of shorter ways weigh more than what gaps below a pixel win; of light over
                                     * dark, where little is many codes, than those below two */
    const struct smear_tile_run *t = f->t;
    const struct smear_tile_travel *tile = l->tile;
    const int32_t y0 = t->background.y0, rows = (t->background.y1 - y0 + BLOCK_PX - 1) >> BLOCK_SHIFT,
                  column = l->x >> BLOCK_SHIFT, row = (l->y - y0) >> BLOCK_SHIFT;
    struct smear_block *b = block_at(plan->blocks, column, row);
    struct smear_closing closing = { 256, 0, 0, 0, 0 };
    const bool has_surface = b->depth != 0;
    if (!f->blends && smear_tile_may_close(plan->chooser, tile))
        closing = has_surface ? smear_block_closing(plan->blocks, column, row, rows) : smear_tile_closing(tile);
    if (closing.left > LEFT)        /* what goes otherwise beside it would be blurred along its way */
        closing.last = 0;
    const struct smear_step way = way_of(f, tile, b);
    l->way_x = way.x;
    l->way_y = way.y;
    const int32_t longest = max_i32(max_i32(abs_i32(l->way_x), abs_i32(l->way_y)), 1);
    if (longest < SHORT)
        closing.last = min_i32(closing.last, longest >> (transfer_is_linear(plan->chooser->transfer) ? 5 : 4));
    b->last = (uint8_t)closing.last;
    if (!drawn)
        return;
    l->dx = next_on_path(l->way_x, longest);
    l->dy = next_on_path(l->way_y, longest);
    l->spreads = closing.last != 0 && closing.unlike >= 32;
    const struct look_sums d = sums_of_look(f, l);
    c->moving += d.moving;
    if (d.moving != 0)
        b->last = (uint8_t)add_block(c, l, &d, &closing);
    c->last = max_i32(c->last, b->last);
}

/* Returns the first row of a block that is looked at: of the rows that end the tiles, above or below, none is left out, as an edge
 * may reach just one of them. Blocks that are all of a tile's height take turns. Of a sketch it is the middle one. */
static int32_t first_row(const struct look *l, int32_t y0, int32_t y1)
{
    const bool is_last = l->y1 == y1 && (l->y != y0 || (l->x & BLOCK_PX) != 0);
    return l->down == BLOCK_SHIFT ? (l->y + l->y1) >> 1 : l->y + (is_last ? (y1 - 1 - l->y) & 1 : 0);
}

/* ------------------------------------------------------------------ what is small */

/* The tiles, q8 pixels. */
static inline uint32_t area_of(const struct subframes *f)
{
    return (uint32_t)((f->t->x1 - f->t->x0) * (f->t->background.y1 - f->t->background.y0)) << 8;
}

/* A triangle along an axis, px. */
struct extent {
    int32_t size, middle;       /* in the middle of the exposure */
    int32_t path;               /* pixels of the frame on its path */
    int32_t over;               /* those of the tiles among them */
};

/* Finds it among `frame` pixels, of which the tiles have [x0, x1): bounds are of the part of the frame that is drawn. */
static struct extent extent_of(const struct smear_bins *g, const struct smear_triangle *t, int axis, int32_t frame, int32_t x0, int32_t x1)
{
    const struct smear_segment *s = &g->segment[t->segment];
    int32_t low = INT32_MAX, high = INT32_MIN, first = INT32_MAX, last = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = bins_vertex(g, s, t->vertex[i]) + axis, open = v[s->motion], close = v[s->motion + PATH_POSE_WORDS];
        low = min_i32(low, *v);
        high = max_i32(high, *v);
        first = min_i32(first, min_i32(open, close));
        last = max_i32(last, max_i32(open, close));
    }
    first = max_i32(min_i32(first, low) >> 8, 0);
    last = min_i32((max_i32(last, high) >> 8) + 1, frame);
    return (struct extent){ max_i32((high - low + 128) >> 8, 1), (low + high) >> 9, last - first, min_i32(last, x1) - max_i32(first, x0) };
}

static void add_covered(struct subframe_passing *p, uint32_t part, bool blended)
{
    p->covered = add_saturated(p->covered, part);
    if (!blended)
        p->opaque = add_saturated(p->opaque, part);
}

void smear_note_passing(struct subframes *f, uint32_t triangle, bool blended)
{
    enum { SMALL = 32,      /* px */
           LARGE = 128 };   /* and what is larger says nothing of small things before it */
    const struct smear_bins *g = f->t->frame->bins;
    const struct smear_path_bounds *b = bins_bounds(g, triangle);
    const struct smear_tile_run *t = f->t;
    const struct smear_triangle *of = bins_triangle(g, triangle);
    const int32_t y0 = t->background.y0, y1 = t->background.y1;
    struct subframe_passing *p = &f->passing;
    /* More would say no more. It is told from opaque triangles alone: where the store is filled several times, blended ones
     * come between them. */
    const bool is_full = p->opaque >= area_of(f) && !blended;
    if (b->space != 0 && !blended) {
        const uint32_t draw = 1u << (g->segment[of->segment].draw & 31u);
        struct posed at;
        p->in_space = true;
        for (int32_t k = 1; k < 8 && (f->space->seen & draw) == 0; k += 2)
            smear_subframe_pose(&at, f, triangle, SHUTTER_CLOSE / 8 * k);
    }
    if (b->travel < FAR || b->space != 0 || is_full)
        return;
    const struct extent x = extent_of(g, of, VERTEX_X, t->frame->width, t->x0, t->x1),
                        y = extent_of(g, of, VERTEX_Y, t->frame->height, y0, y1);
    const int32_t larger = max_i32(x.size, y.size);
    if (x.over <= 0 || y.over <= 0 || larger > LARGE)
        return;
    const uint32_t over = (uint32_t)(x.over * y.over);
    if (larger > SMALL) {
        add_covered(p, over << 7, blended);
        return;
    }
    const uint32_t part = (over << 8) / (uint32_t)(x.path * y.path);       /* of the path */
    const uint32_t way = (uint32_t)(y.size * max_i32(x.path - x.size, 0) + x.size * max_i32(y.path - y.size, 0));
    p->ways = add_saturated(p->ways, way * part);
    add_covered(p, (uint32_t)(x.size * y.size) * part >> 1, blended);
    if (x.middle >= t->x0 && x.middle < t->x1 && y.middle >= y0 && y.middle < y1)
        p->seen = add_saturated(p->seen, way << 8);
    p->sparks = p->sparks || (blended && b->travel >= 3 * FAR);
}

/* Returns a pixel of the tiles at an instant, of a row and column. */
static uint32_t pixel_shown_at(const struct subframes *f, int32_t row, int32_t column)
{
    const struct smear_raster_target *s = &f->t->background;
    return pixel_shown(f->work.color[row * f->t->pitch + column - s->x0], s->color + target_row(&s->color_rows, s, s->y0 + row) + column);
}

/* Returns how much larger the squared error of what moves is where it covers each pixel for a short time only, q4. There are
 * few edges, whose errors may all be large: up to twice as much. And in linear light a little on what is dark is many codes:
 * light over dark ones errs by as much as it is shorter there, and by 16 at most (the mean of all colours over black, those of
 * 32, 64, 96 ... by half of that each). */
static uint32_t shortness_of(const struct subframes *f, bool linear)
{
    const struct subframe_passing *p = &f->passing;
    const struct smear_tile_run *t = f->t;
    const int32_t wide = t->x1 - t->x0, tall = t->background.y1 - t->background.y0;
    if (p->covered == 0)
        return 16;
    const uint32_t parts = min_u32(p->ways, area_of(f)) / p->covered, few = min_u32(max_u32(parts, 4), 8) << 2;
    uint32_t most = 0, n = 0;
    for (int32_t x = 0; linear && x < wide; x += BLOCK_PX, n += 3) {
        const uint32_t c = pixel_shown_at(f, tall >> 1, t->x0 + x);
        most += (16u >> (pixel_red(c) >> 5)) + (16u >> (pixel_green(c) >> 5)) + (16u >> (pixel_blue(c) >> 5));
    }
    return few * (linear ? max_u32(min_u32(parts + (parts >> 1), most / n), 1) : 1);
}

enum { COMMON_CONTRAST = 10000 >> (2 * BLOCK_SHIFT) };      /* to what is behind, codes^2, summed over red, green and blue, of a block */

/* Returns what small things leave that pass at other times than in the middle of the exposure, where there is room between
 * them: one of many looks much like the next. */
static uint32_t unseen_of(const struct subframe_passing *p, uint32_t area)
{
    const bool is_empty = p->covered < area >> 2;
    return is_empty && p->ways / 2 > p->seen ? min_u32((p->ways - 2 * p->seen) >> 8, 65535) * COMMON_CONTRAST : 0;
}

/* Returns at how many pixels that is looked for: about one of eight, at most. */
static int32_t pixels_shown(const struct subframes *f) { return clamp_i32((int32_t)(area_of(f) >> 11), 1, PIXELS_SHOWN); }

void smear_note_changes(const struct subframes *f, bool is_first)
{
    enum { APART = 27 };        /* rows from one to the next, of 64 and round: they lie evenly */
    const struct smear_tile_run *t = f->t;
    const struct smear_raster_target *s = &t->background;
    const int32_t n = pixels_shown(f), step = ((t->x1 - t->x0) << 16) / n;
    struct subframe_changes *c = f->changes;
    for (int32_t i = 0; i < n; i++) {
        const int32_t column = t->x0 + ((2 * i + 1) * (step >> 1) >> 16), row = (s->y1 - s->y0) * (i * APART & 63) >> 6;
        if (column < f->work.x0 || column >= f->work.x1)
            continue;
        const uint32_t here = pixel_shown_at(f, row, column);
        if (!is_first)
            c->sum = add_saturated(c->sum, pixel_square_between(here, c->shown[i]));
        c->shown[i] = here;
    }
}

void smear_add_changes(struct smear_contrast *c, const struct subframes *f, const struct subframe_changes *changes)
{
    const uint32_t each = (area_of(f) >> 8) / (uint32_t)pixels_shown(f), between = min_u32(changes->sum >> 6, UINT32_MAX / each) * each;
    const uint32_t all = add_saturated(between, between / (f->instants - 1));       /* before the first and behind the last, too */
    uint32_t seen = 0;
    for (int k = 0; k < CLOSING_CLASSES; k++)
        seen = add_saturated(seen, c->plain[k]);
    c->changed = all - all / 3 > seen ? all - seen : 0;         /* few pixels tell: half as much more may be chance */
}

/* ------------------------------------------------------------------ all */

void smear_tile_contrast(struct smear_contrast *c, const struct subframes *f, const struct smear_tile_plan *plan,
                         const struct subframe_box *box)
{
    const struct smear_tile_run *t = f->t;
    const int32_t y0 = t->background.y0, y1 = t->background.y1;
    const bool is_sketch = target_is_sketch(plan->chooser->target);
    struct look look = { .down = is_sketch ? BLOCK_SHIFT : 1,
                         .shortness = shortness_of(f, transfer_is_linear(plan->chooser->transfer)) };
    __builtin_memset(c, 0, sizeof *c);
    c->unseen = (unseen_of(&f->passing, area_of(f)) >> 4) * look.shortness;
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
