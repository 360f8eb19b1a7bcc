/* SPDX-License-Identifier: MIT */
/* overlay_damage.c - what lies over tiles, as sums of hashes: where they are others, tiles are drawn again (display/damage.h). */
#include "damage/damage.h"
#include "overlay/overlay.h"

#if SMEAR_WITH_DAMAGE && SMEAR_WITH_OVERLAY

/* Hashes what is the same for all of item number `i`: an image's pixels only by their place. */
static void mix_item(uint32_t h[2], const smear_overlay_item *item, int32_t i)
{
    static const smear_image none = { 0 };
    const bool is_text = item->text != NULL && item->shape == NULL;
    const smear_image *m = is_text ? &item->font->glyph : item->image != NULL ? item->image : &none;
    int32_t word[11 + 3 * POINTER_WORDS] = {
        i, damage_bytes(item->color[0], item->color[1], item->color[2], item->color[3]), item->x, item->y,
        (int32_t)((uint32_t)item->width << 16 | item->height), (int32_t)((uint32_t)item->scale << 16 | item->cell),
        (int32_t)((uint32_t)m->width << 16 | m->height), damage_bytes(0, m->format, is_text, is_text ? item->font->first : 0), m->cells,
        (int32_t)((uint32_t)item->turn << 16 | item->zoom), (int32_t)((uint32_t)(uint16_t)item->to_x << 16 | (uint16_t)item->to_y)
    };
    damage_put_pointer(word + 11, m->pixels);
    damage_put_pointer(word + 11 + POINTER_WORDS, m->palette);
    damage_put_pointer(word + 11 + 2 * POINTER_WORDS, item->shape);
    h[0] = h[1] = 0;
    smear_damage_mix(h, word, (int)(sizeof word / sizeof *word));
}

/* Adds a hash to the sums of tiles that a box touches. */
static void add_box(uint32_t *over, const struct smear_window *w, const struct overlay_box *box, uint32_t hash)
{
    const int32_t x0 = max_i32(box->x0, 0), x1 = min_i32(box->x1, w->width), y1 = min_i32(box->y1, w->height);
    for (int32_t y = max_i32(box->y0, 0) >> w->tile_shift; x0 < x1 && y << w->tile_shift < y1; y++)
        for (int32_t x = x0 >> w->tile_shift; x << w->tile_shift < x1; x++)
            over[y * w->columns + x] += hash;
}

/* Adds the hashes of what lies over tiles, letter by letter, times `sign` to their sums. */
static void add_items(uint32_t *over, const smear_overlay *overlay, const struct smear_window *w, uint32_t sign)
{
    for (int32_t i = 0; i < overlay->count; i++) {
        const smear_overlay_item *item = &overlay->item[i];
        uint32_t h[2];
        mix_item(h, item, i);
        if (item->shape != NULL || item->text == NULL) {
            const struct overlay_box box = smear_overlay_box(item);
            add_box(over, w, &box, sign * (h[0] + h[1]));
            continue;
        }
        struct overlay_box box = smear_overlay_letter(item);
        const int32_t step = smear_overlay_advance(item);
        for (const char *c = item->text; *c != '\0' && box.x0 < w->width; c++, box.x0 += step, box.x1 += step) {
            const int32_t word[2] = { *c, box.x0 };
            uint32_t letter[2] = { h[0], h[1] };
            smear_damage_mix(letter, word, 2);
            add_box(over, w, &box, sign * (letter[0] + letter[1]));
        }
    }
}

/* Adds the hashes of where points are seen. */
static void add_points(uint32_t *over, const smear_points *points, const struct smear_window *w, uint32_t sign)
{
    for (int32_t i = 0; points != NULL && i < points->count; i++) {
        const smear_point *point = &points->point[i];
        const smear_point_place *p = &point->place;
        const struct overlay_box box = { p->x0, p->y0, p->x1, p->y1 };
        const int32_t word[] = { i, p->x, p->y, p->length, (int32_t)p->gain, p->along_x, p->along_y, p->depth,
                                 damage_bytes(point->color[0], point->color[1], point->color[2], point->mode) };
        uint32_t h[2] = { 0, 0 };
        smear_damage_mix(h, word, (int)(sizeof word / sizeof *word));
        add_box(over, w, &box, sign * (h[0] + h[1]));
    }
}

static void add_all(uint32_t *over, const smear_overlay *overlay, const struct smear_window *w, uint32_t sign)
{
    add_items(over, overlay, w, sign);
    add_points(over, overlay->points, w, sign);
}

/* What is left of a tile's sum without this frame's items is what differs. */
void smear_damage_find_overlay(struct smear_damage *d, const struct smear_rows *rows)
{
    static const smear_overlay none = { NULL, 0, NULL };
    const struct smear_window *w = &rows->window;
    const smear_overlay *overlay = rows->overlay != NULL ? rows->overlay : &none;
    if (!damage_has_tiles(d))
        return;
    add_all(d->over, overlay, w, 0u - 1u);
    for (int32_t i = 0; i < w->columns * w->rows; i++) {
        if (d->over[i] != 0)
            d->tiles.tile[i] = rows->desc->reuse.buffer_age;
        d->over[i] = 0;
    }
    add_all(d->over, overlay, w, 1);
}

#endif
