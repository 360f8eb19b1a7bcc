# SPDX-License-Identifier: MIT
# Linux on ARMv8 with 64 bits: handhelds (RG35XX H, RG353, RG351), a Pi 3 and later. Statically linked; shown as on TARGET=linux.
# Packages: gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static
CROSS := aarch64-linux-gnu
QEMU  := qemu-aarch64-static -cpu cortex-a53
CORE  := -march=armv8-a
include platform/linux/cross.mk
