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
CFLAGS  += $(CORE) -ffreestanding -ffunction-sections -fdata-sections
LDFLAGS += $(CORE) -nostdlib -Wl,--gc-sections -Lplatform/lx106
LDLIBS  += -lgcc

PLATFORM_SRC := $(addprefix platform/,lx106/platform.c lx106/arithmetic.c common/arena.c common/memory.c)
PLATFORM_OBJ := $(BUILD)/platform/lx106/start.o

SCRIPTS       := platform/lx106/sim.ld
TEST_LDFLAGS  := -T sim.ld
BENCH_LDFLAGS := -T sim.ld

# Of sim.ld.
STACK := $(shell awk '/link_stack_limit = link_stack_top/ { print 1024 * $$5 }' platform/lx106/sim.ld)

RUN       := platform/lx106/run.sh
RUN_BENCH := platform/lx106/run.sh -icount shift=0

$(PLATFORM_OBJ): $(BUILD)/%.o: %.S
	$(call say,AS,$<)
	@mkdir -p $(@D)
	$(CC) $(CORE) -c -o $@ $<
