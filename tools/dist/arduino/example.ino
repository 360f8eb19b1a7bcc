/* SPDX-License-Identifier: MIT */
/* A cube that flies past, blurred. display.h knows the display: pins and size are there. */
#include <smear.h>
#include "cube.h"

void setup()
{
    Serial.begin(115200);
    const int result = cube_begin();
    if (result != SMEAR_OK)
        Serial.println(smear_error_text(result));
}

void loop()
{
    if (ctx != nullptr)
        cube_frame();
}
