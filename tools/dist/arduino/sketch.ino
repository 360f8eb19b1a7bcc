/* SPDX-License-Identifier: MIT */
/* @WHAT@ display.h says which library knows the display. */
#include <smear.h>
#include "@NAME@.h"

void setup()
{
    Serial.begin(115200);
    const int result = @NAME@_begin();
    if (result != SMEAR_OK)
        Serial.println(smear_error_text(result));
}

void loop()
{
    if (ctx != nullptr)
        @NAME@_frame();
}
