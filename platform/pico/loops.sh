#!/bin/sh
# SPDX-License-Identifier: MIT
# loops.sh PROGRAM.elf FRAMES KEYS
# The CRCs of what the panel shows after each of the first FRAMES frames; KEYS: frame:mask,... (enum display_key).
exec sh platform/pico/run.sh --frames "$2" --keys "$3" "$1"
