# SPDX-License-Identifier: MIT
# cortexm.mk - what the Cortex-M ports share; platform/cortex-*/target.mk includes it after setting
#   CORE     compiler flags of the core
#   BOARD    QEMU's options for tests; LAYOUT: the linker script that fits
# Benchmarks run on an mps2 board, whose timer counts instructions: BENCH_BOARD, BENCH_LAYOUT.
# Packages: gcc-arm-none-eabi qemu-system-arm

CC       := arm-none-eabi-gcc
AR       := arm-none-eabi-ar
NM       := arm-none-eabi-nm
SIZE     := arm-none-eabi-size
EXE      := .elf
NEEDS    := arm-none-eabi-gcc qemu-system-arm

BENCH_BOARD  ?= -M mps2-an385
BENCH_LAYOUT ?= mps2.ld

CFLAGS  += $(CORE) -ffreestanding -ffunction-sections -fdata-sections
LDFLAGS += $(CORE) -nostdlib -Wl,--gc-sections -Lplatform/cortexm
LDLIBS  += -lgcc

PLATFORM_SRC := $(addprefix platform/cortexm/,startup.c platform.c arithmetic.c) \
                $(addprefix platform/common/,arena.c arguments.c memory.c semihost.c)

# Of the linker script.
STACK = $(shell sed -n 's/^link_stack_bytes = \([0-9]*\);/\1/p' platform/cortexm/$(LAYOUT))

RUN       := platform/cortexm/run.sh $(BOARD)
RUN_BENCH := platform/cortexm/run.sh $(BENCH_BOARD) -icount shift=6

SCRIPTS       := $(wildcard platform/cortexm/*.ld)
TEST_LDFLAGS  := -T $(LAYOUT)
BENCH_LDFLAGS := -T $(BENCH_LAYOUT)
