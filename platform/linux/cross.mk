# SPDX-License-Identifier: MIT
# cross.mk - what the ports to Linux on other processors share; a target.mk includes it after setting
#   CROSS   how its tools' names start; CORE   compiler flags; QEMU   runs programs in tests
CC    := $(CROSS)-gcc
AR    := $(CROSS)-ar
NM    := $(CROSS)-nm
SIZE  := $(CROSS)-size
NEEDS := $(CC) $(firstword $(QEMU))

CFLAGS  += $(CORE) -D_POSIX_C_SOURCE=200809L
LDFLAGS += $(CORE) -static
LDLIBS  += -lm

PLATFORM_SRC := platform/host/platform.c

RUN       := timeout 600 $(QEMU)
RUN_BENCH := $(RUN)

DISPLAY_SRC  = $(filter-out $(PLATFORM_SRC),$(HOST_DISPLAY_SRC))
DEMO_SCREEN := linux
DEMO_LOOPS  := linux:18 pi-320:18
