/* SPDX-License-Identifier: MIT */
/* uf2.c - host program: an RP2350's image as a UF2, where there is no picotool to write it.
 *
 *     uf2 PROGRAM.bin PROGRAM.uf2
 *
 * The image lies in flash from 10000000h on. A UF2 is blocks of 512 bytes, each with 256 of the image and where they belong. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 512, HEADER = 32, PAGE = 256, END = 508 };
static const uint32_t flash = 0x10000000, flash_end = 0x11000000, secure_arm = 0xe48bff59, absolute = 0xe48bff57;

static void put(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(word >> 8 * i);
}

static int write_block(FILE *file, uint32_t family, uint32_t address, uint32_t number, uint32_t count, unsigned char *block)
{
    const uint32_t ignored = 0x9957e304;
    const int is_extended = family == absolute;
    const uint32_t header[] = { 0x0a324655, 0x9e5d5157, is_extended ? 0xa000u : 0x2000u, address, PAGE, number, count, family };
    for (int i = 0; i < 8; i++)
        put(block + 4 * i, header[i]);
    if (is_extended)
        put(block + HEADER + PAGE, ignored);
    put(block + END, 0x0ab16f30);
    return fwrite(block, BLOCK, 1, file) == 1;
}

static int convert(FILE *in, FILE *out)
{
    unsigned char block[BLOCK] = { 0 };
    if (fseek(in, 0, SEEK_END) != 0)
        return 0;
    const long bytes = ftell(in);
    if (bytes <= 0 || (unsigned long)bytes > flash_end - flash - PAGE || fseek(in, 0, SEEK_SET) != 0)
        return 0;
    const uint32_t count = ((uint32_t)bytes + PAGE - 1) / PAGE;
    /* Step A2 of the chip takes a UF2 for its own only behind such a block (data sheet, RP2350-E10); others leave it out. */
    memset(block + HEADER, 0xef, PAGE);
    if (!write_block(out, absolute, flash_end - PAGE, 0, 2, block))
        return 0;
    for (uint32_t number = 0; number < count; number++) {
        memset(block, 0, sizeof block);
        if (fread(block + HEADER, 1, PAGE, in) == 0 || !write_block(out, secure_arm, flash + number * PAGE, number, count, block))
            return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fputs("usage: uf2 PROGRAM.bin PROGRAM.uf2\n", stderr);
        return 2;
    }
    FILE *in = fopen(argv[1], "rb"), *out = in != NULL ? fopen(argv[2], "wb") : NULL;
    if (out == NULL || !convert(in, out) || fclose(out) != 0) {
        fprintf(stderr, "uf2: %s: cannot be read, or %s cannot be written\n", argv[1], argv[2]);
        return 1;
    }
    return 0;
}
