#!/bin/sh
# SPDX-License-Identifier: MIT
# board_table.sh [NAME...] - what the demo costs on boards, by scene and method: measures those named (pico gba lm3s6965evb
# raspi0; none: nothing) into build/rates, then prints the tables of platform/tables.md of all that have been measured.
#
# Cycles are those of the emulators of a Pico and a Game Boy Advance. QEMU counts instructions: on the Cortex-M3 one takes a
# cycle here, so that the rate is the highest there may be; on the Pi Zero's ARM1176 it takes 1.3.
set -eu
out=build/rates
MAKE=${MAKE:-make}
methods="reconstruct-8 accumulate-4"
mkdir -p $out

cost() { $MAKE --no-print-directory -s TARGET="$1" demo-cost ${2:+BLUR=$2}; }

for name; do
    [ "$name" = raspi0 ] || MAKE="$MAKE" sh platform/rates.sh "$name" >/dev/null
    case $name in
    raspi0)
        cost raspi0 >$out/raspi0.new
        cost raspi0 none | sed -n 's/^total/sharp/p' >>$out/raspi0.new
        mv $out/raspi0.new $out/raspi0
        ;;
    pico) sh platform/pico/run.sh build/pico/breakout/demo.elf cost pico-240 auto-sketch 72 >$out/pico-memory ;;
    *)
        for method in $methods; do
            # What does not fit into a board's memory has no row.
            if cost "$name" "$method" >$out/new 2>/dev/null; then mv $out/new "$out/$name-$method"; else rm -f $out/new "$out/$name-$method"; fi
        done
        ;;
    esac
done

# flash PROGRAM: kilobytes that are written to the board, with the demo's meshes
flash() { arm-none-eabi-size "$1" | awk 'NR == 2 { printf "%.0f kB", ($1 + $2) / 1000 }'; }

# row BOARD PANEL METHOD FILE HZ CYCLES-PER-COUNT PROGRAM: of what `demo cost` printed
row() {
    [ -f "$4" ] || return 0
    awk -v board="$1" -v panel="$2" -v method="$3" -v hz="$5" -v cycles="$6" -v flash="$(flash "$7")" '
        function say(count) { r = hz / (count * cycles); return sprintf(r < 10 ? "%.1f" : "%.0f", r) sprintf(" (%.2f M)", count * cycles / 1e6) }
        /per frame/ { count[$1] = $2 }
        /^memory/ { ram = $2 + $6 }
        END {
            if (method == "none")
                count["objects"] = count["camera"] = count["sharp"]
            if (!("objects" in count))          # every tile of every frame is drawn as if it moved
                count["objects"] = count["camera"]
            printf "| %s | %s | %s | %s | %s | %s | %s |\n", board, panel, method, say(count["objects"]), say(count["camera"]),
                method == "none" ? "" : sprintf("%.0f kB", ram / 1000), flash
        }' "$4"
}

echo '| board | panel | method | things move: frames per second (cycles) | the camera moves, too | RAM | flash |'
echo '|---|---|---|---|---|---|---|'
if [ -f $out/pico ]; then
    awk -v flash="$(flash build/pico/breakout/demo.elf)" -v ram="$(awk '/^memory/ { printf "%.0f kB", ($2 + $6) / 1000 }' $out/pico-memory 2>/dev/null)" '
        $3 ~ /^(sharp|objects|camera)$/ { cycles[$1 $3] = $4; rate[$1 $3] = $(NF - 3) }
        function say(of) { return sprintf(rate[of] < 10 ? "%.1f (%.2f M)" : "%.0f (%.2f M)", rate[of], cycles[of] / 1e6) }
        END {
            for (cores = 1; cores <= 2; cores++) {
                if (!((cores "sharp") in rate))
                    continue
                board = "Pico, RP2040 at 133 MHz, " (cores == 1 ? "one core" : "both cores")
                printf "| %s | 240x240 | none | %s | %s | | %s |\n", board, say(cores "sharp"), say(cores "sharp"), flash
                printf "| %s | 240x240 | auto | %s | %s | %s | %s |\n", board, say(cores "objects"), say(cores "camera"), ram, flash
            }
        }' $out/pico
fi
for method in none auto $methods; do
    file=$out/gba
    case $method in none | auto) ;; *) file=$out/gba-$method ;; esac
    row "Game Boy Advance, 16.8 MHz" 120x80 $method $file 16777216 1 build/gba/demo.elf
done
for method in none auto $methods; do
    file=$out/lm3s6965evb
    case $method in none | auto) ;; *) file=$out/lm3s6965evb-$method ;; esac
    row "Cortex-M3 at 50 MHz, at most" 128x64 $method $file 50000000 1 build/lm3s6965evb/demo.elf
done
for method in none auto; do
    row "Pi Zero, ARM1176 at 1 GHz, estimate" 640x480 $method $out/raspi0 1000000000 1.3 build/raspi0/pi-640/demo.elf
done
echo
echo '| board | bus to the panel | bytes of a whole frame | at most |'
echo '|---|---|---|---|'
bus() { # BOARD BUS BITS-PER-SECOND BYTES
    awk -v board="$1" -v bus="$2" -v bits="$3" -v bytes="$4" 'BEGIN {
        printf "| %s | %s | %d: %.1f ms | %.0f frames per second |\n", board, bus, bytes, bytes * 8000 / bits, bits / 8 / bytes }'
}
# Of every row of boards.h that the emulator has run, and that does not wait for the panel: 16 bits a pixel.
sed -n '/^\/\*.*Run in the emulator/{s/^\/\* *\([^:,]*\)[:,].*/\1/;h;};/^BOARD(/{G;s/\n/\t/;p;}' platform/pico/boards.h |
    awk -F '\t' '$1 ~ /RP2040.* NO, [0-9NO]+\)$/ { split($1, f, /[^A-Za-z0-9_]+/); printf "%s\t%s\t%s\t%s\t%s\n", $2, f[4], f[5], f[10], f[18] }' |
    while IFS="$(printf '\t')" read -r board width height wires khz; do
        [ "$wires" = 8 ] && lanes=8 || lanes=1
        bus "$board" "$([ $lanes = 8 ] && echo "8 wires" || echo SPI) at $(awk "BEGIN { print $khz / 1000 }") MHz" $((khz * 1000 * lanes)) $((width * height * 2))
    done
echo '| Game Boy Advance, Pi Zero | none: pixels lie in memory that the screen reads | | |'
