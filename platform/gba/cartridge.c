/* SPDX-License-Identifier: MIT */
/* cartridge.c - host program: checks the header of a cartridge's image, and puts in the logo of another.
 *
 *     cartridge IMAGE.gba [ROM.gba]
 *
 * A console's BIOS starts a cartridge only when the 156 bytes of its logo are right; they are not ours to hand on, but any ROM
 * has them. Nothing is written unless both headers hold. */
#include <stdio.h>
#include <string.h>

enum { LOGO = 0x04, LOGO_BYTES = 156, FIRST = 0xa0, FIXED = 0xb2, CHECKSUM = 0xbd, HEADER = 0xc0 };

/* "GBATEK", Martin Korth: GBA cartridge header. */
static unsigned checksum_of(const unsigned char *header)
{
    unsigned sum = 0x19;
    for (int i = FIRST; i < CHECKSUM; i++)
        sum += header[i];
    return 0u - sum & 0xff;
}

static int fails(const char *path, const char *what)
{
    fprintf(stderr, "cartridge: %s: %s\n", path, what);
    return 1;
}

static int read_header(const char *path, unsigned char *header)
{
    char text[100];
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return fails(path, "cannot be opened");
    const size_t got = fread(header, 1, HEADER, file);
    fclose(file);
    if (got != HEADER) {
        snprintf(text, sizeof text, "is no ROM: %zu bytes, a header alone has %d", got, HEADER);
        return fails(path, text);
    }
    if (header[FIXED] != 0x96) {
        snprintf(text, sizeof text, "is no ROM of a Game Boy Advance: byte b2 is %02x, not 96", header[FIXED]);
        return fails(path, text);
    }
    if (header[CHECKSUM] != checksum_of(header)) {
        snprintf(text, sizeof text, "is damaged: the header's checksum, byte bd, is %02x, and its bytes give %02x", header[CHECKSUM],
                 checksum_of(header));
        return fails(path, text);
    }
    return 0;
}

static int is_blank(const unsigned char *header)
{
    return memcmp(header + LOGO, header + LOGO + 1, LOGO_BYTES - 1) == 0;
}

int main(int argc, char **argv)
{
    unsigned char mine[HEADER], other[HEADER];
    if (argc < 2 || argc > 3) {
        fputs("usage: cartridge IMAGE.gba [ROM.gba]\n", stderr);
        return 2;
    }
    if (read_header(argv[1], mine) != 0)
        return 1;
    if (argc == 2) {
        if (is_blank(mine))
            puts("for emulators and flash cartridges that bring a logo; a console wants one: LOGO=FILE.gba, any ROM of yours");
        return 0;
    }
    if (read_header(argv[2], other) != 0)
        return 1;
    if (is_blank(other))
        return fails(argv[2], "has no logo itself");
    FILE *file = fopen(argv[1], "r+b");
    if (file == NULL || fseek(file, LOGO, SEEK_SET) != 0 || fwrite(other + LOGO, LOGO_BYTES, 1, file) != 1 || fclose(file) != 0)
        return fails(argv[1], "cannot be written");
    return 0;
}
