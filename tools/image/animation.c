/* SPDX-License-Identifier: MIT */
/* animation.c - the life of an animation file; gif.c and apng.c know the formats. */
#include "tools/image/animation.h"

#include <errno.h>

enum { MAX_DELAY_MS = 600000 };         /* what both formats can hold: 16 bits of 10 ms */

static void release(struct animation_writer *w)
{
    w->format->release(w);
    output_discard(&w->out);
    buffer_free(&w->bytes);
    free(w);
}

struct animation_writer *animation_begin(const struct animation_format *format, const char *path,
                                         int width, int height, struct failure *f)
{
    if (!image_check_size(width, height, f))
        return NULL;
    struct animation_writer *w = calloc(1, format->size);
    if (w == NULL) {
        fail(f, "out of memory (animation)");
        return NULL;
    }
    w->format = format;
    w->width = width;
    w->height = height;
    if (!output_open(&w->out, path, f) || !format->begin(w, f)) {
        release(w);
        return NULL;
    }
    return w;
}

bool animation_add(struct animation_writer *w, const struct image *frame, int delay_ms,
                   struct failure *f)
{
    if (w->broken)
        return fail(f, "an earlier frame failed");
    if (frame->width != w->width || frame->height != w->height)
        return fail(f, "frame %lu has another size (%d x %d)", (unsigned long)w->frames,
                    frame->width, frame->height);
    if (delay_ms < 0 || delay_ms > MAX_DELAY_MS)
        return fail(f, "delay is outside 0..%d ms (%d)", (int)MAX_DELAY_MS, delay_ms);
    if (!w->format->add(w, frame, delay_ms, f)) {
        w->broken = true;
        return fail(f, "out of memory (frame %lu)", (unsigned long)w->frames);
    }
    w->frames++;
    return true;
}

bool animation_end(struct animation_writer *w, struct failure *f)
{
    bool ok = !w->broken || fail(f, "an earlier frame failed");
    if (ok && w->frames == 0)
        ok = fail(f, "animation has no frames");
    ok = ok && w->format->end(w, f) && output_commit(&w->out, f);
    release(w);
    return ok;
}

void animation_cancel(struct animation_writer *w)
{
    if (w != NULL)
        release(w);
}

bool animation_flush(struct animation_writer *w, struct failure *f)
{
    if (w->bytes.failed)
        return fail(f, "out of memory (compressed frame)");
    size_t size = w->bytes.size;
    w->bytes.size = 0;
    if (size != 0 && fwrite(w->bytes.data, 1, size, w->out.stream) != size)
        return fail(f, "cannot be written (%s)", strerror(errno));
    return true;
}
