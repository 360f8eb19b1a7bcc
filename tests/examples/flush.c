/* SPDX-License-Identifier: MIT */
/* flush.c - draws twelve frames of platform/examples/cube.h, or of fox.h, on a stand-in's panel and writes what it shows. C or
 * C++. */
#ifdef EXAMPLE_FOX
#include <fox.h>
#define example_begin fox_begin
#define example_frame fox_frame
#else
#include <cube.h>
#define example_begin cube_begin
#define example_frame cube_frame
#endif

int main(void)
{
#ifdef STAND_INS_PD_API_H
    playdate = &stand_in_playdate;
#endif
    int result = example_begin();
    for (int i = 0; i < 12 && result == SMEAR_OK; i++)
        result = example_frame();
    while (panel_queued > 0)
        panel_send_first();
    if (result != SMEAR_OK)
        return !fprintf(stderr, "%s\n", smear_error_text(result));
    panel_save();
    return 0;
}
