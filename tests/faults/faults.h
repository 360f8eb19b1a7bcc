/* SPDX-License-Identifier: MIT */
/* faults.h - a program whose calls of the system fail when they are told to. The linker puts the functions of faults.c
 * before those of the C library (--wrap), so the program is the one that people run. */
#ifndef SMEAR_TESTS_FAULTS_H
#define SMEAR_TESTS_FAULTS_H

#include <stdbool.h>

enum fault_kind {
    FAULT_MEMORY,               /* malloc, calloc, realloc, and what takes memory for a stream or name */
    FAULT_OPEN, FAULT_READ, FAULT_WRITE, FAULT_SYNC, FAULT_CLOSE, FAULT_RENAME, FAULT_LINK, FAULT_REMOVE, FAULT_THREAD,
    FAULT_KINDS
};
extern const char *const fault_names[FAULT_KINDS];

enum fault_mode {
    FAULT_NONE,
    FAULT_FAILS,                /* the call returns an error; a write has written half */
    FAULT_POWER                 /* the machine goes off at this call: what has not been synchronised is lost */
};

/* In shared memory: a process counts, its parent reads. */
struct fault_counts {
    long all, changes;          /* calls; those that change what is on a disk */
    long by_kind[FAULT_KINDS];
    enum fault_kind hit;        /* what the fault has hit */
    bool was_hit;
};

enum { FAULT_EXIT = 99 };       /* of a machine that has gone off */

/* From now on calls are counted, and the one of number `at` (from 1 on; with FAULT_POWER of those that change a disk) is
 * hit. Standard output goes through here, too. */
void faults_begin(struct fault_counts *counts, enum fault_mode mode, long at);

#endif
