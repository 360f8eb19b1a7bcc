#!/bin/sh
# SPDX-License-Identifier: MIT
# core_alone.sh LIBRARY ROOM...
# Compiles the core, the sources of ROOM..., without the switches of other systems' methods, and draws the README's first program by
# it: it links without their rooms, and prints the picture that it prints by LIBRARY, which has them all.
set -eu
library=$1
shift
base=build/test/core-alone
off='-DSMEAR_WITH_ACCUMULATE=0 -DSMEAR_WITH_RECONSTRUCT=0 -DSMEAR_WITH_TIMEMASK=0 -DSMEAR_WITH_SKY=0 -DSMEAR_WITH_LIGHTS=0 -DSMEAR_WITH_OVERLAY=0 -DSMEAR_WITH_FOG=0 -DSMEAR_WITH_WORKERS=0 -DSMEAR_WITH_DAMAGE=0 -DSMEAR_WITH_DISPLAY=0 -DSMEAR_WITH_CURVES=0'
rm -rf "$base"
mkdir -p "$base"
for room; do
    ls "$room"/*.c
done | xargs -P 2 -I@ sh -c 'file=@; ${CC:-cc} -std=c11 -O1 -Wall -Wextra -Werror -Iinclude -Isrc '"$off"' -c -o \
    '"$base"'/$(echo "${file%.c}.o" | tr / _) "$file"'
ar rcs "$base/libcore.a" "$base"/*.o
awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' README.md >"$base/first.c"
# shellcheck disable=SC2086
${CC:-cc} -std=c11 -Iinclude $off -o "$base/core" "$base/first.c" "$base/libcore.a"
${CC:-cc} -std=c11 -Iinclude -o "$base/all" "$base/first.c" "$library"
"$base/core" >"$base/core.ppm"
"$base/all" >"$base/all.ppm"
cmp "$base/core.ppm" "$base/all.ppm"
echo "the core alone: $# rooms"
