#!/bin/sh
# SPDX-License-Identifier: MIT
# hot.sh FOLDER LIBRARY.a
# Chooses which functions of the library lie in a Game Boy Advance's fast memory, and in video memory, and writes hot.ld,
# hot_assemble.ld, hot_draw.ld and hot_warm.ld into FOLDER. LINK_DEMO and LINK_GAME link FOLDER/demo.elf and FOLDER/game.elf
# with the lists that lie there.
#
# First by a model: programs with nothing in fast memory are profiled, functions gain what hot_model.awk says, and the densest
# are taken. Then by measuring: what the model or the lists of platform/gba chose, whichever costs less, is changed by one
# function at a time, which displaces those that gain least per byte, and what costs less is kept. The cost is the
# product of four: a sharp frame, a blurred one of which things move, one in which the camera moves, too, and one of the game, blurred as
# the firmware does: sketches.
# TRIES: how many functions are tried at a time [60]; of those that are kept, all are tried again ROUNDS times [2].
set -u
folder=$1 library=$2
tries=${TRIES:-60} rounds=${ROUNDS:-2}
lists='hot hot_assemble hot_draw hot_warm'
room_of() { arm-none-eabi-nm "$folder/demo.elf" "$folder/game.elf" | awk -v name="$1" '$3 == name { print $1; exit }'; }

# Writes the lists of STATE, "NAME PLACE" of functions in fast or warm memory.
write_lists() {
    for list in $lists; do
        printf '/* SPDX-License-Identifier: MIT */\n/* Functions in fast or video memory; chosen by make TARGET=gba gba-hot. */\n' >"$folder/$list.ld"
    done
    awk -v folder="$folder" 'FNR == NR { stage[$1] = $2; next }
        $2 == "fast" || $2 == "warm" {
            list = $2 == "warm" ? "hot_warm" : stage[$1] == "both" ? "hot" : "hot_" stage[$1]
            printf "*(.text.%s .text.%s.*)\n", $1, $1 >> (folder "/" list ".ld")
        }' "$folder/model" "$1"
}

# Links both programs; leaves in SLACK how many bytes of each kind of memory are left: assemble, draw, warm.
link_programs() {
    write_lists "$1"
    $LINK_DEMO 2>"$folder/link.log" && $LINK_GAME 2>>"$folder/link.log" || return 1
    slack=$(for program in demo game; do
        arm-none-eabi-size -A "$folder/$program.elf"
        arm-none-eabi-nm "$folder/$program.elf" | awk '$3 == "link_context" || $3 == "link_fast_end" { print $3, "0x" $1 }' |
            while read -r name address; do echo "$name $((address))"; done
    done | awk '
        $1 == ".assemble" || $1 == ".draw" || $1 == ".warm" { if ($2 > size[$1]) size[$1] = $2 }
        $1 == "link_context" { limit = $2 }
        $1 == "link_fast_end" && $2 > end { end = $2 }
        END { print limit - end - size[".assemble"], limit - end - size[".draw"], 19968 - size[".warm"] }')
}

# Prints "SCORE SHARP OBJECTS CAMERA GAME" in cycles; the score is 10000 times the sum of logarithms.
cost() {
    {
        platform/gba/run.sh "$folder/demo.elf" cost gba none 12 | sed -n 's/^total/sharp/p' &&
            platform/gba/run.sh "$folder/demo.elf" cost gba auto-sketch 12 &&
            platform/gba/run.sh "$folder/game.elf" cost gba 400
    } | awk '
        $1 ~ /^(sharp|objects|camera|mean)$/ { sub(/,/, "", $2); cycles[$1] = $2; sum += log($2) }
        END {
            if (!("sharp" in cycles && "objects" in cycles && "camera" in cycles && "mean" in cycles))
                exit 1
            printf "%d %d %d %d %d\n", 10000 * sum, cycles["sharp"], cycles["objects"], cycles["camera"], cycles["mean"]
        }'
}

say() { echo "$*" | tee -a "$folder/log"; }

: >"$folder/log"
sh platform/gba/stages.sh "$library" >"$folder/stages" || exit 1
: >"$folder/model"
: >"$folder/none"
link_programs "$folder/none" || { cat "$folder/link.log"; exit 1; }
say "profiling with nothing in fast memory"
platform/gba/run.sh -p "$folder/sharp.profile" "$folder/demo.elf" cost gba none 4 >/dev/null &&
    platform/gba/run.sh -p "$folder/auto.profile" "$folder/demo.elf" cost gba auto-sketch 12 >/dev/null &&
    platform/gba/run.sh -p "$folder/game.profile" "$folder/game.elf" cost gba 1200 >/dev/null || exit 1
for profile in demo:sharp demo:auto demo:auto game:game; do
    echo "W ${profile#*:}"
    arm-none-eabi-nm -n -S "$folder/${profile%:*}.elf" | awk 'NF == 4 && $3 ~ /[tTwW]/ { print "F", $1, $2, $4 }'
    sed 's/^jump/J/; t; s/^/P /' "$folder/${profile#*:}.profile"
done | awk -v model="$folder/model.new" -v start="$folder/by-model" -f platform/gba/hot_model.awk "$folder/stages" - || exit 1
mv "$folder/model.new" "$folder/model"

# The lists that are in use, of functions that there are.
for list in $lists; do
    sed -n "s/^\*(\.text\.\([^ ]*\) .*/\1 $([ $list = hot_warm ] && echo warm || echo fast)/p" platform/gba/$list.ld
done | awk 'FNR == NR { known[$1] = 1; next } $1 in known' "$folder/model" - >"$folder/by-lists"

best=
for state in by-model by-lists; do
    # What the model foresaw may be a little too large: its least dense functions go, of the memory that is too small.
    while ! link_programs "$folder/$state"; do
        grep -q "overflow" "$folder/link.log" && [ -s "$folder/$state" ] || { cat "$folder/link.log"; exit 1; }
        place=fast
        grep -q "overflowed by" "$folder/link.log" && place=warm
        awk -v place=$place 'FNR == NR { density[$1] = $4 / $3; next }
            { line[++n] = $0; if ($2 == place && (least == "" || density[$1] < low)) { least = n; low = density[$1] } }
            END { for (i = 1; i <= n; i++) if (i != least) print line[i] }' "$folder/model" "$folder/$state" >"$folder/less"
        mv "$folder/less" "$folder/$state"
    done
    now=$(cost) || exit 1
    say "$state: $now"
    if [ -z "$best" ] || [ "${now%% *}" -lt "${best%% *}" ]; then
        best=$now
        cp "$folder/$state" "$folder/state"
    fi
done

# try PLACE FUNCTION: keeps it there if that costs less; out: not in fast memory, which takes time to fill.
try() {
    more=0
    while [ $more -le 400 ]; do
        # shellcheck disable=SC2086
        awk -v place="$1" -v name="$2" -v slack="$kept_slack" -v more=$more -f platform/gba/hot_move.awk "$folder/model" "$folder/state" >"$folder/trial" || return 1
        link_programs "$folder/trial" && break
        more=$((more + 200))
    done
    [ $more -le 400 ] && now=$(cost) || return 1
    [ "${now%% *}" -lt "${best%% *}" ] || return 1
    best=$now
    kept_slack=$slack
    mv "$folder/trial" "$folder/state"
    say "$2 to $1: $now"
}

link_programs "$folder/state" || exit 1
kept_slack=$slack
round=0
while [ $round -lt "$rounds" ]; do
    round=$((round + 1))
    before=$best
    for place in fast warm out; do
        awk -v place=$place 'FNR == NR { at[$1] = $2; next }
            place == "out" && at[$1] == "fast" { print -$4 / $3, $1 }
            place != "out" && at[$1] != "fast" && at[$1] != place && $4 > 0 { print place == "warm" ? $4 : $4 / $3, $1 }' "$folder/state" "$folder/model" |
            sort -rn | awk -v tries="$tries" 'NR <= tries { print $2 }' >"$folder/candidates.$place"
        while read -r name; do
            try $place "$name"
        done <"$folder/candidates.$place"
    done
    [ "$best" = "$before" ] && break
done
link_programs "$folder/state" || exit 1
say "chosen: $(cost), bytes left of assembling, drawing, video: $slack"
