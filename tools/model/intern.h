/* SPDX-License-Identifier: MIT */
/* intern.h - gives equal things equal numbers: texts, and triples of ints. Numbers count from 0
 * in the order of first appearance. Open addressing, at most half full. */
#ifndef SMEAR_TOOLS_INTERN_H
#define SMEAR_TOOLS_INTERN_H

#include <stdbool.h>
#include <stddef.h>

struct text_table {
    char **text;                /* copies */
    int count, capacity;
    int *slot;                  /* number + 1, 0 is free */
    size_t slot_count;          /* a power of two, or 0 */
};

struct triple_table {
    int (*key)[3];
    int count, capacity;
    int *slot;
    size_t slot_count;
};

/* The number of the text, added when it is new; -1 when out of memory. */
int text_intern(struct text_table *table, const char *text);
void text_table_free(struct text_table *table);

/* The same for three ints. */
int triple_intern(struct triple_table *table, const int key[3]);
void triple_table_free(struct triple_table *table);

#endif
