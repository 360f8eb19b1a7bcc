/* SPDX-License-Identifier: MIT */
/* texel_track.c - how check_kernels calls kernels/texel_track.h: blocks one after the other, along planes of which some are like those of
 * triangles and some are anything. */
#include "kernels/texel_track.h"

#include "tests/kernels/kernels.h"

enum { Q, U, V, DQ, DU, DV, SLOPE, KIND };      /* words */

static void prepare(struct kernel_call *c)
{
    c->bytes[0] = c->n * 48;
    if (kernel_random() % 4u == 0)
        return;
    const uint32_t bits = kernel_random() % 16u;
    c->word[Q] = c->word[Q] >> 2 >> bits;
    c->word[U] = c->word[Q] >> 1;
    c->word[V] = 0u - c->word[Q] / 3u;
    c->word[DQ] = (uint32_t)((int32_t)c->word[DQ] >> (12 + bits));
    c->word[DU] = (uint32_t)((int32_t)c->word[DU] >> (12 + bits));
    c->word[DV] = (uint32_t)((int32_t)c->word[DV] >> (12 + bits));
    c->word[SLOPE] = c->word[DQ] << 3;
}

/* Planes whose values at (x, row) are those of the words. */
static void set_planes(const struct kernel_call *c, int32_t *plane, int32_t x, int32_t row)
{
    for (int i = 0; i < 3; i++, plane += 3) {
        plane[1] = (int32_t)c->word[DQ + i] >> 4;
        plane[2] = (int32_t)c->word[DQ + (i + 1) % 3] >> 3;
        plane[0] = (int32_t)(c->word[Q + i] - (uint32_t)plane[1] * (uint32_t)x - (uint32_t)plane[2] * (uint32_t)row);
    }
}

/* Whole blocks and others, in the order of the bits of a word. */
SMEAR_INLINE void call(struct kernel_call *c, void start(struct texel_track *, const int32_t *, int32_t, int32_t),
                       void next(struct texel_track *), void part(struct texel_track *, int32_t))
{
    struct texel_track k;
    uint32_t *out = c->plane[0];
    const int32_t x = (int32_t)(c->word[KIND] >> 20), row = (int32_t)(c->word[KIND] & 511u);
    int32_t plane[9];
    k.dq = (int32_t)c->word[DQ];
    k.du = (int32_t)c->word[DU];
    k.dv = (int32_t)c->word[DV];
    k.log2 = 2 + (int32_t)(c->word[KIND] % 5u);
    k.up = (int32_t)(c->word[KIND] >> 8 & 15u);
    k.slope = (int32_t)c->word[SLOPE];
    k.seed = smear_recip_seed;
    k.parabolic = (c->word[KIND] >> 16 & 1u) != 0;
    k.qx = k.dq >> 4;
    k.ux = k.du >> 4;
    k.vx = k.dv >> 4;
    set_planes(c, plane, x, row);
    start(&k, plane, x, row);
    texcoord_run(&k.run, (struct texcoord){ 0, 0, 0, 0, 0, 0 });
    for (int32_t i = 0; i < c->n; i++, out += 12) {
        const uint32_t kind = c->word[KIND] >> i;
        if ((kind & 1u) != 0)
            next(&k);
        else
            part(&k, (kind & 30u) == 0 ? BLOCK_LONG : (kind & 30u) == 2 ? BLOCK_LONGEST : 1 + (int32_t)(kind >> 1 & 15u));
        const uint32_t word[12] = {
            (uint32_t)texel_run_uv(&k.run), (uint32_t)(texel_run_uv(&k.run) >> 32), (uint32_t)k.place.u, (uint32_t)k.place.v,
            (uint32_t)k.place.nearness, (uint32_t)k.q, (uint32_t)k.u, (uint32_t)k.v,
#if TEXELS_PACKED
            (uint32_t)k.run.duv, (uint32_t)(k.run.duv >> 32), (uint32_t)k.run.dduv, (uint32_t)(k.run.dduv >> 32)
#else
            k.run.du, k.run.dv, k.run.ddu, k.run.ddv
#endif
        };
        for (int j = 0; j < 12; j++)
            out[j] = word[j];
    }
}

#if SMEAR_ASM_ARMV6M && !TRACK_ROWS_ARMV6M
#define texel_track_start_armv6m texel_track_start_reference
#endif

#define CALL(FORM) \
    static void FORM(struct kernel_call *c) \
    { \
        call(c, texel_track_start_##FORM, texel_track_next_##FORM, texel_track_part_##FORM); \
    }

CALL(reference)
#if SMEAR_ASM_ARMV6M
CALL(armv6m)
#endif

extern const struct kernel kernels_texel_track[];
const struct kernel kernels_texel_track[] = {
    { .name = "texel_track", .least = 1, .most = 19, .size = { 48 }, .align = { 4 }, .prepare = prepare, .timed = 20,
      .form = { { "reference", reference },
#if SMEAR_ASM_ARMV6M
                { "armv6m", armv6m },
#endif
      } },
    { .name = NULL }
};
