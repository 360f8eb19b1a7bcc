# SPDX-License-Identifier: MIT
# Raspberry Pi Pico 2 and other boards with an RP2350, in platform/pico/boards.h: BOARD=thumby_color. The driver is platform/pico's,
# on the registers of chip.h where that has the pico-sdk: a compiler is all that it needs. Tests run the image in QEMU.
# Packages: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
CC    := arm-none-eabi-gcc
AR    := arm-none-eabi-ar
NM    := arm-none-eabi-nm
SIZE  := arm-none-eabi-size
EXE   := .elf
NEEDS := arm-none-eabi-gcc

BOARD ?= pico2_breakout
BUILD := $(BUILD)/$(BOARD)
CORE  := -mcpu=cortex-m33 -mthumb -mfloat-abi=soft

# The library as platform/pico/CMakeLists.txt compiles it.
CFLAGS += $(CORE) -ffreestanding -ffunction-sections -fdata-sections -DSMEAR_WITH_LINEAR=0 -DSMEAR_WITH_TIMEMASK=0 -DSMEAR_WITH_FOG=0 \
          -DSMEAR_TICKETS=1 -DSMEAR_ASM_ARMV7EM=1 -DSMEAR_BOARD=$(BOARD) -DPICO_RP2350=1 -D'SMEAR_CHIP_FILE="platform/pico2/chip.h"'
LDFLAGS += $(CORE) -nostdlib -Wl,--gc-sections -Lplatform/pico2 -Lplatform/pico/rp2350 -Lplatform/cortexm
LDLIBS  += -lgcc
$(addprefix $(BUILD)/platform/,demo.o model.o game/main.o): CFLAGS += -Dmain=demo_main

PLATFORM_SRC := platform/pico2/chip.c platform/pico/board.c $(addprefix platform/common/,arguments.c memory.c)
DISPLAY_SRC  := platform/pico/display.c
SCRIPTS      := platform/pico2/pico2.ld platform/pico/rp2350/hot.ld platform/cortexm/sections.ld
TEST_LDFLAGS := -T pico2.ld
TARGET_TESTS :=

# What the board gets, beside each program.
FIRMWARE := $(BUILD)/demo.uf2 $(BUILD)/game.uf2 $(BUILD)/model.uf2
demo-firmware: $(BUILD)/demo.uf2
game-firmware: $(BUILD)/game.uf2
model-firmware: $(BUILD)/model.uf2
$(FIRMWARE): %.uf2: %.elf build/pico2/uf2
	arm-none-eabi-objcopy -O binary $< $*.bin
	build/pico2/uf2 $*.bin $@

build/pico2/uf2: platform/pico/uf2.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(HOST_CC) $(HOST_CFLAGS) -o $@ $<

export RUN := sh platform/pico2/run.sh
RUN_BENCH := sh platform/pico2/run.sh -icount shift=3
RUN_NEEDS := $(BUILD)/machine.elf
MACHINE_OBJ := $(addprefix $(BUILD)/platform/,pico2/machine.o $(addprefix common/,arguments.o memory.o semihost.o))

$(BUILD)/machine.elf: $(MACHINE_OBJ) platform/pico2/machine.ld
	$(call say,LD)
	$(CC) $(CORE) -nostdlib -T platform/pico2/machine.ld -o $@ $(MACHINE_OBJ) $(LDLIBS)

# Core 0's is in sections.ld's place, core 1's an array of board.c.
STACK      := $(shell sed -n 's/^link_stack_bytes = \([0-9]*\);/\1/p' platform/pico2/pico2.ld)
STACK_WORK := $(shell sed -n 's/.*CORE1_STACK = \([0-9]*\).*/\1/p' platform/pico/board.c)

GAME_STEP   := 600
DEMO_SCREEN := pico-$(shell awk -F '[^A-Za-z0-9_]+' '$$1 == "BOARD" && $$2 == "$(BOARD)" { print $$4 }' platform/pico/boards.h)
DEMO_LOOPS  := $(DEMO_SCREEN):24
SHOW = $(SCREENSHOT)
export SHOT        := sh platform/pico/shot.sh
export SHOT_SCREEN := $(DEMO_SCREEN)
export SHOT_FRAMES := 45
export SHOT_ZOOM   := 1
export SHOT_KEY    := 16
# A while sharp, with a longer and with a shorter shutter, and standing still.
export LOOPS        := sh platform/pico/loops.sh
export LOOPS_FRAMES := 48
export LOOPS_KEYS   := 6:16,7:0,10:16,11:0,20:8,21:0,26:4,27:0,29:4,30:0,33:8,34:0,40:32,41:0,44:32,45:0

# The demo with another chip.c, for tests.
ifdef SPOILT
$(SPOILT)/demo.elf: $(SPOILT)/chip.c $(BUILD)/demo.elf
	$(CC) $(CFLAGS) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $< $(filter-out %/chip.o,$(FIRMWARE_OBJ)) $(LIB) $(LDLIBS)
endif
