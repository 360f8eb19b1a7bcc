#!/bin/sh
# SPDX-License-Identifier: MIT
# qemu.sh QEMU OPTION... PROGRAM.elf [ARGUMENT...]
# Runs a program on one of QEMU's boards; its output and exit status become ours, by semihosting. 99: it faulted;
# 124: it did not end within LIMIT seconds [300]. With IMAGE_AT=ADDRESS the program's .img is what runs, from there, and its
# output is the board's UART's.
set -u
options=
while [ $# -gt 0 ]; do
    case $1 in
    *.elf) break ;;
    esac
    options="$options $1"
    shift
done
if [ $# -eq 0 ]; then
    echo "qemu.sh: no program given" >&2
    exit 2
fi
program=$1
config=enable=on,target=native
if [ -n "${IMAGE_AT:-}" ]; then
    load="-serial stdio -device loader,file=${program%.elf}.img,addr=$IMAGE_AT,force-raw=on,cpu-num=0"
else
    load="-serial none -chardev stdio,id=out -kernel $program"
    config=$config,chardev=out
fi
for argument in "$@"; do
    config="$config,arg=$argument"
done
# shellcheck disable=SC2086
exec timeout "${LIMIT:-300}" $options -display none -monitor none $load -semihosting-config "$config" </dev/null
