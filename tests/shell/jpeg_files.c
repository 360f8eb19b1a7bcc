/* SPDX-License-Identifier: MIT */
/* jpeg_files.c - what jpeg.sh holds against libjpeg's programs.
 *
 *     jpeg_files picture NUMBER FILE.ppm       a picture at random; prints options of cjpeg for it
 *     jpeg_files compare FILE.jpg FILE.ppm     the JPEG file as read here and by djpeg: 2 codes apart at most, in any channel
 *     jpeg_files png FILE.jpg FILE.png         what is read here */
#include "tests/random.h"

#include "tools/image/image.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 2 };

static int failed(const char *path, const struct failure *f)
{
    fprintf(stderr, "jpeg_files: %s: %s\n", path, f->text);
    return 1;
}

/* ---------------------------------------------------------------------- pictures */

static void choose_pixels(struct image *image)
{
    const int kind = between(0, 2), wave = between(2, 40), cell = between(2, 12);
    const int slope[6] = { between(-9, 9), between(-9, 9), between(-9, 9), between(-9, 9), between(-9, 9), between(-9, 9) };
    for (int i = 0; i < image->width * image->height * 4; i++) {
        const int x = i / 4 % image->width, y = i / 4 / image->width, k = i % 4;
        if (k == 3)
            continue;
        const int phase = (x * slope[k] + y * slope[k + 3]) * 32 / wave & 511;
        image->rgba[i] = kind == 0 ? (uint8_t)random_u32() : (uint8_t)(phase < 256 ? phase : 511 - phase);
        if (kind == 2)
            image->rgba[i] = (x / cell + y / (cell + k)) % 2 != 0 ? 255 : 0;
    }
}

/* Of libjpeg's choice: it packs what it can unpack, whole ratios, and up to ten blocks an MCU. */
static void say_options(const struct image *image)
{
    static const char *const samplings[] = {
        "1x1", "2x1", "1x2", "2x2", "4x1", "1x4", "4x2", "2x4", "3x1", "1x3", "3x2", "2x3", "2x2,1x2", "2x2,2x1", "2x2,1x1,2x2",
        "1x1,2x2,1x2", "4x2,1x1,1x1", "2x2,1x1,1x1", "1x2,1x1,1x1", "4x1,2x1,1x1", "1x4,1x2,1x1", "1x1,1x1,4x1",
    };
    const bool is_grey = chance(6), is_rgb = !is_grey && chance(6);
    printf("-quality %d -dct int", between(5, 100));
    if (is_grey)
        printf(" -grayscale");
    else
        printf(" -sample %s", samplings[between(0, (int)(sizeof samplings / sizeof *samplings) - 1)]);
    if (is_rgb)
        printf(" -rgb");
    if (chance(2))
        printf(" -progressive");
    if (chance(3))
        printf(" -optimize");
    if (chance(3))
        printf(" -restart %d%s", between(1, image->width), chance(2) ? "B" : "");
    printf("\n");
}

static int make_picture(unsigned number, const char *path)
{
    struct image image;
    struct failure f = { "" };
    random_state = number;
    const int largest = chance(2) ? 257 : 40, width = between(1, largest), height = between(1, largest);
    if (!image_alloc(&image, width, height, &f))
        return failed(path, &f);
    choose_pixels(&image);
    const bool ok = ppm_save(path, &image, &f);
    say_options(&image);
    image_free(&image);
    return ok ? 0 : failed(path, &f);
}

/* ---------------------------------------------------------------------- files */

static bool read_jpeg(const char *path, struct image *out, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    *out = (struct image){ 0 };
    if (!file_read(path, IMAGE_MAX_BYTES, &bytes, &size, f))
        return false;
    const bool ok = jpeg_decode(bytes, size, out, f);
    free(bytes);
    return ok;
}

static int compare(const char *path, const char *other)
{
    struct image ours, theirs;
    struct failure f = { "" };
    int most = 0;
    if (!read_jpeg(path, &ours, &f))
        return failed(path, &f);
    if (!image_load(other, &theirs, &f) || !image_check_same_size(&ours, &theirs, &f))
        return failed(other, &f);
    for (int i = 0; i < ours.width * ours.height * 4; i++) {
        const int difference = abs(ours.rgba[i] - theirs.rgba[i]);
        most = difference > most ? difference : most;
    }
    printf("%d x %d: %d codes at most\n", ours.width, ours.height, most);
    image_free(&ours);
    image_free(&theirs);
    return most > MOST;
}

static int write_png(const char *path, const char *to)
{
    struct image image;
    struct failure f = { "" };
    if (!read_jpeg(path, &image, &f))
        return failed(path, &f);
    const bool ok = png_save(to, &image, &f);
    image_free(&image);
    return ok ? 0 : failed(to, &f);
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "picture") == 0)
        return make_picture((unsigned)atoi(argv[2]), argv[3]);
    if (argc == 4 && strcmp(argv[1], "compare") == 0)
        return compare(argv[2], argv[3]);
    if (argc == 4 && strcmp(argv[1], "png") == 0)
        return write_png(argv[2], argv[3]);
    fprintf(stderr, "jpeg_files: see its head\n");
    return 2;
}
