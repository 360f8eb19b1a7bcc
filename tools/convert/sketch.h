/* SPDX-License-Identifier: MIT */
/* sketch.h - a conversion as a program that is ready to compile: an Arduino sketch or a project of ESP-IDF, in a .zip file. The
 * same model and kit give the same bytes everywhere. */
#ifndef SMEAR_TOOLS_CONVERT_SKETCH_H
#define SMEAR_TOOLS_CONVERT_SKETCH_H

#include "tools/convert/convert.h"

enum sketch_quality { SKETCH_SHARP, SKETCH_DRAFT, SKETCH_BALANCED, SKETCH_FINE };

struct sketch_options {
    int display;                /* of sketch_displays */
    int width, height;          /* 0: those of the display's example */
    int quality;                /* sketch_quality */
    long max_ram;               /* bytes that context and actor may take; 0: no limit */
};

/* On a core with 32-bit pointers. */
struct sketch_report {
    int width, height;
    int triangles;              /* drawn at once */
    size_t context, actor;      /* bytes of RAM */
    size_t model, library, small;       /* bytes of flash; the library's by -O2 and, on a Cortex-M0+, by -Os */
};

/* Headers of platform/examples; null ends them. */
extern const char *const sketch_displays[];

/* `kit` is what `make kit` writes, a ustar archive; `name` an identifier, `from` the name of the model's file. *bytes is
 * malloc'ed. Fails, too, where less than a quarter of the triangles can be drawn at once in max_ram. */
bool convert_to_sketch(const struct conversion *c, const struct sketch_options *o, const char *name, const char *from,
                       const uint8_t *kit, size_t kit_size, uint8_t **bytes, size_t *size, struct sketch_report *report,
                       struct failure *f);

#endif
