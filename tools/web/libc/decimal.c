/* SPDX-License-Identifier: MIT */
/* decimal.c - see decimal.h. Whole numbers of up to some 2600 bits do it. */
#include "decimal.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 128 };

/* Lowest word first. */
struct big {
    int count;
    uint32_t word[WORDS];
};

static void multiply_add(struct big *b, uint32_t factor, uint32_t carry)
{
    uint64_t sum = carry;
    for (int i = 0; i < b->count; i++) {
        sum += (uint64_t)b->word[i] * factor;
        b->word[i] = (uint32_t)sum;
        sum >>= 32;
    }
    if (sum != 0 && b->count < WORDS)
        b->word[b->count++] = (uint32_t)sum;
}

static uint32_t divide_by(struct big *b, uint32_t divisor)
{
    uint64_t rest = 0;
    for (int i = b->count - 1; i >= 0; i--) {
        rest = rest << 32 | b->word[i];
        b->word[i] = (uint32_t)(rest / divisor);
        rest %= divisor;
    }
    while (b->count > 0 && b->word[b->count - 1] == 0)
        b->count--;
    return (uint32_t)rest;
}

static void shift_up(struct big *b, int bits)
{
    int words = bits / 32;
    multiply_add(b, (uint32_t)1 << bits % 32, 0);
    if (words > 0 && b->count > 0 && b->count + words <= WORDS) {
        memmove(b->word + words, b->word, (size_t)b->count * sizeof *b->word);
        memset(b->word, 0, (size_t)words * sizeof *b->word);
        b->count += words;
    }
}

static void times_ten(struct big *b, int power)
{
    for (; power >= 9; power -= 9)
        multiply_add(b, 1000000000u, 0);
    for (; power > 0; power--)
        multiply_add(b, 10, 0);
}

static int bit_length(const struct big *b)
{
    return b->count == 0 ? 0 : 32 * b->count - __builtin_clz(b->word[b->count - 1]);
}

static int compare(const struct big *a, const struct big *b)
{
    if (a->count != b->count)
        return a->count < b->count ? -1 : 1;
    for (int i = a->count - 1; i >= 0; i--)
        if (a->word[i] != b->word[i])
            return a->word[i] < b->word[i] ? -1 : 1;
    return 0;
}

static void subtract(struct big *a, const struct big *b)        /* a >= b */
{
    int64_t borrow = 0;
    for (int i = 0; i < a->count; i++) {
        int64_t left = (int64_t)a->word[i] - (i < b->count ? b->word[i] : 0) + borrow;
        a->word[i] = (uint32_t)left;
        borrow = left < 0 ? -1 : 0;
    }
    while (a->count > 0 && a->word[a->count - 1] == 0)
        a->count--;
}

static void set(struct big *b, uint64_t value)
{
    b->count = 0;
    for (; value != 0; value >>= 32)
        b->word[b->count++] = (uint32_t)value;
}

void decimal_of(double x, struct decimal *out)
{
    int exponent, places = 0, n = 0;
    struct big b;
    char text[DECIMAL_DIGITS];
    out->count = out->point = 0;
    if (x == 0)
        return;
    set(&b, (uint64_t)ldexp(frexp(x, &exponent), 53));
    exponent -= 53;
    for (; exponent < 0 && (b.word[0] & 1) == 0; exponent++)
        divide_by(&b, 2);
    if (exponent >= 0)
        shift_up(&b, exponent);
    for (; exponent < 0; exponent++, places++)          /* x / 2 is x times 5, one place on */
        multiply_add(&b, 5, 0);
    while (b.count > 0)
        text[n++] = (char)divide_by(&b, 10);
    out->point = n - places;
    while (n > 0)
        out->digit[out->count++] = text[--n];
    while (out->count > 0 && out->digit[out->count - 1] == 0)
        out->count--;
}

void decimal_round(struct decimal *d, int count)
{
    if (count >= d->count)
        return;
    if (count < 0) {
        d->count = 0;
        return;
    }
    bool is_half = d->digit[count] == 5 && count == d->count - 1;
    bool is_up = d->digit[count] > 5 || (d->digit[count] == 5 && !is_half)
              || (is_half && count > 0 && (d->digit[count - 1] & 1) != 0);
    d->count = count;
    while (is_up && d->count > 0 && d->digit[d->count - 1] == 9)
        d->count--;
    if (is_up && d->count > 0) {
        d->digit[d->count - 1]++;
    } else if (is_up) {
        d->digit[d->count++] = 1;
        d->point++;
    }
    while (d->count > 0 && d->digit[d->count - 1] == 0)
        d->count--;
}

/* numerator / denominator, rounded once. */
static double quotient(struct big *n, struct big *d, bool more)
{
    enum { BITS = 54 };                 /* a double's 53, and one for rounding */
    uint64_t q = 0;
    int shift = BITS - (bit_length(n) - bit_length(d)), exponent = -shift;
    if (shift > 0)
        shift_up(n, shift);
    else
        shift_up(d, -shift);
    shift_up(d, BITS);
    for (int i = BITS; i >= 0; i--) {   /* 54 or 55 bits come */
        q <<= 1;
        if (compare(n, d) >= 0) {
            subtract(n, d);
            q |= 1;
        }
        shift_up(n, 1);
    }
    more = more || n->count > 0;
    for (; q >> BITS != 0 || exponent < -1075; exponent++) {    /* fewer where it is subnormal */
        more = more || (q & 1) != 0;
        q >>= 1;
    }
    uint64_t whole = q >> 1;
    if ((q & 1) != 0 && (more || (whole & 1) != 0))
        whole++;
    return ldexp((double)whole, exponent + 1);
}

double decimal_value(const struct decimal *d, bool more)
{
    static struct big n, m;
    if (d->count == 0 || d->point < -400)
        return 0;
    if (d->point > 310)
        return HUGE_VAL;
    set(&n, 0);
    set(&m, 1);
    for (int i = 0; i < d->count; i++) {
        if (n.count == 0)
            set(&n, (uint64_t)d->digit[i]);
        else
            multiply_add(&n, 10, (uint32_t)d->digit[i]);
    }
    int power = d->point - d->count;
    if (power >= 0)
        times_ten(&n, power);
    else
        times_ten(&m, -power);
    return quotient(&n, &m, more);
}

/* ------------------------------------------------------------------ strtod */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Decimal numbers; no hexadecimal, infinities or nans, which none of our files may hold. */
double strtod(const char *text, char **end)
{
    static struct decimal d;
    const char *p = text;
    bool negative, any = false, dot = false, more = false;
    uint64_t small = 0;
    int power = 0;
    d.count = d.point = 0;
    while (*p == ' ' || (*p >= '\t' && *p <= '\r'))
        p++;
    negative = *p == '-';
    p += *p == '-' || *p == '+';
    for (; is_digit(*p) || (*p == '.' && !dot); p++) {
        if (*p == '.') {
            dot = true;
            continue;
        }
        any = true;
        if (d.count > 0 || *p != '0') {
            if (d.count < DECIMAL_DIGITS - 30)
                d.digit[d.count++] = (char)(*p - '0');
            else
                more = more || *p != '0';
            d.point += !dot;
        } else {
            d.point -= dot;
        }
    }
    if (end != NULL)
        *end = (char *)(any ? p : text);
    if (!any)
        return 0;
    if (*p == 'e' || *p == 'E') {
        const char *q = p + 1;
        bool down = *q == '-';
        q += *q == '-' || *q == '+';
        if (is_digit(*q)) {
            for (; is_digit(*q); q++)
                power = power < 10000 ? power * 10 + (*q - '0') : power;
            if (end != NULL)
                *end = (char *)q;
            d.point += down ? -power : power;
        }
    }
    while (d.count > 0 && d.digit[d.count - 1] == 0)
        d.count--;
    double value;
    power = d.point - d.count;
    if (d.count <= 15 && power >= -22 && power <= 22) {         /* one rounding, of exact numbers */
        static const double ten[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21,
                                      1e22 };
        for (int i = 0; i < d.count; i++)
            small = small * 10 + (uint64_t)d.digit[i];
        value = power < 0 ? (double)small / ten[-power] : (double)small * ten[power];
    } else {
        value = decimal_value(&d, more);
    }
    return negative ? -value : value;
}
