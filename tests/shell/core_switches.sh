#!/bin/sh
# SPDX-License-Identifier: MIT
# core_switches.sh
# Prints the switches (smear_config.h) that leave the renderer and its filter: every surface and format, SMEAR_NONE,
# SMEAR_ACCUMULATE and SMEAR_RECONSTRUCT.
for name in SUBFRAMES FILTERS LAYERS MODEL CURVES SCALES VIEWS BOUNDS FOG OVERLAY SKY LIGHTS DISPLAY DEBUG; do
    printf ' -DSMEAR_WITH_%s=0' "$name"
done
