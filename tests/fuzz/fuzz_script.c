/* SPDX-License-Identifier: MIT */
/* fuzz_script.c - libFuzzer target: any bytes are recorded input (tools/view/script.h) or are refused with a line; what is
 * played can be recorded, and plays the same. The first byte chooses between the bytes themselves and lines made of them. */
#include "tests/fuzz/require.h"
#include "tools/view/script.h"

#include "tools/image/image.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static size_t write_lines(const uint8_t *data, size_t size, char *text, size_t room)
{
    size_t length = 0;
    long tick = 0;
    for (size_t i = 0; i + 5 <= size && length + 100 < room; i += 5) {
        const uint8_t *b = data + i;
        char name[16];
        tick += b[0] % 8 == 7 ? -1 : b[0] % 4;
        if (b[1] % 4 == 0)
            length += (size_t)snprintf(text + length, room - length, "%ld drag %d %d %d\n", tick, b[2] % 4, b[3] - 128, (b[4] - 128) * 997);
        else if (b[1] % 4 == 1)
            length += (size_t)snprintf(text + length, room - length, "%ld wheel %d\n", tick, b[2] - 128);
        else
            length += (size_t)snprintf(text + length, room - length, "%ld key %s\n", tick, key_name(b[2] + (b[3] & 1) * 256, name));
    }
    return length;
}

static void play_and_record(const char *path, const char *again, int *events)
{
    struct script played = { .text = NULL }, recorded = { .text = NULL };
    struct failure f = { "" };
    struct event event;
    bool ok = script_play(&played, path, &f);
    require(ok == (f.text[0] == '\0'));
    *events = 0;
    if (ok) {
        require(script_record(&recorded, again, &f));
        for (; script_event(&played, 1L << 40, &event); ++*events)
            script_note(&recorded, *events, &event);
        require(script_end(&recorded, &f));
    }
    script_close(&played);
    script_close(&recorded);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char path[64], again[80], third[80], text[8192];
    struct failure f = { "" };
    int events, events_again;
    if (path[0] == '\0') {
        snprintf(path, sizeof path, "/tmp/smear-script.%ld", (long)getpid());
        snprintf(again, sizeof again, "%s.again", path);
        snprintf(third, sizeof third, "%s.third", path);
    }
    if (size < 1)
        return 0;
    if (data[0] & 1) {
        size_t length = write_lines(data + 1, size - 1, text, sizeof text);
        require(file_write(path, (const uint8_t *)text, length, &f));
    } else {
        require(file_write(path, data + 1, size - 1, &f));
    }
    play_and_record(path, again, &events);
    if (events > 0) {
        play_and_record(again, third, &events_again);
        require(events == events_again);
    }
    unlink(path);
    unlink(again);
    unlink(third);
    return 0;
}
