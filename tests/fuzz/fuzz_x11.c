/* SPDX-License-Identifier: MIT */
/* fuzz_x11.c - libFuzzer target: a window at a server that greets and replies as the bytes say. The first twelve change a
 * greeting that is usual otherwise; then packets follow, each with two bytes of its own: replies in their turn, events,
 * errors, and bytes as they are. The window opens or is refused, shows pictures, takes events, and closes. */
#include "tests/fuzz/require.h"
#include "tests/x_server.h"
#include "tools/view/screen.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { ROOM = 1 << 16, PACKET = 32, FIELDS = 12 };

static void greet(const uint8_t *b, uint8_t *out)
{
    static const uint8_t pads[] = { 32, 32, 32, 8, 16, 0, 64, 33 };
    static const unsigned requests[] = { 65535, 65535, 4096, 4095, 6, 0, 16384, 5000 };
    struct x_greeting g = x_greeting_usual();
    g.pad = pads[b[0] % 8];
    g.max_request = requests[b[1] % 8];
    if (b[2] % 4 == 0)
        g.min_key = b[3], g.max_key = b[4];
    if (b[2] % 8 == 1) {
        g.depth = g.bits = 16;
        g.mask[0] = 0xf800, g.mask[1] = 0x7e0, g.mask[2] = 0x1f;
    } else if (b[2] % 8 == 2) {
        g.bits = b[5];
    } else if (b[2] % 8 == 3) {
        g.mask[b[5] % 3] = 1u << b[6] % 32;
    }
    x_greeting_write(&g, out);
    if (b[7] % 8 == 0)
        out[8 + b[8] % (X_GREETING - 8)] = b[9];
}

/* A packet of kind b[0] and its body; returns its size. */
static size_t put_packet(const uint8_t b[2], unsigned *sequence, uint8_t *out)
{
    static const uint8_t events[] = { 2, 4, 5, 6, 12, 17, 22, 33, 34, 35 };
    uint32_t words = 0;
    memset(out, b[1], PACKET);
    switch (b[0] % 4) {
    case 0:                                     /* the next reply */
    case 1:
        words = b[0] / 4 % 8 == 7 ? 1u << 20 : b[0] / 4 % 8 * 8;
        out[0] = 1;
        ++*sequence;
        break;
    case 2: out[0] = events[b[0] / 4 % sizeof events]; break;
    default: out[0] = b[0] >= 128 ? 0 : b[1]; break;
    }
    const uint16_t number = (uint16_t)(*sequence + (b[0] >= 250));
    memcpy(out + 2, &number, 2);
    if (out[0] == 1)
        memcpy(out + 4, &words, 4);
    size_t body = out[0] == 1 && words < 1000 ? words * 4 : 0;
    memset(out + PACKET, b[1], body);
    return PACKET + body;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t bytes[ROOM];
    struct failure f = { "" };
    size_t length = X_GREETING;
    unsigned sequence = 0;
    if (size < FIELDS)
        return 0;
    greet(data, bytes);
    for (size_t i = FIELDS; i + 2 <= size && length + 1024 < ROOM; i += 2)
        length += put_packet(data + i, &sequence, bytes + length);
    if (!x_server_begin(bytes, length))
        return 0;
    const struct screen_wish wish = { .title = "fuzz", .width = 1 + data[10], .height = 1 + data[11], .no_shared_memory = data[7] & 1 };
    struct screen *screen = screen_x11.open(&wish, &f);
    require(screen != NULL || f.text[0] != '\0');
    for (int i = 0; i < 6 && screen != NULL; i++) {
        struct surface surface;
        struct event event;
        if (!screen_x11.surface(screen, &surface, &f))
            break;
        surface_fill(&surface, 0, 0, surface.width, surface.height, 0x123456);
        if (!screen_x11.show(screen, NULL, &f))
            break;
        while (screen_x11.event(screen, 0, &event) && event.kind != EVENT_LOST)
            continue;
    }
    if (screen != NULL)
        screen_x11.close(screen);
    x_server_end();
    return 0;
}
