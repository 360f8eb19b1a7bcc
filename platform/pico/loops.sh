#!/bin/sh
# SPDX-License-Identifier: MIT
# loops.sh PROGRAM.elf FRAMES KEYS
# The CRCs of what the panel shows after each of the first FRAMES frames; KEYS: frame:mask,... (enum display_key).
# shellcheck disable=SC2086
exec $RUN --frames "$2" --keys "$3" "$1"
