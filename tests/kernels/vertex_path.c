/* SPDX-License-Identifier: MIT */
/* vertex_path.c - how check_kernels calls kernels/vertex_path.h: places anywhere in the guard band and depths of any kind, at all
 * times of the exposure. geometry/path.h defines the result. */
#include "geometry/path.h"
#include "geometry/transform.h"

#include "tests/kernels/kernels.h"

enum { TIME, OUT };             /* words */

/* Three places for each vertex: in the middle, at open and at close. */
static void prepare(struct kernel_call *c)
{
    const int32_t guard = SMEAR_GUARD_PX << 8;
    int32_t *word = c->plane[0];
    for (int32_t i = 0; i < 9 * c->n; i++) {
        const bool near = i % 9 >= 3 && (kernel_random() & 1u) != 0;
        if (i % 3 == VERTEX_DEPTH)
            word[i] = kernel_between(SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
        else
            word[i] = near ? clamp_i32(word[i - 3] + kernel_between(-3000, 3000), -guard, guard) : kernel_between(-guard, guard);
    }
    c->bytes[0] = 36 * c->n;
    c->word[TIME] = (kernel_random() & 3u) == 0 ? (c->word[TIME] & 1u) * SHUTTER_CLOSE : c->word[TIME] % (SHUTTER_CLOSE + 1u);
}

static void reference(struct kernel_call *c)
{
    const int32_t *word = c->plane[0];
    int32_t *out = c->plane[1];
    for (int32_t i = 0; i < c->n; i++)
        path_place_reference(out + 3 * i, word + 9 * i, word + 9 * i + 3, path_phase((int32_t)c->word[TIME]));
}

#if PATH_ASM_ARMV6M
static void armv6m(struct kernel_call *c)
{
    const int32_t *word = c->plane[0];
    int32_t *out = c->plane[1];
    for (int32_t i = 0; i < c->n; i++)
        path_place(out + 3 * i, word + 9 * i, word + 9 * i + 3, path_phase((int32_t)c->word[TIME]));
}
#endif

/* Triangles of vertices that lie one behind the other, all nine words of them, whose curvature is small. */
static void prepare_triangles(struct kernel_call *c)
{
    prepare(c);
    int32_t *word = c->plane[0];
    for (int32_t i = 0; i < c->n; i++)
        for (int axis = VERTEX_X; axis <= VERTEX_Y; axis++) {
            int32_t *const v = word + 9 * i + axis;
            const int32_t way = kernel_between(-(1 << 19), 1 << 19), curvature = kernel_between(-65535, 65535);
            v[3] = v[0] - way;
            v[6] = v[0] + way + curvature;
        }
}

static void triangles(struct kernel_call *c, bool near)
{
    const int32_t *word = c->plane[0];
    int32_t *out = c->plane[1];
    for (int32_t i = 0; i + 2 < c->n; i += 3) {
        const uint16_t vertex[3] = { (uint16_t)(9 * (i + 2)), (uint16_t)(9 * i), (uint16_t)(9 * (i + 1)) };
        struct path_record record[3];
        int32_t *const box = out + 5 * i;
        path_triangle(box, record, word, vertex, 3, path_phase((int32_t)c->word[TIME]), near);
        for (int k = 0; k < 9; k++)
            out[5 * i + 4 + k] = record[k / 3].word[k % 3];
    }
}

static void triangles_reference(struct kernel_call *c) { triangles(c, false); }

#if PATH_ASM_ARMV6M
static void triangles_armv6m(struct kernel_call *c) { triangles(c, true); }
#endif

extern const struct kernel kernels_vertex_path[];
const struct kernel kernels_vertex_path[] = {
    { .name = "vertex_path", .most = 28, .size = { 36, 12 }, .align = { 4, 4 }, .prepare = prepare, .timed = 24,
      .form = { { "reference", reference },
#if PATH_ASM_ARMV6M
                { "armv6m", armv6m },
#endif
      } },
    { .name = "triangle_path", .least = 3, .most = 24, .size = { 36, 20 }, .align = { 4, 4 }, .prepare = prepare_triangles, .timed = 24,
      .form = { { "reference", triangles_reference },
#if PATH_ASM_ARMV6M
                { "armv6m", triangles_armv6m },
#endif
      } },
    { .name = NULL }
};
