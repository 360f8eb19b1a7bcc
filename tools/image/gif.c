/* SPDX-License-Identifier: MIT */
/* gif.c - animations as GIF89a.
 *
 * Frames are drawn over what is shown, with a palette each. A frame holds the rectangle that has
 * changed, and inside it the pixels that have not are transparent: they cost little, take no part
 * in choosing the palette, and keep their dither, so still parts do not flicker. Translucent
 * pictures are seen on black. */
#include "tools/image/animation.h"
#include "tools/image/palette.h"

enum {
    MAX_CODES = 4096,           /* of LZW; 12 bits */
    CODE_SLOTS = 16384,         /* hash table of the codes */
    MIN_DELAY_CS = 2            /* viewers take shorter delays for 100 ms */
};

struct gif_writer {
    struct animation_writer common;
    struct image source;        /* the last frame, on black */
    struct image now;           /* the one being added */
    struct image shown;         /* what a viewer shows after the last frame */
    uint8_t *mark;              /* pixels to be drawn */
    uint8_t *index;             /* their entries in the palette */
    int delay_debt_ms;          /* asked for and not yet spent in steps of 10 ms */
};

static struct gif_writer *gif(struct animation_writer *w)
{
    return (struct gif_writer *)w;
}

static bool begin(struct animation_writer *w, struct failure *f)
{
    struct gif_writer *g = gif(w);
    size_t pixels = (size_t)w->width * (size_t)w->height;
    if (!image_alloc(&g->source, w->width, w->height, f) ||
        !image_alloc(&g->now, w->width, w->height, f) ||
        !image_alloc(&g->shown, w->width, w->height, f))
        return false;
    g->mark = malloc(pixels);
    g->index = malloc(pixels);
    if (g->mark == NULL || g->index == NULL)
        return fail(f, "out of memory (animation)");
    buffer_append(&w->bytes, "GIF89a", 6);
    buffer_le16(&w->bytes, (unsigned)w->width);
    buffer_le16(&w->bytes, (unsigned)w->height);
    buffer_byte(&w->bytes, 0x70);       /* no palette for all frames; 8 bits per channel */
    buffer_byte(&w->bytes, 0);          /* background */
    buffer_byte(&w->bytes, 0);          /* pixels are square */
    buffer_append(&w->bytes, "\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 19);     /* repeat for ever */
    return animation_flush(w, f);
}

static void release(struct animation_writer *w)
{
    struct gif_writer *g = gif(w);
    image_free(&g->source);
    image_free(&g->now);
    image_free(&g->shown);
    free(g->mark);
    free(g->index);
}

/* --- LZW --- */

struct lzw {
    struct buffer *out;
    uint32_t hold;              /* bits not yet written; the first is the lowest */
    unsigned hold_count, code_bits;
    uint8_t block[255];         /* data leaves in blocks, each after its length */
    unsigned block_size;
    unsigned next_code;
    uint32_t key[CODE_SLOTS];   /* (code of a string, the byte after it) + 1; 0: free */
    uint16_t code[CODE_SLOTS];  /* of the string with that byte */
};

static void end_block(struct lzw *z)
{
    if (z->block_size != 0) {
        buffer_byte(z->out, z->block_size);
        buffer_append(z->out, z->block, z->block_size);
        z->block_size = 0;
    }
}

static void put_byte(struct lzw *z, unsigned byte)
{
    z->block[z->block_size++] = (uint8_t)byte;
    if (z->block_size == sizeof z->block)
        end_block(z);
}

static void put_code(struct lzw *z, unsigned code)
{
    z->hold |= (uint32_t)code << z->hold_count;
    z->hold_count += z->code_bits;
    while (z->hold_count >= 8) {
        put_byte(z, z->hold & 255);
        z->hold >>= 8;
        z->hold_count -= 8;
    }
}

static void forget_codes(struct lzw *z, unsigned symbol_bits)
{
    memset(z->key, 0, sizeof z->key);
    z->next_code = (1u << symbol_bits) + 2;
    z->code_bits = symbol_bits + 1;
}

/* The pixels of an area of `index` as GIF's image data. False without memory. */
static bool put_pixels(struct buffer *out, const uint8_t *index, int width, struct png_area area,
                       unsigned symbol_bits)
{
    struct lzw *z = calloc(1, sizeof *z);
    if (z == NULL)
        return false;
    unsigned clear = 1u << symbol_bits;
    unsigned string = MAX_CODES;        /* code of the longest known string; MAX_CODES: none yet */
    z->out = out;
    buffer_byte(out, symbol_bits);
    forget_codes(z, symbol_bits);
    put_code(z, clear);
    for (int y = 0; y < area.height; y++) {
        const uint8_t *row = index + (size_t)(area.y + y) * (size_t)width + (size_t)area.x;
        for (int x = 0; x < area.width; x++) {
            unsigned byte = row[x];
            if (string == MAX_CODES) {
                string = byte;
                continue;
            }
            uint32_t key = ((uint32_t)string << 8 | byte) + 1;
            uint32_t at = key * 2654435761u >> 18;
            while (z->key[at] != 0 && z->key[at] != key)
                at = (at + 1) % CODE_SLOTS;
            if (z->key[at] == key) {
                string = z->code[at];
                continue;
            }
            put_code(z, string);
            string = byte;
            if (z->next_code == MAX_CODES) {
                put_code(z, clear);
                forget_codes(z, symbol_bits);
                continue;
            }
            /* The reader learns a code one step later than the writer, so the width grows only when
             * the code just made does not fit. */
            if (z->next_code == 1u << z->code_bits)
                z->code_bits++;
            z->key[at] = key;
            z->code[at] = (uint16_t)z->next_code++;
        }
    }
    put_code(z, string);
    /* The reader now makes one more code, which may widen the next. */
    if (z->next_code == 1u << z->code_bits && z->code_bits < 12)
        z->code_bits++;
    put_code(z, clear + 1);             /* end of information */
    if (z->hold_count > 0)
        put_byte(z, z->hold & 255);
    end_block(z);
    buffer_byte(out, 0);
    free(z);
    return true;
}

/* --- frames --- */

/* What is to be drawn: how many pixels, and the rectangle around them. */
struct change {
    size_t pixels;
    struct png_area area;
};

/* Marks the pixels in which the pictures differ. */
static struct change mark_changes(const struct image *a, const struct image *b, uint8_t *mark)
{
    int left = a->width, right = -1, top = a->height, bottom = -1;
    size_t i = 0, pixels = 0;
    for (int y = 0; y < a->height; y++) {
        for (int x = 0; x < a->width; x++, i++) {
            mark[i] = memcmp(a->rgba + i * 4, b->rgba + i * 4, 4) != 0;
            if (mark[i] == 0)
                continue;
            pixels++;
            left = x < left ? x : left;
            right = x > right ? x : right;
            top = y < top ? y : top;
            bottom = y;
        }
    }
    if (pixels == 0)
        return (struct change){0, {0, 0, 1, 1}};        /* a frame needs a pixel: transparent */
    return (struct change){pixels, {left, top, right - left + 1, bottom - top + 1}};
}

/* How many entries of a palette are left for colours: one is for transparency, if there is any. */
static int colors_left(struct change c)
{
    return c.pixels == (size_t)c.area.width * (size_t)c.area.height ? 256 : 255;
}

static void copy_on_black(struct image *to, const struct image *from)
{
    size_t bytes = (size_t)from->width * (size_t)from->height * 4;
    for (size_t i = 0; i < bytes; i += 4) {
        unsigned alpha = from->rgba[i + 3];
        for (size_t k = 0; k < 3; k++)
            to->rgba[i + k] = (uint8_t)((from->rgba[i + k] * alpha + 127) / 255);
    }
}

static unsigned delay_in_cs(struct gif_writer *g, int delay_ms)
{
    int wanted = delay_ms + g->delay_debt_ms;
    int delay = (wanted + 5) / 10;
    delay = wanted < 0 || delay < MIN_DELAY_CS ? MIN_DELAY_CS : delay > 65535 ? 65535 : delay;
    /* Only rounding is carried over; what the shortest delay adds is never taken back. */
    int debt = wanted - delay * 10;
    g->delay_debt_ms = debt < -5 ? 0 : debt > 5 ? 5 : debt;
    return (unsigned)delay;
}

/* Marks, palette and indices for g->now. */
static bool choose_pixels(struct gif_writer *g, struct change *change, struct palette *palette)
{
    struct marked_image marked = {&g->now, g->mark};
    size_t pixels = (size_t)g->now.width * (size_t)g->now.height;
    bool exact;
    if (g->common.frames == 0) {
        memset(g->mark, 1, pixels);
        *change = (struct change){pixels, {0, 0, g->now.width, g->now.height}};
        exact = palette_exact(&marked, 256, palette);
    } else {
        *change = mark_changes(&g->shown, &g->now, g->mark);
        exact = palette_exact(&marked, colors_left(*change), palette);
        if (!exact) {
            /* What is shown cannot be made right everywhere; then let be what has not changed. */
            *change = mark_changes(&g->source, &g->now, g->mark);
            exact = palette_exact(&marked, colors_left(*change), palette);
        }
    }
    if (!exact && !palette_choose(&marked, colors_left(*change), palette))
        return false;
    return palette_map(&marked, palette, g->index);
}

static bool add(struct animation_writer *w, const struct image *frame, int delay_ms,
                struct failure *f)
{
    struct gif_writer *g = gif(w);
    struct change change;
    struct palette palette;
    copy_on_black(&g->now, frame);
    if (!choose_pixels(g, &change, &palette))
        return fail(f, "out of memory (palette)");

    bool has_transparent = change.pixels < (size_t)change.area.width * (size_t)change.area.height;
    unsigned entries = (unsigned)palette.count + has_transparent, transparent = entries - 1;
    unsigned bits = 1;
    while (1u << bits < entries)
        bits++;
    size_t pixels = (size_t)w->width * (size_t)w->height;
    for (size_t i = 0; i < pixels; i++) {
        if (g->mark[i])
            memcpy(g->shown.rgba + i * 4, palette.rgb[g->index[i]], 3);
        else
            g->index[i] = (uint8_t)transparent;
    }
    struct image last = g->source;
    g->source = g->now;
    g->now = last;

    struct buffer *out = &w->bytes;
    unsigned delay = delay_in_cs(g, delay_ms);
    buffer_append(out, "\x21\xf9\x04", 3);              /* graphic control */
    buffer_byte(out, 1u << 2 | has_transparent);        /* the frame stays */
    buffer_le16(out, delay);
    buffer_byte(out, has_transparent ? transparent : 0);
    buffer_byte(out, 0);
    buffer_byte(out, 0x2c);                             /* image */
    buffer_le16(out, (unsigned)change.area.x);
    buffer_le16(out, (unsigned)change.area.y);
    buffer_le16(out, (unsigned)change.area.width);
    buffer_le16(out, (unsigned)change.area.height);
    buffer_byte(out, 0x80 | (bits - 1));                /* a palette of 2^bits follows */
    for (unsigned i = 0; i < 1u << bits; i++)
        buffer_append(out, i < 256 ? palette.rgb[i] : palette.rgb[0], 3);
    if (!put_pixels(out, g->index, w->width, change.area, bits < 2 ? 2 : bits))
        return fail(f, "out of memory (compressed frame)");
    return animation_flush(w, f);
}

static bool end(struct animation_writer *w, struct failure *f)
{
    buffer_byte(&w->bytes, 0x3b);
    return animation_flush(w, f);
}

struct animation_writer *gif_begin(const char *path, int width, int height, struct failure *f)
{
    static const struct animation_format format = {
        sizeof(struct gif_writer), begin, add, end, release,
    };
    return animation_begin(&format, path, width, height, f);
}
