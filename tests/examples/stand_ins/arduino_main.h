/* SPDX-License-Identifier: MIT */
/* A stand-in for Arduino's main(): a sketch's first twelve frames. Compiled as it is, or behind a sketch. */
#include "Arduino.h"

stand_in_serial Serial;

unsigned long millis()
{
    static unsigned long frames;
    return frames++ * 1000 / 30;
}

int main()
{
    setup();
    for (int i = 0; i < 12; i++)
        loop();
}
