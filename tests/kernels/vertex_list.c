/* SPDX-License-Identifier: MIT */
/* vertex_list.c - how check_kernels calls kernels/vertex_list.h: vertices under a random projection, most of which lie before the
 * camera; those that the kernel leaves out are passed. */
#include "kernels/vertex_list_arm.h"

#include "tests/kernels/kernels.h"

enum { SHIFT = 9, NEAR, FAR, CLOSE = 6 };

static void prepare(struct kernel_call *c)
{
    const uint32_t bits = 8 + kernel_random() % 13u;
    for (int i = 0; i < 9; i++)         /* sums of three products and an offset stay below 2^30 */
        c->word[i] = (uint32_t)((int32_t)c->word[i] >> (i < 6 ? 3 : (int)(31 - bits)));
    c->word[SHIFT] = c->word[SHIFT] % 60u;
    c->word[NEAR] = 1 + c->word[NEAR] % 4096u;
    c->word[FAR] = (c->word[FAR] & 1u) != 0 ? INT32_MAX : 1u << 21;
}

typedef uint32_t list_fn(struct listed_vertex *out, const int16_t *v, uint32_t tag, uint32_t end, const struct place_setup *s);

static void find(struct kernel_call *c, list_fn *form)
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
                                   (int32_t)c->word[SHIFT] - 50, 4096, 0x43ff8000, 160 << 7, 120 << 7 };
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
