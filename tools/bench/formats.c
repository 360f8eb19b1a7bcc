/* SPDX-License-Identifier: MIT */
/* formats.c - what displays of few greys show of frames, through a viewer's eye.
 *
 * Drawn are frames beside each other of two built-in scenes at 128x64 by SMEAR_AUTO, in codes; the truth is the mean of
 * many exact instants. Both are blurred by a Gaussian of 1.2 pixels, which is what an eye at arm's length makes of a panel
 * an inch wide. Error: root mean square difference in codes; as meant: from the truth with the contrast that the format
 * gives it, (c - 32) 4/3 for diffused bits. Detail: how far
 * what is seen less the same blurred once more goes with the truth's, 100 where always. Flicker: the error of how pictures
 * change from frame to frame. Last, of pixels
 * at which the truth is the same in both frames, those that are shown otherwise. */
#include "tools/bench/sheet.h"

#include "tools/player/device.h"
#include "tools/player/picture.h"
#include "tools/scenes/present.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 128, HEIGHT = 64, PIXELS = WIDTH * HEIGHT, FRAMES = 6, FIRST = 40, INSTANTS = 64, RADIUS = 4 };

static const double sigma = 1.2;

static const struct shown_as {
    const char *name;
    smear_format format;
    smear_dither dither;
} settings[] = {
    { "l8", SMEAR_L8, SMEAR_DITHER_NONE },
    { "l4 none", SMEAR_L4, SMEAR_DITHER_NONE }, { "l4 ordered", SMEAR_L4, SMEAR_DITHER_ORDERED },
    { "l4 blue", SMEAR_L4, SMEAR_DITHER_BLUE }, { "l4 diffuse", SMEAR_L4, SMEAR_DITHER_DIFFUSE },
    { "l1 none", SMEAR_L1, SMEAR_DITHER_NONE }, { "l1 ordered", SMEAR_L1, SMEAR_DITHER_ORDERED },
    { "l1 blue", SMEAR_L1, SMEAR_DITHER_BLUE }, { "l1 diffuse", SMEAR_L1, SMEAR_DITHER_DIFFUSE },
};
enum { SETTINGS = sizeof settings / sizeof *settings };

/* Frames of a scene: codes as they are, and as seen. */
struct film {
    double code[FRAMES][PIXELS], seen[FRAMES][PIXELS];
    double detail[FRAMES][PIXELS];      /* what is blurred once less what is blurred twice */
};

static int clamp(int v, int most)
{
    return v < 0 ? 0 : v > most ? most : v;
}

/* Along x, then along y; beyond its edges a picture goes on as it ends. */
static void blur(const double *in, double *out)
{
    double weight[2 * RADIUS + 1], all = 0.0;
    static double rows[PIXELS];
    for (int k = -RADIUS; k <= RADIUS; k++)
        all += weight[k + RADIUS] = exp(-k * k / (2.0 * sigma * sigma));
    for (int turn = 0; turn < 2; turn++) {
        const double *from = turn == 0 ? in : rows;
        double *to = turn == 0 ? rows : out;
        for (int i = 0; i < PIXELS; i++) {
            const int x = i % WIDTH, y = i / WIDTH;
            double sum = 0.0;
            for (int k = -RADIUS; k <= RADIUS; k++)
                sum += weight[k + RADIUS] * from[turn == 0 ? y * WIDTH + clamp(x + k, WIDTH - 1)
                                                           : clamp(y + k, HEIGHT - 1) * WIDTH + x];
            to[i] = sum / all;
        }
    }
}

static void see(struct film *film, int frame)
{
    static double wider[PIXELS];
    blur(film->code[frame], film->seen[frame]);
    blur(film->seen[frame], wider);
    for (int i = 0; i < PIXELS; i++)
        film->detail[frame][i] = film->seen[frame][i] - wider[i];
}

static void take_picture(const struct image *picture, struct film *film, int frame)
{
    for (int i = 0; i < PIXELS; i++) {
        const uint8_t *p = picture->rgba + 4 * i;
        film->code[frame][i] = 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    }
    see(film, frame);
}

/* ------------------------------------------------------------------ frames */

static bool draw_truth(struct presenter *presenter, const struct present_options *options, double fps, struct film *film,
                       struct failure *f)
{
    for (int i = 0; i < FRAMES; i++) {
        struct image picture;
        if (!presenter_exact(presenter, (FIRST + i) / fps, options, WIDTH, HEIGHT, INSTANTS, &picture, f))
            return false;
        take_picture(&picture, film, i);
        image_free(&picture);
    }
    return true;
}

static bool draw_frames(struct presenter *presenter, const struct present_options *options, double fps,
                        const struct shown_as *as, struct film *film, struct failure *f)
{
    const struct device_setup setup = { .width = WIDTH, .height = HEIGHT, .tile = 8, .format = as->format, .dither = as->dither,
                                        .methods = SMEAR_SET(SMEAR_AUTO), .threads = 1 };
    struct device device;
    struct image picture = { 0 };
    bool ok = device_open(&device, &setup, f) && image_alloc(&picture, WIDTH, HEIGHT, f);
    for (int i = 0; i < FRAMES && ok; i++) {
        const struct presented *frame = presenter_frame(presenter, (FIRST + i) / fps, options, f);
        ok = frame != NULL && device_fit(&device, frame, f) && device_draw(&device, frame, f);
        if (!ok)
            break;
        picture_expand(&picture, device.pixels, device.stride, as->format);
        take_picture(&picture, film, i);
    }
    image_free(&picture);
    device_close(&device);
    return ok;
}

/* ------------------------------------------------------------------ measures */

struct measures {
    double error, detail, flicker, changed;
};

static struct measures compare(const struct film *shown, const struct film *truth)
{
    struct measures m = { 0.0, 0.0, 0.0, 0.0 };
    double both = 0.0, own = 0.0, true_own = 0.0;
    long still = 0, changed = 0;
    for (int i = 0; i < FRAMES; i++)
        for (int k = 0; k < PIXELS; k++) {
            const double off = shown->seen[i][k] - truth->seen[i][k];
            const double a = shown->detail[i][k], b = truth->detail[i][k];
            m.error += off * off;
            both += a * b;
            own += a * a;
            true_own += b * b;
            if (i == 0)
                continue;
            const double before = shown->seen[i - 1][k] - truth->seen[i - 1][k];
            m.flicker += (off - before) * (off - before);
            if (truth->code[i][k] < truth->code[i - 1][k] || truth->code[i][k] > truth->code[i - 1][k])
                continue;
            still++;
            changed += shown->code[i][k] < shown->code[i - 1][k] || shown->code[i][k] > shown->code[i - 1][k];
        }
    m.error = sqrt(m.error / (FRAMES * PIXELS));
    m.detail = own > 0.0 ? 100.0 * both / sqrt(own * true_own) : 0.0;
    m.flicker = sqrt(m.flicker / ((FRAMES - 1) * PIXELS));
    m.changed = still > 0 ? 100.0 * (double)changed / (double)still : 0.0;
    return m;
}

/* The truth with the contrast of diffused bits. */
static void stretch(const struct film *truth, struct film *out)
{
    for (int i = 0; i < FRAMES; i++) {
        for (int k = 0; k < PIXELS; k++)
            out->code[i][k] = fmin(fmax((truth->code[i][k] - 32.0) * 4.0 / 3.0, 0.0), 255.0);
        see(out, i);
    }
}

static bool report_scene(const char *name, struct failure *f)
{
    static struct film truth, meant, shown;
    struct scene scene;
    if (!scene_builtin(name, &scene, f))
        return false;
    const struct present_options options = {
        .fps = scene.fps, .shutter_degrees = 180.0, .method = SMEAR_AUTO, .shutter_poses = true, .light = SMEAR_LIGHT_ENCODED,
        .clear = scene.clear
    };
    struct presenter *presenter = presenter_new(&scene, f);
    bool ok = presenter != NULL && draw_truth(presenter, &options, scene.fps, &truth, f);
    stretch(&truth, &meant);
    for (int i = 0; i < SETTINGS && ok; i++) {
        const struct shown_as *as = &settings[i];
        const bool stretched = as->format == SMEAR_L1 && as->dither == SMEAR_DITHER_DIFFUSE;
        ok = draw_frames(presenter, &options, scene.fps, as, &shown, f);
        if (!ok)
            break;
        const struct measures plain = compare(&shown, &truth), own = compare(&shown, stretched ? &meant : &truth);
        printf("%-12s %-12s %7.1f %9.1f %7.1f %8.1f %9.1f\n", i == 0 ? name : "", as->name, plain.error,
               own.error, own.detail, own.flicker, own.changed);
    }
    presenter_free(presenter);
    scene_free(&scene);
    return ok;
}

bool formats_report(struct sheet *sheet, struct failure *f)
{
    (void)sheet;
    printf("\nFew greys at 128x64 through an eye that blurs by %.1f px: codes, and %% of still pixels that change\n\n", sigma);
    printf("%-12s %-12s %7s %9s %7s %8s %9s\n", "scene", "format", "error", "as meant", "detail", "flicker", "changed %");
    return report_scene("demo/drone", f) && report_scene("demo/race", f);
}
