# SPDX-License-Identifier: MIT
# Fuzzers, and the generator of frames (cases.c) under sanitizers and in other builds.

FUZZ_CC := clang-14
FUZZ_BASE := -std=c11 -g1 -Iinclude -Isrc -I. -MMD -MP
FUZZ_FLAGS := $(FUZZ_BASE) -D_GNU_SOURCE -O1 -DSMEAR_CHECK=1
FUZZERS := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
FUZZ_OBJ := $(patsubst %.c,build/fuzz/obj/%.o,$(LIB_SRC) $(TOOL_SRC) tests/x_server.c \
    $(addprefix tools/view/,guard.c screen_x11.c script.c surface.c x11.c x11_auth.c))

# As in the Makefile, what compilers know of vectors is read once for all sources of a build: `vectors` is what says so, for those
# of src/. Clang looks for it beside the header, and so does GCC.
define fuzz_vectors
build/fuzz/$(1)/src/%.o: private vectors := -include build/fuzz/$(1)/vectors.h
$(LIB_SRC:%.c=build/fuzz/$(1)/%.o): | build/fuzz/$(1)/vectors.h.gch
build/fuzz/$(1)/vectors.h.gch: tests/fuzz/fuzz.mk
	$$(call say,CC,$$(@:.gch=))
	@mkdir -p $$(@D)
	printf '#ifdef __x86_64__\n#include <immintrin.h>\n#endif\n' > $$(@:.gch=)
	$(2) -x c-header -o $$@ $$(@:.gch=)
endef

# Beside undefined behaviour, in the library conversions that nobody wrote may not change a value.
FUZZ_CHECKED := address,undefined,implicit-conversion,local-bounds
FUZZ_OBJ_FLAGS := $(FUZZ_FLAGS) -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
build/fuzz/obj/%.o: %.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(FUZZ_CC) $(FUZZ_OBJ_FLAGS) $(checked) $(vectors) -c -o $@ $<
FUZZ_LIB_FLAGS := -fsanitize=$(FUZZ_CHECKED) -fno-sanitize-recover=all
build/fuzz/obj/src/%.o: private checked := $(FUZZ_LIB_FLAGS)
$(eval $(call fuzz_vectors,obj,$(FUZZ_CC) $(filter-out -MMD -MP,$(FUZZ_OBJ_FLAGS)) $(FUZZ_LIB_FLAGS)))

build/fuzz/%: tests/fuzz/fuzz_%.c $(FUZZ_OBJ)
	$(call say,LD)
	@mkdir -p $(@D)
	$(FUZZ_CC) $(FUZZ_FLAGS) -fsanitize=fuzzer,address,undefined -o $@ $< $(FUZZ_OBJ) -lm -lpthread

FUZZ_GOALS := $(filter fuzz% build/fuzz/%,$(MAKECMDGOALS))
-include $(if $(FUZZ_GOALS),$(FUZZ_OBJ:.o=.d))

# Each fuzzer over its corpus once, and for a few seconds beyond it.
.PHONY: fuzz-corpus
## fuzzers of blobs, models, pictures, input, X servers and the library (needs clang-14), FUZZ_SECONDS=10 each
fuzz-corpus: $(FUZZERS:%=build/fuzz/%)
	for name in $(FUZZERS); do \
	    mkdir -p build/fuzz/found-$$name tests/fuzz/corpus/$$name && \
	    build/fuzz/$$name -max_total_time=$${FUZZ_SECONDS:-10} -max_len=4096 -rss_limit_mb=3000 -timeout=20 -print_final_stats=0 -verbosity=0 \
	        build/fuzz/found-$$name tests/fuzz/corpus/$$name || exit 1; \
	done

# ---------------------------------------------------------------------- frames

FRAMES_SRC := tests/fuzz/frames.c $(wildcard tests/fuzz/cases*.c) $(LIB_SRC)

# frames_build NAME,COMPILER,FLAGS: the program build/fuzz/frames-NAME.
define frames_build
build/fuzz/$(1)/%.o: %.c
	$$(call say,CC,$$<)
	@mkdir -p $$(@D)
	$(2) $(FUZZ_BASE) -D_GNU_SOURCE $(3) $$(vectors) -c -o $$@ $$<
build/fuzz/frames-$(1): $(FRAMES_SRC:%.c=build/fuzz/$(1)/%.o)
	$$(call say,LD)
	$(2) $(3) -o $$@ $$^ -lpthread
-include $(if $(FUZZ_GOALS),$(FRAMES_SRC:%.c=build/fuzz/$(1)/%.d))
$(call fuzz_vectors,$(1),$(2) $(filter-out -MMD -MP,$(FUZZ_BASE)) -D_GNU_SOURCE $(3))
endef

# The library of the fuzzers.
build/fuzz/frames-address: $(FRAMES_SRC:%.c=build/fuzz/obj/%.o)
	$(call say,LD)
	$(FUZZ_CC) $(FUZZ_OBJ_FLAGS) $(FUZZ_LIB_FLAGS) -o $@ $^ -lpthread
-include $(if $(FUZZ_GOALS),$(FRAMES_SRC:%.c=build/fuzz/obj/%.d))
$(eval $(call frames_build,memory,$(FUZZ_CC),-O1 -DSMEAR_CHECK=1 -fsanitize=memory -fno-omit-frame-pointer))
$(eval $(call frames_build,threads,$(FUZZ_CC),-O1 -DSMEAR_CHECK=1 -fsanitize=thread))

.PHONY: fuzz fuzz-builds
## valid and wild frames under sanitizers (needs clang-14), MINUTES=1 in all from case FIRST=1; build/fuzz/frames-address valid N: one
fuzz: build/fuzz/frames-address build/fuzz/frames-memory build/fuzz/frames-threads
	build/fuzz/frames-address valid $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 15)) s
	build/fuzz/frames-address wild $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 15)) s
	build/fuzz/frames-memory valid $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 10)) s
	build/fuzz/frames-memory wild $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 5)) s
	TSAN_OPTIONS=halt_on_error=1 build/fuzz/frames-threads threads $(or $(FIRST),1) $$(($(or $(MINUTES),1) * 15)) s

# Builds that must draw the same: by optimization, compiler, width of a word, and what the code is told of the core.
# At -O0 what overflows ends the program; at -O1 a picture that depends on a variable that nobody wrote, or that is out of scope,
# is another one.
FUZZ_BUILDS := gcc-O0 gcc-O1 gcc-O2 gcc-O3 clang-O2 m32 mul16 scalar sse2 armv6m armv7em
$(eval $(call frames_build,gcc-O0,gcc,-O0 -ftrapv))
$(eval $(call frames_build,gcc-O1,gcc,-O1 -ftrivial-auto-var-init=pattern))
$(eval $(call frames_build,gcc-O3,gcc,-O3))
$(eval $(call frames_build,clang-O2,$(FUZZ_CC),-O2))
$(eval $(call frames_build,m32,gcc,-m32 -O2))
$(eval $(call frames_build,mul16,gcc,-Os -DSMEAR_HAS_MUL64=0 -DSMEAR_HAS_CLZ=0))
$(eval $(call frames_build,scalar,gcc,-O2 -DSMEAR_VECTORS=0))
# Chars are unsigned, as on ARM; by which GCC leaves AVX2 out, too (avx2.h).
$(eval $(call frames_build,sse2,gcc,-O2 -DSMEAR_AVX2=0 -funsigned-char))
# The library of this machine's programs.
build/fuzz/frames-gcc-O2: $(call host_objects,$(FRAMES_SRC))
	$(call say,LD)
	@mkdir -p $(@D)
	gcc -o $@ $^ -lpthread
# Assembly for Cortex-M0 and M4 in programs for Linux, which are emulated. (Code for any address leaves it too few registers.)
FUZZ_THUMB := arm-linux-gnueabihf-gcc -mthumb -static -fno-pic -O2 -DSMEAR_VECTORS=0
$(eval $(call frames_build,armv6m,$(FUZZ_THUMB),-DSMEAR_ASM_ARMV6M=1 -DSMEAR_HAS_MUL64=0 -DSMEAR_HAS_CLZ=0))
$(eval $(call frames_build,armv7em,$(FUZZ_THUMB) -march=armv7ve+fp,-DSMEAR_ASM_ARMV7EM=1))

## pictures of CASES=2000 cases from FIRST=1 by eleven builds: of gcc, clang, -O0 to -O3, -m32 and others (BUILDS="m32 scalar")
fuzz-builds: $(foreach build,$(or $(BUILDS),$(FUZZ_BUILDS)),build/fuzz/frames-$(build))
	first=; \
	for build in $(or $(BUILDS),$(FUZZ_BUILDS)); do \
	    case $$build in arm*) run=qemu-arm-static ;; *) run= ;; esac; \
	    $$run build/fuzz/frames-$$build sums $(or $(FIRST),1) $(or $(CASES),2000) > build/fuzz/sums-$$build || exit 1; \
	    first=$${first:-$$build}; \
	    cmp build/fuzz/sums-$$first build/fuzz/sums-$$build || exit 1; \
	done; \
	echo "$(words $(or $(BUILDS),$(FUZZ_BUILDS))) builds draw the same: $$(tail -n 1 build/fuzz/sums-$$first)"
