/* SPDX-License-Identifier: MIT */
/* A cube that flies past, blurred. display.h knows the display: its size is there. */
#include <zephyr/kernel.h>
#include "cube.h"

int main(void)
{
    int result = cube_begin();
    while (result == SMEAR_OK)
        result = cube_frame();
    printk("%s\n", smear_error_text(result));
    return 0;
}
