/* SPDX-License-Identifier: MIT */
/* test_metrics.c - tools/image/metrics.c: distances of pictures against hand-made values and
 * against direct implementations.
 *
 * The direct SSIM and FLIP below follow the definitions pixel by pixel with two-dimensional kernels
 * and the published numbers of the sRGB standard; nothing is separated, shared or kept between
 * pixels. */
#include "tests/random.h"
#include "tests/test.h"

#include "tools/image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct image make_image(int width, int height)
{
    struct image image;
    struct failure f = {""};
    CHECK(image_alloc(&image, width, height, &f));
    return image;
}

static struct image plain_image(int width, int height, int r, int g, int b)
{
    struct image image = make_image(width, height);
    for (int i = 0; i < width * height; i++) {
        image.rgba[i * 4] = (uint8_t)r;
        image.rgba[i * 4 + 1] = (uint8_t)g;
        image.rgba[i * 4 + 2] = (uint8_t)b;
    }
    return image;
}

/* Shapes, gradients and some noise; two seeds give pictures that are alike in places. */
static struct image busy_image(int width, int height, uint32_t seed)
{
    struct image image = make_image(width, height);
    random_state = seed * 2654435761u | 1;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint8_t *p = image.rgba + (y * width + x) * 4;
            bool inside = (x - width / 2) * (x - width / 2) + (y - height / 2) * (y - height / 2) <
                          width * height / 9;
            p[0] = (uint8_t)(inside ? 230 : x * 255 / width);
            p[1] = (uint8_t)(inside ? (int)seed * 31 & 255 : y * 255 / height);
            p[2] = (uint8_t)(x / 4 % 2 == 0 ? 40 : 200);
            if (random_u32() % 3 == 0)
                p[random_u32() % 3] = (uint8_t)random_u32();
            p[3] = (uint8_t)random_u32();
        }
    return image;
}

static struct image_distance compare(const struct image *a, const struct image *b, double ppd)
{
    struct image_distance d;
    struct failure f = {""};
    CHECK(image_compare(a, b, ppd, &d, &f));
    return d;
}

static int clamped(int v, int size)
{
    return v < 0 ? 0 : v >= size ? size - 1 : v;
}

static const uint8_t *clamped_pixel(const struct image *image, int x, int y)
{
    return image->rgba + (clamped(y, image->height) * image->width + clamped(x, image->width)) * 4;
}

/* --- direct SSIM --- */

static double luma_of(const uint8_t *p)
{
    return (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255;
}

static double direct_ssim(const struct image *a, const struct image *b)
{
    int skip_x = a->width >= 11 ? 5 : 0, skip_y = a->height >= 11 ? 5 : 0, windows = 0;
    double total = 0;
    for (int y = skip_y; y < a->height - skip_y; y++)
        for (int x = skip_x; x < a->width - skip_x; x++, windows++) {
            double weight = 0, ma = 0, mb = 0, va = 0, vb = 0, ab = 0;
            for (int pass = 0; pass < 2; pass++)        /* means first, then moments about them */
                for (int j = -5; j <= 5; j++)
                    for (int i = -5; i <= 5; i++) {
                        double w = exp(-(i * i + j * j) / 4.5);
                        double u = luma_of(clamped_pixel(a, x + i, y + j));
                        double v = luma_of(clamped_pixel(b, x + i, y + j));
                        if (pass == 0) {
                            weight += w;
                            ma += w * u;
                            mb += w * v;
                        } else {
                            va += w * (u - ma / weight) * (u - ma / weight);
                            vb += w * (v - mb / weight) * (v - mb / weight);
                            ab += w * (u - ma / weight) * (v - mb / weight);
                        }
                    }
            ma /= weight;
            mb /= weight;
            total += (2 * ma * mb + 1e-4) * (2 * ab / weight + 9e-4) /
                     ((ma * ma + mb * mb + 1e-4) * (va / weight + vb / weight + 9e-4));
        }
    return total / windows;
}

/* --- direct FLIP --- */

static double linear_of(int code)
{
    double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* XYZ of linear sRGB, exact fractions for D65 at 0.31271, 0.32902. */
static void xyz_of(const double rgb[3], double xyz[3])
{
    static const double m[3][3] = {
        {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
        {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
        {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382},
    };
    for (int i = 0; i < 3; i++)
        xyz[i] = m[i][0] * rgb[0] + m[i][1] * rgb[1] + m[i][2] * rgb[2];
}

static void white_xyz(double xyz[3])
{
    static const double ones[3] = {1, 1, 1};
    xyz_of(ones, xyz);
}

static void ycxcz_of(const uint8_t *p, double out[3])
{
    double rgb[3] = {linear_of(p[0]), linear_of(p[1]), linear_of(p[2])}, xyz[3], white[3];
    xyz_of(rgb, xyz);
    white_xyz(white);
    out[0] = 116 * xyz[1] / white[1] - 16;
    out[1] = 500 * (xyz[0] / white[0] - xyz[1] / white[1]);
    out[2] = 200 * (xyz[1] / white[1] - xyz[2] / white[2]);
}

/* Linear sRGB, clamped, by Cramer's rule on the matrix above. */
static void rgb_of_ycxcz(const double c[3], double rgb[3])
{
    double white[3], column[3][3], xyz[3];
    white_xyz(white);
    for (int k = 0; k < 3; k++) {
        double unit[3] = {k == 0, k == 1, k == 2};
        xyz_of(unit, column[k]);
    }
    double y = (c[0] + 16) / 116;
    xyz[0] = (y + c[1] / 500) * white[0];
    xyz[1] = y * white[1];
    xyz[2] = (y - c[2] / 200) * white[2];
    double determinants[4];
    for (int k = 0; k < 4; k++) {               /* 0..2: with that column replaced; 3: as it is */
        const double *a = k == 0 ? xyz : column[0], *b = k == 1 ? xyz : column[1];
        const double *d = k == 2 ? xyz : column[2];
        determinants[k] = a[0] * (b[1] * d[2] - b[2] * d[1]) - b[0] * (a[1] * d[2] - a[2] * d[1]) +
                          d[0] * (a[1] * b[2] - a[2] * b[1]);
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = determinants[k] / determinants[3];
        rgb[k] = rgb[k] < 0 ? 0 : rgb[k] > 1 ? 1 : rgb[k];
    }
}

static double lab_root(double t)
{
    return t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
}

static void hunt_lab_of(const double rgb[3], double lab[3])
{
    double xyz[3], white[3];
    xyz_of(rgb, xyz);
    white_xyz(white);
    double x = lab_root(xyz[0] / white[0]), y = lab_root(xyz[1] / white[1]);
    double z = lab_root(xyz[2] / white[2]);
    lab[0] = 116 * y - 16;
    lab[1] = 0.01 * lab[0] * 500 * (x - y);
    lab[2] = 0.01 * lab[0] * 200 * (y - z);
}

static double hyab(const double a[3], const double b[3])
{
    return fabs(a[0] - b[0]) + sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static double largest_color_difference(void)
{
    static const double green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    double a[3], b[3];
    hunt_lab_of(green, a);
    hunt_lab_of(blue, b);
    return pow(hyab(a, b), 0.7);
}

/* Colour of a pixel as seen from the distance: each opponent channel under its sensitivity. */
static void seen_color(const struct image *image, int x, int y, double ppd, double lab[3])
{
    static const double s[3][4] = {
        {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025},
    };
    double pi = acos(-1), sum[3] = {0}, weight[3] = {0}, rgb[3];
    int radius = (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * ppd);
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++) {
            double c[3], square = (i * i + j * j) / (ppd * ppd);
            ycxcz_of(clamped_pixel(image, x + i, y + j), c);
            for (int k = 0; k < 3; k++) {
                double w = s[k][0] * sqrt(pi / s[k][1]) * exp(-pi * pi * square / s[k][1]) +
                           s[k][2] * sqrt(pi / s[k][3]) * exp(-pi * pi * square / s[k][3]);
                sum[k] += w * c[k];
                weight[k] += w;
            }
        }
    for (int k = 0; k < 3; k++)
        sum[k] /= weight[k];
    rgb_of_ycxcz(sum, rgb);
    hunt_lab_of(rgb, lab);
}

/* Length of the response of the edge (order 1) or point (order 2) detectors along x and y. */
static double feature(const struct image *image, int x, int y, double ppd, int order)
{
    double deviation = 0.5 * 0.082 * ppd, sum[2][2] = {{0}}, weight[2][2] = {{0}}, response[2];
    int radius = (int)ceil(3 * deviation);
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++) {
            double c[3], g = exp(-(i * i + j * j) / (2 * deviation * deviation));
            ycxcz_of(clamped_pixel(image, x + i, y + j), c);
            for (int axis = 0; axis < 2; axis++) {
                int t = axis == 0 ? i : j;
                double w = order == 1 ? -t * g : (t * t / (deviation * deviation) - 1) * g;
                sum[axis][w > 0] += w * (c[0] + 16) / 116;      /* both signs are scaled to 1 */
                weight[axis][w > 0] += fabs(w);
            }
        }
    for (int axis = 0; axis < 2; axis++)
        response[axis] = sum[axis][0] / weight[axis][0] + sum[axis][1] / weight[axis][1];
    return sqrt(response[0] * response[0] + response[1] * response[1]);
}

static double direct_flip(const struct image *a, const struct image *b, double ppd)
{
    double total = 0, most = largest_color_difference();
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            double u[3], v[3];
            seen_color(a, x, y, ppd, u);
            seen_color(b, x, y, ppd, v);
            double color = pow(hyab(u, v), 0.7) / most;
            color = color < 0.4 ? color * 0.95 / 0.4 : 0.95 + (color - 0.4) / 0.6 * 0.05;
            double edge = fabs(feature(a, x, y, ppd, 1) - feature(b, x, y, ppd, 1));
            double point = fabs(feature(a, x, y, ppd, 2) - feature(b, x, y, ppd, 2));
            double change = sqrt((edge > point ? edge : point) / sqrt(2));
            total += pow(color, 1 - change);
        }
    return total / (a->width * a->height);
}

/* --- tests --- */

static void test_equal_pictures_have_no_distance(void)
{
    struct image a OWNED(image_free) = busy_image(40, 30, 1);
    struct image_distance d = compare(&a, &a, IMAGE_PIXELS_PER_DEGREE);
    CHECK(d.rmse == 0 && isinf(d.psnr) && d.psnr > 0);
    CHECK_CLOSE(d.ssim, 1, 1e-12);
    CHECK(d.flip == 0);
}

static void test_alpha_is_not_compared(void)
{
    struct image a OWNED(image_free) = busy_image(20, 20, 1), b = busy_image(20, 20, 1);
    for (int i = 3; i < 20 * 20 * 4; i += 4)
        b.rgba[i] = (uint8_t)~b.rgba[i];
    struct image_distance d = compare(&a, &b, 67);
    CHECK(d.rmse == 0 && d.flip == 0);
    CHECK_CLOSE(d.ssim, 1, 1e-12);
    image_free(&b);
}

static void test_rmse_and_psnr_by_hand(void)
{
    struct image a = plain_image(2, 1, 10, 20, 30), b = plain_image(2, 1, 10, 20, 30);
    b.rgba[0] = 13;             /* 9 + 16 + 25 over 6 samples */
    b.rgba[1] = 16;
    b.rgba[6] = 35;
    struct image_distance d = compare(&a, &b, 67);
    CHECK_CLOSE(d.rmse, 2.8867513459481287, 1e-12);
    CHECK_CLOSE(d.psnr, 20 * log10(255 / 2.8867513459481287), 1e-9);
    image_free(&a);
    image_free(&b);
    a = plain_image(9, 9, 0, 0, 0);
    b = plain_image(9, 9, 255, 255, 255);
    d = compare(&a, &b, 67);
    CHECK_CLOSE(d.rmse, 255, 1e-9);
    CHECK_CLOSE(d.psnr, 0, 1e-9);
    image_free(&a);
    image_free(&b);
}

static void test_ssim_of_plain_pictures_by_hand(void)
{
    struct image a OWNED(image_free) = plain_image(20, 15, 51, 51, 51), b = plain_image(20, 15, 102, 102, 102);
    /* luma 0.2 and 0.4, no variance: (2 * 0.08 + C1) / (0.04 + 0.16 + C1) */
    CHECK_CLOSE(compare(&a, &b, 67).ssim, 0.1601 / 0.2001, 1e-9);
    image_free(&b);
    b = plain_image(20, 15, 204, 0, 0);         /* luma 0.2392 */
    double want = (2 * 0.2 * 0.2392 + 1e-4) / (0.04 + 0.2392 * 0.2392 + 1e-4);
    CHECK_CLOSE(compare(&a, &b, 67).ssim, want, 1e-9);
    image_free(&b);
}

static void test_ssim_equals_the_direct_definition(void)
{
    static const int sizes[][2] = {{23, 17}, {11, 11}, {10, 20}, {30, 5}, {1, 1}, {12, 1}, {133, 12}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct image a OWNED(image_free) = busy_image(sizes[i][0], sizes[i][1], 2);
        struct image b OWNED(image_free) = busy_image(sizes[i][0], sizes[i][1], 5);
        double got = compare(&a, &b, 67).ssim, want = direct_ssim(&a, &b);
        CHECK_CLOSE(got, want, 1e-9);
        CHECK(i > 0 || (want > 0.05 && want < 0.95));
    }
}

static void test_flip_of_plain_pictures_is_their_colour_difference(void)
{
    struct image green OWNED(image_free) = plain_image(12, 9, 0, 255, 0), blue = plain_image(12, 9, 0, 0, 255);
    struct image black OWNED(image_free) = plain_image(12, 9, 0, 0, 0), white = plain_image(12, 9, 255, 255, 255);
    struct image grey OWNED(image_free) = plain_image(12, 9, 119, 119, 119), near = plain_image(12, 9, 122, 122, 122);
    CHECK_CLOSE(compare(&green, &blue, 67).flip, 1, 1e-9);      /* the largest there is */
    /* black and white are 100 apart, to the power 0.7 */
    double most = 41.2761, want = 0.95 + (25.11886 / most - 0.4) / 0.6 * 0.05;
    CHECK_CLOSE(largest_color_difference(), most, 1e-4);
    CHECK_CLOSE(compare(&black, &white, 67).flip, want, 1e-6);
    /* L* of code 119 is 50.0344, of 122 51.2231 */
    want = pow(51.2231 - 50.0344, 0.7) / most / 0.4 * 0.95;
    CHECK_CLOSE(compare(&grey, &near, 67).flip, want, 1e-5);
    image_free(&blue);
    image_free(&white);
    image_free(&near);
}

static void test_flip_equals_the_direct_definition(void)
{
    static const double densities[] = {67, 34, 10, 100};
    for (size_t i = 0; i < sizeof densities / sizeof densities[0]; i++) {
        struct image a OWNED(image_free) = busy_image(24, 19, 3), b = busy_image(24, 19, 4);
        double got = compare(&a, &b, densities[i]).flip, want = direct_flip(&a, &b, densities[i]);
        CHECK_CLOSE(got, want, 1e-7);
        CHECK(want > 0.02 && want < 0.98);
        CHECK_CLOSE(compare(&b, &a, densities[i]).flip, got, 1e-12);
        image_free(&b);
    }
}

/* Bands of columns (metrics.c) end in these, and the windows of some see no difference. */
static void test_wide_pictures_alike_but_for_dots_equal_the_direct_definitions(void)
{
    static const int sizes[][2] = {{300, 22}, {257, 21}, {128, 21}, {129, 40}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        struct image a OWNED(image_free) = busy_image(width, height, 8), b = busy_image(width, height, 8);
        int dots[][2] = {{2, 3}, {127, 20}, {width - 1, height - 1}};
        for (size_t k = 0; k < sizeof dots / sizeof dots[0]; k++)
            b.rgba[(dots[k][1] * width + dots[k][0]) * 4 + 1] ^= 0x80;
        struct image_distance got = compare(&a, &b, 34);
        CHECK_CLOSE(got.ssim, direct_ssim(&a, &b), 1e-9);
        CHECK_CLOSE(got.flip, direct_flip(&a, &b, 34), 1e-7);
        CHECK(got.flip > 0 && got.ssim < 1);
        image_free(&b);
    }
}

static void test_flip_of_tiny_pictures_and_extreme_densities_is_in_range(void)
{
    static const int sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {3, 2}};
    static const double densities[] = {1, 2.5, 500, 1000};
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 4; k++) {
            struct image a OWNED(image_free) = busy_image(sizes[i][0], sizes[i][1], 6);
            struct image b OWNED(image_free) = busy_image(sizes[i][0], sizes[i][1], 7);
            double got = compare(&a, &b, densities[k]).flip;
            CHECK(got >= 0 && got <= 1);
            if (densities[k] < 100)
                CHECK_CLOSE(got, direct_flip(&a, &b, densities[k]), 1e-7);
        }
}

static void test_fine_noise_weighs_less_from_afar(void)
{
    struct image a OWNED(image_free) = plain_image(64, 48, 128, 128, 128), b = plain_image(64, 48, 128, 128, 128);
    for (int i = 0; i < 64 * 48; i++)
        memset(b.rgba + i * 4, (i + i / 64) % 2 == 0 ? 138 : 118, 3);
    double close = compare(&a, &b, 10).flip, middle = compare(&a, &b, 20).flip;
    double far = compare(&a, &b, 67).flip;
    CHECK(close > 0.2 && middle < close * 0.8 && far < middle * 0.25);
    image_free(&b);
}

static void test_pictures_that_cannot_be_compared_are_refused(void)
{
    struct image a OWNED(image_free) = make_image(4, 4), b = make_image(4, 5), empty = {0};
    struct image_distance d;
    struct failure f = {""}, g = {""}, h = {""};
    CHECK(!image_compare(&a, &b, 67, &d, &f) && strstr(f.text, "differ in size") != NULL);
    CHECK(!image_compare(&empty, &empty, 67, &d, &g) && strstr(g.text, "empty") != NULL);
    static const double wrong[] = {0, -67, 0.5, 1e6, NAN, INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        CHECK(!image_compare(&a, &a, wrong[i], &d, &h));
    CHECK(strstr(h.text, "pixels per degree") != NULL);
    image_free(&b);
}

#include "build/suites/metrics.h"
