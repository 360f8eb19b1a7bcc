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

# The library as ARM code, which multiplies to 64 bits, and the scene's sines.
$(BUILD)/src/%.o $(BUILD)/platform/common/%.o $(BUILD)/platform/demo_scene.o $(BUILD)/platform/game/course.o $(BUILD)/platform/game/view.o $(BUILD)/platform/game/race.o: CFLAGS += -marm

# What runs from ROM most of the time is Thumb code: half as many bytes to fetch for an instruction.
$(addprefix $(BUILD)/src/,$(addsuffix .o,draws draws_prepare validate display/band screen/screen overlay/overlay display/pixel_format methods/temporal \
    raster/few_draw raster/raster temporal/lines temporal/subframe_gap temporal/subframes temporal/tile_method methods/along_lines)): \
    CFLAGS += -mthumb

# What is large and hot is made small, so that it fits into fast memory. All files must agree on what -Os leaves out.
# Fog makes hot functions larger than fast memory has room for, further lights the stack.
CFLAGS += -DSMEAR_WITH_FOG=0 -DSMEAR_WITH_LIGHTS=0
CFLAGS += -DSMEAR_DIRECT=0 -DSMEAR_SPAN_ROWS=1 -DSMEAR_RASTER_CACHE=1 -DSMEAR_SMALL_CODE=0 -DSMEAR_FAST_STACK=1 -Iplatform/gba -D'SMEAR_CONFIG_FILE="stage.h"'
$(BUILD)/src/filter/reconstruct.o $(BUILD)/src/filter/uniform.o $(BUILD)/src/filter/weights.o $(BUILD)/src/raster/cover.o \
$(BUILD)/src/raster/setup.o: CFLAGS += -Os
# Eight taps of a line one after the other.
$(BUILD)/src/kernels/line_means.o: CFLAGS += -O3

# The core has no pipeline that waits for loads: what is loaded early only takes registers.
CFLAGS += -fno-schedule-insns

# Video memory takes no single bytes.
$(BUILD)/platform/common/memory.o: CFLAGS += -D'PLATFORM_COPY_FILE="platform/gba/copy.h"'

PLATFORM_SRC := platform/gba/platform.c $(addprefix platform/common/,arena.c arguments.c memory.c)
PLATFORM_OBJ := $(BUILD)/platform/gba/start.o $(BUILD)/platform/gba/arithmetic.o
RUN_NEEDS    := $(BUILD)/gbarun

HOT           := $(addprefix platform/gba/,hot.ld hot_assemble.ld hot_draw.ld hot_warm.ld)
SCRIPTS       := platform/gba/gba.ld $(HOT)
TEST_LDFLAGS  := -T gba.ld
BENCH_LDFLAGS := -T gba.ld

RUN       := platform/gba/run.sh
RUN_BENCH := platform/gba/run.sh

TARGET_TESTS := golden
SYMBOLS_HOOKS := gba_enter_stage|gba_place

# Of gba.ld.
STACK := $(shell awk '/link_stack_limit = link_stack_top/ { print $$5 + 0 }' platform/gba/gba.ld)

DISPLAY_SRC := platform/gba/display.c
SOUND_SRC   := platform/gba/sound.c
DEMO_SCREEN := gba
DEMO_LOOPS  := gba:1 oled:6 gba-full:6
SHOW = $(SCREENSHOT)
export SHOT        := platform/gba/shot.sh
export SHOT_SCREEN := gba
export SHOT_FRAMES := 8 45
export SHOT_ZOOM   := 2
export SHOT_KEY    := 1

$(PLATFORM_OBJ): $(BUILD)/%.o: %.S
	$(call say,AS,$<)
	@mkdir -p $(@D)
	$(CC) -mcpu=arm7tdmi -DHEADER_CHECKSUM=0xfd -c -o $@ $<

$(BUILD)/gbarun: platform/gba/gbarun.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(or $(HOST_CC),cc) -std=gnu11 -O2 -Wall -Wextra -o $@ $< -lmgba

# What a cartridge takes; LOGO=FILE.gba: with the logo of that ROM, which a console wants to see.
$(BUILD)/cartridge: platform/gba/cartridge.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(or $(HOST_CC),cc) -std=c11 -O2 -Wall -Wextra -o $@ $<

$(BUILD)/%.gba: $(BUILD)/%.elf $(BUILD)/cartridge always
	$(call say,GBA)
	arm-none-eabi-objcopy -O binary $< $@.new
	$(BUILD)/cartridge $@.new $(LOGO) || { rm -f $@.new; exit 1; }
	mv $@.new $@

demo-firmware: $(BUILD)/demo.gba
model-firmware: $(BUILD)/model.gba
game-firmware: $(BUILD)/game.gba

symbols-test: gba-stages-test

.PHONY: gba-stages-test gba-hot
## boards: no function of one stage is called in the other
gba-stages-test: $(BUILD)/libsmear.a
	sh tests/shell/gba_stages.sh $<

## again: what lies in the Game Boy Advance's fast memory, and when, by measuring
gba-hot: $(BUILD)/gbarun
	@mkdir -p $(BUILD)/hot
	$(MAKE) --no-print-directory TARGET=gba $(FIRMWARE_OBJ) $(GAME_OBJ) $(LIB)
	LINK_DEMO='$(CC) -L$(BUILD)/hot $(LDFLAGS) $(TEST_LDFLAGS) -Wl,-S -o $(BUILD)/hot/demo.elf $(FIRMWARE_OBJ) $(LIB) $(LDLIBS)' \
	LINK_GAME='$(CC) -L$(BUILD)/hot $(LDFLAGS) $(TEST_LDFLAGS) -Wl,-S -o $(BUILD)/hot/game.elf $(GAME_OBJ) $(PROGRAM_OBJ) $(DISPLAY_SRC:%.c=$(BUILD)/%.o) $(LIB) $(LDLIBS)' \
	    sh platform/gba/hot.sh $(BUILD)/hot $(LIB)
	mv $(HOT:platform/gba/%=$(BUILD)/hot/%) platform/gba/

.PHONY: gba-places
## figures: what each part of the library's memory would gain by lying in the Game Boy Advance's video or fast memory, by measuring
gba-places: $(BUILD)/gbarun
	@mkdir -p $(BUILD)/places
	$(MAKE) --no-print-directory TARGET=gba $(FIRMWARE_OBJ) $(LIB)
	$(CC) $(CFLAGS) -Iinclude -Isrc -I. -std=c11 -O2 -DGBA_SAYS_PLACES=1 -c -o $(BUILD)/places/platform.o platform/gba/platform.c
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $(BUILD)/places/demo.elf $(BUILD)/places/platform.o $(filter-out %/gba/platform.o,$(FIRMWARE_OBJ)) $(LIB) $(LDLIBS)
	sh platform/gba/places.sh $(BUILD)/places
