#!/bin/sh
# SPDX-License-Identifier: MIT
# one_file.sh BUILD SMEAR.C OBJECT
# Compiles the one-file form as one of these builds, which differ in compiler, language, optimization, width of a word and what
# the code is told of the core. The same objects draw golden frames (dist_single.sh) and the generator's (tests/fuzz/fuzz.mk):
# who comes first compiles for both.
set -u
build=$1 single=$2 object=$3
strict="-Wall -Wextra -Wpedantic -Werror"
case $build in
# What overflows ends the program.
gcc-O0) compile="gcc -std=c2x -O0 -ftrapv -Wconversion" ;;
# A picture that depends on a variable that nobody wrote, or that is out of scope, is another one.
gxx-O1) compile="g++ -x c++ -std=c++11 -O1 -ftrivial-auto-var-init=pattern" ;;
# There, GCC takes what all lanes of a loop write for unwritten; -O2 does not, by which this machine's programs are compiled.
gcc-O3) compile="gcc -std=c99 -O3 -Wconversion -Wno-maybe-uninitialized" ;;
clang-O2) compile="clang-14 -std=c11 -O2" ;;
m32) compile="gcc -m32 -std=c99 -O2" ;;
# Neither a compiler's extensions nor vectors.
plain) compile="${CC:-cc} -DSMEAR_GNU=0 -std=c99 -pedantic-errors -fno-strict-aliasing -O1" ;;
# Assembly for Cortex-M4 in a program for Linux. (Code for any address leaves it too few registers.)
armv7em)
    compile="arm-linux-gnueabihf-gcc -mthumb -fno-pic -march=armv7ve+fp -std=c99 -O2 -DSMEAR_VECTORS=0 -DSMEAR_ASM_ARMV7EM=1"
    ;;
*) echo "one_file.sh: no build $build" >&2; exit 2 ;;
esac
SMEAR_OBJECTS=${SMEAR_OBJECTS:-build/test/objects}
export SMEAR_OBJECTS
mkdir -p "${object%/*}"
# shellcheck disable=SC2086
exec sh tests/shell/launch_cached.sh $compile $strict -o "$object" -c "$single"
