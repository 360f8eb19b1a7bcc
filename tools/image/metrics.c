/* SPDX-License-Identifier: MIT */
/* metrics.c - how far one picture is from another: RMSE, PSNR, SSIM and LDR-FLIP.
 *
 * [Andersson20] "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
 * [Wang04] "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE TIP
 * 2004.
 *
 * Both SSIM and FLIP are convolutions with separable kernels. Pictures are gone through in bands of
 * columns. Rows of a band are convolved along x when the window of the column convolution first
 * needs them, and kept in a ring as high as the kernel, so memory grows with the radius only and
 * stays in the caches. Pixels that see no difference through their windows are known to be equal
 * and cost nothing. */
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

/* Columns of a band: its loops are of a fixed length, which compilers turn into wide steps. */
enum { BAND = 128 };

/* Rows of several planes of a band, convolved along x; row y lives in slot y modulo `slots`. */
struct ring {
    int width, height;          /* of the picture */
    int left;                   /* the band's first column */
    int radius, slots, planes, filled;          /* rows below `filled` have been made if needed */
    double *rows;               /* [slot][plane][BAND] */
    double wide[BAND + 2 * MAX_RADIUS];         /* one row with its margins */
};

static bool ring_alloc(struct ring *r, const struct image *image, int radius, int planes)
{
    *r = (struct ring){.width = image->width, .height = image->height, .radius = radius,
                       .slots = 2 * radius + 1, .planes = planes};
    r->rows = malloc((size_t)r->slots * (size_t)planes * BAND * sizeof *r->rows);
    return r->rows != NULL;
}

static void ring_begin_band(struct ring *r, int left)
{
    r->left = left;
    r->filled = 0;
}

/* A row of a plane; y outside the picture is clamped to its edge. */
static double *ring_row(const struct ring *r, int y, int plane)
{
    y = y < 0 ? 0 : y >= r->height ? r->height - 1 : y;
    size_t row = (size_t)(y % r->slots) * (size_t)r->planes + (size_t)plane;
    return r->rows + row * BAND;
}

/* How many columns of the picture the band has. */
static int ring_columns(const struct ring *r)
{
    return r->width - r->left < BAND ? r->width - r->left : BAND;
}

/* The columns of the picture that the band's windows see: the first and how many. */
static int ring_first_seen(const struct ring *r)
{
    return r->left > r->radius ? r->left - r->radius : 0;
}

static int ring_seen(const struct ring *r)
{
    int end = r->left + BAND + r->radius;
    return (end < r->width ? end : r->width) - ring_first_seen(r);
}

/* Where to put the values of a row that the windows see before convolving it. */
static double *ring_input(struct ring *r)
{
    return r->wide + r->radius - (r->left - ring_first_seen(r));
}

static void ring_clamp_input(struct ring *r)
{
    double *first = ring_input(r), *end = first + ring_seen(r);
    for (double *to = r->wide; to < first; to++)
        *to = *first;
    for (double *to = end; to < r->wide + BAND + 2 * r->radius; to++)
        *to = end[-1];
}

/* The same columns of the picture itself. */
static const uint8_t *ring_pixels(const struct ring *r, int y, const struct image *image)
{
    return image->rgba + ((size_t)y * (size_t)r->width + (size_t)ring_first_seen(r)) * 4;
}

/* The sum of the kernel's rows, each by its weight. Four are added at a time, in their order: sums
 * are fetched and stored less often, and come out the same. */
static void convolve(double *restrict to, const double *const *row, const struct kernel *k)
{
    int taps = 2 * k->radius + 1, i = 0;
    memset(to, 0, BAND * sizeof *to);
    for (; i + 4 <= taps; i += 4) {
        const double *a = row[i], *b = row[i + 1], *c = row[i + 2], *d = row[i + 3];
        const double *w = k->weight + i, wa = w[0], wb = w[1], wc = w[2], wd = w[3];
        for (int x = 0; x < BAND; x++)
            to[x] = to[x] + wa * a[x] + wb * b[x] + wc * c[x] + wd * d[x];
    }
    for (; i < taps; i++) {
        const double *a = row[i], wa = k->weight[i];
        for (int x = 0; x < BAND; x++)
            to[x] += wa * a[x];
    }
}

/* The clamped input convolved along x into row y of a plane. */
static void ring_convolve_x(struct ring *r, int y, int plane, const struct kernel *k)
{
    const double *row[MAX_TAPS];
    for (int i = -k->radius; i <= k->radius; i++)
        row[i + k->radius] = r->wide + r->radius + i;
    convolve(ring_row(r, y, plane), row, k);
}

/* A plane convolved along y, centred on row y. */
static void ring_convolve_y(const struct ring *r, int y, int plane, const struct kernel *k,
                            double *to)
{
    const double *row[MAX_TAPS];
    for (int i = -k->radius; i <= k->radius; i++)
        row[i + k->radius] = ring_row(r, y + i, plane);
    convolve(to, row, k);
}

/* Marks the rows whose pixels in the ring's band see a difference between the pictures. */
static void mark_rows(const struct ring *r, const struct image *a, const struct image *b,
                      uint8_t *marked)
{
    size_t size = (size_t)ring_seen(r) * 4;
    memset(marked, 0, (size_t)r->height);
    for (int y = 0; y < r->height; y++) {
        if (memcmp(ring_pixels(r, y, a), ring_pixels(r, y, b), size) == 0)
            continue;
        int from = y < r->radius ? 0 : y - r->radius;
        int to = r->height - y > r->radius ? y + r->radius : r->height - 1;
        memset(marked + from, 1, (size_t)(to - from) + 1);
    }
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

enum { SSIM_RADIUS = 5 };

/* Rec. 601 luma of codes, 0..1. */
static double luma(const uint8_t *rgba)
{
    return (0.299 * rgba[0] + 0.587 * rgba[1] + 0.114 * rgba[2]) / 255;
}

/* The lumas of a row that the band's windows see. */
static void ssim_luma_row(const struct ring *r, int y, const struct image *image, double *to)
{
    const uint8_t *from = ring_pixels(r, y, image);
    for (int i = 0; i < ring_seen(r); i++)
        to[i] = luma(from + i * 4);
}

/* Convolves row y of the five moments a, b, aa, bb, ab. */
static void ssim_fill_row(struct ring *r, int y, const struct image *a, const struct image *b,
                          const struct kernel *window)
{
    double one[BAND + 2 * SSIM_RADIUS], u[BAND + 2 * SSIM_RADIUS], v[BAND + 2 * SSIM_RADIUS];
    const double *const factor[5][2] = {{u, one}, {v, one}, {u, u}, {v, v}, {u, v}};
    int count = ring_seen(r);
    double *in = ring_input(r);
    ssim_luma_row(r, y, a, u);
    ssim_luma_row(r, y, b, v);
    for (int i = 0; i < count; i++)
        one[i] = 1;
    for (int plane = 0; plane < 5; plane++) {
        const double *p = factor[plane][0], *q = factor[plane][1];
        for (int i = 0; i < count; i++)
            in[i] = p[i] * q[i];
        ring_clamp_input(r);
        ring_convolve_x(r, y, plane, window);
    }
}

static double ssim_pixel(const double moment[5][BAND], int x)
{
    double mean_a = moment[0][x], mean_b = moment[1][x];
    double variance_a = moment[2][x] - mean_a * mean_a;
    double variance_b = moment[3][x] - mean_b * mean_b;
    double covariance = moment[4][x] - mean_a * mean_b;
    double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
}

/* The sum over columns `begin` to `end` - 1 of the band in rows border .. height - border - 1. */
static double ssim_band(struct ring *r, const struct image *a, const struct image *b,
                        const struct kernel *window, const uint8_t *marked, int begin, int end,
                        int border)
{
    double sum = 0, moment[5][BAND];
    for (int y = border; y < r->height - border; y++) {
        if (!marked[y]) {
            sum += end - begin;
            continue;
        }
        for (r->filled = ring_next_row(r, y); r->filled < r->height && r->filled <= y + SSIM_RADIUS;
             r->filled++)
            ssim_fill_row(r, r->filled, a, b, window);
        for (int plane = 0; plane < 5; plane++)
            ring_convolve_y(r, y, plane, window, moment[plane]);
        for (int x = begin; x < end; x++)
            sum += ssim_pixel(moment, x);
    }
    return sum;
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
    uint8_t *marked = malloc((size_t)a->height);
    bool ok = ring_alloc(&r, a, SSIM_RADIUS, 5) && marked != NULL;
    int border_x = a->width > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    int border_y = a->height > 2 * SSIM_RADIUS ? SSIM_RADIUS : 0;
    double sum = 0;
    for (int left = 0; ok && left < a->width; left += BAND) {
        ring_begin_band(&r, left);
        mark_rows(&r, a, b, marked);
        int begin = left == 0 ? border_x : 0, inside = a->width - border_x - left;
        int end = inside < BAND ? inside : BAND;
        if (begin < end)
            sum += ssim_band(&r, a, b, &window, marked, begin, end, border_y);
    }
    free(r.rows);
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

/* Cube roots from 1/128 up: by the upper bits of a number, one near it. */
enum { ROOT_BITS = 8, ROOTS = 8 << ROOT_BITS };

struct root {
    double of, inverse;         /* the root of a number, and 1 by the number */
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
    struct root root[ROOTS];
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
    struct color xyz = {white[0] / white[1], 1, (1 - white[0] - white[1]) / white[1]};
    double by[3] = {1 / xyz.x, 1 / xyz.y, 1 / xyz.z};   /* white becomes (1, 1, 1) */
    invert(columns, inverse);
    struct color scale = transform((const double(*)[3])inverse, xyz);
    for (int row = 0; row < 3; row++) {
        p->rgb_to_xyz[row][0] = columns[row][0] * scale.x * by[row];
        p->rgb_to_xyz[row][1] = columns[row][1] * scale.y * by[row];
        p->rgb_to_xyz[row][2] = columns[row][2] * scale.z * by[row];
    }
    invert(p->rgb_to_xyz, p->xyz_to_rgb);
}

/* The opponent space that is linear in light, so that averages mean something. */
static struct color rgb_to_ycxcz(const struct flip *p, struct color rgb)
{
    struct color c = transform((const double(*)[3])p->rgb_to_xyz, rgb);
    return (struct color){116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)};
}

static double clamp01(double v)
{
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

static struct color ycxcz_to_rgb(const struct flip *p, struct color c)
{
    double y = (c.x + 16) / 116, x = y + c.y / 500, z = y - c.z / 200;
    struct color rgb = transform((const double(*)[3])p->xyz_to_rgb, (struct color){x, y, z});
    return (struct color){clamp01(rgb.x), clamp01(rgb.y), clamp01(rgb.z)};
}

static uint64_t bits_of(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

/* The entry of a number from 1/128 to 2: the lower part of its exponent and the top of its
 * fraction. */
static size_t root_entry(double t)
{
    return (bits_of(t) - bits_of(1.0 / 128)) >> (52 - ROOT_BITS);
}

static void fill_roots(struct root *root)
{
    for (int i = 0; i < ROOTS; i++) {
        int steps = 1 << ROOT_BITS;
        double middle = ldexp((i % steps + 0.5) / steps + 1, i / steps - 7);
        root[i] = (struct root){cbrt(middle), 1 / middle};
    }
}

/* The cube root of a number from 1/128 to 2, right to 15 digits: that of one nearby times that of
 * the ratio of the two, by its series. The library's takes five times as long. */
static double cube_root(const struct root *root, double t)
{
    const struct root *near = root + root_entry(t);
    double r = t * near->inverse - 1;           /* within 1/512 of 0 */
    double series = r * (1.0 / 3 - r * (1.0 / 9 - r * (5.0 / 81 - r * (10.0 / 243))));
    return near->of + near->of * series;
}

static inline double lab_curve(const struct flip *p, double t)
{
    double knee = 6.0 / 29;
    return t > knee * knee * knee ? cube_root(p->root, t) : t / (3 * knee * knee) + 4.0 / 29;
}

/* L*a*b* with the chroma of dark colours reduced (Hunt effect). */
static struct color rgb_to_hunt_lab(const struct flip *p, struct color rgb)
{
    struct color c = transform((const double(*)[3])p->rgb_to_xyz, rgb);
    double x = lab_curve(p, c.x), y = lab_curve(p, c.y), z = lab_curve(p, c.z);
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
    flip_color_matrices(p);
    fill_roots(p->root);

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

/* What FLIP compares at each pixel of a row of a band. */
struct flip_row {
    struct color lab[BAND];
    double edge[BAND], point[BAND];     /* lengths of the two detectors' gradients */
};

static void flip_fill_row(const struct flip *p, struct ring *r, int y, const struct image *image)
{
    struct color row[BAND + 2 * MAX_RADIUS];
    const uint8_t *from = ring_pixels(r, y, image);
    double *in = ring_input(r);
    int count = ring_seen(r);
    for (int i = 0; i < count; i++, from += 4)
        row[i] = rgb_to_ycxcz(p, (struct color){p->linear[from[0]], p->linear[from[1]],
                                                 p->linear[from[2]]});
    for (int i = 0; i < count; i++)
        in[i] = row[i].y;
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_CX, &p->cx);
    for (int i = 0; i < count; i++)
        in[i] = row[i].z;
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_CZ1, &p->cz1);
    ring_convolve_x(r, y, PLANE_CZ2, &p->cz2);
    for (int i = 0; i < count; i++)
        in[i] = row[i].x;
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_Y, &p->y);
    for (int i = 0; i < count; i++)
        in[i] = (row[i].x + 16) / 116;          /* 0..1 for the feature detectors */
    ring_clamp_input(r);
    ring_convolve_x(r, y, PLANE_SMOOTH, &p->smooth);
    ring_convolve_x(r, y, PLANE_EDGE, &p->edge);
    ring_convolve_x(r, y, PLANE_POINT, &p->point);
}

static void flip_finish_row(const struct flip *p, const struct ring *r, int y, struct flip_row *out)
{
    double s0[BAND], s1[BAND], s2[BAND], s3[BAND];
    ring_convolve_y(r, y, PLANE_Y, &p->y, s0);
    ring_convolve_y(r, y, PLANE_CX, &p->cx, s1);
    ring_convolve_y(r, y, PLANE_CZ1, &p->cz1, s2);
    ring_convolve_y(r, y, PLANE_CZ2, &p->cz2, s3);
    for (int x = 0; x < ring_columns(r); x++) {
        double cz = p->cz1_share * s2[x] + p->cz2_share * s3[x];
        out->lab[x] = rgb_to_hunt_lab(p, ycxcz_to_rgb(p, (struct color){s0[x], s1[x], cz}));
    }
    ring_convolve_y(r, y, PLANE_EDGE, &p->smooth, s0);
    ring_convolve_y(r, y, PLANE_SMOOTH, &p->edge, s1);
    ring_convolve_y(r, y, PLANE_POINT, &p->smooth, s2);
    ring_convolve_y(r, y, PLANE_SMOOTH, &p->point, s3);
    for (int x = 0; x < BAND; x++) {
        out->edge[x] = length(s0[x], s1[x]);
        out->point[x] = length(s2[x], s3[x]);
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

/* The sum over the band that both rings are at. */
static double flip_band(const struct flip *p, struct ring ring[2],
                        const struct image *const image[2], const uint8_t *marked)
{
    struct flip_row row[2];
    double sum = 0;
    for (int y = 0; y < ring->height; y++) {
        if (!marked[y])
            continue;
        for (int i = 0; i < 2; i++) {
            struct ring *r = ring + i;
            for (r->filled = ring_next_row(r, y); r->filled < r->height && r->filled <= y + p->radius;
                 r->filled++)
                flip_fill_row(p, r, r->filled, image[i]);
            flip_finish_row(p, r, y, &row[i]);
        }
        for (int x = 0; x < ring_columns(ring); x++)
            sum += flip_pixel(p, &row[0], &row[1], x);
    }
    return sum;
}

static bool mean_flip(const struct image *a, const struct image *b, double pixels_per_degree,
                      double *result, struct failure *f)
{
    const struct image *const image[2] = {a, b};
    struct ring ring[2] = {{0}, {0}};
    struct flip *p = malloc(sizeof *p);
    uint8_t *marked = malloc((size_t)a->height);
    bool ok = p != NULL && marked != NULL;
    if (ok)
        flip_prepare(p, pixels_per_degree);
    for (int i = 0; ok && i < 2; i++)
        ok = ring_alloc(&ring[i], a, p->radius, FLIP_PLANES);
    double sum = 0;
    for (int left = 0; ok && left < a->width; left += BAND) {
        ring_begin_band(&ring[0], left);
        ring_begin_band(&ring[1], left);
        mark_rows(&ring[0], a, b, marked);
        sum += flip_band(p, ring, image, marked);
    }
    free(ring[0].rows);
    free(ring[1].rows);
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
