/* SPDX-License-Identifier: MIT */
/* texels_shade.c - how check_kernels calls kernels/texels_shade.h: textures of 16 x 8 texels. */
#include "kernels/texels_shade.h"

#include "tests/kernels/kernels.h"

enum { LOG2_WIDTH = 4, LOG2_HEIGHT = 3, TEXELS = 1 << (LOG2_WIDTH + LOG2_HEIGHT), PALETTE = 256 };
enum { U, V, DU, DV, Z, DZ, RED, GREEN, BLUE, STEPS, FORMAT };      /* words */
enum { COLOR, DEPTH, TEXTURE };                                     /* planes */

static uint32_t palette[PALETTE];

/* Coordinates as textures have them; most texels are RGB565. */
static void prepare(struct kernel_call *c)
{
    static const int formats[] = { SMEAR_TEXEL_565, SMEAR_TEXEL_565, SMEAR_TEXEL_8888, SMEAR_TEXEL_PALETTE8 };
    c->word[V] = (c->word[V] & ~255u) | 128u;
    c->word[DV] &= ~255u;
    c->word[FORMAT] = (uint32_t)formats[kernel_random() % 4u];
    c->bytes[TEXTURE] = TEXELS * 4;
    for (int i = 0; i < PALETTE; i++)
        palette[i] = kernel_random();
}

SMEAR_INLINE void call(struct kernel_call *c, bool narrow, bool white, bool linear,
                       void draw(const struct shaded_texels *, struct texel_run *, const struct shaded_light *, int32_t, bool, bool))
{
    const struct shaded_texels texels = { c->plane[TEXTURE], palette, (int)c->word[FORMAT], LOG2_WIDTH, LOG2_HEIGHT, narrow };
    const struct shaded_light light = { { c->word[RED], c->word[GREEN], c->word[BLUE] },
                                        { c->word[STEPS], c->word[STEPS] << 8, c->word[STEPS] << 16 } };
    struct texel_run run;
    texel_run_start(&run, LOG2_WIDTH, LOG2_HEIGHT);
    texcoord_run(&run, (struct texcoord){ c->word[U], c->word[V], c->word[DU], c->word[DV], 0, 0 });
    run.color = c->plane[COLOR];
    run.depth = c->plane[DEPTH];
    run.z = c->word[Z];
    run.dz = c->word[DZ];
    draw(&texels, &run, &light, c->n, white, linear);
}

#define CALLS(NAME, NARROW, WHITE, LINEAR)                                                                               \
    static void NAME##_reference(struct kernel_call *c) { call(c, NARROW, WHITE, LINEAR, texels_shade_reference); }      \
    static void NAME##_best(struct kernel_call *c) { call(c, NARROW, WHITE, LINEAR, texels_shade); }

CALLS(white, true, true, false)
CALLS(colored, true, false, false)
CALLS(light, true, false, true)
CALLS(wide, false, false, false)

#define KERNEL(NAME, CALL, BYTES) \
    { .name = NAME, .least = 1, .most = 27, .size = { BYTES, 2, 4 }, .prepare = prepare, \
      .form = { { "reference", CALL##_reference }, { "best", CALL##_best } } }

extern const struct kernel kernels_texels_shade[];
const struct kernel kernels_texels_shade[] = {
    KERNEL("texels_shade (white, narrow)", white, 2),
    KERNEL("texels_shade (colours, narrow)", colored, 2),
    KERNEL("texels_shade (linear, narrow)", light, 2),
    KERNEL("texels_shade (colours)", wide, 4),
    { .name = NULL }
};
