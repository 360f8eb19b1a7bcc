#!/bin/sh
# SPDX-License-Identifier: MIT
# target_objects.sh BUILD-FOLDER [SOURCE...]
# Compiles the library (src/*.c and src/*/*.c, or the sources given) for Cortex-M0+ at -Os and
# checks the objects: nothing undefined but what a freestanding target always has, so neither
# floating point nor 64-bit division; no writable data. Compiles them for the host, too: general
# registers only, no header but the compiler's own. Prints the size of code and tables.
# SWITCHES="-DSMEAR_WITH_...=0" leaves out what smear_config.h lets one leave out; counted is what a program that calls
# every function of the interface would link. CODE_LIMIT=BYTES makes larger code fail; LIST=0 prints no files.
set -u
. "$(dirname "$0")/lib.sh"
if [ $# -lt 1 ]; then
    echo "usage: target_objects.sh BUILD-FOLDER [SOURCE...]" >&2
    exit 2
fi
out=$1
shift
if [ $# -eq 0 ]; then
    for file in src/*.c src/*/*.c; do
        [ -f "$file" ] && set -- "$@" "$file"
    done
fi
arm=${ARM_CC:-arm-none-eabi-gcc}
host=${HOST_CC:-gcc}
common="-std=c11 -ffreestanding -Wall -Wextra -Wconversion -Wshadow -Werror -Iinclude -Isrc ${SWITCHES:-}"
own_headers="-nostdinc -isystem $($arm -print-file-name=include)"
host_headers="-nostdinc -isystem $($host -print-file-name=include)"
mkdir -p "$out"
objects=
status=0
for source in "$@"; do
    object=$out/$(echo "$source" | tr / _ | sed 's/\.c$/.o/')
    # shellcheck disable=SC2086
    $arm $common $own_headers -mcpu=cortex-m0plus -mthumb -Os -ffunction-sections -fdata-sections \
        -fno-common -c -o "$object" "$source" || status=1
    # What takes other registers is told without optimization, too.
    # shellcheck disable=SC2086
    $host $common $host_headers -mgeneral-regs-only -O0 -c -o "$out/host.o" "$source" || status=1
    objects="$objects $object"
done
[ $status -eq 0 ] || exit 1

# 32-bit division, 64-bit products, shifts and comparisons, switch tables, and filling and copying
allowed='^(__aeabi_u?idiv(mod)?|__aeabi_(lmul|llsl|llsr|lasr|u?lcmp)|__gnu_thumb1_case_[a-z]+'
allowed="$allowed|memcpy|memset|__aeabi_mem(cpy|set|clr)[48]?)\$"
roots=$(interface)
for name in ${NOT_CALLED:-}; do     # functions of the interface that the program would not call
    roots=$(echo "$roots" | grep -v -- "-u $name\$")
done
# shellcheck disable=SC2086
arm-none-eabi-ld -r --gc-sections $roots -Map="$out/all.map" -o "$out/all.o" $objects || exit 1
foreign=$(arm-none-eabi-nm -u "$out/all.o" | awk '{ print $NF }' | sort -u | grep -Ev "$allowed|^($(echo $roots | sed 's/-u //g; s/ /|/g'))\$")
if [ -n "$foreign" ]; then
    echo "target_objects.sh: the library needs what it must not:" >&2
    # shellcheck disable=SC2086
    for symbol in $foreign; do
        arm-none-eabi-nm -A -u $objects | awk -v s="$symbol" '$NF == s { print "  " s, $1 }' >&2
    done
    status=1
fi

# Sections of the whole, each named after the function or table it holds.
arm-none-eabi-size -A "$out/all.o" | awk -v limit="${CODE_LIMIT:-0}" '
    $1 ~ /^\.text/                  { code += $2 }
    $1 ~ /^\.rodata/                { if ($1 ~ table) tables += $2; else constants += $2 }
    $1 ~ /^\.(data|bss)/ && $2 > 0  { print "target_objects.sh: writable data: " $1, $2; bad = 1 }
    END {
        printf "%d code, %d constants: %d bytes; %d tables (Cortex-M0+, -Os)\n", code, constants, code + constants, tables
        if (limit > 0 && code + constants > limit) {
            print "target_objects.sh: more than " limit " bytes"
            bad = 1
        }
        exit bad
    }' table="^\\.rodata\\.($(sed -n 's/^extern const .* \(smear_[a-z0-9_]*\)\[.*/\1/p' src/base/tables.h | tr '\n' '|')none)\$" || status=1

[ "${LIST:-1}" = 0 ] || arm-none-eabi-size $objects | awk 'NR > 1 {
    file = $6; sub(/^.*\//, "", file); printf "    %-32s %6d\n", file, $1 }'
exit $status
