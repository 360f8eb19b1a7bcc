#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh OPTION... PROGRAM.elf [ARGUMENT...]
# Runs a program on QEMU's sim machine.
exec platform/common/qemu.sh qemu-system-xtensa -M sim -cpu lx106 "$@"
