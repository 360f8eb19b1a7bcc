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

static bool open_parts(struct lane *lane, struct failure *f)
{
    struct device_setup setup = setup_device(&lane->setup, &lane->options);
    size_t pixels = (size_t)lane->setup.width * (size_t)lane->setup.height;
    setup.band = note_band;
    setup.band_user = lane;
    lane->picture = calloc(pixels, sizeof *lane->picture);
    if (lane->picture == NULL)
        return fail(f, "out of memory");
    return tiles_open(&lane->tiles, lane->setup.width, lane->setup.height, f) &&
           device_open(&lane->device, &setup, f) &&
           panel_codes_open(&lane->codes, lane->options.format, f);
}

bool lane_open(struct lane *lane, const struct render_options *options, struct source *source,
               struct failure *f)
{
    struct lane old = *lane;
    *lane = (struct lane){ .options = *options, .is_open = true };
    if (setup_open(&lane->options, source, &lane->setup) != STATUS_OK)
        fail(f, "these settings do not go together");
    else if (open_parts(lane, f)) {
        lane_close(&old);
        return true;
    }
    lane_close(lane);
    *lane = old;
    return false;
}

void lane_close(struct lane *lane)
{
    if (!lane->is_open)
        return;
    device_close(&lane->device);
    panel_codes_close(&lane->codes);
    tiles_close(&lane->tiles);
    setup_release(&lane->setup);
    free(lane->picture);
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
