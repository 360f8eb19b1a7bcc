# SPDX-License-Identifier: MIT
# Xtensa of an ESP8266 (lx106: a call ABI without register windows), on QEMU's sim machine. ESP32 and ESP32-S3 have the same
# instructions and more; Debian has no compiler for them.
# Packages: gcc-xtensa-lx106 qemu-system-misc
CC       := xtensa-lx106-elf-gcc
AR       := xtensa-lx106-elf-ar
NM       := xtensa-lx106-elf-nm
SIZE     := xtensa-lx106-elf-size
EXE      := .elf
NEEDS    := xtensa-lx106-elf-gcc qemu-system-xtensa

# Literals stand before the functions that load them: in a section of their own they are too far away.
CORE    := -mtext-section-literals
PLACE   := platform/lx106
MAP     := sim.ld

PLATFORM_SRC := $(addprefix platform/,lx106/platform.c lx106/arithmetic.c common/arena.c common/memory.c)

include platform/common/bare.mk
