#!/bin/sh
# SPDX-License-Identifier: MIT
# [SWITCHES="SMEAR_WITH_TEXTURE ..."] footprint_switches.sh [TARGET:OPTIMIZATION...]
# What the library takes with everything in it, what each switch of smear_config.h saves, and what
# useful sets take:
#
#   flash    code and tables of all functions of the interface, without what the compiler adds
#   stack    worst of smear_render by the compiler's call graph, callbacks not counted
#   sharp, window, auto, both
#            memory of contexts of 240x240 (platform/footprint_arena.c); -: refused
#
# A switch's row says how much less flash there is than with everything. SWITCHES: only these.
set -u
[ $# -gt 0 ] || set -- cortex-m0plus:-Os cortex-m33:-O2
. tests/shell/lib.sh
out=build/footprint/switches
roots=$(interface)
mkdir -p "$out"
status=0

# measure NAME SWITCHES...: sets flash, stack, arena
measure() {
    name=$1
    shift
    list=$out/$target$optimization-$name
    # shellcheck disable=SC2086
    sh tests/shell/compile_cached.sh "$out/$target$optimization" "$list.list" $compile $optimization -Wall -Werror \
        -fcallgraph-info=su "$@" -- src/*.c src/*/*.c || exit 1
    # shellcheck disable=SC2046,SC2086
    {
        $linker -r --gc-sections $roots -o "$list.o" $(cat "$list.list") || exit 1
        flash=$("$size" -A "$list.o" | awk '$1 ~ /^\.(text|rodata|srodata)/ { sum += $2 } END { print sum }')
        stack=$(awk -f platform/stack.awk $(sed 's/o$/ci/' "$list.list")) || { echo "$stack"; status=1; }
        stack=$(echo "$stack" | awk '$2 == "smear_render" { print $1 }')
        arenas=$($cc $link $arena_objects $(cat "$list.list") $libraries -o "$list.elf" && $run "$list.elf")
    }
    # shellcheck disable=SC2086
    set -- $(echo "$arenas" | sed 's/\<0\>/-/g')
    line=$(printf '%7d  %7s %7s %7s %7s' "$stack" "$1" "$2" "$3" "$4")
}

for pair in "$@"; do
    target=${pair%:*} optimization=${pair#*:}
    build=build/footprint/arena-$target
    $make --no-print-directory -s TARGET="$target" BUILD="$build" OPT="$optimization" footprint-arena >"$out/log" 2>&1 ||
        { tail -5 "$out/log"; exit 1; }
    eval "$($make --no-print-directory -s TARGET="$target" BUILD="$build" print-footprint)"
    linker=${cc%gcc}ld size=${cc%gcc}size
    [ "$target" != rv32imc ] || linker="$linker -melf32lriscv"
    measure everything
    everything=$flash
    printf '%-34s %7s %7s  %7s %7s %7s %7s\n' "$target $optimization" flash stack sharp window auto both
    printf '%-34s %7d %s\n' everything "$flash" "$line"
    for switch in ${SWITCHES:-$(switches)}; do
        # shellcheck disable=SC2046
        measure "$switch" $(without "$switch")
        printf '%-34s %7d %s\n' "  $switch=0" $((flash - everything)) "$line"
    done
    one="-DSMEAR_WITH_ALL=0 -DSMEAR_WITH_RGB565=1 -DSMEAR_WITH_DITHER=1"
    # shellcheck disable=SC2086
    for set in sharp accumulate reconstruct auto; do
        case $set in
        sharp) measure $set $one ;;
        accumulate) measure $set $one -DSMEAR_WITH_ACCUMULATE=1 ;;
        reconstruct) measure $set $one -DSMEAR_WITH_RECONSTRUCT=1 ;;
        auto) measure $set $one -DSMEAR_WITH_SUBFRAMES=1 ;;
        esac
        printf '%-34s %7d %s\n' "only RGB565, $set" "$flash" "$line"
    done
done
exit $status
