#!/bin/sh
# SPDX-License-Identifier: MIT
# cost.sh PROGRAM.elf cost SCREEN [BLUR [STEP]]
# What frames take. With a way to blur: `demo cost`, which tells the stages apart, on one core. Without one: the loop of
# the demo as it is shown on 240x240 pixels, from one frame on the panel to the next, on one core and on both, blurred and sharp. Everything is
# in it: misses of the flash cache, banks of RAM that both cores want, the bus. FRAMES=36: how much of the loop.
set -u
program=$1
[ $# -lt 4 ] && [ "${program##*/}:$3" = demo.elf:pico-240 ] || exec sh platform/pico/run.sh "$@"
out=${program%.elf}-cost
frames=${FRAMES:-36}
khz=$(awk -F '[^A-Za-z0-9_]+' -v name="${BOARD:-breakout}" '$1 == "BOARD" && $2 == name { print $19 }' platform/pico/boards.h)
pixels=$(awk -F '[^A-Za-z0-9_]+' -v name="${BOARD:-breakout}" '$1 == "BOARD" && $2 == name { print $4 * $5 }' platform/pico/boards.h)
# shellcheck disable=SC2086
for cores in 1 2; do
    only=show\ $3
    [ $cores = 2 ] || only="cores=1 show pico"
    # One more frame, in which key A is pressed, for the sharp ones.
    sh platform/pico/run.sh --exact 1 --frames "$frames" --cost "$out-blurred-$cores" "$program" $only >/dev/null || exit 1
    sh platform/pico/run.sh --exact 1 --frames $((frames + 1)) --keys 1:16,2:0 --cost "$out-sharp-$cores" "$program" $only \
        >/dev/null || exit 1
done
echo "cycles per frame, of $khz kHz; flash misses and cycles that cores wait for each other, in thousands, are in them"
for cores in 1 2; do
    for kind in sharp blurred; do
        awk -v kind=$kind -v cores=$cores -v khz="$khz" -v pixels="$pixels" '
            NR == 1 || (kind == "sharp" && NR == 2) { next }
            { way = kind == "sharp" ? "sharp" : $1 % 72 < 20 ? "camera" : "objects"; n[way]++; sum[way] += $2; miss[way] += $3 + $4; wait[way] += $5 + $6 }
            function row(way) {
                if (n[way])
                    printf "%d core%s  %-8s %11.0f  %7.1f per pixel, misses %4.0f, waits %5.0f:  %5.1f frames per second\n", cores, (cores > 1 ? "s" : " "),
                        way, sum[way] / n[way], sum[way] / n[way] / pixels, miss[way] / n[way] / 1000, wait[way] / n[way] / 1000, khz * 1000 * n[way] / sum[way]
            }
            END { row("sharp"); row("objects"); row("camera") }' "$out-$kind-$cores"
    done
done
