/* SPDX-License-Identifier: MIT */
/* builtin.h - the makers of built-in scenes, one per family; catalog.c lists what each can make. */
#ifndef SMEAR_TOOLS_SCENES_BUILTIN_H
#define SMEAR_TOOLS_SCENES_BUILTIN_H

#include "tools/scenes/scene.h"

bool peer_make(const char *name, struct scene *out, struct failure *f);
bool demo_make(const char *name, struct scene *out, struct failure *f);
bool suite_make(const char *name, struct scene *out, struct failure *f);
bool trial_make(const char *name, struct scene *out, struct failure *f);

#endif
