#!/bin/sh
# SPDX-License-Identifier: MIT
# target_switches.sh BUILD-FOLDER
# Every switch of smear_config.h off alone, sets of them, and everything off but one method and one
# format: compiles without a warning, draws the golden frames it can to the bit, refuses the others.
# Needs build/tapes/golden.c.
set -u
out=$1
mkdir -p "$out"
flags="-std=c11 -D_POSIX_C_SOURCE=200809L -O1 -Wall -Wextra -Wconversion -Wshadow -Werror -Iinclude -Isrc -Itests"
programs="tests/target_golden.c tests/play.c tests/target_print.c platform/host/platform.c build/tapes/golden.c"
passed=0
failed=0

# try NAME FLAGS...
try() {
    name=$1
    shift
    # shellcheck disable=SC2086
    if sh tests/compile_cached.sh "$out/cache" "$out/$name.list" "${CC:-cc}" $flags "$@" -- src/*.c $programs &&
        ${CC:-cc} -o "$out/$name" $(cat "$out/$name.list") && "$out/$name" >"$out/$name.txt"; then
        passed=$((passed + 1))
        printf '%-24s %s\n' "$name" "$(tail -n 1 "$out/$name.txt")"
    else
        failed=$((failed + 1))
        echo "$name: FAILED"
        [ ! -e "$out/$name.txt" ] || grep -E 'WRONG|NOT|ERROR|golden frames' "$out/$name.txt"
    fi
}

switches=$(sed -n 's/^#ifndef \(SMEAR_WITH_[A-Z0-9_]*\).*/\1/p' include/smear_config.h | grep -v _ALL)
try everything
try fast-stack -DSMEAR_FAST_STACK=1
for switch in $switches; do
    case $switch in     # what cannot be without it
    SMEAR_WITH_SUBFRAMES) try "$switch" -D$switch=0 -DSMEAR_WITH_TIMEMASK=0 ;;
    *) try "$switch" -D$switch=0 ;;
    esac
done
rgb565="-DSMEAR_WITH_ALL=0 -DSMEAR_WITH_RGB565=1 -DSMEAR_WITH_DITHER=1 -DSMEAR_WITH_TEXTURE=1 -DSMEAR_WITH_BILINEAR=1"
rgb565="$rgb565 -DSMEAR_WITH_LINEAR=1 -DSMEAR_WITH_GOURAUD=1 -DSMEAR_WITH_ALPHA=1"
# shellcheck disable=SC2086
{
    try core $(sh tests/core_switches.sh)
    try sharp $rgb565
    try accumulate -DSMEAR_WITH_ALL=0 -DSMEAR_WITH_ACCUMULATE=1 -DSMEAR_WITH_RGB332=1 -DSMEAR_WITH_DITHER=1 -DSMEAR_WITH_LINEAR=1
    try reconstruct $rgb565 -DSMEAR_WITH_RECONSTRUCT=1
    try subframes $rgb565 -DSMEAR_WITH_SUBFRAMES=1
    try auto $rgb565 -DSMEAR_WITH_SUBFRAMES=1 -DSMEAR_WITH_TIMEMASK=1
}
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
