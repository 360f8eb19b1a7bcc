/* SPDX-License-Identifier: MIT */
/* display.c - display.h where there is no display: programs check and measure their frames, and say that they cannot show
 * them. */
#include "platform/display.h"

bool display_open(smear_desc *desc)
{
    (void)desc;
    return false;
}

void display_attach(smear_context *ctx)
{
    (void)ctx;
}

void display_show(void)
{
}

bool display_wait(void)
{
    return false;
}

uint32_t display_time(void)
{
    return 0;
}

unsigned display_keys(void)
{
    return 0;
}
