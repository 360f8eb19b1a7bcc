/* SPDX-License-Identifier: MIT */
/* surface.c - see surface.h. */
#include "tools/view/surface.h"

#include <string.h>

static bool machine_is_big_endian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 0;
}

bool layout_is_native(const struct layout *l)
{
    return l->bytes == 4 && l->big_endian == machine_is_big_endian() && l->shift[0] == 16 &&
           l->shift[1] == 8 && l->shift[2] == 0 && l->bits[0] == 8 && l->bits[1] == 8 &&
           l->bits[2] == 8;
}

bool layout_from_masks(struct layout *l, int bits_per_pixel, const uint32_t mask[3],
                       bool big_endian)
{
    *l = (struct layout){ .bytes = bits_per_pixel / 8, .big_endian = big_endian };
    if (bits_per_pixel != 16 && bits_per_pixel != 24 && bits_per_pixel != 32)
        return false;
    for (int i = 0; i < 3; i++) {
        uint32_t m = mask[i];
        for (; m != 0 && (m & 1) == 0; m >>= 1)
            l->shift[i]++;
        for (; (m & 1) != 0; m >>= 1)
            l->bits[i]++;
        if (m != 0 || l->bits[i] == 0 || l->shift[i] + l->bits[i] > bits_per_pixel)
            return false;
    }
    return true;
}

static uint32_t channel(uint32_t code, int bits)
{
    return bits <= 8 ? code >> (8 - bits) : code << (bits - 8) | code >> (16 - bits);
}

void layout_pack(const struct layout *l, uint8_t *out, const uint32_t *in, int count)
{
    if (layout_is_native(l)) {
        memcpy(out, in, (size_t)count * 4);
        return;
    }
    for (int i = 0; i < count; i++, out += l->bytes) {
        uint32_t value = channel(in[i] >> 16 & 255, l->bits[0]) << l->shift[0] |
                         channel(in[i] >> 8 & 255, l->bits[1]) << l->shift[1] |
                         channel(in[i] & 255, l->bits[2]) << l->shift[2];
        for (int b = 0; b < l->bytes; b++)
            out[l->big_endian ? l->bytes - 1 - b : b] = (uint8_t)(value >> 8 * b);
    }
}

void surface_fill(const struct surface *s, int x, int y, int width, int height, uint32_t rgb)
{
    int x1 = x + width < s->width ? x + width : s->width;
    int y1 = y + height < s->height ? y + height : s->height;
    x = x > 0 ? x : 0;
    for (y = y > 0 ? y : 0; y < y1; y++)
        for (int i = x; i < x1; i++)
            s->pixel[(size_t)y * s->pitch + (size_t)i] = rgb;
}
