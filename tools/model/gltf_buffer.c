/* SPDX-License-Identifier: MIT */
/* gltf_buffer.c - buffers from the BIN chunk, data URIs and files; buffer views as checked
 * slices. */
#include "tools/model/gltf.h"

#include <stdlib.h>
#include <string.h>

/* Largest whole number that every double between 0 and it is exact for. */
static const int64_t max_exact = (int64_t)1 << 53;

static int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/* RFC 4648 with or without padding; false when a character is none of the alphabet's or the
 * length is impossible. `out` holds 3 bytes for every 4 characters begun. */
static bool base64_decode(const char *text, uint8_t *out, size_t *size)
{
    size_t length = strlen(text);
    for (int padding = 0; padding < 2 && length > 0 && text[length - 1] == '='; padding++)
        length--;
    if (length % 4 == 1)
        return false;
    uint32_t bits = 0;
    size_t at = 0;
    for (size_t i = 0; i < length; i++) {
        int digit = base64_digit(text[i]);
        if (digit < 0)
            return false;
        bits = bits << 6 | (uint32_t)digit;
        if (i % 4 == 3) {
            out[at++] = (uint8_t)(bits >> 16);
            out[at++] = (uint8_t)(bits >> 8);
            out[at++] = (uint8_t)bits;
        }
    }
    if (length % 4 == 2)
        out[at++] = (uint8_t)(bits >> 4);
    if (length % 4 == 3) {
        out[at++] = (uint8_t)(bits >> 10);
        out[at++] = (uint8_t)(bits >> 2);
    }
    *size = at;
    return true;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Undoes %XX; a '%' that starts no such thing stands for itself. Null when out of memory or when a
 * NUL would result. */
static char *percent_decode(const char *uri)
{
    char *out = malloc(strlen(uri) + 1);
    if (out == NULL)
        return NULL;
    size_t at = 0;
    while (*uri != '\0') {
        int high = uri[0] == '%' ? hex_digit(uri[1]) : -1;
        int low = high >= 0 ? hex_digit(uri[2]) : -1;
        if (low >= 0) {
            if (high == 0 && low == 0) {
                free(out);
                return NULL;
            }
            out[at++] = (char)(high << 4 | low);
            uri += 3;
        } else {
            out[at++] = *uri++;
        }
    }
    out[at] = '\0';
    return out;
}

bool gltf_read_uri(struct gltf *g, int object, const char *uri, uint8_t **owned, size_t *size)
{
    *owned = NULL;
    *size = 0;
    if (strncmp(uri, "data:", 5) == 0) {
        const char *comma = strchr(uri, ',');
        if (comma == NULL || comma - uri < 12 || strncmp(comma - 7, ";base64", 7) != 0)
            return json_fail(&g->json, object, "uri", g->f, "a data URI that is not base64");
        size_t room = strlen(comma + 1) / 4 * 3 + 3;
        *owned = malloc(room);
        if (*owned == NULL)
            return fail(g->f, "out of memory (%zu bytes of base64)", room);
        if (!base64_decode(comma + 1, *owned, size)) {
            free(*owned);
            *owned = NULL;
            return json_fail(&g->json, object, "uri", g->f, "bad base64");
        }
        return true;
    }
    char *name = percent_decode(uri);
    if (name == NULL)
        return json_fail(&g->json, object, "uri", g->f, "bad file name");
    struct failure why = { 0 };
    bool ok = external_read(g->files, name, owned, size, &why);
    free(name);
    if (!ok)
        return json_fail(&g->json, object, "uri", g->f, "%s", why.text);
    return true;
}

static bool read_buffer(struct gltf *g, int index, int object)
{
    struct gltf_view *buffer = &g->buffer[index];
    const char *uri = NULL;
    int64_t length = -1;
    if (!json_get_string(&g->json, object, "uri", &uri, g->f) ||
        !json_get_integer(&g->json, object, "byteLength", 1, max_exact, &length, g->f))
        return false;
    if (length < 0)
        return json_fail(&g->json, object, NULL, g->f, "no byteLength");
    if (uri != NULL) {
        if (!gltf_read_uri(g, object, uri, &g->owned_buffer[index], &buffer->size))
            return false;
        buffer->bytes = g->owned_buffer[index];
    } else if (index == 0 && g->bin != NULL) {
        buffer->bytes = g->bin;
        buffer->size = g->bin_size;
    } else {
        return true;            /* has no bytes, which is fine until something is to be read from it */
    }
    if ((uint64_t)length > buffer->size)
        return json_fail(&g->json, object, "byteLength", g->f, "%lld bytes promised, %zu there",
                         (long long)length, buffer->size);
    buffer->size = (size_t)length;
    g->source_bytes += buffer->size;
    return true;
}

/* The extension of a buffer view that has its bytes in packed form, or null. */
static const char *packed_by(const struct gltf *g, int view)
{
    static const char *const names[] = { "EXT_meshopt_compression", "KHR_meshopt_compression" };
    int extensions = json_member(&g->json, view, "extensions");
    for (int i = 0; i < 2; i++) {
        if (json_member(&g->json, extensions, names[i]) >= 0)
            return names[i];
    }
    return NULL;
}

static bool read_view(struct gltf *g, int index, int object)
{
    struct gltf_view *view = &g->view[index];
    int64_t offset = 0, length = -1, stride = 0;
    int buffer = -1;
    if (!json_get_index(&g->json, object, "buffer", g->buffer_count, "buffer", &buffer, g->f) ||
        !json_get_integer(&g->json, object, "byteOffset", 0, max_exact, &offset, g->f) ||
        !json_get_integer(&g->json, object, "byteLength", 1, max_exact, &length, g->f) ||
        !json_get_integer(&g->json, object, "byteStride", 4, 252, &stride, g->f))
        return false;
    if (buffer < 0 || length < 0)
        return json_fail(&g->json, object, NULL, g->f, "no buffer or no byteLength");
    uint64_t size = g->buffer[buffer].size;
    view->stride = (size_t)stride;
    if (g->buffer[buffer].bytes == NULL) {
        view->packed_by = packed_by(g, object);
        return true;
    }
    if ((uint64_t)offset > size || (uint64_t)length > size - (uint64_t)offset)
        return json_fail(&g->json, object, NULL, g->f, "reaches past its buffer of %zu bytes",
                         g->buffer[buffer].size);
    view->bytes = g->buffer[buffer].bytes + offset;
    view->size = (size_t)length;
    return true;
}

bool gltf_read_buffers(struct gltf *g)
{
    int array, count;
    if (!gltf_list(g, 0, "buffers", &array, &count))
        return false;
    g->buffer = gltf_alloc(g, (size_t)count, sizeof *g->buffer);
    g->owned_buffer = gltf_alloc(g, (size_t)count, sizeof *g->owned_buffer);
    if (g->buffer == NULL || g->owned_buffer == NULL)
        return false;
    g->buffer_count = count;
    int index = 0;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        if (!read_buffer(g, index++, i))
            return false;
    }

    if (!gltf_list(g, 0, "bufferViews", &array, &count))
        return false;
    g->view = gltf_alloc(g, (size_t)count, sizeof *g->view);
    if (g->view == NULL)
        return false;
    g->view_count = count;
    index = 0;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        if (!read_view(g, index++, i))
            return false;
    }
    return true;
}

bool gltf_has_bytes(struct gltf *g, int view, int object)
{
    if (g->view[view].bytes != NULL)
        return true;
    if (g->view[view].packed_by != NULL)
        return gltf_packed(g, object, g->view[view].packed_by);
    return json_fail(&g->json, object, "bufferView", g->f, "its bytes are in a buffer that has neither a uri nor a BIN chunk");
}

void gltf_free_buffers(struct gltf *g)
{
    for (int i = 0; i < g->buffer_count; i++)
        free(g->owned_buffer[i]);
    free(g->owned_buffer);
    free(g->buffer);
    free(g->view);
}
