/* SPDX-License-Identifier: MIT */
/* footprint_arena.c - bytes of memory the library wants for contexts of 240x240 pixels,
 * RGB565, 600 triangles, 8 draws: sharp; reconstruct (reach 12); auto (tiles of 16); auto and
 * reconstruct. 0: refused. */
#include "platform/platform.h"

#include "platform/print.h"

#include <smear.h>

int main(void)
{
    const smear_desc desc[] = {
        { .methods = SMEAR_SET(SMEAR_NONE), .tile = 16 },
        { .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 12 },
        { .methods = SMEAR_SET(SMEAR_AUTO), .tile = 16 },
        { .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 12 }
    };
    for (unsigned i = 0; i < sizeof desc / sizeof *desc; i++) {
        smear_desc d = desc[i];
        d.width = d.height = 240;
        d.format = SMEAR_RGB565;
        d.max_triangles = 600;
        d.max_draws = 8;
        platform_print(i > 0 ? " " : "");
        print_decimal((uint32_t)smear_memory_size(&d));
    }
    platform_print("\n");
    return 0;
}
