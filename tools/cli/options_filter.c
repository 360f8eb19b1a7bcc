/* SPDX-License-Identifier: MIT */
/* options_filter.c - see options_filter.h. */
#include "options_filter.h"

#include "say.h"

#include <math.h>
#include <string.h>

const char *read_inside(void *to, const char *value)
{
    static const char *const names[] = { "mean", "reconstruct", "pingpong", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs mean, reconstruct or pingpong";
    ((struct render_options *)to)->filter = (smear_filter)(SMEAR_FILTER_MEAN + found);
    return NULL;
}

const char *read_camera_step(void *to, const char *value)
{
    static const char *const names[] = { "1", "2", "4", NULL };
    int found = read_name(value, names);
    if (found < 0)
        return "needs 1, 2 or 4";
    ((struct render_options *)to)->camera_step = 1 << found;
    return NULL;
}

/* One NAME=NUMBER of a list, or a name alone. */
static bool read_pass_setting(smear_pingpong *p, const char *name, const char *number)
{
    static const struct {
        const char *name;
        size_t field;
        long low, high;
    } settings[] = {
        { "passes", offsetof(smear_pingpong, passes), 1, 3 }, { "taps", offsetof(smear_pingpong, taps), 2, 64 },
        { "base", offsetof(smear_pingpong, base), 2, 64 },    { "bias", offsetof(smear_pingpong, bias), 1, 255 },
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
    for (;;) {
        char setting[32];
        size_t length = strcspn(value, ",");
        if (length >= sizeof setting)
            length = 0;
        memcpy(setting, value, length);
        setting[length] = '\0';
        char *number = strchr(setting, '=');
        if (number != NULL)
            *number++ = '\0';
        if (!read_pass_setting(&o->pingpong, setting, number))
            return "needs a list of passes=1..3, taps=2..64, base=2..64, bias=1..255, jitter=0..1, spread";
        if (value[strcspn(value, ",")] == '\0')
            return NULL;
        value += length + 1;
    }
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
    return STATUS_OK;
}
