/* SPDX-License-Identifier: MIT */
/* reconstruct_avx2.c - the reconstruction filter, eight pixels of a row at once: the numbers of reconstruct.c in eight
 * lanes, tap by tap, so that all bits are the same. Whatever no lane needs is left out: velocities where no tap is in
 * front, colours where no tap has a weight. It takes a fourth of the instructions. */
#include "filter/reconstruct.h"

#include "kernels/words8.h"

#if SMEAR_AVX2

/* Directions of neighbourhoods, as struct direction has them. */
struct lanes_direction {
    smear_w8i x, y, length, pairs, spacing;
    smear_w8u center;
};

/* As struct own_motion and struct own_depth. */
struct lanes_motion {
    smear_w8i x, y;             /* the second direction */
    smear_w8i background;
    smear_w8u over;
    smear_w8i slow;
};

struct lanes_depth {
    smear_w8u code, units;
    smear_w8u front, front_scale, behind, behind_scale;
    bool has_front, has_behind;
};

/* What is summed up and kept while taps are gathered. */
struct lanes_taps {
    smear_w8i near_code;        /* from the next code on taps are in front; beyond all where a lane has no more of them */
    smear_w8i background;
    smear_w8u over;
    smear_w8i fence;            /* lanes that leave out what is behind them */
    smear_w8u r, g, b, weight;
};

/* The pixels of a tile: where they lie, and the directions that they may take. */
struct lanes_tile {
    const struct gathering *g;
    smear_w8i left, right;      /* columns of the frame */
    bool edge, fence;
    int32_t field[6][9];        /* of each neighbourhood: x, y, length, pairs, spacing, center */
};

/* ------------------------------------------------------------------ arithmetic, see reconstruct.c */

W8_FUNCTION smear_w8u lanes_inverse_speed(smear_w8i speed)
{
    const smear_w8i log2 = w8i_log2((smear_w8u)speed);
    const smear_w8u seed = w8u_of_halves(smear_recip_seed, w8u_left((smear_w8u)speed, 31 - log2) >> 22 & 511u);
    return w8u_left(seed, 17 - log2);
}

/* Velocities, gathered as the upper halves of words or whole, as pairs of halves in 1/8 px. */
W8_FUNCTION smear_w8u lanes_of_bytes(smear_w8u upper)
{
    const __m256i places = _mm256_setr_epi8(-1, 2, -1, 3, -1, 6, -1, 7, -1, 10, -1, 11, -1, 14, -1, 15, -1, 2, -1, 3, -1, 6, -1,
                                            7, -1, 10, -1, 11, -1, 14, -1, 15);
    return (smear_w8u)_mm256_srai_epi16(_mm256_shuffle_epi8((__m256i)upper, places), 8);
}

/* Returns |32 v| of velocities in 1/8 px, whose squares are `square`; speed: of v. Those below 128 are 128. */
W8_FUNCTION smear_w8i lanes_length(smear_w8u square, smear_w8i speed)
{
    const smear_w8i big = (smear_w8i)square >= 1 << 10;
    const smear_w8u small = w8u_sqrt_q3(square << 10 & ~(smear_w8u)big) >> 3;
    const smear_w8u root = (smear_w8u)w8i_max((smear_w8i)w8u_choose(big, (smear_w8u)speed, small), w8i_all(1));
    const smear_w8i log2 = w8i_log2(root);
    const smear_w8u quotient = w8u_mulh(square << 10, w8u_recip_norm(w8u_left(root, 31 - log2)));
    const smear_w8i length = (smear_w8i)((root + w8u_right(quotient, log2 - 2) + 1u) >> 1);
    return w8i_max(length, w8i_all(128));
}

/* Returns 2^30 / x for 0 < x < 2^16. */
W8_FUNCTION smear_w8u lanes_inverse_q30(smear_w8u x)
{
    const smear_w8i log2 = w8i_log2(x);
    return w8u_right(w8u_recip_norm(w8u_left(x, 31 - log2)), log2);
}

W8_FUNCTION smear_w8u lanes_units(smear_w8u code)
{
    return w8u_choose((smear_w8i)code < 32768, code, (code << 4) - 15u * 32768u);
}

/* At least 1. */
W8_FUNCTION smear_w8u lanes_part_of(smear_w8u units, uint32_t share_q20)
{
    const smear_w8u small = units * share_q20 >> 20, large = (units >> 4) * share_q20 >> 16;
    return (smear_w8u)w8i_max((smear_w8i)w8u_choose((smear_w8i)units < 1 << 16, small, large), w8i_all(1));
}

/* ------------------------------------------------------------------ what belongs to a pixel */

W8_FUNCTION struct lanes_motion lanes_motion_make(smear_w8u velocity, const struct lanes_direction *top)
{
    const smear_w8u square = (smear_w8u)w8i_dot(velocity, velocity);
    const smear_w8i speed = (smear_w8i)w8u_sqrt_q3(square) << 2;
    const smear_w8i x = (smear_w8i)(velocity << 16) >> 11, y = (smear_w8i)velocity >> 16 << 5;
    const smear_w8i length = lanes_length(square, speed), log2 = w8i_log2((smear_w8u)length);
    const smear_w8u r = w8u_recip_norm(w8u_left((smear_w8u)length, 31 - log2));
    const smear_w8i factor = (smear_w8i)w8u_right(w8u_mulh((smear_w8u)top->length << 16, r), log2 - 2);
    const smear_w8i far = 2 * w8i_max(speed, w8i_all(128)) > top->length;
    struct lanes_motion m;
    m.x = w8i_choose(far, (x * factor + 0x8000) >> 16, top->x);
    m.y = w8i_choose(far, (y * factor + 0x8000) >> 16, top->y);
    m.background = w8i_max(speed, w8i_all(256));
    m.over = lanes_inverse_speed(m.background);
    m.slow = speed <= 128;
    return m;
}

W8_FUNCTION void lanes_depth_front(struct lanes_depth *d)
{
    const smear_w8u step = lanes_part_of(d->units, share_19);
    d->front = d->units + step;
    d->front_scale = lanes_inverse_q30(step);
    d->has_front = true;
}

W8_FUNCTION void lanes_depth_behind(struct lanes_depth *d)
{
    const smear_w8u step = lanes_part_of(d->units, share_20);
    d->behind = (smear_w8u)w8i_max((smear_w8i)(d->units - step), w8i_all(0));
    d->behind_scale = lanes_inverse_q30(d->units - d->behind);
    d->has_behind = true;
}

/* ------------------------------------------------------------------ taps */

/* Reads the speeds of taps, q8. */
W8_FUNCTION smear_w8i lanes_speed_at(const struct lanes_tile *t, smear_w8i at)
{
    const struct smear_window *w = t->g->w;
    smear_w8u v;
    if (w->velocity8 == NULL)
        v = w8u_gather(w->velocity16, at + t->g->x0);
    else if (t->edge)
        v = lanes_of_bytes(w8u_gather_upper_from_0(w->velocity8, at + t->g->x0));
    else
        v = lanes_of_bytes(w8u_gather_upper(w->velocity8 + 2 * t->g->x0, at));
    return (smear_w8i)w8u_sqrt_q3((smear_w8u)w8i_dot(v, v)) << 2;
}

/* Returns the weights of taps; distance in q8 px. */
W8_FUNCTION smear_w8u lanes_weights(const struct lanes_tile *t, struct lanes_taps *s, struct lanes_depth *own, smear_w8i at,
                                    smear_w8i distance, smear_w8u shape)
{
    const smear_w8u code = (t->edge ? w8u_gather_upper_from_0(t->g->w->depth, at + t->g->x0) : w8u_gather_upper(t->g->depth_code, at))
                        >> 16;
    const smear_w8i front = (smear_w8i)code > s->near_code;
    smear_w8i cover = s->background - distance;
    smear_w8u inverse = s->over;
    if (w8_any(front)) {
        const smear_w8u units = lanes_units(code);
        if (!own->has_front)
            lanes_depth_front(own);
        const smear_w8u part = (units - own->units) * own->front_scale >> 22;
        const smear_w8i whole = (smear_w8i)units >= (smear_w8i)own->front;
        const smear_w8i share = w8i_choose(whole, w8i_all(256), (smear_w8i)part);
        const smear_w8i change = (lanes_speed_at(t, at) - s->background) * share >> 8;
        const smear_w8i speed = w8i_max(s->background + change, w8i_all(16)), faster = front & (change > 0);
        const smear_w8u own_inverse = lanes_inverse_speed(speed);
        cover = w8i_choose(front, speed - distance, cover);
        inverse = w8u_choose(front, own_inverse, inverse);
        s->background = w8i_choose(faster, speed, s->background);
        s->over = w8u_choose(faster, own_inverse, s->over);
    }
    cover = w8i_max(cover, w8i_all(0));
    smear_w8u weight = ((inverse >> 6) * shape >> 10) * (smear_w8u)w8i_min(cover, w8i_all(256)) >> 12;
    const smear_w8i behind = s->fence & ((smear_w8i)code < (smear_w8i)own->code);
    if (t->fence && w8_any(behind)) {
        const smear_w8u units = lanes_units(code);
        if (!own->has_behind)
            lanes_depth_behind(own);
        const smear_w8u part = (own->units - units) * own->behind_scale >> 22;
        const smear_w8u share = w8u_choose((smear_w8i)units <= (smear_w8i)own->behind, w8u_all(256), part);
        weight = w8u_choose(behind, weight * (256u - share) >> 8, weight);
    }
    return weight;
}

/* Adds two pixels to each lane. Weights of codes have 13 bits. */
W8_FUNCTION void lanes_add(struct lanes_taps *s, smear_w8u pixel, smear_w8u weight, smear_w8u other, smear_w8u other_weight,
                           bool linear)
{
    s->weight += weight + other_weight;
    if (linear) {
        s->r += w8u_of_halves(smear_srgb_decode, pixel >> 16 & 255u) * weight
              + w8u_of_halves(smear_srgb_decode, other >> 16 & 255u) * other_weight;
        s->g += w8u_of_halves(smear_srgb_decode, pixel >> 8 & 255u) * weight
              + w8u_of_halves(smear_srgb_decode, other >> 8 & 255u) * other_weight;
        s->b += w8u_of_halves(smear_srgb_decode, pixel & 255u) * weight
              + w8u_of_halves(smear_srgb_decode, other & 255u) * other_weight;
        return;
    }
    const smear_w8u weights = weight | other_weight << 16;
    const smear_w8u green_blue = w8u_low_halves(pixel, other), red = w8u_high_halves(pixel, other) & 0xff00ffu;
    s->r += (smear_w8u)w8i_dot(red, weights);
    s->g += (smear_w8u)w8i_dot((smear_w8u)_mm256_srli_epi16((__m256i)green_blue, 8), weights);
    s->b += (smear_w8u)w8i_dot(green_blue & 0xff00ffu, weights);
}

/* Places of pixels in q20 px: columns from the tile's first, rows from the table's. */
struct lanes_place {
    smear_w8i x, y;
};

W8_FUNCTION smear_w8i lanes_index(const struct lanes_tile *t, smear_w8i x, smear_w8i y)
{
    x >>= 20;
    if (t->edge)
        x = w8i_max(w8i_min(x, t->right), t->left);
    const smear_w8i at = (smear_w8i)w8u_gather(t->g->rows->offset, y >> 20) + x;
    SMEAR_ASSERT(!w8_any(at + t->g->x0 < !t->edge) && !w8_any(at + t->g->x0 >= t->g->w->width * t->g->w->ring));
    return at;
}

/* Adds a pair of taps, `x`, `y` and `distance` away from their centre, which lies `shift` from the pixel; q20 px. */
W8_FUNCTION void lanes_pair(const struct lanes_tile *t, struct lanes_taps *s, struct lanes_depth *own, struct lanes_place center,
                            struct lanes_place away, smear_w8i distance, smear_w8i shift, smear_w8u shape)
{
    const smear_w8i at = lanes_index(t, center.x + away.x, center.y + away.y);
    const smear_w8i other = lanes_index(t, center.x - away.x, center.y - away.y);
    const smear_w8u weight = lanes_weights(t, s, own, at, (distance + shift) >> 12, shape);
    const smear_w8u other_weight = lanes_weights(t, s, own, other, (distance - shift) >> 12, shape);
    if (w8_any((smear_w8i)(weight | other_weight)))
        lanes_add(s, w8u_gather(t->g->color, at), weight, w8u_gather(t->g->color, other), other_weight, t->g->linear);
}

/* As mean_of(). */
W8_FUNCTION smear_w8u lanes_mean(const struct lanes_taps *s, bool linear)
{
    const smear_w8i log2 = w8i_log2(s->weight);
    const smear_w8u r = w8u_recip_norm(w8u_left(s->weight, 31 - log2));
    if (linear) {
        const smear_w8i up = 15 - log2, most = w8i_all(4095);
        const smear_w8i red = (smear_w8i)(w8u_mulh(w8u_left(s->r, up), r) >> 17);
        const smear_w8i green = (smear_w8i)(w8u_mulh(w8u_left(s->g, up), r) >> 17);
        const smear_w8i blue = (smear_w8i)(w8u_mulh(w8u_left(s->b, up), r) >> 17);
        return w8u_of_bytes(smear_srgb_encode, (smear_w8u)w8i_min(red, most)) << 16
             | w8u_of_bytes(smear_srgb_encode, (smear_w8u)w8i_min(green, most)) << 8
             | w8u_of_bytes(smear_srgb_encode, (smear_w8u)w8i_min(blue, most));
    }
    const smear_w8i down = log2 - 11, up = -down;           /* of one of the two nothing is left, but where both are 0 */
    const smear_w8u r12 = r >> 18;
    const smear_w8u red = (w8u_right(s->r, down) | w8u_left(s->r, up)) * r12 + (1u << 22);
    const smear_w8u green = (w8u_right(s->g, down) | w8u_left(s->g, up)) * r12 + (1u << 22);
    const smear_w8u blue = (w8u_right(s->b, down) | w8u_left(s->b, up)) * r12 + (1u << 22);
    return (red >> 23 << 16) | (green >> 23 << 8) | blue >> 23;
}

/* As gather(), for pixels from column x of the tile and row y of the table on. */
W8_FUNCTION smear_w8u lanes_gather(const struct lanes_tile *t, const struct lanes_direction *top, const struct lanes_motion *m,
                                   struct lanes_depth *own, smear_w8u pixel, int32_t x, int32_t y, smear_w8u noise)
{
    struct lanes_taps s = { (smear_w8i)own->code, m->background, m->over, m->slow, w8u_all(0), w8u_all(0), w8u_all(0), w8u_all(0) };
    const smear_w8i offset = ((smear_w8i)noise - 32768) * top->spacing >> 16, shift = top->length * offset;
    const smear_w8i x20 = ((w8i_steps() + x) << 20) + (1 << 19), y20 = w8i_all((y << 20) + (1 << 19));
    const struct lanes_place base = { x20 + top->x * offset, y20 + top->y * offset };
    const struct lanes_place second = { x20 + m->x * offset, y20 + m->y * offset };
    const bool box = t->g->box;
    smear_w8i left = (4096 - (top->spacing >> 1)) & (top->pairs > 0);
    for (int k = 0; w8_any(left > 0); left -= top->spacing, k ^= 1) {
        const smear_w8i more = left > 0, at = w8i_max(left, w8i_all(0));
        const smear_w8u shape = (box ? w8u_all(4096) : (smear_w8u)(4915 - at)) & (smear_w8u)more;
        const smear_w8i distance = top->length * at;
        s.near_code = w8i_choose(more, s.near_code, w8i_all(65535));
        if (k == 0)
            lanes_pair(t, &s, own, base, (struct lanes_place){ top->x * at, top->y * at }, distance, shift, shape);
        else
            lanes_pair(t, &s, own, second, (struct lanes_place){ m->x * at, m->y * at }, distance, shift, shape);
    }
    const smear_w8i none = s.weight == w8u_all(0);
    if (w8_equal((smear_w8u)~none, w8u_all(0)))
        return pixel;
    const smear_w8u center = (smear_w8u)w8i_max((smear_w8i)((s.over >> 8) * top->center >> 12), w8i_all(1));
    lanes_add(&s, pixel, center, pixel, w8u_all(0), t->g->linear);
    return w8u_choose(none, pixel, lanes_mean(&s, t->g->linear));
}

/* ------------------------------------------------------------------ the tile */

W8_FUNCTION smear_w8i lanes_of_nine(const int32_t of[9], smear_w8i which)
{
    const smear_w8i low = (smear_w8i)_mm256_permutevar8x32_epi32((__m256i)w8i_load(of), (__m256i)which);
    return w8i_choose(which == 8, w8i_all(of[8]), low);
}

W8_FUNCTION struct lanes_direction lanes_direction_of(const struct lanes_tile *t, smear_w8i which)
{
    return (struct lanes_direction){
        lanes_of_nine(t->field[0], which), lanes_of_nine(t->field[1], which), lanes_of_nine(t->field[2], which),
        lanes_of_nine(t->field[3], which), lanes_of_nine(t->field[4], which), (smear_w8u)lanes_of_nine(t->field[5], which)
    };
}

/* As tile_jump(), for sines of eight pixels. */
W8_FUNCTION smear_w8i lanes_jump(smear_w8i place, smear_w8i sine, int shift)
{
    return ((place << 8) + 128 + (sine * (258 * (64 << shift)) >> 15)) >> (shift + 8);
}

/* As choose(): returns which of the 3 x 3 neighbourhoods each pixel takes. */
W8_FUNCTION smear_w8i lanes_choose(const struct smear_window *w, int32_t x, int32_t y, smear_w8u inner)
{
    const smear_w8u angle = (w8u_noise_of(inner + 2u * (uint32_t)w->width * NOISE_X) + 128u) >> 8;
    const smear_w8i dx = lanes_jump(w8i_steps() + x, w8i_of_bytes(smear_sine, (angle + 64u) & 255u), w->tile_shift);
    const smear_w8i dy = lanes_jump(w8i_all(y), w8i_of_bytes(smear_sine, angle & 255u), w->tile_shift);
    return 3 * dy + dx + 4;
}

static void lanes_tile_make(struct lanes_tile *t, const struct gathering *g, const struct choice *choice, bool edge)
{
    t->g = g;
    t->edge = edge;
    t->fence = g->fence;
    for (int k = 0; k < 9; k++) {
        const struct direction *d = choice->at[k / 3][k % 3];
        t->field[0][k] = d->v.x;
        t->field[1][k] = d->v.y;
        t->field[2][k] = d->length;
        t->field[3][k] = d->pairs;
        t->field[4][k] = d->spacing;
        t->field[5][k] = (int32_t)d->center;
    }
}

/* Loads words of eight velocities, as window_velocity_word(), and makes velocities of them. */
W8_FUNCTION smear_w8u lanes_words(const struct smear_window *w, uint32_t at)
{
    return w->velocity8 != NULL ? w8u_load_halves(w->velocity8 + 2 * (size_t)at) : w8u_load(w->velocity16 + 2 * (size_t)at);
}

W8_FUNCTION smear_w8u lanes_velocity(const struct smear_window *w, smear_w8u words)
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
    t.left = w8i_all(-g->x0);
    t.right = w8i_all(w->width - 1 - g->x0);
    smear_w8i which = w8i_all(4), taps = w8i_all(0);
    struct lanes_direction top = lanes_direction_of(&t, which);
    smear_w8u words = w8u_all(0);
    struct lanes_motion motion = lanes_motion_make(words, &top);
    struct lanes_depth own = { .code = w8u_all(0), .units = w8u_all(0) };
    for (int32_t y = g->rows->y0; y < g->rows->y1; y++, out += w->tile) {
        const uint32_t at = g->rows->offset[y - g->rows->first] + (uint32_t)g->x0;
        smear_w8u inner = w8u_all((uint32_t)g->x0 * NOISE_X + (uint32_t)y * NOISE_Y) + (smear_w8u)w8i_steps() * NOISE_X;
        for (int32_t x = 0; x < n; x += 8, inner += 8 * NOISE_X) {
            const smear_w8u pixel = w8u_load(w->color + at + x), code = w8u_load_halves(w->depth + at + x);
            const smear_w8u here = lanes_words(w, at + (uint32_t)x);
            bool same = w8_equal(here, words);
            if (!choice->alike) {
                const smear_w8i now = lanes_choose(w, x, y - y0, inner);
                if (!w8_equal((smear_w8u)now, (smear_w8u)which)) {
                    which = now;
                    top = lanes_direction_of(&t, which);
                    same = false;
                }
            }
            if (!w8_any(top.pairs)) {
                w8_store(out + x, pixel);
                continue;
            }
            if (!same) {
                words = here;
                motion = lanes_motion_make(lanes_velocity(w, words), &top);
            }
            if (!w8_equal(code, own.code)) {
                own.code = code;
                own.units = lanes_units(code);
                own.has_front = own.has_behind = false;
            }
            w8_store(out + x, lanes_gather(&t, &top, &motion, &own, pixel, x, y - g->rows->first, w8u_noise_of(inner)));
            taps += (2 * top.pairs + 1) & (top.pairs > 0);
        }
    }
    uint32_t count[8], sum = 0;
    w8_store(count, (smear_w8u)taps);
    for (int i = 0; i < 8; i++)
        sum += count[i];
    return sum;
}

#endif
