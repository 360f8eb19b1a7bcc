/* SPDX-License-Identifier: MIT */
/* display.c - display.h without a display: frames are drawn and forgotten. */
#include "../display.h"

static int flush(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

bool display_open(smear_desc *desc)
{
    desc->bands = 1;
    desc->flush = flush;
    return true;
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

unsigned display_keys(void)
{
    return 0;
}
