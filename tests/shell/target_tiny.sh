#!/bin/sh
# SPDX-License-Identifier: MIT
# target_tiny.sh FOLDER PROGRAM HOST-PROGRAM
# The smallest firmware: frames it writes through semihosting are the host's, which has all of the
# library, to the bit; blurred frames differ from sharp ones; and what it takes. Its linker script holds it
# to 26 kB of flash and 12 kB of RAM; RUN runs a program on the board, SIZE is the target's size.
set -u
. "$(dirname "$0")/lib.sh"
base=$1 program=$2 host=$3
mkdir -p "$base"

stack=0
for frame in 0 5 13 22 25 26 31; do
    for kind in "" sharp; do
        name=$frame$kind
        rm -f "$base/$name.got.ppm"
        # shellcheck disable=SC2086
        $host $frame "$base/$name.want.ppm" $kind >"$base/host.log" || { cat "$base/host.log"; exit 1; }
        # shellcheck disable=SC2086
        $RUN "$program" $frame "$base/$name.got.ppm" $kind >"$base/log" || cat "$base/log"
        claim "frame $name" same "$base/$name.want.ppm" "$base/$name.got.ppm"
        used=$(sed -n 's/^stack //p' "$base/log")
        [ "${used:-0}" -le $stack ] || stack=$used
    done
done
claim "a blurred frame is not the sharp one" differ "$base/22.want.ppm" "$base/22sharp.want.ppm"
claim "a frame is not another" differ "$base/22.want.ppm" "$base/25.want.ppm"
claim "the program measures its stack" [ "$stack" -gt 0 ]
# Where the call graph ends the compiler may call a helper: a product of 64 bits pushes 28 bytes.
build=$(dirname "$program")
worst=$(awk -v root=reset_handler -f platform/stack.awk "$program".*.ci "$build"/platform/tiny.ci "$build"/platform/*/*.ci |
    awk '{ print $1 + 28 }')
claim "the call graph's stack ($worst) is as deep as what is used ($stack)" [ "${worst:-0}" -ge "$stack" ]
claim "there is room for it" [ "${worst:-0}" -le 2648 ]      # what tiny.ld has left
$SIZE -A "$program" | awk -v worst="${worst:-0}" -v stack="$stack" '
    $1 == ".text" || $1 == ".data" { flash += $2 }
    $1 == ".mesh" { mesh = $2 }
    $1 == ".data" || $1 == ".bss" { ram += $2 }
    END { printf "flash %d bytes and %d of mesh; RAM %d: memory and data %d, worst stack %d by the call graph, %d used\n",
          flash, mesh, ram + worst, ram, worst, stack }'
finish
