/* SPDX-License-Identifier: MIT */
/* unseen.c - see unseen.h. */
#include "tools/player/unseen.h"

#include "tools/scenes/sight.h"

#include <stdio.h>
#include <string.h>

static bool is_of_one_color(const struct image *picture)
{
    size_t bytes = (size_t)picture->width * (size_t)picture->height * 4;
    return memcmp(picture->rgba, picture->rgba + 4, bytes - 4) == 0;
}

/* Whether the sharp frame has a pixel that is not of the colour it begins with: of one that the picture does not have. */
static bool leaves_a_trace(const struct unseen_frame *frame, bool *trace, struct failure *f)
{
    const struct device_setup setup = { .width = frame->width, .height = frame->height, .threads = 1,
                                        .methods = SMEAR_SET(SMEAR_NONE), .format = SMEAR_XRGB8888 };
    struct present_options options = *frame->options;
    struct device device;
    const uint8_t *was = frame->picture->rgba;
    const uint8_t clear[3] = { was[0] ^ 128, was[1] ^ 128, was[2] ^ 128 };
    options.method = SMEAR_NONE;
    options.instant_only = true;
    options.edges = SMEAR_EDGES_HARD;
    options.fog = (struct present_fog){ .end = 0.0 };
    options.backdrop.is_wanted = false;
    options.clear = (uint32_t)clear[0] << 16 | (uint32_t)clear[1] << 8 | clear[2];
    bool ok = device_open(&device, &setup, f);
    const struct presented *presented = ok ? presenter_frame(frame->presenter, frame->time, &options, f) : NULL;
    ok = presented != NULL && device_fit(&device, presented, f) && device_draw(&device, presented, f);
    *trace = false;
    for (int y = 0; ok && y < device.height; y++)
        for (int x = 0; x < device.width && !*trace; x++)
            *trace = memcmp(device.pixels + (size_t)y * device.stride + 4 * (size_t)x,
                            device.pixels, 4) != 0;
    if (ok && !*trace) {                /* of one colour, too: that of a thing that fills the view, or the one it began with */
        uint32_t pixel;
        memcpy(&pixel, device.pixels, sizeof pixel);
        *trace = (pixel & 0xffffffu) != options.clear;
    }
    device_close(&device);
    return ok;
}

static bool find_sight(const struct unseen_frame *frame, struct sight *sight, struct failure *f)
{
    struct scene_instant instant = { 0 };
    bool ok = scene_pose(frame->scene, frame->time, &instant, f);
    if (ok)
        sight_find(&instant, (double)frame->width / frame->height, sight);
    scene_instant_free(frame->scene, &instant);
    return ok;
}

static void explain(const struct sight *s, char *text, size_t size)
{
    const struct { int count; const char *what; } reasons[] = {
        { s->transparent, "wholly transparent" }, { s->near, "behind the camera or before its near plane" },
        { s->far, "beyond its far plane" }, { s->beside, "beside its view" },
        { s->backs, "turned away (--double-sided shows backs)" }, { s->facing, "too small for a pixel, or clear" },
    };
    int length = snprintf(text, size, "nothing is seen of %d triangle%s:", s->triangles, s->triangles > 1 ? "s" : "");
    const char *before = " ";
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++) {
        if (reasons[i].count == 0)
            continue;
        length += snprintf(text + length, size - (size_t)length, "%s%d %s %s", before, reasons[i].count,
                           reasons[i].count > 1 ? "are" : "is", reasons[i].what);
        before = ", ";
    }
}

bool unseen_look(struct unseen *unseen, const struct unseen_frame *frame, struct failure *f)
{
    struct sight sight = { 0 };
    bool is_first = unseen->frames++ == 0, trace = frame->is_covered;
    if (is_first && !frame->has_sides) {
        if (!find_sight(frame, &sight, f))
            return false;
        unseen->is_inside_out = 2 * sight.back_pixels > sight.pixels;
    }
    const bool may_be_empty = frame->options->backdrop.is_wanted || is_of_one_color(frame->picture);
    if (trace && may_be_empty && !leaves_a_trace(frame, &trace, f))
        return false;
    if (trace)
        return true;
    if (unseen->empty == 0) {
        if (!find_sight(frame, &sight, f))
            return false;
        if (sight.triangles == 0)
            return true;
        unseen->first = frame->number;
        explain(&sight, unseen->why, sizeof unseen->why);
    }
    unseen->empty++;
    return true;
}

bool unseen_tell(const struct unseen *unseen, char *text, size_t size)
{
    if (unseen->empty > 0 && unseen->frames > 1)
        snprintf(text, size, "in %ld of %ld frames, %ld the first, %s", unseen->empty, unseen->frames, unseen->first, unseen->why);
    else if (unseen->empty > 0)
        snprintf(text, size, "%s", unseen->why);
    else if (unseen->is_inside_out)
        snprintf(text, size, "most of what is nearest is turned away and left out: faces are wound inwards (--double-sided shows backs)");
    return unseen->empty > 0 || unseen->is_inside_out;
}
