/* SPDX-License-Identifier: MIT */
/* test_memory.c - SMEAR_MEMORY against smear_memory_size() over thousands of usual descs, and what smear_init says of others. */
#include "tests/test.h"

#include <smear.h>
#include <stdio.h>
#include <stdlib.h>

static uint32_t random_state = 1;

static int pick(int low, int high)
{
    random_state = random_state * 1664525u + 1013904223u;
    return low + (int)(random_state >> 8) % (high - low + 1);
}

static int flush(void *user, const smear_band *band)
{
    (void)user, (void)band;
    return 0;
}

/* Sizes from a pixel to the largest frame, many as displays have them; 0 triangles and draws, too. */
static smear_desc pick_usual(void)
{
    static const int16_t size[][2] = { { 1, 1 }, { 7, 5 }, { 33, 17 }, { 96, 64 }, { 128, 64 }, { 160, 120 }, { 240, 240 },
                                       { 320, 240 }, { 640, 480 }, { 2048, 3 }, { 3, 2048 }, { 2048, 2048 } };
    static const int draws[] = { 0, 1, 4, 8, 255, 65535 };
    const int n = pick(0, 23);
    smear_desc d = { .width = (int16_t)pick(1, 800), .height = (int16_t)pick(1, 600), .max_triangles = (uint32_t)pick(0, 5000),
                     .max_draws = (uint16_t)(pick(0, 1) ? pick(0, 64) : draws[pick(0, 5)]),
                     .format = (uint8_t)pick(0, SMEAR_L1_PAGES), .flush = flush };
    if (n < 12)
        d.width = size[n][0], d.height = size[n][1];
    if (pick(0, 9) == 0)
        d.max_triangles = (uint32_t)pick(0, 200000);
    d.display.dither = (uint8_t)pick(0, SMEAR_DITHER_BLUE);
    return d;
}

/* What smear_memory.h says. */
enum { KILOBYTE = 1024 };

/* Whether `words` are enough for the desc, and at most a kilobyte and the `part`th part of it too many. */
static bool is_tight(const smear_desc *d, size_t words, size_t part, const char *what)
{
    const size_t room = 8 * words, need = smear_memory_size(d);
    char text[200];
    if (CHECK(need > 0 && need <= room && room <= need + need / part + KILOBYTE))
        return true;
    snprintf(text, sizeof text, "  %s: %d x %d, format %d, %u triangles, %d draws, %d bands, %d workers: %zu of %zu\n", what, d->width,
             d->height, d->format, (unsigned)d->max_triangles, d->max_draws, d->bands, d->workers, need, room);
    test_print(text);
    return false;
}

static void test_the_macro_is_enough_for_usual_descs_and_at_most_a_fiftieth_more(void)
{
    random_state = 1;
    for (int n = 0; n < 20000; n++) {
        smear_desc d = pick_usual();
        const size_t any = SMEAR_MEMORY(d.width, d.height, d.max_triangles, d.max_draws);
        const size_t named = SMEAR_MEMORY(d.width, d.height, d.max_triangles, d.max_draws, d.format);
        CHECK(named <= any);
        END_UNLESS(is_tight(&d, named, 50, "named"));
        d.format = SMEAR_XRGB8888;
        END_UNLESS(is_tight(&d, any, 50, "any"));
    }
}

static void test_bands_and_workers_take_what_their_macros_say(void)
{
    random_state = 2;
    for (int n = 0; n < 20000; n++) {
        smear_desc d = pick_usual();
        d.bands = (uint8_t)pick(1, 2);
        d.workers = (uint8_t)pick(1, 8);
        const size_t words = SMEAR_MEMORY(d.width, d.height, d.max_triangles, d.max_draws, d.format)
                           + (size_t)(d.bands - 1) * SMEAR_MEMORY_BAND(d.width, d.height, d.format)
                           + (size_t)(d.workers - 1) * SMEAR_MEMORY_WORKER(d.width, d.height);
        END_UNLESS(is_tight(&d, words, 10, "more"));
    }
}

/* The temporal methods of smear.h take no more than the default does. */
static void test_the_macro_is_enough_for_the_methods_that_are_drawn_alike(void)
{
    static const unsigned sets[] = { SMEAR_SET(SMEAR_SUBFRAMES), SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_NONE),
                                     SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_SUBFRAMES) | SMEAR_SET(SMEAR_NONE) };
    random_state = 3;
    for (int n = 0; n < 6000; n++) {
        smear_desc d = pick_usual();
        d.methods = (uint16_t)sets[n % 3];
        END_UNLESS(is_tight(&d, SMEAR_MEMORY(d.width, d.height, d.max_triangles, d.max_draws, d.format), 10, "alike"));
    }
}

static void test_the_macro_of_sketches_is_enough_and_tight(void)
{
    random_state = 5;
    for (int n = 0; n < 20000; n++) {
        smear_desc d = pick_usual();
        d.methods = (uint16_t)(SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH | (n % 2 != 0 ? SMEAR_SET(SMEAR_NONE) : 0u));
        if (!is_tight(&d, SMEAR_MEMORY_SKETCH(d.width, d.height, d.max_triangles, d.max_draws, d.format), 50, "sketch"))
            return;
        d.format = SMEAR_XRGB8888;
        if (!is_tight(&d, SMEAR_MEMORY_SKETCH(d.width, d.height, d.max_triangles, d.max_draws), 50, "any sketch"))
            return;
    }
}

/* A desc whose memory no macro knows: other methods, tiles, strips, caches. */
static smear_desc pick_special(void)
{
    static const unsigned sets[] = { SMEAR_SET(SMEAR_NONE), SMEAR_SET(SMEAR_RECONSTRUCT), SMEAR_SET_FILTERS, SMEAR_SET_LAYERS,
                                     SMEAR_SET_TEMPORAL, SMEAR_SET_ACCUMULATE_BANDS, SMEAR_SET(SMEAR_ACCUMULATE),
                                     SMEAR_SET_FILTERS | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS };
    smear_desc d = pick_usual();
    d.width = (int16_t)(d.width % 321 + 1), d.height = (int16_t)(d.height % 241 + 1), d.max_triangles %= 1000, d.max_draws &= 63;
    d.methods = (uint16_t)sets[pick(0, 7)];
    d.tile = (int16_t)(8 << pick(1, 3));
    d.reach = (int16_t)pick(1, 16);
    d.vertex_cache = (uint16_t)(16 << pick(0, 6));
    d.workers = (uint8_t)pick(0, 4);
    d.reuse.one_pose = (uint8_t)pick(0, 1);
    if ((d.methods & SMEAR_SET_TEMPORAL) != 0)
        d.strip = (int16_t)(d.tile * pick(1, 8)), d.reuse.cache_static = (uint8_t)pick(0, 1);
    return d;
}

static void test_too_little_memory_is_refused_with_the_bytes_that_are_enough(void)
{
    random_state = 4;
    for (int n = 0; n < 2000; n++) {
        smear_context *ctx;
        const smear_desc d = n % 4 == 0 ? pick_usual() : pick_special();
        if (smear_memory_size(&d) > 4u << 20)
            continue;
        const int refused = smear_init(&ctx, &d, NULL, 0);
        const size_t bytes = smear_memory_needed(refused);
        uint8_t *memory = malloc(bytes);
        REQUIRE(memory != NULL && refused < SMEAR_ERR_NEEDS && bytes == smear_memory_size(&d));
        CHECK_EQ(smear_error_kind(refused), SMEAR_ERR_MEMORY);
        CHECK_EQ(smear_init(&ctx, &d, memory, bytes - 1), refused);
        CHECK(ctx == NULL);
        if (CHECK_EQ(smear_init(&ctx, &d, memory, bytes), SMEAR_OK) && d.workers < 2) {
            const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 1 << 16, .near_plane = 1 << 12 };
            CHECK_EQ(smear_begin(ctx, &(smear_frame){ .camera = &camera }), SMEAR_OK);
            CHECK_EQ(smear_render(ctx), SMEAR_OK);
        }
        free(memory);
    }
    CHECK_EQ((int64_t)smear_memory_needed(SMEAR_ERR_MEMORY), 0);
    CHECK_EQ((int64_t)smear_memory_needed(SMEAR_OK), 0);
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

#include "build/suites/memory.h"
