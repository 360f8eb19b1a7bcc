# SPDX-License-Identifier: MIT
# The web page: build/web/index.html, one file. Needs clang-14, wasm-ld-14 and xz (packages clang-14, lld-14, xz-utils).

WEB_CC ?= clang-14
WEB_LD ?= wasm-ld-14
WEB_XZ ?= xz
WEB    := build/web

# What the page needs of the tools, and scenes that are to be looked at in place of all.
WEB_SRC := tools/web/web.c tools/web/catalog.c tools/web/files.c $(wildcard tools/web/libc/*.c) $(LIB_SRC) $(MODEL_SRC) $(CONVERT_SRC) \
    $(filter-out $(addprefix tools/image/,apng.c metrics.c netpbm.c output.c),$(IMAGE_SRC)) \
    $(addprefix tools/scenes/,backdrop.c build.c builtin.c demo.c demo_car.c demo_drone.c demo_track.c methods.c model_scene.c present.c present_surface.c \
        scene.c stage.c sight.c) \
    $(filter-out $(addprefix tools/cli/,compare.c help.c info.c main.c render.c show.c show_choose.c view.c) $(addprefix tools/options/,apart.c sink.c) \
        $(addprefix tools/player/,crew.c exact.c planes.c),$(CLI_SRC)) \
    $(addprefix tools/view/,board.c cost.c lane.c orbit.c panel.c surface.c tiles.c)

# The page lays nothing over its frames; each of its workers draws alone. Inner loops; everything else is to be small. Headers of src/ must not see that: they leave things out where size counts.
WEB_FAST := $(filter-out src/raster/texture.c src/filter/filtered.c src/filter/pingpong.c,$(filter src/kernels/% src/filter/% src/raster/% src/temporal/subframes.c src/timemask/timemask.c src/timemask/timemask_samples.c \
    src/display/pixel_format.c src/display/band.c src/geometry/light.c,$(LIB_SRC)))

# Loops over pixels that the compiler makes vectors of; nothing else gains.
WEB_VECTORS := $(filter src/filter/reconstruct.c src/filter/weights.c src/display/pixel_format.c src/display/band.c src/kernels/pixel_rows.c src/filter/tilemax.c src/frame.c,$(LIB_SRC))

WEB_FLAGS = --target=wasm32 -std=c11 -DSMEAR_WITH_OVERLAY=0 -DSMEAR_WITH_FOG=0 -DSMEAR_WITH_DISPLAY=0 -DSMEAR_WITH_WORKERS=0 -nostdinc -isystem tools/web/libc -isystem $(shell $(WEB_CC) -print-resource-dir)/include \
    -Iinclude -Isrc -I. -D_POSIX_C_SOURCE=200809L -U__OPTIMIZE_SIZE__ -mbulk-memory -fno-math-errno -ffp-contract=off -Wall -Wextra -MMD -MP
# What is compiled without vectors is the same in both.
web_objects = $(foreach source,$(WEB_SRC),$(WEB)/$(if $(filter $(source),$(WEB_VECTORS)),$(1),scalar)/$(source:.c=.o))

.PHONY: web
## page: web pages: build/web/index.html and game.html, for any static host or as they lie (needs clang-14, lld-14, llvm-14 and xz)
web: $(WEB)/index.html $(WEB)/game.html

$(WEB)/game.html: $(WEB)/pack $(addprefix platform/wasm/game.,html js) tools/web/unpack.js $(WEB)/unlzma.wasm $(WEB)/game.lzma
	$(call say,GEN)
	$(WEB)/pack page platform/wasm/game.html $@

# Another processor's program: make knows in a run of its own what it is made of.
$(WEB)/game.joined: $(WEB)/pack $(WEB)/game.wasm
$(WEB)/game.wasm: always
	$(MAKE) --no-print-directory TARGET=wasm PAGE=1 game-firmware
	@mkdir -p $(@D)
	cmp -s build/wasm/page/game.wasm $@ || cp build/wasm/page/game.wasm $@

$(WEB)/index.html: $(WEB)/pack tools/web/page.html $(addprefix tools/web/,style.css unpack.js begin.js) \
    $(addprefix $(WEB)/,unlzma.wasm modules.lzma kit.lzma texts.lzma)
	$(call say,GEN)
	$(WEB)/pack page tools/web/page.html $@

$(WEB)/modules.joined: $(WEB)/pack $(WEB)/scalar.wasm $(WEB)/simd.wasm
# app.js comes last: it begins.
WEB_TEXTS := tools/web/worker.js $(WEB)/methods.js $(addprefix tools/web/,settings.js engines.js frames.js screen.js controls.js chart.js models.js film.js app.js)
$(WEB)/texts.joined: $(WEB)/pack $(WEB)/chart.csv $(WEB_TEXTS)
$(WEB)/kit.joined: $(WEB)/pack $(KIT)
$(WEB)/%.joined:
	$(call say,GEN)
	$(WEB)/pack join $@ $(filter-out $<,$^)

$(WEB)/%.lzma: $(WEB)/%.joined
	$(call say,XZ)
	$(WEB_XZ) --format=lzma --lzma1=preset=9e,nice=273,pb=0 --stdout $< > $@.part
	mv $@.part $@

$(call web_objects,scalar) $(call web_objects,simd): WEB_OPT = -Oz
$(foreach v,scalar simd,$(WEB_FAST:%.c=$(WEB)/$(v)/%.o)): WEB_OPT = -O2
$(foreach v,scalar simd,$(patsubst %.c,$(WEB)/$(v)/%.o,$(wildcard tools/web/libc/*.c))): WEB_OPT = -Oz -fno-builtin
$(foreach v,scalar simd,$(WEB)/$(v)/tools/web/libc/libc.o): WEB_OPT = -O2 -fno-builtin
$(WEB_VECTORS:%.c=$(WEB)/simd/%.o): WEB_SIMD = -msimd128

$(WEB)/scalar/%.o: %.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(WEB_CC) $(WEB_FLAGS) $(WEB_OPT) -c -o $@ $<

$(WEB)/simd/%.o: %.c
	$(call say,CC,$<)
	@mkdir -p $(@D)
	$(WEB_CC) $(WEB_FLAGS) $(WEB_OPT) $(WEB_SIMD) -c -o $@ $<

# The stack lies first: an overflow is a trap, not another's data.
WEB_LDFLAGS := --no-entry --strip-all --gc-sections --stack-first -z stack-size=1048576 --max-memory=2147483648 -O2
$(WEB)/scalar.wasm: $(call web_objects,scalar)
	$(call say,LD)
	$(WEB_LD) $(WEB_LDFLAGS) -o $@ $^

$(WEB)/simd.wasm: $(call web_objects,simd)
	$(call say,LD)
	$(WEB_LD) $(WEB_LDFLAGS) -o $@ $^

$(WEB)/unlzma.wasm: tools/web/unlzma.c
	$(call say,CC)
	@mkdir -p $(@D)
	$(WEB_CC) --target=wasm32 -std=c11 -ffreestanding -Oz -Wall -Wextra -c -o $(WEB)/unlzma.o $<
	$(WEB_LD) --no-entry --strip-all --gc-sections -O2 -o $@ $(WEB)/unlzma.o

$(WEB)/pack: $(call objects,tools/web/pack.c $(addprefix tools/image/,deflate.c file.c inflate.c output.c))
	$(call say,LD)
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) -o $@ $^ -lm

# The list of methods, as the tools have it.
$(WEB)/methods: $(call objects,tools/web/methods.c tools/scenes/methods.c)
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) -o $@ $^

$(WEB)/methods.js: $(WEB)/methods
	$< > $@

# The chart's numbers: those of the last whole `make chart` where there is one, else those that are kept.
$(WEB)/chart.csv: $(or $(wildcard build/chart/chart.csv),tools/web/chart.csv) tools/web/chart.awk
	$(call say,GEN)
	@mkdir -p $(@D)
	$(if $(filter build/%,$<),awk -f tools/web/chart.awk $< > $@,cp $< $@)

# Its numbers on the host, under names that leave the host's alone.
WEB_NAMES := sin cos tan atan atan2 exp log pow powf fmod remainder frexp ldexp lround llround ilogb strtod snprintf vsnprintf printf \
    fprintf
$(WEB)/libc_test: tests/target/web_libc.c $(addprefix tools/web/libc/,math.c decimal.c printf.c decimal.h math.h)
	$(call say,CC)
	@mkdir -p $(WEB)/host
	for name in math decimal printf; do \
	    $(CC) -std=c11 -O1 -ffp-contract=off -fno-builtin -fno-math-errno -isystem tools/web/libc -c -o $(WEB)/host/$$name.o \
	        tools/web/libc/$$name.c && \
	    objcopy $(foreach n,$(WEB_NAMES),--redefine-sym $(n)=web_$(n)) $(WEB)/host/$$name.o || exit 1; done
	$(CC) -std=c11 -O1 -fno-builtin -Wall -Wextra -o $@ $< $(addprefix $(WEB)/host/,math.o decimal.o printf.o) -lm
