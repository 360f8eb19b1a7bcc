/* SPDX-License-Identifier: MIT */
/* memory.c - see memory.h. */
#include "tools/player/memory.h"

#include "tools/player/device.h"

/* What all searches of a command may draw: triangles and, for 16 of them, pixels. */
static const double max_work = 6e6;

/* Draws the frame with room for so many triangles; a method that has too little is not done in one either. */
static bool draws_in_one(struct device *device, const struct presented *presented,
                         uint32_t triangles, smear_stats *stats, double *work, struct failure *f)
{
    struct failure why = { "" };
    if (*work > max_work)
        return fail(f, "its frame takes too long to be measured");
    device->setup.max_triangles = triangles;
    if (!device_fit(device, presented, f))
        return false;
    if (!device_draw(device, presented, &why) && device->result != SMEAR_ERR_ROOM) {
        *f = why;
        return false;
    }
    smear_get_stats(device->ctx, stats);
    *work += (double)presented->triangle_count * (1 + stats->parts_added) + ((double)stats->pixels + stats->samples) / 16;
    stats->parts_added += device->result == SMEAR_ERR_ROOM;
    return true;
}

/* How many triangles' room a frame filled that was drawn with room for `triangles`. */
static uint32_t filled(const smear_stats *stats, uint32_t triangles)
{
    const smear_fill *fill = &stats->fill.geometry;
    return fill->room > 0 ? (uint32_t)(((uint64_t)fill->used * triangles + fill->room - 1) / fill->room) : 0;
}

/* Narrows the interval in which the smallest sufficient list lies, from what the frame filled, in growing steps. Begins with
 * room for all, as many parts take long. */
static bool find_smallest(struct device *device, const struct presented *presented, uint32_t *list,
                          uint32_t *drawn, double *work, struct failure *f)
{
    smear_stats stats;
    uint32_t low = DEVICE_MIN_TRIANGLES, all = 2 * presented->triangle_count, high = all > low ? all : low;
    for (;; high *= 2) {
        if (!draws_in_one(device, presented, high, &stats, work, f))
            return false;
        if (stats.parts_added == 0)
            break;
        low = high + 1;
        if (high > 4 * presented->triangle_count + 64)
            break;                      /* cannot be: clipping makes a few of one, not more */
    }
    *drawn = stats.triangles_drawn;
    uint32_t guess = filled(&stats, high), up = 0, down = 0;
    while (low < high) {
        const uint32_t middle = guess >= low && guess < high ? guess : low + (high - low) / 2;
        if (!draws_in_one(device, presented, middle, &stats, work, f))
            return false;
        if (stats.parts_added == 0) {
            high = middle;
            guess = high - 1 - down;
            down = 2 * down + 1;
        } else {
            low = middle + 1;
            guess = low + up;
            up = 2 * up + 1;
        }
    }
    *list = high;
    return true;
}

/* What the arena is made of. Of some parts: what twice as many would cost more. */
static void split_up(struct memory_need *need, const smear_desc *desc)
{
    smear_desc twice = *desc;
    need->total = smear_memory_size(desc);
    twice.max_triangles *= 2;
    need->triangle_bytes = smear_memory_size(&twice) - need->total;
    twice = *desc;
    twice.max_draws = (uint16_t)(desc->max_draws * 2);
    need->draw_bytes = smear_memory_size(&twice) - need->total;
    size_t row = (size_t)desc->width, bytes_per_pixel = need->reach <= 15 ? 8 : 10;
    const bool has_window = (desc->methods & SMEAR_SET_FILTERS) != 0;
    const bool holds_back = has_window && (desc->methods & SMEAR_SET_TEMPORAL) != 0;    /* a band waits for the row below */
    need->bands = row * 2 * (size_t)need->tile * (holds_back ? 2 : 1);
    if ((desc->methods & SMEAR_SET_SKETCH) != 0)        /* colour and depth, and those of the row that lines have blurred */
        need->window = row * (size_t)(3 * need->tile + need->reach) * 6;
    else
        need->window = has_window ? row * (size_t)(2 * need->tile + need->reach) * bytes_per_pixel
                                  : row * (size_t)need->tile * 6;
    need->rest = need->total - need->triangle_bytes - need->draw_bytes - need->bands - need->window;
}

bool memory_measure(const struct presented *presented, int width, int height,
                    enum memory_setup which, struct memory_need *need, double *work, struct failure *f)
{
    static const struct {
        uint8_t method;
        unsigned set;
    } setups[MEMORY_SETUPS] = {
        [MEMORY_AUTO] = { SMEAR_AUTO, SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH },
        [MEMORY_AUTO_SHARP] = { SMEAR_AUTO, SMEAR_SET(SMEAR_AUTO) },
        [MEMORY_RECONSTRUCT] = { SMEAR_RECONSTRUCT, SMEAR_SET(SMEAR_RECONSTRUCT) },
        [MEMORY_NONE] = { SMEAR_NONE, SMEAR_SET(SMEAR_NONE) },
    };
    struct device device;
    struct device_setup setup = { .width = width, .height = height, .threads = 1,
                                  .format = SMEAR_RGB565 };
    struct presented drawn = *presented;
    drawn.frame.method = setups[which].method;
    setup.methods = setups[which].set;
    setup.reach = height / 20 > 0 ? height / 20 : 1;
    setup.tile = setup.reach <= 8 ? 8 : setup.reach <= 16 ? 16 : setup.reach <= 32 ? 32 : 64;
    *need = (struct memory_need){ .reach = setup.reach, .tile = setup.tile };
    bool ok = device_open(&device, &setup, f) &&
              find_smallest(&device, &drawn, &need->triangles, &need->triangles_drawn, work, f);
    if (ok) {
        smear_desc desc = device.desc;
        desc.max_triangles = need->triangles;
        desc.debug.crc = 0;
        need->draws = desc.max_draws;
        split_up(need, &desc);
    }
    device_close(&device);
    return ok;
}
