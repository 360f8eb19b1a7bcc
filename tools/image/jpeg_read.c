/* SPDX-License-Identifier: MIT */
/* jpeg_read.c - JPEG files to pictures (ITU-T T.81): baseline, extended of 8 bits and progressive, with Huffman codes; grey,
 * YCbCr and RGB in any sampling.
 *
 * Codes come out as they are in the file: profiles and orientations are ignored. A file may lack its last marker where
 * nothing else is missing, and what follows that marker is not looked at. */
#include "tools/image/jpeg.h"

#include <stdlib.h>
#include <string.h>

enum {
    DHT = 0xc4, SOI = 0xd8, EOI = 0xd9, SOS = 0xda, DQT = 0xdb, DNL = 0xdc, DRI = 0xdd, APP0 = 0xe0, APP14 = 0xee,

    /* Scans of each block: usual files have 2 to 6. Small pictures may have as many as coefficients have bits. */
    MOST_VISITS = 24, FEW_VISITS = 16384
};

/* What lies behind a marker: some tables, or a header. */
struct segment {
    const uint8_t *next, *end;
    unsigned marker;
};

static size_t left(const struct segment *s)
{
    return (size_t)(s->end - s->next);
}

static unsigned byte(struct segment *s)
{
    return *s->next++;
}

static unsigned word(struct segment *s)
{
    s->next += 2;
    return (unsigned)s->next[-2] << 8 | s->next[-1];
}

static bool is_short(const struct segment *s, struct failure *f)
{
    return fail(f, "file is damaged (segment 0x%02X is too short)", s->marker);
}

static bool next_segment(struct jpeg *j, struct segment *s, struct failure *f)
{
    const size_t bytes = (size_t)(j->end - j->next);
    const size_t size = bytes < 2 ? 2 : (size_t)j->next[0] << 8 | j->next[1];
    if (bytes < size)
        return fail(f, "file ends early (in segment 0x%02X)", s->marker);
    if (size < 2)
        return is_short(s, f);
    s->next = j->next + 2;
    s->end = j->next += size;
    return true;
}

/* ---------------------------------------------------------------------- tables */

static bool read_quanta(struct jpeg *j, struct segment *s, struct failure *f)
{
    while (left(s) > 0) {
        const unsigned head = byte(s), number = head & 15, wide = head >> 4;
        if (number >= JPEG_TABLES || wide > 1)
            return fail(f, "file is damaged (quantisation table 0x%02X)", head);
        if (left(s) < (wide + 1) * 64)
            return is_short(s, f);
        for (int i = 0; i < 64; i++)
            j->quantum[number][i] = (uint16_t)(wide == 1 ? word(s) : byte(s));
        j->has_quantum[number] = true;
    }
    return true;
}

static bool read_codes(struct jpeg *j, struct segment *s, struct failure *f)
{
    while (left(s) > 0) {
        const unsigned head = byte(s), number = head & 15, kind = head >> 4;
        size_t total = 0;
        if (number >= JPEG_TABLES || kind > 1)
            return fail(f, "file is damaged (Huffman table 0x%02X)", head);
        if (left(s) < 16)
            return is_short(s, f);
        const uint8_t *counts = s->next;
        for (int i = 0; i < 16; i++)
            total += byte(s);
        if (left(s) < total)
            return is_short(s, f);
        if (!jpeg_build_code(kind == 0 ? &j->dc[number] : &j->ac[number], counts, s->next))
            return fail(f, "file is damaged (Huffman table 0x%02X has too many codes)", head);
        s->next += total;
    }
    return true;
}

static bool read_interval(struct jpeg *j, struct segment *s, struct failure *f)
{
    if (left(s) < 2)
        return is_short(s, f);
    j->restart_interval = (long)word(s);
    return true;
}

/* The two of many segments for applications that tell what the three components are. */
static void look_at_application(struct jpeg *j, const struct segment *s)
{
    if (s->marker == APP0 && left(s) >= 5 && memcmp(s->next, "JFIF", 5) == 0)
        j->has_jfif = true;
    if (s->marker == APP14 && left(s) >= 12 && memcmp(s->next, "Adobe", 5) == 0) {
        j->has_adobe = true;
        j->transform = s->next[11];
    }
}

/* ---------------------------------------------------------------------- the frame */

static int divide_up(int a, int b)
{
    return (a + b - 1) / b;
}

static void lay_out(struct jpeg *j)
{
    j->mcu_columns = divide_up(j->width, 8 * j->h);
    j->mcu_rows = divide_up(j->height, 8 * j->v);
    for (int i = 0; i < j->component_count; i++) {
        struct jpeg_component *c = &j->component[i];
        c->width = divide_up(j->width * c->h, j->h);
        c->height = divide_up(j->height * c->v, j->v);
        c->columns = divide_up(c->width, 8);
        c->rows = divide_up(c->height, 8);
        c->stride = j->mcu_columns * c->h;
        j->blocks += (long)c->columns * c->rows;
    }
}

/* Every block takes a bit of the file at least, two where it is coded at once: no more than that is believed. */
static bool get_memory(struct jpeg *j, struct failure *f)
{
    if (j->blocks / (j->is_progressive ? 8 : 4) > (long)(j->end - j->next))
        return fail(f, "file is too small for its picture size (%d x %d)", j->width, j->height);
    for (int i = 0; i < j->component_count; i++) {
        struct jpeg_component *c = &j->component[i];
        const size_t blocks = (size_t)c->stride * (size_t)(j->mcu_rows * c->v);
        if (j->is_progressive)
            c->coefficient = calloc(blocks, 64 * sizeof *c->coefficient);
        else
            c->sample = malloc(blocks * 64);
        if (c->coefficient == NULL && c->sample == NULL)
            return fail(f, "out of memory (picture of %d x %d)", j->width, j->height);
    }
    return true;
}

static bool read_components(struct jpeg *j, struct segment *s, struct failure *f)
{
    for (int i = 0; i < j->component_count; i++) {
        struct jpeg_component *c = &j->component[i];
        c->id = (int)byte(s);
        c->h = s->next[0] >> 4;
        c->v = byte(s) & 15;
        c->table = (int)byte(s);
        memset(c->low, JPEG_UNKNOWN, sizeof c->low);
        if (c->h < 1 || c->h > 4 || c->v < 1 || c->v > 4)
            return fail(f, "file is damaged (sampling %d x %d)", c->h, c->v);
        if (c->table >= JPEG_TABLES)
            return fail(f, "file is damaged (quantisation table %d)", c->table);
        for (int k = 0; k < i; k++)
            if (j->component[k].id == c->id)
                return fail(f, "file is damaged (two components %d)", c->id);
        j->h = c->h > j->h ? c->h : j->h;
        j->v = c->v > j->v ? c->v : j->v;
    }
    return true;
}

static bool read_frame(struct jpeg *j, struct segment *s, struct failure *f)
{
    if (j->has_frame)
        return fail(f, "file is damaged (two frames)");
    if (left(s) < 6)
        return is_short(s, f);
    const unsigned depth = byte(s), height = word(s), width = word(s), count = byte(s);
    if (depth != 8)
        return fail(f, "%u bits per sample, where 8 are read", depth);
    if (height == 0)
        return fail(f, "the height comes behind the picture (DNL), which is not read");
    if (count == 4)
        return fail(f, "CMYK or YCCK colours, where grey, YCbCr and RGB are read");
    if (count != 1 && count != 3)
        return fail(f, "%u components, where 1 and 3 are read", count);
    if (!image_check_size((long)width, (long)height, f))
        return false;
    if (left(s) < count * 3)
        return is_short(s, f);
    j->has_frame = true;
    j->is_progressive = s->marker == 0xc2;
    j->width = (int)width;
    j->height = (int)height;
    j->component_count = (int)count;
    if (!read_components(j, s, f))
        return false;
    lay_out(j);
    return get_memory(j, f);
}

/* Frames are what markers 0xC0 to 0xCF begin, but for three of tables and such. */
static bool is_frame(unsigned marker)
{
    return marker >= 0xc0 && marker <= 0xcf && marker != DHT && marker != 0xc8 && marker != 0xcc;
}

static bool refuse_frame(unsigned marker, struct failure *f)
{
    return fail(f, "%s, where baseline and progressive JPEG with Huffman codes is read (0x%02X)",
                marker >= 0xc9   ? "arithmetic coding"
                : marker == 0xc3 ? "lossless coding"
                                 : "hierarchical coding",
                marker);
}

/* ---------------------------------------------------------------------- scans */

static bool name_components(struct jpeg *j, struct segment *s, struct jpeg_scan *scan, struct failure *f)
{
    for (int i = 0; i < scan->count; i++) {
        const int id = (int)byte(s);
        const unsigned codes = byte(s), dc = codes >> 4, ac = codes & 15;
        struct jpeg_component *c = NULL;
        for (int k = 0; k < j->component_count; k++)
            c = j->component[k].id == id ? &j->component[k] : c;
        for (int k = 0; k < i; k++)
            c = scan->component[k] == c ? NULL : c;
        if (c == NULL || dc >= JPEG_TABLES || ac >= JPEG_TABLES)
            return fail(f, "file is damaged (component %d of scan %d)", id, j->scan_count);
        scan->component[i] = c;
        scan->dc[i] = &j->dc[dc];
        scan->ac[i] = &j->ac[ac];
    }
    return true;
}

/* A progressive scan goes on where those before it ended, bit by bit: so there are at most 14 of each coefficient. */
static bool note_bits(const struct jpeg *j, const struct jpeg_scan *s, struct failure *f)
{
    const bool is_band = s->first > 0;
    if (s->last > 63 || s->first > s->last || (is_band ? s->count > 1 : s->last > 0))
        return fail(f, "file is damaged (scan %d has coefficients %d to %d)", j->scan_count, s->first, s->last);
    for (int i = 0; i < s->count; i++) {
        uint8_t *low = s->component[i]->low;
        for (int k = s->first; k <= s->last; k++) {
            const bool is_first = s->high == 0 && low[k] == JPEG_UNKNOWN && s->low < JPEG_UNKNOWN;
            if (!is_first && (s->high == 0 || low[k] != s->high || s->low != s->high - 1))
                return fail(f, "file is damaged (scan %d has bits %d to %d)", j->scan_count, s->low, s->high);
            low[k] = (uint8_t)s->low;
        }
    }
    return true;
}

/* A component's tables are those that are there when its first scan begins. */
static bool find_tables(struct jpeg *j, const struct jpeg_scan *s, struct failure *f)
{
    const bool needs_dc = s->first == 0 && s->high == 0, needs_ac = s->last > 0;
    for (int i = 0; i < s->count; i++) {
        struct jpeg_component *c = s->component[i];
        if (!c->has_scan && !j->has_quantum[c->table])
            return fail(f, "quantisation table %d is missing (scan %d)", c->table, j->scan_count);
        if (c->has_scan && !j->is_progressive)
            return fail(f, "file is damaged (two scans of component %d)", c->id);
        if (!c->has_scan)
            memcpy(c->quantum, j->quantum[c->table], sizeof c->quantum);
        c->has_scan = true;
        if ((needs_dc && !s->dc[i]->is_known) || (needs_ac && !s->ac[i]->is_known))
            return fail(f, "a Huffman table is missing (scan %d)", j->scan_count);
    }
    return true;
}

static bool read_scan(struct jpeg *j, struct segment *s, struct failure *f)
{
    struct jpeg_scan scan = { 0 };
    if (!j->has_frame)
        return fail(f, "file is damaged (a scan before the frame)");
    j->scan_count++;
    scan.count = left(s) > 0 ? (int)byte(s) : 0;
    if (left(s) < (size_t)scan.count * 2 + 3)
        return is_short(s, f);
    if (scan.count < 1 || scan.count > j->component_count)
        return fail(f, "file is damaged (scan %d has %d components)", j->scan_count, scan.count);
    if (!name_components(j, s, &scan, f))
        return false;
    if (j->is_progressive) {
        scan.first = (int)byte(s);
        scan.last = (int)byte(s);
        scan.high = s->next[0] >> 4;
        scan.low = byte(s) & 15;
        if (!note_bits(j, &scan, f))
            return false;
    } else {
        scan.last = 63;         /* some files say otherwise, and mean this */
    }
    for (int i = 0; i < scan.count; i++)
        j->visits += (long)scan.component[i]->columns * scan.component[i]->rows;
    if (j->visits > FEW_VISITS && j->visits / MOST_VISITS > j->blocks)
        return fail(f, "more than %d scans of a large picture", MOST_VISITS);
    return find_tables(j, &scan, f) && jpeg_read_scan(j, &scan, f);
}

/* ---------------------------------------------------------------------- the file */

static bool read_segment(struct jpeg *j, unsigned marker, struct failure *f)
{
    struct segment s = { .marker = marker };
    if (is_frame(marker) && marker > 0xc2)
        return refuse_frame(marker, f);
    if (marker == SOI)
        return fail(f, "file is damaged (it begins twice)");
    if (!next_segment(j, &s, f))
        return false;
    switch (marker) {
    case DHT: return read_codes(j, &s, f);
    case DQT: return read_quanta(j, &s, f);
    case DRI: return read_interval(j, &s, f);
    case SOS: return read_scan(j, &s, f);
    case DNL: return fail(f, "the height comes behind the picture (DNL), which is not read");
    default: break;
    }
    if (is_frame(marker))
        return read_frame(j, &s, f);
    look_at_application(j, &s);
    return true;
}

/* TEM and restart markers have nothing behind them. */
static bool stands_alone(unsigned marker)
{
    return marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7);
}

/* All up to EOI, or to the end of the file: *has_end tells. */
static bool read_segments(struct jpeg *j, bool *has_end, struct failure *f)
{
    while (jpeg_find_marker(j)) {
        const unsigned marker = j->next[1];
        j->next += 2;
        *has_end = marker == EOI;
        if (*has_end)
            return true;
        if (!stands_alone(marker) && !read_segment(j, marker, f))
            return false;
    }
    return true;
}

/* Bits of detail may be missing where the file says that this is its end, means of blocks and whole components never. */
static bool is_complete(const struct jpeg *j, bool has_end, struct failure *f)
{
    if (!j->has_frame)
        return fail(f, has_end ? "the JPEG file has no picture" : "file ends early (no frame)");
    for (int i = 0; i < j->component_count; i++) {
        const struct jpeg_component *c = &j->component[i];
        bool has_all = c->has_scan, has_mean = c->has_scan;
        for (int k = 0; j->is_progressive && k < 64; k++)
            has_all = has_all && c->low[k] == 0;
        if (j->is_progressive)
            has_mean = c->low[0] != JPEG_UNKNOWN;
        if (!has_mean && has_end)
            return fail(f, "file is damaged (component %d has no scan)", c->id);
        if (!has_all && !has_end)
            return fail(f, "file ends early (scans of component %d are missing)", c->id);
    }
    return true;
}

/* A component's coefficients go when its samples are there. */
static bool finish_component(const struct jpeg *j, struct jpeg_component *c, struct failure *f)
{
    const size_t bytes = (size_t)c->stride * 8;
    c->sample = malloc(bytes * 8 * (size_t)c->rows);
    if (c->sample == NULL)
        return fail(f, "out of memory (picture of %d x %d)", j->width, j->height);
    for (int row = 0; row < c->rows; row++)
        for (int column = 0; column < c->columns; column++)
            jpeg_make_samples(c->coefficient + ((size_t)row * (size_t)c->stride + (size_t)column) * 64, c->quantum,
                              c->sample + (size_t)row * 8 * bytes + (size_t)column * 8, bytes);
    free(c->coefficient);
    c->coefficient = NULL;
    return true;
}

bool jpeg_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    struct jpeg *j = calloc(1, sizeof *j);
    bool has_end = false;
    *out = (struct image){ 0 };
    if (j == NULL)
        return fail(f, "out of memory (JPEG tables)");
    j->next = bytes;
    j->end = bytes + size;
    bool ok = (size >= 2 && bytes[0] == 0xff && bytes[1] == SOI) || fail(f, "not a JPEG file (first bytes)");
    if (ok) {
        j->next += 2;
        ok = read_segments(j, &has_end, f) && is_complete(j, has_end, f);
    }
    for (int i = 0; ok && j->is_progressive && i < j->component_count; i++)
        ok = finish_component(j, &j->component[i], f);
    ok = ok && jpeg_make_pixels(j, out, f);
    for (int i = 0; i < JPEG_COMPONENTS; i++) {
        free(j->component[i].sample);
        free(j->component[i].coefficient);
    }
    free(j);
    return ok;
}
