# SPDX-License-Identifier: MIT
# This machine.
CC ?= cc
AR ?= ar

CFLAGS += -D_POSIX_C_SOURCE=200809L

SIZE     := size
SHOWN    := -screen

GAME_CHECKED := pico gba pi-640 linux page

PLATFORM_SRC := platform/host/platform.c

RUN       :=
RUN_BENCH :=
