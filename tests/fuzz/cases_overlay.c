/* SPDX-License-Identifier: MIT */
/* cases_overlay.c - boxes, sprites and text over the frames of a case: see cases.h. */
#include "tests/fuzz/cases.h"

#include <string.h>

static void make_image(struct fuzz_case *c, smear_image *image)
{
    static const uint8_t bits[] = { 1, 4, 4, 8 };
    struct source *s = &c->source;
    *image = (smear_image){ .width = (uint16_t)source_range(s, 1, 20),
                            .height = (uint16_t)source_range(s, 1, 12),
                            .cells = (uint16_t)source_range(s, 0, 5),
                            .format = (uint8_t)source_range(s, SMEAR_IMAGE_MASK1, SMEAR_IMAGE_PALETTE8) };
    if (source_chance(s, 40))
        image->width = (uint16_t)source_range(s, 1, 2048);
    const int cells = image->cells != 0 ? image->cells : 1;
    image->pixels = case_random(c, (size_t)(image->width * bits[image->format] + 7) / 8 * image->height * (size_t)cells);
    image->palette = image->format >= SMEAR_IMAGE_PALETTE4 ? case_random(c, 256 * 4) : NULL;
}

static void make_item(struct fuzz_case *c, smear_overlay_item *item)
{
    struct source *s = &c->source;
    const bool far = source_chance(s, 6);
    *item = (smear_overlay_item){ .x = (int16_t)source_range(s, far ? INT16_MIN : -20, far ? INT16_MAX : 80),
                                  .y = (int16_t)source_range(s, far ? INT16_MIN : -20, far ? INT16_MAX : 60),
                                  .width = (uint16_t)source_range(s, 0, far ? 65535 : 60),
                                  .height = (uint16_t)source_range(s, 0, far ? 65535 : 40),
                                  .scale = (uint8_t)source_range(s, 0, source_chance(s, 3) ? 8 : 2) };
    for (int i = 0; i < 4; i++)
        item->color[i] = (uint8_t)source_word(s);
    if (source_chance(s, 3)) {
        item->text = c->text;
        item->font = &c->font;
    } else if (source_chance(s, 2)) {
        item->image = &c->image;
        item->cell = (uint16_t)source_range(s, 0, c->image.cells != 0 ? c->image.cells - 1 : 0);
    }
    if (source_chance(s, 4)) {
        item->shape = source_chance(s, 2) ? &smear_shape_line : &smear_shape_turned;
        item->turn = (uint16_t)source_word(s);
        item->zoom = (uint16_t)(far ? source_word(s) : (uint32_t)source_range(s, 0, 1024));
        item->to_x = (int16_t)source_range(s, far ? INT16_MIN : -900, far ? INT16_MAX : 900);
        item->to_y = (int16_t)source_range(s, far ? INT16_MIN : -900, far ? INT16_MAX : 900);
    }
}

/* Anywhere near the camera, mostly, and where it was before: a little elsewhere. */
static void make_point(struct fuzz_case *c, smear_point *point)
{
    struct source *s = &c->source;
    for (int k = 0; k < 3; k++) {
        point->now[k] = source_range(s, -(3 << 16), 3 << 16) - (k == 2 ? 3 << 16 : 0);
        if (c->extreme && source_chance(s, 8))
            point->now[k] = source_any(s);
        int32_t step = source_range(s, -(1 << 16), 1 << 16);
        step >>= source_range(s, 0, 12);        /* not in one expression: compilers differ in which comes first */
        point->before[k] = c->extreme && source_chance(s, 8) ? source_any(s) : (int32_t)((uint32_t)point->now[k] + (uint32_t)step);
        point->color[k] = (uint8_t)source_word(s);
    }
    point->size = source_range(s, 0, source_chance(s, 8) ? INT32_MAX : 1 << 15);
    point->fade = (uint8_t)(source_chance(s, 2) ? source_word(s) : 0);
    point->mode = (uint8_t)source_range(s, SMEAR_POINT_ADD, SMEAR_POINT_BLEND);
}

void case_make_overlay(struct fuzz_case *c)
{
    struct source *s = &c->source;
    make_image(c, &c->image);
    make_image(c, &c->font.glyph);
    c->font.first = (uint8_t)source_range(s, 0, 100);
    c->font.advance = (uint8_t)source_range(s, 0, 30);
    for (int i = 0; i < CASE_ITEMS; i++)
        make_item(c, &c->item[i]);
    for (int i = 0; i < CASE_POINTS; i++)
        make_point(c, &c->point[i]);
    c->points.point = c->point;
}

void case_frame_overlay(struct fuzz_case *c)
{
    struct source *s = &c->source;
    for (size_t i = 0; i + 1 < sizeof c->text; i++)
        if (c->text[0] == 0 || source_chance(s, 4))
            c->text[i] = (char)source_range(s, i < 2, 127);
    if (source_chance(s, 2))
        make_item(c, &c->item[source_range(s, 0, CASE_ITEMS - 1)]);
    for (int i = 0; i < CASE_POINTS; i++)
        if (source_chance(s, 3))
            make_point(c, &c->point[i]);
    c->points.count = (uint16_t)source_range(s, 0, CASE_POINTS);
    const bool points = source_chance(s, 2);
    c->overlay = (smear_overlay){ c->item, (uint16_t)source_range(s, 0, CASE_ITEMS), points ? &c->points : NULL };
    c->frame.overlay = source_chance(s, 3) ? &c->overlay : NULL;
}
