# SPDX-License-Identifier: MIT
# Cortex-M4 without its floating point unit: any use of floating point would show as a call.
CORE        := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
BOARD       := -M mps2-an386
LAYOUT      := mps2.ld
BENCH_BOARD := -M mps2-an386
include platform/cortexm/cortexm.mk
