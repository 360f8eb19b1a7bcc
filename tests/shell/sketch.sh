#!/bin/sh
# SPDX-License-Identifier: MIT
# sketch.sh SMEAR KIT: what `smear convert` makes of a model and the kit compiles as it is, for each display, and shows one picture. The page
# gives the same bytes (web.js).
set -u
smear=$1 kit=$2
. "$(dirname "$0")/lib.sh"
base=$PWD/build/sketch-test
mkdir -p "$base"
SMEAR_OBJECTS=${SMEAR_OBJECTS:-$base/objects}
export SMEAR_OBJECTS
model=tests/data/arm.gltf

make_sketch() { # NAME OPTIONS...
    zip=$base/$1.zip
    shift
    "$smear" convert "$model" --kit "$kit" "$@" -o "$zip" >"$base/report"
}
said() { sed -n "s/$1/\\1/p" "$base/report"; }
shows() { # DISPLAY FLAGS...
    display=$1
    shift
    make_sketch "$display" --display "$display" && sh tests/shell/sketch_compile.sh "$base/$display.zip" "$base/$display" "$@" &&
        is_true "$(od -An -v -tx2 -w2 "$base/$display/panel" | sort -u | wc -l) > 20"
}
for display in lovyangfx arduino_gfx tft_espi adafruit_gfx esp_lcd; do
    claim "$display" shows $display
    claim "$display shows the same" same "$base/lovyangfx/panel" "$base/$display/panel"
done
claim "u8g2" shows u8g2 -DSMALL_PANEL
claim "ili9341_t4" shows ili9341_t4 -DTALL_PANEL
claim "the same bytes again" make_sketch again --display lovyangfx --name lovyangfx
claim "they are" same "$base/lovyangfx.zip" "$base/again.zip"
header() { "$smear" convert "$model" --name model -o "$base/model.h" && cmp "$base/model.h" "$base/lovyangfx/lovyangfx/model.h"; }
claim "its header is that of smear convert" header

# What its report says of RAM is what a compiler for pointers of 4 bytes takes, exactly; of flash, nearly what is linked.
if command -v arm-none-eabi-g++ >/dev/null 2>&1; then
    arm="-mthumb -Os -ffunction-sections -fdata-sections -Wall -Wextra -Werror -Wno-unused-parameter"
    ram() { # DISPLAY OPTIONS...
        display=$1
        shift
        # shellcheck disable=SC2086
        make_sketch ram --display "$display" "$@" && rm -rf "$base/ram" && python3 -m zipfile -e "$base/ram.zip" "$base" &&
            arm-none-eabi-g++ -mcpu=cortex-m0plus $arm -std=gnu++17 -fno-exceptions -Itests/examples/stand_ins -x c++ -include Arduino.h -c -o "$base/ram.o" "$base/ram/ram.ino" &&
            equals "$(said 'ram of the sketch: \([0-9]*\) .*')" \
                "$(arm-none-eabi-nm -S -t d "$base/ram.o" | awk '/memory/ && !/panel/ { n += $2 } END { print n }')"
    }
    claim "RAM, on a Cortex-M0+" ram lovyangfx
    claim "RAM, sharp at another size" ram arduino_gfx --size 320x172 --quality sharp
    claim "RAM, as many triangles as fit" ram lovyangfx --max-ram 84000
    claim "those are fewer than all" is_true "$(said 'sketch: .*, \([0-9]*\) tri.*') < 62"
    flash() { # CORE KIND: bytes that are linked, against what the report says of KIND, and of the model
        # shellcheck disable=SC2086
        arm-none-eabi-gcc -mcpu=$1 $arm -std=gnu11 -c -o "$base/smear.o" "$base/lovyangfx/lovyangfx/smear.c" &&
            arm-none-eabi-g++ -mcpu=$1 $arm -std=gnu++17 -fno-exceptions -Itests/examples/stand_ins -x c++ -include Arduino.h -include arduino_main.h \
                -c -o "$base/main.o" "$base/ram/ram.ino" &&
            arm-none-eabi-g++ -mcpu=$1 $arm -Wl,--gc-sections --specs=nosys.specs -o "$base/arm.elf" "$base/main.o" "$base/smear.o" &&
            takes=$(arm-none-eabi-size "$base/arm.elf" | awk 'NR == 2 { print $1 + $2 }') say=$(said "flash.*$2") && echo "$takes, not $say" &&
            is_true "$takes < 1.05 * ($say + 2918) && $takes > .95 * ($say + 2918)"
    }
    claim "flash, by -Os on a Cortex-M0+" flash cortex-m0plus '; \([0-9]*\) by -Os.*'
    claim "flash, by -O2 on a Cortex-M33, whatever the command line says" flash cortex-m33 'library \([0-9]*\) .*'
else
    echo "not run without arm-none-eabi-g++: apt-get install gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib"
fi

# What is wrong is said, and no file is left.
refuses() { # TEXT OPTIONS...
    text=$1
    shift
    rm -f "$base/no.zip"
    fails_with "$text" "$smear" convert "$model" -o "$base/no.zip" "$@" && missing "$base/no.zip"
}
claim "without a kit" refuses "make kit writes it" --display lovyangfx
claim "a display that is none" refuses "did you mean lovyangfx" --kit "$kit" --display lovyangfy
claim "a kit that is none" refuses "make kit" --kit "$model"
head -c 100000 "$kit" >"$base/cut.tar"
claim "a kit that is cut off" refuses "make kit" --kit "$base/cut.tar"
claim "a kit that is not there" refuses "cannot be opened" --kit "$base/none.tar"
claim "too little RAM" refuses "takes [0-9]* bytes of RAM at 240x240 (62 triangles" --kit "$kit" --max-ram 40000
claim "options of sketches without one" fails_with "for -o FILE.zip" "$smear" convert "$model" --size 9x9 -o "$base/no.h"
finish
