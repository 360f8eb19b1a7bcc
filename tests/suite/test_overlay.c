/* SPDX-License-Identifier: MIT */
/* test_overlay.c - boxes, sprites and text lie over the picture that is drawn without them: in every format, whatever the
 * method, the band, the tile and the display's memory are. Host only. */
#include "smear_overlay.h"

#include "base/pixel.h"
#include "display/pixel_format.h"

#include "tests/rig.h"

#include <math.h>

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
    uint8_t *picture = NULL;
    RIG(r, desc, false);
    for (int i = 0; i < 2; i++) {
        struct scene s;
        make_scene(&s, 0.1 * i, method);
        s.frame.overlay = overlay;
        s.frame.target = SMEAR_BALANCED;        /* by default that of a format */
        s.frame.light_space = linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED;
        free(picture);
        picture = rig_copy(&r, &s.frame, s.draw, SCENE_DRAWS);
    }
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

/* ------------------------------------------------------------------ shapes */

enum { SHAPES = 9 };

/* Lines of no length, thin, thick, flat, upright, and beyond the frame; sprites small, large, turned, in every format. */
static void make_shapes(smear_overlay_item item[SHAPES])
{
    static const smear_overlay_item all[SHAPES] = {
        { .shape = &smear_shape_line, .x = 10, .y = 60, .to_x = 1201, .to_y = -713, .color = { 255, 220, 40, 255 } },
        { .shape = &smear_shape_line, .x = 90, .y = 6, .to_x = -37, .to_y = 411, .width = 61, .color = { 20, 90, 255, 170 } },
        { .shape = &smear_shape_line, .x = 20, .y = 10, .to_x = 700, .width = 7 },
        { .shape = &smear_shape_line, .x = 40, .y = 40, .width = 90, .color = { 200, 20, 90, 255 } },
        { .shape = &smear_shape_line, .x = -200, .y = 90, .to_x = 32767, .to_y = -9001, .width = 40, .color = { 0, 0, 0, 90 } },
        { .shape = &smear_shape_turned, .x = 30, .y = 30, .image = &images[0], .turn = 5461, .zoom = 2100, .color = { 255, 0, 90, 200 } },
        { .shape = &smear_shape_turned, .x = 60, .y = 20, .image = &images[1], .cell = 1, .turn = 40000, .zoom = 1800 },
        { .shape = &smear_shape_turned, .x = 99, .y = 66, .image = &images[2], .turn = 16384, .zoom = 3000, .text = "no text" },
        { .shape = &smear_shape_turned, .x = 70, .y = 50, .image = &smear_font_8x8.glyph, .cell = 33, .turn = 60000, .zoom = 517 }
    };
    memcpy(item, all, sizeof all);
}

/* How much of a pixel a line covers. */
static double line_at(const smear_overlay_item *item, int x, int y)
{
    const double tx = item->to_x / 16.0, ty = item->to_y / 16.0, length = hypot(tx, ty);
    const double ux = length > 0 ? tx / length : 1, uy = length > 0 ? ty / length : 0, dx = x - item->x, dy = y - item->y;
    const double across = fabs(dx * uy - dy * ux), beyond = fabs(dx * ux + dy * uy - length / 2) - length / 2;
    const double within = (item->width != 0 ? item->width : 16) / 32.0 + 0.5 - fmax(across, beyond);
    return fmin(fmax(within, 0), 1);
}

/* The texel that a pixel shows, 0xAARRGGBB. False where its place is within a 64th of another one. */
static bool turned_at(const smear_overlay_item *item, int x, int y, uint32_t *argb)
{
    const smear_image *m = item->image;
    const double angle = item->turn * (2 * 3.14159265358979323846 / 65536), zoom = item->zoom / 256.0;
    const double dx = x + 0.5 - (item->x + m->width / 2.0), dy = y + 0.5 - (item->y + m->height / 2.0);
    const double u = (dx * cos(angle) - dy * sin(angle)) / zoom + m->width / 2.0;
    const double v = (dx * sin(angle) + dy * cos(angle)) / zoom + m->height / 2.0;
    const bool inside = u >= 0 && v >= 0 && u < m->width && v < m->height;
    *argb = inside ? image_at(m, item->cell, (int)u, (int)v, color_of(item)) : 0;
    return fabs(u - round(u)) >= 1.0 / 64 && fabs(v - round(v)) >= 1.0 / 64;
}

/* A code once it is blended: at least, or at most, in codes. In linear light the steps of alpha are those of what light is. */
static double blended(double code, double own, double alpha, bool linear)
{
    if (!linear)
        return code + (own - code) * alpha;
    const double was = light_of(code), light = was + (light_of(own) - was) * alpha;
    return code_of(light);
}

/* Checks each item alone over a picture, channel by channel: within 1.5 codes; in linear light of what an alpha of 8 bits may be. */
static void check_shape(const smear_overlay_item *item, const uint32_t *without, const uint32_t *with, bool linear)
{
    int unsure = 0, seen = 0;
    for (int i = 0; i < PIXELS; i++) {
        uint32_t argb = color_of(item);
        double alpha = (argb >> 24) / 255.0, step = 0;
        if (item->shape == &smear_shape_line) {
            alpha *= line_at(item, i % WIDTH, i / WIDTH);
            step = linear && alpha > 0 && alpha < 1 ? 0.6 / 255 : 0;
        } else if (turned_at(item, i % WIDTH, i / WIDTH, &argb)) {
            alpha = (argb >> 24) / 255.0;
        } else {
            unsure++;
            continue;
        }
        seen += alpha > 0;
        for (int k = 0; k < 24; k += 8) {
            const double was = without[i] >> k & 255u, own = argb >> k & 255u, is = with[i] >> k & 255u;
            const double a = blended(was, own, fmax(alpha - step, 0), linear), b = blended(was, own, fmin(alpha + step, 1), linear);
            CHECK(is >= fmin(a, b) - 1.5 && is <= fmax(a, b) + 1.5);
        }
    }
    CHECK(seen > 4 && unsure < PIXELS / 12);
}

static void test_shapes_are_those_of_a_double_precision_reference(void)
{
    smear_overlay_item item[SHAPES];
    make_shapes(item);
    const smear_desc desc = desc_of(SMEAR_XRGB8888, SMEAR_DITHER_NONE);
    for (int linear = 0; linear < 2; linear++)
        for (int i = 0; i < SHAPES; i++) {
            const smear_overlay one = { &item[i], 1, NULL };
            uint8_t *without = picture_of(&desc, SMEAR_NONE, NULL, linear != 0), *with = picture_of(&desc, SMEAR_NONE, &one, linear != 0);
            if (CHECK(without != NULL && with != NULL))
                check_shape(&item[i], (uint32_t *)(void *)without, (uint32_t *)(void *)with, linear != 0);
            free(without);
            free(with);
        }
}

/* Draws the shapes over a whole picture, a row at a time, by the functions that a program may call, too. */
static void draw_shapes(uint32_t *picture, const smear_overlay_item *item, int count, bool linear)
{
    for (int i = 0; i < count; i++) {
        int32_t box[4];
        item[i].shape->find_box(&item[i], box);
        for (int32_t y = 0; y < HEIGHT; y++) {
            const smear_shape_row row = { picture + y * WIDTH, 0, WIDTH, y, linear ? TRANSFER_LINEAR : TRANSFER_CODES };
            if (y >= box[1] && y < box[3])
                item[i].shape->draw_row(&item[i], &row);
        }
    }
}

static void test_shapes_lie_over_the_picture_of_every_method(void)
{
    smear_overlay_item item[SHAPES];
    const smear_overlay overlay = { item, SHAPES, NULL };
    make_shapes(item);
    const smear_desc desc = desc_of(SMEAR_XRGB8888, SMEAR_DITHER_NONE);
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++)
        for (int linear = 0; linear < 2; linear++) {
            uint8_t *want = picture_of(&desc, method, NULL, linear != 0), *got = picture_of(&desc, method, &overlay, linear != 0);
            if (CHECK(want != NULL && got != NULL)) {
                draw_shapes((uint32_t *)(void *)want, item, SHAPES, linear != 0);
                CHECK(memcmp(want, got, PIXELS * 4) == 0);
            }
            free(want);
            free(got);
        }
}

/* ------------------------------------------------------------------ a display that keeps what it is sent */

static void test_a_panel_is_sent_the_tiles_of_shapes_that_turn(void)
{
    smear_overlay_item item[2] = {
        { .shape = &smear_shape_line, .x = 30, .y = 30, .to_x = 200, .to_y = 9, .color = { 200, 20, 90, 255 } },
        { .shape = &smear_shape_turned, .x = 80, .y = 40, .image = &images[1], .zoom = 1400 }
    };
    const smear_overlay overlay = { item, 2, NULL };
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .tile = 8, .flush = place_band };
    RIG(whole, &desc, false);
    desc.reuse.buffer_age = 1;
    RIG(kept, &desc, false);
    for (int i = 0; i < 10; i++) {
        struct scene s;
        make_scene(&s, 0, SMEAR_AUTO);
        item[0].to_y = (int16_t)(i < 4 ? 9 : 9 - 30 * i);
        item[1].turn = (uint16_t)(i < 6 ? 0 : 4000 * i);
        item[1].zoom = (uint16_t)(i < 8 ? 1400 : 1300);
        s.frame.overlay = &overlay;
        kept.sent = 0;
        CHECK_EQ(rig_frame(&whole, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK_EQ(rig_frame(&kept, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK(memcmp(kept.picture, whole.picture, PIXELS * 4) == 0);
        CHECK(i < 2 || (kept.sent != 0) == (i >= 4));
    }
}

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
