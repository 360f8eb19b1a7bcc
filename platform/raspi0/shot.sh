#!/bin/sh
# SPDX-License-Identifier: MIT
# shot.sh PROGRAM.elf FRAME OUT.ppm [KEYS]
# A screenshot of frame FRAME; KEYS is a mask of keys (enum display_key) to press before it.
set -u
rm -f "$3"
# shellcheck disable=SC2086
exec timeout "${LIMIT:-300}" python3 platform/raspi0/watch.py --shot "$3" ${4:+--frames 2 --keys 1:$4} "$1" show "$SHOT_SCREEN" "$2"
