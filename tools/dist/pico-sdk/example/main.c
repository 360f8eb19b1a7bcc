/* SPDX-License-Identifier: MIT */
/* A cube that flies past, blurred. display.h knows the panel: pins and size are there. */
#include <pico/stdlib.h>
#include <stdio.h>
#include "cube.h"

int main(void)
{
    stdio_init_all();
    int result = cube_begin();
    while (result == SMEAR_OK)
        result = cube_frame();
    for (;; sleep_ms(1000))
        printf("%s\n", smear_error_text(result));
}
