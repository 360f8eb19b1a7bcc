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

# measure NAME [VARIABLE=VALUE...] of make
measured=
measure() {
    name=$1
    shift
    "$make" "$@" "build/$name/target_bench.elf" >"$folder/$name.log" 2>&1 ||
        { cat "$folder/$name.log" >&2; exit 1; }
    "$make" -s --no-print-directory "$@" target-bench >"$folder/$name.tmp"
    mv "$folder/$name.tmp" "$folder/$name.txt"
    measured="$measured $folder/$name.txt"
}

if [ -n "$targets" ]; then
    if command -v arm-none-eabi-gcc >/dev/null && command -v qemu-system-arm >/dev/null; then
        for target in cortex-m0plus cortex-m4 cortex-m7 cortex-m33; do
            measure "$target" TARGET="$target"
        done
        # As an RP2350 has the library.
        measure cortex-m33-dsp TARGET=cortex-m33 OPT="-O2 -DSMEAR_ASM_ARMV7EM=1" BUILD=build/cortex-m33-dsp
    else
        echo "bench: targets are left out: no arm-none-eabi-gcc or qemu-system-arm" >&2
    fi
fi

# Words of these lists hold no spaces.
# shellcheck disable=SC2086
if [ -n "$measured" ]; then
    "$program" $host targets $measured
elif [ -n "$host" ]; then
    "$program" $host
fi
