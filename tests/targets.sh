#!/bin/sh
# SPDX-License-Identifier: MIT
# targets.sh [TARGET...]
# Unit tests and golden frames on every target whose tools are installed, then the checks of
# target_objects.sh. A target without its tools is named and skipped; REQUIRE_ALL=1 makes that a
# failure.
set -u
[ $# -gt 0 ] || set -- host cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33 gba rv32imc s390x
make=${MAKE:-make}
failed= skipped= passed=
for target in "$@"; do
    missing=
    for tool in $(sed -n 's/^NEEDS *:= *//p' "platform/$target/target.mk" \
                      "$(sed -n 's/^include *//p' "platform/$target/target.mk" | grep . ||
                         echo /dev/null)"); do
        command -v "$tool" >/dev/null || missing="$missing $tool"
    done
    if [ -n "$missing" ]; then
        echo "targets.sh: $target skipped, missing:$missing"
        skipped="$skipped $target"
        continue
    fi
    echo "== $target"
    if $make --no-print-directory -s TARGET="$target" target-test; then
        passed="$passed $target"
    else
        failed="$failed $target"
    fi
done
if command -v arm-none-eabi-gcc >/dev/null; then
    echo "== objects for cortex-m0plus"
    if sh tests/target_objects.sh build/objects; then
        passed="$passed objects"
    else
        failed="$failed objects"
    fi
else
    echo "targets.sh: objects skipped, missing: arm-none-eabi-gcc"
    skipped="$skipped objects"
fi
echo "targets: passed:${passed:- none}; failed:${failed:- none}; skipped:${skipped:- none}"
[ -z "$failed" ] && [ -n "$passed" ] && { [ -z "$skipped" ] || [ "${REQUIRE_ALL:-0}" = 0 ]; }
