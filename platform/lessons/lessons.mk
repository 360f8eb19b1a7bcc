# SPDX-License-Identifier: MIT
# lessons.mk - the lessons as programs of this machine and of boards. The Makefile includes it after programs.mk.
#
#   make lessons                              their pictures in build/lessons
#   make TARGET=cortex-m0plus lessons-test    their frames there, by the sums of platform/lessons/sums.txt
#   make TARGET=cortex-m0plus lessons-cost    what their frames cost there

LESSONS := $(patsubst platform/lessons/%.c,%,$(sort $(wildcard platform/lessons/[1-9]-*.c)))
# The second flies in fog, which a library may be without (platform/gba).
LESSONS_THERE := $(if $(filter -DSMEAR_WITH_FOG=0,$(CFLAGS)),$(filter-out 2-camera,$(LESSONS)),$(LESSONS))

$(LESSONS:%=$(BUILD)/lessons/%$(EXE)): $(BUILD)/lessons/%$(EXE): $(BUILD)/platform/lessons/%.o $(BUILD)/platform/lessons/panel_cost.o \
    $(PROGRAM_OBJ) $(LIB) $(SCRIPTS)
	$(call say,LD)
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) $(BENCH_LDFLAGS) -o $@ $(filter %.o,$^) $(LIB) $(LDLIBS)

.PHONY: lessons lessons-test lessons-cost test-lessons lessons-accept lessons-readme
## start: seven lessons of a page each, from a cube to a race (platform/lessons): their pictures in build/lessons
lessons: $(LIB) $(BIN)/smear-demo
	LIB=$(LIB) DEMO=$(BIN)/smear-demo CC="$(CC)" sh tests/shell/lessons.sh pictures $(LESSONS)

## boards: the lessons' frames on TARGET: those of platform/lessons/sums.txt
lessons-test: $(LESSONS_THERE:%=$(BUILD)/lessons/%$(EXE)) $(RUN_NEEDS)
	for lesson in $(LESSONS_THERE); do \
	    echo "$$lesson $$($(RUN_BENCH) $(BUILD)/lessons/$$lesson$(EXE) | cut -d' ' -f1)"; \
	done > $(BUILD)/lessons/sums.txt
	grep $(LESSONS_THERE:%=-e '^% ') platform/lessons/sums.txt | diff - $(BUILD)/lessons/sums.txt
	$(foreach lesson,$(filter-out $(LESSONS_THERE),$(LESSONS)),@echo "$(lesson) is left out: $(TARGET)'s library has no fog")

## boards: what the lessons' frames cost
lessons-cost: $(LESSONS_THERE:%=$(BUILD)/lessons/%$(EXE)) $(RUN_NEEDS)
	for lesson in $(LESSONS_THERE); do \
	    echo "$$lesson $$($(RUN_BENCH) $(BUILD)/lessons/$$lesson$(EXE) | cut -d' ' -f2-)"; \
	done

# As C99 and as C++11: length, sums and pictures; and the model's header.
test-lessons: $(LIB) $(BIN)/smear $(BIN)/smear-demo
	@mkdir -p build/lessons
	$(BIN)/smear convert platform/lessons/bird.gltf -o build/lessons/bird.h > build/lessons/bird.txt
	cmp build/lessons/bird.h platform/lessons/bird.h
	LIB=$(LIB) DEMO=$(BIN)/smear-demo CC="$(CC)" CXX="$(call with_cxx,$(CXX))" sh tests/shell/lessons.sh test $(LESSONS)

## again: pictures and sums of the lessons: what they draw now is right (look at build/lessons first)
lessons-accept: lessons
	cp $(LESSONS:%=build/lessons/%.png) platform/lessons
	cp build/lessons/sums.txt platform/lessons/sums.txt

## again: the lessons' costs on a Cortex-M0+ in their README
lessons-readme:
	@mkdir -p build
	$(MAKE) --no-print-directory -s TARGET=cortex-m0plus lessons-cost > build/lessons.txt.new
	awk 'BEGIN { print "| lesson | M instructions a frame | frames a second at 133 MHz, at most |\n|---|---|---|" } \
	    { printf "| [%s](%s.c) | %.2f | %.0f |\n", $$1, $$1, $$2 / 1e6, 133e6 / $$2 }' build/lessons.txt.new > build/lessons.md
	awk -f platform/footprint_readme.awk platform/lessons/README.md > build/readme.md && mv build/readme.md platform/lessons/README.md
