# SPDX-License-Identifier: MIT
# RISC-V of 32 bits with multiplication and compressed code, on QEMU's virt machine.
# Packages: gcc-riscv64-unknown-elf qemu-system-misc
CC       := riscv64-unknown-elf-gcc
AR       := riscv64-unknown-elf-ar
NM       := riscv64-unknown-elf-nm
SIZE     := riscv64-unknown-elf-size
EXE      := .elf
NEEDS    := riscv64-unknown-elf-gcc qemu-system-riscv32

CORE    := -march=rv32imc -mabi=ilp32 -mcmodel=medany
PLACE   := platform/rv32imc
MAP     := virt.ld

PLATFORM_SRC := platform/rv32imc/platform.c \
                $(addprefix platform/common/,arena.c arguments.c memory.c semihost.c)

include platform/common/bare.mk
