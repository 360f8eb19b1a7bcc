#!/bin/sh
# SPDX-License-Identifier: MIT
# arenas.sh - frames of the demo by every method in arenas from the least upward: the picture that an ample arena gives, or,
# of the time mask alone, a refusal in words and no file. Never a hole.
#
#     sh tests/shell/arenas.sh build/smear

. "$(dirname "$0")/lib.sh"
of_program "$1"
in_passing arenas
cd "$base" || exit 1
refused=0

# draws_or_says METHOD RENDER-ARGUMENTS...: the same picture, or words
draws_or_says() {
    method=$1
    shift
    rm -f tight.ppm
    if "$smear" "$@" -o tight.ppm 2>words; then
        same tight.ppm ample.ppm
        return
    fi
    refused=$((refused + 1))
    missing tight.ppm && equals "$method" timemask && has words max_triangles
}

for frame in race:4 race:20 race:40 drone:10; do
    at=${frame#*:}
    for method in none auto subframes timemask object layered reconstruct accumulate pingpong camera half; do
        what="render builtin:demo/${frame%:*} --size 120x90 --frames $at-$at --method $method"
        claim "$frame, $method" works $what -o ample.ppm
        "$smear" $what --arena 1000 -o tight.ppm 2>words
        least=$(sed -n 's/.*needs \([0-9]*\) bytes.*/\1/p' words)
        for percent in 100 104 110 120 140 170 210; do
            claim "$frame, $method, $percent % of the least arena" \
                draws_or_says $method $what --arena $((${least:-0} * percent / 100))
        done
    done
done
echo "refused: $refused"
finish
