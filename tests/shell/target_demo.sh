#!/bin/sh
# SPDX-License-Identifier: MIT
# target_demo.sh FOLDER PROGRAM SCREEN:STEP...
# The demo on a target: every STEPth frame of its loop has the bits that the host draws. RUN runs a
# program there. With a step of 1, a display that keeps what it is sent shows them too (on this machine). Then, where SHOT takes a screenshot (SHOT PROGRAM FRAME OUT.ppm [DISPLAY]), the
# display shows the host's frames SHOT_FRAMES (FRAME or DISPLAY:FRAME) of SHOT_SCREEN to the bit,
# every pixel SHOT_ZOOM times as large, and another frame is told from them. With SHOT_KEY, SHOT
# presses that key (its last argument), and the frame becomes sharp. Where LOOPS prints the CRCs of what the display shows
# after each frame (LOOPS PROGRAM FRAMES KEYS), these are the host's for LOOPS_FRAMES frames with LOOPS_KEYS held.
set -u
. "$(dirname "$0")/lib.sh"
base=$1 program=$2
shift 2
screen=build/demo/target_screen
mkdir -p "$base"

frames() { # SCREEN STEP
    $screen crcs "$1" "$2" >"$base/$1.want" || return 1
    # shellcheck disable=SC2086
    ${RUN:-} "$program" check "$1" "$2" >"$base/$1.got" && cmp "$base/$1.want" "$base/$1.got"
}
# shows SHUTTER FRAME FILE: the screenshot is that frame
shows() { $screen compare "$SHOT_SCREEN" "$2" "$1" "$3" "$SHOT_ZOOM"; }
# shot SHUTTER FRAME FILE [DISPLAY or KEY]
shot() { $SHOT "$program" "$2" "$3" ${4:+"$4"} && shows "$1" "$2" "$3"; }
shows_not() { ! shows "$@"; }

for loop in "$@"; do
    claim "frames of ${loop%:*}" frames "${loop%:*}" "${loop#*:}"
    [ "${loop#*:}" != 1 ] || claim "${loop%:*} keeps what it is sent" "$screen" kept "${loop%:*}"
done

if [ -n "${SHOT:-}" ]; then
    for frame in $SHOT_FRAMES; do
        file=$base/shot-$frame.ppm
        display=
        case $frame in
        *:*) display=${frame%:*} frame=${frame#*:} file=$base/shot-$display.ppm ;;
        esac
        claim "screenshot of frame $frame${display:+ on $display}" shot 180 "$frame" "$file" "$display"
    done
    claim "a screenshot is not as good as another" shows_not 180 $((frame + 1)) "$file"
    [ -z "${SHOT_KEY:-}" ] || claim "screenshot with a key held" shot 0 "$frame" "$base/shot-key.ppm" "$SHOT_KEY"
fi

loops() {
    $screen keys "$SHOT_SCREEN" "$LOOPS_FRAMES" "$LOOPS_KEYS" >"$base/loops.want" || return 1
    $LOOPS "$program" "$LOOPS_FRAMES" "$LOOPS_KEYS" >"$base/loops.got" && cmp "$base/loops.want" "$base/loops.got"
}
[ -z "${LOOPS:-}" ] || claim "the display over $LOOPS_FRAMES frames, with keys" loops
finish
