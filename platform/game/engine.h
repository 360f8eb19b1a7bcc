/* SPDX-License-Identifier: MIT */
/* engine.h - what a race sounds like. */
#ifndef GAME_ENGINE_H
#define GAME_ENGINE_H

#include "platform/game/race.h"
#include "platform/sound.h"

/* The engine of the player's car, and a blow where it touched something in this frame of 1/30 s. */
struct sound_tone engine_tone(const struct race *race);

#endif
