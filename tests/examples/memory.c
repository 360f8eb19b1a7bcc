/* SPDX-License-Identifier: MIT */
/* memory.c - prints the table of methods and their memory for the manual. */
#include <smear.h>
#include <stdio.h>

int main(void)
{
    static const struct {
        const char *name, *what;
        unsigned methods;
    } rows[] = {
        { "SMEAR_AUTO", "the default: draws what moves at a few moments of the exposure, and fills the gaps between them",
          SMEAR_SET(SMEAR_AUTO) },
        { "SMEAR_SET_SKETCH", "in `desc.methods` beside it: room for sketches, the fastest blur before a camera that moves",
          SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH },
        { "SMEAR_SUBFRAMES", "a moment for each half pixel of travel; slower, closer to the truth", SMEAR_SET(SMEAR_SUBFRAMES) },
        { "SMEAR_TIMEMASK", "works out when each triangle covers each pixel; many times slower, no closer", SMEAR_SET(SMEAR_TIMEMASK) },
        { "SMEAR_OBJECT", "smears each object along one line; a long one costs no more", SMEAR_SET(SMEAR_OBJECT) },
        { "SMEAR_RECONSTRUCT", "filters a sharp picture, as large game engines do", SMEAR_SET(SMEAR_RECONSTRUCT) },
        { "SMEAR_ACCUMULATE", "the mean of sharp pictures; memory of `SMEAR_SET_ACCUMULATE_BANDS`; slowest",
          SMEAR_SET_ACCUMULATE_BANDS },
        { "SMEAR_NONE", "no blur", SMEAR_SET(SMEAR_NONE) },
    };
    printf("| method | what it does | memory |\n|---|---|---|\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        /* The tile is the default one; as it is given, 64-bit machines count bands as boards have them. */
        smear_desc desc = { .width = 240, .height = 240, .max_triangles = 600, .max_draws = 16, .tile = 16,
                            .format = SMEAR_RGB565 };
        desc.methods = (uint16_t)rows[i].methods;
        printf("| `%s` | %s | %u kB |\n", rows[i].name, rows[i].what, (unsigned)((smear_memory_size(&desc) + 999) / 1000));
    }
    return 0;
}
