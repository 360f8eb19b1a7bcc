/* SPDX-License-Identifier: MIT */
/* sink.h - where frames go: one picture, numbered pictures, or an animation. */
#ifndef SMEAR_TOOLS_CLI_SINK_H
#define SMEAR_TOOLS_CLI_SINK_H

#include "tools/image/image.h"

#include <stdbool.h>

enum sink_kind { SINK_PNG, SINK_PPM, SINK_PFM, SINK_GIF, SINK_APNG };

struct sink {
    const char *path;           /* with the frame pattern, if it has one; null: not wanted */
    enum sink_kind kind;
    bool has_pattern;           /* %d or %0Nd: the frame's index */
    double fps;
    struct animation_writer *animation;
    long frames;                /* added */
    char name[4096];            /* of the file written last */
};

/* Understands `path` (given by `option`), to which `frames` frames shall go; `floats_only` allows
 * nothing but PFM. Looks at nothing but the name. Returns a status. */
int sink_open(struct sink *sink, const char *option, const char *path, long frames,
              bool floats_only);

/* Adds the picture of frame `index`; `floats` goes into PFM files instead when it is not null. On
 * failure sink->name tells which file. Animations are complete only after sink_end. */
bool sink_add(struct sink *sink, const struct image *picture, const struct float_image *floats,
              long index, struct failure *f);
bool sink_end(struct sink *sink, struct failure *f);

/* Leaves no unfinished file behind; harmless after sink_end and on a zeroed sink. */
void sink_cancel(struct sink *sink);

#endif
