/* SPDX-License-Identifier: MIT */
/* device.c - see device.h. */
#include "tools/player/device.h"

#include "tools/player/crew.h"
#include "tools/player/picture.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ------------------------------------------------------------------ callbacks */

static uint32_t clock_ticks(void *user)
{
    struct timespec now;
    (void)user;
    if (clock_gettime(CLOCK_MONOTONIC, &now) != 0)
        return 0;
    return (uint32_t)((uint64_t)now.tv_sec * 1000000u * DEVICE_TICKS_PER_US +
                      (uint64_t)now.tv_nsec * DEVICE_TICKS_PER_US / 1000u);
}

static int take_band(void *user, const smear_band *band)
{
    struct device *device = user;
    device->sent += band->size;
    if (!device->is_timed)
        picture_put_band(device->pixels, device->stride, (smear_format)device->desc.format, band);
    if (device->setup.band != NULL)
        device->setup.band(device->setup.band_user, band);
    return 0;
}

static void inspect_row(void *user, int y, const uint32_t *color, const uint16_t *depth,
                        const int32_t *velocity)
{
    const struct device *device = user;
    device->setup.inspect(device->setup.inspect_user, y, color, depth, velocity);
}

/* ------------------------------------------------------------------ room */

bool device_open(struct device *device, const struct device_setup *setup, struct failure *f)
{
    *device = (struct device){ .setup = *setup };
    device->desc.format = (uint8_t)setup->format;
    device->width = setup->width << (setup->doubled & SMEAR_DOUBLED_X);
    device->height = setup->height << (setup->doubled >> 1);
    device->stride = picture_row_bytes(device->width, setup->format);
    size_t rows = setup->format == SMEAR_L1_PAGES ? ((size_t)device->height + 7) / 8
                                                  : (size_t)device->height;
    device->size = device->stride * rows;
    device->pixels = calloc(device->size, 1);
    if (device->pixels == NULL)
        return fail(f, "out of memory");
    if (setup->threads > 1) {
        device->crew = crew_start(setup->threads, f);
        return device->crew != NULL;
    }
    return true;
}

void device_close(struct device *device)
{
    crew_stop(device->crew);
    free(device->pixels);
    free(device->memory);
    *device = (struct device){ .ctx = NULL };
}

static smear_desc full_desc(struct device *device, const struct presented *presented)
{
    const struct device_setup *s = &device->setup;
    smear_desc desc = presented_desc(presented, s->width, s->height);
    if (s->max_triangles > 0)
        desc.max_triangles = s->max_triangles;
    desc.reach = (int16_t)s->reach;
    desc.tile = (int16_t)s->tile;
    desc.format = (uint8_t)s->format;
    desc.display.dither = (uint8_t)s->dither;
    desc.display.doubled = (uint8_t)s->doubled;
    desc.workers = (uint8_t)s->threads;
    desc.methods = (uint16_t)s->methods;
    if ((s->methods & SMEAR_SET_FILTERS) == 0)
        desc.filter.passes = 0;
    desc.filter.scatter = s->scatter;
    present_tiles(&desc, s->arena == 0);
    desc.reuse.cache_static = s->cache_static;
    desc.reuse.buffer_age = s->keep_display;
    desc.debug.crc = 1;
    desc.flush = take_band;
    desc.debug.inspect = s->inspect != NULL ? inspect_row : NULL;
    desc.debug.clock = clock_ticks;
    desc.idle = s->threads > 1 ? crew_idle : NULL;
    desc.user = device;
    return desc;
}

/* The longest list of triangles that leaves the context within the arena. */
static bool fit_arena(smear_desc *desc, size_t arena, struct failure *f)
{
    smear_desc probe = *desc;
    uint32_t low = DEVICE_MIN_TRIANGLES, high = desc->max_triangles;
    if (high < low)
        low = high;
    probe.max_triangles = low;
    size_t least = smear_memory_size(&probe);
    if (least > arena)
        return fail(f, "needs %zu bytes, the arena has %zu (--arena)", least, arena);
    while (low < high) {
        probe.max_triangles = low + (high - low + 1) / 2;
        if (smear_memory_size(&probe) <= arena)
            low = probe.max_triangles;
        else
            high = probe.max_triangles - 1;
    }
    desc->max_triangles = low;
    return true;
}

static bool start_context(struct device *device, struct failure *f)
{
    int result = smear_init(&device->ctx, &device->desc, device->memory, device->memory_bytes);
    if (result == SMEAR_OK)
        return true;
    device->ctx = NULL;
    return fail(f, "the library did not start: %s", smear_error_text(result));
}

/* A context of this desc, in memory that has grown where it must. */
static bool make_context(struct device *device, const smear_desc *desc, struct failure *f)
{
    size_t bytes = smear_memory_size(desc);
    device->desc = *desc;
    device->ctx = NULL;
    if (bytes > device->memory_bytes) {
        free(device->memory);
        device->memory_bytes = 0;
        device->memory = malloc(bytes);
        if (device->memory == NULL)
            return fail(f, "out of memory (%zu bytes)", bytes);
        device->memory_bytes = bytes;
    }
    return start_context(device, f);
}

static bool is_limited(const struct device *device)
{
    return device->setup.arena > 0 || device->setup.max_triangles > 0;
}

/* What is kept from frame to frame would be lost in another context, and drawn again there is less to draw. */
static bool is_drawn_once(const struct device *device)
{
    return device->desc.reuse.cache_static || device->desc.reuse.buffer_age != 0;
}

/* Whether the context may draw what asks for this desc. What limited memory makes of a frame depends on no other one, but
 * where something is kept from frame to frame. */
static bool has_room(const struct device *device, const smear_desc *desc)
{
    const smear_desc *has = &device->desc;
    if (device->ctx == NULL || desc->max_draws > has->max_draws || desc->max_triangles > has->max_triangles)
        return false;
    return !is_limited(device) || is_drawn_once(device)
        || (desc->max_draws == has->max_draws && desc->max_triangles == has->max_triangles);
}

bool device_fit(struct device *device, const struct presented *presented, struct failure *f)
{
    smear_desc desc = full_desc(device, presented);
    if (presented->draw_count > 65535)
        return fail(f, "%d draws are too many for the library (at most 65535)",
                    presented->draw_count);
    if (smear_memory_size(&desc) == 0)
        return fail(f, "%u triangles are too many for the library", presented->triangle_count);
    if (device->setup.arena > 0 && !fit_arena(&desc, device->setup.arena, f))
        return false;
    return has_room(device, &desc) || make_context(device, &desc, f);
}

/* ------------------------------------------------------------------ frames */

static bool draw(struct device *device, const struct presented *presented, uint32_t *submit_ticks,
                 struct failure *f)
{
    uint32_t start = clock_ticks(NULL);
    device->sent = 0;
    int result = presented_submit(presented, device->ctx);
    *submit_ticks = clock_ticks(NULL) - start;
    if (result == SMEAR_OK)
        result = crew_render(device->crew, device->ctx);
    device->result = result;
    return result == SMEAR_OK || fail(f, "the library refused the frame: %s", smear_error_text(result));
}

static bool use_crc(struct device *device, bool crc, struct failure *f)
{
    if ((device->desc.debug.crc != 0) == crc)
        return true;
    device->desc.debug.crc = crc;
    return start_context(device, f);
}

bool device_draw(struct device *device, const struct presented *presented, struct failure *f)
{
    device->is_timed = false;
    if (!use_crc(device, true, f))
        return false;
    for (;;) {
        smear_stats stats;
        const bool is_drawn = draw(device, presented, &device->submit_ticks, f);
        smear_get_stats(device->ctx, &stats);
        smear_desc larger = device->desc;
        larger.max_triangles *= 2;
        /* What does not fit is drawn in parts, or, by a time mask, refused. */
        const bool lacks_room = is_drawn ? stats.parts_added != 0 : device->result == SMEAR_ERR_ROOM;
        if (is_limited(device) || !lacks_room || smear_memory_size(&larger) == 0)
            return is_drawn;
        *f = (struct failure){ "" };
        if (!make_context(device, &larger, f))
            return false;
    }
}

bool device_time(struct device *device, const struct presented *presented,
                 struct device_times *times, struct failure *f)
{
    uint32_t ticks = device->submit_ticks;
    smear_stats stats;
    device->is_timed = true;
    if (!is_drawn_once(device) && (!use_crc(device, false, f) || !draw(device, presented, &ticks, f)))
        return false;
    smear_get_stats(device->ctx, &stats);
    *times = (struct device_times){ .submit = (double)stats.time.submit + ticks,
                                    .raster = stats.time.raster, .reduce = stats.time.reduce,
                                    .blur = stats.time.blur, .convert = stats.time.convert,
                                    .total = (double)stats.time.total + ticks };
    return true;
}

uint32_t device_crc(const struct device *device)
{
    return picture_crc(device->pixels, device->size, (smear_format)device->desc.format);
}

/* A frame without motion goes through the filter unchanged, into the display's format. */
bool device_show(struct device *device, const uint32_t *picture, struct failure *f)
{
    smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 65536 };
    smear_frame frame = { .camera = &camera, .method = SMEAR_RECONSTRUCT };
    size_t width = (size_t)device->setup.width;
    uint32_t *depth = calloc(width, sizeof *depth);
    int16_t *velocity = calloc(width * 2, sizeof *velocity);
    int result = SMEAR_OK;
    bool ok = depth != NULL && velocity != NULL;
    device->is_timed = false;
    if (!ok)
        fail(f, "out of memory");
    if (ok)
        result = smear_filter_begin(device->ctx, &frame);
    for (int y = 0; y < device->setup.height && ok && result == SMEAR_OK; y++)
        result = smear_filter_row(device->ctx, picture + (size_t)y * width, depth, velocity);
    free(depth);
    free(velocity);
    return ok && (result == SMEAR_OK ||
                  fail(f, "the library refused the picture: %s", smear_error_text(result)));
}
