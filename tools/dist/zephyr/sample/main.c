/* SPDX-License-Identifier: MIT */
/* @WHAT@ display.h knows the display: its size is there. */
#include <zephyr/kernel.h>
#include "@NAME@.h"

int main(void)
{
    int result = @NAME@_begin();
    while (result == SMEAR_OK)
        result = @NAME@_frame();
    printk("%s\n", smear_error_text(result));
    return 0;
}
