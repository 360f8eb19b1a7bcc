/* SPDX-License-Identifier: MIT */
/* A stand-in for Arduino's core: what sketches call of it. Its clock goes on by a thirtieth of a second each time it is read. */
#ifndef STAND_INS_ARDUINO_H
#define STAND_INS_ARDUINO_H
#include <stdint.h>

struct stand_in_serial {
    void begin(long) {}
    void println(const char *) {}
};
extern stand_in_serial Serial;
unsigned long millis();
void setup();
void loop();
#endif
