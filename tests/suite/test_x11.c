/* SPDX-License-Identifier: MIT */
/* test_x11.c - a window at servers that promise what no server should (tools/view/x11.c, screen_x11.c). Whoever sits
 * behind $DISPLAY is believed nothing that memory or time depends on. */
#include "tests/host.h"
#include "tests/x_server.h"
#include "tools/view/screen.h"
#include "tools/view/x11.h"

static bool connects(const uint8_t *bytes, size_t size, struct failure *f)
{
    struct x11 x;
    *f = (struct failure){ "" };
    if (!CHECK(x_server_begin(bytes, size)))
        return false;
    bool ok = x11_connect(&x, f);
    x11_disconnect(&x);
    x_server_end();
    return ok;
}

static bool greets(const struct x_greeting *greeting, struct failure *f)
{
    uint8_t bytes[X_GREETING];
    x_greeting_write(greeting, bytes);
    return connects(bytes, sizeof bytes, f);
}

static void test_servers_of_today_are_understood(void)
{
    struct x_greeting g = x_greeting_usual();
    struct failure f;
    CHECK(greets(&g, &f));
    g = (struct x_greeting){ .max_request = 4096, .min_key = 8, .max_key = 255, .depth = 16, .bits = 16, .pad = 16,
                             .mask = { 0xf800, 0x7e0, 0x1f } };
    CHECK(greets(&g, &f));
}

static void test_rows_that_end_nowhere_are_refused(void)
{
    static const uint8_t pads[] = { 0, 1, 7, 24, 255 };
    struct failure f;
    for (size_t i = 0; i < sizeof pads; i++) {
        struct x_greeting g = x_greeting_usual();
        g.pad = pads[i];
        CHECK(!greets(&g, &f) && strstr(f.text, "rows end at multiples of") != NULL);
    }
}

static void test_requests_too_short_for_a_picture_are_refused(void)
{
    static const unsigned words[] = { 0, 1, 5, 6, 4095 };
    struct failure f;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        struct x_greeting g = x_greeting_usual();
        g.max_request = words[i];
        CHECK(!greets(&g, &f) && strstr(f.text, "bytes only") != NULL);
    }
}

static void test_windows_wider_than_a_request_are_refused(void)
{
    uint8_t bytes[X_GREETING];
    struct x_greeting g = x_greeting_usual();
    struct failure f = { "" };
    const struct screen_wish wish = { .title = "wide", .width = 8000, .height = 2, .no_shared_memory = true };
    g.max_request = 4096;
    x_greeting_write(&g, bytes);
    REQUIRE(x_server_begin(bytes, sizeof bytes));
    struct screen *screen = screen_x11.open(&wish, &f);
    CHECK(screen == NULL && strstr(f.text, "too wide") != NULL);
    if (screen != NULL)
        screen_x11.close(screen);
    x_server_end();
}

static void test_lists_that_reach_past_the_greeting_are_refused(void)
{
    uint8_t bytes[X_GREETING];
    struct x_greeting g = x_greeting_usual();
    struct failure f;
    x_greeting_write(&g, bytes);
    bytes[8 + 21] = 255;                        /* formats */
    CHECK(!connects(bytes, sizeof bytes, &f) && strstr(f.text, "too short") != NULL);
    x_greeting_write(&g, bytes);
    bytes[8 + 16] = bytes[8 + 17] = 255;        /* letters of the vendor's name */
    CHECK(!connects(bytes, sizeof bytes, &f) && strstr(f.text, "too short") != NULL);
    x_greeting_write(&g, bytes);
    bytes[8 + 20] = 0;                          /* screens */
    CHECK(!connects(bytes, sizeof bytes, &f) && strstr(f.text, "has no screen") != NULL);
}

#include "build/suites/x11.h"
