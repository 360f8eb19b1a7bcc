/* SPDX-License-Identifier: MIT */
/* lane.c - see lane.h. */
#include "tools/view/lane.h"

#include "tools/view/clock.h"

#include "tools/options/say.h"

#include <stdlib.h>

static void note_band(void *user, const smear_band *band)
{
    struct lane *lane = user;
    if (lane->device.is_timed)
        return;
    const smear_doubled doubled = lane->options.doubled;
    smear_band drawn = *band;
    drawn.x = (int16_t)(band->x >> (doubled & SMEAR_DOUBLED_X));
    drawn.y = (int16_t)(band->y >> (doubled >> 1));
    drawn.height = (int16_t)(band->height >> (doubled >> 1));
    drawn.width = (int16_t)(band->width >> (doubled & SMEAR_DOUBLED_X));
    tiles_note(&lane->tiles, lane->device.ctx, &drawn);
    if (lane->band_count == LANE_MAX_BANDS)
        return;
    lane->band[lane->band_count++] = (struct lane_band){ drawn.x, drawn.y, drawn.width, drawn.height };
}

/* What lane_open makes anew. The rest of a lane is options and a list of bands, 33 of its 34 kB: a recording with a
 * million keys would do little but copy them. */
struct parts {
    struct setup setup;
    struct device device;
    struct panel_codes codes;
    uint32_t *picture;
    struct tiles tiles;
};

/* The lane's parts; it has none after that. */
static struct parts take_parts(struct lane *lane)
{
    const struct parts parts = { lane->setup, lane->device, lane->codes, lane->picture, lane->tiles };
    lane->setup = (struct setup){ .motion = NULL };
    lane->device = (struct device){ .ctx = NULL };
    lane->codes = (struct panel_codes){ 0 };
    lane->picture = NULL;
    lane->tiles = (struct tiles){ 0 };
    return parts;
}

static void put_parts(struct lane *lane, const struct parts *parts)
{
    lane->setup = parts->setup;
    lane->device = parts->device;
    lane->codes = parts->codes;
    lane->picture = parts->picture;
    lane->tiles = parts->tiles;
}

static void close_parts(struct parts *parts)
{
    device_close(&parts->device);
    panel_codes_close(&parts->codes);
    tiles_close(&parts->tiles);
    setup_release(&parts->setup);
    free(parts->picture);
}

static bool open_parts(struct lane *lane, const struct render_options *options, struct failure *f)
{
    struct device_setup setup = setup_device(&lane->setup, options);
    size_t pixels = (size_t)lane->setup.width * (size_t)lane->setup.height;
    setup.band = note_band;
    setup.band_user = lane;
    lane->picture = calloc(pixels, sizeof *lane->picture);
    if (lane->picture == NULL)
        return fail(f, "out of memory");
    return tiles_open(&lane->tiles, lane->setup.width, lane->setup.height, f) &&
           device_open(&lane->device, &setup, f) &&
           panel_codes_open(&lane->codes, options->format, f);
}

bool lane_open(struct lane *lane, const struct render_options *options, struct source *source,
               struct failure *f)
{
    struct parts old = take_parts(lane);
    bool ok = setup_open(options, source, &lane->setup) == STATUS_OK || fail(f, "these settings do not go together");
    ok = ok && open_parts(lane, options, f);
    if (ok) {
        lane->options = *options;
        lane->stats = (smear_stats){ 0 };
        lane->band_count = 0;
        lane->is_open = true;
        close_parts(&old);
        return true;
    }
    struct parts failed = take_parts(lane);
    close_parts(&failed);
    put_parts(lane, &old);
    return false;
}

void lane_close(struct lane *lane)
{
    struct parts parts = take_parts(lane);
    if (lane->is_open)
        close_parts(&parts);
    *lane = (struct lane){ .is_open = false };
}

const struct presented *lane_present(const struct lane *lane, struct presenter *presenter,
                                     const struct instant *instant, struct failure *f)
{
    struct present_options options = setup_frame(&lane->setup, &lane->options, instant->frame);
    options.fps /= instant->frames_apart;
    return presenter_frame(presenter, instant->time, &options, f);
}

/* The display's codes, of doubled pixels each once. */
static bool decode(struct lane *lane, struct failure *f)
{
    const struct device *d = &lane->device;
    const int width = lane->setup.width, height = lane->setup.height;
    uint32_t *codes = lane->picture;
    if (lane->options.doubled != SMEAR_DOUBLED_NONE)
        codes = malloc((size_t)d->width * (size_t)d->height * sizeof *codes);
    if (codes == NULL)
        return fail(f, "out of memory");
    const bool ok = panel_decode(&lane->codes, d->pixels, d->stride, d->width, d->height, codes, f);
    if (codes == lane->picture)
        return ok;
    uint32_t *out = lane->picture;
    for (int y = 0; ok && y < height; y++)
        for (int x = 0; x < width; x++)
            *out++ = codes[(size_t)(y * d->height / height) * (size_t)d->width + (size_t)(x * d->width / width)];
    free(codes);
    return ok;
}

bool lane_draw(struct lane *lane, struct presenter *presenter, const struct instant *instant,
               struct failure *f)
{
    double start = clock_us();
    const struct presented *presented = lane_present(lane, presenter, instant, f);
    if (presented == NULL || !device_fit(&lane->device, presented, f))
        return false;
    lane->band_count = 0;
    tiles_begin(&lane->tiles);
    if (!device_draw(&lane->device, presented, f))
        return false;
    smear_get_stats(lane->device.ctx, &lane->stats);
    if (lane->options.keep_display)         /* not of what was sent, but of what is shown */
        lane->stats.crc32 = device_crc(&lane->device);
    bool ok = decode(lane, f);
    lane->wall_us = clock_us() - start;
    return ok;
}
