/* SPDX-License-Identifier: MIT */
/* present.h - hands a scene (floating point) to the library (fixed point). Host only.
 *
 * Every surface is converted once, on first sight; a frame then only needs matrices, cameras and
 * the positions of deformed draws. What is handed over:
 *
 *   world       a power of two times the scene's world, seen from a point of reference: the
 *               camera's place now. Chosen for each frame from that frame's poses alone, so that
 *               the near plane lies at 1 to 2 units where that leaves everything within 30000, and
 *               so that a picture never depends on which frames were drawn before it
 *   positions   the whole range of int16 over the bounds, one step for all axes; surfaces of one
 *               node share their grid, so that no crack opens between its materials. Deformed draws
 *               are quantised anew in every frame, with one grid for all its poses
 *   transforms  a power of two of each draw's matrix goes into its mesh's shift, so that the
 *               largest entry of the basis lies in (1/2, 1]
 *   uv          the finest step at which the range fits. Repeated textures are moved by whole
 *               repeats (mirrored ones by pairs): first all of the surface alike, and where that
 *               leaves less than two steps per texel, each triangle for itself, vertices being
 *               doubled where neighbours move differently
 *   colours     sRGB in 8 bits, rounded to nearest; alpha linear
 *   surfaces    of more than 65535 vertices become several meshes on one grid
 *   near plane  moved out by a power of two while everything is more than 128 times farther away;
 *               orthographic planes are drawn in to four times the depth of what there is
 *
 * All other poses are passed explicitly and every id is 0: the library keeps nothing. Only with
 * keep_ids is it used as firmware uses it: see there. */
#ifndef SMEAR_TOOLS_PRESENT_H
#define SMEAR_TOOLS_PRESENT_H

#include "tools/failure.h"
#include "tools/image/image.h"
#include "tools/scenes/backdrop.h"
#include "tools/scenes/scene.h"

#include <smear.h>
#include <smear_scene.h>
#include <stdbool.h>
#include <stdint.h>

/* As smear_sky. */
struct present_sky {
    bool is_wanted;
    uint32_t zenith, horizon, ground, nadir;
};

/* In scene units along the view. */
struct present_fog {
    unsigned color;                 /* 0xRRGGBB */
    double begin, end;              /* end 0: no fog */
};

/* Colours are 0xRRGGBB: what faces a light has them. In scene units. */
struct present_lights {
    bool has_sun, has_second, gloss;        /* gloss: materials show their highlights */
    unsigned sun, second, lamp;
    double sun_direction[3];        /* 3/10 of the sun comes from everywhere */
    double direction[3];            /* towards the second light */
    double place[3], reach;         /* reach 0: no lamp */
    bool are_of_file;               /* a lamp that is too far away for fixed point is none */
};

struct present_options {
    double fps;                     /* > 0: the other pose is 1 / fps earlier */
    double shutter_degrees;         /* rounded to whole degrees; below half a degree: SMEAR_NONE */
    smear_exposure exposure;
    bool shutter_poses;             /* give the poses at shutter open and close, not a frame ago */
    smear_path path;                /* how poses of frames ago are joined */
    bool instant_only;              /* give no other pose: nothing moves */
    bool cut;                       /* no motion in this frame */
    bool texels_565;                /* textures without alpha are handed over as RGB565; of surfaces
                                     * that are new in this frame */
    smear_method method;
    int samples;                    /* 0: the library's default */
    smear_light_space light;
    uint32_t clear;                 /* 0xRRGGBB */
    struct backdrop_colors backdrop;        /* one more draw, the last, of a background of two colours */
    struct present_fog fog;
    struct present_lights lights;
    struct present_sky sky;
    smear_edges edges;              /* of SMEAR_AUTO and SMEAR_SUBFRAMES, and of truths (player/exact.h) */
    int reconstruct;                /* SMEAR_FENCE | ... */
    uint32_t budget;                /* of SMEAR_AUTO; 0: none */
    int target;                     /* of SMEAR_AUTO, 1/64 codes; 0: the library's default */
    smear_filter_kind filter;            /* of SMEAR_CAMERA and SMEAR_HALF */
    int camera_step;                /* 1, 2, 4: still draws take their velocity from depth */
    smear_pingpong pingpong;
    smear_weights weights;
    int turn_scale, way_scale, object_scale;        /* as in smear_frame */
    smear_shutter_mode shutter_mode;                /* likewise: what the library makes of a frame time, */
    int frame_us, shutter_us;                       /* without shutter_poses */
    const uint8_t *shutter;         /* SMEAR_SHUTTER_POINTS of openness; null: a box */
    bool keep_ids;                  /* rigid draws get ids, and neither they nor the camera get an
                                     * earlier pose: the library has kept it. Scale and reference of
                                     * the world stay those of the presenter's first frame */
    const uint8_t *motion;          /* enum scene_motion of each draw of the scene; null: full */
    int motion_count;               /* draws beyond it are full */
    const uint8_t *layers;          /* smear_draw.layers of each draw of the scene; null: all 0 */
    int layers_count;               /* draws beyond it have 0 */
    const smear_layer *layer;       /* of SMEAR_OBJECT and SMEAR_LAYERED; null: the default */
    int layer_count;
};

/* A frame as the library sees it. Belongs to the presenter; valid until its next frame. */
struct presented {
    smear_frame frame;              /* its cameras and its fog are those below */
    smear_fog fog;
    smear_light sun;
    smear_lights lights;
    smear_sky sky;
    smear_scene extras;             /* of which the frame's scene may be */
    smear_camera camera[3];         /* now, open, close */
    int draw_count;
    const smear_draw *draw;
    uint32_t triangle_count;        /* submitted */
    double world_scale;             /* library units per scene unit, a power of two */
    double near_plane, far_plane;   /* as given to the library, in its units */
    double camera_back;             /* library units an orthographic camera was moved back by */
    bool orthographic;
    bool has_backdrop;              /* is the last draw */
};

struct presenter;

/* The scene must outlive the presenter. Null when out of memory. */
struct presenter *presenter_new(struct scene *scene, struct failure *f);
void presenter_free(struct presenter *presenter);

/* Poses the scene at `time` and at the other instants the options ask for; null on failure. */
const struct presented *presenter_frame(struct presenter *presenter, double time,
                                        const struct present_options *options, struct failure *f);

/* smear_begin and every smear_submit; integers only. May be repeated. The first error ends it. */
int presented_submit(const struct presented *presented, smear_context *ctx);

/* A desc that has room for this frame at this size (max_draws, max_triangles; its method, passes); the rest is zero. */
smear_desc presented_desc(const struct presented *presented, int width, int height);

/* Gives a desc whose tile or strip is 0 the one that pictures of the command line are drawn with, whatever the library's own defaults
 * are: pictures depend on them a little. `wide`: a row is cut into as few strips as there are of 256 px, all of one width, as what lies
 * across their border is made ready in both. Else strips are of 128 px, as boards have the memory for; golden frames are drawn so. */
void present_tiles(smear_desc *desc, bool wide);

/* Distance along the view in scene units of a depth code; infinity for the background. */
double presented_depth(const struct presented *presented, uint16_t code);

/* The interval in which the shutter is open, in seconds. */
void present_exposure(double time, const struct present_options *options, double *open,
                      double *close);

/* sRGB (IEC 61966-2-1): linear 0..1 to 0..255, rounded to nearest, and back. */
uint8_t present_srgb_encode(double linear);
double present_srgb_decode(uint8_t code);

#endif
