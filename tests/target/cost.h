/* SPDX-License-Identifier: MIT */
/* cost.h - what programs that measure frames of 240x240 share: the context, and the clock around a frame. In the units of platform.h's
 * clock. */
#ifndef SMEAR_TESTS_TARGET_COST_H
#define SMEAR_TESTS_TARGET_COST_H

#include "platform/platform.h"
#include "platform/print.h"
#include "smear.h"

#include <stdbool.h>

enum { WIDTH = 240, FRAMES = 2, ONE = 1 << 16 };        /* of FRAMES the last one counts */

static smear_context *context;

/* A flush. */
static inline int swallow(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    smear_band_done(context);
    return 0;
}

static inline bool is_done(int result)
{
    if (result == SMEAR_OK)
        return true;
    platform_print(smear_error_text(result));
    platform_print("\n");
    return false;
}

static inline bool begin_context(const smear_desc *desc)
{
    size_t room;
    void *arena = platform_arena(&room);
    return is_done(smear_init(&context, desc, arena, room));
}

/* Returns what a frame takes; 0 where it fails. */
static inline uint32_t draw_frame(const smear_frame *frame, const smear_draw *draw, int count)
{
    const uint32_t before = platform_clock();
    int result = smear_begin(context, frame);
    for (int i = 0; i < count && result == SMEAR_OK; i++)
        result = smear_submit(context, &draw[i]);
    if (result == SMEAR_OK)
        result = smear_render(context);
    const uint32_t taken = platform_clock_count(platform_clock() - before);
    return is_done(result) ? taken : 0;
}

static inline void begin_report(const char *title)
{
    platform_clock_start();
    platform_print(platform_clock_unit);
    platform_print(title);
}

#endif
