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
#include "display/row.h"

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
        const int32_t step = weight[k] != 0 ? step_of(&shot->camera[k], width, shot->height) : 0;
        sum[0] -= mul_wide(up[2], weight[k]);
        sum[1] += (mul_wide(up[0], step) >> 24) * weight[k];
        sum[2] += (mul_wide(up[1], step) >> 24) * weight[k];
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
    int16_t contrast, even;             /* even: log2 of sines that look alike, less than two codes apart */
};

static void take_half(struct half *h, uint32_t horizon, uint32_t pole)
{
    h->pair = ((horizon & 0xff00ffu) << 8) + 0x800080u;
    h->green = (horizon & 0xff00u) + 0x80u;
    h->pair_step = (pole & 0xff00ffu) - (horizon & 0xff00ffu);
    h->green_step = pixel_green(pole) - pixel_green(horizon);
    h->contrast = (int16_t)contrast_of(horizon, pole);
    for (h->even = 0; h->even < 8 && h->contrast << h->even <= 256;)
        h->even++;
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
    uint32_t *too;                      /* where these lie in a second picture, or null */
    int32_t at, stride;                 /* where the rows lie that are filled at once, so many: */
    int rows, span_log2;                /* log2 of columns between points */
    int32_t from;                       /* where the run begins that is not filled yet, of this colour: of a sine, shifted */
    uint32_t color;
};

/* Returns 1 / sqrt(n), q15, for n of 1 or more, q16: within 1/600. */
SMEAR_INLINE int32_t inverse_root(uint32_t n)
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

SMEAR_INLINE int32_t inverse_at(const struct pen *p, int32_t u)
{
    const int32_t x = clamp_i32(u * p->sky->own[STEP] >> 12, -45000, 45000);
    return inverse_root((uint32_t)((x * x >> 8) + p->square));
}

static int32_t rise_at(const struct pen *p, int32_t u) { return p->rise + u * p->sky->own[RISE_X]; }

static int32_t width_at(const struct pen *p, int32_t u) { return max_i32(abs_i32(p->sweep + u * p->sky->own[SWEEP_X]), p->pixel); }

SMEAR_INLINE int32_t sine_at(const struct pen *p, int32_t u) { return sine_of(rise_at(p, u), inverse_at(p, u)); }

/* Goes on with another colour from a column on: fills what was before it in each row, as far as it is the target's. */
static SMEAR_NOINLINE void begin_run(struct pen *p, int32_t x, uint32_t color)
{
    const uint32_t value = p->color;
    const struct smear_raster_target *t = p->target;
    const int32_t x0 = max_i32(p->from, t->x0), n = min_i32(x, t->x1) - x0, at = p->at + x0;
    p->from = x;
    p->color = color;
    if (n <= 0)
        return;
    if (!target_is_direct(t)) {
        pixels_fill_rows(t->color + at, value, n, p->stride, p->rows);
        if (p->too != NULL)
            pixels_fill_rows(p->too + x0, value, n, p->stride, p->rows);
    } else
        for (uint16_t *to = t->direct + at, *const end = to + p->rows * p->stride; to != end; to += p->stride)
            pixels_fill_narrow(to, rgb565_nearest(value), n);
}

static inline void go_on(struct pen *p, int32_t x, uint32_t color)
{
    if (p->from == x)
        p->color = color;
    else if (p->color != color)
        begin_run(p, x, color);
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

/* Fills spans of rows that are on one side of the horizon. Sines whose upper bits are alike have one colour. */
static void fill_side(struct pen *p, bool below, int32_t x, int32_t end)
{
    const struct half *const h = &p->half[below];
    const int even = h->even, span_log2 = p->span_log2;
    int32_t level = -1, u = 2 * x - p->sky->own[WIDTH];
    for (int32_t sine = sine_at(p, u), next; x < end; x += 1 << span_log2, sine = next) {
        u += 2 << span_log2;
        next = sine_at(p, u);
        int32_t part = next - sine, at = x;
        const int log = halvings(p, abs_i32(part) * h->contrast >> 8);
        do {
            const int32_t seen = (sine + (part >> (log + 1))) >> even;
            if (seen != level)
                go_on(p, at, color_of(h, (seen << even) + (1 << even >> 1)));
            level = seen;
            part += 2 * (next - sine);
            at += 1 << (span_log2 - log);
        } while (at < x + (1 << span_log2));
    }
}

/* Returns the part of the exposure for which a point is above the horizon. */
static int32_t part_above(const struct pen *p, int32_t u)
{
    int32_t width = width_at(p, u), rise = rise_at(p, u);
    if (abs_i32(rise) >= width >> 1)
        return rise < 0 ? 0 : PART_ONE;
    for (; width >= 1 << 19; width >>= 1)
        rise >>= 1;
    return clamp_i32(PART_ONE / 2 + rise * PART_ONE / width, 0, PART_ONE);
}

/* Returns the colour of a point that the horizon may pass. What is seen of a half then is half as high as its highest, in the mean. */
static uint32_t mixed_color(const struct pen *p, int32_t u)
{
    const int32_t part = part_above(p, u), rise = rise_at(p, u), width = width_at(p, u) >> 1, inverse = inverse_at(p, u);
    const int32_t up = part == PART_ONE ? rise : mul_shift(width, part, 12),
                  down = part == 0 ? rise : mul_shift(width, PART_ONE - part, 12);
    const uint32_t above = color_of(&p->half[0], sine_of(up, inverse)), below = color_of(&p->half[1], sine_of(down, inverse));
    return pixel_mix_part(below, above, part * (65536 / PART_ONE), (smear_transfer)p->sky->own[TRANSFER]);
}

/* Fills a span of a row that the horizon may pass. */
static SMEAR_NOINLINE void fill_mixed(const struct pen *of, int32_t x, int32_t y, int k)
{
    struct pen row = *of, *const p = &row;
    row.at += k * of->stride;
    row.too = of->too == NULL ? NULL : of->too + k * of->stride;
    row.rows = 1;
    row.from = x;
    begin_row(p, p->sky->own[HEIGHT] - 2 * y - 1);
    const int32_t span = 1 << p->span_log2, left = 2 * x - p->sky->own[WIDTH], right = left + 2 * span;
    const int32_t part = abs_i32(part_above(p, left) - part_above(p, right)), sine = abs_i32(rise_at(p, left) - rise_at(p, right)) >> 14,
                  most = max_i32(p->half[0].contrast, p->half[1].contrast);
    const int log = halvings(p, (part * contrast_of(p->sky->horizon, p->sky->ground) >> 12) + (min_i32(sine, 256) * most >> 8));
    const int32_t run = span >> log;
    for (int32_t i = 0; i < span; i += run)
        go_on(p, x + i, mixed_color(p, left + 2 * i + run));
    begin_run(p, x + span, (uint32_t)NO_COLOR);
}

/* Returns on which side of the horizon columns [x0, x1) are seen in all of some rows, of which the pen has the middle: 1 or -1; or 0. */
static int32_t side_of(const struct pen *p, int32_t x0, int32_t x1, int32_t rows)
{
    const int32_t *own = p->sky->own, u = 2 * x0 - own[WIDTH], v = 2 * x1 - own[WIDTH], margin = rows * abs_i32(own[RISE_Y]);
    const int32_t a = rise_at(p, u), b = rise_at(p, v), least_a = (width_at(p, u) >> 1) + margin, least_b = (width_at(p, v) >> 1) + margin;
    return a >= least_a && b >= least_b ? 1 : a <= -least_a && b <= -least_b ? -1 : 0;
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

/* Takes some rows that look alike from y on, and returns on which side of the horizon they are, as side_of does. */
static int32_t begin_rows(struct pen *p, int32_t y, int32_t rows)
{
    const int32_t *own = p->sky->own, width = own[WIDTH];
    begin_row(p, own[HEIGHT] - 2 * y - rows);
    p->span_log2 = span_of(p, (uint32_t)abs_i32(p->rise) + (uint32_t)(abs_i32(own[RISE_X]) * width));
    return side_of(p, 0, ((width - 1) | ((1 << p->span_log2) - 1)) + 1, rows);
}

/* Fills spans of the pen's rows, of which that is the first, some of which the horizon passes. */
static SMEAR_NOINLINE void fill_across(struct pen *p, int32_t x, int32_t y, int32_t end, int32_t rows)
{
    for (const int32_t span = 1 << p->span_log2; x < end; x += span) {
        const int32_t side = side_of(p, x, x + span, rows);
        if (side != 0) {
            fill_side(p, side < 0, x, x + span);
            continue;
        }
        begin_run(p, x, (uint32_t)NO_COLOR);
        for (int32_t k = 0; k < p->rows; k++)
            fill_mixed(p, x, y + k, k);
        p->from = x + span;
    }
}

static void fill(const smear_sky *sky, const struct smear_raster_target *t, uint32_t *too)
{
    const int32_t *own = sky->own, height = own[HEIGHT];
    const int32_t across = abs_i32(own[RISE_X]), along = abs_i32(own[RISE_Y]);
    const struct smear_plane_rows *const lie = target_is_direct(t) ? &t->window_rows : &t->color_rows;
    struct pen p = { .sky = sky, .target = t, .stride = lie->stride };
    p.pixel = 2 * max_i32(across, along) + (3 * min_i32(across, along) >> 2);      /* twice the length, within 7 % */
    __builtin_memcpy(p.half, &own[HALVES], sizeof p.half);
    /* Twice as many rows look alike where all of them show a half of less contrast. */
    const bool down = p.half[1].contrast < p.half[0].contrast;
    const int32_t twice = own[ROWS] < ROWS_MOST && 2 * p.half[down].contrast <= p.half[!down].contrast ? 2 * own[ROWS] : 0;
    for (int32_t y = t->y0, end; y < t->y1; y = end) {
        int32_t rows = twice, side = 0;
        if (rows != 0 && (own[RISE] + (height - 2 * (y & -rows) - rows) * own[RISE_Y] < 0) == down)
            side = begin_rows(&p, y & -rows, rows);
        if (side == 0) {
            rows = own[ROWS];
            side = begin_rows(&p, y & -rows, rows);
        }
        const int32_t left = lie->ring - lie->ring_row - (y - t->y0);
        p.at = target_row(lie, t, y);
        p.too = too == NULL ? NULL : too + (y & ((1 << t->tile_shift) - 1)) * p.stride;
        p.rows = min_i32(min_i32((y & -rows) + rows, t->y1) - y, left > 0 ? left : left + lie->ring);
        end = y + p.rows;
        p.color = (uint32_t)NO_COLOR;
        const int32_t span = 1 << p.span_log2, x0 = t->x0 & -span, x1 = (t->x1 + span - 1) & -span;
        p.from = x0;
        if (side != 0)
            fill_side(&p, side < 0, x0, x1);
        else
            fill_across(&p, x0, y, x1, rows);
        begin_run(&p, x1, (uint32_t)NO_COLOR);
    }
}

SMEAR_STATIC_ASSERT(HALVES + 2 * sizeof(struct half) / sizeof(int32_t) == sizeof ((smear_sky *)0)->own / sizeof(int32_t), "own");

const smear_sky_kind smear_sky_gradient = { aim, fill };

#endif
