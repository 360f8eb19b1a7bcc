/* SPDX-License-Identifier: MIT */
/* game_error.c - host program: how far frames of the recorded race are from the truth.
 *
 *     game_error [SCREEN [STEP [EXPOSED]]]      of every STEPth frame [50]: RMS in codes, and of all
 *
 * The picture is the screen's, as its panel has it: in its format, doubled pixels doubled. The truth has 256 sharp instants of
 * each pixel of the panel, in 24 bits, of the curve through the last poses. Nothing lies over either. */
#include "platform/game/lap.h"
#include "platform/game/screen.h"
#include "tests/target/panel.h"

#include <smear_methods.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { INSTANTS = 256 };

struct side {
    smear_context *ctx;
    smear_desc desc;
    struct view_way way;
    int width;
    uint8_t (*rgb)[3];
    const char *folder;
};

static int flush(void *user, const smear_band *band)
{
    const struct side *s = user;
    for (int y = 0; y < band->height; y++)
        for (int x = 0; x < band->width; x++) {
            const uint8_t *row = (const uint8_t *)band->pixels + (uint32_t)y * band->stride;
            const uint32_t color = panel_color(panel_code(row, x, s->desc.format), s->desc.format);
            for (int k = 0; k < 3; k++)
                s->rgb[(band->y + y) * s->width + band->x + x][k] = (uint8_t)(color >> (16 - 8 * k));
        }
    if (s->desc.bands == 2)
        smear_band_done(s->ctx);
    return 0;
}

static bool open_side(struct side *s)
{
    s->width = s->desc.width << (s->desc.display.doubled & SMEAR_DOUBLED_X);
    s->rgb = calloc((size_t)s->width * (size_t)(s->desc.height << (s->desc.display.doubled >> 1)), 3);
    s->desc.flush = flush;
    s->desc.user = s;
    const size_t size = smear_memory_size(&s->desc);
    const int result = size > 0 && s->rgb != NULL ? smear_init(&s->ctx, &s->desc, malloc(size), size) : SMEAR_ERR_ARG;
    if (result != SMEAR_OK)
        fprintf(stderr, "game_error: %s\n", smear_error_text(result));
    return result == SMEAR_OK;
}

static bool draw(struct side *s, const struct race *race, uint32_t frames)
{
    int result = view_submit(s->ctx, race, &s->desc, &s->way, frames);
    if (result == SMEAR_OK)
        result = smear_render(s->ctx);
    if (result != SMEAR_OK)
        fprintf(stderr, "game_error: %s\n", smear_error_text(result));
    return result == SMEAR_OK;
}

static void save(const struct side *s, const char *name, unsigned frame, int height)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s-%u.ppm", s->folder, name, frame);
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        return;
    fprintf(file, "P6\n%d %d\n255\n", s->width, height);
    fwrite(s->rgb, 3, (size_t)s->width * (size_t)height, file);
    fclose(file);
}

static double square_error(const struct side *a, const struct side *b, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            sum += (a->rgb[i][k] - b->rgb[i][k]) * (a->rgb[i][k] - b->rgb[i][k]);
    return sum / (3.0 * count);
}

int main(int argc, char **argv)
{
    const struct screen *screen = screen_find(argc > 1 ? argv[1] : "pico-240");
    const uint32_t step = argc > 2 ? (uint32_t)atoi(argv[2]) : 50;
    if (screen == NULL || step < screen->frames) {
        fprintf(stderr, "usage: game_error [SCREEN [STEP [FOLDER]]]: of every STEPth frame, and pictures into FOLDER\n");
        return 2;
    }
    struct side picture = { .desc = screen->desc, .way = screen->way, .folder = argc > 3 ? argv[3] : NULL };
    struct side truth = picture;
    const int x = screen->desc.display.doubled & SMEAR_DOUBLED_X, y = screen->desc.display.doubled >> 1;
    truth.desc = (smear_desc){ .width = (int16_t)(screen->desc.width << x), .height = (int16_t)(screen->desc.height << y),
                               .format = SMEAR_XRGB8888, .max_triangles = 4096, .max_draws = VIEW_DRAWS,
                               .methods = SMEAR_SET(SMEAR_ACCUMULATE) };
    truth.way = (struct view_way){ .method = SMEAR_ACCUMULATE, .samples = INSTANTS, .bare = 1 };
    picture.way.bare = 1;
    if (!open_side(&picture) || !open_side(&truth))
        return 1;
    struct race race;
    struct lap lap = { 0 };
    double sum = 0, worst = 0;
    int frames = 0;
    const int count = truth.desc.width * truth.desc.height;
    course_make(truth.desc.height);
    view_make();
    race_begin(&race);
    while (race.finished == 0) {
        for (uint32_t i = 0; i < screen->frames; i++)
            race_step(&race, lap_held(&lap), i == 0);
        /* As a sketch may depend on the frame before it, all are drawn. */
        const bool counts = race.frame % step < screen->frames && race.frame > RACE_START + 15;
        truth.way.samples = counts ? INSTANTS : 1;
        if (!draw(&picture, &race, screen->frames) || !draw(&truth, &race, screen->frames))
            return 1;
        if (!counts)
            continue;
        const double error = square_error(&picture, &truth, count);
        printf("%u: %.2f\n", (unsigned)race.frame, sqrt(error));
        if (argc > 3) {
            save(&picture, "picture", (unsigned)race.frame, truth.desc.height);
            save(&truth, "truth", (unsigned)race.frame, truth.desc.height);
        }
        sum += error;
        worst = fmax(worst, error);
        frames++;
    }
    printf("%d frames: %.2f codes, worst %.2f\n", frames, sqrt(sum / frames), sqrt(worst));
    return 0;
}
