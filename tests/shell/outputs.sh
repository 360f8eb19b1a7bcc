#!/bin/sh
# SPDX-License-Identifier: MIT
# outputs.sh - what the program smear leaves on a disk: complete files under the names it was given, all of them or
# none, and nothing else, whoever else writes at the same time and whatever lies there already.
#
#     sh tests/shell/outputs.sh build/smear [PAIRS]

. "$(dirname "$0")/lib.sh"
of_program "$1"
pairs=${2:-1000}
arm=$(absolute tests/data/arm.gltf)
in_passing outputs
mkdir "$base/work" "$base/want" && cd "$base/work" || exit 1

here_is() { equals "$(ls -A | tr '\n' ' ')" "$1"; } # NAMES, each with a blank behind it

tiny="render builtin:demo/drone --size 8x8"

# ------------------------------------------------------------------ what lies there already

printf 'mine\n' >x.png.tmp
printf 'kept\n' >kept
ln -s kept x.gif.tmp
claim "a picture" works $tiny -o x.png
claim "and a loop" works $tiny --frames 0-1 -o x.gif
claim "files of other names stay" equals "$(cat x.png.tmp kept)" "mine
kept"
claim "links, too" [ -L x.gif.tmp ]
claim "and nothing is added" here_is "kept x.gif x.gif.tmp x.png x.png.tmp "
rm -f ./*
cp "$arm" m.h.tmp
claim "a model whose name is that of the header, and more" works convert m.h.tmp -o m.h
claim "is still there" same m.h.tmp "$arm"
rm -f ./*
printf 'kept\n' >kept
ln -s kept x.png
claim "a name that is a link" works $tiny -o x.png
claim "becomes a picture" [ -f x.png -a ! -L x.png ]
claim "and what it led to stays" equals "$(cat kept)" kept
long=$(printf '%0240d' 0)
claim "names as long as a disk takes" works $tiny -o "$long.png"
rm -f ./*

# ------------------------------------------------------------------ two at a time

# pair OUTPUT N ARGUMENTS...: N times two programs that write one file, which is then one's or the other's
pair() {
    output=$1 n=$2
    shift 2
    "$smear" "$@" --clear ff0000 >"$base/want/text.a" 2>&1 && mv "$output" "$base/want/a" || return 1
    "$smear" "$@" --clear 0000ff >"$base/want/text.b" 2>&1 && mv "$output" "$base/want/b" || return 1
    differ "$base/want/a" "$base/want/b" || return 1
    mine="$output.tmp"
    echo mine >"$mine"
    while [ "$n" -gt 0 ]; do
        "$smear" "$@" --clear ff0000 >"$base/text.a" 2>&1 &
        first=$!
        "$smear" "$@" --clear 0000ff >"$base/text.b" 2>&1 || return 1
        wait $first || { cat "$base/text.a"; return 1; }
        cmp -s "$output" "$base/want/a" || cmp -s "$output" "$base/want/b" || { echo "corrupt with $n to go"; return 1; }
        n=$((n - 1))
        pairs_done=$((pairs_done + 1))
    done
    here_is "$output $mine " && equals "$(cat "$mine")" mine && rm -f ./*
}
pairs_done=0
quarter=$((pairs / 4))
claim "pairs that write a PNG" pair x.png $quarter $tiny --shutter 0 -o x.png
claim "a PPM" pair x.ppm $quarter $tiny --shutter 0 -o x.ppm
claim "a GIF" pair x.gif $quarter $tiny --shutter 0 --frames 0-1 -o x.gif
claim "an APNG" pair x.apng $quarter $tiny --shutter 0 --frames 0-1 -o x.apng
echo "$pairs_done pairs of programs on one output, none corrupt"
rm -f ./*

# ------------------------------------------------------------------ all or none

# none STATUS SUBJECT ARGUMENTS...: one line, and the folder as it was
none() {
    status=$1 subject=$2
    shift 2
    rm -f ./* && echo old >x.png
    run "$@"
    has_failed "$status" "$subject" && here_is "x.png " && equals "$(cat x.png)" old
}
if [ -c /dev/full ]; then
    claim "statistics that fit nowhere" none 1 /dev/full $tiny -o x.png --stats /dev/full
    to_full() { "$smear" "$@" >/dev/full 2>"$base/err"; }
    claim "statistics to a standard output that is full" eval \
        'rm -f ./*; ! to_full $tiny -o x.png --stats - && here_is "" && has "$base/err" "standard output: cannot be written"'
    claim "a report that is lost" eval 'rm -f ./*; ! to_full convert "$arm" -o m.h && here_is ""'
    claim "distances that are lost" eval \
        'rm -f ./*; works $tiny -o a.ppm && ! to_full compare a.ppm a.ppm --diff d.ppm && here_is "a.ppm "'
fi
claim "depth into a folder that is not there" none 1 nodir/x.pfm $tiny -o x.png --depth nodir/x.pfm
claim "velocity" none 1 nodir/x.pfm $tiny -o x.png --velocity nodir/x.pfm
mkdir "$base/folder.pfm"
claim "depth into a folder" none 1 "$base/folder.pfm" $tiny -o x.png --depth "$base/folder.pfm"
claim "frames of which one cannot be written" eval 'rm -f ./*; mkdir f2.png; run $tiny --frames 0-3 -o f%d.png;
    has_failed 1 f2.png && here_is "f2.png " && rmdir f2.png'
claim "all of them" works $tiny --frames 0-3 -o f%d.png --depth d%d.pfm --stats s.json
claim "are there" here_is "d0.pfm d1.pfm d2.pfm d3.pfm f0.png f1.png f2.png f3.png s.json "
rm -f ./*

# ------------------------------------------------------------------ standard output

claim "statistics on standard output" works $tiny -o x.png --stats -
claim "are all that is there" eval 'head -n 1 "$base/out" | grep -q "^{\"frames\":\[$" && tail -n 1 "$base/out" | grep -q "^\]}$"'
claim "and no file" here_is "x.png "
rm -f ./*
claim "a header in a file" works convert "$arm" -o arm.h
"$smear" convert "$arm" -o - >"$base/out" 2>"$base/err"
claim "is the same on standard output" same arm.h "$base/out"
claim "the report stands beside it" has "$base/err" '^flash: '
claim "and no file" here_is "arm.h "
rm -f ./*
claim "the user's input on standard output" works view builtin:demo/drone --size 8x8 --out null --frames 1 --record -
claim "is no file" here_is ""
claim "the program alone says what it can do" eval 'works && has "$base/out" "smear render SCENE"'

finish
