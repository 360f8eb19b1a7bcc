# SPDX-License-Identifier: MIT
# Cortex-M0+ with the memory of an RP2040, of which programs are held to 150 kB, for a panel of 240x240 pixels. Tests
# run on QEMU's M0, benchmarks on its M3, which executes the same code and has a 32-bit timer.
CORE   := -mcpu=cortex-m0plus -mthumb
BOARD  := -M microbit -global nrf51-soc.flash-size=2097152 -global nrf51-soc.sram-size=262144
LAYOUT := rp2040-150k.ld
include platform/cortexm/cortexm.mk

# What the demo has no use for takes memory of strips. Golden frames want it: cortex-m0plus draws them, with the same
# instructions.
CFLAGS       += -DSMEAR_WITH_LINEAR=0 -DSMEAR_WITH_TIMEMASK=0
TARGET_TESTS :=

DEMO_SCREEN := pico
DEMO_LOOPS  := pico:1
