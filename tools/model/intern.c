/* SPDX-License-Identifier: MIT */
/* intern.c - see intern.h. */
#include "tools/model/intern.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* FNV-1a with a last mix, so that the low bits depend on all. */
static size_t hash_bytes(const void *bytes, size_t size)
{
    const uint8_t *p = bytes;
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        h = (h ^ p[i]) * 0x100000001b3u;
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    return (size_t)(h ^ h >> 32);
}

static size_t hash_text(const char *text)
{
    return hash_bytes(text, strlen(text));
}

static size_t hash_triple(const int key[3])
{
    return hash_bytes(key, 3 * sizeof *key);
}

/* Room for one more entry in an array of `size`-byte entries. */
static bool grow_entries(void **entries, size_t size, int count, int *capacity)
{
    if (count < *capacity)
        return true;
    if (*capacity > INT_MAX / 4)
        return false;
    int wanted = *capacity == 0 ? 16 : *capacity * 2;
    void *grown = realloc(*entries, (size_t)wanted * size);
    if (grown == NULL)
        return false;
    *entries = grown;
    *capacity = wanted;
    return true;
}

/* New slots, all free, for twice `capacity` entries. */
static bool new_slots(int **slot, size_t *slot_count, int capacity)
{
    size_t wanted = (size_t)capacity * 2;
    int *fresh = calloc(wanted, sizeof *fresh);
    if (fresh == NULL)
        return false;
    free(*slot);
    *slot = fresh;
    *slot_count = wanted;
    return true;
}

/* The slot that holds the text, or the free one where it belongs; there is a free one. */
static size_t find_text(const struct text_table *t, const char *text)
{
    size_t at = hash_text(text) & (t->slot_count - 1);
    while (t->slot[at] != 0 && strcmp(t->text[t->slot[at] - 1], text) != 0)
        at = (at + 1) & (t->slot_count - 1);
    return at;
}

static bool grow_texts(struct text_table *t)
{
    void *entries = t->text;
    bool ok = grow_entries(&entries, sizeof *t->text, t->count, &t->capacity);
    t->text = entries;
    if (!ok || !new_slots(&t->slot, &t->slot_count, t->capacity))
        return false;
    for (int i = 0; i < t->count; i++)
        t->slot[find_text(t, t->text[i])] = i + 1;
    return true;
}

int text_intern(struct text_table *t, const char *text)
{
    size_t at = t->slot_count == 0 ? 0 : find_text(t, text);
    if (t->slot_count != 0 && t->slot[at] != 0)
        return t->slot[at] - 1;
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy == NULL)
        return -1;
    memcpy(copy, text, size);
    if (t->count * 2 >= (int)t->slot_count) {
        if (!grow_texts(t)) {
            free(copy);
            return -1;
        }
        at = find_text(t, copy);
    }
    t->text[t->count] = copy;
    t->slot[at] = ++t->count;
    return t->count - 1;
}

void text_table_free(struct text_table *t)
{
    for (int i = 0; i < t->count; i++)
        free(t->text[i]);
    free(t->text);
    free(t->slot);
    *t = (struct text_table){ 0 };
}

/* As find_text. */
static size_t find_triple(const struct triple_table *t, const int key[3])
{
    size_t at = hash_triple(key) & (t->slot_count - 1);
    while (t->slot[at] != 0 && memcmp(t->key[t->slot[at] - 1], key, sizeof *t->key) != 0)
        at = (at + 1) & (t->slot_count - 1);
    return at;
}

static bool grow_triples(struct triple_table *t)
{
    void *entries = t->key;
    bool ok = grow_entries(&entries, sizeof *t->key, t->count, &t->capacity);
    t->key = entries;
    if (!ok || !new_slots(&t->slot, &t->slot_count, t->capacity))
        return false;
    for (int i = 0; i < t->count; i++)
        t->slot[find_triple(t, t->key[i])] = i + 1;
    return true;
}

int triple_intern(struct triple_table *t, const int key[3])
{
    size_t at = t->slot_count == 0 ? 0 : find_triple(t, key);
    if (t->slot_count != 0 && t->slot[at] != 0)
        return t->slot[at] - 1;
    const int copy[3] = { key[0], key[1], key[2] };     /* key may be an entry of the table */
    if (t->count * 2 >= (int)t->slot_count) {
        if (!grow_triples(t))
            return -1;
        at = find_triple(t, copy);
    }
    memcpy(t->key[t->count], copy, sizeof *t->key);
    t->slot[at] = ++t->count;
    return t->count - 1;
}

void triple_table_free(struct triple_table *t)
{
    free(t->key);
    free(t->slot);
    *t = (struct triple_table){ 0 };
}
