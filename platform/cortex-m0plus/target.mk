# SPDX-License-Identifier: MIT
# Cortex-M0+: no 32 x 32 -> 64 multiply, no division, no leading zero count. Tests run on QEMU's M0,
# which faults on unaligned access and on ARMv7-M instructions; benchmarks on its M3, which executes
# the same code and has a 32-bit timer.
CORE   := -mcpu=cortex-m0plus -mthumb
BOARD  := -M microbit -global nrf51-soc.flash-size=2097152 -global nrf51-soc.sram-size=327680
LAYOUT := m0-large.ld
include platform/cortexm/cortexm.mk

SMALL_LAYOUTS    := lm3s6965evb
RUN_lm3s6965evb  := platform/cortexm/run.sh -M lm3s6965evb -cpu cortex-m0

DEMO_LOOPS := oled:6 gba:6 pico:12
