#!/bin/sh
# SPDX-License-Identifier: MIT
# rates.sh [NAME...] - frames per second of the demo on emulated machines: measures those named (pico gba lm3s6965evb
# microbit; none: nothing) into build/rates, then prints the table of README.md of all that have been measured.
#
# Cycles of the emulators of a Pico and a Game Boy Advance. QEMU counts instructions: for the other two a cycle for each, so
# that the rate is the highest there may be.
set -eu
out=build/rates
mkdir -p $out
MAKE=${MAKE:-make}

# measure NAME: its costs, blurred and sharp
measure() {
    case $1 in
    pico) $MAKE --no-print-directory -s TARGET=pico demo-cost >$out/pico.new ;;
    microbit) $MAKE --no-print-directory -s TARGET=microbit tiny-cost >$out/microbit.new ;;
    *)
        $MAKE --no-print-directory -s TARGET="$1" demo-cost >$out/"$1".new
        $MAKE --no-print-directory -s TARGET="$1" demo-cost BLUR=none | sed -n 's/^total/sharp/p' >>$out/"$1".new
        ;;
    esac
    mv $out/"$1".new $out/"$1"
}

for name; do
    measure "$name"
done

rate='function rate(count) { r = hz / count; return r < 10 ? sprintf("%.1f", r) : sprintf("%.0f", r) }'
echo '| | panel | sharp | blurred, objects move | blurred, the camera moves, too |'
echo '|---|---|---|---|---|'
[ ! -f $out/pico ] || awk 'function short(r) { return r < 10 ? sprintf("%.1f", r) : sprintf("%.0f", r) }
    $3 ~ /^(sharp|objects|camera)$/ { fps[$1 $3] = $(NF - 3) }
    END { for (cores = 1; cores <= 2; cores++)
        printf "| Raspberry Pi Pico, RP2040 at 133 MHz, %s | 240x240 | %s | %s | %s |\n", cores == 1 ? "one core" : "both cores",
            short(fps[cores "sharp"]), short(fps[cores "objects"]), short(fps[cores "camera"]) }' $out/pico
[ ! -f $out/gba ] || awk -v hz=16777216 "$rate"'
    { count[$1] = $2 }
    END { printf "| Game Boy Advance, ARM7 at 16.8 MHz | 120x80 | %s | %s | %s |\n", rate(count["sharp"]), rate(count["objects"]),
        rate(count["camera"]) }' $out/gba
[ ! -f $out/lm3s6965evb ] || awk -v hz=50000000 "$rate"'
    { count[$1] = $2 }
    END { printf "| Cortex-M3 at 50 MHz, 48 kB of RAM | 128x64, 16 greys | at most %s | at most %s | at most %s |\n",
        rate(count["sharp"]), rate(count["objects"]), rate(count["camera"]) }' $out/lm3s6965evb
[ ! -f $out/microbit ] || awk -v hz=16000000 "$rate"'
    { count[$1] = $2 }
    END { printf "| BBC micro:bit, Cortex-M0 at 16 MHz, 12 kB of RAM | 96x64 | at most %s | at most %s | |\n",
        rate(count["sharp"]), rate(count["blurred"]) }' $out/microbit
