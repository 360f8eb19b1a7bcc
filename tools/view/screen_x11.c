/* SPDX-License-Identifier: MIT */
/* screen_x11.c - a window, through x11.h. Pictures go by MIT-SHM where the server takes it, two in
 * turn, so that one is drawn while the other is read; else in strips by PutImage. */
#define _DEFAULT_SOURCE                 /* shared memory */
#include "tools/view/screen.h"

#include "tools/view/guard.h"
#include "tools/view/x11.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/shm.h>

enum {
    CREATE_WINDOW = 1, MAP_WINDOW = 8, CHANGE_PROPERTY = 18, CREATE_GC = 55, PUT_IMAGE = 72,
    QUERY_EXTENSION = 98, GET_KEYBOARD_MAPPING = 101
};
enum { SHM_ATTACH = 1, SHM_DETACH = 2, SHM_PUT_IMAGE = 3 };
enum {
    KEY_PRESS = 2, BUTTON_PRESS = 4, BUTTON_RELEASE = 5, MOTION = 6, EXPOSE = 12, DESTROY = 17,
    CONFIGURE = 22, CLIENT_MESSAGE = 33, MAPPING = 34
};
enum { SHIFT = 1, LOCK = 2 };
enum { ATOM_ATOM = 4, ATOM_STRING = 31, ATOM_WM_NAME = 39, ATOM_WM_NORMAL_HINTS = 40,
       ATOM_WM_SIZE_HINTS = 41, ATOM_WM_CLASS = 67 };
enum { Z_PIXMAP = 2, MAX_EDGE = 16384, MAX_PIXELS = 1 << 25, PUT_IMAGE_HEAD = 24 };

struct window {
    struct screen screen;
    struct x11 x;
    uint32_t window, gc, wm_protocols, wm_delete;
    uint32_t *keysym;           /* keysyms_per for each key code from x.min_key on */
    int keysyms_per;
    size_t keysym_count;

    bool has_shm;
    uint8_t shm_code, shm_event;        /* of the extension */
    uint32_t segment;           /* 0: none attached; else it has room for two pictures */
    int half, pending;          /* the one that is drawn into; those the server may still read */

    int width, height;          /* of the buffers; 0: none */
    size_t stride;              /* bytes of a row as the server wants it */
    uint8_t *bytes;             /* rows for the server: shared, or our own */
    bool is_direct;             /* layouts agree: what is drawn goes there at once */
    uint32_t *pixel;            /* else it is drawn here */

    int button, pointer_x, pointer_y;   /* a drag; button 0: none */
};

/* ------------------------------------------------------------------ requests */

static void set_property(struct window *w, uint32_t property, uint32_t type, int format,
                         const void *data, size_t count)
{
    struct {
        uint8_t code, mode;
        uint16_t length;
        uint32_t window, property, type;
        uint8_t format, unused[3];
        uint32_t count;
        uint8_t data[128];
    } request = { .code = CHANGE_PROPERTY, .window = w->window, .property = property,
                  .type = type, .format = (uint8_t)format, .count = (uint32_t)count };
    size_t bytes = count * (size_t)format / 8;
    if (bytes > sizeof request.data)
        return;
    memcpy(request.data, data, bytes);
    request.length = (uint16_t)(6 + (bytes + 3) / 4);
    x11_send(&w->x, &request, (size_t)request.length * 4, NULL, 0);
}

static void create_window(struct window *w, const struct screen_wish *wish)
{
    const uint32_t events = 1u << 0 | 1u << 2 | 1u << 3 | 1u << 13 | 1u << 15 | 1u << 17;
    struct {
        uint8_t code, depth;
        uint16_t length;
        uint32_t id, parent;
        int16_t x, y;
        uint16_t width, height, border, class;
        uint32_t visual, mask, background, events;
    } create = { CREATE_WINDOW, (uint8_t)w->x.depth, 10, x11_new_id(&w->x), w->x.root, 0, 0,
                 (uint16_t)wish->width, (uint16_t)wish->height, 0, 1, w->x.visual, 0x802, 0,
                 events };
    struct {
        uint8_t code, unused;
        uint16_t length;
        uint32_t id, drawable, mask, no_exposures;
    } create_gc = { CREATE_GC, 0, 5, x11_new_id(&w->x), create.id, 1u << 16, 0 };
    w->window = create.id;
    w->gc = create_gc.id;
    x11_send(&w->x, &create, sizeof create, NULL, 0);
    x11_send(&w->x, &create_gc, sizeof create_gc, NULL, 0);
}

static void describe_window(struct window *w, const struct screen_wish *wish)
{
    static const char class[] = "smear\0smear";
    uint32_t hints[18] = { 1u << 4 };           /* a smallest size */
    hints[5] = 64;
    hints[6] = 48;
    set_property(w, ATOM_WM_NAME, ATOM_STRING, 8, wish->title, strlen(wish->title));
    set_property(w, x11_atom(&w->x, "_NET_WM_NAME"), x11_atom(&w->x, "UTF8_STRING"), 8,
                 wish->title, strlen(wish->title));
    set_property(w, ATOM_WM_CLASS, ATOM_STRING, 8, class, sizeof class);
    set_property(w, ATOM_WM_NORMAL_HINTS, ATOM_WM_SIZE_HINTS, 32, hints, 18);
    w->wm_protocols = x11_atom(&w->x, "WM_PROTOCOLS");
    w->wm_delete = x11_atom(&w->x, "WM_DELETE_WINDOW");
    set_property(w, w->wm_protocols, ATOM_ATOM, 32, &w->wm_delete, 1);
}

static void map_window(struct window *w)
{
    struct {
        uint8_t code, unused;
        uint16_t length;
        uint32_t window;
    } request = { MAP_WINDOW, 0, 2, w->window };
    x11_send(&w->x, &request, sizeof request, NULL, 0);
}

static void read_keyboard(struct window *w)
{
    struct {
        uint8_t code, unused0;
        uint16_t length;
        uint8_t first, count;
        uint16_t unused1;
    } request = { GET_KEYBOARD_MAPPING, 0, 2, (uint8_t)w->x.min_key,
                  (uint8_t)(w->x.max_key - w->x.min_key + 1), 0 };
    uint8_t reply[X11_PACKET], *body = NULL;
    size_t size = 0;
    x11_send(&w->x, &request, sizeof request, NULL, 0);
    if (!x11_reply(&w->x, reply, &body, &size) || body == NULL)
        return;
    free(w->keysym);
    w->keysym = (uint32_t *)(void *)body;
    w->keysym_count = size / 4;
    w->keysyms_per = reply[1];
}

/* ------------------------------------------------------------------ shared memory */

static bool find_shm(struct window *w)
{
    struct {
        uint8_t code, unused0;
        uint16_t length, name_length, unused1;
        char name[8];
    } request = { QUERY_EXTENSION, 0, 4, 7, 0, "MIT-SHM" };
    uint8_t reply[X11_PACKET];
    x11_send(&w->x, &request, sizeof request, NULL, 0);
    if (!x11_reply(&w->x, reply, NULL, NULL) || reply[8] == 0)
        return false;
    w->shm_code = reply[9];
    w->shm_event = reply[10];
    return true;
}

/* A segment that both see; nothing is left behind when either dies. */
static bool attach_segment(struct window *w, size_t bytes)
{
    int shared = shmget(IPC_PRIVATE, bytes, IPC_CREAT | 0600);
    if (shared < 0)
        return false;
    void *memory = shmat(shared, NULL, 0);
    struct {
        uint8_t code, minor;
        uint16_t length;
        uint32_t segment, shared;
        uint8_t read_only, unused[3];
    } request = { w->shm_code, SHM_ATTACH, 4, x11_new_id(&w->x), (uint32_t)shared, 1, { 0 } };
    bool ok = memory != (void *)-1;
    if (ok) {
        x11_send(&w->x, &request, sizeof request, NULL, 0);
        ok = x11_check(&w->x);
        if (!ok)
            shmdt(memory);
    }
    shmctl(shared, IPC_RMID, NULL);
    if (!ok)
        return false;
    w->segment = request.segment;
    w->bytes = memory;
    return true;
}

static void detach_segment(struct window *w)
{
    struct {
        uint8_t code, minor;
        uint16_t length;
        uint32_t segment;
    } request = { w->shm_code, SHM_DETACH, 2, w->segment };
    x11_send(&w->x, &request, sizeof request, NULL, 0);
    shmdt(w->bytes);
    w->segment = 0;
    w->half = w->pending = 0;
    w->bytes = NULL;
}

/* ------------------------------------------------------------------ buffers */

static void free_buffers(struct window *w)
{
    free(w->pixel);
    w->pixel = NULL;
    if (w->segment != 0)
        detach_segment(w);
    free(w->bytes);
    w->bytes = NULL;
    w->width = w->height = 0;
}

static void tell_what(struct window *w)
{
    snprintf(w->screen.what, sizeof w->screen.what, "x11, %s, depth %d",
             w->segment != 0 ? "MIT-SHM" : "PutImage", w->x.depth);
}

/* Room for a picture of the window's size. */
static bool fit_buffers(struct window *w, struct failure *f)
{
    if (w->width == w->screen.width && w->height == w->screen.height)
        return true;
    free_buffers(w);
    size_t pad = (size_t)w->x.scanline_pad, width = (size_t)w->screen.width;
    size_t rows = (size_t)w->screen.height;
    w->stride = (width * (size_t)w->x.layout.bytes * 8 + pad - 1) / pad * pad / 8;
    if (!w->has_shm || !attach_segment(w, w->stride * rows * 2)) {
        w->has_shm = false;
        if (w->stride > w->x.max_request - PUT_IMAGE_HEAD - 4) {
            free_buffers(w);
            return fail(f, "a window %zu pixels wide is too wide for the X server's requests", width);
        }
        w->bytes = malloc(w->stride * rows + 4);        /* the last strip is sent in whole words */
    }
    w->is_direct = layout_is_native(&w->x.layout);
    if (!w->is_direct)
        w->pixel = malloc(width * rows * sizeof *w->pixel);
    if (w->bytes == NULL || (!w->is_direct && w->pixel == NULL)) {
        free_buffers(w);
        return fail(f, "out of memory");
    }
    w->width = w->screen.width;
    w->height = w->screen.height;
    tell_what(w);
    return true;
}

/* Where the server reads the next picture. */
static uint8_t *picture_bytes(const struct window *w)
{
    return w->bytes + (size_t)w->half * w->stride * (size_t)w->height;
}

static bool window_surface(struct screen *screen, struct surface *out, struct failure *f)
{
    struct window *w = (struct window *)screen;
    if (!fit_buffers(w, f))
        return false;
    /* nothing may be drawn over a picture that the server has not read yet */
    while (w->pending > 1 && x11_wait(&w->x, w->shm_event))
        w->pending--;
    *out = (struct surface){ w->width, w->height, w->is_direct ? w->stride / 4 : (size_t)w->width,
                             w->is_direct ? (uint32_t *)(void *)picture_bytes(w) : w->pixel };
    return true;
}

/* ------------------------------------------------------------------ showing */

static void put_shared(struct window *w)
{
    struct {
        uint8_t code, minor;
        uint16_t length;
        uint32_t drawable, gc;
        uint16_t total_width, total_height, source_x, source_y, width, height;
        int16_t x, y;
        uint8_t depth, format, send_event, unused;
        uint32_t segment, offset;
    } request = { w->shm_code, SHM_PUT_IMAGE, 10, w->window, w->gc,
                  (uint16_t)(w->stride / (size_t)w->x.layout.bytes), (uint16_t)w->height, 0, 0,
                  (uint16_t)w->width, (uint16_t)w->height, 0, 0, (uint8_t)w->x.depth, Z_PIXMAP, 1,
                  0, w->segment, (uint32_t)(picture_bytes(w) - w->bytes) };
    x11_send(&w->x, &request, sizeof request, NULL, 0);
    w->pending++;
    w->half = !w->half;
}

/* Strips that keep below the longest request; the round trip at the end keeps us from running ahead
 * of a slow server. */
static void put_strips(struct window *w)
{
    int rows = (int)((w->x.max_request - PUT_IMAGE_HEAD - 4) / w->stride);
    for (int y = 0; y < w->height; y += rows) {
        int n = w->height - y < rows ? w->height - y : rows;
        size_t bytes = ((size_t)n * w->stride + 3) & ~(size_t)3;
        struct {
            uint8_t code, format;
            uint16_t length;
            uint32_t drawable, gc;
            uint16_t width, height;
            int16_t x, y;
            uint8_t left_pad, depth;
            uint16_t unused;
        } request = { PUT_IMAGE, Z_PIXMAP, (uint16_t)(6 + bytes / 4), w->window, w->gc,
                      (uint16_t)w->width, (uint16_t)n, 0, (int16_t)y, 0, (uint8_t)w->x.depth, 0 };
        x11_send(&w->x, &request, sizeof request, w->bytes + (size_t)y * w->stride, bytes);
    }
    x11_check(&w->x);
}

static bool window_show(struct screen *screen, const struct text *text, struct failure *f)
{
    struct window *w = (struct window *)screen;
    (void)text;
    if (!w->is_direct)
        for (int y = 0; y < w->height; y++)
            layout_pack(&w->x.layout, picture_bytes(w) + (size_t)y * w->stride,
                        w->pixel + (size_t)y * (size_t)w->width, w->width);
    if (w->segment != 0)
        put_shared(w);
    else
        put_strips(w);
    return !w->x.is_lost || guard_is_asked() || fail(f, "the X server is gone");
}

/* ------------------------------------------------------------------ events */

static int key_of_keysym(uint32_t keysym)
{
    static const struct {
        uint32_t keysym;
        int key;
    } named[] = {
        { 0xff51, SCREEN_LEFT },      { 0xff52, SCREEN_UP },        { 0xff53, SCREEN_RIGHT },
        { 0xff54, SCREEN_DOWN },      { 0xff55, SCREEN_PAGE_UP },   { 0xff56, SCREEN_PAGE_DOWN },
        { 0xff50, SCREEN_HOME },      { 0xff57, SCREEN_END },       { 0xff0d, SCREEN_ENTER },
        { 0xff8d, SCREEN_ENTER },     { 0xff09, SCREEN_TAB },       { 0xff1b, SCREEN_ESCAPE },
        { 0xff96, SCREEN_LEFT },      { 0xff97, SCREEN_UP },        { 0xff98, SCREEN_RIGHT },
        { 0xff99, SCREEN_DOWN },      { 0xff9a, SCREEN_PAGE_UP },   { 0xff9b, SCREEN_PAGE_DOWN },
        { 0xff95, SCREEN_HOME },      { 0xff9c, SCREEN_END },
    };
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (named[i].keysym == keysym)
            return named[i].key;
    return keysym >= 32 && keysym < 127 ? (int)keysym : 0;
}

static bool take_key(struct window *w, const uint8_t *e, struct event *out)
{
    size_t first = (size_t)(e[1] - w->x.min_key) * (size_t)w->keysyms_per;
    unsigned state = x11_get16(e + 28);
    if (e[1] < w->x.min_key || w->keysyms_per < 1 ||
        first + (size_t)w->keysyms_per > w->keysym_count)
        return false;
    uint32_t plain = w->keysym[first];
    uint32_t shifted = w->keysyms_per > 1 ? w->keysym[first + 1] : 0;
    bool is_letter = plain >= 'a' && plain <= 'z';
    if (shifted == 0)
        shifted = is_letter ? plain - 32 : plain;
    bool is_shifted = state & SHIFT;
    if (is_letter && state & LOCK)
        is_shifted = !is_shifted;
    *out = (struct event){ .kind = EVENT_KEY, .key = key_of_keysym(is_shifted ? shifted : plain) };
    return out->key != 0;
}

static bool take_button(struct window *w, const uint8_t *e, struct event *out)
{
    int button = e[1];
    if (button == 4 || button == 5) {
        *out = (struct event){ .kind = EVENT_WHEEL, .y = button == 4 ? 1 : -1 };
        return true;
    }
    w->button = button <= 3 ? button : 0;
    w->pointer_x = (int16_t)x11_get16(e + 24);
    w->pointer_y = (int16_t)x11_get16(e + 26);
    return false;
}

static bool take_motion(struct window *w, const uint8_t *e, struct event *out)
{
    int x = (int16_t)x11_get16(e + 24), y = (int16_t)x11_get16(e + 26);
    *out = (struct event){ .kind = EVENT_DRAG, .button = w->button, .x = x - w->pointer_x,
                           .y = y - w->pointer_y };
    w->pointer_x = x;
    w->pointer_y = y;
    return w->button != 0;
}

static bool take_size(struct window *w, const uint8_t *e, struct event *out)
{
    int width = x11_get16(e + 20), height = x11_get16(e + 22);
    if (width < 1 || height < 1 || width > MAX_EDGE || height > MAX_EDGE || width > MAX_PIXELS / height ||
        (width == w->screen.width && height == w->screen.height))
        return false;
    w->screen.width = width;
    w->screen.height = height;
    *out = (struct event){ .kind = EVENT_RESIZE };
    return true;
}

/* Whether the X event is one for the viewer. */
static bool translate(struct window *w, const uint8_t *e, struct event *out)
{
    if (w->segment != 0 && (e[0] & 127) == w->shm_event) {
        w->pending -= w->pending > 0;
        return false;
    }
    switch (e[0] & 127) {
    case KEY_PRESS: return take_key(w, e, out);
    case BUTTON_PRESS: return take_button(w, e, out);
    case BUTTON_RELEASE:
        if (e[1] == w->button)
            w->button = 0;
        return false;
    case MOTION: return take_motion(w, e, out);
    case CONFIGURE: return take_size(w, e, out);
    case EXPOSE:
        *out = (struct event){ .kind = EVENT_EXPOSE };
        return x11_get16(e + 16) == 0;          /* the last of a series */
    case MAPPING:
        read_keyboard(w);
        return false;
    case DESTROY:
        *out = (struct event){ .kind = EVENT_CLOSE };
        return true;
    case CLIENT_MESSAGE:
        *out = (struct event){ .kind = EVENT_CLOSE };
        return x11_get32(e + 8) == w->wm_protocols && x11_get32(e + 12) == w->wm_delete;
    default: return false;
    }
}

static bool window_event(struct screen *screen, int wait_ms, struct event *out)
{
    struct window *w = (struct window *)screen;
    uint8_t event[X11_PACKET];
    while (x11_event(&w->x, wait_ms, event)) {
        if (translate(w, event, out))
            return true;
        wait_ms = 0;
    }
    if (!w->x.is_lost || guard_is_asked())
        return false;
    fail(&screen->lost, "the X server is gone");
    *out = (struct event){ .kind = EVENT_LOST };
    return true;
}

/* ------------------------------------------------------------------ life */

static void window_close(struct screen *screen)
{
    struct window *w = (struct window *)screen;
    free_buffers(w);
    x11_disconnect(&w->x);
    free(w->keysym);
    free(w);
}

static struct screen *window_open(const struct screen_wish *wish, struct failure *f)
{
    struct window *w = calloc(1, sizeof *w);
    if (w == NULL) {
        fail(f, "out of memory");
        return NULL;
    }
    w->screen = (struct screen){ .kind = &screen_x11, .width = wish->width,
                                 .height = wish->height };
    if (!x11_connect(&w->x, f)) {
        window_close(&w->screen);
        return NULL;
    }
    read_keyboard(w);
    create_window(w, wish);
    describe_window(w, wish);
    w->has_shm = !wish->no_shared_memory && find_shm(w);
    map_window(w);
    if (!fit_buffers(w, f) || w->x.is_lost) {
        fail(f, "the X server is gone");
        window_close(&w->screen);
        return NULL;
    }
    return &w->screen;
}

const struct screen_kind screen_x11 = { "x11", window_open, window_surface, window_show,
                                        window_event, window_close };
