/* SPDX-License-Identifier: MIT */
/* A cube that flies past, blurred. Sends what a display would get to nowhere: fill in flush(). */
#include <smear.h>
#include <smear_memory.h>

/* 128x64 pixels, 32 triangles, 4 draws; the default method, tile, reach, strip, band_rows and bands. */
#define SCREEN 128, 64, 32, 4, 0, 0, 0, 0, 0, 0, SMEAR_RGB565_SWAPPED

static const int16_t corner[] = {
    -1024, -1024, -1024,  1024, -1024, -1024,  1024, 1024, -1024,  -1024, 1024, -1024,
    -1024, -1024,  1024,  1024, -1024,  1024,  1024, 1024,  1024,  -1024, 1024,  1024
};
static const uint16_t side[] = {
    4, 5, 6,  4, 6, 7,  1, 0, 3,  1, 3, 2,  5, 1, 2,  5, 2, 6,
    0, 4, 7,  0, 7, 3,  7, 6, 2,  7, 2, 3,  0, 1, 5,  0, 5, 4
};

static smear_mesh cube;
static smear_camera camera;
static smear_context *ctx;
static uint64_t memory[SMEAR_MEMORY_WORDS(SCREEN)];
static uint32_t bytes_seen;

/* Rows band->y .. band->y + band->height - 1 are finished: send band->size bytes to the display. */
static int flush(void *user, const smear_band *band)
{
    (void)user;
    bytes_seen += band->size;
    return 0;
}

void setup()
{
    smear_desc desc = SMEAR_DESC(SCREEN);
    desc.flush = flush;
    cube.position = corner;
    cube.vertex_count = 8;
    cube.index = side;
    cube.triangle_count = 12;
    cube.shift = 10;
    camera.pose.basis[0] = camera.pose.basis[4] = camera.pose.basis[8] = SMEAR_BASIS_ONE;
    camera.focal = 2L << 16;
    camera.near_plane = 1L << 15;
    smear_init(&ctx, &desc, memory, sizeof memory);
}

void loop()
{
    static int32_t x = -300000;
    smear_transform pose = SMEAR_IDENTITY;
    smear_frame frame = {};
    smear_draw draw = {};
    x = x > 300000 ? -300000 : x + 20000;
    pose.origin[0] = x;
    pose.origin[2] = -8 * 65536L;
    frame.camera = &camera;
    draw.id = 1;
    draw.mesh = &cube;
    draw.now = &pose;
    smear_begin(ctx, &frame);
    smear_submit(ctx, &draw);
    smear_render(ctx);
}
