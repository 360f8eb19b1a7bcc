/* SPDX-License-Identifier: MIT */
/* web_libc.c - the page's own numbers (tools/web/libc) against the host's library: text and decimal numbers exactly,
 * functions to the last bit in nearly all of the cases and never off by more than one step.
 *
 * The page's functions have been given names that begin with web_ (see tools/web/web.mk). */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double web_sin(double x), web_cos(double x), web_tan(double x), web_atan(double x), web_atan2(double y, double x);
double web_exp(double x), web_log(double x), web_pow(double x, double y), web_fmod(double x, double y);
double web_remainder(double x, double y), web_frexp(double x, int *exponent), web_ldexp(double x, int exponent);
long web_lround(double x);
int web_ilogb(double x);
double web_strtod(const char *text, char **end);
int web_snprintf(char *out, size_t room, const char *format, ...);

static int passed, failed;

static void claim(const char *what, int holds)
{
    passed += holds != 0;
    failed += holds == 0;
    if (!holds)
        printf("FAIL: %s\n", what);
}

static uint64_t random_bits(void)
{
    static uint64_t state = 88172645463325252u;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

static double between(double low, double high)
{
    return low + (high - low) * (double)(random_bits() >> 11) / 9007199254740992.0;
}

/* Any finite double. */
static double wild(void)
{
    for (;;) {
        uint64_t bits = random_bits();
        double x;
        memcpy(&x, &bits, sizeof x);
        if (isfinite(x))
            return x;
    }
}

/* Doubles in a row have numbers in a row. */
static int64_t place(double x)
{
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits < 0 ? INT64_MIN - bits : bits;
}

static int same(double a, double b)
{
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

/* ------------------------------------------------------------------ functions */

enum { TRIALS = 20000 };

struct tally {
    int differ, far;
};

static void compare(struct tally *t, double got, double want)
{
    int64_t steps = place(got) - place(want);
    t->differ += !same(got, want);
    t->far += !same(got, want) && (steps < -1 || steps > 1);
}

static void claim_close(const char *what, const struct tally *t)
{
    char text[160];
    snprintf(text, sizeof text, "%s: %d of %d differ, %d by more than a step", what, t->differ, (int)TRIALS, t->far);
    claim(text, t->differ <= TRIALS / 50 && t->far == 0);
}

static void compare_functions(void)
{
    struct tally t[12] = { { 0, 0 } };
    static const char *const name[12] = { "sin", "cos", "tan", "large angles", "atan", "atan2", "exp", "log", "pow",
                                          "sRGB's pow", "small angles", "atan2 of anything" };
    for (int i = 0; i < TRIALS; i++) {
        double x = between(-20, 20), y = between(-3, 3), far = between(-1e5, 1e5);
        double unit = between(0, 1), tiny = ldexp(y, -(i % 60));
        double a = wild(), b = wild();
        compare(&t[0], web_sin(x), sin(x));
        compare(&t[1], web_cos(x), cos(x));
        compare(&t[2], web_tan(x), tan(x));
        compare(&t[3], web_sin(far), sin(far));
        compare(&t[4], web_atan(x), atan(x));
        compare(&t[5], web_atan2(x, y), atan2(x, y));
        compare(&t[6], web_exp(x), exp(x));
        compare(&t[7], web_log(fabs(x)), log(fabs(x)));
        compare(&t[8], web_pow(fabs(x), y), pow(fabs(x), y));
        compare(&t[9], web_pow((unit + 0.055) / 1.055, 2.4), pow((unit + 0.055) / 1.055, 2.4));
        compare(&t[10], web_sin(tiny), sin(tiny));
        compare(&t[11], web_atan2(a, b), atan2(a, b));
    }
    for (int k = 0; k < 12; k++)
        claim_close(name[k], &t[k]);
}

static void compare_edges(void)
{
    static const double edge[] = { 0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 1.5, 2.5, -2.5, 1e-300, 5e-324, 1e300, INFINITY,
                                   -INFINITY, NAN, 3.141592653589793, 1.5707963267948966, 0.7853981633974483 };
    enum { EDGES = sizeof edge / sizeof *edge };
    int bad = 0;
    for (int i = 0; i < EDGES; i++) {
        int e, f;
        double x = edge[i], m = web_frexp(x, &e), n = frexp(x, &f);
        bad += !same(m, n) || (isfinite(x) && e != f);
        bad += isfinite(x) && x != 0 && web_ilogb(x) != ilogb(x);
        bad += fabs(x) < 1e9 && web_lround(x) != lround(x);
        bad += !same(web_sin(x), sin(x)) && fabs(x) < 10;
        bad += !same(web_cos(x), cos(x)) && fabs(x) < 10;
        for (int k = 0; k < EDGES; k++) {
            double y = edge[k];
            bad += !same(web_atan2(x, y), atan2(x, y));
            bad += !same(web_fmod(x, y), fmod(x, y)) && isfinite(x) && isfinite(y);
        }
    }
    for (int i = 0; i < TRIALS; i++) {
        double x = between(-1000, 1000), y = between(-10, 10), a = wild();
        int shift = (int)(random_bits() % 4000) - 2000;
        bad += !same(web_fmod(x, y), fmod(x, y)) + !same(web_remainder(x, y), remainder(x, y));
        bad += !same(web_ldexp(x, shift % 900), ldexp(x, shift % 900)) + (web_lround(x) != lround(x));
        bad += web_ilogb(a) != ilogb(a);
    }
    claim("edges, remainders and exponents", bad == 0);
}

/* ------------------------------------------------------------------ text */

static int reads_alike(const char *text)
{
    char *end, *web_end;
    double want = strtod(text, &end), got = web_strtod(text, &web_end);
    if (same(got, want) && end == web_end)
        return 1;
    printf("    \"%s\": %.17g, not %.17g\n", text, got, want);
    return 0;
}

static void compare_reading(void)
{
    static const char *const odd[] = {
        "0", "-0", "1", ".5", "5.", "1e5", "1e", "1e+", "+7.25", "  3", "x", "", "-", ".", "1.7976931348623157e308",
        "1.8e308", "1e400", "4.9e-324", "2.4e-324", "2.5e-324", "2.2250738585072011e-308", "9007199254740993",
        "9007199254740992.9999999999", "0.1000000000000000055511151231257827021181583404541015625",
        "0.000000000000000000000000000000000000000000012345678901234567890123", "123456789012345678901234567890",
        "8.5e-400", "00012.5000", "1e22", "1e23", "179769313486231580793728971405301e276", "1.5.5", "7e-2,3" };
    char text[80];
    int bad = 0;
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        bad += !reads_alike(odd[i]);
    for (int i = 0; i < TRIALS; i++) {
        static const char *const format[] = { "%.17g", "%.16g", "%.20f", "%.9g", "%.6f", "%.30e" };
        snprintf(text, sizeof text, format[i % 6], i % 6 == 2 || i % 6 == 4 ? between(-2000, 2000) : wild());
        bad += !reads_alike(text);
    }
    claim("numbers are read as the host reads them", bad == 0);
}

static void compare_writing(void)
{
    static const char *const format[] = { "%g", "%.6g", "%.17g", "%.9g", "%f", "%.3f", "%.0f", "%.2f", "%e", "%.0e", "%12.4g",
                                          "%-12.3f|", "%012.3f", "%+.3g", "% .3g", "%.1g" };
    static char want[1000], got[1000];
    int bad = 0;
    for (int i = 0; i < TRIALS; i++) {
        const char *how = format[(size_t)i % (sizeof format / sizeof *format)];
        double halves = (double)((int)(random_bits() % 4001) - 2000) / 16;
        double x = i % 3 == 0 ? wild() : i % 3 == 1 ? between(-1000, 1000) : halves;
        int a = snprintf(want, sizeof want, how, x), b = web_snprintf(got, sizeof got, how, x);
        if (a != b || strcmp(want, got) != 0) {
            printf("    %s: \"%s\", not \"%s\"\n", how, got, want);
            bad++;
        }
    }
    claim("doubles are written as the host writes them", bad == 0);

    static const char all[] = "%d|%5d|%-5d|%05d|%+d|%.4d|%u|%x|%X|%08lx|%llu|%lld|%o|%c|%s|%10s|%-10s|%.2s|%.*s|%*d|%%";
    snprintf(want, sizeof want, all, -42, 42, 42, -42, 42, 42, 4294967295u, 48879u, 48879u, 0xabcul, 1ull << 63, -1ll, 8u,
             'c', "text", "text", "text", "text", 3, "text", 6, 7);
    web_snprintf(got, sizeof got, all, -42, 42, 42, -42, 42, 42, 4294967295u, 48879u, 48879u, 0xabcul, 1ull << 63,
                 -1ll, 8u, 'c', "text", "text", "text", "text", 3, "text", 6, 7);
    claim("so is everything else", strcmp(want, got) == 0);
    claim("what is too long is cut, and told",
          web_snprintf(got, 6, "%s", "abcdefgh") == 8 && strcmp(got, "abcde") == 0);
    claim("nothing is written where there is no room", web_snprintf(NULL, 0, "%d", 12345) == 5);
}

int main(void)
{
    compare_functions();
    compare_edges();
    compare_reading();
    compare_writing();
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
