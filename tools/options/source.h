/* SPDX-License-Identifier: MIT */
/* source.h - what a SCENE on the command line names: a model file, or `builtin:NAME`. */
#ifndef SMEAR_TOOLS_CLI_SOURCE_H
#define SMEAR_TOOLS_CLI_SOURCE_H

#include "tools/model/model.h"
#include "tools/scenes/present.h"

#include <stdbool.h>

/* How a scene is to be seen; only files have a choice. */
struct source_view {
    const char *clip;           /* --clip; null: the first, if there is one */
    const char *camera;         /* --camera; null: the first, if there is one */
    bool loop, has_eye, bilinear, double_sided;
    enum model_files files;     /* --outside: anywhere */
    double eye[3], look[3], fov_degrees;
    double aspect;
    struct scene_shadow shadow; /* light all 0: the file's, or the library's sun */
};

struct source {
    const char *name;           /* as on the command line */
    bool is_file;               /* has a model */
    struct model model;
    struct scene scene;
};

/* The name behind `builtin:`, or null for a file. */
const char *source_builtin_name(const char *name);

/* Loads the file and makes the scene. A warning of the loader is printed when the command is done. After success, free with
 * source_close; returns a status. */
int source_open(const char *name, const struct source_view *view, struct source *out);
void source_close(struct source *source);

/* The lights of a file, at rest; none where it has none, or is no file. A status. */
int source_lights(const struct source *source, struct present_lights *lights);

/* Frames after which it begins again: one clip or all, as `view` has chosen them, or a scene that repeats in a whole
 * number of frames. 0: it does not. */
long source_period(const struct source *source, const struct source_view *view, double fps);

/* The motion of each draw of an instant, by `NODE=full|camera|none` settings: each holds for the
 * node (by name, else by index) and all below it, later ones over earlier ones. A status. */
int source_motion(const struct source *source, const char *const *setting, int setting_count,
                  const struct scene_instant *instant, uint8_t *motion);

/* Layers (smear_draw.layers) of each draw of an instant, by a list of nodes with commas: those and
 * all below them are masked. A status. */
enum { SOURCE_UNMASKED = 1, SOURCE_MASKED = 2 };
int source_mask(const struct source *source, const char *nodes, const struct scene_instant *instant,
                uint8_t *layers);

/* `FILE has no such KIND`, and what there is; a status. */
int source_say_no_clip(const struct model *model, const char *name);
int source_say_no_node(const struct model *model, const char *option, const char *name);

/* "demo-race" of builtin:demo/race, "fox" of models/fox.glb; false when it does not fit. */
bool source_stem(const char *name, char *out, size_t size);

#endif
