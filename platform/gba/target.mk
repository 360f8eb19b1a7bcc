# SPDX-License-Identifier: MIT
# Game Boy Advance: ARM7TDMI at 16.78 MHz, 32 kB of fast memory, 256 kB of slow memory. Runs in
# libmgba, which counts cycles.
# Packages: gcc-arm-none-eabi libmgba-dev
CC       := arm-none-eabi-gcc
AR       := arm-none-eabi-ar
NM       := arm-none-eabi-nm
SIZE     := arm-none-eabi-size
EXE      := .elf
NEEDS    := arm-none-eabi-gcc

CFLAGS  += -mcpu=arm7tdmi -mthumb -mthumb-interwork -ffreestanding -ffunction-sections \
           -fdata-sections
LDFLAGS += -mcpu=arm7tdmi -mthumb -mthumb-interwork -nostdlib -Wl,--gc-sections -Lplatform/gba
LDLIBS  += -lgcc

# The library as ARM code, which multiplies to 64 bits.
$(BUILD)/src/%.o $(BUILD)/platform/common/%.o: CFLAGS += -marm

# What is large and hot is made small, so that it fits into fast memory. All files must agree on what -Os leaves out.
CFLAGS += -DSMEAR_DIRECT=0 -DSMEAR_RASTER_CACHE=0
$(BUILD)/src/blur_%.o $(BUILD)/src/raster.o: CFLAGS += -Os

PLATFORM_SRC := platform/gba/platform.c $(addprefix platform/common/,arena.c arguments.c memory.c)
PLATFORM_OBJ := $(BUILD)/platform/gba/start.o $(BUILD)/platform/gba/arithmetic.o
RUN_NEEDS    := $(BUILD)/gbarun

SCRIPTS       := platform/gba/gba.ld platform/gba/hot.ld
TEST_LDFLAGS  := -T gba.ld
BENCH_LDFLAGS := -T gba.ld

RUN       := platform/gba/run.sh
RUN_BENCH := platform/gba/run.sh

TARGET_TESTS := golden

DISPLAY_SRC := platform/gba/display.c
DEMO_SCREEN := gba
DEMO_LOOPS  := gba:1 oled:6 gba-full:6
SHOW = $(SCREENSHOT)
export SHOT        := platform/gba/shot.sh
export SHOT_SCREEN := gba
export SHOT_FRAMES := 8 45
export SHOT_ZOOM   := 2
export SHOT_KEY    := 1

$(PLATFORM_OBJ): $(BUILD)/%.o: %.S
	@mkdir -p $(@D)
	$(CC) -mcpu=arm7tdmi -DHEADER_CHECKSUM=0xfd -c -o $@ $<

$(BUILD)/gbarun: platform/gba/gbarun.c
	@mkdir -p $(@D)
	$(or $(HOST_CC),cc) -std=gnu11 -O2 -Wall -Wextra -o $@ $< -lmgba

.PHONY: gba-hot
## chooses again what lies in the Game Boy Advance's fast memory
gba-hot: $(BUILD)/demo$(EXE) $(BUILD)/gbarun
	LIMIT=3000 $(RUN) -p $(BUILD)/profile $< cost gba
	sh platform/gba/hot.sh $< $(BUILD)/profile 23500 > $(BUILD)/hot.ld
	mv $(BUILD)/hot.ld platform/gba/hot.ld
