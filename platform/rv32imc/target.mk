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
CFLAGS  += $(CORE) -ffreestanding -ffunction-sections -fdata-sections
LDFLAGS += $(CORE) -nostdlib -Wl,--gc-sections -Lplatform/rv32imc
LDLIBS  += -lgcc

PLATFORM_SRC := platform/rv32imc/platform.c \
                $(addprefix platform/common/,arena.c arguments.c memory.c semihost.c)
PLATFORM_OBJ := $(BUILD)/platform/rv32imc/start.o

SCRIPTS       := platform/rv32imc/virt.ld
TEST_LDFLAGS  := -T virt.ld
BENCH_LDFLAGS := -T virt.ld

# Of virt.ld.
STACK := $(shell awk '/link_stack_limit = link_stack_top/ { print 1024 * $$5 }' platform/rv32imc/virt.ld)

RUN       := platform/rv32imc/run.sh
RUN_BENCH := platform/rv32imc/run.sh -icount shift=0

$(PLATFORM_OBJ): $(BUILD)/%.o: %.S
	$(call say,AS,$<)
	@mkdir -p $(@D)
	$(CC) $(CORE) -c -o $@ $<
