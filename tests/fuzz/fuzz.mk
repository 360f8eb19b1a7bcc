# SPDX-License-Identifier: MIT
# Fuzzers, and the generator of frames (cases.c) under sanitizers and in other builds.

FUZZ_CC := clang-14
FUZZ_BASE := -std=c11 -g1 -Iinclude -Isrc -I. -MMD -MP
FUZZ_FLAGS := $(FUZZ_BASE) -D_GNU_SOURCE -O1 -DSMEAR_CHECK=1
FUZZERS := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
FUZZ_OBJ := $(patsubst %.c,build/fuzz/obj/%.o,$(LIB_SRC) $(TOOL_SRC) tests/x_server.c tests/random.c \
    $(addprefix tools/view/,guard.c screen_x11.c script.c surface.c x11.c))

# Beside undefined behaviour, in the library conversions that nobody wrote may not change a value.
FUZZ_CHECKED := address,undefined,implicit-conversion,local-bounds
FUZZ_OBJ_FLAGS := $(FUZZ_FLAGS) -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
build/fuzz/obj/%.o: %.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(FUZZ_CC) $(FUZZ_OBJ_FLAGS) $(checked) -c -o $@ $<
FUZZ_LIB_FLAGS := -fsanitize=$(FUZZ_CHECKED) -fno-sanitize-recover=all
build/fuzz/obj/src/%.o: private checked := $(FUZZ_LIB_FLAGS)

build/fuzz/%: tests/fuzz/fuzz_%.c $(FUZZ_OBJ)
	$(call say,LD)
	@mkdir -p $(@D)
	$(FUZZ_CC) $(FUZZ_FLAGS) -fsanitize=fuzzer,address,undefined -o $@ $< $(filter %.o,$^) -lm -lpthread
build/fuzz/smear: $(patsubst %.c,build/fuzz/obj/%.o,$(wildcard tests/fuzz/cases*.c))

FUZZ_GOALS := $(filter fuzz% build/fuzz/%,$(MAKECMDGOALS))
-include $(if $(FUZZ_GOALS),$(FUZZ_OBJ:.o=.d))

# Each fuzzer over its corpus once, and for a few seconds beyond it: along one series, so that what CI finds is found again here.
.PHONY: fuzz-corpus
## tests: fuzzers of blobs, models, pictures, input, X servers and the library (needs clang-14), FUZZ_SECONDS=10 each from FUZZ_SEED=1
fuzz-corpus: $(FUZZERS:%=build/fuzz/%)
	for name in $(FUZZERS); do \
	    mkdir -p build/fuzz/found-$$name tests/fuzz/corpus/$$name && \
	    build/fuzz/$$name -seed=$${FUZZ_SEED:-1} -max_total_time=$${FUZZ_SECONDS:-10} -max_len=4096 -rss_limit_mb=3000 -timeout=20 \
	        -print_final_stats=0 -verbosity=0 build/fuzz/found-$$name tests/fuzz/corpus/$$name $$([ $$name != jpeg ] || echo tests/data/jpeg) || exit 1; \
	done

# ---------------------------------------------------------------------- frames

FRAMES_SRC := tests/fuzz/frames.c $(wildcard tests/fuzz/cases*.c) $(LIB_SRC)

# frames_build NAME,COMPILER,FLAGS: the program build/fuzz/frames-NAME.
define frames_build
build/fuzz/$(1)/%.o: %.c
	$$(call say,CC,$$<)
	@mkdir -p $$(@D)
	$(2) $(FUZZ_BASE) -D_GNU_SOURCE $(3) -c -o $$@ $$<
build/fuzz/frames-$(1): $(FRAMES_SRC:%.c=build/fuzz/$(1)/%.o)
	$$(call say,LD)
	$(2) $(3) -o $$@ $$^ -lpthread
-include $(if $(FUZZ_GOALS),$(FRAMES_SRC:%.c=build/fuzz/$(1)/%.d))
endef

# The library of the fuzzers.
build/fuzz/frames-address: $(FRAMES_SRC:%.c=build/fuzz/obj/%.o)
	$(call say,LD)
	$(FUZZ_CC) $(FUZZ_OBJ_FLAGS) $(FUZZ_LIB_FLAGS) -o $@ $^ -lpthread
-include $(if $(FUZZ_GOALS),$(FRAMES_SRC:%.c=build/fuzz/obj/%.d))
$(eval $(call frames_build,memory,$(FUZZ_CC),-O1 -DSMEAR_CHECK=1 -fsanitize=memory -fno-omit-frame-pointer))
$(eval $(call frames_build,threads,$(FUZZ_CC),-O1 -DSMEAR_CHECK=1 -fsanitize=thread))

.PHONY: fuzz fuzz-many fuzz-builds
## tests: valid and wild frames, and valid ones in parts, under sanitizers (needs clang-14), MINUTES=1 in all from case FIRST=1; build/fuzz/frames-address valid N: one
fuzz: build/fuzz/frames-address build/fuzz/frames-memory build/fuzz/frames-threads
	build/fuzz/frames-address valid $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 10)) s
	build/fuzz/frames-address parts $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 5)) s
	build/fuzz/frames-address wild $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 10)) s
	build/fuzz/frames-address many $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 10)) s
	build/fuzz/frames-memory valid $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 10)) s
	build/fuzz/frames-memory wild $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 5)) s
	TSAN_OPTIONS=halt_on_error=1 build/fuzz/frames-threads threads $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 7)) s
	TSAN_OPTIONS=halt_on_error=1 build/fuzz/frames-threads many $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 4)) s

# The library of sanitized suites, which takes a quarter of the time: that of the fuzzers counts what it passes.
## tests: FRAMES=20000 of 256 to 20,000 triangles by 2 to 8 workers, sanitized, against one worker with room, from case FIRST=1
fuzz-many:
	$(MAKE) -s SAN=1 CHECK=1 build/host-san-check/frames
	build/host-san-check/frames many $(or $(FIRST),1) $(or $(FRAMES),20000) f

# Builds that must draw the same: by compiler, optimization, width of a word, and what the code is told of the core. Most are the
# one-file form's, whose objects draw golden frames, too (one_file.sh says what each is for). What draws is the same in all.
ONE_FILE_BUILDS := gcc-O0 gxx-O1 gcc-O3 clang-O2 m32 plain armv7em
FUZZ_BUILDS := gcc-O0 gxx-O1 gcc-O2 gcc-O3 clang-O2 m32 mul16 plain unsigned armv6m armv7em
CASES_SRC := $(filter-out $(LIB_SRC),$(FRAMES_SRC))
$(ONE_FILE_BUILDS:%=build/fuzz/one-file/%.o): build/fuzz/one-file/%.o: $(ONE_FILE) tests/shell/one_file.sh
	$(call say,CC,$@)
	sh tests/shell/one_file.sh $* $< $@

# own_cases NAME,COMPILER: the generator's objects build/fuzz/NAME/, of compilers that do not draw for this machine.
define own_cases
$(CASES_SRC:%.c=build/fuzz/$(1)/%.o): build/fuzz/$(1)/%.o: %.c
	$$(call say,CC,$$<)
	@mkdir -p $$(@D)
	$(2) $(FUZZ_BASE) -D_GNU_SOURCE -O1 -c -o $$@ $$<
-include $(if $(FUZZ_GOALS),$(CASES_SRC:%.c=build/fuzz/$(1)/%.d))
endef
$(eval $(call own_cases,m32-cases,gcc -m32))
FUZZ_THUMB := arm-linux-gnueabihf-gcc -mthumb -static -fno-pic
$(eval $(call own_cases,arm-cases,$(FUZZ_THUMB)))

# frames_of NAME,COMPILER,OBJECTS: the program build/fuzz/frames-NAME of the generator's objects and the library's.
define frames_of
build/fuzz/frames-$(1): $(3)
	$$(call say,LD)
	@mkdir -p $$(@D)
	$(2) -o $$@ $$^ -lpthread
endef
$(foreach build,gcc-O0 gxx-O1 gcc-O3 clang-O2 plain,$(eval $(call \
    frames_of,$(build),gcc,$(call host_objects,$(CASES_SRC)) build/fuzz/one-file/$(build).o)))
$(eval $(call frames_of,m32,gcc -m32,$(CASES_SRC:%.c=build/fuzz/m32-cases/%.o) build/fuzz/one-file/m32.o))
$(eval $(call frames_of,armv7em,$(FUZZ_THUMB),$(CASES_SRC:%.c=build/fuzz/arm-cases/%.o) build/fuzz/one-file/armv7em.o))
# The library of this machine's programs.
$(eval $(call frames_of,gcc-O2,gcc,$(call host_objects,$(FRAMES_SRC))))

# lib_build NAME,COMPILER,FLAGS,CASES: a build of the files of src/, with the generator's objects CASES.
define lib_build
build/fuzz/$(1)/%.o: %.c
	$$(call say,CC,$$<)
	@mkdir -p $$(@D)
	$(2) $(3) -Iinclude -Isrc -I. -MMD -MP -c -o $$@ $$<
-include $(if $(FUZZ_GOALS),$(LIB_SRC:%.c=build/fuzz/$(1)/%.d))
$(call frames_of,$(1),$(2),$(4) $(LIB_SRC:%.c=build/fuzz/$(1)/%.o))
endef
$(eval $(call lib_build,mul16,gcc,-std=c11 -Os -DSMEAR_HAS_MUL64=0 -DSMEAR_HAS_CLZ=0,$(call host_objects,$(CASES_SRC))))
# Chars are unsigned, as on ARM. Flags and objects are those of packages (dist.sh).
FUZZ_CACHED := SMEAR_OBJECTS=$${SMEAR_OBJECTS:-build/test/objects} sh tests/shell/launch_cached.sh $(HOST_CC)
$(eval $(call lib_build,unsigned,$(subst $$,$$$$,$(FUZZ_CACHED)),-std=gnu11 -O2 -Wall -Wextra -Werror -funsigned-char,\
    $(call host_objects,$(CASES_SRC))))
# Assembly for Cortex-M0 in a program for Linux, which is emulated. (Code for any address leaves it too few registers.)
$(eval $(call lib_build,armv6m,$(FUZZ_THUMB),-std=c11 -O2 -DSMEAR_VECTORS=0 -DSMEAR_ASM_ARMV6M=1 -DSMEAR_HAS_MUL64=0 -DSMEAR_HAS_CLZ=0,\
    $(CASES_SRC:%.c=build/fuzz/arm-cases/%.o)))

## tests: pictures of CASES=2000 cases from FIRST=1 by eleven builds: of gcc, clang, -O0 to -O3, -m32 and others (BUILDS="m32 plain")
fuzz-builds: $(foreach build,$(or $(BUILDS),$(FUZZ_BUILDS)),build/fuzz/frames-$(build))
	first=; \
	for build in $(or $(BUILDS),$(FUZZ_BUILDS)); do \
	    case $$build in arm*) run=qemu-arm-static ;; *) run= ;; esac; \
	    $$run build/fuzz/frames-$$build sums $(or $(FIRST),1) $(or $(CASES),2000) > build/fuzz/sums-$$build || exit 1; \
	    first=$${first:-$$build}; \
	    cmp build/fuzz/sums-$$first build/fuzz/sums-$$build || exit 1; \
	done; \
	echo "$(words $(or $(BUILDS),$(FUZZ_BUILDS))) builds draw the same: $$(tail -n 1 build/fuzz/sums-$$first)"
