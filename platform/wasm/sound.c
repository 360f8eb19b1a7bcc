/* SPDX-License-Identifier: MIT */
/* sound.c - sound.h in a page, which takes the samples of each turn and plays them. */
#include "platform/sound.h"

#define EXPORT(name) __attribute__((export_name(#name)))

enum { ROOM = 8 * SOUND_FRAME };

static int16_t sample[ROOM];
static int used;

void sound_play(const struct sound_tone *tone)
{
    static struct sound_voice voice;
    if (used + SOUND_FRAME > ROOM)
        return;
    sound_samples(&voice, tone, sample + used, SOUND_FRAME);
    used += SOUND_FRAME;
}

EXPORT(wasm_samples) const int16_t *wasm_samples(void)
{
    return sample;
}

/* How many samples there are; afterwards there are none. */
EXPORT(wasm_take_samples) int wasm_take_samples(void)
{
    const int count = used;
    used = 0;
    return count;
}
