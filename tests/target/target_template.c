/* SPDX-License-Identifier: MIT */
/* target_template.c - a board made of threads for platform/template: one is the DMA channel, which
 * reads a band a while after it was started and then interrupts; one is the second core. The
 * frames that arrive must be those of a plain use of the library: the same cube, one band, one core.
 * They are so only if bands stay as they were until they are sent, and come in order. */
#include "platform/template/board.h"

#include "tools/image/image.h"

#include <smear.h>

#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EDGE = 240, FRAMES = 40, ROW_BYTES = EDGE * 2 };

static struct {
    pthread_mutex_t mutex;          /* interrupts are off while it is held */
    pthread_cond_t started;
    const uint8_t *pixels;          /* being sent; null: nothing is */
    uint32_t bytes;
    int y;
    uint8_t panel[EDGE * ROW_BYTES];
    int rows, frames;               /* that have arrived */
    uint32_t crc[FRAMES];           /* of the frames */
    void (*core)(void);
} board = { .mutex = PTHREAD_MUTEX_INITIALIZER, .started = PTHREAD_COND_INITIALIZER };

/* ------------------------------------------------------------------ the board */

void board_send(const void *pixels, uint32_t bytes, int y, int height)
{
    if (board.pixels != NULL || bytes != (uint32_t)height * ROW_BYTES) {
        fprintf(stderr, "target_template: a band is sent while another is\n");
        exit(1);
    }
    board.pixels = pixels;
    board.bytes = bytes;
    board.y = y;
    pthread_cond_signal(&board.started);
}

/* Slower than drawing, so that the library runs into its own bands. */
static void *send_bands(void *nothing)
{
    for (;;) {
        pthread_mutex_lock(&board.mutex);
        while (board.pixels == NULL)
            pthread_cond_wait(&board.started, &board.mutex);
        const uint8_t *pixels = board.pixels;
        uint32_t bytes = board.bytes;
        uint8_t *to = board.panel + board.y * ROW_BYTES;
        if (board.y != board.rows % EDGE) {
            fprintf(stderr, "target_template: row %d comes after row %d\n", board.y, board.rows);
            exit(1);
        }
        pthread_mutex_unlock(&board.mutex);
        for (uint32_t at = 0; at < bytes; at += 512) {
            uint32_t count = bytes - at < 512 ? bytes - at : 512;
            sched_yield();
            memcpy(to + at, pixels + at, count);
        }
        pthread_mutex_lock(&board.mutex);
        board.pixels = NULL;
        board.rows += (int)(bytes / ROW_BYTES);
        if (board.rows % EDGE == 0)
            board.crc[board.frames++] = crc32_update(0, board.panel, sizeof board.panel);
        firmware_band_sent();
        pthread_mutex_unlock(&board.mutex);
    }
    return nothing;
}

void board_clean_cache(const void *bytes, uint32_t count)
{
    (void)bytes;
    (void)count;
}

uint32_t board_interrupts_off(void)
{
    pthread_mutex_lock(&board.mutex);
    return 0;
}

void board_interrupts_restore(uint32_t state)
{
    (void)state;
    pthread_mutex_unlock(&board.mutex);
}

static void *run_core(void *nothing)
{
    board.core();
    return nothing;
}

void board_start_core(void (*entry)(void))
{
    pthread_t thread;
    board.core = entry;
    if (pthread_create(&thread, NULL, run_core, NULL) != 0)
        exit(2);
}

void board_idle(void)
{
    sched_yield();
}

/* ------------------------------------------------------------------ the frames it should show */

/* The only other user of the library's bands here: takes them at once. */
struct plain {
    uint8_t picture[EDGE * ROW_BYTES];
    uint32_t crc[FRAMES];
};

static int take_band(void *user, const smear_band *band)
{
    struct plain *plain = user;
    memcpy(plain->picture + band->y * ROW_BYTES, band->pixels, band->size);
    return 0;
}

static int draw_plain(struct plain *plain)
{
    static const int16_t corner[] = {
        -1024, -1024, -1024, 1024, -1024, -1024, 1024, 1024, -1024, -1024, 1024, -1024,
        -1024, -1024, 1024,  1024, -1024, 1024,  1024, 1024, 1024,  -1024, 1024, 1024,
    };
    static const uint16_t side[] = {
        4, 5, 6, 4, 6, 7, 1, 0, 3, 1, 3, 2, 5, 1, 2, 5, 2, 6,
        0, 4, 7, 0, 7, 3, 7, 6, 2, 7, 2, 3, 0, 1, 5, 0, 5, 4,
    };
    static const smear_mesh cube = { .position = corner, .vertex_count = 8, .index = side,
                                     .triangle_count = 12, .shift = 10 };
    static const smear_material red = { .color = { 220, 60, 40, 255 } };
    static const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 2 << 16,
                                         .near_plane = 1 << 15 };
    const smear_desc desc = { .width = EDGE, .height = EDGE, .reach = 12, .tile = 16,
                              .format = SMEAR_RGB565_SWAPPED, .max_triangles = 64, .max_draws = 4,
                              .flush = take_band, .user = plain };
    size_t bytes = smear_memory_size(&desc);
    void *memory = malloc(bytes);
    smear_context *ctx;
    int result = memory != NULL ? smear_init(&ctx, &desc, memory, bytes) : SMEAR_ERR_MEMORY;
    for (int i = 0; i < FRAMES && result == SMEAR_OK; i++) {
        smear_transform pose = SMEAR_IDENTITY;
        pose.origin[0] = (i % 32 - 16) * 16384;
        pose.origin[2] = -6 * 65536;
        result = smear_begin(ctx, &(smear_frame){ .camera = &camera, .clear = 0x203040 });
        if (result == SMEAR_OK)
            result = smear_submit(ctx, &(smear_draw){ .id = 1, .mesh = &cube, .material = &red,
                                                      .now = &pose, .cut = i % 32 == 0 });
        if (result == SMEAR_OK)
            result = smear_render(ctx);
        plain->crc[i] = crc32_update(0, plain->picture, sizeof plain->picture);
    }
    free(memory);
    return result;
}

static int compare(void)
{
    static struct plain plain;
    int wrong = 0, distinct = 0;
    if (draw_plain(&plain) != SMEAR_OK)
        return 1;
    for (int i = 0; i < FRAMES; i++) {
        wrong += board.crc[i] != plain.crc[i];
        distinct += i > 0 && plain.crc[i] != plain.crc[i - 1];
    }
    printf("%d frames through two bands: %d wrong\n", FRAMES, wrong);
    return wrong != 0 || distinct < FRAMES / 2;
}

/* The first call starts the DMA channel; after the last frame the verdict is given. */
bool board_next_frame(void)
{
    static int wanted;
    static pthread_t channel;
    if (wanted == 0 && pthread_create(&channel, NULL, send_bands, NULL) != 0)
        exit(2);
    for (;;) {                      /* all that was drawn has arrived */
        pthread_mutex_lock(&board.mutex);
        bool is_there = board.frames == wanted;
        pthread_mutex_unlock(&board.mutex);
        if (is_there)
            break;
        sched_yield();
    }
    if (wanted == FRAMES)
        exit(compare());
    wanted++;
    return true;
}
