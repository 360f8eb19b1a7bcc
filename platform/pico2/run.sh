#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh [OPTION VALUE]... PROGRAM.elf [ARGUMENT...]
# Runs an image for a Pico 2 in QEMU; options are those of machine.c, and -icount. The image is PROGRAM.bin, with arguments where
# board.c looks for them.
set -u
options= counts=
while [ $# -gt 1 ]; do
    case $1 in
    --*) options="$options,arg=$1,arg=$(echo "$2" | sed 's/,/,,/g')" ;;
    -icount) counts="$1 $2" ;;
    *) break ;;
    esac
    shift 2
done
program=$1
shift
image=${program%.elf}-$$.bin
trap 'rm -f "$image"' EXIT
arm-none-eabi-objcopy -O binary "$program" "$image" || exit 2
if [ $# -gt 0 ]; then
    at=$(grep -abo "smear arguments" "$image" | head -n 1 | cut -d : -f 1)
    [ -n "$at" ] || { echo "run.sh: $program takes no arguments" >&2; exit 2; }
    printf '%s\0' "$*" | dd of="$image" bs=1 seek=$((at + 16)) conv=notrunc 2>/dev/null
fi
# shellcheck disable=SC2086
timeout "${LIMIT:-600}" qemu-system-arm -M musca-b1 $counts -display none -monitor none -serial none \
    -chardev stdio,id=out -semihosting-config "enable=on,target=native,chardev=out,arg=machine$options" \
    -device loader,file="$image",addr=0x10000000,force-raw=on -device loader,file="${program%/*}/machine.elf",cpu-num=0 </dev/null
