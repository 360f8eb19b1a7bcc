#!/bin/sh
# SPDX-License-Identifier: MIT
# bench.sh - all that `make bench` prints: the host's reports, then what frames cost on Cortex-M in
# an emulator, where the tools for that are there.
#
#     [MAKE=make] sh tools/bench/bench.sh PROGRAM [REPORT...]
#
# With reports (peers, targets) only those. Files are kept in build/bench.
set -eu

program=$1
shift
make=${MAKE:-make}
folder=build/bench
mkdir -p "$folder"

host=
targets=
if [ $# -eq 0 ]; then
    host=peers
    targets=yes
fi
for report in "$@"; do
    if [ "$report" = targets ]; then
        targets=yes
    else
        host="$host $report"
    fi
done

measured=
if [ -n "$targets" ]; then
    for target in cortex-m0plus cortex-m4 cortex-m7; do
        if ! command -v arm-none-eabi-gcc >/dev/null ||
            ! command -v qemu-system-arm >/dev/null; then
            echo "bench: $target is left out: no arm-none-eabi-gcc or qemu-system-arm" >&2
            continue
        fi
        "$make" TARGET="$target" "build/$target/target_bench.elf" >"$folder/$target.log" 2>&1 ||
            { cat "$folder/$target.log" >&2; exit 1; }
        "$make" -s --no-print-directory TARGET="$target" target-bench >"$folder/$target.tmp"
        mv "$folder/$target.tmp" "$folder/$target.txt"
        measured="$measured $folder/$target.txt"
    done
fi

# Words of these lists hold no spaces.
# shellcheck disable=SC2086
if [ -n "$measured" ]; then
    "$program" $host targets $measured
elif [ -n "$host" ]; then
    "$program" $host
fi
