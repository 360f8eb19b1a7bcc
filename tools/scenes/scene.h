/* SPDX-License-Identifier: MIT */
/* scene.h - what is drawn, as a function of time, in floating point. Host only.
 *
 * Everything that draws on the host starts from a scene: files (scene_from_model), the built-in
 * scenes of tests, bench and demo (pure functions of time), and it ends in two places: present.h
 * hands it to the library in fixed point, tools/ref/ draws it in double precision. Both see
 * the same floats. */
#ifndef SMEAR_TOOLS_SCENE_H
#define SMEAR_TOOLS_SCENE_H

#include "tools/failure.h"
#include "tools/image/image.h"
#include "tools/model/model.h"

#include <stdbool.h>
#include <stdint.h>

/* What things cast on the ground, a level plane through their lowest point: a round one under all of them, or each its own. */
enum scene_shadow_kind { SCENE_SHADOW_NONE, SCENE_SHADOW_BLOB, SCENE_SHADOW_PLANAR };

struct scene_shadow {
    enum scene_shadow_kind kind;
    double darkness;                /* 0 to 1 */
    double light[3];                /* towards the sun, of any length: planar */
};

struct scene_material {
    const struct image *image;      /* base colour texture, sRGB; or null */
    enum model_wrap wrap_u, wrap_v;
    float base[4];                  /* linear */
    enum model_alpha alpha;
    float alpha_cutoff;
    bool double_sided, unlit, bilinear;
    uint8_t gloss, shine;           /* as smear_material has them */
    enum scene_shadow_kind shadow;  /* its alpha in `base` is how dark; a blob's image tells the size alone */
};

/* Geometry that keeps its shape: a mesh at rest. A surface stays where it is in memory for as
 * long as its scene lives, so its address may serve as a key. */
struct scene_surface {
    int vertex_count, triangle_count;
    const float *position;          /* 3 per vertex */
    const float *normal;            /* 3 per vertex, any length; or null: flat */
    const float *uv;                /* 2 per vertex, row 0 of the image is v = 0; or null */
    const float *color;             /* 4 per vertex, linear; or null */
    const float *face_color;        /* 4 per triangle, linear, in place of vertex colours
                                     * (`color` is then null); or null */
    const uint32_t *index;          /* 3 per triangle, counter-clockwise in front */
    struct scene_material material;
};

enum scene_motion { SCENE_MOTION_FULL, SCENE_MOTION_CAMERA, SCENE_MOTION_NONE };

/* A surface in one place at one instant. The index of a draw in its list is its identity. */
struct scene_draw {
    const struct scene_surface *surface;
    double world[16];               /* object to world, column major */
    const float *position;          /* posed; the surface's own when rigid */
    const float *normal;            /* posed; the surface's own when rigid */
    bool deformed;
    bool hidden;                    /* not in the scene at this instant (keeps its index) */
    int epoch;                      /* differs between two instants: cut (teleported) in between */
    int node;                       /* node of the model it comes from, or -1 */
};

struct scene_camera {
    double pose[16];                /* camera to world, a rotation and an origin, column major */
    bool orthographic;
    double yfov;                    /* radians; perspective */
    double half_height;             /* world units; orthographic */
    double znear, zfar;             /* zfar 0: none */
    int epoch;                      /* differs between two instants: camera cut */
};

/* The scene at one instant. Zeroed before first use and owned by whoever asked; scene_pose
 * reuses it, for one scene only; free with scene_instant_free while the scene still lives. Every
 * instant of a scene has the same draws in the same order. */
struct scene_instant {
    double time;
    double now;                     /* the instant that a path joins this one with; else `time` */
    struct scene_camera camera;
    int draw_count;
    struct scene_draw *draw;
    void *store;                    /* the scene's own, for posed arrays */
    const void *of;                 /* the same, for what it is made of */
};

struct scene {
    const char *name;
    int width, height;              /* the size it is meant for */
    double fps, time;               /* frame rate and the instant of the frame that stands for it */
    double loop;                    /* seconds after which it looks the same again; 0: never */
    uint32_t clear;                 /* 0xRRGGBB sRGB */
    bool (*pose)(struct scene *scene, double time, struct scene_instant *out, struct failure *f);
    void (*instant_free)(struct scene *scene, struct scene_instant *instant);
    void (*destroy)(struct scene *scene);
    void *data;
};

/* `time` in seconds, any finite number. On failure `out` still wants scene_instant_free. */
bool scene_pose(struct scene *scene, double time, struct scene_instant *out, struct failure *f);
/* The same, of an instant that a blur joins with `now` by a path: what the file says jumps in between has not jumped. */
bool scene_pose_joined(struct scene *scene, double time, double now, struct scene_instant *out, struct failure *f);
void scene_instant_free(struct scene *scene, struct scene_instant *instant);
void scene_free(struct scene *scene);

/* How many pictures of this aspect the triangles of an instant would fill, hidden ones and backs counted; stops above
 * `enough`. */
double scene_cover(const struct scene_instant *instant, double aspect, double enough);

/* --- scenes from files --- */
struct scene_view {                 /* the camera and clip options of the command line */
    int clip;                       /* index, MODEL_CLIP_NONE or MODEL_CLIP_ALL */
    bool loop;
    int camera;                     /* index into model->camera, or -1: `eye` if has_eye, else the
                                     * automatic one */
    bool has_eye;
    double eye[3], look[3], fov_degrees;
    bool bilinear;
    double aspect;                  /* width / height, for the automatic camera */
    struct scene_shadow shadow;
};
/* The model must outlive the scene, whose poses fail where triangles cover the picture a thousand times over. The
 * automatic camera sees the whole clip: bounds of the poses from its start to its end, with centre c and half diagonal
 * r; yfov 45 degrees; eye = c + d normalise(0.5, 0.35, 1), d = r / sin(half the smaller of yfov and xfov); near =
 * max(d - 2r, d/100), far = d + 2r. With `eye`: near and far from the bounds as seen from there. File cameras: xfov
 * follows the aspect. Shadows lie on the ground of the whole clip; they are the last draws, of the nodes that cast them. */
bool scene_from_model(const struct model *model, const struct scene_view *view, struct scene *out,
                      struct failure *f);

/* --- built-in scenes, by name; see catalog.c for the list --- */
struct scene_entry {
    const char *name;               /* "peer/A", "suite/propeller", "demo/race" ... */
    const char *what;               /* one line */
    bool (*make)(const char *name, struct scene *out, struct failure *f);
};
extern const struct scene_entry scene_catalog[];
extern const int scene_catalog_count;
bool scene_builtin(const char *name, struct scene *out, struct failure *f);

#endif
