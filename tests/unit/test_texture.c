/* SPDX-License-Identifier: MIT */
/* test_texture.c - texels by every wrap mode, format and size, against direct arithmetic on the
 * coordinate. Needs neither libc nor floating point. */
#include "raster/texture.h"

#include "base/tables.h"
#include "tests/random.h"
#include "tests/test.h"

enum { MOST = 64 * 64, RUN_PIXELS = 24 };

static uint32_t texels[MOST];
static uint16_t texels565[MOST];
static uint8_t texels8[MOST];
static uint32_t palette[256];

static void random_texels(void)
{
    for (int i = 0; i < MOST; i++) {
        texels[i] = random_u32();
        texels565[i] = (uint16_t)random_u32();
        texels8[i] = (uint8_t)random_u32();
    }
    for (int i = 0; i < 256; i++)
        palette[i] = random_u32();
}

static smear_texture texture_of(int32_t width, int32_t height, int format, int wrap_u, int wrap_v)
{
    const void *const data[3] = { texels, texels565, texels8 };
    return (smear_texture){
        .texels = data[format], .palette = palette, .width = (uint16_t)width, .height = (uint16_t)height,
        .format = (uint8_t)format, .wrap_u = (uint8_t)wrap_u, .wrap_v = (uint8_t)wrap_v
    };
}

/* n texels from (u, v) on, q16 texels, in steps. Samplers that count in turns get them so. */
static void sample(uint32_t *out, const struct smear_sampler *s, int32_t u, int32_t v, int32_t du, int32_t dv, int n)
{
    int up_u = s->turns ? 16 - s->log2_width : 0, up_v = s->turns ? 16 - s->log2_height : 0;
    const struct smear_texture_run run = {
        .at = packed_uv((uint32_t)u << up_u, (uint32_t)v << up_v),
        .step = packed_step((uint32_t)du << up_u, (uint32_t)dv << up_v)
    };
    smear_sample(out, s, &run, 0, n);
}

static int64_t floor_divide(int64_t a, int64_t b)
{
    int64_t q = a / b;
    return a % b < 0 ? q - 1 : q;
}

/* The texel that a wrap mode shows at integer coordinate i. */
static int32_t wrapped(int64_t i, int32_t size, int mode)
{
    if (mode == SMEAR_CLAMP)
        return (int32_t)(i < 0 ? 0 : i >= size ? size - 1 : i);
    int64_t round = floor_divide(i, size), at = i - round * size;
    return (int32_t)(mode == SMEAR_MIRROR && (round & 1) ? size - 1 - at : at);
}

/* c x 255 / levels to nearest. */
static uint32_t expanded(uint32_t c, uint32_t levels)
{
    return (2 * c * 255 + levels) / (2 * levels);
}

static uint32_t texel_at(const smear_texture *t, int64_t iu, int64_t iv)
{
    int32_t at = wrapped(iv, t->height, t->wrap_v) * t->width + wrapped(iu, t->width, t->wrap_u);
    if (t->format == SMEAR_TEXEL_8888)
        return texels[at];
    if (t->format == SMEAR_TEXEL_PALETTE8)
        return palette[texels8[at]];
    uint32_t c = texels565[at];
    return 0xff000000u | expanded(c >> 11, 31) << 16 | expanded(c >> 5 & 63u, 63) << 8 | expanded(c & 31u, 31);
}

static const int32_t sizes[][2] = {
    { 1, 1 }, { 2, 2 }, { 64, 64 }, { 64, 1 }, { 1, 64 }, { 8, 32 }, { 3, 3 }, { 7, 64 }, { 64, 5 }, { 50, 37 }, { 63, 61 }
};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static void test_nearest_texels_are_those_at_the_floor_of_the_coordinate(void)
{
    random_state = 1;
    random_texels();
    for (int n = 0; n < 1600; n++) {
        smear_texture t = texture_of(sizes[n % SIZES][0], sizes[n % SIZES][1], n / 3 % 3, n % 3, n / 9 % 3);
        struct smear_sampler s;
        smear_sampler_make(&s, &t, between(1, 15), false, n & 1);
        int32_t reach = 1 << between(16, 29), step = 1 << between(4, 20);
        int32_t u = between(-reach, reach), v = between(-reach, reach), du = between(-step, step), dv = between(-step, step);
        uint32_t out[RUN_PIXELS + 1];
        int count = between(1, RUN_PIXELS);
        out[count] = 0x5a5a5a5au;
        sample(out, &s, u, v, du, dv, count);
        for (int i = 0; i < count; i++) {
            int64_t at_u = floor_divide((int64_t)u + (int64_t)i * du, 65536);
            int64_t at_v = floor_divide((int64_t)v + (int64_t)i * dv, 65536);
            REQUIRE_EQ(out[i], texel_at(&t, at_u, at_v));
        }
        CHECK_EQ(out[count], 0x5a5a5a5au);
    }
}

static void test_curved_runs_change_their_step_every_two_pixels_wherever_they_are_cut(void)
{
    random_state = 5;
    random_texels();
    for (int n = 0; n < 300; n++) {
        smear_texture t = texture_of(sizes[n % SIZES][0], sizes[n % SIZES][1], n / 3 % 3, n % 3, n / 9 % 3);
        struct smear_sampler s;
        smear_sampler_make(&s, &t, 15, n % 5 == 0, false);
        static const int32_t reach[3] = { 1 << 20, 100000, 9000 };
        uint32_t word[6];
        for (int i = 0; i < 6; i++)
            word[i] = (uint32_t)between(-reach[i / 2], reach[i / 2]);
        const struct smear_texture_run run = {
            .at = packed_uv(word[0], word[1]), .step = packed_step(word[2], word[3]), .curvature = packed_step(word[4], word[5])
        };
        /* Pixel by pixel: each as a run of one. */
        uint32_t want[16], out[17];
        struct smear_texture_run at = run;
        for (int i = 0; i < 16; i++) {
            struct smear_texture_run one = { .at = at.at };
            smear_sample(&want[i], &s, &one, 0, 1);
            at.at += at.step;
            at.step += run.curvature;
        }
        int first = between(0, 15), count = between(1, 16 - first);
        out[count] = 0x5a5a5a5au;
        smear_sample(out, &s, &run, first, count);
        for (int i = 0; i < count; i++)
            REQUIRE_EQ(out[i], want[first + i]);
        CHECK_EQ(out[count], 0x5a5a5a5au);
    }
}

/* Mean of four texels in one channel, in q16 of `one`. */
static int64_t mean_of_four(const uint32_t value[4], int64_t fu, int64_t fv)
{
    return (value[0] * (65536 - fu) + value[1] * fu) * (65536 - fv)
         + (value[2] * (65536 - fu) + value[3] * fu) * fv;
}

static void test_bilinear_texels_are_the_mean_of_four_around(void)
{
    random_state = 3;
    for (int n = 0; n < 500; n++) {
        random_texels();
        smear_texture t = texture_of(sizes[n % SIZES][0], sizes[n % SIZES][1], n / 3 % 3, n % 3, n / 9 % 3);
        bool linear = n & 1;
        struct smear_sampler s;
        smear_sampler_make(&s, &t, 15, true, linear);
        int32_t u = between(-(1 << 24), 1 << 24), v = between(-(1 << 24), 1 << 24);
        uint32_t out;
        sample(&out, &s, u, v, 0, 0, 1);
        /* Centres of texels lie at halves. */
        int64_t iu = floor_divide((int64_t)u - 32768, 65536), iv = floor_divide((int64_t)v - 32768, 65536);
        int64_t fu = (int64_t)u - 32768 - iu * 65536, fv = (int64_t)v - 32768 - iv * 65536;
        const uint32_t corner[4] = { texel_at(&t, iu, iv), texel_at(&t, iu + 1, iv), texel_at(&t, iu, iv + 1),
                                     texel_at(&t, iu + 1, iv + 1) };
        for (int shift = 0; shift < 32; shift += 8) {
            uint32_t value[4];
            bool light = linear && shift < 24;
            for (int i = 0; i < 4; i++)
                value[i] = light ? smear_srgb_decode[corner[i] >> shift & 255u] : corner[i] >> shift & 255u;
            uint32_t mean = (uint32_t)((mean_of_four(value, fu, fv) + ((int64_t)1 << 31)) >> 32);
            uint32_t want = light ? smear_srgb_encode[mean >> 4] : mean;
            /* Weights have 8 bits and rounding happens three times. Near black a code is little light. */
            if (!CHECK_NEAR(out >> shift & 255u, want, light ? 3 : 2)) {
                CHECK_EQ(n * 100 + shift, -1);
                return;
            }
        }
    }
}

#include "build/suites/texture.h"
