/* SPDX-License-Identifier: MIT */
/* panel.h - the display of the device as its user sees it: its own pixels, enlarged by whole
 * numbers, turned, in the colours it has, behind a round glass. */
#ifndef SMEAR_TOOLS_VIEW_PANEL_H
#define SMEAR_TOOLS_VIEW_PANEL_H

#include "tools/image/image.h"
#include "tools/view/surface.h"

#include <smear.h>
#include <stdbool.h>
#include <stdint.h>

/* A format's pixels as codes. */
struct panel_codes {
    smear_format format;
    uint32_t *of_word;          /* 16-bit formats: 0x00RRGGBB of every word; else null */
};

bool panel_codes_open(struct panel_codes *codes, smear_format format, struct failure *f);
void panel_codes_close(struct panel_codes *codes);

/* The picture that `render` would write, as 0x00RRGGBB without gaps. */
bool panel_decode(const struct panel_codes *codes, const uint8_t *pixels, size_t stride, int width,
                  int height, uint32_t *out, struct failure *f);

struct panel_look {
    int zoom;                   /* 1..8; 0: the largest that fits */
    int turns;                  /* quarter turns clockwise, 0..3 */
    bool round;                 /* only the inscribed circle is seen */
    bool has_tint;              /* greys run from `dark` to `lit` */
    uint32_t dark, lit;         /* 0x00RRGGBB */
};

/* Where the turned panel lies in the surface. Shrunk when it does not fit even at zoom 1 and no
 * zoom is asked for. */
struct panel_place {
    int x, y, width, height;
    int zoom;                   /* 0: shrunk */
};

struct panel_place panel_place_on(const struct panel_look *look, int width, int height,
                                  const struct surface *s);

/* Fills the whole surface: the picture (width x height codes) in its place, the rest dark. */
void panel_show(const struct panel_look *look, const struct panel_place *place,
                const uint32_t *codes, int width, int height, const struct surface *s);

/* The pixel of the panel at a place of the surface; may lie outside. */
void panel_locate(const struct panel_look *look, const struct panel_place *place, int width,
                  int height, int surface_x, int surface_y, int *x, int *y);

#endif
