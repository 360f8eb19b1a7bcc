/* SPDX-License-Identifier: MIT */
/* model.c - a converted model on the target's display: its first clip, looped and blurred.
 *
 *     model show [SCREEN [FRAME]]    the clip at 30 frames per second; with FRAME, that frame, for ever
 *     model check [SCREEN]           the CRC of 60 frames
 *     model cost [SCREEN [BLUR]]     what they cost, in the units of platform.h's clock; none: sharp; auto-sketch, auto-draft,
 *                                    auto-balanced, auto-fine
 *
 * Keys: up and down nearer or farther; A sharp or blurred.
 *
 * The header is made by `smear convert FILE --name model -o build/model.h`; see programs.mk. */
#include "platform/display.h"
#include "platform/platform.h"

#include "platform/print.h"
#include "platform/words.h"

#include MODEL_HEADER

#ifndef MODEL_DRAWS
#error "the header is of another name: run smear convert with --name model"
#endif

#ifndef DEMO_SCREEN
#define DEMO_SCREEN "pico"
#endif

enum { FPS = 30, FRAMES = 60 };

struct model_screen {
    const char *name;
    smear_desc desc;
    uint8_t path;               /* smear_frame.shutter.path: the smallest board has no curves */
    const struct model_view *view;
};

/* From where the model is seen: the camera's columns, right, up and back, q24, and how far it is, Q16.16, in radii. */
struct model_view {
    int32_t basis[9], zoom;
};

/* As `smear render` looks at a file without a camera: from the right and above, along (0.5, 0.35, 1), the whole model in 45
 * degrees, which is from 1 / tan(22.5 degrees) on. */
static const struct model_view whole = {
    { 15005998, -2241541, 7160341, 0, 16011010, 5012239, -7502999, -4483083, 14320683 }, 158218
};
/* As a3d (github.com/0015/a3d) has it in its tables: 0.6 radians aside, 0.25 above, at 2.6 half lengths; those of the Fox of glTF's
 * sample models are 0.828 radii. */
static const struct model_view a3d = {
    { 13846834, -2343690, 9178632, 0, 16255653, 4150750, -9473129, -3425762, 13416369 }, 141146
};

static const struct model_screen screens[] = {
    { "oled", { .width = 128, .height = 64, .format = SMEAR_L4, .bands = 2 }, SMEAR_PATH_LINE, &whole },
    { "gba", { .width = 120, .height = 80, .format = SMEAR_RGB555 }, SMEAR_PATH_DEFAULT, &whole },
    { "pico", { .width = 240, .height = 240, .format = SMEAR_RGB565_SWAPPED, .bands = 2 }, SMEAR_PATH_DEFAULT, &whole },
    { "pico-240", { .width = 240, .height = 240, .format = SMEAR_RGB565_SWAPPED, .bands = 2 }, SMEAR_PATH_DEFAULT, &whole },
    { "pico-320", { .width = 320, .height = 240, .format = SMEAR_RGB565_SWAPPED, .bands = 2 }, SMEAR_PATH_DEFAULT, &whole },
    { "pico-128", { .width = 128, .height = 128, .format = SMEAR_RGB565_SWAPPED, .bands = 2 }, SMEAR_PATH_DEFAULT, &whole },
    { "linux", { .width = 640, .height = 480, .format = SMEAR_XRGB8888 }, SMEAR_PATH_DEFAULT, &whole },
    { "a3d", { .width = 240, .height = 320, .format = SMEAR_RGB565_SWAPPED, .bands = 2 }, SMEAR_PATH_DEFAULT, &a3d },
};

static uint64_t actor_memory[MODEL_ACTOR_BYTES(2) / 8];
static smear_actor *actor;
static smear_context *ctx;
static const struct model_view *view;
static int32_t zoom;                    /* as in the view, at first */
static bool is_sharp;
static uint16_t target;                 /* as in smear_frame; 0: the library's own */
static uint8_t path;

static int failed(const char *what, int result)
{
    platform_print("model: ");
    platform_print(what);
    if (result != 0) {
        platform_print(" (");
        platform_print(smear_error_text(result));
        platform_print(")");
    }
    platform_print("\n");
    return 1;
}

static smear_camera camera_for(const smear_model *model)
{
    const int32_t *basis = view->basis;
    smear_camera camera = { .focal = 158218, .near_plane = model->radius / 4 + 1 };
    for (int i = 0; i < 9; i++)
        camera.pose.basis[i] = basis[i];
    int64_t distance = (int64_t)model->radius * zoom >> 16;
    for (int i = 0; i < 3; i++)
        camera.pose.origin[i] = model->center[i] + (int32_t)(distance * basis[3 * i + 2] >> 24);
    return camera;
}

static int start(const struct model_screen *screen, smear_desc *desc)
{
    *desc = screen->desc;
    path = screen->path;
    view = screen->view;
    zoom = view->zoom;
    desc->max_draws = MODEL_DRAWS;
    desc->max_triangles = MODEL_TRIANGLES;
    return smear_actor_init(&actor, &model_model, 2, actor_memory, sizeof actor_memory);
}

static int frame(uint32_t index, bool draw)
{
    const smear_camera camera = camera_for(&model_model);
    const smear_play play = { .rest = model_model.clip_count == 0, .loop = 1,
                              .time = (int32_t)(index * 65536u / FPS) };
    const smear_frame how = { .camera = &camera, .light_space = SMEAR_LIGHT_ENCODED,
                              .method = is_sharp ? SMEAR_NONE : SMEAR_AUTO, .target = target, .shutter.path = path };
    int result = smear_actor_advance(actor, &play);
    if (result == SMEAR_OK)
        result = smear_begin(ctx, &how);
    if (result == SMEAR_OK)
        result = smear_actor_submit(actor, ctx);
    return result == SMEAR_OK && draw ? smear_render(ctx) : result;
}

/* With as long a list of triangles as there is room for; about half of them face the camera. */
static int open_context(smear_desc *desc)
{
    size_t room;
    void *arena = platform_arena(&room);
    while (smear_memory_size(desc) > room && desc->max_triangles > 16)
        desc->max_triangles -= desc->max_triangles / 16;
    return smear_init(&ctx, desc, arena, room);
}

static int show(const struct model_screen *screen, const char *only)
{
    smear_desc desc;
    int result = start(screen, &desc);
    if (!display_open(&desc))
        return failed("there is no display for this screen", 0);
    if (result == SMEAR_OK)
        result = open_context(&desc);
    if (result != SMEAR_OK)
        return failed("start", result);
    display_attach(ctx);
    uint32_t index = 0;
    for (const char *digit = only; digit != NULL && *digit >= '0' && *digit <= '9'; digit++)
        index = index * 10 + (uint32_t)(*digit - '0');
    if (only != NULL) {
        result = frame(index == 0 ? 0 : index - 1, false);
        if (result == SMEAR_OK)
            result = frame(index, true);
        if (result != SMEAR_OK)
            return failed("frame", result);
        display_show();
        platform_print("shown\n");
        while (display_wait())
            ;
        return 0;
    }
    for (unsigned before = display_keys(); result == SMEAR_OK; index++) {
        unsigned held = display_keys(), pressed = held & ~before;
        before = held;
        if ((pressed & KEY_UP) != 0 && zoom > 1 << 16)
            zoom -= zoom / 8;
        if ((pressed & KEY_DOWN) != 0 && zoom < 8 << 16)
            zoom += zoom / 8;
        is_sharp ^= (pressed & KEY_A) != 0;
        result = frame(index, true);
        if (result == SMEAR_OK)
            display_show();
    }
    return failed("frame", result);
}

static int swallow(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    smear_band_done(ctx);
    return 0;
}

static int check(const struct model_screen *screen)
{
    smear_desc desc;
    smear_stats stats;
    uint32_t crc = 0;
    int result = start(screen, &desc);
    desc.flush = swallow;
    desc.debug.crc = 1;
    if (result == SMEAR_OK)
        result = open_context(&desc);
    for (uint32_t i = 0; i < FRAMES && result == SMEAR_OK; i++) {
        result = frame(i, true);
        smear_get_stats(ctx, &stats);
        crc = (crc << 1 | crc >> 31) ^ stats.crc32;
    }
    if (result != SMEAR_OK)
        return failed("frame", result);
    if (platform_stack_used() == UINT32_MAX)
        return failed("the stack has overflown", 0);
    print_hex(crc);
    platform_print("\n");
    return 0;
}

/* Says how frames are blurred from now on, and what a context needs for it. */
static bool take_blur(const char *name, smear_desc *desc)
{
    static const struct {
        const char *name;
        uint16_t target;
    } blurs[] = { { "auto", 0 }, { "auto-sketch", SMEAR_SKETCH }, { "auto-draft", SMEAR_DRAFT }, { "auto-balanced", SMEAR_BALANCED },
                  { "auto-fine", SMEAR_FINE } };
    is_sharp = is_word(name, "none");
    bool known = is_sharp;
    for (size_t i = 0; i < sizeof blurs / sizeof *blurs && !known; i++) {
        known = is_word(name, blurs[i].name);
        target = blurs[i].target;
    }
    desc->methods = is_sharp ? SMEAR_SET(SMEAR_NONE)
                             : (uint16_t)(SMEAR_SET(SMEAR_AUTO) | (target >= SMEAR_DRAFT ? SMEAR_SET_SKETCH : 0u));
    return known;
}

static int cost(const struct model_screen *screen, const char *blur)
{
    smear_desc desc;
    smear_stats stats;
    uint32_t total = 0, posing = 0, drawn = 0, split = 0, moving = 0, tiles = 0;
    int result = start(screen, &desc);
    if (!take_blur(blur, &desc))
        return failed("no blur of this name", 0);
    desc.flush = swallow;
    if (result == SMEAR_OK)
        result = open_context(&desc);
    platform_clock_start();
    for (uint32_t i = 0; i < FRAMES && result == SMEAR_OK; i++) {
        uint32_t before = platform_clock();
        result = frame(i, true);
        total += platform_clock_count(platform_clock() - before);
        smear_get_stats(ctx, &stats);
        drawn += stats.triangles_drawn;
        split += stats.parts_added;
        moving += stats.tiles_uniform + stats.tiles_complex;
        tiles += stats.tiles_static + stats.tiles_uniform + stats.tiles_complex;
    }
    for (uint32_t i = 0; i < FRAMES && result == SMEAR_OK; i++) {
        const smear_play play = { .rest = model_model.clip_count == 0, .loop = 1,
                                  .time = (int32_t)(i * 2184) };
        uint32_t before = platform_clock();
        result = smear_actor_advance(actor, &play);
        posing += platform_clock_count(platform_clock() - before);
    }
    if (result != SMEAR_OK)
        return failed("frame", result);
    if (platform_stack_used() == UINT32_MAX)
        return failed("the stack has overflown", 0);
    uint32_t pixels = (uint32_t)desc.width * (uint32_t)desc.height;
    platform_print(platform_clock_unit);
    platform_print(" per frame ");
    print_decimal(total / FRAMES);
    platform_print(", per pixel ");
    print_decimal(total / FRAMES / pixels);
    platform_print(", to pose the model ");
    print_decimal(posing / FRAMES);
    platform_print("\ntriangles drawn ");
    print_decimal(drawn / FRAMES);
    platform_print(", frames in parts ");
    print_decimal(split);
    platform_print(", tiles moving ");
    print_decimal(moving * 100 / (tiles > 0 ? tiles : 1));
    platform_print(" %\nmemory: context ");
    print_decimal((uint32_t)smear_memory_size(&desc));
    platform_print(" for ");
    print_decimal(desc.max_triangles);
    platform_print(" triangles");
    platform_print(", actor ");
    print_decimal(sizeof actor_memory);
    platform_print(", stack ");
    print_decimal(platform_stack_used());
    platform_print("\n");
    return 0;
}

int main(int argc, char **argv)
{
    const char *command = argc > 1 ? argv[1] : "show", *name = argc > 2 ? argv[2] : DEMO_SCREEN;
    for (size_t i = 0; i < sizeof screens / sizeof *screens; i++)
        if (is_word(screens[i].name, name))
            return is_word(command, "cost")    ? cost(&screens[i], argc > 3 ? argv[3] : "auto")
                 : is_word(command, "check") ? check(&screens[i])
                                             : show(&screens[i], argc > 3 ? argv[3] : NULL);
    return failed("no screen of this name", 0);
}
