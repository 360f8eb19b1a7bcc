/* SPDX-License-Identifier: MIT */
/* gentables.c - writes src/base/tables.c to standard output: `make tables`. The only place where the library's
 * constants meet floating point; `make test` compares a fresh run with the committed file. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Values of a line: as many eights as 128 columns take. */
static int line_values(const uint32_t *value, int count)
{
    uint32_t most = 99;
    int width = 4;      /* "99, " */
    for (int i = 0; i < count; i++)
        for (; value[i] > most; most = most * 10 + 9)
            width++;
    return 128 / width & -8;
}

static void print_table(const char *comment, const char *type, const char *name, const uint32_t *value, int count)
{
    const int per_line = line_values(value, count);
    printf("\n/* %s */\nconst %s %s[%d] = {", comment, type, name, count);
    for (int i = 0; i < count; i++)
        printf("%s%u,", i % per_line == 0 ? "\n    " : " ", value[i]);
    printf("\n};\n");
}

static void print_signed_table(const char *comment, const char *name, const uint32_t *value, int count)
{
    printf("\n/* %s */\nconst int8_t %s[%d] = {", comment, name, count);
    for (int i = 0; i < count; i++)
        printf("%s%d,", i % 16 == 0 ? "\n    " : " ", (int)value[i]);
    printf("\n};\n");
}

static double srgb_decode(double c)
{
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double srgb_encode(double l)
{
    return l <= 0.0031308 ? l * 12.92 : 1.055 * pow(l, 1 / 2.4) - 0.055;
}

/* Void and cluster [Ulichney 1993]: ranks of a tileable dither pattern with a blue spectrum. */
enum { BLUE = 32, BLUE_CELLS = BLUE * BLUE };

static double blue_energy[BLUE_CELLS];
static int blue_set[BLUE_CELLS];

static void blue_flip(int cell, int set)
{
    blue_set[cell] = set;
    for (int other = 0; other < BLUE_CELLS; other++) {
        int dx = abs(cell % BLUE - other % BLUE), dy = abs(cell / BLUE - other / BLUE);
        dx = dx > BLUE / 2 ? BLUE - dx : dx;
        dy = dy > BLUE / 2 ? BLUE - dy : dy;
        double weight = exp(-(dx * dx + dy * dy) / (2 * 1.9 * 1.9));
        blue_energy[other] += set ? weight : -weight;
    }
}

/* The set cell in the densest place, or the empty cell in the emptiest; the first of equals. */
static int blue_extreme(int set)
{
    int best = -1;
    for (int cell = 0; cell < BLUE_CELLS; cell++)
        if (blue_set[cell] == set
            && (best < 0 || (set ? blue_energy[cell] > blue_energy[best] + 1e-9
                                 : blue_energy[cell] < blue_energy[best] - 1e-9)))
            best = cell;
    return best;
}

static void blue_noise(uint32_t *rank)
{
    int start[BLUE_CELLS], ones = BLUE_CELLS / 10;
    uint32_t random = 1;
    for (int placed = 0; placed < ones;) {
        random = random * 1664525u + 1013904223u;
        int cell = (int)(random >> 22);
        if (!blue_set[cell]) {
            blue_flip(cell, 1);
            placed++;
        }
    }
    for (;;) {      /* even the seed out: move the tightest point to the largest hole until it stays */
        int cluster = blue_extreme(1);
        blue_flip(cluster, 0);
        int hole = blue_extreme(0);
        blue_flip(hole, 1);
        if (hole == cluster)
            break;
    }
    memcpy(start, blue_set, sizeof start);
    for (int r = ones - 1; r >= 0; r--) {
        int cell = blue_extreme(1);
        blue_flip(cell, 0);
        rank[cell] = (uint32_t)r;
    }
    for (int cell = 0; cell < BLUE_CELLS; cell++)
        if (start[cell])
            blue_flip(cell, 1);
    for (int r = ones; r < BLUE_CELLS; r++) {
        int cell = blue_extreme(0);
        blue_flip(cell, 1);
        rank[cell] = (uint32_t)r;
    }
}

/* Whether (c factor + step) >> shift is the dithered level of all codes c, as pixel_rows.h has it. */
static bool is_dither_step(uint32_t step, uint32_t k, uint32_t levels, uint32_t factor, int shift)
{
    for (uint32_t c = 0; c < 256; c++)
        if ((c * factor + step) >> shift != (c * (257 * levels) + (c >> 7) * levels + ((4 * k + 2) << 8)) >> 16)
            return false;
    return true;
}

/* The least even step of 31 levels, half of which is one of 63 levels. */
static uint32_t dither_step(uint32_t k)
{
    uint32_t step = 0;
    while (!is_dither_step(step, k, 31, 249, 11) || !is_dither_step(step / 2, k, 63, 253, 10))
        step += 2;
    return step;
}

/* Place i of 8 x 8 of ordered dither, Bayer's: the bits of x ^ y and y, interleaved from the lowest up. */
static uint32_t ordered_of(int i)
{
    const int x = i & 7, y = i >> 3;
    int v = 0;
    for (int bit = 0; bit < 3; bit++)
        v = v << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
    return (uint32_t)v;
}

int main(void)
{
    static uint32_t t[4096];
    printf("/* SPDX-License-Identifier: MIT */\n"
           "/* tables.c - written by tools/gentables.c (`make tables`); do not edit. */\n"
           "#include \"base/tables.h\"\n");

    for (int i = 0; i < 512; i++)       /* the reciprocal of the middle of each 1/512 of [1, 2) */
        t[i] = (uint32_t)floor(2048 / (1 + (i + 0.5) / 512) + 0.5);
    print_table("2^11 / m for m = 1 + (i + 1/2) / 512; relative error below 2^-9.4", "uint16_t",
                "smear_recip_seed", t, 512);

    for (int i = 0; i < 256; i++)
        t[i] = (uint32_t)floor(65535 * srgb_decode(i / 255.0) + 0.5);
    print_table("sRGB code to linear light, 65535 is one", "uint16_t", "smear_srgb_decode", t, 256);

    for (int i = 0; i < 4096; i++)
        t[i] = (uint32_t)floor(255 * srgb_encode((i + 0.5) / 4096) + 0.5);
    print_table("linear light >> 4 to sRGB code", "uint8_t", "smear_srgb_encode", t, 4096);

    for (uint32_t i = 0; i < 256; i++) {        /* as light_sums.c has it: products of 16 bits */
        const uint32_t high = (i * i * (((i << 8) * 2501 >> 16) + 5742) >> 16) + 23,
                       low = (i << 8) * ((i * i * 21035 >> 16) + 607) >> 16;
        t[i] = (low < high ? low : high) >> 1;
    }
    print_table("sRGB code to linear light, 4095 is one, by the lesser of two cubics", "uint16_t", "smear_srgb_light", t,
                256);

    for (int i = 0; i < 1024; i++)
        t[i] = (uint32_t)fmin(255, floor(8 * sqrt((double)i) + 0.5));
    print_table("8 sqrt(i), at most 255", "uint8_t", "smear_sqrt_q3", t, 1024);

    for (int i = 0; i < 256; i++)
        t[i] = (uint32_t)(int)floor(127 * sin(i * 2 * 3.14159265358979323846 / 256) + 0.5);
    print_signed_table("127 sin(i 2 pi / 256)", "smear_sine", t, 256);

    for (int i = 0; i < 64; i++)
        t[i] = ordered_of(i) * 4 + 2;
    print_table("ordered dither, 8 x 8, thresholds in 1/256", "uint8_t", "smear_dither_ordered", t, 64);

    blue_noise(t);
    for (int i = 0; i < BLUE_CELLS; i++)
        t[i] = t[i] / 4;
    print_table("blue noise dither, 32 x 32, thresholds in 1/256", "uint8_t", "smear_dither_blue", t,
                BLUE_CELLS);

    for (uint32_t k = 0; k < 64; k++)
        t[k] = dither_step(k);
    print_table("what a threshold 4 k + 2 adds to a code of 31 levels, see pixel_rows.c", "uint16_t", "smear_dither_steps", t, 64);
    uint32_t ordered[64];
    for (int i = 0; i < 64; i++)
        ordered[i] = t[ordered_of(i)];
    for (int i = 0; i < 32; i++)
        t[i] = ordered[2 * i] | ordered[2 * i + 1] << 16;
    print_table("the same of ordered dither, two columns in a word, the left one below", "uint32_t", "smear_dither_pairs", t, 32);

    for (int i = 0; i < 128; i++) {     /* of the middle of each 1/128 of a radius */
        const double d = (i + 0.5) / 128, half = sqrt(1 - d * d);
        t[i] = (uint32_t)floor(256 / half + 0.5) << 16 | (uint32_t)floor(32768 * pow(half, 5) + 0.5);
    }
    print_table("across a streak: 2^24 / h, whole multiples of 2^16, + 2^15 h^5 for half chords h at (i + 1/2) / 128 radii",
                "uint32_t", "smear_streak_across", t, 128);

    for (int i = 0; i < 256; i++) {     /* 15/16 of the integral of (1 - s^2)^2 from -1 */
        const double s = (i - 127.5) / 128;
        t[i] = (uint32_t)fmin(65535, floor(65536 * (0.5 + 15.0 / 16 * s * (1 - s * s * (2.0 / 3 - s * s / 5))) + 0.5));
    }
    print_table("end of a streak: the part of a chord's light up to (i - 127.5) / 128 of its half, q16", "uint16_t",
                "smear_streak_end", t, 256);
    return 0;
}
