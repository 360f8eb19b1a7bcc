# SPDX-License-Identifier: MIT
# Linux on ARMv6: a Pi Zero and a Pi 1, whatever the ABI of its programs. Debian's libraries with floating point in registers
# want ARMv7, so this is linked with those without. Statically linked; shown as on TARGET=linux.
# Packages: gcc-arm-linux-gnueabi libc6-dev-armel-cross qemu-user-static
CROSS := arm-linux-gnueabi
QEMU  := qemu-arm-static -cpu arm1176
CORE  := -mcpu=arm1176jzf-s -marm -mfloat-abi=soft
include platform/linux/cross.mk
