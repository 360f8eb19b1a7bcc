#!/bin/sh
# SPDX-License-Identifier: MIT
# check.sh - what a change needs, in under three minutes on two cores; `make check` calls it. The host's suites but the
# three longest, and golden frames and units under sanitizers with every promise checked (BRIEF in the Makefile says with what
# less than in all.sh). They are in groups, of which two run beside each other. all.sh runs the rest.
set -u
. "$(dirname "$0")/shell/suites.sh"
longest=" accuracy blur failures "

# ---------------------------------------------------------------------- groups

host() {
    suite "$1" env SMEAR_ASSETS="$assets" build/host/run --suite "$1"
}

# Units are suites of the host's.
golden() {
    suite golden-host $make -s TARGET=host TARGET_TESTS=golden target-test
}

sanitized() {
    suite golden-sanitized $make -s $jobs SAN=1 CHECK=1 BRIEF=1 target-test
}

# That nothing is called that a small core lacks shows at any level of optimization.
symbols() {
    if needs arm-none-eabi-gcc "gcc-arm-none-eabi"; then
        suite symbols-cortex-m0plus $make -s TARGET=cortex-m0plus OPT=-O0 BUILD=build/cortex-m0plus-O0 symbols-test
    fi
}

format() {
    if needs clang-format-14 "clang-format-14"; then
        suite format $make -s format-check
    fi
}

# ---------------------------------------------------------------------- all of them

find_assets
suite includes $make -s layers
suite house $make -s house
# What groups share is built before.
suite build $make -s $jobs all build/host/run build/smear-demo build/host/target_golden build/demo/props.c
suites=
for name in $($make -s print-suites); do
    case $longest in
    *" $name "*) ;;
    *) suites="$suites host=$name" ;;
    esac
done
# The longest first.
# shellcheck disable=SC2086
lanes sanitized documents symbols format golden $suites
add_up
