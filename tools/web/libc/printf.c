/* SPDX-License-Identifier: MIT */
/* printf.c - the formats that the tools use: d i u x X o c s p f e g %, with flags - 0 + and space,
 * width and precision. */
#include "decimal.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct writer {
    char *out;
    size_t room, length;        /* length may exceed room */
};

struct spec {
    bool left, zero, plus, space;
    int width, precision;       /* precision -1: none given */
};

static void put(struct writer *w, char c)
{
    if (w->length < w->room)
        w->out[w->length] = c;
    w->length++;
}

static void pad(struct writer *w, char c, int count)
{
    while (count-- > 0)
        put(w, c);
}

/* A sign (or nothing), zeros where asked for, a body. */
static void put_field(struct writer *w, const struct spec *s, const char *sign, const char *body,
                      int length, bool zeros)
{
    int fill = s->width - (int)strlen(sign) - length;
    if (!s->left && !zeros)
        pad(w, ' ', fill);
    for (; *sign != '\0'; sign++)
        put(w, *sign);
    if (!s->left && zeros)
        pad(w, '0', fill);
    for (int i = 0; i < length; i++)
        put(w, body[i]);
    if (s->left)
        pad(w, ' ', fill);
}

static void put_integer(struct writer *w, const struct spec *s, uint64_t value, const char *sign,
                        unsigned base, bool capitals)
{
    char text[72];
    int at = (int)sizeof text;
    const char *digits = capitals ? "0123456789ABCDEF" : "0123456789abcdef";
    for (; value != 0; value /= base)
        text[--at] = digits[value % base];
    int least = s->precision < 0 ? 1 : s->precision > 64 ? 64 : s->precision;
    while ((int)sizeof text - at < least)
        text[--at] = '0';
    put_field(w, s, sign, text + at, (int)sizeof text - at, s->zero && s->precision < 0);
}

/* ------------------------------------------------------------------ doubles */

enum { NUMBER_ROOM = 1200 };

static char digit_at(const struct decimal *d, int place)       /* 0: the first before the point */
{
    int i = d->point - 1 - place;
    return (char)('0' + (i >= 0 && i < d->count ? d->digit[i] : 0));
}

static int write_plain(char *out, const struct decimal *d, int places, bool strip)
{
    int n = 0;
    for (int place = d->point > 1 ? d->point - 1 : 0; place >= 0; place--)
        out[n++] = digit_at(d, place);
    if (strip)
        while (places > 0 && places > d->count - d->point)
            places--;
    if (places > 0)
        out[n++] = '.';
    for (int place = 1; place <= places; place++)
        out[n++] = digit_at(d, -place);
    return n;
}

static int write_scientific(char *out, const struct decimal *d, int places, bool strip)
{
    int n = 0, exponent = d->count > 0 ? d->point - 1 : 0, magnitude = abs(exponent);
    out[n++] = (char)('0' + (d->count > 0 ? d->digit[0] : 0));
    if (strip)
        places = d->count > 1 ? d->count - 1 : 0;
    if (places > 0)
        out[n++] = '.';
    for (int i = 1; i <= places; i++)
        out[n++] = (char)('0' + (i < d->count ? d->digit[i] : 0));
    out[n++] = 'e';
    out[n++] = exponent < 0 ? '-' : '+';
    if (magnitude >= 100)
        out[n++] = (char)('0' + magnitude / 100);
    out[n++] = (char)('0' + magnitude / 10 % 10);
    out[n++] = (char)('0' + magnitude % 10);
    return n;
}

static void put_double(struct writer *w, const struct spec *s, double x, char kind)
{
    static struct decimal d;
    static char text[NUMBER_ROOM];
    const char *sign = signbit(x) ? "-" : s->plus ? "+" : s->space ? " " : "";
    int precision = s->precision < 0 ? 6 : s->precision > 300 ? 300 : s->precision, n;
    if (!isfinite(x)) {
        put_field(w, s, sign, isnan(x) ? "nan" : "inf", 3, false);
        return;
    }
    decimal_of(fabs(x), &d);
    if (kind == 'f') {
        decimal_round(&d, d.point + precision);
        n = write_plain(text, &d, precision, false);
    } else if (kind == 'e') {
        decimal_round(&d, precision + 1);
        n = write_scientific(text, &d, precision, false);
    } else {
        precision = precision == 0 ? 1 : precision;
        decimal_round(&d, precision);
        int exponent = d.count > 0 ? d.point - 1 : 0;
        n = exponent < -4 || exponent >= precision
              ? write_scientific(text, &d, precision - 1, true)
              : write_plain(text, &d, precision - 1 - exponent, true);
    }
    put_field(w, s, sign, text, n, s->zero);
}

/* ------------------------------------------------------------------ formats */

static int64_t signed_argument(va_list *args, int longs)
{
    return longs >= 2 ? va_arg(*args, long long) : longs == 1 ? va_arg(*args, long)
                                                              : va_arg(*args, int);
}

static uint64_t unsigned_argument(va_list *args, int longs)
{
    return longs >= 2   ? va_arg(*args, unsigned long long)
         : longs == 1 ? va_arg(*args, unsigned long)
                      : va_arg(*args, unsigned);
}

static int number_of(const char **p, va_list *args)
{
    int number = 0;
    if (**p == '*') {
        ++*p;
        return va_arg(*args, int);
    }
    while (**p >= '0' && **p <= '9')
        number = number * 10 + (*(*p)++ - '0');
    return number;
}

static void put_argument(struct writer *w, struct spec *s, char kind, int longs, va_list *args)
{
    switch (kind) {
    case 'd':
    case 'i': {
        int64_t v = signed_argument(args, longs);
        put_integer(w, s, v < 0 ? 0 - (uint64_t)v : (uint64_t)v,
                    v < 0 ? "-" : s->plus ? "+" : s->space ? " " : "", 10, false);
        break;
    }
    case 'u': put_integer(w, s, unsigned_argument(args, longs), "", 10, false); break;
    case 'o': put_integer(w, s, unsigned_argument(args, longs), "", 8, false); break;
    case 'x':
    case 'X': put_integer(w, s, unsigned_argument(args, longs), "", 16, kind == 'X'); break;
    case 'p': put_integer(w, s, (uintptr_t)va_arg(*args, void *), "0x", 16, false); break;
    case 'c': {
        char c = (char)va_arg(*args, int);
        put_field(w, s, "", &c, 1, false);
        break;
    }
    case 's': {
        const char *text = va_arg(*args, const char *);
        int length = 0;
        while ((s->precision < 0 || length < s->precision) && text[length] != '\0')
            length++;
        put_field(w, s, "", text, length, false);
        break;
    }
    case 'f':
    case 'e':
    case 'g': put_double(w, s, va_arg(*args, double), kind); break;
    default: put(w, kind); break;
    }
}

int vsnprintf(char *out, size_t room, const char *format, va_list given)
{
    struct writer w = { .out = out, .room = room > 0 ? room - 1 : 0 };
    va_list args;
    va_copy(args, given);
    for (const char *p = format; *p != '\0'; p++) {
        struct spec s = { .precision = -1 };
        int longs = 0;
        if (*p != '%') {
            put(&w, *p);
            continue;
        }
        for (p++; strchr("-0+ #", *p) != NULL && *p != '\0'; p++) {
            s.left = s.left || *p == '-';
            s.zero = s.zero || *p == '0';
            s.plus = s.plus || *p == '+';
            s.space = s.space || *p == ' ';
        }
        s.width = number_of(&p, &args);
        if (s.width < 0) {
            s.left = true;
            s.width = -s.width;
        }
        if (*p == '.') {
            p++;
            s.precision = number_of(&p, &args);
        }
        for (; *p == 'l' || *p == 'z' || *p == 'h' || *p == 'j' || *p == 't'; p++)
            longs += *p == 'l' ? 1 : *p == 'j' ? 2 : 0;         /* size_t is as long as int */
        if (*p == '\0')
            break;
        put_argument(&w, &s, *p, longs, &args);
    }
    va_end(args);
    if (room > 0)
        out[w.length < w.room ? w.length : w.room] = '\0';
    return (int)w.length;
}

int snprintf(char *out, size_t room, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(out, room, format, args);
    va_end(args);
    return length;
}

static int print(FILE *f, const char *format, va_list args)
{
    char line[256], *text = line;
    int length = vsnprintf(line, sizeof line, format, args);
    if (length >= (int)sizeof line) {
        text = malloc((size_t)length + 1);
        if (text == NULL)
            return -1;
        vsnprintf(text, (size_t)length + 1, format, args);
    }
    fwrite(text, 1, (size_t)length, f);
    if (text != line)
        free(text);
    return length;
}

int fprintf(FILE *f, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = print(f, format, args);
    va_end(args);
    return length;
}

int printf(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = print(stdout, format, args);
    va_end(args);
    return length;
}
