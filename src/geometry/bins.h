/* SPDX-License-Identifier: MIT */
/* bins.h - where the triangles of a frame lie until they are drawn.
 *
 * One block of memory. Vertices grow from the bottom, in records whose layout is set per segment; triangles
 * grow from the top. A triangle is linked into the tile row in which it starts; rows keep their lists as
 * rings, in submission order, so one word per row is enough:
 *
 *     | vertices ->                  free                  <- triangles |
 *
 * Vertices are shared between triangles through the vertex cache, so a closed mesh keeps about half a record
 * per triangle. A triangle that covers one or two pixel centres may be kept as these pixels, finished but for
 * the depth test: points, in entries of the same size. */
#ifndef SMEAR_BINS_H
#define SMEAR_BINS_H

#include "smear.h"

#include "base/compiled.h"
#include "base/fixed.h"

#define SMEAR_NO_TRIANGLE UINT32_MAX

struct smear_triangle {
    uint16_t vertex[3];     /* words from the segment's base; clockwise on the screen. A point: POINT_X ... */
    uint16_t segment;       /* SMEAR_POINT: a point */
    uint32_t next;          /* in its row's ring, later in the row's list */
    uint32_t color;         /* 0xAARRGGBB: flat colour, or flat light over a texture */
};

enum { POINT_X, POINT_Y, POINT_DEPTH };      /* pixel and depth code of a point */

/* The number of a segment that stands for a point, which is opaque and does not move. */
#define SMEAR_POINT 0xffffu

/* What is seen of a triangle with a path during the exposure. It lies in the entry before the triangle's own. */
struct smear_path_bounds {
    int16_t x0, y0, x1, y1; /* pixels of the frame whose centres may be covered */
    uint16_t travel;        /* the longest travel of a vertex from open to close, 1/16 px, saturated */
    uint16_t curvature;     /* the largest of a vertex, 1/16 px, saturated: |open + close - 2 middle| along x or y */
    uint16_t nearest;       /* depth code that is not exceeded */
    uint8_t flags;          /* PATH_TEXTURED ... */
    uint8_t space;          /* bit k: vertex k moves along a path in space (space.h); PATH_REVERSED */
};

enum {
    PATH_TEXTURED = 1,
    PATH_SUBFRAMES = 2,     /* a cutout or blended: closed forms do not hold */
    PATH_SPACE = 4,         /* a vertex moves along a path in space */
    PATH_FLAT = 8,          /* vertices have (nearly) one colour, which is the triangle's `color` */
    PATH_LARGE = 16         /* its path is seen in more than PATH_LARGE_PX pixels of the frame along x or y */
};

enum { PATH_LARGE_PX = 24 };        /* smaller ones lie in few tiles */
enum { PATH_REVERSED = 8 };         /* in smear_path_bounds.space: the vertices are not in the mesh's order */

enum smear_shade_mode {
    SHADE_NONE,             /* texel alone */
    SHADE_FLAT,             /* triangle.color (times texel) */
    SHADE_GOURAUD           /* vertex colours (times texel) */
};

/* Triangles of one draw whose vertices lie within reach of 16-bit offsets. Vertex record, in 32-bit words:
 * x y depth, then at the given offsets (0: absent) uv (1 word), color (2 words), motion (3 or 6 words). */
struct smear_segment {
    uint32_t base;          /* first word */
    uint16_t draw;
    uint8_t stride;
    uint8_t uv, color, motion;
    uint8_t shade;          /* smear_shade_mode */
    uint8_t moves;          /* 0: it is static. 1: the open pose differs. 2: the close pose, too */
    uint8_t flat_depth;     /* orthographic: depth is not 1/w, nothing needs a perspective division. 1 + log2 of W in space */
    uint8_t flat;           /* its triangles are flat, though vertices had colours: all the same */
    uint8_t path;           /* 1: places at shutter open and close at `motion` (path.h) in
                             * place of motion words; moves is 0 */
    int8_t scale;           /* of paths in space: log2 of distances per unit (struct smear_projection) */
};

/* These are false at compile time where the methods and surfaces that need them were left out. */
static inline bool segment_flat_depth(const struct smear_segment *s)
{
    return SMEAR_WITH_VIEWS && s->flat_depth;
}

static inline bool segment_textured(const struct smear_segment *s)
{
    return SMEAR_WITH_TEXTURE && s->uv != 0;
}

static inline bool segment_gouraud(const struct smear_segment *s)
{
    return SMEAR_WITH_GOURAUD && s->shade == SHADE_GOURAUD;
}

/* Whether draws with vertex colours or normals are looked at for triangles of one colour each: not where size counts, but
 * for fog, in which pixels show whether that was done. */
#define SMEAR_FIND_FLAT (SMEAR_WITH_GOURAUD && (SMEAR_WITH_FOG || !SMEAR_SMALL_FILE))

/* Whether colours come from vertices: of each, or one for all three where they are flat. */
static inline bool segment_by_vertices(const struct smear_segment *s)
{
    return segment_gouraud(s) || (SMEAR_FIND_FLAT && s->flat);
}

static inline bool segment_colored(const struct smear_segment *s)
{
    return SMEAR_WITH_GOURAUD && s->color != 0;
}

static inline int segment_moves(const struct smear_segment *s)
{
    return SMEAR_WITH_RECONSTRUCT ? s->moves : 0;
}

/* Words of a vertex record. */
enum { VERTEX_X, VERTEX_Y, VERTEX_DEPTH, VERTEX_BASE_WORDS };

/* Words of one pose in `motion`. For a vertex at X = x/w now and (x', y', w') in the pose they are r = w'/w, by which
 * the two depths compare, and x'/w - r X, the displacement times r. Nothing is divided by w', so a pose may lie
 * behind the eye; a pixel's place in the pose is the quotient of the interpolated words (velocity.c). */
enum { MOTION_DX, MOTION_DY, MOTION_RATIO, MOTION_WORDS };      /* q8 px, q8 px, q20 */

/* In so many words of the pool any triangle finds room that no other is in. */
enum { POOL_WORDS_LEAST = 64 };

struct smear_bins {
    uint32_t *pool;
    uint32_t pool_words;
    uint32_t kept_words;            /* at the bottom, which are not emptied: ranges.h */
    uint8_t range_shift;            /* log2 of the triangles of a range */
    uint8_t more_lists;
    uint32_t vertex_words;          /* in use, from the bottom */
    uint32_t triangle_count;        /* in use, from the top: below them the store is free */
    /* Where cores filled parts of the pool: the triangles of all, and the end of their numbers. Else 0, and both are triangle_count. */
    uint32_t parts_listed, parts_end;
    struct smear_segment *segment;
    uint32_t segment_count, segment_limit;
    const struct smear_shot *shot;  /* before whose camera paths in space are cut */
    /* The last triangle of each tile row's rings, or none. Moving triangles are opaque or cut out and have a path. */
    uint32_t *opaque_last, *blend_last, *moving_last;
    uint32_t *more_last;            /* of opaque ones in more_lists more, row_count each (temporal/lines.h); or null */
    uint16_t moving_rows;           /* rows of moving_last beyond row_count: 0, or 2 with blurred layers (layer.h) */
    uint16_t margin;                /* with smooth edges 1: so many pixels beyond the centres that it covers, a triangle may be
                                     * seen, and is in lists. Else 0 */
    int row_px;                     /* pixel rows of a tile row */
    int row_count;
    uint32_t row_recip;             /* 2^22 / row_px, rounded up */
    int row_first, row_end;         /* tile rows that are being filled: a part of the frame */
};

/* Parts of the pool may be filled by several cores. */
#define SMEAR_POOL_PARTS (SMEAR_WITH_WORKERS && !SMEAR_SMALL_CODE)

static inline bool bins_in_parts(const struct smear_bins *g) { return SMEAR_POOL_PARTS && g->parts_end != 0; }

/* Returns the last triangles of each tile row in one of those lists. */
static inline uint32_t *bins_more(const struct smear_bins *g, int list) { return g->more_last + list * g->row_count; }

/* Returns how many triangles all lists have together. */
static inline uint32_t bins_listed(const struct smear_bins *g) { return bins_in_parts(g) ? g->parts_listed : g->triangle_count; }

/* Returns a number above those of all triangles. */
static inline uint32_t bins_end(const struct smear_bins *g) { return bins_in_parts(g) ? g->parts_end : g->triangle_count; }

static inline int bins_margin(const struct smear_bins *g) { return SMEAR_EDGES ? g->margin : 0; }

static inline struct smear_triangle *bins_triangle(const struct smear_bins *g, uint32_t i)
{
    return (struct smear_triangle *)(void *)(g->pool + g->pool_words) - (i + 1);
}

static inline const int32_t *bins_vertex(const struct smear_bins *g, const struct smear_segment *s, uint16_t offset)
{
    return (const int32_t *)(const void *)(g->pool + s->base + offset);
}

static inline bool bins_has_room(const struct smear_bins *g, uint32_t vertex_words, uint32_t triangles)
{
    uint32_t triangle_words = (g->triangle_count + triangles) * (sizeof(struct smear_triangle) / 4);
    return g->vertex_words + vertex_words + triangle_words <= g->pool_words;
}

/* Ranges of triangles are told apart (ranges.h) where size does not count. */
#define SMEAR_RANGES (!SMEAR_SMALL_CODE)

static inline uint32_t bins_kept(const struct smear_bins *g) { return SMEAR_RANGES ? g->kept_words : 0; }

/* Triangles of a list, from `head` on; or, while other cores go on with that, those of these numbers. */
struct smear_list {
    uint32_t head;
    const uint32_t *number, *end;       /* null: by the head */
};

/* Returns the first of a list; SMEAR_NO_TRIANGLE where there is none. */
SMEAR_INLINE_ALWAYS uint32_t list_first(const struct smear_list *l)
{
    return !SMEAR_POOL_PARTS || l->number == NULL ? l->head : l->number != l->end ? *l->number : SMEAR_NO_TRIANGLE;
}

/* Goes on behind it. */
SMEAR_INLINE_ALWAYS void list_next(struct smear_list *l, const struct smear_triangle *first)
{
    if (SMEAR_POOL_PARTS && l->number != NULL)
        l->number++;
    else
        l->head = first->next;
}

/* Memory between vertices and triangles, which nothing needs until they grow again. */
static inline uint8_t *bins_rest(const struct smear_bins *g, size_t *bytes)
{
    const uint32_t first = (g->vertex_words + 1u) & ~1u,
                   end = g->pool_words - g->triangle_count * (uint32_t)(sizeof(struct smear_triangle) / 4);
    *bytes = first < end ? (size_t)(end - first) * 4 : 0;
    return (uint8_t *)(g->pool + first);
}

/* Empties the store for the tile rows [first, end). */
void smear_bins_reset(struct smear_bins *g, int first, int end);

/* Returns the tile row of pixel row y < 2048. It is exact: the reciprocal is too large by less than row_px / 2^22. */
static inline int bins_row(const struct smear_bins *g, int32_t y)
{
    return (int)((uint32_t)y * g->row_recip >> 22);
}

/* Starts a segment at the next free vertex word; null when the table is full. */
struct smear_segment *smear_bins_open(struct smear_bins *g);

/* Stores a triangle of three offsets in a segment, or a point (POINT_X ...), and links it into the ring whose last one is *last_of_row.
 * All that is drawn comes by here. There must be room. */
SMEAR_INLINE void bins_add(struct smear_bins *g, uint32_t *last_of_row, uint32_t v0, uint32_t v1, uint32_t v2, uint32_t segment,
                           uint32_t color)
{
    uint32_t i = g->triangle_count++, last = *last_of_row;
    struct smear_triangle *t = bins_triangle(g, i);
    t->vertex[0] = (uint16_t)v0;
    t->vertex[1] = (uint16_t)v1;
    t->vertex[2] = (uint16_t)v2;
    t->segment = (uint16_t)segment;
    t->color = color;
    if (last == SMEAR_NO_TRIANGLE) {
        t->next = i;
    } else {
        struct smear_triangle *before = bins_triangle(g, last);
        t->next = before->next;
        before->next = i;
    }
    *last_of_row = i;
}

/* The bounds of a triangle with a path lie in the entry before. */
static inline const struct smear_path_bounds *bins_bounds(const struct smear_bins *g, uint32_t triangle)
{
    return (const struct smear_path_bounds *)(void *)bins_triangle(g, triangle - 1);
}

/* Moves a list on to tile row `row`: drops what ended above it, merges in what starts there, keeps submission order. `last` are the
 * rings (opaque_last ...), `head` is the list of the row before (or none); returns the new head; lists end with SMEAR_NO_TRIANGLE. */
uint32_t smear_bins_advance(const struct smear_bins *g, const uint32_t *last, uint32_t head, int row);

/* Moves a list on like smear_bins_advance, for who looks further up: drops only what ends above pixel row y. */
uint32_t smear_bins_merge(const struct smear_bins *g, const uint32_t *last, uint32_t head, int row, int32_t y);

/* Returns twice the signed area between two edges; of pixels q8 positive where the second is clockwise of the first on the screen (y down).
 * Short edges take products of 32 bits where others are calls. */
static inline int64_t edges_area(int32_t x1, int32_t y1, int32_t x2, int32_t y2)
{
    const uint32_t small = 1 << 15;
    if (!SMEAR_HAS_MUL64 && !SMEAR_ONE_COPY
        && (((uint32_t)x1 + small) | ((uint32_t)y1 + small) | ((uint32_t)x2 + small) | ((uint32_t)y2 + small)) < 2 * small)
        return x1 * y2 - x2 * y1;
    return cross_wide(x1, y1, x2, y2);
}

/* Finds the first pixel whose centre may be covered, and that behind the last one, of three places q8. */
static inline void box_span(int32_t *first, int32_t *end, int32_t a, int32_t b, int32_t c)
{
    int32_t low = a, high = b;
    if (b < a) {
        low = b;
        high = a;
    }
    if (c < low)
        low = c;
    else if (c > high)
        high = c;
    *first = (low + 127) >> 8;
    *end = (high + 127) >> 8;
}

#endif
