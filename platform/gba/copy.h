/* SPDX-License-Identifier: MIT */
/* copy.h - memory.c's copies on a Game Boy Advance: by DMA, which copies 64 bytes and more faster than the processor, and by
 * halfwords, as video memory takes no single bytes. */
#ifndef SMEAR_GBA_COPY_H
#define SMEAR_GBA_COPY_H

#include "platform/gba/gba.h"

enum { COPY_HALVES = 1, COPY_LEAST = 64 };

static inline void copy_words(uint32_t *to, const uint32_t *from, uint32_t count)
{
    GBA_DMA3_FROM = (uint32_t)from;
    GBA_DMA3_TO = (uint32_t)to;
    GBA_DMA3_CONTROL = 0x84000000u | count;
}

#endif
