# SPDX-License-Identifier: MIT
# One Makefile, no recursion into folders. `make help` lists what it can do.

TARGET ?= host
BUILD  := build/$(TARGET)

.DEFAULT_GOAL := all

# All cores compile, unless -j says otherwise. What `clean` removes is not built meanwhile.
CORES ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
ifeq ($(MAKELEVEL)$(filter clean,$(MAKECMDGOALS)),0)
MAKEFLAGS += -j$(CORES)
endif
# What scripts call make by, which then starts anew with all cores. A recipe that names the variable MAKE would run under -n, too.
make := $(MAKE)
of_make = MAKELEVEL= MAKEFLAGS="$(filter-out -j% --jobserver%,$(MAKEFLAGS))" MAKE="$(make)"

# One line for each file that is made; V=1 shows the commands, -s nothing.
ifeq ($(V),1)
say =
else
.SILENT:
say = $(if $(findstring s,$(firstword -$(MAKEFLAGS))),,$(info $(1) $(or $(2),$@)))
endif

# Sanitizers see more where less is optimized, and -O1 compiles in two thirds of the time.
OPT    ?= $(if $(filter 1,$(SAN)),-O1,-O2)
# Of what debuggers read, lines and functions: more takes a sixth of the time. OPT='-O0 -g' is for who looks at variables.
CFLAGS := -std=c11 -g1 -Wall -Wextra -Wconversion -Wshadow -Iinclude -Isrc -I. -MMD -MP $(OPT)
# Of programs of this machine, where another build needs some.
HOST_CC ?= cc
HOST_CFLAGS := -std=c11 -g1 -Wall -Wextra -Wconversion -Wshadow -Iinclude -Isrc -I. -MMD -MP -O2 -D_POSIX_C_SOURCE=200809L

# SAN=1: address and undefined behaviour sanitizers. CHECK=1: every fixed-point promise is checked.
ifeq ($(SAN),1)
BUILD   := $(BUILD)-san
CFLAGS  += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS += -fsanitize=address,undefined
endif
ifeq ($(CHECK),1)
BUILD  := $(BUILD)-check
CFLAGS += -DSMEAR_CHECK=1
endif
# BRIEF=1: what `make check` has of sanitizers, in two thirds of the time. It goes without the kinds of undefined behaviour that
# end in a wrong address, as that is found when it is read or written, and makes a third of the calls of kernels.
ifeq ($(BRIEF),1)
BUILD  := $(BUILD)-brief
CFLAGS += -fno-sanitize=null,object-size,pointer-overflow -DKERNEL_STEP=3
endif
# Sources whose objects are this build's own: the others are those of build/host.
OWN := %
# COVERAGE=1: counts which branches of src/ are taken; without optimization each inline function is one (base.h).
ifeq ($(COVERAGE),1)
OWN     := $(if $(filter build/host,$(BUILD)),src/%,%)
BUILD   := $(BUILD)-coverage
LDFLAGS += --coverage
$(BUILD)/src/%.o: CFLAGS += -O0 --coverage -fprofile-update=prefer-atomic
endif
ifeq ($(wildcard platform/$(TARGET)/target.mk),)
$(error no TARGET=$(TARGET): make help lists them)
endif
include platform/$(TARGET)/target.mk


# Rooms, the lowest first: a file includes only what lies in its own room or in those before it (`make layers`).
# Above the library's rooms lie frame.c and smear.c in src/ itself; what a room of tools/, platform/ or tests/ shares
# with others lies in its root, below them.
# What plays converted models, and the methods of other systems, lie above it, in rooms that it does not know.
OTHER_ROOMS := $(addprefix src/,curves fog workers damage screen overlay smooth scene model filter layers accumulate timemask)
SRC_ROOMS  := $(addprefix src/,base kernels geometry raster display temporal methods) src $(OTHER_ROOMS)
TOOL_ROOMS := tools $(addprefix tools/,image model scenes ref convert player options view cli demo bench dist web/libc/sys web/libc web)
PORT_ROOMS := platform platform/common platform/cortexm
PORT_ROOMS += $(filter-out $(PORT_ROOMS),$(patsubst %/target.mk,%,$(wildcard platform/*/target.mk))) platform/template platform/game platform/lessons
TEST_ROOMS := tests $(addprefix tests/,ref kernels unit suite examples faults fuzz proofs target shell)

LIB_SRC := $(foreach room,$(SRC_ROOMS),$(wildcard $(room)/*.c))

IMAGE_SRC := $(wildcard tools/image/*.c)
MODEL_SRC := $(wildcard tools/model/*.c)
SCENE_SRC := $(wildcard tools/scenes/*.c)
CONVERT_SRC := $(wildcard tools/convert/*.c)
CLI_SRC   := $(wildcard tools/player/*.c tools/options/*.c tools/cli/*.c)
VIEW_SRC  := $(wildcard tools/view/*.c)
BENCH_SRC := $(wildcard tools/bench/*.c)
# Of the tools only what the demo uses, so that a fresh clone shows it in seconds.
DEMO_SRC  := $(wildcard tools/demo/*.c) $(addprefix tools/player/,crew.c device.c exact.c picture.c) $(addprefix tools/options/,say.c sink.c) \
    $(addprefix tools/image/,animation.c apng.c crc32.c deflate.c file.c gif.c image.c inflate.c netpbm.c output.c palette.c \
        png_read.c png_write.c) \
    $(addprefix tools/scenes/,backdrop.c build.c demo.c demo_car.c demo_drone.c demo_track.c present.c present_surface.c scene.c stage.c)
REF_SRC   := $(wildcard tools/ref/*.c)
TOOL_SRC  := $(IMAGE_SRC) $(MODEL_SRC) $(SCENE_SRC) $(CONVERT_SRC)

# Objects of sources: this build's, or those of build/host.
objects = $(patsubst %.c,$(BUILD)/%.o,$(filter $(OWN),$1)) $(patsubst %.c,build/host/%.o,$(filter-out $(OWN),$1))
# Those of programs of this machine, whatever is built.
host_objects = $(1:%.c=build/host/%.o)

LIB := $(if $(filter-out $(OWN),src/smear.c),build/host,$(BUILD))/libsmear.a
# Programs for people lie in build/; those with sanitizers or checks beside their objects.
BIN := $(if $(SAN)$(CHECK)$(COVERAGE),$(BUILD),build)

.PHONY: all cost-model host-display help demo readme-pictures check test test-all bench chart chart-readme chart-picture layers house tables clean
## start: the programs build/smear and build/smear-bench, and the library (build/host/libsmear.a)
all: $(BIN)/smear $(BIN)/smear-bench

$(BUILD)/%.o: %.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(if $(CALLS),,$(if $(wildcard $(@:.o=.ci)),rm -f $(@:.o=.ci)))
	$(CC) $(CFLAGS) -c -o $@ $<

ifneq ($(BUILD),build/host)
build/host/%.o: %.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(HOST_CC) $(HOST_CFLAGS) -c -o $@ $<
endif

# CALLS=1: objects of another machine's library come with the compiler's call graph, which stack-test reads; those that have
# none are compiled again.
ifeq ($(CALLS)$(filter host,$(TARGET)),1)
$(BUILD)/src/%.o: CFLAGS += -fcallgraph-info=su
ifeq ($(findstring -flto,$(LDFLAGS)),)
$(foreach object,$(LIB_SRC:%.c=$(BUILD)/%.o),$(if $(wildcard $(object:.o=.ci)),,$(object))): always
endif
endif

$(LIB): $(call objects,$(LIB_SRC))
	$(call say,AR)
	@rm -f $@
	$(AR) rcs $@ $^

$(BIN)/smear: $(call objects,$(CLI_SRC) $(VIEW_SRC) $(TOOL_SRC)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm -lpthread

## start: motion-blurred pictures and loops, in build/demo
demo: $(BIN)/smear-demo
	$(BIN)/smear-demo build/demo

## tests: what a change needs, in under three minutes on two cores: most suites of this machine, golden frames under sanitizers
check:
	$(of_make) sh tests/all.sh check

## tests: what a change must pass, in under ten minutes: all suites of this machine, some of others; names what it needs
test:
	$(of_make) sh tests/all.sh test

## tests: every suite there is
test-all:
	$(of_make) sh tests/all.sh all

## figures: instructions per frame against other rasterizers (needs valgrind)
bench: $(BIN)/smear-bench
	$(of_make) sh tools/bench/bench.sh $(BIN)/smear-bench $(REPORTS)

## figures: speed against accuracy of every method, in build/chart (needs valgrind); SCENES=a,b METHODS=auto QUICK=1
chart: $(BIN)/smear-bench
	SMEAR_ASSETS=$${SMEAR_ASSETS-$(wildcard ../shared/assets)} $(BIN)/smear-bench chart --scenes '$(SCENES)' --methods '$(METHODS)' $(if $(QUICK),--quick)

## again: the README's chart, measured anew (needs valgrind)
chart-readme: $(BIN)/smear-bench
	$(BIN)/smear-bench chart --marks
	cp build/chart/part/marks.svg tools/bench/pictures/marks.svg

## again: the picture of the README and the numbers of the page's chart, from the last whole chart
chart-picture: $(BIN)/smear-bench
	@mkdir -p tools/bench/pictures
	$(BIN)/smear-bench chart --from build/chart/chart.csv --out build/chart > /dev/null
	cp build/chart/marks.svg tools/bench/pictures/
	awk -f tools/web/chart.awk build/chart/chart.csv > build/chart/page.csv && mv build/chart/page.csv tools/web/chart.csv

$(BIN)/smear-bench: $(call objects,$(BENCH_SRC) $(addprefix tools/player/,crew.c device.c exact.c picture.c) $(addprefix tools/options/,arguments.c say.c) $(TOOL_SRC)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm -lpthread

$(BIN)/smear-demo: $(call objects,$(DEMO_SRC)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm -lpthread

# platform/display.h on a desktop: firmware links it and is seen in a window or terminal, or checked
# by its CRCs (platform/host/desktop_display.c).
HOST_DISPLAY_SRC := platform/host/platform.c platform/host/desktop_display.c tools/player/picture.c \
    $(filter tools/view/screen% tools/view/x11% $(addprefix tools/view/,surface.c panel.c guard.c tty.c \
        console.c evdev.c golden.c script.c),$(VIEW_SRC)) $(IMAGE_SRC)

## page: a desktop's display for firmware: build/host/libsmear-display.a
host-display: $(BUILD)/libsmear-display.a

$(BUILD)/libsmear-display.a: $(call objects,$(HOST_DISPLAY_SRC))
	$(call say,AR)
	@rm -f $@
	$(AR) rcs $@ $^

# For a Linux without libraries, and what boots it.
$(BUILD)/smear-static: $(call objects,$(CLI_SRC) $(VIEW_SRC) $(TOOL_SRC)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -static -o $@ $^ -lm -lpthread

$(BUILD)/view_linux_init: tests/shell/view_linux_init.c
	$(call say,CC,$<)
	$(CC) -std=c11 -D_DEFAULT_SOURCE -Os -static -Wall -Wextra -o $@ $<

$(BUILD)/mkcpio: tests/shell/mkcpio.c
	$(call say,CC,$<)
	$(CC) -std=c11 -O2 -Wall -Wextra -o $@ $<

$(BUILD)/stalled: $(call objects,tests/shell/stalled.c tests/random.c tests/x_server.c)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lpthread

$(BUILD)/view_x11_user: $(call objects,tests/shell/view_x11_user.c $(addprefix tools/view/,guard.c surface.c x11.c) $(IMAGE_SRC))
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm

PICTURES := tools/demo/pictures

# Of each machine the name of its screen in platform/demo_player.c, and how much its pixels are enlarged.
README_SCREENS := pi-640:1 pico-240:1 gba:2

## again: pictures of the README: the loop, what the panels show of frame 14, and the first program's; and the manual's lamp
readme-pictures: $(BIN)/smear $(BIN)/smear-demo build/demo/target_screen $(BUILD)/readme.ppm
	$(BIN)/smear-demo --readme $(PICTURES)
	for screen in $(README_SCREENS); do \
	    build/demo/target_screen picture $${screen%:*} 14 180 build/screen.png && \
	    $(BIN)/smear-demo --enlarge $${screen#*:} build/screen.png $(PICTURES)/$${screen%:*}.png || exit 1; \
	done
	$(BIN)/smear-demo --enlarge 2 $(BUILD)/readme.ppm $(PICTURES)/first.png
	$(BIN)/smear render builtin:suite/dolly --clear 0c1220 --sun 304060,-1,1,0.3 --second 102848,1,0.2,1 \
	    --lamp ffc080,0,1.5,0,10 --size 320x240 -o $(PICTURES)/lamp.png

## tests: includes run one way: a file includes only what lies in its own room or below
layers:
	sh tests/shell/layers.sh $(SRC_ROOMS) $(TOOL_ROOMS) $(PORT_ROOMS) $(TEST_ROOMS)

# All C sources but what tools write.
NO_ROOMS := platform/examples $(patsubst %/,%,$(sort $(dir $(shell find tests/examples/stand_ins -name "*.h"))))
FORMATTED = $(filter-out src/base/tables.c platform/lessons/bird.h,$(foreach room,include $(NO_ROOMS) $(SRC_ROOMS) $(TOOL_ROOMS) $(PORT_ROOMS) $(TEST_ROOMS),$(wildcard $(room)/*.[ch])))

.PHONY: core-alone
## the core links without models and the rooms of other systems' methods, and draws the same
core-alone: build/host/libsmear.a
	sh tests/shell/core_alone.sh $< $(filter-out $(OTHER_ROOMS),$(SRC_ROOMS))

.PHONY: format format-check
## tests: sources are indented as .clang-format says (needs clang-format-14); make format indents them
format-check:
	printf '%s\n' $(FORMATTED) | xargs -P 2 -n 500 sh tests/shell/format.sh

format:
	sh tests/shell/format.sh --fix $(FORMATTED)

## tests: how src/ is built, measured: longest functions, switches of the top floor
house:
	OTHERS="$(OTHER_ROOMS)" sh tests/shell/house.sh

## again: src/base/tables.c
tables: build/gentables
	build/gentables > build/tables.c && mv build/tables.c src/base/tables.c

build/gentables: tools/gentables.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(CC) -std=c11 -O2 -o $@ $< -lm

# ---------------------------------------------------------------------- forms to hand on

.PHONY: dist kit install dist-test dist-single-test
ONE_FILE := build/one-file/single/smear.c
## tests: what `make dist` and `make install` write, compiled and run
dist-test: dist kit $(ONE_FILE)
	$(MAKE) --no-print-directory -s install DESTDIR=build/dist-install PREFIX=/usr
	sh tests/shell/dist.sh

## tests: the one file by every compiler of this machine, for every core and standard, and its golden frames
dist-single-test: $(ONE_FILE) build/tapes/golden.c
	sh tests/shell/dist_single.sh $(<D)

# What the examples of packages draw, where sample models are at hand.
FOX := $(if $(filter undefined,$(origin SMEAR_ASSETS)),../shared/assets,$(SMEAR_ASSETS))/khronos/Fox.glb
## start: one smear.c, and packages for CMake, PlatformIO, Arduino, ESP-IDF, Zephyr, pico-sdk in build/dist; URL=https://... of the project
dist: build/dist-single $(BIN)/smear
	SMEAR=$(BIN)/smear MODEL="$(wildcard $(FOX))" sh tools/dist/dist.sh $< build/dist $(SRC_ROOMS)

# The one file alone, for suites that compile it: it stays as long as its sources do.
$(ONE_FILE): build/dist-single tools/dist/dist.sh $(foreach room,include $(SRC_ROOMS),$(wildcard $(room)/*.[ch]*))
	$(call say,GEN)
	FORMS=single sh tools/dist/dist.sh $< build/one-file $(SRC_ROOMS)

# What `smear convert` makes sketches of, for Arduino and ESP-IDF: the library and the displays.
KIT := build/kit/kit.tar
## start: build/kit/kit.tar: smear convert MODEL --kit build/kit/kit.tar -o SKETCH.zip
kit: $(KIT)
$(KIT): $(ONE_FILE) platform/examples $(wildcard platform/examples/*.h) $(shell find tools/dist/arduino tools/dist/esp-idf -type f)
	$(call say,GEN)
	FORMS=kit sh tools/dist/dist.sh build/dist-single $(@D) $(SRC_ROOMS)

build/dist-single: tools/dist/single.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(CC) -std=c11 -Wall -Wextra -O1 -o $@ $<

PREFIX ?= /usr/local
## start: library, headers and smear.pc into $(DESTDIR)$(PREFIX)
install: $(LIB)
	install -d $(DESTDIR)$(PREFIX)/lib/pkgconfig $(DESTDIR)$(PREFIX)/include
	install -m 644 $(LIB) $(DESTDIR)$(PREFIX)/lib
	install -m 644 $(wildcard include/*.h include/*.hpp) $(DESTDIR)$(PREFIX)/include
	sed -e 's|@PREFIX@|$(PREFIX)|' -e "s|@VERSION@|$$(sh tools/dist/version.sh)|" tools/dist/smear.pc \
	    > $(DESTDIR)$(PREFIX)/lib/pkgconfig/smear.pc

## start: removes build
clean:
	rm -rf build

# A line `## GROUP: TEXT` describes the target below it.
## start: this list
help:
	@awk -v groups="start=To begin;tests=Tests;boards=For TARGET, and on it;figures=Figures;page=Page and display;again=What is kept here, made again" ' \
	    /^## [a-z]+: / { group = substr($$2, 1, length($$2) - 1); text = substr($$0, length(group) + 6); next } \
	    /^[a-z][a-z-]*:/ && text != "" { sub(/:.*/, ""); list[group] = list[group] sprintf("  make %-16s %s\n", $$0, text); text = "" } \
	    END { n = split(groups, g, /[=;]/); for (i = 1; i < n; i += 2) printf "%s\n%s", g[i + 1], list[g[i]]; print "Variables" }' \
	    $(filter Makefile %.mk,$(MAKEFILE_LIST))
	@echo "  TARGET=NAME      $(patsubst platform/%/target.mk,%,$(wildcard platform/*/target.mk)); host where it is not given"
	@echo "  V=1              shows the commands; -s says nothing"
	@echo "  SAN=1            address and undefined behaviour sanitizers; CHECK=1: every fixed-point promise is checked"

# ---------------------------------------------------------------------- tests

# Suites of one source file each, and suites of frames, tools and measures: suite_NAME() in test_NAME.c.
ALL_SUITES := $(patsubst test_%.c,%,$(notdir $(wildcard tests/unit/test_*.c tests/suite/test_*.c)))
SUITES     := $(ALL_SUITES)
# Suites that need neither libc nor floating point: they run on every target, too.
UNIT_SUITES := $(filter anim bins clip convert fixed fixmath kernels math path raster scene shader tables texture,$(ALL_SUITES))
# Suites that feed the library wild input: also under sanitizers, with every promise checked.
SAN_SUITES := $(filter anim apart api bins bounds budget clip convert convert_tool curve fixed fixmath flow foreign inputs jobs jpeg jumps kernels light math math_error matrix motion overlay \
              path points present raster ribbon sight sketch space states still tables texture transform view x11,$(ALL_SUITES))
# With sanitizers no other is compiled, unless SUITE names it.
ifeq ($(SAN),1)
SUITES := $(SAN_SUITES) $(filter-out $(SAN_SUITES),$(filter $(SUITE),$(SUITES)))
endif

# The chart without what measures.
CHART_SRC := $(addprefix tools/bench/,chart_bars.c chart_csv.c chart_means.c chart_peer.c chart_plot.c \
                 chart_settings.c chart_tables.c sheet.c svg.c take.c truth.c)
TEST_SRC := tests/run.c tests/test.c tests/random.c tests/rig.c tests/x_server.c tests/unit/store.c $(wildcard tests/ref/*.c) \
    $(wildcard $(SUITES:%=tests/unit/test_%.c) $(SUITES:%=tests/suite/test_%.c)) $(REF_SRC) \
    $(if $(filter-out $(SAN_SUITES),$(SUITES)),$(wildcard tests/suite/failures*.c) $(CHART_SRC))
TESTS    := $(BUILD)/run
# What the suite of kernels calls: a family of kernels in each.
KERNEL_TESTS := $(filter-out %/check_kernels.c,$(wildcard tests/kernels/*.c))
TEST_SRC += $(KERNEL_TESTS)
# What suites test of `smear view`.
VIEW_PARTS := $(addprefix tools/view/,board.c evdev.c font.c guard.c orbit.c panel.c screen_x11.c script.c surface.c tiles.c tty.c \
    x11.c)
TEST_SRC += $(VIEW_PARTS) $(addprefix tools/player/,crew.c device.c exact.c picture.c) $(addprefix tools/options/,apart.c say.c)

# What runs the tests of a file, which its last line includes; and the model of tests/data/arm.gltf, as a header and in words, low byte
# first.
SUITE_LISTS := $(ALL_SUITES:%=build/suites/%.h) build/suites/arm.h build/suites/arm_blob.h
build/suites/smear: $(call host_objects,$(CLI_SRC) $(VIEW_SRC) $(TOOL_SRC) $(LIB_SRC))
	$(call say,LD)
	@mkdir -p $(@D)
	$(HOST_CC) -o $@ $^ -lm -lpthread
build/suites/arm.h: tests/data/arm.gltf $(CONVERT_SRC) $(MODEL_SRC) | build/suites/smear
	build/suites/smear convert $< --name arm -o $@ > /dev/null
build/suites/arm_blob.h: tests/fuzz/corpus/blob/arm
	@mkdir -p $(@D)
	(echo 'static const uint32_t arm_blob[] = {'; \
	    tail -c +8 $< | od -An -v -tx1 -w4 | sed 's/ \(..\) \(..\) \(..\) \(..\)/0x\4\3\2\1u,/'; echo '};') > $@
build/suites/%.h: tests/unit/test_%.c tests/suites.awk
	@mkdir -p $(@D)
	awk -v suite=$* -f tests/suites.awk $< > $@
build/suites/%.h: tests/suite/test_%.c tests/suites.awk
	@mkdir -p $(@D)
	awk -v suite=$* -f tests/suites.awk $< > $@
$(sort $(call objects,$(filter tests/%,$(TEST_SRC)))): | $(SUITE_LISTS)

$(call objects,tests/run.c): CFLAGS += -D'TEST_SUITES=$(foreach suite,$(SUITES),SUITE($(suite)))'
$(call objects,tests/run.c): HOST_CFLAGS += -D'TEST_SUITES=$(foreach suite,$(SUITES),SUITE($(suite)))'
$(call objects,tests/run.c): $(wildcard tests/unit/test_*.c tests/suite/test_*.c)

# Most suites call what takes the time: of their own code it is the compiler that does. -O1 is a third less.
QUICK_SUITES := $(filter-out %/test_accuracy.c %/test_blur.c %/test_image.c,$(wildcard tests/suite/test_*.c))
ifeq ($(filter-out -O2,$(OPT)),)
$(call objects,$(QUICK_SUITES)): CFLAGS += -O1
endif
$(call objects,$(QUICK_SUITES)): HOST_CFLAGS += -O1
# Its macros are seven megabytes of text, which GCC takes half a minute to optimize.
$(call objects,tests/suite/test_memory.c): CFLAGS += -O0
$(call objects,tests/suite/test_memory.c): HOST_CFLAGS += -O0

$(BUILD)/tests/run.o: $(BUILD)/suites
$(BUILD)/suites: always
	@mkdir -p $(@D)
	@echo '$(SUITES) $(KERNEL_TESTS)' | cmp -s - $@ || echo '$(SUITES) $(KERNEL_TESTS)' > $@

KERNEL_FAMILIES := -D'KERNEL_FAMILIES=$(foreach family,$(KERNEL_TESTS:tests/kernels/%.c=%),FAMILY($(family)))'
$(sort $(BUILD)/tests/unit/test_kernels.o $(call objects,tests/unit/test_kernels.c)): CFLAGS += $(KERNEL_FAMILIES)
build/host/tests/unit/test_kernels.o: HOST_CFLAGS += $(KERNEL_FAMILIES)
$(sort $(BUILD)/tests/unit/test_kernels.o $(call objects,tests/unit/test_kernels.c)): $(BUILD)/suites

$(TESTS): $(call objects,$(TEST_SRC) $(TOOL_SRC)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm -lpthread

.PHONY: print-suites print-san-suites run-suite test-headers test-examples test-flush test-tables test-readme
print-suites:
	@echo $(SUITES)

print-san-suites:
	@echo $(SAN_SUITES)

# Real models lie beside the repository where they are at hand.
## tests: one of them, SUITE=api; `make print-suites` lists them
run-suite: $(TESTS)
	SMEAR_ASSETS=$${SMEAR_ASSETS-$(wildcard ../shared/assets)} $(TESTS) --suite $(or $(SUITE),$(error which? SUITE=api; make print-suites lists them))

# Suites of seconds that reach into every room of src/.
COVERAGE_SUITES := $(filter-out accuracy alike apart blur bounds chart cover edges_truth failures filters foreign guess image jpeg json memory metrics \
                   model near near_sweep present ref room rooms scenes sight sketch sketch_truth small turns view x11,$(SUITES))
.PHONY: coverage run-coverage
## tests: branches of src/ that suites and the generator take, against tests/coverage.txt: at least 95 %
coverage:
	$(MAKE) --no-print-directory COVERAGE=1 run-coverage

run-coverage: $(TESTS) $(BUILD)/frames $(BUILD)/target_golden
	sh tests/coverage.sh $(BUILD) "$(COVERAGE_SUITES)"

$(BUILD)/frames: $(call objects,tests/fuzz/frames.c $(wildcard tests/fuzz/cases*.c)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lpthread

.PHONY: proofs
## tests: numbers, texture addresses, formats and clipping free of run-time errors, by Frama-C and by trying all; STEP=n: every n-th
proofs: build/proofs/reciprocals build/proofs/polygons
	sh tests/proofs/proofs.sh $^ $(STEP)

build/proofs/reciprocals: src/base/fixmath.h src/base/fixed.h
build/proofs/polygons: src/geometry/clip.c src/geometry/clip.h src/geometry/matrix.c src/base/fixmath.h src/base/fixed.h
build/proofs/%: tests/proofs/%.c src/base/tables.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(CC) -std=c11 -O2 -Wall -Wextra -Iinclude -Isrc -I. -DSMEAR_CHECK=1 -fsanitize=signed-integer-overflow,shift,bounds \
	    -fsanitize-undefined-trap-on-error -o $@ $< src/base/tables.c

.PHONY: check-kernels
## tests: every variant of an inner loop against its reference, and nanoseconds per pixel of both
check-kernels: $(BUILD)/check_kernels
	$<

$(BUILD)/check_kernels: $(call objects,tests/kernels/check_kernels.c tests/test.c tests/random.c tests/unit/test_kernels.c $(KERNEL_TESTS)) $(LIB)
	$(CC) $(LDFLAGS) -o $@ $^

# Of tests in C++ where a compiler of it is.
with_cxx = $(if $(shell command -v $(CXX)),$1)

# Each public header alone, as C99 and as C++11, and what is used of them; memory as a constant by both.
STRICT := -Wall -Wextra -Wconversion -Wshadow -pedantic -Werror -Iinclude
test-headers:
	@mkdir -p $(BUILD)
	for header in $(notdir $(wildcard include/*.h)); do \
	    printf '#include <%s>\nextern int used;\n' $$header | $(CC) -std=c99 $(STRICT) -c -o $(BUILD)/header.o -x c - || exit 1; done
	$(CC) -std=c99 -Wall -Wextra -pedantic -Werror -Iinclude -c -o $(BUILD)/header_c99.o tests/unit/header.c
	$(CC) -std=c99 $(STRICT) -o $(BUILD)/memory_forms tests/examples/memory_forms.c
	$(BUILD)/memory_forms > $(BUILD)/memory_forms.txt
	$(call with_cxx,set -e; \
	    for header in $(notdir $(wildcard include/*.h include/*.hpp)); do \
	        printf '#include <%s>\n' $$header | $(CXX) -std=c++11 $(STRICT) -c -o $(BUILD)/header.o -x c++ -; done; \
	    $(CXX) -std=c++11 -Wall -Wextra -pedantic -Werror -Iinclude -x c++ -c -o $(BUILD)/header_cxx.o tests/unit/header.c; \
	    $(CXX) -std=c++11 $(STRICT) -o $(BUILD)/memory_forms_cxx -x c++ tests/examples/memory_forms.c; \
	    $(BUILD)/memory_forms_cxx | cmp - $(BUILD)/memory_forms.txt)

# Programs by the public headers alone, as C99, as C++11 and by smear.hpp: one picture, of more than a few colours.
EXAMPLES := $(BUILD)/examples
test-examples: $(LIB)
	@mkdir -p $(EXAMPLES)
	[ $$(wc -l < tests/examples/orbit.c) -lt 60 ]
	$(CC) -std=c99 -O1 $(STRICT) -o $(EXAMPLES)/orbit_c tests/examples/orbit.c $(LIB)
	$(EXAMPLES)/orbit_c > $(EXAMPLES)/c.ppm
	$(call with_cxx,set -e; \
	    $(CXX) -std=c++11 -O1 $(STRICT) -o $(EXAMPLES)/orbit_cxx -x c++ tests/examples/orbit.c -x none $(LIB); \
	    $(CXX) -std=c++11 -O1 -fno-exceptions -fno-rtti $(STRICT) -o $(EXAMPLES)/orbit_hpp tests/examples/orbit.cpp $(LIB); \
	    for form in cxx hpp; do $(EXAMPLES)/orbit_$$form | cmp - $(EXAMPLES)/c.ppm; done)
	[ $$(tail -c 57600 $(EXAMPLES)/c.ppm | od -An -v -tx1 -w3 | sort -u | wc -l) -gt 100 ]

# flush() for other people's displays (platform/examples), on stand-ins of their headers: one picture on all panels.
FLUSH_CXX := adafruit_gfx arduino_gfx ili9341_t4 lovyangfx tft_espi u8g2
FLUSH_ALL := $(filter-out cube fox show terminal,$(patsubst platform/examples/%.h,%,$(wildcard platform/examples/*.h))) esp_bsp_dsi
test-flush: $(LIB)
	CC="$(CC)" CXX="$(CXX)" FLUSH_CXX="$(FLUSH_CXX)" sh tests/shell/flush.sh $(BUILD)/flush $(LIB) \
	    $(filter-out $(if $(call with_cxx,yes),,$(FLUSH_CXX)),$(FLUSH_ALL))

test-tables: build/gentables
	build/gentables | cmp - src/base/tables.c

.PHONY: test-manual
# All of the manual is compiled and run, and no public name is missing in it.
test-manual: $(LIB) $(BIN)/smear
	CC="$(CC)" CXX="$(call with_cxx,$(CXX))" sh tests/shell/manual.sh $(BIN)/smear $(LIB) $(BUILD)/manual

# The program of the README, and its picture; its length; the memory of methods, a table of the manual, and what the README says of it.
README_LINES := 130
README_WORDS := 1100
test-readme: $(LIB) $(BUILD)/methods $(BIN)/smear-demo $(BUILD)/readme.ppm
	@mkdir -p $(BUILD)
	sh tests/shell/links.sh README.md include/README.md platform/README.md platform/tables.md platform/lessons/README.md src/README.md src/CHANGES.md \
	    tests/README.md tools/README.md
	grep -q "^## [0-9.]*, .*headers say $$(sh tools/dist/version.sh | sed 's/\.[0-9]*$$//')$$\|^## $$(sh tools/dist/version.sh | sed 's/\.[0-9]*$$//'), " src/CHANGES.md
	[ $$(wc -l < README.md) -le $(README_LINES) ] && [ $$(wc -w < README.md) -le $(README_WORDS) ]
	test $$(wc -l < $(BUILD)/readme.c) -le 45
	(cat $(BUILD)/readme.c; echo 'typedef char fits[sizeof memory <= 40960 ? 1 : -1];') > $(BUILD)/readme_fits.c
	$(CC) -std=c99 -Iinclude -c -o $(BUILD)/readme_fits.o $(BUILD)/readme_fits.c
	$(call with_cxx,set -e; \
	    $(CXX) -x c++ -std=c++11 -Wall -Wextra -Wno-unused-function -Werror -Iinclude -c -o $(BUILD)/readme_cxx.o $(BUILD)/readme.c; \
	    $(CXX) -o $(BUILD)/readme $(BUILD)/readme_cxx.o $(LIB); \
	    $(BUILD)/readme | cmp - $(BUILD)/readme.ppm)
	$(BIN)/smear-demo --enlarge 2 $(BUILD)/readme.ppm $(BUILD)/first.png
	cmp $(PICTURES)/first.png $(BUILD)/first.png || \
	    { echo "$(PICTURES)/first.png is not what the first program draws: make readme-pictures" >&2; exit 1; }
	sed 's/frame.camera = /frame.method = SMEAR_NONE, &/' $(BUILD)/readme.c > $(BUILD)/readme_sharp.c
	$(CC) -std=c99 -Iinclude -o $(BUILD)/readme $(BUILD)/readme_sharp.c $(LIB)
	! $(BUILD)/readme | cmp -s - $(BUILD)/readme.ppm
	$(BUILD)/methods > build/methods.md
	awk '/^<!-- .methods -->/{on=0} on; /^<!-- methods -->/{on=1}' include/README.md | cmp - build/methods.md || \
	    { echo "include/README.md: the memory of methods is another: make readme-figures" >&2; exit 1; }
	memory() { sed -n "s/^| .$$1. .* \\([0-9]*\\) kB |$$/\\1/p" build/methods.md; }; \
	    grep -q "240x240 pixels $$(memory SMEAR_NONE) kB, with blur $$(memory SMEAR_AUTO) to $$(memory SMEAR_SET_SKETCH) kB" README.md || \
	    { echo "README.md: memory of sharp and blurred frames is another than build/methods.md says" >&2; exit 1; }
	code() { awk -v name="$$1" '/^cortex.*flash/ { core++ } core == 1 && index($$0, name) == 1 { sub(name, ""); printf "%.0f", $$1 / 1000 }' platform/tables.md; }; \
	    grep -q "takes $$(code 'only RGB565, sharp') to $$(code everything) kB" README.md || \
	    { echo "README.md: the library takes more or less than platform/tables.md says" >&2; exit 1; }
	@for name in $$(grep -o 'test_[a-z0-9_]*' README.md tests/README.md include/README.md -h | sort -u); do \
	    grep -q "static void $$name(void)" tests/*/test_*.c || { echo "README.md: no test $$name" >&2; exit 1; }; done

$(BUILD)/readme.c: README.md
	@mkdir -p $(@D)
	awk '/^```c$$/{on=1;next} /^```$$/{on=0} on' README.md > $@

$(BUILD)/readme.ppm: $(BUILD)/readme.c $(LIB)
	$(CC) -std=c99 -Wall -Wextra -Wno-unused-function -Werror -Iinclude -o $(BUILD)/readme $< $(LIB)
	$(BUILD)/readme > $@

$(BUILD)/methods: tests/examples/memory.c $(LIB)
	$(CC) -std=c99 $(STRICT) -o $@ $< $(LIB)

.PHONY: readme-figures rates-readme failures-readme manual-names
## again: the manual's table of names
manual-names:
	for header in smear smear_math smear_overlay smear_ribbon smear_matcap smear_scene smear_model smear_memory smear_methods smear_stats; do \
	    sed 's://.*::' include/$$header.h | awk -f tests/shell/header_names.awk; done > build/header_names.txt
	awk -f tests/shell/manual_names.awk build/header_names.txt include/README.md > build/names.md
	awk -f platform/footprint_readme.awk include/README.md > build/readme.md && mv build/readme.md include/README.md

## again: the memory of methods in the manual
readme-figures: $(BUILD)/methods
	$(BUILD)/methods > build/methods.md
	awk -f platform/footprint_readme.awk include/README.md > build/readme.md && mv build/readme.md include/README.md

## again: the table in tests/README.md of where methods fail
failures-readme:
	$(MAKE) --no-print-directory -s run-suite SUITE=failures
	awk -f tests/shell/failures_table.awk build/test/failures.txt > build/failures.md
	awk -f platform/footprint_readme.awk tests/README.md > build/readme.md && mv build/readme.md tests/README.md

## again: the demo's frames per second on emulated machines in README.md, RATES="pico gba"
rates-readme:
	$(of_make) sh platform/rates.sh $(or $(RATES),pico gba lm3s6965evb microbit) > build/rates.md
	awk -f platform/footprint_readme.awk README.md > build/readme.md && mv build/readme.md README.md

.PHONY: board-table
## again: what the demo costs on boards, by scene and method, in platform/tables.md, BOARDS="pico gba"
board-table:
	$(of_make) sh platform/board_table.sh $(or $(BOARDS),pico gba lm3s6965evb raspi0) > build/boards.md
	awk -f platform/footprint_readme.awk platform/tables.md > build/readme.md && mv build/readme.md platform/tables.md

# The program with its calls of the system wrapped: each can be made to fail.
FAULTS_WRAPPED := main malloc calloc realloc open fopen fdopen fileno open_memstream realpath fsync rename link unlink pthread_create
$(BUILD)/faults-injected: $(call objects,$(wildcard tests/faults/*.c) $(CLI_SRC) $(VIEW_SRC) $(TOOL_SRC)) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(FAULTS_WRAPPED:%=-Wl,--wrap=%) -o $@ $^ -lm -lpthread

# JPEG files of ours, and what is read of others.
$(BUILD)/jpeg-files: $(call objects,tests/shell/jpeg_files.c tests/random.c $(IMAGE_SRC))
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm

$(BUILD)/hostile: $(call objects,tests/shell/hostile.c $(IMAGE_SRC))
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $^ -lm

.PHONY: faults-injected
## tests: every allocation, read, write and rename of the program fails once, and the power at each
faults-injected: $(BUILD)/faults-injected
	$< .

include platform/programs.mk
include platform/game/game.mk
include platform/lessons/lessons.mk
include tools/web/web.mk
include tests/fuzz/fuzz.mk

# The firmware on a desktop's screen.
NOT_OF_SCREENS := $(PROGRAM_OBJ) $(DISPLAY_SRC:%.c=$(BUILD)/%.o)
$(BUILD)/demo-screen:  $(filter-out $(NOT_OF_SCREENS),$(FIRMWARE_OBJ))
$(BUILD)/model-screen: $(filter-out $(NOT_OF_SCREENS),$(MODEL_OBJ))
$(BUILD)/game-screen: $(GAME_OBJ)
$(BUILD)/demo-screen $(BUILD)/model-screen $(BUILD)/game-screen: $(BUILD)/platform/print.o $(BUILD)/libsmear-display.a $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) -o $@ $(filter %.o,$^) $(filter %.a,$^) -lm

## start: a race in a window or terminal: left and right steer, down brakes; build/host/game-screen
game: $(BUILD)/game-screen
	$< show window

## figures: instructions per piece of work on TARGET, for the estimates of `smear view` (tools/view/cost.c)
cost-model: $(BUILD)/cost_bench$(EXE) build/tapes/view_cost
	$(RUN_BENCH) $< > $(BUILD)/cost.txt
	build/tapes/view_cost fit build/tapes/cost.counts $(BUILD)/cost.txt

build/tapes/view_cost: $(call host_objects,tests/target/view_cost.c tools/view/cost.c $(filter-out tests/target/target_tapes.c,$(TAPES_SRC)))
	$(call say,LD)
	@mkdir -p $(@D)
	$(HOST_CC) -o $@ $^ -lm

build/tapes/cost.c: build/tapes/view_cost
	$(call say,GEN)
	build/tapes/view_cost tapes $@ build/tapes/cost.counts

$(BUILD)/cost_bench$(EXE): $(PLATFORM_OBJ) $(call objects,$(PLATFORM_SRC) platform/print.c tests/target/target_bench.c platform/play.c build/tapes/cost.c) $(LIB)
	$(call say,LD)
	$(CC) $(LDFLAGS) $(BENCH_LDFLAGS) -o $@ $^ $(LDLIBS)

# What the objects of this build are made of, those of this machine, which any build may want, and of web pages.
-include $(shell find $(sort $(BUILD) build/host $(if $(filter web% build/web/%,$(MAKECMDGOALS)),build/web)) -name '*.d' 2>/dev/null)
