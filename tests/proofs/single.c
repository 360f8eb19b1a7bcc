/* SPDX-License-Identifier: MIT */
/* single.c - single calls that read or write arrays by what they are given: texture addresses, and rows that are converted to
 * a display's format. Frama-C's Eva follows all values at once (`make proofs`). */
#include "display/pixel_format.c"
#include "raster/texture.c"

volatile int32_t any_int;
volatile uint32_t any_word;
volatile uint32_t seen;

/* A pixel's texel lies in the texture, whatever the coordinates are: sizes powers of two, repeated, and any sizes. */
static void addresses(void)
{
    for (int w = 0; w <= 12; w++)
        for (int h = 0; h <= 12 && w + h <= 16; h++) {
            const struct smear_sampler s = { .log2_width = (uint8_t)w, .log2_height = (uint8_t)h };
            const uint32_t at = sampler_index(&s, any_word, any_word);
            /*@ assert at < 1 << (w + h); */
            seen = at;
        }
}

static void texels(void)
{
    static const int32_t size[][2] = { { 1, 1 }, { 1, 7 }, { 7, 1 }, { 5, 3 }, { 8, 8 }, { 17, 2 }, { 16, 16 } };
    for (int i = 0; i < 7; i++)
        for (int wrap = 0; wrap < 9; wrap++) {
            uint32_t picture[256];
            const int32_t count = size[i][0] * size[i][1];
            for (int k = 0; k < count; k++)
                picture[k] = any_word;
            for (int bilinear = 0; bilinear < 2; bilinear++) {
                const struct smear_sampler s = { .texels = picture, .width = size[i][0], .height = size[i][1],
                                                 .format = SMEAR_TEXEL_8888, .wrap_u = (uint8_t)(wrap % 3),
                                                 .wrap_v = (uint8_t)(wrap / 3), .bilinear = bilinear != 0 };
                seen = smear_sample_at(&s, any_int, any_int);
            }
        }
}

/* Rows of up to 9 pixels, into a band of just their size: all rows that the thresholds tell apart. */
static void rows(void)
{
    static const int32_t width[] = { 1, 2, 7, 9 };
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++)
        for (int dither = SMEAR_DITHER_NONE; dither <= SMEAR_DITHER_BLUE; dither++)
            for (int i = 0; i < 4; i++)
                for (int32_t y = 0; y < 32; y += dither == SMEAR_DITHER_NONE ? 8 : 5) {
                    const int32_t n = width[i], y0 = format == SMEAR_L1_PAGES ? y & ~7 : y;
                    uint32_t in[9], band[9] = { 0, 0, 0, 0, 0, 0, 0, 0, 0 };
                    for (int k = 0; k < n; k++)
                        in[k] = any_word & 0xffffffu;
                    const uint32_t stride = smear_format_stride(n, (smear_format)format);
                    smear_format_row((uint8_t *)band + (sizeof band - (stride + 3) / 4 * 4), stride, in, n, 0, y, y0,
                                     (smear_format)format, (smear_dither)dither);
                    seen = band[8];
                }
}

int main(void)
{
    addresses();
    texels();
    rows();
    return 0;
}
