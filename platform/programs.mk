# SPDX-License-Identifier: MIT
# programs.mk - the programs that run on every target. The Makefile includes it after target.mk.
#
# Uses BUILD (build/$(TARGET)), LIB_SRC and LIB (the library's sources, and its archive for the
# target), the pattern rule $(BUILD)/%.o: %.c, what target.mk sets, and
#   UNIT_SUITES   test suites that need neither libc nor floating point: NAME stands for
#                 suite_NAME() in tests/test_NAME.c
#   HOST_CC       the host's compiler, for the program that records the tapes
#
#   make TARGET=cortex-m0plus target-test     unit tests and golden frames
#   make TARGET=cortex-m0plus target-bench    instructions per frame

HOST_CC ?= cc

TAPES     := build/tapes
TAPES_SRC := tests/target_tapes.c $(LIB_SRC) $(wildcard tools/scenes/*.c) \
             $(wildcard tools/model/*.c) $(wildcard tools/image/*.c)

PROGRAM_OBJ := $(PLATFORM_SRC:%.c=$(BUILD)/%.o) $(BUILD)/tests/target_print.o
GOLDEN_OBJ  := $(PROGRAM_OBJ) $(BUILD)/tests/target_golden.o $(BUILD)/tests/play.o \
               $(BUILD)/$(TAPES)/golden.o
BENCH_OBJ   := $(PROGRAM_OBJ) $(BUILD)/tests/target_bench.o $(BUILD)/tests/play.o \
               $(BUILD)/$(TAPES)/bench.o
UNIT_OBJ    := $(PROGRAM_OBJ) $(BUILD)/tests/target_unit.o $(BUILD)/tests/test.o \
               $(UNIT_SUITES:%=$(BUILD)/tests/test_%.o)

$(BUILD)/$(TAPES)/golden.o $(BUILD)/$(TAPES)/bench.o: CFLAGS += -Itests

$(TAPES)/target_tapes: $(TAPES_SRC)
	@mkdir -p $(@D)
	$(HOST_CC) -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -Iinclude -Itests -o $@ $(TAPES_SRC) -lm

$(TAPES)/golden.c: $(TAPES)/target_tapes tests/golden.txt
	$(TAPES)/target_tapes golden $@ tests/golden.txt

$(TAPES)/bench.c: $(TAPES)/target_tapes
	$(TAPES)/target_tapes bench $@

$(BUILD)/tests/target_unit.o: CFLAGS += \
    -D'TARGET_SUITES=$(foreach suite,$(UNIT_SUITES),SUITE($(suite)))'

$(BUILD)/target_golden$(EXE): $(GOLDEN_OBJ) $(LIB)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(GOLDEN_OBJ) $(LIB) $(LDLIBS)

$(BUILD)/target_unit$(EXE): $(UNIT_OBJ) $(LIB)
	$(CC) $(LDFLAGS) $(TEST_LDFLAGS) -o $@ $(UNIT_OBJ) $(LIB) $(LDLIBS)

# On small boards (SMALL_LAYOUTS) the linker script holds programs to the real sizes; golden frames
# that need more memory than there is are skipped.
$(BUILD)/target_golden-%$(EXE): $(GOLDEN_OBJ) $(LIB) platform/cortexm/%.ld
	$(CC) $(LDFLAGS) -T $*.ld -o $@ $(GOLDEN_OBJ) $(LIB) $(LDLIBS)

$(BUILD)/target_bench$(EXE): $(BENCH_OBJ) $(LIB)
	$(CC) $(LDFLAGS) $(BENCH_LDFLAGS) -o $@ $(BENCH_OBJ) $(LIB) $(LDLIBS)

.PHONY: target-test target-bench target-accept $(SMALL_LAYOUTS:%=target-test-%)

## unit tests and golden frames on TARGET
target-test: $(BUILD)/target_unit$(EXE) $(BUILD)/target_golden$(EXE) \
             $(SMALL_LAYOUTS:%=target-test-%)
	$(RUN) $(BUILD)/target_unit$(EXE)
	$(RUN) $(BUILD)/target_golden$(EXE)

$(SMALL_LAYOUTS:%=target-test-%): target-test-%: $(BUILD)/target_golden-%$(EXE)
	$(RUN_$*) $<

## what frames cost on TARGET
target-bench: $(BUILD)/target_bench$(EXE)
	$(RUN_BENCH) $(BUILD)/target_bench$(EXE)

## take today's golden frames as right (look at the pictures first)
target-accept: $(TAPES)/target_tapes
	$(TAPES)/target_tapes list > $(TAPES)/golden.txt
	mv $(TAPES)/golden.txt tests/golden.txt
