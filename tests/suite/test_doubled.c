/* SPDX-License-Identifier: MIT */
/* test_doubled.c - desc.display.doubled: a display shows what it would show undoubled, each pixel as often as it should;
 * and frames of SMEAR_DITHER_DIFFUSE are the same bits however they are drawn and sent. */
#include "smear_overlay.h"

#include "tests/rig.h"

enum { WIDTH = 45, HEIGHT = 38, FRAMES = 3, WORDS = 2 * WIDTH * 2 * HEIGHT };

/* What a display of the format shows. */
struct panel {
    smear_format format;
    int width;
    uint32_t word[WORDS];       /* one for each pixel */
    uint32_t sent;
    smear_context *ctx;
    bool reports;               /* each band counts as sent at once */
};

static int bits_of(smear_format format)
{
    switch (format) {
    case SMEAR_XRGB8888: return 32;
    case SMEAR_RGB565: case SMEAR_RGB565_SWAPPED: case SMEAR_RGB555: return 16;
    case SMEAR_L4: return 4;
    case SMEAR_L1: case SMEAR_L1_PAGES: return 1;
    default: return 8;
    }
}

/* Returns pixel (x, y) of rows of `width` pixels. */
static uint32_t pixel_of(const uint8_t *bytes, uint32_t stride, smear_format format, int x, int y)
{
    const int bits = bits_of(format);
    uint32_t pixel = 0;
    if (format == SMEAR_L1_PAGES)
        return bytes[(uint32_t)(y / 8) * stride + (uint32_t)x] >> (y % 8) & 1u;
    bytes += (uint32_t)y * stride + (uint32_t)(x * bits / 8);
    if (bits < 8)
        return (uint32_t)*bytes >> (8 - bits - x * bits % 8) & ((1u << bits) - 1u);
    memcpy(&pixel, bytes, (size_t)bits / 8);
    return pixel;
}

static uint32_t *word_at(struct panel *p, int x, int y)
{
    return &p->word[y * p->width + x];
}

static int show(void *user, const smear_band *band)
{
    struct panel *p = user;
    const int rows = p->format == SMEAR_L1_PAGES ? (band->height + 7) / 8 : band->height;
    CHECK_EQ(band->stride, (uint32_t)(p->format == SMEAR_L1_PAGES ? band->width : (band->width * bits_of(p->format) + 7) / 8));
    CHECK_EQ(band->size, band->stride * (uint32_t)rows);
    if (CHECK(band->x + band->width <= p->width && band->y + band->height <= 2 * HEIGHT))
        for (int y = 0; y < band->height; y++)
            for (int x = 0; x < band->width; x++)
                *word_at(p, band->x + x, band->y + y) = pixel_of(band->pixels, band->stride, p->format, x, y);
    p->sent += (uint32_t)(band->width * band->height);
    if (p->reports)
        smear_band_done(p->ctx);
    return 0;
}

/* A context and its display. */
struct shown {
    struct panel panel;
    void *memory;
    smear_stats stats;
};

static bool shown_begin(struct shown *s, smear_desc desc)
{
    *s = (struct shown){ .panel = { .format = (smear_format)desc.format, .reports = desc.bands == 2 } };
    s->panel.width = WIDTH << (desc.display.doubled & 1);
    desc.flush = show;
    desc.user = &s->panel;
    const size_t bytes = smear_memory_size(&desc);
    s->memory = malloc(bytes + GUARD);
    memset(s->memory, PATTERN, bytes + GUARD);
    return CHECK(bytes != 0) && CHECK_EQ(smear_init(&s->panel.ctx, &desc, s->memory, bytes), SMEAR_OK);
}

static void shown_end(struct shown *s, const smear_desc *desc)
{
    const uint8_t *guard = (const uint8_t *)s->memory + smear_memory_size(desc);
    for (int i = 0; i < GUARD; i++)
        CHECK_EQ(guard[i], PATTERN);
    free(s->memory);
}

/* The busy scene, of which the ground stands still; a box over it. */
static void draw(struct shown *s, int frame, int method)
{
    static const smear_overlay_item box = { .x = 5, .y = 9, .width = 17, .height = 3, .color = { 255, 255, 0, 255 } };
    static const smear_overlay overlay = { &box, 1, NULL };
    struct scene scene;
    make_scene(&scene, 0.1 * (frame < 2 ? frame : 1), method);
    scene.frame.overlay = &overlay;
    scene.frame.target = SMEAR_BALANCED;
    s->panel.sent = 0;
    CHECK_EQ(smear_begin(s->panel.ctx, &scene.frame), SMEAR_OK);
    for (int i = 0; i < SCENE_DRAWS; i++)
        CHECK_EQ(smear_submit(s->panel.ctx, &scene.draw[i]), SMEAR_OK);
    CHECK_EQ(smear_render(s->panel.ctx), SMEAR_OK);
    smear_get_stats(s->panel.ctx, &s->stats);
}

/* Both contexts draw the same frames. */
static void check_doubled(smear_desc desc, int method, int doubled)
{
    static struct shown once, twice;
    const int dx = doubled & 1, dy = doubled >> 1;
    smear_desc other = desc;
    other.display.doubled = (uint8_t)doubled;
    const bool made = shown_begin(&once, desc);
    if (shown_begin(&twice, other) && made)
        for (int frame = 0; frame < FRAMES; frame++) {
            draw(&once, frame, method);
            draw(&twice, frame, method);
            CHECK_EQ(twice.panel.sent, once.panel.sent << (dx + dy));
            CHECK_EQ(twice.stats.tiles_kept, once.stats.tiles_kept);
            int wrong = 0;
            for (int y = 0; y < HEIGHT << dy; y++)
                for (int x = 0; x < WIDTH << dx; x++)
                    wrong += *word_at(&twice.panel, x, y) != *word_at(&once.panel, x >> dx, y >> dy);
            CHECK_EQ(wrong, 0);
        }
    shown_end(&once, &desc);
    shown_end(&twice, &other);
}

static smear_desc desc_of(int format, unsigned set)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = (uint8_t)format, .tile = 8, .methods = (uint16_t)set,
                         .debug.crc = 1 };
}

static void test_every_format_is_doubled(void)
{
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++)
        for (int doubled = SMEAR_DOUBLED_X; doubled <= SMEAR_DOUBLED_XY; doubled++)
            for (int dither = SMEAR_DITHER_ORDERED; dither <= (format >= SMEAR_L4 ? SMEAR_DITHER_DIFFUSE : SMEAR_DITHER_BLUE); dither++) {
                smear_desc desc = desc_of(format, SMEAR_SET(SMEAR_AUTO));
                desc.display.dither = (uint8_t)dither;
                desc.bands = (uint8_t)(1 + dither % 2);
                check_doubled(desc, SMEAR_AUTO, doubled);
            }
}

static void test_pictures_of_every_method_are_doubled(void)
{
    const unsigned all = SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET_FILTERS | SMEAR_SET(SMEAR_ACCUMULATE);
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++) {
        check_doubled(desc_of(SMEAR_RGB565, all), method, SMEAR_DOUBLED_XY);
        check_doubled(desc_of(SMEAR_L1_PAGES, all), method, SMEAR_DOUBLED_XY);
    }
}

/* Bands lower than tiles; pixels that are drawn straight into the band. */
static void test_bands_of_any_height_are_doubled(void)
{
    for (int rows = 2; rows <= 8; rows += 2)
        for (int i = 0; i < 2; i++) {
            smear_desc desc = desc_of(SMEAR_RGB565_SWAPPED, SMEAR_SET(i == 0 ? SMEAR_NONE : SMEAR_RECONSTRUCT));
            desc.band_rows = (int16_t)rows;
            desc.display.dither = SMEAR_DITHER_NONE;
            if (i == 0 || 8 % rows == 0)
                check_doubled(desc, i == 0 ? SMEAR_NONE : SMEAR_RECONSTRUCT, SMEAR_DOUBLED_XY);
        }
}

static void test_a_display_that_keeps_its_picture_is_doubled(void)
{
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++)
        for (int doubled = SMEAR_DOUBLED_X; doubled <= SMEAR_DOUBLED_XY; doubled++) {
            smear_desc desc = desc_of(format, SMEAR_SET(SMEAR_AUTO));
            desc.reuse.buffer_age = 1;
            desc.bands = (uint8_t)(1 + doubled % 2);
            check_doubled(desc, SMEAR_AUTO, doubled);
        }
}

static void test_diffusion_is_refused_where_it_cannot_be(void)
{
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++) {
        smear_desc desc = desc_of(format, SMEAR_SET(SMEAR_AUTO));
        desc.flush = show;
        desc.display.dither = SMEAR_DITHER_DIFFUSE;
        CHECK_EQ(smear_memory_size(&desc) != 0, format >= SMEAR_L4);
        desc.reuse.buffer_age = 1;
        CHECK(smear_memory_size(&desc) == 0);
    }
}

#include "build/suites/doubled.h"
