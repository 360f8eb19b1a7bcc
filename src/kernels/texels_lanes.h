/* SPDX-License-Identifier: MIT */
/* texels_lanes.h - depth-tested texels along a row, eight pixels at once. */
#ifndef SMEAR_KERNELS_TEXELS_LANES_H
#define SMEAR_KERNELS_TEXELS_LANES_H

#include "kernels/texel_track.h"
#include "kernels/vector.h"

#define TEXELS_LANES (SMEAR_VECTORS && TEXELS_PACKED)
#if TEXELS_LANES

/* Whether sizes fit halves, and so does the product that an index is. */
static inline bool texels_fit_lanes(int log2_width, int log2_height) { return log2_width < 15 && log2_height < 16; }

/* Coordinates of two pixels, by what they change over two pixels, and by what that does. */
struct texels_pair {
    smear_v2u uv, step, bend;
};

static inline void texels_pair_start(struct texels_pair *k, uint64_t uv, uint64_t duv, uint64_t dduv)
{
    const uint64_t twice = 2 * duv + dduv, bend = 4 * dduv;
    k->uv = (smear_v2u){ uv, uv + duv };
    k->step = (smear_v2u){ twice, twice + 2 * dduv };
    k->bend = (smear_v2u){ bend, bend };
}

static inline smear_v2u texels_pair_next(struct texels_pair *k)
{
    const smear_v2u uv = k->uv;
    k->uv += k->step;
    k->step += k->bend;
    return uv;
}

/* Indices of the next four texels in words: u and v in turns are halves of pairs, the product of u and the texture's width takes its
 * highest bits. */
SMEAR_INLINE smear_v4i texels_indices(struct texels_pair *k, int log2_width, int log2_height)
{
    const smear_v4u a = (smear_v4u)texels_pair_next(k), b = (smear_v4u)texels_pair_next(k);
    const smear_v8i texels = log2_width == log2_height
                               ? v4i_narrow((smear_v4i)(a >> (uint32_t)(32 - log2_width)), (smear_v4i)(b >> (uint32_t)(32 - log2_width)))
                               : (smear_v8i)v4u_mulh16((smear_v4u)v8i_upper(a, b), v4u_all(1u << log2_width | 1u << (16 + log2_height)));
    return v8i_dot(texels, (smear_v8i)v4u_all(1u | 1u << (16 + log2_width)));
}

/* Takes eight texels of 16 bits. Two indices at once leave vectors: elements one by one take longer. */
SMEAR_INLINE smear_v8u texels_gather(const void *texels, smear_v8u a, smear_v8u b)
{
    const uint16_t *const t = (const uint16_t *)texels;
    const smear_v2u x = (smear_v2u)a, y = (smear_v2u)b;
    const uint64_t p = x[0], q = x[1], r = y[0], s = y[1];
    smear_v8u texel = { t[(uint32_t)p], 0, 0, 0, 0, 0, 0, 0 };
    texel[1] = t[p >> 32];
    texel[2] = t[(uint32_t)q];
    texel[3] = t[q >> 32];
    texel[4] = t[(uint32_t)r];
    texel[5] = t[r >> 32];
    texel[6] = t[(uint32_t)s];
    texel[7] = t[s >> 32];
    return texel;
}

/* Eight pixels become texels where `hidden` is 0. */
SMEAR_INLINE void texels_eight(void *color, const void *texels, smear_v4i low, smear_v4i high, smear_v8i hidden, enum texel_kind kind)
{
    if (kind == TEXELS_NARROW) {
        uint16_t *const narrow = (uint16_t *)color;
        v8i_store(narrow, v8i_choose(hidden, v8i_load(narrow), (smear_v8i)texels_gather(texels, (smear_v8u)low, (smear_v8u)high)));
        return;
    }
    const uint32_t *const t = (const uint32_t *)texels;
    uint32_t *const out = (uint32_t *)color;
    const smear_v2u x = (smear_v2u)low, y = (smear_v2u)high;
    const uint64_t p = x[0], q = x[1], r = y[0], l = y[1];      /* two indices each */
    const smear_v4u first = { t[(uint32_t)p], t[p >> 32], t[(uint32_t)q], t[q >> 32] };
    const smear_v4u second = { t[(uint32_t)r], t[r >> 32], t[(uint32_t)l], t[l >> 32] };
    v4u_store(out, v4u_choose(v4i_twice_low(hidden), v4u_load(out), first & 0xffffffu));
    v4u_store(out + 4, v4u_choose(v4i_twice_high(hidden), v4u_load(out + 4), second & 0xffffffu));
}

/* Where a row has come to, and the depth codes of its next eight pixels. */
struct texels_row {
    void *color;
    uint16_t *depth;
    const void *texels;
    smear_v4u z, step;          /* of four pixels; over four pixels */
    uint32_t dz;
};

static inline void texels_row_start(struct texels_row *w, const struct texel_run *r)
{
    w->color = r->color;
    w->depth = r->depth;
    w->texels = r->texels;
    w->z = (smear_v4u){ r->z, r->z + r->dz, r->z + 2 * r->dz, r->z + 3 * r->dz };
    w->step = v4u_all(4 * r->dz);
    w->dz = r->dz;
}

/* Draws eight pixels, and goes on by them. */
SMEAR_INLINE void texels_row_eight(struct texels_row *w, struct texels_pair *k, int log2_width, int log2_height, enum texel_kind kind)
{
    const smear_v4u next = w->z + w->step;
    const smear_v8u old = (smear_v8u)v8i_load(w->depth), nearer = v8u_less((smear_v8u)v8i_upper(w->z, next), old);
    const smear_v8i hidden = (smear_v8i)(nearer == 0);
    const smear_v4i low = texels_indices(k, log2_width, log2_height), high = texels_indices(k, log2_width, log2_height);
    if (!v4u_all_set((smear_v4u)hidden)) {
        v8i_store(w->depth, (smear_v8i)(old + nearer));
        texels_eight(w->color, w->texels, low, high, hidden, kind);
    }
    w->z = next + w->step;
    w->depth += 8;
    w->color = pixel_after(w->color, 8, texels_are_narrow(kind));
}

/* Draws n pixels from these coordinates on, the last of which end eight of the row: those of them that it draws again are hidden. */
SMEAR_INLINE void texels_row_draw(struct texels_row *w, int32_t n, uint64_t uv, uint64_t duv, uint64_t dduv, int log2_width,
                                  int log2_height, enum texel_kind kind)
{
    struct texels_pair k;
    texels_pair_start(&k, uv, duv, dduv);
    for (int32_t eights = n >> 3; eights > 0; eights--)
        texels_row_eight(w, &k, log2_width, log2_height, kind);
    if ((n & 7) == 0)
        return;
    const int64_t m = n - 8, again = 8 - (n & 7);
    w->z -= v4u_all((uint32_t)again * w->dz);
    w->depth -= again;
    w->color = pixel_after(w->color, (int32_t)-again, texels_are_narrow(kind));
    texels_pair_start(&k, uv + duv * (uint64_t)m + dduv * (uint64_t)(m * (m - 1) / 2), duv + dduv * (uint64_t)m, dduv);
    texels_row_eight(w, &k, log2_width, log2_height, kind);
}

/* texels_draw for eight or more copied texels that fit. */
SMEAR_INLINE void texels_draw_lanes(struct texel_run *run, int32_t n, int log2_width, int log2_height, enum texel_kind kind)
{
    struct texels_row w;
    texels_row_start(&w, run);
    texels_row_draw(&w, n, run->uv, run->duv, run->dduv, log2_width, log2_height, kind);
    run->color = w.color;
    run->depth = w.depth;
    run->z += (uint32_t)n * run->dz;
}

/* Draws a row of copied texels that fit from where a track has come to: `rest` pixels and the last, 8 at least. So are blocks. */
SMEAR_INLINE void texels_row_lanes(struct texel_track *k, int32_t rest, int log2_width, int log2_height, enum texel_kind kind)
{
    struct texels_row w;
    texels_row_start(&w, &k->run);
    const int32_t block = 1 << k->log2, slope = k->slope, qx = k->qx, ux = k->ux, vx = k->vx;
    const int up = k->up;
    const bool parabolic = k->parabolic;
    int32_t q = k->q, u = k->u, v = k->v;
    struct place at = k->place;
    while (rest > 0) {
        const int32_t n = block_next(block, rest);
        const struct place from = at;
        struct texel_run run;
        q = add_wrap(q, mul_wrap(qx, n));
        u = add_wrap(u, mul_wrap(ux, n));
        v = add_wrap(v, mul_wrap(vx, n));
        at = place_divided(q, u, v, slope, parabolic);
        texcoord_run(&run, places_between(from, at, n, up, parabolic, true));
        rest -= n;
        texels_row_draw(&w, n + (rest == 0), run.uv, run.duv, run.dduv, log2_width, log2_height, kind);
    }
    k->q = q;
    k->u = u;
    k->v = v;
    k->place = at;
}

#else
bool texels_fit_lanes(int log2_width, int log2_height);     /* nowhere, and not called */
void texels_row_lanes(struct texel_track *k, int32_t rest, int log2_width, int log2_height, enum texel_kind kind);
#endif

#endif
