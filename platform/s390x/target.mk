# SPDX-License-Identifier: MIT
# Big-endian Linux in QEMU's user mode.
# Packages: gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user-static
CC    := s390x-linux-gnu-gcc
AR    := s390x-linux-gnu-ar
NEEDS := s390x-linux-gnu-gcc qemu-s390x-static

CFLAGS  += -D_POSIX_C_SOURCE=200809L
LDFLAGS += -static

PLATFORM_SRC := platform/host/platform.c

RUN       := timeout 600 qemu-s390x-static
RUN_BENCH := $(RUN)
