# SPDX-License-Identifier: MIT
# programs.mk - the programs that run on every target. The Makefile includes it after target.mk.
#
# Uses BUILD (build/$(TARGET)), LIB_SRC and LIB (the library's sources, and its archive for the
# target), the pattern rule $(BUILD)/%.o: %.c, what target.mk sets, and
#   UNIT_SUITES   test suites that need neither libc nor floating point: NAME stands for
#                 suite_NAME() in tests/unit/test_NAME.c
#   HOST_CC       the host's compiler, for the program that records the tapes
#   SCRIPTS       linker scripts; TARGET_TESTS: golden, where unit tests take too long
#   PLATFORM_OBJ  further objects of the port; RUN_NEEDS: what RUN needs to be built first
#
#   make TARGET=cortex-m0plus target-test     unit tests and golden frames
#   make TARGET=cortex-m0plus target-bench    instructions per frame
#   make TARGET=lm3s6965evb demo-firmware     the demo; demo-run starts it, demo-test tries it
#
# A target with a display sets DISPLAY_SRC (its display.h) and DEMO_SCREEN (demo_player.c);
# DEMO_LOOPS is what demo-test draws there, and SHOT... how it takes screenshots: see
# tests/shell/target_demo.sh and platform/lm3s6965evb/target.mk. For demo-run and model-run, SHOW is a command
# if it is not to run the program; SHOWN is what their names end in where other programs are shown. LOOPS... prints what the
# display shows over a while. Where another build system makes the firmware, PROJECT calls it: PROJECT FOLDER PROGRAM BOARD
# [MODEL.h] (platform/pico/target.mk).

TARGET_TESTS ?= unit golden

TAPES     := build/tapes
TAPES_SRC := tests/target/target_tapes.c tools/player/picture.c $(LIB_SRC) $(wildcard tools/scenes/*.c) \
             $(wildcard tools/model/*.c) $(wildcard tools/image/*.c)

PROGRAM_OBJ := $(PLATFORM_SRC:%.c=$(BUILD)/%.o) $(PLATFORM_OBJ) $(BUILD)/platform/print.o
PLAYER_OBJ  := $(PROGRAM_OBJ) $(BUILD)/tests/target/target_golden.o $(BUILD)/platform/play.o
GOLDEN_OBJ  := $(PLAYER_OBJ) $(BUILD)/$(TAPES)/golden.o
SMALL_OBJ   := $(PLAYER_OBJ) $(BUILD)/$(TAPES)/small.o
BENCH_OBJ   := $(PROGRAM_OBJ) $(BUILD)/tests/target/target_bench.o $(BUILD)/platform/play.o \
               $(BUILD)/$(TAPES)/bench.o
UNIT_OBJ    := $(PROGRAM_OBJ) $(BUILD)/tests/target/target_unit.o $(BUILD)/tests/test.o $(BUILD)/tests/random.o $(BUILD)/tests/unit/store.o \
               $(UNIT_SUITES:%=$(BUILD)/tests/unit/test_%.o) $(KERNEL_TESTS:%.c=$(BUILD)/%.o)

$(UNIT_SUITES:%=$(BUILD)/tests/unit/test_%.o): | $(SUITE_LISTS)

# Its table of specs leaves out what is zero.
build/host/tests/target/target_tapes.o: CFLAGS += -Wno-missing-field-initializers
build/host/tests/target/target_tapes.o: HOST_CFLAGS += -Wno-missing-field-initializers
$(TAPES)/target_tapes: $(call host_objects,$(TAPES_SRC))
	$(call say,LD)
	@mkdir -p $(@D)
	$(HOST_CC) -o $@ $^ -lm

$(TAPES)/golden.c: $(TAPES)/target_tapes tests/golden.txt
	$(call say,GEN)
	$(TAPES)/target_tapes golden $@ tests/golden.txt

$(TAPES)/small.c: $(TAPES)/target_tapes tests/golden.txt
	$(call say,GEN)
	$(TAPES)/target_tapes small $@ tests/golden.txt

$(TAPES)/bench.c: $(TAPES)/target_tapes
	$(call say,GEN)
	$(TAPES)/target_tapes bench $@

$(BUILD)/tests/target/target_unit.o: $(BUILD)/suites
$(BUILD)/tests/target/target_unit.o: CFLAGS += \
    -D'TARGET_SUITES=$(foreach suite,$(UNIT_SUITES),SUITE($(suite)))'

$(BUILD)/target_golden$(EXE): $(GOLDEN_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(GOLDEN_OBJ) $(LIB) $(LDLIBS)

$(BUILD)/target_unit$(EXE): $(UNIT_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(UNIT_OBJ) $(LIB) $(LDLIBS)

# On small boards (SMALL_LAYOUTS) the linker script holds programs to the real sizes; golden frames
# that need more memory than there is are skipped.
$(BUILD)/target_golden-%$(EXE): $(SMALL_OBJ) $(LIB) $(SCRIPTS) platform/cortexm/%.ld
	$(call say,LD)
	$(CC) $(LDFLAGS) -T $*.ld -o $@ $(SMALL_OBJ) $(LIB) $(LDLIBS)

$(BUILD)/target_bench$(EXE): $(BENCH_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(BENCH_LDFLAGS) -o $@ $(BENCH_OBJ) $(LIB) $(LDLIBS)

$(BUILD)/%_cost$(EXE): $(PROGRAM_OBJ) $(BUILD)/tests/target/%_cost.o $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(BENCH_LDFLAGS) -o $@ $(filter %.o,$^) $(LIB) $(LDLIBS)

# Each switch of smear_config.h off, and sets of them: golden frames of this machine.
.PHONY: switches-test
## tests: golden frames with each switch of smear_config.h off
switches-test: $(ONE_FILE) $(TAPES)/golden.c
	sh tests/shell/target_switches.sh build/switches $<

# ---------------------------------------------------------------------- template

# platform/template with one core and with two, on a board of threads; and for a real core.
TEMPLATE_SRC := platform/template/firmware.c tests/target/target_template.c tools/image/crc32.c

$(BUILD)/template-1 $(BUILD)/template-2: $(BUILD)/template-%: $(TEMPLATE_SRC) platform/template/board.h $(LIB)
	$(call say,CC)
	$(CC) $(CFLAGS) -Werror -DBOARD_CORES=$* -o $@ $(TEMPLATE_SRC) $(LIB) -lpthread

.PHONY: template-test
## tests: platform/template on a board of threads
template-test: $(BUILD)/template-1 $(BUILD)/template-2
	timeout 120 $(BUILD)/template-1
	timeout 120 $(BUILD)/template-2
	! command -v arm-none-eabi-gcc >/dev/null || for cores in 1 2; do \
	    arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -std=c11 -Os -ffreestanding -Wall -Wextra \
	        -Wconversion -Werror -Iinclude -DBOARD_CORES=$$cores -c -o $(BUILD)/template.o \
	        platform/template/firmware.c || exit 1; \
	done

# ---------------------------------------------------------------------- demo

DISPLAY_SRC ?= platform/host/display.c
SYMBOLS_PROGRAMS ?= $(BUILD)/demo$(EXE)
DEMO_SCREEN ?= pico
DEMO_LOOPS  ?= oled:6 gba:6

PROPS     := build/demo
PROPS_SRC := platform/demo_props.c platform/demo_bake.c platform/demo_weld.c $(LIB_SRC) $(wildcard tools/scenes/*.c) \
             $(wildcard tools/model/*.c) $(wildcard tools/image/*.c)

FIRMWARE_OBJ := $(PROGRAM_OBJ) $(DISPLAY_SRC:%.c=$(BUILD)/%.o) $(BUILD)/platform/demo.o \
                $(BUILD)/platform/demo_player.o $(BUILD)/platform/demo_scene.o \
                $(BUILD)/$(PROPS)/props.o

$(BUILD)/platform/demo.o: CFLAGS += -D'DEMO_SCREEN="$(DEMO_SCREEN)"'

$(PROPS)/demo_props: $(call host_objects,$(PROPS_SRC))
	$(call say,LD)
	@mkdir -p $(@D)
	$(HOST_CC) -o $@ $^ -lm

$(PROPS)/props.c: $(PROPS)/demo_props
	$(call say,GEN)
	$(PROPS)/demo_props $@

ifdef PROJECT
$(BUILD)/demo$(EXE): $(PROPS)/props.c always
	$(call say,BUILD)
	$(PROJECT) $(BUILD) demo $(BOARD)
else
$(BUILD)/demo$(EXE): $(FIRMWARE_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -Wl,-Map=$(@:$(EXE)=).map -o $@ $(FIRMWARE_OBJ) $(LIB) $(LDLIBS)
endif

# Draws a frame on this machine, to look at and to compare screenshots with.
SCREEN_SRC := tests/target/target_screen.c platform/demo_player.c platform/demo_scene.c $(PROPS)/props.c \
              tools/player/picture.c $(LIB_SRC) $(wildcard tools/image/*.c)

$(PROPS)/target_screen: $(call host_objects,$(SCREEN_SRC))
	$(call say,LD)
	$(HOST_CC) -o $@ $^ -lm

.PHONY: demo-firmware demo-run demo-cost demo-test footprint print-run
## boards: the demo as firmware for TARGET
demo-firmware: $(BUILD)/demo$(EXE)
	$(if $(SIZE),$(SIZE) $<)

# Emulators here have no window: what is on their display is a screenshot.
SCREENSHOT = $(SHOT) $< $(or $(FRAME),45) $(<:$(EXE)=.ppm) && echo "wrote $(<:$(EXE)=.ppm)"
SHOW      ?= $(RUN) $< show

## boards: shows the demo; of emulated displays a screenshot, build/TARGET/demo.ppm, FRAME=45
demo-run: $(BUILD)/demo$(SHOWN)$(EXE) $(RUN_NEEDS)
	@$(SHOW)

## boards: the demo's frames and, where there is a display, screenshots against the host's
demo-test: $(BUILD)/demo$(EXE) $(PROPS)/target_screen $(RUN_NEEDS)
	RUN="$(RUN)" sh tests/shell/target_demo.sh $(BUILD)/demo-test $< $(DEMO_LOOPS)

print-run:
	@echo $(RUN)

## boards: flash, RAM and worst stack of the library on every target, and what each switch saves
footprint:
	$(of_make) sh platform/footprint.sh $(FOOTPRINT)
	$(of_make) sh platform/footprint_switches.sh $(or $(FOOTPRINT_SETS),$(FOOTPRINT))

## again: the tables of `make footprint` in platform/tables.md
footprint-readme:
	@mkdir -p build
	$(of_make) sh platform/footprint.sh > build/footprint.txt
	$(of_make) sh platform/footprint_switches.sh > build/switches.txt
	awk -f platform/footprint_readme.awk platform/tables.md > build/readme.md && mv build/readme.md platform/tables.md

# Of the switches' part: what a program that only asks for sizes is linked from, and how.
.PHONY: footprint-readme footprint-arena print-footprint
footprint-arena: $(PROGRAM_OBJ) $(BUILD)/platform/footprint_arena.o $(RUN_NEEDS)

print-footprint:
	@echo 'cc="$(CC)" compile="$(CC) $(filter-out -g1 -MMD -MP $(OPT),$(CFLAGS))" link="$(LDFLAGS) $(TEST_LDFLAGS)"'
	@echo 'arena_objects="$(PROGRAM_OBJ) $(BUILD)/platform/footprint_arena.o" libraries="$(LDLIBS)" run="$(RUN)"'

## boards: what the frames of the demo cost; BLUR=auto-sketch, auto-draft, subframes-4 ...: blurred so, STEP=6: every sixth, FOG=10-60: metres, or FOG=sky
demo-cost: $(BUILD)/demo$(EXE) $(RUN_NEEDS)
	$(RUN_BENCH) $< cost $(DEMO_SCREEN) $(if $(STEP),$(or $(BLUR),$(error STEP=$(STEP) needs a BLUR)),$(BLUR)) $(STEP) $(if $(FOG),$(if $(STEP),$(FOG),$(error FOG=$(FOG) needs a BLUR and a STEP)))

# ---------------------------------------------------------------------- the smallest

FILE_SRC ?= platform/host/file.c
TINY_OBJ := $(PROGRAM_OBJ) $(FILE_SRC:%.c=$(BUILD)/%.o) $(BUILD)/platform/tiny.o

$(BUILD)/tiny$(EXE): $(TINY_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	@rm -f $@.*.ci
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -Wl,-Map=$(@:$(EXE)=).map -o $@ $(TINY_OBJ) $(LIB) $(LDLIBS)

.PHONY: tiny-firmware tiny-test tiny-cost
## boards: the smallest firmware, for TARGET=microbit
tiny-firmware: $(BUILD)/tiny$(EXE)
	$(if $(SIZE),$(SIZE) -A $< | grep -E 'text|rodata|data|bss|mesh')

## boards: the smallest firmware's frames against the host's, and what it takes
tiny-test: $(BUILD)/tiny$(EXE) $(RUN_NEEDS)
	$(MAKE) --no-print-directory -s TARGET=host build/host/tiny
	RUN="$(RUN)" SIZE="$(SIZE)" sh tests/shell/target_tiny.sh $(BUILD)/tiny-test $< build/host/tiny

## boards: instructions per frame of the smallest firmware
tiny-cost: $(BUILD)/tiny$(EXE)
	$(RUN_BENCH) $< cost

# ---------------------------------------------------------------------- speed against accuracy

ERROR_SRC := platform/device_error.c platform/demo_player.c platform/demo_scene.c $(PROPS)/props.c $(LIB_SRC)

$(PROPS)/device_error: $(call host_objects,$(ERROR_SRC))
	$(call say,LD)
	$(HOST_CC) -o $@ $^ -lm

.PHONY: device-chart
## figures: speed against accuracy on Cortex-M and Game Boy Advance, in build/device-chart; TARGETS="gba:gba" BLURS="none object"
device-chart: $(PROPS)/device_error
	$(of_make) BLURS="$(BLURS)" sh platform/device_chart.sh build/device-chart $< $(TARGETS)

# ---------------------------------------------------------------------- a model of one's own

# What `smear convert FILE --name model -o build/model.h` wrote.
MODEL ?= build/model.h

MODEL_OBJ := $(PROGRAM_OBJ) $(DISPLAY_SRC:%.c=$(BUILD)/%.o) $(BUILD)/platform/model.o

$(BUILD)/platform/model.o: CFLAGS += -D'DEMO_SCREEN="$(DEMO_SCREEN)"' -D'MODEL_HEADER="$(abspath $(MODEL))"'
$(BUILD)/platform/model.o: $(MODEL) $(BUILD)/model.name

# Changes with the name, so that another model is compiled even if its header is older.
$(BUILD)/model.name: always
	@mkdir -p $(@D)
	@echo '$(abspath $(MODEL))' | cmp -s - $@ || echo '$(abspath $(MODEL))' > $@

.PHONY: always
$(MODEL):
	@echo "$(MODEL) is missing: build/smear convert FILE --name model -o $(MODEL)" >&2; exit 1

ifdef PROJECT
$(BUILD)/model$(EXE): $(MODEL) always
	$(call say,BUILD)
	$(PROJECT) $(BUILD) model $(BOARD) $(abspath $(MODEL))
else
$(BUILD)/model$(EXE): $(MODEL_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(MODEL_OBJ) $(LIB) $(LDLIBS)
endif

.PHONY: model-firmware model-run model-cost model-test
## boards: a converted model (MODEL=build/model.h) as firmware for TARGET
model-firmware: $(BUILD)/model$(EXE)
	$(if $(SIZE),$(SIZE) $<)

## boards: shows the model, as demo-run does
model-run: $(BUILD)/model$(SHOWN)$(EXE) $(RUN_NEEDS)
	@$(SHOW)

## boards: the model's frames against the host's
model-test: $(BUILD)/model$(EXE) $(RUN_NEEDS)
	$(MAKE) --no-print-directory -s TARGET=host MODEL="$(MODEL)" build/host/model
	build/host/model check $(DEMO_SCREEN) > $(BUILD)/model.want
	$(RUN) $< check $(DEMO_SCREEN) > $(BUILD)/model.got
	cmp $(BUILD)/model.want $(BUILD)/model.got

## boards: what the model's frames cost; BLUR=none: sharp
model-cost: $(BUILD)/model$(EXE) $(RUN_NEEDS)
	$(RUN_BENCH) $< cost $(DEMO_SCREEN) $(BLUR)

# No floating point, no 64-bit division, no C library: of the library and the demo as they are linked.
.PHONY: symbols-test
## boards: what the firmware calls, from its symbols
symbols-test: $(LIB) $(SYMBOLS_PROGRAMS)
	HOOKS='$(SYMBOLS_HOOKS)' sh tests/shell/target_symbols.sh $(NM) $(or $(SYMBOLS_LIB),$(LIB)) $(SYMBOLS_PROGRAMS)

# A target that says how large its stacks are (STACK, and STACK_WORK of what runs smear_work) has room for the library's worst
# by the compiler's call graph, and for STACK_PROGRAM bytes of the program and its callbacks.
STACK_PROGRAM ?= 300
CALLS_BUILD = $(BUILD)$(if $(CALLS),,/stack)

.PHONY: stack-test
## boards: the library's worst stack fits the one that TARGET has for it
stack-test:
	$(if $(STACK),,$(error TARGET=$(TARGET) does not say how large its stack is))@true
	$(MAKE) --no-print-directory -s CALLS=1 BUILD=$(CALLS_BUILD) OPT="$(OPT)" $(CALLS_BUILD)/libsmear.a
	awk -f platform/stack.awk $(CALLS_BUILD)/src/*.ci $(CALLS_BUILD)/src/*/*.ci > $(BUILD)/stack.txt
	awk -v room='smear_render $(STACK) smear_work $(STACK_WORK)' -v own=$(STACK_PROGRAM) \
	    'BEGIN { n = split(room, word); for (i = 1; i < n; i += 2) most[word[i]] = word[i + 1] } \
	     $$2 in most { print $$2, $$1, "and", own, "of", most[$$2]; checked++; over += $$1 + own > most[$$2] } \
	     END { exit over || checked != int(n / 2) }' $(BUILD)/stack.txt

.PHONY: target-test target-bench overlay-cost lights-cost scene-cost target-accept $(SMALL_LAYOUTS:%=target-test-%)

## boards: unit tests and golden frames on TARGET
target-test: $(TARGET_TESTS:%=$(BUILD)/target_%$(EXE)) $(SMALL_LAYOUTS:%=target-test-%) $(RUN_NEEDS)
	$(foreach test,$(TARGET_TESTS),$(RUN) $(BUILD)/target_$(test)$(EXE) &&) true

# Everything at once fits the flash of a small board at -Os alone. Tapes are made before, not by both makes.
$(SMALL_LAYOUTS:%=target-test-%): target-test-%: $(TAPES)/small.c $(TAPES)/golden.c
	$(MAKE) OPT=-Os BUILD=$(BUILD)-Os $(BUILD)-Os/target_golden-$*$(EXE)
	$(RUN_$*) $(BUILD)-Os/target_golden-$*$(EXE)

## boards: what frames cost on TARGET
target-bench: $(BUILD)/target_bench$(EXE) $(RUN_NEEDS)
	$(RUN_BENCH) $(BUILD)/target_bench$(EXE)

## boards: what a line of text, and points, take of a frame on TARGET; further lights of a vertex; a sky and shadows
overlay-cost lights-cost scene-cost: %-cost: $(BUILD)/%_cost$(EXE) $(RUN_NEEDS)
	$(RUN_BENCH) $<

## again: tests/golden.txt: today's golden frames are right (look at the pictures first)
target-accept: $(TAPES)/target_tapes
	$(TAPES)/target_tapes list > $(TAPES)/golden.txt
	mv $(TAPES)/golden.txt tests/golden.txt
