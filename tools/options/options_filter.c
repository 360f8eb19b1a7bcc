/* SPDX-License-Identifier: MIT */
/* options_filter.c - see options_filter.h. */
#include "tools/options/options_filter.h"

#include "tools/options/say.h"

#include <math.h>
#include <string.h>

static bool read_pass_setting(void *to, const char *name, const char *number)
{
    smear_pingpong *p = to;
    static const struct {
        const char *name;
        size_t field;
        long low, high;
    } settings[] = {
        { "passes", offsetof(smear_pingpong, passes), 1, 3 },
        { "taps", offsetof(smear_pingpong, taps), 2, 64 },
        { "base", offsetof(smear_pingpong, base), 2, 64 },
        { "bias", offsetof(smear_pingpong, bias), 1, 255 },
    };
    double jitter;
    if (number == NULL) {
        p->spread = 1;
        return strcmp(name, "spread") == 0;
    }
    if (strcmp(name, "jitter") == 0) {
        if (!read_number(number, 0.0, 1.0, &jitter))
            return false;
        p->jitter = (uint8_t)lround(jitter * 128);
        return true;
    }
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        long value;
        if (strcmp(name, settings[i].name) != 0)
            continue;
        if (!read_integer(number, settings[i].low, settings[i].high, &value))
            return false;
        ((uint8_t *)p)[settings[i].field] = (uint8_t)value;
        return true;
    }
    return false;
}

const char *read_pingpong(void *to, const char *value)
{
    struct render_options *o = to;
    o->pingpong = (smear_pingpong){ 0 };
    o->has_pingpong = true;
    if (!read_list(value, read_pass_setting, &o->pingpong))
        return "needs a list of passes=1..3, taps=2..64, base=2..64, bias=1..255, jitter=0..1, spread";
    return NULL;
}

/* A factor, to be kept as smear_frame has it. */
static bool read_scale_of(void *to, const char *name, const char *text)
{
    static const char *const names[] = { "turn", "way", "objects", NULL };
    struct render_options *o = to;
    int *const scale[] = { &o->turn_scale, &o->way_scale, &o->object_scale };
    int found = read_name(name, names);
    double factor;
    if (found < 0 || text == NULL || !read_number(text, 0.0, 63.0, &factor))
        return false;
    int q8 = (int)lround(factor * 256);
    *scale[found] = q8 == 0 ? (int)SMEAR_SCALE_NONE : q8;
    return true;
}

const char *read_scale(void *to, const char *value)
{
    return read_list(value, read_scale_of, to)
             ? NULL
             : "needs a list of turn=F, way=F, objects=F, factors from 0 to 63";
}

/* ------------------------------------------------------------------ the shutter */

/* Degrees, or seconds with an "s" or "ms" behind them. */
const char *read_shutter(void *to, const char *value)
{
    struct render_options *o = to;
    char number[32];
    size_t length = strlen(value);
    double unit = 0.0, amount;
    if (length > 1 && length < sizeof number && value[length - 1] == 's')
        unit = value[length - 2] == 'm' ? 1e-3 : 1.0;
    o->shutter_seconds = 0.0;
    if (unit > 0.0) {
        length -= unit < 1.0 ? 2 : 1;
        memcpy(number, value, length);
        number[length] = '\0';
        if (!read_number(number, 1e-6, 1000.0, &amount) || amount * unit > 1.0)
            return "needs seconds up to 1 (0.01s, 10ms)";
        o->shutter_seconds = amount * unit;
        o->shutter_degrees = 180;
        return NULL;
    }
    if (!read_number(value, 0.0, 3600.0, &amount))
        return "needs degrees from 0 to 3600, or seconds as 0.01s or 10ms";
    o->shutter_degrees = (int)lround(amount);
    return NULL;
}

const char *read_shutter_mode(void *to, const char *value)
{
    struct render_options *o = to;
    o->reference_hz = 30.0;
    if (strcmp(value, "native") == 0)
        o->shutter_mode = SMEAR_SHUTTER_NATIVE;
    else if (strcmp(value, "capped") == 0)
        o->shutter_mode = SMEAR_SHUTTER_CAPPED;
    else if (strcmp(value, "fixed") == 0)
        o->shutter_mode = SMEAR_SHUTTER_FIXED;
    else if (strncmp(value, "fixed:", 6) == 0 && read_number(value + 6, 1e-3, 1e6, &o->reference_hz))
        o->shutter_mode = SMEAR_SHUTTER_FIXED;
    else
        return "needs native, capped or fixed[:HZ]";
    return NULL;
}

double shutter_degrees_at(const struct render_options *o, double fps)
{
    double frames = 1.0, degrees;      /* times the shutter of a frame at the rate of reference */
    if (o->shutter_degrees == 0)
        return 0.0;
    if (o->shutter_mode != SMEAR_SHUTTER_NATIVE)
        frames = fps / o->reference_hz;
    if (o->shutter_mode == SMEAR_SHUTTER_CAPPED)
        frames = fmin(frames, 1.0);
    degrees = o->shutter_degrees * frames;
    if (o->shutter_seconds > 0.0) {
        degrees = o->shutter_seconds * fps * 360.0;
        if (o->shutter_mode == SMEAR_SHUTTER_CAPPED)
            degrees = fmin(degrees, 360.0);
    }
    return fmin(fmax(degrees, 0.5), 3600.0);
}

int check_filter(const struct render_options *o)
{
    bool has_inside = o->method == SMEAR_CAMERA || o->method == SMEAR_HALF;
    bool is_pingpong = o->method == SMEAR_PINGPONG || (has_inside && o->filter == SMEAR_FILTER_PINGPONG);
    bool reconstructs = o->method == SMEAR_RECONSTRUCT
                     || (o->method == SMEAR_HALF && o->filter == SMEAR_FILTER_DEFAULT)
                     || (has_inside && o->filter == SMEAR_FILTER_RECONSTRUCT);
    if (o->filter != SMEAR_FILTER_DEFAULT && !has_inside)
        return say_bad_usage("--inside", "goes with --method camera or half");
    if (o->camera_step != 0 && !smear_method_is_filter(o->method))
        return say_bad_usage("--camera-step", "goes with --method camera, half, pingpong or reconstruct");
    if (o->has_pingpong && !is_pingpong)
        return say_bad_usage("--pingpong", "goes with --method pingpong, or --inside pingpong");
    if (o->reconstruct != 0 && !reconstructs)
        return say_bad_usage("--reconstruct", "goes with --method reconstruct, or --inside reconstruct");
    if (o->weights != SMEAR_WEIGHTS_STACK && !reconstructs)
        return say_bad_usage("--weights", "goes with --method reconstruct, or --inside reconstruct");
    if (o->scatter && !(reconstructs || (o->method == SMEAR_CAMERA && !is_pingpong)))
        return say_bad_usage("--scatter",
                             "goes with --method reconstruct or camera, not with pingpong or half");
    if (o->scatter && o->method == SMEAR_HALF)
        return say_bad_usage("--scatter",
                             "goes with --method reconstruct or camera, not with pingpong or half");
    if ((o->turn_scale | o->way_scale | o->object_scale) != 0 && o->exact)
        return say_bad_usage("--scale", "contradicts --exact, which moves all as the file does");
    return STATUS_OK;
}
