/* SPDX-License-Identifier: MIT */
/* jpeg.h - the stages of the JPEG reader (ITU-T T.81): jpeg_read.c takes markers and headers, jpeg_scan.c the scans,
 * jpeg_color.c makes samples of coefficients and pixels of samples.
 *
 * Coefficients and quantisation stand in the order of the file, zigzag: 0 is the mean of a block, 63 its finest detail. */
#ifndef SMEAR_TOOLS_IMAGE_JPEG_H
#define SMEAR_TOOLS_IMAGE_JPEG_H

#include "tools/image/image.h"

enum {
    JPEG_COMPONENTS = 3,
    JPEG_TABLES = 4,            /* of each kind */
    JPEG_FAST_BITS = 9,         /* codes up to this length are decoded by one look-up */
    JPEG_UNKNOWN = 14           /* no bit of a coefficient has come yet: the highest that can is 13 */
};

/* A Huffman code. */
struct jpeg_code {
    uint16_t fast[1 << JPEG_FAST_BITS];     /* length << 8 | symbol; 0: the code is longer or unused */
    uint32_t end[17];           /* of each length, the first code beyond; its highest bit is bit 15 */
    int32_t offset[17];         /* what a code of this length adds to be an index of `symbol` */
    uint8_t symbol[256];
    bool is_known;
};

struct jpeg_component {
    int id, h, v, table;        /* its samples in an MCU are h x v blocks; `table` is of quantisation */
    int width, height;          /* samples that the picture has */
    int columns, rows;          /* blocks that hold them */
    int stride;                 /* blocks of a row in memory, where all MCUs are whole */
    uint16_t quantum[64];       /* as they were when its first scan began */
    bool has_scan;
    uint8_t low[64];            /* of each coefficient the lowest bit that has come, or JPEG_UNKNOWN */
    uint8_t *sample;            /* 8 x stride a row */
    int16_t *coefficient;       /* of progressive files, 64 a block */
};

struct jpeg {
    const uint8_t *next, *end;  /* bytes not yet read */
    int width, height, component_count;
    int h, v;                   /* the largest of the components */
    int mcu_columns, mcu_rows;
    bool has_frame, is_progressive, has_jfif, has_adobe;
    unsigned transform;         /* Adobe's: 0 is RGB */
    struct jpeg_component component[JPEG_COMPONENTS];
    uint16_t quantum[JPEG_TABLES][64];
    bool has_quantum[JPEG_TABLES];
    struct jpeg_code dc[JPEG_TABLES], ac[JPEG_TABLES];
    long restart_interval;      /* MCUs between restart markers; 0: there are none */
    int scan_count;
    long blocks, visits;        /* of the picture; of all scans until now */
};

/* One or more components, coefficients `first` to `last`, bits from `low` up. */
struct jpeg_scan {
    int count, first, last, high, low;          /* high: the lowest bit of the scan before; 0: this is the first */
    struct jpeg_component *component[JPEG_COMPONENTS];
    const struct jpeg_code *dc[JPEG_COMPONENTS], *ac[JPEG_COMPONENTS];
};

/* counts[i] codes have i + 1 bits; false when there are too many of a length. */
bool jpeg_build_code(struct jpeg_code *code, const uint8_t counts[16], const uint8_t *symbols);

/* Reads the coded data of a scan, from j->next to the marker behind it, into samples or coefficients. */
bool jpeg_read_scan(struct jpeg *j, const struct jpeg_scan *scan, struct failure *f);

/* Moves j->next to the next marker, over whatever else lies there; false at the end of the file. */
bool jpeg_find_marker(struct jpeg *j);

/* Makes the 8 x 8 samples of a block; a row lies `stride` bytes behind the one before. */
void jpeg_make_samples(const int16_t coefficient[64], const uint16_t quantum[64], uint8_t *to, size_t stride);

/* Makes the picture of the samples of all components. */
bool jpeg_make_pixels(const struct jpeg *j, struct image *out, struct failure *f);

#endif
