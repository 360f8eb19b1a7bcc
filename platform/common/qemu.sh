#!/bin/sh
# SPDX-License-Identifier: MIT
# qemu.sh QEMU OPTION... PROGRAM.elf [ARGUMENT...]
# Runs a program on one of QEMU's boards; its output and exit status become ours, by semihosting. 99: it faulted;
# 124: it did not end within LIMIT seconds [300].
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
config="enable=on,target=native,chardev=out"
for argument in "$@"; do
    config="$config,arg=$argument"
done
# shellcheck disable=SC2086
exec timeout "${LIMIT:-300}" $options -display none -monitor none -serial none \
    -chardev stdio,id=out -semihosting-config "$config" -kernel "$program" </dev/null
