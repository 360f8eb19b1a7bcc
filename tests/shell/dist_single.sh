#!/bin/sh
# SPDX-License-Identifier: MIT
# dist_single.sh: the one-file form that `make dist` wrote compiles without a warning by all compilers of this machine for
# Cortex-M, RISC-V and x86, in all standards of C and C++, with and without GCC's extensions, and draws the golden frames
# wherever it can run. Compilers that are not installed are named.
set -u
. "$(dirname "$0")/lib.sh"
base=$PWD/build/dist-single-test
rm -rf "$base"
mkdir -p "$base"
single=$PWD/build/dist/single
strict="-Wall -Wextra -Wpedantic -Werror"
tab=$(printf '\t')

# Jobs are independent of each other, and run as many at once as there are cores.
# job NAME COMMAND...
job() {
    name=$1
    shift
    echo "$name$tab$*" >>"$base/jobs"
}

here() {
    command -v "${1%% *}" >/dev/null 2>&1 && return 0
    case " $absent " in *" ${1%% *} "*) ;; *) absent="$absent ${1%% *}" ;; esac
    return 1
}
absent=""

# ---------------------------------------------------------------------- code

# generates NAME COMPILER OPTIONS: warnings of the optimizer, and assembly
generates() {
    ! here "$2" || job "code: $1 $3" "$2 $3 $strict -c -o $base/NUMBER.o $single/smear.c"
}
generates "clang for cortex-m0plus" "clang-14 --target=thumbv6m-none-eabi -mcpu=cortex-m0plus -std=c99 -ffreestanding" -O3
# For size, where helpers are functions: a file of its own must not call what it defines under another name. For debuggers:
# registers are few without optimization.
for level in -O3 -O2 -Os -O1 -Og -O0; do
    generates "gcc for cortex-m0plus" "arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -std=c99 -ffreestanding" $level
done
generates "g++ for cortex-m0plus" "arm-none-eabi-g++ -mcpu=cortex-m0plus -mthumb -x c++ -std=c++11 -ffreestanding" -O2
generates "gcc for cortex-m4" "arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -std=c11 -ffreestanding" -O2
generates "gcc for rv32imc" "riscv64-unknown-elf-gcc -march=rv32imc -mabi=ilp32 -std=c11 -ffreestanding" -O2

# ---------------------------------------------------------------------- words

# reads NAME COMPILER STANDARDS: one command for all standards of one compiler and core
reads() {
    here "$2" || return 0
    command=true
    for standard in $3; do
        case $standard in *++*) language="-x c++" ;; *) language="-x c" ;; esac
        command="$command && $2 $language -std=$standard -O2 $strict -fsyntax-only $single/smear.c"
    done
    job "words: $1 $3" "$command"
}
all="c99 c11 c17 c2x c++11 c++14 c++17 c++20"
ends="c99 c2x c++11 c++20"
reads gcc gcc "$all"
reads clang clang-14 "$all"
if echo '#include <stdint.h>' | gcc -m32 -fsyntax-only -x c - 2>/dev/null; then
    reads "gcc -m32" "gcc -m32" "$ends"
    reads "clang -m32" "clang-14 -m32" "$ends"
else
    absent="$absent libc6-dev-i386"
fi
# Cores differ in what is chosen for them, not in words of a language.
for core in cortex-m0 cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33; do
    reads "gcc for $core" "arm-none-eabi-gcc -mcpu=$core -mthumb -ffreestanding" "c99 c++20"
    reads "clang for $core" "clang-14 --target=arm-none-eabi -mcpu=$core -mthumb -ffreestanding" "c99 c++20"
done
reads "gcc for rv32imc" "riscv64-unknown-elf-gcc -march=rv32imc -mabi=ilp32 -ffreestanding" "c99 c++20"
reads "clang for rv32imc" "clang-14 --target=riscv32-none-elf -march=rv32imc -ffreestanding" "c99 c++20"

# Without GCC's extensions, pedantic warnings are errors. Clang can be a compiler that has none of GCC's words, as Microsoft's
# is; of that one's library only the two functions are needed.
for plain in gcc clang-14; do
    reads "$plain without extensions" "$plain -DSMEAR_GNU=0 -pedantic-errors" "$ends"
done
mkdir -p "$base/library"
echo '#include <stddef.h>' >"$base/library/string.h"
echo 'extern "C" { void *memcpy(void *, const void *, size_t); void *memset(void *, int, size_t); }' |
    tee "$base/library/string_cxx.h" | sed 's/extern "C" { \(.*\) }/\1/' >>"$base/library/string.h"
reads "a compiler like Microsoft's" \
    "clang-14 --target=x86_64-pc-windows-msvc -fms-compatibility -ffreestanding -isystem $base/library" "c11 c17"

no_extensions() {
    gcc -std=c99 -E -P -DSMEAR_GNU=0 "$single/smear.c" | sed -n '/smear_plain_ctz/,$p' | sed 's/__builtin_offsetof//g' >"$base/plain.i"
    [ -s "$base/plain.i" ] && ! grep -nE '__builtin|__attribute__|__asm|__atomic|__sync|vector_size|_mm_' "$base/plain.i"
}

# ---------------------------------------------------------------------- pictures

# draws NAME COMPILER-OF-THE-LIBRARY [COMPILER-OF-THE-PROGRAM [RUNNER]]
programs="tests/target/target_golden.c platform/play.c platform/print.c platform/host/platform.c build/tapes/golden.c"
draws() {
    program=${3:-${CC:-cc}}
    here "$2" && here "$program" && { [ -z "${4:-}" ] || here "$4"; } || return 0
    job "pictures: $1" "$2 -I$single -c -o $base/NUMBER.o $single/smear.c && \
        $program -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -I$single -I. -o $base/NUMBER $programs $base/NUMBER.o && ${4:-} $base/NUMBER"
}
draws "gcc, C99" "gcc -std=c99 -O2 $strict -Wconversion"
draws "gcc, C23" "gcc -std=c2x -O0 $strict -Wconversion"
draws "g++, C++11" "g++ -x c++ -std=c++11 -O1 $strict"
draws "g++, C++20" "g++ -x c++ -std=c++20 -O0 $strict"
draws "clang, C11" "clang-14 -std=c11 -O2 $strict"
draws "gcc without extensions" "gcc -DSMEAR_GNU=0 -std=c99 -pedantic-errors -fno-strict-aliasing -O1 $strict"
draws "tcc" "tcc -Wall -Werror" "tcc"
! echo 'int main(void) { return 0; }' | gcc -m32 -x c -o "$base/program" - 2>/dev/null ||
    draws "gcc -m32" "gcc -m32 -std=c99 -O1 $strict" "gcc -m32"
draws "gcc for ARM" "arm-linux-gnueabihf-gcc -std=c99 -O1 $strict" "arm-linux-gnueabihf-gcc -static" qemu-arm-static
job "switches" "gcc -std=c99 -O1 $strict -DSMEAR_WITH_ALL=0 -DSMEAR_WITH_RGB565=1 -c -o $base/NUMBER.o $single/smear.c"

# ---------------------------------------------------------------------- all of it

# The longest first, those of pictures last but before words: what runs alone at the end is short.
number=0
while IFS=$tab read -r name command; do
    number=$((number + 1))
    echo "$name" >"$base/$number.name"
    echo "$command" | sed "s|NUMBER|$number|g" >"$base/$number.sh"
    echo "$number"
done <"$base/jobs" >"$base/numbers"
xargs -P "$(getconf _NPROCESSORS_ONLN)" -I{} sh -c "sh $base/{}.sh >$base/{}.log 2>&1; echo \$? >$base/{}.status" <"$base/numbers"

job_done() {
    cat "$base/$1.log"
    [ "$(cat "$base/$1.status")" = 0 ]
}
while read -r number; do
    claim "$(cat "$base/$number.name")" job_done "$number"
done <"$base/numbers"
claim "no extension is left without extensions" no_extensions
claim "smear.h as C99" gcc -std=c99 $strict -fsyntax-only -x c "$single/smear.h"
claim "smear.h as C++11" g++ -std=c++11 $strict -fsyntax-only -x c++ "$single/smear.h"
claim "smear.hpp beside smear.h" g++ -std=c++11 $strict -fsyntax-only -I"$single" tests/examples/orbit.cpp
[ -z "$absent" ] || echo "not run without:$absent"
finish
