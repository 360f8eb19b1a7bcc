#!/bin/sh
# SPDX-License-Identifier: MIT
# view_display.sh - firmware on a desktop's display (platform/host/desktop_display.c): the demo's frames are
# those of the boards, environment variables do what they say.
#
#     sh tests/shell/view_display.sh build/host/demo-screen
. "$(dirname "$0")/view_lib.sh"
demo=$smear
cd "$base" || exit 1
unset TERM
export SMEAR_OUT=null

# show SCREEN: with whatever variables are set
show() { "$demo" show "$@" >out 2>err; }
frames() { SMEAR_FRAMES=$1 SMEAR_CRC=1 show "$2" || { cat err; return 1; }; }

as_checked() { # SCREEN: every 4th frame is what the demo itself computes, which draws those between, too: frames depend on the last
    "$demo" check "$1" 1 | sed -n '1~4s/.* //p' >want
    frames 60 "$1" && sed -n '1~4s/.*crc32=//p' out >got || return 1
    [ -s want ] && head -n 15 want >want15 && cmp want15 got
}
claim "the OLED's frames" as_checked oled
claim "the handheld's frames" as_checked gba
claim "it ends by itself" eval 'frames 3 oled && equals "$(wc -l <out)" 3'

accepts() {
    SMEAR_FRAMES=3 SMEAR_CHECK=gold SMEAR_UPDATE=1 show oled && exists gold && exists gold.0002.png &&
        SMEAR_FRAMES=3 SMEAR_CHECK=gold show oled
}
claim "what was accepted is found again" accepts
refuses() { # the shutter is changed by a key, so frames differ from then on
    printf '1 key right\n' >keys
    SMEAR_FRAMES=3 SMEAR_CHECK=gold SMEAR_PLAY=keys show oled && { echo "not told"; return 1; }
    has err "smear: gold: [12] of 3 pictures differ" && exists gold.0002.got.png &&
        exists gold.0002.difference.png && missing gold.0000.got.png
}
claim "what differs is told, with pictures; keys arrive" refuses
claim "a recording" eval 'SMEAR_RECORD=rec frames 2 oled && exists rec'
claim "no number" eval '! SMEAR_FRAMES=x show oled && has err "SMEAR_FRAMES"'
claim "no quarter turn" eval '! SMEAR_FRAMES=1 SMEAR_ROTATE=45 show oled && has err "SMEAR_ROTATE"'
claim "no such output" eval '! SMEAR_OUT=paper show oled && has err "SMEAR_OUT=paper"'
claim "no display" eval '! SMEAR_OUT= SMEAR_FRAMES=1 show oled && has err "smear: no display: x11: DISPLAY is not set"'
claim "checked where there is no display" eval 'SMEAR_OUT= SMEAR_FRAMES=3 SMEAR_CHECK=gold show oled'
claim "no file to check" eval '! SMEAR_FRAMES=1 SMEAR_CHECK=none show oled && has err "smear: none: "'

finish
