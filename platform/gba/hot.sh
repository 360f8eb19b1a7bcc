#!/bin/sh
# SPDX-License-Identifier: MIT
# hot.sh PROGRAM.elf PROFILE BYTES
# Prints hot.ld: the functions of the library that gain most per byte from fast memory, as many as
# fit into BYTES. PROFILE is what `run.sh -p PROFILE PROGRAM.elf` wrote; the gain of a function is
# what it took beyond FAST_CYCLES per instruction, or, where it lies in fast memory already, what it would
# take: SLOW_CYCLES more.
set -u
arm-none-eabi-nm -n -S "$1" | awk 'NF == 4 && $3 ~ /[tT]/ { print "F", $1, $2, $4 }' >"$2.names"
awk '{ print "P", $1, $2, $3 }' "$2" | cat "$2.names" - | sort -k2,2 -k1,1 |
    awk '
    function number(hex,    i, value) {
        for (i = 1; i <= length(hex); i++)
            value = value * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1
        return value
    }
    BEGIN { FAST_CYCLES = 1.8; SLOW_CYCLES = 3.2 }
    $1 == "F" { name = $4; end = number($2) + number($3); bytes[name] = number($3) }
    $1 == "P" && number($2) < end { gain[name] += $2 ~ /^03/ ? SLOW_CYCLES * $4 : $3 - FAST_CYCLES * $4 }
    END {
        for (name in gain)
            if (bytes[name] > 0 && gain[name] > 0)
                print gain[name] / bytes[name], bytes[name], name | "sort -rn"
        close("sort -rn")
    }' | awk -v room="$3" '
    BEGIN {
        print "/* SPDX-License-Identifier: MIT */"
        print "/* hot.ld - functions in fast memory; chosen by make TARGET=gba gba-hot. */"
    }
    $2 + 8 <= room && $3 !~ /veneer$|_from_/ {
        room -= $2 + 8
        sub(/\.(part|isra|constprop).*/, "", $3)
        printf "*(.text.%s .text.%s.*)\n", $3, $3
    }'
rm -f "$2.names"
