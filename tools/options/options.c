/* SPDX-License-Identifier: MIT */
/* options.c - see options.h. */
#include "tools/options/options.h"

#include "tools/options/arguments.h"
#include "tools/options/options_filter.h"
#include "tools/options/say.h"
#include "tools/scenes/methods.h"

#include <limits.h>
#include <math.h>
#include <string.h>

enum { MAX_EDGE = 2048, MAX_SAMPLES = 1024, MAX_EXACT_SAMPLES = 65536, MAX_REACH = 64 };

const char *const option_formats[] = { "rgb888", "rgb565", "rgb565be", "rgb555", "rgb332", "l8", "l4", "l1", "l1pages", NULL };
const char *const option_dithers[] = { "ordered", "none", "blue", "diffuse", NULL };
const char *const option_doubles[] = { "1x1", "2x1", "1x2", "2x2", NULL };

/* ------------------------------------------------------------------ values with a form of their own */

static const char *read_size_option(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_size = read_size(value, MAX_EDGE, &o->width, &o->height);
    return o->has_size ? NULL : "needs WIDTHxHEIGHT, both from 1 to 2048";
}

static const char *read_frames(void *to, const char *value)
{
    static char text[80];
    struct render_options *o = to;
    long one;
    o->has_frames = read_range(value, &o->first, &o->last);
    if (!o->has_frames && read_integer(value, 0, 999999999, &one)) {
        snprintf(text, sizeof text, "needs FIRST-LAST: %ld-%ld is frame %ld alone", one, one, one);
        return text;
    }
    return o->has_frames ? NULL : "needs FIRST-LAST, two frame numbers from 0 to 999999999";
}

static const char *read_orbit(void *to, const char *value)
{
    double turns;
    if (!read_number(value, -100.0, 100.0, &turns) || turns == 0.0)
        return "needs turns from -100 to 100, not 0";
    ((struct render_options *)to)->orbit = turns;
    return NULL;
}

static const char *read_eye(void *to, const char *value)
{
    struct render_options *o = to;
    o->view.has_eye = read_vector(value, o->view.eye);
    return o->view.has_eye ? NULL : "needs X,Y,Z, each from -1e9 to 1e9";
}

static const char *read_look(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_look = read_vector(value, o->view.look);
    return o->has_look ? NULL : "needs X,Y,Z, each from -1e9 to 1e9";
}

const char *read_method_name(const char *value, smear_method *method)
{
    static char text[280];
    const struct method *found = method_named(value);
    if (found != NULL) {
        *method = found->method;
        return NULL;
    }
    for (int i = 0; i < method_count; i++)
        read_near(value, method_list[i].name);
    snprintf(text, sizeof text, "needs %s", method_names());
    return text;
}

static const char *read_method(void *to, const char *value)
{
    return read_method_name(value, &((struct render_options *)to)->method);
}

static bool read_departure(void *to, const char *name, const char *value)
{
    static const char *const names[] = { "fence", "corner", "box", "direction", "published", NULL };
    int found = read_name(name, names);
    if (found < 0 || value != NULL)
        return false;
    /* SMEAR_FENCE, SMEAR_CORNER, ... in this order */
    ((struct render_options *)to)->reconstruct |= 1 << found;
    return true;
}

static const char *read_reconstruct(void *to, const char *value)
{
    ((struct render_options *)to)->reconstruct = 0;
    return read_list(value, read_departure, to) ? NULL
                                                : "needs a list of fence, corner, box, direction, published";
}

static const char *read_target(void *to, const char *value)
{
    struct render_options *o = to;
    double codes;
    if (!read_number(value, 1e-6, 255.0, &codes))
        return "needs codes from 1e-6 to 255";
    o->has_target = true;
    o->target = codes * 64 < 1.0 ? 1 : (int)(codes * 64 + 0.5);
    return NULL;
}

static const char *read_reach(void *to, const char *value)
{
    struct render_options *o = to;
    char number[32];
    long pixels;
    size_t length = strlen(value);
    o->reach_px = 0;
    o->reach_percent = 0.0;
    if (length > 1 && length < sizeof number && value[length - 1] == '%') {
        memcpy(number, value, length - 1);
        number[length - 1] = '\0';
        if (read_number(number, 1e-6, 100.0, &o->reach_percent))
            return NULL;
    } else if (read_integer(value, 1, MAX_EDGE, &pixels)) {
        o->reach_px = (int)pixels;
        return NULL;
    }
    return "needs pixels from 1 on, or a percentage of the height above 0%";
}

static const char *read_motion(void *to, const char *value)
{
    struct render_options *o = to;
    if (o->motion_count == OPTIONS_MAX_MOTIONS)
        return "too many of them";
    o->motion[o->motion_count++] = value;
    return NULL;
}

static const char *read_cut(void *to, const char *value)
{
    struct render_options *o = to;
    if (o->cut_count == OPTIONS_MAX_CUTS)
        return "too many of them";
    return read_integer(value, 0, 999999999, &o->cut[o->cut_count++]) ? NULL
                                                                      : "needs a frame number from 0 to 999999999";
}

static const char *read_clear(void *to, const char *value)
{
    struct render_options *o = to;
    const bool is_pair = strlen(value) == 13 && value[6] == ',';
    char top[7];
    unsigned color[2];
    snprintf(top, sizeof top, "%.6s", value);
    o->has_clear = is_pair ? read_color(top, &color[0]) && read_color(value + 7, &color[1]) : read_color(value, &color[0]);
    if (!o->has_clear)
        return "needs RRGGBB, six hexadecimal digits, or two of them, TOP,BOTTOM";
    o->clear = color[0];
    o->backdrop = (struct backdrop_colors){ .is_wanted = is_pair, .top = color[0], .bottom = is_pair ? color[1] : color[0] };
    return NULL;
}

static const char *read_fog(void *to, const char *value)
{
    struct present_fog *fog = &((struct render_options *)to)->fog;
    double part[3];
    char number[128] = "0,", color[7] = "";
    if (strlen(value) > 7 && strlen(value) < sizeof number && value[6] == ',') {
        memcpy(color, value, 6);
        snprintf(number + 2, sizeof number - 2, "%s", value + 7);
    }
    if (!read_color(color, &fog->color) || !read_vector(number, part))
        return "needs RRGGBB,NEAR,FAR: six hexadecimal digits and two distances";
    fog->begin = part[1];
    fog->end = part[2];
    return fog->begin >= 0.0 && fog->end * (255.0 / 256.0) > fog->begin
             ? NULL : "needs 0 <= NEAR < FAR, a 256th of FAR apart";
}

/* Reads a colour and what follows it: a vector and, with `last`, one more number. */
static bool read_colored(const char *value, unsigned *color, double vector[3], double *last)
{
    char digits[7] = "", number[128], end[140] = "0,0,";
    double part[3];
    if (strlen(value) <= 7 || strlen(value) >= sizeof number || value[6] != ',')
        return false;
    memcpy(digits, value, 6);
    snprintf(number, sizeof number, "%s", value + 7);
    char *comma = last != NULL ? strrchr(number, ',') : NULL;
    if (last != NULL) {
        if (comma == NULL)
            return false;
        snprintf(end + 4, sizeof end - 4, "%s", comma + 1);
        *comma = '\0';
        if (!read_vector(end, part))
            return false;
        *last = part[2];
    }
    return read_color(digits, color) && read_vector(number, vector);
}

static const char *read_sun(void *to, const char *value)
{
    struct present_lights *l = &((struct render_options *)to)->lights;
    l->has_sun = read_colored(value, &l->sun, l->sun_direction, NULL)
              && (l->sun_direction[0] != 0.0 || l->sun_direction[1] != 0.0 || l->sun_direction[2] != 0.0);
    return l->has_sun ? NULL : "needs RRGGBB,X,Y,Z: six hexadecimal digits and a direction";
}

static const char *read_second(void *to, const char *value)
{
    struct present_lights *l = &((struct render_options *)to)->lights;
    l->has_second = read_colored(value, &l->second, l->direction, NULL)
                 && (l->direction[0] != 0.0 || l->direction[1] != 0.0 || l->direction[2] != 0.0);
    return l->has_second ? NULL : "needs RRGGBB,X,Y,Z: six hexadecimal digits and a direction";
}

static const char *read_lamp(void *to, const char *value)
{
    struct present_lights *l = &((struct render_options *)to)->lights;
    return read_colored(value, &l->lamp, l->place, &l->reach) && l->reach > 0.0
             ? NULL : "needs RRGGBB,X,Y,Z,REACH: six hexadecimal digits, a place and a distance";
}

static const char *read_sky(void *to, const char *value)
{
    struct present_sky *sky = &((struct render_options *)to)->sky;
    unsigned color[4];
    char one[7];
    bool ok = strlen(value) == 27;
    for (int i = 0; ok && i < 4; i++) {
        snprintf(one, sizeof one, "%.6s", value + 7 * i);
        ok = read_color(one, &color[i]) && (i == 3 || value[7 * i + 6] == ',');
    }
    if (ok)
        *sky = (struct present_sky){ true, color[0], color[1], color[2], color[3] };
    return ok ? NULL : "needs ZENITH,HORIZON,GROUND,NADIR, four times six hexadecimal digits";
}

/* Reads blob or planar, and how dark it is in percent. */
static const char *read_shadow(void *to, const char *value)
{
    static const char *const kinds[] = { "blob", "planar", NULL };
    static char kind[8];                /* a nearest name is told of it */
    struct scene_shadow *shadow = &((struct render_options *)to)->view.shadow;
    const char *comma = strchr(value, ',');
    double percent = 45;
    snprintf(kind, sizeof kind, "%.*s", comma != NULL ? (int)(comma - value) : (int)strlen(value), value);
    const int found = read_name(kind, kinds);
    if (found < 0 || (comma != NULL && !read_number(comma + 1, 1, 100, &percent)))
        return "needs blob or planar and, after a comma, a darkness from 1 to 100";
    shadow->kind = (enum scene_shadow_kind)(SCENE_SHADOW_BLOB + found);
    shadow->darkness = percent / 100;
    return NULL;
}

#define AT(member) OPTION_AT(struct render_options, member)
#define GIVEN(member) .given = offsetof(struct render_options, member)

static const struct option table[] = {
    { "--size", OPTION_READ, .read = read_size_option },
    { "--fps", OPTION_NUMBER, AT(fps), GIVEN(has_fps), .low = 0.001, .high = 100000, .needs = "frames per second" },
    { "--frames", OPTION_READ, .read = read_frames },
    { "--time", OPTION_NUMBER, AT(time), GIVEN(has_time), .high = 1e9, .needs = "seconds" },
    { "--clip", OPTION_TEXT, AT(view.clip), .needs = "a clip" },
    { "--loop", OPTION_FLAG, AT(view.loop) },
    { "--orbit", OPTION_READ, .read = read_orbit },
    { "--outside", OPTION_FLAG, AT(view.files) },
    { "--double-sided", OPTION_FLAG, AT(view.double_sided) },
    { "--camera", OPTION_TEXT, AT(view.camera), .needs = "a camera" },
    { "--eye", OPTION_READ, .read = read_eye },
    { "--look", OPTION_READ, .read = read_look },
    { "--fov", OPTION_NUMBER, AT(view.fov_degrees), GIVEN(has_fov), .low = 0.01, .high = 179, .needs = "degrees" },
    { "--shutter", OPTION_READ, .read = read_shutter },
    { "--exposure", OPTION_NAME, AT(exposure), OPTION_NAMES("centred", "trailing", "leading") },
    { "--poses", OPTION_NAME, AT(shutter_poses), OPTION_NAMES("previous", "shutter") },
    { "--path", OPTION_NAME, AT(path), OPTION_NAMES("curve", "line", "origin", "screw"), .low = SMEAR_PATH_CURVE },
    { "--method", OPTION_READ, .read = read_method },
    { "--samples", OPTION_INTEGER, AT(samples), .low = 1, .high = MAX_EXACT_SAMPLES, .needs = "a number (without --exact, 1 to 1024)" },
    { "--exact", OPTION_FLAG, AT(exact) },
    { "--reconstruct", OPTION_READ, .read = read_reconstruct },
    { "--inside", OPTION_NAME, AT(filter), OPTION_NAMES("mean", "reconstruct", "pingpong"), .low = SMEAR_FILTER_MEAN },
    { "--camera-step", OPTION_NAME, AT(camera_step), OPTION_NAMES("1", "2", "4"), OPTION_VALUES(1, 2, 4) },
    { "--pingpong", OPTION_READ, .read = read_pingpong },
    { "--weights", OPTION_NAME, AT(weights), OPTION_NAMES("stack", "mcguire", "guertin", "jimenez") },
    { "--budget", OPTION_INTEGER, AT(budget), .low = 1, .high = 2000000000 },
    { "--keep-still", OPTION_FLAG, AT(cache_static) },
    { "--keep-display", OPTION_FLAG, AT(keep_display) },
    { "--scatter", OPTION_FLAG, AT(scatter) },
    { "--scale", OPTION_READ, .read = read_scale },
    { "--quality", OPTION_NAME, AT(target), GIVEN(has_quality), OPTION_NAMES("sketch", "draft", "balanced", "fine"),
      OPTION_VALUES(SMEAR_SKETCH, SMEAR_DRAFT, SMEAR_BALANCED, SMEAR_FINE) },
    { "--target", OPTION_READ, .read = read_target },
    { "--reach", OPTION_READ, .read = read_reach },
    { "--tile", OPTION_NAME, AT(tile), OPTION_NAMES("4", "8", "16", "32", "64"), OPTION_VALUES(4, 8, 16, 32, 64) },
    { "--mask", OPTION_TEXT, AT(mask), .needs = "nodes, with commas" },
    { "--motion", OPTION_READ, .read = read_motion },
    { "--cut", OPTION_READ, .read = read_cut },
    { "--shutter-mode", OPTION_READ, .read = read_shutter_mode },
    { "--light", OPTION_NAME, AT(light), OPTION_NAMES("linear", "encoded") },
    { "--filter", OPTION_NAME, AT(view.bilinear), GIVEN(has_filter), OPTION_NAMES("nearest", "bilinear") },
    { "--clear", OPTION_READ, .read = read_clear },
    { "--fog", OPTION_READ, .read = read_fog },
    { "--sun", OPTION_READ, .read = read_sun },
    { "--second", OPTION_READ, .read = read_second },
    { "--lamp", OPTION_READ, .read = read_lamp },
    { "--gloss", OPTION_FLAG, AT(lights.gloss) },
    { "--sky", OPTION_READ, .read = read_sky },
    { "--shadow", OPTION_READ, .read = read_shadow },
    { "--edges", OPTION_NAME, AT(edges), OPTION_NAMES("hard", "smooth") },
    { "--format", OPTION_NAME, AT(format), .names = option_formats },
    { "--dither", OPTION_NAME, AT(dither), .names = option_dithers },
    { "--double", OPTION_NAME, AT(doubled), .names = option_doubles },
    { "--arena", OPTION_INTEGER, AT(arena), .low = 1, .high = LONG_MAX / 2 + 1, .needs = "bytes" },
    { "--threads", OPTION_INTEGER, AT(threads), .low = 1, .high = 8 },
    { "--repeat", OPTION_INTEGER, AT(repeat), .low = 1, .high = 100000 },
    { "-o", OPTION_TEXT, AT(output) },
    { "--depth", OPTION_TEXT, AT(depth) },
    { "--velocity", OPTION_TEXT, AT(velocity) },
    { "--stats", OPTION_TEXT, AT(stats) },
    { .name = NULL },
};

/* ------------------------------------------------------------------ all of them together */

static int check_camera_options(const struct render_options *o)
{
    const double *eye = o->view.eye, *look = o->view.look;
    if (o->view.has_eye != o->has_look)
        return say_bad_usage(o->has_look ? "--look" : "--eye", "--eye and --look go together");
    if (o->has_fov && !o->view.has_eye)
        return say_bad_usage("--fov", "needs --eye and --look");
    if (o->view.has_eye && o->view.camera != NULL)
        return say_bad_usage("--camera", "contradicts --eye");
    if (o->view.has_eye && eye[0] == look[0] && eye[1] == look[1] && eye[2] == look[2])
        return say_bad_usage("--look", "is where --eye is");
    return STATUS_OK;
}

/* Built-in scenes bring their own cameras, motion and materials. */
static int check_builtin(const struct render_options *o)
{
    const struct {
        const char *option;
        bool given;
    } only_files[] = {
        { "--clip", o->view.clip != NULL }, { "--loop", o->view.loop },
        { "--camera", o->view.camera != NULL }, { "--eye", o->view.has_eye },
        { "--filter", o->has_filter }, { "--motion", o->motion_count > 0 },
        { "--mask", o->mask != NULL }, { "--outside", o->view.files == MODEL_FILES_ANYWHERE },
        { "--double-sided", o->view.double_sided }, { "--shadow", o->view.shadow.kind != SCENE_SHADOW_NONE },
    };
    for (size_t i = 0; i < sizeof only_files / sizeof *only_files; i++)
        if (only_files[i].given)
            return say_bad_usage(only_files[i].option,
                                 "is for files, built-in scenes have their own");
    return STATUS_OK;
}

static int check_method(const struct render_options *o)
{
    if (o->exact && o->method != SMEAR_ACCUMULATE)
        return say_bad_usage("--exact", "goes with --method accumulate");
    if (o->budget != 0 && o->method != SMEAR_AUTO)
        return say_bad_usage("--budget", "goes with --method auto");
    if (o->cache_static && !smear_method_is_temporal(o->method))
        return say_bad_usage("--keep-still", "goes with --method auto, subframes and timemask");
    if (o->keep_display && !method_keeps_display(o->method))
        return say_bad_usage("--keep-display", "goes with --method none, auto, subframes and timemask");
    if (o->dither == SMEAR_DITHER_DIFFUSE && (o->format < SMEAR_L4 || o->keep_display))
        return say_bad_usage("--dither", "diffuse goes with --format l4, l1 and l1pages, without --keep-display");
    if (o->edges != SMEAR_EDGES_HARD && !o->exact && !method_smooths_edges(o->method))
        return say_bad_usage("--edges", "smooth is for auto and subframes, and for --exact");
    if (o->edges != SMEAR_EDGES_HARD && o->keep_display && !o->cache_static)
        return say_bad_usage("--edges", "smooth goes with --keep-display where there is --keep-still, too");
    if (o->exact && o->motion_count > 0)
        return say_bad_usage("--motion", "contradicts --exact, which moves all as the file does");
    if (o->mask != NULL && o->method != SMEAR_OBJECT && o->method != SMEAR_LAYERED)
        return say_bad_usage("--mask", "goes with --method object and layered");
    if (!o->exact && o->samples > MAX_SAMPLES)
        return say_bad_usage("--samples", "is at most 1024 without --exact (\"%d\")", o->samples);
    if (o->has_quality && o->has_target)
        return say_bad_usage("--target", "contradicts --quality");
    if (o->backdrop.is_wanted && o->fog.end != 0.0)
        return say_bad_usage("--fog", "contradicts a background of two colours");
    if (o->backdrop.is_wanted && o->sky.is_wanted)
        return say_bad_usage("--sky", "contradicts a background of two colours");
    if (o->has_time && o->has_frames)
        return say_bad_usage("--time", "contradicts --frames");
    return check_filter(o);
}

void options_outputs(const struct render_options *o, struct apart_output out[OPTIONS_OUTPUTS])
{
    const struct sink *const sinks[] = { &o->picture_sink, &o->depth_sink, &o->velocity_sink };
    for (int i = 0; i < 3; i++)
        out[i] = (struct apart_output){ .path = sinks[i]->path, .is_pattern = sinks[i]->has_pattern, .first = o->first, .last = o->last };
    out[3] = (struct apart_output){ .path = o->stats };
}

static int open_sinks(struct render_options *o)
{
    const long frames = o->last - o->first + 1;
    int status = STATUS_OK;
    if (o->output != NULL)
        status = sink_open(&o->picture_sink, "-o", o->output, frames, false);
    if (status == STATUS_OK && o->depth != NULL)
        status = sink_open(&o->depth_sink, "--depth", o->depth, frames, true);
    if (status == STATUS_OK && o->velocity != NULL)
        status = sink_open(&o->velocity_sink, "--velocity", o->velocity, frames, true);
    struct apart_output outputs[OPTIONS_OUTPUTS];
    options_outputs(o, outputs);
    return status == STATUS_OK ? apart_check(outputs, OPTIONS_OUTPUTS) : status;
}

int options_move(struct render_options *o, long period)
{
    const bool moves = o->picture_sink.kind == SINK_GIF || o->picture_sink.kind == SINK_APNG;
    if (!moves || period < 2 || o->has_frames || o->has_time)
        return STATUS_OK;
    o->has_frames = true;
    o->last = period - 1;
    return open_sinks(o);
}

static int check_outputs(struct render_options *o)
{
    if (o->output == NULL && o->stats == NULL && o->repeat == 0) {
        char stem[280];
        if (!source_stem(o->scene, stem, sizeof stem) || strchr(stem, '%') != NULL)
            return say_bad_usage("-o", "is needed for a scene of this name");
        snprintf(o->default_output, sizeof o->default_output, "%s.png", stem);
        o->output = o->default_output;
    }
    return open_sinks(o);
}

int options_read_seen(struct render_options *o, int count, char **text, bool *wants_help)
{
    *o = (struct render_options){ .width = 320, .height = 240, .fps = 30.0, .threads = 1,
                                  .method = SMEAR_AUTO, .shutter_degrees = 180,
                                  .view = { .fov_degrees = 45.0 } };
    int status = arguments_read(count, text, table, o, &o->scene, 1, wants_help);
    if (status != STATUS_OK || *wants_help)
        return status;
    status = check_camera_options(o);
    if (status == STATUS_OK)
        status = check_method(o);
    if (status == STATUS_OK && o->scene != NULL && source_builtin_name(o->scene) != NULL)
        status = check_builtin(o);
    o->view.aspect = (double)o->width / o->height;
    if (o->lights.has_sun)
        memcpy(o->view.shadow.light, o->lights.sun_direction, sizeof o->view.shadow.light);
    return status;
}

int options_read(struct render_options *o, int count, char **text, bool *wants_help)
{
    int status = options_read_seen(o, count, text, wants_help);
    if (status != STATUS_OK || *wants_help)
        return status;
    if (o->scene == NULL)
        return say_bad_usage("render", "needs a scene (smear help render)");
    return check_outputs(o);
}

int options_reach(const struct render_options *o, int height, int *reach, int *tile)
{
    double percent = o->reach_percent > 0.0 ? o->reach_percent : 5.0;
    int limit = o->tile > 0 && !o->scatter ? o->tile : MAX_REACH;
    *tile = o->tile;
    *reach = o->reach_px;
    if (*reach == 0) {
        *reach = (int)floor(height * percent / 100.0 + 1e-9);
        if (*reach < 1)
            *reach = 1;
        if (*reach > limit && o->reach_percent == 0.0)
            *reach = limit;         /* the default is 5 %, but at most one tile */
    }
    if (*reach > limit)
        return o->scatter ? say_bad_usage("--reach", "%d pixels are more than %d", *reach, limit)
                          : say_bad_usage("--reach", "%d pixels are more than a tile of %d", *reach, limit);
    return STATUS_OK;
}

const char *options_format_name(smear_format format)
{
    return option_formats[format];
}
