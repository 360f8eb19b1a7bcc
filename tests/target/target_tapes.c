/* SPDX-License-Identifier: MIT */
/* target_tapes.c - host program that records the tapes which the programs for targets play.
 *
 *     target_tapes list                        draws the golden frames here, prints GOLDEN.txt
 *     target_tapes golden OUT.c GOLDEN.txt     the same frames as tapes, all within 256 kB of RAM
 *     target_tapes small OUT.c GOLDEN.txt      those which make do with 64 kB beside a stack, and little flash
 *     target_tapes bench OUT.c                 the peers' scenes at 320x240, whole and in bands
 *
 * A line of GOLDEN.txt is `TAPE FRAME CRC`, what follows is a comment. `list` draws without tapes,
 * so equal CRCs also mean that tapes lose nothing. A tape of which a frame is missing in GOLDEN.txt
 * is recorded without CRCs, and target_golden fails. */
#include "tools/player/picture.h"
#include "tools/scenes/present.h"
#include "tools/scenes/tape.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

struct spec {
    const char *name, *scene;
    int first, count, step;         /* frames at the scene's rate */
    smear_desc desc;                /* max_draws 0: as many as there are; methods 0: that of `present` */
    struct present_options present; /* fps, clear and a shutter of 0 degrees are filled in */
    bool has_large_textures;        /* not for small boards; */
    bool has_large_meshes;          /* neither: beside the others they would not fit the flash */
    bool user;                      /* bench: all as a user gets it who asks for nothing */
};

enum { DEFAULT_SHUTTER_DEGREES = 180, MAX_GOLDEN_BYTES = 1 << 20, SMALL_BYTES = 59 << 10 };

/* Opens and closes slowly; opens at once, and twice. */
static const uint8_t slow_shutter[SMEAR_SHUTTER_POINTS] = {
    0, 16, 32, 48, 64, 80, 96, 112, 128, 144, 160, 176, 192, 208, 224, 240, 255,
    240, 224, 208, 192, 176, 160, 144, 128, 112, 96, 80, 64, 48, 32, 16, 0
};
/* As two cameras do it. */
static const smear_layer plain_layer = { .mask = 255, .two_camera = 1 };

static const uint8_t twin_shutter[SMEAR_SHUTTER_POINTS] = {
    200, 200, 200, 200, 200, 200, 200, 120, 20, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255
};

/* Every method, output format, dither and light, all tile sizes, both pose models, kept poses, a
 * cut, a full triangle list; sizes that are no multiple of anything; one for 16 kB of RAM. Methods
 * that look at several instants: all settings, with and without the window, still and moving
 * cameras, textures, cutouts, blended draws, skins, the near plane, shutters of any form. Filters: velocity from depth,
 * passes, half size, other weights, streaks longer than a tile, scales, a fixed rate. Sharp
 * frames that are drawn as the display's pixels. */
static const struct spec golden[] = {
    { "none-xrgb", "peer/E", 0, 2, 1, { .width = 160, .height = 120, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .max_triangles = 600 },
      { .method = SMEAR_NONE } },
    { "sharp-565", "peer/B64", 3, 2, 1, { .width = 160, .height = 120, .format = SMEAR_RGB565, .band_rows = 24 },
      { .method = SMEAR_NONE } },
    { "few-565", "peer/F-lit", 2, 1, 1, { .width = 160, .height = 120, .format = SMEAR_RGB565, .band_rows = 24,
      .display.dither = SMEAR_DITHER_NONE, .max_triangles = 1200 },
      { .method = SMEAR_NONE, .light = SMEAR_LIGHT_ENCODED, .texels_565 = true }, .has_large_textures = true, .has_large_meshes = true },
    { "few-linear", "peer/F-lit", 4, 1, 1, { .width = 160, .height = 120, .max_triangles = 600 }, { .method = SMEAR_NONE },
      .has_large_textures = true, .has_large_meshes = true },
    { "accumulate-332", "peer/E", 2, 1, 1, { .width = 72, .height = 40, .format = SMEAR_RGB332, .band_rows = 8, .max_triangles = 200 },
      { .method = SMEAR_ACCUMULATE, .samples = 5 } },
    { "accumulate-poses", "demo/race", 7, 1, 1, { .width = 97, .height = 61 }, { .method = SMEAR_ACCUMULATE, .samples = 4,
      .shutter_poses = true } },
    { "reconstruct-565", "peer/E", 1, 2, 1, { .width = 160, .height = 120, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8,
      .format = SMEAR_RGB565, .max_triangles = 600 }, { .samples = 8, .reconstruct = SMEAR_PUBLISHED } },
    { "reconstruct-swapped", "peer/B64", 5, 2, 1, { .width = 128, .height = 128, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 12,
      .format = SMEAR_RGB565_SWAPPED, .display.dither = SMEAR_DITHER_BLUE }, { .samples = 6, .shutter_degrees = 270,
      .exposure = SMEAR_TRAILING } },
    { "reconstruct-555", "demo/race", 12, 2, 1, { .width = 96, .height = 60, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 6,
      .format = SMEAR_RGB555, .max_triangles = 500 }, { .shutter_poses = true,
      .reconstruct = SMEAR_FENCE | SMEAR_CORNER | SMEAR_PUBLISHED },
      .has_large_meshes = true },
    { "reconstruct-l8", "demo/drone", 4, 2, 1, { .width = 101, .height = 75, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 15,
      .tile = 32, .format = SMEAR_L8 }, { .samples = 12, .reconstruct = SMEAR_BOX | SMEAR_DIRECTION | SMEAR_PUBLISHED } },
    { "reconstruct-l4", "demo/race", 20, 2, 1, { .width = 128, .height = 64, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 5,
      .format = SMEAR_L4, .max_triangles = 400 }, { .light = SMEAR_LIGHT_ENCODED, .exposure = SMEAR_LEADING }, .has_large_meshes = true },
    { "reconstruct-l1", "demo/drone", 9, 2, 1, { .width = 133, .height = 65, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8,
      .format = SMEAR_L1 }, { .shutter_degrees = 360 } },
    { "reconstruct-pages", "peer/E", 6, 2, 1, { .width = 128, .height = 64, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 5,
      .format = SMEAR_L1_PAGES, .display.dither = SMEAR_DITHER_BLUE, .max_triangles = 400 }, { .shutter_degrees = 90 } },
    { "far-reach", "peer/B64", 2, 1, 1, { .width = 100, .height = 70, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 40, .tile = 64,
      .format = SMEAR_RGB565, .display.dither = SMEAR_DITHER_NONE }, { .shutter_degrees = 720, .samples = 16,
      .reconstruct = SMEAR_PUBLISHED } },
    { "kept", "demo/race", 30, 4, 1, { .width = 80, .height = 60, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8,
      .format = SMEAR_RGB565, .max_triangles = 700 }, { .keep_ids = true }, .has_large_meshes = true },
    { "full-list", "peer/E", 3, 1, 1, { .width = 96, .height = 96, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8,
      .format = SMEAR_RGB565, .max_triangles = 64 }, { .samples = 4 } },
    { "tiny", "peer/E", 5, 2, 1, { .width = 64, .height = 48, .format = SMEAR_L1_PAGES, .band_rows = 8, .vertex_cache = 16,
      .max_triangles = 64 }, { .method = SMEAR_NONE } },
    { "cut", "peer/E", 4, 1, 1, { .width = 64, .height = 48, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8,
      .format = SMEAR_RGB565, .max_triangles = 600 }, { .cut = true } },
    { "subframes-565", "suite/arena", 14, 2, 1, { .width = 96, .height = 72, .tile = 16, .format = SMEAR_RGB565,
      .max_triangles = 1200 }, { .method = SMEAR_SUBFRAMES } },
    { "subframes-leaves", "test/leaves", 6, 2, 1, { .width = 89, .height = 67, .tile = 8, .max_triangles = 500 },
      { .method = SMEAR_SUBFRAMES, .samples = 12, .light = SMEAR_LIGHT_ENCODED, .shutter_poses = true }, .has_large_textures = true },
    { "subframes-hills", "test/terrain", 3, 1, 1, { .width = 64, .height = 48, .tile = 32, .format = SMEAR_RGB565,
      .max_triangles = 2000, .vertex_cache = 64 }, { .method = SMEAR_SUBFRAMES, .samples = 300, .shutter_poses = true } },
    { "timemask-8", "peer/E", 2, 2, 1, { .width = 96, .height = 72, .tile = 8, .format = SMEAR_RGB565, .max_triangles = 520 },
      { .method = SMEAR_TIMEMASK, .samples = 8, .light = SMEAR_LIGHT_ENCODED } },
    { "timemask-16", "suite/propeller", 15, 2, 1, { .width = 72, .height = 72, .tile = 16, .format = SMEAR_RGB565_SWAPPED,
      .max_triangles = 900 }, { .method = SMEAR_TIMEMASK, .samples = 16, .shutter_poses = true } },
    { "timemask-32", "peer/B64", 4, 2, 1, { .width = 80, .height = 60, .tile = 32, .format = SMEAR_RGB555, .max_triangles = 1500 },
      { .method = SMEAR_TIMEMASK, .exposure = SMEAR_TRAILING } },
    { "timemask-skin", "suite/skin", 14, 1, 1, { .width = 64, .height = 64, .tile = 16, .format = SMEAR_L8, .max_triangles = 1400 },
      { .method = SMEAR_TIMEMASK, .samples = 32, .shutter_poses = true } },
    { "timemask-morph", "suite/morph", 14, 1, 1, { .width = 60, .height = 60, .tile = 64, .format = SMEAR_RGB332,
      .display.dither = SMEAR_DITHER_BLUE, .max_triangles = 1000 }, { .method = SMEAR_TIMEMASK, .samples = 16,
      .shutter = slow_shutter } },
    { "timemask-leaves", "test/leaves", 6, 1, 1, { .width = 64, .height = 48, .tile = 16, .format = SMEAR_RGB565,
      .max_triangles = 500 }, { .method = SMEAR_TIMEMASK, .shutter = twin_shutter }, .has_large_textures = true },
    { "auto-draft", "peer/B64", 7, 1, 1, { .width = 80, .height = 60, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT),
      .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1600 }, { .method = SMEAR_AUTO, .target = SMEAR_DRAFT,
      .shutter_degrees = 720 } },
    { "auto-balanced", "suite/cross", 14, 2, 1, { .width = 80, .height = 60,
      .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_AUTO, .shutter_poses = true } },
    { "auto-fine", "suite/arena", 14, 2, 1, { .width = 101, .height = 75,
      .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 15, .tile = 32, .format = SMEAR_RGB565, .bands = 1,
      .max_triangles = 1100 }, { .method = SMEAR_AUTO, .target = SMEAR_FINE, .light = SMEAR_LIGHT_ENCODED, .shutter_poses = true } },
    { "auto-drone", "demo/drone", 6, 2, 1, { .width = 128, .height = 64, .tile = 8, .format = SMEAR_L1_PAGES, .max_triangles = 2000 },
      { .method = SMEAR_AUTO, .light = SMEAR_LIGHT_ENCODED, .shutter_degrees = 360 } },
    { "auto-floor", "peer/N", 2, 3, 1, { .width = 96, .height = 72, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT),
      .reach = 12, .format = SMEAR_RGB565, .max_triangles = 160 }, { .method = SMEAR_AUTO, .shutter_poses = true } },
    { "auto-lorry", "suite/near", 14, 2, 2, { .width = 64, .height = 64, .tile = 16, .format = SMEAR_RGB565, .max_triangles = 1400 },
      { .method = SMEAR_AUTO, .target = SMEAR_FINE } },
    { "auto-pass", "fail/pass", 14, 2, 1, { .width = 64, .height = 48, .tile = 8, .format = SMEAR_RGB565, .max_triangles = 160 },
      { .method = SMEAR_AUTO, .target = SMEAR_FINE, .shutter_poses = true }, .has_large_textures = true },
    { "auto-ortho", "test/ortho", 2, 1, 1, { .width = 96, .height = 72,
      .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8, .format = SMEAR_L4, .max_triangles = 700 },
      { .method = SMEAR_AUTO, .exposure = SMEAR_LEADING, .shutter = slow_shutter } },
    { "auto-textured", "suite/textured", 15, 2, 1, { .width = 120, .height = 88,
      .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 16, .format = SMEAR_RGB565, .max_triangles = 200 },
      { .method = SMEAR_AUTO, .shutter_degrees = 360, .shutter_poses = true } },
    { "auto-roll", "suite/roll", 15, 1, 1, { .width = 48, .height = 48,
      .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8, .format = SMEAR_L1, .max_triangles = 2400 },
      { .method = SMEAR_AUTO, .target = SMEAR_DRAFT, .shutter_degrees = 360 } },
    { "auto-kept", "demo/drone", 24, 3, 1, { .width = 64, .height = 48,
      .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT), .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1800 },
      { .method = SMEAR_AUTO, .keep_ids = true } },
    { "auto-parts", "peer/B64", 7, 1, 1, { .width = 80, .height = 96, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT),
      .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1000 }, { .method = SMEAR_AUTO, .target = SMEAR_DRAFT,
      .shutter_degrees = 720 } },
    { "auto-pan", "suite/pan", 15, 1, 1, { .width = 160, .height = 90, .tile = 16, .format = SMEAR_RGB565, .max_triangles = 2700,
      .strip = 32 }, { .method = SMEAR_AUTO, .light = SMEAR_LIGHT_ENCODED, .shutter_degrees = 360 } },
    { "auto-rush", "suite/cross", 14, 2, 1, { .width = 120, .height = 72, .tile = 16, .max_triangles = 1500 }, { .method = SMEAR_AUTO,
      .shutter_degrees = 720 } },
    { "auto-tiny", "peer/E", 7, 2, 1, { .width = 7, .height = 5, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT),
      .tile = 8, .format = SMEAR_RGB565, .max_triangles = 560 }, { .method = SMEAR_AUTO } },
    { "auto-pixel", "peer/E", 7, 1, 1, { .width = 1, .height = 1, .tile = 8, .format = SMEAR_RGB565, .max_triangles = 560 },
      { .method = SMEAR_AUTO, .target = SMEAR_FINE } },
    { "auto-cut", "peer/E", 4, 1, 1, { .width = 64, .height = 48, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET(SMEAR_RECONSTRUCT),
      .reach = 8, .format = SMEAR_RGB565, .max_triangles = 600 }, { .method = SMEAR_AUTO, .cut = true } },
    { "sketch-race", "demo/race", 12, 2, 1, { .width = 75, .height = 50, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH,
      .reach = 8, .format = SMEAR_RGB565, .max_triangles = 400 }, { .method = SMEAR_AUTO, .target = SMEAR_SKETCH,
      .light = SMEAR_LIGHT_ENCODED } },
    { "sketch-roll", "suite/roll", 15, 1, 1, { .width = 61, .height = 49, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH,
      .reach = 20, .tile = 32, .max_triangles = 1400 }, { .method = SMEAR_AUTO, .target = SMEAR_SKETCH, .exposure = SMEAR_TRAILING },
      .has_large_meshes = true },
    { "sketch-parts", "suite/arena", 14, 1, 1, { .width = 97, .height = 61, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH,
      .reach = 5, .tile = 8, .format = SMEAR_RGB565_SWAPPED, .max_triangles = 250 }, { .method = SMEAR_AUTO, .target = SMEAR_SKETCH,
      .light = SMEAR_LIGHT_ENCODED, .shutter_poses = true }, .has_large_meshes = true },
    { "sketch-behind", "demo/race", 11, 2, 1, { .width = 96, .height = 72, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH,
      .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1500 }, { .method = SMEAR_AUTO, .target = SMEAR_SKETCH,
      .shutter_degrees = 1440 }, .has_large_meshes = true },
    { "draft-lines", "demo/race", 12, 3, 2, { .width = 75, .height = 50, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH,
      .reach = 8, .tile = 8, .format = SMEAR_RGB565, .max_triangles = 800 }, { .method = SMEAR_AUTO, .target = SMEAR_DRAFT } },
    { "draft-textured", "suite/textured", 14, 2, 1, { .width = 64, .height = 48, .methods = SMEAR_SET(SMEAR_AUTO) | SMEAR_SET_SKETCH,
      .reach = 8, .tile = 8, .max_triangles = 100 }, { .method = SMEAR_AUTO, .target = 5 * 64, .light = SMEAR_LIGHT_ENCODED } },
    { "camera-pan", "suite/pan", 14, 2, 1, { .width = 96, .height = 72, .reach = 12, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_CAMERA }, .has_large_meshes = true },
    { "camera-dolly", "suite/dolly", 14, 1, 1, { .width = 80, .height = 60, .reach = 16, .format = SMEAR_RGB565_SWAPPED,
      .max_triangles = 1200 }, { .method = SMEAR_CAMERA, .filter = SMEAR_FILTER_RECONSTRUCT, .camera_step = 4, .shutter_poses = true,
      .light = SMEAR_LIGHT_ENCODED }, .has_large_meshes = true },
    { "camera-roll", "suite/roll", 15, 1, 1, { .width = 61, .height = 49,
      .methods = SMEAR_SET(SMEAR_CAMERA) | SMEAR_SET(SMEAR_PINGPONG), .reach = 15, .tile = 32, .filter.passes = 2,
      .max_triangles = 1400 }, { .method = SMEAR_CAMERA, .filter = SMEAR_FILTER_PINGPONG, .camera_step = 2, .exposure = SMEAR_TRAILING,
      .pingpong = { .bias = 255 } }, .has_large_meshes = true },
    { "camera-race", "demo/race", 12, 1, 1, { .width = 75, .height = 50, .reach = 8, .format = SMEAR_RGB565, .max_triangles = 500 },
      { .method = SMEAR_CAMERA, .light = SMEAR_LIGHT_ENCODED, .exposure = SMEAR_TRAILING }, .has_large_meshes = true },
    { "depth-drone", "demo/drone", 6, 2, 1, { .width = 96, .height = 64, .reach = 9, .format = SMEAR_RGB565, .max_triangles = 1500 },
      { .method = SMEAR_RECONSTRUCT, .camera_step = 1, .exposure = SMEAR_LEADING }, .has_large_meshes = true },
    { "pingpong-race", "demo/race", 12, 2, 1, { .width = 96, .height = 60, .reach = 15, .format = SMEAR_RGB565, .filter.passes = 2,
      .max_triangles = 500 }, { .method = SMEAR_PINGPONG, .pingpong.bias = 4 } },
    { "pingpong-spread", "suite/cross", 14, 1, 1, { .width = 80, .height = 60, .reach = 24, .format = SMEAR_L8, .filter.passes = 3,
      .max_triangles = 1200 }, { .method = SMEAR_PINGPONG, .light = SMEAR_LIGHT_ENCODED, .shutter_degrees = 360,
      .pingpong = { .passes = 3, .taps = 4, .jitter = 32, .bias = 4, .spread = 1 } }, .has_large_meshes = true },
    { "pingpong-comb", "peer/E", 2, 1, 1, { .width = 72, .height = 40, .reach = 8, .format = SMEAR_RGB332, .filter.passes = 2,
      .max_triangles = 400 }, { .method = SMEAR_PINGPONG, .pingpong = { .taps = 7, .base = 4, .bias = 12 } },
      .has_large_meshes = true },
    { "half-arena", "suite/arena", 14, 2, 1, { .width = 97, .height = 73, .reach = 11, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_HALF, .reconstruct = SMEAR_FENCE }, .has_large_meshes = true },
    { "half-drone", "demo/drone", 9, 1, 1, { .width = 88, .height = 64, .methods = SMEAR_SET(SMEAR_HALF) | SMEAR_SET(SMEAR_PINGPONG),
      .reach = 24, .format = SMEAR_RGB565, .filter.passes = 2, .max_triangles = 1500 }, { .method = SMEAR_HALF,
      .filter = SMEAR_FILTER_PINGPONG, .camera_step = 1, .light = SMEAR_LIGHT_ENCODED, .pingpong.bias = 4 }, .has_large_meshes = true },
    { "mcguire", "suite/cross", 14, 1, 1, { .width = 72, .height = 54, .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_RECONSTRUCT, .reconstruct = SMEAR_PUBLISHED, .weights = SMEAR_WEIGHTS_MCGUIRE }, .has_large_meshes = true },
    { "guertin", "suite/cross", 14, 1, 1, { .width = 72, .height = 54, .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_RECONSTRUCT, .reconstruct = SMEAR_PUBLISHED, .weights = SMEAR_WEIGHTS_GUERTIN,
      .light = SMEAR_LIGHT_ENCODED }, .has_large_meshes = true },
    { "jimenez", "suite/arena", 14, 1, 1, { .width = 72, .height = 54, .reach = 16, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_RECONSTRUCT, .reconstruct = SMEAR_PUBLISHED, .weights = SMEAR_WEIGHTS_JIMENEZ, .samples = 12 },
      .has_large_meshes = true },
    { "scatter", "suite/long", 14, 1, 1, { .width = 80, .height = 64, .reach = 30, .tile = 8, .format = SMEAR_RGB565,
      .filter.scatter = 1, .max_triangles = 900 }, { .method = SMEAR_RECONSTRUCT, .shutter_degrees = 360 }, .has_large_meshes = true },
    { "fixed-rate", "peer/E", 6, 1, 1, { .width = 64, .height = 48, .reach = 12, .format = SMEAR_RGB565, .max_triangles = 600 },
      { .method = SMEAR_RECONSTRUCT, .shutter_mode = SMEAR_SHUTTER_FIXED, .frame_us = 6944 } },
    { "scales", "demo/drone", 24, 1, 1, { .width = 64, .height = 48, .reach = 12, .format = SMEAR_RGB565, .max_triangles = 1500 },
      { .method = SMEAR_RECONSTRUCT, .turn_scale = 600, .way_scale = 100, .object_scale = SMEAR_SCALE_NONE, .frame_us = 33333,
      .shutter_us = 12000 }, .has_large_meshes = true },
    { "direct-565", "peer/B64", 3, 2, 1, { .width = 160, .height = 120, .format = SMEAR_RGB565, .display.dither = SMEAR_DITHER_NONE,
      .band_rows = 16 }, { .method = SMEAR_NONE, .texels_565 = true }, .has_large_textures = true },
    { "direct-swapped", "peer/E", 3, 1, 1, { .width = 97, .height = 61, .format = SMEAR_RGB565_SWAPPED,
      .display.dither = SMEAR_DITHER_NONE, .band_rows = 8, .max_triangles = 600 }, { .method = SMEAR_NONE } },
    { "object-565", "suite/cross", 14, 2, 1, { .width = 80, .height = 60, .reach = 8, .format = SMEAR_RGB565, .max_triangles = 1200 },
      { .method = SMEAR_OBJECT, .shutter_poses = true }, .has_large_meshes = true },
    { "object-encoded", "suite/enter", 14, 2, 1, { .width = 97, .height = 61, .reach = 6, .tile = 8, .max_triangles = 1000 },
      { .method = SMEAR_OBJECT, .light = SMEAR_LIGHT_ENCODED, .shutter_degrees = 300 }, .has_large_meshes = true },
    { "object-parts", "suite/swarm", 14, 1, 1, { .width = 72, .height = 72, .reach = 12, .tile = 32, .format = SMEAR_RGB565_SWAPPED,
      .max_triangles = 1000 }, { .method = SMEAR_OBJECT, .shutter_poses = true }, .has_large_meshes = true },
    { "object-plain", "suite/translate", 14, 1, 1, { .width = 64, .height = 48, .reach = 8, .format = SMEAR_L4, .max_triangles = 800 },
      { .method = SMEAR_OBJECT, .samples = 4, .layer = &plain_layer, .layer_count = 1 }, .has_large_meshes = true },
    { "layered-565", "suite/propeller", 15, 2, 1, { .width = 72, .height = 72, .reach = 8, .format = SMEAR_RGB565,
      .max_triangles = 900 }, { .method = SMEAR_LAYERED, .shutter_poses = true }, .has_large_meshes = true },
    { "layered-encoded", "suite/arena", 14, 1, 1, { .width = 96, .height = 72, .reach = 20, .tile = 32, .format = SMEAR_RGB555,
      .max_triangles = 1200 }, { .method = SMEAR_LAYERED, .light = SMEAR_LIGHT_ENCODED, .samples = 6, .exposure = SMEAR_TRAILING },
      .has_large_meshes = true },
    { "layered-kept", "demo/drone", 24, 3, 1, { .width = 64, .height = 48, .reach = 8, .format = SMEAR_L8, .max_triangles = 1800 },
      { .method = SMEAR_LAYERED, .keep_ids = true }, .has_large_meshes = true },
    { "accumulate-bands", "peer/E", 2, 1, 1, { .width = 72, .height = 40, .methods = SMEAR_SET_ACCUMULATE_BANDS,
      .format = SMEAR_RGB332, .band_rows = 5, .max_triangles = 300 }, { .method = SMEAR_ACCUMULATE, .samples = 5 } },
    { "accumulate-leaves", "test/leaves", 6, 1, 1, { .width = 64, .height = 48, .methods = SMEAR_SET_ACCUMULATE_BANDS,
      .format = SMEAR_RGB565, .band_rows = 4, .max_triangles = 500 }, { .method = SMEAR_ACCUMULATE, .samples = 3,
      .light = SMEAR_LIGHT_ENCODED }, .has_large_textures = true },
    { "object-long", "suite/long", 14, 2, 1, { .width = 160, .height = 64, .reach = 14, .format = SMEAR_RGB565,
      .max_triangles = 1200 }, { .method = SMEAR_OBJECT, .light = SMEAR_LIGHT_ENCODED, .shutter_poses = true, .shutter_degrees = 360 },
      .has_large_meshes = true },
};

/* The peers' scenes as they were measured: 320x240, RGB565, frames 0, 2, 4, 6; four as a user gets them, too; and two blurred. */
static const struct spec bench[] = {
    { "A whole", "peer/A", 0, 4, 2, { .band_rows = 240, .max_triangles = 24000 }, { .method = SMEAR_NONE } },
    { "A bands", "peer/A", 0, 4, 2, { .band_rows = 16, .max_triangles = 24000 }, { .method = SMEAR_NONE } },
    { "B64 whole", "peer/B64", 0, 4, 2, { .band_rows = 240, .max_triangles = 1600 }, { .method = SMEAR_NONE } },
    { "B64 bands", "peer/B64", 0, 4, 2, { .band_rows = 16, .max_triangles = 1600 }, { .method = SMEAR_NONE } },
    { "B64 user", "peer/B64", 0, 4, 2, { .max_triangles = 1600 }, { .method = SMEAR_NONE }, .user = true },
    { "B256 whole", "peer/B256", 0, 4, 2, { .band_rows = 240, .max_triangles = 1600 }, { .method = SMEAR_NONE } },
    { "C whole", "peer/C", 0, 4, 2, { .band_rows = 240, .max_triangles = 64 }, { .method = SMEAR_NONE } },
    { "C bands", "peer/C", 0, 4, 2, { .band_rows = 16, .max_triangles = 64 }, { .method = SMEAR_NONE } },
    { "D whole", "peer/D", 0, 4, 2, { .band_rows = 240, .max_triangles = 52000 }, { .method = SMEAR_NONE } },
    { "D bands", "peer/D", 0, 4, 2, { .band_rows = 16, .max_triangles = 52000 }, { .method = SMEAR_NONE } },
    { "E whole", "peer/E", 0, 4, 2, { .band_rows = 240, .max_triangles = 1300 }, { .method = SMEAR_NONE } },
    { "E bands", "peer/E", 0, 4, 2, { .band_rows = 16, .max_triangles = 1300 }, { .method = SMEAR_NONE } },
    { "E user", "peer/E", 0, 4, 2, { .max_triangles = 1300 }, { .method = SMEAR_NONE }, .user = true },
    { "F whole", "peer/F", 0, 4, 2, { .band_rows = 240, .max_triangles = 12000 }, { .method = SMEAR_NONE } },
    { "F bands", "peer/F", 0, 4, 2, { .band_rows = 16, .max_triangles = 12000 }, { .method = SMEAR_NONE } },
    { "F user", "peer/F", 0, 4, 2, { .max_triangles = 12000 }, { .method = SMEAR_NONE }, .user = true },
    { "F-lit whole", "peer/F-lit", 0, 4, 2, { .band_rows = 240, .max_triangles = 12000 }, { .method = SMEAR_NONE } },
    { "F-lit bands", "peer/F-lit", 0, 4, 2, { .band_rows = 16, .max_triangles = 12000 }, { .method = SMEAR_NONE } },
    { "F-lit user", "peer/F-lit", 0, 4, 2, { .max_triangles = 12000 }, { .method = SMEAR_NONE }, .user = true },
    { "B64 blurred", "peer/B64", 0, 4, 2, { .reach = 12, .max_triangles = 1600 }, { .method = SMEAR_RECONSTRUCT, .samples = 8 } },
    { "E blurred", "peer/E", 0, 4, 2, { .reach = 12, .max_triangles = 1300 }, { .method = SMEAR_RECONSTRUCT, .samples = 8 } },
};

static void complete_golden(struct spec *spec)
{
    spec->desc.debug.crc = 1;
    if (spec->desc.methods == 0)
        spec->desc.methods = (uint16_t)SMEAR_SET(spec->present.method);
}

static void complete_bench(struct spec *spec)
{
    spec->desc.width = 320;
    spec->desc.height = 240;
    spec->desc.format = SMEAR_RGB565;
    spec->desc.methods = (uint16_t)SMEAR_SET(spec->present.method);
    if (spec->user)
        return;
    spec->present.texels_565 = spec->present.method == SMEAR_NONE;     /* as tools/bench/peers.c */
    spec->desc.display.dither = SMEAR_DITHER_NONE;
    spec->desc.vertex_cache = 4096;
    spec->present.light = SMEAR_LIGHT_ENCODED;
}

/* The CRC of a frame in the text of GOLDEN.txt; false when it has none. */
static bool find_crc(const char *text, const char *tape, int frame, uint32_t *crc)
{
    char wanted[96];
    int length = snprintf(wanted, sizeof wanted, "%s %d ", tape, frame);
    for (const char *line = text; line != NULL && *line != '\0'; line = strchr(line, '\n')) {
        if (*line == '\n')
            line++;
        char *end;
        if (strncmp(line, wanted, (size_t)length) != 0)
            continue;
        *crc = (uint32_t)strtoul(line + length, &end, 16);
        return end > line + length;
    }
    return false;
}

/* What is done with each presented frame of a spec. */
struct visitor {
    bool (*take)(struct visitor *visitor, const struct spec *spec, int index,
                 const struct presented *frame, struct failure *f);
    struct tape_writer *writer;     /* of tapes */
    const char *crcs;
    smear_context *ctx;             /* of drawing */
    void *memory;
    uint32_t crc;                   /* of what the library flushed */
    smear_desc desc;
};

static bool visit(const struct spec *golden_or_bench, struct visitor *visitor, struct failure *f)
{
    struct spec spec = *golden_or_bench;
    struct scene scene = { 0 };
    if (!scene_builtin(spec.scene, &scene, f))
        return false;
    spec.present.fps = scene.fps;
    spec.present.clear = scene.clear;
    if (spec.present.shutter_degrees == 0.0)
        spec.present.shutter_degrees = DEFAULT_SHUTTER_DEGREES;
    struct presenter *presenter = presenter_new(&scene, f);
    bool ok = presenter != NULL;
    for (int i = 0; i < spec.count && ok; i++) {
        double time = (spec.first + i * spec.step) / scene.fps;
        const struct presented *frame = presenter_frame(presenter, time, &spec.present, f);
        ok = frame != NULL;
        if (ok && i == 0)           /* all draws of these scenes are there from the start */
            spec.desc.max_draws = presented_desc(frame, 1, 1).max_draws;
        ok = ok && visitor->take(visitor, &spec, i, frame, f);
    }
    presenter_free(presenter);
    scene_free(&scene);
    return ok;
}

static bool record(struct visitor *v, const struct spec *spec, int index,
                   const struct presented *frame, struct failure *f)
{
    uint32_t crc;
    bool has_crc = v->crcs != NULL && find_crc(v->crcs, spec->name, index, &crc);
    return (index > 0 || tape_begin(v->writer, spec->name, &spec->desc, f)) &&
           tape_add(v->writer, frame, has_crc ? &crc : NULL, f);
}

/* The CRC of what arrives, by the rule of smear_stats.crc32: 32-bit pixels count as R, G, B. */
static int add_to_crc(void *user, const smear_band *band)
{
    struct visitor *v = user;
    const uint8_t *row = band->pixels;
    int rows = v->desc.format == SMEAR_L1_PAGES ? (band->height + 7) / 8 : band->height;
    for (int y = 0; y < rows; y++, row += band->stride) {
        if (v->desc.format != SMEAR_XRGB8888) {
            v->crc = crc32_update(v->crc, row, picture_row_bytes(v->desc.width, v->desc.format));
            continue;
        }
        const uint32_t *pixel = (const uint32_t *)(const void *)row;
        for (int x = 0; x < band->width; x++) {
            const uint8_t rgb[3] = { (uint8_t)(pixel[x] >> 16), (uint8_t)(pixel[x] >> 8),
                                     (uint8_t)pixel[x] };
            v->crc = crc32_update(v->crc, rgb, 3);
        }
    }
    return 0;
}

static bool draw(struct visitor *v, const struct spec *spec, int index,
                 const struct presented *frame, struct failure *f)
{
    int result = SMEAR_OK;
    smear_stats stats;
    if (index == 0) {
        smear_desc desc = spec->desc;
        present_tiles(&desc, false);
        desc.flush = add_to_crc;
        desc.user = v;
        v->desc = desc;
        size_t bytes = smear_memory_size(&desc);
        free(v->memory);
        v->memory = malloc(bytes > 0 ? bytes : 1);
        if (v->memory == NULL)
            return fail(f, "out of memory");
        result = smear_init(&v->ctx, &desc, v->memory, bytes);
    }
    v->crc = 0;
    if (result == SMEAR_OK)
        result = presented_submit(frame, v->ctx);
    if (result == SMEAR_OK)
        result = smear_render(v->ctx);
    if (result != SMEAR_OK)
        return fail(f, "the library refused frame %d: %s", index, smear_error_text(result));
    smear_get_stats(v->ctx, &stats);
    if (stats.crc32 != v->crc)
        return fail(f, "the library's CRC is not that of frame %d", index);
    printf("%s %d %08" PRIx32, spec->name, index, v->crc);
    if ((spec->desc.methods & SMEAR_SET_TEMPORAL) != 0)
        printf("    %" PRIu32 " still, %" PRIu32 " subframes, %" PRIu32 " timemask, %" PRIu32
               " split", stats.tiles[SMEAR_NONE], stats.tiles[SMEAR_SUBFRAMES], stats.tiles[SMEAR_TIMEMASK],
               stats.parts_added);
    printf("\n");
    if ((spec->desc.methods & SMEAR_SET_TEMPORAL) != 0 && stats.triangles_dropped != 0)
        return fail(f, "%" PRIu32 " triangles are dropped", stats.triangles_dropped);
    return true;
}

static bool list_golden(struct failure *f, const char **file)
{
    struct visitor visitor = { .take = draw };
    bool ok = true;
    for (size_t i = 0; i < sizeof golden / sizeof *golden && ok; i++) {
        struct spec spec = golden[i];
        complete_golden(&spec);
        *file = spec.name;
        ok = visit(&spec, &visitor, f);
    }
    free(visitor.memory);
    return ok;
}

/* `limit`: in bytes of memory, pointers being as large as they are here. */
static bool write_tapes(const char *path, const char *golden_path, size_t limit, struct failure *f,
                        const char **file)
{
    uint8_t *crcs = NULL;
    size_t size, count = golden_path != NULL ? sizeof golden / sizeof *golden
                                             : sizeof bench / sizeof *bench;
    *file = golden_path;
    if (golden_path != NULL && !file_read(golden_path, MAX_GOLDEN_BYTES, &crcs, &size, f))
        return false;
    struct visitor visitor = { .take = record, .writer = tape_writer_new(f),
                               .crcs = (const char *)crcs };
    bool ok = visitor.writer != NULL;
    for (size_t i = 0; i < count && ok; i++) {
        struct spec spec = golden_path != NULL ? golden[i] : bench[i];
        (golden_path != NULL ? complete_golden : complete_bench)(&spec);
        *file = spec.name;
        smear_desc desc = spec.desc;
        present_tiles(&desc, false);
        desc.flush = add_to_crc;
        if (limit == 0 || (smear_memory_size(&desc) <= limit && !(spec.has_large_textures || spec.has_large_meshes)))
            ok = visit(&spec, &visitor, f);
    }
    if (ok) {
        *file = path;
        ok = tape_write(visitor.writer, path,
                        golden_path != NULL ? "target_tapes golden" : "target_tapes bench", f);
    }
    tape_writer_free(visitor.writer);
    free(crcs);
    return ok;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    const char *file = "";
    bool ok;
    if (argc == 2 && strcmp(argv[1], "list") == 0) {
        ok = list_golden(&f, &file);
    } else if (argc == 4 && strcmp(argv[1], "golden") == 0) {
        ok = write_tapes(argv[2], argv[3], 0, &f, &file);
    } else if (argc == 4 && strcmp(argv[1], "small") == 0) {
        ok = write_tapes(argv[2], argv[3], SMALL_BYTES, &f, &file);
    } else if (argc == 3 && strcmp(argv[1], "bench") == 0) {
        ok = write_tapes(argv[2], NULL, 0, &f, &file);
    } else {
        fprintf(stderr, "usage: target_tapes list | golden OUT.c GOLDEN.txt | small OUT.c GOLDEN.txt |"
                        " bench OUT.c\n");
        return 2;
    }
    if (!ok)
        fprintf(stderr, "target_tapes: %s: %s\n", file, f.text);
    return ok ? 0 : 1;
}
