#!/bin/sh
# SPDX-License-Identifier: MIT
# coverage.sh BUILD SUITES - draws golden frames and cases of the generator and runs suites that count branches of src/ (`make coverage`),
# and compares what is missed with tests/coverage.txt.
set -u
build=$1
suites=$2
find "$build" -name '*.gcda' -exec rm -f {} +
# Beside each other: counts are added up as programs end. The other suites judge what these do with -O2, and draw for longer.
export SMEAR_ASSETS=
"$build/target_golden" >"$build/golden.log" 2>&1
{
    "$build/frames" valid 1 2000 && "$build/frames" wild 1 4000 && "$build/frames" threads 1 300 && "$build/frames" parts 1 590 &&
        "$build/frames" many 1 20 || echo "frames fail"
} >"$build/frames.log" 2>&1 &
for suite in $suites; do
    "$build/run" --suite "$suite" >"$build/$suite.log" 2>&1
done
wait
if grep -q fail "$build/frames.log"; then
    cat "$build/frames.log"
    exit 1
fi
find "$build/src" -name '*.gcda' | while read -r counts; do
    gcov -t -b -c "$counts"
done >"$build/gcov.txt" 2>/dev/null
awk -v least=95 -v spare=100 -f tests/branches.awk tests/coverage.txt "$build/gcov.txt"
