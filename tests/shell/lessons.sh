#!/bin/sh
# SPDX-License-Identifier: MIT
# lessons.sh pictures|test NAME... - platform/lessons/NAME.c in build/lessons: the picture NAME.png of its last frame, and
# sums.txt of all its frames. test: it is shorter than 80 lines; as C99 and as C++11 (where there is CXX) it compiles without a
# warning and draws the picture and has the sum that are kept beside it.
set -eu
mode=$1
shift
base=build/lessons home=platform/lessons
lib=${LIB:-build/host/libsmear.a} demo=${DEMO:-build/smear-demo}
flags="-O1 -Wall -Wextra -pedantic -Werror -Iinclude -I."
mkdir -p $base
${CC:-cc} -std=c99 $flags -c -o $base/panel.o $home/panel.c
: >$base/sums.txt
for name; do
    lines=$(wc -l <$home/"$name".c)
    [ "$lines" -lt 80 ] || { echo "lessons: $name.c has $lines lines, 80 are too many" >&2; exit 1; }
    ${CC:-cc} -std=c99 $flags -o $base/"$name" $home/"$name".c $base/panel.o "$lib"
    echo "$name $($base/"$name" 2>&1 >$base/"$name".ppm)" >>$base/sums.txt
    "$demo" --enlarge 1 $base/"$name".ppm $base/"$name".png
    [ $mode = test ] || continue
    cmp $base/"$name".png $home/"$name".png ||
        { echo "lessons: $name draws another picture: make lessons-accept, if it is right" >&2; exit 1; }
    [ -n "${CXX:-}" ] || continue
    ${CXX} -std=c++11 $flags -o $base/"$name-cxx" -x c++ $home/"$name".c -x none $base/panel.o "$lib"
    $base/"$name-cxx" 2>/dev/null | cmp - $base/"$name".ppm
done
[ $mode != test ] || diff $home/sums.txt $base/sums.txt
