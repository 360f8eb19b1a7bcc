/* SPDX-License-Identifier: MIT */
/* sight.h - what of a scene a camera sees, and why not the rest. */
#ifndef SMEAR_TOOLS_SIGHT_H
#define SMEAR_TOOLS_SIGHT_H

#include "tools/scenes/scene.h"

/* Triangles of an instant, each counted once: by the first reason for which it is not seen, or as one that faces the camera. */
struct sight {
    int triangles;
    int transparent;            /* wholly, by the alpha of their material */
    int near, far, beside;      /* before the near plane or behind the camera; beyond the far plane; beyond a side of the view */
    int backs;                  /* turned away, and not double-sided */
    int facing;
    int pixels, back_pixels;    /* of a small picture: covered by anything; where a back is nearest, and so left out */
};

/* `aspect`: the picture's width / height. Hidden draws do not count. Without memory `pixels` stays 0. */
void sight_find(const struct scene_instant *instant, double aspect, struct sight *out);

#endif
