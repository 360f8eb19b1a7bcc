#!/bin/sh
# SPDX-License-Identifier: MIT
# device_chart.sh FOLDER - the picture of platform/device_chart.awk: labels cover neither each other nor the marks of
# others and stay within their panel, where many ways to blur lie close together, too.
set -u
. "$(dirname "$0")/lib.sh"
base=$1
mkdir -p "$base"

# drawn NAME MARKS: of $base/NAME.csv. A letter is taken as 0.55 of its size wide and 0.72 high.
drawn() {
    awk -f platform/device_chart.awk "$base/$1.csv" >"$base/$1.svg" && awk -v count="$2" '
        function value(name,    at) {
            at = match($0, " " name "=\"[-0-9.]*")
            return at ? substr($0, at + length(name) + 3, RLENGTH - length(name) - 3) + 0 : 0
        }
        /<g / { panel++; boxes = 0 }
        /<\/g>/ { ended = 1 }
        /<circle/ && /<title>/ { marks++ }
        /<text/ && /text-anchor="middle" font-size="11"/ {
            text = $0
            gsub(/<[^>]*>/, "", text)
            half = length(text) * 11 * 0.275
            x0 = value("x") - half; x1 = value("x") + half; y1 = value("y"); y0 = y1 - 8
            if (x0 < 0 || x1 > 760 || y0 < 30) { print "outside: " text " in panel " panel; bad = 1 }
            for (i = 1; i <= boxes; i++)
                if (x0 < bx1[i] && x1 > bx0[i] && y0 < by1[i] && y1 > by0[i]) {
                    print text " over " name[i] " in panel " panel
                    bad = 1
                }
            boxes++
            bx0[boxes] = x0; bx1[boxes] = x1; by0[boxes] = y0; by1[boxes] = y1; name[boxes] = text
            labels++
        }
        END {
            if (labels < count) { print labels " labels, not " count; bad = 1 }
            if (marks != count) { print marks " marks, not " count; bad = 1 }
            exit bad || !ended
        }' "$base/$1.svg"
}

head='target,screen,unit,method,cost per pixel,RMS in codes'
{
    echo "$head"
    for method in none accumulate-2 accumulate-4 subframes-8 timemask-32 auto-draft auto-balanced auto-fine layered; do
        echo "one,oled,cycles,$method,1000,5"
    done
    for cost in 100 120 140 5000; do echo "two,gba,instructions,reconstruct-$cost,$cost,$cost"; done
} >"$base/crowd.csv"
claim crowd drawn crowd 13
{
    echo "$head"
    awk 'BEGIN { for (i = 0; i < 40; i++) printf "one,oled,cycles,m%d-%d,%.1f,%.2f\n", i % 9, i, 500 + i * i, 4 + i % 7 / 4 }'
} >"$base/many.csv"
claim many drawn many 40
printf '%s\none,oled,cycles,none,100,0\n' "$head" >"$base/single.csv"
claim single drawn single 1
finish
