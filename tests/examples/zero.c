/* SPDX-License-Identifier: MIT */
/* zero.c - a desc, frame, mesh, material and draw of zeros but for what is required work in every build of smear_config.h: what was
 * left out is not what zero means there. So do zeros of every method that was compiled in. Only the format is named where
 * SMEAR_XRGB8888 was left out. target_switches.sh builds it with every switch off; the library is given to it. */
#include <smear.h>
#include <smear_math.h>

#include <stdio.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 48, FRAMES = 3 };

static const smear_format format = SMEAR_WITH_RGB ? SMEAR_XRGB8888 : SMEAR_WITH_RGB565 ? SMEAR_RGB565 : SMEAR_L8;
static uint64_t memory[1 << 16];
static uint8_t shown[WIDTH * HEIGHT * 4];
static size_t size;

static int flush(void *user, const smear_band *band)
{
    (void)user;
    memcpy(shown + size, band->pixels, band->size);
    size += band->size;
    return 0;
}

static int fails(const char *what, int result)
{
    printf("%s: %s\n", what, smear_error_text(result));
    return 1;
}

/* Draws a triangle that goes by, by zeros and, but for 0, a method. Returns 0 where it is seen. */
static int draw(unsigned methods, int method)
{
    static const int16_t corner[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    static const uint16_t side[] = { 0, 1, 2 };
    smear_context *ctx;
    smear_desc desc = { 0 };
    smear_mesh mesh = { 0 };
    smear_material material = { 0 };
    smear_draw draw = { 0 };
    smear_frame frame = { 0 };
    smear_camera camera = smear_perspective(SMEAR_DEGREES(60), SMEAR_Q16(0.1), 0);
    desc.width = WIDTH, desc.height = HEIGHT, desc.flush = flush;
    desc.format = (uint8_t)format;
    desc.methods = (uint16_t)methods;
    if (methods == 0 && smear_memory_size(&desc) > 8 * SMEAR_MEMORY(WIDTH, HEIGHT, 0, 0, format))
        return fails("SMEAR_MEMORY is too little", SMEAR_OK);
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    if (result != SMEAR_OK)
        return fails("smear_init", result);
    mesh.position = corner, mesh.vertex_count = 3, mesh.index = side, mesh.triangle_count = 1;
    frame.camera = &camera;
    frame.method = (uint8_t)method;
    draw.id = 1, draw.mesh = &mesh, draw.material = &material;
    for (int n = 0; n < FRAMES; n++) {
        const smear_transform pose = smear_move((n - 1) * SMEAR_Q16(0.3), 0, -SMEAR_Q16(3));
        draw.now = &pose;
        size = 0;
        if ((result = smear_begin(ctx, &frame)) != SMEAR_OK)
            return fails("smear_begin", result);
        if ((result = smear_submit(ctx, &draw)) != SMEAR_OK)
            return fails("smear_submit", result);
        if ((result = smear_render(ctx)) != SMEAR_OK)
            return fails("smear_render", result);
    }
    const size_t pixel = size / (WIDTH * HEIGHT);
    if (memcmp(shown, shown + (HEIGHT / 2 * WIDTH + WIDTH * 2 / 3) * pixel, pixel) == 0)
        return fails("the triangle is not seen", SMEAR_OK);
    return 0;
}

int main(void)
{
    const unsigned compiled = SMEAR_SET(SMEAR_NONE) | (SMEAR_WITH_ACCUMULATE ? SMEAR_SET(SMEAR_ACCUMULATE) : 0u)
                            | (SMEAR_WITH_RECONSTRUCT ? SMEAR_SET(SMEAR_RECONSTRUCT) : 0u) | (SMEAR_WITH_FILTERS ? SMEAR_SET_FILTERS : 0u)
                            | (SMEAR_WITH_LAYERS ? SMEAR_SET_LAYERS : 0u) | (SMEAR_WITH_TIMEMASK ? SMEAR_SET(SMEAR_TIMEMASK) : 0u)
                            | (SMEAR_WITH_SUBFRAMES ? SMEAR_SET(SMEAR_SUBFRAMES) | SMEAR_SET(SMEAR_AUTO) : 0u);
    int methods = 0, failed = draw(0, 0);
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++)
        if ((compiled & SMEAR_SET(method)) != 0) {
            failed += draw(SMEAR_SET(method), method) + draw(SMEAR_SET(method), 0);
            methods++;
        }
    printf("zeros of %d methods: %d wrong\n", methods, failed);
    return failed != 0;
}
