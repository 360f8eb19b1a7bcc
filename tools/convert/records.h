/* SPDX-License-Identifier: MIT */
/* records.h - tables of smear_model.h that headers and blobs have alike, with what an element is made of. */
#ifndef SMEAR_TOOLS_CONVERT_RECORDS_H
#define SMEAR_TOOLS_CONVERT_RECORDS_H

#include "tools/convert/convert.h"

/* A letter of `fields` is a number: b B 8 bits, h H 16, i I 32, with and without sign; x 32 in hexadecimal; p 8, a path of a
 * channel; c a letter. Braces enclose arrays. A table of one letter is an array of numbers. */
struct record_table {
    int blob;                   /* BLOB_DRAW ... */
    const char *type, *name, *fields;
    int per_line;               /* of a header */
    const void *data;
    int count;
};

enum { RECORD_TABLES = 14 };

/* In the order in which they are written. */
void record_tables(const struct conversion *c, struct record_table out[RECORD_TABLES]);

/* Reads the number that a letter stands for, at *data, which goes on behind it. */
int64_t record_number(char letter, const uint8_t **data);

/* Bytes of it. */
int record_size(char letter);

#endif
