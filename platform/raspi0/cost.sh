#!/bin/sh
# SPDX-License-Identifier: MIT
# cost.sh PROGRAM.elf cost SCREEN [BLUR [STEP]]
# What frames cost, in instructions; and how many a second that is at 1 GHz, where an instruction takes 1.3 cycles.
set -u

counted() { IMAGE_AT=0x8000 sh platform/common/qemu.sh qemu-system-arm -M raspi0 -icount shift=10 "$@"; }

case $2 in
cost) ;;
*) counted "$@"; exit ;;
esac
told=$(counted "$@") || { echo "$told"; exit 1; }
echo "$told" | awk '{ print } / per frame, / && /^[a-z]/ { rate[++n] = sprintf("%s %.1f", $1, 1e9 / 1.3 / $2) }
    END { printf "frames per second:"; for (i = 1; i <= n; i++) printf "%s %s", (i > 1 ? "," : ""), rate[i]; print "" }'
