#!/bin/sh
# SPDX-License-Identifier: MIT
# loops.sh PROGRAM.elf FRAMES KEYS
# The CRCs of what the screen shows after each of the first FRAMES frames; KEYS: frame:mask,... (enum display_key).
exec timeout "${LIMIT:-600}" python3 platform/raspi0/watch.py --frames "$2" --keys "$3" "$1" show "$SHOT_SCREEN"
