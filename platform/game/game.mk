# SPDX-License-Identifier: MIT
# game.mk - the game as firmware for TARGET, and as a program of this machine. the Makefile includes it after programs.mk.
#
#   make game                                plays it in a window or terminal
#   make TARGET=cortex-m0plus game-test      drives the recorded race there: frames and times of platform/game/lap.txt
#   make TARGET=cortex-m0plus game-cost      what its frames cost

GAME_SCREEN ?= pico
GAME_STEP   ?= 200
GAME_OBJ    := $(patsubst %.c,$(BUILD)/%.o,$(wildcard platform/game/*.c))

$(BUILD)/platform/game/main.o: CFLAGS += -D'GAME_SCREEN="$(GAME_SCREEN)"'

$(BUILD)/game$(EXE): $(GAME_OBJ) $(PROGRAM_OBJ) $(DISPLAY_SRC:%.c=$(BUILD)/%.o) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(filter %.o,$^) $(LIB) $(LDLIBS)

.PHONY: game game-test game-cost
## the recorded race on TARGET: the frames and times of platform/game/lap.txt
game-test: $(BUILD)/game$(EXE) $(RUN_NEEDS)
	$(RUN) $< check $(GAME_SCREEN) $(GAME_STEP) > $(BUILD)/game.txt
	sed -n 's/^$(GAME_SCREEN) //p' platform/game/lap.txt | diff - $(BUILD)/game.txt

## what its frames cost on TARGET
game-cost: $(BUILD)/game$(EXE) $(RUN_NEEDS)
	$(RUN_BENCH) $< cost $(GAME_SCREEN) $(GAME_STEP)
