#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh OPTION... PROGRAM.elf [ARGUMENT...]
# Runs a program on QEMU's virt machine.
exec platform/common/qemu.sh qemu-system-riscv32 -M virt -cpu rv32,f=false,d=false -bios none "$@"
