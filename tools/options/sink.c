/* SPDX-License-Identifier: MIT */
/* sink.c - see sink.h. */
#include "tools/options/sink.h"

#include "tools/image/file.h"
#include "tools/player/picture.h"
#include "tools/options/say.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool find_kind(const char *path, enum sink_kind *kind)
{
    static const char *const ending[] = { ".png", ".ppm", ".pfm", ".gif", ".apng" };
    const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    for (int i = 0; i < 5 && dot != NULL && dot > name; i++) {
        if (strcasecmp(dot, ending[i]) == 0) {
            *kind = (enum sink_kind)i;
            return true;
        }
    }
    return false;
}

/* A pattern is the only use of '%' in the name: %d, or %0Nd with N from 1 to 9. */
static bool find_pattern(const char *path, bool *has_pattern)
{
    const char *percent = strchr(path, '%');
    *has_pattern = percent != NULL;
    if (percent == NULL)
        return true;
    const char *d = percent + 1;
    if (d[0] == '0' && d[1] >= '1' && d[1] <= '9')
        d += 2;
    return *d == 'd' && strchr(d, '%') == NULL;
}

int sink_open(struct sink *sink, const char *option, const char *path, long frames,
              bool floats_only)
{
    *sink = (struct sink){ .path = path };
    if (strlen(path) + 16 > sizeof sink->name)
        return say_bad_usage(option, "the name is too long");
    if (!find_kind(path, &sink->kind) || (floats_only && sink->kind != SINK_PFM))
        return say_bad_usage(option, "the name must end in %s (\"%s\")",
                             floats_only ? ".pfm" : ".png, .ppm, .pfm, .gif or .apng", path);
    if (!find_pattern(path, &sink->has_pattern))
        return say_bad_usage(option, "a %% may only be one %%d or %%04d, the frame (\"%s\")", path);
    bool moves = sink->kind == SINK_GIF || sink->kind == SINK_APNG;
    if (moves && sink->has_pattern)
        return say_bad_usage(option, "an animation holds all frames and takes no %%d (\"%s\")",
                             path);
    if (!moves && !sink->has_pattern && frames > 1)
        return say_bad_usage(option, "%ld frames do not fit into one still, use %%04d (\"%s\")",
                             frames, path);
    return STATUS_OK;
}

static void make_name(struct sink *sink, long index)
{
    const char *percent = strchr(sink->path, '%');
    if (percent == NULL) {
        snprintf(sink->name, sizeof sink->name, "%s", sink->path);
        return;
    }
    int digits = percent[1] == '0' ? percent[2] - '0' : 1;
    snprintf(sink->name, sizeof sink->name, "%.*s%0*ld%s", (int)(percent - sink->path), sink->path,
             digits, index, strchr(percent, 'd') + 1);
}

/* Milliseconds from one frame to the next; whole ones that do not drift. */
static int delay_ms(const struct sink *sink, struct failure *f)
{
    double before = floor((double)sink->frames * 1000.0 / sink->fps + 0.5);
    double after = floor((double)(sink->frames + 1) * 1000.0 / sink->fps + 0.5);
    if (after - before > 600000.0) {
        fail(f, "a frame cannot stay for more than ten minutes (--fps)");
        return -1;
    }
    return (int)(after - before);
}

static bool add_to_animation(struct sink *sink, const struct image *picture, struct failure *f)
{
    int delay = delay_ms(sink, f);
    if (delay < 0)
        return false;
    if (sink->animation == NULL)
        sink->animation =
            (sink->kind == SINK_GIF ? gif_begin : apng_begin)(sink->name, picture->width,
                                                              picture->height, f);
    return sink->animation != NULL && animation_add(sink->animation, picture, delay, f);
}

static bool save_floats(const struct sink *sink, const struct image *picture, struct failure *f)
{
    struct float_image floats;
    if (!picture_to_floats(picture, &floats, f))
        return false;
    bool ok = pfm_save(sink->name, &floats, f);
    float_image_free(&floats);
    return ok;
}

bool sink_add(struct sink *sink, const struct image *picture, const struct float_image *floats,
              long index, struct failure *f)
{
    make_name(sink, index);
    if (!file_is_replaceable(sink->name, f))
        return false;
    bool ok = false;
    switch (sink->kind) {
    case SINK_PNG: ok = png_save(sink->name, picture, f); break;
    case SINK_PPM: ok = ppm_save(sink->name, picture, f); break;
    case SINK_PFM:
        ok = floats != NULL ? pfm_save(sink->name, floats, f) : save_floats(sink, picture, f);
        break;
    case SINK_GIF:
    case SINK_APNG: ok = add_to_animation(sink, picture, f); break;
    }
    sink->frames++;
    return ok;
}

bool sink_end(struct sink *sink, struct failure *f)
{
    struct animation_writer *animation = sink->animation;
    sink->animation = NULL;
    return animation == NULL || animation_end(animation, f);
}

void sink_cancel(struct sink *sink)
{
    animation_cancel(sink->animation);
    sink->animation = NULL;
}
