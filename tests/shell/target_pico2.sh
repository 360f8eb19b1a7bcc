#!/bin/sh
# SPDX-License-Identifier: MIT
# target_pico2.sh SDK - firmware of boards with an RP2350, by version 2 of the pico-sdk: it is built, fits, and its UF2 is the image.
# No emulator of the chip is known to us; its core's frames are those of TARGET=cortex-m33.
set -u
sdk=$1
. "$(dirname "$0")/lib.sh"
base=build/test/pico2
mkdir -p "$base"
boards=$(sed -n 's/^BOARD(\([a-z0-9_]*\), *RP2350.*/\1/p' platform/pico/boards.h)

builds() { PICO_SDK_PATH=$sdk $make -s TARGET=pico BOARD="$1" demo-firmware game-firmware; }
of_core() { arm-none-eabi-readelf -A "$1" | grep -q 'Tag_CPU_arch: v8-M.mainline'; }
# An image that the chip's ROM starts says so in its first 4 kB.
is_started() { head -c 4096 "$1" | od -An -v -tx4 -w4 | grep -q ffffded3; }
# Behind its first block the UF2 has 256 bytes of the image in each of 512, up to a last one that is filled up.
is_image() { # PROGRAM
    tail -c +513 "$1.uf2" | od -An -v -tx1 -w512 | cut -c 97-864 >"$base/blocks"
    od -An -v -tx1 -w256 "$1.bin" | awk '{ printf "%s", $0; for (i = NF; i < 256; i++) printf " 00"; print "" }' | cmp - "$base/blocks" &&
        tail -c +513 "$1.uf2" | od -An -v -tx4 -w512 | awk '
            $1 $2 != "0a3246559e5d5157" || $3 != "00002000" || $8 != "e48bff59" || $NF != "0ab16f30" || $4 != sprintf("%08x", 268435456 + 256 * (NR - 1)) ||
                $6 != sprintf("%08x", NR - 1) { bad = 1 }
            { count = $7 }
            END { exit bad || count != sprintf("%08x", NR) }' &&
        equals "$(head -c 512 "$1.uf2" | od -An -v -tx4 -w512 | awk '{ print $3, $4, $7, $8, $73 }')" "0000a000 10ffff00 00000002 e48bff57 9957e304"
}
address() { arm-none-eabi-nm "$1" | awk -v name="$2" '$3 == name { print "0x" $1 }'; }
# The whole library lies in RAM, which leaves as much as an RP2040 has.
holds() { # PROGRAM.elf
    is_true "$(($(address "$1" __StackLimit) - $(address "$1" __end__))) >= 200 * 1024" &&
        arm-none-eabi-nm "$1" | awk '$3 ~ /^smear_/ && $2 == "T" && $1 !~ /^2/ { print; bad = 1 } END { exit bad }'
}

for board in $boards; do
    claim "firmware of $board" builds "$board"
    for program in demo game; do
        folder=build/pico/$board
        if [ -x "$(command -v picotool)" ]; then
            claim "$program of $board has a UF2" exists "$folder/$program.uf2"
        else
            claim "$program of $board is its UF2" is_image "$folder/$program"
            claim "$program of $board is started" is_started "$folder/$program.bin"
        fi
        claim "$program of $board is of its core" of_core "$folder/$program.elf"
        claim "$program of $board: RAM holds it" holds "$folder/$program.elf"
    done
done
finish
