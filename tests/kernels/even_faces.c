/* SPDX-License-Identifier: MIT */
/* even_faces.c - how check_kernels calls kernels/even_faces.h: n faces of up to n + 1 vertices, of which most are of a few
 * colours and normals, so that whole meshes are even, or all but one face. */
#include "kernels/even_faces.h"

#include "tests/kernels/kernels.h"

enum { VERTICES, WHICH, ODD, RESULT, LOOKS = 3 };

static void prepare(struct kernel_call *c)
{
    uint16_t *const index = (uint16_t *)c->plane[0];
    uint8_t *const normal = (uint8_t *)c->plane[1], *const color = (uint8_t *)c->plane[2];
    const int32_t faces = c->n, vertices = faces > 0 ? faces + 1 : 0;
    c->word[VERTICES] = (uint32_t)vertices;
    c->word[WHICH] &= 3u;
    for (int32_t i = 0; i < vertices; i++)              /* vertex i looks as number i % LOOKS */
        for (int32_t j = 0; j < 4; j++) {
            if (j < 3)
                normal[3 * i + j] = normal[3 * (i % LOOKS) + j];
            color[4 * i + j] = color[4 * (i % LOOKS) + j];
        }
    for (int32_t i = 0; i < 3 * faces; i += 3) {
        const int32_t look = kernel_between(0, min_i32(LOOKS, vertices) - 1);
        for (int32_t j = 0; j < 3; j++)
            index[i + j] = (uint16_t)(look + LOOKS * kernel_between(0, (vertices - 1 - look) / LOOKS));
    }
    if (faces > 0 && (c->word[ODD] & 3u) != 0) {        /* one corner looks else, or is too large */
        const int32_t corner = kernel_between(0, 3 * faces - 1);
        index[corner] = (uint16_t)((c->word[ODD] & 3u) == 1 ? vertices : kernel_between(0, vertices - 1));
    }
}

static struct even_faces faces_of(const struct kernel_call *c)
{
    return (struct even_faces){ (const uint16_t *)c->plane[0], (uint32_t)c->n, c->word[VERTICES],
                                (c->word[WHICH] & 1u) != 0 ? (const uint8_t *)c->plane[1] : NULL,
                                (c->word[WHICH] & 2u) != 0 ? (const uint8_t *)c->plane[2] : NULL };
}

static void reference(struct kernel_call *c)
{
    const struct even_faces f = faces_of(c);
    c->word[RESULT] = even_faces_reference(&f);
}

#if SMEAR_AVX2
static void avx2(struct kernel_call *c)
{
    const struct even_faces f = faces_of(c);
    c->word[RESULT] = smear_has_avx2() ? smear_even_faces_avx2(&f) : even_faces_reference(&f);
}
#endif

extern const struct kernel kernels_even_faces[];
const struct kernel kernels_even_faces[] = {
    { .name = "even_faces", .most = 35, .size = { 6, 6, 8 }, .align = { 2, 1, 1 }, .prepare = prepare, .timed = 64,
      .form = { { "reference", reference },
#if SMEAR_AVX2
                { "avx2", avx2 },
#endif
      } },
    { .name = NULL }
};
