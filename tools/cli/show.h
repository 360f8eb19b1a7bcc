/* SPDX-License-Identifier: MIT */
/* show.h - how a model looks its best: which of its clips, from where, how large, for how long. */
#ifndef SMEAR_TOOLS_CLI_SHOW_H
#define SMEAR_TOOLS_CLI_SHOW_H

#include "tools/model/model.h"
#include "tools/options/source.h"

#include <stdbool.h>

struct show {
    int clip;                   /* that moves most; MODEL_CLIP_NONE where none does: the model is turned */
    char clip_text[16];         /* its index */
    char clip_name[80];         /* may be empty */
    double fps;                 /* frames of the clip fill its duration without a rest */
    long frames;                /* of the clip, or of a turn */
    bool is_cut;                /* the clip has more */
    bool has_eye;               /* else by the file's own camera */
    double eye[3], look[3], fov_degrees;
    int width, height;          /* pixels; of the shape of what is seen */
    double spin;                /* radians per second of a turn; 0: none */
};

enum { SHOW_MOST_FRAMES = 600 };        /* of a longer clip the first 20 seconds are shown */

/* The options of `render` and `view` that draw it so: text that lies in here. */
enum { SHOW_MOST_TEXTS = 40 };
struct show_texts {
    char *text[SHOW_MOST_TEXTS];
    int count;
    char number[12][80];
    int numbers;
};

/* Adds an option and its value, which is copied where it is printed from a format. */
void show_add(struct show_texts *texts, const char *option, const char *value);
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void show_print(struct show_texts *texts, const char *option, const char *format, ...);

/* Clip, time and camera. */
void show_add_scene(struct show_texts *texts, const struct show *show);
void show_add_background(struct show_texts *texts);
/* Of edges and texels. */
void show_add_smoothness(struct show_texts *texts);

/* Chooses for a model, and for pictures of this aspect unless that is 0. False where the model has no triangles. */
bool show_choose(const struct model *model, double aspect, struct show *out, struct failure *f);

/* The same for a file, a model of which is loaded for it. A status, of what cannot be loaded; `*is_empty` where there is nothing to
 * be shown, of which `why` tells. */
int show_choose_file(const char *name, const struct source_view *view, double aspect, struct show *out, bool *is_empty,
                     struct failure *why);

#endif
