/* SPDX-License-Identifier: MIT */
/* points_list.h - finished pixels of a list, into a plane. */
#ifndef SMEAR_KERNELS_POINTS_LIST_H
#define SMEAR_KERNELS_POINTS_LIST_H

#include "base/pixel.h"
#include "kernels/kernels.h"

/* Draws points from entry `head` on, where they are nearer. Returns the first entry that is no point, or UINT32_MAX. Pixels are
 * RGB565 where they are narrow. */
SMEAR_INLINE uint32_t points_list(const struct points_plane *p, uint32_t head, bool narrow)
{
    const struct points_plane k = *p;
    while (head != UINT32_MAX) {
        struct point_entry e;
        __builtin_memcpy(&e, (const uint8_t *)k.top - (size_t)head * sizeof e, sizeof e);
        if (e.kind != POINT_ENTRY)
            break;
        head = e.next;
        const uint32_t x = e.x - k.x0, y = e.y - k.y0;
        if (x >= k.width || y >= k.height)
            continue;
        const int32_t at = (int32_t)y * k.stride + (int32_t)x;
        if (e.depth <= k.depth[at])
            continue;
        k.depth[at] = e.depth;
        if (narrow)
            ((uint16_t *)k.pixels)[at] = (uint16_t)rgb565_nearest(e.color);
        else
            ((uint32_t *)k.pixels)[at] = e.color & 0xffffffu;
    }
    return head;
}

#endif
