/* SPDX-License-Identifier: MIT */
/* screen_fb.c - a Linux framebuffer device: $FRAMEBUFFER, or /dev/fb0. Where the device has room
 * for two pictures they are shown in turn. */
#include "tools/view/screen.h"

#ifdef __linux__

#include "tools/view/console.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/fb.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

struct framebuffer {
    struct screen screen;
    int file;
    struct fb_var_screeninfo var;
    struct layout layout;
    size_t stride, size;        /* bytes: of a row, of the mapping */
    uint8_t *memory;            /* the device's */
    uint8_t *kept;              /* what was on it before */
    uint32_t *pixel;            /* what is drawn */
    bool has_two, waits;        /* two pictures; the device tells the end of a refresh */
    unsigned page;              /* shown now */
    unsigned row_before;        /* shown first, before we came */
};

static size_t picture_bytes(const struct framebuffer *b)
{
    return b->stride * b->var.yres;
}

/* The layout, when pixels are packed words of true colour. */
static bool read_layout(struct framebuffer *b, const struct fb_fix_screeninfo *fix)
{
    const struct fb_bitfield *field[3] = { &b->var.red, &b->var.green, &b->var.blue };
    const uint16_t probe = 1;
    uint8_t is_little;
    uint32_t mask[3];
    memcpy(&is_little, &probe, 1);
    for (int i = 0; i < 3; i++) {
        if (field[i]->msb_right != 0 || field[i]->length == 0 || field[i]->length > 16 ||
            field[i]->offset > 31)
            return false;
        mask[i] = ((1u << field[i]->length) - 1u) << field[i]->offset;
    }
    return fix->type == FB_TYPE_PACKED_PIXELS &&
           (fix->visual == FB_VISUAL_TRUECOLOR || fix->visual == FB_VISUAL_DIRECTCOLOR) &&
           layout_from_masks(&b->layout, (int)b->var.bits_per_pixel, mask, !is_little);
}

static bool show_page(struct framebuffer *b, unsigned row)
{
    struct fb_var_screeninfo var = b->var;
    var.xoffset = 0;
    var.yoffset = row;
    return ioctl(b->file, FBIOPAN_DISPLAY, &var) == 0;
}

/* What is shown while a program is ended by a signal. */
static struct framebuffer *volatile shown;

static void show_before(void)
{
    struct framebuffer *b = shown;
    shown = NULL;
    if (b != NULL && b->has_two)
        show_page(b, b->row_before);
}

static bool map(struct framebuffer *b, const struct fb_fix_screeninfo *fix, struct failure *f)
{
    size_t first = (size_t)b->var.yoffset * fix->line_length;
    b->stride = fix->line_length;
    b->size = fix->smem_len;
    if (b->var.xres < 1 || b->var.yres < 1 || picture_bytes(b) > b->size ||
        b->stride < b->var.xres * (size_t)b->layout.bytes)
        return fail(f, "the framebuffer is smaller than its screen");
    void *memory = mmap(NULL, b->size, PROT_READ | PROT_WRITE, MAP_SHARED, b->file, 0);
    if (memory == MAP_FAILED)
        return fail(f, "the framebuffer cannot be mapped (%s)", strerror(errno));
    b->memory = memory;
    b->row_before = b->var.yoffset;
    b->kept = malloc(picture_bytes(b));
    b->pixel = calloc((size_t)b->var.xres * b->var.yres, sizeof *b->pixel);
    if (b->kept == NULL || b->pixel == NULL)
        return fail(f, "out of memory");
    if (first + picture_bytes(b) > b->size)
        first = 0;
    memcpy(b->kept, b->memory + first, picture_bytes(b));
    b->has_two = fix->ypanstep > 0 && b->var.yres_virtual >= 2 * b->var.yres &&
                 2 * picture_bytes(b) <= b->size && show_page(b, 0);
    b->waits = true;
    return true;
}

static bool fb_surface(struct screen *screen, struct surface *out, struct failure *f)
{
    struct framebuffer *b = (struct framebuffer *)screen;
    (void)f;
    *out = (struct surface){ screen->width, screen->height, (size_t)screen->width, b->pixel };
    return true;
}

static bool fb_show(struct screen *screen, const struct text *text, struct failure *f)
{
    struct framebuffer *b = (struct framebuffer *)screen;
    unsigned page = b->has_two ? !b->page : 0;
    uint32_t display = 0;
    uint8_t *to = b->memory + page * picture_bytes(b);
    (void)text;
    (void)f;
    if (!b->has_two && b->waits)
        b->waits = ioctl(b->file, FBIO_WAITFORVSYNC, &display) == 0;
    for (int y = 0; y < screen->height; y++, to += b->stride)
        layout_pack(&b->layout, to, b->pixel + (size_t)y * (size_t)screen->width, screen->width);
    if (b->has_two && show_page(b, page * b->var.yres))
        b->page = page;
    return true;
}

static void fb_close(struct screen *screen)
{
    struct framebuffer *b = (struct framebuffer *)screen;
    if (b->memory != NULL && b->kept != NULL) {
        size_t first = b->row_before * b->stride;
        if (first + picture_bytes(b) > b->size)
            first = 0;
        memcpy(b->memory + first, b->kept, picture_bytes(b));
    }
    console_close();
    shown = NULL;
    if (b->memory != NULL)
        munmap(b->memory, b->size);
    if (b->file >= 0)
        close(b->file);
    free(b->kept);
    free(b->pixel);
    free(b);
}

static bool open_device(struct framebuffer *b, struct failure *f)
{
    const char *path = getenv("FRAMEBUFFER");
    struct fb_fix_screeninfo fix;
    if (path == NULL || path[0] == '\0')
        path = "/dev/fb0";
    b->file = open(path, O_RDWR | O_CLOEXEC);
    if (b->file < 0)
        return fail(f, "%s: %s", path, strerror(errno));
    if (ioctl(b->file, FBIOGET_VSCREENINFO, &b->var) != 0 ||
        ioctl(b->file, FBIOGET_FSCREENINFO, &fix) != 0)
        return fail(f, "%s is no framebuffer", path);
    if (!read_layout(b, &fix))
        return fail(f, "%s: %u bits per pixel are not 16, 24 or 32 bits of true colour", path,
                    b->var.bits_per_pixel);
    if (!map(b, &fix, f))
        return false;
    snprintf(b->screen.what, sizeof b->screen.what, "%.40s, %ux%u, %u bits%s", path, b->var.xres,
             b->var.yres, b->var.bits_per_pixel, b->has_two ? ", two pages" : "");
    return true;
}

static struct screen *fb_open(const struct screen_wish *wish, struct failure *f)
{
    struct framebuffer *b = calloc(1, sizeof *b);
    (void)wish;
    if (b == NULL) {
        fail(f, "out of memory");
        return NULL;
    }
    b->file = -1;
    if (!open_device(b, f)) {
        fb_close(&b->screen);
        return NULL;
    }
    b->screen.kind = &screen_fb;
    b->screen.width = (int)b->var.xres;
    b->screen.height = (int)b->var.yres;
    shown = b;
    console_open(show_before);
    return &b->screen;
}

const struct screen_kind screen_fb = { "fb", fb_open, fb_surface, fb_show, console_event,
                                       fb_close };

#else

static struct screen *no_fb(const struct screen_wish *wish, struct failure *f)
{
    (void)wish;
    fail(f, "there is none but on Linux");
    return NULL;
}

const struct screen_kind screen_fb = { .name = "fb", .open = no_fb };

#endif
