/* SPDX-License-Identifier: MIT */
/* orbit.c - a crate that turns, seen from a camera that goes around it. Writes the last frame as a PPM. C99, C++11. */
#include <smear.h>
#include <smear_math.h>
#include <stdio.h>

enum { WIDTH = 160, HEIGHT = 120, TRIANGLES = 64, DRAWS = 4, R = 1024, T = 32767, LAST = 23 };
/* Four corners and two triangles on each side of a cube, counter-clockwise seen from outside. */
static const int16_t corner[] = {
    -R, -R, R,  R, -R, R,  R, R, R,  -R, R, R,    R, -R, -R,  -R, -R, -R,  -R, R, -R,  R, R, -R,
    R, -R, R,  R, -R, -R,  R, R, -R,  R, R, R,    -R, -R, -R,  -R, -R, R,  -R, R, R,  -R, R, -R,
    -R, R, R,  R, R, R,  R, R, -R,  -R, R, -R,    -R, -R, -R,  R, -R, -R,  R, -R, R,  -R, -R, R };
static const int16_t corner_uv[] = {
    0, T, T, T, T, 0, 0, 0,  0, T, T, T, T, 0, 0, 0,  0, T, T, T, T, 0, 0, 0,
    0, T, T, T, T, 0, 0, 0,  0, T, T, T, T, 0, 0, 0,  0, T, T, T, T, 0, 0, 0 };
static const uint16_t side[] = {
    0, 1, 2, 0, 2, 3,  4, 5, 6, 4, 6, 7,  8, 9, 10, 8, 10, 11,
    12, 13, 14, 12, 14, 15,  16, 17, 18, 16, 18, 19,  20, 21, 22, 20, 22, 23 };
static uint16_t planks[32 * 32];
static const smear_mesh crate = { corner, 0, corner_uv, 0, 0, side, 12, 24, 10, 0, 0, { 0, 0, 0 }, { 0 } };
static const smear_texture texture = { planks, 0, 32, 32, SMEAR_TEXEL_565, SMEAR_CLAMP, SMEAR_CLAMP, 0 };
static const smear_material wood = { &texture, { 0 }, SMEAR_OPAQUE, 0, 0, 0, 0, 0, 0 };
static uint64_t memory[SMEAR_MEMORY(WIDTH, HEIGHT, TRIANGLES, DRAWS)];

static int flush(void *frame, const smear_band *band)   /* takes finished rows, top to bottom: 0x00RRGGBB */
{
    const uint32_t *pixel = (const uint32_t *)band->pixels, *end = pixel + band->size / 4;
    for (; *(const int *)frame == LAST && pixel < end; pixel++)
        printf("%c%c%c", (int)(*pixel >> 16), (int)(*pixel >> 8 & 255), (int)(*pixel & 255));
    return 0;
}

int main(void)
{
    int frame = 0;
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(40), SMEAR_Q16(0.5), 0);
    static smear_desc desc;             /* static: what is not set is 0, the default */
    static smear_frame view;
    static smear_draw draw;
    for (int i = 0; i < 32 * 32; i++)   /* two tones of wood with dark gaps, red on top of green and blue */
        planks[i] = i / 32 % 8 == 0 || i % 32 % 31 == 0 ? 0x4186 : i / 256 % 2 ? 0xcc88 : 0xb405;
    desc.width = WIDTH, desc.height = HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = DRAWS;
    desc.flush = flush, desc.user = &frame;
    view.camera = &camera, view.clear = 0x203040;
    draw.id = 1, draw.mesh = &crate, draw.material = &wood;
    int error = smear_init(&ctx, &desc, memory, sizeof memory);
    printf("P6 %d %d 255\n", desc.width, desc.height);
    for (; frame <= LAST; frame++) {
        const uint32_t angle = (uint32_t)frame * SMEAR_TURNS(1.0 / 30);
        const smear_vec3 eye = smear_apply(smear_rotate_y(0u - angle / 2), smear_vec(0, SMEAR_Q16(2.5), SMEAR_Q16(5)));
        const smear_transform pose = smear_rotate_y(angle);
        camera.pose = smear_look_at(eye, smear_vec(0, 0, 0), smear_vec(0, 1, 0));
        draw.now = &pose;
        error = error || smear_begin(ctx, &view) || smear_submit(ctx, &draw) || smear_render(ctx);
    }
    return error;
}
