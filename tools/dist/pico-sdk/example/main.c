/* SPDX-License-Identifier: MIT */
/* @WHAT@ display.h knows the panel: pins and size are there. */
#include <pico/stdlib.h>
#include <stdio.h>
#include "@NAME@.h"

int main(void)
{
    stdio_init_all();
    int result = @NAME@_begin();
    while (result == SMEAR_OK)
        result = @NAME@_frame();
    for (;; sleep_ms(1000))
        printf("%s\n", smear_error_text(result));
}
