/* SPDX-License-Identifier: MIT */
/* A cube that flies past, blurred. display.h knows the panel: pins and size are there. */
#include <stdio.h>
#include "cube.h"

void app_main(void)
{
    const int result = cube_begin();
    if (result != SMEAR_OK)
        printf("%s\n", smear_error_text(result));
    while (result == SMEAR_OK) {
        cube_frame();
        vTaskDelay(1);                  /* other tasks, the watchdog's among them */
    }
}
