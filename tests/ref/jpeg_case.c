/* SPDX-License-Identifier: MIT */
/* jpeg_case.c - see jpeg_case.h. It shares no code with what it tests. */
#include "tests/ref/jpeg_case.h"

#include "tests/host.h"

/* ---------------------------------------------------------------------- a picture */

static int divided_up(int a, int b)
{
    return (a + b - 1) / b;
}

/* Blocks that hold what the picture has of a component. */
static int real_columns(const struct jpeg_case *c, int i)
{
    return divided_up(divided_up(c->width * c->h[i], c->h_most), 8);
}

static int real_rows(const struct jpeg_case *c, int i)
{
    return divided_up(divided_up(c->height * c->v[i], c->v_most), 8);
}

static void choose_sampling(struct jpeg_case *c)
{
    static const uint8_t usual[8][2] = { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 2, 2 }, { 4, 1 }, { 1, 4 }, { 4, 2 }, { 2, 4 } };
    const uint8_t *luma = usual[between(0, 7)];
    const bool is_odd = chance(3);
    c->h_most = c->v_most = 1;
    for (int i = 0; i < c->count; i++) {
        c->h[i] = is_odd ? between(1, 4) : i == 0 ? luma[0] : 1;
        c->v[i] = is_odd ? between(1, 4) : i == 0 ? luma[1] : 1;
        c->h_most = c->h[i] > c->h_most ? c->h[i] : c->h_most;
        c->v_most = c->v[i] > c->v_most ? c->v[i] : c->v_most;
    }
}

static void choose_block(int16_t *block, const uint16_t *quantum, int mean, int strength)
{
    const int details = chance(4) ? 63 : between(0, 12);
    block[0] = (int16_t)(mean / quantum[0]);
    for (int n = 0; n < details; n++) {
        const int k = details == 63 ? n + 1 : between(1, chance(3) ? 63 : 12), most = strength / (1 + k / 4) / quantum[k];
        block[k] = (int16_t)between(-most, most);
    }
}

void jpeg_case_make(struct jpeg_case *c, int largest)
{
    static const int strengths[4] = { 20, 60, 200, 500 };
    *c = (struct jpeg_case){ .width = between(1, largest), .height = between(1, largest), .count = chance(4) ? 1 : 3 };
    const int coarse = chance(5) ? 400 : between(1, 60), strength = strengths[between(0, 3)];
    c->is_progressive = chance(2);
    c->colors = between(0, 5);
    c->is_rgb = c->count == 3 && (c->colors == 2 || c->colors == 3);
    choose_sampling(c);
    for (int t = 0; t < 4; t++)
        for (int k = 0; k < 64; k++)
            c->quantum[t][k] = (uint16_t)between(1, coarse);
    for (int i = 0; i < c->count; i++) {
        c->table[i] = between(0, 3);
        c->columns[i] = divided_up(c->width, 8 * c->h_most) * c->h[i];
        c->rows[i] = divided_up(c->height, 8 * c->v_most) * c->v[i];
        const size_t blocks = (size_t)(c->columns[i] * c->rows[i]);
        c->coefficient[i] = calloc(blocks * 64, sizeof(int16_t));
        int mean = between(-700, 700);
        for (size_t b = 0; b < blocks; b++) {
            mean = chance(8) ? between(-1000, 1000) : mean + between(-60, 60);
            mean = mean < -1000 ? -1000 : mean > 1000 ? 1000 : mean;
            choose_block(c->coefficient[i] + b * 64, c->quantum[c->table[i]], mean, strength);
        }
    }
}

void jpeg_case_free(struct jpeg_case *c)
{
    for (int i = 0; i < CASE_COMPONENTS; i++)
        free(c->coefficient[i]);
    *c = (struct jpeg_case){ 0 };
}

/* ---------------------------------------------------------------------- what it shows */

/* Coefficient number k belongs to a frequency (u, v): diagonals, each walked the other way than the one before. */
static void frequency_of(int k, int *u, int *v)
{
    int diagonal = 0, first = 0;
    for (;; diagonal++) {
        const int count = diagonal < 8 ? diagonal + 1 : 15 - diagonal;
        if (k < first + count)
            break;
        first += count;
    }
    const int low = diagonal < 8 ? 0 : diagonal - 7, step = k - first;
    const int rising = low + step, falling = diagonal - low - step;
    *u = diagonal % 2 == 0 ? rising : falling;
    *v = diagonal - *u;
}

static double basis(int x, int u)
{
    static double table[8][8];
    if (table[0][0] == 0)
        for (int i = 0; i < 64; i++)
            table[i / 8][i % 8] = (i % 8 == 0 ? sqrt(0.125) : 0.5) * cos((2 * (i / 8) + 1) * (i % 8) * 3.14159265358979323846 / 16);
    return table[x][u];
}

static void show_block(const int16_t *block, const uint16_t *quantum, double *to, int stride)
{
    double in[8][8] = { { 0 } }, half[8][8];
    for (int k = 0, u, v; k < 64; k++) {
        frequency_of(k, &u, &v);
        in[v][u] = block[k] * quantum[k];
    }
    for (int v = 0; v < 8; v++)
        for (int x = 0; x < 8; x++) {
            half[v][x] = 0;
            for (int u = 0; u < 8; u++)
                half[v][x] += in[v][u] * basis(x, u);
        }
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 8; x++) {
            double sample = 128;
            for (int v = 0; v < 8; v++)
                sample += half[v][x] * basis(y, v);
            to[y * stride + x] = fmin(fmax(sample, 0), 255);
        }
}

struct plane {
    int width, height, stride;
    double *sample;
};

static double plane_at(const struct plane *p, int x, int y)
{
    x = x < 0 ? 0 : x < p->width ? x : p->width - 1;
    y = y < 0 ? 0 : y < p->height ? y : p->height - 1;
    return p->sample[y * p->stride + x];
}

/* Half as many samples are interpolated along their rows and columns: along columns alone where rows are whole, along rows
 * not where columns are neither whole nor half, or fewer than three. */
static double plane_show(const struct jpeg_case *c, int i, const struct plane *p, int x, int y)
{
    const bool half_x = c->h[i] * 2 == c->h_most && p->width > 2, half_y = c->v[i] * 2 == c->v_most;
    const bool whole_x = c->h[i] == c->h_most, whole_y = c->v[i] == c->v_most;
    const bool soft_x = half_x && (whole_y || half_y), soft_y = half_y && (whole_x || half_x);
    const int at_x = (int)((x + 0.5) * c->h[i] / c->h_most), at_y = (int)((y + 0.5) * c->v[i] / c->v_most);
    const int far_x = soft_x ? at_x + (x % 2 == 0 ? -1 : 1) : at_x, far_y = soft_y ? at_y + (y % 2 == 0 ? -1 : 1) : at_y;
    return 0.75 * (0.75 * plane_at(p, at_x, at_y) + 0.25 * plane_at(p, far_x, at_y)) +
           0.25 * (0.75 * plane_at(p, at_x, far_y) + 0.25 * plane_at(p, far_x, far_y));
}

static void show_pixel(const struct jpeg_case *c, const double value[3], double *rgb)
{
    const double cb = value[1] - 128, cr = value[2] - 128;
    const bool is_plain = c->count == 1 || c->is_rgb;
    const double shown[3] = { value[0] + 1.402 * cr, value[0] - 0.344136286 * cb - 0.714136286 * cr, value[0] + 1.772 * cb };
    for (int k = 0; k < 3; k++)
        rgb[k] = fmin(fmax(is_plain ? value[k] : shown[k], 0), 255);
}

void jpeg_case_show(const struct jpeg_case *c, double *rgb)
{
    struct plane plane[CASE_COMPONENTS] = { { 0 } };
    for (int i = 0; i < c->count; i++) {
        struct plane *p = &plane[i];
        p->width = divided_up(c->width * c->h[i], c->h_most);
        p->height = divided_up(c->height * c->v[i], c->v_most);
        p->stride = c->columns[i] * 8;
        p->sample = malloc((size_t)(p->stride * c->rows[i] * 8) * sizeof *p->sample);
        for (int b = 0; b < c->columns[i] * c->rows[i]; b++)
            show_block(c->coefficient[i] + b * 64, c->quantum[c->table[i]],
                       p->sample + b / c->columns[i] * 8 * p->stride + b % c->columns[i] * 8, p->stride);
    }
    for (int at = 0; at < c->width * c->height; at++) {
        double value[3];
        for (int i = 0; i < 3; i++)
            value[i] = i < c->count ? plane_show(c, i, &plane[i], at % c->width, at / c->width) : value[0];
        show_pixel(c, value, rgb + at * 3);
    }
    for (int i = 0; i < c->count; i++)
        free(plane[i].sample);
}

/* ---------------------------------------------------------------------- codes */

struct code {
    uint8_t counts[16], symbol[256];
    uint16_t code[256];
    int length[256];
};

/* Any code of all numbers below `symbols`. */
static void choose_code(struct code *c, int symbols)
{
    int left = symbols, free_codes = 1, next = 0, index = 0;
    memset(c, 0, sizeof *c);
    for (int i = 0; i < symbols; i++)
        c->symbol[i] = (uint8_t)i;
    for (int i = symbols - 1; i > 0; i--) {
        const int k = between(0, i);
        const uint8_t swapped = c->symbol[i];
        c->symbol[i] = c->symbol[k];
        c->symbol[k] = swapped;
    }
    for (int length = 1; length <= 16; length++, next *= 2) {
        int count = 0;
        free_codes *= 2;
        if (length == 16)
            count = left;
        else
            while (count < left && ((free_codes - count - 1) << (16 - length)) >= left - count - 1 && !chance(6))
                count++;
        c->counts[length - 1] = (uint8_t)count;
        left -= count;
        free_codes -= count;
        for (; count > 0; count--, index++) {
            c->code[c->symbol[index]] = (uint16_t)next++;
            c->length[c->symbol[index]] = length;
        }
    }
}

struct writer {
    struct buffer *out;
    uint32_t hold;
    int bits;
    struct code dc, ac;
    int interval;               /* MCUs between restart markers, as the file says now */
    int mean[CASE_COMPONENTS];
    int run;                    /* blocks that are to be told to end, and the bits that follow */
    uint8_t later[1024];
    int later_count;
    bool has_begun[CASE_COMPONENTS];
    size_t end;                 /* of the last coded bits */
};

static void put_bits(struct writer *w, unsigned value, int count)
{
    for (int i = count - 1; i >= 0; i--) {
        w->hold = w->hold << 1 | (value >> i & 1);
        if (++w->bits == 8) {
            buffer_byte(w->out, w->hold & 255);
            if ((w->hold & 255) == 255)
                buffer_byte(w->out, 0);
            w->bits = 0;
        }
    }
}

static void put_symbol(struct writer *w, const struct code *c, int symbol)
{
    put_bits(w, c->code[symbol], c->length[symbol]);
}

static int size_of(int value)
{
    int size = 0;
    for (unsigned left = (unsigned)abs(value); left != 0; left >>= 1)
        size++;
    return size;
}

static void put_number(struct writer *w, int value, int size)
{
    put_bits(w, (unsigned)(value < 0 ? value + (1 << size) - 1 : value), size);
}

static void put_run(struct writer *w)
{
    if (w->run > 0) {
        const int size = size_of(w->run) - 1;
        put_symbol(w, &w->ac, size << 4);
        put_bits(w, (unsigned)w->run & ((1u << size) - 1), size);
    }
    for (int i = 0; i < w->later_count; i++)
        put_bits(w, w->later[i], 1);
    w->run = w->later_count = 0;
}

/* ---------------------------------------------------------------------- blocks */

struct script {
    int count, component[CASE_COMPONENTS], first, last, high, low;
};

static void put_mean(struct writer *w, int i, int value)
{
    const int difference = value - w->mean[i], size = size_of(difference);
    w->mean[i] = value;
    put_symbol(w, &w->dc, size);
    put_number(w, difference, size);
}

/* Bits are taken off the magnitude. */
static int cut_off(int value, int low)
{
    return value < 0 ? -(-value >> low) : value >> low;
}

static void put_band(struct writer *w, const struct script *s, const int16_t *block, bool has_runs)
{
    int zeros = 0;
    for (int k = s->first > 0 ? s->first : 1; k <= s->last; k++) {
        const int value = cut_off(block[k], s->low), size = size_of(value);
        if (value == 0) {
            zeros++;
            continue;
        }
        put_run(w);
        for (; zeros > 15; zeros -= 16)
            put_symbol(w, &w->ac, 0xf0);
        put_symbol(w, &w->ac, zeros << 4 | size);
        put_number(w, value, size);
        zeros = 0;
    }
    if (zeros > 0)
        w->run++;
    if (!has_runs || w->run == 0x7fff || chance(50))
        put_run(w);
}

static void put_refined(struct writer *w, const struct script *s, const int16_t *block)
{
    uint8_t here[64];
    int zeros = 0, count = 0, last_new = 0;
    for (int k = s->first; k <= s->last; k++)
        last_new = abs(block[k]) >> s->low == 1 ? k : last_new;
    for (int k = s->first; k <= s->last; k++) {
        const int size = abs(block[k]) >> s->low;
        if (size == 0) {
            zeros++;
            continue;
        }
        for (; zeros > 15 && k <= last_new; zeros -= 16) {
            put_run(w);
            put_symbol(w, &w->ac, 0xf0);
            for (int i = 0; i < count; i++)
                put_bits(w, here[i], 1);
            count = 0;
        }
        if (size > 1) {
            here[count++] = size & 1;
            continue;
        }
        put_run(w);
        put_symbol(w, &w->ac, zeros << 4 | 1);
        put_bits(w, block[k] > 0, 1);
        for (int i = 0; i < count; i++)
            put_bits(w, here[i], 1);
        zeros = count = 0;
    }
    if (zeros > 0 || count > 0) {
        w->run++;
        memcpy(w->later + w->later_count, here, (size_t)count);
        w->later_count += count;
    }
    if (w->run == 0x7fff || w->later_count > 1024 - 64 || chance(50))
        put_run(w);
}

static void put_block(struct writer *w, const struct jpeg_case *c, const struct script *s, int i, const int16_t *block)
{
    if (!c->is_progressive) {
        put_mean(w, i, block[0]);
        put_band(w, s, block, false);
    } else if (s->first > 0 && s->high > 0) {
        put_refined(w, s, block);
    } else if (s->first > 0) {
        put_band(w, s, block, true);
    } else if (s->high > 0) {
        put_bits(w, (unsigned)(block[0] >> s->low) & 1, 1);
    } else {
        put_mean(w, i, block[0] >> s->low);
    }
}

/* ---------------------------------------------------------------------- segments */

static void put_word(struct buffer *b, int value)
{
    buffer_byte(b, (unsigned)value >> 8 & 255);
    buffer_byte(b, (unsigned)value & 255);
}

/* A marker, with bytes before it that fill. */
static void put_marker(struct buffer *b, unsigned marker)
{
    do
        buffer_byte(b, 0xff);
    while (chance(30));
    buffer_byte(b, marker);
}

/* What no reader needs. */
static void put_remark(struct buffer *b)
{
    static const uint8_t markers[5] = { 0xfe, 0xe1, 0xe2, 0xed, 0xef };
    const int size = between(0, 40);
    if (!chance(6))
        return;
    put_marker(b, markers[between(0, 4)]);
    put_word(b, size + 2);
    for (int i = 0; i < size; i++)
        buffer_byte(b, chance(4) ? 0xff : random_u32() & 255);
}

static void put_quanta(struct buffer *b, const uint16_t *quantum, int number)
{
    bool is_wide = chance(4);
    for (int k = 0; k < 64; k++)
        is_wide = is_wide || quantum[k] > 255;
    put_marker(b, 0xdb);
    put_word(b, is_wide ? 131 : 67);
    buffer_byte(b, (is_wide ? 16u : 0u) + (unsigned)number);
    for (int k = 0; k < 64; k++)
        if (is_wide)
            put_word(b, quantum[k]);
        else
            buffer_byte(b, quantum[k]);
}

static void put_codes(struct buffer *b, const struct code *c, int symbols, unsigned number)
{
    put_marker(b, 0xc4);
    put_word(b, 19 + symbols);
    buffer_byte(b, number);
    buffer_append(b, c->counts, 16);
    buffer_append(b, c->symbol, (size_t)symbols);
}

static const uint8_t *names_of(const struct jpeg_case *c)
{
    static const uint8_t names[6][3] = { { 1, 2, 3 }, { 1, 2, 3 }, { 1, 2, 3 }, { 'R', 'G', 'B' }, { 0, 77, 255 }, { 'R', 'G', 'B' } };
    return names[c->colors];
}

static void put_frame(struct buffer *b, const struct jpeg_case *c)
{
    if (c->colors == 0 || c->colors == 5) {
        put_marker(b, 0xe0);
        buffer_append(b, "\0\x10JFIF\0\1\1\0\0\1\0\1\0\0", 16);
    }
    if (c->colors == 1 || c->colors == 2 || c->colors == 5) {
        put_marker(b, 0xee);
        buffer_append(b, c->colors == 1 ? "\0\x0e" "Adobe\0d\0\0\0\0\1" : "\0\x0e" "Adobe\0d\0\0\0\0\0", 14);
    }
    for (int t = 0; t < 4; t++)
        put_quanta(b, c->quantum[t], t);
    put_remark(b);
    put_marker(b, c->is_progressive ? 0xc2 : chance(3) ? 0xc1 : 0xc0);
    put_word(b, 8 + 3 * c->count);
    buffer_byte(b, 8);
    put_word(b, c->height);
    put_word(b, c->width);
    buffer_byte(b, (unsigned)c->count);
    for (int i = 0; i < c->count; i++) {
        buffer_byte(b, names_of(c)[i]);
        buffer_byte(b, (unsigned)(c->h[i] << 4 | c->v[i]));
        buffer_byte(b, (unsigned)c->table[i]);
    }
}

/* ---------------------------------------------------------------------- scans */

/* Tables, at times others than before, and the header. */
static void put_scan_header(struct writer *w, const struct jpeg_case *c, const struct script *s, bool is_first)
{
    const int interval = chance(3) ? between(1, 20) : 0;
    if (is_first || chance(4)) {
        choose_code(&w->dc, 16);
        choose_code(&w->ac, 256);
        put_codes(w->out, &w->dc, 16, 2);
        put_codes(w->out, &w->ac, 256, 0x11);
    }
    if (interval != w->interval) {
        put_marker(w->out, 0xdd);
        put_word(w->out, 4);
        put_word(w->out, interval);
        w->interval = interval;
    }
    put_remark(w->out);
    put_marker(w->out, 0xda);
    put_word(w->out, 6 + 2 * s->count);
    buffer_byte(w->out, (unsigned)s->count);
    for (int i = 0; i < s->count; i++) {
        buffer_byte(w->out, names_of(c)[s->component[i]]);
        buffer_byte(w->out, 0x21);
    }
    buffer_byte(w->out, (unsigned)s->first);
    buffer_byte(w->out, (unsigned)s->last);
    buffer_byte(w->out, (unsigned)(s->high << 4 | s->low));
}

static void end_interval(struct writer *w)
{
    put_run(w);
    while (w->bits != 0)
        put_bits(w, 1, 1);
    memset(w->mean, 0, sizeof w->mean);
    w->end = w->out->size;
    if (chance(40))
        buffer_byte(w->out, 0);         /* one too many */
}

static void put_mcu(struct writer *w, const struct jpeg_case *c, const struct script *s, int x, int y)
{
    for (int n = 0; n < s->count; n++) {
        const int i = s->component[n], h = s->count == 1 ? 1 : c->h[i], v = s->count == 1 ? 1 : c->v[i];
        for (int row = y * v; row < (y + 1) * v; row++)
            for (int column = x * h; column < (x + 1) * h; column++)
                put_block(w, c, s, i, c->coefficient[i] + (row * c->columns[i] + column) * 64);
    }
}

/* A component keeps the quantisation that it began with: tables of those that have all begun may hold anything now. */
static void put_other_quanta(struct writer *w, const struct jpeg_case *c)
{
    uint16_t other[64];
    for (int k = 0; k < 64; k++)
        other[k] = (uint16_t)between(1, 99);
    for (int t = 0; t < 4; t++) {
        bool is_free = chance(8);
        for (int i = 0; i < c->count; i++)
            is_free = is_free && (c->table[i] != t || w->has_begun[i]);
        if (is_free)
            put_quanta(w->out, other, t);
    }
}

static void put_scan(struct writer *w, const struct jpeg_case *c, const struct script *s, bool is_first)
{
    const int i = s->component[0];
    const int columns = s->count == 1 ? real_columns(c, i) : c->columns[i] / c->h[i];
    const int rows = s->count == 1 ? real_rows(c, i) : c->rows[i] / c->v[i];
    if (!is_first)
        put_other_quanta(w, c);
    put_scan_header(w, c, s, is_first);
    for (int at = 0; at < columns * rows; at++) {
        if (w->interval > 0 && at > 0 && at % w->interval == 0) {
            end_interval(w);
            put_marker(w->out, 0xd0u + (unsigned)(at / w->interval - 1) % 8);
        }
        put_mcu(w, c, s, at % columns, at / columns);
    }
    end_interval(w);
    for (int n = 0; n < s->count; n++)
        w->has_begun[s->component[n]] = true;
}

/* Some of the components that are `wanted`; more than one where their blocks are ten at most. */
static void choose_components(const struct jpeg_case *c, const bool *wanted, struct script *s)
{
    int blocks = 0;
    for (int i = 0; i < c->count; i++) {
        if (!wanted[i] || (s->count > 0 && (chance(3) || blocks + c->h[i] * c->v[i] > 10)))
            continue;
        blocks += c->h[i] * c->v[i];
        s->component[s->count++] = i;
    }
}

static void put_sequential(struct writer *w, const struct jpeg_case *c)
{
    bool wanted[CASE_COMPONENTS] = { true, true, true }, is_first = true;
    for (int left = c->count; left > 0;) {
        struct script s = { .last = 63 };
        choose_components(c, wanted, &s);
        put_scan(w, c, &s, is_first);
        for (int n = 0; n < s.count; n++)
            wanted[s.component[n]] = false;
        left -= s.count;
        is_first = false;
    }
}

/* Any order of scans that ends with all bits told; of large pictures not too many. */
static void put_progressive(struct writer *w, const struct jpeg_case *c)
{
    enum { UNTOLD = 99 };
    const int fewest = c->width * c->height < 4096 ? 12 : 200;
    int low[CASE_COMPONENTS][64], left = c->count * 64;
    for (int at = 0; at < CASE_COMPONENTS * 64; at++)
        low[at / 64][at % 64] = UNTOLD;
    for (bool is_first = true; left > 0;) {
        struct script s = { .first = between(0, 63) };
        bool wanted[CASE_COMPONENTS] = { false };
        const int i = between(0, c->count - 1), state = is_first ? UNTOLD : low[i][s.first];
        if (is_first || chance(4))
            s.first = 0;
        if (low[i][s.first] != state || state == 0 || (s.first > 0 && low[i][0] == UNTOLD))
            continue;
        for (int k = i; k < c->count; k++)
            wanted[k] = low[k][0] == state;
        while (s.first > 1 && low[i][s.first - 1] == state && !chance(fewest))
            s.first--;
        s.last = s.first;
        while (s.first > 0 && s.last < 63 && low[i][s.last + 1] == state && !chance(fewest))
            s.last++;
        if (s.first == 0)
            choose_components(c, wanted, &s);
        else
            s.component[s.count++] = i;
        s.high = state == UNTOLD ? 0 : state;
        s.low = state == UNTOLD ? (chance(3) ? 0 : between(0, 3)) : state - 1;
        put_scan(w, c, &s, is_first);
        for (int n = 0; n < s.count; n++)
            for (int k = s.first; k <= s.last; k++) {
                low[s.component[n]][k] = s.low;
                left -= s.low == 0;
            }
        is_first = false;
    }
}

struct buffer jpeg_case_write(const struct jpeg_case *c, size_t *end)
{
    struct buffer out = { 0 };
    struct writer *w = calloc(1, sizeof *w);
    w->out = &out;
    buffer_append(&out, "\xff\xd8", 2);
    put_frame(&out, c);
    (c->is_progressive ? put_progressive : put_sequential)(w, c);
    *end = w->end;
    free(w);
    if (chance(6))
        return out;
    put_marker(&out, 0xd9);
    for (int n = chance(6) ? between(1, 50) : 0; n > 0; n--)
        buffer_byte(&out, random_u32() & 255);
    return out;
}
