# SPDX-License-Identifier: MIT
# Raspberry Pi Pico and other boards with an RP2040 and a panel, in boards.h: BOARD=picosystem. The firmware is a pico-sdk
# project (CMakeLists.txt); PICO_SDK_PATH says where the SDK is. Tests run it in an emulator, rp2040js of npm, from the
# chip's boot ROM on (run.mjs).
# Packages: gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib cmake g++ nodejs
CC    := arm-none-eabi-gcc
AR    := arm-none-eabi-ar
NM    := arm-none-eabi-nm
SIZE  := arm-none-eabi-size
EXE   := .elf
NEEDS := arm-none-eabi-gcc arm-none-eabi-g++ cmake g++ node

BOARD ?= breakout
export BOARD
BUILD := $(BUILD)/$(BOARD)
CFLAGS += -mcpu=cortex-m0plus -mthumb -ffreestanding -ffunction-sections -fdata-sections -DSMEAR_WITH_LINEAR=0 -DSMEAR_WITH_TIMEMASK=0 -DSMEAR_WITH_FOG=0

# Builds BUILD/demo.elf and demo.uf2, or those of a model.
PROJECT := sh platform/pico/build.sh

export RUN := sh platform/pico/run.sh
RUN_BENCH := sh platform/pico/cost.sh

TARGET_TESTS :=
GAME_STEP    := 600

# Core 0 has the SDK's two banks, core 1 an array of board.c.
STACK      := 8192
STACK_WORK := $(shell sed -n 's/.*CORE1_STACK = \([0-9]*\).*/\1/p' platform/pico/board.c)

PICO_WIDTH  := $(shell awk -F '[^A-Za-z0-9_]+' '$$1 == "BOARD" && $$2 == "$(BOARD)" { print $$4 }' platform/pico/boards.h)
DEMO_SCREEN := pico-$(PICO_WIDTH)
DEMO_LOOPS  := $(DEMO_SCREEN):24
SHOW = $(SCREENSHOT)
export SHOT        := sh platform/pico/shot.sh
export SHOT_SCREEN := $(DEMO_SCREEN)
export SHOT_FRAMES := 45
export SHOT_ZOOM   := 1
export SHOT_KEY    := 16
# Two loops: a while sharp, with a longer and with a shorter shutter, and standing still.
export LOOPS        := sh platform/pico/loops.sh
export LOOPS_FRAMES := 144
export LOOPS_KEYS   := 22:16,23:0,28:16,29:0,80:8,81:0,100:4,101:0,104:4,105:0,110:8,111:0,120:32,121:0,123:32,124:0

# Chooses again what lies in RAM: HOT_BYTES of the functions that win most there, by profiles of blurred and of sharp frames, of
# which the latter count four times: both cores share them best where none waits for flash. With more, 200 kB do not hold the demo.
HOT_BYTES ?= 33000

.PHONY: pico-hot
## again: what lies in a Pico's RAM
pico-hot: build/demo/props.c
	@mkdir -p $(BUILD)/hot
	echo '/* nothing */' > $(BUILD)/hot/hot.ld
	PICO_HOT=$(abspath $(BUILD)/hot) $(PROJECT) $(BUILD)/hot/build demo $(BOARD)
	for kind in 0:0 1:16; do \
	    $(RUN) --exact 1 --frames 5 --keys $$kind --profile $(BUILD)/hot/$$kind $(BUILD)/hot/build/demo.elf show $(DEMO_SCREEN) || exit 1; \
	done
	sh platform/pico/hot.sh $(BUILD)/hot/build/demo.elf $(HOT_BYTES) $(BUILD)/hot/0:0 $(foreach n,1 2 3 4,$(BUILD)/hot/1:16) > $(BUILD)/hot/hot.ld
	mv $(BUILD)/hot/hot.ld platform/pico/hot.ld

# The same of the game, but for what is done once or to go through the race up to where it is driven.
GAME_HOT_BYTES ?= 50000

.PHONY: pico-game-hot
## again: what of the game lies in a Pico's RAM
pico-game-hot:
	@mkdir -p $(BUILD)/hot
	echo '/* nothing */' > $(BUILD)/hot/hot.ld
	PICO_HOT=$(abspath $(BUILD)/hot) $(PROJECT) $(BUILD)/hot/build game $(BOARD)
	for from in 250 500; do \
	    $(RUN) --exact 1 --profile $(BUILD)/hot/$$from $(BUILD)/hot/build/game.elf drive $(DEMO_SCREEN) $$from 5 || exit 1; \
	done
	sh platform/pico/hot.sh $(BUILD)/hot/build/game.elf $(GAME_HOT_BYTES) $(BUILD)/hot/250 $(BUILD)/hot/500 | \
	    sed 's/pico-hot/pico-game-hot/; /race_step\|demo_main\|find_middle\|smear_math_normalize\|course/d' > $(BUILD)/hot/hot.ld
	mv $(BUILD)/hot/hot.ld platform/pico/game/hot.ld
