# SPDX-License-Identifier: MIT
# A machine of QEMU without an operating system or a C library: PLACE is its folder in platform/, MAP its linker script, CORE the options
# of its processor.
CFLAGS  += $(CORE) -ffreestanding -ffunction-sections -fdata-sections
LDFLAGS += $(CORE) -nostdlib -Wl,--gc-sections -L$(PLACE)
LDLIBS  += -lgcc

PLATFORM_OBJ := $(BUILD)/$(PLACE)/start.o

SCRIPTS       := $(PLACE)/$(MAP)
TEST_LDFLAGS  := -T $(MAP)
BENCH_LDFLAGS := -T $(MAP)

# Of the linker script.
STACK := $(shell awk '/link_stack_limit = link_stack_top/ { print 1024 * $$5 }' $(PLACE)/$(MAP))

RUN       := $(PLACE)/run.sh
RUN_BENCH := $(PLACE)/run.sh -icount shift=0

$(PLATFORM_OBJ): $(BUILD)/%.o: %.S
	$(call say,AS,$<)
	@mkdir -p $(@D)
	$(CC) $(CORE) -c -o $@ $<
