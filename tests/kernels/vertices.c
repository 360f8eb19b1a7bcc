/* SPDX-License-Identifier: MIT */
/* vertices.c - how check_kernels calls kernels/vertices.h: vertices under a random projection, most of which lie before the
 * camera. The setup is made ready for the first one's w, so some have others. */
#include "kernels/vertices.h"

#include "tests/kernels/kernels.h"

enum { SHIFT = 9, NEAR, FAR, CLOSE = 6 };

struct found {
    struct smear_screen screen;
    struct smear_homogeneous now;
};

static void prepare(struct kernel_call *c)
{
    const uint32_t bits = 8 + kernel_random() % 13u;
    for (int i = 0; i < 9; i++)         /* sums of three products and an offset stay below 2^30 */
        c->word[i] = (uint32_t)((int32_t)c->word[i] >> (i < 6 ? 3 : (int)(31 - bits)));
    c->word[SHIFT] = c->word[SHIFT] % 48u;
    c->word[NEAR] = 1 + c->word[NEAR] % 4096u;
    c->word[FAR] = (c->word[FAR] & 1u) != 0 ? INT32_MAX : 1u << 21;
}

static void make(struct vertex_setup *v, const struct kernel_call *c)
{
    int32_t m[3][4];
    for (int r = 0; r < 3; r++) {
        for (int j = 0; j < 3; j++)
            m[r][j] = (int32_t)c->word[3 * r + j] & ~3;
        m[r][3] = r < 2 ? m[r][0] >> 2 : (int32_t)(c->word[CLOSE] >> 7 | 1u << 21);
    }
    if ((c->word[CLOSE] & 3u) == 0) {       /* as close as may be, all of them */
        m[2][0] = m[2][1] = m[2][2] = 0;
        m[2][3] = (int32_t)(c->word[CLOSE] >> 2 & 1u ? c->word[NEAR] : 1u + (c->word[CLOSE] >> 3) % 8192u);
    }
    const struct place_setup s = { (const int32_t(*)[4])m, (int32_t)c->word[NEAR], (int32_t)c->word[FAR], 0x2aaaaaaa,
                                   (int32_t)c->word[SHIFT] - 40, 4096, 0x43ff8000, 160 << 8, 120 << 8 };
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
#if SMEAR_ASM_ARMV6M
static void armv6m(struct kernel_call *c) { find(c, vertex_find_armv6m); }
#endif
#if SMEAR_ASM_ARMV7EM
static void armv7em(struct kernel_call *c) { find(c, vertex_find_armv7em); }
#endif

extern const struct kernel kernels_vertices[];
const struct kernel kernels_vertices[] = {
    { .name = "vertex", .most = 36, .size = { 6, sizeof(struct found) }, .align = { 2, 4 }, .prepare = prepare, .timed = 36,
      .form = { { "reference", reference },
#if SMEAR_ASM_ARMV6M
                { "armv6m", armv6m },
#endif
#if SMEAR_ASM_ARMV7EM
                { "armv7em", armv7em },
#endif
      } },
    { .name = NULL }
};
