/* SPDX-License-Identifier: MIT */
/* @WHAT@ display.h knows the panel: pins and size are there. */
#include <stdio.h>
#include "@NAME@.h"

void app_main(void)
{
    int result = @NAME@_begin();
    while (result == SMEAR_OK) {
        result = @NAME@_frame();
        vTaskDelay(1);                  /* other tasks, the watchdog's among them */
    }
    printf("%s\n", smear_error_text(result));
}
