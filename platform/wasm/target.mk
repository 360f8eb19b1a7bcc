# SPDX-License-Identifier: MIT
# WebAssembly, without a browser's or another system's C library: node runs the tests, and build/web/game.html is the game in a
# page (game.mk, platform/wasm/game.html).
# Packages: clang-14 lld-14 llvm-14 nodejs
CC      := clang-14
AR      := llvm-ar-14
NM      := llvm-nm-14
EXE     := .wasm
NEEDS   := clang-14 wasm-ld-14 node

# string.h alone is taken from tools/web/libc; memory.c has what it declares.
CFLAGS  += --target=wasm32 -ffreestanding -mbulk-memory -ffunction-sections -fdata-sections -isystem tools/web/libc -Wno-sign-conversion
# The stack lies first: an overflow is a trap, not another's data.
LDFLAGS += --target=wasm32 -nostdlib -Wl,--no-entry -Wl,--gc-sections -Wl,--strip-all -Wl,--stack-first -Wl,-z,stack-size=1048576 -Wl,-O2 \
           -Wl,--export-if-defined=game_open -Wl,--export-if-defined=game_turn

# PAGE=1: the game alone, as the page has it.
ifeq ($(PAGE),1)
BUILD  := $(BUILD)/page
CFLAGS += -Os -DSMEAR_WITH_ALL=0 $(foreach switch,SUBFRAMES OVERLAY RGB BOUNDS SKY,-DSMEAR_WITH_$(switch)=1)
# What moves cars, and what is done once a frame or draw, takes a small part of a frame.
$(BUILD)/platform/game/%.o: CFLAGS += -Oz
$(addprefix $(BUILD)/src/,$(addsuffix .o,smear validate layout frame draws draws_prepare geometry/matrix geometry/shot \
    geometry/batch_clip methods/temporal methods/along_lines temporal/row_space temporal/tile_method overlay/overlay)): CFLAGS += -Oz
endif

PLATFORM_SRC := platform/wasm/platform.c $(addprefix platform/common/,arguments.c memory.c)

RUN       := node platform/wasm/run.mjs
RUN_BENCH := $(RUN)

DISPLAY_SRC  := platform/wasm/display.c
SOUND_SRC    := platform/wasm/sound.c
DEMO_SCREEN  := linux
GAME_SCREEN  := page
GAME_CHECKED := page $(if $(PAGE),,linux pico gba)
