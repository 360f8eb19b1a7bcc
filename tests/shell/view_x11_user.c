/* SPDX-License-Identifier: MIT */
/* view_x11_user.c - what a user and his window manager do to a window, and what he sees:
 *
 *     view_x11_user find TITLE             prints the window's number and size
 *     view_x11_user shot WINDOW OUT.png    its picture
 *     view_x11_user key WINDOW KEYSYM [STATE]
 *     view_x11_user press WINDOW BUTTON X Y | release ... | move ...
 *     view_x11_user size WINDOW WIDTH HEIGHT
 *     view_x11_user close WINDOW           WM_DELETE_WINDOW
 *     view_x11_user destroy WINDOW
 *
 * Exit status 1 when it cannot. */
#include "tools/image/image.h"
#include "tools/view/x11.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CONFIGURE = 12, DESTROY = 4, GEOMETRY = 14, QUERY_TREE = 15, GET_PROPERTY = 20, SEND = 25,
       GET_IMAGE = 73, GET_KEYBOARD = 101 };
enum { WM_NAME = 39, STRING = 31 };

static struct x11 x;

struct small {
    uint8_t code, detail;
    uint16_t length;
    uint32_t window;
};

static void ask(uint8_t code, uint32_t window)
{
    struct small request = { code, 0, 2, window };
    x11_send(&x, &request, sizeof request, NULL, 0);
}

static bool geometry(uint32_t window, int *width, int *height)
{
    uint8_t reply[X11_PACKET];
    ask(GEOMETRY, window);
    if (!x11_reply(&x, reply, NULL, NULL))
        return false;
    *width = x11_get16(reply + 16);
    *height = x11_get16(reply + 18);
    return true;
}

static bool has_title(uint32_t window, const char *title)
{
    struct {
        uint8_t code, remove;
        uint16_t length;
        uint32_t window, property, type, offset, count;
    } request = { GET_PROPERTY, 0, 6, window, WM_NAME, STRING, 0, 64 };
    uint8_t reply[X11_PACKET], *body = NULL;
    size_t size = 0;
    x11_send(&x, &request, sizeof request, NULL, 0);
    if (!x11_reply(&x, reply, &body, &size) || body == NULL)
        return false;
    size_t length = x11_get32(reply + 16);
    bool is_it = length <= size && length == strlen(title) && memcmp(body, title, length) == 0;
    free(body);
    return is_it;
}

static bool find(const char *title)
{
    uint8_t reply[X11_PACKET], *body = NULL;
    size_t size = 0;
    ask(QUERY_TREE, x.root);
    if (!x11_reply(&x, reply, &body, &size))
        return false;
    for (size_t i = 0; i + 4 <= size; i += 4) {
        uint32_t window = x11_get32(body + i);
        int width, height;
        if (has_title(window, title) && geometry(window, &width, &height)) {
            printf("%lu %d %d\n", (unsigned long)window, width, height);
            free(body);
            return true;
        }
    }
    free(body);
    return false;
}

/* The code nearest to a channel's level. */
static uint8_t channel(uint32_t value, int shift, int bits)
{
    uint32_t top = (1u << bits) - 1u, level = value >> shift & top;
    return (uint8_t)((level * 510u + top) / (2u * top));
}

static bool shot(uint32_t window, const char *path)
{
    struct {
        uint8_t code, format;
        uint16_t length;
        uint32_t window;
        int16_t x, y;
        uint16_t width, height;
        uint32_t planes;
    } request = { GET_IMAGE, 2, 5, window, 0, 0, 0, 0, 0xffffffffu };
    struct failure f = { "" };
    struct image image;
    uint8_t reply[X11_PACKET], *body = NULL;
    size_t size = 0;
    int width, height, bytes = x.layout.bytes;
    if (!geometry(window, &width, &height))
        return false;
    request.width = (uint16_t)width;
    request.height = (uint16_t)height;
    x11_send(&x, &request, sizeof request, NULL, 0);
    if (!x11_reply(&x, reply, &body, &size) || !image_alloc(&image, width, height, &f))
        return false;
    size_t pad = (size_t)x.scanline_pad;
    size_t stride = ((size_t)width * (size_t)bytes * 8 + pad - 1) / pad * pad / 8;
    if (size < stride * (size_t)height)
        return false;
    for (int y = 0; y < height; y++)
        for (int i = 0; i < width; i++) {
            const uint8_t *p = body + (size_t)y * stride + (size_t)i * (size_t)bytes;
            uint8_t *to = image.rgba + 4 * ((size_t)y * (size_t)width + (size_t)i);
            uint32_t value = 0;
            for (int b = 0; b < bytes; b++)
                value |= (uint32_t)p[x.layout.big_endian ? bytes - 1 - b : b] << 8 * b;
            for (int c = 0; c < 3; c++)
                to[c] = channel(value, x.layout.shift[c], x.layout.bits[c]);
        }
    bool ok = png_save(path, &image, &f);
    image_free(&image);
    free(body);
    return ok;
}

/* The key whose first symbol it is; shifted ones come with state 1. */
static int key_code(uint32_t keysym)
{
    struct {
        uint8_t code, unused0;
        uint16_t length;
        uint8_t first, count;
        uint16_t unused1;
    } request = { GET_KEYBOARD, 0, 2, (uint8_t)x.min_key, (uint8_t)(x.max_key - x.min_key + 1), 0 };
    uint8_t reply[X11_PACKET], *body = NULL;
    size_t size = 0;
    int found = 0;
    x11_send(&x, &request, sizeof request, NULL, 0);
    if (!x11_reply(&x, reply, &body, &size))
        return 0;
    int per = reply[1];
    for (int key = x.min_key; key <= x.max_key && found == 0; key++)
        for (int i = 0; i < 2 && i < per; i++)
            if (x11_get32(body + 4 * (size_t)((key - x.min_key) * per + i)) == keysym)
                found = key;
    free(body);
    return found;
}

static bool send_event(uint32_t window, const uint32_t event[8], uint32_t mask)
{
    struct {
        uint8_t code, propagate;
        uint16_t length;
        uint32_t window, mask, event[8];
    } request = { .code = SEND, .length = 11, .window = window, .mask = mask };
    memcpy(request.event, event, sizeof request.event);
    x11_send(&x, &request, sizeof request, NULL, 0);
    return x11_check(&x);
}

static bool pointer(uint32_t window, int kind, int detail, int px, int py)
{
    uint16_t at[4] = { 0, 0, (uint16_t)px, (uint16_t)py };
    uint32_t event[8] = { (uint32_t)kind | (uint32_t)detail << 8, 0, x.root, window, 0 };
    memcpy(event + 5, at, sizeof at);
    return send_event(window, event, 0);
}

static bool close_window(uint32_t window)
{
    uint32_t event[8] = { 33u | 32u << 8, window };
    event[2] = x11_atom(&x, "WM_PROTOCOLS");
    event[3] = x11_atom(&x, "WM_DELETE_WINDOW");
    return send_event(window, event, 0);
}

static bool resize(uint32_t window, uint32_t width, uint32_t height)
{
    struct {
        uint8_t code, unused;
        uint16_t length;
        uint32_t window;
        uint16_t mask, unused1;
        uint32_t width, height;
    } request = { CONFIGURE, 0, 5, window, 4 | 8, 0, width, height };
    x11_send(&x, &request, sizeof request, NULL, 0);
    return x11_check(&x);
}

static uint32_t number(const char *text)
{
    return (uint32_t)strtoul(text, NULL, 0);
}

static bool run(int argc, char **argv)
{
    const char *what = argv[1];
    uint32_t window = number(argv[2]);
    if (strcmp(what, "find") == 0)
        return find(argv[2]);
    if (strcmp(what, "shot") == 0 && argc > 3)
        return shot(window, argv[3]);
    if (strcmp(what, "key") == 0 && argc > 3) {
        uint32_t code = (uint32_t)key_code(number(argv[3])), state = argc > 4 ? number(argv[4]) : 0;
        uint32_t event[8] = { 2u | code << 8, 0, x.root, window, 0, 0, 0, state | 1u << 16 };
        return code != 0 && send_event(window, event, 0);
    }
    if (strcmp(what, "press") == 0 && argc > 5)
        return pointer(window, 4, atoi(argv[3]), atoi(argv[4]), atoi(argv[5]));
    if (strcmp(what, "release") == 0 && argc > 5)
        return pointer(window, 5, atoi(argv[3]), atoi(argv[4]), atoi(argv[5]));
    if (strcmp(what, "move") == 0 && argc > 5)
        return pointer(window, 6, 0, atoi(argv[4]), atoi(argv[5]));
    if (strcmp(what, "size") == 0 && argc > 4)
        return resize(window, number(argv[3]), number(argv[4]));
    if (strcmp(what, "close") == 0)
        return close_window(window);
    if (strcmp(what, "destroy") == 0) {
        ask(DESTROY, window);
        return x11_check(&x);
    }
    return false;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    if (argc < 3 || !x11_connect(&x, &f)) {
        fprintf(stderr, "view_x11_user: %s\n", f.text);
        return 1;
    }
    bool ok = run(argc, argv);
    x11_disconnect(&x);
    return ok ? 0 : 1;
}
