/* SPDX-License-Identifier: MIT */
/* flush.c - draws three frames of platform/examples/cube.h on a stand-in's panel and writes what it shows. C or C++. */
#include <cube.h>

int main(void)
{
    int result = cube_begin();
    for (int i = 0; i < 12 && result == SMEAR_OK; i++)
        result = cube_frame();
    while (panel_queued > 0)
        panel_send_first();
    if (result != SMEAR_OK)
        return !fprintf(stderr, "%s\n", smear_error_text(result));
    panel_save();
    return 0;
}
