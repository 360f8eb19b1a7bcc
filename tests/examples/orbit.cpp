// SPDX-License-Identifier: MIT
// orbit.cpp - orbit.c by smear.hpp: the same picture.
#include <smear.hpp>
#include <cstdio>

enum { WIDTH = 160, HEIGHT = 120, TRIANGLES = 64, DRAWS = 4, R = 1024, T = 32767, LAST = 23 };
// Four corners and two triangles on each side of a cube, counter-clockwise seen from outside.
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
static const smear_mesh crate = { corner, nullptr, corner_uv, nullptr, nullptr, side, 12, 24, 10, 0, 0, { 0, 0, 0 }, { 0 } };
static const smear_texture texture = { planks, nullptr, 32, 32, SMEAR_TEXEL_565, SMEAR_CLAMP, SMEAR_CLAMP, 0 };
static const smear_material wood = { &texture, { 0 }, SMEAR_OPAQUE, 0, 0, 0, 0, 0, 0 };
static smear::renderer<SMEAR_MEMORY(WIDTH, HEIGHT, TRIANGLES, DRAWS)> screen;

static int flush(void *frame, const smear_band *band)   // takes finished rows, top to bottom: 0x00RRGGBB
{
    const uint32_t *pixel = static_cast<const uint32_t *>(band->pixels), *end = pixel + band->size / 4;
    for (; *static_cast<const int *>(frame) == LAST && pixel < end; pixel++)
        std::printf("%c%c%c", int(*pixel >> 16), int(*pixel >> 8 & 255), int(*pixel & 255));
    return 0;
}

int main()
{
    for (int i = 0; i < 32 * 32; i++)   // two tones of wood with dark gaps, red on top of green and blue
        planks[i] = i / 32 % 8 == 0 || i % 32 % 31 == 0 ? 0x4186 : i / 256 % 2 ? 0xcc88 : 0xb405;
    int frame = 0;
    smear_desc desc = smear_desc();
    desc.width = WIDTH;
    desc.height = HEIGHT;
    desc.max_triangles = TRIANGLES;
    desc.max_draws = DRAWS;
    desc.flush = flush;
    desc.user = &frame;
    int error = screen.init(desc);
    std::printf("P6 %d %d 255\n", desc.width, desc.height);
    smear_camera camera = smear_perspective(SMEAR_DEGREES(40), SMEAR_Q16(0.5), 0);
    for (; frame <= LAST; frame++) {
        const uint32_t angle = uint32_t(frame) * SMEAR_TURNS(1.0 / 30);
        const smear_vec3 above = smear_vec(0, SMEAR_Q16(2.5), SMEAR_Q16(5));
        camera.pose = smear_look_at(smear_rotate_y(0u - angle / 2) * above, smear_vec(0, 0, 0), smear_vec(0, 1, 0));
        error = error || screen.begin(camera, 0x203040) || screen.submit(1, crate, &wood, smear_rotate_y(angle))
             || screen.render();
    }
    return error;
}
