/* SPDX-License-Identifier: MIT */
/* test_jpeg.c - JPEG pictures: files of all kinds that libjpeg packed, damage, and what is refused. JPEG_CASES=100000 asks for as
 * many damaged files, and tells what they took. */
#include "tests/host.h"

#include "tools/image/buffer.h"
#include "tools/image/image.h"

#include <sys/resource.h>
#include <time.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* ---------------------------------------------------------------------- pictures of libjpeg's */

/* Pictures that libjpeg-turbo 2.1.5 packed (cjpeg, by the options that their names are made of), and what it makes of them again
 * (djpeg -dct int): tests/data/jpeg. jpeg.sh asks it for more, at random. */
static const char *const pictures[] = {
    "420", "422-progressive", "440", "rgb", "1x1-2x2-1x2-rgb-optimized-restart-blocks", "1x1-progressive", "1x2-1x1-1x1-optimized",
    "1x2-progressive-restart-blocks", "1x3", "1x4-1x2-1x1-progressive", "2x1", "2x2", "2x2-1x1-2x2-restart-rows",
    "2x2-1x2-progressive-optimized", "2x2-2x1-optimized", "2x2-restart-rows", "2x3-rgb-restart-rows", "2x4-restart-rows",
    "3x1-rgb-progressive-optimized", "3x2-progressive", "3x2-rgb", "4x1-2x1-1x1-progressive-optimized-restart-blocks",
    "4x1-optimized", "4x2-1x1-1x1-progressive-optimized", "4x2-progressive-optimized-restart-rows", "grey-progressive",
    "grey-optimized-restart-rows", "grey-progressive-restart-blocks", "bits-by-bits", "one-pixel", "quanta-of-16-bits",
    "scans-apart", "scans-of-two",
};

static struct buffer file_named(const char *name)
{
    char path[96];
    struct buffer b = { 0 };
    struct failure f = { "" };
    snprintf(path, sizeof path, "tests/data/jpeg/%s.jpg", name);
    CHECK(file_read(path, 1 << 16, &b.data, &b.size, &f));
    return b;
}

static void test_jpeg_shows_what_libjpeg_does(void)
{
    for (size_t i = 0; i < COUNT(pictures); i++) {
        struct image got OWNED(image_free) = { .rgba = NULL }, want OWNED(image_free) = { .rgba = NULL };
        struct buffer file OWNED(buffer_free) = file_named(pictures[i]);
        struct failure f = { "" };
        char known[96];
        snprintf(known, sizeof known, "tests/data/jpeg/%s.ppm", pictures[i]);
        if (CHECK(jpeg_decode(file.data, file.size, &got, &f)) && CHECK(image_load(known, &want, &f))
            && CHECK_EQ(got.width, want.width) && CHECK_EQ(got.height, want.height))
            for (int k = 0; k < got.width * got.height * 4; k++)
                CHECK_NEAR(got.rgba[k], want.rgba[k], 2);
    }
}

/* The last marker alone may be missing. */
static void test_jpeg_notices_every_cut(void)
{
    for (size_t i = 0; i < COUNT(pictures); i++) {
        struct image whole OWNED(image_free) = { 0 }, got;
        struct buffer file OWNED(buffer_free) = file_named(pictures[i]);
        struct failure f = { "" };
        if (!CHECK(jpeg_decode(file.data, file.size, &whole, &f)))
            break;
        for (size_t size = 0; size < file.size; size++) {
            uint8_t *cut = malloc(size + (size == 0));        /* a read beyond it would be noticed */
            memcpy(cut, file.data, size);
            f = (struct failure){ "" };
            const bool ok = jpeg_decode(cut, size, &got, &f);
            free(cut);
            if (!CHECK(ok == (size >= file.size - 2)) || !CHECK(ok || (f.text[0] != '\0' && got.rgba == NULL)))
                break;
            CHECK(!ok || memcmp(got.rgba, whole.rgba, (size_t)(got.width * got.height) * 4) == 0);
            image_free(&got);
        }
    }
}

/* ---------------------------------------------------------------------- damage */

static void damage(struct buffer *b)
{
    for (int n = between(1, chance(4) ? 20 : 3); n > 0; n--) {
        const size_t at = (size_t)between(2, (int)b->size - 1), length = (size_t)between(1, 20);
        uint8_t *p = b->data + at;
        switch (between(0, 5)) {
        case 0: *p = random_u32() & 255; break;
        case 1: *p ^= (uint8_t)(1 << between(0, 7)); break;
        case 2: *p = chance(2) ? 0xff : 0; break;
        case 3:
            if (b->size > length + at)
                memmove(p, p + length, (b->size -= length) - at);
            break;
        case 4:
            if (buffer_reserve(b, length)) {
                memmove(b->data + at + length, b->data + at, b->size - at);
                memset(b->data + at, (int)(random_u32() & 255), length);
                b->size += length;
            }
            break;
        default: *p = (uint8_t)between(0xc0, 0xdf), p[-1] = 0xff; break;
        }
    }
}

static void test_jpeg_survives_damage(void)
{
    const char *asked = getenv("JPEG_CASES");
    const int cases = (int)number_from("JPEG_CASES", 2000);
    clock_t slowest = 0;
    int drawn = 0;
    random_state = 3;
    for (int i = 0; i < cases; i++) {
        struct image got;
        struct failure f = { "" };
        struct buffer file = file_named(pictures[between(0, COUNT(pictures) - 1)]);
        damage(&file);
        uint8_t *exact = malloc(file.size);
        memcpy(exact, file.data, file.size);
        const clock_t before = clock();
        const bool ok = jpeg_decode(exact, file.size, &got, &f);
        const clock_t taken = clock() - before;
        slowest = taken > slowest ? taken : slowest;
        drawn += ok;
        free(exact);
        buffer_free(&file);
        image_free(&got);
        if (!CHECK(ok == (f.text[0] == '\0')))
            break;
    }
    CHECK(drawn > cases / 20 && drawn < cases * 19 / 20);
    struct rusage used;
    if (asked != NULL && getrusage(RUSAGE_SELF, &used) == 0)
        printf("%d damaged files, of which %d were drawn: %.3f s the slowest, %ld kB at most\n", cases, drawn,
               (double)slowest / CLOCKS_PER_SEC, used.ru_maxrss);
}

/* ---------------------------------------------------------------------- what is refused */

/* Files of hexadecimal digits, of which some stand for what many have in common. */
static struct buffer file_of(const char *digits)
{
    static const struct { char name; const char *digits; } parts[] = {
        { 'Q', "ffdb004300 01010101010101010101010101010101 01010101010101010101010101010101 01010101010101010101010101010101"
               "01010101010101010101010101010101" },         /* quantisation table 0: ones */
        { 'H', "ffc40014000100000000000000000000000000000000 ffc40014100100000000000000000000000000000000" },   /* DC 0, AC 0: 0 is 0 */
        { 'G', "ffc0000b080008000801011100" },              /* grey, 8 x 8 */
        { 'P', "ffc2000b080008000801011100" },              /* the same, progressive */
        { 'S', "ffda0008010100003f00" },                    /* its scan */
    };
    struct buffer b = { 0 };
    int high = -1;
    for (; *digits != '\0'; digits++) {
        const char *digit = strchr("0123456789abcdef", *digits);
        if (digit != NULL) {
            const int value = (int)(digit - "0123456789abcdef");
            if (high >= 0)
                buffer_byte(&b, (unsigned)(high << 4 | value));
            high = high >= 0 ? -1 : value;
            continue;
        }
        for (size_t i = 0; i < COUNT(parts); i++)
            if (*digits == parts[i].name) {
                struct buffer part OWNED(buffer_free) = file_of(parts[i].digits);
                buffer_append(&b, part.data, part.size);
            }
    }
    return b;
}

static bool says(const char *digits, const char *what)
{
    struct buffer b = file_of(digits);
    struct image got OWNED(image_free) = { 0 };
    struct failure f = { "" };
    const bool ok = jpeg_decode(b.data, b.size, &got, &f);
    const bool as_expected = what == NULL ? ok : !ok && strcmp(f.text, what) == 0;
    if (!as_expected)
        printf("    %s: %s, not %s\n", digits, ok ? "drawn" : f.text, what != NULL ? what : "drawn");
    buffer_free(&b);
    return as_expected;
}

static void test_jpeg_names_what_it_does_not_read(void)
{
    static const char only[] = "where baseline and progressive JPEG with Huffman codes is read";
    static const struct { const char *digits, *coding; } codings[] = {
        { "c3", "lossless" }, { "c5", "hierarchical" }, { "c6", "hierarchical" }, { "c7", "hierarchical" }, { "c9", "arithmetic" },
        { "ca", "arithmetic" }, { "cb", "arithmetic" }, { "cd", "arithmetic" }, { "ce", "arithmetic" }, { "cf", "arithmetic" },
    };
    for (size_t i = 0; i < COUNT(codings); i++) {
        char digits[60], what[200];
        snprintf(digits, sizeof digits, "ffd8Qff%s000b080008000801011100HS3f", codings[i].digits);
        snprintf(what, sizeof what, "%s coding, %s (0x%02lX)", codings[i].coding, only, strtoul(codings[i].digits, NULL, 16));
        CHECK(says(digits, what));
    }
    CHECK(says("ffd8QHGS3fffd9", NULL));
    CHECK(says("ffd8Qffc1000b0c0008000801011100", "12 bits per sample, where 8 are read"));
    CHECK(says("ffd8Qffc00014080008000804011100021100031100041100", "CMYK or YCCK colours, where grey, YCbCr and RGB are read"));
    CHECK(says("ffd8Qffc0000e080008000802011100021100", "2 components, where 1 and 3 are read"));
    CHECK(says("ffd8Qffc0000b080000000801011100", "the height comes behind the picture (DNL), which is not read"));
    CHECK(says("ffd8QHGS3fffdc00040008ffd9", "the height comes behind the picture (DNL), which is not read"));
}

static void test_jpeg_refuses_what_no_file_can_mean(void)
{
    static const struct { const char *digits, *what; } cases[] = {
        { "", "not a JPEG file (first bytes)" },
        { "ffd9", "not a JPEG file (first bytes)" },
        { "ffd8", "file ends early (no frame)" },
        { "ffd8ffd9", "the JPEG file has no picture" },
        { "ffd8ffd8", "file is damaged (it begins twice)" },
        { "ffd8ffe00001", "file is damaged (segment 0xE0 is too short)" },
        { "ffd8ffe0000a00", "file ends early (in segment 0xE0)" },
        { "ffd8QHS3fffd9", "file is damaged (a scan before the frame)" },
        { "ffd8QHGGS3fffd9", "file is damaged (two frames)" },
        { "ffd8QHGS3fS3fffd9", "file is damaged (two scans of component 1)" },
        { "ffd8QHGffd9", "file is damaged (component 1 has no scan)" },
        { "ffd8QHGfffe0002", "file ends early (scans of component 1 are missing)" },
        { "ffd8QGS3fffd9", "a Huffman table is missing (scan 1)" },
        { "ffd8HGS3fffd9", "quantisation table 0 is missing (scan 1)" },
        { "ffd8QHGS", "file ends early (in scan 1)" },
        { "ffd8QHGSffd9", "coded data ends early (scan 1, row 0 of MCUs)" },
        { "ffd8QHGSbf0000ffd9", "coded data is damaged (scan 1, row 0 of MCUs)" },
        { "ffd8QHffc0000b080008000801015100S3f", "file is damaged (sampling 5 x 1)" },
        { "ffd8QHffc0000b080008000801011000S3f", "file is damaged (sampling 1 x 0)" },
        { "ffd8QHffc0000b080008000801011104S3f", "file is damaged (quantisation table 4)" },
        { "ffd8QHffc00011080008000803011100011100021100", "file is damaged (two components 1)" },
        { "ffd8QHffc0000a0800080008010111", "file is damaged (segment 0xC0 is too short)" },
        { "ffd8QHGffda000802010000023f00", "file is damaged (segment 0xDA is too short)" },
        { "ffd8QHGffda000600003f00", "file is damaged (scan 1 has 0 components)" },
        { "ffd8QHGffda0008010200003f003f", "file is damaged (component 2 of scan 1)" },
        { "ffd8ffdb000314", "file is damaged (quantisation table 0x14)" },
        { "ffd8ffdb00040001", "file is damaged (segment 0xDB is too short)" },
        { "ffd8ffc4000320", "file is damaged (Huffman table 0x20)" },
        { "ffd8ffc4001600030000000000000000000000000000000000010203", "file is damaged (Huffman table 0x00 has too many codes)" },
        { "ffd8ffc40013000100000000000000000000000000000000", "file is damaged (segment 0xC4 is too short)" },
        { "ffd8ffdd000300", "file is damaged (segment 0xDD is too short)" },
        { "ffd8Qffc0000b080000000001011100", "the height comes behind the picture (DNL), which is not read" },
        { "ffd8Qffc0000b080008000001011100", "picture size is outside 1..16384 (0 x 8)" },
        { "ffd8Qffc0000b08ffffffff01011100", "picture size is outside 1..16384 (65535 x 65535)" },
        { "ffd8Qffc0000b084000400101011100", "picture size is outside 1..16384 (16385 x 16384)" },
        { "ffd8Qffc0000b082000400001011100HS3f", "picture has more than 16777216 pixels (16384 x 8192)" },
        { "ffd8Qffc0000b081000100001011100HS3f", "file is too small for its picture size (4096 x 4096)" },
        { "ffd8Qffc2000b081000100001011100HS3f", "file is too small for its picture size (4096 x 4096)" },
        /* Progressive scans that come twice, leave bits out, or have none. */
        { "ffd8QHPffda000801010000000000ffda000801010000000000ffd9", "file is damaged (scan 2 has bits 0 to 0)" },
        { "ffd8QHPffda000801010000020000ffd9", "file is damaged (scan 1 has coefficients 0 to 2)" },
        { "ffd8QHPffda000801010002010000ffd9", "file is damaged (scan 1 has coefficients 2 to 1)" },
        { "ffd8QHPffda000801010001400000ffd9", "file is damaged (scan 1 has coefficients 1 to 64)" },
        { "ffd8QHPffda000801010000000e00ffd9", "file is damaged (scan 1 has bits 14 to 0)" },
        { "ffd8QHPffda0008010100000020ffd9", "file is damaged (scan 1 has bits 0 to 2)" },
        { "ffd8QHPffda000801010000000000ffda000801010000003100ffd9", "file is damaged (scan 2 has bits 1 to 3)" },
    };
    for (size_t i = 0; i < COUNT(cases); i++)
        CHECK(says(cases[i].digits, cases[i].what));
}

/* Another scan of 900 blocks: in each nothing comes of coefficient k, but for what `bits` say. It takes 36 bytes. */
static void add_scan(struct buffer *b, int k, unsigned bits)
{
    struct buffer scan OWNED(buffer_free) = file_of("ffc40014 10 01000000000000000000000000000000 90 ffda0008010100000000 613f");
    scan.data[scan.size - 5] = scan.data[scan.size - 4] = (uint8_t)k;
    scan.data[scan.size - 3] = (uint8_t)bits;
    buffer_append(b, scan.data, scan.size);
}

static void test_jpeg_bounds_the_scans_of_a_picture(void)
{
    struct buffer b OWNED(buffer_free) = file_of("ffd8QHffc2000b0800081c2001011100 ffda0008010100000000");
    for (int n = 0; n < 2; n++) {
        struct failure f = { "" };
        struct image got;
        if (n == 0)
            for (int i = 0; i < 113; i++)
                buffer_byte(&b, 0);             /* the means, a bit each */
        for (int k = 1; k <= 23 && n == 0; k++)
            add_scan(&b, k, 1);
        if (n == 1)
            add_scan(&b, 1, 0x10);
        const bool ok = jpeg_decode(b.data, b.size, &got, &f);
        CHECK(n == 0 ? !ok && strstr(f.text, "file ends early") != NULL : !ok && strstr(f.text, "more than 24 scans") != NULL);
        buffer_append(&b, n == 0 ? "" : "\xff\xd9", n == 0 ? 0 : 2);
    }
}

#include "build/suites/jpeg.h"
