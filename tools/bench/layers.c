/* SPDX-License-Identifier: MIT */
/* layers.c - surfaces of glass, and how many of them a pixel is seen through. */
#include "tools/bench/layers.h"
#include "tools/bench/remade.h"

/* 51 of 255 is dark, exactly, also where alpha has 8 bits. */
static const double clear_share = 0.8;

static void make_glass(struct scene_surface *surface)
{
    surface->color = NULL;
    surface->face_color = NULL;
    surface->material = (struct scene_material){
        .base = { 0.0f, 0.0f, 0.0f, (float)(1.0 - clear_share) }, .alpha = MODEL_ALPHA_BLEND,
        .double_sided = surface->material.double_sided, .unlit = true
    };
}

bool layers_scene(struct scene *scene, struct scene *out, struct failure *f)
{
    bool ok = remade_scene(scene, make_glass, out, f);
    if (ok)
        out->clear = 0xffffff;
    return ok;
}

int layers_from_code(double code)
{
    double here = 255.0;
    int count = 0;
    /* The border between two counts lies midway between their codes. */
    while (count <= LAYER_LIMIT && code < here * (1.0 + clear_share) / 2.0) {
        here *= clear_share;
        count++;
    }
    return count;
}
