/* SPDX-License-Identifier: MIT */
/* math.c - functions whose results should be those of the host's library, so that a scene has the
 * same bits here and there.
 *
 * Everything is computed as a sum of two doubles, some 100 bits, and rounded once: the double
 * nearest to the true value but for very rare ties, from which good libraries differ in a few of a
 * hundred arguments, and then in the last bit. Sums and products without rounding error are
 * Knuth's and Dekker's. */
#include <math.h>

#include <stdint.h>
#include <string.h>

struct two {
    double high, low;
};

static struct two fast_sum(double a, double b)          /* |a| >= |b| */
{
    double s = a + b;
    return (struct two){ s, b - (s - a) };
}

static struct two exact_sum(double a, double b)
{
    double s = a + b, t = s - a;
    return (struct two){ s, (a - (s - t)) + (b - t) };
}

static struct two exact_product(double a, double b)
{
    const double split = 134217729.0;                   /* 2^27 + 1 */
    double ta = split * a, ah = ta - (ta - a), al = a - ah;
    double tb = split * b, bh = tb - (tb - b), bl = b - bh, p = a * b;
    return (struct two){ p, ((ah * bh - p) + ah * bl + al * bh) + al * bl };
}

static struct two add(struct two a, struct two b)
{
    struct two s = exact_sum(a.high, b.high), t = exact_sum(a.low, b.low);
    s = fast_sum(s.high, s.low + t.high);
    return fast_sum(s.high, s.low + t.low);
}

static struct two multiply(struct two a, struct two b)
{
    struct two p = exact_product(a.high, b.high);
    return fast_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

static struct two negate(struct two a)
{
    return (struct two){ -a.high, -a.low };
}

static struct two divide(struct two a, struct two b)
{
    double q = a.high / b.high;
    struct two rest = add(a, negate(multiply(b, (struct two){ q, 0 })));
    double q2 = rest.high / b.high;
    rest = add(rest, negate(multiply(b, (struct two){ q2, 0 })));
    struct two sum = fast_sum(q, q2);
    return fast_sum(sum.high, sum.low + rest.high / b.high);
}

static struct two scaled(struct two a, double power_of_two)
{
    return (struct two){ a.high * power_of_two, a.low * power_of_two };
}

static struct two whole(double x)
{
    return (struct two){ x, 0 };
}

/* ------------------------------------------------------------------ bits */

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

double frexp(double x, int *exponent)
{
    *exponent = 0;
    if (x == 0 || !isfinite(x))
        return x;
    if (fabs(x) < 0x1p-1022) {
        x *= 0x1p64;
        *exponent = -64;
    }
    uint64_t bits = bits_of(x);
    *exponent += (int)(bits >> 52 & 2047) - 1022;
    return from_bits((bits & ~((uint64_t)2047 << 52)) | (uint64_t)1022 << 52);
}

double ldexp(double x, int exponent)
{
    /* in steps, so that a subnormal result is rounded once */
    for (; exponent > 1023; exponent -= 1023) {
        x *= 0x1p1023;
        if (!isfinite(x))
            return x;
    }
    for (; exponent < -1022; exponent += 969) {
        x *= 0x1p-969;
        if (x == 0)
            return x;
    }
    return x * from_bits((uint64_t)(exponent + 1023) << 52);
}

int ilogb(double x)
{
    int exponent;
    if (x == 0)
        return -2147483647 - 1;
    if (!isfinite(x))
        return 2147483647;
    frexp(x, &exponent);
    return exponent - 1;
}

double fmod(double x, double y)
{
    double a = fabs(x), b = fabs(y);
    if (!(b > 0) || !isfinite(x) || isnan(y))
        return NAN;
    while (a >= b) {                    /* b x 2^k, the largest not above a, is taken away */
        int ea, eb;
        frexp(a, &ea);
        frexp(b, &eb);
        double t = ldexp(b, ea - eb);
        if (t > a)
            t = ldexp(b, ea - eb - 1);
        a -= t;
    }
    return copysign(a, x);
}

double remainder(double x, double y)
{
    double rest = fmod(x, 2 * y), half = fabs(y) / 2, a = fabs(rest);
    if (a > 3 * half)
        a -= 4 * half;
    else if (a > half)
        a -= a == 3 * half ? 4 * half : 2 * half;
    return isnan(rest) ? rest : copysign(1, x) * a;
}

/* Halves go away from zero. */
static double round_away(double x)
{
    double down = floor(fabs(x));
    return copysign(fabs(x) - down >= 0.5 ? down + 1 : down, x);
}

long lround(double x)
{
    x = round_away(x);
    return x >= 0x1p31 || x < -0x1p31 || isnan(x) ? -2147483647L - 1 : (long)x;
}

long long llround(double x)
{
    x = round_away(x);
    return x >= 0x1p63 || x < -0x1p63 || isnan(x) ? -9223372036854775807LL - 1 : (long long)x;
}

/* ------------------------------------------------------------------ angles */

static const struct two half_pi = { 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54 };

/* Of |r| up to pi / 4, by the series. */
static struct two sine(struct two r)
{
    struct two square = multiply(r, r), sum = whole(1);
    for (int n = 26; n >= 2; n -= 2)
        sum = add(whole(1), negate(divide(multiply(square, sum), whole(n * (n + 1.0)))));
    return multiply(r, sum);
}

static struct two cosine(struct two r)
{
    struct two square = multiply(r, r), sum = whole(1);
    for (int n = 27; n >= 1; n -= 2)
        sum = add(whole(1), negate(divide(multiply(square, sum), whole(n * (n + 1.0)))));
    return sum;
}

/* x = quarters x pi / 2 + rest. pi / 2 in three parts of 33 bits and a tail: products with the
 * quarters of angles up to 2^20 are exact. */
static int reduce(double x, struct two *rest)
{
    static const double part[4] = { 0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                                    0x1.b839a252049c1p-104 };
    if (fabs(x) > 0x1p20)
        x = fmod(x, 4 * half_pi.high);
    double quarters = rint(x / half_pi.high);
    struct two r = whole(x);
    for (int i = 0; i < 4; i++)
        r = add(r, negate(exact_product(quarters, part[i])));
    *rest = r;
    return (int)(long long)quarters & 3;
}

static struct two sine_of_quarter(int quarter, struct two r)
{
    struct two s = quarter & 1 ? cosine(r) : sine(r);
    return quarter & 2 ? negate(s) : s;
}

double sin(double x)
{
    struct two r;
    if (!isfinite(x))
        return NAN;
    if (fabs(x) < 0x1p-27)
        return x;
    int quarter = reduce(x, &r);
    return sine_of_quarter(quarter, r).high;
}

double cos(double x)
{
    struct two r;
    if (!isfinite(x))
        return NAN;
    int quarter = reduce(x, &r);
    return sine_of_quarter((quarter + 1) & 3, r).high;
}

double tan(double x)
{
    struct two r;
    if (!isfinite(x))
        return NAN;
    if (fabs(x) < 0x1p-27)
        return x;
    int quarter = reduce(x, &r);
    return divide(sine_of_quarter(quarter, r), sine_of_quarter((quarter + 1) & 3, r)).high;
}

/* Of 0 <= t <= 1: a guess, made better by the angle that is left: three times as many digits each
 * time. */
static struct two arc(struct two t)
{
    struct two angle = whole(t.high / (1 + 0.28 * t.high * t.high));
    for (int i = 0; i < 4; i++) {
        struct two s = sine(angle), c = cosine(angle);
        struct two left = divide(add(multiply(t, c), negate(s)), add(c, multiply(t, s)));
        struct two cube = multiply(multiply(left, left), left);
        angle = add(angle, add(left, negate(divide(cube, whole(3)))));
    }
    return angle;
}

double atan2(double y, double x)
{
    double ax = fabs(x), ay = fabs(y);
    struct two angle = { 0, 0 };
    if (isnan(x) || isnan(y))
        return NAN;
    if (isinf(x) && isinf(y))
        ax = ay = 1;
    /* scaled, so that products neither overflow nor vanish */
    int ex, ey;
    frexp(ax, &ex);
    frexp(ay, &ey);
    if (ay != 0 && (ax == 0 || isinf(ay) || (isfinite(ax) && ey - ex > 80))) {
        angle = half_pi;
    } else if (ay != 0 && isfinite(ax) && ex - ey <= 80) {
        ax = ldexp(ax, -ex);
        ay = ldexp(ay, -ex);
        angle = ay <= ax ? arc(divide(whole(ay), whole(ax)))
                         : add(half_pi, negate(arc(divide(whole(ax), whole(ay)))));
    } else if (ay != 0 && isfinite(ax)) {
        angle = whole(fabs(y) / fabs(x));
    }
    if (signbit(x))
        angle = add(scaled(half_pi, 2), negate(angle));
    return copysign(angle.high, y);
}

double atan(double x)
{
    return atan2(x, 1);
}

/* ------------------------------------------------------------------ powers */

static const struct two log_2 = { 0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56 };

/* By the series, of a sixteenth of what is left without powers of two. */
static struct two exponential(struct two x, int *power)
{
    *power = (int)rint(x.high / log_2.high);
    struct two r = add(x, negate(multiply(log_2, whole(*power)))), sum = whole(1);
    r = scaled(r, 1.0 / 16);
    for (int n = 16; n >= 1; n--)
        sum = add(whole(1), divide(multiply(r, sum), whole(n)));
    for (int i = 0; i < 4; i++)
        sum = multiply(sum, sum);
    return sum;
}

/* Of x > 0: 2 artanh((m - 1) / (m + 1)) of its mantissa m. */
static struct two logarithm(double x)
{
    int exponent;
    double m = frexp(x, &exponent);
    if (m < 0.70710678118654752) {
        m *= 2;
        exponent--;
    }
    struct two t = divide(exact_sum(m, -1), exact_sum(m, 1)), square = multiply(t, t);
    struct two sum = { 0, 0 };
    for (int n = 45; n >= 1; n -= 2)
        sum = add(divide(whole(1), whole(n)), multiply(square, sum));
    return add(multiply(log_2, whole(exponent)), scaled(multiply(t, sum), 2));
}

double exp(double x)
{
    int power;
    if (isnan(x) || x > 710)
        return x > 710 ? HUGE_VAL : x;
    if (x < -750)
        return 0;
    struct two e = exponential(whole(x), &power);
    return ldexp(e.high, power);
}

double log(double x)
{
    if (!(x > 0) || !isfinite(x))
        return x == 0 ? -HUGE_VAL : x > 0 ? x : NAN;
    return logarithm(x).high;
}

/* Of x >= 0; all that the tools ask for. */
double pow(double x, double y)
{
    int power;
    if (y == 0 || x == 1)
        return 1;
    if (!(x > 0) || !isfinite(x) || !isfinite(y))
        return x == 0 ? (y > 0 ? 0 : HUGE_VAL) : x > 0 && y > 0 ? x : NAN;
    struct two e = multiply(logarithm(x), whole(y));
    if (e.high > 710)
        return HUGE_VAL;
    if (e.high < -750)
        return 0;
    e = exponential(e, &power);
    return ldexp(e.high, power);
}

float powf(float x, float y)
{
    return (float)pow(x, y);
}
