/* SPDX-License-Identifier: MIT */
/* test_memory.c - SMEAR_MEMORY against smear_memory_size(), and SMEAR_DESC, over thousands of descs. */
#include "tests/test.h"

#include <smear_memory.h>
#include <stdio.h>
#include <string.h>

void suite_memory(void);

static const uint16_t sets[] = {
    0, SMEAR_SET(SMEAR_NONE), SMEAR_SET(SMEAR_ACCUMULATE), SMEAR_SET_ACCUMULATE_BANDS, SMEAR_SET(SMEAR_RECONSTRUCT),
    SMEAR_SET(SMEAR_CAMERA), SMEAR_SET(SMEAR_PINGPONG), SMEAR_SET(SMEAR_HALF), SMEAR_SET_FILTERS, SMEAR_SET(SMEAR_SUBFRAMES),
    SMEAR_SET(SMEAR_TIMEMASK), SMEAR_SET(SMEAR_AUTO), SMEAR_SET_TEMPORAL, SMEAR_SET(SMEAR_OBJECT), SMEAR_SET(SMEAR_LAYERED),
    SMEAR_SET_LAYERS, SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), SMEAR_SET_LAYERS | SMEAR_SET_FILTERS,
    SMEAR_SET_FILTERS | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_ACCUMULATE)
};
enum { SETS = sizeof sets / sizeof *sets };

static uint32_t random_state = 1;

static int pick(int low, int high)
{
    random_state = random_state * 1664525u + 1013904223u;
    return low + (int)(random_state >> 8) % (high - low + 1);
}

/* Tile, reach, strip and rows of a band that go together with the methods. */
static void pick_geometry(smear_desc *d, bool has_reach, bool is_temporal, bool has_window_alone)
{
    d->tile = (int16_t)(pick(0, 2) == 0 ? 0 : 8 << pick(0, 3));
    if (has_window_alone && d->format != SMEAR_L1_PAGES && pick(0, 7) == 0)
        d->tile = 4;
    if (d->tile == 0) {
        d->reach = (int16_t)pick(0, 64);
        return;
    }
    d->reach = (int16_t)(d->filter.scatter ? pick(1, 64) : pick(1, d->tile));
    if (is_temporal && pick(0, 1))
        d->strip = (int16_t)(d->tile * pick(1, 32));
    if (has_window_alone && d->format != SMEAR_L1_PAGES && pick(0, 1))
        d->band_rows = (int16_t)(d->tile / 2);
    if (!has_reach && !is_temporal)
        d->band_rows = (int16_t)(8 * pick(0, 10));
}

static smear_desc pick_desc(uint16_t methods)
{
    static const int16_t size[][2] = { { 1, 1 }, { 7, 5 }, { 33, 17 }, { 96, 64 }, { 128, 64 }, { 240, 240 }, { 321, 479 },
                                       { 640, 480 }, { 2048, 3 }, { 3, 2048 } };
    static const uint32_t triangles[] = { 0, 1, 7, 200, 600, 5000, 100000 };
    static const uint16_t draws[] = { 0, 1, 4, 8, 255, 65535 };
    const uint16_t all = methods != 0 ? methods : SMEAR_SET(SMEAR_AUTO);
    const bool is_temporal = (all & SMEAR_SET_TEMPORAL) != 0, has_layers = (all & SMEAR_SET_LAYERS) != 0;
    const bool has_window = (all & SMEAR_SET_FILTERS) != 0, is_plain = !is_temporal && !has_layers;
    const bool has_ports = (all & (SMEAR_SET(SMEAR_PINGPONG) | SMEAR_SET(SMEAR_HALF))) != 0;
    const int16_t *s = size[pick(0, 9)];
    smear_desc d = { .width = s[0], .height = s[1], .methods = methods, .max_triangles = triangles[pick(0, 6)],
                     .max_draws = draws[pick(0, 5)], .bands = (uint8_t)pick(0, 2), .format = (uint8_t)pick(0, SMEAR_L1_PAGES),
                     .workers = (uint8_t)pick(0, 8), .vertex_cache = (uint16_t)(pick(0, 1) ? 16 << pick(0, 8) : 0) };
    if (is_temporal && pick(0, 2) == 0) {
        d.reuse.cache_static = (uint8_t)pick(0, 1);
        d.reuse.buffer_age = (uint8_t)pick(0, 7);
    }
    if ((all & SMEAR_SET(SMEAR_PINGPONG)) != 0)
        d.filter.passes = (uint8_t)pick(0, 3);
    d.reuse.one_pose = (uint8_t)(d.width & 1);
    if (d.format >= SMEAR_L4 && d.reuse.buffer_age == 0 && d.height % 2 == 0)
        d.display.dither = SMEAR_DITHER_DIFFUSE;
    d.filter.scatter = has_window && is_plain && !has_ports && pick(0, 2) == 0;
    pick_geometry(&d, has_window || has_layers, is_temporal,
                  has_window && is_plain && (all & SMEAR_SET(SMEAR_HALF)) == 0 && !d.filter.scatter);
    if (methods == SMEAR_SET(SMEAR_NONE) && d.display.dither != SMEAR_DITHER_DIFFUSE && d.tile != 4) {
        d.reuse.buffer_age = (uint8_t)(pick(0, 1) * pick(1, 7));
        d.band_rows = d.reuse.buffer_age != 0 ? 0 : d.band_rows;
    }
    return d;
}

#define VALUES(d) (d).width, (d).height, (d).max_triangles, (d).max_draws, (d).methods, (d).tile, (d).reach, (d).strip, \
    (d).band_rows, (d).bands, (d).format, (d).workers, (d).vertex_cache, (d).reuse.cache_static, (d).reuse.buffer_age, \
                  (d).filter.passes, (d).filter.scatter, (d).reuse.one_pose, (d).display.dither

static void describe(const smear_desc *d, size_t room, size_t need)
{
    char text[300];
    snprintf(text, sizeof text, "  %d x %d, methods %#x, tile %d, reach %d, strip %d, band_rows %d, bands %d, format %d, workers"
             " %d, cache %d, reuse %d %d, passes %d, scatter %d, %u triangles, %d draws: %zu of %zu\n", d->width, d->height,
             (unsigned)d->methods, d->tile, d->reach, d->strip, d->band_rows, d->bands, d->format, d->workers,
             d->vertex_cache, d->reuse.cache_static, d->reuse.buffer_age, d->filter.passes, d->filter.scatter,
             (unsigned)d->max_triangles, d->max_draws, need, room);
    test_print(text);
}

/* What smear_memory.h says. */
enum { SLACK = 64 };

static void test_the_macro_is_never_below_the_function_and_little_above_it(void)
{
    random_state = 1;
    for (int n = 0; n < 40000; n++) {
        const smear_desc d = pick_desc(sets[n % SETS]);
        const size_t room = SMEAR_MEMORY(VALUES(d)), need = smear_memory_size(&d);
        if (!CHECK(need > 0 && need <= room && room <= need + SLACK)) {
            describe(&d, room, need);
            return;
        }
    }
}

static void test_a_desc_of_the_same_values_has_them(void)
{
    random_state = 2;
    for (int n = 0; n < 2000; n++) {
        const smear_desc d = pick_desc(sets[n % SETS]), made = SMEAR_DESC(VALUES(d));
        CHECK(memcmp(&d.reuse, &made.reuse, sizeof d.reuse) == 0 && memcmp(&d.filter, &made.filter, sizeof d.filter) == 0);
        CHECK(d.width == made.width && d.height == made.height && d.max_triangles == made.max_triangles
              && d.max_draws == made.max_draws && d.methods == made.methods && d.tile == made.tile && d.reach == made.reach
              && d.strip == made.strip && d.band_rows == made.band_rows && d.bands == made.bands && d.format == made.format
              && d.workers == made.workers && d.vertex_cache == made.vertex_cache);
        CHECK(made.display.dither == d.display.dither && made.flush == NULL && made.idle == NULL && made.user == NULL && made.debug.crc == 0
              && made.debug.inspect == NULL && made.debug.clock == NULL);
        CHECK(smear_memory_size(&d) == smear_memory_size(&made));
    }
}

#define SHORT 240, 240, 600, 8

static void test_values_that_are_left_out_are_defaults(void)
{
    static uint64_t memory[SMEAR_MEMORY_WORDS(SHORT)];      /* each expands to a megabyte: CHECK would have it twice */
    static const size_t room = SMEAR_MEMORY(SHORT);
    static const size_t same = SMEAR_MEMORY(SHORT, SMEAR_SET(SMEAR_AUTO), 16, 0, 128, 16, 1, SMEAR_XRGB8888, 1, 64);
    const smear_desc made = SMEAR_DESC(SHORT);
    const smear_desc want = { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8 };
    CHECK(smear_memory_size(&made) == smear_memory_size(&want));
    CHECK(sizeof memory >= smear_memory_size(&want) && sizeof memory / 8 == (room + 7) / 8);
    CHECK(room == same);
}

/* What small boards have for it. */
static void test_small_settings_stay_small(void)
{
    const smear_desc automatic = { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .tile = 8, .strip = 8,
                                   .format = SMEAR_RGB565 };
    const smear_desc sharp = { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 8, .tile = 8,
                               .methods = SMEAR_SET(SMEAR_NONE), .format = SMEAR_RGB565 };
    /* Of small machines, where pointers have 4 bytes: a context has some 71, a draw 12. */
    CHECK(smear_memory_size(&automatic) - (sizeof(void *) - 4) * (71 + 8 * 12) <= 74u * 1024u);
    CHECK(smear_memory_size(&sharp) <= 45u * 1024u);
}

void suite_memory(void)
{
    RUN(test_the_macro_is_never_below_the_function_and_little_above_it);
    RUN(test_a_desc_of_the_same_values_has_them);
    RUN(test_values_that_are_left_out_are_defaults);
    RUN(test_small_settings_stay_small);
}
