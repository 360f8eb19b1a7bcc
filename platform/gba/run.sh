#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh [OPTION VALUE]... PROGRAM.elf [ARGUMENT...]
# Runs a program for the Game Boy Advance; options are those of gbarun.c.
set -u
options=
while [ $# -gt 1 ]; do
    case $1 in
    -*)
        options="$options $1 $2"
        shift 2
        ;;
    *) break ;;
    esac
done
program=$1
shift
cartridge=${program%.elf}.gba
arm-none-eabi-objcopy -O binary "$program" "$cartridge" || exit 2
# shellcheck disable=SC2086
exec timeout "${LIMIT:-300}" build/gba/gbarun $options "$cartridge" "$@"
