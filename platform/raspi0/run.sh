#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh [OPTION...] PROGRAM.elf [ARGUMENT...]
# Runs a program's kernel image on QEMU's Raspberry Pi Zero; its output is the UART's. 99: it faulted; 124: it did not end within
# LIMIT seconds [300].
set -u
options=
while [ $# -gt 0 ]; do
    case $1 in
    *.elf) break ;;
    esac
    options="$options $1"
    shift
done
[ $# -gt 0 ] || { echo "run.sh: no program given" >&2; exit 2; }
program=$1
config=enable=on,target=native
for argument in "$@"; do
    config="$config,arg=$argument"
done
# shellcheck disable=SC2086
exec timeout "${LIMIT:-300}" qemu-system-arm -M raspi0 $options -display none -monitor none -serial stdio \
    -semihosting-config "$config" -device "loader,file=${program%.elf}.img,addr=0x8000,force-raw=on,cpu-num=0" </dev/null
