# SPDX-License-Identifier: MIT
# Cortex-M7 without its floating point unit. QEMU counts instructions; the core runs up to two at once.
CORE        := -mcpu=cortex-m7 -mthumb -mfloat-abi=soft
BOARD       := -M mps2-an500
LAYOUT      := mps2.ld
BENCH_BOARD := -M mps2-an500
include platform/cortexm/cortexm.mk
