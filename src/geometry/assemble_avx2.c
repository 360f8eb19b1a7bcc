/* SPDX-License-Identifier: MIT */
/* assemble_avx2.c - the loop over a draw's triangles by AVX2: eight are looked at, and the pixels of tiny ones are made, at
 * once; what is left for each one is to be listed. All is added in the order, and with the bits, of assemble.c. */
#include "geometry/assemble_avx2.h"

#include "geometry/shade8.h"
#include "kernels/points8.h"

#if SMEAR_PLACES && SMEAR_AVX2

/* What stays the same for a draw, and how much of the store is in use between ends_load and ends_save. It lies in
 * registers: what is added to the store might change it elsewhere, for all that a compiler knows. */
struct assemble8 {
    struct batch *b;
    const struct smear_place *place;
    uint32_t *stored;
    uint32_t *opaque;               /* lists of tile rows: of points */
    uint32_t *listed;               /* and of triangles */
    const int16_t *uv;              /* of vertices whose records hold a place, this or null, */
    const uint8_t *color;           /* and this or null; */
    bool simple;                    /* if there are no others, but for a colour that `shade` stores later */
    bool waits;                     /* there is one */
    bool by_vertices, colored;      /* colours come from vertices, of each of them */
    bool shares, shares_back;       /* batch_shares of front and back */
    bool plain;                     /* points have the colour of the triangle, which is known, and need no vertices */
    bool shaded;                    /* triangles have a colour, which has to be found */
    struct points_setup points;
    struct smear_shade8 shade;
    /* Of the segment. */
    uint32_t base, number, stride, uv_at, color_at;
    /* Of the store. */
    struct smear_triangle *top;
    uint32_t *pool;
    uint32_t words, count, drawn;
};

SMEAR_AVX2_INLINE void ends_load(struct assemble8 *s)
{
    const struct smear_segment *segment = s->b->segment;
    const struct smear_bins *g = s->b->a->bins;
    s->base = segment->base;
    s->number = (uint32_t)(segment - g->segment);
    s->words = g->vertex_words;
    s->count = g->triangle_count;
    s->drawn = 0;
}

SMEAR_AVX2_INLINE void ends_save(const struct assemble8 *s)
{
    struct smear_bins *g = s->b->a->bins;
    g->vertex_words = s->words;
    g->triangle_count = s->count;
    s->b->a->triangles_drawn += s->drawn;
}

/* Does what bins_add does, for an entry that is known but for `next`. */
SMEAR_AVX2_INLINE struct smear_triangle *ends_add(struct assemble8 *s, uint32_t *last_of_row, __m128i entry)
{
    const uint32_t i = s->count++, last = *last_of_row;
    struct smear_triangle *t = s->top - (size_t)i;
    uint32_t next = i;
    *last_of_row = i;
    _mm_storeu_si128((__m128i *)(void *)t, entry);
    if (last != SMEAR_NO_TRIANGLE) {
        struct smear_triangle *before = s->top - (size_t)last;
        next = before->next;
        before->next = i;
    }
    t->next = next;
    return t;
}

/* Stores a record of the simple kind. The word after it may be written, too: there is room. */
SMEAR_AVX2_INLINE uint32_t store_simple(struct assemble8 *s, uint32_t index)
{
    const uint32_t word = s->words;
    uint32_t *record = s->pool + word;
    s->words = word + s->stride;
    _mm_storeu_si128((__m128i *)(void *)record, _mm_loadu_si128((const __m128i *)(const void *)(s->place + index)));
    if (s->uv != NULL)
        __builtin_memcpy(record + s->uv_at, s->uv + 2 * index, 4);
    if (s->color != NULL) {
        int32_t code;
        __builtin_memcpy(&code, s->color + 4 * index, sizeof code);
        const __m128i spread = _mm_setr_epi8(-1, 0, -1, 1, -1, 2, 3, 3, -1, -1, -1, -1, -1, -1, -1, -1);
        _mm_storel_epi64((__m128i *)(void *)(record + s->color_at), _mm_shuffle_epi8(_mm_cvtsi32_si128(code), spread));
    }
    return word;
}

/* Stores one of any other kind. */
static SMEAR_NOINLINE uint32_t store_other(const struct batch *b, const struct smear_place *place, uint32_t index, uint32_t triangle,
                                           bool back, uint32_t words)
{
    b->a->bins->vertex_words = words;
    return smear_assemble_vertex(b, index, &place[index].screen, triangle, back);
}

/* Returns the first word of a vertex's record, which it stores where that has not been done. */
SMEAR_AVX2_INLINE uint32_t stored_corner(struct assemble8 *s, uint32_t index, uint32_t triangle, bool back, bool shares)
{
    const uint32_t stored = s->stored[index];
    uint32_t word;
    if (shares && stored > s->base)
        return stored - 1;
    if (s->simple) {
        word = store_simple(s, index);
        if (s->waits)
            shade8_add(&s->shade, index, word, back);
    } else {
        word = store_other(s->b, s->place, index, triangle, back, s->words);
        s->words = word + s->stride;
    }
    if (shares)
        s->stored[index] = word + 1;
    return word;
}

SMEAR_AVX2_INLINE struct smear_triangle *add_point(struct assemble8 *s, const struct smear_points8 *points, int n, uint32_t k)
{
    return ends_add(s, s->opaque + points->row[n][k], _mm_loadu_si128((const __m128i *)(const void *)points->entry[n][k]));
}

/* Adds triangle k, whose indices are the given ones: as one or two points if `points` has it, else to the list. */
SMEAR_AVX2_INLINE void add_one(struct assemble8 *s, const struct smear_triangles8 *eight, const struct smear_points8 *points,
                               uint32_t k, const uint16_t *corner, const struct triangles_setup *setup, uint32_t triangle,
                               uint32_t color)
{
    const bool is_points = (points->first >> k & 1u) != 0, back = (eight->back >> k & 1u) != 0;
    uint32_t word0 = 0, word1 = 0, word2 = 0;
    if (!is_points || s->by_vertices) {
        const bool shares = back ? s->shares_back : s->shares;
        const uint32_t second = corner[back ? setup->third : setup->second], third = corner[back ? setup->second : setup->third];
        word0 = stored_corner(s, corner[0], triangle, back, shares);
        word1 = stored_corner(s, second, triangle, back, shares);
        word2 = stored_corner(s, third, triangle, back, shares);
    }
    if (!is_points) {
        const uint32_t row = (eight->low[k] >> 16) * s->points.row_recip >> 22;
        if (s->shaded)
            color = smear_assemble_face(s->b, triangle, back);
        ends_add(s, s->listed + row, _mm_setr_epi32((int32_t)((word0 - s->base) | (word1 - s->base) << 16),
                                                    (int32_t)((word2 - s->base) | s->number << 16), 0, (int32_t)color));
        return;
    }
    for (int n = 0; n <= (int)(points->second >> k & 1u); n++) {
        struct smear_triangle *const point = add_point(s, points, n, k);
        const struct smear_mixed mixed = { point, { word0, word1, word2 }, points->w1[n][k], points->w2[n][k] };
        if (s->colored)
            shade8_add_point(&s->shade, &mixed);
        else if (s->shaded)
            point->color = smear_assemble_face(s->b, triangle, back);
    }
}

/* Takes those that reach only into tiles that the display has already off `seen`. */
static uint32_t only_damaged(const struct batch *b, const struct smear_triangles8 *eight, uint32_t seen)
{
    for (uint32_t all = seen; all != 0; all &= all - 1) {
        const int k = __builtin_ctz(all);
        const struct box box = { pair_x(eight->low[k]), pair_y(eight->low[k]), pair_x(eight->high[k]), pair_y(eight->high[k]) };
        if (!is_damaged(b->a, &box))
            seen &= ~(1u << k);
    }
    return seen;
}

/* Adds those of eight triangles whose bits `all` has. Returns false where there is no room. */
SMEAR_AVX2_INLINE bool add_some(struct assemble8 *s, const struct places *r, const struct smear_triangles8 *eight,
                                const struct smear_points8 *points, const uint32_t color[8], const uint16_t *index,
                                uint32_t triangle, uint32_t all)
{
    if (assembler_has_damage(s->b->a))
        all = only_damaged(s->b, eight, all & eight->seen) | (all & eight->far);
    const uint32_t plain = s->plain ? points->first : 0;
    ends_load(s);
    for (; all != 0; all &= all - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(all);
        s->drawn++;
        if ((plain >> k & 1u) != 0) {
            add_point(s, points, 0, k);
            if ((points->second >> k & 1u) != 0)
                add_point(s, points, 1, k);
            continue;
        }
        const uint16_t *const i = index + 3 * k;
        if ((eight->far >> k & 1u) == 0) {
            add_one(s, eight, points, k, i, &r->setup, triangle + k, color[k]);
            continue;
        }
        const uint32_t corner[3] = { i[0], i[r->setup.second], i[r->setup.third] };
        s->drawn--;
        ends_save(s);
        smear_shade8_all(&s->shade);
        if (!smear_assemble_far(s->b, r, corner, triangle + k))
            return false;
        ends_load(s);
    }
    ends_save(s);
    return true;
}

/* Finds the colours of eight triangles, 0xAARRGGBB, as far as meshes have them. */
SMEAR_AVX2_FUNCTION static inline void find_colors(uint32_t color[8], const struct batch *b, uint32_t triangle)
{
    if (b->face_color == NULL)
        return;
    const __m256i order = _mm256_broadcastsi128_si256(_mm_setr_epi8(2, 1, 0, 3, 6, 5, 4, 7, 10, 9, 8, 11, 14, 13, 12, 15));
    lanes8_store(color, (lanes8)_mm256_shuffle_epi8((__m256i)lanes8_load(b->face_color + 4 * triangle), order));
}

static void assemble8_start(struct assemble8 *s, struct batch *b, const struct places *r)
{
    struct smear_bins *g = b->a->bins;
    const struct smear_segment *segment = b->segment;
    const bool colored = segment_colored(segment), by_vertices = segment_by_vertices(segment);
    const bool shaded = b->face_color == NULL && segment->shade == SHADE_FLAT;
    const bool waits = b->vertex_color == NULL && shade8_serves(b->d, segment);
    *s = (struct assemble8){
        .b = b, .place = r->place, .stored = r->stored, .opaque = g->opaque_last, .listed = row_list(g, b->d, 0),
        .uv = segment_textured(segment) ? b->d->mesh->uv : NULL, .color = SMEAR_WITH_GOURAUD ? b->vertex_color : NULL,
        .simple = segment_moves(segment) == 0 && (!colored || b->vertex_color != NULL || waits), .waits = waits,
        .by_vertices = by_vertices, .colored = colored,
        .shares = batch_shares(b, false), .shares_back = batch_shares(b, true),
        .plain = !colored && !by_vertices && !shaded, .shaded = shaded,
        .points = { g->row_recip, by_vertices && !segment_flat_depth(segment) },
        .stride = segment->stride, .uv_at = segment->uv, .color_at = segment->color,
        .top = bins_triangle(g, 0), .pool = g->pool
    };
    shade8_start(&s->shade, b->d, segment, g);
}

/* Adds triangles of [first, end), as smear_assemble_avx2 says; colours may wait. */
SMEAR_AVX2_INLINE uint32_t add_eights(struct assemble8 *s, const struct places *r, uint32_t first, uint32_t end)
{
    struct batch *const b = s->b;
    const uint16_t *index = b->d->mesh->index + 3 * first;
    struct smear_triangles8 eight;
    struct smear_points8 points = { .first = 0 };
    uint32_t color[8];
    __builtin_memset(color, 0xff, sizeof color);
    for (uint32_t i = first; end - i >= 8; i += 8, index += 24) {
        triangles8_avx2(&eight, r->place, index, &r->setup);
        const uint32_t all = eight.seen | eight.far;
        if (all == 0)
            continue;
        find_colors(color, b, i);
        points.first = 0;
        if (b->points && (eight.seen & eight.tiny) != 0)
            points_avx2(&points, &eight, color, &s->points);
        for (uint32_t half = 0; half < 8; half += 4) {      /* by fours, so that segments begin where they do there */
            const uint32_t some = all & 15u << half;
            if (some == 0)
                continue;
            if (!places_have_room(r, b->a->bins))
                return i + half;
            if (!segment_has_room(b, i + half) || !add_some(s, r, &eight, &points, color, index, i, some))
                return UINT32_MAX;
        }
    }
    return end - (end - first) % 8;
}

SMEAR_AVX2_FUNCTION uint32_t smear_assemble_avx2(struct batch *b, const struct places *r, uint32_t first, uint32_t end)
{
    struct assemble8 s;
    assemble8_start(&s, b, r);
    const uint32_t reached = add_eights(&s, r, first, end);
    smear_shade8_all(&s.shade);
    return reached;
}
#endif
