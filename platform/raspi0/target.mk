# SPDX-License-Identifier: MIT
# Raspberry Pi Zero, Zero W and 1 without an operating system: ARM1176 at 1 GHz, HDMI. The firmware is a kernel.img for the
# card; tests run it in QEMU. SCREEN=pi-320: 320x240 pixels instead of 640x480 (demo_player.c).
# Packages: gcc-arm-none-eabi qemu-system-arm python3
CC      := arm-none-eabi-gcc
AR      := arm-none-eabi-ar
NM      := arm-none-eabi-nm
SIZE    := arm-none-eabi-size
EXE     := .elf
NEEDS   := arm-none-eabi-gcc qemu-system-arm

SCREEN ?= pi-640
BUILD  := $(BUILD)/$(SCREEN)
CORE   := -mcpu=arm1176jzf-s -marm -mfloat-abi=soft

CFLAGS  += $(CORE) -ffreestanding -ffunction-sections -fdata-sections
LDFLAGS += $(CORE) -nostdlib -Wl,--gc-sections -Lplatform/raspi0
LDLIBS  += -lgcc

PLATFORM_SRC := platform/raspi0/board.c $(addprefix platform/common/,arena.c arguments.c memory.c semihost.c)
PLATFORM_OBJ := $(BUILD)/platform/raspi0/start.o

SCRIPTS       := platform/raspi0/kernel.ld
TEST_LDFLAGS  := -T kernel.ld
BENCH_LDFLAGS := -T kernel.ld

RUN       := env IMAGE_AT=0x8000 sh platform/common/qemu.sh qemu-system-arm -M raspi0
RUN_BENCH := sh platform/raspi0/cost.sh

# Of kernel.ld.
STACK := $(shell awk '/link_stack_limit = link_stack_top/ { print 1024 * $$5 }' platform/raspi0/kernel.ld)

DISPLAY_SRC := platform/raspi0/display.c
DEMO_SCREEN := $(SCREEN)
DEMO_LOOPS  := $(SCREEN):6
SHOW = $(SCREENSHOT)
export SHOT        := sh platform/raspi0/shot.sh
export SHOT_SCREEN := $(SCREEN)
export SHOT_FRAMES := 8 45
export SHOT_ZOOM   := 1
export SHOT_KEY    := 16
# Two loops: a while sharp, with a longer and with a shorter shutter, and standing still.
export LOOPS        := sh platform/raspi0/loops.sh
export LOOPS_FRAMES := 144
export LOOPS_KEYS   := 22:16,23:0,28:16,29:0,80:8,81:0,100:4,101:0,104:4,105:0,110:8,111:0,120:32,121:0,123:32,124:0

# What a card takes.
$(BUILD)/%.img: $(BUILD)/%.elf
	$(call say,IMG)
	arm-none-eabi-objcopy -O binary $< $@

demo-firmware: $(BUILD)/demo.img
model-firmware: $(BUILD)/model.img
demo-run demo-test demo-cost: $(BUILD)/demo.img
model-run model-test model-cost: $(BUILD)/model.img
game-firmware game-run game-test game-cost: $(BUILD)/game.img
target-test: $(BUILD)/target_unit.img $(BUILD)/target_golden.img
target-bench: $(BUILD)/target_bench.img

$(PLATFORM_OBJ): $(BUILD)/%.o: %.S
	$(call say,AS,$<)
	@mkdir -p $(@D)
	$(CC) $(CORE) -c -o $@ $<
