/* SPDX-License-Identifier: MIT */
/* apng.c - animations as PNG with the chunks acTL, fcTL and fdAT (PNG, third edition).
 *
 * Every frame replaces the rectangle that differs from what is shown, alpha included. The first
 * frame decides whether the file has alpha: the header stands before the others, and an alpha that
 * is never used would cost 10 to 15 % of the file. */
#include "tools/image/animation.h"

#include <errno.h>

struct apng_writer {
    struct animation_writer common;
    struct image shown;         /* the last frame */
    bool has_alpha;             /* of the file */
    uint32_t sequence;          /* number of the next fcTL or fdAT chunk */
};

static struct apng_writer *apng(struct animation_writer *w)
{
    return (struct apng_writer *)w;
}

static bool begin(struct animation_writer *w, struct failure *f)
{
    return image_alloc(&apng(w)->shown, w->width, w->height, f);
}

/* Everything before the first frame. */
static void put_head(struct animation_writer *w)
{
    uint8_t control[8] = {0};           /* frame count, filled in at the end; 0 plays: for ever */
    buffer_append(&w->bytes, png_signature, sizeof png_signature);
    png_header_chunk(&w->bytes, w->width, w->height, apng(w)->has_alpha);
    png_chunk(&w->bytes, "acTL", control, sizeof control);
}

/* The smallest rectangle with all pixels in which the pictures of one size differ; width 0 if none
 * do. */
static struct png_area changed_area(const struct image *a, const struct image *b)
{
    size_t stride = (size_t)a->width * 4;
    int top = 0, bottom = a->height, left = a->width, right = 0;
    while (top < bottom && memcmp(a->rgba + (size_t)top * stride, b->rgba + (size_t)top * stride,
                                  stride) == 0)
        top++;
    if (top == bottom)
        return (struct png_area){0};
    while (memcmp(a->rgba + (size_t)(bottom - 1) * stride, b->rgba + (size_t)(bottom - 1) * stride,
                  stride) == 0)
        bottom--;
    for (int y = top; y < bottom; y++) {
        const uint8_t *p = a->rgba + (size_t)y * stride, *q = b->rgba + (size_t)y * stride;
        int x = 0;
        while (x < left && memcmp(p + x * 4, q + x * 4, 4) == 0)
            x++;
        left = x;
        x = a->width;
        while (x > right && memcmp(p + (x - 1) * 4, q + (x - 1) * 4, 4) == 0)
            x--;
        right = x;
    }
    return (struct png_area){left, top, right - left, bottom - top};
}

static void frame_chunk(struct animation_writer *w, struct png_area area, int delay_ms)
{
    struct buffer data = {0};
    bool fits = delay_ms <= 65535;
    buffer_be32(&data, apng(w)->sequence++);
    buffer_be32(&data, (uint32_t)area.width);
    buffer_be32(&data, (uint32_t)area.height);
    buffer_be32(&data, (uint32_t)area.x);
    buffer_be32(&data, (uint32_t)area.y);
    unsigned delay = (unsigned)(fits ? delay_ms : (delay_ms + 5) / 10), unit = fits ? 1000 : 100;
    buffer_be32(&data, delay << 16 | unit);     /* two 16-bit numbers, a fraction of a second */
    buffer_byte(&data, 0);                      /* afterwards the frame stays */
    buffer_byte(&data, 0);                      /* it replaces what was there */
    if (data.failed)
        w->bytes.failed = true;
    else
        png_chunk(&w->bytes, "fcTL", data.data, data.size);
    buffer_free(&data);
}

static bool add(struct animation_writer *w, const struct image *frame, int delay_ms,
                struct failure *f)
{
    struct png_area area = {0, 0, w->width, w->height};
    struct buffer data = {0};
    bool has_alpha = !png_is_opaque(frame);
    if (w->frames == 0) {
        apng(w)->has_alpha = has_alpha;
        put_head(w);
    } else {
        if (has_alpha && !apng(w)->has_alpha)
            return fail(f, "frame %lu is translucent, unlike the first", (unsigned long)w->frames);
        area = changed_area(&apng(w)->shown, frame);
    }
    if (area.width == 0)
        area = (struct png_area){0, 0, 1, 1};   /* nothing changed; a frame needs a pixel */
    frame_chunk(w, area, delay_ms);
    if (w->frames != 0)
        buffer_be32(&data, apng(w)->sequence++);
    bool ok = png_compress(&data, frame, area, apng(w)->has_alpha);
    if (ok)
        png_chunk(&w->bytes, w->frames == 0 ? "IDAT" : "fdAT", data.data, data.size);
    buffer_free(&data);
    if (!ok)
        return fail(f, "out of memory (compressed frame)");
    memcpy(apng(w)->shown.rgba, frame->rgba, (size_t)w->width * (size_t)w->height * 4);
    return animation_flush(w, f);
}

static bool end(struct animation_writer *w, struct failure *f)
{
    enum { ACTL_AT = 8 + 25 };          /* after the signature and IHDR */
    png_chunk(&w->bytes, "IEND", NULL, 0);
    if (!animation_flush(w, f))
        return false;
    uint8_t control[8] = {(uint8_t)(w->frames >> 24), (uint8_t)(w->frames >> 16),
                           (uint8_t)(w->frames >> 8), (uint8_t)w->frames, 0, 0, 0, 0};
    png_chunk(&w->bytes, "acTL", control, sizeof control);
    if (fseek(w->out.stream, ACTL_AT, SEEK_SET) != 0)
        return fail(f, "cannot be written (%s)", strerror(errno));
    return animation_flush(w, f);
}

static void release(struct animation_writer *w)
{
    image_free(&apng(w)->shown);
}

struct animation_writer *apng_begin(const char *path, int width, int height, struct failure *f)
{
    static const struct animation_format format = {
        sizeof(struct apng_writer), begin, add, end, release,
    };
    return animation_begin(&format, path, width, height, f);
}
