# SPDX-License-Identifier: MIT
# BBC micro:bit: Cortex-M0, 256 kB of flash, 16 kB of RAM. The smallest firmware that blurs (tiny.c),
# held to 26 kB of flash without its mesh and 12 kB of RAM.
CORE   := -mcpu=cortex-m0 -mthumb
BOARD  := -M microbit
LAYOUT := tiny.ld
include platform/cortexm/cortexm.mk

OPT     := -Os
CFLAGS  := $(filter-out -O%,$(CFLAGS)) $(OPT) -Iplatform/microbit -D'SMEAR_CONFIG_FILE="smear_tiny.h"'
LDFLAGS += -Lplatform/microbit
SCRIPTS += platform/microbit/tiny.ld

# Golden frames want all that was left out: `make switches-test`, and the frames of tiny-test.
TARGET_TESTS :=
# An archive to be optimized when it is linked has no symbols of its own yet.
SYMBOLS_LIB      := -
SYMBOLS_PROGRAMS = $(BUILD)/tiny$(EXE)
FILE_SRC     := platform/microbit/file.c
$(BUILD)/platform/tiny.o: CFLAGS += -DTINY_MEMORY=$(TINY_MEMORY)
# smear_memory_size() of its desc, exactly.
TINY_MEMORY := 9456

# The library is optimized as a whole, 1 kB less, and tells who calls whom, for the worst stack.
AR      := arm-none-eabi-gcc-ar

LDFLAGS += -Os -flto -flto-partition=none -fcallgraph-info=su -dumpdir $@.
$(BUILD)/src/%.o: CFLAGS += -flto
$(BUILD)/platform/%.o: CFLAGS += -fcallgraph-info=su
