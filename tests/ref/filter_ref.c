/* SPDX-License-Identifier: MIT */
/* filter_ref.c - the reconstruction filter in double precision, written to be read beside
 * filter_ref.h. */
#include "tests/ref/filter_ref.h"

#include "tools/ref/ref.h"
#include "smear.h"

#include "tests/host.h"

static const double two_pi = 6.28318530717958647693;
static const double slowest = 1.0 / 16.0;       /* px: smallest speed that divides a weight */

struct filter {
    const struct filter_ref_input *in;
    double step;                /* pixels per velocity step */
    int columns, rows;          /* tiles */
    double *neighbor;           /* 2 per tile */
    double *upper;              /* likewise, without the tiles below (window) */
    bool *still;                /* per tile: nothing moves in its 3x3 (window) */
    double value[256];          /* code to what is averaged */
};

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

static double fraction(double value)
{
    return value - floor(value);
}

double filter_ref_noise(int x, int y)
{
    return fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
}

static int tiles(int pixels, int tile)
{
    return (pixels + tile - 1) / tile;
}

void filter_ref_pack(const double velocity[2], double shutter_degrees, double reach, double step,
                     int16_t packed[2])
{
    double share = shutter_degrees / 720.0, half[2] = { velocity[0] * share, velocity[1] * share };
    double length = hypot(half[0], half[1]);
    double scale = length > reach ? reach / length : 1.0;
    for (int i = 0; i < 2; i++)
        packed[i] = (int16_t)floor(clamp(half[i] * scale / step, -32768.0, 32767.0) + 0.5);
}

/* ------------------------------------------------------------------ maxima */

void filter_ref_tile_max(const struct filter_ref_input *in, int16_t *tile_max)
{
    int columns = tiles(in->width, in->tile), rows = tiles(in->height, in->tile);
    for (int i = 0; i < columns * rows; i++) {
        int left = i % columns * in->tile, top = i / columns * in->tile;
        int64_t longest = -1;
        for (int y = top; y < top + in->tile && y < in->height; y++)
            for (int x = left; x < left + in->tile && x < in->width; x++) {
                const int16_t *v = in->velocity + 2 * ((ptrdiff_t)y * in->width + x);
                int64_t square = (int64_t)v[0] * v[0] + (int64_t)v[1] * v[1];
                if (square > longest) {
                    longest = square;
                    tile_max[2 * i] = v[0];
                    tile_max[2 * i + 1] = v[1];
                }
            }
    }
}

static int sign(int value)
{
    return (value > 0) - (value < 0);
}

/* Whether the tile at offset (dx, dy) may decide for this one. */
static bool counts(const struct filter_ref_input *in, int dx, int dy,
                   const int16_t v[2])
{
    if ((in->flags & SMEAR_CORNER) == 0 || dx == 0 || dy == 0)
        return true;
    return abs(sign(dx * v[0]) + sign(dy * v[1])) == 2;
}

/* From the tiles of rows -1 .. last of the 3x3. */
static void neighbor_max_of(const struct filter_ref_input *in, const int16_t *tile_max, int last,
                            double *neighbor_max)
{
    int columns = tiles(in->width, in->tile), rows = tiles(in->height, in->tile);
    double step = in->velocity_step != 0.0 ? in->velocity_step : 0.125;
    for (int i = 0; i < columns * rows; i++) {
        int64_t longest = -1;
        for (int dy = -1; dy <= last; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                int x = i % columns + dx, y = i / columns + dy;
                if (x < 0 || y < 0 || x >= columns || y >= rows)
                    continue;
                const int16_t *v = tile_max + 2 * (y * columns + x);
                bool center = dx == 0 && dy == 0;
                int64_t square = (int64_t)v[0] * v[0] + (int64_t)v[1] * v[1];
                square *= center ? 10201 : 10000;       /* 1.01 squared, exactly */
                if (square > longest && counts(in, dx, dy, v)) {
                    double scale = center || in->whole_neighbor ? step : step / 1.01;
                    longest = square;
                    neighbor_max[2 * i] = v[0] * scale;
                    neighbor_max[2 * i + 1] = v[1] * scale;
                }
            }
    }
}

void filter_ref_neighbor_max(const struct filter_ref_input *in, const int16_t *tile_max,
                             double *neighbor_max)
{
    neighbor_max_of(in, tile_max, 1, neighbor_max);
}

/* Tiles in whose 3x3 nothing moves, whatever SMEAR_CORNER leaves out. */
static void mark_still(const struct filter *filter, const int16_t *tile_max)
{
    for (int i = 0; i < filter->columns * filter->rows; i++) {
        filter->still[i] = true;
        for (int k = 0; k < 9; k++) {
            int x = i % filter->columns + k % 3 - 1, y = i / filter->columns + k / 3 - 1;
            if (x < 0 || y < 0 || x >= filter->columns || y >= filter->rows)
                continue;
            const int16_t *v = tile_max + 2 * (y * filter->columns + x);
            filter->still[i] = filter->still[i] && v[0] == 0 && v[1] == 0;
        }
    }
}

/* ------------------------------------------------------------------ the gather */

/* 1 when b is nearer than a by 5 % of a's distance or more, 0 when it is not nearer. */
static double in_front(const struct filter_ref_input *in, uint16_t a, uint16_t b)
{
    if (b == 0)
        return 0.0;
    if (a == 0)
        return 1.0;
    double units_a = smear_depth_units(a), units_b = smear_depth_units(b);
    double z_a, z_b;
    if (in->orthographic) {
        double range = in->far_plane - in->near_plane;
        z_a = in->far_plane - range * units_a / SMEAR_DEPTH_NEAR;
        z_b = in->far_plane - range * units_b / SMEAR_DEPTH_NEAR;
    } else {
        z_a = 1.0 / units_a;        /* in units of near x SMEAR_DEPTH_NEAR, which cancel */
        z_b = 1.0 / units_b;
    }
    return z_a > 0.0 ? clamp(20.0 * (z_a - z_b) / z_a, 0.0, 1.0) : 0.0;
}

static void second_direction(const struct filter_ref_input *in, const double own[2],
                             const double top[2], double length, double out[2])
{
    double speed = hypot(own[0], own[1]), long_enough = fmax(speed, 0.5);
    if ((in->flags & SMEAR_DIRECTION) != 0) {
        double normal[2] = { -top[1] / length, top[0] / length };
        double side = normal[0] * own[0] + normal[1] * own[1] < 0.0 ? -1.0 : 1.0;
        double share = clamp((speed - 0.5) / 1.5, 0.0, 1.0);
        for (int i = 0; i < 2; i++) {
            double along = speed > 0.0 ? own[i] / speed : 0.0;
            out[i] = side * normal[i] * (1.0 - share) + along * share;
        }
        double scale = length / hypot(out[0], out[1]);
        out[0] *= scale;
        out[1] *= scale;
    } else if (2.0 * long_enough > length) {
        out[0] = own[0] * length / long_enough;
        out[1] = own[1] * length / long_enough;
    } else {
        out[0] = top[0];
        out[1] = top[1];
    }
}

static const double *neighbor_at(const struct filter *filter, int x, int y)
{
    const struct filter_ref_input *in = filter->in;
    double angle = two_pi * filter_ref_noise(x + 2 * in->width, y);
    double u = x + 0.5 + 0.25 * in->tile * cos(angle), v = y + 0.5 + 0.25 * in->tile * sin(angle);
    int column = (int)clamp(floor(u / in->tile), 0.0, filter->columns - 1);
    int row = (int)clamp(floor(v / in->tile), 0.0, filter->rows - 1);
    bool below = in->window && row > y / in->tile;
    return (below ? filter->upper : filter->neighbor) + 2 * (row * filter->columns + column);
}

static void add(const struct filter *filter, size_t at, double weight, double sum[4])
{
    for (size_t i = 0; i < 3; i++)
        sum[i] += weight * filter->value[filter->in->rgb[3 * at + i]];
    sum[3] += weight;
}

static void gather(const struct filter *filter, int x, int y, const double top[2], double length,
                   double sum[4])
{
    const struct filter_ref_input *in = filter->in;
    size_t here = (size_t)y * (size_t)in->width + (size_t)x;
    const int16_t *packed = in->velocity + 2 * here;
    double own[2] = { packed[0] * filter->step, packed[1] * filter->step };
    double speed = hypot(own[0], own[1]);
    double second[2];
    second_direction(in, own, top, length, second);

    bool fence = (in->flags & SMEAR_FENCE) != 0 && speed <= 0.5;
    bool box = (in->flags & SMEAR_BOX) != 0;
    double wanted = clamp(floor((in->samples != 0 ? in->samples : 8) / 2), 1.0, 64.0);
    int pairs = (int)floor(fmin(wanted, length / 2.0));
    double offset = (filter_ref_noise(x, y) - 0.5) / pairs;
    double background = fmax(fmax(speed, 0.5), 1.0);
    for (int i = 0; i < pairs; i++) {
        double t = 1.0 - (i + 0.5) / pairs;
        const double *direction = i % 2 == 0 ? top : second;
        for (int side = 1; side >= -1; side -= 2) {
            double s = side * t + offset, distance = length * fabs(s);
            int u = (int)clamp(floor(x + 0.5 + s * direction[0]), 0.0, in->width - 1);
            int v = (int)clamp(floor(y + 0.5 + s * direction[1]), 0.0, in->height - 1);
            size_t at = (size_t)v * (size_t)in->width + (size_t)u;
            double other = filter->step * hypot(in->velocity[2 * at], in->velocity[2 * at + 1]);
            double front = in_front(in, in->depth[here], in->depth[at]);
            double fast = fmax(background + (other - background) * front, slowest);
            double weight = clamp(fast - distance, 0.0, 1.0) / fast * (box ? 1.0 : 1.2 - t);
            if (fence)
                weight *= 1.0 - in_front(in, in->depth[at], in->depth[here]);
            add(filter, at, weight, sum);
            background = fmax(background, fast);
        }
    }
    add(filter, here, (box ? 1.0 : 1.2) / (2.0 * background * pairs), sum);
}

static void filter_pixel(const struct filter *filter, int x, int y, double code[3])
{
    const struct filter_ref_input *in = filter->in;
    const double *top = neighbor_at(filter, x, y);
    double length = hypot(top[0], top[1]), sum[4] = { 0.0, 0.0, 0.0, 0.0 };
    int tile = y / in->tile * filter->columns + x / in->tile;
    if (length < 2.0 || (in->window && filter->still[tile])) {
        for (int i = 0; i < 3; i++)
            code[i] = in->rgb[3 * ((ptrdiff_t)y * in->width + x) + i];
        return;
    }
    gather(filter, x, y, top, length, sum);
    for (int i = 0; i < 3; i++) {
        double mean = sum[i] / sum[3];
        code[i] = 255.0 * (in->encoded ? mean : ref_srgb_encode(mean));
    }
}

bool filter_ref(const struct filter_ref_input *in, double *code, struct failure *f)
{
    struct filter filter = { .in = in };
    if (in->width < 1 || in->height < 1 || in->tile < 1 || in->samples < 0)
        return fail(f, "no such filter (%d x %d, tile %d)", in->width, in->height, in->tile);
    if (in->orthographic && !(in->far_plane > in->near_plane))
        return fail(f, "orthographic depth without planes (filter)");
    filter.step = in->velocity_step != 0.0 ? in->velocity_step : 0.125;
    filter.columns = tiles(in->width, in->tile);
    filter.rows = tiles(in->height, in->tile);
    for (int i = 0; i < 256; i++)
        filter.value[i] = in->encoded ? i / 255.0 : ref_srgb_decode(i / 255.0);

    size_t count = (size_t)filter.columns * (size_t)filter.rows;
    int16_t *tile_max = malloc(2 * count * sizeof *tile_max);
    filter.neighbor = malloc(2 * count * sizeof *filter.neighbor);
    filter.upper = malloc(2 * count * sizeof *filter.upper);
    filter.still = malloc(count * sizeof *filter.still);
    bool ok = tile_max != NULL && filter.neighbor != NULL && filter.upper != NULL
           && filter.still != NULL;
    if (ok) {
        filter_ref_tile_max(in, tile_max);
        filter_ref_neighbor_max(in, tile_max, filter.neighbor);
        neighbor_max_of(in, tile_max, 0, filter.upper);
        mark_still(&filter, tile_max);
        for (int y = 0; y < in->height; y++)
            for (int x = 0; x < in->width; x++)
                filter_pixel(&filter, x, y, code + 3 * ((ptrdiff_t)y * in->width + x));
    } else {
        fail(f, "no memory for %zu tiles (filter)", count);
    }
    free(tile_max);
    free(filter.neighbor);
    free(filter.upper);
    free(filter.still);
    return ok;
}
