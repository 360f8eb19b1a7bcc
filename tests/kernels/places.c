/* SPDX-License-Identifier: MIT */
/* places.c - how check_kernels calls kernels/places.h and places8.h: vertices in fours and eights under a random projection,
 * of which most lie before the camera and some do not. */
#include "kernels/places8.h"

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

static void prepare_eights(struct kernel_call *c)
{
    prepare(c);
    c->n &= ~7;
    c->bytes[0] = c->n * 6;
    c->bytes[1] = c->n * (int32_t)sizeof(struct smear_place);
}

/* Finds each vertex with three more like it. */
static void eights_reference(struct kernel_call *c)
{
    struct place_setup s;
    int32_t m[3][4];
    struct smear_place *out = c->plane[1], four[4];
    make(&s, m, c);
    for (int32_t i = 0; i < c->n; i++) {
        int16_t v[12];
        for (int k = 0; k < 12; k++)
            v[k] = ((const int16_t *)c->plane[0])[3 * i + k % 3];
        const bool found = places_reference(four, v, &s);
        out[i] = found ? four[0] : (struct smear_place){ { 0, 0, 0 }, 0 };
    }
}

#if SMEAR_AVX2
SMEAR_AVX2_FUNCTION static void find_eights(struct kernel_call *c)
{
    struct place_setup s;
    struct place_rows8 rows;
    int32_t m[3][4];
    struct smear_place *out = c->plane[1];
    make(&s, m, c);
    place_rows8_make(&rows, &s);
    for (int32_t i = 0; i < c->n; i += 8) {
        const uint32_t found = places_avx2(out + i, (const int16_t *)c->plane[0] + 3 * i, &rows);
        for (int k = 0; k < 8; k++)
            if ((found >> k & 1u) == 0)
                out[i + k] = (struct smear_place){ { 0, 0, 0 }, 0 };
    }
}

static void eights_avx2(struct kernel_call *c)
{
    if (smear_has_avx2())
        find_eights(c);
    else
        eights_reference(c);
}
#endif

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

extern const struct kernel kernels_places[];
const struct kernel kernels_places[] = {
    { .name = "places (vertices)", .most = 40, .size = { 6, sizeof(struct smear_place) }, .align = { 2, 4 },
      .prepare = prepare, .timed = 40,
      .form = { { "reference", reference },
#if SMEAR_VECTORS
                { "vector", vector },
#endif
      } },
    { .name = "places by eights", .most = 40, .size = { 6, sizeof(struct smear_place) }, .align = { 2, 4 },
      .prepare = prepare_eights, .timed = 40,
      .form = { { "reference", eights_reference },
#if SMEAR_AVX2
                { "avx2", eights_avx2 },
#endif
      } },
    { .name = NULL }
};
