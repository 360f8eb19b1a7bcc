/* SPDX-License-Identifier: MIT */
/* debug.c - see debug.h. */
#include "tools/view/debug.h"

#include "tools/scenes/methods.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

const char *const debug_names[] = { "picture", "velocity", "depth", "tiles", "methods", "samples", "bands", NULL };
const char *const debug_legends[] = {
    [DEBUG_PICTURE] = NULL,
    [DEBUG_VELOCITY] = "colour: direction; bright: fast",
    [DEBUG_DEPTH] = "bright: near; blue: nothing",
    [DEBUG_TILES] = "green still, yellow uniform, red complex; violet edges: beyond reach",
    [DEBUG_METHODS] = "grey none, warm filters, blue subframes, violet timemask, pinks layers",
    [DEBUG_SAMPLES] = "black 1 a pixel, blue to yellow to white 64",
    [DEBUG_BANDS] = "a stripe: rows that are sent at once; its first row is brighter",
};

/* ------------------------------------------------------------------ colours */

static uint32_t rgb(double r, double g, double b)
{
    const double channel[3] = { r, g, b };
    uint32_t out = 0;
    for (int i = 0; i < 3; i++) {
        double c = channel[i] < 0.0 ? 0.0 : channel[i] > 1.0 ? 1.0 : channel[i];
        out = out << 8 | (uint32_t)(c * 255.0 + 0.5);
    }
    return out;
}

static uint32_t blend(uint32_t under, uint32_t over, unsigned weight)
{
    uint32_t out = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        uint32_t a = under >> shift & 255, b = over >> shift & 255;
        out |= (a * (256 - weight) + b * weight) >> 8 << shift;
    }
    return out;
}

static uint32_t grey_of(uint32_t code)
{
    uint32_t y = ((code >> 16 & 255) * 54 + (code >> 8 & 255) * 183 + (code & 255) * 19) >> 8;
    return y << 16 | y << 8 | y;
}

/* Hue goes round with the direction; black stands still, full brightness is `full` pixels. */
static uint32_t velocity_color(double x, double y, double full)
{
    double angle = atan2(-y, x), length = hypot(x, y) / full;
    double value = length < 1.0 ? sqrt(length) : 1.0;
    return rgb(value * (0.5 + 0.5 * cos(angle)), value * (0.5 + 0.5 * cos(angle - 2 * PI / 3)),
               value * (0.5 + 0.5 * cos(angle + 2 * PI / 3)));
}

/* ------------------------------------------------------------------ planes */

static bool draw_planes(struct debug *d, const struct lane *lane, struct presenter *presenter,
                        const struct instant *instant, struct failure *f)
{
    if (d->width != lane->setup.width || d->height != lane->setup.height) {
        debug_close(d);
        if (!planes_open(&d->planes, lane->setup.width, lane->setup.height, f)) {
            planes_close(&d->planes);
            return false;
        }
        d->width = lane->setup.width;
        d->height = lane->setup.height;
    }
    const struct presented *presented = lane_present(lane, presenter, instant, f);
    return presented != NULL && planes_draw(&d->planes, presented, f);
}

void debug_close(struct debug *d)
{
    if (d->width > 0)
        planes_close(&d->planes);
    *d = (struct debug){ .width = 0 };
}

static size_t pixels_of(const struct lane *lane)
{
    return (size_t)lane->setup.width * (size_t)lane->setup.height;
}

static void show_velocity(const struct debug *d, const struct lane *lane, uint32_t *picture)
{
    const float *v = d->planes.velocity.value;
    double full = lane->setup.reach * 2.0;
    for (size_t i = 0; i < pixels_of(lane); i++, v += 3)
        picture[i] = velocity_color((double)v[0], (double)v[1], full);
}

/* Near is bright; even steps of 1 / distance. */
static void show_depth(const struct debug *d, const struct lane *lane, uint32_t *picture)
{
    const float *depth = d->planes.depth.value;
    double nearest = INFINITY;
    for (size_t i = 0; i < pixels_of(lane); i++)
        nearest = fmin(nearest, (double)depth[i]);
    for (size_t i = 0; i < pixels_of(lane); i++) {
        double value = isfinite(depth[i]) ? 0.08 + 0.92 * nearest / (double)depth[i] : 0.0;
        picture[i] = rgb(value, value, isfinite(depth[i]) ? value : 0.2);
    }
}

/* ------------------------------------------------------------------ tiles */

/* Longest displacement within the exposure in each tile, in pixels. */
static void longest_of(const struct debug *d, const struct lane *lane, double *longest)
{
    const float *v = d->planes.velocity.value;
    const int edge = lane->tiles.edge, columns = lane->tiles.columns;
    double open = lane->setup.present.shutter_degrees / 360.0;
    for (int y = 0; y < lane->setup.height; y++)
        for (int x = 0; x < lane->setup.width; x++, v += 3) {
            double *tile = &longest[y / edge * columns + x / edge];
            *tile = fmax(*tile, hypot((double)v[0], (double)v[1]) * open);
        }
}

static double around(const double *longest, int columns, int rows, int column, int row)
{
    double most = 0.0;
    for (int y = row > 0 ? row - 1 : 0; y <= row + 1 && y < rows; y++)
        for (int x = column > 0 ? column - 1 : 0; x <= column + 1 && x < columns; x++)
            most = fmax(most, longest[y * columns + x]);
    return most;
}

static uint32_t kind_color(const struct tile_note *tile)
{
    static const uint32_t color[TILES_KINDS] = { 0x207040, 0xe0c020, 0xe03018 };
    return color[tile->kind];
}

static uint32_t method_color(const struct tile_note *tile)
{
    return method_of((smear_method)tile->method)->tile_color;
}

static uint32_t samples_color(const struct tile_note *tile)
{
    double share = tile->samples > 1 ? log2(tile->samples) / 6.0 : 0.0;
    double blue = share < 0.35 ? 2.2 * share : share < 0.8 ? 0.77 - share : 4.0 * share - 3.0;
    return rgb(2.0 * share - 0.6, 1.6 * share - 0.2, blue);
}

static void show_notes(const struct lane *lane, uint32_t (*color)(const struct tile_note *),
                       uint32_t *picture)
{
    const struct tiles *t = &lane->tiles;
    int width = lane->setup.width, height = lane->setup.height;
    for (int y = 0; y < height && t->edge > 0; y++)
        for (int x = 0; x < width; x++) {
            uint32_t *p = &picture[(size_t)y * (size_t)width + (size_t)x];
            const struct tile_note *tile = &t->note[y / t->edge * t->columns + x / t->edge];
            bool is_border = x % t->edge == 0 || y % t->edge == 0;
            *p = blend(grey_of(*p), is_border ? 0x000000 : color(tile), is_border ? 120 : 150);
        }
}

/* A streak longer than twice the reach is shortened by filters: the edges of tiles that hold
 * one, or lie beside one that does, are violet. */
static bool show_kinds(const struct debug *d, const struct lane *lane, uint32_t *picture, struct failure *f)
{
    const struct tiles *t = &lane->tiles;
    const int width = lane->setup.width;
    double *longest = calloc((size_t)t->columns * (size_t)t->rows, sizeof *longest);
    if (longest == NULL)
        return fail(f, "out of memory");
    longest_of(d, lane, longest);
    show_notes(lane, kind_color, picture);
    for (int y = 0; y < lane->setup.height; y++)
        for (int x = 0; x < width; x++)
            if ((x % t->edge == 0 || y % t->edge == 0)
                && around(longest, t->columns, t->rows, x / t->edge, y / t->edge) > 2.0 * lane->setup.reach)
                picture[(size_t)y * (size_t)width + (size_t)x] = 0xa030d0;
    free(longest);
    return true;
}

/* ------------------------------------------------------------------ bands */

static void show_bands(const struct lane *lane, uint32_t *picture)
{
    for (int i = 0; i < lane->band_count; i++) {
        const struct lane_band *b = &lane->band[i];
        uint32_t *p = picture + (size_t)b->y * (size_t)lane->setup.width + b->x;
        for (int y = 0; y < b->height; y++, p += lane->setup.width)
            for (int x = 0; x < b->width; x++)
                p[x] = blend(p[x], i & 1 ? 0x3060ff : 0xff9020, y == 0 ? 200 : 70);
    }
}

bool debug_draw(struct debug *d, enum debug_kind kind, const struct lane *lane,
                struct presenter *presenter, const struct instant *instant, uint32_t *picture,
                struct failure *f)
{
    bool needs_planes = kind == DEBUG_VELOCITY || kind == DEBUG_DEPTH || kind == DEBUG_TILES;
    if (needs_planes && !draw_planes(d, lane, presenter, instant, f))
        return false;
    switch (kind) {
    case DEBUG_VELOCITY: show_velocity(d, lane, picture); return true;
    case DEBUG_DEPTH: show_depth(d, lane, picture); return true;
    case DEBUG_TILES: return show_kinds(d, lane, picture, f);
    case DEBUG_METHODS: show_notes(lane, method_color, picture); return true;
    case DEBUG_SAMPLES: show_notes(lane, samples_color, picture); return true;
    case DEBUG_BANDS: show_bands(lane, picture); return true;
    default: return true;
    }
}
