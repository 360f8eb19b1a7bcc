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

/* ------------------------------------------------------------------ one function per option */

static const char *read_size_option(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_size = read_size(value, MAX_EDGE, &o->width, &o->height);
    return o->has_size ? NULL : "needs WIDTHxHEIGHT, both from 1 to 2048";
}

static const char *read_fps(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_fps = read_number(value, 0.001, 100000.0, &o->fps);
    return o->has_fps ? NULL : "needs frames per second from 0.001 to 100000";
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

static const char *read_time(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_time = read_number(value, 0.0, 1e9, &o->time);
    return o->has_time ? NULL : "needs seconds from 0 to 1e9";
}

static const char *read_clip(void *to, const char *value)
{
    ((struct render_options *)to)->view.clip = value;
    return NULL;
}

static const char *read_loop(void *to, const char *value)
{
    (void)value;
    ((struct render_options *)to)->view.loop = true;
    return NULL;
}

static const char *read_orbit(void *to, const char *value)
{
    double turns;
    if (!read_number(value, -100.0, 100.0, &turns) || turns == 0.0)
        return "needs turns from -100 to 100, not 0";
    ((struct render_options *)to)->orbit = turns;
    return NULL;
}

static const char *read_outside(void *to, const char *value)
{
    (void)value;
    ((struct render_options *)to)->view.files = MODEL_FILES_ANYWHERE;
    return NULL;
}

static const char *read_double_sided(void *to, const char *value)
{
    (void)value;
    ((struct render_options *)to)->view.double_sided = true;
    return NULL;
}

static const char *read_camera(void *to, const char *value)
{
    ((struct render_options *)to)->view.camera = value;
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

static const char *read_fov(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_fov = read_number(value, 0.01, 179.0, &o->view.fov_degrees);
    return o->has_fov ? NULL : "needs degrees from 0.01 to 179";
}

static const char *read_filter(void *to, const char *value)
{
    static const char *const names[] = { "nearest", "bilinear", NULL };
    struct render_options *o = to;
    int found = read_name(value, names);
    o->has_filter = found >= 0;
    o->view.bilinear = found == 1;
    return found >= 0 ? NULL : "needs nearest or bilinear";
}

static const char *read_exposure(void *to, const char *value)
{
    static const char *const names[] = { "centred", "trailing", "leading", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs centred, trailing or leading";
    ((struct render_options *)to)->exposure = (smear_exposure)found;
    return NULL;
}

static const char *read_poses(void *to, const char *value)
{
    static const char *const names[] = { "previous", "shutter", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs previous or shutter";
    ((struct render_options *)to)->shutter_poses = found == 1;
    return NULL;
}

static const char *read_path(void *to, const char *value)
{
    static const char *const names[] = { "curve", "line", "origin", "screw", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs curve, line, origin or screw";
    ((struct render_options *)to)->path = (smear_path)(SMEAR_PATH_CURVE + found);
    return NULL;
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

static const char *read_samples(void *to, const char *value)
{
    long samples;
    if (!read_integer(value, 1, MAX_EXACT_SAMPLES, &samples))
        return "needs a number from 1 to 1024, with --exact to 65536";
    ((struct render_options *)to)->samples = (int)samples;
    return NULL;
}

static const char *read_exact(void *to, const char *value)
{
    (void)value;
    ((struct render_options *)to)->exact = true;
    return NULL;
}

static const char *read_budget(void *to, const char *value)
{
    struct render_options *o = to;
    long budget;
    if (!read_integer(value, 1, 2000000000, &budget))
        return "needs a number from 1 to 2000000000";
    o->budget = (uint32_t)budget;
    return NULL;
}

static const char *read_keep_still(void *to, const char *value)
{
    (void)value;
    ((struct render_options *)to)->cache_static = true;
    return NULL;
}

static const char *read_keep_display(void *to, const char *value)
{
    (void)value;
    ((struct render_options *)to)->keep_display = true;
    return NULL;
}

static bool read_departure(void *to, const char *name, const char *value)
{
    static const char *const names[] = { "fence", "corner", "box", "direction", "uniform", NULL };
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
                                                : "needs a list of fence, corner, box, direction, uniform";
}

static const char *read_quality(void *to, const char *value)
{
    static const char *const names[] = { "sketch", "draft", "balanced", "fine", NULL };
    static const int target[] = { SMEAR_SKETCH, SMEAR_DRAFT, SMEAR_BALANCED, SMEAR_FINE };
    struct render_options *o = to;
    int found = read_name(value, names);
    if (found < 0)
        return "needs sketch, draft, balanced or fine";
    o->has_quality = true;
    o->target = target[found];
    return NULL;
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

static const char *read_tile(void *to, const char *value)
{
    static const char *const names[] = { "4", "8", "16", "32", "64", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs 4, 8, 16, 32 or 64";
    ((struct render_options *)to)->tile = 4 << found;
    return NULL;
}

static const char *read_mask(void *to, const char *value)
{
    ((struct render_options *)to)->mask = value;
    return value[0] != '\0' ? NULL : "needs nodes, with commas";
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

static const char *read_light(void *to, const char *value)
{
    static const char *const names[] = { "linear", "encoded", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs linear or encoded";
    ((struct render_options *)to)->light = (smear_light_space)found;
    return NULL;
}

static const char *read_clear(void *to, const char *value)
{
    struct render_options *o = to;
    o->has_clear = read_color(value, &o->clear);
    return o->has_clear ? NULL : "needs RRGGBB, six hexadecimal digits";
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

static const char *read_edges(void *to, const char *value)
{
    static const char *const names[] = { "hard", "smooth", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs hard or smooth";
    ((struct render_options *)to)->edges = (smear_edges)found;
    return NULL;
}

const char *const option_formats[] = { "rgb888", "rgb565", "rgb565be", "rgb555", "rgb332",
                                            "l8", "l4", "l1", "l1pages", NULL };

static const char *read_format(void *to, const char *value)
{
    int found = read_name(value, option_formats);
    if (found < 0)
        return "needs rgb888, rgb565, rgb565be, rgb555, rgb332, l8, l4, l1 or l1pages";
    ((struct render_options *)to)->format = (smear_format)found;
    return NULL;
}

const char *const option_dithers[] = { "ordered", "none", "blue", "diffuse", NULL };

static const char *read_dither(void *to, const char *value)
{
    int found = read_name(value, option_dithers);
    if (found < 0)
        return "needs none, ordered, blue or diffuse";
    ((struct render_options *)to)->dither = (smear_dither)found;
    return NULL;
}

const char *const option_doubles[] = { "1x1", "2x1", "1x2", "2x2", NULL };

static const char *read_double(void *to, const char *value)
{
    int found = read_name(value, option_doubles);
    if (found < 0)
        return "needs 1x1, 2x1, 1x2 or 2x2";
    ((struct render_options *)to)->doubled = (smear_doubled)found;
    return NULL;
}

static const char *read_arena(void *to, const char *value)
{
    long bytes;
    if (!read_integer(value, 1, LONG_MAX, &bytes))
        return "needs a number of bytes";
    ((struct render_options *)to)->arena = (size_t)bytes;
    return NULL;
}

static const char *read_threads(void *to, const char *value)
{
    long threads;
    if (!read_integer(value, 1, 8, &threads))
        return "needs a number from 1 to 8";
    ((struct render_options *)to)->threads = (int)threads;
    return NULL;
}

static const char *read_repeat(void *to, const char *value)
{
    long repeat;
    if (!read_integer(value, 1, 100000, &repeat))
        return "needs a number from 1 to 100000";
    ((struct render_options *)to)->repeat = (int)repeat;
    return NULL;
}

static const char *read_output(void *to, const char *value)
{
    ((struct render_options *)to)->output = value;
    return value[0] != '\0' ? NULL : "needs a file name";
}

static const char *read_depth(void *to, const char *value)
{
    ((struct render_options *)to)->depth = value;
    return value[0] != '\0' ? NULL : "needs a file name";
}

static const char *read_velocity(void *to, const char *value)
{
    ((struct render_options *)to)->velocity = value;
    return value[0] != '\0' ? NULL : "needs a file name";
}

static const char *read_stats(void *to, const char *value)
{
    ((struct render_options *)to)->stats = value;
    return value[0] != '\0' ? NULL : "needs a file name";
}

static const struct option table[] = {
    { "--size", true, read_size_option },
    { "--fps", true, read_fps },
    { "--frames", true, read_frames },
    { "--time", true, read_time },
    { "--clip", true, read_clip },
    { "--loop", false, read_loop },
    { "--orbit", true, read_orbit },
    { "--outside", false, read_outside },
    { "--double-sided", false, read_double_sided },
    { "--camera", true, read_camera },
    { "--eye", true, read_eye },
    { "--look", true, read_look },
    { "--fov", true, read_fov },
    { "--shutter", true, read_shutter },
    { "--exposure", true, read_exposure },
    { "--poses", true, read_poses },
    { "--path", true, read_path },
    { "--method", true, read_method },
    { "--samples", true, read_samples },
    { "--exact", false, read_exact },
    { "--reconstruct", true, read_reconstruct },
    { "--inside", true, read_inside },
    { "--camera-step", true, read_camera_step },
    { "--pingpong", true, read_pingpong },
    { "--weights", true, read_weights },
    { "--budget", true, read_budget },
    { "--keep-still", false, read_keep_still },
    { "--keep-display", false, read_keep_display },
    { "--scatter", false, read_scatter },
    { "--scale", true, read_scale },
    { "--quality", true, read_quality },
    { "--target", true, read_target },
    { "--reach", true, read_reach },
    { "--tile", true, read_tile },
    { "--mask", true, read_mask },
    { "--motion", true, read_motion },
    { "--cut", true, read_cut },
    { "--shutter-mode", true, read_shutter_mode },
    { "--light", true, read_light },
    { "--filter", true, read_filter },
    { "--clear", true, read_clear },
    { "--fog", true, read_fog },
    { "--edges", true, read_edges },
    { "--format", true, read_format },
    { "--dither", true, read_dither },
    { "--double", true, read_double },
    { "--arena", true, read_arena },
    { "--threads", true, read_threads },
    { "--repeat", true, read_repeat },
    { "-o", true, read_output },
    { "--depth", true, read_depth },
    { "--velocity", true, read_velocity },
    { "--stats", true, read_stats },
    { NULL, false, NULL },
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
        { "--double-sided", o->view.double_sided },
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

static int check_outputs(struct render_options *o)
{
    long frames = o->last - o->first + 1;
    if (o->output == NULL && o->stats == NULL && o->repeat == 0) {
        char stem[280];
        if (!source_stem(o->scene, stem, sizeof stem) || strchr(stem, '%') != NULL)
            return say_bad_usage("-o", "is needed for a scene of this name");
        snprintf(o->default_output, sizeof o->default_output, "%s.png", stem);
        o->output = o->default_output;
    }
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
