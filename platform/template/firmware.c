/* SPDX-License-Identifier: MIT */
/* firmware.c - a firmware to start from: two bands, so that one is drawn while the other is sent; a
 * second core, if there is one; memory of a size known to the compiler. board.h is the board. */
#include "board.h"

#include <smear.h>

#ifndef BOARD_CORES
#define BOARD_CORES 1
#endif

enum { WIDTH = 240, HEIGHT = 240, TRIANGLES = 64, DRAWS = 4, FORMAT = SMEAR_RGB565_SWAPPED };

static uint64_t memory[SMEAR_MEMORY(WIDTH, HEIGHT, TRIANGLES, DRAWS, FORMAT) + SMEAR_MEMORY_BAND(WIDTH, HEIGHT, FORMAT)
                       + (BOARD_CORES - 1) * SMEAR_MEMORY_WORKER(WIDTH, HEIGHT)];

static struct {
    smear_context *ctx;
    unsigned waiting;               /* bands handed to flush and not sent, 0 to 2 */
    smear_band next;                /* with two: the one behind the one that is being sent */
} bus;

/* Queues the band. The library hands out no third before the first has been sent. */
static int flush(void *user, const smear_band *band)
{
    (void)user;
    board_clean_cache(band->pixels, band->size);
    uint32_t state = board_interrupts_off();
    if (bus.waiting++ == 0)
        board_send(band->pixels, band->size, band->y, band->height);
    else
        bus.next = *band;
    board_interrupts_restore(state);
    return 0;
}

void firmware_band_sent(void)
{
    smear_band_done(bus.ctx);
    if (--bus.waiting > 0)
        board_send(bus.next.pixels, bus.next.size, bus.next.y, bus.next.height);
}

static void idle(void *user)
{
    (void)user;
    board_idle();
}

/* The second core: between frames it waits in smear_work, too. */
#if BOARD_CORES > 1
static void work(void)
{
    for (;;)
        smear_work(bus.ctx, 1);
}
#endif

static const int16_t corner[] = {
    -1024, -1024, -1024,  1024, -1024, -1024,  1024, 1024, -1024,  -1024, 1024, -1024,
    -1024, -1024,  1024,  1024, -1024,  1024,  1024, 1024,  1024,  -1024, 1024,  1024
};
static const uint16_t side[] = {
    4, 5, 6,  4, 6, 7,  1, 0, 3,  1, 3, 2,  5, 1, 2,  5, 2, 6,
    0, 4, 7,  0, 7, 3,  7, 6, 2,  7, 2, 3,  0, 1, 5,  0, 5, 4
};
static const smear_mesh cube = { .position = corner, .vertex_count = 8, .index = side,
                                 .triangle_count = 12, .shift = 10 };
static const smear_material red = { .color = { 220, 60, 40, 255 } };

/* A cube flies to the right, again and again. */
static int draw(uint32_t number)
{
    static const smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 2 << 16,
                                         .near_plane = 1 << 15 };
    smear_transform pose = SMEAR_IDENTITY;
    int32_t step = (int32_t)(number % 32);
    const smear_frame frame = { .camera = &camera, .clear = 0x203040 };
    const smear_draw fly = { .id = 1, .mesh = &cube, .material = &red, .now = &pose,
                             .cut = step == 0 };
    pose.origin[0] = (step - 16) * 16384;
    pose.origin[2] = -6 * 65536;
    int result = smear_begin(bus.ctx, &frame);
    if (result == SMEAR_OK)
        result = smear_submit(bus.ctx, &fly);
    return result == SMEAR_OK ? smear_render(bus.ctx) : result;
}

int main(void)
{
    const smear_desc desc = { .width = WIDTH, .height = HEIGHT, .max_triangles = TRIANGLES, .max_draws = DRAWS,
                              .format = FORMAT, .bands = 2, .workers = BOARD_CORES, .flush = flush, .idle = idle };
    if (smear_init(&bus.ctx, &desc, memory, sizeof memory) != SMEAR_OK)
        return 1;
#if BOARD_CORES > 1
    board_start_core(work);
#endif
    for (uint32_t number = 0; board_next_frame(); number++)
        if (draw(number) != SMEAR_OK)
            return 1;
    return 0;
}
