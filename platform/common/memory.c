/* SPDX-License-Identifier: MIT */
/* memory.c - the four functions that a compiler calls even where there is no C library. Word by
 * word where both sides are aligned, as nearly all calls are. */
#include <stddef.h>
#include <stdint.h>

/* else gcc turns these loops into calls of themselves */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize ("no-tree-loop-distribute-patterns")
#endif

void *memcpy(void *restrict to, const void *restrict from, size_t count);
void *memmove(void *to, const void *from, size_t count);
void *memset(void *to, int value, size_t count);
int memcmp(const void *a, const void *b, size_t count);

typedef uint32_t __attribute__((may_alias)) word;
typedef uint16_t __attribute__((may_alias)) half;

/* A port may name a file with copy_words(), for COPY_LEAST bytes and more, and with COPY_HALVES: memory that takes no single
 * bytes, so that what consists of halfwords is written by those. */
#ifdef PLATFORM_COPY_FILE
#include PLATFORM_COPY_FILE
#else
enum { COPY_HALVES = 0 };
#endif

#ifdef __arm__
/* Four words in two instructions, which no compiler makes of a loop. */
static inline void copy_fours(word **to, const word **from, size_t *count)
{
    __asm__ volatile(".syntax unified\n"
                     "1:\n\t"
                     "ldm %[from]!, {r3, r4, r5, r6}\n\t"
                     "stm %[to]!, {r3, r4, r5, r6}\n\t"
                     "subs %[left], %[left], #16\n\t"
                     "bhs 1b"
                     : [to] "+l"(*to), [from] "+l"(*from), [left] "+l"(*count)
                     :
                     : "r3", "r4", "r5", "r6", "cc", "memory");
}

static inline void set_fours(word **to, word value, size_t *count)
{
    register word fill __asm__("r3") = value;
    __asm__ volatile(".syntax unified\n\t"
                     "mov r4, r3\n\t"
                     "mov r5, r3\n\t"
                     "mov r6, r3\n"
                     "1:\n\t"
                     "stm %[to]!, {r3, r4, r5, r6}\n\t"
                     "subs %[left], %[left], #16\n\t"
                     "bhs 1b"
                     : [to] "+l"(*to), [left] "+l"(*count)
                     : "r"(fill)
                     : "r4", "r5", "r6", "cc", "memory");
}
#else
static inline void copy_fours(word **to, const word **from, size_t *count)
{
    word *w = *to;
    const word *s = *from;
    do {
        word a = s[0], b = s[1], c = s[2], d = s[3];
        w[0] = a;
        w[1] = b;
        w[2] = c;
        w[3] = d;
        w += 4;
        s += 4;
        *count -= 16;
    } while ((ptrdiff_t)*count >= 0);
    *to = w;
    *from = s;
}

static inline void set_fours(word **to, word value, size_t *count)
{
    word *w = *to;
    do {
        w[0] = value;
        w[1] = value;
        w[2] = value;
        w[3] = value;
        w += 4;
        *count -= 16;
    } while ((ptrdiff_t)*count >= 0);
    *to = w;
}
#endif

void *memcpy(void *restrict to, const void *restrict from, size_t count)
{
    uint8_t *byte = to;
    const uint8_t *source = from;
    if ((((uintptr_t)to | (uintptr_t)from) & 3) == 0) {
        word *w = (word *)to;
        const word *s = (const word *)from;
#ifdef PLATFORM_COPY_FILE
        if (count >= COPY_LEAST) {
            copy_words(w, s, count / 4);
            w += count / 4;
            s += count / 4;
            count &= 3;
        }
#endif
        if (count >= 16) {
            count -= 16;
            copy_fours(&w, &s, &count);
            count += 16;
        }
        for (; count >= 4; count -= 4)
            *w++ = *s++;
        byte = (uint8_t *)w;
        source = (const uint8_t *)s;
    }
    if (COPY_HALVES && (((uintptr_t)byte | (uintptr_t)source) & 1) == 0)
        for (; count >= 2; count -= 2, byte += 2, source += 2)
            *(half *)(void *)byte = *(const half *)(const void *)source;
    while (count-- != 0)
        *byte++ = *source++;
    return to;
}

void *memmove(void *to, const void *from, size_t count)
{
    uint8_t *byte = to;
    const uint8_t *source = from;
    if ((uintptr_t)to - (uintptr_t)from >= count)
        return memcpy(to, from, count);
    while (count-- != 0)
        byte[count] = source[count];
    return to;
}

void *memset(void *to, int value, size_t count)
{
    uint8_t *byte = to;
    if (COPY_HALVES && ((uintptr_t)byte & 3) == 2 && count >= 2) {
        *(half *)(void *)byte = (half)((uint8_t)value * 0x101u);
        byte += 2;
        count -= 2;
    }
    for (; count != 0 && ((uintptr_t)byte & 3) != 0; count--)
        *byte++ = (uint8_t)value;
    word *w = (word *)(void *)byte, fill = (uint8_t)value * 0x01010101u;
    if (count >= 16) {
        count -= 16;
        set_fours(&w, fill, &count);
        count += 16;
    }
    for (; count >= 4; count -= 4)
        *w++ = fill;
    byte = (uint8_t *)w;
    if (COPY_HALVES && count >= 2) {
        *(half *)(void *)byte = (half)fill;
        byte += 2;
        count -= 2;
    }
    while (count-- != 0)
        *byte++ = (uint8_t)value;
    return to;
}

int memcmp(const void *a, const void *b, size_t count)
{
    const uint8_t *x = a, *y = b;
    for (; count != 0; count--, x++, y++)
        if (*x != *y)
            return *x - *y;
    return 0;
}
