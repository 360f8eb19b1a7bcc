/* SPDX-License-Identifier: MIT */
/* test_kernels.c - every variant of a kernel writes what its reference writes, and nothing else: in all lengths, at all
 * alignments, on random and extreme data. Needs neither libc nor floating point.
 *
 * The Makefile lists the families: FAMILY(fill) stands for kernels_fill[] in tests/kernels/fill.c. */
#include "tests/kernels/kernels.h"

#include "tests/test.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(at, size) ((void)(at), (void)(size))
#define ASAN_UNPOISON_MEMORY_REGION(at, size) ((void)(at), (void)(size))
#endif

void suite_kernels(void);

#define FAMILY(name) extern const struct kernel kernels_##name[];
KERNEL_FAMILIES
#undef FAMILY

static const struct kernel *const families[] = {
#define FAMILY(name) kernels_##name,
    KERNEL_FAMILIES
#undef FAMILY
};

enum { GUARD = 32, PLANE_BYTES = GUARD + 16 + KERNEL_BYTES + GUARD };

/* The data of a call as they were made, as the kernel has them, and as the reference left them. */
static union {
    uint8_t byte[PLANE_BYTES];
    __attribute__((aligned(16))) uint32_t word[PLANE_BYTES / 4];
} made[KERNEL_PLANES], work[KERNEL_PLANES], wanted[KERNEL_PLANES];

static int32_t start[KERNEL_PLANES], used[KERNEL_PLANES];      /* of a plane: its first byte; bytes with both guards */

static uint32_t extreme(void)
{
    static const uint32_t values[] = { 0, 1, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0xffffu, 0x10000u, 0x7fff8000u };
    return values[random_u32() % (sizeof values / sizeof *values)];
}

/* Kinds of data: random, extreme, random in runs of equal words, small. */
static uint32_t datum(int kind, uint32_t before)
{
    switch (kind) {
    case 0:  return random_u32();
    case 1:  return extreme();
    case 2:  return random_u32() % 4u == 0 ? random_u32() : before;
    default: return random_u32() & 0x01010101u;
    }
}

void kernel_call_make(const struct kernel *k, struct kernel_call *c, int32_t n, int shift, int kind)
{
    uint32_t word = random_u32();
    *c = (struct kernel_call){ .n = n };
    for (int i = 0; i < KERNEL_WORDS; i++)
        c->word[i] = word = datum(kind, word);
    for (int i = 0; i < KERNEL_PLANES; i++) {
        const int32_t align = k->align[i] != 0 ? k->align[i] : k->size[i];
        if (k->size[i] == 0)
            continue;
        start[i] = GUARD + (shift + 7 * i) % 16 / align * align;
        c->plane[i] = work[i].byte + start[i];
        c->bytes[i] = n * k->size[i];
        for (int32_t at = 0; at < PLANE_BYTES / 4; at++)
            made[i].word[at] = word = datum(kind, word);
        __builtin_memcpy(work[i].byte, made[i].byte, PLANE_BYTES);
    }
    if (k->prepare != NULL) {
        k->prepare(c);
        for (int i = 0; i < KERNEL_PLANES; i++)
            if (k->size[i] != 0)
                __builtin_memcpy(made[i].byte, work[i].byte, PLANE_BYTES);
    }
    for (int i = 0; i < KERNEL_PLANES; i++)
        used[i] = k->size[i] == 0 ? 0 : start[i] + c->bytes[i] + GUARD;
}

void kernel_call_restore(const struct kernel *k, const struct kernel_call *c)
{
    (void)c;
    for (int i = 0; i < KERNEL_PLANES; i++)
        if (k->size[i] != 0)
            __builtin_memcpy(work[i].byte, made[i].byte, (size_t)used[i]);
}

/* A form's call on the data of `c`; under a sanitizer the guards may not be read either. */
static struct kernel_call called(const struct kernel *k, const struct kernel_call *c, int form)
{
    struct kernel_call mine = *c;
    kernel_call_restore(k, c);
    for (int i = 0; i < KERNEL_PLANES; i++) {
        if (used[i] != 0) {
            ASAN_POISON_MEMORY_REGION(work[i].byte, (size_t)start[i] & ~(size_t)7);
            ASAN_POISON_MEMORY_REGION(work[i].byte + start[i] + c->bytes[i], (size_t)GUARD);
        }
    }
    k->form[form].call(&mine);
    for (int i = 0; i < KERNEL_PLANES; i++)
        ASAN_UNPOISON_MEMORY_REGION(work[i].byte, (size_t)PLANE_BYTES);
    return mine;
}

static bool guards_hold(const struct kernel_call *c)
{
    bool hold = true;
    for (int i = 0; i < KERNEL_PLANES; i++) {
        for (int32_t at = 0; at < start[i] && used[i] != 0; at++)
            hold = hold && work[i].byte[at] == made[i].byte[at];
        for (int32_t at = start[i] + c->bytes[i]; at < used[i]; at++)
            hold = hold && work[i].byte[at] == made[i].byte[at];
    }
    return hold;
}

static bool are_equal(const struct kernel_call *got, const struct kernel_call *want)
{
    bool equal = true;
    for (int i = 0; i < KERNEL_WORDS; i++)
        equal = equal && got->word[i] == want->word[i];
    for (int i = 0; i < KERNEL_PLANES; i++) {
        const int32_t words = used[i] / 4;
        for (int32_t at = 0; at < words; at++)
            equal = equal && work[i].word[at] == wanted[i].word[at];
        for (int32_t at = words * 4; at < used[i]; at++)
            equal = equal && work[i].byte[at] == wanted[i].byte[at];
    }
    return equal;
}

/* Says where a form is wrong, in the words "NAME FORM, length, shift, kind". */
static bool holds(bool ok, const struct kernel *k, int form, const char *what, int32_t n, int shift, int kind)
{
    if (ok)
        return true;
    test_print("  ");
    test_print(k->name);
    test_print(" ");
    test_print(k->form[form].name);
    test_print(": ");
    test_print(what);
    test_print("\n");
    CHECK_EQ(n, -1);            /* prints the numbers */
    CHECK_EQ(shift, -1);
    CHECK_EQ(kind, -1);
    return false;
}

/* False after the first difference: those after it say the same. */
static bool check_call(const struct kernel *k, int32_t n, int shift, int kind)
{
    struct kernel_call c;
    kernel_call_make(k, &c, n, shift, kind);
    for (int i = 0; i < KERNEL_PLANES; i++)
        if (!CHECK(c.bytes[i] <= KERNEL_BYTES))
            return false;
    const struct kernel_call want = called(k, &c, 0);
    if (!holds(guards_hold(&c), k, 0, "writes beyond its planes", n, shift, kind))
        return false;
    for (int i = 0; i < KERNEL_PLANES; i++)
        __builtin_memcpy(wanted[i].byte, work[i].byte, (size_t)used[i]);
    for (int form = 1; form < KERNEL_FORMS && k->form[form].name != NULL; form++) {
        const struct kernel_call got = called(k, &c, form);
        if (!holds(guards_hold(&c), k, form, "writes beyond its planes", n, shift, kind)
            || !holds(are_equal(&got, &want), k, form, "differs from the reference", n, shift, kind))
            return false;
    }
    return true;
}

/* Where there is less time, of each length a third of the calls: with every shift and every kind. */
#ifndef KERNEL_STEP
#define KERNEL_STEP 1
#endif

static bool check_kernel(const struct kernel *k)
{
    for (int32_t n = k->least; n <= k->most; n++)
        for (int shift = 0; shift < 16; shift++)
            for (int kind = 0; kind < KERNEL_KINDS; kind++)
                if ((n + shift + kind) % KERNEL_STEP == 0 && !check_call(k, n, shift, kind))
                    return false;
    return true;
}

void kernels_each(void (*each)(const struct kernel *k))
{
    for (size_t i = 0; i < sizeof families / sizeof *families; i++)
        for (const struct kernel *k = families[i]; k->name != NULL; k++)
            each(k);
}

#define FAMILY(family) \
    static void test_every_form_does_what_its_reference_does_in_##family(void) \
    { \
        for (const struct kernel *k = kernels_##family; k->name != NULL; k++) \
            check_kernel(k); \
    }
KERNEL_FAMILIES
#undef FAMILY

void suite_kernels(void)
{
    random_state = 1;
#define FAMILY(name) RUN(test_every_form_does_what_its_reference_does_in_##name);
    KERNEL_FAMILIES
#undef FAMILY
}
