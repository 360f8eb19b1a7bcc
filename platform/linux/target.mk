# SPDX-License-Identifier: MIT
# Linux without a window system. The display is that of desktops (platform/host/desktop_display.c), on DRM
# with page flips or on the framebuffer device; tests boot a kernel with the demo as only process.
# Packages: qemu-system-x86; boot.sh fetches the distribution's kernel
CC ?= cc
AR ?= ar

# The library and tools are those of this machine's other programs.
OWN := $(if $(SAN)$(CHECK),%,platform/% tests/%)

CFLAGS  += -D_POSIX_C_SOURCE=200809L
LDFLAGS += -static
LDLIBS  += -lm

PLATFORM_SRC := platform/host/platform.c platform/linux/boot.c

RUN       :=
RUN_BENCH :=
RUN_NEEDS := $(BUILD)/mkcpio

DISPLAY_SRC  = $(filter-out $(PLATFORM_SRC),$(HOST_DISPLAY_SRC))
DEMO_SCREEN := linux
DEMO_LOOPS  := linux:18

export SHOT        := sh platform/linux/boot.sh
export SHOT_SCREEN := linux
export SHOT_FRAMES := fbdev:45 virtio:8
export SHOT_ZOOM   := 1
