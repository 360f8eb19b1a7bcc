#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh BOARD-OPTION... PROGRAM.elf [ARGUMENT...]
# Runs a program on one of QEMU's Arm boards.
exec platform/common/qemu.sh qemu-system-arm "$@"
