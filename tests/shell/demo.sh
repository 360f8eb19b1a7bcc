#!/bin/sh
# SPDX-License-Identifier: MIT
# demo.sh FOLDER - `make demo` as in a fresh clone: it ends well, and every picture it names is there and is
# one.
set -u
. "$(dirname "$0")/lib.sh"
base=$1
rm -rf "$base"
mkdir -p "$base"

draws() { $make -s build/smear-demo && build/smear-demo "$base/pictures" >"$base/out"; }
names() { # as many pictures, at least
    pictures=$(sed -n 's/^\([^ ]*\.[a-z]*\) .*/\1/p' "$base/out")
    [ "$(echo "$pictures" | grep -c .)" -ge "$1" ] || { cat "$base/out"; return 1; }
}
is_picture() { # PNG, GIF
    start=$(od -An -tx1 -N4 "$1" | tr -d ' ')
    [ "$start" = 89504e47 ] || equals "$start" 47494638
}
tells() { ! build/smear-demo /dev/null/x >"$base/out" 2>"$base/err" && has "$base/err" '^smear'; }

claim "make demo" draws
claim "it names its pictures" names 8
for picture in $pictures; do
    claim "$picture is a picture" is_picture "$picture"
done
claim "nothing unfinished" equals "$(ls "$base/pictures" | grep -F .tmp)" ""
claim "a folder that cannot be made is told" tells
finish
