/* SPDX-License-Identifier: MIT */
/* stage.h - what every built-in scene is made of: surfaces built once, and a function that
 * places them.
 *
 * A scene's file holds a table of stage_kind. `build` makes the surfaces (build.h) and lists the
 * props; `move` is a pure function of time that says where each prop is, and where the camera,
 * for any time from -STAGE_MAX_SECONDS to STAGE_MAX_SECONDS. */
#ifndef SMEAR_TOOLS_SCENES_STAGE_H
#define SMEAR_TOOLS_SCENES_STAGE_H

#include "tools/scenes/scene.h"
#include "tools/scenes/xform.h"

#include <stddef.h>

enum { STAGE_MAX_PROPS = 192, STAGE_MAX_SECONDS = 1000000 };

struct stage;

struct stage_kind {
    const char *name;
    int width, height;
    double time;                    /* of the frame that stands for the scene */
    uint32_t clear;
    void (*build)(struct stage *stage);
    /* `out` comes with every draw in place: its surface, the identity, visible, and room for the
     * posed vertices of soft props (zeros); and with a camera of 60 degrees at the origin, near
     * 0.25, far 64. */
    void (*move)(double time, struct scene_instant *out);
};

struct stage_prop {
    const struct scene_surface *surface;
    bool soft;                      /* deformed: `move` writes positions and, if any, normals */
};

struct stage {
    const struct stage_kind *kind;
    int prop_count;
    struct stage_prop prop[STAGE_MAX_PROPS];
    void *extra;                    /* the scene's own, from stage_alloc */
    struct stage_block *memory;
    bool failed;                    /* out of memory, or more props than fit */
};

/* Zeroed memory that lives as long as the stage; null when there is none, and then the stage has
 * failed. */
void *stage_alloc(struct stage *stage, size_t bytes);

/* Adds a draw and returns its index, which is the draw's index in every instant. */
int stage_add(struct stage *stage, const struct scene_surface *surface);
int stage_add_soft(struct stage *stage, const struct scene_surface *surface);

/* A square or oblong picture whose texels stage code fills in; null when the stage has failed. */
struct image *stage_image(struct stage *stage, int width, int height);
void stage_texel(struct image *image, int x, int y, uint32_t rgb);      /* 0xRRGGBB, opaque */

/* For `move`. */
static inline const struct stage *stage_of(const struct scene_instant *out) { return (const struct stage *)out->of; }
void stage_place(struct scene_instant *out, int draw, struct xform world);
float *stage_soft_position(struct scene_instant *out, int draw);
float *stage_soft_normal(struct scene_instant *out, int draw);          /* null when flat */
void stage_camera(struct scene_instant *out, struct xform pose, double yfov_degrees);

/* Opens the kind called `name` as a scene. */
bool stage_open(const struct stage_kind *kinds, int count, const char *name, struct scene *out,
                struct failure *f);

#endif
