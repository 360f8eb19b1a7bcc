/* SPDX-License-Identifier: MIT */
/* screen.c - see screen.h. */
#include "platform/game/screen.h"

#include "platform/words.h"

/* Names are those of the demo's screens (platform/demo_player.c); "pico" is a panel of 128x128. Triangle lists have room for
 * what is in view at once. Slow boards draw sketches. */
#define SCREEN(word, w, h, pixels, buffers, px, columns, triangles, also, shadows, codes, steps)                             \
    { .name = word, .frames = steps, .way.target = codes,                                                                \
      .desc = { .width = w, .height = h, .format = pixels, .bands = buffers, .tile = px, .strip = columns,               \
                .max_triangles = triangles, .max_draws = VIEW_DRAWS + (shadows),                                     \
                .reuse.one_pose = 1,                                                                               \
                .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_NONE) | (also) } }

static const struct screen screens[] = {
    SCREEN("pico", 128, 128, SMEAR_RGB565_SWAPPED, 2, 16, 64, 420, SMEAR_SET_SKETCH, 0, SMEAR_SKETCH, 1),
    SCREEN("pico-128", 128, 128, SMEAR_RGB565_SWAPPED, 2, 16, 64, 420, SMEAR_SET_SKETCH, 0, SMEAR_SKETCH, 1),
    SCREEN("pico-240", 240, 240, SMEAR_RGB565_SWAPPED, 2, 16, 96, 240, SMEAR_SET_SKETCH, 0, 512, 2),
    SCREEN("pico-320", 320, 240, SMEAR_RGB565_SWAPPED, 2, 16, 32, 240, SMEAR_SET_SKETCH, 0, SMEAR_SKETCH, 2),
    SCREEN("gba", 120, 80, SMEAR_RGB555, 1, 8, 0, 420, SMEAR_SET_SKETCH, 0, 512, 3),
    SCREEN("pi-320", 320, 240, SMEAR_RGB565, 1, 32, 320, 800, 0, VIEW_SHADOWS, SMEAR_DRAFT, 1),
    SCREEN("pi-640", 640, 480, SMEAR_RGB565, 1, 32, 640, 800, 0, VIEW_SHADOWS, SMEAR_DRAFT, 1),
    SCREEN("linux", 640, 480, SMEAR_XRGB8888, 1, 0, 0, 800, 0, VIEW_SHADOWS, SMEAR_DRAFT, 1),
    SCREEN("window", 640, 480, SMEAR_XRGB8888, 1, 0, 0, 800, 0, VIEW_SHADOWS, SMEAR_DRAFT, 1),
    SCREEN("page", 320, 240, SMEAR_XRGB8888, 1, 0, 0, 800, 0, 0, SMEAR_DRAFT, 1)
};

const struct screen *screen_find(const char *name)
{
    for (unsigned i = 0; i < sizeof screens / sizeof *screens; i++)
        if (is_word(screens[i].name, name))
            return &screens[i];
    return NULL;
}
