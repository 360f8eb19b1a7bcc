#!/bin/sh
# SPDX-License-Identifier: MIT
# shot.sh PROGRAM.elf FRAME OUT.ppm [KEYS]
# A screenshot of frame FRAME on the board's panel; KEYS is a mask of keys (enum display_key) to press before it. The program
# draws the frame after three others, and again after keys.
set -u
rm -f "$3"
# shellcheck disable=SC2086
exec $RUN --frames $((${4:+4} + 4)) --shot "$3" ${4:+--keys 4:$4} "$1" show "$SHOT_SCREEN" "$2"
