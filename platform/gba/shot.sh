#!/bin/sh
# SPDX-License-Identifier: MIT
# shot.sh PROGRAM.elf FRAME OUT.ppm [KEYS]
# A screenshot of frame FRAME of the demo; KEYS is a mask of keys to press before it: 1 is A.
set -u
rm -f "$3"
exec platform/gba/run.sh -s "$3" ${4:+-k "$4"} "$1" show gba "$2"
