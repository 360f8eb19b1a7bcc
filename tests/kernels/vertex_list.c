/* SPDX-License-Identifier: MIT */
/* vertex_list.c - how check_kernels calls kernels/vertex_list.h: vertices under a random projection, most of which lie before the
 * camera; those that the kernel leaves out are passed. */
#include "kernels/vertex_list_arm.h"

#include "tests/kernels/projection.h"

static void prepare(struct kernel_call *c)
{
    projection_prepare(c, 60u);
}

typedef uint32_t list_fn(struct listed_vertex *out, const int16_t *v, uint32_t tag, uint32_t end, const struct place_setup *s);

static void find(struct kernel_call *c, list_fn *form)
{
    int32_t m[3][4];
    const struct place_setup s = projection_setup(m, c, 50, 160 << 7, 120 << 7);
    struct listed_vertex *const out = c->plane[1];
    const int16_t *const v = c->plane[0];
    const uint32_t tag = c->word[NEAR] << 16, end = tag + (uint32_t)c->n;
    for (uint32_t at = tag; at != end;) {
        at = form(out + (at - tag), v + 3 * (at - tag), at, end, &s);
        if (at != end)
            out[at++ - tag] = (struct listed_vertex){ 0, 0, { 0, 0, 0 }, 0 };
    }
}

static void reference(struct kernel_call *c) { find(c, vertex_list_reference); }
#if SMEAR_ASM_ARM
static void arm(struct kernel_call *c) { find(c, vertex_list_arm); }
#endif

extern const struct kernel kernels_vertex_list[];
const struct kernel kernels_vertex_list[] = {
    { .name = "vertex_list", .most = 36, .size = { 6, sizeof(struct listed_vertex) }, .align = { 2, 4 }, .prepare = prepare, .timed = 36,
      .form = { { "reference", reference },
#if SMEAR_ASM_ARM
                { "arm", arm },
#endif
      } },
    { .name = NULL }
};
