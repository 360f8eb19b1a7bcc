# SPDX-License-Identifier: MIT
# Cortex-M33 without its floating point unit, in the secure state it starts in. Its board's timer
# lies elsewhere and ticks every 50 ns.
CORE         := -mcpu=cortex-m33 -mthumb -mfloat-abi=soft
BOARD        := -M mps2-an505
LAYOUT       := an505.ld
BENCH_BOARD  := -M mps2-an505
BENCH_LAYOUT := an505.ld
include platform/cortexm/cortexm.mk

$(BUILD)/platform/cortexm/platform.o: CFLAGS += -DTIMER_ADDRESS=0x50000000u -DTICK_NS=50
