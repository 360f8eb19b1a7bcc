/* SPDX-License-Identifier: MIT */
/* tiles.c - see tiles.h. The only file of the viewer that looks into a context: the public statistics
 * count tiles, but do not say where they are. */
#include "tools/view/tiles.h"

#include "layers/layer.h"
#include "filter/probe.h"

#include <stdlib.h>

enum { SMALLEST_TILE = 8 };

bool tiles_open(struct tiles *t, int width, int height, struct failure *f)
{
    size_t columns = ((size_t)width + SMALLEST_TILE - 1) / SMALLEST_TILE;
    size_t rows = ((size_t)height + SMALLEST_TILE - 1) / SMALLEST_TILE;
    *t = (struct tiles){ .room = (int)(columns * rows), .note = calloc(columns * rows, sizeof *t->note) };
    return t->note != NULL || fail(f, "out of memory");
}

void tiles_close(struct tiles *t)
{
    free(t->note);
    *t = (struct tiles){ .note = NULL };
}

static const struct tile_note still = { SMEAR_NONE, TILES_STILL, 1 };

void tiles_begin(struct tiles *t)
{
    for (int i = 0; i < t->room; i++)
        t->note[i] = still;
}

/* The chooser is asked again for what it has said of this tile. */
static struct tile_note temporal_tile(const struct smear_probe *c, const struct smear_tile_travel *tile)
{
    int32_t instants;
    if (travel_method(tile) == TILE_COPY)
        return still;
    smear_tile_method_choose(&c->temporal->chooser, tile, &instants);
    if (travel_method(tile) == TILE_SUBFRAMES)
        return (struct tile_note){ SMEAR_SUBFRAMES, TILES_COMPLEX, (uint16_t)(tile->instants != 0 ? tile->instants : instants) };
    return (struct tile_note){ SMEAR_TIMEMASK, TILES_COMPLEX, (uint16_t)c->temporal->chooser.samples };
}

/* The window that the method filters knows which tiles motion reaches. */
static struct tile_note filtered_tile(const struct smear_probe *c, int row, int column)
{
    const uint8_t kind = window_around(c->filtered->window, row)[column].kind;
    if (kind == TILE_STATIC)
        return still;
    return (struct tile_note){ (uint8_t)c->method, kind == TILE_UNIFORM ? TILES_UNIFORM : TILES_COMPLEX,
                               (uint16_t)(c->samples > 1 ? c->samples : 2) };
}

/* Running sums take one pixel in and one out, however long the streak. */
static struct tile_note layers_tile(const struct smear_probe *c, int column)
{
    const uint8_t reached = c->rows->window.moving[column];
    if (reached == 0)
        return still;
    if ((reached & TILE_LAYERED) == 0)
        return (struct tile_note){ SMEAR_OBJECT, TILES_UNIFORM, 2 };
    return (struct tile_note){ SMEAR_LAYERED, TILES_COMPLEX, (uint16_t)(c->samples > 1 ? c->samples : 2) };
}

static struct tile_note tile_of(const struct smear_probe *c, int row, int column)
{
    if (c->method == SMEAR_ACCUMULATE)
        return (struct tile_note){ SMEAR_ACCUMULATE, TILES_COMPLEX, (uint16_t)(c->samples > 0 ? c->samples : 8) };
    if (smear_method_is_filter(c->method))
        return filtered_tile(c, row, column);
    if (smear_method_is_temporal(c->method))
        return temporal_tile(c, &c->temporal->moving.travel[column]);
    return smear_method_has_layers(c->method) ? layers_tile(c, column) : still;
}

void tiles_note(struct tiles *t, const smear_context *ctx, const smear_band *band)
{
    const struct smear_probe c = smear_probe(ctx);
    const int edge = c.rows->window.tile;
    t->edge = edge;
    t->columns = (c.rows->window.width + edge - 1) / edge;
    t->rows = (c.rows->window.height + edge - 1) / edge;
    for (int row = band->y / edge; row * edge < band->y + band->height; row++)
        for (int column = band->x / edge; column * edge < band->x + band->width; column++)
            t->note[row * t->columns + column] = tile_of(&c, row, column);
}
