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
