#!/bin/sh
# SPDX-License-Identifier: MIT
# check.sh - what a change needs, in under three minutes on two cores; `make check` calls it. The host's suites but the
# three longest, and golden frames and units under sanitizers with every promise checked. all.sh runs the rest.
set -u
. "$(dirname "$0")/shell/suites.sh"
longest=" accuracy blur failures "

find_assets
suite includes $make -s layers
suite house $make -s house
if needs clang-format-14 "clang-format-14"; then
    suite format $make -s format-check
fi
suite build $make -s $jobs all build/host/run
documents
for name in $($make -s print-suites); do
    case $longest in
    *" $name "*) ;;
    *) suite "$name" env SMEAR_ASSETS="$assets" build/host/run --suite "$name" ;;
    esac
done
suite golden-host $make -s $jobs TARGET=host target-test
suite golden-sanitized $make -s $jobs SAN=1 CHECK=1 target-test
if needs arm-none-eabi-gcc "gcc-arm-none-eabi"; then
    suite symbols-cortex-m0plus $make -s $jobs TARGET=cortex-m0plus symbols-test
fi
add_up
