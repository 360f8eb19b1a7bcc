/* SPDX-License-Identifier: MIT */
/* test_overlay.c - boxes, sprites and text lie over the picture that is drawn without them: in every format, whatever the
 * method, the band, the tile and the display's memory are. Host only. */
#include "smear_overlay.h"

#include "base/pixel.h"
#include "display/pixel_format.h"

#include "tests/rig.h"

enum { WIDTH = 104, HEIGHT = 72, PIXELS = WIDTH * HEIGHT, ITEMS = 11 };

/* ------------------------------------------------------------------ items of every kind */

static const uint8_t mask4[] = { 0x0f, 0x80, 0xff, 0x10, 0x37, 0xc0 };        /* 3 x 3 */
static const uint8_t palette4[] = { 0x01, 0x20, 0x12, 0x00, 0x20, 0x10, 0x02, 0x10 };    /* two cells of 3 x 2 */
static const uint8_t palette8[] = { 3, 0, 3, 1, 2, 3 };                        /* 2 x 3 */
static const uint32_t colors[256] = { 0, 0xffff2000, 0x8020c0ff, 0xff40ff40 };
static const smear_image images[3] = {
    { mask4, NULL, 3, 3, 0, SMEAR_IMAGE_MASK4 }, { palette4, colors, 3, 2, 2, SMEAR_IMAGE_PALETTE4 },
    { palette8, colors, 2, 3, 1, SMEAR_IMAGE_PALETTE8 }
};

/* Text that begins beyond the left side and ends beyond the right, items of each format, boxes in and out of the frame. */
static void make_items(smear_overlay_item item[ITEMS])
{
    static const smear_overlay_item all[ITEMS] = {
        { .x = -13, .y = 3, .text = "Lap 12: 0'59\"71 of 24", .font = &smear_font_8x8, .color = { 255, 220, 40, 255 } },
        { .x = 20, .y = 28, .text = "gap \x90 {x}", .font = &smear_font_6x8, .scale = 2, .color = { 40, 90, 255, 150 } },
        { .x = 5, .y = 13, .image = &images[0], .scale = 3, .color = { 255, 0, 90, 200 } },
        { .x = 50, .y = 12, .image = &images[1], .cell = 1, .scale = 4 },
        { .x = 101, .y = 60, .image = &images[2], .scale = 5, .color = { 0, 0, 0, 190 } },
        { .x = -20, .y = 64, .width = 300, .height = 3, .color = { 0, 0, 0, 128 } },
        { .x = 30, .y = -4, .width = 9, .height = 5, .scale = 8, .color = { 200, 30, 30, 255 } },
        { .x = 60, .y = 60, .width = 7, .height = 40 },
        { .x = 300, .y = 10, .width = 10, .height = 10 },
        { .x = -32768, .y = -32768, .text = "far", .font = &smear_font_8x8, .scale = 8 },
        { .x = 10, .y = 50, .text = "", .font = &smear_font_6x8 }
    };
    memcpy(item, all, sizeof all);
}

/* ------------------------------------------------------------------ what should be seen, pixel by pixel */

static uint32_t color_of(const smear_overlay_item *item)
{
    const uint8_t *c = item->color;
    return c[3] == 0 ? 0xffffffffu : (uint32_t)c[3] << 24 | (uint32_t)c[0] << 16 | (uint32_t)c[1] << 8 | c[2];
}

/* 0xAARRGGBB of a pixel of an image. */
static uint32_t image_at(const smear_image *m, int cell, int x, int y, uint32_t own)
{
    const int bits = m->format == SMEAR_IMAGE_MASK1 ? 1 : m->format == SMEAR_IMAGE_PALETTE8 ? 8 : 4;
    const int stride = (m->width * bits + 7) / 8, bit = x * bits;
    const uint32_t code = (uint32_t)m->pixels[(cell * m->height + y) * stride + bit / 8] >> (8 - bits - bit % 8) & ((1u << bits) - 1u);
    if (m->format == SMEAR_IMAGE_MASK1)
        return code != 0 ? own : 0;
    const uint32_t color = m->format == SMEAR_IMAGE_MASK4 ? (own & 0xffffffu) | code * 255u / 15u << 24 : m->palette[code];
    return (color & 0xffffffu) | ((color >> 24) * (own >> 24) * 2u + 255u) / 510u << 24;
}

static uint32_t item_at(const smear_overlay_item *item, int x, int y)
{
    const int scale = item->scale != 0 ? item->scale : 1;
    const uint32_t own = color_of(item);
    if (x < item->x || y < item->y)
        return 0;
    x = (x - item->x) / scale;
    y = (y - item->y) / scale;
    if (item->text == NULL && item->image == NULL)
        return x < item->width && y < item->height ? own : 0;
    const smear_image *m = item->text != NULL ? &item->font->glyph : item->image;
    int cell = item->cell;
    if (item->text != NULL) {
        const int letter = x / item->font->advance;
        if (letter >= (int)strlen(item->text))
            return 0;
        cell = (uint8_t)item->text[letter] - item->font->first;
        x -= letter * item->font->advance;
        if (cell < 0 || cell >= m->cells)
            return 0;
    }
    return x < m->width && y < m->height ? image_at(m, cell, x, y, own) : 0;
}

static void draw_over(uint32_t *picture, const smear_overlay *overlay, bool linear)
{
    for (int i = 0; i < overlay->count; i++)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                const uint32_t argb = item_at(&overlay->item[i], x, y);
                picture[y * WIDTH + x] = pixel_blend(picture[y * WIDTH + x], argb, argb >> 24, linear);
            }
}

/* ------------------------------------------------------------------ whole frames */

static smear_desc desc_of(int format, int dither)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .format = (uint8_t)format, .display.dither = (uint8_t)dither, .tile = 8,
                         .reach = 6, .methods = (uint16_t)(SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET_FILTERS
                                                           | SMEAR_SET(SMEAR_NONE) | SMEAR_SET(SMEAR_ACCUMULATE)) };
}

/* The second of two frames of the busy scene, as bands after each other; the caller frees it. */
static uint8_t *picture_of(const smear_desc *desc, int method, const smear_overlay *overlay, bool linear)
{
    struct rig r;
    uint8_t *picture = NULL;
    if (rig_begin(&r, desc, false))
        for (int i = 0; i < 2; i++) {
            struct scene s;
            make_scene(&s, 0.1 * i, method);
            s.frame.overlay = overlay;
            s.frame.target = SMEAR_BALANCED;        /* by default that of a format */
            s.frame.light_space = linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED;
            free(picture);
            picture = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
        }
    CHECK(guards_intact(&r));
    rig_end(&r);
    return picture;
}

static void check_over(int method, int format, int dither, const smear_overlay *overlay, bool linear)
{
    static uint8_t want[PIXELS * 4];
    const smear_desc plain = desc_of(SMEAR_XRGB8888, SMEAR_DITHER_NONE), own = desc_of(format, dither);
    const uint32_t stride = smear_format_stride(WIDTH, (smear_format)format);
    uint8_t *without = picture_of(&plain, method, NULL, linear), *with = picture_of(&own, method, overlay, linear);
    if (CHECK(without != NULL && with != NULL)) {
        uint32_t *pixels = (uint32_t *)(void *)without;
        draw_over(pixels, overlay, linear);
        memset(want, 0, sizeof want);
        for (int y = 0; y < HEIGHT; y++)
            smear_format_row(want, stride, pixels + y * WIDTH, WIDTH, 0, y, 0, (smear_format)format, (smear_dither)dither);
        CHECK(memcmp(with, want, smear_format_size(WIDTH, HEIGHT, (smear_format)format)) == 0);
    }
    free(without);
    free(with);
}

static void test_items_lie_over_the_picture_of_every_method(void)
{
    smear_overlay_item item[ITEMS];
    const smear_overlay overlay = { item, ITEMS, NULL };
    make_items(item);
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++)
        for (int linear = 0; linear < 2; linear++)
            check_over(method, SMEAR_XRGB8888, SMEAR_DITHER_NONE, &overlay, linear != 0);
}

static void test_items_are_converted_as_the_picture_is(void)
{
    smear_overlay_item item[ITEMS];
    const smear_overlay overlay = { item, ITEMS, NULL };
    make_items(item);
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++)
        for (int dither = SMEAR_DITHER_ORDERED; dither <= SMEAR_DITHER_BLUE; dither++) {
            check_over(SMEAR_AUTO, format, dither, &overlay, true);
            check_over(SMEAR_RECONSTRUCT, format, dither, &overlay, false);
        }
}

/* Rows that nothing lies over go straight into the band, the others through the window. */
static void test_frames_of_the_displays_own_pixels_have_items(void)
{
    smear_overlay_item item[ITEMS];
    const smear_overlay overlay = { item, ITEMS, NULL };
    make_items(item);
    for (int rows = 8; rows <= HEIGHT; rows += 16)
        for (int i = 0; i < 2; i++) {
            const smear_desc plain = desc_of(SMEAR_RGB565_SWAPPED, SMEAR_DITHER_NONE);
            smear_desc direct = plain;
            direct.methods = SMEAR_SET(SMEAR_NONE);
            direct.reach = 0;
            direct.band_rows = (int16_t)rows;
            const smear_overlay *some = i == 0 ? &overlay : NULL;
            uint8_t *want = picture_of(&plain, SMEAR_NONE, some, true), *got = picture_of(&direct, SMEAR_NONE, some, true);
            CHECK(want != NULL && got != NULL && memcmp(want, got, PIXELS * 2) == 0);
            free(want);
            free(got);
        }
}

/* ------------------------------------------------------------------ a display that keeps what it is sent */

/* What changes in frame `i`: nothing in most; a text in place, a cell, a colour, the order, a place, a number of items. */
static void change(smear_overlay_item item[ITEMS], smear_overlay *overlay, char text[8], int i)
{
    const smear_overlay_item swapped = item[6];
    switch (i) {
    case 3: text[3] = '7'; break;
    case 5: item[3].cell = 0; break;
    case 7: item[5].color[2] = 90; break;
    case 9: item[6] = item[7], item[7] = swapped; break;
    case 11: item[2].x = 60; break;
    case 13: overlay->count = 3; break;
    case 15: overlay->count = ITEMS; break;
    default: break;
    }
}

static void test_a_panel_is_sent_the_tiles_over_which_something_else_lies(void)
{
    smear_overlay_item item[ITEMS];
    smear_overlay overlay = { item, ITEMS, NULL };
    char text[8] = "TIME 12";
    make_items(item);
    item[0].text = text;
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .tile = 8, .flush = place_band };
    RIG(whole, &desc, false);
    desc.reuse.buffer_age = 1;
    desc.reuse.cache_static = 1;
    RIG(kept, &desc, false);
    for (int i = 0; i < 17; i++) {
        struct scene s;
        make_scene(&s, 0, SMEAR_AUTO);
        change(item, &overlay, text, i);
        s.frame.overlay = i == 16 ? NULL : &overlay;
        kept.sent = 0;
        CHECK_EQ(rig_frame(&whole, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK_EQ(rig_frame(&kept, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK(memcmp(kept.picture, whole.picture, PIXELS * 4) == 0);
        const bool changed = (i >= 3 && (i & 1) != 0) || i == 16;
        CHECK(i < 2 || (kept.sent != 0) == changed);
        CHECK(i < 2 || i > 8 || kept.sent < PIXELS / 2);
        CHECK(i != 3 || kept.sent <= 4 * 64);       /* one letter, of at most two by two tiles */
    }
}

#include "build/suites/overlay.h"
