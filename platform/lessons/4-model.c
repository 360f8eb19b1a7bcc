/* SPDX-License-Identifier: MIT */
/* 4-model.c - three birds of one model, each at its own moment of the clip.
 *
 * What is new: a model from a file, with its parts, colours and movements. `build/smear convert bird.gltf -o bird.h` makes the
 * header, which stays in flash; an actor plays a clip of it in one place, in a kilobyte of memory. */
#include "panel.h"

#include <smear_math.h>
#include "bird.h"

enum { BIRDS = 3, TRIANGLES = BIRDS * BIRD_TRIANGLES, DRAWS = BIRDS * BIRD_DRAWS };

static uint64_t memory[SMEAR_MEMORY(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, DRAWS)];
static uint64_t actor_memory[BIRDS][BIRD_ACTOR_BYTES(2) / 8];   /* two poses: now, and a frame ago for the blur */
static smear_actor *bird[BIRDS];
static smear_desc desc;
static smear_frame frame;
static smear_play play;

/* What a bird does in frame n: where in its clip it is, and where in the world. */
static int move_bird(int i, int n)
{
    static const int32_t aside[BIRDS] = { 0, SMEAR_Q16(-2.6), SMEAR_Q16(2.8) }, behind[BIRDS] = { 0, SMEAR_Q16(-2), SMEAR_Q16(-3) };
    smear_transform heading = smear_rotate_y(SMEAR_DEGREES(60));
    smear_transform place = smear_move(aside[i], i * SMEAR_Q16(0.4), behind[i] + (n - 20) * SMEAR_Q16(0.2));     /* 6 metres a second */
    place = smear_compose(heading, place);
    play.clip = BIRD_CLIP_FLY, play.loop = 1, play.place = &place;
    play.time = n * (65536 * 2 / 30) + i * 20000;       /* q16 seconds; twice as fast as it was made */
    return smear_actor_advance(bird[i], &play);
}

int main(void)
{
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(50), SMEAR_Q16(0.5), 0);
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = DRAWS;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    for (int i = 0; i < BIRDS && result == SMEAR_OK; i++)
        result = smear_actor_init(&bird[i], &bird_model, 2, actor_memory[i], sizeof actor_memory[i]);
    camera.pose = smear_look_at(smear_vec(0, SMEAR_Q16(2), SMEAR_Q16(8)), smear_vec(0, SMEAR_Q16(0.2), 0), smear_vec(0, 1, 0));
    frame.camera = &camera, frame.clear = 0x78a8d8, frame.light_space = SMEAR_LIGHT_ENCODED;

    for (int n = 0; result == SMEAR_OK && panel_next(n); n++) {
        smear_begin(ctx, &frame);
        for (int i = 0; i < BIRDS && result == SMEAR_OK; i++) {
            result = move_bird(i, n);
            if (result == SMEAR_OK)
                result = smear_actor_submit(bird[i], ctx);
        }
        if (result == SMEAR_OK)
            result = smear_render(ctx);
    }
    return result != SMEAR_OK;
}
