/* SPDX-License-Identifier: MIT */
/* demo_player.c - see demo_player.h. */
#include "platform/demo_player.h"

#include "platform/display.h"
#include "platform/play.h"
#include "platform/words.h"

#define DAY 0xa9d6efu

/* Of displays that keep their picture and flip no pages: of sharp frames, too, only what changed is drawn. */
#define DEMO_KEPT (SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH | SMEAR_SET(SMEAR_NONE))

/* Triangle lists have room for every frame of the loop, also with places at three instants: nothing is drawn in parts. Of
 * what is 240 pixels wide "pico" is for one core; those with a width in their names have two strips or, where memory is short,
 * four for two cores.
 * Boards' displays have steps of 4 and 8 codes, and rounding to these errs by some 3 codes: blur aims at no less, SMEAR_DRAFT;
 * the slowest sketch. */
const struct demo_screen demo_screens[] = {
    { "oled", { .width = 128, .height = 64, .reach = 4, .format = SMEAR_L4, .bands = 2,
                .methods = SMEAR_SET(SMEAR_AUTO), .tile = 8, .strip = 64, .max_draws = DEMO_DRAWS,
                .max_triangles = 256, .vertex_cache = 32, .reuse = { .buffer_age = 1, .one_pose = 1 } },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, 0, "night", SMEAR_PATH_LINE, 0, SMEAR_DRAFT },
    { "gba", { .width = 120, .height = 80, .reach = 6, .format = SMEAR_RGB555, .bands = 1,
               .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH, .tile = 16, .max_draws = DEMO_DRAWS, .max_triangles = 300,
               .reuse.buffer_age = 2 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "small", SMEAR_PATH_CURVE, 32, SMEAR_SKETCH },
    { "gba-full", { .width = 240, .height = 160, .reach = 8, .format = SMEAR_RGB555, .bands = 1,
                    .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_NONE), .tile = 32, .max_draws = DEMO_DRAWS, .max_triangles = 310,
                    .reuse.buffer_age = 1 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "small", SMEAR_PATH_CURVE, 32, SMEAR_DRAFT },
    { "pico", { .width = 240, .height = 240, .reach = 12, .format = SMEAR_RGB565_SWAPPED, .bands = 2,
                .methods = DEMO_KEPT, .tile = 16, .strip = 240, .max_draws = DEMO_DRAWS,
                .max_triangles = 520, .reuse.buffer_age = 1 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "large", SMEAR_PATH_CURVE, 16, SMEAR_SKETCH },
    { "pico-240", { .width = 240, .height = 240, .reach = 12, .format = SMEAR_RGB565_SWAPPED, .bands = 2,
                    .methods = DEMO_KEPT, .tile = 16, .strip = 128, .max_draws = DEMO_DRAWS,
                    .max_triangles = 500, .reuse.buffer_age = 1 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "large", SMEAR_PATH_CURVE, 16, SMEAR_SKETCH },
    { "pico-320", { .width = 320, .height = 240, .reach = 8, .format = SMEAR_RGB565_SWAPPED, .bands = 2,
                    .methods = DEMO_KEPT, .tile = 16, .strip = 80, .max_draws = DEMO_DRAWS,
                    .max_triangles = 520, .reuse.buffer_age = 1 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "large", SMEAR_PATH_CURVE, 16, SMEAR_SKETCH },
    { "pico-128", { .width = 128, .height = 128, .reach = 6, .format = SMEAR_RGB565_SWAPPED, .bands = 2,
                    .methods = DEMO_KEPT, .tile = 16, .strip = 64, .max_draws = DEMO_DRAWS,
                    .max_triangles = 400, .reuse.buffer_age = 1 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "small", SMEAR_PATH_CURVE, 16, SMEAR_SKETCH },
    { "pi-640", { .width = 640, .height = 480, .reach = 24, .format = SMEAR_RGB565, .bands = 1,
                  .methods = SMEAR_SET(SMEAR_AUTO), .tile = 32, .strip = 640, .max_draws = DEMO_DRAWS,
                  .max_triangles = 530, .reuse.buffer_age = 2 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "large", SMEAR_PATH_CURVE, 0, SMEAR_DRAFT },
    { "pi-320", { .width = 320, .height = 240, .reach = 12, .format = SMEAR_RGB565, .bands = 1,
                  .methods = SMEAR_SET(SMEAR_AUTO), .tile = 32, .strip = 320, .max_draws = DEMO_DRAWS,
                  .max_triangles = 530, .reuse.buffer_age = 2 },
      SMEAR_AUTO, SMEAR_LIGHT_ENCODED, DAY, "large", SMEAR_PATH_CURVE, 0, SMEAR_DRAFT },
    { "linux", { .width = 640, .height = 480, .reach = 24, .format = SMEAR_XRGB8888, .bands = 1,
                 .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .max_draws = DEMO_DRAWS, .max_triangles = 530 },
      SMEAR_RECONSTRUCT, SMEAR_LIGHT_LINEAR, DAY, "large", SMEAR_PATH_CURVE, 0, 0 },
};

const int demo_screen_count = sizeof demo_screens / sizeof *demo_screens;

const struct demo_screen *demo_screen_find(const char *name)
{
    for (int i = 0; i < demo_screen_count; i++)
        if (is_word(demo_screens[i].name, name))
            return &demo_screens[i];
    return NULL;
}

const struct demo_blur demo_blurs[] = {
    { "none", SMEAR_NONE, 0 },
    { "accumulate-2", SMEAR_ACCUMULATE, 2 }, { "accumulate-4", SMEAR_ACCUMULATE, 4 },
    { "accumulate-8", SMEAR_ACCUMULATE, 8 }, { "accumulate-16", SMEAR_ACCUMULATE, 16 },
    { "reconstruct-4", SMEAR_RECONSTRUCT, 4 }, { "reconstruct-8", SMEAR_RECONSTRUCT, 8 },
    { "reconstruct-16", SMEAR_RECONSTRUCT, 16 },
    { "pingpong", SMEAR_PINGPONG, 0 }, { "object", SMEAR_OBJECT, 0 }, { "layered", SMEAR_LAYERED, 0 },
    { "subframes-4", SMEAR_SUBFRAMES, 4 }, { "subframes-8", SMEAR_SUBFRAMES, 8 },
    { "subframes-32", SMEAR_SUBFRAMES, 32 },
    { "timemask-8", SMEAR_TIMEMASK, 8 }, { "timemask-32", SMEAR_TIMEMASK, 32 },
    { "auto", SMEAR_AUTO, 0 }, { "auto-sketch", SMEAR_AUTO, SMEAR_SKETCH }, { "auto-draft", SMEAR_AUTO, SMEAR_DRAFT },
    { "auto-balanced", SMEAR_AUTO, SMEAR_BALANCED }, { "auto-fine", SMEAR_AUTO, SMEAR_FINE }
};

const int demo_blur_count = sizeof demo_blurs / sizeof *demo_blurs;

const struct demo_blur *demo_blur_find(const char *name)
{
    for (int i = 0; i < demo_blur_count; i++)
        if (is_word(demo_blurs[i].name, name))
            return &demo_blurs[i];
    return NULL;
}

void demo_blur_desc(const struct demo_blur *blur, const struct demo_screen *screen, smear_desc *desc)
{
    desc->methods = (uint16_t)(SMEAR_SET(blur->method)
                               | (blur->method == SMEAR_AUTO && blur->number >= SMEAR_DRAFT ? SMEAR_SET_SKETCH : 0u));
    if (smear_method_is_temporal(blur->method))
        return;
    /* Where pages flip, twice as much of a sharp frame is damaged, and nothing is saved. */
    if (blur->method != SMEAR_NONE || desc->reuse.buffer_age != 1)
        desc->reuse.buffer_age = 0;
    /* Sums of whole frames where small boards have the memory, else of bands. */
    if (blur->method == SMEAR_ACCUMULATE && desc->width * desc->height > 10000)
        desc->methods = SMEAR_SET_ACCUMULATE_BANDS;
    if (screen->sharp_tile != 0)
        desc->tile = blur->method == SMEAR_NONE         ? screen->sharp_tile
                   : blur->method != SMEAR_ACCUMULATE   ? 0
                   : desc->reach <= 8                   ? 8
                                                      : 16;
}

/* The props are the only frame of the tape that is called like the level. */
static const smear_draw *find_props(const char *level)
{
    for (int i = 0; i < tape_count; i++)
        if (is_word(tape_list[i]->name, level))
            return tape_list[i]->frame[0].draw;
    return NULL;
}

int demo_player_start(struct demo_player *player, const struct demo_screen *screen,
                      const smear_desc *desc, void *memory, size_t bytes)
{
    player->screen = screen;
    player->props = find_props(screen->level);
    player->shutter_degrees = 180;
    player->blur = NULL;
    player->fog = NULL;
    player->extras = NULL;
    if (player->props == NULL)
        return SMEAR_ERR_ARG;
    return smear_init(&player->ctx, desc, memory, bytes);
}

static int submit(struct demo_player *player, const smear_frame *how)
{
    int result = smear_begin(player->ctx, how);
    for (int i = 0; i < player->scene.draw_count && result == SMEAR_OK; i++) {
        const smear_draw draw = demo_scene_draw(&player->scene, player->props, i);
        result = smear_submit(player->ctx, &draw);
    }
    return result;
}

int demo_player_frame(struct demo_player *player, uint32_t frame, int draw)
{
    struct demo_scene *scene = &player->scene;
    demo_scene_pose(scene, frame);
    const struct demo_blur *blur = player->blur;
    smear_frame how = {
        .camera = &scene->camera, .cut = scene->cut, .clear = player->screen->sky,
        .method = player->shutter_degrees == 0 ? SMEAR_NONE : player->screen->method,
        .filter.flags = SMEAR_FENCE | SMEAR_CORNER,
        .light_space = player->screen->light, .target = player->screen->target, .fog = player->fog, .scene = player->extras,
        .shutter = { .degrees = player->shutter_degrees, .path = player->screen->path }
    };
    if (blur != NULL) {
        how.method = blur->method;
        how.samples = blur->method != SMEAR_AUTO ? blur->number : 0;
        if (blur->method == SMEAR_AUTO && blur->number != 0)
            how.target = blur->number;
    }
    int result = submit(player, &how);
    return result == SMEAR_OK && draw ? smear_render(player->ctx) : result;
}

int demo_player_obey(struct demo_player *player, struct demo_controls *controls, unsigned held)
{
    const unsigned pressed = held & ~controls->held;
    const uint16_t before = player->shutter_degrees;
    controls->held = held;
    if (pressed & KEY_A)
        player->shutter_degrees = player->shutter_degrees == 0 ? 180 : 0;
    if ((pressed & KEY_LEFT) && player->shutter_degrees > 90)
        player->shutter_degrees -= 90;
    if ((pressed & KEY_RIGHT) && player->shutter_degrees < 720)
        player->shutter_degrees += 90;
    if (pressed & KEY_START)
        controls->is_paused = !controls->is_paused;
    return player->shutter_degrees != before;
}

int demo_player_instant(struct demo_player *player, int32_t time)
{
    demo_scene_pose_at(&player->scene, time);
    const smear_frame how = {
        .camera = &player->scene.camera, .cut = 1, .clear = player->screen->sky, .method = SMEAR_NONE,
        .light_space = player->screen->light
    };
    int result = submit(player, &how);
    return result == SMEAR_OK ? smear_render(player->ctx) : result;
}
