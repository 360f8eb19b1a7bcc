/* SPDX-License-Identifier: MIT */
/* reconstruct_avx2.c - the reconstruction filter, eight pixels of a row at once: the numbers of reconstruct.c in eight
 * lanes, tap by tap, so that all bits are the same. Whatever no lane needs is left out: velocities where no tap is in
 * front, colours where no tap has a weight. It takes a fourth of the instructions. */
#include "filter/reconstruct.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

enum { NEIGHBORS = 9 };

/* Directions of neighbourhoods, as struct direction has them; 2 pairs + 1 taps, or none. */
struct lanes_direction {
    lanes8i x, y, length, taps, spacing;
    lanes8 center;
};

/* As struct own_motion and struct own_depth. */
struct lanes_motion {
    lanes8i x, y;             /* the second direction */
    lanes8i background;
    lanes8 over;
    lanes8i slow;
};

struct lanes_depth {
    lanes8 code, units;
    lanes8 front, front_scale, behind, behind_scale;
    bool has_front, has_behind;
};

/* What is summed up and kept while taps are gathered. */
struct lanes_taps {
    lanes8i near_code;        /* from the next code on taps are in front; beyond all where a lane has no more of them */
    lanes8i background;
    lanes8 over;
    lanes8i fence;            /* lanes that leave out what is behind them */
    lanes8 r, g, b, weight;
};

/* The pixels of a tile: where they lie, and the directions that they may take. */
struct lanes_tile {
    const struct gathering *g;
    lanes8i left, right;      /* columns of the frame */
    lanes8i sine_scale;         /* of tile_jump() */
    lanes8 noise_apart;         /* from a pixel's noise to that which chooses its neighbourhood */
    bool edge, fence;
    /* Of each neighbourhood: x, y, length, taps, spacing, center. A row of pixels takes those of two rows of tiles, the first six
     * or the last six. */
    int32_t field[6][NEIGHBORS + 2];
};

/* ------------------------------------------------------------------ arithmetic, see reconstruct.c */

SMEAR_AVX2_INLINE lanes8 lanes_inverse_speed(lanes8i speed)
{
    const lanes8i log2 = lanes8_log2((lanes8)speed);
    const lanes8 places = lanes8_left((lanes8)speed, lanes8i_word(LANES8_31) - log2) >> 22;
    const lanes8 seed = lanes8_of_halves(smear_recip_seed, places & lanes8_word(LANES8_511));
    return lanes8_left(seed, lanes8i_word(LANES8_17) - log2);
}

/* Velocities, gathered as the upper halves of words or whole, as pairs of halves in 1/8 px. */
SMEAR_AVX2_INLINE lanes8 lanes_of_bytes(lanes8 upper)
{
    const __m256i places = _mm256_setr_epi8(-1, 2, -1, 3, -1, 6, -1, 7, -1, 10, -1, 11, -1, 14, -1, 15, -1, 2, -1, 3, -1, 6, -1,
                                            7, -1, 10, -1, 11, -1, 14, -1, 15);
    return (lanes8)_mm256_srai_epi16(_mm256_shuffle_epi8((__m256i)upper, places), 8);
}

/* Returns |32 v| of velocities in 1/8 px, whose squares are `square`; speed: of v. Those below 128 are 128. */
SMEAR_AVX2_INLINE lanes8i lanes_length(lanes8 square, lanes8i speed)
{
    const lanes8i big = (lanes8i)square > lanes8i_word(LANES8_1023);
    const lanes8 small = lanes8_sqrt_q3(square << 10 & ~(lanes8)big) >> 3;
    const lanes8 root = (lanes8)lanes8i_max((lanes8i)lanes8_choose(big, (lanes8)speed, small), lanes8i_word(LANES8_1));
    const lanes8i log2 = lanes8_log2(root);
    const lanes8 quotient = lanes8_mulh(square << 10, lanes8_recip_norm(lanes8_left(root, lanes8i_word(LANES8_31) - log2)));
    const lanes8i length = (lanes8i)((root + lanes8_right(quotient, log2 - 2) + 1u) >> 1);
    return lanes8i_max(length, lanes8i_word(LANES8_128));
}

/* Returns 2^30 / x for 0 < x < 2^16. */
SMEAR_AVX2_INLINE lanes8 lanes_inverse_q30(lanes8 x)
{
    const lanes8i log2 = lanes8_log2(x);
    return lanes8_right(lanes8_recip_norm(lanes8_left(x, lanes8i_word(LANES8_31) - log2)), log2);
}

SMEAR_AVX2_INLINE lanes8 lanes_units(lanes8 code)
{
    return (lanes8)lanes8i_max((lanes8i)code, (lanes8i)((code << 4) - lanes8_word(LANES8_BREAK_15)));      /* 16 to 1 from there on */
}

/* At least 1. */
SMEAR_AVX2_INLINE lanes8 lanes_part_of(lanes8 units, uint32_t share_q20)
{
    const lanes8 small = units * share_q20 >> 20, large = (units >> 4) * share_q20 >> 16;
    return (lanes8)lanes8i_max((lanes8i)lanes8_choose((lanes8i)units > lanes8i_word(LANES8_65535), large, small), lanes8i_word(LANES8_1));
}

/* ------------------------------------------------------------------ what belongs to a pixel */

SMEAR_AVX2_INLINE struct lanes_motion lanes_motion_make(lanes8 velocity, const struct lanes_direction *top)
{
    const lanes8 square = (lanes8)lanes8_dot(velocity, velocity);
    const lanes8i speed = (lanes8i)lanes8_sqrt_q3(square) << 2;
    const lanes8i x = (lanes8i)(velocity << 16) >> 11, y = (lanes8i)velocity >> 16 << 5;
    const lanes8i length = lanes_length(square, speed), log2 = lanes8_log2((lanes8)length);
    const lanes8 r = lanes8_recip_norm(lanes8_left((lanes8)length, lanes8i_word(LANES8_31) - log2));
    const lanes8i factor = (lanes8i)lanes8_right(lanes8_mulh((lanes8)top->length << 16, r), log2 - 2);
    const lanes8i far = 2 * lanes8i_max(speed, lanes8i_word(LANES8_128)) > top->length;
    struct lanes_motion m;
    m.x = lanes8i_choose(far, (x * factor + lanes8i_word(LANES8_32768)) >> 16, top->x);
    m.y = lanes8i_choose(far, (y * factor + lanes8i_word(LANES8_32768)) >> 16, top->y);
    m.background = lanes8i_max(speed, lanes8i_word(LANES8_256));
    m.over = lanes_inverse_speed(m.background);
    m.slow = ~(speed > lanes8i_word(LANES8_128));
    return m;
}

SMEAR_AVX2_INLINE void lanes_depth_front(struct lanes_depth *d)
{
    const lanes8 step = lanes_part_of(d->units, share_19);
    d->front = d->units + step;
    d->front_scale = lanes_inverse_q30(step);
    d->has_front = true;
}

SMEAR_AVX2_INLINE void lanes_depth_behind(struct lanes_depth *d)
{
    const lanes8 step = lanes_part_of(d->units, share_20);
    d->behind = (lanes8)lanes8i_max((lanes8i)(d->units - step), lanes8i_all(0));
    d->behind_scale = lanes_inverse_q30(d->units - d->behind);
    d->has_behind = true;
}

/* ------------------------------------------------------------------ taps */

/* Reads the speeds of taps, q8. */
SMEAR_AVX2_INLINE lanes8i lanes_speed_at(const struct lanes_tile *t, lanes8i at)
{
    const struct smear_window *w = t->g->w;
    lanes8 v;
    if (w->velocity8 == NULL)
        v = lanes8_gather(w->velocity16, at + t->g->x0);
    else if (t->edge)
        v = lanes_of_bytes(lanes8_gather_upper_from_0(w->velocity8, at + t->g->x0));
    else
        v = lanes_of_bytes(lanes8_gather_upper(w->velocity8 + 2 * t->g->x0, at));
    return (lanes8i)lanes8_sqrt_q3((lanes8)lanes8_dot(v, v)) << 2;
}

/* Returns the weights of taps; distance in q8 px. */
SMEAR_AVX2_INLINE lanes8 lanes_weights(const struct lanes_tile *t, struct lanes_taps *s, struct lanes_depth *own, lanes8i at,
                                       lanes8i distance, lanes8 shape)
{
    const lanes8 code = (t->edge ? lanes8_gather_upper_from_0(t->g->w->depth, at + t->g->x0) : lanes8_gather_upper(t->g->depth_code, at))
                     >> 16;
    const lanes8i front = (lanes8i)code > s->near_code;
    lanes8i cover = s->background - distance;
    lanes8 inverse = s->over;
    if (lanes8i_any(front)) {
        const lanes8 units = lanes_units(code);
        if (!own->has_front)
            lanes_depth_front(own);
        const lanes8 part = (units - own->units) * own->front_scale >> 22;
        const lanes8i whole = (lanes8i)units >= (lanes8i)own->front;
        const lanes8i share = lanes8i_choose(whole, lanes8i_word(LANES8_256), (lanes8i)part);
        const lanes8i change = (lanes_speed_at(t, at) - s->background) * share >> 8;
        const lanes8i speed = lanes8i_max(s->background + change, lanes8i_word(LANES8_16)), faster = front & (change > 0);
        const lanes8 own_inverse = lanes_inverse_speed(speed);
        cover = lanes8i_choose(front, speed - distance, cover);
        inverse = lanes8_choose(front, own_inverse, inverse);
        s->background = lanes8i_choose(faster, speed, s->background);
        s->over = lanes8_choose(faster, own_inverse, s->over);
    }
    cover = lanes8i_max(cover, lanes8i_all(0));
    lanes8 weight = ((inverse >> 6) * shape >> 10) * (lanes8)lanes8i_min(cover, lanes8i_word(LANES8_256)) >> 12;
    const lanes8i behind = s->fence & ((lanes8i)code < (lanes8i)own->code);
    if (t->fence && lanes8i_any(behind)) {
        const lanes8 units = lanes_units(code);
        if (!own->has_behind)
            lanes_depth_behind(own);
        const lanes8 part = (own->units - units) * own->behind_scale >> 22;
        const lanes8 share = lanes8_choose((lanes8i)units <= (lanes8i)own->behind, lanes8_all(256), part);
        weight = lanes8_choose(behind, weight * (256u - share) >> 8, weight);
    }
    return weight;
}

/* Adds two pixels to each lane. Weights of codes have 13 bits. */
SMEAR_AVX2_INLINE void lanes_add(struct lanes_taps *s, lanes8 pixel, lanes8 weight, lanes8 other, lanes8 other_weight,
                                 bool linear)
{
    s->weight += weight + other_weight;
    if (linear) {
        s->r += lanes8_decode(pixel >> 16 & 255u) * weight + lanes8_decode(other >> 16 & 255u) * other_weight;
        s->g += lanes8_decode(pixel >> 8 & 255u) * weight + lanes8_decode(other >> 8 & 255u) * other_weight;
        s->b += lanes8_decode(pixel & 255u) * weight + lanes8_decode(other & 255u) * other_weight;
        return;
    }
    const lanes8 weights = weight | other_weight << 16;
    const lanes8 green_blue = lanes8_pair(pixel, other), red = lanes8_upper_pair(pixel, other) & lanes8_word(LANES8_RED_BLUE);
    s->r += (lanes8)lanes8_dot(red, weights);
    s->g += (lanes8)lanes8_dot(lanes8_right16(green_blue, 8), weights);
    s->b += (lanes8)lanes8_dot(green_blue & lanes8_word(LANES8_RED_BLUE), weights);
}

/* Places of pixels in q20 px: columns from the tile's first, rows from the table's. */
struct lanes_place {
    lanes8i x, y;
};

SMEAR_AVX2_INLINE lanes8i lanes_index(const struct lanes_tile *t, lanes8i x, lanes8i y)
{
    x >>= 20;
    if (t->edge)
        x = lanes8i_max(lanes8i_min(x, t->right), t->left);
    const lanes8i at = (lanes8i)lanes8_gather(t->g->rows->offset, y >> 20) + x;
    SMEAR_ASSERT(!lanes8i_any(at + t->g->x0 < !t->edge) && !lanes8i_any(at + t->g->x0 >= t->g->w->width * t->g->w->ring));
    return at;
}

/* Adds a pair of taps, `x`, `y` and `distance` away from their centre, which lies `shift` from the pixel; q20 px. */
SMEAR_AVX2_INLINE void lanes_pair(const struct lanes_tile *t, struct lanes_taps *s, struct lanes_depth *own, struct lanes_place center,
                                  struct lanes_place away, lanes8i distance, lanes8i shift, lanes8 shape)
{
    const lanes8i at = lanes_index(t, center.x + away.x, center.y + away.y);
    const lanes8i other = lanes_index(t, center.x - away.x, center.y - away.y);
    const lanes8 weight = lanes_weights(t, s, own, at, (distance + shift) >> 12, shape);
    const lanes8 other_weight = lanes_weights(t, s, own, other, (distance - shift) >> 12, shape);
    if (lanes8_any(weight | other_weight))
        lanes_add(s, lanes8_gather(t->g->color, at), weight, lanes8_gather(t->g->color, other), other_weight, t->g->linear);
}

/* As mean_of(). */
SMEAR_AVX2_INLINE lanes8 lanes_mean(const struct lanes_taps *s, bool linear)
{
    const lanes8i log2 = lanes8_log2(s->weight);
    const lanes8 r = lanes8_recip_norm(lanes8_left(s->weight, lanes8i_word(LANES8_31) - log2));
    const lanes8i up = lanes8i_word(LANES8_15) - log2;           /* weights are below 2^15 */
    if (linear) {
        const lanes8i most = lanes8i_word(LANES8_4095);
        const lanes8i red = (lanes8i)(lanes8_mulh(lanes8_left(s->r, up), r) >> 17);
        const lanes8i green = (lanes8i)(lanes8_mulh(lanes8_left(s->g, up), r) >> 17);
        const lanes8i blue = (lanes8i)(lanes8_mulh(lanes8_left(s->b, up), r) >> 17);
        return lanes8_encode_pixels((lanes8)lanes8i_min(red, most), (lanes8)lanes8i_min(green, most),
                                    (lanes8)lanes8i_min(blue, most));
    }
    const lanes8 r12 = r >> 18, half = lanes8_word(LANES8_2_22);
    const lanes8 red = (lanes8_left(s->r, up) >> 4) * r12 + half;
    const lanes8 green = (lanes8_left(s->g, up) >> 4) * r12 + half;
    const lanes8 blue = (lanes8_left(s->b, up) >> 4) * r12 + half;
    return (red >> 23 << 16) | (green >> 23 << 8) | blue >> 23;
}

/* As gather(), for pixels from column x of the tile and row y of the table on. */
SMEAR_AVX2_INLINE lanes8 lanes_gather(const struct lanes_tile *t, const struct lanes_direction *top, const struct lanes_motion *m,
                                      struct lanes_depth *own, lanes8 pixel, int32_t x, int32_t y, lanes8 noise)
{
    struct lanes_taps s = { .near_code = (lanes8i)own->code, .background = m->background, .over = m->over, .fence = m->slow };
    const lanes8i offset = ((lanes8i)noise - lanes8i_word(LANES8_32768)) * top->spacing >> 16, shift = top->length * offset;
    const lanes8i x20 = ((lanes8i_numbers() + x) << 20) + lanes8i_word(LANES8_2_19), y20 = lanes8i_all((y << 20) + (1 << 19));
    const struct lanes_place base = { x20 + top->x * offset, y20 + top->y * offset };
    const struct lanes_place second = { x20 + m->x * offset, y20 + m->y * offset };
    const bool box = t->g->box;
    lanes8i left = (lanes8i_word(LANES8_4096) - (top->spacing >> 1)) & (top->taps > 0);
    for (int k = 0; lanes8i_any(left > 0); left -= top->spacing, k ^= 1) {
        const lanes8i more = left > 0, at = lanes8i_max(left, lanes8i_all(0));
        const lanes8 shape = (box ? lanes8_word(LANES8_4096) : (lanes8)(lanes8i_word(LANES8_4915) - at)) & (lanes8)more;
        const lanes8i distance = top->length * at;
        s.near_code = lanes8i_choose(more, s.near_code, lanes8i_word(LANES8_65535));
        if (k == 0)
            lanes_pair(t, &s, own, base, (struct lanes_place){ top->x * at, top->y * at }, distance, shift, shape);
        else
            lanes_pair(t, &s, own, second, (struct lanes_place){ m->x * at, m->y * at }, distance, shift, shape);
    }
    const lanes8i none = s.weight == lanes8_all(0);
    if (lanes8_all_set((lanes8)none))
        return pixel;
    const lanes8 center = (lanes8)lanes8i_max((lanes8i)((s.over >> 8) * top->center >> 12), lanes8i_word(LANES8_1));
    lanes_add(&s, pixel, center, pixel, lanes8_all(0), t->g->linear);
    return lanes8_choose(none, pixel, lanes_mean(&s, t->g->linear));
}

/* ------------------------------------------------------------------ the tile */

SMEAR_AVX2_INLINE lanes8i lanes_field(const struct lanes_tile *t, int i, int first, lanes8i which)
{
    return lanes8i_permute(lanes8i_load(t->field[i] + first), which);
}

/* Takes directions of neighbourhoods counted from a first one on, fewer than eight. */
SMEAR_AVX2_INLINE struct lanes_direction lanes_direction_of(const struct lanes_tile *t, int first, lanes8i which)
{
    return (struct lanes_direction){
        lanes_field(t, 0, first, which), lanes_field(t, 1, first, which), lanes_field(t, 2, first, which),
        lanes_field(t, 3, first, which), lanes_field(t, 4, first, which), (lanes8)lanes_field(t, 5, first, which)
    };
}

/* As tile_jump(), for sines of eight pixels. */
SMEAR_AVX2_INLINE lanes8i lanes_jump(const struct lanes_tile *t, lanes8i place, lanes8i sine)
{
    return ((place << 8) + lanes8i_word(LANES8_128) + (sine * t->sine_scale >> 15)) >> (t->g->w->tile_shift + 8);
}

/* The first neighbourhood that row y of a tile may take: rows jump a quarter tile at most. */
static inline int first_neighbor(const struct smear_window *w, int32_t y) { return 2 * y < w->tile ? 0 : 3; }

/* As choose(): returns which of the 3 x 3 neighbourhoods each pixel takes, counted from the first one of its row. */
SMEAR_AVX2_INLINE lanes8i lanes_choose(const struct lanes_tile *t, int32_t x, int32_t y, lanes8 inner)
{
    const struct smear_window *w = t->g->w;
    const uint32_t quarter = (uint32_t)w->tile >> 2;
    const lanes8 angle = (lanes8_noise_of(inner + t->noise_apart) + lanes8_word(LANES8_128)) >> 8;
    const lanes8 other = (angle + lanes8_word(LANES8_64)) & lanes8_word(LANES8_255);
    const lanes8i dx = lanes_jump(t, lanes8i_numbers() + x, lanes8i_of_bytes(smear_sine, other));
    const lanes8i which = dx + (4 - first_neighbor(w, y));
    if ((uint32_t)y - quarter < 2u * quarter)
        return which;
    const lanes8i dy = lanes_jump(t, lanes8i_all(y), lanes8i_of_bytes(smear_sine, angle & lanes8_word(LANES8_255)));
    return which + dy + dy + dy;
}

static void lanes_tile_make(struct lanes_tile *t, const struct gathering *g, const struct choice *choice, bool edge)
{
    t->g = g;
    t->edge = edge;
    t->fence = g->fence;
    for (int k = 0; k < NEIGHBORS; k++) {
        const struct direction *d = choice->at[k / 3][k % 3];
        t->field[0][k] = d->v.x;
        t->field[1][k] = d->v.y;
        t->field[2][k] = d->length;
        t->field[3][k] = d->pairs != 0 ? 2 * d->pairs + 1 : 0;
        t->field[4][k] = d->spacing;
        t->field[5][k] = (int32_t)d->center;
    }
    for (int i = 0; i < 6; i++)         /* which no pixel takes */
        t->field[i][NEIGHBORS] = t->field[i][NEIGHBORS + 1] = 0;
}

/* Loads words of eight velocities, as window_velocity_word(), and makes velocities of them. */
SMEAR_AVX2_INLINE lanes8 lanes_words(const struct smear_window *w, uint32_t at)
{
    return w->velocity8 != NULL ? lanes8_load_halves(w->velocity8 + 2 * (size_t)at) : lanes8_load(w->velocity16 + 2 * (size_t)at);
}

SMEAR_AVX2_INLINE lanes8 lanes_velocity(const struct smear_window *w, lanes8 words)
{
    return w->velocity8 != NULL ? lanes_of_bytes(words << 16) : words;
}

SMEAR_AVX2_FUNCTION
uint32_t smear_reconstruct_avx2(uint32_t *out, const struct gathering *g, const struct choice *choice, int32_t y0, int32_t n,
                                bool edge)
{
    const struct smear_window *w = g->w;
    struct lanes_tile t;
    lanes_tile_make(&t, g, choice, edge);
    t.left = lanes8i_all(-g->x0);
    t.right = lanes8i_all(w->width - 1 - g->x0);
    t.sine_scale = lanes8i_all(258 * (64 << w->tile_shift));
    t.noise_apart = lanes8_all(2u * (uint32_t)w->width * NOISE_X);
    lanes8i which = lanes8i_all(4), taps = lanes8i_all(0);
    struct lanes_direction top = lanes_direction_of(&t, 0, which);
    int from = 0;               /* `which` counts from there on */
    lanes8 words = lanes8_all(0);
    struct lanes_motion motion = lanes_motion_make(words, &top);
    struct lanes_depth own = { .code = lanes8_all(0), .units = lanes8_all(0) };
    for (int32_t y = g->rows->y0; y < g->rows->y1; y++, out += w->tile) {
        const int first = first_neighbor(w, y - y0);
        const uint32_t at = g->rows->offset[y - g->rows->first] + (uint32_t)g->x0;
        lanes8 inner = lanes8_all((uint32_t)g->x0 * NOISE_X + (uint32_t)y * NOISE_Y) + (lanes8)lanes8i_numbers() * NOISE_X;
        for (int32_t x = 0; x < n; x += 8, inner += 8 * NOISE_X) {
            const lanes8 pixel = lanes8_load(w->color + at + x), code = lanes8_load_halves(w->depth + at + x);
            const lanes8 here = lanes_words(w, at + (uint32_t)x);
            bool same = lanes8_equal(here, words);
            if (!choice->alike) {
                const lanes8i now = lanes_choose(&t, x, y - y0, inner);
                if (first != from || !lanes8_equal((lanes8)now, (lanes8)which)) {
                    from = first;
                    which = now;
                    top = lanes_direction_of(&t, first, which);
                    same = false;
                }
            }
            if (!lanes8i_any(top.taps)) {
                lanes8_store(out + x, pixel);
                continue;
            }
            if (!same) {
                words = here;
                motion = lanes_motion_make(lanes_velocity(w, words), &top);
            }
            if (!lanes8_equal(code, own.code)) {
                own.code = code;
                own.units = lanes_units(code);
                own.has_front = own.has_behind = false;
            }
            lanes8_store(out + x, lanes_gather(&t, &top, &motion, &own, pixel, x, y - g->rows->first, lanes8_noise_of(inner)));
            taps += top.taps;
        }
    }
    uint32_t count[8], sum = 0;
    lanes8i_store(count, taps);
    for (int i = 0; i < 8; i++)
        sum += count[i];
    return sum;
}

#endif
