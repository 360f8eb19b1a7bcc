/* SPDX-License-Identifier: MIT */
/* metrics.c - how far one picture is from another: RMSE, PSNR, SSIM and LDR-FLIP.
 *
 * [Andersson20] "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
 * [Wang04] "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE TIP
 * 2004.
 *
 * Both SSIM and FLIP are convolutions with separable kernels. Rows are convolved along x when the
 * window of the column convolution first needs them, and kept in a ring as high as the kernel, so
 * memory grows with the width and the radius but not with the height. */
#include "tools/image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* --- convolution --- */

enum { MAX_RADIUS = 160, MAX_TAPS = 2 * MAX_RADIUS + 1 };

struct kernel {
    int radius;
    double weight[MAX_TAPS];
};

/* Rows of several planes, convolved along x; row y lives in slot y modulo `slots`. */
struct ring {
    int width, height, slots, planes, filled;   /* rows 0 .. filled - 1 have been made */
    int margin;                 /* clamped pixels beside a row before it is convolved */
    double *rows;               /* [slot][plane][x] */
    double *wide;               /* one row with its margins */
};

static bool ring_alloc(struct ring *r, int width, int height, int radius, int planes)
{
    *r = (struct ring){.width = width, .height = height, .slots = 2 * radius + 1, .planes = planes,
                       .margin = radius};
    r->rows = malloc((size_t)r->slots * (size_t)planes * (size_t)width * sizeof *r->rows);
    r->wide = malloc(((size_t)width + 2 * (size_t)radius) * sizeof *r->wide);
    return r->rows != NULL && r->wide != NULL;
}

static void ring_free(struct ring *r)
{
    free(r->rows);
    free(r->wide);
}

/* A row of a plane; y outside the picture is clamped to its edge. */
static double *ring_row(const struct ring *r, int y, int plane)
{
    y = y < 0 ? 0 : y >= r->height ? r->height - 1 : y;
    size_t row = (size_t)(y % r->slots) * (size_t)r->planes + (size_t)plane;
    return r->rows + row * (size_t)r->width;
}

/* Where to put the values of a row before convolving it. */
static double *ring_input(struct ring *r)
{
    return r->wide + r->margin;
}

static void ring_clamp_input(struct ring *r)
{
    double *row = ring_input(r);
    for (int i = 1; i <= r->margin; i++) {
        row[-i] = row[0];
        row[r->width - 1 + i] = row[r->width - 1];
    }
}

/* The clamped input convolved along x into row y of a plane. */
static void ring_convolve_x(struct ring *r, int y, int plane, const struct kernel *k)
{
    double *to = ring_row(r, y, plane);
    memset(to, 0, (size_t)r->width * sizeof *to);
    for (int i = -k->radius; i <= k->radius; i++) {
        const double *from = ring_input(r) + i;
        double weight = k->weight[i + k->radius];
        for (int x = 0; x < r->width; x++)
            to[x] += weight * from[x];
    }
}

/* A plane convolved along y, centred on row y. */
static void ring_convolve_y(const struct ring *r, int y, int plane, const struct kernel *k,
                            double *to)
{
    memset(to, 0, (size_t)r->width * sizeof *to);
    for (int i = -k->radius; i <= k->radius; i++) {
        const double *from = ring_row(r, y + i, plane);
        double weight = k->weight[i + k->radius];
        for (int x = 0; x < r->width; x++)
            to[x] += weight * from[x];
    }
}

/* --- RMSE and PSNR --- */

static double mean_square_error(const struct image *a, const struct image *b)
{
    uint64_t sum = 0;           /* below 2^28 pixels x 3 x 2^16 */
    size_t pixels = (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < pixels * 4; i += 4)
        for (size_t k = 0; k < 3; k++) {
            int difference = a->rgba[i + k] - b->rgba[i + k];
            sum += (uint64_t)(difference * difference);
        }
    return (double)sum / (3.0 * (double)pixels);
}

/* --- SSIM --- */

enum { SSIM_RADIUS = 5 };

/* Rec. 601 luma of codes, 0..1. */
static double luma(const uint8_t *rgba)
{
    return (0.299 * rgba[0] + 0.587 * rgba[1] + 0.114 * rgba[2]) / 255;
}

/* Convolves row y of the five moments a, b, aa, bb, ab. */
static void ssim_fill_row(struct ring *r, int y, const struct image *a, const struct image *b,
                          const struct kernel *window)
{
    const uint8_t *p = a->rgba + (size_t)y * (size_t)a->width * 4;
    const uint8_t *q = b->rgba + (size_t)y * (size_t)b->width * 4;
    double *in = ring_input(r);
    for (int plane = 0; plane < 5; plane++) {
        for (int x = 0; x < r->width; x++) {
            double u = luma(p + x * 4), v = luma(q + x * 4);
            double moment[5] = {u, v, u * u, v * v, u * v};
            in[x] = moment[plane];
        }
        ring_clamp_input(r);
        ring_convolve_x(r, y, plane, window);
    }
}

/* Mean over the windows that lie inside the picture, as in [Wang04]; along an edge shorter than a
 * window over all pixels, with the picture's edge repeated. */
static bool mean_ssim(const struct image *a, const struct image *b, double *result,
                      struct failure *f)
{
    struct kernel window = {.radius = SSIM_RADIUS};
    double total = 0;
    for (int i = -SSIM_RADIUS; i <= SSIM_RADIUS; i++)
        total += window.weight[i + SSIM_RADIUS] = exp(-i * i / (2 * 1.5 * 1.5));
    for (int i = 0; i <= 2 * SSIM_RADIUS; i++)
        window.weight[i] /= total;

    struct ring r;
    double *moment = malloc((size_t)a->width * 5 * sizeof *moment);
    bool ok = ring_alloc(&r, a->width, a->height, SSIM_RADIUS, 5) && moment != NULL;
    int border_x = a->width > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    int border_y = a->height > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    double sum = 0;
    for (int y = border_y; ok && y < a->height - border_y; y++) {
        for (; r.filled < a->height && r.filled <= y + SSIM_RADIUS; r.filled++)
            ssim_fill_row(&r, r.filled, a, b, &window);
        for (int plane = 0; plane < 5; plane++)
            ring_convolve_y(&r, y, plane, &window, moment + (size_t)plane * (size_t)a->width);
        for (int x = border_x; x < a->width - border_x; x++) {
            const double *m = moment + x;
            size_t w = (size_t)a->width;
            double mean_a = m[0], mean_b = m[w];
            double variance_a = m[2 * w] - mean_a * mean_a, variance_b = m[3 * w] - mean_b * mean_b;
            double covariance = m[4 * w] - mean_a * mean_b;
            double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
            sum += (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
                   ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
        }
    }
    ring_free(&r);
    free(moment);
    if (!ok)
        return fail(f, "out of memory (comparison)");
    *result = sum / ((double)(a->width - 2 * border_x) * (double)(a->height - 2 * border_y));
    return true;
}

/* --- LDR-FLIP --- */

struct color {
    double x, y, z;             /* RGB, XYZ, YCxCz or L*a*b* */
};

/* The two Gaussians in degrees that make up the contrast sensitivity of a channel: the weights and
 * squared widths of [Andersson20], table 1. Luminance and red-green have only one. */
struct sensitivity {
    double a1, b1, a2, b2;
};
static const struct sensitivity sensitivity_y = {1, 0.0047, 0, 1e-5};
static const struct sensitivity sensitivity_cx = {1, 0.0053, 0, 1e-5};
static const struct sensitivity sensitivity_cz = {34.1, 0.04, 13.5, 0.025};

enum flip_plane { PLANE_Y, PLANE_CX, PLANE_CZ1, PLANE_CZ2, PLANE_SMOOTH, PLANE_EDGE, PLANE_POINT,
                  FLIP_PLANES };

struct flip {
    double linear[256];         /* sRGB codes to linear light */
    double rgb_to_xyz[3][3], xyz_to_rgb[3][3];
    struct color white;         /* XYZ of (1, 1, 1) */
    struct kernel y, cx, cz1, cz2;
    double cz1_share, cz2_share;
    struct kernel smooth, edge, point;
    int radius;                 /* of the largest kernel */
    double max_color_difference;
};

static struct color transform(const double m[3][3], struct color c)
{
    return (struct color){
        m[0][0] * c.x + m[0][1] * c.y + m[0][2] * c.z,
        m[1][0] * c.x + m[1][1] * c.y + m[1][2] * c.z,
        m[2][0] * c.x + m[2][1] * c.y + m[2][2] * c.z,
    };
}

static void invert(double m[3][3], double inverse[3][3])
{
    double determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
            inverse[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
        }
    for (int i = 0; i < 3; i++)
        determinant += m[0][i] * inverse[i][0];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse[i][j] /= determinant;
}

/* The matrices of sRGB from the chromaticities of its primaries and its white, D65, with the five
 * digits that FLIP is defined with. */
static void flip_color_matrices(struct flip *p)
{
    static const double primary[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    static const double white[2] = {0.31271, 0.32902};
    double columns[3][3], inverse[3][3];
    for (int i = 0; i < 3; i++) {
        columns[0][i] = primary[i][0] / primary[i][1];
        columns[1][i] = 1;
        columns[2][i] = (1 - primary[i][0] - primary[i][1]) / primary[i][1];
    }
    p->white = (struct color){white[0] / white[1], 1, (1 - white[0] - white[1]) / white[1]};
    invert(columns, inverse);
    struct color scale = transform((const double(*)[3])inverse, p->white);
    for (int row = 0; row < 3; row++) {
        p->rgb_to_xyz[row][0] = columns[row][0] * scale.x;
        p->rgb_to_xyz[row][1] = columns[row][1] * scale.y;
        p->rgb_to_xyz[row][2] = columns[row][2] * scale.z;
    }
    invert(p->rgb_to_xyz, p->xyz_to_rgb);
}

/* The opponent space that is linear in light, so that averages mean something. */
static struct color rgb_to_ycxcz(const struct flip *p, struct color rgb)
{
    struct color c = transform((const double(*)[3])p->rgb_to_xyz, rgb);
    double x = c.x / p->white.x, y = c.y / p->white.y, z = c.z / p->white.z;
    return (struct color){116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

static double clamp01(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

static struct color ycxcz_to_rgb(const struct flip *p, struct color c)
{
    double y = (c.x + 16) / 116, x = y + c.y / 500, z = y - c.z / 200;
    struct color xyz = {x * p->white.x, y * p->white.y, z * p->white.z};
    struct color rgb = transform((const double(*)[3])p->xyz_to_rgb, xyz);
    return (struct color){clamp01(rgb.x), clamp01(rgb.y), clamp01(rgb.z)};
}

static double lab_curve(double t)
{
    double knee = 6.0 / 29;
    return t > knee * knee * knee ? cbrt(t) : t / (3 * knee * knee) + 4.0 / 29;
}

/* L*a*b* with the chroma of dark colours reduced (Hunt effect). */
static struct color rgb_to_hunt_lab(const struct flip *p, struct color rgb)
{
    struct color c = transform((const double(*)[3])p->rgb_to_xyz, rgb);
    double x = lab_curve(c.x / p->white.x), y = lab_curve(c.y / p->white.y);
    double z = lab_curve(c.z / p->white.z), lightness = 116 * y - 16;
    return (struct color){lightness, 0.01 * lightness * 500 * (x - y),
                          0.01 * lightness * 200 * (y - z)};
}

/* HyAB to the power 0.7. */
static double color_distance(struct color a, struct color b)
{
    return pow(fabs(a.x - b.x) + hypot(a.y - b.y, a.z - b.z), 0.7);
}

/* exp(-pi^2 x^2 / b) at whole pixels, x in degrees; returns the sum of the weights. */
static double sensitivity_kernel(struct kernel *k, double b, double pixels_per_degree, int radius)
{
    double sum = 0;
    k->radius = radius;
    for (int i = -radius; i <= radius; i++) {
        double x = i / pixels_per_degree;
        sum += k->weight[i + radius] = exp(-pi * pi * x * x / b);
    }
    return sum;
}

static void scale_kernel(struct kernel *k, double by)
{
    for (int i = 0; i <= 2 * k->radius; i++)
        k->weight[i] *= by;
}

/* Feature detectors: a Gaussian and, times it, its first and second derivative, each scaled so that
 * the positive weights sum to 1 and the negative ones to -1. */
static void feature_kernels(struct flip *p, double deviation, int radius)
{
    double smooth_sum = 0, edge_sum = 0, positive = 0, negative = 0;
    p->smooth.radius = p->edge.radius = p->point.radius = radius;
    for (int i = -radius; i <= radius; i++) {
        double g = exp(-i * i / (2 * deviation * deviation));
        double second = (i * i / (deviation * deviation) - 1) * g;
        smooth_sum += p->smooth.weight[i + radius] = g;
        p->edge.weight[i + radius] = -i * g;
        p->point.weight[i + radius] = second;
        edge_sum += i > 0 ? i * g : 0;
        positive += second > 0 ? second : 0;
        negative -= second < 0 ? second : 0;
    }
    scale_kernel(&p->smooth, 1 / smooth_sum);
    scale_kernel(&p->edge, 1 / edge_sum);
    for (int i = 0; i <= 2 * radius; i++)
        p->point.weight[i] /= p->point.weight[i] > 0 ? positive : negative;
}

static void flip_prepare(struct flip *p, double pixels_per_degree)
{
    memset(p, 0, sizeof *p);
    for (int code = 0; code < 256; code++) {
        double v = code / 255.0;
        p->linear[code] = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
    }
    flip_color_matrices(p);

    /* The radius that the widest Gaussian needs serves all three channels. */
    int radius = (int)ceil(3 * sqrt(sensitivity_cz.b1 / (2 * pi * pi)) * pixels_per_degree);
    double sum = sensitivity_kernel(&p->y, sensitivity_y.b1, pixels_per_degree, radius);
    scale_kernel(&p->y, 1 / sum);
    sum = sensitivity_kernel(&p->cx, sensitivity_cx.b1, pixels_per_degree, radius);
    scale_kernel(&p->cx, 1 / sum);
    double sum1 = sensitivity_kernel(&p->cz1, sensitivity_cz.b1, pixels_per_degree, radius);
    double sum2 = sensitivity_kernel(&p->cz2, sensitivity_cz.b2, pixels_per_degree, radius);
    double peak1 = sensitivity_cz.a1 * sqrt(pi / sensitivity_cz.b1);
    double peak2 = sensitivity_cz.a2 * sqrt(pi / sensitivity_cz.b2);
    double whole = peak1 * sum1 * sum1 + peak2 * sum2 * sum2;
    p->cz1_share = peak1 / whole;
    p->cz2_share = peak2 / whole;

    double deviation = 0.5 * 0.082 * pixels_per_degree;
    int feature_radius = (int)ceil(3 * deviation);
    feature_kernels(p, deviation, feature_radius);
    p->radius = radius > feature_radius ? radius : feature_radius;

    p->max_color_difference = color_distance(rgb_to_hunt_lab(p, (struct color){0, 1, 0}),
                                             rgb_to_hunt_lab(p, (struct color){0, 0, 1}));
}

static void flip_fill_row(const struct flip *p, struct ring *r, int y, const struct image *image,
                          struct color *row)
{
    const uint8_t *from = image->rgba + (size_t)y * (size_t)image->width * 4;
    double *in = ring_input(r);
    for (int x = 0; x < r->width; x++, from += 4)
        row[x] = rgb_to_ycxcz(p, (struct color){p->linear[from[0]], p->linear[from[1]],
                                                 p->linear[from[2]]});
    for (int x = 0; x < r->width; x++)
        in[x] = row[x].y;
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_CX, &p->cx);
    for (int x = 0; x < r->width; x++)
        in[x] = row[x].z;
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_CZ1, &p->cz1);
    ring_convolve_x(r, y, PLANE_CZ2, &p->cz2);
    for (int x = 0; x < r->width; x++)
        in[x] = row[x].x;
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_Y, &p->y);
    for (int x = 0; x < r->width; x++)
        in[x] = (row[x].x + 16) / 116;          /* 0..1 for the feature detectors */
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_SMOOTH, &p->smooth);
    ring_convolve_x(r, y, PLANE_EDGE, &p->edge);
    ring_convolve_x(r, y, PLANE_POINT, &p->point);
}

/* What FLIP compares at each pixel of a row. */
struct flip_row {
    struct color *lab;
    double *edge, *point;       /* lengths of the two detectors' gradients */
    double *scratch;            /* four rows */
};

static void flip_finish_row(const struct flip *p, const struct ring *r, int y, struct flip_row *out)
{
    size_t w = (size_t)r->width;
    double *s0 = out->scratch, *s1 = s0 + w, *s2 = s1 + w, *s3 = s2 + w;
    ring_convolve_y(r, y, PLANE_Y, &p->y, s0);
    ring_convolve_y(r, y, PLANE_CX, &p->cx, s1);
    ring_convolve_y(r, y, PLANE_CZ1, &p->cz1, s2);
    ring_convolve_y(r, y, PLANE_CZ2, &p->cz2, s3);
    for (size_t x = 0; x < w; x++) {
        double cz = p->cz1_share * s2[x] + p->cz2_share * s3[x];
        out->lab[x] = rgb_to_hunt_lab(p, ycxcz_to_rgb(p, (struct color){s0[x], s1[x], cz}));
    }
    ring_convolve_y(r, y, PLANE_EDGE, &p->smooth, s0);
    ring_convolve_y(r, y, PLANE_SMOOTH, &p->edge, s1);
    ring_convolve_y(r, y, PLANE_POINT, &p->smooth, s2);
    ring_convolve_y(r, y, PLANE_SMOOTH, &p->point, s3);
    for (size_t x = 0; x < w; x++) {
        out->edge[x] = hypot(s0[x], s1[x]);
        out->point[x] = hypot(s2[x], s3[x]);
    }
}

static double flip_pixel(const struct flip *p, const struct flip_row *a, const struct flip_row *b,
                         int x)
{
    /* Colour: up to 0.4 of the largest difference onto 0..0.95, the rest onto 0.95..1. */
    double knee = 0.4 * p->max_color_difference;
    double color = color_distance(a->lab[x], b->lab[x]);
    if (color < knee)
        color *= 0.95 / knee;
    else
        color = 0.95 + (color - knee) / (p->max_color_difference - knee) * 0.05;
    double edge = fabs(a->edge[x] - b->edge[x]), point = fabs(a->point[x] - b->point[x]);
    double feature = sqrt((edge > point ? edge : point) / sqrt(2));
    return color > 0 ? pow(color, feature < 1 ? 1 - feature : 0) : 0;
}

static bool flip_row_alloc(struct flip_row *r, int width)
{
    r->lab = malloc((size_t)width * sizeof *r->lab);
    r->edge = malloc((size_t)width * sizeof *r->edge);
    r->point = malloc((size_t)width * sizeof *r->point);
    r->scratch = malloc((size_t)width * 4 * sizeof *r->scratch);
    return r->lab != NULL && r->edge != NULL && r->point != NULL && r->scratch != NULL;
}

static void flip_row_free(struct flip_row *r)
{
    free(r->lab);
    free(r->edge);
    free(r->point);
    free(r->scratch);
}

static bool mean_flip(const struct image *a, const struct image *b, double pixels_per_degree,
                      double *result, struct failure *f)
{
    const struct image *image[2] = {a, b};
    struct ring ring[2] = {{0}, {0}};
    struct flip_row row[2] = {{0}, {0}};
    struct flip *p = malloc(sizeof *p);
    bool ok = p != NULL;
    if (ok)
        flip_prepare(p, pixels_per_degree);
    for (int i = 0; ok && i < 2; i++)
        ok = ring_alloc(&ring[i], a->width, a->height, p->radius, FLIP_PLANES) &&
             flip_row_alloc(&row[i], a->width);
    double sum = 0;
    for (int y = 0; ok && y < a->height; y++) {
        for (int i = 0; i < 2; i++) {
            for (; ring[i].filled < a->height && ring[i].filled <= y + p->radius; ring[i].filled++)
                flip_fill_row(p, &ring[i], ring[i].filled, image[i], row[i].lab);
            flip_finish_row(p, &ring[i], y, &row[i]);
        }
        for (int x = 0; x < a->width; x++)
            sum += flip_pixel(p, &row[0], &row[1], x);
    }
    for (int i = 0; i < 2; i++) {
        ring_free(&ring[i]);
        flip_row_free(&row[i]);
    }
    free(p);
    if (!ok)
        return fail(f, "out of memory (comparison)");
    *result = sum / ((double)a->width * (double)a->height);
    return true;
}

bool image_compare(const struct image *a, const struct image *b, double pixels_per_degree,
                   struct image_distance *out, struct failure *f)
{
    *out = (struct image_distance){0};
    if (!image_check_same_size(a, b, f))
        return false;
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000))
        return fail(f, "pixels per degree are outside 1..1000 (%g)", pixels_per_degree);
    double mse = mean_square_error(a, b);
    out->rmse = sqrt(mse);
    out->psnr = mse > 0 ? 10 * log10(255.0 * 255 / mse) : INFINITY;
    return mean_ssim(a, b, &out->ssim, f) && mean_flip(a, b, pixels_per_degree, &out->flip, f);
}
