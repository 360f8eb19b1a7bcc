/* SPDX-License-Identifier: MIT */
/* sound.h - what a game needs of a machine to be heard: a tone, as an engine's, and a noise, as of a blow. A port has one file that
 * defines sound_play(); common/silence.c is for those that cannot. */
#ifndef SMEAR_SOUND_H
#define SMEAR_SOUND_H

#include <stdint.h>

enum { SOUND_HZ = 15000, SOUND_FRAME = SOUND_HZ / 30 /* samples of 1/30 s */ };

struct sound_tone {
    uint16_t hertz;
    uint8_t loudness;               /* 0: silent, 255 */
    uint8_t blow;                   /* how loud a blow falls at the beginning of the frame; 0: none */
};

/* Is heard for 1/30 s, after what was played before, or from now on where a machine has no samples. */
void sound_play(const struct sound_tone *tone);

/* ------------------------------------------------------------------ for machines that play samples: sound.c */

/* Zero is its beginning. */
struct sound_voice {
    uint32_t phase, noise;
    int32_t low, blow;
};

/* Makes the next `count` samples of what a tone sounds like. */
void sound_samples(struct sound_voice *voice, const struct sound_tone *tone, int16_t *sample, int count);

#endif
