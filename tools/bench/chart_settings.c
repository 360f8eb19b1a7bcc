/* SPDX-License-Identifier: MIT */
/* chart_settings.c - what is measured. A new setting is a line here and nothing else. */
#include "tools/bench/chart.h"

#include <string.h>

const struct chart_condition chart_conditions[CHART_CONDITIONS] = {
    { "linear", "previous", true, true, true, SHARE_SHOWN, "as it comes: linear light, poses of frames ago, dithered RGB565" },
    { "encoded", "shutter", false, false, false, SHARE_ALL, "study: encoded light, poses at shutter open and close" },
    { "linear", "shutter", true, false, false, SHARE_FEW, "linear light, poses at shutter open and close" },
};

/* Colours that people with colour-blindness tell apart, each with a mark of its own. */
enum {
    NONE, ACCUMULATE, PUBLISHED, MENDED, CAMERA, PINGPONG, HALF, TWO_CAMERAS, OBJECT, LAYERED, SUBFRAMES,
    TIMEMASK, AUTO
};

const struct chart_curve chart_curves[] = {
    [NONE] = { "none: no blur", "none", "sharp", "#222222", MARK_CROSS, false },
    [ACCUMULATE] = { "accumulate: N whole frames", "accumulate", "mean of sharp frames", "#6b7280", MARK_SQUARE, false },
    [PUBLISHED] = { "reconstruct: screen-space filter, N taps", "reconstruct", NULL, "#e69f00",
                    MARK_TRIANGLE, false },
    [MENDED] = { "reconstruct, mended", "mended", NULL, "#d55e00", MARK_TRIANGLE, false },
    [CAMERA] = { "camera: velocity from depth, a mean", "camera", NULL, "#8c564b", MARK_CIRCLE, false },
    [PINGPONG] = { "pingpong: 8 and 8 taps", "pingpong", NULL, "#4b8b3b", MARK_SQUARE, false },
    [HALF] = { "half: reconstruct at half the size", "half", NULL, "#c77cba", MARK_TRIANGLE, false },
    [TWO_CAMERAS] = { "two cameras: one velocity, N taps, over all", "plain", NULL, "#a0a0a0", MARK_SQUARE, false },
    [OBJECT] = { "object: each mover along one velocity", "object", NULL, "#56b4e9", MARK_SQUARE, false },
    [LAYERED] = { "layered: by velocity over the still scene, N taps", "layered", NULL, "#7b5ea7", MARK_TRIANGLE,
                  false },
    [SUBFRAMES] = { "subframes: up to N per tile", "subframes", NULL, "#009e73", MARK_DIAMOND, false },
    [TIMEMASK] = { "timemask: N time slots", "timemask", NULL, "#0072b2", MARK_CIRCLE, false },
    [AUTO] = { "auto: the cheapest that is good enough", "auto", "smear", "#b5126b", MARK_STAR, true },
};
const int chart_curve_count = sizeof chart_curves / sizeof *chart_curves;

#define MEND (SMEAR_FENCE | SMEAR_CORNER | SMEAR_BOX)

/* Codes, in the unit of smear_frame.target. */
#define CODES(codes) ((int)((codes) * 64))

const struct chart_setting chart_settings[] = {
    { NONE, "none", "", SMEAR_NONE, .everywhere = true },

    { ACCUMULATE, "accumulate 2", "2", SMEAR_ACCUMULATE, .samples = 2 },
    { ACCUMULATE, "accumulate 4", "4", SMEAR_ACCUMULATE, .samples = 4, .everywhere = true },
    { ACCUMULATE, "accumulate 8", "8", SMEAR_ACCUMULATE, .samples = 8, .everywhere = true },
    { ACCUMULATE, "accumulate 16", "16", SMEAR_ACCUMULATE, .samples = 16, .everywhere = true },
    { ACCUMULATE, "accumulate 32", "32", SMEAR_ACCUMULATE, .samples = 32 },

    { PUBLISHED, "reconstruct 2", "2", SMEAR_RECONSTRUCT, .samples = 2 },
    { PUBLISHED, "reconstruct 4", "4", SMEAR_RECONSTRUCT, .samples = 4 },
    { PUBLISHED, "reconstruct 8", "8", SMEAR_RECONSTRUCT, .samples = 8, .everywhere = true },
    { PUBLISHED, "reconstruct 16", "16", SMEAR_RECONSTRUCT, .samples = 16 },
    { MENDED, "reconstruct 2 mended", "2", SMEAR_RECONSTRUCT, .samples = 2, .reconstruct = MEND },
    { MENDED, "reconstruct 4 mended", "4", SMEAR_RECONSTRUCT, .samples = 4, .reconstruct = MEND },
    { MENDED, "reconstruct 8 mended", "8", SMEAR_RECONSTRUCT, .samples = 8, .reconstruct = MEND,
      .everywhere = true },
    { MENDED, "reconstruct 16 mended", "16", SMEAR_RECONSTRUCT, .samples = 16,
      .reconstruct = MEND },

    { PUBLISHED, "reconstruct 8 mcguire", NULL, SMEAR_RECONSTRUCT, .samples = 8,
      .weights = SMEAR_WEIGHTS_MCGUIRE },
    { PUBLISHED, "reconstruct 8 guertin", NULL, SMEAR_RECONSTRUCT, .samples = 8,
      .weights = SMEAR_WEIGHTS_GUERTIN },
    { PUBLISHED, "reconstruct 8 jimenez", NULL, SMEAR_RECONSTRUCT, .samples = 8,
      .weights = SMEAR_WEIGHTS_JIMENEZ },

    { CAMERA, "camera 8", "8", SMEAR_CAMERA, .samples = 8, .everywhere = true },
    { PINGPONG, "pingpong", "8+8", SMEAR_PINGPONG, .everywhere = true },
    { PINGPONG, "pingpong spread", NULL, SMEAR_PINGPONG, .spread = true },
    { HALF, "half 8", "8", SMEAR_HALF, .samples = 8, .everywhere = true },
    { HALF, "half 8 mended", NULL, SMEAR_HALF, .samples = 8, .reconstruct = MEND },
    { OBJECT, "object", "", SMEAR_OBJECT, .everywhere = true },
    { TWO_CAMERAS, "object plain 4", "4", SMEAR_OBJECT, .samples = 4, .plain = true },
    { TWO_CAMERAS, "object plain 16", "16", SMEAR_OBJECT, .samples = 16, .plain = true },
    { LAYERED, "layered 4", "4", SMEAR_LAYERED, .samples = 4 },
    { LAYERED, "layered 8", "8", SMEAR_LAYERED, .samples = 8, .everywhere = true },
    { LAYERED, "layered 16", "16", SMEAR_LAYERED, .samples = 16 },

    { SUBFRAMES, "subframes 4", "4", SMEAR_SUBFRAMES, .samples = 4 },
    { SUBFRAMES, "subframes 8", "8", SMEAR_SUBFRAMES, .samples = 8 },
    { SUBFRAMES, "subframes 16", "16", SMEAR_SUBFRAMES, .samples = 16 },
    { SUBFRAMES, "subframes 32", "32", SMEAR_SUBFRAMES, .samples = 32, .everywhere = true },

    { TIMEMASK, "timemask 8", "8", SMEAR_TIMEMASK, .samples = 8 },
    { TIMEMASK, "timemask 16", "16", SMEAR_TIMEMASK, .samples = 16 },
    { TIMEMASK, "timemask 32", "32", SMEAR_TIMEMASK, .samples = 32, .everywhere = true },

    { AUTO, "auto sketch", "sketch", SMEAR_AUTO, .target = SMEAR_SKETCH, .everywhere = true },
    { AUTO, "auto 5.6", NULL, SMEAR_AUTO, .target = CODES(5.6) },
    { AUTO, "auto draft", "draft", SMEAR_AUTO, .target = SMEAR_DRAFT, .everywhere = true },
    { AUTO, "auto 2.8", NULL, SMEAR_AUTO, .target = CODES(2.8) },
    { AUTO, "auto 2", NULL, SMEAR_AUTO, .target = CODES(2) },
    { AUTO, "auto balanced", "balanced", SMEAR_AUTO, .target = SMEAR_BALANCED,
      .everywhere = true },
    { AUTO, "auto 1", NULL, SMEAR_AUTO, .target = CODES(1) },
    { AUTO, "auto 0.7", NULL, SMEAR_AUTO, .target = CODES(0.7) },
    { AUTO, "auto fine", "fine", SMEAR_AUTO, .target = SMEAR_FINE, .everywhere = true },
    { AUTO, "auto 0.35", NULL, SMEAR_AUTO, .target = CODES(0.35) },
    { AUTO, "auto 0.25", NULL, SMEAR_AUTO, .target = CODES(0.25) },
};
const int chart_setting_count = sizeof chart_settings / sizeof *chart_settings;
const int chart_none = 0;

_Static_assert(sizeof chart_settings / sizeof *chart_settings <= CHART_MAX_SETTINGS,
               "more settings than a chart holds");

int chart_find_setting(const char *name)
{
    for (int i = 0; i < chart_setting_count; i++)
        if (strcmp(chart_settings[i].name, name) == 0)
            return i;
    return -1;
}

int chart_find_condition(const char *light, const char *poses)
{
    for (int i = 0; i < CHART_CONDITIONS; i++)
        if (strcmp(chart_conditions[i].light, light) == 0
            && strcmp(chart_conditions[i].poses, poses) == 0)
            return i;
    return -1;
}

int chart_index(int condition, int kind, int setting)
{
    return (condition * ALL_KINDS + kind) * chart_setting_count + setting;
}

bool chart_take(int index, struct take *out)
{
    int setting = index % chart_setting_count, kind = index / chart_setting_count % ALL_KINDS;
    int condition = index / chart_setting_count / ALL_KINDS;
    if (index < 0 || condition >= CHART_CONDITIONS)
        return false;
    const struct chart_setting *s = &chart_settings[setting];
    const struct chart_condition *c = &chart_conditions[condition];
    *out = (struct take){
        .scene = kinds[kind].scene, .clip = kinds[kind].clip, .frame = kinds[kind].frame, .width = 320, .height = 240,
        .windowed = !c->display && smear_method_is_filter(s->method), .plain = s->plain,
        .target = s->target, .format = c->display ? SMEAR_RGB565 : SMEAR_XRGB8888, .dithered = c->display,
        .plain_context = c->display,
        .method = s->method, .samples = s->samples, .reconstruct = s->reconstruct,
        .filter = s->filter, .weights = s->weights, .pingpong.spread = s->spread,
        .linear = c->linear, .shutter_poses = !c->previous
    };
    return true;
}

bool chart_error_take(int index, struct take *out)
{
    if (!chart_take(index, out))
        return false;
    out->format = SMEAR_XRGB8888;
    out->dithered = false;
    return true;
}

bool chart_is_shown(int setting)
{
    return chart_settings[setting].label != NULL || chart_curves[chart_settings[setting].curve].bold;
}

bool chart_is_plain(int setting)
{
    return chart_settings[setting].label != NULL && chart_curves[chart_settings[setting].curve].plain != NULL;
}

bool chart_is_wanted(const struct chart_choice *choice, int condition, int kind, int setting)
{
    const enum chart_share share = chart_conditions[condition].share;
    return choice->condition[condition] && choice->kind[kind] && choice->setting[setting]
        && (share == SHARE_ALL || chart_settings[setting].everywhere || (share == SHARE_SHOWN && chart_is_shown(setting)));
}

/* ------------------------------------------------------------------ kinds of scenes */

/* The table of kinds.h. */

#define KIND(name, group) { "suite/" name, name, group, -1, NULL }

const struct kind kinds[ALL_KINDS] = {
    KIND("translate", GROUP_OBJECT), KIND("propeller", GROUP_OBJECT), KIND("cross", GROUP_OBJECT),
    KIND("fence_obj", GROUP_OBJECT), KIND("enter", GROUP_OBJECT),     KIND("near", GROUP_OBJECT),
    KIND("long", GROUP_OBJECT),      KIND("skin", GROUP_OBJECT),      KIND("swarm", GROUP_OBJECT),
    KIND("teleport", GROUP_OBJECT),  KIND("morph", GROUP_OBJECT),     KIND("cubic", GROUP_OBJECT),
    KIND("pan", GROUP_CAMERA),       KIND("dolly", GROUP_CAMERA),     KIND("roll", GROUP_CAMERA),
    KIND("fence_fg", GROUP_CAMERA),  KIND("textured", GROUP_CAMERA),  KIND("arena", GROUP_CAMERA),
    KIND("subpixel", GROUP_CAMERA),  KIND("still", GROUP_STILL),
    { "demo/race", "race-4", GROUP_DEMO, 4, NULL },
    { "demo/race", "race-20", GROUP_DEMO, 20, NULL },
    { "demo/race", "race-40", GROUP_DEMO, 40, NULL },
    { "demo/drone", "drone", GROUP_DEMO, 12, NULL },
    { "own/fan.glb", "fan", GROUP_MODEL, 3, NULL },
    { "quaternius/RobotExpressive.glb", "robot", GROUP_MODEL, 7, "Running" },
    { "khronos/Fox.glb", "fox", GROUP_MODEL, 7, "Run" },
};

const char *const kind_group_name[GROUPS] = { "object", "camera", "still", "demo", "model" };

int kind_find(const char *name)
{
    for (int i = 0; i < ALL_KINDS; i++)
        if (strcmp(kinds[i].name, name) == 0)
            return i;
    return -1;
}
