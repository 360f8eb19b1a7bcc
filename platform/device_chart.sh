#!/bin/sh
# SPDX-License-Identifier: MIT
# device_chart.sh FOLDER DEVICE_ERROR [TARGET:SCREEN...]
# Speed against accuracy of the demo's ways to blur (demo_player.c) on devices. What a way costs is counted on the target
# (demo cost: instructions, on the Game Boy Advance cycles); how far its frames are from the truth is found on this machine,
# which draws the same bits (device_error.c). Writes FOLDER/device.csv, device.svg and a table, device.txt. BLURS="none ...": only
# these. A way for which a target has no memory is said and left out.
set -u
folder=$1 error=$2
shift 2
[ $# -gt 0 ] || set -- cortex-m0plus:pico cortex-m3:oled gba:gba
make=${MAKE:-make}
STEP=6          # none of these frames is the first after the camera has jumped
mkdir -p "$folder"
csv=$folder/device.csv
echo "target,screen,unit,method,cost per pixel,RMS in codes" >"$csv.new"
for pair in "$@"; do
    target=${pair%:*} screen=${pair#*:}
    needs=$(sed -n 's/^include *//p' "platform/$target/target.mk")
    for tool in $(sed -n 's/^NEEDS *:= *//p' "platform/$target/target.mk" ${needs:+"$needs"}); do
        command -v "$tool" >/dev/null || { echo "device_chart.sh: $target needs $tool" >&2; exit 1; }
    done
    "$error" "$screen" $STEP >"$folder/$screen.error" || exit 1
    while read -r blur rms; do
        case " ${BLURS:-$blur} " in *" $blur "*) ;; *) continue ;; esac
        log=$folder/$target-$blur.log
        if ! LIMIT=1800 $make --no-print-directory -s TARGET="$target" DEMO_SCREEN="$screen" BLUR="$blur" STEP=$STEP demo-cost \
            >"$log" 2>&1 </dev/null; then
            grep -q 'start (error\|error -2' "$log" || { tail -5 "$log" >&2; exit 1; }
            echo "device_chart.sh: $target has no memory for $blur at $screen" >&2
            continue
        fi
        sed -n '1s/.*: \([a-z]*\),.*/\1/p; s/^total.*, \([0-9.]*\) per pixel/\1/p' "$log" | tr '\n' ' ' |
            awk -v target="$target" -v screen="$screen" -v blur="$blur" -v rms="$rms" \
                '{ printf "%s,%s,%s,%s,%s,%s\n", target, screen, $1, blur, $2, rms }' >>"$csv.new"
    done <"$folder/$screen.error"
done
mv "$csv.new" "$csv"
awk -F, 'NR > 1 {
    if ($1 != last) {
        printf("%s%s, %s: %s per pixel, and RMS against the truth\n", NR > 2 ? "\n" : "", $1, $2, $3)
        last = $1
    }
    printf "    %-16s %10.1f %8.2f\n", $4, $5, $6
}' "$csv" | tee "$folder/device.txt"
awk -f platform/device_chart.awk "$csv" >"$folder/device.svg.new" && mv "$folder/device.svg.new" "$folder/device.svg"
