# SPDX-License-Identifier: MIT
# game.mk - the game as firmware for TARGET, and as a program of this machine. the Makefile includes it after programs.mk.
#
#   make game                                plays it in a window or terminal
#   make TARGET=gba game-firmware             for a board with a display: pico, gba, raspi0, linux, linux-armhf ...
#   make TARGET=gba game-run                  shows it, or starts it
#   make TARGET=cortex-m0plus game-test      drives the recorded race there: frames and times of platform/game/lap.txt
#   make TARGET=cortex-m0plus game-cost      what its frames cost

GAME_SCREEN ?= $(DEMO_SCREEN)
GAME_STEP   ?= 200
# The screens whose race game-test drives.
GAME_CHECKED ?= $(GAME_SCREEN)
SOUND_SRC   ?= platform/common/silence.c
GAME_OBJ    := $(patsubst %.c,$(BUILD)/%.o,$(wildcard platform/game/*.c) platform/sound.c $(SOUND_SRC))

$(BUILD)/platform/game/main.o: CFLAGS += -D'GAME_SCREEN="$(GAME_SCREEN)"'

ifdef PROJECT
$(BUILD)/game$(EXE): always
	$(call say,BUILD)
	$(PROJECT) $(BUILD) game $(BOARD)
else
$(BUILD)/game$(EXE): $(GAME_OBJ) $(PROGRAM_OBJ) $(DISPLAY_SRC:%.c=$(BUILD)/%.o) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(filter %.o,$^) $(LIB) $(LDLIBS)
endif

.PHONY: game game-firmware game-run game-test game-cost
## boards: the game as firmware for TARGET
game-firmware: $(BUILD)/game$(EXE)
	$(if $(SIZE),$(SIZE) $<)

## boards: shows the game, as demo-run does
game-run: $(BUILD)/game$(SHOWN)$(EXE) $(RUN_NEEDS)
	@$(SHOW)

## boards: the recorded race on TARGET: the frames and times of platform/game/lap.txt
game-test: $(BUILD)/game$(EXE) $(RUN_NEEDS)
	for screen in $(GAME_CHECKED); do \
	    $(RUN) $< check $$screen $(GAME_STEP) > $(BUILD)/game.txt && \
	    sed -n "s/^$$screen //p" platform/game/lap.txt | diff - $(BUILD)/game.txt || exit 1; \
	done

## boards: what the game's frames cost
game-cost: $(BUILD)/game$(EXE) $(RUN_NEEDS)
	$(RUN_BENCH) $< cost $(GAME_SCREEN) $(GAME_STEP)

.PHONY: game-rates
## figures: the game's frames per second while driving, on emulated machines; RATES="pico gba pico2"
game-rates:
	$(of_make) sh platform/game_rates.sh $(or $(RATES),pico gba pico2)

# How far the pictures of a screen are from the truth: of this machine, as all machines draw them.
build/host/game_error: $(call host_objects,tests/target/game_error.c $(filter-out %/main.c,$(wildcard platform/game/*.c)) $(LIB_SRC))
	$(call say,LD)
	@mkdir -p $(@D)
	$(HOST_CC) -o $@ $^ -lm

.PHONY: game-error
## figures: how far the race's pictures on GAME_SCREEN are from the truth, in codes
game-error: build/host/game_error
	$< $(GAME_SCREEN)
