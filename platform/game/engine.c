/* SPDX-License-Identifier: MIT */
/* engine.c - see engine.h. */
#include "platform/game/engine.h"

struct sound_tone engine_tone(const struct race *race)
{
    enum { GEARS = 5, IDLE = 48, HIGHER = 14, RANGE = 70 };     /* hertz: standing, by gear, and from a gear's bottom to its top */
    const int32_t of_gear = race_top_speed() / GEARS + 1, speed = race->car[0].speed, gear = speed / of_gear;
    return (struct sound_tone){ .hertz = (uint16_t)(IDLE + HIGHER * gear + RANGE * (speed - gear * of_gear) / of_gear),
                                .loudness = (uint8_t)(90 + 120 * (speed / 64) / (race_top_speed() / 64)),
                                .blow = race->struck ? 200 : 0 };
}
