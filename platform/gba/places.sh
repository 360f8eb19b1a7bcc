#!/bin/sh
# SPDX-License-Identifier: MIT
# places.sh FOLDER
# Prints a table of the parts of the library's memory on a Game Boy Advance: their bytes, how often a frame of the demo at 120x80
# reads and writes each, by 8, 16 and 32 bits, and how many cycles of a frame a byte of it would save in video memory (1 cycle
# for 8 and 16 bits, 2 for 32) and in fast memory (1) instead of slow memory (3; 6). FOLDER/demo.elf says where parts
# lie and leaves them in slow memory. Sharp frames, and the mean of the loop's blurred ones.
set -eu
folder=$1
for way in none auto-sketch; do
    platform/gba/run.sh -d "$folder/$way.data" "$folder/demo.elf" cost gba $way 1 >"$folder/$way.places"
done
echo '| | sharp: bytes | read, written (1000) | cycles per byte, video; fast | blurred: bytes | read, written (1000) | cycles per byte, video; fast |'
echo '|---|---|---|---|---|---|---|'
awk '
    function number(hex,    i, value) {
        for (i = 1; i <= length(hex); i++)
            value = value * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1
        return value
    }
    function cell(way, part,    n) {
        n = size[way, part]
        if (n == 0)
            return "| | "
        return sprintf("%d | %.1f, %.1f | %s; %.1f", n, reads[way, part] / FRAMES / 1000, writes[way, part] / FRAMES / 1000,
            bytes[way, part] > FRAMES ? "written by bytes" : sprintf("%.1f", saved[way, part] / FRAMES / n), (saved[way, part] + words[way, part]) / FRAMES / n)
    }
    BEGIN {
        FRAMES = 72
        split("context,colour of rows,depth of rows,instants,sums of instants,band,segments,triangles,draws,rows behind lines,the rest of the arena", name, ",")
    }
    { way = FILENAME; sub(/.*\//, "", way); sub(/\..*/, "", way) }
    $1 == "place" {
        if (size[way, $2] == 0)
            first[way, $2] = number($3)
        size[way, $2] += $4                     # one part lies behind another of its kind
    }
    $1 == "memory" { size[way, 10] = $2; for (p = 0; p < 10; p++) size[way, 10] -= size[way, p]; arena_end[way] = first[way, 0] + $2 }
    FILENAME ~ /data$/ && $1 ~ /^02/ {
        address = number($1)
        part = 10
        for (p = 0; p < 10; p++)
            if (size[way, p] > 0 && address >= first[way, p] && address < first[way, p] + size[way, p])
                part = p
        if (part == 10 && (address < first[way, 0] || address >= arena_end[way]))
            next
        reads[way, part] += $3 + $4 + $5
        writes[way, part] += $6 + $7 + $8
        bytes[way, part] += $6
        saved[way, part] += 2 * ($3 + $4 + $6 + $7) + 4 * ($5 + $8)
        words[way, part] += $5 + $8
    }
    END {
        for (p = 0; p < 11; p++)
            printf "| %s | %s | %s |\n", name[p + 1], cell("none", p), cell("auto-sketch", p)
    }' "$folder/none.places" "$folder/auto-sketch.places" "$folder/none.data" "$folder/auto-sketch.data"
