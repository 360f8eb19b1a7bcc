# SPDX-License-Identifier: MIT
# Cortex-M3.
CORE   := -mcpu=cortex-m3 -mthumb
BOARD  := -M mps2-an385
LAYOUT := mps2.ld
include platform/cortexm/cortexm.mk

SMALL_LAYOUTS   := lm3s6965evb
RUN_lm3s6965evb := platform/cortexm/run.sh -M lm3s6965evb
