# SPDX-License-Identifier: MIT
# Stellaris LM3S6965 evaluation board: Cortex-M3, 256 kB of flash, 64 kB of RAM, an OLED panel of
# 128x64 pixels in 16 greys. Programs are held to 48 kB of RAM: 16 kB are left to the application.
CORE           := -mcpu=cortex-m3 -mthumb
BOARD          := -M lm3s6965evb
LAYOUT         := lm3s6965evb-48k.ld
include platform/cortexm/cortexm.mk

# What the panel has no use for takes memory of strips: the rest goes to triangles. Golden frames want it: cortex-m3 draws
# them, with the same instructions.
CFLAGS       += -DSMEAR_WITH_LINEAR=0 -DSMEAR_WITH_TIMEMASK=0 -DSMEAR_WITH_CURVES=0 -DSMEAR_WITH_OVERLAY=0 -DSMEAR_WITH_FOG=0 \
                -DSMEAR_WITH_FILTERS=0 -DSMEAR_WITH_LIGHTS=0
TARGET_TESTS :=

DISPLAY_SRC := platform/lm3s6965evb/display.c
DEMO_SCREEN := oled

DEMO_LOOPS  := oled:1
SHOW = $(SCREENSHOT)
export SHOT        := platform/lm3s6965evb/shot.sh
export SHOT_SCREEN := oled
export SHOT_FRAMES := 8 45
export SHOT_ZOOM   := 4
export SHOT_KEY    := ctrl
