#!/bin/sh
# SPDX-License-Identifier: MIT
# target_pico2.sh [SDK] - firmware of boards with an RP2350 by a compiler alone and, where it is given, by version 2 of the pico-sdk:
# it is built, fits, is of its core, has the block that the chip's ROM looks for, and its UF2 is the image. Of the former QEMU draws
# the frames; of the latter these are those of TARGET=cortex-m33.
set -u
sdk=${1:-}
. "$(dirname "$0")/lib.sh"
base=build/test/pico2
mkdir -p "$base"
boards=$(sed -n 's/^BOARD(\([a-z0-9_]*\), *RP2350.*/\1/p' platform/pico/boards.h)

builds() { # TARGET BOARD
    PICO_SDK_PATH=$sdk $make -s TARGET="$1" BOARD="$2" demo-firmware game-firmware
}
of_core() { arm-none-eabi-readelf -A "$1" | grep -q 'Tag_CPU_arch: v8-M.mainline'; }
# Data sheet, 5.9: in the first 4 kB, ffffded3h, then items, each with its length, of which one says: a program, secure, for Arm, for
# an RP2350; a last item with the length of all; where the next block is, and ab123579h. Stack and start are the first two words.
is_started() {
    head -c 4096 "$1" | od -An -v -tx4 -w4 | awk '
        function hex(text,    i, value) {
            for (i = 1; i <= length(text); i++)
                value = value * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1
            return value
        }
        { word[NR] = $1 }
        END {
            for (at = 1; at <= NR && word[at] != "ffffded3"; at++) { }
            for (item = at + 1; item < NR && substr(word[item], 7) != "ff"; item += size) {
                size = substr(word[item], 7, 1) < "8" ? hex(substr(word[item], 5, 2)) : hex(substr(word[item], 3, 4))
                if (size == 0)
                    exit 1
                is_program = is_program || word[item] == "10210142"
            }
            exit !(is_program && hex(substr(word[item], 3, 4)) == item - at - 1 && word[item + 2] == "ab123579" && word[1] ~ /^200[0-8]/ &&
                   word[2] ~ /^10/ && hex(word[2]) % 2 == 1)
        }'
}
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
check() { # TARGET BOARD
    claim "$1: firmware of $2" builds "$1" "$2"
    for program in demo game; do
        file=build/$1/$2/$program
        if [ "$1" = pico ] && [ -x "$(command -v picotool)" ]; then
            claim "$1: $program of $2 has a UF2" exists "$file.uf2"
        else
            claim "$1: $program of $2 is its UF2" is_image "$file"
            claim "$1: $program of $2 is started" is_started "$file.bin"
        fi
        claim "$1: $program of $2 is of its core" of_core "$file.elf"
        claim "$1: $program of $2: RAM holds it" holds "$file.elf"
    done
}
# Three frames, of which the second is sharp.
screen_of() { awk -F '[^A-Za-z0-9_]+' -v name="$1" '$1 == "BOARD" && $2 == name { print "pico-" $4 }' platform/pico/boards.h; }
shows() { # BOARD [1]
    $make -s TARGET=pico2 BOARD="$1" build/demo/target_screen "build/pico2/$1/machine.elf" &&
        build/demo/target_screen keys "$(screen_of "$1")" 3 1:16,2:0 >"$base/$1.want" &&
        sh platform/pico2/run.sh --frames 3 --keys 1:16,2:0 "build/pico2/$1/demo.elf" ${2:+cores=1 show} ${2:+"$(screen_of "$1")"} >"$base/$1.got" &&
        cmp "$base/$1.want" "$base/$1.got"
}
# What the chip would not take is told: with another chip.c.
spoilt() { # TEXT SED
    rm -rf "$base/spoilt" && mkdir "$base/spoilt" && sed "$2" platform/pico2/chip.c >"$base/spoilt/chip.c" &&
        differ platform/pico2/chip.c "$base/spoilt/chip.c" && cp build/pico2/pico2_breakout/machine.elf "$base/spoilt/" &&
        $make -s TARGET=pico2 SPOILT="$base/spoilt" "$base/spoilt/demo.elf" &&
        fails_with "$1" sh platform/pico2/run.sh --frames 1 "$base/spoilt/demo.elf"
}

for board in $boards; do
    check pico2 "$board"
    claim "pico2: $board shows the host's frames by both cores" shows "$board"
    claim "pico2: $board shows the host's frames by one core" shows "$board" 1
done
claim "an image without its block is not started" spoilt 'no block of an image' 's/0xffffded3/0xffffded2/'
claim "a peripheral in reset is told" spoilt 'is held in reset: 40080' 's/RESET_SPI = 3 << 18/RESET_SPI = 0/'
claim "a wrong clock is told" spoilt 'has another clock' 's/FIRST << 16 | SECOND << 12/FIRST << 16 | 3 << 12/'
[ -z "$sdk" ] || for board in $boards; do
    check pico "$board"
done
finish
