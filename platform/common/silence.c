/* SPDX-License-Identifier: MIT */
/* silence.c - sound.h where nothing is heard. */
#include "platform/sound.h"

void sound_play(const struct sound_tone *tone)
{
    (void)tone;
}
