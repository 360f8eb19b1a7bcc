#!/bin/sh
# SPDX-License-Identifier: MIT
# gba_cartridge.sh - the cartridge's header, the logo from a ROM of the user's, and the keys that demo-test leaves.
set -u
. "$(dirname "$0")/lib.sh"
base=build/test/gba-cartridge
image=build/gba/demo.gba
rm -rf "$base"
mkdir -p "$base"

firmware() { $make -s TARGET=gba demo-firmware "$@" >"$base/said" 2>&1; }
bytes() { od -An -v -tu1 -w1 -j"$2" -N"$3" "$1"; }
# The sum of bytes a0 to bd and 19h is nothing.
header_holds() { is_true "$(bytes "$1" 160 30 | awk '{ sum += $1 } END { print (sum + 25) % 256 }') == 0"; }
# put FILE OFFSET: standard input there
put() { dd of="$1" bs=1 seek="$2" conv=notrunc 2>/dev/null; }
refuses() { # TEXT ROM
    cp "$image" "$base/before.gba"
    if firmware LOGO="$2"; then
        echo "was taken"
        return 1
    fi
    grep -q "$1" "$base/said" && cmp "$image" "$base/before.gba" || { cat "$base/said"; return 1; }
}
shows() { # KEYS SHUTTER
    sh platform/gba/shot.sh build/gba/demo.elf 45 "$base/shot.ppm" "$1" && build/demo/target_screen compare gba 45 "$2" "$base/shot.ppm" 2
}

claim "the emulator" $make -s TARGET=gba build/gba/gbarun
claim "an image without a logo" firmware
claim "says what a console wants" grep -q 'LOGO=FILE.gba' "$base/said"
claim "its header holds" header_holds "$image"
cp "$image" "$base/plain.gba"
cp "$image" "$base/rom.gba"
seq 1 156 | awk '{ printf "%c", 33 + $1 % 90 }' | put "$base/rom.gba" 4
claim "an image with the logo of a ROM" firmware LOGO="$base/rom.gba"
claim "has it, and nothing else changed" cmp "$image" "$base/rom.gba"
claim "it runs" eval 'build/gba/gbarun "$image" check oled 24 >"$base/got" && build/demo/target_screen crcs oled 24 | cmp - "$base/got"'
claim "no such file is told" refuses 'cannot be opened' "$base/none.gba"
head -c 100 "$base/rom.gba" >"$base/short.gba"
claim "a file that is too short is told" refuses 'is no ROM: 100 bytes' "$base/short.gba"
cp "$base/rom.gba" "$base/damaged.gba"
printf X | put "$base/damaged.gba" 160
claim "a header that does not hold is told" refuses 'is damaged: the header' "$base/damaged.gba"
claim "another file is told" refuses 'byte b2 is' README.md
claim "a ROM without a logo is told" refuses 'has no logo itself' "$base/plain.gba"
claim "shoulder R: a longer shutter" shows 256 270
claim "shoulder L: a shorter one" shows 512 90
finish
