#!/bin/sh
# SPDX-License-Identifier: MIT
# target_pico.sh SMEAR MODEL - what demo-test leaves: the emulator's interpreter, the other rows of boards.h, a model of
# one's own, what is said where something is missing or does not fit, and memory.
set -u
smear=$1 model=$2
. "$(dirname "$0")/lib.sh"
base=build/test/pico
sdk=${PICO_SDK_PATH:-$PWD/build/pico/sdk}
rm -rf "$base"
mkdir -p "$base"

pico() { $make -s TARGET=pico "$@"; }
boards=$(sed -n 's/^BOARD(\([a-z0-9_]*\), *RP2040.*/\1/p' platform/pico/boards.h)
configure() { # FOLDER OPTION...
    folder=$1
    shift
    cmake -S platform/pico -B "$base/$folder" -DPICO_SDK_PATH="$sdk" "$@" >"$base/$folder.log" 2>&1 || { tr '\n' ' ' <"$base/$folder.log"; return 1; }
}
build_all() {
    configure all -DSMEAR_BOARD="$(echo $boards | tr ' ' ';')" && cmake --build "$base/all" -j2 >>"$base/all.log" 2>&1 || { tail "$base/all.log"; return 1; }
}
screen_of() { awk -F '[^A-Za-z0-9_]+' -v name="$1" '$1 == "BOARD" && $2 == name { print "pico-" $4 }' platform/pico/boards.h; }
# Three frames, of which the second is sharp.
shows() { # BOARD
    build/demo/target_screen keys "$(screen_of "$1")" 3 1:16,2:0 >"$base/$1.want" &&
        BOARD=$1 sh platform/pico/run.sh --frames 3 --keys 1:16,2:0 "$base/all/demo-$1.elf" >"$base/$1.got" && cmp "$base/$1.want" "$base/$1.got"
}
# A row with a pin that cannot be.
miswired() {
    mkdir -p "$base/miswired" && cp platform/pico/*.[ch] "$base/miswired/" &&
        sed -i 's/^\(BOARD(breakout.* \)18, 19,/\117, 19,/' "$base/miswired/boards.h" &&
        arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -std=c11 -fsyntax-only -DSMEAR_BOARD=breakout -include "$base/miswired/board.h" -x c /dev/null
}
# Data with core 1's stack, functions in RAM, the context with what core 1 has of it (14 bytes per pixel of its strip and of 16
# columns beside, a list, and what moves in the next row), and core 0's stack.
fits() {
    sh platform/pico/run.sh build/pico/breakout/demo.elf cost pico-240 auto 72 >"$base/cost" || return 1
    own=$(arm-none-eabi-size -A build/pico/breakout/demo.elf | awk '$3 >= 536870912 && $3 < 537133056 { sum += $2 } END { print sum }')
    context=$(sed -n 's/^memory \([0-9]*\),.*/\1/p' "$base/cost")
    is_true "$own + $context + 14 * 144 * 16 + 512 + 800 + 8192 <= 200 * 1024"
}

claim "the interpreter is rp2040js's" sh platform/pico/run.sh --selftest 1000000 build/pico/breakout/demo.elf check pico-240 36
claim "firmware for every RP2040" build_all
for board in $boards; do
    [ "$board" = breakout ] || claim "$board shows the host's frames" shows "$board"
done
claim "a header" "$smear" convert "$model" --name model -o "$base/model.h"
claim "the model's firmware" pico MODEL="$base/model.h" model-firmware
claim "its frames are this machine's" pico MODEL="$base/model.h" model-test
claim "200 kB hold it" fits
claim "no SDK is told" fails_with 'PICO_SDK_PATH' env PICO_SDK_PATH=/nowhere $make -s TARGET=pico demo-firmware
claim "no such board is told" fails_with 'breakout;lcd_1_3' configure unknown -DSMEAR_BOARD=nothing
claim "an RP2350 with SDK 1 is told" fails_with 'it needs pico-sdk 2' configure other -DSMEAR_BOARD=thumby_color
claim "a pin that cannot be is told" fails_with 'is no SCK of this SPI' miswired
claim "no emulator is told" fails_with 'npm install' env RP2040JS=/nowhere sh platform/pico/run.sh build/pico/breakout/demo.elf
claim "no boot ROM is told" fails_with 'PICO_BOOTROM=FILE' env PICO_BOOTROM=/nowhere sh platform/pico/run.sh build/pico/breakout/demo.elf
finish
