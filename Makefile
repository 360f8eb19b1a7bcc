# SPDX-License-Identifier: MIT
# One Makefile, no recursion. `make help` lists what it can do.

TARGET ?= host
BUILD  := build/$(TARGET)

.DEFAULT_GOAL := all

CFLAGS_COMMON := -std=c11 -g -Wall -Wextra -Wconversion -Wshadow -Iinclude -MMD -MP
OPT    ?= -O2
CFLAGS := $(CFLAGS_COMMON) $(OPT)

ifeq ($(SAN),1)
BUILD  := $(BUILD)-san
CFLAGS += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS += -fsanitize=address,undefined
endif
ifeq ($(CHECK),1)
BUILD  := $(BUILD)-check
CFLAGS += -DSMEAR_CHECK=1
endif

include platform/$(TARGET)/target.mk

# The library, bottom layer first: a file includes only headers above its own line. `make layers` checks it.
LAYERS := base fixed tables fixmath pixel arena matrix transform light clip geometry assemble texture \
          target setup velocity span raster window tilemax blur blur_uniform blur_reconstruct convert jobs context frame smear
LIB_SRC := $(filter $(LAYERS:%=src/%.c),$(wildcard src/*.c))

IMAGE_SRC := $(wildcard tools/image/*.c)
MODEL_SRC := $(wildcard tools/model/*.c)
SCENE_SRC := $(wildcard tools/scenes/*.c)
CLI_SRC   := $(wildcard tools/cli/*.c)
TOOL_SRC  := $(IMAGE_SRC) $(MODEL_SRC) $(SCENE_SRC)

LIB := $(BUILD)/libsmear.a

objects = $(1:%.c=$(BUILD)/%.o)

.PHONY: all
## the program build/smear and the library
all: build/smear

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -c -o $@ $<

$(LIB): $(call objects,$(LIB_SRC))
	@rm -f $@
	$(AR) rcs $@ $^

build/smear: $(call objects,$(CLI_SRC) $(TOOL_SRC)) $(LIB)
	$(CC) $(LDFLAGS) -o $@ $^ -lm -lpthread

-include $(shell find build -name '*.d' 2>/dev/null)
