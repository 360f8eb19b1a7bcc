#!/bin/sh
# SPDX-License-Identifier: MIT
# dist_single.sh FOLDER [BUILD]: the one-file form, smear.c and its headers in FOLDER, compiles without a warning by all compilers of
# this machine for Cortex-M, RISC-V, Xtensa and x86, in all standards of C and C++, with and without GCC's extensions, and draws the
# golden frames wherever it can run. Compilers that are not installed are named. BUILD: golden frames by that one of one_file.sh
# alone.
set -u
. "$(dirname "$0")/lib.sh"
base=$PWD/build/dist-single-test
rm -rf "$base"
mkdir -p "$base"
single=$PWD/$1
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

# The program that plays golden frames, compiled once for each compiler of programs.
# program OBJECTS COMPILER
programs="tests/target/target_golden.c platform/play.c platform/print.c platform/host/platform.c build/tapes/golden.c"
program() {
    mkdir -p "$base/$1"
    for source in $programs; do
        # shellcheck disable=SC2086
        $2 -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -I"$single" -I. -c -o "$base/$1/$(echo "$source" | tr / _).o" "$source" || exit 1
    done
}

if [ $# -gt 1 ]; then
    program host "${CC:-cc}"
    draws_one() { sh tests/shell/one_file.sh "$1" "$single/smear.c" "$base/one.o" && ${CC:-cc} -o "$base/one" "$base"/host/*.o "$base/one.o" && "$base/one"; }
    claim "pictures: $2" draws_one "$2"
    finish
fi

# ---------------------------------------------------------------------- code

# generates NAME COMPILER OPTIONS: warnings of the optimizer, and assembly
generates() {
    ! here "$2" || job "code: $1 $3" "$2 $3 $strict -c -o $base/NUMBER.o $single/smear.c"
}
generates "clang for cortex-m0plus" "clang-14 --target=thumbv6m-none-eabi -mcpu=cortex-m0plus -std=c99 -ffreestanding" -O3
# For size, where helpers are functions: a file of its own must not call what it defines under another name. For debuggers:
# registers are few without optimization. C++ takes the level that is left: behind the language it is the same compiler.
for level in -O3 -O2 -Os -Og -O0; do
    generates "gcc for cortex-m0plus" "arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -std=c99 -ffreestanding" $level
done
generates "g++ for cortex-m0plus" "arm-none-eabi-g++ -mcpu=cortex-m0plus -mthumb -x c++ -std=c++11 -ffreestanding" -O1
generates "gcc for cortex-m4" "arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -std=c11 -ffreestanding" -O2
generates "gcc" "gcc -std=c99 -Wconversion" -O2
# No line is this core's own: what -O2 warns of, Cortex-M0+ and M4 have shown.
generates "gcc for rv32imc" "riscv64-unknown-elf-gcc -march=rv32imc -mabi=ilp32 -std=c11 -ffreestanding" -O1
# Xtensa, the ESP32's kind of core: that of an ESP8266 is what Debian has a compiler for (gcc-xtensa-lx106).
generates "gcc for xtensa" "xtensa-lx106-elf-gcc -std=c11 -ffreestanding" -Os

# ---------------------------------------------------------------------- words

# reads NAME COMPILER STANDARDS: one command for all standards of one compiler and core, but those in which `code` or `pictures`
# compile it with these warnings
reads() {
    here "$2" || return 0
    command=true
    for standard in $3; do
        case $standard in *++*) language="-x c++" ;; *) language="-x c" ;; esac
        command="$command && $2 $language -std=$standard -O2 $strict -fsyntax-only $single/smear.c"
    done
    job "words: $1 $3" "$command"
}
ends="c99 c2x c++11 c++20"
reads gcc gcc "c11 c17 c++14 c++17"
reads clang clang-14 "c99 c17 c2x c++11 c++14 c++17 c++20"
if echo '#include <stdint.h>' | gcc -m32 -fsyntax-only -x c - 2>/dev/null; then
    reads "gcc -m32" "gcc -m32" "c2x c++11 c++20"
    reads "clang -m32" "clang-14 -m32" "$ends"
else
    absent="$absent libc6-dev-i386"
fi
# Cores differ in what is chosen for them, not in words of a language.
for core in cortex-m0 cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33; do
    case $core in cortex-m0plus) standards="c++20" ;; *) standards="c99 c++20" ;; esac
    reads "gcc for $core" "arm-none-eabi-gcc -mcpu=$core -mthumb -ffreestanding" "$standards"
    reads "clang for $core" "clang-14 --target=arm-none-eabi -mcpu=$core -mthumb -ffreestanding" "c99 c++20"
done
reads "gcc for rv32imc" "riscv64-unknown-elf-gcc -march=rv32imc -mabi=ilp32 -ffreestanding" "c99 c++20"
reads "clang for rv32imc" "clang-14 --target=riscv32-none-elf -march=rv32imc -ffreestanding" "c99 c++20"

# Without GCC's extensions, pedantic warnings are errors. Clang can be a compiler that has none of GCC's words, as Microsoft's
# is; of that one's library only the two functions are needed.
reads "gcc without extensions" "gcc -DSMEAR_GNU=0 -pedantic-errors" "c2x c++11 c++20"
reads "clang-14 without extensions" "clang-14 -DSMEAR_GNU=0 -pedantic-errors" "$ends"
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

# draws NAME COMPILE-COMMAND [COMPILER-OF-THE-PROGRAM OBJECTS-OF-THE-PROGRAM [RUNNER]]: COMPILE is what one_file.sh builds, or
# a compiler and its options
draws() {
    linker=${3:-${CC:-cc}} objects=$base/${4:-host}
    here "$linker" && { [ -z "${5:-}" ] || here "$5"; } || return 0
    case $2 in
    *" "*) here "$2" || return 0; compile="$2 -I$single -c -o $base/NUMBER.o $single/smear.c" ;;
    *) compile="sh tests/shell/one_file.sh $2 $single/smear.c $base/NUMBER.o" ;;
    esac
    [ -d "$objects" ] || program "${4:-host}" "$linker"
    job "pictures: $1" "$compile && $linker -o $base/NUMBER $objects/*.o $base/NUMBER.o && ${5:-} $base/NUMBER"
}
draws "gcc, C99" gcc-O3
draws "gcc, C23" gcc-O0
draws "g++, C++11" gxx-O1
draws "g++, C++20" "g++ -x c++ -std=c++20 -O0 $strict"
! here clang-14 || draws "clang, C11" clang-O2
draws "gcc without extensions" plain
draws "tcc" "tcc -Wall -Werror" "tcc" tcc
! echo 'int main(void) { return 0; }' | gcc -m32 -x c -o "$base/program" - 2>/dev/null ||
    draws "gcc -m32" m32 "gcc -m32" m32
draws "gcc for ARM" "arm-linux-gnueabihf-gcc -std=c99 -O0 $strict" "arm-linux-gnueabihf-gcc -static" arm qemu-arm-static
draws "gcc for ARM, Cortex-M4's assembly" armv7em "arm-linux-gnueabihf-gcc -static" arm qemu-arm-static
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
