/* SPDX-License-Identifier: MIT */
/* crc32.c - the checksum of PNG chunks and of frame statistics (CRC-32/ISO-HDLC, as in zlib). */
#include "tools/image/image.h"

/* The remainders of the 16 values of half a byte under the reflected polynomial 0xedb88320. Two
 * steps per byte instead of one keep the table at 64 bytes; files are dominated by compression
 * anyway. */
static const uint32_t remainder_of_nibble[16] = {
    0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
    0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c, 0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c,
};

uint32_t crc32_update(uint32_t crc, const void *bytes, size_t size)
{
    const uint8_t *byte = bytes;
    crc = ~crc;
    for (size_t i = 0; i < size; i++) {
        crc ^= byte[i];
        crc = crc >> 4 ^ remainder_of_nibble[crc & 15];
        crc = crc >> 4 ^ remainder_of_nibble[crc & 15];
    }
    return ~crc;
}
