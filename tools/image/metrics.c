/* SPDX-License-Identifier: MIT */
/* metrics.c - how far one picture is from another: RMSE, PSNR, SSIM and LDR-FLIP.
 *
 * [Andersson20] "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
 * [Wang04] "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE TIP
 * 2004.
 *
 * Both SSIM and FLIP are convolutions with separable kernels. Rows are convolved along x when the
 * window of the column convolution first needs them, and kept in a ring as high as the kernel, so
 * memory grows with the radius only. Rows that see no difference through their windows are known to
 * be equal and cost nothing. */
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
    int width, height;          /* of the picture */
    int radius, slots, planes, filled;          /* rows below `filled` have been made if needed */
    double *rows;               /* [slot][plane][width] */
    double *lines;              /* of `width` values each, for who fills and reads the ring */
    double *wide;               /* one row with its margins */
};

static bool ring_alloc(struct ring *r, const struct image *image, int radius, int planes, int lines)
{
    const size_t width = (size_t)image->width;
    *r = (struct ring){.width = image->width, .height = image->height, .radius = radius,
                       .slots = 2 * radius + 1, .planes = planes};
    r->rows = malloc((size_t)r->slots * (size_t)planes * width * sizeof *r->rows);
    r->lines = malloc((size_t)lines * width * sizeof *r->lines);
    r->wide = malloc((width + 2 * (size_t)radius) * sizeof *r->wide);
    return r->rows != NULL && r->lines != NULL && r->wide != NULL;
}

static void ring_free(struct ring *r)
{
    free(r->rows);
    free(r->lines);
    free(r->wide);
}

static double *ring_line(const struct ring *r, int line)
{
    return r->lines + (size_t)line * (size_t)r->width;
}

/* A row of a plane; y outside the picture is clamped to its edge. */
static double *ring_row(const struct ring *r, int y, int plane)
{
    y = y < 0 ? 0 : y >= r->height ? r->height - 1 : y;
    return r->rows + ((size_t)(y % r->slots) * (size_t)r->planes + (size_t)plane) * (size_t)r->width;
}

/* The next row to be convolved; its edges are repeated. */
static void ring_input(struct ring *r, const double *values)
{
    memcpy(r->wide + r->radius, values, (size_t)r->width * sizeof *values);
    for (int i = 0; i < r->radius; i++) {
        r->wide[i] = values[0];
        r->wide[r->radius + r->width + i] = values[r->width - 1];
    }
}

static const uint8_t *pixels_of(const struct image *image, int y)
{
    return image->rgba + (size_t)y * (size_t)image->width * 4;
}

/* The sum of the kernel's rows, each by its weight. Four are added at a time, in their order: sums
 * are fetched and stored less often, and come out the same. */
static void convolve(double *restrict to, int width, const double *const *row, const struct kernel *k)
{
    int taps = 2 * k->radius + 1, i = 0;
    memset(to, 0, (size_t)width * sizeof *to);
    for (; i + 4 <= taps; i += 4) {
        const double *a = row[i], *b = row[i + 1], *c = row[i + 2], *d = row[i + 3];
        const double *w = k->weight + i, wa = w[0], wb = w[1], wc = w[2], wd = w[3];
        for (int x = 0; x < width; x++)
            to[x] = to[x] + wa * a[x] + wb * b[x] + wc * c[x] + wd * d[x];
    }
    for (; i < taps; i++) {
        const double *a = row[i], wa = k->weight[i];
        for (int x = 0; x < width; x++)
            to[x] += wa * a[x];
    }
}

/* The input convolved along x into row y of a plane. */
static void ring_convolve_x(struct ring *r, int y, int plane, const struct kernel *k)
{
    const double *row[MAX_TAPS];
    for (int i = -k->radius; i <= k->radius; i++)
        row[i + k->radius] = r->wide + r->radius + i;
    convolve(ring_row(r, y, plane), r->width, row, k);
}

/* A plane convolved along y, centred on row y. */
static void ring_convolve_y(const struct ring *r, int y, int plane, const struct kernel *k, double *to)
{
    const double *row[MAX_TAPS];
    for (int i = -k->radius; i <= k->radius; i++)
        row[i + k->radius] = ring_row(r, y + i, plane);
    convolve(to, r->width, row, k);
}

/* Marks the rows whose pixels see a difference between the pictures; malloc'ed. */
static uint8_t *mark_rows(const struct image *a, const struct image *b, int radius)
{
    uint8_t *marked = calloc((size_t)a->height, 1);
    for (int y = 0; y < a->height && marked != NULL; y++) {
        if (memcmp(pixels_of(a, y), pixels_of(b, y), (size_t)a->width * 4) == 0)
            continue;
        int from = y < radius ? 0 : y - radius, to = a->height - y > radius ? y + radius : a->height - 1;
        memset(marked + from, 1, (size_t)(to - from) + 1);
    }
    return marked;
}

/* The first row that row y needs and the ring has not got; the next ones follow. */
static int ring_next_row(const struct ring *r, int y)
{
    return r->filled > y - r->radius ? r->filled : y - r->radius;
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

enum { SSIM_RADIUS = 5, MOMENTS = 5 };      /* lines: of each moment, then both lumas and a product */
enum { LINE_A = MOMENTS, LINE_B, LINE_PRODUCT, SSIM_LINES };

/* Rec. 601 luma of codes, 0..1. */
static void luma_row(const struct image *image, int y, double *to)
{
    const uint8_t *p = pixels_of(image, y);
    for (int x = 0; x < image->width; x++, p += 4)
        to[x] = (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255;
}

/* Convolves row y of the five moments a, b, aa, bb, ab. */
static void ssim_fill_row(struct ring *r, int y, const struct image *a, const struct image *b,
                          const struct kernel *window)
{
    double *u = ring_line(r, LINE_A), *v = ring_line(r, LINE_B), *product = ring_line(r, LINE_PRODUCT);
    const double *const factor[MOMENTS][2] = {{u, NULL}, {v, NULL}, {u, u}, {v, v}, {u, v}};
    luma_row(a, y, u);
    luma_row(b, y, v);
    for (int plane = 0; plane < MOMENTS; plane++) {
        const double *p = factor[plane][0], *q = factor[plane][1];
        for (int x = 0; x < r->width && q != NULL; x++)
            product[x] = p[x] * q[x];
        ring_input(r, q != NULL ? product : p);
        ring_convolve_x(r, y, plane, window);
    }
}

static double ssim_pixel(const struct ring *r, int x)
{
    double moment[MOMENTS];
    for (int i = 0; i < MOMENTS; i++)
        moment[i] = ring_line(r, i)[x];
    double mean_a = moment[0], mean_b = moment[1];
    double variance_a = moment[2] - mean_a * mean_a;
    double variance_b = moment[3] - mean_b * mean_b;
    double covariance = moment[4] - mean_a * mean_b;
    double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
}

/* Mean over the windows that lie inside the picture, as in [Wang04]; along an edge shorter than a
 * window over all pixels, with the picture's edge repeated. */
static bool mean_ssim(const struct image *a, const struct image *b, double *result,
                      struct failure *f)
{
    struct kernel window = {.radius = SSIM_RADIUS};
    double total = 0, sum = 0;
    for (int i = -SSIM_RADIUS; i <= SSIM_RADIUS; i++)
        total += window.weight[i + SSIM_RADIUS] = exp(-i * i / (2 * 1.5 * 1.5));
    for (int i = 0; i <= 2 * SSIM_RADIUS; i++)
        window.weight[i] /= total;

    struct ring r;
    uint8_t *marked = mark_rows(a, b, SSIM_RADIUS);
    bool ok = ring_alloc(&r, a, SSIM_RADIUS, MOMENTS, SSIM_LINES) && marked != NULL;
    int border_x = a->width > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    int border_y = a->height > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    for (int y = border_y; ok && y < a->height - border_y; y++) {
        if (!marked[y]) {
            sum += a->width - 2 * border_x;
            continue;
        }
        for (r.filled = ring_next_row(&r, y); r.filled < r.height && r.filled <= y + SSIM_RADIUS; r.filled++)
            ssim_fill_row(&r, r.filled, a, b, &window);
        for (int plane = 0; plane < MOMENTS; plane++)
            ring_convolve_y(&r, y, plane, &window, ring_line(&r, plane));
        for (int x = border_x; x < a->width - border_x; x++)
            sum += ssim_pixel(&r, x);
    }
    ring_free(&r);
    free(marked);
    if (!ok)
        return fail(f, "out of memory (comparison)");
    *result = sum / ((double)(a->width - 2 * border_x) * (double)(a->height - 2 * border_y));
    return true;
}

/* --- LDR-FLIP --- */

struct color {
    double x, y, z;             /* RGB, XYZ with white at 1, YCxCz or L*a*b* */
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
    struct kernel y, cx, cz1, cz2;
    double cz1_share, cz2_share;
    struct kernel smooth, edge, point;
    int radius;                 /* of the largest kernel */
    double max_color_difference;
};

static inline struct color transform(const double m[3][3], struct color c)
{
    return (struct color){
        m[0][0] * c.x + m[0][1] * c.y + m[0][2] * c.z,
        m[1][0] * c.x + m[1][1] * c.y + m[1][2] * c.z,
        m[2][0] * c.x + m[2][1] * c.y + m[2][2] * c.z,
    };
}

/* Of sRGB with its white, D65, at (1, 1, 1): from the chromaticities of its primaries and of white with the five digits that
 * FLIP is defined with. */
static const double rgb_to_xyz[3][3] = {
    {0.43389538883150308, 0.37624237262225113, 0.18986223854624576},
    {0.21263682167732384, 0.71518298184125073, 0.072180196481425457},
    {0.01775242315172991, 0.10946562866246512, 0.8727819481858049},
};
static const double xyz_to_rgb[3][3] = {
    {3.0803419882804604, -1.5373989694887853, -0.54294301879167495},
    {-0.92117839616512331, 1.8759299836951757, 0.04524841246994759},
    {0.052881292875543287, -0.20401120612390994, 1.1511299132483668},
};

/* The opponent space that is linear in light, so that averages mean something. */
static struct color rgb_to_ycxcz(struct color rgb)
{
    struct color c = transform(rgb_to_xyz, rgb);
    return (struct color){116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)};
}

static double clamp01(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

static struct color ycxcz_to_rgb(struct color c)
{
    double y = (c.x + 16) / 116, x = y + c.y / 500, z = y - c.z / 200;
    struct color rgb = transform(xyz_to_rgb, (struct color){x, y, z});
    return (struct color){clamp01(rgb.x), clamp01(rgb.y), clamp01(rgb.z)};
}

static inline double lab_curve(double t)
{
    double knee = 6.0 / 29;
    return t > knee * knee * knee ? cbrt(t) : t / (3 * knee * knee) + 4.0 / 29;
}

/* L*a*b* with the chroma of dark colours reduced (Hunt effect). */
static struct color rgb_to_hunt_lab(struct color rgb)
{
    struct color c = transform(rgb_to_xyz, rgb);
    double x = lab_curve(c.x), y = lab_curve(c.y), z = lab_curve(c.z);
    double lightness = 116 * y - 16;
    return (struct color){lightness, 0.01 * lightness * 500 * (x - y),
                          0.01 * lightness * 200 * (y - z)};
}

/* hypot() is slow: it minds numbers far larger and smaller than those here. */
static double length(double x, double y)
{
    return sqrt(x * x + y * y);
}

/* HyAB to the power 0.7. */
static double color_distance(struct color a, struct color b)
{
    return pow(fabs(a.x - b.x) + length(a.y - b.y, a.z - b.z), 0.7);
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

    p->max_color_difference = color_distance(rgb_to_hunt_lab((struct color){0, 1, 0}),
                                             rgb_to_hunt_lab((struct color){0, 0, 1}));
}

/* Of each picture: what comes in, what FLIP compares at each pixel of a row (the colour, and the lengths of the two detectors'
 * gradients), and sums. */
enum flip_line { LINE_Y, LINE_CX, LINE_CZ, LINE_L, LINE_LA, LINE_LB, LINE_EDGE, LINE_POINT, LINE_S0, LINE_S1, LINE_S2, LINE_S3,
                 FLIP_LINES };

static void flip_fill_row(const struct flip *p, struct ring *r, int y, const struct image *image)
{
    double *light = ring_line(r, LINE_Y), *cx = ring_line(r, LINE_CX), *cz = ring_line(r, LINE_CZ);
    const uint8_t *from = pixels_of(image, y);
    for (int x = 0; x < r->width; x++, from += 4) {
        struct color c = rgb_to_ycxcz((struct color){p->linear[from[0]], p->linear[from[1]], p->linear[from[2]]});
        light[x] = c.x;
        cx[x] = c.y;
        cz[x] = c.z;
    }
    ring_input(r, cx);
    ring_convolve_x(r, y, PLANE_CX, &p->cx);
    ring_input(r, cz);
    ring_convolve_x(r, y, PLANE_CZ1, &p->cz1);
    ring_convolve_x(r, y, PLANE_CZ2, &p->cz2);
    ring_input(r, light);
    ring_convolve_x(r, y, PLANE_Y, &p->y);
    for (int x = 0; x < r->width; x++)
        light[x] = (light[x] + 16) / 116;       /* 0..1 for the feature detectors */
    ring_input(r, light);
    ring_convolve_x(r, y, PLANE_SMOOTH, &p->smooth);
    ring_convolve_x(r, y, PLANE_EDGE, &p->edge);
    ring_convolve_x(r, y, PLANE_POINT, &p->point);
}

static void flip_finish_row(const struct flip *p, const struct ring *r, int y)
{
    double *s0 = ring_line(r, LINE_S0), *s1 = ring_line(r, LINE_S1), *s2 = ring_line(r, LINE_S2), *s3 = ring_line(r, LINE_S3);
    ring_convolve_y(r, y, PLANE_Y, &p->y, s0);
    ring_convolve_y(r, y, PLANE_CX, &p->cx, s1);
    ring_convolve_y(r, y, PLANE_CZ1, &p->cz1, s2);
    ring_convolve_y(r, y, PLANE_CZ2, &p->cz2, s3);
    for (int x = 0; x < r->width; x++) {
        double cz = p->cz1_share * s2[x] + p->cz2_share * s3[x];
        struct color lab = rgb_to_hunt_lab(ycxcz_to_rgb((struct color){s0[x], s1[x], cz}));
        ring_line(r, LINE_L)[x] = lab.x;
        ring_line(r, LINE_LA)[x] = lab.y;
        ring_line(r, LINE_LB)[x] = lab.z;
    }
    ring_convolve_y(r, y, PLANE_EDGE, &p->smooth, s0);
    ring_convolve_y(r, y, PLANE_SMOOTH, &p->edge, s1);
    ring_convolve_y(r, y, PLANE_POINT, &p->smooth, s2);
    ring_convolve_y(r, y, PLANE_SMOOTH, &p->point, s3);
    for (int x = 0; x < r->width; x++) {
        ring_line(r, LINE_EDGE)[x] = length(s0[x], s1[x]);
        ring_line(r, LINE_POINT)[x] = length(s2[x], s3[x]);
    }
}

static struct color lab_at(const struct ring *r, int x)
{
    return (struct color){ring_line(r, LINE_L)[x], ring_line(r, LINE_LA)[x], ring_line(r, LINE_LB)[x]};
}

static double flip_pixel(const struct flip *p, const struct ring *a, const struct ring *b, int x)
{
    /* Colour: up to 0.4 of the largest difference onto 0..0.95, the rest onto 0.95..1. */
    double knee = 0.4 * p->max_color_difference;
    double color = color_distance(lab_at(a, x), lab_at(b, x));
    if (color < knee)
        color *= 0.95 / knee;
    else
        color = 0.95 + (color - knee) / (p->max_color_difference - knee) * 0.05;
    double edge = fabs(ring_line(a, LINE_EDGE)[x] - ring_line(b, LINE_EDGE)[x]);
    double point = fabs(ring_line(a, LINE_POINT)[x] - ring_line(b, LINE_POINT)[x]);
    double feature = sqrt((edge > point ? edge : point) / sqrt(2));
    return color > 0 ? pow(color, feature < 1 ? 1 - feature : 0) : 0;
}

static bool mean_flip(const struct image *a, const struct image *b, double pixels_per_degree,
                      double *result, struct failure *f)
{
    const struct image *const image[2] = {a, b};
    struct ring ring[2] = {{0}, {0}};
    struct flip *p = malloc(sizeof *p);
    uint8_t *marked = NULL;
    bool ok = p != NULL;
    double sum = 0;
    if (ok) {
        flip_prepare(p, pixels_per_degree);
        ok = (marked = mark_rows(a, b, p->radius)) != NULL;
    }
    for (int i = 0; ok && i < 2; i++)
        ok = ring_alloc(&ring[i], a, p->radius, FLIP_PLANES, FLIP_LINES);
    for (int y = 0; ok && y < a->height; y++) {
        if (!marked[y])
            continue;
        for (int i = 0; i < 2; i++) {
            struct ring *r = ring + i;
            for (r->filled = ring_next_row(r, y); r->filled < r->height && r->filled <= y + p->radius; r->filled++)
                flip_fill_row(p, r, r->filled, image[i]);
            flip_finish_row(p, r, y);
        }
        for (int x = 0; x < a->width; x++)
            sum += flip_pixel(p, &ring[0], &ring[1], x);
    }
    ring_free(&ring[0]);
    ring_free(&ring[1]);
    free(marked);
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
