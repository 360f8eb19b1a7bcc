#!/bin/sh
# SPDX-License-Identifier: MIT
# target_switches.sh BUILD-FOLDER
# Every switch of smear_config.h off alone, sets of them, and everything off but one method and one
# format: compiles without a warning, draws the golden frames it can to the bit, refuses the others.
# Needs build/tapes/golden.c.
set -u
. "$(dirname "$0")/lib.sh"
base=$1
mkdir -p "$base"
flags="-std=c11 -D_POSIX_C_SOURCE=200809L -O1 -Wall -Wextra -Wconversion -Wshadow -Werror -Iinclude -Isrc -I."
programs="tests/target/target_golden.c platform/play.c platform/print.c platform/host/platform.c build/tapes/golden.c"

# Nothing is inlined by force, which halves what there is to compile, and what GCC knows of vectors, most of the text of half the
# sources, is read once for all. (What is not inlined may look uninitialized.)
quick="-DSMEAR_INLINE_FORCED=0 -Wno-maybe-uninitialized"
if [ "$(uname -m)" = x86_64 ] && ${CC:-cc} --version | grep -q GCC; then
    echo '#include <immintrin.h>' >"$base/vectors.h"
    # shellcheck disable=SC2086
    ${CC:-cc} $flags -x c-header -o "$base/vectors.h.gch" "$base/vectors.h" || exit 1
    quick="$quick -include $base/vectors.h"
fi

draws() { # NAME FLAGS...
    name=$1
    shift
    rm -f "$base/$name.txt"
    # shellcheck disable=SC2046,SC2086
    sh tests/shell/compile_cached.sh "$base/cache" "$base/$name.list" "${CC:-cc}" $flags $quick "$@" -- src/*.c src/*/*.c $programs &&
        ${CC:-cc} -o "$base/$name" $(cat "$base/$name.list") && "$base/$name" >"$base/$name.txt" && return 0
    [ ! -e "$base/$name.txt" ] || grep -E 'WRONG|NOT|ERROR|golden frames' "$base/$name.txt"
    return 1
}
# try NAME FLAGS...
try() {
    claim "$1" draws "$@"
    [ ! -e "$base/$1.txt" ] || printf '%-24s %s\n' "$1" "$(tail -n 1 "$base/$1.txt")"
}

for switch in $(switches); do
    # shellcheck disable=SC2046
    try "$switch" $(without "$switch")
done
rgb565="-DSMEAR_WITH_ALL=0 -DSMEAR_WITH_RGB565=1 -DSMEAR_WITH_DITHER=1 -DSMEAR_WITH_TEXTURE=1"
rgb565="$rgb565 -DSMEAR_WITH_LINEAR=1 -DSMEAR_WITH_GOURAUD=1 -DSMEAR_WITH_ALPHA=1"
# Sets, which are what people have, are built as these do.
quick=
# shellcheck disable=SC2086
{
    try everything
    try fast-stack -DSMEAR_FAST_STACK=1
    try core $(sh tests/shell/core_switches.sh)
    try sharp $rgb565
    try accumulate -DSMEAR_WITH_ALL=0 -DSMEAR_WITH_ACCUMULATE=1 -DSMEAR_WITH_RGB=1 -DSMEAR_WITH_DITHER=1 -DSMEAR_WITH_LINEAR=1 \
        -DSMEAR_WITH_CURVES=1
    try reconstruct $rgb565 -DSMEAR_WITH_RECONSTRUCT=1
    try auto $rgb565 -DSMEAR_WITH_SUBFRAMES=1
}
finish
