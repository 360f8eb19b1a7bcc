/* SPDX-License-Identifier: MIT */
/* options.h - the command line of `smear render`, checked as far as it can be without the scene. */
#ifndef SMEAR_TOOLS_CLI_OPTIONS_H
#define SMEAR_TOOLS_CLI_OPTIONS_H

#include "tools/options/apart.h"
#include "tools/options/sink.h"
#include "tools/options/source.h"
#include "tools/scenes/present.h"

#include <smear.h>
#include <stdbool.h>
#include <stddef.h>

enum { OPTIONS_MAX_MOTIONS = 256, OPTIONS_MAX_CUTS = 256 };

/* Names of smear_format, smear_dither and smear_doubled in their order, null last. */
extern const char *const option_formats[], *const option_dithers[], *const option_doubles[];

struct render_options {
    const char *scene;
    struct source_view view;

    bool has_size, has_fps, has_time, has_frames, has_clear, has_look, has_fov, has_filter;
    int width, height;
    double fps, time;
    long first, last;           /* frames; 0 and 0 without --frames */

    int shutter_degrees;        /* 0: the sharp frame */
    double shutter_seconds;     /* > 0: instead */
    smear_shutter_mode shutter_mode;
    double reference_hz;        /* of modes that are not native */
    smear_exposure exposure;
    bool shutter_poses;
    smear_path path;            /* how poses of frames ago are joined */
    smear_method method;
    int samples;                /* 0: the method's default */
    bool exact, has_quality, has_target;
    int reconstruct;            /* SMEAR_FENCE | ... */
    smear_filter_kind filter;        /* of camera and half */
    int camera_step;
    bool has_pingpong;
    smear_pingpong pingpong;
    smear_weights weights;
    bool scatter;               /* the reach may exceed the tile */
    uint32_t budget;            /* of auto, pixels x instants; 0: none */
    bool cache_static;            /* from frame to frame */
    bool keep_display;          /* the display keeps its picture: smear_desc.buffer_age */
    int turn_scale, way_scale, object_scale;    /* as in smear_frame */
    int target;                 /* of auto, 1/64 codes; 0: the library's default */
    smear_light_space light;
    unsigned clear;
    struct backdrop_colors backdrop;
    struct present_fog fog;
    struct present_lights lights;
    struct present_sky sky;
    smear_edges edges;

    double orbit;               /* turns of the camera about what it sees, over all frames; 0: none */
    int reach_px, tile;         /* 0: not given */
    double reach_percent;       /* 0: not given */
    const char *motion[OPTIONS_MAX_MOTIONS];
    int motion_count;
    const char *mask;           /* null: not given */
    long cut[OPTIONS_MAX_CUTS];
    int cut_count;

    smear_format format;
    smear_dither dither;
    smear_doubled doubled;
    size_t arena;               /* 0: not given */
    int threads;
    int repeat;                 /* 0: not given */
    const char *output, *depth, *velocity, *stats;
    struct sink picture_sink, depth_sink, velocity_sink;    /* opened; path null: not wanted */
    char default_output[300];   /* SCENE.png, when nothing else is asked for */
};

/* Reads argv (behind the command). Returns a status; *wants_help and STATUS_OK for --help. */
int options_read(struct render_options *options, int count, char **text, bool *wants_help);
/* The same for `smear view`: the scene may be missing, and nothing is checked about files. */
int options_read_seen(struct render_options *options, int count, char **text, bool *wants_help);

/* A moving picture of which no frames are said has all of the scene, `period` of them; 0: nobody knows. A status. */
int options_move(struct render_options *options, long period);

/* Where a command line that has been read writes; paths that are null stand for nothing. */
enum { OPTIONS_OUTPUTS = 4 };
void options_outputs(const struct render_options *options, struct apart_output out[OPTIONS_OUTPUTS]);

/* Reach and tile in pixels for a picture of this height, as the library wants them. A status. */
int options_reach(const struct render_options *options, int height, int *reach, int *tile);

/* The method of this name. Returns null, or what is wrong with the name. */
const char *read_method_name(const char *value, smear_method *method);

/* The name of the format as the command line has it. */
const char *options_format_name(smear_format format);

#endif
