#!/bin/sh
# SPDX-License-Identifier: MIT
# target_tiny.sh FOLDER PROGRAM HOST-PROGRAM
# The smallest firmware: frames it writes through semihosting are the host's, which has all of the
# library, to the bit; blurred frames differ from sharp ones; and what it takes. Its linker script holds it
# to 24 kB of flash and 12 kB of RAM; RUN runs a program on the board, SIZE is the target's size.
set -u
folder=$1 program=$2 host=$3
passed=0
failed=0
mkdir -p "$folder"

check() {
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $*"
    fi
}

differ() {
    ! cmp -s "$1" "$2"
}

stack=0
for frame in 0 5 13 22 25 26 31; do
    for kind in "" sharp; do
        name=$frame$kind
        rm -f "$folder/$name.got.ppm"
        # shellcheck disable=SC2086
        $host $frame "$folder/$name.want.ppm" $kind >"$folder/host.log" || { cat "$folder/host.log"; exit 1; }
        # shellcheck disable=SC2086
        $RUN "$program" $frame "$folder/$name.got.ppm" $kind >"$folder/log" || cat "$folder/log"
        check cmp "$folder/$name.want.ppm" "$folder/$name.got.ppm"
        used=$(sed -n 's/^stack //p' "$folder/log")
        [ "${used:-0}" -le $stack ] || stack=$used
    done
done
check differ "$folder/22.want.ppm" "$folder/22sharp.want.ppm"
check differ "$folder/22.want.ppm" "$folder/25.want.ppm"
check [ "$stack" -gt 0 ]
# Where the call graph ends the compiler may call a helper: a product of 64 bits pushes 28 bytes.
folder=$(dirname "$program")
worst=$(awk -v root=reset_handler -f platform/stack.awk "$program".*.ci "$folder"/platform/tiny.ci "$folder"/platform/*/*.ci |
    awk '{ print $1 + 28 }')
check [ "${worst:-0}" -ge "$stack" ]
check [ "${worst:-0}" -le 2720 ]       # what tiny.ld has left
$SIZE -A "$program" | awk -v worst="${worst:-0}" -v stack="$stack" '
    $1 == ".text" || $1 == ".data" { flash += $2 }
    $1 == ".mesh" { mesh = $2 }
    $1 == ".data" || $1 == ".bss" { ram += $2 }
    END { printf "flash %d bytes and %d of mesh; RAM %d: memory and data %d, worst stack %d by the call graph, %d used\n",
          flash, mesh, ram + worst, ram, worst, stack }'
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
