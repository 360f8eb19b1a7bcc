/* SPDX-License-Identifier: MIT */
/* sound.c - sound.h on a Game Boy Advance: its square wave and its noise, which take no time. */
#include "platform/sound.h"

#include "platform/gba/gba.h"

#define SQUARE_LENGTH GBA_REG16(0x04000062u)    /* and duty, envelope */
#define SQUARE_PITCH GBA_REG16(0x04000064u)
#define NOISE_LENGTH GBA_REG16(0x04000078u)
#define NOISE_PITCH GBA_REG16(0x0400007cu)
#define SOUND_SIDES GBA_REG16(0x04000080u)
#define SOUND_SHARE GBA_REG16(0x04000082u)
#define SOUND_ON GBA_REG16(0x04000084u)

enum { START = 0x8000, QUARTER = 0x40, FADES = 0x0200 };

void sound_play(const struct sound_tone *tone)
{
    static uint32_t loud;
    /* A step of the pitch is 1/2048 of 1/131072 s; a write of the envelope starts the wave again, which clicks. */
    const uint32_t steps = tone->hertz > 64 ? 131072u / tone->hertz : 2047u;
    if ((SOUND_ON & 0x80) == 0) {
        SOUND_ON = 0x80;
        SOUND_SIDES = 0x9977;
        SOUND_SHARE = 2;
    }
    if (loud != tone->loudness / 32u) {
        loud = tone->loudness / 32u;
        SQUARE_LENGTH = (uint16_t)(loud << 12 | QUARTER);
        SQUARE_PITCH = (uint16_t)(START | (2048u - steps));
    } else {
        SQUARE_PITCH = (uint16_t)(2048u - steps);
    }
    if (tone->blow != 0) {
        NOISE_LENGTH = (uint16_t)((tone->blow / 16u) << 12 | FADES);
        NOISE_PITCH = START | 0x54;
    }
}
