/* SPDX-License-Identifier: MIT */
/* sky.c - a gradient by elevation.
 *
 * The way up of the ray through a pixel, whose way forward is one, is a plane on the screen, `rise`, at each instant; divided by the
 * ray's length it is the sine of the elevation, of which colours are linear. So the mean over the exposure is that of the mean plane;
 * only where the horizon passes, both halves are mixed by the time for which each is seen.
 *
 *     for some pixel rows, as many as look alike, and every few columns
 *         the elevation, of both ends
 *         runs of pixels of one colour between them: as few as do not show
 *         or, where the horizon passes, each row by itself, and each run by its own plane */
#include "display/sky.h"

#include "base/fixmath.h"
#include "kernels/fill.h"

#if SMEAR_WITH_SKY

enum { RISE, RISE_X, RISE_Y,            /* q22: in the frame's centre, and per half pixel to the right and up */
       SWEEP, SWEEP_X, SWEEP_Y,         /* that at shutter close less that at shutter open */
       STEP,                            /* of the ray per half pixel, q24 */
       WIDTH, HEIGHT, TRANSFER,
       ROWS, SPAN_LOG2,                 /* rows that look alike, and columns from one point to the next */
       HALVES,                          /* struct half, up and down */
       PART_ONE = 4096, NO_COLOR = -1,
       ROWS_MOST = 8, SPAN_LEAST = 3, SPAN_MOST = 7 };

/* ------------------------------------------------------------------ where the camera looks */

/* Returns by how much of its way forward a ray goes aside from one half pixel to the next, q24: 1 / (height x focal). */
static int32_t step_of(const smear_camera *camera, int32_t width, int32_t height)
{
    const uint64_t x = (uint64_t)(uint32_t)height * (uint32_t)camera->focal;
    if (camera->half_height > 0 || x == 0)
        return 0;
    const int zeros = count_leading_zeros_64(x), shift = 53 - zeros;
    const uint64_t step = ((uint64_t)recip_norm_precise((uint32_t)(x << zeros >> 32)) << 10) >> (shift + 10);
    /* Half pixels of points beside the frame, by a span of its width or of eight pixels at most, times that have 31 bits. */
    const uint64_t most = (1u << 30) / (3u * (uint32_t)max_i32(width, height) + 16u);
    return (int32_t)(step < most ? step : most);
}

static void find_plane(int32_t plane[3], const struct smear_shot *shot, const int32_t weight[3], int32_t width)
{
    int64_t sum[3] = { 0, 0, 0 };
    for (int k = 0; k < 3; k++) {
        const int32_t *up = &shot->camera[k].pose.basis[3];
        const int64_t step = weight[k] != 0 ? step_of(&shot->camera[k], width, shot->height) : 0;
        sum[0] -= mul_wide(up[2], weight[k]);
        sum[1] += (up[0] * step >> 24) * weight[k];
        sum[2] += (up[1] * step >> 24) * weight[k];
    }
    /* Sums of the three stay within 2^30: more is no picture any more. */
    for (int i = 0; i < 3; i++) {
        const int32_t most = i == 0 ? 1 << 29 : (1 << 27) / max_i32(width, shot->height);
        plane[i] = clamp_i32(narrow_sat(sum[i] >> 26), -most, most);
    }
}

/* Returns the most that a channel changes by. */
static int32_t contrast_of(uint32_t a, uint32_t b)
{
    int32_t most = 0;
    for (int i = 0; i < 24; i += 8)
        most = max_i32(most, abs_i32((int32_t)(a >> i & 255u) - (int32_t)(b >> i & 255u)));
    return most;
}

/* A half of the sky: the colour at the horizon and what leads to the pole, as two words of channels. */
struct half {
    uint32_t pair, green, pair_step, green_step;
    int32_t contrast;
};

static void take_half(struct half *h, uint32_t horizon, uint32_t pole)
{
    h->pair = ((horizon & 0xff00ffu) << 8) + 0x800080u;
    h->green = (horizon & 0xff00u) + 0x80u;
    h->pair_step = (pole & 0xff00ffu) - (horizon & 0xff00ffu);
    h->green_step = pixel_green(pole) - pixel_green(horizon);
    h->contrast = contrast_of(horizon, pole);
}

static void aim(smear_sky *sky, const struct smear_shot *shot, const struct smear_instant *instant, int32_t width, smear_transfer transfer)
{
    static const int32_t none[3] = { 0, 0, 0 };
    const struct smear_instant open = smear_instant_at(shot, -65536), close = smear_instant_at(shot, 65536);
    struct smear_instant mean = instant != NULL ? *instant : smear_instant_middle(shot);
    int32_t sweep[3];
    for (int i = 0; i < 3; i++) {
        sweep[i] = close.weight[i] - open.weight[i];
        if (instant == NULL && shot_spans_exposure(shot))
            mean.weight[i] += ((open.weight[i] - mean.weight[i]) / 2 + (close.weight[i] - mean.weight[i]) / 2) / 3;
    }
    find_plane(&sky->own[RISE], shot, mean.weight, width);
    find_plane(&sky->own[SWEEP], shot, instant != NULL ? none : sweep, width);
    sky->own[STEP] = step_of(&shot->camera[0], width, shot->height);
    sky->own[WIDTH] = width;
    sky->own[HEIGHT] = shot->height;
    sky->own[TRANSFER] = transfer;
    /* Rows that differ by two codes look alike; between points, sines err by some 0.1 of the square of their distance. */
    struct half half[2];
    take_half(&half[0], sky->horizon, sky->zenith);
    take_half(&half[1], sky->ground, sky->nadir);
    const uint32_t contrast = (uint32_t)max_i32(half[0].contrast, half[1].contrast),
                   pixel = min_u32((uint32_t)sky->own[STEP] >> 3, 1u << 20);        /* q20 */
    int rows = 0, span = SPAN_LEAST;
    while (1 << rows < ROWS_MOST && contrast * pixel << (rows + 1) <= 4u << 20)
        rows++;
    for (uint32_t wide = pixel << (SPAN_LEAST + 1) >> 8; span < SPAN_MOST && 2 << span <= width && wide < 1u << 12; wide *= 2) {
        if (contrast * (wide * wide >> 12) > 12u << 12)
            break;
        span++;
    }
    sky->own[ROWS] = 1 << rows;
    sky->own[SPAN_LOG2] = span;
    __builtin_memcpy(&sky->own[HALVES], half, sizeof half);
}

/* ------------------------------------------------------------------ pixels */

struct pen {
    const smear_sky *sky;
    const struct smear_raster_target *target;
    struct half half[2];                /* up, down */
    int32_t rise, sweep;                /* q22, of the row in the frame's middle column */
    int32_t square;                     /* of the ray's way forward and up, q16 */
    int32_t pixel;                      /* rise from a pixel to the next */
    int32_t at, stride;                 /* where the rows lie that are filled at once, so many: */
    int rows, span_log2;                /* log2 of columns between points */
    int even[2];                        /* log2 of sines that look alike: less than two codes apart */
    int32_t from;                       /* where the run begins that is not filled yet, of this colour: of a sine, shifted */
    uint32_t color;
    int32_t level;                      /* or -1 */
};

/* What is known of a point. */
struct point {
    int32_t rise, width;                /* q22: its way up, and how much of that passes during the exposure */
    int32_t inverse;                    /* of the ray's length, q15 */
    int32_t sine;                       /* of the elevation, q8, whatever its sign */
};

/* Returns 1 / sqrt(n), q15, for n of 1 or more, q16: within 1/600. */
static int32_t inverse_root(uint32_t n)
{
    static const uint16_t table[] = { 32768, 30894, 29309, 27945, 26755, 25705, 24770, 23930, 23170, 22479, 21845, 21263, 20724,
                                      20225, 19760, 19326, 18919, 18536, 18176, 17837, 17515, 17211, 16921, 16646, 16384, 16134 };
    int shift = 0;
    for (; n >= 4u << 16; n >>= 2)
        shift++;
    const uint32_t at = (n - 65536u) >> 13, part = n >> 5 & 255u;
    return (int32_t)(table[at] - ((uint32_t)(table[at] - table[at + 1]) * part >> 8)) >> shift;
}

static void begin_row(struct pen *p, int32_t v)
{
    const int32_t *own = p->sky->own;
    const int32_t y = clamp_i32(v * own[STEP] >> 12, -45000, 45000);
    p->rise = own[RISE] + v * own[RISE_Y];
    p->sweep = own[SWEEP] + v * own[SWEEP_Y];
    p->square = (y * y >> 8) + 65536;
}

/* Returns the sine of an elevation, q8, whatever its sign. */
static int32_t sine_of(int32_t rise, int32_t inverse)
{
    return min_i32(abs_i32(clamp_i32(rise >> 10, -65535, 65535) * inverse) >> 19, 256);
}

static void find_point(struct point *out, const struct pen *p, int32_t u)
{
    const int32_t *own = p->sky->own;
    const int32_t x = clamp_i32(u * own[STEP] >> 12, -45000, 45000);
    out->rise = p->rise + u * own[RISE_X];
    out->width = max_i32(abs_i32(p->sweep + u * own[SWEEP_X]), p->pixel);
    out->inverse = inverse_root((uint32_t)((x * x >> 8) + p->square));
    out->sine = sine_of(out->rise, out->inverse);
}

/* Goes on with another colour from a column on: fills what was before it in each row, as far as it is the target's, or in all rows at
 * once where they lie one behind the other. */
static SMEAR_NOINLINE void begin_run(struct pen *p, int32_t x, uint32_t color)
{
    const uint32_t value = p->color;
    p->level = -1;
    if (color == value)
        return;
    const struct smear_raster_target *t = p->target;
    const int32_t x0 = max_i32(p->from, t->x0), x1 = min_i32(x, t->x1), stride = p->stride, at = p->at + x0;
    int32_t n = x1 - x0;
    int rows = p->rows;
    p->from = x;
    p->color = color;
    if (n <= 0)
        return;
    if (n == stride) {
        n *= rows;
        rows = 1;
    }
    if (target_is_direct(t))
        for (uint16_t *to = t->direct + at; rows > 0; rows--, to += stride)
            pixels_fill_narrow(to, rgb565_nearest(value), n);
    else
        for (uint32_t *to = t->color + at; rows > 0; rows--, to += stride)
            pixels_fill(to, value, n);
}

/* Returns how many times a span is halved so that what changes by so many codes along it does so by two in each part. */
static int halvings(const struct pen *p, int32_t codes)
{
    int log = 0;
    while (log < p->span_log2 && codes > 2 << log)
        log++;
    return log;
}

/* Returns the colour of a sine, which may lie beyond the pole. */
static uint32_t color_of(const struct half *h, int32_t sine)
{
    sine = min_i32(sine, 256);
    return ((h->pair + (uint32_t)sine * h->pair_step) >> 8 & 0xff00ffu) | ((h->green + (uint32_t)sine * h->green_step) & 0xff00u);
}

/* Fills a span of rows, all of it on one side of the horizon. */
static void fill_span(struct pen *p, const struct point *a, const struct point *b, int32_t x)
{
    const int below = a->rise < 0, even = p->even[below];
    const struct half *h = &p->half[below];
    const int32_t step = b->sine - a->sine;
    const bool alike = a->sine >> even == b->sine >> even;
    const int log = alike ? 0 : halvings(p, abs_i32(step) * h->contrast >> 8), run = p->span_log2 - log;
    for (int32_t i = 0; i < 1 << log; i++) {
        const int32_t level = (alike ? a->sine : a->sine + (step * (2 * i + 1) >> (log + 1))) >> even;
        if (level == p->level)
            continue;
        begin_run(p, x + (i << run), color_of(h, (level << even) + (1 << even >> 1)));
        p->level = level;
    }
}

/* Returns the part of the exposure for which a point is above the horizon. */
static int32_t part_above(const struct point *a)
{
    int32_t width = a->width, rise = a->rise;
    if (abs_i32(rise) >= width >> 1)
        return rise < 0 ? 0 : PART_ONE;
    for (; width >= 1 << 19; width >>= 1)
        rise >>= 1;
    return clamp_i32(PART_ONE / 2 + rise * PART_ONE / width, 0, PART_ONE);
}

/* Returns the colour of a point that the horizon may pass. What is seen of a half then is half as high as its highest, in the mean. */
static uint32_t mixed_color(const struct pen *p, const struct point *a)
{
    const int32_t part = part_above(a), width = a->width >> 1, other = PART_ONE - part;
    const int32_t up = part == PART_ONE ? a->rise : mul_shift(width, part, 12), down = part == 0 ? a->rise : mul_shift(width, other, 12);
    const uint32_t above = color_of(&p->half[0], sine_of(up, a->inverse)), below = color_of(&p->half[1], sine_of(down, a->inverse));
    return pixel_mix_part(below, above, part * (65536 / PART_ONE), (smear_transfer)p->sky->own[TRANSFER]);
}

/* Fills a span of a row that the horizon may pass. */
static SMEAR_NOINLINE void fill_mixed(const struct pen *of, int32_t x, int32_t y, int k)
{
    struct pen row = *of, *const p = &row;
    row.at += k * of->stride;
    row.rows = 1;
    row.from = x;
    begin_row(p, p->sky->own[HEIGHT] - 2 * y - 1);
    const int32_t span = 1 << p->span_log2, left = 2 * x - p->sky->own[WIDTH];
    struct point a, b;
    find_point(&a, p, left);
    find_point(&b, p, left + 2 * span);
    const int32_t part = abs_i32(part_above(&a) - part_above(&b)),
                  sine = abs_i32(a.rise - b.rise) >> 14, most = max_i32(p->half[0].contrast, p->half[1].contrast);
    const int log = halvings(p, (part * contrast_of(p->sky->horizon, p->sky->ground) >> 12) + (min_i32(sine, 256) * most >> 8));
    const int32_t run = span >> log;
    for (int32_t i = 0; i < span; i += run) {
        find_point(&a, p, left + 2 * i + run);
        begin_run(p, x + i, mixed_color(p, &a));
    }
    begin_run(p, x + span, (uint32_t)NO_COLOR);
}

/* Returns on which side of the horizon a point of some rows is seen in all of them: 1 or -1; or 0. */
static int32_t side_of(const struct point *a, int32_t margin)
{
    const int32_t least = (a->width >> 1) + margin;
    return a->rise >= least ? 1 : a->rise <= -least ? -1 : 0;
}

/* Returns the log2 of columns from point to point in the pen's rows, which rise by less than `most`, q22: the less, the less err sines
 * between points. */
static int span_of(const struct pen *p, uint32_t most)
{
    int log = p->sky->own[SPAN_LOG2];
    for (; log <= SPAN_MOST && 1 << log < p->sky->own[WIDTH] && most < 1u << 20; most *= 4)
        log++;
    return log;
}

/* Returns how many rows, of which that is one, look alike: twice as many where all of them show the half of less contrast. */
static int32_t rows_of(const struct pen *p, int32_t y)
{
    const int32_t *own = p->sky->own, rows = own[ROWS], height = own[HEIGHT], first = y & -2 * rows;
    const bool down = p->half[1].contrast < p->half[0].contrast;
    const int32_t across = abs_i32(own[RISE_X]) * own[WIDTH], sign = down ? -1 : 1;
    const int32_t upper = own[RISE] + (height - 2 * first - 1) * own[RISE_Y],
                  lower = own[RISE] + (height - 2 * (first + 2 * rows)) * own[RISE_Y];
    return rows < ROWS_MOST && 2 * p->half[down].contrast <= p->half[!down].contrast && upper * sign > across && lower * sign > across
         ? 2 * rows : rows;
}

static void fill(const smear_sky *sky, const struct smear_raster_target *t)
{
    const int32_t *own = sky->own, width = own[WIDTH], height = own[HEIGHT];
    const int32_t across = abs_i32(own[RISE_X]), along = abs_i32(own[RISE_Y]);
    const struct smear_plane_rows *const lie = target_is_direct(t) ? &t->window_rows : &t->color_rows;
    struct pen p = { .sky = sky, .target = t, .stride = lie->stride };
    p.pixel = 2 * max_i32(across, along) + (3 * min_i32(across, along) >> 2);      /* twice the length, within 7 % */
    __builtin_memcpy(p.half, &own[HALVES], sizeof p.half);
    for (int i = 0; i < 2; i++)
        while (p.even[i] < 8 && p.half[i].contrast << p.even[i] <= 256)
            p.even[i]++;
    for (int32_t y = t->y0, end; y < t->y1; y = end) {
        const int32_t rows = rows_of(&p, y), first = y & -rows, left = lie->ring - lie->ring_row - (y - t->y0);
        struct point a, b;
        p.at = target_row(lie, t, y);
        p.rows = min_i32(min_i32(first + rows, t->y1) - y, left > 0 ? left : left + lie->ring);
        end = y + p.rows;
        begin_row(&p, height - 2 * first - rows);
        p.span_log2 = span_of(&p, (uint32_t)abs_i32(p.rise) + (uint32_t)(across * width));
        p.color = (uint32_t)NO_COLOR;
        p.level = -1;
        const int32_t span = 1 << p.span_log2;
        int32_t x = t->x0 & -span;
        p.from = x;
        find_point(&a, &p, 2 * x - width);
        int32_t side = side_of(&a, rows * along);
        for (; x < t->x1; x += span, a = b) {
            const int32_t before = side;
            find_point(&b, &p, 2 * (x + span) - width);
            side = side_of(&b, rows * along);
            if (side == before && side != 0) {
                fill_span(&p, &a, &b, x);
                continue;
            }
            begin_run(&p, x, (uint32_t)NO_COLOR);
            for (int32_t k = 0; k < p.rows; k++)
                fill_mixed(&p, x, y + k, k);
            p.from = x + span;
        }
        begin_run(&p, x, (uint32_t)NO_COLOR);
    }
}

SMEAR_STATIC_ASSERT(HALVES + 2 * sizeof(struct half) / sizeof(int32_t) == sizeof ((smear_sky *)0)->own / sizeof(int32_t), "own");

const smear_sky_kind smear_sky_gradient = { aim, fill };

#endif
