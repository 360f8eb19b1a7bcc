/* SPDX-License-Identifier: MIT */
/* dioramas.h - the scenes of the demo that are made of model files. All repeat after their loop. */
#ifndef SMEAR_TOOLS_DEMO_DIORAMAS_H
#define SMEAR_TOOLS_DEMO_DIORAMAS_H

#include "tools/demo/diorama.h"

extern const struct diorama_kind diorama_rally;     /* trucks on a forest track, camera alongside */
extern const struct diorama_kind diorama_pass;      /* the same trucks rush past a still camera */
extern const struct diorama_kind diorama_chase;     /* robot and fox run along the built-in track */
extern const struct diorama_kind diorama_dance;     /* robot dances before fans */
extern const struct diorama_kind diorama_wind;      /* fans in the wind */
extern const struct diorama_kind diorama_coins;     /* platform game: jump, coins */

enum { RALLY_LOOP_FRAMES = 60 };

#endif
