#!/bin/sh
# SPDX-License-Identifier: MIT
# sketch_compile.sh ZIP FOLDER [FLAGS...]: unpacks a sketch of `smear convert` into FOLDER, compiles it with its library on stand-ins, without a
# warning, and draws twelve frames into FOLDER/panel.
set -eu
zip=$1 folder=$2 stand_ins=$PWD/tests/examples/stand_ins warnings="-O2 -Wall -Wextra -Werror"
shift 2
rm -rf "$folder"
mkdir -p "$folder"
python3 -m zipfile -e "$zip" "$folder"
name=$(cd "$folder" && echo *)
if [ -f "$folder/$name/$name.ino" ]; then
    library=$folder/$name
    cat >"$folder/main.cpp" <<'C'
#include "Arduino.h"
#include SKETCH
static struct panel_saver { ~panel_saver() { panel_save(); } } saver;
#include "arduino_main.h"
C
    # shellcheck disable=SC2086
    ${CXX:-c++} -std=gnu++11 $warnings "$@" -DSKETCH="\"$name/$name.ino\"" -I"$folder" -I"$stand_ins" -c -o "$folder/main.o" "$folder/main.cpp"
else
    library=$folder/$name/components/smear
    cat >"$folder/main.c" <<'C'
#include <stdlib.h>
#include <freertos/task.h>
static void frame_done(void)
{
    static int frames;
    stand_in_yield();
    if (++frames < 12)
        return;
    while (panel_queued > 0)
        panel_send_first();
    panel_save();
    exit(0);
}
#undef vTaskDelay
#define vTaskDelay(ticks) frame_done()
#include "main/main.c"
int main(void) { app_main(); return 1; }
C
    # shellcheck disable=SC2086
    ${CC:-cc} -std=gnu17 $warnings "$@" -I"$folder/$name" -I"$library" -I"$stand_ins" -c -o "$folder/main.o" "$folder/main.c"
fi
# shellcheck disable=SC2086
sh tests/shell/launch_cached.sh ${CC:-cc} -std=gnu11 $warnings -c -o "$folder/smear.o" "$library/smear.c"
${CXX:-c++} -pthread -o "$folder/program" "$folder/main.o" "$folder/smear.o"
"$folder/program" >"$folder/panel"
