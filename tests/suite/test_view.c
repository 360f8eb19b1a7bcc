/* SPDX-License-Identifier: MIT */
/* test_view.c - the parts of `smear view` that need no screen: layouts of pixels, the panel's
 * place, what a bus makes of a frame, bytes of terminals, recorded input, the turned camera. */
#include "tests/host.h"

#include "tools/player/picture.h"
#include "tools/scenes/methods.h"
#include "tools/scenes/present.h"
#include "tools/scenes/xform.h"
#include "tools/view/board.h"
#include "tools/view/evdev.h"
#include "tools/view/font.h"
#include "tools/view/orbit.h"
#include "tools/view/panel.h"
#include "tools/view/surface.h"
#include "tools/view/tiles.h"
#include "tools/view/tty.h"
#include "tools/view/x11.h"

#include <unistd.h>

/* ------------------------------------------------------------------ layouts */

static const uint32_t mask_888[3] = { 0xff0000, 0xff00, 0xff };
static const uint32_t mask_565[3] = { 0xf800, 0x7e0, 0x1f };
static const uint32_t mask_bgr[3] = { 0xff, 0xff00, 0xff0000 };
static const uint32_t mask_30[3] = { 0x3ff00000, 0xffc00, 0x3ff };

static bool packs_to(int bits, const uint32_t mask[3], bool big, uint32_t pixel,
                     const char *expected)
{
    struct layout l;
    uint8_t out[5] = { 0, 0, 0, 0, 0x5a };
    char text[16];
    if (!layout_from_masks(&l, bits, mask, big))
        return false;
    out[l.bytes] = 0x5a;
    layout_pack(&l, out, &pixel, 1);
    int length = 0;
    for (int i = 0; i < l.bytes; i++)
        length += snprintf(text + length, sizeof text - (size_t)length, "%02x", out[i]);
    return strcmp(text, expected) == 0 && out[l.bytes] == 0x5a;
}

static void test_pixels_are_packed_by_masks_and_byte_order(void)
{
    CHECK(packs_to(32, mask_888, false, 0x123456, "56341200"));
    CHECK(packs_to(32, mask_888, true, 0x123456, "00123456"));
    CHECK(packs_to(32, mask_bgr, false, 0x123456, "12345600"));
    CHECK(packs_to(24, mask_888, false, 0x123456, "563412"));
    CHECK(packs_to(24, mask_888, true, 0x123456, "123456"));
    CHECK(packs_to(16, mask_565, false, 0xf8fc08, "e1ff"));
    CHECK(packs_to(16, mask_565, true, 0xf8fc08, "ffe1"));
    CHECK(packs_to(32, mask_30, false, 0xff00ff, "ff03f03f"));
}

static void test_layouts_that_are_none_are_refused(void)
{
    struct layout l;
    const uint32_t gap[3] = { 0xf0f000, 0xff00, 0xff }, none[3] = { 0xff0000, 0, 0xff };
    CHECK(!layout_from_masks(&l, 32, gap, false));
    CHECK(!layout_from_masks(&l, 32, none, false));
    CHECK(!layout_from_masks(&l, 8, mask_888, false));
    CHECK(!layout_from_masks(&l, 16, mask_888, false));
    CHECK(layout_from_masks(&l, 24, mask_888, false) && !layout_is_native(&l));
}

/* ------------------------------------------------------------------ the panel */

enum { W = 6, H = 4 };

static uint32_t codes[W * H], shown[64 * 64];

/* Pixel (x, y) holds its own place. */
static void fill_codes(void)
{
    for (uint32_t i = 0; i < W * H; i++)
        codes[i] = (i % W) << 16 | (i / W) << 8 | 1;
}

static struct surface surface_of(int width, int height)
{
    memset(shown, 0x77, sizeof shown);
    return (struct surface){ width, height, 64, shown };
}

static uint32_t at(int x, int y)
{
    return shown[y * 64 + x];
}

static void test_every_pixel_of_the_panel_is_where_it_is_located(void)
{
    fill_codes();
    for (int turns = 0; turns < 4; turns++)
        for (int zoom = 1; zoom <= 3; zoom++) {
            struct panel_look look = { .zoom = zoom, .turns = turns };
            struct surface s = surface_of(40, 37);
            struct panel_place place = panel_place_on(&look, W, H, &s);
            panel_show(&look, &place, codes, W, H, &s);
            int hits = 0;
            for (int v = 0; v < s.height; v++)
                for (int u = 0; u < s.width; u++) {
                    int x, y;
                    bool inside = u >= place.x && u < place.x + place.width && v >= place.y &&
                                  v < place.y + place.height;
                    panel_locate(&look, &place, W, H, u, v, &x, &y);
                    if (inside && (x < 0 || y < 0 || x >= W || y >= H || at(u, v) != codes[y * W + x]))
                        CHECK(!"a pixel is elsewhere");
                    hits += inside;
                    if (!inside && (at(u, v) & 0xff) == 1)
                        CHECK(!"a pixel beside the panel");
                }
            CHECK_EQ(hits, W * H * zoom * zoom);
            CHECK_EQ(at(40, 0), 0x77777777);
        }
}

static void test_a_turned_panel_is_turned_clockwise(void)
{
    fill_codes();
    struct panel_look look = { .zoom = 1, .turns = 1 };
    struct surface s = surface_of(H, W);
    struct panel_place place = panel_place_on(&look, W, H, &s);
    panel_show(&look, &place, codes, W, H, &s);
    CHECK_EQ(at(H - 1, 0), codes[0]);               /* top left goes to top right */
    CHECK_EQ(at(0, 0), codes[(H - 1) * W]);
    CHECK_EQ(at(H - 1, W - 1), codes[W - 1]);
}

static void test_zoom_is_the_largest_that_fits(void)
{
    const struct panel_look look = { .zoom = 0 }, fixed = { .zoom = 2 };
    struct surface s = surface_of(6 * 5 + 3, 4 * 5);
    CHECK_EQ(panel_place_on(&look, W, H, &s).zoom, 5);
    s.height--;
    CHECK_EQ(panel_place_on(&look, W, H, &s).zoom, 4);
    s = surface_of(64, 64);
    CHECK_EQ(panel_place_on(&look, W, H, &s).zoom, 8);
    s = surface_of(5, 30);
    struct panel_place place = panel_place_on(&look, W, H, &s);
    CHECK_EQ(place.zoom, 0);
    CHECK_EQ(place.width, 5);
    CHECK_EQ(place.height, 3);
    CHECK_EQ(panel_place_on(&fixed, W, H, &s).zoom, 2);
}

static void test_a_panel_larger_than_the_surface_is_cut_or_shrunk_within_it(void)
{
    fill_codes();
    for (int zoom = 0; zoom <= 8; zoom += 4)
        for (int width = 1; width <= 9; width++)
            for (int height = 1; height <= 9; height++) {
                struct panel_look look = { .zoom = zoom, .round = true, .turns = width & 3 };
                struct surface s = surface_of(width, height);
                struct panel_place place = panel_place_on(&look, W, H, &s);
                panel_show(&look, &place, codes, W, H, &s);
                for (int v = 0; v < 12; v++)
                    for (int u = 0; u < 12; u++)
                        if ((u < width && v < height) == (at(u, v) == 0x77777777))
                            CHECK(!"outside the surface, or not filled");
            }
}

/* The widest frame, doubled, with its last pixel first. */
static void test_the_widest_panel_is_turned(void)
{
    enum { WIDEST = 2 * 2048 };
    static uint32_t wide[WIDEST], out[WIDEST];
    const struct panel_look look = { .zoom = 1, .turns = 2 };
    const struct surface s = { WIDEST, 1, WIDEST, out };
    for (uint32_t i = 0; i < WIDEST; i++)
        wide[i] = i;
    const struct panel_place place = panel_place_on(&look, WIDEST, 1, &s);
    panel_show(&look, &place, wide, WIDEST, 1, &s);
    for (uint32_t i = 0; i < WIDEST; i++)
        CHECK_EQ(out[i], WIDEST - 1 - i);
}

static void test_shrinking_keeps_the_mean(void)
{
    for (int i = 0; i < W * H; i++)
        codes[i] = i & 1 ? 0xff0080 : 0x010000;
    const struct panel_look look = { .zoom = 0 };
    struct surface s = surface_of(3, 2);
    struct panel_place place = panel_place_on(&look, W, H, &s);
    panel_show(&look, &place, codes, W, H, &s);
    for (int i = 0; i < 6; i++)
        CHECK_EQ(at(i % 3, i / 3), 0x800040);
}

static void test_a_round_glass_hides_the_corners_only(void)
{
    fill_codes();
    const struct panel_look look = { .zoom = 1, .round = true };
    struct surface s = surface_of(W, H);
    struct panel_place place = panel_place_on(&look, W, H, &s);
    panel_show(&look, &place, codes, W, H, &s);
    CHECK((at(0, 0) & 0xff) != 1 && (at(W - 1, H - 1) & 0xff) != 1);
    CHECK_EQ(at(2, 0), codes[2]);
    CHECK_EQ(at(0, 2), codes[2 * W]);
}

static void test_greys_run_between_the_panels_colours(void)
{
    const uint32_t greys[2] = { 0, 0xffffff };
    const struct panel_look look = { .zoom = 1, .has_tint = true, .dark = 0x102030,
                                     .lit = 0xa0b0c0 };
    struct surface s = surface_of(2, 1);
    struct panel_place place = panel_place_on(&look, 2, 1, &s);
    panel_show(&look, &place, greys, 2, 1, &s);
    CHECK_EQ(at(0, 0), 0x102030);
    CHECK_EQ(at(1, 0), 0xa0b0c0);
}

/* What a format's bytes look like is one rule: that of the pictures which `render` writes. */
static void test_codes_are_those_of_picture_files(void)
{
    enum { EDGE = 16 };
    uint32_t seed = 7, out[EDGE * EDGE];
    _Alignas(4) uint8_t bytes[EDGE * EDGE * 4];
    for (size_t i = 0; i < sizeof bytes; i++) {
        seed = seed * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(seed >> 24);
    }
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1_PAGES; format++) {
        struct failure f = { "" };
        struct panel_codes c;
        struct image image OWNED(image_free) = { 0 };
        size_t stride = EDGE * 4;
        if (!CHECK(panel_codes_open(&c, (smear_format)format, &f)) ||
            !CHECK(image_alloc(&image, EDGE, EDGE, &f)))
            return;
        if (format == SMEAR_XRGB8888)
            for (int i = 0; i < EDGE * EDGE; i++)
                memset(bytes + 4 * i + 3, 0, 1);
        CHECK(panel_decode(&c, bytes, stride, EDGE, EDGE, out, &f));
        picture_expand(&image, bytes, stride, (smear_format)format);
        int wrong = 0;
        for (int i = 0; i < EDGE * EDGE; i++)
            wrong += out[i] != ((uint32_t)image.rgba[4 * i] << 16 |
                                (uint32_t)image.rgba[4 * i + 1] << 8 | image.rgba[4 * i + 2]);
        CHECK_EQ(wrong, 0);
        panel_codes_close(&c);
    }
}

static void test_letters_stay_within_the_surface(void)
{
    for (int x = -30; x < 40; x += 7)
        for (int y = -20; y < 40; y += 5) {
            struct surface s = surface_of(33, 29);
            font_draw(&s, x, y, 2, "gW~\x80");
            for (int v = 0; v < 40; v++)
                for (int u = 0; u < 60; u++)
                    if ((u >= 33 || v >= 29) && at(u, v) != 0x77777777)
                        CHECK(!"a letter outside");
        }
}

/* All printable characters look different, and none is empty but the blank. */
static void test_letters_differ(void)
{
    static uint32_t seen[95][FONT_WIDTH * FONT_HEIGHT];
    for (int c = 0; c < 95; c++) {
        char text[2] = { (char)(32 + c), '\0' };
        struct surface s = surface_of(FONT_WIDTH, FONT_HEIGHT);
        font_draw(&s, 0, 0, 1, text);
        for (int i = 0; i < FONT_WIDTH * FONT_HEIGHT; i++)
            seen[c][i] = at(i % FONT_WIDTH, i / FONT_WIDTH);
        for (int other = 0; other < c; other++)
            if (memcmp(seen[c], seen[other], sizeof seen[c]) == 0)
                CHECK(!"two letters look alike");
    }
}

/* ------------------------------------------------------------------ the bus */

static void test_a_frame_takes_its_time_on_the_wire(void)
{
    const struct bus spi = { .hz = 8e6 }, none = { .hz = 0 };
    CHECK_CLOSE(bus_wire_us(&spi, 1024), 1024.0, 1e-9);
    CHECK_CLOSE(bus_wire_us(&none, 1024), 0.0, 0.0);
}

/* By simulation: when each row was written, and when the refresh under way reads it. */
static void test_the_tear_is_where_reading_and_writing_meet(void)
{
    enum { ROWS = 200 };
    const double panel_hz = 57.0, refresh = 1e6 / panel_hz;
    const double writes[] = { 3000.0, 9000.0, 16000.0, 20000.0, 40000.0, 95000.0 };
    int torn = 0;
    for (int w = 0; w < 6; w++) {
        const struct bus bus = { .hz = 1e6, .panel_hz = panel_hz };
        double write = writes[w], frame = fmax(write, 33333.0);
        for (long index = 0; index < 50; index++) {
            bool old_above;
            int tear = bus_tear(&bus, index, frame, write, ROWS, &old_above);
            double start = (double)index * frame;
            double scan = write > refresh ? ceil((start + write / 2) / refresh) * refresh
                                          : floor(start / refresh) * refresh;
            torn += tear > 0 && tear < ROWS;
            for (int row = 0; row < ROWS && tear < ROWS; row++) {
                double written = start + write * row / ROWS, read = scan + refresh * row / ROWS;
                bool is_old = (row < tear) == old_above;
                /* a row at the crossing may count either way */
                if (fabs(written - read) > (write + refresh) / ROWS && is_old != (read < written))
                    CHECK(!"a row is of the wrong frame");
            }
            /* one frame only: reading and writing do not cross within the rows */
            double ahead = start - scan, behind = ahead + write - refresh;
            if (tear == ROWS && ahead * behind < -(write + refresh) * (write + refresh) / ROWS)
                CHECK(!"a tear is missing");
        }
    }
    CHECK(torn > 100);
}

static void test_panels_in_step_do_not_tear(void)
{
    bool old_above;
    const struct bus synced = { .hz = 1e6, .panel_hz = 60, .synced = true };
    const struct bus patient = { .hz = 1e6, .panel_hz = 0 };
    for (long i = 0; i < 20; i++) {
        CHECK_EQ(bus_tear(&synced, i, 50000, 40000, 100, &old_above), 100);
        CHECK_EQ(bus_tear(&patient, i, 50000, 40000, 100, &old_above), 100);
    }
}

/* ------------------------------------------------------------------ terminals */

static struct event decoded(const char *bytes, bool is_last, int *taken)
{
    struct event e;
    *taken = tty_decode((const unsigned char *)bytes, (int)strlen(bytes), is_last, &e);
    return e;
}

static bool is_key(const char *bytes, int key)
{
    int taken;
    struct event e = decoded(bytes, true, &taken);
    return e.kind == EVENT_KEY && e.key == key && taken == (int)strlen(bytes);
}

static void test_keys_of_terminals_are_known(void)
{
    CHECK(is_key("b", 'b') && is_key("?", '?') && is_key(" ", ' '));
    CHECK(is_key("\r", SCREEN_ENTER) && is_key("\n", SCREEN_ENTER) && is_key("\t", SCREEN_TAB));
    CHECK(is_key("\033", SCREEN_ESCAPE));
    CHECK(is_key("\033[A", SCREEN_UP) && is_key("\033OA", SCREEN_UP));
    CHECK(is_key("\033[B", SCREEN_DOWN) && is_key("\033[C", SCREEN_RIGHT) && is_key("\033[D", SCREEN_LEFT));
    CHECK(is_key("\033[H", SCREEN_HOME) && is_key("\033[1~", SCREEN_HOME) && is_key("\033[F", SCREEN_END));
    CHECK(is_key("\033[5~", SCREEN_PAGE_UP) && is_key("\033[6~", SCREEN_PAGE_DOWN));
}

/* Codes of <linux/input-event-codes.h>. */
static void test_keys_of_input_devices_are_known(void)
{
#ifdef __linux__
    CHECK(evdev_key(2) == '1' && evdev_key(11) == '0' && evdev_key(16) == 'q' && evdev_key(30) == 'a' && evdev_key(45) == 'x');
    CHECK(evdev_key(52) == '.' && evdev_key(57) == ' ' && evdev_key(1) == SCREEN_ESCAPE && evdev_key(28) == SCREEN_ENTER);
    CHECK(evdev_key(103) == SCREEN_UP && evdev_key(105) == SCREEN_LEFT && evdev_key(106) == SCREEN_RIGHT && evdev_key(108) == SCREEN_DOWN);
    CHECK(evdev_key(0x130) == 'a' && evdev_key(0x136) == SCREEN_LEFT && evdev_key(0x137) == SCREEN_RIGHT);
    CHECK(evdev_key(0x13b) == SCREEN_ENTER && evdev_key(0x13c) == SCREEN_ESCAPE && evdev_key(0x220) == SCREEN_UP);
    CHECK(evdev_key(0) == 0 && evdev_key(29) == 0 && evdev_key(0x2ff) == 0 && evdev_key(-1) == 0);
#endif
}

static void test_half_a_sequence_waits_for_the_rest(void)
{
    int taken;
    decoded("\033", false, &taken);
    CHECK_EQ(taken, 0);
    decoded("\033[", false, &taken);
    CHECK_EQ(taken, 0);
    decoded("\033[<0;1", false, &taken);
    CHECK_EQ(taken, 0);
    CHECK_EQ(decoded("\033[", true, &taken).kind, EVENT_EXPOSE);
    CHECK_EQ(taken, 2);
}

static void test_the_pointer_of_terminals_drags_and_scrolls(void)
{
    int taken;
    CHECK_EQ(decoded("\033[<0;10;5M", true, &taken).kind, EVENT_EXPOSE);    /* pressed */
    struct event e = decoded("\033[<32;13;4M", true, &taken);
    CHECK(e.kind == EVENT_DRAG && e.button == 1 && e.x == 3 && e.y == -2);
    CHECK_EQ(decoded("\033[<0;13;4m", true, &taken).kind, EVENT_EXPOSE);    /* released */
    CHECK_EQ(decoded("\033[<35;20;4M", true, &taken).kind, EVENT_EXPOSE);   /* moved without */
    e = decoded("\033[<64;1;1M", true, &taken);
    CHECK(e.kind == EVENT_WHEEL && e.y == 1);
    e = decoded("\033[<65;1;1M", true, &taken);
    CHECK(e.kind == EVENT_WHEEL && e.y == -1);
    CHECK_EQ(taken, 10);
}

static void test_ctrl_c_closes(void)
{
    int taken;
    CHECK_EQ(decoded("\003", true, &taken).kind, EVENT_CLOSE);
    CHECK_EQ(decoded("\034", true, &taken).kind, EVENT_CLOSE);
}

/* Any bytes are taken in the end, and never more than there are. */
static void test_wild_bytes_are_taken(void)
{
    uint32_t seed = 3;
    unsigned char bytes[64];
    static const char sequence[] = "\033[<;0123456789MmABCD~O";
    for (int round = 0; round < 20000; round++) {
        int count = 0;
        while (count < 64 && (count == 0 || seed >> 24 > 8)) {
            seed = seed * 1664525u + 1013904223u;
            bytes[count++] = seed >> 20 & 1 ? (unsigned char)(seed >> 12)
                                            : (unsigned char)sequence[(seed >> 8) % 22];
        }
        for (int left = count; left > 0;) {
            struct event e;
            int taken = tty_decode(bytes + (count - left), left, true, &e);
            REQUIRE(taken > 0 && taken <= left);
            left -= taken;
        }
    }
}

/* ------------------------------------------------------------------ the camera */

/* A scene by its own camera, and by one that turns about what that looks at. */
struct seen {
    struct failure f;
    struct scene scene;
    struct orbit orbit;
    struct scene_instant own, turned;
};

static bool seen_open(struct seen *s, const char *name)
{
    if (!CHECK(scene_builtin(name, &s->scene, &s->f)))
        return false;
    orbit_open(&s->orbit, &s->scene);
    return CHECK(orbit_find_focus(&s->orbit, 0.0, &s->f));
}

static void seen_close(struct seen *s)
{
    scene_instant_free(&s->scene, &s->own);
    scene_instant_free(&s->orbit.scene, &s->turned);
    scene_free(&s->scene);
}

static bool seen_at(struct seen *s, double time)
{
    return scene_pose(&s->scene, time, &s->own, &s->f) && scene_pose(&s->orbit.scene, time, &s->turned, &s->f);
}

/* After half a second of a round in two, the eye is a quarter further, and it is back after all of it. */
static void test_a_turntable_goes_round(void)
{
    struct seen s OWNED(seen_close) = { 0 };
    END_UNLESS(seen_open(&s, "peer/E"));
    struct orbit *const orbit = &s.orbit;
    orbit->spin = 3.14159265358979323846;
    for (int quarter = 0; quarter <= 4; quarter++) {
        double time = quarter * 0.5;
        CHECK(seen_at(&s, time));
        const double *a = s.own.camera.pose, *b = s.turned.camera.pose;
        /* of where both look along the ground: the cosine between */
        double dot = (a[8] * b[8] + a[10] * b[10]) / (hypot(a[8], a[10]) * hypot(b[8], b[10]));
        CHECK(fabs(dot - (quarter % 2 ? 0.0 : quarter == 2 ? -1.0 : 1.0)) < 1e-9);
    }
    orbit_reset(orbit);
    CHECK(!orbit_is_turned(orbit));
}

/* What the camera looks at stays in the middle, at the distance that was asked for. */
static void test_a_turned_camera_looks_at_the_same_point(void)
{
    struct seen s OWNED(seen_close) = { 0 };
    END_UNLESS(seen_open(&s, "demo/race"));
    struct orbit *const orbit = &s.orbit;
    for (int i = 0; i < 40; i++) {
        orbit_turn(orbit, 0.37, i & 1 ? 0.3 : -0.17);
        orbit_move(orbit, i & 2 ? 1.1 : 0.9);
        CHECK(seen_at(&s, 0.1));
        struct vec3 point[2], eye[2];
        for (int k = 0; k < 2; k++) {
            const double *p = k == 0 ? s.own.camera.pose : s.turned.camera.pose;
            double distance = orbit->focus * (k == 0 ? 1.0 : orbit->distance);
            eye[k] = vec3(p[12], p[13], p[14]);
            point[k] = vec3_sub(eye[k], vec3_scale(vec3(p[8], p[9], p[10]), distance));
            struct vec3 x = vec3(p[0], p[1], p[2]), y = vec3(p[4], p[5], p[6]);
            CHECK_CLOSE(vec3_length(x), 1.0, 1e-9);
            CHECK_CLOSE(vec3_dot(x, y), 0.0, 1e-9);
        }
        CHECK_CLOSE(vec3_length(vec3_sub(point[0], point[1])), 0.0, 1e-6);
    }
}

/* ------------------------------------------------------------------ tiles */

struct noted {
    smear_context *ctx;
    struct tiles tiles;
};

static int note_band(void *user, const smear_band *band)
{
    struct noted *n = user;
    tiles_note(&n->tiles, n->ctx, band);
    return 0;
}

/* What is noted of the tiles one by one adds up to what the library counts. */
static void check_tiles(struct presenter *p, const struct present_options *o, bool sharp)
{
    enum { WIDTH = 250, HEIGHT = 130 };
    struct failure f = { "" };
    struct noted n = { .ctx = NULL };
    const struct presented *frame = presenter_frame(p, 0.4, o, &f);
    REQUIRE(frame != NULL && tiles_open(&n.tiles, WIDTH, HEIGHT, &f));
    smear_desc desc = presented_desc(frame, WIDTH, HEIGHT);
    desc.max_triangles *= 4;
    if (!sharp)
        desc.methods |= SMEAR_SET(SMEAR_RECONSTRUCT);
    present_tiles(&desc, false);
    desc.flush = note_band;
    desc.user = &n;
    size_t bytes = smear_memory_size(&desc);
    void *memory = malloc(bytes);
    uint32_t count[SMEAR_METHOD_COUNT] = { 0 }, kinds[TILES_KINDS] = { 0 };
    smear_stats s;
    CHECK_EQ(smear_init(&n.ctx, &desc, memory, bytes), SMEAR_OK);
    CHECK_EQ(presented_submit(frame, n.ctx), SMEAR_OK);
    CHECK_EQ(smear_render(n.ctx), SMEAR_OK);
    smear_get_stats(n.ctx, &s);
    for (int i = 0; i < n.tiles.columns * n.tiles.rows; i++) {
        const struct tile_note *tile = &n.tiles.note[i];
        count[tile->method]++;
        kinds[tile->kind]++;
        CHECK(tile->method == SMEAR_NONE ? tile->samples == 1 : tile->samples > 1);
    }
    for (int i = 0; i < SMEAR_METHOD_COUNT; i++)
        CHECK_EQ(count[i], s.tiles[i]);
    CHECK_EQ(kinds[TILES_STILL], s.tiles_static);
    CHECK_EQ(kinds[TILES_UNIFORM], s.tiles_uniform);
    CHECK_EQ(kinds[TILES_COMPLEX], s.tiles_complex);
    /* one of the scenes has a still camera */
    CHECK(o->method == SMEAR_NONE || o->method == SMEAR_CAMERA || kinds[TILES_UNIFORM] + kinds[TILES_COMPLEX] > 0);
    free(memory);
    tiles_close(&n.tiles);
}

static void test_tiles_are_noted_as_they_are_counted(void)
{
    CHECK_EQ(method_count, SMEAR_METHOD_COUNT - 1);
    static const char *const scenes[] = { "demo/drone", "suite/textured" };
    struct failure f = { "" };
    for (int k = 0; k < 2; k++) {
        struct scene scene OWNED(scene_free) = { 0 };
        REQUIRE(scene_builtin(scenes[k], &scene, &f));
        struct presenter *p = presenter_new(&scene, &f);
        for (int i = 0; i < method_count; i++) {
            const smear_method method = method_list[i].method;
            struct present_options o = { .fps = 30, .shutter_degrees = 180, .method = method };
            check_tiles(p, &o, !smear_method_is_filter((int)method) && method != SMEAR_AUTO);
        }
        presenter_free(p);
    }
}

/* Of a display that keeps what it shows, bands are parts of rows: what none of them covers is still. */
static void test_tiles_that_are_not_sent_are_noted_as_still(void)
{
    enum { WIDTH = 250, HEIGHT = 130, FRAMES = 4 };
    struct failure f = { "" };
    struct scene scene OWNED(scene_free) = { 0 };
    struct noted n = { .ctx = NULL };
    struct present_options o = { .fps = 30, .shutter_degrees = 180, .method = SMEAR_AUTO };
    REQUIRE(scene_builtin("suite/propeller", &scene, &f) && tiles_open(&n.tiles, WIDTH, HEIGHT, &f));
    struct presenter *p = presenter_new(&scene, &f);
    void *memory = NULL;
    uint32_t kept = 0;
    for (int k = 0; k < FRAMES; k++) {
        const struct presented *frame = presenter_frame(p, 0.4 + k / 30.0, &o, &f);
        if (!CHECK(frame != NULL))
            break;
        if (k == 0) {
            smear_desc desc = presented_desc(frame, WIDTH, HEIGHT);
            desc.max_triangles *= 4;
            desc.tile = 16;
            desc.reuse.buffer_age = 1;
            desc.flush = note_band;
            desc.user = &n;
            memory = malloc(smear_memory_size(&desc));
            CHECK_EQ(smear_init(&n.ctx, &desc, memory, smear_memory_size(&desc)), SMEAR_OK);
        }
        smear_stats s;
        uint32_t still = 0;
        tiles_begin(&n.tiles);
        CHECK_EQ(presented_submit(frame, n.ctx), SMEAR_OK);
        CHECK_EQ(smear_render(n.ctx), SMEAR_OK);
        smear_get_stats(n.ctx, &s);
        CHECK_EQ(n.tiles.columns, 16);
        CHECK_EQ(n.tiles.rows, 9);
        for (int i = 0; i < n.tiles.columns * n.tiles.rows; i++)
            still += n.tiles.note[i].method == SMEAR_NONE;
        CHECK_EQ(still, s.tiles[SMEAR_NONE]);
        kept += s.tiles_kept;
    }
    CHECK(kept > 0);
    free(memory);
    tiles_close(&n.tiles);
    presenter_free(p);
}

/* ------------------------------------------------------------------ cookies, boards */

static void put_field(FILE *to, const void *bytes, unsigned size)
{
    fputc((int)(size >> 8), to);
    fputc((int)(size & 255), to);
    fwrite(bytes, 1, size, to);
}

static void put_cookie(FILE *to, unsigned family, const char *address, const char *number,
                       const char *method, int fill)
{
    uint8_t data[X11_COOKIE];
    memset(data, fill, sizeof data);
    fputc((int)(family >> 8), to);
    fputc((int)(family & 255), to);
    put_field(to, address, (unsigned)strlen(address));
    put_field(to, number, (unsigned)strlen(number));
    put_field(to, method, (unsigned)strlen(method));
    put_field(to, data, sizeof data);
}

static void test_the_cookie_of_the_display_is_found(void)
{
    static const char path[] = "build/test-view-cookies";
    const char *kept = getenv("XAUTHORITY");
    char host[256] = "";
    uint8_t cookie[X11_COOKIE];
    gethostname(host, sizeof host - 1);
    FILE *to = fopen(path, "wb");
    REQUIRE(to != NULL);
    put_cookie(to, 256, host, "7", "MIT-MAGIC-COOKIE-1", 1);
    put_cookie(to, 256, "elsewhere", "8", "MIT-MAGIC-COOKIE-1", 2);
    put_cookie(to, 256, host, "8", "XDM-AUTHORIZATION-1", 3);
    put_cookie(to, 65535, "", "8", "MIT-MAGIC-COOKIE-1", 4);
    put_cookie(to, 256, host, "9", "MIT-MAGIC-COOKIE-1", 5);
    fputs("\001\000\000\004cut", to);
    fclose(to);
    setenv("XAUTHORITY", path, 1);
    CHECK(x11_find_cookie(7, cookie) && cookie[0] == 1);
    CHECK(x11_find_cookie(8, cookie) && cookie[0] == 4);
    CHECK(x11_find_cookie(9, cookie) && cookie[15] == 5);
    CHECK(!x11_find_cookie(10, cookie));
    setenv("XAUTHORITY", "build/no-such-file", 1);
    CHECK(!x11_find_cookie(7, cookie));
    if (kept != NULL)
        setenv("XAUTHORITY", kept, 1);
    else
        unsetenv("XAUTHORITY");
    unlink(path);
}

static void test_boards_have_names_of_their_own(void)
{
    for (const struct board *b = board_list; b->name != NULL; b++)
        CHECK(board_find(b->name) == b);
    CHECK(board_find("nothing") == NULL);
}

#include "build/suites/view.h"
