/* SPDX-License-Identifier: MIT */
/* methods.c - see methods.h. */
#include "tools/scenes/methods.h"

#include <stdio.h>
#include <string.h>

const struct method method_list[] = {
    { .name = "none", .method = SMEAR_NONE, .help = "the sharp instant", .tile_color = 0x505050,
      .label = "sharp", .hint = "One instant. What every small renderer shows.", .curve = "", .color = "#ffffff" },
    { .name = "accumulate", .method = SMEAR_ACCUMULATE, .help = "the mean of sharp instants",
      .tile_color = 0xffffff, .label = "accumulate",
      .hint = "The mean of whole sharp frames: what you would write yourself.", .samples = { 4, 8, 16 },
      .curve = "accumulate: N whole frames", .color = "#a9b2c3" },
    { .name = "reconstruct", .method = SMEAR_RECONSTRUCT, .help = "tile-maximum reconstruction filter",
      .tile_color = 0xffe030, .label = "reconstruct",
      .hint = "The filter of GPU engines: one sharp frame, smeared along its motion.", .samples = { 4, 8, 16 },
      .curve = "reconstruct: N taps", .color = "#f0b429" },
    { .name = "subframes", .method = SMEAR_SUBFRAMES, .help = "tiles in which something moves: mean of instants",
      .tile_color = 0x2080ff, .label = "subframes",
      .hint = "Only tiles in which something moves are drawn at several instants.", .samples = { 8, 16, 32 },
      .curve = "subframes: up to N", .color = "#35c48d" },
    { .name = "timemask", .method = SMEAR_TIMEMASK,
      .help = "the time each triangle covers each pixel; cutouts,\nblended draws and what passes the eye as in subframes",
      .tile_color = 0xc040ff, .label = "timemask",
      .hint = "For each pixel, the time samples in which each triangle covers it.", .samples = { 8, 16, 32 },
      .curve = "timemask: N samples", .color = "#5aa9f5" },
    { .name = "camera", .method = SMEAR_CAMERA, .help = "velocity from depth and two cameras, then a filter",
      .tile_color = 0xff9020, .label = "camera",
      .hint = "The camera's motion alone, told from depth: nothing is done per vertex.", .samples = { 4, 8, 16 },
      .curve = "camera: from depth", .color = "#d8875a" },
    { .name = "pingpong", .method = SMEAR_PINGPONG, .help = "few taps, two or three times over",
      .tile_color = 0xb07040, .label = "ping-pong", .hint = "Few taps, twice over: the second round smooths the first.",
      .curve = "ping-pong: 8 and 8 taps", .color = "#a6d854" },
    { .name = "half", .method = SMEAR_HALF, .help = "a filter at half the size, blended by motion",
      .tile_color = 0xff4020, .label = "half", .hint = "reconstruct at half the size, mixed in by the amount of motion.",
      .samples = { 4, 8, 16 }, .curve = "half: at half the size", .color = "#e59ad6" },
    { .name = "object", .method = SMEAR_OBJECT,
      .help = "each moving object along its one velocity, by sums along\nlines, over the still scene",
      .tile_color = 0xffb0d8, .label = "object",
      .hint = "Each moving object along its one velocity, over the still scene: long streaks cost no more.",
      .curve = "object: one velocity each", .color = "#66d9ef" },
    { .name = "layered", .method = SMEAR_LAYERED,
      .help = "what moves by the velocities of its pixels, over the still\nscene",
      .tile_color = 0xff30a0, .label = "layered", .hint = "What moves, by velocities of its pixels, over the still scene.",
      .samples = { 4, 8, 16 }, .curve = "layered: N taps", .color = "#b79cf0" },
    { .name = "auto", .method = SMEAR_AUTO, .help = "per tile the cheapest that is good enough [auto]",
      .label = "auto", .hint = "Each tile gets the cheapest method that is good enough.",
      .curve = "auto", .color = "#ff7ab8" },
};
const int method_count = sizeof method_list / sizeof *method_list;

const struct method *method_named(const char *name)
{
    for (int i = 0; i < method_count; i++)
        if (strcmp(method_list[i].name, name) == 0)
            return &method_list[i];
    return NULL;
}

const struct method *method_of(smear_method method)
{
    for (int i = 0; i < method_count; i++)
        if (method_list[i].method == method)
            return &method_list[i];
    return NULL;
}

const char *method_names(void)
{
    static char text[256];
    size_t at = 0;
    for (int i = 0; i < method_count && at < sizeof text; i++)
        at += (size_t)snprintf(text + at, sizeof text - at, "%s%s", i == 0 ? "" : i < method_count - 1 ? ", " : " or ",
                               method_list[i].name);
    return text;
}
