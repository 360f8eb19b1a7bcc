/* SPDX-License-Identifier: MIT */
/* sound.c - see sound.h. A sawtooth and one an octave below, dulled; and noise that fades away. */
#include "platform/sound.h"

void sound_samples(struct sound_voice *voice, const struct sound_tone *tone, int16_t *sample, int count)
{
    enum { DULL = 2, FADE = 9 };    /* log2: samples that are averaged, and in which a blow falls to a third */
    const uint32_t step = tone->hertz * (UINT32_MAX / SOUND_HZ / 2 + 1);
    voice->blow += tone->blow << 6;
    if (voice->blow > 16383)
        voice->blow = 16383;
    for (int i = 0; i < count; i++) {
        voice->phase += step;
        voice->noise = voice->noise * 1664525u + 1013904223u;
        const int32_t high = (int32_t)(voice->phase >> 23 & 255) - 128, deep = (int32_t)(voice->phase >> 24) - 128;
        voice->low += ((high + deep) * tone->loudness / 4 - voice->low) / (1 << DULL);
        voice->blow -= (voice->blow + (1 << FADE) - 1) >> FADE;
        const int32_t blow = voice->blow * ((int32_t)(voice->noise >> 24) - 128) / 128;
        sample[i] = (int16_t)(voice->low + blow / 2);
    }
}
