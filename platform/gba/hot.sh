#!/bin/sh
# SPDX-License-Identifier: MIT
# hot.sh FOLDER LIBRARY.a BYTES WARM-BYTES PROFILE...
# Writes hot.ld, hot_assemble.ld, hot_draw.ld and hot_warm.ld into FOLDER: the functions of the library that gain most per byte from fast
# memory, as many as fit into BYTES, those of one stage only in place of those of the other (stages.sh); of the rest, as many
# as fit into WARM-BYTES of video memory. A profile is what
# `run.sh -p PROFILE FOLDER/demo.elf` wrote, of a program with nothing in fast memory; the gain of a function is what it took
# beyond FAST_CYCLES per instruction, SLOW_CYCLES of each at most: the rest is data.
set -u
folder=$1 library=$2 room=$3 warm=$4
shift 4
sh platform/gba/stages.sh "$library" >"$folder/stages"
arm-none-eabi-nm -n -S "$folder/demo.elf" | awk 'NF == 4 && $3 ~ /[tT]/ { print "F", $1, $2, $4 }' >"$folder/names"
for profile in "$@"; do
    awk '{ print "P", $1, $2, $3 }' "$profile" | cat "$folder/names" - | sort -k2,2 -k1,1
done | awk '
    function number(hex,    i, value) {
        for (i = 1; i <= length(hex); i++)
            value = value * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1
        return value
    }
    BEGIN { FAST_CYCLES = 1.8; SLOW_CYCLES = 3.2 }
    $1 == "F" {
        name = $4
        sub(/\..*/, "", name)
        end = number($2) + number($3)
        if (!($2 in known))
            bytes[name] += number($3)
        known[$2] = 1
    }
    $1 == "P" && number($2) < end {
        more = $3 - FAST_CYCLES * $4
        gain[name] += more < SLOW_CYCLES * $4 ? more : SLOW_CYCLES * $4
    }
    END {
        for (name in gain)
            if (bytes[name] > 0 && gain[name] > 0)
                print gain[name] / bytes[name], bytes[name], name | "sort -rn"
        close("sort -rn")
    }' | awk -v room="$room" -v warm="$warm" -v folder="$folder" '
    FILENAME != "-" { stage[$1] = $2; next }
    FNR == 1 {
        file["both"] = folder "/hot.ld"
        file["assemble"] = folder "/hot_assemble.ld"
        file["draw"] = folder "/hot_draw.ld"
        file["warm"] = folder "/hot_warm.ld"
        used["both"] = used["assemble"] = used["draw"] = used["warm"] = 0
        for (s in file)
            printf "/* SPDX-License-Identifier: MIT */\n/* Functions in fast or video memory; chosen by make TARGET=gba gba-hot. */\n" > file[s]
    }
    $3 in stage {
        s = stage[$3]
        used[s] += $2 + 8
        most = used["assemble"] > used["draw"] ? used["assemble"] : used["draw"]
        if (used["both"] + most > room) {
            used[s] -= $2 + 8
            s = "warm"
            if (used[s] + $2 + 8 > warm)
                next
            used[s] += $2 + 8
        }
        printf "*(.text.%s .text.%s.*)\n", $3, $3 > file[s]
    }
    END { for (s in used) print s, used[s] }' "$folder/stages" -
rm -f "$folder/names"
