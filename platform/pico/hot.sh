#!/bin/sh
# SPDX-License-Identifier: MIT
# hot.sh PROGRAM.elf BYTES PROFILE...
# Prints hot.ld: the functions that win most per byte where they lie in RAM, as many as fit into BYTES. A profile is what `run.sh
# --profile` wrote of a program with nothing in RAM; all count alike, per frame or not. A function wins the cycles that it
# waited for code from flash, and a little for each instruction, since it pushes others out of the cache.
set -u
elf=$1 room=$2
shift 2
arm-none-eabi-nm -n -S "$elf" | awk 'NF == 4 && $3 ~ /[tT]/ && $1 ~ /^1/ { print "F", $1, $2, $4 }' >"$elf.names"
for profile in "$@"; do
    total=$(awk '{ sum += $2 } END { printf "%.0f", sum }' "$profile")
    awk -v total="$total" '$1 ~ /^1/ { print "P", $1, ($4 + 0.1 * $3) / total }' "$profile" | cat "$elf.names" - | sort -k2,2 -k1,1
done | awk '
    function number(hex,    i, value) {
        for (i = 1; i <= length(hex); i++)
            value = value * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1
        return value
    }
    $1 == "F" {
        name = $4
        sub(/\..*/, "", name)
        end = number($2) + number($3)
        if (!($2 in known))
            bytes[name] += number($3)
        known[$2] = 1
    }
    $1 == "P" && number($2) < end { gain[name] += $3 }
    END {
        for (name in gain)
            if (bytes[name] > 0)
                printf "%.9f %d %s\n", gain[name] / bytes[name] * 1e6, bytes[name], name | "sort -rn"
    }' | awk -v room="$room" '
    BEGIN { print "/* SPDX-License-Identifier: MIT */\n/* Functions in RAM; chosen by make TARGET=pico pico-hot. */" }
    $3 ~ /^(main|idle|sent|work|drain|command|send|flush|paint_stacks|__.*|memcpy|memset|_.*)$/ { next }
    used + $2 + 8 <= room { used += $2 + 8; printf "*(.text.%s .text.%s.*)\n", $3, $3 }
    END { print used " bytes" >"/dev/stderr" }'
rm -f "$elf.names"
