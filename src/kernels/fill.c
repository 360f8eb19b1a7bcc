/* SPDX-License-Identifier: MIT */
/* fill.c - long rows of one value by stores of 32 bytes. */
#include "kernels/fill.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2
/* The first store and the last overlap aligned ones between them. */
SMEAR_AVX2_FUNCTION void smear_fill_avx2(void *p, uint32_t value, size_t bytes)
{
    const lanes8 eight = lanes8_all(value);
    uint8_t *const end = (uint8_t *)p + bytes;
    lanes8_store(p, eight);
    uint8_t *at = (uint8_t *)p + (32u - ((uintptr_t)p & 31u));
    for (; end - at >= 256; at += 256) {
        lanes8_store(at, eight);
        lanes8_store(at + 32, eight);
        lanes8_store(at + 64, eight);
        lanes8_store(at + 96, eight);
        lanes8_store(at + 128, eight);
        lanes8_store(at + 160, eight);
        lanes8_store(at + 192, eight);
        lanes8_store(at + 224, eight);
    }
    for (; end - at >= 32; at += 32)
        lanes8_store(at, eight);
    lanes8_store(end - 32, eight);
}
#endif
