/* SPDX-License-Identifier: MIT */
/* compare.c - `smear compare`: how far two pictures are from each other. */
#include "tools/cli/commands.h"

#include "tools/image/file.h"
#include "tools/image/image.h"
#include "tools/options/apart.h"
#include "tools/options/arguments.h"
#include "tools/options/say.h"
#include "tools/options/sink.h"
#include "tools/player/picture.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct compare_options {
    const char *difference;
    long gain;
};

/* Differences are small; this much shows a code as a step one can see. */
enum { DEFAULT_GAIN = 8, MAX_PIXELS = 1 << 23 };

static const struct option table[] = {
    { "--diff", OPTION_TEXT, OPTION_AT(struct compare_options, difference) },
    { "--gain", OPTION_INTEGER, OPTION_AT(struct compare_options, gain), .low = 1, .high = 255 },
    { .name = NULL },
};

static bool load_pfm(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    struct float_image floats;
    if (!pfm_decode(bytes, size, &floats, f))
        return false;
    bool ok = picture_from_floats(&floats, out, f);
    float_image_free(&floats);
    return ok;
}

static int load(const char *path, struct image *out)
{
    struct failure f = { "" };
    uint8_t *bytes;
    size_t size;
    if (!file_keep(path, &f) || !image_read(path, &bytes, &size, &f))
        return say_bad_input(path, &f);
    bool is_pfm = size > 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f');
    bool is_pnm = size > 2 && bytes[0] == 'P' && bytes[1] >= '0' && bytes[1] <= '9';
    bool ok = is_pfm   ? load_pfm(bytes, size, out, &f)
            : is_pnm ? ppm_decode(bytes, size, out, &f)
                     : png_decode(bytes, size, out, &f);
    free(bytes);
    if (ok && out->width * out->height > MAX_PIXELS)
        ok = fail(&f, "picture has more than %d pixels (%d x %d), which takes too long", MAX_PIXELS, out->width, out->height);
    return ok ? STATUS_OK : say_bad_input(path, &f);
}

static int write_difference(const struct compare_options *o, struct sink *sink,
                            const struct image *a, const struct image *b)
{
    struct failure f = { "" };
    struct image difference;
    if (!image_difference(a, b, (int)o->gain, &difference, &f))
        return say_bad_input(o->difference, &f);
    bool ok = sink_add(sink, &difference, NULL, 0, &f);
    image_free(&difference);
    return ok ? STATUS_OK : say_bad_input(o->difference, &f);
}

static int compare(const struct compare_options *o, struct sink *sink, const char *second,
                   const struct image *a, const struct image *b)
{
    struct failure f = { "" };
    struct image_distance d;
    outputs_hold();
    if (!image_compare(a, b, IMAGE_PIXELS_PER_DEGREE, &d, &f))
        return say_bad_input(second, &f);
    if (o->difference != NULL) {
        int status = write_difference(o, sink, a, b);
        if (status != STATUS_OK)
            return status;
    }
    printf("rmse=%.6f\n", d.rmse);
    if (isinf(d.psnr))
        printf("psnr=inf\n");
    else
        printf("psnr=%.6f\n", d.psnr);
    printf("ssim=%.6f\nflip=%.6f\n", d.ssim, d.flip);
    if (!output_flush_standard(&f))
        return say_bad_input("standard output", &f);
    return outputs_publish(NULL, &f) ? STATUS_OK : say_bad_input(o->difference, &f);
}

int command_compare(int count, char **text)
{
    struct compare_options o = { .gain = DEFAULT_GAIN };
    struct sink sink = { .path = NULL };
    struct image image[2] = { { 0, 0, NULL }, { 0, 0, NULL } };
    const char *path[2];
    bool wants_help;
    int status = arguments_read(count, text, table, &o, path, 2, &wants_help);
    if (status == STATUS_OK && wants_help)
        return help_print("compare");
    if (status == STATUS_OK && path[1] == NULL)
        status = say_bad_usage("compare", "needs two pictures (smear help compare)");
    if (status == STATUS_OK && o.difference != NULL) {
        status = sink_open(&sink, "--diff", o.difference, 1, false);
        if (status == STATUS_OK && (sink.kind == SINK_GIF || sink.kind == SINK_APNG))
            status = say_bad_usage("--diff", "writes .png, .ppm or .pfm (\"%s\")", o.difference);
    }
    for (int i = 0; i < 2 && status == STATUS_OK; i++)
        status = load(path[i], &image[i]);
    if (status == STATUS_OK)
        status = apart_check_inputs(&(struct apart_output){ .path = o.difference }, 1);
    if (status == STATUS_OK)
        status = compare(&o, &sink, path[1], &image[0], &image[1]);
    outputs_drop();
    image_free(&image[0]);
    image_free(&image[1]);
    return status;
}

/* ------------------------------------------------------------------ bench and chart */

/* `smear bench` and `smear chart`: the program smear-bench, which is built with this one and lies beside it. It is one of its own
 * because it runs itself under callgrind and brings a second renderer to measure against. */

enum { PATH_LIMIT = 4096 };

/* Where this program is; where it is built, if nobody knows. */
static void path_beside(char out[PATH_LIMIT], const char *name)
{
    ssize_t length = readlink("/proc/self/exe", out, PATH_LIMIT - 1);
    out[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(out, '/');
    size_t folder = slash != NULL ? (size_t)(slash + 1 - out) : 0;
    if (folder == 0 || folder + strlen(name) >= PATH_LIMIT)
        snprintf(out, PATH_LIMIT, "build/%s", name);
    else
        memcpy(out + folder, name, strlen(name) + 1);
}

/* Returns only when that fails. */
static int hand_over(const char *command, const char *report, int count, char **text)
{
    char path[PATH_LIMIT];
    struct failure f = { "" };
    int n = 0;
    path_beside(path, "smear-bench");
    const char **argument = calloc((size_t)count + 3, sizeof *argument);
    if (argument == NULL) {
        fail(&f, "out of memory");
        return say_bad_input(command, &f);
    }
    argument[n++] = path;
    if (report != NULL)
        argument[n++] = report;
    for (int i = 0; i < count; i++)
        argument[n++] = text[i];
    /* execv takes pointers to char for history's sake and changes nothing. */
    char **plain = calloc((size_t)n + 1, sizeof *plain);
    if (plain != NULL) {
        memcpy(plain, argument, (size_t)n * sizeof *plain);
        execv(path, plain);
    }
    fail(&f, "cannot be run (%s); `make` builds it", strerror(errno));
    free(plain);
    free(argument);
    return say_bad_input(path, &f);
}

static bool asks_for_help(int count, char **text)
{
    return count > 0 && strcmp(text[0], "--help") == 0;
}

int command_bench(int count, char **text)
{
    if (asks_for_help(count, text))
        return help_print("bench");
    return hand_over("bench", NULL, count, text);
}

int command_chart(int count, char **text)
{
    if (asks_for_help(count, text))
        return help_print("chart");
    return hand_over("chart", "chart", count, text);
}
