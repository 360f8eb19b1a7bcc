/* SPDX-License-Identifier: MIT */
/* device_error.c - host program: how far the ways to blur of the demo are from the truth.
 *
 *     device_error blurs              the names of demo_player.c
 *     device_error SCREEN STEP        a line "BLUR RMS" for each, but `auto` as it is by default
 *
 * RMS over all pixels and frames of the loop, in 8-bit codes. The truth of a frame is the mean of
 * INSTANTS sharp frames at the exact poses of the exposure's instants, not at poses between two
 * frames, in the screen's own light. Frames are those that the target draws, before its display's
 * format rounds them: the library gives the same bits everywhere. Every STEPth frame of the loop
 * counts, as in `demo cost SCREEN BLUR STEP`. */
#include "platform/demo_player.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INSTANTS = 64, SHUTTER = DEMO_TIME / 2 };    /* 180 degrees */

struct picture {
    int width, height;
    uint32_t *pixel;
};

static int take_band(void *user, const smear_band *band)
{
    struct picture *p = user;
    for (int y = 0; y < band->height; y++)
        memcpy(p->pixel + (size_t)(band->y + y) * (size_t)p->width,
               (const uint8_t *)band->pixels + (size_t)y * band->stride, 4 * (size_t)p->width);
    return 0;
}

static void die(const char *what)
{
    fprintf(stderr, "device_error: %s\n", what);
    exit(1);
}

static void *take(size_t bytes)
{
    void *memory = calloc(1, bytes);
    if (memory == NULL)
        die("out of memory");
    return memory;
}

/* A player of the screen's frames as 8-bit codes; its memory is never given back. */
static void start(struct demo_player *player, const struct demo_screen *screen, const struct demo_blur *blur,
                  struct picture *picture)
{
    smear_desc desc = screen->desc;
    if (blur != NULL)
        demo_blur_desc(blur, screen, &desc);
    desc.format = SMEAR_XRGB8888;
    desc.reuse.buffer_age = 0;       /* whole frames */
    desc.bands = 1;
    desc.flush = take_band;
    desc.user = picture;
    size_t bytes = smear_memory_size(&desc);
    if (bytes == 0 || demo_player_start(player, screen, &desc, take(bytes), bytes) != SMEAR_OK)
        die("no context");
    player->blur = blur;
}

/* Sums of INSTANTS codes per channel of every frame. */
static uint16_t *find_truth(const struct demo_screen *screen, int step)
{
    static struct demo_player player;
    static const struct demo_blur sharp = { "none", SMEAR_NONE, 0 };
    size_t pixels = (size_t)screen->desc.width * (size_t)screen->desc.height;
    struct picture picture = { screen->desc.width, screen->desc.height, take(4 * pixels) };
    uint16_t *sums = take(sizeof *sums * DEMO_LOOP * 3 * pixels);
    start(&player, screen, &sharp, &picture);
    for (int frame = step / 2; frame < DEMO_LOOP; frame += step) {
        uint16_t *sum = sums + (size_t)frame * 3 * pixels;
        for (int k = 0; k < INSTANTS; k++) {
            int32_t time = frame * DEMO_TIME - SHUTTER / 2 + (2 * k + 1) * SHUTTER / (2 * INSTANTS);
            if (demo_player_instant(&player, time < 0 ? 0 : time) != SMEAR_OK)
                die("no instant");
            for (size_t i = 0; i < pixels; i++)
                for (int c = 0; c < 3; c++)
                    sum[3 * i + (size_t)c] = (uint16_t)(sum[3 * i + (size_t)c]
                                                        + (picture.pixel[i] >> (16 - 8 * c) & 255u));
        }
    }
    return sums;
}

static double error_of(const struct demo_screen *screen, const struct demo_blur *blur, const uint16_t *truth,
                       int step)
{
    static struct demo_player player;
    size_t pixels = (size_t)screen->desc.width * (size_t)screen->desc.height;
    struct picture picture = { screen->desc.width, screen->desc.height, take(4 * pixels) };
    double sum = 0;
    size_t count = 0;
    start(&player, screen, blur, &picture);
    for (int frame = 0; frame < DEMO_LOOP; frame++) {
        if (demo_player_frame(&player, (uint32_t)frame, frame % step == step / 2) != SMEAR_OK)
            die("no frame");
        const uint16_t *want = truth + (size_t)frame * 3 * pixels;
        for (size_t i = 0; i < pixels && frame % step == step / 2; i++)
            for (int c = 0; c < 3; c++, count++) {
                double off = (double)(picture.pixel[i] >> (16 - 8 * c) & 255u)
                           - want[3 * i + (size_t)c] / (double)INSTANTS;
                sum += off * off;
            }
    }
    free(picture.pixel);
    return sqrt(sum / (double)count);
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "blurs") == 0) {
        for (int i = 0; i < demo_blur_count; i++)
            printf("%s\n", demo_blurs[i].name);
        return 0;
    }
    const struct demo_screen *screen = argc == 3 ? demo_screen_find(argv[1]) : NULL;
    int step = screen != NULL ? atoi(argv[2]) : 0;
    if (step <= 0) {
        fprintf(stderr, "usage: device_error blurs | SCREEN STEP\n");
        return 2;
    }
    const uint16_t *truth = find_truth(screen, step);
    for (int i = 0; i < demo_blur_count; i++) {
        const struct demo_blur *blur = &demo_blurs[i];
        if (blur->method == SMEAR_AUTO && blur->number == 0)    /* that of a preset, by the display's format */
            continue;
        printf("%s %.3f\n", blur->name, error_of(screen, blur, truth, step));
    }
    return 0;
}
