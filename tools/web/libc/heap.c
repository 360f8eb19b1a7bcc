/* SPDX-License-Identifier: MIT */
/* heap.c - malloc on the module's own memory, which grows by pages up to what the linker allows.
 *
 * Blocks lie one behind the other, each with its size and that of the block before in front of it,
 * so that free neighbours are merged at once. Free blocks hang in lists by size, four to each power
 * of two; a set of bits tells which lists hold something. */
#include <stdlib.h>

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { HEAD = 16, STEP = 16, BINS = 128, PAGE = 65536 };

struct block {
    uint32_t size;              /* with its head; a multiple of STEP */
    uint32_t size_before;       /* of the block before; 0: this is the first */
    uint32_t is_free;
    uint32_t padding;
    struct block *next, *last;  /* of its list; free blocks only */
};

extern unsigned char __heap_base;

static struct block *bin[BINS];
static uint64_t filled[BINS / 64];
static uintptr_t heap_end;
static struct block *top;       /* the last block */

static struct block *behind(struct block *b)
{
    return (struct block *)((uintptr_t)b + b->size);
}

/* Of the largest power of two not above the size, and the two bits below it. */
static int bin_of(uint32_t size)
{
    int top_bit = 31 - __builtin_clz(size);
    return top_bit * 4 + (int)(size >> (top_bit - 2) & 3);
}

static void put(struct block *b)
{
    int k = bin_of(b->size);
    b->is_free = 1;
    b->last = NULL;
    b->next = bin[k];
    if (b->next != NULL)
        b->next->last = b;
    bin[k] = b;
    filled[k / 64] |= (uint64_t)1 << k % 64;
}

static void take(struct block *b)
{
    int k = bin_of(b->size);
    if (b->next != NULL)
        b->next->last = b->last;
    if (b->last != NULL)
        b->last->next = b->next;
    else
        bin[k] = b->next;
    if (bin[k] == NULL)
        filled[k / 64] &= ~((uint64_t)1 << k % 64);
    b->is_free = 0;
}

static void resize(struct block *b, uint32_t size)
{
    b->size = size;
    if (b != top)
        behind(b)->size_before = size;
}

/* A free block, merged with its neighbours, into its list. */
static void give(struct block *b)
{
    if (b != top && behind(b)->is_free) {
        struct block *n = behind(b);
        bool was_top = n == top;
        take(n);
        if (was_top)
            top = b;
        resize(b, b->size + n->size);
    }
    if (b->size_before != 0) {
        struct block *p = (struct block *)((uintptr_t)b - b->size_before);
        if (p->is_free) {
            take(p);
            if (b == top)
                top = p;
            resize(p, p->size + b->size);
            b = p;
        }
    }
    put(b);
}

/* More memory from the browser, as one free block; false when there is none. */
static bool grow(uint32_t size)
{
    if (heap_end == 0)
        heap_end = ((uintptr_t)&__heap_base + STEP - 1) & ~(uintptr_t)(STEP - 1);
    uintptr_t have = __builtin_wasm_memory_size(0) * (uintptr_t)PAGE;
    if (heap_end + size > have || heap_end + size < heap_end) {
        uint64_t missing = (uint64_t)heap_end + size - have;
        size_t pages = (size_t)((missing + PAGE - 1) / PAGE);
        if (__builtin_wasm_memory_grow(0, pages) == (size_t)-1)
            return false;
        have = __builtin_wasm_memory_size(0) * (uintptr_t)PAGE;
    }
    uint32_t room = (uint32_t)(have - heap_end) & ~(uint32_t)(STEP - 1);
    struct block *b = (struct block *)heap_end;
    b->size = room;
    b->size_before = top != NULL ? top->size : 0;
    heap_end += room;
    top = b;
    give(b);
    return true;
}

/* A free block of at least this size; null when there is none. */
static struct block *find(uint32_t size)
{
    int k = bin_of(size);
    for (struct block *b = bin[k]; b != NULL; b = b->next)
        if (b->size >= size)
            return b;
    for (k++; k < BINS; k++) {
        uint64_t rest = filled[k / 64] >> k % 64;
        if (rest == 0) {
            k |= 63;
            continue;
        }
        return bin[k + __builtin_ctzll(rest)];
    }
    return NULL;
}

/* Gives back what is behind `size`. */
static void trim(struct block *b, uint32_t size)
{
    if (b->size < size + 2 * HEAD + STEP)
        return;
    struct block *rest = (struct block *)((uintptr_t)b + size);
    rest->size = b->size - size;
    rest->size_before = size;
    if (b == top)
        top = rest;
    else
        behind(rest)->size_before = rest->size;
    b->size = size;
    give(rest);
}

void *malloc(size_t size)
{
    if (size > 0x7fffff00u)
        return NULL;
    uint32_t whole = ((uint32_t)size + HEAD + STEP - 1) & ~(uint32_t)(STEP - 1);
    if (whole < 2 * HEAD)
        whole = 2 * HEAD;
    struct block *b = find(whole);
    if (b == NULL && !grow(whole))
        return NULL;
    if (b == NULL)
        b = find(whole);
    take(b);
    trim(b, whole);
    return (char *)b + HEAD;
}

void free(void *data)
{
    if (data != NULL)
        give((struct block *)((char *)data - HEAD));
}

void *calloc(size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes))
        return NULL;
    void *data = malloc(bytes);
    if (data != NULL)
        memset(data, 0, bytes);
    return data;
}

void *realloc(void *data, size_t size)
{
    struct block *b = (struct block *)((char *)data - HEAD);
    if (data != NULL && size <= b->size - HEAD)
        return data;
    void *moved = malloc(size);
    if (moved == NULL || data == NULL)
        return moved;
    memcpy(moved, data, b->size - HEAD);
    free(data);
    return moved;
}
