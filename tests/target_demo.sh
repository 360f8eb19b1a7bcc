#!/bin/sh
# SPDX-License-Identifier: MIT
# target_demo.sh FOLDER PROGRAM SCREEN:STEP...
# The demo on a target: every STEPth frame of its loop has the bits that the host draws. RUN runs a
# program there. Then, where SHOT takes a screenshot (SHOT PROGRAM FRAME OUT.ppm [DISPLAY]), the
# display shows the host's frames SHOT_FRAMES (FRAME or DISPLAY:FRAME) of SHOT_SCREEN to the bit,
# every pixel SHOT_ZOOM times as large, and another frame is told from them. With SHOT_KEY, SHOT
# presses that key (its last argument), and the frame becomes sharp.
set -u
folder=$1 program=$2
shift 2
screen=build/demo/target_screen
passed=0
failed=0
mkdir -p "$folder"

count() {
    if [ "$1" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $2"
    fi
}

for loop in "$@"; do
    name=${loop%:*} step=${loop#*:}
    $screen crcs "$name" "$step" >"$folder/$name.want" || exit 1
    # shellcheck disable=SC2086
    ${RUN:-} "$program" check "$name" "$step" >"$folder/$name.got" &&
        cmp "$folder/$name.want" "$folder/$name.got"
    count $? "frames of $name"
done

if [ -n "${SHOT:-}" ]; then
    for frame in $SHOT_FRAMES; do
        shot=$folder/shot-$frame.ppm
        display=
        case $frame in
        *:*) display=${frame%:*} frame=${frame#*:} shot=$folder/shot-$display.ppm ;;
        esac
        # shellcheck disable=SC2086
        $SHOT "$program" "$frame" "$shot" $display &&
            $screen compare "$SHOT_SCREEN" "$frame" 180 "$shot" "$SHOT_ZOOM"
        count $? "screenshot of frame $frame${display:+ on $display}"
    done
    if $screen compare "$SHOT_SCREEN" "$((frame + 1))" 180 "$shot" "$SHOT_ZOOM" 2>/dev/null; then
        count 1 "a screenshot is as good as another"
    fi
    if [ -n "${SHOT_KEY:-}" ]; then
        $SHOT "$program" "$frame" "$folder/shot-key.ppm" "$SHOT_KEY" &&
            $screen compare "$SHOT_SCREEN" "$frame" 0 "$folder/shot-key.ppm" "$SHOT_ZOOM"
        count $? "screenshot with a key held"
    fi
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
