/* SPDX-License-Identifier: MIT */
/* places.c - how check_kernels calls kernels/places.h: vertices in fours under a random projection,
 * of which most lie before the camera and some do not. */
#include "kernels/places.h"

#include "tests/kernels/projection.h"

static void prepare(struct kernel_call *c)
{
    projection_prepare(c, 32u);
    c->n &= ~3;
    c->bytes[0] = c->n * 6;
    c->bytes[1] = c->n * (int32_t)sizeof(struct smear_place);
}

/* Rows of factors and offsets, and what else a setup has. */
static void make(struct place_setup *s, int32_t m[3][4], const struct kernel_call *c)
{
    *s = projection_setup(m, c, 26, 160 << 8, 120 << 8);
    s->depth_most = 1 << 27;
}

/* Returns how many leading zeros w has in all four, or -1 where they are not found. */
static inline int places_zeros(const int32_t w[4], const struct place_setup *s)
{
    const int zeros = count_leading_zeros((uint32_t)w[0] | 1u);
    for (int i = 0; i < 4; i++)
        if (w[i] < s->near_distance || w[i] > s->far_distance || w[i] >> (31 - zeros) != 1)
            return -1;
    return zeros < 21 && s->depth_shift + zeros <= PLACES_UP_MOST ? zeros : -1;
}

static inline bool places_reference(struct smear_place out[4], const int16_t v[12], const struct place_setup *s)
{
    int32_t row[3][4], w[4];
    for (int i = 0; i < 4; i++) {
        for (int r = 0; r < 3; r++) {
            const int32_t *m = s->m[r];
            int32_t high = 0, low = 0;
            for (int j = 0; j < 3; j++) {
                high = add_wrap(high, v[3 * i + j] * (m[j] >> 16));
                low += v[3 * i + j] * (int32_t)(((uint32_t)m[j] & 0xffffu) >> 2);
            }
            row[r][i] = add_wrap(add_wrap(high, low >> 14), m[3]);
        }
        w[i] = row[2][i];
    }
    const int zeros = places_zeros(w, s);
    if (zeros < 0)
        return false;
    const int down = 21 - zeros, up = s->depth_shift + zeros;
    for (int i = 0; i < 4; i++) {
        const int32_t r = (int32_t)recip_norm((uint32_t)w[i] << zeros);
        struct smear_screen *p = &out[i].screen;
        p->x = s->x + ((mulh_i32(row[0][i], r) + (1 << (down - 1))) >> down);
        p->y = s->y + ((mulh_i32(row[1][i], r) + (1 << (down - 1))) >> down);
        p->depth = clamp_i32(scale_sat(mulh_i32(s->depth_mantissa, r), max_i32(up, -31)), s->depth_least, s->depth_most);
        out[i].first = place_first(p->x, p->y);
    }
    return true;
}

static void none(struct smear_place *out)
{
    for (int i = 0; i < 4; i++)
        out[i] = (struct smear_place){ { 0, 0, 0 }, 0 };
}

static void reference(struct kernel_call *c)
{
    struct place_setup s;
    int32_t m[3][4];
    struct smear_place *out = c->plane[1];
    make(&s, m, c);
    for (int32_t i = 0; i < c->n; i += 4)
        if (!places_reference(out + i, (const int16_t *)c->plane[0] + 3 * i, &s))
            none(out + i);
}

#if SMEAR_VECTORS
static void vector(struct kernel_call *c)
{
    struct place_setup s;
    struct place_rows rows;
    int32_t m[3][4];
    struct smear_place *out = c->plane[1];
    make(&s, m, c);
    place_rows_make(&rows, &s);
    for (int32_t i = 0; i < c->n; i += 4)
        if (!places_vector(out + i, (const int16_t *)c->plane[0] + 3 * i, &rows))
            none(out + i);
}
#endif

KERNELS(places) = {
    { .name = "places (vertices)", .most = 40, .size = { 6, sizeof(struct smear_place) }, .align = { 2, 4 },
      .prepare = prepare, .timed = 40,
      .form = { { "reference", reference } VECTOR_FORM("vector", vector) } },
    { .name = NULL }
};
