/* SPDX-License-Identifier: MIT */
/* kernels.h - kernels as check_kernels tries them: how each is called, and on what data.
 *
 * tests/kernels/FAMILY.c defines `const struct kernel kernels_FAMILY[]`, ended by one without a name. Neither libc
 * nor floating point is there: the suite runs on every target. */
#ifndef KERNELS_TEST_H
#define KERNELS_TEST_H

#include "kernels/bind.h"
#include "tests/random.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KERNEL_PLANES = 5, KERNEL_WORDS = 16, KERNEL_FORMS = 4, KERNEL_BYTES = 1024 };

/* One call. What it writes to planes and words is compared. */
struct kernel_call {
    int32_t n;                          /* length: pixels, as a rule */
    void *plane[KERNEL_PLANES];         /* random or extreme bytes, at any alignment that its pixels may have */
    int32_t bytes[KERNEL_PLANES];       /* what the kernel may read and write of each */
    uint32_t word[KERNEL_WORDS];        /* random or extreme numbers */
};

struct kernel_form {
    const char *name;                   /* "reference", "vector", "armv6m" ... */
    void (*call)(struct kernel_call *c);
};

struct kernel {
    const char *name;
    int32_t least, most;                /* lengths to try; most: two vectors and three, or more */
    uint8_t size[KERNEL_PLANES];        /* bytes per pixel of each plane; 0: no such plane */
    uint8_t align[KERNEL_PLANES];       /* of their first byte; 0: as their size */
    void (*prepare)(struct kernel_call *c);     /* makes the data fit the contract; or null */
    struct kernel_form form[KERNEL_FORMS];      /* the reference first, then what this build has */
    int32_t timed;                      /* the length that is timed; 0: KERNEL_BYTES / 4 or what fits */
};

/* A family's list. */
#define KERNELS(family) \
    extern const struct kernel kernels_##family[]; \
    const struct kernel kernels_##family[]

/* A form of builds with vectors, behind others; what only these have. */
#if SMEAR_VECTORS
#define VECTOR_FORM(name, call) , { name, call }
#define VECTORS(...) __VA_ARGS__
#else
#define VECTOR_FORM(name, call)
#define VECTORS(...)
#endif

/* Calls `each` for every kernel of every family. */
void kernels_each(void (*each)(const struct kernel *k));

/* Makes data for calls of length n; kind 0 is random. Planes lie `shift` bytes behind multiples of 16, or as near to
 * that as the alignment of their pixels allows. */
enum { KERNEL_KINDS = 4 };
void kernel_call_make(const struct kernel *k, struct kernel_call *c, int32_t n, int shift, int kind);

/* Gives the planes of a call the data that were made for it. */
void kernel_call_restore(const struct kernel *k, const struct kernel_call *c);

#endif
