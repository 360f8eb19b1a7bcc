/* SPDX-License-Identifier: MIT */
/* vertices.c - how check_kernels calls kernels/vertices.h: vertices under a random projection, most of which lie before the
 * camera. The setup is made ready for the first one's w, so some have others. */
#include "kernels/vertices.h"

#include "tests/kernels/projection.h"

struct found {
    struct smear_screen screen;
    struct smear_homogeneous now;
};

static void prepare(struct kernel_call *c)
{
    projection_prepare(c, 48u);
}

static void make(struct vertex_setup *v, const struct kernel_call *c)
{
    int32_t m[3][4];
    const struct place_setup s = projection_setup(m, c, 40, 160 << 8, 120 << 8);
    vertex_setup_make(v, &s);
}

typedef bool vertex_fn(struct smear_screen *screen, struct smear_homogeneous *now, const int16_t v[3], const struct vertex_setup *s);

static void find(struct kernel_call *c, vertex_fn *form)
{
    struct vertex_setup s;
    struct found *out = c->plane[1];
    const int16_t *v = c->plane[0];
    make(&s, c);
    for (int32_t i = 0; i < c->n; i++, v += 3) {
        bool is_found = form(&out[i].screen, &out[i].now, v, &s);
        const int32_t w = out[i].now.w;
        if (!is_found && w >= s.near_distance && w <= s.far_distance && vertex_setup_for(&s, w))
            is_found = form(&out[i].screen, &out[i].now, v, &s);
        if (!is_found)
            out[i].screen = (struct smear_screen){ 0, 0, 0 };
    }
}

static void reference(struct kernel_call *c) { find(c, vertex_find_reference); }
#if SMEAR_ASM_ARMV7EM
static void armv7em(struct kernel_call *c) { find(c, vertex_find_armv7em); }
#endif

extern const struct kernel kernels_vertices[];
const struct kernel kernels_vertices[] = {
    { .name = "vertex", .most = 36, .size = { 6, sizeof(struct found) }, .align = { 2, 4 }, .prepare = prepare, .timed = 36,
      .form = { { "reference", reference },
#if SMEAR_ASM_ARMV7EM
                { "armv7em", armv7em },
#endif
      } },
    { .name = NULL }
};
