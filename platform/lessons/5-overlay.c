/* SPDX-License-Identifier: MIT */
/* 5-overlay.c - a ring of light that spins and throws sparks, under a speedometer.
 *
 * What is new: lines in the world, which are draws; sparks, which leave streaks; and over all of it, sharp, text, a sprite that
 * turns and a needle. */
#include "panel.h"

#include <smear_overlay.h>
#include <smear_ribbon.h>

enum { EDGES = 12, SPARKS = 60, ITEMS = 4, TRIANGLES = 2 * EDGES, DRAWS = 1 };

static uint64_t memory[SMEAR_MEMORY(PANEL_WIDTH, PANEL_HEIGHT, TRIANGLES, DRAWS)];
static smear_segment edge[EDGES];
static int16_t position[SMEAR_RIBBON_POSITIONS(EDGES)];
static uint16_t index[SMEAR_RIBBON_INDICES(EDGES)];
static smear_point spark[SPARKS];
static const uint8_t star_pixels[] = { 0x10, 0x10, 0x38, 0xfe, 0x7c, 0x38, 0x6c, 0x44 };
static const smear_image star = { star_pixels, NULL, 7, 8, 1, SMEAR_IMAGE_MASK1 };
static const smear_points points = { spark, SPARKS };
static smear_overlay_item item[ITEMS];
static const smear_overlay overlay = { item, ITEMS, &points };
static smear_ribbon ring;
static smear_desc desc;
static smear_material glow;
static smear_frame frame;

static void move_all(int n)
{
    const smear_transform pose = smear_compose(smear_rotate_z(SMEAR_DEGREES(20)), smear_rotate_x((uint32_t)n * SMEAR_DEGREES(7)));
    for (int i = 0; i < EDGES; i++)
        for (int k = 0; k < 2; k++) {           /* the ends of an edge, on a circle with a radius of a metre */
            const uint32_t angle = (uint32_t)(i + k) * SMEAR_TURNS(1.0 / EDGES);
            const smear_vec3 p = smear_apply(pose, smear_vec(smear_cos(angle) >> 8, smear_sin(angle) >> 8, 0));      /* q24 to q16 */
            const int32_t at[3] = { p.x, p.y, p.z };
            for (int axis = 0; axis < 3; axis++)
                edge[i].before[k][axis] = n == 0 ? at[axis] : edge[i].now[k][axis], edge[i].now[k][axis] = at[axis];
        }
    for (int i = 0; i < SPARKS; i++) {          /* each lives 16 frames: flies off, and falls */
        const int age = (n + 5 * i) & 15;
        for (int axis = 0; axis < 3; axis++) {
            const int32_t way = age == 0 ? (i * (7919 + 104729 * axis) & 16383) - 8192 : spark[i].now[axis] - spark[i].before[axis];
            spark[i].before[axis] = age == 0 ? edge[i % EDGES].now[0][axis] : spark[i].now[axis];
            spark[i].now[axis] = spark[i].before[axis] + way - (axis == 1 ? 250 : 0);
        }
        spark[i].size = 3600, spark[i].fade = (uint8_t)(12 * age);
        spark[i].color[0] = 255, spark[i].color[1] = 200, spark[i].color[2] = 90;
    }
    item[2].turn = (uint16_t)(n * 1500), item[3].to_x = (int16_t)(smear_cos((uint32_t)(60 - n) * SMEAR_DEGREES(2)) >> 14);
    item[3].to_y = (int16_t)(-(smear_sin((uint32_t)(60 - n) * SMEAR_DEGREES(2)) >> 14));
}

int main(void)
{
    smear_context *ctx;
    smear_camera camera = smear_perspective(SMEAR_DEGREES(45), SMEAR_Q16(0.1), 0);
    desc.width = PANEL_WIDTH, desc.height = PANEL_HEIGHT, desc.max_triangles = TRIANGLES, desc.max_draws = DRAWS;
    desc.format = SMEAR_RGB565_SWAPPED, desc.flush = panel_flush;
    int result = smear_init(&ctx, &desc, memory, sizeof memory);
    camera.pose = smear_look_at(smear_vec(0, SMEAR_Q16(1.3), SMEAR_Q16(2.6)), smear_vec(0, SMEAR_Q16(-0.2), 0), smear_vec(0, 1, 0));
    ring.segment = edge, ring.count = EDGES, ring.position = position, ring.index = index, ring.width = SMEAR_Q16(0.06);
    ring.draw.material = &glow, glow.unlit = 1, glow.color[1] = 200, glow.color[2] = glow.color[3] = 255;
    item[0].x = 8, item[0].y = 8, item[0].text = "RING 12", item[0].font = &smear_font_8x8, item[0].scale = 2;
    item[1].x = 8, item[1].y = 28, item[1].width = 112, item[1].height = 2;      /* a box: neither text nor image nor shape */
    item[2].x = 210, item[2].y = 14, item[2].image = &star, item[2].shape = &smear_shape_turned, item[2].zoom = 4 * 256;
    item[3].x = 120, item[3].y = 230, item[3].shape = &smear_shape_line, item[3].width = 40;
    item[2].color[0] = item[3].color[0] = item[2].color[3] = item[3].color[3] = 255, item[2].color[1] = 220;
    frame.camera = &camera, frame.clear = 0x101828, frame.light_space = SMEAR_LIGHT_ENCODED, frame.overlay = &overlay;

    for (int n = 0; result == SMEAR_OK && panel_next(n); n++) {
        move_all(n);
        smear_ribbon_place(&ring, &camera, &camera);    /* where the camera is and was: it stands still */
        smear_begin(ctx, &frame);
        smear_submit(ctx, &ring.draw);
        result = smear_render(ctx);
    }
    return result != SMEAR_OK;
}
