#!/bin/sh
# SPDX-License-Identifier: MIT
# target_switches.sh BUILD-FOLDER SMEAR.C
# Every switch of smear_config.h off alone, sets of them, and everything off but one method and one
# format: compiles without a warning, draws the golden frames it can to the bit, refuses the others; and zeros work (zero.c).
# SMEAR.C is the one-file form. Needs build/tapes/golden.c.
set -u
. "$(dirname "$0")/lib.sh"
base=$1 single=$2
mkdir -p "$base"
flags="-std=c11 -D_POSIX_C_SOURCE=200809L -O1 -Wall -Wextra -Wconversion -Wshadow -Werror -Iinclude -Isrc -I."
players="tests/target/target_golden.c platform/play.c platform/print.c platform/host/platform.c"
programs="$players build/tapes/golden.c"
sources=$(printf '%s\n' src/*.c src/*/*.c | wc -l)

# shellcheck disable=SC2086
${CC:-cc} $flags -c -o "$base/tapes.o" build/tapes/golden.c || exit 1

# draws_alone NAME FLAGS...: for one switch nearly every source is another one, as it changes what structures hold. So all are
# compiled together, in the one-file form, which also tells of functions that nobody calls, and without optimization, which takes
# half of the time: so calls are left of what is not there, and a program that came to one would crash. That each source is whole by
# itself, and that no such calls are left with optimization, is shown by the sets.
quick="-O0 -fno-pie -DSMEAR_INLINE_FORCED=0 -Wall -Wextra -Wconversion -Werror"
draws_alone() {
    name=$1
    shift
    # shellcheck disable=SC2086
    ${CC:-cc} -std=c11 $quick "$@" -c -o "$base/$name.o" "$single" &&
        ${CC:-cc} $flags "$@" -no-pie -Wl,--unresolved-symbols=ignore-in-object-files -o "$base/$name" $players "$base/tapes.o" \
            "$base/$name.o" &&
        ${CC:-cc} $flags "$@" -no-pie -Wl,--unresolved-symbols=ignore-in-object-files -o "$base/$name-zero" tests/examples/zero.c \
            "$base/$name.o" &&
        plays "$name"
}

# plays NAME
plays() {
    "$base/$1-zero" && "$base/$1" >"$base/$1.txt" && return 0
    grep -E 'WRONG|NOT|ERROR|golden frames' "$base/$1.txt"
    return 1
}

# draws NAME FLAGS...: sets, which are what people have, are built as these do
draws() {
    name=$1
    shift
    # shellcheck disable=SC2046,SC2086
    sh tests/shell/compile_cached.sh "$base/cache" "$base/$name.list" "${CC:-cc}" $flags "$@" -- src/*.c src/*/*.c $programs &&
        ${CC:-cc} -o "$base/$name" $(cat "$base/$name.list") &&
        ${CC:-cc} $flags "$@" -o "$base/$name-zero" tests/examples/zero.c $(head -n "$sources" "$base/$name.list") && plays "$name"
}

# zeros NAME FLAGS...: a build that has too little for golden frames
zeros() {
    name=$1
    shift
    # shellcheck disable=SC2086
    ${CC:-cc} -std=c11 $quick "$@" -c -o "$base/$name.o" "$single" &&
        ${CC:-cc} $flags "$@" -no-pie -Wl,--unresolved-symbols=ignore-in-object-files -o "$base/$name-zero" tests/examples/zero.c \
            "$base/$name.o" && "$base/$name-zero"
}

# try COMMAND NAME FLAGS...
try() {
    rm -f "$base/$2.txt"
    claim "$2" "$@"
    [ ! -e "$base/$2.txt" ] || printf '%-24s %s\n' "$2" "$(tail -n 1 "$base/$2.txt")"
}

for switch in $(switches); do
    # shellcheck disable=SC2046
    try draws_alone "$switch" $(without "$switch")
done
rgb565="-DSMEAR_WITH_ALL=0 -DSMEAR_WITH_RGB565=1 -DSMEAR_WITH_DITHER=1 -DSMEAR_WITH_TEXTURE=1"
rgb565="$rgb565 -DSMEAR_WITH_LINEAR=1 -DSMEAR_WITH_GOURAUD=1 -DSMEAR_WITH_ALPHA=1"
# shellcheck disable=SC2086
{
    try draws everything
    try draws fast-stack -DSMEAR_FAST_STACK=1
    try draws core $(sh tests/shell/core_switches.sh)
    try draws sharp $rgb565
    try draws accumulate -DSMEAR_WITH_ALL=0 -DSMEAR_WITH_ACCUMULATE=1 -DSMEAR_WITH_RGB=1 -DSMEAR_WITH_DITHER=1 -DSMEAR_WITH_LINEAR=1 \
        -DSMEAR_WITH_CURVES=1
    try draws reconstruct $rgb565 -DSMEAR_WITH_RECONSTRUCT=1
    try draws auto $rgb565 -DSMEAR_WITH_SUBFRAMES=1
    try draws sketch $rgb565 -DSMEAR_WITH_SUBFRAMES=1 -DSMEAR_WITH_LINES=1
    try zeros manual $(sed -n 's/^ *cc -Os \(.*-DSMEAR_WITH_ALL=0.*\) \.\.\..*/\1/p' include/README.md)
}
finish
