#!/bin/sh
# SPDX-License-Identifier: MIT
# gba_stages.sh LIBRARY.a
# Fast memory of a Game Boy Advance holds functions by stage: fails where hot_assemble.ld names one that is called while
# triangles are drawn, or hot_draw.ld one that is called while they are assembled: it would not be there.
set -u
stages=$(sh platform/gba/stages.sh "$1") || exit 1
printf '%s\n' "$stages" | awk '
    BEGIN {
        for (i = 1; i < 3; i++) {
            stage = i == 1 ? "assemble" : "draw"
            file = "platform/gba/hot_" stage ".ld"
            while ((getline line < file) > 0)
                if (match(line, /\.text\.[A-Za-z0-9_]+ /))
                    place[substr(line, RSTART + 6, RLENGTH - 7)] = stage
        }
    }
    { called[$1] = $2 }
    $1 in place {
        found++
        if (place[$1] != $2) {
            print "gba_stages.sh: " $1 " lies among those of " place[$1] ", and is called in " ($2 == "both" ? "both stages" : $2)
            bad = 1
        }
    }
    END {
        if (called["smear_assemble"] != "assemble" || called["smear_shade"] != "assemble" || called["smear_submit"] != "both" ||
            called["smear_cover"] != "draw" || found < 20) {
            print "gba_stages.sh: stages are not told apart"
            bad = 1
        }
        if (!bad)
            print found " functions lie where they are called"
        exit bad
    }'
