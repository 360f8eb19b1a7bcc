# SPDX-License-Identifier: MIT
# Linux on ARMv7 with NEON: handhelds (Miyoo Mini, RG35XX), a Pi 2 and later with 32 bits. Statically linked; shown as on TARGET=linux.
# Packages: gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user-static
CROSS := arm-linux-gnueabihf
QEMU  := qemu-arm-static -cpu cortex-a7
CORE  := -march=armv7-a -mfpu=neon -mfloat-abi=hard
include platform/linux/cross.mk
